#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

/// What an element of a type is here.
struct AbaqusElementType {
  AbaqusKind kind;
  std::size_t nodes;
  std::size_t most_nodes;  ///< a beam may name one more, which orients it
};

/// The types that are known, by their names in capitals.
const std::map<std::string, AbaqusElementType>& abaqus_element_types();

/// What to give in place of elements that are not known, to follow the message that says so; empty:
/// nobody asked yet.
std::string instead_of_abaqus_type(const std::string& type);

}  // namespace blocklift::structure

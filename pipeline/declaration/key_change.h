#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/document.h"

namespace blocklift::pipeline {

/// A key of an input file that is to have another value than the file gives it.
struct KeyChange {
  std::string file;   ///< a model, as the case calls it; empty: the case file
  std::string key;    ///< "ropes.R1.length", "operation[1].moves[2].by": lists count from 1
  std::string value;  ///< as it would be written in the file: "10.02 m"
  Mark mark;          ///< what asks for it
};

/// Reads a change: "ropes.R1.length=10.02 m", "blocks/hull-860t:mass=870 t". None after a
/// complaint.
std::optional<KeyChange> parse_key_change(std::string_view text, const Mark& mark,
                                          Diagnostics& diagnostics);

/// Gives keys of a document their new values, those of the changes that are of this file; if there
/// are any, the document's text becomes that of the changed one. Places that share an anchor change
/// together. Complains about a key that is not there or holds a table or a list, and leaves it.
void apply_key_changes(const std::vector<KeyChange>& changes, std::string_view file,
                       Document& document, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "structure/output/base64.h"

/// Arrays of VTK's XML files, binary within base64.
namespace blocklift::structure {

template <typename Number>
void write_array(std::ofstream& file, const std::string& type, const std::string& name,
                 int components, const std::vector<Number>& values) {
  const std::uint64_t bytes = values.size() * sizeof(Number);
  std::vector<unsigned char> data(sizeof(bytes) + bytes);
  std::memcpy(data.data(), &bytes, sizeof(bytes));
  if (bytes > 0) std::memcpy(data.data() + sizeof(bytes), values.data(), bytes);
  file << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
       << components << "\" format=\"binary\">" << base64(data) << "</DataArray>\n";
}

/// Texts as field data.
void write_names(std::ofstream& file, const std::string& name,
                 const std::vector<std::string>& values);

}  // namespace blocklift::structure

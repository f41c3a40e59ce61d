#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

/// Arrays of VTK's XML files, binary within base64.
namespace blocklift::structure {

std::string base64(const char* data, std::size_t size);

template <typename Number>
void write_array(std::ofstream& file, const std::string& type, const std::string& name,
                 int components, const std::vector<Number>& values) {
  const std::uint64_t bytes = values.size() * sizeof(Number);
  std::string data(sizeof(bytes) + bytes, '\0');
  std::memcpy(data.data(), &bytes, sizeof(bytes));
  if (bytes > 0) std::memcpy(data.data() + sizeof(bytes), values.data(), bytes);
  file << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
       << components << "\" format=\"binary\">" << base64(data.data(), data.size())
       << "</DataArray>\n";
}

/// Texts as field data.
void write_names(std::ofstream& file, const std::string& name,
                 const std::vector<std::string>& values);

}  // namespace blocklift::structure

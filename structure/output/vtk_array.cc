#include "structure/output/vtk_array.h"

namespace blocklift::structure {

std::string base64(const char* data, std::size_t size) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(size / 3 * 4 + 4);
  for (std::size_t i = 0; i < size; i += 3) {
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (i + b < size ? static_cast<unsigned char>(data[i + b]) : 0U);
    for (std::size_t d = 0; d < 4; ++d)
      text += i + d > size ? '=' : digits[group >> (18 - 6 * d) & 63U];
  }
  return text;
}

void write_names(std::ofstream& file, const std::string& name,
                 const std::vector<std::string>& values) {
  file << "<DataArray type=\"String\" Name=\"" << name << "\" NumberOfTuples=\"" << values.size()
       << "\" format=\"ascii\">";
  for (const std::string& value : values) {
    for (const char c : value) file << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
    file << "0 ";
  }
  file << "</DataArray>\n";
}

}  // namespace blocklift::structure

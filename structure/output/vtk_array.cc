#include "structure/output/vtk_array.h"

namespace blocklift::structure {

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

#include "structure/output/base64.h"

#include <vector>

#include <deal.II/base/utilities.h>

namespace blocklift::structure {

std::string base64(std::span<const unsigned char> bytes) {
  return dealii::Utilities::encode_base64(std::vector<unsigned char>(bytes.begin(), bytes.end()));
}

}  // namespace blocklift::structure

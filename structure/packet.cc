#include "structure/packet.h"

#include <cstring>
#include <stdexcept>

// In place of deal.II's Utilities::pack, which gives an object to Boost's archives: arrays and
// Eigen's matrices are put one after another as they lie in memory, and who fills a packet reads
// none of deal.II's headers.
namespace blocklift::structure {

void Packet::append(const void* data, std::size_t size) {
  const auto* const begin = static_cast<const std::byte*>(data);
  if (size > 0) bytes_.insert(bytes_.end(), begin, begin + size);
}

void Packet::extract(void* data, std::size_t size) {
  if (size > bytes_.size() - taken_)
    throw std::logic_error("more is taken from a packet than was put");
  if (size > 0) std::memcpy(data, bytes_.data() + taken_, size);
  taken_ += size;
}

}  // namespace blocklift::structure

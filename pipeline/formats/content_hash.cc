#include "pipeline/formats/content_hash.h"

#include <bit>
#include <cstdio>

namespace blocklift::pipeline {

void ContentHash::add_bytes(std::uint64_t bytes) {
  constexpr std::uint64_t prime = 0x100000001b3;
  for (int byte = 0; byte < 8; ++byte) {
    const std::uint64_t value = (bytes >> (8 * byte)) & 0xff;
    first_ = (first_ ^ value) * prime;
    second_ = (second_ ^ (0xff - value)) * prime;
  }
}

void ContentHash::add(double number) {
  add_bytes(std::bit_cast<std::uint64_t>(number == 0.0 ? 0.0 : number));
}

void ContentHash::add(std::span<const double> numbers) {
  add(static_cast<std::int64_t>(numbers.size()));
  for (const double number : numbers) add(number);
}

void ContentHash::add(std::int64_t number) { add_bytes(static_cast<std::uint64_t>(number)); }

void ContentHash::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  for (const char letter : text) add_bytes(static_cast<unsigned char>(letter));
}

std::string ContentHash::digits() const {
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(first_),
                static_cast<unsigned long long>(second_));
  return text;
}

}  // namespace blocklift::pipeline

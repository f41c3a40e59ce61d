#include "pipeline/formats/content_hash.h"

#include <xxhash.h>

#include <bit>
#include <new>

#include <fmt/format.h>

#include "pipeline/formats/atomic_file.h"

namespace blocklift::pipeline {

namespace {

/// Bytes in the order of little-endian machines, wherever this runs.
template <typename Number>
Number in_order(Number number) {
  if constexpr (std::endian::native == std::endian::little) return number;
  return static_cast<Number>(__builtin_bswap64(static_cast<std::uint64_t>(number)));
}

}  // namespace

void ContentHash::Free::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }

ContentHash::ContentHash() : state_(XXH3_createState()) {
  if (!state_ || XXH3_128bits_reset(state_.get()) == XXH_ERROR) throw std::bad_alloc();
}

void ContentHash::add(double number) {
  add(std::bit_cast<std::int64_t>(number == 0.0 ? 0.0 : number));
}

void ContentHash::add(std::span<const double> numbers) {
  add(static_cast<std::int64_t>(numbers.size()));
  for (const double number : numbers) add(number);
}

void ContentHash::add(std::int64_t number) {
  const std::int64_t bytes = in_order(number);
  XXH3_128bits_update(state_.get(), &bytes, sizeof bytes);
}

void ContentHash::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  XXH3_128bits_update(state_.get(), text.data(), text.size());
}

std::string ContentHash::digits() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string hash_of_files(const std::vector<std::filesystem::path>& files) {
  ContentHash hash;
  for (const std::filesystem::path& file : files) hash.add(std::string_view(read_file(file)));
  return hash.digits();
}

}  // namespace blocklift::pipeline

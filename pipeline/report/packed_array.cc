#include "pipeline/report/packed_array.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "structure/output/base64.h"

namespace blocklift::pipeline {
namespace {

using json = nlohmann::ordered_json;

template <typename Number>
json packed(const std::vector<Number>& numbers, const char* type, double scale = 1.0) {
  static_assert(std::endian::native == std::endian::little,
                "the page expects little-endian numbers");
  const auto* bytes = reinterpret_cast<const unsigned char*>(numbers.data());
  json array{{"type", type}, {"data", structure::base64({bytes, numbers.size() * sizeof(Number)})}};
  if (scale != 1.0) array["scale"] = scale;
  return array;
}

/// Values as integers of 16 bits, the largest magnitude being the largest integer.
/// @param absent what stands for values that are not finite; none: zero
template <typename Integer>
json shares(const std::vector<double>& values, const char* type,
            std::optional<Integer> absent = std::nullopt) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const double range = std::numeric_limits<Integer>::max();
  const double lowest = std::numeric_limits<Integer>::min();
  std::vector<Integer> integers;
  integers.reserve(values.size());
  for (const double value : values) {
    if (!std::isfinite(value)) {
      integers.push_back(absent.value_or(0));
      continue;
    }
    const double share = largest > 0.0 ? value / largest * range : 0.0;
    integers.push_back(static_cast<Integer>(std::clamp(std::round(share), lowest, range)));
  }
  json array = packed(integers, type, largest / range);
  if (absent) array["absent"] = *absent;
  return array;
}

}  // namespace

json packed_floats(const std::vector<double>& values) {
  return packed(std::vector<float>(values.begin(), values.end()), "f32");
}

json packed_indices(const std::vector<std::int32_t>& indices) {
  return packed(std::vector<std::uint32_t>(indices.begin(), indices.end()), "u32");
}

json packed_short_indices(const std::vector<std::int32_t>& indices) {
  return packed(std::vector<std::uint16_t>(indices.begin(), indices.end()), "u16");
}

json packed_magnitudes(const std::vector<double>& values) {
  return shares<std::uint16_t>(values, "u16");
}

json packed_signed(const std::vector<double>& values) {
  return shares<std::int16_t>(values, "i16");
}

json packed_where_known(const std::vector<double>& values) {
  // Shares reach down to the largest integer's negative: the one below it is free.
  return shares<std::int16_t>(values, "i16", std::numeric_limits<std::int16_t>::min());
}

}  // namespace blocklift::pipeline

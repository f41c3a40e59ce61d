#pragma once

#include <cstdint>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// Arrays of numbers as the pages hold them: {"type": "f32" | "u16" | "i16" | "u32", "scale",
/// "absent", "data"}, data being base64 of little-endian numbers. Where a scale is given, values
/// are the numbers times it; the number `absent`, where given, stands for no value. The page reads
/// them by `unpack` of pipeline/report/web/src/data.ts.
namespace blocklift::pipeline {

/// Values in single precision.
nlohmann::ordered_json packed_floats(const std::vector<double>& values);

/// Indices of 32 bits.
nlohmann::ordered_json packed_indices(const std::vector<std::int32_t>& indices);

/// Indices below 65536.
nlohmann::ordered_json packed_short_indices(const std::vector<std::int32_t>& indices);

/// Values that are never negative as shares of their largest in 16 bits, finer than any screen.
/// What is not finite is zero.
nlohmann::ordered_json packed_magnitudes(const std::vector<double>& values);

/// Values of either sign as shares of their largest magnitude in 16 bits. What is not finite is
/// zero.
nlohmann::ordered_json packed_signed(const std::vector<double>& values);

/// The same, what is not finite being absent.
nlohmann::ordered_json packed_where_known(const std::vector<double>& values);

}  // namespace blocklift::pipeline

#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace blocklift::pipeline::figures {

/// Figures of summary.json as text for engineers, in SI's larger units, thousands apart by a narrow
/// space. A value that is no number gives a dash. The twin of pipeline/report/web/src/numbers.ts.

using Value = nlohmann::ordered_json;

inline constexpr const char* missing = "\u2013";

std::string fixed(const Value& value, int decimals, double factor = 1);
/// About so many significant digits; digits before the point are never dropped.
std::string significant(const Value& value, int digits, double factor = 1);
std::string kilonewtons(const Value& newtons);
/// A force in tonnes, N divided by 9806.65.
std::string tonnes(const Value& newtons);
std::string megapascals(const Value& pascals);
std::string millimetres(const Value& metres);
/// A change in per cent with its sign.
std::string change(const Value& percent, int decimals = 1);
/// A share as whole per cent.
std::string share(const Value& share);

struct Quantity {
  std::string text;
  std::string unit;
};
/// A value of an SI unit in the unit that reports use.
Quantity in_report_unit(const Value& value, const std::string& unit);

}  // namespace blocklift::pipeline::figures

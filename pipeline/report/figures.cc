#include "pipeline/report/figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace blocklift::pipeline::figures {
namespace {

constexpr double weight_of_a_tonne = 9806.65;
constexpr const char* narrow_space = "\u202f";

std::optional<double> number_of(const Value& value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::string fixed_text(double number, int decimals) {
  std::string digits = fmt::format("{:.{}f}", std::abs(number), decimals);
  const bool is_zero = digits.find_first_not_of("0.") == std::string::npos;
  std::size_t place = std::min(digits.find('.'), digits.size());
  while (place > 3) digits.insert(place -= 3, narrow_space);
  return (number < 0 && !is_zero ? "\u2212" : "") + digits;
}

std::string significant_text(double number, int digits) {
  if (number == 0) return "0";
  if (!std::isfinite(number)) return fmt::format("{}", number);
  // Of the rounded number: 99.96 to three digits is 100, not 100.0.
  const std::string rounded = fmt::format("{:.{}e}", std::abs(number), std::max(digits - 1, 0));
  const int magnitude = std::stoi(rounded.substr(rounded.find('e') + 1));
  if (magnitude < -3 || magnitude > 8) return fmt::format("{:.{}e}", number, digits - 1);
  return fixed_text(number, std::max(digits - 1 - magnitude, 0));
}

}  // namespace

std::string fixed(const Value& value, int decimals, double factor) {
  const auto number = number_of(value);
  return number ? fixed_text(*number * factor, decimals) : missing;
}

std::string significant(const Value& value, int digits, double factor) {
  const auto number = number_of(value);
  return number ? significant_text(*number * factor, digits) : missing;
}

std::string kilonewtons(const Value& newtons) {
  const auto number = number_of(newtons);
  if (!number) return missing;
  const double size = std::abs(*number);
  return significant_text(*number / 1e3, size < 1e6 ? 3 : 4);
}

std::string tonnes(const Value& newtons) {
  const auto number = number_of(newtons);
  if (!number) return missing;
  const double size = std::abs(*number);
  if (size < 1e5) return significant_text(*number / weight_of_a_tonne, 3);
  return fixed_text(*number / weight_of_a_tonne, size < 1e8 ? 1 : 0);
}

std::string megapascals(const Value& pascals) { return significant(pascals, 3, 1e-6); }

std::string millimetres(const Value& metres) { return significant(metres, 3, 1e3); }

std::string change(const Value& percent, int decimals) {
  const auto number = number_of(percent);
  if (!number) return missing;
  const std::string text = fixed_text(*number, decimals);
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return (*number > 0 && !is_zero ? "+" : "") + text + narrow_space + "%";
}

std::string share(const Value& share) {
  const auto number = number_of(share);
  return number ? fixed_text(*number * 100, 0) + narrow_space + "%" : missing;
}

Quantity in_report_unit(const Value& value, const std::string& unit) {
  static const std::map<std::string, std::pair<double, const char*>> units{
      {"Pa", {1e-6, "MPa"}}, {"m", {1e3, "mm"}},       {"rad", {180 / M_PI, "°"}},
      {"1", {1, ""}},        {"kg", {1e-3, "tonnes"}}, {"N m", {1e-3, "kN m"}}};
  if (unit == "N") return {kilonewtons(value), "kN"};
  const auto known = units.find(unit);
  if (known == units.end()) return {significant(value, 3), unit};
  return {significant(value, 3, known->second.first), known->second.second};
}

}  // namespace blocklift::pipeline::figures

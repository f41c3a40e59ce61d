#include "pipeline/declaration/quantity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <udunits2.h>

namespace blocklift::pipeline {
namespace {

/// Standard gravity, 3rd CGPM (1901), m/s^2: turns a mass into its weight.
constexpr double standard_gravity = 9.80665;

/// A unit in terms of the base units: the SI value of one of it and its exponents.
struct UnitMeaning {
  double scale = 1;
  Exponents exponents;
};

struct DimensionEntry {
  Exponents exponents;
  DimensionText text;
};

const DimensionEntry& entry_of(Dimension dimension) {
  static const std::map<Dimension, DimensionEntry> entries = {
      {Dimension::ratio, {{0, 0, 0, 0}, {"a plain number", "1", "1.5"}}},
      {Dimension::length, {{1, 0, 0, 0}, {"a length", "m", "12 m"}}},
      {Dimension::area, {{2, 0, 0, 0}, {"an area", "m^2", "30 m^2"}}},
      {Dimension::mass, {{0, 1, 0, 0}, {"a mass", "kg", "860 t"}}},
      {Dimension::time, {{0, 0, 1, 0}, {"a time", "s", "10 s"}}},
      {Dimension::frequency, {{0, 0, -1, 0}, {"a frequency", "Hz", "2.5 Hz"}}},
      {Dimension::angle, {{0, 0, 0, 1}, {"an angle", "rad", "45 deg"}}},
      {Dimension::speed, {{1, 0, -1, 0}, {"a speed", "m/s", "3 m/min"}}},
      {Dimension::angular_speed, {{0, 0, -1, 1}, {"an angular speed", "rad/s", "0.5 deg/s"}}},
      {Dimension::acceleration, {{1, 0, -2, 0}, {"an acceleration", "m/s^2", "0.1 m/s^2"}}},
      {Dimension::angular_acceleration,
       {{0, 0, -2, 1}, {"an angular acceleration", "rad/s^2", "0.1 deg/s^2"}}},
      {Dimension::jerk, {{1, 0, -3, 0}, {"a jerk", "m/s^3", "0.2 m/s^3"}}},
      {Dimension::angular_jerk, {{0, 0, -3, 1}, {"an angular jerk", "rad/s^3", "0.1 deg/s^3"}}},
      {Dimension::force, {{1, 1, -2, 0}, {"a force", "N", "250 kN"}}},
      {Dimension::load, {{1, 1, -2, 0}, {"a force or a mass", "N", "140 t"}}},
      {Dimension::moment, {{2, 1, -2, 0}, {"a moment", "N m", "40 kN m"}}},
      {Dimension::stress, {{-1, 1, -2, 0}, {"a stress", "Pa", "355 MPa"}}},
      {Dimension::density, {{-3, 1, 0, 0}, {"a density", "kg/m^3", "7850 kg/m^3"}}},
      {Dimension::stiffness, {{0, 1, -2, 0}, {"a stiffness", "N/m", "60 MN/m"}}},
      {Dimension::rotational_stiffness,
       {{2, 1, -2, -1}, {"a rotational stiffness", "N m/rad", "5 MN m/rad"}}},
      {Dimension::damping, {{0, 1, -1, 0}, {"a damping", "N s/m", "20 kN s/m"}}},
      {Dimension::rotational_damping,
       {{2, 1, -1, -1}, {"a rotational damping", "N m s/rad", "20 kN m s/rad"}}},
      {Dimension::moment_of_inertia,
       {{2, 1, 0, 0}, {"a moment of inertia", "kg m^2", "450 t m^2"}}},
      {Dimension::mass_per_length, {{-1, 1, 0, 0}, {"a mass per length", "kg/m", "60 kg/m"}}},
      {Dimension::length_per_angle, {{1, 0, 0, -1}, {"a length per angle", "m/rad", "0.5 m/rad"}}},
      {Dimension::angle_per_length, {{-1, 0, 0, 1}, {"an angle per length", "rad/m", "2 rad/m"}}},
      {Dimension::wave_spectrum,
       {{2, 0, 1, -1}, {"a density of a wave spectrum", "m^2 s/rad", "0.8 m^2 s/rad"}}},
      {Dimension::quadratic_rotational_damping,
       {{2, 1, 0, -2}, {"a quadratic rotational damping", "N m s^2/rad^2", "5 MN m s^2/rad^2"}}},
      {Dimension::impulse, {{1, 1, -1, 0}, {"an impulse", "N s", "20 kN s"}}},
      {Dimension::second_moment_of_area,
       {{4, 0, 0, 0}, {"a second moment of area", "m^4", "8000 cm^4"}}},
  };
  return entries.at(dimension);
}

/// The noun for exponents that a file has where others are due; empty if nobody has a name for
/// them.
std::string noun_of(const Exponents& exponents) {
  for (int i = 0; i <= static_cast<int>(Dimension::second_moment_of_area); ++i) {
    const DimensionEntry& entry = entry_of(static_cast<Dimension>(i));
    if (entry.exponents == exponents) return entry.text.noun;
  }
  return {};
}

// UDUNITS takes a unit apart by calling back with what it is made of; these gather scale and
// exponents.

ut_status visit_basic(const ut_unit* unit, void* meaning);
ut_status visit_product(const ut_unit* unit, int count, const ut_unit* const* basic_units,
                        const int* powers, void* meaning);

ut_status visit_galilean(const ut_unit* /*unit*/, double scale, const ut_unit* underlying,
                         double offset, void* meaning);

ut_status refuse_timestamp(const ut_unit* /*unit*/, const ut_unit* /*time*/, double /*origin*/,
                           void* /*meaning*/) {
  return UT_MEANINGLESS;
}

ut_status refuse_logarithm(const ut_unit* /*unit*/, double /*base*/, const ut_unit* /*reference*/,
                           void* /*meaning*/) {
  return UT_MEANINGLESS;
}

const ut_visitor visitor = {visit_basic, visit_product, visit_galilean, refuse_timestamp,
                            refuse_logarithm};

ut_status add_power(const ut_unit* basic_unit, int power, UnitMeaning& meaning) {
  const char* symbol = ut_get_symbol(basic_unit, UT_ASCII);
  const std::string_view name = symbol ? symbol : "";
  if (name == "m") {
    meaning.exponents.metre += power;
  } else if (name == "kg") {
    meaning.exponents.kilogram += power;
  } else if (name == "s") {
    meaning.exponents.second += power;
  } else if (name == "rad") {
    meaning.exponents.radian += power;
  } else {
    return UT_MEANINGLESS;  // temperature, current, amount, light: nothing here is measured in them
  }
  return UT_SUCCESS;
}

ut_status visit_basic(const ut_unit* unit, void* meaning) {
  return add_power(unit, 1, *static_cast<UnitMeaning*>(meaning));
}

ut_status visit_product(const ut_unit* /*unit*/, int count, const ut_unit* const* basic_units,
                        const int* powers, void* meaning) {
  for (int i = 0; i < count; ++i) {
    const ut_status status =
        add_power(basic_units[i], powers[i], *static_cast<UnitMeaning*>(meaning));
    if (status != UT_SUCCESS) return status;
  }
  return UT_SUCCESS;
}

ut_status visit_galilean(const ut_unit* /*unit*/, double scale, const ut_unit* underlying,
                         double offset, void* meaning) {
  if (offset != 0) return UT_MEANINGLESS;
  static_cast<UnitMeaning*>(meaning)->scale *= scale;
  return ut_accept_visitor(underlying, &visitor, meaning);
}

/// The unit database, read once. UDUNITS is not thread-safe, so every call is made under a lock.
class UnitDatabase {
 public:
  static UnitDatabase& instance() {
    static UnitDatabase database;
    return database;
  }

  /// What a unit means, or nothing if UDUNITS does not know it or it is no unit of mechanics.
  std::optional<UnitMeaning> find(const std::string& unit) {
    const std::lock_guard lock(mutex_);
    const auto known = meanings_.find(unit);
    if (known != meanings_.end()) return known->second;
    std::optional<UnitMeaning> meaning;
    if (ut_unit* parsed = ut_parse(system_, unit.c_str(), UT_UTF8)) {
      UnitMeaning found;
      if (ut_accept_visitor(parsed, &visitor, &found) == UT_SUCCESS) meaning = found;
      ut_free(parsed);
    }
    if (meanings_.size() < 1000) meanings_.emplace(unit, meaning);
    return meaning;
  }

  ~UnitDatabase() { ut_free_system(system_); }
  UnitDatabase(const UnitDatabase&) = delete;
  UnitDatabase& operator=(const UnitDatabase&) = delete;

 private:
  UnitDatabase() {
    ut_set_error_message_handler(ut_ignore);  // what is wrong is said by our own messages
    system_ = ut_read_xml(nullptr);
    if (!system_) {
      throw std::runtime_error(
          "the unit database of UDUNITS-2 cannot be read; install the package libudunits2-data, or "
          "set UDUNITS2_XML_PATH to the place of udunits2.xml");
    }
    add_symbol("deg", "degree");
    add_symbol("rev", "turn");
    add_symbol("Nm", "N m");
    add_symbol("tf", "9806.65 N");
  }

  void add_symbol(const char* symbol, const char* definition) {
    ut_unit* unit = ut_parse(system_, definition, UT_ASCII);
    ut_map_symbol_to_unit(symbol, UT_ASCII, unit);
    ut_free(unit);
  }

  std::mutex mutex_;
  ut_system* system_ = nullptr;
  std::map<std::string, std::optional<UnitMeaning>> meanings_;
};

/// The text with blanks and a minus of ASCII. Texts that are copied from a data sheet or from a
/// report have others: no-break, thin and narrow no-break spaces, and U+2212.
std::string with_plain_signs(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, char>, 4> signs = {
      {{"\xC2\xA0", ' '}, {"\xE2\x80\x89", ' '}, {"\xE2\x80\xAF", ' '}, {"\xE2\x88\x92", '-'}}};
  std::string plain;
  while (!text.empty()) {
    const auto sign = std::find_if(signs.begin(), signs.end(), [&](const auto& known) {
      return text.starts_with(known.first);
    });
    plain += sign == signs.end() ? text.front() : sign->second;
    text.remove_prefix(sign == signs.end() ? 1 : sign->first.size());
  }
  return plain;
}

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The number at the head of the text; the rest, trimmed, is left in `rest`.
double leading_number(std::string_view text, std::string_view& rest, const std::string& due) {
  const std::string_view all = trimmed(text);
  std::string_view digits = all;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    throw QuantityError(fmt::format("\"{}\" is too large or too small a number{}", all, due));
  }
  if (error != std::errc()) throw QuantityError(fmt::format("\"{}\" is no number{}", all, due));
  if (!std::isfinite(value)) {
    throw QuantityError(fmt::format("\"{}\" is not a finite number{}", all, due));
  }
  rest = trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));
  if (rest.starts_with(',')) {
    throw QuantityError(fmt::format(
        "\"{}\" has a comma; decimals take a point (1.5) and thousands nothing (1000){}", all,
        due));
  }
  return value;
}

/// Units whose name means one thing to UDUNITS and another one in a shipyard.
void refuse_ambiguous(std::string_view unit, std::string_view text, const std::string& due) {
  static constexpr std::array<std::string_view, 4> tons = {"ton", "tons", "short_ton", "long_ton"};
  if (std::find(tons.begin(), tons.end(), unit) != tons.end()) {
    throw QuantityError(fmt::format(
        "\"{}\" is ambiguous: there are tons of 907, 1000 and 1016 kg; write \"t\" for 1000 kg{}",
        text, due));
  }
}

/// A unit begins with a letter, a degree or percent sign, or "1/"; another number is a slip.
bool looks_like_unit(std::string_view unit) {
  const auto first = static_cast<unsigned char>(unit.front());
  const bool is_letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
  return is_letter || first >= 0x80 || first == '%' || unit.starts_with("1/");
}

}  // namespace

const DimensionText& text_of(Dimension dimension) { return entry_of(dimension).text; }

std::string what_is_due(const std::vector<Dimension>& allowed) {
  std::string examples;
  for (const Dimension dimension : allowed) {
    examples += fmt::format("{}\"{}\"", examples.empty() ? "" : " or ", text_of(dimension).example);
  }
  return fmt::format("; {} is due, for example {}", nouns_of(allowed), examples);
}

std::string text_of(const Exponents& exponents) {
  std::string noun = noun_of(exponents);
  if (!noun.empty()) return noun;
  std::string unit;
  const auto add = [&](const char* symbol, int power) {
    if (power == 0) return;
    unit += fmt::format("{}{}", unit.empty() ? "" : " ", symbol);
    if (power != 1) unit += fmt::format("^{}", power);
  };
  add("kg", exponents.kilogram);
  add("m", exponents.metre);
  add("s", exponents.second);
  add("rad", exponents.radian);
  return "of the unit " + unit;
}

std::optional<Measure> find_unit(const std::string& unit) {
  const std::optional<UnitMeaning> meaning = UnitDatabase::instance().find(unit);
  if (!meaning) return std::nullopt;
  return Measure{meaning->scale, meaning->exponents};
}

std::optional<Quantity> as_quantity(const Measure& measure, const std::vector<Dimension>& allowed) {
  for (const Dimension dimension : allowed) {
    if (entry_of(dimension).exponents == measure.exponents)
      return Quantity{measure.value, dimension};
    if (dimension == Dimension::load && measure.exponents == entry_of(Dimension::mass).exponents) {
      return Quantity{measure.value * standard_gravity, dimension};
    }
  }
  return std::nullopt;
}

std::string nouns_of(const std::vector<Dimension>& dimensions) {
  std::string nouns;
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    if (i > 0) nouns += i + 1 == dimensions.size() ? " or " : ", ";
    nouns += text_of(dimensions[i]).noun;
  }
  return nouns;
}

namespace {

/// The number and its unit in SI. `due` is the end of every message.
Measure read_measure(std::string_view text, bool needs_unit, const std::string& due) {
  std::string_view unit;
  const double value = leading_number(text, unit, due);
  const std::string_view all = trimmed(text);
  if (unit.empty()) {
    if (!needs_unit) return {value, {}};
    throw QuantityError(fmt::format("\"{}\" has no unit{}", all, due));
  }
  if (!looks_like_unit(unit)) throw QuantityError(fmt::format("\"{}\" is no quantity{}", all, due));
  refuse_ambiguous(unit, all, due);
  const std::optional<UnitMeaning> meaning = UnitDatabase::instance().find(std::string(unit));
  if (!meaning) {
    throw QuantityError(fmt::format("\"{}\" has the unknown unit \"{}\"{}", all, unit, due));
  }
  const double in_si = value * meaning->scale;
  if (!std::isfinite(in_si)) {
    throw QuantityError(fmt::format("\"{}\" is too large a number{}", all, due));
  }
  return {in_si, meaning->exponents};
}

}  // namespace

Measure parse_measure(std::string_view text) {
  return read_measure(with_plain_signs(text), false,
                      "; a number with its unit is due, for example \"12 m\"");
}

Quantity parse_quantity(std::string_view given, const std::vector<Dimension>& allowed) {
  const std::string text = with_plain_signs(given);
  const std::string due = what_is_due(allowed);
  const bool plain = std::find(allowed.begin(), allowed.end(), Dimension::ratio) != allowed.end();
  const Measure measure = read_measure(text, !plain, due);
  if (const std::optional<Quantity> quantity = as_quantity(measure, allowed)) return *quantity;
  const std::string noun = noun_of(measure.exponents);
  const std::string found = noun.empty() ? "has a unit of another kind" : "is " + noun;
  throw QuantityError(fmt::format("\"{}\" {}{}", trimmed(text), found, due));
}

double parse_quantity(std::string_view text, Dimension dimension) {
  return parse_quantity(text, std::vector{dimension}).value;
}

double parse_number(std::string_view given) {
  const std::string text = with_plain_signs(given);
  const std::string due = "; a plain number is due, for example 1.5";
  std::string_view rest;
  const double value = leading_number(text, rest, due);
  if (!rest.empty()) {
    throw QuantityError(fmt::format("\"{}\" is no plain number{}", trimmed(text), due));
  }
  return value;
}

std::string format_quantity(double in_si, Dimension dimension) {
  if (dimension == Dimension::ratio) {
    // A count keeps its digits: "1000000", not "1e+06".
    const bool is_count = in_si == std::trunc(in_si) && std::abs(in_si) < 1e15;
    return is_count ? fmt::format("{:.0f}", in_si) : fmt::format("{:.6g}", in_si);
  }
  const DimensionText& text = text_of(dimension);
  const std::string unit = text.example.substr(text.example.find(' ') + 1);
  const double in_its_unit = in_si / parse_quantity("1 " + unit, dimension);
  // "0.05 kg", not "5e-05 t": large units are for what is large.
  const bool larger_than_si = std::abs(in_its_unit) < std::abs(in_si);
  if (larger_than_si && std::abs(in_its_unit) < 0.1)
    return fmt::format("{:.6g} {}", in_si, text.si_unit);
  return fmt::format("{:.6g} {}", in_its_unit, unit);
}

}  // namespace blocklift::pipeline

#pragma once

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace blocklift::pipeline {

/// Weight of a tonne under standard gravity, N.
inline constexpr double newton_per_tonne = 9806.65;

/// What a number in an input file measures.
///
/// The file writes a number with a unit ("860 t", "12 m", "3 m/min"); the program keeps the value
/// in coherent SI units. `ratio` is a plain number or a percentage.
enum class Dimension {
  ratio,
  length,
  area,
  mass,
  time,
  frequency,
  angle,
  speed,
  angular_speed,
  acceleration,
  angular_acceleration,
  jerk,
  angular_jerk,
  force,
  /// A force, or a mass whose weight under standard gravity (9.80665 m/s^2) is meant: "140 t".
  load,
  moment,
  stress,
  density,
  stiffness,
  rotational_stiffness,
  damping,
  rotational_damping,
  moment_of_inertia,
  mass_per_length,
  length_per_angle,
  angle_per_length,
  wave_spectrum,
  quadratic_rotational_damping,
  impulse,
  second_moment_of_area,
};

/// Exponents of metre, kilogram, second and radian: what a unit or the result of an expression
/// measures.
struct Exponents {
  int metre = 0;
  int kilogram = 0;
  int second = 0;
  int radian = 0;
  bool operator==(const Exponents&) const = default;
};

/// A value in coherent SI units with what it measures.
struct Measure {
  double value = std::numeric_limits<double>::quiet_NaN();
  Exponents exponents;
};

/// How a dimension is spoken of in messages, in the schema and in the manual.
struct DimensionText {
  std::string noun;     ///< "a length"
  std::string si_unit;  ///< "m", as UDUNITS writes it
  std::string example;  ///< "12 m"
};

const DimensionText& text_of(Dimension dimension);

/// A number in SI units with the dimension that its unit had.
struct Quantity {
  double value = std::numeric_limits<double>::quiet_NaN();
  Dimension dimension = Dimension::ratio;
};

/// The text is not a quantity of the dimension that is due. what() completes a sentence that begins
/// with the name of the key: `"3 m" is a length; a speed is due, for example "3 m/min"`.
class QuantityError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a number with its unit and converts it to SI.
///
/// Units are those of UDUNITS-2 (`t` is the tonne, `h` the hour, `rad` is no plain number) and,
/// added here, `deg`, `rev`, `Nm` and `tf`, with decimal prefixes where they make sense (`kNm`).
///
/// @param text the number and the unit, the blank between them may be missing: "860 t", "45deg".
/// @param allowed dimensions of which one is due; the first that fits is returned.
/// @throws QuantityError if the text is no finite number, has no unit where one is due, an unknown
///   or ambiguous unit ("ton" is 907 kg to UDUNITS, 1000 kg to a shipyard), or another dimension.
/// @throws std::runtime_error if the unit database of UDUNITS-2 is not installed.
Quantity parse_quantity(std::string_view text, const std::vector<Dimension>& allowed);

/// The value in SI units of a text that must have the one dimension. @throws as parse_quantity.
double parse_quantity(std::string_view text, Dimension dimension);

/// Reads a number with any unit of mechanics, or none. @throws as parse_quantity.
Measure parse_measure(std::string_view text);

/// The SI value and the exponents of one of a unit ("kN", "min"); none if nobody knows it.
std::optional<Measure> find_unit(const std::string& unit);

/// A measure as the first of the allowed dimensions that it has (a mass where a load is due becomes
/// its weight). None if it has none of them.
std::optional<Quantity> as_quantity(const Measure& measure, const std::vector<Dimension>& allowed);

/// "a length", or "of the unit kg m^2/s" where nobody has a name for it.
std::string text_of(const Exponents& exponents);

/// "; a speed is due, for example "3 m/min"": the end of every message about a quantity.
std::string what_is_due(const std::vector<Dimension>& allowed);

/// Reads a plain finite number; the whole text must be the number. @throws QuantityError.
double parse_number(std::string_view text);

/// A value in SI units as a writer of input would say it, in the unit of the dimension's example:
/// "12 m", "3 m/min", "45 deg", "0.5 deg/s", "860 t", "250 kN"; what is small beside that unit in
/// SI's. Six digits at most.
std::string format_quantity(double in_si, Dimension dimension);

/// "a length", "a length or an angle", "a length, an angle or a force".
std::string nouns_of(const std::vector<Dimension>& dimensions);

}  // namespace blocklift::pipeline

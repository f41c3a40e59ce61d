#include "pipeline/declaration/expression.h"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"

namespace blocklift::pipeline {
namespace {

constexpr double pi = 3.14159265358979323846;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = {"sqrt", "abs",   "min",   "max",  "sin",   "cos",
                                                 "tan",  "asin",  "acos",  "atan", "atan2", "exp",
                                                 "ln",   "log10", "round", "sign"};
  return names;
}

bool is_function(std::string_view name) {
  return std::find(function_names().begin(), function_names().end(), name) !=
         function_names().end();
}

// Functions of angles: `radian` points to what one radian counts in the present system of units.
double radians(const void* radian) { return *static_cast<const double*>(radian); }
double sine(void* radian, double x) { return std::sin(x / radians(radian)); }
double cosine(void* radian, double x) { return std::cos(x / radians(radian)); }
double tangent(void* radian, double x) { return std::tan(x / radians(radian)); }
double arc_sine(void* radian, double x) { return std::asin(x) * radians(radian); }
double arc_cosine(void* radian, double x) { return std::acos(x) * radians(radian); }
double arc_tangent(void* radian, double x) { return std::atan(x) * radians(radian); }
double arc_tangent2(void* radian, double y, double x) { return std::atan2(y, x) * radians(radian); }

double square_root(double x) { return std::sqrt(x); }
double magnitude(double x) { return std::abs(x); }
double smaller(double a, double b) { return std::min(a, b); }
double larger(double a, double b) { return std::max(a, b); }
double exponential(double x) { return std::exp(x); }
double natural_logarithm(double x) { return std::log(x); }
double decimal_logarithm(double x) { return std::log10(x); }
double nearest_integer(double x) { return std::round(x); }
double sign_of(double x) { return x > 0 ? 1 : (x < 0 ? -1 : 0); }

/// Sizes of metre, kilogram, second and radian.
using BaseUnits = std::array<double, 4>;

std::array<int, 4> powers_of(const Exponents& e) {
  return {e.metre, e.kilogram, e.second, e.radian};
}

/// One expression, translated for the parser: every name is a variable of it.
class Expression {
 public:
  Expression(std::string_view text, const Parameters& parameters)
      : text_(text), parameters_(parameters) {
    translate();
    define_functions();
    try {
      parser_.SetExpr(translated_);
    } catch (const mu::Parser::exception_type& error) {
      refuse(error);
    }
  }

  /// Value with base units of these sizes.
  double evaluate(const BaseUnits& sizes) {
    radian_ = sizes[3];
    for (Name& name : names_) {
      name.value = name.measure.value;
      const std::array<int, 4> powers = powers_of(name.measure.exponents);
      for (std::size_t i = 0; i < 4; ++i) name.value *= std::pow(sizes[i], powers[i]);
    }
    try {
      return parser_.Eval();
    } catch (const mu::Parser::exception_type& error) {
      refuse(error);
    }
  }

 private:
  struct Name {
    Measure measure;
    double value;
  };

  [[noreturn]] void fail(const std::string& what, std::vector<std::string> hints = {}) const {
    throw ExpressionError(fmt::format("\"{}\" {}", text_, what), std::move(hints));
  }

  [[noreturn]] void refuse(const mu::Parser::exception_type& error) const {
    switch (error.GetCode()) {
      case mu::ecUNEXPECTED_EOF:
      case mu::ecEMPTY_EXPRESSION:
        fail("ends where a value is due");
      case mu::ecMISSING_PARENS:
        fail("lacks a closing bracket");
      case mu::ecUNEXPECTED_PARENS:
        fail("has a bracket where none may stand");
      case mu::ecUNEXPECTED_OPERATOR:
        fail("has an operator where a value is due");
      case mu::ecTOO_MANY_PARAMS:
        fail("gives a function too many arguments");
      case mu::ecTOO_FEW_PARAMS:
        fail("gives a function too few arguments");
      case mu::ecMISSING_ELSE_CLAUSE:
        fail("has a condition without \":\"", {"a condition reads: a > b ? c : d"});
      case mu::ecUNEXPECTED_VAR:
      case mu::ecUNEXPECTED_VAL:
      case mu::ecUNEXPECTED_FUN:
        fail("lacks an operator between two values", {"a product is written with *: 2 * span"});
      default:
        fail("is no expression");
    }
  }

  char at(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
  void skip_blanks() {
    while (is_blank(at(position_))) ++position_;
  }
  std::string word() {
    const std::size_t begin = position_;
    while (is_letter(at(position_)) || is_digit(at(position_))) ++position_;
    return std::string(text_.substr(begin, position_ - begin));
  }

  std::string variable(const Measure& measure) {
    names_.push_back({measure, measure.value});
    std::string name = fmt::format("v{}", names_.size());
    parser_.DefineVar(name, &names_.back().value);
    return name;
  }

  std::string digits() {
    const std::size_t begin = position_;
    while (is_digit(at(position_))) ++position_;
    if (at(position_) == '.') ++position_;
    while (is_digit(at(position_))) ++position_;
    const std::size_t mantissa = position_;
    if (at(position_) == 'e' || at(position_) == 'E') {
      ++position_;
      if (at(position_) == '+' || at(position_) == '-') ++position_;
      if (is_digit(at(position_))) {
        while (is_digit(at(position_))) ++position_;
      } else {
        position_ = mantissa;
      }
    }
    return std::string(text_.substr(begin, position_ - begin));
  }

  /// A number with the units that follow it, "3 m^2" or "20 kN s", as one factor.
  void translate_number() {
    std::string factor = "(" + digits();
    for (;;) {
      const std::size_t before = position_;
      skip_blanks();
      if (!is_letter(at(position_))) {
        position_ = before;
        break;
      }
      const std::string unit = word();
      factor += "*" + variable(unit_named(unit, true));
      if (at(position_) == '^' && is_digit(at(position_ + 1))) {
        ++position_;
        factor += "^" + digits();
      }
    }
    translated_ += factor + ")";
  }

  Measure unit_named(const std::string& name, bool after_number) const {
    if (name == "ton" || name == "tons") {
      fail("is ambiguous: there are tons of 907, 1000 and 1016 kg", {"write \"t\" for 1000 kg"});
    }
    if (const std::optional<Measure> unit = find_unit(name)) return *unit;
    if (after_number && parameters_.find(name)) {
      fail(fmt::format("has the parameter \"{}\" right behind a number", name),
           {fmt::format("a product is written with *: 2 * {}", name)});
    }
    fail(fmt::format("uses \"{}\", which is no parameter and no unit", name),
         {names_hint("the parameters are", parameters_.names(), name)});
  }

  void translate_word() {
    const std::string name = word();
    const std::size_t end = position_;
    skip_blanks();
    const bool is_call = at(position_) == '(';
    position_ = end;
    if (is_call) {
      if (!is_function(name)) {
        fail(fmt::format("calls \"{}\", which is no function", name),
             {names_hint("the functions are", function_names(), name)});
      }
      translated_ += name;
    } else if (const Measure* parameter = parameters_.find(name)) {
      if (std::isnan(parameter->value)) throw UnreadParameter(name);
      translated_ += variable(*parameter);
    } else if (name == "pi") {
      translated_ += variable({pi, {}});
    } else {
      translated_ += variable(unit_named(name, false));
    }
  }

  void translate() {
    position_ = text_.find('=') + 1;
    while (position_ < text_.size()) {
      const char c = at(position_);
      if (is_digit(c) || (c == '.' && is_digit(at(position_ + 1)))) {
        translate_number();
      } else if (is_letter(c)) {
        translate_word();
      } else if (is_blank(c) ||
                 std::string_view("+-*/^(),<>=!?:&|").find(c) != std::string_view::npos) {
        translated_ += is_blank(c) ? ' ' : c;
        ++position_;
      } else {
        fail(fmt::format("has the character \"{}\", which no expression has", c));
      }
    }
    if (translated_.find_first_not_of(' ') == std::string::npos) fail("ends where a value is due");
  }

  void define_functions() {
    parser_.ClearConst();
    parser_.ClearFun();
    parser_.DefineFun("sqrt", square_root);
    parser_.DefineFun("abs", magnitude);
    parser_.DefineFun("min", smaller);
    parser_.DefineFun("max", larger);
    parser_.DefineFun("exp", exponential);
    parser_.DefineFun("ln", natural_logarithm);
    parser_.DefineFun("log10", decimal_logarithm);
    parser_.DefineFun("round", nearest_integer);
    parser_.DefineFun("sign", sign_of);
    parser_.DefineFunUserData("sin", sine, &radian_);
    parser_.DefineFunUserData("cos", cosine, &radian_);
    parser_.DefineFunUserData("tan", tangent, &radian_);
    parser_.DefineFunUserData("asin", arc_sine, &radian_);
    parser_.DefineFunUserData("acos", arc_cosine, &radian_);
    parser_.DefineFunUserData("atan", arc_tangent, &radian_);
    parser_.DefineFunUserData("atan2", arc_tangent2, &radian_);
  }

  std::string_view text_;
  const Parameters& parameters_;
  std::size_t position_ = 0;
  std::string translated_;
  std::deque<Name> names_;  // the parser keeps addresses of the values
  double radian_ = 1;
  mu::Parser parser_;
};

/// The power with which a value grows when one base unit's size is multiplied by `factor`.
std::optional<int> power_of_growth(double ratio, double factor) {
  if (!(ratio > 0)) return std::nullopt;
  const double power = std::log(ratio) / std::log(factor);
  const double whole = std::round(power);
  if (std::abs(power - whole) > 1e-6 || std::abs(whole) > 20) return std::nullopt;
  return static_cast<int>(whole);
}

/// None if the value does not grow by a whole power of each base unit. The value must not be zero.
std::optional<Exponents> find_exponents(Expression& expression, double value) {
  // Factors with no simple relation to each other, so that different growths do not agree by
  // chance.
  constexpr std::array<double, 4> factors = {1.7320508, 2.2360680, 1.3956124, 1.6180340};
  std::array<int, 4> powers{};
  for (std::size_t i = 0; i < 4; ++i) {
    BaseUnits sizes = {1, 1, 1, 1};
    sizes[i] = factors[i];
    const auto power = power_of_growth(expression.evaluate(sizes) / value, factors[i]);
    if (!power) return std::nullopt;
    powers[i] = *power;
  }
  // All together, and far larger and smaller: conditions on values of no dimension change sides
  // then.
  for (const double scale : {1.0, 1e5, 1e-5}) {
    BaseUnits sizes{};
    double expected = value;
    for (std::size_t i = 0; i < 4; ++i) {
      sizes[i] = factors[i] * scale;
      expected *= std::pow(sizes[i], powers[i]);
    }
    const double together = expression.evaluate(sizes);
    if (!(std::abs(together - expected) <= 1e-9 * std::abs(expected))) return std::nullopt;
  }
  return Exponents{powers[0], powers[1], powers[2], powers[3]};
}

struct Result {
  double value;
  std::optional<Exponents> exponents;  ///< none for zero, which says nothing
};

Result evaluate(std::string_view text, const Parameters& parameters) {
  Expression expression(text, parameters);
  const double value = expression.evaluate({1, 1, 1, 1});
  if (!std::isfinite(value)) {
    throw ExpressionError(
        fmt::format("\"{}\" gives no finite number", text),
        {"is something divided by zero, or the root of a negative number taken?"});
  }
  if (value == 0) return {value, std::nullopt};
  const std::optional<Exponents> exponents = find_exponents(expression, value);
  if (!exponents) {
    throw ExpressionError(fmt::format("\"{}\" has no dimension", text),
                          {"it adds or compares values of different dimensions, or takes a "
                           "function of one that is no "
                           "plain number (an angle is none: divide it by 1 rad)"});
  }
  return {value, exponents};
}

[[noreturn]] void fail_on_zero(std::string_view text) {
  throw ExpressionError(fmt::format("\"{}\" is zero, which does not say what it measures", text),
                        {"write it with its unit, for example \"0 m\""});
}

}  // namespace

void Parameters::set(std::string name, const Measure& value) {
  for (auto& [known, measure] : values_) {
    if (known != name) continue;
    measure = value;
    return;
  }
  values_.emplace_back(std::move(name), value);
}

const Measure* Parameters::find(std::string_view name) const {
  for (const auto& [known, measure] : values_) {
    if (known == name) return &measure;
  }
  return nullptr;
}

std::vector<std::string> Parameters::names() const {
  std::vector<std::string> names;
  for (const auto& [name, measure] : values_) names.push_back(name);
  return names;
}

bool is_expression(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '=';
}

bool is_parameter_name(std::string_view text) {
  static constexpr std::array<std::string_view, 14> units = {
      "m", "mm", "cm", "km", "kg", "t", "s", "min", "h", "N", "kN", "rad", "deg", "pi"};
  return !text.empty() && is_letter(text.front()) && !is_function(text) &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return is_letter(c) || is_digit(c); }) &&
         std::find(units.begin(), units.end(), text) == units.end();
}

Measure evaluate_expression(std::string_view text, const Parameters& parameters) {
  const Result result = evaluate(text, parameters);
  if (!result.exponents) fail_on_zero(text);
  return {result.value, *result.exponents};
}

Quantity evaluate_expression(std::string_view text, const Parameters& parameters,
                             const std::vector<Dimension>& allowed) {
  const Result result = evaluate(text, parameters);
  if (!result.exponents && allowed.size() == 1) return {0.0, allowed.front()};
  if (!result.exponents) fail_on_zero(text);
  const auto quantity = as_quantity({result.value, *result.exponents}, allowed);
  if (quantity) return *quantity;
  throw ExpressionError(
      fmt::format("\"{}\" is {}{}", text, text_of(*result.exponents), what_is_due(allowed)));
}

}  // namespace blocklift::pipeline

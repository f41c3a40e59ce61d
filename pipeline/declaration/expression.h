#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/declaration/quantity.h"

namespace blocklift::pipeline {

/// Named values that expressions of one file may use.
class Parameters {
 public:
  void set(std::string name, const Measure& value);
  /// Null if there is none of that name.
  const Measure* find(std::string_view name) const;
  std::vector<std::string> names() const;

 private:
  std::vector<std::pair<std::string, Measure>> values_;
};

/// An expression cannot be used. what() completes a sentence that begins with the name of the key,
/// as that of QuantityError; hints say what is allowed.
class ExpressionError : public QuantityError {
 public:
  ExpressionError(const std::string& message, std::vector<std::string> hints = {})
      : QuantityError(message), hints_(std::move(hints)) {}
  const std::vector<std::string>& hints() const { return hints_; }

 private:
  std::vector<std::string> hints_;
};

/// An expression uses a parameter whose own value could not be read, which has been complained
/// about.
class UnreadParameter : public ExpressionError {
  using ExpressionError::ExpressionError;
};

/// Does a text begin with an equals sign, so that an expression stands behind it?
bool is_expression(std::string_view text);

/// Is the text a name that an expression can use: a letter first, then letters, digits and _, and
/// no function, constant or unit of every day's use?
bool is_parameter_name(std::string_view text);

/// Evaluates `= boom / 2 + 30 cm`.
///
/// A number directly before a unit counts as one factor; elsewhere a name is a parameter or else a
/// unit. Trigonometric functions take and give angles. The dimension of the result is found by
/// evaluating the expression again with metre, kilogram, second and radian of other sizes, one
/// after another and all together, near and far from their own: a result that has a dimension grows
/// by a whole power of each.
///
/// @throws ExpressionError if a name is unknown, the expression is malformed, its result is not
///   finite or has no dimension because it adds or compares what cannot be added.
Measure evaluate_expression(std::string_view text, const Parameters& parameters);

/// The same as a quantity of one of the allowed dimensions; zero has the only one that is allowed.
/// @throws ExpressionError also if the dimension is not allowed, or zero could have several.
Quantity evaluate_expression(std::string_view text, const Parameters& parameters,
                             const std::vector<Dimension>& allowed);

}  // namespace blocklift::pipeline

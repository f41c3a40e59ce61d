#pragma once

#include <vector>

#include "pipeline/declaration/format.h"

namespace blocklift::pipeline {

/// Parameters as a file gives them, in its order.
using ParameterValues = std::vector<Named<Located<Measure>>>;

/// A value of any dimension: a number with its unit, a plain number, or an expression.
Format<Measure> measure();

/// Names with values, which expressions of the same file may use. Each is made known to the reading
/// as it is read, so that it may use those above it; where the reading has another value for it
/// from outside, that one counts.
Format<ParameterValues> parameters_format();

/// Names with values that take the place of parameters in another file.
Format<ParameterValues> parameter_overrides_format();

}  // namespace blocklift::pipeline

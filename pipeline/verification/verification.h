#pragma once

#include <functional>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// One figure of the product held against its reference.
struct VerificationRow {
  std::string quantity;    ///< what it is, with its conditions: "tip at 10 s, x"
  std::string unit;        ///< of the four numbers, "1" for a plain number
  double reference = 0.0;  ///< published, in closed form, or computed independently
  double computed = 0.0;   ///< by this program
  double error = 0.0;      ///< |computed - reference|
  double tolerance = 0.0;  ///< largest error that is allowed, derived where the case is defined
  std::string source;      ///< of the reference; empty: that of the whole case
  std::string note = {};   ///< why it fails, where the numbers alone do not say so

  /// False as well where the error is not a number.
  bool pass() const { return error <= tolerance; }
};

/// A figure against its reference.
VerificationRow compare(std::string quantity, std::string unit, double reference, double computed,
                        double tolerance, std::string source = {});

/// A figure that should vanish (a residual, a drift), held below a bound.
VerificationRow bound(std::string quantity, std::string unit, double computed, double largest,
                      std::string source = {});

/// One entry of the verification suite: what the program computes in a few seconds and holds
/// against references. A stage of the program makes a list of these (see suite.h); nothing else is
/// needed to take part.
struct VerificationCase {
  std::string name;    ///< "heavy-top": lower case, words joined by hyphens, unique in the suite
  std::string stage;   ///< "dynamics", "structure", ...
  std::string source;  ///< where its references come from
  /// Computes the figures. May throw: that is a failure of the case.
  std::function<std::vector<VerificationRow>()> compute;
};

/// The rows of a case, each with its source. What is thrown becomes a row that fails and says why.
std::vector<VerificationRow> run(const VerificationCase& verification);

/// Does the case match the pattern: a part of `stage/name`, or a glob (* ? [...]) of the whole name
/// or of the whole `stage/name`?
bool matches(const VerificationCase& verification, const std::string& pattern);

}  // namespace blocklift::pipeline

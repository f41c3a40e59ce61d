#include "pipeline/verification/verification.h"

#include <fnmatch.h>

#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace blocklift::pipeline {

VerificationRow compare(std::string quantity, std::string unit, double reference, double computed,
                        double tolerance, std::string source) {
  return {.quantity = std::move(quantity),
          .unit = std::move(unit),
          .reference = reference,
          .computed = computed,
          .error = std::abs(computed - reference),
          .tolerance = tolerance,
          .source = std::move(source)};
}

VerificationRow bound(std::string quantity, std::string unit, double computed, double largest,
                      std::string source) {
  return compare(std::move(quantity), std::move(unit), 0.0, computed, largest, std::move(source));
}

std::vector<VerificationRow> run(const VerificationCase& verification) {
  std::vector<VerificationRow> rows;
  try {
    rows = verification.compute();
    if (rows.empty()) throw std::runtime_error("the case computed nothing");
  } catch (const std::exception& error) {
    VerificationRow failure =
        compare("runs to its end", "1", 1.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
    failure.note = error.what();
    rows = {std::move(failure)};
  }
  for (VerificationRow& row : rows) {
    if (row.source.empty()) row.source = verification.source;
  }
  return rows;
}

bool matches(const VerificationCase& verification, const std::string& pattern) {
  const std::string whole = verification.stage + "/" + verification.name;
  return whole.find(pattern) != std::string::npos ||
         fnmatch(pattern.c_str(), verification.name.c_str(), 0) == 0 ||
         fnmatch(pattern.c_str(), whole.c_str(), 0) == 0;
}

}  // namespace blocklift::pipeline

#pragma once

#include <string>

#include <gtest/gtest.h>

#include "pipeline/files/lift_case/lift_case.h"
#include "tests/pipeline/spreader_lift.h"

namespace blocklift::pipeline::test {

/// What is said about a lift, with no models but those beside its case.
inline std::string complaints_about(const SampleLift& lift) {
  const TemporaryFolder folder;
  lift.write(folder);
  Diagnostics diagnostics;
  ModelLibrary library({});
  const auto lift_case = read_lift_case("case.yaml", library, diagnostics);
  EXPECT_EQ(lift_case.has_value(), !diagnostics.has_errors());
  return diagnostics.to_text();
}

/// What is said of the sample lift with one passage of its case replaced.
inline std::string complaints_about_case(const std::string& old_passage,
                                         const std::string& new_passage) {
  SampleLift lift;
  lift.lift_case = with(lift.lift_case, old_passage, new_passage);
  return complaints_about(lift);
}

}  // namespace blocklift::pipeline::test

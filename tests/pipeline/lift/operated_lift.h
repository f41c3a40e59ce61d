#pragma once

#include <string>

#include "pipeline/lift/lift_run.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline::test {

/// Mass of the sample lift's load: a box of 7 x 6 x 2 m.
inline LoadMass sample_mass() {
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2, 0, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  return load;
}

/// The sample lift with another operation, and what comes behind it.
inline LiftCase lift_with_operation(const std::string& operation, const std::string& more = "") {
  SampleLift parts;
  const std::size_t begin = parts.lift_case.find("operation:");
  const std::size_t end = parts.lift_case.find("settle:");
  parts.lift_case.replace(begin, end - begin, "operation:\n" + operation);
  parts.lift_case += more;
  const TemporaryFolder folder;
  parts.write(folder);
  return read_lift_case("case.yaml");
}

inline LiftRun run_sample(const LiftCase& lift_case, const RunExtent& extent = {}) {
  const auto nobody_watches = [](auto&&...) {};
  return run_lift(lift_case, prepare_lift(lift_case, sample_mass(), nobody_watches), nobody_watches,
                  extent);
}

}  // namespace blocklift::pipeline::test

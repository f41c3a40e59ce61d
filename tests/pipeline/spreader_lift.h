#pragma once

#include <string>

#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline::test {

/// The sample's plate on one hook: two slings of 2.5 m to a bar of 4 m, from whose ends, over the
/// lugs, slings of 1.5 m go down. The hook is 1.5 m over the bar's upper eyes.
inline SampleLift spreader_lift() {
  SampleLift lift;
  lift.lift_case = R"(case: spreader-lift
gravity: 9.81 m/s^2
load: {model: plate, position: [-4 m, 5 m, 0.8 m]}
cranes:
  C1:
    model: gantry
    start: {travel: 0 m, traverse: 5 m, left: 5 m, right: 2 m}
spreaders:
  B1:
    length: 4 m
    section: {pipe: [168.3 mm, 8 mm]}
    yield_stress: 355 MPa
    buckling_curve: a
    upper_eye: 0.2 m
    lower_eye: 0.1 m
ropes:
  U1: {from: C1.left, to: B1.upper_a, model: ropes/tackle, length: 2.5 m}
  U2: {from: C1.left, to: B1.upper_b, model: ropes/tackle, length: 2.5 m}
  R1: {from: B1.lower_a, to: L1, model: ropes/tackle, length: 1.5 m}
  R2: {from: B1.lower_b, to: L2, model: ropes/tackle, length: 1.5 m}
operation:
  - stage: hoist up
    pause: 2 s
    moves:
      - {drives: [C1.left], by: -1 m}
settle: 2 s
dynamics: {relative_tolerance: 1e-8}
)";
  return lift;
}

/// The sample's plate below a frame of 4 x 2 m: four slings of 3 m from the hook to its corners,
/// and four of 2 m from there to the plate's two lugs.
inline SampleLift frame_lift() {
  SampleLift lift = spreader_lift();
  lift.lift_case =
      with(lift.lift_case, "  B1:\n    length: 4 m\n", "  B1:\n    length: 4 m\n    width: 2 m\n");
  lift.lift_case = with(lift.lift_case, "left: 5 m", "left: 4 m");
  const std::size_t begin = lift.lift_case.find("ropes:\n"),
                    end = lift.lift_case.find("operation:");
  lift.lift_case.replace(begin, end - begin, R"(ropes:
  U1: {from: C1.left, to: B1.upper_1, model: ropes/tackle, length: 3 m}
  U2: {from: C1.left, to: B1.upper_2, model: ropes/tackle, length: 3 m}
  U3: {from: C1.left, to: B1.upper_3, model: ropes/tackle, length: 3 m}
  U4: {from: C1.left, to: B1.upper_4, model: ropes/tackle, length: 3 m}
  R1: {from: B1.lower_1, to: L1, model: ropes/tackle, length: 2 m}
  R2: {from: B1.lower_2, to: L2, model: ropes/tackle, length: 2 m}
  R3: {from: B1.lower_3, to: L2, model: ropes/tackle, length: 2 m}
  R4: {from: B1.lower_4, to: L1, model: ropes/tackle, length: 2 m}
)");
  return lift;
}

}  // namespace blocklift::pipeline::test

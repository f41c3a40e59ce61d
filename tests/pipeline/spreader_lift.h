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

}  // namespace blocklift::pipeline::test

#pragma once

#include <string>

#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline::test {

// A box of 10 t on one hook by two slings that run over its round deck edges to lugs below them.
// The part of each sling between edge and lug is plumb, since the pin stands as far off the round's
// axis as its radius.

inline const std::string sling_over_edge_block = R"(kind: block
materials:
  steel: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, yield_stress: 235 MPa}
mass: 10 t
centre_of_mass: [2 m, 0 m, 0.5 m]
plates:
  bottom: {normal: z, at: 0 m, x: [0 m, 4 m], y: [-1 m, 1 m], thickness: 20 mm}
  deck: {normal: z, at: 1 m, x: [0 m, 4 m], y: [-1 m, 1 m], thickness: 20 mm}
  webs: {normal: x, at: {from: 0 m, to: 4 m, spacing: 2 m}, y: [-1 m, 1 m], z: [0 m, 1 m], thickness: 10 mm}
  centre: {normal: y, at: 0 m, x: [0 m, 4 m], z: [0 m, 1 m], thickness: 15 mm}
pads:
  left_pad: {plate: centre, normal: y, at: 0 m, x: [0 m, 0.5 m], z: [0.1 m, 0.6 m], thickness: 30 mm}
  right_pad: {plate: centre, normal: y, at: 0 m, x: [3.5 m, 4 m], z: [0.1 m, 0.6 m], thickness: 30 mm}
lugs:
  L1: {pad: left_pad, normal: y, at: 0 m, x: [-0.3 m, 0 m], z: [0.2 m, 0.5 m], thickness: 40 mm, pin: [-0.15 m, 0 m, 0.35 m]}
  L2: {pad: right_pad, normal: y, at: 0 m, x: [4 m, 4.3 m], z: [0.2 m, 0.5 m], thickness: 40 mm, pin: [4.15 m, 0 m, 0.35 m]}
edges:
  aft: {from: [0 m, -1 m, 1 m], to: [0 m, 1 m, 1 m], outside: [-1, 0, 1], radius: 0.15 m}
  fore: {from: [4 m, -1 m, 1 m], to: [4 m, 1 m, 1 m], outside: [1, 0, 1], radius: 0.15 m}
)";

inline const std::string sling_over_edge_case = R"(case: over-edges
gravity: 9.81 m/s^2
load: {model: plate, position: [-4 m, 5 m, 2 m]}
cranes:
  C1:
    model: gantry
    start: {travel: 0 m, traverse: 5 m, left: 4 m, right: 5 m}
ropes:
  R1: {from: C1.left, to: L1, over: [aft], model: ropes/tackle, length: 4 m}
  R2: {from: C1.left, to: L2, over: [fore], model: ropes/tackle, length: 4 m}
operation:
  - stage: hoist up
    pause: 2 s
    moves:
      - {drives: [C1.left], by: -0.5 m}
  - stage: carry
    moves:
      - {drives: [C1.travel], by: 3 m, speed: 15 m/min}
      - {drives: [C1.traverse], by: 1 m}
settle: 5 s
)";

// The same box on one hook in two baskets that cross below it, round its four lower edges.

inline const std::string basket_edges = R"(edges:
  aft: {from: [0 m, -1 m, 0 m], to: [0 m, 1 m, 0 m], outside: [-1, 0, -1], friction: 0.3}
  fore: {from: [4 m, -1 m, 0 m], to: [4 m, 1 m, 0 m], outside: [1, 0, -1], friction: 0.3}
  port: {from: [0 m, -1 m, 0 m], to: [4 m, -1 m, 0 m], outside: [0, -1, -1], friction: 0.3}
  starboard: {from: [0 m, 1 m, 0 m], to: [4 m, 1 m, 0 m], outside: [0, 1, -1], friction: 0.3}
)";

inline const std::string basket_case = R"(case: baskets
gravity: 9.81 m/s^2
load: {model: plate, position: [-4 m, 5 m, 1 m]}
cranes:
  C1:
    model: gantry
    start: {travel: 0 m, traverse: 5 m, left: 5 m, right: 5 m}
ropes:
  R1: {from: C1.left, to: C1.left, over: [aft, fore], model: ropes/tackle, length: 12.94 m}
  R2: {from: C1.left, to: C1.left, over: [port, starboard], model: ropes/tackle, length: 10.24 m}
operation:
  - stage: hoist up
    pause: 2 s
    moves:
      - {drives: [C1.left], by: -0.5 m}
  - stage: carry
    moves:
      - {drives: [C1.travel], by: 3 m, speed: 15 m/min}
settle: 5 s
)";

inline SampleLift basket_lift() {
  SampleLift lift;
  lift.lift_case = basket_case;
  lift.block = sling_over_edge_block.substr(0, sling_over_edge_block.find("edges:")) + basket_edges;
  return lift;
}

inline SampleLift sling_over_edge_lift() {
  SampleLift lift;
  lift.lift_case = sling_over_edge_case;
  lift.block = sling_over_edge_block;
  return lift;
}

}  // namespace blocklift::pipeline::test

#pragma once

#include <stdexcept>
#include <string>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline::test {

// A small, sound lift: one crane with two hooks lifts a plate of 10 t by two slings.

inline const std::string sample_crane = R"(kind: crane
title: Small gantry crane
bodies:
  gantry:
    mass: 100 t
    centre_of_mass: [0 m, 5 m, 8 m]
    radii_of_gyration: [4 m, 3 m, 4 m]
    wind_areas:
      - {area: 20 m^2, normal: [1, 0, 0], centre: [0 m, 5 m, 9 m]}
  trolley: {mass: 8 t, inertia: {xx: 8 t m^2, yy: 10 t m^2, zz: 12 t m^2, xy: 1 t m^2}}
joints:
  travel: {kind: prismatic, child: gantry, axis: [1, 0, 0]}
  traverse: {kind: prismatic, parent: gantry, child: trolley, axis: [0, 1, 0], position: [0 m, 0 m, 10 m]}
drives:
  travel: {joint: travel, speed: 30 m/min, acceleration: 0.1 m/s^2, jerk: 0.2 m/s^3, range: [-50 m, 50 m]}
  traverse: {joint: traverse, speed: 20 m/min, acceleration: 0.1 m/s^2, jerk: 0.2 m/s^3, range: [1 m, 9 m]}
hoists:
  left:
    body: trolley
    sheave: [-2 m, 0 m, 0 m]
    hook_block: {mass: 500 kg, wind_area: 1 m^2}
    rope: ropes/tackle
    crane_stiffness: 10 MN/m
    capacity: 10 t
    winch: {speed: 6 m/min, acceleration: 0.1 m/s^2, jerk: 0.2 m/s^3, range: [1 m, 9 m]}
  right:
    body: trolley
    sheave: [2 m, 0 m, 0 m]
    hook_block: {mass: 500 kg}
    rope: {axial_stiffness: 200 MN, breaking_load: 100 t}
    capacity: 10 t
    winch: {speed: 6 m/min, acceleration: 0.1 m/s^2, jerk: 0.2 m/s^3, range: [1 m, 9 m]}
capacity: 20 t
)";

inline const std::string sample_rope = R"(kind: rope
axial_stiffness: 200 MN
damping_time: 5 ms
breaking_load: 1000 kN
)";

inline const std::string sample_block = R"(kind: block
materials:
  steel: {youngs_modulus: 206 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3, yield_stress: 235 MPa}
mass: 10 t
centre_of_mass: [2 m, 0 m, 0.5 m]
plates:
  bottom: {normal: z, at: 0 m, x: [0 m, 4 m], y: [-1 m, 1 m], thickness: 20 mm}
  webs: {normal: x, at: {from: 0 m, to: 4 m, spacing: 2 m}, y: [-1 m, 1 m], z: [0 m, 1 m], thickness: 10 mm}
openings:
  hole: {plate: webs, at: 2 m, y: [-0.3 m, 0.3 m], z: [0.3 m, 0.7 m]}
pads:
  left_pad: {plate: webs, normal: x, at: 0 m, y: [-0.5 m, 0.5 m], z: [0.5 m, 1 m], thickness: 30 mm}
  right_pad: {plate: webs, normal: x, at: 4 m, y: [-0.5 m, 0.5 m], z: [0.5 m, 1 m], thickness: 30 mm}
lugs:
  L1: {pad: left_pad, normal: x, at: 0 m, y: [-0.2 m, 0.2 m], z: [1 m, 1.4 m], thickness: 40 mm, pin: [0 m, 0 m, 1.2 m]}
  L2: {pad: right_pad, normal: x, at: 4 m, y: [-0.2 m, 0.2 m], z: [1 m, 1.4 m], thickness: 40 mm, pin: [4 m, 0 m, 1.2 m]}
)";

inline const std::string sample_case = R"(case: small-lift
gravity: 9.81 m/s^2
load: {model: plate, position: [-2 m, 5 m, 2 m]}
cranes:
  C1:
    model: gantry
    start: {travel: 0 m, traverse: 5 m, left: 5 m, right: 5 m}
ropes:
  R1: {from: C1.left, to: L1, model: ropes/tackle, length: 2 m}
  R2: {from: C1.right, to: L2, model: ropes/tackle, length: 2 m}
operation:
  - stage: hoist up
    pause: 5 s
    moves:
      - {drives: [C1.left, C1.right], by: -2 m}
  - stage: carry
    moves:
      - {drives: [C1.travel], by: 10 m, speed: 15 m/min}
      - {drives: [C1.traverse], follows: C1.travel, table: [[0 m, 0 m], [5 m, 1 m], [10 m, 2 m]]}
settle: 10 s
compare:
  source: a yard
  ropes: {R1: {static: 5 t}, R2: {static: 5 t, dynamic: 6 t}}
)";

inline const std::string sample_load_table_case = R"(case: table
load: {model: plate}
load_table:
  direction: [0, 0, 2]
  static: {L1: 5 t, L2: 50 kN}
  dynamic: {L1: 6 t, L2: 6 t}
)";

// 40 x 20 m, upright sides: draught 2 m at 1,640 t in water of 1,025 kg/m3.
inline const std::string sample_barge = R"(kind: vessel
hull: {barge: {length: 40 m, breadth: 20 m, depth: 6 m}}
panel_size: 4 m
mass: 1640 t
centre_of_mass: [0 m, 0 m, 3 m]
radii_of_gyration: [6 m, 11 m, 11 m]
)";

// A boom with one hoist, to stand on a vessel.
inline const std::string sample_boom = R"(kind: crane
bodies: {boom: {mass: 41 t, centre_of_mass: [10 m, 0 m, 0 m], radii_of_gyration: [1 m, 6 m, 6 m]}}
joints: {luffing: {kind: revolute, child: boom, axis: [0, -1, 0], position: [10 m, 0 m, 6 m]}}
drives: {luffing: {joint: luffing, speed: 3 deg/min, acceleration: 0.01 deg/s^2, jerk: 0.02 deg/s^3, range: [30 deg, 75 deg]}}
hoists:
  main:
    body: boom
    sheave: [40 m, 0 m, 0 m]
    hook_block: {mass: 2 t}
    rope: {axial_stiffness: 500 MN, breaking_load: 2000 t}
    capacity: 400 t
    winch: {speed: 3 m/min, acceleration: 0.05 m/s^2, jerk: 0.1 m/s^3, range: [5 m, 60 m]}
)";

/// Text with one passage replaced. @throws std::logic_error unless it occurs exactly once.
inline std::string with(std::string text, const std::string& old_passage,
                        const std::string& new_passage) {
  const std::size_t at = text.find(old_passage);
  if (at == std::string::npos || text.find(old_passage, at + 1) != std::string::npos) {
    throw std::logic_error("the passage must occur once: " + old_passage);
  }
  return text.replace(at, old_passage.size(), new_passage);
}

/// The files of the sample lift, each as it stands or with mistakes.
struct SampleLift {
  std::string lift_case = sample_case;
  std::string crane = sample_crane;
  std::string block = sample_block;
  std::string rope = sample_rope;

  /// Writes case.yaml and, beside it, the models.
  void write(const TemporaryFolder& folder) const {
    folder.write("case.yaml", lift_case);
    folder.write("gantry/crane.yaml", crane);
    folder.write("plate.yaml", block);
    folder.write("gantry/ropes/tackle.yaml", rope);
    folder.write("ropes/tackle.yaml", rope);
  }
};

}  // namespace blocklift::pipeline::test

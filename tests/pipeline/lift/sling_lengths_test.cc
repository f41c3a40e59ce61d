#include "pipeline/lift/sling_lengths.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

constexpr double gravity = 9.81;
constexpr double stiffness = 200e6;       // E A of the sample's rope, N
constexpr double half_x = 2, half_y = 1;  // of the rectangle of lugs, m
constexpr double length = 4;              // of each sling, m

/// A plate on four slings from one hook, its lugs about the middle of its frame.
test::SampleLift four_slings() {
  test::SampleLift lift;
  const std::size_t pads = lift.block.find("pads:");
  lift.block = lift.block.substr(0, pads) + R"(pads:
  near_pad: {plate: webs, normal: x, at: 0 m, y: [-1 m, 1 m], z: [0.5 m, 1 m], thickness: 30 mm}
  far_pad: {plate: webs, normal: x, at: 4 m, y: [-1 m, 1 m], z: [0.5 m, 1 m], thickness: 30 mm}
lugs:
  L1: {pad: near_pad, normal: x, at: 0 m, y: [-1 m, -0.8 m], z: [1 m, 1.4 m], thickness: 40 mm, pin: [0 m, -1 m, 1.2 m]}
  L2: {pad: far_pad, normal: x, at: 4 m, y: [-1 m, -0.8 m], z: [1 m, 1.4 m], thickness: 40 mm, pin: [4 m, -1 m, 1.2 m]}
  L3: {pad: far_pad, normal: x, at: 4 m, y: [0.8 m, 1 m], z: [1 m, 1.4 m], thickness: 40 mm, pin: [4 m, 1 m, 1.2 m]}
  L4: {pad: near_pad, normal: x, at: 0 m, y: [0.8 m, 1 m], z: [1 m, 1.4 m], thickness: 40 mm, pin: [0 m, 1 m, 1.2 m]}
)";
  lift.lift_case = R"(case: four-slings
gravity: 9.81 m/s^2
load: {model: plate, position: [-4 m, 5 m, 0.5 m]}
cranes:
  C1:
    model: gantry
    start: {travel: 0 m, traverse: 5 m, left: 5 m, right: 2 m}
ropes:
  S1: {from: C1.left, to: L1, model: ropes/tackle, length: 4 m}
  S2: {from: C1.left, to: L2, model: ropes/tackle, length: 4 m}
  S3: {from: C1.left, to: L3, model: ropes/tackle, length: 4 m}
  S4: {from: C1.left, to: L4, model: ropes/tackle, length: 4 m}
sling_tolerance: 0.01 %
operation:
  - stage: hang
    pause: 1 s
settle: 1 s
)";
  return lift;
}

LoadMass plate_mass(double beside = 0) {
  LoadMass load;
  load.mass = 10e3;
  load.p_BoBcm_B = {2 + beside, beside / 2, 0.5};
  load.I_BBcm_B = Vector3(5, 17, 20).asDiagonal() * (10e3 / 12.0);
  return load;
}

SlingLengths lengths_of(const LoadMass& load, const LoadFlexibility* flexibility = nullptr,
                        const test::SampleLift& parts = four_slings()) {
  const test::TemporaryFolder folder;
  parts.write(folder);
  const LiftCase lift_case = read_lift_case("case.yaml");
  const LiftRun run =
      run_lift(lift_case, build_lift(lift_case, load, nullptr, flexibility), [](auto&&...) {});
  return find_sling_lengths(lift_case, load, flexibility, run).value();
}

/// Tension of each of four slings under the plate's middle, N.
double even_tension() {
  const double height = std::sqrt(length * length - half_x * half_x - half_y * half_y);
  return 10e3 * gravity / 4 * length / height;
}

// Four equal slings on one hook, one longer by d: the part of d that no motion of the rigid load
// takes up is d / 4 with alternating signs, so that the sling and the one across lose E A d / (4 L)
// and the others gain as much.
TEST(SlingLengths, OfARigidLoadShareAnErrorByFours) {
  const SlingLengths lengths = lengths_of(plate_mass());
  ASSERT_EQ(lengths.slings.size(), 4U);
  EXPECT_EQ(lengths.trouble, "");
  const double change = stiffness * 1e-4 / 4;  // d = 1e-4 L
  EXPECT_NEAR(lengths.meant.tensions[0], even_tension(), 1e-3 * even_tension());
  for (int i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? -1 : 1;
    EXPECT_NEAR(lengths.errors[0].longer.tensions[i] - lengths.meant.tensions[i], sign * change,
                0.01 * change);
    EXPECT_NEAR(lengths.errors[0].shorter.tensions[i] - lengths.meant.tensions[i], -sign * change,
                0.01 * change);
  }
}

// The rest of it moves the hook over the lugs by L d / (4 a) and L d / (4 b), a and b half of the
// lugs' rectangle; the load turns until its centre hangs plumb below the hook again.
TEST(SlingLengths, TiltByAnErrorIsThatOfThePendulum) {
  const SlingLengths lengths = lengths_of(plate_mass());
  const double d = 1e-4 * length;
  const double height = std::sqrt(length * length - half_x * half_x - half_y * half_y) + 1.2 - 0.5;
  const double tilt = length * d / 4 * std::hypot(1 / half_x, 1 / half_y) / height;
  EXPECT_NEAR(lengths.meant.tilt, 0, 1e-8);
  for (const SlingLengthError& error : lengths.errors) {
    EXPECT_NEAR(error.longer.tilt, tilt, 0.01 * tilt);
    EXPECT_NEAR(error.shorter.tilt, tilt, 0.01 * tilt);
  }
}

// Of all sets of signs the alternating one is worst: E A d / L more.
TEST(SlingLengths, WorstSetIsTheAlternatingOne) {
  const SlingLengths lengths = lengths_of(plate_mass());
  const double worst = lengths.meant.tensions[0] + stiffness * 1e-4;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(lengths.worst_tensions[i], worst, 0.01 * worst);
  EXPECT_GT(lengths.worst_tilt, lengths.errors[0].longer.tilt);
}

// A load that gives way by c at each lug shares the error out: d / (4 (L / E A + c)).
TEST(SlingLengths, OfALoadThatGivesWayShareLess) {
  LoadFlexibility flexibility;
  flexibility.lugs = {"L1", "L2", "L3", "L4"};
  const double c = 3 * length / stiffness;
  flexibility.compliance = c * Eigen::MatrixXd::Identity(12, 12);
  flexibility.shapes.resize(12, 0);
  const SlingLengths lengths = lengths_of(plate_mass(), &flexibility);
  const double change = 1e-4 * length / (4 * (length / stiffness + c));
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(lengths.errors[0].longer.tensions[i] - lengths.meant.tensions[i],
                i % 2 == 0 ? -change : change, 0.02 * change);
}

// A load whose centre is beside the middle hangs level when the stretched slings reach from a hook
// over the centre to its lugs: s_i^2 less the level distance squared is the same for all.
TEST(SlingLengths, ThatHangLevelReachFromOverTheCentre) {
  const LoadMass load = plate_mass(0.05);
  const SlingLengths lengths = lengths_of(load);
  EXPECT_GT(lengths.meant.tilt, 0.01);
  ASSERT_EQ(lengths.level_lengths.size(), 4);
  EXPECT_LT(lengths.level.tilt, 1e-6);
  const Eigen::Matrix<double, 4, 2> lugs{{0, -1}, {4, -1}, {4, 1}, {0, 1}};
  Eigen::Vector4d squares;
  for (int i = 0; i < 4; ++i) {
    const double stretched = lengths.level_lengths[i] * (1 + lengths.level.tensions[i] / stiffness);
    squares[i] =
        stretched * stretched - (lugs.row(i).transpose() - load.p_BoBcm_B.head<2>()).squaredNorm();
  }
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(squares[i], squares[0], 1e-4 * squares[0]);
  // The least change: what one pair across gains, the other loses, and none all together.
  EXPECT_NEAR((lengths.level_lengths - lengths.lengths).sum(), 0, 0.002);
}

TEST(SlingLengths, AreLeftOutWithoutATolerance) {
  test::SampleLift parts = four_slings();
  parts.lift_case = test::with(parts.lift_case, "sling_tolerance: 0.01 %", "sling_tolerance: 0 %");
  const test::TemporaryFolder folder;
  parts.write(folder);
  const LiftCase lift_case = read_lift_case("case.yaml");
  const LoadMass load = plate_mass();
  const LiftRun run = run_lift(lift_case, build_lift(lift_case, load), [](auto&&...) {});
  EXPECT_FALSE(find_sling_lengths(lift_case, load, nullptr, run));
}

}  // namespace
}  // namespace blocklift::pipeline

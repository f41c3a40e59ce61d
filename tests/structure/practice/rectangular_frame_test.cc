#include "structure/practice/rectangular_frame.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace blocklift::structure {
namespace {

using Eigen::Vector3d;

constexpr double long_side = 6, short_side = 2.5;
constexpr double side_modulus = 210e9, side_shear_modulus = side_modulus / 2.6;

/// A side like a box, stiffer upright than level.
FrameMember make_side(double length, double scale) {
  FrameMember side;
  side.column = {.area = 8e-3 * scale,
                 .elastic_modulus = side_modulus,
                 .yield_stress = 355e6,
                 .length = length,
                 .second_moments = {9e-5 * scale, 4e-5 * scale},
                 .section_moduli = {7e-4, 5e-4}};
  side.torsion_constant = 7e-5 * scale;
  side.torsion_modulus = 8e-4;
  return side;
}

struct LoadedRectangle {
  FrameMember along = make_side(long_side, 1), across = make_side(short_side, 0.6);

  std::array<MemberForces, 4> under(const std::vector<PointForce>& forces) const {
    std::vector<Vector3d> points;
    for (const PointForce& force : forces) points.push_back(force.p);
    return RectangularFrame(along, across, points).largest_forces(forces);
  }
};

/// Slings from the corners' eyes, up to a point over the middle, each with the upright pull V, and
/// plumb ones below them.
std::vector<PointForce> under_one_hook(double V, double hook_height, double eye) {
  std::vector<PointForce> forces;
  for (const Vector3d& corner : RectangularFrame::corners(long_side, short_side)) {
    const double slope = V / (hook_height - eye);
    forces.push_back({corner + Vector3d(0, 0, eye), {-slope * corner.x(), -slope * corner.y(), V}});
    forces.push_back({corner - Vector3d(0, 0, 0.2), {0, 0, -V}});
  }
  return forces;
}

// Each corner's level pull is shared out by directions: N_1 = V (L/2) / h, N_2 = V (W/2) / h.
TEST(RectangularFrameTest, CornersPressTheSidesByStatics) {
  const double V = 200e3, h = 4;
  const auto sides = LoadedRectangle().under(under_one_hook(V, h, 0));
  for (const std::size_t i : {0, 1, 2, 3}) {
    const double N = V * (i % 2 == 0 ? long_side : short_side) / 2 / h;
    EXPECT_NEAR(sides[i].column.compression, N, 1e-8 * V);
    EXPECT_NEAR(sides[i].column.moments[0], 0, 1e-8 * V);
    EXPECT_NEAR(sides[i].column.moments[1], 0, 1e-8 * V);
    EXPECT_NEAR(sides[i].torsion, 0, 1e-8 * V);
  }
}

// Eyes above the axes bend each side evenly by its own share of the level pull, and twist none.
TEST(RectangularFrameTest, EyesAboveTheAxesBendTheSides) {
  const double V = 200e3, h = 4, e = 0.3;
  const auto sides = LoadedRectangle().under(under_one_hook(V, h, e));
  for (const std::size_t i : {0, 1, 2, 3}) {
    const double N = V * (i % 2 == 0 ? long_side : short_side) / 2 / (h - e);
    EXPECT_NEAR(sides[i].column.compression, N, 1e-8 * V);
    EXPECT_NEAR(sides[i].column.moments[0], N * e, 1e-8 * V);
    EXPECT_NEAR(sides[i].torsion, 0, 1e-8 * V);
  }
}

// Pulled apart at the middles of the long sides: by slope and deflection (Timoshenko, Strength of
// materials I) corners bear P L / 8 k_2 / (k_1 + k_2), k = E I / l, the middles P L / 4 less that.
TEST(RectangularFrameTest, SlingsBesideTheCornersBendItInItsPlane) {
  const double P = 50e3, y = short_side / 2;
  const LoadedRectangle frame;
  const auto sides = frame.under({{{0, -y, 0}, {0, -P, 0}}, {{0, y, 0}, {0, P, 0}}});
  const double k_1 = frame.along.column.second_moments[1] / long_side;
  const double k_2 = frame.across.column.second_moments[1] / short_side;
  const double corner = P * long_side / 8 * k_2 / (k_1 + k_2);
  const double middle = P * long_side / 4 - corner;
  for (const std::size_t i : {0, 2}) {
    EXPECT_NEAR(sides[i].column.moments[1], std::max(corner, middle), 1e-8 * P);
    EXPECT_NEAR(sides[i].column.compression, 0, 1e-8 * P);
    EXPECT_NEAR(sides[i + 1].column.moments[1], corner, 1e-8 * P);
    EXPECT_NEAR(sides[i + 1].column.compression, -P / 2, 1e-8 * P);
  }
}

// Slings of one diagonal alone twist the frame: corners pulled up and down in turn by P. Cut in the
// middles of the sides, where nothing bends for symmetry, a quarter bears V_1 and V_2 = P - V_1,
// and each bends its own side and twists the other. Least work (Castigliano) gives V_1 a = V_2 b.
TEST(RectangularFrameTest, OneDiagonalTwistsIt) {
  const double P = 30e3;
  const LoadedRectangle frame;
  std::vector<PointForce> forces;
  double sign = 1;
  for (const Vector3d& corner : RectangularFrame::corners(long_side, short_side)) {
    forces.push_back({corner, {0, 0, sign * P}});
    sign = -sign;
  }
  const auto sides = frame.under(forces);
  const double l = long_side / 2, w = short_side / 2;
  const auto& [I_1, unused_1] = frame.along.column.second_moments;
  const auto& [I_2, unused_2] = frame.across.column.second_moments;
  const double a = l * l * l / (3 * side_modulus * I_1) +
                   l * l * w / (side_shear_modulus * frame.across.torsion_constant);
  const double b = w * w * w / (3 * side_modulus * I_2) +
                   w * w * l / (side_shear_modulus * frame.along.torsion_constant);
  const double V_1 = P * b / (a + b), V_2 = P - V_1;
  for (const std::size_t i : {0, 2}) {
    EXPECT_NEAR(sides[i].column.moments[0], V_1 * l, 1e-7 * P);
    EXPECT_NEAR(sides[i].torsion, V_2 * w, 1e-7 * P);
    EXPECT_NEAR(sides[i + 1].column.moments[0], V_2 * w, 1e-7 * P);
    EXPECT_NEAR(sides[i + 1].torsion, V_1 * l, 1e-7 * P);
  }
}

// Held at its corners each side hangs through by its own share of the weight: w l^2 / 8.
TEST(RectangularFrameTest, ItsOwnWeightBendsEachSide) {
  const double weight = 12e3;
  const LoadedRectangle frame;
  std::vector<PointForce> forces;
  for (const Vector3d& corner : RectangularFrame::corners(long_side, short_side))
    forces.push_back({corner, {0, 0, weight / 4}});
  const auto sides = frame.under(forces);
  const double volume =
      2 * (frame.along.column.area * long_side + frame.across.column.area * short_side);
  for (const std::size_t i : {0, 1, 2, 3}) {
    const Column& column = i % 2 == 0 ? frame.along.column : frame.across.column;
    const double w = weight * column.area / volume;
    EXPECT_NEAR(sides[i].column.moments[0], w * column.length * column.length / 8, 1e-8 * weight);
    EXPECT_NEAR(sides[i].torsion, 0, 1e-8 * weight);
  }
}

// Forces that balance nothing: what is within is that of the frame's acceleration. Along x at the
// four corners the sides across, which the corners drag along, bend level as bars held at both ends
// do, w W^2 / 12, less what the corners yield.
TEST(RectangularFrameTest, AccelerationBendsWhatIsDraggedAlong) {
  const double F = 10e3;
  LoadedRectangle frame;
  // Slope and deflection know no stretch of the sides; that of the areas above is 4e-4 of it.
  for (FrameMember* side : {&frame.along, &frame.across}) side->column.area *= 1e6;
  std::vector<PointForce> forces;
  for (const Vector3d& corner : RectangularFrame::corners(long_side, short_side))
    forces.push_back({corner, {F / 4, 0, 0}});
  const auto sides = frame.under(forces);
  const double volume =
      2 * (frame.along.column.area * long_side + frame.across.column.area * short_side);
  const double w = F * frame.across.column.area / volume;
  // Both corners of a long side turn alike, and those of a short side against each other: the long
  // side resists with 6 E I / l, the short one with 2 E I / l.
  const double k_1 = 6 * frame.along.column.second_moments[1] / long_side;
  const double k_2 = 2 * frame.across.column.second_moments[1] / short_side;
  const double held = w * short_side * short_side / 12;
  const double corner = held * k_1 / (k_1 + k_2);
  EXPECT_NEAR(sides[1].column.moments[1],
              std::max(corner, w * short_side * short_side / 8 - corner), 1e-7 * F);
  EXPECT_NEAR(sides[0].column.moments[1], corner, 1e-7 * F);
}

// A side fails at Euler's load pi^2 E I / L^2 of its own length, whatever else bends it.
TEST(RectangularFrameTest, SidesBuckleBetweenTheirCorners) {
  const FrameMember side = make_side(long_side, 1);
  const double euler = std::numbers::pi * std::numbers::pi * side_modulus * 4e-5 / 36;
  EXPECT_TRUE(std::isinf(member_utilisation(side, {{euler * 1.0001, {0, 0}}, 0}, 1)));
  EXPECT_TRUE(std::isfinite(member_utilisation(side, {{euler * 0.9999, {0, 0}}, 0}, 1)));
  const double pressed = member_utilisation(side, {{euler / 3, {0, 0}}, 0}, 1);
  EXPECT_NEAR(pressed, euler / 3 / buckling_resistance(side.column), 1e-12);
  // Torsion by itself: von Mises of its shear stress.
  EXPECT_NEAR(member_utilisation(side, {{0, {0, 0}}, 10e3}, 2),
              std::sqrt(3.0) * 2 * 10e3 / 8e-4 / 355e6, 1e-12);
}

TEST(RectangularFrameTest, RefusesWhatIsNoFrame) {
  FrameMember thin = make_side(long_side, 1);
  thin.torsion_constant = 0;
  EXPECT_THROW(RectangularFrame(thin, make_side(short_side, 1), {}), std::invalid_argument);
  const RectangularFrame frame(make_side(long_side, 1), make_side(short_side, 1), {});
  EXPECT_THROW(frame.largest_forces({{}}), std::invalid_argument);
}

// Two second methods: slope and deflection in closed form, and an independent assembly of the beams
// in Python (numpy, 12 x 12 stiffnesses, pseudo-inverse for the free body), which gave the figure.
TEST(RectangularFrameTest, CornersRackOutOfItsPlaneByTheClosedForm) {
  const LoadedRectangle loaded;
  const auto corners = RectangularFrame::corners(long_side, short_side);
  const std::vector<Vector3d> points(corners.begin(), corners.end());
  const Eigen::MatrixXd C =
      RectangularFrame(loaded.along, loaded.across, points).flexibility(points);
  Eigen::VectorXd by_turns = Eigen::VectorXd::Zero(12);
  for (int i = 0; i < 4; ++i) by_turns[3 * i + 2] = i % 2 == 0 ? 1 : -1;
  const auto part = [](const FrameMember& bent, const FrameMember& twisted) {
    const double l = bent.column.length;
    return 4 / (l * l) /
           (l / (6 * side_modulus * bent.column.second_moments[0]) +
            twisted.column.length / (2 * side_shear_modulus * twisted.torsion_constant));
  };
  const double stiffness = part(loaded.along, loaded.across) + part(loaded.across, loaded.along);
  const double found = 4 / by_turns.dot(C * by_turns);  // P / w of each corner
  EXPECT_NEAR(found, stiffness, 1e-9 * stiffness);
  EXPECT_NEAR(found, 1391717.98564, 1e-6 * found);
  EXPECT_NEAR((C - C.transpose()).norm(), 0, 1e-12 * C.norm());
}

// In its plane slings of one diagonal press the corners and those of the other pull: a shear psi,
// in which the sides store 12 psi^2 / (1 / k_1 + 1 / k_2), k = E I / l of bending in the plane.
// Pulls (a, b) along both axes, a / b = L / W, do the work 2 a W psi.
TEST(RectangularFrameTest, CornersRackInItsPlaneByTheClosedForm) {
  const LoadedRectangle loaded;
  const auto corners = RectangularFrame::corners(long_side, short_side);
  const std::vector<Vector3d> points(corners.begin(), corners.end());
  const Eigen::MatrixXd C =
      RectangularFrame(loaded.along, loaded.across, points).flexibility(points);
  Eigen::VectorXd pulls = Eigen::VectorXd::Zero(12);
  const double a = 0.6, b = a * short_side / long_side;
  for (int i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? -1 : 1;
    pulls[3 * i] = sign * a * (corners[i].x() > 0 ? 1 : -1);
    pulls[3 * i + 1] = sign * b * (corners[i].y() > 0 ? 1 : -1);
  }
  const double k_1 = side_modulus * loaded.along.column.second_moments[1] / long_side;
  const double k_2 = side_modulus * loaded.across.column.second_moments[1] / short_side;
  const double work = std::pow(2 * a * short_side, 2) * (1 / k_1 + 1 / k_2) / 24;
  EXPECT_NEAR(pulls.dot(C * pulls), work, 1e-9 * work);
}

}  // namespace
}  // namespace blocklift::structure

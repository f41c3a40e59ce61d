#include "dynamics/marine/hull/hydrostatics.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/floating_position.h"
#include "dynamics/marine/hull/hull_shapes.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Poses {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vector3 vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Pose pose(double reach) {
    Vector4 quaternion(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    return {rotation_from_quaternion(quaternion), vector(reach)};
  }

 private:
  std::mt19937_64 engine_{5};
};

HullClusters sample_ship() {
  return HullClusters(make_ship({.length = 20,
                                 .breadth = 6,
                                 .depth = 4,
                                 .draught = 2.5,
                                 .bow_length = 8,
                                 .stern_length = 6,
                                 .transom_breadth = 3},
                                {10, 4, 3, 3}));
}

Pose moved(const Pose& X_WB, const Vector3& turn, const Vector3& shift) {
  const double angle = turn.norm();
  const Matrix3 R = angle > 0 ? rotation_about(turn / angle, angle) : Matrix3(Matrix3::Identity());
  return {R * X_WB.R, X_WB.p + shift};
}

// A box afloat upright: all by hand.
TEST(Hydrostatics, UprightBox) {
  const HullClusters box(make_box({10, 4, 2}, {5, 2, 2, 1}));
  const Hydrostatics h = calc_hydrostatics(box, Pose::translation({3, -7, 0.25}));
  EXPECT_NEAR(h.volume, 10 * 4 * 0.75, 1e-12);
  EXPECT_LT((h.p_BoC_W() - Vector3(0, 0, -1 + 0.375)).norm(), 1e-12);
  EXPECT_NEAR(h.water_plane_area, 40, 1e-12);
  EXPECT_LT(h.water_plane_moment.norm(), 1e-12);
  EXPECT_LT((h.water_plane_second_moment - Vector3(4 * 1000 / 12.0, 0, 10 * 64 / 12.0)).norm(),
            1e-10);
  EXPECT_NEAR(h.energy_over_rho_g, 40 * 0.75 * 0.75 / 2, 1e-12);
}

TEST(Hydrostatics, DryAndSunkenAndContinuousBetween) {
  const HullClusters ship = sample_ship();
  const double whole = ship.enclosed().volume;
  Poses poses;
  for (int i = 0; i < 10; ++i) {
    Pose X = poses.pose(1);
    X.p.z() = 25;
    const Hydrostatics dry = calc_hydrostatics(ship, X);
    EXPECT_EQ(dry.volume, 0);
    EXPECT_EQ(dry.force_over_rho_g().moment.norm(), 0);
    X.p.z() = -25;
    const Hydrostatics sunken = calc_hydrostatics(ship, X);
    EXPECT_NEAR(sunken.volume, whole, 1e-12 * whole);
    EXPECT_LT((sunken.p_BoC_W() - X.R * ship.enclosed().centre).norm(), 1e-11);
    EXPECT_NEAR(sunken.water_plane_area, 0, 1e-11);
    // Through the surface: the volume changes by no more than the area of the bounding sphere
    // times the step.
    double last = whole;
    for (double z = -25; z <= 25; z += 0.05) {
      X.p.z() = z;
      const double volume = calc_buoyancy(ship, X).F_Bo_W_over_rho_g.force.z();
      EXPECT_LE(volume, last + 1e-10);
      EXPECT_GE(volume, last - 0.05 * std::numbers::pi * 11 * 11);
      last = volume;
    }
  }
}

// Force and moment are minus the derivative of the energy: central differences, error O(step^2).
TEST(Hydrostatics, ForceIsTheDerivativeOfTheEnergy) {
  const HullClusters ship = sample_ship();
  Poses poses;
  constexpr double step = 1e-4;
  for (int i = 0; i < 100; ++i) {
    const Pose X = poses.pose(3);
    const ForceVector F = calc_buoyancy(ship, X).F_Bo_W_over_rho_g;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 e = step * Vector3::Unit(axis);
      const auto energy = [&](const Vector3& turn, const Vector3& shift) {
        return calc_buoyancy(ship, moved(X, turn, shift)).energy_over_rho_g;
      };
      const Vector3 none = Vector3::Zero();
      EXPECT_NEAR(F.moment[axis], -(energy(e, none) - energy(-e, none)) / (2 * step), 1e-4);
      EXPECT_NEAR(F.force[axis], -(energy(none, e) - energy(none, -e)) / (2 * step), 1e-5);
    }
  }
}

TEST(Hydrostatics, StiffnessIsTheDerivativeOfTheForce) {
  const HullClusters ship = sample_ship();
  Poses poses;
  constexpr double step = 1e-5;
  for (int i = 0; i < 100; ++i) {
    const Pose X = poses.pose(2);
    const auto K = calc_stiffness_over_rho_g(calc_hydrostatics(ship, X));
    for (int column = 0; column < 6; ++column) {
      const Vector3 e = step * Vector3::Unit(column % 3);
      const Vector3 none = Vector3::Zero();
      const auto force = [&](double sign) {
        const Pose moved_pose = column < 3 ? moved(X, sign * e, none) : moved(X, none, sign * e);
        const ForceVector F = calc_buoyancy(ship, moved_pose).F_Bo_W_over_rho_g;
        Eigen::Matrix<double, 6, 1> f;
        f << F.moment, F.force;
        return f;
      };
      const Eigen::Matrix<double, 6, 1> numeric = -(force(1) - force(-1)) / (2 * step);
      EXPECT_LT((numeric - K.col(column)).norm(), 1e-3 * (1 + K.col(column).norm())) << column;
    }
  }
}

// The volume alone, at attitudes that cut panels in every way.
TEST(Hydrostatics, VolumeAloneIsTheSame) {
  const HullClusters ship = sample_ship();
  Poses poses;
  for (int i = 0; i < 100; ++i) {
    const Pose X_WB = poses.pose(4);
    EXPECT_NEAR(calc_displaced_volume(ship, X_WB), calc_hydrostatics(ship, X_WB).volume, 1e-9);
  }
}

// Buoyancy does not hang on yaw, place, or where the origin of the body's frame lies.
TEST(Hydrostatics, DoesNotHangOnTheFrames) {
  const HullClusters ship = sample_ship();
  Poses poses;
  for (int i = 0; i < 20; ++i) {
    const Pose X_WB = poses.pose(2);
    const Pose X_BA = poses.pose(30);
    const HullClusters same(transform(X_BA.inverse(), ship.hull()));
    const Hydrostatics h = calc_hydrostatics(ship, X_WB);
    const Hydrostatics other = calc_hydrostatics(same, X_WB * X_BA);
    EXPECT_NEAR(h.volume, other.volume, 1e-9);
    const Vector3 shift = (X_WB * X_BA).p - X_WB.p;
    EXPECT_LT((h.p_BoC_W() - other.p_BoC_W() - shift).norm(), 1e-8);
    EXPECT_NEAR(h.water_plane_area, other.water_plane_area, 1e-8);
    EXPECT_NEAR(h.energy_over_rho_g, other.energy_over_rho_g, 1e-8 * (1 + h.energy_over_rho_g));
  }
}

TEST(FloatingPosition, LeavesAnUnstableBalance) {
  // A deep narrow box stands upright in unstable balance and ends up on its side.
  const HullClusters box(make_box({20, 2, 4}, {4, 2, 2, 1}));
  const FloatingBody body = {.mass = 80e3, .p_BoBcm_B = Vector3::Zero(), .water_density = 1000};
  const FloatingPosition position = find_floating_position(box, body);
  EXPECT_NEAR(position.hydrostatics.volume, 80, 1e-9);
  EXPECT_GT(position.least_metacentric_height, 0);
  EXPECT_NEAR(std::abs(position.X_WB.R(2, 1)), 1, 1e-9);
}

TEST(FloatingPosition, SaysThatAHullIsTooHeavy) {
  const HullClusters box(make_box({10, 4, 2}, {5, 2, 2, 1}));
  EXPECT_THAT(
      [&] { find_floating_position(box, {.mass = 90e3, .p_BoBcm_B = Vector3::Zero()}); },
      ThrowsMessage<ModelError>(HasSubstr("would have to displace 87.8049 m3; it encloses 80 m3")));
}

// A box that encloses 80 m3 with 0.7 kg, where 0.7 t may be meant: no draught is left.
TEST(FloatingPosition, SaysThatAHullIsTooLight) {
  const HullClusters box(make_box({10, 4, 2}, {5, 2, 2, 1}));
  EXPECT_THAT([&] { find_floating_position(box, {.mass = 0.7, .p_BoBcm_B = Vector3::Zero()}); },
              ThrowsMessage<ModelError>(HasSubstr("is its mass in tonnes (t)?")));
  EXPECT_NO_THROW(find_floating_position(box, {.mass = 70, .p_BoBcm_B = Vector3::Zero()}));
}

TEST(HullClusters, RefuseAnOpenHull) {
  Hull open("open");
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)})
    open.add_vertex(p);
  open.add_panel({0, 1, 2});
  EXPECT_THAT([&] { HullClusters{open}; }, ThrowsMessage<ModelError>(HasSubstr("not closed")));
}

}  // namespace
}  // namespace blocklift::dynamics

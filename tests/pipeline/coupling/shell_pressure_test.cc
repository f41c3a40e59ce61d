// Water on the shell of a block: the force that moves the body is the pressure that bends it.
#include "pipeline/coupling/shell_pressure.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "structure/error.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/system/matter.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HullClusters;
using dynamics::HullForce;
using dynamics::Pose;
using dynamics::Sea;
using dynamics::Vector3;
using dynamics::WaveField;

const dynamics::Water deep = {.density = 1025, .gravity = 9.81};
const Vector3 size(12, 6, 4);

/// Box of plates of 10 mm about the frame's origin, with a bulkhead amidships.
structure::BlockDescription box_block(double largest_element) {
  structure::BlockDescription block;
  block.materials = {{"steel", 206e9, 0.3, 7850, 235e6}};
  const std::array<structure::Interval, 3> all = {{{-6, 6}, {-3, 3}, {-2, 2}}};
  block.plates = {{"level", structure::Axis::z, {-2, 2}, all, 0.01, "steel"},
                  {"sides", structure::Axis::y, {-3, 3}, all, 0.01, "steel"},
                  {"across", structure::Axis::x, {-6, 0, 6}, all, 0.01, "steel"}};
  block.largest_element = largest_element;
  return block;
}

structure::ElasticModel box_model(double largest_element, int degree) {
  return {structure::generate_shell_mesh(box_block(largest_element)), {degree, {}}};
}

dynamics::Hull box_hull(int n) { return dynamics::make_box(size, {3 * n, 2 * n, n, 1}); }

HullForce hull_force(dynamics::Hull hull, const WaveField& waves) {
  return HullForce({"box", 1, std::make_shared<const HullClusters>(std::move(hull)),
                    std::make_shared<const Sea>(Sea{waves, {}})});
}

Pose pose(double heel, double trim, double height) {
  return {dynamics::rotation_about(Vector3::UnitX(), heel) *
              dynamics::rotation_about(Vector3::UnitY(), trim),
          Vector3(3, -2, height)};
}

/// Sum of the regions' wrenches about Bo in W.
dynamics::ForceVector sum_of(const structure::ShellRegions& shell, const Eigen::VectorXd& wrenches,
                             const Pose& X_WB) {
  dynamics::ForceVector sum = dynamics::ForceVector::zero();
  for (std::size_t r = 0; r < shell.regions().size(); ++r) {
    const auto w = wrenches.segment<6>(6 * r);
    sum.force += X_WB.R * Vector3(w.head<3>());
    sum.moment +=
        X_WB.R * (Vector3(w.tail<3>()) + shell.regions()[r].centre_B.cross(Vector3(w.head<3>())));
  }
  return sum;
}

TEST(ShellPressure, RegionsTogetherFeelTheForceThatMovesTheHull) {
  const structure::ElasticModel model = box_model(3, 1);
  const structure::ShellRegions shell(model, 3);
  const ShellPressure pressure(box_hull(4), shell);
  Eigen::VectorXd wrenches(static_cast<Eigen::Index>(6 * shell.regions().size()));
  const WaveField still(deep), wavy(deep, {{0.5, 0.9, 0.7, 0.2}, {0.2, 1.4, -0.5, 1}});
  dynamics::test::OneBody body;
  for (const WaveField& waves : {still, wavy}) {
    const HullForce hull = hull_force(box_hull(4), waves);
    const double rho_g = deep.density * deep.gravity, most = rho_g * size.prod();
    for (const Pose& X_WB : {pose(0, 0, 0.3), pose(0.2, -0.1, -0.4), pose(1.2, 0.4, 1),
                             pose(0.1, 0.1, -9), pose(0, 0, 9)}) {
      body.q.head<3>() = X_WB.p;
      body.q.segment<4>(3) = dynamics::quaternion_from_rotation(X_WB.R);
      body.time = 2;
      body.update();
      const dynamics::ForceVector F = hull.calc_force(body.state());
      pressure.calc_wrenches(*hull.definition().sea, !waves.is_still(), body.time, X_WB, wrenches);
      const dynamics::ForceVector sum = sum_of(shell, wrenches, X_WB);
      // In waves the hull's panels below the troughs are taken in boxes: a head of a (k d)^2/8
      // apart.
      const double allowed = waves.is_still() ? 1e-12 : 1e-3;
      EXPECT_LT((sum.force - F.force).norm(), allowed * most) << X_WB.p.z();
      EXPECT_LT((sum.moment - F.moment).norm(), 10 * allowed * most) << X_WB.p.z();
    }
  }
}

TEST(ShellPressure, OuterPlatesAloneMakeTheShell) {
  const structure::ElasticModel model = box_model(3, 1);
  const structure::ShellRegions shell(model, 100);
  EXPECT_EQ(shell.regions().size(), 4u + 4u * 4u + 4u);  // bands begin at the planes through Bo
  for (const structure::ShellRegion& region : shell.regions())
    EXPECT_GT(region.centre_B.dot(region.outward_B), 1.99) << region.centre_B.transpose();
  const auto& below =
      shell.regions()[shell.nearest(Vector3(2, 2.9, -2.5), Vector3(0, 0.3, -0.95).normalized())];
  EXPECT_LT((below.outward_B - Vector3(0, 0, -1)).norm(), 1e-14);
  EXPECT_THROW(structure::ShellRegions(model, 0), structure::ModelError);
}

/// Work of the pressure of still water on a box, heeled and half under, on a bulging of its shell
/// that no region follows, u = n (n . r)(t . r)^2 with t along the plate, against the work on the
/// faces themselves.
double work_error(const structure::ElasticModel& model, double region_size) {
  const Pose X_WB = pose(0.05, 0.02, 0.1);
  const auto bulge = [](const Vector3& r) -> Vector3 {
    return {0, r.y() * r.z() * r.z(), r.z() * r.y() * r.y()};
  };
  const double rho_g = deep.density * deep.gravity;
  const structure::ShellRegions shell(model, region_size);
  const ShellPressure pressure(box_hull(12), shell);
  Eigen::VectorXd wrenches(static_cast<Eigen::Index>(6 * shell.regions().size()));
  pressure.calc_wrenches(Sea{WaveField(deep), {}}, false, 0, X_WB, wrenches);
  const Eigen::VectorXd load = shell.loads(wrenches);
  double work = 0;
  for (Eigen::Index n = 0; n < model.space().node_count(); ++n)
    work += load.segment<3>(6 * n).dot(bulge(model.space().nodes().col(n)));
  // The same by a fine midpoint rule on the box's faces.
  double exact = 0;
  constexpr int points = 400;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) {
          Vector3 r;
          r[axis] = 0.5 * side * size[axis];
          r[a] = size[a] * ((i + 0.5) / points - 0.5);
          r[b] = size[b] * ((j + 0.5) / points - 0.5);
          const double depth = std::max(0.0, -X_WB.apply(r).z());
          exact -= rho_g * depth * side * bulge(r)[axis] * size[a] * size[b] / (points * points);
        }
    }
  return std::abs(work / exact - 1);
}

// Each region has the right force and moment: regions of a third of the box already give the work
// of a field that no region follows.
TEST(ShellPressure, PressureOfAHalfSubmergedBoxDoesTheWorkOfThatOnItsFaces) {
  const structure::ElasticModel model = box_model(1, 2);
  for (const double region_size : {4.0, 2.0, 1.0})
    EXPECT_LT(work_error(model, region_size), 0.0025);
}

/// A box that is lowered into the water, heeling, at a number of instants.
/// @param height of its middle at first, m; it is dry above 2.
dynamics::History lowering(const dynamics::LiftSystem& system, int instants, double roll,
                           double height = 3) {
  dynamics::History history(system, instants, false);
  for (int k = 0; k < instants; ++k) {
    const double s = static_cast<double>(k) / (instants - 1);
    const Pose X_WB = pose(roll * std::sin(20 * s), 0.02 * std::cos(15 * s), height * (1 - s));
    history.time(k) = 100 * s;
    history.bodies[0].pose.row(k).head<3>() = X_WB.p;
    history.bodies[0].pose.row(k).tail<4>() = dynamics::quaternion_from_rotation(X_WB.R);
  }
  return history;
}

/// A box in a wave.
dynamics::LiftSystem box_in_waves() {
  dynamics::ForceElements elements;
  std::get<std::vector<HullForce>>(elements).push_back(
      hull_force(box_hull(4), WaveField(deep, {{0.3, 0.9, 0.7, 0}})));
  const dynamics::Mechanism mechanism = dynamics::test::OneBody::make();
  return dynamics::LiftSystem({.mechanism = mechanism,
                               .elements = std::move(elements),
                               .operation = dynamics::OperationBuilder().build(1.0),
                               .q_start = mechanism.zero_configuration()});
}

// Whatever hangs in the air adds nothing: neither instants nor plates that stay dry.
TEST(ShellPressure, DryInstantsHaveNone) {
  const structure::ElasticModel model = box_model(3, 1);
  const dynamics::LiftSystem system = box_in_waves();
  const HullForce* hull = find_hull(system, 1);
  const HullForce calm = hull_force(box_hull(4), WaveField(deep));
  const dynamics::History wet = lowering(system, 200, 0.03, 9);
  const PressureSettings settings{.region_size = 3, .tolerance = 1e-3};
  dynamics::History high = lowering(system, 10, 0);
  for (Eigen::Index k = 0; k < high.sample_count(); ++k) high.bodies[0].pose(k, 2) = 9;
  EXPECT_FALSE(find_pressure_basis(model, calm, high, *hull, high, settings));
  const auto basis = find_pressure_basis(model, calm, high, *hull, wet, settings);
  ASSERT_TRUE(basis);
  EXPECT_EQ(basis->static_factors, Eigen::MatrixXd::Zero(basis->count(), 10));
  ASSERT_EQ(basis->dynamic_factors.cols(), 200);
  for (Eigen::Index k = 0; k < 200; ++k) {
    const double height = 9 * (1 - static_cast<double>(k) / 199);
    const bool dry = basis->dynamic_factors.col(k).isZero(0);
    if (height > 3 || height < 1.5) {
      EXPECT_EQ(dry, height > 3) << k;
    }
  }
}

TEST(ShellPressure, FewFieldsMakeUpThePressureOfEveryInstant) {
  const structure::ElasticModel model = box_model(3, 1);
  const dynamics::LiftSystem system = box_in_waves();
  const HullForce* hull = find_hull(system, 1);
  ASSERT_NE(hull, nullptr);
  EXPECT_EQ(find_hull(system, 0), nullptr);
  const HullForce calm = hull_force(box_hull(4), WaveField(deep));
  const dynamics::History at_rest = lowering(system, 20, 0),
                          in_motion = lowering(system, 300, 0.03);
  const PressureSettings settings{.region_size = 3, .tolerance = 1e-2};
  const auto basis = find_pressure_basis(model, calm, at_rest, *hull, in_motion, settings);
  ASSERT_TRUE(basis);
  EXPECT_LE(basis->error, settings.tolerance);
  EXPECT_LT(basis->count(), 40);
  const auto finer = find_pressure_basis(model, calm, at_rest, *hull, in_motion,
                                         {.region_size = 3, .tolerance = 1e-4});
  EXPECT_GT(finer->count(), basis->count());

  // Their resultant is the force of the hull to within the error.
  dynamics::test::OneBody body;
  double largest = 0, worst = 0;
  for (Eigen::Index k = 0; k < in_motion.sample_count(); ++k) {
    const Pose X_WB = in_motion.bodies[0].X_WB(k);
    body.q.head<3>() = X_WB.p;
    body.q.segment<4>(3) = in_motion.bodies[0].pose.row(k).tail<4>();
    body.time = in_motion.time(k);
    body.update();
    const Vector3 F_W = hull->calc_force(body.state()).force;
    const Vector3 sum = basis->resultants.topRows<3>() * basis->dynamic_factors.col(k);
    largest = std::max(largest, F_W.norm());
    worst = std::max(worst, (X_WB.R * sum - F_W).norm());
  }
  EXPECT_NEAR(basis->largest_force, largest, 0.02 * largest);
  EXPECT_LT(worst, std::sqrt(static_cast<double>(basis->regions)) * settings.tolerance * largest);
  // The loads carry these resultants, mode by mode.
  for (int k = 0; k < basis->count(); ++k) {
    const structure::Wrench sum = structure::resultant(model.space(), basis->loads.col(k));
    const double unit = basis->loads.col(k).cwiseAbs().sum();
    EXPECT_LT((sum.force - basis->resultants.col(k).head<3>()).norm(), 1e-10 * unit);
    EXPECT_LT((sum.moment - basis->resultants.col(k).tail<3>()).norm(), 1e-9 * unit);
  }
}

}  // namespace
}  // namespace blocklift::pipeline

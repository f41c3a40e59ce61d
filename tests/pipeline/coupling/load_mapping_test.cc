// Where the two stages meet: forces, moments, mass and motion must be the same on both sides.
#include "pipeline/coupling/load_mapping.h"

#include <set>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/system/matter.h"
#include "tests/pipeline/small_lift.h"

namespace blocklift::pipeline {
namespace {

using structure::InertiaField;
using structure::LoadCase;
using structure::MassProperties;
using structure::Vector3;
using structure::Wrench;
using test::small_lift;
using test::SmallLift;

/// Resultant about B's origin of the body force -rho (a + alpha x r + W r - tr(W) r), by the
/// rigid body's own moments of mass: S = int rho r r^T.
Wrench wrench_of_field(const MassProperties& mass, const InertiaField& field) {
  const Vector3& c = mass.centre_of_mass_B;
  const Eigen::Matrix3d S = 0.5 * mass.inertia_BBcm_B.trace() * Eigen::Matrix3d::Identity() -
                            mass.inertia_BBcm_B + mass.mass * c * c.transpose();
  const Vector3& alpha = field.angular_acceleration;
  const auto& w = field.angular_velocity_products;
  Eigen::Matrix3d A;  // acceleration of a point is a + A r
  A << w(0), w(3), w(5), w(3), w(1), w(4), w(5), w(4), w(2);
  A -= A.trace() * Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) A.col(i) += alpha.cross(Vector3::Unit(i));
  const Eigen::Matrix3d AS = A * S;  // int rho (A r) r^T
  const Vector3 turning(AS(2, 1) - AS(1, 2), AS(0, 2) - AS(2, 0), AS(1, 0) - AS(0, 1));
  Wrench wrench;
  wrench.force = -mass.mass * (field.acceleration_less_gravity + A * c);
  wrench.moment = -(mass.mass * c.cross(field.acceleration_less_gravity) + turning);
  return wrench;
}

Wrench wrench_of_lugs(const LoadCase& load) {
  Wrench wrench;
  for (std::size_t i = 0; i < load.lug_forces_B.size(); ++i) {
    wrench.force += load.lug_forces_B[i];
    wrench.moment += small_lift().lugs()[i].p_BPin.cross(load.lug_forces_B[i]);
  }
  return wrench;
}

/// What is left of forces, and of moments over 1 m, over the sum of the lug forces.
double imbalance(const LoadCase& load) {
  const Wrench lugs = wrench_of_lugs(load);
  const Wrench field = wrench_of_field(small_lift().mass(), load.field);
  double sum = 0;
  for (const Vector3& force : load.lug_forces_B) sum += force.norm();
  return ((lugs.force + field.force).norm() + (lugs.moment + field.moment).norm()) / sum;
}

BlockAttachment attachment() {
  const SmallLift& lift = small_lift();
  return attach_block(lift.run.model, lift.lugs());
}

Eigen::Index largest_spin(const dynamics::History& history) {
  Eigen::Index at = 0;
  history.body("load").velocity.leftCols<3>().rowwise().squaredNorm().maxCoeff(&at);
  return at;
}

TEST(LoadMapping, FindsTheRopesAtTheLugs) {
  const BlockAttachment block = attachment();
  const SmallLift& lift = small_lift();
  ASSERT_EQ(block.ropes.size(), 4u);
  for (const LugRope& end : block.ropes) {
    EXPECT_TRUE(end.at_last_point);
    const std::string& rope = lift.system().ropes()[end.rope].name();
    EXPECT_EQ(rope.substr(1), lift.lugs()[end.lug].name.substr(1));
  }
  std::vector<structure::LiftingPoint> renamed = lift.lugs();
  renamed.front().name = "elsewhere";
  EXPECT_THROW(attach_block(lift.run.model, renamed), std::runtime_error);
}

// One source: what moves in the dynamics is what is loaded in the structure.
TEST(LoadMapping, DynamicsAndStructureHaveOneMass) {
  const SmallLift& lift = small_lift();
  const dynamics::RigidBodyInertia& moved =
      lift.system().mechanism().body(lift.run.model.load).inertia;
  EXPECT_EQ(moved.mass, lift.mass().mass);
  EXPECT_NEAR(moved.mass, 8e3, 1e-8);
  EXPECT_EQ((moved.p_BoBcm - lift.mass().centre_of_mass_B).norm(), 0);

  // Kinetic energy of a rigid velocity field: by the body, and by the finite elements' mass.
  const Vector3 v(0.3, -0.7, 0.2), w(0.5, 0.4, -0.6);
  InertiaField field;
  field.acceleration_less_gravity = v;
  field.angular_acceleration = w;
  const Eigen::VectorXd load = lift.model->inertia_loads() * field.coefficients();
  const Eigen::Matrix3Xd& nodes = lift.model->space().nodes();
  double energy = 0;
  for (Eigen::Index n = 0; n < nodes.cols(); ++n)
    energy -= 0.5 * (load.segment<3>(6 * n).dot(v + w.cross(Vector3(nodes.col(n)))) +
                     load.segment<3>(6 * n + 3).dot(w));
  EXPECT_NEAR(energy, moved.kinetic_energy({w, v}), 1e-10 * energy);
}

TEST(LoadMapping, EveryInstantIsInBalanceAtRestAndInMotion) {
  const SmallLift& lift = small_lift();
  const BlockAttachment block = attachment();
  const dynamics::History& at_rest = lift.run.static_history;
  for (Eigen::Index i = 0; i < at_rest.sample_count(); ++i) {
    const LoadCase load = map_instant(at_rest, i, block, lift.mass());
    EXPECT_LT(imbalance(load), 1e-10) << "static, sample " << i;
    EXPECT_EQ(load.field.angular_velocity_products.norm(), 0);
  }
  const dynamics::History& in_motion = lift.run.dynamic_history();
  for (Eigen::Index i = 0; i < in_motion.sample_count(); ++i)
    EXPECT_LT(imbalance(map_instant(in_motion, i, block, lift.mass())), 1e-10) << "sample " << i;
  // The test would say nothing if the block did not turn.
  const LoadCase turning = map_instant(in_motion, largest_spin(in_motion), block, lift.mass());
  EXPECT_GT(turning.field.angular_velocity_products.norm(), 1e-4);
  EXPECT_GT(turning.field.angular_acceleration.norm(), 1e-3);
}

// As OpenFAST asks of its mesh mappings: about one common point, the resultant of the rope forces
// is the same where they leave the dynamics and where they enter the finite elements.
TEST(LoadMapping, ResultantOfTheLugForcesIsTheSameOnBothSides) {
  const SmallLift& lift = small_lift();
  const dynamics::History& history = lift.run.dynamic_history();
  const Eigen::Index sample = largest_spin(history);
  const dynamics::Pose X_WB = history.body("load").X_WB(sample);
  const Vector3 common_W(3, -2, 7);

  Vector3 force_W = Vector3::Zero(), moment_W = Vector3::Zero();
  for (const char* name : {"R1", "R2", "R3", "R4"}) {
    const int rope = lift.system().rope_index(name);
    const Vector3 f_W = history.ropes[rope].last_force.row(sample);
    const dynamics::BodyPoint& end = lift.system().ropes()[rope].points().back();
    force_W += f_W;
    moment_W += (X_WB.p + X_WB.R * end.p_BoQ_B - common_W).cross(f_W);
  }

  const LoadCase load = map_instant(history, sample, attachment(), lift.mass());
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(lift.model->freedoms());
  for (int lug = 0; lug < 4; ++lug)
    nodal += lift.model->lug_loads().middleCols<3>(3 * lug) * load.lug_forces_B[lug];
  const Wrench sum_B = structure::resultant(lift.model->space(), nodal);
  const Vector3 entered_force_W = X_WB.R * sum_B.force;
  const Vector3 entered_moment_W =
      X_WB.R * sum_B.moment + (X_WB.p - common_W).cross(entered_force_W);
  EXPECT_LT((entered_force_W - force_W).norm(), 1e-11 * force_W.norm());
  EXPECT_LT((entered_moment_W - moment_W).norm(), 1e-11 * moment_W.norm());
}

TEST(LoadMapping, WindIsSpreadOverTheMass) {
  const SmallLift& lift = small_lift();
  const dynamics::History& history = lift.run.static_history;
  const dynamics::BodyHistory& block = history.body("load");
  const LoadCase load = map_instant(history, 0, attachment(), lift.mass());
  const Vector3 all_W = block.load.row(0).tail<3>();
  const dynamics::Matrix3 R = block.X_WB(0).R;
  const Vector3 wind_W = all_W - R * wrench_of_lugs(load).force;
  // 8 m/s towards 60 deg on 8 m2 across: some hundred N, level.
  EXPECT_GT(wind_W.y(), 100);
  EXPECT_LT(std::abs(wind_W.z()), 1e-6 * wind_W.y() + 0.05 * wind_W.norm());
  // Gravity alone would be the field without wind.
  const InertiaField gravity =
      InertiaField::at_rest(R.transpose() * lift.system().mechanism().gravity());
  InertiaField rest = load.field;
  rest.acceleration_less_gravity -= gravity.acceleration_less_gravity;
  EXPECT_LT((wrench_of_field(lift.mass(), rest).force - R.transpose() * wind_W).norm(),
            1e-9 * wind_W.norm());
}

TEST(LoadMapping, RopeMaximaAreTakenAtEachRopesOwnInstant) {
  const SmallLift& lift = small_lift();
  const dynamics::History& history = lift.run.dynamic_history();
  const auto maxima = dynamics::find_largest_tensions(history);
  const LoadCase load = map_rope_maxima(history, maxima, attachment(), lift.mass());
  std::set<Eigen::Index> instants;
  for (int lug = 0; lug < 4; ++lug) {
    const auto rope =
        static_cast<std::size_t>(lift.system().rope_index("R" + std::to_string(lug + 1)));
    Eigen::Index at = 0;
    const double largest = history.ropes[rope].tension.maxCoeff(&at);
    instants.insert(at);
    const Vector3 f_B = history.body("load").X_WB(at).R.transpose() *
                        Vector3(history.ropes[rope].last_force.row(at));
    const Vector3& mapped = load.lug_forces_B[lug];
    EXPECT_EQ((mapped - f_B).norm(), 0);
    EXPECT_NEAR(mapped.norm(), largest, 1e-9 * largest);
  }
  EXPECT_GT(instants.size(), 1u);
  EXPECT_LT(imbalance(load), 1e-12);
  EXPECT_EQ(load.field.angular_velocity_products.norm(), 0);
}

TEST(LoadMapping, LoadTableIsBalancedByTheAccelerationThatItGives) {
  const SmallLift& lift = small_lift();
  const std::vector<Vector3> forces = {{0, 0, 3e4}, {1e3, 0, 2e4}, {0, -2e3, 2.5e4}, {0, 0, 1e4}};
  const LoadCase load = map_load_table(forces, lift.lugs(), lift.mass());
  EXPECT_EQ(load.lug_forces_B, forces);
  EXPECT_LT(imbalance(load), 1e-12);
  // A pull through the centre of mass gives no turn.
  const Vector3 c = lift.mass().centre_of_mass_B;
  std::vector<structure::LiftingPoint> one = {lift.lugs()[0]};
  one[0].p_BPin = Vector3(c.x(), c.y(), 5);
  const LoadCase plumb = map_load_table({Vector3(0, 0, 4e4)}, one, lift.mass());
  EXPECT_LT(plumb.field.angular_acceleration.norm(), 1e-12);
  EXPECT_NEAR(plumb.field.acceleration_less_gravity.z(), 4e4 / lift.mass().mass, 1e-9);
}

}  // namespace
}  // namespace blocklift::pipeline

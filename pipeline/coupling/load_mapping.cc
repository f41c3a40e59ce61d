#include "pipeline/coupling/load_mapping.h"

#include <algorithm>
#include <stdexcept>

namespace blocklift::pipeline {

namespace {

using dynamics::History;
using dynamics::Pose;
using structure::InertiaField;
using structure::LoadCase;
using structure::Vector3;
using structure::Wrench;

/// Place of the lug of that name in the block.
int place_of_lug(const std::vector<structure::LiftingPoint>& lugs, const LiftRope& rope,
                 const std::string& name) {
  const auto lug = std::ranges::find(lugs, name, &structure::LiftingPoint::name);
  if (lug == lugs.end())
    throw std::runtime_error("rope " + rope.name + " ends at lug " + name +
                             ", which the block does not have");
  return static_cast<int>(lug - lugs.begin());
}

/// Force of the rope on the block at its lug, in B.
Vector3 lug_force(const History& history, const LugRope& end, Eigen::Index sample,
                  const Pose& X_WB) {
  const auto& rope = history.ropes[end.rope];
  const Vector3 f_W = end.at_last_point ? Vector3(rope.last_force.row(sample))
                                        : Vector3(rope.first_force.row(sample));
  return X_WB.R.transpose() * f_W;
}

const dynamics::BodyHistory& block_history(const History& history,
                                           const BlockAttachment& attachment) {
  return history.bodies[attachment.body - 1];
}

Wrench wrench_of_lug_forces(const std::vector<Vector3>& forces,
                            const std::vector<structure::LiftingPoint>& lugs) {
  Wrench wrench;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    wrench.force += forces[i];
    wrench.moment += lugs[i].p_BPin.cross(forces[i]);
  }
  return wrench;
}

/// Field that spreads a wrench over the block's mass.
InertiaField spread_over_mass(const structure::MassProperties& mass, const Wrench& wrench) {
  return structure::balancing_field(mass, Wrench{-wrench.force, -wrench.moment});
}

InertiaField operator+(InertiaField a, const InertiaField& b) {
  a.acceleration_less_gravity += b.acceleration_less_gravity;
  a.angular_acceleration += b.angular_acceleration;
  a.angular_velocity_products += b.angular_velocity_products;
  return a;
}

/// Inertia and gravity of the recorded motion, in B.
InertiaField field_of_motion(const dynamics::BodyHistory& block, Eigen::Index sample,
                             const Vector3& gravity_W) {
  const dynamics::Matrix3 R_BW = block.X_WB(sample).R.transpose();
  const dynamics::MotionVector V = block.V_WB(sample);
  const dynamics::MotionVector A = block.A_WB(sample);
  return InertiaField::moving(R_BW * A.linear, R_BW * gravity_W, R_BW * A.angular,
                              R_BW * V.angular);
}

}  // namespace

BlockAttachment attach_block(const BuiltLift& lift,
                             const std::vector<structure::LiftingPoint>& lugs) {
  BlockAttachment attachment;
  attachment.body = lift.load;
  attachment.lugs = lugs;
  attachment.gravity_W = lift.system.mechanism().gravity();
  for (const LiftRope& rope : lift.ropes) {
    if (!rope.first_lug.empty())
      attachment.ropes.push_back({rope.rope, place_of_lug(lugs, rope, rope.first_lug), false});
    if (!rope.lug.empty())
      attachment.ropes.push_back({rope.rope, place_of_lug(lugs, rope, rope.lug), true});
    if (rope.first_lug.empty() && rope.lug.empty() && rope.holds_load())
      attachment.baskets.push_back(rope.rope);
  }
  if (attachment.ropes.empty() && attachment.baskets.empty())
    throw std::runtime_error(
        "no rope ends at a lug of the block or goes round its edges: nothing loads it");
  return attachment;
}

LoadCase map_instant(const BlockHistory& history, Eigen::Index sample,
                     const BlockAttachment& attachment, const structure::MassProperties& mass) {
  const dynamics::BodyHistory& block = block_history(history.motion, attachment);
  const Pose X_WB = block.X_WB(sample);
  LoadCase result;
  result.lug_forces_B.assign(attachment.lugs.size(), Vector3::Zero());
  // All that acts on the body, less ropes at lugs and edges and pressure on the shell, is left for
  // the spread load.
  Wrench rest;
  rest.moment = X_WB.R.transpose() * Vector3(block.load.row(sample).head<3>());
  rest.force = X_WB.R.transpose() * Vector3(block.load.row(sample).tail<3>());
  for (const LugRope& end : attachment.ropes) {
    const Vector3 f_B = lug_force(history.motion, end, sample, X_WB);
    result.lug_forces_B[end.lug] += f_B;
    rest.force -= f_B;
    rest.moment -= attachment.lugs[end.lug].p_BPin.cross(f_B);
  }
  result.added = history.added_at(sample);
  if (result.added.size() > 0) {
    const Eigen::Matrix<double, 6, 1> added = attachment.added_resultants * result.added;
    rest.force -= added.head<3>();
    rest.moment -= added.tail<3>();
  }
  result.field =
      field_of_motion(block, sample, attachment.gravity_W) + spread_over_mass(mass, rest);
  return result;
}

std::vector<Vector3> rope_forces(const History& history, Eigen::Index sample,
                                 const BlockAttachment& attachment) {
  const Pose X_WB = block_history(history, attachment).X_WB(sample);
  std::vector<Vector3> forces;
  for (const LugRope& end : attachment.ropes)
    forces.push_back(lug_force(history, end, sample, X_WB));
  return forces;
}

std::vector<std::string> names_of_ropes(const History& history, const BlockAttachment& attachment) {
  std::vector<std::string> names;
  for (const LugRope& end : attachment.ropes) names.push_back(history.ropes[end.rope].name);
  for (const int basket : attachment.baskets) names.push_back(history.ropes[basket].name);
  return names;
}

LoadCase map_rope_maxima(const BlockHistory& of_block,
                         const std::vector<dynamics::LinkedMaximum>& maxima,
                         const BlockAttachment& attachment, const structure::MassProperties& mass) {
  const History& history = of_block.motion;
  const dynamics::BodyHistory& block = block_history(history, attachment);
  std::vector<Vector3> forces(attachment.lugs.size(), Vector3::Zero());
  for (const LugRope& end : attachment.ropes) {
    const Eigen::Index sample = maxima[end.rope].sample;
    forces[end.lug] += lug_force(history, end, sample, block.X_WB(sample));
  }
  LoadCase result;
  result.lug_forces_B = forces;
  Wrench wrench = wrench_of_lug_forces(forces, attachment.lugs);
  if (of_block.added.cols() > 0) {
    // Water has no rope whose instant it could be taken at, and is left out.
    result.added = Eigen::VectorXd::Zero(of_block.added.rows());
    for (std::size_t load = 0; load < attachment.added_ropes.size(); ++load) {
      const int rope = attachment.added_ropes[load];
      if (rope < 0) continue;
      const auto row = static_cast<Eigen::Index>(load);
      result.added[row] = of_block.added(row, maxima[rope].sample);
    }
    const Eigen::Matrix<double, 6, 1> added = attachment.added_resultants * result.added;
    wrench.force += added.head<3>();
    wrench.moment += added.tail<3>();
  }
  result.field = structure::balancing_field(mass, wrench);
  return result;
}

LoadCase map_load_table(const std::vector<Vector3>& lug_forces_B,
                        const std::vector<structure::LiftingPoint>& lugs,
                        const structure::MassProperties& mass) {
  LoadCase result;
  result.lug_forces_B = lug_forces_B;
  result.field = structure::balancing_field(mass, wrench_of_lug_forces(lug_forces_B, lugs));
  return result;
}

}  // namespace blocklift::pipeline

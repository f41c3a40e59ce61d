#include "pipeline/measures/crane_measures.h"

#include <cmath>
#include <limits>
#include <string>

#include "pipeline/lift/history_figures.h"
#include "pipeline/measures/chart_derating.h"
#include "pipeline/measures/place_at.h"

namespace blocklift::pipeline {

namespace {

using dynamics::BodyIndex;
using dynamics::History;
using dynamics::Pose;

/// Measures under way: values are set sample by sample, of one history after the other.
class MeasureGroup {
 public:
  explicit MeasureGroup(const LiftRun& lift) : lift_(lift) {}

  /// Announces a measure; values are set in this order.
  void add(LiftMeasure measure) {
    measure.at_rest.resize(lift_.static_history.sample_count());
    measure.in_motion.resize(lift_.dynamic_history().sample_count());
    measures_.push_back(std::move(measure));
  }

  /// @param set_values (history, sample, values): a value for each measure.
  template <class SetValues>
  void fill(const SetValues& set_values, std::vector<LiftMeasure>& all) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(measures_.size()));
    for (const History* history : {&lift_.static_history, &lift_.dynamic_history()}) {
      const bool at_rest = history == &lift_.static_history;
      for (Eigen::Index sample = 0; sample < history->sample_count(); ++sample) {
        set_values(*history, sample, values);
        for (std::size_t i = 0; i < measures_.size(); ++i)
          (at_rest ? measures_[i].at_rest : measures_[i].in_motion)[sample] = values[i];
      }
    }
    for (LiftMeasure& measure : measures_) all.push_back(std::move(measure));
  }

 private:
  const LiftRun& lift_;
  std::vector<LiftMeasure> measures_;
};

/// A point of a crane's body, or of its base, as a point of the dynamics.
dynamics::BodyPoint body_point(const given::Crane& crane, const dynamics::Mechanism& mechanism,
                               const PointModel& point) {
  if (point.body.value != "world")
    return {mechanism.body_index(crane.name.value + "." + point.body.value), point.position};
  const Pose X_GC{rotation_of(crane.attitude), crane.position};
  return {crane.base ? mechanism.body_index(crane.base->value) : dynamics::world_index,
          X_GC.apply(point.position)};
}

// ------------------------------------------------------------------------------------------ hooks

/// The angle of a rope out of the plumb in a level direction: positive where the hook is further
/// along it than the sheave.
double lead(const Vector3& pull_up, const Vector3& direction) {
  return std::atan2(-pull_up.dot(direction), pull_up.z());
}

void add_hook_measures(const given::Crane& crane, const ChartFactor& derated,
                       const LiftHoist& hoist, const LiftRun& lift, std::vector<LiftMeasure>& all) {
  const dynamics::LiftSystem& system = lift.model.system;
  const HoistModel& model =
      *crane.model->find_hoist(hoist.name.substr(crane.name.value.size() + 1));
  const dynamics::BodyPoint from = body_point(crane, system.mechanism(), *crane.model->radius_from);
  const dynamics::BodyPoint sheave = upper_sheave(system.ropes()[hoist.rope], hoist);

  MeasureGroup group(lift);
  group.add({.subject = hoist.name,
             .kind = "radius",
             .unit = "m",
             .meaning = "level distance of the hook block from where the crane's radius counts"});
  group.add({.subject = hoist.name,
             .kind = "offlead",
             .unit = "rad",
             .extreme = Extreme::largest_magnitude,
             .meaning = "angle of the tackle out of the plumb in the plane of the radius, positive "
                        "outwards"});
  group.add({.subject = hoist.name,
             .kind = "sidelead",
             .unit = "rad",
             .extreme = Extreme::largest_magnitude,
             .meaning = "angle of the tackle out of the plumb across the plane of the radius"});
  LoadChart chart;
  if (model.load_chart) {
    chart.lines = model.load_chart->value;
    group.add({.subject = hoist.name,
               .kind = "share of the chart",
               .unit = "1",
               .meaning = "load at the hook over what the load chart allows at its radius" +
                          (derated.text.empty() ? "" : ", " + derated.text)});
  }
  group.fill(
      [&](const History& history, Eigen::Index sample, Eigen::VectorXd& values) {
        const auto place = [&](const dynamics::BodyPoint& point) {
          return place_at(history, point, sample);
        };
        const auto& rope = history.ropes[hoist.rope];
        const Vector3 pull = hook_pull(rope, hoist.hook_is_first).row(sample);
        const Vector3 centre = place(from);
        const double radius = (pose_at(history, hoist.hook, sample).p - centre).head<2>().norm();
        Vector3 outwards = place(sheave) - centre;
        outwards.z() = 0;
        values.setZero();
        values[0] = radius;
        if (outwards.norm() > 0 && pull.norm() > 0) {
          outwards.normalize();
          values[1] = lead(pull, outwards);
          values[2] = lead(pull, Vector3::UnitZ().cross(outwards));
        }
        if (chart.lines.empty()) return;
        const double capacity = derated.value * chart.capacity(radius), load = rope.tension[sample];
        values[3] = capacity > 0 ? load / capacity
                                 : (load > 0 ? std::numeric_limits<double>::infinity() : 0);
      },
      all);
}

// ----------------------------------------------------------------------------------------- stands

/// Force and moment about a point.
struct Wrench {
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
};

/// What a body needs from elsewhere at an instant, about a point: the rate of its momentum less its
/// weight less what pulls and presses on it. Summed over all bodies of a crane, the joints between
/// them cancel, and what is left is what the base gives.
Wrench demand(const dynamics::RigidBodyInertia& inertia, const dynamics::BodyHistory& history,
              Eigen::Index sample, const Vector3& gravity, const Vector3& about) {
  const Pose X_WB = history.X_WB(sample);
  const Vector3 omega = history.velocity.row(sample).head<3>();
  const Vector3 alpha = history.acceleration.row(sample).head<3>();
  const Vector3 a_Bo = history.acceleration.row(sample).tail<3>();
  const Vector3 c = X_WB.R * inertia.p_BoBcm;
  const Vector3 a_cm = a_Bo + alpha.cross(c) + omega.cross(omega.cross(c));
  const Eigen::Matrix3d I_W = X_WB.R * inertia.I_BBcm.matrix() * X_WB.R.transpose();
  const Vector3 given_moment = history.load.row(sample).head<3>();
  const Vector3 given_force = history.load.row(sample).tail<3>();

  Wrench wrench;
  const Vector3 inertial = inertia.mass * (a_cm - gravity);
  wrench.force = inertial - given_force;
  wrench.moment = (X_WB.p + c - about).cross(inertial) + I_W * alpha + omega.cross(I_W * omega) -
                  given_moment - (X_WB.p - about).cross(given_force);
  return wrench;
}

/// Loads on supports that share a force and a moment as a rigid body on equal springs does: N_i =
/// a + b x_i + c y_i, with the sums of N_i, N_i y_i and -N_i x_i those of F_z, M_x and M_y.
class SharingSupports {
 public:
  explicit SharingSupports(const std::vector<CraneSupport>& supports) {
    arms_.resize(supports.size(), 3);
    for (std::size_t i = 0; i < supports.size(); ++i)
      arms_.row(i) << 1, supports[i].position.x(), supports[i].position.y();
    inverse_ = (arms_.transpose() * arms_).inverse();
    height_ = 0;
    for (const CraneSupport& support : supports)
      height_ += support.position.z() / static_cast<double>(supports.size());
  }

  /// @param wrench on the crane about the body's origin, along the body's axes.
  Eigen::VectorXd loads(const Wrench& wrench) const {
    // Level forces act at the supports' mean height.
    const Vector3 arm(0, 0, height_);
    const Vector3 moment = wrench.moment - arm.cross(wrench.force);
    return arms_ * (inverse_ * Vector3(wrench.force.z(), -moment.y(), moment.x()));
  }

 private:
  Eigen::MatrixX3d arms_;
  Eigen::Matrix3d inverse_;
  double height_ = 0;  ///< m
};

void add_stand_measures(const given::Crane& crane, const LiftRun& lift,
                        std::vector<LiftMeasure>& all) {
  const dynamics::Mechanism& mechanism = lift.model.system.mechanism();
  const CraneStand& stand = *crane.model->stands_on;
  std::vector<BodyIndex> bodies;
  for (const BodyModel& body : crane.model->bodies)
    bodies.push_back(mechanism.body_index(crane.name.value + "." + body.name.value));
  const BodyIndex standing = mechanism.body_index(crane.name.value + "." + stand.body.value);
  const SharingSupports sharing(stand.supports);

  MeasureGroup group(lift);
  group.add({.subject = crane.name.value,
             .kind = "weight on the base",
             .unit = "N",
             .meaning = "what the crane presses on what it stands on, along its upright axis"});
  group.add({.subject = crane.name.value,
             .kind = "level force on the base",
             .unit = "N",
             .meaning = "what the crane pushes on what it stands on, across its upright axis"});
  for (const CraneSupport& support : stand.supports) {
    group.add({.subject = crane.name.value + "." + support.name.value,
               .kind = "support load",
               .unit = "N",
               .meaning = "of a rigid crane on equal supports; negative: it would lift off"});
  }
  group.fill(
      [&](const History& history, Eigen::Index sample, Eigen::VectorXd& values) {
        const Pose X_WS = pose_at(history, standing, sample);
        Wrench sum;
        for (const BodyIndex body : bodies) {
          const Wrench one = demand(mechanism.body(body).inertia, history.bodies[body - 1], sample,
                                    mechanism.gravity(), X_WS.p);
          sum.force += one.force;
          sum.moment += one.moment;
        }
        const Wrench own{X_WS.R.transpose() * sum.force, X_WS.R.transpose() * sum.moment};
        values[0] = own.force.z();
        values[1] = own.force.head<2>().norm();
        values.tail(values.size() - 2) = sharing.loads(own);
      },
      all);
}

}  // namespace

void add_crane_measures(const LiftCase& lift_case, const LiftRun& lift,
                        std::vector<LiftMeasure>& measures) {
  for (std::size_t i = 0; i < lift_case.cranes.size(); ++i) {
    const given::Crane& crane = lift_case.cranes[i];
    if (crane.model->radius_from) {
      const ChartFactor derated = find_chart_factor(*crane.model, lift_case);
      for (const LiftHoist& hoist : lift.model.hoists)
        if (hoist.crane == i) add_hook_measures(crane, derated, hoist, lift, measures);
    }
    if (crane.model->stands_on) add_stand_measures(crane, lift, measures);
  }
}

}  // namespace blocklift::pipeline

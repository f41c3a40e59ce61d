#include "dynamics/simulation/history.h"

#include <algorithm>

#include "dynamics/errors.h"
#include "dynamics/simulation/energy_ledger.h"

namespace blocklift::dynamics {

namespace {

template <class Record>
const Record& find_by_name(const std::vector<Record>& records, std::string_view name,
                           const char* what) {
  std::string names;
  for (const Record& record : records) {
    if (record.name == name) return record;
    names += (names.empty() ? "" : ", ") + record.name;
  }
  throw ModelError("the history has no " + std::string(what) + " \"" + std::string(name) +
                   "\"; it has " + (names.empty() ? "none" : names));
}

std::string drive_name(const LiftSystem& system, int velocity_index) {
  for (const JointDrive& drive : system.operation().joint_drives()) {
    const int count = std::max(1, static_cast<int>(drive.direction.size()));
    const int k = velocity_index - drive.velocity_index;
    if (k < 0 || k >= count) continue;
    return count == 1 ? drive.name : drive.name + " " + std::to_string(k + 1);
  }
  return system.mechanism().velocity_name(velocity_index);
}

// Coordinate that belongs to a velocity, -1 for joints with a quaternion.
int coordinate_of(const Mechanism& mechanism, int velocity_index) {
  const Body& body = mechanism.body(mechanism.body_of_velocity(velocity_index));
  if (!velocities_are_rates(body.joint.kind)) return -1;
  return body.q_offset + velocity_index - body.v_offset;
}

// Within rounding of an instant of change the fixed set may leave a push of no account.
RopeLoad without_push(const RopeLoad& load) {
  RopeLoad pulling = load;
  pulling.tension = std::max(0.0, load.tension);
  pulling.split.first_tension = std::max(0.0, load.split.first_tension);
  pulling.split.last_tension = std::max(0.0, load.split.last_tension);
  return pulling;
}

}  // namespace

Pose BodyHistory::X_WB(Eigen::Index sample) const {
  return {rotation_from_quaternion(pose.row(sample).tail<4>()), pose.row(sample).head<3>()};
}

History::History(const LiftSystem& system, Eigen::Index n, bool with_works,
                 const Recording& recording)
    : time(n),
      recording_(recording),
      A_WB_(static_cast<std::size_t>(system.mechanism().body_count())),
      F_Bo_W_(A_WB_.size()),
      tau_(system.mechanism().nv()) {
  if (with_works && !recording.energy)
    throw ModelError("works are recorded beside energies, which are left out");
  // Samples of what is recorded at all.
  const Eigen::Index moving = recording.motion ? n : 0;
  const Eigen::Index pulling = recording.rope_forces ? n : 0;
  const Eigen::Index accelerating = recording.accelerations ? n : 0;
  const Eigen::Index storing = recording.energy ? n : 0;
  if (system.water()) {
    water_momentum_ = water_force_ = Eigen::VectorXd::Zero(system.water()->inertia().size());
  }
  for (const Body& body : system.mechanism().bodies()) {
    if (body.parent < 0) continue;
    BodyHistory& b = bodies.emplace_back();
    b.name = body.name;
    b.pose.resize(moving, 7);
    b.velocity.resize(moving, 6);
    b.acceleration.resize(accelerating, 6);
    b.load.resize(accelerating, 6);
  }
  for (const ElasticMode& mode : system.mechanism().elastic_modes()) {
    ElasticModeHistory& m = elastic_modes.emplace_back();
    m.name = mode.name;
    m.coordinate.resize(moving);
    m.rate.resize(moving);
    m.acceleration.resize(accelerating);
  }
  for (const Rope& rope : system.ropes()) {
    RopeHistory& r = ropes.emplace_back();
    r.name = rope.name();
    for (auto* values : {&r.tension, &r.elongation, &r.unstretched_length, &r.unstretched_rate}) {
      values->resize(n);
    }
    r.first_force.resize(pulling, 3);
    r.last_force.resize(pulling, 3);
    for (const RopeEdge& edge : rope.edges()) {
      EdgeHistory& e = r.edges.emplace_back();
      e.name = edge.name;
      e.force.resize(pulling, 3);
      for (auto* values : {&e.wrap, &e.first_angle, &e.last_angle, &e.first_place, &e.last_place,
                           &e.first_tension, &e.last_tension})
        values->resize(pulling);
    }
  }
  for (const int k : system.mechanism().driven_velocities()) {
    DriveHistory& d = drives.emplace_back();
    d.name = drive_name(system, k);
    d.position.resize(moving);
    d.velocity.resize(moving);
    d.force.resize(accelerating);
  }
  for (const SupportPad& pad : system.supports()) {
    supports.push_back({pad.name(), Eigen::VectorXd(n)});
  }
  for (const Loop& loop : system.mechanism().loops()) {
    LoopHistory& l = loops.emplace_back();
    l.name = loop.name;
    l.force.resize(accelerating, 6);
    l.multipliers.resize(accelerating, loop.row_count);
    l.residual.resize(accelerating);
  }
  for (auto* values : {&energy.kinetic, &energy.gravity, &energy.elastic, &buoyancy_in_waves_})
    values->resize(storing);
  if (with_works) {
    for (auto* values :
         {&energy.drive_work, &energy.winch_work, &energy.outside_work, &energy.dissipated}) {
      values->resize(n);
    }
  }
}

const BodyHistory& History::body(std::string_view name) const {
  return find_by_name(bodies, name, "body");
}

const ElasticModeHistory& History::elastic_mode(std::string_view name) const {
  return find_by_name(elastic_modes, name, "elastic mode");
}

const RopeHistory& History::rope(std::string_view name) const {
  return find_by_name(ropes, name, "rope");
}

const LoopHistory& History::loop(std::string_view name) const {
  return find_by_name(loops, name, "loop");
}

// The water that goes with the bodies resists their acceleration: a load as any other to who asks
// what a body bears.
void History::add_water_inertia(const RadiatedWater& water, const LiftWorkspace& w) {
  const AddedInertia& inertia = water.inertia();
  inertia.calc_force(w.kinematics, A_WB_, (w.loops ? *w.loops : *w.tied).added->matrix,
                     w.water_velocity, water_momentum_, water_force_);
  water_force_ = -water_force_;
  add_frame_forces(inertia.frames(), w.kinematics, water_force_, F_Bo_W_);
}

void History::record_motion(const LiftSystem& system, Eigen::Index sample, const LiftWorkspace& w) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyHistory& b = bodies[i];
    const Pose& X_WB = w.kinematics.X_WB[i + 1];
    Vector4 quaternion = quaternion_from_rotation(X_WB.R);
    if (sample > 0 && b.pose.row(sample - 1).tail<4>().dot(quaternion.transpose()) < 0.0) {
      quaternion = -quaternion;
    }
    b.pose.row(sample) << X_WB.p.transpose(), quaternion.transpose();
    const MotionVector& V = w.kinematics.V_WB[i + 1];
    b.velocity.row(sample) << V.angular.transpose(), V.linear.transpose();
  }
  const Mechanism& mechanism = system.mechanism();
  for (std::size_t i = 0; i < elastic_modes.size(); ++i) {
    const ElasticMode& mode = mechanism.elastic_modes()[i];
    elastic_modes[i].coordinate[sample] = w.q[mode.q_index];
    elastic_modes[i].rate[sample] = w.v[mode.v_index];
  }
  const std::vector<int>& driven = mechanism.driven_velocities();
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const int coordinate = coordinate_of(mechanism, driven[i]);
    drives[i].position[sample] = coordinate < 0 ? not_a_number : w.q[coordinate];
    drives[i].velocity[sample] = w.v[driven[i]];
  }
}

void History::record_accelerations(const LiftSystem& system, Eigen::Index sample,
                                   const LiftWorkspace& w) {
  const Mechanism& mechanism = system.mechanism();
  compute_accelerations(mechanism, w.kinematics, w.vdot, A_WB_);
  F_Bo_W_ = w.loads.F_Bo_W;
  if (w.loops) {
    add_loop_forces(mechanism, w.kinematics, w.loops->loops, w.loops->lambda, F_Bo_W_, tau_);
  }
  if (system.water()) add_water_inertia(*system.water(), w);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const MotionVector& A = A_WB_[i + 1];
    bodies[i].acceleration.row(sample) << A.angular.transpose(), A.linear.transpose();
    const ForceVector& F = F_Bo_W_[i + 1];
    bodies[i].load.row(sample) << F.moment.transpose(), F.force.transpose();
  }
  for (std::size_t i = 0; i < elastic_modes.size(); ++i)
    elastic_modes[i].acceleration[sample] = w.vdot[mechanism.elastic_modes()[i].v_index];
  const std::vector<int>& driven = mechanism.driven_velocities();
  for (std::size_t i = 0; i < drives.size(); ++i)
    drives[i].force[sample] = w.joint_force[driven[i]];
  record_loops(system, sample, w);
}

void History::record_ropes(Eigen::Index sample, const LiftWorkspace& w) {
  for (std::size_t i = 0; i < ropes.size(); ++i) {
    RopeHistory& r = ropes[i];
    const RopeLoad& load = w.rope_loads[i];
    r.tension[sample] = std::max(0.0, load.tension);  // as without_push
    r.elongation[sample] = load.elongation();
    r.unstretched_length[sample] = load.unstretched_length;
    r.unstretched_rate[sample] = load.unstretched_rate;
  }
}

void History::record_rope_forces(const LiftSystem& system, Eigen::Index sample, LiftWorkspace& w) {
  for (std::size_t i = 0; i < ropes.size(); ++i) {
    RopeHistory& r = ropes[i];
    const RopeLoad pulling = without_push(w.rope_loads[i]);
    system.ropes()[i].calc_path(w.kinematics, w.path, &w.end_shifts[i]);
    r.first_force.row(sample) = system.ropes()[i].first_force(w.path, pulling).transpose();
    r.last_force.row(sample) = system.ropes()[i].last_force(w.path, pulling).transpose();
    if (!r.edges.empty()) record_edges(w.path, pulling, w.splits[i], sample, r);
  }
}

void History::record_edges(const RopePath& path, const RopeLoad& load, const RopeSplit& split,
                           Eigen::Index sample, RopeHistory& rope) {
  for (std::size_t i = 0; i < rope.edges.size(); ++i) {
    EdgeHistory& edge = rope.edges[i];
    const EdgeTouch& touch = path.touches[i];
    const auto or_nothing = [&](double value) { return touch.touches ? value : not_a_number; };
    edge.force.row(sample).setZero();
    edge.wrap[sample] = touch.touches ? touch.wrap : 0.0;
    edge.first_angle[sample] = or_nothing(touch.first_angle);
    edge.last_angle[sample] = or_nothing(touch.last_angle);
    edge.first_place[sample] = or_nothing(touch.first_place);
    edge.last_place[sample] = or_nothing(touch.last_place);
    edge.first_tension[sample] = edge.last_tension[sample] = 0.0;
  }
  const auto tension_of = [&](std::size_t segment) {
    return load.split.acts ? std::max(0.0, split.tension_of_segment(segment)) : load.tension;
  };
  for (std::size_t k = 1; k + 1 < path.count; ++k) {
    if (path.edge[k] < 0) continue;
    EdgeHistory& edge = rope.edges[path.edge[k]];
    const double before = tension_of(k - 1), behind = tension_of(k);
    edge.force.row(sample) +=
        (behind * path.direction_W[k] - before * path.direction_W[k - 1]).transpose();
    if (path.edge[k - 1] != path.edge[k]) edge.first_tension[sample] = before;
    if (path.edge[k + 1] != path.edge[k]) edge.last_tension[sample] = behind;
  }
}

void History::record_loops(const LiftSystem& system, Eigen::Index sample, const LiftWorkspace& w) {
  const Mechanism& mechanism = system.mechanism();
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const Loop& loop = mechanism.loops()[i];
    const LoopState& state = w.loops->loops;
    const ForceVector F =
        loop_force(mechanism, w.kinematics, state, static_cast<int>(i), w.loops->lambda);
    loops[i].force.row(sample) << F.moment.transpose(), F.force.transpose();
    loops[i].multipliers.row(sample) =
        w.loops->lambda.segment(loop.row_offset, loop.row_count).transpose();
    loops[i].residual[sample] =
        state.residual.segment(loop.row_offset, loop.row_count).lpNorm<Eigen::Infinity>();
  }
}

void History::record_energy(const LiftSystem& system, Eigen::Index sample, double t,
                            const LiftWorkspace& w) {
  const StoredEnergy stored = calc_stored_energy(system, t, w);
  energy.kinetic[sample] = stored.kinetic;
  energy.gravity[sample] = stored.gravity;
  energy.elastic[sample] = stored.elastic;
  buoyancy_in_waves_[sample] = stored.buoyancy_in_waves;
}

void History::record(const LiftSystem& system, Eigen::Index sample, double t, LiftWorkspace& w) {
  time[sample] = t;
  record_ropes(sample, w);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    supports[i].normal_force[sample] = std::max(0.0, w.support_loads[i].normal_force);
  }
  if (recording_.motion) record_motion(system, sample, w);
  if (recording_.rope_forces) record_rope_forces(system, sample, w);
  if (recording_.accelerations) record_accelerations(system, sample, w);
  if (recording_.energy) record_energy(system, sample, t, w);
}

void History::record_works(Eigen::Index sample, const Eigen::Vector4d& works) {
  energy.drive_work[sample] = works[0];
  energy.winch_work[sample] = works[1];
  // All of the work of hulls in waves was summed; their buoyancy stored the part that still water
  // does.
  energy.outside_work[sample] = works[2] + buoyancy_in_waves_[sample] - buoyancy_in_waves_[0];
  energy.dissipated[sample] = works[3];
}

std::vector<LinkedMaximum> find_largest_tensions(const History& history) {
  std::vector<LinkedMaximum> maxima;
  const auto count = static_cast<Eigen::Index>(history.ropes.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    LinkedMaximum& maximum = maxima.emplace_back();
    maximum.rope = static_cast<int>(i);
    maximum.tension = history.ropes[i].tension.maxCoeff(&maximum.sample);
    maximum.time = history.time[maximum.sample];
    maximum.tensions.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      maximum.tensions[k] = history.ropes[k].tension[maximum.sample];
    }
  }
  return maxima;
}

}  // namespace blocklift::dynamics

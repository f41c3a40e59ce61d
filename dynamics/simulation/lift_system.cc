#include "dynamics/simulation/lift_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/level_axes.h"

namespace blocklift::dynamics {

namespace {

std::vector<char> mark_elastic_ends(const LiftDefinition& d) {
  std::vector<char> marks(d.ropes.size(), 0);
  for (const ElasticBody& body : d.elastic_bodies) {
    for (const int rope : body.ropes()) {
      char& mark = marks[rope];
      if (mark != 0) {
        throw ModelError("rope \"" + d.ropes[rope].name() +
                         "\" ends at two elastic bodies; one of them must be rigid");
      }
      mark = 1;
    }
  }
  return marks;
}

// An elastic mode without a shape would have no spring either.
void check_elastic_modes(const LiftDefinition& d) {
  const std::vector<ElasticMode>& modes = d.mechanism.elastic_modes();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    std::ptrdiff_t count = 0;
    for (const ElasticBody& body : d.elastic_bodies) {
      const std::vector<int>& own = body.definition().modes;
      count += std::count(own.begin(), own.end(), static_cast<int>(i));
    }
    if (count == 1) continue;
    throw ModelError("elastic mode \"" + modes[i].name + "\" has its shape from " +
                     std::to_string(count) + " elastic bodies; one is due");
  }
}

void check_wish(const LiftDefinition& d, const Steering& steering) {
  const auto check_point = [&](const BodyPoint& point) {
    if (point.body < 0 || point.body >= d.mechanism.body_count() || !point.p_BoQ_B.allFinite())
      throw ModelError("drive \"" + steering.drive + "\" is steered by a point of no body");
  };
  const auto check_rope = [&](int rope) {
    if (rope < 0 || rope >= static_cast<int>(d.ropes.size()))
      throw ModelError("drive \"" + steering.drive + "\" is steered by the pull of no rope");
  };
  if (const auto* height = std::get_if<KeptHeight>(&steering.wish)) {
    check_point(height->point);
    check_point(height->reference);
  } else if (const auto* plumb = std::get_if<KeptPlumb>(&steering.wish)) {
    check_point(plumb->head);
    check_point(plumb->target);
  } else if (const auto* share = std::get_if<KeptShare>(&steering.wish)) {
    for (const int rope : share->others) check_rope(rope);
  } else if (const auto* own = std::get_if<OwnLaw>(&steering.wish)) {
    for (const Sight& sight : own->sights) {
      if (const auto* height = std::get_if<SeenHeight>(&sight)) {
        check_point(height->point);
        check_point(height->reference);
      } else if (const auto* plumb = std::get_if<SeenPlumb>(&sight)) {
        check_point(plumb->head);
        check_point(plumb->target);
      } else if (const auto* tension = std::get_if<SeenTension>(&sight)) {
        check_rope(tension->rope);
      } else if (const auto* share = std::get_if<SeenShare>(&sight)) {
        check_rope(share->rope);
        for (const int rope : share->others) check_rope(rope);
      }
    }
  }
}

}  // namespace

LiftSystem::LiftSystem(LiftDefinition definition) : d_(std::move(definition)) {
  const Mechanism& m = d_.mechanism;
  if (d_.v_start.size() == 0) d_.v_start = Eigen::VectorXd::Zero(m.nv());
  if (d_.q_start.size() != m.nq() || d_.v_start.size() != m.nv()) {
    throw ModelError("the lift starts from " + std::to_string(d_.q_start.size()) +
                     " coordinates and " + std::to_string(d_.v_start.size()) +
                     " velocities; the mechanism has " + std::to_string(m.nq()) + " and " +
                     std::to_string(m.nv()));
  }
  if (!d_.q_start.allFinite() || !d_.v_start.allFinite()) {
    throw ModelError("the lift starts from coordinates or velocities that are not finite");
  }
  m.normalise(d_.q_start);
  if (!m.loops().empty()) d_.mechanism = m.with_loops_as_at(d_.q_start);
  nq_free_ = static_cast<int>(m.free_coordinates().size());
  nv_free_ = static_cast<int>(m.free_velocities().size());
  for (std::size_t i = 0; i < d_.ropes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (d_.ropes[i].name() == d_.ropes[j].name()) {
        throw ModelError("two ropes are named \"" + d_.ropes[i].name() + "\"");
      }
    }
  }
  ends_elastically_ = mark_elastic_ends(d_);
  check_elastic_modes(d_);
  for (const Winch& winch : d_.operation.winches()) {
    if (winch.rope < 0 || winch.rope >= static_cast<int>(d_.ropes.size()))
      throw ModelError("winch \"" + winch.name + "\" has no rope");
  }
  for (const Steering& steering : d_.operation.steerings()) check_wish(d_, steering);
  for (const Parting& parting : d_.operation.partings()) {
    if (parting.rope < 0 || parting.rope >= static_cast<int>(d_.ropes.size()))
      throw ModelError("there is no rope " + std::to_string(parting.rope) + " to part");
  }
}

int LiftSystem::rope_index(std::string_view name) const {
  std::string names;
  for (std::size_t i = 0; i < d_.ropes.size(); ++i) {
    if (d_.ropes[i].name() == name) return static_cast<int>(i);
    names += (names.empty() ? "" : ", ") + d_.ropes[i].name();
  }
  throw ModelError("there is no rope \"" + std::string(name) + "\"; the ropes are " +
                   (names.empty() ? "none" : names));
}

LiftWorkspace::LiftWorkspace(const LiftSystem& system)
    : q(system.q_start()),
      v(system.v_start()),
      vdot(Eigen::VectorXd::Zero(system.mechanism().nv())),
      rates(Eigen::VectorXd::Zero(system.mechanism().nq())),
      joint_force(Eigen::VectorXd::Zero(system.mechanism().nv())),
      kinematics(system.mechanism()),
      loads(system.mechanism()),
      dynamics(system.mechanism()),
      feeds(system.ropes().size()),
      steered(system.operation().steerings().size(), MotionProfile::constant(0.0)),
      rope_loads(system.ropes().size()),
      support_loads(system.supports().size()),
      tugger_loads(system.tugger_lines().size()),
      splits(make_rope_splits(system.ropes())),
      path(make_rope_path(system.ropes())),
      end_shifts(system.ropes().size()) {
  for (const ElasticBody& body : system.elastic_bodies())
    elastic.emplace_back(body, system.mechanism());
  const AddedInertia* added = system.water() ? &system.water()->inertia() : nullptr;
  if (!system.mechanism().loops().empty()) {
    loops.emplace(system.mechanism(), added);
  } else if (added) {
    tied.emplace(system.mechanism(), added);
  }
  F_Bo_W_of_hulls.assign(std::get<std::vector<HullForce>>(system.elements()).size(),
                         ForceVector::zero());
  F_R_W_of_scattering.assign(std::get<std::vector<DiffractionForce>>(system.elements()).size(),
                             ForceVector::zero());
  memory = memory_rate = Eigen::VectorXd::Zero(system.memory_count());
  water_velocity = level_velocity = water_force = entry_force =
      Eigen::VectorXd::Zero(added ? added->size() : 0);
  for (const SupportPad& pad : system.supports()) standing_places.push_back(pad.definition().p_WG);
  for (std::size_t i = 0; i < feeds.size(); ++i) {
    feeds[i].unstretched_length = system.ropes()[i].definition().unstretched_length;
  }
}

ElasticBody::Ropes LiftWorkspace::ropes(const LiftSystem& system, const Contacts* contacts) {
  return {system.ropes(), feeds, contacts, path, end_shifts, rope_loads};
}

namespace {

void add_steered_motion(const LiftSystem& system, double t, bool moving, LiftWorkspace& w) {
  const Operation& operation = system.operation();
  for (std::size_t i = 0; i < w.steered.size(); ++i) {
    const Steering& steering = operation.steerings()[i];
    const ProfileValue value = w.steered[i].evaluate(t);
    if (steering.is_winch) {
      const int rope = operation.winches()[steering.index].rope;
      RopeFeed& feed = w.feeds[rope];
      feed.unstretched_length += value.position;
      if (moving) feed.rate += value.velocity;
      continue;
    }
    const JointDrive& drive = operation.joint_drives()[steering.index];
    w.q[drive.coordinate_index] += value.position;
    if (!moving) continue;
    w.v[drive.velocity_index] += value.velocity;
    w.vdot[drive.velocity_index] += value.acceleration;
  }
}

}  // namespace

void set_drives(const LiftSystem& system, double t, bool moving, LiftWorkspace& w) {
  for (const int k : system.mechanism().driven_velocities()) {
    w.v[k] = 0.0;
    w.vdot[k] = 0.0;
  }
  for (const JointDrive& drive : system.operation().joint_drives()) {
    const ProfileValue value = drive.position.evaluate(t);
    if (drive.direction.size() > 0) {
      const Eigen::Index n = drive.direction.size();
      integrate_joint(system.mechanism().body(drive.body).joint.kind, drive.start.data(),
                      drive.direction.data(), value.position, &w.q[drive.coordinate_index]);
      if (!moving) continue;
      w.v.segment(drive.velocity_index, n) = value.velocity * drive.direction;
      w.vdot.segment(drive.velocity_index, n) = value.acceleration * drive.direction;
      continue;
    }
    w.q[drive.coordinate_index] = value.position;
    if (!moving) continue;
    w.v[drive.velocity_index] = value.velocity;
    w.vdot[drive.velocity_index] = value.acceleration;
  }
  for (const Winch& winch : system.operation().winches()) {
    RopeFeed& feed = w.feeds[winch.rope];
    feed.unstretched_length = feed.rate = 0.0;
  }
  for (const Winch& winch : system.operation().winches()) {
    const ProfileValue value = winch.length.evaluate(t);
    RopeFeed& feed = w.feeds[winch.rope];
    feed.unstretched_length += value.position;
    if (moving) feed.rate += value.velocity;
  }
  if (!w.steered.empty()) add_steered_motion(system, t, moving, w);
}

void set_state(const LiftSystem& system, ConstVectorRef y, LiftWorkspace& w) {
  Eigen::Index i = 0;
  for (const int k : system.mechanism().free_coordinates()) w.q[k] = y[i++];
  for (const int k : system.mechanism().free_velocities()) w.v[k] = y[i++];
  w.memory = y.segment(i, w.memory.size());
}

void get_state(const LiftSystem& system, ConstVectorRef q, ConstVectorRef v, VectorRef y) {
  Eigen::Index i = 0;
  for (const int k : system.mechanism().free_coordinates()) y[i++] = q[k];
  for (const int k : system.mechanism().free_velocities()) y[i++] = v[k];
}

namespace {

// What the water that floating bodies radiate does to them now, but for its inertia: by its memory,
// and as it is taken up by a body that enters it.
void add_water_forces(const RadiatedWater& water, double t, LiftWorkspace& w) {
  calc_water_forces(water, t, w);
  add_level_forces(water.frames(), w.kinematics, w.water_force, w.loads.F_Bo_W);
  if (!water.varies()) return;
  w.entry_force.setZero();
  water.add_entry_force(w.water_shares, w.water_velocity, w.entry_force);
  add_frame_forces(water.frames(), w.kinematics, w.entry_force, w.loads.F_Bo_W);
  water.calc_added_mass(w.water_shares, (w.loops ? *w.loops : *w.tied).added->matrix);
}

}  // namespace

void set_down_pad(const LiftSystem& system, std::size_t pad, LiftWorkspace& w) {
  const SupportPad::Definition& definition = system.supports()[pad].definition();
  if (!definition.ground) return;
  w.standing_places[pad].head<2>() =
      point_position(w.kinematics, definition.point.body, definition.point.p_BoQ_B).head<2>();
}

void carry_pads_along(const LiftSystem& system, LiftWorkspace& w) {
  for (std::size_t i = 0; i < w.support_loads.size(); ++i) {
    const SupportPad::Definition& pad = system.supports()[i].definition();
    if (!pad.ground) continue;
    if (!w.support_loads[i].carries) {
      set_down_pad(system, i, w);
      continue;
    }
    const double force = pad.friction_coefficient * std::max(0.0, w.support_loads[i].normal_force);
    auto place = w.standing_places[i].head<2>();
    const Eigen::Vector2d s =
        point_position(w.kinematics, pad.point.body, pad.point.p_BoQ_B).head<2>() - place;
    const double slid = s.norm() - force / pad.tangential_stiffness;
    if (slid > 0.0) place += slid * s.normalized();
  }
}

void calc_contact_loads(const LiftSystem& system, const Contacts* contacts, LiftWorkspace& w) {
  compute_kinematics(system.mechanism(), w.q, w.v, w.kinematics);
  w.loads.set_zero();
  const std::vector<Rope>& ropes = system.ropes();
  for (std::size_t i = 0; i < ropes.size(); ++i) {
    if (system.ends_elastically(static_cast<int>(i))) continue;
    ropes[i].calc_path(w.kinematics, w.path);
    RopeLoad& load = w.rope_loads[i];
    load = contacts ? ropes[i].calc_load(w.path, w.feeds[i], (*contacts)[i] != 0)
                    : ropes[i].calc_load(w.path, w.feeds[i]);
    if (w.splits[i].acts() && load.taut && !w.feeds[i].parted)
      w.splits[i].divide(ropes[i], w.kinematics, w.path, load);
    if (load.split.acts) {
      w.splits[i].add_forces(w.path, w.loads.F_Bo_W);
    } else if (load.tension != 0.0) {
      ropes[i].add_forces(w.path, load, w.loads.F_Bo_W);
    }
  }
  for (std::size_t i = 0; i < system.elastic_bodies().size(); ++i) {
    system.elastic_bodies()[i].add_forces(w.kinematics, w.q, w.v, w.ropes(system, contacts),
                                          w.elastic[i], w.loads.F_Bo_W, w.loads.tau);
  }
  const std::vector<SupportPad>& supports = system.supports();
  for (std::size_t i = 0; i < supports.size(); ++i) {
    SupportLoad& load = w.support_loads[i];
    const Vector3& place = w.standing_places[i];
    load = contacts ? supports[i].calc_load(w.kinematics, (*contacts)[ropes.size() + i] != 0, place)
                    : supports[i].calc_load(w.kinematics, place);
    supports[i].add_force(w.kinematics, load, w.loads);
  }
  const std::vector<TuggerLine>& lines = system.tugger_lines();
  const std::size_t first_line = ropes.size() + supports.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    TuggerLoad& load = w.tugger_loads[i];
    load = contacts ? lines[i].calc_load(w.kinematics, (*contacts)[first_line + i] != 0)
                    : lines[i].calc_load(w.kinematics);
    lines[i].add_forces(w.kinematics, load, w.loads);
  }
}

void calc_hull_forces(const LiftSystem& system, double t, LiftWorkspace& w) {
  const MotionState state{t, w.q, w.v, w.kinematics};
  const auto& hulls = std::get<std::vector<HullForce>>(system.elements());
  const auto& scattering = std::get<std::vector<DiffractionForce>>(system.elements());
  ForecastForces& forecast = w.forecast;
  forecast.interpolate(t);
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    w.F_Bo_W_of_hulls[i] = forecast.covers(i, t) ? forecast.calc_force(hulls[i], i, state)
                                                 : hulls[i].calc_force(state);
  }
  for (std::size_t i = 0; i < scattering.size(); ++i) {
    const std::size_t number = hulls.size() + i;
    w.F_R_W_of_scattering[i] =
        forecast.covers(number, t) ? forecast.force(number) : scattering[i].calc_force(state);
  }
}

void calc_water_forces(const RadiatedWater& water, double t, LiftWorkspace& w) {
  water.inertia().calc_velocity(w.kinematics, w.water_velocity);
  w.level_velocity = w.water_velocity;
  turn_to_level_axes(water.frames(), w.kinematics, w.level_velocity);
  w.water_shares = water.find_shares(w.kinematics);
  water.calc_force(w.water_shares, w.memory, w.water_force);
  w.marched.add_to(t, w.water_force);
}

void calc_loads(const LiftSystem& system, double t, const Contacts* contacts, LiftWorkspace& w,
                HullForces hull_forces) {
  calc_contact_loads(system, contacts, w);
  if (hull_forces == HullForces::evaluated) calc_hull_forces(system, t, w);
  const MotionState state{t, w.q, w.v, w.kinematics};
  auto scattering = w.F_R_W_of_scattering.begin();
  for_each_element(system.elements(), [&](const auto& element) {
    using Element = decltype(element);
    if constexpr (is_scattering<Element>) {
      element.add_force(state, *scattering++, w.loads);
    } else if constexpr (!is_evaluated_apart<Element>) {
      element.add_forces(state, w.loads);
    }
  });
  const auto& hulls = std::get<std::vector<HullForce>>(system.elements());
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    w.loads.F_Bo_W[hulls[i].definition().body] += w.F_Bo_W_of_hulls[i];
  }
  if (system.water()) add_water_forces(*system.water(), t, w);
}

void calc_accelerations(const LiftSystem& system, LiftWorkspace& w, DriveForces drives) {
  const Mechanism& mechanism = system.mechanism();
  w.joint_force = w.loads.tau;
  if (w.loops || w.tied) {
    const RadiatedWater* water = system.water();
    compute_constrained_dynamics(
        mechanism, w.kinematics, w.q, w.v, w.loads.F_Bo_W, w.loop_rows ? &*w.loop_rows : nullptr,
        w.loops ? *w.loops : *w.tied, w.joint_force, w.vdot, water ? &water->inertia() : nullptr);
  } else {
    compute_forward_dynamics(mechanism, w.kinematics, w.v, w.loads.F_Bo_W, w.dynamics,
                             w.joint_force, w.vdot, drives);
  }
  // What forward dynamics finds at a driven joint includes the springs there.
  for (const int k : mechanism.driven_velocities()) w.joint_force[k] -= w.loads.tau[k];
}

void calc_right_hand_side(const LiftSystem& system, double t, ConstVectorRef y,
                          const Contacts* contacts, LiftWorkspace& w, VectorRef ydot,
                          DriveForces drives) {
  set_state(system, y, w);
  set_drives(system, t, true, w);
  calc_loads(system, t, contacts, w);
  calc_accelerations(system, w, drives);
  system.mechanism().calc_rates(w.q, w.v, w.rates);
  get_state(system, w.rates, w.vdot, ydot);
  const RadiatedWater* water = system.water();
  if (!water) return;
  water->calc_rate(w.water_shares, w.memory, w.level_velocity, w.memory_rate);
  ydot.segment(system.nq_free() + system.nv_free(), w.memory.size()) = w.memory_rate;
}

void calc_contact_indicators(const LiftWorkspace& w, VectorRef indicators) {
  Eigen::Index i = 0;
  for (const RopeLoad& load : w.rope_loads) indicators[i++] = 1e-3 * load.slack_indicator();
  for (const SupportLoad& load : w.support_loads) indicators[i++] = 1e-3 * load.indicator();
  for (const TuggerLoad& load : w.tugger_loads) indicators[i++] = 1e-3 * load.slack_indicator();
}

Contacts find_contacts(const LiftSystem& system, double t, ConstVectorRef y, LiftWorkspace& w) {
  constexpr double undecided = 1e-6;   // kN
  constexpr double look_ahead = 1e-4;  // s
  const auto count = static_cast<std::size_t>(system.contact_count());
  Eigen::VectorXd indicators(system.contact_count());
  set_state(system, y, w);
  set_drives(system, t, true, w);
  calc_loads(system, t, nullptr, w);
  calc_contact_indicators(w, indicators);
  Contacts contacts(count, 0);
  bool all_decided = true;
  for (std::size_t i = 0; i < count; ++i) {
    const double indicator = indicators[i];
    contacts[i] = indicator > undecided ? 1 : 0;
    all_decided = all_decided && std::abs(indicator) > undecided;
  }
  if (all_decided) return contacts;

  Eigen::VectorXd ydot(system.state_size());
  calc_right_hand_side(system, t, y, &contacts, w, ydot);
  const Eigen::VectorXd mean_velocity = w.v + 0.5 * look_ahead * w.vdot;
  Eigen::VectorXd q_ahead(w.q.size());
  system.mechanism().integrate(w.q, mean_velocity, look_ahead, q_ahead);
  w.q = q_ahead;
  w.v += look_ahead * w.vdot;
  set_drives(system, t + look_ahead, true, w);
  calc_loads(system, t + look_ahead, &contacts, w);
  const Eigen::VectorXd now = indicators;
  calc_contact_indicators(w, indicators);
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (std::abs(now[k]) <= undecided) contacts[i] = indicators[k] > 0.0 ? 1 : 0;
  }
  return contacts;
}

std::string describe_ropes(const LiftSystem& system, const LiftWorkspace& w) {
  std::vector<std::size_t> order(w.rope_loads.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return w.rope_loads[a].elastic_force > w.rope_loads[b].elastic_force;
  });
  std::ostringstream slack, loaded;
  int listed = 0;
  for (const std::size_t i : order) {
    const RopeLoad& load = w.rope_loads[i];
    const std::string& name = system.ropes()[i].name();
    if (!(load.elastic_force > 0.0)) {
      slack << (slack.tellp() > 0 ? ", " : "") << name;
    } else if (listed++ < 3) {
      loaded << (loaded.tellp() > 0 ? ", " : "") << name << " (" << load.elastic_force / 1e3
             << " kN)";
    }
  }
  std::ostringstream text;
  text << "slack ropes: " << (slack.tellp() > 0 ? slack.str() : "none")
       << "; most loaded: " << (loaded.tellp() > 0 ? loaded.str() : "none");
  return text.str();
}

}  // namespace blocklift::dynamics

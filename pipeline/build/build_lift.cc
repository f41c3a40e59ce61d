#include "pipeline/build/build_lift.h"

#include <algorithm>
#include <deque>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/kinematics.h"
#include "pipeline/build/body_box.h"
#include "pipeline/build/held_heading.h"
#include "pipeline/build/hook_block.h"
#include "pipeline/build/lift_marine.h"
#include "pipeline/build/rope_stretch.h"
#include "pipeline/build/spreader_body.h"
#include "pipeline/build/spreader_start.h"
#include "pipeline/build/wish_maker.h"
#include "pipeline/files/lift_case/crane_start.h"
#include "pipeline/mechanism/build_parts.h"

namespace blocklift::pipeline {
namespace {

using dynamics::BodyDefinition;
using dynamics::BodyIndex;
using dynamics::BodyPoint;
using dynamics::Pose;

/// Gathers the parts of a lift; the steps of `build` follow one another.
class LiftBuilder {
 public:
  LiftBuilder(const LiftCase& lift_case, const LoadMass& load,
              const dynamics::HydrodynamicSeries* radiation, const LoadFlexibility* flexibility,
              MarchedWater marched, const FoundMotion& found)
      : case_(lift_case),
        load_(load),
        radiation_(radiation),
        flexibility_(flexibility),
        marched_(std::move(marched)),
        found_(found),
        marine_(marine_of(lift_case)) {}

  BuiltLift build() {
    dynamics::MechanismBuilder builder;
    builder.set_gravity(Vector3(0, 0, -case_.gravity));
    for (const given::Vessel& vessel : case_.vessels) {
      register_body(builder, MarineBuilder::body(vessel), "vessel", {box_around(*vessel.model)});
    }
    for (std::size_t i = 0; i < case_.cranes.size(); ++i) add_crane(builder, i);
    for (const given::Spreader& bar : case_.spreaders) add_spreader(builder, bar);
    add_load(builder);
    if (flexibility_) add_modes(builder);
    const dynamics::Mechanism mechanism = builder.build();
    q_start_ = mechanism.zero_configuration();
    set_start(mechanism);
    add_ropes();
    std::vector<dynamics::Rope> ropes;
    for (const dynamics::RopeDefinition& rope : rope_definitions_) {
      ropes.emplace_back(mechanism, rope);
    }
    std::vector<dynamics::ElasticBody> elastic_bodies = make_elastic_bodies(mechanism, ropes);
    Schedule schedule = make_schedule();
    dynamics::Operation operation = make_operation(mechanism, schedule);
    const auto water = marine_.make_water(place(), radiation_, marched_);
    const auto system = [&](bool at_rest) {
      return dynamics::LiftSystem({mechanism, ropes, make_supports(),
                                   make_elements(mechanism, at_rest), operation, q_start_,
                                   Eigen::VectorXd::Zero(mechanism.nv()), water, elastic_bodies});
    };
    const std::optional<dynamics::HeldHeading> held_heading = find_held_heading(
        case_, ropes_, hoists_, rope_definitions_, {body_of_.at("load"), load_pose().R});
    const bool moves = (case_.wind && case_.wind->is_gusty()) || marine_.has_waves();
    return {system(false),
            body_of_.at("load"),
            std::move(bodies_),
            std::move(hoists_),
            std::move(ropes_),
            std::move(spreaders_),
            std::move(schedule),
            std::move(steerings_),
            moves ? std::optional(system(true)) : std::nullopt,
            marched_,
            water ? marine_.arrangement(place()) : dynamics::Arrangement{},
            {},
            std::nullopt,
            held_heading};
  }

 private:
  struct DrivenJoint {
    std::string drive;
    BodyIndex body;
    int degree_of_freedom;  // from 0
    double start;
  };
  struct HookStart {
    BodyIndex place;  // slides
    BodyIndex hook;
    BodyPoint sheave;
    double length;
    const TurningBlockModel* turning;  // null: it keeps its direction
    std::size_t tackle;                // among the ropes
  };

  void add_crane(dynamics::MechanismBuilder& builder, std::size_t index) {
    const given::Crane& crane = case_.cranes[index];
    const Pose X_WC{rotation_of(crane.attitude), crane.position};
    BaseGround ground;
    if (crane.base) ground = {crane.base->value, body_of_.at(crane.base->value)};
    PartsBuilder& parts =
        crane_parts_.emplace_back(*crane.model, crane.name.value + ".", X_WC, ground);
    const CranePose& pose = crane_poses_.emplace_back(pose_at_start(crane));
    parts.add_bodies(builder);
    parts.add_loops(builder, &pose.mechanism);
    for (const BodyModel* body : parts.added()) {
      note_body(crane.name.value + "." + body->name.value, parts.body(body->name.value), "crane",
                body->shapes);
    }
    for (const DrivenFreedom& freedom : parts.driven()) {
      const std::string& drive = freedom.drive->name.value;
      driven_joints_.push_back({crane.name.value + "." + drive, freedom.body,
                                freedom.degree_of_freedom, crane.find_start(drive)->value.value});
    }
    for (const HoistModel& hoist : crane.model->hoists) add_hoist(builder, index, hoist);
  }

  void add_hoist(dynamics::MechanismBuilder& builder, std::size_t crane_index,
                 const HoistModel& hoist) {
    const given::Crane& crane = case_.cranes[crane_index];
    const HookBlockModel& block = hoist.hook_block;
    const std::string name = crane.name.value + "." + hoist.name.value;
    std::vector<BodyIndex> bodies;
    for (const BodyDefinition& body : hook_bodies(name, block))
      bodies.push_back(builder.add_body(body));
    const BodyIndex index = bodies.back();
    note_body(name, index, "hook block", {BoxShape{block.box_size(), {0, 0, 0}, {0, 0, 0}}});

    const BodyPoint sheave{body_of_.at(crane.name.value + "." + hoist.body.value), hoist.sheave};
    const double length = crane.find_start(hoist.name.value)->value.value;
    hook_starts_.push_back({bodies.front(), index, sheave, length,
                            block.turning ? &*block.turning : nullptr, rope_definitions_.size()});
    LiftHoist added{.name = name,
                    .crane = crane_index,
                    .rope = static_cast<int>(rope_definitions_.size()),
                    .hook = index,
                    .capacity = hoist.capacity,
                    .breaking_load = hoist.rope.breaking_load};
    if (LiftHoist* partner = find_equalised(crane, hoist)) {
      added.rope = partner->rope;
      reeve_together(*partner, hoist, added, sheave, length);
    } else {
      dynamics::RopeDefinition rope;
      rope.name = name;
      // The falls hold the block, on which the hook may turn.
      rope.points = {sheave, {bodies[bodies.size() > 1 ? 1 : 0], Vector3::Zero()}};
      set_rope(rope, hoist.rope, hoist.crane_stiffness, length, case_.hangs(crane, hoist));
      rope_definitions_.push_back(std::move(rope));
    }
    winches_.push_back({added.name, added.rope, length});
    hoists_.push_back(std::move(added));
  }

  /// The other of two equalised hoists where it has been added already; else null.
  LiftHoist* find_equalised(const given::Crane& crane, const HoistModel& hoist) {
    if (!crane.equalised) return nullptr;
    const auto& pair = crane.equalised->value;
    for (std::size_t i = 0; i < 2; ++i) {
      if (pair[i].value != hoist.name.value) continue;
      const std::string partner = crane.name.value + "." + pair[1 - i].value;
      const auto found = std::find_if(hoists_.begin(), hoists_.end(),
                                      [&](const LiftHoist& one) { return one.name == partner; });
      return found == hoists_.end() ? nullptr : &*found;
    }
    return nullptr;
  }

  /// One rope through both tackles. With n falls in each, a rope of n (L1 + L2) under T / n
  /// stretches as (L1 + L2) under T with the stiffness of all falls; what the tackles hang from
  /// gives way under each.
  void reeve_together(LiftHoist& partner, const HoistModel& hoist, const LiftHoist& added,
                      const BodyPoint& sheave, double length) {
    dynamics::RopeDefinition& rope = rope_definitions_[partner.rope];
    partner.hook_is_first = true;
    std::reverse(rope.points.begin(), rope.points.end());
    rope.points.push_back(sheave);
    rope.points.push_back({added.hook, Vector3::Zero()});
    rope.left_out = {0, 1, 0};
    rope.name += " and " + added.name;
    rope.crane_stiffness = 1 / (1 / rope.crane_stiffness + 1 / hoist.crane_stiffness);
    rope.unstretched_length += length;
  }

  void add_spreader(dynamics::MechanismBuilder& builder, const given::Spreader& bar) {
    const BodyIndex index =
        register_body(builder, spreader_body(bar), "spreader", spreader_boxes(bar));
    spreaders_.push_back({bar.name.value, index, {}});
  }

  void add_load(dynamics::MechanismBuilder& builder) {
    BodyDefinition load;
    load.name = "load";
    load.joint.kind = dynamics::JointKind::free;
    load.mass = load_.mass;
    load.p_BoBcm_B = load_.p_BoBcm_B;
    load.I_BBcm_B = load_.I_BBcm_B;
    register_body(builder, load, "load", {box_around(case_.load)});
  }

  /// The load's natural modes, where ropes end at its lugs and so may feel them.
  void add_modes(dynamics::MechanismBuilder& builder) {
    const bool felt = std::any_of(case_.ropes.begin(), case_.ropes.end(), [](const given::Rope& r) {
      return !r.path.front().lug.empty() || !r.path.back().lug.empty();
    });
    if (!felt) return;
    for (Eigen::Index k = 0; k < flexibility_->angular_frequencies.size(); ++k) {
      modes_.push_back(
          builder.add_elastic_mode({.name = fmt::format("load.mode_{}", k + 1),
                                    .body = body_of_.at("load"),
                                    .modal_mass = load_.mass,
                                    .angular_frequency = flexibility_->angular_frequencies[k],
                                    .damping_ratio = flexibility_->damping_ratio}));
    }
  }

  void add_bearings(const dynamics::Mechanism& mechanism, dynamics::ForceElements& elements) const {
    for (const HookStart& hook : hook_starts_) {
      if (!hook.turning || !hook.turning->bearing) continue;
      if (hook.turning->bearing->friction_moment == 0) continue;
      std::get<std::vector<dynamics::JointFriction>>(elements).push_back(
          bearing_friction(mechanism, hook.hook, *hook.turning->bearing));
    }
  }

  /// The load with the ropes that end at its lugs.
  std::vector<dynamics::ElasticBody> make_elastic_bodies(
      const dynamics::Mechanism& mechanism, const std::vector<dynamics::Rope>& ropes) const {
    if (!flexibility_) return {};
    dynamics::ElasticBody::Definition load{"load", body_of_.at("load"), {}, {}, {}, modes_};
    std::vector<Eigen::Index> rows;
    const auto take = [&](const ResolvedPoint& point, int rope, bool last) {
      if (point.lug.empty()) return;
      const auto lug = std::find(flexibility_->lugs.begin(), flexibility_->lugs.end(), point.lug);
      for (int axis = 0; axis < 3; ++axis)
        rows.push_back(3 * (lug - flexibility_->lugs.begin()) + axis);
      load.ends.push_back({rope, last});
    };
    for (std::size_t i = 0; i < case_.ropes.size(); ++i) {
      take(case_.ropes[i].path.front(), ropes_[i].rope, false);
      take(case_.ropes[i].path.back(), ropes_[i].rope, true);
    }
    if (load.ends.empty()) return {};
    load.compliance = flexibility_->compliance(rows, rows);
    load.shapes = flexibility_->shapes(rows, Eigen::all);
    return {dynamics::ElasticBody(mechanism, ropes, std::move(load))};
  }

  BodyIndex register_body(dynamics::MechanismBuilder& builder, const BodyDefinition& body,
                          std::string kind, std::vector<BoxShape> boxes) {
    const BodyIndex index = builder.add_body(body);
    note_body(body.name, index, std::move(kind), std::move(boxes));
    return index;
  }

  void note_body(const std::string& name, BodyIndex index, std::string kind,
                 std::vector<BoxShape> boxes) {
    body_of_[name] = index;
    bodies_.push_back({name, std::move(kind), index, std::move(boxes)});
  }

  void set_rope(dynamics::RopeDefinition& rope, const RopeModel& model, double stiffness_in_series,
                double length, bool hangs) const {
    set_stretch(rope, model);
    rope.crane_stiffness = stiffness_in_series;
    rope.unstretched_length = length;
    if (hangs) rope.weight_per_length = *model.mass_per_length * case_.gravity;
  }

  /// Coordinates of a crane's joints: drives as the case says, the others as its loops lead them.
  void set_crane(const dynamics::Mechanism& mechanism, std::size_t index) {
    const CranePose& pose = crane_poses_[index];
    for (const BodyModel* model : crane_parts_[index].added()) {
      const std::string& name = model->name.value;
      const dynamics::Body& body = mechanism.body(crane_parts_[index].body(name));
      const dynamics::Body& alone = pose.mechanism.body(pose.mechanism.body_index(name));
      q_start_.segment(body.q_offset, body.nq()) = pose.q.segment(alone.q_offset, alone.nq());
    }
  }

  /// Coordinates at the start: cranes as they are put together; load, vessels and hook blocks as
  /// guessed.
  void set_start(const dynamics::Mechanism& mechanism) {
    for (std::size_t i = 0; i < case_.cranes.size(); ++i) set_crane(mechanism, i);
    set_free_start(mechanism, "load", load_pose());
    for (const given::Vessel& vessel : case_.vessels) {
      set_free_start(mechanism, vessel.name.value, marine_.start(vessel.name.value));
    }

    dynamics::Kinematics kinematics(mechanism);
    dynamics::compute_kinematics(mechanism, q_start_, Eigen::VectorXd::Zero(mechanism.nv()),
                                 kinematics);
    for (const HookStart& hook : hook_starts_) {
      const Pose& X_WT = kinematics.X_WB[hook.sheave.body];
      q_start_.segment<3>(mechanism.body(hook.place).q_offset) =
          X_WT.apply(hook.sheave.p_BoQ_B) - Vector3(0, 0, hook.length);
      if (!hook.turning) continue;
      dynamics::RopeDefinition& tackle = rope_definitions_[hook.tackle];
      q_start_[mechanism.body(tackle.points.back().body).q_offset] =
          hang_twin_falls(*hook.turning, X_WT.R, tackle);
    }
    if (!case_.spreaders.empty()) set_spreaders(mechanism, kinematics);
  }

  void set_spreaders(const dynamics::Mechanism& mechanism, dynamics::Kinematics& kinematics) {
    dynamics::compute_kinematics(mechanism, q_start_, Eigen::VectorXd::Zero(mechanism.nv()),
                                 kinematics);
    const auto place = [&](const ResolvedPoint& point) -> Vector3 {
      const std::string body = point.body_name(case_.cranes);
      if (body == "world") return point.point;
      return kinematics.X_WB[body_of_.at(body)].apply(point.point);
    };
    for (const auto& [name, X_WB] : spreader_starts(case_, place))
      set_free_start(mechanism, name, X_WB);
  }

  void set_free_start(const dynamics::Mechanism& mechanism, const std::string& body,
                      const Pose& X_WB) {
    const int offset = mechanism.body(body_of_.at(body)).q_offset;
    q_start_.segment<3>(offset) = X_WB.p;
    q_start_.segment<4>(offset + 3) = dynamics::quaternion_from_rotation(X_WB.R);
  }

  /// Where a point of a body is; for the lines of vessels.
  MarineBuilder::BodyOf place() const {
    return [this](const PointModel& point) {
      const std::string& body = point.body.value;
      return BodyPoint{body == "world" ? dynamics::world_index : body_of_.at(body), point.position};
    };
  }

  dynamics::ForceElements make_elements(const dynamics::Mechanism& mechanism, bool at_rest) {
    dynamics::ForceElements elements;
    add_wind_areas(at_rest, elements);
    for (const PartsBuilder& parts : crane_parts_) parts.add_springs(mechanism, elements);
    add_bearings(mechanism, elements);
    marine_.add_elements(place(), radiation_, at_rest, elements);
    const given::Load& load = case_.load;
    if (!load.vessel) return elements;
    marine_.add_hull("load", body_of_.at("load"), *load.vessel, load.damping,
                     load.quadratic_damping, load_.mass, at_rest, elements);
    return elements;
  }

  Pose load_pose() const { return {rotation_of(case_.load.attitude), case_.load.position}; }

  void add_ropes() {
    for (const given::Rope& rope : case_.ropes) {
      dynamics::RopeDefinition definition;
      definition.name = rope.name.value;
      for (const ResolvedPoint& point : rope.path) {
        const std::string body = point.body_name(case_.cranes);
        definition.points.push_back(
            {body == "world" ? dynamics::world_index : body_of_.at(body), point.point});
      }
      set_rope(definition, rope.rope, rope.end_stiffness, rope.length.value, case_.hangs(rope));
      definition.sheave_friction = rope.friction();
      add_edges(rope, definition);
      const int index = static_cast<int>(rope_definitions_.size());
      if (rope.winch) winches_.push_back({rope.name.value, index, rope.length.value});
      ropes_.push_back({rope.name.value, index, rope.lug(), rope.path.front().lug,
                        case_.hook_above(rope), rope.rope.breaking_load, lift_edges(rope)});
      note_end(rope.path.front(), {index, false, false, rope.path.front().point});
      note_end(rope.path.back(), {index, true, !rope.is_basket(), rope.path.back().point});
      rope_definitions_.push_back(std::move(definition));
    }
  }

  void add_edges(const given::Rope& rope, dynamics::RopeDefinition& definition) const {
    for (std::size_t i = 0; i < rope.edges.size(); ++i) {
      const LoadEdge& edge = rope.edges[i];
      definition.edges.push_back({.name = edge.name.value,
                                  .body = body_of_.at("load"),
                                  .after = static_cast<std::size_t>(rope.over[i].span.value - 1),
                                  .begin_B = edge.from,
                                  .end_B = edge.to,
                                  .outside_B = edge.outside,
                                  .radius = edge.radius,
                                  .friction = edge.friction});
    }
  }

  static std::vector<LiftEdge> lift_edges(const given::Rope& rope) {
    std::vector<LiftEdge> edges;
    for (const LoadEdge& edge : rope.edges)
      edges.push_back(
          {edge.name.value, edge.length(), edge.radius, edge.contact_length, edge.friction});
    return edges;
  }

  void note_end(const ResolvedPoint& point, const LiftSpreader::End& end) {
    if (point.kind != ResolvedPoint::Kind::spreader) return;
    for (LiftSpreader& bar : spreaders_)
      if (bar.name == point.part) bar.ends.push_back(end);
  }

  void add_wind_areas(bool at_rest, dynamics::ForceElements& elements) const {
    if (!case_.wind) return;
    const auto wind = case_.wind->make_field(at_rest);
    const auto add = [&](const std::string& body, const WindAreaModel& area) {
      add_wind_area(body, body_of_.at(body), area, wind, elements);
    };
    for (std::size_t i = 0; i < case_.cranes.size(); ++i) {
      crane_parts_[i].add_wind_areas(wind, elements);
      for (const HoistModel& hoist : case_.cranes[i].model->hoists) {
        if (hoist.hook_block.wind_area == 0) continue;
        add(case_.cranes[i].name.value + "." + hoist.name.value,
            {hoist.hook_block.wind_area, hoist.hook_block.wind_coefficient, std::nullopt,
             Vector3::Zero()});
      }
    }
    if (!case_.load.model) return;
    for (const WindAreaModel& area : case_.load.model->wind_areas) add("load", area);
  }

  std::vector<dynamics::SupportPad> make_supports() const {
    std::vector<dynamics::SupportPad> pads;
    for (const given::Support& support : case_.supports) {
      dynamics::SupportPad::Definition pad;
      pad.name = support.name.value;
      pad.point = {body_of_.at("load"), support.point};
      pad.p_WG = load_pose().apply(support.point);
      pad.p_WG.z() = support.ground;
      pad.stiffness = support.stiffness;
      pad.damping = support.damping;
      pad.friction_coefficient = support.friction_coefficient;
      pad.tangential_stiffness = support.tangential_stiffness;
      if (support.reach) pad.reach = *support.reach;
      pads.emplace_back(std::move(pad));
    }
    if (case_.ground_contact) add_ground(*case_.ground_contact, pads);
    return pads;
  }

  /// The corners of the load's box, which come to stand on the ground wherever they touch it.
  void add_ground(const given::Ground& ground, std::vector<dynamics::SupportPad>& pads) const {
    const BoxShape box = box_around(case_.load);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 side((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                         (corner & 4) != 0 ? 0.5 : -0.5);
      const Vector3 point = box.centre + box.size.cwiseProduct(side);
      dynamics::SupportPad::Definition pad;
      pad.name = fmt::format("ground_{}", corner + 1);
      pad.point = {body_of_.at("load"), point};
      pad.p_WG = load_pose().apply(point);
      pad.p_WG.z() = case_.ground_height().value();
      pad.stiffness = ground.stiffness;
      pad.damping = ground.damping;
      pad.friction_coefficient = ground.friction_coefficient;
      pad.tangential_stiffness = ground.tangential_stiffness;
      // Sliding is damped in the same time as sinking in.
      pad.tangential_damping = ground.damping * ground.tangential_stiffness / ground.stiffness;
      pad.ground = true;
      pads.emplace_back(std::move(pad));
    }
  }

  Schedule make_schedule() const {
    Diagnostics diagnostics;
    Schedule schedule = schedule_operation(case_, diagnostics, found_);
    if (diagnostics.has_errors()) throw InputError(diagnostics);
    return schedule;
  }

  dynamics::Operation make_operation(const dynamics::Mechanism& mechanism,
                                     const Schedule& schedule) {
    dynamics::OperationBuilder builder;
    for (const DrivenJoint& drive : driven_joints_) {
      builder.add_joint_drive(mechanism, drive.drive, drive.body, drive.start,
                              drive.degree_of_freedom);
    }
    for (const WinchStart& winch : winches_) {
      builder.add_winch(winch.name, winch.rope, winch.length);
    }
    add_schedule(schedule, builder);
    const WishMaker wishes(case_, body_of_, ropes_, hoists_);
    for (const ScheduledSteering& steered : schedule.steerings) {
      dynamics::Steering steering = steered.steering;
      steering.wish = wishes.make_wish(steered.keep, steering.drive);
      steerings_.push_back({steering.drive, steering.wish, steering.start, steering.end});
      if (!steered.course) builder.add_steering(steered.steering.drive, std::move(steering));
    }
    for (const given::Fault& fault : case_.faults) add_fault(fault, schedule, builder);
    if (case_.wind) builder.add_breakpoints(case_.wind->breakpoints());
    return builder.build(schedule.duration);
  }

  int rope_of(const std::string& name) const { return find_rope(ropes_, hoists_, name); }

  void add_fault(const given::Fault& fault, const Schedule& schedule,
                 dynamics::OperationBuilder& builder) const {
    if (!fault.at && !found_.fault) return;
    const double at = fault.at ? fault.at->value : *found_.fault;
    for (const Located<std::string>& name : fault.stops) {
      for (const Mover& mover : schedule.movers)
        if (name.value == mover.name || name.value == "all")
          builder.add_stop(mover.name, at, fault.within);
    }
    for (const Located<std::string>& winch : fault.runs_away)
      builder.add_runaway(winch.value, at, *fault.caught_after, *fault.speed, fault.within);
    for (const Located<std::string>& name : fault.parts)
      builder.add_parting(rope_of(name.value), at);
  }

  struct WinchStart {
    std::string name;
    int rope;
    double length;
  };

  const LiftCase& case_;
  const LoadMass& load_;
  const dynamics::HydrodynamicSeries* radiation_;
  const LoadFlexibility* flexibility_;
  MarchedWater marched_;
  const FoundMotion& found_;
  MarineBuilder marine_;
  std::vector<int> modes_;  // among the mechanism's elastic ones
  std::map<std::string, BodyIndex> body_of_;
  std::deque<PartsBuilder> crane_parts_;
  std::deque<CranePose> crane_poses_;
  std::vector<LiftBody> bodies_;
  std::vector<LiftHoist> hoists_;
  std::vector<LiftRope> ropes_;
  std::vector<LiftSpreader> spreaders_;
  std::vector<LiftSteering> steerings_;
  std::vector<DrivenJoint> driven_joints_;
  std::vector<HookStart> hook_starts_;
  std::vector<WinchStart> winches_;
  std::vector<dynamics::RopeDefinition> rope_definitions_;
  Eigen::VectorXd q_start_;
};

}  // namespace

dynamics::BodyPoint upper_sheave(const dynamics::Rope& tackle, const LiftHoist& hoist) {
  const std::vector<BodyPoint>& points = tackle.points();
  if (tackle.definition().twin_falls)
    return {points[0].body, 0.5 * (points[0].p_BoQ_B + points[2].p_BoQ_B)};
  return hoist.hook_is_first ? points[1] : *(points.end() - 2);
}

int find_rope(const std::vector<LiftRope>& ropes, const std::vector<LiftHoist>& hoists,
              const std::string& name) {
  for (const LiftRope& rope : ropes)
    if (rope.name == name) return rope.rope;
  for (const LiftHoist& hoist : hoists)
    if (hoist.name == name) return hoist.rope;
  throw dynamics::ModelError("the lift has no rope or hoist \"" + name + "\"");
}

LoadMass load_mass(const VesselModel& vessel) {
  const Vector3 squares = vessel.radii_of_gyration.cwiseAbs2();
  return {vessel.mass, vessel.centre_of_mass, (vessel.mass * squares).asDiagonal()};
}

RadiationProblem radiation_problem(const LiftCase& lift_case) {
  return marine_of(lift_case).radiation_problem();
}

BuiltLift build_lift(const LiftCase& lift_case, const LoadMass& load,
                     const dynamics::HydrodynamicSeries* radiation,
                     const LoadFlexibility* flexibility, MarchedWater marched,
                     const FoundMotion& found) {
  if (lift_case.load_table) {
    throw std::invalid_argument("case " + lift_case.name +
                                " is a load table: it has no cranes whose motion could be built");
  }
  return LiftBuilder(lift_case, load, radiation, flexibility, std::move(marched), found).build();
}

}  // namespace blocklift::pipeline

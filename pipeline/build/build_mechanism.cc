#include "pipeline/build/build_mechanism.h"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/loop_constraint.h"
#include "pipeline/build/rope_stretch.h"
#include "pipeline/files/lift_case/own_laws.h"
#include "pipeline/files/mechanism/mechanism_schedule.h"
#include "pipeline/mechanism/build_parts.h"
#include "pipeline/mechanism/joint_values.h"

namespace blocklift::pipeline {
namespace {

using dynamics::LoadTable;
using dynamics::MotionProfile;

/// Open by more than this counts as open where loops must be closed as given, m or rad, or their
/// rates.
constexpr double closed = 1e-6;

LoadTable load_table(const std::optional<Located<Components>>& constant,
                     const std::optional<Located<LoadOverTime>>& table) {
  const auto vector_of = [](const Components& c) {
    return c.size() == 3 ? Vector3(c[0], c[1], c[2]) : Vector3(c.at(0), 0, 0);
  };
  if (constant) return LoadTable(vector_of(constant->value));
  if (!table) return LoadTable(Vector3::Zero());
  std::vector<double> times;
  std::vector<Vector3> values;
  for (const TimedComponents& row : table->value) {
    times.push_back(row.time);
    values.push_back(vector_of(row.components));
  }
  return {std::move(times), std::move(values)};
}

/// Mass of all that a vessel carries by joints, kg.
double mass_on(const MechanismFile& file, const std::string& vessel) {
  double mass = 0;
  for (const JointModel& joint : file.joints) {
    if (joint.parent.value != vessel) continue;
    mass += file.find_body(joint.child.value)->mass + mass_on(file, joint.child.value);
  }
  return mass;
}

/// Gathers a mechanism; the steps of `build` follow one another.
class MechanismAssembler {
 public:
  MechanismAssembler(const MechanismFile& file, const dynamics::HydrodynamicSeries* radiation,
                     MarchedWater marched, const FoundMotion& found)
      : file_(file),
        schedule_(schedule_of(file, found)),
        radiation_(radiation),
        marched_(std::move(marched)),
        marine_(file, -file.gravity.z()),
        parts_(file, "", dynamics::Pose::identity()) {
    marine_.place([&](const std::string& vessel) { return mass_on(file, vessel); });
  }

  BuiltMechanism build() {
    const dynamics::Mechanism mechanism = make_mechanism(parts_, {});
    q_ = mechanism.zero_configuration();
    v_ = Eigen::VectorXd::Zero(mechanism.nv());
    set_initial_state(mechanism);
    set_ropes(mechanism);
    add_breakpoints();
    dynamics::Operation operation = make_operation(mechanism);
    set_driven(operation);
    close_loops(mechanism);
    std::map<std::string, dynamics::BodyIndex> carried_by;
    for (const JointModel& joint : file_.joints) {
      carried_by[joint.name.value] = parts_.carried_by(joint.name.value);
    }
    const auto water = marine_.make_water(place(), radiation_, marched_);
    const auto system = [&](bool at_rest) {
      return dynamics::LiftSystem(
          {mechanism, ropes_, {}, make_elements(mechanism, at_rest), operation, q_, v_, water});
    };
    const bool moves = (file_.wind && file_.wind->is_gusty()) || marine_.has_waves();
    return {system(false),
            std::move(carried_by),
            moves ? std::optional(system(true)) : std::nullopt,
            marched_,
            water ? marine_.arrangement(place()) : dynamics::Arrangement{},
            schedule_};
  }

 private:
  dynamics::Mechanism make_mechanism(PartsBuilder& parts,
                                     const std::vector<std::string>& held) const {
    dynamics::MechanismBuilder builder;
    builder.set_gravity(file_.gravity);
    parts.add_bodies(builder, held);
    parts.add_loops(builder);
    return builder.build();
  }

  MarineBuilder::BodyOf place() const {
    return [this](const PointModel& at) { return parts_.point(at.body.value, at.position); };
  }

  void set_initial_state(const dynamics::Mechanism& mechanism) {
    for (const given::Vessel& vessel : file_.vessels) {
      const dynamics::Pose& X_WB = marine_.start(vessel.name.value);
      const int offset = mechanism.body(parts_.body(vessel.name.value)).q_offset;
      q_.segment<3>(offset) = X_WB.p;
      q_.segment<4>(offset + 3) = dynamics::quaternion_from_rotation(X_WB.R);
    }
    parts_.set_positions(mechanism, file_.initial.positions, q_);
    for (const auto& velocity : file_.initial.velocities) {
      const JointModel& joint = *file_.find_joint(velocity.name.value);
      const dynamics::Body& body = mechanism.body(parts_.carried_by(joint.name.value));
      v_.segment(body.v_offset, body.nv()) =
          joint_velocity(joint.kind, velocity.value.value).values;
    }
  }

  void set_ropes(const dynamics::Mechanism& mechanism) {
    for (const given::Rope& rope : file_.ropes) {
      dynamics::RopeDefinition definition;
      definition.name = rope.name.value;
      const auto add = [&](const Located<RopePoint>& at) {
        definition.points.push_back(parts_.point(at.value.body->value, at.value.point));
      };
      add(rope.from);
      for (const Located<RopePoint>& sheave : rope.through) add(sheave);
      add(rope.to);
      set_stretch(definition, rope.rope);
      definition.crane_stiffness = rope.end_stiffness;
      definition.unstretched_length = rope.length.value;
      definition.sheave_friction = rope.friction();
      ropes_.emplace_back(mechanism, std::move(definition));
    }
  }

  /// Times at which a force changes its slope.
  void add_breakpoints() {
    for (const ForceModel& model : file_.forces) {
      for (const LoadTable& table : {load_table(model.force, model.force_table),
                                     load_table(model.moment, model.moment_table)}) {
        breakpoints_.insert(breakpoints_.end(), table.breakpoints().begin(),
                            table.breakpoints().end());
      }
    }
  }

  dynamics::ForceElements make_elements(const dynamics::Mechanism& mechanism, bool at_rest) {
    dynamics::ForceElements elements;
    parts_.add_springs(mechanism, elements);
    if (file_.wind) parts_.add_wind_areas(file_.wind->make_field(at_rest), elements);
    marine_.add_elements(place(), radiation_, at_rest, elements);
    add_forces(mechanism, elements);
    return elements;
  }

  void add_forces(const dynamics::Mechanism& mechanism, dynamics::ForceElements& elements) const {
    for (const ForceModel& model : file_.forces) {
      LoadTable force = load_table(model.force, model.force_table);
      LoadTable moment = load_table(model.moment, model.moment_table);
      if (model.body) {
        dynamics::AppliedLoad::Definition load;
        load.name = model.name.value;
        load.point = parts_.point(
            model.body->value, model.position ? model.position->value : Vector3(Vector3::Zero()));
        const bool turns_along = model.frame && model.frame->value == LoadFrame::body;
        load.axes =
            turns_along ? dynamics::AppliedLoad::Axes::body : dynamics::AppliedLoad::Axes::world;
        load.force = std::move(force);
        load.moment = std::move(moment);
        std::get<std::vector<dynamics::AppliedLoad>>(elements).emplace_back(std::move(load));
        continue;
      }
      dynamics::JointLoad::Definition load;
      load.name = model.name.value;
      load.body = parts_.carried_by(model.joint->value);
      load.degree_of_freedom = model.degree_of_freedom ? model.degree_of_freedom->value - 1 : 0;
      load.load = model.force || model.force_table ? std::move(force) : std::move(moment);
      std::get<std::vector<dynamics::JointLoad>>(elements).emplace_back(mechanism, std::move(load));
    }
  }

  static Schedule schedule_of(const MechanismFile& file, const FoundMotion& found) {
    Diagnostics diagnostics;
    Schedule schedule = schedule_operation(file, diagnostics, found);
    if (diagnostics.has_errors()) throw InputError(diagnostics);
    return schedule;
  }

  dynamics::BodyPoint point_of(const Located<RopePoint>& at) const {
    return parts_.point(at.value.body->value, at.value.point);
  }

  int rope_of(const std::string& name) const {
    const auto found = std::ranges::find_if(
        file_.ropes, [&](const given::Rope& rope) { return rope.name.value == name; });
    return static_cast<int>(found - file_.ropes.begin());
  }

  dynamics::Sight make_sight(const given::Sight& sight) const {
    if (sight.over) return dynamics::SeenPlumb{point_of(*sight.with), point_of(*sight.over)};
    if (sight.pull) return dynamics::SeenTension{rope_of(sight.pull->value)};
    if (sight.share) {
      dynamics::SeenShare seen{rope_of(sight.share->value), {}};
      for (const Located<std::string>& other : sight.of)
        seen.others.push_back(rope_of(other.value));
      return seen;
    }
    dynamics::SeenHeight seen{point_of(*sight.level), {dynamics::world_index, Vector3::Zero()}};
    if (sight.with) seen.reference = point_of(*sight.with);
    return seen;
  }

  void add_steerings(dynamics::OperationBuilder& builder) const {
    for (const ScheduledSteering& steered : schedule_.steerings) {
      if (steered.course) continue;
      dynamics::OwnLaw law = make_own_law(steered.keep, file_.laws);
      for (const given::Sight& sight : steered.keep.sees) law.sights.push_back(make_sight(sight));
      dynamics::Steering steering = steered.steering;
      steering.wish = std::move(law);
      builder.add_steering(steered.steering.drive, std::move(steering));
    }
  }

  dynamics::Operation make_operation(const dynamics::Mechanism& mechanism) const {
    dynamics::OperationBuilder builder;
    for (const DrivenFreedom& freedom : parts_.driven()) {
      const DriveModel& drive = *freedom.drive;
      const double start = q_[mechanism.body(freedom.body).q_offset + freedom.degree_of_freedom];
      builder.add_joint_drive(mechanism, drive.name.value, freedom.body, start,
                              freedom.degree_of_freedom);
      if (drive.constant_speed) {
        const double speed = drive.constant_speed->value.value;
        builder.set_motion(drive.name.value, MotionProfile::along(dynamics::NaturalSpline(
                                                 {0.0, 1.0}, {start, start + speed})));
      } else if (drive.table) {
        std::vector<double> times, values;
        for (const auto& point : drive.table->value) {
          times.push_back(point[0].value);
          values.push_back(point[1].value);
        }
        builder.set_motion(drive.name.value, MotionProfile::along(dynamics::NaturalSpline(
                                                 std::move(times), std::move(values))));
      }
    }
    for (std::size_t i = 0; i < file_.ropes.size(); ++i) {
      const given::Rope& rope = file_.ropes[i];
      if (rope.winch) builder.add_winch(rope.name.value, static_cast<int>(i), rope.length.value);
    }
    add_schedule(schedule_, builder);
    add_steerings(builder);
    builder.add_breakpoints(breakpoints_);
    if (file_.wind) builder.add_breakpoints(file_.wind->breakpoints());
    return builder.build(file_.simulate.duration.value);
  }

  /// Driven coordinates and velocities come from their drives.
  void set_driven(const dynamics::Operation& operation) {
    for (const dynamics::JointDrive& drive : operation.joint_drives()) {
      const dynamics::ProfileValue value = drive.position.evaluate(0.0);
      q_[drive.coordinate_index] = value.position;
      v_[drive.velocity_index] = value.velocity;
    }
  }

  void close_loops(const dynamics::Mechanism& mechanism) {
    if (mechanism.loops().empty()) return;
    if (file_.initial.assembly == Assembly::as_given) {
      require_closed(mechanism.with_loops_as_at(q_));
    } else if (file_.initial.held.empty()) {
      dynamics::assemble(mechanism, q_, v_);
    } else {
      std::vector<std::string> held;
      for (const Located<std::string>& joint : file_.initial.held) held.push_back(joint.value);
      PartsBuilder parts(file_, "", dynamics::Pose::identity());
      dynamics::assemble(make_mechanism(parts, held), q_, v_);
    }
  }

  void require_closed(const dynamics::Mechanism& mechanism) const {
    dynamics::Kinematics kinematics(mechanism);
    dynamics::compute_kinematics(mechanism, q_, v_, kinematics);
    dynamics::LoopState state(mechanism);
    dynamics::compute_loops(mechanism, kinematics, q_, v_, state);
    const std::string open = dynamics::describe_residual(mechanism, state.residual, closed);
    const std::string moving = dynamics::describe_residual(mechanism, state.velocity, closed);
    const std::string advice = "; correct the initial state, or let assembly: nearest close them";
    if (state.residual.cwiseAbs().maxCoeff() > closed) {
      throw dynamics::ModelError("the loops are open at the start: " + open + advice);
    }
    if (state.velocity.cwiseAbs().maxCoeff() > closed) {
      throw dynamics::ModelError("the initial velocities open the loops, each second: " + moving +
                                 advice);
    }
  }

  const MechanismFile& file_;
  Schedule schedule_;
  const dynamics::HydrodynamicSeries* radiation_;
  MarchedWater marched_;
  MarineBuilder marine_;
  PartsBuilder parts_;
  Eigen::VectorXd q_, v_;
  std::vector<dynamics::Rope> ropes_;
  std::vector<double> breakpoints_;
};

}  // namespace

RadiationProblem radiation_problem(const MechanismFile& file) {
  MarineBuilder marine(file, -file.gravity.z());
  marine.place([&](const std::string& vessel) { return mass_on(file, vessel); });
  return marine.radiation_problem();
}

BuiltMechanism build_mechanism(const MechanismFile& file,
                               const dynamics::HydrodynamicSeries* radiation, MarchedWater marched,
                               const FoundMotion& found) {
  return MechanismAssembler(file, radiation, std::move(marched), found).build();
}

std::optional<MechanismFile> read_mechanism(const std::filesystem::path& path,
                                            ModelLibrary& library, Diagnostics& diagnostics) {
  std::optional<MechanismFile> file = read_mechanism_file(path, library, diagnostics);
  if (!file) return std::nullopt;
  try {
    // Laws are given later: until then the drives that they steer stand.
    MechanismFile trial = *file;
    for (const given::Stage& stage : trial.operation)
      for (const given::Move& move : stage.moves)
        if (move.keeps)
          trial.laws[move.keeps->law->value] = [](const std::vector<std::string>&) {
            return [](double, std::span<const double>) { return 0.0; };
          };
    build_mechanism(trial);
    return file;
  } catch (const std::exception& error) {
    diagnostics.error(file->place, error.what());
    return std::nullopt;
  }
}

}  // namespace blocklift::pipeline

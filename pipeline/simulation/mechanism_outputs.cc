#include "pipeline/simulation/mechanism_outputs.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "dynamics/multibody/loop_constraint.h"
#include "dynamics/rope/mooring_line.h"

namespace blocklift::pipeline {
namespace {

using dynamics::Body;
using dynamics::JointKind;

const std::vector<std::string> xyz = {"x", "y", "z"};

std::vector<OutputColumn> columns_of(const std::vector<std::string>& names,
                                     const std::string& unit) {
  std::vector<OutputColumn> columns;
  for (const std::string& name : names) columns.push_back({name, unit});
  return columns;
}

/// Names of a joint's velocities, in the kernel's order.
std::vector<std::string> velocity_names(JointKind kind) {
  switch (kind) {
    case JointKind::cylindrical:
      return {"angle", "displacement"};
    case JointKind::universal:
      return {"first_angle", "second_angle"};
    case JointKind::spherical:
      return {"about_x", "about_y", "about_z"};
    case JointKind::planar:
      return {"first_displacement", "second_displacement", "angle"};
    case JointKind::translational:
      return xyz;
    case JointKind::free:
      return {"about_x", "about_y", "about_z", "along_x", "along_y", "along_z"};
    case JointKind::fixed:
      return {};
    case JointKind::revolute:
    case JointKind::prismatic:
      break;
  }
  return {""};
}

std::vector<OutputColumn> coordinate_columns(JointKind kind) {
  std::vector<OutputColumn> quaternion = {{"w", "1"}, {"x", "1"}, {"y", "1"}, {"z", "1"}};
  if (kind == JointKind::spherical) return quaternion;
  if (kind == JointKind::free) {
    std::vector<OutputColumn> columns = columns_of(xyz, "m");
    for (const OutputColumn& column : quaternion) columns.push_back({"q" + column.name, "1"});
    return columns;
  }
  std::vector<OutputColumn> columns;
  const std::vector<std::string> names = velocity_names(kind);
  const std::vector<bool> turns = joint_turns(kind);
  for (std::size_t i = 0; i < names.size(); ++i) {
    columns.push_back({names[i], turns[i] ? "rad" : "m"});
  }
  return columns;
}

std::vector<OutputColumn> velocity_columns(JointKind kind, const char* angular,
                                           const char* linear) {
  std::vector<OutputColumn> columns;
  const std::vector<std::string> names = velocity_names(kind);
  const std::vector<bool> turns = joint_turns(kind);
  for (std::size_t i = 0; i < names.size(); ++i) {
    columns.push_back({names[i], turns[i] ? angular : linear});
  }
  return columns;
}

Eigen::VectorXd energy_series(const std::string& kind, const dynamics::EnergyHistory& e) {
  Eigen::VectorXd total = e.kinetic + e.gravity + e.elastic;
  if (kind == "total") return total;
  if (kind == "kinetic") return e.kinetic;
  if (kind == "gravity") return e.gravity;
  if (kind == "elastic") return e.elastic;
  if (kind == "drive_work") return e.drive_work;
  if (kind == "winch_work") return e.winch_work;
  if (kind == "outside_work") return e.outside_work;
  if (kind == "dissipated") return e.dissipated;
  return total.array() - total[0] -
         (e.drive_work + e.winch_work + e.outside_work - e.dissipated).array();
}

template <class Element>
const Element* find_element(const dynamics::LiftSystem& system, const std::string& name) {
  for (const Element& element : std::get<std::vector<Element>>(system.elements())) {
    if (element.name() == name) return &element;
  }
  return nullptr;
}

}  // namespace

std::string OutputSeries::units() const {
  std::string all;
  bool same = true;
  for (const OutputColumn& column : columns) {
    all += (all.empty() ? "" : ", ") + column.unit;
    same = same && column.unit == columns.front().unit;
  }
  return same && !columns.empty() ? columns.front().unit : all;
}

std::string OutputSeries::column_name(std::size_t column) const {
  return columns[column].name.empty() ? name : name + "." + columns[column].name;
}

OutputRecorder::OutputRecorder(const MechanismFile& file, const BuiltMechanism& mechanism,
                               Eigen::Index sample_count)
    : mechanism_(mechanism),
      sample_count_(sample_count),
      A_WB_(static_cast<std::size_t>(mechanism.system.mechanism().body_count()),
            dynamics::MotionVector::zero()) {
  for (const OutputModel& output : file.outputs) add(output);
  if (file.outputs.empty()) add_everything(file);
}

void OutputRecorder::add(const OutputModel& output) {
  const std::string& name = output.name.value;
  std::string quantity = output.quantity ? output.quantity->value : "";
  if (quantity.empty()) quantity = output_quantities(output_subject(output)).front();
  if (output.joint) add_joint(name, output.joint->value, quantity);
  if (output.point) add_point(name, *output.point, quantity);
  if (output.spring) add_spring(name, output.spring->value, quantity);
  if (output.rope) add_rope(name, output.rope->value, quantity);
  if (output.loop) {
    add_loop(name, output.loop->value, output.quantity ? quantity : std::string());
  }
  if (output.energy) add_energy(name, output.energy->value);
}

void OutputRecorder::add_everything(const MechanismFile& file) {
  for (const JointModel& joint : file.joints) {
    if (joint.kind == JointKind::fixed) continue;
    add_joint(joint.name.value + "_position", joint.name.value, "position");
    add_joint(joint.name.value + "_velocity", joint.name.value, "velocity");
  }
  for (const SpringModel& spring : file.springs) {
    add_spring(spring.name.value + "_force", spring.name.value, "force");
  }
  for (const given::Rope& rope : file.ropes) {
    add_rope(rope.name.value + "_tension", rope.name.value, "tension");
  }
  const auto add_tension = [&](const auto& line) {
    if (!file.find_rope(line.name.value)) add_line(line.name.value + "_tension", line.name.value);
  };
  std::for_each(file.moorings.begin(), file.moorings.end(), add_tension);
  std::for_each(file.tuggers.begin(), file.tuggers.end(), add_tension);
  for (const LoopModel& loop : file.loops) {
    add_loop(loop.name.value + "_force", loop.name.value, "");
  }
  for (const char* energy : {"kinetic", "gravity", "elastic", "total", "imbalance"}) {
    add_energy(std::string(energy) + "_energy", energy);
  }
}

void OutputRecorder::add_series(const std::string& name, std::string description,
                                std::vector<OutputColumn> columns, Fill fill) {
  const auto count = static_cast<Eigen::Index>(columns.size());
  series_.push_back({name, std::move(description), std::move(columns),
                     RowMajorMatrix::Zero(sample_count_, count)});
  fills_.push_back(std::move(fill));
  energies_.emplace_back();
}

void OutputRecorder::add_joint(const std::string& name, const std::string& joint,
                               const std::string& quantity) {
  const Body& body = mechanism_.system.mechanism().body(mechanism_.carried_by.at(joint));
  const int q = body.q_offset;
  const int v = body.v_offset;
  const int nq = body.nq();
  const int nv = body.nv();
  const JointKind kind = body.joint.kind;
  const std::string description =
      fmt::format("{} of joint {} ({})", quantity, joint, dynamics::joint_kind_name(kind));
  using Row = Eigen::Ref<Eigen::RowVectorXd>;
  if (quantity == "position") {
    add_series(name, description, coordinate_columns(kind),
               [q, nq](const Instant& now, Row row) { row = now.w.q.segment(q, nq).transpose(); });
  } else if (quantity == "velocity") {
    add_series(name, description, velocity_columns(kind, "rad/s", "m/s"),
               [v, nv](const Instant& now, Row row) { row = now.w.v.segment(v, nv).transpose(); });
  } else if (quantity == "acceleration") {
    add_series(
        name, description, velocity_columns(kind, "rad/s^2", "m/s^2"),
        [v, nv](const Instant& now, Row row) { row = now.w.vdot.segment(v, nv).transpose(); });
  } else {
    // Entries that no drive prescribes are loads from outside: the drive's force there is zero.
    const std::vector<bool> driven = body.driven;
    add_series(name, description + ", that its drive must give", velocity_columns(kind, "N m", "N"),
               [v, driven](const Instant& now, Row row) {
                 for (std::size_t i = 0; i < driven.size(); ++i) {
                   const auto k = static_cast<Eigen::Index>(i);
                   row[k] = driven[i] ? now.w.joint_force[v + k] : 0.0;
                 }
               });
  }
}

void OutputRecorder::add_point(const std::string& name, const PointModel& point,
                               const std::string& quantity) {
  const std::string& body_name = point.body.value;
  const dynamics::BodyIndex body = body_name == "world"
                                       ? dynamics::world_index
                                       : mechanism_.system.mechanism().body_index(body_name);
  const auto b = static_cast<std::size_t>(body);
  const Vector3 p = point.position;
  const std::string of_point =
      fmt::format("{} of a point of {}, in the world", quantity, body_name);
  const std::string of_body = fmt::format("{} of {}, in the world", quantity, body_name);
  using Row = Eigen::Ref<Eigen::RowVectorXd>;
  if (quantity == "position") {
    add_series(name, of_point, columns_of(xyz, "m"), [=](const Instant& now, Row row) {
      row = dynamics::point_position(now.w.kinematics, body, p).transpose();
    });
  } else if (quantity == "velocity") {
    add_series(name, of_point, columns_of(xyz, "m/s"), [=](const Instant& now, Row row) {
      row = dynamics::point_velocity(now.w.kinematics, body, p).transpose();
    });
  } else if (quantity == "acceleration") {
    add_series(name, of_point, columns_of(xyz, "m/s^2"), [=](const Instant& now, Row row) {
      row = dynamics::point_acceleration(now.w.kinematics, now.A_WB, body, p).transpose();
    });
  } else if (quantity == "orientation") {
    add_series(name, of_body + ": quaternion", columns_of({"w", "x", "y", "z"}, "1"),
               [=](const Instant& now, Row row) {
                 row = dynamics::quaternion_from_rotation(now.w.kinematics.X_WB[b].R).transpose();
               });
  } else if (quantity == "angular_velocity") {
    add_series(name, of_body, columns_of(xyz, "rad/s"), [=](const Instant& now, Row row) {
      row = now.w.kinematics.V_WB[b].angular.transpose();
    });
  } else {
    add_series(name, of_body, columns_of(xyz, "rad/s^2"),
               [=](const Instant& now, Row row) { row = now.A_WB[b].angular.transpose(); });
  }
}

void OutputRecorder::add_spring(const std::string& name, const std::string& spring,
                                const std::string& quantity) {
  using Row = Eigen::Ref<Eigen::RowVectorXd>;
  const bool force = quantity == "force";
  if (const auto* line = find_element<dynamics::PointSpring>(mechanism_.system, spring)) {
    add_series(name, fmt::format("{} of spring {}, positive in tension", quantity, spring),
               {{"", force ? "N" : "m"}}, [line, force](const Instant& now, Row row) {
                 const dynamics::MotionState state{now.time, now.w.q, now.w.v, now.w.kinematics};
                 const auto& d = line->definition();
                 const Vector3 span =
                     dynamics::point_position(now.w.kinematics, d.to.body, d.to.p_BoQ_B) -
                     dynamics::point_position(now.w.kinematics, d.from.body, d.from.p_BoQ_B);
                 row[0] = force ? line->calc_tension(state) : span.norm() - d.free_length;
               });
    return;
  }
  if (const auto* torsional = find_element<dynamics::TorsionalSpring>(mechanism_.system, spring)) {
    const std::string what = force ? "moment on the second body" : "turn of the second body";
    add_series(
        name, fmt::format("{} of spring {}, in the world's axes", what, spring),
        columns_of(xyz, force ? "N m" : "rad"), [torsional, force](const Instant& now, Row row) {
          const dynamics::MotionState state{now.time, now.w.q, now.w.v, now.w.kinematics};
          row = (force ? torsional->calc_moment(state) : torsional->calc_turn(state)).transpose();
        });
    return;
  }
  const auto* turn = find_element<dynamics::JointSpring>(mechanism_.system, spring);
  const dynamics::JointSpring::Definition& d = turn->definition();
  const Body& body = mechanism_.system.mechanism().body(d.body);
  const bool turns = joint_turns(body.joint.kind)[d.degree_of_freedom];
  const int q = body.q_offset + d.degree_of_freedom;
  const int v = body.v_offset + d.degree_of_freedom;
  const std::string unit = force ? (turns ? "N m" : "N") : (turns ? "rad" : "m");
  add_series(
      name,
      fmt::format("{} of spring {}, positive where it draws the joint back", quantity, spring),
      {{"", unit}}, [&d, q, v, force](const Instant& now, Row row) {
        const double deflection = now.w.q[q] - d.free_coordinate;
        row[0] = force ? d.stiffness * deflection + d.damping * now.w.v[v] : deflection;
      });
}

void OutputRecorder::add_rope(const std::string& name, const std::string& rope,
                              const std::string& quantity) {
  using Row = Eigen::Ref<Eigen::RowVectorXd>;
  const std::vector<dynamics::Rope>& ropes = mechanism_.system.ropes();
  const bool is_rope = std::any_of(ropes.begin(), ropes.end(),
                                   [&](const dynamics::Rope& of) { return of.name() == rope; });
  if (!is_rope) return add_line(name, rope);
  const auto i = static_cast<std::size_t>(mechanism_.system.rope_index(rope));
  const std::string description = fmt::format("{} of rope {}", quantity, rope);
  if (quantity == "tension") {
    add_series(name, description, {{"", "N"}},
               [i](const Instant& now, Row row) { row[0] = now.w.rope_loads[i].tension; });
  } else if (quantity == "first_tension" || quantity == "last_tension") {
    const bool last = quantity == "last_tension";
    add_series(name, fmt::format("tension of rope {} at its {} end", rope, last ? "last" : "first"),
               {{"", "N"}}, [i, last](const Instant& now, Row row) {
                 const dynamics::RopeLoad& load = now.w.rope_loads[i];
                 row[0] = !load.split.acts ? load.tension
                          : last           ? load.split.last_tension
                                           : load.split.first_tension;
               });
  } else if (quantity == "elongation") {
    add_series(name, description + ", negative where slack", {{"", "m"}},
               [i](const Instant& now, Row row) { row[0] = now.w.rope_loads[i].elongation(); });
  } else {
    add_series(name, description + ", between its points", {{"", "m"}},
               [i](const Instant& now, Row row) { row[0] = now.w.rope_loads[i].length; });
  }
}

void OutputRecorder::add_line(const std::string& name, const std::string& line) {
  using Row = Eigen::Ref<Eigen::RowVectorXd>;
  if (const auto* mooring = find_element<dynamics::MooringLine>(mechanism_.system, line)) {
    add_series(name, fmt::format("tension of mooring {} at its fairlead", line), {{"", "N"}},
               [mooring](const Instant& now, Row row) {
                 const dynamics::MotionState state{now.time, now.w.q, now.w.v, now.w.kinematics};
                 row[0] = mooring->calc_shape(state).tension;
               });
    return;
  }
  const auto* tugger = find_element<dynamics::TuggerLine>(mechanism_.system, line);
  add_series(name, fmt::format("tension of tugger {}", line), {{"", "N"}},
             [tugger](const Instant& now, Row row) {
               const dynamics::MotionState state{now.time, now.w.q, now.w.v, now.w.kinematics};
               row[0] = tugger->calc_tension(state);
             });
}

void OutputRecorder::add_loop(const std::string& name, const std::string& loop,
                              const std::string& quantity) {
  const dynamics::Mechanism& mechanism = mechanism_.system.mechanism();
  const int index = mechanism.loop_index(loop);
  const dynamics::Loop& the_loop = mechanism.loops()[index];
  using Row = Eigen::Ref<Eigen::RowVectorXd>;
  const bool has_force =
      the_loop.kind != dynamics::LoopKind::gear && the_loop.kind != dynamics::LoopKind::rope_length;
  if ((quantity.empty() && has_force) || quantity == "force") {
    std::vector<OutputColumn> columns;
    for (const std::string& axis : xyz) columns.push_back({"moment_" + axis, "N m"});
    for (const std::string& axis : xyz) columns.push_back({"force_" + axis, "N"});
    add_series(name,
               fmt::format("load of loop {} on its second body at its frame, in the world", loop),
               columns, [&mechanism, index](const Instant& now, Row row) {
                 const dynamics::ForceVector F = dynamics::loop_force(
                     mechanism, now.w.kinematics, now.w.loops->loops, index, now.w.loops->lambda);
                 row << F.moment.transpose(), F.force.transpose();
               });
    return;
  }
  const bool residual = quantity == "residual";
  const int first = the_loop.row_offset;
  const int count = the_loop.row_count;
  std::vector<OutputColumn> columns;
  for (int i = 0; i < count; ++i) {
    const bool angle = the_loop.row_is_angle(i);
    columns.push_back(
        {the_loop.row_name(i), residual ? (angle ? "rad" : "m") : (angle ? "N m" : "N")});
  }
  add_series(name, fmt::format("{} of loop {}", residual ? "residual" : "multipliers", loop),
             columns, [first, count, residual](const Instant& now, Row row) {
               const Eigen::VectorXd& all =
                   residual ? now.w.loops->loops.residual : now.w.loops->lambda;
               row = all.segment(first, count).transpose();
             });
}

void OutputRecorder::add_energy(const std::string& name, const std::string& energy) {
  const bool work = energy.ends_with("work") || energy == "dissipated";
  const std::string description = energy == "imbalance"
                                      ? "energy less that of the start and the works since"
                                  : work ? energy + " since the start"
                                         : energy + " energy";
  add_series(name, description, {{"", "J"}}, {});
  energies_.back() = energy;
}

void OutputRecorder::observe(Eigen::Index sample, double t, const dynamics::LiftWorkspace& w) {
  dynamics::compute_accelerations(mechanism_.system.mechanism(), w.kinematics, w.vdot, A_WB_);
  const Instant now{t, w, A_WB_};
  for (std::size_t i = 0; i < series_.size(); ++i) {
    if (fills_[i]) fills_[i](now, series_[i].values.row(sample));
  }
}

std::vector<OutputSeries> OutputRecorder::finish(const dynamics::History& history) {
  for (std::size_t i = 0; i < series_.size(); ++i) {
    if (!energies_[i].empty()) {
      series_[i].values.col(0) = energy_series(energies_[i], history.energy);
    }
  }
  return std::move(series_);
}

}  // namespace blocklift::pipeline

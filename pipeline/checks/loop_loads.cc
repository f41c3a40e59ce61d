#include "pipeline/checks/loop_loads.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/json_values.h"
#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {

namespace {

using dynamics::Loop;
using dynamics::LoopHistory;
using dynamics::LoopKind;
using Json = nlohmann::ordered_json;

const std::vector<Loop>& loops_of(const LiftRun& lift) {
  return lift.model.system.mechanism().loops();
}

bool holds_turns(const Loop& loop) { return loop.rotation != Loop::Rotation::none; }

/// Largest value of a series and when it occurs.
struct Largest {
  Largest(const Eigen::VectorXd& values, const Eigen::VectorXd& times) {
    Eigen::Index at = 0;
    value = values.maxCoeff<Eigen::PropagateNaN>(&at);
    time = times[at];
  }
  double value;
  double time;
};

Eigen::VectorXd moments(const LoopHistory& history) {
  return history.force.leftCols<3>().rowwise().norm();
}

Json loop_json(const Loop& loop, const LoopHistory& at_rest, const LoopHistory& in_motion,
               const Eigen::VectorXd& rest_times, const Eigen::VectorXd& times) {
  const Largest still(loop_load(loop, at_rest), rest_times);
  const Largest moving(loop_load(loop, in_motion), times);
  const std::string quantity = loop_load_unit(loop) == "N" ? "load_N" : "load_Nm";
  Json row{{"name", loop.name},
           {"kind", dynamics::loop_kind_name(loop.kind)},
           {"max_static_" + quantity, json_number(still.value)},
           {"time_of_max_static_s", still.time},
           {"max_dynamic_" + quantity, json_number(moving.value)},
           {"time_of_max_dynamic_s", moving.time},
           {"dynamic_over_static", json_number(moving.value / still.value)}};
  if (holds_turns(loop)) {
    row["max_static_moment_Nm"] = json_number(moments(at_rest).maxCoeff<Eigen::PropagateNaN>());
    row["max_dynamic_moment_Nm"] = json_number(moments(in_motion).maxCoeff<Eigen::PropagateNaN>());
  }
  if (loop.kind == LoopKind::rope_length) {
    row["min_static_tension_N"] = json_number(loop_load(loop, at_rest).minCoeff());
    row["min_dynamic_tension_N"] = json_number(loop_load(loop, in_motion).minCoeff());
  }
  row["largest_residual"] =
      json_number(std::max(at_rest.residual.maxCoeff<Eigen::PropagateNaN>(),
                           in_motion.residual.maxCoeff<Eigen::PropagateNaN>()));
  return row;
}

}  // namespace

Eigen::VectorXd loop_load(const Loop& loop, const LoopHistory& history) {
  if (loop.kind == LoopKind::rope_length) return -history.multipliers.col(0);
  if (loop.kind == LoopKind::gear) return history.multipliers.col(0).cwiseAbs();
  return history.force.rightCols<3>().rowwise().norm();
}

std::string loop_load_unit(const Loop& loop) {
  return loop.kind == LoopKind::gear && loop.turns ? "N m" : "N";
}

void write_loops(ResultsWriter& file, std::string_view group, const dynamics::LiftSystem& system,
                 const dynamics::History& history) {
  for (std::size_t i = 0; i < history.loops.size(); ++i) {
    const Loop& loop = system.mechanism().loops()[i];
    const LoopHistory& loads = history.loops[i];
    const std::string path = layout::join(group, "loops", loop.name);
    file.write_matrix(layout::join(path, "force"), loads.force,
                      {"N m, N",
                       "load on the loop's second body at its frame there: moment, then force, in "
                       "the world (of rope_length on its last point; of a gear none)"});
    std::string rows;
    for (int k = 0; k < loop.row_count; ++k) {
      rows += (k > 0 ? "; " : "") + loop.row_name(k) + (loop.row_is_angle(k) ? ", N m" : ", N");
    }
    file.write_matrix(layout::join(path, "multipliers"), RowMajorMatrix(loads.multipliers),
                      {"N or N m", "of the loop's equations, by column: " + rows});
    file.write(layout::join(path, "residual"),
               std::span<const double>(loads.residual.data(),
                                       static_cast<std::size_t>(loads.residual.size())),
               {"m or rad", "largest by which one of its equations is missed"});
    file.write_attribute(path, "kind", std::string(dynamics::loop_kind_name(loop.kind)));
  }
}

Json loops_json(const LiftRun& lift) {
  Json rows = Json::array();
  const dynamics::History& moving = lift.dynamic_history();
  for (std::size_t i = 0; i < loops_of(lift).size(); ++i) {
    rows.push_back(loop_json(loops_of(lift)[i], lift.static_history.loops[i], moving.loops[i],
                             lift.static_history.time, moving.time));
  }
  return rows;
}

std::vector<Check> check_equalisers(const LiftRun& lift, double smallest_tension) {
  std::vector<Check> checks;
  for (std::size_t i = 0; i < loops_of(lift).size(); ++i) {
    const Loop& loop = loops_of(lift)[i];
    if (loop.kind != LoopKind::rope_length) continue;
    double smallest = std::numeric_limits<double>::infinity();
    double time = 0;
    for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()}) {
      const Largest push(-loop_load(loop, history->loops[i]), history->time);
      if (-push.value >= smallest) continue;
      smallest = -push.value;
      time = push.time;
    }
    checks.push_back(check_at_least("slack: smallest tension of equaliser " + loop.name, smallest,
                                    smallest_tension, "N"));
    checks.back().time = time;
    checks.back().note = "its length is held, which a rope can do by pulling only";
  }
  return checks;
}

}  // namespace blocklift::pipeline

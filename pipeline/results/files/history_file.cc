#include "pipeline/results/files/history_file.h"

#include <string>
#include <vector>

#include "pipeline/formats/results/results_layout.h"
#include "pipeline/results/files/unit_stress_file.h"

namespace blocklift::pipeline {

namespace {

void write_state(ResultsWriter& file, std::string_view name, const HistoryState& state,
                 const std::vector<double>& envelope,
                 const std::vector<Eigen::Vector3d>& displacement) {
  const std::string path = layout::join(layout::structure_group, layout::history, name);
  file.write(layout::join(path, "von_mises"), envelope,
             {"Pa", "largest von Mises stress over all instants, of a plate's two surfaces"});
  file.write_points(layout::join(path, "displacement"), displacement,
                    {"m",
                     "displacement relative to the block's mean rigid motion at the instant of the "
                     "largest checked stress, block frame"});
  const auto write_point = [&](const char* point, const HistoryExtreme& extreme) {
    file.write(layout::join(path, point), std::span<const double>(extreme.at.point_B.data(), 3),
               {"m", "place in the block frame: " + extreme.at.part});
  };
  write_point("peak_stress_point", state.peak_von_mises);
  write_point("checked_stress_point", state.checked_von_mises);
  write_point("max_displacement_point", state.displacement);
  if (!state.checked_von_mises.rope.empty())
    file.write_attribute(path, "rope", state.checked_von_mises.rope);
  file.write_attribute(path, "time", state.checked_von_mises.time);

  const std::string patches = layout::join(path, "patches");
  file.write(layout::join(patches, "von_mises"), span_of(state.square_von_mises),
             {"Pa", "largest checked stress of each square over all instants"});
  file.write(layout::join(patches, "time"), span_of(state.square_time), {"s", "when it occurs"});
  file.write(layout::join(patches, "rope"), span_of(state.square_rope),
             {"1", "index into ../../ropes of the rope with the largest share in it; -1: none"});
}

}  // namespace

void write_block_history(ResultsWriter& file, const structure::Surface& surface,
                         const structure::UnitResponses& responses,
                         const HistoryAssessment& history) {
  const std::string group = layout::join(layout::structure_group, layout::history);
  const auto loads_of = [&](const HistoryState& state) {
    return structure::LoadHistory(state.factors, history.weights);
  };
  const std::vector<std::vector<double>> envelopes = surface.envelopes(
      responses, {loads_of(history.static_state), loads_of(history.dynamic_state)});
  const std::vector<structure::SurfaceField> fields = surface.evaluate(
      responses, {history.static_state.governing, history.dynamic_state.governing});
  write_state(file, layout::static_state, history.static_state, envelopes[0],
              fields[0].displacement);
  write_state(file, layout::dynamic_state, history.dynamic_state, envelopes[1],
              fields[1].displacement);
  file.write_texts(layout::join(group, "ropes"), history.ropes, "ropes at the lugs");
  std::vector<Eigen::Vector3d> centres;
  std::vector<std::int32_t> regions;
  for (const structure::Square& square : history.squares) {
    centres.push_back(square.centre_B);
    regions.push_back(square.region);
  }
  file.write_points(layout::join(group, "patches", "points"), centres,
                    {"m", "centres of the squares of the checked stress, block frame"});
  file.write(layout::join(group, "patches", "plate"), regions, {"1", "index into plates"});
  file.write_texts(layout::join(group, "patches", "plates"), history.regions, "single plates");
  for (const StressHistory& one : history.points) {
    const std::string path = layout::join(group, "points", one.name);
    file.write(layout::join(path, "point"), std::span<const double>(one.point_B.data(), 3),
               {"m", "centre of the square, block frame: " + one.part});
    const auto write = [&](std::string_view state, const Eigen::VectorXd& von_mises,
                           const Eigen::VectorXd& normal) {
      file.write(layout::join(path, state, "von_mises"), span_of(von_mises),
                 {"Pa", "von Mises of the membrane stress at each sample"});
      file.write(
          layout::join(path, state, "normal_stress"), span_of(normal),
          {"Pa", "stress across the plane of the largest principal stress at the worst instant"});
    };
    write(layout::static_state, one.static_von_mises, one.static_normal);
    write(layout::dynamic_state, one.dynamic_von_mises, one.dynamic_normal);
  }
  write_unit_stress(file, responses, history);
}

}  // namespace blocklift::pipeline

#include "tests/pipeline/report/sample_result.h"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {
namespace {

using layout::join;

void write_history(ResultsWriter& writer, std::string_view history, double step) {
  const std::size_t count = static_cast<std::size_t>(std::lround(100.0 / step)) + 1;
  std::vector<double> time(count);
  RowMajorMatrix pose = RowMajorMatrix::Zero(count, 7);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    time[i] = step * static_cast<double>(i);
    pose(row, 2) = 3.0 + 0.05 * time[i];
    pose(row, 3) = 1.0;
  }
  writer.write(join(history, "time"), time, {"s", "time since the start"});
  for (const std::string rope : {"R1", "R2"}) {
    std::vector<double> tension(count);
    for (std::size_t i = 0; i < count; ++i)
      tension[i] = 5e5 + (history == layout::dynamic_history ? 2e4 * std::sin(3.0 * time[i]) : 0.0);
    if (history == layout::dynamic_history && rope == "R1")
      tension[std::lround(43.21 / step)] = 987654.0;
    writer.write(join(history, "ropes", rope, "tension"), tension, {"N", "tension of " + rope});
  }
  writer.write(join(history, "hoists", "H1", "tension"), std::vector<double>(count, 1e6),
               {"N", "tension of H1"});
  writer.write_matrix(join(history, "bodies", "block", "pose"), pose, {"m, 1", "pose X_WB"});
  pose.leftCols(3).setZero();
  writer.write_matrix(join(history, "bodies", "crane", "pose"), pose, {"m, 1", "pose X_WB"});
  writer.write(join(history, "energy", "kinetic"), std::vector<double>(count, 1e4),
               {"J", "kinetic energy"});
  writer.write(join(history, "energy", "balance"), std::vector<double>(count, 1e-3),
               {"J", "what the other terms leave unexplained"});
}

void write_scene(ResultsWriter& writer) {
  RowMajorMatrix box(1, 10);
  box << 10, 4, 2, 5, 2, 1, 1, 0, 0, 0;
  writer.write_matrix(join(layout::scene_bodies, "block", "boxes"), box,
                      {"m, m, 1", "size, centre, orientation"});
  writer.write_attribute(join(layout::scene_bodies, "block"), "kind", "load");
  box << 20, 2, 2, 5, 2, 30, 1, 0, 0, 0;
  writer.write_matrix(join(layout::scene_bodies, "crane", "boxes"), box,
                      {"m, m, 1", "size, centre, orientation"});
  writer.write_attribute(join(layout::scene_bodies, "crane"), "kind", "crane");
  for (const double x : {0.0, 10.0}) {
    const std::string group = join(layout::scene_ropes, x > 0.0 ? "R2" : "R1");
    writer.write_texts(join(group, "bodies"), std::vector<std::string>{"crane", "block"}, "bodies");
    writer.write_points(join(group, "points"), std::vector<Eigen::Vector3d>{{x, 2, 29}, {x, 2, 2}},
                        {"m", "path"});
    writer.write_attribute(group, "kind", "sling");
  }
  writer.write_texts(layout::scene_lug_names, std::vector<std::string>{"L1", "L2"}, "lugs");
  writer.write_points(layout::scene_lug_points, std::vector<Eigen::Vector3d>{{0, 2, 2}, {10, 2, 2}},
                      {"m", "pins"});
  writer.write_attribute(layout::scene_lugs, "body", "block");
  writer.write_texts(layout::stage_names, std::vector<std::string>{"hoist </script>"}, "stages");
  writer.write(layout::stage_start, std::vector<double>{10}, {"s", "starts"});
  writer.write(layout::stage_end, std::vector<double>{90}, {"s", "ends"});
}

// A swing along x, a yaw that nothing brings back, and the block vibrating.
void write_modes(ResultsWriter& writer) {
  const std::string group = join(layout::modes_group, "1");
  writer.make_group(group);
  writer.write_attribute(group, "instant", "start");
  writer.write_attribute(group, "time", 0.0);
  RowMajorMatrix motion = RowMajorMatrix::Zero(3, 12);
  motion(0, 2) = 0.05;
  motion(1, 3) = 1.0;
  motion(2, 5) = 0.02;
  writer.write_matrix(join(group, "bodies", "block", "motion"), motion, {"rad, m", "amplitudes"});
}

nlohmann::ordered_json natural_periods() {
  return {{{"instant", "start"},
           {"time_s", 0.0},
           {"modes",
            {{{"name", "block: yaw"},
              {"kind", "neutral"},
              {"period_s", nullptr},
              {"frequency_Hz", 0.0},
              {"damping_ratio", 0.0},
              {"elastic_share", 0.0},
              {"energy_share_by_body", {{"block", 1.0}}}},
             {{"name", "block: pendulum along x"},
              {"kind", "oscillating"},
              {"period_s", 14.6},
              {"frequency_Hz", 0.0685},
              {"damping_ratio", 0.0023},
              {"elastic_share", 0.01},
              {"energy_share_by_body", {{"block", 0.98}, {"crane", 0.02}}}},
             {{"name", "block: vibration in load.mode_1"},
              {"kind", "oscillating"},
              {"period_s", 0.42},
              {"frequency_Hz", 2.38},
              {"damping_ratio", 0.01},
              {"elastic_share", 1.0},
              {"energy_share_by_body", {{"block", 0.97}}},
              {"energy_share_by_elastic_mode", {{"load.mode_1", 0.91}}}}}}}};
}

void write_structure(ResultsWriter& writer) {
  std::vector<Eigen::Vector3d> points;
  for (const double z : {0.0, 2.0})
    for (const double y : {0.0, 4.0})
      for (const double x : {0.0, 10.0}) points.emplace_back(x, y, z);
  writer.write_points(layout::surface_points, points, {"m", "points"});
  writer.write_indices(layout::surface_quads,
                       std::vector<std::int32_t>{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                                 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5},
                       4, {"1", "corners"});
  writer.write(layout::surface_quad_group, std::vector<std::int32_t>{0, 0, 1, 1, 1, 1},
               {"1", "groups"});
  writer.write_texts(layout::surface_group_names, std::vector<std::string>{"decks", "sides"},
                     "groups");
  for (const std::string_view way : {layout::simultaneous, layout::per_rope_maxima})
    for (const std::string_view state : {layout::static_state, layout::dynamic_state}) {
      const std::string group = join(layout::structure_group, way, state);
      RowMajorMatrix displacement = RowMajorMatrix::Zero(8, 3);
      displacement(7, 2) = -0.004;
      writer.write_matrix(join(group, "displacement"), displacement, {"m", "displacement"});
      writer.write(join(group, "von_mises"),
                   std::vector<double>{1e6, 2e6, 3e6, 4e6, 5e6, 6e6, 7e6, 1.5e8}, {"Pa", "stress"});
      writer.write_attribute(group, "rope", "R1");
      writer.write_attribute(group, "time", 43.21);
    }
}

nlohmann::ordered_json structure_summary() {
  const nlohmann::ordered_json state{
      {"checked_von_mises_Pa", 1.5e8}, {"peak_von_mises_Pa", 1.7e8},
      {"max_displacement_m", 0.004},   {"force_residual", 1e-15},
      {"moment_residual", 2e-15},      {"reaction_over_weight", 3e-9}};
  const nlohmann::ordered_json way{{"static", state},
                                   {"dynamic", state},
                                   {"stress_increase_percent", 12.5},
                                   {"deformation_increase_percent", 8.0}};
  return {
      {"unknowns", 1234}, {"simultaneous", way}, {"per_rope_maxima", way}, {"yield_Pa", 3.55e8}};
}

nlohmann::ordered_json standard_summary() {
  using json = nlohmann::ordered_json;
  const json load{{"name", "largest load at rest"},
                  {"kind", "load"},
                  {"unit", "N"},
                  {"standard", 4e5},
                  {"simulated", 4e5},
                  {"clause", "equilibria"},
                  {"formula", "at 10 s"}};
  const json factor{{"name", "dynamic amplification"},
                    {"kind", "factor"},
                    {"unit", "1"},
                    {"standard", 1.05},
                    {"simulated", 1.234},
                    {"clause", "Rules 5.5"},
                    {"formula", "onshore"}};
  json chain{{"name", "sling R1"},
             {"kind", "sling"},
             {"unit", "N"},
             {"standard", 4.2e5},
             {"simulated", 4.936e5},
             {"limit", 5e5},
             {"simulated_limit", 5e5},
             {"limit_text", "breaking load / 2.3"},
             {"limit_clause", "Rules 7.3"},
             {"standard_utilisation", 0.84},
             {"simulated_utilisation", 0.9872},
             {"pass", true}};
  chain["steps"] = json::array({load, factor});
  return {{"name", "Rules"},
          {"title", "A sample of rules"},
          {"edition", "first"},
          {"source", "nowhere"},
          {"notes", json::array({"Motion asks for more."})},
          {"governing", "sling R1"},
          {"chains", json::array({chain})}};
}

nlohmann::ordered_json sling_lengths() {
  using json = nlohmann::ordered_json;
  const json tensions{{"R1", 5e5}, {"R2", 5e5}}, changed{{"R1", 4.5e5}, {"R2", 5.5e5}};
  const json meant{{"tensions_N", tensions}, {"tilt_rad", 0.0}};
  const json off{{"tensions_N", changed}, {"tilt_rad", 0.025}};
  const json error{{"sling", "R1"}, {"longer", off}, {"shorter", off}};
  return {{"tolerance", 0.0025},
          {"time_s", 0.0},
          {"lengths_m", {{"R1", 10.0}, {"R2", 10.0}}},
          {"meant", meant},
          {"errors", json::array({error})},
          {"worst", {{"tensions_N", {{"R1", 6.2e5}, {"R2", 6.2e5}}}, {"tilt_rad", 0.03}}},
          {"level", {{"tensions_N", tensions}, {"lengths_m", {{"R1", 9.876}, {"R2", 10.1}}}}}};
}

nlohmann::ordered_json worst_instant() {
  using json = nlohmann::ordered_json;
  const auto trial = [](double time, double share) -> json {
    return {{"time_s", time}, {"rope", "R1"}, {"share", share}, {"peak_time_s", time + 0.5}};
  };
  json worst = trial(7.25, 0.43);
  worst["undisturbed"] = {{"rope", "R2"}, {"share", 0.31}, {"peak_time_s", 3.0}};
  worst["tried"] = json::array({trial(2.0, 0.35), trial(7.25, 0.43), trial(9.0, 0.33)});
  return worst;
}

}  // namespace

void write_sample_result(const std::filesystem::path& folder, const SampleParts& parts) {
  ResultsWriter writer(folder / layout::results_file);
  writer.write_attribute(layout::case_group, "name", "sample <lift>");
  writer.write_attribute(layout::case_group, "title", "A sample & nothing else");
  writer.write_text(layout::case_yaml, "case: sample\n", "the case file");
  nlohmann::ordered_json summary{{"case", "sample <lift>"},
                                 {"document", {{"project", "Sample project"}, {"revision", "B"}}},
                                 {"verdict", "fail"},
                                 {"indicative", "the mesh is one of samples"},
                                 {"checks",
                                  {{{"name", "Rope R1"},
                                    {"demand", 987654.0},
                                    {"limit", 8e5},
                                    {"unit", "N"},
                                    {"utilisation", 1.2346},
                                    {"pass", false}}}},
                                 {"ropes",
                                  {{{"name", "R1"},
                                    {"max_static_tension_N", 5e5},
                                    {"max_dynamic_tension_N", 987654.0},
                                    {"dynamic_over_static", 1.975}},
                                   {{"name", "R2"},
                                    {"max_static_tension_N", 5e5},
                                    {"max_dynamic_tension_N", 5.2e5},
                                    {"dynamic_over_static", nullptr}}}},
                                 {"assumptions", {"none"}}};
  if (parts.motion) {
    write_history(writer, layout::static_history, 1.0);
    write_history(writer, layout::dynamic_history, parts.motion_step);
    write_scene(writer);
    write_modes(writer);
    summary["natural_periods"] = natural_periods();
    summary["sling_lengths"] = sling_lengths();
    summary["worst_instant"] = worst_instant();
  }
  if (parts.structure) {
    write_structure(writer);
    summary["structure"] = structure_summary();
    summary["standard"] = standard_summary();
  }
  writer.finish();
  write_file(folder / layout::summary_file, summary.dump(1));
}

}  // namespace blocklift::pipeline

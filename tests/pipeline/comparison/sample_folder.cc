#include "tests/pipeline/comparison/sample_folder.h"

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline::test {

namespace {

nlohmann::ordered_json sample_rope(const std::string& name, double at_rest, double in_motion) {
  return {{"name", name},
          {"max_static_tension_N", at_rest},
          {"max_dynamic_tension_N", in_motion},
          {"dynamic_over_static", in_motion / at_rest}};
}

/// A rectangle from a corner along two sides, divided into squares.
void add_rectangle(BlockSurface& surface, const Eigen::Vector3d& corner,
                   const std::array<Eigen::Vector3d, 2>& sides, const std::array<int, 2>& counts) {
  const auto first = static_cast<std::int32_t>(surface.point_count());
  for (int j = 0; j <= counts[1]; ++j)
    for (int i = 0; i <= counts[0]; ++i) {
      const Eigen::Vector3d point = corner + sides[0] * i / counts[0] + sides[1] * j / counts[1];
      surface.points.insert(surface.points.end(), point.begin(), point.end());
    }
  const int row = counts[0] + 1;
  for (int j = 0; j < counts[1]; ++j)
    for (int i = 0; i < counts[0]; ++i) {
      const std::int32_t low = first + j * row + i;
      surface.quads.insert(surface.quads.end(), {low, low + 1, low + row + 1, low + row});
      surface.quad_groups.push_back(static_cast<std::int32_t>(surface.groups.size()));
    }
}

void write_block(ResultsWriter& file, const SampleBlock& block) {
  const BlockSurface& surface = block.surface;
  const auto count = static_cast<Eigen::Index>(surface.point_count());
  const Eigen::Map<const RowMajorMatrix> points(surface.points.data(), count, 3);
  file.write_matrix(layout::surface_points, points, {"m", "points"});
  file.write_indices(layout::surface_quads, surface.quads, 4, {"1", "corners"});
  file.write(layout::surface_quad_group, surface.quad_groups, {"1", "groups"});
  file.write_texts(layout::surface_group_names, surface.groups, "groups");
  const std::string way = layout::join(
      layout::structure_group, block.is_whole_lift ? layout::history : layout::simultaneous);
  for (const std::string_view state : {layout::static_state, layout::dynamic_state}) {
    const double factor = block.factor * (state == layout::dynamic_state ? 1.25 : 1.0);
    const std::string group = layout::join(way, state);
    file.write(layout::join(group, "von_mises"), sample_stress(surface, factor), {"Pa", "stress"});
    const RowMajorMatrix displacement = points * (1e-3 * factor);
    file.write_matrix(layout::join(group, "displacement"), displacement, {"m", "displacement"});
    if (block.is_whole_lift)
      file.write(layout::join(group, "patches", "von_mises"),
                 std::vector<double>{90e6 * factor, 100e6 * factor, 50e6 * factor},
                 {"Pa", "checked stress"});
  }
  if (!block.is_whole_lift) return;
  file.write(layout::join(way, "patches", "plate"), std::vector<std::int32_t>{0, 0, 1},
             {"1", "index into plates"});
  file.write_texts(layout::join(way, "patches", "plates"),
                   std::vector<std::string>{"deck at z = 0 m", "bulkhead at y = 2 m"}, "plates");
}

}  // namespace

BlockSurface sample_surface(int squares, const std::string& bulkhead) {
  BlockSurface surface;
  add_rectangle(surface, {0, 0, 0}, {Eigen::Vector3d(8, 0, 0), Eigen::Vector3d(0, 4, 0)},
                {2 * squares, squares});
  surface.groups.emplace_back("deck");
  add_rectangle(surface, {0, 2, 0}, {Eigen::Vector3d(8, 0, 0), Eigen::Vector3d(0, 0, 2)},
                {2 * squares, squares});
  surface.groups.push_back(bulkhead);
  return surface;
}

std::vector<double> sample_stress(const BlockSurface& surface, double factor) {
  std::vector<double> stress(surface.point_count());
  for (std::size_t quad = 0; quad < surface.quad_count(); ++quad)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto point = static_cast<std::size_t>(surface.quads[4 * quad + i]);
      const double* place = &surface.points[3 * point];
      stress[point] =
          factor * (surface.quad_groups[quad] == 0 ? 20e6 + 5e6 * place[0] + 3e6 * place[1]
                                                   : 90e6 - 4e6 * place[0] + 7e6 * place[2]);
    }
  return stress;
}

nlohmann::ordered_json sample_summary() {
  nlohmann::ordered_json summary{{"case", "two-ropes"}, {"run", "1"}, {"verdict", "pass"}};
  summary["ropes"] = {sample_rope("R1", 100e3, 110e3), sample_rope("R2", 200e3, 230e3)};
  summary["checks"] = {{{"name", "hook C1.left"}, {"utilisation", 0.5}, {"pass", true}},
                       {{"name", "swing"}, {"utilisation", nullptr}, {"pass", true}}};
  summary["structure"] = {{"simultaneous",
                           {{"static", {{"checked_von_mises_Pa", 100e6}}},
                            {"dynamic", {{"checked_von_mises_Pa", 112e6}}},
                            {"stress_increase_percent", 12.0}}}};
  summary["natural_periods"] = {
      {{"instant", "at the start"}, {"modes", {{{"name", "pendulum"}, {"period_s", 7.5}}}}}};
  return summary;
}

void write_sample_folder(const std::filesystem::path& folder, const nlohmann::ordered_json& summary,
                         const std::string& yaml, const std::string& block,
                         const std::optional<SampleBlock>& stresses) {
  write_file(folder / layout::summary_file, summary.dump(2));
  ResultsWriter file(folder / layout::results_file);
  file.write_attribute(layout::case_group, layout::run, summary.value("run", ""));
  file.write_text(layout::case_yaml, yaml, "the case file");
  if (!block.empty()) {
    file.write_texts(layout::model_names, std::vector<std::string>{"block"}, "names");
    file.write_texts(layout::model_contents, std::vector<std::string>{block}, "contents");
  }
  const std::vector<double> time{0, 1, 2}, tension{100e3, 110e3, 90e3};
  file.write("/dynamic/time", time, {"s", "time"});
  for (const char* rope : {"R1", "R2"})
    file.write(layout::join("/dynamic/ropes", std::string(rope), std::string("tension")), tension,
               {"N", "tension"});
  if (stresses) write_block(file, *stresses);
  file.finish();
}

}  // namespace blocklift::pipeline::test

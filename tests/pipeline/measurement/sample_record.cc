#include "tests/pipeline/measurement/sample_record.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline::test {
namespace {

constexpr double sample_weight = 8000 * 9.80665;

double sample_swing(double time) {
  if (time < 10) return 1;
  const double frequency = 2 * std::numbers::pi / 4;
  return 1 + 0.05 * std::exp(-0.01 * frequency * (time - 10)) * std::sin(frequency * (time - 10));
}

void write_sample_state(ResultsWriter& file, const std::string& history, bool moves) {
  std::vector<double> time;
  for (int i = 0; i <= 1200; ++i) time.push_back(0.05 * i);
  file.write(history + "/time", time, {"s", "time"});
  for (const auto& [rope, share] : {std::pair{"R1", 0.6}, std::pair{"R2", 0.4}}) {
    std::vector<double> tension;
    for (const double t : time)
      tension.push_back(share * sample_weight * (moves ? sample_swing(t) : 1));
    file.write(history + "/ropes/" + rope + "/tension", tension, {"N", "tension"});
  }
  for (const auto& [body, height] : {std::pair{"block", 3.0}, std::pair{"hook", 10.0}}) {
    RowMajorMatrix pose(static_cast<Eigen::Index>(time.size()), 7);
    pose.rowwise() = (Eigen::Matrix<double, 1, 7>() << 0, 0, height, 1, 0, 0, 0).finished();
    file.write_matrix(history + "/bodies/" + body + "/pose", pose, {"m, 1", "pose"});
  }
}

}  // namespace

double sample_tension(double time) { return 0.6 * sample_weight * sample_swing(time); }

void write_sample_lift(const std::filesystem::path& folder) {
  const nlohmann::ordered_json summary{
      {"case", "two-slings"}, {"run", "1"}, {"title", "Two slings"}};
  write_file(folder / layout::summary_file, summary.dump(2));
  ResultsWriter file(folder / layout::results_file);
  file.write_attribute(layout::case_group, layout::run, "1");
  file.write_text(layout::case_yaml,
                  "case: two-slings\ngravity: 9.80665 m/s^2\nwind: {speed: 8 m/s}\n"
                  "waves: {spectrum: {significant_height: 0.5 m}}\nload: {model: box}\n",
                  "the case file");
  file.write_texts(layout::model_names, std::vector<std::string>{"box"}, "names of models");
  file.write_texts(
      layout::model_contents,
      std::vector<std::string>{"kind: block\nmass: 8 t\ncentre_of_mass: [0 m, 0.8 m, 250 mm]\n"},
      "their files");
  write_sample_state(file, "/static", false);
  write_sample_state(file, "/dynamic", true);
  for (const auto& [rope, side] : {std::pair{"R1", 4.0}, std::pair{"R2", -4.0}}) {
    const std::string path = std::string("/scene/ropes/") + rope;
    file.write_texts(path + "/bodies", std::vector<std::string>{"hook", "block"}, "bodies");
    file.write_points(path + "/points", std::vector<Eigen::Vector3d>{{0, side, 0}, {0, side, 2}},
                      {"m", "points"});
    file.write_attribute(path, "kind", "sling");
  }
  file.write_attribute(layout::scene_lugs, "body", "block");
  file.finish();
}

}  // namespace blocklift::pipeline::test

#include "tests/pipeline/comparison/sample_folder.h"

#include <vector>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results_layout.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline::test {

namespace {

nlohmann::ordered_json sample_rope(const std::string& name, double at_rest, double in_motion) {
  return {{"name", name},
          {"max_static_tension_N", at_rest},
          {"max_dynamic_tension_N", in_motion},
          {"dynamic_over_static", in_motion / at_rest}};
}

}  // namespace

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
                         const std::string& yaml, const std::string& block) {
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
  file.finish();
}

}  // namespace blocklift::pipeline::test

#include "pipeline/formats/results/run_identity.h"

#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {

std::string new_run_identity() {
  std::random_device source;
  std::string digits;
  for (int i = 0; i < 4; ++i) digits += fmt::format("{:08x}", source());
  return digits;
}

std::string mixed_runs(const ResultsReader& results, const nlohmann::ordered_json& summary) {
  const std::string of_results = results.has_attribute(layout::case_group, layout::run)
                                     ? results.read_text_attribute(layout::case_group, layout::run)
                                     : "";
  const auto found = summary.find(layout::run);
  const std::string of_summary =
      found != summary.end() && found->is_string() ? found->get<std::string>() : "";
  if (of_results == of_summary) return {};
  return fmt::format("{} and {} are of different runs; their figures do not belong together",
                     layout::results_file, layout::summary_file);
}

}  // namespace blocklift::pipeline

#include "pipeline/report/report.h"

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/run_identity.h"
#include "pipeline/formats/results/summary_file.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/report/front.h"
#include "pipeline/report/html.h"
#include "pipeline/report/page_data.h"
#include "pipeline/report/page_template.h"
#include "pipeline/report/report_page.h"

namespace blocklift::pipeline {
namespace {

/// @throws ResultsError if the results are those of a part.
void require_lift(const nlohmann::ordered_json& summary, const std::filesystem::path& path) {
  if (!summary.contains("part") || summary.contains("case")) return;
  throw ResultsError(path.string() +
                     ": is the summary of a part, of which there is no report; its part.vtu shows "
                     "it in ParaView");
}

/// @throws ResultsError if the file has a layout of another version.
void require_known_layout(const ResultsReader& results, const std::filesystem::path& path) {
  if (!results.has_attribute("/", "format_version")) return;
  const double version = results.read_number_attribute("/", "format_version");
  if (version == layout::format_version) return;
  throw ResultsError(
      fmt::format("{}: its layout has version {:.6g}, and this program knows version {:.6g}: run "
                  "the case again",
                  path.string(), version, layout::format_version));
}

}  // namespace

std::filesystem::path write_report(const std::filesystem::path& folder) {
  complete_stopped_move(folder);
  const nlohmann::ordered_json summary = read_summary(folder / layout::summary_file);
  require_lift(summary, folder / layout::summary_file);
  const ResultsReader results(folder / layout::results_file);
  require_known_layout(results, folder / layout::results_file);
  if (const std::string complaint = mixed_runs(results, summary); !complaint.empty())
    throw ResultsError(folder.string() + ": " + complaint);
  nlohmann::ordered_json data;
  try {
    data = make_page_data(results, summary);
  } catch (const nlohmann::json::exception& error) {
    throw ResultsError((folder / layout::summary_file).string() + ": " + error.what());
  }
  const std::string name = data["case"]["name"].get<std::string>();
  std::filesystem::path path = folder / layout::report_file;
  write_file(path, fill_page(report_page(), {{"%TITLE%", escape_html(name)},
                                             {"%MARGINS%", margins_css(data)},
                                             {"%FRONT%", front_html(data)},
                                             {"%CHECKS%", checks_html(data)},
                                             {"%ANNEX%", annex_html(data)},
                                             {"%DATA%", script_safe(data)}}));
  return path;
}

}  // namespace blocklift::pipeline

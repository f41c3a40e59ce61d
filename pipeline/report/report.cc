#include "pipeline/report/report.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/preparation.h"
#include "pipeline/formats/results_layout.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/formats/run_identity.h"
#include "pipeline/report/front.h"
#include "pipeline/report/html.h"
#include "pipeline/report/page_data.h"
#include "pipeline/report/report_page.h"

namespace blocklift::pipeline {
namespace {

nlohmann::ordered_json read_summary(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw ResultsError(path.string() + ": there is no such file");
  try {
    nlohmann::ordered_json summary = nlohmann::ordered_json::parse(read_file(path));
    if (!summary.is_object()) throw ResultsError(path.string() + ": is not a JSON object");
    return summary;
  } catch (const nlohmann::json::exception& error) {
    throw ResultsError(path.string() + ": is not readable JSON: " + error.what());
  }
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

/// JSON that may stand inside a script element: no "<" can end the element early.
std::string script_safe(const nlohmann::ordered_json& data) {
  const std::string text =
      data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char letter : text) {
    if (letter == '<')
      safe += "\\u003c";
    else
      safe += letter;
  }
  return safe;
}

/// The page with its placeholders filled, in their order; each stands in it once.
std::string fill_page(std::string_view page,
                      const std::vector<std::pair<std::string_view, std::string>>& contents) {
  std::string filled;
  filled.reserve(page.size() + contents.back().second.size());
  for (const auto& [mark, text] : contents) {
    const std::size_t at = page.find(mark);
    filled += page.substr(0, at);
    filled += text;
    page.remove_prefix(at + mark.size());
  }
  filled += page;
  return filled;
}

}  // namespace

std::filesystem::path write_report(const std::filesystem::path& folder) {
  complete_stopped_move(folder);
  const nlohmann::ordered_json summary = read_summary(folder / layout::summary_file);
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

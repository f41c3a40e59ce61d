#include "pipeline/comparison/tolerances.h"

#include <fnmatch.h>

#include <memory>
#include <optional>

#include <fmt/format.h>

#include "pipeline/comparison/summary_figures.h"
#include "pipeline/declaration/document.h"
#include "pipeline/declaration/reading.h"

namespace blocklift::pipeline {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\n") - begin + 1);
}

/// Complains about what is no tolerance.
std::optional<Tolerance> parse_tolerance(std::string_view name, std::string_view text, Mark mark,
                                         Diagnostics& diagnostics) {
  Tolerance tolerance{std::string(trimmed(name)), std::string(trimmed(text)), {}, false, mark};
  if (tolerance.name.empty()) {
    diagnostics.error(std::move(mark), "a tolerance has no figure",
                      {"figure=tolerance is due, for example stress_increase=2%"});
    return std::nullopt;
  }
  try {
    tolerance.limit = parse_measure(tolerance.text);
  } catch (const QuantityError& error) {
    diagnostics.error(std::move(mark),
                      fmt::format("the tolerance of {}: {}", tolerance.name, error.what()));
    return std::nullopt;
  }
  tolerance.is_share = tolerance.text.ends_with('%');
  if (tolerance.limit.value < 0) {
    diagnostics.error(std::move(mark), fmt::format("the tolerance of {} is {}; none is less than 0",
                                                   tolerance.name, tolerance.text));
    return std::nullopt;
  }
  return tolerance;
}

std::vector<Tolerance> parse_list(std::string_view list, Diagnostics& diagnostics) {
  const Mark mark{std::make_shared<const std::string>("--tolerance"), 0, 0};
  std::vector<Tolerance> tolerances;
  while (!list.empty()) {
    const std::string_view part = list.substr(0, list.find(','));
    list.remove_prefix(std::min(part.size() + 1, list.size()));
    const std::size_t sign = part.rfind('=');
    if (sign == std::string_view::npos) {
      diagnostics.error(mark, fmt::format("\"{}\" has no tolerance", part),
                        {"figure=tolerance is due, for example stress_increase=2%"});
    } else if (auto one = parse_tolerance(part.substr(0, sign), part.substr(sign + 1), mark,
                                          diagnostics)) {
      tolerances.push_back(std::move(*one));
    }
  }
  return tolerances;
}

std::vector<Tolerance> read_file(const std::string& path, Diagnostics& diagnostics) {
  std::vector<Tolerance> tolerances;
  const std::optional<Document> document = load_document(path, diagnostics);
  if (!document) return tolerances;
  Reading reading(*document, diagnostics);
  if (!document->root.IsMap()) {
    reading.error(document->root, "the file is no table of figures and their tolerances",
                  {"lines such as \"stress_increase: 2%\" are due"});
    return tolerances;
  }
  ValueDescription due;
  for (const Entry& entry : reading.entries_of(document->root)) {
    std::string text;
    const bool is_read =
        reading.with_key(entry.key, [&] { return reading.scalar_text(entry.value, due, text); });
    if (!is_read) continue;
    if (auto one = parse_tolerance(entry.key, text, entry.mark, diagnostics))
      tolerances.push_back(std::move(*one));
  }
  return tolerances;
}

bool matches_whole_keys(std::string_view name, std::string_view path) {
  if (path == name) return true;
  if (path.size() <= name.size()) return false;
  return (path.starts_with(name) && path[name.size()] == '.') ||
         (path.ends_with(name) && path[path.size() - name.size() - 1] == '.') ||
         fnmatch(std::string(name).c_str(), std::string(path).c_str(), 0) == 0;
}

}  // namespace

bool matches_figure(std::string_view name, std::string_view path) {
  if (matches_whole_keys(name, path)) return true;
  const std::string_view unit = unit_of_path(path);
  if (unit.empty()) return false;
  path.remove_suffix(unit.size() + 1);
  return matches_whole_keys(name, path);
}

std::vector<Tolerance> read_tolerances(const std::string& given) {
  Diagnostics diagnostics;
  if (trimmed(given).empty())
    diagnostics.error({std::make_shared<const std::string>("--tolerance"), 0, 0}, "it is empty",
                      {"figure=tolerance, or a file of such lines, is due"});
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  std::vector<Tolerance> tolerances = given.find('=') == std::string::npos
                                          ? read_file(given, diagnostics)
                                          : parse_list(given, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return tolerances;
}

}  // namespace blocklift::pipeline

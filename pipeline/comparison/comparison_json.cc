#include <fmt/format.h>

#include "pipeline/comparison/comparison.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json result_json(const ComparedResult& result) {
  return {{"name", result.name},
          {"folder", result.folder.string()},
          {"case", result.summary.value("case", "")},
          {"run", result.summary.value("run", "")},
          {"program_version", result.summary.value("program_version", "")}};
}

Json difference_json(const InputDifference& difference) {
  Json values = Json::array();
  for (const auto& value : difference.values) values.push_back(value ? Json(*value) : Json());
  return {{"file", difference.file}, {"key", difference.key}, {"values", std::move(values)}};
}

/// @param unit of the values and of their differences; empty for pure numbers and texts.
Json figure_json(const ComparedFigure& figure, const std::string& unit) {
  Json changes = Json::array(), differences = Json::array();
  const auto number = [](const std::optional<double>& one) { return one ? Json(*one) : Json(); };
  for (std::size_t result = 0; result < figure.values.size(); ++result) {
    changes.push_back(number(figure.change(result)));
    differences.push_back(number(figure.difference(result)));
  }
  return {{"figure", figure.figure.path},
          {"group", figure.figure.group},
          {"label", figure.figure.label},
          {"unit", unit},
          {"values", figure.values},
          {"difference", std::move(differences)},
          {figure.is_in_percent() ? "change_points" : "change_percent", std::move(changes)}};
}

}  // namespace

Json comparison_json(const ResultComparison& comparison) {
  Json json{{"results", Json::array()},
            {"input", Json::array()},
            {"figures", Json::array()},
            {"beyond_tolerance", Json::array()}};
  for (const ComparedResult& result : comparison.results)
    json["results"].push_back(result_json(result));
  for (const InputDifference& difference : comparison.input)
    json["input"].push_back(difference_json(difference));
  for (const ComparedFigure& figure : comparison.figures)
    json["figures"].push_back(figure_json(figure, std::string(unit_of_path(figure.figure.path))));
  for (const MovedFigure& moved : comparison.moved)
    json["beyond_tolerance"].push_back(
        {{"figure", comparison.figures[moved.figure].figure.path},
         {"result", comparison.results[moved.result].name},
         {"tolerance", comparison.tolerances[moved.tolerance].text}});
  return json;
}

}  // namespace blocklift::pipeline

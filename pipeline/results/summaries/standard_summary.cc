#include "pipeline/results/summaries/standard_summary.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/declaration/quantity.h"
#include "pipeline/formats/json_values.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {

namespace {

using Json = nlohmann::ordered_json;

const char* kind_name(ChainStep::Kind kind) {
  switch (kind) {
    case ChainStep::Kind::load:
      return "load";
    case ChainStep::Kind::factor:
      return "factor";
    case ChainStep::Kind::result:
      return "result";
    case ChainStep::Kind::told:
      return "told";
  }
  return "";
}

Json optional_json(const std::optional<double>& value) {
  return value ? json_number(*value) : Json(nullptr);
}

Json step_json(const ChainStep& step) {
  return {{"name", step.name},
          {"kind", kind_name(step.kind)},
          {"unit", step.unit},
          {"standard", optional_json(step.standard)},
          {"simulated", optional_json(step.simulated)},
          {"clause", step.clause},
          {"formula", step.formula}};
}

Json chain_json(const Chain& chain) {
  Json json{{"name", chain.object},
            {"kind", chain.kind},
            {"unit", chain.unit},
            {"standard", json_number(chain.standard)},
            {"simulated", json_number(chain.simulated)}};
  if (chain.limit) {
    json["limit"] = json_number(*chain.limit);
    json["simulated_limit"] = json_number(chain.simulated_limit.value_or(*chain.limit));
    json["limit_text"] = chain.limit_text;
    json["limit_clause"] = chain.limit_clause;
    json["standard_utilisation"] = json_number(chain.standard_utilisation());
    json["simulated_utilisation"] = json_number(chain.simulated_utilisation());
    json["pass"] = chain.utilisation() <= 1;
  }
  json["steps"] = Json::array();
  for (const ChainStep& step : chain.steps) json["steps"].push_back(step_json(step));
  return json;
}

std::string shown(double value, const std::string& unit) {
  return unit == "Pa" ? fmt::format("{:.1f} MPa", value / 1e6)
                      : fmt::format("{:.1f} t", value / newton_per_tonne);
}

}  // namespace

Json standard_json(const StandardAssessment& standard) {
  Json json{{"name", standard.name},
            {"title", standard.title},
            {"edition", standard.edition},
            {"source", standard.source},
            {"notes", standard.notes}};
  if (const Chain* governing = standard.governing()) json["governing"] = governing->object;
  json["chains"] = Json::array();
  for (const Chain& chain : standard.chains) json["chains"].push_back(chain_json(chain));
  return json;
}

std::string standard_text(const StandardAssessment& standard) {
  std::string text = "\n" + wrapped_sentence(standard.name + ", " + standard.edition);
  TextTable table({{""}, {"limit", 3}, {"standard", 3}, {"use", 3}, {"simulated", 3}, {"use", 3}});
  const auto use = [](double utilisation) { return fmt::format("{:.3f}", utilisation); };
  for (const Chain& chain : standard.chains) {
    if (!chain.has_limit()) continue;
    table.add_row({chain.object, shown(*chain.limit, chain.unit), shown(chain.standard, chain.unit),
                   use(chain.standard_utilisation()), shown(chain.simulated, chain.unit),
                   use(chain.simulated_utilisation())});
  }
  text += table.text();
  if (const Chain* governing = standard.governing())
    text += wrapped_sentence("governed by " + governing->object + ": " + governing->limit_text);
  for (const std::string& note : standard.notes) text += wrapped_sentence(note);
  return text;
}

}  // namespace blocklift::pipeline

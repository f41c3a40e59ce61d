#include "pipeline/results/calculation_package.h"

#include <optional>
#include <vector>

#include <fmt/format.h>

#include "pipeline/declaration/quantity.h"
#include "pipeline/files/input_hash.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/results/assumptions.h"
#include "pipeline/results/result_file.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {

namespace {

using Row = std::vector<std::string>;

/// A bar would end a cell of Markdown.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string table(const Row& head, const std::vector<Row>& rows) {
  const auto line = [](const Row& row) {
    std::string text = "|";
    for (const std::string& one : row) text += " " + cell(one) + " |";
    return text + "\n";
  };
  std::string text = line(head) + line(Row(head.size(), "---"));
  for (const Row& row : rows) text += line(row);
  return text + "\n";
}

std::string heading(const std::string& text) { return "## " + text + "\n\n"; }

std::string tonnes(double newtons) { return fmt::format("{:.1f}", newtons / newton_per_tonne); }

std::string number(const std::optional<double>& value, double scale, int digits) {
  return value ? fmt::format("{:.{}f}", *value * scale, digits) : "–";
}

std::string shown(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "–";
  if (unit == "1") return fmt::format("{:.3f}", *value);
  if (unit == "Pa") return fmt::format("{:.1f} MPa", *value / 1e6);
  return fmt::format("{:.1f} kN", *value / 1e3);
}

std::string point_text(const Vector3& p) {
  return fmt::format("{:.3f}, {:.3f}, {:.3f}", p.x(), p.y(), p.z());
}

std::string basis(const Assessment& assessment) {
  const StandardAssessment& standard = *assessment.standard;
  std::string text = heading("Design basis");
  text += fmt::format("Rules: {}, {} ({}). Figures: {}.\n\n", standard.name, standard.title,
                      standard.edition, standard.source);
  for (const std::string& one : list_assumptions(assessment)) text += "- " + one + "\n";
  return text + "\n";
}

std::string weights(const Assessment& assessment) {
  std::vector<Row> rows;
  for (const ChainStep& step : assessment.standard->chains.front().steps)
    rows.push_back({step.name, shown(step.standard, step.unit), shown(step.simulated, step.unit),
                    step.clause});
  std::string text = heading("Weights") + table({"step", "standard", "simulation", "clause"}, rows);
  if (assessment.block.model)
    text += "Centre of mass in the block's frame: " +
            point_text(assessment.block.model->mass_properties().centre_of_mass_B) + " m.\n\n";
  return text;
}

/// Identification and certificate are filled in by hand: the case does not know them.
std::string rigging(const LiftCase& lift_case) {
  std::vector<Row> rows;
  for (const RopeInCase& rope : lift_case.ropes) {
    if (rope.lug().empty()) continue;
    rows.push_back({rope.name.value, rope.lug(), fmt::format("{:.3f}", rope.length.value),
                    number(rope.rope.diameter, 1e3, 0),
                    rope.rope.material ? rope.rope.material->value : "–",
                    rope.rope.termination ? rope.rope.termination->value : "–",
                    tonnes(rope.rope.breaking_load), "", ""});
  }
  std::string text = heading("Rigging list");
  if (!rows.empty())
    text += table({"sling", "lug", "length, m", "diameter, mm", "material", "termination", "MBL, t",
                   "ID", "certificate"},
                  rows);
  rows.clear();
  for (const ShackleInCase& shackle : lift_case.standard->shackles)
    rows.push_back(
        {shackle.name.value, tonnes(shackle.working_load), tonnes(shackle.breaking_load), "", ""});
  if (!rows.empty())
    text += table({"shackle at lug", "WLL, t", "MBL, t", "ID", "certificate"}, rows);
  return text;
}

std::string geometry(const LiftCase& lift_case) {
  std::vector<Row> rows;
  if (lift_case.load.model)
    for (const LugModel& lug : lift_case.load.model->lugs)
      rows.push_back({lug.name.value, point_text(lug.pin.value)});
  for (const Named<Vector3>& lug : lift_case.load.lugs)
    rows.push_back({lug.name.value, point_text(lug.value)});
  return heading("Geometry") + table({"lug", "pin in the load's frame, m"}, rows);
}

std::string load_cases(const LiftCase& lift_case) {
  if (lift_case.load_table) return heading("Load cases") + "Loads given by lug, no operation.\n\n";
  std::string text = heading("Load cases");
  text += "Every instant of the operation, at rest and in motion:\n\n";
  for (const StageInCase& stage : lift_case.operation)
    text += fmt::format("1. {}\n", stage.name.value);
  return text + "\n";
}

std::string utilisations(const StandardAssessment& standard) {
  std::vector<Row> rows;
  for (const Chain& chain : standard.chains)
    if (chain.has_limit())
      rows.push_back({chain.object, chain.limit_text, shown(chain.standard, chain.unit),
                      fmt::format("{:.3f}", chain.standard_utilisation()),
                      shown(chain.simulated, chain.unit),
                      fmt::format("{:.3f}", chain.simulated_utilisation()),
                      chain.utilisation() <= 1 ? "pass" : "FAIL", chain.limit_clause});
  std::string text = heading("Utilisations");
  text += table({"what", "against", "by the standard", "utilisation", "by the simulation",
                 "utilisation", "result", "clause"},
                rows);
  if (const Chain* governing = standard.governing())
    text += "Governing: " + governing->object + ".\n\n";
  for (const std::string& note : standard.notes) text += "- " + note + "\n";
  return text + "\n";
}

std::string chains(const StandardAssessment& standard) {
  std::string text = heading("Chains of factors");
  for (const Chain& chain : standard.chains) {
    text += "### " + chain.object + "\n\n";
    std::vector<Row> rows;
    for (const ChainStep& step : chain.steps)
      rows.push_back({step.name, step.formula, shown(step.standard, step.unit),
                      shown(step.simulated, step.unit), step.clause});
    text += table({"step", "numbers", "standard", "simulation", "clause"}, rows);
  }
  return text;
}

std::string revision(const Assessment& assessment) {
  const DocumentInCase& document = assessment.lift_case.document;
  ContentHash hash;
  hash.add(std::string_view(hash_of_input(assessment.lift_case)));
  for (const Chain& chain : assessment.standard->chains) {
    hash.add(chain.object);
    for (const ChainStep& step : chain.steps) hash.add(step.standard.value_or(1));
    hash.add(chain.limit.value_or(0));
  }
  std::string text = heading("Revision");
  text += table({"revision", "case", "hash of input and factors", "program", "made"},
                {{document.revision, assessment.lift_case.name, hash.digits(),
                  fmt::format("Blocklift {}", program_version), creation_time()}});
  return text + table({"", "name", "date", "signature"}, {{"prepared", document.prepared, "", ""},
                                                          {"checked", document.checked, "", ""},
                                                          {"approved", document.approved, "", ""}});
}

}  // namespace

std::string calculation_package(const Assessment& assessment) {
  const LiftCase& lift_case = assessment.lift_case;
  const std::string& title = lift_case.title.empty() ? lift_case.name : lift_case.title;
  return "# Calculation: " + title + "\n\n" + basis(assessment) + weights(assessment) +
         rigging(lift_case) + geometry(lift_case) + load_cases(lift_case) +
         utilisations(*assessment.standard) + chains(*assessment.standard) + revision(assessment);
}

}  // namespace blocklift::pipeline

#include "pipeline/results/documents/calculation_package.h"

#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "pipeline/declaration/quantity.h"
#include "pipeline/files/lift_case/input_hash.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/results/files/result_file.h"
#include "pipeline/results/summaries/assumptions.h"
#include "pipeline/results/summaries/mesh_error.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {

namespace {

using Row = DocumentPart::Row;

std::string tonnes(double newtons) { return fmt::format("{:.1f}", newtons / newton_per_tonne); }

std::string number(const std::optional<double>& value, double scale, int digits) {
  return value ? fmt::format("{:.{}f}", *value * scale, digits) : "–";
}

std::string shown(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "–";
  if (unit == "1") return fmt::format("{:.3f}", *value);
  if (unit == "N") return fmt::format("{:.1f} kN", *value / 1e3);
  if (unit == "N m") return fmt::format("{:.1f} kN m", *value / 1e3);
  if (unit == "Pa") return fmt::format("{:.1f} MPa", *value / 1e6);
  if (unit == "rad") return fmt::format("{:.2f} deg", *value * 180 / std::numbers::pi);
  return fmt::format("{:.3f} {}", *value, unit);
}

std::string point_text(const Vector3& p) {
  return fmt::format("{:.3f}, {:.3f}, {:.3f}", p.x(), p.y(), p.z());
}

void add_basis(const Assessment& assessment, TextDocument& document) {
  const StandardAssessment& standard = *assessment.standard;
  document.heading("Design basis")
      .paragraph(fmt::format("Rules: {}, {} ({}). Figures: {}.", standard.name, standard.title,
                             standard.edition, standard.source));
  for (const std::string& one : list_assumptions(assessment)) document.bullet(one);
}

void add_weights(const Assessment& assessment, TextDocument& document) {
  std::vector<Row> rows;
  for (const ChainStep& step : assessment.standard->chains.front().steps)
    rows.push_back({step.name, shown(step.standard, step.unit), shown(step.simulated, step.unit),
                    step.clause});
  document.heading("Weights").table({"step", "standard", "simulation", "clause"}, std::move(rows));
  if (assessment.block.model)
    document.paragraph("Centre of mass in the block's frame: " +
                       point_text(assessment.block.model->mass_properties().centre_of_mass_B) +
                       " m.");
}

/// What a sling may bear by the rules, its breaking load over their safety factor, t.
std::string borne_by_rules(const StandardAssessment& standard, const std::string& sling) {
  for (const Chain& chain : standard.chains)
    if (chain.kind == "sling" && chain.name == sling && chain.limit) return tonnes(*chain.limit);
  return "–";
}

/// Identification and certificate are filled in by hand: the case does not know them.
void add_rigging(const LiftCase& lift_case, const StandardAssessment& standard,
                 TextDocument& document) {
  std::vector<Row> slings, shackles, links, sheaves, bars;
  for (const given::Rope& rope : lift_case.ropes) {
    if (!rope.is_sling()) continue;
    slings.push_back({rope.name.value, rope.lug().empty() ? rope.to.value.name.value : rope.lug(),
                      fmt::format("{:.3f}", rope.length.value), number(rope.rope.diameter, 1e3, 0),
                      rope.rope.material ? rope.rope.material->value : "–",
                      rope.rope.termination ? rope.rope.termination->value : "–",
                      borne_by_rules(standard, rope.name.value), tonnes(rope.rope.breaking_load),
                      "", ""});
  }
  for (const given::Shackle& shackle : lift_case.standard->shackles)
    shackles.push_back(
        {shackle.name.value, tonnes(shackle.working_load), tonnes(shackle.breaking_load), "", ""});
  for (const given::MasterLink& link : lift_case.standard->master_links)
    links.push_back({link.name.value, tonnes(link.working_load), tonnes(link.breaking_load),
                     number(link.mass, 1, 1), "", ""});
  for (const given::Sheave& sheave : lift_case.standard->sheaves)
    sheaves.push_back({sheave.name.value, tonnes(sheave.working_load), tonnes(sheave.breaking_load),
                       number(sheave.tread, 1e3, 0), "", ""});
  for (const given::Spreader& bar : lift_case.spreaders)
    bars.push_back({bar.name.value,
                    bar.is_frame() ? fmt::format("{:.3f} x {:.3f}", bar.length.value, *bar.width)
                                   : fmt::format("{:.3f}", bar.length.value),
                    number(bar.mass(), 1, 0), number(bar.yield_stress, 1e-6, 0), "", ""});
  document.heading("Rigging list");
  if (!slings.empty())
    document.table({"sling", "ends at", "length, m", "diameter, mm", "material", "termination",
                    "WLL by the rules, t", "MBL, t", "ID", "certificate"},
                   std::move(slings));
  if (!shackles.empty())
    document.table({"shackle at lug", "WLL, t", "MBL, t", "ID", "certificate"},
                   std::move(shackles));
  if (!links.empty())
    document.table({"master link at hook", "WLL, t", "MBL, t", "mass, kg", "ID", "certificate"},
                   std::move(links));
  if (!sheaves.empty())
    document.table(
        {"sheave of sling", "WLL on the pin, t", "MBL, t", "tread, mm", "ID", "certificate"},
        std::move(sheaves));
  if (!bars.empty())
    document.table({"spreader", "length, m", "mass, kg", "yield, MPa", "ID", "certificate"},
                   std::move(bars));
}

void add_geometry(const LiftCase& lift_case, TextDocument& document) {
  std::vector<Row> rows;
  if (lift_case.load.model)
    for (const LugModel& lug : lift_case.load.model->lugs)
      rows.push_back({lug.name.value, point_text(lug.pin.value)});
  for (const Named<Vector3>& lug : lift_case.load.lugs)
    rows.push_back({lug.name.value, point_text(lug.value)});
  document.heading("Geometry").table({"lug", "pin in the load's frame, m"}, std::move(rows));
}

void add_load_cases(const LiftCase& lift_case, TextDocument& document) {
  document.heading("Load cases");
  if (lift_case.load_table) {
    document.paragraph("Loads given by lug, no operation.");
    return;
  }
  document.paragraph("Every instant of the operation, at rest and in motion:");
  for (const given::Stage& stage : lift_case.operation) document.numbered(stage.name.value);
}

void add_utilisations(const StandardAssessment& standard, TextDocument& document) {
  std::vector<Row> rows;
  for (const Chain& chain : standard.chains)
    if (chain.has_limit())
      rows.push_back({chain.object, chain.limit_text, shown(chain.standard, chain.unit),
                      fmt::format("{:.3f}", chain.standard_utilisation()),
                      shown(chain.simulated, chain.unit),
                      fmt::format("{:.3f}", chain.simulated_utilisation()),
                      chain.utilisation() <= 1 ? "pass" : "FAIL", chain.limit_clause});
  document.heading("Utilisations")
      .table({"what", "against", "by the standard", "utilisation", "by the simulation",
              "utilisation", "result", "clause"},
             std::move(rows));
  if (const Chain* governing = standard.governing())
    document.paragraph("Governing: " + governing->object + ".");
  for (const std::string& note : standard.notes) document.bullet(note);
}

void add_chains(const StandardAssessment& standard, TextDocument& document) {
  document.heading("Chains of factors");
  for (const Chain& chain : standard.chains) {
    std::vector<Row> rows;
    for (const ChainStep& step : chain.steps)
      rows.push_back({step.name, step.formula, shown(step.standard, step.unit),
                      shown(step.simulated, step.unit), step.clause});
    document.subheading(chain.object)
        .table({"step", "numbers", "standard", "simulation", "clause"}, std::move(rows));
  }
}

/// The case's own checks of ropes, cranes, spreaders, clearances and the operation: those that no
/// chain of the standard holds and no mesh gave.
void add_plain_checks(const Assessment& assessment, TextDocument& document) {
  std::vector<Row> rows;
  for (const Check& check : assessment.checks) {
    if (check.band || check.is_of_standard) continue;
    rows.push_back({check.name, shown(check.demand, check.unit), shown(check.limit, check.unit),
                    fmt::format("{:.3f}", check.utilisation), check.pass ? "pass" : "FAIL",
                    check.note});
  }
  if (rows.empty()) return;
  document.heading("Checks of the case")
      .table({"check", "value", "limit", "utilisation", "result", "source"}, std::move(rows));
}

/// The checks that the block's mesh gave, each with the band in which its error leaves them.
void add_block(const Assessment& assessment, TextDocument& document) {
  std::vector<Row> rows;
  for (const Check& check : assessment.checks) {
    if (!check.band) continue;
    const auto [lower, upper] = check.utilisation_band();
    rows.push_back({check.name, fmt::format("{:.3f}", check.utilisation),
                    fmt::format("{:.3f} to {:.3f}", lower, upper), check.pass ? "pass" : "FAIL"});
  }
  if (rows.empty()) return;
  document.heading("Block by finite elements")
      .table({"check", "utilisation", "by the error of the mesh", "result"}, std::move(rows));
  if (const std::string indicative = why_indicative(assessment); !indicative.empty())
    document.paragraph("Indicative only: " + indicative + ".");
}

/// One hash for what went in and what the rules made of it.
std::string hash_of_calculation(const Assessment& assessment) {
  ContentHash hash;
  hash.add(std::string_view(hash_of_input(assessment.lift_case)));
  for (const Chain& chain : assessment.standard->chains) {
    hash.add(chain.object);
    for (const ChainStep& step : chain.steps) hash.add(step.standard.value_or(1));
    hash.add(chain.limit.value_or(0));
  }
  return hash.digits();
}

void add_revision(const Assessment& assessment, TextDocument& document) {
  const given::Document& signs = assessment.lift_case.document;
  document.heading("Revision")
      .table({"revision", "case", "hash of input and factors", "program", "made"},
             {{signs.revision, assessment.lift_case.name, hash_of_calculation(assessment),
               fmt::format("Blocklift {}", program_version), creation_time()}})
      .table({"", "name", "date", "signature"}, {{"prepared", signs.prepared, "", ""},
                                                 {"checked", signs.checked, "", ""},
                                                 {"approved", signs.approved, "", ""}});
}

}  // namespace

TextDocument calculation_package(const Assessment& assessment) {
  const LiftCase& lift_case = assessment.lift_case;
  TextDocument document;
  document.title("Calculation: " + (lift_case.title.empty() ? lift_case.name : lift_case.title));
  add_basis(assessment, document);
  add_weights(assessment, document);
  add_rigging(lift_case, *assessment.standard, document);
  add_geometry(lift_case, document);
  add_load_cases(lift_case, document);
  add_utilisations(*assessment.standard, document);
  add_plain_checks(assessment, document);
  add_block(assessment, document);
  add_chains(*assessment.standard, document);
  add_revision(assessment, document);
  return document;
}

std::string calculation_foot(const Assessment& assessment) {
  const LiftCase& lift_case = assessment.lift_case;
  std::string foot = lift_case.name;
  for (const std::string& one : {lift_case.document.project, lift_case.document.revision})
    if (!one.empty()) foot += "   " + one;
  return foot + "   " + hash_of_calculation(assessment);
}

}  // namespace blocklift::pipeline

// Files of a deck's own load cases.
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/files/structure/block_mesh.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/part/deck_assessment.h"
#include "pipeline/results/files/result_file.h"
#include "pipeline/version.h"
#include "structure/load_cases/deck_heat.h"
#include "structure/output/vtu.h"
#include "structure/process_group.h"

namespace blocklift::pipeline {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using structure::Deck;
using structure::DeckCaseSolution;

constexpr const char* picture_prefix = "case-";

const structure::DeckLoadCase& case_of(const Deck& deck, const DeckCaseSolution& solution) {
  return deck.load_cases[solution.load_case];
}

long label_of(const Deck& deck, int vertex) {
  const auto& labels = deck.mesh.vertex_labels;
  return labels.empty() ? vertex + 1L : labels[vertex];
}

std::string picture_of(const Deck& deck, const DeckCaseSolution& solution) {
  return fmt::format("{}{}.vtu", picture_prefix, case_of(deck, solution).label);
}

Json triple_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json wrench_json(const structure::Wrench& wrench) {
  return {{"force_N", triple_of(wrench.force)},
          {"moment_about_origin_N_m", triple_of(wrench.moment)}};
}

Json extreme_json(const structure::Extreme& extreme, const char* unit) {
  return {{std::string("value_") + unit, extreme.value},
          {"point_m", triple_of(extreme.point_B)},
          {"part", extreme.part}};
}

Json case_json(const Deck& deck, const DeckCaseSolution& solution) {
  const structure::LoadCaseResult& stress = solution.stress;
  Json json{{"label", case_of(deck, solution).label},
            {"title", case_of(deck, solution).title},
            {"applied", wrench_json(solution.applied)},
            {"reactions", wrench_json(solution.supported)},
            {"force_residual", solution.force_residual},
            {"moment_residual", solution.moment_residual},
            {"strain_energy_J", solution.strain_energy},
            {"estimated_error", solution.estimated_error},
            {"max_displacement", extreme_json(stress.displacement, "m")},
            {"checked_von_mises", extreme_json(stress.checked_von_mises, "Pa")},
            {"peak_von_mises", extreme_json(stress.peak_von_mises, "Pa")}};
  for (const structure::GroupStress& group : stress.groups) {
    if (group.checked_von_mises.part.empty()) continue;
    Json& one = json["groups"][group.group];
    one = {{"material", group.material},
           {"checked_von_mises_Pa", group.checked_von_mises.value},
           {"peak_von_mises_Pa", group.peak_von_mises.value},
           {"peak_point_m", triple_of(group.peak_von_mises.point_B)}};
    if (std::isfinite(group.yield_stress)) one["yield_Pa"] = group.yield_stress;
  }
  return json;
}

Json make_summary(const DeckAssessment& assessment) {
  const structure::ElasticModel& model = *assessment.model;
  const Deck& deck = assessment.deck();
  Json summary{{"block", assessment.name},
               {"title", assessment.block->title},
               {"program_version", program_version},
               {"created", creation_time()},
               {"deck", assessment.block->mesh->file.value},
               {"nodes", deck.mesh.vertices.size()},
               {"shells", deck.mesh.shells.size()},
               {"beams", deck.mesh.beams.size()},
               {"solids", deck.mesh.solids.size()},
               {"element_degree", model.space().degree()},
               {"unknowns", model.space().unknowns()},
               {"processes", structure::ProcessGroup::launched()},
               {"mass_kg", assessment.mass()}};
  if (!assessment.is_massless)
    summary["centre_of_mass_m"] = triple_of(model.mass_properties().centre_of_mass_B);
  for (const DeckCaseSolution& solution : assessment.solution.cases)
    summary["cases"].push_back(case_json(deck, solution));
  for (const structure::SkippedCase& skipped : assessment.solution.skipped) {
    const auto& one = deck.load_cases[skipped.load_case];
    summary["skipped"].push_back({{"label", one.label},
                                  {"title", one.title},
                                  {"reason", skipped.is_held ? "no loads" : "no supports"}});
  }
  summary["left_out"] = left_out_of_cases(deck);
  summary["warnings"] = warnings_of_own_cases(*assessment.block->mesh);
  for (std::string& remark : remarks_on_torsion(assessment))
    summary["warnings"].push_back(std::move(remark));
  for (std::string& remark : remarks_on_triangles(assessment))
    summary["warnings"].push_back(std::move(remark));
  const structure::DeckTimes& times = assessment.solution.times;
  summary["timing"] = {{"mesh_s", assessment.mesh_s},
                       {"assembly_s", times.assembly},
                       {"factorisation_s", times.factorisation},
                       {"solve_s", times.solve},
                       {"recovery_s", times.recovery}};
  return summary;
}

/// Motions of the deck's nodes that something is joined to, a line a case and node.
std::string nodes_table(const DeckAssessment& assessment) {
  const structure::Space& space = assessment.model->space();
  const Deck& deck = assessment.deck();
  std::string text =
      "case,node,x_m,y_m,z_m,u_x_m,u_y_m,u_z_m,theta_x_rad,theta_y_rad,theta_z_rad\n";
  for (const DeckCaseSolution& solution : assessment.solution.cases)
    for (std::size_t v = 0; v < deck.mesh.vertices.size(); ++v) {
      const int node = space.node_of_vertex(static_cast<int>(v));
      if (node < 0) continue;
      const structure::Vector3& place = deck.mesh.vertices[v];
      const Eigen::Matrix<double, 6, 1> motion =
          solution.motion.segment<6>(6 * static_cast<Eigen::Index>(node));
      text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                          case_of(deck, solution).label, label_of(deck, static_cast<int>(v)),
                          place.x(), place.y(), place.z(), motion[0], motion[1], motion[2],
                          motion[3], motion[4], motion[5]);
    }
  return text;
}

std::string reactions_table(const DeckAssessment& assessment) {
  const Deck& deck = assessment.deck();
  std::string text = "case,node,f_x_N,f_y_N,f_z_N,m_x_N_m,m_y_N_m,m_z_N_m\n";
  for (const DeckCaseSolution& solution : assessment.solution.cases)
    for (const structure::SupportReaction& reaction : solution.reactions)
      text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                          case_of(deck, solution).label, label_of(deck, reaction.vertex),
                          reaction.force.x(), reaction.force.y(), reaction.force.z(),
                          reaction.moment.x(), reaction.moment.y(), reaction.moment.z());
  return text;
}

/// Pictures of cases that an earlier run left in the folder, and what a run of a part leaves.
std::vector<std::string> earlier_files(const fs::path& folder) {
  std::vector<std::string> names = {"part.vtu", "modes.vtu", "part.inp", "results.h5"};
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(picture_prefix) && name.ends_with(".vtu")) names.push_back(name);
  }
  return names;
}

}  // namespace

void write_deck_results(const DeckAssessment& assessment, const fs::path& folder) {
  Preparation preparation(folder);
  const fs::path& aside = preparation.folder();
  const Deck& deck = assessment.deck();
  std::vector<std::string> absent = earlier_files(folder);
  for (const DeckCaseSolution& solution : assessment.solution.cases) {
    const std::string picture = picture_of(deck, solution);
    const auto heat = structure::heat_of(*assessment.model, deck, {solution.load_case});
    structure::write_vtu((aside / picture).string(), *assessment.model, solution.stress.name,
                         solution.motion, heat ? &*heat : nullptr);
    std::erase(absent, picture);
  }
  write_file(aside / "nodes.csv", nodes_table(assessment));
  write_file(aside / "reactions.csv", reactions_table(assessment));
  write_file(aside / "summary.json", make_summary(assessment).dump(2));
  preparation.move_into_place(absent);
}

}  // namespace blocklift::pipeline

// Files of a solved part.
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/preparation.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/part/part_assessment.h"
#include "pipeline/results/files/result_file.h"
#include "pipeline/results/summaries/padeye_summary.h"
#include "pipeline/version.h"
#include "structure/output/part_files.h"
#include "structure/stress_tensor.h"

namespace blocklift::pipeline {

namespace {

using Json = nlohmann::ordered_json;

Json vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json group_json(const structure::PartGroupResult& group) {
  return {{"von_mises_Pa", group.von_mises},
          {"point_m", vector(group.point)},
          {"raw_von_mises_Pa", group.raw_von_mises},
          {"raw_point_m", vector(group.raw_point)},
          {"von_mises_error_Pa", group.von_mises_error},
          {"estimated_error", group.estimated_error},
          {"max_displacement_m", group.displacement}};
}

Json probe_json(const structure::PartProbe& probe) {
  Json json{{"point_m", vector(probe.point)}};
  if (!probe.inside) return json;  // no figures where there is no material
  const auto& s = probe.stress;
  json["displacement_m"] = vector(probe.displacement);
  json["stress_Pa"] = {{"xx", s[0]}, {"yy", s[1]}, {"zz", s[2]},
                       {"xy", s[3]}, {"yz", s[4]}, {"zx", s[5]}};
  json["von_mises_Pa"] = structure::von_mises(s);
  json["von_mises_error_Pa"] = probe.von_mises_error;
  return json;
}

Json plate_json(const structure::PadeyePlateStress& plate) {
  return {{"checked_von_mises_Pa", plate.checked_von_mises.value},
          {"checked_point_m", vector(plate.checked_von_mises.point_B)},
          {"peak_von_mises_Pa", plate.peak_von_mises.value},
          {"peak_point_m", vector(plate.peak_von_mises.point_B)}};
}

Json part_padeye_json(const PartPadeye& padeye) {
  Json json{{"force_N", vector(padeye.force_P)},
            {"main_plate", plate_json(padeye.stress.main_plate)}};
  if (padeye.input.geometry.has_cheeks()) json["cheeks"] = plate_json(padeye.stress.cheeks);
  for (const PadeyeFormulaAtWorst& formula : padeye.formulas)
    json["formulas"].push_back(formula_json(formula));
  return json;
}

// What the loads do.
void add_solution(const PartAssessment& assessment, Json& summary) {
  const structure::PartSolution& solution = assessment.solution;
  summary["applied"] = {{"force_N", vector(solution.applied.force)},
                        {"moment_about_origin_N_m", vector(solution.applied.moment)}};
  std::map<std::string, structure::Wrench> reactions;
  for (std::size_t s = 0; s < assessment.model.supports.size(); ++s) {
    structure::Wrench& sum = reactions[assessment.model.supports[s].name];
    sum.force += solution.reactions[s].force;
    sum.moment += solution.reactions[s].moment;
  }
  for (const auto& [name, wrench] : reactions)
    summary["reactions"][name] = {{"force_N", vector(wrench.force)},
                                  {"moment_about_origin_N_m", vector(wrench.moment)}};
  summary["force_residual"] = solution.force_residual;
  summary["moment_residual"] = solution.moment_residual;
  summary["estimated_error"] = solution.estimated_error;
  for (const RefinementStep& step : assessment.refinement)
    summary["refinement"].push_back({{"element_order", step.element_order},
                                     {"elements", step.elements},
                                     {"unknowns", step.unknowns},
                                     {"estimated_error", step.estimated_error},
                                     {"von_mises_Pa", step.von_mises},
                                     {"von_mises_error_Pa", step.von_mises_error},
                                     {"checked_error", step.checked_error}});
  summary["strain_energy_J"] = solution.strain_energy;
  summary["all"] = group_json(solution.all);
  for (const structure::PartGroupResult& group : solution.groups)
    summary["groups"][group.group] = group_json(group);
  if (assessment.padeye) summary["padeye"] = part_padeye_json(*assessment.padeye);
  for (const HotSpotResult& spot : assessment.hot_spots)
    summary["hot_spots"][spot.name] = {{"toe_m", vector(spot.spot.toe)},
                                       {"normal_Pa", spot.stress.normal},
                                       {"principal_Pa", spot.stress.principal},
                                       {"principal_angle_rad", spot.stress.angle},
                                       {"governing_Pa", spot.stress.governing}};
  for (const ProbeResult& probe : assessment.probes) {
    if (!probe.is_line) {
      summary["probes"][probe.name] = probe_json(probe.points[0]);
      continue;
    }
    for (const structure::PartProbe& point : probe.points)
      summary["probes"][probe.name].push_back(probe_json(point));
  }
}

Json make_part_summary(const PartAssessment& assessment) {
  const structure::PartSolution& solution = assessment.solution;
  const structure::PartModel& model = assessment.model;
  std::map<std::string, int> kinds;
  for (const int element : model.mesh.solids) ++kinds[model.mesh.kind(element).name];
  Json summary{{"part", assessment.file.name},
               {"title", assessment.file.title},
               {"program_version", program_version},
               {"created", creation_time()},
               {"nodes", model.mesh.nodes.cols()},
               {"elements", kinds},
               {"unknowns",
                3 * model.mesh.nodes.cols() - static_cast<Eigen::Index>(model.joints.ties.size())},
               {"mass_kg", assessment.mass.mass},
               {"volume_m3", assessment.mass.volume},
               {"centre_of_mass_m", vector(assessment.mass.centre)}};
  for (const structure::PartMeeting& meeting : model.joints.meetings)
    if (meeting.tied_nodes > 0)
      summary["joints"].push_back({{"bodies", {meeting.bodies[0], meeting.bodies[1]}},
                                   {"point_m", vector(meeting.place)},
                                   {"gap_m", meeting.gap},
                                   {"tied_nodes", meeting.tied_nodes},
                                   {"largest_gap_m", meeting.largest_gap}});
  for (const std::string& doubt : list_doubts(model)) summary["warnings"].push_back(doubt);
  if (!assessment.file.loads.empty()) add_solution(assessment, summary);
  if (assessment.modes) {
    for (const double frequency : assessment.modes->frequencies)
      summary["natural_frequencies_Hz"].push_back(frequency);
    summary["rigid_motions"] = assessment.modes->rigid_motions;
    summary["modes_residual"] = assessment.modes->residual;
  }
  if (assessment.file.references)
    for (const PartReference& figure : assessment.file.references->figures)
      summary["references"].push_back({{"figure", name_of(figure)},
                                       {"reference", figure.value.value.value},
                                       {"computed", figure_of(assessment, figure)},
                                       {"source", assessment.file.references->source}});
  const structure::SolverAccount& solver = solution.solver;
  if (!assessment.file.loads.empty())
    summary["solver"] = {{"name", solver.name},
                         {"processes", solver.processes},
                         {"iterations", solver.iterations},
                         {"factor_GB", solver.factor_bytes / 1e9}};
  summary["timing"] = {{"mesh_s", assessment.mesh_s},
                       {"assembly_s", solver.assembly_s},
                       {"factorisation_s", solver.factorisation_s},
                       {"solve_s", solver.solve_s},
                       {"recovery_s", solution.recovery_s},
                       {"modes_s", assessment.modes_s}};
  return summary;
}

void write_fields(const PartAssessment& assessment, const std::filesystem::path& path) {
  const structure::PartModel& model = assessment.model;
  const structure::PartStress& stress = assessment.solution.stress;
  ResultsWriter file(path);
  file.write_text("/part/yaml", assessment.file.yaml, "the part's file");
  file.write_matrix("/nodes/position", model.mesh.nodes.transpose(), {"m", "places of the nodes"});
  if (!assessment.file.loads.empty()) {
    file.write_matrix("/nodes/displacement",
                      Eigen::Map<const RowMajorMatrix>(assessment.solution.displacement.data(),
                                                       model.mesh.nodes.cols(), 3),
                      {"m", "displacement of the nodes"});
    file.write(
        "/stress/node", std::vector<std::int32_t>(stress.node.begin(), stress.node.end()),
        {"1", "node of each point of stress; a node has one for each material that meets it"});
    file.write_matrix("/stress/components", stress.averaged.transpose(),
                      {"Pa", "xx, yy, zz, xy, yz, zx, averaged over the solids of one material"});
  }
  if (assessment.modes) {
    file.write_matrix("/modes/frequency", assessment.modes->frequencies,
                      {"Hz", "natural frequencies, those of rigid motion zero"});
    file.write_matrix("/modes/shape", assessment.modes->shapes.transpose(),
                      {"m/kg^0.5", "a row a mode: x, y, z of each node, of unit modal mass"});
  }
  file.finish();
}

}  // namespace

void write_part_results(const PartAssessment& assessment, const std::filesystem::path& folder,
                        bool calculix) {
  Preparation preparation(folder);
  const std::filesystem::path& aside = preparation.folder();
  if (!assessment.file.loads.empty())
    structure::write_part_vtu((aside / "part.vtu").string(), assessment.model, assessment.solution);
  if (assessment.modes)
    structure::write_part_modes_vtu((aside / "modes.vtu").string(), assessment.model,
                                    *assessment.modes);
  if (calculix)
    structure::write_calculix((aside / "part.inp").string(), assessment.model,
                              {!assessment.file.loads.empty(), assessment.file.modes.value_or(0)});
  write_fields(assessment, aside / "results.h5");
  write_file(aside / "summary.json", make_part_summary(assessment).dump(2));
  preparation.move_into_place({"part.vtu", "modes.vtu", "part.inp"});
}

}  // namespace blocklift::pipeline

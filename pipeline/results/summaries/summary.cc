#include "pipeline/results/summaries/summary.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/checks/lift_checks.h"
#include "pipeline/checks/loop_loads.h"
#include "pipeline/files/environment/sea_band.h"
#include "pipeline/files/lift_case/input_hash.h"
#include "pipeline/formats/json_values.h"
#include "pipeline/lift/history_figures.h"
#include "pipeline/results/doubts/blow_doubts.h"
#include "pipeline/results/doubts/bounce_doubts.h"
#include "pipeline/results/doubts/doubts.h"
#include "pipeline/results/doubts/torsion_doubts.h"
#include "pipeline/results/files/result_file.h"
#include "pipeline/results/summaries/assumptions.h"
#include "pipeline/results/summaries/history_summary.h"
#include "pipeline/results/summaries/measure_summary.h"
#include "pipeline/results/summaries/mesh_error.h"
#include "pipeline/results/summaries/padeye_summary.h"
#include "pipeline/results/summaries/radiation_summary.h"
#include "pipeline/results/summaries/sling_summary.h"
#include "pipeline/results/summaries/standard_summary.h"
#include "pipeline/results/summaries/table_summary.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {

namespace {

using Json = nlohmann::ordered_json;
using dynamics::LinkedMaximum;

Json check_json(const Check& check) {
  Json json{{"name", check.name},
            {"demand", json_number(check.demand)},
            {"limit", json_number(check.limit)},
            {"unit", check.unit},
            {"utilisation", json_number(check.utilisation)},
            {"pass", check.pass}};
  if (check.band) {
    const auto [lower, upper] = check.utilisation_band();
    json["utilisation_band"] = {json_number(lower), json_number(upper)};
  }
  if (check.time) json["time_s"] = *check.time;
  if (!check.note.empty()) json["note"] = check.note;
  return json;
}

struct Peak {
  double value, time;
};

/// Largest static and dynamic value of one load with their times.
/// @param at_rest none: the lift was not swept at rest.
Json maxima_json(const std::string& name, const std::optional<Peak>& at_rest, const Peak& in_motion,
                 const std::string& quantity) {
  Json json{{"name", name}};
  if (at_rest) {
    json["max_static_" + quantity] = at_rest->value;
    json["time_of_max_static_s"] = at_rest->time;
  }
  json["max_dynamic_" + quantity] = in_motion.value;
  json["time_of_max_dynamic_s"] = in_motion.time;
  if (at_rest) json["dynamic_over_static"] = json_number(in_motion.value / at_rest->value);
  return json;
}

Peak peak_of(const Eigen::VectorXd& values, const Eigen::VectorXd& times) {
  Eigen::Index at = 0;
  const double value = values.maxCoeff(&at);
  return {value, times[at]};
}

/// The ropes, hoists and cranes of a lift with their largest loads.
class LoadTables {
 public:
  LoadTables(const LiftCase& lift_case, const LiftRun& lift)
      : case_(lift_case),
        lift_(lift),
        static_maxima_(lift.is_swept() ? dynamics::find_largest_tensions(lift.static_history)
                                       : std::vector<LinkedMaximum>()),
        dynamic_maxima_(dynamics::find_largest_tensions(lift.dynamic_history())) {}

  Json ropes() const {
    Json rows = Json::array();
    for (const LiftRope& rope : lift_.model.ropes) {
      Json row = rope_row(rope.name, rope.rope);
      if (!rope.lug.empty()) row["lug"] = rope.lug;
      if (!rope.hoist.empty()) row["hoist"] = rope.hoist;
      row["breaking_load_N"] = rope.breaking_load;
      if (const given::Rope& in_case = *case_.find_rope(rope.name);
          in_case.rope.diameter && knows_bend(in_case) && find_bend(in_case, lift_))
        row["bend_efficiency"] = bend_efficiency(in_case, lift_);
      if (const auto& rope_of = lift_.model.system.ropes()[rope.rope];
          rope_of.definition().tension_law)
        row["largest_strain"] = rope_of.definition().tension_law->find_strain(
            row["max_dynamic_tension_N"].get<double>());
      if (lift_.is_swept()) row["linked_static_N"] = linked(static_maxima_, rope.rope);
      row["linked_dynamic_N"] = linked(dynamic_maxima_, rope.rope);
      rows.push_back(row);
    }
    return rows;
  }

  Json hoists() const {
    Json rows = Json::array();
    for (const LiftHoist& hoist : lift_.model.hoists) {
      Json row = rope_row(hoist.name, hoist.rope);
      row["crane"] = case_.cranes[hoist.crane].name.value;
      row["breaking_load_N"] = hoist.breaking_load;
      row["capacity_N"] = hoist.capacity;
      const auto& history = lift_.dynamic_history().ropes[hoist.rope];
      if (lift_.dynamic_history().recording().rope_forces)
        row["max_swing_rad"] = swing_angles(hook_pull(history, hoist.hook_is_first)).maxCoeff();
      rows.push_back(row);
    }
    return rows;
  }

  Json cranes() const {
    Json rows = Json::array();
    for (std::size_t i = 0; i < case_.cranes.size(); ++i) {
      const auto peak = [&](const dynamics::History& history) {
        return peak_of(crane_load(lift_.model, history, i), history.time);
      };
      std::optional<Peak> at_rest;
      if (lift_.is_swept()) at_rest = peak(lift_.static_history);
      Json row =
          maxima_json(case_.cranes[i].name.value, at_rest, peak(lift_.dynamic_history()), "load_N");
      if (case_.cranes[i].model->capacity) row["capacity_N"] = *case_.cranes[i].model->capacity;
      rows.push_back(row);
    }
    return rows;
  }

  Json comparison(const Comparison& compare) const {
    Json rows = Json::array();
    for (const Named<PublishedLoads>& published : compare.ropes) {
      const auto& ropes = lift_.model.ropes;
      const auto rope = std::find_if(ropes.begin(), ropes.end(), [&](const LiftRope& r) {
        return r.name == published.name.value;
      });
      if (rope == ropes.end()) continue;
      const auto index = static_cast<std::size_t>(rope->rope);
      Json row{{"name", published.name.value}};
      if (const auto& load = published.value.static_load) {
        row["published_static_N"] = *load;
        row["static_difference_percent"] = percent_above(static_maxima_[index].tension, *load);
      }
      if (const auto& load = published.value.dynamic_load) {
        row["published_dynamic_N"] = *load;
        row["dynamic_difference_percent"] = percent_above(dynamic_maxima_[index].tension, *load);
      }
      rows.push_back(row);
    }
    return rows;
  }

  /// The computed tension in motion less the measured one, in per cent of the largest measured.
  Json series(const Comparison& compare) const {
    Json rows = Json::array();
    for (const Named<MeasuredSeries>& named : compare.series) {
      const dynamics::RopeHistory& rope = lift_.dynamic_history().rope(named.name.value);
      const MeasuredSeries& measured = named.value;
      const double largest = *std::max_element(measured.tension.begin(), measured.tension.end());
      double sum = 0, most = 0, when = 0;
      int points = 0;
      for (std::size_t i = 0; i < measured.time.size(); ++i) {
        const std::optional<double> computed =
            value_at(lift_.dynamic_history().time, rope.tension, measured.time[i]);
        if (!computed) continue;
        const double difference = 100 * (*computed - measured.tension[i]) / largest;
        ++points;
        sum += std::abs(difference);
        if (std::abs(difference) < std::abs(most)) continue;
        most = difference;
        when = measured.time[i];
      }
      rows.push_back({{"name", named.name.value},
                      {"points", points},
                      {"mean_difference_percent", json_number(points > 0 ? sum / points : NAN)},
                      {"largest_difference_percent", json_number(points > 0 ? most : NAN)},
                      {"time_of_largest_s", when}});
    }
    return rows;
  }

 private:
  /// Linear between the samples; none outside of them.
  static std::optional<double> value_at(const Eigen::VectorXd& time, const Eigen::VectorXd& values,
                                        double t) {
    if (time.size() < 2 || t < time[0] || t > time[time.size() - 1]) return std::nullopt;
    const auto* end = std::lower_bound(time.data() + 1, time.data() + time.size() - 1, t);
    const Eigen::Index i = end - time.data();
    const double s = (t - time[i - 1]) / (time[i] - time[i - 1]);
    return (1 - s) * values[i - 1] + s * values[i];
  }

  /// Which edges a rope touches stands beside its forces on them.
  bool knows_bend(const given::Rope& rope) const {
    return rope.edges.empty() || lift_.dynamic_history().recording().rope_forces;
  }

  Json rope_row(const std::string& name, int rope) const {
    const auto peak = [rope](const std::vector<LinkedMaximum>& maxima) {
      return Peak{maxima[rope].tension, maxima[rope].time};
    };
    std::optional<Peak> at_rest;
    if (lift_.is_swept()) at_rest = peak(static_maxima_);
    Json row = maxima_json(name, at_rest, peak(dynamic_maxima_), "tension_N");
    if (const std::optional<Blow> blow = find_blow_before_peak(lift_, rope))
      row["after_blow"] = {{"slack_rope", lift_.model.system.ropes()[blow->rope].name()},
                           {"slack_from_s", blow->slack_from},
                           {"taut_again_s", blow->taut_again},
                           {"within_s", reach_of_blow}};
    return row;
  }

  Json linked(const std::vector<LinkedMaximum>& maxima, int rope) const {
    Json values = Json::object();
    for (const LiftRope& other : lift_.model.ropes)
      values[other.name] = maxima[rope].tensions(other.rope);
    return values;
  }

  const LiftCase& case_;
  const LiftRun& lift_;
  std::vector<LinkedMaximum> static_maxima_;
  std::vector<LinkedMaximum> dynamic_maxima_;
};

/// @param displacement the largest, which may belong to another instant than the largest stress
Json state_json(const BlockState& state, double displacement) {
  const structure::LoadCaseResult& result = state.result;
  Json json{{"checked_von_mises_Pa", result.checked_von_mises.value},
            {"peak_von_mises_Pa", result.peak_von_mises.value},
            {"max_displacement_m", displacement},
            {"force_residual", result.balance.force_residual},
            {"moment_residual", result.balance.moment_residual},
            {"reaction_over_weight", result.balance.reaction_over_weight}};
  if (!state.rope.empty()) json["rope"] = state.rope;
  if (state.time) json["time_s"] = *state.time;
  json["checked_group"] = result.checked_von_mises.part;
  json["checked_point_m"] = json_point(result.checked_von_mises.point_B);
  json["peak_group"] = result.peak_von_mises.part;
  json["peak_point_m"] = json_point(result.peak_von_mises.point_B);
  json["max_displacement_point_m"] = json_point(result.displacement.point_B);
  return json;
}

Json way_json(const LoadComparison& way) {
  return {{"static", state_json(way.static_state, way.static_displacement)},
          {"dynamic", state_json(way.dynamic_state, way.dynamic_displacement)},
          {"stress_increase_percent", way.stress_increase_percent()},
          {"deformation_increase_percent", way.deformation_increase_percent()}};
}

Json lug_way_json(const LoadComparison& way, std::size_t lug) {
  const double at_rest = way.static_state.result.lugs[lug].checked_von_mises.value;
  const double in_motion = way.dynamic_state.result.lugs[lug].checked_von_mises.value;
  return {{"static_checked_von_mises_Pa", at_rest},
          {"dynamic_checked_von_mises_Pa", in_motion},
          {"stress_increase_percent", json_number(percent_above(in_motion, at_rest))}};
}

Json lugs_json(const Assessment& assessment) {
  const BlockAssessment& block = assessment.block.assessment;
  Json rows = Json::array();
  const auto& lugs = assessment.block.model->mesh().lifting_points;
  for (std::size_t i = 0; i < lugs.size(); ++i) {
    Json row{{"name", lugs[i].name}};
    // The instant of the lug's own rope tells most about its neighbourhood.
    const LoadComparison* own = &block.simultaneous;
    for (const given::Rope& rope : assessment.lift_case.ropes) {
      if (rope.lug() != lugs[i].name) continue;
      row["rope"] = rope.name.value;
      for (const LoadComparison& by_rope : block.simultaneous_by_rope) {
        if (by_rope.static_state.rope == rope.name.value) own = &by_rope;
      }
    }
    row["simultaneous"] = lug_way_json(*own, i);
    row["per_rope_maxima"] = lug_way_json(block.per_rope_maxima, i);
    rows.push_back(row);
  }
  return rows;
}

Json error_json(const structure::Mesh& mesh, const structure::BlockError& error) {
  Json json{{"relative", error.relative},
            {"worst_part", error.worst_part},
            {"worst_point_m", json_point(error.worst_point)},
            {"groups", Json::object()}};
  for (std::size_t g = 0; g < mesh.groups.size(); ++g)
    json["groups"][mesh.groups[g].name] = error.of_groups[g];
  return json;
}

Json accuracy_json(const BlockRun& block, const StructureSettings& asked) {
  const structure::CheckedAccuracy& accuracy = block.accuracy;
  Json steps = Json::array();
  for (const structure::AccuracyStep& step : accuracy.steps)
    steps.push_back({{"unknowns", step.unknowns},
                     {"elements", step.shells},
                     {"smallest_edge_m", step.smallest_edge},
                     {"static_checked_von_mises_Pa", step.at_rest},
                     {"dynamic_checked_von_mises_Pa", step.in_motion},
                     {"stress_increase_percent", 100 * step.increase()}});
  return {{"asked", asked.accuracy},
          {"is_reached", accuracy.is_reached},
          {"stress_change", accuracy.stress_change()},
          {"stress_band", checked_stress_band(block)},
          {"increase_change_percent", 100 * accuracy.increase_change()},
          {"steps", std::move(steps)}};
}

Json structure_json(const Assessment& assessment) {
  const BlockAssessment& block = assessment.block.assessment;
  const structure::ElasticModel& model = *assessment.block.model;
  const structure::MassProperties& mass = model.mass_properties();
  Json by_rope = Json::array();
  for (const LoadComparison& comparison : block.simultaneous_by_rope) {
    Json row{{"rope", comparison.static_state.rope}};
    row.update(way_json(comparison));
    by_rope.push_back(row);
  }
  const structure::Material& material = model.mesh().materials.front();
  Json json{{"unknowns", model.space().unknowns()},
            {"elements", model.space().shells().size() + model.space().beams().size() +
                             model.mesh().solids.size()},
            {"element_degree", assessment.lift_case.structure.element_degree},
            {"mesh_size_m", assessment.lift_case.structure.largest_element},
            {"material", material.name},
            {"yield_Pa", material.yield_stress},
            {"first_elastic_period_s", assessment.block.first_elastic_period},
            {"per_rope_maxima", way_json(block.per_rope_maxima)},
            {"simultaneous", way_json(block.simultaneous)},
            {"simultaneous_by_rope", by_rope},
            {"lugs", lugs_json(assessment)},
            {"mass",
             {{"total_kg", mass.mass},
              {"steel_kg", mass.steel_mass},
              {"outfitting_kg", mass.outfitting_mass},
              {"centre_of_mass_m", json_point(mass.centre_of_mass_B)},
              {"steel_centre_of_mass_m", json_point(mass.steel_centre_B)},
              {"smallest_density_factor", mass.smallest_density_factor},
              {"largest_density_factor", mass.largest_density_factor}}}};
  json["estimated_error"] = error_json(model.mesh(), assessment.block.error);
  json["accuracy"] = accuracy_json(assessment.block, assessment.lift_case.structure);
  json["buckling"] = buckling_json(assessment.block.buckling);
  if (const auto& pressure = assessment.block.pressure) {
    json["pressure"] = {{"regions", pressure->regions},
                        {"fields", pressure->count()},
                        {"error", pressure->error},
                        {"largest_force_N", pressure->largest_force}};
  }
  if (!assessment.block.padeyes.padeyes.empty())
    json["padeyes"] = padeyes_json(assessment.block.padeyes);
  if (const auto balances = find_table_balances(assessment))
    json["load_table"] = table_balances_json(*balances);
  if (assessment.block.history) json["history"] = history_json(*assessment.block.history);
  if (!assessment.block.stages.empty())
    json["stages"] = stage_stresses_json(assessment.block.stages);
  return json;
}

// How the block gave way where the ropes pull.
Json flexibility_json(const DynamicsSettings& settings, const LiftRun& lift) {
  switch (settings.flexibility) {
    case Flexibility::rigid:
      return {{"kind", "rigid"}};
    case Flexibility::static_:
    case Flexibility::modal:
      break;
  }
  Json json{{"kind", settings.flexibility == Flexibility::modal ? "modal" : "static"}};
  if (settings.flexibility == Flexibility::modal) {
    json["modes"] = settings.mode_count();
    json["modal_damping"] = settings.mode_damping();
  }
  if (const auto& largest = lift.elastic_displacement)
    json["largest_lug_displacement"] = {
        {"size_m", largest->size}, {"lug", largest->lug}, {"time_s", largest->time}};
  return json;
}

Json energy_json(const LiftRun& lift) {
  const dynamics::EnergyHistory& energy = lift.dynamic_history().energy;
  const Eigen::VectorXd stored = energy.kinetic + energy.gravity + energy.elastic;
  // What the winches and drives have turned over is the measure for what may get lost.
  const double largest = (stored.array() - stored(0)).abs().maxCoeff<Eigen::PropagateNaN>();
  const double imbalance = energy_imbalance(energy).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  return {{"largest_energy_J", largest},
          {"largest_imbalance_J", imbalance},
          {"relative_imbalance", json_number(imbalance / largest)}};
}

}  // namespace

Json solver_json(const dynamics::IntegrationStatistics& s, double simulated_s, double elapsed_s) {
  return {{"steps", s.steps},
          {"right_hand_sides", s.right_hand_sides},
          {"right_hand_sides_for_differences", s.difference_right_hand_sides},
          {"jacobians", s.jacobians},
          {"factorisations", s.factorisations},
          {"newton_iterations", s.newton_iterations},
          {"error_test_failures", s.error_test_failures},
          {"nonlinear_failures", s.nonlinear_failures},
          {"restarts", s.restarts},
          {"ropes_slack_or_taut_again", s.contact_changes},
          {"times_faster_than_real_time", json_number(simulated_s / elapsed_s)}};
}

namespace {

void add_structure_timing(const BlockRun& block, Json& timing) {
  const structure::SolutionTiming& solution = block.responses->timing();
  timing["mesh_s"] = block.mesh_s;
  timing["assembly_s"] = solution.assembly_s;
  timing["analysis_s"] = solution.analysis_s;
  timing["factorisation_s"] = solution.factorisation_s;
  timing["solve_s"] = solution.solve_s;
  timing["evaluation_s"] = block.assessment.evaluation_s;
  timing["buckling_s"] = block.buckling.evaluation_s;
  if (!block.padeyes.padeyes.empty()) timing["padeyes_s"] = block.padeyes.evaluation_s;
  if (block.history) timing["history_s"] = block.history->evaluation_s;
}

Json dynamics_timing(const LiftRun& lift) {
  return {{"static_s", lift.static_s},
          {"dynamic_s", lift.dynamic_s},
          {"simulated_s", lift.simulated_s()}};
}

Json timing_json(const Assessment& assessment) {
  Json timing = assessment.lift ? dynamics_timing(*assessment.lift) : Json::object();
  if (assessment.block.model) add_structure_timing(assessment.block, timing);
  timing["total_s"] = assessment.total_s;
  return timing;
}

Json comparison_json(const LiftCase& lift_case, const LiftRun* lift) {
  const Comparison& compare = *lift_case.compare;
  Json json{{"source", compare.source}};
  if (lift) {
    const LoadTables tables(lift_case, *lift);
    json["ropes"] = tables.comparison(compare);
    if (!compare.series.empty()) json["series"] = tables.series(compare);
  }
  if (compare.stress_increase) json["stress_increase_percent"] = 100 * *compare.stress_increase;
  if (compare.deformation_increase)
    json["deformation_increase_percent"] = 100 * *compare.deformation_increase;
  return json;
}

void add_loads(const LiftCase& lift_case, const LiftRun& lift, const WantedParts& wanted,
               Json& summary) {
  if (wanted("ropes") || wanted("hoists") || wanted("cranes")) {
    const LoadTables tables(lift_case, lift);
    if (wanted("ropes")) summary["ropes"] = tables.ropes();
    if (wanted("hoists")) summary["hoists"] = tables.hoists();
    if (wanted("cranes")) summary["cranes"] = tables.cranes();
  }
  if (!wanted("loops")) return;
  if (Json loops = loops_json(lift); !loops.empty()) summary["loops"] = std::move(loops);
}

/// Loads stage by stage, and measures.
void add_watched(const LiftRun& lift, const std::vector<LiftMeasure>& measures,
                 const WantedParts& wanted, Json& summary) {
  if (wanted("stages")) summary["stages"] = stages_json(lift);
  if (wanted("measures")) summary["measures"] = measures_json(lift, measures);
  if (Json parted = parted_json(lift); !parted.empty()) summary["parted"] = std::move(parted);
  if (Json worst = worst_instant_json(lift); !worst.is_null())
    summary["worst_instant"] = std::move(worst);
}

void add_doubts(const LiftCase& lift_case, const LiftRun& lift, Json& summary) {
  for (std::string& doubt : list_doubts(lift_case, lift))
    summary["warnings"].push_back(std::move(doubt));
  for (std::string& doubt : list_blow_doubts(lift)) summary["warnings"].push_back(std::move(doubt));
}

void add_motion(const LiftCase& lift_case, const LiftRun& lift, const WantedParts& wanted,
                Json& summary) {
  if (wanted("natural_periods"))
    summary["natural_periods"] =
        natural_periods_json(lift.model.system.mechanism(), lift.natural_modes);
  summary["flexibility"] = flexibility_json(lift_case.dynamics, lift);
  if (wanted("radiation"))
    add_radiation(record_radiation(lift.model, lift.dynamic_history()), summary);
  // A member of a study may have left its works out.
  if (lift.dynamic_history().energy.drive_work.size() > 0) summary["energy"] = energy_json(lift);
  summary["solver"] =
      solver_json(lift.dynamic_result.statistics, lift.simulated_s(), lift.dynamic_s);
}

/// An assessment and a simulation that is written have all parts.
bool all_parts(std::string_view) { return true; }

Json document_json(const given::Document& document) {
  Json json = Json::object();
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  add("project", document.project);
  add("client", document.client);
  add("revision", document.revision);
  add("prepared", document.prepared);
  add("checked", document.checked);
  add("approved", document.approved);
  return json;
}

}  // namespace

Json make_summary(const Assessment& assessment) {
  Json summary{{"case", assessment.lift_case.name},
               {"input_hash", hash_of_input(assessment.lift_case)},
               {"title", assessment.lift_case.title},
               {"document", document_json(assessment.lift_case.document)},
               {"program_version", program_version},
               {"created", creation_time()},
               {"verdict", assessment.pass() ? "pass" : "fail"},
               {"verdict_reasons", verdict_reasons(assessment.checks)},
               {"checks", Json::array()}};
  if (const std::string reason = why_indicative(assessment); !reason.empty())
    summary["indicative"] = reason;
  for (const Check& check : assessment.checks) summary["checks"].push_back(check_json(check));
  if (assessment.standard) summary["standard"] = standard_json(*assessment.standard);
  const LiftRun* lift = assessment.lift ? &*assessment.lift : nullptr;
  if (lift) {
    add_loads(assessment.lift_case, *lift, all_parts, summary);
    add_watched(*lift, assessment.measures, all_parts, summary);
  }
  if (assessment.sling_lengths)
    summary["sling_lengths"] = sling_lengths_json(*assessment.sling_lengths);
  if (assessment.lift_case.compare)
    summary["comparison"] = comparison_json(assessment.lift_case, lift);
  if (assessment.block.model) summary["structure"] = structure_json(assessment);
  if (lift) add_motion(assessment.lift_case, *lift, all_parts, summary);
  summary["timing"] = timing_json(assessment);
  if (lift) add_doubts(assessment.lift_case, *lift, summary);
  if (lift)
    for (std::string& doubt : list_bounce_doubts(assessment.lift_case, *lift))
      summary["warnings"].push_back(std::move(doubt));
  if (lift && assessment.sling_lengths)
    for (std::string& doubt : list_doubts(assessment.lift_case, *lift, *assessment.sling_lengths))
      summary["warnings"].push_back(std::move(doubt));
  if (const auto balances = find_table_balances(assessment))
    for (std::string& doubt : list_doubts(*balances))
      summary["warnings"].push_back(std::move(doubt));
  for (std::string& doubt : list_torsion_doubts(assessment.block))
    summary["warnings"].push_back(std::move(doubt));
  summary["assumptions"] = list_assumptions(assessment);
  return summary;
}

Json make_simulation_figures(const LiftCase& lift_case, const LiftRun& lift,
                             const std::vector<LiftMeasure>& measures, const WantedParts& wanted) {
  Json figures = Json::object();
  add_loads(lift_case, lift, wanted, figures);
  add_watched(lift, measures, wanted, figures);
  if (lift_case.compare && wanted("comparison"))
    figures["comparison"] = comparison_json(lift_case, &lift);
  add_motion(lift_case, lift, wanted, figures);
  figures["timing"] = dynamics_timing(lift);
  return figures;
}

Json make_simulation_summary(const LiftCase& lift_case, const LiftRun& lift,
                             const std::vector<LiftMeasure>& measures) {
  Json summary{{"case", lift_case.name},
               {"input_hash", hash_of_input(lift_case)},
               {"title", lift_case.title},
               {"document", document_json(lift_case.document)},
               {"program_version", program_version},
               {"created", creation_time()}};
  summary.update(make_simulation_figures(lift_case, lift, measures, all_parts));
  add_doubts(lift_case, lift, summary);
  if (std::string sea = describe_sea(lift_case, lift_case.gravity); !sea.empty())
    summary["assumptions"].push_back(std::move(sea));
  return summary;
}

}  // namespace blocklift::pipeline

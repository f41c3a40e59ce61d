#include "pipeline/results/summaries/measure_summary.h"

#include <nlohmann/json.hpp>

#include "pipeline/formats/json_values.h"
#include "pipeline/lift/stage_loads.h"

namespace blocklift::pipeline {

namespace {

using Json = nlohmann::ordered_json;

Json load_json(const StageLoad& load) {
  return {{"name", load.name},
          {"max_static_tension_N", load.at_rest},
          {"time_of_max_static_s", load.time_at_rest},
          {"max_dynamic_tension_N", load.in_motion},
          {"time_of_max_dynamic_s", load.time_in_motion},
          {"dynamic_over_static", json_number(load.in_motion / load.at_rest)}};
}

Json loads_json(const std::vector<StageLoad>& loads) {
  Json rows = Json::array();
  for (const StageLoad& load : loads) rows.push_back(load_json(load));
  return rows;
}

const char* word_of(Extreme extreme) {
  switch (extreme) {
    case Extreme::largest:
      return "largest";
    case Extreme::smallest:
      return "smallest";
    case Extreme::largest_magnitude:
      break;
  }
  return "largest in magnitude";
}

}  // namespace

Json stages_json(const LiftRun& lift) {
  Json rows = Json::array();
  for (const StageLoads& stage : find_stage_loads(lift)) {
    Json load = load_json(stage.load);
    load.erase("name");
    rows.push_back({{"name", stage.stage},
                    {"start_s", stage.start},
                    {"end_s", stage.end},
                    {"ropes", loads_json(stage.ropes)},
                    {"hoists", loads_json(stage.hoists)},
                    {"load", std::move(load)}});
    if (stage.met) rows.back()["condition_met_s"] = *stage.met;
  }
  return rows;
}

Json parted_json(const LiftRun& lift) {
  Json rows = Json::array();
  for (const dynamics::PartedRope& parted : lift.dynamic_result.parted)
    rows.push_back({{"name", lift.model.system.ropes()[parted.rope].name()},
                    {"time_s", parted.time},
                    {"tension_N", parted.tension},
                    {"energy_J", parted.energy}});
  return rows;
}

Json worst_instant_json(const LiftRun& lift) {
  if (!lift.model.worst) return nullptr;
  const auto trial_json = [](const WorstInstant::Trial& trial) -> Json {
    return {{"time_s", trial.time},
            {"rope", trial.rope},
            {"share", trial.share},
            {"peak_time_s", trial.peak_time}};
  };
  const auto& [worst, undisturbed, trials] = *lift.model.worst;
  Json json = trial_json(worst);
  json["undisturbed"] = trial_json(undisturbed);
  json["undisturbed"].erase("time_s");
  json["tried"] = Json::array();
  for (const WorstInstant::Trial& trial : trials) json["tried"].push_back(trial_json(trial));
  return json;
}

Json measures_json(const LiftRun& lift, const std::vector<LiftMeasure>& measures) {
  Json rows = Json::array();
  for (const LiftMeasure& measure : measures) {
    const MeasurePeak still = find_peak(lift.static_history.time, measure.at_rest, measure.extreme);
    const MeasurePeak moving =
        find_peak(lift.dynamic_history().time, measure.in_motion, measure.extreme);
    rows.push_back({{"name", measure.name()},
                    {"subject", measure.subject},
                    {"kind", measure.kind},
                    {"unit", measure.unit},
                    {"extreme", word_of(measure.extreme)},
                    {"meaning", measure.meaning},
                    {"static", json_number(still.value)},
                    {"time_of_static_s", still.time},
                    {"dynamic", json_number(moving.value)},
                    {"time_of_dynamic_s", moving.time}});
  }
  return rows;
}

}  // namespace blocklift::pipeline

#include "pipeline/files/lift_case/lift_case_check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/files/lift_case/case_names.h"
#include "pipeline/files/lift_case/crane_start.h"
#include "pipeline/files/lift_case/operation_check.h"
#include "pipeline/files/lift_case/rigging_check.h"
#include "pipeline/files/lift_case/standard_check.h"

namespace blocklift::pipeline {
namespace {

/// Start values of one crane: each drive and hoist has one, of its kind and within its range.
void check_start(const given::Crane& crane, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  const auto check_one = [&](const std::string& part, const char* noun, const char* example,
                             const DriveLimits& limits) {
    known.push_back(part);
    const Located<Quantity>* start = crane.find_start(part);
    if (!start) {
      diagnostics.error(
          crane.name.mark,
          fmt::format("crane {} gives no start for its {} {}", crane.name.value, noun, part),
          {fmt::format("add {}: {} to its start", part, example)});
      return;
    }
    const Quantity& low = limits.range[0];
    const Quantity& high = limits.range[1];
    if (!std::isfinite(start->value.value) || !std::isfinite(low.value) ||
        !std::isfinite(high.value)) {
      return;
    }
    if (start->value.dimension != low.dimension) {
      diagnostics.error(
          start->mark,
          fmt::format("the start of {} {}.{} is {}; {} is due", noun, crane.name.value, part,
                      text_of(start->value.dimension).noun, text_of(low.dimension).noun));
    } else if (start->value.value < low.value || start->value.value > high.value) {
      diagnostics.error(
          start->mark,
          fmt::format("{} {}.{} starts at {}, outside its range", noun, crane.name.value, part,
                      format_quantity(start->value.value, low.dimension)),
          {fmt::format("its range is {} to {}", format_quantity(low.value, low.dimension),
                       format_quantity(high.value, high.dimension))});
    }
  };
  for (const DriveModel& drive : crane.model->drives) {
    check_one(drive.name.value, "drive", "0 m", drive);
  }
  for (const HoistModel& hoist : crane.model->hoists) {
    check_one(hoist.name.value, "hoist", "30 m", hoist.winch);
  }
  for (const auto& start : crane.start) {
    if (std::find(known.begin(), known.end(), start.name.value) != known.end()) continue;
    diagnostics.error(
        start.name.mark,
        fmt::format("crane {} has no drive or hoist \"{}\"", crane.name.value, start.name.value),
        {names_hint("its drives and hoists are", known, start.name.value)});
  }
}

void check_names(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const given::Crane& crane : lift_case.cranes) {
    if (crane.name.value == "world" || crane.name.value == "load") {
      diagnostics.error(crane.name.mark,
                        fmt::format("a crane cannot be named \"{}\"", crane.name.value));
    }
    if (lift_case.find_vessel(crane.name.value)) {
      diagnostics.error(crane.name.mark, fmt::format("a crane and a vessel are both named \"{}\"",
                                                     crane.name.value));
    }
    if (crane.base && !crane.base->value.empty() && !lift_case.find_vessel(crane.base->value)) {
      diagnostics.error(
          crane.base->mark,
          fmt::format("crane {} stands on vessel \"{}\", which the case does not have",
                      crane.name.value, crane.base->value),
          {names_hint("its vessels are", names_of(lift_case.vessels), crane.base->value)});
    }
  }
}

void check_spreader_names(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const given::Spreader& bar : lift_case.spreaders) {
    const std::string& name = bar.name.value;
    if (name == "world" || name == "load")
      diagnostics.error(bar.name.mark, fmt::format("a spreader cannot be named \"{}\"", name));
    const char* other = lift_case.find_crane(name)    ? "crane"
                        : lift_case.find_vessel(name) ? "vessel"
                                                      : nullptr;
    if (other)
      diagnostics.error(bar.name.mark,
                        fmt::format("a spreader and a {} are both named \"{}\"", other, name));
  }
}

void check_comparison(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (!lift_case.compare) return;
  if (lift_case.load_table) return;
  const std::vector<std::string> known = names_of(lift_case.ropes);
  const auto check = [&](const Located<std::string>& name) {
    if (std::find(known.begin(), known.end(), name.value) != known.end()) return;
    diagnostics.error(
        name.mark,
        fmt::format("compare names rope \"{}\", which the case does not have", name.value),
        {names_hint("its ropes are", known, name.value)});
  };
  for (const auto& loads : lift_case.compare->ropes) check(loads.name);
  for (const auto& series : lift_case.compare->series) check(series.name);
}

/// Every lug that the table names exists; static, dynamic and direction name the same ones.
void check_load_table(const LiftCase& lift_case, const LoadTable& table, Diagnostics& diagnostics) {
  const auto check_exists = [&](const Located<std::string>& lug) {
    if (!lift_case.load.model || lift_case.load.model->find_lug(lug.value)) return true;
    diagnostics.error(lug.mark,
                      fmt::format("the load table names lug \"{}\", which block {} does not have",
                                  lug.value, short_name(lift_case.load.model_name.value)),
                      {names_hint("its lugs are", lift_case.load.model->lug_names(), lug.value)});
    return false;
  };
  const auto check_listed = [&](const Located<std::string>& lug, const auto& list,
                                const char* list_name) {
    for (const auto& entry : list) {
      if (entry.name.value == lug.value) return;
    }
    diagnostics.error(lug.mark, fmt::format("lug {} is missing under {} of the load table",
                                            lug.value, list_name));
  };
  if (table.static_loads.empty()) diagnostics.error(table.place, "the load table names no lug");
  for (const auto& load : table.static_loads) {
    if (!check_exists(load.name)) continue;
    check_listed(load.name, table.dynamic_loads, "dynamic");
    if (const auto* each = std::get_if<std::vector<Named<Vector3>>>(&table.direction)) {
      check_listed(load.name, *each, "direction");
    }
  }
  for (const auto& load : table.dynamic_loads) {
    if (check_exists(load.name)) check_listed(load.name, table.static_loads, "static");
  }
}

/// A case has cranes, ropes and an operation, or a load table; complains about what is missing.
void check_kind_of_case(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (lift_case.load_table) return;  // check_keys_beside_load_table says what is too much
  const auto require = [&](bool missing, const char* key) {
    if (!missing) return;
    diagnostics.error(lift_case.place, fmt::format("the lift case lacks the key \"{}\"", key),
                      {"a case has cranes, ropes and operation, or a load_table"});
  };
  require(lift_case.cranes.empty() && lift_case.ropes.empty(), "cranes");
  require(lift_case.ropes.empty(), "ropes");
  require(lift_case.operation.empty(), "operation");
}

/// Ground that bears has a height, and names of its corners are its own.
void check_ground(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (!lift_case.ground_contact) return;
  if (!lift_case.ground_height())
    diagnostics.error(lift_case.ground_contact->place,
                      "the ground bears the load, and its height is not known",
                      {"give ground: the height of a quay or of a dock's floor"});
  for (const given::Support& support : lift_case.supports)
    if (support.name.value.starts_with("ground_"))
      diagnostics.error(support.name.mark,
                        fmt::format("\"{}\" is the name of a corner of the load on the ground",
                                    support.name.value),
                        {"names that begin with ground_ are those of ground_contact"});
}

/// Limits of what the case does not have: they would hold nothing, and nobody would see it.
void check_limits_hold_something(const LiftCase& lift_case, Diagnostics& diagnostics) {
  const CheckSettings& checks = lift_case.checks;
  const auto refuse = [&](const std::optional<Located<double>>& limit, const char* key,
                          const char* lack, const char* advice) {
    if (!limit) return;
    diagnostics.error(limit->mark, fmt::format("checks has {}, but {}", key, lack), {advice});
  };
  const auto none_of_cranes = [&](const auto& has) {
    return std::none_of(
        lift_case.cranes.begin(), lift_case.cranes.end(),
        [&](const given::Crane& crane) { return !crane.model || has(*crane.model); });
  };
  if (none_of_cranes([](const CraneModel& crane) { return crane.radius_from.has_value(); })) {
    constexpr const char* lack = "no crane says from where its radius counts";
    constexpr const char* advice =
        "give the crane a radius_from: {body: world, position: [0 m, 0 m, 0 m]}, or hold the "
        "tackles by swing";
    refuse(checks.largest_offlead, "offlead", lack, advice);
    refuse(checks.largest_sidelead, "sidelead", lack, advice);
  }
  const auto turns = [](const HoistModel& hoist) { return hoist.hook_block.turning.has_value(); };
  if (none_of_cranes([&](const CraneModel& crane) {
        return std::any_of(crane.hoists.begin(), crane.hoists.end(), turns);
      }))
    refuse(checks.largest_falls_twist, "falls_twist", "no crane has a hook block that turns",
           "give a hook_block the key turning, or leave falls_twist out");
  if (lift_case.vessels.empty()) {
    constexpr const char* lack = "the case has no vessels";
    constexpr const char* advice = "it is that of vessels, not of the load: leave it out";
    refuse(checks.largest_heel, "heel", lack, advice);
    refuse(checks.smallest_freeboard, "freeboard", lack, advice);
  }
  if (lift_case.spreaders.empty())
    refuse(checks.spreader_factor, "spreader_factor", "the case has no spreaders",
           "spreaders are bars and frames under the key spreaders: leave spreader_factor out");
}

/// A ship that is given as a block and as a vessel is one.
void check_weights(const given::Load& load, Diagnostics& diagnostics) {
  if (!load.model || !load.vessel || !load.model->mass) return;
  constexpr double allowed = 0.01;
  const double of_block = load.model->mass->value, of_vessel = load.vessel->model.mass;
  if (std::abs(of_block - of_vessel) <= allowed * of_vessel) return;
  diagnostics.error(
      load.vessel_name->mark,
      fmt::format("block {} weighs {}, and vessel {}, whose hull bears it, {}",
                  short_name(load.model_name.value), format_quantity(of_block, Dimension::mass),
                  short_name(load.vessel_name->value), format_quantity(of_vessel, Dimension::mass)),
      {"they are one ship: the block's mass moves, the vessel's must agree with it to 1 %"});
}

/// The draughts of a load that makes waves.
void check_draughts(const LiftCase& lift_case, Diagnostics& diagnostics) {
  const given::Load& load = lift_case.load;
  if (!load.draughts || !load.vessel) return;
  check_draughts("the load", *load.draughts, *load.vessel, diagnostics);
  for (const given::Vessel& vessel : lift_case.vessels) {
    if (vessel.draughts) {
      diagnostics.error(load.draughts->mark,
                        fmt::format("the load has draughts, as vessel {} has", vessel.name.value),
                        {"one body may be lowered into the water that they share"});
    }
    if (vessel.drift.value != DriftMethod::none && !vessel.database) {
      diagnostics.error(
          vessel.drift.mark,
          fmt::format("vessel {} drifts, and shares its water with the load, which has draughts",
                      vessel.name.value),
          {"the waves far away tell the drift of both together only: leave out one of the two"});
    }
    if (vessel.radiation.value == RadiationMethod::direct) {
      diagnostics.error(
          load.draughts->mark,
          fmt::format("the load has draughts, and the radiation of vessel {} is direct",
                      vessel.name.value),
          {"a surface that is marched has hulls of one draught: give the vessels "
           "radiation: database, or leave the load's draughts out"});
    }
  }
}

/// Vessels, sea and lines, and the lugs and the water of a load that is a vessel.
void check_afloat(const LiftCase& lift_case, Diagnostics& diagnostics) {
  std::vector<std::string> bodies = {"load"};
  for (const given::Crane& crane : lift_case.cranes) {
    if (!crane.model) continue;
    for (const std::string& part : parts_of(crane, true)) bodies.push_back(part);
  }
  check_marine_parts(lift_case, lift_case.gravity, bodies, diagnostics);
  if (lift_case.load.vessel_name && lift_case.load.model_name.value.empty() &&
      lift_case.dynamics.flexibility != Flexibility::rigid) {
    diagnostics.error(lift_case.load.vessel_name->mark,
                      "the load is a vessel, whose structure is not known; it cannot be flexible",
                      {"leave flexibility out, or give a block as the load"});
  }
  if (lift_case.load.vessel_name && !lift_case.sea) {
    diagnostics.error(lift_case.load.vessel_name->mark, "the load is a vessel, and there is no sea",
                      {"add sea: {} for calm deep sea water"});
  }
  check_weights(lift_case.load, diagnostics);
  check_draughts(lift_case, diagnostics);
  if (diagnostics.has_errors()) return;
  std::vector<PlacedHull> hulls = place_hulls(lift_case);
  if (lift_case.load.draughts) {
    std::vector<PlacedHull> afloat = hulls;
    afloat.push_back({"the load in the water", lift_case.load.draughts->mark,
                      &lift_case.load.vessel->hull, lift_case.load.pose_afloat()});
    check_hulls_apart(afloat, diagnostics);
    if (diagnostics.has_errors()) return;
  }
  if (lift_case.load.vessel) {
    hulls.push_back({"the load",
                     lift_case.load.vessel_name->mark,
                     &lift_case.load.vessel->hull,
                     {rotation_of(lift_case.load.attitude), lift_case.load.position}});
  }
  check_hulls_apart(hulls, diagnostics);
}

}  // namespace

void check_lift_case(const LiftCase& lift_case, Diagnostics& diagnostics) {
  check_kind_of_case(lift_case, diagnostics);
  check_names(lift_case, diagnostics);
  check_spreader_names(lift_case, diagnostics);
  for (const given::Crane& crane : lift_case.cranes)
    if (crane.model && !lift_case.load_table) check_start(crane, diagnostics);
  check_rigging(lift_case, diagnostics);
  check_afloat(lift_case, diagnostics);
  check_ground(lift_case, diagnostics);
  if (!lift_case.load_table) check_limits_hold_something(lift_case, diagnostics);
  check_comparison(lift_case, diagnostics);
  if (lift_case.load_table) check_load_table(lift_case, *lift_case.load_table, diagnostics);
  check_standard(lift_case, diagnostics);
  check_operation(lift_case, diagnostics);
}

void check_loops_at_start(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const given::Crane& crane : lift_case.cranes) {
    if (crane.model->loops.empty()) continue;
    try {
      pose_at_start(crane);
    } catch (const dynamics::SimulationError& error) {
      const Mark mark = crane.start.empty() ? crane.name.mark : crane.start.front().name.mark;
      diagnostics.error(mark, error.what());
    }
  }
}

}  // namespace blocklift::pipeline

#include "pipeline/checks/measure_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "pipeline/measures/chart_derating.h"
#include "pipeline/measures/spreader_measures.h"
#include "pipeline/measures/tackle_measures.h"

namespace blocklift::pipeline {

namespace {

/// Of the falls of a block that turns, where the case gives none, rad: there they turn it back
/// most.
constexpr double usual_falls_twist = std::numbers::pi / 2;

std::optional<double> value_of(const std::optional<Located<double>>& limit) {
  return limit ? std::optional(limit->value) : std::nullopt;
}

/// The furthest out among the measures of a kind.
struct Worst {
  const LiftMeasure* measure = nullptr;
  MeasurePeak peak;
};

class MeasureChecks {
 public:
  MeasureChecks(const LiftCase& lift_case, const LiftRun& lift,
                const std::vector<LiftMeasure>& measures)
      : case_(lift_case), lift_(lift), measures_(measures) {}

  std::vector<Check> list() {
    const CheckSettings& limits = case_.checks;
    add_at_most(
        "twist of falls", "twist of falls: largest of a hook block that turns",
        limits.largest_falls_twist ? value_of(limits.largest_falls_twist) : usual_falls_twist);
    add_at_most("tilt", "tilt: angle of the load against the plumb", limits.largest_tilt);
    add_at_most("turn", "turn: of the load about the plumb, away from its start",
                limits.largest_turn);
    add_at_least("sling angle", "angle of slings: smallest against the level",
                 limits.smallest_sling_angle);
    add_at_least("righting height", "righting height: how far the suspension is from tipping",
                 limits.smallest_righting_height);
    add_at_most("offlead", "offlead: largest angle in the plane of the radius",
                value_of(limits.largest_offlead));
    add_at_most("sidelead", "sidelead: largest angle across the plane of the radius",
                value_of(limits.largest_sidelead));
    add_at_least("clearance", "clearance: smallest distance", limits.smallest_clearance);
    add_ground();
    add_at_most("heel", "heel: largest of a vessel", value_of(limits.largest_heel));
    add_at_least("freeboard", "freeboard: lowest point of a deck over calm water",
                 value_of(limits.smallest_freeboard));
    for (const given::Spreader& bar : case_.spreaders) add_spreader(bar);
    add_tackles();
    for (const given::Tugger& line : case_.tuggers) add_line("tugger", line);
    for (const given::Mooring& line : case_.moorings) add_line("mooring", line);
    if (limits.crane_capacity) {
      add_charts();
      add_supports();
    }
    return std::move(checks_);
  }

 private:
  std::optional<Worst> worst_of(const std::string& kind) const {
    std::optional<Worst> worst;
    for (const LiftMeasure& measure : measures_) {
      if (measure.kind != kind) continue;
      const MeasurePeak peak = find_peak(lift_, measure);
      if (std::isnan(peak.value)) continue;
      const bool further = !worst || (measure.extreme == Extreme::smallest
                                          ? peak.value < worst->peak.value
                                          : std::abs(peak.value) > std::abs(worst->peak.value));
      if (further) worst = {&measure, peak};
    }
    return worst;
  }

  void note(const Worst& worst, Check check) {
    check.time = worst.peak.time;
    check.note = worst.measure->subject;
    checks_.push_back(std::move(check));
  }

  void add_at_most(const char* kind, const char* name, std::optional<double> limit) {
    if (!limit) return;
    if (const auto worst = worst_of(kind))
      note(*worst, check_at_most(name, std::abs(worst->peak.value), *limit, worst->measure->unit));
  }

  void add_at_least(const char* kind, const char* name, std::optional<double> limit) {
    if (!limit) return;
    if (const auto worst = worst_of(kind))
      note(*worst, check_at_least(name, worst->peak.value, *limit, worst->measure->unit));
  }

  /// A load that goes into the ground where nothing of the case bears it there.
  void add_ground() {
    constexpr double sunk = 0.1;  // m: pads and uneven ground
    const LiftMeasure* distance = find("load to ground", "clearance");
    if (!distance || case_.ground_contact) return;
    const MeasurePeak peak = find_peak(lift_, *distance);
    if (peak.value >= -sunk) return;
    Check check = check_at_most("ground: how far the load reaches below it, where nothing bears it",
                                -peak.value, sunk, "m");
    check.time = peak.time;
    check.note = fmt::format("ground at z = {:g} m", *case_.ground_height());
    checks_.push_back(std::move(check));
  }

  /// A bar against buckling by its compression alone, and with bending; of a frame the worst side.
  void add_spreader(const given::Spreader& bar) {
    const double factor = spreader_factor(case_.checks);
    const std::string subject = "spreader " + bar.name.value;
    for (const LiftMeasure& measure : measures_) {
      if (measure.subject != bar.name.value) continue;
      const MeasurePeak peak = find_peak(lift_, measure);
      Check check;
      if (measure.kind == "compression" && !bar.is_frame()) {
        check = check_at_most(
            fmt::format("{}: compression against buckling load / {:g}", subject, factor),
            std::max(0.0, peak.value), structure::buckling_resistance(bar.column()) / factor, "N");
        check.note = "EN 1993-1-1, 6.3.1.1";
      } else if (measure.kind == "share of the resistance") {
        check = check_at_most(fmt::format("{}: compression with bending{}, times {:g}", subject,
                                          bar.is_frame() ? " and torsion" : "", factor),
                              peak.value, 1, "1");
        check.note = bar.is_frame()
                         ? "EN 1993-1-1, 6.3.1.1 and 6.2.1(5), moments growing by 5.2.2(5)"
                         : "EN 1993-1-1, 6.3.1.1, moments growing by 5.2.2(5)";
      } else {
        continue;
      }
      check.time = peak.time;
      checks_.push_back(std::move(check));
    }
  }

  /// The single rope of each tackle against its breaking load, and the winch against its pull.
  void add_tackles() {
    const double factor = case_.checks.rope_safety_factor;
    for (const given::Crane& crane : case_.cranes) {
      for (const HoistModel& hoist : crane.model->hoists) {
        if (!hoist.reeving) continue;
        const std::string name = crane.name.value + "." + hoist.name.value;
        const std::string reeving = describe_reeving(*hoist.reeving);
        if (const LiftMeasure* load = find(name, "line load"))
          add_line(*load,
                   fmt::format("hoist rope {}: largest tension in its tackle against breaking load "
                               "/ {:g}",
                               name, factor),
                   hoist.line_breaking_load() / factor, reeving);
        const LiftMeasure* pull = find(name, "line pull");
        if (pull && hoist.reeving->line_pull)
          add_line(*pull, fmt::format("winch {}: pull on its line against what it may pull", name),
                   *hoist.reeving->line_pull, reeving);
      }
    }
  }

  /// A tugger or mooring against its breaking load, where that is given.
  template <class Line>
  void add_line(const std::string& kind, const Line& line) {
    const LiftMeasure* tension = find(line.name.value, kind + " tension");
    if (!tension || !line.breaking_load) return;
    const double factor = case_.checks.rope_safety_factor;
    add_line(
        *tension,
        fmt::format("{} {}: tension against breaking load / {:g}", kind, line.name.value, factor),
        *line.breaking_load / factor, "");
  }

  void add_line(const LiftMeasure& measure, std::string name, double limit,
                const std::string& reeving) {
    const MeasurePeak peak = find_peak(lift_, measure);
    Check check = check_at_most(std::move(name), peak.value, limit, "N");
    check.time = peak.time;
    check.note = reeving;
    checks_.push_back(std::move(check));
  }

  const LiftMeasure* find(const std::string& subject, const std::string& kind) const {
    for (const LiftMeasure& measure : measures_)
      if (measure.subject == subject && measure.kind == kind) return &measure;
    return nullptr;
  }

  void add_charts() {
    for (const LiftMeasure& measure : measures_) {
      if (measure.kind != "share of the chart") continue;
      const MeasurePeak peak = find_peak(lift_, measure);
      Check check =
          check_at_most("hoist " + measure.subject + ": load over the load chart at its radius",
                        peak.value, 1, "1");
      check.time = peak.time;
      check.note = "hook block included" + derating_of(measure.subject);
      if (!std::isfinite(peak.value))
        check.note = why_beyond_chart(measure.subject) + "; " + check.note;
      checks_.push_back(std::move(check));
    }
  }

  /// Why a chart allows nothing: the hook is further out than it goes, or wind or sea are beyond
  /// the tables that derate it.
  std::string why_beyond_chart(const std::string& hook) const {
    const std::size_t dot = hook.find('.');
    const CraneModel& crane = *case_.find_crane(hook.substr(0, dot))->model;
    if (!(find_chart_factor(crane, case_).value > 0))
      return "wind or sea are beyond the tables by which the chart is derated";
    return fmt::format("beyond the chart: the hook is out to {:.2f} m, the chart ends at {:g} m",
                       find_peak(lift_, *find(hook, "radius")).value,
                       crane.find_hoist(hook.substr(dot + 1))->load_chart->value.back().radius);
  }

  /// How the charts of the crane that has a hook are derated; empty where they are not.
  std::string derating_of(const std::string& hook) const {
    for (const given::Crane& crane : case_.cranes) {
      const std::string& name = crane.name.value;
      if (hook.compare(0, name.size() + 1, name + ".") != 0) continue;
      const ChartFactor derated = find_chart_factor(*crane.model, case_);
      return derated.text.empty() ? "" : ", chart " + derated.text;
    }
    return "";
  }

  /// Supports against what they bear; the least loaded of each crane must press.
  void add_supports() {
    for (const given::Crane& crane : case_.cranes) {
      if (!crane.model->stands_on) continue;
      std::optional<Worst> least;
      for (const CraneSupport& support : crane.model->stands_on->supports) {
        const std::string subject = crane.name.value + "." + support.name.value;
        for (const LiftMeasure& measure : measures_) {
          if (measure.kind != "support load" || measure.subject != subject) continue;
          add_support(support, measure);
          const MeasurePeak low = lowest(measure);
          if (!least || low.value < least->peak.value) least = {&measure, low};
        }
      }
      if (least)
        note(*least, check_at_least("crane " + crane.name.value +
                                        ": smallest load of a support, which must press",
                                    least->peak.value, 0, "N"));
    }
  }

  void add_support(const CraneSupport& support, const LiftMeasure& measure) {
    if (!support.capacity) return;
    const MeasurePeak peak = find_peak(lift_, measure);
    Check check = check_at_most("support " + measure.subject + ": load against capacity",
                                peak.value, *support.capacity, "N");
    check.time = peak.time;
    checks_.push_back(std::move(check));
  }

  MeasurePeak lowest(const LiftMeasure& measure) const {
    LiftMeasure other = measure;
    other.extreme = Extreme::smallest;
    return find_peak(lift_, other);
  }

  const LiftCase& case_;
  const LiftRun& lift_;
  const std::vector<LiftMeasure>& measures_;
  std::vector<Check> checks_;
};

}  // namespace

std::vector<Check> check_measures(const LiftCase& lift_case, const LiftRun& lift,
                                  const std::vector<LiftMeasure>& measures) {
  return MeasureChecks(lift_case, lift, measures).list();
}

}  // namespace blocklift::pipeline

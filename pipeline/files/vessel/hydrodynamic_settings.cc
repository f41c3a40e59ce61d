#include "pipeline/files/vessel/hydrodynamic_settings.h"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {
namespace {

void check_range(const FrequencyRange& range, Reading& reading, const Mark& mark) {
  // Of what could not be read nothing more is said.
  if (!std::isfinite(range.lowest) || !std::isfinite(range.highest)) return;
  if (range.count == 1 ? range.lowest == range.highest : range.lowest < range.highest) return;
  reading.error(mark,
                fmt::format("{} frequencies from {} rad/s to {} rad/s", range.count, range.lowest,
                            range.highest),
                {"the highest must lie above the lowest; a single one has both the same"});
}

Format<FrequencyRange> frequency_range_format() {
  const auto frequency = quantity(Dimension::angular_speed, Range::positive());
  Table<FrequencyRange> table("frequencies", "Angular frequencies at equal distances.");
  table
      .by_default("lowest", &FrequencyRange::lowest, frequency, "0.2 rad/s",
                  "its wave determines how far the water's surface is meshed, and how long the "
                  "impulse responses last")
      .by_default("highest", &FrequencyRange::highest, frequency, "1.6 rad/s",
                  "its wave must be at least three panels long")
      .by_default("count", &FrequencyRange::count, integer(Range::between(1, 1000)), "29",
                  "how many")
      .place(&FrequencyRange::place)
      .rule(check_range);
  return table.format();
}

void check_settings(const HydrodynamicSettings& settings, Reading& reading, const Mark& mark) {
  if (settings.as_meshed && !settings.draughts.empty()) {
    reading.error(mark, "the water line is given twice",
                  {"give draughts, or water_line: as meshed"});
  }
}

}  // namespace

std::vector<double> FrequencyRange::list() const {
  std::vector<double> values{lowest};
  for (int k = 1; k < count; ++k) {
    values.push_back(lowest + (highest - lowest) * k / static_cast<double>(count - 1));
  }
  return values;
}

std::vector<double> default_headings() {
  constexpr int count = 72;
  std::vector<double> headings;
  for (int k = 0; k < count; ++k) headings.push_back(2.0 * std::numbers::pi * k / count);
  return headings;
}

std::vector<dynamics::DampingLid> make_lids(const std::optional<std::vector<LidModel>>& models,
                                            const Eigen::Vector2d& origin) {
  std::vector<dynamics::DampingLid> lids;
  if (!models) return lids;
  for (const LidModel& model : *models) {
    const Eigen::Vector2d from(model.from[0], model.from[1]), to(model.to[0], model.to[1]);
    lids.push_back({from.cwiseMin(to) - origin, from.cwiseMax(to) - origin, model.rate});
  }
  return lids;
}

Format<LidModel> lid_format() {
  Table<LidModel> table(
      "lid",
      "A rectangle of the water's surface on which waves fade: a moonpool, or the "
      "gap between two hulls.");
  table
      .required("from", &LidModel::from, array_of<double, 2>(quantity(Dimension::length)),
                "one corner, level, in the world")
      .required("to", &LidModel::to, array_of<double, 2>(quantity(Dimension::length)),
                "the opposite corner")
      .required("rate", &LidModel::rate, quantity(Dimension::angular_speed, Range::positive()),
                "water that swings there by itself fades as exp(-rate t): its share of critical "
                "damping times its frequency")
      .rule([](const LidModel& lid, Reading& reading, const Mark& mark) {
        if (lid.from[0] != lid.to[0] && lid.from[1] != lid.to[1]) return;
        reading.error(mark, "a lid without an area", {"from and to are opposite corners"});
      });
  return table.format();
}

Format<dynamics::PanelMethod> panel_method_format() {
  return choice<dynamics::PanelMethod>({{"marched surface", dynamics::PanelMethod::marched_surface},
                                        {"green function", dynamics::PanelMethod::green_function}});
}

Format<std::vector<double>> draughts_format() {
  const Format<std::vector<double>> list =
      list_of(quantity(Dimension::length, Range::positive()), 1, 100);
  return {list.description,
          [list](const YAML::Node& node, Reading& reading, std::vector<double>& draughts) {
            if (!list.read(node, reading, draughts)) return false;
            for (std::size_t k = 1; k < draughts.size(); ++k) {
              if (draughts[k] > draughts[k - 1]) continue;
              reading.error(reading.mark_of(node[k]),
                            fmt::format("draught {} m follows {} m", draughts[k], draughts[k - 1]),
                            {"draughts must ascend"});
              return false;
            }
            return true;
          }};
}

Format<HydrodynamicSettings> hydrodynamic_settings_format() {
  Table<HydrodynamicSettings> table(
      "hydrodynamics", "What blocklift hydro computes: waves, water, panels, draughts.");
  table
      .by_default("frequencies", &HydrodynamicSettings::frequencies, frequency_range_format(), "{}",
                  "for which added mass, damping and excitation are given")
      .optional("headings", &HydrodynamicSettings::headings, list_of(quantity(Dimension::angle)),
                "directions in which the waves travel, from x towards y; every 5 degrees if left "
                "out")
      .optional("water_depth", &HydrodynamicSettings::water_depth,
                quantity(Dimension::length, Range::positive()), "deep water if left out")
      .by_default("water_density", &HydrodynamicSettings::water_density,
                  quantity(Dimension::density, Range::positive()), "1025 kg/m^3", "of the water")
      .by_default("method", &HydrodynamicSettings::method, panel_method_format(), "marched surface",
                  panel_method_purpose)
      .optional("panel_size", &HydrodynamicSettings::panel_size,
                quantity(Dimension::length, Range::positive()),
                "edge length of the panels; the vessel's own if left out")
      .optional(
          "draughts", &HydrodynamicSettings::draughts, draughts_format(),
          "upright, from the lowest point of the hull; several for a hull that is lowered into "
          "the water; afloat by its weight if left out")
      .by_default(
          "water_line", &HydrodynamicSettings::as_meshed,
          choice<bool>({{"by weight", false}, {"as meshed", true}}), "by weight",
          "as meshed: z = 0 of the hull's own frame; a mesh that ends there goes on upright "
          "above it by as much as it is deep")
      .by_default("mean_drift", &HydrodynamicSettings::mean_drift, boolean(), "false",
                  "compute mean drift forces of the hull that floats freely, from the waves it "
                  "sends far away; of a single vessel")
      .optional("lids", &HydrodynamicSettings::lids, list_of(lid_format()),
                "rectangles on which waves fade, for water in gaps and moonpools that would swing "
                "on: what the hulls radiate and scatter, not the waves that come in")
      .by_default("symmetry", &HydrodynamicSettings::symmetry, boolean(), "true",
                  "compute a half or a quarter where the hulls are symmetric in x = 0 or y = 0")
      .rule(check_settings);
  return table.format();
}

}  // namespace blocklift::pipeline

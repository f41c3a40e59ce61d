#include "pipeline/measurement/measured_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr char coordinates[] = "xyz";

std::string how_aligned(const AlignedRecord& record) {
  if (record.found) return "found";
  return record.is_given ? "given" : "not needed";
}

MeasuredTable clocks_table(const MeasuredLift& lift) {
  MeasuredTable table{"Clocks", {{"record"}, {"shift s", 5}, {"correlation", 3}, {"how"}}, {}};
  // To a millisecond however long ago a clock began: --shift takes it as it stands.
  for (const AlignedRecord& record : lift.records)
    table.rows.push_back({record.file, fmt::format("{:.3f}", record.shift),
                          record.found ? record.found->correlation : unknown, how_aligned(record)});
  return table;
}

/// Zero for what rounding leaves of a difference between quantities of a size.
double without_rounding(double difference, double size) {
  constexpr double rounding = 1e-9;
  return std::abs(difference) < rounding * size ? 0 : difference;
}

MeasuredTable differences_table(const MeasuredLift& lift) {
  MeasuredTable table{"Measured less computed",
                      {{"quantity"},
                       {"unit"},
                       {"mean", 4},
                       {"rms", 4},
                       {"peak", 4},
                       {"at s", 4},
                       {"corr.", 3},
                       {"scale", 4},
                       {"zero", 4}},
                      {}};
  for (const HeldChannel& channel : lift.channels) {
    if (!channel.agreement) continue;
    const Agreement& one = *channel.agreement;
    const auto [unit, factor] = shown_unit(channel.unit);
    const double size = std::max(std::abs(one.largest_measured), std::abs(one.largest_computed));
    const auto shown = [&, factor = factor](double difference) {
      return factor * without_rounding(difference, size);
    };
    table.rows.push_back({channel.name, unit, shown(one.mean_difference), shown(one.rms_difference),
                          shown(one.peak_difference), one.time_of_peak, one.correlation,
                          one.scale.value_or(unknown), one.scale ? shown(one.zero) : unknown});
  }
  return table;
}

MeasuredTable amplification_table(const MeasuredLift& lift) {
  MeasuredTable table{"Largest tensions, dynamic amplification, and shares",
                      {{"rope"},
                       {"measured kN", 4},
                       {"computed kN", 4},
                       {"DAF meas.", 3},
                       {"DAF comp.", 3},
                       {"share meas. %", 3},
                       {"share comp. %", 3}},
                      {}};
  for (const HeldChannel& channel : lift.channels) {
    if (channel.unit != "N" || !channel.agreement) continue;
    const Agreement& one = *channel.agreement;
    table.rows.push_back({channel.name, one.largest_measured / 1000, one.largest_computed / 1000,
                          one.measured_amplification(), one.computed_amplification(),
                          channel.sharing ? 100 * channel.sharing->measured : unknown,
                          channel.sharing ? 100 * channel.sharing->computed : unknown});
  }
  return table;
}

MeasuredTable decays_table(const MeasuredLift& lift) {
  MeasuredTable table{"Free oscillation: periods and damping, with standard deviations",
                      {{"quantity"},
                       {"period s", 4},
                       {"±", 2},
                       {"computed s", 4},
                       {"damping %", 3},
                       {"±", 2},
                       {"computed %", 3}},
                      {}};
  if (!lift.looked_for_decay) return table;
  for (const HeldChannel& channel : lift.channels) {
    const auto& ours = channel.measured_decay;
    const auto& theirs = channel.computed_decay;
    if (!ours && !theirs) continue;
    table.rows.push_back(
        {channel.name, ours ? ours->period : unknown, ours ? ours->period_deviation : unknown,
         theirs ? theirs->period : unknown, ours ? 100 * ours->damping_ratio : unknown,
         ours ? 100 * ours->damping_deviation : unknown,
         theirs ? 100 * theirs->damping_ratio : unknown});
  }
  return table;
}

/// A row whose figures have digits of their own, since the column has several units.
std::vector<TextTable::Cell> weight_row(const std::string& name, double measured, double deviation,
                                        double computed) {
  return {name, format_figure(measured, 5), format_figure(deviation, 2),
          format_figure(computed, 5)};
}

MeasuredTable weight_table(const MeasuredLift& lift) {
  MeasuredTable table{"Weight and centre of mass by the load cells, with standard deviations",
                      {{"figure"}, {"measured", 5}, {"±", 2}, {"computed with", 5}},
                      {}};
  if (!lift.weight) return table;
  const HeldWeight& weight = *lift.weight;
  const Weighing& ours = weight.measured;
  table.rows.push_back(weight_row("mass t", ours.mass / 1000, ours.mass_deviation / 1000,
                                  weight.computed_mass ? *weight.computed_mass / 1000 : unknown));
  const std::optional<Eigen::Index> open = ours.open_coordinate();
  for (const Eigen::Index k : {0, 1, 2}) {
    const double used = weight.computed_centre_B ? (*weight.computed_centre_B)[k] : unknown;
    std::string name = fmt::format("{} m", coordinates[k]);
    if (open && k != *open)
      name += fmt::format(" at {} = {:.3f} m", coordinates[*open], ours.centre_of_mass_B[*open]);
    table.rows.push_back(
        weight_row(name, ours.centre_of_mass_B[k], ours.centre_deviation[k], used));
    if (!ours.leaves_open(k)) continue;
    table.rows.back()[1] = std::string("open");
    table.rows.back()[2] = std::string();
  }
  return table;
}

MeasuredTable surroundings_table(const MeasuredLift& lift) {
  MeasuredTable table{"Wind and waves", {{"figure"}, {"measured", 3}, {"computed with", 3}}, {}};
  if (lift.wind) {
    table.rows.push_back(
        {std::string("mean wind m/s"), lift.wind->mean, lift.computed_wind.value_or(unknown)});
    table.rows.push_back({std::string("standard deviation m/s"), lift.wind->deviation});
    table.rows.push_back({std::string("largest mean over 3 s m/s"), lift.wind->gust});
  }
  if (lift.waves) {
    table.rows.push_back({std::string("significant height m"), lift.waves->significant_height,
                          lift.computed_wave_height.value_or(unknown)});
    table.rows.push_back({std::string("zero-crossing period s"),
                          lift.waves->zero_crossing_period.value_or(unknown)});
  }
  return table;
}

}  // namespace

std::vector<MeasuredTable> measured_tables(const MeasuredLift& lift) {
  std::vector<MeasuredTable> tables;
  for (MeasuredTable& table :
       std::vector{clocks_table(lift), differences_table(lift), amplification_table(lift),
                   decays_table(lift), weight_table(lift), surroundings_table(lift)})
    if (!table.rows.empty()) tables.push_back(std::move(table));
  return tables;
}

std::pair<std::string, double> shown_unit(const std::string& unit) {
  if (unit == "N") return {"kN", 1e-3};
  if (unit == "rad") return {"deg", 180 / std::numbers::pi};
  return {unit, 1};
}

std::string weighing_remark(const MeasuredLift& lift) {
  if (!lift.weight || !lift.weight->measured.open_direction_B) return {};
  const Weighing& ours = lift.weight->measured;
  const Eigen::Vector3d& along = *ours.open_direction_B;
  const Eigen::Vector3d& point = ours.centre_of_mass_B;
  const Eigen::Index open = *ours.open_coordinate();
  const std::string place = fmt::format("{} = {:.3f} m", coordinates[open], point[open]);
  return fmt::format(
      "The load keeps its attitude, so that {} of its centre of mass stays open: it lies on the "
      "line through ({:.3f}, {:.3f}, {:.3f}) m along ({:.3f}, {:.3f}, {:.3f}). The other two are "
      "those of the line at {}",
      coordinates[open], point.x(), point.y(), point.z(), along.x(), along.y(), along.z(),
      lift.weight->computed_centre_B
          ? "the computed " + place
          : place + ", its point nearest to the origin of the load's frame");
}

}  // namespace blocklift::pipeline

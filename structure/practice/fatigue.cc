#include "structure/practice/fatigue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

// Peaks and valleys, with the first and the last value.
std::vector<double> reversals(const Eigen::VectorXd& history) {
  std::vector<double> turns;
  for (const double value : history) {
    if (!turns.empty() && value == turns.back()) continue;
    if (turns.size() >= 2 && (value - turns.back()) * (turns.back() - turns[turns.size() - 2]) > 0)
      turns.back() = value;
    else
      turns.push_back(value);
  }
  return turns;
}

Cycles cycle(double a, double b, double count) { return {std::abs(a - b), (a + b) / 2, count}; }

// DNV-RP-C203 (2016), table 2-1, S-N curves in air: log10 of the constants a of N = a S^-m, S in
// MPa, and the thickness exponent k.
struct Tabulated {
  const char* name;
  double slope, log_constant, log_constant_beyond, thickness_exponent;
};
constexpr Tabulated in_air[] = {{"B1", 4, 15.117, 17.146, 0},    {"B2", 4, 14.885, 16.856, 0},
                                {"C", 3, 12.592, 16.320, 0.05},  {"C1", 3, 12.449, 16.081, 0.10},
                                {"C2", 3, 12.301, 15.835, 0.15}, {"D", 3, 12.164, 15.606, 0.20},
                                {"E", 3, 12.010, 15.350, 0.20},  {"F", 3, 11.855, 15.091, 0.25},
                                {"F1", 3, 11.699, 14.832, 0.25}, {"F3", 3, 11.546, 14.576, 0.25},
                                {"G", 3, 11.398, 14.330, 0.25},  {"W1", 3, 11.261, 14.101, 0.25},
                                {"W2", 3, 11.107, 13.845, 0.25}, {"W3", 3, 10.970, 13.617, 0.25}};
constexpr double class_cycles = 2e6;

}  // namespace

std::vector<Cycles> count_rainflow(const Eigen::VectorXd& history) {
  std::vector<Cycles> cycles;
  std::vector<double> open;  // reversals that are not counted yet
  for (const double turn : reversals(history)) {
    open.push_back(turn);
    while (open.size() >= 3) {
      const std::size_t n = open.size();
      const double x = std::abs(open[n - 1] - open[n - 2]);
      const double y = std::abs(open[n - 2] - open[n - 3]);
      if (x < y) break;
      if (n == 3) {  // Y holds the start: half a cycle
        cycles.push_back(cycle(open[0], open[1], 0.5));
        open.erase(open.begin());
      } else {
        cycles.push_back(cycle(open[n - 3], open[n - 2], 1));
        open.erase(open.end() - 3, open.end() - 1);
      }
    }
  }
  for (std::size_t i = 0; i + 1 < open.size(); ++i)
    cycles.push_back(cycle(open[i], open[i + 1], 0.5));
  return cycles;
}

std::vector<Cycles> count_rainflow_of_repeated(const Eigen::VectorXd& history) {
  if (history.size() == 0) return {};
  Eigen::Index start = 0;
  history.cwiseAbs().maxCoeff(&start);
  Eigen::VectorXd turned(history.size() + 1);
  turned << history.tail(history.size() - start), history.head(start + 1);
  // Begun and ended at its largest magnitude, every range is closed; two halves that are left over
  // of the largest range are one cycle.
  std::vector<Cycles> cycles = count_rainflow(turned), whole;
  for (const Cycles& c : cycles) {
    if (c.count == 0.5 && !whole.empty() && whole.back().count == 0.5 &&
        whole.back().range == c.range)
      whole.back().count = 1;
    else
      whole.push_back(c);
  }
  return whole;
}

double FatigueCurve::knee_range() const {
  return class_range * std::pow(class_cycles / knee_cycles, 1 / slope);
}

double FatigueCurve::thickness_factor(double thickness) const {
  return std::max(1.0, std::pow(thickness / reference_thickness, thickness_exponent));
}

double FatigueCurve::cycles_to_failure(double range) const {
  if (!(range > 0)) return std::numeric_limits<double>::infinity();
  const double ratio = knee_range() / range;
  return knee_cycles * std::pow(ratio, ratio > 1 ? slope_beyond : slope);
}

double damage(const std::vector<Cycles>& cycles, const FatigueCurve& curve) {
  double sum = 0;
  for (const Cycles& c : cycles) sum += c.count / curve.cycles_to_failure(c.range);
  return sum;
}

FatigueCurve fatigue_curve(const std::string& name) {
  for (const Tabulated& row : in_air) {
    if (name != row.name) continue;
    FatigueCurve curve;
    curve.name = name;
    curve.slope = row.slope;
    curve.class_range =
        1e6 * std::pow(10, (row.log_constant - std::log10(class_cycles)) / row.slope);
    curve.slope_beyond = 5;
    curve.thickness_exponent = row.thickness_exponent;
    // Where both lines meet: 10^7 cycles, to the digits of the table.
    const double knee = (row.log_constant_beyond - row.log_constant) / (5 - row.slope);
    curve.knee_cycles = std::pow(10, row.log_constant - row.slope * knee);
    curve.source = "DNV-RP-C203, table 2-1, in air";
    return curve;
  }
  std::string known;
  for (const std::string& one : fatigue_curve_names()) known += (known.empty() ? "" : ", ") + one;
  throw ModelError("there is no S-N curve \"" + name + "\"; there are " + known);
}

std::vector<std::string> fatigue_curve_names() {
  std::vector<std::string> names;
  for (const Tabulated& row : in_air) names.emplace_back(row.name);
  return names;
}

}  // namespace blocklift::structure

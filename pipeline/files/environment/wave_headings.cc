#include "pipeline/files/environment/wave_headings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::pipeline {
namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr double in_degrees = 360.0 / whole_turn;
constexpr double acceptable_gap = 15.0 / in_degrees;
constexpr double same_heading = 1e-6;  // rad

/// Two headings that follow each other, rad.
struct HeadingGap {
  double before, after;
  double size() const { return after - before; }
};

/// The headings of a database about the whole turn, between which waves may travel.
std::vector<HeadingGap> find_gaps(std::vector<double> headings) {
  for (double& heading : headings) heading -= whole_turn * std::floor(heading / whole_turn);
  std::sort(headings.begin(), headings.end());
  std::vector<HeadingGap> gaps;
  for (std::size_t h = 0; h < headings.size(); ++h) {
    const bool last = h + 1 == headings.size();
    gaps.push_back({headings[h], last ? headings.front() + whole_turn : headings[h + 1]});
  }
  return gaps;
}

bool lies_within(double direction, const HeadingGap& gap) {
  const double beyond =
      direction - gap.before - whole_turn * std::floor((direction - gap.before) / whole_turn);
  return beyond > same_heading && beyond < gap.size() - same_heading;
}

struct WaveDirections {
  std::vector<double> single;  ///< rad
  bool spread = false;         ///< about one of them
};

WaveDirections directions_of(const given::Waves& waves) {
  WaveDirections directions;
  if (waves.regular) {
    for (const given::RegularWave& wave : *waves.regular) directions.single.push_back(wave.heading);
  }
  if (waves.spectrum) {
    directions.single.push_back(waves.spectrum->heading);
    directions.spread = waves.spectrum->spreading.has_value();
  }
  if (waves.record) directions.single.push_back(waves.record->heading);
  return directions;
}

}  // namespace

std::string doubt_about_headings(const MarineParts& parts) {
  if (!parts.sea || !parts.sea->waves) return {};
  const WaveDirections directions = directions_of(*parts.sea->waves);
  const auto radiates = [](const given::Vessel& vessel) {
    return vessel.radiation.value != RadiationMethod::none;
  };
  const auto first = std::find_if(parts.vessels.begin(), parts.vessels.end(), radiates);
  if (first == parts.vessels.end() || !first->hydrodynamics) return {};
  // The database of a single vessel turns with it.
  const bool alone = std::count_if(parts.vessels.begin(), parts.vessels.end(), radiates) == 1;
  const double turned = alone ? first->heading : 0.0;
  for (const HeadingGap& gap : find_gaps(first->hydrodynamics->headings)) {
    if (gap.size() <= acceptable_gap + same_heading) continue;
    for (const double heading : directions.single) {
      if (!directions.spread && !lies_within(heading - turned, gap)) continue;
      return fmt::format(
          "Database {}: waves travel between its headings of {:.4g} and {:.4g} degrees, {:.4g} "
          "degrees apart. Their forces are interpolated between these and may be off by a fifth "
          "and in sign; compute it for headings no more than {:.0f} degrees apart.",
          first->database ? first->database->value : std::string(), in_degrees * gap.before,
          in_degrees * gap.after, in_degrees * gap.size(), in_degrees * acceptable_gap);
    }
  }
  return {};
}

}  // namespace blocklift::pipeline

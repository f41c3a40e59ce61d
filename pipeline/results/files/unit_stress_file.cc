#include "pipeline/results/files/unit_stress_file.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {

namespace {

constexpr std::size_t stress_components = 6;

struct UnitLoads {
  std::vector<std::string> names, units;

  void add(std::string name, const char* unit) {
    names.push_back(std::move(name));
    units.emplace_back(unit);
  }
};

/// The loads of the basis in the order of UnitResponses::coefficients.
UnitLoads unit_loads_of(const structure::UnitResponses& responses) {
  constexpr const char* axes[] = {"x", "y", "z"};
  UnitLoads loads;
  for (const structure::LiftingPoint& lug : responses.model().mesh().lifting_points)
    for (const char* axis : axes) loads.add(fmt::format("{} {}", lug.name, axis), "N");
  for (const char* pair : {"xx", "yy", "zz", "xy", "yz", "zx"})
    loads.add(fmt::format("angular velocity {}", pair), "rad2/s2");
  constexpr std::size_t accelerations = 6;
  const std::size_t added =
      static_cast<std::size_t>(responses.count()) - loads.names.size() - accelerations;
  for (std::size_t i = 0; i < added; ++i) loads.add(fmt::format("added {}", i + 1), "1");
  for (const char* axis : axes) loads.add(fmt::format("lacking acceleration {}", axis), "m/s2");
  for (const char* axis : axes)
    loads.add(fmt::format("lacking angular acceleration {}", axis), "rad/s2");
  return loads;
}

struct Place {
  std::string name;
  const structure::TimedExtreme* extreme = nullptr;
};

/// Places whose unit stress is known, each name once: the plates of a lug have their lug's name.
std::vector<Place> places_of(const HistoryState& state) {
  std::vector<Place> places;
  const auto add = [&](const std::string& name, const HistoryExtreme& extreme) {
    const bool is_there = std::any_of(places.begin(), places.end(),
                                      [&](const Place& place) { return place.name == name; });
    if (extreme.at.unit_stress.size() > 0 && !is_there) places.push_back({name, &extreme.at});
  };
  add("hot spot", state.checked_von_mises);
  for (const HistoryGroup& lug : state.lugs) add(lug.name, lug.checked_von_mises);
  for (const HistoryGroup& group : state.groups) add(group.name, group.checked_von_mises);
  return places;
}

}  // namespace

void write_unit_stress(ResultsWriter& file, const structure::UnitResponses& responses,
                       const HistoryAssessment& history) {
  const std::vector<Place> known = places_of(history.dynamic_state);
  if (known.empty()) return;
  const std::string whole = layout::join(layout::structure_group, layout::history);
  const std::string group = layout::join(whole, "unit_stress");
  const UnitLoads loads = unit_loads_of(responses);
  file.write_texts(layout::join(group, "loads"), loads.names,
                   "unit loads: forces at the pins of lugs, products of angular velocities and "
                   "added loads, each with the rigid acceleration that balances it; then the rigid "
                   "acceleration less gravity that the load of a sample lacks; block frame");
  file.write_texts(layout::join(group, "load_units"), loads.units, "units of the loads' factors");

  std::vector<std::string> names;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> stress;
  for (const Place& place : known) {
    names.push_back(place.name);
    points.push_back(place.extreme->point_B);
    const RowMajorMatrix by_component = place.extreme->unit_stress;
    stress.insert(stress.end(), by_component.data(), by_component.data() + by_component.size());
  }
  file.write_texts(
      layout::join(group, "places"), names,
      "places of the largest checked stress in motion: of the block, near each lug, of "
      "each group of plates");
  file.write_points(layout::join(group, "points"), points, {"m", "of the places, block frame"});
  file.write_array(layout::join(group, "stress"), stress,
                   std::vector<std::size_t>{names.size(), stress_components, loads.names.size()},
                   {"Pa",
                    "stress xx, yy, zz, xy, yz, zx of each place under each load with factor 1; of "
                    "plating the membrane stress in the plate's own axes 1 and 2 as x and y"});
  const auto write_factors = [&](std::string_view name, const HistoryState& state) {
    file.write_matrix(layout::join(whole, name, "factors"), state.factors.transpose(),
                      {"N, rad2/s2, 1, m/s2, rad/s2",
                       "factors of unit_stress/loads, a row a sample, a column a load"});
  };
  write_factors(layout::static_state, history.static_state);
  write_factors(layout::dynamic_state, history.dynamic_state);
}

}  // namespace blocklift::pipeline

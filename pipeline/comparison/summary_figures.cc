#include "pipeline/comparison/summary_figures.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "pipeline/comparison/lasting_modes.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

/// Keys by which the rows of a summary's lists are told apart.
constexpr std::array<const char*, 5> row_names = {"name", "lug", "plate", "rope", "instant"};

const Json* find_below(const Json& place, std::string_view path);

/// The place below `place` if its name is the first part of the path.
const Json* enter(const Json& place, std::string_view name, std::string_view path) {
  if (name.empty() || !path.starts_with(name)) return nullptr;
  if (path.size() == name.size()) return &place;
  return path[name.size()] == '.' ? find_below(place, path.substr(name.size() + 1)) : nullptr;
}

const Json* find_below(const Json& place, std::string_view path) {
  if (place.is_object()) {
    for (const auto& [key, value] : place.items())
      if (const Json* found = enter(value, key, path)) return found;
  } else if (place.is_array()) {
    for (const LastingMode& mode : lasting_modes(place))
      if (const Json* found = enter(*mode.row, mode.name, path)) return found;
    for (const Json& row : place) {
      for (const char* name : row_names) {
        if (!row.is_object() || !row.contains(name) || !row.at(name).is_string()) continue;
        if (const Json* found = enter(row, row.at(name).get<std::string>(), path)) return found;
      }
    }
  }
  return nullptr;
}

const UsualTolerance at_rest{
    0.005, 0, "equilibria are solved to 1e-10 of the weight: half a per cent is another lift"};
const UsualTolerance in_motion{
    0.01, 0, "the integration's own error is below a third of this: one per cent is another lift"};
const UsualTolerance ratio{0.015, 0, "as the loads that it is made of"};
const UsualTolerance local_stress{
    0.02, 0, "a local maximum: moves with the mesh and the plate edges by some per cent"};
const UsualTolerance deformation{0.02, 0,
                                 "an integral of the whole block: hardly moves with the mesh"};
const UsualTolerance increase{
    0, 1, "per cent; a ratio of two nearly equal states, so the mesh cancels: one point"};
const UsualTolerance mass{1e-6, 0, "what the input says"};
const UsualTolerance utilisation{0.02, 0, "moves with the load or the stress that it is made of"};
const UsualTolerance period{0.01, 0, "a mode of the equilibrium: one per cent is another lift"};

/// Adds those figures that the summary has, each once.
class FigureList {
 public:
  explicit FigureList(const Json& summary) : summary_(summary) {}

  void add(SummaryFigure figure) {
    const Json* found = find_figure(summary_, figure.path);
    if (!found || (!found->is_number() && !found->is_string())) return;
    if (paths_.insert(figure.path).second) figures_.push_back(std::move(figure));
  }
  std::vector<SummaryFigure> take() { return std::move(figures_); }

 private:
  const Json& summary_;
  std::set<std::string> paths_;
  std::vector<SummaryFigure> figures_;
};

/// Names of the rows of a list of the summary.
std::vector<std::string> names_in(const Json& summary, const std::string& path,
                                  const char* key = "name") {
  std::vector<std::string> names;
  const Json* list = find_figure(summary, path);
  if (!list || !list->is_array()) return names;
  for (const Json& row : *list)
    if (row.is_object() && row.contains(key) && row.at(key).is_string())
      names.push_back(row.at(key).get<std::string>());
  return names;
}

void add_loads(const Json& summary, FigureList& figures) {
  struct Things {
    const char* list;
    const char* group;
    const char* quantity;
  };
  constexpr std::array<Things, 3> all = {Things{"ropes", "rope loads", "tension_N"},
                                         Things{"hoists", "hoist loads", "tension_N"},
                                         Things{"cranes", "crane loads", "load_N"}};
  for (const Things& things : all) {
    for (const std::string& name : names_in(summary, things.list)) {
      const std::string row = fmt::format("{}.{}.", things.list, name);
      figures.add({row + "max_static_" + things.quantity, things.group, name + " at rest", "kN",
                   1e-3, at_rest});
      figures.add({row + "max_dynamic_" + things.quantity, things.group, name + " in motion", "kN",
                   1e-3, in_motion});
    }
  }
  for (const Things& things : all)
    for (const std::string& name : names_in(summary, things.list))
      figures.add({fmt::format("{}.{}.dynamic_over_static", things.list, name),
                   "in motion over at rest", name, "", 1, ratio});
}

void add_stress(FigureList& figures) {
  constexpr std::array<std::pair<const char*, const char*>, 3> ways = {
      std::pair{"history", "every instant"}, std::pair{"simultaneous", "largest rope load"},
      std::pair{"per_rope_maxima", "per-rope maxima"}};
  constexpr std::array<std::pair<const char*, const char*>, 2> states = {
      std::pair{"static", "at rest"}, std::pair{"dynamic", "in motion"}};
  const std::string group = "stress and deformation of the block";
  for (const auto& [way, said] : ways) {
    const std::string place = fmt::format("structure.{}.", way);
    for (const auto& [state, when] : states)
      figures.add({fmt::format("{}{}.checked_von_mises_Pa", place, state), group,
                   fmt::format("{}: stress {}", said, when), "MPa", 1e-6, local_stress});
    figures.add({place + "stress_increase_percent", group, fmt::format("{}: stress increase", said),
                 "%", 1, increase});
    for (const auto& [state, when] : states)
      figures.add({fmt::format("{}{}.max_displacement_m", place, state), group,
                   fmt::format("{}: deformation {}", said, when), "mm", 1e3, deformation});
    figures.add({place + "deformation_increase_percent", group,
                 fmt::format("{}: deformation increase", said), "%", 1, increase});
  }
  figures.add({"structure.mass.total_kg", group, "mass", "t", 1e-3, mass});
}

/// A check's name up to its colon, "rope R1" of "rope R1: tension against ...", where no other
/// check begins so.
std::string short_name_of_check(const std::string& name, const std::vector<std::string>& all) {
  const std::string beginning = name.substr(0, name.find(": "));
  const auto begins_so = [&](const std::string& other) {
    return other == beginning || other.starts_with(beginning + ": ");
  };
  return std::count_if(all.begin(), all.end(), begins_so) == 1 ? beginning : name;
}

void add_checks(const Json& summary, FigureList& figures) {
  const std::vector<std::string> names = names_in(summary, "checks");
  for (const std::string& name : names)
    figures.add({fmt::format("checks.{}.utilisation", name), "utilisation by checks",
                 short_name_of_check(name, names), "", 1, utilisation});
}

void add_periods(const Json& summary, FigureList& figures) {
  for (const std::string& instant : names_in(summary, "natural_periods", "instant")) {
    const std::string modes = fmt::format("natural_periods.{}.modes", instant);
    const Json* list = find_figure(summary, modes);
    if (!list) continue;
    for (const LastingMode& mode : lasting_modes(*list))
      if (mode.is_leading)
        figures.add({fmt::format("{}.{}.period_s", modes, mode.name),
                     fmt::format("natural periods, {}", instant), mode.name, "s", 1, period});
  }
}

}  // namespace

const Json* find_figure(const Json& summary, std::string_view path) {
  return path.empty() ? nullptr : find_below(summary, path);
}

std::vector<SummaryFigure> list_figures(const Json& summary) {
  FigureList figures(summary);
  figures.add({"verdict", "verdict", "verdict", "", 1, {0, 0, "whether the lift is safe"}});
  add_loads(summary, figures);
  add_stress(figures);
  add_checks(summary, figures);
  for (const std::string& name : names_in(summary, "standard.chains"))
    for (const auto& [key, by] : {std::pair{"standard_utilisation", "by its factors"},
                                  std::pair{"simulated_utilisation", "simulated"}})
      figures.add({fmt::format("standard.chains.{}.{}", name, key), "utilisation by the standard",
                   fmt::format("{}, {}", name, by), "", 1, utilisation});
  add_periods(summary, figures);
  return figures.take();
}

bool is_worse_when_smaller(const Json& summary, std::string_view path) {
  const std::size_t last_dot = path.rfind('.');
  if (last_dot == std::string_view::npos) return false;
  const Json* row = find_figure(summary, path.substr(0, last_dot));
  if (!row || !row->is_object()) return false;
  if (const auto extreme = row->find("extreme"); extreme != row->end())
    return *extreme == "smallest";
  if (path.substr(last_dot + 1) != "demand") return false;
  const auto number = [&](const char* key) {
    const auto found = row->find(key);
    return found != row->end() && found->is_number() ? found->get<double>()
                                                     : std::numeric_limits<double>::quiet_NaN();
  };
  // A check passes on one side of its limit: that side tells what it asks for.
  const auto pass = row->find("pass");
  if (pass == row->end() || !pass->is_boolean()) return false;
  return pass->get<bool>() ? number("demand") > number("limit")
                           : number("demand") < number("limit");
}

std::string_view unit_of_path(std::string_view path) {
  for (const std::string_view unit : {"percent", "N", "Nm", "Pa", "m", "s", "kg", "rad", "Hz", "J"})
    if (path.size() > unit.size() + 1 && path.ends_with(unit) &&
        path[path.size() - unit.size() - 1] == '_')
      return unit;
  return {};
}

std::string unit_of_figure(const Json& summary, std::string_view path) {
  if (const std::string_view unit = unit_of_path(path); !unit.empty()) return std::string(unit);
  const auto dot = path.rfind('.');
  if (dot == std::string_view::npos) return {};
  const Json* row = find_figure(summary, path.substr(0, dot));
  if (!row || !row->is_object()) return {};
  const auto found = row->find("unit");
  if (found == row->end() || !found->is_string() || *found == "1") return {};
  return found->get<std::string>();
}

}  // namespace blocklift::pipeline

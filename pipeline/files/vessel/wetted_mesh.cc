#include "pipeline/files/vessel/wetted_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "dynamics/marine/hull/hull_edges.h"
#include "dynamics/marine/hull/point_text.h"

namespace blocklift::pipeline {
namespace {

using dynamics::Hull;
using dynamics::HullEdges;
using dynamics::PanelAtEdge;
using dynamics::Vector3;

/// Of those edges at which the hull is open, for a hull that lies on one side of a plane that holds
/// them all: 0 of x = 0, 1 of y = 0.
/// @param open its edges, of any number.
std::optional<int> plane_of_half(const Hull& hull, const std::vector<std::array<int, 2>>& open) {
  const std::array<Vector3, 2> bounds = hull.bounds();
  const Vector3 &low = bounds[0], &high = bounds[1];
  const double tolerance = 1e-4 * (high - low).norm();
  if (open.empty()) return std::nullopt;
  for (const int axis : {1, 0}) {
    if (low[axis] < -tolerance && high[axis] > tolerance) continue;
    const auto in_plane = [&](const std::array<int, 2>& edge) {
      return std::abs(hull.vertex(edge[0])[axis]) < tolerance &&
             std::abs(hull.vertex(edge[1])[axis]) < tolerance;
    };
    if (std::all_of(open.begin(), open.end(), in_plane)) return axis;
  }
  return std::nullopt;
}

std::string words_about_half(int axis) {
  return fmt::format(
      "all its open edges lie in {0} = 0, and all of it on one side: it is the half of a hull; "
      "IS{1} 1 in line 3 of a .gdf mirrors it, any other mesh is to be made whole",
      axis == 0 ? "x" : "y", axis == 0 ? "X" : "Y");
}

/// @throws dynamics::ModelError if an edge that does not lie at the surface has but one panel.
template <class AtSurface>
void require_closed_below(const Hull& wetted, const HullEdges& edges, const AtSurface& at_surface) {
  std::vector<std::array<int, 2>> open;
  for (const auto& [edge, panels] : edges) {
    if (panels.size() == 1 && !(at_surface(edge[0]) && at_surface(edge[1]))) open.push_back(edge);
  }
  if (open.empty()) return;
  const std::optional<int> half = plane_of_half(wetted, open);
  throw dynamics::ModelError(fmt::format(
      "hull \"{}\", water_line: as meshed: the edge from {} to {} has no panel on its other side, "
      "and lies below the water line z = 0, where alone a mesh may end ({} such edges); {}",
      wetted.name(), dynamics::text_of_point(wetted.vertex(open.front()[0])),
      dynamics::text_of_point(wetted.vertex(open.front()[1])), open.size(),
      half ? words_about_half(*half)
           : std::string("add the panels that are missing, merge vertices, or place the mesh so "
                         "that it ends at z = 0")));
}

/// The edges of a panel that comes twice look as if panels were turned round.
/// @throws dynamics::ModelError naming the first such panel below the water line.
void require_each_once(const Hull& wetted, double tolerance) {
  const dynamics::HullDemands demands{.largest_warp = std::numeric_limits<double>::infinity(),
                                      .most_of_a_kind = wetted.panel_count()};
  std::vector<dynamics::HullDefect> defects = dynamics::diagnose(wetted, demands);
  std::erase_if(defects, [&](const dynamics::HullDefect& defect) {
    return defect.kind != dynamics::HullDefectKind::doubled_panel || defect.place.z() > -tolerance;
  });
  if (defects.empty()) return;
  const std::size_t more = defects.size() - 1;
  throw dynamics::ModelError(
      defects.front().message +
      (more > 0 ? fmt::format(" (and {} more of this kind)", more) : std::string()));
}

/// Lids would be put on both sides of panels that are turned round.
/// @throws dynamics::ModelError naming the first edge of such a panel.
void require_one_sense(const Hull& wetted, const HullEdges& edges) {
  const auto twisted = std::find_if(edges.begin(), edges.end(), [](const auto& edge) {
    return edge.second.size() == 2 && edge.second[0].is_forward == edge.second[1].is_forward;
  });
  if (twisted == edges.end()) return;
  const auto& [edge, panels] = *twisted;
  throw dynamics::ModelError(fmt::format(
      "hull \"{}\": the edge from {} to {} is run along in the same sense by panels {} and {}: "
      "one of the two is turned round; {}",
      wetted.name(), dynamics::text_of_point(wetted.vertex(edge[0])),
      dynamics::text_of_point(wetted.vertex(edge[1])), panels[0].panel, panels[1].panel,
      fmt::join(hints_on_mesh(wetted), "; ")));
}

}  // namespace

Hull with_freeboard(const Hull& wetted) {
  const std::array<Vector3, 2> bounds = wetted.bounds();
  const Vector3 &low = bounds[0], &high = bounds[1];
  const double tolerance = 1e-5 * (high - low).norm();
  if (high.z() > tolerance) return wetted;
  require_each_once(wetted, tolerance);
  Hull hull(wetted.name());
  for (const Vector3& vertex : wetted.vertices()) hull.add_vertex(vertex);
  const auto at_surface = [&](int vertex) { return wetted.vertex(vertex).z() > -tolerance; };
  const auto is_wet = [&](int k) {
    const std::span<const int> panel = wetted.panel(k);
    return !std::all_of(panel.begin(), panel.end(), at_surface);
  };
  HullEdges edges = find_edges(wetted);
  for (auto& [edge, panels] : edges)
    std::erase_if(panels, [&](const PanelAtEdge& at_edge) { return !is_wet(at_edge.panel); });
  require_closed_below(wetted, edges, at_surface);
  require_one_sense(wetted, edges);
  for (int k = 0; k < wetted.panel_count(); ++k)
    if (is_wet(k)) hull.add_panel(wetted.panel(k));
  std::map<int, int> raised;
  const auto raise = [&](int vertex) {
    const auto [known, is_new] = raised.try_emplace(vertex, 0);
    if (is_new) {
      const Vector3& p = wetted.vertex(vertex);
      known->second = hull.add_vertex({p.x(), p.y(), -low.z()});
    }
    return known->second;
  };
  std::set<std::pair<int, int>> rim;
  for (const auto& [edge, panels] : edges) {
    if (panels.size() != 1) continue;
    rim.insert(panels.front().is_forward ? std::pair(edge[0], edge[1])
                                         : std::pair(edge[1], edge[0]));
  }
  for (const auto& [from, to] : rim) hull.add_panel({to, from, raise(from), raise(to)});
  return with_lids(hull, tolerance);
}

std::vector<std::string> hints_on_mesh(const Hull& hull) {
  constexpr std::size_t most_named = 5;
  std::vector<std::array<int, 2>> open;
  std::vector<int> twisted(static_cast<std::size_t>(hull.panel_count()), 0);
  std::vector<int> sound = twisted;
  for (const auto& [edge, panels] : find_edges(hull)) {
    if (panels.size() == 1) open.push_back(edge);
    if (panels.size() != 2) continue;
    const bool is_twisted = panels[0].is_forward == panels[1].is_forward;
    for (const PanelAtEdge& at_edge : panels) ++(is_twisted ? twisted : sound)[at_edge.panel];
  }
  std::vector<std::string> hints;
  if (const std::optional<int> half = plane_of_half(hull, open))
    hints.push_back(words_about_half(*half));
  std::vector<int> turned;
  for (std::size_t k = 0; k < twisted.size(); ++k)
    if (twisted[k] > 0 && sound[k] == 0) turned.push_back(static_cast<int>(k));
  if (turned.empty()) return hints;
  const std::size_t count = turned.size();
  if (count > most_named) turned.resize(most_named);
  hints.push_back(fmt::format(
      "panel{} {}{} (counted from 0) {} turned round against all neighbours: reverse the order of "
      "{} vertices",
      count > 1 ? "s" : "", fmt::join(turned, ", "),
      count > most_named ? fmt::format(" and {} more", count - most_named) : std::string(),
      count > 1 ? "are" : "is", count > 1 ? "their" : "its"));
  return hints;
}

std::string doubt_about_size(const std::string& who, const Hull& hull) {
  constexpr double longest = 2000;  // m; the longest ship that was built has 458 m
  const std::array<Vector3, 2> bounds = hull.bounds();
  const Vector3 size = bounds[1] - bounds[0];
  if (!(size.maxCoeff() > longest)) return {};
  return fmt::format(
      "The hull of {} is {:.0f} x {:.0f} x {:.0f} m large: lengths of a mesh are metres, and the "
      "file may have millimetres (then {:.4g} m long).",
      who, size.x(), size.y(), size.z(), 1e-3 * size.maxCoeff());
}

std::string doubt_about_lightness(const std::string& who, const Hull& hull, double mass,
                                  double water_density) {
  constexpr double least = 0.005;  // an empty barge displaces about a tenth
  const double whole = water_density * calc_enclosed_volume(hull).volume;
  if (!(mass < least * whole)) return {};
  return fmt::format(
      "The mass of {} is {:.4g} t, where its hull up to the deck would displace {:.4g} t: the mass "
      "may be in kg where t is meant.",
      who, 1e-3 * mass, 1e-3 * whole);
}

}  // namespace blocklift::pipeline

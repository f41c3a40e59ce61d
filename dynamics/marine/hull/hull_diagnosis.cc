#include "dynamics/marine/hull/hull_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_edges.h"
#include "dynamics/marine/hull/point_text.h"

namespace blocklift::dynamics {

namespace {

// Collects defects, a few of each kind.
class Findings {
 public:
  Findings(const Hull& hull, int most) : hull_(hull), most_(most) {}

  void add(HullDefectKind kind, int panel, const Vector3& place, const std::string& what) {
    int& count = count_[kind];
    ++count;
    if (count > most_) return;
    std::string message = "hull \"" + hull_.name() + "\"";
    if (panel >= 0) message += ", panel " + std::to_string(panel);
    defects_.push_back({kind, panel, place, message + ": " + what});
  }
  bool has(HullDefectKind kind) const { return count_.contains(kind); }

  std::vector<HullDefect> take() {
    for (const auto& [kind, count] : count_) {
      if (count <= most_) continue;
      const auto last = std::find_if(defects_.rbegin(), defects_.rend(),
                                     [kind = kind](const HullDefect& d) { return d.kind == kind; });
      last->message += " (and " + std::to_string(count - most_) + " more of this kind)";
    }
    return std::move(defects_);
  }

 private:
  const Hull& hull_;
  int most_;
  std::map<HullDefectKind, int> count_;
  std::vector<HullDefect> defects_;
};

void check_vertices(const Hull& hull, Findings& findings) {
  for (std::size_t i = 0; i < hull.vertices().size(); ++i) {
    if (hull.vertices()[i].allFinite()) continue;
    findings.add(HullDefectKind::not_finite, -1, hull.vertices()[i],
                 "vertex " + std::to_string(i) + " is " + text_of_point(hull.vertices()[i]) +
                     "; three finite coordinates are due");
  }
  if (hull.panel_count() == 0) {
    findings.add(HullDefectKind::no_panels, -1, Vector3::Zero(), "it has no panels");
  }
}

// Rounding leaves an area of about 1e-16 of the squared diameter: 1e-10 tells a sliver from
// nothing.
bool is_degenerate(const Hull& hull, int panel) {
  constexpr double least_area = 1e-10;
  const std::span<const int> corners = hull.panel(panel);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (std::count(corners.begin(), corners.end(), corners[i]) > 1) return true;
  }
  const double diameter = hull.panel_diameter(panel);
  return !(hull.panel_area_vector(panel).norm() > least_area * diameter * diameter);
}

void check_shapes(const Hull& hull, double largest_warp, Findings& findings) {
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const Vector3 middle = hull.panel_midpoint(panel);
    if (is_degenerate(hull, panel)) {
      findings.add(HullDefectKind::degenerate_panel, panel, middle,
                   "it has no area, or a vertex twice, at " + text_of_point(middle) +
                       "; remove it, or merge the vertices that coincide");
      continue;
    }
    const Vector3 normal = hull.panel_area_vector(panel).normalized();
    double warp = 0.0;
    for (const int corner : hull.panel(panel)) {
      warp = std::max(warp, std::abs(normal.dot(hull.vertex(corner) - middle)));
    }
    const double relative = warp / hull.panel_diameter(panel);
    if (relative <= largest_warp) continue;
    std::ostringstream text;
    text << "its vertices lie up to " << warp << " m off its plane, " << 100.0 * relative
         << " % of its diameter, at " << text_of_point(middle) << "; divide it into triangles";
    findings.add(HullDefectKind::warped_panel, panel, middle, text.str());
  }
}

void check_doubled(const Hull& hull, Findings& findings) {
  std::map<std::vector<int>, int> first;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    std::vector<int> corners(hull.panel(panel).begin(), hull.panel(panel).end());
    std::sort(corners.begin(), corners.end());
    const auto [known, is_new] = first.emplace(std::move(corners), panel);
    if (is_new) continue;
    // Two that look away from each other, as the sides of a stem that a mirror plane holds.
    const bool opposite =
        hull.panel_area_vector(panel).dot(hull.panel_area_vector(known->second)) < 0.0;
    findings.add(HullDefectKind::doubled_panel, panel, hull.panel_midpoint(panel),
                 "it has the same vertices as panel " + std::to_string(known->second) + ", at " +
                     text_of_point(hull.panel_midpoint(panel)) +
                     (opposite ? ", and looks the other way: a wall without thickness, as a panel "
                                 "in a plane of symmetry and its image are; remove both"
                               : "; remove one of them"));
  }
}

void check_edges(const Hull& hull, Findings& findings) {
  for (const auto& [edge, panels] : find_edges(hull)) {
    const Vector3& a = hull.vertex(edge[0]);
    const Vector3& b = hull.vertex(edge[1]);
    const Vector3 middle = 0.5 * (a + b);
    const std::string where = "the edge from " + text_of_point(a) + " to " + text_of_point(b) + " ";
    const std::size_t count = panels.size();
    const auto forward = std::ranges::find_if(panels, &PanelAtEdge::is_forward);
    const int panel = forward == panels.end() ? panels.front().panel : forward->panel;
    if (count == 1) {
      findings.add(HullDefectKind::open_edge, panel, middle,
                   where +
                       "has no panel on its other side, so the hull is not closed; add the "
                       "missing panels, merge vertices, or close the opening by a lid");
    } else if (count > 2) {
      findings.add(HullDefectKind::crowded_edge, panel, middle,
                   where + "belongs to " + std::to_string(count) +
                       " panels; two are due. Remove inner walls and doubled panels");
    } else if (panels[0].is_forward == panels[1].is_forward) {
      findings.add(HullDefectKind::twisted_edge, panel, middle,
                   where + "is run along in the same sense by panel " +
                       std::to_string(panels[1].panel) +
                       ": one of the two is turned round; reverse the order of its vertices");
    }
  }
}

void check_orientation(const Hull& hull, Findings& findings) {
  const EnclosedVolume enclosed = calc_enclosed_volume(hull);
  if (enclosed.volume > 0.0) return;
  findings.add(HullDefectKind::inward, -1, enclosed.centre,
               "it encloses the volume " + std::to_string(enclosed.volume) +
                   " m3: its normals point into the body. Reverse the order of the vertices of "
                   "all panels: counter-clockwise seen from the water");
}

void check_water_level(const Hull& hull, double level, Findings& findings) {
  const auto box = hull.bounds();
  std::ostringstream range;
  range << "it reaches from z = " << box[0].z() << " m to " << box[1].z()
        << " m, and the water stands at z = " << level << " m: ";
  if (box[0].z() >= level) {
    findings.add(HullDefectKind::above_water, -1, box[0],
                 range.str() + "all panels are above the water line; lower the hull");
  } else if (box[1].z() <= level) {
    findings.add(HullDefectKind::below_water, -1, box[1],
                 range.str() + "nothing is above the water line; give the hull up to its deck");
  }
}

void check_panel_sizes(const Hull& hull, const HullDemands& demands, Findings& findings) {
  const double largest = *demands.shortest_wave_length / demands.panels_per_wave_length;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const std::span<const int> corners = hull.panel(panel);
    const bool dry = demands.water_level && std::ranges::all_of(corners, [&](int corner) {
                       return hull.vertex(corner).z() >= *demands.water_level;
                     });
    if (dry) continue;
    double edge = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      edge = std::max(
          edge, (hull.vertex(corners[i]) - hull.vertex(corners[(i + 1) % corners.size()])).norm());
    }
    if (edge <= largest) continue;
    std::ostringstream text;
    text << "its longest edge is " << edge << " m, at " << text_of_point(hull.panel_midpoint(panel))
         << "; the shortest wave of " << *demands.shortest_wave_length << " m needs panels of at "
         << "most " << largest << " m (" << demands.panels_per_wave_length
         << " a wave length). Refine the hull or leave out waves so short";
    findings.add(HullDefectKind::large_panel, panel, hull.panel_midpoint(panel), text.str());
  }
}

}  // namespace

std::vector<HullDefect> diagnose(const Hull& hull, const HullDemands& demands) {
  Findings findings(hull, demands.most_of_a_kind);
  check_vertices(hull, findings);
  if (findings.has(HullDefectKind::not_finite) || hull.panel_count() == 0) return findings.take();
  check_shapes(hull, demands.largest_warp, findings);
  check_doubled(hull, findings);
  check_edges(hull, findings);
  const bool closed = !findings.has(HullDefectKind::open_edge) &&
                      !findings.has(HullDefectKind::crowded_edge) &&
                      !findings.has(HullDefectKind::twisted_edge);
  if (closed) check_orientation(hull, findings);
  if (demands.water_level) check_water_level(hull, *demands.water_level, findings);
  if (demands.shortest_wave_length) check_panel_sizes(hull, demands, findings);
  return findings.take();
}

void require_sound(const Hull& hull, const HullDemands& demands) {
  const std::vector<HullDefect> defects = diagnose(hull, demands);
  if (defects.empty()) return;
  std::string messages;
  for (const HullDefect& defect : defects) {
    messages += (messages.empty() ? "" : "\n") + defect.message;
  }
  throw ModelError(messages);
}

}  // namespace blocklift::dynamics

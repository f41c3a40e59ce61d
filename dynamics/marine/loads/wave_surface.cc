#include "dynamics/marine/loads/wave_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/marine/hull/hull_faces.h"

namespace blocklift::dynamics {
namespace {

// Three points on each of two triangles against about one point for each panel of the same area:
// faces pay from here on.
constexpr double least_face_length = 3.0;  // diameters of a panel
// A polygon that is longer was joined of several panels.
constexpr double longest_panel = 1.5;  // diameters of a panel in the mean

constexpr std::size_t points_of_face = 3;

WaveSurface::Part make_part(TriangleTree tree, const WaveField& waves, double tolerance,
                            std::size_t per_triangle) {
  PressureBoxes boxes(tree, waves, tolerance, per_triangle);
  return {std::move(tree), std::move(boxes)};
}

/// Share of the waves' pressure that may be left out in boxes of panels of this diameter (m).
double find_panel_tolerance(const WaveField& waves, double diameter) {
  if (!waves.has_many_components()) return WaveSurface::box_tolerance;
  double error = 0.0, energy = 0.0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    const double share = std::min(1.0, std::pow(waves.wave_number(c) * diameter, 2) / 8.0);
    error += std::pow(waves.component(c).amplitude * share, 2);
    energy += std::pow(waves.component(c).amplitude, 2);
  }
  if (energy == 0.0) return WaveSurface::box_tolerance;
  return std::max(WaveSurface::box_tolerance, WaveSurface::box_share * std::sqrt(error / energy));
}

double mean_panel_diameter(const Hull& hull) {
  double sum = 0.0;
  for (int panel = 0; panel < hull.panel_count(); ++panel) sum += hull.panel_diameter(panel);
  return sum / hull.panel_count();
}

SurfaceRange range_about(const Hull& hull, const WaveField& waves) {
  Vector3 low = hull.vertex(0), high = low;
  for (const Vector3& vertex : hull.vertices()) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return {0.5 * (low + high), 0.5 * (high - low), waves};
}

void add_panel(const Hull& from, int panel, Hull& to) {
  std::vector<int> corners;
  for (const int vertex : from.panel(panel)) corners.push_back(to.add_vertex(from.vertex(vertex)));
  to.add_panel(corners);
}

}  // namespace

double calc_sagging_length(const WaveField& waves, double sag) {
  double energy = 0.0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    energy += std::pow(waves.component(c).amplitude, 2);
  }
  if (energy == 0.0) return std::numeric_limits<double>::infinity();
  const auto mean_square_at = [&](double length) {
    double sum = 0.0;
    for (std::size_t c = 0; c < waves.component_count(); ++c) {
      const double share = std::min(1.0, std::pow(waves.wave_number(c) * length, 2) / 8.0);
      sum += std::pow(waves.component(c).amplitude * share, 2);
    }
    return sum / energy;
  };
  // At this length even the longest wave has sagged by as much.
  double longest = 0.0;
  for (std::size_t c = 0; c < waves.component_count(); ++c) {
    longest = std::max(longest, std::sqrt(8.0 * sag) / waves.wave_number(c));
  }
  double low = 0.0;
  double high = longest;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (mean_square_at(middle) <= sag * sag ? low : high) = middle;
  }
  return low;
}

WaveSurface::WaveSurface(const Hull& hull, const WaveField& waves)
    : range_(range_about(hull, waves)) {
  const double diameter = mean_panel_diameter(hull);
  const double tolerance = find_panel_tolerance(waves, diameter);
  const double length = calc_sagging_length(waves, face_sag);
  if (length < least_face_length * diameter) {
    panels_ = make_part(TriangleTree(hull), waves, tolerance, 0);
    return;
  }
  const Hull joined = join_flat_panels(hull);
  Hull small, large;
  for (int panel = 0; panel < joined.panel_count(); ++panel) {
    const bool is_panel = joined.panel_diameter(panel) <= longest_panel * diameter;
    add_panel(joined, panel, is_panel ? small : large);
  }
  if (small.panel_count() > 0) panels_ = make_part(TriangleTree(small), waves, tolerance, 0);
  if (large.panel_count() > 0) {
    const Hull faces = divide_flat_panels(large, length);
    faces_ = make_part(TriangleTree(faces, faces_in_leaf), waves, box_tolerance, points_of_face);
  }
}

}  // namespace blocklift::dynamics

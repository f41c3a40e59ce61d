#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/frequency_domain.h"
#include "dynamics/marine/radiation/incident_wave.h"
#include "dynamics/marine/radiation/mean_drift.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

using Complex = std::complex<double>;

/// Of the beach for a column of radius and draught 1 that is held in a wave along x; density and
/// gravity 1, deep water.
constexpr double beach_strength = 0.5;

PanelModel make_held_column(int meridians) {
  const int parallels = 3 * meridians / 8;
  const std::vector<WettedBody> bodies{
      {"column",
       make_vertical_cylinder(
           1.0, 1.0, true,
           {.meridians = meridians, .parallels = parallels, .grading = 4.0, .graded_edge = true}),
       Vector3::Zero()}};
  const SurfaceMesh surface = make_surface_mesh(
      find_water_lines(bodies), {.first_ring = 1.92 / meridians, .growth = 1.08, .radius = 40.0});
  return {bodies, surface, {1.0, 1.0}, {true, true}};
}

struct ValueAtPanel {
  Vector3 centroid;
  Complex potential;
};

/// Potential of the incident and the scattered wave at all panels of the column.
std::vector<ValueAtPanel> calc_potentials(const PanelModel& model, double w) {
  const IncidentWave wave(model.water(), w, 0.0);
  RankineSettings rankine;
  rankine.keep_factors = true;
  const std::vector<Panel>& panels = model.body_mesh().panels;
  const int images = model.symmetry().image_count();
  std::vector<ValueAtPanel> values;
  for (int g = 0; g < images; ++g) {
    for (const Panel& panel : panels) {
      const Vector3 p = model.symmetry().reflect(g, panel.centroid);
      values.push_back({p, wave.potential(p)});
    }
  }
  for (const Parity& parity : model.parities()) {
    if (parity.y < 0) continue;  // the wave is even
    const RankinePart part(model, parity, rankine);
    const FrequencyDomain flow(model, part, DampingZone{beach_strength}.rates(model.surface()));
    const Eigen::VectorXcd opposed =
        model.part_of(parity, [&](const Vector3& p, const Vector3& n) -> Complex {
          return -(wave.velocity(p).transpose() * n)(0);
        });
    const Eigen::VectorXcd scattered = flow.calc_body_potentials(w, opposed);
    for (int g = 0; g < images; ++g) {
      for (std::size_t k = 0; k < panels.size(); ++k) {
        values[static_cast<std::size_t>(g) * panels.size() + k].potential +=
            static_cast<double>(model.sign(parity, g)) * scattered[static_cast<Eigen::Index>(k)];
      }
    }
  }
  return values;
}

/// The side of the column as rings from the water line down, each as its harmonics round the axis:
/// phi = sum a_m cos(m t), even in the wave's direction.
struct SideRing {
  double z;
  Eigen::VectorXcd harmonics;
};

std::vector<SideRing> rings_of_side(std::vector<ValueAtPanel> values, int meridians) {
  // The sides of the polygon lie within the circle, the bottom's panels further in.
  std::erase_if(values, [](const ValueAtPanel& v) { return v.centroid.z() < -1.0 + 1e-9; });
  std::sort(values.begin(), values.end(), [](const ValueAtPanel& a, const ValueAtPanel& b) {
    return a.centroid.z() > b.centroid.z();
  });
  std::vector<SideRing> rings;
  const int highest = meridians / 4;
  for (std::size_t first = 0; first < values.size(); first += static_cast<std::size_t>(meridians)) {
    SideRing ring{values[first].centroid.z(), Eigen::VectorXcd::Zero(highest + 1)};
    for (std::size_t k = first; k < first + static_cast<std::size_t>(meridians); ++k) {
      const double t = std::atan2(values[k].centroid.y(), values[k].centroid.x());
      for (int m = 0; m <= highest; ++m) {
        ring.harmonics[m] +=
            (m == 0 ? 1.0 : 2.0) / meridians * std::cos(m * t) * values[k].potential;
      }
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// Mean over a turn of conj(a) b cos t, of two sums of cosines; with sines in place of them where
/// `sines`. Real part.
double mean_along_x(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b, bool sines) {
  double sum = 0.0;
  for (Eigen::Index m = 0; m + 1 < a.size(); ++m) {
    const double weight = (m == 0 ? (sines ? 0.0 : 0.5) : 0.25);
    sum += weight * (std::conj(a[m]) * b[m + 1] + std::conj(a[m + 1]) * b[m]).real();
  }
  return sum;
}

/// A parabola through the values at three rings: its value and slope at z.
struct AtHeight {
  Eigen::VectorXcd value, slope;
};
AtHeight interpolate(const std::vector<SideRing>& rings, std::size_t middle, double z) {
  AtHeight at{Eigen::VectorXcd::Zero(rings[0].harmonics.size()),
              Eigen::VectorXcd::Zero(rings[0].harmonics.size())};
  for (std::size_t i = middle - 1; i <= middle + 1; ++i) {
    double value = 1.0, slope = 0.0;
    for (std::size_t j = middle - 1; j <= middle + 1; ++j) {
      if (j == i) continue;
      const double span = rings[i].z - rings[j].z;
      slope = slope * (z - rings[j].z) / span + value / span;
      value *= (z - rings[j].z) / span;
    }
    at.value += value * rings[i].harmonics;
    at.slope += slope * rings[i].harmonics;
  }
  return at;
}

// Pressure on the side of a body that is held, to the second order (Pinkster 1979), n into the
// water:
//   F = rho/2 int mean |grad phi|^2 n dS - rho g/2 line integral of mean eta^2 n dl.
double calc_near_field_force(const PanelModel& model, int meridians, double w) {
  const std::vector<SideRing> rings = rings_of_side(calc_potentials(model, w), meridians);
  double force = 0.0;
  double top = 0.0;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const double bottom = 2.0 * rings[k].z - top;
    const AtHeight at =
        interpolate(rings, std::clamp<std::size_t>(k, 1, rings.size() - 2), rings[k].z);
    Eigen::VectorXcd around = rings[k].harmonics;
    for (Eigen::Index m = 0; m < around.size(); ++m) around[m] *= static_cast<double>(m);
    const double squares =
        mean_along_x(at.slope, at.slope, false) + mean_along_x(around, around, true);
    force += 0.25 * squares * 2.0 * std::numbers::pi * (top - bottom);
    top = bottom;
  }
  const Eigen::VectorXcd elevation = Complex(0.0, -w) * interpolate(rings, 1, 0.0).value;
  return force - 0.25 * mean_along_x(elevation, elevation, false) * 2.0 * std::numbers::pi;
}

double calc_far_field_force(const PanelModel& model, double w) {
  DatabaseSettings settings;
  settings.frequencies = {w};
  settings.headings = {0.0};
  settings.duration = 60.0;
  settings.damping_strength = beach_strength;
  settings.with_far_field = true;
  return calc_mean_drift(compute_database(model, settings), {})[0](surge, 0);
}

// Second order in the panels; what the edge at the bottom makes of the velocity there is left.
std::vector<VerificationRow> near_field_rows() {
  std::vector<VerificationRow> rows;
  for (const double k : {0.6, 1.0, 1.5}) {
    const double w = std::sqrt(k);
    std::array<double, 2> near{};
    double far = 0.0;
    for (const int fine : {0, 1}) {
      const int meridians = fine == 0 ? 24 : 40;
      const PanelModel model = make_held_column(meridians);
      near.at(static_cast<std::size_t>(fine)) = calc_near_field_force(model, meridians, w);
      if (fine == 1) far = calc_far_field_force(model, w);
    }
    rows.push_back(compare(fmt::format("held column, mean force / (rho g a^2 R), k R {:.1f}: "
                                       "pressure against momentum far away",
                                       k),
                           "1", far, near[1], 0.04 * far));
    rows.push_back(bound(fmt::format("k R {:.1f}: difference of 40 meridians over that of 24", k),
                         "1", std::abs(near[1] - far) / std::abs(near[0] - far), 1.0));
  }
  return rows;
}

}  // namespace

VerificationCase near_field_drift() {
  return {.name = "near-field-drift",
          .stage = "hydrodynamics",
          .source = "Maruo (1960) against Pinkster (1979)",
          .compute = near_field_rows};
}

}  // namespace blocklift::pipeline

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/models/resonance.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

/// A broad ring about a narrow pool: radius of the pool 1 m.
constexpr double ring_radius = 10.0, ring_draught = 2.0, pool_gravity = 9.80665;

/// Water that swings by itself: Re exp((i frequency - rate) t).
struct Swing {
  double frequency = 0.0, rate = 0.0;  ///< rad/s
  int panels = 0;
};

Swing swing_of(const HydrodynamicDatabase& database) {
  std::vector<double> frequencies;
  std::vector<std::complex<double>> masses;
  for (std::size_t k = 1; k < database.frequencies.size();
       ++k) {  // the first is the march's lowest
    frequencies.push_back(database.frequencies[k]);
    masses.emplace_back(database.added_mass[k](heave, heave),
                        -database.damping[k](heave, heave) / frequencies.back());
  }
  const std::complex<double> found = dynamics::examples::find_resonance(frequencies, masses);
  return {found.real(), found.imag(), 0};
}

Swing compute_swing(int meridians, double lid_rate) {
  const Water water{1000.0, pool_gravity};
  const std::vector<WettedBody> bodies{
      {"ring",
       make_ring(ring_radius, 1.0, ring_draught,
                 {.meridians = meridians, .parallels = meridians / 6, .grading = 4.0}),
       Vector3::Zero()}};
  DatabaseSettings settings;
  settings.frequencies = {0.9};
  for (int k = 0; k <= 12; ++k) settings.frequencies.push_back(1.76 + 0.02 * k);
  settings.duration = 200.0;
  if (lid_rate > 0.0) settings.lids = {{{-1.2, -1.2}, {1.2, 1.2}, lid_rate}};
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double w) { return 2.0 * std::numbers::pi / calc_wave_number(w, water); };
  const SurfaceMesh surface =
      make_surface_mesh(lines, surface_settings(lines, length(settings.frequencies.back()),
                                                length(settings.frequencies.front())));
  const PanelModel model(bodies, surface, water, {true, true});
  const HydrodynamicDatabase database = compute_database(model, settings);
  Swing swing = swing_of(database);
  swing.panels = 4 * (model.body_mesh().size() + model.surface_mesh().size());
  return swing;
}

// Water in a narrow pool swings as in a pipe with a flange: its length is the draught and an end
// correction of 0.8217 radii (Norris and Sheng 1989; 8/(3 pi) if the flow in the mouth is even,
// Rayleigh, and Molin 2001). A flange that ends at R, with a potential that vanishes beyond (as
// Molin, Zhang, Huang and Remy 2018 take it, too), leaves a^2/(pi R) less: by inversion in the
// sphere of radius R that follows from a disc's capacity. What waves outside and the height of the
// ring's edge do besides is of the next order in a/R.
std::vector<VerificationRow> moonpool_rows() {
  const double length = ring_draught + 0.8217 - 1.0 / (std::numbers::pi * ring_radius);
  const double frequency = std::sqrt(pool_gravity / length);
  constexpr double gentle = 0.04, strong = 0.1;
  std::vector<VerificationRow> rows;
  const Swing coarse = compute_swing(24, gentle), middle = compute_swing(36, gentle),
              fine = compute_swing(48, gentle), damped = compute_swing(48, strong);
  for (const Swing& swing : {middle, fine}) {
    rows.push_back(compare(fmt::format("piston mode of a moonpool, {} panels", swing.panels),
                           "rad/s", frequency, swing.frequency, 0.01 * frequency,
                           "pipe with a flange: Norris and Sheng (1989)"));
  }
  // Panels are 1/24, 1/36 and 1/48 of the way around: at second order the ratio is 2.86.
  rows.push_back(
      compare("frequency, change from 24 to 36 panels around over that to 48", "1", 2.86,
              (coarse.frequency - middle.frequency) / (middle.frequency - fine.frequency), 0.6,
              "second order: panels of constant strength, midpoints"));
  const double step_ratio = 36.0 * 36.0 / (48.0 * 48.0 - 36.0 * 36.0);
  rows.push_back(compare("frequency, carried on to panels of no size", "rad/s", frequency,
                         fine.frequency - step_ratio * (middle.frequency - fine.frequency),
                         3e-3 * frequency, "pipe with a flange: Norris and Sheng (1989)"));
  rows.push_back(compare(fmt::format("piston mode under a lid of {} 1/s", strong), "rad/s",
                         fine.frequency, damped.frequency, 0.005 * fine.frequency,
                         "a lid leaves the natural frequency as it is"));
  rows.push_back(
      compare(fmt::format("rate of fading, lid of {} less that of {} 1/s", strong, gentle), "1/s",
              strong - gentle, damped.rate - fine.rate, 0.03 * (strong - gentle), "exp(-rate t)"));
  return rows;
}

}  // namespace

VerificationCase moonpool() {
  return {.name = "moonpool",
          .stage = "hydrodynamics",
          .source = "Molin (2001), J. Fluid Mech. 430; Norris and Sheng (1989)",
          .compute = moonpool_rows};
}

}  // namespace blocklift::pipeline

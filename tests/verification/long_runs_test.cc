#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {
namespace {

/// Added mass, and damping over the frequency; kg, or over rho a^3.
struct Force {
  double frequency;  ///< rad/s
  double mass, damping;
};

double error_of(const HydrodynamicDatabase& database, std::size_t k, int mode, const Force& exact) {
  return std::hypot(database.added_mass[k](mode, mode) - exact.mass,
                    database.damping[k](mode, mode) / exact.frequency - exact.damping) /
         std::hypot(exact.mass, exact.damping);
}

/// The database of a body that is symmetric in both planes, its surface meshed for these
/// frequencies.
HydrodynamicDatabase compute(const PanelMesh& hull, const Water& water,
                             std::vector<double> frequencies) {
  const std::vector<WettedBody> bodies{{"body", hull, Vector3::Zero()}};
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double w) { return 2.0 * std::numbers::pi / calc_wave_number(w, water); };
  const SurfaceMesh surface = make_surface_mesh(
      lines, surface_settings(lines, length(frequencies.back()), length(frequencies.front())));
  DatabaseSettings settings;
  settings.frequencies = std::move(frequencies);
  return compute_database({bodies, surface, water, {true, true}}, settings);
}

/// Frequencies from `lowest` up to those of the table, of which the first is `first`.
std::vector<double> frequencies_from(double lowest, double first) {
  std::vector<double> frequencies;
  for (double w = lowest; w < 0.95 * first; w *= 1.5) frequencies.push_back(w);
  return frequencies;
}

// A cube of 10 m, 5 m deep in 20 m of water. WAMIT 7 with 2,304 panels, as WEC-Sim's developers
// published it (file cubes.1 of their examples for BEMIO): sway of the second cube, which the other
// one, 100 m away across, hardly feels. Density 1,000 kg/m3.
constexpr std::array<Force, 5> cube_in_surge = {{{0.3, 336.771e3, 2.3017e3},
                                                 {0.6, 369.215e3, 15.1456e3},
                                                 {1.2, 413.531e3, 250.447e3},
                                                 {1.5, 230.151e3, 317.793e3},
                                                 {1.8, 110.305e3, 253.584e3}}};
constexpr std::array<Force, 2> cube_in_heave = {
    {{1.5, 289.542e3, 20.8374e3}, {1.8, 301.240e3, 6.53494e3}}};

HydrodynamicDatabase compute_cube(double lowest) {
  std::vector<double> frequencies = frequencies_from(lowest, cube_in_surge[0].frequency);
  for (const Force& row : cube_in_surge) {
    if (row.frequency > 0.99 * lowest) frequencies.push_back(row.frequency);
  }
  return compute(
      make_box_hull(10.0, 10.0, 5.0, {.length = 16, .breadth = 16, .draught = 8, .grading = 2.0}),
      {1000.0, 9.81, 20.0}, std::move(frequencies));
}

// Runs of 94 and 188 s, beside one of 31 s: they must not hear again of the short waves that they
// have sent out. Without a loss on the outer rings the first would be off by 18 % at 1.5 rad/s and
// by 97 % at 1.8.
TEST(LongRuns, KeepShortWavesOfACube) {
  const HydrodynamicDatabase brief = compute_cube(0.6);
  for (const double lowest : {0.2, 0.1}) {
    const HydrodynamicDatabase database = compute_cube(lowest);
    const std::size_t first = database.frequencies.size() - cube_in_surge.size();
    for (std::size_t k = 0; k < cube_in_surge.size(); ++k) {
      const double w = cube_in_surge[k].frequency;
      const double error = error_of(database, first + k, surge, cube_in_surge[k]);
      EXPECT_LT(error, 0.03) << lowest << " " << w;
      RecordProperty("surge_" + std::to_string(lowest) + "_" + std::to_string(w),
                     std::to_string(error));
      if (k == 0) continue;
      // The brief run's table begins one row later.
      const Force same{w, brief.added_mass[k - 1](surge, surge),
                       brief.damping[k - 1](surge, surge) / w};
      EXPECT_LT(error_of(database, first + k, surge, same), 0.01) << lowest << " " << w;
    }
    for (std::size_t k = 0; k < cube_in_heave.size(); ++k) {
      EXPECT_LT(error_of(database, first + 3 + k, heave, cube_in_heave[k]), 0.01) << lowest;
    }
  }
}

// Beside a barge of 100 x 20 m waves of 15 to 30 m meet rings that are too wide for them within the
// circle that holds it: a run of 94 s beside one of 16 s. Without a loss there sway would be off by
// 24 % at 2 rad/s.
TEST(LongRuns, KeepShortWavesBesideALongBarge) {
  const std::vector<double> short_waves = {1.4, 1.6, 1.8, 2.0};
  const PanelMesh barge =
      make_box_hull(100.0, 20.0, 5.0, {.length = 40, .breadth = 8, .draught = 3});
  std::vector<double> many = frequencies_from(0.2, 1.2), few{1.2};
  many.push_back(1.2);
  const std::size_t first = many.size();
  many.insert(many.end(), short_waves.begin(), short_waves.end());
  few.insert(few.end(), short_waves.begin(), short_waves.end());
  const HydrodynamicDatabase lasting = compute(barge, {1.0, 9.80665}, std::move(many));
  const HydrodynamicDatabase brief = compute(barge, {1.0, 9.80665}, std::move(few));
  for (std::size_t k = 0; k < short_waves.size(); ++k) {
    for (const int mode : {sway, heave}) {
      const Force same{short_waves[k], brief.added_mass[k + 1](mode, mode),
                       brief.damping[k + 1](mode, mode) / short_waves[k]};
      EXPECT_LT(error_of(lasting, first + k, mode, same), 0.02) << mode << " " << short_waves[k];
    }
  }
}

// A cylinder of radius 1 m and draught 0.5 m in deep water, by matched eigenfunctions (Yeung 1981),
// over rho a^3; g 9.80665 m/s2. At 0.3 rad/s waves are 685 radii long.
TEST(LongRuns, KeepShortWavesOfATruncatedCylinder) {
  constexpr std::array<Force, 4> in_surge = {{{1.0, .68333, .001261},
                                              {1.4, .72495, .012839 / 1.4},
                                              {3.0, .88176, 1.43016 / 3.0},
                                              {4.0, .43641, 2.70330 / 4.0}}};
  constexpr std::array<Force, 4> in_heave = {{{1.0, 2.43399, .38273},
                                              {1.4, 2.28487, .80505 / 1.4},
                                              {3.0, 1.55601, 1.45673 / 3.0},
                                              {4.0, 1.48549, .83563 / 4.0}}};
  std::vector<double> frequencies = frequencies_from(0.3, in_surge[0].frequency);
  const std::size_t first = frequencies.size();
  for (const Force& row : in_surge) frequencies.push_back(row.frequency);
  const HydrodynamicDatabase database = compute(
      make_vertical_cylinder(
          1.0, 0.5, true, {.meridians = 32, .parallels = 8, .grading = 5.0, .graded_edge = true}),
      {1.0, 9.80665}, std::move(frequencies));
  for (std::size_t k = 0; k < in_surge.size(); ++k) {
    EXPECT_LT(error_of(database, first + k, surge, in_surge[k]), 0.03) << in_surge[k].frequency;
    EXPECT_LT(error_of(database, first + k, heave, in_heave[k]), 0.03) << in_heave[k].frequency;
  }
}

}  // namespace
}  // namespace blocklift::dynamics

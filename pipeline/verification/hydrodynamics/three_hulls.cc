#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dynamics/marine/green/hull_equations.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

const Water launch_water{1025.0, 9.81};
/// The water between the pontoons swings at 0.69 rad/s; 0.628 rad/s are the launch's waves.
constexpr std::array<double, 6> launch_frequencies = {0.45, 0.55, 0.628, 0.69, 0.8, 1.0};
constexpr int launched = 2;  ///< number of the ship among the hulls

/// Two pontoons 16 m apart and a ship across their bows, as boxes of the launch's measures; the
/// plane y = 0 is one of symmetry.
PanelModel make_launch() {
  const PanelMesh pontoon =
      make_box_hull(110.0, 46.0, 4.6, {.length = 24, .breadth = 12, .draught = 3});
  const PanelMesh ship =
      make_box_hull(20.0, 118.0, 2.4, {.length = 6, .breadth = 24, .draught = 2});
  const Vector3 left{0.0, 31.0, 0.0}, right{0.0, -31.0, 0.0}, ahead{90.0, 0.0, 0.0};
  const std::vector<WettedBody> bodies{{"left", translate(pontoon, left), left},
                                       {"right", translate(pontoon, right), right},
                                       {"ship", translate(ship, ahead), ahead}};
  const auto lines = find_water_lines(bodies);
  const auto wave = [](double w) {
    return 2.0 * std::numbers::pi / calc_wave_number(w, launch_water);
  };
  const SurfaceMeshSettings settings =
      surface_settings(lines, wave(launch_frequencies.back()), wave(launch_frequencies.front()));
  return {bodies, make_surface_mesh(lines, settings), launch_water, {false, true}};
}

/// Both methods' forces at all frequencies.
struct BothMethods {
  int hull_panels = 0, surface_panels = 0;
  HydrodynamicDatabase marched;
  std::vector<Eigen::MatrixXcd> radiation;    ///< B + i w A by the Green function
  std::vector<Eigen::MatrixXcd> diffraction;  ///< by the same
};

BothMethods compute_launch() {
  const PanelModel model = make_launch();
  DatabaseSettings asked;
  asked.frequencies.assign(launch_frequencies.begin(), launch_frequencies.end());
  asked.headings = {0.0, 0.25 * std::numbers::pi, 0.5 * std::numbers::pi};
  BothMethods both;
  both.hull_panels = 2 * model.body_mesh().size();
  both.surface_panels = 2 * model.surface_mesh().size();
  both.marched = compute_database(model, asked);
  const HullEquations equations(model, {});
  for (const double w : asked.frequencies) {
    const auto parts = equations.solve(w);
    both.radiation.push_back(equations.calc_radiation(parts, w));
    both.diffraction.push_back(equations.calc_diffraction(parts, w, asked.headings));
  }
  return both;
}

/// Largest difference of B + i w A of two modes, as a share of the modes' own forces.
double radiation_difference(const BothMethods& both, Eigen::Index m, Eigen::Index n) {
  double largest = 0.0;
  for (std::size_t k = 0; k < both.radiation.size(); ++k) {
    const std::complex<double> marched(
        both.marched.damping[k](m, n),
        both.marched.frequencies[k] * both.marched.added_mass[k](m, n));
    const Eigen::MatrixXcd& other = both.radiation[k];
    largest = std::max(
        largest, std::abs(marched - other(m, n)) / std::sqrt(std::abs(other(m, m) * other(n, n))));
  }
  return largest;
}

/// Largest difference of the force of waves, as a share of the largest.
double wave_difference(const BothMethods& both, Eigen::Index mode) {
  double largest = 0.0, force = 0.0;
  for (std::size_t k = 0; k < both.diffraction.size(); ++k) {
    const Eigen::RowVectorXcd other = both.diffraction[k].row(mode);
    largest =
        std::max(largest, (both.marched.diffraction[k].row(mode) - other).cwiseAbs().maxCoeff());
    force =
        std::max(force, (both.marched.froude_krylov[k].row(mode) + other).cwiseAbs().maxCoeff());
  }
  return largest / force;
}

std::vector<VerificationRow> three_hulls_rows() {
  struct Mode {
    int body;
    DegreeOfFreedom freedom;
    const char* name;
    double radiation_bound, wave_bound;
  };
  const BothMethods both = compute_launch();
  const std::string range = fmt::format("0.45 to 1 rad/s, {} panels, {} with the surface's",
                                        both.hull_panels, both.hull_panels + both.surface_panels);
  std::vector<VerificationRow> rows;
  for (const Mode& mode : {Mode{0, sway, "sway of a pontoon", 0.06, 0.045},
                           Mode{0, heave, "heave of a pontoon", 0.025, 0.05},
                           Mode{0, roll, "roll of a pontoon", 0.021, 0.055},
                           Mode{launched, heave, "heave of the ship", 0.023, 0.05},
                           Mode{launched, roll, "pitch of the ship", 0.047, 0.075}}) {
    const Eigen::Index m = modes_per_body * mode.body + mode.freedom;
    rows.push_back(bound(fmt::format("{}, B + i w A, {}, relative difference", mode.name, range),
                         "1", radiation_difference(both, m, m), mode.radiation_bound,
                         "the wave Green function, on the hulls alone"));
    rows.push_back(bound(fmt::format("{}, force of waves of 0, 45 and 90 degrees, {}, difference "
                                     "of the largest",
                                     mode.name, range),
                         "1", wave_difference(both, m), mode.wave_bound,
                         "the wave Green function, on the hulls alone"));
  }
  double coupling = 0.0;
  for (Eigen::Index m = 0; m < both.marched.mode_count(); ++m) {
    for (Eigen::Index n = 0; n < both.marched.mode_count(); ++n) {
      if (m / modes_per_body != n / modes_per_body)
        coupling = std::max(coupling, radiation_difference(both, m, n));
    }
  }
  rows.push_back(bound(fmt::format("couplings of the three, B + i w A, {}, largest difference of "
                                   "the modes' own forces",
                                   range),
                       "1", coupling, 0.04, "the wave Green function, on the hulls alone"));
  return rows;
}

}  // namespace

VerificationCase three_hulls() {
  return {.name = "three-hulls",
          .stage = "hydrodynamics",
          .source =
              "Kleinman (1982): sources that make waves, of one frequency at a time, against "
              "the surface that is marched",
          .compute = three_hulls_rows};
}

}  // namespace blocklift::pipeline

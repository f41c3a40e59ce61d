#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "dynamics/marine/green/hull_equations.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/models/rectangular_section.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;
using Complex = std::complex<double>;

constexpr double barge_breadth = 20.0, barge_draught = 5.0, short_length = 80.0;
const Water barge_water{1.0, 9.80665};
/// The first makes the run long: 94 s. Waves of the last are 19 m long.
constexpr std::array<double, 7> barge_frequencies = {0.2, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8};

struct LongBarge {
  HydrodynamicDatabase database;
  int panels = 0;
  /// B + i w A by another method, with unknowns on the hull alone.
  std::vector<Eigen::MatrixXcd> forces_by_hull;
  int hull_panels = 0;
};

std::vector<Eigen::MatrixXcd> forces_of_barge(const PanelModel& model) {
  const HullEquations equations(model, {});
  std::vector<Eigen::MatrixXcd> forces;
  for (const double w : barge_frequencies) {
    forces.push_back(equations.calc_radiation(equations.solve(w), w));
  }
  return forces;
}

/// Panels of the same size on barges of any length.
LongBarge compute_barge(double length) {
  const std::vector<WettedBody> bodies{
      {"barge",
       make_box_hull(length, barge_breadth, barge_draught,
                     {.length = static_cast<int>(0.6 * length), .breadth = 12, .draught = 4}),
       Vector3::Zero()}};
  const auto lines = find_water_lines(bodies);
  const auto wave = [](double w) {
    return 2.0 * std::numbers::pi / calc_wave_number(w, barge_water);
  };
  const SurfaceMeshSettings settings =
      surface_settings(lines, wave(barge_frequencies.back()), wave(barge_frequencies.front()));
  const PanelModel model(bodies, make_surface_mesh(lines, settings), barge_water, {true, true});
  DatabaseSettings asked;
  asked.frequencies.assign(barge_frequencies.begin(), barge_frequencies.end());
  return {compute_database(model, asked),
          4 * (model.body_mesh().size() + model.surface_mesh().size()), forces_of_barge(model),
          4 * model.body_mesh().size()};
}

Complex force_on(const LongBarge& barge, std::size_t frequency, DegreeOfFreedom mode) {
  const double w = barge_frequencies[frequency];
  return {barge.database.added_mass[frequency](mode, mode),
          -barge.database.damping[frequency](mode, mode) / w};
}

Complex force_by_hull(const LongBarge& barge, std::size_t frequency, DegreeOfFreedom mode) {
  return barge.forces_by_hull[frequency](mode, mode) / Complex(0.0, barge_frequencies[frequency]);
}

// What one barge has more than another half as long is its middle: the ends are the same. There
// the flow is that about the section once waves are short beside the length; 0.8 rad/s is a wave
// of 96 m.
std::vector<VerificationRow> long_barge_rows() {
  struct Mode {
    DegreeOfFreedom freedom;
    const char* name;
    double bound;
  };
  std::vector<VerificationRow> rows;
  const LongBarge half = compute_barge(short_length), whole = compute_barge(2.0 * short_length);
  for (const Mode& mode :
       {Mode{sway, "sway", 0.08}, Mode{heave, "heave", 0.04}, Mode{roll, "roll", 0.05}}) {
    for (std::size_t k = 1; k < barge_frequencies.size(); ++k) {
      const double w = barge_frequencies[k];
      const Complex middle =
          (force_on(whole, k, mode.freedom) - force_on(half, k, mode.freedom)) / short_length;
      const Complex section = dynamics::examples::calc_section_force(
          {.breadth = barge_breadth, .draught = barge_draught, .depth = 80.0}, mode.freedom, w,
          barge_water.gravity);
      rows.push_back(bound(fmt::format("{}, B + i w A of the middle, {} rad/s, {} panels, relative "
                                       "error",
                                       mode.name, w, whole.panels),
                           "1", std::abs(middle - section) / std::abs(section), mode.bound));
      const Complex by_hull =
          (force_by_hull(whole, k, mode.freedom) - force_by_hull(half, k, mode.freedom)) /
          short_length;
      rows.push_back(bound(fmt::format("{}, B + i w A of the middle, {} rad/s, {} panels of the "
                                       "hull alone, relative error",
                                       mode.name, w, whole.hull_panels),
                           "1", std::abs(by_hull - section) / std::abs(section), mode.bound));
    }
  }
  return rows;
}

}  // namespace

VerificationCase long_barge() {
  return {.name = "long-barge",
          .stage = "hydrodynamics",
          .source = "Black, Mei and Bray (1971): rectangle by matched eigenfunctions",
          .compute = long_barge_rows};
}

}  // namespace blocklift::pipeline

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

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

/// Over rho a^3, and for the damping 1/s; radius a = 1 m, draught 0.5 m, g = 9.80665 m/s2.
struct CylinderRow {
  double frequency;  ///< rad/s
  double surge_A, heave_A, surge_B, heave_B;
};
constexpr std::array<CylinderRow, 4> exact = {{{1.0, .68333, 2.43399, .001261, .38273},
                                               {1.4, .72495, 2.28487, .012839, .80505},
                                               {3.0, .88176, 1.55601, 1.43016, 1.45673},
                                               {4.0, .43641, 1.48549, 2.70330, .83563}}};

/// @param edge_growth of the rings at the hull; 0: as a vessel gets them.
PanelModel make_model(int meridians, double edge_growth) {
  const Water water{1.0, 9.80665};
  const std::vector<WettedBody> bodies{{"cylinder",
                                        make_vertical_cylinder(1.0, 0.5, true,
                                                               {.meridians = meridians,
                                                                .parallels = meridians / 4,
                                                                .grading = 5.0,
                                                                .graded_edge = true}),
                                        Vector3::Zero()}};
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double w) { return 2.0 * std::numbers::pi / calc_wave_number(w, water); };
  SurfaceMeshSettings settings =
      surface_settings(lines, length(exact.back().frequency), length(exact.front().frequency));
  if (edge_growth > 0.0) settings.edge_growth = edge_growth;
  return {bodies, make_surface_mesh(lines, settings), water, {true, true}};
}

/// B + i w A of surge and heave at each frequency.
using CylinderForces = std::vector<Eigen::MatrixXcd>;

CylinderForces forces_of(const HydrodynamicDatabase& database) {
  CylinderForces forces;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    forces.emplace_back(database.damping[k] +
                        std::complex<double>(0.0, exact[k].frequency) * database.added_mass[k]);
  }
  return forces;
}

/// With unknowns on the hull alone; of its panels, and of ones of twice the size.
struct HullAlone {
  CylinderForces forces, coarser;

  explicit HullAlone(const PanelModel& model) {
    const HullEquations equations(model, {});
    for (const CylinderRow& row : exact) {
      const auto parts = equations.solve(row.frequency, {.coarser = true});
      forces.push_back(equations.calc_radiation(parts, row.frequency));
      coarser.push_back(equations.calc_coarser_radiation(parts, row.frequency));
    }
  }
  /// Largest change of a mode's force on itself, relative.
  double change(int mode) const {
    double largest = 0.0;
    for (std::size_t k = 0; k < forces.size(); ++k) {
      largest = std::max(largest, std::abs(coarser[k](mode, mode) / forces[k](mode, mode) - 1.0));
    }
    return largest;
  }
};

/// Largest relative errors over the frequencies.
struct Errors {
  double surge_A = 0.0, surge = 0.0, heave = 0.0;
};

Errors errors_of(const CylinderForces& forces) {
  Errors errors;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const CylinderRow& row = exact[k];
    const auto error_of_force = [&](int mode, double A, double B) {
      const std::complex<double> force(B, row.frequency * A);
      return std::abs(forces[k](mode, mode) - force) / std::abs(force);
    };
    const double surge_A = forces[k](surge, surge).imag() / row.frequency;
    errors.surge_A = std::max(errors.surge_A, std::abs(surge_A / row.surge_A - 1.0));
    errors.surge = std::max(errors.surge, error_of_force(surge, row.surge_A, row.surge_B));
    errors.heave = std::max(errors.heave, error_of_force(heave, row.heave_A, row.heave_B));
  }
  return errors;
}

HydrodynamicDatabase compute(const PanelModel& model) {
  DatabaseSettings settings;
  for (const CylinderRow& row : exact) settings.frequencies.push_back(row.frequency);
  settings.with_coarser = true;
  return compute_database(model, settings);
}

int panels_of(const PanelModel& model) {
  return 4 * (model.body_mesh().size() + model.surface_mesh().size());
}

// As a vessel is meshed: second order leaves a quarter of the 3 % that 16 panels around have, and
// the damping zone some more in the force of the shortest wave and the longest.
std::vector<VerificationRow> truncated_cylinder_rows() {
  std::vector<VerificationRow> rows;
  const PanelModel model = make_model(32, 0.0);
  const HydrodynamicDatabase database = compute(model);
  const Errors errors = errors_of(forces_of(database));
  const int panels = panels_of(model);
  rows.push_back(bound(fmt::format("surge added mass, {} panels, relative error", panels), "1",
                       errors.surge_A, 0.01));
  rows.push_back(bound(fmt::format("surge, B + i w A, {} panels, relative error", panels), "1",
                       errors.surge, 0.025));
  rows.push_back(bound(fmt::format("heave, B + i w A, {} panels, relative error", panels), "1",
                       errors.heave, 0.015));
  rows.push_back(bound(fmt::format("surge, error over its estimate, {} panels", panels), "1",
                       errors.surge / database.change_from_coarser[surge], 1.0,
                       "change from panels of twice the size"));
  rows.push_back(bound(fmt::format("heave, error over its estimate, {} panels", panels), "1",
                       errors.heave / database.change_from_coarser[heave], 1.0,
                       "change from panels of twice the size"));
  // The order, with rings that widen as slowly at the hull as elsewhere.
  std::vector<double> errors_by_size;
  for (const int meridians : {16, 32, 64}) {
    const PanelModel even = make_model(meridians, SurfaceMeshSettings{}.growth);
    errors_by_size.push_back(errors_of(forces_of(compute(even))).surge_A);
    rows.push_back(bound(
        fmt::format("surge added mass, even rings, {} panels, relative error", panels_of(even)),
        "1", errors_by_size.back(), 0.03 * std::pow(16.0 / meridians, 2)));
  }
  rows.push_back(compare("surge added mass, order of convergence in the panels' size", "1", 2.0,
                         0.5 * std::log2(errors_by_size.front() / errors_by_size.back()), 0.5,
                         "second order: panels of constant strength, midpoints"));
  // Another method, with unknowns on the hull alone. At the sharp edge the velocity grows as
  // r^(-1/3), which takes even panels from second order towards 4/3 (Costabel and Stephan 1985).
  std::vector<double> errors_by_hull;
  for (const int meridians : {16, 32, 64}) {
    const PanelModel hull = make_model(meridians, 0.0);
    const HullAlone alone(hull);
    const Errors of_hull = errors_of(alone.forces);
    errors_by_hull.push_back(of_hull.surge);
    const double allowed = 0.045 * std::pow(16.0 / meridians, 5.0 / 3.0);
    const int hull_panels = 4 * hull.body_mesh().size();
    rows.push_back(bound(
        fmt::format("surge, B + i w A, {} panels of the hull alone, relative error", hull_panels),
        "1", of_hull.surge, allowed));
    rows.push_back(bound(
        fmt::format("heave, B + i w A, {} panels of the hull alone, relative error", hull_panels),
        "1", of_hull.heave, allowed));
    if (meridians < 32) continue;
    for (const int mode : {surge, heave}) {
      const double error = mode == surge ? of_hull.surge : of_hull.heave;
      rows.push_back(bound(fmt::format("{}, error over its estimate, {} panels of the hull alone",
                                       mode == surge ? "surge" : "heave", hull_panels),
                           "1", error / alone.change(mode), 1.0,
                           "change from panels of twice the size"));
    }
  }
  rows.push_back(compare("surge, the hull alone, order of convergence in the panels' size", "1",
                         5.0 / 3.0, 0.5 * std::log2(errors_by_hull.front() / errors_by_hull.back()),
                         1.0 / 3.0, "between 4/3 and second order: a sharp edge, even panels"));
  return rows;
}

}  // namespace

VerificationCase truncated_cylinder() {
  return {.name = "truncated-cylinder",
          .stage = "hydrodynamics",
          .source = "Yeung (1981): added mass and damping by matched eigenfunctions",
          .compute = truncated_cylinder_rows};
}

}  // namespace blocklift::pipeline

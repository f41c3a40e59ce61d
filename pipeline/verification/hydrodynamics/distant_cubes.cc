#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "dynamics/marine/green/hull_equations.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/distant_groups.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

/// The force on one cube for unit velocity of the other: added mass (t) and damping (kN s/m), the
/// mean of both directions.
struct CoupledForce {
  double mass, damping;
};

struct CubesRow {
  double frequency;  ///< rad/s
  CoupledForce surge, heave;
};
// WAMIT 7 with 2,304 panels on each cube, as the developers of WEC-Sim published it (file cubes.1
// of their examples for BEMIO): density 1,000 kg/m3, g 9.81 m/s2, depth 20 m.
constexpr std::array<CubesRow, 3> wamit = {{{1.2, {-99.729, -43.774}, {-6.0006, 11.361}},
                                            {1.5, {72.482, -112.151}, {-3.4606, -1.0598}},
                                            {1.8, {-54.258, 71.996}, {0.9050, -0.1304}}}};
/// Of the table among the frequencies computed.
constexpr std::size_t first_row = 2;
constexpr int first_surge = surge, first_heave = heave, second_surge = modes_per_body + surge,
              second_heave = modes_per_body + heave;

/// A cube of 10 m, 5 m of it in the water, that stands at x; turned by 45 degrees if asked.
PanelMesh make_cube(int panels, double x, bool turned) {
  const PanelMesh box =
      make_box_hull(10.0, 10.0, 5.0,
                    {.length = panels, .breadth = panels, .draught = panels / 2, .grading = 2.0});
  const Matrix3 R =
      Eigen::AngleAxisd(turned ? 0.25 * std::numbers::pi : 0.0, Vector3::UnitZ()).matrix();
  std::vector<Panel> result;
  for (const Panel& panel : box.panels) {
    std::array<Vector3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] = R * panel.vertices[k] + Vector3(x, 0.0, 0.0);
      if (std::abs(p[k].y()) < 1e-9) p[k].y() = 0.0;
    }
    // Squares of the turned bottom that the plane of symmetry cuts along a diagonal are halved.
    const std::size_t first = p[0].y() == 0.0 && p[2].y() == 0.0 ? 0 : 1;
    if (p[first].y() == 0.0 && p[first + 2].y() == 0.0) {
      const std::size_t opposite = first + 2, last = (first + 3) % 4;
      result.push_back(make_panel(std::array{p[first], p[first + 1], p[opposite]}));
      result.push_back(make_panel(std::array{p[first], p[opposite], p[last]}));
    } else {
      result.push_back(make_panel(p));
    }
  }
  return make_panel_mesh(std::move(result));
}

/// Both cubes; the surface is not computed with.
/// @param panels along each edge of a cube.
PanelModel make_cubes_model(int panels) {
  const Water water{1000.0, 9.81, 20.0};
  const std::vector<WettedBody> bodies{
      {"turned", make_cube(panels, 0.0, true), {0.0, 0.0, -2.5}},
      {"square", make_cube(panels, 100.0, false), {100.0, 0.0, -2.5}}};
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double w) { return 2.0 * std::numbers::pi / calc_wave_number(w, water); };
  return {bodies,
          make_surface_mesh(lines, surface_settings(lines, length(wamit.back().frequency),
                                                    length(wamit.front().frequency))),
          water,
          {false, true}};
}

HydrodynamicDatabase compute_cubes(const PanelModel& model) {
  DatabaseSettings settings;
  settings.frequencies = {0.5, 0.85, 1.2, 1.5, 1.8};
  const std::vector<BodyGroup> groups = find_distant_groups(model, settings.frequencies.back());
  return compute_distant_groups(model, groups, settings);
}

CoupledForce force_of(const HydrodynamicDatabase& database, std::size_t k, int i, int j) {
  return {1e-3 * database.added_mass[k](i, j), 1e-3 * database.damping[k](i, j)};
}

/// Of B + i w A, relative to its size.
double error_of(const CoupledForce& force, const CoupledForce& exact, double w) {
  return std::hypot(w * (force.mass - exact.mass), force.damping - exact.damping) /
         std::hypot(w * exact.mass, exact.damping);
}

/// Largest over the frequencies.
struct CubesErrors {
  double surge = 0.0, heave = 0.0;
};

CubesErrors errors_of_cubes(const HydrodynamicDatabase& database) {
  CubesErrors errors;
  for (std::size_t k = 0; k < wamit.size(); ++k) {
    const CubesRow& row = wamit[k];
    errors.surge = std::max(errors.surge,
                            error_of(force_of(database, k + first_row, first_surge, second_surge),
                                     row.surge, row.frequency));
    // At 1.8 rad/s a tenth of the force in heave is left that it has at 1.2.
    if (std::hypot(row.frequency * row.heave.mass, row.heave.damping) < 2.0) continue;
    errors.heave = std::max(errors.heave,
                            error_of(force_of(database, k + first_row, first_heave, second_heave),
                                     row.heave, row.frequency));
  }
  return errors;
}

/// The same with unknowns on the cubes alone, in waves of the water itself, however far they go.
CubesErrors errors_of_cubes_alone(const PanelModel& model) {
  const HullEquations equations(model, {});
  CubesErrors errors;
  for (const CubesRow& row : wamit) {
    const double w = row.frequency;
    const Eigen::MatrixXcd force = equations.calc_radiation(equations.solve(w), w);
    const auto coupled = [&](int i, int j) {
      const std::complex<double> mean = 0.5 * (force(i, j) + force(j, i));
      return CoupledForce{1e-3 * mean.imag() / w, 1e-3 * mean.real()};
    };
    errors.surge =
        std::max(errors.surge, error_of(coupled(first_surge, second_surge), row.surge, w));
    if (std::hypot(w * row.heave.mass, row.heave.damping) < 2.0) continue;
    errors.heave =
        std::max(errors.heave, error_of(coupled(first_heave, second_heave), row.heave, w));
  }
  return errors;
}

std::vector<VerificationRow> distant_cubes_rows() {
  std::vector<VerificationRow> rows;
  struct Mesh {
    int panels;
    double surge, heave;
  };
  for (const Mesh& mesh : {Mesh{12, 0.05, 0.07}, Mesh{16, 0.03, 0.05}}) {
    const PanelModel model = make_cubes_model(mesh.panels);
    const HydrodynamicDatabase database = compute_cubes(model);
    const CubesErrors errors = errors_of_cubes(database);
    const int panels = 2 * model.body_mesh().size();
    const CubesErrors by_hull = errors_of_cubes_alone(model);
    rows.push_back(bound(fmt::format("surge on surge, B + i w A, {} panels of the cubes alone, "
                                     "relative error",
                                     panels),
                         "1", by_hull.surge, mesh.surge));
    rows.push_back(bound(fmt::format("heave on heave, B + i w A, {} panels of the cubes alone, "
                                     "relative error",
                                     panels),
                         "1", by_hull.heave, mesh.heave));
    rows.push_back(bound(
        fmt::format("surge on surge, B + i w A, {} panels on the cubes, relative error", panels),
        "1", errors.surge, mesh.surge));
    rows.push_back(bound(
        fmt::format("heave on heave, B + i w A, {} panels on the cubes, relative error", panels),
        "1", errors.heave, mesh.heave));
    for (std::size_t k = 0; k < wamit.size(); ++k) {
      const CubesRow& row = wamit[k];
      rows.push_back(
          compare(fmt::format("damping, surge on surge, {} rad/s, {} panels on the cubes",
                              row.frequency, panels),
                  "kN s/m", row.surge.damping,
                  force_of(database, k + first_row, first_surge, second_surge).damping,
                  mesh.surge * std::hypot(row.surge.damping, row.frequency * row.surge.mass)));
    }
  }
  return rows;
}

}  // namespace

VerificationCase distant_cubes() {
  return {.name = "distant-cubes",
          .stage = "hydrodynamics",
          .source = "WAMIT 7: cubes 100 m apart, published with WEC-Sim's BEMIO",
          .compute = distant_cubes_rows};
}

}  // namespace blocklift::pipeline

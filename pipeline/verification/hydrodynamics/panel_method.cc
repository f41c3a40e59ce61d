#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/frequency_domain.h"
#include "dynamics/marine/radiation/incident_wave.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/models/hemisphere.h"
#include "pipeline/verification/models/panel_quadrature.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

using std::numbers::pi;

/// Sum over the panels of a closed body of the solid angles that they subtend at a point, sr.
double solid_angle(const PanelMesh& body, const Vector3& point) {
  double sum = 0.0;
  for (const Panel& panel : body.panels) sum += calc_panel_potentials(panel, point).dipole;
  return std::abs(sum);
}

// The 20 x 20 pieces of order 10 are exact to 1e-12 at distances of more than 0.3 of the panel.
std::vector<VerificationRow> integral_rows() {
  const Panel panel = examples::skew_quadrangle();
  std::vector<VerificationRow> rows;
  for (const double height : {0.6, -0.7, 7.0}) {
    const Vector3 point = panel.centroid + height * panel.normal + 0.3 * height * Vector3::UnitX();
    const PanelPotentials exact = examples::by_quadrature(panel, point, 20);
    const PanelPotentials found = calc_panel_potentials(panel, point);
    rows.push_back(compare(fmt::format("source over a quadrangle, {} m above it", height), "m",
                           exact.source, found.source, 1e-12 * exact.source,
                           "Gauss quadrature, 20 x 20 x 5 x 5 points"));
    rows.push_back(compare(fmt::format("dipole over a quadrangle, {} m above it", height), "1",
                           exact.dipole, found.dipole,
                           1e-12 * (std::abs(exact.dipole) + exact.source),
                           "Gauss quadrature, 20 x 20 x 5 x 5 points"));
  }
  const Panel square = make_panel(std::array{Vector3(-0.5, -0.5, -1), Vector3(0.5, -0.5, -1),
                                             Vector3(0.5, 0.5, -1), Vector3(-0.5, 0.5, -1)});
  rows.push_back(compare("source over a unit square at its middle", "m", 4.0 * std::asinh(1.0),
                         calc_panel_potentials(square, Vector3(0, 0, -1)).source, 1e-14,
                         "4 arsinh 1"));
  // A closed surface of flat panels; some 500 angles with rounding of 1e-15 each.
  const PanelMesh sphere =
      expand_symmetry(make_ellipsoid({1, 1, 1}, {0, 0, -5}, {.meridians = 24, .parallels = 8}));
  PanelMesh box = make_box_hull(4, 2, 1, {8, 4, 2, 2.0});
  for (const Panel& panel_of_bottom : std::vector<Panel>(box.panels)) {
    if (panel_of_bottom.normal.z() > -0.5) continue;
    std::vector<Vector3> lid;
    for (int v = panel_of_bottom.vertex_count; v-- > 0;) {
      const Vector3& p = panel_of_bottom.vertices[v];
      lid.emplace_back(p.x(), p.y(), 0.0);
    }
    box.panels.push_back(make_panel(lid));
  }
  rows.push_back(compare("solid angle of a box from within", "sr", 4 * pi,
                         solid_angle(box, {0.3, -0.2, -0.4}), 1e-11, "Gauss"));
  rows.push_back(bound("solid angle of a box from outside", "sr", solid_angle(box, {3, 1, -0.5}),
                       1e-11, "Gauss"));
  // Quadrangles of a sphere are not flat: what is between them and the sphere's corners is missing.
  rows.push_back(compare("solid angle of a sphere of 384 panels from within", "sr", 4 * pi,
                         solid_angle(sphere, {0, 0, -5}), 1e-3 * 4 * pi, "Gauss"));
  return rows;
}

// Flat panels with their centroids inside the sphere: errors of the order of the panels' size.
std::vector<VerificationRow> deep_sphere_rows() {
  std::vector<VerificationRow> rows;
  double last = std::numeric_limits<double>::infinity();
  for (const int n : {16, 32, 48}) {
    const PanelMesh hull =
        make_ellipsoid({1, 1, 1}, {0, 0, -1000}, {.meridians = n, .parallels = n / 4});
    const PanelModel model({{"sphere", hull, {0, 0, -1000}}}, {}, {1, 1});
    const RankinePart part(model, {});
    const double coefficient = part.infinite_frequency_volume()(heave, heave) / (4.0 / 3.0 * pi);
    rows.push_back(compare(fmt::format("added mass over displaced mass, {} panels", hull.size()),
                           "1", 0.5, coefficient,
                           n == 16   ? 0.04
                           : n == 32 ? 0.012
                                     : 0.006));
    const double error = std::abs(coefficient - 0.5);
    if (std::isfinite(last)) {
      rows.push_back(bound(fmt::format("its error over that of fewer panels, {}", hull.size()), "1",
                           error / last, 0.7));
    }
    last = error;
  }
  return rows;
}

/// Two bodies half a radius apart, a quarter of them computed.
std::vector<VerificationRow> symmetry_rows() {
  const PanelMesh sphere = make_half_ellipsoid({1, 1, 1}, {.meridians = 24, .parallels = 8});
  const std::vector<WettedBody> bodies = {{"left", translate(sphere, {-1.25, 0, 0}), {-1.25, 0, 0}},
                                          {"right", translate(sphere, {1.25, 0, 0}), {1.25, 0, 0}}};
  const SurfaceMesh surface =
      make_surface_mesh(find_water_lines(bodies), {.first_ring = 0.08, .radius = 35.0});
  DatabaseSettings settings;
  settings.frequencies = {0.6, 1.0, 1.4};
  settings.headings = {0.5};
  settings.duration = 40.0;
  settings.damping_strength = 0.5;
  DatabaseReport report;
  const HydrodynamicDatabase database =
      compute_database(PanelModel(bodies, surface, {1.0, 1.0}, {true, true}), settings, &report);
  std::vector<VerificationRow> rows = {
      bound("A_inf(i, j) - A_inf(j, i), over their size, as solved", "1", report.asymmetry, 3e-3)};
  // Mirror images: heave on heave of both bodies, the coupling of left with right and right with
  // left.
  const Eigen::MatrixXd& A = database.infinite_added_mass;
  rows.push_back(compare("heave of the right body, A_inf", "kg", A(heave, heave),
                         A(6 + heave, 6 + heave), 1e-9 * A(heave, heave), "mirror image"));
  double least = 0.0;
  for (const Eigen::MatrixXd& damping : database.damping) {
    const Eigen::VectorXd values = algebra::symmetric_eigenvalues<Eigen::Dynamic>(damping);
    least = std::min(least, values[0] / values[11]);
  }
  // Negative at most by the discretisation error of 1,400 unknowns.
  rows.push_back(bound("negative eigenvalue of the damping, over the largest", "1", least, 2e-3,
                       "damping takes energy"));
  return rows;
}

// Diffraction by a system of its own against Haskind's relation from the radiation potentials, with
// the same matrices and the same damping zone; steady waves want rings that widen slowly.
std::vector<VerificationRow> haskind_rows() {
  const examples::Hemisphere sphere =
      examples::make_hemisphere(1.0, {24, 8, 0.08, 1.06, 30.0}, {1.0, 1.0});
  DatabaseSettings settings;
  settings.frequencies = {0.7, 1.0, 1.4};
  settings.headings = {0.4};
  settings.duration = 60.0;
  settings.damping_strength = 0.8;
  const HydrodynamicDatabase database = compute_database(sphere.model, settings);
  RankineSettings rankine;
  rankine.keep_factors = true;
  std::vector<VerificationRow> rows;
  for (const Parity parity : {Parity{1, 1}, Parity{-1, 1}}) {
    const RankinePart part(sphere.model, parity, rankine);
    const FrequencyDomain direct(
        sphere.model, part,
        DampingZone{0.8}.damping(sphere.model.surface(), sphere.model.water().gravity));
    const int mode = parity.x > 0 ? heave : surge;
    for (std::size_t k = 0; k < settings.frequencies.size(); ++k) {
      const double w = settings.frequencies[k];
      const IncidentWave wave(sphere.model.water(), w, 0.4);
      const Eigen::VectorXcd opposed = sphere.model.part_of(
          parity, [&](const Vector3& p, const Vector3& n) -> std::complex<double> {
            return -(wave.velocity(p).transpose() * n)(0);
          });
      const std::complex<double> force = direct.calc_force(w, opposed)[0];
      const double excitation = std::abs(database.excitation(k)(mode, 0));
      rows.push_back(
          bound(fmt::format("{}, w {} (a/g)^1/2: diffraction both ways, over the excitation",
                            mode == heave ? "heave" : "surge", w),
                "1", std::abs(force - database.diffraction[k](mode, 0)) / excitation, 0.02));
    }
  }
  return rows;
}

// |X| = 4 rho g tanh(k h)/(k^2 |H1'(k a)|).
std::vector<VerificationRow> cylinder_rows() {
  const double depth = 2.0;
  const std::vector<WettedBody> bodies{
      {"column",
       make_vertical_cylinder(1.0, depth, false,
                              {.meridians = 32, .parallels = 12, .grading = 3.0}),
       Vector3(0, 0, -depth)}};
  const SurfaceMesh surface = make_surface_mesh(
      find_water_lines(bodies), {.first_ring = 0.06, .growth = 1.08, .radius = 40.0});
  const PanelModel model(bodies, surface, {1.0, 1.0, depth}, {true, true});
  DatabaseSettings settings;
  for (const double ka : {0.3, 0.6, 1.0, 1.5, 2.0}) {
    settings.frequencies.push_back(std::sqrt(ka * std::tanh(ka * depth)));
  }
  settings.headings = {0.0};
  settings.duration = 60.0;
  settings.damping_strength = 0.5;
  const HydrodynamicDatabase database = compute_database(model, settings);
  std::vector<VerificationRow> rows;
  for (std::size_t i = 0; i < settings.frequencies.size(); ++i) {
    const double k = calc_wave_number(settings.frequencies[i], model.water());
    // H1' = H0 - H1/x.
    const double J = std::cyl_bessel_j(0.0, k) - std::cyl_bessel_j(1.0, k) / k;
    const double Y = std::cyl_neumann(0.0, k) - std::cyl_neumann(1.0, k) / k;
    const double exact = 4.0 * std::tanh(k * depth) / (k * k * std::hypot(J, Y));
    rows.push_back(compare(fmt::format("|X| / (rho g a^2), surge, k a {:.2f}, depth 2 a", k), "1",
                           exact, std::abs(database.excitation(i)(surge, 0)), 0.02 * exact));
  }
  return rows;
}

}  // namespace

VerificationCase panel_integrals() {
  return {.name = "panel-integrals",
          .stage = "hydrodynamics",
          .source = "Hess and Smith (1964); Newman (1986)",
          .compute = integral_rows};
}

VerificationCase deep_sphere() {
  return {.name = "deep-sphere",
          .stage = "hydrodynamics",
          .source = "Lamb, Hydrodynamics, art. 92: half the displaced mass",
          .compute = deep_sphere_rows};
}

VerificationCase two_hemispheres() {
  return {.name = "two-hemispheres",
          .stage = "hydrodynamics",
          .source = "reciprocity: A and B are symmetric",
          .compute = symmetry_rows};
}

VerificationCase haskind_relation() {
  return {.name = "haskind-relation",
          .stage = "hydrodynamics",
          .source = "Haskind (1957), Newman (1962): diffraction from the radiation potentials",
          .compute = haskind_rows};
}

VerificationCase standing_cylinder() {
  return {.name = "standing-cylinder",
          .stage = "hydrodynamics",
          .source = "MacCamy and Fuchs (1954)",
          .compute = cylinder_rows};
}

}  // namespace blocklift::pipeline

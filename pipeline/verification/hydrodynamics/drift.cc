#include <array>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/mean_drift.h"
#include "dynamics/marine/radiation/response_amplitude.h"
#include "pipeline/simulation/mechanism_run.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/hydrodynamics/scratch_folder.h"
#include "pipeline/verification/models/hemisphere.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

/// sum over m of [1 - m (m+1)/x^2]^2 / (|H_m'|^2 |H_m+1'|^2), x = k a.
double havelock_sum(double x) {
  using Complex = std::complex<double>;
  const auto bessel = [x](int m) {
    return Complex(std::cyl_bessel_j(m, x), -std::cyl_neumann(m, x));
  };
  const auto slope = [&](int m) { return m == 0 ? -bessel(1) : bessel(m - 1) - m / x * bessel(m); };
  double sum = 0.0;
  for (int m = 0; m < x + 20; ++m) {
    const double factor = 1.0 - m * (m + 1) / (x * x);
    sum += factor * factor / (std::norm(slope(m)) * std::norm(slope(m + 1)));
  }
  return sum;
}

// F / (rho g a^2 R) = (2 c_g/c) 4/(pi^2 (k R)^3) times the sum, radius, density and gravity 1.
void add_column(std::vector<VerificationRow>& rows) {
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
  for (const double ka : {0.6, 1.0, 1.5, 2.0}) {
    settings.frequencies.push_back(std::sqrt(ka * std::tanh(ka * depth)));
  }
  settings.headings = {0.5};
  settings.duration = 60.0;
  settings.damping_strength = 0.5;
  settings.with_far_field = true;
  const HydrodynamicDatabase database = compute_database(model, settings);
  const auto drift = calc_mean_drift(database, {});
  for (std::size_t i = 0; i < drift.size(); ++i) {
    const double k = calc_wave_number(settings.frequencies[i], model.water());
    const double ratio = 2.0 * calc_group_velocity(settings.frequencies[i], model.water()) * k /
                         settings.frequencies[i];
    const double exact =
        ratio * 4.0 / (std::numbers::pi * std::numbers::pi * k * k * k) * havelock_sum(k);
    const double along = std::cos(0.5) * drift[i](surge, 0) + std::sin(0.5) * drift[i](sway, 0);
    rows.push_back(compare(
        fmt::format("standing column, mean force / (rho g a^2 R), k R {:.2f}, depth 2 R", k), "1",
        exact, along, 0.04 * exact, "Havelock (1940), from MacCamy and Fuchs (1954)"));
  }
}

// What waves carry away is what damping takes: far field against near field. A free body takes
// nothing out of the waves, and Haskind's relation ties its excitation to what it would radiate.
void add_hemisphere(std::vector<VerificationRow>& rows) {
  const examples::Hemisphere sphere =
      examples::make_hemisphere(1.0, {24, 8, 0.08, 1.06, 30.0}, {1.0, 1.0});
  DatabaseSettings settings;
  settings.frequencies = {0.7, 1.0, 1.4};
  settings.headings = {0.4};
  settings.duration = 60.0;
  settings.damping_strength = 0.8;
  settings.with_far_field = true;
  HydrodynamicDatabase database = compute_database(sphere.model, settings);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(6, 6);
  stiffness(heave, heave) = std::numbers::pi;
  database.hydrostatic_stiffness = stiffness;
  const auto motions = calc_response_amplitudes(
      database,
      make_mass_matrix(2.0 / 3.0 * std::numbers::pi, Vector3::Constant(0.6), Matrix3::Identity()));
  const auto lost = calc_absorbed_power(database, motions);
  for (std::size_t k = 0; k < settings.frequencies.size(); ++k) {
    const double w = settings.frequencies[k];
    const double flux = 0.5 * calc_group_velocity(w, database.water);
    for (const int mode : {surge, heave}) {
      const double sent =
          flux * DirectionalWaves(database.far_field.radiated[k].col(mode)).integrate().whole;
      const double B = database.damping[k](mode, mode);
      const double taken = 0.5 * w * w * B;
      // The panels' error is one of B + i w A: where waves are few it is large beside B.
      const double force = std::hypot(B, w * database.added_mass[k](mode, mode));
      rows.push_back(compare(
          fmt::format("hemisphere, w {} (a/g)^1/2: waves sent out over work of the damping, {}", w,
                      mode == heave ? "heave" : "surge"),
          "1", 1.0, sent / taken, 0.015 * force / B, "conservation of energy"));
    }
    rows.push_back(
        bound(fmt::format("free hemisphere, w {} (a/g)^1/2: waves' power that is lost over that on "
                          "its diameter",
                          w),
              "1", std::abs(lost[k][0]) / (2.0 * flux), 0.02, "conservation of energy"));
  }
}

std::vector<VerificationRow> drift_rows() {
  std::vector<VerificationRow> rows;
  add_column(rows);
  add_hemisphere(rows);
  return rows;
}

// m dV/dt = rho/2 S C (U - V)^2 from rest: with h = rho S C/(2 m), U - V = U/(1 + h U t) and
// x = U t - ln(1 + h U t)/h.
std::vector<VerificationRow> current_rows() {
  ModelLibrary library = ModelLibrary::of_installation();
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "mechanism.yaml";
  std::ofstream(file) << R"(mechanism: adrift
sea: {density: 1000 kg/m^3, current: {speed: 2 m/s, towards: 30 deg}}
vessels:
  sphere:
    model: vessels/sphere-5m
    draught: 0 m
    heading: 30 deg
    radiation: none
    current_load:
      area: 50 m^2
      length: 10 m
      coefficients: [[0 deg, 1.2, 0, 0], [90 deg, 0, 1.2, 0.05], [180 deg, -1.2, 0, 0]]
      about: [0 m, 0 m, -2 m]
initial: {positions: {sphere: [0 m, 0 m, 0 m, 0 deg, 0 deg, 30 deg]}}
simulate: {duration: 100 s, relative_tolerance: 1e-8, sample_interval: 20 s}
outputs: {place: {point: {body: sphere}}}
)";
  Diagnostics diagnostics;
  const auto read = read_mechanism(file, library, diagnostics);
  if (!read) throw InputError(diagnostics);
  const MechanismRun run = run_mechanism(*read, {});
  const Eigen::MatrixXd& place = run.outputs.front().values;
  const double h = 0.5 * 1000.0 * 50.0 * 1.2 / 261.8e3, speed = 2.0;
  std::vector<VerificationRow> rows;
  for (const int sample : {1, 5}) {
    const double t = 20.0 * sample;
    const double exact = speed * t - std::log(1.0 + h * speed * t) / h;
    const double along = std::cos(std::numbers::pi / 6.0) * place(sample, 0) +
                         std::sin(std::numbers::pi / 6.0) * place(sample, 1);
    rows.push_back(compare(fmt::format("sphere let go in a current of 2 m/s, way after {} s", t),
                           "m", exact, along, 1e-4 * exact));
  }
  return rows;
}

}  // namespace

VerificationCase mean_drift_of_waves() {
  return {.name = "mean-drift",
          .stage = "hydrodynamics",
          .source = "Havelock (1940); Maruo (1960); Newman (1967)",
          .compute = drift_rows};
}

VerificationCase drag_of_a_current() {
  return {.name = "current-coefficients",
          .stage = "hydrodynamics",
          .source = "closed form: quadratic drag from rest",
          .compute = current_rows};
}

}  // namespace blocklift::pipeline

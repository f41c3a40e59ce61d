#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/marine/radiation/floating_motion.h"
#include "pipeline/hydrodynamics/hydrodynamic_problem.h"
#include "pipeline/simulation/mechanism_run.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/hydrodynamics/scratch_folder.h"
#include "pipeline/verification/models/hemisphere.h"

namespace blocklift::pipeline {
namespace {

using dynamics::Extremum;
using dynamics::HydrodynamicDatabase;
namespace fs = std::filesystem;

constexpr double sphere_radius = 5.0, water_density = 1000.0, standard_gravity = 9.80665;
constexpr int heave_mode = 2;
// Small beside the radius: the water plane shrinks by (z / a)^2 = 0.0004.
constexpr double release = 0.1;

double frequency_of(double ka) { return std::sqrt(ka * standard_gravity / sphere_radius); }

/// The shipped vessel as `blocklift hydro` computes it, at its own frequencies and the table's up
/// to k a = 3, whose wave the panels still carry.
HydrodynamicFile compute_shipped_sphere(ModelLibrary& library) {
  Diagnostics diagnostics;
  for (const fs::path& file : library.files_of("vessels", "vessel.yaml")) {
    if (file.parent_path().filename() != "sphere-5m") continue;
    auto problem = read_hydrodynamic_problem(file, library, diagnostics);
    if (!problem) throw InputError(diagnostics);
    std::vector<double>& list = problem->settings.frequencies;
    for (const auto& row : dynamics::examples::hulme) {
      if (row.ka > 3.0) continue;
      const double w = frequency_of(row.ka);
      // In place of those beside it: a polynomial through close neighbours is no good.
      std::erase_if(list, [&](double own) { return std::abs(own - w) < 0.05; });
      list.push_back(w);
    }
    std::sort(list.begin(), list.end());
    return compute_hydrodynamics(*problem, {prepare_state(*problem, 0)});
  }
  throw std::runtime_error("there is no model vessels/sphere-5m");
}

std::size_t place_of(const HydrodynamicDatabase& database, double frequency) {
  const auto& w = database.frequencies;
  const auto found = std::min_element(w.begin(), w.end(), [&](double a, double b) {
    return std::abs(a - frequency) < std::abs(b - frequency);
  });
  return static_cast<std::size_t>(found - w.begin());
}

void add_table(const HydrodynamicDatabase& database, std::vector<VerificationRow>& rows) {
  const double mass = 2.0 / 3.0 * std::numbers::pi * water_density * std::pow(sphere_radius, 3);
  for (const auto& row : dynamics::examples::hulme) {
    if (row.ka > 3.0) continue;
    const double w = frequency_of(row.ka);
    const std::size_t k = place_of(database, w);
    const double A = database.added_mass[k](heave_mode, heave_mode) / mass;
    const double B = database.damping[k](heave_mode, heave_mode) / mass / w;
    const double tolerance = 0.015 * row.heave_A;
    rows.push_back(compare(fmt::format("A heave / (rho V), k a {}", row.ka), "1", row.heave_A, A,
                           tolerance, "Hulme (1982)"));
    rows.push_back(compare(fmt::format("B heave / (rho V w), k a {}", row.ka), "1", row.heave_B, B,
                           tolerance, "Hulme (1982)"));
  }
}

/// Extrema of the heave in the output of a mechanism file, whose samples are 0.01 s apart.
std::vector<Extremum> extrema_of(const fs::path& mechanism, ModelLibrary& library) {
  Diagnostics diagnostics;
  const auto read = read_mechanism(mechanism, library, diagnostics);
  if (!read) throw InputError(diagnostics);
  const MechanismRun run = run_mechanism(*read, {});
  dynamics::FloatingMotion motion;
  motion.step = 0.01;
  for (Eigen::Index k = 0; k < run.outputs.front().values.rows(); ++k) {
    motion.position.push_back(run.outputs.front().values.row(k).transpose());
  }
  std::vector<Extremum> extrema = find_extrema(motion, heave_mode);
  if (extrema.size() < 4) throw std::runtime_error("the sphere does not swing");
  return extrema;
}

/// Of the sphere that is let go, run from a mechanism file that names the database's file.
std::vector<Extremum> decay_by_files(const HydrodynamicFile& file, ModelLibrary& library) {
  const ScratchFolder folder;
  write_hydrodynamic_file(folder.path() / "sphere.h5", file);
  const fs::path mechanism = folder.path() / "mechanism.yaml";
  std::ofstream(mechanism) << fmt::format(R"(mechanism: decay
sea: {{density: {} kg/m^3}}
vessels: {{sphere: {{model: vessels/sphere-5m, draught: 0 m, database: sphere.h5}}}}
initial: {{positions: {{sphere: [0 m, 0 m, {} m, 0 deg, 0 deg, 0 deg]}}}}
simulate: {{duration: 10 s, relative_tolerance: 1e-8, sample_interval: 10 ms}}
outputs: {{height: {{point: {{body: sphere}}}}}}
)",
                                          water_density, release);
  return extrema_of(mechanism, library);
}

/// The shipped mechanism, let go 1 m up, against the codes that were compared on it.
void add_task_10(ModelLibrary& library, std::vector<VerificationRow>& rows) {
  for (const fs::path& file : library.files_of("mechanisms", "mechanism.yaml")) {
    if (file.parent_path().filename() != "sphere-decay") continue;
    const Extremum second = extrema_of(file, library)[1];
    const std::string band = "Wendt et al. (2019), IEA OES Task 10: five codes' band";
    rows.push_back(compare("second crest from 1 m, time", "s", 4.41, second.time, 0.04, band));
    rows.push_back(compare("second crest from 1 m", "m", 0.6415, second.value, 0.0095, band));
    return;
  }
  throw std::runtime_error("there is no model mechanisms/sphere-decay");
}

/// The complex frequency of the free heave, c - w^2 (m + A(w)) + i w B(w) = 0. The left side is
/// analytic: the polynomial through the database's five frequencies about the natural one carries
/// it from the real axis to the root, by the secant method.
std::complex<double> free_frequency(const HydrodynamicDatabase& database) {
  const double volume = 2.0 / 3.0 * std::numbers::pi * std::pow(sphere_radius, 3);
  const double mass = water_density * volume;
  const double stiffness =
      water_density * standard_gravity * std::numbers::pi * sphere_radius * sphere_radius;
  const auto left_side = [&](std::complex<double> w, std::size_t first) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = first; i < first + 5; ++i) {
      const double at = database.frequencies[i];
      const double A = database.added_mass[i](heave_mode, heave_mode);
      std::complex<double> term(stiffness - at * at * (mass + A),
                                at * database.damping[i](heave_mode, heave_mode));
      for (std::size_t j = first; j < first + 5; ++j) {
        if (j != i) term *= (w - database.frequencies[j]) / (at - database.frequencies[j]);
      }
      sum += term;
    }
    return sum;
  };
  std::complex<double> w(1.43, 0.0), next(1.43, 0.1);
  const std::size_t first = place_of(database, 1.43) - 2;
  std::complex<double> value = left_side(w, first);
  for (int round = 0; round < 30 && std::abs(next - w) > 1e-12; ++round) {
    const std::complex<double> found = left_side(next, first);
    const std::complex<double> step = found * (next - w) / (found - value);
    w = next;
    value = found;
    next -= step;
  }
  return next;
}

std::vector<VerificationRow> decay_rows_of_files() {
  ModelLibrary library = ModelLibrary::of_installation();
  const HydrodynamicFile file = compute_shipped_sphere(library);
  const HydrodynamicDatabase& database = file.series.databases.front();
  std::vector<VerificationRow> rows;
  add_table(database, rows);
  const std::vector<Extremum> found = decay_by_files(file, library);
  constexpr std::array<Extremum, 4> exact = {
      {{2.214, -.8670}, {4.421, .6347}, {6.602, -.4645}, {8.776, .3462}}};
  const std::string theory = "linear theory, multipole expansion";
  for (std::size_t k = 0; k < exact.size(); ++k) {
    rows.push_back(compare(fmt::format("extremum {} over the release", k + 1), "1", exact[k].value,
                           found[k].value / release, 4e-3, theory));
    rows.push_back(compare(fmt::format("extremum {}, time", k + 1), "s", exact[k].time,
                           found[k].time, 0.01, theory));
  }
  // What the memory does besides the free motion makes the first swing another; it is left out.
  const std::complex<double> w = free_frequency(database);
  const double period = found[3].time - found[1].time;
  const double decay = std::log(found[1].value / found[3].value) / period;
  const std::string own = "root of the equation of motion with the database's A and B";
  rows.push_back(compare("period from the second to the fourth extremum", "s",
                         2.0 * std::numbers::pi / w.real(), period, 0.02, own));
  rows.push_back(compare("rate of decay there", "1/s", w.imag(), decay, 0.006, own));
  add_task_10(library, rows);
  return rows;
}

}  // namespace

VerificationCase sphere_through_files() {
  return {.name = "sphere-through-files",
          .stage = "hydrodynamics",
          .source = "Hulme (1982), J. Fluid Mech. 121",
          .compute = decay_rows_of_files};
}

}  // namespace blocklift::pipeline

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include <fmt/format.h>

#include "algebra/factors.h"
#include "pipeline/hydrodynamics/hydrodynamic_problem.h"
#include "pipeline/simulation/mechanism_run.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/hydrodynamics/scratch_folder.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using Complex = std::complex<double>;
namespace fs = std::filesystem;

// Small: what the hulls' forces are not linear in grows with the square.
constexpr double wave_amplitude = 0.05;
constexpr double joint_run_s = 560.0, judged_from_s = 160.0, joint_sample_s = 0.1;
constexpr double mooring_stiffness = 100e3;

/// The shipped ring and spar as `blocklift hydro` computes them, and their masses.
struct AbsorberFile {
  HydrodynamicFile file;
  Eigen::MatrixXd mass;  ///< 12 x 12 about the centres of mass
};

AbsorberFile compute_absorber(ModelLibrary& library) {
  Diagnostics diagnostics;
  for (const fs::path& file : library.files_of("vessels", "vessels.yaml")) {
    if (file.parent_path().filename() != "point-absorber") continue;
    const auto problem = read_hydrodynamic_problem(file, library, diagnostics);
    if (!problem) throw InputError(diagnostics);
    const HydrodynamicState state = prepare_state(*problem, 0);
    return {compute_hydrodynamics(*problem, {state}), state.mass};
  }
  throw std::runtime_error("there is no model vessels/point-absorber");
}

/// Complex amplitudes over that of the wave, m/m and rad/m.
struct Response {
  Complex float_heave, spar_heave, float_surge;
};

// The twelve equations of both bodies on the motions that the joint leaves: six of the spar, and
// the ring's way along it.
Response solve_in_frequency(const AbsorberFile& absorber, std::size_t k, double take_off) {
  const HydrodynamicDatabase& database = absorber.file.series.databases.front();
  const double w = database.frequencies[k];
  const Vector3 arm = database.reference_points[0] - database.reference_points[1];
  Eigen::MatrixXcd T = Eigen::MatrixXcd::Zero(12, 7);
  T.block<6, 6>(0, 0).setIdentity();
  T.block<3, 3>(0, 3) = -dynamics::skew(arm).cast<Complex>();
  T(2, 6) = 1.0;
  T.block<6, 6>(6, 0).setIdentity();
  Eigen::MatrixXcd Z =
      (-w * w * (absorber.mass + database.added_mass[k]) + database.hydrostatic_stiffness)
          .cast<Complex>();
  Z += Complex(0.0, w) * database.damping[k].cast<Complex>();
  Z(6, 6) += mooring_stiffness;
  Z(7, 7) += mooring_stiffness;
  Z(11, 11) += 1e3 * mooring_stiffness;
  Eigen::MatrixXcd free = T.transpose() * Z * T;
  free(6, 6) += Complex(0.0, w * take_off);
  const Eigen::VectorXcd force = T.transpose() * database.excitation(k).col(0);
  const Eigen::VectorXcd motion = T * algebra::LuFactors<Complex>(free).solve(force);
  return {motion[2], motion[8], motion[0]};
}

// Hann's window keeps what swings on at the bodies' own frequencies out.
Complex harmonic_of(const Eigen::VectorXd& values, double w) {
  Complex sum = 0.0;
  double weights = 0.0;
  const double length = joint_run_s - judged_from_s;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const double time = joint_sample_s * static_cast<double>(k);
    if (time < judged_from_s) continue;
    const double turn = 2.0 * std::numbers::pi * (time - judged_from_s) / length;
    const double weight = 1.0 - std::cos(turn);
    sum += 2.0 * weight * values[k] * std::polar(1.0, -w * time);
    weights += weight;
  }
  return sum / weights;
}

Response simulate_in_time(const fs::path& folder, ModelLibrary& library, double w,
                          double take_off) {
  const fs::path file = folder / "mechanism.yaml";
  std::ofstream(file) << fmt::format(R"(mechanism: absorber
sea: {{waves: {{regular: {{amplitude: {} m, frequency: {} rad/s}}, ramp: 60 s}}}}
vessels:
  ring: {{model: vessels/absorber-float, database: absorber.h5, database_body: float}}
  spar:
    model: vessels/absorber-spar
    database: absorber.h5
    restraint:
      stiffness:
        - [100 kN/m, 0, 0, 0, 0, 0]
        - [0, 100 kN/m, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 100 MN m/rad]
loops:
  guide: {{kind: prismatic, first: {{body: spar}}, second: {{body: ring}}, axis: [0, 0, 1]}}
springs:
  take_off: {{kind: point, from: {{body: spar, position: [0 m, 0 m, -20 m]}}, to: {{body: ring}},
             free_length: 20 m, stiffness: 0 N/m, damping: {} N s/m}}
simulate: {{duration: {} s, relative_tolerance: 1e-6, sample_interval: {} s}}
outputs:
  ring: {{point: {{body: ring, position: [0 m, 0 m, -0.5 m]}}}}
  spar: {{point: {{body: spar, position: [0 m, 0 m, -17 m]}}}}
)",
                                     wave_amplitude, w, take_off, joint_run_s, joint_sample_s);
  Diagnostics diagnostics;
  const auto read = read_mechanism(file, library, diagnostics);
  if (!read) throw InputError(diagnostics);
  const MechanismRun run = run_mechanism(*read, {});
  const auto amplitude = [&](std::size_t output, Eigen::Index column) {
    return harmonic_of(run.outputs.at(output).values.col(column), w) / wave_amplitude;
  };
  return {amplitude(0, 2), amplitude(1, 2), amplitude(0, 0)};
}

// The memory is fitted to half a per cent; the figures are complex, so that phases count too.
std::vector<VerificationRow> absorber_rows() {
  ModelLibrary library = ModelLibrary::of_installation();
  const AbsorberFile absorber = compute_absorber(library);
  const ScratchFolder folder;
  write_hydrodynamic_file(folder.path() / "absorber.h5", absorber.file);
  const std::vector<double>& frequencies = absorber.file.series.databases.front().frequencies;
  std::vector<VerificationRow> rows;
  for (const double wanted : {0.6, 0.9, 1.2}) {
    std::size_t k = 0;
    while (frequencies[k] < wanted - 1e-6) ++k;
    for (const double take_off : {0.0, 1.2e6}) {
      const Response exact = solve_in_frequency(absorber, k, take_off);
      const Response found = simulate_in_time(folder.path(), library, frequencies[k], take_off);
      const auto add = [&](const char* what, Complex reference, Complex computed) {
        VerificationRow row = compare(
            fmt::format("{}, {} rad/s, power take-off {} kN s/m", what, wanted, take_off / 1e3),
            "m/m", std::abs(reference), std::abs(computed), 0.01 * std::abs(reference));
        row.error = std::abs(computed - reference);
        rows.push_back(row);
      };
      add("heave of the ring", exact.float_heave, found.float_heave);
      add("ring's way along the spar", exact.float_heave - exact.spar_heave,
          found.float_heave - found.spar_heave);
      add("surge of the ring", exact.float_surge, found.float_surge);
    }
  }
  return rows;
}

}  // namespace

VerificationCase bodies_at_a_joint() {
  return {.name = "bodies-at-a-joint",
          .stage = "hydrodynamics",
          .source = "equations of motion in the frequency domain, solved by themselves",
          .compute = absorber_rows};
}

}  // namespace blocklift::pipeline

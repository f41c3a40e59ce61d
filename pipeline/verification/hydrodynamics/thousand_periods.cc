#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include "pipeline/simulation/mechanism_run.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/hydrodynamics/scratch_folder.h"

namespace blocklift::pipeline {
namespace {

constexpr double wave_period = 6.0, sample_step = 0.5;

/// First harmonic of the heave over 20 periods that begin after `periods` of them.
std::complex<double> first_harmonic(const Eigen::MatrixXd& place, int periods) {
  const int each = static_cast<int>(wave_period / sample_step), count = 20 * each;
  std::complex<double> sum = 0.0;
  for (int k = 1; k <= count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / each;
    sum += 2.0 / count * place(periods * each + k, 2) * std::polar(1.0, -angle);
  }
  return sum;
}

// A sphere on soft springs in a regular wave: once settled it must neither grow nor fade, and what
// the waves give must be what they take back. What goes astray of the account of energy is what the
// steps leave, no loss of the model: 8e-3, 4e-4 and 7e-5 of what swings with tolerances of 1e-7, 1e-8
// and 1e-9.
std::vector<VerificationRow> thousand_period_rows() {
  ModelLibrary library = ModelLibrary::of_installation();
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "mechanism.yaml";
  std::ofstream(file) << R"(mechanism: thousand-periods
sea:
  density: 1000 kg/m^3
  waves: {regular: {amplitude: 0.5 m, period: 6 s}, ramp: 30 s}
  radiation: {lowest_frequency: 0.6 rad/s, highest_frequency: 3.2 rad/s, frequencies: 27}
vessels:
  sphere:
    model: vessels/sphere-5m
    draught: 0 m
    restraint:
      stiffness:
        - [20 kN/m, 0, 0, 0, 0, 0]
        - [0, 20 kN/m, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 1 MN m/rad]
simulate: {duration: 6000 s, relative_tolerance: 1e-9, sample_interval: 0.5 s}
outputs: {place: {point: {body: sphere}}, imbalance: {energy: imbalance}}
)";
  Diagnostics diagnostics;
  const auto read = read_mechanism(file, library, diagnostics);
  if (!read) throw InputError(diagnostics);
  const MechanismRun run = run_mechanism(*read, {});
  const Eigen::MatrixXd& place = run.outputs.at(0).values;
  const std::complex<double> settled = first_harmonic(place, 200),
                             last = first_harmonic(place, 980);
  const double stiffness = 1000.0 * 9.80665 * std::numbers::pi * 25.0;
  const double swings = 0.5 * stiffness * std::norm(last);
  return {bound("sphere in a regular wave, heave of the periods 980 to 1000 beside 200 to 220, "
                "relative",
                "1", std::abs(last - settled) / std::abs(settled), 3e-4, "steady oscillation"),
          bound("energy astray in 1000 periods, over what swings", "1",
                run.outputs.at(1).values.cwiseAbs().maxCoeff() / swings, 1e-4,
                "conservation of energy")};
}

}  // namespace

VerificationCase thousand_periods() {
  return {.name = "thousand-periods",
          .stage = "hydrodynamics",
          .source = "conservation of energy",
          .compute = thousand_period_rows};
}

}  // namespace blocklift::pipeline

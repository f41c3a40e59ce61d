#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;

/// The pontoons of the launch, side by side.
constexpr double barge_length = 110.0, barge_breadth = 46.0, barge_draught = 4.6, gap_width = 16.0;
const Water gap_water{1025.0, 9.81};

// Water in the gap as a sum of modes sin(q x), no potential at the open ends; the barges' bottoms
// as a plane without end, through whose slot the water is sucked. J is q times the mean of the
// potential in the slot, weighted with the mode, over the velocity there:
//   J = q/(pi b L) int [(L - s) cos q s + sin(q s)/q] [2 b asinh(b/s) - 2 (sqrt(s^2 + b^2) - s)] ds.
double end_correction(double q) {
  constexpr int count = 4000;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    // s = L t^2 takes the logarithm away.
    const double t = (i + 0.5) / count, s = barge_length * t * t;
    const double along = (barge_length - s) * std::cos(q * s) + std::sin(q * s) / q;
    const double across =
        2.0 * gap_width * std::asinh(gap_width / s) - 2.0 * (std::hypot(s, gap_width) - s);
    sum += along * across * 2.0 * barge_length * t / count;
  }
  return q / (std::numbers::pi * gap_width * barge_length) * sum;
}

double gap_frequency(int half_waves) {
  const double q = half_waves * std::numbers::pi / barge_length;
  const double J = end_correction(q), down = std::tanh(q * barge_draught);
  return std::sqrt(gap_water.gravity * q * (1.0 + J * down) / (J + down));
}

struct GapSwing {
  double frequency = 0.0, rate = 0.0;  ///< rad/s
  int panels = 0;
};

// Heave of both barges together, A + B/(i w) about the resonance: a pole and a parabola.
GapSwing swing_between_barges(const HydrodynamicDatabase& database) {
  const auto count = static_cast<Eigen::Index>(database.frequencies.size()) - 1;
  Eigen::MatrixXcd columns(count, 5);
  Eigen::VectorXcd values(count);
  const Eigen::Index other = modes_per_body + heave;
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto index = static_cast<std::size_t>(k) + 1;  // the first is the lowest of the march
    const double w = database.frequencies[index], x = w / database.frequencies.back() - 1.0;
    const Eigen::MatrixXd &A = database.added_mass[index], &B = database.damping[index];
    const std::complex<double> mass(A(heave, heave) + A(heave, other),
                                    -(B(heave, heave) + B(heave, other)) / w);
    columns.row(k) << mass, 1.0, x, x * x, x * x * x;
    values[k] = w * mass;
  }
  const Eigen::VectorXcd found = columns.colPivHouseholderQr().solve(values);
  return {found[0].real(), found[0].imag(), 0};
}

GapSwing compute_gap(int panels_across, double lid_rate) {
  const PanelMesh hull = expand_symmetry(
      make_box_hull(barge_length, barge_breadth, barge_draught,
                    {5 * panels_across / 2, panels_across, panels_across / 4, 2.5}));
  const Vector3 aside(0, 0.5 * (barge_breadth + gap_width), 0);
  const std::vector<WettedBody> bodies{{"starboard", translate(hull, -aside), -aside},
                                       {"port", translate(hull, aside), aside}};
  DatabaseSettings settings;
  settings.frequencies = {0.35};
  const double expected = gap_frequency(1);
  for (int k = -5; k <= 5; ++k) settings.frequencies.push_back(expected * (1.0 + 0.02 * k));
  settings.duration = 300.0;
  if (lid_rate > 0.0) {
    settings.lids = {
        {{-0.5 * barge_length, -0.5 * gap_width}, {0.5 * barge_length, 0.5 * gap_width}, lid_rate}};
  }
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double w) {
    return 2.0 * std::numbers::pi / calc_wave_number(w, gap_water);
  };
  const SurfaceMesh surface =
      make_surface_mesh(lines, surface_settings(lines, length(settings.frequencies.back()),
                                                length(settings.frequencies.front())));
  const PanelModel model(bodies, surface, gap_water, {true, true});
  GapSwing swing = swing_between_barges(compute_database(model, settings));
  swing.panels = 4 * (model.body_mesh().size() + model.surface_mesh().size());
  return swing;
}

std::vector<VerificationRow> gap_rows() {
  std::vector<VerificationRow> rows;
  const double frequency = gap_frequency(1);
  const GapSwing coarse = compute_gap(12, 0.0), fine = compute_gap(20, 0.0),
                 damped = compute_gap(20, 0.03);
  for (const GapSwing& swing : {coarse, fine}) {
    rows.push_back(compare(fmt::format("first mode of the gap, {} panels", swing.panels), "rad/s",
                           frequency, swing.frequency, 0.04 * frequency,
                           "Molin et al. (2002): bottoms without end"));
  }
  rows.push_back(compare("first mode, 12 panels across against 20", "rad/s", fine.frequency,
                         coarse.frequency, 0.01 * fine.frequency, "convergence"));
  rows.push_back(compare("first mode under a lid of 0.03 1/s", "rad/s", fine.frequency,
                         damped.frequency, 0.01 * fine.frequency,
                         "a lid leaves the natural frequency as it is"));
  rows.push_back(compare("rate of fading, lid of 0.03 1/s less that of none", "1/s", 0.03,
                         damped.rate - fine.rate, 0.1 * 0.03, "exp(-rate t)"));
  return rows;
}

}  // namespace

VerificationCase gap_between_barges() {
  return {.name = "gap-between-barges",
          .stage = "hydrodynamics",
          .source = "Molin, Remy, Kimmoun and Stassen (2002), Applied Ocean Research 24",
          .compute = gap_rows};
}

}  // namespace blocklift::pipeline

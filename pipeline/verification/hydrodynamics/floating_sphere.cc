#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/marine/green/hull_equations.h"
#include "pipeline/verification/hydrodynamics/hydrodynamics_cases.h"
#include "pipeline/verification/models/hemisphere.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;
using examples::Hemisphere;
using examples::hulme;
using examples::make_hemisphere;

using std::numbers::pi;

/// The figures of a database beside those of the table; the tolerance is a share of each, or of a
/// tenth of the added mass where that is more: the damping dies out where nobody feels it.
std::vector<VerificationRow> table_rows(const HydrodynamicDatabase& database,
                                        const std::string& by) {
  const double mass = 2.0 / 3.0 * pi;
  std::vector<VerificationRow> rows;
  for (std::size_t k = 0; k < hulme.size(); ++k) {
    const examples::HemisphereRow& row = hulme[k];
    const double w = database.frequencies[k];
    const auto add = [&](const char* what, double exact, double found, double scale,
                         const char* source) {
      rows.push_back(compare(fmt::format("{}, k a {}, {}", what, row.ka, by), "1", exact, found,
                             0.02 * std::max(std::abs(exact), 0.1 * scale), source));
    };
    const Eigen::MatrixXd &A = database.added_mass[k], &B = database.damping[k];
    const char* const multipoles = "multipole expansion, four digits";
    add("A heave / (rho V)", row.heave_A, A(heave, heave) / mass, row.heave_A, "");
    add("B heave / (rho V w)", row.heave_B, B(heave, heave) / mass / w, row.heave_A, "");
    add("A surge / (rho V)", row.surge_A, A(surge, surge) / mass, row.surge_A, multipoles);
    add("B surge / (rho V w)", row.surge_B, B(surge, surge) / mass / w, row.surge_A, multipoles);
  }
  return rows;
}

/// Largest error of all rows over their tolerance of 2 %, in per cent.
double largest_error(const std::vector<VerificationRow>& rows) {
  double largest = 0.0;
  for (const VerificationRow& row : rows)
    largest = std::max(largest, 2.0 * row.error / row.tolerance);
  return largest;
}

// Newman (1977), eq. 6.173: the power that damping takes is that of the waves far away, whose
// amplitude follows from the excitation: B = k/(8 pi rho g V_g) int |X|^2 d theta. For heave of a
// round body |X| is the same from all sides, for surge it goes with cos theta.
void add_energy(const HydrodynamicDatabase& database, std::vector<VerificationRow>& rows) {
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
    const double w = database.frequencies[k], group_velocity = 0.5 / w;
    const double factor = w * w / (8.0 * pi * group_velocity);
    const Eigen::MatrixXcd X = database.excitation(k);
    const double scale = 0.02 * w * database.added_mass[k](heave, heave);
    rows.push_back(compare(fmt::format("B heave by the waves far away, k a {}", hulme[k].ka),
                           "kg/s", factor * 2.0 * pi * std::norm(X(heave, 0)),
                           database.damping[k](heave, heave), scale, "Newman (1977), eq. 6.173"));
    rows.push_back(compare(
        fmt::format("B surge by the waves far away, k a {}", hulme[k].ka), "kg/s",
        factor * pi * std::norm(X(surge, 0)), database.damping[k](surge, surge),
        0.02 * database.damping[k](surge, surge) + 0.1 * scale, "Newman (1977), eq. 6.173"));
  }
}

// The march shifts a frequency w by w (w dt)^2/24: a quarter of a per cent at the highest one.
void add_ogilvie(const HydrodynamicDatabase& database, std::vector<VerificationRow>& rows) {
  for (const int mode : {surge, heave}) {
    const char* const name = mode == surge ? "surge" : "heave";
    double integral = 0.0, peak = 0.0, mass = 0.0, damping = 0.0;
    for (std::size_t n = 0; n < database.retardation.size(); ++n) {
      const double K = database.retardation[n](mode, mode);
      integral += (n == 0 ? 0.5 : 1.0) * database.time_step * K;
      peak = std::max(peak, std::abs(K));
    }
    for (std::size_t k = 0; k < hulme.size(); ++k) {
      Eigen::MatrixXd A, B;
      calc_added_mass_and_damping(database, database.frequencies[k], A, B);
      const double scale = A(mode, mode), w = database.frequencies[k];
      mass = std::max(mass, std::abs(database.added_mass[k](mode, mode) / scale - 1.0));
      damping = std::max(damping,
                         std::abs(database.damping[k](mode, mode) - B(mode, mode)) / (scale * w));
    }
    const std::string source = "Ogilvie (1964)";
    rows.push_back(bound(fmt::format("integral of K over its peak, {}", name), "s", integral / peak,
                         3e-3, source));
    rows.push_back(
        bound(fmt::format("A from K, largest difference, {}", name), "1", mass, 0.01, source));
    rows.push_back(bound(fmt::format("B from K over A w, largest difference, {}", name), "1",
                         damping, 0.01, source));
  }
}

// Another method, with unknowns on the hull alone, of the same panels.
void add_hull_alone(const PanelModel& model, std::vector<VerificationRow>& rows) {
  const std::string by = fmt::format("{} panels of the hull alone", 4 * model.body_mesh().size());
  const HullEquations equations(model, {});
  HydrodynamicDatabase database;
  for (const examples::HemisphereRow& row : hulme) {
    const double w = std::sqrt(row.ka);
    const Eigen::MatrixXcd force = equations.calc_radiation(equations.solve(w), w);
    database.frequencies.push_back(w);
    database.damping.emplace_back(force.real());
    database.added_mass.emplace_back(force.imag() / w);
  }
  for (VerificationRow& row : table_rows(database, by)) rows.push_back(std::move(row));
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd impulse =
      equations.calc_radiation(equations.solve(infinite), infinite).real();
  const double mass = 2.0 / 3.0 * pi;
  rows.push_back(
      compare("A_inf heave / (rho V), " + by, "1", 0.5, impulse(heave, heave) / mass, 0.01 * 0.5));
  rows.push_back(compare("A_inf surge / (rho V), " + by, "1", 0.2732, impulse(surge, surge) / mass,
                         0.01 * 0.2732));
}

std::vector<VerificationRow> hemisphere_rows() {
  const auto by_unknowns = [](const HydrodynamicDatabase& database, int unknowns) {
    return table_rows(database, fmt::format("{} unknowns", unknowns));
  };
  const auto compute = [](const examples::HemisphereDivision& division, int& unknowns) {
    const Hemisphere sphere = make_hemisphere(1.0, division, {1.0, 1.0});
    unknowns = sphere.unknowns;
    return examples::compute_unit_database(sphere.model);
  };
  int coarse_unknowns = 0, unknowns = 0, fine_unknowns = 0;
  const double coarse =
      largest_error(by_unknowns(compute({24, 8, 0.09}, coarse_unknowns), coarse_unknowns));
  const HydrodynamicDatabase database = compute({48, 18, 0.04}, unknowns);
  const double fine =
      largest_error(by_unknowns(compute({64, 24, 0.03, 1.08}, fine_unknowns), fine_unknowns));
  std::vector<VerificationRow> rows = by_unknowns(database, unknowns);
  const double middle = largest_error(rows);
  rows.push_back(bound(fmt::format("largest error, {} over {} unknowns", unknowns, coarse_unknowns),
                       "1", middle / coarse, 0.6));
  rows.push_back(bound(fmt::format("largest error, {} over {} unknowns", fine_unknowns, unknowns),
                       "1", fine / middle, 0.8));
  add_energy(database, rows);
  add_ogilvie(database, rows);
  add_hull_alone(make_hemisphere(1.0, {48, 18, 0.04}, {1.0, 1.0}).model, rows);
  return rows;
}

/// Extrema of the decay, direct and by Cummins' equation, with one discretisation.
struct Decay {
  std::vector<Extremum> direct, convolved;
  int unknowns = 0;
};

HydrodynamicDatabase decay_database(const Hemisphere& sphere) {
  DatabaseSettings settings;
  settings.frequencies = {0.5, 1.0, 1.5, 2.0, 2.5};
  settings.damping_strength = 0.35;
  settings.duration = 30.0;
  settings.time_step = 0.05;
  return compute_database(sphere.model, settings);
}

Decay compute_decay(const examples::HemisphereDivision& division) {
  const Hemisphere sphere = make_hemisphere(5.0, division, {1000.0, 9.81}, -2.0);
  DirectRadiation::Settings direct;
  direct.damping_strength = 0.35;
  DirectRadiation radiation(sphere.model, direct);
  const LinearFloatation bodies = examples::task_10();
  return {find_extrema(march_directly(bodies, radiation, 0.05, 10.0), heave),
          find_extrema(march_with_database(bodies, decay_database(sphere), 0.05, 10.0), heave),
          sphere.unknowns};
}

// Five codes' extrema span periods of 4.37 to 4.45 s and a second crest of 0.632 to 0.651 m. Exact
// linear theory (multipole solution): the figures below. Both ways, one discretisation: they differ
// by the time step alone. Instants follow from samples 0.05 s apart: a fifth of that is asked.
std::vector<VerificationRow> decay_rows() {
  constexpr std::array<Extremum, 4> exact = {
      {{2.214, -.8670}, {4.421, .6347}, {6.602, -.4645}, {8.776, .3462}}};
  const Decay decay = compute_decay({40, 14, 0.05});
  std::vector<VerificationRow> rows;
  const std::string band = "Wendt et al. (2019), IEA OES Task 10: five codes' band";
  const std::string theory = "linear theory, multipole expansion";
  if (decay.direct.size() < 4 || decay.convolved.size() < 4) return rows;
  rows.push_back(compare("second crest, time", "s", 4.41, decay.direct[1].time, 0.04, band));
  rows.push_back(compare("second crest, height", "m", 0.6415, decay.direct[1].value, 0.0095, band));
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string what = fmt::format("extremum {}, {} unknowns, ", k + 1, decay.unknowns);
    rows.push_back(compare(what + "marched directly", "m", exact[k].value, decay.direct[k].value,
                           2e-3, theory));
    rows.push_back(compare(what + "Cummins' equation", "m", exact[k].value,
                           decay.convolved[k].value, 2e-3, theory));
    rows.push_back(compare(what + "time", "s", exact[k].time, decay.direct[k].time, 1e-2, theory));
    rows.push_back(bound(what + "difference of both ways", "m",
                         std::abs(decay.direct[k].value - decay.convolved[k].value), 1e-3));
  }
  const Hemisphere sphere = make_hemisphere(5.0, {24, 8, 0.09}, {1000.0, 9.81}, -2.0);
  const HydrodynamicDatabase database = decay_database(sphere);
  const LinearFloatation bodies = examples::task_10();
  const auto height = [&](double step) {
    return march_with_database(bodies, database, step, 8.0).position.back()[heave];
  };
  const double reference = height(0.01);
  double last = std::abs(height(0.4) - reference);
  for (const double step : {0.2, 0.1, 0.05}) {
    const double error = std::abs(height(step) - reference);
    rows.push_back(bound(fmt::format("error at a step of {} s over that of twice the step", step),
                         "1", error / last, 0.35, "convolution independent of the step"));
    last = error;
  }
  rows.push_back(bound("height at 8 s, steps of 0.05 s and 0.01 s", "m", last, 1e-4,
                       "convolution independent of the step"));
  return rows;
}

}  // namespace

VerificationCase floating_hemisphere() {
  return {.name = "floating-hemisphere",
          .stage = "hydrodynamics",
          .source = "Hulme (1982), J. Fluid Mech. 121",
          .compute = hemisphere_rows};
}

VerificationCase free_decay_of_a_sphere() {
  return {.name = "free-decay-of-a-sphere",
          .stage = "hydrodynamics",
          .source = "Wendt et al. (2019), IEA OES Task 10",
          .compute = decay_rows};
}

}  // namespace blocklift::pipeline

#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/errors.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/dynamics/dynamics_cases.h"
#include "pipeline/verification/models/rope_lifts.h"

namespace blocklift::pipeline {
namespace {

using namespace dynamics;
using examples::g;
using examples::SingleRopeLift;

constexpr double pi = std::numbers::pi;

double weight_of(const SingleRopeLift& model) { return model.mass * g; }
double height_at_rest(const SingleRopeLift& model) {
  return -model.length - weight_of(model) / model.stiffness();
}

/// Instants at which the load passes a height upwards, from Hermite's cubic between samples.
std::vector<double> upward_passages(const History& history, double height) {
  std::vector<double> times;
  const BodyHistory& load = history.bodies[0];
  for (Eigen::Index i = 0; i + 1 < history.sample_count(); ++i) {
    const double h = history.time[i + 1] - history.time[i];
    const double z0 = load.pose(i, 2) - height, z1 = load.pose(i + 1, 2) - height;
    if (!(z0 < 0.0 && z1 >= 0.0)) continue;
    const double m0 = h * load.velocity(i, 5), m1 = h * load.velocity(i + 1, 5);
    const auto cubic = [&](double s) {
      return z0 + s * (m0 + s * (3 * (z1 - z0) - 2 * m0 - m1 + s * (2 * (z0 - z1) + m0 + m1)));
    };
    double low = 0.0, high = 1.0;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = 0.5 * (low + high);
      (cubic(middle) < 0.0 ? low : high) = middle;
    }
    times.push_back(history.time[i] + low * h);
  }
  return times;
}

/// Stretch under the load's weight with the crane's stiffness in series.
VerificationRow stretch_with_crane() {
  SingleRopeLift model;
  model.crane_stiffness = 3e6;
  const LiftSystem lift = model.build();
  EquilibriumSolver solver(lift);
  Eigen::VectorXd q = lift.q_start();
  solver.solve(0.0, q);
  const double stretch =
      weight_of(model) * (model.length / model.axial_stiffness + 1.0 / model.crane_stiffness);
  // The solver's own tolerance is 1e-10 of the weight.
  return compare("stretch of rope and crane in series", "m", stretch, -model.length - q[2],
                 1e-9 * stretch, "1/k = L/EA + 1/k0 (SIMO theory manual)");
}

/// Free oscillation about the rest, 10 mm to each side.
VerificationRow period_of_bounce() {
  const SingleRopeLift model;
  const LiftSystem lift = model.build();
  const double rest = height_at_rest(model);
  const IntegrationResult run = integrate(lift, Vector3(0, 0, rest - 0.01), lift.v_start(),
                                          {.relative_tolerance = 1e-11, .sample_interval = 0.002});
  const std::vector<double> passages = upward_passages(run.history, rest);
  if (passages.size() < 2) throw SimulationError("the load does not bounce");
  const double period = 2 * pi * std::sqrt(model.mass * model.length / model.axial_stiffness);
  const double found =
      (passages.back() - passages.front()) / static_cast<double>(passages.size() - 1);
  // Time is read off to (omega h)^4 / 384 = 2e-9 of a radian; the rest is the integration's error.
  return compare("period of the bounce", "s", period, found, 1e-7, "2 pi sqrt(m L / EA)");
}

/// Let go where the rope is unstretched: T = m g (1 - cos(omega t)).
VerificationRow dropped_load() {
  const SingleRopeLift model;
  const LiftSystem lift = model.build();
  const IntegrationResult run = integrate(lift, lift.q_start(), lift.v_start(),
                                          {.relative_tolerance = 1e-10, .sample_interval = 2e-4});
  // A sample misses the peak by (omega h / 2)^2 / 2 = 1e-6 of the weight at most.
  return compare("peak of a load let go at the unstretched length, over its weight", "1", 2.0,
                 find_largest_tensions(run.history)[0].tension / weight_of(model), 2e-6,
                 "T = m g (1 - cos(omega t))");
}

/// A winch that has its speed at once.
VerificationRow hoist_that_grips_at_once() {
  constexpr double speed = 0.05;
  SingleRopeLift model;
  model.payout = -0.05;
  model.limits = examples::abrupt(speed);
  const LiftSystem lift = model.build();
  const IntegrationResult run =
      integrate(lift, Vector3(0, 0, height_at_rest(model)), lift.v_start(),
                {.relative_tolerance = 1e-9, .sample_interval = 0.001});
  const double factor = 1.0 + speed * std::sqrt(model.stiffness() / (model.mass * g * g));
  // The first peak comes after a quarter of a period, 0.11 s, when the rope is 6 mm of 20 m shorter
  // and by that much stiffer, which the closed form leaves out.
  const double peak = run.history.ropes[0].tension.head(250).maxCoeff();
  return compare("dynamic factor of a hoist that grips at once", "1", factor,
                 peak / weight_of(model), 3e-4, "1 + v sqrt(k / (m g^2))");
}

/// Thrown upwards at 1 m/s from the unstretched length: slack in flight, taut in between.
std::vector<VerificationRow> instants_of_slack() {
  constexpr double u = 1.0;
  const SingleRopeLift model;
  const LiftSystem lift = model.build();
  const IntegrationResult run =
      integrate(lift, lift.q_start(), Vector3(0, 0, u), {.relative_tolerance = 1e-10});
  const double omega = std::sqrt(model.stiffness() / model.mass);
  const double flight = 2.0 * u / g;
  const double arc = 2.0 * (pi - std::atan(u * omega / g)) / omega;
  const double expected[] = {flight, flight + arc, 2 * flight + arc, 2 * (flight + arc)};
  if (run.events.size() < 4) throw SimulationError("the rope does not change four times");
  std::vector<VerificationRow> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string what = i % 2 == 0 ? "taut" : "slack";
    rows.push_back(compare("instant " + std::to_string(i + 1) + ", the rope goes " + what, "s",
                           expected[i], run.events[i].time, 1e-8,
                           "free flight 2 u / g; taut arc 2 (pi - atan(u omega / g)) / omega"));
  }
  return rows;
}

}  // namespace

VerificationCase load_on_a_rope() {
  return {.name = "load-on-a-rope", .stage = "dynamics", .source = "closed forms", .compute = [] {
            std::vector<VerificationRow> rows = {stretch_with_crane(), period_of_bounce(),
                                                 dropped_load(), hoist_that_grips_at_once()};
            for (VerificationRow& row : instants_of_slack()) rows.push_back(std::move(row));
            return rows;
          }};
}

}  // namespace blocklift::pipeline

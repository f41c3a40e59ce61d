#include "pipeline/measures/spreader_measures.h"

#include <algorithm>
#include <cmath>

namespace blocklift::pipeline {
namespace {

/// Load along a bar of length 2 h, w(x) = even + rising x, N/m.
struct LineLoad {
  Vector3 even = Vector3::Zero();
  Vector3 rising = Vector3::Zero();
};

/// What balances the forces as the weight and inertia of an even rod do.
LineLoad balancing(const std::vector<BarForce>& forces, double length) {
  Vector3 sum = Vector3::Zero(), moment = Vector3::Zero();
  for (const BarForce& force : forces) {
    sum += force.f_B;
    moment += force.p_BoQ_B.cross(force.f_B);
  }
  const double third = 12 / (length * length * length);
  return {-sum / length, {0, -third * moment.z(), third * moment.y()}};
}

/// Forces within the section at x, those of the ends at x itself counted or not.
structure::ColumnForces forces_at(const std::vector<BarForce>& forces, const LineLoad& load,
                                  double length, double x, bool with_own) {
  const double h = length / 2;
  Vector3 sum = load.even * (x + h) + load.rising * (x * x - h * h) / 2;
  // Of the line load about the section: its first moments over the part left of it.
  const Vector3 lever = -load.even * (x + h) * (x + h) / 2 +
                        load.rising * (h * h * h / 3 + x * h * h / 2 - x * x * x / 6);
  Vector3 moment = Vector3::UnitX().cross(lever);
  for (const BarForce& force : forces) {
    const double behind = x - force.p_BoQ_B.x();
    if (behind < 0 || (behind == 0 && !with_own)) continue;
    sum += force.f_B;
    moment += (force.p_BoQ_B - x * Vector3::UnitX()).cross(force.f_B);
  }
  return {sum.x(), {moment.y(), moment.z()}};
}

std::vector<BarForce> rope_forces(const LiftSpreader& bar, const dynamics::History& history,
                                  Eigen::Index sample) {
  const Eigen::Matrix3d R_WB = history.bodies[bar.body - 1].X_WB(sample).R;
  std::vector<BarForce> forces;
  for (const LiftSpreader::End& end : bar.ends) {
    const dynamics::RopeHistory& rope = history.ropes[end.rope];
    const Vector3 f_W = (end.last ? rope.last_force : rope.first_force).row(sample);
    forces.push_back({end.p_BoQ_B, R_WB.transpose() * f_W});
  }
  return forces;
}

/// The factor on the forces at which a column bears no more; bisected, since its moments grow faster
/// than they.
double growth_to_failure(const structure::Column& column, const structure::ColumnForces& forces) {
  double most = 1;
  while (structure::column_utilisation(column, forces, most) < 1) most *= 2;
  double least = 0;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (least + most) / 2;
    (structure::column_utilisation(column, forces, middle) < 1 ? least : most) = middle;
  }
  return least;
}

void add_spreader(const LiftCase& lift_case, const LiftRun& lift, const LiftSpreader& bar,
                  std::vector<LiftMeasure>& measures) {
  const structure::Column column = lift_case.find_spreader(bar.name)->column();
  const double factor = spreader_factor(lift_case.checks);
  LiftMeasure compression{.subject = bar.name,
                          .kind = "compression",
                          .unit = "N",
                          .meaning = "largest along the bar, negative where it is pulled"};
  LiftMeasure moment{.subject = bar.name,
                     .kind = "bending moment",
                     .unit = "N m",
                     .meaning = "largest along the bar, of its weight, inertia and eyes"};
  LiftMeasure share{.subject = bar.name,
                    .kind = "share of the resistance",
                    .unit = "1",
                    .meaning =
                        "compression with bending, times the factor, over what the bar "
                        "bears (EN 1993-1-1, 6.3.1.1 and 5.2.2(5))"};
  const auto fill = [&](const dynamics::History& history, Eigen::VectorXd LiftMeasure::*series) {
    for (LiftMeasure* one : {&compression, &moment, &share})
      (one->*series).resize(history.sample_count());
    for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
      const structure::ColumnForces forces =
          largest_forces(rope_forces(bar, history, i), column.length);
      (compression.*series)[i] = forces.compression;
      (moment.*series)[i] = std::hypot(forces.moments[0], forces.moments[1]);
      (share.*series)[i] = structure::column_utilisation(column, forces, factor);
    }
  };
  fill(lift.static_history, &LiftMeasure::at_rest);
  fill(lift.dynamic_history(), &LiftMeasure::in_motion);
  for (LiftMeasure* one : {&compression, &moment, &share}) measures.push_back(std::move(*one));
}

}  // namespace

structure::ColumnForces largest_forces(const std::vector<BarForce>& forces, double length) {
  constexpr int pieces = 20;
  const LineLoad load = balancing(forces, length);
  structure::ColumnForces largest;
  double pressed = 0, pulled = 0;
  const auto consider = [&](double x, bool with_own) {
    const structure::ColumnForces here = forces_at(forces, load, length, x, with_own);
    pressed = std::max(pressed, here.compression);
    pulled = std::min(pulled, here.compression);
    for (std::size_t i = 0; i < 2; ++i)
      largest.moments[i] = std::max(largest.moments[i], std::abs(here.moments[i]));
  };
  for (int i = 0; i <= pieces; ++i)
    consider(length * (static_cast<double>(i) / pieces - 0.5), true);
  for (const BarForce& force : forces) {
    consider(force.p_BoQ_B.x(), false);
    consider(force.p_BoQ_B.x(), true);
  }
  largest.compression = pressed > 0 ? pressed : pulled;
  return largest;
}

double largest_share(const structure::Column& column, const LiftSpreader& bar, const LiftRun& lift,
                     double factor) {
  double largest = 0;
  for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()})
    for (Eigen::Index i = 0; i < history->sample_count(); ++i)
      largest = std::max(
          largest,
          structure::column_utilisation(
              column, largest_forces(rope_forces(bar, *history, i), column.length), factor));
  return largest;
}

Eigen::VectorXd hung_load(const LiftSpreader& bar, const dynamics::History& history) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(history.sample_count());
  for (const LiftSpreader::End& end : bar.ends)
    if (!end.from_above)
      load -= (end.last ? history.ropes[end.rope].last_force : history.ropes[end.rope].first_force)
                  .col(2);
  return load;
}

double borne_load(const structure::Column& column, const LiftSpreader& bar,
                  const dynamics::History& history) {
  structure::ColumnForces worst;
  double largest = 0;
  Eigen::Index instant = 0;
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    const structure::ColumnForces forces =
        largest_forces(rope_forces(bar, history, i), column.length);
    const double share = structure::column_utilisation(column, forces, 1);
    if (!(share > largest)) continue;
    largest = share;
    worst = forces;
    instant = i;
  }
  const double load = hung_load(bar, history)[instant];
  return largest > 0 && load > 0 ? load * growth_to_failure(column, worst) : 0;
}

double spreader_factor(const CheckSettings& checks) {
  return checks.spreader_factor.value_or(checks.yield_factor);
}

void add_spreader_measures(const LiftCase& lift_case, const LiftRun& lift,
                           std::vector<LiftMeasure>& measures) {
  for (const LiftSpreader& bar : lift.model.spreaders) add_spreader(lift_case, lift, bar, measures);
}

}  // namespace blocklift::pipeline

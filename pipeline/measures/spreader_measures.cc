#include "pipeline/measures/spreader_measures.h"

#include <algorithm>
#include <cmath>

namespace blocklift::pipeline {
namespace {

using structure::PointForce;

void add_spreader(const LiftCase& lift_case, const LiftRun& lift, const LiftSpreader& spreader,
                  std::vector<LiftMeasure>& measures) {
  const given::Spreader& in_case = *lift_case.find_spreader(spreader.name);
  const SpreaderStrength strength = strength_in_place(in_case, spreader);
  const double factor = spreader_factor(lift_case.checks);
  const bool is_frame = in_case.is_frame();
  LiftMeasure compression{.subject = spreader.name,
                          .kind = "compression",
                          .unit = "N",
                          .meaning = is_frame
                                         ? "largest within its sides, negative where all are pulled"
                                         : "largest along the bar, negative where it is pulled"};
  LiftMeasure moment{.subject = spreader.name,
                     .kind = "bending moment",
                     .unit = "N m",
                     .meaning = is_frame
                                    ? "largest within its sides, of its corners, weight and inertia"
                                    : "largest along the bar, of its weight, inertia and eyes"};
  LiftMeasure torsion{.subject = spreader.name,
                      .kind = "torsion moment",
                      .unit = "N m",
                      .meaning = "largest within its sides"};
  LiftMeasure share{
      .subject = spreader.name,
      .kind = "share of the resistance",
      .unit = "1",
      .meaning = is_frame ? "compression with bending and torsion, times the factor, over what the "
                            "worst side bears (EN 1993-1-1, 6.3.1.1, 5.2.2(5) and 6.2.1(5))"
                          : "compression with bending, times the factor, over what the bar bears "
                            "(EN 1993-1-1, 6.3.1.1 and 5.2.2(5))"};
  const auto fill = [&](const dynamics::History& history, Eigen::VectorXd LiftMeasure::*series) {
    for (LiftMeasure* one : {&compression, &moment, &torsion, &share})
      (one->*series) = Eigen::VectorXd::Zero(history.sample_count());
    for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
      const SpreaderForces forces = strength.find_forces(forces_on_spreader(spreader, history, i));
      (compression.*series)[i] = forces.front().column.compression;
      for (const structure::MemberForces& one : forces) {
        const structure::ColumnForces& within = one.column;
        (compression.*series)[i] = std::max((compression.*series)[i], within.compression);
        (moment.*series)[i] =
            std::max((moment.*series)[i], std::hypot(within.moments[0], within.moments[1]));
        (torsion.*series)[i] = std::max((torsion.*series)[i], one.torsion);
      }
      (share.*series)[i] = strength.utilisation(forces, factor);
    }
  };
  fill(lift.static_history, &LiftMeasure::at_rest);
  fill(lift.dynamic_history(), &LiftMeasure::in_motion);
  for (LiftMeasure* one : {&compression, &moment, &torsion, &share})
    if (is_frame || one != &torsion) measures.push_back(std::move(*one));
}

}  // namespace

SpreaderStrength strength_in_place(const given::Spreader& in_its_place,
                                   const LiftSpreader& spreader) {
  std::vector<Vector3> points;
  for (const LiftSpreader::End& end : spreader.ends) points.push_back(end.p_BoQ_B);
  return {in_its_place, points};
}

std::vector<PointForce> forces_on_spreader(const LiftSpreader& spreader,
                                           const dynamics::History& history, Eigen::Index sample) {
  const Eigen::Matrix3d R_WB = history.bodies[spreader.body - 1].X_WB(sample).R;
  std::vector<PointForce> forces;
  for (const LiftSpreader::End& end : spreader.ends) {
    const dynamics::RopeHistory& rope = history.ropes[end.rope];
    const Vector3 f_W = (end.last ? rope.last_force : rope.first_force).row(sample);
    forces.push_back({end.p_BoQ_B, R_WB.transpose() * f_W});
  }
  return forces;
}

double growth_to_failure(const SpreaderStrength& strength, const SpreaderForces& forces) {
  double most = 1;
  while (strength.utilisation(forces, most) < 1) most *= 2;
  double least = 0;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (least + most) / 2;
    (strength.utilisation(forces, middle) < 1 ? least : most) = middle;
  }
  return least;
}

std::optional<Eigen::Index> worst_instant(const given::Spreader& in_its_place,
                                          const LiftSpreader& spreader,
                                          const dynamics::History& history) {
  const SpreaderStrength strength = strength_in_place(in_its_place, spreader);
  std::optional<Eigen::Index> worst;
  double largest = 0;
  for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
    const double share =
        strength.utilisation(strength.find_forces(forces_on_spreader(spreader, history, i)), 1);
    if (!(share > largest)) continue;
    largest = share;
    worst = i;
  }
  return worst;
}

double largest_share(const given::Spreader& in_its_place, const LiftSpreader& spreader,
                     const LiftRun& lift, double factor) {
  const SpreaderStrength strength = strength_in_place(in_its_place, spreader);
  double largest = 0;
  for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()})
    for (Eigen::Index i = 0; i < history->sample_count(); ++i)
      largest = std::max(
          largest, strength.utilisation(
                       strength.find_forces(forces_on_spreader(spreader, *history, i)), factor));
  return largest;
}

Eigen::VectorXd hung_load(const LiftSpreader& spreader, const dynamics::History& history) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(history.sample_count());
  for (const LiftSpreader::End& end : spreader.ends)
    if (!end.from_above)
      load -= (end.last ? history.ropes[end.rope].last_force : history.ropes[end.rope].first_force)
                  .col(2);
  return load;
}

double borne_load(const given::Spreader& in_its_place, const LiftSpreader& spreader,
                  const dynamics::History& history) {
  const std::optional<Eigen::Index> worst = worst_instant(in_its_place, spreader, history);
  if (!worst) return 0;
  const double load = hung_load(spreader, history)[*worst];
  if (!(load > 0)) return 0;
  const SpreaderStrength strength = strength_in_place(in_its_place, spreader);
  return load * growth_to_failure(
                    strength, strength.find_forces(forces_on_spreader(spreader, history, *worst)));
}

double spreader_factor(const CheckSettings& checks) {
  return checks.spreader_factor ? checks.spreader_factor->value : checks.yield_factor;
}

void add_spreader_measures(const LiftCase& lift_case, const LiftRun& lift,
                           std::vector<LiftMeasure>& measures) {
  for (const LiftSpreader& spreader : lift.model.spreaders)
    add_spreader(lift_case, lift, spreader, measures);
}

}  // namespace blocklift::pipeline

#include "pipeline/checks/frame_skew.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "pipeline/checks/frame_compliance.h"
#include "pipeline/checks/structure_skew.h"

namespace blocklift::pipeline {

namespace {

using structure::PointForce;

/// Places in LiftSpreader::ends.
struct EndsOfFrame {
  std::vector<std::size_t> above, below;
};

EndsOfFrame ends_of(const LiftSpreader& frame) {
  EndsOfFrame ends;
  for (std::size_t i = 0; i < frame.ends.size(); ++i)
    (frame.ends[i].from_above ? ends.above : ends.below).push_back(i);
  return ends;
}

/// The forces with a change of those from above; what hangs below each corner takes up its vertical
/// part, so that all stays in balance. None where nothing hangs there.
std::optional<std::vector<PointForce>> with_change(std::vector<PointForce> forces,
                                                   const EndsOfFrame& ends,
                                                   const DiagonalChange& change) {
  constexpr double same = 1e-3;  // m
  for (std::size_t i = 0; i < 4; ++i) {
    PointForce& upper = forces[ends.above[i]];
    upper.f += change[i];
    const auto lower = std::ranges::find_if(ends.below, [&](std::size_t one) {
      return (forces[one].p - upper.p).head<2>().norm() < same;
    });
    if (lower == ends.below.end()) return {};
    forces[*lower].f.z() -= change[i].z();
  }
  return forces;
}

}  // namespace

std::optional<double> frame_skew(const given::Spreader& in_case, const LiftSpreader& frame,
                                 const dynamics::History& at_rest,
                                 const std::function<double(int)>& skew_of) {
  const EndsOfFrame ends = ends_of(frame);
  if (!in_case.is_frame() || ends.above.size() != 4) return {};
  const std::optional<Eigen::Index> instant = worst_instant(in_case, frame, at_rest);
  if (!instant) return {};
  const std::vector<PointForce> forces = forces_on_spreader(frame, at_rest, *instant);
  std::array<DiagonalSling, 4> slings;
  for (std::size_t i = 0; i < 4; ++i) {
    const PointForce& pull = forces[ends.above[i]];
    slings[i] = {pull.p, pull.f, skew_of(frame.ends[ends.above[i]].rope)};
  }
  const auto changes = diagonal_changes(slings);
  if (!changes) return {};
  const SpreaderStrength strength = strength_in_place(in_case, frame);
  const double without = growth_to_failure(strength, strength.find_forces(forces));
  double least = without;
  for (const DiagonalChange& change : *changes) {
    const auto skewed = with_change(forces, ends, change);
    if (!skewed) return {};
    least = std::min(least, growth_to_failure(strength, strength.find_forces(*skewed)));
  }
  return without / least;
}

double frame_skew_by_tolerances(const given::Spreader& in_its_place, const LiftSpreader& frame,
                                const LiftCase& lift_case, const LiftRun& lift,
                                const TolerancedRigging& rigging, Eigen::Index sample) {
  std::vector<const given::Spreader*> spreaders;
  for (const LiftSpreader& one : lift.model.spreaders)
    spreaders.push_back(one.name == frame.name ? &in_its_place : lift_case.find_spreader(one.name));
  const RiggingBalance balance = balance_of(rigging, spreaders);
  const std::vector<PointForce> at_rest = forces_on_spreader(frame, lift.static_history, sample);
  const SpreaderStrength strength = strength_in_place(in_its_place, frame);
  const double without = growth_to_failure(strength, strength.find_forces(at_rest));
  double least = without;
  balance.visit_sets(rigging.tolerance, [&](const Eigen::VectorXd& tension) {
    std::vector<PointForce> forces = at_rest;
    for (std::size_t row = 0; row < rigging.in_system.size(); ++row) {
      const double as_meant = rigging.ropes[row].tension;
      if (!(as_meant > 0)) continue;
      for (std::size_t end = 0; end < forces.size(); ++end)
        if (frame.ends[end].rope == rigging.in_system[row])
          forces[end].f *= tension[row] / as_meant;
    }
    least = std::min(least, growth_to_failure(strength, strength.find_forces(forces)));
  });
  return without / least;
}

void find_frame_skew(const given::Spreader& in_its_place, const LiftSpreader& frame,
                     const LiftCase& lift_case, const LiftRun& lift, SpreaderFacts& facts) {
  facts.skew_by_rules.reset();
  facts.skew_computed.reset();
  if (!lift_case.standard || !in_its_place.is_frame()) return;
  const given::Standard& standard = *lift_case.standard;
  const NamedFactor* rule =
      standard.skew ? find_by_name(standard.rules.skew, standard.skew->value) : nullptr;
  if (rule && rule->value > 1)
    facts.skew_by_rules =
        frame_skew(in_its_place, frame, lift.static_history, [&](int) { return rule->value; });
  const given::Spreader& of_the_case = *lift_case.find_spreader(frame.name);
  const std::optional<Eigen::Index> worst = worst_instant(of_the_case, frame, lift.static_history);
  if (facts.rigging && worst)
    facts.skew_computed =
        frame_skew_by_tolerances(in_its_place, frame, lift_case, lift, *facts.rigging, *worst);
}

}  // namespace blocklift::pipeline

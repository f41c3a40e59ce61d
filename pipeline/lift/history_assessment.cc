#include "pipeline/lift/history_assessment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "parallel/threads.h"
#include "pipeline/lift/stopwatch.h"
#include "structure/error.h"
#include "structure/mesh/fields/fields.h"
#include "structure/stress/block_field.h"
#include "structure/stress/square_about.h"
#include "structure/stress_tensor.h"

namespace blocklift::pipeline {

namespace {

constexpr double rounding_percent = 1e-7;

using structure::TimedExtreme;
using structure::UnitResponses;
using structure::Vector3;

/// One history on its way to a HistoryState.
class StateMaker {
 public:
  StateMaker(const UnitResponses& responses, const BlockAttachment& attachment,
             const BlockHistory& history, std::string name)
      : responses_(responses),
        mass_(responses.model().mass_properties()),
        attachment_(attachment),
        history_(history),
        name_(std::move(name)) {}

  HistoryState make(const structure::StressRecovery& recovery) {
    load();
    const structure::BlockEnvelope envelope =
        structure::find_block_envelope(responses_, recovery, state_.factors);
    state_.places = envelope.places;
    state_.checked_von_mises = named(envelope.checked_von_mises);
    state_.field_von_mises = named(envelope.field_von_mises);
    state_.peak_von_mises = named(envelope.peak_von_mises);
    state_.largest_principal = named(envelope.largest_principal);
    state_.smallest_principal = named(envelope.smallest_principal);
    state_.displacement = named(envelope.displacement);
    for (const structure::GroupEnvelope& group : envelope.groups)
      state_.groups.push_back({group.group, group.material, group.yield_stress,
                               named(group.checked_von_mises), named(group.at_site)});
    for (const structure::LugEnvelope& lug : envelope.lugs)
      state_.lugs.push_back({lug.lug, {}, 0, named(lug.checked_von_mises), named(lug.at_site)});
    take_squares(recovery.checked(), envelope.squares);
    state_.governing =
        map_instant(history_, state_.checked_von_mises.at.instant, attachment_, mass_);
    state_.governing.name = fmt::format("largest {} checked stress of the lift", name_);
    return std::move(state_);
  }

 private:
  void load() {
    state_.time = history_.motion.time;
    state_.factors = factors_of(responses_, attachment_, history_);
    for (Eigen::Index sample = 0; sample < history_.sample_count(); ++sample)
      take_balance(map_instant(history_, sample, attachment_, mass_), sample);
  }

  // The last six factors are the rigid acceleration that a load case lacks in balance.
  void take_balance(const structure::LoadCase& load_case, Eigen::Index sample) {
    const auto lacking = state_.factors.col(sample).tail<6>();
    const Vector3 at_centre =
        lacking.head<3>() + Vector3(lacking.tail<3>()).cross(mass_.centre_of_mass_B);
    double load = mass_.mass * std::max(load_case.field.acceleration_less_gravity.norm(), 9.80665);
    double pull = 0;
    for (const Vector3& force : load_case.lug_forces_B) pull += force.norm();
    load = std::max(load, pull);
    const double gyration = std::sqrt(mass_.inertia_BBcm_B.trace() / (2 * mass_.mass));
    const double force = mass_.mass * at_centre.norm() / load;
    const double moment = (mass_.inertia_BBcm_B * lacking.tail<3>()).norm() / (load * gyration);
    if (!(force < largest_balance_residual && moment < largest_balance_residual))
      throw std::runtime_error(fmt::format(
          "the {} loads on the block at {:g} s are not in balance: force residual {:.1e}, moment "
          "residual {:.1e} (allowed {:.0e})",
          name_, history_.motion.time(sample), force, moment, largest_balance_residual));
    state_.largest_force_residual = std::max(state_.largest_force_residual, force);
    state_.largest_moment_residual = std::max(state_.largest_moment_residual, moment);
  }

  // The rope with the largest share in a stress, as its place in the attachment: among the ropes at
  // lugs, then the baskets.
  std::pair<int, double> governing_rope(const Eigen::MatrixXd& unit_stress, int instant) const {
    const std::vector<Vector3> forces = rope_forces(history_.motion, instant, attachment_);
    Eigen::MatrixXd parts =
        Eigen::MatrixXd::Zero(responses_.count(), forces.size() + attachment_.baskets.size());
    for (std::size_t i = 0; i < forces.size(); ++i)
      parts.col(i).segment<3>(3 * attachment_.ropes[i].lug) = forces[i];
    add_edges(instant, parts);
    Eigen::Index governing = 0;
    const double share = structure::stress_shares(unit_stress, parts, state_.factors.col(instant))
                             .maxCoeff(&governing);
    if (!(share > 0)) return {-1, 0};
    return {static_cast<int>(governing), share};
  }

  // What a rope does at edges, beside its force at the first of its lugs if it has one.
  void add_edges(int instant, Eigen::MatrixXd& parts) const {
    const std::vector<LugRope>& ropes = attachment_.ropes;
    const std::vector<int>& baskets = attachment_.baskets;
    for (std::size_t load = 0; load < attachment_.added_ropes.size(); ++load) {
      const int rope = attachment_.added_ropes[load];
      if (rope < 0) continue;
      const auto of = std::find_if(ropes.begin(), ropes.end(),
                                   [&](const LugRope& end) { return end.rope == rope; });
      const Eigen::Index place =
          of != ropes.end()
              ? of - ropes.begin()
              : static_cast<Eigen::Index>(ropes.size()) +
                    (std::find(baskets.begin(), baskets.end(), rope) - baskets.begin());
      // Factors of the basis: lug forces, products of angular velocities, added loads.
      const Eigen::Index row =
          3 * responses_.model().lug_count() + 6 + static_cast<Eigen::Index>(load);
      parts(row, place) += state_.factors(row, instant);
    }
  }

  HistoryExtreme named(const TimedExtreme& extreme) const {
    HistoryExtreme result{extreme, 0, {}, 0};
    if (extreme.instant < 0) return result;
    result.time = history_.motion.time(extreme.instant);
    if (extreme.unit_stress.size() == 0) return result;
    const auto [rope, share] = governing_rope(extreme.unit_stress, extreme.instant);
    if (rope < 0) return result;
    result.rope = names_of_ropes(history_.motion, attachment_)[rope];
    result.share = share;
    return result;
  }

  structure::BySite<HistoryExtreme> named(const structure::BySite<TimedExtreme>& extremes) const {
    structure::BySite<HistoryExtreme> result;
    for (const structure::SquareSite site : structure::square_sites)
      result[site] = named(extremes[site]);
    return result;
  }

  void take_squares(const structure::CheckedStress& checked,
                    const structure::PointExtremes& von_mises) {
    state_.square_von_mises = von_mises.value;
    state_.square_time.resize(von_mises.value.size());
    state_.square_rope.resize(von_mises.value.size());
    const auto take = [&](int first, int count) {
      for (int p = first; p < first + count; ++p) {
        state_.square_time[p] = history_.motion.time(von_mises.instant[p]);
        state_.square_rope[p] =
            governing_rope(structure::unit_stress_of_square(checked, p), von_mises.instant[p])
                .first;
      }
    };
    parallel::in_batches(static_cast<int>(von_mises.value.size()), 256, 0, take);
  }

  const UnitResponses& responses_;
  const structure::MassProperties& mass_;
  const BlockAttachment& attachment_;
  const BlockHistory& history_;
  std::string name_;
  HistoryState state_;
};

/// Per cent by which a practice lies above the envelope; where they are the same instant only
/// rounding is between them, which is no difference and differs with the number of threads.
double percent_of_practice(double practice, double envelope) {
  const double percent = percent_above(practice, envelope);
  return std::abs(percent) < rounding_percent ? 0 : percent;
}

// Of a block without squares a practice is compared where each has its largest stress.
PracticeComparison compare_largest(double practice, const structure::TimedExtreme& envelope) {
  PracticeComparison comparison;
  comparison.largest_percent = percent_of_practice(practice, envelope.value);
  comparison.worst_percent = comparison.largest_percent;
  comparison.worst = envelope;
  return comparison;
}

// A practice's checked stress at each square, set against the envelope.
PracticeComparison compare_practice(const structure::Mesh& mesh,
                                    const structure::CheckedStress& checked,
                                    const Eigen::VectorXd& practice,
                                    const Eigen::VectorXd& envelope) {
  PracticeComparison comparison;
  comparison.largest_percent = percent_of_practice(practice.maxCoeff(), envelope.maxCoeff());
  comparison.worst_percent = std::numeric_limits<double>::infinity();
  int looked_at = 0, short_of = 0;
  const double half_of_largest = 0.5 * envelope.maxCoeff();
  for (Eigen::Index p = 0; p < envelope.size(); ++p) {
    if (envelope[p] < half_of_largest) continue;
    ++looked_at;
    const double percent = percent_of_practice(practice[p], envelope[p]);
    if (percent < -1) ++short_of;
    if (percent >= comparison.worst_percent - rounding_percent) continue;
    const structure::Square& square = checked.squares()[p];
    comparison.worst_percent = percent;
    comparison.worst = {envelope[p], square.centre_B, mesh.regions[square.region].name};
  }
  comparison.squares_short = looked_at > 0 ? static_cast<double>(short_of) / looked_at : 0;
  return comparison;
}

int nearest_square(const structure::CheckedStress& checked, const Vector3& point) {
  const auto& squares = checked.squares();
  const auto nearest =
      std::min_element(squares.begin(), squares.end(), [&](const auto& a, const auto& b) {
        return (a.centre_B - point).squaredNorm() < (b.centre_B - point).squaredNorm();
      });
  return static_cast<int>(nearest - squares.begin());
}

// The unit normal of the plane that the largest principal stress acts on.
Vector3 principal_direction(const structure::Stress& s) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const auto [values, vectors] = algebra::symmetric_eigensystem(tensor);
  return vectors.col(std::abs(values[2]) >= std::abs(values[0]) ? 2 : 0);
}

// Stress in time of one place, by its unit responses (6 x unit loads, Pa); cycles are counted of
// the part along `normal`, or along the largest principal stress where none is given. The
// concentration raises ranges where the curve is read.
void fill_in(const Eigen::MatrixXd& unit, const Vector3* normal, const HistoryAssessment& history,
             double concentration, const structure::FatigueCurve& curve, StressHistory& result) {
  const auto von_mises = [&](const Eigen::MatrixXd& stress) {
    Eigen::VectorXd values(stress.cols());
    for (Eigen::Index t = 0; t < stress.cols(); ++t)
      values[t] = structure::von_mises(stress.col(t));
    return values;
  };
  const Eigen::MatrixXd at_rest = unit * history.static_state.factors;
  const Eigen::MatrixXd in_motion = unit * history.dynamic_state.factors;
  result.static_von_mises = von_mises(at_rest);
  result.dynamic_von_mises = von_mises(in_motion);
  Eigen::Index worst = 0;
  result.dynamic_von_mises.maxCoeff(&worst);
  const Eigen::Matrix<double, 1, 6> along =
      structure::normal_component(normal ? *normal : principal_direction(in_motion.col(worst)));
  result.static_normal = (along * at_rest).transpose();
  result.dynamic_normal = (along * in_motion).transpose();
  // Between two lifts the block is unloaded. Most operations begin and end with it on the hook, so
  // that the largest range of all, from none to the lift's stress, is in no sample.
  Eigen::VectorXd with_rest(result.dynamic_normal.size() + 1);
  with_rest << result.dynamic_normal, 0;
  result.cycles = structure::count_rainflow_of_repeated(with_rest);
  std::vector<structure::Cycles> raised = result.cycles;
  for (structure::Cycles& cycle : raised) cycle.range *= concentration;
  result.damage_per_lift = structure::damage(raised, curve);
}

int nearest_point(const structure::StressPoints& points, const Vector3& place) {
  int nearest = 0;
  for (int p = 1; p < points.count(); ++p)
    if ((points.place(p) - place).squaredNorm() < (points.place(nearest) - place).squaredNorm())
      nearest = p;
  return nearest;
}

std::vector<FollowedPoint> default_points(const HistoryState& state) {
  std::vector<FollowedPoint> points{{"hot spot", state.checked_von_mises.at.point_B}};
  for (const HistoryGroup& lug : state.lugs)
    if (lug.checked_von_mises.at.instant >= 0)
      points.push_back({lug.name, lug.checked_von_mises.at.point_B});
  return points;
}

// The stress in time of one square.
StressHistory follow_square(const structure::UnitResponses& responses,
                            const structure::CheckedStress& checked, int number,
                            const std::string& name, const HistoryAssessment& history) {
  const structure::Square& square = checked.squares()[number];
  StressHistory result;
  result.name = name;
  result.point_B = square.centre_B;
  result.part = responses.model().mesh().regions[square.region].name;
  const structure::Mesh& mesh = responses.model().mesh();
  const double thickness = mesh.section_of(mesh.shells[square.shell]).thickness;
  fill_in(structure::unit_stress_of_square(checked, number), nullptr, history,
          history.stress_concentration * history.curve.thickness_factor(thickness), history.curve,
          result);
  return result;
}

// Squares about chosen points; those that are checked lie up to half a metre apart in the middle of
// a plate. One of these is taken where it is as near.
std::vector<structure::Square> squares_about(const structure::Mesh& mesh,
                                             const structure::CheckedStress& checked,
                                             const std::vector<FollowedPoint>& points) {
  const structure::PlateFields fields = structure::find_fields(mesh);
  const structure::FieldWalker walker(mesh, fields);
  std::vector<structure::Square> squares;
  for (const FollowedPoint& point : points) {
    structure::Square square = checked.squares()[nearest_square(checked, point.point_B)];
    const auto about = structure::square_about(mesh, fields, walker, point.point_B, square.size);
    if (about &&
        (about->centre_B - point.point_B).norm() < (square.centre_B - point.point_B).norm())
      square = *about;
    squares.push_back(square);
  }
  return squares;
}

// Of a block without squares the nearest end of a bar or corner of a solid.
StressHistory follow_corner(const structure::UnitResponses& responses,
                            const structure::StressPoints& points, const FollowedPoint& point,
                            const HistoryAssessment& history) {
  const int p = nearest_point(points, point.point_B);
  StressHistory result;
  result.name = point.name;
  result.point_B = points.place(p);
  result.part = responses.model().mesh().regions[points.region(p)].name;
  fill_in(points.stresses(p, 1, responses.displacements()), nullptr, history,
          history.stress_concentration, history.curve, result);
  return result;
}

std::vector<StressHistory> follow(const structure::UnitResponses& responses,
                                  const structure::StressRecovery& recovery,
                                  const std::vector<FollowedPoint>& chosen,
                                  const HistoryAssessment& history) {
  const structure::CheckedStress& checked = recovery.checked();
  std::vector<StressHistory> result;
  if (checked.squares().empty()) {
    for (const FollowedPoint& point :
         chosen.empty() ? default_points(history.dynamic_state) : chosen)
      result.push_back(follow_corner(responses, recovery.points(), point, history));
  } else if (chosen.empty()) {
    for (const FollowedPoint& point : default_points(history.dynamic_state))
      result.push_back(follow_square(responses, checked, nearest_square(checked, point.point_B),
                                     point.name, history));
  } else {
    const structure::CheckedStress about(responses.model(), responses.displacements(),
                                         squares_about(responses.model().mesh(), checked, chosen));
    for (std::size_t p = 0; p < chosen.size(); ++p)
      result.push_back(
          follow_square(responses, about, static_cast<int>(p), chosen[p].name, history));
  }
  return result;
}

StressHistory follow(const structure::UnitResponses& responses, const FollowedHotSpot& followed,
                     const HistoryAssessment& history) {
  const structure::Space& space = responses.model().space();
  const structure::SteelFinder finder(space);
  StressHistory result;
  result.name = followed.name;
  result.point_B = followed.spot.toe;
  std::vector<Eigen::MatrixXd> unit;
  for (const Vector3& point : followed.spot.places()) {
    const structure::SteelPlace place = finder.find(point);
    if (place.cell < 0)
      throw structure::ModelError(
          fmt::format("hot spot {} is read at ({:.6g}, {:.6g}, {:.6g}) m, where the block has no "
                      "material; the toe lies on a plate's surface and the direction along it",
                      followed.name, point.x(), point.y(), point.z()));
    unit.push_back(structure::stresses_at(responses.model(), responses.displacements(), place));
    const structure::ShellCell& cell = space.shells()[place.cell];
    const structure::Shell& shell = space.mesh().shells[cell.shell];
    result.part = space.mesh().regions[shell.region].name;
  }
  fill_in(structure::hot_spot_stress(unit[0], unit[1]), &followed.spot.direction, history,
          history.hot_spot_curve.thickness_factor(followed.spot.thickness), history.hot_spot_curve,
          result);
  return result;
}

void compare_practices(const structure::UnitResponses& responses,
                       const structure::CheckedStress& checked, const BlockAssessment& block,
                       HistoryAssessment& result) {
  const structure::TimedExtreme& largest = result.dynamic_state.checked_von_mises.at;
  if (checked.squares().empty()) {
    double of_instants = 0;
    for (const LoadComparison& by_rope : block.simultaneous_by_rope)
      of_instants = std::max(of_instants, by_rope.dynamic_state.result.checked_von_mises.value);
    result.per_rope_maxima = compare_largest(
        block.per_rope_maxima.dynamic_state.result.checked_von_mises.value, largest);
    result.rope_instants = compare_largest(of_instants, largest);
    return;
  }
  const structure::Mesh& mesh = responses.model().mesh();
  const auto checked_in = [&](const BlockState& state) {
    return checked.von_mises(responses.coefficients(state.load));
  };
  const Eigen::VectorXd& envelope = result.dynamic_state.square_von_mises;
  result.per_rope_maxima =
      compare_practice(mesh, checked, checked_in(block.per_rope_maxima.dynamic_state), envelope);
  Eigen::VectorXd of_instants = Eigen::VectorXd::Zero(envelope.size());
  for (const LoadComparison& by_rope : block.simultaneous_by_rope)
    of_instants = of_instants.cwiseMax(checked_in(by_rope.dynamic_state));
  result.rope_instants = compare_practice(mesh, checked, of_instants, envelope);
}

}  // namespace

double HistoryAssessment::stress_increase_percent() const {
  return percent_above(dynamic_state.checked_von_mises.at.value,
                       static_state.checked_von_mises.at.value);
}

double HistoryAssessment::deformation_increase_percent() const {
  return percent_above(dynamic_state.displacement.at.value, static_state.displacement.at.value);
}

Eigen::MatrixXd factors_of(const structure::UnitResponses& responses,
                           const BlockAttachment& attachment, const BlockHistory& history) {
  Eigen::MatrixXd factors(responses.count(), history.sample_count());
  parallel::in_batches(static_cast<int>(history.sample_count()), 256, 0, [&](int first, int count) {
    for (Eigen::Index sample = first; sample < first + count; ++sample)
      factors.col(sample) = responses.coefficients(
          map_instant(history, sample, attachment, responses.model().mass_properties()));
  });
  return factors;
}

HistoryAssessment assess_history(const structure::UnitResponses& responses,
                                 const structure::StressRecovery& recovery,
                                 const BlockAttachment& attachment,
                                 const BlockHistory& static_history,
                                 const BlockHistory& dynamic_history, const BlockAssessment& block,
                                 const HistorySettings& settings) {
  Stopwatch watch;
  HistoryAssessment result;
  result.curve = structure::fatigue_curve(settings.fatigue_curve);
  result.stress_concentration = settings.stress_concentration;
  result.lifts = settings.lifts;
  result.ropes = names_of_ropes(dynamic_history.motion, attachment);
  result.static_state = StateMaker(responses, attachment, static_history, "static").make(recovery);
  result.dynamic_state =
      StateMaker(responses, attachment, dynamic_history, "dynamic").make(recovery);

  const structure::Mesh& mesh = responses.model().mesh();
  const structure::CheckedStress& checked = recovery.checked();
  result.squares = checked.squares();
  for (const structure::Region& region : mesh.regions) result.regions.push_back(region.name);
  result.weights = structure::response_weights(responses, recovery);
  compare_practices(responses, checked, block, result);

  result.points = follow(responses, recovery, settings.points, result);
  result.hot_spot_curve = structure::fatigue_curve(settings.hot_spot_curve);
  for (const FollowedHotSpot& spot : settings.hot_spots)
    result.hot_spots.push_back(follow(responses, spot, result));
  result.evaluation_s = watch.lap();
  return result;
}

}  // namespace blocklift::pipeline

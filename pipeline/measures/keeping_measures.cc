#include "pipeline/measures/keeping_measures.h"

#include <cmath>
#include <limits>
#include <variant>

#include "pipeline/measures/place_at.h"

namespace blocklift::pipeline {

namespace {

using dynamics::History;

double tension(const History& history, int rope, Eigen::Index sample) {
  return history.ropes[rope].tension[sample];
}

/// What is missed of a wish at the samples of one history.
class MissedAt {
 public:
  explicit MissedAt(const History& history) : history_(history) {}

  double operator()(const dynamics::KeptHeight& wish) {
    const double height =
        place_at(history_, wish.point, sample).z() - place_at(history_, wish.reference, sample).z();
    if (std::isnan(difference_)) difference_ = wish.difference.value_or(height);
    return height - difference_;
  }
  double operator()(const dynamics::KeptPlumb& wish) const {
    const Vector3 d =
        place_at(history_, wish.head, sample) - place_at(history_, wish.target, sample);
    return d.head<2>().norm();
  }
  double operator()(const dynamics::KeptTension& wish) const {
    return tension(history_, wish.rope, sample) - wish.tension;
  }
  double operator()(const dynamics::KeptShare& wish) const {
    const double own = tension(history_, wish.rope, sample);
    double sum = own;
    for (const int other : wish.others) sum += tension(history_, other, sample);
    return sum > 0 ? own / sum - wish.share : std::numeric_limits<double>::quiet_NaN();
  }
  /// What a law from outside is after is its own affair.
  double operator()(const dynamics::OwnLaw&) const {
    return std::numeric_limits<double>::quiet_NaN();
  }

  Eigen::Index sample = 0;

 private:
  const History& history_;
  double difference_ = std::numeric_limits<double>::quiet_NaN();  ///< m; that of the first sample
};

LiftMeasure describe(const LiftSteering& steering) {
  LiftMeasure measure;
  measure.subject = steering.drive;
  measure.extreme = Extreme::largest_magnitude;
  const auto say = [&](const char* kind, const char* unit, const char* meaning) {
    measure.kind = kind;
    measure.unit = unit;
    measure.meaning = meaning;
  };
  if (std::holds_alternative<dynamics::KeptHeight>(steering.wish))
    say("missed height", "m", "by how much the point is higher than this winch is to keep it");
  else if (std::holds_alternative<dynamics::KeptPlumb>(steering.wish))
    say("missed plumb", "m", "level distance of the head from the plumb over its point");
  else if (std::holds_alternative<dynamics::KeptTension>(steering.wish))
    say("missed tension", "N", "tension over the one that this winch is to keep");
  else
    say("missed share", "1", "share of the load over the one that this winch is to keep");
  return measure;
}

Eigen::VectorXd find_missed(const LiftSteering& steering, const History& history) {
  Eigen::VectorXd missed =
      Eigen::VectorXd::Constant(history.sample_count(), std::numeric_limits<double>::quiet_NaN());
  MissedAt missed_at(history);
  for (Eigen::Index i = 0; i < missed.size(); ++i) {
    if (history.time[i] < steering.start || history.time[i] > steering.end) continue;
    missed_at.sample = i;
    missed[i] = std::visit(missed_at, steering.wish);
  }
  return missed;
}

/// Values of a later stage in which the same drive keeps the same kind of thing.
void take_over(const Eigen::VectorXd& later, Eigen::VectorXd& values) {
  values = later.array().isNaN().select(values, later);
}

}  // namespace

void add_keeping_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  const std::size_t first = measures.size();
  for (const LiftSteering& steering : lift.model.steerings) {
    if (std::holds_alternative<dynamics::OwnLaw>(steering.wish)) continue;
    LiftMeasure measure = describe(steering);
    measure.at_rest = find_missed(steering, lift.static_history);
    measure.in_motion = find_missed(steering, lift.dynamic_history());
    bool known = false;
    for (std::size_t i = first; i < measures.size(); ++i) {
      if (measures[i].name() != measure.name()) continue;
      take_over(measure.at_rest, measures[i].at_rest);
      take_over(measure.in_motion, measures[i].in_motion);
      known = true;
    }
    if (!known) measures.push_back(std::move(measure));
  }
}

}  // namespace blocklift::pipeline

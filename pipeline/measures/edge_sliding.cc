#include "pipeline/measures/edge_sliding.h"

#include <cmath>
#include <limits>

#include "pipeline/measures/place_at.h"

namespace blocklift::pipeline {

namespace {

using dynamics::EdgeHistory;
using dynamics::History;
using dynamics::PlacedEdge;
using dynamics::Rope;
using Eigen::Index;

/// A rope at one of its edges, in the frame of the edge's body.
class EdgePassage {
 public:
  EdgePassage(const Rope& rope, const History& history, std::size_t rope_index, std::size_t edge)
      : rope_(rope),
        history_(history),
        touches_(history.ropes[rope_index].edges),
        edge_(edge),
        placed_(rope.edges()[edge].in_body()) {}

  double place(Index sample) const {
    return 0.5 * (touch().first_place[sample] + touch().last_place[sample]);
  }

  /// Finds the neighbours of a sample.
  void go_to(Index sample) {
    sample_ = sample;
    const std::size_t span = rope_.edges()[edge_].after;
    before_ = own_point(span);
    for (std::size_t e = edge_; e > 0 && rope_.edges()[e - 1].after == span; --e) {
      if (!touches_[e - 1].touches(sample)) continue;
      before_ = end_of(e - 1, true);
      break;
    }
    behind_ = own_point(span + 1);
    for (std::size_t e = edge_ + 1; e < touches_.size() && rope_.edges()[e].after == span; ++e) {
      if (!touches_[e].touches(sample)) continue;
      behind_ = end_of(e, false);
      break;
    }
  }

  /// Pull along the edge over that against it where the middle of the touch lies at a place, m.
  double pull_at(double held) const {
    const Vector3 shift = (held - place(sample_)) * placed_.along_W;
    const Vector3 first = end_of(edge_, false) + shift, last = end_of(edge_, true) + shift;
    const Vector3 force = touch().last_tension[sample_] * (behind_ - last).normalized() -
                          touch().first_tension[sample_] * (first - before_).normalized();
    const double along = force.dot(placed_.along_W);
    return along / (force - along * placed_.along_W).norm();
  }

 private:
  const EdgeHistory& touch() const { return touches_[edge_]; }

  Vector3 own_point(std::size_t point) const {
    const dynamics::Pose X_WB = pose_at(history_, rope_.edges()[edge_].body, sample_);
    return X_WB.R.transpose() * (place_at(history_, rope_.points()[point], sample_) - X_WB.p);
  }

  /// Where the rope comes to an edge or leaves it; all edges are the load's.
  Vector3 end_of(std::size_t edge, bool last) const {
    const EdgeHistory& at = touches_[edge];
    const double angle = last ? at.last_angle[sample_] : at.first_angle[sample_];
    const double place = last ? at.last_place[sample_] : at.first_place[sample_];
    return rope_.edges()[edge].in_body().point_W(angle, place);
  }

  const Rope& rope_;
  const History& history_;
  const std::vector<EdgeHistory>& touches_;
  std::size_t edge_;
  PlacedEdge placed_;
  Index sample_ = 0;
  Vector3 before_ = Vector3::Zero(), behind_ = Vector3::Zero();
};

/// The place between one that does not hold and the computed one at which friction just does.
double drag(const EdgePassage& passage, double held, double computed, double friction) {
  constexpr int halvings = 40;
  double slides = held, holds = computed;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (slides + holds);
    (std::abs(passage.pull_at(middle)) > friction ? slides : holds) = middle;
  }
  return holds;
}

}  // namespace

SidewaysHold hold_sideways(const Rope& rope, const History& history, std::size_t rope_index,
                           std::size_t edge) {
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  const dynamics::RopeHistory& of_rope = history.ropes[rope_index];
  const double friction = rope.edges()[edge].friction;
  SidewaysHold result;
  for (Eigen::VectorXd* series : {&result.place, &result.pull, &result.slid})
    series->setConstant(history.sample_count(), no_number);
  EdgePassage passage(rope, history, rope_index, edge);
  double held = no_number;
  for (Index i = 0; i < history.sample_count(); ++i) {
    if (!of_rope.edges[edge].touches(i) || !(of_rope.tension[i] > 0)) {
      held = no_number;
      continue;
    }
    const double computed = passage.place(i);
    if (std::isnan(held)) held = computed;
    passage.go_to(i);
    result.pull[i] = passage.pull_at(held);
    if (std::abs(result.pull[i]) > friction) held = drag(passage, held, computed, friction);
    result.place[i] = held;
    result.slid[i] = computed - held;
  }
  return result;
}

}  // namespace blocklift::pipeline

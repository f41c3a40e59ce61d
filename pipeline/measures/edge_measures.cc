#include "pipeline/measures/edge_measures.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "pipeline/measures/edge_sliding.h"

namespace blocklift::pipeline {

namespace {

using dynamics::EdgeHistory;
using dynamics::RopeHistory;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

bool presses(const RopeHistory& rope, const EdgeHistory& edge, Eigen::Index sample) {
  return edge.touches(sample) && rope.tension[sample] > 0;
}

/// "R1 over sill"; where the rope comes to that edge again, "R1 over sill (2)".
std::string subject_of(const LiftRope& rope, std::size_t edge) {
  const std::string& name = rope.edges[edge].name;
  const auto times =
      1 + std::count_if(rope.edges.begin(), rope.edges.begin() + static_cast<std::ptrdiff_t>(edge),
                        [&](const LiftEdge& one) { return one.name == name; });
  return rope.name + " over " + name + (times > 1 ? " (" + std::to_string(times) + ")" : "");
}

/// Measures of one rope at one edge.
class EdgeMeasures {
 public:
  EdgeMeasures(const LiftRun& lift, const LiftRope& rope, std::size_t edge,
               std::vector<LiftMeasure>& measures)
      : lift_(lift),
        rope_(static_cast<std::size_t>(rope.rope)),
        edge_(edge),
        subject_(subject_of(rope, edge)),
        measures_(measures) {}

  template <class Value>
  void add(const char* kind, const char* unit, Extreme extreme, const char* meaning,
           const Value& value_at) {
    LiftMeasure measure{
        .subject = subject_, .kind = kind, .unit = unit, .extreme = extreme, .meaning = meaning};
    const auto series = [&](const dynamics::History& history) {
      const RopeHistory& rope = history.ropes[rope_];
      Eigen::VectorXd values(history.sample_count());
      for (Eigen::Index i = 0; i < values.size(); ++i)
        values[i] = value_at(rope, rope.edges[edge_], i);
      return values;
    };
    measure.at_rest = series(lift_.static_history);
    measure.in_motion = series(lift_.dynamic_history());
    measures_.push_back(std::move(measure));
  }

  /// Of a rope that friction holds sideways.
  void add_sideways() {
    const dynamics::Rope& rope = lift_.model.system.ropes()[rope_];
    SidewaysHold at_rest = hold_sideways(rope, lift_.static_history, rope_, edge_);
    SidewaysHold in_motion = hold_sideways(rope, lift_.dynamic_history(), rope_, edge_);
    measures_.push_back({.subject = subject_,
                         .kind = "sideways pull",
                         .unit = "1",
                         .extreme = Extreme::largest_magnitude,
                         .meaning = "of the rope along the edge over what it presses against it, "
                                    "where friction holds it; above the friction it slides along",
                         .at_rest = std::move(at_rest.pull),
                         .in_motion = std::move(in_motion.pull)});
    measures_.push_back({.subject = subject_,
                         .kind = "slid along the edge",
                         .unit = "m",
                         .extreme = Extreme::largest_magnitude,
                         .meaning = "by the computation, which has no friction sideways, from "
                                    "where friction holds the rope",
                         .at_rest = std::move(at_rest.slid),
                         .in_motion = std::move(in_motion.slid)});
  }

 private:
  const LiftRun& lift_;
  std::size_t rope_, edge_;
  std::string subject_;
  std::vector<LiftMeasure>& measures_;
};

}  // namespace

double distance_from_end(const RopeHistory& rope, std::size_t edge, double length,
                         Eigen::Index sample) {
  const EdgeHistory& at = rope.edges[edge];
  if (!presses(rope, at, sample)) return no_number;
  const auto [low, high] = std::minmax(at.first_place[sample], at.last_place[sample]);
  return std::min(low, length - high);
}

void add_edge_measures(const LiftRun& lift, std::vector<LiftMeasure>& measures) {
  for (const LiftRope& rope : lift.model.ropes) {
    for (std::size_t edge = 0; edge < rope.edges.size(); ++edge) {
      EdgeMeasures of(lift, rope, edge, measures);
      of.add("edge force", "N", Extreme::largest, "of the rope on the edge of the load",
             [](const RopeHistory&, const EdgeHistory& at, Eigen::Index i) {
               return at.force.row(i).norm();
             });
      of.add("angle of wrap", "rad", Extreme::largest,
             "by which the rope turns about the edge; 0 where it does not touch",
             [](const RopeHistory&, const EdgeHistory& at, Eigen::Index i) { return at.wrap[i]; });
      of.add("place on edge", "m", Extreme::largest,
             "middle of the touch, along the edge from the end that `from` gives, while it presses",
             [](const RopeHistory& one, const EdgeHistory& at, Eigen::Index i) {
               return presses(one, at, i) ? 0.5 * (at.first_place[i] + at.last_place[i])
                                          : no_number;
             });
      if (rope.edges[edge].friction > 0) {
        of.add("tension before", "N", Extreme::largest,
               "of the span before the edge, in the order of the rope's path, while it touches",
               [](const RopeHistory&, const EdgeHistory& at, Eigen::Index i) {
                 return at.touches(i) ? at.first_tension[i] : no_number;
               });
        of.add("tension behind", "N", Extreme::largest,
               "of the span behind the edge; friction makes the two unequal, at rest none acts",
               [](const RopeHistory&, const EdgeHistory& at, Eigen::Index i) {
                 return at.touches(i) ? at.last_tension[i] : no_number;
               });
        of.add_sideways();
      }
      const double length = rope.edges[edge].length;
      of.add("distance from edge end", "m", Extreme::smallest,
             "of the touch from the nearer end, while it presses; below zero the rope has run off "
             "the edge, which goes on there in the computation",
             [&](const RopeHistory& one, const EdgeHistory&, Eigen::Index i) {
               return distance_from_end(one, edge, length, i);
             });
    }
  }
}

}  // namespace blocklift::pipeline

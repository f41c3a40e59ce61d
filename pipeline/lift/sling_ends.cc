#include "pipeline/lift/sling_ends.h"

#include <algorithm>

namespace blocklift::pipeline {

std::vector<SlingEnd> find_sling_ends(const BuiltLift& model) {
  std::vector<SlingEnd> ends;
  for (std::size_t i = 0; i < model.ropes.size(); ++i) {
    const LiftRope& sling = model.ropes[i];
    const std::vector<dynamics::BodyPoint>& points = model.system.ropes()[sling.rope].points();
    if (!sling.first_lug.empty()) ends.push_back({i, sling.rope, true, points.front().p_BoQ_B});
    if (!sling.lug.empty()) ends.push_back({i, sling.rope, false, points.back().p_BoQ_B});
  }
  return ends;
}

Eigen::VectorXd LugEnds::load(const dynamics::History& history) const {
  if (ends.size() == 1) return history.ropes[ends.front().rope].tension;
  dynamics::RopeHistory::Rows3 sum = dynamics::RopeHistory::Rows3::Zero(history.sample_count(), 3);
  for (const SlingEnd& end : ends) sum += end.pull(history);
  return sum.rowwise().norm();
}

std::vector<LugEnds> find_lug_ends(const BuiltLift& model) {
  std::vector<LugEnds> lugs;
  for (const SlingEnd& end : find_sling_ends(model)) {
    const LiftRope& rope = model.ropes[end.sling];
    const std::string& lug = end.first ? rope.first_lug : rope.lug;
    auto known =
        std::find_if(lugs.begin(), lugs.end(), [&](const LugEnds& one) { return one.lug == lug; });
    if (known == lugs.end()) known = lugs.insert(lugs.end(), LugEnds{lug, {}});
    known->ends.push_back(end);
  }
  return lugs;
}

std::vector<Eigen::Vector3d> bearing_places(const BuiltLift& model,
                                            const dynamics::History& history, Eigen::Index sample) {
  std::vector<Eigen::Vector3d> places;
  for (const SlingEnd& end : find_sling_ends(model))
    if (history.ropes[end.rope].tension[sample] > 0) places.push_back(end.p_BoQ_B);
  for (const LiftRope& sling : model.ropes) {
    const auto rope = static_cast<std::size_t>(sling.rope);
    for (std::size_t i = 0; i < sling.edges.size(); ++i) {
      const dynamics::EdgeHistory& touch = history.ropes[rope].edges[i];
      if (!touch.touches(sample) || !(touch.force(sample, 2) > 0)) continue;
      const dynamics::RopeEdge& edge = model.system.ropes()[rope].edges()[i];
      const double place = 0.5 * (touch.first_place[sample] + touch.last_place[sample]);
      places.emplace_back(edge.begin_B + place * (edge.end_B - edge.begin_B).normalized());
    }
  }
  return places;
}

double lift_at_edges(const BuiltLift& model, const dynamics::History& history,
                     Eigen::Index sample) {
  double sum = 0;
  for (const LiftRope& sling : model.ropes) {
    for (const dynamics::EdgeHistory& edge : history.ropes[sling.rope].edges)
      sum += edge.force(sample, 2);
  }
  return sum;
}

Eigen::VectorXd load_on_slings(const BuiltLift& model, const dynamics::History& history) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(history.sample_count());
  for (const SlingEnd& end : find_sling_ends(model)) sum += end.pull(history).col(2);
  for (Eigen::Index sample = 0; sample < sum.size(); ++sample)
    sum[sample] += lift_at_edges(model, history, sample);
  return sum;
}

}  // namespace blocklift::pipeline

#include "pipeline/checks/frame_compliance.h"

#include <cstddef>
#include <utility>

#include "structure/practice/rectangular_frame.h"

namespace blocklift::pipeline {

Eigen::MatrixXd compliance_of_frames(const TolerancedRigging& rigging,
                                     const std::vector<const given::Spreader*>& spreaders) {
  const auto count = static_cast<Eigen::Index>(rigging.ropes.size());
  Eigen::MatrixXd compliance = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t bar = 0; bar < spreaders.size(); ++bar) {
    const given::Spreader& spreader = *spreaders[bar];
    if (!spreader.is_frame()) continue;
    const TolerancedRigging::Bar& in_place = rigging.bars[bar];
    const Eigen::Matrix3d R_BW = in_place.R_WB.transpose();
    // By end: its place, the rope, and how a pull of the rope acts there.
    std::vector<Vector3> points, pulls;
    std::vector<Eigen::Index> ropes;
    for (Eigen::Index rope = 0; rope < count; ++rope) {
      const RiggingRope& one = rigging.ropes[rope];
      for (const RiggingEnd* end : {&one.lower, &one.upper}) {
        if (end->kind != RiggingEnd::Kind::bar || end->index != static_cast<int>(bar)) continue;
        points.push_back(in_place.centre + R_BW * end->r_W);
        pulls.push_back((end == &one.lower ? 1.0 : -1.0) * (R_BW * one.direction_W));
        ropes.push_back(rope);
      }
    }
    const structure::RectangularFrame frame(spreader.member(), spreader.cross_member(), points);
    const Eigen::MatrixXd flexibility = frame.flexibility(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < points.size(); ++j)
        compliance(ropes[i], ropes[j]) +=
            pulls[i].dot(flexibility.block<3, 3>(3 * static_cast<Eigen::Index>(i),
                                                 3 * static_cast<Eigen::Index>(j)) *
                         pulls[j]);
  }
  return compliance;
}

RiggingBalance balance_of(const TolerancedRigging& rigging,
                          const std::vector<const given::Spreader*>& spreaders) {
  Eigen::MatrixXd compliance = compliance_of_frames(rigging, spreaders);
  if (rigging.load_compliance.size() > 0) compliance += rigging.load_compliance;
  return {rigging.ropes, rigging.hooks, std::move(compliance),
          static_cast<int>(rigging.bars.size())};
}

}  // namespace blocklift::pipeline

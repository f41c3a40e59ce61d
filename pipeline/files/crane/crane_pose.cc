#include "pipeline/files/crane/crane_pose.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/assembly.h"
#include "dynamics/multibody/loop_projection.h"
#include "pipeline/mechanism/build_parts.h"

namespace blocklift::pipeline {
namespace {

/// A drive's coordinate on its way from the pose to the start.
struct Way {
  const DriveModel* drive;
  int coordinate;  ///< index in q
  double from;     ///< m or rad
  double to;       ///< m or rad
};

std::vector<Way> ways_of(const PartsBuilder& parts, const CranePose& pose,
                         const std::function<double(const std::string&)>& start_of) {
  std::vector<Way> ways;
  for (const DrivenFreedom& freedom : parts.driven()) {
    const int k = pose.mechanism.body(freedom.body).q_offset + freedom.degree_of_freedom;
    ways.push_back({freedom.drive, k, pose.q[k], start_of(freedom.drive->name.value)});
  }
  return ways;
}

/// "drive luff at 85 deg, drive slew at 0 deg"
std::string describe(const std::vector<Way>& ways, const Eigen::VectorXd& q) {
  std::string text;
  for (const Way& way : ways) {
    text += fmt::format("{}drive {} at {}", text.empty() ? "" : ", ", way.drive->name.value,
                        format_quantity(q[way.coordinate], way.drive->range[0].dimension));
  }
  return text;
}

/// The crane's mechanism with what the file leaves open still open.
dynamics::Mechanism build_parts(PartsBuilder& parts) {
  dynamics::MechanismBuilder builder;
  parts.add_bodies(builder);
  parts.add_loops(builder);
  return builder.build();
}

CranePose put_together(const CraneModel& crane, PartsBuilder& parts) {
  const dynamics::Mechanism open = build_parts(parts);
  dynamics::ForceElements elements;
  parts.add_springs(open, elements);
  Eigen::VectorXd q = open.zero_configuration();
  parts.set_positions(open, crane.pose, q);
  dynamics::assemble(open, q);
  return {open.with_loops_as_at(q), std::move(q)};
}

}  // namespace

CranePose put_together(const CraneModel& crane) {
  PartsBuilder parts(crane, "", dynamics::Pose::identity());
  return put_together(crane, parts);
}

CranePose pose_at_start(const CraneModel& crane,
                        const std::function<double(const std::string&)>& start_of,
                        const std::string& name) {
  constexpr int steps = 100;
  PartsBuilder parts(crane, "", dynamics::Pose::identity());
  CranePose pose = put_together(crane, parts);
  const std::vector<Way> ways = ways_of(parts, pose, start_of);
  dynamics::LoopProjector projector(pose.mechanism);
  for (int i = 1; i <= steps; ++i) {
    for (const Way& way : ways) {
      pose.q[way.coordinate] = i == steps ? way.to : way.from + i * (way.to - way.from) / steps;
    }
    if (projector.project_positions(pose.q)) continue;
    throw dynamics::SimulationError(fmt::format(
        "the loops of crane {} cannot follow its drives from the pose in which it is put together "
        "to this start; they open with {}, where they miss: {}",
        name, describe(ways, pose.q),
        dynamics::describe_residual(pose.mechanism, projector.state().residual, 1e-9)));
  }
  return pose;
}

}  // namespace blocklift::pipeline

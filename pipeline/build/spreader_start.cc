#include "pipeline/build/spreader_start.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace blocklift::pipeline {
namespace {

using dynamics::Pose;

Vector3 mean_of(const std::vector<Vector3>& points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Places bars tier by tier from above.
class SpreaderPlacing {
 public:
  SpreaderPlacing(const LiftCase& lift_case,
                  const std::function<Vector3(const ResolvedPoint&)>& place)
      : case_(lift_case), place_(place) {}

  std::map<std::string, Pose> run() {
    // Each round places a tier. A ring of bars that hang on one another keeps to the origin.
    for (std::size_t round = 0; round < case_.spreaders.size(); ++round)
      for (const given::Spreader& bar : case_.spreaders)
        if (!poses_.contains(bar.name.value)) try_to_place(bar);
    for (const given::Spreader& bar : case_.spreaders)
      poses_.try_emplace(bar.name.value, Pose{attitude(bar), case_.load.position});
    return std::move(poses_);
  }

 private:
  std::optional<Vector3> known_place(const ResolvedPoint& point) const {
    if (point.kind != ResolvedPoint::Kind::spreader) return place_(point);
    const auto found = poses_.find(point.part);
    if (found == poses_.end()) return std::nullopt;
    return found->second.apply(point.point);
  }

  void try_to_place(const given::Spreader& bar) {
    const Eigen::Matrix3d R = attitude(bar);
    if (bar.position) {
      poses_[bar.name.value] = {R, *bar.position};
      return;
    }
    std::vector<const given::Rope*> slings;
    std::vector<Vector3> tops;
    for (const given::Rope& rope : case_.ropes) {
      if (!rope.ends_at_spreader(bar.name.value)) continue;
      const std::optional<Vector3> top = known_place(rope.path.front());
      if (!top) return;
      slings.push_back(&rope);
      tops.push_back(*top);
    }
    if (slings.empty()) return;
    Vector3 middle = mean_of(tops);
    double height = 0;
    for (std::size_t i = 0; i < slings.size(); ++i) {
      const Vector3 eye = R * slings[i]->path.back().point;
      const double level = (middle + eye - tops[i]).head<2>().norm();
      const double drop =
          std::sqrt(std::max(0.0, std::pow(slings[i]->length.value, 2) - level * level));
      height += (tops[i].z() - drop - eye.z()) / static_cast<double>(slings.size());
    }
    middle.z() = height;
    poses_[bar.name.value] = {R, middle};
  }

  /// Of the bar: as given, else level, its x axis from what hangs at end a to what hangs at end b.
  Eigen::Matrix3d attitude(const given::Spreader& bar) const {
    if (bar.attitude) return rotation_of(*bar.attitude);
    std::vector<Vector3> at_a, at_b;
    for (const given::Rope& rope : case_.ropes) {
      const ResolvedPoint& first = rope.path.front();
      if (first.kind != ResolvedPoint::Kind::spreader || first.part != bar.name.value) continue;
      std::set<std::string> passed = {bar.name.value};
      gather_below(rope.path.back(), passed, first.point.x() < 0 ? at_a : at_b);
    }
    double yaw = case_.load.attitude.z();
    if (!at_a.empty() && !at_b.empty()) {
      const Vector3 along = mean_of(at_b) - mean_of(at_a);
      if (along.head<2>().norm() > 1e-6) yaw = std::atan2(along.y(), along.x());
    }
    return rotation_of({0, 0, yaw});
  }

  /// Places at which what hangs below a point ends: its own, or those below a spreader.
  void gather_below(const ResolvedPoint& point, std::set<std::string>& passed,
                    std::vector<Vector3>& places) const {
    if (point.kind != ResolvedPoint::Kind::spreader) {
      places.push_back(place_(point));
      return;
    }
    if (!passed.insert(point.part).second) return;
    for (const given::Rope& rope : case_.ropes) {
      const ResolvedPoint& first = rope.path.front();
      if (first.kind == ResolvedPoint::Kind::spreader && first.part == point.part)
        gather_below(rope.path.back(), passed, places);
    }
  }

  const LiftCase& case_;
  const std::function<Vector3(const ResolvedPoint&)>& place_;
  std::map<std::string, Pose> poses_;
};

}  // namespace

std::map<std::string, Pose> spreader_starts(
    const LiftCase& lift_case, const std::function<Vector3(const ResolvedPoint&)>& place) {
  return SpreaderPlacing(lift_case, place).run();
}

}  // namespace blocklift::pipeline

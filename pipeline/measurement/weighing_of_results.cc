#include "pipeline/measurement/weighing_of_results.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {
namespace {

constexpr std::size_t most_instants = 2000;

/// The way of a rope: points in the frames of their bodies.
struct RopePath {
  std::string channel;
  std::vector<std::string> bodies;
  std::vector<Eigen::Vector3d> points_B;
};

std::vector<RopePath> paths_at_load(const ResultsReader& results, const std::string& load) {
  std::vector<RopePath> paths;
  if (!results.has(layout::scene_ropes)) return paths;
  for (const std::string& rope : results.children(layout::scene_ropes)) {
    const std::string group = layout::join(layout::scene_ropes, rope);
    const bool is_hoist = results.has_attribute(group, "kind") &&
                          results.read_text_attribute(group, "kind") == "hoist";
    RopePath path{(is_hoist ? "hoists." : "ropes.") + rope,
                  results.read_texts(layout::join(group, std::string("bodies"))),
                  {}};
    if (std::find(path.bodies.begin(), path.bodies.end(), load) == path.bodies.end()) continue;
    const Array<double> points = results.read(layout::join(group, std::string("points")));
    for (std::size_t i = 0; i < points.rows(); ++i)
      path.points_B.emplace_back(points(i, 0), points(i, 1), points(i, 2));
    paths.push_back(std::move(path));
  }
  return paths;
}

std::string load_of(const ResultsReader& results) {
  return results.read_text_attribute(layout::scene_lugs, "body");
}

/// The computed motion of the bodies that ropes end at.
class BodyMotions {
 public:
  explicit BodyMotions(const ResultsReader& results)
      : results_(results),
        time_(results.read(layout::join(layout::dynamic_history, std::string("time"))).values) {}

  /// X_WB at an instant, between samples by shares.
  Eigen::Isometry3d pose_at(const std::string& body, double instant) {
    if (body == layout::world) return Eigen::Isometry3d::Identity();
    const Array<double>& poses = poses_of(body);
    const auto next = static_cast<std::size_t>(
        std::upper_bound(time_.begin(), time_.end(), instant) - time_.begin());
    const std::size_t b = std::min(next, time_.size() - 1);
    const std::size_t a = b > 0 ? b - 1 : 0;
    const double span = time_[b] - time_[a];
    const double share = span > 0 ? std::clamp((instant - time_[a]) / span, 0.0, 1.0) : 0;
    const auto turn = [&](std::size_t i) {
      return Eigen::Quaterniond(poses(i, 3), poses(i, 4), poses(i, 5), poses(i, 6)).normalized();
    };
    const auto place = [&](std::size_t i) {
      return Eigen::Vector3d(poses(i, 0), poses(i, 1), poses(i, 2));
    };
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turn(a).slerp(share, turn(b)).toRotationMatrix();
    pose.translation() = (1 - share) * place(a) + share * place(b);
    return pose;
  }

 private:
  const Array<double>& poses_of(const std::string& body) {
    const auto found = poses_.find(body);
    if (found != poses_.end()) return found->second;
    return poses_
        .emplace(body, results_.read(layout::join(layout::dynamic_history, std::string("bodies"),
                                                  body, std::string("pose"))))
        .first->second;
  }

  const ResultsReader& results_;
  std::vector<double> time_;
  std::map<std::string, Array<double>> poses_;
};

/// Adds what a rope of this tension does to the load: the pull of each of its straight parts that
/// has one end there.
void add_pull(const RopePath& path, const std::string& load, double tension, double instant,
              BodyMotions& motions, WeighingInstant& weighing) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = motions.pose_at(load, instant).translation();
  for (std::size_t i = 0; i + 1 < path.bodies.size(); ++i) {
    const bool first_is_load = path.bodies[i] == load;
    if (first_is_load == (path.bodies[i + 1] == load)) continue;
    const std::size_t own = first_is_load ? i : i + 1;
    const std::size_t other = first_is_load ? i + 1 : i;
    const Eigen::Vector3d lug = motions.pose_at(load, instant) * path.points_B[own];
    const Eigen::Vector3d away =
        motions.pose_at(path.bodies[other], instant) * path.points_B[other] - lug;
    const Eigen::Vector3d pull = tension * away.normalized();
    force += pull;
    moment += (lug - origin).cross(pull);
  }
  weighing.force_W.push_back(force);
  weighing.moment_W.push_back(moment);
}

}  // namespace

std::vector<std::string> ropes_at_load(const ResultsReader& results) {
  std::vector<std::string> names;
  if (!results.has(layout::scene_lugs) || !results.has_attribute(layout::scene_lugs, "body"))
    return names;
  for (const RopePath& path : paths_at_load(results, load_of(results)))
    names.push_back(path.channel);
  return names;
}

std::vector<WeighingInstant> weighing_instants(const ResultsReader& results,
                                               const std::map<std::string, TimeSeries>& tensions,
                                               const TimeWindow& window) {
  std::vector<WeighingInstant> weighings;
  const std::string load = load_of(results);
  const std::vector<RopePath> paths = paths_at_load(results, load);
  if (paths.empty()) return weighings;
  // Only where every cell has spoken.
  TimeWindow common = window;
  for (const RopePath& path : paths) {
    const TimeSeries& series = tensions.at(path.channel);
    common.from = std::max(common.from, series.time.front());
    common.to = std::min(common.to, series.time.back());
  }
  std::vector<double> instants = samples_in(tensions.at(paths.front().channel), common).time;
  for (const RopePath& path : paths) {
    const std::vector<TimeWindow> gaps = gaps_of(tensions.at(path.channel));
    std::erase_if(instants, [&](double instant) { return is_in_gap(gaps, instant); });
  }
  const std::size_t stride =
      std::max<std::size_t>(1, (instants.size() + most_instants - 1) / most_instants);
  BodyMotions motions(results);
  for (std::size_t i = 0; i < instants.size(); i += stride) {
    WeighingInstant& weighing = weighings.emplace_back();
    weighing.time = instants[i];
    weighing.R_WB = motions.pose_at(load, instants[i]).linear();
    for (const RopePath& path : paths)
      add_pull(path, load, tensions.at(path.channel).at(instants[i]), instants[i], motions,
               weighing);
  }
  return weighings;
}

}  // namespace blocklift::pipeline

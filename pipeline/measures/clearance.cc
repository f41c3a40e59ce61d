#include "pipeline/measures/clearance.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "parallel/threads.h"
#include "pipeline/measures/place_at.h"

namespace blocklift::pipeline {

namespace {

using dynamics::BodyIndex;
using dynamics::History;
using dynamics::Pose;

constexpr double far = 20;                   // m: all beyond is out of the way
constexpr Eigen::Index most_instants = 600;  // of a history

}  // namespace

/// The triangles in a tree of boxes (FCL), and the sphere around them.
struct Solid::Tree {
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model;
  Vector3 centre = Vector3::Zero();
  double radius = 0;
};

Solid::Solid(const std::vector<Triangle>& triangles) : tree_(std::make_unique<Tree>()) {
  tree_->model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  tree_->model->beginModel(static_cast<int>(triangles.size()),
                           static_cast<int>(3 * triangles.size()));
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Triangle& triangle : triangles) {
    tree_->model->addTriangle(triangle[0], triangle[1], triangle[2]);
    for (const Vector3& corner : triangle) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  tree_->model->endModel();
  tree_->centre = 0.5 * (low + high);
  tree_->radius = 0.5 * (high - low).norm();
}

Solid::~Solid() = default;
Solid::Solid(Solid&&) noexcept = default;
Solid& Solid::operator=(Solid&&) noexcept = default;

double Solid::distance(const Solid& a, const Pose& X_WA, const Solid& b, const Pose& X_WB,
                       double most) {
  const double apart = (X_WA.apply(a.tree_->centre) - X_WB.apply(b.tree_->centre)).norm();
  if (apart - a.tree_->radius - b.tree_->radius >= most) return most;
  const auto transform = [](const Pose& X) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    transform.linear() = X.R;
    transform.translation() = X.p;
    return transform;
  };
  fcl::DistanceRequestd request;
  request.enable_signed_distance = false;
  fcl::DistanceResultd result(most);  // what is farther is not looked at
  const double found =
      fcl::distance<double>(a.tree_->model.get(), transform(X_WA), b.tree_->model.get(),
                            transform(X_WB), request, result);
  return std::clamp(found, 0.0, most);
}

namespace {

/// A body's surface within the lift.
struct PlacedSolid {
  std::string name;
  BodyIndex body = -1;
  Solid solid;
};

/// A straight piece of a rope between two points of bodies, but for a part at its end.
struct RopePiece {
  std::string name;
  dynamics::BodyPoint from, to;
};

/// Samples that are looked at: the ends, and others as evenly as can be.
std::vector<Eigen::Index> chosen_samples(Eigen::Index count) {
  const Eigen::Index chosen = std::min(count, most_instants);
  std::vector<Eigen::Index> samples;
  for (Eigen::Index i = 0; i < chosen; ++i)
    samples.push_back(chosen == 1 ? 0 : i * (count - 1) / (chosen - 1));
  return samples;
}

/// Corners of a surface, each once.
Eigen::Matrix3Xd corners_of(const std::vector<Triangle>& triangles) {
  std::vector<Vector3> corners;
  for (const Triangle& triangle : triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  std::sort(corners.begin(), corners.end(), [](const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  Eigen::Matrix3Xd once(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) once.col(i) = corners[i];
  return once;
}

/// A series of the distance that `distance_at` finds at an instant.
template <class DistanceAt>
Eigen::VectorXd distances(const History& history, const DistanceAt& distance_at) {
  Eigen::VectorXd values(history.sample_count());
  const std::vector<Eigen::Index> chosen = chosen_samples(history.sample_count());
  parallel::in_batches(static_cast<int>(chosen.size()), 8, 0, [&](int first, int count) {
    for (int i = first; i < first + count; ++i) {
      const Eigen::Index sample = chosen[i];
      values[sample] = distance_at(history, sample);
    }
  });
  Eigen::Index before = -1;
  for (const Eigen::Index sample : chosen) {
    for (Eigen::Index k = before + 1; before >= 0 && k < sample; ++k) {
      const double share =
          (history.time[k] - history.time[before]) / (history.time[sample] - history.time[before]);
      values[k] = values[before] + share * (values[sample] - values[before]);
    }
    before = sample;
  }
  return values;
}

/// Gathers what may touch what.
class Clearances {
 public:
  Clearances(const LiftCase& lift_case, const LiftRun& lift, std::vector<LiftMeasure>& measures)
      : case_(lift_case),
        lift_(lift),
        measures_(measures),
        load_{"load", lift.model.load, Solid(surface_of(lift_case.load))} {}

  void add() {
    place_cranes();
    for (const auto& crane : cranes_)
      for (const PlacedSolid& body : crane) add_pair(load_, body);
    for (const given::Vessel& vessel : case_.vessels) {
      const BodyIndex body = lift_.model.system.mechanism().body_index(vessel.name.value);
      add_pair(load_, {vessel.name.value, body, Solid(surface_of(vessel.model->hull))});
    }
    add_hooks();
    add_spreaders();
    add_slings();
    for (std::size_t i = 0; i < cranes_.size(); ++i)
      for (std::size_t j = i + 1; j < cranes_.size(); ++j) add_cranes(cranes_[i], cranes_[j]);
    add_ground();
  }

 private:
  void place_cranes() {
    cranes_.resize(case_.cranes.size());
    for (const LiftBody& body : lift_.model.bodies) {
      if (body.kind != "crane" || body.boxes.empty()) continue;
      cranes_[crane_of(body.name)].push_back({body.name, body.body, Solid(surface_of(body.boxes))});
    }
  }

  std::size_t crane_of(const std::string& body) const {
    const given::Crane* crane = case_.find_crane(body.substr(0, body.find('.')));
    return static_cast<std::size_t>(crane - case_.cranes.data());
  }

  template <class DistanceAt>
  void add_measure(const std::string& one, const std::string& other,
                   const DistanceAt& distance_at) {
    LiftMeasure measure{.subject = one + " to " + other,
                        .kind = "clearance",
                        .unit = "m",
                        .extreme = Extreme::smallest,
                        .meaning = "smallest distance of the two; beyond 20 m it is not followed",
                        .at_rest = distances(lift_.static_history, distance_at),
                        .in_motion = distances(lift_.dynamic_history(), distance_at)};
    // What never comes near is no figure.
    if (std::min(measure.at_rest.minCoeff(), measure.in_motion.minCoeff()) < far)
      measures_.push_back(std::move(measure));
  }

  void add_pair(const PlacedSolid& one, const PlacedSolid& other) {
    add_measure(one.name, other.name, [&](const History& history, Eigen::Index sample) {
      return Solid::distance(one.solid, pose_at(history, one.body, sample), other.solid,
                             pose_at(history, other.body, sample), far);
    });
  }

  void add_rope(const RopePiece& rope, const PlacedSolid& other) {
    add_measure(rope.name, other.name, [&](const History& history, Eigen::Index sample) {
      const auto place = [&](const dynamics::BodyPoint& point) {
        return pose_at(history, point.body, sample).apply(point.p_BoQ_B);
      };
      // A strip of a millimetre's width stands for the line.
      const Vector3 a = place(rope.from), b = place(rope.to);
      const Vector3 width = 1e-3 * (b - a).unitOrthogonal();
      const Solid strip({{a, b, a + width}, {b, b + width, a + width}});
      return Solid::distance(strip, Pose::identity(), other.solid,
                             pose_at(history, other.body, sample), far);
    });
  }

  void add_hooks() {
    for (const LiftHoist& hoist : lift_.model.hoists) {
      const auto drawn =
          std::find_if(lift_.model.bodies.begin(), lift_.model.bodies.end(),
                       [&](const LiftBody& body) { return body.body == hoist.hook; });
      if (drawn != lift_.model.bodies.end() && !drawn->boxes.empty())
        add_pair(load_, {hoist.name, hoist.hook, Solid(surface_of(drawn->boxes.front()))});
      const dynamics::BodyPoint sheave =
          upper_sheave(lift_.model.system.ropes()[hoist.rope], hoist);
      const RopePiece tackle{"tackle of " + hoist.name, sheave, {hoist.hook, Vector3::Zero()}};
      add_rope(tackle, load_);
      for (const PlacedSolid& body : cranes_[hoist.crane])
        if (body.body != sheave.body) add_rope(tackle, body);
    }
  }

  /// Bars, against the load below them and all cranes.
  void add_spreaders() {
    for (const LiftBody& body : lift_.model.bodies) {
      if (body.kind != "spreader") continue;
      const PlacedSolid bar{body.name, body.body, Solid(surface_of(body.boxes))};
      add_pair(load_, bar);
      for (const auto& crane : cranes_)
        for (const PlacedSolid& part : crane) add_pair(bar, part);
    }
  }

  /// Slings, against the crane that they hang on. At the load they end, and are not looked at.
  void add_slings() {
    for (const LiftRope& rope : lift_.model.ropes) {
      if (rope.lug.empty() || rope.hoist.empty()) continue;
      const auto& points = lift_.model.system.ropes()[rope.rope].points();
      for (const PlacedSolid& body : cranes_[crane_of(rope.hoist)])
        add_rope({rope.name, points.front(), points.back()}, body);
    }
  }

  void add_cranes(const std::vector<PlacedSolid>& one, const std::vector<PlacedSolid>& other) {
    for (const PlacedSolid& a : one)
      for (const PlacedSolid& b : other) add_pair(a, b);
  }

  void add_ground() {
    const std::optional<double> ground = case_.ground_height();
    if (!ground) return;
    const Eigen::Matrix3Xd corners = corners_of(surface_of(case_.load));
    add_measure("load", "ground", [&](const History& history, Eigen::Index sample) {
      const Pose X_WB = pose_at(history, load_.body, sample);
      const double lowest = X_WB.p.z() + (X_WB.R.row(2) * corners).minCoeff();
      return std::min(lowest - *ground, far);
    });
  }

  const LiftCase& case_;
  const LiftRun& lift_;
  std::vector<LiftMeasure>& measures_;
  PlacedSolid load_;
  std::vector<std::vector<PlacedSolid>> cranes_;
};

}  // namespace

void add_clearances(const LiftCase& lift_case, const LiftRun& lift,
                    std::vector<LiftMeasure>& measures) {
  Clearances(lift_case, lift, measures).add();
}

}  // namespace blocklift::pipeline

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "dynamics/simulation/history.h"
#include "pipeline/build/build_lift.h"

namespace blocklift::pipeline {

/// An end of a sling at the load. A sling from lug to lug over a hook has two.
struct SlingEnd {
  std::size_t sling = 0;                              ///< its place among the lift's ropes
  int rope = -1;                                      ///< index in the system
  bool first = false;                                 ///< the rope begins here, else it ends here
  Eigen::Vector3d p_BoQ_B = Eigen::Vector3d::Zero();  ///< in the load's frame, m

  /// On the load at each sample, in W, N.
  const dynamics::RopeHistory::Rows3& pull(const dynamics::History& history) const {
    const dynamics::RopeHistory& one = history.ropes[rope];
    return first ? one.first_force : one.last_force;
  }
};

/// Both ends at the load of each rope that ends at a lug, in the order of the ropes.
std::vector<SlingEnd> find_sling_ends(const BuiltLift& model);

/// The ends of all slings at one lug.
struct LugEnds {
  std::string lug;
  std::vector<SlingEnd> ends;

  /// What the lug bears at each sample, N: the tension of one sling, and of several the size of the
  /// sum of their forces.
  Eigen::VectorXd load(const dynamics::History& history) const;
};

/// All lugs at which slings end, in the order of the ropes.
std::vector<LugEnds> find_lug_ends(const BuiltLift& model);

/// Places of the load that bear, at a sample, in its frame, m: lugs whose slings pull, and where
/// slings press on edges upwards, on the edge's axis in the middle of the touch.
std::vector<Eigen::Vector3d> bearing_places(const BuiltLift& model,
                                            const dynamics::History& history, Eigen::Index sample);

/// Vertical part of what slings do at edges of the load, at a sample, N.
double lift_at_edges(const BuiltLift& model, const dynamics::History& history, Eigen::Index sample);

/// Vertical part of all slings' forces on the load, at lugs and edges, at each sample, N.
Eigen::VectorXd load_on_slings(const BuiltLift& model, const dynamics::History& history);

}  // namespace blocklift::pipeline

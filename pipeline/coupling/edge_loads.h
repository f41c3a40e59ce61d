#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "dynamics/simulation/history.h"
#include "pipeline/build/build_lift.h"
#include "structure/response/elastic_model.h"

/// Forces of ropes on edges of a block.
namespace blocklift::pipeline {

/// A part of what a rope does at an edge at one instant: a force through a place of its axis.
struct EdgePush {
  double place = 0;  ///< along the axis from its begin, m
  double angle = 0;  ///< about it from the side outside, rad; 0 at a sharp edge
  dynamics::Vector3 force_B = dynamics::Vector3::Zero();  ///< in the edge's body, N
};

/// The force of a rope on an edge as pushes whose resultant it is, to rounding; none where it does
/// not press.
///
/// At a sharp edge it is one force. Round a cylinder of the radius R the rope runs along a helix,
/// and presses by T cos(b)^2 / R for each metre of it towards the axis, b being its slope, so that
///   dF = -n T cos(b) dtheta,   tan(b) = (advance along the axis) / (R wrap);
/// the pushes are those of Gauss points over the wrap. Where friction makes the tensions of its two
/// spans unequal, T grows from one to the other by an exponential over the wrap, as it does where
/// the rope slips, and dT along the rope is added. All go through the axis: the moment of friction
/// about it, R cos(b) times the difference of tensions, is not theirs.
std::vector<EdgePush> edge_pushes(const dynamics::History& history, Eigen::Index sample,
                                  const dynamics::LiftSystem& system, int rope, std::size_t edge);

/// Loads on a block that make up what ropes do at its edges at every instant of two histories.
///
/// For each rope and edge, unit forces at stations along the touched part of the edge, no farther
/// apart than half its contact length (unless there would be too many), and at angles about a round
/// one, no farther apart than 30 degrees. Each is a force through the axis, which a hat of the
/// contact length spreads over the plates nearest to the edge's surface at that angle
/// (structure::LineLoads). A push is shared linearly among the stations and angles beside it.
/// Forces through a straight line whose shares are linear in place have its resultant: what is
/// combined has force and moment of the pushes. Where a rope has run off an edge, the push is taken
/// at the edge's end.
struct EdgeBasis {
  Eigen::MatrixXd loads;       ///< freedoms x loads, of 1 N each
  Eigen::MatrixXd resultants;  ///< 6 x loads: force, moment about Bo (m), in B
  std::vector<int> ropes;      ///< for each load the rope's index in the lift system
  Eigen::MatrixXd static_factors, dynamic_factors;  ///< loads x samples, N

  int count() const { return static_cast<int>(loads.cols()); }
};

/// @returns none if no rope presses on an edge.
/// @throws structure::ModelError if an edge lies far from all plates.
std::optional<EdgeBasis> find_edge_basis(const structure::ElasticModel& model,
                                         const BuiltLift& lift,
                                         const dynamics::History& static_history,
                                         const dynamics::History& dynamic_history);

}  // namespace blocklift::pipeline

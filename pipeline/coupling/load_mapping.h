#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dynamics/simulation/history.h"
#include "pipeline/build/build_lift.h"
#include "structure/response/unit_responses.h"

/// From rope tensions in time to loads on the block: where the dynamics and the structure meet.
///
/// A lifted block is a free body: the forces at its lugs, whatever else acts on it (wind), gravity
/// and its own inertia are in balance at every instant. All loads are given in the block frame B,
/// which is the frame of the load's body in the dynamics and of its mesh in the structure.
namespace blocklift::pipeline {

/// A rope that ends at a lug of the block.
struct LugRope {
  int rope = -1;              ///< index in the lift system (and in histories)
  int lug = -1;               ///< index in the mesh
  bool at_last_point = true;  ///< which end of the rope's path is at the lug
};

/// The block within the lift.
struct BlockAttachment {
  dynamics::BodyIndex body = -1;
  std::vector<LugRope> ropes;
  /// Ropes that may touch its edges and end at none of its lugs, indices in the lift system.
  std::vector<int> baskets = {};
  std::vector<structure::LiftingPoint> lugs;  ///< all of the block's, loaded or not
  dynamics::Vector3 gravity_W = dynamics::Vector3::Constant(dynamics::not_a_number);  ///< m/s2
  /// Resultants of the loads besides those at lugs, 6 x loads: the fields of water pressure on its
  /// shell (PressureBasis), then unit forces on its edges (EdgeBasis).
  Eigen::MatrixXd added_resultants = {};
  /// For each of them the rope that it is of, index in the lift system; -1: of none.
  std::vector<int> added_ropes = {};
};

/// A history of the lift with what loads the block besides the forces at its lugs.
struct BlockHistory {
  /// A block that stays dry, and on whose edges no rope presses.
  BlockHistory(const dynamics::History& motion) : motion(motion) {}  // NOLINT: it is one
  BlockHistory(const dynamics::History& motion, Eigen::MatrixXd added)
      : motion(motion), added(std::move(added)) {}

  const dynamics::History& motion;
  /// Factors of the loads of BlockAttachment::added_resultants, loads x samples; empty: none.
  Eigen::MatrixXd added = {};

  Eigen::Index sample_count() const { return motion.sample_count(); }
  /// Factors at a sample.
  Eigen::VectorXd added_at(Eigen::Index sample) const {
    if (added.cols() == 0) return {};
    return added.col(sample);
  }
};

/// The ropes of a lift that end at lugs of its load, by the names of these, and those that go round
/// its edges alone.
/// @throws std::runtime_error if there are none, or if one ends at a lug that is not among `lugs`.
BlockAttachment attach_block(const BuiltLift& lift,
                             const std::vector<structure::LiftingPoint>& lugs);

/// Loads on the block at one sample: every rope's force at that instant, gravity, and the inertia
/// of the motion that the dynamics found. Water presses on the shell, ropes on edges. What else
/// acts on the body (wind, pads that it stands on, radiation and drag of the water, tugger lines
/// that end elsewhere) is spread over the block's mass. Nothing is adjusted: the balance of the
/// result measures how well the two stages agree.
structure::LoadCase map_instant(const BlockHistory& history, Eigen::Index sample,
                                const BlockAttachment& attachment,
                                const structure::MassProperties& mass);

/// Force of each rope at a lug of the attachment on the block at one sample, in B, N.
std::vector<structure::Vector3> rope_forces(const dynamics::History& history, Eigen::Index sample,
                                            const BlockAttachment& attachment);

/// Names of the ropes at lugs, in the order of the attachment, then those of the baskets.
std::vector<std::string> names_of_ropes(const dynamics::History& history,
                                        const BlockAttachment& attachment);

/// Every rope at its own largest load, all at once (the practice of Ku, Ha and Roh, section VII):
/// each force, at lugs and edges, in the block frame of its own instant. Since these instants
/// differ, no motion belongs to the set, and it is balanced by the rigid-body acceleration that it
/// would give the block. Water has no instant of its own there, and is left out.
structure::LoadCase map_rope_maxima(const BlockHistory& history,
                                    const std::vector<dynamics::LinkedMaximum>& maxima,
                                    const BlockAttachment& attachment,
                                    const structure::MassProperties& mass);

/// Forces at the lugs from a table (magnitude in N and unit direction in B, one a lug), balanced by
/// the rigid-body acceleration that they would give the block.
structure::LoadCase map_load_table(const std::vector<structure::Vector3>& lug_forces_B,
                                   const std::vector<structure::LiftingPoint>& lugs,
                                   const structure::MassProperties& mass);

}  // namespace blocklift::pipeline

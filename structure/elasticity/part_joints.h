#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "structure/mesh/part_mesh.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

/// A freedom that follows others, which follow none: u_freedom = sum_i shares_i u_followed_i.
struct PartTie {
  int freedom = 0;
  std::vector<int> followed;
  std::vector<double> shares;
};

/// Where two bodies of a part, which have no node in common, face each other closely.
struct PartMeeting {
  std::array<std::string, 2> bodies;  ///< in words: the group that each is, if any, and its middle
  Vector3 place = Vector3::Zero();    ///< of the smallest gap, m
  double gap = 0;                     ///< the smallest, m
  int tied_nodes = 0;                 ///< of either that follow the other
  double largest_gap = 0;             ///< at those, m
};

/// What joins the bodies of a part.
struct PartJoints {
  std::vector<PartMeeting> meetings;
  std::vector<PartTie> ties;  ///< of nodes, three a node but for what is held
};

/// Finds where bodies face each other and, if asked, ties them.
///
/// Two bodies meet where an outer face of one has a node, or its middle, within reach of the other,
/// on the side to which it faces: 5 % of the edges of the solid there (as Abaqus takes for *TIE),
/// or `within`. Of two that are joined the one with the finer faces there follows (it misses less
/// of the other's deformation, and the pressure that passes is smoother). A node at place x follows
/// solid s of the other body, whose place x_0 = X(xi) is the nearest, by
///   u(x) = sum_i (N_i(xi) + dN_i/dxi J^-1 (x - x_0)) u_i,
/// the solid's displacement, carried on linearly across the gap: exact for fields that are linear
/// in place, so that rigid motions strain nothing and forces keep their moment. Meshes need not
/// match.
/// @param held freedoms that do not follow.
/// @param within largest gap to be joined, m; none: nothing is tied.
PartJoints find_part_joints(const PartMesh& mesh, const std::vector<FixedUnknown>& held,
                            const std::optional<double>& within);

}  // namespace blocklift::structure

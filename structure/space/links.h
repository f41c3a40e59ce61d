#pragma once

#include <string>
#include <vector>

#include "structure/space/space.h"

namespace blocklift::structure {

/// A freedom that is a sum of other freedoms.
struct FreedomTie {
  int freedom = 0;
  std::vector<int> masters;
  std::vector<double> weights;
};

/// A node within an edge of an element, between two vertices of the mesh.
struct NodeWithinEdge {
  int node = 0;
  int from = 0, to = 0;
};

/// The ties of a mesh's rigid and distributing links and of its equations.
///
/// Slave of a rigid link: u_i = u + theta x (x_i - x), theta_i = theta. Reference of a distributing
/// link: with weights w_i, their centre c = sum w_i x_i / sum w_i and T = sum w_i (r^2 1 - r r'), r
/// = x_i - c,
///   theta = T^-1 sum w_i r_i x u_i,   u = sum w_i u_i / sum w_i + theta x (x - c);
/// about an axis that the vertices' places leave open (all on a line, or one) theta is the mean of
/// their rotations. A part of the components counts along the link's axes. Forces on the reference
/// spread over the vertices with the same resultant. Source: the principle of virtual work on the
/// least-squares rigid motion; MSC Nastran, RBE3.
/// @param node_of_vertex nodes of the mesh's vertices; @param nodes their places, m.
/// @param within nodes within edges of plates and solids: one whose edge has both ends in a rigid
///   link is its slave, too.
/// @throws ModelError if a freedom follows two links, or two equations say the same.
std::vector<FreedomTie> find_link_ties(const Mesh& mesh, const std::vector<int>& node_of_vertex,
                                       const Eigen::Matrix3Xd& nodes,
                                       const std::vector<NodeWithinEdge>& within = {});

/// "node 801 at (1.5, 1, 0.5) m", by the file's number of a vertex that is there, if it has one.
std::string describe_node(const Mesh& mesh, const std::vector<int>& node_of_vertex,
                          const Eigen::Matrix3Xd& nodes, int node);

}  // namespace blocklift::structure

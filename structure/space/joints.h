#pragma once

#include <vector>

namespace blocklift::structure {

/// The nodes of one cell along a piece of an edge of the mesh.
struct EdgeTrace {
  int from = 0, to = 0;  ///< vertices of the mesh's edge, from <= to; equal: the edge is a point
  double begin = 0, end = 1;  ///< of the piece, as shares of the edge counted from `from`
  std::vector<int> nodes;  ///< from begin to end, at the Lagrange elements' places of their degree
};

/// A node whose motion is a sum of others' motions.
struct NodeTie {
  int node = 0;
  std::vector<int> masters;
  std::vector<double> weights;
};

/// What ties the nodes of cells that meet along edges, whatever their number and sizes.
///
/// Nodes at one place of an edge are one. Of each stretch of an edge the longest cell that lies
/// there is the master: the nodes of shorter cells follow its polynomial, so that displacements are
/// continuous across the joint.
/// @param traces of all cells that have an edge.
/// @param vertex_node by vertex of the mesh: its node, or -1; nodes at the vertex are joined with
///   it. Entries of -1 are filled with a node of a trace.
/// @returns each tied node once; masters are never tied themselves.
std::vector<NodeTie> find_joint_ties(int nodes, const std::vector<EdgeTrace>& traces,
                                     std::vector<int>& vertex_node);

/// Places of the nodes of a Lagrange element of a degree on [0, 1] (Gauss-Lobatto points).
std::vector<double> lagrange_places(int degree);

/// Lagrange polynomials through lagrange_places(degree) at x.
std::vector<double> lagrange_values(int degree, double x);

}  // namespace blocklift::structure

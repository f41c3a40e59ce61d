#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "dynamics/marine/panels/panel_mesh.h"

namespace blocklift::dynamics {

/// An edge that two panels have in common.
struct SharedEdge {
  std::pair<int, int> panels;
  std::pair<int, int> sides;  ///< number of the edge on either: from that vertex to the next
  double length = 0.0;        ///< m
};

/// All edges that two panels of a mesh share. Images in planes of symmetry share none.
std::vector<SharedEdge> find_shared_edges(const PanelMesh& mesh);

/// What lies beside a panel at one of its sides.
enum class Beside {
  panel,  ///< one that it may be taken together with
  image,  ///< its own, in a plane of symmetry
  edge,   ///< nothing, or a panel at more than 45 degrees
};

/// For each panel, what lies beside its sides. The fourth of a triangle has no meaning.
std::vector<std::array<Beside, 4>> find_what_is_beside(const PanelMesh& mesh,
                                                       const std::vector<SharedEdge>& edges,
                                                       const Symmetry& planes);

/// Neighbouring panels taken together, as one panel of a coarser mesh.
struct PanelClusters {
  std::vector<int> of_panel;  ///< the cluster that a panel belongs to
  int count = 0;

  /// Mean over each cluster's panels, weighted with their areas, for each column of values.
  Eigen::MatrixXd average(const Eigen::VectorXd& areas, const Eigen::MatrixXd& values) const;
  /// Sum over each cluster's panels.
  Eigen::VectorXd sum(const Eigen::VectorXd& values) const;
  /// Sum over each cluster's panels, for each row of values: clusters are columns then.
  Eigen::MatrixXd sum_columns(const Eigen::MatrixXd& values) const;
  /// What is constant on each cluster (rows), on each of its panels.
  Eigen::MatrixXcd spread(const Eigen::MatrixXcd& values) const;
  /// Panels of one mesh (rows) by panels of another (columns), rows averaged and columns summed:
  /// what a matrix of influence becomes when potentials are constant on the clusters and equations
  /// hold in the mean over each.
  static Eigen::MatrixXd coarsen(const Eigen::MatrixXd& matrix, const PanelClusters& rows,
                                 const Eigen::VectorXd& row_areas, const PanelClusters& columns);
  static Eigen::MatrixXf coarsen(const Eigen::MatrixXf& matrix, const PanelClusters& rows,
                                 const Eigen::VectorXd& row_areas, const PanelClusters& columns);
};

/// What becomes of a panel whose neighbours all have a partner.
enum class LeftOver {
  joins,  ///< at an edge of the hull: a pair beside it, as its third
  stays,  ///< by itself
};

/// Clusters of about four panels, of about twice a panel's size and at most `largest` (m) across.
/// Panels are paired with the neighbour with which they share the longest edge, then the pairs once
/// more. Those that meet at more than 45 degrees stay apart. A row that is left over at an edge, of
/// three for instance, would be as fine there in the coarser mesh as in the finer one, and tell
/// nothing of the edge.
PanelClusters cluster_panels(const PanelMesh& mesh,
                             double largest = std::numeric_limits<double>::infinity(),
                             LeftOver left_over = LeftOver::joins);

/// What estimated errors of panels are multiplied with: a cluster's flow is not quite that of one
/// panel of twice the size. Without it pitch of a broad cylinder, 24 panels round it, would be said
/// an eighth too low.
inline constexpr double caution_with_panels = 1.14;

/// The error of panels at first order in their size, from what their forces change by from clusters
/// of them: 1/(r - 1) times as much, r^2 the panels in a cluster in the mean, with caution. The
/// changes themselves where four are joined everywhere; more where hulls are few panels wide or
/// high, which leave panels alone. Never less, where threes are joined: those at the edges may be
/// twos. Infinite where none are joined.
Eigen::VectorXd error_of_panels(const Eigen::VectorXd& changes, const PanelClusters& clusters);

/// Clusters of several panels that lie in a plane.
struct FlatClusters {
  std::vector<int> clusters;     ///< their numbers
  std::vector<Vector3> middles;  ///< of each, but for a ten-thousandth off the panels' edges, m
  std::vector<int> of_panel;     ///< which of them a panel belongs to; -1: none
};

/// A mesh of larger panels has its equations there. In the mean over a cluster they are felt as
/// closely by what lies around a sharp edge as those of its panels are, so that heave of a box
/// would change by next to nothing. Where a hull is curved the middle lies within it.
FlatClusters find_flat_clusters(const PanelMesh& mesh, const PanelClusters& clusters);

/// Panels of a problem that are taken together for a second, coarser solution of it.
struct CoarserPanels {
  PanelClusters bodies;
  FlatClusters flat;  ///< of the bodies
  PanelClusters surface;
};

/// @param largest of the surface's clusters, m across.
CoarserPanels make_coarser_panels(const PanelMesh& bodies, const PanelMesh& surface = {},
                                  double largest = std::numeric_limits<double>::infinity());

}  // namespace blocklift::dynamics

#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "structure/envelope/load_history.h"

/// The inner loops of the envelope: one point, all instants. Instants are screened in single
/// precision with a margin above all of its rounding; what counts is computed in double precision.
namespace blocklift::structure {

/// What the search at every point reads of a history, as it is read; made once for all points.
class SearchTables {
 public:
  /// The history must outlive this object.
  explicit SearchTables(const LoadHistory& history);

  const LoadHistory& history() const { return history_; }
  /// Half widths of a cluster's box, by coordinates: those of boxes_of_clusters(), together.
  const float* half_widths(int cluster) const {
    return half_widths_.data() + static_cast<std::ptrdiff_t>(cluster) * history_.rank();
  }

  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Responses to the coordinates from those to unit loads, times LoadHistory::modes().
  /// @param units rows, three or six a point, x unit loads.
  Rows in_coordinates(const Eigen::MatrixXd& units) const;

 private:
  const LoadHistory& history_;
  Rows modes_;  ///< with zeros up to a multiple of eight columns
  std::vector<float> half_widths_;
};

/// An extreme value and its instant.
struct Found {
  double value = -std::numeric_limits<double>::infinity();
  int instant = -1;
};

/// Extremes of the stress at one point; of the smallest principal stress its negative.
struct StressFound {
  Found von_mises, largest_principal, minus_smallest_principal;
};

/// Room for the search at one point, allocated once for many.
struct SearchWorkspace {
  /// The tables must outlive this object.
  explicit SearchWorkspace(const SearchTables& tables);
  const SearchTables& tables;
  std::vector<double> matrix;  ///< 5 rows of coordinates
  std::vector<double> norms;   ///< one
  std::vector<float> rows;     ///< responses, weighed responses and norms: 15 rows of coordinates
  std::vector<float> bounds;   ///< of packs, or two rows of those of clusters
  /// Cluster in which the last point had its largest von Mises stress or displacement: there the
  /// next one, which most often lies beside it, looks first. -1: none.
  int likely_cluster = -1;
  int likely_member = -1;  ///< and its place in the cluster
};

/// Largest von Mises stress of a point.
/// @param rows 6 x rank, row after row: stress (Pa) for unit coordinates.
/// @param floor what has been found elsewhere: only what reaches it is looked for, so that most
///   points of no interest cost little; it comes back where the point does not reach it.
Found search_von_mises(const double* rows, SearchWorkspace& workspace, const Found& floor = {});

/// Von Mises stress of a point at the instant that is likely to be its worst, Pa; minus infinity
/// without one.
double likely_von_mises(const double* rows, const SearchWorkspace& workspace);

/// @param rows as for search_von_mises. @param floor of each quantity, as there.
StressFound search_stress(const double* rows, SearchWorkspace& workspace,
                          const StressFound& floor = {});

/// @param rows 3 x rank, row after row: displacement (m) for unit coordinates.
/// @param floor as for search_von_mises.
Found search_displacement(const double* rows, SearchWorkspace& workspace, const Found& floor = {});

}  // namespace blocklift::structure

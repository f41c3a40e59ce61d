#pragma once

#include <limits>
#include <vector>

#include "structure/envelope/load_history.h"

/// The inner loops of the envelope: one point, all instants. Instants are screened in single
/// precision with a margin above all of its rounding; what counts is computed in double precision.
namespace blocklift::structure {

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
  explicit SearchWorkspace(const LoadHistory& history);
  std::vector<float> rows;    ///< responses, weighed responses and norms: 15 rows of coordinates
  std::vector<float> work;    ///< 11 rows of padded clusters
  std::vector<float> bounds;  ///< 3 rows of padded clusters
};

/// @param rows 6 x rank, row after row: stress (Pa) for unit coordinates.
/// @param floor what has been found elsewhere: only what reaches it is looked for, so that most
///   points of no interest cost little; it comes back where the point does not reach it.
StressFound search_stress(const LoadHistory& history, const double* rows,
                          SearchWorkspace& workspace, const StressFound& floor = {});

/// @param rows 3 x rank, row after row: displacement (m) for unit coordinates.
/// @param floor likewise.
Found search_displacement(const LoadHistory& history, const double* rows,
                          SearchWorkspace& workspace, const Found& floor = {});

}  // namespace blocklift::structure

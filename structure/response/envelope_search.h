#pragma once

#include <vector>

#include "structure/response/load_history.h"

/// The inner loops of the envelope: one point, all instants. Instants are screened in single
/// precision with a margin above all of its rounding; what counts is computed in double precision.
namespace blocklift::structure {

/// An extreme value and its instant.
struct Found {
  double value = 0;
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
StressFound search_stress(const LoadHistory& history, const double* rows,
                          SearchWorkspace& workspace);

/// @param rows 3 x rank, row after row: displacement (m) for unit coordinates.
Found search_displacement(const LoadHistory& history, const double* rows,
                          SearchWorkspace& workspace);

}  // namespace blocklift::structure

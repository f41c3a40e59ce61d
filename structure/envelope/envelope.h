#pragma once

#include <concepts>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/envelope/load_history.h"

namespace blocklift::structure {

/// Extreme of one quantity at each point of a body over all instants, and when it occurs.
struct PointExtremes {
  Eigen::VectorXd value;
  Eigen::VectorXi instant;  ///< the earliest of equals
};

/// Extremes of stress at points over a history.
struct StressEnvelope {
  PointExtremes von_mises;           ///< largest, Pa
  PointExtremes largest_principal;   ///< largest of the largest principal stress, Pa
  PointExtremes smallest_principal;  ///< smallest of the smallest principal stress, Pa
};

/// Responses at the points first .. first + count - 1: for stress rows 6 point + c (xx, yy, zz, xy,
/// yz, zx, Pa), for displacement rows 3 point + axis (m). Called from several threads at once.
///
/// A column is of a unit load, or of a coordinate of the history: what it was made from was
/// multiplied by LoadHistory::modes() then. That pays where many points are made from less than
/// they are themselves, as the stresses of cells from the motions of nodes.
class PointResponses {
 public:
  using At = std::function<Eigen::MatrixXd(int first, int count)>;

  /// Of unit loads.
  template <std::invocable<int, int> Callable>
  PointResponses(Callable of_units) : at_(std::move(of_units)) {}  // NOLINT: a lambda is one
  static PointResponses of_coordinates(At at) {
    PointResponses responses(std::move(at));
    responses.are_of_coordinates_ = true;
    return responses;
  }

  bool are_of_coordinates() const { return are_of_coordinates_; }
  Eigen::MatrixXd operator()(int first, int count) const { return at_(first, count); }

 private:
  At at_;
  bool are_of_coordinates_ = false;
};

/// The exact extremes of stress at `points` points over all instants of a history, by
/// superposition.
///
/// Von Mises stress and largest principal stress are convex functions of the loads, and over a
/// cluster of instants they are bounded by their values and slopes in its middle (the bounds stand
/// in envelope_kernel.inc). Clusters whose bound does not reach what has been found already are
/// passed over; for von Mises stress and displacements whole packs of clusters are first, by the
/// box that holds them. The instants of the others are screened in single precision, with a margin
/// larger than all of its rounding, and those that reach what has been found are computed in double
/// precision, principal stresses by a symmetric eigenvalue solver. So the result is that of
/// evaluating every instant in double precision, at a fraction of the work. Where loads never come
/// back to nearly the same values (noise) all clusters are screened.
///
/// @param threads 0: as many as the machine has.
/// @throws ModelError if a unit response is not a number.
StressEnvelope find_stress_envelope(const LoadHistory& history, int points,
                                    const PointResponses& stress, int threads = 0);

/// The von Mises stress of find_stress_envelope alone, at a fraction of its cost.
PointExtremes find_von_mises_envelope(const LoadHistory& history, int points,
                                      const PointResponses& stress, int threads = 0);

/// The largest von Mises stress over runs of points: run r has the points begin[r] .. begin[r + 1]
/// - 1. Points that do not reach what is known of their run cost little.
/// @param largest of each run what is known already (zero: nothing), Pa; it is raised.
void raise_von_mises(const LoadHistory& history, const std::vector<int>& begin,
                     const PointResponses& stress, Eigen::VectorXd& largest, int threads = 0);

/// The largest of one quantity over points and instants.
struct LargestValue {
  double value = 0;  ///< Pa; m
  int point = -1;    ///< -1: there is no point
  int instant = -1;
};

/// Extremes over sets of points.
struct LargestStresses {
  std::vector<LargestValue> von_mises;  ///< of each set
  LargestValue largest_principal;       ///< of all points
  LargestValue smallest_principal;      ///< of all points
};

/// The extremes of find_stress_envelope over sets of points, without those of each point: points
/// that nowhere reach what has been found already are passed over as a whole.
/// @param set_of the set of a point, 0 .. sets - 1; called from several threads at once.
LargestStresses find_largest_stresses(const LoadHistory& history, int points,
                                      const PointResponses& stress, int sets,
                                      const std::function<int(int)>& set_of, int threads = 0);

/// The largest von Mises stress over points in plane stress and instants.
/// @param stress rows 3 point + c (11, 22, 12, Pa).
LargestValue find_largest_in_plane(const LoadHistory& history, int points,
                                   const PointResponses& stress, int threads = 0);

/// The largest magnitude of a displacement over points and instants, m.
LargestValue find_largest_displacement(const LoadHistory& history, int points,
                                       const PointResponses& displacement, int threads = 0);

}  // namespace blocklift::structure

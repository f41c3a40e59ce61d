#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/response/load_history.h"
#include "structure/response/unit_responses.h"

namespace blocklift::structure {

/// Displacement and stress on the points of a surface in one load case.
struct SurfaceField {
  std::vector<Vector3> displacement;  ///< relative to the mean rigid motion, m
  std::vector<double> von_mises;      ///< Pa, averaged over the cells of one plate at a point
};

/// Outer surface of a block as quadrangles, for pictures. Points are shared within one face of one
/// plate only, so that edges stay sharp and stresses of different plates are not mixed.
class Surface {
 public:
  /// @param largest_point_count long element edges are divided up to as often as the degree, but
  ///   less if more points than this would result (then at least once).
  explicit Surface(const ElasticModel& model, int largest_point_count = 60000);

  const std::vector<Vector3>& points() const { return points_; }  ///< in the block frame, m
  /// Corners running round each quadrangle, normal outwards.
  const std::vector<std::array<int, 4>>& quads() const { return quads_; }
  /// Place of each quadrangle's group in group_names().
  const std::vector<int>& quad_groups() const { return quad_groups_; }
  const std::vector<std::string>& group_names() const { return group_names_; }

  /// Largest von Mises stress at each point over a history (of factors of the responses), Pa: the
  /// largest of the cells of one plate at a point, nothing averaged.
  std::vector<double> envelope(const UnitResponses& responses, const LoadHistory& history) const;
  /// Values of a load case at the points; the responses must be of the same model.
  SurfaceField evaluate(const UnitResponses& responses, const LoadCase& load_case) const;

 private:
  struct FacePatch {
    int cell;
    int face;
    std::array<int, 2> parts;
    std::vector<int> points;  // of the (parts[0] + 1) x (parts[1] + 1) grid, first runs fastest
  };
  void build(const ElasticModel& model, int division);

  std::vector<Vector3> points_;
  std::vector<std::array<int, 4>> quads_;
  std::vector<int> quad_groups_;
  std::vector<std::string> group_names_;
  std::vector<FacePatch> faces_;
};

}  // namespace blocklift::structure

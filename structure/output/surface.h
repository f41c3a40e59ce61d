#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/envelope/load_history.h"
#include "structure/response/unit_responses.h"

namespace blocklift::structure {

/// Displacement and stress on the points of a surface in one load case.
struct SurfaceField {
  std::vector<Vector3> displacement;  ///< relative to the mean rigid motion, m
  std::vector<double> von_mises;      ///< Pa, averaged over the cells of one plate at a point
};

/// A block's plates as quadrangles on their mid-surfaces, for pictures; beams as strips along their
/// centroid lines, as high as their sections. Of triangles two corners are one.
///
/// The stress of a point is the larger von Mises stress of the plate's two surfaces (which the
/// membrane's never exceeds), of a beam the largest magnitude of the normal stress over its
/// section. Points are shared within one plate only, so that edges stay sharp and stresses of
/// different plates are not mixed.
class Surface {
 public:
  /// @param largest_point_count cells are divided along their edges as often as the degree, but
  ///   less if more points than this would result (then at least once).
  explicit Surface(const ElasticModel& model, int largest_point_count = 60000);

  const std::vector<Vector3>& points() const { return points_; }  ///< in the block frame, m
  /// Corners running round each quadrangle, seen against the shell's normal.
  const std::vector<std::array<int, 4>>& quads() const { return quads_; }
  /// Place of each quadrangle's group in group_names().
  const std::vector<int>& quad_groups() const { return quad_groups_; }
  const std::vector<std::string>& group_names() const { return group_names_; }

  /// Stress of each point, the largest over a history (of factors of the responses), Pa: the
  /// largest of the cells of one plate at a point, nothing averaged. A list for each history.
  std::vector<std::vector<double>> envelopes(const UnitResponses& responses,
                                             const std::vector<LoadHistory>& histories) const;
  /// Values of load cases at the points; the responses must be of the same model.
  std::vector<SurfaceField> evaluate(const UnitResponses& responses,
                                     const std::vector<LoadCase>& load_cases) const;

 private:
  /// Points of a strip at one place along a beam.
  struct BeamStation {
    int cell = 0;
    double xi = 0;
    std::array<int, 2> points{};
  };
  /// A corner of a solid on the block's surface.
  struct SolidStation {
    int solid = 0;
    int corner = 0;
    int point = 0;
  };
  class Builder;
  /// Raise what is known of each point by the stresses of cells, sections and corners.
  /// @param motions of the history's coordinates (motions_in_coordinates).
  void take_envelope_of_shells(const Space& space, const Eigen::MatrixXd& motions,
                               const LoadHistory& history, std::vector<double>& largest) const;
  void take_envelope_of_beams(const Space& space, const Eigen::MatrixXd& motions,
                              const LoadHistory& history, std::vector<double>& largest) const;
  void take_envelope_of_solids(const Space& space, const Eigen::MatrixXd& motions,
                               const LoadHistory& history, std::vector<double>& largest) const;
  void add_shells(const Space& space, const Eigen::MatrixXd& motions,
                  std::vector<SurfaceField>& fields, std::vector<int>& shares) const;
  void add_solids(const Space& space, const Eigen::MatrixXd& motions,
                  std::vector<SurfaceField>& fields, std::vector<int>& shares) const;
  void add_beams(const Space& space, const Eigen::MatrixXd& motions,
                 std::vector<SurfaceField>& fields, std::vector<int>& shares) const;

  int division_ = 1;
  std::vector<Vector3> points_;
  std::vector<std::array<int, 4>> quads_;
  std::vector<int> quad_groups_;
  std::vector<std::string> group_names_;
  std::vector<int> cell_points_;  ///< (division + 1)^2 of each shell cell, xi fastest
  std::vector<BeamStation> stations_;
  std::vector<SolidStation> solid_stations_;
};

}  // namespace blocklift::structure

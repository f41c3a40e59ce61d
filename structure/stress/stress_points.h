#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include <Eigen/Core>

#include "structure/stress/shell_stress.h"

namespace blocklift::structure {

/// Where the stress of a block is looked at: the nodes of its shells' cells on both surfaces, as
/// each cell sees them (a hundredth of the cell inside it), the ends and the middles of its beams'
/// cells at the points of their sections (points_of_beam), and the corners of its solids.
///
/// Stresses are (11, 22, 0, 12, 0, 0) along directions of each cell's own, Pa: invariants can be
/// compared, components of different cells cannot. A beam has (11, 0, 0, 12, 0, 0),
/// a solid all six along the block's axes.
class StressPoints {
 public:
  /// The space must outlive this object.
  explicit StressPoints(const Space& space);

  int count() const {
    return shell_points_ + static_cast<int>(beam_points_.size() + solid_points_.size());
  }
  /// Place in Mesh::regions of a point.
  int region(int point) const;
  Vector3 place(int point) const;
  /// Rows 6 point + component for points first .. first + count - 1, a column for each of `motions`
  /// (freedoms x m). May be called from several threads.
  /// @param heat of as many cases as there are motions; null: none.
  Eigen::MatrixXd stresses(int first, int count, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                           const CellHeat* heat = nullptr) const;

 private:
  struct BeamPointOf {
    int cell = 0;
    double xi = 0;  ///< on its unit length
    int at = 0;     ///< place in points_of_beam
  };
  int points_per_cell() const { return 2 * space_.nodes_per_shell(); }
  std::unique_ptr<ShellStress> borrow() const;
  void give_back(std::unique_ptr<ShellStress> one) const;
  void shell_stresses(int point, int count, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                      const CellHeat* heat, Eigen::Ref<Eigen::MatrixXd> rows) const;

  const Space& space_;
  int shell_points_;
  std::vector<BeamPointOf> beam_points_;
  struct SolidPointOf {
    int solid = 0;
    int corner = 0;
  };
  const SolidPointOf& solid_point(int point) const {
    return solid_points_[static_cast<std::size_t>(point - shell_points_) - beam_points_.size()];
  }
  bool is_of_solid(int point) const {
    return point >= shell_points_ + static_cast<int>(beam_points_.size());
  }
  std::vector<SolidPointOf> solid_points_;
  mutable std::mutex lending_;
  mutable std::vector<std::unique_ptr<ShellStress>> recoveries_;
};

}  // namespace blocklift::structure

#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/mesh/fields/fields.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// A place within a cell of Space::shells().
struct CellPlace {
  int cell = -1;  ///< -1: in no cell
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
};

/// Finds the cell into which division has put a point of a shell.
class CellFinder {
 public:
  /// The space must outlive this object.
  explicit CellFinder(const Space& space) : space_(space), cells_(space.mesh().shells.size()) {
    for (std::size_t cell = 0; cell < space.shells().size(); ++cell)
      cells_[space.shells()[cell].shell].push_back(static_cast<int>(cell));
  }
  /// The cells that a shell was divided into.
  const std::vector<int>& cells_of(int shell) const { return cells_[shell]; }
  CellPlace find(const ShellPlace& place) const {
    for (const int cell : cells_[place.shell]) {
      const ShellCell& located = space_.shells()[cell];
      const Eigen::Vector2d xi = (place.xi - located.origin) / located.size;
      if (xi.minCoeff() >= -1e-9 && xi.maxCoeff() <= 1 + 1e-9) return {cell, xi};
    }
    return {};
  }

 private:
  const Space& space_;
  std::vector<std::vector<int>> cells_;
};

}  // namespace blocklift::structure

#pragma once

#include <memory>
#include <vector>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/tria.h>

#include "structure/space/space.h"

namespace blocklift::structure {

/// Some neighbouring numbers of a mesh's shells, each shell a part for itself of a triangulation.
///
/// Batches, since deal.II, once it is through with a part of a surface, looks for the next one from
/// the first cell on: the time to create a triangulation grows with the square of its parts.
struct ShellBatch {
  static constexpr int most_shells = 256;

  dealii::Triangulation<2, 3> cells;
  dealii::DoFHandler<2, 3> nodes;
  int first_shell = 0;
  int first_cell = 0;  ///< place in Space::shells() of the first active cell
  int first_node = 0;
};

/// All shells of a mesh, undivided. Batch b has material b, so that a cell tells its batch.
/// @throws ModelError if deal.II refuses a shell.
std::vector<std::unique_ptr<ShellBatch>> make_shell_batches(const Mesh& mesh);

/// Lagrange geometry of the shells' cells by points that are computed once for each of them.
class ShellMapping : public dealii::MappingQ<2, 3> {
 public:
  using Points = std::vector<dealii::Point<3>>;

  /// @param first_cells of the batches.
  /// @param points of each active cell, batch by batch, in the order of FE_Q's support points.
  ShellMapping(int degree, std::vector<int> first_cells, std::vector<Points> points);

  std::unique_ptr<dealii::Mapping<2, 3>> clone() const override;
  bool preserves_vertex_locations() const override { return false; }

 protected:
  Points compute_mapping_support_points(
      const dealii::Triangulation<2, 3>::cell_iterator& cell) const override;

 private:
  struct Table {
    std::vector<int> first_cells;
    std::vector<Points> points;
  };
  std::shared_ptr<const Table> table_;
};

}  // namespace blocklift::structure

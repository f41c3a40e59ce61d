#pragma once

#include <vector>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/hp/fe_collection.h>

#include "structure/space/shell_batch.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// deal.II's share of a Space. Only sources that integrate over cells include it.
struct Space::Implementation {
  explicit Implementation(int degree) : shell_element(static_cast<unsigned>(degree)) {}

  dealii::FE_Q<2, 3> shell_element;
  std::vector<std::unique_ptr<ShellBatch>> shell_batches;
  std::unique_ptr<ShellMapping> shell_mapping;
  /// Active cells in the order of Space::shells().
  std::vector<dealii::DoFHandler<2, 3>::active_cell_iterator> shell_cells;
  /// deal.II's number of each of an element's nodes when xi runs fastest.
  std::vector<unsigned> shell_order;

  dealii::Triangulation<1, 3> beams;
  dealii::hp::FECollection<1, 3> beam_elements;
  dealii::DoFHandler<1, 3> beam_nodes;
};

}  // namespace blocklift::structure

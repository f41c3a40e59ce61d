#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/part_model.h"
#include "structure/mesh/padeye/padeye.h"
#include "structure/stress/stress.h"

namespace blocklift::structure {

/// Stress of a plate of the padeye, of both cheek plates together.
struct PadeyePlateStress {
  Extreme checked_von_mises;  ///< Pa, in P
  Extreme peak_von_mises;     ///< largest of any element at any of its nodes, nothing averaged, Pa
};

/// Stress of a padeye by its plates.
struct PadeyeStress {
  PadeyePlateStress main_plate, cheeks;
  Eigen::VectorXd column_von_mises;  ///< of the mean over each of PadeyeMesh::columns, Pa
};

/// Places in PartMesh::solids of each column's elements; the part's mesh is the padeye's
/// (make_part_mesh), so that tags are the same.
std::vector<std::vector<int>> solids_of_columns(const PartMesh& mesh,
                                                const std::vector<PadeyeMesh::Column>& columns);

/// The checked stress is the membrane von Mises stress averaged over 50 x 50 mm (a disc of that
/// area, or of half the hole's radius if that is less), as IACS CSR (part 1, chapter 7) has it, of
/// each plate for itself. What is nearer to the base than the main plate's thickness is left out:
/// there a sub-model shows the coarse model's displacement, or its clamp, not stress
/// (Saint-Venant).
/// @param solids_of_column as solids_of_columns. @param displacement 3 a node, m.
PadeyeStress find_padeye_stress(const PadeyeGeometry& padeye,
                                const std::vector<PadeyeMesh::Column>& columns,
                                const std::vector<std::vector<int>>& solids_of_column,
                                const PartModel& part, const Eigen::VectorXd& displacement);

}  // namespace blocklift::structure

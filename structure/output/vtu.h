#pragma once

#include <string>

#include "structure/formulation/cell_heat.h"
#include "structure/response/unit_responses.h"

namespace blocklift::structure {

/// Writes a load case for ParaView: an XML file of VTK (`.vtu`, unstructured grid, binary).
///
/// Plates are drawn on their mid-surfaces, beams as lines along their centroids; cells are divided
/// along their edges as often as the element's degree, so that curved shapes show; points of
/// neighbouring cells are apart, so that stress jumps show. Point data: `displacement` (m, relative
/// to the mean rigid motion), `von_mises` (Pa, the larger of the plate's two surfaces),
/// `von_mises_top` (on the normal's side), `von_mises_bottom`, `von_mises_membrane`; of beams the
/// largest magnitude of the normal stress over the section, and under `von_mises_membrane` that of
/// its mean. Cell data: `group`, `material`, `plate` (numbers from 0; the names stand in the field
/// data `group_names`, `material_names` and `plate_names`), `thickness` (m; 0 of beams).
/// @throws ModelError if the file cannot be written.
void write_vtu(const std::string& path, const UnitResponses& responses, const LoadCase& load_case);

/// The same for a motion of a model (six rows a node), whose `displacement` is as it is given.
/// @param heat of one case; null: none.
void write_vtu(const std::string& path, const ElasticModel& model, const std::string& name,
               const Eigen::VectorXd& motion, const CellHeat* heat = nullptr);

}  // namespace blocklift::structure

#pragma once

#include <string>
#include <vector>

#include "structure/elasticity/natural_modes.h"
#include "structure/part/part_solution.h"

namespace blocklift::structure {

/// Writes a solved part for ParaView (`.vtu`). Point data: `displacement` (m), `stress` (six
/// components, averaged within a material, Pa), `von_mises` (of it, Pa). Cell data: `material`,
/// `element` (its number in the mesh file). Nodes inside elements and faces are left out.
/// @throws ModelError if the file cannot be written.
void write_part_vtu(const std::string& path, const PartModel& model, const PartSolution& solution);

/// Writes the shapes of natural modes for ParaView (`.vtu`): point data `mode_1`, `mode_2` and so
/// on (m/sqrt(kg)); cell data as above. @throws ModelError if the file cannot be written.
void write_part_modes_vtu(const std::string& path, const PartModel& model,
                          const NaturalModes& modes);

/// What is computed of a part.
struct PartAnalyses {
  bool has_loads = true;  ///< its loads, statically
  int modes = 0;          ///< so many natural modes
};

/// Writes mesh, materials and supports as input of CalculiX (`.inp`), in m, kg, s, N, Pa, with a
/// step for each analysis: *STATIC with the loads as nodal forces, just as they are solved here, so
/// that a comparison compares elements, and *FREQUENCY for the modes about the shape at rest.
/// Elements become C3D4, C3D10, C3D6, C3D15, C3D8 and C3D20.
/// @throws ModelError if the mesh holds elements with nodes inside faces, which CalculiX lacks, or
///   the file cannot be written.
void write_calculix(const std::string& path, const PartModel& model,
                    const PartAnalyses& analyses = {});

}  // namespace blocklift::structure

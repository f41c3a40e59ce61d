#pragma once

#include "dynamics/marine/panels/panel_model.h"
#include "dynamics/marine/panels/rankine_problem.h"

namespace blocklift::dynamics {

/// The mesh of a hull with those of its quadrangles cut into halves, or quarters, that have nothing
/// beside them to be taken together with (cluster_panels), on either of two opposite sides: an edge
/// of the mesh, one in a plane of symmetry, or a neighbour at more than 45 degrees. A side that is
/// one panel high becomes one of two.
PanelMesh halve_lone_rows(const PanelMesh& hull, const Symmetry& planes);

/// What rows of panels that cannot be taken together across miss of each mode's added mass at
/// infinite frequency, over the density, at first order in their breadth: twice the change by half
/// as broad ones, which costs a solution without a surface. 6N: m3, m4, m5; zero without such rows.
/// @param volumes each mode's added mass on itself by the panels as they are, over the density.
/// @throws SimulationError as RankinePart does.
Eigen::VectorXd calc_error_of_lone_rows(const PanelModel& model, const Eigen::VectorXd& volumes,
                                        const RankineSettings& settings);

/// Memory (bytes) that calc_error_of_lone_rows takes; 0 without such rows.
double lone_rows_bytes(const PanelModel& model);

}  // namespace blocklift::dynamics

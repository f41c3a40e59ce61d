#pragma once

#include <Eigen/Core>

#include "structure/response/elastic_model.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/shell_stress.h"

namespace blocklift::pipeline::test {

/// Stresses in the middle of each cell (rows of ShellStress, cell by cell) under the unit forces at
/// the lugs (columns), Pa/N.
inline Eigen::MatrixXd lug_stresses(const structure::ElasticModel& model) {
  const structure::UnitResponses responses(model);
  structure::ShellStress recovery(model.space(), Eigen::Vector2d(0.5, 0.5));
  const Eigen::MatrixXd motions = responses.displacements().leftCols(3 * model.lug_count());
  const auto cells = static_cast<Eigen::Index>(model.space().shells().size());
  Eigen::MatrixXd stresses(structure::shell_stress_rows * cells, motions.cols());
  for (Eigen::Index cell = 0; cell < cells; ++cell)
    stresses.middleRows<structure::shell_stress_rows>(structure::shell_stress_rows * cell) =
        recovery.of_all(static_cast<int>(cell), motions);
  return stresses;
}

}  // namespace blocklift::pipeline::test

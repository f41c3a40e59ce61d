#include "structure/envelope/coordinate_motions.h"

#include "algebra/products.h"
#include "structure/large_pages.h"

namespace blocklift::structure {

Eigen::MatrixXd motions_in_coordinates(const UnitResponses& responses, const LoadHistory& history) {
  const Eigen::MatrixXd& of_unit_loads = responses.displacements();
  Eigen::MatrixXd motions = make_large(of_unit_loads.rows(), history.rank());
  algebra::multiply(of_unit_loads, history.modes(), motions);
  return motions;
}

}  // namespace blocklift::structure

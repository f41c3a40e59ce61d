#include "structure/formulation/gauss_line.h"

#include <deal.II/base/quadrature_lib.h>

namespace blocklift::structure {

std::vector<double> gauss_places(int count) {
  const dealii::QGauss<1> rule(static_cast<unsigned>(count));
  std::vector<double> places;
  for (const auto& point : rule.get_points()) places.push_back(point[0]);
  return places;
}

std::vector<double> lagrange_at(const std::vector<double>& places, double x) {
  std::vector<double> values(places.size(), 1);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j)
      if (j != i) values[i] *= (x - places[j]) / (places[i] - places[j]);
  return values;
}

}  // namespace blocklift::structure

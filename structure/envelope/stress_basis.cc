#include "structure/envelope/stress_basis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "structure/envelope/load_history.h"
#include "structure/error.h"
#include "structure/system/matter.h"

namespace blocklift::structure {
namespace {

constexpr Eigen::Index fields = 12;    // of inertia
constexpr Eigen::Index densities = 4;  // 1, x, y, z times the steel's

/// The steel with its density times 1 (density 0) or a coordinate (1 to 3).
MassProperties unit_density(const MassProperties& mass, Eigen::Index density) {
  MassProperties unit = mass;
  unit.factor_alpha = density == 0 ? 1 : 0;
  unit.factor_beta = density == 0 ? Vector3::Zero().eval() : Vector3::Unit(density - 1).eval();
  return unit;
}

/// Takes out of loads, a column each, what would accelerate the block.
void balance(const ElasticModel& model, Eigen::MatrixXd& loads) {
  for (Eigen::Index k = 0; k < loads.cols(); ++k) {
    for (int pass = 0; pass < 2; ++pass) {  // the second removes the rounding of the first
      const Eigen::Matrix<double, 6, 1> field =
          balancing_field(model.mass_properties(), resultant(model.space(), loads.col(k)))
              .coefficients()
              .head<6>();
      loads.col(k) += model.inertia_loads().leftCols<6>() * field;
    }
  }
}

}  // namespace

StressBasis::StressBasis(std::vector<Square> squares,
                         const Eigen::Map<const Eigen::MatrixXd>& components,
                         std::shared_ptr<const void> keeper)
    : squares_(std::move(squares)),
      keeper_(std::move(keeper)),
      first_(components.data()),
      rows_(components.rows()),
      columns_(components.cols()),
      weights_(components.colwise().norm().transpose() /
               std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, components.rows())))) {
  if (rows_ != 3 * std::ssize(squares_))
    throw ModelError(
        fmt::format("a basis of stress has {} components for {} squares", rows_, squares_.size()));
}

StressBasis::StressBasis(std::vector<Square> squares, Eigen::MatrixXd components)
    : StressBasis([&] {
        const auto kept = std::make_shared<const Eigen::MatrixXd>(std::move(components));
        return StressBasis(std::move(squares), {kept->data(), kept->rows(), kept->cols()}, kept);
      }()) {}

Eigen::VectorXd StressBasis::factors(const LoadCase& load_case, const MassProperties& mass) const {
  const auto lug_forces = static_cast<Eigen::Index>(3 * load_case.lug_forces_B.size());
  if (columns_ != lug_forces + densities * fields + load_case.added.size())
    throw ModelError(
        fmt::format("load case \"{}\" has {} lug forces and {} added loads; the block's basis has "
                    "{} forces and added loads in all",
                    load_case.name, load_case.lug_forces_B.size(), load_case.added.size(),
                    columns_ - densities * fields));
  Eigen::VectorXd all(columns_);
  for (std::size_t lug = 0; lug < load_case.lug_forces_B.size(); ++lug)
    all.segment<3>(3 * lug) = load_case.lug_forces_B[lug];
  const Eigen::Matrix<double, fields, 1> field = load_case.field.coefficients();
  all.segment<fields>(lug_forces) = mass.factor_alpha * field;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    all.segment<fields>(lug_forces + (1 + axis) * fields) = mass.factor_beta[axis] * field;
  all.tail(load_case.added.size()) = load_case.added;
  return all;
}

StressBasis make_stress_basis(const UnitResponses& responses, std::vector<Square> squares,
                              int threads) {
  const ElasticModel& model = responses.model();
  const Eigen::Index lug_forces = model.lug_loads().cols();
  Eigen::MatrixXd components(3 * squares.size(), lug_forces + densities * fields);
  // The balanced responses to the lugs' unit forces are known; densities go one after another, for
  // their loads fill the memory.
  components.leftCols(lug_forces) =
      CheckedStress(model, responses.displacements().leftCols(lug_forces), squares, threads)
          .components();
  for (Eigen::Index density = 0; density < densities; ++density) {
    Eigen::MatrixXd loads =
        inertia_loads(model.space(), unit_density(model.mass_properties(), density));
    balance(model, loads);
    components.middleCols<fields>(lug_forces + density * fields) =
        CheckedStress(model, responses.solve(loads), squares, threads).components();
  }
  return {std::move(squares), std::move(components)};
}

void add_loads(const UnitResponses& responses, Eigen::MatrixXd loads, StressBasis& basis,
               int threads) {
  const ElasticModel& model = responses.model();
  balance(model, loads);
  const Eigen::MatrixXd added =
      CheckedStress(model, responses.solve(loads), basis.squares(), threads).components();
  const auto known = basis.components();
  Eigen::MatrixXd all(known.rows(), known.cols() + added.cols());
  all << known, added;
  basis = StressBasis(basis.squares(), std::move(all));
}

LargestValue find_largest_checked(const StressBasis& basis, const Eigen::MatrixXd& factors,
                                  int threads) {
  const auto unit_stress = [&](int first, int count) -> Eigen::MatrixXd {
    return basis.components().middleRows(3L * first, 3L * count);
  };
  return find_largest_in_plane(LoadHistory(factors, basis.weights()),
                               static_cast<int>(basis.squares().size()), unit_stress, threads);
}

}  // namespace blocklift::structure

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

StressOfBlock::StressOfBlock(const StressBasis& basis, const MassProperties& mass, std::size_t lugs)
    : basis_(basis),
      lug_forces_(static_cast<Eigen::Index>(3 * lugs)),
      density_(mass.factor_alpha, mass.factor_beta.x(), mass.factor_beta.y(),
               mass.factor_beta.z()) {
  const Eigen::VectorXd& unit = basis.weights();
  const Eigen::Index added = unit.size() - lug_forces_ - densities * fields;
  if (added < 0)
    throw ModelError(
        fmt::format("a basis of stress of {} unit loads is not one of {} lugs", unit.size(), lugs));
  const auto of_densities =
      unit.segment<densities * fields>(lug_forces_).reshaped(fields, densities);
  weights_.resize(lug_forces_ + fields + added);
  weights_.head(lug_forces_) = unit.head(lug_forces_);
  weights_.segment<fields>(lug_forces_) = (of_densities * density_.asDiagonal()).rowwise().norm();
  weights_.tail(added) = unit.tail(added);
}

Eigen::VectorXd StressOfBlock::factors(const LoadCase& load_case) const {
  const auto lug_forces = static_cast<Eigen::Index>(3 * load_case.lug_forces_B.size());
  const Eigen::Index added = load_case.added.size();
  if (lug_forces != lug_forces_ || unit_loads() != lug_forces + fields + added)
    throw ModelError(
        fmt::format("load case \"{}\" has {} lug forces and {} added loads; the block's basis has "
                    "{} and {}",
                    load_case.name, load_case.lug_forces_B.size(), added, lug_forces_ / 3,
                    unit_loads() - fields - lug_forces_));
  Eigen::VectorXd all(unit_loads());
  for (std::size_t lug = 0; lug < load_case.lug_forces_B.size(); ++lug)
    all.segment<3>(3 * lug) = load_case.lug_forces_B[lug];
  all.segment<fields>(lug_forces) = load_case.field.coefficients();
  all.tail(added) = load_case.added;
  return all;
}

Eigen::MatrixXd StressOfBlock::components(int first_square, int count) const {
  const auto of_all = basis_.components().middleRows(3L * first_square, 3L * count);
  const Eigen::Index added = unit_loads() - lug_forces_ - fields;
  Eigen::MatrixXd result(3L * count, unit_loads());
  result.leftCols(lug_forces_) = of_all.leftCols(lug_forces_);
  result.rightCols(added) = of_all.rightCols(added);
  auto own = result.middleCols<fields>(lug_forces_);
  own = density_[0] * of_all.middleCols<fields>(lug_forces_);
  for (Eigen::Index density = 1; density < densities; ++density)
    own += density_[density] * of_all.middleCols<fields>(lug_forces_ + density * fields);
  return result;
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

LargestValue find_largest_checked(const StressOfBlock& block, const Eigen::MatrixXd& factors,
                                  int threads) {
  const auto unit_stress = [&](int first, int count) { return block.components(first, count); };
  return find_largest_in_plane(LoadHistory(factors, block.weights()),
                               static_cast<int>(block.squares().size()), unit_stress, threads);
}

}  // namespace blocklift::structure

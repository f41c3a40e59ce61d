#include "structure/response/unit_responses.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/elasticity/linear_solver.h"
#include "structure/elasticity/stiffness.h"
#include "structure/error.h"
#include "structure/response/support.h"
#include "structure/stopwatch.h"

namespace blocklift::structure {

struct UnitResponses::System {
  System(SparseLower stiffness, std::vector<FixedUnknown> support)
      : equations(std::move(stiffness), std::move(support)) {}
  ConstrainedSystem equations;
};

namespace {

constexpr double standard_gravity = 9.80665;  // m/s^2

}  // namespace

UnitResponses::~UnitResponses() = default;

UnitResponses::UnitResponses(const ElasticModel& model, int threads) : model_(model) {
  if (threads <= 0) threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  Stopwatch watch;
  SparseLower stiffness = assemble_stiffness(model.mesh(), model.space(), threads);
  timing_.assembly_s = watch.lap();
  system_ = std::make_unique<System>(std::move(stiffness),
                                     statically_determinate_support(model.space().nodes));
  timing_.factor_bytes = system_->equations.factor_bytes();
  timing_.analysis_s = watch.lap();
  system_->equations.factorise();
  timing_.factorisation_s = watch.lap();
  const Eigen::MatrixXd loads = basis_loads();
  displacements_ = system_->equations.solve(loads);
  reactions_ = system_->equations.reactions(displacements_, loads);
  timing_.solve_s = watch.lap();
}

Eigen::MatrixXd UnitResponses::basis_loads() {
  const Eigen::Index lug_forces = 3 * model_.lug_count();
  Eigen::MatrixXd loads(model_.unknowns(), lug_forces + 12);
  loads << model_.lug_loads(), model_.inertia_loads().rightCols<6>(),
      model_.inertia_loads().leftCols<6>();
  balancing_.resize(6, lug_forces + 6);
  for (Eigen::Index k = 0; k < lug_forces + 6; ++k) {
    // Twice: the second pass removes the rounding of the first.
    balancing_.col(k).setZero();
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::Matrix<double, 6, 1> field =
          balancing_field(model_.mass_properties(), resultant(model_.space().nodes, loads.col(k)))
              .coefficients()
              .head<6>();
      loads.col(k) += model_.inertia_loads().leftCols<6>() * field;
      balancing_.col(k) += field;
    }
  }
  return loads;
}

Eigen::VectorXd UnitResponses::coefficients(const LoadCase& load_case) const {
  if (static_cast<int>(load_case.lug_forces_B.size()) != model_.lug_count())
    throw ModelError(fmt::format("load case \"{}\" has {} lug forces; the block has {} lugs",
                                 load_case.name, load_case.lug_forces_B.size(),
                                 model_.lug_count()));
  const Eigen::Index lug_forces = 3 * model_.lug_count();
  Eigen::VectorXd all(lug_forces + 12);
  for (std::size_t lug = 0; lug < load_case.lug_forces_B.size(); ++lug)
    all.segment<3>(static_cast<Eigen::Index>(3 * lug)) = load_case.lug_forces_B[lug];
  const Eigen::Matrix<double, 12, 1> field = load_case.field.coefficients();
  all.segment<6>(lug_forces) = field.tail<6>();
  all.tail<6>() = field.head<6>() - balancing_ * all.head(lug_forces + 6);
  return all;
}

Eigen::VectorXd UnitResponses::load_vector(const LoadCase& load_case) const {
  coefficients(load_case);  // for its check
  Eigen::VectorXd load = model_.inertia_loads() * load_case.field.coefficients();
  for (std::size_t lug = 0; lug < load_case.lug_forces_B.size(); ++lug)
    load += model_.lug_loads().middleCols<3>(static_cast<Eigen::Index>(3 * lug)) *
            load_case.lug_forces_B[lug];
  return load;
}

Eigen::VectorXd UnitResponses::displacement(const LoadCase& load_case) const {
  return displacements_ * coefficients(load_case);
}

Eigen::VectorXd UnitResponses::solve_directly(const LoadCase& load_case) const {
  return system_->equations.solve(load_vector(load_case));
}

Eigen::VectorXd UnitResponses::without_rigid_motion(const Eigen::VectorXd& displacement) const {
  // int rho u and int rho x cross u are minus the work of the unit acceleration fields.
  const MassProperties& mass = model_.mass_properties();
  const Eigen::Matrix<double, 6, 1> work =
      -model_.inertia_loads().leftCols<6>().transpose() * displacement;
  const Vector3 mean = work.head<3>() / mass.mass;
  const Vector3 rotation = mass.inertia_BBcm_B.ldlt().solve(
      work.tail<3>() - mass.centre_of_mass_B.cross(work.head<3>().eval()));
  Eigen::VectorXd relative = displacement;
  for (Eigen::Index n = 0; n < model_.space().nodes.cols(); ++n)
    relative.segment<3>(3 * n) -=
        mean + rotation.cross(model_.space().nodes.col(n) - mass.centre_of_mass_B);
  return relative;
}

Eigen::Matrix3Xd UnitResponses::elastic_displacement(const LoadCase& load_case) const {
  const Eigen::VectorXd relative = without_rigid_motion(displacement(load_case));
  return Eigen::Map<const Eigen::Matrix3Xd>(relative.data(), 3, relative.size() / 3);
}

LoadBalance UnitResponses::balance(const LoadCase& load_case) const {
  const MassProperties& mass = model_.mass_properties();
  LoadBalance result;
  result.resultant = resultant(model_.space().nodes, load_vector(load_case));
  result.resultant.moment -= mass.centre_of_mass_B.cross(result.resultant.force);
  // A block that stands still on the ground has neither lug forces nor a field: its weight, which is
  // what cancels there, is the least that residuals are compared with.
  const double field = load_case.field.acceleration_less_gravity.norm();
  const double weight = mass.mass * std::max(field, standard_gravity);
  double load = 0;
  for (const Vector3& force : load_case.lug_forces_B) load += force.norm();
  load = std::max(load, weight);
  const double gyration = std::sqrt(mass.inertia_BBcm_B.trace() / (2 * mass.mass));
  result.force_residual = result.resultant.force.norm() / load;
  result.moment_residual = result.resultant.moment.norm() / (load * gyration);
  result.reaction_over_weight =
      (reactions_ * coefficients(load_case)).cwiseAbs().maxCoeff() / weight;
  return result;
}

Eigen::MatrixXd UnitResponses::solve(const Eigen::MatrixXd& balanced_loads) const {
  return system_->equations.solve(balanced_loads);
}

}  // namespace blocklift::structure

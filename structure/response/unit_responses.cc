#include "structure/response/unit_responses.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "algebra/products.h"
#include "parallel/threads.h"
#include "structure/error.h"
#include "structure/large_pages.h"
#include "structure/response/loose_block.h"
#include "structure/stopwatch.h"
#include "structure/system/assembly.h"
#include "structure/system/linear_solver.h"
#include "structure/system/matter.h"
#include "structure/system/support.h"

namespace blocklift::structure {

struct UnitResponses::System {
  System(SparseLower&& stiffness, std::vector<FixedUnknown> support)
      : equations(std::move(stiffness), std::move(support)) {}
  ConstrainedSystem equations;
};

namespace {

constexpr double standard_gravity = 9.80665;  // m/s^2

/// Force and moment about Bo of loads, a column each.
Eigen::MatrixXd resultants_of(const Space& space, const Eigen::MatrixXd& loads) {
  Eigen::MatrixXd resultants(6, loads.cols());
  parallel::in_batches(static_cast<int>(loads.cols()), 1, 0, [&](int k, int) {
    const Wrench wrench = resultant(space, loads.col(k));
    resultants.col(k) << wrench.force, wrench.moment;
  });
  return resultants;
}

}  // namespace

UnitResponses::~UnitResponses() = default;

UnitResponses::UnitResponses(const ElasticModel& model, int threads) : model_(model) {
  if (threads <= 0) threads = parallel::usable_threads();
  Stopwatch watch;
  SparseLower stiffness = assemble_stiffness(model.space(), threads);
  timing_.assembly_s = watch.lap();
  auto system =
      std::make_shared<System>(std::move(stiffness), statically_determinate_support(model.space()));
  timing_.factor_bytes = system->equations.factor_bytes();
  timing_.analysis_s = watch.lap();
  try {
    system->equations.factorise();
  } catch (const LooseUnknown& loose) {
    system.reset();
    refuse_mechanism(model.space(), statically_determinate_support(model.space()), loose, threads);
  }
  system_ = system;
  timing_.factorisation_s = watch.lap();
  added_loads_.resize(model_.freedoms(), 0);
  solve_basis();
  timing_.solve_s = watch.lap();
}

UnitResponses::UnitResponses(const ElasticModel& model, const UnitResponses& same_stiffness)
    : model_(model), system_(same_stiffness.system_) {
  if (&model.space() != &same_stiffness.model_.space())
    throw ModelError("a factor serves models of the same elements only");
  Stopwatch watch;
  timing_.factor_bytes = system_->equations.factor_bytes();
  added_loads_.resize(model_.freedoms(), 0);
  solve_basis();
  timing_.solve_s = watch.lap();
}

void UnitResponses::balance_loads(Eigen::MatrixXd& loads,
                                  Eigen::Ref<Eigen::MatrixXd> accelerations) const {
  parallel::in_batches(static_cast<int>(accelerations.cols()), 1, 0, [&](int k, int) {
    // Twice: the second pass removes the rounding of the first.
    accelerations.col(k).setZero();
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::Matrix<double, 6, 1> field =
          balancing_field(model_.mass_properties(), resultant(model_.space(), loads.col(k)))
              .coefficients()
              .head<6>();
      loads.col(k) += model_.inertia_loads().leftCols<6>() * field;
      accelerations.col(k) += field;
    }
  });
}

void UnitResponses::solve_basis() {
  const Eigen::Index lug_forces = 3 * model_.lug_count();
  Eigen::MatrixXd loads = make_large(model_.freedoms(), lug_forces + 12);
  loads << model_.lug_loads(), model_.inertia_loads().rightCols<6>(),
      model_.inertia_loads().leftCols<6>();
  balancing_.resize(6, lug_forces + 6);
  balance_loads(loads, balancing_);  // the plain accelerations stay as they are
  displacements_ = solve(loads, reactions_);
  check_stiffness();
  resultants_.resize(6, lug_forces + 12);
  resultants_ << resultants_of(model_.space(), model_.lug_loads()),
      resultants_of(model_.space(), model_.inertia_loads());
}

// Rounding may leave a mechanism some stiffness. Held at three points it moves then by some 1e8
// times its size under its own weight; what soft springs or slender bars hold by far less.
void UnitResponses::check_stiffness() const {
  const Space& space = model_.space();
  const double farthest =
      1e6 * (space.nodes().rowwise().maxCoeff() - space.nodes().rowwise().minCoeff()).norm();
  for (int freedom = 0; freedom < space.freedoms(); ++freedom)
    if (freedom % 6 < 3 &&
        !(standard_gravity * displacements_.row(freedom).tail<6>().head<3>().cwiseAbs().maxCoeff() <
          farthest)) {
      Eigen::Index column = 0;
      displacements_.row(freedom).tail<6>().head<3>().cwiseAbs().maxCoeff(&column);
      refuse_mechanism(space, displacements_.col(displacements_.cols() - 6 + column));
    }
}

Eigen::MatrixXd UnitResponses::solve(const Eigen::MatrixXd& loads,
                                     Eigen::MatrixXd& reactions) const {
  const Eigen::MatrixXd reduced = model_.space().reduce(loads);
  const Eigen::MatrixXd solution = system_->equations.solve(reduced);
  reactions = system_->equations.reactions(solution, reduced);
  return model_.space().expand(solution);
}

void UnitResponses::add_loads(const Eigen::MatrixXd& added) {
  // So many that reading the factor for each few costs little, and so few that what is needed on
  // the way stays small beside the basis.
  constexpr Eigen::Index at_once = 32;
  if (added.cols() == 0) return;
  Stopwatch watch;
  const auto append = [](Eigen::MatrixXd& all, Eigen::Index more) {
    all.conservativeResize(Eigen::NoChange, all.cols() + more);
    return all.rightCols(more);
  };
  // The plain accelerations stay at the end.
  const Eigen::Index begin = displacements_.cols() - 6;
  const auto make_room = [&](Eigen::MatrixXd& all) {
    const Eigen::MatrixXd plain = all.rightCols<6>();
    append(all, added.cols());
    all.rightCols<6>() = plain;
  };
  make_room(displacements_);
  make_room(reactions_);
  auto accelerations = append(balancing_, added.cols());
  for (Eigen::Index first = 0; first < added.cols(); first += at_once) {
    const Eigen::Index count = std::min(at_once, added.cols() - first);
    Eigen::MatrixXd loads = added.middleCols(first, count), reactions;
    balance_loads(loads, accelerations.middleCols(first, count));
    displacements_.middleCols(begin + first, count) = solve(loads, reactions);
    reactions_.middleCols(begin + first, count) = reactions;
  }
  append(resultants_, added.cols()) = resultants_of(model_.space(), added);
  append(added_loads_, added.cols()) = added;
  timing_.solve_s += watch.lap();
}

Eigen::VectorXd UnitResponses::coefficients(const LoadCase& load_case) const {
  if (static_cast<int>(load_case.lug_forces_B.size()) != model_.lug_count())
    throw ModelError(fmt::format("load case \"{}\" has {} lug forces; the block has {} lugs",
                                 load_case.name, load_case.lug_forces_B.size(),
                                 model_.lug_count()));
  if (load_case.added.size() != 0 && load_case.added.size() != added_loads_.cols())
    throw ModelError(fmt::format("load case \"{}\" has factors of {} added loads; there are {}",
                                 load_case.name, load_case.added.size(), added_loads_.cols()));
  const Eigen::Index lug_forces = 3 * model_.lug_count(), balanced = balancing_.cols();
  Eigen::VectorXd all = Eigen::VectorXd::Zero(balanced + 6);
  for (std::size_t lug = 0; lug < load_case.lug_forces_B.size(); ++lug)
    all.segment<3>(3 * lug) = load_case.lug_forces_B[lug];
  const Eigen::Matrix<double, 12, 1> field = load_case.field.coefficients();
  all.segment<6>(lug_forces) = field.tail<6>();
  all.segment(lug_forces + 6, load_case.added.size()) = load_case.added;
  all.tail<6>() = field.head<6>() - balancing_ * all.head(balanced);
  return all;
}

Eigen::VectorXd UnitResponses::load_vector(const LoadCase& load_case) const {
  coefficients(load_case);  // for its check
  Eigen::VectorXd load = model_.inertia_loads() * load_case.field.coefficients();
  for (std::size_t lug = 0; lug < load_case.lug_forces_B.size(); ++lug)
    load += model_.lug_loads().middleCols<3>(3 * lug) * load_case.lug_forces_B[lug];
  if (load_case.added.size() > 0) load += added_loads_ * load_case.added;
  return load;
}

Eigen::VectorXd UnitResponses::displacement(const LoadCase& load_case) const {
  return displacements_ * coefficients(load_case);
}

Eigen::MatrixXd UnitResponses::displacements_of(const std::vector<LoadCase>& load_cases) const {
  Eigen::MatrixXd factors(count(), static_cast<Eigen::Index>(load_cases.size()));
  for (std::size_t c = 0; c < load_cases.size(); ++c)
    factors.col(static_cast<Eigen::Index>(c)) = coefficients(load_cases[c]);
  Eigen::MatrixXd motions = make_large(displacements_.rows(), factors.cols());
  algebra::multiply(displacements_, factors, motions);
  return motions;
}

Eigen::VectorXd UnitResponses::solve_directly(const LoadCase& load_case) const {
  return solve(load_vector(load_case));
}

Eigen::VectorXd UnitResponses::without_rigid_motion(const Eigen::VectorXd& displacement) const {
  // int rho u and int rho x cross u are minus the work of the unit acceleration fields.
  const MassProperties& mass = model_.mass_properties();
  const Eigen::Matrix<double, 6, 1> work =
      -model_.inertia_loads().leftCols<6>().transpose() * displacement;
  const Vector3 mean = work.head<3>() / mass.mass;
  const Vector3 rotation = algebra::solve_symmetric<3>(
      mass.inertia_BBcm_B, work.tail<3>() - mass.centre_of_mass_B.cross(work.head<3>().eval()));
  Eigen::VectorXd relative = displacement;
  for (Eigen::Index n = 0; n < model_.space().node_count(); ++n) {
    relative.segment<3>(6 * n) -=
        mean + rotation.cross(model_.space().nodes().col(n) - mass.centre_of_mass_B);
    relative.segment<3>(6 * n + 3) -= rotation;
  }
  return relative;
}

Eigen::Matrix3Xd UnitResponses::elastic_displacement(const LoadCase& load_case) const {
  const Eigen::VectorXd relative = without_rigid_motion(displacement(load_case));
  return Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>(relative.data(), 6,
                                                                    relative.size() / 6)
      .topRows<3>();
}

LoadBalance UnitResponses::balance(const LoadCase& load_case) const {
  const MassProperties& mass = model_.mass_properties();
  const Eigen::VectorXd factors = coefficients(load_case);
  const Eigen::Index lug_forces = 3 * model_.lug_count(), added = load_case.added.size();
  const Eigen::Matrix<double, 6, 1> sum =
      resultants_.leftCols(lug_forces) * factors.head(lug_forces) +
      resultants_.middleCols<12>(lug_forces) * load_case.field.coefficients() +
      resultants_.rightCols(added) * load_case.added;
  LoadBalance result;
  result.resultant = {sum.head<3>(), sum.tail<3>()};
  result.resultant.moment -= mass.centre_of_mass_B.cross(result.resultant.force);
  // A block that stands still on the ground has neither lug forces nor a field: its weight, which
  // is what cancels there, is the least that residuals are compared with.
  const double field = load_case.field.acceleration_less_gravity.norm();
  const double weight = mass.mass * std::max(field, standard_gravity);
  double load = 0;
  for (const Vector3& force : load_case.lug_forces_B) load += force.norm();
  load = std::max(load, weight);
  const double gyration = std::sqrt(mass.inertia_BBcm_B.trace() / (2 * mass.mass));
  result.force_residual = result.resultant.force.norm() / load;
  result.moment_residual = result.resultant.moment.norm() / (load * gyration);
  result.reaction_over_weight = (reactions_ * factors).cwiseAbs().maxCoeff() / weight;
  return result;
}

Eigen::MatrixXd UnitResponses::solve(const Eigen::MatrixXd& balanced_loads) const {
  Eigen::MatrixXd reactions;
  return solve(balanced_loads, reactions);
}

}  // namespace blocklift::structure

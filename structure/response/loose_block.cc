#include "structure/response/loose_block.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/space/freedom_text.h"
#include "structure/system/assembly.h"

namespace blocklift::structure {

namespace {

using Motion = LooseBlock::Motion;

std::string describe_mechanism(const Space& space, int freedom) {
  return fmt::format(
      "the block is a mechanism: a part of it can move against the rest, and nothing resists "
      "({}){}",
      describe_freedom(space, freedom), hint_at_torsion(space.mesh()));
}

double size_of(const Space& space) {
  return (space.nodes().rowwise().maxCoeff() - space.nodes().rowwise().minCoeff()).norm();
}

/// A motion less the rigid one that most nodes have: that of the least sum of distances, by least
/// squares weighted again and again (Weiszfeld).
Motion against_most(const Space& space, Motion motion) {
  constexpr int steps = 15;
  const Vector3 middle = space.nodes().rowwise().mean();
  const double size = size_of(space);
  const double least = 1e-9 * motion.topRows<3>().colwise().norm().maxCoeff();
  if (!(least > 0)) return motion;
  const auto arm = [&](Eigen::Index n) -> Vector3 {
    return (space.nodes().col(n) - middle) / size;
  };
  for (int step = 0; step < steps; ++step) {
    Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    for (Eigen::Index n = 0; n < motion.cols(); ++n) {
      Eigen::Matrix<double, 3, 6> rigid;
      for (int k = 0; k < 3; ++k) {
        rigid.col(k) = Vector3::Unit(k);
        rigid.col(3 + k) = Vector3::Unit(k).cross(arm(n));
      }
      const Vector3 moved = motion.col(n).head<3>();
      const double weight = 1 / (moved.norm() + least);
      matrix += weight * rigid.transpose() * rigid;
      right += weight * rigid.transpose() * moved;
    }
    const Eigen::Matrix<double, 6, 1> most = algebra::least_squares(matrix, right);
    for (Eigen::Index n = 0; n < motion.cols(); ++n) {
      motion.col(n).head<3>() -= most.head<3>() + most.tail<3>().cross(arm(n));
      motion.col(n).tail<3>() -= most.tail<3>() / size;
    }
  }
  return motion;
}

}  // namespace

Eigen::VectorXd find_free_motion(const Space& space, const FactoriseHeld& factorise, int threads) {
  constexpr double raised = 1e-10;
  constexpr int steps = 3;
  SparseLower stiffness = assemble_stiffness(space, threads);
  const Eigen::VectorXd diagonal = stiffness.diagonal();
  for (Eigen::Index i = 0; i < stiffness.cols(); ++i) stiffness.coeffRef(i, i) *= 1 + raised;
  try {
    const SolveEquations solve = factorise(stiffness);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    Eigen::VectorXd motion =
        Eigen::VectorXd::NullaryExpr(diagonal.size(), [&] { return any(random); });
    for (int step = 0; step < steps; ++step) {
      motion = solve(diagonal.cwiseProduct(motion));
      motion /= motion.cwiseAbs().maxCoeff();
    }
    return space.expand(motion);
  } catch (const ModelError&) {
    return {};
  }
}

int most_moved_freedom(const Space& space, const Eigen::Ref<const Eigen::VectorXd>& motion) {
  const Eigen::Map<const Motion> of_nodes(motion.data(), 6, motion.size() / 6);
  Eigen::Index node = 0, turning = 0, direction = 0;
  const double moved = of_nodes.topRows<3>().colwise().norm().maxCoeff(&node);
  const double turned = of_nodes.bottomRows<3>().colwise().norm().maxCoeff(&turning);
  const bool spins = moved < 1e-6 * turned * size_of(space);
  if (spins) node = turning;
  of_nodes.col(node).segment<3>(spins ? 3 : 0).cwiseAbs().maxCoeff(&direction);
  return static_cast<int>(6 * node + (spins ? 3 : 0) + direction);
}

void refuse_mechanism(const Space& space, const Eigen::VectorXd& motion) {
  const Motion of_nodes =
      against_most(space, Eigen::Map<const Motion>(motion.data(), 6, motion.size() / 6));
  const auto vertices = static_cast<int>(space.mesh().vertices.size());
  Motion of_vertices(6, vertices);
  for (int v = 0; v < vertices; ++v) {
    const int of = space.node_of_vertex(v);
    of_vertices.col(v).setZero();
    if (of >= 0) of_vertices.col(v) = of_nodes.col(of);
  }
  const int freedom = most_moved_freedom(space, of_nodes.reshaped());
  throw LooseBlock(describe_mechanism(space, freedom), std::move(of_vertices));
}

void refuse_mechanism(const Space& space, const std::vector<FixedUnknown>& support,
                      const LooseUnknown& loose, int threads) {
  const auto factorise = [&](const SparseLower& stiffness) -> SolveEquations {
    auto equations = std::make_shared<ConstrainedSystem>(SparseLower(stiffness), support);
    equations->factorise();
    return [equations](const Eigen::MatrixXd& loads) { return equations->solve(loads); };
  };
  const Eigen::VectorXd motion = find_free_motion(space, factorise, threads);
  if (motion.size() == 0)
    throw LooseBlock(describe_mechanism(space, freedom_of(space, loose.unknown)), {});
  refuse_mechanism(space, motion);
}

}  // namespace blocklift::structure

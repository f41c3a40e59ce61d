#include "pipeline/measurement/weighing.h"

#include <cmath>

#include "algebra/decompositions.h"

namespace blocklift::pipeline {
namespace {

constexpr Eigen::Index equations = 3;  // vertical force, moments about the two level axes
constexpr Eigen::Index stretches = 10;

struct WeighingEquations {
  Eigen::MatrixXd matrix;   ///< [3 n x 4], for m and L^-1 m c, L a length
  Eigen::MatrixXd by_rope;  ///< [3 n x ropes], what each cell adds to the right-hand side
  double length = 1;        ///< m, makes moments and forces alike
};

WeighingEquations weighing_equations(const std::vector<WeighingInstant>& instants, double gravity) {
  const auto rows = equations * static_cast<Eigen::Index>(instants.size());
  const auto ropes = static_cast<Eigen::Index>(instants.front().force_W.size());
  WeighingEquations system{Eigen::MatrixXd::Zero(rows, 4), Eigen::MatrixXd::Zero(rows, ropes), 1};
  double forces = 0;
  double moments = 0;
  for (const WeighingInstant& instant : instants)
    for (std::size_t k = 0; k < instant.force_W.size(); ++k) {
      forces += instant.force_W[k].squaredNorm();
      moments += instant.moment_W[k].squaredNorm();
    }
  if (forces > 0 && moments > 0) system.length = std::sqrt(moments / forces);
  Eigen::Index row = 0;
  for (const WeighingInstant& instant : instants) {
    system.matrix(row, 0) = gravity;
    // The ropes' moment balances that of the weight: (m R c) x (0, 0, -g) + M = 0.
    system.matrix.block<1, 3>(row + 1, 1) = gravity * instant.R_WB.row(1);
    system.matrix.block<1, 3>(row + 2, 1) = -gravity * instant.R_WB.row(0);
    for (Eigen::Index k = 0; k < ropes; ++k) {
      const auto rope = static_cast<std::size_t>(k);
      system.by_rope(row, k) = instant.force_W[rope].z();
      system.by_rope.block<2, 1>(row + 1, k) = instant.moment_W[rope].head<2>() / system.length;
    }
    row += equations;
  }
  return system;
}

/// What the scatter of the residual says of the solution, stretch by stretch.
Eigen::Matrix4d scatter_covariance(const Eigen::VectorXd& residual,
                                   const Eigen::MatrixXd& inverse) {
  const Eigen::Index count = residual.size() / equations;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  for (Eigen::Index i = 0; i < stretches; ++i) {
    const Eigen::Index begin = equations * (count * i / stretches);
    const Eigen::Index size = equations * (count * (i + 1) / stretches) - begin;
    const Eigen::Vector4d moved = inverse.middleCols(begin, size) * residual.segment(begin, size);
    covariance += moved * moved.transpose();
  }
  return covariance * static_cast<double>(stretches) / static_cast<double>(stretches - 1);
}

}  // namespace

std::optional<Eigen::Index> Weighing::open_coordinate() const {
  if (!open_direction_B) return std::nullopt;
  Eigen::Index largest = 0;
  open_direction_B->cwiseAbs().maxCoeff(&largest);
  return largest;
}

Weighing Weighing::with_open_coordinate(double value) const {
  const std::optional<Eigen::Index> open = open_coordinate();
  if (!open) return *this;
  const Eigen::Vector3d along = *open_direction_B / (*open_direction_B)[*open];
  // Moves a point along the line into the plane in which that coordinate does not change.
  Eigen::Matrix3d section = Eigen::Matrix3d::Identity();
  section.col(*open) -= along;
  Weighing there = *this;
  there.centre_of_mass_B += (value - centre_of_mass_B[*open]) * along;
  there.centre_covariance = section * centre_covariance * section.transpose();
  there.centre_deviation = there.centre_covariance.diagonal().cwiseMax(0).cwiseSqrt();
  return there;
}

std::optional<Weighing> weigh(const std::vector<WeighingInstant>& instants, double gravity,
                              double cell_accuracy) {
  if (instants.size() < 2 * static_cast<std::size_t>(stretches)) return std::nullopt;
  const WeighingEquations system = weighing_equations(instants, gravity);
  const Eigen::VectorXd right = system.by_rope.rowwise().sum();
  // A direction counts as seen if the attitude turned by more than about two degrees in all.
  constexpr double seen = 0.03;
  const algebra::SingularVectors factors = algebra::singular_vectors(system.matrix);
  const auto rank = (factors.values.array() >= seen * factors.values[0]).count();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(4, system.matrix.rows());
  for (Eigen::Index i = 0; i < rank; ++i)
    inverse += factors.right.col(i) * factors.left.col(i).transpose() / factors.values[i];
  const Eigen::Vector4d solution = inverse * right;
  const Eigen::VectorXd residual = right - system.matrix * solution;
  Eigen::Matrix4d covariance = scatter_covariance(residual, inverse);
  const Eigen::MatrixXd cells = cell_accuracy * inverse * system.by_rope;
  covariance += cells * cells.transpose();

  Weighing weighing;
  weighing.mass = solution[0];
  weighing.mass_deviation = std::sqrt(covariance(0, 0));
  double squares = 0;
  for (Eigen::Index row = 0; row < residual.size(); row += equations)
    squares += residual[row] * residual[row];
  weighing.force_residual = std::sqrt(squares / static_cast<double>(instants.size()));
  if (rank < 4) weighing.open_direction_B = factors.right.col(3).tail<3>().normalized();
  weighing.centre_of_mass_B = system.length / solution[0] * solution.tail<3>();
  // c = L s / m: its derivatives with respect to m and s.
  Eigen::Matrix<double, 3, 4> derivative;
  derivative << -weighing.centre_of_mass_B / solution[0],
      system.length / solution[0] * Eigen::Matrix3d::Identity();
  weighing.centre_covariance = derivative * covariance * derivative.transpose();
  weighing.centre_deviation = weighing.centre_covariance.diagonal().cwiseMax(0).cwiseSqrt();
  return weighing;
}

}  // namespace blocklift::pipeline

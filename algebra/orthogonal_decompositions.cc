#include <Eigen/Dense>

#include "algebra/decompositions.h"

namespace blocklift::algebra {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.completeOrthogonalDecomposition().solve(B);
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                              double threshold) {
  Eigen::JacobiSVD<Eigen::MatrixXd> solver(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  solver.setThreshold(threshold);
  return solver.solve(b);
}

Eigen::MatrixXd least_squares_by_pivots(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                        double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(A.rows(), A.cols());
  solver.setThreshold(threshold);
  solver.compute(A);
  return solver.solve(B);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  return matrix.completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::Index numerical_rank(const Eigen::MatrixXd& matrix, double threshold) {
  Eigen::FullPivLU<Eigen::MatrixXd> solver(matrix);
  solver.setThreshold(threshold);
  return solver.rank();
}

Eigen::MatrixXd left_null_space(const Eigen::MatrixXd& matrix, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(matrix);
  solver.setThreshold(threshold);
  const Eigen::MatrixXd Q = solver.householderQ();
  return Q.rightCols(matrix.rows() - solver.rank());
}

Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& matrix) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ() *
         Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
}

PivotedColumns pivoted_columns(const Eigen::MatrixXd& matrix) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(matrix);
  const auto reaches = solver.matrixR().diagonal().cwiseAbs();
  return {solver.colsPermutation().indices(), solver.rank(), reaches[0],
          reaches[reaches.size() - 1]};
}

LeftSingularVectors left_singular_vectors(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> solver(matrix, Eigen::ComputeThinU);
  return {solver.singularValues(), solver.matrixU()};
}

SingularVectors singular_vectors(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> solver(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {solver.singularValues(), solver.matrixU(), solver.matrixV()};
}

double smallest_singular_value(const SquareMatrix<6>& matrix) {
  return Eigen::JacobiSVD<SquareMatrix<6>>(matrix).singularValues()[5];
}

}  // namespace blocklift::algebra

#include "algebra/decompositions.h"

#include <cmath>

#include <Eigen/Dense>

namespace blocklift::algebra {

template <int size>
ColumnVector<size> symmetric_eigenvalues(const SquareMatrix<size>& matrix) {
  return Eigen::SelfAdjointEigenSolver<SquareMatrix<size>>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues();
}
template ColumnVector<2> symmetric_eigenvalues(const SquareMatrix<2>&);
template ColumnVector<3> symmetric_eigenvalues(const SquareMatrix<3>&);
template ColumnVector<6> symmetric_eigenvalues(const SquareMatrix<6>&);
template Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd&);

template <int size>
SymmetricEigensystem<size> symmetric_eigensystem(const SquareMatrix<size>& matrix) {
  const Eigen::SelfAdjointEigenSolver<SquareMatrix<size>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}
template SymmetricEigensystem<2> symmetric_eigensystem(const SquareMatrix<2>&);
template SymmetricEigensystem<3> symmetric_eigensystem(const SquareMatrix<3>&);
template SymmetricEigensystem<Eigen::Dynamic> symmetric_eigensystem(const Eigen::MatrixXd&);

Eigen::VectorXd tridiagonal_eigenvalues(const Eigen::VectorXd& diagonal,
                                        const Eigen::VectorXd& beside) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside, Eigen::EigenvaluesOnly);
  return solver.eigenvalues();
}

template <int size>
SquareMatrix<size> inverse_of(const SquareMatrix<size>& matrix) {
  return matrix.inverse();
}
template SquareMatrix<6> inverse_of(const SquareMatrix<6>&);
template Eigen::MatrixXd inverse_of(const Eigen::MatrixXd&);

template <int size>
ColumnVector<size> solve_symmetric(const SquareMatrix<size>& A, const ColumnVector<size>& b) {
  return A.ldlt().solve(b);
}
template ColumnVector<2> solve_symmetric(const SquareMatrix<2>&, const ColumnVector<2>&);
template ColumnVector<3> solve_symmetric(const SquareMatrix<3>&, const ColumnVector<3>&);
template ColumnVector<4> solve_symmetric(const SquareMatrix<4>&, const ColumnVector<4>&);
template ColumnVector<5> solve_symmetric(const SquareMatrix<5>&, const ColumnVector<5>&);
template Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd&, const Eigen::VectorXd&);

Eigen::Vector3d solve_square(const Eigen::Matrix3d& A, const Eigen::Vector3d& b) {
  return A.partialPivLu().solve(b);
}

Eigen::MatrixXd solve_by_full_pivoting(const SquareMatrix<6>& A, const Eigen::MatrixXd& B) {
  return A.fullPivLu().solve(B);
}

void solve_positive_definite_in_place(Eigen::Ref<Eigen::MatrixXd> A,
                                      Eigen::Ref<Eigen::VectorXd> b) {
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(A);
  factors.solveInPlace(b);
}

Eigen::MatrixXd solve_positive_definite(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.llt().solve(B);
}

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

#include "algebra/decompositions.h"

#include <type_traits>

#include <Eigen/Dense>

namespace blocklift::algebra {

namespace {

// Small sizes share one instantiation, which needs no memory of the heap. Each would take the
// compiler some 5 s more.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

// What a decomposition of a matrix of this size works on. Principal stresses are asked for at
// so many places that size 3 has its own.
template <int size>
using WorkingMatrix =
    std::conditional_t<size == Eigen::Dynamic, Eigen::MatrixXd,
                       std::conditional_t<size == 3, Eigen::Matrix3d, SmallMatrix>>;

}  // namespace

template <int size>
ColumnVector<size> symmetric_eigenvalues(const SquareMatrix<size>& matrix) {
  return Eigen::SelfAdjointEigenSolver<WorkingMatrix<size>>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues();
}
template ColumnVector<2> symmetric_eigenvalues(const SquareMatrix<2>&);
template ColumnVector<3> symmetric_eigenvalues(const SquareMatrix<3>&);
template ColumnVector<6> symmetric_eigenvalues(const SquareMatrix<6>&);
template Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd&);

template <int size>
SymmetricEigensystem<size> symmetric_eigensystem(const SquareMatrix<size>& matrix) {
  const Eigen::SelfAdjointEigenSolver<WorkingMatrix<size>> solver(matrix);
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
  using Matrix = std::conditional_t<size == Eigen::Dynamic, Eigen::MatrixXd, SmallMatrix>;
  using Vector =
      Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, Matrix::MaxRowsAtCompileTime, 1>;
  return Eigen::LDLT<Matrix>(A).solve(Vector(b));
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

}  // namespace blocklift::algebra

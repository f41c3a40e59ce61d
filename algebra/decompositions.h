#pragma once

#include <Eigen/Core>

// Decompositions of small dense matrices, compiled once: Eigen's are instantiated in each source
// that uses them, at one to three seconds of the compiler each.
namespace blocklift::algebra {

template <int size>
using SquareMatrix = Eigen::Matrix<double, size, size>;
template <int size>
using ColumnVector = Eigen::Matrix<double, size, 1>;

/// Eigenvalues, ascending, of a symmetric matrix, of which the lower half is read. For sizes of 2,
/// 3, 6 and any.
template <int size>
ColumnVector<size> symmetric_eigenvalues(const SquareMatrix<size>& matrix);

/// A = vectors diag(values) vectors^T.
template <int size>
struct SymmetricEigensystem {
  ColumnVector<size> values;   ///< ascending
  SquareMatrix<size> vectors;  ///< orthonormal columns
};
/// Of a symmetric matrix, of which the lower half is read. For sizes of 2, 3 and any.
template <int size>
SymmetricEigensystem<size> symmetric_eigensystem(const SquareMatrix<size>& matrix);

/// Eigenvalues, ascending, of a symmetric tridiagonal matrix; `beside` has one entry less.
Eigen::VectorXd tridiagonal_eigenvalues(const Eigen::VectorXd& diagonal,
                                        const Eigen::VectorXd& beside);

/// For sizes of 6 and any. Entries are not numbers, or large, if the matrix is singular.
template <int size>
SquareMatrix<size> inverse_of(const SquareMatrix<size>& matrix);

/// x of A x = b, A being symmetric and positive or negative semidefinite: no square roots are
/// taken. For sizes of 2, 3, 4, 5 and any.
template <int size>
ColumnVector<size> solve_symmetric(const SquareMatrix<size>& A, const ColumnVector<size>& b);

/// x of A x = b; not numbers if A is singular.
Eigen::Vector3d solve_square(const Eigen::Matrix3d& A, const Eigen::Vector3d& b);

/// X of A X = B with full pivoting: its errors are small in each component.
Eigen::MatrixXd solve_by_full_pivoting(const SquareMatrix<6>& A, const Eigen::MatrixXd& B);

/// Replaces b by x of A x = b, A being symmetric and positive definite, and A's lower half by its
/// Cholesky factor. Does not allocate.
void solve_positive_definite_in_place(Eigen::Ref<Eigen::MatrixXd> A, Eigen::Ref<Eigen::VectorXd> b);

/// X of A X = B, A being symmetric and positive definite.
Eigen::MatrixXd solve_positive_definite(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The X for which |A X - B| is least, column by column; of several the shortest.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The same with all singular values of A below `threshold` times the largest taken for zero.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double threshold);

/// The same by a QR decomposition with all pivots below `threshold` times the largest taken for
/// zero, column by column.
Eigen::MatrixXd least_squares_by_pivots(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                        double threshold);

/// Moore's and Penrose's inverse.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

/// Number of pivots that are more than `threshold` times the largest.
Eigen::Index numerical_rank(const Eigen::MatrixXd& matrix, double threshold);

/// Orthonormal columns w with w^T A = 0, but for what is below `threshold` times the largest pivot.
Eigen::MatrixXd left_null_space(const Eigen::MatrixXd& matrix, double threshold);

/// Orthonormal columns that span those of a matrix, no more than its rows (Householder's).
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& matrix);

/// Columns of a matrix, those first that reach furthest out of what the ones before them span
/// (Businger and Golub, 1965).
struct PivotedColumns {
  Eigen::VectorXi order;
  Eigen::Index rank = 0;       ///< to rounding
  double first = 0, last = 0;  ///< how far the first and the last column reach, of a square matrix
};
PivotedColumns pivoted_columns(const Eigen::MatrixXd& matrix);

/// Of A = U diag(values) V^T the columns of U, no more than A has, and the values, descending.
struct LeftSingularVectors {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
LeftSingularVectors left_singular_vectors(const Eigen::MatrixXd& matrix);

/// A = left diag(values) right^T, with as many columns as A has values.
struct SingularVectors {
  Eigen::VectorXd values;  ///< descending
  Eigen::MatrixXd left, right;
};
SingularVectors singular_vectors(const Eigen::MatrixXd& matrix);

double smallest_singular_value(const SquareMatrix<6>& matrix);

extern template ColumnVector<2> symmetric_eigenvalues(const SquareMatrix<2>&);
extern template ColumnVector<3> symmetric_eigenvalues(const SquareMatrix<3>&);
extern template ColumnVector<6> symmetric_eigenvalues(const SquareMatrix<6>&);
extern template Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd&);
extern template SymmetricEigensystem<2> symmetric_eigensystem(const SquareMatrix<2>&);
extern template SymmetricEigensystem<3> symmetric_eigensystem(const SquareMatrix<3>&);
extern template SymmetricEigensystem<Eigen::Dynamic> symmetric_eigensystem(const Eigen::MatrixXd&);
extern template SquareMatrix<6> inverse_of(const SquareMatrix<6>&);
extern template Eigen::MatrixXd inverse_of(const Eigen::MatrixXd&);
extern template ColumnVector<2> solve_symmetric(const SquareMatrix<2>&, const ColumnVector<2>&);
extern template ColumnVector<3> solve_symmetric(const SquareMatrix<3>&, const ColumnVector<3>&);
extern template ColumnVector<4> solve_symmetric(const SquareMatrix<4>&, const ColumnVector<4>&);
extern template ColumnVector<5> solve_symmetric(const SquareMatrix<5>&, const ColumnVector<5>&);
extern template Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd&, const Eigen::VectorXd&);

}  // namespace blocklift::algebra

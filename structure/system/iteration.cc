#include "structure/system/iteration.h"

#include <petscksp.h>

#include <array>
#include <cstdio>
#include <exception>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/index.h"
#include "structure/system/shared_factor.h"

namespace blocklift::structure {

namespace {

constexpr int unknowns_a_node = 3, rigid_motion_count = 6;

void demand(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(fmt::format("PETSc stopped: {}", text ? text : "unknown error"));
}

/// A PETSc object that is freed with its scope.
template <typename Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() { destroy(&object_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Object* address() { return &object_; }
  operator Object() const { return object_; }

 private:
  Object object_ = nullptr;
};
using OwnedMatrix = Owned<Mat, MatDestroy>;
using OwnedVector = Owned<Vec, VecDestroy>;
using OwnedSolver = Owned<KSP, KSPDestroy>;
using OwnedScatter = Owned<VecScatter, VecScatterDestroy>;
using OwnedNullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;

/// The rows of the equations that one process holds.
struct EquationRows {
  std::vector<PetscInt> starts, columns;
  std::vector<double> values;
  Eigen::VectorXd load;
  Eigen::MatrixXd rigid_motions;  ///< orthonormal over all rows
  double tolerance = 0;
};

// What is sent, in one order: `pass` puts it into a packet or takes it out.
template <typename Rows, typename Pass>
void pass_rows(Rows& rows, const Pass& pass) {
  pass(rows.starts);
  pass(rows.columns);
  pass(rows.values);
  pass(rows.load);
  pass(rows.rigid_motions);
  pass(rows.tolerance);
}

/// Rows `first` to `end` of the whole matrix but for what couples fixed unknowns with others.
void take_rows(const SparseLower& lower, const std::vector<char>& is_fixed, long first, long end,
               EquationRows& rows) {
  const auto each_entry = [&](const auto& take) {  // those of a row by ascending columns
    for (long column = 0; column < end; ++column)
      for (SparseLower::InnerIterator entry(lower, column); entry; ++entry) {
        const long row = entry.row();
        if (row != column && (is_fixed[row] != 0 || is_fixed[column] != 0)) continue;
        if (row >= first && row < end) take(row - first, column, entry.value());
        if (row != column && column >= first) take(column - first, row, entry.value());
      }
  };
  std::vector<long> counts(at(static_cast<int>(end - first)), 0);
  each_entry([&](long row, long, double) { ++counts[row]; });
  const long count = std::accumulate(counts.begin(), counts.end(), 0L);
  if (count > std::numeric_limits<PetscInt>::max())
    throw ModelError(
        fmt::format("{} unknowns are too many for an iteration on so few processes; start more of "
                    "them or use larger elements",
                    lower.rows()));
  rows.starts.assign(1, 0);
  for (const long of_row : counts)
    rows.starts.push_back(rows.starts.back() + static_cast<PetscInt>(of_row));
  rows.columns.resize(count);
  rows.values.resize(count);
  std::vector<PetscInt> next(rows.starts.begin(), rows.starts.end() - 1);
  each_entry([&](long row, long column, double value) {
    rows.columns[next[row]] = static_cast<PetscInt>(column);
    rows.values[next[row]++] = value;
  });
}

void copy_into(Vec vector, const Eigen::Ref<const Eigen::VectorXd>& values) {
  double* own = nullptr;
  demand(VecGetArray(vector, &own));
  Eigen::Map<Eigen::VectorXd>(own, values.size()) = values;
  demand(VecRestoreArray(vector, &own));
}

void create_matrix(MPI_Comm processes, const EquationRows& rows, OwnedMatrix& matrix) {
  const auto count = static_cast<PetscInt>(rows.load.size());
  demand(MatCreate(processes, matrix.address()));
  demand(MatSetSizes(matrix, count, count, PETSC_DETERMINE, PETSC_DETERMINE));
  demand(MatSetType(matrix, MATAIJ));
  demand(MatSetBlockSize(matrix, unknowns_a_node));
  // That of one process alone, or of several: the other has no effect.
  demand(MatSeqAIJSetPreallocationCSR(matrix, rows.starts.data(), rows.columns.data(),
                                      rows.values.data()));
  demand(MatMPIAIJSetPreallocationCSR(matrix, rows.starts.data(), rows.columns.data(),
                                      rows.values.data()));
  demand(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
  std::array<OwnedVector, rigid_motion_count> motions;
  std::array<Vec, rigid_motion_count> plain{};
  for (std::size_t m = 0; m < motions.size(); ++m) {
    demand(MatCreateVecs(matrix, motions[m].address(), nullptr));
    copy_into(motions[m], rows.rigid_motions.col(static_cast<Eigen::Index>(m)));
    plain[m] = motions[m];
  }
  OwnedNullSpace space;
  demand(MatNullSpaceCreate(processes, PETSC_FALSE, rigid_motion_count, plain.data(),
                            space.address()));
  demand(MatSetNearNullSpace(matrix, space));
}

/// @returns the number of iterations.
int iterate(MPI_Comm processes, Mat matrix, double tolerance, Vec load, Vec displacements) {
  constexpr int most_iterations = 5000;
  OwnedSolver solver;
  PC preconditioner = nullptr;
  demand(KSPCreate(processes, solver.address()));
  demand(KSPSetOperators(solver, matrix, matrix));
  demand(KSPSetType(solver, KSPCG));
  demand(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
  demand(KSPSetTolerances(solver, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most_iterations));
  demand(KSPGetPC(solver, &preconditioner));
  demand(PCSetType(preconditioner, PCGAMG));
  demand(KSPSetUp(solver));
  demand(KSPSolve(solver, load, displacements));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  demand(KSPGetConvergedReason(solver, &reason));
  demand(KSPGetIterationNumber(solver, &iterations));
  if (reason < 0)
    throw ModelError(fmt::format(
        "conjugate gradients did not come to the tolerance of {:g} within {} iterations ({}); thin "
        "plates of long elements converge badly: take a direct solver on more processes or with "
        "more memory",
        tolerance, iterations, KSPConvergedReasons[reason]));
  return iterations;
}

/// All processes that hold rows call this; the displacements of all unknowns are the first one's.
Iterated solve_rows(MPI_Comm processes, const EquationRows& rows) {
  OwnedMatrix matrix;
  create_matrix(processes, rows, matrix);
  OwnedVector load, displacements, of_all;
  demand(MatCreateVecs(matrix, displacements.address(), load.address()));
  copy_into(load, rows.load);
  Iterated result;
  result.iterations = iterate(processes, matrix, rows.tolerance, load, displacements);
  OwnedScatter scatter;
  demand(VecScatterCreateToZero(displacements, scatter.address(), of_all.address()));
  demand(VecScatterBegin(scatter, displacements, of_all, INSERT_VALUES, SCATTER_FORWARD));
  demand(VecScatterEnd(scatter, displacements, of_all, INSERT_VALUES, SCATTER_FORWARD));
  PetscInt size = 0;
  const double* values = nullptr;
  demand(VecGetLocalSize(of_all, &size));
  demand(VecGetArrayRead(of_all, &values));
  result.displacements = Eigen::Map<const Eigen::VectorXd>(values, size);
  demand(VecRestoreArrayRead(of_all, &values));
  return result;
}

/// All processes meet a ModelError alike. After another error this one is alone with it, and the
/// others would wait: all end.
Iterated solve_with_others(const EquationRows& rows) {
  try {
    return solve_rows(PETSC_COMM_WORLD, rows);
  } catch (const ModelError&) {
    throw;
  } catch (const std::exception& error) {
    fmt::print(stderr, "blocklift: error: {}\n", error.what());
    ProcessGroup::abort();
  }
}

/// The rows of each process, of whole nodes.
std::vector<EquationRows> deal_out_rows(const SparseLower& stiffness,
                                        const std::vector<FixedUnknown>& fixed,
                                        const Eigen::VectorXd& load,
                                        const Eigen::MatrixXd& rigid_motions, double tolerance,
                                        int processes) {
  std::vector<char> is_fixed(at(static_cast<int>(stiffness.rows())), 0);
  for (const FixedUnknown& one : fixed) is_fixed[one.unknown] = 1;
  const Eigen::MatrixXd motions = algebra::orthonormal_columns(rigid_motions);
  const long nodes = stiffness.rows() / unknowns_a_node;
  std::vector<EquationRows> all;
  for (int process = 0; process < processes; ++process) {
    const long first = unknowns_a_node * (nodes * process / processes),
               end = unknowns_a_node * (nodes * (process + 1) / processes);
    EquationRows& rows = all.emplace_back();
    take_rows(stiffness, is_fixed, first, end, rows);
    rows.load = load.segment(first, end - first);
    rows.rigid_motions = motions.middleRows(first, end - first);
    rows.tolerance = tolerance;
  }
  return all;
}

}  // namespace

Iterated solve_by_iteration(const SparseLower& stiffness, const std::vector<FixedUnknown>& fixed,
                            const Eigen::VectorXd& load, const Eigen::MatrixXd& rigid_motions,
                            double tolerance) {
  const ProcessGroup& group = ProcessGroup::of_this_run();
  const FactorTeam* const team = FactorTeam::present();
  Eigen::VectorXd given = Eigen::VectorXd::Zero(load.size());
  for (const FixedUnknown& one : fixed) given[one.unknown] = one.value;
  const auto whole = stiffness.selfadjointView<Eigen::Lower>();
  Eigen::VectorXd of_free = load - whole * given;
  for (const FixedUnknown& one : fixed) of_free[one.unknown] = 0;
  std::vector<EquationRows> rows =
      deal_out_rows(stiffness, fixed, of_free, rigid_motions, tolerance, team ? group.size() : 1);
  if (team) team->begin_iteration();
  for (std::size_t process = 1; process < rows.size(); ++process) {
    Packet packet;
    pass_rows(rows[process], [&](const auto& value) { packet.put(value); });
    group.send(static_cast<int>(process), packet);
  }
  rows.resize(1);
  Iterated result =
      team ? solve_with_others(rows.front()) : solve_rows(PETSC_COMM_SELF, rows.front());
  result.displacements += given;
  const Eigen::VectorXd lacking = whole * result.displacements - load;
  result.reactions.resize(static_cast<Eigen::Index>(fixed.size()));
  for (std::size_t i = 0; i < fixed.size(); ++i) result.reactions[i] = lacking[fixed[i].unknown];
  return result;
}

void follow_iteration(const ProcessGroup& group) {
  Packet packet = group.receive(0);
  EquationRows rows;
  pass_rows(rows, [&](auto& value) { packet.take(value); });
  packet = Packet();
  try {
    solve_with_others(rows);
  } catch (const ModelError&) {
    return;  // the leader says so
  }
}

}  // namespace blocklift::structure

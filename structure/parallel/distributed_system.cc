#include "structure/parallel/distributed_system.h"

#include <petscksp.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/stopwatch.h"

namespace blocklift::structure {

namespace {

void check(PetscErrorCode code) {
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
using OwnedSet = Owned<IS, ISDestroy>;
using OwnedScatter = Owned<VecScatter, VecScatterDestroy>;
using OwnedNullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;

/// The stiffness with its load and its fixed unknowns, in rows of three.
class System {
 public:
  explicit System(const PartShare& share) : share_(share) {
    const int rows = 3 * (share.end_row - share.first_row);
    check(VecCreate(PETSC_COMM_WORLD, load_.address()));
    check(VecSetSizes(load_, rows, PETSC_DETERMINE));
    check(VecSetBlockSize(load_, 3));
    check(VecSetFromOptions(load_));
    check(VecDuplicate(load_, displacement_.address()));
    create_matrix(rows);
    assemble();
    take_rigid_motions();
    take_loads();
  }

  Mat stiffness() const { return stiffness_; }
  Vec load() const { return load_; }
  Vec displacement() const { return displacement_; }

  Eigen::VectorXd displacement_of_share() const {
    const auto nodes = static_cast<PetscInt>(share_.row_of_node.size());
    OwnedSet rows;
    OwnedVector here;
    OwnedScatter scatter;
    check(ISCreateBlock(PETSC_COMM_SELF, 3, nodes, share_.row_of_node.data(), PETSC_COPY_VALUES,
                        rows.address()));
    Eigen::VectorXd result(3 * nodes);
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, 3 * nodes, result.data(), here.address()));
    check(VecScatterCreate(displacement_, rows, here, nullptr, scatter.address()));
    check(VecScatterBegin(scatter, displacement_, here, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter, displacement_, here, INSERT_VALUES, SCATTER_FORWARD));
    return result;
  }

 private:
  bool owns(int row) const { return row >= share_.first_row && row < share_.end_row; }

  // Rows of three that share a solid with each own row, itself included: on this process,
  // elsewhere.
  void create_matrix(int rows) {
    const PartMesh& mesh = share_.model.mesh;
    std::vector<std::vector<int>> solids(at(share_.end_row - share_.first_row));
    for (const int solid : mesh.solids)
      for (int i = 0; i < mesh.kind(solid).nodes; ++i)
        if (const int row = share_.row_of_node[mesh.node(solid, i)]; owns(row))
          solids[row - share_.first_row].push_back(solid);
    std::vector<PetscInt> here, elsewhere;
    std::vector<int> others;
    for (const std::vector<int>& of_row : solids) {
      others.clear();
      for (const int solid : of_row)
        for (int i = 0; i < mesh.kind(solid).nodes; ++i)
          others.push_back(share_.row_of_node[mesh.node(solid, i)]);
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
      const auto own =
          std::count_if(others.begin(), others.end(), [&](int row) { return owns(row); });
      here.push_back(static_cast<PetscInt>(own));
      elsewhere.push_back(static_cast<PetscInt>(others.size()) - here.back());
    }
    check(MatCreate(PETSC_COMM_WORLD, stiffness_.address()));
    check(MatSetSizes(stiffness_, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(stiffness_, MATAIJ));
    check(MatSetBlockSize(stiffness_, 3));
    check(MatXAIJSetPreallocation(stiffness_, 3, here.data(), elsewhere.data(), nullptr, nullptr));
    check(MatSetOption(stiffness_, MAT_SPD, PETSC_TRUE));
    check(MatSetOption(stiffness_, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  }

  // Rows of other processes are passed over (PETSc skips negative rows): those fill them.
  void assemble() {
    const PartMesh& mesh = share_.model.mesh;
    std::vector<PetscInt> rows, columns;
    for (std::size_t solid = 0; solid < mesh.solids.size(); ++solid) {
      const int element = mesh.solids[solid];
      const int nodes = mesh.kind(element).nodes;
      rows.clear();
      columns.clear();
      bool touches = false;
      for (int i = 0; i < nodes; ++i) {
        columns.push_back(share_.row_of_node[mesh.node(element, i)]);
        rows.push_back(owns(columns.back()) ? columns.back() : -1);
        touches = touches || rows.back() >= 0;
      }
      if (!touches) continue;  // a solid of the halo that meets only nodes of a lower process
      // Symmetric: PETSc's order by rows and Eigen's by columns are the same.
      const Eigen::MatrixXd values = part_element_stiffness(share_.model, static_cast<int>(solid));
      check(MatSetValuesBlocked(stiffness_, nodes, rows.data(), nodes, columns.data(),
                                values.data(), ADD_VALUES));
    }
    check(MatAssemblyBegin(stiffness_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(stiffness_, MAT_FINAL_ASSEMBLY));
  }

  void take_rigid_motions() {
    OwnedVector places;
    check(VecDuplicate(load_, places.address()));
    double* values = nullptr;
    check(VecGetArray(places, &values));
    for (std::size_t node = 0; node < share_.row_of_node.size(); ++node)
      if (const int row = share_.row_of_node[node]; owns(row))
        Eigen::Map<Vector3>(values + 3 * (row - share_.first_row)) =
            share_.model.mesh.nodes.col(node);
    check(VecRestoreArray(places, &values));
    OwnedNullSpace motions;
    check(MatNullSpaceCreateRigidBody(places, motions.address()));
    check(MatSetNearNullSpace(stiffness_, motions));
  }

  void take_loads() {
    double* values = nullptr;
    check(VecGetArray(load_, &values));
    Eigen::Map<Eigen::VectorXd>(values, share_.load.size()) = share_.load;
    check(VecRestoreArray(load_, &values));
    std::vector<PetscInt> rows;
    check(VecSet(displacement_, 0));
    for (const FixedUnknown& one : share_.fixed) {
      rows.push_back(one.unknown);
      check(VecSetValue(displacement_, one.unknown, one.value, INSERT_VALUES));
    }
    check(VecAssemblyBegin(displacement_));
    check(VecAssemblyEnd(displacement_));
    // A diagonal of the size of the others keeps the condition of the free unknowns.
    OwnedVector diagonal;
    PetscReal largest = 1;
    check(VecDuplicate(load_, diagonal.address()));
    check(MatGetDiagonal(stiffness_, diagonal));
    check(VecMax(diagonal, nullptr, &largest));
    check(MatZeroRowsColumns(stiffness_, static_cast<PetscInt>(rows.size()), rows.data(), largest,
                             displacement_, load_));
  }

  const PartShare& share_;
  OwnedMatrix stiffness_;
  OwnedVector load_, displacement_;
};

/// Cholesky factor by MUMPS: first the analysis, which tells its memory.
class Factor {
 public:
  explicit Factor(const System& system) : system_(system) {
    check(MatGetFactor(system.stiffness(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor_.address()));
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info));
    check(MatCholeskyFactorSymbolic(factor_, system.stiffness(), nullptr, &info));
    PetscInt on_one = 0, on_all = 0;  // 10^6 bytes: INFOG(16) and (17) of its manual
    check(MatMumpsGetInfog(factor_, 16, &on_one));
    check(MatMumpsGetInfog(factor_, 17, &on_all));
    largest_bytes_ = 1e6 * static_cast<double>(on_one);
    all_bytes_ = 1e6 * static_cast<double>(on_all);
  }
  double largest_bytes() const { return largest_bytes_; }  ///< on one process
  double all_bytes() const { return all_bytes_; }

  void factorise() {
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info));
    check(MatCholeskyFactorNumeric(factor_, system_.stiffness(), &info));
    PetscInt state = 0;
    check(MatMumpsGetInfog(factor_, 1, &state));
    if (state == -9 || state == -13)
      throw ModelError("the memory did not suffice for the factorisation by MUMPS");
    if (state < 0)
      throw ModelError(fmt::format(
          "the stiffness matrix is not positive definite: the supports leave a part free to move "
          "(MUMPS, INFOG(1) = {})",
          state));
  }
  void solve() { check(MatSolve(factor_, system_.load(), system_.displacement())); }

 private:
  const System& system_;
  OwnedMatrix factor_;
  double largest_bytes_ = 0, all_bytes_ = 0;
};

/// @returns the number of iterations.
int iterate(const System& system, double tolerance) {
  constexpr int most_iterations = 5000;
  OwnedSolver solver;
  PC preconditioner = nullptr;
  check(KSPCreate(PETSC_COMM_WORLD, solver.address()));
  check(KSPSetOperators(solver, system.stiffness(), system.stiffness()));
  check(KSPSetType(solver, KSPCG));
  check(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
  check(KSPSetTolerances(solver, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most_iterations));
  check(KSPGetPC(solver, &preconditioner));
  check(PCSetType(preconditioner, PCGAMG));
  check(KSPSetUp(solver));
  check(KSPSolve(solver, system.load(), system.displacement()));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  check(KSPGetConvergedReason(solver, &reason));
  check(KSPGetIterationNumber(solver, &iterations));
  if (reason < 0)
    throw ModelError(fmt::format(
        "conjugate gradients did not come to the tolerance of {:g} within {} iterations ({}); thin "
        "plates of long elements converge badly: take a direct solver on more processes or with "
        "more memory",
        tolerance, iterations, KSPConvergedReasons[reason]));
  return iterations;
}

// The least over all processes, of memory that each may take.
double memory_of_each(const ProcessGroup& group) {
  double bytes = available_memory() / group.on_this_machine(), least = bytes;
  MPI_Allreduce(&bytes, &least, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD);
  return least;
}

}  // namespace

ShareSolution solve_share(const ProcessGroup& group, const PartShare& share,
                          const SolverChoice& choice) {
  Stopwatch watch;
  ShareSolution solution;
  SolverAccount& account = solution.account;
  account.processes = group.size();
  const System system(share);
  account.assembly_s = watch.lap();
  bool direct = choice.method != SolverMethod::iterative;
  if (direct) {
    Factor factor(system);
    account.factor_bytes = factor.all_bytes();
    const double free = memory_of_each(group);
    const bool fits = factor.largest_bytes() < free;
    if (!fits && choice.method == SolverMethod::direct)
      throw ModelError(fmt::format(
          "the factorisation needs {:.1f} GB on one of the {} processes and {:.1f} GB are free for "
          "each; use larger elements, more machines, or solver: {{method: iterative}}",
          factor.largest_bytes() / 1e9, group.size(), free / 1e9));
    direct = fits;
    if (direct) {
      factor.factorise();
      account.factorisation_s = watch.lap();
      factor.solve();
      account.name = "Cholesky factorisation by MUMPS";
    }
  }
  if (!direct) {
    account.iterations = iterate(system, choice.tolerance);
    account.name = "conjugate gradients with algebraic multigrid";
  }
  account.solve_s = watch.lap();
  solution.displacement = system.displacement_of_share();
  return solution;
}

}  // namespace blocklift::structure

#pragma once

#include <memory>
#include <string>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "dynamics/errors.h"
#include "dynamics/spatial/pose.h"

/// Ownership of SUNDIALS' C objects, for the two files that use them.
namespace blocklift::dynamics::sundials {

struct ContextDeleter {
  void operator()(_SUNContext* context) const { SUNContext_Free(&context); }
};
struct VectorDeleter {
  void operator()(_generic_N_Vector* vector) const { N_VDestroy(vector); }
};
struct MatrixDeleter {
  void operator()(_generic_SUNMatrix* matrix) const { SUNMatDestroy(matrix); }
};
struct LinearSolverDeleter {
  void operator()(_generic_SUNLinearSolver* solver) const { SUNLinSolFree(solver); }
};

using Context = std::unique_ptr<_SUNContext, ContextDeleter>;
using Vector = std::unique_ptr<_generic_N_Vector, VectorDeleter>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, MatrixDeleter>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, LinearSolverDeleter>;

/// @throws SimulationError naming the call if its return flag tells of a failure.
inline void check(int flag, const char* call) {
  if (flag < 0) {
    throw SimulationError(std::string("SUNDIALS: ") + call + " failed with flag " +
                          std::to_string(flag));
  }
}

inline Context make_context() {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  return Context(context);
}

/// Direct linear solver whose `content` is its owner.
/// @param factorise the matrix, where that is not done otherwise (by the owner's CVLsLinSysFn).
inline LinearSolver make_direct_solver(
    void* owner, int (*solve)(SUNLinearSolver, SUNMatrix, N_Vector, N_Vector, double),
    const Context& context, int (*factorise)(SUNLinearSolver, SUNMatrix) = nullptr) {
  LinearSolver solver(SUNLinSolNewEmpty(context.get()));
  if (!solver) throw SimulationError("SUNDIALS: SUNLinSolNewEmpty gave no memory");
  solver->content = owner;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver->ops->initialize = [](SUNLinearSolver) { return 0; };
  solver->ops->setup = factorise ? factorise : [](SUNLinearSolver, SUNMatrix) { return 0; };
  solver->ops->solve = solve;
  solver->ops->free = [](SUNLinearSolver s) {
    s->content = nullptr;
    SUNLinSolFreeEmpty(s);
    return 0;
  };
  return solver;
}

/// Serial vector whose operations are quick at the few dozen entries of a lift's state.
/// @throws SimulationError if there is no memory.
Vector make_vector(Eigen::Index size, const Context& context);

inline Eigen::Map<Eigen::VectorXd> view(N_Vector vector) {
  return {N_VGetArrayPointer(vector), N_VGetLength(vector)};
}

inline Eigen::Map<Eigen::MatrixXd> view(SUNMatrix matrix) {
  return {SUNDenseMatrix_Data(matrix), SUNDenseMatrix_Rows(matrix), SUNDenseMatrix_Columns(matrix)};
}

}  // namespace blocklift::dynamics::sundials

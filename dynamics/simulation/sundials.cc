#include "dynamics/simulation/sundials.h"

#include <cmath>

namespace blocklift::dynamics::sundials {

namespace {

// SUNDIALS' own serial vectors are worked on entry by entry, with a call or two for each pair of
// short loops: half of the time of an integration with a dozen unknowns. The operations that its
// integrators repeat in each step are replaced by these, vector code without calls. Entries are
// combined one by one, so that results may be operands.

using Entries = Eigen::Map<Eigen::VectorXd>;

Entries entries(N_Vector vector) { return {NV_DATA_S(vector), NV_LENGTH_S(vector)}; }

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  entries(z) = a * entries(x) + b * entries(y);
}

void constant(double c, N_Vector z) { entries(z).setConstant(c); }

void scale(double c, N_Vector x, N_Vector z) { entries(z) = c * entries(x); }

double weighted_square_sum(N_Vector x, N_Vector weights) {
  return entries(x).cwiseProduct(entries(weights)).squaredNorm();
}

double weighted_root_mean_square(N_Vector x, N_Vector weights) {
  return std::sqrt(weighted_square_sum(x, weights) / static_cast<double>(NV_LENGTH_S(x)));
}

// z = sum c_i x_i; z may be the first x.
int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
  entries(z) = c[0] * entries(x[0]);
  for (int i = 1; i < count; ++i) entries(z) += c[i] * entries(x[i]);
  return 0;
}

// z_i = a_i x + y_i.
int scale_and_add_to_each(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
  for (int i = 0; i < count; ++i) entries(z[i]) = a[i] * entries(x) + entries(y[i]);
  return 0;
}

// z_i = c_i x_i.
int scale_each(int count, double* c, N_Vector* x, N_Vector* z) {
  for (int i = 0; i < count; ++i) entries(z[i]) = c[i] * entries(x[i]);
  return 0;
}

}  // namespace

Vector make_vector(Eigen::Index size, const Context& context) {
  Vector vector(N_VNew_Serial(size, context.get()));
  if (!vector) throw SimulationError("SUNDIALS: N_VNew_Serial gave no memory");
  // What is cloned from the vector has the same operations.
  _generic_N_Vector_Ops& operations = *vector->ops;
  operations.nvlinearsum = linear_sum;
  operations.nvconst = constant;
  operations.nvscale = scale;
  operations.nvwrmsnorm = weighted_root_mean_square;
  operations.nvwsqrsumlocal = weighted_square_sum;
  operations.nvlinearcombination = linear_combination;
  operations.nvscaleaddmulti = scale_and_add_to_each;
  operations.nvscalevectorarray = scale_each;
  return vector;
}

}  // namespace blocklift::dynamics::sundials

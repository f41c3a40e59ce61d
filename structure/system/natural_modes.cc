#include "structure/system/natural_modes.h"

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/process_group.h"
#include "structure/system/assembly.h"
#include "structure/system/matter.h"

namespace blocklift::structure {

namespace {

void check(PetscErrorCode code) {
  if (code != 0)
    throw ModelError(
        fmt::format("the search of natural modes failed (SLEPc, code {})", static_cast<int>(code)));
}

/// SLEPc for the life of the program.
class Library {
 public:
  Library() {
    ProcessGroup::of_this_run();  // PETSc is ready
    check(SlepcInitializeNoArguments());
  }
  ~Library() { SlepcFinalize(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/// What the operators of the eigenproblem need.
struct Pencil {
  const SparseLower& stiffness;
  const SparseLower& mass;
  const ConstrainedSystem& shifted;  ///< K + s M
};

using Applied = Eigen::VectorXd (*)(const Pencil&, const Eigen::Map<const Eigen::VectorXd>&);

PetscErrorCode apply(void* context, Vec from, Vec to, Applied function) {
  const PetscScalar* source = nullptr;
  PetscScalar* target = nullptr;
  PetscInt size = 0;
  if (const auto code = VecGetLocalSize(from, &size)) return code;
  if (const auto code = VecGetArrayRead(from, &source)) return code;
  if (const auto code = VecGetArray(to, &target)) return code;
  Eigen::Map<Eigen::VectorXd>(target, size) = function(
      *static_cast<const Pencil*>(context), Eigen::Map<const Eigen::VectorXd>(source, size));
  if (const auto code = VecRestoreArray(to, &target)) return code;
  return VecRestoreArrayRead(from, &source);
}

PetscErrorCode apply_stiffness(Mat matrix, Vec from, Vec to) {
  void* context = nullptr;
  if (const auto code = MatShellGetContext(matrix, static_cast<void*>(&context))) return code;
  return apply(context, from, to, [](const Pencil& pencil, const auto& v) -> Eigen::VectorXd {
    return pencil.stiffness.selfadjointView<Eigen::Lower>() * v;
  });
}

PetscErrorCode apply_mass(Mat matrix, Vec from, Vec to) {
  void* context = nullptr;
  if (const auto code = MatShellGetContext(matrix, static_cast<void*>(&context))) return code;
  return apply(context, from, to, [](const Pencil& pencil, const auto& v) -> Eigen::VectorXd {
    return pencil.mass.selfadjointView<Eigen::Lower>() * v;
  });
}

PetscErrorCode apply_inverse(PC preconditioner, Vec from, Vec to) {
  void* context = nullptr;
  if (const auto code = PCShellGetContext(preconditioner, static_cast<void*>(&context)))
    return code;
  return apply(context, from, to, [](const Pencil& pencil, const auto& v) -> Eigen::VectorXd {
    return pencil.shifted.solve(v);
  });
}

/// Owns SLEPc's objects of one search.
struct Search {
  Mat stiffness = nullptr, mass = nullptr;
  EPS solver = nullptr;
  Vec start = nullptr;

  Search() = default;
  ~Search() {
    EPSDestroy(&solver);
    VecDestroy(&start);
    MatDestroy(&stiffness);
    MatDestroy(&mass);
  }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;
};

void set_up(Search& search, Pencil& pencil, double shift) {
  const auto size = static_cast<PetscInt>(pencil.stiffness.rows());
  const auto shell = [&](Mat& matrix, PetscErrorCode (*product)(Mat, Vec, Vec)) {
    check(MatCreateShell(PETSC_COMM_SELF, size, size, size, size, &pencil, &matrix));
    check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(product)));
    check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  };
  shell(search.stiffness, apply_stiffness);
  shell(search.mass, apply_mass);
  check(EPSCreate(PETSC_COMM_SELF, &search.solver));
  check(EPSSetOperators(search.solver, search.stiffness, search.mass));
  check(EPSSetProblemType(search.solver, EPS_GHEP));
  check(EPSSetType(search.solver, EPSKRYLOVSCHUR));
  check(EPSSetTarget(search.solver, -shift));
  check(EPSSetWhichEigenpairs(search.solver, EPS_TARGET_MAGNITUDE));
  check(EPSSetTolerances(search.solver, 1e-11, 500));
  ST transform = nullptr;
  KSP equations = nullptr;
  PC inverse = nullptr;
  check(EPSGetST(search.solver, &transform));
  check(STSetType(transform, STSINVERT));
  check(STSetMatMode(transform, ST_MATMODE_SHELL));
  check(STGetKSP(transform, &equations));
  check(KSPSetType(equations, KSPPREONLY));
  check(KSPGetPC(equations, &inverse));
  check(PCSetType(inverse, PCSHELL));
  check(PCShellSetContext(inverse, &pencil));
  check(PCShellSetApply(inverse, apply_inverse));
  check(MatCreateVecs(search.stiffness, &search.start, nullptr));
}

void copy(const Eigen::VectorXd& from, Vec to) {
  PetscScalar* values = nullptr;
  check(VecGetArray(to, &values));
  Eigen::Map<Eigen::VectorXd>(values, from.size()) = from;
  check(VecRestoreArray(to, &values));
}

// Noise after one application of the operator, so that held unknowns are at rest.
void set_start(Search& search, const Pencil& pencil, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(pencil.stiffness.rows());
  for (double& value : noise) value = normal(random);
  copy(pencil.shifted.solve(pencil.mass.selfadjointView<Eigen::Lower>() * noise), search.start);
  check(EPSSetInitialSpace(search.solver, 1, &search.start));
}

// Keeps the next search to what is orthogonal to these shapes.
void leave_out(Search& search, const Eigen::MatrixXd& shapes) {
  const auto count = static_cast<PetscInt>(shapes.cols());
  Vec* vectors = nullptr;
  check(VecDuplicateVecs(search.start, count, &vectors));
  for (PetscInt i = 0; i < count; ++i) copy(shapes.col(i), vectors[i]);
  const PetscErrorCode code = EPSSetDeflationSpace(search.solver, count, vectors);
  check(VecDestroyVecs(count, &vectors));
  check(code);
}

NaturalModes collect(const Search& search, int found) {
  std::vector<std::pair<double, PetscInt>> order;
  for (PetscInt i = 0; i < found; ++i) {
    PetscScalar value = 0, unused = 0;
    check(EPSGetEigenvalue(search.solver, i, &value, &unused));
    order.emplace_back(value, i);
  }
  std::sort(order.begin(), order.end());
  PetscInt size = 0;
  check(VecGetLocalSize(search.start, &size));
  NaturalModes modes;
  modes.squared_frequencies.resize(found);
  modes.shapes.resize(size, found);
  for (Eigen::Index m = 0; m < found; ++m) {
    const auto& [value, place] = order[m];
    modes.squared_frequencies[m] = value;
    check(EPSGetEigenvector(search.solver, place, search.start, nullptr));
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(search.start, &values));
    modes.shapes.col(m) = Eigen::Map<const Eigen::VectorXd>(values, size);
    check(VecRestoreArrayRead(search.start, &values));
  }
  return modes;
}

// The lowest modes, `sought` of them or fewer, besides those that are known.
NaturalModes search_modes(Search& search, const Pencil& pencil, const NaturalModes& known,
                          int sought, unsigned seed) {
  const Eigen::Index room = pencil.stiffness.rows() - known.shapes.cols();
  check(EPSSetDimensions(search.solver, sought,
                         static_cast<PetscInt>(std::min<Eigen::Index>(room, 2L * sought + 10)),
                         PETSC_DEFAULT));
  set_start(search, pencil, seed);
  if (known.shapes.cols() > 0) leave_out(search, known.shapes);
  check(EPSSolve(search.solver));
  PetscInt found = 0;
  check(EPSGetConverged(search.solver, &found));
  if (found < 1)
    throw ModelError(fmt::format("only {} natural modes were found; ask for no more",
                                 known.squared_frequencies.size()));
  return collect(search, found);
}

// Both sets, in order.
NaturalModes merge(const NaturalModes& a, const NaturalModes& b) {
  Eigen::VectorXd values(a.squared_frequencies.size() + b.squared_frequencies.size());
  values << a.squared_frequencies, b.squared_frequencies;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return values[i] < values[j]; });
  NaturalModes all;
  all.squared_frequencies = values(order);
  all.shapes.resize(a.shapes.rows(), values.size());
  for (Eigen::Index m = 0; m < values.size(); ++m) {
    const Eigen::Index from = order[m];
    all.shapes.col(m) =
        from < a.shapes.cols() ? a.shapes.col(from) : b.shapes.col(from - a.shapes.cols());
  }
  return all;
}

Eigen::MatrixXd times(const SparseLower& matrix, const Eigen::MatrixXd& columns) {
  return matrix.selfadjointView<Eigen::Lower>() * columns;
}

// Rayleigh and Ritz: the first elastic omega^2 of the free body among the trial shapes, an upper
// bound.
double estimate_first_elastic(const SparseLower& stiffness, const SparseLower& mass,
                              Eigen::MatrixXd shapes) {
  const Eigen::VectorXd sizes =
      shapes.cwiseProduct(times(mass, shapes)).colwise().sum().transpose();
  if (!(sizes[0] > 0)) throw ModelError("the body has no mass; give its materials a density");
  for (Eigen::Index k = 0; k < shapes.cols(); ++k)
    if (sizes[k] > 0) shapes.col(k) /= std::sqrt(sizes[k]);
  const auto gram =
      algebra::symmetric_eigensystem<Eigen::Dynamic>(shapes.transpose() * times(mass, shapes));
  const Eigen::Index independent = (gram.values.array() > 1e-10).count();
  shapes = (shapes * gram.vectors.rightCols(independent) *
            gram.values.tail(independent).cwiseSqrt().cwiseInverse().asDiagonal())
               .eval();
  const Eigen::VectorXd ritz = algebra::symmetric_eigenvalues<Eigen::Dynamic>(
      shapes.transpose() * (stiffness.selfadjointView<Eigen::Lower>() * shapes));
  return ritz[std::min<Eigen::Index>(6, independent - 1)];
}

// Rigid motions of the whole body that nothing holds: those of its six along which no stiffness
// acts.
NaturalModes find_rigid_motions(const SparseLower& stiffness, const SparseLower& mass,
                                Eigen::MatrixXd motions, const std::vector<FixedUnknown>& fixed,
                                double first_elastic) {
  for (const FixedUnknown& unknown : fixed) motions.row(unknown.unknown).setZero();
  const auto gram =
      algebra::symmetric_eigensystem<Eigen::Dynamic>(motions.transpose() * times(mass, motions));
  const Eigen::Index independent = (gram.values.array() > 1e-10 * gram.values[5]).count();
  motions = (motions * gram.vectors.rightCols(independent) *
             gram.values.tail(independent).cwiseSqrt().cwiseInverse().asDiagonal())
                .eval();
  const auto ritz = algebra::symmetric_eigensystem<Eigen::Dynamic>(
      motions.transpose() * (stiffness.selfadjointView<Eigen::Lower>() * motions));
  const Eigen::Index loose = (ritz.values.array() < 1e-6 * first_elastic).count();
  NaturalModes rigid;
  rigid.squared_frequencies = ritz.values.head(loose);
  rigid.shapes = motions * ritz.vectors.leftCols(loose);
  return rigid;
}

// A search begins with one vector, which holds one mode of a repeated frequency, as the parts of a
// body that hang together loosely have it; others come by rounding, or not. So it is repeated
// beside what is known until nothing lower comes.
NaturalModes search_all(Search& search, const Pencil& pencil, NaturalModes modes, int count,
                        long free, double shift) {
  constexpr int beside = 3;
  const int with_margin = count + std::max(4, count / 4);
  if (with_margin >= free)  // all that there are
    return search_modes(search, pencil, {}, static_cast<int>(free), 1);
  int sought = with_margin - static_cast<int>(modes.shapes.cols());
  for (unsigned seed = 1; modes.squared_frequencies.size() < free; ++seed) {
    const auto left = static_cast<long>(free - modes.squared_frequencies.size());
    const NaturalModes more = search_modes(
        search, pencil, modes, static_cast<int>(std::clamp<long>(sought, 1, left)), seed);
    sought = beside;
    if (modes.squared_frequencies.size() >= count) {
      const double last = modes.squared_frequencies[count - 1];
      if (more.squared_frequencies[0] > last - 1e-8 * (std::abs(last) + shift)) break;
    }
    modes = merge(modes, more);
  }
  return modes;
}

void judge(const SparseLower& stiffness, const SparseLower& mass,
           const std::vector<FixedUnknown>& fixed, double shift, NaturalModes& modes) {
  Eigen::MatrixXd elastic = stiffness.selfadjointView<Eigen::Lower>() * modes.shapes;
  Eigen::MatrixXd inertial = times(mass, modes.shapes);
  for (const FixedUnknown& unknown : fixed) {
    elastic.row(unknown.unknown).setZero();
    inertial.row(unknown.unknown).setZero();
  }
  for (Eigen::Index m = 0; m < modes.shapes.cols(); ++m) {
    const double value = modes.squared_frequencies[m];
    const double size = elastic.col(m).norm() + (std::abs(value) + shift) * inertial.col(m).norm();
    modes.residual =
        std::max(modes.residual, (elastic.col(m) - value * inertial.col(m)).norm() / size);
  }
}

}  // namespace

Eigen::MatrixXd trial_shapes(const Eigen::Matrix3Xd& nodes, int freedoms) {
  const Vector3 lower = nodes.rowwise().minCoeff(), upper = nodes.rowwise().maxCoeff();
  const double length = (upper - lower).norm();
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(freedoms * nodes.cols(), 21);
  for (Eigen::Index n = 0; n < nodes.cols(); ++n) {
    const Vector3 x = (nodes.col(n) - (lower + upper) / 2) / length;
    auto rows = shapes.middleRows<3>(freedoms * n);
    rows.leftCols<3>().setIdentity();
    for (int c = 0; c < 3; ++c) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      rows(a, 3 + c) = -x[b];  // rotation about c
      rows(b, 3 + c) = x[a];
      rows(c, 6 + c) = x[c];  // stretch, shear
      rows(a, 9 + c) = x[b];
      rows(b, 9 + c) = x[a];
      rows(c, 12 + c) = x[a] * x[a] / 2;  // bending of the plane normal to c
      rows(a, 12 + c) = -x[a] * x[c];
      rows(c, 15 + c) = x[b] * x[b] / 2;
      rows(b, 15 + c) = -x[b] * x[c];
      rows(c, 18 + c) = x[a] * x[b];  // its twist
      rows(a, 18 + c) = -x[b] * x[c];
      rows(b, 18 + c) = -x[a] * x[c];
      if (freedoms < 6) continue;
      auto turns = shapes.middleRows<3>(freedoms * n + 3);  // curl u / 2
      turns(c, 3 + c) = 1 / length;
      turns(b, 12 + c) = -x[a] / length;
      turns(a, 15 + c) = x[b] / length;
      turns(a, 18 + c) = x[a] / length;
      turns(b, 18 + c) = -x[b] / length;
    }
  }
  return shapes;
}

NaturalModes find_natural_modes(const SparseLower& stiffness, const SparseLower& mass,
                                const Eigen::MatrixXd& trial,
                                const std::vector<FixedUnknown>& fixed, int rigid_motions,
                                int count) {
  const auto free = stiffness.rows() - static_cast<long>(fixed.size());
  if (count < 1 || count > free)
    throw ModelError(
        fmt::format("{} modes are asked for; there are {} unknowns that move", count, free));
  const double first_elastic = estimate_first_elastic(stiffness, mass, trial);
  const double shift = 0.1 * first_elastic;
  SparseLower sum = stiffness + shift * mass;
  std::vector<FixedUnknown> at_rest = fixed;
  for (FixedUnknown& unknown : at_rest) unknown.value = 0;
  ConstrainedSystem shifted(std::move(sum), at_rest);
  shifted.factorise();
  static const Library library;
  Pencil pencil{stiffness, mass, shifted};
  Search search;
  set_up(search, pencil, shift);
  NaturalModes modes =
      search_all(search, pencil,
                 find_rigid_motions(stiffness, mass, trial.leftCols<6>(), fixed, first_elastic),
                 count, free, shift);
  if (modes.squared_frequencies.size() < count)
    throw ModelError(fmt::format("only {} of {} natural modes were found; ask for fewer",
                                 modes.squared_frequencies.size(), count));
  modes.squared_frequencies.conservativeResize(count);
  modes.shapes.conservativeResize(Eigen::NoChange, count);
  modes.frequencies = modes.squared_frequencies.cwiseMax(0).cwiseSqrt() / (2 * M_PI);
  modes.rigid_motions = rigid_motions;
  modes.frequencies.head(std::min(count, rigid_motions)).setZero();
  for (auto shape : modes.shapes.colwise()) {
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    if (shape[largest] < 0) shape = -shape;
  }
  judge(stiffness, mass, fixed, shift, modes);
  return modes;
}

SparseLower mass_of_unknowns(const Space& space, const MassProperties& mass) {
  std::vector<Eigen::Triplet<double, long>> terms;
  for (int f = 0; f < space.freedoms(); ++f)
    for (const Space::Term* term = space.begin_of(f); term != space.end_of(f); ++term)
      terms.emplace_back(f, term->unknown, term->weight);
  SparseLower motion(space.freedoms(), space.unknowns());
  motion.setFromTriplets(terms.begin(), terms.end());
  const SparseLower of_freedoms = mass_matrix(space, mass);
  const SparseLower whole = motion.transpose() * (of_freedoms * motion);
  return whole.triangularView<Eigen::Lower>();
}

NaturalModes find_natural_modes(const Space& space, const MassProperties& mass,
                                const std::vector<FixedUnknown>& fixed, int count) {
  const Eigen::MatrixXd shapes = trial_shapes(space.nodes(), 6);
  Eigen::MatrixXd trial = Eigen::MatrixXd::Zero(space.unknowns(), shapes.cols());
  for (int f = 0; f < space.freedoms(); ++f) {
    const Space::Term *begin = space.begin_of(f), *end = space.end_of(f);
    if (end - begin == 1 && begin->weight == 1) trial.row(begin->unknown) = shapes.row(f);
  }
  // Of fixed unknowns none or enough to leave no rigid motion is what the search is told; partly
  // held bodies show their rigid motions by frequencies of zero.
  return find_natural_modes(assemble_stiffness(space), mass_of_unknowns(space, mass), trial, fixed,
                            fixed.empty() ? 6 : 0, count);
}

}  // namespace blocklift::structure

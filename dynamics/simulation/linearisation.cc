#include "dynamics/simulation/linearisation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algebra/decompositions.h"
#include "algebra/factors.h"
#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/errors.h"
#include "dynamics/simulation/mode_shape.h"

namespace blocklift::dynamics {

namespace {

// Of the largest |lambda|: below it a motion counts as neutral.
constexpr double neutral_limit = 1e-6;
// Of |lambda|: eigenvalues nearer than this count as equal.
constexpr double equal_limit = 1e-7;
// Damping ratios beyond it are no rounding.
constexpr double growth_limit = 1e-6;

// The equations in coordinates y with z = L^-T y, M = L L^T: mass one, and time in units of
// 1/scale.
struct Normalised {
  Eigen::MatrixXd to_z;  ///< L^-T
  Eigen::MatrixXd damping, stiffness;
  double scale = 1.0;  ///< about the largest frequency, rad/s

  explicit Normalised(const Linearisation& l) {
    const algebra::CholeskyFactors factor(l.mass);
    if (!factor.is_positive()) {
      throw SimulationError(
          "the mass matrix of the free velocities is singular at the equilibrium: some motion "
          "meets no inertia, so that it has no frequency");
    }
    to_z = factor.inverse_of_transposed();
    stiffness = to_z.transpose() * l.stiffness * to_z;
    damping = to_z.transpose() * l.damping * to_z;
    const double largest = std::max(std::sqrt(stiffness.norm()), damping.norm());
    if (largest > 0.0) scale = largest;
    stiffness /= scale * scale;
    damping /= scale;
  }
};

ModeKind kind_of(const std::complex<double>& lambda) {
  const double growth = lambda.real() / std::abs(lambda);
  if (growth > growth_limit) return ModeKind::unstable;
  return std::abs(lambda.imag()) > 1e-9 * std::abs(lambda) ? ModeKind::oscillating
                                                           : ModeKind::overdamped;
}

// Directions that nothing brings back: the null space of the stiffness.
void add_neutral_modes(const Normalised& equations, const Eigen::MatrixXd& to_v,
                       std::vector<Mode>& modes) {
  const RightSingularVectors svd = decompose_singular(equations.stiffness);
  const double limit = neutral_limit * neutral_limit;
  for (Eigen::Index i = 0; i < svd.values.size(); ++i) {
    if (svd.values[i] > limit) continue;
    Mode& mode = modes.emplace_back();
    mode.kind = ModeKind::neutral;
    mode.shape = to_v * svd.vectors.col(i);
  }
}

// Shapes and eigenvalues of all that moves by itself; to_v carries y to all velocities.
std::vector<Mode> solve_modes(const Normalised& equations, const Eigen::MatrixXd& to_v) {
  std::vector<Mode> modes;
  const Eigen::Index n = equations.stiffness.rows();
  if (n == 0) return modes;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -equations.stiffness;
  A.bottomRightCorner(n, n) = -equations.damping;
  const Eigensystem system = decompose_general(A);
  const Eigen::VectorXcd& values = system.values;
  const double limit = neutral_limit * values.cwiseAbs().maxCoeff();
  add_neutral_modes(equations, to_v, modes);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const std::complex<double> value = values[i];
    if (std::abs(value) <= limit || value.imag() < -1e-9 * std::abs(value)) continue;
    // A body on the top of a hill: of the pair +-sigma the growing one tells it all.
    const bool mirrored = value.real() < 0.0 && std::abs(value.imag()) <= 1e-9 * std::abs(value) &&
                          ((values.array() + value).abs() < growth_limit * std::abs(value)).any();
    if (mirrored) continue;
    Mode& mode = modes.emplace_back();
    mode.eigenvalue = equations.scale * value;
    mode.kind = kind_of(value);
    mode.shape = to_v * system.vectors.col(i).head(n);
  }
  return modes;
}

// Multipliers of the loops at rest.
void find_multipliers(const Mechanism& mechanism, LiftWorkspace& w) {
  Eigen::VectorXd tau = w.loads.tau;
  Eigen::VectorXd vdot = Eigen::VectorXd::Zero(mechanism.nv());
  compute_constrained_dynamics(mechanism, w.kinematics, w.q, w.v, w.loads.F_Bo_W, nullptr, *w.loops,
                               tau, vdot);
}

// Orthonormal basis of the free velocities that the loops allow, nv_free x degrees of freedom.
Eigen::MatrixXd motions_of_loops(const Mechanism& mechanism, const LiftWorkspace& w) {
  const Eigen::MatrixXd whole = calc_loop_jacobian(mechanism, w.kinematics, w.loops->loops);
  const std::vector<int>& free = mechanism.free_velocities();
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd jacobian(whole.rows(), n);
  for (Eigen::Index i = 0; i < n; ++i) jacobian.col(i) = whole.col(free[i]);
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
    const double length = jacobian.row(i).norm();
    if (length > 0.0) jacobian.row(i) /= length;
  }
  const RightSingularVectors svd = decompose_singular(jacobian);
  Eigen::Index rank = 0;
  while (rank < svd.values.size() && svd.values[rank] > redundancy_threshold) ++rank;
  return svd.vectors.rightCols(n - rank);
}

int rank(const Mode& mode) {
  switch (mode.kind) {
    case ModeKind::unstable:
      return 0;
    case ModeKind::neutral:
      return 1;
    default:
      return 2;
  }
}

// A form that differs by direction of motion, so that its axes are those of W.
Eigen::MatrixXd direction_form(const Mechanism& mechanism, const Kinematics& kinematics) {
  constexpr std::array<double, 3> displacement_weights = {1.0, 2.0, 3.0};
  constexpr std::array<double, 3> turn_weights = {4.0, 5.0, 6.0};
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(mechanism.nv(), mechanism.nv());
  Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(6, mechanism.nv());
  for (BodyIndex i = 1; i < mechanism.body_count(); ++i) {
    const auto b = static_cast<std::size_t>(i);
    const RigidBodyInertia& inertia = mechanism.bodies()[b].inertia;
    if (inertia.mass == 0.0) continue;
    body_jacobian(mechanism, kinematics, i, jacobian);
    const Eigen::Matrix3Xd turn = jacobian.topRows<3>();
    const Eigen::Matrix3Xd centre =
        jacobian.bottomRows<3>() - skew(kinematics.X_WB[b].R * inertia.p_BoBcm) * turn;
    const double moment = inertia.I_BBcm.trace() / 3.0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto w = static_cast<std::size_t>(k);
      form += inertia.mass * displacement_weights[w] * centre.row(k).transpose() * centre.row(k);
      form += moment * turn_weights[w] * turn.row(k).transpose() * turn.row(k);
    }
  }
  // Elastic modes of one frequency are told apart by their order.
  double weight = 7.0;
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    form(mode.v_index, mode.v_index) += weight * mode.modal_mass;
    weight += 1.0;
  }
  return form;
}

// Shapes of a group of equal eigenvalues, chosen along the axes of W.
void align(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& form, std::vector<Mode>& modes,
           std::size_t first, std::size_t last) {
  const auto count = static_cast<Eigen::Index>(last - first);
  if (count < 2) return;
  Eigen::MatrixXcd shapes(mass.rows(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    shapes.col(i) = modes[first + static_cast<std::size_t>(i)].shape.normalized();
  }
  // An orthonormal basis by the mass first; shapes that coincide (a defective group) stay as they
  // are.
  Eigen::MatrixXcd product = shapes.adjoint() * mass * shapes;
  const Eigen::VectorXd squares = decompose_hermitian(product);
  if (squares[0] < 1e-9 * squares[count - 1]) return;
  const Eigen::VectorXd inverse_root = squares.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXcd orthonormal = shapes * product * inverse_root.asDiagonal();
  Eigen::MatrixXcd directions = orthonormal.adjoint() * form * orthonormal;
  decompose_hermitian(directions);
  shapes = orthonormal * directions;
  for (Eigen::Index i = 0; i < count; ++i) {
    modes[first + static_cast<std::size_t>(i)].shape = shapes.col(i);
  }
}

void sort_and_align(const LiftSystem& system, const LiftWorkspace& w, const Eigen::MatrixXd& mass,
                    std::vector<Mode>& modes) {
  std::stable_sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
  });
  const Eigen::MatrixXd form = direction_form(system.mechanism(), w.kinematics);
  for (std::size_t first = 0; first < modes.size();) {
    std::size_t last = first + 1;
    while (last < modes.size() && rank(modes[last]) == rank(modes[first]) &&
           std::abs(modes[last].eigenvalue - modes[first].eigenvalue) <=
               equal_limit * std::abs(modes[first].eigenvalue)) {
      ++last;
    }
    align(mass, form, modes, first, last);
    first = last;
  }
}

double elastic_share(const Eigen::MatrixXd& elastic, const Eigen::MatrixXd& stiffness,
                     const Eigen::VectorXcd& free_shape) {
  const double all = free_shape.dot(stiffness * free_shape).real();
  const double stretched = free_shape.dot(elastic * free_shape).real();
  return all > 0.0 ? std::clamp(stretched / all, 0.0, 1.0) : 0.0;
}

// Two modes of one name are told apart by their order.
void number_equal_names(std::vector<Mode>& modes) {
  std::vector<std::string> names;
  for (Mode& mode : modes) {
    const auto before = std::count(names.begin(), names.end(), mode.name);
    names.push_back(mode.name);
    if (before > 0) mode.name += ", no. " + std::to_string(before + 1);
  }
}

}  // namespace

std::string_view mode_kind_name(ModeKind kind) {
  switch (kind) {
    case ModeKind::oscillating:
      return "oscillating";
    case ModeKind::overdamped:
      return "overdamped";
    case ModeKind::neutral:
      return "neutral";
    case ModeKind::unstable:
      return "unstable";
  }
  return {};
}

double Mode::period() const {
  return kind == ModeKind::neutral ? std::numeric_limits<double>::infinity()
                                   : 2.0 * M_PI / std::abs(eigenvalue);
}

double Mode::damping_ratio() const {
  return kind == ModeKind::neutral ? 0.0 : -eigenvalue.real() / std::abs(eigenvalue);
}

Linearisation linearise(const LiftSystem& system, double t, LiftWorkspace& w) {
  const Mechanism& mechanism = system.mechanism();
  const std::vector<int>& free = mechanism.free_velocities();
  const Eigen::Index n = system.nv_free();
  TangentMatrices tangent(system);
  if (w.loops) find_multipliers(mechanism, w);
  calc_tangent_matrices(system, t, w, tangent);
  Linearisation result;
  result.time = t;
  result.basis = w.loops ? motions_of_loops(mechanism, w) : Eigen::MatrixXd::Identity(n, n);
  result.mass = result.basis.transpose() * tangent.mass * result.basis;
  result.damping = result.basis.transpose() * tangent.damping * result.basis;
  result.stiffness = result.basis.transpose() * tangent.stiffness * result.basis;
  if (result.basis.cols() == 0) return result;
  const Eigen::MatrixXd whole_mass = tangent.inverse.mass;
  Eigen::MatrixXd elastic(n, n);
  calc_elastic_stiffness(system, t, w, tangent, elastic);

  const Normalised equations(result);
  Eigen::MatrixXd to_v = Eigen::MatrixXd::Zero(mechanism.nv(), equations.to_z.cols());
  const Eigen::MatrixXd to_free = result.basis * equations.to_z;
  for (Eigen::Index i = 0; i < n; ++i) to_v.row(free[i]) = to_free.row(i);
  result.modes = solve_modes(equations, to_v);
  sort_and_align(system, w, whole_mass, result.modes);
  Eigen::VectorXcd free_shape(n);
  for (Mode& mode : result.modes) {
    find_body_motions(mechanism, w.kinematics, mode);
    for (Eigen::Index i = 0; i < n; ++i) {
      free_shape[i] = mode.shape[free[i]];
    }
    mode.elastic_share = elastic_share(elastic, tangent.stiffness, free_shape);
    mode.name = mode_name(mechanism, w.kinematics, mode);
  }
  number_equal_names(result.modes);
  return result;
}

double calc_righting_height(const LiftSystem& system, double t, LiftWorkspace& w, BodyIndex body,
                            TangentMatrices& tangent, bool heading_is_held) {
  const Mechanism& mechanism = system.mechanism();
  const Body& b = mechanism.body(body);
  const std::vector<int>& free = mechanism.free_velocities();
  const auto turn = std::find(free.begin(), free.end(), b.v_offset);
  const double weight = b.inertia.mass * mechanism.gravity().norm();
  if (b.joint.kind != JointKind::free || b.parent != world_index || turn == free.end() ||
      !(weight > 0.0)) {
    throw ModelError("body \"" + b.name +
                     "\" has no righting height: it must have weight and a free joint to the "
                     "world");
  }
  if (w.loops) find_multipliers(mechanism, w);
  calc_tangent_matrices(system, t, w, tangent);
  Eigen::MatrixXd tilts = Eigen::MatrixXd::Zero(2, system.nv_free());
  // The increments of a free joint turn about the body's axes.
  const Matrix3& R_WB = w.kinematics.X_WB[body].R;
  tilts.middleCols<3>(turn - free.begin()) = R_WB.topRows<2>();
  Eigen::MatrixXd stiffness = tangent.stiffness;
  if (heading_is_held) {
    const double firm = stiffness.diagonal().cwiseAbs().maxCoeff();
    const Eigen::Index first = turn - free.begin();
    stiffness.block<3, 3>(first, first) += firm * R_WB.row(2).transpose() * R_WB.row(2);
  }
  if (w.loops) {
    const Eigen::MatrixXd basis = motions_of_loops(mechanism, w);
    stiffness = basis.transpose() * tangent.stiffness * basis;
    tilts *= basis;
  }
  constexpr double holding = 1e-10;
  stiffness.diagonal().array() += holding * stiffness.diagonal().cwiseAbs().maxCoeff();
  const Eigen::Matrix2d compliance =
      tilts * algebra::LuFactors<double>(stiffness).solve_columns(tilts.transpose());
  const Eigen::Matrix2d symmetric = 0.5 * (compliance + compliance.transpose());
  return algebra::symmetric_eigenvalues(symmetric).cwiseInverse().minCoeff() / weight;
}

std::vector<Linearisation> linearise_sweep(const LiftSystem& system,
                                           const std::vector<double>& times,
                                           const Eigen::VectorXd& q_start, double interval,
                                           const EquilibriumSettings& settings) {
  if (!(interval > 0.0)) {
    throw ModelError("an equilibrium followed every " + std::to_string(interval) +
                     " s: the interval must be positive");
  }
  EquilibriumSolver solver(system, settings);
  Eigen::VectorXd q = q_start;
  solver.solve(0.0, q);
  double reached = 0.0;
  std::vector<Linearisation> results;
  for (const double time : times) {
    while (reached < time) {
      // The last step takes what is left, be it a little more than the interval.
      const double next = time - reached < 1.5 * interval ? time : reached + interval;
      solver.follow(reached, next, q);
      reached = next;
    }
    results.push_back(linearise(system, time, solver.workspace()));
  }
  return results;
}

}  // namespace blocklift::dynamics

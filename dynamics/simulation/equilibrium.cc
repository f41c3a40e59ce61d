#include "dynamics/simulation/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>
#include <kinsol/kinsol.h>

#include "algebra/factors.h"
#include "dynamics/multibody/inverse_dynamics.h"
#include "dynamics/multibody/mass_matrix.h"
#include "dynamics/simulation/jacobian.h"
#include "dynamics/simulation/reduced_coordinates.h"
#include "dynamics/simulation/sundials.h"

namespace blocklift::dynamics {

namespace {

// Stiffness added to every direction, relative to its weight over 1 m: holds neutral directions.
constexpr double holding_stiffness = 1e-7;

// Of the couple that holds a heading, over weight times radius of gyration: a wind whose moment is
// a hundredth of that turns the body by 1e-4 rad.
constexpr double heading_stiffness = 100;

// Steps with the stiffness of an equilibrium before are taken as long as each leaves at most this
// part of the residual: a step with a stiffness of its own takes as long as some ten of them.
constexpr double slow = 0.1;

}  // namespace

struct EquilibriumSolver::Implementation {
  Implementation(const LiftSystem& lift, EquilibriumSettings s);
  ~Implementation() { KINFree(&kinsol); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void make_kinsol(Eigen::Index n);
  void set_reference(const Eigen::VectorXd& q);
  void calc_scales();
  [[noreturn]] void report_weightless(int velocity) const;
  void calc_residual(const Eigen::VectorXd& u, const Contacts* set, Eigen::VectorXd& residual);
  void calc_stiffness(const Eigen::VectorXd& u, const Contacts* set, Eigen::MatrixXd& stiffness);
  Vector3 plumb_in_held_body() const;
  double heading_spring() const;
  void hold_heading();
  double scaled_norm(const Eigen::VectorXd& residual) const;
  bool newton();
  bool newton_with_known_stiffness(Eigen::VectorXd& u);
  bool solve_active_set();
  bool relax();
  bool try_step(double h, double force, Eigen::VectorXd& f);
  bool solve_at(double t, Eigen::VectorXd& q);
  void accept(const Eigen::VectorXd& u);
  void finish(Eigen::VectorXd& q);
  [[noreturn]] void fail(double t);

  static int residual_callback(N_Vector u, N_Vector f, void* data);
  static int jacobian_callback(N_Vector u, N_Vector f, SUNMatrix J, void* data, N_Vector, N_Vector);
  static int factorise_callback(SUNLinearSolver solver, SUNMatrix J);
  static int solve_callback(SUNLinearSolver solver, SUNMatrix J, N_Vector x, N_Vector b, double);
  static void silent(int, const char*, const char*, char*, void*) {}

  const LiftSystem& system;
  const Mechanism& mechanism;
  EquilibriumSettings settings;
  LiftWorkspace w;
  InverseDynamicsWorkspace inverse;
  double time = 0.0;
  ReducedCoordinates coordinates;  ///< the unknowns
  Eigen::VectorXd tau;             ///< nv
  Eigen::VectorXd free_force;      ///< for each free velocity: what the loops leave of its force
  Eigen::VectorXd
      free_weight;         ///< for each free velocity: force that its residual is compared with
  Eigen::VectorXd weight;  ///< the same for each unknown
  Eigen::MatrixXd mass;    ///< of the unknowns
  Eigen::Index held = -1;  ///< where the turns of the body whose heading is held begin; -1: none
  Contacts contacts;       ///< fixed set of those that act
  bool contacts_known = false;
  TangentMatrices tangent_matrices;
  Eigen::VectorXd residual_here;
  /// Where the workspace is: at these unknowns, with this set; null: elsewhere, or with the ropes'
  /// own laws.
  Eigen::VectorXd evaluated;
  const Contacts* evaluated_set = nullptr;
  Eigen::MatrixXd stiffness;  ///< of the unknowns

  sundials::Context context;
  sundials::Vector unknowns, unknown_scale, force_scale;
  sundials::Matrix matrix;
  algebra::LuFactors<double> factor;  ///< of minus the stiffness
  bool is_factorised = false;         ///< for as many unknowns as there are
  sundials::LinearSolver linear_solver;
  void* kinsol = nullptr;
  std::exception_ptr exception;
};

EquilibriumSolver::Implementation::Implementation(const LiftSystem& lift, EquilibriumSettings s)
    : system(lift),
      mechanism(lift.mechanism()),
      settings(std::move(s)),
      w(lift),
      inverse(lift.mechanism()),
      coordinates(lift),
      tau(Eigen::VectorXd::Zero(mechanism.nv())),
      free_force(Eigen::VectorXd::Zero(lift.nv_free())),
      free_weight(Eigen::VectorXd::Ones(lift.nv_free())),
      contacts(static_cast<std::size_t>(lift.contact_count()), 1),
      tangent_matrices(lift),
      context(sundials::make_context()) {
  make_kinsol(system.nv_free());
  if (!settings.held_heading) return;
  const Body& body = mechanism.body(settings.held_heading->body);
  const std::vector<int>& free = mechanism.free_velocities();
  const auto first = std::find(free.begin(), free.end(), body.v_offset);
  if (body.joint.kind != JointKind::free || body.parent != world_index || first == free.end())
    throw ModelError("the heading of body \"" + body.name +
                     "\" cannot be held: it must have a free joint to the world");
  held = first - free.begin();
}

// KINSOL for n unknowns.
void EquilibriumSolver::Implementation::make_kinsol(Eigen::Index n) {
  weight.setOnes(n);
  residual_here.resize(n);
  is_factorised = false;
  if (kinsol) KINFree(&kinsol);
  if (n == 0) return;
  unknowns = sundials::make_vector(n, context);
  unknown_scale = sundials::make_vector(n, context);
  force_scale = sundials::make_vector(n, context);
  matrix = sundials::Matrix(SUNDenseMatrix(n, n, context.get()));
  linear_solver = sundials::make_direct_solver(this, solve_callback, context, factorise_callback);
  kinsol = KINCreate(context.get());
  sundials::check(KINSetErrHandlerFn(kinsol, silent, nullptr), "KINSetErrHandlerFn");
  sundials::check(KINInit(kinsol, residual_callback, unknowns.get()), "KINInit");
  sundials::check(KINSetUserData(kinsol, this), "KINSetUserData");
  sundials::check(KINSetLinearSolver(kinsol, linear_solver.get(), matrix.get()),
                  "KINSetLinearSolver");
  sundials::check(KINSetJacFn(kinsol, jacobian_callback), "KINSetJacFn");
  sundials::check(KINSetFuncNormTol(kinsol, settings.tolerance), "KINSetFuncNormTol");
  sundials::check(KINSetScaledStepTol(kinsol, 1e-14), "KINSetScaledStepTol");
  sundials::check(KINSetNumMaxIters(kinsol, settings.largest_iterations), "KINSetNumMaxIters");
  sundials::check(KINSetMaxSetupCalls(kinsol, 1), "KINSetMaxSetupCalls");
  sundials::view(unknown_scale.get()).setOnes();
}

// Unknowns count from here, brought onto the loops with the drives as they are at the time.
void EquilibriumSolver::Implementation::set_reference(const Eigen::VectorXd& q) {
  evaluated_set = nullptr;
  w.q = q;
  set_drives(system, time, false, w);
  coordinates.set_reference(w.q);
  if (coordinates.size() != weight.size()) {
    make_kinsol(coordinates.size());
    compute_kinematics(mechanism, w.q, Eigen::VectorXd::Zero(mechanism.nv()), w.kinematics);
    calc_scales();
  }
}

void EquilibriumSolver::Implementation::calc_scales() {
  const std::vector<int>& free = mechanism.free_velocities();
  MassMatrixWorkspace workspace(mechanism);
  Eigen::MatrixXd whole(mechanism.nv(), mechanism.nv());
  compute_mass_matrix(mechanism, w.kinematics, workspace, whole);
  const auto n = static_cast<Eigen::Index>(free.size());
  const Eigen::MatrixXd free_mass = whole(free, free);
  constexpr double nothing = 1e-13;  // of the inertia about or along all axes together
  const double g = std::max(1.0, mechanism.gravity().norm());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int k = free[i];
    if (mechanism.is_elastic_mode(k)) {
      free_weight[i] = g * free_mass(i, i);
      continue;
    }
    const SpatialInertia& carried = workspace.composite[mechanism.body_of_velocity(k)];
    const bool turns = mechanism.angular()[k] != 0;
    const double inertia = free_mass(i, i);
    const double whole_inertia = turns ? carried.J.trace() : carried.M.trace();
    if (!(inertia > nothing * whole_inertia)) report_weightless(k);
    free_weight[i] = turns ? g * std::sqrt(inertia * carried.M.trace() / 3.0) : g * inertia;
  }
  const Eigen::MatrixXd& Z = coordinates.basis();
  mass = Z.transpose() * free_mass * Z;
  weight = (Z.cwiseAbs2().transpose() * free_weight.cwiseAbs2()).cwiseSqrt();
  if (weight.size() > 0) sundials::view(force_scale.get()) = weight.cwiseInverse();
}

void EquilibriumSolver::Implementation::report_weightless(int velocity) const {
  throw SimulationError("body " + mechanism.velocity_name(velocity) +
                        ": nothing resists this motion in the present configuration, so that there "
                        "is no weight to compare its forces with; give the body or what it carries "
                        "mass or inertia about that axis, or drive the joint");
}

// Generalised force on each unknown with everything at rest at q(u).
void EquilibriumSolver::Implementation::calc_residual(const Eigen::VectorXd& u, const Contacts* set,
                                                      Eigen::VectorXd& residual) {
  evaluated_set = nullptr;
  coordinates.move_to(u, w.q);
  w.v.setZero();
  w.vdot.setZero();
  set_drives(system, time, false, w);
  calc_loads(system, time, set, w);
  if (held >= 0) hold_heading();
  compute_inverse_dynamics(mechanism, w.kinematics, w.v, w.vdot, w.loads.F_Bo_W, inverse, tau);
  Eigen::Index i = 0;
  for (const int k : mechanism.free_velocities()) free_force[i++] = w.loads.tau[k] - tau[k];
  if (w.loops) {
    compute_loops(mechanism, w.kinematics, w.q, w.v, w.loops->loops);
    coordinates.balance(free_force, w.loops->lambda);
  }
  residual.noalias() = coordinates.basis().transpose() * free_force;
  evaluated = u;
  evaluated_set = set;
}

// Minus the derivative of the residual by u: the stiffness at q(u), times what a further increment
// of u moves there.
void EquilibriumSolver::Implementation::calc_stiffness(const Eigen::VectorXd& u,
                                                       const Contacts* set,
                                                       Eigen::MatrixXd& result) {
  // Newton's method asks for the residual at each of its points before it asks for the stiffness.
  if (!set || set != evaluated_set || u != evaluated) calc_residual(u, set, residual_here);
  calc_tangent_matrices(system, time, w, tangent_matrices);
  if (held >= 0) {
    const Vector3 plumb_B = plumb_in_held_body();
    tangent_matrices.stiffness.block<3, 3>(held, held) +=
        heading_spring() * plumb_B * plumb_B.transpose();
  }
  result = coordinates.seen_along(tangent_matrices.stiffness);
  result.diagonal() += holding_stiffness * weight;
}

// The increments of a free joint turn about the body's axes.
Vector3 EquilibriumSolver::Implementation::plumb_in_held_body() const {
  return w.kinematics.X_WB[settings.held_heading->body].R.row(2).transpose();
}

double EquilibriumSolver::Implementation::heading_spring() const {
  return heading_stiffness * free_weight.segment<3>(held).maxCoeff();
}

// Adds the couple about the plumb for the part of the turn away from the held heading that is about
// it.
void EquilibriumSolver::Implementation::hold_heading() {
  const Matrix3& R_WB = w.kinematics.X_WB[settings.held_heading->body].R;
  const Eigen::Quaterniond turn(R_WB * settings.held_heading->R_WB.transpose());
  const double angle = 2 * std::atan(turn.z() / turn.w());
  w.loads.F_Bo_W[settings.held_heading->body].moment.z() -= heading_spring() * angle;
}

double EquilibriumSolver::Implementation::scaled_norm(const Eigen::VectorXd& residual) const {
  return residual.size() == 0 ? 0.0 : residual.cwiseQuotient(weight).lpNorm<Eigen::Infinity>();
}

int EquilibriumSolver::Implementation::residual_callback(N_Vector u, N_Vector f, void* data) {
  auto& self = *static_cast<Implementation*>(data);
  try {
    Eigen::VectorXd residual(self.coordinates.size());
    self.calc_residual(sundials::view(u), &self.contacts, residual);
    sundials::view(f) = residual;
    return residual.allFinite() ? 0 : 1;
  } catch (...) {
    self.exception = std::current_exception();
    return 1;
  }
}

int EquilibriumSolver::Implementation::jacobian_callback(N_Vector u, N_Vector, SUNMatrix J,
                                                         void* data, N_Vector, N_Vector) {
  auto& self = *static_cast<Implementation*>(data);
  try {
    self.calc_stiffness(sundials::view(u), &self.contacts, self.stiffness);
    sundials::view(J) = -self.stiffness;
    return 0;
  } catch (...) {
    self.exception = std::current_exception();
    return -1;
  }
}

// SUNDIALS' own dense factorisation takes 5 times as long with 20 unknowns, 11 times with 80.
int EquilibriumSolver::Implementation::factorise_callback(SUNLinearSolver solver, SUNMatrix J) {
  constexpr int singular = 1;  // recoverable
  auto& self = *static_cast<Implementation*>(solver->content);
  self.factor.factorise(sundials::view(J));
  self.is_factorised = self.factor.is_regular();
  return self.is_factorised ? 0 : singular;
}

int EquilibriumSolver::Implementation::solve_callback(SUNLinearSolver solver, SUNMatrix, N_Vector x,
                                                      N_Vector b, double) {
  const auto& self = *static_cast<const Implementation*>(solver->content);
  self.factor.solve(sundials::view(b), sundials::view(x));
  return 0;
}

void EquilibriumSolver::Implementation::accept(const Eigen::VectorXd& u) {
  Eigen::VectorXd q(mechanism.nq());
  coordinates.move_to(u, q);
  set_reference(q);
}

// Newton's method with the factor of a stiffness that was found elsewhere: from one instant to the
// next it hardly changes. False where that does not hold, or there is none.
bool EquilibriumSolver::Implementation::newton_with_known_stiffness(Eigen::VectorXd& u) {
  if (!is_factorised) return false;
  u.setZero(coordinates.size());
  Eigen::VectorXd residual(u.size());
  double before = std::numeric_limits<double>::infinity();
  try {
    for (;;) {
      calc_residual(u, &contacts, residual);
      const double norm = scaled_norm(residual);
      if (norm <= settings.tolerance) return true;
      if (!(norm <= slow * before)) return false;
      u -= factor.solve(residual);
      before = norm;
    }
  } catch (const std::runtime_error&) {
    return false;
  }
}

// Newton's method with the contacts as they stand; true when it converged.
bool EquilibriumSolver::Implementation::newton() {
  if (coordinates.size() == 0) return true;
  Eigen::VectorXd quick;
  if (newton_with_known_stiffness(quick)) {
    accept(quick);
    return true;
  }
  auto u = sundials::view(unknowns.get());
  u.setZero();
  sundials::check(KINSetMaxNewtonStep(kinsol, 1e3), "KINSetMaxNewtonStep");
  const int flag =
      KINSol(kinsol, unknowns.get(), KIN_LINESEARCH, unknown_scale.get(), force_scale.get());
  const Eigen::VectorXd solution = u;
  if (!solution.allFinite()) return false;
  Eigen::VectorXd residual(coordinates.size());
  try {
    calc_residual(solution, &contacts, residual);
  } catch (const std::runtime_error&) {
    return false;
  }
  // A step that can no longer shrink the residual (rounding) counts if the residual is small.
  if (flag < 0 && scaled_norm(residual) > 1e3 * settings.tolerance) return false;
  if (flag == KIN_STEP_LT_STPTOL && scaled_norm(residual) > 1e3 * settings.tolerance) return false;
  accept(solution);
  return true;
}

// Newton with a fixed set of acting contacts, the set then corrected, until both agree.
bool EquilibriumSolver::Implementation::solve_active_set() {
  const int most_rounds = 3 * static_cast<int>(contacts.size()) + 3;
  Eigen::VectorXd indicators(system.contact_count());
  Eigen::VectorXd residual;
  for (int round = 0; round < most_rounds; ++round) {
    if (!newton()) return false;
    residual.resize(coordinates.size());
    calc_residual(Eigen::VectorXd::Zero(coordinates.size()), &contacts, residual);
    calc_contact_indicators(w, indicators);
    bool agrees = true;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const double indicator = indicators[i];
      const char acts = indicator > 0.0 ? 1 : 0;
      if (acts != contacts[i] && std::abs(indicator) > 1e-9) {
        contacts[i] = acts;
        evaluated_set = nullptr;
        agrees = false;
      }
    }
    if (agrees) return true;
  }
  return false;
}

// One step of the descent, (K + M/h^2) du = f, taken if the force along it has not turned round
// by more than it was: the potential energy has then fallen. False: h is too long.
bool EquilibriumSolver::Implementation::try_step(double h, double largest_move,
                                                 Eigen::VectorXd& f) {
  Eigen::VectorXd du = algebra::LuFactors<double>(stiffness + mass / (h * h)).solve(f);
  const double before = f.dot(du);
  if (!du.allFinite() || !(before > 0.0) || du.lpNorm<Eigen::Infinity>() > largest_move) {
    return false;
  }
  Eigen::VectorXd f_new(coordinates.size());
  try {
    calc_residual(du, nullptr, f_new);
  } catch (const std::runtime_error&) {
    return false;
  }
  if (!f_new.allFinite() || f_new.dot(du) < -before) return false;
  accept(du);
  f = f_new;
  return true;
}

// Descent from a rough guess with the ropes' own laws; true when forces are small enough for
// Newton.
bool EquilibriumSolver::Implementation::relax() {
  double h = 0.1;  // s; grows into Newton's method
  for (int i = 0; i < settings.largest_relaxations; ++i) {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(coordinates.size());
    Eigen::VectorXd f(rest.size());
    calc_residual(rest, nullptr, f);
    if (scaled_norm(f) < 1e-6) return true;
    calc_scales();
    calc_stiffness(rest, nullptr, stiffness);
    while (!try_step(h, 1.0, f)) {
      h *= 0.25;
      if (h < 1e-7) return false;
    }
    h = std::min(2.0 * h, 1e3);
  }
  return false;
}

bool EquilibriumSolver::Implementation::solve_at(double t, Eigen::VectorXd& q) {
  time = t;
  exception = nullptr;
  try {
    set_reference(q);
  } catch (const SimulationError&) {
    exception = std::current_exception();
    return false;
  }
  if (!solve_active_set()) return false;
  finish(q);
  return true;
}

// Leaves the workspace at the solution by the elements' own laws, with the drive forces.
void EquilibriumSolver::Implementation::finish(Eigen::VectorXd& q) {
  Eigen::VectorXd residual(coordinates.size());
  calc_residual(Eigen::VectorXd::Zero(coordinates.size()), nullptr, residual);
  carry_pads_along(system, w);
  w.joint_force = tau - w.loads.tau;
  if (w.loops) {
    Eigen::Index i = 0;
    for (const int k : mechanism.free_velocities()) free_force[i++] = -w.joint_force[k];
    coordinates.balance_at_reference(free_force, w.loops->lambda);
  }
  for (const int k : mechanism.driven_velocities()) {
    if (w.loops) w.joint_force[k] -= coordinates.loop_force(k, w.loops->lambda);
  }
  q = w.q;
}

void EquilibriumSolver::Implementation::fail(double t) {
  std::ostringstream text;
  text << "no static equilibrium was found at t = " << t << " s";
  try {
    if (exception) std::rethrow_exception(exception);
  } catch (const std::exception& error) {
    text << " (" << error.what() << ")";
  }
  Eigen::VectorXd residual(coordinates.size());
  try {
    calc_residual(Eigen::VectorXd::Zero(coordinates.size()), nullptr, residual);
    text << "; " << describe_ropes(system, w);
    std::vector<Eigen::Index> order(static_cast<std::size_t>(free_force.size()));
    std::iota(order.begin(), order.end(), 0);
    const Eigen::VectorXd relative = free_force.cwiseQuotient(free_weight).cwiseAbs();
    std::sort(order.begin(), order.end(),
              [&](Eigen::Index a, Eigen::Index b) { return relative[a] > relative[b]; });
    // What Newton would accept as nil says nothing about what is wrong.
    const auto is_nil = [&](Eigen::Index i) { return relative[i] <= 1e3 * settings.tolerance; };
    if (order.empty() || is_nil(order.front()))
      text << "; the forces balance where it stopped, yet it is not settled which ropes, "
              "tugger lines and pads bear";
    else
      text << "; largest residuals: ";
    for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i) {
      if (is_nil(order[i])) break;
      const int k = mechanism.free_velocities()[order[i]];
      text << (i > 0 ? ", " : "") << mechanism.velocity_name(k) << " ("
           << 100.0 * relative[order[i]] << " % of its weight)";
    }
  } catch (const ModelError& error) {
    text << "; " << error.what();
  }
  text << "; try a start position nearer to where the load will hang, check that the ropes named "
          "are long enough to reach and that every body hangs from something";
  throw SimulationError(text.str());
}

EquilibriumSolver::EquilibriumSolver(const LiftSystem& system, EquilibriumSettings settings)
    : implementation_(std::make_unique<Implementation>(system, std::move(settings))) {}
EquilibriumSolver::~EquilibriumSolver() = default;
EquilibriumSolver::EquilibriumSolver(EquilibriumSolver&&) noexcept = default;

LiftWorkspace& EquilibriumSolver::workspace() { return implementation_->w; }

void EquilibriumSolver::solve(double t, Eigen::VectorXd& q) {
  Implementation& s = *implementation_;
  s.time = t;
  s.exception = nullptr;
  s.set_reference(q);
  if (s.coordinates.size() == 0) {
    s.finish(q);
    return;
  }
  Eigen::VectorXd residual(s.coordinates.size());
  Eigen::VectorXd indicators(s.system.contact_count());
  s.calc_residual(Eigen::VectorXd::Zero(s.coordinates.size()), nullptr, residual);
  s.calc_scales();
  const bool relaxed = s.relax();
  residual.resize(s.coordinates.size());
  s.calc_residual(Eigen::VectorXd::Zero(s.coordinates.size()), nullptr, residual);
  calc_contact_indicators(s.w, indicators);
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    s.contacts[i] = indicators[i] > 0.0 ? 1 : 0;
  }
  q = s.coordinates.reference();
  if (!relaxed || !s.solve_at(t, q)) s.fail(t);
}

void EquilibriumSolver::follow(double t_from, double t, Eigen::VectorXd& q) {
  Implementation& s = *implementation_;
  if (s.system.nv_free() == 0) {
    solve(t, q);
    return;
  }
  double reached = t_from;
  double step = t - t_from;
  int halvings = 0;
  while (reached < t) {
    const double next = std::min(t, reached + step);
    Eigen::VectorXd q_next = q;
    const Contacts before = s.contacts;
    if (s.solve_at(next, q_next)) {
      q = q_next;
      reached = next;
      continue;
    }
    s.contacts = before;
    step *= 0.5;
    if (++halvings <= s.settings.largest_subdivisions) continue;
    solve(next, q);  // a jump from one equilibrium to another: let it fall there
    reached = next;
    step = t - reached;
    halvings = 0;
  }
}

History static_sweep(const LiftSystem& system, const Eigen::VectorXd& times,
                     const Eigen::VectorXd& q_start, const EquilibriumSettings& settings,
                     const std::function<void(double, double)>& progress,
                     const std::function<void(Eigen::Index, double, LiftWorkspace&)>& observe,
                     const Recording& recording) {
  History history(system, times.size(), false, recording);
  EquilibriumSolver solver(system, settings);
  Eigen::VectorXd q = q_start;
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    if (i == 0) {
      solver.solve(times[i], q);
    } else {
      solver.follow(times[i - 1], times[i], q);
    }
    history.record(system, i, times[i], solver.workspace());
    if (observe) observe(i, times[i], solver.workspace());
    if (progress)
      progress(static_cast<double>(i + 1) / static_cast<double>(times.size()), times[i]);
  }
  return history;
}

Eigen::VectorXd sample_times(double duration, double interval) {
  if (!(interval > 0.0) || !(duration >= 0.0)) {
    throw ModelError("samples every " + std::to_string(interval) + " s over " +
                     std::to_string(duration) + " s: both must be positive");
  }
  // A sample that would fall within a thousandth of an interval before the end is the end.
  const auto whole = static_cast<Eigen::Index>(std::floor(duration / interval - 1e-3));
  Eigen::VectorXd times(whole + 2);
  for (Eigen::Index i = 0; i <= whole; ++i) times[i] = static_cast<double>(i) * interval;
  times[whole + 1] = duration;
  return times;
}

}  // namespace blocklift::dynamics

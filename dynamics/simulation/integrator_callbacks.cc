#include <cmath>

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_proj.h>

#include "dynamics/simulation/energy_ledger.h"
#include "dynamics/simulation/integrator.h"

namespace blocklift::dynamics {

namespace {

// By how many tolerances a point may be elsewhere than where a step that is accepted has it:
// Newton's correction is the local error times up to 7 by the order, and a turn has an arm of tens
// of metres. Were it more, a change would be found at the beginning of the next step.
constexpr double reach_of_errors = 100;

// Loads swing with little damping, where order 5 is unstable and takes shorter steps. With 1e-6 a
// turn-over takes 33,740 steps to order 4 and 42,852 to order 5; tensions are off those with 1e-9
// by 5.2e-5 and 4.5e-5 of the largest (root mean square), accelerations by 2.0e-3 and 2.4e-3. With
// smaller tolerances order 5 is the better one: with 1e-9 a free top takes half the steps.
constexpr double least_tolerance_of_order_4 = 1e-6;

}  // namespace

// What a callback returns to CVODES.
template <class Function>
int Integrator::guarded(Function&& function) {
  try {
    function();
    return 0;
  } catch (const std::runtime_error&) {
    // A trial step may have gone too far: let CVODES try a shorter one.
    exception_ = std::current_exception();
    return 1;
  } catch (...) {
    exception_ = std::current_exception();
    return -1;
  }
}

int Integrator::right_hand_side(double t, N_Vector y, N_Vector ydot, void* data) {
  auto& self = *static_cast<Integrator*>(data);
  self.loaded_time_ = self.evaluated_time_ = self.foreseen_time_ = not_a_number;
  return self.guarded([&] {
    calc_right_hand_side(self.system_, self.within_interval(t), sundials::view(y),
                         &self.events_.contacts(), self.w_, sundials::view(ydot),
                         DriveForces::unwanted);
    self.evaluated_time_ = t;
    self.events_.foresee(reach_of_errors * self.settings_.relative_tolerance);
    self.foreseen_time_ = t;
  });
}

// The matrix of Newton's method by the analytical Jacobian, in the structure of mechanics; CVODES'
// own matrix A is a mere token.
int Integrator::newton_matrix(double t, N_Vector y, N_Vector, SUNMatrix, int keep_point,
                              int* point_set, double gamma, void* data, N_Vector, N_Vector,
                              N_Vector) {
  auto& self = *static_cast<Integrator*>(data);
  int singular = 0;
  const int flag = self.guarded([&] {
    if (!keep_point) {
      self.loaded_time_ = not_a_number;
      const double at = self.within_interval(t);
      calc_right_hand_side(self.system_, at, sundials::view(y), &self.events_.contacts(), self.w_,
                           sundials::view(self.rates_.get()));
      ++self.result_.statistics.right_hand_sides;
      self.newton_.set_point(self.system_, at, self.w_);
    }
    singular = self.newton_.factorise(self.system_, gamma) ? 0 : 1;
  });
  *point_set = keep_point ? SUNFALSE : SUNTRUE;
  return flag != 0 ? flag : singular;
}

int Integrator::solve_newton(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, double) {
  auto& self = *static_cast<Integrator*>(solver->content);
  // Where nothing is free the one unknown stays zero.
  if (self.system_.state_size() == 0) {
    sundials::view(x) = sundials::view(b);
    return 0;
  }
  self.newton_.solve(self.system_, sundials::view(b), sundials::view(x));
  return 0;
}

int Integrator::event_values(double t, N_Vector y, double* g, void* data) {
  auto& self = *static_cast<Integrator*>(data);
  // At a step's end the last right-hand side was of a state that differs by what the step may err.
  if (t == self.foreseen_time_ && self.events_.take_foreseen(g)) return 0;
  return self.guarded([&] {
    const auto state = sundials::view(y);
    // At the end of a step the works have just been evaluated.
    if (self.settings_.awaited || t != self.loaded_time_ || state != self.loaded_state_) {
      self.loaded_time_ = not_a_number;
      set_state(self.system_, state, self.w_);
      set_drives(self.system_, self.within_interval(t), true, self.w_);
      calc_contact_loads(self.system_, &self.events_.contacts(), self.w_);
    }
    const bool may_be_met =
        self.settings_.awaited && self.to_ > self.settings_.awaited->from + beside;
    self.events_.find_values(may_be_met, g);
  });
}

int Integrator::works(double t, N_Vector y, N_Vector rates, void* data) {
  auto& self = *static_cast<Integrator*>(data);
  return self.guarded([&] {
    // At the end of a step the hulls' forces are those that the last of Newton's iterations asked
    // for: of the same time, and of a state that differs by what the step may err.
    const HullForces hulls = t == self.evaluated_time_ ? HullForces::kept : HullForces::evaluated;
    const EnergyRates powers =
        calc_energy_rates(self.system_, self.within_interval(t), sundials::view(y),
                          &self.events_.contacts(), hulls, self.w_);
    sundials::view(rates) << powers.drive_power, powers.winch_power, powers.outside_power,
        powers.dissipated_power;
    self.loaded_state_ = sundials::view(y);
    self.loaded_time_ = t;
  });
}

int Integrator::project(double t, N_Vector y, N_Vector correction, double, N_Vector error,
                        void* data) {
  auto& self = *static_cast<Integrator*>(data);
  self.loaded_time_ = not_a_number;
  bool done = false;
  const int flag = self.guarded([&] {
    const auto state = sundials::view(y);
    done = self.projection_->calc_correction(self.within_interval(t), state,
                                             sundials::view(correction), self.w_);
    if (done && error) self.projection_->project_error(state, sundials::view(error), self.w_);
  });
  return flag != 0 || done ? flag : 1;
}

int Integrator::error_weights(N_Vector y, N_Vector weights, void* data) {
  const auto& self = *static_cast<Integrator*>(data);
  const auto state = sundials::view(y);
  auto weight = sundials::view(weights);
  const double tolerance = self.settings_.relative_tolerance;
  weight.setConstant(1.0 / tolerance);
  for (const Eigen::Index i : self.relative_unknowns_) {
    if (std::abs(state[i]) > 1.0) weight[i] = 1.0 / (tolerance * std::abs(state[i]));
  }
  // The norm is a mean over all unknowns. Those of the water's memory are many and smooth: counted
  // as the others they would let bodies err the more, the more of them there are. A ship between
  // two pontoons has 1,410; at a tolerance of 1e-5 her energy went astray by 2.2e-3, now by 1.3e-4.
  const Eigen::Index bodies = self.system_.nq_free() + self.system_.nv_free();
  if (bodies > 0 && bodies < state.size())
    weight.head(bodies) *=
        std::sqrt(static_cast<double>(state.size()) / static_cast<double>(bodies));
  return 0;
}

void Integrator::keep_message(int code, const char*, const char*, char* message, void* data) {
  if (code < 0) static_cast<Integrator*>(data)->message_ = message;
}

void Integrator::set_up_cvode() {
  using sundials::check;
  cvode_ = CVodeCreate(CV_BDF, context_.get());
  if (!cvode_) throw SimulationError("SUNDIALS: CVodeCreate gave no memory");
  check(CVodeSetErrHandlerFn(cvode_, keep_message, this), "CVodeSetErrHandlerFn");
  check(CVodeInit(cvode_, right_hand_side, begin_, y_.get()), "CVodeInit");
  check(CVodeSetUserData(cvode_, this), "CVodeSetUserData");
  check(CVodeWFtolerances(cvode_, error_weights), "CVodeWFtolerances");
  matrix_ = sundials::Matrix(SUNDenseMatrix(1, 1, context_.get()));
  linear_solver_ = sundials::make_direct_solver(this, solve_newton, context_);
  check(CVodeSetLinearSolver(cvode_, linear_solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
  check(CVodeSetLinSysFn(cvode_, newton_matrix), "CVodeSetLinSysFn");
  if (projection_->is_needed()) check(CVodeSetProjFn(cvode_, project), "CVodeSetProjFn");
  if (events_.count() > 0) {
    check(CVodeRootInit(cvode_, events_.count(), event_values), "CVodeRootInit");
    check(CVodeSetNoInactiveRootWarn(cvode_), "CVodeSetNoInactiveRootWarn");
  }
  if (settings_.works) {
    check(CVodeQuadInit(cvode_, works, work_.get()), "CVodeQuadInit");
    // Where nothing is free, or loops and drives leave nothing free, the works alone say how long a
    // step may be.
    const bool alone = system_.state_size() == 0 || projection_->leaves_nothing_free();
    check(CVodeSetQuadErrCon(cvode_, alone ? SUNTRUE : SUNFALSE), "CVodeSetQuadErrCon");
    check(CVodeQuadSStolerances(cvode_, settings_.relative_tolerance, settings_.relative_tolerance),
          "CVodeQuadSStolerances");
    if (alone) check(CVodeSetMaxStep(cvode_, settings_.sample_interval), "CVodeSetMaxStep");
  }
  if (settings_.relative_tolerance >= least_tolerance_of_order_4)
    check(CVodeSetMaxOrd(cvode_, 4), "CVodeSetMaxOrd");
}

void Integrator::count_before_restart() {
  long steps = 0, evaluations = 0, jacobians = 0, factorisations = 0, iterations = 0, errors = 0,
       nonlinear = 0;
  CVodeGetNumSteps(cvode_, &steps);
  CVodeGetNumRhsEvals(cvode_, &evaluations);
  CVodeGetNumJacEvals(cvode_, &jacobians);
  CVodeGetNumLinSolvSetups(cvode_, &factorisations);
  CVodeGetNumNonlinSolvIters(cvode_, &iterations);
  CVodeGetNumErrTestFails(cvode_, &errors);
  CVodeGetNumNonlinSolvConvFails(cvode_, &nonlinear);
  IntegrationStatistics& s = result_.statistics;
  s.steps += steps;
  s.right_hand_sides += evaluations;
  s.jacobians += jacobians;
  s.factorisations += factorisations;
  s.newton_iterations += iterations;
  s.error_test_failures += errors;
  s.nonlinear_failures += nonlinear;
}

}  // namespace blocklift::dynamics

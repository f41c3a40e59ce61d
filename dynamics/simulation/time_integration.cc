#include "dynamics/simulation/time_integration.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <optional>
#include <sstream>

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_proj.h>

#include "dynamics/multibody/loop_diagnosis.h"
#include "dynamics/simulation/energy_ledger.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/marched_surface.h"
#include "dynamics/simulation/newton_matrix.h"
#include "dynamics/simulation/state_projection.h"
#include "dynamics/simulation/steersman.h"
#include "dynamics/simulation/sundials.h"

namespace blocklift::dynamics {

namespace {

// How far beside a breakpoint its two sides are looked at (s): further than breakpoints that count
// as one.
constexpr double beside = 2e-6;

// Where loops pass a singular position, rounding (1e-16) is divided by what is left of the row that
// they lose, down to 1e-5 (LoopProjector): no smaller local error can be met there.
constexpr double least_tolerance_through_singular_positions = 1e-11;

// Times of the samples between the beginning and the end of the run, s.
Eigen::VectorXd samples_of(const LiftSystem& system, const IntegrationSettings& settings) {
  constexpr double rounding = 1e-9;  // s
  const Eigen::VectorXd all = sample_times(system.operation().duration(), settings.sample_interval);
  const double begin = settings.departure ? settings.departure->time : 0.0;
  const double end = settings.end.value_or(system.operation().duration());
  const auto first = std::lower_bound(all.begin(), all.end(), begin - rounding);
  const auto last = std::upper_bound(first, all.end(), end + rounding);
  return Eigen::Map<const Eigen::VectorXd>(all.data() + (first - all.begin()), last - first);
}

/// One run of CVODES over an operation.
class Integrator {
 public:
  Integrator(const LiftSystem& system, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
             const IntegrationSettings& settings);
  ~Integrator() { CVodeFree(&cvode_); }
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  IntegrationResult run();

 private:
  /// A sheave with friction: which of the rope's.
  struct RubbingSheave {
    std::size_t rope, sheave;
  };

  void depart(const Departure& departure);
  void set_up_cvode();
  void find_relative_unknowns();
  void project_state(double t, VectorRef y);
  void integrate_interval(double start, double end);
  void march_surface();
  void step(double end);
  void restart(double t);
  void count_before_restart();
  void record_samples(double up_to);
  void change_contacts(double t);
  void repair_contacts(double t);
  void set_down(std::size_t contact, double t);
  void slide_pads(double t);
  void look_for_condition(double t, bool found);
  // Contacts, then sheaves with friction, then the awaited condition.
  int root_count() const {
    return system_.contact_count() + static_cast<int>(sheaves_.size()) +
           (settings_.awaited ? 1 : 0);
  }
  void begin_split(std::size_t rope);
  void evaluate_contacts(double t);
  void change_contact(std::size_t contact, bool acts, double t);
  bool change_sheaves(double t, const std::vector<int>* found);
  double sheave_indicator(const RubbingSheave& at) const;
  bool is_over() const {
    if (settings_.end && time_ >= *settings_.end - beside) return true;
    return settings_.awaited && (result_.met || time_ >= settings_.awaited->until);
  }
  void steer(double t);
  bool motion_jumps(double t) const;
  bool part_ropes(double t);
  double within_interval(double t) const { return std::clamp(t, from_, to_); }
  void check_pace();
  void report_progress(double t);
  [[noreturn]] void fail(const char* what);

  static int right_hand_side(double t, N_Vector y, N_Vector ydot, void* data);
  static int newton_matrix(double t, N_Vector y, N_Vector ydot, SUNMatrix A, int keep_point,
                           int* point_set, double gamma, void* data, N_Vector, N_Vector, N_Vector);
  static int solve_newton(SUNLinearSolver solver, SUNMatrix A, N_Vector x, N_Vector b, double);
  static int indicators(double t, N_Vector y, double* g, void* data);
  static int works(double t, N_Vector y, N_Vector rates, void* data);
  static int project(double t, N_Vector y, N_Vector correction, double tolerance, N_Vector error,
                     void* data);
  static int error_weights(N_Vector y, N_Vector weights, void* data);
  static void keep_message(int code, const char* module, const char* function, char* message,
                           void* data);
  template <class Function>
  int guarded(Function&& function);

  const LiftSystem& system_;
  const IntegrationSettings& settings_;
  LiftWorkspace w_;
  NewtonMatrix newton_;
  std::optional<StateProjection> projection_;
  std::optional<MarchedSurface> surface_;
  std::optional<Steersman> steersman_;
  Contacts contacts_;
  bool on_ground_ = false;  ///< are there pads that are ground?
  std::vector<RubbingSheave> sheaves_;
  Eigen::VectorXd sample_times_;
  Eigen::Index next_sample_ = 0;
  std::vector<Eigen::Index> relative_unknowns_;  ///< velocities and quaternions: within y
  Eigen::VectorXd indicators_;    ///< at the end of the last step, where no root was found
  double awaited_value_ = -1.0;   ///< likewise of the awaited condition
  double begin_ = 0.0;            ///< of the run
  double from_ = 0.0, to_ = 0.0;  ///< times between which motions are evaluated now
  double time_ = 0.0;
  // Where the workspace holds the loads of an instant that may be asked for again: time and state.
  double loaded_time_ = not_a_number;
  Eigen::VectorXd loaded_state_;
  double evaluated_time_ =
      not_a_number;  ///< of the right-hand side's last evaluation by the method, s

  sundials::Context context_;
  sundials::Vector y_, rates_, sample_, work_, sampled_work_;
  sundials::Matrix matrix_;
  sundials::LinearSolver linear_solver_;
  void* cvode_ = nullptr;
  std::exception_ptr exception_;
  std::string message_;
  IntegrationResult result_;
  double reported_ = -1.0;  ///< fraction of the operation
  long steps_taken_ = 0;
  double time_of_portion_ = 0.0;  // when the last hundredth of the allowed steps was taken
};

Integrator::Integrator(const LiftSystem& system, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const IntegrationSettings& settings)
    : system_(system),
      settings_(settings),
      w_(system),
      newton_(system),
      sample_times_(samples_of(system, settings)),
      context_(sundials::make_context()),
      result_{History(system, sample_times_.size(), settings.works), {}, {}, {}, {}, {}} {
  if (!system.operation().steerings().empty()) steersman_.emplace(system);
  if (!(settings.relative_tolerance > 0.0) || settings.relative_tolerance > 0.1) {
    throw ModelError("the relative tolerance is " + std::to_string(settings.relative_tolerance) +
                     "; a number between 1e-12 and 0.1 is due");
  }
  w_.q = q;
  w_.v = v;
  if (settings.departure) depart(*settings.departure);
  system.mechanism().normalise(w_.q);
  // CVODES wants at least one unknown: where everything is driven, one that stays zero.
  const Eigen::Index size = std::max(1, system.state_size());
  for (sundials::Vector* vector : {&y_, &sample_, &rates_}) {
    *vector = sundials::make_vector(size, context_);
    sundials::view(vector->get()).setZero();
  }
  work_ = sundials::make_vector(4, context_);
  sampled_work_ = sundials::make_vector(4, context_);
  indicators_.setZero(system.contact_count());
  for (const SupportPad& pad : system.supports())
    on_ground_ = on_ground_ || pad.definition().ground;
  for (std::size_t i = 0; i < w_.splits.size(); ++i) {
    for (std::size_t j = 0; j < w_.splits[i].sheave_count(); ++j) sheaves_.push_back({i, j});
  }
  loaded_state_.setZero(size);
  sundials::view(work_.get()).setZero();
  projection_.emplace(system, w_, begin_);
  get_state(system, w_.q, w_.v, sundials::view(y_.get()));
  sundials::view(y_.get()).segment(system.nq_free() + system.nv_free(), w_.memory.size()) =
      w_.memory;
  find_relative_unknowns();
  project_state(begin_, sundials::view(y_.get()));
  if (settings.surface) {
    set_state(system, sundials::view(y_.get()), w_);
    set_drives(system, 0.0, true, w_);
    surface_.emplace(*settings.surface, settings.surface_step, system, w_);
  }
}

void Integrator::depart(const Departure& departure) {
  if (settings_.surface || !system_.operation().steerings().empty())
    throw ModelError("a run with a marched surface or steered drives begins at time 0");
  if (!(departure.time >= 0.0) || departure.time >= system_.operation().duration() ||
      departure.q.size() != w_.q.size() || departure.v.size() != w_.v.size() ||
      departure.memory.size() != w_.memory.size() ||
      departure.standing_places.size() != w_.standing_places.size() ||
      departure.splits.size() != w_.splits.size())
    throw ModelError("a run cannot go on from " + std::to_string(departure.time) +
                     " s: the operation is over, or the instant is one of another lift");
  begin_ = from_ = to_ = time_ = time_of_portion_ = departure.time;
  w_.q = departure.q;
  w_.v = departure.v;
  w_.memory = departure.memory;
  w_.standing_places = departure.standing_places;
  w_.splits = departure.splits;
}

void Integrator::find_relative_unknowns() {
  for (const Eigen::Index first : projection_->quaternions()) {
    for (Eigen::Index i = 0; i < 4; ++i) relative_unknowns_.push_back(first + i);
  }
  for (Eigen::Index i = system_.nq_free(); i < system_.state_size(); ++i) {
    relative_unknowns_.push_back(i);
  }
}

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
  self.loaded_time_ = self.evaluated_time_ = not_a_number;
  return self.guarded([&] {
    calc_right_hand_side(self.system_, self.within_interval(t), sundials::view(y), &self.contacts_,
                         self.w_, sundials::view(ydot));
    self.evaluated_time_ = t;
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
      calc_right_hand_side(self.system_, at, sundials::view(y), &self.contacts_, self.w_,
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

int Integrator::indicators(double t, N_Vector y, double* g, void* data) {
  auto& self = *static_cast<Integrator*>(data);
  return self.guarded([&] {
    const auto state = sundials::view(y);
    // At the end of a step the works have just been evaluated.
    const bool awaits = self.settings_.awaited.has_value();
    if (awaits || t != self.loaded_time_ || state != self.loaded_state_) {
      self.loaded_time_ = not_a_number;
      set_state(self.system_, state, self.w_);
      set_drives(self.system_, self.within_interval(t), true, self.w_);
      calc_contact_loads(self.system_, &self.contacts_, self.w_);
    }
    calc_contact_indicators(self.w_, self.indicators_);
    Eigen::Map<Eigen::VectorXd>(g, self.system_.contact_count()) = self.indicators_;
    double* of_sheave = g + self.system_.contact_count();
    for (const RubbingSheave& at : self.sheaves_) *of_sheave++ = self.sheave_indicator(at);
    if (!awaits) return;
    const AwaitedCondition& awaited = *self.settings_.awaited;
    // Before its time it counts as not met.
    self.awaited_value_ =
        self.to_ > awaited.from + beside ? awaited.indicator(self.system_, self.w_) : -1.0;
    *of_sheave = self.awaited_value_;
  });
}

int Integrator::works(double t, N_Vector y, N_Vector rates, void* data) {
  auto& self = *static_cast<Integrator*>(data);
  return self.guarded([&] {
    // At the end of a step the hulls' forces are those that the last of Newton's iterations asked
    // for: of the same time, and of a state that differs by what the step may err.
    const HullForces hulls = t == self.evaluated_time_ ? HullForces::kept : HullForces::evaluated;
    const EnergyRates powers = calc_energy_rates(
        self.system_, self.within_interval(t), sundials::view(y), &self.contacts_, hulls, self.w_);
    sundials::view(rates) << powers.drive_power, powers.winch_power, powers.outside_power,
        powers.dissipated_power;
    self.loaded_state_ = sundials::view(y);
    self.loaded_time_ = t;
  });
}

void Integrator::project_state(double t, VectorRef y) {
  loaded_time_ = not_a_number;
  projection_->project(within_interval(t), y, w_);
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
  if (root_count() > 0) {
    check(CVodeRootInit(cvode_, root_count(), indicators), "CVodeRootInit");
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
}

// Does a velocity or acceleration of a drive or winch differ on the two sides of t?
bool Integrator::motion_jumps(double t) const {
  const auto jumps = [&](const MotionProfile& profile) {
    const ProfileValue a = profile.evaluate(t - beside);
    const ProfileValue b = profile.evaluate(t + beside);
    return std::abs(a.velocity - b.velocity) > 1e-4 ||
           std::abs(a.acceleration - b.acceleration) > 1e-3;
  };
  for (const JointDrive& drive : system_.operation().joint_drives()) {
    if (jumps(drive.position)) return true;
  }
  for (const Winch& winch : system_.operation().winches()) {
    if (jumps(winch.length)) return true;
  }
  return std::any_of(w_.steered.begin(), w_.steered.end(), jumps);
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

// Begins anew at (t, y_): the method's memory of the past does not hold any more.
void Integrator::restart(double t) {
  count_before_restart();
  loaded_time_ = not_a_number;  // other contacts act
  project_state(t, sundials::view(y_.get()));
  sundials::check(CVodeReInit(cvode_, t, y_.get()), "CVodeReInit");
  if (settings_.works) sundials::check(CVodeQuadReInit(cvode_, work_.get()), "CVodeQuadReInit");
  ++result_.statistics.restarts;
}

void Integrator::record_samples(double up_to) {
  while (next_sample_ < sample_times_.size() && sample_times_[next_sample_] <= up_to) {
    loaded_time_ = evaluated_time_ = not_a_number;
    const double t = sample_times_[next_sample_];
    if (t > begin_) {
      sundials::check(CVodeGetDky(cvode_, t, 0, sample_.get()), "CVodeGetDky");
    } else {
      sundials::view(sample_.get()) = sundials::view(y_.get());
    }
    auto y = sundials::view(sample_.get());
    project_state(t, y);
    // Multipliers of a sample are the least of all that balance it.
    std::optional<LoopRows> rows;
    rows.swap(w_.loop_rows);
    calc_right_hand_side(system_, within_interval(t), y, &contacts_, w_,
                         sundials::view(rates_.get()));
    rows.swap(w_.loop_rows);
    result_.history.record(system_, next_sample_, t, w_);
    if (settings_.observe) settings_.observe(next_sample_, t, w_);
    if (settings_.works) {
      sundials::view(sampled_work_.get()).setZero();
      if (t > begin_) {
        sundials::check(CVodeGetQuadDky(cvode_, t, 0, sampled_work_.get()), "CVodeGetQuadDky");
      }
      result_.history.record_works(next_sample_, sundials::view(sampled_work_.get()));
    }
    ++next_sample_;
  }
}

void Integrator::change_contacts(double t) {
  std::vector<int> found(static_cast<std::size_t>(root_count()));
  sundials::check(CVodeGetRootInfo(cvode_, found.data()), "CVodeGetRootInfo");
  if (settings_.awaited && found.back() > 0) look_for_condition(t, true);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (found[i] == 0) continue;
    const bool acts = found[i] > 0;
    if (acts != (contacts_[i] != 0)) change_contact(i, acts, t);
  }
  change_sheaves(t, &found);
}

void Integrator::change_contact(std::size_t contact, bool acts, double t) {
  const bool is_rope = contact < system_.ropes().size();
  const bool divided = is_rope && w_.splits[contact].acts();
  const auto stored = [&] {
    if (!is_rope) return 0.0;
    evaluate_contacts(t);
    return calc_rope_energy(system_, contact, w_).stored_energy;
  };
  const double before = stored();
  contacts_[contact] = acts ? 1 : 0;
  result_.events.push_back({t, static_cast<int>(contact), acts});
  ++result_.statistics.contact_changes;
  if (acts) set_down(contact, t);
  if (divided && acts) begin_split(contact);
  // What a rope that becomes slack while it is still stretched had stored is lost.
  sundials::view(work_.get())[3] += before - stored();
}

// Kinematics and loads of ropes and pads at (t, y_).
void Integrator::evaluate_contacts(double t) {
  loaded_time_ = evaluated_time_ = not_a_number;
  set_state(system_, sundials::view(y_.get()), w_);
  set_drives(system_, within_interval(t), true, w_);
  calc_contact_loads(system_, &contacts_, w_);
}

// Friction divides the rope from now on, from one tension; at the workspace's kinematics.
void Integrator::begin_split(std::size_t rope) {
  const Rope& one = system_.ropes()[rope];
  one.calc_path(w_.kinematics, w_.path);
  w_.splits[rope].begin(one, w_.kinematics, w_.path,
                        one.calc_load(w_.path, w_.feeds[rope], contacts_[rope] != 0));
}

double Integrator::sheave_indicator(const RubbingSheave& at) const {
  // Where nothing is taut nothing slips.
  return w_.rope_loads[at.rope].split.acts ? w_.splits[at.rope].indicator(at.sheave) : 1.0;
}

// Sheaves at which ropes begin to slip or to stick now: those found as roots, and those whose
// change began at the very start of a step, which root-finding could not see. Are there any?
bool Integrator::change_sheaves(double t, const std::vector<int>* found) {
  constexpr double beyond = 1e-4;  // kN, kN/s
  if (sheaves_.empty()) return false;
  evaluate_contacts(t);
  bool changed = false;
  for (std::size_t k = 0; k < sheaves_.size(); ++k) {
    const RubbingSheave& at = sheaves_[k];
    const auto root = static_cast<std::size_t>(system_.contact_count()) + k;
    const double value = sheave_indicator(at);
    if (!(found && (*found)[root] < 0) && value > -beyond) continue;
    RopeSplit& split = w_.splits[at.rope];
    if (!w_.rope_loads[at.rope].split.acts) continue;
    split.set_motion(at.sheave, split.motion(at.sheave) == SheaveMotion::sticks
                                    ? split.tendency(at.sheave)
                                    : SheaveMotion::sticks);
    ++result_.statistics.sheave_changes;
    changed = true;
  }
  return changed;
}

// Where friction has slid over the ground it holds from there on; its force does not jump by that.
void Integrator::slide_pads(double t) {
  const auto first = contacts_.begin() + static_cast<std::ptrdiff_t>(system_.ropes().size());
  if (std::find(first, contacts_.end(), 1) == contacts_.end()) return;
  evaluate_contacts(t);
  carry_pads_along(system_, w_);
}

// Friction holds a point of the load where it touches the ground.
void Integrator::set_down(std::size_t contact, double t) {
  if (contact < system_.ropes().size()) return;
  loaded_time_ = evaluated_time_ = not_a_number;
  set_state(system_, sundials::view(y_.get()), w_);
  set_drives(system_, within_interval(t), true, w_);
  compute_kinematics(system_.mechanism(), w_.q, w_.v, w_.kinematics);
  set_down_pad(system_, contact - system_.ropes().size(), w_);
}

// A change that root-finding could not see (it began at the very start of a step) is made good at
// the step's end.
void Integrator::repair_contacts(double t) {
  constexpr double beyond = 1e-4;  // kN
  bool changed = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double value = indicators_[static_cast<Eigen::Index>(i)];
    if (std::abs(value) < beyond || (value > 0.0) == (contacts_[i] != 0)) continue;
    change_contact(i, value > 0.0, t);
    changed = true;
  }
  changed |= change_sheaves(t, nullptr);
  if (changed) restart(t);
}

void Integrator::step(double end) {
  const int flag = CVode(cvode_, end, y_.get(), &time_, CV_ONE_STEP);
  if (flag < 0) fail(CVodeGetReturnFlagName(flag));
  if (settings_.works) {
    double t = 0.0;
    sundials::check(CVodeGetQuad(cvode_, &t, work_.get()), "CVodeGetQuad");
  }
  record_samples(time_);
  if (on_ground_) slide_pads(time_);
  if (flag == CV_ROOT_RETURN) {
    change_contacts(time_);
    restart(time_);
  } else {
    look_for_condition(time_, awaited_value_ > 0.0);
    repair_contacts(time_);
  }
}

void Integrator::look_for_condition(double t, bool found) {
  if (!settings_.awaited || result_.met || !found) return;
  if (t >= settings_.awaited->from - beside && t <= settings_.awaited->until + beside)
    result_.met = t;
}

// Ropes that part now, with all that was taut in them. Does any?
bool Integrator::part_ropes(double t) {
  bool any = false;
  for (const Parting& parting : system_.operation().partings()) {
    RopeFeed& feed = w_.feeds[static_cast<std::size_t>(parting.rope)];
    if (feed.parted || parting.time > t + beside) continue;
    const auto elastic_energy = [&] {
      loaded_time_ = evaluated_time_ = not_a_number;
      calc_right_hand_side(system_, within_interval(t), sundials::view(y_.get()), &contacts_, w_,
                           sundials::view(rates_.get()));
      return calc_stored_energy(system_, within_interval(t), w_).elastic;
    };
    const double before = elastic_energy();
    const RopeLoad load = w_.rope_loads[static_cast<std::size_t>(parting.rope)];
    feed.parted = true;
    char& acts = contacts_[static_cast<std::size_t>(parting.rope)];
    if (acts != 0) result_.events.push_back({t, parting.rope, false});
    acts = 0;
    const double energy = before - elastic_energy();
    sundials::view(work_.get())[3] += energy;
    // What a rope with weight loses besides is that of its height.
    const bool hangs = system_.ropes()[static_cast<std::size_t>(parting.rope)].hangs();
    result_.parted.push_back(
        {parting.rope, t, load.tension, hangs ? load.hanging.strain_energy : energy});
    any = true;
  }
  return any;
}

// What steered drives do from now on.
void Integrator::steer(double t) {
  if (!steersman_ || !steersman_->looks_at(t)) return;
  loaded_time_ = evaluated_time_ = not_a_number;
  set_state(system_, sundials::view(y_.get()), w_);
  set_drives(system_, within_interval(t), true, w_);
  calc_contact_loads(system_, &contacts_, w_);
  steersman_->look(t, w_);
}

void Integrator::integrate_interval(double start, double end) {
  const bool parted = part_ropes(start);
  steer(start);
  // Behind a jump the motion counts as it is then, from the first step on.
  loaded_time_ = not_a_number;
  const bool jumps = motion_jumps(start);
  from_ = jumps ? std::min(start + beside, end) : start;
  to_ = end;
  if (parted || (jumps && start > begin_)) restart(time_);
  const double reached = end - 1e-12 * std::max(1.0, end);
  while (time_ < reached) {
    if (++steps_taken_ > settings_.largest_step_count) fail("more steps than allowed");
    check_pace();
    // A surface's step that ends together with the interval ends with it.
    const bool first = surface_ && surface_->next() < end - 1e-6 * settings_.surface_step;
    const double stop = first ? surface_->next() : end;
    sundials::check(CVodeSetStopTime(cvode_, stop), "CVodeSetStopTime");
    step(stop);
    if (surface_) march_surface();
    report_progress(time_);
    if (is_over()) return;
  }
}

// At the end of a step of the surface: the surface follows the bodies, and the force the surface.
void Integrator::march_surface() {
  if (time_ < surface_->next() - 2e-6 * settings_.surface_step) return;
  loaded_time_ = not_a_number;
  set_state(system_, sundials::view(y_.get()), w_);
  set_drives(system_, within_interval(time_), true, w_);
  compute_kinematics(system_.mechanism(), w_.q, w_.v, w_.kinematics);
  surface_->advance(w_);
}

// A motion that is far faster than the operation would go on for hours before the steps run out: a
// hundredth of the steps brings it a hundredth of the way, or it will not arrive.
void Integrator::check_pace() {
  constexpr long too_few = 100;  // the first steps of a method are small
  const long portion = settings_.largest_step_count / 100;
  if (portion < too_few || steps_taken_ % portion != 0) return;
  const double gained = time_ - time_of_portion_;
  time_of_portion_ = time_;
  const double duration = system_.operation().duration();
  if (gained * static_cast<double>(settings_.largest_step_count) >=
      duration * static_cast<double>(portion)) {
    return;
  }
  std::ostringstream what;
  what << "the last " << portion << " steps were of " << gained / static_cast<double>(portion)
       << " s: something moves far too fast for an operation of " << duration << " s";
  fail(what.str().c_str());
}

void Integrator::report_progress(double t) {
  constexpr long steps_between = 10000;  // where the time hardly moves
  if (!settings_.progress) return;
  const double fraction = t / system_.operation().duration();
  if (fraction < reported_ + 0.01 && fraction < 1.0 && steps_taken_ % steps_between != 0) return;
  reported_ = fraction;
  settings_.progress(fraction, t);
}

void Integrator::fail(const char* what) {
  const bool has_loops = !system_.mechanism().loops().empty();
  std::ostringstream text;
  text << "the time integration failed at t = " << time_ << " s (" << what;
  try {
    if (exception_) std::rethrow_exception(exception_);
    if (!message_.empty()) text << ": " << message_;
  } catch (const std::exception& error) {
    text << ": " << error.what();
  }
  text << ")";
  try {
    calc_right_hand_side(system_, within_interval(time_), sundials::view(y_.get()), nullptr, w_,
                         sundials::view(rates_.get()));
    text << "; " << describe_ropes(system_, w_) << "; fastest bodies: ";
    const std::size_t n = w_.kinematics.V_WB.size();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return w_.kinematics.V_WB[a].linear.norm() > w_.kinematics.V_WB[b].linear.norm();
    });
    for (std::size_t i = 0; i < std::min<std::size_t>(3, n); ++i) {
      text << (i > 0 ? ", " : "") << system_.mechanism().body(static_cast<int>(order[i])).name
           << " (" << w_.kinematics.V_WB[order[i]].linear.norm() << " m/s)";
    }
    if (has_loops) {
      const LoopDiagnosis diagnosis = diagnose_loops(system_.mechanism(), w_.q);
      for (const std::string& sentence : diagnosis.toggle_sentences(system_.mechanism())) {
        text << "; " << sentence;
      }
    }
  } catch (const std::exception& error) {
    text << "; " << error.what();
  }
  if (has_loops && settings_.relative_tolerance < least_tolerance_through_singular_positions) {
    text << "; where loops pass a singular position, rounding keeps the state from being known "
            "better than "
         << least_tolerance_through_singular_positions
         << ": ask for no smaller relative tolerance there";
  }
  text << "; try gentler motions, more rope damping (damping_time) or a smaller tolerance, and see "
          "whether a rope is hoisted into its sheave";
  throw SimulationError(text.str());
}

IntegrationResult Integrator::run() {
  const std::vector<double>& breakpoints = system_.operation().breakpoints();
  std::size_t first = 0;
  while (breakpoints[first + 1] <= begin_ + beside) ++first;
  from_ = begin_;
  to_ = breakpoints[first + 1];
  contacts_ = find_contacts(system_, begin_, sundials::view(y_.get()), w_);
  if (!settings_.departure && !sheaves_.empty()) {
    evaluate_contacts(begin_);
    for (std::size_t i = 0; i < w_.splits.size(); ++i) {
      if (w_.splits[i].rubs()) begin_split(i);
    }
  }
  set_up_cvode();
  record_samples(begin_);
  for (std::size_t i = first; i + 1 < breakpoints.size() && !is_over(); ++i) {
    integrate_interval(std::max(begin_, breakpoints[i]), breakpoints[i + 1]);
  }
  count_before_restart();
  const double end = is_over() ? time_ : system_.operation().duration();
  project_state(end, sundials::view(y_.get()));
  set_state(system_, sundials::view(y_.get()), w_);
  set_drives(system_, end, true, w_);
  result_.q_end = w_.q;
  result_.v_end = w_.v;
  system_.mechanism().normalise(result_.q_end);
  if (steersman_) result_.courses = steersman_->courses();
  return std::move(result_);
}

}  // namespace

double AwaitedCondition::indicator(const LiftSystem& system, const LiftWorkspace& w) const {
  if (kind == Kind::slack || kind == Kind::taut) {
    const double pull = 1e-3 * w.rope_loads[static_cast<std::size_t>(rope)].slack_indicator();
    return kind == Kind::taut ? pull : -pull;
  }
  double by_pads = 0.0;
  for (std::size_t i = 0; i < w.support_loads.size(); ++i) {
    if (system.supports()[i].definition().point.body == body)
      by_pads += w.support_loads[i].force_W.z();
  }
  if (kind == Kind::pads_at_least) return 1e-3 * (by_pads - force);
  // calc_contact_loads has the loads of ropes and pads alone.
  const double by_ropes = w.loads.F_Bo_W[static_cast<std::size_t>(body)].force.z() - by_pads;
  return 1e-3 * (kind == Kind::ropes_at_least ? by_ropes - force : force - by_ropes);
}

IntegrationResult integrate(const LiftSystem& system, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const IntegrationSettings& settings) {
  return Integrator(system, q, v, settings).run();
}

}  // namespace blocklift::dynamics

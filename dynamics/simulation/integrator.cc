#include "dynamics/simulation/integrator.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <sstream>

#include <cvodes/cvodes.h>

#include "dynamics/simulation/energy_ledger.h"
#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/failure_description.h"

namespace blocklift::dynamics {

namespace {

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

}  // namespace

Integrator::Integrator(const LiftSystem& system, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const IntegrationSettings& settings, bool with_peaks)
    : system_(system),
      settings_(settings),
      w_(system),
      newton_(system),
      forecast_(system, settings.relative_tolerance),
      events_(system, settings.awaited ? &*settings.awaited : nullptr, w_,
              [this](double t) { move_to(t); }),
      roots_(static_cast<std::size_t>(events_.count())),
      sample_times_(samples_of(system, settings)),
      context_(sundials::make_context()),
      result_{History(system,
                      sample_times_.size() +
                          (with_peaks ? static_cast<Eigen::Index>(system.ropes().size()) : 0),
                      settings.works, settings.recording),
              {},
              {},
              {},
              {},
              {}} {
  if (with_peaks) peaks_.emplace(result_.history);
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
  for (const SupportPad& pad : system.supports())
    on_ground_ = on_ground_ || pad.definition().ground;
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

Integrator::~Integrator() { CVodeFree(&cvode_); }

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

void Integrator::project_state(double t, VectorRef y) {
  loaded_time_ = not_a_number;
  projection_->project(within_interval(t), y, w_);
}

// q, v and feeds of the workspace to y_.
void Integrator::move_to(double t) {
  loaded_time_ = evaluated_time_ = foreseen_time_ = not_a_number;
  set_state(system_, sundials::view(y_.get()), w_);
  set_drives(system_, within_interval(t), true, w_);
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

// Begins anew at (t, y_): the method's memory of the past does not hold any more.
void Integrator::restart(double t) {
  count_before_restart();
  loaded_time_ = foreseen_time_ = not_a_number;  // other contacts act
  project_state(t, sundials::view(y_.get()));
  sundials::check(CVodeReInit(cvode_, t, y_.get()), "CVodeReInit");
  if (settings_.works) sundials::check(CVodeQuadReInit(cvode_, work_.get()), "CVodeQuadReInit");
  ++result_.statistics.restarts;
}

// As much of a sample as is recorded.
void Integrator::evaluate_sample(double t, ConstVectorRef y) {
  if (!settings_.recording.takes_dynamics()) {
    set_state(system_, y, w_);
    set_drives(system_, t, true, w_);
    calc_contact_loads(system_, &events_.contacts(), w_);
    return;
  }
  // Multipliers of a sample are the least of all that balance it.
  std::optional<LoopRows> rows;
  rows.swap(w_.loop_rows);
  calc_right_hand_side(system_, t, y, &events_.contacts(), w_, sundials::view(rates_.get()));
  rows.swap(w_.loop_rows);
}

// The state at a time within the last step, or at the beginning, into sample_.
void Integrator::interpolate(double t) {
  loaded_time_ = evaluated_time_ = foreseen_time_ = not_a_number;
  if (time_ > begin_) {
    sundials::check(CVodeGetDky(cvode_, t, 0, sample_.get()), "CVodeGetDky");
  } else {
    sundials::view(sample_.get()) = sundials::view(y_.get());
  }
  project_state(t, sundials::view(sample_.get()));
}

void Integrator::record_sample(Eigen::Index sample, double t) {
  interpolate(t);
  evaluate_sample(within_interval(t), sundials::view(sample_.get()));
  result_.history.record(system_, sample, t, w_);
  if (!settings_.works) return;
  sundials::view(sampled_work_.get()).setZero();
  if (time_ > begin_)
    sundials::check(CVodeGetQuadDky(cvode_, t, 0, sampled_work_.get()), "CVodeGetQuadDky");
  result_.history.record_works(sample, sundials::view(sampled_work_.get()));
}

void Integrator::record_samples(double up_to) {
  while (next_sample_ < sample_times_.size() && sample_times_[next_sample_] <= up_to) {
    const double t = sample_times_[next_sample_];
    record_sample(next_sample_, t);
    if (settings_.observe) settings_.observe(next_sample_, t, w_);
    if (peaks_) peaks_->note_sample(next_sample_);
    ++next_sample_;
  }
}

// Largest loads within the step that has just been taken.
void Integrator::seek_peaks(double begin, bool ends_at_corner) {
  const auto loads = [this](double t) -> const std::vector<RopeLoad>& {
    if (t == time_) {
      events_.load(t);
      return w_.rope_loads;
    }
    interpolate(t);
    set_state(system_, sundials::view(sample_.get()), w_);
    set_drives(system_, within_interval(t), true, w_);
    calc_contact_loads(system_, &events_.contacts(), w_);
    return w_.rope_loads;
  };
  // Behind a jump of a motion the step begins a little later than the one before it ended.
  const auto record = [this](double t, Eigen::Index sample) {
    record_sample(sample, std::min(within_interval(t), time_));
  };
  double now = 0.0, length = 0.0;
  sundials::check(CVodeGetCurrentTime(cvode_, &now), "CVodeGetCurrentTime");
  sundials::check(CVodeGetLastStep(cvode_, &length), "CVodeGetLastStep");
  const double first = std::max(begin, now - length);
  if (time_ > first) peaks_->seek({first, time_, ends_at_corner}, loads, record);
}

// Where friction has slid over the ground it holds from there on; its force does not jump by that.
void Integrator::slide_pads(double t) {
  const std::vector<char>& contacts = events_.contacts();
  const auto first = contacts.begin() + static_cast<std::ptrdiff_t>(system_.ropes().size());
  const auto last = first + static_cast<std::ptrdiff_t>(system_.supports().size());
  if (std::find(first, last, 1) == last) return;
  events_.load(t);
  carry_pads_along(system_, w_);
}

// Of many waves, as far ahead as the next step may ask for them. The bodies' accelerations are
// those of the method itself, so that what is recorded does not matter.
void Integrator::forecast_waves(double end) {
  if (!settings_.forecast_waves || !forecast_.is_needed()) return;
  double length = 0.0;
  long steps = 0;
  sundials::check(CVodeGetCurrentStep(cvode_, &length), "CVodeGetCurrentStep");
  sundials::check(CVodeGetNumSteps(cvode_, &steps), "CVodeGetNumSteps");
  const double until = std::min(end, time_ + length);
  if (!forecast_.is_due(time_, until, w_)) return;
  if (steps > 0) {
    sundials::check(CVodeGetDky(cvode_, time_, 1, rates_.get()), "CVodeGetDky");
  } else {
    calc_right_hand_side(system_, within_interval(time_), sundials::view(y_.get()),
                         &events_.contacts(), w_, sundials::view(rates_.get()));
  }
  move_to(time_);
  Eigen::Index i = system_.nq_free();
  for (const int k : system_.mechanism().free_velocities())
    w_.vdot[k] = sundials::view(rates_.get())[i++];
  if (forecast_.carry_on(time_, until, w_)) restart(time_);
}

void Integrator::step(double end) {
  const double begin = time_;
  forecast_waves(end);
  const int flag = CVode(cvode_, end, y_.get(), &time_, CV_ONE_STEP);
  if (flag < 0) fail(CVodeGetReturnFlagName(flag));
  if (settings_.works) {
    double t = 0.0;
    sundials::check(CVodeGetQuad(cvode_, &t, work_.get()), "CVodeGetQuad");
  }
  record_samples(time_);
  if (peaks_) seek_peaks(begin, flag == CV_ROOT_RETURN || time_ >= to_ - beside);
  if (on_ground_) slide_pads(time_);
  events_.carry_splits(time_);
  change_events(flag == CV_ROOT_RETURN);
}

void Integrator::change_events(bool at_root) {
  if (at_root) sundials::check(CVodeGetRootInfo(cvode_, roots_.data()), "CVodeGetRootInfo");
  const bool anew =
      events_.change(time_, at_root ? &roots_ : nullptr, {result_, dissipated_work()});
  if (at_root || anew) restart(time_);
}

bool Integrator::is_over() const {
  if (settings_.end && time_ >= *settings_.end - beside) return true;
  return settings_.awaited && (result_.met || time_ >= settings_.awaited->until);
}

// Ropes that part now, with all that was taut in them. Does any?
bool Integrator::part_ropes(double t) {
  bool any = false;
  for (const Parting& parting : system_.operation().partings()) {
    RopeFeed& feed = w_.feeds[parting.rope];
    if (feed.parted || parting.time > t + beside) continue;
    const auto elastic_energy = [&] {
      loaded_time_ = evaluated_time_ = not_a_number;
      calc_right_hand_side(system_, within_interval(t), sundials::view(y_.get()),
                           &events_.contacts(), w_, sundials::view(rates_.get()));
      return calc_stored_energy(system_, within_interval(t), w_).elastic;
    };
    const double before = elastic_energy();
    const RopeLoad load = w_.rope_loads[parting.rope];
    feed.parted = true;
    if (events_.release(parting.rope)) result_.events.push_back({t, parting.rope, false});
    const double energy = before - elastic_energy();
    dissipated_work() += energy;
    // What a rope with weight loses besides is the energy of its height.
    const bool hangs = system_.ropes()[parting.rope].hangs();
    result_.parted.push_back(
        {parting.rope, t, load.tension, hangs ? load.hanging.strain_energy : energy});
    any = true;
  }
  return any;
}

// What steered drives do from now on.
void Integrator::steer(double t) {
  if (!steersman_ || !steersman_->looks_at(t)) return;
  events_.load(t);
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
  move_to(time_);
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
    text << "; ";
    describe_motion(text, system_, w_);
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
  events_.set_contacts(find_contacts(system_, begin_, sundials::view(y_.get()), w_));
  if (!settings_.departure) events_.begin_splits(begin_);
  set_up_cvode();
  if (settings_.forecast_waves && forecast_.is_needed()) forecast_.begin(begin_, w_);
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
  if (peaks_) peaks_->arrange();
  return std::move(result_);
}

}  // namespace blocklift::dynamics

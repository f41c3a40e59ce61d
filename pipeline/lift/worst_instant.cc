#include "pipeline/lift/worst_instant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/simulation/tension_peaks.h"
#include "pipeline/build/held_heading.h"

namespace blocklift::pipeline {

namespace {

using Trial = WorstInstant::Trial;

constexpr int even_instants = 40;
constexpr int worst_kept = 3;        // around which closer instants are tried
constexpr int closer = 4;            // times, from round to round
constexpr double closest = 0.05;     // s
constexpr double standstill = 1e-6;  // m/s or rad/s

/// Largest share of a breaking load among the watched ropes.
class Watch {
 public:
  Watch(const given::Fault& fault, const BuiltLift& model) {
    const auto add = [&](const auto& rope) {
      const bool named = std::any_of(
          fault.worst_for.begin(), fault.worst_for.end(),
          [&](const auto& one) { return one.value == "all" || one.value == rope.name; });
      if (named && std::isfinite(rope.breaking_load))
        ropes_.push_back({rope.name, static_cast<std::size_t>(rope.rope), rope.breaking_load});
    };
    for (const LiftRope& rope : model.ropes) add(rope);
    for (const LiftHoist& hoist : model.hoists) add(hoist);
  }

  Trial begin(double time) const { return {time, 0.0, "no rope", time}; }

  /// Raises a trial by what ropes bear behind an instant, s.
  void look(const dynamics::History& history, double behind, Trial& trial) const {
    for (Eigen::Index sample = 0; sample < history.sample_count(); ++sample) {
      if (!(history.time[sample] > behind)) continue;
      for (const Watched& rope : ropes_) {
        const double share = history.ropes[rope.index].tension[sample] / rope.breaking_load;
        if (share > trial.share) trial = {trial.time, share, rope.name, history.time[sample]};
      }
    }
  }

 private:
  struct Watched {
    std::string name;
    std::size_t index;
    double breaking_load;
  };
  std::vector<Watched> ropes_;
};

/// The search; instants are numbers of samples.
class Search {
 public:
  Search(const LiftCase& lift_case, const given::Fault& fault,
         const std::function<BuiltLift(std::optional<double>)>& build, const Progress& progress)
      : case_(lift_case),
        fault_(fault),
        build_(build),
        progress_(progress),
        undisturbed_(build(std::nullopt)),
        times_(dynamics::sample_times(undisturbed_.system.operation().duration(),
                                      lift_case.dynamics.sample_interval)),
        watch_(fault, undisturbed_),
        q_(undisturbed_.system.q_start()) {
    solver_at_rest(undisturbed_).solve(0, q_);
    find_moving();
  }

  WorstInstant run() {
    const auto last = static_cast<Eigen::Index>(moving_.size()) - 1;
    std::set<Eigen::Index> instants = jumps();
    for (int i = 0; i <= even_instants; ++i) instants.insert(moving_[last * i / even_instants]);
    WorstInstant worst;
    worst.undisturbed = try_all(instants, true);
    auto step = static_cast<double>(last) / even_instants;
    while (step * case_.dynamics.sample_interval > closest && step > 1.0) {
      step /= closer;
      try_all(around_worst(std::max(1.0, step)), false);
    }
    for (const auto& [instant, trial] : tried_) worst.trials.push_back(trial);
    worst.worst =
        *std::max_element(worst.trials.begin(), worst.trials.end(),
                          [](const Trial& a, const Trial& b) { return a.share < b.share; });
    return worst;
  }

 private:
  /// Samples at which a drive moves, within the time in which the instant is sought.
  void find_moving() {
    const dynamics::Operation& operation = undisturbed_.system.operation();
    const auto anything_moves = [&](double t) {
      const auto moves = [&](const dynamics::MotionProfile& profile) {
        return std::abs(profile.evaluate(t).velocity) > standstill;
      };
      return std::any_of(operation.joint_drives().begin(), operation.joint_drives().end(),
                         [&](const auto& drive) { return moves(drive.position); }) ||
             std::any_of(operation.winches().begin(), operation.winches().end(),
                         [&](const auto& winch) { return moves(winch.length); });
    };
    for (Eigen::Index i = 1; i + 1 < times_.size(); ++i) {
      if (fault_.from && times_[i] < fault_.from->value) continue;
      if (fault_.to && times_[i] > fault_.to->value) break;
      if (anything_moves(times_[i])) moving_.push_back(i);
    }
    if (!moving_.empty()) return;
    throw dynamics::SimulationError(
        "the worst instant of a fault is sought where nothing moves; give it an instant (at), or "
        "seek it elsewhere (from, to)");
  }

  /// Samples beside instants at which a motion's jerk jumps.
  std::set<Eigen::Index> jumps() const {
    std::set<Eigen::Index> instants;
    const auto add = [&](double time) {
      const auto sample = static_cast<Eigen::Index>(time / case_.dynamics.sample_interval);
      for (const Eigen::Index near : {sample, sample + 1})
        if (std::binary_search(moving_.begin(), moving_.end(), near)) instants.insert(near);
    };
    // Of moves as they were planned: a steered drive has one at each look.
    for (const ScheduledMove& move : undisturbed_.schedule.moves)
      for (const double time : move.move.breakpoints()) add(time);
    return instants;
  }

  /// Instants not tried yet around the worst ones that are not neighbours.
  std::set<Eigen::Index> around_worst(double step) const {
    std::vector<std::pair<double, Eigen::Index>> order;
    for (const auto& [instant, trial] : tried_) order.emplace_back(-trial.share, instant);
    std::sort(order.begin(), order.end());
    std::vector<Eigen::Index> kept;
    for (const auto& one : order) {
      const Eigen::Index instant = one.second;
      const bool apart = std::all_of(kept.begin(), kept.end(), [&](Eigen::Index other) {
        return std::abs(static_cast<double>(other - instant)) > closer * step;
      });
      if (apart) kept.push_back(instant);
      if (kept.size() == worst_kept) break;
    }
    std::set<Eigen::Index> instants;
    for (const Eigen::Index centre : kept) {
      for (int k = -closer; k <= closer; ++k) {
        const auto instant = centre + static_cast<Eigen::Index>(std::lround(k * step));
        if (!tried_.contains(instant) &&
            std::binary_search(moving_.begin(), moving_.end(), instant))
          instants.insert(instant);
      }
    }
    return instants;
  }

  /// Tries instants. The undisturbed lift runs up to the last of them, or to its end.
  Trial try_all(const std::set<Eigen::Index>& instants, bool to_the_end) {
    Trial undisturbed = watch_.begin(0.0);
    if (instants.empty()) return undisturbed;
    std::map<Eigen::Index, dynamics::Departure> departures;
    dynamics::IntegrationSettings settings = common_settings(undisturbed_);
    if (!to_the_end) settings.end = times_[*instants.rbegin() + 1];
    settings.observe = [&](Eigen::Index sample, double time, const dynamics::LiftWorkspace& w) {
      if (instants.contains(sample)) departures.emplace(sample, dynamics::Departure::of(time, w));
    };
    const bool departs = !undisturbed_.marched.radiation;
    if (departs || to_the_end)
      watch_.look(integrate(undisturbed_, settings), -std::numeric_limits<double>::infinity(),
                  undisturbed);
    for (const Eigen::Index instant : instants) {
      progress_("worst instant", count_ / (count_ + 100.0),
                fmt::format("t = {:.1f} s", times_[instant]));
      ++count_;
      tried_[instant] = try_one(times_[instant], departs ? &departures.at(instant) : nullptr);
    }
    return undisturbed;
  }

  Trial try_one(double time, const dynamics::Departure* departure) const {
    const BuiltLift model = build_(time);
    Trial trial = watch_.begin(time);
    dynamics::IntegrationSettings settings = common_settings(model);
    settings.departure = departure;
    settings.end =
        std::min(time + fault_.within + fault_.watched, model.system.operation().duration());
    watch_.look(integrate(model, settings), time, trial);
    return trial;
  }

  dynamics::IntegrationSettings common_settings(const BuiltLift& model) const {
    dynamics::IntegrationSettings settings;
    settings.relative_tolerance = case_.dynamics.relative_tolerance;
    settings.sample_interval = case_.dynamics.sample_interval;
    settings.works = false;
    settings.recording = dynamics::Recording::tensions();
    settings.surface = model.marched.radiation.get();
    settings.surface_step = model.marched.step;
    return settings;
  }

  /// With the largest loads between samples, as the lift's own run has them.
  dynamics::History integrate(const BuiltLift& model,
                              const dynamics::IntegrationSettings& settings) const {
    return dynamics::integrate_with_peaks(
               model.system, q_, Eigen::VectorXd::Zero(model.system.mechanism().nv()), settings)
        .history;
  }

  const LiftCase& case_;
  const given::Fault& fault_;
  const std::function<BuiltLift(std::optional<double>)>& build_;
  const Progress& progress_;
  const BuiltLift undisturbed_;
  const Eigen::VectorXd times_;
  const Watch watch_;
  Eigen::VectorXd q_;
  std::vector<Eigen::Index> moving_;
  std::map<Eigen::Index, Trial> tried_;
  int count_ = 0;
};

}  // namespace

const given::Fault* fault_at_worst(const LiftCase& lift_case) {
  for (const given::Fault& fault : lift_case.faults)
    if (!fault.at) return &fault;
  return nullptr;
}

WorstInstant find_worst_instant(
    const LiftCase& lift_case, const std::function<BuiltLift(std::optional<double> instant)>& build,
    const Progress& progress) {
  return Search(lift_case, *fault_at_worst(lift_case), build, progress).run();
}

}  // namespace blocklift::pipeline

#include "pipeline/study/search/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <openturns/OT.hxx>

#include "pipeline/study/limits/figure_limit.h"

namespace blocklift::pipeline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Shares of each variable's range.
constexpr double first_step = 0.25;
constexpr double last_step = 1e-3;
constexpr double apart = 0.25;  // how far from the first the second search begins
// Shares of a limit.
constexpr double rounding = 1e-9;
constexpr double near_limit = 0.01;
// Linear approximations end on either side of a limit: the search aims so far within it that the
// end keeps to it.
constexpr double aimed_within = 1e-5;

double limit_of(const FigureBound& bound, const std::vector<Member>& members) {
  return limit_of(bound.at_most ? *bound.at_most : *bound.at_least, bound.figure.value,
                  unit_of(members, bound.figure.value));
}

/// By what the margins of a bound are counted: its limit or, where that is zero, the largest that
/// its figure is in a sample. A force that may be no less than zero is not to be held to newtons.
double size_of_bound(double limit, const std::string& figure, std::span<const Member> sample) {
  if (limit != 0) return std::abs(limit);
  double largest = 0;
  for (const Member& member : sample)
    if (const double value = member.figure(figure); std::isfinite(value))
      largest = std::max(largest, std::abs(value));
  return largest > 0 ? largest : 1;
}

/// The goal and the bounds of a study as numbers.
class Problem {
 public:
  /// @param members that tell the units of figures and, those of the first sample, their size.
  Problem(const StudyFile& study, const std::vector<Member>& members, int first_sample)
      : study_(study), sign_(study.maximise ? -1 : 1) {
    for (const FigureBound& bound : study.subject_to) {
      limits_.push_back(limit_of(bound, members));
      sizes_.push_back(
          size_of_bound(limits_.back(), bound.figure.value,
                        std::span(members).first(static_cast<std::size_t>(first_sample))));
    }
    const auto count = static_cast<Eigen::Index>(study.variables.size());
    lowest_.resize(count);
    range_.resize(count);
    for (Eigen::Index v = 0; v < count; ++v) {
      const auto& between = study.variables[v].between;
      lowest_[v] = between[0].value.value;
      range_[v] = between[1].value.value - between[0].value.value;
    }
  }

  const std::string& figure() const {
    return study_.maximise ? study_.maximise->value : study_.minimise->value;
  }
  bool is_largest() const { return sign_ < 0; }
  std::size_t bounds() const { return limits_.size(); }
  Eigen::Index variables() const { return range_.size(); }

  /// The figure that is to be small; not a number of a member that failed.
  double goal(const Member& member) const { return sign_ * member.figure(figure()); }
  double shown(double goal) const { return sign_ * goal; }
  /// What is left to a limit: negative where it is passed.
  double margin(const Member& member, std::size_t bound) const {
    const FigureBound& one = study_.subject_to[bound];
    const double value = member.figure(one.figure.value);
    return one.at_most ? limits_[bound] - value : value - limits_[bound];
  }
  /// The largest excess over a limit, in shares of it; not finite of a member that failed.
  double excess(const Member& member) const {
    if (!std::isfinite(goal(member))) return std::numeric_limits<double>::infinity();
    double most = 0;
    for (std::size_t b = 0; b < limits_.size(); ++b) {
      const double margin_left = margin(member, b);
      if (!std::isfinite(margin_left)) return std::numeric_limits<double>::infinity();
      most = std::max(most, -margin_left / size(b));
    }
    return most > rounding ? most : 0;
  }
  /// By what a bound's margins are counted.
  double size(std::size_t bound) const { return sizes_[bound]; }
  /// Is one member better than another: within its bounds, or nearer to them, then by its figure?
  bool is_better(const Member& one, const Member& other) const {
    const double a = excess(one), b = excess(other);
    if (a != b) return a < b;
    return goal(one) < goal(other);
  }

  BoundOfSearch state(const Member& member, std::size_t bound) const {
    const FigureBound& one = study_.subject_to[bound];
    const double left = margin(member, bound) / size(bound);
    return {.figure = one.figure.value,
            .limit = limits_[bound],
            .value = member.figure(one.figure.value),
            .is_least = one.at_least.has_value(),
            .is_active = std::abs(left) < near_limit,
            .is_exceeded = !(left >= -rounding)};
  }

  Eigen::VectorXd shares_of(const Eigen::VectorXd& values) const {
    return (values - lowest_).cwiseQuotient(range_);
  }
  Eigen::VectorXd values_of(const Eigen::VectorXd& shares) const {
    return lowest_ + shares.cwiseMax(0).cwiseMin(1).cwiseProduct(range_);
  }

 private:
  const StudyFile& study_;
  double sign_;
  std::vector<double> limits_, sizes_;
  Eigen::VectorXd lowest_, range_;
};

/// Members as a search asks for them: each set of values is computed once.
class Trials {
 public:
  Trials(const Problem& problem, const EvaluateMember& evaluate, SearchResults& results,
         int most_members)
      : problem_(problem), evaluate_(evaluate), results_(results), most_(most_members) {}

  int left() const { return most_ - static_cast<int>(results_.members.size()); }

  const Member& at(const OT::Point& point) {
    const int number = number_at(point);
    visited_.push_back(number);
    return results_.members[number];
  }

  /// Those that were asked for since the last call of this.
  std::vector<int> take_visited() { return std::exchange(visited_, {}); }

 private:
  int number_at(const OT::Point& point) {
    Eigen::VectorXd shares(problem_.variables());
    for (Eigen::Index v = 0; v < shares.size(); ++v)
      shares[v] = point[static_cast<OT::UnsignedInteger>(v)];
    const Eigen::VectorXd values = problem_.values_of(shares);
    const auto number = static_cast<int>(results_.members.size());
    for (int m = 0; m < number; ++m)
      if (results_.design.row(m).transpose() == values) return m;
    results_.members.push_back(evaluate_(values, number));
    results_.design.conservativeResize(number + 1, Eigen::NoChange);
    results_.design.row(number) = values.transpose();
    return number;
  }

  const Problem& problem_;
  const EvaluateMember& evaluate_;
  SearchResults& results_;
  int most_;
  std::vector<int> visited_;
};

/// The goal in shares of what it spreads over the sample; a member that failed is as bad as can be.
struct GoalScale {
  double lowest = 0, range = 1;

  GoalScale(const Problem& problem, const std::vector<Member>& members) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Member& member : members) {
      const double goal = problem.goal(member);
      if (!std::isfinite(goal)) continue;
      low = std::min(low, goal);
      high = std::max(high, goal);
    }
    if (!(low <= high)) return;
    lowest = low;
    range = high > low ? high - low : std::max(1.0, std::abs(low));
  }
  double of(double goal) const { return std::isfinite(goal) ? (goal - lowest) / range : 10; }
};

/// Goal and margins as OpenTURNS asks for them, of shares of the variables' ranges.
class Functions {
 public:
  Functions(const Problem& problem, const GoalScale& scale, Trials& trials)
      : problem_(problem), scale_(scale), trials_(trials) {}

  OT::Point goal(const OT::Point& point) const {
    return {scale_.of(problem_.goal(trials_.at(point)))};
  }
  OT::Point margins(const OT::Point& point) const {
    const Member& member = trials_.at(point);
    OT::Point margins(static_cast<OT::UnsignedInteger>(problem_.bounds()));
    for (std::size_t b = 0; b < problem_.bounds(); ++b) {
      const double margin = problem_.margin(member, b) / problem_.size(b);
      margins[static_cast<OT::UnsignedInteger>(b)] =
          std::isfinite(margin) ? margin - aimed_within : -1;
    }
    return margins;
  }

 private:
  const Problem& problem_;
  const GoalScale& scale_;
  Trials& trials_;
};

/// Goes on from some values until the steps are small. @returns whether they became so.
bool descend(const Problem& problem, const GoalScale& scale, Trials& trials,
             const Eigen::VectorXd& from, int most) {
  OT::Log::Show(OT::Log::NONE);  // it warns where members run out, which is said here
  const Functions functions(problem, scale, trials);
  const auto count = static_cast<OT::UnsignedInteger>(problem.variables());
  OT::OptimizationProblem task(OT::Function(
      OT::bindMethod<Functions, OT::Point, OT::Point>(functions, &Functions::goal, count, 1)));
  if (problem.bounds() > 0)
    task.setInequalityConstraint(OT::Function(OT::bindMethod<Functions, OT::Point, OT::Point>(
        functions, &Functions::margins, count,
        static_cast<OT::UnsignedInteger>(problem.bounds()))));
  task.setBounds(OT::Interval(count));
  OT::Cobyla algorithm(task, first_step);
  algorithm.setIgnoreFailure(true);
  algorithm.setMaximumAbsoluteError(last_step);
  algorithm.setMaximumEvaluationNumber(static_cast<OT::UnsignedInteger>(most));
  OT::Point start(count);
  const Eigen::VectorXd shares = problem.shares_of(from);
  for (OT::UnsignedInteger v = 0; v < count; ++v) start[v] = shares[v];
  algorithm.setStartingPoint(start);
  algorithm.run();
  return algorithm.getResult().getEvaluationNumber() < static_cast<OT::UnsignedInteger>(most);
}

int best_of(const Problem& problem, const std::vector<Member>& members,
            const std::vector<int>& among) {
  int best = -1;
  for (const int m : among)
    if (best < 0 || problem.is_better(members[m], members[best])) best = m;
  return best;
}

std::vector<int> numbers(int from, int to) {
  std::vector<int> all;
  for (int m = from; m < to; ++m) all.push_back(m);
  return all;
}

void describe_best(const Problem& problem, const StudyFile& study, SearchResults& results) {
  const Member& best = results.members[results.best];
  results.is_feasible = problem.excess(best) == 0;
  results.value = problem.shown(problem.goal(best));
  for (std::size_t b = 0; b < study.subject_to.size(); ++b)
    results.bounds.push_back(problem.state(best, b));
  const Eigen::VectorXd shares = problem.shares_of(results.design.row(results.best));
  for (const double share : shares)
    results.at_edge.push_back(share < last_step ? -1 : share > 1 - last_step ? 1 : 0);
}

}  // namespace

SearchResults search_members(const StudyFile& study, const Eigen::MatrixXd& sample,
                             std::vector<Member> members, const EvaluateMember& evaluate) {
  const Problem problem(study, members, static_cast<int>(members.size()));
  SearchResults results;
  results.figure = problem.figure();
  results.is_largest = problem.is_largest();
  results.design = sample;
  results.members = std::move(members);
  results.first_sample = static_cast<int>(results.members.size());
  const GoalScale scale(problem, results.members);
  Trials trials(problem, evaluate, results, study.members.value());
  const auto count = [&] { return static_cast<int>(results.members.size()); };

  const int start = best_of(problem, results.members, numbers(0, count()));
  // Members that are left when the steps are small serve a second search.
  results.is_converged = descend(problem, scale, trials, results.design.row(start), trials.left());
  results.best = best_of(problem, results.members, numbers(0, count()));

  std::vector<int> far;
  const Eigen::VectorXd found = problem.shares_of(results.design.row(results.best));
  for (int m = 0; m < results.first_sample; ++m)
    if ((problem.shares_of(results.design.row(m)) - found).cwiseAbs().maxCoeff() > apart)
      far.push_back(m);
  const int least = 4 * (static_cast<int>(problem.variables()) + 1);
  if (!far.empty() && trials.left() >= least) {
    const int second = best_of(problem, results.members, far);
    trials.take_visited();
    descend(problem, scale, trials, results.design.row(second), trials.left());
    // It may pass by members of the sample and of the first search.
    std::vector<int> of_second = trials.take_visited();
    of_second.push_back(second);
    const Member& best = results.members[best_of(problem, results.members, of_second)];
    if (problem.excess(best) == 0) results.elsewhere = problem.shown(problem.goal(best));
    results.best = best_of(problem, results.members, numbers(0, count()));
  }
  describe_best(problem, study, results);
  return results;
}

std::vector<double> best_so_far(const StudyFile& study, const SearchResults& results) {
  const Problem problem(study, results.members, results.first_sample);
  std::vector<double> values;
  int best = 0;
  for (int m = 0; m < static_cast<int>(results.members.size()); ++m) {
    const Member& member = results.members[m];
    if (m > 0 && problem.is_better(member, results.members[best])) best = m;
    const Member& so_far = results.members[best];
    values.push_back(problem.excess(so_far) == 0 ? problem.shown(problem.goal(so_far)) : nan);
  }
  return values;
}

}  // namespace blocklift::pipeline

#include "pipeline/results/doubts/blow_doubts.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {

namespace {

/// A largest tension in motion: N, s.
struct LargestTension {
  double tension = 0, time = 0;
};

LargestTension largest_tension(const dynamics::History& history, int rope) {
  const Eigen::VectorXd& tension = history.ropes[static_cast<std::size_t>(rope)].tension;
  Eigen::Index at = 0;
  const double most = tension.maxCoeff(&at);
  return {most, history.time[at]};
}

/// When a rope went slack that is taut again from an event on; none if it was so from the start.
std::optional<double> slack_since(const std::vector<dynamics::ContactEvent>& events,
                                  std::size_t taut_again) {
  for (std::size_t i = taut_again; i-- > 0;)
    if (events[i].contact == events[taut_again].contact && !events[i].acts) return events[i].time;
  return std::nullopt;
}

/// "25.6 kN", "203252 kN": never with a power of ten.
std::string in_kilonewtons(double force) {
  return force < 1e6 ? fmt::format("{:.4g} kN", force / 1e3)
                     : fmt::format("{:.0f} kN", force / 1e3);
}

std::string rope_name(const LiftRun& lift, int rope) {
  return lift.model.system.ropes()[static_cast<std::size_t>(rope)].name();
}

/// Is it a rope by which the load hangs, and no mooring, warp or tag line?
bool bears_the_load(const LiftRun& lift, int rope) {
  const auto is_tackle = [rope](const LiftHoist& hoist) { return hoist.rope == rope; };
  const auto is_sling = [rope](const LiftRope& one) {
    return one.rope == rope && (one.holds_load() || !one.hoist.empty());
  };
  return std::ranges::any_of(lift.model.hoists, is_tackle) ||
         std::ranges::any_of(lift.model.ropes, is_sling);
}

}  // namespace

std::optional<Blow> find_blow_before_peak(const LiftRun& lift, int rope) {
  constexpr double least_increase = 0.05;
  const auto ropes = static_cast<int>(lift.model.system.ropes().size());
  const auto [most, time] = largest_tension(lift.dynamic_history(), rope);
  if (lift.is_swept() &&
      most <= (1 + least_increase) * largest_tension(lift.static_history, rope).tension)
    return std::nullopt;
  const auto& events = lift.dynamic_result.events;
  for (std::size_t i = events.size(); i-- > 0;) {
    const dynamics::ContactEvent& event = events[i];
    if (event.time > time || !event.acts || event.contact >= ropes) continue;
    if (event.contact != rope && !bears_the_load(lift, event.contact)) continue;
    if (event.time < time - reach_of_blow) return std::nullopt;
    const std::optional<double> from = slack_since(events, i);
    if (from && event.time - *from <= reach_of_blow) return Blow{event.contact, *from, event.time};
  }
  return std::nullopt;
}

std::vector<std::string> list_blow_doubts(const LiftRun& lift) {
  std::vector<std::pair<double, int>> largest;  // N, rope
  const auto add = [&](int rope) {
    // Equalised hoists share one.
    const auto is_it = [rope](const auto& known) { return known.second == rope; };
    if (std::ranges::none_of(largest, is_it) && find_blow_before_peak(lift, rope))
      largest.emplace_back(largest_tension(lift.dynamic_history(), rope).tension, rope);
  };
  for (const LiftRope& rope : lift.model.ropes) add(rope.rope);
  for (const LiftHoist& hoist : lift.model.hoists) add(hoist.rope);
  if (largest.empty()) return {};
  std::stable_sort(largest.begin(), largest.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto [tension, rope] = largest.front();
  const Blow blow = *find_blow_before_peak(lift, rope);
  std::string others;
  for (std::size_t i = 1; i < largest.size(); ++i)
    others += (others.empty() ? " So do those of " : ", ") + rope_name(lift, largest[i].second);
  if (!others.empty()) others += ".";
  return {fmt::format(
      "The largest load of {}, {} at {:.2f} s, follows a blow within {:g} s: {} was slack "
      "from {:.2f} s to {:.2f} s.{} Such loads depend on the instant: a slightly different run has "
      "others, which may be larger. Judge them by a study over the phase of waves and gusts or the "
      "start of the drives, or keep the ropes taut.",
      rope_name(lift, rope), in_kilonewtons(tension),
      largest_tension(lift.dynamic_history(), rope).time, reach_of_blow, rope_name(lift, blow.rope),
      blow.slack_from, blow.taut_again, others)};
}

}  // namespace blocklift::pipeline

#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace blocklift::pipeline {

/// For each place the number of what was chosen, in a stock whose weakest is 0.
using Choice = std::vector<std::size_t>;

/// What came of choosing and running in turn.
struct Settled {
  Choice choice;
  int runs = 0;
  bool stands = false;  ///< a run with the choice asks for nothing else (or nothing stronger)
  /// Two choices asked for each other; since then no place was given anything weaker.
  bool went_round = false;
};

/// Runs, chooses by the loads of the run, and runs again with the choice until it stands: stiffer
/// slings draw load from softer ones, so that loads depend on the choice. Where a choice comes back
/// that was left before, each place keeps the strongest that it had from there on, which ends.
/// @param first by the run as it is; none of a stock has been chosen before.
/// @param next what a run with a choice asks for.
Settled settle(const std::function<Choice()>& first,
               const std::function<Choice(const Choice&)>& next, int most_runs);

}  // namespace blocklift::pipeline

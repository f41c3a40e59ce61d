#include "pipeline/rigging/settling.h"

#include <algorithm>
#include <set>
#include <utility>

namespace blocklift::pipeline {
namespace {

Choice stronger_of(const Choice& one, const Choice& other) {
  Choice both(one.size());
  std::transform(one.begin(), one.end(), other.begin(), both.begin(),
                 [](std::size_t a, std::size_t b) { return std::max(a, b); });
  return both;
}

}  // namespace

Settled settle(const std::function<Choice()>& first,
               const std::function<Choice(const Choice&)>& next, int most_runs) {
  Settled settled;
  settled.choice = first();
  settled.runs = 1;
  std::set<Choice> left;
  while (settled.runs < most_runs) {
    Choice asked = next(settled.choice);
    ++settled.runs;
    if (settled.went_round) asked = stronger_of(asked, settled.choice);
    if (asked == settled.choice) {
      settled.stands = true;
      return settled;
    }
    left.insert(settled.choice);
    if (!settled.went_round && left.count(asked) > 0) {
      settled.went_round = true;
      asked = stronger_of(asked, settled.choice);
    }
    settled.choice = std::move(asked);
  }
  return settled;
}

}  // namespace blocklift::pipeline

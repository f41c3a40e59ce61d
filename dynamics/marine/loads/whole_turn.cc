#include "dynamics/marine/loads/whole_turn.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double largest_gap = std::numbers::pi / 4.0;  // between headings, rad

}  // namespace

std::vector<double> headings_of_whole_turn(const std::string& who, std::vector<double> headings) {
  if (headings.empty()) throw ModelError(who + ": the database has no headings of waves");
  const double whole = headings.front() + turn;
  // Some databases have 0 and 360 degrees.
  if (headings.size() > 1 && std::abs(headings.back() - whole) < 1e-9) headings.pop_back();
  headings.push_back(whole);
  for (std::size_t i = 1; i < headings.size(); ++i) {
    const double gap = headings[i] - headings[i - 1];
    if (gap > 0.0 && gap <= largest_gap + 1e-9) continue;
    std::ostringstream text;
    text << who
         << ": the database's headings must ascend through a whole turn, at most 45 degrees apart, "
            "for a vessel that may turn in the waves; "
         << headings[i - 1] / turn * 360.0 << " and " << headings[i] / turn * 360.0
         << " degrees follow each other";
    throw ModelError(text.str());
  }
  return headings;
}

PlaceInTurn find_place(const std::vector<double>& headings, double angle) {
  const double wrapped = angle - turn * std::floor((angle - headings.front()) / turn);
  const auto next = std::upper_bound(headings.begin() + 1, headings.end() - 1, wrapped);
  const auto j = static_cast<std::size_t>(next - headings.begin());
  return {j, (wrapped - headings[j - 1]) / (headings[j] - headings[j - 1])};
}

PlaceInRange find_frequency(const std::vector<double>& frequencies, double frequency) {
  const auto above = std::lower_bound(frequencies.begin(), frequencies.end(), frequency);
  const auto upper = std::min<std::size_t>(static_cast<std::size_t>(above - frequencies.begin()),
                                           frequencies.size() - 1);
  if (upper == 0 || frequencies[upper] == frequency) return {upper, 1.0};
  const double lower = frequencies[upper - 1];
  return {upper, std::clamp((frequency - lower) / (frequencies[upper] - lower), 0.0, 1.0)};
}

void require_frequency(const std::vector<double>& frequencies, double frequency) {
  if (frequency >= frequencies.front() * (1.0 - 1e-9) &&
      frequency <= frequencies.back() * (1.0 + 1e-9)) {
    return;
  }
  std::ostringstream text;
  text << "the sea has a wave of " << frequency << " rad/s, and the database holds "
       << frequencies.front() << " to " << frequencies.back()
       << " rad/s; compute it for more frequencies or cut the spectrum";
  throw ModelError(text.str());
}

}  // namespace blocklift::dynamics

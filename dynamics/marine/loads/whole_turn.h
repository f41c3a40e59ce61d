#pragma once

#include <string>
#include <vector>

namespace blocklift::dynamics {

/// The headings of a database (rad), its first repeated after a turn, for a vessel that may turn in
/// the waves.
/// @throws ModelError, beginning with `who`, if there are none, or unless they ascend through a
///   whole turn at most 45 degrees apart.
std::vector<double> headings_of_whole_turn(const std::string& who, std::vector<double> headings);

/// Between which of such headings an angle (rad) lies.
struct PlaceInTurn {
  std::size_t after = 1;  ///< the one behind it
  double share = 0.0;     ///< of that one
};
PlaceInTurn find_place(const std::vector<double>& headings, double angle);

/// Between which of ascending frequencies one lies; the nearest beyond them.
struct PlaceInRange {
  std::size_t upper = 0;
  double share = 1.0;  ///< of the upper; the rest of the one before
};
PlaceInRange find_frequency(const std::vector<double>& frequencies, double frequency);

/// @throws ModelError unless the frequency of a wave (rad/s) is among those of a database.
void require_frequency(const std::vector<double>& frequencies, double frequency);

}  // namespace blocklift::dynamics

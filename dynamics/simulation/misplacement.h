#pragma once

#include <limits>
#include <string>
#include <vector>

#include "dynamics/marine/loads/draught_shares.h"
#include "dynamics/simulation/history.h"

namespace blocklift::dynamics {

/// A body whose water was computed for one place among others.
struct ArrangedBody {
  std::string name;
  BodyFrame frame;                                       ///< H of RadiatedWater
  Eigen::Vector2d place = Eigen::Vector2d::Zero();       ///< of H's origin among the others', m
  double length = not_a_number, breadth = not_a_number;  ///< of its hull, m
};

/// The arrangement that the water of several bodies was computed for. Seen from above all frames H
/// have one and the same direction in it.
struct Arrangement {
  std::vector<ArrangedBody> bodies;
  int lowered_body = -1;  ///< that counts in the water alone; -1: none
  DraughtMark mark = {};  ///< where its draught is read
  /// Of the sea, by the mean of its components' wave numbers, weighted with their energy; m.
  double wave_length = std::numeric_limits<double>::infinity();
};

/// The largest of something over the samples.
struct LargestInTime {
  double value = 0.0;
  double time = not_a_number;  ///< s

  void take(double another, double when);
};

/// How far two bodies came from the places against each other that their water was computed for,
/// while both were in the water.
struct PairMisplacement {
  int first = -1, second = -1;  ///< in the arrangement
  long samples = 0;             ///< with both in the water; 0: they never met there
  long samples_beyond = 0;      ///< of them, with `at_ends` above `limit`
  /// Change of the level vector from one frame to the other, in axes that turn with the mean of
  /// both, m.
  LargestInTime distance;
  LargestInTime turn;           ///< of one heading against the other, rad
  LargestInTime at_ends;        ///< distance, and turn times half the longer hull's length, m
  double limit = not_a_number;  ///< misplacement_limit(), m

  bool is_beyond() const { return at_ends.value > limit; }
};

/// How far the arrangement was kept.
struct Misplacement {
  std::vector<PairMisplacement> pairs;
  /// Mean turn of all that are in the water against where the water was computed, rad: their
  /// excitation follows it.
  LargestInTime group_turn;
};

/// By how much (m) two hulls may be out of place: the lesser of
///  - a fifth of the narrower hull's breadth, since the flow about one body at another changes over
///    the lesser one's breadth;
///  - a fortieth of the sea's waves' length: what one makes comes to the other 2 pi/40 out of
///    phase, wrong by 2 sin(pi/40) = 16 % of itself.
/// Two barges of 60 x 20 m, 17 m apart, moved by 2 m against each other: in waves of 125 m and more
/// (a sixtieth) added mass, damping and excitation change by 3 to 6 % of a barge's own; in waves of
/// 60 to 100 m (a thirtieth to a fiftieth), where the water between them swings to and fro, by up
/// to 40 %.
double misplacement_limit(const ArrangedBody& a, const ArrangedBody& b, double wave_length);

/// Measures it at the samples of a history.
Misplacement find_misplacement(const Arrangement& arrangement, const History& history);

}  // namespace blocklift::dynamics

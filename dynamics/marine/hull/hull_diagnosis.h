#pragma once

#include <optional>

#include "dynamics/marine/hull/hull.h"

namespace blocklift::dynamics {

/// What can be wrong with a hull.
enum class HullDefectKind {
  not_finite,        ///< a vertex is NaN or infinite
  no_panels,         ///< there is no surface at all
  degenerate_panel,  ///< a panel without area, or with two equal vertices
  warped_panel,      ///< a panel that is far from flat
  open_edge,         ///< an edge that only one panel has: the surface is not closed
  doubled_panel,     ///< two panels on the same vertices
  crowded_edge,      ///< an edge of more than two panels
  twisted_edge,      ///< two neighbours run along their edge in the same sense: one is turned round
  inward,            ///< the normals point into the body
  above_water,       ///< nothing of the hull is in the water
  below_water,       ///< nothing of the hull is above the water although it should float
  large_panel,       ///< a panel too large for the shortest wave
};

/// A defect with its place.
struct HullDefect {
  HullDefectKind kind;
  int panel = -1;                                   ///< counted from 0; -1: the hull as a whole
  Vector3 place = Vector3::Constant(not_a_number);  ///< of the vertex or edge in B, m
  std::string message;                              ///< what was found, where, and what to do
};

/// What a hull is held against.
struct HullDemands {
  /// Distance of the vertices of a panel from its mean plane, over its diameter, at most.
  double largest_warp = 0.1;
  /// Height of the calm water in the hull's frame (upright), m; none: not looked at.
  std::optional<double> water_level = {};
  /// Length of the shortest wave, m, and how many panels it needs; none: not looked at. Panels
  /// above the water level, where one is given, may be of any size.
  std::optional<double> shortest_wave_length = {};
  double panels_per_wave_length = 8.0;
  /// Defects of one kind that are told one by one; the last of them says how many more there are.
  int most_of_a_kind = 5;
};

/// Everything that is wrong with a hull, most basic first; empty: it can be used. Later checks that
/// an earlier defect makes meaningless (orientation of an open hull) are left out.
std::vector<HullDefect> diagnose(const Hull& hull, const HullDemands& demands = {});

/// @throws ModelError with all messages, a line each, if the hull has a defect.
void require_sound(const Hull& hull, const HullDemands& demands = {});

}  // namespace blocklift::dynamics

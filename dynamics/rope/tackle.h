#pragma once

namespace blocklift::dynamics {

/// A rope reeved to and fro between two blocks, and led on to a drum.
///
/// Each sheave that turns takes its part of the tension, so that the falls do not share alike. With
/// n falls, m sheaves from the first fall to the drum and eta the efficiency of a sheave (the
/// tension that leaves it over the one that enters it, while it turns), the falls carry
///   f_i = W (1 - eta) / (1 - eta^n) eta^(i - 1),   i = 1 at the drum's side ... n at the dead end,
/// of the load W while it is hoisted, the lead line f_1 / eta^m; while it is lowered 1 / eta takes
/// the place of eta. Without friction each carries W/n. Source: API RP 9B (2015), 2.3.3, whose fast
/// line factor is the lead line's share with eta = 1/K and m the sheaves beyond those between the
/// falls.
struct Tackle {
  int falls = 1;                 ///< n, one at least
  int lead_sheaves = 1;          ///< m, that by which the rope leaves the tackle included
  double sheave_efficiency = 1;  ///< eta, above 0, 1 at most
};

/// Which way the rope runs, or ran last: friction stays as it was when the sheaves come to a stand.
enum class TackleMotion { hoisting, lowering };

/// Tensions of the rope over the load on the tackle.
struct TackleShares {
  double lead_line = 0;  ///< at the drum
  double largest = 0;    ///< anywhere: the lead line, or the fall at the dead end
};

/// @throws ModelError if a number is not what its comment says.
TackleShares calc_shares(const Tackle& tackle, TackleMotion motion);

/// What an even share, W/n, is of the lead line's pull while the load is hoisted.
double calc_efficiency(const Tackle& tackle);

}  // namespace blocklift::dynamics

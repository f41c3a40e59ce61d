#pragma once

#include <string>

#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// The slings that begin at one hook, which bear its load together as the legs of one sling.
struct SharedHook {
  int legs = 1;      ///< slings that begin there
  double load = 0;   ///< largest below its hook block of the equilibria, N; 0: a sling on no hook
  double angle = 0;  ///< of the leg that leans most then, to the plumb, rad

  /// The legs that count by EN 13414-1 (table 4), EN 818-4 and EN 1492, over the working load of
  /// one: up to 45 degrees to the plumb 1.4 of two and 2.1 of three or more, beyond it 1 and 1.5.
  double leg_factor() const;
};

/// Largest angle of a leg to the plumb by these standards: 60 degrees, in rad.
double largest_leg_angle();

/// Is a rule of a stock one of these standards', by its name?
bool counts_legs(const std::string& rule);

/// What a sling is held to at rest where no standard shares the load, N: its own tension, and, with
/// three legs or more, of which lengths decide which bear, or two by a rule that counts legs, at
/// least the load of the hook over the factor of its legs.
double demand_with_legs(double at_rest, const SharedHook& hook, const std::string& rule);

/// What the name of a check says of that: "4 legs as 2.1"; empty where the sling's own
/// tension is more.
std::string legs_note(double at_rest, const SharedHook& hook, const std::string& rule);

/// The hook that a rope begins at; one leg without a load where it begins elsewhere.
SharedHook find_shared_hook(const LiftCase& lift_case, const LiftRun& lift,
                            const std::string& rope);

}  // namespace blocklift::pipeline

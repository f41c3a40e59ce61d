#pragma once

#include <cstddef>

#include "dynamics/simulation/lift_system.h"

namespace blocklift::dynamics {

/// Rates of the energies that an integration accumulates, W.
struct EnergyRates {
  double drive_power = 0.0;  ///< of the driven joints on the mechanism
  double winch_power = 0.0;  ///< of the winches on their ropes
  /// Of everything else from outside: wind, radiated water, and all of the pressure on hulls in
  /// waves.
  double outside_power = 0.0;
  double dissipated_power = 0.0;  ///< in ropes, springs, joints and supports
};

/// Energies stored at one instant, J.
struct StoredEnergy {
  double kinetic = 0.0;  ///< of the bodies and of the water that moves with floating ones
  double gravity = 0.0;  ///< potential; zero with all centres of mass at the height z = 0
  double elastic = 0.0;  ///< ropes, springs, supports and buoyancy
  /// What hulls in waves have in `elastic`, as if the water were still. The whole of their power
  /// counts as from outside; the work of the waves is what it comes to beyond the loss of this.
  double buoyancy_in_waves = 0.0;
  double sum() const { return kinetic + gravity + elastic; }
};

/// Energies and powers of a rope whose load is in the workspace. A damped rope that contracts fast
/// enough is slack while it is still stretched; what it had stored is then lost at once, but for
/// one at an elastic body, which springs back with it first.
EnergyAccount calc_rope_energy(const LiftSystem& system, std::size_t rope, const LiftWorkspace& w);

/// The same of a tugger line.
EnergyAccount calc_tugger_energy(const LiftSystem& system, std::size_t line,
                                 const LiftWorkspace& w);

/// Powers at the instant that calc_right_hand_side has just evaluated.
EnergyRates calc_energy_rates(const LiftSystem& system, double t, const LiftWorkspace& w);
/// Stored energies at that instant.
StoredEnergy calc_stored_energy(const LiftSystem& system, double t, const LiftWorkspace& w);

/// Powers at (t, y), for less than calc_right_hand_side costs: accelerations are found only where a
/// driven joint moves, as nothing else asks for them. Leaves the loads of contacts in the
/// workspace. Does not allocate. `hulls`: kept takes the hulls' forces of the workspace, which are
/// those of the same time and a state near by.
EnergyRates calc_energy_rates(const LiftSystem& system, double t, ConstVectorRef y,
                              const Contacts* contacts, HullForces hulls, LiftWorkspace& w);

}  // namespace blocklift::dynamics

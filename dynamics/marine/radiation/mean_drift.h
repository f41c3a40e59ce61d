#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// Mean forces of second order in regular waves of unit amplitude, from the momentum of the waves
/// far away. With H the far field of all that one body scatters and radiates (FarField), theta the
/// heading of the waves, c and c_g their phase and group velocity and P the power that is taken
/// out of the motion otherwise than by waves (W/m2),
///
///   F_x = rho g c_g/(2 c) int |H|^2 (cos theta - cos t) dt + cos theta P/c,  F_y with sine,
///   M_z = - rho g c_g/(2 w) (int i H* H' dt + 2 sqrt(2 pi/k) Re(i H'(theta) exp(-i pi/4))),
///
/// the latter about the vertical axis through the origin. The first is Maruo's (1960), with P for
/// the waves' energy that is not sent out again; the second Newman's (1967), J. Ship Research 11.
/// A wall of which waves come back whole is pressed by rho g a^2/2 per width in deep water.
///
/// The panels' error leaves the waves that are sent out, and P, without the energy that the
/// incident ones lose. Unless there are lids, whose power is not known, H and the motions are
/// therefore multiplied by the complex number nearest to 1 that gives it back (calc_energy_factor),
/// and P by the square of its size: short waves are sent out too weak, and the force would miss
/// twice as much of itself; next to a resonance pressure tells less damping than the waves that are
/// sent out, and the body moves too much for these.
///
/// @param motions of each frequency, 6 x headings, m/m and rad/m (calc_response_amplitudes); empty:
///   the body is held.
/// @param damping 6 x 6, of the motion otherwise than by waves; empty: none.
/// @param has_lids waves fade on lids, too.
/// @returns for each frequency 6 x headings: surge and sway (N/m2) and yaw about the reference
///   point (N m/m2) along the axes of the database; heave, roll and pitch are zero, being unknown.
/// @throws ModelError if the database has no far field, holds several bodies (their drift is known
///   together only), or the sizes do not fit.
std::vector<Eigen::MatrixXd> calc_mean_drift(const HydrodynamicDatabase& database,
                                             const std::vector<Eigen::MatrixXcd>& motions,
                                             const Eigen::MatrixXd& damping = {},
                                             bool has_lids = false);

/// Changes whenever calc_mean_drift gives other figures for the same far field.
inline constexpr int mean_drift_version = 3;

/// The z nearest to 1 of those that make energy of the waves z H and of z times the motions
/// balance,
///
///   |z|^2 gone = Re(z shadow),
///
/// a circle in the complex plane; 1 where there are no waves. Where nearly all that a wave brings
/// is thrown back, z makes up for waves that are too weak. A body that hardly disturbs the waves
/// has a shadow whose real part is a small rest; z then turns the phase, and |z| stays 1. Of a body
/// that only radiates, z is what its motion loses if damping is what the waves sent out say. What
/// own damping takes must not stay as it is: where it is as large as what is sent out, as at a
/// resonance that takes most out of the waves, no factor on H alone would balance, or a large one
/// would.
/// @param gone int |H|^2 dt and P over rho g c_g/2: what is sent out, and taken out otherwise.
/// @param shadow - 2 sqrt(2 pi/k) H(theta) exp(-i pi/4).
std::complex<double> calc_energy_factor(double gone, std::complex<double> shadow);

/// Power that waves of unit amplitude lose at the body beside what is sent out again (W/m2), by the
/// far field alone, as the panels gave it, for each frequency and heading: that of the damping if
/// the far field is exact.
///   - rho g c_g/2 (int |H|^2 dt + 2 sqrt(2 pi/k) Re(H(theta) exp(-i pi/4)))
/// @throws ModelError as calc_mean_drift does.
std::vector<Eigen::VectorXd> calc_absorbed_power(const HydrodynamicDatabase& database,
                                                 const std::vector<Eigen::MatrixXcd>& motions);

}  // namespace blocklift::dynamics

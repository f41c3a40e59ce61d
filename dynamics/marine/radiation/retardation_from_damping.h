#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// K(t) = (2/pi) int B(w) cos(w t) dw at 0, dt, 2 dt ..., exact for B linear between frequencies
/// and nothing outside them.
/// @param frequencies rad/s, ascending; the first may be 0. @param damping B, one for each.
/// @param time_step dt, s. @param count how many samples.
std::vector<Eigen::MatrixXd> integrate_damping(const std::vector<double>& frequencies,
                                               const std::vector<Eigen::MatrixXd>& damping,
                                               double time_step, std::size_t count);

/// A(w) - A_inf = (2/pi) PV int B(v)/(v^2 - w^2) dv of the same B (Kramers and Kronig; Kotik and
/// Mangulis 1962). B is best nothing at both ends: where it ends at once, A is infinite.
/// @param at frequencies of A, rad/s, positive.
std::vector<Eigen::MatrixXd> integrate_added_mass(const std::vector<double>& frequencies,
                                                  const std::vector<Eigen::MatrixXd>& damping,
                                                  const std::vector<double>& at);

/// Retardation functions of a database that has A(w) and B(w) alone, as frequency-domain programs
/// give them (Ogilvie 1964): integrate_damping of B linear between the frequencies, from B = 0 at
/// w = 0; nothing is assumed beyond the highest frequency, so that what is radiated there is lost.
/// Samples are 0.25 rad of the highest frequency apart and last for half the period of the widest
/// gap between frequencies (behind that the integral repeats itself).
/// @throws ModelError if there are fewer than three frequencies.
void add_retardation(HydrodynamicDatabase& database);

/// A_inf = A(w) + (1/w) int K(t) sin(w t) dt, the mean over all frequencies: for databases without
/// it. Retardation functions must be there.
void add_infinite_added_mass(HydrodynamicDatabase& database);

/// What waves' shares of added mass and damping are measured by, a figure for each entry: the root
/// of the product of two modes' peaks of |A - A_inf + B/(i w)|, each taken as at least a twentieth
/// of the mode's A_inf or a thousandth of the largest peak of its kind, displacements or
/// rotations.
/// @param shares A - A_inf + B/(i w) at all frequencies. @param infinite_added_mass A_inf.
Eigen::MatrixXd calc_wave_scales(const std::vector<Eigen::MatrixXcd>& shares,
                                 const Eigen::MatrixXd& infinite_added_mass);

/// Largest difference of what the retardation functions say (calc_added_mass_and_damping) from
/// added mass and damping themselves, as a share of calc_wave_scales: over all entries and those of
/// the frequencies (rad/s) at which `forces`, B + i w A, are known.
double calc_memory_error(const HydrodynamicDatabase& database,
                         const std::vector<double>& frequencies,
                         const std::vector<Eigen::MatrixXcd>& forces);
/// The same at the database's own frequencies.
double calc_memory_error(const HydrodynamicDatabase& database);

}  // namespace blocklift::dynamics

#pragma once

#include <vector>

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// Mean force of second order along the water that DiffractionForce has by itself where a body
/// moves with the waves, per square of their amplitude: what it would count twice beside the mean
/// drift forces of the database, which are whole (calc_mean_drift).
///
/// The force X, the incident wave's share in it, acts where the body's reference point R is, along
/// axes that turn with its heading, and is that of the heading of the waves against it. With xi the
/// motion of the body, y of R along the waves' way, psi the yaw, and theta the waves' heading,
///
///   F = Re{R_z(psi) X(theta - psi) exp(i (w t - k y))},
///   mean F = Im(X conj(k y))/2 + Re((z x X - dX/dtheta) conj(psi))/2.
///
/// The first part is k/w times the mean power of X along the waves' way; a round body has nothing
/// of the second. Between headings X is linear, so that dX/dtheta is the mean of its slopes on
/// either side. Of the moment of yaw nothing is told: the radiated waves' force has a share in it.
///
/// Several bodies have each their own, by their coupled motions.
///
/// @param motions of each frequency, 6N x headings, m/m and rad/m (calc_response_amplitudes).
/// @returns for each frequency 6N x headings, along the axes of the database: surge and sway
///   (N/m2), all others zero.
/// @throws ModelError if the motions are not of the database's size, or its headings do not go
///   round a whole turn at most 45 degrees apart.
std::vector<Eigen::MatrixXd> calc_excitation_drift(const HydrodynamicDatabase& database,
                                                   const std::vector<Eigen::MatrixXcd>& motions);

}  // namespace blocklift::dynamics

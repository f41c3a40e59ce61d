#pragma once

#include "dynamics/marine/hull/hydrostatics.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// Motion of freely floating bodies in regular waves of unit amplitude, all coupled:
///
///   (-w^2 (m + A(w)) + i w B(w) + C) xi = X(w, theta),   motion Re xi a exp(i w t).
///
/// Damping is that of the radiated waves; viscous damping, which governs roll at resonance, joins
/// it by `damping`, 6N x 6N (kg/s, kg m/s, kg m2/s; empty: none). `mass` is m, 6N x 6N about the
/// reference points (kg, kg m, kg m2).
/// @returns for each frequency a matrix 6N x headings, m/m and rad/m.
/// @throws ModelError if mass or damping have another size than the database, or that lacks its
/// hydrostatic stiffness.
std::vector<Eigen::MatrixXcd> calc_response_amplitudes(const HydrodynamicDatabase& database,
                                                       const Eigen::MatrixXd& mass,
                                                       const Eigen::MatrixXd& damping = {});

/// Natural period (s) of one mode by itself, the others held: w^2 (m_ii + A_ii(w)) = C_ii with A
/// interpolated between the frequencies of the database; NaN if nothing brings the motion back.
double calc_natural_period(const HydrodynamicDatabase& database, const Eigen::MatrixXd& mass,
                           Eigen::Index mode);

/// Mass matrix (displacements, rotations) of a rigid body about its centre of mass, its axes turned
/// by R_WB; `radii` of gyration about them, m.
Eigen::Matrix<double, 6, 6> make_mass_matrix(double mass, const Vector3& radii,
                                             const Matrix3& R_WB);

/// Hydrostatic stiffness C over rho g (displacements, rotations) of a body about its centre of
/// mass, p_BoBcm_W from Bo, of which the weight has no moment: force -rho g C xi. From
/// calc_stiffness_over_rho_g, moments moved from Bo to the centre of mass, which moves itself.
Eigen::Matrix<double, 6, 6> calc_floating_stiffness_over_rho_g(const Hydrostatics& hydrostatics,
                                                               const Vector3& p_BoBcm_W);

}  // namespace blocklift::dynamics

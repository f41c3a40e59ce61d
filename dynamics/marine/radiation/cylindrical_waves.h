#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// What bodies make of cylindrical waves about the origin, at one frequency. Harmonics run from
/// -order to order; amplitudes are those of the surface's elevation (m).
struct CylindricalWaves {
  int order = 0;
  Eigen::MatrixXcd radiated;     ///< c of unit motion: harmonics x modes; m/m, m/rad
  Eigen::MatrixXcd scattered;    ///< c of unit d: harmonics x harmonics
  Eigen::MatrixXcd force;        ///< on the modes of unit d: modes x harmonics; N/m, N
  Eigen::MatrixXcd undisturbed;  ///< Froude-Krylov share of it
};

/// From far field and excitation of a database at a frequency (index). Its headings must be the
/// directions of its far field.
///
/// With H(phi) = sum of a_m exp(i m phi) the waves far away are those of c_m = a_m sqrt(pi k/2)
/// exp(-i pi/4) i^-m; a plane wave that goes in the direction theta has d_n = i^-n exp(-i n theta).
CylindricalWaves find_cylindrical_waves(const HydrodynamicDatabase& database, std::size_t frequency,
                                        int order);

/// Amplitudes d of a plane wave of unit amplitude that goes in a direction (rad).
Eigen::VectorXcd plane_wave(int order, double direction);

/// T: what waves from a place (columns, c) are at another (rows, d), that lies at `offset` (m).
Eigen::MatrixXcd carry_waves(const Eigen::Vector2d& offset, double wave_number, int rows_order,
                             int columns_order);

/// The harmonics that matter to bodies within `radius` (m) of the origin.
int harmonic_order(double radius, double wave_number);

}  // namespace blocklift::dynamics

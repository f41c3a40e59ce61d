#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/rigid_body.h"
#include "structure/space/space.h"
#include "structure/system/linear_solver.h"

namespace blocklift::structure {

/// Undamped free vibration: K phi = omega^2 M phi.
struct NaturalModes {
  /// Eigenvalues omega^2, ascending, rad^2/s^2. Those of rigid motions are zero but for rounding
  /// (of either sign).
  Eigen::VectorXd squared_frequencies;
  /// omega / 2 pi, Hz; zero for rigid motions.
  Eigen::VectorXd frequencies;
  /// Rigid motions that the held unknowns leave to each connected body, all together: the first
  /// modes.
  int rigid_motions = 0;
  /// One column a mode, a row an unknown (m/sqrt(kg)): phi_i' M phi_j = 1 if i = j, else 0. The
  /// component of largest magnitude is positive.
  Eigen::MatrixXd shapes;
  /// |K phi - omega^2 M phi| over |K phi| + (omega^2 + shift) |M phi|, the largest of all modes;
  /// held
  /// unknowns are left out.
  double residual = 0;
};

/// The lowest natural modes of a body that is free, partly or wholly supported.
///
/// SLEPc's Krylov-Schur method on (K + s M)^-1 M, whose matrix is factorised once; s > 0 is a small
/// part of the first elastic omega^2 (of its estimate by bending and stretching shapes), so that a
/// free body's singular stiffness does no harm. Rigid motions of the whole are known beforehand;
/// the search is repeated beside the modes that it found until nothing lower comes, as one run may
/// miss copies of a repeated frequency. Source: Hernandez, Roman, Vidal (2005), SLEPc; Ericsson and
/// Ruhe (1980) for the spectral transform.
/// @param stiffness, mass lower triangles, in an order of elimination; unknowns without mass must
///   have stiffness.
/// @param trial shapes that hold the lowest modes roughly, as trial_shapes() has them, by unknowns
///   (rows): the first six columns are the rigid motions of the whole.
/// @param fixed unknowns that do not move (their values are not looked at).
/// @param rigid_motions how many of them `fixed` leaves.
/// @param count of modes, at least 1.
/// @throws ModelError if there are fewer unknowns than modes, the mass is zero, memory does not
///   suffice, or the iteration does not converge.
NaturalModes find_natural_modes(const SparseLower& stiffness, const SparseLower& mass,
                                const Eigen::MatrixXd& trial,
                                const std::vector<FixedUnknown>& fixed, int rigid_motions,
                                int count);

/// Rigid motions, uniform strains and pure bending and twisting about three planes, 21 columns:
/// what a body does at its lowest frequencies, whatever it looks like. Lengths in units of the
/// body's.
/// @param freedoms a node (rows): three displacements, or six with the rotations.
Eigen::MatrixXd trial_shapes(const Eigen::Matrix3Xd& nodes, int freedoms);

/// Consistent mass matrix of a space's unknowns, lower triangle, kg.
SparseLower mass_of_unknowns(const Space& space, const MassProperties& mass);

/// Modes of shells and beams, by unknowns; of the free structure the first six are rigid.
/// @param fixed unknowns that do not move: none, or enough to leave no rigid motion.
/// @throws ModelError as above.
NaturalModes find_natural_modes(const Space& space, const MassProperties& mass,
                                const std::vector<FixedUnknown>& fixed, int count);

}  // namespace blocklift::structure

#pragma once

#include <Eigen/Core>

#include "structure/response/unit_responses.h"

namespace blocklift::structure {

/// Natural modes of the free block but for its six rigid ones, lowest first.
struct FreeModes {
  Eigen::VectorXd angular_frequencies;  ///< rad/s
  /// One a column, m/sqrt(kg): phi_i^T M phi_j = 1 if i = j, else 0, and M-orthogonal to rigid
  /// motions.
  Eigen::MatrixXd shapes;
};

/// Free modes by a block Krylov method on the relaxed block K^+ M (which reuses the factorisation
/// of the responses), fully orthogonalised, with the mass at the nodes (Gauss-Lobatto rule, exact
/// to the order of the elements). Source: Golub, Van Loan (2013), section 10.3.6; Parlett (1998),
/// chapter 13.
/// @param count at least 1. @param residual largest |K^+ M phi - phi / omega^2| omega^2 in the norm
///   of M: the error of a frequency is about its square, that of a shape itself.
/// @throws ModelError if the block has fewer modes, or they are not found in 60 steps.
FreeModes find_free_modes(const UnitResponses& responses, int count, double residual = 1e-5);

/// How the lugs of a free block move, against the block's mean rigid motion, when forces pull at
/// them. The displacement of a lug is that which its force does work on.
struct LugFlexibility {
  /// Statically, inertia relief included: 3 lugs square, symmetric, m/N.
  Eigen::MatrixXd compliance;
  Eigen::VectorXd angular_frequencies;  ///< of the modes that are taken out, rad/s
  Eigen::MatrixXd shapes;               ///< 3 lugs x modes, 1: phi^T M phi is the block's mass
  /// What the modes leave of the compliance, positive semidefinite; all of it without modes.
  Eigen::MatrixXd residual_compliance;
};

/// Static condensation of the block to its lugs, with a number of free modes (0: none) taken out.
LugFlexibility find_lug_flexibility(const UnitResponses& responses, int modes);

}  // namespace blocklift::structure

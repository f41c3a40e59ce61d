#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/response/envelope.h"
#include "structure/response/squares.h"
#include "structure/response/unit_responses.h"

namespace blocklift::structure {

/// Checked stress of squares of a block for any mass and centre of mass, without its factor.
///
/// Outfitting makes the density linear in place (MassProperties), so that the loads of the twelve
/// unit inertia fields are those of four densities: the steel's own, and that times x, y and z from
/// the steel's centre. The stress that each of these, and of each lug's unit forces, brings to the
/// free block is kept: a thousand blocks of other masses need no further solution.
struct StressBasis {
  std::vector<Square> squares;
  /// Membrane stresses (11, 22, 12 a square) of each unit load, Pa: 3 squares x (3 lugs + 48); of
  /// the inertia first all twelve fields of the steel's density, then those of x, y and z times it;
  /// then loads that were added.
  Eigen::MatrixXd components;

  /// Factors of the unit loads for a load case of a block of some mass, which is in balance.
  /// @throws ModelError if the number of lug forces or added loads is not that of the basis.
  Eigen::VectorXd factors(const LoadCase& load_case, const MassProperties& mass) const;
};

/// Solves for the basis. Each unit load is balanced by an acceleration of the block as the
/// responses have it; in a balanced load case these accelerations cancel.
StressBasis make_stress_basis(const UnitResponses& responses, std::vector<Square> squares,
                              int threads = 0);

/// Adds loads to a basis of the responses' block (a column each, freedoms), behind those that it has:
/// forces of ropes on its edges, which other motions have in other places.
void add_loads(const UnitResponses& responses, Eigen::MatrixXd loads, StressBasis& basis,
               int threads = 0);

/// The largest checked stress over squares and instants, Pa.
/// @param factors StressBasis::factors, a column an instant.
LargestValue find_largest_checked(const StressBasis& basis, const Eigen::MatrixXd& factors,
                                  int threads = 0);

}  // namespace blocklift::structure

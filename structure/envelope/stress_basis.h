#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/envelope/envelope.h"
#include "structure/response/unit_responses.h"
#include "structure/stress/squares.h"

namespace blocklift::structure {

/// Checked stress of squares of a block for any mass and centre of mass, without its factor.
///
/// Outfitting makes the density linear in place (MassProperties), so that the loads of the twelve
/// unit inertia fields are those of four densities: the steel's own, and that times x, y and z from
/// the steel's centre. The stress that each of these, and of each lug's unit forces, brings to the
/// free block is kept: a thousand blocks of other masses need no further solution.
class StressBasis {
 public:
  /// @param components membrane stresses (11, 22, 12 a square) of each unit load, Pa:
  /// 3 squares x (3 lugs + 48); of the inertia first all twelve fields of the steel's density, then
  /// those of x, y and z times it; then loads that were added.
  /// @throws ModelError if there are not three rows a square.
  StressBasis(std::vector<Square> squares, Eigen::MatrixXd components);
  /// Looks into memory that is kept elsewhere, a file's for example: a hundred megabytes that
  /// several processes may share.
  /// @param keeper what keeps it, for as long as this or a copy of it lives.
  StressBasis(std::vector<Square> squares, const Eigen::Map<const Eigen::MatrixXd>& components,
              std::shared_ptr<const void> keeper);

  const std::vector<Square>& squares() const { return squares_; }
  Eigen::Map<const Eigen::MatrixXd> components() const { return {first_, rows_, columns_}; }
  /// Root mean square of each unit load's components, Pa.
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  std::vector<Square> squares_;
  std::shared_ptr<const void> keeper_;  ///< of the components
  const double* first_ = nullptr;
  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::VectorXd weights_;
};

/// The basis of one block, whose mass is known: of each inertia field its own density's stress in
/// place of those of four densities, which are put together a batch of squares at a time.
class StressOfBlock {
 public:
  /// @param basis outlives this.
  /// @throws ModelError if the basis has fewer unit loads than so many lugs and the fields.
  StressOfBlock(const StressBasis& basis, const MassProperties& mass, std::size_t lugs);

  const std::vector<Square>& squares() const { return basis_.squares(); }
  /// Factors of the unit loads, three a lug, the twelve fields, those that were added, for a load
  /// case that is in balance.
  /// @throws ModelError if the number of lug forces or added loads is not that of the basis.
  Eigen::VectorXd factors(const LoadCase& load_case) const;
  Eigen::Index unit_loads() const { return weights_.size(); }
  /// Components (11, 22, 12 a square) of each unit load, Pa.
  Eigen::MatrixXd components(int first_square, int count) const;
  /// About the root mean square of each unit load's components, Pa.
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  const StressBasis& basis_;
  Eigen::Index lug_forces_;
  Eigen::Vector4d density_;  ///< as a sum of the four
  Eigen::VectorXd weights_;
};

/// Solves for the basis. Each unit load is balanced by an acceleration of the block as the
/// responses have it; in a balanced load case these accelerations cancel.
StressBasis make_stress_basis(const UnitResponses& responses, std::vector<Square> squares,
                              int threads = 0);

/// Adds loads to a basis of the responses' block (a column each, freedoms), behind those that it
/// has: forces of ropes on its edges, which other motions have in other places.
void add_loads(const UnitResponses& responses, Eigen::MatrixXd loads, StressBasis& basis,
               int threads = 0);

/// The largest checked stress over squares and instants, Pa.
/// @param factors StressOfBlock::factors, a column an instant.
LargestValue find_largest_checked(const StressOfBlock& block, const Eigen::MatrixXd& factors,
                                  int threads = 0);

}  // namespace blocklift::structure

#pragma once

#include <optional>
#include <string>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "structure/system/mass_distribution.h"

namespace blocklift::pipeline {

/// Holds what blocks state of their mass and its centre against their plates, as the runs do that
/// make elements of them, at the cost of a coarse mesh for each block after another.
class BlockMasses {
 public:
  /// Complains as check_block_model does, and of elements that a deck cannot have. A case without a
  /// block of plates is passed over.
  /// @param block_key of cases whose blocks differ in mass and centre of mass alone: see
  ///   find_block_variables.
  void check(const LiftCase& lift_case, const std::string& block_key, Diagnostics& diagnostics);

 private:
  std::string key_;                                    ///< of the latest block
  std::optional<structure::MassDistribution> matter_;  ///< its own
};

}  // namespace blocklift::pipeline

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/marine/radiation/memory_state_space.h"
#include "dynamics/marine/radiation/radiation.h"
#include "pipeline/build/panel_problem.h"
#include "pipeline/files/environment/marine_parts.h"

namespace blocklift::pipeline {

/// The water about the vessels of a case as they lie at the start: a problem for the panel method,
/// and what the case asks of it besides.
///
/// The database's world D has its origin midway between the vessels in the calm surface and the
/// axes of W, so that it does not depend on where the vessels lie together. One that is lowered
/// counts for the middle only if there is no other. Bodies lie upright; their reference points are
/// in the water line above Bo, or those of the database that the case names.
struct RadiationProblem : PanelProblem {
  /// A body that is lowered; it stands at its deepest draught among the bodies.
  struct Lowered {
    std::size_t body = 0;
    std::vector<double> draughts;  ///< from its lowest point, ascending, m
  };
  std::optional<Lowered> lowered = std::nullopt;
  /// A database that the case names, in place of one to be computed; null: there is none. D is then
  /// its world.
  std::shared_ptr<const dynamics::HydrodynamicDatabase> given = nullptr;
  std::vector<int> given_bodies;  ///< which body of `given` each of the bodies is
  Mark place;                     ///< of what the file says about radiation
  /// Where mean drift is asked for: all bodies floating freely, 6N x 6N about their reference
  /// points along the axes of D; a single body, but for one of `given`. None: no drift, or no
  /// waves in which that of `given` would matter. What is computed then has a far field.
  struct FreeVessels {
    Eigen::MatrixXd mass, stiffness, damping;
  };
  std::optional<FreeVessels> drifting = std::nullopt;
  bool direct = false;  ///< the surface is marched beside the vessels: no database
  std::vector<dynamics::RegularWave> waves;  ///< that they scatter meanwhile, in D
  dynamics::WaveRamp ramp;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< of D in W, m
  /// The case's waves, where `given` may have to be divided for them; null: there are none.
  std::shared_ptr<const dynamics::WaveField> field = nullptr;
};

/// The same without the body that is lowered.
PanelProblem without_lowered(const RadiationProblem& problem);
/// The same with the lowered body at a draught (m).
PanelProblem at_draught(const RadiationProblem& problem, double draught);

/// The water's surface about the vessels, to be marched beside them.
struct MarchedWater {
  std::shared_ptr<dynamics::DirectRadiation> radiation;  ///< null: there is none
  double step = dynamics::not_a_number;                  ///< s
  int unknowns = 0;                                      ///< panels, after symmetry
};

/// The surface of a problem that is direct; none for others.
/// @throws dynamics::ModelError, dynamics::SimulationError as its meshes and DirectRadiation do.
MarchedWater make_marched_water(const RadiationProblem& problem);

/// How closely the memory of vessels' water is fitted: to 0.5 % of its peak, or to 2 or 10 % where
/// water that swings between hulls would take too many states.
dynamics::MemoryFit memory_fit_of_vessels();

}  // namespace blocklift::pipeline

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/marine/green/panel_method.h"
#include "dynamics/marine/radiation/memory_state_space.h"
#include "dynamics/marine/radiation/radiation.h"
#include "pipeline/files/environment/marine_parts.h"

namespace blocklift::pipeline {

/// Vessels whose radiation is to be computed, as they lie at the start: the input of the panel
/// method.
///
/// The database's world D has its origin midway between the vessels in the calm surface and the
/// axes of W, so that it does not depend on where the vessels lie together. One that is lowered
/// counts for the middle only if there is no other.
struct RadiationProblem {
  struct Body {
    std::string name;
    std::shared_ptr<const Vessel> vessel;
    dynamics::Pose X_DB;                ///< at rest, upright
    Vector3 p_BoR_B = Vector3::Zero();  ///< reference point: in the water line above Bo, m
    /// Of one that is lowered: from its lowest point, ascending, m; X_DB is that of the last.
    std::vector<double> draughts = {};
    int given_body = 0;  ///< which body of `given` it is
  };
  std::vector<Body> bodies;
  /// A database that the case names, in place of one to be computed; null: there is none. D is then
  /// its world.
  std::shared_ptr<const dynamics::HydrodynamicDatabase> given = nullptr;
  dynamics::Water water;
  std::vector<double> frequencies;  ///< rad/s, ascending
  std::vector<double> headings;     ///< rad, a whole turn
  dynamics::PanelMethod method = dynamics::PanelMethod::marched_surface;
  std::vector<dynamics::DampingLid> lids = {};  ///< in D
  Mark place;                                   ///< of what the file says about radiation
  /// Where mean drift is asked for: all bodies floating freely, 6N x 6N about their reference
  /// points along the axes of D; a single body, but for one of `given`. None: no drift, or no
  /// waves in which that of `given` would matter.
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

  /// Index of the body with draughts; none: -1.
  int lowered_body() const;
};

/// The same without the body that is lowered.
RadiationProblem without_lowered(RadiationProblem problem);
/// The same with the lowered body at a draught (m), as a problem of bodies that stay.
RadiationProblem at_draught(RadiationProblem problem, double draught);

/// The water's surface about the vessels, to be marched beside them.
struct MarchedWater {
  std::shared_ptr<dynamics::DirectRadiation> radiation;  ///< null: there is none
  double step = dynamics::not_a_number;                  ///< s
  int unknowns = 0;                                      ///< panels, after symmetry
};

/// The surface of a problem that is direct; none for others.
/// @throws dynamics::ModelError, dynamics::SimulationError as its meshes and DirectRadiation do.
MarchedWater make_marched_water(const RadiationProblem& problem);

/// The panels of a problem whose bodies stay; none on the surface where the method has none.
/// @throws dynamics::ModelError as meshes and dynamics::PanelModel do.
dynamics::PanelModel make_panel_model(const RadiationProblem& problem);

/// Computes the database of a problem by its method, with the model of its panels and the groups of
/// bodies far from each other in it (dynamics::find_distant_groups).
/// @param progress told the fraction that is done and what is being done; may be empty.
/// @throws dynamics::ModelError, dynamics::SimulationError as compute_by_method.
dynamics::HydrodynamicDatabase compute_radiation(
    const RadiationProblem& problem, const dynamics::PanelModel& model,
    const std::vector<dynamics::BodyGroup>& groups,
    const std::function<void(double, const char*)>& progress = {});

/// How closely the memory of vessels' water is fitted: to 0.5 % of its peak, or to 2 or 10 % where
/// water that swings between hulls would take too many states.
dynamics::MemoryFit memory_fit_of_vessels();

}  // namespace blocklift::pipeline

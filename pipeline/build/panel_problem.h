#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/marine/green/panel_method.h"
#include "dynamics/marine/panels/wetted_body.h"

namespace blocklift::pipeline {

/// The water, the waves, and how the flow about hulls is computed in them.
struct PanelSettings {
  dynamics::Water water;
  std::vector<double> frequencies;  ///< rad/s, ascending
  std::vector<double> headings;     ///< rad
  dynamics::PanelMethod method = dynamics::PanelMethod::marched_surface;
  std::vector<dynamics::DampingLid> lids = {};  ///< in D
  bool symmetry = true;                         ///< use what planes of symmetry there are
  bool far_field = false;                       ///< compute HydrodynamicDatabase::far_field as well
};

/// Hulls at rest in calm water whose linear flow is to be computed: all that the database of the
/// panel method follows from, whether a lift asks for it or a file of vessels. The bodies stay
/// where they are: of a hull that is lowered each draught is a problem.
struct PanelProblem : PanelSettings {
  struct Body {
    std::string name;
    std::shared_ptr<const dynamics::Hull> hull;
    dynamics::Pose X_DB;  ///< at rest in D, whose plane z = 0 is the calm water
    /// Reference point, which rotations and moments are about, m.
    dynamics::Vector3 p_BoR_B = dynamics::Vector3::Zero();
  };
  std::vector<Body> bodies;
};

/// The panels of a problem: hulls cut at the water, and the surface about them. There are none on
/// the surface where the method has none or no hull reaches it.
/// @throws dynamics::ModelError as meshes and dynamics::PanelModel do.
dynamics::PanelModel make_panel_model(const PanelProblem& problem);

/// What the database is computed with: two solutions, of which the coarser tells the panels' error.
dynamics::DatabaseSettings database_settings(const PanelProblem& problem);

/// Computes the database of a problem by its method, with the model of its panels and the groups of
/// bodies far from each other in it (dynamics::find_distant_groups).
/// @param progress told the fraction that is done and what is being done; may be empty.
/// @throws dynamics::ModelError, dynamics::SimulationError as compute_by_method.
dynamics::HydrodynamicDatabase compute_radiation(
    const PanelProblem& problem, const dynamics::PanelModel& model,
    const std::vector<dynamics::BodyGroup>& groups,
    const std::function<void(double, const char*)>& progress = {});

}  // namespace blocklift::pipeline

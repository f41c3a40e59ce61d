#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/marine/green/panel_method.h"
#include "dynamics/marine/radiation/hydrodynamic_series.h"
#include "dynamics/marine/radiation/radiation.h"
#include "dynamics/simulation/lift_system.h"
#include "dynamics/simulation/misplacement.h"
#include "pipeline/files/lift_case/marine_parts.h"
#include "pipeline/files/lift_case/sea_band.h"

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
  /// Of the one vessel whose mean drift is asked for, floating freely, 6 x 6 about its reference
  /// point along the axes of D; none: no drift, or one that `given` tells.
  struct FreeVessel {
    Eigen::MatrixXd mass, stiffness, damping;
  };
  std::optional<FreeVessel> drifting = std::nullopt;
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

/// A load with a hull, which makes waves while it is lowered into the water.
struct FloatingLoad {
  std::string name = "load";
  std::shared_ptr<const Vessel> vessel;
  std::vector<double> draughts;                        ///< from its lowest point, m
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of Bo in W when it is in the water, m
  double heading = 0.0;                                ///< when it is in the water, rad
};

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

/// Makes of marine parts the bodies that float and what acts on them. The parts must outlive the
/// builder and be sound.
class MarineBuilder {
 public:
  MarineBuilder(const MarineParts& parts, double gravity, std::optional<FloatingLoad> load = {})
      : parts_(parts), gravity_(gravity), load_(std::move(load)) {}

  /// A vessel as a body on a free joint in the world; inertia of its model.
  static dynamics::BodyDefinition body(const VesselInCase& vessel);

  /// Where each vessel lies at the start, upright, by its draught or by its weight with what stands
  /// on it.
  /// @param carried mass that stands on a vessel, kg.
  void place(const std::function<double(const std::string&)>& carried);
  const dynamics::Pose& start(const std::string& vessel) const { return start_.at(vessel); }

  /// What is to be computed for the vessels that ask for radiation; no bodies: nothing. After
  /// place().
  RadiationProblem radiation_problem() const;

  /// Adds buoyancy and wave forces of hulls, damping, members, lines and, with databases,
  /// diffraction.
  /// @param at_rest without waves: for static equilibrium.
  using BodyOf = std::function<dynamics::BodyPoint(const PointModel&)>;
  void add_elements(const BodyOf& point, const dynamics::HydrodynamicSeries* series, bool at_rest,
                    dynamics::ForceElements& elements);
  /// Adds buoyancy, wave forces and damping of a hull, which need be no vessel of the parts.
  /// @param displaced_mass afloat, kg: the damping is in proportion to the wet part of it.
  void add_hull(const std::string& name, dynamics::BodyIndex body, const Vessel& vessel,
                const DampingInCase& linear, const DampingInCase& quadratic, double displaced_mass,
                bool at_rest, dynamics::ForceElements& elements);
  /// The radiated water of the vessels; null without databases. Its memory is that
  /// of the series, or is fitted by memory_fit_of_vessels().
  /// With a surface that is marched the water has its added mass, and no memory of its own.
  /// @throws dynamics::ModelError if even that is not reached.
  std::shared_ptr<const dynamics::RadiatedWater> make_water(
      const BodyOf& point, const dynamics::HydrodynamicSeries* series,
      const MarchedWater& marched) const;

  /// The places of bodies that share their water for which it is computed; empty without radiation.
  /// After place().
  dynamics::Arrangement arrangement(const BodyOf& point) const;

  bool has_waves() const { return parts_.sea && parts_.sea->waves; }

 private:
  const SeaBand& band() const;
  std::shared_ptr<const dynamics::Sea> sea(bool at_rest) const;
  std::vector<double> radiation_frequencies() const;
  std::shared_ptr<const dynamics::HullClusters> clusters(const Vessel& vessel);
  void add_vessel(const VesselInCase& vessel, dynamics::BodyIndex body, bool at_rest,
                  dynamics::ForceElements& elements);
  void add_damping(const std::string& name, dynamics::BodyIndex body, const Vessel& vessel,
                   const DampingInCase& linear, const DampingInCase& quadratic,
                   double displaced_mass, bool at_rest, dynamics::ForceElements& elements);
  void add_linear_buoyancy(const VesselInCase& vessel, dynamics::BodyIndex body,
                           dynamics::ForceElements& elements);
  /// Frame, amount and stiffness from the database that the vessel names, and where its centre of
  /// buoyancy lies at rest, if that tells it.
  void take_buoyancy_of_database(const VesselInCase& vessel, double rho_g,
                                 dynamics::LinearBuoyancy::Definition& buoyancy,
                                 Vector3& p_WC) const;
  void add_restraint(const VesselInCase& vessel, dynamics::BodyIndex body,
                     dynamics::ForceElements& elements) const;
  void add_current_load(const VesselInCase& vessel, dynamics::BodyIndex body, bool at_rest,
                        dynamics::ForceElements& elements);
  /// As it floats, with what stands on it at its own centre of mass.
  RadiationProblem::FreeVessel free_vessel(const VesselInCase& vessel,
                                           const Vector3& p_BoR_B) const;
  void add_lines(const BodyOf& point, dynamics::ForceElements& elements) const;
  /// A body that makes waves, at rest.
  struct Radiating {
    std::string name;
    std::shared_ptr<const Vessel> vessel;
    dynamics::Pose X_WB;
    std::vector<double> draughts = {};
    std::shared_ptr<const dynamics::HydrodynamicDatabase> given = nullptr;  ///< by the case
    int given_body = 0;
    /// The axes of D about the reference point: with a computed database those of the world, in the
    /// water line above Bo.
    dynamics::Pose X_BR = {X_WB.R.transpose(), {0, 0, -X_WB.p.z()}};
  };
  /// The world of the database that vessels name, in W. One vessel: that of its own frame, level.
  /// Several: along W's axes, where the centres of buoyancy lie as in the database, or, if it does
  /// not tell them, W itself.
  static dynamics::Pose world_of_database(const std::vector<Radiating>& vessels);
  static Radiating lowered(std::string name, std::shared_ptr<const Vessel> vessel,
                           std::vector<double> draughts, const Eigen::Vector2d& position,
                           double heading);
  std::vector<Radiating> radiating() const;
  static dynamics::BodyFrame radiation_frame(const Radiating& vessel, const BodyOf& point);
  /// Where the draught of the one that is lowered is read.
  static dynamics::DraughtMark draught_mark(const std::vector<Radiating>& vessels,
                                            const BodyOf& point);

  const MarineParts& parts_;
  double gravity_;
  std::optional<FloatingLoad> load_;
  std::map<std::string, dynamics::Pose> start_;
  std::map<std::string, double> displaced_mass_;  ///< kg
  mutable std::optional<SeaBand> band_;           ///< found once: vessels may be floated for it
  mutable std::map<bool, std::shared_ptr<const dynamics::Sea>> seas_;
  std::map<const Vessel*, std::shared_ptr<const dynamics::HullClusters>> clusters_;
};

}  // namespace blocklift::pipeline

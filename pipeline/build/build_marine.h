#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/marine/radiation/hydrodynamic_series.h"
#include "dynamics/simulation/lift_system.h"
#include "dynamics/simulation/misplacement.h"
#include "pipeline/build/radiation_problem.h"
#include "pipeline/files/environment/marine_parts.h"
#include "pipeline/files/environment/sea_band.h"

namespace blocklift::pipeline {

/// A load with a hull, which makes waves while it is lowered into the water.
struct FloatingLoad {
  std::string name = "load";
  std::shared_ptr<const Vessel> vessel;
  std::vector<double> draughts;                        ///< from its lowest point, m
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of Bo in W when it is in the water, m
  double heading = 0.0;                                ///< when it is in the water, rad
};

/// Makes of marine parts the bodies that float and what acts on them. The parts must outlive the
/// builder and be sound.
class MarineBuilder {
 public:
  MarineBuilder(const MarineParts& parts, double gravity, std::optional<FloatingLoad> load = {})
      : parts_(parts), gravity_(gravity), load_(std::move(load)) {}

  /// A vessel as a body on a free joint in the world; inertia of its model.
  static dynamics::BodyDefinition body(const given::Vessel& vessel);

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
                const given::Damping& linear, const given::Damping& quadratic,
                double displaced_mass, bool at_rest, dynamics::ForceElements& elements);
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
  void add_vessel(const given::Vessel& vessel, dynamics::BodyIndex body, bool at_rest,
                  dynamics::ForceElements& elements);
  void add_damping(const std::string& name, dynamics::BodyIndex body, const Vessel& vessel,
                   const given::Damping& linear, const given::Damping& quadratic,
                   double displaced_mass, bool at_rest, dynamics::ForceElements& elements);
  void add_linear_buoyancy(const given::Vessel& vessel, dynamics::BodyIndex body,
                           dynamics::ForceElements& elements);
  /// Frame, amount and stiffness from the database that the vessel names, and where its centre of
  /// buoyancy lies at rest, if that tells it.
  void take_buoyancy_of_database(const given::Vessel& vessel, double rho_g,
                                 dynamics::LinearBuoyancy::Definition& buoyancy,
                                 Vector3& p_WC) const;
  void add_restraint(const given::Vessel& vessel, dynamics::BodyIndex body,
                     dynamics::ForceElements& elements) const;
  void add_current_load(const given::Vessel& vessel, dynamics::BodyIndex body, bool at_rest,
                        dynamics::ForceElements& elements);
  /// The vessels of the problem's bodies, in their order.
  RadiationProblem::FreeVessels free_vessels(const RadiationProblem& problem) const;
  /// One as it floats, with what stands on it at its own centre of mass.
  RadiationProblem::FreeVessels free_vessel(const given::Vessel& vessel,
                                            const PanelProblem::Body& body) const;
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
  /// The one of this name, which must be among them.
  Radiating radiating(const std::string& name) const;
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

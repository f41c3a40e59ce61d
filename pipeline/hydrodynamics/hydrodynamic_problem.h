#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/build/panel_problem.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/files/vessel/vessel_model.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"

namespace blocklift::pipeline {

/// A body whose hydrodynamics are to be computed.
struct HydrodynamicBody {
  std::string name;
  std::shared_ptr<const dynamics::Hull>
      hull;                     ///< with the panels to compute with, in its own frame
  dynamics::FloatingBody body;  ///< mass and its centre; the water's density
  Vector3 radii_of_gyration = Vector3::Zero();         ///< about the centre of mass, m
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of Bo in the world, m
  double heading = 0.0;                                ///< of its x axis, rad
  std::vector<double> draughts;  ///< upright, from the lowest point, m; empty: afloat by its weight
  bool as_meshed = false;        ///< z = 0 of its own frame is the water
  Mark place;                    ///< where its file, or that of its group, gives it
};

/// All that a database follows from.
struct HydrodynamicProblem {
  std::string title;
  std::vector<HydrodynamicBody> bodies;
  /// Of all draughts, D being W. From the far field follows the mean drift of the single body as it
  /// floats freely.
  PanelSettings settings;
  double memory_limit = 0.0;  ///< bytes; 0: dynamics::usable_memory()
  Mark place;
  Mark frequencies_place;

  /// The body with several draughts, or the first.
  int lowered_body() const;
  /// How many draughts of it are to be computed: at least one.
  std::size_t state_count() const;
};

/// Reads a vessel file, or one of several vessels. A vessel by itself lies in its own frame,
/// wherever its file places it, and headings count from its bow. Complains about everything that is
/// wrong with it: keys and values, hulls that are open, inverted or out of the water. Null after a
/// complaint.
std::optional<HydrodynamicProblem> read_hydrodynamic_problem(const std::filesystem::path& file,
                                                             const ModelLibrary& library,
                                                             Diagnostics& diagnostics);

/// One draught of a problem, meshed and ready.
struct HydrodynamicState {
  double draught = 0.0;  ///< of the lowered body, m
  PanelProblem panels;   ///< about the centres of mass; D is W
  Eigen::MatrixXd mass;  ///< 6N x 6N about the centres of mass
  std::shared_ptr<const dynamics::PanelModel> model;
  /// Of bodies far from each other, or one of all; none where the method needs none.
  std::vector<dynamics::BodyGroup> groups;
  dynamics::DatabaseSettings settings;
  double bytes = 0.0;  ///< of memory that the computation takes, at most
};

/// Finds the position of rest, cuts the hulls at the water, meshes the surface.
/// @throws InputError, with the place in the file, if bodies intersect or a wave is too short for
///   the panels; dynamics::ModelError if a body cannot float or is wholly above the water, or the
///   surface cannot be meshed; dynamics::SimulationError if the memory does not suffice, with the
///   figures.
HydrodynamicState prepare_state(const HydrodynamicProblem& problem, std::size_t index);

/// Fingerprint of a problem and its states: equal if and only if nothing that the file follows from
/// differs. It is that of the panels of each state, with masses and what is made of them.
std::string identity_of(const HydrodynamicProblem& problem,
                        const std::vector<HydrodynamicState>& states);

/// Share done (0 to 1) and what is being done.
using HydrodynamicProgress = std::function<void(double, const std::string&)>;

/// Computes all draughts, hydrostatics included.
HydrodynamicFile compute_hydrodynamics(const HydrodynamicProblem& problem,
                                       const std::vector<HydrodynamicState>& states,
                                       const HydrodynamicProgress& progress = {});

/// The same, in which what the panel method finds is taken from the cache where it lies there, and
/// put there where it does not (find_database): to the last bit the numbers of the run that
/// computed them.
/// @param cache folder of it (cache_folder).
/// @param say called with a sentence about each draught that is in the cache, or waited for.
HydrodynamicFile find_hydrodynamics(const HydrodynamicProblem& problem,
                                    const std::vector<HydrodynamicState>& states,
                                    const HydrodynamicProgress& progress,
                                    const std::filesystem::path& cache,
                                    const std::function<void(const std::string&)>& say);

}  // namespace blocklift::pipeline

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dynamics/marine/hull/floating_position.h"
#include "dynamics/marine/hull/hull_shapes.h"
#include "pipeline/declaration/geometry_format.h"
#include "pipeline/files/vessel/hydrodynamic_settings.h"
#include "pipeline/formats/hydrodynamics/hull_file.h"

namespace blocklift::pipeline {

/// A mesh from a file as the hull. One that is symmetric by key is cut in half and mirrored.
struct HullFileModel {
  Located<std::string> path;  ///< from the folder of the model
  bool close_openings = false;
  std::vector<int> symmetric_in;  ///< axes square to its planes of symmetry, 0: x, 1: y
};

/// The hull of a vessel: one of three.
struct VesselHullModel {
  std::optional<dynamics::BargeShape> barge;
  std::optional<dynamics::ShipShape> ship;
  std::optional<HullFileModel> file;
};

/// A floating body: hull and mass. SI units. Its frame: origin on the base line amidships in the
/// centre plane, x forward, y to port, z up; or that of the file.
struct VesselModel {
  std::string kind;
  std::string title;
  VesselHullModel hull;
  double panel_size = std::numeric_limits<double>::quiet_NaN();  ///< m
  double mass = std::numeric_limits<double>::quiet_NaN();        ///< kg
  Vector3 centre_of_mass = Vector3::Zero();                      ///< m
  Vector3 radii_of_gyration = Vector3::Zero();                   ///< about it, m
  HydrodynamicSettings hydrodynamics;                            ///< of `blocklift hydro`
  Mark place;
};

/// The format of a vessel's model file.
Format<VesselModel> vessel_model_format();

/// The hull of a vessel with panels of a size (m); a mesh from a file keeps its own.
/// @param folder of the vessel's file.
/// @throws dynamics::ModelError if the shape cannot be, HullFileError if a mesh cannot be read.
dynamics::Hull make_vessel_hull(const VesselModel& model, const std::filesystem::path& folder,
                                double panel_size);

/// Reads a vessel's model file; complains about everything that is wrong with it, the hull included
/// (shape, mesh, diagnosis), each with its place. Null if nothing could be read.
struct Vessel {
  VesselModel model;
  dynamics::Hull hull;
  dynamics::FloatingBody body() const { return {model.mass, model.centre_of_mass}; }
};
/// @param homes folders besides the vessel's own in which the mesh of its hull may lie.
std::optional<Vessel> read_vessel(const std::filesystem::path& file, Diagnostics& diagnostics,
                                  const std::vector<std::filesystem::path>& homes = {});

}  // namespace blocklift::pipeline

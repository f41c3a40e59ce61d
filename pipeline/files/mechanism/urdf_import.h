#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::pipeline {

/// A robot description (URDF) as parts of a mechanism.
struct RobotImport {
  std::string name;
  std::string root;  ///< the link that no joint carries; empty where it is the world itself
  MechanismParts parts;
  std::vector<std::string> notes;  ///< what of the description plays no part, and what was assumed
};

/// Reads a robot description: links become bodies; revolute, continuous, prismatic, fixed, floating
/// and planar joints become joints with their damping; joints that mimic another one become gears.
/// A link named "world" is the world. Limits, friction, safety controllers and shapes are named in
/// the notes.
///
/// @param mark where the file is named, for complaints about the file as a whole.
/// @returns nothing after a complaint.
std::optional<RobotImport> import_urdf(const std::filesystem::path& path, const Mark& mark,
                                       Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/simulation/lift_system.h"
#include "pipeline/build/build_marine.h"
#include "pipeline/files/lift_case/operation_schedule.h"
#include "pipeline/files/mechanism/mechanism_file.h"

namespace blocklift::pipeline {

/// The dynamics of a mechanism file and where its parts are in it. Bodies, loops, springs and ropes
/// have the names of the file and stand in its order, loops and springs each among their kind.
struct BuiltMechanism {
  dynamics::LiftSystem system;
  std::map<std::string, dynamics::BodyIndex> carried_by;  ///< joint to the body that it carries
  /// The same without waves and in mean wind, where there are waves or gusts.
  std::optional<dynamics::LiftSystem> calm = {};
  /// The water's surface that is marched beside `system`; none: its water has a memory of its own,
  /// or there is none.
  MarchedWater marched = {};
  /// What the water of `system` was computed for; empty where vessels make no waves.
  dynamics::Arrangement arrangement = {};
  /// Of its operation. Drives whose course is not known in it are steered in the system.
  Schedule schedule = {};

  /// The mechanism whose static equilibrium is asked.
  const dynamics::LiftSystem& at_rest() const { return calm ? *calm : system; }
};

/// What is to be computed for the file's vessels before it is built; no bodies: nothing.
RadiationProblem radiation_problem(const MechanismFile& file);

/// Builds the dynamics of a sound mechanism file, with loops closed at the start as its initial
/// state says.
/// @param radiation of radiation_problem(), or `marched` made of it; neither: vessels make no
/// waves.
/// @throws dynamics::ModelError, dynamics::SimulationError if the parts do not make a mechanism,
///   the loops cannot be closed, or are open where they must not be; a file that was read without
///   complaints does. InputError if nobody gives a law that steers a drive.
/// @param found of its operation by running it.
BuiltMechanism build_mechanism(const MechanismFile& file,
                               const dynamics::HydrodynamicSeries* radiation = nullptr,
                               MarchedWater marched = {}, const FoundMotion& found = {});

/// Reads a mechanism file with all that it names, checks it, and builds it once to see that it can
/// be.
/// @returns the mechanism only if nothing is wrong with it; else the complaints are in
/// `diagnostics`.
std::optional<MechanismFile> read_mechanism(const std::filesystem::path& path,
                                            ModelLibrary& library, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

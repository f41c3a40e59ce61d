#pragma once

#include <map>
#include <string>
#include <vector>

#include "dynamics/simulation/lift_system.h"
#include "pipeline/input/mechanism_file.h"

namespace blocklift::pipeline {

/// The dynamics of a mechanism file and where its parts are in it. Bodies, loops, springs and ropes
/// have the names of the file and stand in its order, loops and springs each among their kind.
struct BuiltMechanism {
  dynamics::LiftSystem system;
  std::map<std::string, dynamics::BodyIndex> carried_by;  ///< joint to the body that it carries
};

/// Builds the dynamics of a sound mechanism file, with loops closed at the start as its initial state
/// says.
/// @throws dynamics::ModelError, dynamics::SimulationError if the parts do not make a mechanism, the loops
///   cannot be closed, or are open where they must not be; a file that was read without complaints does.
BuiltMechanism build_mechanism(const MechanismFile& file);

/// What build_mechanism says of a file that cannot be built; empty if it can.
std::string try_to_build(const MechanismFile& file);

}  // namespace blocklift::pipeline

#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

#include "dynamics/multibody/mechanism.h"
#include "pipeline/files/crane/crane_model.h"

namespace blocklift::pipeline {

/// A crane by itself with its loops closed: its own mechanism, and where all of its joints stand.
struct CranePose {
  dynamics::Mechanism mechanism;  ///< bodies and loops named as in its file, its base in the world
  Eigen::VectorXd q;              ///< nq
};

/// The pose in which a crane is put together: its joints as its file's `pose` says, or at zero,
/// then those that no drive moves brought the shortest way to where all loops close. Lengths and
/// offsets of loops that the file leaves open are those of this pose, whatever a case does with the
/// crane.
/// @throws dynamics::ModelError if the parts do not make a crane, dynamics::SimulationError if its
///   loops cannot be closed, saying which and by how much they miss.
CranePose put_together(const CraneModel& crane);

/// The same crane with its drives where they start. They go there from the first pose at once and
/// evenly, the other joints following as the loops lead them, so that no loop flips over.
/// @param start_of coordinate of each drive, by its name, m or rad.
/// @param name of the crane, for messages.
/// @throws dynamics::SimulationError if the loops cannot follow, saying how far the drives got.
CranePose pose_at_start(const CraneModel& crane,
                        const std::function<double(const std::string&)>& start_of,
                        const std::string& name);

}  // namespace blocklift::pipeline

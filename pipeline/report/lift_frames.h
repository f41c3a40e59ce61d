#pragma once

#include <filesystem>

namespace blocklift::pipeline {

/// @throws ResultsError if results.h5 is missing, unreadable, or has nothing that moves.
void require_frames(const std::filesystem::path& folder);

/// Writes the lift in time for ParaView from the results.h5 of a result folder: lift.pvd, which
/// names for each of so many instants, evenly spread, two files of the folder lift-frames:
///   cranes-NNNN.vtu  bodies as boxes and ropes as lines; of each cell `object`, its number in the
///                    field data `object_names`, and `tension` (N, 0 of bodies)
///   block-NNNN.vtu   the block's surface, undeformed, at its pose, with `von_mises`, Pa: the
///                    largest over all instants in motion. Without structure the block is a box of
///                    the other file, and this one is not there.
/// Earlier frames are replaced. Lengths in m, in the world.
///
/// @param frames at least 2.
/// @return the path of lift.pvd.
/// @throws ResultsError if results.h5 is missing, unreadable, or has nothing that moves.
/// @throws std::runtime_error if a file cannot be written.
std::filesystem::path write_lift_frames(const std::filesystem::path& folder, int frames);

}  // namespace blocklift::pipeline

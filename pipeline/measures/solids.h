#pragma once

#include <array>
#include <vector>

#include "pipeline/files/lift_case/lift_case.h"

namespace blocklift::pipeline {

/// A triangle of a surface, m.
using Triangle = std::array<Vector3, 3>;

/// Surface of a block in its frame: the shells of its mesh, or its plates on their mid-planes
/// without openings. Arcs are divided so that no chord lies further in than a hundredth of the
/// arc's height.
std::vector<Triangle> surface_of(const BlockModel& block);
/// A hull, in the vessel's frame.
std::vector<Triangle> surface_of(const dynamics::Hull& hull);
/// The six sides of a box, in the frame of its body.
std::vector<Triangle> surface_of(const BoxShape& box);
/// All of them, which may cross.
std::vector<Triangle> surface_of(const std::vector<BoxShape>& boxes);
/// What is lifted: the hull of a vessel, else the block.
std::vector<Triangle> surface_of(const given::Load& load);

}  // namespace blocklift::pipeline

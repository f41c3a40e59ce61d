#pragma once

#include <vector>

#include "pipeline/build/build_lift.h"
#include "pipeline/results/files/result_file.h"

namespace blocklift::pipeline {

/// Mass, centre and inertia of the load as its mesh has them.
LoadMass load_mass(const structure::MassProperties& mass);

/// Lugs of a load that is a vessel: names and places.
std::vector<structure::LiftingPoint> vessel_lugs(const given::Load& load);

/// A box of a file, for the drawing.
DrawnBox drawn_box(const BoxShape& box);

/// Names and roles of the parts of a lift, for results.h5.
Scene make_scene(const BuiltLift& model, const std::vector<structure::LiftingPoint>& lugs);

}  // namespace blocklift::pipeline

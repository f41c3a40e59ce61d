#pragma once

#include <vector>

#include "pipeline/assessment/result_file.h"
#include "pipeline/input/build_lift.h"

namespace blocklift::pipeline {

/// Mass, centre and inertia of the load as its mesh has them.
LoadMass load_mass(const structure::MassProperties& mass);

/// Lugs of a load that is a vessel: names and places.
std::vector<structure::LugRegion> vessel_lugs(const LoadInCase& load);

/// A box of a file, for the drawing.
DrawnBox drawn_box(const BoxShape& box);

/// Names and roles of the parts of a lift, for results.h5.
Scene make_scene(const BuiltLift& model, const std::vector<structure::LugRegion>& lugs);

}  // namespace blocklift::pipeline

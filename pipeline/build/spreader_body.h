#pragma once

#include <vector>

#include "dynamics/multibody/mechanism.h"
#include "pipeline/files/rigging/spreader.h"
#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::pipeline {

/// A spreader as a free rigid body, its axes in its middle.
dynamics::BodyDefinition spreader_body(const given::Spreader& spreader);

/// A box for each of its bars, for the drawing and for clearances.
std::vector<BoxShape> spreader_boxes(const given::Spreader& spreader);

}  // namespace blocklift::pipeline

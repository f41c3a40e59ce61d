#pragma once

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/geometry_format.h"

namespace blocklift::pipeline {

/// Weld toe whose structural stress is asked for (see structure::HotSpot). SI units.
struct HotSpotInFile {
  Located<std::string> name;
  Vector3 toe = Vector3::Zero();         ///< m
  Vector3 direction = Vector3::UnitX();  ///< unit
  double thickness = 0;                  ///< m
};

/// Hot spots by name.
Format<std::vector<HotSpotInFile>> hot_spots_format();

}  // namespace blocklift::pipeline

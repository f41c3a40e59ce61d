#pragma once

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/geometry_format.h"

namespace blocklift::pipeline {

namespace given {

/// Weld toe whose structural stress is asked for (see structure::HotSpot). SI units.
struct HotSpot {
  Located<std::string> name;
  Vector3 toe = Vector3::Zero();         ///< m
  Vector3 direction = Vector3::UnitX();  ///< unit
  double thickness = 0;                  ///< m
};

}  // namespace given

/// Hot spots by name.
Format<std::vector<given::HotSpot>> hot_spots_format();

}  // namespace blocklift::pipeline

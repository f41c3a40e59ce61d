#include "pipeline/files/structure/hot_spot_format.h"

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {

Format<std::vector<given::HotSpot>> hot_spots_format() {
  Table<given::HotSpot> table(
      "hot spot",
      "A weld toe: its structural stress is extrapolated linearly from 0.4 and 1.0 "
      "plate thicknesses before it (IIW).");
  table.required("toe", &given::HotSpot::toe, position_format(), "on the plate's surface")
      .required("direction", &given::HotSpot::direction, direction_format(),
                "away from the weld, along the surface and across the weld")
      .required("thickness", &given::HotSpot::thickness,
                quantity(Dimension::length, Range::positive()), "of the plate");
  return named_tables(table.format());
}

}  // namespace blocklift::pipeline

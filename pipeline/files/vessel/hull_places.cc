#include "pipeline/files/vessel/hull_places.h"

#include <fmt/format.h>

#include "dynamics/marine/panels/hull_intersection.h"

namespace blocklift::pipeline {

void check_hulls_apart(const std::vector<PlacedHull>& hulls, Diagnostics& diagnostics) {
  std::vector<dynamics::Triangles> surfaces;
  for (const PlacedHull& hull : hulls) {
    surfaces.push_back(dynamics::triangles_of(*hull.hull, hull.X_WB));
  }
  for (std::size_t b = 1; b < hulls.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const auto place = dynamics::find_intersection(surfaces[a], surfaces[b]);
      if (!place) continue;
      diagnostics.error(
          hulls[b].mark,
          fmt::format("{} and {} intersect, at ({:.4g}, {:.4g}, {:.4g}) m", hulls[a].name,
                      hulls[b].name, place->x(), place->y(), place->z()),
          {"hulls must be apart, above the water and below: move one of them"});
    }
  }
}

}  // namespace blocklift::pipeline

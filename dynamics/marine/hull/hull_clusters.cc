#include "dynamics/marine/hull/hull_clusters.h"

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "dynamics/marine/hull/hull_faces.h"

namespace blocklift::dynamics {

namespace {

const Hull& usable(const Hull& hull) {
  std::string messages;
  for (const HullDefect& defect : diagnose(hull)) {
    // A sliver or a warped panel does no harm here: the triangles are taken as they are.
    if (defect.kind == HullDefectKind::degenerate_panel ||
        defect.kind == HullDefectKind::warped_panel) {
      continue;
    }
    messages += (messages.empty() ? "" : "\n") + defect.message;
  }
  if (!messages.empty()) throw ModelError(messages);
  return hull;
}

}  // namespace

HullClusters::HullClusters(const Hull& hull)
    : hull_(usable(hull)), enclosed_(calc_enclosed_volume(hull)), faces_(join_flat_panels(hull)) {}

}  // namespace blocklift::dynamics

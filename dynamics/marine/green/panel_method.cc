#include "dynamics/marine/green/panel_method.h"

#include "dynamics/marine/green/hull_database.h"

namespace blocklift::dynamics {

HydrodynamicDatabase compute_by_method(PanelMethod method, const PanelModel& model,
                                       const std::vector<BodyGroup>& groups,
                                       const DatabaseSettings& settings) {
  if (method == PanelMethod::green_function) return compute_hull_database(model, settings);
  return compute_distant_groups(model, groups, settings);
}

double bytes_by_method(PanelMethod method, const PanelModel& model,
                       const DatabaseSettings& settings) {
  if (method == PanelMethod::green_function) return hull_database_bytes(model, settings);
  return database_bytes(model, settings);
}

}  // namespace blocklift::dynamics

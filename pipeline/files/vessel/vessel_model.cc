#include "pipeline/files/vessel/vessel_model.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "dynamics/marine/hull/symmetric_hull.h"
#include "pipeline/declaration/document.h"
#include "pipeline/declaration/format_once.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/files/named_file.h"
#include "pipeline/files/vessel/wetted_mesh.h"

namespace blocklift::pipeline {

namespace {

/// Even numbers of panels along and across, so that none lies across a plane of symmetry.
template <class Shape>
dynamics::PanelDivision division_of(const Shape& shape, double panel_size) {
  auto division =
      dynamics::PanelDivision::of_size(panel_size, shape.length, shape.breadth, shape.depth);
  division.along += division.along % 2;
  division.across += division.across % 2;
  return division;
}

/// Complains before panels are made that nobody could wait for.
template <class Shape>
void require_few_panels(const Shape& shape, double panel_size) {
  constexpr double most = 60000;
  const double faces =
      2 * (shape.length * shape.breadth + (shape.length + shape.breadth) * shape.depth);
  const double panels = faces / (panel_size * panel_size);
  if (panels <= most) return;
  throw dynamics::ModelError(fmt::format(
      "a hull of {:.6g} x {:.6g} x {:.6g} m with panels of {:.4g} m would have about {:.3g} "
      "panels; "
      "at most {:.0f} are made: are all dimensions right? Else give a larger panel_size",
      shape.length, shape.breadth, shape.depth, panel_size, panels, most));
}

/// Each defect, the last with what the mesh as a whole tells.
void complain_about_mesh(const dynamics::Hull& hull, const dynamics::HullDemands& demands,
                         const Mark& mark, Diagnostics& diagnostics) {
  std::vector<dynamics::HullDefect> defects = dynamics::diagnose(hull, demands);
  // A mesh that ends at its water line is open there: above the water that is not what is wrong.
  if (std::ranges::any_of(defects, [](const dynamics::HullDefect& defect) {
        return defect.kind == dynamics::HullDefectKind::above_water;
      })) {
    std::erase_if(defects, [](const dynamics::HullDefect& defect) {
      return defect.kind == dynamics::HullDefectKind::open_edge;
    });
  }
  for (std::size_t d = 0; d < defects.size(); ++d) {
    diagnostics.error(mark, defects[d].message,
                      d + 1 < defects.size() ? std::vector<std::string>() : hints_on_mesh(hull));
  }
}

}  // namespace

dynamics::Hull make_vessel_hull(const VesselModel& model, const std::filesystem::path& folder,
                                double panel_size) {
  if (model.hull.barge) {
    require_few_panels(*model.hull.barge, panel_size);
    return make_barge(*model.hull.barge, division_of(*model.hull.barge, panel_size));
  }
  if (model.hull.ship) {
    require_few_panels(*model.hull.ship, panel_size);
    return make_ship(*model.hull.ship, division_of(*model.hull.ship, panel_size));
  }
  dynamics::Hull hull =
      read_hull(folder / model.hull.file->path.value,
                {.close_openings = model.hull.file->close_openings, .panel_size = panel_size});
  const std::vector<int>& axes = model.hull.file->symmetric_in;
  if (!axes.empty()) hull = made_symmetric(hull, axes);
  return model.hydrodynamics.as_meshed ? with_freeboard(hull) : hull;
}

std::optional<Vessel> read_vessel(const std::filesystem::path& file, Diagnostics& diagnostics,
                                  const std::vector<std::filesystem::path>& homes) {
  const std::optional<Document> document = load_document(file, diagnostics);
  if (!document) return std::nullopt;
  const std::size_t errors_before = diagnostics.error_count();
  Vessel vessel;
  Reading reading(*document, diagnostics);
  const Format<VesselModel>& format = format_once<vessel_model_format>();
  reading.with_owner("the vessel",
                     [&] { return format.read(document->root, reading, vessel.model); });
  if (vessel.model.hull.file)
    path_of_named_file(vessel.model.hull.file->path, file.parent_path(), diagnostics, homes);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  const Mark mark = vessel.model.hull.file ? vessel.model.hull.file->path.mark : vessel.model.place;
  try {
    vessel.hull = make_vessel_hull(vessel.model, file.parent_path(), vessel.model.panel_size);
    vessel.hull.set_name(name_of_input(file));
    dynamics::HullDemands demands{.largest_warp = 0.5};
    if (vessel.model.hydrodynamics.as_meshed) demands.water_level = 0.0;
    complain_about_mesh(vessel.hull, demands, mark, diagnostics);
    if (diagnostics.error_count() == errors_before && !vessel.model.hydrodynamics.as_meshed) {
      find_floating_position(dynamics::HullClusters(vessel.hull), vessel.body());
    }
  } catch (const dynamics::ModelError& error) {
    diagnostics.error(mark, error.what());
  } catch (const dynamics::SimulationError& error) {
    diagnostics.error(mark, error.what());
  } catch (const HullFileError& error) {
    diagnostics.error(mark, error.what());
  }
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return vessel;
}

}  // namespace blocklift::pipeline

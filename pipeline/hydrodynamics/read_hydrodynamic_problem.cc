#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "pipeline/declaration/document.h"
#include "pipeline/declaration/format_once.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/files/vessel/vessel_group.h"
#include "pipeline/hydrodynamics/hydrodynamic_problem.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// The vessel's file as a body, its place and draughts still to be given.
std::optional<HydrodynamicBody> read_body(const fs::path& file, std::optional<double> panel_size,
                                          Diagnostics& diagnostics,
                                          HydrodynamicSettings& settings) {
  std::optional<Vessel> vessel = read_vessel(file, diagnostics);
  if (!vessel) return std::nullopt;
  settings = vessel->model.hydrodynamics;
  if (!panel_size) panel_size = settings.panel_size;
  HydrodynamicBody body;
  body.body = vessel->body();
  body.radii_of_gyration = vessel->model.radii_of_gyration;
  body.as_meshed = settings.as_meshed;
  body.place = vessel->model.place;
  dynamics::Hull hull = std::move(vessel->hull);
  body.name = hull.name();
  if (panel_size && *panel_size != vessel->model.panel_size) {
    const std::size_t before = diagnostics.error_count();
    try {
      hull = make_vessel_hull(vessel->model, file.parent_path(), *panel_size);
      hull.set_name(body.name);
      for (const auto& defect : dynamics::diagnose(hull, {.largest_warp = 0.5})) {
        diagnostics.error(vessel->model.place, defect.message);
      }
    } catch (const std::runtime_error& error) {
      diagnostics.error(vessel->model.place, error.what());
    }
    if (diagnostics.error_count() > before) return std::nullopt;
  }
  body.hull = std::make_shared<const dynamics::Hull>(std::move(hull));
  return body;
}

std::shared_ptr<const dynamics::Hull> with_name(dynamics::Hull hull, const std::string& name) {
  hull.set_name(name);
  return std::make_shared<const dynamics::Hull>(std::move(hull));
}

void take_settings(const HydrodynamicSettings& settings, HydrodynamicProblem& problem) {
  PanelSettings& panels = problem.settings;
  panels.water.density = settings.water_density;
  if (settings.water_depth) panels.water.depth = *settings.water_depth;
  panels.frequencies = settings.frequencies.list();
  panels.headings = settings.headings.value_or(default_headings());
  panels.method = settings.method;
  panels.lids = make_lids(settings.lids);
  panels.symmetry = settings.symmetry;
  panels.far_field = settings.mean_drift;
  problem.frequencies_place = settings.frequencies.place;
  for (HydrodynamicBody& body : problem.bodies) body.body.water_density = settings.water_density;
}

std::optional<HydrodynamicProblem> read_single(const fs::path& file, Diagnostics& diagnostics) {
  HydrodynamicProblem problem;
  HydrodynamicSettings settings;
  std::optional<HydrodynamicBody> body = read_body(file, {}, diagnostics, settings);
  if (!body) return std::nullopt;
  problem.title = body->name;
  problem.place = body->place;
  body->draughts = settings.draughts;
  problem.bodies.push_back(std::move(*body));
  take_settings(settings, problem);
  return problem;
}

/// An angle of a whole turn from 0 on, rad.
double within_turn(double angle) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double wrapped = angle - turn * std::floor(angle / turn);
  return wrapped > turn - 1e-12 ? 0.0 : wrapped;
}

/// A case places and turns a single vessel's database with the vessel: it is made in the vessel's
/// own frame, level in the water, whatever place the file gives it. The waves' headings count from
/// its bow, and what lies in the world moves along.
bool take_own_frame(HydrodynamicProblem& problem, Diagnostics& diagnostics) {
  HydrodynamicBody& body = problem.bodies.front();
  if (!problem.settings.lids.empty() && body.heading != 0.0) {
    diagnostics.error(
        problem.place,
        "lids are rectangles along the world's axes, and the only vessel lies turned to them",
        {"give it no heading, and place the lids and the waves' headings in its own frame: its "
         "database is in that frame anyway"});
    return false;
  }
  for (dynamics::DampingLid& lid : problem.settings.lids) {
    lid.low -= body.position;
    lid.high -= body.position;
  }
  if (body.heading != 0.0) {
    for (double& heading : problem.settings.headings) heading = within_turn(heading - body.heading);
    std::sort(problem.settings.headings.begin(), problem.settings.headings.end());
  }
  body.position.setZero();
  body.heading = 0.0;
  return true;
}

std::optional<HydrodynamicProblem> read_group(const fs::path& file, const ModelLibrary& library,
                                              Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  const std::optional<Document> document = load_document(file, diagnostics);
  if (!document) return std::nullopt;
  VesselGroup group;
  Reading reading(*document, diagnostics);
  const Format<VesselGroup>& format = format_once<vessel_group_format>();
  reading.with_owner("the file", [&] { return format.read(document->root, reading, group); });
  if (diagnostics.error_count() > before) return std::nullopt;
  HydrodynamicProblem problem;
  problem.title = group.title.empty() ? fs::absolute(file).stem().string() : group.title;
  problem.place = group.place;
  for (const Named<PlacedVessel>& placed : group.vessels) {
    const fs::path found =
        library.find_vessel(placed.value.vessel, file.parent_path(), diagnostics);
    if (found.empty()) continue;
    HydrodynamicSettings own;
    std::optional<HydrodynamicBody> body =
        read_body(found, group.hydrodynamics.panel_size, diagnostics, own);
    if (!body) continue;
    body->name = placed.name.value;
    body->place = placed.name.mark;
    body->hull = with_name(*body->hull, body->name);
    body->position = {placed.value.position[0], placed.value.position[1]};
    body->heading = placed.value.heading;
    body->draughts = placed.value.draughts;
    problem.bodies.push_back(std::move(*body));
  }
  if (diagnostics.error_count() > before) return std::nullopt;
  take_settings(group.hydrodynamics, problem);
  if (problem.settings.far_field && problem.bodies.size() > 1) {
    diagnostics.error(group.place,
                      "mean drift is asked for vessels that share their water: the waves far away "
                      "tell that of all together only",
                      {"leave out mean_drift, or compute each vessel by itself"});
    return std::nullopt;
  }
  if (problem.bodies.size() == 1 && !take_own_frame(problem, diagnostics)) return std::nullopt;
  return problem;
}

}  // namespace

std::optional<HydrodynamicProblem> read_hydrodynamic_problem(const fs::path& file,
                                                             const ModelLibrary& library,
                                                             Diagnostics& diagnostics) {
  const fs::path vessel = file / "vessel.yaml";  // may lie beside a case
  const fs::path inside = fs::exists(vessel) ? vessel : input_file(file);
  if (kind_of_file(inside) == FileKind::vessels) return read_group(inside, library, diagnostics);
  return read_single(inside, diagnostics);
}

}  // namespace blocklift::pipeline

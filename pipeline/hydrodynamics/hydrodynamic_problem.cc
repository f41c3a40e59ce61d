#include "pipeline/hydrodynamics/hydrodynamic_problem.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/panels/mirrored_bodies.h"
#include "dynamics/marine/panels/wetted_body.h"
#include "dynamics/marine/radiation/mean_drift.h"
#include "dynamics/marine/radiation/response_amplitude.h"
#include "pipeline/files/vessel/hull_places.h"
#include "pipeline/formats/hydrodynamics/hull_hash.h"
#include "pipeline/hydrodynamics/hydrodynamic_report.h"
#include "pipeline/hydrodynamics/method_hash.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

using dynamics::Matrix3;
using dynamics::Pose;

Matrix3 turn_about_z(double angle) {
  return Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
}

double lowest_point(const dynamics::Hull& hull, const Pose& X_WB) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3& vertex : hull.vertices()) {
    lowest = std::min(lowest, X_WB.apply(vertex).z());
  }
  return lowest;
}

Pose pose_at_rest(const HydrodynamicBody& body, std::size_t index) {
  const Matrix3 R_WB = turn_about_z(body.heading);
  Pose X_WB{R_WB, {body.position.x(), body.position.y(), 0.0}};
  if (body.as_meshed) return X_WB;
  if (!body.draughts.empty()) {
    const double draught = body.draughts[std::min(index, body.draughts.size() - 1)];
    X_WB.p.z() = -draught - body.hull.bounds()[0].z();
    return X_WB;
  }
  const dynamics::FloatingPosition floating =
      find_floating_position(dynamics::HullClusters(body.hull), body.body, R_WB);
  X_WB.R = floating.X_WB.R;
  X_WB.p.z() = floating.X_WB.p.z();
  // What is left of the iteration must not hide a plane of symmetry: turns below 1e-8 are none.
  if ((X_WB.R - R_WB).cwiseAbs().maxCoeff() < 1e-8) X_WB.R = R_WB;
  return X_WB;
}

std::vector<dynamics::WettedBody> wetted_bodies(const HydrodynamicProblem& problem,
                                                const std::vector<Pose>& poses) {
  std::vector<dynamics::WettedBody> bodies;
  std::vector<std::vector<Vector3>> vertices_W;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const HydrodynamicBody& body = problem.bodies[b];
    bodies.push_back(make_wetted_body(body.hull, poses[b], body.body.p_BoBcm_B));
    bodies.back().name = body.name;
    std::vector<Vector3>& vertices = vertices_W.emplace_back();
    for (const Vector3& vertex : body.hull.vertices()) vertices.push_back(poses[b].apply(vertex));
  }
  if (problem.symmetry) mirror_bodies(vertices_W, bodies);
  return bodies;
}

/// Above the water and below, which the water lines alone do not tell.
void require_apart(const HydrodynamicProblem& problem, const std::vector<Pose>& poses) {
  std::vector<PlacedHull> hulls;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const HydrodynamicBody& body = problem.bodies[b];
    hulls.push_back({"vessel " + body.name, body.place, &body.hull, poses[b]});
  }
  Diagnostics diagnostics;
  check_hulls_apart(hulls, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
}

void require_panels(const HydrodynamicProblem& problem, const dynamics::PanelModel& model) {
  try {
    require_panels_for_waves(model, problem.frequencies.back());
  } catch (const dynamics::ModelError& error) {
    Diagnostics diagnostics;
    diagnostics.error(problem.frequencies_place, error.what());
    throw InputError(diagnostics);
  }
}

void refuse_if_too_large(const HydrodynamicState& state, double limit) {
  if (state.bytes <= limit) return;
  throw dynamics::SimulationError(
      fmt::format("{} panels on the bodies and {} on the surface need {:.2f} GB of memory, but "
                  "{:.2f} GB may be used: take larger panels, fewer frequencies or a higher lowest "
                  "frequency",
                  state.model->body_mesh().size(), state.model->surface_mesh().size(),
                  state.bytes / 1e9, limit / 1e9));
}

}  // namespace

int HydrodynamicProblem::lowered_body() const {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].draughts.size() > 1) return static_cast<int>(b);
  }
  return 0;
}

std::size_t HydrodynamicProblem::state_count() const {
  return std::max<std::size_t>(1, bodies[lowered_body()].draughts.size());
}

HydrodynamicState prepare_state(const HydrodynamicProblem& problem, std::size_t index) {
  HydrodynamicState state;
  const auto modes = static_cast<Eigen::Index>(dynamics::modes_per_body * problem.bodies.size());
  state.mass = Eigen::MatrixXd::Zero(modes, modes);
  for (const HydrodynamicBody& body : problem.bodies) {
    const Pose X_WB = pose_at_rest(body, index);
    const Eigen::Index first =
        dynamics::modes_per_body * static_cast<Eigen::Index>(state.poses.size());
    state.mass.block<6, 6>(first, first) =
        dynamics::make_mass_matrix(body.body.mass, body.radii_of_gyration, X_WB.R);
    state.poses.push_back(X_WB);
  }
  require_apart(problem, state.poses);
  const auto lowered = static_cast<std::size_t>(problem.lowered_body());
  state.draught = -lowest_point(problem.bodies[lowered].hull, state.poses[lowered]);
  std::vector<dynamics::WettedBody> bodies = wetted_bodies(problem, state.poses);
  const auto lines = find_water_lines(bodies);
  const auto length = [&](double frequency) {
    return 2.0 * std::numbers::pi / dynamics::calc_wave_number(frequency, problem.water);
  };
  const dynamics::Symmetry symmetry =
      problem.symmetry ? keep_symmetry(find_symmetry(bodies), problem.lids) : dynamics::Symmetry{};
  const bool with_surface = problem.method == dynamics::PanelMethod::marched_surface;
  dynamics::SurfaceMesh surface;
  surface.mesh.symmetry = symmetry;
  if (with_surface) {
    surface = make_surface_mesh(
        lines, dynamics::surface_settings(lines, length(problem.frequencies.back()),
                                          length(problem.frequencies.front())));
  }
  if (with_surface && surface.mesh.panels.empty()) {
    throw dynamics::ModelError(
        fmt::format("at a draught of {:.6g} m no hull reaches the water's surface, and a hull that "
                    "makes waves is due; give a draught below the hull's depth, or method: green "
                    "function, which computes hulls wholly under water, too",
                    state.draught));
  }
  state.model = std::make_shared<const dynamics::PanelModel>(std::move(bodies), surface,
                                                             problem.water, symmetry);
  if (with_surface) state.groups = find_distant_groups(*state.model, problem.frequencies.back());
  state.settings.frequencies = problem.frequencies;
  state.settings.headings = problem.headings;
  state.settings.lids = problem.lids;
  state.settings.with_coarser = true;
  state.settings.with_far_field = problem.mean_drift;
  state.settings.rankine.memory_limit = problem.memory_limit;
  require_panels(problem, *state.model);
  state.bytes = bytes_by_method(problem.method, *state.model, state.settings);
  refuse_if_too_large(
      state, problem.memory_limit > 0.0 ? problem.memory_limit : dynamics::usable_memory());
  return state;
}

std::string identity_of(const HydrodynamicProblem& problem) {
  ContentHash hash;
  hash.add(std::int64_t{dynamics::panel_method_version});
  hash.add(std::string_view(program_version));
  if (problem.bodies.size() > 1) hash.add(std::int64_t{dynamics::distant_groups_version});
  hash.add(problem.water.density);
  hash.add(problem.water.gravity);
  hash.add(problem.water.depth);
  hash.add(problem.frequencies);
  hash.add(problem.headings);
  add(hash, problem.method);
  hash.add(static_cast<std::int64_t>(problem.symmetry));
  hash.add(std::int64_t{problem.mean_drift ? dynamics::mean_drift_version : 0});
  for (const dynamics::DampingLid& lid : problem.lids) {
    hash.add(std::span(lid.low.data(), 2));
    hash.add(std::span(lid.high.data(), 2));
    hash.add(lid.rate);
  }
  for (const HydrodynamicBody& body : problem.bodies) {
    hash.add(std::string_view(body.name));
    hash.add(body.body.mass);
    add(hash, body.body.p_BoBcm_B);
    add(hash, body.radii_of_gyration);
    hash.add(std::span(body.position.data(), 2));
    hash.add(body.heading);
    hash.add(body.draughts);
    hash.add(static_cast<std::int64_t>(body.as_meshed));
    add(hash, body.hull);
  }
  return hash.digits();
}

dynamics::HydrodynamicDatabase compute_state(const HydrodynamicProblem& problem,
                                             const HydrodynamicState& state) {
  dynamics::HydrodynamicDatabase database =
      compute_by_method(problem.method, *state.model, state.groups, state.settings);
  const Eigen::Index modes = database.mode_count();
  database.hydrostatic_stiffness = Eigen::MatrixXd::Zero(modes, modes);
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) {
    const HydrodynamicBody& body = problem.bodies[b];
    const Pose& X_WB = state.poses[b];
    const dynamics::Hydrostatics rest = calc_hydrostatics(dynamics::HullClusters(body.hull), X_WB);
    const Vector3 p_BoBcm_W = X_WB.R * body.body.p_BoBcm_B;
    database.displaced_volumes[b] = rest.volume;
    database.centres_of_buoyancy.push_back(X_WB.p + rest.p_BoC_W());
    database.centres_of_mass.push_back(X_WB.p + p_BoBcm_W);
    const Eigen::Index first = dynamics::modes_per_body * static_cast<Eigen::Index>(b);
    database.hydrostatic_stiffness.block<6, 6>(first, first) =
        problem.water.density * problem.water.gravity *
        calc_floating_stiffness_over_rho_g(rest, p_BoBcm_W);
  }
  if (problem.mean_drift) {
    database.mean_drift = calc_mean_drift(database, calc_response_amplitudes(database, state.mass),
                                          {}, !problem.lids.empty());
  }
  return database;
}

HydrodynamicFile compute_hydrodynamics(const HydrodynamicProblem& problem,
                                       const std::vector<HydrodynamicState>& states,
                                       const HydrodynamicProgress& progress) {
  std::vector<double> draughts;
  std::vector<dynamics::HydrodynamicDatabase> databases;
  for (HydrodynamicState state : states) {
    state.settings.progress = [&](double fraction, const char* what) {
      const auto done = static_cast<double>(databases.size());
      if (progress) progress((done + fraction) / static_cast<double>(states.size()), what);
    };
    draughts.push_back(state.draught);
    databases.push_back(compute_state(problem, state));
  }
  std::string origin = fmt::format("computed by blocklift {}", program_version);
  if (problem.method == dynamics::PanelMethod::green_function) {
    origin += ", wave Green function";
  }
  for (const HydrodynamicState& state : states) {
    if (const std::string note = note_on_groups(*state.model, state.groups); !note.empty()) {
      origin += "; " + note;
      break;
    }
  }
  return {identity_of(problem), std::move(origin),
          dynamics::make_series(problem.lowered_body(), std::move(draughts), std::move(databases))};
}

}  // namespace blocklift::pipeline

#include "pipeline/hydrodynamics/hydrodynamic_problem.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/mean_drift.h"
#include "dynamics/marine/radiation/response_amplitude.h"
#include "pipeline/files/vessel/hull_places.h"
#include "pipeline/formats/hydrodynamics/hull_hash.h"
#include "pipeline/hydrodynamics/hydrodynamic_report.h"
#include "pipeline/hydrodynamics/panel_cache.h"
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
    X_WB.p.z() = -draught - body.hull->bounds()[0].z();
    return X_WB;
  }
  const dynamics::FloatingPosition floating =
      find_floating_position(dynamics::HullClusters(*body.hull), body.body, R_WB);
  X_WB.R = floating.X_WB.R;
  X_WB.p.z() = floating.X_WB.p.z();
  // What is left of the iteration must not hide a plane of symmetry: turns below 1e-8 are none.
  if ((X_WB.R - R_WB).cwiseAbs().maxCoeff() < 1e-8) X_WB.R = R_WB;
  return X_WB;
}

PanelProblem panel_problem(const HydrodynamicProblem& problem, std::size_t index) {
  PanelProblem panels{problem.settings, {}};
  for (const HydrodynamicBody& body : problem.bodies) {
    panels.bodies.push_back({body.name, body.hull, pose_at_rest(body, index), body.body.p_BoBcm_B});
  }
  return panels;
}

Eigen::MatrixXd mass_matrix(const HydrodynamicProblem& problem, const PanelProblem& panels) {
  const auto modes = static_cast<Eigen::Index>(dynamics::modes_per_body * problem.bodies.size());
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(modes, modes);
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) {
    const HydrodynamicBody& body = problem.bodies[b];
    const Eigen::Index first = dynamics::modes_per_body * static_cast<Eigen::Index>(b);
    mass.block<6, 6>(first, first) =
        dynamics::make_mass_matrix(body.body.mass, body.radii_of_gyration, panels.bodies[b].X_DB.R);
  }
  return mass;
}

/// Above the water and below, which the water lines alone do not tell.
void require_apart(const HydrodynamicProblem& problem, const PanelProblem& panels) {
  std::vector<PlacedHull> hulls;
  for (std::size_t b = 0; b < panels.bodies.size(); ++b) {
    const PanelProblem::Body& body = panels.bodies[b];
    hulls.push_back({"vessel " + body.name, problem.bodies[b].place, body.hull.get(), body.X_DB});
  }
  Diagnostics diagnostics;
  check_hulls_apart(hulls, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
}

void require_panels(const HydrodynamicProblem& problem, const dynamics::PanelModel& model) {
  try {
    require_panels_for_waves(model, problem.settings.frequencies.back());
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
  state.panels = panel_problem(problem, index);
  state.mass = mass_matrix(problem, state.panels);
  require_apart(problem, state.panels);
  const PanelProblem::Body& lowered = state.panels.bodies[problem.lowered_body()];
  state.draught = -lowest_point(*lowered.hull, lowered.X_DB);
  state.model = std::make_shared<const dynamics::PanelModel>(make_panel_model(state.panels));
  const bool with_surface = problem.settings.method == dynamics::PanelMethod::marched_surface;
  if (with_surface && state.model->surface_mesh().size() == 0) {
    throw dynamics::ModelError(
        fmt::format("at a draught of {:.6g} m no hull reaches the water's surface, and a hull that "
                    "makes waves is due; give a draught below the hull's depth, or method: green "
                    "function, which computes hulls wholly under water, too",
                    state.draught));
  }
  if (with_surface)
    state.groups = find_distant_groups(*state.model, problem.settings.frequencies.back());
  state.settings = database_settings(state.panels);
  state.settings.rankine.memory_limit = problem.memory_limit;
  require_panels(problem, *state.model);
  state.bytes = bytes_by_method(problem.settings.method, *state.model, state.settings);
  refuse_if_too_large(
      state, problem.memory_limit > 0.0 ? problem.memory_limit : dynamics::usable_memory());
  return state;
}

std::string identity_of(const HydrodynamicProblem& problem,
                        const std::vector<HydrodynamicState>& states) {
  ContentHash hash;
  hash.add(std::string_view(program_version));
  hash.add(std::int64_t{problem.settings.far_field ? dynamics::mean_drift_version : 0});
  hash.add(std::int64_t{problem.lowered_body()});
  for (const HydrodynamicBody& body : problem.bodies) add(hash, body.body.p_BoBcm_B);
  for (const HydrodynamicState& state : states) {
    hash.add(identity_of(state.panels));
    hash.add(state.draught);
    hash.add(
        std::span<const double>(state.mass.data(), static_cast<std::size_t>(state.mass.size())));
  }
  return hash.digits();
}

namespace {

dynamics::HydrodynamicDatabase compute_panels(const HydrodynamicState& state) {
  return compute_by_method(state.panels.method, *state.model, state.groups, state.settings);
}

/// Puts to what the panel method finds what follows from masses: hydrostatics and mean drift.
void add_masses(const HydrodynamicProblem& problem, const HydrodynamicState& state,
                dynamics::HydrodynamicDatabase& database) {
  const Eigen::Index modes = database.mode_count();
  database.hydrostatic_stiffness = Eigen::MatrixXd::Zero(modes, modes);
  database.centres_of_buoyancy.clear();
  database.centres_of_mass.clear();
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) {
    const HydrodynamicBody& body = problem.bodies[b];
    const Pose& X_WB = state.panels.bodies[b].X_DB;
    const dynamics::Hydrostatics rest = calc_hydrostatics(dynamics::HullClusters(*body.hull), X_WB);
    const Vector3 p_BoBcm_W = X_WB.R * body.body.p_BoBcm_B;
    database.displaced_volumes[b] = rest.volume;
    database.centres_of_buoyancy.push_back(X_WB.p + rest.p_BoC_W());
    database.centres_of_mass.push_back(X_WB.p + p_BoBcm_W);
    const Eigen::Index first = dynamics::modes_per_body * static_cast<Eigen::Index>(b);
    database.hydrostatic_stiffness.block<6, 6>(first, first) =
        problem.settings.water.density * problem.settings.water.gravity *
        calc_floating_stiffness_over_rho_g(rest, p_BoBcm_W);
  }
  if (problem.settings.far_field) {
    database.mean_drift = calc_mean_drift(database, calc_response_amplitudes(database, state.mass),
                                          {}, !problem.settings.lids.empty());
  }
}

/// What `compute` makes of the panels of each state, its progress told, with what follows besides.
HydrodynamicFile make_file(
    const HydrodynamicProblem& problem, const std::vector<HydrodynamicState>& states,
    const HydrodynamicProgress& progress,
    const std::function<dynamics::HydrodynamicDatabase(const HydrodynamicState&)>& compute) {
  std::vector<double> draughts;
  std::vector<dynamics::HydrodynamicDatabase> databases;
  for (HydrodynamicState state : states) {
    state.settings.progress = [&](double fraction, const char* what) {
      const auto done = static_cast<double>(databases.size());
      if (progress) progress((done + fraction) / static_cast<double>(states.size()), what);
    };
    draughts.push_back(state.draught);
    dynamics::HydrodynamicDatabase database = compute(state);
    add_masses(problem, state, database);
    databases.push_back(std::move(database));
  }
  std::string origin = fmt::format("computed by blocklift {}", program_version);
  if (problem.settings.method == dynamics::PanelMethod::green_function) {
    origin += ", wave Green function";
  }
  for (const HydrodynamicState& state : states) {
    if (const std::string note = note_on_groups(*state.model, state.groups); !note.empty()) {
      origin += "; " + note;
      break;
    }
  }
  return {identity_of(problem, states), std::move(origin),
          dynamics::make_series(problem.lowered_body(), std::move(draughts), std::move(databases))};
}

WavesLost find_waves_lost(const HydrodynamicState& state) {
  if (!may_lose_waves(state.panels)) return {};
  return find_lost_coupling(*state.model, state.groups, state.panels.frequencies.back());
}

/// The bodies at the draught of a state, for people.
std::string name_of(const HydrodynamicState& state) {
  std::vector<std::string> names;
  for (const PanelProblem::Body& body : state.panels.bodies) names.push_back(body.name);
  return fmt::format("{} at a draught of {:.3f} m", list_of_names(names), state.draught);
}

}  // namespace

HydrodynamicFile compute_hydrodynamics(const HydrodynamicProblem& problem,
                                       const std::vector<HydrodynamicState>& states,
                                       const HydrodynamicProgress& progress) {
  return make_file(problem, states, progress, compute_panels);
}

HydrodynamicFile find_hydrodynamics(const HydrodynamicProblem& problem,
                                    const std::vector<HydrodynamicState>& states,
                                    const HydrodynamicProgress& progress,
                                    const std::filesystem::path& cache,
                                    const std::function<void(const std::string&)>& say) {
  return make_file(problem, states, progress, [&](const HydrodynamicState& state) {
    const std::string name = name_of(state);
    const DatabaseMaker maker{name,
                              [&] {
                                return FoundDatabase{compute_panels(state), find_waves_lost(state)};
                              },
                              [&] { return find_waves_lost(state); }};
    return find_database(state.panels, maker, cache,
                         [&](const std::string& what) {
                           if (say) say(name + ": " + what);
                         })
        .database;
  });
}

}  // namespace blocklift::pipeline

#include "pipeline/hydrodynamics/given_database.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/marine/loads/resting_wave_force.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;
using Complex = std::complex<double>;

constexpr double largest_difference = 0.05;

[[noreturn]] void refuse(const Mark& mark, const std::string& what, const std::string& hint) {
  Diagnostics diagnostics;
  diagnostics.error(mark, what, {hint});
  throw InputError(diagnostics);
}

double size_of(const dynamics::Hull& hull) {
  const auto [low, high] = hull.bounds();
  return (high - low).norm();
}

/// Does the hull lie where the database's body does, which does not tell its centre of buoyancy?
/// Its stiffness tells the middle of its water plane; without one, its origin must at least be near
/// the reference point, where there are several.
void require_same_water_plane(const RadiationProblem& problem, std::size_t b,
                              const dynamics::Hydrostatics& rest) {
  const HydrodynamicDatabase& database = *problem.given;
  const PanelProblem::Body& body = problem.bodies[b];
  const auto index = static_cast<std::size_t>(problem.given_bodies[b]);
  const Eigen::Vector2d reference = database.reference_points[index].head<2>();
  const double size = size_of(*body.hull);
  const auto fail = [&](const Eigen::Vector2d& difference, const char* what) {
    refuse(problem.place,
           fmt::format("{} of vessel {} lies ({:.4g}, {:.4g}) m from where the database has that "
                       "of its body {}",
                       what, body.name, difference.x(), difference.y(), database.body_names[index]),
           "the database does not tell its bodies' centres of buoyancy: a single vessel's origin "
           "must lie over the database's origin, several vessels where it has them in its own "
           "world, WAMIT's where hydro --import was told by --body-at");
  };
  const Eigen::Index heave = modes_per_body * Eigen::Index{problem.given_bodies[b]} + 2;
  if (database.hydrostatic_stiffness.size() > 0 &&
      database.hydrostatic_stiffness(heave, heave) > 0.0 && rest.water_plane_area > 0.0) {
    const auto C = database.hydrostatic_stiffness.block<1, 3>(heave, heave);
    const Eigen::Vector2d middle = reference + Eigen::Vector2d(-C(2), C(1)) / C(0);
    const Eigen::Vector2d difference =
        body.X_DB.p.head<2>() + rest.water_plane_moment / rest.water_plane_area - middle;
    if (difference.norm() > largest_difference * size) fail(difference, "the water plane");
    return;
  }
  const bool apart = std::any_of(database.reference_points.begin(), database.reference_points.end(),
                                 [&](const Vector3& p) { return p.head<2>() != reference; });
  const Eigen::Vector2d difference = body.X_DB.p.head<2>() - reference;
  if (apart && difference.norm() > size) fail(difference, "the origin");
}

/// Is the hull, as it lies at rest, that of the database's body?
void require_same_hull(const RadiationProblem& problem, std::size_t b) {
  const HydrodynamicDatabase& database = *problem.given;
  const PanelProblem::Body& body = problem.bodies[b];
  const auto index = static_cast<std::size_t>(problem.given_bodies[b]);
  const dynamics::Hull& hull = *body.hull;
  const dynamics::Hydrostatics rest = calc_hydrostatics(dynamics::HullClusters(hull), body.X_DB);
  const double volume = database.displaced_volumes[index];
  if (volume > 0.0 && std::abs(rest.volume - volume) > largest_difference * volume) {
    refuse(problem.place,
           fmt::format("the database's body {} displaces {:.5g} m3, and the hull of vessel {} "
                       "{:.5g} m3 at rest",
                       database.body_names[index], volume, body.name, rest.volume),
           "the database is of another vessel, or the vessel floats at another draught");
  }
  if (database.centres_of_buoyancy.empty()) {
    require_same_water_plane(problem, b, rest);
    return;
  }
  const Vector3 difference = body.X_DB.p + rest.p_BoC_W() - database.centres_of_buoyancy[index];
  if (difference.norm() > largest_difference * size_of(hull)) {
    refuse(problem.place,
           fmt::format("the centre of buoyancy of vessel {} lies ({:.4g}, {:.4g}, {:.4g}) m from "
                       "where the database has that of its body {}",
                       body.name, difference.x(), difference.y(), difference.z(),
                       database.body_names[index]),
           "the vessels must lie to each other as in the database, and be its vessels");
  }
}

/// Modes of the database (rows) in the order of the problem's bodies.
std::vector<Eigen::Index> modes_in_order(const RadiationProblem& problem) {
  std::vector<Eigen::Index> modes;
  for (const int body : problem.given_bodies) {
    for (Eigen::Index m = 0; m < modes_per_body; ++m) {
      modes.push_back(modes_per_body * Eigen::Index{body} + m);
    }
  }
  return modes;
}

template <class Value>
std::vector<Value> in_order(const RadiationProblem& problem, const std::vector<Value>& values) {
  std::vector<Value> result;
  if (values.empty()) return result;
  for (const int body : problem.given_bodies) result.push_back(values[body]);
  return result;
}

HydrodynamicDatabase ordered(const RadiationProblem& problem) {
  HydrodynamicDatabase database = *problem.given;
  const std::vector<Eigen::Index> modes = modes_in_order(problem);
  const auto square = [&](Eigen::MatrixXd& matrix) {
    if (matrix.size() > 0) matrix = Eigen::MatrixXd(matrix(modes, modes));
  };
  for (auto* matrices : {&database.retardation, &database.added_mass, &database.damping}) {
    std::for_each(matrices->begin(), matrices->end(), square);
  }
  for (auto* matrices : {&database.froude_krylov, &database.diffraction}) {
    for (Eigen::MatrixXcd& matrix : *matrices) {
      matrix = Eigen::MatrixXcd(matrix(modes, Eigen::all));
    }
  }
  for (Eigen::MatrixXd& matrix : database.mean_drift) {
    matrix = Eigen::MatrixXd(matrix(modes, Eigen::all));
  }
  database.far_field = {};
  square(database.infinite_added_mass);
  square(database.hydrostatic_stiffness);
  database.change_from_coarser = {};
  database.excitation_change_from_coarser = {};
  database.cut_off_by_end = {};
  database.body_names = in_order(problem, database.body_names);
  database.reference_points = in_order(problem, database.reference_points);
  database.displaced_volumes = in_order(problem, database.displaced_volumes);
  database.centres_of_buoyancy = in_order(problem, database.centres_of_buoyancy);
  database.centres_of_mass = in_order(problem, database.centres_of_mass);
  return database;
}

bool is_whole(const HydrodynamicDatabase& database) {
  return !database.headings.empty() &&
         std::all_of(database.froude_krylov.begin(), database.froude_krylov.end(),
                     [](const Eigen::MatrixXcd& force) { return force.isZero(0.0); });
}

/// What the case will have its hulls in: its own waves, or the database's shortest.
dynamics::WaveField waves_of(const RadiationProblem& problem,
                             const HydrodynamicDatabase& database) {
  if (problem.field && !problem.field->is_still()) return *problem.field;
  return dynamics::WaveField(database.water, {{1.0, database.frequencies.back()}});
}

/// Divides the whole excitation, which stands as diffraction, into the force of the incident wave
/// on the hulls at rest and the rest.
void divide_excitation(const RadiationProblem& problem, HydrodynamicDatabase& database) {
  const dynamics::WaveField waves = waves_of(problem, database);
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < problem.bodies.size(); ++b, first += modes_per_body) {
    const PanelProblem::Body& body = problem.bodies[b];
    const dynamics::RestingWaveForce incident(dynamics::WaveSurface(*body.hull, waves), body.X_DB,
                                              body.X_DB.apply(body.p_BoR_B));
    for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
      for (Eigen::Index h = 0; h < database.froude_krylov[k].cols(); ++h) {
        const Eigen::Matrix<Complex, 6, 1> force =
            incident.calc_force(database.water, database.frequencies[k], database.headings[h]);
        database.froude_krylov[k].block<6, 1>(first, h) = force;
        database.diffraction[k].block<6, 1>(first, h) -= force;
      }
    }
  }
}

}  // namespace

HydrodynamicDatabase take_given_database(const RadiationProblem& problem) {
  if (problem.lowered) {
    refuse(problem.place,
           fmt::format("{} is lowered into the water of vessels that name a database",
                       problem.bodies[problem.lowered->body].name),
           "a database of one draught does not hold it: leave out its draughts, or the database");
  }
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) require_same_hull(problem, b);
  HydrodynamicDatabase database = ordered(problem);
  if (is_whole(database)) divide_excitation(problem, database);
  return database;
}

}  // namespace blocklift::pipeline

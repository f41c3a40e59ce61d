#include "pipeline/formats/hydrodynamics/mirrored_headings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;
using Signs = std::array<double, modes_per_body>;

constexpr double turn_of_waves = 2 * std::numbers::pi, same_heading = 1e-6;
/// Less than what panels of a mesh without that symmetry err by, which is per cents.
constexpr double negligible = 0.01;

/// What the mirror makes of surge, sway, heave, roll, pitch and yaw.
constexpr Signs signs_of_plane(int axis) {
  return axis == 1 ? Signs{1, -1, 1, -1, 1, -1} : Signs{-1, 1, 1, 1, -1, -1};
}

double within_circle(double angle) {
  const double wrapped = angle - turn_of_waves * std::floor(angle / turn_of_waves);
  return wrapped > turn_of_waves - same_heading ? 0.0 : wrapped;
}

double mirrored(double heading, int axis) {
  return within_circle(axis == 1 ? -heading : std::numbers::pi - heading);
}

bool is_known(const std::vector<double>& headings, double angle) {
  return std::any_of(headings.begin(), headings.end(), [&](double heading) {
    const double apart = within_circle(heading - angle);
    return std::min(apart, turn_of_waves - apart) < same_heading;
  });
}

/// Near enough for a vessel that turns in the waves.
bool make_a_turn(std::vector<double> headings) {
  constexpr double widest = std::numbers::pi / 4 + same_heading;
  if (headings.empty()) return false;
  for (double& heading : headings) heading = within_circle(heading);
  std::sort(headings.begin(), headings.end());
  headings.push_back(headings.front() + turn_of_waves);
  for (std::size_t h = 1; h < headings.size(); ++h)
    if (headings[h] - headings[h - 1] > widest) return false;
  return true;
}

/// Does no mode along the plane move another across it?
bool is_uncoupled(const HydrodynamicDatabase& database, const Signs& signs) {
  Eigen::Matrix<double, 6, 6> forces = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double w = database.frequencies[k];
    forces = forces.cwiseMax(
        (database.damping[k].cwiseAbs2() + (w * database.added_mass[k]).cwiseAbs2()).cwiseSqrt());
  }
  for (Eigen::Index i = 0; i < modes_per_body; ++i)
    for (Eigen::Index j = 0; j < modes_per_body; ++j) {
      if (signs[i] == signs[j]) continue;
      if (forces(i, j) > negligible * std::sqrt(forces(i, i) * forces(j, j))) return false;
    }
  return true;
}

/// Do waves along the plane press the body along it alone? Without such waves it is not known.
bool is_pressed_along(const HydrodynamicDatabase& database, int axis, const Signs& signs) {
  std::array<double, 2> across{}, largest{};  // displacements, rotations
  bool found = false;
  for (std::size_t h = 0; h < database.headings.size(); ++h) {
    const double theta = database.headings[h];
    const bool along = std::abs(axis == 1 ? std::sin(theta) : std::cos(theta)) < same_heading;
    found = found || along;
    for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(h);
      const Eigen::VectorXd force =
          (database.froude_krylov[k].col(column) + database.diffraction[k].col(column)).cwiseAbs();
      for (Eigen::Index m = 0; m < modes_per_body; ++m) {
        const std::size_t kind = m < 3 ? 0 : 1;
        largest[kind] = std::max(largest[kind], force[m]);
        if (along && signs[m] < 0) across[kind] = std::max(across[kind], force[m]);
      }
    }
  }
  return found && across[0] <= negligible * largest[0] && across[1] <= negligible * largest[1];
}

bool has_mirror_plane(const HydrodynamicDatabase& database, int axis) {
  const Signs signs = signs_of_plane(axis);
  return std::abs(database.reference_points.front()[axis]) < 1e-6 &&
         is_uncoupled(database, signs) && is_pressed_along(database, axis, signs);
}

/// A heading of the circle: a column, or the mirror image of one.
struct Wave {
  double heading;
  Eigen::Index column;
  bool is_image;
};

template <class Matrix>
void take_columns(const std::vector<Wave>& waves, const Signs& signs, Matrix& forces) {
  const Eigen::Map<const Eigen::VectorXd> mirror(signs.data(), modes_per_body);
  Matrix all(forces.rows(), static_cast<Eigen::Index>(waves.size()));
  for (std::size_t n = 0; n < waves.size(); ++n) {
    auto column = all.col(static_cast<Eigen::Index>(n));
    column = forces.col(waves[n].column);
    if (waves[n].is_image) column.array() *= mirror.array();
  }
  forces = std::move(all);
}

void add_images(int axis, HydrodynamicDatabase& database) {
  std::vector<Wave> waves;
  for (std::size_t h = 0; h < database.headings.size(); ++h) {
    const double heading = database.headings[h], image = mirrored(heading, axis);
    const auto column = static_cast<Eigen::Index>(h);
    waves.push_back({within_circle(heading), column, false});
    if (!is_known(database.headings, image)) waves.push_back({image, column, true});
  }
  std::stable_sort(waves.begin(), waves.end(),
                   [](const Wave& a, const Wave& b) { return a.heading < b.heading; });
  // -180 and 180 degrees are one.
  waves.erase(std::unique(waves.begin(), waves.end(),
                          [](const Wave& a, const Wave& b) {
                            return b.heading - a.heading < same_heading;
                          }),
              waves.end());
  const Signs signs = signs_of_plane(axis);
  for (auto* forces : {&database.froude_krylov, &database.diffraction})
    for (Eigen::MatrixXcd& X : *forces) take_columns(waves, signs, X);
  for (Eigen::MatrixXd& drift : database.mean_drift) take_columns(waves, signs, drift);
  database.headings.clear();
  for (const Wave& wave : waves) database.headings.push_back(wave.heading);
}

}  // namespace

std::string mirror_headings(HydrodynamicDatabase& database) {
  const std::vector<double>& headings = database.headings;
  const auto is_angle = [](double heading) {
    return std::abs(heading) < turn_of_waves + same_heading;
  };
  // Beyond, degrees may have been read as radians.
  if (database.body_count() != 1 || make_a_turn(headings) ||
      !std::all_of(headings.begin(), headings.end(), is_angle))
    return {};
  HydrodynamicDatabase whole = database;
  std::string planes;
  for (const auto& [axis, name] : {std::pair{1, "y = 0"}, {0, "x = 0"}}) {
    if (!has_mirror_plane(whole, axis)) return {};
    add_images(axis, whole);
    planes += (planes.empty() ? "" : " and ") + std::string(name);
    if (!make_a_turn(whole.headings)) continue;
    database = std::move(whole);
    return planes;
  }
  return {};
}

}  // namespace blocklift::pipeline

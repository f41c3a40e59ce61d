#include "structure/practice/stiffener_chains.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "structure/formulation/beam.h"
#include "structure/stress/beam_stress.h"

namespace blocklift::structure {

namespace {

const double goes_on_cosine = std::cos(std::numbers::pi / 6);
constexpr double most_turn = std::numbers::pi / 4;  // of a curved stiffener between supports
constexpr double support_ratio = 5;                 // of second moments

Vector3 corner(const Mesh& mesh, const Shell& shell, std::size_t number) {
  return mesh.vertices[shell.vertices[number]];
}

Vector3 middle_of(const Mesh& mesh, const Shell& shell) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += corner(mesh, shell, i);
  return sum / 4;
}

/// d/dxi x d/deta in the middle.
Vector3 normal_of(const Mesh& mesh, const Shell& shell) {
  const Vector3 along = corner(mesh, shell, 1) - corner(mesh, shell, 0);
  const Vector3 across = (corner(mesh, shell, 2) + corner(mesh, shell, 3)) -
                         (corner(mesh, shell, 0) + corner(mesh, shell, 1));
  return along.cross(across).normalized();
}

class StiffenerFinder {
 public:
  StiffenerFinder(const Mesh& mesh, const MeetingPoints& points) : mesh_(mesh), points_(points) {}

  PlateAlong plate_along(const Beam& beam) const {
    const std::vector<int> cells = points_.common_cells(beam.vertices[0], beam.vertices[1]);
    if (beam.is_rod || cells.size() != 2 || cells[1] >= static_cast<int>(mesh_.shells.size()))
      return {};
    const Vector3 e_1 = reach_of(mesh_, beam).normalized();
    const Vector3 middle = mesh_.vertices[beam.vertices[0]] + reach_of(mesh_, beam) / 2;
    const auto side = [&](int shell) {
      const Vector3 off = middle_of(mesh_, mesh_.shells[shell]) - middle;
      return Vector3((off - e_1 * e_1.dot(off)).normalized());
    };
    const Vector3 one = side(cells[0]), other = side(cells[1]);
    if (one.dot(other) > -goes_on_cosine) return {};
    return {{cells[0], cells[1]}, e_1.cross((one - other).normalized()).normalized()};
  }

  /// Is the plate of a beam held at one of its vertices?
  bool is_supported(int beam, const PlateAlong& plate, int vertex) const {
    for (const int cell : points_.cells(vertex)) {
      if (cell >= static_cast<int>(mesh_.shells.size())) return true;
      if (std::abs(normal_of(mesh_, mesh_.shells[cell]).dot(plate.normal)) < goes_on_cosine)
        return true;
    }
    const std::vector<int>& beams = points_.beams(vertex);
    return std::any_of(beams.begin(), beams.end(), [&](int other) {
      return holds(mesh_.beams[other], mesh_.beams[beam], plate.normal);
    });
  }

 private:
  bool holds(const Beam& crossing, const Beam& beam, const Vector3& normal) const {
    const Vector3 direction = reach_of(mesh_, crossing).normalized();
    if (std::abs(direction.dot(normal)) > 0.5) return true;
    if (std::abs(direction.dot(reach_of(mesh_, beam).normalized())) > goes_on_cosine) return false;
    return stiffness_of(crossing, normal) >= support_ratio * stiffness_of(beam, normal);
  }

  /// Second moment about the plate, m^4.
  double stiffness_of(const Beam& beam, const Vector3& normal) const {
    const StiffenerSection section = stiffener_section(mesh_, beam, normal, 0);
    return section.second_moment + section.area * section.height * section.height;
  }

  const Mesh& mesh_;
  const MeetingPoints& points_;
};

}  // namespace

StiffenerChains find_stiffeners(const Mesh& mesh, const MeetingPoints& points) {
  const StiffenerFinder finder(mesh, points);
  StiffenerChains stiffeners;
  std::vector<int> beams;
  for (std::size_t b = 0; b < mesh.beams.size(); ++b) {
    stiffeners.plates.push_back(finder.plate_along(mesh.beams[b]));
    if (stiffeners.plates.back().shells[0] >= 0) beams.push_back(static_cast<int>(b));
  }
  stiffeners.chains =
      find_bar_chains(mesh, points, beams, most_turn, [&](int beam, int /*next*/, int vertex) {
        return !finder.is_supported(beam, stiffeners.plates[beam], vertex);
      });
  return stiffeners;
}

StiffenerSection stiffener_section(const Mesh& mesh, const Beam& beam, const Vector3& normal,
                                   double share) {
  const BeamSection section = section_at(mesh, beam, share);
  const Vector3 e_1 = reach_of(mesh, beam).normalized();
  const Vector3 e_2 = (beam.axis_2 - e_1 * e_1.dot(beam.axis_2)).normalized();
  const double n_2 = normal.dot(e_2), n_3 = normal.dot(e_1.cross(e_2));
  StiffenerSection seen;
  seen.area = section.area;
  seen.height = normal.dot((1 - share) * beam.offset[0] + share * beam.offset[1]);
  seen.second_moment = n_2 * n_2 * section.second_moment_3 + n_3 * n_3 * section.second_moment_2 +
                       2 * n_2 * n_3 * section.product_23;
  seen.lowest = seen.highest = seen.height;
  for (const Eigen::Vector2d& point : stress_points(section)) {
    const double height = seen.height + n_2 * point.x() + n_3 * point.y();
    seen.lowest = std::min(seen.lowest, height);
    seen.highest = std::max(seen.highest, height);
  }
  return seen;
}

TrippingSection tripping_section(const Mesh& mesh, const Beam& beam, const Vector3& normal,
                                 double plate_height, double share) {
  const BeamSection section = section_at(mesh, beam, share);
  const StiffenerSection seen = stiffener_section(mesh, beam, normal, share);
  const Vector3 e_1 = reach_of(mesh, beam).normalized();
  const Vector3 e_2 = (beam.axis_2 - e_1 * e_1.dot(beam.axis_2)).normalized();
  const Vector3 shear_centre =
      section.shear_centre[0] * e_2 + section.shear_centre[1] * e_1.cross(e_2);
  const Vector3 offset = (1 - share) * beam.offset[0] + share * beam.offset[1];
  const double toe = seen.height >= plate_height ? seen.lowest : seen.highest;
  const double rise = seen.height - toe, aside = offset.dot(e_1.cross(normal));
  const double both = section.second_moment_2 + section.second_moment_3;
  TrippingSection tripping;
  tripping.torsion = section.torsion;
  tripping.polar_moment = both + section.area * (rise * rise + aside * aside);
  tripping.shear_height = rise + normal.dot(shear_centre);
  tripping.second_moment = both - seen.second_moment;
  return tripping;
}

double plate_height(const Mesh& mesh, const Shell& shell, const Vector3& normal) {
  const double side = normal_of(mesh, shell).dot(normal) < 0 ? -1 : 1;
  return side * mesh.section_of(shell).offset;
}

}  // namespace blocklift::structure

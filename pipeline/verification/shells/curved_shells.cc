#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "pipeline/verification/shells/shell_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

using RefinedRun = std::tuple<int, int, double>;  // degree, cells a side, tolerance

std::vector<VerificationRow> rows_of(const char* what, const char* unit, double reference,
                                     const std::vector<RefinedRun>& runs,
                                     double (*compute)(int, int)) {
  std::vector<VerificationRow> rows;
  for (const auto& [degree, cells, tolerance] : runs)
    rows.push_back(
        compare(fmt::format("{}, {} x {} cells of degree {}", what, cells, cells, degree), unit,
                reference, compute(degree, cells), tolerance * reference));
  return rows;
}

// A quarter of the roof: symmetry at x = 0 and y = 0, diaphragm at y = 25.
double roof(int degree, int cells) {
  constexpr double radius = 25, half = 25, angle = 40 * M_PI / 180;
  const Mesh mesh = examples::sheet_mesh(
      [](double x, double y) {
        return Vector3(radius * std::sin(angle * x), half * y, radius * std::cos(angle * x));
      },
      cells, cells, 0.25, {"concrete", 4.32e8, 0, 0, 1}, degree);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 4, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() > half - 1e-9; }, {0, 2}, fixed);
  const Eigen::VectorXd motion = examples::solve(space,
                                                 examples::area_load(space,
                                                                     [](const Vector3&) -> Vector3 {
                                                                       return {0, 0, -90};
                                                                     }),
                                                 fixed);
  const Vector3 edge(radius * std::sin(angle), 0, radius * std::cos(angle));
  return -examples::displacement_at(space, motion, edge).z();
}

// The published 0.3024 is that of shallow shells' theory; finer meshes of all degrees tend to
// 0.3012.
VerificationCase scordelis_lo() {
  return {.name = "scordelis-lo-roof",
          .stage = "structure",
          .source =
              "Scordelis and Lo (1964), ACI Journal 61: 0.3024; 0.3012 by finer meshes of this and "
              "other programs (MacNeal and Harder 1985 accept 0.3024)",
          .compute = [] {
            return rows_of("deflection of the free edge", "1", 0.3012,
                           {{1, 16, 5e-3},
                            {2, 4, 5e-3},
                            {2, 8, 3e-3},
                            {3, 2, 3e-3},
                            {3, 4, 1e-3},
                            {3, 8, 1e-3},
                            {4, 2, 2e-3},
                            {4, 4, 1e-3}},
                           roof);
          }};
}

// An eighth of the cylinder, a quarter of the load.
double cylinder(int degree, int cells) {
  constexpr double radius = 300, half = 300;
  const Mesh mesh = examples::sheet_mesh(
      [](double x, double y) {
        return Vector3(radius * std::sin(M_PI / 2 * x), half * y, radius * std::cos(M_PI / 2 * x));
      },
      cells, cells, 3, {"unit", 3e6, 0.3, 0, 1}, degree);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-6; }, {0, 4, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.z() < 1e-6; }, {2, 3, 4}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() < 1e-6; }, {1, 3, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() > half - 1e-6; }, {0, 2}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  const int node = examples::nearest_node(space, Vector3(0, 0, radius));
  load[6 * node + 2] = -0.25;
  return -examples::solve(space, load, fixed)[6 * node + 2];
}

// Shear deformation under the point load, which the published thin shell has not, adds 1 % and,
// with ever smaller cells, more without a limit.
VerificationCase pinched_cylinder() {
  return {.name = "pinched-cylinder",
          .stage = "structure",
          .source = "Belytschko et al. (1985), Comput. Methods Appl. Mech. Eng. 51: 1.8248e-5",
          .compute = [] {
            return rows_of("deflection under the load", "1", 1.8248e-5,
                           {{1, 32, 0.015},
                            {2, 4, 0.06},
                            {2, 8, 0.01},
                            {2, 16, 0.015},
                            {3, 4, 0.02},
                            {3, 8, 0.015},
                            {4, 4, 0.015}},
                           cylinder);
          }};
}

// An octant of a sphere as three patches about its middle; a quarter of the hemisphere. Unit loads
// outward along x and inward along y at the rim.
double closed_hemisphere(int degree, int cells) {
  constexpr double radius = 10;
  Mesh mesh = examples::empty_mesh({"unit", 68.25e9, 0.3, 0, 1}, 0.04);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 a = Vector3::Unit(axis), b = Vector3::Unit((axis + 1) % 3),
                  c = Vector3::Unit((axis + 2) % 3);
    examples::add_sheet(
        mesh,
        [&](double x, double y) -> Vector3 {
          // Angles grow evenly along the octant's edges.
          const double s = std::tan(M_PI / 4 * x), t = std::tan(M_PI / 4 * y);
          return radius * (a + s * b + t * c).normalized();
        },
        cells, cells, degree);
  }
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 4, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.z() > radius - 1e-9; }, {2}, fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  const int out = examples::nearest_node(space, {radius, 0, 0});
  load[6 * out] = 2000;
  load[6 * examples::nearest_node(space, {0, radius, 0}) + 1] = -2000;
  return examples::solve(space, load, fixed)[6 * out];
}

VerificationCase nafems_le3() {
  return {
      .name = "nafems-le3",
      .stage = "structure",
      .source = "NAFEMS (1990), The standard NAFEMS benchmarks, LE3: 0.185 m",
      .compute = [] {
        return rows_of(
            "displacement under the load (a patch's sides)", "m", 0.185,
            {{1, 16, 0.03}, {2, 4, 0.03}, {2, 8, 0.01}, {3, 2, 0.03}, {3, 4, 0.01}, {4, 2, 0.02}},
            closed_hemisphere);
      }};
}

// With a hole of 18 degrees about the pole.
double open_hemisphere(int degree, int cells) {
  constexpr double radius = 10;
  const Mesh mesh = examples::sheet_mesh(
      [&](double x, double y) -> Vector3 {
        const double longitude = M_PI / 2 * x, latitude = 72 * M_PI / 180 * y;
        return radius * Vector3(std::cos(latitude) * std::cos(longitude),
                                std::cos(latitude) * std::sin(longitude), std::sin(latitude));
      },
      cells, cells, 0.04, {"unit", 6.825e7, 0.3, 0, 1}, degree);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 4, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
  const int out = examples::nearest_node(space, {radius, 0, 0});
  examples::hold(
      space, [&](const Vector3& p) { return (p - space.nodes().col(out)).norm() < 1e-9; }, {2},
      fixed);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.freedoms());
  load[6 * out] = 1;
  load[6 * examples::nearest_node(space, {0, radius, 0}) + 1] = -1;
  return examples::solve(space, load, fixed)[6 * out];
}

VerificationCase hemisphere_with_hole() {
  return {
      .name = "hemisphere-with-hole",
      .stage = "structure",
      .source = "MacNeal and Harder (1985): 0.0940; Simo, Fox, Rifai (1989): 0.0935 by fine meshes",
      .compute = [] {
        return rows_of("displacement under the load", "1", 0.0935,
                       {{1, 16, 0.02}, {2, 4, 0.03}, {2, 8, 0.01}, {3, 4, 0.01}, {4, 4, 0.01}},
                       open_hemisphere);
      }};
}

// Two arcs of a strip 20 wide and 2 thick, of radii 14 over 60 degrees and 46 over 150, that bend
// opposite ways; clamped at the first's end, a unit shear force along the strip's width at the
// other's.
double hook(int degree, int cells, int order) {
  constexpr double width = 20;
  Mesh mesh = examples::empty_mesh({"unit", 3300, 0.35, 0, 1}, 2);
  const Vector3 first_centre(14, 0, 0);
  const double turn = 60 * M_PI / 180;
  const Vector3 joint = first_centre + 14 * Vector3(-std::cos(turn), std::sin(turn), 0);
  const Vector3 second_centre = joint + 46 * Vector3(-std::cos(turn), std::sin(turn), 0);
  const auto tip_side = [&](double angle) -> Vector3 {
    // From the joint on the second circle turns the other way.
    return second_centre + 46 * Vector3(std::cos(turn - angle), -std::sin(turn - angle), 0);
  };
  examples::add_sheet(
      mesh,
      [&](double x, double y) -> Vector3 {
        const double a = turn * x;
        return first_centre + 14 * Vector3(-std::cos(a), std::sin(a), 0) +
               width * y * Vector3::UnitZ();
      },
      cells, cells, order);
  examples::add_sheet(
      mesh,
      [&](double x, double y) -> Vector3 {
        return tip_side(150 * M_PI / 180 * x) + width * y * Vector3::UnitZ();
      },
      3 * cells, cells, order);
  const Space space(mesh, {degree, {}});
  const Vector3 tip = tip_side(150 * M_PI / 180);
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return Vector3(p.x(), p.y(), 0).norm() < 1e-6; },
      {0, 1, 2, 3, 4, 5}, fixed);
  const auto at_tip = [&](const Vector3& p) { return Vector3(p - tip).head<2>().norm() < 1e-6; };
  const Eigen::VectorXd load = examples::edge_load(space, at_tip, [](const Vector3&) -> Vector3 {
    return {0, 0, 1 / width};
  });
  // Work over the load: the mean along the edge.
  return examples::solve(space, load, fixed).dot(load);
}

VerificationCase raaschs_hook() {
  return {
      .name = "raasch-hook",
      .stage = "structure",
      .source = "Knight (1997), AIAA Journal 35, The Raasch challenge for shell elements: 4.9352",
      .compute = [] {
        std::vector<VerificationRow> rows =
            rows_of("deflection of the tip along the load", "1", 4.9352,
                    {{2, 2, 0.03}, {2, 4, 0.03}, {3, 2, 0.03}, {3, 4, 0.03}},
                    [](int degree, int cells) { return hook(degree, cells, degree); });
        // At the kinks between flat ones a twisting moment turns into drilling.
        const std::vector<VerificationRow> of_facets =
            rows_of("deflection of the hook of flat facets", "1", 4.9352,
                    {{1, 8, 0.03}, {2, 8, 0.03}, {3, 8, 0.03}},
                    [](int degree, int cells) { return hook(degree, cells, 1); });
        rows.insert(rows.end(), of_facets.begin(), of_facets.end());
        return rows;
      }};
}

// A quarter of a cylinder, radius 1 m, 25 mm thick, and of a zone of the hemisphere that closes it,
// under 1 MPa. The zone ends at 60 degrees of latitude, where the force of the membrane holds it.
class ClosedCylinder {
 public:
  /// @param cells in a quarter of the wave (pi / 4 over beta) by which the edge's bending fades
  ClosedCylinder(int degree, int cells)
      : mesh_(examples::empty_mesh(examples::plain_steel(), thickness)) {
    const double length = 10 * wave, latitude = M_PI / 3;
    examples::add_sheet(
        mesh_,
        [&](double x, double y) -> Vector3 {
          return {std::cos(M_PI / 2 * x), std::sin(M_PI / 2 * x), -length * y};
        },
        around, 10 * cells, degree);
    examples::add_sheet(
        mesh_, [&](double x, double y) -> Vector3 { return on_sphere(M_PI / 2 * x, latitude * y); },
        around, 10 * cells, degree);
    space_ = std::make_unique<Space>(mesh_, Resolution{degree, {}});
    std::vector<FixedUnknown> fixed;
    examples::hold(
        *space_, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 4, 5}, fixed);
    examples::hold(
        *space_, [](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
    examples::hold(
        *space_, [&](const Vector3& p) { return p.z() < 1e-9 - length; }, {2, 3, 4}, fixed);
    const Eigen::VectorXd load =
        examples::area_load(*space_,
                            [](const Vector3& p) -> Vector3 {
                              return Vector3(p.x(), p.y(), std::max(0.0, p.z())).normalized();
                            }) +
        examples::edge_load(
            *space_, [&](const Vector3& p) { return p.z() > std::sin(latitude) - 1e-9; },
            [&](const Vector3& p) -> Vector3 {
              return on_sphere(std::atan2(p.y(), p.x()), latitude + M_PI / 2) / 2;
            });
    motion_ = examples::solve(*space_, load, fixed);
  }

  /// Stress outside, over p R / t, so many quarters of the wave below the joint: along the axis,
  /// around it.
  Eigen::Vector2d stress(int quarters) const {
    const Vector3 place(1, 0, -quarters * wave);
    // The outer face is that on which the stress along the axis is larger: bulged outwards.
    Eigen::Vector2d largest = Eigen::Vector2d::Zero();
    for (const double z : {-thickness / 2, thickness / 2}) {
      const Eigen::Matrix3d s = examples::stress_at(*space_, motion_, place, z);
      if (s(2, 2) > largest[0]) largest = {s(2, 2), s(1, 1)};
    }
    return thickness * largest;
  }

  /// The same in closed form, of thin shells.
  static Eigen::Vector2d exact(int quarters) {
    const double x = M_PI / 4 * quarters, factor = 3 / (4 * std::sqrt(3 * (1 - nu * nu))),
                 bending = factor * std::exp(-x) * std::sin(x);
    return {0.5 + bending, 1 - std::exp(-x) * std::cos(x) / 4 + nu * bending};
  }

 private:
  static constexpr double thickness = 0.025, nu = 0.3;
  static constexpr int around = 4;
  // beta^4 = 3 (1 - nu^2) / (R t)^2
  inline static const double wave = M_PI / 4 * std::sqrt(thickness / std::sqrt(3 * (1 - nu * nu)));

  static Vector3 on_sphere(double longitude, double latitude) {
    return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
            std::sin(latitude)};
  }

  Mesh mesh_;
  std::unique_ptr<Space> space_;
  Eigen::VectorXd motion_;
};

// NAFEMS' LE7 asks for the same: 25.86 MPa along the axis of 20 MPa, 0.6465 p R / t. Thin shells
// leave out half of t / R, 1.25 %, at the outer face: elements of degree 3 have 1.2 % more around
// the axis, 0.2 to 0.5 % along it.
VerificationCase closed_cylinder() {
  return {.name = "cylinder-closed-by-hemisphere",
          .stage = "structure",
          .source =
              "Timoshenko and Woinowsky-Krieger (1959), Theory of plates and shells, pressure "
              "vessels: 1.293 p R / (2 t); NAFEMS (1990), LE7: 25.86 MPa",
          .compute = [] {
            std::vector<VerificationRow> rows;
            for (const auto& [degree, cells] : {std::pair{2, 2}, {3, 1}, {3, 2}}) {
              const ClosedCylinder vessel(degree, cells);
              for (const int quarters : {1, 2})
                for (const int way : {0, 1}) {
                  const double exact = ClosedCylinder::exact(quarters)[way];
                  rows.push_back(compare(
                      fmt::format("stress {} the axis outside, at beta x = {} pi / 4, {} cells of "
                                  "degree {} on that length",
                                  way == 0 ? "along" : "around", quarters, cells, degree),
                      "p R / t", exact, vessel.stress(quarters)[way], 0.015 * exact));
                }
            }
            return rows;
          }};
}

}  // namespace

std::vector<VerificationCase> curved_shell_cases() {
  return {scordelis_lo(),         pinched_cylinder(), nafems_le3(),
          hemisphere_with_hole(), closed_cylinder(),  raaschs_hook()};
}

}  // namespace blocklift::pipeline

#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "pipeline/verification/shells/shell_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

// A box of wide flanges in bending: 10 m between diaphragms, 4 x 1.2 m, a line load q sin(pi x / L)
// on each web, half of it at its upper and half at its lower edge.
struct BoxGirder {
  static constexpr double length = 10, half_width = 2, half_height = 0.6;
  static constexpr double flange = 0.012, web = 0.010, load = 1e4;
};

struct BoxFigures {
  double deflection = 0;  ///< of the upper edge of a web at midspan, downwards, m
  double at_web = 0;      ///< stress along the girder at midspan, mean of flange and web, Pa
  double at_middle = 0;   ///< the same stress in the middle of the flange, Pa
};

// Plane stress in flanges and webs that meet along their edges, without bending of the plates
// (folded plates). With a = pi / L, stress functions
//   flange  sin(a x) B (a y sh a y - a b th a b ch a y)   (no lateral pull at its edges y = +-b),
//   web     sin(a x) (G sh a z + H a z ch a z)            (odd about its middle),
// and at the edge z = h of the web the load, one shear flow and one strain in both plates.
BoxFigures folded_plates() {
  using B = BoxGirder;
  const Material steel = examples::plain_steel();
  const double a = M_PI / B::length, nu = steel.poisson_ratio, e = steel.youngs_modulus;
  const double b = a * B::half_width, h = a * B::half_height;
  const double sh = std::sinh(h), ch = std::cosh(h);
  // Rows: load, shear flow, strain; columns B, G, H.
  Eigen::Matrix3d equations;
  equations << 0, -sh, -h * ch,                                                            //
      B::flange * (std::sinh(b) + b / std::cosh(b)), B::web * ch, B::web * (ch + h * sh),  //
      2 * std::cosh(b), -(1 + nu) * sh, -(2 * sh + (1 + nu) * h * ch);
  const Eigen::Vector3d right(-B::load / 2 / B::web / (a * a), 0, 0);
  const Eigen::Vector3d found = equations.colPivHouseholderQr().solve(right);
  const double f = found[0], g = found[1], k = found[2];
  BoxFigures figures;
  // One strain along both: the web's lateral stress -q / (2 t) is felt in its own stress alone.
  figures.at_web = a * a * f * 2 * std::cosh(b) - nu * B::load / (2 * B::web) / 2;
  figures.at_middle = a * a * f * (2 - b * std::tanh(b));
  // w,x = gamma - u,z with u = -strain / a.
  const double slope_of_strain =
      a * a * a / e * (g * ch + k * (3 * ch + h * sh) + nu * (g * ch + k * (ch + h * sh)));
  const double shear = -2 * (1 + nu) / e * a * a * (g * ch + k * (ch + h * sh));
  figures.deflection = -(shear + slope_of_strain / a) / a;
  return figures;
}

// Half the length and half the width.
BoxFigures box_of_shells(int degree, int along) {
  using B = BoxGirder;
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), B::flange);
  mesh.shell_sections.push_back({B::web, 0, 0});
  const double half = B::length / 2;
  for (const double z : {-B::half_height, B::half_height})
    examples::add_sheet(
        mesh,
        [&](double x, double y) -> Vector3 {
          return {half * x, B::half_width * y, z};
        },
        along, along);
  examples::add_sheet(
      mesh,
      [&](double x, double y) -> Vector3 {
        return {half * x, B::half_width, B::half_height * (2 * y - 1)};
      },
      along, along, 1, 1);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {1, 2, 3}, fixed);
  examples::hold(
      space, [&](const Vector3& p) { return p.x() > half - 1e-9; }, {0, 4, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
  const Eigen::VectorXd load = examples::edge_load(
      space,
      [](const Vector3& p) {
        return p.y() > B::half_width - 1e-9 && std::abs(p.z()) > B::half_height - 1e-9;
      },
      [](const Vector3& p) -> Vector3 {
        return {0, 0, -B::load / 2 * std::sin(M_PI * p.x() / B::length)};
      });
  // Each edge of a corner is one of two cells: the flange's and the web's.
  const Eigen::VectorXd motion = examples::solve(space, load / 2, fixed);
  const Vector3 corner(half, B::half_width, B::half_height), middle(half, 0, B::half_height);
  return {-examples::displacement_at(space, motion, corner).z(),
          examples::stress_at(space, motion, corner, 0)(0, 0),
          examples::stress_at(space, motion, middle, 0)(0, 0)};
}

// The plates' own bending, which folded plates leave out, is 1e-4 of the girder's.
VerificationCase box_in_bending() {
  return {.name = "box-bending",
          .stage = "structure",
          .source =
              "plane stress of flanges and webs in closed form (shear lag of folded plates; "
              "Timoshenko and Goodier, Theory of elasticity, article 24)",
          .compute = [] {
            std::vector<VerificationRow> rows;
            const BoxFigures theory = folded_plates();
            for (const auto& [degree, along, tolerance] :
                 {std::tuple{2, 4, 0.02}, {2, 8, 5e-3}, {3, 4, 5e-3}, {3, 8, 2e-3}}) {
              const BoxFigures found = box_of_shells(degree, along);
              const auto row = [&, d = degree, n = along, t = tolerance](
                                   const char* what, const char* unit, double reference,
                                   double computed) {
                rows.push_back(compare(fmt::format("{}, {} x {} cells of degree {}", what, n, n, d),
                                       unit, reference, computed, t * std::abs(reference)));
              };
              row("deflection of the web", "m", theory.deflection, found.deflection);
              row("stress along the edge of flange and web", "Pa", theory.at_web, found.at_web);
              row("stress in the middle of the flange", "Pa", theory.at_middle, found.at_middle);
            }
            return rows;
          }};
}

}  // namespace

std::vector<VerificationCase> box_girder_cases() { return {box_in_bending()}; }

}  // namespace blocklift::pipeline

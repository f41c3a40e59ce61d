#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "pipeline/verification/shells/shell_cases.h"
#include "structure/formulation/shell.h"
#include "structure/system/assembly.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

// Stiffness with the drilling part taken so many times.
SparseLower stiffness_with_drilling(const Space& space, double factor) {
  return assemble(space, [&space, factor]() -> ElementMatrix {
    struct Worker {
      explicit Worker(const Space& of)
          : space(of),
            rule(square_rule(of.degree() + 1)),
            whole(of),
            strains(of, rule.topRows<2>()) {}
      const Space& space;
      Eigen::Matrix3Xd rule;
      ShellStiffness whole;
      ShellOperator strains;
      Eigen::MatrixXd result;
    };
    const auto worker = std::make_shared<Worker>(space);
    return [worker, factor](int element) -> const Eigen::MatrixXd& {
      Worker& own = *worker;
      own.result = own.whole(element);
      own.strains.reinit(element);
      const Mesh& mesh = own.space.mesh();
      const Shell& shell = mesh.shells[own.space.shells()[element].shell];
      const double stiffness = shell_stiffness_law(
          mesh.material_of(shell), mesh.section_of(shell).thickness)(drilling, drilling);
      for (Eigen::Index q = 0; q < own.rule.cols(); ++q) {
        const ShellPoint& point = own.strains.points()[q];
        const Eigen::RowVectorXd row = point.strain.row(drilling);
        own.result +=
            (factor - 1) * own.rule(2, q) * point.area * stiffness * row.transpose() * row;
      }
      return own.result;
    };
  });
}

Eigen::VectorXd solve_with_drilling(const Space& space, const Eigen::VectorXd& load,
                                    const std::vector<FixedUnknown>& fixed, double factor) {
  if (factor == 1) return examples::solve(space, load, fixed);
  ConstrainedSystem system(stiffness_with_drilling(space, factor), fixed);
  system.factorise();
  return space.expand(system.solve(space.reduce(load)));
}

void clamp_root(const Space& space, std::vector<FixedUnknown>& fixed) {
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 1, 2, 3, 4, 5}, fixed);
}

// A flat of a section: from a to b in the plane across x, as long as the girder.
void add_flat(Mesh& mesh, double length, const Vector3& a, const Vector3& b, int along, int across,
              int section = 0) {
  examples::add_sheet(
      mesh,
      [&](double x, double y) -> Vector3 {
        return length * x * Vector3::UnitX() + a + y * (b - a);
      },
      along, across, 1, section);
}

BeamSection flat_bar(double height, double thickness) {
  BeamSection bar;  // upright: axis 2 along y, axis 3 along z
  bar.area = height * thickness;
  bar.second_moment_2 = thickness * std::pow(height, 3) / 12;
  bar.second_moment_3 = height * std::pow(thickness, 3) / 12;
  bar.torsion = height * std::pow(thickness, 3) / 3;
  bar.shear_area_2 = bar.shear_area_3 = 5.0 / 6 * bar.area;
  return bar;
}

// --- A tee: plate of 0.3 x 0.01 with a web of 0.2 x 0.012 below its mid-surface, 3 m, clamped,
// loaded at its end. The web is a sheet, or a beam beside the plate.
struct Tee {
  static constexpr double length = 3, width = 0.3, t = 0.01, height = 0.2, web = 0.012;
  static double deflection(bool as_beam, int degree) {
    Mesh mesh = examples::empty_mesh({"steel", 210e9, 0, 7850, 355e6}, t);
    mesh.shell_sections.push_back({web, 0, 0});
    add_flat(mesh, length, {0, -width / 2, 0}, {0, width / 2, 0}, 6, 2);
    if (as_beam) {
      mesh.beam_sections = {flat_bar(height, web)};
      examples::add_beams(mesh, {0, 0, 0}, {length, 0, 0}, 0, Vector3::UnitY(),
                          {0, 0, -height / 2});
    } else {
      add_flat(mesh, length, {0, 0, -height}, {0, 0, 0}, 6, 2, 1);
    }
    const Space space(mesh, {degree, {}});
    std::vector<FixedUnknown> fixed;
    clamp_root(space, fixed);
    const Eigen::VectorXd load = examples::edge_load(
        space, [](const Vector3& p) { return p.x() > length - 1e-9 && std::abs(p.z()) < 1e-9; },
        [](const Vector3&) -> Vector3 {
          return {0, 0, -1000 / width};
        });
    // At the web: the flange bends across it under what acts on its end.
    return -examples::displacement_at(space, examples::solve(space, load, fixed), {length, 0, 0})
                .z();
  }
  // Bending about the common centroid, shear by the web alone.
  static double theory() {
    const double plate = width * t, bar = height * web, e = 210e9;
    const double second = width * std::pow(t, 3) / 12 + web * std::pow(height, 3) / 12 +
                          plate * bar / (plate + bar) * std::pow(height / 2, 2);
    return 1000 * (std::pow(length, 3) / (3 * e * second) + length / (e / 2 * bar));
  }
};

VerificationCase tee_beam() {
  return {
      .name = "tee-beam",
      .stage = "structure",
      .source = "Bernoulli's and Timoshenko's beam of the composed section",
      .compute = [] {
        std::vector<VerificationRow> rows;
        const double theory = Tee::theory();
        for (const int degree : {2, 3}) {
          // The web bears shear as some 1 % of the deflection, known to a fifth; the flange lags by
          // as little.
          const double beam = Tee::deflection(true, degree), sheet = Tee::deflection(false, degree);
          rows.push_back(compare(fmt::format("deflection, web as a beam, degree {}", degree), "m",
                                 theory, beam, 5e-3 * theory));
          rows.push_back(compare(fmt::format("deflection, web as a sheet, degree {}", degree), "m",
                                 theory, sheet, 5e-3 * theory));
          rows.push_back(compare(fmt::format("beam against sheet, degree {}", degree), "m", sheet,
                                 beam, 3e-3 * sheet, "the same structure of shells alone"));
        }
        return rows;
      }};
}

// --- A square plate of 2 m, simply supported, with a stiffener of 0.1 x 0.01 across its middle,
// pressure.
double stiffened_plate(bool as_beam, int degree, int cells) {
  constexpr double side = 2, t = 0.01, height = 0.1;
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), t);
  examples::add_sheet(
      mesh,
      [](double x, double y) -> Vector3 {
        return {side * x, side * y - 1, 0};
      },
      cells, cells);
  if (as_beam) {
    mesh.beam_sections = {flat_bar(height, t)};
    examples::add_beams(mesh, {0, 0, 0}, {side, 0, 0}, 0, Vector3::UnitY(), {0, 0, -height / 2});
  } else {
    add_flat(mesh, side, {0, 0, -height}, {0, 0, 0}, cells, 1);
  }
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  const auto rim = [](const Vector3& p) {
    return std::abs(p.z()) < 1e-9 &&
           (p.x() < 1e-9 || p.x() > side - 1e-9 || std::abs(p.y()) > 1 - 1e-9);
  };
  examples::hold(space, rim, {2}, fixed);
  const auto place = [&](const Vector3& at) {
    return [at](const Vector3& p) { return (p - at).norm() < 1e-9; };
  };
  examples::hold(space, place({0, 0, 0}), {0, 1}, fixed);
  examples::hold(space, place({side, 0, 0}), {1}, fixed);
  const Eigen::VectorXd load = examples::area_load(space, [](const Vector3& p) -> Vector3 {
    return {0, 0, p.z() > -1e-9 ? -1e4 : 0.0};
  });
  return -examples::displacement_at(space, examples::solve(space, load, fixed), {1, 0, 0}).z();
}

VerificationCase eccentric_stiffener() {
  return {.name = "eccentric-stiffener",
          .stage = "structure",
          .source = "the same structure of shells alone, 16 x 16 cells of degree 3",
          .compute = [] {
            std::vector<VerificationRow> rows;
            const double reference = stiffened_plate(false, 3, 16);
            rows.push_back(compare("deflection, stiffener as a sheet, 8 x 8 cells of degree 3", "m",
                                   reference, stiffened_plate(false, 3, 8), 3e-3 * reference));
            for (const auto& [degree, cells] : {std::pair{2, 8}, {3, 4}, {3, 8}})
              rows.push_back(
                  compare(fmt::format("deflection, stiffener as a beam, {} x {} cells of degree {}",
                                      cells, cells, degree),
                          "m", reference, stiffened_plate(true, degree, cells), 0.015 * reference));
            return rows;
          }};
}

// --- The same two structures of solids, under their own weight, which a shell's web counts twice
// within half of the plate: 0.5 % of the tee's second moment, 1 % of its weight.
std::vector<double> planes(double from, double to, int cells) {
  std::vector<double> result;
  for (int i = 0; i <= cells; ++i) result.push_back(from + (to - from) * i / cells);
  return result;
}

// Planes on either side of a web of some thickness, finer towards it.
std::vector<double> planes_about_web(double half_width, double web, int cells) {
  std::vector<double> result;
  for (int i = -cells; i <= cells; ++i) {
    if (i == 0) continue;
    const double share = (std::abs(i) - 1.0) / (cells - 1);
    result.push_back((i < 0 ? -1 : 1) * (web / 2 + (half_width - web / 2) * share));
  }
  return result;
}

std::vector<double> planes_below_plate(double height, double thickness, int cells) {
  std::vector<double> result = planes(-height, -thickness / 2, cells);
  result.push_back(thickness / 2);
  return result;
}

struct Stiffened {
  double length, half_width, t, height, web;
  bool is_cantilever;  ///< clamped at x = 0; else simply supported all around
};

constexpr double weight_gravity = 9.81;

double sag(const Stiffened& of, const Mesh& mesh, int degree) {
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  if (of.is_cantilever) {
    clamp_root(space, fixed);
  } else {
    // Deflection through the plate's thickness leaves its edge free to turn.
    examples::hold(
        space,
        [&](const Vector3& p) {
          return p.z() > -of.t / 2 - 1e-9 && (p.x() < 1e-9 || p.x() > of.length - 1e-9 ||
                                              std::abs(p.y()) > of.half_width - 1e-9);
        },
        {2}, fixed);
    const auto near = [&](double x) {
      const Vector3 at = space.nodes().col(examples::nearest_node(space, {x, of.web / 2, 0}));
      return [at](const Vector3& p) { return (p - at).norm() < 1e-9; };
    };
    examples::hold(space, near(0), {0, 1}, fixed);
    examples::hold(space, near(of.length), {1}, fixed);
  }
  const Vector3 place(of.is_cantilever ? of.length : of.length / 2, 0, 0);
  return -examples::displacement_at(
              space, examples::solve(space, examples::weight_load(space, weight_gravity), fixed),
              place)
              .z();
}

double sag_of_solids(const Stiffened& of, int along, int across) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), of.t);
  examples::add_hexahedra(mesh, planes(0, of.length, along),
                          planes_about_web(of.half_width, of.web, across),
                          planes_below_plate(of.height, of.t, 2), [&](const Vector3& middle) {
                            return middle.z() > -of.t / 2 || std::abs(middle.y()) < of.web / 2;
                          });
  return sag(of, mesh, 2);
}

double sag_of_shells(const Stiffened& of, bool as_beam, int degree, int along, int across) {
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), of.t);
  mesh.shell_sections.push_back({of.web, 0, 0});
  add_flat(mesh, of.length, {0, -of.half_width, 0}, {0, of.half_width, 0}, along, across);
  if (as_beam) {
    mesh.beam_sections = {flat_bar(of.height, of.web)};
    examples::add_beams(mesh, {0, 0, 0}, {of.length, 0, 0}, 0, Vector3::UnitY(),
                        {0, 0, -of.height / 2});
  } else {
    add_flat(mesh, of.length, {0, 0, -of.height}, {0, 0, 0}, along, 2, 1);
  }
  return sag(of, mesh, degree);
}

VerificationCase against_solids() {
  return {
      .name = "stiffener-against-solids",
      .stage = "structure",
      .source = "the same structure of quadratic hexahedra of this program",
      .compute = [] {
        std::vector<VerificationRow> rows;
        struct Figure {
          const char* name;
          Stiffened of;
          int along, across;        // of the solids
          int cells, cells_across;  // of the shells
        };
        for (const Figure& figure :
             {Figure{"tee as a cantilever", {3, 0.15, 0.01, 0.2, 0.012, true}, 24, 4, 6, 2},
              Figure{"stiffened plate", {2, 1, 0.01, 0.1, 0.01, false}, 16, 10, 8, 8}}) {
          const double coarse = sag_of_solids(figure.of, figure.along / 2, figure.across / 2 + 1),
                       solids = sag_of_solids(figure.of, figure.along, figure.across);
          rows.push_back(compare(fmt::format("{}, solids on twice as large cells", figure.name),
                                 "m", solids, coarse, 0.01 * solids));
          for (const bool as_beam : {false, true})
            rows.push_back(compare(
                fmt::format("{}, web as a {}, degree 3", figure.name, as_beam ? "beam" : "sheet"),
                "m", solids,
                sag_of_shells(figure.of, as_beam, 3, figure.cells, figure.cells_across),
                0.015 * solids));
        }
        return rows;
      }};
}

// --- Shear lag: a stiffener under a wide plate, q sin(pi x / L) on it, diaphragms at x = 0 and L.
// The plate's effective breadth under a sinusoidal moment is 4 L / (pi (3 + 2 nu - nu^2))
// (Timoshenko and Goodier, Theory of elasticity, article 29, by von Karman 1924); its bending adds
// a reaction 4 D alpha^3 w. A half of it.
double lagging_stiffener(int degree, int along) {
  constexpr double length = 3, t = 0.01, height = 0.3;
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), t);
  // Cells grow away from the stiffener.
  examples::add_sheet(
      mesh,
      [](double x, double y) -> Vector3 {
        return {length * x, 2 * length * std::pow(y, 2.5), 0};
      },
      along, along);
  BeamSection half = flat_bar(height, 0.01);
  half.shear_area_2 = half.shear_area_3 = std::numeric_limits<double>::infinity();
  mesh.beam_sections = {half};
  examples::add_beams(mesh, {0, 0, 0}, {length, 0, 0}, 0, Vector3::UnitY(), {0, 0, -height / 2});
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9 || p.x() > length - 1e-9; }, {1, 2, 3, 5},
      fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() < 1e-9; }, {1, 3, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() > 2 * length - 1e-9; }, {1, 3, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return (p - Vector3(length / 2, 0, 0)).norm() < 1e-9; }, {0},
      fixed);
  const Eigen::VectorXd load = examples::edge_load(
      space, [](const Vector3& p) { return p.y() < 1e-9; },
      [](const Vector3& p) -> Vector3 {
        return {0, 0, -1000 * std::sin(M_PI * p.x() / length)};
      });
  return -examples::displacement_at(space, examples::solve(space, load, fixed), {length / 2, 0, 0})
              .z();
}

double lagging_stiffener_theory() {
  constexpr double length = 3, t = 0.01, height = 0.3, e = 210e9, nu = 0.3;
  const double alpha = M_PI / length;
  const double flange = 4 * length / (M_PI * (3 + 2 * nu - nu * nu)) * t, bar = 2 * height * 0.01;
  const double second =
      2 * 0.01 * std::pow(height, 3) / 12 + flange * bar / (flange + bar) * std::pow(height / 2, 2);
  const double plate = e * std::pow(t, 3) / (12 * (1 - nu * nu));
  return 2 * 1000 / (e * second * std::pow(alpha, 4) + 4 * plate * std::pow(alpha, 3));
}

VerificationCase shear_lag() {
  return {
      .name = "shear-lag",
      .stage = "structure",
      .source = "Timoshenko and Goodier, Theory of elasticity, effective breadth of wide flanges",
      .compute = [] {
        std::vector<VerificationRow> rows;
        const double theory = lagging_stiffener_theory();
        for (const auto& [degree, cells, tolerance] :
             {std::tuple{2, 8, 5e-3}, {3, 6, 3e-3}, {3, 12, 2e-3}})
          rows.push_back(
              compare(fmt::format("deflection of the stiffener, {} x {} cells of degree {}", cells,
                                  cells, degree),
                      "m", theory, lagging_stiffener(degree, cells), tolerance * theory));
        return rows;
      }};
}

// --- Bredt: a square tube of 1 m and 10 mm, 4 m long, twisted by its own shear flow T / 2 A.
double tube_twist(int degree, int along, double factor) {
  constexpr double side = 1, length = 4;
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  const std::array<Vector3, 5> corners{Vector3(0, -0.5, -0.5), Vector3(0, 0.5, -0.5),
                                       Vector3(0, 0.5, 0.5), Vector3(0, -0.5, 0.5),
                                       Vector3(0, -0.5, -0.5)};
  for (std::size_t i = 0; i < 4; ++i) add_flat(mesh, length, corners[i], corners[i + 1], along, 2);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  clamp_root(space, fixed);
  const Eigen::VectorXd load = examples::edge_load(
      space, [](const Vector3& p) { return p.x() > length - 1e-9; },
      [](const Vector3& p) -> Vector3 {
        const Vector3 flow = std::abs(p.y()) > std::abs(p.z()) ? Vector3(0, 0, p.y() > 0 ? 1 : -1)
                                                               : Vector3(0, p.z() > 0 ? -1 : 1, 0);
        return 1e5 / (2 * side * side) * flow;
      });
  // Work over the torque: the twist.
  return solve_with_drilling(space, load, fixed, factor).dot(load) / 1e5;
}

double bredt() {
  const double g = examples::plain_steel().shear_modulus();
  // 4 A^2 t / circumference, and the plates' own 4 a t^3 / 3.
  return 1e5 * 4 / (g * (0.01 + 4e-6 / 3));
}

VerificationCase box_in_torsion() {
  return {
      .name = "box-torsion", .stage = "structure", .source = "Bredt (1896)", .compute = [] {
        std::vector<VerificationRow> rows;
        const double theory = bredt();
        for (const auto& [degree, along] : {std::pair{1, 8}, {2, 4}, {3, 2}})
          rows.push_back(compare(fmt::format("twist, {} cells of degree {} along", along, degree),
                                 "rad", theory, tube_twist(degree, along, 1), 2e-3 * theory));
        return rows;
      }};
}

// --- An I-beam bent about its weak axis: flanges of 0.2 x 0.01 in their planes, 3 m, clamped.
double sideways(int degree, int along, double factor) {
  constexpr double length = 3, width = 0.2, height = 0.3;
  Mesh mesh = examples::empty_mesh(examples::plain_steel(), 0.01);
  for (const double z : {-height / 2, height / 2})
    add_flat(mesh, length, {0, -width / 2, z}, {0, width / 2, z}, along, 2);
  add_flat(mesh, length, {0, 0, -height / 2}, {0, 0, height / 2}, along, 2);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  clamp_root(space, fixed);
  const Eigen::VectorXd load = examples::edge_load(
      space,
      [](const Vector3& p) { return p.x() > length - 1e-9 && std::abs(p.z()) > height / 2 - 1e-9; },
      [](const Vector3&) -> Vector3 {
        return {0, 1000 / (2 * width), 0};
      });
  return solve_with_drilling(space, load, fixed, factor).dot(load) / 1000;
}

double sideways_theory() {
  const double e = 210e9, second = 2 * 0.01 * std::pow(0.2, 3) / 12 + 0.3 * std::pow(0.01, 3) / 12;
  const double shear = examples::plain_steel().shear_modulus() * 5.0 / 6 * 2 * 0.2 * 0.01;
  return 1000 * (27 / (3 * e * second) + 3 / shear);
}

// The flanges are two cells wide: bent in their planes, bilinear ones are some per cent too stiff.
VerificationCase i_beam_sideways() {
  return {.name = "i-beam-sideways",
          .stage = "structure",
          .source = "Timoshenko's beam",
          .compute = [] {
            std::vector<VerificationRow> rows;
            const double theory = sideways_theory();
            for (const auto& [degree, along, tolerance] :
                 {std::tuple{1, 24, 0.03}, {2, 6, 0.01}, {3, 4, 5e-3}})
              rows.push_back(
                  compare(fmt::format("deflection, {} cells of degree {} along", along, degree),
                          "m", theory, sideways(degree, along, 1), tolerance * theory));
            return rows;
          }};
}

// What the choice of the drilling stiffness does: figures with a hundredth and a hundred times of
// it, which is the full G t of Hughes and Brezzi (1989). Along the edges of a box in torsion the
// slope of one plate is the drilling of the next, twice what its own displacements make of it: a
// layer of one cell, stiff by its drilling.
VerificationCase drilling_stiffness() {
  return {.name = "drilling-stiffness",
          .stage = "structure",
          .source =
              "the same with a hundredth of the drilling stiffness G t of Hughes and Brezzi (1989)",
          .compute = [] {
            std::vector<VerificationRow> rows;
            for (const int degree : {2, 3})
              for (const double factor : {0.01, 0.1, 10.0, 100.0}) {
                const double tolerance = factor > 10 ? 0.03 : 5e-3;
                const double bent = sideways(degree, 6, 1), twisted = tube_twist(degree, 4, 1);
                rows.push_back(compare(
                    fmt::format("I-beam sideways, {} times the drilling stiffness, degree {}",
                                factor, degree),
                    "m", bent, sideways(degree, 6, factor), tolerance * bent));
                rows.push_back(compare(
                    fmt::format("box in torsion, {} times the drilling stiffness, degree {}",
                                factor, degree),
                    "rad", twisted, tube_twist(degree, 4, factor), tolerance * twisted));
              }
            return rows;
          }};
}

}  // namespace

std::vector<VerificationCase> girder_cases() {
  return {tee_beam(),       eccentric_stiffener(), against_solids(),    shear_lag(),
          box_in_torsion(), i_beam_sideways(),     drilling_stiffness()};
}

}  // namespace blocklift::pipeline

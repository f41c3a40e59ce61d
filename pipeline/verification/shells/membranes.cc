#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "pipeline/verification/models/shells/shell_models.h"
#include "pipeline/verification/shells/shell_cases.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

// A quarter of the elliptic membrane; x runs outward, y from the x axis to the y axis.
double elliptic_membrane(int degree, int cells) {
  constexpr double thickness = 0.1, pressure = 10e6;
  const Mesh mesh = examples::sheet_mesh(
      [](double x, double y) -> Vector3 {
        const double a = M_PI / 2 * y;
        return {(2 + 1.25 * x) * std::cos(a), (1 + 1.75 * x) * std::sin(a), 0};
      },
      cells, 2 * cells, thickness, {"steel", 210e9, 0.3, 7800, 355e6}, degree);
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 5}, fixed);
  examples::hold(
      space, [](const Vector3& p) { return p.y() < 1e-9; }, {1, 5}, fixed);
  examples::hold(
      space, [](const Vector3&) { return true; }, {2, 3, 4}, fixed);
  const auto level = [](const Vector3& p) {
    return std::pow(p.x() / 3.25, 2) + std::pow(p.y() / 2.75, 2);
  };
  const Eigen::VectorXd load = examples::edge_load(
      space, [&](const Vector3& p) { return level(p) > 1 - 1e-6; },
      [&](const Vector3& p) -> Vector3 {
        const Vector3 out(p.x() / (3.25 * 3.25), p.y() / (2.75 * 2.75), 0);
        return thickness * pressure * out.normalized();
      });
  return examples::stress_at(space, examples::solve(space, load, fixed), {2, 0, 0}, 0)(1, 1) / 1e6;
}

// D lies in a corner of stretched cells: coarse meshes are within per cents there, and the finer
// ones show where they go.
VerificationCase nafems_le1() {
  return {
      .name = "nafems-le1-shell",
      .stage = "structure",
      .source = "NAFEMS (1990), The standard NAFEMS benchmarks, LE1: 92.7 MPa",
      .compute = [] {
        std::vector<VerificationRow> rows;
        for (const auto& [degree, cells, tolerance] : {std::tuple{2, 4, 0.03},
                                                       {2, 8, 0.015},
                                                       {2, 16, 0.005},
                                                       {3, 2, 0.03},
                                                       {3, 4, 0.01},
                                                       {3, 8, 0.002},
                                                       {4, 2, 0.015}})
          rows.push_back(compare(
              fmt::format("sigma_yy at D, {} x {} cells of degree {}", cells, 2 * cells, degree),
              "MPa", 92.7, elliptic_membrane(degree, cells), tolerance * 92.7));
        return rows;
      }};
}

double cook(int degree, int cells) {
  const Mesh mesh = examples::sheet_mesh(
      [](double x, double y) -> Vector3 {
        return {48 * x, 44 * x + (44 - 28 * x) * y, 0};
      },
      cells, cells, 1, {"unit", 1, 1.0 / 3, 0, 1});
  const Space space(mesh, {degree, {}});
  std::vector<FixedUnknown> fixed;
  examples::hold(
      space, [](const Vector3& p) { return p.x() < 1e-9; }, {0, 1}, fixed);
  examples::hold(
      space, [](const Vector3&) { return true; }, {2, 3, 4}, fixed);
  const auto end = [](const Vector3& p) { return p.x() > 48 - 1e-9; };
  const Eigen::VectorXd load = examples::edge_load(space, end, [](const Vector3&) -> Vector3 {
    return {0, 1.0 / 16, 0};
  });
  return examples::displacement_at(space, examples::solve(space, load, fixed), {48, 52, 0}).y();
}

VerificationCase cooks_membrane() {
  return {.name = "cooks-membrane",
          .stage = "structure",
          .source = "Cook (1974); 23.96 by fine meshes",
          .compute = [] {
            std::vector<VerificationRow> rows;
            for (const auto& [degree, cells, tolerance] :
                 {std::tuple{1, 16, 0.02}, {2, 4, 0.01}, {2, 8, 4e-3}, {3, 4, 4e-3}, {4, 4, 2e-3}})
              rows.push_back(
                  compare(fmt::format("deflection of the upper corner, {} x {} cells of degree {}",
                                      cells, cells, degree),
                          "1", 23.96, cook(degree, cells), tolerance * 23.96));
            return rows;
          }};
}

}  // namespace

std::vector<VerificationCase> membrane_cases() { return {nafems_le1(), cooks_membrane()}; }

}  // namespace blocklift::pipeline

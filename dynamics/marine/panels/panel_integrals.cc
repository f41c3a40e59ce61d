#include "dynamics/marine/panels/panel_integrals.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "dynamics/instruction_sets.h"

namespace blocklift::dynamics {
namespace {

/// A panel in coordinates of its own: origin at the centroid, third axis along the normal (m).
struct LocalPanel {
  Vector3 origin;                     ///< in W
  Matrix3 R_PW;                       ///< turns W into the panel's frame
  std::array<double, 4> x, y;         ///< vertices
  std::array<double, 4> length;       ///< of the edge from vertex k to the next
  std::array<double, 4> normal_x;     ///< in-plane unit normal of the edge, outward
  std::array<double, 4> normal_y;     //
  std::array<double, 4> offset;       ///< distance of the edge's line from the origin
  std::array<double, 2> double_area;  ///< of the triangles (0, 1, 2) and (0, 2, 3), m2
  double diagonal_squared = 0.0;      ///< of the diagonal 0-2, m2
};

LocalPanel make_local(const Panel& panel) {
  LocalPanel local;
  local.origin = panel.centroid;
  const Vector3 first = (panel.vertices[1] - panel.vertices[0]).normalized();
  local.R_PW.row(0) = first;
  local.R_PW.row(1) = panel.normal.cross(first);
  local.R_PW.row(2) = panel.normal;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3 vertex = local.R_PW * (panel.vertices[k] - panel.centroid);
    local.x[k] = vertex.x();
    local.y[k] = vertex.y();
  }
  const auto count = static_cast<std::size_t>(panel.vertex_count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    const double dx = local.x[next] - local.x[k], dy = local.y[next] - local.y[k];
    const double length = std::hypot(dx, dy);
    // An edge that has shrunk to a point adds nothing.
    const double inverse = length > 0.0 ? 1.0 / length : 0.0;
    local.length[k] = length;
    local.normal_x[k] = dy * inverse;
    local.normal_y[k] = -dx * inverse;
    local.offset[k] = local.normal_x[k] * local.x[k] + local.normal_y[k] * local.y[k];
  }
  const auto doubled = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (local.x[b] - local.x[a]) * (local.y[c] - local.y[a]) -
           (local.x[c] - local.x[a]) * (local.y[b] - local.y[a]);
  };
  local.double_area = {doubled(0, 1, 2), count == 4 ? doubled(0, 2, 3) : 0.0};
  const double dx = local.x[2] - local.x[0], dy = local.y[2] - local.y[0];
  local.diagonal_squared = dx * dx + dy * dy;
  return local;
}

/// sum of coefficients[k] u^k.
template <std::size_t count>
[[gnu::always_inline]] inline double polynomial(const std::array<double, count>& coefficients,
                                                double u) {
  double value = coefficients[count - 1];
  for (std::size_t k = count - 1; k-- > 0;) value = value * u + coefficients[k];
  return value;
}

/// Natural logarithm of a finite number >= 1, without branches: exponent and mantissa are taken
/// apart, the mantissa m in [1/sqrt(2), sqrt(2)] gives 2 artanh((m - 1)/(m + 1)). The polynomial
/// interpolates artanh(f)/f at Chebyshev points of f^2, its relative error is 2e-16.
[[gnu::always_inline]] inline double log_from_one(double value) {
  constexpr std::array<double, 7> artanh = {
      1.0,
      0.333333333332764,
      0.2000000003089888,
      0.14285708005966102,
      0.11111717609107039,
      0.09060956022946504,
      0.08418968905758935,
  };
  constexpr std::uint64_t mantissa_bits = 0x000fffffffffffffULL;
  constexpr std::uint64_t one = 0x3ff0000000000000ULL;
  constexpr std::uint64_t two_to_52 = 0x4330000000000000ULL;  // adds an integer to 2^52
  const auto bits = std::bit_cast<std::uint64_t>(value);
  double exponent =
      std::bit_cast<double>((bits >> 52U) | two_to_52) - (4503599627370496.0 + 1023.0);
  double mantissa = std::bit_cast<double>((bits & mantissa_bits) | one);
  const bool high = mantissa > std::numbers::sqrt2;
  mantissa = high ? 0.5 * mantissa : mantissa;
  exponent = high ? exponent + 1.0 : exponent;
  const double f = (mantissa - 1.0) / (mantissa + 1.0);
  return exponent * std::numbers::ln2 + 2.0 * f * polynomial(artanh, f * f);
}

/// Angle (rad) of the point (x, y) without branches: an octant's arctangent with the argument
/// reduced to |t| <= tan(pi/8); polynomial as above, relative error 4e-17. At the origin, where a
/// rectangle's centroid lies exactly on its diagonal, any angle would do: zero.
[[gnu::always_inline]] inline double angle_of(double y, double x) {
  constexpr std::array<double, 11> arctangent = {
      1.0,
      -0.33333333333328435,
      0.1999999999885434,
      -0.1428571418090831,
      0.11111106177499963,
      -0.09090773003195665,
      0.07689952460159052,
      -0.06640224772864646,
      0.05688300766748603,
      -0.04347911193352297,
      0.02113363790571515,
  };
  constexpr double tangent_of_eighth = 0.41421356237309503;
  const double abs_x = std::abs(x), abs_y = std::abs(y);
  const double larger = abs_x > abs_y ? abs_x : abs_y;
  const double smaller = abs_x > abs_y ? abs_y : abs_x;
  const bool reduced = smaller > tangent_of_eighth * larger;
  const double numerator = reduced ? smaller - larger : smaller;
  const double denominator = reduced ? smaller + larger : larger;
  constexpr double least = 1e-300;
  const double t = numerator / (denominator + least);
  double angle = t * polynomial(arctangent, t * t);
  angle = reduced ? angle + std::numbers::pi / 4 : angle;
  angle = abs_y > abs_x ? std::numbers::pi / 2 - angle : angle;
  angle = x < 0.0 ? std::numbers::pi - angle : angle;
  return y < 0.0 ? -angle : angle;
}

/// Half of the solid angle of a panel, from the distances r of its vertices, the height h.
template <int vertex_count>
[[gnu::always_inline]] inline double half_solid_angle(const LocalPanel& panel,
                                                      const std::array<double, 4>& r, double h) {
  const auto& d = panel.length;
  const double r0 = r[0] * r[0], r1 = r[1] * r[1], r2 = r[2] * r[2];
  const double third = vertex_count == 3 ? d[2] * d[2] : panel.diagonal_squared;
  const double p01 = r0 + r1 - d[0] * d[0], p12 = r1 + r2 - d[1] * d[1], p02 = r0 + r2 - third;
  double real = r[0] * r[1] * r[2] + 0.5 * (p01 * r[2] + p02 * r[1] + p12 * r[0]);
  double imaginary = panel.double_area[0] * h;
  if constexpr (vertex_count == 4) {
    const double r3 = r[3] * r[3];
    const double p23 = r2 + r3 - d[2] * d[2], p03 = r0 + r3 - d[3] * d[3];
    const double real_2 = r[0] * r[2] * r[3] + 0.5 * (p02 * r[3] + p03 * r[2] + p23 * r[0]);
    const double imaginary_2 = panel.double_area[1] * h;
    const double product = real * real_2 - imaginary * imaginary_2;
    imaginary = real * imaginary_2 + imaginary * real_2;
    real = product;
  }
  return angle_of(imaginary, real);
}

/// One panel at all points.
template <int vertex_count, PanelIntegral integral>
[[gnu::always_inline]] inline void add_at_points(const LocalPanel& panel, const double* point_x,
                                                 const double* point_y, const double* point_z,
                                                 std::size_t count, double sign,
                                                 double* __restrict source,
                                                 double* __restrict dipole) {
  constexpr std::size_t vertices = vertex_count;
  constexpr bool with_source = integral != PanelIntegral::dipole;
  constexpr bool with_dipole = integral == PanelIntegral::dipole || integral == PanelIntegral::both;
  constexpr bool with_angle = integral != PanelIntegral::coplanar_source;
  const Matrix3& R = panel.R_PW;
#ifndef __clang__
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = point_x[i] - panel.origin.x();
    const double dy = point_y[i] - panel.origin.y();
    const double dz = point_z[i] - panel.origin.z();
    const double x = R(0, 0) * dx + R(0, 1) * dy + R(0, 2) * dz;
    const double y = R(1, 0) * dx + R(1, 1) * dy + R(1, 2) * dz;
    const double h = R(2, 0) * dx + R(2, 1) * dy + R(2, 2) * dz;
    std::array<double, 4> r{};
    for (std::size_t k = 0; k < vertices; ++k) {
      const double u = x - panel.x[k], v = y - panel.y[k];
      r[k] = std::sqrt(u * u + v * v + h * h);
    }
    double half_angle = 0.0;
    if constexpr (with_angle) half_angle = half_solid_angle<vertex_count>(panel, r, h);
    if constexpr (with_source) {
      double potential = -2.0 * h * half_angle;
      for (std::size_t k = 0; k < vertices; ++k) {
        const double distance = panel.offset[k] - panel.normal_x[k] * x - panel.normal_y[k] * y;
        const double sum = r[k] + r[(k + 1) % vertices];
        potential += distance * log_from_one((sum + panel.length[k]) / (sum - panel.length[k]));
      }
      source[i] += sign * potential;
    }
    if constexpr (with_dipole) dipole[i] += sign * 2.0 * half_angle;
  }
}

template <int vertex_count>
[[gnu::always_inline]] inline void choose_integral(const LocalPanel& panel,
                                                   const PointColumns& points,
                                                   PanelIntegral integral, double sign,
                                                   double* source, double* dipole) {
  const double *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
  const std::size_t count = points.size();
  switch (integral) {
    case PanelIntegral::source:
      add_at_points<vertex_count, PanelIntegral::source>(panel, x, y, z, count, sign, source,
                                                         dipole);
      break;
    case PanelIntegral::dipole:
      add_at_points<vertex_count, PanelIntegral::dipole>(panel, x, y, z, count, sign, source,
                                                         dipole);
      break;
    case PanelIntegral::both:
      add_at_points<vertex_count, PanelIntegral::both>(panel, x, y, z, count, sign, source, dipole);
      break;
    case PanelIntegral::coplanar_source:
      add_at_points<vertex_count, PanelIntegral::coplanar_source>(panel, x, y, z, count, sign,
                                                                  source, dipole);
      break;
  }
}

BLOCKLIFT_CLONES
void add_triangle(const LocalPanel& panel, const PointColumns& points, PanelIntegral integral,
                  double sign, double* source, double* dipole) {
  choose_integral<3>(panel, points, integral, sign, source, dipole);
}

BLOCKLIFT_CLONES
void add_quadrangle(const LocalPanel& panel, const PointColumns& points, PanelIntegral integral,
                    double sign, double* source, double* dipole) {
  choose_integral<4>(panel, points, integral, sign, source, dipole);
}

}  // namespace

PointColumns::PointColumns(const PanelMesh& mesh) : PointColumns(mesh.panels.size()) {
  for (std::size_t i = 0; i < mesh.panels.size(); ++i) {
    x[i] = mesh.panels[i].centroid.x();
    y[i] = mesh.panels[i].centroid.y();
    z[i] = mesh.panels[i].centroid.z();
  }
}

void add_panel_potentials(const Panel& panel, const PointColumns& points, PanelIntegral integral,
                          double sign, double* source, double* dipole) {
  const LocalPanel local = make_local(panel);
  if (panel.vertex_count == 3) {
    add_triangle(local, points, integral, sign, source, dipole);
  } else {
    add_quadrangle(local, points, integral, sign, source, dipole);
  }
}

PanelPotentials calc_panel_potentials(const Panel& panel, const Vector3& point_W) {
  PointColumns point(1);
  point.x[0] = point_W.x();
  point.y[0] = point_W.y();
  point.z[0] = point_W.z();
  PanelPotentials result{0.0, 0.0};
  add_panel_potentials(panel, point, PanelIntegral::both, 1.0, &result.source, &result.dipole);
  const double height = panel.normal.dot(point_W - panel.centroid);
  if (std::abs(height) < 1e-12 * panel.diameter()) result.dipole = 0.0;
  return result;
}

}  // namespace blocklift::dynamics

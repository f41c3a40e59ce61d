#include "pipeline/verification/models/panel_quadrature.h"

#include <array>
#include <cmath>
#include <vector>

namespace blocklift::dynamics::examples {

Panel skew_quadrangle() {
  const Vector3 u = Vector3(1, 2, 3).normalized();
  const Vector3 v = u.cross(Vector3(0, 0, 1)).normalized();
  const Vector3 o(0.3, -0.2, -1.0);
  const std::vector<Vector3> points{o, o + 1.1 * u - 0.1 * v, o + 1.3 * u + 0.9 * v,
                                    o - 0.2 * u + 0.7 * v};
  return make_panel(points);
}

PanelPotentials by_quadrature(const Panel& panel, const Vector3& point, int n) {
  constexpr std::array<double, 5> x = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                       0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> w = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                       0.4786286704993665, 0.2369268850561891};
  PanelPotentials sum{0.0, 0.0};
  const auto& p = panel.vertices;
  for (int i = 0; i < 5 * n; ++i) {
    for (int j = 0; j < 5 * n; ++j) {
      const auto a = static_cast<std::size_t>(i % 5), b = static_cast<std::size_t>(j % 5);
      const int row = i / 5, column = j / 5;
      const double s = (row + 0.5 * (1.0 + x[a])) / n, t = (column + 0.5 * (1.0 + x[b])) / n;
      const Vector3 y =
          (1 - s) * (1 - t) * p[0] + s * (1 - t) * p[1] + s * t * p[2] + (1 - s) * t * p[3];
      const Vector3 along_s = (1 - t) * (p[1] - p[0]) + t * (p[2] - p[3]);
      const Vector3 along_t = (1 - s) * (p[3] - p[0]) + s * (p[2] - p[1]);
      const double area = w[a] * w[b] / (4.0 * n * n) * along_s.cross(along_t).norm();
      const Vector3 r = point - y;
      sum.source += area / r.norm();
      sum.dipole += area * r.dot(panel.normal) / std::pow(r.norm(), 3);
    }
  }
  return sum;
}

}  // namespace blocklift::dynamics::examples

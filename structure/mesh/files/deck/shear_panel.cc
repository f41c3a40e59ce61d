#include "structure/mesh/files/deck/shear_panel.h"

#include <cmath>

#include <Eigen/Dense>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

using Corners = std::array<Eigen::Vector2d, 4>;
using Flows = std::array<double, 4>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector2d edge(const Corners& corners, std::size_t i) {
  return corners[(i + 1) % 4] - corners[i];
}

/// Forces along the four edges in balance, over their lengths: the null space of two sums of forces
/// and one of moments. Positive round the panel on edges 1 and 3, their mean size 1.
Flows balanced_flows(const Corners& corners) {
  // With c_i the moment of edge i, the null space of (e_i, c_i) by its 3 x 3 minors.
  Eigen::Matrix<double, 3, 4> rows;
  for (std::size_t i = 0; i < 4; ++i)
    rows.col(i) << edge(corners, i), cross(corners[i], edge(corners, i));
  Eigen::Vector4d flows;
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix3d minor;
    for (int j = 0, column = 0; j < 4; ++j)
      if (j != i) minor.col(column++) = rows.col(j);
    flows[i] = (i % 2 == 0 ? 1 : -1) * minor.determinant();
  }
  flows /= flows.cwiseAbs().mean() * (flows[1] < 0 ? -1 : 1);
  return {flows[0], flows[1], flows[2], flows[3]};
}

/// Flow between two ends as it falls off from where the edges beside meet: 1 / r^2, r linear.
double flow_between(double from, double to, double share) {
  const double root = (1 - share) / std::sqrt(from) + share / std::sqrt(to);
  return 1 / (root * root);
}

/// Strain energy, doubled, of a panel under its flows: along xi and eta lines the stress has
/// sigma = s (g_xi g_eta + g_eta g_xi) / (J t), which is the flow s along either.
double compliance(const Corners& corners, const Flows& flow, const Material& material,
                  double thickness) {
  constexpr std::array<double, 4> points{0.06943184420297371, 0.33000947820757187,
                                         0.66999052179242813, 0.93056815579702629};
  constexpr std::array<double, 4> weights{0.17392742256872693, 0.32607257743127307,
                                          0.32607257743127307, 0.17392742256872693};
  const double nu = material.poisson_ratio;
  const double scale = std::sqrt(flow[1] * flow[3]);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double xi = points[i], eta = points[j];
      const Eigen::Vector2d g_xi = (1 - eta) * edge(corners, 0) - eta * edge(corners, 2);
      const Eigen::Vector2d g_eta = xi * edge(corners, 1) - (1 - xi) * edge(corners, 3);
      const double jacobian = cross(g_xi, g_eta);
      const double s =
          flow_between(flow[0], flow[2], eta) * flow_between(flow[3], flow[1], xi) / scale;
      const Eigen::Matrix2d stress =
          s / (jacobian * thickness) * (g_xi * g_eta.transpose() + g_eta * g_xi.transpose());
      const double trace = stress.trace();
      sum += weights[i] * weights[j] * jacobian * thickness *
             ((1 + nu) * stress.squaredNorm() - nu * trace * trace) / material.youngs_modulus;
    }
  return sum;
}

}  // namespace

ShearPanel make_shear_panel(const std::array<Vector3, 4>& corners, const Material& material,
                            double thickness) {
  constexpr double most_warp = 0.05;
  ShearPanel panel;
  panel.corner_forces.fill(Vector3::Zero());
  const Vector3 diagonals = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
  panel.normal = diagonals.normalized();
  double perimeter = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    panel.centre += corners[i] / 4;
    perimeter += (corners[(i + 1) % 4] - corners[i]).norm();
  }
  const Vector3 e_1 = panel.normal.unitOrthogonal(), e_2 = panel.normal.cross(e_1);
  Corners flat;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 arm = corners[i] - panel.centre;
    flat[i] = {arm.dot(e_1), arm.dot(e_2)};
    if (!(std::abs(arm.dot(panel.normal)) < most_warp * perimeter / 4))
      throw ModelError("its corners are off their plane by more than 5 % of its mean edge");
  }
  for (std::size_t i = 0; i < 4; ++i)
    if (!(cross(edge(flat, i), edge(flat, (i + 1) % 4)) > 1e-6 * diagonals.norm()))
      throw ModelError("its corners are those of no convex quadrilateral");
  const Flows signed_flows = balanced_flows(flat);
  Flows flows{};
  for (std::size_t i = 0; i < 4; ++i) {
    flows[i] = std::abs(signed_flows[i]);
    const Vector3 half = signed_flows[i] / 2 * (edge(flat, i).x() * e_1 + edge(flat, i).y() * e_2);
    panel.corner_forces[i] += half;
    panel.corner_forces[(i + 1) % 4] += half;
  }
  panel.stiffness = 1 / compliance(flat, flows, material, thickness);
  panel.area = diagonals.norm() / 2;
  return panel;
}

}  // namespace blocklift::structure

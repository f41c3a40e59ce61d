#include "dynamics/marine/hull/hydrostatics.h"

#include <cmath>

namespace blocklift::dynamics {

namespace {

// Adds the part of a triangle where the heights h of its corners, linear between, are negative.
void add_wet_part(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& h,
                  SurfaceMoments& moments) {
  const int wet = (h[0] < 0.0 ? 1 : 0) + (h[1] < 0.0 ? 1 : 0) + (h[2] < 0.0 ? 1 : 0);
  if (wet == 0) return;
  if (wet == 3) {
    moments.add_triangle(*p[0], *p[1], *p[2]);
    return;
  }
  // The corner that is alone on its side comes first; the order round the triangle is kept.
  std::size_t i = 0;
  while ((h[i] < 0.0) != (wet == 1)) ++i;
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  const Vector3 ij = *p[i] + h[i] / (h[i] - h[j]) * (*p[j] - *p[i]);
  const Vector3 ik = *p[i] + h[i] / (h[i] - h[k]) * (*p[k] - *p[i]);
  if (wet == 1) {
    moments.add_triangle(*p[i], ij, ik);
  } else {
    moments.add_triangle(ij, *p[j], *p[k]);
    moments.add_triangle(ij, *p[k], ik);
  }
}

void add_wet_part(const TriangleTree& tree, const TriangleTree::Node& leaf, double z0,
                  const Vector3& u, SurfaceMoments& moments) {
  std::array<double, TriangleTree::most_points> height;
  const std::span<const Vector3> points = tree.points(leaf);
  for (std::size_t i = 0; i < points.size(); ++i) height[i] = z0 + u.dot(points[i]);
  for (const TriangleTree::Triangle& triangle : tree.triangles(leaf)) {
    const auto [a, b, c] = triangle.corners;
    add_wet_part({&points[a], &points[b], &points[c]}, {height[a], height[b], height[c]}, moments);
  }
}

// Calls `whole(index)` for each box that is under water and `cut(leaf)` for each leaf that the
// surface cuts: z0 is the height of Bo, u the vertical in B.
template <class Whole, class Cut>
void visit_wetted(const TriangleTree& tree, double z0, const Vector3& u, Whole&& whole, Cut&& cut) {
  const Vector3 magnitude = u.cwiseAbs();
  tree.visit(
      [&](const TriangleTree::Node& node, int index) {
        const double height = z0 + u.dot(node.centre);
        const double reach = magnitude.dot(node.half_extent);
        if (height - reach >= 0.0) return false;
        if (height + reach >= 0.0) return true;
        whole(index);
        return false;
      },
      cut);
}

// Moments of the wetted surface: z0 is the height of Bo, u the vertical in B.
SurfaceMoments calc_wetted_moments(const HullClusters& hull, double z0, const Vector3& u) {
  const TriangleTree& tree = hull.faces();
  SurfaceMoments moments = SurfaceMoments::zero();
  visit_wetted(
      tree, z0, u, [&](int index) { moments += tree.moments(index); },
      [&](const TriangleTree::Node& leaf) { add_wet_part(tree, leaf, z0, u, moments); });
  return moments;
}

// Mean over a triangle of its height where that is negative, zero elsewhere; linear between the
// corners' heights. A corner alone on its side cuts off the share h_i^2 / ((h_i - h_j)(h_i - h_k))
// of the area.
double wet_height(const std::array<double, 3>& h) {
  const int wet = (h[0] < 0.0 ? 1 : 0) + (h[1] < 0.0 ? 1 : 0) + (h[2] < 0.0 ? 1 : 0);
  const double mean = (h[0] + h[1] + h[2]) / 3.0;
  if (wet == 0) return 0.0;
  if (wet == 3) return mean;
  std::size_t i = 0;
  while ((h[i] < 0.0) != (wet == 1)) ++i;
  const double share = h[i] * h[i] / ((h[i] - h[(i + 1) % 3]) * (h[i] - h[(i + 2) % 3]));
  const double of_corner = share * h[i] / 3.0;
  return wet == 1 ? of_corner : mean - of_corner;
}

struct VolumeIntegrals {
  double volume;          // m3
  Vector3 first_B;        // int p dV in B, m4
  double height;          // int h dV, m4
  Matrix3 vertical_part;  // int u.n p p^T dA, m4
};

VolumeIntegrals integrate(const SurfaceMoments& m, double z0, const Vector3& u) {
  VolumeIntegrals integrals;
  const Vector3 Qu = m.Q.transpose() * u;  // int u.n p dA
  integrals.vertical_part = m.contract(u);
  const Vector3 Tuu = integrals.vertical_part * u;
  integrals.volume = z0 * u.dot(m.N) + Qu.dot(u);
  integrals.height = 0.5 * (z0 * z0 * u.dot(m.N) + 2.0 * z0 * Qu.dot(u) + Tuu.dot(u));
  // div(p_j h u) = p_j + h u_j.
  integrals.first_B = z0 * Qu + Tuu - integrals.height * u;
  return integrals;
}

}  // namespace

Hydrostatics calc_hydrostatics(const HullClusters& hull, const Pose& X_WB) {
  const double z0 = X_WB.p.z();
  const Vector3 x = X_WB.R.row(0);
  const Vector3 y = X_WB.R.row(1);
  const Vector3 u = X_WB.R.row(2);
  const SurfaceMoments m = calc_wetted_moments(hull, z0, u);
  const VolumeIntegrals integrals = integrate(m, z0, u);
  const Vector3 first_plane = -(m.Q.transpose() * u);
  Hydrostatics result;
  result.volume = integrals.volume;
  result.volume_moment_W = X_WB.R * integrals.first_B;
  result.energy_over_rho_g = -integrals.height;
  result.water_plane_area = -u.dot(m.N);
  result.water_plane_moment = {first_plane.dot(x), first_plane.dot(y)};
  const Matrix3& second = integrals.vertical_part;
  result.water_plane_second_moment = {-x.dot(second * x), -x.dot(second * y), -y.dot(second * y)};
  return result;
}

Buoyancy calc_buoyancy(const HullClusters& hull, const Pose& X_WB) {
  const double z0 = X_WB.p.z();
  const Vector3 u = X_WB.R.row(2);
  const VolumeIntegrals integrals = integrate(calc_wetted_moments(hull, z0, u), z0, u);
  const Vector3 S = X_WB.R * integrals.first_B;
  return {{{S.y(), -S.x(), 0.0}, {0.0, 0.0, integrals.volume}}, -integrals.height};
}

double calc_displaced_volume(const HullClusters& hull, const Pose& X_WB) {
  const double z0 = X_WB.p.z();
  const Vector3 u = X_WB.R.row(2);
  const TriangleTree& tree = hull.faces();
  double volume = 0.0;
  const auto add_leaf = [&](const TriangleTree::Node& leaf) {
    std::array<double, TriangleTree::most_points> height;
    const std::span<const Vector3> points = tree.points(leaf);
    for (std::size_t i = 0; i < points.size(); ++i) height[i] = z0 + u.dot(points[i]);
    for (const TriangleTree::Triangle& triangle : tree.triangles(leaf)) {
      const auto [a, b, c] = triangle.corners;
      const double wet = wet_height({height[a], height[b], height[c]});
      if (wet != 0.0) volume += wet * u.dot(triangle.area);
    }
  };
  const auto add_whole = [&](int index) {
    const SurfaceMoments& m = tree.moments(index);
    volume += z0 * u.dot(m.N) + u.dot(m.Q * u);
  };
  visit_wetted(tree, z0, u, add_whole, add_leaf);
  return volume;
}

Eigen::Matrix<double, 6, 6> calc_stiffness_over_rho_g(const Hydrostatics& h) {
  const Vector3& S = h.volume_moment_W;
  const double A = h.water_plane_area;
  const double Ax = h.water_plane_moment.x();
  const double Ay = h.water_plane_moment.y();
  const double Axx = h.water_plane_second_moment[0];
  const double Axy = h.water_plane_second_moment[1];
  const double Ayy = h.water_plane_second_moment[2];
  // A point of the water plane rises by dz + rx y - ry x; what rises is lost to the volume, the
  // rest of the volume turns with the body.
  Eigen::Matrix<double, 6, 6> K = Eigen::Matrix<double, 6, 6>::Zero();
  K.row(0) << Ayy + S.z(), -Axy, -S.x(), 0.0, 0.0, Ay;
  K.row(1) << -Axy, Axx + S.z(), -S.y(), 0.0, 0.0, -Ax;
  K.row(5) << Ay, -Ax, 0.0, 0.0, 0.0, A;
  return K;
}

Metacentre calc_metacentre(const Hydrostatics& h, const Vector3& p_BoBcm_W) {
  const double A = h.water_plane_area;
  Metacentre m;
  m.KB = h.p_BoC_W().z();
  // About the centre of the water plane; without a water plane (rounding aside) nothing is added.
  const bool has_plane = A > 1e-9 * std::cbrt(h.volume * h.volume);
  const double Iyy = has_plane ? h.water_plane_second_moment[0] -
                                     h.water_plane_moment.x() * h.water_plane_moment.x() / A
                               : 0.0;
  const double Ixx = has_plane ? h.water_plane_second_moment[2] -
                                     h.water_plane_moment.y() * h.water_plane_moment.y() / A
                               : 0.0;
  m.BM_x = Ixx / h.volume;
  m.BM_y = Iyy / h.volume;
  m.GM_x = m.KB + m.BM_x - p_BoBcm_W.z();
  m.GM_y = m.KB + m.BM_y - p_BoBcm_W.z();
  return m;
}

}  // namespace blocklift::dynamics

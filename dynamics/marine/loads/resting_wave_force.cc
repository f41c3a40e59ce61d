#include "dynamics/marine/loads/resting_wave_force.h"

#include <algorithm>
#include <array>

#include "dynamics/marine/hull/wet_triangle.h"

namespace blocklift::dynamics {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A vertex of a leaf in a frame with the world's axes about R, and what heads of 1 m weigh there.
struct Vertex {
  Vector3 p_R;
  double height;                      ///< above the calm water, m
  Vector6 below = Vector6::Zero();    ///< of the head at the vertex
  Vector6 surface = Vector6::Zero();  ///< of the head in the water's surface over or under it
};

/// A corner of a wet piece: a vertex in the water, or where the edge between two leaves it.
struct Corner {
  Vector3 p_R;
  Vertex* from;
  Vertex* to = nullptr;  ///< null: `from` itself
  double share = 0.0;    ///< of the way from `from` to `to`
};

/// Shares out what a head that is linear over a triangle does, as add_wet_triangle has it.
void add_piece(const std::array<Corner, 3>& corners, const Vector3& area) {
  const Vector3 sum = corners[0].p_R + corners[1].p_R + corners[2].p_R;
  for (const Corner& corner : corners) {
    Vector6 weight;
    weight << -area / 3.0, -((sum + corner.p_R) / 12.0).cross(area);
    if (corner.to) {
      corner.from->surface += (1.0 - corner.share) * weight;
      corner.to->surface += corner.share * weight;
    } else {
      corner.from->below += weight;
    }
  }
}

void add_triangle(const std::array<Vertex*, 3>& vertices, const Vector3& area) {
  const std::array<double, 3> h = {vertices[0]->height, vertices[1]->height, vertices[2]->height};
  const int wet = count_wet(h);
  if (wet == 0) return;
  const auto whole = [&](std::size_t i) { return Corner{vertices[i]->p_R, vertices[i]}; };
  if (wet == 3) {
    add_piece({whole(0), whole(1), whole(2)}, area);
    return;
  }
  const auto [i, j, k, to_j, to_k, ij, ik] =
      TriangleCut({&vertices[0]->p_R, &vertices[1]->p_R, &vertices[2]->p_R}, h, wet);
  const Corner leaves_j{ij, vertices[i], vertices[j], to_j};
  const Corner leaves_k{ik, vertices[i], vertices[k], to_k};
  if (wet == 1) {
    add_piece({whole(i), leaves_j, leaves_k}, to_j * to_k * area);
  } else {
    add_piece({leaves_j, whole(j), whole(k)}, (1.0 - to_j) * area);
    add_piece({leaves_j, whole(k), leaves_k}, to_j * (1.0 - to_k) * area);
  }
}

template <class AddLeaf>
void visit_leaves(const TriangleTree& tree, AddLeaf&& add_leaf) {
  tree.visit([](const TriangleTree::Node&, int) { return true; }, add_leaf);
}

}  // namespace

RestingWaveForce::RestingWaveForce(const WaveSurface& surface, const Pose& X_WB,
                                   const Vector3& p_WR)
    : p_WR_(p_WR) {
  const Pose X_RB{X_WB.R, X_WB.p - p_WR};
  if (surface.panels()) {
    const TriangleTree& tree = surface.panels()->tree;
    visit_leaves(tree, [&](const TriangleTree::Node& leaf) { add_panels(tree, leaf, X_RB); });
  }
  if (surface.faces()) {
    const TriangleTree& tree = surface.faces()->tree;
    visit_leaves(tree, [&](const TriangleTree::Node& leaf) { add_faces(tree, leaf, X_RB); });
  }
}

void RestingWaveForce::add(const Vector3& p_R, const Vector6& weight) {
  if (!weight.isZero(0.0)) samples_.push_back({p_WR_ + p_R, weight});
}

void RestingWaveForce::add_panels(const TriangleTree& tree, const TriangleTree::Node& leaf,
                                  const Pose& X_RB) {
  std::vector<Vertex> vertices;
  for (const Vector3& point : tree.points(leaf)) {
    const Vector3 p_R = X_RB.apply(point);
    vertices.push_back({p_R, p_R.z() + p_WR_.z()});
  }
  for (const TriangleTree::Triangle& triangle : tree.triangles(leaf)) {
    const auto [a, b, c] = triangle.corners;
    add_triangle({&vertices[a], &vertices[b], &vertices[c]}, X_RB.R * triangle.area);
  }
  for (const Vertex& vertex : vertices) {
    add(vertex.p_R, vertex.below);
    add({vertex.p_R.x(), vertex.p_R.y(), -p_WR_.z()}, vertex.surface);
  }
}

void RestingWaveForce::add_faces(const TriangleTree& tree, const TriangleTree::Node& leaf,
                                 const Pose& X_RB) {
  std::vector<Vector3> points;
  for (const Vector3& point : tree.points(leaf)) points.push_back(X_RB.apply(point));
  WetTrianglePoints<2 * WaveSurface::faces_in_leaf> wet;
  for (const TriangleTree::Triangle& triangle : tree.triangles(leaf)) {
    const auto [a, b, c] = triangle.corners;
    const auto height = [&](std::size_t i) { return points[i].z() + p_WR_.z(); };
    wet.add_wet_part({&points[a], &points[b], &points[c]}, {height(a), height(b), height(c)},
                     X_RB.R * triangle.area);
  }
  for (std::size_t i = 0; i < wet.count(); ++i) {
    const Vector3& p_R = wet.points()[i];
    Vector6 weight;
    weight << -wet.area(i), -p_R.cross(wet.area(i));
    add(p_R, weight);
  }
}

Eigen::Matrix<std::complex<double>, 6, 1> RestingWaveForce::calc_force(const Water& water,
                                                                       double frequency,
                                                                       double heading) const {
  const IncidentWave wave(water, frequency, heading);
  Eigen::Matrix<std::complex<double>, 6, 1> force;
  force.setZero();
  for (const Sample& sample : samples_) force += wave.potential(sample.p_W) * sample.weight;
  // The pressure is -rho times the potential's rate.
  return std::complex<double>(0.0, -water.density * frequency) * force;
}

}  // namespace blocklift::dynamics

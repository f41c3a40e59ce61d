#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "dynamics/spatial/spatial_inertia.h"

namespace blocklift::dynamics {

/// Closed surface of a floating body: polygons (three or more vertices) in the frame of the body.
///
/// The vertices of a panel run counter-clockwise seen from the water, so that its normal points out
/// of the body. A panel that is not flat stands for the triangles between its first vertex and its
/// edges; whatever is computed from a hull is exact for that surface.
class Hull {
 public:
  explicit Hull(std::string name = "hull") : name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  void set_name(std::string name) { name_ = std::move(name); }

  /// @returns the index of the new vertex.
  int add_vertex(const Vector3& p_BoV_B);
  /// @throws ModelError if there are fewer than three vertices, or one that does not exist.
  void add_panel(std::span<const int> vertices);
  void add_panel(std::initializer_list<int> vertices) {
    add_panel(std::span<const int>(vertices.begin(), vertices.size()));
  }

  const std::vector<Vector3>& vertices() const { return vertices_; }
  const Vector3& vertex(int index) const { return vertices_[index]; }
  int panel_count() const { return static_cast<int>(start_.size()) - 1; }
  /// Indices of the vertices of a panel, in their order.
  std::span<const int> panel(int index) const {
    const auto i = static_cast<std::size_t>(index);
    return {corners_.data() + start_[i], start_[i + 1] - start_[i]};
  }
  /// The triangles that the panel stands for: number of corners less two.
  std::array<Vector3, 3> triangle(int panel, int number) const;

  /// Area times unit normal, m2: 1/2 sum p_i x p_i+1, the same for a flat panel and a warped one.
  Vector3 panel_area_vector(int panel) const;
  /// Mean of the vertices of a panel, m.
  Vector3 panel_midpoint(int panel) const;
  /// Largest distance of two vertices of a panel, m.
  double panel_diameter(int panel) const;
  /// Lowest and highest coordinates of the vertices, m.
  std::array<Vector3, 2> bounds() const;

 private:
  std::string name_;
  std::vector<Vector3> vertices_;
  std::vector<std::size_t> start_ = {0};
  std::vector<int> corners_;
};

/// Volume that a closed hull holds, and its distribution.
struct EnclosedVolume {
  double volume = not_a_number;                      ///< m3; negative if the normals point inwards
  Vector3 centre = Vector3::Constant(not_a_number);  ///< p_BoC_B, m
  /// Moments of inertia of the volume about its centre in B, m5: times a density, those of a solid
  /// of the hull's shape.
  Symmetric3 inertia;
};

/// Sums the tetrahedra that the triangles span with the body's origin: exact for a closed hull.
EnclosedVolume calc_enclosed_volume(const Hull& hull);

/// The same hull in a frame A in which B has the pose X_AB.
Hull transform(const Pose& X_AB, const Hull& hull_B);

/// Vertices nearer to each other than `tolerance` (m) become one; panels that lose an edge lose a
/// corner, panels with fewer than three corners left disappear.
Hull merge_vertices(const Hull& hull, double tolerance);

/// All panels turned round: an inward hull becomes an outward one.
Hull reverse(const Hull& hull);

/// The hull with its panels turned so that neighbours agree along their edges and each connected
/// part encloses a positive volume: for surfaces whose program leaves the sense open. Panels that
/// share an edge with several others are passed over; diagnose() then says so.
Hull turned_outwards(const Hull& hull);

/// The hull with its mirror image in the plane through Bo square to `axis` (0: x, 1: y), vertices
/// on the plane joined. For meshes that hold one half only.
Hull with_mirror_image(const Hull& hull, int axis, double tolerance);

/// Closes each opening whose rim lies in one plane by a lid: triangles between the rim and its mean
/// point. A mesh of the wetted surface alone becomes a closed body with a deck at its rim.
/// @throws ModelError if a rim is not closed, or leaves its plane by more than `tolerance` (m); the
///   message names a vertex of it.
Hull with_lids(const Hull& hull, double tolerance);

}  // namespace blocklift::dynamics

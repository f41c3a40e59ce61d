#pragma once

#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Triangles that stand for shells, in a tree of boxes: what lies near a place, what a ray meets.
///
/// A flat shell is two triangles, a curved one 2 x 8 x 8.
class ShellTree {
 public:
  /// @param shells places in Mesh::shells; the mesh must outlive this object.
  ShellTree(const Mesh& mesh, const std::vector<int>& shells);

  /// Visits the shells whose boxes come within a distance of a place, m; each once.
  void for_each_near(const Vector3& place, double distance,
                     const std::function<void(int shell)>& visit) const;
  /// Does a ray meet a shell farther away than `from`, m? Plates seen edgewise are not met.
  /// @param direction a unit vector.
  bool is_hit(const Vector3& origin, const Vector3& direction, double from) const;

 private:
  struct Triangle {
    int shell = 0;
    Vector3 corner, side_1, side_2;
  };
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0,
        count = 0;  ///< triangles of a leaf; count 0: the children are this + 1 and `other`
    int other = -1;
  };
  void add(const Mesh& mesh, int shell);
  int build(int first, int count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

/// Square of the distance of a place from a triangle a, a + side_1, a + side_2, m^2.
double squared_distance(const Vector3& place, const Vector3& a, const Vector3& side_1,
                        const Vector3& side_2);

}  // namespace blocklift::structure

#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Straight or evenly curved stretch of a field's outline between two of its corners.
struct FieldEdge {
  /// Edge of a shell, in the direction in which the outline runs.
  struct Piece {
    int shell = 0;
    Eigen::Vector2d begin = Eigen::Vector2d::Zero(),
                    end = Eigen::Vector2d::Zero();  ///< unit square
    int from = 0, to = 0;                           ///< vertices
    double length = 0;                              ///< m
  };
  std::vector<Piece> pieces;
  double length = 0;        ///< m
  bool is_free = false;     ///< no other shell meets the field there
  double angle_at_end = 0;  ///< of the field's material at the vertex where the edge ends, rad
};

/// Plating that goes on smoothly with one section: bounded by joints with other plates, by kinks,
/// changes of thickness and free edges. How shells or regions divide it does not matter.
struct PlateField {
  std::vector<int> shells;
  std::vector<bool> is_flipped;  ///< of each shell: its normal is against the field's
  int region = 0;                ///< that has most of the shells
  /// Outlines, each running round with the field on its left, seen against its normal; the first
  /// one found may be a hole's.
  std::vector<std::vector<FieldEdge>> outlines;
};

/// The fields of a mesh, and the vertices where linear elasticity knows no limit of the stress in a
/// field's plane: where an outline turns away from the material (openings' corners, ends of
/// brackets) or a joint on it begins or ends (lugs' toes).
struct PlateFields {
  std::vector<PlateField> fields;
  std::vector<int> field_of_shell;
  std::vector<int> singular_vertices;
  /// Straight stretches along which lugs stand on plating: the vertices at their ends.
  std::vector<std::array<int, 2>> lug_roots;
};

/// Is a field to go on from one of two shells into the other, which meet nothing else at the edge
/// between the two vertices?
using GoesOn = std::function<bool(int shell, int other, int vertex_1, int vertex_2)>;

/// @param kink angle between two shells' normals from which on a field ends, rad.
/// @param goes_on empty: into shells of the same section.
PlateFields find_fields(const Mesh& mesh, double kink = 0.15, const GoesOn& goes_on = {});

/// A point of a shell.
struct ShellPlace {
  int shell = 0;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
};

/// Finds points of a field by walking from shell to shell.
class FieldWalker {
 public:
  /// The mesh must outlive this object.
  FieldWalker(const Mesh& mesh, const PlateFields& fields);
  /// The point of the start's field that lies nearest to a place, if the place lies over it (to
  /// 1e-6 of a shell's size).
  std::optional<ShellPlace> find(const Vector3& place, const ShellPlace& start) const;

 private:
  /// Goes to the neighbour across the edge beyond which the place lies farthest. From many shells
  /// away, over curved ones most of all, that may end beside the place.
  std::optional<ShellPlace> walk(const Vector3& place, const ShellPlace& start) const;
  /// Goes along the straight line to the place in steps of a shell's height.
  std::optional<ShellPlace> march(const Vector3& place, const ShellPlace& start) const;

  const Mesh& mesh_;
  std::vector<std::array<int, 4>> neighbours_;  ///< across edges, within the field; -1: none
};

}  // namespace blocklift::structure

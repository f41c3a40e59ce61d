#pragma once

#include <map>
#include <set>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/fields/fields.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// A shell as it counts in its field: area, middle and normal of the field's side.
struct ShellShare {
  double area = 0;  ///< m^2
  Vector3 middle = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
};
ShellShare share_of_shell(const Mesh& mesh, int number, bool is_flipped);

/// Mean normal of a field, the direction in which most of its outline runs, and that across it.
struct FieldAxes {
  Vector3 normal = Vector3::Zero();
  Vector3 e_1 = Vector3::Zero();
  Vector3 e_2 = Vector3::Zero();

  Eigen::Vector2d in_plane(const Vector3& place) const { return {e_1.dot(place), e_2.dot(place)}; }
};
FieldAxes axes_of(const Mesh& mesh, const PlateField& field);

/// Field of plate that is checked against buckling as one rectangle.
struct BucklingField {
  PlateField field;
  /// Of a piece cut off at a re-entrant corner: the longer side of the rectangle about all of the
  /// plate that was cut; 0: the field is whole.
  double whole_length = 0;  ///< m
  /// Of a sector of curved plating: what all of the plating turns about, and the length round it
  /// over which it buckles under compression round it. Flat plating has none.
  Vector3 bend_axis = Vector3::Zero();
  double arc = 0;  ///< m
};

struct BucklingFields {
  std::vector<BucklingField> fields;
  /// Edges of shells between pieces that were cut at re-entrant corners; those between sectors are
  /// not among them.
  std::set<EdgeKey> cuts;
  /// Vertices along cuts, moved onto the straight line of the cut: shells are not divided, and a
  /// mesh that does not follow the line leaves a jagged border.
  std::map<int, Vector3> straightened;

  const Vector3& place(const Mesh& mesh, int vertex) const {
    const auto found = straightened.find(vertex);
    return found == straightened.end() ? mesh.vertices[vertex] : found->second;
  }
};

/// The fields of a mesh that buckle as one: between crossing plates, beams and kinks. Pads belong
/// to their plates; beams and lugs' edges hold.
///   - Plating that turns by 45 degrees or more is cut along its generators into sectors of about
///     30 degrees (22.5 to 37.5, as far as the shells allow): under bending the mean over half a
///     pipe's turn and more says nothing. A sector's chord is a flat panel's width.
///   - A plate whose outline fills less than 0.85 of the smallest rectangle about it is cut at
///     re-entrant corners, by lines on from their edges or into the corner, as long as the
///     rectangles about both pieces are together 7 % smaller: webs that go round a corner become
///     strips. Openings do not count, except one that is larger than half of the plate's outline:
///     a ring. Outlines without re-entrant corners (brackets, discs) are never cut.
/// @param beams edges along which beams run.
BucklingFields find_buckling_fields(const Mesh& mesh, const std::set<EdgeKey>& beams);

}  // namespace blocklift::structure

#pragma once

#include <optional>
#include <vector>

#include "structure/mesh/mesh.h"
#include "structure/mesh/part_mesh.h"

namespace blocklift::structure {

/// The middle of a quadratic element's edge that lies at a quarter of the edge, near that, or
/// beyond.
///
/// Along an edge from a to b with its middle at m the position is x(s) = a (1-s)(1-2s) +
/// 4 m s(1-s) + b s(2s-1), so that x'(0) = 4 m - 3 a - b. At the quarter point this is 0, the
/// Jacobian vanishes at the corner a, and stress grows there as 1/sqrt(r), without end. Beyond it
/// the edge runs back first: the element is folded. Source: Henshell and Shaw (1975), Barsoum
/// (1976), International Journal for Numerical Methods in Engineering 9 and 10.
struct QuarterMiddle {
  Vector3 place = Vector3::Zero();  ///< of the middle, m
  /// How far the middle is along the straight line from its nearer end, of the edge's length.
  double share = 0.5;
  bool is_at_second_end = false;  ///< the second of the ends is nearer
  /// Beyond the quarter by more than coordinates of four digits are rounded.
  bool is_beyond() const { return share < 0.25 - 2.5e-4; }
};

/// That of an edge, if it is one: where |x'| at an end is less than a tenth of the edge's length
/// (on straight edges a share of 0.225 to 0.275), or the middle lies beyond the quarter.
std::optional<QuarterMiddle> quarter_middle(const Vector3& from, const Vector3& to,
                                            const Vector3& middle);

/// The one of a quadratic shell that is nearest to an end; nothing of others.
std::optional<QuarterMiddle> quarter_middle_of(const Mesh& mesh, const Shell& shell);
std::optional<QuarterMiddle> quarter_middle_of(const Mesh& mesh, const Solid& solid);

/// The same of a part's element, with the corner that it is nearer to.
struct QuarterMiddleOfElement {
  QuarterMiddle middle;
  int element = 0;
  int corner = 0;  ///< of the element's nodes
};
/// Of all solids of a part whose elements are of order 2, one an element.
std::vector<QuarterMiddleOfElement> find_quarter_middles(const PartMesh& mesh);

}  // namespace blocklift::structure

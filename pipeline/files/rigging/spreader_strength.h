#pragma once

#include <optional>
#include <vector>

#include "pipeline/files/rigging/spreader.h"

namespace blocklift::pipeline {

/// The largest compression along a straight bar about its middle (the largest pull, negative, if it
/// is pressed nowhere), and the largest moments about its axes y and z, each by itself.
///
/// Weight and inertia are those of an even rod: a load along it, linear in x, that balances forces
/// and moments exactly, so that no acceleration is asked for. Moments are those about the bar's
/// axis where it is straight: that of an eye beside it joins at the eye.
structure::ColumnForces largest_forces(const std::vector<structure::PointForce>& forces,
                                       double length);

/// What is within a spreader, the largest of each of its bars: one, or the four sides of a frame.
using SpreaderForces = std::vector<structure::MemberForces>;

/// A spreader under the forces of its ropes.
class SpreaderStrength {
 public:
  /// @param points where ropes pull at it, in its axes; a frame is divided there.
  SpreaderStrength(const given::Spreader& spreader, const std::vector<Vector3>& points);

  /// Under those forces, one for each of the points, and the weight and inertia that balance them:
  /// `largest_forces` of a bar, structure::RectangularFrame of a frame.
  SpreaderForces find_forces(const std::vector<structure::PointForce>& forces) const;

  /// The largest share of its resistance that one of its bars bears, all forces times a factor:
  /// structure::column_utilisation of a bar, structure::member_utilisation of a frame's sides.
  double utilisation(const SpreaderForces& forces, double factor) const;

 private:
  structure::Column bar_;
  std::optional<structure::RectangularFrame> frame_;
};

}  // namespace blocklift::pipeline

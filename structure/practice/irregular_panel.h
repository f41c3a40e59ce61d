#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace blocklift::structure {

/// Rectangle that stands for a panel with four corners and edges that are not straight, or not
/// parallel.
struct EquivalentRectangle {
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit vector along its length
  double length = 0;                                 ///< m
  double width = 0;                                  ///< m
};

/// The equivalent rectangle of an outline: of its two pairs of opposite edges that of the smaller
/// total length, measured along the outline, is taken for the ends; the length is the distance
/// between the middles of these two edges, the width the enclosed area over the length. A strip
/// round a bend is as long as its middle chord, and wider than itself by arc over chord. The width
/// is also no less than that of either end, seen along the length: where a panel tapers the rules
/// have its mean, and it buckles where it is wide.
///
/// The corners are the places whose angle is within 45 degrees of a right one. The rules take the
/// four that come nearest to it, whatever they are; here an outline is none of a quadrangle, and
/// has no equivalent, if there are not just four or if it turns by 45 degrees or more elsewhere.
/// @param outline places in turn, either way round, m.
/// Source: IACS Common Structural Rules for Bulk Carriers and Oil Tankers (2014), part 1 chapter 8
/// section 4, on panels of irregular geometry. The rules were not at hand.
std::optional<EquivalentRectangle> equivalent_rectangle(
    const std::vector<Eigen::Vector2d>& outline);

}  // namespace blocklift::structure

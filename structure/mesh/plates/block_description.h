#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/beams/sections.h"
#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Axes of the block frame B: x along, y across, z up. All lengths below are in B, m.
enum class Axis { x = 0, y = 1, z = 2 };

/// "x", "y" or "z".
std::string name_of(Axis axis);

/// Closed interval on one axis, m.
struct Interval {
  double lower = 0;
  double upper = 0;
};

/// Flat rectangular plates of one kind, all normal to one axis: one for each position.
/// Thickness is laid half on each side of the mid-plane `axis = position`.
///
/// An edge that ends inside another plate's thickness is led through to that plate's far face, so
/// that corners are full and no edge hangs on half a plate.
struct Plate {
  std::string name;
  Axis normal = Axis::z;
  std::vector<double> positions;   ///< of the mid-planes along the normal, m
  std::array<Interval, 3> extent;  ///< along x, y, z, m; the entry of the normal is not read
  double thickness = 0;            ///< m
  std::string material;            ///< name of one of BlockDescription::materials
};

/// Edge of a plate: straight pieces from point to point, or the arc from the first of three points
/// through the second to the third, m.
struct PlateEdge {
  std::vector<Vector3> points;
  bool is_arc = false;
};

/// Plate of any orientation: a plane polygon by its corners, or the ruled surface between two edges
/// (straight lines join points of equal share: a bilge, a twisted plate). Its thickness lies half
/// on each side of it; it is joined to what it meets, crosses or ends on within 0.1 mm.
struct FreePlate {
  std::string name;
  std::vector<Vector3> corners;    ///< in order around it, m; empty: by its edges
  std::array<PlateEdge, 2> edges;  ///< that run the same way
  double thickness = 0;            ///< m
  std::string material;            ///< name of one of BlockDescription::materials
};

/// Hole through a plane free plate: a polygon, a circle (one centre), or a slot (two).
struct FreeOpening {
  std::string name;
  std::string plate;
  std::vector<Vector3> corners, centres;  ///< one of them empty, m
  double radius = 0;                      ///< m
};

/// Hole through plates: a rectangle, whose corners may be rounded, or a polygon. It cuts the named
/// plates only: what crosses a rectangle stays; other shapes lie between what joins or divides
/// their plate.
struct Opening {
  std::string name;
  std::string plate;              ///< name of the plates that it cuts
  std::vector<double> positions;  ///< which of the plates, by position (m); empty: all of them
  std::array<Interval, 3> extent;
  double corner_radius = 0;  ///< m; half of the sides: a circle, half of the shorter one: a slot
  std::vector<Vector3> corners = {};  ///< of a polygon, in order, instead of the extent, m
};

/// Equal stiffeners on plates, in a row: beams that stand on one side and run along an axis, from
/// edge to edge of the plate. None stands on its edges; openings cut them, and they are left out
/// where another plate stands in their place.
///
/// As plates they are a web from the plate's mid-plane to the flange's, or to the top of a flat
/// bar, and a flange; what crosses them is joined to them.
struct Stiffeners {
  std::string name;
  std::string plate;              ///< name of the plates that carry them
  std::vector<double> positions;  ///< which of the plates, by position (m); empty: all of them
  Axis along = Axis::x;
  double spacing = 0;           ///< between neighbours, m
  std::optional<double> first;  ///< place of one of them across, m; absent: the plate's lower edge
  int side = 1;                 ///< of the plate, along its normal: +1 or -1
  /// Profile in its own axes: axis 2 points away from the plate, axis 3 is (along) x (axis 2). The
  /// section's material is not read.
  BeamSection section;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< from the profile's foot on the plate, m
  std::string material;                                ///< empty: that of the plate
  double tripping_brackets = 0;                        ///< as Group's, m
  std::optional<StiffenerPlates> plates = {};          ///< of which they are made instead of beams
};

/// Thickened region of a plate around a lug: layers on both sides of the plate fill up to
/// `thickness` in total.
struct Pad {
  std::string name;
  std::string plate;  ///< name of the plate that it thickens; empty: whichever lies there
  Axis normal = Axis::z;
  double position = 0;  ///< of the mid-plane along the normal, m
  std::array<Interval, 3> extent;
  double thickness = 0;  ///< in total, m
  std::string material;  ///< empty: that of the plate
};

/// Lug: a plate that stands on (or lies in) a pad, with the pin centre at which the rope pulls.
/// The rope's force is spread over the lug plate with exact resultant and moment about the pin.
struct Lug {
  std::string name;
  std::string pad;  ///< name of the pad that it is joined to
  Axis normal = Axis::z;
  double position = 0;
  std::array<Interval, 3> extent;
  double thickness = 0;
  std::string material;  ///< empty: that of the pad
  Vector3 p_BPin = Vector3::Zero();
};

/// Thickened region of a plane free plate, in the plate's frame
/// (structure/mesh/fields/plane_frame.h).
struct FreePad {
  std::string name;
  std::string plate;
  std::array<Interval, 2> extent;  ///< along u and v, m
  double thickness = 0;            ///< in total, m
  std::string material;            ///< empty: that of the plate
};

/// Lug that stands on (or lies in) a free pad: a rectangle normal to u, v or n of the plate's frame
/// (here x, y, z).
struct FreeLug {
  std::string name;
  std::string pad;
  Axis normal = Axis::x;
  double position = 0;               ///< along its normal, m
  std::array<Interval, 3> extent;    ///< along u, v, n, m
  double thickness = 0;              ///< m
  std::string material;              ///< empty: that of the pad
  Vector3 p_BPin = Vector3::Zero();  ///< in the block's frame, m
};

/// Bar along straight lines from point to point, as a strut, a pillar or a brace is: it is joined
/// to what it ends on, crosses or runs along in the middle planes.
struct Bar {
  std::string name;
  std::vector<Vector3> points;  ///< two or more, m
  Profile profile;              ///< as give_profile (files/surfaces/given_properties.h) takes it
  std::optional<Vector3> towards;
  std::string material;
  bool is_hinged = false;  ///< bending does not pass through its two ends; torsion does
};

/// Stiffened block of plates, as a block file describes it.
struct BlockDescription {
  std::string name;
  std::vector<Material> materials;
  std::vector<Plate> plates;
  std::vector<FreePlate> free_plates;
  std::vector<Opening> openings;
  std::vector<FreeOpening> free_openings;
  std::vector<Pad> pads;
  std::vector<Lug> lugs;
  std::vector<FreePad> free_pads;
  std::vector<FreeLug> free_lugs;
  std::vector<Stiffeners> stiffeners;
  /// On plane free plates: x is u and y is v of the plate's frame, in which `first` counts.
  std::vector<Stiffeners> free_stiffeners;
  std::vector<Bar> bars;
  /// Mass and centre of mass in the lift, outfitting included; absent: those of the plates alone.
  std::optional<double> total_mass;         ///< kg
  std::optional<Vector3> centre_of_mass_B;  ///< m
  /// Longest edge of an element, m; up to 1.3 times that where a thin slice joins its neighbour.
  /// Two elements or more across each unsupported panel show its bending.
  double largest_element = 2;
};

}  // namespace blocklift::structure

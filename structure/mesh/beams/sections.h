#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"

namespace blocklift::structure {

/// Web and flange of a stiffener as plates: their middle lines and thicknesses, m. The web stands
/// on the origin along axis 2, the flange lies across its end along axis 3.
struct StiffenerPlates {
  double web_height = 0;     ///< from the foot to the flange's middle line; without one to the top
  double web_thickness = 0;  ///< m
  double flange_thickness = 0;                  ///< 0: it has no flange
  std::array<double, 2> flange_reach = {0, 0};  ///< along axis 3 from the web's middle
};

/// Cross-section drawn in axes (x_2, x_3) of its own, whose origin each shape names.
struct Profile {
  BeamSection section;  ///< about the centroid; its material is unset
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< from the origin, m
  bool is_round = false;  ///< the same seen from all sides: it stands towards none
  /// Of flat bars, angles, tees and, as the equivalent angle, bulb flats.
  std::optional<StiffenerPlates> plates = {};
};

/// Where the profile begins along axis 2, from its origin, m: what stands on a plate has its foot
/// there.
double foot_of(const Profile& profile);

/// Straight wall of an open or closed profile between two of its nodes. Where walls meet, one of
/// them ends short of the node or goes beyond it, so that areas add up without overlap.
struct Wall {
  int from = 0, to = 0;                         ///< nodes on the middle lines
  double thickness = 0;                         ///< m
  double longer_at_from = 0, longer_at_to = 0;  ///< by which the solid goes beyond its nodes, m
};

/// Profile of walls, of which area and second moments are those of the solid rectangles; torsion,
/// shear areas and the shear centre are those of the middle lines (ThinWalls).
///
/// @throws ModelError if a wall has no thickness or length, or the walls hang together by no node.
Profile walled_profile(const std::string& name, const std::vector<Eigen::Vector2d>& nodes,
                       const std::vector<Wall>& walls);

/// Polygon by its corners in turn, m.
struct Outline {
  std::vector<Eigen::Vector2d> corners;
  bool is_hole = false;
};
/// The same with area and second moments of an outline, for walls that lie on one another.
Profile outlined_profile(const std::string& name, const std::vector<Outline>& outlines,
                         const std::vector<Eigen::Vector2d>& nodes, const std::vector<Wall>& walls);

/// Solid within a polygon. Torsion is J = A^4 / (40 I_p), which is 7 % more than that of a square
/// and 10 % less than that of a long rectangle; shear areas are 5/6 of the area.
/// Source: Saint-Venant (1879), in Timoshenko and Goodier (1970), section 106.
Profile solid_polygon(const std::string& name, const std::vector<Eigen::Vector2d>& corners);

/// A profile seen in other axes: first 2 and 3 exchanged if asked, then turned to point the other
/// way. Its plates stay where axis 2 does.
Profile seen(const Profile& profile, bool exchanged, bool reversed_2, bool reversed_3);

// Stiffeners: the origin is the middle of the edge that stands on the plate, axis 2 points away
// from it. All measures are in m and positive, or a ModelError says which is not.

/// Rectangle; J by Roark's series, shear areas 5/6.
Profile flat_bar(double height, double thickness);
/// Unequal angle; `height` over the flange, which points along axis 3.
Profile angle_bar(double height, double web, double width, double flange);
Profile tee_bar(double height, double web, double width, double flange);

/// Bulb flat (Holland profile) of EN 10067: a plate of `height` and `thickness` whose bulb reaches
/// `bulb` beyond one face, its lower side sloped by 30 degrees, corners rounded by `radius`.
///
/// Area and moments are those of the outline. Torsion, shear area, shear centre and plates are
/// those of the equivalent angle of the IACS Common Structural Rules (2014), part 1 chapter 3
/// section 7, [1.4.1].
Profile bulb_flat(double height, double thickness, double bulb, double radius);
/// The same by its nominal height and thickness, bulb and radius from the list of EN 10067, whose
/// heights are 120 to 430 mm.
Profile bulb_flat(double height, double thickness);

// Other shapes: the origin is the middle of the rectangle about them.

/// Figures of a section whose outline is not known, within a rectangle about its centroid.
struct SectionFigures {
  double height = 0, width = 0;  ///< of the rectangle along axis 2 and 3, m
  double area = 0;               ///< m^2
  double second_moment_3 = 0;    ///< bending along axis 2, m^4
  double second_moment_2 = 0;    ///< bending along axis 3, m^4
  double torsion = 0;            ///< J, m^4
  /// Along axis 2 and 3, m^2; infinite: no shear deformation.
  double shear_area_2 = std::numeric_limits<double>::infinity();
  double shear_area_3 = std::numeric_limits<double>::infinity();
};
/// Stress is looked at in the rectangle's corners: exact where the section reaches them, else more
/// than there is. @throws ModelError if a figure is not positive or no section within the rectangle
/// could have it.
Profile profile_of_figures(const SectionFigures& figures);

/// Rectangle of `height` along axis 2 and `width` along axis 3.
Profile solid_rectangle(double height, double width);
/// Shear areas by Cowper (1966) with Poisson's ratio 0.3.
Profile solid_circle(double radius);
Profile pipe(double outer_radius, double inner_radius);
/// Box; `top` and `bottom` are across axis 2.
Profile box(double height, double width, double top, double bottom, double left, double right);
Profile box(double height, double width, double thickness);
/// I; the first flange is at the bottom.
Profile i_beam(double height, double web, double width_bottom, double flange_bottom,
               double width_top, double flange_top);
/// Channel with its web along axis 2 and flanges towards positive axis 3.
Profile channel(double height, double web, double width, double flange);

}  // namespace blocklift::structure

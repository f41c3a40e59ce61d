#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/geometry_format.h"
#include "pipeline/files/structure/block_mesh.h"
#include "pipeline/files/structure/load_edge.h"
#include "pipeline/files/structure/padeye_format.h"
#include "pipeline/mechanism/mechanism_parts.h"
#include "structure/mesh/beams/sections.h"
#include "structure/mesh/fields/plane_frame.h"

namespace blocklift::pipeline {

/// What lies no farther apart than this lies in one place, m.
inline constexpr double same_place = 1e-6;

/// Isotropic elastic material. SI units.
struct MaterialModel {
  Located<std::string> name;
  double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
  double poisson_ratio = std::numeric_limits<double>::quiet_NaN();
  double density = std::numeric_limits<double>::quiet_NaN();       ///< kg/m^3
  double yield_stress = std::numeric_limits<double>::quiet_NaN();  ///< Pa
};

/// Rectangle normal to an axis of the block, or of the frame of a plate by its corners
/// (structure/mesh/fields/plane_frame.h): its extent along the two other axes, m.
struct Rectangle {
  std::size_t normal = 0;          ///< 0, 1, 2 for x, y, z, or u, v, n
  bool is_in_plate_frame = false;  ///< the axes are u, v, n
  std::array<std::optional<Located<std::array<double, 2>>>, 3> extent;
};

/// Equal stiffeners that a plate carries: they divide its panels in the check of buckling. With a
/// profile they are beams or plates of the model, too; without one it leaves them out.
struct StiffenersModel {
  std::size_t along = 0;  ///< axis: 0, 1, 2 for x, y, z; 0, 1 for u, v of a plate by its corners
  double spacing = std::numeric_limits<double>::quiet_NaN();  ///< m
  std::optional<structure::Profile> profile;                  ///< from its foot on the plate
  bool are_plates = false;                                    ///< web and flange, instead of beams
  int side = 1;                                               ///< of the plate, along its normal
  std::optional<double> first;    ///< place of one of them across, m; else the plate's lower edge
  Located<std::string> material;  ///< empty: that of the plate
  std::optional<double> tripping_brackets;  ///< from one to the next, m; else there are none
};

/// Edge of a plate: straight pieces from point to point, or an arc from the first of three points
/// through the second to the third, m.
struct EdgeModel {
  std::vector<Vector3> points;
  bool is_arc = false;
};

/// Equal plates, one at each of several positions along their common normal; or one of any
/// orientation, by its corners or between two edges.
struct PlateModel : Rectangle {
  Located<std::string> name;
  std::string origin;      ///< of a copy: the name of what it was made of; else empty
  std::vector<double> at;  ///< positions of the mid-planes, m
  double thickness = std::numeric_limits<double>::quiet_NaN();
  Located<std::string> material;  ///< the block's only one where the file names none
  std::optional<StiffenersModel> stiffeners;
  std::optional<Located<std::vector<Vector3>>> corners;  ///< of a plane polygon, in order, m
  std::optional<Located<std::vector<EdgeModel>>> edges;  ///< two, between which the plate is ruled

  bool is_free() const { return corners || edges; }
};

/// Hole in plates: a rectangle, whose corners may be rounded, or a polygon; in a plate by its
/// corners a polygon, a circle or a slot.
struct OpeningModel {
  Located<std::string> name;
  std::string origin;  ///< of a copy: the name of what it was made of; else empty
  Located<std::string> plate;
  std::vector<double> at;  ///< which of the plates, by position; empty: all
  std::array<std::optional<Located<std::array<double, 2>>>, 3> extent;
  std::optional<Located<double>> corner_radius;  ///< m
  std::vector<Vector3> corners;                  ///< of a polygon, in place of the extent, m
  std::vector<Vector3> centres;                  ///< of a circle (one) or a slot's ends (two), m
  std::optional<Located<double>> radius;         ///< about the centres, m
};

/// Thickened region of a plate around a lug.
struct PadModel : Rectangle {
  Located<std::string> name;
  std::string origin;  ///< of a copy: the name of what it was made of; else empty
  Located<std::string> plate;
  double at = std::numeric_limits<double>::quiet_NaN();
  double thickness = std::numeric_limits<double>::quiet_NaN();  ///< in total, m
  Located<std::string> material;                                ///< empty: that of the plate
};

/// How a padeye stands on a mesh, which has no pad and no lug plate that would say so. Its frame P
/// (structure::PadeyeGeometry) has z along `axis` and y along `up`.
struct PadeyeOnMesh {
  Located<std::string> design;      ///< name of the block's padeye
  Vector3 axis = Vector3::UnitY();  ///< of the pin, a unit vector
  Vector3 up = Vector3::UnitZ();    ///< from the base to the pin, a unit vector across the axis
  double height = std::numeric_limits<double>::quiet_NaN();  ///< of the pin above the base, m
  std::array<double, 2> base = {};  ///< how far it runs from below the pin to -x and +x of P, m
};

/// Lug plate with the pin at which a rope pulls; on a mesh, a place of it and what carries the
/// rope.
struct LugModel : Rectangle {
  Located<std::string> name;
  std::string origin;  ///< of a copy: the name of what it was made of; else empty
  Located<std::string> pad;
  double at = std::numeric_limits<double>::quiet_NaN();
  double thickness = std::numeric_limits<double>::quiet_NaN();
  Located<std::string> material;  ///< empty: that of the pad
  /// Centre of the pin, m. On a mesh it may be left out: then it is found when the mesh is read.
  Located<Vector3> pin{Vector3::Constant(std::numeric_limits<double>::quiet_NaN()), {}};
  Vector3 pin_in_plate = Vector3::Zero();      ///< (u, v, n) where the lug is in a plate's frame, m
  std::optional<Located<std::string>> padeye;  ///< that it is made as
  /// Its padeye stands in the block's mesh as a solid, in place of the lug plate's shells.
  Located<bool> is_solid{false, {}};
  // On a mesh.
  std::optional<Located<int>> node;         ///< the number of the node that it stands at
  std::optional<Located<std::string>> set;  ///< of plates, bars or nodes that carry it
  std::optional<double> radius;             ///< within which plates carry it, m
  std::optional<PadeyeOnMesh> on_mesh;      ///< of a lug that is made as a padeye

  bool is_place = false;  ///< on a mesh, by these keys, rather than a plate of its own
};

/// Bar from point to point: a strut, a pillar, a brace.
struct BarModel {
  Located<std::string> name;
  std::string origin;                    ///< of a copy: the name of what it was made of; else empty
  Located<std::vector<Vector3>> points;  ///< two or more, m
  Located<std::optional<structure::Profile>> section;
  std::optional<Vector3> towards;  ///< the section stands, a unit vector; none of a round one
  Located<std::string> material;   ///< the block's only one where the file names none
  bool is_hinged = false;
};

/// Stiffened block of flat plates, or the mesh of one, in its own frame: x along, y across, z up.
/// SI units.
struct BlockModel {
  std::string kind;
  std::string title;
  std::vector<MaterialModel> materials;
  std::optional<Located<double>> mass;             ///< in the lift, outfitting included, kg
  std::optional<Located<Vector3>> centre_of_mass;  ///< in the lift, m
  std::optional<MeshModel> mesh;                   ///< in place of plates
  std::vector<PlateModel> plates;
  std::vector<BarModel> bars;
  std::vector<OpeningModel> openings;
  std::vector<PadModel> pads;
  std::vector<LugModel> lugs;
  std::vector<LoadEdge> edges;  ///< that ropes may touch
  std::vector<PadeyeDesign> padeyes;
  std::vector<WindAreaModel> wind_areas;
  Mark place;

  const LugModel* find_lug(const std::string& name) const;
  const PadeyeDesign* find_padeye(const LugModel& lug) const;  ///< null: the lug has none
  const PlateModel* find_plate(const std::string& name) const;
  /// The frame that a pad, or a lug with its pad, is given in; none without such a plate.
  std::optional<structure::PlaneFrame> find_frame(const PadModel& pad) const;
  std::optional<structure::PlaneFrame> find_frame(const LugModel& lug) const;
  std::vector<std::string> lug_names() const;
};

/// The format of a block's model file, with the rules that concern its own keys.
Format<BlockModel> block_model_format();

/// Rules over several keys: names exist, rectangles have the extents that their normal asks for,
/// pads lie on their plates, pins in their lugs, bars have a length.
void check_block(const BlockModel& block, Reading& reading, const Mark& mark);

}  // namespace blocklift::pipeline

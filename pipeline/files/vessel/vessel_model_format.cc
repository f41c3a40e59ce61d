#include "pipeline/declaration/table.h"
#include "pipeline/files/vessel/vessel_model.h"

namespace blocklift::pipeline {
namespace {

using dynamics::BargeShape;
using dynamics::ShipShape;

Format<BargeShape> barge_format() {
  const auto length = quantity(Dimension::length, Range::positive());
  const auto part = quantity(Dimension::length, Range::not_negative());
  Table<BargeShape> table("barge", "A pontoon with flat bottom, sides and ends.");
  table.required("length", &BargeShape::length, length, "over all")
      .required("breadth", &BargeShape::breadth, length, "from side to side")
      .required("depth", &BargeShape::depth, length, "from base line to deck")
      .by_default("bilge_radius", &BargeShape::bilge_radius, part, "0 m",
                  "of the round between bottom and sides")
      .by_default("bow_rake_length", &BargeShape::bow_rake_length, part, "0 m",
                  "over which the bottom rises at the bow")
      .by_default("bow_rake_height", &BargeShape::bow_rake_height, part, "0 m",
                  "by how much it rises")
      .by_default("stern_rake_length", &BargeShape::stern_rake_length, part, "0 m",
                  "over which the bottom rises at the stern")
      .by_default("stern_rake_height", &BargeShape::stern_rake_height, part, "0 m",
                  "by how much it rises")
      .by_default("corner_length", &BargeShape::corner_length, part, "0 m",
                  "of the chamfered corners, along the barge")
      .by_default("corner_breadth", &BargeShape::corner_breadth, part, "0 m",
                  "of the chamfered corners, across");
  return table.format();
}

Format<ShipShape> ship_format() {
  const auto length = quantity(Dimension::length, Range::positive());
  const auto part = quantity(Dimension::length, Range::not_negative());
  const auto exponent = number(Range::between(0.5, 50));
  const auto fullness = number(Range::between(1, 50));
  Table<ShipShape> table("ship",
                         "A ship-shaped hull: a middle body with flat sides between tapering "
                         "ends. Exponents: the larger, the fuller.");
  table.required("length", &ShipShape::length, length, "between the ends of the hull")
      .required("breadth", &ShipShape::breadth, length, "moulded")
      .required("depth", &ShipShape::depth, length, "from base line to deck")
      .required("draught", &ShipShape::draught, length,
                "height at which the sections become upright")
      .required("bow_length", &ShipShape::bow_length, part, "of the tapering fore body")
      .required("stern_length", &ShipShape::stern_length, part, "of the tapering aft body")
      .by_default("bow_exponent", &ShipShape::bow_exponent, exponent, "2",
                  "of the water lines forward")
      .by_default("stern_exponent", &ShipShape::stern_exponent, exponent, "2",
                  "of the water lines aft")
      .by_default("transom_breadth", &ShipShape::transom_breadth, part, "0 m", "at the after end")
      .by_default("midship_section_exponent", &ShipShape::midship_section_exponent, fullness, "8",
                  "of the section amidships")
      .by_default("bow_section_exponent", &ShipShape::bow_section_exponent, fullness, "2",
                  "of the foremost section")
      .by_default("stern_section_exponent", &ShipShape::stern_section_exponent, fullness, "2",
                  "of the aftermost section");
  return table.format();
}

void check_hull(const VesselHullModel& hull, Reading& reading, const Mark& mark) {
  const int given = (hull.barge ? 1 : 0) + (hull.ship ? 1 : 0) + (hull.file ? 1 : 0);
  if (given == 1) return;
  reading.error(mark, given == 0 ? "the hull is not described" : "the hull is described twice",
                {"give one of barge, ship and mesh"});
}

Format<VesselHullModel> hull_format() {
  Table<HullFileModel> file("hull mesh", "A closed surface mesh in the vessel's frame, in metres.");
  file.required("file", &HullFileModel::path, located(text()),
                "beside the model: .msh, .geo, .stl (Gmsh) or .gdf (WAMIT)")
      .by_default("close_openings", &HullFileModel::close_openings, boolean(), "false",
                  "close flat openings at the top by lids: for meshes of the wetted surface alone")
      .by_default("symmetric_in", &HullFileModel::symmetric_in,
                  list_of(choice<int>({{"x", 0}, {"y", 1}}), 0, 2), "[]",
                  "planes in which the hull, if not its mesh, is symmetric: [y] the centre plane, "
                  "[x] the one amidships. The half at positive y, or x, is cut off there and "
                  "mirrored, so that half of the panels, or a quarter, are computed");
  Table<VesselHullModel> table("hull", "The hull, by one of three descriptions.");
  table.optional("barge", &VesselHullModel::barge, barge_format(), "a pontoon")
      .optional("ship", &VesselHullModel::ship, ship_format(), "a ship-shaped hull")
      .optional("mesh", &VesselHullModel::file, file.format(), "a mesh from a file")
      .rule(check_hull);
  return table.format();
}

}  // namespace

Format<VesselModel> vessel_model_format() {
  const auto radii = converted<std::array<double, 3>, Vector3>(
      array_of<double, 3>(quantity(Dimension::length, Range::positive())),
      [](std::array<double, 3> r) { return Vector3(r[0], r[1], r[2]); });
  Table<VesselModel> table("vessel",
                           "A floating body. Its frame: origin on the base line amidships in the "
                           "centre plane, x forward, y to port, z up.");
  table
      .required("kind", &VesselModel::kind, choice<std::string>({{"vessel", "vessel"}}),
                "what this file describes")
      .optional("title", &VesselModel::title, text(), "for people")
      .required("hull", &VesselModel::hull, hull_format(), "its outer surface up to the deck")
      .required("panel_size", &VesselModel::panel_size,
                quantity(Dimension::length, Range::positive()),
                "edge length of the panels; at most an eighth of the shortest wave")
      .required("mass", &VesselModel::mass, quantity(Dimension::mass, Range::positive()),
                "of the vessel, ballast included, without what a case adds to it")
      .required("centre_of_mass", &VesselModel::centre_of_mass, position_format(), "in its frame")
      .required("radii_of_gyration", &VesselModel::radii_of_gyration, radii,
                "about the axes through the centre of mass")
      .by_default("hydrodynamics", &VesselModel::hydrodynamics, hydrodynamic_settings_format(),
                  "{}", "what blocklift hydro computes")
      .place(&VesselModel::place);
  return table.format();
}

}  // namespace blocklift::pipeline

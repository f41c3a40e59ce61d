#include "pipeline/files/structure/block_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "pipeline/files/structure/copied_parts.h"
#include "pipeline/files/structure/lug_format.h"
#include "pipeline/files/structure/profile_format.h"
#include "pipeline/files/structure/rectangle_keys.h"

namespace blocklift::pipeline {
namespace {

/// Positions from, from + spacing, ... to.
struct Stations {
  double from = std::nan("");
  double to = std::nan("");
  std::optional<double> spacing;
  std::optional<int> count;
};

void check_stations(const Stations& s, Reading& reading, const Mark& mark) {
  if (s.spacing.has_value() == s.count.has_value()) {
    reading.error(mark, "evenly spaced positions take either spacing or count");
    return;
  }
  if (s.from >= s.to) {
    reading.error(mark, fmt::format("the positions end at {:.6g} m, where they begin at {:.6g} m",
                                    s.to, s.from));
    return;
  }
  if (!s.spacing) return;
  const double steps = (s.to - s.from) / *s.spacing;
  if (steps > 10000) {
    reading.error(mark, fmt::format("there would be {:.0f} positions; 10000 are allowed", steps));
  } else if (std::abs(steps - std::round(steps)) > 1e-6) {
    reading.error(mark,
                  fmt::format("a spacing of {:.6g} m does not divide the {:.6g} m from {:.6g} m "
                              "to {:.6g} m",
                              *s.spacing, s.to - s.from, s.from, s.to));
  }
}

std::vector<double> positions_of(const Stations& s) {
  const double spaces =
      s.count ? *s.count - 1 : std::round((s.to - s.from) / s.spacing.value_or(0));
  std::vector<double> positions;
  const bool divides = s.count || std::abs((s.to - s.from) / s.spacing.value_or(0) - spaces) < 1e-6;
  if (!divides || !std::isfinite(spaces) || spaces < 1 || spaces > 10000) return positions;
  for (int i = 0; i <= static_cast<int>(spaces); ++i) {
    positions.push_back(s.from + (s.to - s.from) * i / spaces);
  }
  return positions;
}

Format<std::vector<double>> positions_format() {
  const auto length = quantity(Dimension::length);
  Table<Stations> table("row of positions", "Evenly spaced positions, both ends included.");
  table.required("from", &Stations::from, length, "first position")
      .required("to", &Stations::to, length, "last position")
      .optional("spacing", &Stations::spacing, quantity(Dimension::length, Range::positive()),
                "distance between neighbours")
      .optional("count", &Stations::count, integer(Range::between(2, 10000)),
                "in place of spacing: how many positions")
      .rule(check_stations);
  const auto one = converted<double, std::vector<double>>(
      length, [](double value) { return std::vector{value}; });
  const auto row = converted<Stations, std::vector<double>>(table.format(), positions_of);
  return by_shape<std::vector<double>>(one, list_of(length, 1), row);
}

Format<MaterialModel> material_format() {
  Table<MaterialModel> table("material", "An isotropic elastic material.");
  table
      .required("youngs_modulus", &MaterialModel::youngs_modulus,
                quantity(Dimension::stress, Range::positive()), "E")
      .required("poisson_ratio", &MaterialModel::poisson_ratio, number(Range::inside(-1, 0.5)),
                "nu")
      .required("density", &MaterialModel::density, quantity(Dimension::density, Range::positive()),
                "of the bare material")
      .required("yield_stress", &MaterialModel::yield_stress,
                quantity(Dimension::stress, Range::positive()), "smallest yield stress");
  return table.format();
}

void check_stiffeners(const StiffenersModel& row, Reading& reading, const Mark& mark) {
  if (!row.profile && row.are_plates)
    reading.error(mark, reading.owner() + " is to be plates, but has no profile",
                  {"without a profile stiffeners are not in the model: they divide panels alone"});
  else if (row.profile && row.are_plates && !row.profile->plates)
    reading.error(mark,
                  fmt::format("{} is to be plates, and has a profile that is none of a web on its "
                              "plate with or without a flange: {}",
                              reading.owner(), row.profile->section.name),
                  {"flat_bar, angle_bar, tee_bar and bulb_flat may be plates; others are beams"});
  if (row.are_plates && row.tripping_brackets)
    reading.error(mark, reading.owner() + " is to be plates, and has tripping brackets",
                  {"tripping is checked by a formula of beams; draw brackets of plates as plates"});
  if (row.profile || (!row.first && row.material.value.empty() && !row.tripping_brackets)) return;
  reading.error(mark,
                reading.owner() + " has a place, a material or tripping brackets, but no profile",
                {"without a profile stiffeners are not in the model: they divide panels alone"});
}

/// @param first what `first` is counted in.
Format<StiffenersModel> stiffeners_format(const Axes& along, const std::string& first) {
  Table<StiffenersModel> table(
      "row of stiffeners",
      "Equal stiffeners that a plate carries, from edge to edge; openings cut them. They divide "
      "its panels where buckling is checked. With a profile they are beams of the model, or plates "
      "if asked; without one the model leaves them out, and their mass belongs to the outfitting.");
  table
      .required("along", &StiffenersModel::along, choice<std::size_t>(along), "axis they run along")
      .required("spacing", &StiffenersModel::spacing,
                quantity(Dimension::length, Range::positive()), "between neighbours")
      .optional("profile", &StiffenersModel::profile, profile_format(),
                "makes them beams or plates that stand on the plate")
      .by_default("as", &StiffenersModel::are_plates,
                  choice<bool>({{"beams", false}, {"plates", true}}), "beams",
                  "what the model has of them: beams, or web and flange as plates that buckle and "
                  "bend on their own; plates of flat_bar, angle_bar, tee_bar and bulb_flat (its "
                  "equivalent angle)")
      .by_default("side", &StiffenersModel::side, choice<int>({{"positive", 1}, {"negative", -1}}),
                  "positive", "of the plate on which they stand, along its normal")
      .optional("first", &StiffenersModel::first, quantity(Dimension::length),
                "place of one of them across, as a coordinate of " + first +
                    "; the plate's lower edge if left out")
      .optional("material", &StiffenersModel::material, reference(),
                "one of the block's; that of the plate if left out")
      .optional("tripping_brackets", &StiffenersModel::tripping_brackets,
                quantity(Dimension::length, Range::positive()),
                "from one to the next: they keep the stiffeners from turning about their toes; "
                "supports of the plate alone do if left out")
      .rule(check_stiffeners);
  return table.format();
}

Format<PlateModel> rectangle_format() {
  Table<Written<PlateModel>> table("plate",
                                   "Equal flat rectangular plates, one at each position "
                                   "along their normal; the thickness lies half on each "
                                   "side.");
  table
      .required("normal", &Rectangle::normal, choice<std::size_t>(block_axes),
                "axis across the plate")
      .required("at", &PlateModel::at, positions_format(), "positions of the mid-planes");
  extent_keys(table)
      .required("thickness", &PlateModel::thickness, quantity(Dimension::length, Range::positive()),
                "of the plate")
      .optional("material", &PlateModel::material, reference(),
                "one of the block's materials; may be left out if there is one only")
      .optional(
          "stiffeners", &PlateModel::stiffeners, stiffeners_format(block_axes, "the block"),
          "that the plate carries: beams or plates with a profile, else left out of the model")
      .rule([](const Written<PlateModel>& plate, Reading& reading, const Mark& mark) {
        if (!plate.stiffeners || plate.stiffeners->along != plate.normal) return;
        reading.error(mark,
                      fmt::format("the stiffeners of {} run along its normal", reading.owner()),
                      {"they run along one of its two other axes"});
      })
      .rule([](const Written<PlateModel>& plate, Reading& reading, const Mark& mark) {
        check_rectangle(plate, block_axes, reading, mark);
      });
  return taken(table);
}

Format<EdgeModel> edge_format() {
  Table<EdgeModel> arc("arc", "A part of a circle by three of its points.");
  arc.required("arc", &EdgeModel::points, list_of(position_format(), 3, 3),
               "its first point, one on the way, and its last");
  const auto curved = converted<EdgeModel, EdgeModel>(arc.format(), [](EdgeModel edge) {
    edge.is_arc = true;
    return edge;
  });
  const auto straight = converted<std::vector<Vector3>, EdgeModel>(
      list_of(position_format(), 2), [](const std::vector<Vector3>& points) {
        return EdgeModel{points, false};
      });
  return by_shape<EdgeModel>(std::nullopt, straight, curved);
}

/// A plate of any orientation.
Format<PlateModel> free_plate_format() {
  Table<PlateModel> table("plate",
                          "One plate of any orientation: plane, by its corners in order (brackets, "
                          "sloping plates), or ruled between two edges that run the same way (a "
                          "bilge between two arcs, a twisted plate). It is joined to what it "
                          "meets, crosses or ends on in the middle planes.");
  table
      .optional("corners", &PlateModel::corners, located(list_of(position_format(), 3)),
                "of a plane polygon, in order around it")
      .optional("edges", &PlateModel::edges, located(list_of(edge_format(), 2, 2)),
                "two, each a list of points or {arc: [first, through, last]}")
      .required("thickness", &PlateModel::thickness, quantity(Dimension::length, Range::positive()),
                "of the plate, half on each side")
      .optional("material", &PlateModel::material, reference(),
                "one of the block's materials; may be left out if there is one only")
      .optional("stiffeners", &PlateModel::stiffeners,
                stiffeners_format({{"u", 0}, {"v", 1}}, "the plate's own frame"),
                "of a plane plate, in its own frame: its first corner is the origin, u runs along "
                "its first side, n is the normal about which the corners run anticlockwise, v = n "
                "x u")
      .rule([](const PlateModel& plate, Reading& reading, const Mark& mark) {
        if (plate.edges && plate.stiffeners)
          reading.error(mark, reading.owner() + " is ruled between edges, and has stiffeners",
                        {"stiffeners stand on plane plates, by their corners"});
        if (plate.corners && plate.edges)
          reading.error(mark, reading.owner() + " has corners and also edges",
                        {"give its corners, or the two edges between which it is ruled"});
      });
  return table.format();
}

/// Rectangles normal to an axis, or one plate of any orientation, told apart by their keys.
Format<PlateModel> plate_format() {
  return one_of_tables<PlateModel>(
      {rectangle_format(), free_plate_format()},
      [](const YAML::Node& node) { return node["corners"] || node["edges"] ? 1 : 0; });
}

Format<OpeningModel> opening_format() {
  Table<Written<OpeningModel>> table("opening",
                                     "A hole through the named plates: a rectangle, which may "
                                     "have rounded corners up to a slot or a circle, or a "
                                     "polygon. What crosses a rectangle stays; other shapes lie "
                                     "between what joins or divides their plates.");
  table.required("plate", &OpeningModel::plate, reference(), "the plates that it cuts")
      .optional("at", &OpeningModel::at, positions_format(),
                "positions of the plates that are cut; all of them if left out");
  extent_keys(table)
      .optional("corner_radius", &OpeningModel::corner_radius,
                located(quantity(Dimension::length, Range::positive())),
                "of the rectangle's corners; half of both sides makes a circle, half of the "
                "shorter one a slot")
      .optional("corners", &OpeningModel::corners, list_of(position_format(), 3),
                "of a polygon, in order, in place of the extents; all its sides can be seen from "
                "its centre")
      .optional("centres", &OpeningModel::centres, list_of(position_format(), 1, 2),
                "in a plate by its corners: one of a circle, two of a slot's ends")
      .optional("radius", &OpeningModel::radius,
                located(quantity(Dimension::length, Range::positive())), "about the centres");
  return taken(table);
}

Format<BarModel> bar_format() {
  Table<BarModel> table(
      "bar",
      "A strut, pillar, brace or edge flange: a beam along straight lines from point to point. It "
      "is joined to what it ends on, crosses or runs along in the middle planes. Where it runs "
      "along a plate and stands towards its normal, it stands on the plate's face. Elsewhere the "
      "foot of flat bars, bulb flats, angles and tees, and the middle of other profiles, is on the "
      "line.");
  table
      .required("points", &BarModel::points, located(list_of(position_format(), 2)),
                "two or more, in order")
      .required("section", &BarModel::section, profile_format(), "its profile")
      .optional("towards", &BarModel::towards, direction_format(),
                "direction in which the section stands; pipes and round bars need none")
      .optional("material", &BarModel::material, reference(),
                "one of the block's materials; may be left out if there is one only")
      .by_default("hinged", &BarModel::is_hinged, boolean(), "false",
                  "its two ends pass on forces and torsion, no bending")
      .rule([](const BarModel& bar, Reading& reading, const Mark& mark) {
        check_direction(bar.section.value, bar.towards, reading, mark);
      });
  return table.format();
}

Format<PadModel> axis_pad_format() {
  Table<Written<PadModel>> table("pad", "A region in which a plate is thicker, around a lug.");
  table.required("plate", &PadModel::plate, reference(), "the plate that it thickens")
      .required("normal", &Rectangle::normal, choice<std::size_t>(block_axes), "that of the plate")
      .required("at", &PadModel::at, quantity(Dimension::length),
                "position of the plate's mid-plane");
  extent_keys(table)
      .required("thickness", &PadModel::thickness, quantity(Dimension::length, Range::positive()),
                "in total, the plate included; as thick as it where a lug stands on plain plating")
      .optional("material", &PadModel::material, reference(), "that of the plate if left out")
      .rule([](const Written<PadModel>& pad, Reading& reading, const Mark& mark) {
        check_rectangle(pad, block_axes, reading, mark);
      });
  return taken(table);
}

Format<PadModel> free_pad_format() {
  Table<Written<PadModel>> table("pad",
                                 "A region in which a plate by its corners is thicker, in the "
                                 "plate's own frame.");
  table.required("plate", &PadModel::plate, reference(), "the plate that it thickens")
      .required("u", &Written<PadModel>::x, extent_format(), "lower and upper end")
      .required("v", &Written<PadModel>::y, extent_format(), "lower and upper end")
      .required("thickness", &PadModel::thickness, quantity(Dimension::length, Range::positive()),
                "in total, the plate included; as thick as it where a lug stands on plain plating")
      .optional("material", &PadModel::material, reference(), "that of the plate if left out");
  return converted<PadModel, PadModel>(taken(table), [](PadModel pad) {
    pad.is_in_plate_frame = true;
    pad.normal = 2;
    pad.at = 0;
    return pad;
  });
}

Format<PadModel> pad_format() {
  return one_of_tables<PadModel>(
      {axis_pad_format(), free_pad_format()},
      [](const YAML::Node& node) { return has_plate_axes(node) ? 1 : 0; });
}

}  // namespace

const LugModel* BlockModel::find_lug(const std::string& name) const {
  const auto found = std::find_if(lugs.begin(), lugs.end(),
                                  [&](const LugModel& lug) { return lug.name.value == name; });
  return found == lugs.end() ? nullptr : &*found;
}

const PlateModel* BlockModel::find_plate(const std::string& name) const {
  const auto found = std::find_if(plates.begin(), plates.end(), [&](const PlateModel& plate) {
    return plate.name.value == name;
  });
  return found == plates.end() ? nullptr : &*found;
}

std::optional<structure::PlaneFrame> BlockModel::find_frame(const PadModel& pad) const {
  constexpr std::size_t fewest = 3;
  const PlateModel* plate = find_plate(pad.plate.value);
  if (!plate || !plate->corners || plate->corners->value.size() < fewest) return std::nullopt;
  const structure::PlaneFrame frame = structure::frame_of_polygon(plate->corners->value);
  if (!frame.axes.allFinite()) return std::nullopt;
  return frame;
}

std::optional<structure::PlaneFrame> BlockModel::find_frame(const LugModel& lug) const {
  const PadModel* pad = find_by_name(pads, lug.pad.value);
  return pad ? find_frame(*pad) : std::nullopt;
}

const PadeyeDesign* BlockModel::find_padeye(const LugModel& lug) const {
  return lug.padeye ? find_by_name(padeyes, lug.padeye->value) : nullptr;
}

std::vector<std::string> BlockModel::lug_names() const {
  std::vector<std::string> names;
  for (const LugModel& lug : lugs) names.push_back(lug.name.value);
  return names;
}

Format<BlockModel> block_model_format() {
  Table<BlockFile> table("block",
                         "A stiffened block in its own frame: x along, y across, z up; of "
                         "flat plates, or the mesh of one from a file. Where the plates "
                         "weigh less than the stated mass, the rest is outfitting, spread "
                         "over them so that mass and centre of mass agree.");
  table
      .required("kind", &BlockModel::kind, choice<std::string>({{"block", "block"}}),
                "what this file describes")
      .optional("title", &BlockModel::title, text(), "for people")
      .optional("materials", &BlockModel::materials, named_tables(material_format()),
                "what plates are made of; a deck brings its own")
      .optional("mass", &BlockModel::mass, quantity(Dimension::mass, Range::positive()),
                "in the lift, outfitting included; that of the plates if left out")
      .optional("centre_of_mass", &BlockModel::centre_of_mass, position_format(),
                "in the lift, outfitting included; that of the plates if left out")
      .optional("plates", &BlockModel::plates, named_tables(plate_format()),
                "decks, shells, frames, girders, stiffeners")
      .optional("mesh", &BlockModel::mesh, mesh_model_format(),
                "in place of plates: a deck of Nastran or Abaqus, a mesh of Gmsh, CAD surfaces")
      .optional("bars", &BlockModel::bars, named_tables(bar_format()),
                "struts, pillars, braces, flanges of edges")
      .optional("openings", &BlockModel::openings, named_tables(opening_format()),
                "holes in plates")
      .optional("pads", &BlockModel::pads, named_tables(pad_format()),
                "thicker regions around lugs")
      .optional("lugs", &BlockModel::lugs, named_tables(lug_format()), "where ropes may pull")
      .optional("edges", &BlockModel::edges, named_tables(load_edge_format()),
                "that ropes may touch and bend round; a rope of the case names them by over")
      .optional("padeyes", &BlockModel::padeyes, named_tables(padeye_format()),
                "what lugs are made as; a lug names one of them")
      .optional("repeat", &BlockFile::repeats, list_of(repeat_format()),
                "parts of plates that come again at equal steps")
      .optional("mirror", &BlockFile::mirrors, list_of(mirror_format()),
                "parts of plates that come again on the other side of a plane")
      .optional("wind_areas", &BlockModel::wind_areas, list_of(wind_area_format()),
                "areas on which the wind acts")
      .place(&BlockModel::place)
      .rule([](const BlockFile& file, Reading& reading, const Mark& mark) {
        check_block(with_copies(file, &reading), reading, mark);
      });
  return converted<BlockFile, BlockModel>(
      table.format(), [](const BlockFile& file) { return with_copies(file, nullptr); });
}

}  // namespace blocklift::pipeline

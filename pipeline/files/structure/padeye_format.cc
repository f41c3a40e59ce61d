#include "pipeline/files/structure/padeye_format.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "pipeline/files/structure/block_model.h"

namespace blocklift::pipeline {

namespace {

/// Where a lug juts out from its pad.
struct Outwards {
  std::size_t axis = 0;
  double sign = 1;
  double base = 0;  ///< the pad's edge, m
  double end = 0;   ///< the lug's, m
};

std::vector<Outwards> find_outwards(const PadModel& pad, const LugModel& lug) {
  std::vector<Outwards> ways;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == lug.normal || !lug.extent[axis] || !pad.extent[axis]) continue;
    const auto& own = lug.extent[axis]->value;
    const auto& of_pad = pad.extent[axis]->value;
    if (own[1] > of_pad[1] + same_place) ways.push_back({axis, 1, of_pad[1], own[1]});
    if (own[0] < of_pad[0] - same_place) ways.push_back({axis, -1, of_pad[0], own[0]});
  }
  return ways;
}

Format<structure::PadeyeDoubler> doubler_format() {
  using structure::PadeyeDoubler;
  const auto length = quantity(Dimension::length, Range::positive());
  Table<PadeyeDoubler> table(
      "doubler",
      "A plate between the base of a padeye and the plating that it stands on, in the middle under "
      "the base. Hand formulae check its weld, its bending and the pressure of the base on it; the "
      "meshes of block and padeye leave it out.");
  table.required("length", &PadeyeDoubler::length, length, "along the base")
      .required("width", &PadeyeDoubler::width, length, "across it")
      .required("thickness", &PadeyeDoubler::thickness, length, "of the plate")
      .required("weld", &PadeyeDoubler::weld, length,
                "leg of the fillet that holds it to the plating, all around");
  return table.format();
}

/// Keys of a padeye wherever it is.
template <class T>
void add_padeye_keys(Table<T>& table) {
  const auto length = quantity(Dimension::length, Range::positive());
  const auto length_or_none = quantity(Dimension::length, Range::not_negative());
  table.required("radius", &PadeyeDesign::radius, length, "of the main plate about the hole")
      .required("thickness", &PadeyeDesign::thickness, length, "of the main plate")
      .required("hole", &PadeyeDesign::hole, length, "diameter of the hole")
      .required("pin", &PadeyeDesign::pin, length, "diameter of the shackle's pin")
      .by_default("cheek_radius", &PadeyeDesign::cheek_radius, length_or_none, "0 mm",
                  "of the cheek plates; none without them")
      .by_default("cheek_thickness", &PadeyeDesign::cheek_thickness, length_or_none, "0 mm",
                  "of each cheek plate; none without them")
      .by_default("cheek_weld", &PadeyeDesign::cheek_weld, length_or_none, "0 mm",
                  "leg of the fillet weld around each cheek plate")
      .by_default("base_weld", &PadeyeDesign::base_weld, length_or_none, "0 mm",
                  "leg of the fillet welds on both sides of the base; it is welded through if left "
                  "out")
      .optional("doubler", &PadeyeDesign::doubler, doubler_format(),
                "between the base and the plating; none if left out")
      .optional("jaw", &PadeyeDesign::jaw, length,
                "inside width of the shackle, which the plates must fill to 75 %; not checked if "
                "left out")
      .optional("tensile_strength", &PadeyeDesign::tensile_strength,
                quantity(Dimension::stress, Range::positive()),
                "of the plates; the formulae of ASME BTH-1 are left out without it")
      .by_default("design_factor", &PadeyeDesign::design_factor, number(Range::at_least(1)), "2",
                  "N_d of ASME BTH-1: 2 in design category A, 3 in B")
      .by_default("divisions", &PadeyeDesign::divisions, integer(Range::between(16, 256)), "32",
                  "finite elements around the hole")
      .rule([](const T& design, Reading& reading, const Mark& mark) {
        if (design.cheek_thickness > 0 && !(design.cheek_weld > 0))
          reading.error(mark, fmt::format("{} has cheek plates without a weld", reading.owner()),
                        {"give the leg of their fillet: cheek_weld: 20 mm"});
      });
}

}  // namespace

Format<PadeyeDesign> padeye_format() {
  Table<PadeyeDesign> table(
      "padeye",
      "A padeye that lugs are made as: a main plate with a hole, round about it, with straight "
      "edges down "
      "to the pad's edge, and a round cheek plate on each side or none. `assess` checks it by hand "
      "formulae "
      "at every instant and meshes it finely, driven by the block's displacement at its base.");
  add_padeye_keys(table);
  return table.format();
}

Format<PadeyePart> padeye_part_format() {
  const auto length = quantity(Dimension::length, Range::positive());
  Table<PadeyePart> table(
      "padeye",
      "A padeye by itself, meshed here with quadratic hexahedra. Its frame: the origin in the "
      "middle "
      "of the hole, x along the base, y away from it, z along the pin. Its groups: the solids "
      "\"main\" and \"cheeks\", the faces \"hole\" and \"base\". The hand formulae of the pin's "
      "force stand beside the finite elements' stress.");
  table.required("height", &PadeyePart::height, length, "of the hole's middle above the base")
      .required("base", &PadeyePart::base, array_of<double, 2>(length),
                "how far it runs to -x and to +x from below the hole")
      .by_default("side_load", &PadeyePart::side_load, number(Range::between(0, 1)), "0.05",
                  "least force along the pin in the hand formulae, as a share of the pin's force "
                  "(API RP 2A)");
  add_padeye_keys(table);
  table.rule([](const PadeyePart& padeye, Reading& reading, const Mark& mark) {
    if (reading.is_owner_unsound()) return;
    for (const std::string& fault : structure::padeye_faults(padeye.geometry()))
      reading.error(mark, fault);
    for (const std::string& fault : doubler_faults(padeye, padeye.base[0] + padeye.base[1]))
      reading.error(mark, fault);
  });
  return table.format();
}

std::vector<std::string> doubler_faults(const PadeyeDesign& design, double base) {
  std::vector<std::string> faults;
  if (!design.doubler) return faults;
  const auto short_of = [&](const char* what, double is, double due, const char* of) {
    if (is >= due - same_place) return;
    faults.push_back(fmt::format("its doubler is {:.6g} mm {}; {} asks for {:.6g} mm", 1000 * is,
                                 what, of, 1000 * due));
  };
  short_of("long", design.doubler->length, base + 2 * design.base_weld, "the base with its welds");
  short_of("wide", design.doubler->width, design.thickness + 2 * design.base_weld,
           "the main plate with its welds");
  return faults;
}

structure::PadeyeGeometry PadeyePart::geometry() const {
  return {radius, thickness, hole, pin, cheek_radius, cheek_thickness, height, base[0], base[1]};
}

namespace {

PlacedPadeye place_on_mesh(const PadeyeDesign& design, const LugModel& lug,
                           std::vector<std::string>& faults) {
  const PadeyeOnMesh& stand = *lug.on_mesh;
  PlacedPadeye placed;
  placed.p_BP = lug.pin.value;
  placed.R_BP.col(1) = stand.up;
  placed.R_BP.col(2) = (stand.axis - stand.axis.dot(stand.up) * stand.up).normalized();
  placed.R_BP.col(0) = placed.R_BP.col(1).cross(placed.R_BP.col(2));
  placed.geometry = {design.radius, design.thickness,    design.hole,
                     design.pin,    design.cheek_radius, design.cheek_thickness,
                     stand.height,  stand.base[0],       stand.base[1]};
  faults = structure::padeye_faults(placed.geometry);
  return placed;
}

}  // namespace

std::optional<PlacedPadeye> place_padeye(const PadeyeDesign& design, const BlockModel& block,
                                         const LugModel& lug, std::vector<std::string>& faults) {
  if (lug.on_mesh) return place_on_mesh(design, lug, faults);
  const PadModel* pad = find_by_name(block.pads, lug.pad.value);
  if (!pad || !lug.pin.value.allFinite()) return std::nullopt;  // complained about elsewhere
  const std::vector<Outwards> ways = find_outwards(*pad, lug);
  if (ways.size() != 1) {
    faults.push_back(ways.empty()
                         ? fmt::format("it lies within its pad {}, from which no edge of a padeye "
                                       "stands out",
                                       pad->name.value)
                         : fmt::format("it juts out of its pad {} on {} sides; a padeye stands on "
                                       "one edge",
                                       pad->name.value, ways.size()));
    return std::nullopt;
  }
  const Outwards& out = ways.front();
  const std::size_t side = 3 - out.axis - lug.normal;
  if (!lug.extent[side]) return std::nullopt;
  const auto axis_of = [](std::size_t axis) {
    return Vector3(Vector3::Unit(static_cast<Eigen::Index>(axis)));
  };
  const std::optional<structure::PlaneFrame> frame =
      lug.is_in_plate_frame ? block.find_frame(lug) : std::nullopt;
  if (lug.is_in_plate_frame && !frame) return std::nullopt;
  const Vector3& pin = frame ? lug.pin_in_plate : lug.pin.value;
  PlacedPadeye placed;
  placed.p_BP = lug.pin.value;
  placed.R_BP.col(1) = out.sign * axis_of(out.axis);
  placed.R_BP.col(2) = axis_of(lug.normal);
  placed.R_BP.col(0) = placed.R_BP.col(1).cross(placed.R_BP.col(2));
  const double pin_out = pin[out.axis];
  const double pin_side = pin[side];
  const auto& width = lug.extent[side]->value;
  const bool along_axis = placed.R_BP.col(0).dot(axis_of(side)) > 0;
  const double lower = pin_side - width[0], upper = width[1] - pin_side;
  placed.geometry = {design.radius,
                     design.thickness,
                     design.hole,
                     design.pin,
                     design.cheek_radius,
                     design.cheek_thickness,
                     out.sign * (pin_out - out.base),
                     along_axis ? lower : upper,
                     along_axis ? upper : lower};
  faults = structure::padeye_faults(placed.geometry);
  for (std::string& fault : doubler_faults(design, lower + upper))
    faults.push_back(std::move(fault));
  const double to_end = out.sign * (out.end - pin_out);
  if (design.radius > to_end + same_place)
    faults.push_back(
        fmt::format("the main plate, {:.6g} mm about the hole, reaches beyond the "
                    "lug, which ends {:.6g} mm from the pin",
                    1000 * design.radius, 1000 * to_end));
  if (design.thickness > lug.thickness + same_place)
    faults.push_back(
        fmt::format("the main plate is {:.6g} mm thick, the lug in the block {:.6g} "
                    "mm",
                    1000 * design.thickness, 1000 * lug.thickness));
  if (std::abs(pin[lug.normal] - lug.at) > same_place)
    faults.emplace_back("its pin lies beside the middle of its plate");
  if (frame) placed.R_BP = frame->axes * placed.R_BP;
  return placed;
}

}  // namespace blocklift::pipeline

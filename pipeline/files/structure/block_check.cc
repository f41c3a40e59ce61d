#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "pipeline/files/structure/block_model.h"

namespace blocklift::pipeline {
namespace {

const char* axis_name(std::size_t axis, bool is_in_plate_frame = false) {
  static constexpr std::array<const char*, 6> names = {"x", "y", "z", "u", "v", "n"};
  return names.at(axis + (is_in_plate_frame ? 3 : 0));
}

/// Complains about a name that is not in the list; passes over one that could not be read.
template <class T>
const T* look_up(const Located<std::string>& name, const std::vector<T>& items,
                 const std::string& user, const char* noun, Reading& reading) {
  if (name.value.empty()) return nullptr;
  const T* found = find_by_name(items, name.value);
  if (!found) {
    reading.error(
        name.mark,
        fmt::format("{} names {} \"{}\", which the block does not have", user, noun, name.value),
        {names_hint(fmt::format("its {}s are", noun), names_of(items), name.value)});
  }
  return found;
}

bool has_position(const PlateModel& plate, double at) {
  return std::any_of(plate.at.begin(), plate.at.end(),
                     [at](double position) { return std::abs(position - at) < same_place; });
}

std::string positions_text(const PlateModel& plate) {
  std::vector<std::string> positions;
  for (const double at : plate.at) positions.push_back(fmt::format("{:.6g} m", at));
  return list_of_names(positions);
}

// The largest floating structures are some 500 m long, the thickest steel plates 0.3 m thick: what
// is far beyond was written in another unit.
void doubt_units(const PlateModel& plate, Reading& reading) {
  constexpr double longest = 1000, thickest = 1;  // m
  for (const auto& extent : plate.extent) {
    if (!extent || !(extent->value[1] - extent->value[0] > longest)) continue;
    reading.error(extent->mark,
                  fmt::format("plate {} is {:.4g} m long: is its unit mistaken?", plate.name.value,
                              extent->value[1] - extent->value[0]),
                  {"plates are up to 1 km long; millimetres are written as 1200 mm"});
  }
  if (plate.thickness > thickest)
    reading.error(plate.name.mark,
                  fmt::format("plate {} is {:.4g} m thick: is its unit mistaken?", plate.name.value,
                              plate.thickness),
                  {"plates are up to 1 m thick; millimetres are written as 20 mm"});
}

void check_plate(const BlockModel& block, const PlateModel& plate, Reading& reading) {
  doubt_units(plate, reading);
  if (!plate.material.value.empty()) {
    look_up(plate.material, block.materials, "plate " + plate.name.value, "material", reading);
  } else if (block.materials.size() > 1) {
    reading.error(
        plate.name.mark,
        fmt::format("plate {} names no material, and the block has several", plate.name.value),
        {"its materials are " + list_of_names(names_of(block.materials))});
  }
  if (plate.stiffeners && !plate.stiffeners->material.value.empty())
    look_up(plate.stiffeners->material, block.materials,
            "a row of stiffeners on plate " + plate.name.value, "material", reading);
  if (plate.at.size() > 1) {
    std::vector<double> sorted = plate.at;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i] - sorted[i - 1] >= plate.thickness) continue;
      reading.error(plate.name.mark,
                    fmt::format("plate {} lies upon itself: positions {:.6g} m and {:.6g} m are "
                                "nearer than its thickness of {:.6g} m",
                                plate.name.value, sorted[i - 1], sorted[i], plate.thickness));
      break;
    }
  }
}

using Extents = std::array<std::optional<Located<std::array<double, 2>>>, 3>;

/// Do two rectangles with this normal share an area? One whose extent was not readable does not.
bool share_an_area(const Extents& first, const Extents& second, std::size_t normal) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == normal) continue;
    if (!first[axis] || !second[axis]) return false;
    const auto& a = first[axis]->value;
    const auto& b = second[axis]->value;
    if (std::min(a[1], b[1]) - std::max(a[0], b[0]) < same_place) return false;
  }
  return true;
}

/// Greatest distance of points from a polygon's plane, m.
double distance_from_plane(const std::vector<Vector3>& corners,
                           const std::vector<Vector3>& points) {
  const Vector3 normal = structure::normal_of_polygon(corners);
  double farthest = 0;
  for (const Vector3& point : points)
    farthest = std::max(farthest, std::abs(normal.dot(point - corners[0])));
  return farthest;
}

constexpr double in_plane = 1e-3;  // m
constexpr std::size_t fewest_corners = 3;

void check_corners(const PlateModel& plate, Reading& reading) {
  if (!plate.corners || plate.corners->value.size() < fewest_corners) return;
  const std::vector<Vector3>& corners = plate.corners->value;
  if (!structure::normal_of_polygon(corners).allFinite()) {
    reading.error(plate.corners->mark, "the corners of plate " + plate.name.value +
                                           " lie on one line, or their sides cross");
    return;
  }
  const double farthest = distance_from_plane(corners, corners);
  if (farthest > in_plane)
    reading.error(plate.corners->mark,
                  fmt::format("the corners of plate {} are not in one plane: one lies {:.3g} mm "
                              "off it",
                              plate.name.value, 1000 * farthest),
                  {"a twisted plate is given by two edges"});
}

/// A copy and what it was made of have the same name here.
template <class T>
const std::string& origin_of(const T& part) {
  return part.origin.empty() ? part.name.value : part.origin;
}

/// Two plates in one place would be one plate of unknown thickness: the mesh has room for one.
/// Copies of two plates are complained about once.
void check_overlaps(const BlockModel& block, Reading& reading) {
  std::set<std::pair<std::string, std::string>> named;
  for (std::size_t j = 1; j < block.plates.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const PlateModel& earlier = block.plates[i];
      const PlateModel& later = block.plates[j];
      if (earlier.normal != later.normal ||
          !share_an_area(earlier.extent, later.extent, later.normal))
        continue;
      const auto shared = std::find_if(later.at.begin(), later.at.end(),
                                       [&](double at) { return has_position(earlier, at); });
      if (shared == later.at.end() || !named.insert({origin_of(earlier), origin_of(later)}).second)
        continue;
      reading.error(later.name.mark,
                    fmt::format("plate {} lies upon plate {} at {} = {:.6g} m", later.name.value,
                                earlier.name.value, axis_name(later.normal), *shared),
                    {"where a plate is thicker, divide it, or use a pad"});
    }
  }
}

/// Checks parts one by one. A copy of one that has faults has the same: it is passed over.
template <class T, class Check>
void check_each(const std::vector<T>& parts, Reading& reading, const Check& check) {
  std::set<std::string> faulty;
  for (const T& part : parts) {
    if (faulty.count(origin_of(part)) != 0) continue;
    const std::size_t errors = reading.diagnostics().error_count();
    check(part);
    if (reading.diagnostics().error_count() > errors) faulty.insert(origin_of(part));
  }
}

void check_opening_spares_pads(const BlockModel& block, const OpeningModel& opening,
                               const PlateModel& plate, Reading& reading) {
  for (const PadModel& pad : block.pads) {
    const bool opened = opening.at.empty() ||
                        std::any_of(opening.at.begin(), opening.at.end(),
                                    [&](double at) { return std::abs(at - pad.at) < same_place; });
    if (pad.plate.value != plate.name.value || !opened ||
        !share_an_area(opening.extent, pad.extent, plate.normal))
      continue;
    reading.error(
        opening.name.mark,
        fmt::format("opening {} cuts pad {} in plate {} at {} = {:.6g} m", opening.name.value,
                    pad.name.value, plate.name.value, axis_name(plate.normal), pad.at));
  }
}

/// A rectangle with corners that fit into it, or a polygon in the plane of its plate.
void check_shape(const OpeningModel& opening, const PlateModel& plate, const std::string& user,
                 Reading& reading) {
  const auto& radius = opening.corner_radius;
  if (!opening.corners.empty()) {
    for (const auto& extent : opening.extent)
      if (extent)
        reading.error(extent->mark, user + " has corners and also an extent",
                      {"a polygon has corners alone"});
    if (radius) reading.error(radius->mark, user + " is a polygon, whose corners are not rounded");
    return;
  }
  if (!radius) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == plate.normal || !opening.extent[axis]) continue;
    const auto& [lower, upper] = opening.extent[axis]->value;
    if (radius->value <= (upper - lower) / 2 + same_place) continue;
    reading.error(radius->mark,
                  fmt::format("{} has a corner radius of {:.6g} m and is {:.6g} m wide along {}",
                              user, radius->value, upper - lower, axis_name(axis)),
                  {"half of the width is the most"});
  }
}

/// An opening in a plate of any orientation: a polygon, or a radius about one or two centres.
void check_free_opening(const OpeningModel& opening, const PlateModel& plate, Reading& reading) {
  const std::string user = "opening " + opening.name.value;
  if (!plate.corners) {
    reading.error(opening.name.mark,
                  user + " is in plate " + plate.name.value + ", which is ruled between edges",
                  {"openings are cut into plane plates"});
    return;
  }
  const bool has_extent = std::any_of(opening.extent.begin(), opening.extent.end(),
                                      [](const auto& extent) { return extent.has_value(); });
  const bool is_round = !opening.centres.empty() && opening.radius;
  if (has_extent || opening.corner_radius || !opening.at.empty() ||
      opening.corners.empty() != is_round || opening.centres.empty() != !opening.radius) {
    reading.error(opening.name.mark,
                  fmt::format("{} is in plate {}, which is given by its corners, and lacks a shape "
                              "of its own or has a rectangle's keys",
                              user, plate.name.value),
                  {"give its corners, or centres (one of a circle, two of a slot) and radius"});
    return;
  }
  if (plate.corners->value.size() < fewest_corners) return;
  for (const auto* points : {&opening.corners, &opening.centres})
    if (const double off = distance_from_plane(plate.corners->value, *points); off > in_plane)
      reading.error(opening.name.mark,
                    fmt::format("{} has a point {:.3g} mm off the plane of plate "
                                "{}",
                                user, 1000 * off, plate.name.value));
}

void check_opening(const BlockModel& block, const OpeningModel& opening, Reading& reading) {
  const std::string user = "opening " + opening.name.value;
  const PlateModel* plate = look_up(opening.plate, block.plates, user, "plate", reading);
  if (!plate) return;
  if (plate->is_free()) {
    check_free_opening(opening, *plate, reading);
    return;
  }
  if (!opening.centres.empty() || opening.radius)
    reading.error(opening.name.mark,
                  fmt::format("{} has centres or a radius, and plate {} is a rectangle", user,
                              plate->name.value),
                  {"give its extents and a corner_radius"});
  check_shape(opening, *plate, user, reading);
  for (std::size_t axis = 0; axis < 3 && opening.corners.empty(); ++axis) {
    if (axis != plate->normal && !opening.extent[axis]) {
      reading.error(
          opening.name.mark, fmt::format("{} lacks the key \"{}\"", user, axis_name(axis)),
          {fmt::format("plate {} is normal to {}", plate->name.value, axis_name(plate->normal))});
    }
  }
  for (const double at : opening.at) {
    if (plate->at.empty() || has_position(*plate, at)) continue;
    reading.error(opening.name.mark,
                  fmt::format("{} is at {:.6g} m, where plate {} does not stand", user, at,
                              plate->name.value),
                  {"its positions are " + positions_text(*plate)});
  }
  check_opening_spares_pads(block, opening, *plate, reading);
}

/// Does a plane polygon hold a point of its frame? One on a side it does.
bool holds(const std::vector<Vector3>& corners, const Vector3& point) {
  double turned = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3 a = corners[i] - point, b = corners[(i + 1) % corners.size()] - point;
    const double cross = a.x() * b.y() - a.y() * b.x(), dot = a.x() * b.x() + a.y() * b.y();
    const double length = (b - a).norm();
    if (std::abs(cross) <= same_place * length && dot <= same_place * length) return true;
    turned += std::atan2(cross, dot);
  }
  return std::abs(turned) > 1;
}

/// A pad in the frame of a plate by its corners lies on it.
void check_free_pad(const PadModel& pad, const PlateModel& plate, Reading& reading) {
  const std::string user = "pad " + pad.name.value;
  if (!plate.corners) {
    reading.error(pad.name.mark,
                  fmt::format("{} is on plate {}, which is {}", user, plate.name.value,
                              plate.is_free() ? "ruled between edges" : "normal to an axis"),
                  {plate.is_free() ? "pads and lugs stand on plane plates"
                                   : "give its normal, at, and extents along the block's axes"});
    return;
  }
  if (!pad.is_in_plate_frame) {
    reading.error(pad.name.mark,
                  fmt::format("{} is on plate {}, which is no rectangle normal to an axis", user,
                              plate.name.value),
                  {"give u and v in the plate's own frame: u runs along its first side"});
    return;
  }
  if (plate.corners->value.size() < fewest_corners || !pad.extent[0] || !pad.extent[1]) return;
  const structure::PlaneFrame frame = structure::frame_of_polygon(plate.corners->value);
  if (!frame.axes.allFinite()) return;
  std::vector<Vector3> corners;
  for (const Vector3& corner : plate.corners->value) corners.push_back(frame.coordinates(corner));
  for (const double u : pad.extent[0]->value)
    for (const double v : pad.extent[1]->value) {
      if (holds(corners, {u, v, 0})) continue;
      reading.error(pad.extent[0]->mark,
                    fmt::format("{} reaches to u = {:.6g} m, v = {:.6g} m, beyond its plate {}",
                                user, u, v, plate.name.value));
      return;
    }
}

void check_pad(const BlockModel& block, const PadModel& pad, Reading& reading) {
  const std::string user = "pad " + pad.name.value;
  if (!pad.material.value.empty()) {
    look_up(pad.material, block.materials, user, "material", reading);
  }
  const PlateModel* plate = look_up(pad.plate, block.plates, user, "plate", reading);
  if (!plate) return;
  // As thick as its plate it is a place for a lug that stands on plain plating.
  if (pad.thickness < plate->thickness - 1e-9) {
    reading.error(pad.name.mark,
                  fmt::format("{} is {:.6g} m thick, its plate {} already {:.6g} m", user,
                              pad.thickness, plate->name.value, plate->thickness),
                  {"a pad's thickness is the total, the plate included"});
  }
  if (pad.is_in_plate_frame || plate->is_free()) {
    check_free_pad(pad, *plate, reading);
    return;
  }
  if (pad.normal != plate->normal) {
    reading.error(pad.name.mark,
                  fmt::format("{} is normal to {}, but its plate {} to {}", user,
                              axis_name(pad.normal), plate->name.value, axis_name(plate->normal)));
    return;
  }
  if (!plate->at.empty() && !has_position(*plate, pad.at)) {
    reading.error(pad.name.mark,
                  fmt::format("{} is at {:.6g} m, where plate {} does not stand", user, pad.at,
                              plate->name.value),
                  {"its positions are " + positions_text(*plate)});
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == pad.normal || !pad.extent[axis] || !plate->extent[axis]) continue;
    const auto& inner = pad.extent[axis]->value;
    const auto& outer = plate->extent[axis]->value;
    if (inner[0] < outer[0] - same_place || inner[1] > outer[1] + same_place) {
      reading.error(pad.extent[axis]->mark,
                    fmt::format("{} reaches along {} from {:.6g} m to {:.6g} m, beyond its plate "
                                "{}, which ends at {:.6g} m and {:.6g} m",
                                user, axis_name(axis), inner[0], inner[1], plate->name.value,
                                outer[0], outer[1]));
    }
  }
}

void check_bar(const BlockModel& block, const BarModel& bar, Reading& reading) {
  constexpr double shortest = 0.01, longest = 1000;  // m
  const std::string user = "bar " + bar.name.value;
  if (!bar.material.value.empty())
    look_up(bar.material, block.materials, user, "material", reading);
  else if (block.materials.size() > 1)
    reading.error(bar.name.mark, user + " names no material, and the block has several",
                  {"its materials are " + list_of_names(names_of(block.materials))});
  if (find_by_name(block.plates, bar.name.value) || find_by_name(block.pads, bar.name.value) ||
      find_by_name(block.lugs, bar.name.value))
    reading.error(bar.name.mark, user + " has the name of another part of the block",
                  {"results are listed by names"});
  const std::vector<Vector3>& points = bar.points.value;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = (points[i + 1] - points[i]).norm();
    if (length < shortest)
      reading.error(bar.points.mark,
                    fmt::format("{} is {:.3g} mm long from its point {} to the "
                                "next",
                                user, 1000 * length, i + 1),
                    {fmt::format("{:g} mm is the least", 1000 * shortest)});
    if (length > longest)
      reading.error(bar.points.mark,
                    fmt::format("{} is {:.4g} m long: is its unit mistaken?", user, length));
    const Vector3 along = (points[i + 1] - points[i]) / length;
    if (length >= shortest && bar.towards && along.cross(*bar.towards).norm() < 1e-3)
      reading.error(bar.points.mark,
                    fmt::format("{} runs along the direction towards which it stands", user),
                    {"\"towards\" is a direction across it"});
  }
}

const char* frame_name(bool is_in_plate_frame) {
  return is_in_plate_frame ? "the frame of its plate" : "that of the block";
}

void check_lug(const BlockModel& block, const LugModel& lug, Reading& reading) {
  const std::string user = "lug " + lug.name.value;
  if (lug.is_place) {
    reading.error(lug.name.mark, user + " is a place on a mesh, and the block is one of plates",
                  {"give its pad, normal, at, thickness and pin"});
    return;
  }
  if (!lug.material.value.empty()) {
    look_up(lug.material, block.materials, user, "material", reading);
  }
  const PadModel* pad = look_up(lug.pad, block.pads, user, "pad", reading);
  if (pad && pad->is_in_plate_frame != lug.is_in_plate_frame) {
    reading.error(
        lug.name.mark,
        fmt::format("{} is given in {}, its pad {} in {}", user, frame_name(lug.is_in_plate_frame),
                    pad->name.value, frame_name(pad->is_in_plate_frame)),
        {"a lug on the pad of a plate by its corners has normal, at, extents and pin in "
         "u, v and n"});
    return;
  }
  const Vector3& pin = lug.is_in_plate_frame ? lug.pin_in_plate : lug.pin.value;
  if (!pin.allFinite()) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = pin[axis];
    std::array<double, 2> range = {lug.at - lug.thickness / 2, lug.at + lug.thickness / 2};
    if (axis != lug.normal) {
      if (!lug.extent[axis]) continue;
      range = lug.extent[axis]->value;
    }
    if (place < range[0] - same_place || place > range[1] + same_place) {
      reading.error(
          lug.pin.mark,
          fmt::format("the pin of {} is at {} = {:.6g} m, outside the lug plate, which "
                      "reaches from {:.6g} m to {:.6g} m",
                      user, axis_name(axis, lug.is_in_plate_frame), place, range[0], range[1]));
    }
  }
}

void check_padeye(const BlockModel& block, const LugModel& lug, Reading& reading) {
  const std::string user = "lug " + lug.name.value;
  if (lug.is_solid.value && !lug.padeye)
    reading.error(lug.is_solid.mark, user + " is to be a solid and names no padeye",
                  {"padeye: NAME, one of the block's padeyes, says how it is made"});
  if (!lug.padeye) return;
  const PadeyeDesign* design = look_up(*lug.padeye, block.padeyes, user, "padeye", reading);
  if (!design || !std::isfinite(design->radius + design->thickness + design->hole + design->pin))
    return;
  std::vector<std::string> faults;
  place_padeye(*design, block, lug, faults);
  for (const std::string& fault : faults)
    reading.error(lug.padeye->mark, fmt::format("{} cannot be made as padeye {}: {}", user,
                                                design->name.value, fault));
}

/// A mesh brings its plates and materials; what belongs to plates has no place beside it.
void check_mesh_block(const BlockModel& block, Reading& reading) {
  const std::string why = "the block is a mesh, whose deck has the plates as they are";
  const auto refuse = [&](const auto& items, const char* noun) {
    for (const auto& item : items)
      reading.error(item.name.mark, fmt::format("{} {}: {}", noun, item.name.value, why));
  };
  refuse(block.plates, "plate");
  refuse(block.bars, "bar");
  refuse(block.openings, "opening");
  refuse(block.pads, "pad");
  for (const LugModel& lug : block.lugs) {
    if (lug.is_place)
      check_padeye(block, lug, reading);
    else
      reading.error(lug.name.mark,
                    fmt::format("lug {} stands on a pad, and {}", lug.name.value, why),
                    {"give its pin, a node, or a set of the deck"});
  }
  if (!block.materials.empty() && block.mesh->thicknesses.empty() && block.mesh->groups.empty() &&
      !is_bare(*block.mesh))
    reading.error(
        block.materials.front().name.mark,
        fmt::format("material {} is given, and no group to have it",
                    block.materials.front().name.value),
        {"a deck has its own; groups without properties are given under mesh: groups: {bottom: 12 "
         "mm}"});
}

}  // namespace

void check_block(const BlockModel& block, Reading& reading, const Mark& mark) {
  if (block.mass.has_value() != block.centre_of_mass.has_value()) {
    reading.error(block.mass ? block.mass->mark : block.centre_of_mass->mark,
                  block.mass ? "the block has a mass but no centre_of_mass"
                             : "the block has a centre_of_mass but no mass",
                  {"give both, or neither: then they are those of the plates"});
  }
  if (block.mesh) {
    check_mesh_block(block, reading);
    return;
  }
  if (block.plates.empty())
    reading.error(mark, "the block has no plates", {"give plates, or a mesh"});
  if (block.materials.empty())
    reading.error(mark, reading.owner() + " lacks the key \"materials\"",
                  {"it is what plates are made of"});
  check_each(block.plates, reading, [&](const PlateModel& plate) {
    check_plate(block, plate, reading);
    check_corners(plate, reading);
  });
  check_overlaps(block, reading);
  check_each(block.bars, reading, [&](const BarModel& bar) { check_bar(block, bar, reading); });
  check_each(block.openings, reading,
             [&](const OpeningModel& opening) { check_opening(block, opening, reading); });
  check_each(block.pads, reading, [&](const PadModel& pad) { check_pad(block, pad, reading); });
  check_each(block.lugs, reading, [&](const LugModel& lug) {
    check_lug(block, lug, reading);
    check_padeye(block, lug, reading);
  });
}

}  // namespace blocklift::pipeline

#include "pipeline/files/structure/lug_format.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pipeline/files/structure/block_model.h"
#include "pipeline/files/structure/rectangle_keys.h"

namespace blocklift::pipeline {
namespace {

Format<PadeyeOnMesh> padeye_on_mesh_format() {
  const auto length = quantity(Dimension::length, Range::positive());
  Table<PadeyeOnMesh> table(
      "padeye on a mesh",
      "How a padeye stands on the plates of a mesh. It is checked by hand formulae and by a fine "
      "mesh of its own, which the block drives along the base; its steel is that of the plate "
      "there. Its base lies within a plate: on a deck, or along the edge of a plate that goes on "
      "below it.");
  table
      .required("design", &PadeyeOnMesh::design, reference(),
                "one of the block's padeyes: what the lug is made as")
      .required("axis", &PadeyeOnMesh::axis, direction_format(), "direction of the pin")
      .required("up", &PadeyeOnMesh::up, direction_format(), "from the base to the pin, across it")
      .required("height", &PadeyeOnMesh::height, length, "of the pin's centre above the base")
      .required("base", &PadeyeOnMesh::base, array_of<double, 2>(length),
                "how far it runs from below the pin, against the direction up x axis and along it")
      .rule([](const PadeyeOnMesh& padeye, Reading& reading, const Mark& mark) {
        const double cosine = std::abs(padeye.axis.dot(padeye.up));
        if (cosine > 1e-3)
          reading.error(mark,
                        fmt::format("the pin's axis stands at {:.4g} degrees on the padeye's "
                                    "upward direction",
                                    std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi),
                        {"give axis and up at a right angle"});
      });
  return table.format();
}

Format<Located<bool>> shells_or_solid() {
  return located(choice<bool>({{"shells", false}, {"solid", true}}));
}

/// A solid padeye has a place of its own, and what lies below its base carries it.
void check_solid_place(const LugModel& lug, Reading& reading) {
  if (!lug.is_solid.value) return;
  const std::string user = reading.owner() + ", a solid,";
  const std::vector<std::string> allowed{
      "a solid padeye has a pin and a padeye; the plates below its base carry it"};
  if (lug.pin.mark.line <= 0) reading.error(lug.is_solid.mark, user + " has no pin", allowed);
  if (lug.node) reading.error(lug.node->mark, user + " names a node", allowed);
  if (lug.set) reading.error(lug.set->mark, user + " names a set", allowed);
  if (lug.radius) reading.error(lug.is_solid.mark, user + " has a radius", allowed);
}

/// A lug on a mesh.
Format<LugModel> place_format() {
  Table<LugModel> table(
      "lug",
      "On a mesh a lug is a place, by its pin, a node or a set, and what is there "
      "carries it: the plates of the set, those with a corner within the radius "
      "of the pin, or those that meet in the node nearest to it; the nodes of a "
      "set without plates; a node where no plates meet.");
  table
      .optional("pin", &LugModel::pin, position_format(),
                "centre of the pin; left out: the node, or the middle of the set's nodes")
      .optional("node", &LugModel::node, integer(Range::positive()),
                "number of the node that it stands at")
      .optional("set", &LugModel::set, text(),
                "a set, or group of a property, whose plates, bars or nodes carry it")
      .optional("radius", &LugModel::radius, quantity(Dimension::length, Range::positive()),
                "of the sphere about the pin in which plates carry it")
      .optional("padeye", &LugModel::on_mesh, padeye_on_mesh_format(),
                "how it stands as one of the block's padeyes; without, what carries it is checked "
                "alone")
      .by_default("as", &LugModel::is_solid, shells_or_solid(), "shells",
                  "what the model has of it: nothing but the mesh as it is, or its padeye as a "
                  "solid that stands on the plates below its base")
      .rule([](const LugModel& lug, Reading& reading, const Mark& mark) {
        check_solid_place(lug, reading);
        const bool has_place = lug.node || lug.set || lug.pin.mark.line > 0;
        if (!has_place)
          reading.error(
              mark, reading.owner() + " has no place",
              {"give its pin, a node or a set of the mesh; on plates its pad, normal, at, "
               "thickness and pin"});
        if (lug.set && (lug.node || lug.radius))
          reading.error(lug.set->mark, reading.owner() + " has a set and also a node or a radius",
                        {"the set alone says what carries it"});
      });
  return table.format();
}

/// Keys of a lug plate beside its extents.
Table<Written<LugModel>>& lug_keys(Table<Written<LugModel>>& table, const Axes& of_normal,
                                   const std::string& place_of_pin) {
  return table.required("pad", &LugModel::pad, reference(), "the pad that it is joined to")
      .required("normal", &Rectangle::normal, choice<std::size_t>(of_normal),
                "axis across the lug plate")
      .required("at", &LugModel::at, quantity(Dimension::length), "position of its mid-plane")
      .required("thickness", &LugModel::thickness, quantity(Dimension::length, Range::positive()),
                "of the lug plate")
      .required("pin", &LugModel::pin, position_format(), place_of_pin)
      .optional("material", &LugModel::material, reference(), "that of the pad if left out")
      .optional("padeye", &LugModel::padeye, reference(),
                "one of the block's padeyes: what the lug is made as, checked by hand formulae and "
                "by a fine mesh")
      .by_default("as", &LugModel::is_solid, shells_or_solid(), "shells",
                  "what the model has of it: its plate as shells, or its padeye as a solid that "
                  "stands on the pad's edge")
      .rule([of_normal](const Written<LugModel>& lug, Reading& reading, const Mark& mark) {
        check_rectangle(lug, of_normal, reading, mark);
      });
}

Format<LugModel> plate_lug_format() {
  Table<Written<LugModel>> table("lug",
                                 "A plate that stands on a pad. The rope pulls at the pin; "
                                 "its force is spread over the lug plate.");
  lug_keys(extent_keys(table), block_axes, "centre of the pin");
  return taken(table);
}

Format<LugModel> free_lug_format() {
  Table<Written<LugModel>> table("lug",
                                 "A plate that stands on the pad of a plate by its corners, in "
                                 "that plate's own frame u, v, n.");
  table.optional("u", &Written<LugModel>::x, extent_format(), extent_meaning)
      .optional("v", &Written<LugModel>::y, extent_format(), extent_meaning)
      .optional("n", &Written<LugModel>::z, extent_format(), extent_meaning);
  lug_keys(table, plate_axes, "centre of the pin, [u, v, n]");
  return converted<LugModel, LugModel>(taken(table), [](LugModel lug) {
    lug.is_in_plate_frame = true;
    lug.pin_in_plate = lug.pin.value;
    return lug;
  });
}

}  // namespace

Format<LugModel> lug_format() {
  const auto is_place = [](const YAML::Node& node) {
    const auto has = [&](const char* key) { return static_cast<bool>(node[key]); };
    return has("node") || has("set") || has("radius") ||
           (has("pin") && !has("pad") && !has("normal") && !has("at"));
  };
  const auto place = converted<LugModel, LugModel>(place_format(), [](LugModel lug) {
    lug.is_place = true;
    if (lug.on_mesh) lug.padeye = lug.on_mesh->design;
    return lug;
  });
  return one_of_tables<LugModel>({plate_lug_format(), free_lug_format(), place},
                                 [is_place](const YAML::Node& node) {
                                   return is_place(node) ? 2 : has_plate_axes(node) ? 1 : 0;
                                 });
}

}  // namespace blocklift::pipeline

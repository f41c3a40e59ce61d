#include "pipeline/report/block_surface.h"

#include <nlohmann/json.hpp>

#include "pipeline/report/packed_array.h"

namespace blocklift::pipeline {
namespace {

using layout::join;
using json = nlohmann::ordered_json;

}  // namespace

std::optional<BlockSurface> read_block_surface(const ResultsReader& results) {
  if (!results.has(layout::surface_points)) return std::nullopt;
  BlockSurface surface;
  surface.points = results.read(layout::surface_points).values;
  surface.quads = results.read_indices(layout::surface_quads).values;
  for (const std::int32_t corner : surface.quads)
    if (corner < 0 || static_cast<std::size_t>(corner) >= surface.point_count())
      throw ResultsError("a quadrangle of the surface names point " + std::to_string(corner) +
                         " of " + std::to_string(surface.point_count()));
  if (results.has(layout::surface_quad_group) && results.has(layout::surface_group_names)) {
    surface.quad_groups = results.read_indices(layout::surface_quad_group).values;
    surface.groups = results.read_texts(layout::surface_group_names);
    if (surface.quad_groups.size() != surface.quad_count())
      throw ResultsError("the surface has " + std::to_string(surface.quad_count()) +
                         " quadrangles, and groups of " +
                         std::to_string(surface.quad_groups.size()));
  }
  return surface;
}

std::optional<BlockField> read_surface_field(const ResultsReader& results, std::string_view way,
                                             std::string_view state, std::size_t point_count) {
  const std::string group = join(layout::structure_group, way, state);
  if (!results.has(join(group, "von_mises"))) return std::nullopt;
  BlockField field;
  field.von_mises = results.read(join(group, "von_mises")).values;
  field.displacement = results.read(join(group, "displacement")).values;
  if (field.von_mises.size() != point_count || field.displacement.size() != 3 * point_count)
    throw ResultsError("\"" + group + "\" does not fit the " + std::to_string(point_count) +
                       " points of the surface");
  for (const char* place : {"peak_stress_point", "checked_stress_point", "max_displacement_point"})
    if (results.has(join(group, place)))
      field.places.emplace_back(place, results.read(join(group, place)).values);
  if (results.has_attribute(group, "rope")) field.rope = results.read_text_attribute(group, "rope");
  if (results.has_attribute(group, "time"))
    field.time = results.read_number_attribute(group, "time");
  return field;
}

json surface_shape_json(const BlockSurface& surface) {
  json shape{{"points", packed_floats(surface.points)}, {"quads", packed_indices(surface.quads)}};
  if (!surface.quad_groups.empty()) {
    shape["quad_group"] = packed_short_indices(surface.quad_groups);
    shape["groups"] = surface.groups;
  }
  return shape;
}

json surface_field_json(const BlockField& field) {
  json entry{{"von_mises", packed_magnitudes(field.von_mises)},
             {"displacement", packed_signed(field.displacement)}};
  for (const auto& [name, place] : field.places) entry[name] = place;
  if (!field.rope.empty()) entry["rope"] = field.rope;
  if (field.time) entry["time"] = *field.time;
  return entry;
}

// Points 12 bytes, quadrangles 16 and 2, a field 8 a point.
std::size_t bytes_of_shape(const BlockSurface& surface) {
  return (12 * surface.point_count() + 18 * surface.quad_count()) * 4 / 3;
}

std::size_t bytes_of_field(std::size_t point_count) { return 8 * point_count * 4 / 3; }

}  // namespace blocklift::pipeline

#include "pipeline/build/describe_block.h"

namespace blocklift::pipeline {
namespace {

using Extents = std::array<std::optional<Located<std::array<double, 2>>>, 3>;

/// Extents that the file leaves out (along the normal) stay zero; nobody reads them.
std::array<structure::Interval, 3> intervals_of(const Extents& extents) {
  std::array<structure::Interval, 3> intervals;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!extents[axis]) continue;
    intervals[axis] = {extents[axis]->value[0], extents[axis]->value[1]};
  }
  return intervals;
}

structure::Axis axis_of(std::size_t axis) { return static_cast<structure::Axis>(axis); }

structure::FreePlate describe_free_plate(const PlateModel& plate, const std::string& material) {
  structure::FreePlate described;
  described.name = plate.name.value;
  described.thickness = plate.thickness;
  described.material = material;
  if (plate.corners) {
    described.corners = plate.corners->value;
    return described;
  }
  for (std::size_t i = 0; i < described.edges.size(); ++i) {
    const EdgeModel& edge = plate.edges->value[i];
    described.edges[i] = {edge.points, edge.is_arc};
  }
  return described;
}

structure::Stiffeners describe_stiffeners(const PlateModel& plate) {
  const StiffenersModel& row = *plate.stiffeners;
  structure::Stiffeners stiffeners;
  stiffeners.name = "stiffeners of " + plate.name.value;
  stiffeners.plate = plate.name.value;
  stiffeners.along = axis_of(row.along);
  stiffeners.spacing = row.spacing;
  stiffeners.first = row.first;
  stiffeners.side = row.side;
  stiffeners.section = row.profile->section;
  const Eigen::Vector2d foot(structure::foot_of(*row.profile), 0);
  stiffeners.centroid = row.profile->centroid - foot;
  stiffeners.material = row.material.value;
  stiffeners.tripping_brackets = row.tripping_brackets.value_or(0);
  if (row.are_plates) stiffeners.plates = row.profile->plates;
  return stiffeners;
}

}  // namespace

structure::BlockDescription describe_block(const BlockModel& model, const std::string& name,
                                           double largest_element) {
  structure::BlockDescription block;
  block.name = name;
  block.largest_element = largest_element;
  if (model.mass) block.total_mass = model.mass->value;
  if (model.centre_of_mass) block.centre_of_mass_B = model.centre_of_mass->value;
  for (const MaterialModel& material : model.materials) {
    block.materials.push_back({material.name.value, material.youngs_modulus, material.poisson_ratio,
                               material.density, material.yield_stress});
  }
  for (const PlateModel& plate : model.plates) {
    const std::string& material =
        plate.material.value.empty() ? model.materials.front().name.value : plate.material.value;
    if (plate.is_free()) {
      block.free_plates.push_back(describe_free_plate(plate, material));
      if (plate.stiffeners && plate.stiffeners->profile)
        block.free_stiffeners.push_back(describe_stiffeners(plate));
      continue;
    }
    block.plates.push_back({plate.name.value, axis_of(plate.normal), plate.at,
                            intervals_of(plate.extent), plate.thickness, material});
    if (plate.stiffeners && plate.stiffeners->profile)
      block.stiffeners.push_back(describe_stiffeners(plate));
  }
  for (const BarModel& bar : model.bars)
    block.bars.push_back(
        {bar.name.value, bar.points.value, bar.section.value.value(), bar.towards,
         bar.material.value.empty() ? model.materials.front().name.value : bar.material.value,
         bar.is_hinged});
  for (const OpeningModel& opening : model.openings) {
    if (const PlateModel* plate = model.find_plate(opening.plate.value);
        plate && plate->is_free()) {
      block.free_openings.push_back({opening.name.value, opening.plate.value, opening.corners,
                                     opening.centres, opening.radius ? opening.radius->value : 0});
      continue;
    }
    block.openings.push_back(
        {opening.name.value, opening.plate.value, opening.at, intervals_of(opening.extent),
         opening.corner_radius ? opening.corner_radius->value : 0, opening.corners});
  }
  for (const PadModel& pad : model.pads) {
    if (pad.is_in_plate_frame) {
      const auto extent = intervals_of(pad.extent);
      block.free_pads.push_back({pad.name.value,
                                 pad.plate.value,
                                 {extent[0], extent[1]},
                                 pad.thickness,
                                 pad.material.value});
      continue;
    }
    block.pads.push_back({pad.name.value, pad.plate.value, axis_of(pad.normal), pad.at,
                          intervals_of(pad.extent), pad.thickness, pad.material.value});
  }
  for (const LugModel& lug : model.lugs) {
    if (lug.is_in_plate_frame) {
      block.free_lugs.push_back({lug.name.value, lug.pad.value, axis_of(lug.normal), lug.at,
                                 intervals_of(lug.extent), lug.thickness, lug.material.value,
                                 lug.pin.value});
      continue;
    }
    block.lugs.push_back({lug.name.value, lug.pad.value, axis_of(lug.normal), lug.at,
                          intervals_of(lug.extent), lug.thickness, lug.material.value,
                          lug.pin.value});
  }
  return block;
}

}  // namespace blocklift::pipeline

#include "pipeline/lift/block_preparation.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/build/build_lift.h"
#include "pipeline/build/describe_block.h"
#include "pipeline/files/structure/deck_supports.h"
#include "structure/error.h"
#include "structure/mesh/padeye/padeye_in_block.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/mesh/shell_shape.h"
#include "structure/practice/hot_spot.h"
#include "structure/response/line_loads.h"
#include "structure/response/loose_block.h"
#include "structure/stress/block_field.h"

namespace blocklift::pipeline {

namespace {

/// Complains about weld toes that are read where the block has no material.
bool check_hot_spots(const StructureSettings& settings, const structure::Space& space,
                     Diagnostics& diagnostics) {
  const structure::SteelFinder finder(space);
  bool inside = true;
  for (const given::HotSpot& asked : settings.hot_spots) {
    const structure::HotSpot spot{asked.toe, asked.direction, asked.thickness};
    for (const Vector3& place : spot.places()) {
      if (finder.find(place).cell >= 0) continue;
      inside = false;
      diagnostics.error(asked.name.mark,
                        fmt::format("hot spot {} is read at ({:.6g}, {:.6g}, {:.6g}) m, where the "
                                    "block has no material",
                                    asked.name.value, place.x(), place.y(), place.z()),
                        {"the toe lies on a plate's surface and the direction along it"});
      break;
    }
  }
  return inside;
}

/// Complains about edges that no plate is near to.
bool check_edges(const BlockModel& block, const structure::Space& space, Diagnostics& diagnostics) {
  if (block.edges.empty()) return true;
  const structure::LineLoads lines(space);
  constexpr double farthest = structure::LineLoads::farthest_plate;
  bool beside_plates = true;
  for (const LoadEdge& edge : block.edges)
    for (const double share : {0.0, 0.5, 1.0}) {
      const Vector3 place = edge.from + share * (edge.to - edge.from) + edge.radius * edge.outside;
      if (lines.find_distance(place, farthest)) continue;
      beside_plates = false;
      diagnostics.error(
          edge.name.mark,
          fmt::format("edge {} runs at ({:.4g}, {:.4g}, {:.4g}) m, and no plate of the "
                      "block is within {:g} m",
                      edge.name.value, place.x(), place.y(), place.z(), farthest),
          {"plates near an edge bear what ropes do at it"});
      break;
    }
  return beside_plates;
}

/// Puts padeyes of solids where lugs ask for them; complains about those that have no room.
bool stand_padeyes(const BlockModel& block, structure::Mesh& mesh, Diagnostics& diagnostics) {
  bool all_stand = true;
  for (const LugModel& lug : block.lugs) {
    if (!lug.is_solid.value) continue;
    std::vector<std::string> faults;  // none: looked for when the file was read
    const PlacedPadeye placed = *place_padeye(*block.find_padeye(lug), block, lug, faults);
    try {
      structure::stand_padeye(mesh, {lug.name.value, placed.geometry, placed.R_BP, placed.p_BP});
    } catch (const structure::ModelError& error) {
      all_stand = false;
      diagnostics.error(lug.is_solid.mark, error.what(),
                        {block.mesh ? "a solid padeye stands on plates all along its base, where "
                                      "the mesh has none beside it; as: shells takes the mesh as "
                                      "it is"
                                    : "a solid padeye stands on the free edge of a plate, or of a "
                                      "plate that others cross there, by its base alone; as: "
                                      "shells takes any lug"});
    }
  }
  return all_stand;
}

std::unique_ptr<structure::ElasticModel> make_model(const BlockModel& block,
                                                    const std::string& name,
                                                    const StructureSettings& settings,
                                                    Diagnostics& diagnostics) {
  try {
    const auto stated = [](const auto& located) {
      return located ? std::optional(located->value) : std::nullopt;
    };
    const structure::Resolution resolution = [&]() -> structure::Resolution {
      if (!block.mesh) return {settings.element_degree, {}};
      const double largest = settings.largest_element;
      return {settings.element_degree, [largest](const structure::Vector3&) { return largest; }};
    }();
    structure::Mesh mesh =
        block.mesh
            ? block.mesh->deck->mesh
            : structure::generate_shell_mesh(describe_block(block, name, settings.largest_element));
    if (!stand_padeyes(block, mesh, diagnostics)) return nullptr;
    auto model = std::make_unique<structure::ElasticModel>(
        std::move(mesh), resolution, stated(block.mass), stated(block.centre_of_mass));
    const bool mass_is_sound = check_stated_mass(block, model->mass_properties(), diagnostics);
    const bool edges_are_sound = check_edges(block, model->space(), diagnostics);
    const bool spots_are_sound = check_hot_spots(settings, model->space(), diagnostics);
    return mass_is_sound && edges_are_sound && spots_are_sound ? std::move(model) : nullptr;
  } catch (const structure::ModelError& error) {
    diagnostics.error(block.place, error.what());
    return nullptr;
  }
}

}  // namespace

bool check_element_degree(const BlockModel& block, const StructureSettings& settings,
                          Diagnostics& diagnostics) {
  if (settings.element_degree != 1 || !block.mesh) return true;
  const structure::Mesh& mesh = block.mesh->deck->mesh;
  const std::vector<int> off = structure::fastened_off_straight_shells(mesh);
  if (off.empty()) return true;
  diagnostics.error(
      block.mesh->file.mark,
      fmt::format(
          "the case asks for elements of degree 1 (structure: element_degree: 1), which are "
          "straight, "
          "and {} nodes to which something is fastened, {} the first, lie off them, in middles of "
          "curved edges: what is there would not turn with the elements as a rigid body",
          off.size(), mesh.vertex_labels[off.front()]),
      {"element_degree of 2, which the mesh itself has, to 4",
       "or a mesh of linear shells (CQUAD4, CTRIA3, S4, S3)"});
  return false;
}

bool check_stated_mass(const BlockModel& block, const structure::MassProperties& mass,
                       Diagnostics& diagnostics) {
  constexpr double overlap = 0.05;  // of the steel's mass
  if (!block.mass || mass.mass >= (1 - overlap) * mass.steel_mass) return true;
  const char* const steel = block.mesh ? "mesh" : "plates";
  diagnostics.error(
      block.mass->mark,
      fmt::format("the block's mass is stated as {:.4g} t, and its {} alone weigh{} {:.4g} t",
                  mass.mass / 1e3, steel, block.mesh ? "s" : "", mass.steel_mass / 1e3),
      {fmt::format("give the mass in the lift, outfitting included; or mend thicknesses, openings "
                   "and densities of the {0}; or leave mass and centre_of_mass out: then they are "
                   "those of the {0}",
                   steel)});
  return false;
}

std::unique_ptr<structure::ElasticModel> make_block_model(const BlockModel& block,
                                                          const std::string& name,
                                                          const StructureSettings& settings,
                                                          Diagnostics& diagnostics) {
  if (!check_element_degree(block, settings, diagnostics)) return nullptr;
  return make_model(block, name, settings, diagnostics);
}

std::unique_ptr<structure::UnitResponses> make_unit_responses(const structure::ElasticModel& model,
                                                              const BlockModel& block) {
  try {
    return std::make_unique<structure::UnitResponses>(model);
  } catch (const structure::LooseBlock& loose) {
    Diagnostics diagnostics;
    diagnostics.error(block.place, loose.what(),
                      block.mesh ? supports_of_mechanism(*block.mesh->deck, loose.motion)
                                 : std::vector<std::string>{});
    throw InputError(diagnostics);
  }
}

std::unique_ptr<structure::ElasticModel> check_block_model(const BlockModel& block,
                                                           const std::string& name,
                                                           Diagnostics& diagnostics) {
  constexpr int coarse_degree = 1;
  constexpr double coarse_element = 100;  // m: cuts where plates meet, and no others
  StructureSettings settings;
  settings.element_degree = coarse_degree;
  settings.largest_element = coarse_element;
  return make_model(block, name, settings, diagnostics);
}

}  // namespace blocklift::pipeline

// Solid elements and their property.

#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/files/nastran/model.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// A card of solids: its shape, and the middles of edges in the order of the card's grids behind
/// the corners, as nodes of topology_of(shape).
struct SolidCard {
  std::string_view name;
  SolidShape shape;
  std::vector<int> middles;
};

const std::array<SolidCard, 3>& solid_cards() {
  // Nastran counts the upright edges before the upper ones.
  static const std::array<SolidCard, 3> cards{
      {{"CTETRA", SolidShape::tetrahedron, {4, 5, 6, 7, 8, 9}},
       {"CPENTA", SolidShape::wedge, {6, 7, 8, 12, 13, 14, 9, 10, 11}},
       {"CHEXA", SolidShape::hexahedron, {8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}}}};
  return cards;
}

class Solids {
 public:
  explicit Solids(NastranModel& model) : model_(model) {}

  void read() {
    NastranModel::Handlers handlers;
    for (const SolidCard& known : solid_cards())
      handlers[std::string(known.name)] = [this, &known](const CardView& card) {
        add(card, known);
      };
    model_.for_each(handlers);
    // First those that tell their edges' middles, which others have in common with them.
    Mesh& mesh = model_.deck.mesh;
    SolidEdgeMiddles middles(mesh);
    for (const bool is_told : {true, false})
      for (std::size_t s = 0; s < mesh.solids.size(); ++s)
        if (tells_middles_[s] == is_told) complete_solid(mesh, mesh.solids[s], middles);
  }

 private:
  // CHEXA EID PID G1 ... G8 G9 ... G20
  void add(const CardView& card, const SolidCard& known) {
    const SolidTopology& topology = topology_of(known.shape);
    Solid solid;
    solid.shape = known.shape;
    solid.label = model_.new_element(card);
    solid.vertices.assign(at(topology.nodes()), -1);
    for (int i = 0; i < topology.corners; ++i) {
      solid.vertices[at(i)] = model_.vertex(card, at(2 + i), "corner");
      for (int j = 0; j < i; ++j)
        if (solid.vertices[at(j)] == solid.vertices[at(i)])
          throw CardError{
              fmt::format("element {} has grid {} twice: a solid whose corners fall "
                          "together is not known; give it as a CPENTA or CTETRA",
                          solid.label, card.text(at(2 + i)))};
    }
    bool tells_middles = false;
    for (std::size_t i = 0; i < known.middles.size(); ++i) {
      const std::size_t field = at(2 + topology.corners) + i;
      if (!card.has(field) || card.is(field, "0")) continue;
      solid.vertices[at(known.middles[i])] = model_.vertex(card, field, "middle of an edge");
      tells_middles = true;
    }
    const long property = card.label(1, "property");
    solid.material = material_of(property);
    solid.region = nastran_region(model_, property, solid.material);
    model_.solids.insert(solid.label);
    model_.deck.mesh.solids.push_back(std::move(solid));
    tells_middles_.push_back(tells_middles);
  }

  // PSOLID PID MID CORDM IN STRESS ISOP FCTN
  int material_of(long property) {
    if (const auto known = model_.solid_material_of.find(property);
        known != model_.solid_material_of.end())
      return known->second;
    const auto found = model_.properties.find(property);
    if (found == model_.properties.end())
      throw CardError{fmt::format("property {} does not exist", property)};
    const CardView& card = found->second;
    if (card.name() != "PSOLID")
      throw CardError{fmt::format("a solid has property {}, which is a {}", property, card.name())};
    if (card.is(6, "PFLUID")) throw CardError{fmt::format("property {} is of a fluid", property)};
    nastran_plate_material(model_, card.label(1, "material"));
    const int material = nastran_material_place(model_, card.label(1, "material"));
    model_.log.use(card.name());
    return model_.solid_material_of[property] = material;
  }

  NastranModel& model_;
  std::vector<bool> tells_middles_;
};

}  // namespace

void read_nastran_solids(NastranModel& model) { Solids(model).read(); }

}  // namespace blocklift::structure

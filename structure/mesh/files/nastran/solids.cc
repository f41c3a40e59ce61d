// Solid elements and their property.

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/files/deck/collapsed_solid.h"
#include "structure/mesh/files/deck/given_solids.h"
#include "structure/mesh/files/deck/plausibility.h"
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

const std::array<SolidCard, 4>& solid_cards() {
  // Nastran counts the upright edges before the upper ones.
  static const std::array<SolidCard, 4> cards{
      {{"CTETRA", SolidShape::tetrahedron, {4, 5, 6, 7, 8, 9}},
       {"CPENTA", SolidShape::wedge, {6, 7, 8, 12, 13, 14, 9, 10, 11}},
       {"CHEXA", SolidShape::hexahedron, {8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}},
       {"CPYRAM", SolidShape::pyramid, {5, 6, 7, 8, 9, 10, 11, 12}}}};
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
    complete_solids(model_.deck, given_, model_.log);
    if (directional_ > 0)
      model_.log.remark(first_directional_, remark_on_directional_solids(directional_));
  }

 private:
  // CHEXA EID PID G1 ... G8 G9 ... G20
  void add(const CardView& card, const SolidCard& known) {
    const SolidTopology& topology = topology_of(known.shape);
    Solid solid;
    solid.shape = known.shape;
    solid.label = model_.new_element(card);
    solid.vertices.assign(topology.nodes(), -1);
    for (int i = 0; i < topology.corners; ++i)
      solid.vertices[i] = model_.vertex(card, at(2 + i), "corner");
    bool tells_middles = false;
    for (std::size_t i = 0; i < known.middles.size(); ++i) {
      const std::size_t field = at(2 + topology.corners) + i;
      if (!card.has(field) || card.is(field, "0")) continue;
      solid.vertices[known.middles[i]] = model_.vertex(card, field, "middle of an edge");
      tells_middles = true;
    }
    if (has_repeated_corners(solid)) solid = collapsed(card, solid);
    const long property = card.label(1, "property");
    const SolidProperty& of = property_of(property);
    solid.material = of.material;
    if (of.elasticity) {
      if (directional_++ == 0) first_directional_ = card.line();
      solid.elasticity = elasticity_of(property, of, solid, topology_of(solid.shape).corners);
    }
    solid.region = nastran_region(model_, property, solid.material);
    model_.solids.insert(solid.label);
    model_.deck.mesh.solids.push_back(std::move(solid));
    given_.push_back({card.name(), card.line(), tells_middles});
  }

  Solid collapsed(const CardView& card, const Solid& solid) {
    const std::optional<Solid> left = without_repeated_corners(solid);
    if (!left) {
      std::size_t i = 1;
      while (std::find(solid.vertices.begin(), solid.vertices.begin() + static_cast<long>(i),
                       solid.vertices[i]) == solid.vertices.begin() + static_cast<long>(i))
        ++i;
      throw CardError{fmt::format(
          "element {} has grid {} twice, and what is left of it is no wedge, pyramid or "
          "tetrahedron",
          solid.label, card.text(2 + i))};
    }
    model_.log.remark(card.line(), card.name() +
                                       ": a solid with one grid at several corners is read as the "
                                       "wedge, pyramid or tetrahedron that is left of it");
    return *left;
  }

  /// Of a property the place of its material in the mesh, and where that depends on the direction
  /// its elasticity in the axes of a coordinate system.
  struct SolidProperty {
    int material = -1;
    std::optional<Elasticity> elasticity;
    ExpansionStrains expansion = ExpansionStrains::Zero();  ///< along the elasticity's axes
    long system = 0;
  };

  // PSOLID PID MID CORDM IN STRESS ISOP FCTN
  const SolidProperty& property_of(long property) {
    if (const auto known = properties_.find(property); known != properties_.end())
      return known->second;
    const auto found = model_.properties.find(property);
    if (found == model_.properties.end())
      throw CardError{fmt::format("property {} does not exist", property)};
    const CardView& card = found->second;
    if (card.name() != "PSOLID")
      throw CardError{fmt::format("a solid has property {}, which is a {}", property, card.name())};
    if (card.is(6, "PFLUID")) throw CardError{fmt::format("property {} is of a fluid", property)};
    const long number = card.label(1, "material");
    const NastranMaterial& material = nastran_material(model_, number);
    SolidProperty of;
    if (material.of_solids) {
      of.elasticity = material.of_solids;
      of.expansion = material.expansion;
      of.system = card.integer(2, "CORDM", 0);
      if (of.system < 0)
        throw CardError{fmt::format(
            "PSOLID {} has its material along the axes of each element (CORDM = {}), which are not "
            "known; name a coordinate system",
            property, of.system)};
      model_.systems.get(of.system);  // is it there?
      of.material = directional_place(number, material);
    } else {
      nastran_plate_material(model_, number);  // Poisson's ratio
      of.material = nastran_material_place(model_, number);
    }
    model_.log.use(card.name());
    model_.solid_properties.insert(property);
    return properties_[property] = of;
  }

  int directional_place(long number, const NastranMaterial& material) {
    std::vector<Material>& materials = model_.deck.mesh.materials;
    const auto [found, is_new] =
        directional_places_.try_emplace(number, static_cast<int>(materials.size()));
    if (is_new) {
      materials.push_back(material.isotropic);
      model_.deck.expansions.set(found->second, {0, material.reference, material.obstacle});
    }
    return found->second;
  }

  /// One for all solids of a property along straight axes; about a cylinder or sphere each solid
  /// has that of its centre.
  int elasticity_of(long property, const SolidProperty& of, const Solid& solid, int corners) {
    std::vector<Elasticity>& all = model_.deck.mesh.elasticities;
    const LocalSystem& system = model_.systems.get(of.system);
    const bool is_straight = system.kind == SystemKind::rectangular;
    if (const auto known = straight_.find(property); is_straight && known != straight_.end())
      return known->second;
    Vector3 centre = Vector3::Zero();
    for (int i = 0; i < corners; ++i)
      centre += model_.place(solid.vertices[i]) / (corners * model_.units.length);
    all.push_back(turned(*of.elasticity, system.axes_at(centre)));
    model_.deck.expansions.of_elasticities.push_back(turned(of.expansion, system.axes_at(centre)));
    const int place = static_cast<int>(all.size()) - 1;
    if (is_straight) straight_[property] = place;
    return place;
  }

  NastranModel& model_;
  std::vector<GivenSolid> given_;
  std::unordered_map<long, SolidProperty> properties_;
  std::unordered_map<long, int> directional_places_;  ///< by material
  std::unordered_map<long, int> straight_;            ///< elasticities by property
  int directional_ = 0;                               ///< solids
  SourceLine first_directional_;
};

}  // namespace

void read_nastran_solids(NastranModel& model) { Solids(model).read(); }

}  // namespace blocklift::structure

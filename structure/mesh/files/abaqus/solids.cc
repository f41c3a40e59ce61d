// Solids, their faces, and their materials that depend on the direction.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "structure/mesh/directional.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/abaqus/orientation.h"
#include "structure/mesh/files/deck/collapsed_solid.h"
#include "structure/mesh/files/deck/given_solids.h"
#include "structure/mesh/files/deck/plausibility.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

SolidShape shape_by_nodes(std::size_t count) {
  if (count == 4 || count == 10) return SolidShape::tetrahedron;
  if (count == 6 || count == 15) return SolidShape::wedge;
  return count == 5 ? SolidShape::pyramid : SolidShape::hexahedron;
}

/// Gives solids the elasticity of their material along the section's axes.
class SolidElasticity {
 public:
  SolidElasticity(AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& section)
      : model_(model),
        own_(model.materials.at(section.required("MATERIAL")).of_solids),
        expansion_(model.materials.at(section.required("MATERIAL")).expansion),
        axes_(scope, own_ ? section.value("ORIENTATION") : "") {}

  bool is_directional() const { return own_.has_value(); }

  /// Place in Mesh::elasticities; -1: none.
  int of(const Solid& solid) {
    if (!own_) return -1;
    std::vector<Elasticity>& all = model_.deck.mesh.elasticities;
    if (axes_.is_straight() && straight_ >= 0) return straight_;
    const int corners = topology_of(solid.shape).corners;
    Vector3 centre = Vector3::Zero();
    for (int i = 0; i < corners; ++i)
      centre += model_.place(solid.vertices[i]) / (corners * model_.units.length);
    all.push_back(turned(*own_, axes_.at(centre)));
    model_.deck.expansions.of_elasticities.push_back(turned(expansion_, axes_.at(centre)));
    return straight_ = static_cast<int>(all.size()) - 1;
  }

 private:
  AbaqusModel& model_;
  std::optional<Elasticity> own_;
  ExpansionStrains expansion_;
  AbaqusAxes axes_;
  int straight_ = -1;
};

}  // namespace

void add_abaqus_solids(AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& section,
                       const std::vector<int>& elements, int material, int region) {
  SolidElasticity elasticity(model, scope, section);
  for (const int e : elements) {
    AbaqusDeckElement& element = model.elements[e];
    if (element.solid >= 0)
      throw CardError{fmt::format("element {} has two sections", element.label)};
    Solid solid;
    solid.shape = shape_by_nodes(element.nodes.size());
    solid.vertices = element.nodes;
    if (has_repeated_corners(solid)) {
      const std::optional<Solid> left = without_repeated_corners(solid);
      if (!left)
        throw CardError{fmt::format(
            "element {} has one node twice, and what is left of it is no wedge, pyramid or "
            "tetrahedron",
            element.label)};
      model.log.remark(element.line,
                       "*ELEMENT: a solid with one node at several corners is read as the wedge, "
                       "pyramid or tetrahedron that is left of it");
      solid = *left;
    }
    solid.material = material;
    solid.region = region;
    solid.label = element.label;
    solid.elasticity = elasticity.of(solid);
    element.solid = static_cast<int>(model.deck.mesh.solids.size());
    model.deck.mesh.solids.push_back(std::move(solid));
  }
  if (elasticity.is_directional())
    model.log.remark(section.line, remark_on_directional_solids(static_cast<int>(elements.size())));
}

void complete_abaqus_solids(AbaqusModel& model) {
  const Mesh& mesh = model.deck.mesh;
  std::vector<GivenSolid> given(mesh.solids.size());
  for (const AbaqusDeckElement& element : model.elements) {
    if (element.solid < 0) continue;
    const Solid& solid = mesh.solids[element.solid];
    const int corners = topology_of(solid.shape).corners;
    given[element.solid] = {"*ELEMENT", element.line,
                            static_cast<int>(solid.vertices.size()) > corners};
  }
  complete_solids(model.deck, given, model.log);
}

std::vector<int> corners_of_face(const AbaqusDeckElement& solid, const std::string& face) {
  // They stand in the order in which Abaqus numbers them.
  const auto& own = topology_of(shape_by_nodes(solid.nodes.size())).faces;
  const auto number =
      face.size() == 2 && face[0] == 'S' ? static_cast<std::size_t>(face[1] - '1') : own.size();
  if (number >= own.size())
    throw CardError{fmt::format("face {} of element {} ({}) is not known; S1 to S{} are", face,
                                solid.label, solid.type, own.size())};
  std::vector<int> corners;
  for (const int i : own[number])
    if (std::find(corners.begin(), corners.end(), solid.nodes[i]) == corners.end())
      corners.push_back(solid.nodes[i]);
  if (corners.size() < 3)
    throw CardError{
        fmt::format("face {} of element {} is an edge or a point: its nodes fall "
                    "together",
                    face, solid.label)};
  return corners;
}

}  // namespace blocklift::structure

// Solids, their faces, and the axes of materials that depend on the direction.

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/deck/plausibility.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

SolidShape shape_by_nodes(std::size_t count) {
  if (count == 4 || count == 10) return SolidShape::tetrahedron;
  if (count == 6 || count == 15) return SolidShape::wedge;
  return count == 5 ? SolidShape::pyramid : SolidShape::hexahedron;
}

Vector3 vector_at(const Fields& fields, std::size_t first) {
  return {abaqus_real(fields, first, "coordinate"), abaqus_real(fields, first + 1, "coordinate"),
          abaqus_real(fields, first + 2, "coordinate")};
}

Eigen::Matrix3d axes_from(const Vector3& axis_1, const Vector3& axis_3, const std::string& name) {
  if (!(axis_1.norm() > 0 && axis_3.norm() > 1e-9))
    throw CardError{fmt::format("the points of orientation {} lie on a line", name)};
  Eigen::Matrix3d axes;
  axes.col(0) = axis_1.normalized();
  axes.col(2) = axis_3.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// Axes of a section's material.
class MaterialAxes {
 public:
  MaterialAxes(const AbaqusScope& scope, const std::string& name) : scope_(&scope), name_(name) {
    if (!name_.empty()) read(abaqus_orientation(scope, name_));
  }

  bool is_straight() const { return !is_cylindrical_; }

  /// Columns, at a place in the deck's units; the part's own where none are named.
  Eigen::Matrix3d at(const Vector3& place) const {
    if (!is_cylindrical_) return scope_->turn * straight_ * further_;
    const Vector3 in_part = scope_->turn.transpose() * (place - scope_->shift) - origin_;
    const Vector3 radius = in_part - in_part.dot(axis_) * axis_;
    const bool is_on_axis = radius.norm() < 1e-9 * (1 + in_part.norm());
    return scope_->turn * axes_from(is_on_axis ? axis_.unitOrthogonal() : radius, axis_, name_) *
           further_;
  }

 private:
  // *ORIENTATION, NAME = , SYSTEM = / a, b, c / axis of a further turn, its angle in degrees
  void read(const AbaqusBlock& block) {
    const std::string system = block.value("SYSTEM"), definition = block.value("DEFINITION");
    is_cylindrical_ = system == "CYLINDRICAL";
    if (!system.empty() && system != "RECTANGULAR" && !is_cylindrical_)
      throw CardError{
          fmt::format("SYSTEM = {} of orientation {} is not known; RECTANGULAR and "
                      "CYLINDRICAL are",
                      system, name_)};
    if (!definition.empty() && definition != "COORDINATES")
      throw CardError{fmt::format("DEFINITION = {} of orientation {} is not known; COORDINATES is",
                                  definition, name_)};
    if (block.data.empty())
      throw CardError{fmt::format("orientation {} has no line of data", name_)};
    const Fields fields = block.data[0].fields();
    const Vector3 a = vector_at(fields, 0), b = vector_at(fields, 3);
    if (is_cylindrical_) {
      if (!((b - a).norm() > 0))
        throw CardError{fmt::format("the points of orientation {} are one", name_)};
      origin_ = a;
      axis_ = (b - a).normalized();
    } else {
      const Vector3 c = fields.size() > 6 ? vector_at(fields, 6) : Vector3(Vector3::Zero());
      straight_ = axes_from(a - c, (a - c).cross(b - c), name_);
    }
    if (block.data.size() > 1) turn_further(block.data[1].fields());
  }

  void turn_further(const Fields& fields) {
    const double number = abaqus_real(fields, 0, "axis", 1.0);
    const double angle = abaqus_real(fields, 1, "angle", 0.0) * std::numbers::pi / 180;
    if (number != 1 && number != 2 && number != 3)
      throw CardError{
          fmt::format("orientation {} turns about axis {}; 1, 2 and 3 are", name_, fields[0])};
    further_ = Eigen::AngleAxisd(angle, Vector3::Unit(static_cast<Eigen::Index>(number) - 1))
                   .toRotationMatrix();
  }

  const AbaqusScope* scope_;
  std::string name_;
  bool is_cylindrical_ = false;
  Eigen::Matrix3d straight_ = Eigen::Matrix3d::Identity(), further_ = Eigen::Matrix3d::Identity();
  Vector3 origin_ = Vector3::Zero(), axis_ = Vector3::UnitZ();
};

/// Gives solids the elasticity of their material along the section's axes.
class SolidElasticity {
 public:
  SolidElasticity(AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& section)
      : model_(model),
        own_(model.materials.at(section.required("MATERIAL")).of_solids),
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
      centre += model_.place(solid.vertices[at(i)]) / (corners * model_.units.length);
    all.push_back(turned(*own_, axes_.at(centre)));
    return straight_ = static_cast<int>(all.size()) - 1;
  }

 private:
  AbaqusModel& model_;
  std::optional<Elasticity> own_;
  MaterialAxes axes_;
  int straight_ = -1;
};

}  // namespace

const AbaqusBlock& abaqus_orientation(const AbaqusScope& scope, const std::string& name) {
  for (const AbaqusBlock* block : scope.blocks)
    if (block->name == "ORIENTATION" && block->value("NAME") == name) return *block;
  throw CardError{fmt::format("orientation {} does not exist", name)};
}

void add_abaqus_solids(AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& section,
                       const std::vector<int>& elements, int material, int region) {
  SolidElasticity elasticity(model, scope, section);
  for (const int e : elements) {
    AbaqusDeckElement& element = model.elements[at(e)];
    if (element.solid >= 0)
      throw CardError{fmt::format("element {} has two sections", element.label)};
    Solid solid;
    solid.shape = shape_by_nodes(element.nodes.size());
    solid.vertices = element.nodes;
    const auto corners = solid.vertices.begin() + topology_of(solid.shape).corners;
    for (auto corner = solid.vertices.begin(); corner != corners; ++corner)
      if (std::find(corner + 1, corners, *corner) != corners)
        throw CardError{
            fmt::format("element {} has one node twice: a solid whose corners fall together is "
                        "not known; give it as a C3D6, C3D5 or C3D4",
                        element.label)};
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

// First those that tell their edges' middles, which others have in common with them.
void complete_abaqus_solids(AbaqusModel& model) {
  Mesh& mesh = model.deck.mesh;
  SolidEdgeMiddles middles(mesh);
  for (const bool is_told : {true, false})
    for (Solid& solid : mesh.solids) {
      const SolidTopology& topology = topology_of(solid.shape);
      const bool is_quadratic =
          static_cast<int>(solid.vertices.size()) > topology.corners && solid.vertices.back() >= 0;
      if (is_told == is_quadratic) complete_solid(mesh, solid, middles);
    }
}

std::vector<int> corners_of_face(const AbaqusDeckElement& solid, const std::string& face) {
  // The faces of C3D4, C3D6, C3D8 and C3D5 as Abaqus numbers them.
  static const std::array<std::vector<std::vector<std::size_t>>, 4> faces{
      {{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}},
       {{0, 1, 2}, {3, 5, 4}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
       {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}},
       {{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}}}};
  const auto& own = faces[static_cast<std::size_t>(shape_by_nodes(solid.nodes.size()))];
  const auto number =
      face.size() == 2 && face[0] == 'S' ? static_cast<std::size_t>(face[1] - '1') : own.size();
  if (number >= own.size())
    throw CardError{fmt::format("face {} of element {} ({}) is not known; S1 to S{} are", face,
                                solid.label, solid.type, own.size())};
  std::vector<int> corners;
  for (const std::size_t i : own[number]) corners.push_back(solid.nodes[i]);
  return corners;
}

}  // namespace blocklift::structure

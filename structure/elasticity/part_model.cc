#include "structure/elasticity/part_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/elasticity/bearing_load.h"
#include "structure/error.h"
#include "structure/formulation/solid.h"
#include "structure/index.h"
#include "structure/mesh/directional.h"

namespace blocklift::structure {

namespace {

const PartGroup& group_of(const PartMesh& mesh, const std::string& owner, const std::string& name) {
  const PartGroup* group = mesh.find_group(name);
  if (!group)
    throw ModelError(owner + " names group \"" + name + "\", which the mesh does not have");
  if (group->elements.empty())
    throw ModelError(owner + " names group \"" + name + "\", which holds no element");
  return *group;
}

// Weighted tangent vectors at a rule point give the measure: a face's normal, an edge's length.
struct Measure {
  double size = 0;
  Vector3 normal = Vector3::Zero();  ///< unit, of faces
};

Measure measure(const ElementKind& kind, const Eigen::Matrix3Xd& places, Eigen::Index q) {
  const Eigen::Matrix3d tangents = places * kind.gradients.middleRows<3>(3 * q).transpose();
  if (kind.dimension == 1) return {kind.weights[q] * tangents.col(0).norm(), Vector3::Zero()};
  const Vector3 across = tangents.col(0).cross(tangents.col(1));
  return {kind.weights[q] * across.norm(), across.normalized()};
}

// Centre of a solid behind each face that is asked for, by the face's corners.
class SolidsBehindFaces {
 public:
  explicit SolidsBehindFaces(const PartMesh& mesh) : mesh_(mesh) {
    for (const int element : mesh.solids)
      for (int i = 0; i < mesh.kind(element).corners; ++i)
        solids_of_node_[mesh.node(element, i)].push_back(element);
  }

  /// -1 if no solid has all corners of the face; -2 if two have (the face lies inside).
  int behind(int face) const {
    int found = -1;
    const auto solids = solids_of_node_.find(mesh_.node(face, 0));
    if (solids == solids_of_node_.end()) return -1;
    for (const int solid : solids->second) {
      if (!has_corners(solid, face)) continue;
      if (found >= 0) return -2;
      found = solid;
    }
    return found;
  }

 private:
  bool has_corners(int solid, int face) const {
    for (int i = 0; i < mesh_.kind(face).corners; ++i) {
      bool has = false;
      for (int j = 0; j < mesh_.kind(solid).corners && !has; ++j)
        has = mesh_.node(solid, j) == mesh_.node(face, i);
      if (!has) return false;
    }
    return true;
  }

  const PartMesh& mesh_;
  std::map<int, std::vector<int>> solids_of_node_;
};

void add_surface_load(const PartMesh& mesh, const SurfaceLoad& load, Eigen::VectorXd& forces) {
  const PartGroup& group = group_of(mesh, "load " + load.name, load.group);
  if (load.kind == SurfaceLoad::Kind::bearing) {
    add_bearing_load(mesh, load, group, forces);
    return;
  }
  const bool is_force = load.kind == SurfaceLoad::Kind::force;
  if (group.dimension == 3 || (!is_force && group.dimension != 2))
    throw ModelError(fmt::format("load {} is {}, but group \"{}\" holds {}", load.name,
                                 is_force ? "a force on faces, edges or points" : "on faces",
                                 load.group,
                                 group.dimension == 3   ? "solids"
                                 : group.dimension == 1 ? "edges"
                                                        : "points"));
  // Measure of the whole group first: a force is spread evenly.
  Eigen::VectorXd shape_integrals = Eigen::VectorXd::Zero(mesh.nodes.cols());
  const SolidsBehindFaces solids(mesh);
  for (const int element : group.elements) {
    const ElementKind& kind = mesh.kind(element);
    if (kind.dimension == 0) {
      shape_integrals[mesh.node(element, 0)] += 1;
      continue;
    }
    const Eigen::Matrix3Xd places = mesh.places(element);
    double outwards = 1;
    if (load.kind == SurfaceLoad::Kind::pressure) {
      const int solid = solids.behind(element);
      if (solid < 0)
        throw ModelError(
            fmt::format("load {}: {} of group \"{}\" {}, so that no side of it is "
                        "outside",
                        load.name, mesh.describe(element), load.group,
                        solid == -1 ? "is on no solid" : "lies between two solids"));
      const Vector3 away = mesh.centre(element) - mesh.centre(solid);
      outwards = measure(kind, places, 0).normal.dot(away) > 0 ? 1 : -1;
    }
    for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
      const Measure of = measure(kind, places, q);
      for (int i = 0; i < kind.nodes; ++i) {
        const double share = kind.values(q, i) * of.size;
        const int node = mesh.node(element, i);
        shape_integrals[node] += share;
        if (load.kind == SurfaceLoad::Kind::pressure)
          forces.segment<3>(3 * node) -= load.pressure * outwards * share * of.normal;
        if (load.kind == SurfaceLoad::Kind::traction)
          forces.segment<3>(3 * node) += share * load.vector;
      }
    }
  }
  if (!is_force) return;
  const double whole = shape_integrals.sum();
  for (Eigen::Index node = 0; node < shape_integrals.size(); ++node)
    forces.segment<3>(3 * node) += shape_integrals[node] / whole * load.vector;
}

double density_of(const PartModel& model, std::size_t solid) {
  return model.materials[model.material_of_solid[solid]].density;
}

void add_body_load(const PartModel& model, const BodyLoad& load, Eigen::VectorXd& forces) {
  const PartMesh& mesh = model.mesh;
  const Vector3& omega = load.angular_velocity;
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    const int element = mesh.solids[s];
    for (const SolidPoint& point : solid_points(mesh.kind(element), mesh.places(element))) {
      const Vector3 pull = load.gravity - omega.cross(omega.cross(point.place - load.point));
      const Vector3 force = density_of(model, s) * point.weight * pull;
      for (int i = 0; i < point.values.size(); ++i)
        forces.segment<3>(3 * mesh.node(element, i)) += point.values[i] * force;
    }
  }
}

}  // namespace

SolidSet solids_of(const PartModel& model) {
  const PartMesh& mesh = model.mesh;
  SolidSet solids;
  solids.nodes = mesh.nodes;
  for (const Material& material : model.materials)
    solids.laws.push_back(isotropic_elasticity(material));
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    const Element& element = mesh.elements[mesh.solids[s]];
    solids.add(mesh.kinds[element.kind], &mesh.element_nodes[at(element.first)],
               model.material_of_solid[s]);
  }
  return solids;
}

Eigen::MatrixXd part_element_stiffness(const PartModel& model, int solid) {
  const int element = model.mesh.solids[solid];
  return solid_stiffness(model.mesh.kind(element), model.mesh.places(element),
                         model.materials[model.material_of_solid[solid]]);
}

PartMass find_part_mass(const PartModel& model) {
  PartMass mass;
  for (std::size_t s = 0; s < model.mesh.solids.size(); ++s) {
    const int element = model.mesh.solids[s];
    for (const SolidPoint& point :
         solid_points(model.mesh.kind(element), model.mesh.places(element))) {
      mass.volume += point.weight;
      mass.mass += density_of(model, s) * point.weight;
      mass.centre += density_of(model, s) * point.weight * point.place;
    }
  }
  if (mass.mass > 0) mass.centre /= mass.mass;
  return mass;
}

Eigen::VectorXd part_load(const PartModel& model) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * model.mesh.nodes.cols());
  for (const SurfaceLoad& load : model.surface_loads) add_surface_load(model.mesh, load, forces);
  for (const BodyLoad& load : model.body_loads) add_body_load(model, load, forces);
  return forces;
}

std::vector<FixedUnknown> part_supports(const PartModel& model, std::vector<int>& support_of) {
  std::vector<FixedUnknown> fixed;
  std::map<int, std::size_t> place_of_unknown;
  support_of.clear();
  for (std::size_t s = 0; s < model.supports.size(); ++s) {
    const PartSupport& support = model.supports[s];
    const PartGroup& group = group_of(model.mesh, "support " + support.name, support.group);
    for (const int element : group.elements)
      for (int i = 0; i < model.mesh.kind(element).nodes; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          if (!support.fixed[axis]) continue;
          const int unknown = 3 * model.mesh.node(element, i) + axis;
          const auto [known, is_new] = place_of_unknown.try_emplace(unknown, fixed.size());
          if (is_new) {
            fixed.push_back({unknown, support.displacement[axis]});
            support_of.push_back(static_cast<int>(s));
          } else if (fixed[known->second].value != support.displacement[axis]) {
            throw ModelError(fmt::format(
                "supports {} and {} give the same nodes different displacements along {}",
                model.supports[support_of[known->second]].name, support.name, "xyz"[axis]));
          }
        }
  }
  return fixed;
}

std::vector<FixedUnknown> with_idle_nodes(const PartModel& model, std::vector<FixedUnknown> fixed) {
  std::vector<char> held(at(static_cast<int>(3 * model.mesh.nodes.cols())), 0);
  for (const FixedUnknown& unknown : fixed) held[unknown.unknown] = 1;
  const std::vector<int> body = connected_bodies(model.mesh);
  for (std::size_t node = 0; node < body.size(); ++node)
    for (int a = 0; a < 3; ++a) {
      const int unknown = 3 * static_cast<int>(node) + a;
      if (body[node] < 0 && !held[unknown]) fixed.push_back({unknown, 0});
    }
  return fixed;
}

}  // namespace blocklift::structure

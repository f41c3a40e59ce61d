#include "structure/formulation/solid_set.h"

#include <Eigen/Dense>

#include "structure/mesh/directional.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

Eigen::Matrix3Xd SolidSet::places(int solid) const {
  Eigen::Matrix3Xd result(3, kind(solid).nodes);
  for (int i = 0; i < result.cols(); ++i) result.col(i) = nodes.col(node(solid, i));
  return result;
}

void SolidSet::add(const ElementKind& kind, const int* nodes_of_solid, int law_of_solid) {
  kinds.push_back(&kind);
  members.insert(members.end(), nodes_of_solid, nodes_of_solid + kind.nodes);
  first.push_back(static_cast<int>(members.size()));
  law.push_back(law_of_solid);
}

SolidSet solids_of(const Space& space) {
  const Mesh& mesh = space.mesh();
  SolidSet solids;
  if (mesh.solids.empty()) return solids;
  solids.nodes = space.nodes();
  for (const Material& material : mesh.materials)
    solids.laws.push_back(isotropic_elasticity(material));
  solids.laws.insert(solids.laws.end(), mesh.elasticities.begin(), mesh.elasticities.end());
  const auto materials = static_cast<int>(mesh.materials.size());
  for (int s = 0; s < static_cast<int>(mesh.solids.size()); ++s) {
    const Solid& solid = mesh.solids[s];
    solids.add(topology_of(solid.shape).kind, space.solid_nodes(s),
               solid.elasticity >= 0 ? materials + solid.elasticity : solid.material);
  }
  return solids;
}

StressColumns stresses_of(const SolidSet& solids, int solid, const Eigen::MatrixXd& gradients,
                          const Eigen::VectorXd& displacement) {
  const Elasticity& law = solids.laws[solids.law[solid]];
  const Eigen::Matrix3Xd places = solids.places(solid);
  Eigen::Matrix<double, 6, Eigen::Dynamic> moved_and_places(6, places.cols());
  for (int i = 0; i < places.cols(); ++i)
    moved_and_places.col(i) << displacement.segment<3>(
        3 * static_cast<Eigen::Index>(solids.node(solid, i))),
        places.col(i);
  // Derivatives of both by the unit coordinates, three columns a point.
  const Eigen::Matrix<double, 6, Eigen::Dynamic> by_unit = moved_and_places * gradients.transpose();
  StressColumns result(6, gradients.rows() / 3);
  for (Eigen::Index q = 0; q < result.cols(); ++q) {
    const auto here = by_unit.middleCols<3>(3 * q);
    const Eigen::Matrix3d g =  // du_a / dx_b
        here.topRows<3>() * here.bottomRows<3>().inverse();
    Eigen::Matrix<double, 6, 1> strain;
    strain << g.diagonal(), g(0, 1) + g(1, 0), g(1, 2) + g(2, 1), g(2, 0) + g(0, 2);
    result.col(q) = law * strain;
  }
  return result;
}

}  // namespace blocklift::structure

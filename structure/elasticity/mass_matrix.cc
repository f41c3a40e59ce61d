#include "structure/elasticity/mass_matrix.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "structure/index.h"

namespace blocklift::structure {

namespace {

/// Elements as lists of their nodes.
struct Elements {
  int nodes = 0;  ///< of the whole mesh
  std::vector<int> first{0};
  std::vector<int> members;

  int count() const { return static_cast<int>(first.size()) - 1; }
  int size(int element) const { return first[at(element) + 1] - first[at(element)]; }
  int node(int element, int local) const { return members[at(first[at(element)] + local)]; }
};

// The pattern of the lower triangle: in column j all i >= j that share an element with j.
NodalMass pattern(const Elements& elements) {
  std::vector<std::vector<int>> of_node(at(elements.nodes));
  for (int element = 0; element < elements.count(); ++element)
    for (int i = 0; i < elements.size(element); ++i)
      of_node[at(elements.node(element, i))].push_back(element);
  std::vector<long> start{0};
  std::vector<int> rows, column;
  for (int node = 0; node < elements.nodes; ++node) {
    column.assign(1, node);
    for (const int element : of_node[at(node)])
      for (int i = 0; i < elements.size(element); ++i)
        if (elements.node(element, i) > node) column.push_back(elements.node(element, i));
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows.insert(rows.end(), column.begin(), column.end());
    start.push_back(static_cast<long>(rows.size()));
  }
  NodalMass mass(elements.nodes, elements.nodes);
  mass.resizeNonZeros(static_cast<long>(rows.size()));
  std::copy(start.begin(), start.end(), mass.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), mass.innerIndexPtr());
  std::fill_n(mass.valuePtr(), rows.size(), 0.0);
  return mass;
}

NodalMass assemble(const Elements& elements,
                   const std::function<Eigen::MatrixXd(int)>& mass_of_element) {
  NodalMass mass = pattern(elements);
  for (int element = 0; element < elements.count(); ++element) {
    const Eigen::MatrixXd own = mass_of_element(element);
    for (int j = 0; j < own.cols(); ++j) {
      const int column = elements.node(element, j);
      const long* first = mass.innerIndexPtr() + mass.outerIndexPtr()[column];
      const long* last = mass.innerIndexPtr() + mass.outerIndexPtr()[column + 1];
      for (int i = 0; i < own.rows(); ++i) {
        const int row = elements.node(element, i);
        if (row < column) continue;
        mass.valuePtr()[std::lower_bound(first, last, row) - mass.innerIndexPtr()] += own(i, j);
      }
    }
  }
  return mass;
}

// sum over points of weight * N^T N.
Eigen::MatrixXd products(const Eigen::MatrixXd& values, const Eigen::VectorXd& weights) {
  return values.transpose() * weights.asDiagonal() * values;
}

}  // namespace

NodalMass part_mass_matrix(const PartModel& model) {
  const PartMesh& mesh = model.mesh;
  Elements elements;
  elements.nodes = static_cast<int>(mesh.nodes.cols());
  for (const int solid : mesh.solids) {
    for (int i = 0; i < mesh.kind(solid).nodes; ++i)
      elements.members.push_back(mesh.node(solid, i));
    elements.first.push_back(static_cast<int>(elements.members.size()));
  }
  return assemble(elements, [&](int s) -> Eigen::MatrixXd {
    const int solid = mesh.solids[at(s)];
    const ElementKind& kind = mesh.kind(solid);
    const Eigen::Matrix3Xd places = mesh.places(solid);
    Eigen::VectorXd weights(kind.weights.size());
    for (Eigen::Index q = 0; q < weights.size(); ++q)
      weights[q] = model.materials[at(model.material_of_solid[at(s)])].density * kind.weights[q] *
                   (places * kind.gradients.middleRows<3>(3 * q).transpose()).determinant();
    return products(kind.values, weights);
  });
}

Eigen::MatrixXd mass_times(const NodalMass& mass,
                           const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  using ByNode = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    const Eigen::Map<const ByNode> from(columns.col(c).data(), mass.rows(), 3);
    Eigen::Map<ByNode>(result.col(c).data(), mass.rows(), 3) =
        mass.selfadjointView<Eigen::Lower>() * from;
  }
  return result;
}

}  // namespace blocklift::structure

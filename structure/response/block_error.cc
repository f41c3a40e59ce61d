#include "structure/response/block_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <Eigen/Dense>

#include "structure/batches.h"
#include "structure/index.h"
#include "structure/response/cell_stress.h"

namespace blocklift::structure {

namespace {

using StressColumns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Values at `places` of the polynomials through `points` (both on a line): row a place.
Eigen::MatrixXd through_points(const Eigen::VectorXd& points, const Eigen::VectorXd& places) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(places.size(), points.size());
  for (Eigen::Index i = 0; i < points.size(); ++i)
    for (Eigen::Index j = 0; j < points.size(); ++j)
      if (j != i) values.col(i).array() *= (places.array() - points[j]) / (points[i] - points[j]);
  return values;
}

/// From the accurate points to the nodes of the reference element: nodes x points.
Eigen::MatrixXd extrapolation(const ReferenceElement& element, const Eigen::VectorXd& line) {
  const Eigen::Index p = line.size();
  std::array<Eigen::MatrixXd, 3> along;
  for (int axis = 0; axis < 3; ++axis)
    along[at(axis)] = through_points(line, element.nodes().row(axis).transpose());
  Eigen::MatrixXd result(element.node_count(), p * p * p);
  for (Eigen::Index k = 0; k < p; ++k)
    for (Eigen::Index j = 0; j < p; ++j)
      for (Eigen::Index i = 0; i < p; ++i)
        result.col((k * p + j) * p + i) =
            along[0].col(i).cwiseProduct(along[1].col(j)).cwiseProduct(along[2].col(k));
  return result;
}

/// Points of recovered stress: one for each node and plate (or crossing) that meet.
class Points {
 public:
  explicit Points(const ElasticModel& model) : model_(model) {
    const Discretisation& space = model.space();
    std::unordered_map<std::int64_t, int> known;
    const BlockMesh& mesh = model.mesh();
    const auto sheets = static_cast<std::int64_t>(mesh.sheet_names.size());
    for (int cell = 0; cell < space.cell_count(); ++cell) {
      const std::int64_t plate =
          mesh.cell_normal[at(cell)] < 0 ? sheets : mesh.cell_sheet[at(cell)];
      for (int i = 0; i < space.nodes_per_cell; ++i) {
        const std::int64_t key = (sheets + 1) * space.node(cell, i) + plate;
        const auto [found, is_new] = known.try_emplace(key, static_cast<int>(shares_.size()));
        if (is_new) shares_.push_back(0);
        ++shares_[at(found->second)];
        of_cell_.push_back(found->second);
      }
    }
  }

  int of(int cell, int local) const {
    return of_cell_[at(cell) * at(model_.space().nodes_per_cell) + at(local)];
  }
  int count() const { return static_cast<int>(shares_.size()); }
  int share(int point) const { return shares_[at(point)]; }

 private:
  const ElasticModel& model_;
  std::vector<int> of_cell_, shares_;
};

StressColumns recover(const ElasticModel& model, const Eigen::VectorXd& displacement,
                      const Points& points) {
  const Discretisation& space = model.space();
  const Eigen::Matrix2Xd line = gauss_points(space.element.degree());
  const CellStress stress(model.mesh(), space, tensor_rule(line, line, line).topRows<3>());
  const Eigen::MatrixXd to_nodes =
      extrapolation(space.element, line.row(0).transpose()).transpose();
  StressColumns recovered = StressColumns::Zero(6, points.count());
  for (int cell = 0; cell < space.cell_count(); ++cell) {
    const StressColumns at_nodes = stress(cell, displacement) * to_nodes;
    for (int i = 0; i < space.nodes_per_cell; ++i)
      recovered.col(points.of(cell, i)) += at_nodes.col(i) / points.share(points.of(cell, i));
  }
  return recovered;
}

}  // namespace

BlockError estimate_block_error(const ElasticModel& model, const Eigen::VectorXd& displacement,
                                int threads) {
  const Discretisation& space = model.space();
  const BlockMesh& mesh = model.mesh();
  const Points points(model);
  const StressColumns recovered = recover(model, displacement, points);
  const Eigen::Matrix2Xd line = gauss_points(space.element.degree() + 1);
  const Eigen::Matrix4Xd rule = tensor_rule(line, line, line);
  const CellStress own(mesh, space, rule.topRows<3>());
  const Eigen::MatrixXd values = space.element.values(rule.topRows<3>()).transpose();
  Eigen::VectorXd error = Eigen::VectorXd::Zero(space.cell_count()), norm = error;
  in_batches(space.cell_count(), 32, threads, [&](int first, int count) {
    StressColumns smooth(6, space.nodes_per_cell);
    for (int cell = first; cell < first + count; ++cell) {
      for (int i = 0; i < space.nodes_per_cell; ++i)
        smooth.col(i) = recovered.col(points.of(cell, i));
      const StressColumns s_h = own(cell, displacement);
      const StressColumns difference = smooth * values - s_h;
      const Material& material = mesh.material_of_cell(cell);
      for (Eigen::Index q = 0; q < rule.cols(); ++q) {
        const double volume =
            rule(3, q) * jacobian(mesh, cell, rule.col(q).head<3>()).determinant();
        error[cell] += volume * complementary_energy(material, difference.col(q));
        norm[cell] += volume * complementary_energy(material, s_h.col(q));
      }
    }
  });
  const auto relative = [](double e, double s) { return e + s > 0 ? std::sqrt(e / (e + s)) : 0; };
  BlockError result;
  result.relative = relative(error.sum(), norm.sum());
  std::vector<double> e(mesh.groups.size(), 0), s(mesh.groups.size(), 0);
  for (int cell = 0; cell < space.cell_count(); ++cell) {
    e[at(mesh.cell_group[at(cell)])] += error[cell];
    s[at(mesh.cell_group[at(cell)])] += norm[cell];
  }
  for (std::size_t g = 0; g < e.size(); ++g) result.of_groups.push_back(relative(e[g], s[g]));
  Eigen::Index worst = 0;
  error.maxCoeff(&worst);
  const int cell = static_cast<int>(worst);
  result.worst_part = mesh.sheet_names[at(mesh.cell_sheet[at(cell)])];
  result.worst_point = position(mesh, cell, Vector3::Constant(0.5));
  return result;
}

}  // namespace blocklift::structure

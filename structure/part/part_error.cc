#include "structure/part/part_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Dense>

#include "structure/mesh/element_shape.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

using StressColumns = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using Stress6 = Eigen::Matrix<double, 6, 1>;

// Points of an element kind at which its stresses are most accurate. Source: Barlow (1976).
Eigen::Matrix3Xd accurate_points(const ElementKind& kind) {
  const double g = kind.order > 1 ? 1 / std::sqrt(3.0) : 0;
  std::vector<Vector3> points;
  const auto along = [&](auto&& add) {
    if (kind.order == 1) return add(0.0);
    add(-g);
    add(g);
  };
  if (kind.corners == 8) {
    along([&](double z) {
      along([&](double y) { along([&](double x) { points.emplace_back(x, y, z); }); });
    });
  } else if (kind.corners == 6) {
    along([&](double z) {
      if (kind.order == 1) {
        points.emplace_back(1 / 3.0, 1 / 3.0, z);
        return;
      }
      points.emplace_back(1 / 6.0, 1 / 6.0, z);
      points.emplace_back(2 / 3.0, 1 / 6.0, z);
      points.emplace_back(1 / 6.0, 2 / 3.0, z);
    });
  } else if (kind.order == 1) {
    points.emplace_back(0.25, 0.25, 0.25);
  } else {
    const double a = (5 - std::sqrt(5.0)) / 20;
    points.emplace_back(a, a, a);
    for (int axis = 0; axis < 3; ++axis)
      points.emplace_back(Vector3::Constant(a) + (1 - 4 * a) * Vector3::Unit(axis));
  }
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t p = 0; p < points.size(); ++p) columns.col(p) = points[p];
  return columns;
}

/// Tables of shape functions at those points.
struct Sampling {
  Eigen::MatrixXd values;     ///< points x nodes
  Eigen::MatrixXd gradients;  ///< row 3 q + a
};

Sampling tabulate(const ElementKind& kind) {
  const Eigen::Matrix3Xd points = accurate_points(kind);
  const ElementShape shape(kind);
  Sampling sampling{Eigen::MatrixXd(points.cols(), kind.nodes),
                    Eigen::MatrixXd(3 * points.cols(), kind.nodes)};
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    sampling.values.row(q) = shape.values(points.col(q)).transpose();
    sampling.gradients.middleRows<3>(3 * q) = shape.gradients(points.col(q)).transpose();
  }
  return sampling;
}

// Scaled down by their degree: where samples do not tell terms apart (one layer of elements
// across), the solution of least norm takes the lower ones.
Eigen::RowVectorXd monomials(const Vector3& x, int order) {
  constexpr double scale = 1e-3;
  const Vector3 s = scale * x;
  if (order == 1) return Eigen::RowVector4d(1, s.x(), s.y(), s.z());
  Eigen::RowVectorXd terms(10);
  terms << 1, s.x(), s.y(), s.z(), s.x() * s.x(), s.y() * s.y(), s.z() * s.z(), s.x() * s.y(),
      s.y() * s.z(), s.z() * s.x();
  return terms;
}

/// Fits patches and evaluates them at the points of stress.
class Recovery {
 public:
  Recovery(const PartModel& model, const PartStress& stress, const Eigen::VectorXd& displacement)
      : model_(model),
        stress_(stress),
        solids_of_(stress.node.size()),
        is_corner_(stress.node.size(), 0),
        recovered_(StressColumns::Zero(6, stress.node.size())),
        shares_(stress.node.size(), 0) {
    sample(displacement);
    for (std::size_t point = 0; point < solids_of_.size(); ++point)
      if (is_corner_[point]) fit(static_cast<int>(point));
    for (std::size_t point = 0; point < shares_.size(); ++point)
      recovered_.col(point) /= std::max(1, shares_[point]);
  }

  const StressColumns& at_points() const { return recovered_; }

 private:
  int point(int solid, int local) const {
    return stress_.point_of[stress_.first_of[solid] + local];
  }
  const ElementKind& kind(int solid) const { return model_.mesh.kind(model_.mesh.solids[solid]); }
  Vector3 place(int point) const { return model_.mesh.nodes.col(stress_.node[point]); }

  void sample(const Eigen::VectorXd& displacement) {
    std::map<int, Sampling> tables;
    for (int solid = 0; solid < static_cast<int>(model_.mesh.solids.size()); ++solid) {
      const int element = model_.mesh.solids[solid];
      const int number = model_.mesh.elements[element].kind;
      auto table = tables.find(number);
      if (table == tables.end()) table = tables.emplace(number, tabulate(kind(solid))).first;
      sample_places_.push_back(model_.mesh.places(element) * table->second.values.transpose());
      sample_stresses_.push_back(
          part_stresses(model_, solid, table->second.gradients, displacement));
      for (int i = 0; i < kind(solid).corners; ++i) {
        is_corner_[point(solid, i)] = 1;
        solids_of_[point(solid, i)].push_back(solid);
      }
    }
  }

  // The solids about a corner; with those about their corners where they are too few to fit.
  std::vector<int> patch(int corner, Eigen::Index terms) const {
    const std::vector<int>& near = solids_of_[corner];
    Eigen::Index samples = 0;
    for (const int solid : near) samples += sample_places_[solid].cols();
    if (samples >= 2 * terms) return near;
    std::vector<int> wider;
    for (const int solid : near)
      for (int i = 0; i < kind(solid).corners; ++i) {
        const std::vector<int>& others = solids_of_[point(solid, i)];
        wider.insert(wider.end(), others.begin(), others.end());
      }
    std::sort(wider.begin(), wider.end());
    wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
    return wider;
  }

  void fit(int corner) {
    int order = 1;
    for (const int solid : solids_of_[corner]) order = std::max(order, kind(solid).order);
    const Vector3 centre = place(corner);
    const Eigen::Index terms = order == 1 ? 4 : 10;
    const std::vector<int> solids = patch(corner, terms);
    double reach = 0;
    Eigen::Index samples = 0;
    for (const int solid : solids) {
      samples += sample_places_[solid].cols();
      reach =
          std::max(reach, (sample_places_[solid].colwise() - centre).colwise().norm().maxCoeff());
    }
    Eigen::MatrixXd rows(samples, terms), values(samples, 6);
    Eigen::Index row = 0;
    for (const int solid : solids)
      for (Eigen::Index q = 0; q < sample_places_[solid].cols(); ++q, ++row) {
        rows.row(row) = monomials((sample_places_[solid].col(q) - centre) / reach, order);
        values.row(row) = sample_stresses_[solid].col(q).transpose();
      }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fitted(rows.rows(), rows.cols());
    fitted.setThreshold(1e-11);
    fitted.compute(rows);
    const Eigen::RowVectorXd mean = values.colwise().mean();
    values.rowwise() -= mean;
    const Eigen::MatrixXd polynomial = fitted.solve(values);
    const auto add = [&](int to) {
      recovered_.col(to) +=
          (mean + monomials((place(to) - centre) / reach, order) * polynomial).transpose();
      ++shares_[to];
    };
    add(corner);
    for (const int solid : solids_of_[corner])
      for (int i = kind(solid).corners; i < kind(solid).nodes; ++i) add(point(solid, i));
  }

  const PartModel& model_;
  const PartStress& stress_;
  std::vector<Eigen::Matrix3Xd> sample_places_;  ///< of each solid
  std::vector<StressColumns> sample_stresses_;
  std::vector<std::vector<int>> solids_of_;  ///< about each point that is a corner
  std::vector<char> is_corner_;
  StressColumns recovered_;
  std::vector<int> shares_;
};

/// @param better a better stress at the rule's points of a solid: 6 x points.
PartError compare_stresses(const PartModel& model, const Eigen::VectorXd& displacement,
                           const std::function<StressColumns(int)>& better) {
  const auto solids = static_cast<Eigen::Index>(model.mesh.solids.size());
  PartError error{Eigen::VectorXd::Zero(solids), Eigen::VectorXd::Zero(solids), {}};
  for (int solid = 0; solid < solids; ++solid) {
    const int element = model.mesh.solids[solid];
    const ElementKind& kind = model.mesh.kind(element);
    const Material& material = model.materials[model.material_of_solid[solid]];
    const StressColumns own = part_stresses(model, solid, kind.gradients, displacement);
    const StressColumns other = better(solid);
    const Eigen::Matrix3Xd places = model.mesh.places(element);
    for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
      const double volume =
          kind.weights[q] *
          (places * kind.gradients.middleRows<3>(3 * q).transpose()).determinant();
      error.squared_error[solid] +=
          volume * complementary_energy(material, other.col(q) - own.col(q));
      error.squared_norm[solid] += volume * complementary_energy(material, own.col(q));
    }
  }
  return error;
}

}  // namespace

double PartError::relative(const std::vector<int>& solids) const {
  double error = 0, norm = 0;
  for (const int solid : solids) {
    error += squared_error[solid];
    norm += squared_norm[solid];
  }
  return norm > 0 ? std::sqrt(error / (norm + error)) : 0;
}

PartError estimate_part_error(const PartModel& model, const PartStress& stress,
                              const Eigen::VectorXd& displacement) {
  const Recovery recovery(model, stress, displacement);
  PartError error = compare_stresses(model, displacement, [&](int solid) -> StressColumns {
    const ElementKind& kind = model.mesh.kind(model.mesh.solids[solid]);
    StressColumns nodal(6, kind.nodes);
    for (int i = 0; i < kind.nodes; ++i)
      nodal.col(i) = recovery.at_points().col(stress.point_of[stress.first_of[solid] + i]);
    return nodal * kind.values.transpose();
  });
  error.recovered = recovery.at_points();
  return error;
}

PartError true_part_error(const PartModel& model, const Eigen::VectorXd& displacement,
                          const std::function<Eigen::Matrix<double, 6, 1>(const Vector3&)>& exact) {
  return compare_stresses(model, displacement, [&](int solid) -> StressColumns {
    const int element = model.mesh.solids[solid];
    const Eigen::Matrix3Xd places =
        model.mesh.places(element) * model.mesh.kind(element).values.transpose();
    StressColumns stresses(6, places.cols());
    for (Eigen::Index q = 0; q < places.cols(); ++q) stresses.col(q) = exact(places.col(q));
    return stresses;
  });
}

}  // namespace blocklift::structure

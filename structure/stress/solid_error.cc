#include "structure/stress/solid_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "parallel/threads.h"
#include "structure/mesh/element_shape.h"

namespace blocklift::structure {

namespace {

// Points of an element kind at which its stresses are most accurate. Source: Barlow (1976). Of a
// pyramid the four of a quadrangle on each of the two levels of Gauss' and Jacobi's rule.
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
  } else if (kind.corners == 5) {
    for (const double z :
         kind.order == 1 ? std::vector{0.25} : std::vector{0.12251482265544, 0.54415184401123})
      along([&](double y) {
        along([&](double x) { points.emplace_back((1 - z) * x, (1 - z) * y, z); });
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
  Recovery(const SolidSet& solids, const NodalPoints& points, const Eigen::VectorXd& displacement,
           const HeldSolidStress& held)
      : set_(solids),
        points_(points),
        solids_of_(points.node.size()),
        is_corner_(points.node.size(), 0),
        recovered_(StressColumns::Zero(6, static_cast<Eigen::Index>(points.node.size()))),
        shares_(points.node.size(), 0) {
    sample(displacement, held);
    for (std::size_t point = 0; point < solids_of_.size(); ++point)
      if (is_corner_[point]) fit(static_cast<int>(point));
    for (std::size_t point = 0; point < shares_.size(); ++point)
      recovered_.col(point) /= std::max(1, shares_[point]);
  }

  const StressColumns& at_points() const { return recovered_; }

 private:
  int point(int solid, int local) const {
    return points_.point_of[points_.first_of[solid] + local];
  }
  const ElementKind& kind(int solid) const { return set_.kind(solid); }
  Vector3 place(int point) const { return set_.nodes.col(points_.node[point]); }

  void sample(const Eigen::VectorXd& displacement, const HeldSolidStress& held) {
    std::map<const ElementKind*, Sampling> tables;
    for (int solid = 0; solid < set_.count(); ++solid) {
      auto table = tables.find(&kind(solid));
      if (table == tables.end()) table = tables.emplace(&kind(solid), tabulate(kind(solid))).first;
      sample_places_.push_back(set_.places(solid) * table->second.values.transpose());
      sample_stresses_.push_back(stresses_of(set_, solid, table->second.gradients, displacement));
      if (held) sample_stresses_.back() -= held(solid, table->second.values);
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
    const Eigen::RowVectorXd mean = values.colwise().mean();
    values.rowwise() -= mean;
    const Eigen::MatrixXd polynomial = algebra::least_squares_by_pivots(rows, values, 1e-11);
    const auto add = [&](int to) {
      recovered_.col(to) +=
          (mean + monomials((place(to) - centre) / reach, order) * polynomial).transpose();
      ++shares_[to];
    };
    add(corner);
    for (const int solid : solids_of_[corner])
      for (int i = kind(solid).corners; i < kind(solid).nodes; ++i) add(point(solid, i));
  }

  const SolidSet& set_;
  const NodalPoints& points_;
  std::vector<Eigen::Matrix3Xd> sample_places_;  ///< of each solid
  std::vector<StressColumns> sample_stresses_;
  std::vector<std::vector<int>> solids_of_;  ///< about each point that is a corner
  std::vector<char> is_corner_;
  StressColumns recovered_;
  std::vector<int> shares_;
};

/// @param better a better stress at the rule's points of a solid: 6 x points.
SolidError compare_stresses(const SolidSet& solids, const Eigen::VectorXd& displacement,
                            int threads, const HeldSolidStress& held,
                            const std::function<StressColumns(int)>& better) {
  const int count = solids.count();
  SolidError error{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count), {}};
  std::vector<Elasticity> compliances;
  for (const Elasticity& law : solids.laws) compliances.push_back(algebra::inverse_of(law));
  parallel::in_batches(count, std::max(32, count / 64), threads, [&](int first, int many) {
    for (int solid = first; solid < first + many; ++solid) {
      const ElementKind& kind = solids.kind(solid);
      const Elasticity& compliance = compliances[solids.law[solid]];
      StressColumns own = stresses_of(solids, solid, kind.gradients, displacement);
      if (held) own -= held(solid, kind.values);
      const StressColumns difference = better(solid) - own;
      const Eigen::Matrix3Xd places = solids.places(solid);
      for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
        const double volume =
            kind.weights[q] *
            (places * kind.gradients.middleRows<3>(3 * q).transpose()).determinant();
        const Stress e = difference.col(q), s = own.col(q);
        error.squared_error[solid] += volume * e.dot(compliance * e);
        error.squared_norm[solid] += volume * s.dot(compliance * s);
      }
    }
  });
  return error;
}

}  // namespace

NodalPoints find_nodal_points(const SolidSet& solids) {
  NodalPoints points;
  std::map<std::pair<int, int>, int> known;  // (node, law)
  for (int solid = 0; solid < solids.count(); ++solid) {
    points.first_of.push_back(static_cast<int>(points.point_of.size()));
    for (int i = 0; i < solids.kind(solid).nodes; ++i) {
      const int node = solids.node(solid, i);
      const auto [entry, is_new] =
          known.try_emplace({node, solids.law[solid]}, static_cast<int>(points.node.size()));
      if (is_new) points.node.push_back(node);
      points.point_of.push_back(entry->second);
    }
  }
  return points;
}

double SolidError::relative(const std::vector<int>& solids) const {
  double error = 0, norm = 0;
  for (const int solid : solids) {
    error += squared_error[solid];
    norm += squared_norm[solid];
  }
  return norm > 0 ? std::sqrt(error / (norm + error)) : 0;
}

SolidError estimate_solid_error(const SolidSet& solids, const NodalPoints& points,
                                const Eigen::VectorXd& displacement, int threads,
                                const HeldSolidStress& held) {
  const Recovery recovery(solids, points, displacement, held);
  SolidError error =
      compare_stresses(solids, displacement, threads, held, [&](int solid) -> StressColumns {
        const ElementKind& kind = solids.kind(solid);
        StressColumns nodal(6, kind.nodes);
        for (int i = 0; i < kind.nodes; ++i)
          nodal.col(i) = recovery.at_points().col(points.point_of[points.first_of[solid] + i]);
        return nodal * kind.values.transpose();
      });
  error.recovered = recovery.at_points();
  return error;
}

SolidError true_solid_error(const SolidSet& solids, const Eigen::VectorXd& displacement,
                            const std::function<Stress(const Vector3&)>& exact) {
  return compare_stresses(solids, displacement, 1, {}, [&](int solid) -> StressColumns {
    const Eigen::Matrix3Xd places = solids.places(solid) * solids.kind(solid).values.transpose();
    StressColumns stresses(6, places.cols());
    for (Eigen::Index q = 0; q < places.cols(); ++q) stresses.col(q) = exact(places.col(q));
    return stresses;
  });
}

}  // namespace blocklift::structure

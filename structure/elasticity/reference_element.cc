#include "structure/elasticity/reference_element.h"

#include <string>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include "structure/error.h"

namespace blocklift::structure {

struct ReferenceElement::Shapes {
  dealii::FE_Q<3> element;
};

namespace {

int checked_degree(int degree) {
  if (degree < 1 || degree > 4)
    throw ModelError("element degree " + std::to_string(degree) +
                     " is asked for; 1, 2, 3 and 4 are there (3 is right for thin plates)");
  return degree;
}

}  // namespace

ReferenceElement::ReferenceElement(int degree)
    : degree_(checked_degree(degree)),
      shapes_(new Shapes{dealii::FE_Q<3>(static_cast<unsigned>(degree))}) {
  const auto& points = shapes_->element.get_unit_support_points();
  nodes_.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (unsigned a = 0; a < 3; ++a) nodes_(a, static_cast<Eigen::Index>(i)) = points[i][a];
}

ReferenceElement::~ReferenceElement() = default;

Eigen::MatrixXd ReferenceElement::values(const Eigen::Matrix3Xd& points) const {
  Eigen::MatrixXd result(points.cols(), node_count());
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const dealii::Point<3> point(points(0, q), points(1, q), points(2, q));
    for (int i = 0; i < node_count(); ++i)
      result(q, i) = shapes_->element.shape_value(static_cast<unsigned>(i), point);
  }
  return result;
}

Eigen::MatrixXd ReferenceElement::gradients(const Eigen::Matrix3Xd& points) const {
  Eigen::MatrixXd result(3 * points.cols(), node_count());
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const dealii::Point<3> point(points(0, q), points(1, q), points(2, q));
    for (int i = 0; i < node_count(); ++i) {
      const auto gradient = shapes_->element.shape_grad(static_cast<unsigned>(i), point);
      for (unsigned a = 0; a < 3; ++a) result(3 * q + a, i) = gradient[a];
    }
  }
  return result;
}

Eigen::Matrix2Xd gauss_points(int count) {
  const dealii::QGauss<1> rule(static_cast<unsigned>(count));
  Eigen::Matrix2Xd points(2, count);
  for (int q = 0; q < count; ++q) {
    points(0, q) = rule.point(static_cast<unsigned>(q))[0];
    points(1, q) = rule.weight(static_cast<unsigned>(q));
  }
  return points;
}

Eigen::Matrix4Xd tensor_rule(const Eigen::Matrix2Xd& x, const Eigen::Matrix2Xd& y,
                             const Eigen::Matrix2Xd& z) {
  Eigen::Matrix4Xd points(4, x.cols() * y.cols() * z.cols());
  Eigen::Index q = 0;
  for (Eigen::Index k = 0; k < z.cols(); ++k)
    for (Eigen::Index j = 0; j < y.cols(); ++j)
      for (Eigen::Index i = 0; i < x.cols(); ++i)
        points.col(q++) << x(0, i), y(0, j), z(0, k), x(1, i) * y(1, j) * z(1, k);
  return points;
}

}  // namespace blocklift::structure

#include "structure/formulation/triangle_sides.h"

#include <cmath>

#include <Eigen/LU>

namespace blocklift::structure {

Shapes functions_of_triangle(double r, double s) {
  const double l = 1 - r - s;
  Shapes shapes{Eigen::RowVectorXd(9), Eigen::RowVectorXd(9), Eigen::RowVectorXd(9)};
  shapes.value << l * (2 * l - 1), 4 * l * r, r * (2 * r - 1), 4 * l * s, 0, 4 * r * s,
      s * (2 * s - 1), 0, 0;
  shapes.d_1 << 1 - 4 * l, 4 * (l - r), 4 * r - 1, -4 * s, 0, 4 * s, 0, 0, 0;
  shapes.d_2 << 1 - 4 * l, -4 * r, 0, 4 * (l - s), 0, 4 * r, 4 * s - 1, 0, 0;
  return shapes;
}

Shapes beyond_triangle(const Shapes& cell, double xi, double eta) {
  const Shapes six = functions_of_triangle(xi * (1 - eta), eta);
  return {cell.value - six.value, cell.d_1 - (1 - eta) * six.d_1,
          cell.d_2 + xi * six.d_1 - six.d_2};
}

namespace {

/// The centroid is the last.
Eigen::Matrix<double, 2, 10> places_by_r_and_s() {
  const double a = 0.5 - std::sqrt(1.0 / 12), b = 1 - a, c = std::sqrt(1.0 / 3), third = 1.0 / 3;
  Eigen::Matrix<double, 2, 10> at;
  at << a, b, a, 0, 0, c, b, a, a, third,  //
      0, 0, c, a, b, a, a, b, a, third;
  return at;
}

/// Eight fields of shear (g_r, g_s) that are linear along each side.
Eigen::Matrix<double, 2, 8> fields_of_shear(double r, double s) {
  Eigen::Matrix<double, 2, 8> fields;
  fields << 1, r, s, 0, 0, 0, r * s, s * s,  //
      0, 0, 0, 1, r, s, -r * r, -r * s;
  return fields;
}

/// Takes the eight shears to factors of the fields.
Eigen::Matrix<double, 8, 8> factors_of_fields() {
  const Eigen::Matrix<double, 2, 10> places = places_by_r_and_s();
  const auto at = [&](Eigen::Index k) { return fields_of_shear(places(0, k), places(1, k)); };
  Eigen::Matrix<double, 8, 8> shears;
  shears << at(0).row(0), at(1).row(0), at(3).row(1), at(4).row(1), at(6).row(1) - at(6).row(0),
      at(7).row(1) - at(7).row(0), at(9);
  return shears.inverse();
}

}  // namespace

const Eigen::Matrix2Xd& places_on_triangle() {
  static const Eigen::Matrix2Xd all = [] {
    Eigen::Matrix2Xd at = places_by_r_and_s();
    at.row(0).array() /= 1 - at.row(1).array();
    return at;
  }();
  return all;
}

Eigen::Matrix<double, 2, 8> shares_of_shears(double xi, double eta) {
  static const Eigen::Matrix<double, 8, 8> factors = factors_of_fields();
  Eigen::Matrix2d turned;
  turned << 1 - eta, 0, -xi, 1;
  return turned * fields_of_shear(xi * (1 - eta), eta) * factors;
}

Eigen::Matrix<double, 3, 9> shares_of_stretches(double xi, double eta) {
  static const Eigen::Matrix<double, 2, 10> places = places_by_r_and_s();
  const double h = 1 - eta;
  Eigen::Matrix<double, 3, 9> stretches = Eigen::Matrix<double, 3, 9>::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::Matrix3d functions;  // 1, r and s at the three places
    for (Eigen::Index k = 0; k < 3; ++k) {
      functions.col(k) << 1, places.col(3 * i + k);
    }
    stretches.block<1, 3>(i, 3 * i) = functions.inverse() * Eigen::Vector3d(1, xi * h, eta);
  }
  Eigen::Matrix3d tensor;  // e_rr, e_ss and e_rs = (e_rr + e_ss) / 2 - e_qq
  tensor << 1, 0, 0, 0, 1, 0, 0.5, 0.5, -1;
  Eigen::Matrix3d turned;
  turned << h * h, 0, 0, xi * xi, 1, -2 * xi, -2 * h * xi, 0, 2 * h;
  return turned * tensor * stretches;
}

}  // namespace blocklift::structure

// Waves that a plane of symmetry gives.
#include "pipeline/formats/hydrodynamics/mirrored_headings.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using Force = std::complex<double>;

constexpr double of_degree = std::numbers::pi / 180;

std::vector<double> degrees(int first, int last, int step) {
  std::vector<double> headings;
  for (int angle = first; angle <= last; angle += step) headings.push_back(angle * of_degree);
  return headings;
}

/// Forces as the symmetry of a ship has them in waves of a heading.
/// @param lengthwise what bow and stern have not alike.
Eigen::VectorXcd forces(double theta, double w, double lengthwise) {
  const double c = std::cos(theta), s = std::sin(theta);
  const Force uneven = Force(0.3, 0.2) * lengthwise;
  Eigen::VectorXcd X(6);
  X << Force(0, w) * c + uneven * c * c, Force(1, w) * s + uneven * c * s,
      Force(w, 0.1) * (1 + 0.2 * c * c) + uneven * c, Force(2, w) * s + uneven * c * s,
      Force(3, -w) * c + uneven, Force(0.5, 0.1) * s * c + uneven * s;
  return X;
}

HydrodynamicDatabase ship(const std::vector<double>& headings, double lengthwise) {
  HydrodynamicDatabase database;
  database.body_names = {"ship"};
  database.reference_points = {{lengthwise, 0, -1}};
  database.headings = headings;
  database.frequencies = {0.5, 1.0};
  const auto columns = static_cast<Eigen::Index>(headings.size());
  for (const double w : database.frequencies) {
    Eigen::MatrixXd A = 10 * Eigen::MatrixXd::Identity(6, 6);
    A(0, 4) = A(4, 0) = A(1, 3) = A(3, 1) = 2;
    A(2, 4) = A(4, 2) = A(1, 5) = A(5, 1) = lengthwise;
    database.added_mass.push_back(A);
    database.damping.push_back(w * A);
    Eigen::MatrixXcd X(6, columns);
    for (Eigen::Index h = 0; h < columns; ++h)
      X.col(h) = forces(headings[static_cast<std::size_t>(h)], w, lengthwise);
    database.froude_krylov.push_back(0.25 * X);
    database.diffraction.push_back(0.75 * X);
    database.mean_drift.push_back(X.real());
  }
  return database;
}

double difference(const HydrodynamicDatabase& one, const HydrodynamicDatabase& other) {
  double largest = 0;
  for (std::size_t h = 0; h < one.headings.size(); ++h)
    largest = std::max(largest, std::abs(one.headings[h] - other.headings[h]));
  for (std::size_t k = 0; k < one.frequencies.size(); ++k) {
    for (const Eigen::MatrixXcd& apart :
         {Eigen::MatrixXcd(one.froude_krylov[k] - other.froude_krylov[k]),
          Eigen::MatrixXcd(one.diffraction[k] - other.diffraction[k])})
      largest = std::max(largest, apart.cwiseAbs().maxCoeff());
    largest = std::max(largest, (one.mean_drift[k] - other.mean_drift[k]).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(MirroredHeadings, OfAShipAreThoseOfTheWholeTurn) {
  const HydrodynamicDatabase whole = ship(degrees(0, 345, 15), 1);
  for (const auto& half : {degrees(0, 180, 15), degrees(180, 360, 15), degrees(-180, 0, 15)}) {
    HydrodynamicDatabase database = ship(half, 1);
    EXPECT_EQ(mirror_headings(database), "y = 0");
    ASSERT_EQ(database.headings.size(), whole.headings.size());
    EXPECT_LT(difference(database, whole), 1e-12);
  }
}

TEST(MirroredHeadings, OfABargeFollowFromAQuarter) {
  const HydrodynamicDatabase whole = ship(degrees(0, 330, 30), 0);
  HydrodynamicDatabase database = ship(degrees(0, 90, 30), 0);
  EXPECT_EQ(mirror_headings(database), "y = 0 and x = 0");
  ASSERT_EQ(database.headings.size(), whole.headings.size());
  EXPECT_LT(difference(database, whole), 1e-12);
}

TEST(MirroredHeadings, AreNotMadeUp) {
  const auto is_left = [](const HydrodynamicDatabase& given) {
    HydrodynamicDatabase database = given;
    return mirror_headings(database).empty() && database.headings == given.headings;
  };
  const std::vector<double> half = degrees(0, 180, 15);
  EXPECT_TRUE(is_left(ship(degrees(0, 345, 15), 1))) << "they go round";
  EXPECT_TRUE(is_left(ship(degrees(0, 90, 15), 1))) << "bow and stern are not alike";
  EXPECT_TRUE(is_left(ship(degrees(0, 180, 60), 1))) << "too far apart";
  EXPECT_TRUE(is_left(ship(degrees(15, 165, 15), 1))) << "none along the plane";
  std::vector<double> read_as_degrees = half;
  for (double& heading : read_as_degrees) heading *= of_degree;
  EXPECT_TRUE(is_left(ship(read_as_degrees, 1)));
  HydrodynamicDatabase database = ship(half, 1);
  database.diffraction[1](1, 0) = 0.1;
  EXPECT_TRUE(is_left(database)) << "waves from astern press it sideways";
  database = ship(half, 1);
  database.added_mass[0](0, 1) = 0.5;
  EXPECT_TRUE(is_left(database)) << "surge and sway are coupled";
  database = ship(half, 1);
  database.reference_points[0].y() = 2;
  EXPECT_TRUE(is_left(database)) << "y = 0 is not its middle";
  database = ship(half, 1);
  database.body_names.emplace_back("other");
  EXPECT_TRUE(is_left(database));
}

}  // namespace
}  // namespace blocklift::pipeline

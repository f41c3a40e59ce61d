#include "tests/pipeline/formats/hydrodynamics/sample_database.h"

#include <cmath>

namespace blocklift::pipeline {
namespace {

/// Numbers that look random and are the same everywhere.
class Numbers {
 public:
  double next() {
    place_ += 1.0;
    const double x = std::sin(12.9898 * place_) * 43758.5453;
    return x - std::floor(x) + 0.1;
  }
  Eigen::MatrixXd symmetric(Eigen::Index size, double scale) {
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) matrix(i, j) = matrix(j, i) = scale * next();
    }
    return matrix;
  }
  Eigen::MatrixXcd complex(Eigen::Index rows, Eigen::Index columns, double scale) {
    Eigen::MatrixXcd matrix(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (Eigen::Index j = 0; j < columns; ++j) {
        matrix(i, j) = {scale * next(), -scale * next()};
      }
    }
    return matrix;
  }

 private:
  double place_ = 0.0;
};

}  // namespace

dynamics::HydrodynamicDatabase make_sample_database() {
  Numbers numbers;
  dynamics::HydrodynamicDatabase database;
  database.water = {1025.0, 9.80665, 40.0};
  database.body_names = {"left", "right"};
  database.reference_points = {{-12.5, 0, 0.1}, {12.5, 0, 1.0 / 3.0}};
  database.centres_of_buoyancy = {{-12.5, 0, -1.7}, {12.5, 0, -1.9}};
  database.centres_of_mass = {{-12.5, 0.3, 2.2}, {12.5, -0.3, 2.4}};
  database.displaced_volumes = {1234.5, 2345.6};
  const Eigen::Index modes = database.mode_count();
  database.hydrostatic_stiffness = numbers.symmetric(modes, 1e7);
  database.infinite_added_mass = numbers.symmetric(modes, 3e6);
  database.frequencies = {0.3, 0.7, 1.1};
  database.headings = {0.0, 0.785398163397448};
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    database.added_mass.push_back(numbers.symmetric(modes, 3e6));
    database.damping.push_back(numbers.symmetric(modes, 1e6));
    database.froude_krylov.push_back(numbers.complex(modes, 2, 1e6));
    database.diffraction.push_back(numbers.complex(modes, 2, 1e5));
  }
  database.time_step = 0.1;
  const Eigen::MatrixXd kernel = numbers.symmetric(modes, 1e6);
  for (int n = 0; n < 40; ++n) {
    database.retardation.emplace_back(std::exp(-0.1 * n) * std::cos(0.3 * n) * kernel);
  }
  return database;
}

}  // namespace blocklift::pipeline

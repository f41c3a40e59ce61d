#pragma once

#include <random>
#include <vector>

#include "dynamics/multibody/mechanism.h"

namespace blocklift::dynamics::examples {

/// Numbers that a seed fixes.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vector3 vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Vector3 direction() {
    const Vector3 a = vector(1);
    return a.norm() > 0.1 ? a.normalized() : direction();
  }
  Matrix3 rotation() { return rotation_about(direction(), uniform(-3, 3)); }
  Pose pose(double size) { return {rotation(), vector(size)}; }
  Eigen::VectorXd values(int n, double size) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(-size, size); });
  }
  ForceVector force() { return {vector(10), vector(10)}; }

 private:
  std::mt19937 engine_;
};

/// A body with a joint of the given kind in a place of no symmetry, of 0.5 to 3 kg.
BodyDefinition random_body(Random& random, JointKind kind, const std::string& name,
                           const std::string& parent);

/// Tree of `count` bodies, all joint kinds in turn, each on a body drawn at random; about a quarter
/// of the joints driven if asked for; damping on half of them.
Mechanism random_tree(Random& random, int count, bool with_drives);

/// Configuration with unit quaternions.
Eigen::VectorXd random_configuration(Random& random, const Mechanism& mechanism);

/// A force on each body, the world included.
std::vector<ForceVector> random_forces(Random& random, const Mechanism& mechanism);

/// No external force on any body.
std::vector<ForceVector> no_forces(const Mechanism& mechanism);

}  // namespace blocklift::dynamics::examples

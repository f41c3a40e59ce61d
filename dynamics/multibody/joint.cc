#include "dynamics/multibody/joint.h"

#include <array>
#include <cmath>

#include "algebra/decompositions.h"

namespace blocklift::dynamics {
namespace {

struct KindProperties {
  std::string_view name;
  int coordinates;
  int velocities;
  int quaternion;  // offset, -1: none
};

constexpr std::array<KindProperties, 9> properties{{{"fixed", 0, 0, -1},
                                                    {"revolute", 1, 1, -1},
                                                    {"prismatic", 1, 1, -1},
                                                    {"cylindrical", 2, 2, -1},
                                                    {"universal", 2, 2, -1},
                                                    {"spherical", 4, 3, 0},
                                                    {"planar", 3, 3, -1},
                                                    {"translational", 3, 3, -1},
                                                    {"free", 7, 6, 3}}};

const KindProperties& of(JointKind kind) { return properties[static_cast<std::size_t>(kind)]; }

// (1 - cos a)/a^2 and (a - sin a)/a^3, by their series where the quotients lose digits.
struct ExponentialCoefficients {
  double b;
  double c;
  explicit ExponentialCoefficients(double a) {
    const double a2 = a * a;
    if (a > 0.05) {
      b = (1.0 - std::cos(a)) / a2;
      c = (a - std::sin(a)) / (a2 * a);
    } else {
      b = 0.5 - a2 / 24.0 * (1.0 - a2 / 30.0 * (1.0 - a2 / 56.0));
      c = 1.0 / 6.0 - a2 / 120.0 * (1.0 - a2 / 42.0 * (1.0 - a2 / 72.0));
    }
  }
};

// Displacement, in the starting body frame, of a body moved by the constant twist (theta; d):
// V d with V = 1 + b [theta]x + c [theta]x^2.
Matrix3 screw_displacement(const Vector3& theta) {
  const ExponentialCoefficients k(theta.norm());
  const Matrix3 K = skew(theta);
  return Matrix3::Identity() + k.b * K + k.c * K * K;
}

}  // namespace

int coordinate_count(JointKind kind) { return of(kind).coordinates; }
int velocity_count(JointKind kind) { return of(kind).velocities; }
bool velocities_are_rates(JointKind kind) { return of(kind).quaternion < 0; }

std::optional<int> quaternion_offset(JointKind kind) {
  if (of(kind).quaternion < 0) return std::nullopt;
  return of(kind).quaternion;
}

std::string_view joint_kind_name(JointKind kind) { return of(kind).name; }

std::optional<JointKind> joint_kind(std::string_view name) {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == name) return static_cast<JointKind>(i);
  }
  return std::nullopt;
}

const std::vector<std::string_view>& joint_kind_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> result;
    result.reserve(properties.size());
    for (const KindProperties& kind : properties) result.push_back(kind.name);
    return result;
  }();
  return names;
}

Eigen::VectorXd zero_coordinates(JointKind kind) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(coordinate_count(kind));
  if (const auto offset = quaternion_offset(kind)) q[*offset] = 1.0;
  return q;
}

void joint_rates(JointKind kind, const double* q, const double* v, double* rates) {
  using ConstMap3 = Eigen::Map<const Vector3>;
  using ConstMap4 = Eigen::Map<const Vector4>;
  switch (kind) {
    case JointKind::spherical:
      Eigen::Map<Vector4>(rates, 4) = quaternion_rate(ConstMap4(q), ConstMap3(v));
      break;
    case JointKind::free:
      Eigen::Map<Vector3>(rates, 3) = rotation_from_quaternion(ConstMap4(q + 3)) * ConstMap3(v + 3);
      Eigen::Map<Vector4>(rates + 3, 4) = quaternion_rate(ConstMap4(q + 3), ConstMap3(v));
      break;
    default:
      for (int i = 0; i < velocity_count(kind); ++i) rates[i] = v[i];
  }
}

void integrate_joint(JointKind kind, const double* q, const double* v, double s, double* result) {
  if (velocities_are_rates(kind)) {
    for (int i = 0; i < velocity_count(kind); ++i) result[i] = q[i] + s * v[i];
    return;
  }
  const int offset = of(kind).quaternion;
  const Vector4 quaternion = Eigen::Map<const Vector4>(q + offset);
  const Vector3 theta = s * Eigen::Map<const Vector3>(v);
  if (kind == JointKind::free) {
    const Vector3 d = s * Eigen::Map<const Vector3>(v + 3);
    const Vector3 p = Eigen::Map<const Vector3>(q);
    Eigen::Map<Vector3>(result, 3) =
        p + rotation_from_quaternion(quaternion) * (screw_displacement(theta) * d);
  }
  Eigen::Map<Vector4>(result + offset, 4) =
      quaternion_product(quaternion, quaternion_exponential(theta)).normalized();
}

void difference_joint(JointKind kind, const double* q_from, const double* q_to, double* v) {
  if (velocities_are_rates(kind)) {
    for (int i = 0; i < velocity_count(kind); ++i) v[i] = q_to[i] - q_from[i];
    return;
  }
  const int offset = of(kind).quaternion;
  Vector4 back = Eigen::Map<const Vector4>(q_from + offset);
  const Matrix3 R_JB = rotation_from_quaternion(back);
  back.tail<3>() *= -1.0;
  const Vector3 theta =
      rotation_vector(quaternion_product(back, Eigen::Map<const Vector4>(q_to + offset)));
  Eigen::Map<Vector3>(v, 3) = theta;
  if (kind == JointKind::free) {
    const Vector3 p = Eigen::Map<const Vector3>(q_to) - Eigen::Map<const Vector3>(q_from);
    Eigen::Map<Vector3>(v + 3, 3) =
        algebra::solve_square(screw_displacement(theta), R_JB.transpose() * p);
  }
}

}  // namespace blocklift::dynamics

#include "structure/mesh/laminate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

namespace blocklift::structure {

namespace {

double largest(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const double size = largest(a);
  return size > 0 ? largest(a - b) / size : largest(b) > 0 ? 1.0 : 0.0;
}

/// A layer's strains of those of the plate.
Eigen::Matrix3d strain_of_layer(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d strain;
  strain << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return strain;
}

/// One layer as cylindrical bending about an axis sees it.
struct Layer {
  double bottom = 0, top = 0, stiffness = 0, shear = 0;
};

/// Shear stiffness across the plate by equilibrium.
double shear_stiffness(const std::vector<Layer>& layers) {
  double stretch = 0, couple = 0, bend = 0;
  for (const Layer& layer : layers) {
    stretch += layer.stiffness * (layer.top - layer.bottom);
    couple += layer.stiffness * (std::pow(layer.top, 2) - std::pow(layer.bottom, 2)) / 2;
    bend += layer.stiffness * (std::pow(layer.top, 3) - std::pow(layer.bottom, 3)) / 3;
  }
  const double neutral = couple / stretch;
  const double rigidity = bend - couple * neutral;
  const auto first_moment = [&](const Layer& layer, double z) {
    return layer.stiffness *
           ((z * z - layer.bottom * layer.bottom) / 2 - neutral * (z - layer.bottom));
  };
  // Gauss' rule of three points integrates the square of a quadratic exactly.
  const std::array<double, 3> points{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double below = 0, flexibility = 0;
  for (const Layer& layer : layers) {
    const double height = layer.top - layer.bottom;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double moment = below + first_moment(layer, layer.bottom + points[i] * height);
      flexibility += weights[i] * height * moment * moment / layer.shear;
    }
    below += first_moment(layer, layer.top);
  }
  return rigidity * rigidity / flexibility;
}

}  // namespace

PlyMaterial isotropic_ply(const Material& material) {
  const double shear = material.shear_modulus();
  return orthotropic_ply(material.youngs_modulus, material.youngs_modulus, material.poisson_ratio,
                         shear, shear, shear, material.density);
}

PlyMaterial orthotropic_ply(double modulus_1, double modulus_2, double poisson_12, double shear_12,
                            double shear_13, double shear_23, double density) {
  const double poisson_21 = poisson_12 * modulus_2 / modulus_1;
  const double scale = 1 / (1 - poisson_12 * poisson_21);
  PlyMaterial ply;
  ply.in_plane << modulus_1 * scale, poisson_12 * modulus_2 * scale, 0,
      poisson_12 * modulus_2 * scale, modulus_2 * scale, 0, 0, 0, shear_12;
  ply.shear << shear_13, shear_23;
  ply.density = density;
  return ply;
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& in_plane, double angle) {
  const Eigen::Matrix3d strain = strain_of_layer(angle);
  return strain.transpose() * in_plane * strain;
}

Laminate stack(const std::vector<Ply>& plies) {
  double height = 0;
  for (const Ply& ply : plies) height += ply.thickness;
  Laminate laminate;
  std::array<std::vector<Layer>, 2> layers;
  double bottom = -height / 2;
  for (const Ply& ply : plies) {
    const double top = bottom + ply.thickness;
    const Eigen::Matrix3d stiffness = turned(ply.material.in_plane, ply.angle);
    laminate.membrane += stiffness * (top - bottom);
    laminate.coupling += stiffness * (top * top - bottom * bottom) / 2;
    laminate.bending += stiffness * (std::pow(top, 3) - std::pow(bottom, 3)) / 3;
    const double c = std::cos(ply.angle), s = std::sin(ply.angle);
    const double shear_1 = c * c * ply.material.shear[0] + s * s * ply.material.shear[1];
    const double shear_2 = s * s * ply.material.shear[0] + c * c * ply.material.shear[1];
    layers[0].push_back({bottom, top, stiffness(0, 0), shear_1});
    layers[1].push_back({bottom, top, stiffness(1, 1), shear_2});
    bottom = top;
  }
  laminate.shear(0, 0) = shear_stiffness(layers[0]);
  laminate.shear(1, 1) = shear_stiffness(layers[1]);
  return laminate;
}

LaminateExpansion expansion_of(const std::vector<Ply>& plies) {
  double bottom = 0;
  for (const Ply& ply : plies) bottom -= ply.thickness / 2;
  LaminateExpansion expansion;
  for (const Ply& ply : plies) {
    const double top = bottom + ply.thickness;
    const Eigen::Vector3d stress = ply.material.in_plane * ply.material.expansion;
    const Eigen::Vector3d along_plate = strain_of_layer(ply.angle).transpose() * stress;
    const double energy = ply.material.expansion.dot(stress);
    const std::array<double, 3> moments{top - bottom, (top * top - bottom * bottom) / 2,
                                        (std::pow(top, 3) - std::pow(bottom, 3)) / 3};
    for (std::size_t i = 0; i < moments.size(); ++i) {
      expansion.forces[i] += moments[i] * along_plate;
      expansion.energies[i] += moments[i] * energy;
    }
    bottom = top;
  }
  return expansion;
}

LaminateExpansion expansion_of(const Material& material, const MaterialExpansion& expansion,
                               double thickness) {
  PlyMaterial ply = isotropic_ply(material);
  ply.expansion << expansion.coefficient, expansion.coefficient, 0;
  LaminateExpansion of_plate = expansion_of({{ply, thickness, 0}});
  of_plate.reference = expansion.reference;
  of_plate.obstacle = expansion.obstacle;
  return of_plate;
}

std::optional<double> even_coefficient(const LaminateExpansion& expansion,
                                       const NearestPlate& nearest, double thickness) {
  constexpr double tolerance = 1e-6;
  const double force = (expansion.forces[0][0] + expansion.forces[0][1]) / 2;
  const Eigen::Vector3d even(force, force, 0);
  const double least = tolerance * largest(expansion.forces[0]);
  const bool is_even = largest(expansion.forces[0] - even) <= least &&
                       largest(expansion.forces[1]) <= least * thickness &&
                       largest(expansion.forces[2] - thickness * thickness / 12 * even) <=
                           least * thickness * thickness / 12;
  if (!is_even) return std::nullopt;
  return force * (1 - nearest.poisson_ratio) / (nearest.youngs_modulus * thickness);
}

Laminate homogeneous(const Material& material, double thickness) {
  return stack({{isotropic_ply(material), thickness, 0}});
}

NearestPlate nearest_plate(const Laminate& laminate, double thickness) {
  const Eigen::Matrix3d& a = laminate.membrane;
  const double direct = (3 * a(0, 0) + 3 * a(1, 1) + 2 * a(0, 1) + 4 * a(2, 2)) / (8 * thickness);
  const double crossed = (a(0, 0) + a(1, 1) + 6 * a(0, 1) - 4 * a(2, 2)) / (8 * thickness);
  NearestPlate plate;
  const double ratio = std::clamp(crossed / direct, -0.99, 0.99);
  plate.youngs_modulus = direct * (1 - ratio * ratio);
  // Woven cloth at 45 degrees is softer in shear than any isotropic plate.
  plate.poisson_ratio = std::clamp(ratio, -0.99, 0.49);
  const Laminate same = homogeneous(
      {.name = "", .youngs_modulus = plate.youngs_modulus, .poisson_ratio = plate.poisson_ratio},
      thickness);
  plate.membrane_error = difference(laminate.membrane, same.membrane);
  plate.bending_error = difference(laminate.bending, same.bending);
  plate.shear_error = difference(laminate.shear, same.shear);
  plate.coupling_error = 2 * largest(laminate.coupling) / (largest(laminate.membrane) * thickness);
  return plate;
}

}  // namespace blocklift::structure

#include "dynamics/marine/hull_force.h"

#include "dynamics/errors.h"

namespace blocklift::dynamics {

static_assert(TriangleTree::most_points <= static_cast<int>(WaveField::most_points));

HullForce::HullForce(Definition definition) : definition_(std::move(definition)) {
  if (!definition_.hull || !definition_.sea) {
    throw ModelError("hull force \"" + definition_.name + "\" needs a hull and a sea");
  }
  if (definition_.body <= world_index) {
    throw ModelError("hull force \"" + definition_.name +
                     "\" acts on the world; give it to a body that moves");
  }
  const Water& water = definition_.sea->water();
  rho_g_ = water.density * water.gravity;
  if (!in_waves()) return;
  boxes_ = std::make_shared<const PressureBoxes>(definition_.hull->panels(), definition_.sea->waves,
                                                 box_tolerance);
}

namespace {

using Values = std::array<double, WaveField::most_points>;

// Places of points of the body in the world.
void locate(const Pose& X_WB, std::span<const Vector3> points_B, double* x, double* y, double* z) {
  for (std::size_t i = 0; i < points_B.size(); ++i) {
    const Vector3 place = X_WB.apply(points_B[i]);
    x[i] = place.x();
    y[i] = place.y();
    z[i] = place.z();
  }
}

// The wetted part of a triangle of the given area that the surface cuts, h being the heights of its
// corners p above the water and q the pressure over rho g there, which is linear from the wet ones to zero
// at the surface: int q dA n and int p x n q dA.
void add_cut(const std::array<const Vector3*, 3>& p, const std::array<double, 3>& h,
             const std::array<double, 3>& q, int wet, const Vector3& area, ForceVector& F) {
  // The corner that is alone on its side comes first; the order round the triangle is kept.
  std::size_t i = 0;
  while ((h[i] < 0.0) != (wet == 1)) ++i;
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  const double to_j = h[i] / (h[i] - h[j]);
  const double to_k = h[i] / (h[i] - h[k]);
  const Vector3 ij = *p[i] + to_j * (*p[j] - *p[i]);
  const Vector3 ik = *p[i] + to_k * (*p[k] - *p[i]);
  double sum;   // of q over the corners of each wet piece, times its share of the area
  Vector3 arm;  // 12 int p q dA over the area
  if (wet == 1) {
    const double share = to_j * to_k;
    sum = share * q[i];
    arm = sum * (2.0 * *p[i] + ij + ik);
  } else {
    // The triangles (ij, j, k) and (ij, k, ik).
    const double share = 1.0 - to_j, rest = to_j * (1.0 - to_k);
    const double both = share * (q[j] + q[k]), upper = rest * q[k];
    sum = both + upper;
    arm = both * (ij + *p[j] + *p[k]) + share * (q[j] * *p[j] + q[k] * *p[k]) +
          upper * (ij + 2.0 * *p[k] + ik);
  }
  F.force -= sum / 3.0 * area;
  F.moment -= (arm / 12.0).cross(area);
}

}  // namespace

void HullForce::add_leaf(double time, const Pose& X_WB, const TriangleTree::Node& leaf,
                         ForceVector& F) const {
  const TriangleTree& tree = definition_.hull->panels();
  const std::span<const Vector3> points = tree.points(leaf);
  const std::size_t count = points.size();
  Values x, y, z, height, head;
  locate(X_WB, points, x.data(), y.data(), z.data());
  definition_.sea->waves.calc_surface(time, count, x.data(), y.data(), z.data(), height.data(),
                                      head.data());
  for (std::size_t i = 0; i < count; ++i) {
    height[i] = z[i] - height[i];
    head[i] -= z[i];
  }
  for (const TriangleTree::Triangle& triangle : tree.triangles(leaf)) {
    const auto [a, b, c] = triangle.corners;
    const int wet =
        (height[a] < 0.0 ? 1 : 0) + (height[b] < 0.0 ? 1 : 0) + (height[c] < 0.0 ? 1 : 0);
    if (wet == 0) continue;
    if (wet < 3) {
      add_cut({&points[a], &points[b], &points[c]}, {height[a], height[b], height[c]},
              {head[a], head[b], head[c]}, wet, triangle.area, F);
      continue;
    }
    const double sum = head[a] + head[b] + head[c];
    const Vector3 arm =
        (head[a] + sum) * points[a] + (head[b] + sum) * points[b] + (head[c] + sum) * points[c];
    F.force -= sum / 3.0 * triangle.area;
    F.moment -= (arm / 12.0).cross(triangle.area);
  }
}

void HullForce::add_box(double time, const Pose& X_WB, int box, ForceVector& F) const {
  const std::span<const Vector3> points = boxes_->points(box);
  const std::size_t count = points.size();
  Values x, y, z, elevation, head;
  locate(X_WB, points, x.data(), y.data(), z.data());
  definition_.sea->waves.calc_surface(time, count, x.data(), y.data(), z.data(), elevation.data(),
                                      head.data());
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  const std::span<const PressureBoxes::Weight> weights = boxes_->weights(box);
  for (std::size_t i = 0; i < count; ++i) sum += (head[i] - z[i]) * weights[i];
  F.moment += sum.head<3>();
  F.force += sum.tail<3>();
}

ForceVector HullForce::calc_force_in_waves(double time, const Pose& X_WB) const {
  const WaveField& waves = definition_.sea->waves;
  const double crest = waves.highest_elevation() * waves.ramp().factor(time);
  const Vector3 up = X_WB.R.row(2);
  const Vector3 magnitude = up.cwiseAbs();
  ForceVector F_B = ForceVector::zero();
  definition_.hull->panels().visit(
      [&](const TriangleTree::Node& node, int index) {
        const double middle = X_WB.p.z() + up.dot(node.centre);
        const double reach = magnitude.dot(node.half_extent);
        if (middle - reach >= crest) return false;
        if (middle + reach >= -crest || !boxes_->has(index)) return true;
        add_box(time, X_WB, index, F_B);
        return false;
      },
      [&](const TriangleTree::Node& leaf) { add_leaf(time, X_WB, leaf, F_B); });
  return {rho_g_ * (X_WB.R * F_B.moment), rho_g_ * (X_WB.R * F_B.force)};
}

ForceVector HullForce::calc_force(const MotionState& state) const {
  const Pose& X_WB = state.kinematics.X_WB[static_cast<std::size_t>(definition_.body)];
  if (in_waves()) return calc_force_in_waves(state.time, X_WB);
  return rho_g_ * calc_buoyancy(*definition_.hull, X_WB).F_Bo_W_over_rho_g;
}

void HullForce::add_forces(const MotionState& state, Loads& loads) const {
  loads.F_Bo_W[static_cast<std::size_t>(definition_.body)] += calc_force(state);
}

void HullForce::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  const Eigen::Matrix<double, 6, 6> K = calc_stiffness_over_rho_g(calc_calm_hydrostatics(state));
  derivatives.locate(0, definition_.body, Vector3::Zero());
  derivatives.add_wrench_block(0, 0, -rho_g_ * K, Eigen::Matrix<double, 6, 6>::Zero());
}

EnergyAccount HullForce::calc_energy(const MotionState& state) const {
  const auto body = static_cast<std::size_t>(definition_.body);
  const Buoyancy calm = calc_buoyancy(*definition_.hull, state.kinematics.X_WB[body]);
  EnergyAccount account;
  account.stored_energy = rho_g_ * calm.energy_over_rho_g;
  if (in_waves()) {
    const ForceVector from_waves = calc_force(state) - rho_g_ * calm.F_Bo_W_over_rho_g;
    account.supplied_power = dot(from_waves, state.kinematics.V_WB[body]);
  }
  return account;
}

Hydrostatics HullForce::calc_calm_hydrostatics(const MotionState& state) const {
  return calc_hydrostatics(*definition_.hull,
                           state.kinematics.X_WB[static_cast<std::size_t>(definition_.body)]);
}

}  // namespace blocklift::dynamics

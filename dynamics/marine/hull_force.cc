#include "dynamics/marine/hull_force.h"

#include "dynamics/errors.h"

namespace blocklift::dynamics {

static_assert(HullClusters::most_points <= static_cast<int>(WaveField::most_points));

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
}

namespace {

// A corner of a wetted triangle: place from Bo in W, and pressure over rho g there.
struct WetPoint {
  Vector3 r_W;
  double head;
};

// Pressure linear over the triangle: int p dA n and int r x n p dA.
void add_triangle(const WetPoint& a, const WetPoint& b, const WetPoint& c, ForceVector& F) {
  const Vector3 n = 0.5 * (b.r_W - a.r_W).cross(c.r_W - a.r_W);
  const double sum = a.head + b.head + c.head;
  F.force -= sum / 3.0 * n;
  const Vector3 arm = (a.head + sum) * a.r_W + (b.head + sum) * b.r_W + (c.head + sum) * c.r_W;
  F.moment -= (arm / 12.0).cross(n);
}

// The place on the edge from a to b where the height above the water, ha and hb, is zero.
WetPoint at_surface(const WetPoint& a, double ha, const WetPoint& b, double hb) {
  return {a.r_W + ha / (ha - hb) * (b.r_W - a.r_W), 0.0};
}

void add_wet_part(const std::array<WetPoint, 3>& p, const std::array<double, 3>& h,
                  ForceVector& F) {
  const int wet = (h[0] < 0.0 ? 1 : 0) + (h[1] < 0.0 ? 1 : 0) + (h[2] < 0.0 ? 1 : 0);
  if (wet == 0) return;
  if (wet == 3) {
    add_triangle(p[0], p[1], p[2], F);
    return;
  }
  std::size_t i = 0;
  while ((h[i] < 0.0) != (wet == 1)) ++i;
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  const WetPoint ij = at_surface(p[i], h[i], p[j], h[j]);
  const WetPoint ik = at_surface(p[i], h[i], p[k], h[k]);
  if (wet == 1) {
    add_triangle(p[i], ij, ik, F);
  } else {
    add_triangle(ij, p[j], p[k], F);
    add_triangle(ij, p[k], ik, F);
  }
}

}  // namespace

void HullForce::add_leaf(double time, const Pose& X_WB, const HullClusters::Node& leaf,
                         ForceVector& F) const {
  std::array<Vector3, HullClusters::most_points> place;
  std::array<WetPoint, HullClusters::most_points> wet;
  std::array<double, HullClusters::most_points> elevation, head, height;
  const std::span<const Vector3> points = definition_.hull->points(leaf);
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    wet[i].r_W = X_WB.R * points[i];
    place[i] = X_WB.p + wet[i].r_W;
  }
  definition_.sea->waves.calc_surface(time, {place.data(), count}, elevation, head);
  for (std::size_t i = 0; i < count; ++i) {
    height[i] = place[i].z() - elevation[i];
    wet[i].head = head[i] - place[i].z();
  }
  for (const HullClusters::Triangle& t : definition_.hull->triangles(leaf)) {
    add_wet_part({wet[t[0]], wet[t[1]], wet[t[2]]}, {height[t[0]], height[t[1]], height[t[2]]}, F);
  }
}

ForceVector HullForce::calc_force_in_waves(double time, const Pose& X_WB) const {
  const WaveField& waves = definition_.sea->waves;
  const double crest = waves.highest_elevation() * waves.ramp().factor(time);
  const Vector3 up = X_WB.R.row(2);
  const Vector3 magnitude = up.cwiseAbs();
  ForceVector F = ForceVector::zero();
  definition_.hull->visit(
      [&](const HullClusters::Node& node, int /*index*/) {
        const double lowest = X_WB.p.z() + up.dot(node.centre) - magnitude.dot(node.half_extent);
        return lowest < crest;
      },
      [&](const HullClusters::Node& leaf) { add_leaf(time, X_WB, leaf, F); });
  return rho_g_ * F;
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

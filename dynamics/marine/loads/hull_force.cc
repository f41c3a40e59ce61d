#include "dynamics/marine/loads/hull_force.h"

#include <cmath>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/wet_triangle.h"

namespace blocklift::dynamics {

static_assert(TriangleTree::most_points <= WaveField::most_points);

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
  surface_ = std::make_shared<const WaveSurface>(definition_.hull->hull(), definition_.sea->waves);
}

namespace {

using Values = std::array<double, WaveField::most_points>;
using WetPoints = WetTrianglePoints<2 * WaveSurface::faces_in_leaf>;

static_assert(WetPoints::most <= WaveField::most_points);

// Places of points of the body in the world.
void locate(const Pose& X_WB, std::span<const Vector3> points_B, double* x, double* y, double* z) {
  for (std::size_t i = 0; i < points_B.size(); ++i) {
    const Vector3 place = X_WB.apply(points_B[i]);
    x[i] = place.x();
    y[i] = place.y();
    z[i] = place.z();
  }
}

// Heave, roll and pitch about a point that lies r_W from where the force's moment is taken.
ForceVector without_water_plane_part(const ForceVector& F, const Vector3& r_W) {
  const Vector3 moment = F.moment - r_W.cross(F.force);
  return shift_to({{moment.x(), moment.y(), 0.0}, {0.0, 0.0, F.force.z()}}, r_W);
}

}  // namespace

void HullForce::add_panels(double time, const Pose& X_WB, const TriangleTree& tree,
                           const TriangleTree::Node& leaf, ForceVector& F) const {
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
    add_wet_part({&points[a], &points[b], &points[c]}, {height[a], height[b], height[c]},
                 {head[a], head[b], head[c]}, triangle.area, F);
  }
}

void HullForce::add_faces(double time, const Pose& X_WB, const TriangleTree& tree,
                          const TriangleTree::Node& leaf, ForceVector& F) const {
  const WaveField& waves = definition_.sea->waves;
  const std::span<const Vector3> points = tree.points(leaf);
  const std::size_t count = points.size();
  Values x, y, z, height, head;
  locate(X_WB, points, x.data(), y.data(), z.data());
  waves.calc_elevations(time, count, x.data(), y.data(), height.data());
  for (std::size_t i = 0; i < count; ++i) height[i] = z[i] - height[i];
  WetPoints wet;
  for (const TriangleTree::Triangle& triangle : tree.triangles(leaf)) {
    const auto [a, b, c] = triangle.corners;
    wet.add_wet_part({&points[a], &points[b], &points[c]}, {height[a], height[b], height[c]},
                     triangle.area);
  }
  const std::size_t wet_count = wet.count();
  locate(X_WB, wet.points(), x.data(), y.data(), z.data());
  waves.calc_surface(time, wet_count, x.data(), y.data(), z.data(), height.data(), head.data());
  for (std::size_t i = 0; i < wet_count; ++i) {
    const Vector3 push = (head[i] - z[i]) * wet.area(i);
    F.force -= push;
    F.moment -= wet.points()[i].cross(push);
  }
}

void HullForce::add_box(double time, const Pose& X_WB, const PressureBoxes::Box& box,
                        ForceVector& F) const {
  const std::span<const Vector3> points = box.points;
  const std::size_t count = points.size();
  Values x, y, z, elevation, head;
  locate(X_WB, points, x.data(), y.data(), z.data());
  definition_.sea->waves.calc_surface(time, count, x.data(), y.data(), z.data(), elevation.data(),
                                      head.data());
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += (head[i] - z[i]) * box.weights[i];
  F.moment += sum.head<3>();
  F.force += sum.tail<3>();
}

template <class AddLeaf>
void HullForce::add_part(double time, const Pose& X_WB, const SurfaceRange::Range& range,
                         const WaveSurface::Part& part, AddLeaf&& add_leaf, ForceVector& F) const {
  const Vector3 up = X_WB.R.row(2);
  const Vector3 magnitude = up.cwiseAbs();
  part.tree.visit(
      [&](const TriangleTree::Node& node, int index) {
        const double middle = X_WB.p.z() + up.dot(node.centre);
        const double reach = magnitude.dot(node.half_extent);
        if (middle - reach >= range.high) return false;
        const double depth = range.low - (middle + reach);
        if (depth <= 0.0) return true;
        const PressureBoxes::Box box = part.boxes.find(index, depth);
        if (box.points.empty()) return true;
        add_box(time, X_WB, box, F);
        return false;
      },
      [&](const TriangleTree::Node& leaf) { add_leaf(part.tree, leaf); });
}

ForceVector HullForce::calc_force_in_waves(double time, const Pose& X_WB) const {
  ForceVector F_B = ForceVector::zero();
  const SurfaceRange::Range range =
      surface_->range().calc_range(time, X_WB, definition_.sea->waves);
  if (surface_->panels()) {
    const auto add_leaf = [&](const TriangleTree& tree, const TriangleTree::Node& leaf) {
      add_panels(time, X_WB, tree, leaf, F_B);
    };
    add_part(time, X_WB, range, *surface_->panels(), add_leaf, F_B);
  }
  if (surface_->faces()) {
    const auto add_leaf = [&](const TriangleTree& tree, const TriangleTree::Node& leaf) {
      add_faces(time, X_WB, tree, leaf, F_B);
    };
    add_part(time, X_WB, range, *surface_->faces(), add_leaf, F_B);
  }
  ForceVector F_W{rho_g_ * (X_WB.R * F_B.moment), rho_g_ * (X_WB.R * F_B.force)};
  if (!definition_.p_BoR_B) return F_W;
  return without_water_plane_part(F_W, X_WB.R * *definition_.p_BoR_B);
}

ForceVector HullForce::calc_force(const MotionState& state) const {
  const Pose& X_WB = state.kinematics.X_WB[definition_.body];
  if (in_waves()) return calc_force_in_waves(state.time, X_WB);
  return rho_g_ * calc_buoyancy(*definition_.hull, X_WB).F_Bo_W_over_rho_g;
}

ForceVector HullForce::calc_force(const MotionState& state, const WaterPlane& plane) const {
  const Pose& X_WB = state.kinematics.X_WB[definition_.body];
  const double steepness = std::sqrt(1.0 + plane.slope.squaredNorm());
  const Vector3 normal = Vector3(-plane.slope.x(), -plane.slope.y(), 1.0) / steepness;
  // Turns the normal upright, the short way.
  const Vector3 axis = normal.cross(Vector3::UnitZ());
  const Matrix3 across = skew(axis);
  const Matrix3 R_PW = Matrix3::Identity() + across + across * across / (1.0 + normal.z());
  const Vector3 p_WP(plane.place.x(), plane.place.y(), plane.height);
  const Pose X_PB{R_PW * X_WB.R, R_PW * (X_WB.p - p_WP)};
  const ForceVector F =
      (steepness * rho_g_) * calc_buoyancy(*definition_.hull, X_PB).F_Bo_W_over_rho_g;
  ForceVector F_W{R_PW.transpose() * F.moment, R_PW.transpose() * F.force};
  if (!definition_.p_BoR_B) return F_W;
  return without_water_plane_part(F_W, X_WB.R * *definition_.p_BoR_B);
}

void HullForce::add_forces(const MotionState& state, Loads& loads) const {
  loads.F_Bo_W[definition_.body] += calc_force(state);
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

double HullForce::calc_stored_energy(const MotionState& state) const {
  const Pose& X_WB = state.kinematics.X_WB[definition_.body];
  return rho_g_ * calc_buoyancy(*definition_.hull, X_WB).energy_over_rho_g;
}

Hydrostatics HullForce::calc_calm_hydrostatics(const MotionState& state) const {
  return calc_hydrostatics(*definition_.hull, state.kinematics.X_WB[definition_.body]);
}

}  // namespace blocklift::dynamics

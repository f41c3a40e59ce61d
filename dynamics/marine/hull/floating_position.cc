#include "dynamics/marine/hull/floating_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "algebra/decompositions.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

constexpr int most_iterations = 300;
constexpr double largest_turn = 0.2;  // rad a step

void require_floats(const HullClusters& hull, const FloatingBody& body) {
  const auto require_positive = [&](const char* what, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    throw ModelError("hull \"" + hull.hull().name() + "\" floats with the " + what + " " +
                     std::to_string(value) + "; a number above zero is due");
  };
  require_positive("mass", body.mass);
  require_positive("water density", body.water_density);
  if (!body.p_BoBcm_B.allFinite()) {
    throw ModelError("hull \"" + hull.hull().name() + "\" floats without a centre of mass");
  }
}

/// What displaces next to nothing lies on the water: rounding decides how, and there is no hull
/// left to be meshed.
void require_immersed(const HullClusters& hull, const FloatingBody& body) {
  constexpr double least = 1e-5;
  const double volume = body.mass / body.water_density, whole = hull.enclosed().volume;
  if (volume > least * whole) return;
  std::ostringstream text;
  text << "hull \"" << hull.hull().name() << "\" of " << body.mass << " kg displaces " << volume
       << " m3 of the " << whole
       << " m3 that it encloses, and lies on the water rather than in it: "
       << "is its mass in tonnes (t)?";
  throw ModelError(text.str());
}

double size_of(const HullClusters& hull) { return std::cbrt(hull.enclosed().volume); }

}  // namespace

double find_floating_height(const HullClusters& hull, const Matrix3& R_WB, double volume) {
  const double whole = hull.enclosed().volume;
  if (!(volume > 0.0) || !(volume < whole)) {
    std::ostringstream text;
    text << "hull \"" << hull.hull().name() << "\" would have to displace " << volume
         << " m3; it encloses " << whole
         << " m3, so a volume between zero and that is due: lighten the body or deepen the hull";
    throw ModelError(text.str());
  }
  const TriangleTree::Node& box = hull.faces().node(TriangleTree::root);
  const Vector3 up = R_WB.row(2);
  const double reach = up.cwiseAbs().dot(box.half_extent);
  double low = -up.dot(box.centre) - reach;   // all under water
  double high = -up.dot(box.centre) + reach;  // all above
  double height = 0.5 * (low + high);
  // Newton's method, by halves where it would leave the bracket.
  for (int i = 0; i < most_iterations; ++i) {
    const Hydrostatics h = calc_hydrostatics(hull, {R_WB, {0.0, 0.0, height}});
    const double excess = h.volume - volume;
    (excess > 0.0 ? low : high) = height;
    if (std::abs(excess) < 1e-14 * whole || high - low < 1e-15 * reach) return height;
    const double newton = height + excess / h.water_plane_area;
    height = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return height;
}

namespace {

// A body afloat at one attitude, its height being that of vertical equilibrium.
struct Balance {
  Pose X_WB;
  Hydrostatics hydrostatics;
  double energy;              // over rho g, m4
  Eigen::Vector2d moment;     // about W's x and y, over rho g, m4
  Eigen::Matrix2d stiffness;  // against turning about x and y, the height following, m4
};

Balance balance(const HullClusters& hull, const FloatingBody& body, const Matrix3& R_WB) {
  const double volume = body.mass / body.water_density;
  Balance b;
  b.X_WB = {R_WB, {0.0, 0.0, find_floating_height(hull, R_WB, volume)}};
  b.hydrostatics = calc_hydrostatics(hull, b.X_WB);
  const Vector3 g = R_WB * body.p_BoBcm_B;
  b.energy = b.hydrostatics.energy_over_rho_g + volume * (b.X_WB.p.z() + g.z());
  const Vector3 buoyancy = b.hydrostatics.force_over_rho_g().moment;
  b.moment = {buoyancy.x() - volume * g.y(), buoyancy.y() + volume * g.x()};
  const Eigen::Matrix<double, 6, 6> K = calc_stiffness_over_rho_g(b.hydrostatics);
  const Eigen::Vector2d coupling(K(0, 5), K(1, 5));
  b.stiffness = K.topLeftCorner<2, 2>() - volume * g.z() * Eigen::Matrix2d::Identity();
  if (K(5, 5) > 0.0) b.stiffness -= coupling * coupling.transpose() / K(5, 5);
  return b;
}

Matrix3 turned(const Matrix3& R_WB, const Eigen::Vector2d& turn) {
  const double angle = turn.norm();
  if (angle == 0.0) return R_WB;
  return rotation_about(Vector3(turn.x(), turn.y(), 0.0) / angle, angle) * R_WB;
}

// Newton's step with the magnitudes of the eigenvalues, about both level axes or about y alone. At
// an unstable balance it leaves along the least stable axis.
Eigen::Vector2d calc_turn(const Balance& b, bool about_x, double least_stiffness) {
  if (!about_x) {
    const double k = std::max(std::abs(b.stiffness(1, 1)), least_stiffness);
    return {0.0, std::clamp(b.moment.y() / k, -largest_turn, largest_turn)};
  }
  const auto eigen = algebra::symmetric_eigensystem(b.stiffness);
  Eigen::Vector2d turn = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::Vector2d axis = eigen.vectors.col(i);
    turn += axis * axis.dot(b.moment) / std::max(std::abs(eigen.values[i]), least_stiffness);
  }
  return turn * std::min(1.0, largest_turn / std::max(turn.norm(), 1e-300));
}

// Lets the body turn until no moment acts.
Balance settle(const HullClusters& hull, const FloatingBody& body, Balance b, bool about_x) {
  const double volume = body.mass / body.water_density;
  const double scale = volume * size_of(hull);
  const double small_moment = 1e-12 * scale;
  const auto size_of_moment = [about_x](const Balance& at) {
    return about_x ? at.moment.norm() : std::abs(at.moment.y());
  };
  for (int i = 0; i < most_iterations; ++i) {
    const double moment = size_of_moment(b);
    const auto axes = algebra::symmetric_eigensystem(b.stiffness);
    const bool unstable = (about_x ? axes.values[0] : b.stiffness(1, 1)) < -1e-9 * scale;
    if (moment < small_moment && !unstable) return b;
    Eigen::Vector2d turn = calc_turn(b, about_x, 1e-4 * scale);
    if (moment < small_moment) {
      turn = 0.05 * (about_x ? Eigen::Vector2d(axes.vectors.col(0)) : Eigen::Vector2d(0.0, 1.0));
    }
    Balance next = balance(hull, body, turned(b.X_WB.R, turn));
    for (int halving = 0; halving < 40 && next.energy > b.energy; ++halving) {
      // Below the rounding of the energy the moment decides.
      if (next.energy - b.energy < 1e-13 * scale && size_of_moment(next) < moment) {
        break;
      }
      turn *= 0.5;
      next = balance(hull, body, turned(b.X_WB.R, turn));
    }
    if (next.energy > b.energy && moment < 1e-8 * scale && size_of_moment(next) >= moment) {
      return b;  // rounding
    }
    b = next;
  }
  throw SimulationError("hull \"" + hull.hull().name() + "\": no floating equilibrium found in " +
                        std::to_string(most_iterations) + " steps; the moment left is " +
                        std::to_string(size_of_moment(b) / volume) + " m times the weight");
}

}  // namespace

FloatingPosition find_floating_position(const HullClusters& hull, const FloatingBody& body,
                                        const Matrix3& R_WB) {
  require_floats(hull, body);
  require_immersed(hull, body);
  const Balance b = settle(hull, body, balance(hull, body, R_WB), true);
  const double least = algebra::symmetric_eigenvalues(b.stiffness)[0];
  return {b.X_WB, b.hydrostatics, least * body.water_density / body.mass};
}

std::vector<RightingArm> calc_righting_arms(const HullClusters& hull, const FloatingBody& body,
                                            const std::vector<double>& heels) {
  require_floats(hull, body);
  const double volume = body.mass / body.water_density;
  std::vector<RightingArm> arms;
  double trim = 0.0;
  for (const double heel : heels) {
    const Matrix3 start =
        rotation_about(Vector3::UnitY(), trim) * rotation_about(Vector3::UnitX(), heel);
    const Balance b = settle(hull, body, balance(hull, body, start), false);
    // B's x axis is (cos theta, 0, -sin theta) in W, whatever the heel.
    trim = std::atan2(-b.X_WB.R(2, 0), b.X_WB.R(0, 0));
    arms.push_back({heel, trim, b.X_WB.p.z(), -b.moment.x() / volume});
  }
  return arms;
}

}  // namespace blocklift::dynamics

#include "dynamics/simulation/mode_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "algebra/decompositions.h"

namespace blocklift::dynamics {

namespace {

using Complex3 = Eigen::Vector3cd;

// Kinetic energies of a body at unit frequency, times two: level, upright, about x, y, z of W.
struct BodyEnergies {
  double level = 0.0, upright = 0.0, roll_and_pitch = 0.0, yaw = 0.0;
  double sum() const { return level + upright + roll_and_pitch + yaw; }
};

Matrix3 inertia_W(const Mechanism& mechanism, const Kinematics& kinematics, std::size_t b) {
  return rotate(kinematics.X_WB[b].R, mechanism.bodies()[b].inertia.I_BBcm).matrix();
}

BodyEnergies energies(const BodyModeMotion& motion, double mass, const Matrix3& I_W) {
  const auto size = [](const std::complex<double>& c) { return std::norm(c); };
  const Complex3 momentum = I_W * motion.rotation;
  const auto about = [&](Eigen::Index i) {
    return (std::conj(motion.rotation[i]) * momentum[i]).real();
  };
  return {mass * (size(motion.displacement_centre.x()) + size(motion.displacement_centre.y())),
          mass * size(motion.displacement_centre.z()), about(0) + about(1), about(2)};
}

// Direction of the largest part of a complex motion in the level plane, as an angle from x (rad),
// and how round the path is: 0 a line, 1 a circle.
struct LevelDirection {
  double angle;
  double roundness;
};

LevelDirection level_direction(const Complex3& motion) {
  Eigen::Matrix2d form;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) form(i, j) = (motion[i] * std::conj(motion[j])).real();
  }
  const auto [sizes, axes] = algebra::symmetric_eigensystem(form);
  const Eigen::Vector2d axis = axes.col(1);
  const double small = std::max(0.0, sizes[0]);
  return {std::atan2(axis.y(), axis.x()), std::sqrt(small / sizes[1])};
}

// "x", "y" or "an axis 35 deg from x towards y".
std::string level_axis(double angle) {
  constexpr double degrees = 180.0 / M_PI;
  double from_x = angle * degrees;
  while (from_x > 90.0) from_x -= 180.0;
  while (from_x <= -90.0) from_x += 180.0;
  if (std::abs(from_x) < 15.0) return "x";
  if (std::abs(from_x) > 75.0) return "y";
  return std::to_string(std::lround(std::abs(from_x))) + " deg from x towards " +
         (from_x > 0.0 ? "y" : "-y");
}

enum class Motion { level, upright, tilt, yaw };

// The kind of motion with most energy first; behind it, in the order of the kinds, those with as
// much but for a little.
std::vector<Motion> main_motions(const BodyEnergies& e) {
  constexpr double nearly = 0.95;  // 49 to 51 % is 0.96
  const std::array<double, 4> parts = {e.level, e.upright, e.roll_and_pitch, e.yaw};
  const auto most = std::max_element(parts.begin(), parts.end());
  std::vector<Motion> motions = {static_cast<Motion>(most - parts.begin())};
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    if (part != most && *part > nearly * *most)
      motions.push_back(static_cast<Motion>(part - parts.begin()));
  }
  return motions;
}

// What a level motion is called by what brings it back: ropes, weight, or nothing.
std::string level_word(const Mode& mode) {
  if (mode.kind == ModeKind::neutral) return "drift";
  return mode.elastic_share < 0.5 ? "pendulum" : "sway";
}

std::string motion_in_words(Motion motion, const BodyModeMotion& body, const Mode& mode) {
  switch (motion) {
    case Motion::level: {
      const std::string word = level_word(mode);
      const LevelDirection direction = level_direction(body.displacement_centre);
      return direction.roundness > 0.5 ? word + " in circles"
                                       : word + " along " + level_axis(direction.angle);
    }
    case Motion::upright:
      return "bounce";
    case Motion::yaw:
      return "yaw";
    case Motion::tilt: {
      const std::string axis = level_axis(level_direction(body.rotation).angle);
      return (axis == "x" ? "roll" : axis == "y" ? "pitch" : "rocking") + (" about " + axis);
    }
  }
  return {};
}

// All of several, in the order of the kinds, so that the name does not hang on which has most.
std::string motions_in_words(std::vector<Motion> motions, const BodyModeMotion& body,
                             const Mode& mode) {
  std::sort(motions.begin(), motions.end());
  std::string words;
  for (const Motion motion : motions)
    words += (words.empty() ? "" : " and ") + motion_in_words(motion, body, mode);
  return words;
}

// The elastic mode of a body that has most of the energy, where vibration is most of the body's
// motion; else null.
const ElasticModeMotion* main_vibration(const Mechanism& mechanism, const Mode& mode,
                                        const BodyModeMotion& body) {
  const ElasticModeMotion* most = nullptr;
  double sum = 0.0;
  for (const ElasticModeMotion& motion : mode.elastic_modes) {
    if (mechanism.elastic_modes()[motion.mode].body != body.body) continue;
    sum += motion.energy_share;
    if (!most || motion.energy_share > most->energy_share) most = &motion;
  }
  return sum > 0.5 * body.energy_share ? most : nullptr;
}

// The motion of a body that tells with or against which way it goes.
Complex3 telling(Motion motion, const BodyModeMotion& body) {
  const bool turns = motion == Motion::tilt || motion == Motion::yaw;
  return turns ? body.rotation : body.displacement_centre;
}

std::string listed(const Mechanism& mechanism, const std::vector<const BodyModeMotion*>& bodies,
                   std::size_t count) {
  const auto name = [&](std::size_t i) { return mechanism.body(bodies[i]->body).name; };
  if (count == 1) return name(0);
  if (count == 2) return name(0) + " and " + name(1);
  return name(0) + ", " + name(1) + " and " + std::to_string(count - 2) +
         (count == 3 ? " other" : " others");
}

}  // namespace

void find_body_motions(const Mechanism& mechanism, const Kinematics& kinematics, Mode& mode) {
  mode.bodies.clear();
  mode.elastic_modes.clear();
  Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(6, mechanism.nv());
  double total = 0.0;
  double largest = 0.0;
  std::complex<double> there = 1.0;
  // The first of equals, so that the choice does not hang on rounding.
  const auto take = [&](const std::complex<double>& amplitude) {
    if (std::abs(amplitude) <= largest * (1.0 + 1e-9)) return;
    largest = std::abs(amplitude);
    there = amplitude;
  };
  for (BodyIndex i = 1; i < mechanism.body_count(); ++i) {
    const auto b = static_cast<std::size_t>(i);
    const RigidBodyInertia& inertia = mechanism.bodies()[b].inertia;
    if (inertia.mass == 0.0) continue;
    body_jacobian(mechanism, kinematics, i, jacobian);
    const Eigen::Matrix<std::complex<double>, 6, 1> motion = jacobian * mode.shape;
    BodyModeMotion body{i, motion.head<3>(), motion.tail<3>(), {}, 0.0};
    const Vector3 c = kinematics.X_WB[b].R * inertia.p_BoBcm;
    body.displacement_centre = body.displacement - skew(c) * body.rotation;
    const Matrix3 I_W = inertia_W(mechanism, kinematics, b);
    body.energy_share = energies(body, inertia.mass, I_W).sum();
    total += body.energy_share;
    const double gyration = std::sqrt(I_W.trace() / (3.0 * inertia.mass));
    for (Eigen::Index k = 0; k < 3; ++k) {
      take(body.displacement_centre[k]);
      take(gyration * body.rotation[k]);
    }
    mode.bodies.push_back(body);
  }
  for (std::size_t i = 0; i < mechanism.elastic_modes().size(); ++i) {
    const ElasticMode& elastic = mechanism.elastic_modes()[i];
    const std::complex<double> amplitude = mode.shape[elastic.v_index];
    const double energy = elastic.modal_mass * std::norm(amplitude);
    total += energy;
    take(amplitude);
    mode.elastic_modes.push_back({static_cast<int>(i), amplitude, energy});
    for (BodyModeMotion& body : mode.bodies) {
      if (body.body == elastic.body) body.energy_share += energy;
    }
  }
  if (!(total > 0.0) || !(largest > 0.0)) return;
  mode.shape /= there;
  for (BodyModeMotion& body : mode.bodies) {
    body.rotation /= there;
    body.displacement /= there;
    body.displacement_centre /= there;
    body.energy_share /= total;
  }
  for (ElasticModeMotion& motion : mode.elastic_modes) {
    motion.amplitude /= there;
    motion.energy_share /= total;
  }
}

std::string mode_name(const Mechanism& mechanism, const Kinematics& kinematics, const Mode& mode) {
  std::vector<const BodyModeMotion*> order;
  for (const BodyModeMotion& body : mode.bodies) order.push_back(&body);
  // Equal shares stay in the order of the mechanism, whatever the rounding.
  const auto rounded = [](const BodyModeMotion* body) {
    return std::lround(1e6 * body->energy_share);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const auto* a, const auto* b) { return rounded(a) > rounded(b); });
  if (order.empty() || !(order.front()->energy_share > 0.0)) return "no body";
  std::size_t count = 0;
  for (double share = 0.0; share < 0.6 && count < order.size(); ++count) {
    share += order[count]->energy_share;
  }
  const BodyModeMotion& first = *order.front();
  const auto b = static_cast<std::size_t>(first.body);
  const std::string bodies = listed(mechanism, order, count) + ": ";
  if (const ElasticModeMotion* vibration = main_vibration(mechanism, mode, first))
    return bodies + "vibration in " + mechanism.elastic_modes()[vibration->mode].name;
  const std::vector<Motion> motions = main_motions(
      energies(first, mechanism.bodies()[b].inertia.mass, inertia_W(mechanism, kinematics, b)));
  const Motion motion = motions.front();
  std::string name = bodies + motions_in_words(motions, first, mode);
  for (std::size_t i = count; i < order.size() && order[i]->energy_share >= 0.05; ++i) {
    const double phase = telling(motion, first).dot(telling(motion, *order[i])).real();
    if (phase >= 0.0) continue;
    name += " against " + mechanism.body(order[i]->body).name;
    break;
  }
  return name;
}

}  // namespace blocklift::dynamics

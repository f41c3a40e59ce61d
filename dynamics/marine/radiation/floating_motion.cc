#include "dynamics/marine/radiation/floating_motion.h"

#include <cmath>
#include <numbers>

#include "algebra/factors.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Complex excitation per unit amplitude for a wave that the database holds.
Eigen::VectorXcd find_excitation(const HydrodynamicDatabase& database, const RegularWave& wave) {
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    if (std::abs(database.frequencies[k] - wave.frequency) > 1e-9 * wave.frequency) continue;
    for (std::size_t h = 0; h < database.headings.size(); ++h) {
      if (std::abs(database.headings[h] - wave.heading) > 1e-9) continue;
      return database.excitation(k).col(h);
    }
  }
  throw ModelError("the database does not hold the wave of " + std::to_string(wave.frequency) +
                   " rad/s and heading " + std::to_string(wave.heading) + " rad");
}

double ramp(const RegularWave& wave, double time) {
  const double fraction = time * wave.frequency / (4.0 * std::numbers::pi);
  return fraction >= 1.0 ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * fraction));
}

}  // namespace

FloatingMotion march_directly(const LinearFloatation& bodies, DirectRadiation& water, double step,
                              double duration) {
  const algebra::SymmetricFactors mass(bodies.mass + water.infinite_added_mass());
  FloatingMotion motion{step, {bodies.start}};
  VectorXd x = bodies.start, v = VectorXd::Zero(x.size());
  water.start(step);
  const auto steps = static_cast<long>(std::ceil(duration / step));
  for (long k = 0; k < steps; ++k) {
    const VectorXd a = mass.solve(water.calc_force() - bodies.stiffness * x);
    v += (k == 0 ? 0.5 : 1.0) * step * a;
    water.advance(v);
    x += step * v;
    motion.position.push_back(x);
  }
  return motion;
}

FloatingMotion march_with_database(const LinearFloatation& bodies,
                                   const HydrodynamicDatabase& database, double step,
                                   double duration, const std::optional<RegularWave>& wave) {
  const algebra::SymmetricFactors mass(bodies.mass + database.infinite_added_mass);
  MemoryConvolution memory(database);
  Eigen::VectorXcd excitation;
  if (wave) excitation = wave->amplitude * find_excitation(database, *wave);
  VectorXd force(bodies.start.size());
  const auto acceleration = [&](double t, const VectorXd& x, const VectorXd& v) -> VectorXd {
    memory.calc_force(t, v, force);
    if (wave) {
      force += ramp(*wave, t) * (std::polar(1.0, wave->frequency * t) * excitation).real();
    }
    return mass.solve(force - bodies.stiffness * x);
  };
  FloatingMotion motion{step, {bodies.start}};
  VectorXd x = bodies.start, v = VectorXd::Zero(x.size());
  memory.start(0.0, v, v);
  VectorXd a = acceleration(0.0, x, v);
  memory.start(0.0, v, a);
  const auto steps = static_cast<long>(std::ceil(duration / step));
  for (long k = 0; k < steps; ++k) {
    const double t = static_cast<double>(k) * step, h = step;
    const VectorXd v2 = v + 0.5 * h * a;
    const VectorXd a2 = acceleration(t + 0.5 * h, x + 0.5 * h * v, v2);
    const VectorXd v3 = v + 0.5 * h * a2;
    const VectorXd a3 = acceleration(t + 0.5 * h, x + 0.5 * h * v2, v3);
    const VectorXd v4 = v + h * a3;
    const VectorXd a4 = acceleration(t + h, x + h * v3, v4);
    x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a + 2.0 * a2 + 2.0 * a3 + a4);
    a = acceleration(t + h, x, v);
    memory.record(t + h, v, a);
    motion.position.push_back(x);
  }
  return motion;
}

FloatingMotion march_with_state_space(const LinearFloatation& bodies,
                                      const MatrixXd& infinite_added_mass,
                                      const MemoryStateSpace& memory, double step,
                                      double duration) {
  const algebra::SymmetricFactors mass(bodies.mass + infinite_added_mass);
  const Eigen::Index modes = bodies.start.size(), states = memory.state_count();
  // One vector: positions, velocities, states of the memory.
  VectorXd force(modes), rate(states);
  const auto derivative = [&](const VectorXd& y) -> VectorXd {
    memory.calc_force(y.tail(states), force);
    memory.calc_rate(y.tail(states), y.segment(modes, modes), rate);
    VectorXd result(2 * modes + states);
    result << y.segment(modes, modes), mass.solve(force - bodies.stiffness * y.head(modes)), rate;
    return result;
  };
  VectorXd y = VectorXd::Zero(2 * modes + states);
  y.head(modes) = bodies.start;
  FloatingMotion motion{step, {bodies.start}};
  const auto steps = static_cast<long>(std::ceil(duration / step));
  for (long k = 0; k < steps; ++k) {
    const VectorXd first = derivative(y);
    const VectorXd second = derivative(y + 0.5 * step * first);
    const VectorXd third = derivative(y + 0.5 * step * second);
    const VectorXd fourth = derivative(y + step * third);
    y += step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth);
    motion.position.emplace_back(y.head(modes));
  }
  return motion;
}

std::vector<Extremum> find_extrema(const FloatingMotion& motion, int mode) {
  std::vector<Extremum> extrema;
  for (std::size_t k = 1; k + 1 < motion.position.size(); ++k) {
    const double before = motion.position[k - 1][mode], here = motion.position[k][mode],
                 after = motion.position[k + 1][mode];
    if ((here - before) * (after - here) > 0.0 || here == before) continue;
    const double curvature = before - 2.0 * here + after;
    const double shift = 0.5 * (before - after) / curvature;
    extrema.push_back(
        {motion.step * (static_cast<double>(k) + shift), here - 0.25 * (before - after) * shift});
  }
  return extrema;
}

}  // namespace blocklift::dynamics

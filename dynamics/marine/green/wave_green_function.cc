#include "dynamics/marine/green/wave_green_function.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/algebra/gauss_legendre.h"
#include "dynamics/errors.h"
#include "dynamics/instruction_sets.h"
#include "dynamics/marine/green/deep_water_integral.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;

constexpr double nothing = 40.0;  ///< exp(-40) is below the last digit

/// The integrands of the tables over m, without J0(m R).
struct Integrand {
  double K, h;
  bool infinite;

  /// (m + K)/(m - K) times (m - K), and m - K.
  double above(double m) const { return infinite ? -1.0 : m + K; }
  double below(double m) const { return infinite ? 1.0 : m - K; }

  /// That of L(R, v).
  double whole(double m, double v) const {
    const double q = above(m);
    return q * (std::exp(-m * (2.0 * h - v)) + std::exp(-m * (2.0 * h + v))) /
           (below(m) - q * std::exp(-2.0 * m * h));
  }
  /// That of deep water, at s = 2 h - v.
  double deep(double m, double s) const { return above(m) / below(m) * std::exp(-m * s); }
  /// The first less the second, without their difference.
  double remainder(double m, double s) const {
    const double q = above(m);
    return q / below(m) *
           (std::exp(-m * (4.0 * h - s)) +
            q * (std::exp(-m * (2.0 * h + s)) + std::exp(-m * (6.0 * h - s))) /
                (below(m) - q * std::exp(-2.0 * m * h)));
  }
};

/// Sum over the nodes of a quadrature in m, at all places at once.
class Quadrature {
 public:
  Quadrature(std::vector<double> distances, std::vector<double> heights, double depth)
      : distances_(std::move(distances)),
        heights_(std::move(heights)),
        depth_(depth),
        sum_(MatrixXd::Zero(distances_.size(), heights_.size())) {}

  /// Adds sign times the integral from one m to another of f(m, height) J0(m R). A pole in the
  /// middle is taken as its principal value.
  template <class Function>
  void add(double from, double to, double sign, const Function& f) {
    if (!(to > from)) return;
    // A polynomial of m has to follow J0 over the farthest place, and what changes with m h.
    const double phase = 0.5 * (to - from) * (distances_.back() + 2.0 * depth_);
    const int order = 2 * static_cast<int>(std::ceil(0.5 * phase + 20.0));
    const QuadratureRule rule = make_gauss_legendre(order);
    MatrixXd waves(distances_.size(), order), weights(order, heights_.size());
    for (int i = 0; i < order; ++i) {
      const double half = 0.5 * (to - from);
      const double m = from + half * (1.0 + rule.points[i]);
      for (Eigen::Index j = 0; j < waves.rows(); ++j) waves(j, i) = ::j0(m * distances_[j]);
      for (Eigen::Index j = 0; j < weights.cols(); ++j) {
        weights(i, j) = sign * half * rule.weights[i] * f(m, heights_[j]);
      }
    }
    sum_.noalias() += waves * weights;
  }
  const MatrixXd& sum() const { return sum_; }

 private:
  std::vector<double> distances_, heights_;
  double depth_;
  MatrixXd sum_;
};

}  // namespace

WaveGreenFunction::WaveGreenFunction(const Water& water, double frequency, double reach,
                                     double deepest)
    : depth_(water.depth), deep_(std::isinf(water.depth)), infinite_(std::isinf(frequency)) {
  if (!(frequency > 0.0) || !(reach > 0.0) || !(deepest > 0.0) || deepest > depth_) {
    throw ModelError("a source in water " + std::to_string(depth_) + " m deep cannot be " +
                     std::to_string(deepest) + " m below the surface, make waves of " +
                     std::to_string(frequency) + " rad/s and be felt " + std::to_string(reach) +
                     " m away");
  }
  if (!infinite_) {
    K_ = frequency * frequency / water.gravity;
    k_ = calc_wave_number(frequency, water);
    const double slope =
        deep_ ? 0.0 : k_ * k_ / std::pow(std::cosh(std::min(k_ * depth_, 300.0)), 2);
    strength_ = 2.0 * std::numbers::pi * k_ * k_ / (K_ + (deep_ ? 0.0 : slope * depth_));
    const double longest = 1.01 * std::max(k_ * reach, 1.0);
    J0_ = PatchedCurve({0.0, longest, static_cast<int>(std::ceil(longest))},
                       [](double x) { return ::j0(x); });
    constexpr double first = 4.0;  // beyond DeepWaterIntegral::near with waves X is at least 6
    const double last = std::max(longest, first + 1.0);
    Y0_ = PatchedCurve({first, last, static_cast<int>(std::ceil(last - first))},
                       [](double x) { return ::y0(x); });
  }
  if (!deep_) make_tables(reach, deepest);
}

// Both integrands have a pole at k, that of deep water one at K; both are taken in the middle of an
// interval. Where k is so large that nothing is left of either function there, neither is met.
void WaveGreenFunction::make_tables(double reach, double deepest) {
  const double h = depth_;
  const Integrand f{K_, h, infinite_};
  // Waves of these numbers are in the tables, and what falls off with the depth.
  const double patch = std::min(0.5 * h, infinite_ || k_ * h > nothing ? h : 1.0 / k_);
  const auto divide = [&](double length) {
    return Patches{0.0, length, std::max(1, static_cast<int>(std::ceil(length / patch)))};
  };
  const Patches distances = divide(reach), sums = divide(2.0 * deepest),
                differences = divide(deepest);

  Quadrature second(distances.points(), differences.points(), h);
  const double end = nothing / (2.0 * h - deepest);
  const auto whole = [&](double m, double v) { return f.whole(m, v); };
  if (infinite_ || k_ > end) {
    second.add(0.0, end, 1.0, whole);
  } else {
    second.add(0.0, 2.0 * k_, 1.0, whole);
    second.add(2.0 * k_, end, 1.0, whole);
  }
  difference_ = {distances, differences, second.sum()};

  Quadrature first(distances.points(), sums.points(), h);
  const double rest_end = nothing / (2.0 * h);
  const auto remainder = [&](double m, double s) { return f.remainder(m, s); };
  if (infinite_ || k_ > rest_end) {
    first.add(0.0, rest_end, 1.0, remainder);
  } else {
    const auto deep = [&](double m, double s) { return f.deep(m, s); };
    first.add(0.0, 2.0 * k_, 1.0, [&](double m, double s) { return f.whole(m, 2.0 * h - s); });
    first.add(0.0, 2.0 * K_, -1.0, deep);
    first.add(2.0 * K_, 2.0 * k_, -1.0, deep);
    first.add(2.0 * k_, rest_end, 1.0, remainder);
  }
  remainder_ = {distances, sums, first.sum()};
}

WaveGreenFunction::Level WaveGreenFunction::level(double z) const {
  Level level{z};
  if (infinite_) return level;
  level.decay = std::exp(K_ * z);
  const double down = deep_ ? 0.0 : std::exp(-2.0 * k_ * (z + depth_));
  const double scale = std::exp(k_ * z) / (1.0 + (deep_ ? 0.0 : std::exp(-2.0 * k_ * depth_)));
  level.profile = scale * (1.0 + down);
  level.slope = k_ * scale * (1.0 - down);
  return level;
}

namespace {

struct Tables {
  double K, k, strength;
  bool deep, infinite;
  const PatchedCurve &J0, &Y0;
  const PatchedSurface &remainder, &difference;
};

[[gnu::always_inline]] inline WaveGreenFunction::Value evaluate(
    const Tables& t, const DeepWaterIntegral& integral, double R,
    const WaveGreenFunction::Level& field, const WaveGreenFunction::Level& source) {
  constexpr double pi = std::numbers::pi;
  const double s = -(field.z + source.z);
  double g = 0.0, along_R = 0.0, along_s = 0.0, along_d = 0.0;
  double wave = 0.0, wave_slope = 0.0;
  if (!t.infinite) {
    const double K = t.K, X = K * R, Y = K * s, decay = field.decay * source.decay;
    const double rho = std::max(std::sqrt(X * X + Y * Y), 1e-12);
    const std::array<double, 2> J = t.J0.at(X);
    double I = 0.0, I_X = 0.0;
    if (rho < DeepWaterIntegral::near) {
      const DeepWaterIntegral::Value value = integral.at_near(X, Y, rho, decay, J[0], -J[1]);
      I = value.value;
      I_X = value.along_X;
    } else {
      const DeepWaterIntegral::Value value = integral.at_far(X, Y, rho);
      I = -value.value;
      I_X = -value.along_X;
      if (Y < DeepWaterIntegral::no_waves) {
        const std::array<double, 2> Y0 = t.Y0.at(X);
        I -= pi * decay * Y0[0];
        I_X -= pi * decay * Y0[1];
      }
    }
    g = 2.0 * K * I;
    along_R = 2.0 * K * K * I_X;
    along_s = -2.0 * K * K * I;
    const std::array<double, 2> waves = t.deep ? J : t.J0.at(t.k * R);
    wave = -t.strength * waves[0];
    wave_slope = -t.strength * t.k * waves[1];
  }
  if (!t.deep) {
    const double d = field.z - source.z;
    const PatchedSurface::Value first = t.remainder.at(R, s);
    const PatchedSurface::Value second = t.difference.at(R, std::abs(d));
    g += first.value + second.value;
    along_R += first.along_x + second.along_x;
    along_s += first.along_y;
    along_d = d < 0.0 ? -second.along_y : second.along_y;
  }
  const double profiles = field.profile * source.profile;
  return {{g, wave * profiles},
          {along_R, wave_slope * profiles},
          {-along_s + along_d, wave * field.slope * source.profile},
          {-along_s - along_d, wave * field.profile * source.slope}};
}

BLOCKLIFT_CLONES
void evaluate_all(const Tables& tables, const DeepWaterIntegral& integral, std::size_t count,
                  const double* distances, const WaveGreenFunction::Level* fields,
                  const WaveGreenFunction::Level& source, WaveGreenFunction::Value* values) {
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = evaluate(tables, integral, distances[i], fields[i], source);
  }
}

}  // namespace

void WaveGreenFunction::at(std::span<const double> distances, std::span<const Level> fields,
                           const Level& source, std::span<Value> values) const {
  const Tables tables{K_, k_, strength_, deep_, infinite_, J0_, Y0_, remainder_, difference_};
  evaluate_all(tables, DeepWaterIntegral::tables(), distances.size(), distances.data(),
               fields.data(), source, values.data());
}

WaveGreenFunction::Value WaveGreenFunction::at(double R, const Level& field,
                                               const Level& source) const {
  Value value{};
  at({&R, 1}, {&field, 1}, source, {&value, 1});
  return value;
}

}  // namespace blocklift::dynamics

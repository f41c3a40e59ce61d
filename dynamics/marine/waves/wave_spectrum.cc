#include "dynamics/marine/waves/wave_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dynamics/algebra/gauss_legendre.h"
#include "dynamics/errors.h"
#include "dynamics/force/random_source.h"

namespace blocklift::dynamics {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

void require_positive_and_finite(const char* what, double value) {
  if (std::isfinite(value) && value > 0.0) return;
  throw ModelError("a wave spectrum has the " + std::string(what) + " " + std::to_string(value) +
                   "; a number above zero is due");
}

// int f d omega over [low, high], substituting ln omega.
template <class Function>
double integrate(double low, double high, int pieces, Function&& f) {
  static const QuadratureRule rule = make_gauss_legendre(8);
  if (!(high > low)) return 0.0;
  const double from = std::log(low);
  const double half = 0.5 * (std::log(high) - from) / pieces;
  double sum = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = from + (2 * piece + 1) * half;
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const double omega = std::exp(middle + half * rule.points[i]);
      sum += rule.weights[i] * half * omega * f(omega);
    }
  }
  return sum;
}

// Below 0.2 of the peak exp(-1.25 / 0.2^4) is 1e-340; beyond 1e4 peaks the second moment's tail is
// 1e-8 of the whole.
std::vector<double> nodes_about(double peak) {
  return {0.2 * peak, 0.7 * peak, peak, 1.5 * peak, 10.0 * peak, 1e4 * peak};
}

}  // namespace

WaveSpectrum::WaveSpectrum(std::function<double(double)> density, std::vector<double> nodes)
    : density_(std::move(density)), nodes_(std::move(nodes)) {}

WaveSpectrum WaveSpectrum::pierson_moskowitz(double significant_height, double peak_period) {
  return jonswap(significant_height, peak_period, 1.0);
}

WaveSpectrum WaveSpectrum::issc(double significant_height, double mean_period) {
  require_positive_and_finite("mean period", mean_period);
  const double B = std::pow(two_pi / (mean_period * std::tgamma(0.75)), 4);
  return pierson_moskowitz(significant_height, two_pi / std::pow(0.8 * B, 0.25));
}

WaveSpectrum WaveSpectrum::fully_developed(double significant_height, double gravity) {
  require_positive_and_finite("significant height", significant_height);
  require_positive_and_finite("gravity", gravity);
  const double B = 4.0 * 0.0081 * gravity * gravity / (significant_height * significant_height);
  return pierson_moskowitz(significant_height, two_pi / std::pow(0.8 * B, 0.25));
}

WaveSpectrum WaveSpectrum::jonswap(double significant_height, double peak_period, double gamma) {
  require_positive_and_finite("significant height", significant_height);
  require_positive_and_finite("peak period", peak_period);
  if (!(gamma >= 1.0 && gamma <= 20.0)) {
    throw ModelError("a JONSWAP spectrum has the peak enhancement " + std::to_string(gamma) +
                     "; a number from 1 (Pierson and Moskowitz) to 20 is due");
  }
  const double peak = two_pi / peak_period;
  const double log_gamma = std::log(gamma);
  const auto shape = [peak, log_gamma](double omega) {
    const double x = omega / peak;
    const double from_peak = (x - 1.0) / (x <= 1.0 ? 0.07 : 0.09);
    return std::pow(x, -5) *
           std::exp(-1.25 * std::pow(x, -4) + log_gamma * std::exp(-0.5 * from_peak * from_peak));
  };
  const WaveSpectrum unscaled(shape, nodes_about(peak));
  const double scale = significant_height * significant_height / (16.0 * unscaled.moment(0));
  return {[shape, scale](double omega) { return scale * shape(omega); }, nodes_about(peak)};
}

WaveSpectrum WaveSpectrum::table(std::vector<double> omega, std::vector<double> density) {
  if (omega.size() < 2 || omega.size() != density.size()) {
    throw ModelError("a wave spectrum is given by " + std::to_string(omega.size()) +
                     " frequencies and " + std::to_string(density.size()) +
                     " densities; two or more of both, as many of one as of the other, are due");
  }
  for (std::size_t i = 0; i < omega.size(); ++i) {
    if (!(omega[i] > (i == 0 ? 0.0 : omega[i - 1])) || !std::isfinite(omega[i])) {
      throw ModelError("frequency " + std::to_string(i) + " of a wave spectrum is " +
                       std::to_string(omega[i]) +
                       " rad/s; frequencies must ascend from above zero");
    }
    if (!(density[i] >= 0.0) || !std::isfinite(density[i])) {
      throw ModelError("density " + std::to_string(i) + " of a wave spectrum is " +
                       std::to_string(density[i]) + " m2 s/rad; zero or more is due");
    }
  }
  const std::vector<double> nodes = omega;
  return {[omega = std::move(omega), density = std::move(density)](double w) {
            if (w < omega.front() || w > omega.back()) return 0.0;
            const auto next = std::upper_bound(omega.begin() + 1, omega.end() - 1, w);
            const auto i = static_cast<std::size_t>(next - omega.begin());
            const double share = (w - omega[i - 1]) / (omega[i] - omega[i - 1]);
            return density[i - 1] + share * (density[i] - density[i - 1]);
          },
          nodes};
}

double WaveSpectrum::moment(int n) const {
  double sum = 0.0;
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    sum += integrate(nodes_[i - 1], nodes_[i], nodes_.size() > 20 ? 2 : 40,
                     [&](double omega) { return std::pow(omega, n) * density(omega); });
  }
  return sum;
}

double WaveSpectrum::energy_between(double low, double high) const {
  double sum = 0.0;
  double from = std::max(low, nodes_.front());
  const double to = std::min(high, nodes_.back());
  for (const double node : nodes_) {
    if (node <= from) continue;
    const double end = std::min(node, to);
    sum += integrate(from, end, 4, [&](double omega) { return density(omega); });
    from = end;
    if (from >= to) break;
  }
  return sum;
}

double WaveSpectrum::significant_height() const { return 4.0 * std::sqrt(moment(0)); }

std::array<double, 2> WaveSpectrum::range(double left_out) const {
  const double m0 = moment(0);
  const auto find = [&](double fraction) {
    double low = nodes_.front();
    double high = nodes_.back();
    for (int i = 0; i < 60; ++i) {
      const double middle = std::sqrt(low * high);
      (energy_between(nodes_.front(), middle) < fraction * m0 ? low : high) = middle;
    }
    return low;
  };
  return {find(left_out), find(1.0 - left_out)};
}

namespace {

// Distribution function of cos^n over (-pi/2, pi/2), inverted by halves.
class Spreading {
 public:
  explicit Spreading(double exponent) {
    constexpr int steps = 2000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double angle = std::numbers::pi * ((i + 0.5) / steps - 0.5);
      sum += std::pow(std::cos(angle), exponent);
      sum_.push_back(sum);
    }
  }
  double draw(double uniform) const {
    const double target = uniform * sum_.back();
    const auto bin = std::lower_bound(sum_.begin(), sum_.end(), target) - sum_.begin();
    const auto i = static_cast<std::size_t>(bin);
    const double before = i == 0 ? 0.0 : sum_[i - 1];
    const double share = (target - before) / (sum_[i] - before);
    return std::numbers::pi *
           ((static_cast<double>(i) + share) / static_cast<double>(sum_.size()) - 0.5);
  }

 private:
  std::vector<double> sum_;
};

void require_realisable(const SeaRealisation& how, const std::array<double, 2>& range) {
  if (how.components < 1 || how.components > 100000) {
    throw ModelError("a sea is to have " + std::to_string(how.components) +
                     " components; 1 to 100000 are possible, 100 to 400 usual");
  }
  if (!(range[0] > 0.0 && range[1] > range[0])) {
    throw ModelError("a sea is to have frequencies from " + std::to_string(range[0]) + " to " +
                     std::to_string(range[1]) + " rad/s; they must ascend from above zero");
  }
  if (how.spreading_exponent &&
      !(*how.spreading_exponent >= 0.0 && *how.spreading_exponent < 1e4)) {
    throw ModelError("a sea has the spreading exponent " + std::to_string(*how.spreading_exponent) +
                     "; a number from 0 is due, 2 to 8 are usual");
  }
}

}  // namespace

WaveField realise(const WaveSpectrum& spectrum, const Water& water, const SeaRealisation& how) {
  const std::array<double, 2> range = how.frequencies ? *how.frequencies : spectrum.range(1e-3);
  require_realisable(how, range);
  RandomSource random(how.seed);
  std::optional<Spreading> spreading;
  if (how.spreading_exponent) spreading.emplace(*how.spreading_exponent);
  const double step = (range[1] - range[0]) / how.components;
  std::vector<WaveComponent> components;
  for (int i = 0; i < how.components; ++i) {
    const double low = range[0] + i * step;
    WaveComponent c;
    c.omega = low + step * random.uniform();
    c.phase = random.phase();
    c.heading = how.heading + (spreading ? spreading->draw(random.uniform()) : 0.0);
    c.amplitude = std::sqrt(2.0 * spectrum.energy_between(low, low + step));
    components.push_back(c);
  }
  return {water, components, how.ramp};
}

}  // namespace blocklift::dynamics

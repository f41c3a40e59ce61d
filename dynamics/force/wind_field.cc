#include "dynamics/force/wind_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/errors.h"
#include "dynamics/force/random_source.h"

namespace blocklift::dynamics {

double calc_gust_density(GustSpectrum spectrum, double f, double U10, double height,
                         double surface_drag) {
  if (!(f > 0.0) || !(U10 > 0.0)) return 0.0;
  switch (spectrum) {
    case GustSpectrum::none:
      return 0.0;
    case GustSpectrum::npd: {
      constexpr double n = 0.468;
      const double scaled =
          172.0 * f * std::pow(height / 10.0, 2.0 / 3.0) * std::pow(U10 / 10.0, -0.75);
      return 320.0 * std::pow(U10 / 10.0, 2) * std::pow(height / 10.0, 0.45) /
             std::pow(1.0 + std::pow(scaled, n), 5.0 / (3.0 * n));
    }
    case GustSpectrum::api: {
      const double U = U10 * std::pow(height / 10.0, 0.125);
      const double sigma = 0.15 * std::pow(height / 20.0, height > 20.0 ? -0.275 : -0.125) * U;
      const double x = f * height / (0.025 * U);
      return sigma * sigma * x / (f * std::pow(1.0 + 1.5 * x, 5.0 / 3.0));
    }
    case GustSpectrum::davenport: {
      const double x = 1200.0 * f / U10;
      return 4.0 * surface_drag * U10 * U10 * x * x / (f * std::pow(1.0 + x * x, 4.0 / 3.0));
    }
  }
  return 0.0;
}

namespace {

void require_wind(const WindField::Definition& d) {
  const auto require = [](const char* what, double value, bool zero_allowed) {
    if (std::isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0))) return;
    throw ModelError("the wind has the " + std::string(what) + " " + std::to_string(value) +
                     "; a finite number " + (zero_allowed ? "from" : "above") + " zero is due");
  };
  require("speed", d.speed, true);
  require("air density", d.air_density, true);
  require("profile exponent", d.exponent, true);
  require("gust height", d.gust_height, false);
  require("surface drag", d.surface_drag, true);
  if (!std::isfinite(d.heading)) throw ModelError("the wind needs a heading");
  if (d.gusts == GustSpectrum::none) return;
  if (!(d.lowest_frequency > 0.0) || !(d.highest_frequency > d.lowest_frequency) ||
      !std::isfinite(d.highest_frequency)) {
    throw ModelError("the gusts have frequencies from " + std::to_string(d.lowest_frequency) +
                     " to " + std::to_string(d.highest_frequency) +
                     " Hz; they must ascend from above zero");
  }
  if (d.components < 1 || d.components > 10000) {
    throw ModelError("the gusts have " + std::to_string(d.components) +
                     " components; 1 to 10000 are possible, 60 usual");
  }
}

// int S df from low to high by Simpson's rule in ln f; the spectra are smooth over so small a step.
double integrate(const WindField::Definition& d, double low, double high) {
  constexpr int halves = 4;
  const double step = std::log(high / low) / (2 * halves);
  double sum = 0.0;
  for (int i = 0; i <= 2 * halves; ++i) {
    const double f = low * std::exp(i * step);
    const double weight = i == 0 || i == 2 * halves ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * f * calc_gust_density(d.gusts, f, d.speed, d.gust_height, d.surface_drag);
  }
  return sum * step / 3.0;
}

}  // namespace

WindField::WindField(const Definition& definition)
    : definition_(definition),
      direction_W_(std::cos(definition.heading), std::sin(definition.heading), 0.0) {
  require_wind(definition);
  npd_slope_ = 0.0573 * std::sqrt(1.0 + 0.15 * definition.speed);
  if (definition.gusts == GustSpectrum::none) return;
  RandomSource random(definition.seed);
  const double ratio = std::pow(definition.highest_frequency / definition.lowest_frequency,
                                1.0 / definition.components);
  for (int i = 0; i < definition.components; ++i) {
    const double low = definition.lowest_frequency * std::pow(ratio, i);
    omega_.push_back(2.0 * std::numbers::pi * low * std::pow(ratio, random.uniform()));
    phase_.push_back(random.phase());
    amplitude_.push_back(std::sqrt(2.0 * integrate(definition, low, low * ratio)));
  }
}

double WindField::calc_mean_speed(double z) const {
  const double height = std::max(1.0, z);
  switch (definition_.profile) {
    case WindProfile::uniform:
      return definition_.speed;
    case WindProfile::power:
      return definition_.speed * std::pow(height / 10.0, definition_.exponent);
    case WindProfile::npd:
      return definition_.speed * (1.0 + npd_slope_ * std::log(height / 10.0));
  }
  return definition_.speed;
}

double WindField::calc_gust(double time) const {
  double sum = definition_.gust ? definition_.gust->evaluate(time) : 0.0;
  for (std::size_t i = 0; i < amplitude_.size(); ++i) {
    sum += amplitude_[i] * std::cos(omega_[i] * time + phase_[i]);
  }
  return sum;
}

double WindField::gust_deviation() const {
  double sum = 0.0;
  for (const double a : amplitude_) sum += 0.5 * a * a;
  return std::sqrt(sum);
}

WindField WindField::mean() const {
  Definition steady = definition_;
  steady.gusts = GustSpectrum::none;
  steady.gust.reset();
  return WindField(steady);
}

}  // namespace blocklift::dynamics

#include "dynamics/simulation/forecast_forces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blocklift::dynamics {
namespace {

constexpr Eigen::Index numbers_of_plane = 5;
constexpr Eigen::Index numbers_of_force = 6;

ForceVector force_from(const Eigen::Ref<const Eigen::VectorXd>& six) {
  return {six.head<3>(), six.tail<3>()};
}

}  // namespace

ForecastForces::ForecastForces(double interval, std::size_t hulls, std::size_t others)
    : interval_(interval), hulls_(hulls), first_(hulls + others, 0) {
  values_.setZero(row(count()), kept);
  at_.setZero(row(count()));
}

Eigen::Index ForecastForces::row(std::size_t number) const {
  const auto planes = static_cast<Eigen::Index>(std::min(number, hulls_));
  return numbers_of_force * static_cast<Eigen::Index>(number) + numbers_of_plane * planes;
}

long ForecastForces::before(double time) const {
  return static_cast<long>(std::floor(time / interval_));
}

void ForecastForces::begin(double time) { begun_ = next_ = std::max(next_, before(time) + 1); }

void ForecastForces::add() { values_.col(column(next_++)).setZero(); }

void ForecastForces::set(std::size_t hull, const WaterPlane& plane, const ForceVector& beside) {
  auto numbers =
      values_.col(column(next_ - 1)).segment<numbers_of_force + numbers_of_plane>(row(hull));
  numbers << beside.moment, beside.force, plane.place, plane.height, plane.slope;
}

void ForecastForces::set(std::size_t force, const ForceVector& F) {
  values_.col(column(next_ - 1)).segment<numbers_of_force>(row(force)) << F.moment, F.force;
}

bool ForecastForces::has(long first, double time) const {
  const long last = before(time) + 1;
  return last < next_ && last - (through - 1) >= std::max({begun_, first, next_ - kept});
}

bool ForecastForces::covers(std::size_t force, double time) const {
  return force < count() && has(first_[force], time);
}

void ForecastForces::interpolate(double time) {
  if (count() == 0) return;
  const long earlier = before(time);
  const double s = time / interval_ - static_cast<double>(earlier);
  at_.setZero();
  for (long m = 2 - through; m <= 1; ++m) {
    double share = 1.0;
    for (long i = 2 - through; i <= 1; ++i) {
      if (i != m) share *= (s - static_cast<double>(i)) / static_cast<double>(m - i);
    }
    at_ += share * values_.col(column(earlier + m));
  }
}

ForceVector ForecastForces::calc_force(const HullForce& hull, std::size_t number,
                                       const MotionState& state) const {
  const auto numbers = at_.segment<numbers_of_plane>(row(number) + numbers_of_force);
  const WaterPlane plane{numbers.head<2>(), numbers[2], numbers.tail<2>()};
  return hull.calc_force(state, plane) + force(number);
}

ForceVector ForecastForces::force(std::size_t number) const {
  return force_from(at_.segment<numbers_of_force>(row(number)));
}

ForceVector ForecastForces::calc_error(std::size_t number, long first_of_force) const {
  static constexpr std::array<double, 7> difference = {1, -6, 15, -20, 15, -6, 1};
  const long first = next_ - static_cast<long>(difference.size());
  if (first < std::max(begun_, first_of_force)) return ForceVector::zero();
  Eigen::Matrix<double, numbers_of_force, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < difference.size(); ++i) {
    const long instant = first + static_cast<long>(i);
    sum += difference[i] * values_.col(column(instant)).segment<numbers_of_force>(row(number));
  }
  return force_from(remainder * sum);
}

}  // namespace blocklift::dynamics

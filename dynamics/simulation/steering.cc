#include "dynamics/simulation/steering.h"

#include <algorithm>
#include <cmath>

namespace blocklift::dynamics {

namespace {

constexpr double rounding = 1e-9;  // of counts

}  // namespace

int Steering::looks_behind() const {
  return static_cast<int>(std::ceil(reaction / longest_interval - rounding));
}

double Steering::interval() const {
  const int looks = looks_behind();
  return looks > 0 ? reaction / looks : longest_interval;
}

int Steering::look_count() const {
  const double h = interval();
  int count = static_cast<int>(std::ceil((end - start) / h - rounding));
  // At its largest speed it no longer accelerates; what builds up on the way there goes first.
  count += static_cast<int>(std::ceil(limits.acceleration / (limits.jerk * h)));
  SteeredMotion motion{0.0, limits.speed, 0.0};
  while (motion.speed > rounding * limits.speed || motion.acceleration != 0.0) {
    motion = advance(motion, find_next_acceleration(motion, 0.0, h, limits), h);
    ++count;
    if (std::abs(motion.acceleration) < rounding * limits.acceleration) motion.acceleration = 0.0;
  }
  return count + 3;  // in which the rest of its speed vanishes to rounding
}

// With a acceleration now and a' next, the speed is v + h (a + a') / 2 then. From there a' can be
// taken back to zero within the jerk j while the speed gains at most a' (|a'| / j + h) / 2. The a'
// for which all of that just reaches the wanted speed may be followed by one that is smaller by no
// more than j h, so that it never overshoots.
double find_next_acceleration(const SteeredMotion& motion, double wanted, double interval,
                              const MotionLimits& limits) {
  const double h = interval, j = limits.jerk;
  const double missing = wanted - motion.speed - 0.5 * h * motion.acceleration;
  // j (sqrt(h^2 + 2 r / j) - h), without cancellation.
  const double r = std::abs(missing);
  const double next = 2.0 * r / (std::sqrt(h * h + 2.0 * r / j) + h);
  const double most = std::min(motion.acceleration + j * h, limits.acceleration);
  const double least = std::max(motion.acceleration - j * h, -limits.acceleration);
  return std::clamp(std::copysign(next, missing), least, most);
}

SteeredMotion advance(const SteeredMotion& motion, double next_acceleration, double interval) {
  const double h = interval, a = motion.acceleration, b = next_acceleration;
  return {motion.travel + h * (motion.speed + h * (2.0 * a + b) / 6.0),
          motion.speed + 0.5 * h * (a + b), b};
}

}  // namespace blocklift::dynamics

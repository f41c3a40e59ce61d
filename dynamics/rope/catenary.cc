#include "dynamics/rope/catenary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Span and rise of a line with given end forces, and their derivatives.
struct Shape {
  double span, rise;
  Eigen::Matrix2d slope;  // d(span, rise)/d(H, V)
  double lying;           // unstretched length on the bottom, m
  double energy;          // Phi, N m
};

// int of the unstretched line over the vertical force from b to a, divided by w.
double complementary_energy(double H, double v, double EA) {
  const double T = std::hypot(H, v);
  return 0.5 * (v * T + H * H * std::asinh(v / H)) + (H * H * v + v * v * v / 3.0) / (2.0 * EA);
}

Shape calc_shape(const CatenaryLine& line, double H, double V) {
  const double L0 = line.unstretched_length;
  const double w = line.weight_per_length;
  const double EA = line.axial_stiffness;
  const bool touches = line.on_seabed && V < w * L0;
  const double a = V;
  const double b = touches ? 0.0 : V - w * L0;
  const double hanging = touches ? V / w : L0;
  const double Ta = std::hypot(H, a);
  const double Tb = std::hypot(H, b);
  // asinh(a/H) - asinh(b/H) and Ta - Tb without cancellation.
  const double dT_over_w = (a + b) * hanging / (Ta + Tb);
  const double b_plus_Tb = b >= 0.0 ? b + Tb : H * H / (Tb - b);
  const double angle = std::log1p(w * (hanging + dT_over_w) / b_plus_Tb);
  Shape s;
  s.lying = L0 - hanging;
  s.span = s.lying + H * L0 / EA + H / w * angle;
  s.rise = dT_over_w + 0.5 * (a + b) * hanging / EA;
  const double cross = (H / Ta - H / Tb) / w;
  s.slope << L0 / EA + (angle - (a / Ta - b / Tb)) / w, cross, cross,
      (a / Ta - b / Tb) / w + hanging / EA;
  s.energy = s.lying * (H + 0.5 * H * H / EA) +
             (complementary_energy(H, a, EA) - complementary_energy(H, b, EA)) / w;
  return s;
}

// A line that lies in part in a heap and hangs straight down from its upper end: no level force.
Catenary hang_straight(const CatenaryLine& line, double rise) {
  const double w = line.weight_per_length;
  const double EA = line.axial_stiffness;
  // rise = V/w + V^2/(2 EA w).
  const double V = rise > 0.0 ? EA * (std::sqrt(1.0 + 2.0 * w * rise / EA) - 1.0) : 0.0;
  Catenary c;
  c.horizontal = 0.0;
  c.vertical = V;
  c.lower_vertical = 0.0;
  c.tension = V;
  c.lower_tension = 0.0;
  c.lying_length = line.unstretched_length - V / w;
  c.energy = V * rise - (0.5 * V * V + V * V * V / (6.0 * EA)) / w;
  c.stiffness << 0.0, 0.0, 0.0, rise > 0.0 ? w / (1.0 + V / EA) : 0.0;
  return c;
}

bool is_heap(const CatenaryLine& line, double span, double rise) {
  if (!line.on_seabed) return false;
  const double V = hang_straight(line, rise).vertical;
  return V < line.weight_per_length * line.unstretched_length &&
         line.unstretched_length - V / line.weight_per_length >= span;
}

// Tension along the chord of a line that hangs as a parabola (Irvine 1981, sec. 2.5): of
//   x/k - a/x^2 = l - L0,   a = l (w L0 cos)^2 / 24,
// whose left side rises and is concave, so that Newton's method climbs to the root from below.
double parabola_tension(const CatenaryLine& line, double span, double chord) {
  const double L0 = line.unstretched_length;
  const double k = line.axial_stiffness / L0;
  const double across = line.weight_per_length * L0 * span / chord;
  const double a = chord * across * across / 24.0;
  const double stretch = chord - L0;
  const double turn = std::cbrt(a / (k * k));  // the stretch at which both terms are alike
  double x = stretch >= 0.0 ? k * std::max(stretch, turn) : std::sqrt(a / (turn - stretch));
  for (int i = 0; i < 20 && x > 0.0; ++i) {
    const double step = -(x / k - a / (x * x) - stretch) / (1.0 / k + 2.0 * a / (x * x * x));
    x += step;
    if (std::abs(step) < 1e-6 * x) break;
  }
  return x;
}

// First guess: the parabola where the line is taut enough to be near it, otherwise that of Jonkman
// (2007), eq. B-4, B-5.
Eigen::Vector2d guess(const CatenaryLine& line, double span, double rise) {
  const double L0 = line.unstretched_length;
  const double w = line.weight_per_length;
  if (const double chord = std::hypot(span, rise); !line.on_seabed && chord > 0.0) {
    const double T = parabola_tension(line, span, chord);
    const bool bears_all = T * rise > 0.5 * w * L0 * chord;  // its lower end, too, is drawn up
    if (T > w * L0 || bears_all) return {T * span / chord, T * rise / chord + 0.5 * w * L0};
  }
  double lambda = 0.2;
  if (std::hypot(span, rise) < L0) {
    lambda = std::sqrt(3.0 * ((L0 * L0 - rise * rise) / (span * span) - 1.0));
  }
  const double H = std::abs(w * span / (2.0 * lambda));
  const double V = 0.5 * w * (rise / std::tanh(lambda) + L0);
  return {std::clamp(H, 1e-6 * w * L0, 1e6 * w * L0), V};
}

// The line seen from its other end.
Catenary reverse(const CatenaryLine& line, const Catenary& other, double rise) {
  Catenary c = other;
  c.vertical = -other.lower_vertical;
  c.lower_vertical = -other.vertical;
  std::swap(c.tension, c.lower_tension);
  c.energy += line.weight_per_length * line.unstretched_length * rise;
  c.stiffness(0, 1) = c.stiffness(1, 0) = -other.stiffness(0, 1);
  return c;
}

}  // namespace

void require_line(const CatenaryLine& line, const std::string& name) {
  const auto require = [&](const char* what, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    throw ModelError("line \"" + name + "\" has the " + what + " " + std::to_string(value) +
                     "; a number above zero is due");
  };
  require("unstretched length", line.unstretched_length);
  require("weight per length", line.weight_per_length);
  require("axial stiffness", line.axial_stiffness);
}

Catenary calc_catenary(const CatenaryLine& line, double span, double rise) {
  constexpr int most_iterations = 200;
  const double L0 = line.unstretched_length;
  span = std::max(span, 1e-9 * L0);
  if (line.on_seabed) rise = std::max(rise, 0.0);
  // Upside down the vertical forces are differences of like numbers where the line hangs plumb.
  if (rise < 0.0) return reverse(line, calc_catenary(line, span, -rise), rise);
  if (is_heap(line, span, rise)) return hang_straight(line, rise);
  Eigen::Vector2d force = guess(line, span, rise);
  Shape shape = calc_shape(line, force.x(), force.y());
  Eigen::Vector2d excess(shape.span - span, shape.rise - rise);
  for (int i = 0; i < most_iterations && excess.norm() > 1e-13 * L0; ++i) {
    Eigen::Vector2d step = -shape.slope.inverse() * excess;
    if (force.x() + step.x() <= 0.0) step *= 0.9 * force.x() / -step.x();
    if (line.on_seabed && force.y() + step.y() <= 0.0) step *= 0.9 * force.y() / -step.y();
    // The excess is the gradient of a convex function: some part of Newton's step lessens it.
    Eigen::Vector2d next, next_excess;
    bool better = false;
    for (int halving = 0; halving < 60 && !better; ++halving) {
      next = force + step;
      shape = calc_shape(line, next.x(), next.y());
      next_excess << shape.span - span, shape.rise - rise;
      better = next_excess.norm() < excess.norm();
      step *= 0.5;
    }
    if (!better) break;  // rounding
    force = next;
    excess = next_excess;
  }
  shape = calc_shape(line, force.x(), force.y());
  if (!(excess.norm() < 1e-8 * L0)) {
    throw SimulationError("a line of " + std::to_string(L0) + " m over the span " +
                          std::to_string(span) + " m and the rise " + std::to_string(rise) +
                          " m finds no equilibrium; " + std::to_string(excess.norm()) +
                          " m are left");
  }
  Catenary c;
  c.horizontal = force.x();
  c.vertical = force.y();
  c.lying_length = shape.lying;
  c.lower_vertical = shape.lying > 0.0 ? 0.0 : c.vertical - line.weight_per_length * L0;
  c.tension = force.norm();
  c.lower_tension = std::hypot(c.horizontal, c.lower_vertical);
  c.energy = c.horizontal * span + c.vertical * rise - shape.energy;
  c.stiffness = shape.slope.inverse();
  return c;
}

}  // namespace blocklift::dynamics

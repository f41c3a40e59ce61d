#include "pipeline/files/rigging/spreader_strength.h"

#include <algorithm>
#include <cmath>

namespace blocklift::pipeline {
namespace {

using structure::PointForce;

/// Load along a bar of length 2 h, w(x) = even + rising x, N/m.
struct LineLoad {
  Vector3 even = Vector3::Zero();
  Vector3 rising = Vector3::Zero();
};

/// What balances the forces as the weight and inertia of an even rod do.
LineLoad balancing(const std::vector<PointForce>& forces, double length) {
  Vector3 sum = Vector3::Zero(), moment = Vector3::Zero();
  for (const PointForce& force : forces) {
    sum += force.f;
    moment += force.p.cross(force.f);
  }
  const double third = 12 / (length * length * length);
  return {-sum / length, {0, -third * moment.z(), third * moment.y()}};
}

/// Forces within the section at x, those of the ends at x itself counted or not.
structure::ColumnForces forces_at(const std::vector<PointForce>& forces, const LineLoad& load,
                                  double length, double x, bool with_own) {
  const double h = length / 2;
  Vector3 sum = load.even * (x + h) + load.rising * (x * x - h * h) / 2;
  // Of the line load about the section: its first moments over the part left of it.
  const Vector3 lever = -load.even * (x + h) * (x + h) / 2 +
                        load.rising * (h * h * h / 3 + x * h * h / 2 - x * x * x / 6);
  Vector3 moment = Vector3::UnitX().cross(lever);
  for (const PointForce& force : forces) {
    const double behind = x - force.p.x();
    if (behind < 0 || (behind == 0 && !with_own)) continue;
    sum += force.f;
    moment += (force.p - x * Vector3::UnitX()).cross(force.f);
  }
  return {sum.x(), {moment.y(), moment.z()}};
}

}  // namespace

structure::ColumnForces largest_forces(const std::vector<PointForce>& forces, double length) {
  constexpr int pieces = 20;
  const LineLoad load = balancing(forces, length);
  structure::ColumnForces largest;
  double pressed = 0, pulled = 0;
  const auto consider = [&](double x, bool with_own) {
    const structure::ColumnForces here = forces_at(forces, load, length, x, with_own);
    pressed = std::max(pressed, here.compression);
    pulled = std::min(pulled, here.compression);
    for (std::size_t i = 0; i < 2; ++i)
      largest.moments[i] = std::max(largest.moments[i], std::abs(here.moments[i]));
  };
  for (int i = 0; i <= pieces; ++i)
    consider(length * (static_cast<double>(i) / pieces - 0.5), true);
  for (const PointForce& force : forces) {
    consider(force.p.x(), false);
    consider(force.p.x(), true);
  }
  largest.compression = pressed > 0 ? pressed : pulled;
  return largest;
}

SpreaderStrength::SpreaderStrength(const given::Spreader& spreader,
                                   const std::vector<Vector3>& points)
    : bar_(spreader.column()) {
  if (spreader.is_frame()) frame_.emplace(spreader.member(), spreader.cross_member(), points);
}

SpreaderForces SpreaderStrength::find_forces(const std::vector<PointForce>& forces) const {
  if (!frame_) return {{largest_forces(forces, bar_.length), 0}};
  const auto sides = frame_->largest_forces(forces);
  return {sides.begin(), sides.end()};
}

double SpreaderStrength::utilisation(const SpreaderForces& forces, double factor) const {
  if (!frame_) return structure::column_utilisation(bar_, forces.front().column, factor);
  double largest = 0;
  for (std::size_t side = 0; side < forces.size(); ++side)
    largest = std::max(largest,
                       structure::member_utilisation(frame_->member(side), forces[side], factor));
  return largest;
}

}  // namespace blocklift::pipeline

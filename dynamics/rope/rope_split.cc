#include "dynamics/rope/rope_split.h"

#include <algorithm>
#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Below this strain a rope carries nothing, and its shares are not those of its tensions.
constexpr double no_strain = 1e-12;

double sign(SheaveMotion motion) { return static_cast<double>(motion); }

}  // namespace

RopeSplit::RopeSplit(const Rope& rope)
    : rubs_(rope.definition().sheave_friction > 0.0),
      axial_stiffness_(rope.definition().axial_stiffness),
      friction_(rope.definition().sheave_friction) {
  if (!rubs_) return;
  lengths_.resize(rope.points().size() - 1);
  wraps_.resize(lengths_.size() - 1);
  motion_.assign(wraps_.size(), SheaveMotion::sticks);
  lengths_.front().series = 1.0 / rope.definition().crane_stiffness;
}

// Lengths, wraps and their rates.
void RopeSplit::measure(const Rope& rope, const Kinematics& kinematics, const RopePath& path) {
  const std::vector<BodyPoint>& points = rope.points();
  Vector3 p_previous = Vector3::Zero(), v_previous = Vector3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto body = static_cast<std::size_t>(points[i].body);
    const Vector3 p = kinematics.X_WB[body].p + path.r_W[i];
    const Vector3 v = shift(kinematics.V_WB[body], path.r_W[i]).linear;
    if (i > 0) {
      Length& one = lengths_[i - 1];
      const Vector3& u = path.direction_W[i - 1];
      one.velocity_W = v - v_previous;
      one.length = u.dot(p - p_previous);
      one.rate = u.dot(one.velocity_W);
    }
    p_previous = p;
    v_previous = v;
  }
  const auto turn = [&](std::size_t i) -> Vector3 {
    const Length& one = lengths_[i];
    return (one.velocity_W - one.rate * path.direction_W[i]) / one.length;
  };
  for (std::size_t j = 0; j < wraps_.size(); ++j) {
    const Vector3& a = path.direction_W[j];
    const Vector3& b = path.direction_W[j + 1];
    const double sine = a.cross(b).norm();
    wraps_[j].angle = std::atan2(sine, a.dot(b));
    // Straight on, or straight back, the angle has no rate of its own.
    constexpr double least_sine = 1e-9;
    wraps_[j].rate = sine > least_sine ? -(turn(j).dot(b) + a.dot(turn(j + 1))) / sine : 0.0;
  }
}

std::size_t RopeSplit::end_of_group(std::size_t first) const {
  std::size_t last = first;
  while (last < motion_.size() && motion_[last] != SheaveMotion::sticks) ++last;
  return last;
}

// Tension X of the first of the lengths of a group that together have this unstretched length:
//   sum (L_i - r_i X c_i) / (1 + r_i X / EA) = unstretched,  by Newton's method.
double RopeSplit::find_tension(std::size_t first, std::size_t last, double unstretched) const {
  const double EA = axial_stiffness_;
  double X = -unstretched, compliance = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const Length& one = lengths_[i];
    X += one.length;
    compliance += one.ratio * (one.series + one.length / EA);
  }
  X /= compliance;
  constexpr int most_iterations = 20;
  for (int k = 0; k < most_iterations; ++k) {
    double excess = -unstretched, slope = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      const Length& one = lengths_[i];
      const double stretch = 1.0 + one.ratio * X / EA;
      const double l = (one.length - one.ratio * X * one.series) / stretch;
      excess += l;
      slope += one.ratio * (one.series + l / EA) / stretch;
    }
    const double step = excess / slope;
    X += step;
    // What is left of a step that converges in squares is then beyond rounding.
    if (std::abs(step) <= 1e-10 * EA) break;
  }
  return X;
}

void RopeSplit::divide_group(std::size_t first, std::size_t last, double unstretched,
                             double unstretched_rate) {
  const double EA = axial_stiffness_;
  lengths_[first].ratio = 1.0;
  lengths_[first].ratio_rate = 0.0;
  for (std::size_t i = first + 1; i <= last; ++i) {
    const double exponent = sign(motion_[i - 1]) * friction_;
    const Wrap& wrap = wraps_[i - 1];
    const double step = std::exp(-exponent * wrap.angle);
    lengths_[i].ratio = lengths_[i - 1].ratio / step;
    lengths_[i].ratio_rate =
        lengths_[i - 1].ratio_rate / step + lengths_[i].ratio * exponent * wrap.rate;
  }
  const double X = first == last ? (lengths_[first].length - unstretched) /
                                       (lengths_[first].series + unstretched / EA)
                                 : find_tension(first, last, unstretched);
  double rates = -unstretched_rate, compliance = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    Length& one = lengths_[i];
    one.elastic = one.ratio * X;
    one.yield = 1.0 / (1.0 + one.elastic / EA);
    one.unstretched =
        first == last ? unstretched : one.yield * (one.length - one.elastic * one.series);
    one.compliance = one.series + one.unstretched / EA;
    rates += one.yield * (one.rate - one.compliance * one.ratio_rate * X);
    compliance += one.yield * one.compliance * one.ratio;
  }
  const double X_rate = rates / compliance;
  for (std::size_t i = first; i <= last; ++i) {
    Length& one = lengths_[i];
    const double elastic_rate = one.ratio * X_rate + one.ratio_rate * X;
    one.unstretched_rate = one.yield * (one.rate - one.compliance * elastic_rate);
  }
  // What passes a sheave is what the lengths of the group beyond it gain.
  double gained = 0.0;
  for (std::size_t i = last; i > first; --i) {
    gained += lengths_[i].unstretched_rate;
    wraps_[i - 1].slip_rate = gained;
  }
}

// Tensions of the lengths of a group with its damping; what that takes, W.
double RopeSplit::damp_group(std::size_t first, std::size_t last, double damping_over_stiffness,
                             double fed_rate) {
  double compliance = 0.0, weighted = 0.0, stretch = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const Length& one = lengths_[i];
    compliance += one.compliance;
    weighted += one.compliance * one.ratio;
    stretch += one.compliance * one.elastic;
  }
  double rate = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    Length& one = lengths_[i];
    one.share = one.ratio * compliance / weighted;
    one.damping = damping_over_stiffness / compliance;
    rate += one.share * (one.rate - (i == 0 ? fed_rate : 0.0));
    // What runs over a sheave stretches nothing.
    if (i > first) rate -= wraps_[i - 1].slip_rate * (one.share - lengths_[i - 1].share);
  }
  const double force =
      std::max(lengths_[first].damping * rate, -std::max(0.0, stretch / compliance));
  for (std::size_t i = first; i <= last; ++i) {
    Length& one = lengths_[i];
    one.tension = one.elastic + one.share * force;
  }
  return force * rate;
}

void RopeSplit::divide(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
                       RopeLoad& load) {
  measure(rope, kinematics, path);
  double of_first_group = load.unstretched_length;
  for (std::size_t i = end_of_group(0) + 1; i < lengths_.size(); ++i)
    of_first_group -= lengths_[i].held;
  for (Wrap& wrap : wraps_) wrap.slip_rate = 0.0;
  SplitLoad& split = load.split;
  split = {.acts = true};
  const double damping_over_stiffness = rope.damping(load.stiffness) / load.stiffness;
  for (std::size_t first = 0; first < lengths_.size();) {
    const std::size_t last = end_of_group(first);
    double held = 0.0;
    for (std::size_t i = first; i <= last; ++i) held += lengths_[i].held;
    divide_group(first, last, first == 0 ? of_first_group : held,
                 first == 0 ? load.unstretched_rate : 0.0);
    require_lengths(rope, first, last);
    split.dissipated_power +=
        damp_group(first, last, damping_over_stiffness, load.unstretched_rate);
    first = last + 1;
  }
  const auto drive = [&](const Length& one) {
    return one.tension + 0.5 * one.elastic * one.elastic / axial_stiffness_;
  };
  load.tension = 0.0;
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const Length& one = lengths_[i];
    load.tension = std::max(load.tension, one.tension);
    split.stored_energy += 0.5 * one.compliance * one.elastic * one.elastic;
    if (i > 0)
      split.dissipated_power += wraps_[i - 1].slip_rate * (drive(one) - drive(lengths_[i - 1]));
  }
  const Length& first = lengths_.front();
  split.first_tension = first.tension;
  split.last_tension = lengths_.back().tension;
  split.feed_force = drive(first);
}

void RopeSplit::require_lengths(const Rope& rope, std::size_t first, std::size_t last) const {
  for (std::size_t i = first; i <= last; ++i) {
    if (lengths_[i].unstretched > 0.0) continue;
    throw ModelError("rope \"" + rope.name() + "\": all of its length " + std::to_string(i + 1) +
                     " has run over its sheave; its winch moves too far, or its ends part");
  }
}

void RopeSplit::set_motion(std::size_t sheave, SheaveMotion motion) {
  for (Length& one : lengths_) one.held = one.unstretched;
  motion_[sheave] = motion;
}

void RopeSplit::begin(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
                      const RopeLoad& load) {
  acts_ = true;
  measure(rope, kinematics, path);
  const double X = std::max(0.0, load.elastic_force);
  const double EA = axial_stiffness_;
  for (Length& one : lengths_) {
    one.unstretched = (one.length - X * one.series) / (1.0 + X / EA);
    one.held = one.unstretched;
    one.compliance = one.series + one.unstretched / EA;
    one.elastic = X;
    one.ratio = 1.0;
  }
  for (std::size_t j = 0; j < motion_.size(); ++j) {
    motion_[j] = SheaveMotion::sticks;
    if (X > no_strain * EA) continue;
    const auto rate = [&](std::size_t i) {
      const double fed = i == 0 ? load.unstretched_rate : 0.0;
      return (lengths_[i].rate - fed) / lengths_[i].compliance;
    };
    const double capstan = std::exp(friction_ * wraps_[j].angle);
    const double before = rate(j), behind = rate(j + 1);
    if (behind > capstan * before) motion_[j] = SheaveMotion::to_last;
    if (before > capstan * behind) motion_[j] = SheaveMotion::to_first;
  }
}

double RopeSplit::indicator(std::size_t sheave) const {
  const Length& a = lengths_[sheave];
  const Length& b = lengths_[sheave + 1];
  if (motion_[sheave] != SheaveMotion::sticks)
    return 1e-3 * sign(motion_[sheave]) * wraps_[sheave].slip_rate / (a.compliance + b.compliance);
  const double capstan = std::exp(friction_ * wraps_[sheave].angle);
  return 1e-3 * std::min(capstan * a.elastic - b.elastic, capstan * b.elastic - a.elastic);
}

SheaveMotion RopeSplit::tendency(std::size_t sheave) const {
  return lengths_[sheave + 1].elastic > lengths_[sheave].elastic ? SheaveMotion::to_last
                                                                 : SheaveMotion::to_first;
}

void RopeSplit::add_forces(const Rope& rope, const RopePath& path,
                           std::vector<ForceVector>& F_Bo_W) const {
  const std::vector<BodyPoint>& points = rope.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vector3 f = Vector3::Zero();
    if (i < lengths_.size()) f += lengths_[i].tension * path.direction_W[i];
    if (i > 0) f -= lengths_[i - 1].tension * path.direction_W[i - 1];
    ForceVector& F = F_Bo_W[static_cast<std::size_t>(points[i].body)];
    F.moment += path.r_W[i].cross(f);
    F.force += f;
  }
}

void RopeSplit::add_derivatives(const Rope& rope, const RopePath& path,
                                ForceDerivatives& derivatives) const {
  const std::vector<BodyPoint>& points = rope.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    derivatives.locate(i, points[i].body, path.r_W[i]);
  }
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const Length& one = lengths_[i];
    const ForceDerivatives::Line line{path.direction_W[i], one.length, one.velocity_W};
    derivatives.add_tension(i, i + 1, line, one.tension, 0.0, 0.0);
  }
  // The pull of length i changes by that of length m, both towards the next point.
  const auto add = [&](std::size_t i, std::size_t m, double dT_dL, double dT_dLdot) {
    const Vector3& u = path.direction_W[m];
    const Length& other = lengths_[m];
    const Vector3 turning = (other.velocity_W - other.rate * u) / other.length;
    const Matrix3 by_place = path.direction_W[i] * (dT_dL * u + dT_dLdot * turning).transpose();
    const Matrix3 by_rate = dT_dLdot * path.direction_W[i] * u.transpose();
    for (const std::size_t on : {i, i + 1}) {
      for (const std::size_t by : {m, m + 1}) {
        const double way = (on == i ? 1.0 : -1.0) * (by == m ? -1.0 : 1.0);
        derivatives.add_block(on, by, way * by_place, way * by_rate);
      }
    }
  };
  for (std::size_t first = 0; first < lengths_.size();) {
    const std::size_t last = end_of_group(first);
    double compliance = 0.0, weight = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      const double part = lengths_[i].yield * lengths_[i].compliance * lengths_[i].ratio;
      compliance += part;
      weight += part * lengths_[i].share;
    }
    for (std::size_t i = first; i <= last; ++i) {
      for (std::size_t m = first; m <= last; ++m) {
        const Length& by = lengths_[m];
        const double stretches = by.yield * weight / compliance + (1.0 - by.yield) * by.share;
        add(i, m, lengths_[i].ratio * by.yield / compliance,
            lengths_[i].damping * lengths_[i].share * stretches);
      }
    }
    first = last + 1;
  }
}

std::vector<RopeSplit> make_rope_splits(const std::vector<Rope>& ropes) {
  return {ropes.begin(), ropes.end()};
}

}  // namespace blocklift::dynamics

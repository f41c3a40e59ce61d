#include "dynamics/rope/rope_split.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Below this strain a rope carries nothing, and its shares are not those of its tensions.
constexpr double no_strain = 1e-12;

double sign(BendMotion motion) { return static_cast<double>(motion); }

// Of what a slope's sine leaves across the axis.
double cosine_of(double slope) { return std::sqrt(std::max(1e-12, 1.0 - slope * slope)); }

}  // namespace

RopeSplit::RopeSplit(const Rope& rope) : axial_stiffness_(rope.definition().axial_stiffness) {
  const RopeDefinition& d = rope.definition();
  std::size_t edge = 0;
  for (std::size_t point = 0; point + 1 < d.points.size(); ++point) {
    if (point > 0 && d.sheave_friction > 0.0)
      bends_.push_back({.point = point, .friction = d.sheave_friction});
    for (; edge < d.edges.size() && d.edges[edge].after == point; ++edge) {
      const double friction = d.edges[edge].friction;
      if (!(friction > 0.0)) continue;
      rubs_at_edges_ = true;
      bends_.push_back({.edge = static_cast<int>(edge), .point = point, .friction = friction});
    }
  }
  if (!rubs()) return;
  lengths_.resize(bends_.size() + 1);
  lengths_.front().series = 1.0 / d.crane_stiffness;
  segments_.resize(rope.most_path_points() - 1);
  turning_.assign(segments_.size(), Vector3::Zero());
}

double RopeSplit::Bend::shift() const {
  if (!touches || !is_carried) return carried;
  const double across = 0.5 * (cosine_of(middle.slope) + cosine_of(carried_middle.slope));
  const double along = 0.5 * (middle.slope + carried_middle.slope);
  return carried + across * (middle.round - carried_middle.round) +
         along * (middle.place - carried_middle.place);
}

// At a point of the path between two of its segments.
void RopeSplit::wrap_sheave(Bend& bend, const RopePath& path, std::size_t point) const {
  const Vector3& a = path.direction_W[point - 1];
  const Vector3& b = path.direction_W[point];
  const double sine = a.cross(b).norm();
  bend.angle = std::atan2(sine, a.dot(b));
  // Straight on, or straight back, the angle has no rate of its own.
  constexpr double least_sine = 1e-9;
  bend.rate =
      sine > least_sine ? -(turning_[point - 1].dot(b) + a.dot(turning_[point])) / sine : 0.0;
}

// At a point of the path where it comes to an edge.
void RopeSplit::wrap_edge(Bend& bend, const Rope& rope, const Kinematics& kinematics,
                          const RopePath& path, std::size_t point) const {
  const auto index = static_cast<std::size_t>(bend.edge);
  const RopeEdge& edge = rope.edges()[index];
  const EdgeTouch& touch = path.touches[index];
  const Vector3 along = rope.edge_along_W(kinematics, index);
  const Vector3& omega = kinematics.V_WB[edge.body].angular;
  const Vector3& u = path.direction_W[point - 1];
  const double slope = u.dot(along);
  const double cosine = cosine_of(slope);
  // Rate of a direction's angle about the axis, against the body.
  const auto swing = [&](std::size_t segment) {
    const Vector3& one = path.direction_W[segment];
    return along.dot(one.cross(turning_[segment] - omega.cross(one))) / (cosine * cosine);
  };
  bend.touches = true;
  const std::size_t leaves = edge.radius > 0.0 ? point + 1 : point;
  const double turn_rate = touch.winding * (swing(leaves) - swing(point - 1));
  const double slope_rate = turning_[point - 1].dot(along) + u.dot(omega.cross(along));
  bend.angle = touch.wrap * cosine;
  bend.rate = turn_rate * cosine - touch.wrap * slope / cosine * slope_rate;
  bend.middle = {
      .round = 0.5 * touch.winding * edge.radius * (touch.first_angle + touch.last_angle),
      .place = 0.5 * (touch.first_place + touch.last_place),
      .slope = slope};
}

// Takes a straight part, which ends at an edge of the path or at a point of the rope (-1), with
// the edges that it passes freely.
void RopeSplit::take_segment(const RopePath& path, std::size_t segment, const Vector3& p_W,
                             const Vector3& v_W, int edge, Cursor& at) {
  const Vector3& u = path.direction_W[segment];
  Segment& one = segments_[segment];
  one.first_length = at.bend;
  const auto passes = [&](const Bend& bend) {
    return bend.edge >= 0 && (edge >= 0 ? bend.edge < edge : bend.point < at.point);
  };
  if (!u.isZero(0.0)) {
    for (; at.bend < bends_.size() && passes(bends_[at.bend]); ++at.bend) {
      Bend& bend = bends_[at.bend];
      bend.touches = false;
      bend.angle = bend.rate = 0.0;
    }
  }
  one.velocity_W = v_W - at.v_W;
  one.length = u.dot(p_W - at.p_W);
  one.rate = u.dot(one.velocity_W);
  const auto parts = static_cast<double>(at.bend - one.first_length + 1);
  for (std::size_t i = one.first_length; i <= at.bend; ++i) {
    lengths_[i].length += one.length / parts;
    lengths_[i].rate += one.rate / parts;
  }
}

// Where the path comes to an edge: its arc, half of it to either side if the rope rubs there.
void RopeSplit::take_edge(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
                          std::size_t point, Cursor& at) {
  const int edge = path.edge[point];
  const auto index = static_cast<std::size_t>(edge);
  const double arc = path.touches[index].arc({.radius = rope.edges()[index].radius});
  lengths_[at.bend].length += 0.5 * arc;
  if (at.bend < bends_.size() && bends_[at.bend].edge == edge)
    wrap_edge(bends_[at.bend++], rope, kinematics, path, point);
  lengths_[at.bend].length += 0.5 * arc;
}

// Lengths, wraps and their rates.
void RopeSplit::measure(const Rope& rope, const Kinematics& kinematics, const RopePath& path) {
  rope.calc_turning(kinematics, path, turning_);
  for (Length& one : lengths_) one.length = one.rate = 0.0;
  segment_count_ = path.count - 1;
  Cursor at;
  int edge = -1;
  for (std::size_t k = 0; k < path.count; ++k) {
    const auto body = static_cast<std::size_t>(path.body[k]);
    const Vector3 p = kinematics.X_WB[body].p + path.r_W[k];
    const Vector3 v = shift(kinematics.V_WB[body], path.r_W[k]).linear;
    const int previous_edge = edge;
    edge = rope.edges().empty() ? -1 : path.edge[k];
    if (k > 0 && edge < 0) ++at.point;
    if (k > 0) take_segment(path, k - 1, p, v, edge, at);
    at.p_W = p;
    at.v_W = v;
    if (edge >= 0) {
      if (edge != previous_edge) take_edge(rope, kinematics, path, k, at);
    } else if (at.bend < bends_.size() && bends_[at.bend].edge < 0 &&
               bends_[at.bend].point == at.point && k > 0) {
      wrap_sheave(bends_[at.bend++], path, k);
    }
  }
  for (std::size_t j = 0; j < bends_.size(); ++j) {
    if (bends_[j].edge < 0 || !bends_[j].touches) continue;
    const double shift = bends_[j].shift();
    lengths_[j].length -= shift;
    lengths_[j + 1].length += shift;
  }
}

std::size_t RopeSplit::end_of_group(std::size_t first) const {
  std::size_t last = first;
  while (last < bends_.size() && !bends_[last].sticks()) ++last;
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
    const Bend& bend = bends_[i - 1];
    const double exponent = sign(bend.motion) * bend.friction;
    const double step = std::exp(-exponent * bend.angle);
    lengths_[i].ratio = lengths_[i - 1].ratio / step;
    lengths_[i].ratio_rate =
        lengths_[i - 1].ratio_rate / step + lengths_[i].ratio * exponent * bend.rate;
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
  // What passes a bend is what the lengths of the group beyond it gain.
  double gained = 0.0;
  for (std::size_t i = last; i > first; --i) {
    gained += lengths_[i].unstretched_rate;
    bends_[i - 1].slip_rate = gained;
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
    // What runs over a bend stretches nothing.
    if (i > first) rate -= bends_[i - 1].slip_rate * (one.share - lengths_[i - 1].share);
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
  for (Bend& bend : bends_) bend.slip_rate = 0.0;
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
      split.dissipated_power += bends_[i - 1].slip_rate * (drive(one) - drive(lengths_[i - 1]));
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
                     " has run over its sheave or edge; its winch moves too far, or its ends part");
  }
}

void RopeSplit::set_motion(std::size_t bend, BendMotion motion) {
  for (Length& one : lengths_) one.held = one.unstretched;
  bends_[bend].motion = motion;
}

void RopeSplit::carry(const Rope& rope, const Kinematics& kinematics, const RopePath& path) {
  measure(rope, kinematics, path);
  for (Bend& bend : bends_) {
    // Where it has just begun to touch it slips: only the sum of the lengths beside it counts.
    bend.carried = bend.touches && bend.is_carried ? bend.shift() : 0.0;
    bend.carried_middle = bend.middle;
    bend.is_carried = bend.touches && bend.edge >= 0;
  }
}

void RopeSplit::begin(const Rope& rope, const Kinematics& kinematics, const RopePath& path,
                      const RopeLoad& load) {
  acts_ = true;
  for (Bend& bend : bends_) {
    bend.carried = 0.0;
    bend.is_carried = false;
  }
  carry(rope, kinematics, path);
  const double X = std::max(0.0, load.elastic_force);
  const double EA = axial_stiffness_;
  for (Length& one : lengths_) {
    one.unstretched = (one.length - X * one.series) / (1.0 + X / EA);
    one.held = one.unstretched;
    one.compliance = one.series + one.unstretched / EA;
    one.elastic = X;
    one.ratio = 1.0;
  }
  for (std::size_t j = 0; j < bends_.size(); ++j) {
    Bend& bend = bends_[j];
    bend.motion = bend.touches ? BendMotion::sticks : BendMotion::to_last;
    if (X > no_strain * EA || !bend.touches) continue;
    const auto rate = [&](std::size_t i) {
      const double fed = i == 0 ? load.unstretched_rate : 0.0;
      return (lengths_[i].rate - fed) / lengths_[i].compliance;
    };
    const double capstan = std::exp(bend.friction * bend.angle);
    const double before = rate(j), behind = rate(j + 1);
    if (behind > capstan * before) bend.motion = BendMotion::to_last;
    if (before > capstan * behind) bend.motion = BendMotion::to_first;
  }
}

double RopeSplit::indicator(std::size_t bend) const {
  const Bend& at = bends_[bend];
  const bool slips = at.motion != BendMotion::sticks;
  if (!at.touches) return slips ? 1.0 : -1.0;
  const Length& a = lengths_[bend];
  const Length& b = lengths_[bend + 1];
  if (slips) return 1e-3 * sign(at.motion) * at.slip_rate / (a.compliance + b.compliance);
  const double capstan = std::exp(at.friction * at.angle);
  return 1e-3 * std::min(capstan * a.elastic - b.elastic, capstan * b.elastic - a.elastic);
}

BendMotion RopeSplit::tendency(std::size_t bend) const {
  return lengths_[bend + 1].elastic > lengths_[bend].elastic ? BendMotion::to_last
                                                             : BendMotion::to_first;
}

void RopeSplit::add_forces(const RopePath& path, std::vector<ForceVector>& F_Bo_W) const {
  for (std::size_t i = 0; i < path.count; ++i) {
    Vector3 f = Vector3::Zero();
    if (i < segment_count_) f += tension_of_segment(i) * path.direction_W[i];
    if (i > 0) f -= tension_of_segment(i - 1) * path.direction_W[i - 1];
    ForceVector& F = F_Bo_W[path.body[i]];
    F.moment += path.r_W[i].cross(f);
    F.force += f;
  }
}

void RopeSplit::add_derivatives(const Rope& rope, const Kinematics& kinematics,
                                const RopePath& path, ForceDerivatives& derivatives) const {
  for (std::size_t i = 0; i < path.count; ++i) {
    derivatives.locate(i, path.body[i], path.r_W[i]);
  }
  if (rope.edges().empty()) {
    for (std::size_t i = 0; i < segment_count_; ++i) {
      const Segment& one = segments_[i];
      derivatives.add_tension(i, i + 1, {path.direction_W[i], one.length, one.velocity_W},
                              tension_of_segment(i), 0.0, 0.0);
    }
  } else {
    std::array<double, most_points_over_edges> tensions;
    for (std::size_t i = 0; i < segment_count_; ++i) tensions[i] = tension_of_segment(i);
    rope.add_turning_over_edges(kinematics, path, {tensions.data(), segment_count_}, derivatives);
  }
  // The pull along segment i changes by the length of segment m, both towards the next point.
  const auto add = [&](std::size_t i, std::size_t m, double dT_dL, double dT_dLdot) {
    const Vector3& u = path.direction_W[m];
    const Segment& other = segments_[m];
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
  const auto lies_in = [&](std::size_t segment, std::size_t first, std::size_t last) {
    const std::size_t length = segments_[segment].first_length;
    return length >= first && length <= last && !path.direction_W[segment].isZero(0.0);
  };
  for (std::size_t first = 0; first < lengths_.size();) {
    const std::size_t last = end_of_group(first);
    double compliance = 0.0, weight = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      const double part = lengths_[i].yield * lengths_[i].compliance * lengths_[i].ratio;
      compliance += part;
      weight += part * lengths_[i].share;
    }
    for (std::size_t i = 0; i < segment_count_; ++i) {
      if (!lies_in(i, first, last)) continue;
      const Length& on = lengths_[segments_[i].first_length];
      for (std::size_t m = 0; m < segment_count_; ++m) {
        if (!lies_in(m, first, last)) continue;
        const Length& by = lengths_[segments_[m].first_length];
        const double stretches = by.yield * weight / compliance + (1.0 - by.yield) * by.share;
        add(i, m, on.ratio * by.yield / compliance, on.damping * on.share * stretches);
      }
    }
    first = last + 1;
  }
}

std::vector<RopeSplit> make_rope_splits(const std::vector<Rope>& ropes) {
  return {ropes.begin(), ropes.end()};
}

}  // namespace blocklift::dynamics

#include "dynamics/rope/rope.h"

#include <algorithm>
#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Shorter segments than this have no usable direction (m).
constexpr double shortest_segment = 1e-9;

void require_positive(const std::string& rope, const char* what, double value, bool finite) {
  if (!(value > 0.0) || (finite && !std::isfinite(value))) {
    throw ModelError("rope \"" + rope + "\" has the " + what + " " + std::to_string(value) +
                     "; a number above zero is due");
  }
}

void require_not_negative(const std::string& rope, const char* what, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw ModelError("rope \"" + rope + "\" has the " + what + " " + std::to_string(value) +
                     "; a finite number, zero or more, is due");
  }
}

}  // namespace

Rope::Rope(const Mechanism& mechanism, RopeDefinition definition)
    : definition_(std::move(definition)),
      crane_compliance_(1.0 / definition_.crane_stiffness),
      share_(definition_.twin_falls ? 0.5 : 1.0) {
  const RopeDefinition& d = definition_;
  if (d.points.size() < 2) {
    throw ModelError("rope \"" + d.name + "\" has " + std::to_string(d.points.size()) +
                     " point(s); two ends are due, sheaves between them at will");
  }
  if (!d.left_out.empty() && (d.left_out.size() + 1 != d.points.size() || d.left_out.front() != 0 ||
                              d.left_out.back() != 0)) {
    throw ModelError("rope \"" + d.name +
                     "\": which segments are left out is due for each of them, and it runs along "
                     "the first and the last");
  }
  if (d.twin_falls && d.left_out != std::vector<char>{0, 1, 0}) {
    throw ModelError("rope \"" + d.name +
                     "\" has twin falls; they have four points, and what lies between the second "
                     "and the third is left out");
  }
  for (std::size_t i = 0; i < d.points.size(); ++i) {
    const BodyPoint& point = d.points[i];
    if (point.body < 0 || point.body >= mechanism.body_count() || !point.p_BoQ_B.allFinite()) {
      throw ModelError("rope \"" + d.name + "\": point " + std::to_string(i) +
                       " is not a point of a body of the mechanism");
    }
    const bool bends =
        std::ranges::any_of(d.edges, [i](const RopeEdge& edge) { return edge.after + 1 == i; });
    if (i > 0 && runs(i - 1) && !bends && d.points[i - 1].body == point.body &&
        (d.points[i - 1].p_BoQ_B - point.p_BoQ_B).norm() < shortest_segment) {
      throw ModelError("rope \"" + d.name + "\": points " + std::to_string(i - 1) + " and " +
                       std::to_string(i) + " are the same point of \"" +
                       mechanism.body(point.body).name + "\"");
    }
  }
  if (d.tension_law) {
    require_sound_law();
  } else {
    require_positive(d.name, "axial stiffness", d.axial_stiffness, true);
  }
  require_positive(d.name, "crane stiffness", d.crane_stiffness, false);
  require_positive(d.name, "unstretched length", d.unstretched_length, true);
  require_not_negative(d.name, "damping time", d.damping_time);
  require_not_negative(d.name, "damping", d.damping);
  require_not_negative(d.name, "weight per length", d.weight_per_length);
  if (hangs() && d.points.size() > 2) {
    throw ModelError(
        "rope \"" + d.name +
        "\" has weight and runs over sheaves; only a rope from point to point hangs as "
        "a catenary");
  }
  require_not_negative(d.name, "sheave friction", d.sheave_friction);
  if (d.sheave_friction > 0.0 && (d.points.size() < 3 || !d.left_out.empty())) {
    throw ModelError(
        "rope \"" + d.name +
        "\" has friction at its sheaves; it must run over one, and along its whole path");
  }
  check_edges(mechanism);
  for (const RopeEdge& edge : d.edges) {
    const Vector3 along = (edge.end_B - edge.begin_B).normalized();
    edge_axes_.push_back(
        {along, (edge.outside_B - edge.outside_B.dot(along) * along).normalized()});
  }
}

void Rope::require_sound_law() const {
  const RopeDefinition& d = definition_;
  const auto refuse = [&](const char* what) {
    throw ModelError("rope \"" + d.name + "\" has a curve of tension over strain and " + what);
  };
  if (!std::isnan(d.axial_stiffness)) refuse("an axial stiffness; one of the two is due");
  if (hangs()) refuse("weight; only a rope of one stiffness hangs as a catenary");
  if (d.sheave_friction > 0.0)
    refuse("friction at its sheaves; ropes with friction have one stiffness");
  if (std::ranges::any_of(d.edges, [](const RopeEdge& edge) { return edge.friction > 0.0; }))
    refuse("friction at an edge; ropes with friction have one stiffness");
}

void Rope::calc_turning(const Kinematics& kinematics, const RopePath& path,
                        std::span<Vector3> turning) const {
  Vector3 p_previous = Vector3::Zero(), v_previous = Vector3::Zero();
  for (std::size_t i = 0; i < path.count; ++i) {
    const auto body = static_cast<std::size_t>(path.body[i]);
    const Vector3 p = kinematics.X_WB[body].p + path.r_W[i];
    const Vector3 v = shift(kinematics.V_WB[body], path.r_W[i]).linear;
    if (i > 0) {
      const Vector3& u = path.direction_W[i - 1];
      const Vector3 apart = v - v_previous;
      turning[i - 1].setZero();
      if (!u.isZero(0.0)) turning[i - 1] = (apart - u.dot(apart) * u) / u.dot(p - p_previous);
    }
    p_previous = p;
    v_previous = v;
  }
  if (!definition_.edges.empty()) add_sliding(kinematics, path, turning);
}

double Rope::stiffness(double unstretched_length, double tension) const {
  const double EA =
      definition_.tension_law
          ? definition_.tension_law->slope(definition_.tension_law->find_strain(tension))
          : definition_.axial_stiffness;
  return 1.0 / (unstretched_length / EA + crane_compliance_);
}

void Rope::calc_path(const Kinematics& kinematics, RopePath& path,
                     const RopeEndShifts* shifts) const {
  if (!definition_.edges.empty()) {
    calc_path_over_edges(kinematics, path);
    return;
  }
  const std::vector<BodyPoint>& points = definition_.points;
  path.count = points.size();
  double length = 0.0;
  double rate = 0.0;
  Vector3 p_previous = Vector3::Zero();
  Vector3 v_previous = Vector3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto body = static_cast<std::size_t>(points[i].body);
    const Pose& X_WB = kinematics.X_WB[body];
    const MotionVector& V_WB = kinematics.V_WB[body];
    Vector3 r = X_WB.R * points[i].p_BoQ_B;
    Vector3 v_in_body = Vector3::Zero();
    if (shifts && (i == 0 || i + 1 == points.size())) {
      const RopeEndShift& shift = i == 0 ? shifts->first : shifts->last;
      r += X_WB.R * shift.displacement_B;
      v_in_body = X_WB.R * shift.rate_B;
    }
    const Vector3 p = X_WB.p + r;
    const Vector3 v = V_WB.linear + V_WB.angular.cross(r) + v_in_body;
    path.r_W[i] = r;
    path.body[i] = points[i].body;
    if (i == 0) path.first_height = p.z();
    if (i > 0 && !runs(i - 1)) {
      path.direction_W[i - 1].setZero();
    } else if (i > 0) {
      const Vector3 span = p - p_previous;
      const double segment = span.norm();
      if (!(segment > shortest_segment)) {
        throw ModelError("rope \"" + definition_.name + "\": its points " + std::to_string(i - 1) +
                         " and " + std::to_string(i) +
                         " lie on one another, so the direction of its pull is undefined; "
                         "is it hoisted into its sheave?");
      }
      path.direction_W[i - 1] = span / segment;
      length += segment;
      rate += path.direction_W[i - 1].dot(v - v_previous);
    }
    p_previous = p;
    v_previous = v;
  }
  path.length = share_ * length;
  path.length_rate = share_ * rate;
}

// Elastic force, stiffness and its slope at the length and unstretched length of a load.
void Rope::stretch_by_law(RopeLoad& load) const {
  const TensionLaw& law = *definition_.tension_law;
  const double L0 = load.unstretched_length;
  const double strain = law.find_strain(load.elongation(), L0, crane_compliance_);
  const double EA = law.slope(strain);
  const double whole = L0 + EA * crane_compliance_;  // dL/de
  load.elastic_force = law.tension(strain);
  load.stiffness = EA / whole;
  load.stiffness_slope = law.curvature(strain) * L0 / (whole * whole * whole);
}

RopeLoad Rope::calc_elastic_and_damping(const RopePath& path, const RopeFeed& feed) const {
  if (!(feed.unstretched_length > 0.0)) {
    throw ModelError("rope \"" + definition_.name + "\": the winch has pulled it in to " +
                     std::to_string(feed.unstretched_length) +
                     " m; some length must stay out, so move the winch less");
  }
  RopeLoad load;
  load.length = path.length;
  load.length_rate = path.length_rate;
  load.unstretched_length = feed.unstretched_length;
  load.unstretched_rate = feed.rate;
  if (definition_.tension_law) {
    stretch_by_law(load);
  } else {
    load.stiffness = stiffness(feed.unstretched_length);
    load.elastic_force = load.stiffness * (path.length - feed.unstretched_length);
  }
  load.damping_force = damping(load.stiffness) * (path.length_rate - feed.rate);
  if (feed.parted) {
    load.elastic_force = -load.stiffness * feed.unstretched_length;
    load.damping_force = load.tension = 0.0;
  }
  if (hangs() && !feed.parted) hang(path, feed, load);
  return load;
}

RopeLoad Rope::calc_load(const RopePath& path, const RopeFeed& feed) const {
  RopeLoad load = calc_elastic_and_damping(path, feed);
  load.taut = load.slack_indicator() > 0.0;
  if (hangs()) return load;
  load.tension = one_sided_force(load.elastic_force, load.damping_force, load.taut);
  return load;
}

RopeLoad Rope::calc_load(const RopePath& path, const RopeFeed& feed, bool taut) const {
  RopeLoad load = calc_elastic_and_damping(path, feed);
  load.taut = taut;
  if (hangs()) return load;
  load.tension = one_sided_force(load.elastic_force, load.damping_force, taut);
  return load;
}

void Rope::add_forces(const RopePath& path, double tension,
                      std::vector<ForceVector>& F_Bo_W) const {
  const std::size_t last = path.count - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    Vector3 f = i < last ? path.direction_W[i] : Vector3(Vector3::Zero());
    if (i > 0) f -= path.direction_W[i - 1];
    f *= share_ * tension;
    ForceVector& F = F_Bo_W[path.body[i]];
    F.moment += path.r_W[i].cross(f);
    F.force += f;
  }
}

namespace {

// One segment of a path, from its point i to the next.
ForceDerivatives::Line segment(const Kinematics& kinematics, const std::vector<BodyPoint>& points,
                               const RopePath& path, std::size_t i) {
  const auto position = [&](std::size_t k) -> Vector3 {
    return kinematics.X_WB[points[k].body].p + path.r_W[k];
  };
  const auto velocity = [&](std::size_t k) {
    return shift(kinematics.V_WB[points[k].body], path.r_W[k]).linear;
  };
  const Vector3& u = path.direction_W[i];
  return {u, u.dot(position(i + 1) - position(i)), velocity(i + 1) - velocity(i)};
}

// dL/dp and dLdot/dp of one point of a path.
struct PathGradient {
  Vector3 of_length = Vector3::Zero();
  Vector3 of_rate = Vector3::Zero();

  PathGradient(const Kinematics& kinematics, const Rope& rope, const RopePath& path,
               std::size_t i) {
    const std::vector<BodyPoint>& points = rope.points();
    if (i > 0 && rope.runs(i - 1)) add(segment(kinematics, points, path, i - 1), 1.0);
    if (i + 1 < points.size() && rope.runs(i)) add(segment(kinematics, points, path, i), -1.0);
    of_length *= rope.share();
    of_rate *= rope.share();
  }

 private:
  void add(const ForceDerivatives::Line& line, double sign) {
    const Vector3& u = line.direction_W;
    const Vector3& v = line.relative_velocity_W;
    of_length += sign * u;
    of_rate += sign / line.length * (v - u.dot(v) * u);
  }
};

}  // namespace

// dT/dL of a load that is taut: where the stiffness grows with the stretch the damping does.
double Rope::calc_tension_slope(const RopeLoad& load) const {
  return load.stiffness + definition_.damping_time * load.stiffness_slope *
                              (load.length_rate - load.unstretched_rate);
}

void Rope::add_derivatives(const Kinematics& kinematics, const RopePath& path, const RopeLoad& load,
                           ForceDerivatives& derivatives) const {
  if (hangs()) {
    if (load.tension > 0.0) add_hanging_derivatives(kinematics, path, load, derivatives);
    return;
  }
  if (!load.taut) return;
  if (!definition_.edges.empty()) {
    add_derivatives_over_edges(kinematics, path, load, derivatives);
    return;
  }
  const std::vector<BodyPoint>& points = definition_.points;
  const double c = damping(load.stiffness);
  const double k = calc_tension_slope(load);
  for (std::size_t i = 0; i < points.size(); ++i) {
    derivatives.locate(i, points[i].body, path.r_W[i]);
  }
  const bool straight = points.size() == 2;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (!runs(i)) continue;
    derivatives.add_tension(i, i + 1, segment(kinematics, points, path, i), share_ * load.tension,
                            straight ? k : 0.0, straight ? c : 0.0);
  }
  if (straight) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 pull = -PathGradient(kinematics, *this, path, i).of_length;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const PathGradient g(kinematics, *this, path, j);
      derivatives.add_block(i, j, pull * (k * g.of_length + c * g.of_rate).transpose(),
                            c * pull * g.of_length.transpose());
    }
  }
}

// Elastic energy of the rope and of what it hangs from, J.
double Rope::calc_stored(double elastic_force, double unstretched_length, double stiffness) const {
  const double F = elastic_force;
  if (!definition_.tension_law) return 0.5 * F * F / stiffness;
  const TensionLaw& law = *definition_.tension_law;
  return unstretched_length * law.strain_energy(law.find_strain(F)) +
         0.5 * F * F * crane_compliance_;
}

// int e dF, what the winch takes in with each metre beside the tension, N.
double Rope::calc_complementary(double elastic_force) const {
  const double F = elastic_force;
  if (!definition_.tension_law) return 0.5 * F * F / definition_.axial_stiffness;
  const TensionLaw& law = *definition_.tension_law;
  const double strain = law.find_strain(F);
  return strain * F - law.strain_energy(strain);
}

EnergyAccount Rope::calc_energy(const RopeLoad& load) const {
  if (hangs()) {
    if (!(load.tension > 0.0)) return {};  // parted
    return {
        .stored_energy = load.hanging.stored_energy,
        .dissipated_power = load.damping_force * (load.length_rate - load.unstretched_rate),
        .supplied_power = load.unstretched_rate * (load.hanging.feed_force - load.damping_force)};
  }
  if (load.split.acts) {
    return {.stored_energy = load.split.stored_energy,
            .dissipated_power = load.split.dissipated_power,
            .supplied_power = -load.unstretched_rate * load.split.feed_force};
  }
  // Without kinks while the rope stays taut, or slack, by declaration: what lies beyond the change
  // is interpolated over.
  const double elastic = load.taut ? load.elastic_force : load.kept_force;
  if (!load.taut && elastic == 0.0) return {};
  const double dissipated =
      (load.taut ? load.damping_force : -elastic) * (load.length_rate - load.unstretched_rate);
  return {.stored_energy = calc_stored(elastic, load.unstretched_length, load.stiffness),
          .dissipated_power = dissipated,
          .supplied_power = -load.unstretched_rate * (load.tension + calc_complementary(elastic))};
}

RopePath make_rope_path(const std::vector<Rope>& ropes) {
  std::size_t most = 2, most_edges = 0;
  for (const Rope& rope : ropes) {
    most = std::max(most, rope.most_path_points());
    most_edges = std::max(most_edges, rope.edges().size());
  }
  RopePath path;
  path.body.assign(most, world_index);
  path.edge.assign(most, -1);
  path.touches.resize(most_edges);
  path.r_W.assign(most, Vector3::Zero());
  path.direction_W.assign(most - 1, Vector3::Zero());
  return path;
}

}  // namespace blocklift::dynamics

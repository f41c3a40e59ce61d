#include "dynamics/multibody/mechanism.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "algebra/decompositions.h"
#include "dynamics/errors.h"
#include "dynamics/multibody/message_text.h"

namespace blocklift::dynamics {
namespace {

// ---- checks of one body ------------------------------------------------------------------------

[[noreturn]] void fail(const std::string& body, const std::string& what) {
  throw ModelError("body \"" + body + "\": " + what);
}

std::string vector_text(const Vector3& a) {
  return text("(", a.x(), ", ", a.y(), ", ", a.z(), ")");
}

void check_inertia(const BodyDefinition& body) {
  if (!std::isfinite(body.mass)) fail(body.name, "no mass is given; say how many kg, or 0");
  if (body.mass < 0) {
    fail(body.name, text("its mass is ", body.mass, " kg; a mass is zero or positive"));
  }
  if (!body.p_BoBcm_B.allFinite()) fail(body.name, "its centre of mass is not finite");
  if (!body.I_BBcm_B.allFinite()) fail(body.name, "its inertia is not finite");
  const double size = body.I_BBcm_B.norm();
  if (body.mass == 0 && size > 0) {
    fail(body.name, "it has inertia but no mass; give it mass, or leave the inertia out");
  }
  if ((body.I_BBcm_B - body.I_BBcm_B.transpose()).norm() > 1e-9 * size) {
    fail(body.name, "its inertia matrix is not symmetric");
  }
  // Principal moments are sums of two second moments of the mass each: none may exceed the others'
  // sum.
  const Vector3 moments = algebra::symmetric_eigenvalues(body.I_BBcm_B);
  const double tolerance = 1e-6 * size;
  if (moments[0] < -tolerance || moments[2] > moments[0] + moments[1] + tolerance) {
    fail(body.name,
         text("no distribution of mass has the principal moments of inertia ", vector_text(moments),
              " kg m2; each is positive and at most the sum of the other two "
              "(they are about the centre of mass: check for a missing Steiner term)"));
  }
}

Vector3 unit(const std::string& body, const Vector3& axis, const char* which) {
  const double length = axis.norm();
  if (!(length > 0) || !std::isfinite(length)) {
    fail(body, text("its joint's ", which, " ", vector_text(axis),
                    " has no direction; give a vector of any length but zero"));
  }
  return axis / length;
}

Joint checked_joint(const BodyDefinition& body) {
  Joint joint = body.joint;
  const bool planar = joint.kind == JointKind::planar;
  joint.axis = unit(body.name, joint.axis, "axis");
  const bool unset = joint.second_axis.array().isNaN().all();
  if (joint.kind != JointKind::universal && !planar) return joint;
  if (unset) {
    // Planar about z gives x, universal about x gives y: the next axis that is not nearly parallel.
    Eigen::Index smallest = 0;
    joint.axis.cwiseAbs().minCoeff(&smallest);
    const Vector3 candidate = Vector3::Unit(smallest);
    joint.second_axis = (candidate - candidate.dot(joint.axis) * joint.axis).normalized();
    return joint;
  }
  joint.second_axis = unit(body.name, joint.second_axis, "second axis");
  const double cosine = joint.axis.dot(joint.second_axis);
  if (std::abs(cosine) > 1e-9) {
    fail(body.name, text("the two axes of its ", joint_kind_name(joint.kind), " joint enclose ",
                         std::acos(cosine) * 180.0 / M_PI, " degrees; 90 are due"));
  }
  return joint;
}

void check_pose(const BodyDefinition& body) {
  if (!body.X_PJ.p.allFinite() || !body.X_PJ.R.allFinite()) {
    fail(body.name, "the place of its joint in the parent is not finite");
  }
  const Matrix3& R = body.X_PJ.R;
  if ((R.transpose() * R - Matrix3::Identity()).norm() > 1e-9 || R.determinant() < 0) {
    fail(body.name, "the orientation of its joint in the parent is not a rotation matrix");
  }
}

// One value a velocity, or none at all.
template <class T>
std::vector<T> per_velocity(const BodyDefinition& body, const std::vector<T>& values,
                            const char* what) {
  const auto nv = static_cast<std::size_t>(velocity_count(body.joint.kind));
  if (values.empty()) return std::vector<T>(nv, T{});
  if (values.size() != nv) {
    fail(body.name, text("it has ", values.size(), " ", what, " values; its ",
                         joint_kind_name(body.joint.kind), " joint takes ", nv, " or none"));
  }
  return values;
}

void check_damping(const BodyDefinition& body) {
  for (const double d : body.damping) {
    if (!(d >= 0) || !std::isfinite(d)) {
      fail(body.name, text("its damping ", d, " is not allowed; it is zero or positive"));
    }
  }
}

void check_drive(const BodyDefinition& body) {
  const auto count = std::count(body.driven.begin(), body.driven.end(), true);
  if (velocities_are_rates(body.joint.kind) || count == 0) return;
  if (count != velocity_count(body.joint.kind)) {
    fail(body.name, text("only some velocities of its ", joint_kind_name(body.joint.kind),
                         " joint are driven; all or none can be"));
  }
}

std::string names_of(const std::vector<Body>& bodies) {
  std::string names;
  for (const Body& body : bodies) names += (names.empty() ? "" : ", ") + body.name;
  return names;
}

std::vector<Body>::const_iterator find_body(const std::vector<Body>& bodies,
                                            std::string_view name) {
  return std::find_if(bodies.begin(), bodies.end(),
                      [&](const Body& body) { return body.name == name; });
}

const Loop& loop_of_row(const std::vector<Loop>& loops, int row) {
  for (const Loop& loop : loops) {
    if (row >= loop.row_offset && row < loop.row_offset + loop.row_count) return loop;
  }
  throw ModelError(text("there is no row ", row, " among those of the loops"));
}

// ---- the mechanism's tables --------------------------------------------------------------------

// Which velocities of a joint turn the body.
std::vector<char> angular_columns(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return {};
    case JointKind::revolute:
      return {1};
    case JointKind::prismatic:
      return {0};
    case JointKind::cylindrical:
      return {1, 0};
    case JointKind::universal:
      return {1, 1};
    case JointKind::spherical:
      return {1, 1, 1};
    case JointKind::planar:
      return {0, 0, 1};
    case JointKind::translational:
      return {0, 0, 0};
    case JointKind::free:
      return {1, 1, 1, 0, 0, 0};
  }
  return {};
}

Link make_link(const Body& body, BodyIndex index, const RigidBodyInertia& inertia) {
  const Joint& joint = body.joint;
  const Matrix3& R_CJ = body.X_CJ.R;
  Link link{};
  link.kind = joint.kind;
  link.body = index;
  link.carrier = body.carrier;
  link.q_offset = body.q_offset;
  link.v_offset = body.v_offset;
  link.nv = body.nv();
  link.rotation_constant = R_CJ;
  link.rotation_sine = Matrix3::Zero();
  link.rotation_cosine = Matrix3::Zero();
  if (joint.kind == JointKind::revolute || joint.kind == JointKind::cylindrical ||
      joint.kind == JointKind::universal || joint.kind == JointKind::planar) {
    const Matrix3 outer = joint.axis * joint.axis.transpose();
    link.rotation_constant = R_CJ * outer;
    link.rotation_sine = R_CJ * skew(joint.axis);
    link.rotation_cosine = R_CJ - link.rotation_constant;
  }
  link.p_CJ = body.X_CJ.p;
  link.axis_C = R_CJ * joint.axis;
  link.second_axis_B = joint.second_axis;
  link.first_direction_C = R_CJ * joint.second_axis;
  link.second_direction_C = link.axis_C.cross(link.first_direction_C);
  link.mass = inertia.mass;
  link.mass_moment = inertia.mass * inertia.p_BoBcm;
  link.I_BBo = SpatialInertia::of(inertia).J;
  link.has_driven = std::count(body.driven.begin(), body.driven.end(), true) > 0;
  return link;
}

}  // namespace

// ---- Mechanism ---------------------------------------------------------------------------------

BodyIndex Mechanism::body_index(std::string_view name) const {
  const auto found = find_body(bodies_, name);
  if (found == bodies_.end()) {
    throw ModelError("there is no body \"" + std::string(name) +
                     "\"; the bodies are: " + names_of(bodies_));
  }
  return static_cast<BodyIndex>(found - bodies_.begin());
}

bool Mechanism::has_body(std::string_view name) const {
  return find_body(bodies_, name) != bodies_.end();
}

std::string Mechanism::velocity_name(int k) const {
  if (is_elastic_mode(k)) {
    const int mode = k - nv_ + static_cast<int>(elastic_modes_.size());
    return "\"" + elastic_modes_.at(mode).name + "\" (elastic mode)";
  }
  const Body& owner = body(body_of_velocity(k));
  std::string name = "\"" + owner.name + "\" (" + std::string(joint_kind_name(owner.joint.kind));
  if (owner.nv() > 1) {
    name += text(", velocity ", k - owner.v_offset + 1, " of ", owner.nv(), ", ",
                 angular_[k] ? "turning" : "displacing");
  }
  return name + ")";
}

int Mechanism::loop_index(std::string_view name) const {
  std::string names;
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    if (loops_[i].name == name) return static_cast<int>(i);
    names += (names.empty() ? "" : ", ") + loops_[i].name;
  }
  throw ModelError("there is no loop \"" + std::string(name) +
                   "\"; the loops are: " + (names.empty() ? "none" : names));
}

std::string Mechanism::loop_row_name(int row) const {
  const Loop& loop = loop_of_row(loops_, row);
  return "loop \"" + loop.name + "\", " + loop.row_name(row - loop.row_offset);
}

bool Mechanism::loop_row_is_angle(int row) const {
  const Loop& loop = loop_of_row(loops_, row);
  return loop.row_is_angle(row - loop.row_offset);
}

Eigen::VectorXd Mechanism::zero_configuration() const {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(nq_);
  for (const Body& body : bodies_) {
    q.segment(body.q_offset, body.nq()) = zero_coordinates(body.joint.kind);
  }
  return q;
}

void Mechanism::calc_rates(ConstVectorRef q, ConstVectorRef v, VectorRef rates) const {
  for (const Link& link : links_) {
    joint_rates(link.kind, q.data() + link.q_offset, v.data() + link.v_offset,
                rates.data() + link.q_offset);
  }
  for (const ElasticMode& mode : elastic_modes_) rates[mode.q_index] = v[mode.v_index];
}

void Mechanism::integrate(ConstVectorRef q, ConstVectorRef v, double s, VectorRef result) const {
  for (const Link& link : links_) {
    integrate_joint(link.kind, q.data() + link.q_offset, v.data() + link.v_offset, s,
                    result.data() + link.q_offset);
  }
  for (const ElasticMode& mode : elastic_modes_) {
    result[mode.q_index] = q[mode.q_index] + s * v[mode.v_index];
  }
}

void Mechanism::difference(ConstVectorRef q_from, ConstVectorRef q_to, VectorRef v) const {
  for (const Link& link : links_) {
    difference_joint(link.kind, q_from.data() + link.q_offset, q_to.data() + link.q_offset,
                     v.data() + link.v_offset);
  }
  for (const ElasticMode& mode : elastic_modes_) {
    v[mode.v_index] = q_to[mode.q_index] - q_from[mode.q_index];
  }
}

void Mechanism::normalise(VectorRef q) const {
  for (const Link& link : links_) {
    const auto offset = quaternion_offset(link.kind);
    if (!offset) continue;
    auto quaternion = q.segment<4>(link.q_offset + *offset);
    const double length = quaternion.norm();
    if (!(length > 0) || !std::isfinite(length)) {
      throw SimulationError(text("body \"", body(link.body).name,
                                 "\": its quaternion has the length ", length,
                                 "; it must be finite and not zero"));
    }
    quaternion /= length;
  }
}

// ---- MechanismBuilder --------------------------------------------------------------------------

Body MechanismBuilder::world() {
  Body world;
  world.name = world_name;
  world.X_PJ = world.X_CJ = Pose::identity();
  world.inertia = RigidBodyInertia::zero();
  return world;
}

BodyIndex MechanismBuilder::add_body(const BodyDefinition& definition) {
  if (definition.name.empty()) throw ModelError("a body has no name; each needs one of its own");
  if (is_taken(definition.name)) {
    fail(definition.name, "there is a body or mode of this name already; names must differ");
  }
  const auto parent = find_body(bodies_, definition.parent);
  if (parent == bodies_.end()) {
    fail(definition.name,
         "its parent \"" + definition.parent +
             "\" is not there; parents come before children, and so far there are: " +
             names_of(bodies_));
  }
  check_inertia(definition);
  check_pose(definition);
  check_damping(definition);
  Body body;
  body.name = definition.name;
  body.parent = static_cast<BodyIndex>(parent - bodies_.begin());
  body.joint = checked_joint(definition);
  body.X_PJ = definition.X_PJ;
  const bool parent_moves = parent->nv() > 0 || body.parent == world_index;
  body.carrier = parent_moves ? body.parent : parent->carrier;
  body.X_CJ = parent_moves ? definition.X_PJ : parent->X_CJ * definition.X_PJ;
  const Matrix3 symmetric = 0.5 * (definition.I_BBcm_B + definition.I_BBcm_B.transpose());
  body.inertia = {definition.mass, definition.p_BoBcm_B, Symmetric3::of(symmetric)};
  body.damping = per_velocity(definition, definition.damping, "damping");
  body.driven = per_velocity(definition, definition.driven, "drive");
  check_drive(definition);
  body.q_offset = bodies_.back().q_offset + bodies_.back().nq();
  body.v_offset = bodies_.back().v_offset + bodies_.back().nv();
  bodies_.push_back(std::move(body));
  return static_cast<BodyIndex>(bodies_.size()) - 1;
}

bool MechanismBuilder::is_taken(const std::string& name) const {
  return find_body(bodies_, name) != bodies_.end() ||
         std::any_of(elastic_modes_.begin(), elastic_modes_.end(),
                     [&](const ElasticModeDefinition& mode) { return mode.name == name; });
}

int MechanismBuilder::add_elastic_mode(const ElasticModeDefinition& definition) {
  const auto refuse = [&](const std::string& what) {
    throw ModelError("elastic mode \"" + definition.name + "\": " + what);
  };
  const auto is_positive = [](double value) { return value > 0 && std::isfinite(value); };
  if (definition.name.empty()) throw ModelError("an elastic mode has no name; each needs one");
  if (is_taken(definition.name)) refuse("there is a body or mode of this name already");
  if (definition.body <= world_index || definition.body >= static_cast<int>(bodies_.size()))
    refuse("the body that vibrates is not there; it comes before its modes");
  if (!is_positive(definition.modal_mass))
    refuse(text("its mass is ", definition.modal_mass, " kg; it must be positive"));
  if (!is_positive(definition.angular_frequency))
    refuse(text("its frequency is ", definition.angular_frequency, " rad/s; it must be positive"));
  if (!(definition.damping_ratio >= 0) || !std::isfinite(definition.damping_ratio))
    refuse(text("its damping ratio is ", definition.damping_ratio, "; it is zero or positive"));
  elastic_modes_.push_back(definition);
  return static_cast<int>(elastic_modes_.size()) - 1;
}

int MechanismBuilder::add_loop(const LoopDefinition& definition) {
  for (const Loop& loop : loops_) {
    if (loop.name == definition.name) {
      throw ModelError("loop \"" + definition.name +
                       "\": there is a loop of this name already; names must differ");
    }
  }
  Loop loop = make_loop(definition, bodies_);
  loop.row_offset = loops_.empty() ? 0 : loops_.back().row_offset + loops_.back().row_count;
  loops_.push_back(std::move(loop));
  return static_cast<int>(loops_.size()) - 1;
}

void MechanismBuilder::check_carried_mass() const {
  std::vector<double> carried(bodies_.size());
  for (std::size_t i = bodies_.size() - 1; i > 0; --i) {
    const Body& body = bodies_[i];
    carried[i] += body.inertia.mass;
    carried[body.parent] += carried[i];
    const bool all_driven = std::count(body.driven.begin(), body.driven.end(), true) == body.nv();
    if (carried[i] == 0 && !all_driven) {
      fail(body.name, text("its ", joint_kind_name(body.joint.kind),
                           " joint moves freely but carries no mass, so its acceleration is "
                           "undefined; give the body or one that it carries a mass, or drive it"));
    }
  }
}

Mechanism MechanismBuilder::build() const {
  if (!gravity_.allFinite()) throw ModelError("the acceleration of gravity is not finite");
  check_carried_mass();
  Mechanism m;
  m.bodies_ = bodies_;
  m.loops_ = loops_;
  m.loop_rows_ = loops_.empty() ? 0 : loops_.back().row_offset + loops_.back().row_count;
  m.gravity_ = gravity_;
  m.nq_ = bodies_.back().q_offset + bodies_.back().nq();
  m.nv_ = bodies_.back().v_offset + bodies_.back().nv();
  // A link has the inertia of all bodies fixed to it.
  std::vector<RigidBodyInertia> inertias(bodies_.size(), RigidBodyInertia::zero());
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const bool moves = bodies_[i].nv() > 0;
    if (!moves) m.fixed_bodies_.push_back(static_cast<BodyIndex>(i));
    RigidBodyInertia& sum = inertias[moves ? i : static_cast<std::size_t>(bodies_[i].carrier)];
    const Pose X = moves ? Pose::identity() : bodies_[i].X_CJ;
    sum = sum + transform(X, bodies_[i].inertia);
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const auto index = static_cast<BodyIndex>(i);
    if (body.nv() > 0) m.links_.push_back(make_link(body, index, inertias[i]));
    const std::vector<char> angular = angular_columns(body.joint.kind);
    m.angular_.insert(m.angular_.end(), angular.begin(), angular.end());
    m.damping_.insert(m.damping_.end(), body.damping.begin(), body.damping.end());
    const bool rates = velocities_are_rates(body.joint.kind);
    for (int k = 0; k < body.nv(); ++k) {
      const bool driven = body.driven[k];
      m.driven_.push_back(driven);
      m.velocity_body_.push_back(index);
      (driven ? m.driven_v_ : m.free_v_).push_back(body.v_offset + k);
    }
    for (int k = 0; k < body.nq(); ++k) {
      const bool driven = body.driven[rates ? static_cast<std::size_t>(k) : 0];
      (driven ? m.driven_q_ : m.free_q_).push_back(body.q_offset + k);
    }
  }
  for (const ElasticModeDefinition& definition : elastic_modes_) {
    const ElasticMode& mode =
        m.elastic_modes_.emplace_back(ElasticMode{definition, m.nq_++, m.nv_++});
    m.angular_.push_back(0);
    m.damping_.push_back(mode.damping());
    m.driven_.push_back(0);
    m.velocity_body_.push_back(mode.body);
    m.free_v_.push_back(mode.v_index);
    m.free_q_.push_back(mode.q_index);
  }
  return m;
}

}  // namespace blocklift::dynamics

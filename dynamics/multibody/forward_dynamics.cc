#include "dynamics/multibody/forward_dynamics.h"

#include <algorithm>
#include <cmath>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using ArticulatedBody = ForwardDynamicsWorkspace::ArticulatedBody;
using Column = ForwardDynamicsWorkspace::Column;

// A free velocity counts as unresisted below this part of the articulated body's own inertia.
constexpr double singular = 1e-13;

// Names the first body, counted from the world, whose motion or force is not finite.
[[noreturn]] void report_not_finite(const Mechanism& mechanism, const Kinematics& kinematics,
                                    const std::vector<ForceVector>& F_Bo_W, const double* vdot) {
  for (std::size_t b = 1; b < F_Bo_W.size(); ++b) {
    const std::string start = "body \"" + mechanism.bodies()[b].name + "\": ";
    if (!kinematics.X_WB[b].R.allFinite() || !kinematics.X_WB[b].p.allFinite()) {
      throw SimulationError(start +
                            "its pose is not finite, because its joint's coordinates are not "
                            "(or its quaternion is zero)");
    }
    const MotionVector& V = kinematics.V_WB[b];
    if (!V.angular.allFinite() || !V.linear.allFinite()) {
      throw SimulationError(start + "its velocity is not finite");
    }
    if (!F_Bo_W[b].moment.allFinite() || !F_Bo_W[b].force.allFinite()) {
      throw SimulationError(start + "the external force on it is not finite");
    }
  }
  for (const ElasticMode& mode : mechanism.elastic_modes()) {
    if (std::isfinite(vdot[mode.v_index])) continue;
    throw SimulationError("elastic mode \"" + mode.name +
                          "\": its velocity, or the force on it, is not finite");
  }
  throw SimulationError(
      "a joint force, or a prescribed acceleration, is not finite, or the state is "
      "so large that accelerations overflow");
}

[[noreturn]] void report_singular(const Mechanism& mechanism, int k) {
  const std::string name = mechanism.velocity_name(k);
  throw SimulationError(
      "body " + name +
      ": nothing resists this motion in the present configuration (the articulated "
      "inertia along it is zero); give the body or what it carries mass or inertia "
      "about that axis, or drive the joint");
}

// Inertia of a link alone and the force that its velocity, gravity and the external force ask for.
void start_link(const Link& link, const Kinematics& kinematics, const Vector3& gravity,
                const ForceVector& F_Bo_W, ArticulatedBody& body) {
  const auto b = static_cast<std::size_t>(link.body);
  const Matrix3& R = kinematics.X_WB[b].R;
  const Vector3& w = kinematics.V_WB[b].angular;
  const Vector3 h = R * link.mass_moment;
  body.inertia.J = rotate(R, link.I_BBo);
  body.inertia.H << 0, -h.z(), h.y(), h.z(), 0, -h.x(), -h.y(), h.x(), 0;
  body.inertia.M = {link.mass, 0, 0, link.mass, 0, link.mass};
  body.bias.moment = w.cross(body.inertia.J * w) - h.cross(gravity) - F_Bo_W.moment;
  body.bias.force = w.cross(w.cross(h)) - link.mass * gravity - F_Bo_W.force;
}

// U = inertia S for the column S along `direction`; returns S^T U.
double column_inertia(const SpatialInertia& inertia, bool angular, const Vector3& direction,
                      Column& column) {
  if (angular) {
    column.U_moment = inertia.J * direction;
    column.U_force.noalias() = inertia.H.transpose() * direction;
    return direction.dot(column.U_moment);
  }
  column.U_moment.noalias() = inertia.H * direction;
  column.U_force = inertia.M * direction;
  return direction.dot(column.U_force);
}

double along(bool angular, const Vector3& direction, const ForceVector& F) {
  return direction.dot(angular ? F.moment : F.force);
}

// inertia -= U U^T / D, bias += U u / D: the motion along one free velocity gives way (eq. 17, 18).
void give_way(const Column& column, ArticulatedBody& body) {
  const double s = column.inverse_D;
  body.inertia.J.add_outer(-s, column.U_moment);
  body.inertia.M.add_outer(-s, column.U_force);
  const Vector3 scaled = s * column.U_force;
  body.inertia.H.noalias() -= column.U_moment * scaled.transpose();
  const double force = s * column.u;
  body.bias.moment += force * column.U_moment;
  body.bias.force += force * column.U_force;
}

class Recursion {
 public:
  Recursion(const Mechanism& mechanism, const Kinematics& kinematics, const double* v,
            ForwardDynamicsWorkspace& workspace, double* tau, double* vdot, DriveForces drives)
      : mechanism_(mechanism),
        kinematics_(kinematics),
        v_(v),
        workspace_(workspace),
        tau_(tau),
        vdot_(vdot),
        angular_(mechanism.angular().data()),
        driven_(mechanism.driven().data()),
        damping_(mechanism.damping().data()),
        drives_(drives) {}

  void start(const std::vector<ForceVector>& F_Bo_W) {
    for (const Link& link : mechanism_.links()) {
      if (is_idle(link.body)) continue;
      start_link(link, kinematics_, mechanism_.gravity(), F_Bo_W[index(link.body)],
                 workspace_.articulated[index(link.body)]);
    }
    for (const BodyIndex i : mechanism_.fixed_bodies()) {
      const BodyIndex carrier = mechanism_.bodies()[index(i)].carrier;
      if (carrier == world_index || is_idle(carrier)) continue;
      ForceVector& bias = workspace_.articulated[index(carrier)].bias;
      bias = bias - shift_to(F_Bo_W[index(i)], kinematics_.p_CB_W[index(i)]);
    }
  }

  // Towards the base (eq. 17, 18). False if the inertia is not finite.
  bool inwards(const Link& link) {
    if (is_idle(link.body)) return true;
    const std::size_t b = index(link.body);
    ArticulatedBody& body = workspace_.articulated[b];
    const MotionVector& c = kinematics_.A_bias_W[b];
    if (link.has_driven) known_motion(link, body);
    body.bias += body.inertia * c;
    const double angular_scale = singular * body.inertia.J.trace();
    const double linear_scale = singular * body.inertia.M.trace();
    for (int k = link.v_offset; k < link.v_offset + link.nv; ++k) {
      if (driven_[k]) continue;
      Column& column = workspace_.columns[index(k)];
      const Vector3& direction = kinematics_.direction_W[index(k)];
      const double D = column_inertia(body.inertia, angular_[k], direction, column);
      if (!(D > (angular_[k] ? angular_scale : linear_scale))) {
        if (std::isfinite(D)) report_singular(mechanism_, k);
        return false;
      }
      column.inverse_D = 1.0 / D;
      column.u = tau_[k] - damping_[k] * v_[k] - along(angular_[k], direction, body.bias);
      give_way(column, body);
    }
    if (link.carrier == world_index || is_idle(link.carrier)) return true;
    ArticulatedBody& carrier = workspace_.articulated[index(link.carrier)];
    const Vector3& r = kinematics_.p_CB_W[b];
    add_shifted(body.inertia, r, carrier.inertia);
    carrier.bias.force += body.bias.force;
    carrier.bias.moment += body.bias.moment + r.cross(body.bias.force);
    return true;
  }

  // An elastic mode moves no body: it answers the force on it alone.
  void vibrate(const ElasticMode& mode) const {
    const int k = mode.v_index;
    vdot_[k] = (tau_[k] - damping_[k] * v_[k]) / mode.modal_mass;
  }

  // Away from the base (eq. 15, 16).
  void outwards(const Link& link) {
    const std::size_t b = index(link.body);
    MotionVector& A = workspace_.A_WB[b];
    A = shift(workspace_.A_WB[index(link.carrier)], kinematics_.p_CB_W[b]);
    for (int k = link.v_offset + link.nv - 1; k >= link.v_offset; --k) {
      if (driven_[k]) continue;
      const Column& column = workspace_.columns[index(k)];
      vdot_[k] = column.inverse_D *
                 (column.u - column.U_moment.dot(A.angular) - column.U_force.dot(A.linear));
      (angular_[k] ? A.angular : A.linear) += vdot_[k] * kinematics_.direction_W[index(k)];
    }
    if (link.has_driven) add_known_motion(link, A);
    A.angular += kinematics_.A_bias_W[b].angular;
    A.linear += kinematics_.A_bias_W[b].linear;
    if (link.has_driven && drives_ == DriveForces::wanted) drive_forces(link, A);
  }

  void carry_fixed_bodies() {
    for (const BodyIndex i : mechanism_.fixed_bodies()) {
      const BodyIndex carrier = mechanism_.bodies()[index(i)].carrier;
      workspace_.A_WB[index(i)] =
          shift(workspace_.A_WB[index(carrier)], kinematics_.p_CB_W[index(i)]) +
          kinematics_.A_bias_W[index(i)];
    }
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // Does nobody ask what it takes to accelerate the body?
  bool is_idle(BodyIndex body) const {
    return drives_ == DriveForces::unwanted && workspace_.prescribed[index(body)] != 0;
  }

  // Driven velocities: their accelerations are known, so they only shift the bias.
  void known_motion(const Link& link, ArticulatedBody& body) {
    const ForceVector bias = body.bias;
    for (int k = link.v_offset; k < link.v_offset + link.nv; ++k) {
      if (!driven_[k]) continue;
      Column& column = workspace_.columns[index(k)];
      const Vector3& direction = kinematics_.direction_W[index(k)];
      column_inertia(body.inertia, angular_[k], direction, column);
      column.u = along(angular_[k], direction, bias);
      body.bias.moment += vdot_[k] * column.U_moment;
      body.bias.force += vdot_[k] * column.U_force;
    }
  }

  void add_known_motion(const Link& link, MotionVector& A) const {
    for (int k = link.v_offset; k < link.v_offset + link.nv; ++k) {
      if (!driven_[k]) continue;
      (angular_[k] ? A.angular : A.linear) += vdot_[k] * kinematics_.direction_W[index(k)];
    }
  }

  void drive_forces(const Link& link, const MotionVector& A) const {
    for (int k = link.v_offset; k < link.v_offset + link.nv; ++k) {
      if (!driven_[k]) continue;
      const Column& column = workspace_.columns[index(k)];
      tau_[k] = column.U_moment.dot(A.angular) + column.U_force.dot(A.linear) + column.u +
                damping_[k] * v_[k];
    }
  }

  const Mechanism& mechanism_;
  const Kinematics& kinematics_;
  const double* v_;
  ForwardDynamicsWorkspace& workspace_;
  double* tau_;
  double* vdot_;
  const char* angular_;
  const char* driven_;
  const double* damping_;
  DriveForces drives_;
};

}  // namespace

ForwardDynamicsWorkspace::ForwardDynamicsWorkspace(const Mechanism& mechanism)
    : A_WB(static_cast<std::size_t>(mechanism.body_count())),
      articulated(A_WB.size()),
      columns(static_cast<std::size_t>(mechanism.nv())),
      prescribed(A_WB.size(), 0) {
  A_WB[0] = MotionVector::zero();
  prescribed[0] = 1;
  for (const Link& link : mechanism.links()) {
    const auto driven = mechanism.driven().begin() + link.v_offset;
    prescribed[link.body] =
        prescribed[link.carrier] != 0 && std::count(driven, driven + link.nv, 0) == 0 ? 1 : 0;
  }
}

void compute_forward_dynamics(const Mechanism& mechanism, const Kinematics& kinematics,
                              ConstVectorRef v, const std::vector<ForceVector>& F_Bo_W,
                              ForwardDynamicsWorkspace& workspace, VectorRef tau, VectorRef vdot,
                              DriveForces drives) {
  eigen_assert(v.size() == mechanism.nv() && tau.size() == v.size() && vdot.size() == v.size());
  Recursion recursion(mechanism, kinematics, v.data(), workspace, tau.data(), vdot.data(), drives);
  recursion.start(F_Bo_W);
  const std::vector<Link>& links = mechanism.links();
  bool finite = true;
  for (const ElasticMode& mode : mechanism.elastic_modes()) recursion.vibrate(mode);
  for (auto link = links.rbegin(); link != links.rend(); ++link) {
    finite = finite && recursion.inwards(*link);
  }
  if (finite) {
    for (const Link& link : links) recursion.outwards(link);
    recursion.carry_fixed_bodies();
  }
  // One number that is not finite makes this sum so.
  if (!finite || !std::isfinite(vdot.sum()))
    report_not_finite(mechanism, kinematics, F_Bo_W, vdot.data());
}

}  // namespace blocklift::dynamics

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dynamics/multibody/body_index.h"
#include "dynamics/multibody/joint.h"
#include "dynamics/multibody/loop_definition.h"
#include "dynamics/spatial/spatial_inertia.h"

namespace blocklift::dynamics {

/// What a modeller says about a body B and the joint that carries it.
struct BodyDefinition {
  std::string name;
  std::string parent{world_name};  ///< name of the body P that carries B
  Joint joint;
  Pose X_PJ = Pose::identity();         ///< joint frame in the parent's body frame
  double mass = not_a_number;           ///< kg; zero is allowed where a child carries mass
  Vector3 p_BoBcm_B = Vector3::Zero();  ///< centre of mass, m
  Matrix3 I_BBcm_B = Matrix3::Zero();   ///< about the centre of mass, in B, kg m2
  /// Viscous damping for each v of the joint (N s/m or N m s): tau = -d v. Empty: none.
  std::vector<double> damping = {};
  /// Which v of the joint follow a prescribed motion. Empty: none. Where v is dq/dt, each has its
  /// own profile; spherical and free are driven as a whole, along a fixed direction n of v by one
  /// profile s(t): q = q0 (+) s n (integrate_joint), v = n ds/dt, vdot = n d2s/dt2, which is exact.
  std::vector<bool> driven = {};
};

/// A natural mode of a body that gives way: a coordinate eta of its own, which moves no body's
/// frame and so has neither weight nor momentum. With f the generalised force on it (N),
///   m (eta'' + 2 zeta omega eta') = f:
/// inertia and damping are the mechanism's, the spring m omega^2 is of whoever knows the shape. A
/// shape phi that is normalised to phi^T M phi = m, m being the body's mass, makes eta the root of
/// the mean square displacement over the mass, in m.
struct ElasticModeDefinition {
  std::string name;
  BodyIndex body = -1;                      ///< that vibrates
  double modal_mass = not_a_number;         ///< m, kg
  double angular_frequency = not_a_number;  ///< omega of the free body, rad/s
  double damping_ratio = 0.0;               ///< zeta: of the critical damping
};

/// One elastic mode of a mechanism, immutable.
struct ElasticMode : ElasticModeDefinition {
  int q_index = -1;  ///< of eta within q
  int v_index = -1;  ///< of its rate within v

  double stiffness() const { return modal_mass * angular_frequency * angular_frequency; }  ///< N/m
  double damping() const {
    return 2.0 * damping_ratio * modal_mass * angular_frequency;
  }  ///< N s/m
};

/// One body of a mechanism, immutable.
struct Body {
  std::string name;
  BodyIndex parent = -1;  ///< -1 for the world
  /// The parent, or if that is on a fixed joint, the first body towards the world that is not.
  BodyIndex carrier = -1;
  Joint joint;                  ///< axes of unit length
  Pose X_PJ;                    ///< joint frame in the parent
  Pose X_CJ;                    ///< joint frame in the carrier
  RigidBodyInertia inertia;     ///< of this body alone
  int q_offset = 0;             ///< first coordinate within q
  int v_offset = 0;             ///< first velocity within v
  std::vector<double> damping;  ///< for each v
  std::vector<bool> driven;     ///< for each v

  int nq() const { return coordinate_count(joint.kind); }
  int nv() const { return velocity_count(joint.kind); }
};

/// A moving body as the recursive algorithms see it: bodies fixed to it are part of its inertia.
struct Link {
  JointKind kind;
  BodyIndex body;
  BodyIndex carrier;  ///< 0: the world
  int q_offset;
  int v_offset;
  int nv;
  // Joints that turn about an axis: R_CB = rotation_constant + sin(q) rotation_sine
  // + cos(q) rotation_cosine (Rodrigues' formula). Others: rotation_constant = R_CJ.
  Matrix3 rotation_constant;
  Matrix3 rotation_sine;
  Matrix3 rotation_cosine;
  Vector3 p_CJ;                ///< joint's origin in the carrier
  Vector3 axis_C;              ///< first axis, in the carrier
  Vector3 first_direction_C;   ///< planar: first displacement's direction, in the carrier
  Vector3 second_direction_C;  ///< planar: second displacement's direction
  Vector3 second_axis_B;       ///< universal: second axis, in the body (and joint) frame
  double mass;                 ///< with fixed bodies, kg
  Vector3 mass_moment;         ///< mass times centre of mass, in B, kg m
  Symmetric3 I_BBo;            ///< about Bo, in B, kg m2
  bool has_driven;             ///< does any of its velocities follow a prescribed motion?
};

/// Tree of bodies joined by joints, with loops over it: immutable, shared by all states and
/// threads.
///
/// Looking up by name is for set-up only. Indices order everything: body i of the mechanism is
/// entry i of every per-body array, and body i's joint owns q[q_offset ..] and v[v_offset ..]. The
/// coordinates and velocities of elastic modes, one a mode, stand behind those of all joints.
class Mechanism {
 public:
  int body_count() const { return static_cast<int>(bodies_.size()); }  ///< with the world
  int nq() const { return nq_; }
  int nv() const { return nv_; }
  const Vector3& gravity() const { return gravity_; }  ///< acceleration of gravity in W, m/s2

  const Body& body(BodyIndex i) const { return bodies_.at(i); }
  const std::vector<Body>& bodies() const { return bodies_; }
  /// @throws ModelError if no body has that name; the message lists those that exist.
  BodyIndex body_index(std::string_view name) const;
  bool has_body(std::string_view name) const;

  const std::vector<Link>& links() const { return links_; }
  /// Bodies on a fixed joint, parents first.
  const std::vector<BodyIndex>& fixed_bodies() const { return fixed_bodies_; }

  /// Natural modes of bodies that give way, in the order in which they were added.
  const std::vector<ElasticMode>& elastic_modes() const { return elastic_modes_; }
  /// Is entry k of v the rate of an elastic mode?
  bool is_elastic_mode(int k) const { return k >= nv_ - static_cast<int>(elastic_modes_.size()); }

  /// For each v: does it follow a prescribed motion?
  const std::vector<char>& driven() const { return driven_; }
  /// For each v: does it turn the body (true) or displace it (false)?
  const std::vector<char>& angular() const { return angular_; }
  /// For each v, viscous damping, N s/m or N m s.
  const std::vector<double>& damping() const { return damping_; }
  /// The body whose joint owns entry k of v, or that vibrates in the elastic mode.
  BodyIndex body_of_velocity(int k) const { return velocity_body_.at(k); }
  /// "trolley (prismatic)", "hook (universal, second angle)" or "beam.mode_1 (elastic mode)": entry
  /// k of v in words.
  std::string velocity_name(int k) const;

  const std::vector<int>& free_velocities() const { return free_v_; }  ///< integrated entries of v
  const std::vector<int>& driven_velocities() const {
    return driven_v_;
  }                                                                     ///< prescribed entries of v
  const std::vector<int>& free_coordinates() const { return free_q_; }  ///< integrated entries of q
  const std::vector<int>& driven_coordinates() const {
    return driven_q_;
  }  ///< prescribed entries of q

  /// Loops in the order in which they were added; empty for a tree.
  const std::vector<Loop>& loops() const { return loops_; }
  /// Number of scalar equations of all loops.
  int loop_row_count() const { return loop_rows_; }
  /// @throws ModelError if no loop has that name; the message lists those that exist.
  int loop_index(std::string_view name) const;
  /// "loop "hinge_6", rotation about x": a row among those of all loops in words.
  std::string loop_row_name(int row) const;
  /// Is that row an angle (rad) rather than a length (m)?
  bool loop_row_is_angle(int row) const;
  /// The same mechanism with the lengths of rods and ropes and the offsets of gears that were left
  /// open taken from the configuration q.
  Mechanism with_loops_as_at(ConstVectorRef q) const;

  /// q at which every body coincides with its joint frame.
  Eigen::VectorXd zero_configuration() const;
  /// dq/dt from q and v (sizes nq, nv, nq).
  void calc_rates(ConstVectorRef q, ConstVectorRef v, VectorRef rates) const;
  /// result = q (+) s v on the manifold of poses; see integrate_joint. `result` may be `q`.
  void integrate(ConstVectorRef q, ConstVectorRef v, double s, VectorRef result) const;
  /// The v that carries q_from to q_to in one second; see difference_joint.
  void difference(ConstVectorRef q_from, ConstVectorRef q_to, VectorRef v) const;
  /// Scales every quaternion in q back to unit length.
  /// @throws SimulationError if one is zero or not finite, naming the body.
  void normalise(VectorRef q) const;

 private:
  friend class MechanismBuilder;
  Mechanism() = default;

  std::vector<Body> bodies_;
  std::vector<Link> links_;
  std::vector<ElasticMode> elastic_modes_;
  std::vector<BodyIndex> fixed_bodies_;
  std::vector<BodyIndex> velocity_body_;
  std::vector<char> driven_;
  std::vector<char> angular_;
  std::vector<double> damping_;
  std::vector<int> free_v_, driven_v_, free_q_, driven_q_;
  std::vector<Loop> loops_;
  int loop_rows_ = 0;
  Vector3 gravity_ = Vector3::Constant(not_a_number);
  int nq_ = 0;
  int nv_ = 0;
};

/// Collects bodies and makes a mechanism of them.
class MechanismBuilder {
 public:
  /// Standard gravity, 9.80665 m/s2 along -z, unless set.
  void set_gravity(const Vector3& gravity_W) { gravity_ = gravity_W; }

  /// Adds a body; its parent must have been added before.
  /// @returns its index in the mechanism.
  /// @throws ModelError if the name is empty or taken, the parent unknown, the mass negative or
  /// missing, the inertia impossible for any distribution of mass, an axis without length,
  /// universal axes not perpendicular, or damping or drives not one a velocity.
  BodyIndex add_body(const BodyDefinition& definition);

  /// Adds a natural mode of a body that has been added before.
  /// @returns its index among the elastic modes.
  /// @throws ModelError if the name is empty or taken, the body is not there or is the world, mass
  ///   or frequency is not positive, or the damping negative.
  int add_elastic_mode(const ElasticModeDefinition& definition);

  /// Adds a loop; its bodies must have been added before.
  /// @returns its index among the loops.
  /// @throws ModelError if the name is empty or taken, a body unknown, both bodies are the same or
  /// fixed to each other, an axis without length, a frame not a rotation, universal axes not
  /// perpendicular, a length not positive, a ratio zero or missing, a geared joint without such a
  /// coordinate or both of them driven, a path too short, or if something is given that the kind
  /// does not use.
  int add_loop(const LoopDefinition& definition);

  /// @throws ModelError if a moving joint carries no mass at all that would resist its motion.
  Mechanism build() const;

 private:
  void check_carried_mass() const;
  bool is_taken(const std::string& name) const;

  std::vector<Body> bodies_{world()};
  std::vector<ElasticModeDefinition> elastic_modes_;
  std::vector<Loop> loops_;
  Vector3 gravity_ = Vector3(0, 0, -9.80665);

  static Body world();
};

}  // namespace blocklift::dynamics

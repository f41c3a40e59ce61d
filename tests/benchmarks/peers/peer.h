#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

/// What this program and other multibody libraries are asked to compute side by side.
///
/// Each library sits in a module of its own that is loaded at run time (peer_module), so that two
/// libraries never share a template's code compiled with different instruction sets. Only the plain
/// types of this header cross between them.
namespace blocklift::peers {

using Triple = std::array<double, 3>;
using Rotation = std::array<double, 9>;  ///< 3x3, row by row

/// A body and the joint that carries it; the body's frame is at the joint.
struct TreeBody {
  int parent = -1;    ///< index of the carrying body, -1: the world
  bool free = false;  ///< true: moves freely (the first body only); false: revolute
  Triple axis{};      ///< of the revolute joint, unit length, the same in parent and body
  Rotation R_PB{};    ///< orientation at the joint angle zero
  Triple p_PB{};      ///< joint in the parent, m
  double mass = 0;    ///< kg
  Triple p_BoBcm{};   ///< m
  Rotation I_BBcm{};  ///< about the centre of mass, kg m2
};

/// A tree of revolute joints on the world or on one free body; gravity 9.81 m/s2 along -z.
struct TreeModel {
  std::string name;
  std::vector<TreeBody> bodies;  ///< parents first

  bool floats() const { return !bodies.empty() && bodies.front().free; }
  std::size_t joint_count() const { return bodies.size() - (floats() ? 1 : 0); }
};

inline constexpr double gravity = 9.81;  ///< m/s2

/// State and joint torques, and where a free base is and how it moves (everything in W).
struct TreeState {
  Rotation R_WB{};                     ///< of the free base
  std::array<double, 4> quaternion{};  ///< the same as (w, x, y, z)
  Triple p_WB{};
  Triple w_WB{};                  ///< angular velocity, rad/s
  Triple v_WB{};                  ///< velocity of its origin, m/s
  std::vector<double> q, v, tau;  ///< of the revolute joints: rad, rad/s, N m
};

/// Angular acceleration of a free base and acceleration of its origin, in W (zeros without one),
/// then the joints': 6 + joint_count numbers.
using Accelerations = std::vector<double>;

/// Forward dynamics of one tree in one library.
class TreeDynamics {
 public:
  virtual ~TreeDynamics() = default;
  /// Keeps the states in the library's own coordinates.
  virtual void set_states(const std::vector<TreeState>& states) = 0;
  /// From the kept state `which` to accelerations, kinematics included, as one evaluation of a
  /// right-hand side asks for it. To be called with another state than the time before, as an
  /// integrator does: a library may keep what it computed of a state that it is given again (DART
  /// does).
  virtual void evaluate(std::size_t which) = 0;
  /// Of the last evaluation.
  virtual Accelerations accelerations() const = 0;
};

/// What came of a whole simulation.
struct SimulationRun {
  std::vector<double> values;  ///< those that are compared, in the model's order
  long steps = 0;
  long evaluations = 0;  ///< of the right-hand side
};

/// The 860 t block hoisted on six ropes for 120 s. Compared: the centre of mass at 10, 20, ... 120
/// s, x, y, z (m). The uniform block's origin is its centre; ropes stand upright at x = -10, 0, 10
/// and y = -6, 6 on its top face, with the static stretch at the start, and a damping of 1 % of
/// critical in heave.
struct BlockOnSixRopes {
  static constexpr double mass = 860e3;
  static constexpr Triple size{24, 16, 10};
  static constexpr double axial_stiffness = 6e8;
  static constexpr double rope_length = 30;
  static constexpr double hoisting_speed = 0.05;
  static constexpr double ramp = 2;
  static constexpr double duration = 120;
  static constexpr int samples = 12;
};

/// Andrews' squeezing mechanism (Schiehlen 1990; Test Set for IVP Solvers): seven bodies in a
/// plane, three loops, no gravity. Compared: beta, Theta, gamma, Phi, delta, Omega, epsilon at 0.03
/// s (rad).
struct Andrews {
  static constexpr double duration = 0.03;
  static constexpr double mass[] = {.04325, .00365, .02373, .00706, .07050, .00706, .05498};
  /// About the centre of mass and the normal of the plane, kg m2.
  static constexpr double inertia[] = {2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7,
                                       1.169e-5, 5.667e-7, 1.912e-5};
  static constexpr double start[] = {-0.0617138900142764496, 0,
                                     0.455279819163070380,   0.222668390165885885,
                                     0.487364979543842550,   -0.222668390165885885,
                                     1.23054744454982119};
  static constexpr double xa = -.06934, ya = -.00227, xb = -.03635, yb = .03273, xc = .014,
                          yc = .072;
  static constexpr double d = .028, da = .0115, e = .02, ea = .01421, rr = .007, ra = .00092,
                          ss = .035, sa = .01874, sb = .01043, sc = .018, sd = .02, ta = .02308,
                          tb = .00916, u = .04, ua = .01228, ub = .00449, zf = .02, zt = .04,
                          fa = .01421;
  static constexpr double stiffness = 4530, free_length = .07785, moment = .033;
  /// By extrapolation in quadruple precision, residual of the constraints below 5e-29.
  static constexpr double reference[] = {15.81077119515370709712, -15.75637105841183946973,
                                         0.04082224011964580486,  -0.53473011634207959377,
                                         0.52440996587995406937,  0.53473011634207959377,
                                         1.04808074104193787307};
};

/// A library, as its module presents it.
struct PeerModule {
  const char* name;
  const char* version;
  /// Null where the library has no forward dynamics for such a tree.
  std::unique_ptr<TreeDynamics> (*make_tree)(const TreeModel& model);
  /// Null where the library takes no part.
  SimulationRun (*simulate_block_on_six_ropes)(double accuracy);
  SimulationRun (*simulate_andrews)(double accuracy);
};

}  // namespace blocklift::peers

/// The one symbol that a module exports.
extern "C" __attribute__((visibility("default"))) const blocklift::peers::PeerModule* peer_module();

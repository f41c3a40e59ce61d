#pragma once

#include <vector>

#include "dynamics/multibody/kinematics.h"

namespace blocklift::dynamics {

/// A frame H fixed in a body.
struct BodyFrame {
  BodyIndex body = -1;
  Pose X_BH;  ///< origin R (m) and axes of H in the body's frame
};

/// Inertia that bodies have besides their own and that may tie them together: water that floating
/// bodies set in motion (its infinite-frequency added mass).
///
/// With u = (w; v), body after body, the spatial velocities of the frames H at their origins and in
/// their own axes (rad/s, m/s), the kinetic energy is T = 1/2 u^T A u with a constant symmetric A
/// (6N x 6N). With the momenta p = A u = (h; l) it asks of each body, about R in the axes of H, for
///
///   moment  dh/dt + w x h + v x l,    force  dl/dt + w x l,
///
/// Kirchhoff's equations, so that energy is kept exactly whatever the motion; the terms besides A
/// du/dt are of second order in it. It is treated implicitly: J^T A J joins the mass matrix (u = J
/// v), so that A may exceed the masses of the bodies. Source: Lamb, Hydrodynamics (1932), sec. 124;
/// Newman, Marine Hydrodynamics (1977), sec. 4.13.
class AddedInertia {
 public:
  /// @throws ModelError if A is not of size 6N, not finite, not symmetric to 1e-6, or not positive
  ///   semi-definite, or a frame is fixed in the world.
  AddedInertia(std::vector<BodyFrame> frames, Eigen::MatrixXd matrix);

  const std::vector<BodyFrame>& frames() const { return frames_; }
  const Eigen::MatrixXd& matrix() const { return matrix_; }
  Eigen::Index size() const { return matrix_.rows(); }
  std::vector<BodyIndex> bodies() const;

  /// u, 6N, from the velocities of the bodies. Does not allocate.
  void calc_velocity(const Kinematics& kinematics, VectorRef u) const;
  /// J, 6N x nv, with u = J v. Does not allocate.
  void calc_jacobian(const Mechanism& mechanism, const Kinematics& kinematics,
                     Eigen::Ref<Eigen::MatrixXd> jacobian) const;
  /// What the inertia asks for at accelerations A_WB of the bodies: moment and force on each frame,
  /// 6N. `matrix` is A, or what it is for the moment (AddedInertiaWorkspace); `u` is
  /// calc_velocity's, `momentum` a workspace of its size. Does not allocate.
  void calc_force(const Kinematics& kinematics, const std::vector<MotionVector>& A_WB,
                  const Eigen::MatrixXd& matrix, ConstVectorRef u, VectorRef momentum,
                  VectorRef force) const;
  /// 1/2 u^T A u, J.
  double calc_energy(ConstVectorRef u) const { return 0.5 * u.dot(matrix_ * u); }

 private:
  std::vector<BodyFrame> frames_;
  Eigen::MatrixXd matrix_;
};

/// Adds forces on the frames (moment; force, each 6 in its own axes, about R; 6N) to those on the
/// bodies about Bo in W. Does not allocate.
void add_frame_forces(const std::vector<BodyFrame>& frames, const Kinematics& kinematics,
                      ConstVectorRef force, std::vector<ForceVector>& F_Bo_W);

/// What the evaluation of an AddedInertia writes.
struct AddedInertiaWorkspace {
  AddedInertiaWorkspace(const Mechanism& mechanism, const AddedInertia& inertia);

  /// M += J^T A J, nv x nv. Leaves J and A J here. Does not allocate.
  void add_mass(const Mechanism& mechanism, const Kinematics& kinematics,
                const AddedInertia& inertia, Eigen::Ref<Eigen::MatrixXd> mass);
  /// tau += J^T F with the forces that accelerations A_WB ask for; J is that of add_mass.
  void add_force(const Kinematics& kinematics, const AddedInertia& inertia,
                 const std::vector<MotionVector>& A_WB, VectorRef tau);

  /// A. Of an inertia that changes with the motion its owner writes here what it is at each
  /// instant; what the change itself asks for is the owner's, too.
  Eigen::MatrixXd matrix;
  Eigen::MatrixXd jacobian;  ///< J, 6N x nv
  Eigen::MatrixXd product;   ///< A J, 6N x nv
  Eigen::VectorXd velocity;  ///< u
  Eigen::VectorXd momentum, force;
};

}  // namespace blocklift::dynamics

#pragma once

#include "dynamics/algebra/hierarchical_matrix.h"
#include "dynamics/marine/panels/rankine_problem.h"
#include "dynamics/marine/radiation/ring_loss.h"

namespace blocklift::dynamics {

/// A rectangle of the water's surface, along the world's axes, on which waves fade: what friction
/// and vortices do to the water in a moonpool or in the gap between two hulls, which potential flow
/// lets swing on. There
///
///   dphi/dz = (w - i nu)^2/g phi,
///
/// so that water that swings by itself does so at the same frequency and fades as exp(-nu t). For a
/// small nu this is the dissipation epsilon = 2 nu/w of Chen's condition dphi/dz = w^2/g (1 - i
/// epsilon) phi (Chen 2005). Incident waves pass a lid as they are.
struct DampingLid {
  Eigen::Vector2d low, high;  ///< corners, m
  double rate = 0.0;          ///< nu, rad/s

  bool contains(const Vector3& p_W) const {
    return p_W.x() >= low.x() && p_W.x() <= high.x() && p_W.y() >= low.y() && p_W.y() <= high.y();
  }
};

/// The planes of symmetry in which each lid, too, is its own image or that of another.
Symmetry keep_symmetry(const Symmetry& symmetry, const std::vector<DampingLid>& lids);

/// What the surface takes out of waves.
struct SurfaceDamping {
  Eigen::VectorXd rates;       ///< nu for each panel, rad/s: all waves fade as exp(-nu t)
  RingDifferences rings = {};  ///< R of waves too short for the rings; no rows: none
};

/// Numerical beach: where waves that leave the bodies are damped before they reach the edge of the
/// surface mesh. The rate nu (rad/s) of the paper's equation (26) grows with the square of the
/// distance from the circle that holds the bodies.
struct DampingZone {
  double strength = 0.0;              ///< nu at the outer edge, rad/s
  std::vector<DampingLid> lids = {};  ///< where more than that of the beach

  /// nu for each panel of the surface, rad/s.
  Eigen::VectorXd rates(const SurfaceMesh& surface) const;
  /// The same with the loss of waves that the surface's rings cannot carry.
  SurfaceDamping damping(const SurfaceMesh& surface, double gravity) const {
    return {rates(surface), make_ring_differences(surface, gravity)};
  }
};

/// Damping zone for waves down to a frequency (rad/s): 1.1 times that frequency at the edge.
/// Stronger damping reflects the waves it should take in.
DampingZone damping_zone(double lowest_frequency);

/// Free surface of one part, marched in time (the paper's equations 26 and 27):
///
///   d eta/dt = M phi + q v - 2 nu eta + (nu^2/g) phi - R^T R eta,      d phi/dt = -g eta,
///
/// eta at t, phi half a step later (leapfrog, second order, no damping of its own); the damping
/// term 2 nu eta by Crank and Nicolson's rule, the rings' loss R^T R eta (RingDifferences) as at
/// the beginning of the step. All quantities carry the factor W^1/2 of RankinePart. The operator M
/// is what a step has to read: it is held in single precision, and of many panels as a hierarchical
/// matrix. Several histories (columns) are marched at once at little more than the cost of one. No
/// allocation in a step but in the library of hierarchical matrices.
class FreeSurfaceMarch {
 public:
  /// `columns` is the number of histories.
  FreeSurfaceMarch(const RankinePart& part, const SurfaceDamping& damping, double gravity,
                   Eigen::Index columns);

  /// Memory of the operator (bytes) of so many panels, at most.
  static double operator_bytes(double panels);

  /// Largest stable step, s: dt^2 (g M + nu^2)/4 + dt R^T R/2 has no eigenvalue above one, by
  /// Lanczos' iteration.
  double step_limit() const { return step_limit_; }

  /// Elevation W^1/2 eta now (m2); potential W^1/2 phi half a step ago (m3/s).
  const Eigen::MatrixXd& elevation() const { return elevation_; }
  const Eigen::MatrixXd& potential() const { return potential_; }

  /// Starts from an elevation (W^1/2 eta) and no potential.
  void start(const Eigen::MatrixXd& elevation, double step);
  /// One step; `supply` is W^1/2 times what the bodies' motion at the middle of the step adds to
  /// d eta/dt (q v; m2/s), or empty.
  void advance(const Eigen::MatrixXd& supply = {});

 private:
  /// Y = (W^1/2 M W^-1/2 + nu^2/g) X.
  void apply(const Eigen::MatrixXf& X, Eigen::MatrixXf& Y,
             HierarchicalMatrix::Workspace& workspace) const;
  double find_step_limit() const;
  /// Of potential (g M + nu^2)/g + loss R^T R.
  double find_largest_eigenvalue(double potential, double loss) const;

  double gravity_;
  double step_ = not_a_number;
  double step_limit_ = not_a_number;
  Eigen::MatrixXf operator_;                  ///< W^1/2 M W^-1/2 of few panels
  HierarchicalMatrix hierarchical_operator_;  ///< the same of many
  HierarchicalMatrix::Workspace workspace_;
  SurfaceDamping damping_;
  Eigen::VectorXf restoring_;  ///< nu^2/g
  Eigen::VectorXd before_, after_;
  RingDifferences weighted_rings_;  ///< R times the step and what is left of it after 2 nu eta
  Eigen::MatrixXd elevation_, potential_, differences_;
  Eigen::MatrixXf single_potential_, single_velocity_;
};

}  // namespace blocklift::dynamics

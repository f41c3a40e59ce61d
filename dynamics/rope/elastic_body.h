#pragma once

#include <string>
#include <vector>

#include "algebra/factors.h"
#include "dynamics/rope/rope.h"

namespace blocklift::dynamics {

/// A body that gives way where ropes pull at it.
///
/// The ends of the ropes are displaced within the body, against its mean motion, by (m, in B)
///   d = Phi eta + u,   u = C F,
/// F being the forces of the stretched ropes on the body (3 numbers an end, N, in B), C a
/// compliance that follows at once (m/N), and eta generalised elastic coordinates (m) that have
/// inertia of their own: the mechanism's elastic modes of the body (ElasticMode), each driven by
/// what pulls at the lugs and drawn back by its spring,
///   m (eta'' + 2 zeta omega eta' + omega^2 eta) = phi^T F.
/// With phi a natural mode of the free body, phi^T M phi = m, that is its motion but for the
/// couplings with the rigid motion that vanish with the deformation (mean axes).
///
/// With L the lengths of the ropes at the displaced ends, the elastic forces T = k (L - L0) of the
/// ropes that are stretched, L > L0, make Pi = sum k (L - L0)^2 / 2 + F^T C F / 2 stationary over
/// u, so that they are conservative. They are found by  (1/k + g^T C g) T = L - L0 - g^T u,  g =
/// dL/du, with the direction of the pull improved four times, each of which reduces its error by
/// the displacement over the length of the last segment. A rope with a tension law has its tangent
/// at the elongation of the pass before in place of k, and the elastic force over that tangent in
/// place of its elongation: Newton's method, in eight passes. Damping acts on each rope's own share
/// of the elongation's rate:
///   T_d = W^T c W (Ldot - L0dot),   W = 1/k (1/k + g^T C g)^-1,
/// which is Rayleigh's dissipation condensed as the stiffness is: exact to the first order in c/k
/// times the frequency. A rope pulls with T + T_d, or not at all where that would push. The ends
/// still follow its elastic force, so that the energy stored does not jump when it goes slack while
/// it contracts faster than it can pull: it keeps that force (RopeLoad) and its energy, and loses
/// the power T (L0dot - Ldot). C = 0 and no modes is the rigid body. Sources: Shabana
/// (2013), sections 5.2 and 5.7 (mean axes); Guyan (1965) for the condensation.
class ElasticBody {
 public:
  /// The first or last point of a rope, fixed to the body.
  struct End {
    int rope = -1;
    bool last = true;
  };
  struct Definition {
    std::string name;
    BodyIndex body = -1;
    std::vector<End> ends;
    Eigen::MatrixXd compliance;  ///< C, 3 ends square, symmetric, m/N
    Eigen::MatrixXd shapes;      ///< Phi, 3 ends x modes, 1
    std::vector<int> modes;      ///< of the mechanism's elastic modes, those whose columns Phi has
  };

  /// What one evaluation writes; made once.
  struct Workspace {
    explicit Workspace(const ElasticBody& body, const Mechanism& mechanism);

    std::vector<char> stretched;  ///< ropes whose elastic force draws the ends
    Eigen::VectorXd modal, modal_rate, u, next_u, force;  ///< 3 ends each, in B
    Eigen::MatrixXd gradient;                             ///< 3 ends x ropes, in B: g of each end
    Eigen::MatrixXd compliance_gradient;                  ///< C g
    Eigen::VectorXd length, length_rate, elongation, rate, elastic, damping, scratch;
    Eigen::VectorXd flexibility, rope_damping;  ///< 1/k and c
    Eigen::MatrixXd matrix;                     ///< 1/k + g^T C g
    algebra::CholeskyFactors factor;
    double energy = 0.0;  ///< stored in the body: F^T C F / 2, and in the springs of its modes, J

    // Of the derivatives.
    Eigen::VectorXd spring;                              // k of stretched ropes, else 0
    Eigen::MatrixXd inverse, damper;                     // ropes x ropes
    Eigen::MatrixXd compliance_W, inner, end_stiffness;  // 3 ends x 3 ends
    algebra::LuFactors<double> relaxer;
    Eigen::MatrixXd stretch, rate_stretch, scaled_stretch;  // 3 points x ropes: dL/dp, dLdot/dp
    Eigen::MatrixXd pulling;                                // dL/dp of taut ropes alone
    Eigen::MatrixXd geometric, geometric_all, stiffness;    // 3 points x 3 points
    Eigen::MatrixXd motion, velocity_q, moved;              // 3 points x nv
    Eigen::MatrixXd turn, moment;                           // 3 x nv
    Eigen::MatrixXd relaxed, end_force;                     // 3 ends x nv
    Eigen::MatrixXd df_dq, df_dv;                           // 3 points x nv
    Eigen::MatrixXd by_rope, rope_rows;                     // ropes x nv
    Eigen::MatrixXd dtau_dq, dtau_dv;                       // nv x nv
    std::vector<Vector3> rate_W;                            // of each point's modal displacement
  };

  /// The ropes, and where the evaluation leaves what it finds of them.
  struct Ropes {
    const std::vector<Rope>& ropes;
    const std::vector<RopeFeed>& feeds;
    const std::vector<char>* contacts;  ///< which act; null: as the ropes' own law says
    RopePath& path;
    std::vector<RopeEndShifts>& shifts;
    std::vector<RopeLoad>& loads;
  };

  /// @throws ModelError if an end is not at a point of the body, is named twice or lies at a rope
  /// with an end at itself or with weight, sizes do not fit, the compliance is not symmetric or not
  /// positive semidefinite, or a mode is not there, is another body's or is named twice.
  ElasticBody(const Mechanism& mechanism, const std::vector<Rope>& ropes, Definition definition);

  const Definition& definition() const { return d_; }
  /// The ropes that end at the body, each once.
  const std::vector<int>& ropes() const { return ropes_; }
  /// d of an end: where add_forces has found it, against the body's mean motion, m, in B.
  static Vector3 displacement(const Workspace& w, std::size_t end) {
    const auto row = static_cast<Eigen::Index>(3 * end);
    return w.modal.segment<3>(row) + w.u.segment<3>(row);
  }
  /// Number of points of all these ropes.
  std::size_t point_count() const { return points_; }

  /// Loads of the body's ropes; adds their pull to the bodies, and the modes' forces to tau. Does
  /// not allocate.
  void add_forces(const Kinematics& kinematics, ConstVectorRef q, ConstVectorRef v,
                  const Ropes& ropes, Workspace& w, std::vector<ForceVector>& F_Bo_W,
                  VectorRef tau) const;
  /// Derivatives of the same at what add_forces has left: exact but for the damping's change by the
  /// direction of the pull and by a tension law, which vanishes at rest.
  void add_derivatives(const Kinematics& kinematics, const Ropes& ropes, Workspace& w,
                       ForceDerivatives& derivatives) const;

 private:
  struct Place {
    Eigen::Index rope;  // within ropes_
    Eigen::Index slot;  // of the end's point among all points
  };

  void take_geometry(const Kinematics& kinematics, const Ropes& ropes, Workspace& w) const;
  void set_shifts(const Ropes& ropes, const Workspace& w) const;
  void solve(Workspace& w) const;
  bool declared_taut(const Ropes& ropes, Eigen::Index rope) const;
  bool correct_stretched(const Ropes& ropes, Workspace& w) const;
  void gather_points(const Kinematics& kinematics, const Ropes& ropes, Workspace& w,
                     ForceDerivatives& derivatives) const;
  void relax(const Kinematics& kinematics, bool stretch_only, Workspace& w) const;
  void add_turning(const Kinematics& kinematics, const Ropes& ropes, Workspace& w) const;

  Definition d_;
  int passes_;  // over the directions of the pulls, and the tension laws
  std::vector<int> ropes_;
  std::vector<std::size_t> first_point_;  // of each rope
  std::size_t points_ = 0;
  std::vector<Place> places_;  // of each end
  std::vector<ElasticMode> modes_;
};

}  // namespace blocklift::dynamics

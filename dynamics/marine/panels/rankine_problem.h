#pragma once

#include <memory>

#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/marine/panels/panel_clusters.h"
#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics {

/// Memory (bytes) that the solution of one part takes at its peak, from the numbers of panels on
/// bodies and surface that it is computed with.
double rankine_part_bytes(int body_panels, int surface_panels, bool finite_depth);

/// What may be used, bytes: four fifths of the machine's memory, or limit_usable_memory if less.
double usable_memory();
/// Sets a limit for the process, bytes, from now on; there is none to begin with.
void limit_usable_memory(double bytes);

struct RankineSettings {
  int threads = 0;  ///< 0: one a core
  /// What may be used, bytes; 0: usable_memory().
  double memory_limit = 0.0;
  /// Keep the factors with which any normal velocity on the bodies can be solved for.
  bool keep_factors = false;
  /// Solve a second time with these panels; null: not. From the same matrices, but for equations at
  /// the middles of what lies in a plane (find_flat_clusters): at a small part of the first
  /// solution's cost.
  std::shared_ptr<const CoarserPanels> coarser = nullptr;
};

/// Seconds that the steps of a solution took.
struct RankineTiming {
  double influence_s = 0.0;      ///< all influence matrices
  double factorisation_s = 0.0;  ///< both LU factorisations
  double reduction_s = 0.0;      ///< forming the reduced operator and the modes
};

/// One part (even or odd in each plane of symmetry) of the linear potential flow about bodies in a
/// free surface, reduced to the surface.
///
/// With phi the disturbed potential (m2/s) and n the normal into the water, the paper's equation
/// (29) holds at the centroid of each panel, phi and its normal derivative constant on a panel:
///
///   2 pi phi = D phi - S dphi/dn,   S = integral of 1/r, D = integral of d(1/r)/dn.
///
/// On the bodies dphi/dn = n.u is known and phi sought; on the surface phi is known and w = dphi/dz
/// sought. At the bodies 1/r is replaced by 1/r - 1/r', r' from the image of the collocation point
/// in z = 0, where the same identity has no left-hand side: in deep water the surface's w drops out
/// of the bodies' equations, which are then solved by themselves. The bottom enters as an image.
/// With both factorised once,
///
///   phi_B = P phi_F + sum over modes Phi_m v_m,    w = M phi_F + sum over modes q_m v_m,
///   F_m = -rho A_mn dv_n/dt + rho c_m . dphi_F/dt,         c_m = W q_m by reciprocity.
///
/// All surface quantities are held multiplied by the square root W^1/2 of the panels' areas. M is
/// then symmetric and positive, and W^1/2 q_m equal to W^-1/2 c_m, but for the discretisation
/// error. The symmetric part of M and the mean of the two columns are taken: waves can then but
/// carry energy away, whatever the mesh, and the error of the mean is an order smaller than that of
/// either (that of the damping of a hemisphere at k a = 4: 1.8 % against 4.8 % with 1,800
/// unknowns). Sources: Kring (1994); Hess and Smith (1964); Newman (1977), section 4.8, for the
/// reciprocity.
class RankinePart {
 public:
  /// @throws SimulationError if it does not fit into the memory allowed (with the figures) or a
  /// matrix is singular.
  RankinePart(const PanelModel& model, const Parity& parity, const RankineSettings& settings = {});

  const Parity& parity() const { return parity_; }
  /// The modes (0 <= mode < 6N) that have this part; columns below are in their order.
  const std::vector<int>& modes() const { return modes_; }
  int image_count() const { return image_count_; }
  const RankineTiming& timing() const { return timing_; }

  /// Centroids of the surface's panels, a column each, m.
  const Eigen::Matrix2Xd& surface_points() const { return surface_points_; }
  /// W^1/2 M W^-1/2, symmetric, 1/m; in the single precision that it is computed in.
  const Eigen::MatrixXf& surface_operator() const { return surface_operator_; }
  /// Mean of W^1/2 q and W^-1/2 c, a column for each of modes(), m (m2 for rotations).
  const Eigen::MatrixXd& surface_columns() const { return surface_columns_; }
  /// P W^-1/2: body potentials of the surface's.
  const Eigen::MatrixXd& body_from_surface() const { return body_from_surface_; }
  /// Phi: body potentials of the modes while phi = 0 on the surface, m (m2).
  const Eigen::MatrixXd& body_columns() const { return body_columns_; }
  /// n.u of the modes on the bodies.
  const Eigen::MatrixXd& normal_velocities() const { return normal_velocities_; }
  /// This part's share of the infinite-frequency added mass divided by the density, modes() square,
  /// images included, not yet made symmetric; m3, m4, m5.
  const Eigen::MatrixXd& infinite_frequency_volume() const { return infinite_frequency_volume_; }
  /// Largest relative difference between W^1/2 q and W^-1/2 c.
  double reciprocity_error() const { return reciprocity_error_; }
  /// The solution with RankineSettings::coarser; null without. What it differs by tells how far the
  /// panels are from being fine enough. It keeps no factors.
  const RankinePart* coarser() const { return coarser_.get(); }

  /// Body potential and W^1/2 w for any normal velocities on the bodies (columns) while phi = 0 on
  /// the surface. Needs keep_factors. @throws ModelError without them.
  void solve(const Eigen::MatrixXd& normal_velocities, Eigen::MatrixXd& body_potentials,
             Eigen::MatrixXd& surface_velocities) const;

 private:
  struct Influence;
  /// Areas of the panels, m2, and whether the water is deep.
  struct Areas {
    Eigen::VectorXd bodies, surface;
    bool deep;
  };
  RankinePart() = default;
  Influence compute_influence(const PanelModel& model, int threads) const;
  /// Of bodies and surface at points on the bodies: the blocks BB and BF of `influence`.
  /// @param own for each of the bodies' panels, which point lies on it; -1: none.
  void add_at_bodies(const PanelModel& model, const PointColumns& points,
                     const std::vector<int>& own, int threads, Influence& influence) const;
  void solve_coarser(const PanelModel& model, const Influence& influence, const Areas& areas,
                     const RankineSettings& settings);
  /// Puts the bodies' equations at the middles of their flat clusters in place of those in the
  /// mean.
  void take_rows_at_middles(const PanelModel& model, const CoarserPanels& panels, int threads,
                            Influence& coarse) const;
  /// Factorises the matrices and reduces them to the surface.
  void reduce(Influence influence, const Areas& areas, bool keep_factors);

  Parity parity_;
  int image_count_ = 1;
  std::vector<int> modes_;
  RankineTiming timing_;
  double reciprocity_error_ = 0.0;
  Eigen::Matrix2Xd surface_points_;
  Eigen::MatrixXf surface_operator_;
  Eigen::MatrixXd surface_columns_, body_from_surface_;
  Eigen::MatrixXd body_columns_, normal_velocities_, infinite_frequency_volume_;
  /// Kept for solve(): factors and the blocks of the right-hand side.
  struct Factors;
  std::shared_ptr<const Factors> factors_;
  std::shared_ptr<const RankinePart> coarser_;
};

}  // namespace blocklift::dynamics

#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Loads on a free block at one instant: forces at the pins and the field of inertia and gravity.
struct LoadCase {
  std::string name;
  std::vector<Vector3> lug_forces_B;  ///< on the block at each lug's pin, in the mesh's order, N
  InertiaField field;
  /// Factors of the loads that UnitResponses::add_loads brought; empty: none of them acts.
  Eigen::VectorXd added = {};
};

/// How well a load case is in balance.
struct LoadBalance {
  Wrench resultant;  ///< of all loads about B's origin; the moment about the centre of mass
  double force_residual = 0;        ///< |force| over the sum of the lug forces' magnitudes
  double moment_residual = 0;       ///< |moment about the centre of mass| over that sum times the
                                    ///< radius of gyration
  double reaction_over_weight = 0;  ///< largest support reaction over mass times |field| (or 9.81)
};

/// Wall-clock times of the stages, s, and sizes.
struct SolutionTiming {
  double assembly_s = 0;
  double analysis_s = 0;
  double factorisation_s = 0;
  double solve_s = 0;
  double factor_bytes = 0;
};

/// Linear response of the free block to its unit loads, one factorisation for all.
///
/// The basis is 3 unit forces a lug, 12 unit inertia fields and what is added. Each lug force,
/// added load and product of angular velocities is solved together with the rigid acceleration that
/// balances it, so that the block floats freely on its 3-2-1 support and nothing large cancels on
/// superposition; six plain acceleration fields complete the span and carry what a load case lacks
/// in balance.
class UnitResponses {
 public:
  /// Assembles, factorises and solves. The model must outlive this object.
  /// @param threads of the assembly; 0: as many as the machine has. OpenBLAS has its own setting.
  /// @throws NotEnoughMemory; LooseBlock if a part is free to move.
  explicit UnitResponses(const ElasticModel& model, int threads = 0);
  /// The same for a model that has its elements, and so its stiffness, from another's
  /// (ElasticModel::with_mass): the factor is shared and responses are solved anew, bit for bit as
  /// the first constructor solves them. The other may go.
  /// @throws ModelError if the models do not share their elements.
  UnitResponses(const ElasticModel& model, const UnitResponses& same_stiffness);
  ~UnitResponses();

  const ElasticModel& model() const { return model_; }
  const SolutionTiming& timing() const { return timing_; }

  /// Adds loads to the basis (a column each, freedoms), such as pressures on the shell.
  void add_loads(const Eigen::MatrixXd& loads);

  /// Number of basis loads, 3 lugs + 12 + those added.
  int count() const { return static_cast<int>(displacements_.cols()); }
  /// Motions of the basis, freedoms x count, m and rad.
  const Eigen::MatrixXd& displacements() const { return displacements_; }
  /// Factors of the basis that make up a load case.
  /// In the order: lug forces, products of angular velocities, added loads, the six plain
  /// accelerations.
  /// @throws ModelError if the number of lug forces is not that of the lugs, or factors are given
  ///   for other than the added loads.
  Eigen::VectorXd coefficients(const LoadCase& load_case) const;

  /// Load vector of a load case, N.
  Eigen::VectorXd load_vector(const LoadCase& load_case) const;
  /// Motion of a load case against the 3-2-1 support, six rows a node.
  Eigen::VectorXd displacement(const LoadCase& load_case) const;
  /// The same of several, a column each, in one pass through the basis.
  Eigen::MatrixXd displacements_of(const std::vector<LoadCase>& load_cases) const;
  /// Displacement relative to the block's mean rigid motion (mass-weighted least squares), m, one
  /// column a node.
  Eigen::Matrix3Xd elastic_displacement(const LoadCase& load_case) const;
  LoadBalance balance(const LoadCase& load_case) const;

  /// Solves a load case directly, without the basis: for checks of the superposition.
  Eigen::VectorXd solve_directly(const LoadCase& load_case) const;

  /// Motions against the 3-2-1 support under loads (columns) that are in balance.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& balanced_loads) const;

  /// Takes the best-fitting rigid motion (mass-weighted) out of a motion.
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& displacement) const;

 private:
  struct System;
  void balance_loads(Eigen::MatrixXd& loads, Eigen::Ref<Eigen::MatrixXd> accelerations) const;
  void solve_basis();
  /// @throws ModelError if the block is a mechanism but for rounding.
  void check_stiffness() const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& loads, Eigen::MatrixXd& reactions) const;

  const ElasticModel& model_;
  SolutionTiming timing_;
  std::shared_ptr<const System> system_;
  Eigen::MatrixXd added_loads_;  ///< as they came, freedoms x added
  /// Forces and moments about Bo of lug forces, fields of inertia and added loads, 6 x their
  /// number.
  Eigen::MatrixXd resultants_;
  Eigen::MatrixXd balancing_;      ///< 6 x (lug forces + products + added): rigid accelerations
  Eigen::MatrixXd displacements_;  ///< of the basis
  Eigen::MatrixXd reactions_;      ///< 6 x count, N
};

}  // namespace blocklift::structure

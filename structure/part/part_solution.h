#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/elasticity/part_model.h"
#include "structure/rigid_body.h"
#include "structure/solver_choice.h"
#include "structure/stress/solid_error.h"

namespace blocklift::structure {

/// Stresses of a part at its nodes.
struct PartStress : NodalPoints {
  StressColumns averaged;  ///< over the solids at each point, Pa
};

/// Largest values of a group of solids.
struct PartGroupResult {
  std::string group;
  double von_mises = 0;  ///< of the averaged stress, Pa
  Vector3 point = Vector3::Zero();
  double raw_von_mises = 0;  ///< largest of any solid at any of its nodes, nothing averaged, Pa
  Vector3 raw_point = Vector3::Zero();
  double displacement = 0;  ///< m
  /// By superconvergent patch recovery, in the energy norm, as a share of the norm (see
  /// SolidError).
  double estimated_error = 0;
  /// Of the largest averaged stress: by how much (as a von Mises stress) the stresses of the solids
  /// that meet there differ from the recovered one, Pa. It falls as the mesh gets finer, unless the
  /// stress is singular.
  double von_mises_error = 0;
};

/// How the equations of a part were solved. Times by the wall clock.
struct SolverAccount {
  std::string name;
  int processes = 1;
  int iterations = 0;       ///< 0: none, solved directly
  double factor_bytes = 0;  ///< over all processes; 0 without a factor
  double assembly_s = 0, factorisation_s = 0, solve_s = 0;
};

/// Displacement of a part under its loads.
struct PartDisplacement {
  Eigen::VectorXd displacement;  ///< 3 a node, m
  Eigen::VectorXd reactions;     ///< of the supports, one a fixed unknown, N
  SolverAccount account;
};

/// Finds the displacement for fixed unknowns and a load vector by sparse Cholesky factorisation or
/// by iteration, on all processes of a FactorTeam where there is one.
/// @throws NotEnoughMemory if the stiffness, or a factor that the choice insists on, would not fit,
///   before anything is factorised; ModelError if the stiffness is not positive definite, or an
///   iteration does not converge.
PartDisplacement find_part_displacement(const PartModel& model,
                                        const std::vector<FixedUnknown>& fixed,
                                        const Eigen::VectorXd& load,
                                        const SolverChoice& choice = {});

/// Solution of a part.
struct PartSolution {
  Eigen::VectorXd displacement;  ///< 3 a node, m
  PartStress stress;
  Wrench applied;                 ///< all loads about the origin
  double load_magnitude = 0;      ///< sum of the nodal loads' magnitudes, N
  std::vector<Wrench> reactions;  ///< of each support on the part, about the origin
  /// |loads + reactions| over the sum of the magnitudes of both.
  double force_residual = 0;
  double moment_residual = 0;  ///< the same of moments about the origin
  /// Of solids; a volume of the geometry that is a named group as a whole comes by that name alone.
  std::vector<PartGroupResult> groups;
  PartGroupResult all;
  double strain_energy = 0;               ///< J
  double estimated_error = 0;             ///< of the whole part, as for a group
  Vector3 worst_point = Vector3::Zero();  ///< centre of the solid with the largest error, m
  Eigen::VectorXd squared_error;          ///< of each solid in the energy norm, J (see SolidError)
  StressColumns recovered;                ///< SolidError::recovered, Pa
  SolverAccount solver;
  double recovery_s = 0;  ///< wall-clock time of the stresses
};

/// Displacement and stress at a place.
struct PartProbe {
  Vector3 point = Vector3::Zero();  ///< m
  bool inside = false;              ///< false: it lies at no solid; the rest says nothing then
  Vector3 displacement = Vector3::Zero();
  Eigen::Matrix<double, 6, 1> stress = Eigen::Matrix<double, 6, 1>::Zero();  ///< averaged, Pa
  /// Von Mises stress of the difference between averaged and recovered stress, Pa.
  double von_mises_error = 0;
};

/// Solves a part. @throws ModelError if the supports leave a rigid motion (named), an element is
/// inverted, a group is missing or empty, all loads go straight into the supports, or memory does
/// not suffice.
PartSolution solve_part(const PartModel& model, const SolverChoice& choice = {});

/// Stresses at the nodes from the displacement, averaged over the solids of one material.
PartStress recover_part_stress(const PartModel& model, const Eigen::VectorXd& displacement);

/// Displacement and averaged stress at a place, interpolated in the solid that holds it. A place on
/// the true surface of a curved part may lie outside of all solids, for these meet it with their
/// nodes alone: then at the nearest place of a solid, if that is no farther off than a tenth of its
/// curved sides' sagitta.
PartProbe probe_part(const PartModel& model, const PartSolution& solution, const Vector3& point);

}  // namespace blocklift::structure

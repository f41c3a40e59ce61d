#pragma once

#include <vector>

#include "pipeline/coupling/load_mapping.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "structure/response/elastic_model.h"
#include "structure/rigid_body.h"

namespace blocklift::pipeline {

/// How well a set of forces at lugs bears a block that hangs still: what is left of force and
/// moment accelerates it. Gravity is taken to act against the sum of the forces.
struct TableBalance {
  structure::Vector3 force_B = structure::Vector3::Zero();   ///< sum of the forces, N
  structure::Vector3 moment_B = structure::Vector3::Zero();  ///< about the centre of mass, N m
  structure::Vector3 angular_acceleration_B = structure::Vector3::Zero();  ///< rad/s^2
  double weight = 0;                                                       ///< of the block, N
  double radius_of_gyration = 0;  ///< the mean of those about three axes, m
  /// Sum over the lugs of force times place from the centre of mass, N m: above zero where the
  /// forces draw the lugs away from it, below where they press the lugs towards it.
  double drawing = 0;

  double over_weight() const { return force_B.norm() / weight; }
  /// What is left of the forces' sum when it bears the weight, in g: below zero the block falls.
  double acceleration() const { return over_weight() - 1; }
  /// How far beside the centre of mass the sum pulls, m; of forces that twist, moment over force.
  double lever() const;

  /// Is the sum so small that it bears nothing?
  bool bears_nothing() const;
  /// Has the sum a part down in the block's frame, and presses the lugs towards the centre of mass?
  /// A block that hangs upside down is drawn at.
  bool presses_down() const;
  /// Is the sum further than largest_share off the weight?
  bool is_off_weight() const;
  /// Is the lever larger than largest_lever of the radius of gyration?
  bool turns() const;

  /// Rounding and the tolerance of a weight stay within it.
  static constexpr double largest_share = 0.03;
  /// The ends of a block, one to two radii away, accelerate by 5 to 10 % of gravity then.
  static constexpr double largest_lever = 0.05;
};

/// @param lug_forces_B one a lug, N. @param gravity m/s^2.
TableBalance find_table_balance(const std::vector<structure::Vector3>& lug_forces_B,
                                const std::vector<structure::LiftingPoint>& lugs,
                                const structure::MassProperties& mass, double gravity);

/// Forces of a load table in the order of a mesh's lugs, N, in the block's frame.
/// @param loads its static or its dynamic ones.
std::vector<structure::Vector3> table_forces(const LoadTable& table,
                                             const std::vector<Named<double>>& loads,
                                             const std::vector<structure::LiftingPoint>& lugs);

/// The balance of these loads on the block of a model. @param gravity m/s^2.
TableBalance find_table_balance(const LoadTable& table, const std::vector<Named<double>>& loads,
                                const structure::ElasticModel& model, double gravity);

/// Complains, at the table, about loads at rest that cannot hold the block up.
void check_that_table_lifts(const LoadTable& table, const TableBalance& at_rest,
                            Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "dynamics/marine/loads/hull_force.h"
#include "dynamics/simulation/history.h"
#include "structure/stress/shell_regions.h"

/// Pressure of the water on the shell of a block that floats, or is lowered into the water.
namespace blocklift::pipeline {

/// A hull's wet surface seen from the regions of a block's shell: each triangle of the hull presses
/// on the region nearest to it that looks the same way, with its own force at its own place.
///
/// The pressure is that of dynamics::HullForce on the same triangles, so that the wrenches of all
/// regions sum up to the force that moved the body: to rounding in still water, in waves to the
/// share by which that force takes boxes of panels whole.
class ShellPressure {
 public:
  ShellPressure(const dynamics::Hull& hull, const structure::ShellRegions& shell);

  /// Wrenches on the regions with the block at a pose: rows 6 region + i, force (N) and moment
  /// about the region's centre (N m), in B.
  /// @param in_waves false: the surface stays calm.
  void calc_wrenches(const dynamics::Sea& sea, bool in_waves, double time,
                     const dynamics::Pose& X_WB, Eigen::Ref<Eigen::VectorXd> wrenches) const;

 private:
  struct Panel {
    std::array<int, 3> points;
    int region = -1;
  };
  std::vector<dynamics::Vector3> points_B_;
  std::vector<Panel> panels_;
  std::vector<dynamics::Vector3> centres_B_;  ///< of the regions
};

/// Settings of PressureBasis.
struct PressureSettings {
  double region_size = dynamics::not_a_number;  ///< m
  double tolerance = 1e-3;                      ///< largest error of the basis
};

/// Few fields of pressure on a block's shell that make up that of every instant of two histories.
///
/// They are the proper orthogonal modes (Sirovich 1987) of the regions' wrenches over both
/// histories, moments divided by half a region's size. The error is the largest over all instants
/// of what is left, over the largest of the wrenches themselves, both in the Euclidean norm; as
/// many modes are taken as keep it below the tolerance.
struct PressureBasis {
  int regions = 0;             ///< of the shell
  double error = 0;            ///< see above
  double largest_force = 0;    ///< of all regions together at any instant, N
  Eigen::MatrixXd loads;       ///< freedoms x modes, N and N m
  Eigen::MatrixXd resultants;  ///< 6 x modes: force (N), moment about Bo (N m), in B
  Eigen::MatrixXd static_factors, dynamic_factors;  ///< modes x samples

  int count() const { return static_cast<int>(loads.cols()); }
};

/// The hull of a body of the lift; null if it has none.
const dynamics::HullForce* find_hull(const dynamics::LiftSystem& system, dynamics::BodyIndex body);

/// The basis of a body with a hull.
/// @param at_rest, in_motion the hull in the two histories: their seas differ.
/// @returns none if the hull stays dry.
std::optional<PressureBasis> find_pressure_basis(const structure::ElasticModel& model,
                                                 const dynamics::HullForce& at_rest,
                                                 const dynamics::History& static_history,
                                                 const dynamics::HullForce& in_motion,
                                                 const dynamics::History& dynamic_history,
                                                 const PressureSettings& settings);

}  // namespace blocklift::pipeline

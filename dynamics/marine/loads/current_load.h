#pragma once

#include <memory>

#include "dynamics/force/flow_coefficients.h"
#include "dynamics/marine/hull/hull_clusters.h"
#include "dynamics/marine/waves/sea.h"

namespace blocklift::dynamics {

/// Drag of the current on a hull by coefficients over the heading (FlowCoefficients), the flow
/// being the current at the height of the reference point P relative to P, times the share of the
/// hull that is in the water,
///
///   s = min(1, displaced volume / reference volume).
///
/// Waves are not in the flow, nor the turning of the hull: yaw is damped by QuadraticDamping.
class CurrentLoad {
 public:
  struct Definition {
    std::string name;
    BodyPoint reference;  ///< P
    FlowCoefficients::Definition coefficients;
    std::shared_ptr<const Sea> sea;
    std::shared_ptr<const HullClusters> hull;  ///< of the body; null: s = 1 always
    double reference_volume = not_a_number;    ///< afloat, m3; needed with a hull
  };

  /// @throws ModelError as FlowCoefficients, or if there is no sea or no body, or a hull comes
  ///   without a positive reference volume.
  explicit CurrentLoad(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Force and moment on the body about P, in W.
  ForceVector calc_force(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  /// How the current changes with the height is left out.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  /// The supplied power is that of the force on the moving body: negative where the water brakes.
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Flow {
    Vector3 p_BoP_W;
    Vector3 u_W;  ///< water relative to P
    FlowCoefficients::Load load;
    double wet;  ///< s
  };
  Flow find_flow(const MotionState& state) const;

  Definition definition_;
  FlowCoefficients coefficients_;
};

static_assert(ForceElement<CurrentLoad>);

}  // namespace blocklift::dynamics

#pragma once

#include <memory>
#include <vector>

#include "dynamics/force/flow_coefficients.h"
#include "dynamics/force/force_element.h"
#include "dynamics/force/wind_field.h"

namespace blocklift::dynamics {

/// Wind on a whole body (a ship, a barge with its deckhouse) by coefficients over the heading.
///
/// The flow of FlowCoefficients is the air, at the height of the reference point P, relative to P.
class WindLoad {
 public:
  using Coefficients = FlowCoefficients::Row;
  struct Definition {
    std::string name;
    BodyPoint reference;                 ///< P; its height gives the speed of the wind
    double frontal_area = not_a_number;  ///< A_f, m2
    double lateral_area = not_a_number;  ///< A_l, m2
    double height = not_a_number;        ///< h: lever of the heeling and trimming moments, m
    double length = not_a_number;        ///< l: lever of the yawing moment, m
    std::vector<Coefficients> table;     ///< as FlowCoefficients has it
    std::shared_ptr<const WindField> wind;
  };

  /// @throws ModelError as FlowCoefficients, or if there is no wind or no body.
  explicit WindLoad(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Force and moment on the body about the reference point, in W.
  ForceVector calc_force(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  /// How the mean wind changes with the height is left out.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  /// The supplied power is that of the force on the moving body.
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  struct Air {
    Vector3 r_W;  ///< P from Bo
    Vector3 u_W;  ///< air relative to P
    FlowCoefficients::Load load;
  };
  Air find_air(const MotionState& state) const;

  Definition definition_;
  FlowCoefficients coefficients_;
};

static_assert(ForceElement<WindLoad>);

}  // namespace blocklift::dynamics

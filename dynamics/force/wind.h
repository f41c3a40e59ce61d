#pragma once

#include <memory>
#include <optional>

#include "dynamics/force/force_element.h"
#include "dynamics/force/wind_field.h"

namespace blocklift::dynamics {

/// Wind that is the same everywhere and at all times.
struct Wind {
  Vector3 velocity_W = Vector3::Zero();  ///< of the air, m/s
  double air_density = 1.25;             ///< kg/m3

  /// Wind of a speed (m/s) blowing towards a heading (rad from +x towards +y), level.
  static Wind level(double speed, double heading, double air_density = 1.25);
};

/// Wind force on an area of a body. With u the velocity of the air relative to the point where the
/// force acts:
///
///   flat area with the normal n (either side):  F = 1/2 rho C A |u.n| (u.n) n,
///   area without direction (a hook block):      F = 1/2 rho C A |u| u      (N).
///
/// Source: the quasi-static pressure form of the crane codes (ISO 4302, EN 13001-2), with the
/// velocity relative to the moving area, so that motion is damped by the air.
class WindArea {
 public:
  struct Definition {
    std::string name;
    BodyPoint centre_of_pressure;
    double area = not_a_number;            ///< A, m2
    double coefficient = not_a_number;     ///< C
    std::optional<Vector3> normal_B = {};  ///< in the body's frame; none: no direction
  };

  /// @throws ModelError if area, coefficient or density is negative or not finite, or the normal
  /// has no length.
  WindArea(const Wind& wind, Definition definition);
  /// Wind that changes with the height and in time; its speed is that at the centre of pressure.
  /// @throws ModelError as above, and if there is no wind.
  WindArea(const std::shared_ptr<const WindField>& wind, const Definition& definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Force on the body at the centre of pressure, in W, N.
  Vector3 calc_force(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  /// By the velocity of the centre of pressure and, for a flat area, by the turn of its normal.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  /// The supplied power is that of the force on the moving body: negative where the air brakes.
  EnergyAccount calc_energy(const MotionState& state) const;

 private:
  WindArea(const Wind& wind, std::shared_ptr<const WindField> field, Definition definition);
  /// Velocity of the air relative to the centre of pressure, m/s.
  Vector3 calc_relative_velocity(const MotionState& state) const;

  Definition definition_;
  Vector3 velocity_W_;                      ///< everywhere, where there is no field
  std::shared_ptr<const WindField> field_;  ///< may be null
  double half_density_area_;                ///< 1/2 rho C A, kg/m
};

static_assert(ForceElement<WindArea>);

}  // namespace blocklift::dynamics

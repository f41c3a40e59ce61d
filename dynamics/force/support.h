#pragma once

#include <limits>

#include "dynamics/force/force_element.h"
#include "dynamics/force/one_sided.h"

namespace blocklift::dynamics {

/// Load of a support pad at one instant.
struct SupportLoad {
  double depth = not_a_number;          ///< how far the point is below the ground's height, m
  double depth_rate = not_a_number;     ///< m/s
  double elastic_force = not_a_number;  ///< k depth, N; negative above the ground
  double damping_force = not_a_number;  ///< c d(depth)/dt, N
  double normal_force = not_a_number;   ///< upwards on the body, N
  bool carries = false;                 ///< does the ground push?
  Vector3 force_W = Vector3::Constant(not_a_number);  ///< with friction, on the body, N
  Vector3 p_WG = Vector3::Constant(not_a_number);     ///< where friction holds the point, m

  /// Positive where the ground carries, negative where it does not, continuous between: N.
  double indicator() const { return one_sided_indicator(elastic_force, damping_force); }
};

/// A point of a body that may stand on level ground, and lift off it.
///
///   N = max(0, k d + c dd/dt) where the depth d = z_ground - z > 0, else 0 (one_sided_force);
///   within `reach` of p_WG alone: beside the pad the load may go below its height
///   (d = min(z_ground - z, reach - distance));
///   friction: with s the point's level displacement from where it stands at first and its rate,
///   f = -(k_t s + c_t ds/dt), shortened to mu N where longer (regularised Coulomb law).
/// The elastic part holds a standing load in place, so that a static equilibrium is unique. Where
/// it stands at first is p_WG; a pad that is `ground` stands wherever it touches down or has slid
/// to instead, and whoever moves it says where that is (carry_pads_along).
class SupportPad {
 public:
  struct Definition {
    std::string name;
    BodyPoint point;
    Vector3 p_WG = Vector3::Constant(not_a_number);  ///< where on the ground it stands at first, m
    double stiffness = not_a_number;                 ///< k, N/m
    double damping = 0.0;                            ///< c, N s/m
    double friction_coefficient = 0.0;               ///< mu
    double tangential_stiffness = 0.0;               ///< k_t, N/m
    double tangential_damping = 0.0;                 ///< c_t, N s/m
    double reach = std::numeric_limits<double>::infinity();  ///< level, from p_WG, m
    bool ground = false;  ///< level ground all over: friction holds where the point touches down
  };

  /// @throws ModelError if the stiffness is not positive or another number is negative.
  explicit SupportPad(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// @param p_WG where on the ground the point stands, m.
  SupportLoad calc_load(const Kinematics& kinematics, const Vector3& p_WG) const;
  SupportLoad calc_load(const Kinematics& kinematics) const {
    return calc_load(kinematics, definition_.p_WG);
  }
  /// Load where the pad is known to carry or not: the same law without its kink.
  SupportLoad calc_load(const Kinematics& kinematics, bool carries, const Vector3& p_WG) const;
  SupportLoad calc_load(const Kinematics& kinematics, bool carries) const {
    return calc_load(kinematics, carries, definition_.p_WG);
  }
  void add_force(const Kinematics& kinematics, const SupportLoad& load, Loads& loads) const;
  /// Derivatives of a load: of its normal force while it carries, and of friction, which sticks
  /// below its limit and slides with it beyond.
  void add_derivatives(const Kinematics& kinematics, const SupportLoad& load,
                       ForceDerivatives& derivatives) const;
  /// Stored: 1/2 k d^2 while it carries. Friction counts as dissipation.
  EnergyAccount calc_energy(const Kinematics& kinematics, const SupportLoad& load) const;

 private:
  SupportLoad calc_depth(const Kinematics& kinematics, const Vector3& p_WG) const;
  void set_force(const Kinematics& kinematics, SupportLoad& load) const;

  Definition definition_;
};

}  // namespace blocklift::dynamics

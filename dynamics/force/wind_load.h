#pragma once

#include <memory>
#include <vector>

#include "dynamics/force/force_element.h"
#include "dynamics/force/wind_field.h"

namespace blocklift::dynamics {

/// Wind on a whole body (a ship, a barge with its deckhouse) by coefficients over the heading.
///
/// With u the velocity of the air relative to the reference point P, u_x and u_y its parts along
/// the axes of the body, beta = atan2(u_y, u_x) (0: from astern) and q = 1/2 rho (u_x^2 + u_y^2):
///
///   force  q (A_f C_x, A_l C_y, 0),   moment about P  q (A_l h C_k, A_f h C_m, A_l l C_n)
///
/// in the axes of the body, the coefficients linear between the headings given.
/// Source: the form of OCIMF (1994) and Blendermann (1994).
class WindLoad {
 public:
  /// Coefficients at one heading.
  struct Coefficients {
    double heading = not_a_number;  ///< beta, rad
    double x = 0.0, y = 0.0;        ///< C_x, C_y
    double k = 0.0, m = 0.0, n = 0.0;
  };
  struct Definition {
    std::string name;
    BodyPoint reference;                 ///< P; its height gives the speed of the wind
    double frontal_area = not_a_number;  ///< A_f, m2
    double lateral_area = not_a_number;  ///< A_l, m2
    double height = not_a_number;        ///< h: lever of the heeling and trimming moments, m
    double length = not_a_number;        ///< l: lever of the yawing moment, m
    /// Headings ascend. From 0 to pi both included: a symmetric body, the other side is mirrored
    /// (C_y, C_k, C_n change sign). Otherwise they cover the circle, the last joining the first.
    std::vector<Coefficients> table;
    std::shared_ptr<const WindField> wind;
  };

  /// @throws ModelError if areas or levers are negative or not finite, the table has fewer than two
  ///   headings, they do not ascend or span more than the circle, or there is no wind.
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
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  struct Air {
    Vector3 r_W;  ///< P from Bo
    Vector3 u_W;  ///< air relative to P
    Vector3 u_B;
    Vector6 at_q;   ///< force over q (moment; force), m2 and m3
    Vector6 slope;  ///< its derivative with respect to beta
  };
  Air find_air(const MotionState& state) const;

  Definition definition_;
  std::vector<double> heading_;  ///< round the whole circle
  std::vector<Vector6> at_q_;
};

static_assert(ForceElement<WindLoad>);

}  // namespace blocklift::dynamics

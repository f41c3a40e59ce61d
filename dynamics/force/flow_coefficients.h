#pragma once

#include <string>
#include <vector>

#include "dynamics/force/force_element.h"

namespace blocklift::dynamics {

/// Load of a level flow, of air or of water, on a whole body by coefficients over the heading.
///
/// With u the velocity of the flow relative to the reference point, u_x and u_y its parts along the
/// axes of the body, beta = atan2(u_y, u_x) (0: from astern) and q = 1/2 rho (u_x^2 + u_y^2):
///
///   force  q (A_f C_x, A_l C_y, 0),   moment  q (A_l h C_k, A_f h C_m, A_l l C_n)
///
/// about the reference point in the axes of the body, the coefficients linear between the headings
/// given. Source: the form of OCIMF (1994) and Blendermann (1994).
class FlowCoefficients {
 public:
  /// Coefficients at one heading.
  struct Row {
    double heading = not_a_number;  ///< beta, rad
    double x = 0.0, y = 0.0;        ///< C_x, C_y
    double k = 0.0, m = 0.0, n = 0.0;
  };
  struct Definition {
    double frontal_area = not_a_number;  ///< A_f, m2
    double lateral_area = not_a_number;  ///< A_l, m2
    double height = not_a_number;        ///< h: lever of the heeling and trimming moments, m
    double length = not_a_number;        ///< l: lever of the yawing moment, m
    /// Headings ascend. From 0 to pi both included: a symmetric body, the other side is mirrored
    /// (C_y, C_k, C_n change sign). Otherwise they cover the circle, the last joining the first.
    std::vector<Row> table;
  };

  /// @param who the load in messages, such as `wind load "w"`.
  /// @throws ModelError if areas or levers are negative or not finite, the table has fewer than two
  ///   headings, they do not ascend or span more than the circle.
  FlowCoefficients(const std::string& who, const Definition& definition);

  using Vector6 = Eigen::Matrix<double, 6, 1>;
  /// Moment and force in the axes of the body, and how they change with the velocity there.
  struct Load {
    Vector6 F_B;
    Eigen::Matrix<double, 6, 3> by_u;
  };
  /// @param density of what flows, kg/m3. @param u_B relative to the reference point, m/s.
  Load calc_load(double density, const Vector3& u_B) const;

 private:
  std::vector<double> heading_;  ///< round the whole circle
  std::vector<Vector6> at_q_;    ///< load over q (moment; force), m3 and m2
};

/// A load in the axes of a body as a force element hands it on: turned into W, with its derivatives
/// by the body's motion where the velocity of the flow in W is held.
struct FlowLoad {
  ForceVector F_W;  ///< about the reference point
  Eigen::Matrix<double, 6, 6> dF_dX, dF_dV;

  /// @param u_W velocity of the flow relative to the reference point.
  FlowLoad(const FlowCoefficients::Load& load, const Matrix3& R_WB, const Vector3& u_W);
};

}  // namespace blocklift::dynamics

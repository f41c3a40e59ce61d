#pragma once

#include <vector>

#include "dynamics/marine/panels/panel_model.h"

namespace blocklift::dynamics {

/// The potential of a regular wave over the hulls' panels, by Gauss' rule with 2 x 2 points on
/// each.
///
/// The wave's moment in roll is the small rest of what it does to bottom and sides. A panel's
/// middle alone would leave out a share of the bottom's that grows with the square of the panels
/// over the breadth, and with it most of that rest. The rule is exact up to a cubic potential times
/// the arm.
class WaveOnHulls {
 public:
  /// Copies what it needs of the model.
  explicit WaveOnHulls(const PanelModel& model);

  /// int phi (n; (p - r) x n) dS over each body, n into the water, r its reference point, phi the
  /// potential (IncidentWave) of unit amplitude: times i w rho it is the Froude-Krylov force. Zero
  /// for a mode that moves no panel's middle along its normal, as the turns of a round body about
  /// its axis.
  /// @param frequency rad/s. @param headings rad, of travel.
  /// @return 6N x headings; m3/s, of rotations m4/s, for each m of amplitude.
  Eigen::MatrixXcd integrate_potential(double frequency, const std::vector<double>& headings) const;

 private:
  struct Sample {
    Vector3 p_W;
    Eigen::Index first_mode;                ///< of its body
    Eigen::Matrix<double, 6, 1> direction;  ///< (n; (p - r) x n) dS
  };

  Water water_;
  std::vector<Sample> samples_;
  Eigen::VectorXd moves_;  ///< 1 for a mode that moves the hulls along their normals, or 0
};

}  // namespace blocklift::dynamics

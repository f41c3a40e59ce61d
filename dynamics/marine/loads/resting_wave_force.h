#pragma once

#include <complex>
#include <vector>

#include "dynamics/marine/loads/wave_surface.h"
#include "dynamics/marine/radiation/incident_wave.h"

namespace blocklift::dynamics {

/// The force of low waves on a hull at rest, as HullForce has it: on the same triangles and faces,
/// by the same rules, to the first order of the waves' height. What a linear database counts in its
/// excitation and HullForce adds by itself is taken off by this without a remainder, however large
/// the panels are.
///
/// Over panels the pressure is linear between the vertices in the water and the points where their
/// edges leave it; there it is that of the elevation, between those of the edge's ends. On faces it
/// is taken at three points a piece. Boxes that HullForce takes whole leave a share of
/// WaveSurface::box_tolerance. That the wave wets more or less of the hull is of second order.
class RestingWaveForce {
 public:
  /// @param surface of the hull, made for the waves that HullForce will meet.
  /// @param X_WB the hull at rest in the water's surface, z = 0.
  /// @param p_WR the point that moments are about, m.
  RestingWaveForce(const WaveSurface& surface, const Pose& X_WB, const Vector3& p_WR);

  /// Force (N/m) and moment (N) along the world's axes, complex amplitudes for unit amplitude.
  Eigen::Matrix<std::complex<double>, 6, 1> calc_force(const Water& water, double frequency,
                                                       double heading) const;

 private:
  /// A point in the water, and force and moment on the hull of a dynamic head of 1 m there, over
  /// rho g (m2, m3).
  struct Sample {
    Vector3 p_W;
    Eigen::Matrix<double, 6, 1> weight;
  };

  void add_panels(const TriangleTree& tree, const TriangleTree::Node& leaf, const Pose& X_RB);
  void add_faces(const TriangleTree& tree, const TriangleTree::Node& leaf, const Pose& X_RB);
  void add(const Vector3& p_R, const Eigen::Matrix<double, 6, 1>& weight);

  Vector3 p_WR_;
  std::vector<Sample> samples_;
};

}  // namespace blocklift::dynamics

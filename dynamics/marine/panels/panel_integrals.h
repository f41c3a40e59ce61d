#pragma once

#include <vector>

#include "dynamics/marine/panels/panel_mesh.h"

namespace blocklift::dynamics {

/// What a panel of unit strength does at a point P. With r = |P - y|, y on the panel, n its normal:
struct PanelPotentials {
  double source = not_a_number;  ///< integral of 1/r, m
  /// Integral of d(1/r)/dn_y: the solid angle (sr) under which P sees the panel, positive on the
  /// side to which the normal points.
  double dipole = not_a_number;
};

/// Exact integrals over a flat panel. For each edge e with the ends 1, 2, the length d, and Y the
/// distance of P's projection from the edge's line (positive where it lies on the panel's side):
///
///   dipole = Omega = 2 arg prod over triangles (r1 r2 r3 + (p1.p2) r3 + (p1.p3) r2 + (p2.p3) r1
///                                              + i 2 A h),
///   source = sum over edges Y ln((r1 + r2 + d)/(r1 + r2 - d)) - h Omega,
///
/// h the height of P above the panel's plane, A the triangle's area. In the plane of the panel the
/// dipole has two limits, +2 pi and -2 pi inside and 0 outside; zero, their mean, is returned at
/// the panel's centroid. Sources: Hess and Smith (1964), Newman (1986) for the source; Van Oosterom
/// and Strackee (1983) for the solid angle.
PanelPotentials calc_panel_potentials(const Panel& panel, const Vector3& point_W);

/// Coordinates of many points, a column each (m): what the integrals are vectorised over.
class PointColumns {
 public:
  PointColumns() = default;
  explicit PointColumns(std::size_t size) : x(size), y(size), z(size) {}
  /// The panels' centroids.
  explicit PointColumns(const PanelMesh& mesh);

  std::size_t size() const { return x.size(); }

  std::vector<double> x, y, z;
};

/// Which of the integrals are due.
enum class PanelIntegral {
  source,           ///< the source alone
  dipole,           ///< the dipole alone
  both,             ///< source and dipole
  coplanar_source,  ///< the source at points in the panel's own plane
};

/// Adds sign times a panel's potentials at each point to source[i] and dipole[i]; the array that is
/// not due may be null. Runs with the widest vector instructions of the machine.
void add_panel_potentials(const Panel& panel, const PointColumns& points, PanelIntegral integral,
                          double sign, double* source, double* dipole);

}  // namespace blocklift::dynamics

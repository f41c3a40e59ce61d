#pragma once

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "dynamics/marine/panels/panel_integrals.h"
#include "dynamics/marine/panels/surface_mesh.h"
#include "dynamics/marine/waves/waves.h"

namespace blocklift::dynamics {

/// Is the bottom too far down to be felt at any frequency?
inline bool is_deep(const Water& water) { return std::isinf(water.depth); }

/// Degrees of freedom of a floating body, in the order of the hydrodynamic literature:
/// displacements along the world's axes, then rotations about them through the body's reference
/// point.
enum DegreeOfFreedom { surge = 0, sway, heave, roll, pitch, yaw };
inline constexpr int modes_per_body = 6;

/// Wetted surface of a body at rest, with the point about which its rotations and moments are
/// taken.
struct WettedBody {
  std::string name;
  PanelMesh hull;                             ///< below z = 0, normals into the water; m, in W
  Vector3 reference_point = Vector3::Zero();  ///< m, in W
};

/// Behaviour of a part of a motion or potential under the reflections: +1 even, -1 odd.
struct Parity {
  int x = 1;  ///< in the plane x = 0
  int y = 1;  ///< in the plane y = 0

  bool operator==(const Parity&) const = default;
};

/// All that the panels of a problem are: bodies, surface, and what symmetry makes of them.
///
/// With planes of symmetry each quantity is the sum of parts that are even or odd in each plane;
/// the parts do not interact, and each is computed on a half or a quarter of the panels. A body may
/// be its own mirror image or that of another.
class PanelModel {
 public:
  /// The bodies' hulls may be whole or hold their half already; with `symmetry` the bodies together
  /// must have those planes.
  /// @throws ModelError if a hull has panels above z = 0 or below the bottom, is inverted or open,
  /// bodies intersect, or are not symmetric: each defect with the body's name and its place.
  PanelModel(std::vector<WettedBody> bodies, const SurfaceMesh& surface, const Water& water,
             const Symmetry& symmetry = {});

  const std::vector<WettedBody>& bodies() const { return bodies_; }
  int body_count() const { return static_cast<int>(bodies_.size()); }
  int mode_count() const { return modes_per_body * body_count(); }
  const Water& water() const { return water_; }
  const Symmetry& symmetry() const { return symmetry_; }
  const SurfaceMesh& surface() const { return surface_; }

  /// The panels that are computed with: those of the part x >= 0 and/or y >= 0.
  const PanelMesh& body_mesh() const { return body_mesh_; }
  const PanelMesh& surface_mesh() const { return surface_.mesh; }
  const Eigen::VectorXd& body_areas() const { return body_areas_; }        ///< m2
  const Eigen::VectorXd& surface_areas() const { return surface_areas_; }  ///< m2

  /// 1, 2 or 4 parts.
  std::vector<Parity> parities() const;
  /// Sign that a part takes in an image of the computed panels.
  int sign(const Parity& parity, int image) const;

  /// Part of each mode's normal velocity on the computed panels, a column for each mode (6N): n.u
  /// for unit velocity (m/s) or angular velocity (rad/s), n into the water. Columns without that
  /// part are zero.
  Eigen::MatrixXd normal_velocities(const Parity& parity) const;
  /// Part of a complex field f(p_W, n) on the bodies.
  template <class Field>
  Eigen::VectorXcd part_of(const Parity& parity, const Field& field) const {
    const int images = symmetry_.image_count();
    Eigen::VectorXcd part = Eigen::VectorXcd::Zero(body_mesh_.size());
    for (int k = 0; k < body_mesh_.size(); ++k) {
      const Panel& panel = body_mesh_.panels[k];
      for (int g = 0; g < images; ++g) {
        part[k] += static_cast<double>(sign(parity, g)) / images *
                   std::complex<double>(field(symmetry_.reflect(g, panel.centroid),
                                              symmetry_.reflect(g, panel.normal)));
      }
    }
    return part;
  }

 private:
  void check(const WettedBody& body) const;
  void find_images();

  std::vector<WettedBody> bodies_;
  Water water_;
  Symmetry symmetry_;
  SurfaceMesh surface_;
  PanelMesh body_mesh_;
  std::vector<int> body_of_panel_;
  std::vector<std::vector<int>> image_body_;  ///< by image, then body
  Eigen::VectorXd body_areas_, surface_areas_;
};

/// The planes of symmetry that the bodies' panels together have, to a tolerance of 1e-6 of a panel.
Symmetry find_symmetry(const std::vector<WettedBody>& bodies);

/// The bodies' water lines, body after body.
std::vector<WaterLine> find_water_lines(const std::vector<WettedBody>& bodies);

}  // namespace blocklift::dynamics

#pragma once

#include <memory>
#include <optional>

#include "dynamics/force/force_element.h"
#include "dynamics/marine/hull/hydrostatics.h"
#include "dynamics/marine/loads/water_plane.h"
#include "dynamics/marine/loads/wave_surface.h"
#include "dynamics/marine/waves/sea.h"

namespace blocklift::dynamics {

/// How incident waves act on a hull.
enum class WaveLoading {
  none,           ///< the surface stays calm to this element (waves come from a database)
  froude_krylov,  ///< the pressure of the undisturbed wave, on the surface that the wave wets
};

/// Buoyancy of a hull, and the Froude-Krylov force of the waves, on the instantaneous wetted
/// surface.
///
/// In still water: the exact force of hydrostatics.h (paper eq. 19). In waves: the surface is where
/// the incident wave stands, and the pressure is
///
///   p = rho g (p_d/(rho g) - z),   p = 0 at the surface (waves.h, Wheeler's stretching).
///
/// The hull is taken in two parts (WaveSurface). Over small and curved panels the height of the
/// surface, and p, are linear between the vertices and the points where the edges leave the water,
/// and are integrated exactly: for a panel of size d in a wave of number k the error is of the
/// order (k d)^2/8 of the dynamic part. Flat faces to the scale of the waves are cut along the
/// chord of the surface, and p is integrated over what is wet by three points a triangle, exact to
/// the second degree (Strang and Fix 1973). In both the hydrostatic part is exact for the hull so
/// cut. Boxes of either that lie below the deepest trough are taken whole (PressureBoxes): there
/// the hydrostatic part is exact, and p_d right to a share of WaveSurface::box_tolerance. Energy:
/// rho g times the energy of hydrostatics.h is stored; what waves add is supplied.
///
/// **Of a hull that drifts** (`p_BoR_B`) only heave, roll and pitch act in waves. The whole
/// pressure has a mean along the water where the hull moves with the waves: by Gauss's theorem
///
///   mean of rho int a dV,   a the acceleration of the wave's water, over the hull below the wave,
///
/// which is one of the parts of the mean force of second order (Pinkster 1980, ch. III: the
/// relative elevation at the water line, the pressure's gradient along the motion). The momentum of
/// the waves far away holds all of these parts together (Maruo 1960), so that SlowDrift would count
/// this one twice, and near a resonance of roll it is the larger. To the first order the force that
/// is left out is that of the wave on the hull at rest, which DiffractionForce has then
/// (FroudeKrylovPart::along_water).
class HullForce {
 public:
  struct Definition {
    std::string name;
    BodyIndex body = -1;
    std::shared_ptr<const HullClusters> hull;  ///< in the frame of the body
    std::shared_ptr<const Sea> sea;
    WaveLoading wave_loading = WaveLoading::froude_krylov;
    /// Of a hull that drifts: R, about which its moment is divided into roll, pitch and yaw, m.
    /// None: all of its force acts.
    std::optional<Vector3> p_BoR_B = {};
  };

  /// @throws ModelError if the hull or sea is missing or the body is the world.
  explicit HullForce(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Force on the body about Bo in W (moment, force).
  ForceVector calc_force(const MotionState& state) const;
  /// The same where the water's surface is a plane, exact for the polyhedron: with the plane level,
  /// gravity is rho g sqrt(1 + slope^2) along its normal.
  ForceVector calc_force(const MotionState& state, const WaterPlane& plane) const;
  void add_forces(const MotionState& state, Loads& loads) const;
  /// In still water the exact stiffness; in waves that of still water at the same pose, which is
  /// near enough for an integrator's iteration.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  EnergyAccount calc_energy(const MotionState& state) const;
  /// The stored part alone, J.
  double calc_stored_energy(const MotionState& state) const;
  /// Do waves act on it?
  bool in_waves() const {
    return definition_.wave_loading == WaveLoading::froude_krylov &&
           !definition_.sea->waves.is_still();
  }

  /// Hydrostatics at the calm water line, for reports.
  Hydrostatics calc_calm_hydrostatics(const MotionState& state) const;

 private:
  ForceVector calc_force_in_waves(double time, const Pose& X_WB) const;
  template <class AddLeaf>
  void add_part(double time, const Pose& X_WB, const SurfaceRange::Range& range,
                const WaveSurface::Part& part, AddLeaf&& add_leaf,
                ForceVector& F_B_over_rho_g) const;
  void add_panels(double time, const Pose& X_WB, const TriangleTree& tree,
                  const TriangleTree::Node& leaf, ForceVector& F_B_over_rho_g) const;
  void add_faces(double time, const Pose& X_WB, const TriangleTree& tree,
                 const TriangleTree::Node& leaf, ForceVector& F_B_over_rho_g) const;
  void add_box(double time, const Pose& X_WB, const PressureBoxes::Box& box,
               ForceVector& F_B_over_rho_g) const;

  Definition definition_;
  std::shared_ptr<const WaveSurface> surface_;  ///< null in still water
  double rho_g_;
};

static_assert(ForceElement<HullForce>);

}  // namespace blocklift::dynamics

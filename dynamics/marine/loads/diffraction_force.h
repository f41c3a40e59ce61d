#pragma once

#include <memory>

#include "dynamics/force/force_element.h"
#include "dynamics/marine/loads/draught_shares.h"
#include "dynamics/marine/radiation/hydrodynamic_series.h"
#include "dynamics/marine/waves/sea.h"
#include "dynamics/multibody/added_inertia.h"

namespace blocklift::dynamics {

/// How much of the undisturbed wave's force DiffractionForce takes from its database.
enum class FroudeKrylovPart {
  none,         ///< HullForce has it
  along_water,  ///< surge, sway and yaw, of a hull that drifts: HullForce has the rest
  whole,        ///< there is no HullForce
};

/// Force of the waves that a floating body scatters, from a database: linear in each component of
/// the sea,
///
///   F = Re sum_c X(w_c, theta_c - psi) a_c exp(i (w_c t - phase_c - k_c.(p_WR - p_0)))
///
/// in the level axes of the frame H (RadiatedWater, level_axes.h) about its origin R, psi being the
/// heading of H and p_0 the reference point of the database, both level: a vessel that drifts or
/// turns meets the wave elsewhere and under another heading, and the force does not roll and pitch
/// with it. R's swaying in time with a wave is in the phase, too. What that leaves in the mean is
/// along the wave's way, k/w times the power that its force along the water feeds in, and in the
/// limit of long waves due (Rainey 1989). X is linear between the database's frequencies and
/// headings, its phase taken at R. As much of the incident wave's force as `froude_krylov` says
/// comes from the database as well, on the mean wetted surface; the rest is left to HullForce. The
/// waves' ramp acts on it. While a body is lowered X is interpolated between its draughts
/// (DraughtInterpolation).
class DiffractionForce {
 public:
  struct Definition {
    std::string name;
    BodyFrame frame;
    std::shared_ptr<const HydrodynamicDatabase> database;
    int database_body = 0;  ///< which of the database's bodies it is
    std::shared_ptr<const Sea> sea;
    FroudeKrylovPart froude_krylov = FroudeKrylovPart::none;
    /// In place of a single database: several, the first of a dry body (draught 0).
    std::shared_ptr<const HydrodynamicSeries> series = {};
    DraughtMark mark = {};  ///< where the draught of the series' lowered body is read
  };

  /// @throws ModelError if something is missing, a wave is outside the database's frequencies, or
  ///   its headings lie more than 45 degrees apart.
  explicit DiffractionForce(Definition definition);

  const std::string& name() const { return definition_.name; }
  const Definition& definition() const { return definition_; }

  /// Force on the body about R in W.
  ForceVector calc_force(const MotionState& state) const;
  void add_forces(const MotionState& state, Loads& loads) const {
    add_force(state, calc_force(state), loads);
  }
  /// A force on the body about R in W that calc_force found.
  void add_force(const MotionState& state, const ForceVector& F_R_W, Loads& loads) const;
  /// How the wave differs where the vessel goes is left out: its length is far beyond a step's
  /// travel.
  void add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const;
  /// All power is supplied by the waves.
  EnergyAccount calc_energy(const MotionState& state) const {
    return calc_energy(state, calc_force(state));
  }
  EnergyAccount calc_energy(const MotionState& state, const ForceVector& F_R_W) const;

 private:
  using Amplitude = Eigen::Matrix<std::complex<double>, 6, 1>;
  std::size_t state_count() const { return definition_.series->databases.size(); }
  void add_component(const WaveComponent& wave, double wave_number);
  Amplitude amplitude_at(const HydrodynamicDatabase& database, double frequency,
                         std::size_t heading) const;

  Definition definition_;
  DraughtInterpolation interpolation_;
  std::vector<double> headings_;  ///< ascending, the first repeated after a turn
  std::vector<WaveComponent> waves_;
  /// A wave's number, rad/m, and the unit vector along its way.
  struct Way {
    double wave_number, x, y;
  };
  std::vector<Way> ways_;
  /// By wave, then draught, then heading: times the amplitude, phase at R.
  std::vector<Amplitude> amplitudes_;
};

static_assert(ForceElement<DiffractionForce>);

}  // namespace blocklift::dynamics

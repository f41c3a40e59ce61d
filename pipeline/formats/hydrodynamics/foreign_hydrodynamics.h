#pragma once

#include <filesystem>
#include <numbers>
#include <vector>

#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"

/// Hydrodynamic databases of other programs. All errors are HydrodynamicFileError and name the
/// file. What is read is checked (dynamics::require_sound); retardation functions and the added
/// mass at infinite frequency are computed where a file lacks them.
namespace blocklift::pipeline {

/// In radians: other programs write angles in degrees.
inline constexpr double degree = std::numbers::pi / 180.0;

/// WAMIT's XBODY: where the axes lie that a body's modes are along and about.
struct WamitBody {
  dynamics::Vector3 p_W = dynamics::Vector3::Zero();  ///< m
  double heading = 0.0;                               ///< of the x axis, rad
};

/// What files of WAMIT do not tell.
struct WamitScales {
  double length = 1.0;    ///< L, WAMIT's ULEN, m
  dynamics::Water water;  ///< density, gravity, depth
  /// In their order; empty: a single one at the origin. Also of files of Capytaine.
  std::vector<WamitBody> bodies = {};
};

/// By the ending: .1, .2, .3, .hst WAMIT (all of the name); .nc Capytaine; .h5 BEMIO, or our own.
/// `scales.bodies` of a file that tells them itself are refused.
/// Those of other programs are passive (require_passive).
HydrodynamicFile import_hydrodynamics(const std::filesystem::path& path, const WamitScales& scales);

/// BEMIO, the files of WEC-Sim. Bodies /body1, /body2 ...; C order (6, 6N, frequencies).
///   added mass / rho, damping / (rho w), K / rho, stiffness / (rho g), excitation / (rho g)
/// unless `scaled` is set; headings in degrees; force Re X e^{+i w t} of the wave
/// cos(w t - k.x). Rotations and moments about the centre of gravity cg, which is given from the
/// water surface. Froude-Krylov and scattering forces are read where they are (else the whole
/// excitation counts as diffraction), mean drift forces / (rho g), shaped as the excitation, from
/// hydro_coeffs/mean_drift/METHOD/val, METHOD being control_surface, pressure_integration or, of a
/// single body, momentum_conservation. Of a file with a body that displaces nothing (disp_vol 0),
/// cb and cg are not taken for centres of buoyancy and mass. Written about the centres of mass;
/// a database that does not tell volumes and centres is refused. Source: WEC-Sim documentation,
/// "BEMIO"; conventions of its radiation and excitation terms.
dynamics::HydrodynamicDatabase read_bemio(const std::filesystem::path& path);
void write_bemio(const std::filesystem::path& path, const dynamics::HydrodynamicDatabase& database);

/// WAMIT's numeric output: `name`.1, and where they are `name`.3, else .2, and `name`.hst.
///   .1    PER I J A [B]                   A / (rho L^k), B / (rho L^k w)
///   .3, .2   PER BETA I |X| phase Re Im      X / (rho g a L^m)
///   .hst  I J C                           C / (rho g L^(k-1))
///   .7, .9, .8   PER BETA1 BETA2 I |F| phase Re Im   F / (rho g a^2 L^(m-1)), where BETA1 = BETA2
/// Mean drift forces come from the first of these endings that is there, .8 for a single body only.
/// A .1 file has the same pairs of modes at all periods, and those above the diagonal below it,
/// too, unless it has none there: then it is mirrored. A .3 file has all its periods and headings
/// for the modes that the .1 file has on its diagonal, and for no others; a .hst file all 36
/// entries of each body. k = 3 for displacements, 4 mixed, 5 rotations; m = 2, 3. PER is the
/// period, s; 0: infinite frequency, negative: zero frequency (passed over). BETA in degrees, force
/// Re X e^{+i w t} of the wave cos(w t - k.x). Modes 6 (n - 1) + 1 ... of body n, about the bodies'
/// own origins, which the files do not tell: those of `scales`, or of a single body the world's.
/// They are turned to the world's axes; headings and phases count from there in WAMIT, too. Several
/// bodies without their axes are refused, and so is the mean drift of turned ones, whose axes
/// depend on the method. Written with 17 digits, about wamit_points(). Source: WAMIT User Manual
/// v7, sections 3.8, 4.2, 4.3, 4.5 and 4.13.
dynamics::HydrodynamicDatabase read_wamit(const std::filesystem::path& name,
                                          const WamitScales& scales);
/// @param length L, WAMIT's ULEN, m.
void write_wamit(const std::filesystem::path& name, const dynamics::HydrodynamicDatabase& database,
                 double length = 1.0);

/// What write_wamit writes each body's rotations and moments about, m, in W: of a single body the
/// world's origin, which read_wamit takes; of several the points of the water line over or under
/// their reference points.
std::vector<dynamics::Vector3> wamit_points(const dynamics::HydrodynamicDatabase& database);

/// Capytaine's NetCDF, NetCDF-4 or of the classic formats: added_mass, radiation_damping (omega,
/// radiating_dof, influenced_dof), Froude_Krylov_force and diffraction_force or excitation_force
/// (complex or reim, omega, wave_direction, influenced_dof), dimensions in whatever order the file
/// names; degrees of freedom "Heave" or "body__Heave", as strings or as characters. SI, headings in
/// rad. Without omega, the frequencies follow from period or freq. Its time factor is e^{-i w t}:
/// forces are conjugated. Rotations about rotation_center, else center_of_mass, else `bodies`, in
/// the order in which the degrees of freedom name them and without heading, else the world's
/// origin. Capytaine's own datasets hold neither centre. Bodies under way (forward_speed) are
/// refused. Source: Capytaine documentation, "Conventions" and "Export outputs".
dynamics::HydrodynamicDatabase read_capytaine(const std::filesystem::path& path,
                                              const std::vector<WamitBody>& bodies = {});

/// Does a file of Capytaine tell what its rotations are about?
bool tells_rotation_centres(const std::filesystem::path& path);

}  // namespace blocklift::pipeline

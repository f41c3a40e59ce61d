#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

// What a database holds of the flow about its bodies, however that was found.

/// @throws ModelError unless there are frequencies, all of them positive and ascending.
void check_frequencies(const DatabaseSettings& settings);

/// Bodies, water, frequencies and headings, and what needs no flow: Froude-Krylov forces
/// (WaveOnHulls) and, where the far field is asked for, their share of it (add_far_field). All
/// other forces are nothing.
HydrodynamicDatabase begin_database(const PanelModel& model, const DatabaseSettings& settings);

/// Largest share over the frequencies that amounts are of each mode's force on itself, B + i w A;
/// all modes x frequencies. Zero for a mode with next to no force, such as the turns of a round
/// body about its axis: less than a thousandth of the largest w A of those that move the same body
/// in the same way, along axes or about them.
/// @param modes their numbers, a row each.
Eigen::VectorXd largest_share(const std::vector<int>& modes, const Eigen::MatrixXcd& forces,
                              const Eigen::MatrixXd& amounts);

/// The same of all modes of a database.
Eigen::VectorXd largest_share(const HydrodynamicDatabase& database, const Eigen::MatrixXd& amounts);

/// What coarser panels make of a database's forces, to be compared with it.
struct CoarserForces {
  /// All nothing. @param count of frequencies; 0: nothing is sought.
  CoarserForces(Eigen::Index modes, std::size_t count, std::size_t headings);
  bool sought() const { return !radiation.empty(); }
  /// Of the part's modes: there is no such solution.
  void miss(const std::vector<int>& modes);

  std::vector<Eigen::MatrixXcd> radiation;    ///< B + i w A, 6N x 6N for each frequency
  std::vector<Eigen::MatrixXcd> diffraction;  ///< 6N x headings for each; empty: not sought
  /// What of each mode's force on itself lies within the coarser panels (calc_coarser_arms); 6N x
  /// frequencies.
  Eigen::MatrixXcd arms;
  /// The added mass of each mode on itself at infinite frequency, 6N, and the coarser panels' arms
  /// in it; and what rows of panels that have no coarser ones miss of it (calc_error_of_lone_rows).
  /// kg, kg m2.
  Eigen::VectorXd infinite_mass, infinite_arms, infinite_error;
};

/// The panels' error of each mode's radiation force on itself, relative: the largest over the
/// frequencies, the infinite among them. There the water moves most sharply round edges and along
/// water lines, and a shallow hull's error is up to twice that in waves; forces without memory have
/// it.
///
/// From what B + i w A changes by from coarser panels (error_of_panels): with their arms filled in
/// or without, whichever is more. On broad flat bottoms arms hide the edges' error: they make
/// turning too easy, at second order in the panels' size, where sharp edges make it too hard at
/// first. Filled in, what is left is the edges'.
Eigen::VectorXd calc_radiation_error(const HydrodynamicDatabase& database,
                                     const CoarserForces& coarser, const PanelClusters& clusters);

/// For each mode, the force of waves of unit amplitude in the mean over all headings, the largest
/// over the frequencies, by what waves carry off (Haskind's relation, Newman 1977): the mean of
/// |X|^2 is 4 rho g c_g B/k. Nothing where damping is below a hundredth of the mode's force on
/// itself at all frequencies: the runs do not know so little, and in long waves its root would make
/// much of it. What a lid takes counts as sent out. N/m, N.
Eigen::VectorXd calc_mean_excitation(const HydrodynamicDatabase& database);

/// For each mode, the largest difference of its diffraction from that of coarser panels, over
/// frequencies and headings, as a share of the largest excitation of the mode over them, or of
/// calc_mean_excitation if that is more: waves along a plane of symmetry leave next to nothing of
/// the modes across it, which tells nothing of the panels. Zero for a mode on which waves exert
/// next to nothing: less than a thousandth of the largest excitation of those that move the same
/// body in the same way. Empty without headings.
Eigen::VectorXd largest_excitation_change(const HydrodynamicDatabase& database,
                                          const CoarserForces& coarser);

/// Normal velocities on the bodies that a wave of unit amplitude would have there, with the other
/// sign: those of the waves scattered. A column for each heading (rad); 1/s.
Eigen::MatrixXcd calc_opposed_velocities(const PanelModel& model, const Parity& parity,
                                         double frequency, const std::vector<double>& headings);

/// The flow of one even or odd part at one frequency.
struct FlowOfPart {
  Parity parity;
  std::vector<int> modes;             ///< that have this part
  Eigen::MatrixXd normal_velocities;  ///< of these modes on the bodies' panels
  Eigen::MatrixXcd potentials;        ///< there, of unit velocities; m, m2
  Eigen::MatrixXcd scattered = {};    ///< there, of waves of unit amplitude, for each heading; m2/s
  /// Potentials by panels of twice the size, on the panels themselves; empty: not known.
  Eigen::MatrixXcd coarser_potentials = {};
};

/// Adds the part's share of diffraction, by Haskind's relation.
/// @param frequency index.
/// @param coarser diffraction by the coarser potentials, added to; 6N x headings; null: not sought.
void add_diffraction(const PanelModel& model, const FlowOfPart& flow, std::size_t frequency,
                     HydrodynamicDatabase& database, Eigen::MatrixXcd* coarser = nullptr);

/// What the coarser panels leave out of the part's radiation forces as they have one pressure and
/// one velocity each: of a mode's force on itself, with v its normal velocity, phi its potential,
/// both of the finer panels, and means over the flat clusters of these,
///
///   -2 rho sum over panels of area (v - mean v)(phi - mean phi),
///
/// once for the pressures' arms, and by reciprocity once for the velocities; of its added mass.
/// Nothing where a cluster moves along its normal as a whole.
/// @returns of the flow's modes; kg, kg m2.
Eigen::VectorXcd calc_coarser_arms(const PanelModel& model, const FlowOfPart& flow,
                                   const CoarserPanels& panels);

/// Adds the part's arms at a frequency (index).
void add_coarser_arms(const PanelModel& model, const FlowOfPart& flow, const CoarserPanels& panels,
                      const HydrodynamicDatabase& database, std::size_t frequency,
                      CoarserForces& coarser);

/// Adds what the part sends out far away: by Green's theorem with the wave psi = f(z) exp(i k
/// (x cos theta + y sin theta)), f that of the incident waves, and stationary phase,
///
///   H = sqrt(k/2 pi) exp(i pi/4)/(2 c_g) int (dphi/dn psi - phi dpsi/dn) dS over the bodies.
///
/// The first term of what the bodies radiate is there already (begin_database): it is the
/// Froude-Krylov force of a wave that goes the other way, so that Haskind's relation holds between
/// the far field and the excitation.
/// @param frequency index.
void add_far_field(const PanelModel& model, const FlowOfPart& flow, std::size_t frequency,
                   HydrodynamicDatabase& database);

}  // namespace blocklift::dynamics

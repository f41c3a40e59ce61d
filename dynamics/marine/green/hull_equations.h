#pragma once

#include <array>
#include <complex>
#include <vector>

#include "dynamics/marine/green/water_plane_cells.h"
#include "dynamics/marine/green/wave_green_function.h"
#include "dynamics/marine/panels/panel_clusters.h"
#include "dynamics/marine/radiation/database_parts.h"
#include "dynamics/marine/radiation/free_surface.h"

namespace blocklift::dynamics {

/// Memory (bytes) of the real matrices alone, which are kept from one frequency to the next.
double hull_matrices_bytes(int unknowns, int parts);

/// Memory (bytes) that HullEquations take at their peak, while one frequency is solved.
/// @param unknowns panels and cells that are computed with. @param parts even and odd ones.
double hull_equations_bytes(int unknowns, int parts);

/// Flow about hulls in waves of one frequency, with unknowns on the hulls alone: the surface is in
/// the source's own waves (WaveGreenFunction), to any distance.
///
/// With phi the potential (m2/s) of steady oscillation, Re(phi exp(i w t)), and n into the water,
/// both constant on a panel, at the panels' centroids
///
///   2 pi phi = int (phi dG/dn - G dphi/dn) dS + sum over cells of b int psi G dS.
///
/// Cells of a damping lid have psi = phi and b = ((w - i nu)^2 - w^2)/g, which is what the lid
/// takes from dphi/dz = w^2/g phi. Cells of the water planes within the bodies have b = -w^2/g:
/// there psi is nothing if the equations are exact, and the flow within the bodies has a rigid lid,
/// so that no wave swings there. Without them the equations had no solution at the frequencies of
/// such waves, and bad ones beside them. At either kind's centroids
///
///   4 pi psi = int (phi dG/dn - G dphi/dn) dS + sum over cells of b int psi G dS.
///
/// What of G is 1/r and its images is integrated exactly over the panels, once for all frequencies;
/// the rest by the value at the centroid, and over near panels at 4 or 16 points. Cells within the
/// bodies are twice as coarse as the panels: psi is next to nothing on them. Sources: Kleinman
/// (1982) for the extended equations; Lee, Newman and Zhu (1996), Int. J. Numerical Methods in
/// Fluids 23; Chen (2005) for the lid.
class HullEquations {
 public:
  struct Settings {
    std::vector<DampingLid> lids = {};
    double cell_size = 0.0;   ///< of the lids' cells, m; 0: the panels' mean size
    double cover_size = 0.0;  ///< of the cells within the bodies, m; 0: twice that of the lids
    /// Cover the bodies' water planes: without them there are irregular frequencies.
    bool cover_water_planes = true;
    int threads = 0;            ///< 0: one a core
    double memory_limit = 0.0;  ///< bytes; 0: usable_memory()
  };
  /// @throws SimulationError if it does not fit into the memory allowed, with the figures.
  HullEquations(const PanelModel& model, const Settings& settings);

  /// Panels and cells that are computed with, after symmetry.
  int size() const { return static_cast<int>(points_.size()); }
  int cell_count() const { return cells_.size(); }
  /// Of the hulls' panels, for the coarser flow.
  const CoarserPanels& coarser_panels() const { return coarser_; }

  using Part = FlowOfPart;
  /// What is solved besides the modes' flow.
  struct Extent {
    std::vector<double> headings = {};  ///< of waves whose scattering is sought, rad
    /// The modes' flow with panels of twice the size, too.
    bool coarser = false;
  };
  /// @param frequency rad/s; infinite: the flow of an impulse, phi = 0 on the surface.
  /// @throws ModelError unless it is positive; SimulationError if a matrix is singular.
  std::vector<Part> solve(double frequency, const Extent& extent) const;
  std::vector<Part> solve(double frequency) const { return solve(frequency, Extent{}); }

  /// B + i w A of unit velocities, 6N x 6N; the added mass itself of the infinite frequency.
  Eigen::MatrixXcd calc_radiation(const std::vector<Part>& parts, double frequency) const;
  /// calc_radiation with the coarser panels.
  Eigen::MatrixXcd calc_coarser_radiation(const std::vector<Part>& parts, double frequency) const;
  /// Diffraction forces in waves of unit amplitude, 6N x headings (rad), by Haskind's relation;
  /// N/m, N.
  Eigen::MatrixXcd calc_diffraction(const std::vector<Part>& parts, double frequency,
                                    const std::vector<double>& headings) const;

 private:
  /// Matrices of one part: panels and cells (columns) at all centroids (rows).
  template <class Scalar>
  struct Influence {
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> source, dipole;
  };
  void make_cells();
  /// A panel's images by which 1/r is summed up: itself, in the surface, and at the bottom.
  std::size_t mirror_count() const { return is_deep(model_.water()) ? 2 : 3; }
  std::vector<std::array<PointColumns, 3>> reflect(const std::vector<Vector3>& points) const;
  void integrate_images();
  void integrate_at_middles();
  std::vector<Influence<std::complex<double>>> integrate_waves(double frequency) const;
  Eigen::MatrixXcd make_matrix(const Influence<std::complex<double>>& waves, double frequency,
                               int count) const;
  /// The modes' potentials by clusters of the hulls' panels, on each panel.
  /// @param right of these velocities. @param at_middles of the part (at_middles_).
  /// @param velocities of the modes, the mean of its cluster on each panel, a column each.
  Eigen::MatrixXcd solve_coarser(const Influence<double>& at_middles,
                                 const Eigen::MatrixXcd& matrix, const Eigen::MatrixXcd& right,
                                 const Eigen::MatrixXd& velocities) const;
  struct WaveBlock;
  /// Adds what the waves of panels or cells from `column` on are at the centroids from `row` on,
  /// and the other way round.
  void add_wave_block(int row, int column, WaveBlock& block) const;
  /// Adds what the waves of panel or cell j are at centroid i.
  /// @param field where the centroid is in the block's image, R its level distance (m).
  /// @param value between the centroids.
  void add_wave(int i, int j, const Vector3& field, double R, const WaveGreenFunction::Value& value,
                WaveBlock& block) const;
  const Panel& panel(int j) const {
    return j < hull_count_ ? model_.body_mesh().panels[j] : cells_.panels[j - hull_count_];
  }

  const PanelModel& model_;
  Settings settings_;
  WaterPlaneCells cells_;
  int hull_count_ = 0;
  std::vector<Vector3> points_;         ///< centroids
  std::vector<double> diameters_;       ///< m
  double reach_ = 0.0, deepest_ = 0.0;  ///< m
  std::vector<Parity> parities_;
  CoarserPanels coarser_;  ///< of the hulls' alone
  /// For each part, what 1/r and its images at flat clusters' middles (rows) are more than in the
  /// mean over the clusters, of the hulls' panels (columns).
  std::vector<Influence<double>> at_middles_;
  std::vector<Influence<double>> at_middles_without_waves_;  ///< the same of infinite frequency
  /// Of 1/r + 1/r1 + 1/r2 by part, and of 1/r1 alone.
  std::vector<Influence<double>> images_, surface_images_;
};

}  // namespace blocklift::dynamics

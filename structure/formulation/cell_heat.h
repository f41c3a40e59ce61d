#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/mesh/heat.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// By how much cells of a mesh are warmer than without strain, K and K/m: a column a case. A kind
/// of cells that stays as it is has no rows.
struct TemperatureRises {
  /// Of each shell: at its corners, in the middles of its edges eta = 0, eta = 1, xi = 0 and xi = 1
  /// beyond the mean of their ends, the same eight of the slope along its normal.
  static constexpr Eigen::Index rows_of_shell = 16;
  /// Of each beam: at its first end the mean over the section, the slopes along axes 3 and 2; the
  /// same at the other end.
  static constexpr Eigen::Index rows_of_beam = 6;
  Eigen::MatrixXd of_shells, of_beams;
  Eigen::MatrixXd of_solids;  ///< at the nodes of one solid after another
};

/// What heat does to the cells of a space, in several cases: a column each, and nothing in some of
/// them.
///
/// A cell that nothing holds takes the strain e_0, which no stress belongs to: the stress of a
/// motion is D (e - e_0). What holds it where nothing moves are the forces D e_0; they are given
/// here, since a plate that does not bend has no e_0 of its own, and their virtual work is the load
/// of heat, int B' D e_0. Source: Zienkiewicz, Taylor, Zhu (2013), chapter 2, initial
/// strains.
///
/// Cells of degree 1 have one temperature, that of their middle: their strain is as good as even,
/// and the stress of a free plate would not vanish with another.
class CellHeat {
 public:
  /// The space and the expansions must outlive this object.
  CellHeat(const Space& space, const Expansions& expansions, TemperatureRises rises);

  Eigen::Index cases() const { return cases_; }
  /// The same of some of the cases, which are in a row.
  CellHeat part(Eigen::Index first, Eigen::Index count) const;
  /// Membrane forces and moments (11, 22, 12 of both; N/m, N) that hold a shell's cell at a point
  /// of its unit square, along unit tangents e_1, e_2 and about the shell's own normal: 6 x cases.
  Eigen::MatrixXd shell_forces(int cell, const Eigen::Vector2d& xi, const Vector3& e_1,
                               const Vector3& e_2, double thickness) const;
  /// Strains (as BeamPoint has them) that a beam's cell takes if nothing holds it: 6 x cases.
  Eigen::MatrixXd beam_strains(int cell, double xi) const;
  /// What the released ends of a beam's cell do of themselves for those strains, beyond what they
  /// do for motions of its nodes (beam_motion): 6 nodes x cases.
  Eigen::MatrixXd beam_release(int cell) const;
  /// Stresses that hold a solid at points where its shape functions (points x nodes) are given, Pa:
  /// 6 points x cases.
  Eigen::MatrixXd solid_stresses(int solid, const Eigen::MatrixXd& values) const;

  /// Loads that the holding forces turned round are: six rows a node, N and N m.
  Eigen::MatrixXd loads() const;
  /// 1/2 int e_0 . D e_0, less what released ends of beams give away of it, J. The strain energy of
  /// a motion u is 1/2 u' K u - loads' u + this.
  Eigen::RowVectorXd held_energy() const;

 private:
  struct AtPoint {
    Eigen::RowVectorXd rise, slope;
  };
  AtPoint at_shell(int cell, const Eigen::Vector2d& xi) const;
  void add_shells(Eigen::MatrixXd& loads) const;
  void add_beams(Eigen::MatrixXd& loads) const;
  void add_solids(Eigen::MatrixXd& loads) const;
  Eigen::MatrixXd beam_forces(int cell) const;
  Eigen::RowVectorXd shell_energy() const;
  Eigen::RowVectorXd beam_energy() const;
  Eigen::RowVectorXd solid_energy() const;
  /// Stress per kelvin.
  ExpansionStrains held_stress(int solid) const;
  ExpansionStrains expansion_of(int solid) const;

  const Space* space_;
  const Expansions* expansions_;
  TemperatureRises rises_;
  Eigen::Index cases_;
  std::vector<Eigen::Index> first_of_solid_;
};

}  // namespace blocklift::structure

#include "structure/stress/open_sections.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "structure/formulation/beam.h"
#include "structure/stress/beam_stress.h"

namespace blocklift::structure {

namespace {

struct LargestOfBars {
  double von_mises = 0;
  int cell = -1;
  double xi = 0;
};

double share_of_beam(const BeamCell& cell, double xi) { return cell.origin + cell.size * xi; }

/// sqrt(3) times the largest shear stress of torsion at a place of a beam, Pa.
double stress_of_torsion(const Space& space, const LargestOfBars& at, const Eigen::VectorXd& motion,
                         const CellHeat* heat) {
  const BeamCell& cell = space.beams()[at.cell];
  const Mesh& mesh = space.mesh();
  const Beam& beam = mesh.beams[cell.beam];
  const double share = share_of_beam(cell, at.xi);
  const BeamSection section = section_at(mesh, beam, share);
  const Eigen::MatrixXd forces = beam_forces(space, at.cell, at.xi, motion, heat);
  const double moment = torsion_about_twist_centre(section, forces)[0];
  double largest = 0;
  for (const SectionPoint& point : points_of_beam(mesh, beam, share))
    largest = std::max(largest, std::abs(point.of_torsion * moment));
  return std::numbers::sqrt3 * largest;
}

}  // namespace

bool is_open_section(const BeamSection& section) {
  const double mean = (section.second_moment_2 + section.second_moment_3) / 2;
  const double lesser = mean - std::hypot((section.second_moment_2 - section.second_moment_3) / 2,
                                          section.product_23);
  return section.torsion > 0 && section.torsion < 0.5 * lesser;
}

std::vector<TwistedBars> find_twisted_open_bars(const Space& space, const Eigen::VectorXd& motion,
                                                const CellHeat* heat) {
  const Mesh& mesh = space.mesh();
  std::map<int, LargestOfBars> of_groups;
  for (int c = 0; c < static_cast<int>(space.beams().size()); ++c) {
    const Beam& beam = mesh.beams[space.beams()[c].beam];
    LargestOfBars& largest = of_groups[mesh.regions[beam.region].group];
    for (const double xi : {0.0, 0.5, 1.0}) {
      const double here = largest_von_mises(beam_stresses(space, c, xi, motion, heat).col(0));
      if (here > largest.von_mises) largest = {here, c, xi};
    }
  }
  std::vector<TwistedBars> twisted;
  for (const auto& [group, largest] : of_groups) {
    if (largest.cell < 0) continue;
    const BeamCell& cell = space.beams()[largest.cell];
    const Beam& beam = mesh.beams[cell.beam];
    const double share = share_of_beam(cell, largest.xi);
    if (beam.is_rod || !is_open_section(section_at(mesh, beam, share))) continue;
    const double torsion = stress_of_torsion(space, largest, motion, heat);
    if (torsion < 0.5 * largest.von_mises) continue;
    twisted.push_back({mesh.groups[group].name, largest.von_mises, torsion,
                       beam_point(space, largest.cell, largest.xi).place});
  }
  return twisted;
}

}  // namespace blocklift::structure

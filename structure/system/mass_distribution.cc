#include "structure/system/mass_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"

namespace blocklift::structure {

namespace {

/// The density over that of the plates is alpha (1 + g . (x - centre of the plates)), and g follows
/// from the way from there to the stated centre alone: more mass does not help, a shorter way does.
/// @param worst where the density is least, below zero.
[[noreturn]] void refuse_centre(const MassProperties& found, const Vector3& stated,
                                const Vector3& worst) {
  constexpr double margin = 0.99;  // on the way at which the density is zero there
  const double share = margin / (1 - found.smallest_density_factor / found.factor_alpha);
  const Vector3& steel = found.steel_centre_B;
  const Vector3 possible = steel + share * (stated - steel);
  throw ModelError(
      fmt::format("no spread of outfitting over the plates, whose centre of mass is ({:.3f}, "
                  "{:.3f}, {:.3f}) m, "
                  "brings it to the stated ({:.3f}, {:.3f}, {:.3f}) m: the density would be "
                  "negative at ({:.2f}, "
                  "{:.2f}, {:.2f}) m, whatever mass is stated; on this way it may lie as far as "
                  "({:.3f}, {:.3f}, "
                  "{:.3f}) m. Mend the stated centre, or give what draws it there a place of its "
                  "own: plates or "
                  "beams that are as heavy, of a mesh also masses",
                  steel.x(), steel.y(), steel.z(), stated.x(), stated.y(), stated.z(), worst.x(),
                  worst.y(), worst.z(), possible.x(), possible.y(), possible.z()));
}

}  // namespace

MassDistribution::MassDistribution(const Matter& matter) : nodes_(matter.space().nodes()) {
  matter.visit([&](const MatterPoint& point) { bits_.push_back({point.mass, point.place}); });
  bits_.shrink_to_fit();
}

MassProperties MassDistribution::with(const double* stated_mass,
                                      const Vector3* stated_centre) const {
  MassMoments steel;
  for (const Bit& bit : bits_) steel.add(bit.mass, bit.place);
  if (!(steel.mass > 0)) throw ModelError("the block has no mass; give its materials a density");
  MassProperties result;
  result.steel_mass = steel.mass;
  result.steel_centre_B = steel.first / steel.mass;
  const double mass = stated_mass ? *stated_mass : steel.mass;
  const Vector3 centre = stated_centre ? *stated_centre : result.steel_centre_B;
  if (!(std::isfinite(mass) && mass > 0))
    throw ModelError(
        fmt::format("the block's mass is stated as {:g} kg; it must be positive", mass));
  result.factor_alpha = mass / steel.mass;
  const Vector3 moved = mass * (centre - result.steel_centre_B);
  if (!moved.isZero(0))
    result.factor_beta = algebra::solve_symmetric<3>(steel.about(result.steel_centre_B), moved);
  result.smallest_density_factor = std::numeric_limits<double>::infinity();
  result.largest_density_factor = -std::numeric_limits<double>::infinity();
  Vector3 worst = Vector3::Zero();
  for (const Vector3 node : nodes_.colwise()) {
    const double factor = result.density_factor(node);
    if (factor < result.smallest_density_factor) worst = node;
    result.smallest_density_factor = std::min(result.smallest_density_factor, factor);
    result.largest_density_factor = std::max(result.largest_density_factor, factor);
  }
  if (result.smallest_density_factor < 0) refuse_centre(result, centre, worst);
  MassMoments all;
  for (const Bit& bit : bits_) all.add(bit.mass * result.density_factor(bit.place), bit.place);
  result.mass = all.mass;
  result.centre_of_mass_B = all.first / all.mass;
  result.outfitting_mass = result.mass - result.steel_mass;
  const Eigen::Matrix3d second = all.about(result.centre_of_mass_B);
  result.inertia_BBcm_B = second.trace() * Eigen::Matrix3d::Identity() - second;
  return result;
}

MassProperties find_mass_properties(const Space& space, const double* stated_mass,
                                    const Vector3* stated_centre) {
  return find_mass_properties(Matter(space), stated_mass, stated_centre);
}

MassProperties find_mass_properties(const Matter& matter, const double* stated_mass,
                                    const Vector3* stated_centre) {
  return MassDistribution(matter).with(stated_mass, stated_centre);
}

}  // namespace blocklift::structure

#pragma once

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {

/// Bodies that the panel method computes together, apart from others far away.
struct BodyGroup {
  std::vector<int> bodies;                           ///< ascending, of all bodies
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< of a circle that holds them, m, in W
  double radius = 0.0;                               ///< of that circle, m
};

/// Couples groups of bodies by the waves that go from one to the other.
///
/// What a group sends out is a sum of cylindrical waves about its centre; at another they are a sum
/// of standing ones (Graf's addition theorem), which it answers with forces and by scattering them
/// on, any number of times:
///
///   outgoing  eta = sum over m of c_m H_m(k R) exp(i m phi),    c = R xi + S d,
///   incident  eta = sum over n of d_n J_n(k R) exp(i n phi),    d = T c of the others,
///   T_nm = H_(m-n)(k r) exp(i (m - n) alpha),                   F = E d,
///
/// H being Hankel functions of the second kind, r and alpha distance and direction from the sender
/// to the receiver. R, S and E follow from a group's far field and excitation in waves from all
/// directions. Exact but for the local flow about a body, which does not travel: it falls off as
/// exp(-pi r/2h) in water of the depth h, and over deep water as 1/(k r)^2 of the wave. Between the
/// frequencies, and up to a quarter above the highest, R, S and E are interpolated (the phases of T
/// are exact), so that the retardation functions have the waves' delays. Without memory the groups
/// do not feel each other: A_inf has no share of it.
///
/// @param groups all bodies, each in one of them; their circles apart.
/// @param databases of each group, with its far field, in coordinates about its centre; their
///   headings must be their far field's directions. The same water and frequencies.
/// @param headings of the result, rad.
/// @returns the database of all bodies in their order, in W, without a far field.
/// @throws ModelError if a database lacks the far field or has other headings.
/// Source: Kagemoto and Yue (1986), J. Fluid Mech. 166, progressive waves alone.
HydrodynamicDatabase couple_by_waves(const std::vector<BodyGroup>& groups,
                                     std::vector<HydrodynamicDatabase> databases,
                                     const std::vector<double>& headings);

}  // namespace blocklift::dynamics

#pragma once

#include <Eigen/SparseCore>

#include "dynamics/marine/panels/panel_clusters.h"
#include "dynamics/marine/panels/surface_mesh.h"

namespace blocklift::dynamics {

/// What rings that widen outwards take out of waves that they cannot carry.
///
/// A wave of the number k runs out to where the rings are half its length wide, k d = pi, d being
/// the distance from ring to ring, and is thrown back there. A run that lasts long enough hears it
/// again. So the surface loses elevation that differs from ring to ring as no wave does that the
/// rings carry:
///
///   d eta/dt = ... - R^T R eta,    R eta = (0.1 W)^1/2 (g/d)^1/4 delta^2 (W^-1/2 eta),
///
/// eta with the factor W^1/2 of RankinePart, delta^2 the second difference from ring to ring, which
/// is nothing where the elevation changes evenly. A wave fades as
///
///   exp(-0.05 sqrt(g/d) (2 sin(k d/2))^4 t):
///
/// within a period it loses 0.24 % with 25 rings in it, 2.6 % with 13, six sevenths with three. On
/// rings that widen by a tenth each, waves of all lengths lose the same on their way: they are left
/// with exp(-26) when they are back from water that is deep for them.
///
/// The loss is of the elevation, not a pressure against its velocity: at low frequencies the
/// elevation goes to nothing beside the flow about a moving body, and so does the power that is
/// lost near it. A pressure against M phi there made the damping of a hemisphere in long waves
/// wrong by 2 to 4 %. R^T R is symmetric and takes energy out alone: what the bodies exert on each
/// other stays reciprocal.
///
/// It acts from the water lines on: beside a long hull the rings are wide within the circle that
/// holds it already. Gaps and moonpools keep their waves, since their water swings evenly across
/// the rings, or in waves that many rings carry: in a gap of 16 m between barges of 100 x 20 m
/// damping at the first resonance across it (1.4 rad/s) falls by 1.3 %, at the piston mode (0.8
/// rad/s) by 0.1 %.
///
/// Smoothing against what a grid of points cannot carry: Longuet-Higgins and Cokelet (1976).
using RingDifferences = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// R of the surface's panels (columns), with a row for each three that follow each other outwards,
/// (1/s)^1/2.
/// @param clusters panels that are taken together (columns are clusters then); null: none. Rings
/// with such panels lose nothing.
RingDifferences make_ring_differences(const SurfaceMesh& surface, double gravity,
                                      const PanelClusters* clusters = nullptr);

}  // namespace blocklift::dynamics

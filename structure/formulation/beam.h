#pragma once

#include <vector>

#include <Eigen/Core>

#include "structure/mesh/beams/beam_axes.h"
#include "structure/space/space.h"

namespace blocklift::structure {

/// A point of a beam with what it feels of its cell's freedoms.
struct BeamPoint {
  Vector3 place = Vector3::Zero();  ///< of the centroid, m
  double weight = 0;                ///< length that it stands for, m
  /// 6 x 6 nodes: stretch, shear along axes 2 and 3, twist, curvatures about axes 2 and 3.
  Eigen::Matrix<double, 6, Eigen::Dynamic> strain;
};

/// Strains of a beam's cell at a point of its unit length, for the freedoms of its nodes.
///
/// Timoshenko: with the centroid's displacement u_c = u + theta x r, r its offset from the nodes'
/// line,
///   (stretch, shears) = d u_c / ds + t x theta,  (twist, curvatures) = d theta / ds
/// in the beam's axes, t being its unit tangent. Along a curved edge (BeamLines) axis 1 is the
/// tangent at the point, and axis 2 what of the beam's own lies across it.
BeamPoint beam_point(const Space& space, int cell, double xi);

/// Section forces about the centroid (N, Q_2, Q_3, M_1, M_2, M_3) for the strains of BeamPoint:
/// diag(EA, G A_2, G A_3, G J, E I_2, E I_3) with E I_23 between the last two, where shear acts
/// through the centroid. An infinite shear area is taken as 1e4 times the section's.
///
/// A section twists about its shear centre c = BeamSection::twist_centre(), so that the strains of
/// shear are those of the line through the shear centres, d (u_c + theta x c) / ds + t x theta:
///   g_2 = shear_2 - c_3 twist,  g_3 = shear_3 + c_2 twist,
///   Q_2 = G A_2 g_2,  Q_3 = G A_3 g_3,  M_1 = G J twist - c_3 Q_2 + c_2 Q_3.
/// The torque about the shear centre is therefore M_1 + c_3 Q_2 - c_2 Q_3 = G J twist. It holds for
/// centres that move along a tapered beam, too.
/// Source: principle of virtual work; Timoshenko and Goodier (1970), section 125.
Eigen::Matrix<double, 6, 6> beam_stiffness_law(const Material& material,
                                               const BeamSection& section);

/// A Gauss point of a beam's cell with its section's law.
struct BeamGaussPoint {
  double xi = 0;                                    ///< on the cell's unit length
  double weight = 0;                                ///< length that it stands for, m
  Eigen::Matrix<double, 6, Eigen::Dynamic> strain;  ///< as BeamPoint's
  /// beam_stiffness_law there; a rod bears its normal force and torsion alone.
  Eigen::Matrix<double, 6, 6> law;
};

/// As many as the degree, which keeps thin beams from locking.
std::vector<BeamGaussPoint> beam_gauss_points(const Space& space, int cell);

/// Stiffness of a beam's cell, freedoms in the order of Space::element_freedoms, by its Gauss
/// points. Released ends are eliminated where they lie in the cell: bending is released about the
/// centroid, twist about the shear centre.
/// @throws ModelError if the releases leave the beam loose.
Eigen::MatrixXd beam_stiffness(const Space& space, int cell);

/// The motion of a cell's own ends for that of its nodes: they differ where the beam's ends are
/// released. Its strains are those of this motion. @throws ModelError as beam_stiffness does.
Eigen::MatrixXd beam_motion(const Space& space, int cell);

/// What released ends in a cell do of themselves under forces on the freedoms of its own ends (a
/// column each): D (D' K D)^-1 D' f, D being the motions that are released; none moves elsewhere.
/// @throws ModelError as beam_stiffness does.
Eigen::MatrixXd beam_release_motion(const Space& space, int cell, const Eigen::MatrixXd& forces);

}  // namespace blocklift::structure

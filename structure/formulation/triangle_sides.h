#pragma once

#include <Eigen/Core>

namespace blocklift::structure {

// A cell of degree 2 whose edge eta = 1 is a point is a triangle with the coordinates
// r = xi (1 - eta) and s = eta. Its area coordinates are 1 - r - s, r and s.

/// Shape functions at a point and their derivatives by two coordinates of the surface.
struct Shapes {
  Eigen::RowVectorXd value, d_1, d_2;
};

/// The six functions of second order on a triangle among those of the nine nodes of its cell (xi
/// fastest), and their derivatives by r and s.
Shapes functions_of_triangle(double r, double s);

/// What the functions of the cell have beyond those, and its derivatives by xi and eta: that of
/// the node within, and nothing along the sides.
Shapes beyond_triangle(const Shapes& cell, double xi, double eta);

/// Where (xi, eta) a triangle's strains are tied: three places for each of e_rr, e_ss and e_qq
/// along q = (s - r) / sqrt(2), and the centroid. Two of each three lie at the Gauss points of
/// their side, which both triangles there share, and one within.
/// Source: Lee and Bathe (2004), Comput. Struct. 82, 945-962, MITC6a.
const Eigen::Matrix2Xd& places_on_triangle();

/// Shares in e_11, e_22 and 2 e_12 by xi and eta of the nine stretches at the first nine places;
/// each is linear in r and s.
Eigen::Matrix<double, 3, 9> shares_of_stretches(double xi, double eta);

/// Shares in g_13 and g_23 by xi and eta of eight shears: g_r at places 0 and 1, g_s at 3 and 4,
/// g_s - g_r at 6 and 7, and both at the centroid. Along each side they are linear.
Eigen::Matrix<double, 2, 8> shares_of_shears(double xi, double eta);

}  // namespace blocklift::structure

#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/space/space.h"

namespace blocklift::structure {

/// Rows of a shell's generalised strains.
enum ShellStrain {
  membrane_11,   ///< e_11
  membrane_22,   ///< e_22
  membrane_12,   ///< 2 e_12
  curvature_11,  ///< k_11, 1/m
  curvature_22,
  curvature_12,  ///< 2 k_12
  shear_1,       ///< g_13
  shear_2,       ///< g_23
  drilling,
  shell_strains
};

/// A point of a shell with what it feels of its cell's freedoms.
struct ShellPoint {
  Vector3 place = Vector3::Zero();                       ///< m
  Vector3 e_1 = Vector3::Zero(), e_2 = Vector3::Zero();  ///< unit tangents at right angles
  Vector3 normal = Vector3::Zero();                      ///< e_1 x e_2
  double area = 0;       ///< |dx/dxi x dx/deta|, m^2 per unit of the square
  double thickness = 0;  ///< m
  /// shell_strains x 6 nodes: strains of the mid-surface in e_1, e_2 for unit freedoms.
  Eigen::Matrix<double, shell_strains, Eigen::Dynamic, Eigen::RowMajor> strain;
};

/// Reissner and Mindlin's shell on curved quadrangles, six freedoms a node.
///
/// With displacement u, rotation theta and director n, tangents g_a = dx/dxi_a:
///   membrane  e_ab = sym(g_a . d_b u)
///   curvature k_ab = sym(g_a . d_b (theta x n) + d_a n . d_b u)
///   shear     g_a3 = n . d_a u + g_a . (theta x n)
///   drilling  d    = theta . n - (g_2 . d_1 u - g_1 . d_2 u) / (2 |g_1 x g_2|)
/// which no rigid motion strains, whatever the curvature. The strain at the height z above the
/// mid-surface is e + z k; a section's offset moves the mid-surface away from the nodes.
///
/// So that thin shells do not lock, shear strains of degree 1 are those of the middles of the edges
/// (Bathe and Dvorkin 1985), and its membrane shear is the mean of the cell; of a degree p above it
/// e_11 and g_13 are taken at p x (p + 1) Gauss points, e_22 and g_23 at (p + 1) x p, e_12 at p x p
/// (Bucalem and Bathe 1993 for p = 2). What that takes from the mean membrane strain of a cell
/// which is no parallelogram is given back evenly, so that constant stress does the same work on
/// tied strains as on those of the displacements: without it distorted cells fail the patch test
/// (for the mean of assumed strains see Simo and Hughes 1986). A triangle is a cell with an edge
/// that is a point, towards which xi loses its meaning: ties along xi and eta lock. Of degree 2 its
/// shear strains and, if it is curved, its membrane strains are tied along its three sides (MITC6a
/// of Lee and Bathe 2004, Comput. Struct. 82): those of its six nodes. What the ninth node of the
/// cell, within it, moves besides strains as the displacements have it; it has no part in rigid
/// motion. Other triangles have the membrane strains of the displacements. Source of the
/// drilling term: Hughes and Brezzi (1989), Comput. Methods Appl. Mech. Eng. 72, 105-121, with a
/// hundredth of their stiffness G t: where plates meet, the slope of one is the drilling of
/// another. Facets that stand for curved
/// plating (find_facets) have all of it, of degree 1 a tenth. Where they meet, a twisting moment
/// leaves its part across the kink to their drilling; what gives way there adds to the twist a
/// share that goes with (thickness / radius)^2 over that of G t, however fine the facets are: with
/// a hundredth a slit pipe, thickness over radius 0.1, is a quarter too soft.
///
/// One object serves one thread.
class ShellOperator {
 public:
  /// Where the strains of degree 2 and above come from.
  enum class Source {
    ties,          ///< as the stiffness has them
    displacements  ///< from the displacements at the point itself
  };

  /// @param points of the unit square, 2 x m, at which strains are wanted; the space must outlive
  /// this.
  ShellOperator(const Space& space, const Eigen::Matrix2Xd& points, Source source = Source::ties);
  ~ShellOperator();

  /// Goes to a cell of Space::shells().
  void reinit(int cell);
  const std::vector<ShellPoint>& points() const { return points_; }

 private:
  struct Tabulation;
  struct TiedStrains;
  struct TriangleTies;
  struct Mean;
  bool is_tied(int strain) const {
    return is_tied_[strain] && (ties_membrane_ || strain > membrane_12);
  }
  /// Has the cell any of the strains that are tied there?
  bool is_used(const TiedStrains& tie) const;
  void tie_strains(double offset);
  void tie_sides_of_triangle(double offset);
  void find_mean_strains(double offset);

  const Space& space_;
  bool has_ties_;
  Eigen::Matrix2Xd places_;  ///< of the points
  std::vector<ShellPoint> points_;
  std::unique_ptr<Tabulation> table_;
  std::vector<TiedStrains> ties_;
  std::array<bool, shell_strains> is_tied_{};
  bool ties_membrane_ = true;  ///< of the cell
  std::unique_ptr<Mean> mean_;
};

/// Stress resultants of a section for generalised strains: membrane forces (N/m), moments (N m/m),
/// shear forces (N/m), drilling; the plane-stress Hooke's law, shear factor 5/6.
Eigen::Matrix<double, shell_strains, shell_strains> shell_stiffness_law(const Material& material,
                                                                        double thickness);

/// The same of a shell as it is, layered or not, for strains along unit tangents e_1 and e_2 and
/// the shell's own normal: A, B, D and S of a laminate turned into them, with the drilling
/// stiffness of its nearest plate.
/// @param thickness there, m (thickness_at); layers have their section's.
Eigen::Matrix<double, shell_strains, shell_strains> shell_stiffness_law(
    const Mesh& mesh, const Shell& shell, const Vector3& e_1, const Vector3& e_2, double thickness);

/// Stiffness of shells, N/m, N, N m: freedoms in the order of Space::element_freedoms. One object
/// serves one thread.
class ShellStiffness {
 public:
  explicit ShellStiffness(const Space& space);
  const Eigen::MatrixXd& operator()(int cell);

 private:
  const Space& space_;
  Eigen::VectorXd weights_;
  ShellOperator operator_;
  Eigen::MatrixXd rooted_, stiffness_;
};

/// Gauss points and weights of the unit square, `count` along each side: 3 x count^2 (xi, eta,
/// weight).
Eigen::Matrix3Xd square_rule(int count);

}  // namespace blocklift::structure

#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/material.h"

namespace blocklift::structure {

using Vector3 = Eigen::Vector3d;

/// Stiffness of a layered plate about its mid-surface, in axes 1 and 2 of its own:
///   (n, m) = [A B; B D] (epsilon, kappa),  q = S gamma,
/// strains in the order 11, 22, 12 (engineering shear). Jones (1999), equations 4.22 and 4.23.
struct Laminate {
  Eigen::Matrix3d membrane = Eigen::Matrix3d::Zero();  ///< A, N/m
  Eigen::Matrix3d coupling = Eigen::Matrix3d::Zero();  ///< B, N
  Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();   ///< D, N m
  Eigen::Matrix2d shear = Eigen::Matrix2d::Zero();     ///< S, N/m
};

/// Plate thickness of shells, m, about the surface on which their vertices lie.
struct ShellSection {
  double thickness = 0;
  int material = 0;          ///< place in Mesh::materials
  double offset = 0;         ///< of the mid-surface from the vertices' surface, along the normal, m
  double mass_per_area = 0;  ///< beyond the plate's own: paint, outfit, kg/m^2
  /// Place in Mesh::laminates where thickness and material are but the isotropic plate that comes
  /// nearest; -1: they are all there is.
  int laminate = -1;
  long label = 0;  ///< the property's number in its file
};

/// Quadrangle or triangle of plating. Its normal is d/dxi x d/deta.
struct Shell {
  /// Vertices at the unit square's corners (0, 0), (1, 0), (0, 1), (1, 1). The last two of a
  /// triangle are one.
  std::array<int, 4> vertices{};
  int section = 0;     ///< place in Mesh::shell_sections
  int region = 0;      ///< place in Mesh::regions
  int curvature = -1;  ///< place in Mesh::curved_shells; -1: bilinear between the vertices
  long label = 0;      ///< the element's number in its file, for messages
  /// Whose part in the plate is axis 1 of its laminate; without length where there is none.
  Vector3 laminate_axis = Vector3::Zero();
  /// Place in Mesh::shell_tapers; -1: as thick as its section everywhere.
  int taper = -1;

  bool is_triangle() const { return vertices[2] == vertices[3]; }
};

/// Point of a beam's section with the shear stress there along the section's edge or wall,
///   tau = of_torsion T + of_force . (Q_2, Q_3),
/// T being the torsion moment about the shear centre.
struct SectionPoint {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();     ///< (x_2, x_3) from the centroid, m
  double of_torsion = 0;                               ///< 1/m^3
  Eigen::Vector2d of_force = Eigen::Vector2d::Zero();  ///< 1/m^2
};

/// Cross-section of a beam about its own centroid; its axes 2 and 3 lie across the beam.
struct BeamSection {
  std::string name;
  int material = 0;  ///< place in Mesh::materials
  /// Shear acts through the centroid wherever the shear centre lies, as in Nastran's CBAR.
  bool twists_about_centroid = false;
  double area = 0;             ///< m^2
  double second_moment_2 = 0;  ///< I_2 = int x_3^2 dA, bending about axis 2, m^4
  double second_moment_3 = 0;  ///< I_3 = int x_2^2 dA, m^4
  double product_23 = 0;       ///< int x_2 x_3 dA, m^4
  double torsion = 0;          ///< J, m^4
  double shear_area_2 = 0;     ///< for shear along axis 2, m^2; infinite: no shear deformation
  double shear_area_3 = 0;     ///< m^2
  /// Points (x_2, x_3) where the largest stresses along the beam are, m.
  std::vector<Eigen::Vector2d> stress_points;
  /// Points at which all of the stress is looked at, where the section's shape tells its shear;
  /// empty: the shape is not known (checked_points has an estimate).
  std::vector<SectionPoint> shear_points = {};
  Eigen::Vector2d shear_centre = Eigen::Vector2d::Zero();  ///< (x_2, x_3), m
  double mass_per_length = 0;                              ///< beyond the beam's own, kg/m
  long label = 0;                                          ///< the property's number in its file

  /// (x_2, x_3) of what a force across the beam goes through without twisting it, m.
  Eigen::Vector2d twist_centre() const {
    return twists_about_centroid ? Eigen::Vector2d::Zero() : shear_centre;
  }
};

/// Which of the six freedoms (displacements, rotations along the beam's own axes 1, 2, 3) one end
/// of a beam does not pass on.
using BeamRelease = std::array<bool, 6>;

/// Beam between two vertices.
struct Beam {
  std::array<int, 2> vertices{};
  int section = 0;  ///< place in Mesh::beam_sections
  int region = 0;   ///< place in Mesh::regions
  /// Of a tapered beam the section at its second vertex, of the same material and with as many
  /// stress points; -1: that at the first one. Between them its figures are linear in place.
  int end_section = -1;
  /// Direction in the plane of axes 1 and 2: axis 2 is its part across the beam.
  Vector3 axis_2 = Vector3::UnitZ();
  /// Of the centroid from the line between the vertices, at either end, m.
  std::array<Vector3, 2> offset{Vector3::Zero(), Vector3::Zero()};
  std::array<BeamRelease, 2> release{};
  bool is_rod = false;  ///< bears along its axis and in torsion only
  long label = 0;
};

/// Stiffness of a solid whose material depends on the direction, along the block's axes, Pa:
///   sigma = C epsilon, both in the order xx, yy, zz, xy, yz, zx, strains of shear 2 epsilon_xy.
using Elasticity = Eigen::Matrix<double, 6, 6>;

/// Form of a solid: 4, 6, 8 or 5 corners.
enum class SolidShape { tetrahedron, wedge, hexahedron, pyramid };

/// Quadratic solid element. Its vertices move without turning: a plate or beam that ends on them is
/// hinged there.
struct Solid {
  SolidShape shape = SolidShape::hexahedron;
  /// Corners, then the middles of the edges: the order of topology_of(shape).
  std::vector<int> vertices = {};
  int material = 0;  ///< place in Mesh::materials
  int region = 0;    ///< place in Mesh::regions
  long label = 0;
  /// Place in Mesh::elasticities where the material, but for its density and yield stress, is the
  /// isotropic one that comes nearest; -1: it is all there is.
  int elasticity = -1;
};

/// Mass at a vertex.
struct PointMass {
  int vertex = 0;
  double mass = 0;                                    ///< kg
  Vector3 offset = Vector3::Zero();                   ///< of its centre from the vertex, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about its own centre, kg m^2
  long label = 0;
};

/// Vertices that move as one rigid body with another: u_i = u + theta x (x_i - x), theta_i = theta,
/// for the components that are bound.
struct RigidLink {
  int master = 0;
  std::vector<int> slaves;
  std::array<bool, 6> bound{true, true, true, true, true, true};
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: along which `bound` counts
  long label = 0;
};

/// A vertex that follows others without stiffening them: its motion is the rigid motion that fits
/// theirs best by least squares, so that forces on it are spread as a bolt pattern does.
struct DistributingLink {
  int reference = 0;
  std::vector<int> vertices;
  std::vector<double> weights;
  std::array<bool, 6> bound{true, true, true, true, true, true};  ///< components of the reference
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: along which `bound` counts
  long label = 0;
};

/// Linear equation between motions of vertices: the sum of a_i . u_i + b_i . theta_i is zero. Its
/// forces are in balance (sum a_i = 0, sum x_i x a_i + b_i = 0), so that it resists no motion of
/// the whole.
struct MotionEquation {
  struct Term {
    int vertex = 0;
    Vector3 of_displacement = Vector3::Zero();  ///< a
    Vector3 of_rotation = Vector3::Zero();      ///< b, m
  };
  std::vector<Term> terms;  ///< one a vertex; the motion of the first follows the others
  long label = 0;
};

/// Straight stretch on a shell over which a motion is averaged.
struct SurfaceStretch {
  int shell = 0;
  std::array<Eigen::Vector2d, 2> ends{Eigen::Vector2d::Zero(),
                                      Eigen::Vector2d::Zero()};  ///< on the unit square
  /// Density of the weight d_0 + d_1 t + d_2 t^2, t from 0 to 1 along the stretch.
  Vector3 density = Vector3::Zero();
};

/// Vertex that lies on a shell without being a corner of it (the middle of a quadratic element's
/// edge, where something else is fastened) and moves with it.
struct SurfacePoint {
  int vertex = 0;
  int shell = 0;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();  ///< on the unit square
  /// Where the vertex moves as the weighted mean along a line does (shell_solid_joint.h); the
  /// weights sum to one. Empty: as the place.
  std::vector<SurfaceStretch> line = {};
};

/// Spring between two freedoms, or one and the ground: its force is k (u_1 - u_2), each u the
/// motion of a point fixed to its vertex.
struct Spring {
  std::array<int, 2> vertices{-1, -1};  ///< -1: the ground
  std::array<int, 2> components{0, 0};  ///< 0 .. 2 displacement, 3 .. 5 rotation along `axes`
  std::array<Eigen::Matrix3d, 2> axes{Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
  std::array<Vector3, 2> arms{Vector3::Zero(), Vector3::Zero()};  ///< from vertex to point, m
  double stiffness = 0;                                           ///< N/m or N m/rad
  long label = 0;
};

/// What cells belong to: one plate of a block, a part of a deck.
struct Region {
  std::string name;  ///< such as "web_frames at x = 4 m"
  int group = 0;     ///< place in Mesh::groups
  /// Rank of the plate: which one a square belongs to is decided by it (lugs are apart).
  bool is_lug = false;
};

/// Regions under one name: plates of a name, a pad, a lug.
struct Group {
  std::string name;
  int material = 0;  ///< place in Mesh::materials
  /// Of stiffeners: from one of the brackets that keep them from turning about their toes to the
  /// next, m; 0: they have none between supports of their plate.
  double tripping_brackets = 0;
};

/// Lifting point: where the rope pulls, and which cells carry its force.
struct LiftingPoint {
  std::string name;
  Vector3 p_BPin = Vector3::Zero();  ///< m
  int region = 0;                    ///< the lug's plate, over which the force is spread
  int pad_region = -1;               ///< the thickened plate that it stands on; -1: none
  double radius = 0;                 ///< of the sphere about the pin that holds lug and pad, m
  /// Shells of a mesh without lugs of its own over which the force is spread; empty: the region's.
  std::vector<int> shells = {};
  /// Vertex that takes the force as it is (a link's, a beam's); -1: plates take it.
  int vertex = -1;
};

/// Conforming mesh of a structure: shells, beams, solids, masses, links and springs on common
/// vertices.
///
/// Cells are joined where they share vertices: shells along edges, beams along shells' edges, and
/// what else meets in a vertex. Any number of shells may meet along an edge.
struct Mesh {
  std::vector<Vector3> vertices;    ///< m
  std::vector<long> vertex_labels;  ///< their numbers in the file; empty: none
  std::vector<Material> materials;
  std::vector<ShellSection> shell_sections;
  std::vector<Laminate> laminates;
  std::vector<Shell> shells;
  /// Thickness of shells at their corners, in the order of their vertices, m; bilinear between
  /// them. Their section has the mean.
  std::vector<std::array<double, 4>> shell_tapers;
  /// Points of curved shells: (order + 1)^2 columns on the unit square, equally spaced, xi fastest,
  /// m.
  std::vector<Eigen::Matrix3Xd> curved_shells;
  std::vector<BeamSection> beam_sections;
  std::vector<Beam> beams;
  std::vector<Solid> solids;
  std::vector<Elasticity> elasticities;
  std::vector<PointMass> masses;
  std::vector<RigidLink> rigid_links;
  std::vector<DistributingLink> distributing_links;
  std::vector<MotionEquation> equations;
  std::vector<SurfacePoint> surface_points;
  std::vector<Spring> springs;
  std::vector<Region> regions;
  std::vector<Group> groups;
  std::vector<LiftingPoint> lifting_points;

  const ShellSection& section_of(const Shell& shell) const { return shell_sections[shell.section]; }
  const Material& material_of(const Shell& shell) const {
    return materials[section_of(shell).material];
  }
  const BeamSection& section_of(const Beam& beam) const { return beam_sections[beam.section]; }
  const Group& group_of_region(int region) const { return groups[regions[region].group]; }
};

/// Vertices of a link, those that others follow or that follows others first.
std::vector<int> vertices_of(const RigidLink& link);
std::vector<int> vertices_of(const DistributingLink& link);
std::vector<int> vertices_of(const MotionEquation& equation);

/// Calls visit(vertices, label) for each rigid link, distributing link and equation.
template <typename Visit>
void for_each_link(const Mesh& mesh, const Visit& visit) {
  for (const RigidLink& link : mesh.rigid_links) visit(vertices_of(link), link.label);
  for (const DistributingLink& link : mesh.distributing_links) visit(vertices_of(link), link.label);
  for (const MotionEquation& equation : mesh.equations)
    visit(vertices_of(equation), equation.label);
}

/// Puts an equation's forces in balance by the least change of the coefficients of all terms but
/// the first.
/// @return the largest change, as a share of the largest coefficient (rotations' over the
///   equation's size); infinite where no change balances it.
double balance(const Mesh& mesh, MotionEquation& equation);

/// The section of a beam at a share of its length.
BeamSection section_at(const Mesh& mesh, const Beam& beam, double share);

/// Place of a point (xi, eta) of the unit square on a shell, m.
Vector3 position(const Mesh& mesh, const Shell& shell, const Eigen::Vector2d& xi);

/// Thickness of a shell at a point of the unit square, m.
double thickness_at(const Mesh& mesh, const Shell& shell, const Eigen::Vector2d& xi);

/// Longest edge of a shell between its vertices, m.
double longest_edge(const Mesh& mesh, const Shell& shell);

/// Numbers of the connected parts (through vertices and links) of the vertices, from 0; -1 for
/// vertices that nothing uses.
std::vector<int> connected_parts(const Mesh& mesh);

/// @throws ModelError naming cells with vertices, sections or regions that are not there, shells
///   without area, thickness that is not positive, beams without length, links and masses of
///   vertices that are not there.
void check_mesh(const Mesh& mesh);

}  // namespace blocklift::structure

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "structure/mesh/mesh.h"
#include "structure/space/elimination.h"

namespace dealii {
template <typename Number>
class AffineConstraints;
}

namespace blocklift::structure {

/// Degree of the elements and size of the cells that a mesh is computed with.
struct Resolution {
  int degree = 3;  ///< of displacements and rotations, 1 to 4
  /// Largest edge of a shell at a place, m: cells that are longer are divided into four, again and
  /// again. Empty: the mesh is taken as it is.
  std::function<double(const Vector3&)> largest_edge;
};

/// A shell of the mesh or what division made of it: xi of the shell = origin + size * (own unit
/// square).
struct ShellCell {
  int shell = 0;  ///< place in Mesh::shells
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double size = 1;
};

/// A beam of the mesh or a piece of it, from origin to origin + size of its length.
struct BeamCell {
  int beam = 0;  ///< place in Mesh::beams
  double origin = 0;
  double size = 1;
  int degree = 1;
  std::vector<int> nodes;  ///< degree + 1, from end to end
};

/// Finite elements on a mesh: nodes of Lagrange elements, what ties them, and the unknowns that
/// remain.
///
/// Each node has six freedoms along the world's axes, displacement (m) and rotation (rad): freedom
/// 6 n + c. Every shell and beam of the mesh is a part of deal.II's triangulation for itself, so
/// that any number of them may meet along an edge; what lies on one another is tied:
/// - nodes of one place along an edge are one;
/// - where cells of different sizes or degrees meet, the finer side follows the polynomial of the
///   coarser
///   one, so that displacements are continuous;
/// - vertices that lie on a shell between its corners follow its shape;
/// - slaves of rigid links and references of distributing links follow their masters.
/// The unknowns are what is left; they are numbered by nested dissection for the Cholesky
/// factorisation.
///
/// Immutable. The mesh must outlive it.
class Space {
 public:
  /// @throws ModelError if the degree is not 1 to 4, the cells would be more than memory holds, or
  /// a
  ///   vertex follows two links.
  Space(const Mesh& mesh, const Resolution& resolution);
  ~Space();

  const Mesh& mesh() const { return *mesh_; }
  int degree() const { return degree_; }

  int node_count() const { return static_cast<int>(nodes_.cols()); }
  int freedoms() const { return 6 * node_count(); }
  int unknowns() const { return unknowns_; }
  /// Places of the nodes, m.
  const Eigen::Matrix3Xd& nodes() const { return nodes_; }
  /// Node of a vertex of the mesh; -1 if nothing uses the vertex.
  int node_of_vertex(int vertex) const { return node_of_vertex_[vertex]; }

  const std::vector<ShellCell>& shells() const { return shells_; }
  int nodes_per_shell() const { return (degree_ + 1) * (degree_ + 1); }
  /// The nodes of a shell cell, xi fastest.
  const int* shell_nodes(int cell) const {
    return shell_nodes_.data() + static_cast<std::ptrdiff_t>(cell) * nodes_per_shell();
  }
  const std::vector<BeamCell>& beams() const { return beams_; }
  /// The nodes of a solid of the mesh, which is an element as it is whatever the resolution; as
  /// many as the solid has vertices.
  const int* solid_nodes(int solid) const { return solid_nodes_.data() + solid_start_[solid]; }

  /// Place of a point of a shell cell's unit square, m.
  Vector3 place(int cell, const Eigen::Vector2d& xi) const;
  /// Shape functions of a shell at a point of its unit square, xi fastest.
  Eigen::VectorXd shell_values(const Eigen::Vector2d& xi) const;

  /// A freedom as a sum of unknowns; none where it is held by nothing and bears nothing.
  struct Term {
    int unknown = 0;
    double weight = 0;
  };
  const Term* begin_of(int freedom) const { return terms_.data() + term_start_[freedom]; }
  const Term* end_of(int freedom) const {
    return terms_.data() + term_start_[static_cast<std::size_t>(freedom) + 1];
  }
  /// A part of a freedom that nothing resists: it is no unknown, and what acts there acts on
  /// nothing.
  struct LoosePart {
    int freedom = 0;
    int of = 0;  ///< the freedom without stiffness that it follows, perhaps itself
    double weight = 0;
  };
  /// All of them, by freedom.
  const std::vector<LoosePart>& loose_parts() const { return loose_parts_; }
  /// Is a shell of the mesh a facet of curved plating (find_facets)?
  bool is_facet(int shell) const { return is_facet_[shell]; }
  /// Motion of all freedoms (rows) for unknowns (rows); a column each.
  Eigen::MatrixXd expand(const Eigen::MatrixXd& unknowns) const;
  /// Forces on the unknowns for forces on the freedoms: the transpose of expand().
  Eigen::MatrixXd reduce(const Eigen::MatrixXd& forces) const;

  /// Groups of unknowns in order of elimination. Elements are shells(), then beams(), then
  /// Mesh::springs, then Mesh::solids.
  const Elimination& elimination() const { return elimination_; }
  int element_count() const {
    return static_cast<int>(shells_.size() + beams_.size() + mesh_->springs.size() +
                            mesh_->solids.size());
  }
  /// Freedoms of an element, in the order of its stiffness: six a node, three of a solid's.
  std::vector<int> element_freedoms(int element) const;

  /// deal.II's triangulations, elements and mappings, for the sources of this folder and of
  /// formulation.
  struct Implementation;
  const Implementation& implementation() const { return *implementation_; }

 private:
  void make_shells(const Resolution& resolution);
  void make_beams(const Resolution& resolution);
  void make_solids();
  void make_free_nodes();
  void add_surface_ties(dealii::AffineConstraints<double>& ties) const;
  void number_unknowns();

  const Mesh* mesh_;
  int degree_;
  int unknowns_ = 0;
  Eigen::Matrix3Xd nodes_;
  std::vector<int> node_of_vertex_;
  std::vector<ShellCell> shells_;
  std::vector<int> shell_nodes_;
  std::vector<BeamCell> beams_;
  std::vector<int> solid_nodes_, solid_start_;
  std::vector<long> term_start_;
  std::vector<Term> terms_;
  std::vector<LoosePart> loose_parts_;
  std::vector<bool> is_facet_;
  Elimination elimination_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace blocklift::structure

#include "structure/elasticity/rigid_freedom.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/files/abaqus_file.h"

namespace blocklift::structure {

namespace {

using Twist = Eigen::Matrix<double, 6, 1>;  // rotation times length, translation

std::string vector_text(const Vector3& v) {
  const auto clean = [](double x) { return std::abs(x) < 1e-6 ? 0.0 : x; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", clean(v.x()), clean(v.y()), clean(v.z()));
}

// Of the two unit vectors along an axis the one that points forwards.
Vector3 direction(const Vector3& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  return (v[largest] < 0 ? -v : v).normalized();
}

std::string motion_text(const Twist& twist, const Vector3& centre, double length) {
  const Vector3 omega = twist.head<3>() / length, velocity = twist.tail<3>();
  if (omega.norm() * length < 1e-6 * velocity.norm())
    return "translation along " + vector_text(direction(velocity));
  const Vector3 point = centre + omega.cross(velocity) / omega.squaredNorm();
  return "rotation about the axis along " + vector_text(direction(omega)) + " through " +
         vector_text(point) + " m";
}

// Twists (orthonormal columns) in as plain words as there are.
std::vector<std::string> in_words(const Eigen::Matrix<double, 6, Eigen::Dynamic>& twists,
                                  const Vector3& centre, double length) {
  std::vector<std::string> plain;
  for (const int i : {3, 4, 5, 0, 1, 2}) {
    if (twists.row(i).squaredNorm() < 1 - 1e-9) continue;
    plain.push_back(
        i >= 3 ? fmt::format("translation along {}", "xyz"[i - 3])
               : fmt::format("rotation about {} through {} m", "xyz"[i], vector_text(centre)));
  }
  if (static_cast<Eigen::Index>(plain.size()) == twists.cols()) return plain;
  std::vector<std::string> general;
  for (const auto& twist : twists.colwise()) general.push_back(motion_text(twist, centre, length));
  return general;
}

/// Solids that share faces.
struct Piece {
  int body = 0;
  std::vector<int> solids;  ///< elements
};

// Unites what the same key names.
class Unions {
 public:
  explicit Unions(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

std::vector<Piece> find_pieces(const PartMesh& mesh, const std::vector<int>& body_of_node) {
  Unions unions(mesh.solids.size());
  std::map<std::vector<int>, int> solid_of_face;
  for (int s = 0; s < static_cast<int>(mesh.solids.size()); ++s) {
    const int element = mesh.solids[s];
    for (const std::vector<int>& face : abaqus_faces(at(mesh.kind(element).corners))) {
      std::vector<int> nodes;
      for (const int corner : face) nodes.push_back(mesh.node(element, corner));
      std::sort(nodes.begin(), nodes.end());
      const auto [entry, is_new] = solid_of_face.try_emplace(nodes, s);
      if (!is_new) unions.unite(s, entry->second);
    }
  }
  std::map<int, std::size_t> place;
  std::vector<Piece> pieces;
  for (int s = 0; s < static_cast<int>(mesh.solids.size()); ++s) {
    const auto [entry, is_new] = place.try_emplace(unions.root(s), pieces.size());
    const int element = mesh.solids[s];
    if (is_new) pieces.push_back({body_of_node[mesh.node(element, 0)], {}});
    pieces[entry->second].solids.push_back(element);
  }
  return pieces;
}

/// connected_bodies, those that ties join being one.
std::vector<int> joined_bodies(const PartModel& model) {
  std::vector<int> body_of_node = connected_bodies(model.mesh);
  Unions unions(body_of_node.size());  // no more bodies than nodes
  for (const PartTie& tie : model.joints.ties)
    for (const int followed : tie.followed)
      unions.unite(body_of_node[tie.freedom / 3], body_of_node[followed / 3]);
  for (int& body : body_of_node)
    if (body >= 0) body = unions.root(body);
  return body_of_node;
}

/// One body: pieces that share nodes or are tied, with what holds them.
class Body {
 public:
  Body(const PartMesh& mesh, std::vector<const Piece*> pieces)
      : mesh_(mesh), pieces_(std::move(pieces)) {
    Vector3 lower = Vector3::Constant(1e300), upper = -lower;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (const int element : pieces_[p]->solids)
        for (int i = 0; i < mesh.kind(element).nodes; ++i) {
          const int node = mesh.node(element, i);
          pieces_of_node_[node].insert(static_cast<int>(p));
          lower = lower.cwiseMin(mesh.nodes.col(node));
          upper = upper.cwiseMax(mesh.nodes.col(node));
        }
    centre_ = (lower + upper) / 2;
    length_ = (upper - lower).norm() / 2;
    const auto size = static_cast<Eigen::Index>(6 * pieces_.size());
    held_.setZero(size, size);
    for (const auto& [node, pieces] : pieces_of_node_)
      for (const int piece : pieces)
        for (int axis = 0; axis < 3 && piece != *pieces.begin(); ++axis)
          add({{node, axis, *pieces.begin(), 1}, {node, axis, piece, -1}});
  }

  void hold(int node, int axis) { add({{node, axis, *pieces_of_node_.at(node).begin(), 1}}); }

  void tie(const PartTie& tie) {
    std::vector<Term> terms;
    const auto take = [&](int freedom, double factor) {
      const int node = freedom / 3;
      terms.push_back({node, freedom % 3, *pieces_of_node_.at(node).begin(), factor});
    };
    take(tie.freedom, -1);
    for (std::size_t i = 0; i < tie.followed.size(); ++i) take(tie.followed[i], tie.shares[i]);
    add(terms);
  }

  /// @param several there are other bodies.
  void find(bool several, RigidFreedom& freedom) const {
    const auto solved = algebra::symmetric_eigensystem(held_);
    const double largest = solved.values[held_.rows() - 1];
    const Eigen::Index free = (solved.values.array() <= 1e-10 * std::max(1.0, largest)).count();
    freedom.count += static_cast<int>(free);
    const bool hinged = pieces_.size() > 1 && free > 0;
    constexpr double relevant = 1e-6;
    for (std::size_t p = 0; p < pieces_.size() && free > 0; ++p) {
      const Eigen::MatrixXd own =
          solved.vectors.block(static_cast<Eigen::Index>(6 * p), 0, 6, free);
      const algebra::LeftSingularVectors moves = algebra::left_singular_vectors(own);
      const Eigen::Index rank = (moves.values.array() > relevant).count();
      for (const std::string& words : in_words(moves.vectors.leftCols(rank), centre_, length_)) {
        std::string text = words;
        if (hinged)
          text += fmt::format(
              " of the {} elements about {} m, which hang on others by an edge or a point only",
              pieces_[p]->solids.size(), vector_text(centre_of(*pieces_[p])));
        else if (several)
          text += fmt::format(" of the body about {} m, which shares no node with the rest",
                              vector_text(centre_));
        freedom.motions.push_back(text);
      }
    }
  }

 private:
  Vector3 centre_of(const Piece& piece) const {
    Vector3 sum = Vector3::Zero();
    for (const int element : piece.solids) sum += mesh_.centre(element);
    return sum / static_cast<double>(piece.solids.size());
  }

  /// The displacement of a node along an axis with a piece, times a factor.
  struct Term {
    int node = 0, axis = 0, piece = 0;
    double factor = 1;
  };

  // The sum of all terms is zero.
  void add(const std::vector<Term>& terms) {
    std::vector<Twist> rows;
    for (const Term& term : terms) {
      Twist& row = rows.emplace_back();
      const Vector3 along = term.factor * Vector3::Unit(term.axis);
      row.head<3>() = (mesh_.nodes.col(term.node) - centre_).cross(along) / length_;
      row.tail<3>() = along;
    }
    for (std::size_t i = 0; i < terms.size(); ++i)
      for (std::size_t j = 0; j < terms.size(); ++j)
        held_.block<6, 6>(6 * terms[i].piece, 6 * terms[j].piece) += rows[i] * rows[j].transpose();
  }

  const PartMesh& mesh_;
  std::vector<const Piece*> pieces_;
  std::map<int, std::set<int>> pieces_of_node_;
  Vector3 centre_;
  double length_ = 0;
  Eigen::MatrixXd held_;
};

}  // namespace

RigidFreedom find_rigid_freedom(const PartModel& model, const std::vector<FixedUnknown>& fixed) {
  const std::vector<int> body_of_node = joined_bodies(model);
  const std::vector<Piece> pieces = find_pieces(model.mesh, body_of_node);
  std::map<int, std::vector<const Piece*>> of_body;
  for (const Piece& piece : pieces) of_body[piece.body].push_back(&piece);
  std::map<int, Body> bodies;
  constexpr std::size_t most_pieces = 200;
  for (auto& [body, members] : of_body) {
    if (members.size() > most_pieces)
      throw ModelError(fmt::format(
          "the mesh falls into {} pieces that touch at edges or points only; elements that are "
          "joined share whole faces",
          members.size()));
    bodies.try_emplace(body, model.mesh, std::move(members));
  }
  for (const FixedUnknown& unknown : fixed) {
    const int node = unknown.unknown / 3;
    if (body_of_node[node] >= 0) bodies.at(body_of_node[node]).hold(node, unknown.unknown % 3);
  }
  for (const PartTie& tie : model.joints.ties) bodies.at(body_of_node[tie.freedom / 3]).tie(tie);
  RigidFreedom freedom;
  freedom.bodies = static_cast<int>(bodies.size());
  for (const auto& entry : bodies) entry.second.find(bodies.size() > 1, freedom);
  return freedom;
}

}  // namespace blocklift::structure

#include "structure/mesh/files/deck/equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/mesh/files/deck/log.h"

namespace blocklift::structure {

namespace {

using Row = Eigen::Matrix<double, 1, 6>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Adds factor times a freedom to an equation, one term a vertex.
void add_term(MotionEquation& equation, const DeckFreedom& freedom, double factor) {
  auto term = std::find_if(equation.terms.begin(), equation.terms.end(),
                           [&](const auto& known) { return known.vertex == freedom.vertex; });
  if (term == equation.terms.end()) {
    equation.terms.push_back({freedom.vertex});
    term = equation.terms.end() - 1;
  }
  Vector3& sum = freedom.component < 3 ? term->of_displacement : term->of_rotation;
  sum += factor * freedom.axes.col(freedom.component % 3);
}

/// A freedom's motion in that of a rigid body: row times (displacement of the origin, rotation).
/// @param size of the body, m: displacements count over it.
Row rigid_row(const Deck& deck, const DeckFreedom& freedom, const Vector3& origin, double size) {
  const Vector3 direction = freedom.axes.col(freedom.component % 3);
  Row row = Row::Zero();
  if (freedom.component < 3)
    row << direction.transpose(),
        ((deck.mesh.vertices[freedom.vertex] - origin) / size).cross(direction).transpose();
  else
    row.tail<3>() = direction.transpose();
  return row;
}

/// Mean distance of freedoms' vertices from a place, m; 1 where all are at it.
template <typename Freedoms, typename FreedomOf>
double mean_distance(const Deck& deck, const Freedoms& freedoms, const Vector3& origin,
                     const FreedomOf& freedom_of) {
  double sum = 0;
  for (const auto& one : freedoms)
    sum += (deck.mesh.vertices[freedom_of(one).vertex] - origin).norm();
  return sum > 0 ? sum / static_cast<double>(freedoms.size()) : 1;
}

/// A row of rigid motion counts displacements over a size; what it is times a freedom's own unit.
double unit_of(const DeckFreedom& freedom, double size) { return freedom.component < 3 ? size : 1; }

void push(Deck& deck, MotionEquation equation) {
  equation.label = static_cast<long>(deck.mesh.equations.size()) + 1;
  deck.mesh.equations.push_back(std::move(equation));
}

/// The inverse of a matrix that must have one. @throws CardError with a text if it has none.
Matrix6 inverse_or_complaint(const Matrix6& matrix, const char* text) {
  constexpr double singular = 1e-8;
  const algebra::PivotedColumns pivots = algebra::pivoted_columns(matrix);
  if (pivots.last < singular * pivots.first) throw CardError{text};
  return algebra::inverse_of(matrix);
}

}  // namespace

void add_equation(Deck& deck, const std::vector<EquationTerm>& terms, const std::string& place) {
  MotionEquation equation;
  // A displacement counts in the deck's lengths, a rotation in radians.
  for (const EquationTerm& term : terms)
    add_term(equation, term.freedom,
             term.factor * (term.freedom.component < 3 ? 1 : deck.units.length));
  const MotionEquation::Term& first = equation.terms.front();
  if (first.of_displacement.isZero(0) && first.of_rotation.isZero(0))
    throw CardError{"the factor of the first freedom is nil"};
  // Factors have three digits and more.
  constexpr double most_rounding = 0.01;
  const MotionEquation given = equation;
  if (balance(deck.mesh, equation) < most_rounding)
    push(deck, std::move(equation));
  else
    deck.holding_equations.push_back({given, place});
}

void add_rigid_equations(Deck& deck, const std::vector<DeckFreedom>& independent,
                         const std::vector<DeckFreedom>& dependent) {
  const char* const undetermined =
      "the independent components do not determine a rigid motion; six that do are due";
  if (independent.size() != 6) throw CardError{undetermined};
  if (dependent.empty()) throw CardError{"no component follows"};
  const Vector3 origin = deck.mesh.vertices[independent.front().vertex];
  std::vector<DeckFreedom> all = independent;
  all.insert(all.end(), dependent.begin(), dependent.end());
  const double size =
      mean_distance(deck, all, origin, [](const DeckFreedom& freedom) { return freedom; });
  Matrix6 rows;
  for (int i = 0; i < 6; ++i) rows.row(i) = rigid_row(deck, independent[i], origin, size);
  const Matrix6 inverse = inverse_or_complaint(rows, undetermined);
  for (const DeckFreedom& freedom : dependent) {
    const Row shares = rigid_row(deck, freedom, origin, size) * inverse;
    MotionEquation equation;
    add_term(equation, freedom, 1);
    for (int i = 0; i < 6; ++i)
      if (std::abs(shares[i]) > 1e-12)
        add_term(equation, independent[i],
                 -shares[i] * unit_of(freedom, size) / unit_of(independent[i], size));
    push(deck, std::move(equation));
  }
}

void add_mean_equations(Deck& deck, const std::vector<DeckFreedom>& reference,
                        const std::vector<CountedFreedom>& counted) {
  const Vector3 origin = deck.mesh.vertices[reference.front().vertex];
  const double size =
      mean_distance(deck, counted, origin, [](const CountedFreedom& one) { return one.freedom; });
  std::vector<Row> rows;
  Matrix6 sum = Matrix6::Zero();
  for (const CountedFreedom& one : counted) {
    rows.push_back(rigid_row(deck, one.freedom, origin, size));
    sum += one.weight * rows.back().transpose() * rows.back();
  }
  const Matrix6 inverse = inverse_or_complaint(
      sum, "the components that count do not determine the motion of the reference grid");
  for (const DeckFreedom& freedom : reference) {
    const Row of_motion = rigid_row(deck, freedom, origin, size) * inverse;
    MotionEquation equation;
    add_term(equation, freedom, 1);
    for (std::size_t i = 0; i < counted.size(); ++i) {
      const double share = counted[i].weight * of_motion.dot(rows[i]);
      if (std::abs(share) > 1e-12)
        add_term(equation, counted[i].freedom,
                 -share * unit_of(freedom, size) / unit_of(counted[i].freedom, size));
    }
    push(deck, std::move(equation));
  }
}

void add_rigid_rod(Deck& deck, int first, int second) {
  const Vector3 line = deck.mesh.vertices[second] - deck.mesh.vertices[first];
  if (!(line.norm() > 1e-9)) throw CardError{"a rod between nodes at one place has no direction"};
  MotionEquation equation;
  equation.terms = {{first, line.normalized()}, {second, -line.normalized()}};
  push(deck, std::move(equation));
}

std::vector<ScalarTerm> scalar_terms(const MotionEquation& equation, const UnitSystem& units,
                                     const std::vector<Eigen::Matrix3d>& axes,
                                     std::set<int>& taken) {
  std::vector<ScalarTerm> terms;
  for (const MotionEquation::Term& term : equation.terms) {
    const Eigen::Matrix3d turned = axes[term.vertex].transpose();
    const Vector3 along = turned * term.of_displacement,
                  about = turned * term.of_rotation / units.length;
    for (int i = 0; i < 3; ++i) {
      if (along[i] != 0) terms.push_back({term.vertex, i, along[i]});
      if (about[i] != 0) terms.push_back({term.vertex, 3 + i, about[i]});
    }
  }
  const bool is_rotation = equation.terms.front().of_displacement.isZero(0);
  auto follower = terms.end();
  for (auto term = terms.begin(); term != terms.end(); ++term) {
    const bool may_follow = term->vertex == equation.terms.front().vertex &&
                            (term->component >= 3) == is_rotation &&
                            taken.count(6 * term->vertex + term->component) == 0;
    if (may_follow &&
        (follower == terms.end() || std::abs(term->factor) > std::abs(follower->factor)))
      follower = term;
  }
  if (follower == terms.end())
    throw ModelError(fmt::format(
        "equation {}: all freedoms of its first vertex follow others already", equation.label));
  taken.insert(6 * follower->vertex + follower->component);
  std::iter_swap(terms.begin(), follower);
  return terms;
}

}  // namespace blocklift::structure

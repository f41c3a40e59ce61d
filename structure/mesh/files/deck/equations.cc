#include "structure/mesh/files/deck/equations.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/files/deck/log.h"

namespace blocklift::structure {

void add_equation(Deck& deck, const std::vector<EquationTerm>& terms) {
  MotionEquation equation;
  equation.label = static_cast<long>(deck.mesh.equations.size()) + 1;
  for (const EquationTerm& one : terms) {
    auto term = std::find_if(equation.terms.begin(), equation.terms.end(),
                             [&](const auto& known) { return known.vertex == one.vertex; });
    if (term == equation.terms.end()) {
      equation.terms.push_back({one.vertex});
      term = equation.terms.end() - 1;
    }
    // A displacement counts in the deck's lengths, a rotation in radians.
    if (one.component < 3)
      term->of_displacement += one.factor * one.axes.col(one.component);
    else
      term->of_rotation += one.factor * deck.units.length * one.axes.col(one.component - 3);
  }
  const MotionEquation::Term& first = equation.terms.front();
  if (first.of_displacement.isZero(0) && first.of_rotation.isZero(0))
    throw CardError{"the factor of the first freedom is nil"};
  // Factors have three digits and more.
  constexpr double most_rounding = 0.01;
  if (!(balance(deck.mesh, equation) < most_rounding))
    throw CardError{
        "an equation resists motions of the block as a whole: it would hold it, where a lifted "
        "block hangs on its ropes alone"};
  deck.mesh.equations.push_back(std::move(equation));
}

std::vector<ScalarTerm> scalar_terms(const MotionEquation& equation, const UnitSystem& units,
                                     const std::vector<Eigen::Matrix3d>& axes,
                                     std::set<int>& taken) {
  std::vector<ScalarTerm> terms;
  for (const MotionEquation::Term& term : equation.terms) {
    const Eigen::Matrix3d turned = axes[at(term.vertex)].transpose();
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

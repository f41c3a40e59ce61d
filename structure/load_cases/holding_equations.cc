#include "structure/load_cases/holding_equations.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

bool is_of_one_direction(const MotionEquation& equation) {
  const MotionEquation::Term& term = equation.terms.front();
  return equation.terms.size() == 1 &&
         (term.of_displacement.isZero(0) || term.of_rotation.isZero(0));
}

/// Largest coefficient: rotations count in metres, as the deck's equation does.
double largest_of(const MotionEquation& equation) {
  double largest = 0;
  for (const MotionEquation::Term& term : equation.terms)
    largest = std::max({largest, term.of_displacement.cwiseAbs().maxCoeff(),
                        term.of_rotation.cwiseAbs().maxCoeff()});
  return largest;
}

template <typename Visit>
void for_each_of_several(const Deck& deck, const Visit& visit) {
  for (const HoldingEquation& held : deck.holding_equations)
    if (!is_of_one_direction(held.equation)) visit(held);
}

}  // namespace

std::vector<Support> supports_of_equations(const Deck& deck) {
  std::vector<Support> supports;
  for (const HoldingEquation& held : deck.holding_equations) {
    if (!is_of_one_direction(held.equation)) continue;
    const MotionEquation::Term& term = held.equation.terms.front();
    const bool is_rotation = term.of_displacement.isZero(0);
    const Vector3 axis = (is_rotation ? term.of_rotation : term.of_displacement).normalized();
    Support& support = supports.emplace_back();
    support.vertex = term.vertex;
    support.held[is_rotation ? 3 : 0] = true;
    support.axes.col(0) = axis;
    support.axes.col(1) = axis.unitOrthogonal();
    support.axes.col(2) = axis.cross(support.axes.col(1));
  }
  return supports;
}

std::vector<HeldSum> sums_of_equations(const Space& space, const Deck& deck) {
  std::vector<HeldSum> sums;
  for_each_of_several(deck, [&](const HoldingEquation& held) {
    HeldSum& sum = sums.emplace_back();
    const double unit = largest_of(held.equation);
    for (const MotionEquation::Term& term : held.equation.terms) {
      const int node = space.node_of_vertex(term.vertex);
      if (node < 0) {
        const auto& labels = space.mesh().vertex_labels;
        throw ModelError(fmt::format("{}: an equation has node {}, which no element is joined to",
                                     held.place,
                                     labels.empty() ? term.vertex + 1L : labels[term.vertex]));
      }
      for (int i = 0; i < 6; ++i) {
        const double factor = (i < 3 ? term.of_displacement[i] : term.of_rotation[i - 3]) / unit;
        if (factor == 0) continue;
        const int freedom = 6 * node + i;
        for (const Space::Term* of = space.begin_of(freedom); of != space.end_of(freedom); ++of)
          sum.coefficients[of->unknown] += factor * of->weight;
      }
    }
  });
  return sums;
}

std::vector<SupportReaction> reactions_of_equations(
    const Deck& deck, const Eigen::Ref<const Eigen::VectorXd>& forces) {
  std::vector<SupportReaction> reactions;
  Eigen::Index row = 0;
  for_each_of_several(deck, [&](const HoldingEquation& held) {
    const double force = forces[row++] / largest_of(held.equation);
    for (const MotionEquation::Term& term : held.equation.terms)
      reactions.push_back({term.vertex, force * term.of_displacement, force * term.of_rotation});
  });
  return reactions;
}

}  // namespace blocklift::structure

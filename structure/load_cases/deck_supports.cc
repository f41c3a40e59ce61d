#include "structure/load_cases/deck_supports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "structure/index.h"
#include "structure/space/edge_nodes.h"

namespace blocklift::structure {

namespace {

/// A held axis of a vertex.
struct HeldAxis {
  Vector3 axis = Vector3::Zero();
  bool is_rotation = false;
  double value = 0;
};

using AxesOfVertices = std::map<int, std::vector<HeldAxis>>;

constexpr double parallel = 1 - 1e-9;  // cosine

AxesOfVertices held_axes(const std::vector<Support>& supports) {
  AxesOfVertices axes;
  for (const Support& support : supports)
    for (Eigen::Index c = 0; c < 6; ++c) {
      if (!support.held[c]) continue;
      HeldAxis held{support.axes.col(c % 3), c >= 3, support.value[c]};
      auto& of_vertex = axes[support.vertex];
      // A deck may say the same twice: the last word counts.
      const auto same = std::find_if(of_vertex.begin(), of_vertex.end(), [&](const HeldAxis& one) {
        return one.is_rotation == held.is_rotation && std::abs(one.axis.dot(held.axis)) > parallel;
      });
      if (same == of_vertex.end())
        of_vertex.push_back(held);
      else
        *same = held;
    }
  return axes;
}

/// Holds a vertex's node, and what lies on edges of plates and solids between held vertices. A bar
/// between them bends.
class Holder {
 public:
  Holder(const Space& space, const AxesOfVertices& axes, const EdgeMiddles& middles)
      : space_(space), axes_(axes), middles_(middles) {}

  std::vector<HeldDirection> hold() {
    for (const auto& [vertex, axes] : axes_) {
      const int node = space_.node_of_vertex(vertex);
      if (node < 0) continue;
      done_.insert(node);
      for (const HeldAxis& held : axes)
        directions_.push_back(
            {node, held.axis, held.is_rotation, held.value, {{{vertex, 1}, {-1, 0}}}});
    }
    for_each_node_within_edges(space_, [&](int node, int from, int to, double share) {
      hold_between(node, from, to, share);
    });
    return std::move(directions_);
  }

 private:
  void hold_between(int node, int from, int to, double share) {
    const auto at_from = axes_.find(from), at_to = axes_.find(to);
    if (at_from == axes_.end() || at_to == axes_.end()) return;
    const auto own = middles_.find(std::minmax(from, to));
    const auto at_middle = own != middles_.end() ? axes_.find(own->second) : axes_.end();
    if (own != middles_.end() && at_middle == axes_.end()) return;
    if (!done_.insert(node).second) return;
    for (const HeldAxis& one : at_from->second) {
      const HeldAxis* other = match(one, at_to->second);
      const HeldAxis* between = at_middle != axes_.end() ? match(one, at_middle->second) : nullptr;
      if (other == nullptr || (between == nullptr && own != middles_.end())) continue;
      // Of the ends and the middle, which is nothing on a linear edge.
      const double bulge = between != nullptr ? 4 * share * (1 - share) : 0;
      const HeldAxis& middle = between != nullptr ? *between : one;
      const std::array<std::pair<const HeldAxis*, double>, 3> parts{
          {{&one, 1 - share - bulge / 2}, {other, share - bulge / 2}, {&middle, bulge}}};
      Vector3 axis = Vector3::Zero();
      double value = 0;
      for (const auto& [part, weight] : parts) {
        const double sign = one.axis.dot(part->axis) < 0 ? -1 : 1;
        axis += weight * sign * part->axis;
        value += weight * sign * part->value;
      }
      directions_.push_back(
          {node, axis.normalized(), one.is_rotation, value, {{{from, 1 - share}, {to, share}}}});
    }
  }

  /// The held axis that is most like another one; nullptr if none is. About a cylinder axes turn
  /// from vertex to vertex.
  static const HeldAxis* match(const HeldAxis& one, const std::vector<HeldAxis>& others) {
    const auto found = std::max_element(
        others.begin(), others.end(),
        [&](const HeldAxis& a, const HeldAxis& b) { return likeness(one, a) < likeness(one, b); });
    return likeness(one, *found) < 0.8 ? nullptr : &*found;
  }

  static double likeness(const HeldAxis& a, const HeldAxis& b) {
    return a.is_rotation == b.is_rotation ? std::abs(a.axis.dot(b.axis)) : -1;
  }

  const Space& space_;
  const AxesOfVertices& axes_;
  const EdgeMiddles& middles_;
  std::set<int> done_;
  std::vector<HeldDirection> directions_;
};

}  // namespace

std::vector<HeldDirection> find_held_directions(const Space& space,
                                                const std::vector<Support>& supports,
                                                const EdgeMiddles& middles) {
  const AxesOfVertices axes = held_axes(supports);
  return Holder(space, axes, middles).hold();
}

std::vector<HeldSum> as_sums(const Space& space, const std::vector<HeldDirection>& directions) {
  std::vector<HeldSum> sums;
  for (const HeldDirection& held : directions) {
    HeldSum& sum = sums.emplace_back();
    sum.value = held.value;
    for (int axis = 0; axis < 3; ++axis) {
      if (held.axis[axis] == 0) continue;
      const int freedom = 6 * held.node + (held.is_rotation ? 3 : 0) + axis;
      for (const Space::Term* term = space.begin_of(freedom); term != space.end_of(freedom); ++term)
        sum.coefficients[term->unknown] += held.axis[axis] * term->weight;
    }
  }
  return sums;
}

}  // namespace blocklift::structure

#include "structure/space/joints.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <deal.II/base/quadrature_lib.h>

#include "structure/index.h"

namespace blocklift::structure {

namespace {

constexpr double same_place = 1e-9;  // of an edge's length

class Forest {
 public:
  explicit Forest(int count) : parent_(at(count)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

using TracesOfEdges = std::map<std::pair<int, int>, std::vector<const EdgeTrace*>>;

/// The pieces of an edge that lie in no longer one; of equal ones the first.
std::vector<const EdgeTrace*> find_masters(std::vector<const EdgeTrace*> traces) {
  std::stable_sort(traces.begin(), traces.end(), [](const EdgeTrace* a, const EdgeTrace* b) {
    return a->begin != b->begin ? a->begin < b->begin : a->end > b->end;
  });
  std::vector<const EdgeTrace*> masters;
  for (const EdgeTrace* trace : traces)
    if (masters.empty() || trace->end > masters.back()->end + same_place) masters.push_back(trace);
  return masters;
}

/// Visits the nodes of the traces that lie on each master: visit(master, node, place on the
/// master).
template <typename Visit>
void for_each_follower(const std::vector<const EdgeTrace*>& traces, const Visit& visit) {
  for (const EdgeTrace* master : find_masters(traces))
    for (const EdgeTrace* trace : traces) {
      if (trace == master || trace->begin < master->begin - same_place ||
          trace->end > master->end + same_place)
        continue;
      const std::vector<double> places = lagrange_places(static_cast<int>(trace->nodes.size()) - 1);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double t = trace->begin + places[i] * (trace->end - trace->begin);
        visit(*master, trace->nodes[i], (t - master->begin) / (master->end - master->begin));
      }
    }
}

/// Place in the master's nodes of a node at x; -1 if none is there.
int same_node(const EdgeTrace& master, double x) {
  const std::vector<double> places = lagrange_places(static_cast<int>(master.nodes.size()) - 1);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (std::abs(places[i] - x) < same_place) return static_cast<int>(i);
  return -1;
}

}  // namespace

std::vector<double> lagrange_places(int degree) {
  static const auto tables = [] {
    std::vector<std::vector<double>> places(6);
    for (unsigned p = 1; p < places.size(); ++p) {
      const dealii::QGaussLobatto<1> rule(p + 1);
      for (const dealii::Point<1>& point : rule.get_points()) places[p].push_back(point[0]);
    }
    return places;
  }();
  return tables[degree];
}

std::vector<double> lagrange_values(int degree, double x) {
  const std::vector<double> places = lagrange_places(degree);
  std::vector<double> values(places.size(), 1);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j)
      if (j != i) values[i] *= (x - places[j]) / (places[i] - places[j]);
  return values;
}

std::vector<NodeTie> find_joint_ties(int nodes, const std::vector<EdgeTrace>& traces,
                                     std::vector<int>& vertex_node) {
  Forest forest(nodes);
  const auto join_vertex = [&](int vertex, int node) {
    int& known = vertex_node[vertex];
    if (known < 0) known = node;
    forest.join(known, node);
  };
  TracesOfEdges edges;
  for (const EdgeTrace& trace : traces) {
    if (trace.from == trace.to) {
      for (const int node : trace.nodes) join_vertex(trace.from, node);
      continue;
    }
    if (trace.begin < same_place) join_vertex(trace.from, trace.nodes.front());
    if (trace.end > 1 - same_place) join_vertex(trace.to, trace.nodes.back());
    edges[{trace.from, trace.to}].push_back(&trace);
  }
  // Nodes of one place first, so that what follows a polynomial is known to be on no master.
  for (const auto& [edge, meeting] : edges) {
    const std::vector<const EdgeTrace*> masters = find_masters(meeting);
    for (std::size_t i = 1; i < masters.size(); ++i)
      if (std::abs(masters[i]->begin - masters[i - 1]->end) < same_place)
        forest.join(masters[i - 1]->nodes.back(), masters[i]->nodes.front());
    for_each_follower(meeting, [&](const EdgeTrace& master, int node, double x) {
      if (const int i = same_node(master, x); i >= 0) forest.join(node, master.nodes[i]);
    });
  }
  std::vector<NodeTie> ties;
  std::vector<char> is_tied(at(nodes), 0);
  for (const auto& [edge, meeting] : edges)
    for_each_follower(meeting, [&](const EdgeTrace& master, int node, double x) {
      const int follower = forest.root(node);
      if (same_node(master, x) >= 0 || is_tied[follower] != 0) return;
      is_tied[follower] = 1;
      NodeTie tie{follower, {}, lagrange_values(static_cast<int>(master.nodes.size()) - 1, x)};
      for (const int m : master.nodes) tie.masters.push_back(forest.root(m));
      ties.push_back(std::move(tie));
    });
  for (int node = 0; node < nodes; ++node)
    if (const int root = forest.root(node); root != node) ties.push_back({node, {root}, {1}});
  return ties;
}

}  // namespace blocklift::structure

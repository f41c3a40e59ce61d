#include "structure/space/elimination.h"

#include <metis.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <unordered_map>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

struct HashOfList {
  std::size_t operator()(const std::vector<int>& list) const {
    std::size_t hash = list.size();
    for (const int i : list)
      hash = (hash ^ static_cast<std::size_t>(i)) * 0x9E3779B97F4A7C15ULL + (hash >> 29);
    return hash;
  }
};

/// Groups in the order in which they occur; `group_of` tells the group of each unknown, -1 for
/// none.
std::vector<UnknownGroup> find_groups(int unknowns, const std::vector<std::vector<int>>& elements,
                                      std::vector<int>& group_of) {
  std::vector<std::vector<int>> elements_of(at(unknowns));
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const int unknown : elements[e])
      if (elements_of[unknown].empty() || elements_of[unknown].back() != static_cast<int>(e))
        elements_of[unknown].push_back(static_cast<int>(e));
  std::vector<UnknownGroup> groups;
  std::unordered_map<std::vector<int>, int, HashOfList> known;
  group_of.assign(unknowns, -1);
  for (int u = 0; u < unknowns; ++u) {
    if (elements_of[u].empty()) continue;
    const auto [entry, is_new] = known.try_emplace(elements_of[u], static_cast<int>(groups.size()));
    if (is_new) groups.push_back({0, 0, elements_of[u]});
    ++groups[entry->second].count;
    group_of[u] = entry->second;
  }
  return groups;
}

/// Nested dissection of the groups' graph (two are joined when an element holds both), each
/// weighing as many unknowns as it has. Returns the groups in elimination order.
std::vector<int> dissection_order(const std::vector<UnknownGroup>& groups,
                                  const std::vector<std::vector<int>>& groups_of_elements) {
  std::vector<int> order(groups.size());
  std::iota(order.begin(), order.end(), 0);
  if (groups.size() < 30) return order;
  std::vector<idx_t> start{0}, neighbours, weights;
  std::vector<int> mark(groups.size(), -1);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    mark[g] = static_cast<int>(g);
    for (const int element : groups[g].elements)
      for (const int other : groups_of_elements[element])
        if (mark[other] != static_cast<int>(g)) {
          mark[other] = static_cast<int>(g);
          neighbours.push_back(other);
        }
    start.push_back(static_cast<idx_t>(neighbours.size()));
    weights.push_back(groups[g].count);
  }
  idx_t count = static_cast<idx_t>(groups.size());
  std::vector<idx_t> permutation(groups.size()), inverse(groups.size());
  // METIS draws from rand(), whose state the whole process shares: of two orders that are sought at
  // once each would follow from when the other draws, and with it the last bits of all solutions.
  static std::mutex drawing;
  const std::lock_guard lock(drawing);
  if (METIS_NodeND(&count, start.data(), neighbours.data(), weights.data(), nullptr,
                   permutation.data(), inverse.data()) != METIS_OK)
    throw ModelError("METIS could not order the unknowns");
  std::copy(permutation.begin(), permutation.end(), order.begin());
  return order;
}

/// Parents in the elimination tree of an order, -1 for roots (Liu 1990).
std::vector<int> elimination_tree(const std::vector<int>& order,
                                  const std::vector<UnknownGroup>& groups,
                                  const std::vector<std::vector<int>>& groups_of_elements) {
  const int count = static_cast<int>(order.size());
  std::vector<int> place(order.size()), parent(order.size(), -1), ancestor(order.size(), -1);
  for (int i = 0; i < count; ++i) place[order[i]] = i;
  for (int i = 0; i < count; ++i)
    for (const int element : groups[order[i]].elements)
      for (const int other : groups_of_elements[element])
        for (int j = place[other]; j >= 0 && j < i;) {
          const int next = ancestor[j];
          ancestor[j] = i;
          if (next < 0) parent[j] = i;
          if (next == i) break;
          j = next;
        }
  return parent;
}

/// Renumbers an elimination order so that each subtree of the elimination tree is contiguous.
std::vector<int> postordered(const std::vector<int>& order, const std::vector<int>& parent) {
  const int count = static_cast<int>(order.size());
  std::vector<std::vector<int>> children(order.size());
  std::vector<int> open, result;
  for (int i = 0; i < count; ++i)
    if (parent[i] >= 0) children[parent[i]].push_back(i);
  for (int root = 0; root < count; ++root) {
    if (parent[root] >= 0) continue;
    open.push_back(root);
    while (!open.empty()) {
      const int i = open.back();
      if (children[i].empty()) {
        result.push_back(order[i]);
        open.pop_back();
      } else {
        open.push_back(children[i].back());
        children[i].pop_back();
      }
    }
  }
  return result;
}

std::vector<std::vector<int>> list_by_element(const std::vector<UnknownGroup>& groups,
                                              std::size_t elements) {
  std::vector<std::vector<int>> lists(elements);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int element : groups[g].elements) lists[element].push_back(static_cast<int>(g));
  return lists;
}

}  // namespace

Elimination find_elimination(int unknowns, const std::vector<std::vector<int>>& elements) {
  std::vector<int> group_of;
  const std::vector<UnknownGroup> found = find_groups(unknowns, elements, group_of);
  const auto of_elements = list_by_element(found, elements.size());
  const std::vector<int> dissected = dissection_order(found, of_elements);
  const std::vector<int> order =
      postordered(dissected, elimination_tree(dissected, found, of_elements));

  Elimination result;
  std::vector<int> new_group(found.size());
  for (const int g : order) {
    new_group[g] = static_cast<int>(result.groups.size());
    result.groups.push_back({result.count, found[g].count, found[g].elements});
    result.count += found[g].count;
  }
  std::vector<int> filled(found.size(), 0);
  result.place.assign(unknowns, -1);
  for (int u = 0; u < unknowns; ++u) {
    if (group_of[u] < 0) continue;
    const int group = new_group[group_of[u]];
    result.place[u] = result.groups[group].first + filled[group]++;
  }
  result.groups_of_elements = list_by_element(result.groups, elements.size());
  return result;
}

}  // namespace blocklift::structure

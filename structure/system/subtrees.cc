#include "structure/system/subtrees.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "structure/index.h"

namespace blocklift::structure {

namespace {

/// The supernodes as a forest, with the work of each subtree.
struct Forest {
  std::vector<double> own, of_subtree;
  std::vector<std::vector<int>> children;
  std::vector<int> roots;
};

Forest make_forest(const std::vector<Supernode>& supernodes) {
  Forest forest;
  forest.of_subtree.assign(supernodes.size(), 0);
  forest.children.resize(supernodes.size());
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    forest.own.push_back(elimination_work(supernodes[s]));
    forest.of_subtree[s] += forest.own[s];
    const int parent = supernodes[s].parent, number = static_cast<int>(s);
    if (parent < 0) {
      forest.roots.push_back(number);
      continue;
    }
    forest.of_subtree[parent] += forest.of_subtree[s];
    forest.children[parent].push_back(number);
  }
  return forest;
}

/// The heaviest subtree first.
void sort_by_work(const Forest& forest, std::vector<int>& roots) {
  std::sort(roots.begin(), roots.end(), [&](int a, int b) {
    return std::make_pair(-forest.of_subtree[a], a) < std::make_pair(-forest.of_subtree[b], b);
  });
}

/// Subtrees dealt out, the heaviest first, each to the process that has least.
struct Deal {
  std::vector<int> roots, processes;
  double most = 0;  ///< work of the process that has most
};

Deal deal_out(const Forest& forest, std::vector<int> roots, int processes) {
  sort_by_work(forest, roots);
  using Load = std::pair<double, int>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int process = 0; process < processes; ++process) loads.emplace(0.0, process);
  Deal deal;
  for (const int root : roots) {
    auto [load, process] = loads.top();
    loads.pop();
    load += forest.of_subtree[root];
    deal.most = std::max(deal.most, load);
    deal.processes.push_back(process);
    loads.emplace(load, process);
  }
  deal.roots = std::move(roots);
  return deal;
}

Deal best_deal(const Forest& forest, const std::vector<Supernode>& supernodes, int processes) {
  std::vector<int> roots = forest.roots;
  Deal best;
  double least = std::numeric_limits<double>::infinity(), of_interface = 0, columns = 0;
  while (!roots.empty() && of_interface < least) {
    Deal deal = deal_out(forest, roots, processes);
    // What a process leaves to the interface is a dense square of it, at most: it is factorised
    // and multiplied once more than in one process.
    const double longest = deal.most + of_interface + 2 * std::pow(columns, 3) / 3;
    if (longest < least) {
      least = longest;
      best = std::move(deal);
    }
    const auto heaviest = std::max_element(roots.begin(), roots.end(), [&](int a, int b) {
      return forest.of_subtree[a] < forest.of_subtree[b];
    });
    const int root = *heaviest;
    roots.erase(heaviest);
    of_interface += forest.own[root];
    columns += static_cast<double>(supernodes[root].columns);
    roots.insert(roots.end(), forest.children[root].begin(), forest.children[root].end());
  }
  return best;
}

/// Gives supernodes of which nothing is said what is said of their parents, which come after them.
void hand_down(const std::vector<Supernode>& supernodes, std::vector<int>& said) {
  for (std::size_t s = supernodes.size(); s-- > 0;)
    if (said[s] < 0 && supernodes[s].parent >= 0) said[s] = said[supernodes[s].parent];
}

}  // namespace

double elimination_work(const Supernode& supernode) {
  double work = 0;
  for (long k = 0; k < supernode.columns; ++k)
    work += std::pow(static_cast<double>(supernode.rows - k), 2);
  return work;
}

std::vector<int> deal_out_subtrees(const std::vector<Supernode>& supernodes, int processes) {
  const Forest forest = make_forest(supernodes);
  const Deal deal = best_deal(forest, supernodes, processes);
  std::vector<int> of_supernode(supernodes.size(), -1);
  for (std::size_t i = 0; i < deal.roots.size(); ++i)
    of_supernode[deal.roots[i]] = deal.processes[i];
  hand_down(supernodes, of_supernode);
  std::vector<int> of_column;
  for (std::size_t s = 0; s < supernodes.size(); ++s)
    of_column.insert(of_column.end(), at(supernodes[s].columns), of_supernode[s]);
  return of_column;
}

std::vector<int> independent_subtrees(const std::vector<Supernode>& supernodes, double share) {
  const Forest forest = make_forest(supernodes);
  const double most = share * std::accumulate(forest.own.begin(), forest.own.end(), 0.0);
  std::vector<int> roots;
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    const int parent = supernodes[s].parent;
    if (forest.of_subtree[s] <= most && (parent < 0 || forest.of_subtree[parent] > most))
      roots.push_back(static_cast<int>(s));
  }
  sort_by_work(forest, roots);
  std::vector<int> subtree_of(supernodes.size(), -1);
  for (std::size_t i = 0; i < roots.size(); ++i) subtree_of[roots[i]] = static_cast<int>(i);
  hand_down(supernodes, subtree_of);
  return subtree_of;
}

}  // namespace blocklift::structure

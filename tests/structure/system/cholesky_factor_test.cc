// Factors by threads against the same by one thread, and against what a dense factorisation gives.
#include "structure/system/cholesky_factor.h"

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "structure/space/elimination.h"
#include "structure/system/linear_solver.h"
#include "structure/system/subtrees.h"

namespace blocklift::structure {
namespace {

using Elements = std::vector<std::vector<int>>;

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// Squares of a grid of nodes, numbered from one on.
void add_squares(int nodes_a_side, int first, Elements& elements) {
  for (int i = 0; i + 1 < nodes_a_side; ++i)
    for (int j = 0; j + 1 < nodes_a_side; ++j) {
      const int node = first + nodes_a_side * i + j;
      elements.push_back({node, node + 1, node + nodes_a_side, node + nodes_a_side + 1});
    }
}

/// Sums a positive definite matrix of each element, in the order of their elimination.
Eigen::MatrixXd assembled(const Elements& elements, int unknowns) {
  const Elimination elimination = find_elimination(unknowns, elements);
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (const std::vector<int>& element : elements) {
    const auto size = static_cast<Eigen::Index>(element.size());
    const Eigen::MatrixXd root =
        Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(generator); });
    std::vector<int> places;
    for (const int unknown : element) places.push_back(elimination.place[unknown]);
    sum(places, places) += root * root.transpose() + Eigen::MatrixXd::Identity(size, size);
  }
  return sum;
}

SparseLower sparse_half(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd lower = matrix.triangularView<Eigen::Lower>();
  return lower.sparseView().cast<double>();
}

/// Trees of very different size: a large grid of whose nodes every third along a side is joined
/// with all of a set, which threads factorise by tiles; a small grid; and an unknown of its own.
Eigen::MatrixXd unequal_trees() {
  constexpr int large = 30, small = 5, set = 600;
  Elements elements;
  add_squares(large, 0, elements);
  add_squares(small, large * large, elements);
  const int alone = large * large + small * small;
  elements.push_back({alone});
  std::vector<int> all(set);
  for (int i = 0; i < set; ++i) all[i] = alone + 1 + i;
  for (int i = 0; i < large; i += 3) all.push_back(i);
  std::sort(all.begin(), all.end());
  elements.push_back(all);
  return assembled(elements, alone + 1 + set);
}

Eigen::MatrixXd factor_of(const Eigen::MatrixXd& matrix, int threads) {
  const SparseLower half = sparse_half(matrix);
  CholeskyFactor factor(half);
  factor.factorise(half, matrix.diagonal(), threads);
  return factor.corner(0);
}

// Higham (2002), theorem 10.3: |L L' - K| <= (n + 1) u |L| |L'|, whose norm is at most trace K.
void expect_factor(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& matrix) {
  const double bound = static_cast<double>(matrix.cols() + 1) * unit_roundoff * matrix.trace();
  EXPECT_LT((lower * lower.transpose() - matrix).norm(), bound);
}

TEST(FactorByThreads, IsTheSameToTheLastBitForAnyNumber) {
  const Eigen::MatrixXd matrix = unequal_trees();
  const Eigen::MatrixXd serial = factor_of(matrix, 1);
  expect_factor(serial, matrix);
  for (const int threads : {2, 3, 7})
    EXPECT_TRUE(factor_of(matrix, threads) == serial) << threads << " threads";
}

TEST(FactorByThreads, MayHaveOneColumn) {
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Constant(1, 1, 9.0);
  for (const int threads : {1, 2}) EXPECT_EQ(factor_of(matrix, threads)(0, 0), 3);
}

// Pivots before the first that is not positive do not feel it, wherever those that follow stand.
TEST(FactorByThreads, NamesTheFirstUnknownThatNothingHolds) {
  const Eigen::MatrixXd good = unequal_trees();
  const Eigen::Index last = good.cols() - 1;
  for (const Eigen::Index loose : {Eigen::Index{0}, last / 3, last - 200, last}) {
    Eigen::MatrixXd matrix = good;
    matrix(loose, loose) = matrix(last, last) = -1;
    for (const int threads : {1, 2, 3}) try {
        factor_of(matrix, threads);
        ADD_FAILURE() << loose << ", " << threads << " threads";
      } catch (const LooseUnknown& error) {
        EXPECT_EQ(error.unknown, loose) << threads << " threads";
        EXPECT_EQ(error.what(),
                  std::string("the stiffness matrix is not positive definite: the supports leave "
                              "a part free to move"));
      }
  }
}

// Higham (2002), theorem 10.4: |K x - f| <= (3 n + 1) u |L| |L'| |x|.
TEST(FactorByThreads, SolvesLoadsInTheSameBatchesHoweverManyThereAre) {
  const Eigen::MatrixXd matrix = unequal_trees();
  const SparseLower half = sparse_half(matrix);
  CholeskyFactor factor(half);
  factor.factorise(half, matrix.diagonal());
  const Eigen::MatrixXd loads = Eigen::MatrixXd::Random(matrix.rows(), 35);
  const Eigen::MatrixXd solutions = factor.solve(loads);
  const double size = static_cast<double>(3 * matrix.cols() + 1);
  EXPECT_LT((matrix * solutions - loads).norm(),
            size * unit_roundoff * matrix.trace() * solutions.norm());
  EXPECT_TRUE(factor.solve(loads.leftCols(16)) == solutions.leftCols(16));
  EXPECT_TRUE(factor.solve_upper(factor.solve_lower(loads)) == solutions);
}

TEST(IndependentSubtrees, HaveAShareOfTheWorkAtMost) {
  const Eigen::MatrixXd matrix = unequal_trees();
  const std::vector<Supernode> supernodes = CholeskyFactor(sparse_half(matrix)).supernodes();
  constexpr double share = 1e-3;  // the set has nearly all work
  const std::vector<int> subtree_of = independent_subtrees(supernodes, share);
  ASSERT_EQ(subtree_of.size(), supernodes.size());
  double all = 0;
  std::vector<double> works;
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    const double work = elimination_work(supernodes[s]);
    all += work;
    const int subtree = subtree_of[s], parent = supernodes[s].parent;
    if (subtree < 0) {
      EXPECT_TRUE(parent < 0 || subtree_of[parent] < 0);
      continue;
    }
    EXPECT_TRUE(parent < 0 || subtree_of[parent] < 0 || subtree_of[parent] == subtree);
    works.resize(std::max(works.size(), static_cast<std::size_t>(subtree) + 1));
    works[subtree] += work;
  }
  EXPECT_GT(works.size(), 3);
  EXPECT_LE(works.front(), share * all);
  EXPECT_TRUE(std::is_sorted(works.rbegin(), works.rend()));
  EXPECT_LT(*std::min_element(subtree_of.begin(), subtree_of.end()), 0);
}

}  // namespace
}  // namespace blocklift::structure

#include "structure/system/supernodal_factorisation.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <numeric>

#include "algebra/cholesky_steps.h"
#include "parallel/blas_threads.h"
#include "parallel/threads.h"
#include "structure/index.h"
#include "structure/system/subtrees.h"

namespace blocklift::structure {

namespace {

using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

// Rows and columns of a tile: its sums stay in the cache of a core.
constexpr long tile_rows = 256, tile_columns = 128;
// Multiplications and additions that are worth threads of their own.
constexpr double worth_threads = 2e7;
// Subtrees that go side by side have this share of a thread's work at most.
constexpr double share_of_thread = 0.25;

/// Rows begin .. end - 1 of a supernode, by their place in it, are columns of another.
struct Update {
  int from = 0;
  long begin = 0, end = 0;
};

/// Rows and columns of a supernode, by their place in it.
struct Tile {
  long first_row = 0, last_row = 0, first_column = 0, last_column = 0;
};

/// What a thread works in.
struct Workspace {
  std::vector<double> product;
  std::vector<long> rows;  ///< of the product, by their place in the supernode
};

/// The lower half of a block of columns by tiles.
std::vector<Tile> tiles_of(long first_row, long rows, long first_column, long columns) {
  std::vector<Tile> tiles;
  for (long column = first_column; column < columns; column += tile_columns)
    for (long row = first_row; row < rows; row += tile_rows) {
      const Tile tile{row, std::min(rows, row + tile_rows), column,
                      std::min(columns, column + tile_columns)};
      if (tile.last_row > tile.first_column) tiles.push_back(tile);
    }
  return tiles;
}

void each_tile(const std::vector<Tile>& tiles, int threads, Workspace& workspace,
               const std::function<void(const Tile&, Workspace&)>& work) {
  if (threads == 1) {
    for (const Tile& tile : tiles) work(tile, workspace);
    return;
  }
  parallel::for_each(static_cast<int>(tiles.size()), threads, [&](int tile) {
    Workspace own;
    work(tiles[tile], own);
  });
}

class Factorisation {
 public:
  Factorisation(const SupernodalPattern& pattern, const SparseLower& matrix, double* values,
                int threads)
      : pattern_(pattern), matrix_(matrix), values_(values), threads_(threads) {
    find_updates();
  }

  long run();

 private:
  void find_updates();
  /// @returns the first column whose pivot is not positive, as all that follow.
  long run_subtrees(const std::vector<int>& subtree_of) const;
  long eliminate(int s, int threads, std::vector<int>& place, Workspace& workspace) const;
  void take_matrix(int s, const Tile& tile, const std::vector<int>& place) const;
  void take_update(int s, const Tile& tile, const Update& update, const std::vector<int>& place,
                   Workspace& workspace) const;
  long factorise_columns(int s, int threads, Workspace& workspace) const;

  const long* rows_of(int s) const { return pattern_.rows + pattern_.row_starts[s]; }
  Block block_of(int s) const {
    const Supernode& of = pattern_.supernodes[s];
    return {values_ + pattern_.value_starts[s], of.rows, of.columns, Eigen::OuterStride<>(of.rows)};
  }

  const SupernodalPattern& pattern_;
  const SparseLower& matrix_;
  double* values_;
  int threads_;
  std::vector<long> update_starts_;  ///< of each supernode in `updates_`
  std::vector<Update> updates_;      ///< of a supernode by those before it, ascending
};

void Factorisation::find_updates() {
  const std::vector<Supernode>& all = pattern_.supernodes;
  std::vector<int> supernode_of(at(matrix_.cols()));
  for (std::size_t s = 0; s < all.size(); ++s)
    std::fill_n(supernode_of.begin() + all[s].first, all[s].columns, static_cast<int>(s));
  const auto each_update = [&](const auto& take) {
    for (std::size_t s = 0; s < all.size(); ++s) {
      const int from = static_cast<int>(s);
      const long* const rows = rows_of(from);
      for (long begin = all[s].columns, end = begin; begin < all[s].rows; begin = end) {
        const int target = supernode_of[rows[begin]];
        while (end < all[s].rows && supernode_of[rows[end]] == target) ++end;
        take(target, Update{from, begin, end});
      }
    }
  };
  update_starts_.assign(all.size() + 1, 0);
  each_update([&](int target, const Update&) { ++update_starts_[target + 1]; });
  std::partial_sum(update_starts_.begin(), update_starts_.end(), update_starts_.begin());
  updates_.resize(at(update_starts_.back()));
  std::vector<long> next(update_starts_.begin(), update_starts_.end() - 1);
  each_update([&](int target, const Update& update) { updates_[next[target]++] = update; });
}

long Factorisation::run() {
  // Also with one thread: with another number of its own, BLAS forms other sums.
  const parallel::OneBlasThread whatever_the_threads;
  const std::vector<int> subtree_of =
      independent_subtrees(pattern_.supernodes, share_of_thread / threads_);
  const long failed = run_subtrees(subtree_of);
  std::vector<int> place(at(matrix_.cols()));
  Workspace workspace;
  for (std::size_t s = 0; s < subtree_of.size(); ++s) {
    const Supernode& supernode = pattern_.supernodes[s];
    // What comes after a pivot that is not positive may build on it.
    if (supernode.first > failed) break;
    if (subtree_of[s] >= 0) continue;
    const long column = eliminate(static_cast<int>(s), threads_, place, workspace);
    if (column < supernode.first + supernode.columns) return column;
  }
  return failed;
}

long Factorisation::run_subtrees(const std::vector<int>& subtree_of) const {
  std::vector<std::vector<int>> subtrees;
  for (std::size_t s = 0; s < subtree_of.size(); ++s) {
    if (subtree_of[s] < 0) continue;
    subtrees.resize(std::max(subtrees.size(), at(subtree_of[s]) + 1));
    subtrees[subtree_of[s]].push_back(static_cast<int>(s));
  }
  std::vector<long> failed(subtrees.size(), matrix_.cols());
  parallel::for_each(static_cast<int>(subtrees.size()), threads_, [&](int subtree) {
    std::vector<int> place(at(matrix_.cols()));
    Workspace workspace;
    for (const int s : subtrees[subtree]) {
      const Supernode& supernode = pattern_.supernodes[s];
      const long column = eliminate(s, 1, place, workspace);
      if (column == supernode.first + supernode.columns) continue;
      failed[subtree] = column;
      return;
    }
  });
  return failed.empty() ? matrix_.cols() : *std::min_element(failed.begin(), failed.end());
}

/// @param place of each row in the supernode; what it holds before does not matter.
long Factorisation::eliminate(int s, int threads, std::vector<int>& place,
                              Workspace& workspace) const {
  const Supernode& supernode = pattern_.supernodes[s];
  for (long row = 0; row < supernode.rows; ++row) place[rows_of(s)[row]] = static_cast<int>(row);
  if (elimination_work(supernode) < worth_threads) threads = 1;
  each_tile(tiles_of(0, supernode.rows, 0, supernode.columns), threads, workspace,
            [&](const Tile& tile, Workspace& own) {
              take_matrix(s, tile, place);
              for (long u = update_starts_[s]; u < update_starts_[s + 1]; ++u)
                take_update(s, tile, updates_[u], place, own);
            });
  return factorise_columns(s, threads, workspace);
}

void Factorisation::take_matrix(int s, const Tile& tile, const std::vector<int>& place) const {
  Block values = block_of(s);
  values
      .block(tile.first_row, tile.first_column, tile.last_row - tile.first_row,
             tile.last_column - tile.first_column)
      .setZero();
  const long first = rows_of(s)[tile.first_row], last = rows_of(s)[tile.last_row - 1];
  for (long c = tile.first_column; c < tile.last_column; ++c) {
    const long column = pattern_.supernodes[s].first + c;
    const long* const rows = matrix_.innerIndexPtr();
    const long end = matrix_.outerIndexPtr()[column + 1];
    long entry = std::lower_bound(rows + matrix_.outerIndexPtr()[column], rows + end, first) - rows;
    for (; entry < end && rows[entry] <= last; ++entry)
      values(place[rows[entry]], c) = matrix_.valuePtr()[entry];
  }
}

void Factorisation::take_update(int s, const Tile& tile, const Update& update,
                                const std::vector<int>& place, Workspace& workspace) const {
  const Supernode& from = pattern_.supernodes[update.from];
  const long* const rows = rows_of(update.from);
  const auto find = [&](long begin, long end, long row) {
    return std::lower_bound(rows + begin, rows + end, row) - rows;
  };
  const long first_column = pattern_.supernodes[s].first;
  const long left = find(update.begin, update.end, first_column + tile.first_column);
  const long right = find(left, update.end, first_column + tile.last_column);
  if (left == right) return;
  const long top = find(left, from.rows, rows_of(s)[tile.first_row]);
  const long bottom = find(top, from.rows, rows_of(s)[tile.last_row - 1] + 1);
  if (top == bottom) return;
  const long height = bottom - top, width = right - left;
  const Block factor = block_of(update.from);
  Block values = block_of(s);
  const long row = place[rows[top]], column = rows[left] - first_column;
  if (place[rows[bottom - 1]] - row == height - 1 &&
      rows[right - 1] - first_column - column == width - 1) {
    algebra::subtract_by_transposed(factor.middleRows(top, height), factor.middleRows(left, width),
                                    values.block(row, column, height, width));
    return;
  }
  workspace.product.resize(std::max(workspace.product.size(), at(height * width)));
  workspace.rows.resize(at(height));
  for (long i = 0; i < height; ++i) workspace.rows[i] = place[rows[top + i]];
  Eigen::Map<Eigen::MatrixXd> product(workspace.product.data(), height, width);
  algebra::multiply_by_transposed(factor.middleRows(top, height), factor.middleRows(left, width),
                                  product);
  for (long c = 0; c < width; ++c) {
    double* const into = &values(0, rows[left + c] - first_column);
    const double* const of = product.data() + c * height;
    for (long i = 0; i < height; ++i) into[workspace.rows[i]] -= of[i];
  }
}

/// L of a supernode's columns when all that comes before is taken from them.
/// @returns the first column whose pivot is not positive; the one after the last if none is.
long Factorisation::factorise_columns(int s, int threads, Workspace& workspace) const {
  const Supernode& supernode = pattern_.supernodes[s];
  Block values = block_of(s);
  for (long first = 0; first < supernode.columns; first += tile_columns) {
    const long width = std::min(tile_columns, supernode.columns - first), next = first + width;
    auto corner = values.block(first, first, width, width);
    const long good = algebra::factorise_in_place(corner);
    if (good < width) return supernode.first + first + good;
    std::vector<Tile> below;
    for (long row = next; row < supernode.rows; row += tile_rows)
      below.push_back({row, std::min(supernode.rows, row + tile_rows), first, next});
    const auto columns_of = [&](long row, long end) {
      return values.block(row, first, end - row, width);
    };
    each_tile(below, threads, workspace, [&](const Tile& tile, Workspace&) {
      algebra::divide_by_upper_from_right(corner, columns_of(tile.first_row, tile.last_row));
    });
    each_tile(tiles_of(next, supernode.rows, next, supernode.columns), threads, workspace,
              [&](const Tile& tile, Workspace&) {
                algebra::subtract_by_transposed(
                    columns_of(tile.first_row, tile.last_row),
                    columns_of(tile.first_column, tile.last_column),
                    values.block(tile.first_row, tile.first_column, tile.last_row - tile.first_row,
                                 tile.last_column - tile.first_column));
              });
  }
  return supernode.first + supernode.columns;
}

}  // namespace

long factorise_supernodes(const SupernodalPattern& pattern, const SparseLower& matrix,
                          double* values, int threads) {
  return Factorisation(pattern, matrix, values, threads > 0 ? threads : parallel::usable_threads())
      .run();
}

}  // namespace blocklift::structure

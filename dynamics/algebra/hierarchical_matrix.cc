#include "dynamics/algebra/hierarchical_matrix.h"

#include <hmat/hmat.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

#include "dynamics/errors.h"
#include "parallel/blas_threads.h"
#include "parallel/threads.h"

namespace blocklift::dynamics {
namespace {

// More groups than threads make a product dearer: of 8,616 panels of a surface and 18 columns 12.7
// ms with one group on one thread, 13.3 ms with four, 14.4 ms with eight.
constexpr int group_count = 4;
// Clusters of no more points are not divided: 100, 200 and 300 take 8.0, 7.0 and 7.9 ms on two
// threads.
constexpr int points_of_a_leaf = 200;
// Clusters stand apart if the smaller one's diameter is at most so many times their distance: with
// 3 and 4 a product takes 7.0 and 7.6 ms on two threads, with 2 and 3, of other leaves, 15.0 and
// 12.8 ms on one.
constexpr double diameter_over_distance = 3.0;

template <auto release>
struct Release {
  void operator()(auto* object) const { release(object); }
};
using Clustering = std::unique_ptr<hmat_clustering_algorithm_t, Release<hmat_delete_clustering>>;
using ClusterTree = std::unique_ptr<hmat_cluster_tree_t, Release<hmat_delete_cluster_tree>>;
using Admissibility = std::unique_ptr<hmat_admissibility_t, Release<hmat_delete_admissibility>>;
using Compression = std::unique_ptr<hmat_compression_algorithm_t, Release<hmat_delete_compression>>;

hmat_interface_t make_library() {
  hmat_interface_t functions{};
  hmat_init_default_interface(&functions, HMAT_SIMPLE_PRECISION);
  functions.init();
  return functions;
}

/// The library's functions on matrices in single precision.
const hmat_interface_t& library() {
  static const hmat_interface_t functions = make_library();
  return functions;
}

struct DestroyBlock {
  void operator()(hmat_matrix_t* block) const { library().destroy(block); }
};
using Block = std::unique_ptr<hmat_matrix_t, DestroyBlock>;

/// Points that lie together.
struct Group {
  ClusterTree tree;
  std::vector<int> order;  ///< rows of the whole matrix, in the library's order
};

/// Halves the rows where their points reach furthest, until there are `parts` of them.
void divide(const Eigen::Matrix2Xd& points, std::vector<int> rows, int parts,
            std::vector<std::vector<int>>& divided) {
  if (parts == 1) {
    divided.push_back(std::move(rows));
    return;
  }
  const Eigen::Matrix2Xd among = points(Eigen::all, rows);
  const Eigen::Vector2d extent = among.rowwise().maxCoeff() - among.rowwise().minCoeff();
  const Eigen::Index axis = extent.y() > extent.x() ? 1 : 0;
  std::stable_sort(rows.begin(), rows.end(),
                   [&](int a, int b) { return points(axis, a) < points(axis, b); });
  const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2);
  divide(points, {rows.begin(), middle}, parts / 2, divided);
  divide(points, {middle, rows.end()}, parts / 2, divided);
}

Group make_group(const Eigen::Matrix2Xd& points, const std::vector<int>& rows) {
  Group group;
  const Clustering halves(hmat_create_clustering_geometric());
  const Clustering leaves(hmat_create_clustering_max_dof(halves.get(), points_of_a_leaf));
  Eigen::Matrix2Xd among = points(Eigen::all, rows);
  const auto count = static_cast<int>(rows.size());
  group.tree.reset(hmat_create_cluster_tree(among.data(), 2, count, leaves.get()));
  const int* order = hmat_cluster_get_indices(group.tree.get());
  group.order.resize(rows.size());
  std::transform(order, order + count, group.order.begin(), [&](int place) { return rows[place]; });
  return group;
}

/// Where the library finds the entries of a pair of groups.
struct Entries {
  const Eigen::MatrixXf* matrix;
  const int* rows;     ///< of the matrix, from the block's first on, in the library's order
  const int* columns;  ///< of the matrix, in the same way
};

/// The pair whose entries the library is given.
struct Pair {
  const Eigen::MatrixXf* matrix;
  const Group* rows;
  const Group* columns;
};

void prepare_entries(int first_row, int /*rows*/, int first_column, int /*columns*/,
                     int* /*row_order*/, int* /*row_places*/, int* /*column_order*/,
                     int* /*column_places*/, void* context, hmat_block_info_t* info) {
  const auto& pair = *static_cast<const Pair*>(context);
  info->user_data = new Entries{pair.matrix, pair.rows->order.data() + first_row,
                                pair.columns->order.data() + first_column};
  info->release_user_data = [](void* entries) { delete static_cast<Entries*>(entries); };
  info->block_type = hmat_block_full;
}

/// The library asks in double precision, whatever it keeps.
void copy_entries(void* data, int first_row, int rows, int first_column, int columns, void* to) {
  const auto& entries = *static_cast<const Entries*>(data);
  auto* value = static_cast<double*>(to);
  for (int j = first_column; j < first_column + columns; ++j) {
    const float* column = entries.matrix->col(entries.columns[j]).data();
    for (int i = first_row; i < first_row + rows; ++i)
      *value++ = static_cast<double>(column[entries.rows[i]]);
  }
}

Block make_block(Pair pair, double accuracy) {
  const int symmetric = pair.rows == pair.columns ? 1 : 0;
  const Admissibility apart(hmat_create_admissibility_standard(diameter_over_distance));
  Block block(library().create_empty_hmatrix_admissibility(
      pair.rows->tree.get(), pair.columns->tree.get(), symmetric, apart.get()));
  const Compression compression(hmat_create_compression_aca_plus(accuracy));
  hmat_assemble_context_t context;
  hmat_assemble_context_init(&context);
  context.prepare = prepare_entries;
  context.block_compute = copy_entries;
  context.user_context = &pair;
  context.compression = compression.get();
  context.lower_symmetric = symmetric;
  context.progress = nullptr;
  if (!block || library().assemble_generic(block.get(), &context) != 0) {
    throw SimulationError("a hierarchical matrix of " + std::to_string(pair.matrix->rows()) +
                          " points could not be made of its entries");
  }
  return block;
}

}  // namespace

struct HierarchicalMatrix::Groups {
  std::vector<Group> groups;
  /// Of each group (rows) with itself and those before it.
  std::vector<std::vector<Block>> blocks;
};

HierarchicalMatrix::HierarchicalMatrix(const Eigen::MatrixXf& matrix,
                                       const Eigen::Matrix2Xd& points, double accuracy) {
  const Eigen::Index n = matrix.rows();
  if (n == 0) return;
  // The thin matrices must not depend on the number of threads either.
  const parallel::OneBlasThread whatever_the_threads;
  auto made = std::make_shared<Groups>();
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<int>> divided;
  divide(points, std::move(all), n < group_count ? 1 : group_count, divided);
  for (const std::vector<int>& rows : divided) made->groups.push_back(make_group(points, rows));
  for (std::size_t r = 0; r < made->groups.size(); ++r) {
    std::vector<Block>& row = made->blocks.emplace_back();
    for (std::size_t c = 0; c <= r; ++c)
      row.push_back(make_block({&matrix, &made->groups[r], &made->groups[c]}, accuracy));
  }
  groups_ = made;
}

double HierarchicalMatrix::bytes() const {
  double numbers = 0.0;
  if (!groups_) return numbers;
  for (const std::vector<Block>& row : groups_->blocks) {
    for (const Block& block : row) {
      hmat_info_t information;
      library().get_info(block.get(), &information);
      numbers += static_cast<double>(information.compressed_size);
    }
  }
  return sizeof(float) * numbers;
}

void HierarchicalMatrix::multiply(const Eigen::MatrixXf& X, Eigen::MatrixXf& Y,
                                  Workspace& workspace) const {
  if (!groups_ || X.cols() == 0) return;
  const std::vector<Group>& groups = groups_->groups;
  workspace.x.resize(groups.size());
  workspace.y.resize(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    workspace.x[g] = X(groups[g].order, Eigen::all);
    workspace.y[g].resize(workspace.x[g].rows(), X.cols());
  }
  const auto columns = static_cast<int>(X.cols());
  // Each group's rows are summed in one order, by one thread.
  const auto multiply_rows = [&](int row) {
    const auto r = static_cast<std::size_t>(row);
    const float one = 1.0F, zero = 0.0F;
    for (std::size_t c = 0; c < groups.size(); ++c) {
      hmat_matrix_t* block = groups_->blocks[std::max(r, c)][std::min(r, c)].get();
      library().gemm_dense(c > r ? 'T' : 'N', 'N', 'L', &one, block, workspace.x[c].data(),
                           c == 0 ? &zero : &one, workspace.y[r].data(), columns);
    }
    Y(groups[r].order, Eigen::all) = workspace.y[r];
  };
  const parallel::OneBlasThread for_many_small_products;
  parallel::for_each(static_cast<int>(groups.size()), 0, multiply_rows);
}

}  // namespace blocklift::dynamics

#include "structure/elasticity/stiffness.h"

#include <algorithm>
#include <array>
#include <map>
#include <thread>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "structure/index.h"

namespace blocklift::structure {

namespace {

// d_a N_i d_b N_j integrals (entry 3 a + b) -> stiffness.
Eigen::MatrixXd hooke_sum(const std::array<Eigen::MatrixXd, 9>& products, double lambda,
                          double mu) {
  const Eigen::Index n = products[0].rows();
  Eigen::MatrixXd stiffness(3 * n, 3 * n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const double trace = products[0](i, j) + products[4](i, j) + products[8](i, j);
      for (int b = 0; b < 3; ++b)
        for (int a = 0; a < 3; ++a)
          stiffness(3 * i + a, 3 * j + b) = lambda * products[at(3 * a + b)](i, j) +
                                            mu * products[at(3 * b + a)](i, j) +
                                            (a == b ? mu * trace : 0);
    }
  return stiffness;
}

// Weighted products of gradients (rows 3 q + a): sum_q w_q g_a(q)^T g_b(q).
std::array<Eigen::MatrixXd, 9> gradient_products(const Eigen::MatrixXd& gradients,
                                                 const Eigen::VectorXd& weights) {
  const Eigen::Index points = weights.size(), n = gradients.cols();
  std::array<Eigen::MatrixXd, 3> g;
  for (int a = 0; a < 3; ++a) {
    g[at(a)].resize(points, n);
    for (Eigen::Index q = 0; q < points; ++q) g[at(a)].row(q) = gradients.row(3 * q + a);
  }
  std::array<Eigen::MatrixXd, 9> products;
  for (int a = 0; a < 3; ++a) {
    const Eigen::MatrixXd weighted = weights.asDiagonal() * g[at(a)];
    for (int b = a; b < 3; ++b) {
      products[at(3 * a + b)].noalias() = weighted.transpose() * g[at(b)];
      if (b != a) products[at(3 * b + a)] = products[at(3 * a + b)].transpose();
    }
  }
  return products;
}

// Where the rows of another entity stand in the columns of an entity.
struct Neighbour {
  int entity;
  long offset;  // rows before it, counted from the end of the column's own entity
};

struct Pattern {
  std::vector<std::vector<Neighbour>> neighbours;  // later entities of each entity, ascending
  std::vector<long> column_start;                  // of each unknown, and the end
};

Pattern make_pattern(const Discretisation& space) {
  Pattern pattern;
  pattern.neighbours.resize(space.entities.size());
  pattern.column_start.reserve(at(space.unknowns()) + 1);
  pattern.column_start.push_back(0);
  std::vector<int> others;
  for (std::size_t e = 0; e < space.entities.size(); ++e) {
    others.clear();
    for (const int cell : space.entities[e].cells)
      for (const int other : space.cell_entities[at(cell)])
        if (other > static_cast<int>(e)) others.push_back(other);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    long rows = 0;
    for (const int other : others) {
      pattern.neighbours[e].push_back({other, rows});
      rows += 3L * space.entities[at(other)].node_count;
    }
    const long own = 3L * space.entities[e].node_count;
    for (long k = 0; k < own; ++k)
      pattern.column_start.push_back(pattern.column_start.back() + own - k + rows);
  }
  return pattern;
}

void fill_rows(const Discretisation& space, const Pattern& pattern, SparseLower& matrix, int part,
               int parts) {
  for (std::size_t e = at(part); e < space.entities.size(); e += at(parts)) {
    const NodeEntity& entity = space.entities[e];
    const long first = 3L * entity.first_node, own = 3L * entity.node_count;
    for (long k = 0; k < own; ++k) {
      const long start = pattern.column_start[static_cast<std::size_t>(first + k)];
      long* row = matrix.innerIndexPtr() + start;
      for (long r = k; r < own; ++r) *row++ = first + r;
      for (const Neighbour& neighbour : pattern.neighbours[e]) {
        const NodeEntity& other = space.entities[at(neighbour.entity)];
        for (long r = 0; r < 3L * other.node_count; ++r) *row++ = 3L * other.first_node + r;
      }
      const long end = pattern.column_start[static_cast<std::size_t>(first + k) + 1];
      std::fill(matrix.valuePtr() + start, matrix.valuePtr() + end, 0.0);
    }
  }
}

// Adds a cell's stiffness to the columns of those entities that are this part's.
void scatter(const Discretisation& space, const Pattern& pattern, int cell,
             const Eigen::MatrixXd& stiffness, SparseLower& matrix, int part, int parts) {
  // Local nodes of the cell, entity after entity.
  thread_local std::vector<std::vector<int>> members;
  const std::vector<int>& entities = space.cell_entities[at(cell)];
  members.assign(entities.size(), {});
  for (int i = 0; i < space.nodes_per_cell; ++i) {
    const int node = space.node(cell, i);
    const auto after = std::upper_bound(entities.begin(), entities.end(), node, [&](int n, int e) {
      return n < space.entities[at(e)].first_node;
    });
    members[static_cast<std::size_t>(after - entities.begin() - 1)].push_back(i);
  }
  for (std::size_t p = 0; p < entities.size(); ++p) {
    const int e = entities[p];
    if (e % parts != part) continue;
    const NodeEntity& entity = space.entities[at(e)];
    const long own = 3L * entity.node_count;
    for (std::size_t r = p; r < entities.size(); ++r) {
      const NodeEntity& other = space.entities[at(entities[r])];
      long offset = 0;
      if (r != p) {
        const auto& list = pattern.neighbours[at(e)];
        offset = std::lower_bound(list.begin(), list.end(), entities[r],
                                  [](const Neighbour& n, int wanted) { return n.entity < wanted; })
                     ->offset;
      }
      for (const int j : members[p]) {
        const long column_node = space.node(cell, j) - entity.first_node;
        for (int b = 0; b < 3; ++b) {
          const long k = 3 * column_node + b;
          double* column =
              matrix.valuePtr() +
              pattern.column_start[static_cast<std::size_t>(3L * entity.first_node + k)];
          const double* source = stiffness.col(3 * j + b).data();
          for (const int i : members[r]) {
            const long row = 3L * (space.node(cell, i) - other.first_node);
            if (r == p) {
              for (int a = 0; a < 3; ++a)
                if (row + a >= k) column[row + a - k] += source[3 * i + a];
            } else {
              double* target = column + (own - k) + offset + row;
              for (int a = 0; a < 3; ++a) target[a] += source[3 * i + a];
            }
          }
        }
      }
    }
  }
}

template <typename Work>
void in_threads(int threads, const Work& work) {
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back([&work, t] { work(t); });
  work(0);
  for (std::thread& other : others) other.join();
}

}  // namespace

CellStiffness::CellStiffness(const HexMesh& mesh, const Discretisation& space)
    : mesh_(mesh), space_(space) {
  const auto line = gauss_points(space.element.degree() + 1);
  rule_ = tensor_rule(line, line, line);
  gradients_ = space.element.gradients(rule_.topRows<3>());
  on_unit_cube_ = gradient_products(gradients_, rule_.row(3).transpose());
}

Eigen::MatrixXd CellStiffness::operator()(int cell) const {
  const Material& material = mesh_.material_of_cell(cell);
  const double lambda = material.lame_lambda(), mu = material.shear_modulus();
  if (space_.shape_affine[at(space_.cell_shape[at(cell)])]) {
    const Eigen::Matrix3d edges = jacobian(mesh_, cell, Vector3::Constant(0.5));
    const Eigen::Matrix3d inverse = edges.inverse();  // d xi_c / d x_a = inverse(c, a)
    const double size = edges.determinant();
    std::array<Eigen::MatrixXd, 9> products;
    const Eigen::Index n = on_unit_cube_[0].rows();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        auto& product = products[at(3 * a + b)];
        product.setZero(n, n);
        for (int c = 0; c < 3; ++c)
          for (int d = 0; d < 3; ++d) {
            const double factor = size * inverse(c, a) * inverse(d, b);
            if (factor != 0) product += factor * on_unit_cube_[at(3 * c + d)];
          }
      }
    return hooke_sum(products, lambda, mu);
  }
  Eigen::MatrixXd gradients(gradients_.rows(), gradients_.cols());
  Eigen::VectorXd weights(rule_.cols());
  for (Eigen::Index q = 0; q < rule_.cols(); ++q) {
    const Eigen::Matrix3d at_point = jacobian(mesh_, cell, rule_.col(q).head<3>());
    weights[q] = rule_(3, q) * at_point.determinant();
    gradients.middleRows<3>(3 * q).noalias() =
        at_point.inverse().transpose() * gradients_.middleRows<3>(3 * q);
  }
  return hooke_sum(gradient_products(gradients, weights), lambda, mu);
}

long stiffness_entries(const Discretisation& space) {
  return make_pattern(space).column_start.back();
}

SparseLower assemble_stiffness(const HexMesh& mesh, const Discretisation& space, int threads) {
  const Pattern pattern = make_pattern(space);
  SparseLower matrix(space.unknowns(), space.unknowns());
  matrix.resizeNonZeros(pattern.column_start.back());
  std::copy(pattern.column_start.begin(), pattern.column_start.end(), matrix.outerIndexPtr());
  in_threads(threads, [&](int part) { fill_rows(space, pattern, matrix, part, threads); });

  // Cells of one stiffness: same shape, same material.
  std::map<std::pair<int, int>, std::vector<int>> alike;
  for (int cell = 0; cell < space.cell_count(); ++cell)
    alike[{space.cell_shape[at(cell)], mesh.groups[at(mesh.cell_group[at(cell)])].material}]
        .push_back(cell);
  std::vector<const std::vector<int>*> kinds;
  for (const auto& entry : alike) kinds.push_back(&entry.second);

  // In batches, so that the cells' matrices never take more than some tens of megabytes.
  const CellStiffness cell_stiffness(mesh, space);
  const std::size_t batch = 64;
  std::vector<Eigen::MatrixXd> stiffness(batch);
  for (std::size_t first = 0; first < kinds.size(); first += batch) {
    const std::size_t last = std::min(kinds.size(), first + batch);
    in_threads(threads, [&](int part) {
      for (std::size_t k = first + at(part); k < last; k += at(threads))
        stiffness[k - first] = cell_stiffness(kinds[k]->front());
    });
    in_threads(threads, [&](int part) {
      for (std::size_t k = first; k < last; ++k)
        for (const int cell : *kinds[k])
          scatter(space, pattern, cell, stiffness[k - first], matrix, part, threads);
    });
  }
  return matrix;
}

}  // namespace blocklift::structure

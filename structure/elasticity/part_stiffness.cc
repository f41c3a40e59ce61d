// Stiffness of a part: pattern by nodes, cells in batches, columns dealt out to threads.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/elasticity/part_model.h"
#include "structure/error.h"
#include "structure/index.h"
#include "structure/limits.h"

namespace blocklift::structure {

namespace {

void in_threads(int threads, const std::function<void(int)>& work) {
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(work, t);
  work(0);
  for (std::thread& other : others) other.join();
}

// Nodes from each node on (itself the first) that share an element with it, ascending.
struct Graph {
  std::vector<long> start;  // of each node
  std::vector<int> nodes;
};

Graph node_graph(const PartMesh& mesh) {
  const auto count = static_cast<std::size_t>(mesh.nodes.cols());
  std::vector<std::vector<int>> elements(count);
  for (const int element : mesh.solids)
    for (int i = 0; i < mesh.kind(element).nodes; ++i)
      elements[at(mesh.node(element, i))].push_back(element);
  Graph graph{{0}, {}};
  std::vector<int> others;
  for (std::size_t node = 0; node < count; ++node) {
    others.assign(1, static_cast<int>(node));
    for (const int element : elements[node])
      for (int i = 0; i < mesh.kind(element).nodes; ++i)
        if (mesh.node(element, i) > static_cast<int>(node)) others.push_back(mesh.node(element, i));
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    graph.nodes.insert(graph.nodes.end(), others.begin(), others.end());
    graph.start.push_back(static_cast<long>(graph.nodes.size()));
  }
  return graph;
}

SparseLower empty_matrix(const Graph& graph) {
  const long nodes = static_cast<long>(graph.start.size()) - 1;
  const long entries = 9 * static_cast<long>(graph.nodes.size()) - 3 * nodes;
  if (const double bytes = 16.0 * static_cast<double>(entries), free = available_memory();
      bytes > free)
    throw NotEnoughMemory(fmt::format(
        "the stiffness of {} unknowns needs {:.1f} GB and {:.1f} GB are free; use larger elements",
        3 * nodes, bytes / 1e9, free / 1e9));
  SparseLower matrix(3 * nodes, 3 * nodes);
  matrix.resizeNonZeros(entries);
  long entry = 0;
  for (long node = 0; node < nodes; ++node)
    for (int b = 0; b < 3; ++b) {
      matrix.outerIndexPtr()[3 * node + b] = entry;
      for (long k = graph.start[static_cast<std::size_t>(node)];
           k < graph.start[static_cast<std::size_t>(node) + 1]; ++k)
        for (int a = 0; a < 3; ++a) {
          const long other = graph.nodes[static_cast<std::size_t>(k)];
          if (other == node && a < b) continue;
          matrix.innerIndexPtr()[entry] = 3 * other + a;
          matrix.valuePtr()[entry++] = 0;
        }
    }
  matrix.outerIndexPtr()[3 * nodes] = entry;
  return matrix;
}

// Adds an element's stiffness to the columns of those nodes that are this part's.
void scatter(const PartMesh& mesh, const Graph& graph, int element,
             const Eigen::MatrixXd& stiffness, SparseLower& matrix, int part, int parts) {
  const int n = mesh.kind(element).nodes;
  for (int j = 0; j < n; ++j) {
    const int column = mesh.node(element, j);
    if (column % parts != part) continue;
    const auto first = graph.nodes.begin() + graph.start[at(column)];
    const auto last = graph.nodes.begin() + graph.start[at(column) + 1];
    for (int i = 0; i < n; ++i) {
      const int row = mesh.node(element, i);
      if (row < column) continue;
      const long place = std::lower_bound(first, last, row) - first;
      for (int b = 0; b < 3; ++b) {
        // The node's own block holds its lower triangle only.
        double* target =
            matrix.valuePtr() + matrix.outerIndexPtr()[3L * column + b] + 3 * place - b;
        for (int a = row == column ? b : 0; a < 3; ++a)
          target[a] += stiffness(3 * i + a, 3 * j + b);
      }
    }
  }
}

}  // namespace

Eigen::MatrixXd part_element_stiffness(const PartModel& model, int solid) {
  const int element = model.mesh.solids[at(solid)];
  const ElementKind& kind = model.mesh.kind(element);
  const Material& material = model.materials[at(model.material_of_solid[at(solid)])];
  const double lambda = material.lame_lambda(), mu = material.shear_modulus();
  const Eigen::Matrix3Xd places = model.mesh.places(element);
  const int n = kind.nodes;
  std::array<Eigen::MatrixXd, 9> products;
  for (Eigen::MatrixXd& product : products) product.setZero(n, n);
  for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
    const auto by_unit = kind.gradients.middleRows<3>(3 * q);
    const Eigen::Matrix3d jacobian = places * by_unit.transpose();
    const Eigen::Matrix3Xd g = jacobian.inverse().transpose() * by_unit;
    const double weight = kind.weights[q] * jacobian.determinant();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        products[at(3 * a + b)].noalias() += weight * g.row(a).transpose() * g.row(b);
  }
  const Eigen::MatrixXd laplacian = products[0] + products[4] + products[8];
  Eigen::MatrixXd stiffness(3 * n, 3 * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          stiffness(3 * i + a, 3 * j + b) = lambda * products[at(3 * a + b)](i, j) +
                                            mu * products[at(3 * b + a)](i, j) +
                                            (a == b ? mu * laplacian(i, j) : 0);
  return stiffness;
}

SparseLower assemble_part_stiffness(const PartModel& model, int threads) {
  if (threads <= 0) threads = usable_threads();
  const Graph graph = node_graph(model.mesh);
  SparseLower matrix = empty_matrix(graph);
  const int solids = static_cast<int>(model.mesh.solids.size());
  constexpr int batch = 512;
  std::vector<Eigen::MatrixXd> stiffness(batch);
  for (int first = 0; first < solids; first += batch) {
    const int last = std::min(solids, first + batch);
    in_threads(threads, [&](int part) {
      for (int solid = first + part; solid < last; solid += threads)
        stiffness[at(solid - first)] = part_element_stiffness(model, solid);
    });
    in_threads(threads, [&](int part) {
      for (int solid = first; solid < last; ++solid)
        scatter(model.mesh, graph, model.mesh.solids[at(solid)], stiffness[at(solid - first)],
                matrix, part, threads);
    });
  }
  // Nodes of no solid (middles of circles and the like) are held; they only need to be regular.
  const std::vector<int> body = connected_bodies(model.mesh);
  for (std::size_t node = 0; node < body.size(); ++node)
    for (std::size_t a = 0; a < 3 && body[node] < 0; ++a)
      matrix.valuePtr()[matrix.outerIndexPtr()[3 * node + a]] = 1;
  return matrix;
}

}  // namespace blocklift::structure

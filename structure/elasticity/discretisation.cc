#include "structure/elasticity/discretisation.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

#include "structure/error.h"
#include "structure/index.h"

namespace blocklift::structure {

namespace {

// Node numbers of deal.II's FE_Q on the mesh, a cell after another.
std::vector<int> number_nodes(const HexMesh& mesh, int degree, int& node_count) {
  std::vector<dealii::Point<3>> vertices;
  for (const Vector3& v : mesh.vertices) vertices.emplace_back(v.x(), v.y(), v.z());
  std::vector<dealii::CellData<3>> cells(mesh.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells[c].vertices.assign(mesh.cells[c].begin(), mesh.cells[c].end());
    cells[c].material_id = static_cast<dealii::types::material_id>(mesh.cell_group[c]);
  }
  dealii::Triangulation<3> triangulation;
  try {
    triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
  } catch (const dealii::ExceptionBase& error) {
    throw ModelError(std::string("the mesh cannot be used: ") + error.what());
  }
  const dealii::FE_Q<3> element(static_cast<unsigned>(degree));
  dealii::DoFHandler<3> nodes(triangulation);
  nodes.distribute_dofs(element);
  node_count = static_cast<int>(nodes.n_dofs());
  std::vector<int> cell_nodes(mesh.cells.size() * element.n_dofs_per_cell());
  std::vector<dealii::types::global_dof_index> local(element.n_dofs_per_cell());
  for (const auto& cell : nodes.active_cell_iterators()) {
    const std::size_t c = static_cast<std::size_t>(cell->index());
    for (unsigned v = 0; v < 8; ++v)
      if (static_cast<int>(cell->vertex_index(v)) != mesh.cells[c][v])
        throw ModelError("the mesh cannot be used: its cells were renumbered");
    cell->get_dof_indices(local);
    for (std::size_t i = 0; i < local.size(); ++i)
      cell_nodes[c * local.size() + i] = static_cast<int>(local[i]);
  }
  nodes.clear();
  return cell_nodes;
}

// Nested dissection of the entities' graph (two are joined when a cell holds both), each weighing
// as many nodes as it has. Returns the entities in elimination order.
std::vector<int> dissection_order(const std::vector<NodeEntity>& entities,
                                  const std::vector<std::vector<int>>& cell_entities) {
  std::vector<int> order(entities.size());
  std::iota(order.begin(), order.end(), 0);
  if (entities.size() < 30) return order;
  std::vector<idx_t> start{0}, neighbours, weights;
  std::vector<int> mark(entities.size(), -1);
  for (std::size_t e = 0; e < entities.size(); ++e) {
    mark[e] = static_cast<int>(e);
    for (const int cell : entities[e].cells)
      for (const int other : cell_entities[at(cell)])
        if (mark[at(other)] != static_cast<int>(e)) {
          mark[at(other)] = static_cast<int>(e);
          neighbours.push_back(other);
        }
    start.push_back(static_cast<idx_t>(neighbours.size()));
    weights.push_back(entities[e].node_count);
  }
  idx_t count = static_cast<idx_t>(entities.size());
  std::vector<idx_t> permutation(entities.size()), inverse(entities.size());
  if (METIS_NodeND(&count, start.data(), neighbours.data(), weights.data(), nullptr,
                   permutation.data(), inverse.data()) != METIS_OK)
    throw ModelError("METIS could not order the unknowns");
  std::copy(permutation.begin(), permutation.end(), order.begin());
  return order;
}

// Renumbers an elimination order so that each subtree of the elimination tree is contiguous
// (postorder): the fill stays the same, and the factorisation finds its dense blocks without
// permuting the matrix again. Source: Liu (1990), The role of elimination trees.
std::vector<int> postordered(const std::vector<int>& order, const std::vector<NodeEntity>& entities,
                             const std::vector<std::vector<int>>& cell_entities) {
  const int count = static_cast<int>(order.size());
  std::vector<int> place(order.size()), parent(order.size(), -1), ancestor(order.size(), -1);
  for (int i = 0; i < count; ++i) place[at(order[at(i)])] = i;
  for (int i = 0; i < count; ++i)
    for (const int cell : entities[at(order[at(i)])].cells)
      for (const int other : cell_entities[at(cell)])
        for (int j = place[at(other)]; j >= 0 && j < i;) {
          const int next = ancestor[at(j)];
          ancestor[at(j)] = i;
          if (next < 0) parent[at(j)] = i;
          if (next == i) break;
          j = next;
        }
  std::vector<std::vector<int>> children(order.size());
  std::vector<int> open, result;
  for (int i = 0; i < count; ++i)
    if (parent[at(i)] >= 0) children[at(parent[at(i)])].push_back(i);
  for (int root = 0; root < count; ++root) {
    if (parent[at(root)] >= 0) continue;
    open.push_back(root);
    while (!open.empty()) {
      const int i = open.back();
      if (children[at(i)].empty()) {
        result.push_back(order[at(i)]);
        open.pop_back();
      } else {
        open.push_back(children[at(i)].back());
        children[at(i)].pop_back();
      }
    }
  }
  return result;
}

}  // namespace

namespace {

// Cells whose vertices span a parallelepiped with the same edges share a shape.
void find_shapes(const HexMesh& mesh, Discretisation& space) {
  std::map<std::array<std::int64_t, 10>, int> known;
  space.cell_shape.resize(mesh.cells.size());
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    const auto vertex = [&](std::size_t v) { return mesh.vertices[at(mesh.cells[at(cell)][v])]; };
    const Eigen::Matrix3d edges = jacobian(mesh, cell, Vector3::Zero());
    const double size = edges.cwiseAbs().maxCoeff();
    bool affine = mesh.curved_cells.empty();
    for (std::size_t v = 0; v < 8 && affine; ++v) {
      const Vector3 corner(v & 1 ? 1 : 0, v & 2 ? 1 : 0, v & 4 ? 1 : 0);
      affine =
          (vertex(v) - vertex(0) - edges * corner).cwiseAbs().maxCoeff() < 1e-11 * size + 1e-12;
    }
    for (int corner = 0; corner < 8; ++corner)
      if (jacobian(mesh, cell, Vector3(corner & 1, (corner >> 1) & 1, corner >> 2)).determinant() <=
          0)
        throw ModelError("cell " + std::to_string(cell) + " of group \"" +
                         mesh.groups[at(mesh.cell_group[at(cell)])].name +
                         "\" is inverted or degenerate");
    std::array<std::int64_t, 10> key{};
    for (int i = 0; i < 9; ++i) key[at(i)] = std::llround(edges(i % 3, i / 3) * 1e10);
    if (!affine) key[9] = cell + 1;
    const auto [entry, is_new] = known.try_emplace(key, static_cast<int>(space.shape_cell.size()));
    if (is_new) {
      space.shape_cell.push_back(cell);
      space.shape_affine.push_back(affine);
    }
    space.cell_shape[at(cell)] = entry->second;
  }
}

}  // namespace

Discretisation::Discretisation(const HexMesh& mesh, int degree)
    : element(degree), nodes_per_cell(element.node_count()) {
  find_shapes(mesh, *this);
  int count = 0;
  cell_nodes = number_nodes(mesh, degree, count);

  // Entities: nodes with one list of cells.
  std::vector<std::vector<int>> cells_of_node(at(count));
  for (int cell = 0; cell < cell_count(); ++cell)
    for (int i = 0; i < nodes_per_cell; ++i) cells_of_node[at(node(cell, i))].push_back(cell);
  std::map<std::vector<int>, int> known;
  std::vector<int> entity_of_node(at(count));
  std::vector<NodeEntity> found;
  for (int n = 0; n < count; ++n) {
    const auto [entry, is_new] =
        known.try_emplace(cells_of_node[at(n)], static_cast<int>(found.size()));
    if (is_new) found.push_back({0, 0, cells_of_node[at(n)]});
    ++found[at(entry->second)].node_count;
    entity_of_node[at(n)] = entry->second;
  }
  std::vector<std::vector<int>> found_in_cell(mesh.cells.size());
  for (std::size_t e = 0; e < found.size(); ++e)
    for (const int cell : found[e].cells) found_in_cell[at(cell)].push_back(static_cast<int>(e));

  // New numbers, entity after entity in elimination order.
  const std::vector<int> order =
      postordered(dissection_order(found, found_in_cell), found, found_in_cell);
  std::vector<int> place(found.size());
  int next = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[at(order[i])] = static_cast<int>(i);
    entities.push_back(found[at(order[i])]);
    entities.back().first_node = next;
    next += entities.back().node_count;
  }
  std::vector<int> filled(entities.size(), 0), new_number(at(count));
  for (int n = 0; n < count; ++n) {
    const std::size_t e = at(place[at(entity_of_node[at(n)])]);
    new_number[at(n)] = entities[e].first_node + filled[e]++;
  }
  for (int& n : cell_nodes) n = new_number[at(n)];
  cell_entities.resize(mesh.cells.size());
  for (std::size_t e = 0; e < entities.size(); ++e)
    for (const int cell : entities[e].cells) cell_entities[at(cell)].push_back(static_cast<int>(e));

  nodes.resize(3, count);
  for (int cell = 0; cell < cell_count(); ++cell)
    for (int i = 0; i < nodes_per_cell; ++i)
      nodes.col(node(cell, i)) = position(mesh, cell, element.nodes().col(i));
}

}  // namespace blocklift::structure

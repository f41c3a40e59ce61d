#include "structure/space/space.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Dense>
#include <deal.II/base/multithread_info.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <fmt/format.h>

#include "parallel/threads.h"
#include "structure/error.h"
#include "structure/index.h"
#include "structure/large_pages.h"
#include "structure/mesh/beam_lines.h"
#include "structure/mesh/fields/shell_edges.h"
#include "structure/mesh/solid_shape.h"
#include "structure/space/edge_nodes.h"
#include "structure/space/joints.h"
#include "structure/space/links.h"
#include "structure/space/space_implementation.h"

namespace blocklift::structure {

namespace {

using dealii::Point;
using ShellIterator = dealii::Triangulation<2, 3>::cell_iterator;

constexpr int most_divisions = 24;  // of one shell, by halving its edges

Point<3> to_point(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// deal.II's own messages name its sources; the user is told what is wrong with the mesh.
template <typename Work>
void with_model_errors(const Work& work) {
  try {
    work();
  } catch (const dealii::ExceptionBase& error) {
    throw ModelError(std::string("the mesh cannot be used: ") + error.what());
  }
}

void create_beams(const Mesh& mesh, dealii::Triangulation<1, 3>& triangulation) {
  std::vector<Point<3>> vertices;
  std::vector<dealii::CellData<1>> cells(mesh.beams.size());
  for (std::size_t b = 0; b < mesh.beams.size(); ++b) {
    for (unsigned v = 0; v < 2; ++v) {
      cells[b].vertices[v] = static_cast<unsigned>(vertices.size());
      vertices.push_back(to_point(mesh.vertices[mesh.beams[b].vertices[v]]));
    }
    cells[b].material_id = 0;
  }
  with_model_errors(
      [&] { triangulation.create_triangulation(vertices, cells, dealii::SubCellData()); });
}

/// Where a cell lies on the unit square of its shell.
template <typename Iterator>
ShellCell locate(const ShellBatch& batch, const Iterator& cell) {
  ShellCell located;
  const dealii::CellId id = cell->id();
  located.shell = batch.first_shell + static_cast<int>(id.get_coarse_cell_id());
  for (const auto child : id.get_child_indices()) {
    located.size /= 2;
    located.origin += located.size * Eigen::Vector2d(child & 1, child >> 1);
  }
  return located;
}

Vector3 place_on(const Mesh& mesh, const ShellCell& cell, const Eigen::Vector2d& xi) {
  return position(mesh, mesh.shells[cell.shell], cell.origin + cell.size * xi);
}

double longest_edge_of(const Mesh& mesh, const ShellCell& cell) {
  const auto corner = [&](double x, double y) { return place_on(mesh, cell, {x, y}); };
  const Vector3 a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
  return std::max({(b - a).norm(), (d - c).norm(), (c - a).norm(), (d - b).norm()});
}

void divide_shells(const Mesh& mesh, const std::function<double(const Vector3&)>& largest_edge,
                   ShellBatch& batch) {
  for (int round = 0; round < most_divisions; ++round) {
    bool is_any = false;
    for (const auto& cell : batch.cells.active_cell_iterators()) {
      const ShellCell located = locate(batch, cell);
      if (longest_edge_of(mesh, located) <=
          (1 + 1e-9) * largest_edge(place_on(mesh, located, {0.5, 0.5})))
        continue;
      cell->set_refine_flag();
      is_any = true;
    }
    if (!is_any) return;
    batch.cells.execute_coarsening_and_refinement();
  }
}

/// The order of the curved shells' points, at least 1.
int geometry_order(const Mesh& mesh) {
  Eigen::Index points = 4;
  for (const Eigen::Matrix3Xd& curved : mesh.curved_shells)
    points = std::max(points, curved.cols());
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(points)))) - 1;
}

/// deal.II's node number of each node when xi runs fastest.
std::vector<unsigned> lexicographic_order(const dealii::FE_Q<2, 3>& element) {
  const std::vector<Point<2>>& points = element.get_unit_support_points();
  std::vector<unsigned> order(points.size());
  for (unsigned i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](unsigned a, unsigned b) {
    const double rise = points[a][1] - points[b][1];
    return std::abs(rise) > 1e-9 ? rise < 0 : points[a][0] < points[b][0];
  });
  return order;
}

/// The four edges of a shell: corners at their ends and children along them.
struct ShellEdge {
  int from, to;
};
constexpr std::array<ShellEdge, 4> shell_edges{{{0, 2}, {1, 3}, {0, 1}, {2, 3}}};

/// Collects the traces of a cell and of what it was divided into along one edge of its shell.
class TraceCollector {
 public:
  TraceCollector(const Space& space, std::vector<EdgeTrace>& traces)
      : space_(space), traces_(traces) {}

  /// All shells of a batch along all their edges.
  void collect(const ShellBatch& batch) {
    first_cell_ = batch.first_cell;
    for (const auto& shell : batch.cells.cell_iterators_on_level(0))
      for (int edge = 0; edge < 4; ++edge) collect(shell, edge, 0, 1);
  }

  void collect(const ShellIterator& cell, int edge, double begin, double end) {
    const ShellEdge& ends = shell_edges[edge];
    if (cell->has_children()) {
      const double middle = 0.5 * (begin + end);
      collect(cell->child(static_cast<unsigned>(ends.from)), edge, begin, middle);
      collect(cell->child(static_cast<unsigned>(ends.to)), edge, middle, end);
      return;
    }
    const int active = first_cell_ + static_cast<int>(cell->active_cell_index());
    const Shell& shell = space_.mesh().shells[space_.shells()[active].shell];
    const int p = space_.degree(), *nodes = space_.shell_nodes(active);
    const auto corner = [&](int c) { return (c & 1) * p + (c >> 1) * p * (p + 1); };
    const int first = corner(ends.from), step = (corner(ends.to) - first) / p;
    std::vector<int> along;
    for (int i = 0; i <= p; ++i) along.push_back(nodes[first + i * step]);
    add(shell.vertices[ends.from], shell.vertices[ends.to], begin, end, std::move(along));
  }

  void add(int from, int to, double begin, double end, std::vector<int> nodes) {
    if (from > to) {
      std::reverse(nodes.begin(), nodes.end());
      std::swap(from, to);
      std::tie(begin, end) = std::pair(1 - end, 1 - begin);
    }
    traces_.push_back({from, to, begin, end, std::move(nodes)});
  }

 private:
  const Space& space_;
  std::vector<EdgeTrace>& traces_;
  int first_cell_ = 0;
};

/// Pairs of vertices that are an edge of a shell.
std::vector<std::pair<int, int>> edges_of_shells(const Mesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  for (const Shell& shell : mesh.shells)
    for (const ShellEdge& edge : shell_edges)
      edges.push_back(std::minmax(shell.vertices[edge.from], shell.vertices[edge.to]));
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Nodes of the shells' cells, batch by batch: their places, and each cell's with xi fastest.
void make_shell_nodes(const Mesh& mesh, const std::vector<ShellCell>& shells,
                      Space::Implementation& own, Eigen::Matrix3Xd& places,
                      std::vector<int>& nodes) {
  int count = 0;
  for (const auto& batch : own.shell_batches) {
    batch->nodes.reinit(batch->cells);
    batch->nodes.distribute_dofs(own.shell_element);
    batch->first_node = count;
    count += static_cast<int>(batch->nodes.n_dofs());
  }
  places.resize(3, count);
  nodes.reserve(shells.size() * own.shell_order.size());
  const std::vector<Point<2>>& unit = own.shell_element.get_unit_support_points();
  std::vector<dealii::types::global_dof_index> local(own.shell_order.size());
  for (const auto& batch : own.shell_batches)
    for (const auto& cell : batch->nodes.active_cell_iterators()) {
      const ShellCell& located = shells[own.shell_cells.size()];
      cell->get_dof_indices(local);
      for (const unsigned i : own.shell_order) {
        nodes.push_back(batch->first_node + static_cast<int>(local[i]));
        places.col(nodes.back()) = place_on(mesh, located, {unit[i][0], unit[i][1]});
      }
      own.shell_cells.push_back(cell);
    }
}

/// Nodes that cells of one shell have where their larger neighbour has none.
void add_hanging_nodes(const ShellBatch& batch, dealii::AffineConstraints<double>& ties) {
  if (batch.cells.n_levels() == 1) return;
  dealii::AffineConstraints<double> own;
  dealii::DoFTools::make_hanging_node_constraints(batch.nodes, own);
  const auto first = static_cast<dealii::types::global_dof_index>(batch.first_node);
  for (const auto& line : own.get_lines()) {
    ties.add_line(first + line.index);
    for (const auto& [master, share] : line.entries)
      ties.add_entry(first + line.index, first + master, share);
  }
}

}  // namespace

Space::~Space() = default;

namespace {

/// Where deal.II has one thread alone it takes over what is alike of the cell that it looked at
/// before, and rounds otherwise than with more of them. The last digit of a mass would depend on
/// the threads, and the motion of the block, whose error is controlled, in its fifth. Two threads
/// are more than it needs: those that do the work are ours.
void keep_rounding_from_threads() {
  static const bool once = [] {
    dealii::MultithreadInfo::set_thread_limit(2);
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace

Space::Space(const Mesh& mesh, const Resolution& resolution)
    : mesh_(&mesh), degree_(resolution.degree) {
  keep_rounding_from_threads();
  if (degree_ < 1 || degree_ > 4)
    throw ModelError(fmt::format("elements of degree {} are asked for; 1 to 4 exist", degree_));
  check_mesh(mesh);
  is_facet_ = find_facets(mesh);
  implementation_ = std::make_unique<Implementation>(degree_);
  node_of_vertex_.assign(mesh.vertices.size(), -1);
  nodes_.resize(3, 0);
  if (!mesh.shells.empty()) make_shells(resolution);
  if (!mesh.beams.empty()) make_beams(resolution);
  if (!mesh.solids.empty()) make_solids();
  make_free_nodes();
  number_unknowns();
}

void Space::make_shells(const Resolution& resolution) {
  Implementation& own = *implementation_;
  own.shell_order = lexicographic_order(own.shell_element);
  own.shell_batches = make_shell_batches(*mesh_);
  std::vector<int> first_cells;
  for (const auto& batch : own.shell_batches) {
    if (resolution.largest_edge) divide_shells(*mesh_, resolution.largest_edge, *batch);
    batch->first_cell = static_cast<int>(shells_.size());
    first_cells.push_back(batch->first_cell);
    for (const auto& cell : batch->cells.active_cell_iterators())
      shells_.push_back(locate(*batch, cell));
  }
  const int order = std::min(geometry_order(*mesh_), degree_);
  const dealii::FE_Q<2, 3> geometry(static_cast<unsigned>(order));
  std::vector<ShellMapping::Points> points(shells_.size());
  for (std::size_t cell = 0; cell < shells_.size(); ++cell)
    for (const Point<2>& xi : geometry.get_unit_support_points())
      points[cell].push_back(to_point(place_on(*mesh_, shells_[cell], {xi[0], xi[1]})));
  own.shell_mapping =
      std::make_unique<ShellMapping>(order, std::move(first_cells), std::move(points));
  make_shell_nodes(*mesh_, shells_, own, nodes_, shell_nodes_);
}

void Space::make_beams(const Resolution& resolution) {
  Implementation& own = *implementation_;
  create_beams(*mesh_, own.beams);
  const auto size_at = [&](const Vector3& place) {
    return resolution.largest_edge ? resolution.largest_edge(place)
                                   : std::numeric_limits<double>::infinity();
  };
  const auto locate_beam = [&](const auto& cell) {
    BeamCell located;
    const dealii::CellId id = cell->id();
    located.beam = static_cast<int>(id.get_coarse_cell_id());
    for (const auto child : id.get_child_indices()) {
      located.size /= 2;
      located.origin += located.size * child;
    }
    return located;
  };
  const BeamLines lines(*mesh_);
  const auto point_on = [&](const BeamCell& cell, double xi) -> Vector3 {
    return lines.point_at(mesh_->beams[cell.beam], cell.origin + cell.size * xi).place;
  };
  const auto edges = edges_of_shells(*mesh_);
  const auto is_on_edge = [&](const BeamCell& cell) {
    const auto& ends = mesh_->beams[cell.beam].vertices;
    return std::binary_search(edges.begin(), edges.end(),
                              std::pair<int, int>(std::minmax(ends[0], ends[1])));
  };
  const auto is_lone_rod = [&](const BeamCell& cell) {
    return mesh_->beams[cell.beam].is_rod && !is_on_edge(cell);
  };
  for (int round = 0; round < most_divisions; ++round) {
    bool is_any = false;
    for (const auto& cell : own.beams.active_cell_iterators()) {
      const BeamCell located = locate_beam(cell);
      if (is_lone_rod(located) || (point_on(located, 1) - point_on(located, 0)).norm() <=
                                      (1 + 1e-9) * size_at(point_on(located, 0.5)))
        continue;
      cell->set_refine_flag();
      is_any = true;
    }
    if (!is_any) break;
    own.beams.execute_coarsening_and_refinement();
  }

  // A beam along a shell's edge bends with it; one that stands alone has the exact moments of even
  // loads with degree 3, and a rod, which nothing would hold between its ends, degree 1.
  own.beam_elements.push_back(dealii::FE_Q<1, 3>(static_cast<unsigned>(degree_)));
  own.beam_elements.push_back(dealii::FE_Q<1, 3>(static_cast<unsigned>(std::max(degree_, 3))));
  own.beam_nodes.reinit(own.beams);
  own.beam_elements.push_back(dealii::FE_Q<1, 3>(1));
  for (const auto& cell : own.beam_nodes.active_cell_iterators()) {
    const BeamCell located = locate_beam(cell);
    cell->set_active_fe_index(is_lone_rod(located) ? 2 : is_on_edge(located) ? 0 : 1);
  }
  own.beam_nodes.distribute_dofs(own.beam_elements);
  const int first = node_count();
  nodes_.conservativeResize(Eigen::NoChange,
                            first + static_cast<Eigen::Index>(own.beam_nodes.n_dofs()));
  for (const auto& cell : own.beam_nodes.active_cell_iterators()) {
    BeamCell located = locate_beam(cell);
    located.degree = static_cast<int>(cell->get_fe().degree);
    std::vector<dealii::types::global_dof_index> local(at(located.degree) + 1);
    cell->get_dof_indices(local);
    // deal.II has the ends first.
    std::rotate(local.begin() + 1, local.begin() + 2, local.end());
    const std::vector<double> places = lagrange_places(located.degree);
    for (std::size_t i = 0; i < local.size(); ++i) {
      located.nodes.push_back(first + static_cast<int>(local[i]));
      nodes_.col(located.nodes.back()) = point_on(located, places[i]);
    }
    beams_.push_back(std::move(located));
  }
}

// Each vertex of a solid is a node of its own; what else ends there is tied to it along the edges.
void Space::make_solids() {
  std::map<int, int> node_of;
  for (const Solid& solid : mesh_->solids) {
    solid_start_.push_back(static_cast<int>(solid_nodes_.size()));
    for (const int vertex : solid.vertices) {
      const int next = node_count() + static_cast<int>(node_of.size());
      solid_nodes_.push_back(node_of.try_emplace(vertex, next).first->second);
    }
  }
  const int first = node_count();
  nodes_.conservativeResize(Eigen::NoChange, first + static_cast<Eigen::Index>(node_of.size()));
  for (const auto& [vertex, node] : node_of) {
    nodes_.col(node) = mesh_->vertices[vertex];
    node_of_vertex_[vertex] = node;
  }
}

// Vertices that no cell has, but links, masses or springs.
void Space::make_free_nodes() {
  std::vector<char> has_cell(mesh_->vertices.size(), 0);
  for (const Shell& shell : mesh_->shells)
    for (const int vertex : shell.vertices) has_cell[vertex] = 1;
  for (const Beam& beam : mesh_->beams)
    for (const int vertex : beam.vertices) has_cell[vertex] = 1;
  for (const Solid& solid : mesh_->solids)
    for (const int vertex : solid.vertices) has_cell[vertex] = 1;
  const auto want = [&](int vertex) {
    if (vertex < 0 || has_cell[vertex] != 0 || node_of_vertex_[vertex] >= 0) return;
    node_of_vertex_[vertex] = node_count();
    nodes_.conservativeResize(Eigen::NoChange, nodes_.cols() + 1);
    nodes_.col(nodes_.cols() - 1) = mesh_->vertices[vertex];
  };
  for_each_link(*mesh_, [&](const std::vector<int>& vertices, long) {
    for (const int vertex : vertices) want(vertex);
  });
  for (const PointMass& mass : mesh_->masses) want(mass.vertex);
  for (const Spring& spring : mesh_->springs)
    for (const int vertex : spring.vertices) want(vertex);
  for (const SurfacePoint& point : mesh_->surface_points) want(point.vertex);
}

Vector3 Space::place(int cell, const Eigen::Vector2d& xi) const {
  return place_on(*mesh_, shells_[cell], xi);
}

Eigen::VectorXd Space::shell_values(const Eigen::Vector2d& xi) const {
  const std::vector<double> x = lagrange_values(degree_, xi.x()),
                            y = lagrange_values(degree_, xi.y());
  Eigen::VectorXd values(nodes_per_shell());
  for (int j = 0; j <= degree_; ++j)
    for (int i = 0; i <= degree_; ++i) values[j * (degree_ + 1) + i] = x[i] * y[j];
  return values;
}

std::vector<int> Space::element_freedoms(int element) const {
  std::vector<int> freedoms;
  const auto take = [&](int node) {
    for (int c = 0; c < 6; ++c) freedoms.push_back(6 * node + c);
  };
  const int shells = static_cast<int>(shells_.size()), beams = static_cast<int>(beams_.size()),
            springs = static_cast<int>(mesh_->springs.size());
  if (element < shells) {
    for (int i = 0; i < nodes_per_shell(); ++i) take(shell_nodes(element)[i]);
  } else if (element < shells + beams) {
    for (const int node : beams_[element - shells].nodes) take(node);
  } else if (element < shells + beams + springs) {
    const Spring& spring = mesh_->springs[element - shells - beams];
    for (const int vertex : spring.vertices)
      if (vertex >= 0) take(node_of_vertex(vertex));
  } else {
    const int solid = element - shells - beams - springs;
    for (std::size_t i = 0; i < mesh_->solids[solid].vertices.size(); ++i)
      for (int c = 0; c < 3; ++c) freedoms.push_back(6 * solid_nodes(solid)[i] + c);
  }
  return freedoms;
}

void Space::number_unknowns() {
  const Implementation& own = *implementation_;
  std::vector<EdgeTrace> traces;
  TraceCollector collector(*this, traces);
  // Solids first: of edges of one length theirs is the polynomial that the others follow.
  for (std::size_t s = 0; s < mesh_->solids.size(); ++s) {
    const Solid& solid = mesh_->solids[s];
    const SolidTopology& topology = topology_of(solid.shape);
    const int* nodes = solid_nodes(static_cast<int>(s));
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const auto [from, to] = topology.edges[e];
      collector.add(solid.vertices[from], solid.vertices[to], 0, 1,
                    {nodes[from], nodes[at(topology.corners) + e], nodes[to]});
    }
  }
  for (const auto& batch : own.shell_batches) collector.collect(*batch);
  for (const BeamCell& cell : beams_) {
    const auto& ends = mesh_->beams[cell.beam].vertices;
    collector.add(ends[0], ends[1], cell.origin, cell.origin + cell.size, cell.nodes);
  }

  dealii::AffineConstraints<double> ties;
  for (const auto& batch : own.shell_batches) add_hanging_nodes(*batch, ties);
  for (const NodeTie& tie : find_joint_ties(node_count(), traces, node_of_vertex_)) {
    const auto node = static_cast<dealii::types::global_dof_index>(tie.node);
    ties.add_line(node);
    for (std::size_t i = 0; i < tie.masters.size(); ++i)
      ties.add_entry(node, static_cast<dealii::types::global_dof_index>(tie.masters[i]),
                     tie.weights[i]);
  }
  add_surface_ties(ties);
  ties.close();

  // Nodes of one place by the one that stands for them; those that follow others are left out.
  std::vector<NodeWithinEdge> within;
  if (!mesh_->rigid_links.empty())
    for_each_node_within_edges(*this, [&](int node, int from, int to, double) {
      const auto* entries =
          ties.get_constraint_entries(static_cast<dealii::types::global_dof_index>(node));
      if (entries && entries->size() > 1) return;
      within.push_back({entries ? static_cast<int>(entries->front().first) : node, from, to});
    });
  std::map<int, FreedomTie> links;
  for (FreedomTie& tie : find_link_ties(*mesh_, node_of_vertex_, nodes_, within)) {
    // A link's slave may be tied to its neighbours: the node that they follow is the slave. A place
    // between a shell's nodes follows the shell, whose corners the link binds as well.
    const auto* entries =
        ties.get_constraint_entries(static_cast<dealii::types::global_dof_index>(tie.freedom / 6));
    if (entries && entries->size() > 1) continue;
    if (entries) tie.freedom = 6 * static_cast<int>(entries->front().first) + tie.freedom % 6;
    const int freedom = tie.freedom;
    links.emplace(freedom, std::move(tie));
  }

  // Freedoms as sums of free ones: nodes' ties first, then links, which may follow one another.
  std::vector<long> start{0};
  std::vector<Term> terms;
  std::function<void(int, double, int)> expand_freedom = [&](int freedom, double weight,
                                                             int depth) {
    if (depth > 50)
      throw ModelError("links or equations follow one another in a circle: one is of " +
                       describe_node(*mesh_, node_of_vertex_, nodes_, freedom / 6));
    const auto take = [&](int node, double share) {
      const int own_freedom = 6 * node + freedom % 6;
      const auto link = links.find(own_freedom);
      if (link == links.end()) {
        terms.push_back({own_freedom, weight * share});
        return;
      }
      for (std::size_t i = 0; i < link->second.masters.size(); ++i)
        expand_freedom(link->second.masters[i], weight * share * link->second.weights[i],
                       depth + 1);
    };
    const auto* entries =
        ties.get_constraint_entries(static_cast<dealii::types::global_dof_index>(freedom / 6));
    if (!entries) {
      take(freedom / 6, 1);
    } else {
      for (const auto& [master, share] : *entries) take(static_cast<int>(master), share);
    }
  };
  for (int freedom = 0; freedom < freedoms(); ++freedom) {
    expand_freedom(freedom, 1, 0);
    start.push_back(static_cast<long>(terms.size()));
  }

  std::vector<std::vector<int>> elements(at(element_count()));
  for (int e = 0; e < element_count(); ++e)
    for (const int freedom : element_freedoms(e))
      for (long t = start[freedom]; t < start[freedom + 1]; ++t)
        elements[e].push_back(terms[t].unknown);
  elimination_ = find_elimination(freedoms(), elements);
  unknowns_ = elimination_.count;

  // Without stiffness nothing moves.
  term_start_.assign(1, 0);
  for (int freedom = 0; freedom < freedoms(); ++freedom) {
    for (long t = start[freedom]; t < start[freedom + 1]; ++t) {
      const auto [of, weight] = terms[t];
      if (const int place = elimination_.place[of]; place >= 0)
        terms_.push_back({place, weight});
      else
        loose_parts_.push_back({freedom, of, weight});
    }
    term_start_.push_back(static_cast<long>(terms_.size()));
  }
}

Eigen::MatrixXd Space::expand(const Eigen::MatrixXd& unknowns) const {
  Eigen::MatrixXd motion = make_large(freedoms(), unknowns.cols());
  parallel::in_batches(static_cast<int>(unknowns.cols()), 1, 0, [&](int column, int) {
    for (int f = 0; f < freedoms(); ++f) {
      double sum = 0;
      for (const Term* term = begin_of(f); term != end_of(f); ++term)
        sum += term->weight * unknowns(term->unknown, column);
      motion(f, column) = sum;
    }
  });
  return motion;
}

Eigen::MatrixXd Space::reduce(const Eigen::MatrixXd& forces) const {
  Eigen::MatrixXd reduced = make_large(unknowns(), forces.cols());
  parallel::in_batches(static_cast<int>(forces.cols()), 1, 0, [&](int column, int) {
    reduced.col(column).setZero();
    for (int f = 0; f < freedoms(); ++f)
      if (const double force = forces(f, column); force != 0)
        for (const Term* term = begin_of(f); term != end_of(f); ++term)
          reduced(term->unknown, column) += term->weight * force;
  });
  return reduced;
}

}  // namespace blocklift::structure

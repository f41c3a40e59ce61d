#include "dynamics/marine/panels/panel_clusters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

namespace blocklift::dynamics {
namespace {

using Pair = std::pair<int, int>;

}  // namespace

std::vector<SharedEdge> find_shared_edges(const PanelMesh& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Panel& panel : mesh.panels) smallest = std::min(smallest, panel.diameter());
  // Vertices of neighbours are the same points, but for rounding.
  const double grain = 1e-5 * smallest;
  std::map<std::tuple<long, long, long>, int> vertices;
  const auto number_of = [&](const Vector3& p) {
    const auto cell = [&](double x) { return std::lround(x / grain); };
    return vertices
        .try_emplace({cell(p.x()), cell(p.y()), cell(p.z())}, static_cast<int>(vertices.size()))
        .first->second;
  };
  std::map<Pair, Pair> first_at;  // panel and side
  std::vector<SharedEdge> shared;
  for (int k = 0; k < mesh.size(); ++k) {
    const Panel& panel = mesh.panels[k];
    for (int v = 0; v < panel.vertex_count; ++v) {
      const Vector3& a = panel.vertices[v];
      const Vector3& b = panel.vertices[(v + 1) % panel.vertex_count];
      const int from = number_of(a), to = number_of(b);
      const auto [known, is_new] =
          first_at.try_emplace({std::min(from, to), std::max(from, to)}, Pair(k, v));
      if (is_new) continue;
      const auto [panel_before, side_before] = known->second;
      shared.push_back({{panel_before, k}, {side_before, v}, (b - a).norm()});
    }
  }
  return shared;
}

namespace {

constexpr double cos_45 = 0.70710678118654752;

bool may_meet(const Vector3& a, const Vector3& b) {
  return a.dot(b) > cos_45 * a.norm() * b.norm();
}

}  // namespace

std::vector<std::array<Beside, 4>> find_what_is_beside(const PanelMesh& mesh,
                                                       const std::vector<SharedEdge>& edges,
                                                       const Symmetry& planes) {
  const auto in_plane = [&](const Panel& panel, int side) {
    const double tolerance = 1e-6 * panel.diameter();
    const Vector3& a = panel.vertices[side];
    const Vector3& b = panel.vertices[(side + 1) % panel.vertex_count];
    return (planes.x && std::abs(a.x()) + std::abs(b.x()) < tolerance) ||
           (planes.y && std::abs(a.y()) + std::abs(b.y()) < tolerance);
  };
  std::vector<std::array<Beside, 4>> beside(mesh.panels.size());
  for (std::size_t k = 0; k < mesh.panels.size(); ++k) {
    beside[k].fill(Beside::edge);
    for (int side = 0; side < mesh.panels[k].vertex_count; ++side) {
      if (in_plane(mesh.panels[k], side)) beside[k][static_cast<std::size_t>(side)] = Beside::image;
    }
  }
  for (const SharedEdge& edge : edges) {
    if (!may_meet(mesh.panels[edge.panels.first].normal, mesh.panels[edge.panels.second].normal))
      continue;
    for (const auto& [panel, side] : {std::pair(edge.panels.first, edge.sides.first),
                                      std::pair(edge.panels.second, edge.sides.second)}) {
      if (beside[panel][side] != Beside::image) beside[panel][side] = Beside::panel;
    }
  }
  return beside;
}

namespace {

/// What a cluster covers.
struct Cover {
  Vector3 area = Vector3::Zero();  ///< sum of areas times normals, m2
  Eigen::AlignedBox3d box;
  std::vector<int> panels;
  bool at_edge = false;  ///< of the hull
};

std::vector<Cover> find_covers(const PanelMesh& mesh, const std::vector<SharedEdge>& edges,
                               const PanelClusters& clusters) {
  const auto beside = find_what_is_beside(mesh, edges, mesh.symmetry);
  std::vector<Cover> covers(static_cast<std::size_t>(clusters.count));
  for (std::size_t k = 0; k < mesh.panels.size(); ++k) {
    Cover& cover = covers[clusters.of_panel[k]];
    cover.area += mesh.panels[k].area * mesh.panels[k].normal;
    for (const Vector3& vertex : mesh.panels[k].vertices) cover.box.extend(vertex);
    cover.panels.push_back(static_cast<int>(k));
    for (std::size_t side = 0; static_cast<int>(side) < mesh.panels[k].vertex_count; ++side)
      cover.at_edge = cover.at_edge || beside[k][side] == Beside::edge;
  }
  return covers;
}

Cover merged(const Cover& a, const Cover& b) {
  Cover both{a.area + b.area, a.box.merged(b.box), a.panels, a.at_edge || b.at_edge};
  both.panels.insert(both.panels.end(), b.panels.begin(), b.panels.end());
  return both;
}

bool may_join(const Cover& a, const Cover& b, double largest) {
  return may_meet(a.area, b.area) && a.box.merged(b.box).diagonal().norm() <= largest;
}

/// What is left over must make a rectangle with the pair that it joins, or nearly: the middle of an
/// angle lies outside of it, and its equation would be another cluster's.
bool make_rectangle(const PanelMesh& mesh, const Cover& alone, const Cover& pair) {
  constexpr double filled = 0.9;
  const Vector3 area = alone.area + pair.area, normal = area.normalized();
  const Panel& panel = mesh.panels[alone.panels.front()];
  const Vector3 side = panel.vertices[1] - panel.vertices[0];
  const Vector3 e_1 = (side - normal * normal.dot(side)).normalized(), e_2 = normal.cross(e_1);
  Eigen::AlignedBox2d box;
  for (const Cover* cover : {&alone, &pair}) {
    for (const int k : cover->panels) {
      for (const Vector3& vertex : mesh.panels[k].vertices)
        box.extend(Eigen::Vector2d(e_1.dot(vertex), e_2.dot(vertex)));
    }
  }
  return area.norm() >= filled * box.volume();
}

/// Clusters that may be joined, and the length of the edges that they share, m.
using Neighbours = std::pair<Pair, double>;

/// Those that share the longest edges come first; of edges as long as each other, but for what
/// files round, those of the first panels: a row is joined from its beginning, and an even one
/// leaves none over.
std::vector<Neighbours> find_neighbours(const std::vector<SharedEdge>& edges, double largest,
                                        const PanelClusters& clusters,
                                        const std::vector<Cover>& covers) {
  constexpr double equal = 0.99;
  std::map<Pair, double> common;
  for (const SharedEdge& edge : edges) {
    const int a = clusters.of_panel[edge.panels.first];
    const int b = clusters.of_panel[edge.panels.second];
    if (a != b) common[{std::min(a, b), std::max(a, b)}] += edge.length;
  }
  std::vector<Neighbours> ordered;
  for (const auto& [pair, length] : common) {
    if (may_join(covers[pair.first], covers[pair.second], largest))
      ordered.emplace_back(pair, length);
  }
  std::ranges::stable_sort(ordered, std::ranges::greater{}, &Neighbours::second);
  for (auto first = ordered.begin(); first != ordered.end();) {
    const auto end = std::find_if(first, ordered.end(), [&](const Neighbours& neighbours) {
      return neighbours.second < equal * first->second;
    });
    std::sort(first, end, [](const auto& a, const auto& b) { return a.first < b.first; });
    first = end;
  }
  return ordered;
}

/// Joins neighbouring clusters two by two, those first that share the longest edges.
void join_pairs(const PanelMesh& mesh, const std::vector<SharedEdge>& edges, double largest,
                LeftOver left_over, PanelClusters& clusters) {
  const std::vector<Cover> covers = find_covers(mesh, edges, clusters);
  const std::vector<Neighbours> ordered = find_neighbours(edges, largest, clusters, covers);
  std::vector<int> renamed(covers.size(), -1);
  int count = 0;
  std::vector<Cover> joined;
  for (const auto& [pair, length] : ordered) {
    const auto [a, b] = pair;
    if (renamed[a] >= 0 || renamed[b] >= 0) continue;
    renamed[a] = renamed[b] = count++;
    joined.push_back(merged(covers[a], covers[b]));
  }
  std::vector<bool> full(joined.size(), left_over == LeftOver::stays);
  for (const auto& [pair, length] : ordered) {
    auto alone = static_cast<std::size_t>(pair.first);
    auto other = static_cast<std::size_t>(pair.second);
    if (renamed[alone] >= 0) std::swap(alone, other);
    if (renamed[alone] >= 0 || renamed[other] < 0) continue;
    const auto cluster = static_cast<std::size_t>(renamed[other]);
    if (full[cluster] || !covers[alone].at_edge ||
        !may_join(covers[alone], joined[cluster], largest) ||
        !make_rectangle(mesh, covers[alone], joined[cluster]))
      continue;
    renamed[alone] = renamed[other];
    full[cluster] = true;
  }
  for (int& name : renamed) {
    if (name < 0) name = count++;
  }
  for (int& cluster : clusters.of_panel) cluster = renamed[cluster];
  clusters.count = count;
}

}  // namespace

Eigen::MatrixXd PanelClusters::average(const Eigen::VectorXd& areas,
                                       const Eigen::MatrixXd& values) const {
  const Eigen::VectorXd whole = sum(areas);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, values.cols());
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    for (Eigen::Index k = 0; k < values.rows(); ++k) {
      const int cluster = of_panel[k];
      result(cluster, column) += areas[k] / whole[cluster] * values(k, column);
    }
  }
  return result;
}

Eigen::VectorXd PanelClusters::sum(const Eigen::VectorXd& values) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    result[of_panel[k]] += values[k];
  }
  return result;
}

Eigen::MatrixXd PanelClusters::sum_columns(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(values.rows(), count);
  for (Eigen::Index k = 0; k < values.cols(); ++k) result.col(of_panel[k]) += values.col(k);
  return result;
}

Eigen::MatrixXcd PanelClusters::spread(const Eigen::MatrixXcd& values) const {
  return values(of_panel, Eigen::all);
}

namespace {

template <class Matrix>
Matrix coarsen_matrix(const Matrix& matrix, const PanelClusters& rows,
                      const Eigen::VectorXd& row_areas, const PanelClusters& columns) {
  using Real = typename Matrix::Scalar;
  if (matrix.size() == 0) return {};
  const Eigen::VectorXd whole = rows.sum(row_areas);
  const Eigen::VectorXd shares = row_areas.cwiseQuotient(whole(rows.of_panel));
  const auto share = shares.cast<Real>().eval();
  Matrix result = Matrix::Zero(rows.count, columns.count);
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    Real* const to = result.col(columns.of_panel[column]).data();
    const Real* const from = matrix.col(column).data();
    for (Eigen::Index k = 0; k < matrix.rows(); ++k) to[rows.of_panel[k]] += share[k] * from[k];
  }
  return result;
}

}  // namespace

Eigen::MatrixXd PanelClusters::coarsen(const Eigen::MatrixXd& matrix, const PanelClusters& rows,
                                       const Eigen::VectorXd& row_areas,
                                       const PanelClusters& columns) {
  return coarsen_matrix(matrix, rows, row_areas, columns);
}

Eigen::MatrixXf PanelClusters::coarsen(const Eigen::MatrixXf& matrix, const PanelClusters& rows,
                                       const Eigen::VectorXd& row_areas,
                                       const PanelClusters& columns) {
  return coarsen_matrix(matrix, rows, row_areas, columns);
}

PanelClusters cluster_panels(const PanelMesh& mesh, double largest, LeftOver left_over) {
  PanelClusters clusters;
  clusters.count = mesh.size();
  for (int k = 0; k < mesh.size(); ++k) clusters.of_panel.push_back(k);
  const std::vector<SharedEdge> edges = find_shared_edges(mesh);
  join_pairs(mesh, edges, largest, LeftOver::stays, clusters);
  join_pairs(mesh, edges, largest, left_over, clusters);
  return clusters;
}

Eigen::VectorXd error_of_panels(const Eigen::VectorXd& changes, const PanelClusters& clusters) {
  const auto panels = static_cast<double>(clusters.of_panel.size());
  const double ratio = std::min(2.0, std::sqrt(panels / clusters.count));
  if (!(ratio > 1.0))
    return Eigen::VectorXd::Constant(changes.size(), std::numeric_limits<double>::infinity());
  return caution_with_panels * changes / (ratio - 1.0);
}

FlatClusters find_flat_clusters(const PanelMesh& mesh, const PanelClusters& clusters) {
  constexpr double flat = 1e-4, off_edges = 1e-4;
  std::vector<std::vector<int>> members(static_cast<std::size_t>(clusters.count));
  for (int k = 0; k < mesh.size(); ++k) members[clusters.of_panel[k]].push_back(k);
  FlatClusters result;
  result.of_panel.assign(mesh.panels.size(), -1);
  for (int cluster = 0; cluster < clusters.count; ++cluster) {
    const std::vector<int>& panels = members[cluster];
    if (panels.size() < 2) continue;
    const Panel& first = mesh.panels[panels.front()];
    double area = 0.0;
    Vector3 middle = Vector3::Zero();
    bool in_plane = true;
    for (const int k : panels) {
      const Panel& panel = mesh.panels[k];
      area += panel.area;
      middle += panel.area * panel.centroid;
      in_plane =
          in_plane && (panel.normal - first.normal).norm() < flat &&
          std::abs(first.normal.dot(panel.centroid - first.centroid)) < flat * first.diameter();
    }
    if (!in_plane) continue;
    middle /= area;
    for (const int k : panels) result.of_panel[k] = static_cast<int>(result.clusters.size());
    result.clusters.push_back(cluster);
    result.middles.push_back(middle + off_edges * (first.centroid - middle));
  }
  return result;
}

CoarserPanels make_coarser_panels(const PanelMesh& bodies, const PanelMesh& surface,
                                  double largest) {
  PanelClusters of_bodies = cluster_panels(bodies);
  FlatClusters flat = find_flat_clusters(bodies, of_bodies);
  return {std::move(of_bodies), std::move(flat), cluster_panels(surface, largest, LeftOver::stays)};
}

}  // namespace blocklift::dynamics

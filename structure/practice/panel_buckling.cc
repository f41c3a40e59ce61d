#include "structure/practice/panel_buckling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <Eigen/Dense>

#include "structure/batches.h"
#include "structure/index.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

constexpr Eigen::Index rows_per_panel = 5;

using FaceKey = std::array<int, 4>;

struct FaceOfCell {
  int cell = 0;
  int face = 0;
};

/// Cells at each face, by its vertices in order.
std::map<FaceKey, std::vector<FaceOfCell>> find_faces(const HexMesh& mesh) {
  std::map<FaceKey, std::vector<FaceOfCell>> faces;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (int face = 0; face < 6; ++face) {
      FaceKey key{};
      for (std::size_t i = 0; i < 4; ++i)
        key[i] = mesh.cells[at(cell)][at(cell_faces[at(face)][i])];
      std::sort(key.begin(), key.end());
      faces[key].push_back({cell, face});
    }
  return faces;
}

/// Box that holds some cells, m.
struct Bounds {
  Vector3 lower = Vector3::Constant(1e300);
  Vector3 upper = Vector3::Constant(-1e300);
};

Bounds bounds_of(const HexMesh& mesh, const std::vector<int>& cells) {
  Bounds bounds;
  for (const int cell : cells)
    for (const int vertex : mesh.cells[at(cell)]) {
      bounds.lower = bounds.lower.cwiseMin(mesh.vertices[at(vertex)]);
      bounds.upper = bounds.upper.cwiseMax(mesh.vertices[at(vertex)]);
    }
  return bounds;
}

/// A panel but for its edges: named after the single plate that has most of its volume, as thick as the
/// thinnest plate that has a tenth of it.
Panel describe(const BlockMesh& mesh, const std::vector<int>& cells, const Bounds& bounds) {
  Panel panel;
  panel.normal = mesh.cell_normal[at(cells[0])];
  panel.material = mesh.groups[at(mesh.cell_group[at(cells[0])])].material;
  const int u = (panel.normal + 1) % 3, v = (panel.normal + 2) % 3;
  double volume = 0;
  std::map<int, double> of_sheet;  // volume
  for (const int cell : cells) {
    const double own = jacobian(mesh, cell, Vector3::Constant(0.5)).determinant();
    panel.centre_B += own * position(mesh, cell, Vector3::Constant(0.5));
    volume += own;
    of_sheet[mesh.cell_sheet[at(cell)]] += own;
  }
  panel.centre_B /= volume;
  panel.size = {bounds.upper[u] - bounds.lower[u], bounds.upper[v] - bounds.lower[v], 1e300};
  int owner = of_sheet.begin()->first;
  for (const auto& [sheet, own] : of_sheet) {
    if (own > of_sheet[owner]) owner = sheet;
    if (own > 0.1 * volume)
      panel.size.thickness = std::min(panel.size.thickness, mesh.sheet_thickness[at(sheet)]);
  }
  panel.plate = mesh.sheet_names[at(owner)];
  for (const int cell : cells)
    if (mesh.cell_sheet[at(cell)] == owner)
      panel.group = mesh.groups[at(mesh.cell_group[at(cell)])].name;
  return panel;
}

/// Edges of the bounding rectangle near which no column of crossing plates holds the panel over half of
/// their length. (A pad's layers may reach past the column a little.)
FreeEdges find_free_edges(const BlockMesh& mesh, const std::vector<int>& cells,
                          const Bounds& bounds, const std::map<int, std::vector<int>>& held_faces,
                          const Panel& panel) {
  const int u = (panel.normal + 1) % 3, v = (panel.normal + 2) % 3;
  constexpr double near_edge = 0.05;  // of the panel's side
  // Lengths by their place along the edge, for the lower and upper edge across u and across v.
  std::array<std::array<std::map<long, double>, 2>, 2> held;
  for (const int cell : cells) {
    const auto found = held_faces.find(cell);
    if (found == held_faces.end()) continue;
    const Eigen::Matrix3d edges = jacobian(mesh, cell, Vector3::Constant(0.5));
    const Vector3 middle = position(mesh, cell, Vector3::Constant(0.5));
    for (const int face : found->second) {
      const int across = face / 2;
      if (across == panel.normal) continue;
      const int along = across == u ? v : u;
      const int vertex = mesh.cells[at(cell)][at(cell_faces[at(face)][0])];
      const double end = face % 2 == 0 ? bounds.lower[across] : bounds.upper[across];
      const double side = bounds.upper[across] - bounds.lower[across];
      if (std::abs(mesh.vertices[at(vertex)][across] - end) < near_edge * side)
        held[across == u ? 0 : 1][at(face % 2)][std::lround(middle[along] * 1e4)] =
            edges.col(along).norm();
    }
  }
  const auto is_free = [](const std::map<long, double>& lengths, double side) {
    double sum = 0;
    for (const auto& [place, length] : lengths) sum += length;
    return sum < side / 2 ? 1 : 0;
  };
  FreeEdges result;
  for (std::size_t end = 0; end < 2; ++end) {
    result.along_b += is_free(held[0][end], panel.size.b);
    result.along_a += is_free(held[1][end], panel.size.a);
  }
  return result;
}

/// Factor by which a stress that falls from 1 to psi across the width raises the coefficient.
double gradient_factor(double psi, bool is_wide) {
  const double least = is_wide ? 0 : -1;
  psi = std::clamp(psi, least, 1.0);
  return psi >= 0 ? 2.1 / (psi + 1.1) : (7.6 - 6.4 * psi + 10 * psi * psi) / 4;
}

/// Compression at the more compressed edge, Pa, and the ratio of the other edge's to it.
struct Compression {
  double largest = 0;
  double psi = 1;
};

Compression compression_of(double mean, double gradient) {
  const double larger = -mean + std::abs(gradient), smaller = -mean - std::abs(gradient);
  if (larger <= 0) return {};
  return {larger, smaller / larger};
}

/// What a direction has in the utilisation: demand over elastic and over critical stress.
struct Share {
  double elastic = 0, critical = 0;
};

Share share_of(double demand, double elastic, double yield) {
  return {demand / elastic, demand / johnson_ostenfeld(elastic, yield)};
}

/// The most compressed of `fields` fields that divide a side over which a stress varies linearly.
void take_field(double& mean, double& gradient, int fields) {
  mean -= std::abs(gradient) * (1 - 1.0 / fields);
  gradient /= fields;
}

/// Integrals over a cell: rows 0 to 2 of d u / d x, 3 to 5 of the same times (x_u - c_u), 6 to 8 times
/// (x_v - c_v), by the nodes' displacements; c the panel's centre.
Eigen::MatrixXd cell_integrals(const ElasticModel& model, int cell, int normal,
                               const Vector3& centre, const Eigen::Matrix4Xd& rule,
                               const Eigen::MatrixXd& gradients) {
  const HexMesh& mesh = model.mesh();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(9, gradients.cols());
  for (Eigen::Index q = 0; q < rule.cols(); ++q) {
    const Vector3 xi = rule.col(q).head<3>();
    const Eigen::Matrix3d j = jacobian(mesh, cell, xi);
    const Eigen::MatrixXd by_place =
        rule(3, q) * j.determinant() * j.inverse().transpose() * gradients.middleRows<3>(3 * q);
    const Vector3 off = position(mesh, cell, xi) - centre;
    result.topRows<3>() += by_place;
    result.middleRows<3>(3) += off[(normal + 1) % 3] * by_place;
    result.bottomRows<3>() += off[(normal + 2) % 3] * by_place;
  }
  return result;
}

}  // namespace

double compression_coefficient(double length, double width, double psi, int free_edges) {
  const double ratio = width / length;
  if (free_edges == 1) return 0.425 + ratio * ratio;
  if (free_edges > 1) return ratio * ratio;
  double k = 1e300;
  const int most = static_cast<int>(std::ceil(length / width)) + 1;
  for (int m = 1; m <= most; ++m) k = std::min(k, std::pow(m * ratio + 1 / (m * ratio), 2));
  return k * gradient_factor(psi, length < width);
}

double shear_coefficient(double a, double b, bool free_edge) {
  const double ratio = std::min(a, b) / std::max(a, b);
  return (5.34 + 4 * ratio * ratio) * (free_edge ? 0.5 : 1);
}

double euler_stress(const Material& material, double thickness, double width) {
  const double nu = material.poisson_ratio;
  return std::numbers::pi * std::numbers::pi * material.youngs_modulus / (12 * (1 - nu * nu)) *
         std::pow(thickness / width, 2);
}

double johnson_ostenfeld(double elastic, double yield) {
  return elastic <= yield / 2 ? elastic : yield * (1 - yield / (4 * elastic));
}

BucklingUtilisation buckling_utilisation(const PanelSize& size, const FreeEdges& free,
                                         const Material& material, const PanelStress& stress) {
  const double a = size.a, b = size.b, t = size.thickness;
  const double yield = material.yield_stress;
  const auto compressed = [&](double mean, double gradient, double length, double width,
                              int free_edges) {
    const Compression c = compression_of(mean, gradient);
    const double k = compression_coefficient(length, width, c.psi, free_edges);
    return share_of(c.largest, k * euler_stress(material, t, width), yield);
  };
  const bool is_open = free.along_a + free.along_b > 0;
  const std::array<Share, 3> shares = {
      compressed(stress.s11, stress.s11_gradient, a, b, free.along_a),
      compressed(stress.s22, stress.s22_gradient, b, a, free.along_b),
      share_of(std::abs(stress.s12),
               shear_coefficient(a, b, is_open) * euler_stress(material, t, std::min(a, b)),
               yield / std::numbers::sqrt3)};
  BucklingUtilisation result;
  for (const Share& share : shares) {
    result.elastic += share.elastic * share.elastic;
    result.critical += share.critical * share.critical;
  }
  return {std::sqrt(result.elastic), std::sqrt(result.critical)};
}

BlockPanels::BlockPanels(const ElasticModel& model, const Eigen::MatrixXd& displacements,
                         const std::vector<PlateStiffening>& stiffening)
    : materials_(model.mesh().materials) {
  find_panels(model);
  find_edges(model);
  stiffen(stiffening);
  integrate(model, displacements);
}

// Cells of one direction that share a face belong together; columns where plates cross lie between
// panels, lugs are none.
void BlockPanels::find_panels(const ElasticModel& model) {
  const BlockMesh& mesh = model.mesh();
  std::vector<char> is_lug(mesh.groups.size(), 0);
  for (const LugRegion& lug : mesh.lugs) is_lug[at(lug.group)] = 1;
  std::vector<int> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int cell) {
    while (parent[at(cell)] != cell) cell = parent[at(cell)] = parent[at(parent[at(cell)])];
    return cell;
  };
  const auto counts = [&](int cell) {
    return mesh.cell_normal[at(cell)] >= 0 && is_lug[at(mesh.cell_group[at(cell)])] == 0;
  };
  for (const auto& [key, cells] : find_faces(mesh)) {
    if (cells.size() != 2 || !counts(cells[0].cell) || !counts(cells[1].cell)) continue;
    if (mesh.cell_normal[at(cells[0].cell)] == mesh.cell_normal[at(cells[1].cell)])
      parent[at(root(cells[0].cell))] = root(cells[1].cell);
  }
  std::map<int, int> panel_of_root;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (!counts(cell)) continue;
    const auto [found, is_new] =
        panel_of_root.try_emplace(root(cell), static_cast<int>(cells_.size()));
    if (is_new) cells_.emplace_back();
    cells_[at(found->second)].push_back(cell);
  }
}

void BlockPanels::find_edges(const ElasticModel& model) {
  const BlockMesh& mesh = model.mesh();
  std::map<int, std::vector<int>> held_faces;  // by cell
  for (const auto& [key, cells] : find_faces(mesh)) {
    if (cells.size() != 2) continue;
    if (mesh.cell_normal[at(cells[0].cell)] == mesh.cell_normal[at(cells[1].cell)]) continue;
    for (const FaceOfCell& one : cells) held_faces[one.cell].push_back(one.face);
  }
  for (const std::vector<int>& cells : cells_) {
    const Bounds bounds = bounds_of(mesh, cells);
    panels_.push_back(describe(mesh, cells, bounds));
    panels_.back().free = find_free_edges(mesh, cells, bounds, held_faces, panels_.back());
  }
}

void BlockPanels::stiffen(const std::vector<PlateStiffening>& stiffening) {
  for (const PlateStiffening& stiffeners : stiffening)
    for (Panel& panel : panels_) {
      if (panel.group != stiffeners.group || stiffeners.along == panel.normal) continue;
      const bool across_b = stiffeners.along == (panel.normal + 1) % 3;
      const double side = across_b ? panel.size.b : panel.size.a;
      (across_b ? panel.fields_b : panel.fields_a) =
          std::max(1, static_cast<int>(std::ceil(side / stiffeners.spacing - 1e-6)));
    }
}

void BlockPanels::integrate(const ElasticModel& model, const Eigen::MatrixXd& displacements) {
  const Discretisation& space = model.space();
  const Eigen::Matrix2Xd two = gauss_points(2), three = gauss_points(3);
  components_.setZero(rows_per_panel * static_cast<Eigen::Index>(panels_.size()),
                      displacements.cols());
  std::array<Eigen::Matrix4Xd, 3> rules;
  std::array<Eigen::MatrixXd, 3> gradients;
  for (int normal = 0; normal < 3; ++normal) {
    rules[at(normal)] = tensor_rule(normal == 0 ? two : three, normal == 1 ? two : three,
                                    normal == 2 ? two : three);
    gradients[at(normal)] = space.element.gradients(rules[at(normal)].topRows<3>());
  }
  const auto add = [&](int p, int cell, Eigen::Vector3d& weights) {
    const Panel& panel = panels_[at(p)];
    const int n = panel.normal, u = (n + 1) % 3, v = (n + 2) % 3;
    const Eigen::MatrixXd integrals =
        cell_integrals(model, cell, n, panel.centre_B, rules[at(n)], gradients[at(n)]);
    const Material& material = model.mesh().material_of_cell(cell);
    const Eigen::Index cases = displacements.cols();
    Eigen::MatrixXd local(space.nodes_per_cell, 3 * cases);
    for (int i = 0; i < space.nodes_per_cell; ++i)
      for (Eigen::Index m = 0; m < cases; ++m)
        local.block<1, 3>(i, 3 * m) =
            displacements.block<3, 1>(3 * space.node(cell, i), m).transpose();
    const Eigen::MatrixXd products = integrals * local;
    const auto stress = [&](Eigen::Index row, Eigen::Index m) {
      return stress_of_gradient(material, products.block<3, 3>(row, 3 * m).transpose());
    };
    for (Eigen::Index m = 0; m < cases; ++m) {
      auto column = components_.block<rows_per_panel, 1>(rows_per_panel * p, m);
      const Stress mean = stress(0, m);
      column[0] += mean[u];
      column[1] += mean[v];
      column[2] += mean[3 + u];
      column[3] += stress(6, m)[u];
      column[4] += stress(3, m)[v];
    }
    for (Eigen::Index q = 0; q < rules[at(n)].cols(); ++q) {
      const Vector3 xi = rules[at(n)].col(q).head<3>();
      const Vector3 off = position(model.mesh(), cell, xi) - panel.centre_B;
      weights += rules[at(n)](3, q) * jacobian(model.mesh(), cell, xi).determinant() *
                 Eigen::Vector3d(1, off[v] * off[v], off[u] * off[u]);
    }
  };
  in_batches(static_cast<int>(panels_.size()), 4, 0, [&](int first, int count) {
    for (int p = first; p < first + count; ++p) {
      Eigen::Vector3d weights = Eigen::Vector3d::Zero();  // volume and second moments
      for (const int cell : cells_[at(p)]) add(p, cell, weights);
      const PanelSize& size = panels_[at(p)].size;
      components_.middleRows<3>(rows_per_panel * p) /= weights[0];
      components_.row(rows_per_panel * p + 3) *= size.b / 2 / weights[1];
      components_.row(rows_per_panel * p + 4) *= size.a / 2 / weights[2];
    }
  });
}

std::vector<PanelStress> BlockPanels::stresses(const Eigen::VectorXd& factors) const {
  const Eigen::VectorXd all = components_ * factors;
  std::vector<PanelStress> result;
  for (Eigen::Index p = 0; p < all.size(); p += rows_per_panel)
    result.push_back({all[p], all[p + 1], all[p + 2], all[p + 3], all[p + 4]});
  return result;
}

BucklingUtilisation BlockPanels::utilisation(int panel, const PanelStress& stress) const {
  const Panel& of = panels_[at(panel)];
  PanelSize size = of.size;
  PanelStress field = stress;
  size.a /= of.fields_a;
  size.b /= of.fields_b;
  take_field(field.s11, field.s11_gradient, of.fields_b);
  take_field(field.s22, field.s22_gradient, of.fields_a);
  return buckling_utilisation(size, of.free, materials_[at(of.material)], field);
}

std::vector<BlockPanels::Worst> BlockPanels::find_worst(const Eigen::MatrixXd& factors,
                                                        int threads) const {
  std::vector<Worst> result(panels_.size());
  in_batches(static_cast<int>(panels_.size()), 8, threads, [&](int first, int count) {
    const Eigen::MatrixXd all =
        components_.middleRows(rows_per_panel * first, rows_per_panel * count) * factors;
    for (int p = 0; p < count; ++p)
      for (Eigen::Index t = 0; t < factors.cols(); ++t) {
        const auto s = all.block<rows_per_panel, 1>(rows_per_panel * p, t);
        const PanelStress stress{s[0], s[1], s[2], s[3], s[4]};
        const BucklingUtilisation found = utilisation(first + p, stress);
        Worst& worst = result[at(first + p)];
        if (found.critical > worst.utilisation.critical)
          worst = {found, stress, static_cast<int>(t)};
      }
  });
  return result;
}

}  // namespace blocklift::structure

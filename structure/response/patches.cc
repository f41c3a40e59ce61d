#include "structure/response/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include <Eigen/Dense>

#include "structure/index.h"

namespace blocklift::structure {

namespace {

// Start and end of the patches along an edge of a given length, as fractions of it.
std::vector<Interval> patch_intervals(double length, double size) {
  std::vector<Interval> intervals;
  if (length <= 5.5 * size) {
    const int count = std::max(1, static_cast<int>(std::lround(length / size)));
    for (int i = 0; i < count; ++i)
      intervals.push_back({static_cast<double>(i) / count, static_cast<double>(i + 1) / count});
    return intervals;
  }
  const double width = size / length;
  for (int i = 0; i < 5; ++i) {
    const double start = i * (1 - width) / 4;
    intervals.push_back({start, start + width});
  }
  return intervals;
}

// Layers of one plate over one rectangle of mesh lines.
struct Stack {
  std::vector<int> cells;
};

std::vector<Stack> find_stacks(const BlockMesh& mesh) {
  std::map<std::tuple<int, std::int64_t, std::int64_t>, Stack> stacks;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    const int normal = mesh.cell_normal[at(cell)];
    if (normal < 0) continue;
    const Vector3 centre = position(mesh, cell, Vector3::Constant(0.5));
    // Centres of the layers differ along the normal only; 0.1 mm keeps rectangles apart.
    stacks[{mesh.cell_sheet[at(cell)], std::llround(centre[(normal + 1) % 3] * 1e4),
            std::llround(centre[(normal + 2) % 3] * 1e4)}]
        .cells.push_back(cell);
  }
  std::vector<Stack> result;
  for (auto& entry : stacks) result.push_back(std::move(entry.second));
  return result;
}

// Mean displacement gradients over patches: rows 3 patch + a hold mean d N_i / d x_a times the
// cell's thickness; one such matrix for each shape of cell and direction of plate.
class PatchGradients {
 public:
  PatchGradients(const ElasticModel& model, double patch_size)
      : mesh_(model.mesh()), space_(model.space()), patch_size_(patch_size) {}

  struct Entry {
    Eigen::MatrixXd gradients;
    Eigen::Matrix3Xd centres;  // unit coordinates
    double thickness = 0;
  };

  const Entry& of(int cell) {
    const int shape = space_.cell_shape[at(cell)], normal = mesh_.cell_normal[at(cell)];
    const auto [entry, is_new] = known_.try_emplace({shape, normal});
    if (is_new) entry->second = make(cell, normal);
    return entry->second;
  }

 private:
  Entry make(int cell, int normal) const {
    const int u = (normal + 1) % 3, v = (normal + 2) % 3;
    const Eigen::Matrix3d edges = jacobian(mesh_, cell, Vector3::Constant(0.5));
    // Rounded, so that the layers of a stack are divided alike.
    const auto length = [&](int axis) { return std::round(edges(axis, axis) * 1e6) / 1e6; };
    const auto along_u = patch_intervals(length(u), patch_size_);
    const auto along_v = patch_intervals(length(v), patch_size_);
    const Eigen::Matrix2Xd two = gauss_points(2), three = gauss_points(3);
    Entry entry;
    entry.thickness = edges.col(normal).norm();
    const Eigen::Index count = static_cast<Eigen::Index>(along_u.size() * along_v.size());
    entry.gradients.setZero(3 * count, space_.nodes_per_cell);
    entry.centres.resize(3, count);
    Eigen::Index patch = 0;
    for (const Interval& iv : along_v)
      for (const Interval& iu : along_u) {
        std::array<Eigen::Matrix2Xd, 3> lines;
        const auto within = [&](const Interval& interval) {
          Eigen::Matrix2Xd line = two;
          line.row(0) =
              (interval.lower + (interval.upper - interval.lower) * two.row(0).array()).matrix();
          return line;
        };
        lines[at(u)] = within(iu);
        lines[at(v)] = within(iv);
        lines[at(normal)] = three;
        const Eigen::Matrix4Xd rule = tensor_rule(lines[0], lines[1], lines[2]);
        const Eigen::MatrixXd unit = space_.element.gradients(rule.topRows<3>());
        for (Eigen::Index q = 0; q < rule.cols(); ++q)
          entry.gradients.middleRows<3>(3 * patch) +=
              rule(3, q) * entry.thickness *
              jacobian(mesh_, cell, rule.col(q).head<3>()).inverse().transpose() *
              unit.middleRows<3>(3 * q);
        entry.centres(u, patch) = (iu.lower + iu.upper) / 2;
        entry.centres(v, patch) = (iv.lower + iv.upper) / 2;
        entry.centres(normal, patch) = 0.5;
        ++patch;
      }
    return entry;
  }

  const BlockMesh& mesh_;
  const Discretisation& space_;
  double patch_size_;
  std::map<std::pair<int, int>, Entry> known_;
};

}  // namespace

MembraneStress::MembraneStress(const ElasticModel& model, const Eigen::MatrixXd& displacements,
                               double patch_size) {
  const BlockMesh& mesh = model.mesh();
  const Discretisation& space = model.space();
  const Eigen::Index cases = displacements.cols();
  PatchGradients gradients(model, patch_size);
  const std::vector<Stack> stacks = find_stacks(mesh);

  for (const Stack& stack : stacks) {
    const int first = stack.cells.front();
    const auto& entry = gradients.of(first);
    Vector3 middle = Vector3::Zero();
    double thickness = 0;
    for (const int cell : stack.cells) {
      const double t = gradients.of(cell).thickness;
      middle += t * position(mesh, cell, Vector3::Constant(0.5));
      thickness += t;
    }
    const int normal = mesh.cell_normal[at(first)];
    for (Eigen::Index p = 0; p < entry.centres.cols(); ++p) {
      Vector3 centre = position(mesh, first, entry.centres.col(p));
      centre[normal] = middle[normal] / thickness;
      patches_.push_back({centre, mesh.cell_sheet[at(first)], mesh.cell_group[at(first)]});
    }
  }

  components_.setZero(static_cast<Eigen::Index>(3 * patches_.size()), cases);
  Eigen::MatrixXd local(space.nodes_per_cell, 3 * cases);  // column 3 m + a: u_a of case m
  Eigen::Index first_patch = 0;
  for (const Stack& stack : stacks) {
    double thickness = 0;
    for (const int cell : stack.cells) thickness += gradients.of(cell).thickness;
    Eigen::Index count = 0;
    for (const int cell : stack.cells) {
      const auto& entry = gradients.of(cell);
      count = entry.centres.cols();
      for (int i = 0; i < space.nodes_per_cell; ++i)
        for (Eigen::Index m = 0; m < cases; ++m)
          local.block<1, 3>(i, 3 * m) =
              displacements.block<3, 1>(3 * space.node(cell, i), m).transpose();
      const Eigen::MatrixXd by_place = entry.gradients * local;  // rows d/dx_a, times thickness
      const Material& material = mesh.material_of_cell(cell);
      const double lambda = material.lame_lambda() / thickness;
      const double mu = material.shear_modulus() / thickness;
      const int normal = mesh.cell_normal[at(cell)];
      const int u = (normal + 1) % 3, v = (normal + 2) % 3;
      for (Eigen::Index m = 0; m < cases; ++m)
        for (Eigen::Index p = 0; p < count; ++p) {
          const auto g = by_place.block<3, 3>(3 * p, 3 * m);  // (a, b): du_b / dx_a
          const double pressure = lambda * (g(0, 0) + g(1, 1) + g(2, 2));
          auto stress = components_.block<3, 1>(3 * (first_patch + p), m);
          stress[0] += pressure + 2 * mu * g(u, u);
          stress[1] += pressure + 2 * mu * g(v, v);
          stress[2] += mu * (g(u, v) + g(v, u));
        }
    }
    first_patch += count;
  }
}

Eigen::VectorXd MembraneStress::von_mises(const Eigen::VectorXd& factors) const {
  const Eigen::VectorXd stress = components_ * factors;
  Eigen::VectorXd result(stress.size() / 3);
  for (Eigen::Index p = 0; p < result.size(); ++p) {
    const double a = stress[3 * p], b = stress[3 * p + 1], c = stress[3 * p + 2];
    result[p] = std::sqrt(a * a - a * b + b * b + 3 * c * c);
  }
  return result;
}

}  // namespace blocklift::structure

#include "structure/part/part_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "structure/error.h"

namespace blocklift::structure {

namespace {

constexpr int corners = 4;

double mean_edge(const PartMesh& mesh, int element) {
  static constexpr std::array<std::pair<int, int>, 6> edges = {
      {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  const Eigen::Matrix3Xd places = mesh.places(element);
  double sum = 0;
  for (const auto& [a, b] : edges) sum += (places.col(a) - places.col(b)).norm();
  return sum / static_cast<double>(edges.size());
}

/// Factors r_i of all edges; ones without an aim for the field.
Eigen::VectorXd factors(const PartModel& model, const PartSolution& solution,
                        const RefinementAim& aim) {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(solution.squared_error.size());
  const double squared = solution.squared_error.sum();
  if (!aim.error || !(squared > 0)) return result;
  constexpr double safety = 0.9, smallest = 0.25;
  const double allowed = safety * *aim.error * std::sqrt(squared + 2 * solution.strain_energy);
  const double order = model.mesh.kind(model.mesh.solids.front()).order;
  double sum = 0;
  for (const double e2 : solution.squared_error) sum += std::pow(e2, 3 / (2 * order + 3));
  const double common = std::pow(allowed, 1 / order) * std::pow(sum, -1 / (2 * order));
  for (Eigen::Index i = 0; i < result.size(); ++i) {
    const double e2 = solution.squared_error[i];
    if (e2 > 0) result[i] = std::clamp(common * std::pow(e2, -1 / (2 * order + 3)), smallest, 1.0);
  }
  return result;
}

/// Edge of the solid whose middle is nearest to a place.
double edge_near(const PartMesh& mesh, const Vector3& place, const Eigen::VectorXd& edges) {
  double nearest = -1, edge = 0;
  for (std::size_t s = 0; s < mesh.solids.size(); ++s) {
    const double distance = (mesh.centre(mesh.solids[s]) - place).norm();
    if (nearest >= 0 && distance >= nearest) continue;
    nearest = distance;
    edge = edges[s];
  }
  return edge;
}

}  // namespace

bool takes_sizes(const PartMesh& mesh) {
  return mesh.meshed_here && std::all_of(mesh.solids.begin(), mesh.solids.end(), [&](int element) {
           return mesh.kind(element).corners == corners;
         });
}

SizeField find_sizes(const PartModel& model, const PartSolution& solution,
                     const RefinementAim& aim) {
  const PartMesh& mesh = model.mesh;
  if (!takes_sizes(mesh)) throw ModelError("only a geometry of tetrahedra can be meshed again");
  const auto solids = static_cast<Eigen::Index>(mesh.solids.size());
  const Eigen::VectorXd shares = factors(model, solution, aim);
  constexpr double none = std::numeric_limits<double>::infinity();
  Eigen::VectorXd edges(solids), sizes = Eigen::VectorXd::Constant(mesh.nodes.cols(), none);
  for (Eigen::Index s = 0; s < solids; ++s) {
    const int element = mesh.solids[s];
    edges[s] = mean_edge(mesh, element);
    for (int i = 0; i < corners; ++i) {
      double& size = sizes[mesh.node(element, i)];  // a mean would spare the solids at a sharp edge
      size = std::min(size, shares[s] * edges[s]);
    }
  }
  constexpr double growth = 0.3;
  for (const Vector3& place : aim.places) {
    const double there = edge_near(mesh, place, edges) / 2;
    for (Eigen::Index n = 0; n < mesh.nodes.cols(); ++n)
      sizes[n] = std::min(sizes[n], there + growth * (mesh.nodes.col(n) - place).norm());
  }
  SizeField field{Eigen::Matrix3Xd(3, corners * solids), Eigen::VectorXd(corners * solids)};
  for (Eigen::Index s = 0; s < solids; ++s)
    for (int i = 0; i < corners; ++i) {
      const int node = mesh.node(mesh.solids[s], i);
      field.places.col(corners * s + i) = mesh.nodes.col(node);
      field.sizes[corners * s + i] = sizes[node];
    }
  return field;
}

}  // namespace blocklift::structure

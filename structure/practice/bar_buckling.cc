#include "structure/practice/bar_buckling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <Eigen/Dense>

#include "structure/batches.h"
#include "structure/index.h"
#include "structure/response/beam_stress.h"

namespace blocklift::structure {

namespace {

const double most_kink = std::cos(5 * std::numbers::pi / 180);
constexpr std::array<double, 3> places_in_cell{0, 0.5, 1};

/// Piece of a bar: beams one behind the other, each with whether it is passed from its second
/// vertex to its first.
struct Chain {
  std::vector<std::pair<int, bool>> beams;
  int from = 0, to = 0;  ///< vertices
};

/// Finds the straight pieces of bars between what holds them.
class ChainFinder {
 public:
  explicit ChainFinder(const Mesh& mesh) : mesh_(mesh) {
    for (std::size_t s = 0; s < mesh.shells.size(); ++s)
      for (const int vertex : mesh.shells[s].vertices) add_cell(vertex, static_cast<int>(s));
    for (const SurfacePoint& point : mesh.surface_points) add_cell(point.vertex, point.shell);
    const auto shells = static_cast<int>(mesh.shells.size());
    for (std::size_t s = 0; s < mesh.solids.size(); ++s)
      for (const int vertex : mesh.solids[s].vertices)
        add_cell(vertex, shells + static_cast<int>(s));
    for_each_link(mesh, [&](const std::vector<int>& vertices, long) {
      held_.insert(vertices.begin(), vertices.end());
    });
    for (const Spring& spring : mesh.springs)
      held_.insert(spring.vertices.begin(), spring.vertices.end());
    for (const LiftingPoint& point : mesh.lifting_points) held_.insert(point.vertex);
    for (std::size_t b = 0; b < mesh.beams.size(); ++b)
      for (const int vertex : mesh.beams[b].vertices)
        beams_at_[vertex].push_back(static_cast<int>(b));
  }

  std::vector<Chain> chains() {
    std::vector<Chain> chains;
    std::vector<bool> done(mesh_.beams.size(), false);
    for (std::size_t b = 0; b < mesh_.beams.size(); ++b) {
      if (done[b]) continue;
      Chain chain{
          {{static_cast<int>(b), false}}, mesh_.beams[b].vertices[0], mesh_.beams[b].vertices[1]};
      while (extend(chain, done)) {
      }
      turn(chain);
      while (extend(chain, done)) {
      }
      turn(chain);
      for (const auto& [beam, reversed] : chain.beams) done[at(beam)] = true;
      if (!lies_on_a_cell(chain)) chains.push_back(std::move(chain));
    }
    return chains;
  }

  bool is_free(int vertex) const { return beams_at_.at(vertex).size() == 1 && !is_held(vertex); }

 private:
  void add_cell(int vertex, int cell) {
    std::vector<int>& cells = cells_at_[vertex];
    if (cells.empty() || cells.back() != cell) cells.push_back(cell);
  }

  bool is_held(int vertex) const { return cells_at_.contains(vertex) || held_.contains(vertex); }

  static void turn(Chain& chain) {
    std::reverse(chain.beams.begin(), chain.beams.end());
    for (auto& [beam, reversed] : chain.beams) reversed = !reversed;
    std::swap(chain.from, chain.to);
  }

  Vector3 direction(int beam, bool reversed) const {
    const auto& [a, b] = mesh_.beams[at(beam)].vertices;
    const Vector3 along = (mesh_.vertices[at(b)] - mesh_.vertices[at(a)]).normalized();
    return reversed ? Vector3(-along) : along;
  }

  /// By the next beam, where the bar goes on straight through a vertex that nothing else holds.
  bool extend(Chain& chain, const std::vector<bool>& done) const {
    const std::vector<int>& meeting = beams_at_.at(chain.to);
    if (meeting.size() != 2 || is_held(chain.to)) return false;
    const auto [last, last_reversed] = chain.beams.back();
    const int next = meeting[meeting[0] == last ? 1 : 0];
    if (next == last || done[at(next)] || !are_one_bar(last, next)) return false;
    const bool reversed = mesh_.beams[at(next)].vertices[1] == chain.to;
    const auto [first, first_reversed] = chain.beams.front();
    if (direction(first, first_reversed).dot(direction(next, reversed)) < most_kink) return false;
    if (has_hinge(last, last_reversed ? 0 : 1) || has_hinge(next, reversed ? 1 : 0)) return false;
    chain.beams.emplace_back(next, reversed);
    chain.to = mesh_.beams[at(next)].vertices[reversed ? 0 : 1];
    return chain.to != chain.from;
  }

  bool are_one_bar(int one, int other) const {
    const Beam &a = mesh_.beams[at(one)], &b = mesh_.beams[at(other)];
    return a.section == b.section && a.end_section < 0 && b.end_section < 0 &&
           std::abs(a.axis_2.dot(b.axis_2)) > most_kink;
  }

  bool has_hinge(int beam, std::size_t end) const {
    const BeamRelease& release = mesh_.beams[at(beam)].release[end];
    return std::find(release.begin(), release.end(), true) != release.end();
  }

  bool lies_on_a_cell(const Chain& chain) const {
    return std::any_of(chain.beams.begin(), chain.beams.end(), [&](const auto& beam) {
      const auto& [a, b] = mesh_.beams[at(beam.first)].vertices;
      const auto cells_a = cells_at_.find(a), cells_b = cells_at_.find(b);
      if (cells_a == cells_at_.end() || cells_b == cells_at_.end()) return false;
      return std::find_first_of(cells_a->second.begin(), cells_a->second.end(),
                                cells_b->second.begin(),
                                cells_b->second.end()) != cells_a->second.end();
    });
  }

  const Mesh& mesh_;
  std::map<int, std::vector<int>> cells_at_;  ///< shells and solids of a vertex
  std::map<int, std::vector<int>> beams_at_;
  std::set<int> held_;  ///< by links, springs and ropes
};

/// (M_2, M_3) = E law (k_2, k_3), m^4.
Eigen::Matrix2d bending_law(const BeamSection& section) {
  Eigen::Matrix2d law;
  law << section.second_moment_2, -section.product_23, -section.product_23, section.second_moment_3;
  return law;
}

/// Axes of bending of a section: columns (e_2, e_3) along which a curvature is about a principal
/// axis.
Eigen::Matrix2d principal_axes(const BeamSection& section) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(bending_law(section)).eigenvectors();
}

/// Takes what is smaller of a section into a column's figures.
void weaken(const BeamSection& section, const Eigen::Matrix2d& axes, Column& column) {
  const Eigen::Matrix2d law = bending_law(section);
  const auto smaller = [](double& value, double other) { value = std::min(value, other); };
  smaller(column.area, section.area);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d axis = axes.col(i);
    const double moment = axis.dot(law * axis);
    double outermost = 0;
    for (const Eigen::Vector2d& point : stress_points(section))
      outermost = std::max(outermost, std::abs(point.y() * axis.x() - point.x() * axis.y()));
    smaller(column.second_moments[at(i)], moment);
    smaller(column.section_moduli[at(i)], moment / outermost);
  }
}

Column column_of(const Mesh& mesh, const Chain& chain, const Eigen::Matrix2d& axes) {
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  const Beam& first = mesh.beams[at(chain.beams.front().first)];
  const Material& material = mesh.materials[at(mesh.section_of(first).material)];
  Column column;
  column.elastic_modulus = material.youngs_modulus;
  column.yield_stress = material.yield_stress;
  column.area = no_limit;
  column.second_moments = column.section_moduli = {no_limit, no_limit};
  weaken(mesh.section_of(first), axes, column);
  if (first.end_section >= 0) weaken(mesh.beam_sections[at(first.end_section)], axes, column);
  return column;
}

}  // namespace

BlockBars::BlockBars(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions) {
  const Mesh& mesh = model.mesh();
  const Space& space = model.space();
  std::map<int, std::vector<int>> cells_of_beam;
  for (std::size_t c = 0; c < space.beams().size(); ++c)
    cells_of_beam[space.beams()[c].beam].push_back(static_cast<int>(c));
  std::vector<Eigen::MatrixXd> blocks;
  Eigen::Index rows = 0;
  ChainFinder finder(mesh);
  for (const Chain& chain : finder.chains()) {
    const Beam& first = mesh.beams[at(chain.beams.front().first)];
    const Eigen::Matrix2d axes = principal_axes(mesh.section_of(first));
    Column column = column_of(mesh, chain, axes);
    if (!(std::min(column.second_moments[0], column.second_moments[1]) > 0)) {
      ++unknown_rods_;
      continue;
    }
    const auto length_of = [&](int beam) {
      const auto& [a, b] = mesh.beams[at(beam)].vertices;
      return (mesh.vertices[at(b)] - mesh.vertices[at(a)]).norm();
    };
    double length = 0, passed = 0;
    for (const auto& [beam, reversed] : chain.beams) length += length_of(beam);
    column.length = finder.is_free(chain.from) || finder.is_free(chain.to) ? 2 * length : length;
    std::vector<Station> stations;
    for (const auto& [beam, reversed] : chain.beams) {
      for (const int cell : cells_of_beam[beam]) {
        const BeamCell& located = space.beams()[at(cell)];
        for (const double xi : places_in_cell) {
          const Eigen::MatrixXd forces = beam_forces(space, cell, xi, motions);
          Eigen::MatrixXd block(3, motions.cols());
          block << forces.row(0), axes.transpose() * forces.bottomRows<2>();
          blocks.push_back(std::move(block));
          const double along = located.origin + located.size * xi;
          stations.push_back(
              {(passed + (reversed ? 1 - along : along) * length_of(beam)) / length, rows});
          rows += 3;
        }
      }
      passed += length_of(beam);
    }
    const Region& region = mesh.regions[at(first.region)];
    spans_.push_back({region.name, mesh.groups[at(region.group)].name,
                      mesh.vertices[at(chain.from)], mesh.vertices[at(chain.to)], column});
    stations_.push_back(std::move(stations));
  }
  forces_.resize(rows, motions.cols());
  for (std::size_t b = 0; b < blocks.size(); ++b)
    forces_.middleRows<3>(3 * static_cast<Eigen::Index>(b)) = blocks[b];
}

std::vector<BlockBars::Worst> BlockBars::find_worst(const Eigen::MatrixXd& factors, double factor,
                                                    int threads) const {
  std::vector<Worst> result(spans_.size());
  in_batches(static_cast<int>(spans_.size()), 1, threads, [&](int first, int count) {
    for (int s = first; s < first + count; ++s)
      for (const Station& station : stations_[at(s)]) {
        const Eigen::MatrixXd forces = forces_.middleRows<3>(station.row) * factors;
        for (Eigen::Index t = 0; t < forces.cols(); ++t) {
          const ColumnForces here{-forces(0, t), {forces(1, t), forces(2, t)}};
          const double utilisation = column_utilisation(spans_[at(s)].column, here, factor);
          if (utilisation > result[at(s)].utilisation)
            result[at(s)] = {utilisation, here, station.share, static_cast<int>(t)};
        }
      }
  });
  return result;
}

}  // namespace blocklift::structure

#include "structure/load_cases/deck_heat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/formulation/beam.h"
#include "structure/index.h"
#include "structure/load_cases/deck_solution.h"
#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Finds what one load case's temperatures are in the cells, and puts it into a column.
class RiseFinder {
 public:
  RiseFinder(const Mesh& mesh, const Deck& deck, const DeckLoadCase& load_case)
      : mesh_(mesh),
        deck_(deck),
        load_case_(load_case),
        field_(deck.temperatures[at(load_case.temperatures)]) {
    if (!field_.obstacle.empty()) refuse(field_.obstacle);
  }

  void fill_in(TemperatureRises& rises, Eigen::Index column) const {
    Column of_shells = rises.of_shells.col(column);
    fill_in_shells(of_shells);
    for (std::size_t b = 0; b < mesh_.beams.size(); ++b)
      fill_in_beam(static_cast<int>(b),
                   rises.of_beams.col(column).segment<TemperatureRises::rows_of_beam>(
                       TemperatureRises::rows_of_beam * static_cast<Eigen::Index>(b)));
    Eigen::Index first = 0;
    for (const Solid& solid : mesh_.solids) {
      const auto nodes = static_cast<Eigen::Index>(solid.vertices.size());
      fill_in_solid(solid, rises.of_solids.col(column).segment(first, nodes));
      first += nodes;
    }
  }

 private:
  using Column = Eigen::Ref<Eigen::VectorXd>;

  [[noreturn]] void refuse(const std::string& why) const {
    throw ModelError(
        fmt::format("{}: {} cannot be computed with: {}", name_of(load_case_), field_.name, why));
  }

  double given(int vertex) const { return field_.at_vertices[at(vertex)]; }

  double temperature(int vertex, const char* cell, long label) const {
    const double value = given(vertex);
    if (std::isnan(value)) {
      const auto& labels = mesh_.vertex_labels;
      refuse(fmt::format("node {} of {} {} has no temperature",
                         labels.empty() ? vertex + 1L : labels[at(vertex)], cell, label));
    }
    return value;
  }

  Eigen::Vector2d slopes(int vertex) const {
    return field_.slopes.empty() ? Eigen::Vector2d(0, 0) : field_.slopes[at(vertex)];
  }

  double reference(double of_material) const {
    return field_.counts_from_reference ? of_material : 0;
  }

  const MaterialExpansion& expansion_of(int material) const {
    const auto& known = deck_.expansions.of_materials;
    if (at(material) >= known.size())
      refuse(fmt::format("how material \"{}\" expands is not known",
                         mesh_.materials[at(material)].name));
    return known[at(material)];
  }

  /// What is not warmer needs no expansion.
  void require(const std::string& obstacle, const Eigen::Ref<const Eigen::VectorXd>& rises) const {
    if (!obstacle.empty() && !rises.isZero(0)) refuse(obstacle);
  }

  void fill_in_shells(Column& rises) const {
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const Shell& shell = mesh_.shells[s];
      const ShellSection& section = mesh_.section_of(shell);
      const MaterialExpansion& expansion = expansion_of(section.material);
      auto own = of_shell(rises, static_cast<int>(s));
      double from = expansion.reference;
      if (section.laminate >= 0)
        from = deck_.expansions.of_laminates[at(section.laminate)].reference;
      const auto explicitly = field_.shells.find(static_cast<int>(s));
      for (Eigen::Index i = 0; i < 4; ++i) {
        const int vertex = shell.vertices[at(i)];
        const double slope =
            explicitly != field_.shells.end() ? explicitly->second.slope : slopes(vertex)[0];
        const double mean =
            explicitly != field_.shells.end()
                ? explicitly->second.mean
                : temperature(vertex, "shell", shell.label) + section.offset * slope;
        own[i] = mean - reference(from);
        own[8 + i] = slope;
      }
    }
    for (const SurfacePoint& middle : deck_.shell_middles) fill_in_middle(middle, rises);
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const ShellSection& section = mesh_.section_of(mesh_.shells[s]);
      require(section.laminate >= 0 ? deck_.expansions.of_laminates[at(section.laminate)].obstacle
                                    : expansion_of(section.material).obstacle,
              of_shell(rises, static_cast<int>(s)));
    }
  }

  static Column of_shell(Column& rises, int shell) {
    return rises.segment(TemperatureRises::rows_of_shell * shell, TemperatureRises::rows_of_shell);
  }

  /// What the middle of a shell's edge has beyond the mean of the edge's ends.
  void fill_in_middle(const SurfacePoint& middle, Column& rises) const {
    if (field_.shells.contains(middle.shell) || std::isnan(given(middle.vertex))) return;
    const Shell& shell = mesh_.shells[at(middle.shell)];
    const bool is_along_xi = middle.xi.y() == 0 || middle.xi.y() == 1;
    const Eigen::Index row =
        is_along_xi ? (middle.xi.y() == 0 ? 4 : 5) : (middle.xi.x() == 0 ? 6 : 7);
    static constexpr std::array<std::array<std::size_t, 2>, 4> ends{
        {{0, 1}, {2, 3}, {0, 2}, {1, 3}}};
    const auto [from, to] = ends[at(row - 4)];
    const int a = shell.vertices[from], b = shell.vertices[to];
    const double slope = slopes(middle.vertex)[0] - (slopes(a)[0] + slopes(b)[0]) / 2;
    auto own = of_shell(rises, middle.shell);
    own[row] =
        given(middle.vertex) - (given(a) + given(b)) / 2 + mesh_.section_of(shell).offset * slope;
    own[8 + row] = slope;
  }

  void fill_in_beam(int b, Column rises) const {
    const Beam& beam = mesh_.beams[at(b)];
    const MaterialExpansion& expansion = expansion_of(mesh_.section_of(beam).material);
    const auto explicitly = field_.beams.find(b);
    const Eigen::Matrix3d axes = beam_axes(mesh_, beam);
    for (std::size_t end = 0; end < 2; ++end) {
      auto own = rises.segment<3>(3 * static_cast<Eigen::Index>(end));
      if (explicitly != field_.beams.end()) {
        own << explicitly->second.mean[end], explicitly->second.slopes[end];
      } else {
        const Eigen::Vector2d along = slopes(beam.vertices[end]);
        const Vector3 centroid = axes * beam.offset[end];
        own << temperature(beam.vertices[end], "beam", beam.label) + along[0] * centroid[2] +
                   along[1] * centroid[1],
            along;
      }
      own[0] -= reference(expansion.reference);
    }
    require(expansion.obstacle, rises);
  }

  void fill_in_solid(const Solid& solid, Column rises) const {
    const MaterialExpansion& expansion = expansion_of(solid.material);
    const SolidTopology& topology = topology_of(solid.shape);
    for (Eigen::Index i = 0; i < topology.corners; ++i)
      rises[i] =
          temperature(solid.vertices[at(i)], "solid", solid.label) - reference(expansion.reference);
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const Eigen::Index i = topology.corners + static_cast<Eigen::Index>(e);
      const int middle = solid.vertices[at(i)];
      const bool is_made = deck_.own_vertices > 0 && middle >= deck_.own_vertices;
      rises[i] = is_made || std::isnan(given(middle))
                     ? (rises[topology.edges[e][0]] + rises[topology.edges[e][1]]) / 2
                     : given(middle) - reference(expansion.reference);
    }
    require(expansion.obstacle, rises);
  }

  const Mesh& mesh_;
  const Deck& deck_;
  const DeckLoadCase& load_case_;
  const TemperatureField& field_;
};

}  // namespace

std::optional<CellHeat> heat_of(const ElasticModel& model, const Deck& deck,
                                const std::vector<int>& load_cases) {
  const bool is_any = std::any_of(load_cases.begin(), load_cases.end(), [&](int load_case) {
    return deck.load_cases[at(load_case)].temperatures >= 0;
  });
  if (!is_any) return std::nullopt;
  const Mesh& mesh = model.mesh();
  const auto columns = static_cast<Eigen::Index>(load_cases.size());
  Eigen::Index of_solids = 0;
  for (const Solid& solid : mesh.solids)
    of_solids += static_cast<Eigen::Index>(solid.vertices.size());
  TemperatureRises rises;
  rises.of_shells.setZero(
      TemperatureRises::rows_of_shell * static_cast<Eigen::Index>(mesh.shells.size()), columns);
  rises.of_beams.setZero(
      TemperatureRises::rows_of_beam * static_cast<Eigen::Index>(mesh.beams.size()), columns);
  rises.of_solids.setZero(of_solids, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const DeckLoadCase& load_case = deck.load_cases[at(load_cases[at(c)])];
    if (load_case.temperatures >= 0) RiseFinder(mesh, deck, load_case).fill_in(rises, c);
  }
  return CellHeat(model.space(), deck.expansions, std::move(rises));
}

}  // namespace blocklift::structure

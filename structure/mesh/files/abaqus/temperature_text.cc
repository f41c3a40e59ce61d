#include "structure/mesh/files/abaqus/temperature_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// Gives vertices between others, that have no temperature of their own, the mean of these.
class MeansBetween {
 public:
  explicit MeansBetween(std::vector<double>& values) : values_(values) {}

  void fill(int from, int to, int middle) {
    if (std::isnan(values_[at(middle)]))
      values_[at(middle)] = (values_[at(from)] + values_[at(to)]) / 2;
  }

 private:
  std::vector<double>& values_;
};

void fill_middles(const Mesh& mesh, const std::vector<std::vector<int>>& of_shells,
                  std::vector<double>& values) {
  MeansBetween means(values);
  for (std::size_t s = 0; s < of_shells.size(); ++s) {
    const auto& corners = mesh.shells[s].vertices;
    std::vector<int> around{corners[0], corners[1], corners[3]};
    if (!mesh.shells[s].is_triangle()) around.push_back(corners[2]);
    for (std::size_t i = 0; i < of_shells[s].size(); ++i)
      means.fill(around[i], around[(i + 1) % around.size()], of_shells[s][i]);
  }
  for (const Solid& solid : mesh.solids) {
    const SolidTopology& topology = topology_of(solid.shape);
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      means.fill(solid.vertices[at(topology.edges[e][0])], solid.vertices[at(topology.edges[e][1])],
                 solid.vertices[at(topology.corners) + e]);
  }
}

}  // namespace

AbaqusTemperatureText::AbaqusTemperatureText(const Deck& deck)
    : deck_(deck),
      is_any_(std::any_of(deck.load_cases.begin(), deck.load_cases.end(),
                          [](const DeckLoadCase& one) { return one.temperatures >= 0; })) {
  if (!is_any_) return;
  for (const Solid& solid : deck.mesh.solids)
    if (solid.elasticity >= 0)
      throw ModelError(fmt::format(
          "solid {} is hot and of a material that depends on the direction, whose expansion is not "
          "written here",
          solid.label));
}

double AbaqusTemperatureText::coefficient_of(int material) const {
  const auto& known = deck_.expansions.of_materials;
  const std::string& name = deck_.mesh.materials[at(material)].name;
  if (at(material) >= known.size())
    throw ModelError(fmt::format("how material \"{}\" expands is not known", name));
  if (!known[at(material)].obstacle.empty()) throw ModelError(known[at(material)].obstacle);
  return known[at(material)].coefficient;
}

std::string AbaqusTemperatureText::of_material(int material) const {
  return is_any_ ? fmt::format("*EXPANSION\n{:.12e},\n", coefficient_of(material)) : "";
}

std::string AbaqusTemperatureText::of_general_section(int material) const {
  return is_any_ ? fmt::format(", {:.12e}", coefficient_of(material)) : "";
}

std::string AbaqusTemperatureText::initial(const std::string& set) const {
  if (!is_any_) return {};
  return fmt::format("*INITIAL CONDITIONS, TYPE=TEMPERATURE\n{}, 0.\n", set);
}

double AbaqusTemperatureText::reference_of(const TemperatureField& field) const {
  if (!field.counts_from_reference) return 0;
  double reference = std::numeric_limits<double>::quiet_NaN();
  for (const MaterialExpansion& one : deck_.expansions.of_materials) {
    if (one.coefficient == 0) continue;
    if (!std::isnan(reference) && one.reference != reference)
      throw ModelError(fmt::format(
          "{}: materials expand from {} and {} degrees; temperatures of nodes are written from one",
          field.name, reference, one.reference));
    reference = one.reference;
  }
  return std::isnan(reference) ? 0 : reference;
}

std::string AbaqusTemperatureText::of_step(const DeckLoadCase& load_case,
                                           const std::vector<long>& labels,
                                           const std::vector<std::vector<int>>& middles) const {
  if (!is_any_) return {};
  std::string text = "*TEMPERATURE, OP=NEW\n";
  const Mesh& mesh = deck_.mesh;
  if (load_case.temperatures < 0) {
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      text += fmt::format("{}, 0.\n", labels[v]);
    return text;
  }
  const TemperatureField& field = deck_.temperatures[at(load_case.temperatures)];
  if (!field.obstacle.empty()) throw ModelError(field.name + ": " + field.obstacle);
  if (!field.shells.empty() || !field.beams.empty())
    throw ModelError(field.name + " has temperatures of elements, which are not written here");
  const double reference = reference_of(field);
  std::vector<double> values = field.at_vertices;
  values.resize(mesh.vertices.size(), std::numeric_limits<double>::quiet_NaN());
  if (deck_.own_vertices > 0)
    for (std::size_t v = at(deck_.own_vertices); v < values.size(); ++v)
      values[v] = std::numeric_limits<double>::quiet_NaN();
  fill_middles(mesh, middles, values);
  for (std::size_t v = 0; v < values.size(); ++v) {
    // One that nothing gives a temperature has the initial one.
    const double rise = std::isnan(values[v]) ? 0 : values[v] - reference;
    text += fmt::format("{}, {:.12e}", labels[v], rise);
    if (v < field.slopes.size() && !field.slopes[v].isZero(0))
      text += fmt::format(", {:.12e}, {:.12e}", field.slopes[v][0] * deck_.units.length,
                          field.slopes[v][1] * deck_.units.length);
    text += '\n';
  }
  return text;
}

}  // namespace blocklift::structure

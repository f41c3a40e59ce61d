#include "structure/mesh/files/deck/spread_mass.h"

#include <map>

#include <Eigen/LU>

#include "structure/mesh/mass_properties.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

template <typename Section>
int heavier_copy(int section, double mass, std::vector<Section>& sections, double Section::*figure,
                 std::map<int, int>& heavier) {
  const auto [found, is_new] = heavier.try_emplace(section, static_cast<int>(sections.size()));
  if (is_new) {
    Section copy = sections[section];
    copy.*figure += mass;
    sections.push_back(copy);
  }
  return found->second;
}

}  // namespace

void add_mass_per_area(Mesh& mesh, const std::vector<int>& shells, double mass) {
  std::map<int, int> heavier;
  for (const int s : shells) {
    int& section = mesh.shells[s].section;
    section =
        heavier_copy(section, mass, mesh.shell_sections, &ShellSection::mass_per_area, heavier);
  }
}

void add_mass_per_length(Mesh& mesh, const std::vector<int>& beams, double mass) {
  std::map<int, int> heavier;
  for (const int b : beams) {
    Beam& beam = mesh.beams[b];
    for (int* section : {&beam.section, &beam.end_section})
      if (*section >= 0)
        *section = heavier_copy(*section, mass, mesh.beam_sections, &BeamSection::mass_per_length,
                                heavier);
  }
}

void add_mass_to_solids(Mesh& mesh, const std::vector<int>& solids, double mass) {
  std::map<int, int> heavier;
  for (const int s : solids) {
    int& material = mesh.solids[s].material;
    const std::size_t known = mesh.materials.size();
    material = heavier_copy(material, mass, mesh.materials, &Material::density, heavier);
    if (mesh.materials.size() > known) mesh.materials.back().name += " with spread mass";
  }
}

double total_area(const Mesh& mesh, const std::vector<int>& shells) {
  double sum = 0;
  for (const int s : shells) sum += area(mesh, mesh.shells[s]);
  return sum;
}

double total_length(const Mesh& mesh, const std::vector<int>& beams) {
  double sum = 0;
  for (const int b : beams) {
    const auto& ends = mesh.beams[b].vertices;
    sum += (mesh.vertices[ends[1]] - mesh.vertices[ends[0]]).norm();
  }
  return sum;
}

double total_volume(const Mesh& mesh, const std::vector<int>& solids) {
  double sum = 0;
  for (const int s : solids) {
    const Solid& solid = mesh.solids[s];
    const ElementKind& kind = topology_of(solid.shape).kind;
    const Eigen::Matrix3Xd places = places_of(mesh, solid);
    for (Eigen::Index q = 0; q < kind.weights.size(); ++q) {
      const Eigen::Matrix3d jacobian = places * kind.gradients.middleRows<3>(3 * q).transpose();
      sum += kind.weights[q] * jacobian.determinant();
    }
  }
  return sum;
}

}  // namespace blocklift::structure

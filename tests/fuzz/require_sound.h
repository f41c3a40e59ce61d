#pragma once

#include <cmath>

#include "structure/mesh/files/deck/deck.h"
#include "tests/fuzz/input_file.h"

namespace blocklift::fuzz {

/// A deck that was accepted names vertices that exist, at places that are numbers, and has masses
/// that are numbers.
inline void require_sound(const structure::Deck& deck) {
  const structure::Mesh& mesh = deck.mesh;
  const auto count = static_cast<int>(mesh.vertices.size());
  const auto exists = [&](int vertex) { return vertex >= 0 && vertex < count; };
  for (const auto& vertex : mesh.vertices) require(vertex.allFinite());
  for (const structure::Shell& shell : mesh.shells)
    for (const int vertex : shell.vertices) require(exists(vertex));
  for (const structure::Beam& beam : mesh.beams)
    for (const int vertex : beam.vertices) require(exists(vertex));
  for (const structure::PointMass& mass : mesh.masses)
    require(exists(mass.vertex) && std::isfinite(mass.mass));
  for (const structure::Material& material : mesh.materials)
    require(std::isfinite(material.youngs_modulus) && std::isfinite(material.density));
  for (const structure::ShellSection& section : mesh.shell_sections)
    require(std::isfinite(section.thickness));
}

}  // namespace blocklift::fuzz

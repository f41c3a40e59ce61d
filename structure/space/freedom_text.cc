#include "structure/space/freedom_text.h"

#include <cmath>

#include <fmt/format.h>

namespace blocklift::structure {

std::string describe_freedom(const Space& space, int freedom) {
  const Vector3 place = space.nodes().col(freedom / 6);
  return fmt::format("at ({:.4g}, {:.4g}, {:.4g}) m, {} {}", place.x(), place.y(), place.z(),
                     freedom % 6 < 3 ? "displacement along" : "rotation about",
                     static_cast<char>('x' + freedom % 3));
}

std::string hint_at_torsion(const Mesh& mesh) {
  int count = 0;
  const Beam* first = nullptr;
  for (const Beam& beam : mesh.beams) {
    if (beam.is_rod || mesh.beam_sections[beam.section].torsion > 0) continue;
    if (++count == 1) first = &beam;
  }
  if (first == nullptr) return {};
  return fmt::format(
      " ({} {} no torsional stiffness, J of {}, element {} the first: is it left out?)", count,
      count == 1 ? "beam has" : "beams have", mesh.beam_sections[first->section].name,
      first->label);
}

int freedom_of(const Space& space, int unknown) {
  int found = 0;
  double largest = 0;
  for (int freedom = 0; freedom < space.freedoms(); ++freedom)
    for (const Space::Term* term = space.begin_of(freedom); term != space.end_of(freedom); ++term)
      if (term->unknown == unknown && std::abs(term->weight) > largest) {
        largest = std::abs(term->weight);
        found = freedom;
      }
  return found;
}

}  // namespace blocklift::structure

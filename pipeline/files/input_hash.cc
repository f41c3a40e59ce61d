#include "pipeline/files/input_hash.h"

#include "pipeline/formats/content_hash.h"

namespace blocklift::pipeline {
namespace {

void add(ContentHash& hash, const structure::Deck& deck) {
  for (const structure::Vector3& vertex : deck.mesh.vertices)
    hash.add(std::span<const double>(vertex.data(), 3));
  for (const structure::Shell& shell : deck.mesh.shells) {
    for (const int vertex : shell.vertices) hash.add(std::int64_t{vertex});
    hash.add(std::int64_t{shell.section});
  }
  for (const structure::Beam& beam : deck.mesh.beams) {
    for (const int vertex : beam.vertices) hash.add(std::int64_t{vertex});
    hash.add(std::int64_t{beam.section});
  }
  for (const structure::Solid& solid : deck.mesh.solids)
    for (const int vertex : solid.vertices) hash.add(std::int64_t{vertex});
}

}  // namespace

std::string hash_of_input(const LiftCase& lift_case) {
  ContentHash hash;
  hash.add(std::string_view(lift_case.yaml));
  for (const ModelText& model : lift_case.model_texts) hash.add(std::string_view(model.text));
  if (const auto& block = lift_case.load.model; block && block->mesh && block->mesh->deck) {
    add(hash, *block->mesh->deck);
    // Thicknesses and densities that another file includes.
    if (block->mesh->diagnosis) hash.add(block->mesh->diagnosis->mass.mass);
  }
  return hash.digits();
}

}  // namespace blocklift::pipeline

// Decks of Nastran: read, or refused with a ModelError that says where.
#include "structure/error.h"
#include "structure/mesh/files/nastran/reader.h"
#include "tests/fuzz/require_sound.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace blocklift;
  static const fuzz::InputFolder folder;
  const auto deck = folder.write("deck", fuzz::text_of(data, size));
  try {
    fuzz::require_sound(structure::read_nastran(deck, structure::unit_system("mm-t-N")));
  } catch (const structure::ModelError&) {
    // What is wrong was said.
  }
  return 0;
}

// Writes the double bottom block as a Nastran deck: generator FILE [cells between stiffeners].

#include <cstdlib>
#include <iostream>
#include <string>

#include "models/blocks/double-bottom-300t/generator.h"

#include "structure/mesh/files/nastran/writer.h"
#include "structure/mesh/mass_properties.h"

int main(int count, char** arguments) {
  if (count < 2) {
    std::cerr << "usage: " << arguments[0] << " FILE [CELLS]\n"
              << "writes the block as a Nastran deck with CELLS (2 to 6, else 4) shells between "
                 "stiffeners\n";
    return EXIT_FAILURE;
  }
  try {
    blocklift::models::DoubleBottomMeasures measures;
    if (count > 2) measures.cells_per_spacing = std::stoi(arguments[2]);
    const blocklift::structure::Deck deck = blocklift::models::make_double_bottom(measures);
    blocklift::structure::write_nastran(deck, arguments[1]);
    const auto mass = blocklift::structure::mass_properties(deck.mesh);
    std::cout << deck.mesh.shells.size() << " shells, " << deck.mesh.beams.size() << " beams, "
              << mass.mass / 1000 << " t, centre " << mass.centre.transpose() << " m\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

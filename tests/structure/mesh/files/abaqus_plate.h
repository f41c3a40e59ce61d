#pragma once

#include <string>

namespace blocklift::structure::test {

// A square plate of 2 x 2 m as a deck of Abaqus, and its parts.

inline const std::string abaqus_steel =
    "*MATERIAL, NAME=Steel\n*ELASTIC\n206.e9, .3\n*DENSITY\n7850.,\n";
inline const std::string abaqus_nodes =
    "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 2., 0.\n4, 0., 2., 0.\n";
inline const std::string abaqus_square_plate =
    abaqus_nodes + "*ELEMENT, TYPE=S4R, ELSET=Plate\n10, 1, 2, 3, 4\n" + abaqus_steel +
    "*SHELL SECTION, ELSET=Plate, MATERIAL=Steel\n.01, 5\n";

}  // namespace blocklift::structure::test

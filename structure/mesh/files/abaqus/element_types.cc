#include "structure/mesh/files/abaqus/element_types.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "structure/nearest_name.h"

namespace blocklift::structure {

const std::map<std::string, AbaqusElementType>& abaqus_element_types() {
  using Kind = AbaqusKind;
  static const std::map<std::string, AbaqusElementType> types{
      {"S3", {Kind::shell, 3, 3}},         {"S3R", {Kind::shell, 3, 3}},
      {"S3RS", {Kind::shell, 3, 3}},       {"STRI3", {Kind::shell, 3, 3}},
      {"S4", {Kind::shell, 4, 4}},         {"S4R", {Kind::shell, 4, 4}},
      {"S4RS", {Kind::shell, 4, 4}},       {"S4RSW", {Kind::shell, 4, 4}},
      {"S4R5", {Kind::shell, 4, 4}},       {"S6", {Kind::shell, 6, 6}},
      {"STRI65", {Kind::shell, 6, 6}},     {"S8", {Kind::shell, 8, 8}},
      {"S8R", {Kind::shell, 8, 8}},        {"S8R5", {Kind::shell, 8, 8}},
      {"CPS3", {Kind::shell, 3, 3}},       {"CPS4", {Kind::shell, 4, 4}},
      {"CPS4R", {Kind::shell, 4, 4}},      {"CPS6", {Kind::shell, 6, 6}},
      {"CPS8", {Kind::shell, 8, 8}},       {"CPS8R", {Kind::shell, 8, 8}},
      {"B31", {Kind::beam, 2, 3}},         {"B31R", {Kind::beam, 2, 3}},
      {"B31H", {Kind::beam, 2, 3}},        {"B33", {Kind::beam, 2, 3}},
      {"B33H", {Kind::beam, 2, 3}},        {"PIPE31", {Kind::beam, 2, 3}},
      {"B32", {Kind::beam, 3, 4}},         {"B32R", {Kind::beam, 3, 4}},
      {"B32H", {Kind::beam, 3, 4}},        {"PIPE32", {Kind::beam, 3, 4}},
      {"T3D2", {Kind::truss, 2, 2}},       {"T3D3", {Kind::truss, 3, 3}},
      {"MASS", {Kind::mass, 1, 1}},        {"ROTARYI", {Kind::inertia, 1, 1}},
      {"SPRING1", {Kind::spring, 1, 1}},   {"SPRING2", {Kind::spring, 2, 2}},
      {"SPRINGA", {Kind::spring, 2, 2}},   {"R3D3", {Kind::rigid, 3, 3}},
      {"R3D4", {Kind::rigid, 4, 4}},       {"RB3D2", {Kind::rigid, 2, 2}},
      {"C3D4", {Kind::solid, 4, 4}},       {"C3D4H", {Kind::solid, 4, 4}},
      {"C3D5", {Kind::solid, 5, 5}},       {"C3D5H", {Kind::solid, 5, 5}},
      {"C3D6", {Kind::solid, 6, 6}},       {"C3D8", {Kind::solid, 8, 8}},
      {"C3D8R", {Kind::solid, 8, 8}},      {"C3D8I", {Kind::solid, 8, 8}},
      {"C3D8H", {Kind::solid, 8, 8}},      {"C3D10", {Kind::solid, 10, 10}},
      {"C3D10M", {Kind::solid, 10, 10}},   {"C3D10H", {Kind::solid, 10, 10}},
      {"C3D10HS", {Kind::solid, 10, 10}},  {"C3D10T", {Kind::solid, 10, 10}},
      {"C3D15", {Kind::solid, 15, 15}},    {"C3D20", {Kind::solid, 20, 20}},
      {"C3D20R", {Kind::solid, 20, 20}},   {"C3D20H", {Kind::solid, 20, 20}},
      {"DCOUP3D", {Kind::coupling, 1, 1}}, {"DASHPOT1", {Kind::nothing, 1, 1}},
      {"DASHPOT2", {Kind::nothing, 2, 2}}, {"DASHPOTA", {Kind::nothing, 2, 2}}};
  return types;
}

std::string instead_of_abaqus_type(const std::string& type) {
  static const std::vector<std::pair<const char*, const char*>> beginnings{
      {"S9R5", "S8R5, without the node in the middle, is"},
      {"SC", "give S4R or S8R on the middle surface in place of continuum shells"},
      {"CONN", "say by *COUPLING, *MPC, *EQUATION or *SPRING what connectors join"},
      {"M3D", "membranes do not bend; S3, S4R, S6 and S8R do"},
      {"SFM", "surface elements bear nothing; take them out of the deck"},
      {"B31OS", "warping is not known; B31 is"},
      {"B32OS", "warping is not known; B32 is"},
      {"ELBOW", "PIPE31 and PIPE32 are"},
      {"FRAME", "B33 is"},
      {"GAP", "what gapes is not known, for a lift is linear"},
      {"ITS", "what touches is not known, for a lift is linear"},
      {"JOINT", "say by *SPRING what joints resist"},
      {"CAX", "bodies of revolution cannot be lifted"},
      {"SAX", "bodies of revolution cannot be lifted"},
      {"CPE", "plane bodies cannot be lifted"},
      {"CPS", "plane bodies cannot be lifted; S4R and S8R are plates"},
      {"B2", "plane frames cannot be lifted; B31 is"},
      {"T2D", "plane frames cannot be lifted; T3D2 is"},
      {"AC", "fluids are not known"},
      {"COH", "layers of glue are not known; *TIE joins what they join"}};
  for (const auto& [beginning, text] : beginnings)
    if (type.starts_with(beginning)) return fmt::format("; {}", text);
  std::vector<std::string> names;
  for (const auto& [name, what] : abaqus_element_types()) names.push_back(name);
  const std::string nearest = nearest_name(type, names);
  return nearest.empty() ? "" : fmt::format(" (did you mean {}?)", nearest);
}

}  // namespace blocklift::structure

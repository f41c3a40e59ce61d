#include "structure/mesh/files/surfaces/cad_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/error.h"
#include "structure/letter_case.h"

namespace blocklift::structure {

namespace {

std::string ending_of(const std::string& path) {
  return upper(std::filesystem::path(path).extension().string());
}

bool is_step(const std::string& ending) { return ending == ".STEP" || ending == ".STP"; }
bool is_iges(const std::string& ending) { return ending == ".IGES" || ending == ".IGS"; }

// ISO 10303-41: a length is SI_UNIT(prefix, .METRE.), or a conversion-based unit with a name.
double length_of_step(const std::string& text) {
  static const std::map<std::string, double> prefixes{{"$", 1},          {".MILLI.", 1e-3},
                                                      {".CENTI.", 1e-2}, {".DECI.", 0.1},
                                                      {".KILO.", 1e3},   {".MICRO.", 1e-6}};
  static const std::regex other(R"(CONVERSION_BASED_UNIT\s*\(\s*'\s*(INCH|FOOT|FEET))",
                                std::regex::icase);
  static const std::regex metre(R"(SI_UNIT\s*\(\s*(\$|\.[A-Z]+\.)\s*,\s*\.METRE\.)");
  std::smatch found;
  if (std::regex_search(text, found, other))
    return upper(found[1].str()) == "INCH" ? 0.0254 : 0.3048;
  if (!std::regex_search(text, found, metre)) return 0;
  const auto prefix = prefixes.find(found[1].str());
  return prefix == prefixes.end() ? 0 : prefix->second;
}

/// Parameters of the global section: columns 1 to 72 of the lines marked G.
std::string global_section(const std::string& text) {
  std::string section;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin >= 73 && text[begin + 72] == 'G') section += text.substr(begin, 72);
    begin = end + 1;
  }
  return section;
}

// IGES 5.3, section 2.2.4.3: the 14th parameter of the global section is the unit's flag.
double length_of_iges(const std::string& text) {
  static const std::map<std::string, double> flags{{"1", 0.0254},   {"2", 1e-3}, {"4", 0.3048},
                                                   {"5", 1609.344}, {"6", 1},    {"7", 1e3},
                                                   {"8", 2.54e-5},  {"9", 1e-6}, {"10", 1e-2}};
  constexpr int flag_place = 14;
  const std::string section = global_section(text);
  std::string value;
  int place = 1;
  for (std::size_t i = 0; i < section.size() && place <= flag_place; ++i) {
    const char c = section[i];
    if (c == 'H' && !value.empty() && std::all_of(value.begin(), value.end(), [](char digit) {
          return std::isdigit(static_cast<unsigned char>(digit)) != 0;
        })) {
      i += static_cast<std::size_t>(std::strtoul(value.c_str(), nullptr, 10));  // a string's text
      value = "text";
    } else if (c == ',' || c == ';') {
      if (place++ == flag_place) break;
      value.clear();
    } else if (c != ' ') {
      value += c;
    }
  }
  const auto flag = flags.find(value);
  return place > flag_place && flag != flags.end() ? flag->second : 0;
}

/// The name that a designer gave, of a label such as "Shapes/hull/deck"; empty if a translator made
/// it up.
std::string own_name(const std::string& label) {
  const std::string name = label.substr(label.rfind('/') + 1);
  static const std::vector<std::string> made_up{"FACE", "SHELL",  "COMPOUND", "SOLID", "EDGE",
                                                "WIRE", "VERTEX", "Shapes",   "Curve", "Geometric"};
  const bool is_made_up = name.starts_with("Open CASCADE") ||
                          std::find(made_up.begin(), made_up.end(), name) != made_up.end() ||
                          std::all_of(name.begin(), name.end(), [](char c) {
                            return std::isdigit(static_cast<unsigned char>(c)) != 0;
                          });
  return is_made_up ? "" : name;
}

/// The group of a surface or a curve: its label, its colour, or its number.
std::string group_of_entity(const Entity& entity) {
  const auto& [dimension, tag] = entity;
  std::string label;
  gmsh::model::getEntityName(dimension, tag, label);
  std::string name = own_name(label);
  if (!name.empty()) return name;
  int red = 0, green = 0, blue = 0, alpha = 0;
  gmsh::model::getColor(dimension, tag, red, green, blue, alpha);
  if (alpha > 0) return fmt::format("colour #{:02x}{:02x}{:02x}", red, green, blue);
  return fmt::format("{} {}", dimension == 2 ? "surface" : "curve", tag);
}

/// Curves that bound no surface, by tag, with their groups.
std::map<int, std::string> free_curves() {
  std::map<int, std::string> groups;
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  for (const Entity& curve : curves) {
    std::vector<int> surfaces, ends;
    gmsh::model::getAdjacencies(1, curve.second, surfaces, ends);
    if (surfaces.empty()) groups[curve.second] = group_of_entity(curve);
  }
  return groups;
}

int take_solids_away(bool allowed) {
  gmsh::vectorpair solids;
  gmsh::model::getEntities(solids, 3);
  if (solids.empty()) return 0;
  if (!allowed)
    throw ModelError(fmt::format(
        "the file has {} solid{}, and a block is lifted as plates: give its mid-surfaces, or "
        "leave_solids_out",
        solids.size(), solids.size() == 1 ? "" : "s"));
  gmsh::model::occ::remove(solids, true);
  gmsh::model::occ::synchronize();
  return static_cast<int>(solids.size());
}

}  // namespace

bool is_cad_file(const std::string& path) {
  const std::string ending = ending_of(path);
  return is_step(ending) || is_iges(ending) || ending == ".BREP";
}

double declared_length(const std::string& path) {
  const std::string ending = ending_of(path);
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (is_step(ending)) return length_of_step(text);
  return is_iges(ending) ? length_of_iges(text) : 0;
}

CadSurfaces open_cad_file(const std::string& path, double length, bool leave_solids_out) {
  CadSurfaces cad;
  const double declared = declared_length(path);
  if (declared > 0 && std::abs(declared - length) > 1e-6 * length)
    throw ModelError(fmt::format(
        "the file says that its lengths are in units of {:.4g} m, and the block that they are in "
        "units of {:.4g} m",
        declared, length));
  // OpenCASCADE turns what a file declares into millimetres; what it does not declare stays.
  cad.length = declared > 0 ? 1e-3 : length;
  gmsh::vectorpair shapes;
  try {
    gmsh::model::occ::importShapes(path, shapes, false);
    gmsh::model::occ::synchronize();
  } catch (const std::string& error) {
    throw ModelError("OpenCASCADE cannot read the file; is it damaged? " + error);
  }
  cad.solids_left_out = take_solids_away(leave_solids_out);
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const Entity& surface : surfaces) cad.groups[surface.second] = group_of_entity(surface);
  cad.curves = free_curves();
  if (surfaces.empty() && cad.curves.empty())
    throw ModelError("there are neither surfaces nor curves in the file, or it is damaged");
  return cad;
}

}  // namespace blocklift::structure

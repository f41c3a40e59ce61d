#include "structure/mesh/files/surfaces/group_finder.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmsh.h>

namespace blocklift::structure {

namespace {

bool has_name(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> groups_of(int dimension, int entity) {
  std::vector<int> tags;
  gmsh::model::getPhysicalGroupsForEntity(dimension, entity, tags);
  std::vector<std::string> names;
  for (const int tag : tags) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    if (name.empty()) name = fmt::format("{} group {}", dimension == 2 ? "surface" : "curve", tag);
    names.push_back(std::move(name));
  }
  return names;
}

bool has_elements(int dimension, int entity) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  return !types.empty();
}

/// The group that a surface's plate is of; empty after a complaint.
std::string plate_group(int surface, const GivenGroups& given,
                        std::vector<std::string>& complaints) {
  std::vector<std::string> names = groups_of(2, surface);
  if (names.empty()) return fmt::format("surface {}", surface);
  if (names.size() == 1) return names.front();
  std::vector<std::string> chosen;
  std::copy_if(names.begin(), names.end(), std::back_inserter(chosen),
               [&](const std::string& name) { return given.has_plate(name); });
  if (chosen.size() == 1) return chosen.front();
  complaints.push_back(
      fmt::format("surface {} is in the groups {}, of which {} given a thickness", surface,
                  fmt::join(names, ", "),
                  chosen.empty() ? "none is" : fmt::format("{} are", fmt::join(chosen, " and "))));
  return {};
}

}  // namespace

bool GivenGroups::has_plate(const std::string& name) const { return has_name(plates, name); }
bool GivenGroups::has_bar(const std::string& name) const { return has_name(bars, name); }

int add_region(Mesh& mesh, const std::string& group, const std::string& region) {
  const auto known = std::find_if(mesh.groups.begin(), mesh.groups.end(),
                                  [&](const Group& other) { return other.name == group; });
  const auto place = static_cast<int>(known - mesh.groups.begin());
  if (known == mesh.groups.end()) mesh.groups.push_back({group, 0});
  mesh.regions.push_back({region, place, false});
  return static_cast<int>(mesh.regions.size()) - 1;
}

EntityRegions find_groups(const GivenGroups& given, Deck& deck,
                          std::vector<std::string>& complaints) {
  EntityRegions regions;
  gmsh::vectorpair surfaces, curves;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& [dimension, surface] : surfaces) {
    if (!has_elements(dimension, surface)) continue;
    const std::string group = plate_group(surface, given, complaints);
    if (group.empty()) continue;
    regions.surfaces[surface] =
        add_region(deck.mesh, group, fmt::format("{}, surface {}", group, surface));
  }
  gmsh::model::getEntities(curves, 1);
  int left_out = 0;
  for (const auto& [dimension, curve] : curves) {
    if (!has_elements(dimension, curve)) continue;
    const std::vector<std::string> names = groups_of(1, curve);
    const auto bar = std::find_if(names.begin(), names.end(),
                                  [&](const std::string& name) { return given.has_bar(name); });
    if (bar != names.end())
      regions.curves[curve] = add_region(deck.mesh, *bar, fmt::format("{}, curve {}", *bar, curve));
    else
      ++left_out;
  }
  if (!curves.empty())
    deck.ledger.push_back({"curves",
                           static_cast<int>(regions.curves.size()) + left_out,
                           static_cast<int>(regions.curves.size()),
                           left_out > 0 ? "no section is given to their groups" : "",
                           {}});
  return regions;
}

}  // namespace blocklift::structure

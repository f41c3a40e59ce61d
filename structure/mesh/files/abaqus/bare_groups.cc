#include "structure/mesh/files/abaqus/bare_groups.h"

#include <fmt/format.h>

#include "structure/letter_case.h"

namespace blocklift::structure {

BareGroups::BareGroups(AbaqusModel& model)
    : model_(model),
      plates_(sets_among(model.options.groups_of_plates)),
      bars_(sets_among(model.options.groups_of_bars)) {}

std::map<int, BareGroups::Names> BareGroups::sets_among(const Names& given) const {
  std::map<int, Names> sets;
  for (const std::string& name : given)
    for (const AbaqusScope& scope : model_.scopes) {
      const std::string in_scope = scope.name.empty() || !upper(name).starts_with(scope.name + ".")
                                       ? upper(name)
                                       : upper(name).substr(scope.name.size() + 1);
      const auto set = scope.element_sets.find(in_scope);
      if (set == scope.element_sets.end()) continue;
      for (const int element : set->second) sets[element].push_back(name);
    }
  return sets;
}

int BareGroups::region_of_plate(int element) {
  Names& groups = model_.deck.groups_without_thickness;
  const auto found = plates_.find(element);
  if (found == plates_.end()) return region("shells", groups);
  if (found->second.size() > 1)
    model_.log.complain(model_.elements[element].line,
                        fmt::format("*ELEMENT: plates are in the sets {}, each of which is given a "
                                    "thickness",
                                    fmt::join(found->second, " and ")));
  return region(found->second.front(), groups);
}

bool BareGroups::take_bar(int place) {
  AbaqusDeckElement& element = model_.elements[place];
  const bool is_truss = element.kind == AbaqusKind::truss;
  const auto found = bars_.find(place);
  if (found == bars_.end()) {
    if (is_truss)
      model_.log.leave_out("*ELEMENT",
                           "lines of type " + element.type + " to whose sets no section is given");
    return is_truss;
  }
  const bool is_quadratic = is_truss ? element.nodes.size() == 3
                                     : element.type.starts_with("B32") || element.type == "PIPE32";
  std::vector<int> nodes(element.nodes.begin(), element.nodes.begin() + (is_quadratic ? 3 : 2));
  // Along the edge of a shell a bar bends with all of it, and not at three nodes alone.
  if (is_quadratic && is_middle_of_shell(nodes[1])) nodes.erase(nodes.begin() + 1);
  const int of_region = region(found->second.front(), model_.deck.groups_without_section);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    Beam bar;
    bar.vertices = {nodes[i], nodes[i + 1]};
    bar.section = -1;
    bar.region = of_region;
    bar.label = element.label;
    element.beams.push_back(static_cast<int>(model_.deck.mesh.beams.size()));
    model_.deck.mesh.beams.push_back(bar);
  }
  return true;
}

void BareGroups::miss_section_of_bar(int place) {
  const AbaqusDeckElement& element = model_.elements[place];
  model_.log.complain(
      element.line,
      fmt::format("*ELEMENT: beams or trusses have no section; leave_out: [{}] does without them",
                  element.type));
}

bool BareGroups::is_middle_of_shell(int vertex) {
  if (middles_.empty())
    for (const SurfacePoint& point : model_.middles) middles_.insert(point.vertex);
  return middles_.contains(vertex);
}

int BareGroups::region(const std::string& name, Names& groups) {
  Mesh& mesh = model_.deck.mesh;
  const auto [known, is_new] = region_of_.try_emplace(name, static_cast<int>(mesh.regions.size()));
  if (is_new) {
    groups.push_back(name);
    mesh.groups.push_back({name, 0});
    mesh.regions.push_back({.name = name, .group = static_cast<int>(mesh.groups.size()) - 1});
  }
  return known->second;
}

}  // namespace blocklift::structure

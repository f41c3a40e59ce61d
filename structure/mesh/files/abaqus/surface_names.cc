// Surfaces by their names: of the assembly or a deck without parts, or of an instance.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "structure/letter_case.h"
#include "structure/mesh/files/abaqus/model.h"

namespace blocklift::structure {

namespace {

std::string full_name(const AbaqusScope& scope, std::string_view name) {
  return scope.name.empty() ? upper(name) : scope.name + "." + upper(name);
}

}  // namespace

AbaqusSurface& AbaqusModel::surface_of(const AbaqusScope& scope, std::string_view name) {
  return surfaces[full_name(scope, name)];
}

const NamedAbaqusSurface* AbaqusModel::find_surface(const AbaqusScope& scope,
                                                    std::string_view name) const {
  // In its own scope, by instance and name, or of a deck's only instance, whose name may be left
  // out as that of its sets.
  std::vector<std::string> names{full_name(scope, name), upper(name)};
  if (scopes.size() == 3) names.push_back(full_name(scopes[1], name));
  for (const std::string& known : names)
    if (const auto found = surfaces.find(known); found != surfaces.end()) return &*found;
  return nullptr;
}

const NamedAbaqusSurface& AbaqusModel::surface(const AbaqusScope& scope,
                                               std::string_view name) const {
  if (const NamedAbaqusSurface* found = find_surface(scope, name)) return *found;
  constexpr std::size_t most = 12;
  std::string known;
  std::size_t count = 0;
  for (const auto& [other, surface] : surfaces) {
    if (++count > most) continue;
    known += (known.empty() ? "" : ", ") + other;
  }
  throw CardError{fmt::format("surface {} does not exist; {}{}{}", name,
                              known.empty() ? "the deck has none" : "those of the deck are ", known,
                              count > most ? ", ..." : "")};
}

}  // namespace blocklift::structure

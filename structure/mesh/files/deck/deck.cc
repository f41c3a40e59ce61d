#include "structure/mesh/files/deck/deck.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace blocklift::structure {

namespace {

const std::vector<UnitSystem>& all_unit_systems() {
  constexpr double inch = 0.0254, foot = 0.3048, pound_force = 4.4482216152605;  // exact
  static const std::vector<UnitSystem> systems{{"m-kg-N", 1, 1},
                                               {"mm-t-N", 1e-3, 1},
                                               {"m-t-kN", 1, 1e3},
                                               {"m-kt-MN", 1, 1e6},
                                               {"in-slinch-lbf", inch, pound_force},
                                               {"in-lbf", inch, pound_force},
                                               {"ft-slug-lbf", foot, pound_force}};
  return systems;
}

std::string joined(const std::vector<std::string>& complaints) {
  constexpr std::size_t most = 50;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, complaints.size()); ++i)
    text += (i == 0 ? "" : "\n") + complaints[i];
  if (complaints.size() > most)
    text += fmt::format("\n... and {} more of such errors", complaints.size() - most);
  return text;
}

}  // namespace

UnitSystem unit_system(const std::string& name) {
  std::string names;
  for (const UnitSystem& system : all_unit_systems()) {
    if (system.name == name) return system;
    names += (names.empty() ? "" : ", ") + system.name;
  }
  throw ModelError(fmt::format("no system of units is called \"{}\"; there are {}", name, names));
}

DeckError::DeckError(std::vector<std::string> complaints)
    : ModelError(joined(complaints)), complaints_(std::move(complaints)) {}

std::string describe_ledger(const Deck& deck) {
  std::string text;
  for (const LedgerEntry& entry : deck.ledger) {
    text += fmt::format("{:<24} {:>7} read {:>7} used", entry.name, entry.read, entry.used);
    if (!entry.left_out.empty()) text += "  " + entry.left_out;
    text += '\n';
  }
  return text;
}

}  // namespace blocklift::structure

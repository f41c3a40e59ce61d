#include "pipeline/files/environment/vessel_database.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/whole_turn.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/files/named_file.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/formats/hydrodynamics/convention_check.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"
#include "pipeline/formats/hydrodynamics/radiation_check.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;

struct DatabaseFile {
  std::shared_ptr<const HydrodynamicDatabase> database;  ///< null if it could not be read
  std::string content;                                   ///< its fingerprint
};
using DatabaseOfFile = std::map<std::string, DatabaseFile>;

/// From those that were read before, or the file; without a database after a complaint.
DatabaseFile find_database(const Located<std::string>& file, const std::filesystem::path& beside,
                           DatabaseOfFile& known, Diagnostics& diagnostics) {
  const auto [place, is_new] = known.try_emplace(file.value);
  if (!is_new) return place->second;
  const auto found = path_of_named_file(file, beside, diagnostics);
  if (!found) return {};
  const std::filesystem::path& path = *found;
  if (!std::filesystem::is_regular_file(path)) {
    diagnostics.error(file.mark, fmt::format("there is no database {}", path.string()),
                      {"make it with blocklift hydro VESSEL -o FILE, or take another program's "
                       "over with blocklift hydro --import FILE -o FILE"});
    return {};
  }
  try {
    place->second.database =
        std::make_shared<const HydrodynamicDatabase>(read_hydrodynamic_database(path));
    place->second.content = hash_of_files({path});
  } catch (const HydrodynamicFileError& error) {
    diagnostics.error(file.mark, error.what());
  }
  return place->second;
}

void find_body(given::Vessel& vessel, Diagnostics& diagnostics) {
  const std::vector<std::string>& names = vessel.hydrodynamics->body_names;
  if (names.size() == 1 && !vessel.database_body) return;
  const Located<std::string>& wanted = vessel.database_body ? *vessel.database_body : vessel.name;
  const auto found = std::find(names.begin(), names.end(), wanted.value);
  if (found == names.end()) {
    diagnostics.error(
        wanted.mark,
        fmt::format("the database {} holds no body \"{}\"", vessel.database->value, wanted.value),
        {names_hint("its bodies are", names, wanted.value)});
    return;
  }
  vessel.hydrodynamic_body = static_cast<int>(found - names.begin());
}

void check_alone(const given::Vessel& vessel, Diagnostics& diagnostics) {
  if (!vessel.database && vessel.database_body) {
    diagnostics.error(vessel.database_body->mark,
                      fmt::format("vessel {} is a body of no database", vessel.name.value),
                      {"name the file: database: FILE"});
  }
  if (!vessel.database) return;
  if (vessel.radiation.value != RadiationMethod::database) {
    diagnostics.error(
        vessel.database->mark,
        fmt::format("vessel {} names a database, and its radiation is {}", vessel.name.value,
                    vessel.radiation.value == RadiationMethod::none ? "none" : "direct"),
        {"leave out one of the two"});
  }
  if (vessel.draughts) {
    diagnostics.error(
        vessel.draughts->mark,
        fmt::format("vessel {} has draughts, and a database of one draught", vessel.name.value),
        {"leave out one of the two"});
  }
}

/// One file for all that make waves, each of its bodies once.
void check_together(const std::vector<const given::Vessel*>& vessels, Diagnostics& diagnostics) {
  const auto first = std::find_if(vessels.begin(), vessels.end(), [](const given::Vessel* vessel) {
    return bool{vessel->database};
  });
  if (first == vessels.end()) return;
  const Located<std::string>& file = *(*first)->database;
  std::vector<const given::Vessel*> of_body(
      (*first)->hydrodynamics ? (*first)->hydrodynamics->body_names.size() : 0, nullptr);
  for (const given::Vessel* vessel : vessels) {
    if (!vessel->database || vessel->database->value != file.value) {
      diagnostics.error(vessel->database ? vessel->database->mark : vessel->name.mark,
                        fmt::format("vessel {} does not name the database {}, as {} does",
                                    vessel->name.value, file.value, (*first)->name.value),
                        {"they share one water: name one file that holds all of them, or give "
                         "one radiation: none"});
      return;
    }
    if (!vessel->hydrodynamics) return;
    const given::Vessel*& taken = of_body[vessel->hydrodynamic_body];
    if (taken != nullptr) {
      diagnostics.error(vessel->database->mark,
                        fmt::format("vessels {} and {} are the same body of {}", taken->name.value,
                                    vessel->name.value, file.value),
                        {"tell them apart by database_body"});
      return;
    }
    taken = vessel;
  }
  const auto missing = std::find(of_body.begin(), of_body.end(), nullptr);
  if (missing == of_body.end()) return;
  const auto body = static_cast<std::size_t>(missing - of_body.begin());
  diagnostics.error(file.mark,
                    fmt::format("the database {} holds body {}, which no vessel is", file.value,
                                (*first)->hydrodynamics->body_names[body]),
                    {"all bodies of a database float together: give each a vessel"});
}

void check_water(const Located<std::string>& file, const HydrodynamicDatabase& database,
                 const given::Sea& sea, double gravity, Diagnostics& diagnostics) {
  const auto differ = [](double a, double b) {
    return std::isinf(a) != std::isinf(b) || (!std::isinf(a) && std::abs(a - b) > 2e-3 * b);
  };
  const dynamics::Water& water = database.water;
  const double depth = sea.depth.value_or(std::numeric_limits<double>::infinity());
  if (!differ(water.density, sea.density) && !differ(water.gravity, gravity) &&
      !differ(water.depth, depth)) {
    return;
  }
  const auto text = [](double density, double g, double h) {
    return fmt::format("{:.6g} kg/m3, {:.6g} m/s2, {}", density, g,
                       std::isinf(h) ? std::string("deep") : fmt::format("{:.6g} m deep", h));
  };
  diagnostics.error(file.mark,
                    fmt::format("the database {} is for water of {}; the case has {}", file.value,
                                text(water.density, water.gravity, water.depth),
                                text(sea.density, gravity, depth)),
                    {"give the sea the density and depth of the database, and the case its "
                     "gravity"});
}

/// A vessel that waves meet must have their forces from all sides, since it may turn.
void check_headings(const Located<std::string>& file, const HydrodynamicDatabase& database,
                    const given::Sea& sea, Diagnostics& diagnostics) {
  if (!sea.waves) return;
  try {
    dynamics::headings_of_whole_turn(file.value, database.headings);
  } catch (const dynamics::ModelError& error) {
    diagnostics.error(file.mark, error.what(), {"compute it for headings all around"});
  }
}

/// Lids are part of a database: beside one they would do nothing.
void check_lids(const MarineParts& parts, bool named, bool radiating, Diagnostics& diagnostics) {
  if (!parts.sea || !parts.sea->radiation.lids || (radiating && !named)) return;
  diagnostics.error(parts.sea->radiation.lids->mark,
                    named ? "lids are given beside a database, which was computed with its own"
                          : "lids are given, but no vessel makes waves",
                    {named ? "give them to blocklift hydro, which computes it" : "leave them out"});
}

}  // namespace

void load_vessel_databases(std::vector<given::Vessel>& vessels, const std::filesystem::path& beside,
                           Diagnostics& diagnostics) {
  DatabaseOfFile known;
  for (given::Vessel& vessel : vessels) {
    if (!vessel.database) continue;
    const DatabaseFile file = find_database(*vessel.database, beside, known, diagnostics);
    vessel.hydrodynamics = file.database;
    vessel.database_content = file.content;
    if (vessel.hydrodynamics) find_body(vessel, diagnostics);
  }
}

void check_vessel_databases(const MarineParts& parts, double gravity, Diagnostics& diagnostics) {
  std::vector<const given::Vessel*> radiating;
  for (const given::Vessel& vessel : parts.vessels) {
    check_alone(vessel, diagnostics);
    if (vessel.radiation.value != RadiationMethod::none) radiating.push_back(&vessel);
  }
  check_together(radiating, diagnostics);
  check_lids(parts,
             std::any_of(radiating.begin(), radiating.end(),
                         [](const given::Vessel* vessel) { return vessel->database.has_value(); }),
             !radiating.empty(), diagnostics);
  for (const given::Vessel* vessel : radiating) {
    if (!vessel->hydrodynamics || !parts.sea) continue;
    check_water(*vessel->database, *vessel->hydrodynamics, *parts.sea, gravity, diagnostics);
    check_headings(*vessel->database, *vessel->hydrodynamics, *parts.sea, diagnostics);
    return;
  }
}

std::vector<std::string> doubts_about_database(const std::vector<given::Vessel>& vessels) {
  std::vector<std::string> sentences;
  for (const given::Vessel& vessel : vessels) {
    if (vessel.radiation.value == RadiationMethod::none || !vessel.hydrodynamics) continue;
    std::vector<std::string> doubts = doubts_about_conventions(*vessel.hydrodynamics);
    if (std::string memory = doubt_about_memory(*vessel.hydrodynamics); !memory.empty())
      doubts.insert(doubts.begin(), std::move(memory));
    for (const std::string& doubt : doubts)
      sentences.push_back(fmt::format("Database {}: {}.", vessel.database->value, doubt));
    return sentences;
  }
  return sentences;
}

}  // namespace blocklift::pipeline

#include "structure/mesh/files/surfaces/surface_reader.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <new>
#include <set>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/child_process.h"
#include "structure/mesh/files/geometry_script.h"
#include "structure/mesh/files/gmsh_session.h"
#include "structure/mesh/files/msh_check.h"
#include "structure/mesh/files/surfaces/cad_file.h"
#include "structure/mesh/files/surfaces/cell_collector.h"
#include "structure/mesh/files/surfaces/deck_packet.h"
#include "structure/mesh/files/surfaces/fragments.h"
#include "structure/mesh/files/universal_file.h"

namespace blocklift::structure {

namespace {

constexpr double joint_tolerance = 1e-4;  // m: gaps of drawing, far below any plate's thickness
constexpr double most_memory = 8e9;       // bytes
constexpr double seconds_to_open = 60, seconds_to_open_a_megabyte = 10, seconds_to_mesh = 1800;

class SurfaceReader {
 public:
  SurfaceReader(const std::string& path, const SurfaceReading& reading)
      : path_(path), reading_(reading) {}

  Deck read() {
    const GmshSession session;
    const auto megabytes = 1e-6 * static_cast<double>(std::filesystem::file_size(path_));
    allow_processor_time(seconds_to_open + seconds_to_open_a_megabyte * megabytes);
    const bool is_cad = is_cad_file(path_);
    double length = reading_.units.length;
    const EntityRegions regions = is_cad ? from_geometry(length) : from_mesh();
    if (!complaints_.empty()) throw DeckError(complaints_);
    collect_cells(regions, length, deck_);
    if (deck_.mesh.vertices.empty())
      throw ModelError("the file has neither plates nor bars: is it all there?");
    name_groups();
    return std::move(deck_);
  }

 private:
  EntityRegions from_mesh() {
    try {
      if (is_universal_file(path_)) {
        open_universal_file(path_);
      } else {
        require_known_nodes(path_);
        require_closed_script(path_);
        gmsh::open(path_);
      }
    } catch (const std::string& error) {
      throw ModelError("Gmsh cannot read the file; is it damaged? " + error);
    }
    std::vector<int> solid_types;
    gmsh::model::mesh::getElementTypes(solid_types, 3);
    if (!solid_types.empty()) {
      if (!reading_.leave_solids_out)
        throw ModelError(
            "the mesh has solid elements, and a block is lifted as plates and bars: leave them out "
            "of it, or give leave_solids_out");
      deck_.ledger.push_back({"solid elements", 1, 0, "they were to be left out", {}});
    }
    return find_groups(reading_.given, deck_, complaints_);
  }

  EntityRegions from_geometry(double& length) {
    const CadSurfaces cad = open_cad_file(path_, length, reading_.leave_solids_out);
    length = cad.length;
    if (cad.solids_left_out > 0)
      deck_.ledger.push_back({"solids", cad.solids_left_out, 0, "they were to be left out", {}});
    std::map<Entity, int> owners;
    for (const auto& [surface, group] : cad.groups) owners[{2, surface}] = surface;
    for (const int curve : take_bars(cad)) owners[{1, curve}] = curve;
    allow_processor_time(seconds_to_mesh);
    EntityRegions regions;
    for (const auto& [piece, of] : cut_at_joints(owners, joint_tolerance / length)) {
      const bool is_plate = piece.first == 2;
      const auto& groups = is_plate ? cad.groups : cad.curves;
      if (of.size() > 1) note_overlap(is_plate, groups, of);
      (is_plate ? regions.surfaces : regions.curves)[piece.second] =
          region_of(groups.at(of.front()), {piece.first, of.front()});
    }
    if (!complaints_.empty()) return regions;
    mesh_surfaces(reading_.sizes, length);
    return regions;
  }

  /// The free curves whose groups are given a section. The others leave the model, and the list of
  /// what is left out has their groups' names.
  std::vector<int> take_bars(const CadSurfaces& cad) {
    constexpr std::size_t most_names = 6;
    std::vector<int> bars;
    gmsh::vectorpair others;
    std::set<std::string> without;
    for (const auto& [curve, group] : cad.curves) {
      if (reading_.given.has_bar(group)) {
        bars.push_back(curve);
        continue;
      }
      others.emplace_back(1, curve);
      without.insert(group);
    }
    if (cad.groups.empty() && bars.empty())
      throw ModelError(
          fmt::format("the file has curves alone, and no section is given to their groups: {}",
                      first_of(without, most_names)));
    if (!others.empty()) {
      gmsh::model::occ::remove(others, true);
      gmsh::model::occ::synchronize();
    }
    if (!cad.curves.empty())
      deck_.ledger.push_back({"curves",
                              static_cast<int>(cad.curves.size()),
                              static_cast<int>(bars.size()),
                              without.empty() ? ""
                                              : "no section is given to their groups: " +
                                                    first_of(without, most_names),
                              {}});
    return bars;
  }

  static std::string first_of(const std::set<std::string>& names, std::size_t most) {
    std::vector<std::string> shown(
        names.begin(),
        std::next(names.begin(), static_cast<std::ptrdiff_t>(std::min(most, names.size()))));
    if (names.size() > most) shown.push_back(fmt::format("{} more", names.size() - most));
    return fmt::format("{}", fmt::join(shown, ", "));
  }

  int region_of(const std::string& group, const Entity& owner) {
    const auto [known, is_new] = region_of_entity_.try_emplace(owner, 0);
    if (is_new)
      known->second = add_region(
          deck_.mesh, group,
          fmt::format("{}, {} {}", group, owner.first == 2 ? "surface" : "curve", owner.second));
    return known->second;
  }

  void note_overlap(bool are_plates, const std::map<int, std::string>& group_of,
                    const std::vector<int>& entities) {
    std::set<std::string> groups;
    for (const int entity : entities) groups.insert(group_of.at(entity));
    const std::string text =
        fmt::format("{} {} lie upon one another", are_plates ? "surfaces" : "curves",
                    fmt::join(entities, " and "));
    const std::string one = are_plates ? "plate" : "bar";
    if (groups.size() > 1)
      complaints_.push_back(fmt::format("{}, in the groups {}: which {} is there?", text,
                                        fmt::join(groups, " and "), one));
    else
      deck_.remarks.push_back({path_, fmt::format("{}; there is one {}", text, one)});
  }

  void name_groups() {
    std::set<std::string> plates, bars;
    for (const Shell& shell : deck_.mesh.shells)
      plates.insert(deck_.mesh.group_of_region(shell.region).name);
    for (const Beam& beam : deck_.mesh.beams)
      bars.insert(deck_.mesh.group_of_region(beam.region).name);
    deck_.groups_without_thickness.assign(plates.begin(), plates.end());
    deck_.groups_without_section.assign(bars.begin(), bars.end());
  }

  std::string path_;
  SurfaceReading reading_;
  Deck deck_;
  std::vector<std::string> complaints_;
  std::map<Entity, int> region_of_entity_;
};

}  // namespace

Deck read_surfaces(const std::string& path, const SurfaceReading& reading) {
  try {
    Packet packet = in_child_process(
        [&] {
          Packet result;
          try {
            put_surfaces(SurfaceReader(path, reading).read(), result);
          } catch (const std::string& error) {
            throw ModelError("Gmsh: " + error);
          }
          return result;
        },
        {seconds_to_mesh, most_memory});
    Deck deck = take_surfaces(packet);
    deck.path = path;
    deck.files = {path};
    deck.units = reading.units;
    return deck;
  } catch (const ChildDied& death) {
    throw DeckError(
        {fmt::format("the library that reads the file {}; is the file damaged?", death.what())});
  } catch (const ModelError& error) {
    throw DeckError({error.what()});
  }
}

}  // namespace blocklift::structure

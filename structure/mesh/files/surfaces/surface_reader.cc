#include "structure/mesh/files/surfaces/surface_reader.h"

#include <filesystem>
#include <new>
#include <set>

#include <fmt/format.h>
#include <gmsh.h>

#include "structure/child_process.h"
#include "structure/index.h"
#include "structure/mesh/files/geometry_script.h"
#include "structure/mesh/files/gmsh_session.h"
#include "structure/mesh/files/msh_check.h"
#include "structure/mesh/files/surfaces/cad_file.h"
#include "structure/mesh/files/surfaces/cell_collector.h"
#include "structure/mesh/files/surfaces/deck_packet.h"
#include "structure/mesh/files/surfaces/fragments.h"

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
    name_groups();
    return std::move(deck_);
  }

 private:
  EntityRegions from_mesh() {
    require_known_nodes(path_);
    require_closed_script(path_);
    try {
      gmsh::open(path_);
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
    allow_processor_time(seconds_to_mesh);
    EntityRegions regions;
    for (const auto& [piece, of] : cut_at_joints(owners, joint_tolerance / length)) {
      const std::string& group = cad.groups.at(of.front());
      if (of.size() > 1) note_overlap(cad, of);
      regions.surfaces[piece.second] = region_of(group, of.front());
    }
    if (!complaints_.empty()) return regions;
    mesh_surfaces(reading_.sizes, length);
    return regions;
  }

  int region_of(const std::string& group, int surface) {
    const auto [known, is_new] = region_of_surface_.try_emplace(surface, 0);
    if (is_new)
      known->second = add_region(deck_.mesh, group, fmt::format("{}, surface {}", group, surface));
    return known->second;
  }

  void note_overlap(const CadSurfaces& cad, const std::vector<int>& surfaces) {
    std::set<std::string> groups;
    for (const int surface : surfaces) groups.insert(cad.groups.at(surface));
    const std::string text =
        fmt::format("surfaces {} lie upon one another", fmt::join(surfaces, " and "));
    if (groups.size() > 1)
      complaints_.push_back(fmt::format("{}, in the groups {}: which plate is there?", text,
                                        fmt::join(groups, " and ")));
    else
      deck_.remarks.push_back({path_, text + "; there is one plate"});
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
  std::map<int, int> region_of_surface_;
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

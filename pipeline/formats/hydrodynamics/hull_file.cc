#include "pipeline/formats/hydrodynamics/hull_file.h"

#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "structure/child_process.h"
#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/mesh/files/geometry_script.h"
#include "structure/mesh/files/gmsh_session.h"

namespace blocklift::pipeline {
namespace {

/// Panels as they come from Gmsh.
struct PanelList {
  std::vector<double> places;               ///< x, y, z of the vertices
  std::vector<int> corners, corner_counts;  ///< of the panels, one after another
};

// The panels of all surfaces in the session.
PanelList collect_panels() {
  PanelList panels;
  std::vector<std::size_t> tags;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(tags, places, parameters);
  std::unordered_map<std::size_t, std::size_t> place_of_tag;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    if (!std::isfinite(places[3 * n] + places[3 * n + 1] + places[3 * n + 2])) {
      throw structure::ModelError(
          fmt::format("node {} has a coordinate that is no finite number", tags[n]));
    }
    place_of_tag[tags[n]] = 3 * n;
  }
  std::unordered_map<std::size_t, int> vertex_of_tag;
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 2);
  for (const int type : types) {
    std::string type_name;
    int dimension = 0, order = 0, nodes = 0, corner_nodes = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, type_name, dimension, order, nodes, local,
                                            corner_nodes);
    std::vector<std::size_t> elements, element_nodes;
    gmsh::model::mesh::getElementsByType(type, elements, element_nodes);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      panels.corner_counts.push_back(corner_nodes);
      for (std::size_t i = 0; i < static_cast<std::size_t>(corner_nodes); ++i) {
        const std::size_t tag = element_nodes[e * static_cast<std::size_t>(nodes) + i];
        const auto [known, is_new] =
            vertex_of_tag.try_emplace(tag, static_cast<int>(panels.places.size() / 3));
        panels.corners.push_back(known->second);
        if (!is_new) continue;
        const auto place = places.begin() + static_cast<std::ptrdiff_t>(place_of_tag.at(tag));
        panels.places.insert(panels.places.end(), place, place + 3);
      }
    }
  }
  return panels;
}

structure::Packet read_here(const std::filesystem::path& path, bool is_geometry,
                            const HullReading& reading) {
  const structure::GmshSession session;
  try {
    structure::require_closed_script(path.string());
    gmsh::open(path.string());
    if (is_geometry) {
      if (reading.panel_size) {
        gmsh::option::setNumber("Mesh.MeshSizeMin", *reading.panel_size);
        gmsh::option::setNumber("Mesh.MeshSizeMax", *reading.panel_size);
      }
      gmsh::model::mesh::generate(2);
    }
    const PanelList panels = collect_panels();
    structure::Packet packet;
    packet.put(panels.places);
    packet.put(panels.corners);
    packet.put(panels.corner_counts);
    return packet;
  } catch (const std::string& error) {
    throw structure::ModelError(error);
  }
}

/// In a child process, since damaged files crash Gmsh.
dynamics::Hull read_by_gmsh(const std::filesystem::path& path, bool is_geometry,
                            const HullReading& reading) {
  constexpr structure::ChildLimits limits{1200, 8e9};
  PanelList panels;
  try {
    structure::Packet packet =
        in_child_process([&] { return read_here(path, is_geometry, reading); }, limits);
    packet.take(panels.places);
    packet.take(panels.corners);
    packet.take(panels.corner_counts);
  } catch (const structure::ModelError& error) {
    throw HullFileError(path.string() + ": Gmsh cannot read this file: " + error.what());
  } catch (const structure::ChildDied& death) {
    throw HullFileError(
        fmt::format("{}: Gmsh {}; is the file damaged?", path.string(), death.what()));
  }
  dynamics::Hull hull(path.stem().string());
  for (std::size_t i = 0; i + 2 < panels.places.size(); i += 3)
    hull.add_vertex({panels.places[i], panels.places[i + 1], panels.places[i + 2]});
  auto next = panels.corners.begin();
  for (const int count : panels.corner_counts) {
    hull.add_panel(std::vector<int>(next, next + count));
    next += count;
  }
  return hull;
}

/// With lids on its openings, which are those of a hull that is open at the top: one that looks
/// down or sideways is where panels are missing, or the other half of the hull.
dynamics::Hull closed_above(const dynamics::Hull& hull, double tolerance) {
  constexpr double steepest = 0.5;  // cosine to the plumb
  // Lids would be put on both sides of panels that are turned round.
  for (const dynamics::HullDefect& defect : dynamics::diagnose(hull, {.most_of_a_kind = 1})) {
    if (defect.kind == dynamics::HullDefectKind::twisted_edge)
      throw dynamics::ModelError(defect.message);
  }
  dynamics::Hull closed = with_lids(hull, tolerance);
  for (int panel = hull.panel_count(); panel < closed.panel_count();) {
    // A lid is a fan about its middle, some of whose triangles look down where its rim has a bay.
    const int centre = closed.panel(panel)[0];
    dynamics::Vector3 area = dynamics::Vector3::Zero();
    for (; panel < closed.panel_count() && closed.panel(panel)[0] == centre; ++panel)
      area += closed.panel_area_vector(panel);
    if (area.z() >= steepest * area.norm()) continue;
    const dynamics::Vector3& middle = closed.vertex(centre);
    throw dynamics::ModelError(fmt::format(
        "hull \"{}\": close_openings closes what is open at the top, and the opening at ({:.4g}, "
        "{:.4g}, {:.4g}) m looks {}; add the panels that are missing there, mirror a mesh that is "
        "the half of a hull (ISX, ISY of a .gdf), or turn panels round that look inwards",
        hull.name(), middle.x(), middle.y(), middle.z(),
        area.z() <= -steepest * area.norm() ? "down" : "sideways"));
  }
  return closed;
}

}  // namespace

dynamics::Hull read_hull(const std::filesystem::path& path, const HullReading& reading) {
  const std::string ending = structure::ending_of(path);
  if (!std::filesystem::is_regular_file(path)) {
    throw HullFileError(path.string() + ": there is no such file");
  }
  dynamics::Hull hull;
  if (ending == ".gdf") {
    hull = read_gdf(path, reading.merge_tolerance);
  } else if (ending == ".msh" || ending == ".stl" || ending == ".geo") {
    hull = read_by_gmsh(path, ending == ".geo", reading);
  } else {
    throw HullFileError(path.string() + ": a file that ends in \"" + ending +
                        "\" is no hull; .msh, .geo, .stl (Gmsh) and .gdf (WAMIT) are read");
  }
  if (hull.panel_count() == 0) {
    throw HullFileError(path.string() + ": the file holds no surface panels");
  }
  const auto box = hull.bounds();
  const double tolerance = reading.merge_tolerance * (box[1] - box[0]).norm();
  try {
    hull = merge_vertices(hull, tolerance);
    if (ending == ".geo") hull = turned_outwards(hull);
    if (reading.close_openings) hull = closed_above(hull, 1e3 * tolerance);
  } catch (const dynamics::ModelError& error) {
    throw HullFileError(path.string() + ": " + error.what());
  }
  return hull;
}

}  // namespace blocklift::pipeline

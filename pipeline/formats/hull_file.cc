#include "pipeline/formats/hull_file.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <unordered_map>

#include <gmsh.h>

#include "dynamics/errors.h"
#include "structure/mesh/files/gmsh_session.h"

namespace blocklift::pipeline {
namespace {

// The panels of all surfaces in the session.
dynamics::Hull collect_panels(const std::string& name) {
  dynamics::Hull hull(name);
  std::vector<std::size_t> tags;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(tags, places, parameters);
  std::unordered_map<std::size_t, dynamics::Vector3> place_of_tag;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    place_of_tag[tags[n]] = {places[3 * n], places[3 * n + 1], places[3 * n + 2]};
  }
  std::unordered_map<std::size_t, int> vertex_of_tag;
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 2);
  std::vector<int> corners;
  for (const int type : types) {
    std::string type_name;
    int dimension = 0, order = 0, nodes = 0, corner_nodes = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, type_name, dimension, order, nodes, local,
                                            corner_nodes);
    std::vector<std::size_t> elements, element_nodes;
    gmsh::model::mesh::getElementsByType(type, elements, element_nodes);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      corners.clear();
      for (std::size_t i = 0; i < static_cast<std::size_t>(corner_nodes); ++i) {
        const std::size_t tag = element_nodes[e * static_cast<std::size_t>(nodes) + i];
        const auto [known, is_new] = vertex_of_tag.try_emplace(tag, 0);
        if (is_new) known->second = hull.add_vertex(place_of_tag.at(tag));
        corners.push_back(known->second);
      }
      hull.add_panel(corners);
    }
  }
  return hull;
}

dynamics::Hull read_by_gmsh(const std::filesystem::path& path, bool is_geometry,
                            const HullReading& reading) {
  const structure::GmshSession session;
  try {
    gmsh::open(path.string());
    if (is_geometry) {
      if (reading.panel_size) {
        gmsh::option::setNumber("Mesh.MeshSizeMin", *reading.panel_size);
        gmsh::option::setNumber("Mesh.MeshSizeMax", *reading.panel_size);
      }
      gmsh::model::mesh::generate(2);
    }
    return collect_panels(path.stem().string());
  } catch (const std::string& error) {
    throw HullFileError(path.string() + ": Gmsh cannot read this file: " + error);
  } catch (const dynamics::ModelError&) {
    throw;
  } catch (const std::exception& error) {
    throw HullFileError(path.string() + ": Gmsh cannot read this file: " + error.what());
  }
}

}  // namespace

dynamics::Hull read_hull(const std::filesystem::path& path, const HullReading& reading) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
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
    if (reading.close_openings) hull = with_lids(hull, 1e3 * tolerance);
  } catch (const dynamics::ModelError& error) {
    throw HullFileError(path.string() + ": " + error.what());
  }
  return hull;
}

}  // namespace blocklift::pipeline

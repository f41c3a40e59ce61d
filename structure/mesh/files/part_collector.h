#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "structure/mesh/files/part_reader.h"
#include "structure/mesh/part_mesh.h"

namespace blocklift::structure {

/// Collects elements and groups of Gmsh's current model into a PartMesh. Gmsh's session is open.
class PartCollector {
 public:
  /// @param length_unit of the model's coordinates, m.
  explicit PartCollector(double length_unit) : length_unit_(length_unit) {}

  /// @param point_sets nodes that become groups of points.
  /// @throws ModelError if there are no solids, some of an unknown kind, nodes that do not exist,
  ///   or a chosen group has the name of another.
  PartMesh collect(const std::map<std::string, std::vector<std::size_t>>& point_sets,
                   const std::vector<FaceChoice>& faces, const std::vector<PointChoice>& points);

 private:
  void read_nodes();
  int node_of(std::size_t tag);
  int kind_of(int type);
  void read_entity(int dimension, int entity);
  void add_points(const std::string& name, const std::vector<std::size_t>& tags);
  void read_physical_groups();
  void add_faces(const FaceChoice& choice);
  void add_nearest(const PointChoice& choice);
  void require_new(const std::string& name) const;

  double length_unit_;
  PartMesh mesh_;
  std::vector<double> all_places_, places_;
  std::unordered_map<std::size_t, std::size_t> place_of_tag_;
  std::unordered_map<std::size_t, int> node_of_tag_;
  std::map<int, int> kind_of_type_;
  std::map<std::pair<int, int>, std::vector<int>> elements_of_entity_;
};

}  // namespace blocklift::structure

#include "structure/mesh/padeye/padeye_in_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/error.h"
#include "structure/index.h"
#include "structure/mesh/fields/plate_finder.h"
#include "structure/mesh/fields/shell_solid_joint.h"
#include "structure/mesh/padeye/padeye.h"

namespace blocklift::structure {

namespace {

constexpr double in_plane = 0.99;  // cosine between the normals of a plate and of a padeye

std::string text_of_place(const Vector3& place) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", place.x(), place.y(), place.z());
}

class PadeyeStander {
 public:
  PadeyeStander(Mesh& mesh, const PadeyeInBlock& padeye, int divisions)
      : mesh_(mesh), padeye_(padeye), solids_(make_padeye_mesh(padeye.geometry, divisions).mesh) {
    const auto point =
        std::find_if(mesh.lifting_points.begin(), mesh.lifting_points.end(),
                     [&](const LiftingPoint& candidate) { return candidate.name == padeye.lug; });
    if (point == mesh.lifting_points.end())
      throw ModelError(fmt::format("there is no lug {} that could be a solid", padeye.lug));
    point_ = &*point;
    has_plate_ = mesh.regions[point_->region].is_lug && point_->vertex < 0;
    // Edges that end within another plate's thickness are led to its middle plane.
    for (const ShellSection& section : mesh.shell_sections)
      reach_ = std::max(reach_, 0.51 * section.thickness);
  }

  void stand() {
    if (has_plate_)
      remove_plate();
    else
      add_region();
    add_solids();
    tie_base();
    hang_pin();
    number_cells();
  }

 private:
  /// Height of a place above the base, m.
  double height_of(const Vector3& place) const {
    return padeye_.R_BP.col(1).dot(place - padeye_.p_BP) + padeye_.geometry.height;
  }
  double height_of_vertex(int vertex) const { return height_of(mesh_.vertices[vertex]); }

  [[noreturn]] void refuse(const std::string& why) const {
    throw ModelError(fmt::format("lug {} cannot be a solid: {}", padeye_.lug, why));
  }

  /// Does a shell of the lug's lie beyond the base?
  bool is_beyond(const Shell& shell) const {
    const bool beyond = height_of(position(mesh_, shell, {0.5, 0.5})) > 0;
    for (const int vertex : shell.vertices) {
      const double height = height_of_vertex(vertex);
      if (beyond ? height < -reach_ : height > reach_)
        refuse(fmt::format("its plate is not divided at the padeye's base, at {}",
                           text_of_place(mesh_.vertices[vertex])));
    }
    return beyond;
  }

  void remove_plate() {
    std::vector<Shell> kept;
    std::vector<int> place_of;  // of each shell among those that stay; -1: it goes
    std::set<int> gone;         // vertices of shells that go
    for (const Shell& shell : mesh_.shells) {
      const bool goes = shell.region == point_->region && is_beyond(shell);
      place_of.push_back(goes ? -1 : static_cast<int>(kept.size()));
      if (goes)
        gone.insert(shell.vertices.begin(), shell.vertices.end());
      else
        kept.push_back(shell);
    }
    if (gone.empty()) refuse("no plate of it lies beyond the padeye's base");
    mesh_.shells = std::move(kept);
    for (SurfacePoint& point : mesh_.surface_points) {
      point.shell = place_of[point.shell];
      for (SurfaceStretch& stretch : point.line) stretch.shell = place_of[stretch.shell];
    }
    const auto check = [&](int vertex, int region) {
      const auto found = gone.find(vertex);
      if (found == gone.end()) return;
      if (std::abs(height_of_vertex(vertex)) > reach_)
        refuse(
            fmt::format("{} is joined to its plate at {}, beside the base, on which alone a "
                        "padeye stands",
                        mesh_.regions[region].name, text_of_place(mesh_.vertices[vertex])));
      gone.erase(found);
    };
    for (const Shell& shell : mesh_.shells)
      for (const int vertex : shell.vertices) check(vertex, shell.region);
    for (const Beam& beam : mesh_.beams)
      for (const int vertex : beam.vertices) check(vertex, beam.region);
    free_.assign(gone.begin(), gone.end());
  }

  /// On a mesh the padeye is a part more, of the steel below its pin.
  void add_region() {
    const PlateFinder plates(mesh_);
    const Vector3 up = padeye_.R_BP.col(1), across = padeye_.R_BP.col(2);
    const Vector3 below = padeye_.p_BP - padeye_.geometry.height * up;
    const auto ground = plates.find(below, across);
    if (!ground) refuse(fmt::format("no plate lies below its base at {}", text_of_place(below)));
    const Vector3 within = padeye_.p_BP - padeye_.geometry.height / 2 * up;
    const auto beside = plates.find(within, across);
    if (beside && std::abs(beside->normal.dot(across)) > in_plane)
      refuse(fmt::format("the mesh has {} at {} already, where the padeye is to be",
                         mesh_.regions[mesh_.shells[beside->shell].region].name,
                         text_of_place(within)));
    const auto is_taken = [&](const std::string& name) {
      return std::any_of(mesh_.groups.begin(), mesh_.groups.end(),
                         [&](const Group& group) { return group.name == name; });
    };
    Group group;
    group.name = padeye_.lug;
    while (is_taken(group.name)) group.name = "lug " + group.name;
    group.material = mesh_.section_of(mesh_.shells[ground->shell]).material;
    point_->region = static_cast<int>(mesh_.regions.size());
    point_->shells.clear();
    mesh_.regions.push_back({group.name, static_cast<int>(mesh_.groups.size()), true});
    mesh_.groups.push_back(std::move(group));
  }

  /// A vertex at a place; those that went with the plate come first.
  int new_vertex(const Vector3& place) {
    if (!free_.empty()) {
      const int vertex = free_.back();
      free_.pop_back();
      mesh_.vertices[vertex] = place;
      return vertex;
    }
    mesh_.vertices.push_back(place);
    if (!mesh_.vertex_labels.empty())
      mesh_.vertex_labels.push_back(
          *std::max_element(mesh_.vertex_labels.begin(), mesh_.vertex_labels.end()) + 1);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  void add_solids() {
    for (const auto& [tag, place] : solids_.nodes)
      vertex_of_[tag] =
          new_vertex(padeye_.p_BP + padeye_.R_BP * Vector3(place[0], place[1], place[2]));
    for (const AbaqusElement& element : solids_.elements) {
      Solid solid;
      solid.material = mesh_.group_of_region(point_->region).material;
      solid.region = point_->region;
      for (const std::size_t tag : element.nodes) solid.vertices.push_back(vertex_of_.at(tag));
      mesh_.solids.push_back(std::move(solid));
    }
  }

  /// Calls visit(tags) for each face of a surface: four corners in turn, then the middles between.
  template <typename Visit>
  void for_each_face(const char* surface, const Visit& visit) const {
    for (const AbaqusFace& face : solids_.surfaces.at(surface)) {
      // Elements are counted from 1 in their order.
      visit(face_nodes(solids_.elements[face.element - 1], face.face));
    }
  }

  void tie_base() {
    constexpr double same = 1e9;  // nodes lie over one another to a nanometre
    std::map<long long, std::set<std::size_t>> rows;
    for_each_face("base", [&](const std::vector<std::size_t>& tags) {
      for (const std::size_t tag : tags)
        rows[std::llround(same * solids_.nodes.at(tag)[0])].insert(tag);
    });
    StandingEdge base;
    base.through = padeye_.R_BP.col(2);
    for (const auto& [rounded, tags] : rows) {
      const Vector3 middle(solids_.nodes.at(*tags.begin())[0], -padeye_.geometry.height, 0);
      StandingEdge::Column& column = base.columns.emplace_back();
      column.place = padeye_.p_BP + padeye_.R_BP * middle;
      for (const std::size_t tag : tags) column.vertices.push_back(vertex_of_.at(tag));
    }
    try {
      stand_on_plating(mesh_, base);
    } catch (const ModelError& error) {
      refuse(error.what());
    }
  }

  void hang_pin() {
    constexpr double at_corner = 3.0 / 76, at_middle = 16.0 / 76;  // of a face's area
    std::map<int, double> weights;
    for_each_face("hole", [&](const std::vector<std::size_t>& tags) {
      const auto corner = [&](std::size_t i) { return mesh_.vertices[vertex_of_.at(tags[i])]; };
      const double area = 0.5 * (corner(2) - corner(0)).cross(corner(3) - corner(1)).norm();
      for (std::size_t i = 0; i < tags.size(); ++i)
        weights[vertex_of_.at(tags[i])] += area * (i < 4 ? at_corner : at_middle);
    });
    DistributingLink pin;
    pin.reference = new_vertex(point_->p_BPin);
    for (const auto& [vertex, weight] : weights) {
      pin.vertices.push_back(vertex);
      pin.weights.push_back(weight);
    }
    point_->vertex = pin.reference;
    mesh_.distributing_links.push_back(std::move(pin));
  }

  /// A deck's numbers stay, and solids follow them.
  void number_cells() {
    long label = 0;
    if (!has_plate_) {
      const auto pass = [&](const auto& cells) {
        for (const auto& cell : cells) label = std::max(label, cell.label);
      };
      pass(mesh_.shells);
      pass(mesh_.beams);
      pass(mesh_.solids);
    }
    const auto number = [&](auto& cells) {
      for (auto& cell : cells)
        if (has_plate_ || cell.label == 0) cell.label = ++label;
    };
    number(mesh_.shells);
    number(mesh_.beams);
    number(mesh_.solids);
  }

  Mesh& mesh_;
  const PadeyeInBlock& padeye_;
  const AbaqusMesh solids_;
  LiftingPoint* point_ = nullptr;
  bool has_plate_ = false;  ///< shells of its own, as lugs on pads have
  double reach_ = 0;
  std::vector<int> free_;  ///< vertices that nothing uses
  std::map<std::size_t, int> vertex_of_;
};

}  // namespace

void stand_padeye(Mesh& mesh, const PadeyeInBlock& padeye, int divisions) {
  PadeyeStander(mesh, padeye, divisions).stand();
}

}  // namespace blocklift::structure

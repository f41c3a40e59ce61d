#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "structure/mesh/files/abaqus/keywords.h"
#include "structure/mesh/files/deck/coordinate_systems.h"
#include "structure/mesh/heat.h"
#include "structure/mesh/laminate.h"

namespace blocklift::structure {

/// What an element type is here.
enum class AbaqusKind {
  shell,
  beam,
  truss,
  mass,
  inertia,
  spring,
  rigid,
  solid,
  coupling,
  nothing
};

struct AbaqusDeckElement {
  long label = 0;
  AbaqusKind kind = AbaqusKind::shell;
  std::string type;
  std::vector<int> nodes;  ///< vertices
  int scope = 0;
  SourceLine line;
  int shell = -1;           ///< place in the mesh
  int solid = -1;           ///< place in the mesh
  std::vector<int> beams;   ///< places in the mesh
  std::vector<int> masses;  ///< places in the mesh
};

/// Names and numbers that hold in one part's instance, the assembly, or a deck without parts.
struct AbaqusScope {
  std::string name;  ///< of the instance
  std::vector<const AbaqusBlock*> blocks;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vector3 shift = Vector3::Zero();  ///< in the deck's units
  std::unordered_map<long, int> nodes, elements;
  std::map<std::string, std::vector<int>> node_sets, element_sets;
};

struct AbaqusSurface {
  bool is_of_nodes = false;
  std::vector<std::pair<int, std::string>> faces;  ///< element, face
  std::map<int, double> nodes;                     ///< with the area that each stands for
};

/// By its name; of an instance INSTANCE.NAME.
using NamedAbaqusSurface = std::pair<const std::string, AbaqusSurface>;

struct AbaqusMaterial {
  Material isotropic;
  PlyMaterial ply;
  bool is_isotropic = true;
  bool is_for_solids_alone = false;
  /// What a solid has of it where it is not isotropic, in axes of its own.
  std::optional<Elasticity> of_solids = std::nullopt;
  ExpansionStrains expansion = ExpansionStrains::Zero();  ///< in axes of its own
  std::string obstacle = {};                              ///< MaterialExpansion's
  SourceLine line;
  int place = -1;              ///< in Mesh::materials
  int directional_place = -1;  ///< there too, of its nearest isotropic one
};

/// What the stages of reading share.
struct AbaqusModel {
  AbaqusModel(DeckLog& the_log, Deck& the_deck, const DeckOptions& the_options)
      : log(the_log), deck(the_deck), options(the_options), units(the_deck.units) {}

  DeckLog& log;
  Deck& deck;
  const DeckOptions& options;
  const UnitSystem units;
  std::vector<AbaqusScope> scopes;  ///< the first is the model's own, the last the assembly's
  std::vector<AbaqusDeckElement> elements;
  std::vector<const AbaqusBlock*> model_blocks;
  std::vector<std::vector<const AbaqusBlock*>> steps;
  std::map<std::string, AbaqusSurface> surfaces;  ///< NamedAbaqusSurface
  std::map<std::string, AbaqusMaterial> materials;
  std::unordered_map<int, Eigen::Matrix3d> axes_of;  ///< vertices with a system of their own
  std::vector<SurfacePoint> middles;
  /// Nodes whose displacements stand for the rotations of others (ROT NODE of a rigid body, as
  /// CalculiX has it), and the others.
  std::unordered_map<int, int> turns_of;
  SourceLine line_read;

  /// Does something with a block; notes what is wrong and that it was used.
  void guarded(const AbaqusBlock& block, const std::function<void()>& step);
  /// Does something with each line of a block, which `line_read` tells.
  void for_lines(const AbaqusBlock& block,
                 const std::function<void(const std::vector<std::string_view>&)>& step);

  /// Vertices that a number, a set's name, or instance.either stands for. @throws CardError for
  /// none.
  std::vector<int> nodes_of(const AbaqusScope& scope, std::string_view text) const;
  int node_of(const AbaqusScope& scope, std::string_view text) const;
  std::vector<int> elements_of(const AbaqusScope& scope, std::string_view text) const;
  /// The surface that a keyword in a scope makes; it is new if there is none.
  AbaqusSurface& surface_of(const AbaqusScope& scope, std::string_view name);
  /// The one that a name or instance.name means in a scope; null for none.
  const NamedAbaqusSurface* find_surface(const AbaqusScope& scope, std::string_view name) const;
  /// The same. @throws CardError for none, with the names of those that there are.
  const NamedAbaqusSurface& surface(const AbaqusScope& scope, std::string_view name) const;
  /// The vertex and the freedom, from 0, that a node's freedom stands for.
  /// @throws CardError for a rotation of a ROT NODE.
  std::pair<int, int> freedom_of(int vertex, int freedom) const;
  Eigen::Matrix3d axes(int vertex) const;
  const Vector3& place(int vertex) const { return deck.mesh.vertices[vertex]; }
};

/// Sorts blocks into parts, instances, assembly, model and steps; nodes, elements, sets, surfaces.
void read_abaqus_cells(AbaqusModel& model, const std::vector<AbaqusBlock>& blocks);
/// Materials, sections, and the shells and beams that have them.
void read_abaqus_sections(AbaqusModel& model);
/// Systems of axes at nodes, which springs, links, supports and loads count along.
void read_abaqus_transforms(AbaqusModel& model);
/// Vertices at the corners of a solid's face S1 to S6, each once.
/// @throws CardError for another name, and for a face whose nodes fall together.
std::vector<int> corners_of_face(const AbaqusDeckElement& solid, const std::string& face);
/// Masses, springs, couplings, rigid bodies, equations.
void read_abaqus_links(AbaqusModel& model);
/// Nodes tied to surfaces of shells.
void read_abaqus_ties(AbaqusModel& model);
/// Supports, loads and steps.
void read_abaqus_steps(AbaqusModel& model);

void read_abaqus_materials(AbaqusModel& model);
/// Place of a material in the mesh. @throws CardError if it does not exist or depends on direction.
int abaqus_material(AbaqusModel& model, const std::string& name);
/// The same for solids, which may depend on the direction.
int abaqus_solid_material(AbaqusModel& model, const std::string& name);

/// @throws CardError for a material of which plates have no stiffness.
void refuse_solids_alone(const AbaqusMaterial& material);

/// Makes solids of the elements that a section has, of a place in the mesh's materials and one of
/// its regions.
void add_abaqus_solids(AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& section,
                       const std::vector<int>& elements, int material, int region);
/// Gives solids the middles of their edges.
void complete_abaqus_solids(AbaqusModel& model);

}  // namespace blocklift::structure

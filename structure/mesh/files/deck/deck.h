#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "structure/error.h"
#include "structure/mesh/heat.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/mesh_part.h"

namespace blocklift::structure {

/// Units of a deck, seconds being those of time: masses count in force s^2 / length, so that
/// Newton's law needs no factor.
struct UnitSystem {
  std::string name = "m-kg-N";
  double length = 1;  ///< m
  double force = 1;   ///< N

  double mass() const { return force / length; }                          ///< kg
  double stress() const { return force / (length * length); }             ///< Pa
  double density() const { return mass() / (length * length * length); }  ///< kg/m^3
  double moment() const { return force * length; }                        ///< N m
};

/// m-kg-N, mm-t-N (MPa), m-t-kN, m-kt-MN (MPa), in-slinch-lbf (psi; also in-lbf), ft-slug-lbf.
/// @throws ModelError naming them all if there is none of this name.
UnitSystem unit_system(const std::string& name);

/// A card or keyword that a deck has, and what became of it.
struct LedgerEntry {
  std::string name;      ///< in capitals, such as CQUAD4 or *SHELL SECTION
  int read = 0;          ///< how many the deck has
  int used = 0;          ///< how many of them are in the model
  std::string left_out;  ///< why the rest, or a part of each, is not; empty: all is used
  std::string place;     ///< file:line of the first
  bool is_wish = false;  ///< what a solver is to print, or how it is to go about
};

/// What a user of the deck should know; not an error.
struct DeckRemark {
  std::string place;  ///< file:line
  std::string text;
  int count = 1;  ///< how often it holds; the place is the first one
};

/// Freedoms held at a vertex, along axes of its own.
struct Support {
  int vertex = 0;
  std::array<bool, 6> held{};
  std::array<double, 6> value{};                       ///< m or rad
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns
};

/// An equation between motions whose forces are not in balance: it resists motions of the block as
/// a whole, and holds it as supports do (rollers on a slope, faces that stay parallel, skew
/// symmetry).
struct HoldingEquation {
  MotionEquation equation;
  std::string place;  ///< file:line
};

struct SupportSet {
  long label = 0;
  std::string name;
  std::vector<Support> supports;
};

struct PointLoad {
  int vertex = 0;
  Vector3 force = Vector3::Zero();   ///< N
  Vector3 moment = Vector3::Zero();  ///< N m
};

struct LocalSystem;

/// Pressure on a shell, linear between its corners.
struct PlateLoad {
  int shell = 0;
  std::array<double, 4> pressure{};     ///< at the corners, in the shell's order of vertices, Pa
  Vector3 direction = Vector3::Zero();  ///< unit vector; without length: along the normal
  /// About a cylinder or sphere, at each place in whose directions the vector is (in m); none: it
  /// is one vector everywhere, along the world's axes.
  std::shared_ptr<const LocalSystem> system = nullptr;
};

/// Pressure on a face of a solid, linear between its corners.
struct SolidLoad {
  int solid = 0;
  int face = 0;                         ///< place among the faces of the solid's topology
  std::array<double, 4> pressure{};     ///< at the face's corners, in their order there, Pa
  Vector3 direction = Vector3::Zero();  ///< unit vector; without length: into the solid
  std::shared_ptr<const LocalSystem> system = nullptr;  ///< as a plate's
};

/// Load along a beam between two shares of its length, linear in place; at one place where both
/// are the same.
struct BeamLoad {
  int beam = 0;
  std::array<double, 2> span{0, 1};  ///< from the beam's first vertex
  /// Where it begins and ends, along the world's axes: N and N m per m of the line that bears it,
  /// or, at one place, N and N m (the first alone).
  std::array<Vector3, 2> force{Vector3::Zero(), Vector3::Zero()};
  std::array<Vector3, 2> moment{Vector3::Zero(), Vector3::Zero()};
  /// Of the line that bears it from that between the vertices, at the beam's ends, m.
  std::array<Vector3, 2> arm{Vector3::Zero(), Vector3::Zero()};

  bool is_at_a_place() const { return span[0] == span[1]; }
};

/// Force per length of a shell's edge.
struct EdgeLoad {
  int shell = 0;
  int edge = 0;                     ///< from 0, the corners taken in turn around the shell
  Vector3 force = Vector3::Zero();  ///< along the world's axes, N/m
  /// Along the edge as the corners turn, from it into the shell along its surface, and along the
  /// shell's normal, N/m.
  Vector3 own = Vector3::Zero();
};

/// Force per volume of a solid.
struct VolumeLoad {
  int solid = 0;
  Vector3 force = Vector3::Zero();  ///< along the world's axes, N/m^3
};

/// Turning about an axis that stays, as a load: what all masses feel of it.
struct Spin {
  Vector3 place = Vector3::Zero();     ///< on the axis, m
  Vector3 velocity = Vector3::Zero();  ///< w, rad/s: forces -w x (w x r) per mass, r from the place
  Vector3 acceleration = Vector3::Zero();          ///< a, rad/s^2: forces a x r per mass
  std::shared_ptr<const MeshPart> part = nullptr;  ///< whose masses feel it; none: all
};

/// Gravity that the masses of a part of the mesh feel.
struct PartPull {
  std::shared_ptr<const MeshPart> part;
  Vector3 acceleration = Vector3::Zero();  ///< m/s^2
};

struct LoadSet {
  long label = 0;
  std::string name;
  std::vector<PointLoad> point_loads;
  std::vector<PlateLoad> plate_loads;
  std::vector<SolidLoad> solid_loads;
  std::vector<BeamLoad> beam_loads;
  std::vector<EdgeLoad> edge_loads;
  std::vector<VolumeLoad> volume_loads;
  Vector3 gravity = Vector3::Zero();  ///< acceleration that all masses feel, m/s^2
  std::vector<PartPull> pulls;        ///< besides
  std::vector<Spin> spins;

  /// Do masses bear a load?
  bool is_on_masses() const { return !gravity.isZero(0) || !pulls.empty() || !spins.empty(); }
};

/// Subcase or step.
struct DeckLoadCase {
  long label = 0;
  std::string title;
  std::vector<std::pair<int, double>> loads;  ///< places in Deck::load_sets, with factors
  std::vector<int> supports;                  ///< places in Deck::support_sets
  int temperatures = -1;                      ///< place in Deck::temperatures; -1: none act
};

/// Named set of vertices or cells.
struct NamedSet {
  std::string name;
  std::vector<int> vertices, shells, beams;
};

/// What a deck of Nastran or Abaqus, a mesh of Gmsh or a geometry holds, in SI units, the user's
/// numbers beside it.
///
/// Vertices and cells are in the order of the file. Materials lack a yield stress where the deck
/// gives none (0); shells whose property is nowhere lack a section (-1) if the deck has no
/// properties at all, and `groups_without_thickness` names them; bars among these lack one if their
/// set is given a profile from outside, and are left out if not.
struct Deck {
  std::filesystem::path path;
  std::vector<std::filesystem::path> files;  ///< that were read: itself and what it includes
  UnitSystem units;
  std::string title;
  Mesh mesh;
  /// Where there are solids, so many of the mesh's vertices are nodes of the file; middles of their
  /// edges behind them were made by the reader. 0: not known.
  int own_vertices = 0;
  /// Middles of shells' edges that are nodes of the file, whether anything uses them or not.
  std::vector<SurfacePoint> shell_middles;
  std::vector<SupportSet> support_sets;
  std::vector<HoldingEquation> holding_equations;  ///< of all load cases; a lift has none
  std::vector<LoadSet> load_sets;
  std::vector<TemperatureField> temperatures;
  Expansions expansions;  ///< of the mesh's materials
  std::vector<DeckLoadCase> load_cases;
  std::vector<NamedSet> sets;
  std::vector<LedgerEntry> ledger;  ///< by name
  std::vector<DeckRemark> remarks;
  std::vector<std::string> groups_without_thickness;
  std::vector<std::string> groups_without_section;  ///< of beams whose section is -1
};

struct DeckOptions {
  bool leave_solids_out = false;  ///< list solid elements as left out rather than refuse them
  /// Cards and keywords ("*" before them or not) that are not known, and Abaqus' types of elements,
  /// known or not, all in capitals: they are listed as left out rather than refused.
  std::vector<std::string> leave_out = {};
  /// Sets of elements that are given a thickness or a profile from outside, where the deck has no
  /// sections at all; whatever their capitals.
  std::vector<std::string> groups_of_plates = {}, groups_of_bars = {};
};

/// All that is wrong with a deck; the message has a line for each.
class DeckError : public ModelError {
 public:
  explicit DeckError(std::vector<std::string> complaints);
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::vector<std::string> complaints_;
};

/// The ledger as lines of text: card, how many were read and used, what was left out and why.
std::string describe_ledger(const Deck& deck);

}  // namespace blocklift::structure

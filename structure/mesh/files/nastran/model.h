#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "structure/mesh/files/deck/coordinate_systems.h"
#include "structure/mesh/files/nastran/card.h"
#include "structure/mesh/heat.h"
#include "structure/mesh/laminate.h"

namespace blocklift::structure {

/// Material card, in SI units.
struct NastranMaterial {
  PlyMaterial ply;
  Material isotropic;  ///< where is_isotropic
  bool is_isotropic = true;
  bool is_matrix = false;  ///< MAT2: its shear across the plate is known as MID3 alone
  /// MAT1 whose E and G stand for no Poisson's ratio of a plate or solid: it has no ply.
  bool is_for_bars_alone = false;
  /// MAT9, MAT11: what a solid has of it, in axes of its own.
  std::optional<Elasticity> of_solids = std::nullopt;
  ExpansionStrains expansion = ExpansionStrains::Zero();  ///< in the same axes
  double reference = 0;                                   ///< TREF
  std::string obstacle = {};                              ///< MaterialExpansion's
};

/// Section of a beam between its ends.
struct NastranStation {
  double share = 0;  ///< of the length from its first end
  int section = 0;   ///< place in Mesh::beam_sections
  /// Centroid from the line that the element's offsets lead to, along axes 2 and 3, m.
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
};

/// Property of a bar, beam or rod.
struct NastranBar {
  int section = 0;       ///< place in Mesh::beam_sections
  int end_section = -1;  ///< at its second end where a beam tapers
  bool is_rod = false;   ///< no stiffness against bending
  /// Centroid from the line that the element's offsets lead to, along axes 2 and 3, m.
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_centroid = Eigen::Vector2d::Zero();  ///< the same at the second end
  /// In their order, where the section is not linear from end to end: what it is linear between.
  std::vector<NastranStation> stations = {};
};

/// Properties of plates of which the same is said: how many, the first, and the worst of them.
struct NastranPlates {
  int count = 0;
  SourceLine line;   ///< of the first
  std::string name;  ///< of the first
  double membrane_error = 0, bending_error = 0, shear_error = 0;

  void add(SourceLine at, const std::string& property);
};

/// What the stages of reading share; all maps go from the user's numbers to places in the mesh.
struct NastranModel {
  NastranModel(const NastranBulk& cards, DeckLog& the_log, Deck& the_deck,
               const DeckOptions& the_options)
      : bulk(cards), log(the_log), deck(the_deck), options(the_options), units(the_deck.units) {}

  const NastranBulk& bulk;
  DeckLog& log;
  Deck& deck;
  const DeckOptions& options;
  const UnitSystem units;
  CoordinateSystems systems;  ///< in the deck's units
  double mass_factor = 1;     ///< PARAM WTMASS
  std::unordered_map<long, int> vertex_of, shell_of, region_of;
  std::unordered_map<long, int> beam_of;  ///< of several pieces the first; they are in a row
  /// What CBAR and CBEAM give, m, by their first pieces: lines that bear their PLOAD1.
  std::unordered_map<int, std::array<Vector3, 2>> offsets_of_bar;
  std::vector<long> output_system;  ///< of each vertex
  /// Whose cards are wrong: what names them is left out without a word.
  std::unordered_set<long> unusable_grids;
  /// Numbers that are taken: by plates, bars and springs; by rigid elements; by masses.
  std::array<std::unordered_map<long, SourceLine>, 3> elements;
  std::unordered_set<long> solids;                   ///< read or left out
  std::unordered_set<long> solid_properties;         ///< that solids have
  std::unordered_set<long> any_elements;             ///< that the deck has, known here or not
  std::vector<std::pair<long, long>> scalar_points;  ///< ranges of numbers, ends included
  std::unordered_map<long, CardView> materials, properties;
  std::unordered_map<long, NastranMaterial> material_read;
  std::unordered_map<long, int> material_place;
  std::unordered_map<long, NastranBar> bar_read;
  std::map<std::tuple<long, double, double>, int>
      shell_section_of;        ///< property, thickness, offset
  NastranPlates layered;       ///< whose stiffness no plate of one material has
  NastranPlates rigid_plates;  ///< that shear across does not deform
  /// Shells whose edges' middles are vertices that other things may use: vertex, shell, place on
  /// it.
  std::vector<SurfacePoint> middles;

  using Handler = std::function<void(const CardView&)>;
  using Handlers = std::unordered_map<std::string, Handler>;
  /// Hands every card to its handler; counts those that go through as used, notes what is wrong.
  void for_each(const Handlers& handlers);

  /// @throws CardError where there is no such grid, AlreadySaid where its card is wrong.
  int vertex(const CardView& card, std::size_t i, const char* what) const;
  const Vector3& place(int vertex) const { return deck.mesh.vertices[vertex]; }
  /// Is a point one without a place (SPOINT, EPOINT)?
  bool is_scalar_point(long label) const;
  /// The pieces of a beam, by the place of the first.
  std::vector<int> pieces_of_beam(int first) const;
  /// Directions of a grid's displacements, columns.
  Eigen::Matrix3d output_axes(int vertex);
  /// A vector given in a coordinate system, as seen from a vertex.
  Eigen::Matrix3d axes_at(long system, int vertex);
  /// Takes an element's number. @throws CardError if it is taken.
  long new_element(const CardView& card);
};

/// Whether a line of case control is PARAM,WTMASS.
bool is_nastran_mass_factor(std::string_view case_control);
/// Coordinate systems, grids, PARAM WTMASS, and where materials and properties stand.
void read_nastran_grids(NastranModel& model);
/// CQUAD4 and so on, CBAR and so on, with their properties.
void read_nastran_cells(NastranModel& model);
/// CHEXA, CPENTA, CTETRA and CPYRAM with PSOLID.
void read_nastran_solids(NastranModel& model);
/// CONM1, CONM2, CMASS1, CMASS2.
void read_nastran_masses(NastranModel& model);
/// CSHEAR with PSHEAR.
void read_nastran_shear_panels(NastranModel& model);
/// RBE1, RBE2, RBAR, RROD, RTRPLT, RJOINT.
void read_nastran_links(NastranModel& model);
/// RSPLINE.
void read_nastran_splines(NastranModel& model);
/// CELAS1, CELAS2, CBUSH, CBUSH1D.
void read_nastran_springs(NastranModel& model);
/// Spreads the mass of a set (NSM, NSM1, NSML, NSML1, NSMADD) over its cells.
/// @throws CardError if there is no such set.
void use_nonstructural_mass(NastranModel& model, long set);
/// Supports and loads by their sets, and case control that combines them.
void read_nastran_cases(NastranModel& model);
/// RBE3, when all that resists the motion of their grids is read: cells, springs, other links and
/// equations.
void read_nastran_means(NastranModel& model);
/// Fills the deck's load sets; FORCE, MOMENT, PLOAD2, PLOAD4, GRAV and the like.
/// @returns places of the sets by their numbers
std::map<long, int> read_nastran_loads(NastranModel& model);
/// Puts A and TREF of a material card into the material. @throws CardError if they are no numbers.
void read_nastran_expansion(const NastranModel& model, const CardView& card,
                            NastranMaterial& material);
/// Counts all cards; complains of those that no stage reads, notes those that have no use here.
void take_stock_of_nastran_cards(NastranModel& model);
/// Whether a card is a load, read or noted as left out, or one of a name that is not known, which
/// may stand for a load's.
bool may_be_nastran_load(std::string_view name);

/// A grid, property or material that something needs is wrong, and that has been said at its own
/// line.
struct AlreadySaid : CardError {};

/// @throws CardError if there is no such material; AlreadySaid if what it says cannot be.
const NastranMaterial& nastran_material(NastranModel& model, long number);
/// The same; @throws CardError also if no plate can be of it.
const NastranMaterial& nastran_plate_material(NastranModel& model, long number);
/// Place of an isotropic material in the mesh. @throws CardError also if it is not isotropic.
int nastran_material_place(NastranModel& model, long number);
/// Section of a shell with a property, a thickness of its own (0: the property's) and an offset, m.
/// -1 if the deck has no properties at all.
int nastran_shell_section(NastranModel& model, long property, double thickness, double offset);
/// Offset of a plate's middle from its grids, m: a number, or, as OptiStruct has it, which of its
/// surfaces (TOP, BOTTOM) lies in the grids' plane. @throws CardError for anything else.
double nastran_plate_offset(const NastranModel& model, const CardView& card, std::size_t field,
                            double thickness);
/// Thickness that a property gives, m; 0: none.
double nastran_shell_thickness(NastranModel& model, long property);
const NastranBar& nastran_bar(NastranModel& model, long property);
/// Section of a CONROD, which needs no property.
int nastran_rod_section(NastranModel& model, const std::string& name, long label, long material,
                        double area, double torsion, double mass_per_length);
/// Says once what holds for several properties of plates.
void remark_on_nastran_plates(NastranModel& model);
/// Region of a property's cells: one group and region each.
int nastran_region(NastranModel& model, long property, int material);

}  // namespace blocklift::structure

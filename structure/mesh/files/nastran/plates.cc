// Materials and the properties of shells.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/directional.h"
#include "structure/mesh/files/deck/plausibility.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// MAT1 MID E G NU RHO A TREF GE / ST SC SS
NastranMaterial read_isotropic(NastranModel& model, const CardView& card) {
  NastranMaterial material;
  Material& solid = material.isotropic;
  const double stress = model.units.stress();
  solid.name = fmt::format("MAT1 {}", card.text(0));
  solid.density = card.real(4, "density", 0.0) * model.units.density() * model.mass_factor;
  solid.yield_stress = card.real(8, "limit of tension", 0.0) * stress;
  const bool has_modulus = card.has(1), has_shear = card.has(2), has_ratio = card.has(3);
  if (!has_modulus && !(has_shear && has_ratio))
    throw CardError{fmt::format("{} has no Young's modulus", solid.name)};
  const double shear = card.real(2, "shear modulus", 0.0) * stress;
  solid.poisson_ratio = card.real(3, "Poisson's ratio", 0.0);
  solid.youngs_modulus = has_modulus ? card.real(1, "Young's modulus") * stress
                                     : 2 * (1 + solid.poisson_ratio) * shear;
  if (has_modulus && has_shear && !has_ratio && shear > 0)
    solid.poisson_ratio = solid.youngs_modulus / (2 * shear) - 1;
  check_plausible(solid, solid.name, model.units, model.log, card.line());
  if (has_modulus && has_shear && has_ratio && std::abs(shear / solid.shear_modulus() - 1) > 1e-3)
    model.log.remark(card.line(),
                     fmt::format("{}: G is {:.2g} % {} than what E and nu give; E and nu are used",
                                 solid.name, 100 * std::abs(shear / solid.shear_modulus() - 1),
                                 shear > solid.shear_modulus() ? "more" : "less"));
  material.is_for_bars_alone = !(solid.poisson_ratio > -1 && solid.poisson_ratio < 0.5);
  if (!material.is_for_bars_alone) material.ply = isotropic_ply(solid);
  return material;
}

/// Cores of sandwich plates are soft along the plate, Pa.
constexpr double least_modulus_of_cores = 1e3;

/// MAT8 MID E1 E2 NU12 G12 G1Z G2Z RHO
NastranMaterial read_orthotropic(NastranModel& model, const CardView& card) {
  const double stress = model.units.stress();
  const double modulus_1 = card.real(1, "E1") * stress, modulus_2 = card.real(2, "E2") * stress;
  const double ratio = card.real(3, "NU12"), shear = card.real(4, "G12", 0.0) * stress;
  const auto across = [&](std::size_t i, const char* what) {
    const double value = card.real(i, what, 0.0) * stress;
    return value > 0 ? value : infinity;
  };
  const double density = card.real(7, "density", 0.0) * model.units.density() * model.mass_factor;
  const std::string name = fmt::format("MAT8 {}", card.text(0));
  if (!(modulus_1 > 0 && modulus_2 > 0 && shear > 0 && ratio * ratio * modulus_2 < modulus_1))
    throw CardError{
        fmt::format("{}: E1, E2 and G12 must be positive and NU12^2 E2 less than E1", name)};
  NastranMaterial material;
  material.ply = orthotropic_ply(modulus_1, modulus_2, ratio, shear, across(5, "G1Z"),
                                 across(6, "G2Z"), density);
  material.isotropic = {
      .name = name, .youngs_modulus = modulus_1, .poisson_ratio = ratio, .density = density};
  check_plausible({.name = name,
                   .youngs_modulus = std::max(modulus_1, modulus_2),
                   .poisson_ratio = 0,
                   .density = density},
                  name, model.units, model.log, card.line(), least_modulus_of_cores);
  const double own_shear = modulus_1 / (2 * (1 + ratio));
  material.is_isotropic =
      std::abs(modulus_2 / modulus_1 - 1) < 1e-3 && std::abs(shear / own_shear - 1) < 1e-3;
  return material;
}

/// MAT2 MID G11 G12 G13 G22 G23 G33 RHO
NastranMaterial read_anisotropic(NastranModel& model, const CardView& card) {
  const double stress = model.units.stress();
  // All are read before any is put in: Eigen's list must not be left half given by an error.
  std::array<double, 7> e{};
  for (std::size_t i = 1; i < e.size(); ++i) e[i] = card.real(i, "stiffness", 0.0) * stress;
  NastranMaterial material;
  Eigen::Matrix3d& g = material.ply.in_plane;
  g << e[1], e[2], e[3], e[2], e[4], e[5], e[3], e[5], e[6];
  // Across the plate MAT2 is read in the first two rows.
  material.ply.shear << g(0, 0), g(1, 1);
  material.ply.density = card.real(7, "density", 0.0) * model.units.density() * model.mass_factor;
  material.is_isotropic = false;
  material.is_matrix = true;
  return material;
}

/// What MAT9 and MAT11 have in common: the elasticity in axes of its own, Pa.
NastranMaterial of_solids(NastranModel& model, const CardView& card, const Elasticity& elasticity,
                          double density) {
  const std::string name = fmt::format("{} {}", card.name(), card.text(0));
  if (!is_positive(elasticity))
    throw CardError{
        fmt::format("{}: the constants belong to no material: its energy is not positive", name)};
  NastranMaterial material;
  material.isotropic = nearest_isotropic(elasticity);
  material.isotropic.name = name;
  material.isotropic.density = density * model.units.density() * model.mass_factor;
  check_plausible(material.isotropic, name, model.units, model.log, card.line(),
                  least_modulus_of_cores);
  material.is_isotropic = is_isotropic(elasticity);
  if (material.is_isotropic)
    material.ply = isotropic_ply(material.isotropic);
  else
    material.of_solids = elasticity;
  return material;
}

/// MAT9 MID G11 G12 G13 G14 G15 G16 G22 / G23 ... G36 / G44 G45 G46 G55 G56 G66 RHO
NastranMaterial read_solid_matrix(NastranModel& model, const CardView& card) {
  Elasticity elasticity;
  std::size_t field = 1;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = i; j < 6; ++j)
      elasticity(i, j) = elasticity(j, i) =
          card.real(field++, "stiffness", 0.0) * model.units.stress();
  return of_solids(model, card, elasticity, card.real(field, "density", 0.0));
}

/// MAT11 MID E1 E2 E3 NU12 NU13 NU23 G12 / G13 G23 RHO
NastranMaterial read_solid_constants(NastranModel& model, const CardView& card) {
  std::array<double, 9> v{};
  static constexpr std::array<const char*, 9> names{"E1",   "E2",  "E3",  "NU12", "NU13",
                                                    "NU23", "G12", "G13", "G23"};
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = card.real(i + 1, names[i]) * (i >= 3 && i < 6 ? 1.0 : model.units.stress());
  const OrthotropicConstants constants{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
  return of_solids(model, card, orthotropic_elasticity(constants), card.real(10, "density", 0.0));
}

/// A plate's layers, whose stiffness is that of a plate of one material or is kept beside it.
struct Plate {
  double thickness = 0, offset = 0, mass_per_area = 0;
  double mass_of_layers = 0;  ///< kg/m^2
  int material = -1;          ///< of one isotropic material; -1: the laminate says it
  Laminate laminate;
  LaminateExpansion expansion;
  std::string name;
};

/// What layers' materials say of their expansion beside the coefficients.
void note_expansion(const NastranMaterial& material, bool is_first, LaminateExpansion& expansion) {
  if (expansion.obstacle.empty()) expansion.obstacle = material.obstacle;
  if (is_first)
    expansion.reference = material.reference;
  else if (expansion.obstacle.empty() && material.reference != expansion.reference)
    expansion.obstacle = "its layers differ in their reference temperature (TREF)";
}

/// Expansion of a plate whose membrane, coupling and bending stiffness are of materials each.
LaminateExpansion join_expansions(const std::array<NastranMaterial, 3>& materials,
                                  const std::array<Eigen::Matrix3d, 3>& stiffnesses) {
  LaminateExpansion expansion;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Eigen::Vector3d& strains = materials[i].ply.expansion;
    expansion.forces[i] = stiffnesses[i] * strains;
    expansion.energies[i] = strains.dot(expansion.forces[i]);
    if (i == 0 || !stiffnesses[i].isZero(0)) note_expansion(materials[i], i == 0, expansion);
  }
  return expansion;
}

/// PSHELL PID MID1 T MID2 12I/T3 MID3 TS/T NSM / Z1 Z2 MID4, and in OptiStruct T0 ZOFFS
Plate read_shell(NastranModel& model, const CardView& card, double own_thickness) {
  Plate plate;
  plate.name = fmt::format("PSHELL {}", card.text(0));
  const double length = model.units.length;
  plate.thickness = own_thickness > 0 ? own_thickness : card.real(2, "thickness", 0.0) * length;
  if (!(plate.thickness > 0))
    throw CardError{fmt::format("{} has no positive thickness, nor have its elements", plate.name)};
  if (!card.has(1))
    throw CardError{fmt::format("{} has no material for membrane forces", plate.name)};
  const long membrane_number = card.label(1, "MID1");
  const NastranMaterial membrane = nastran_plate_material(model, membrane_number);
  const double t = plate.thickness;
  plate.mass_per_area = card.real(7, "mass beyond the plate's", 0.0) * model.units.mass() /
                        (length * length) * model.mass_factor;
  plate.mass_of_layers = membrane.ply.density * t;
  if (card.is(3, "-1"))
    throw CardError{fmt::format("{} is in plane strain, which a block is not", plate.name)};
  if (!card.has(3)) model.log.leave_out("PSHELL", "a blank MID2 (no bending): plates bend here");
  const long bending_number = card.label(3, "MID2", membrane_number);
  const double bending_ratio = card.real(4, "12I/T3", 1.0);
  const long shear_number = card.label(5, "MID3", bending_number);
  const double shear_ratio = card.real(6, "TS/T", 5.0 / 6);
  if (!(bending_ratio > 0 && shear_ratio > 0))
    throw CardError{fmt::format("{}: 12I/T3 and TS/T must be positive", plate.name)};
  if (card.has(8) || card.has(9))
    model.log.leave_out("PSHELL", "Z1, Z2: stresses are those of the surfaces");
  if (card.has(11)) model.log.leave_out("PSHELL", "T0, the least thickness of an optimisation");
  plate.offset = nastran_plate_offset(model, card, 12, t);
  const bool is_plain = membrane.is_isotropic && bending_number == membrane_number &&
                        shear_number == membrane_number && std::abs(bending_ratio - 1) < 1e-6 &&
                        std::abs(shear_ratio - 5.0 / 6) < 2e-3 && !card.has(10);
  if (is_plain) {
    plate.material = nastran_material_place(model, membrane_number);
    return plate;
  }
  const NastranMaterial bending = nastran_plate_material(model, bending_number);
  const NastranMaterial shear = nastran_plate_material(model, shear_number);
  plate.laminate.membrane = membrane.ply.in_plane * t;
  plate.laminate.bending = bending.ply.in_plane * bending_ratio * t * t * t / 12;
  // What bends by a matrix of its own says nothing of shear across the plate.
  const bool is_rigid = !card.has(5) && bending.is_matrix;
  const Eigen::Vector2d across = is_rigid ? Eigen::Vector2d::Constant(infinity) : shear.ply.shear;
  plate.laminate.shear = (across * shear_ratio * t).asDiagonal();
  NastranMaterial couple;
  if (card.has(10)) couple = nastran_plate_material(model, card.label(10, "MID4"));
  plate.laminate.coupling = couple.ply.in_plane * t * t;
  plate.expansion =
      join_expansions({membrane, couple, bending},
                      {plate.laminate.membrane, plate.laminate.coupling, plate.laminate.bending});
  return plate;
}

/// The first obstacle that materials have in themselves.
std::string of_layers(NastranModel& model, const std::vector<long>& numbers) {
  for (const long number : numbers)
    if (const NastranMaterial& material = nastran_plate_material(model, number);
        !material.obstacle.empty())
      return material.obstacle;
  return {};
}

/// Makes a material of the mesh one that refers to another temperature.
void refer_to(double reference, Deck& deck, int& material) {
  MaterialExpansion expansion = deck.expansions.of_materials[at(material)];
  if (expansion.reference == reference) return;
  expansion.reference = reference;
  const Material same = deck.mesh.materials[at(material)];
  material = static_cast<int>(deck.mesh.materials.size());
  deck.mesh.materials.push_back(same);
  deck.expansions.set(material, expansion);
}

/// PCOMP PID Z0 NSM SB FT TREF GE LAM / MID1 T1 THETA1 SOUT1 MID2 ...
/// PCOMPG PID Z0 NSM SB FT TREF GE LAM / GPLYID1 MID1 T1 THETA1 SOUT1 / GPLYID2 ...
Plate read_layers(NastranModel& model, const CardView& card) {
  Plate plate;
  plate.name = fmt::format("{} {}", card.name(), card.text(0));
  const bool is_numbered = card.name() == "PCOMPG";
  const double length = model.units.length;
  const bool mirrored = card.is(7, "SYM"), smeared = card.is(7, "SMEAR");
  if (card.has(7) && !mirrored && !smeared)
    throw CardError{
        fmt::format("{}: LAM = {} is not known; SYM and SMEAR are", plate.name, card.text(7))};
  std::vector<Ply> plies;
  std::vector<long> numbers;
  for (std::size_t i = is_numbered ? 9 : 8; i < card.size(); i += is_numbered ? 8 : 4) {
    if (!card.has(i) && !card.has(i + 1) && !card.has(i + 2)) continue;
    const bool first = plies.empty();
    numbers.push_back(first ? card.label(i, "material of a layer")
                            : card.label(i, "material of a layer", numbers.back()));
    Ply ply;
    const NastranMaterial& material = nastran_plate_material(model, numbers.back());
    ply.material = material.ply;
    note_expansion(material, first, plate.expansion);
    ply.thickness = first || card.has(i + 1) ? card.real(i + 1, "thickness of a layer") * length
                                             : plies.back().thickness;
    ply.angle = card.real(i + 2, "angle of a layer", 0.0) * std::numbers::pi / 180;
    if (!(ply.thickness > 0))
      throw CardError{fmt::format("{}: a layer has no positive thickness", plate.name)};
    plies.push_back(ply);
  }
  if (plies.empty()) throw CardError{fmt::format("{} has no layers", plate.name)};
  if (mirrored)
    for (std::size_t i = plies.size(); i-- > 0;) plies.push_back(plies[i]);
  for (const Ply& ply : plies) {
    plate.thickness += ply.thickness;
    plate.mass_of_layers += ply.material.density * ply.thickness;
  }
  plate.laminate = stack(plies);
  const LaminateExpansion said = plate.expansion;
  plate.expansion = expansion_of(plies);
  plate.expansion.reference = card.real(5, "TREF", said.reference);
  // A reference of the plate's own takes the place of its layers'.
  plate.expansion.obstacle = card.has(5) ? of_layers(model, numbers) : said.obstacle;
  if (smeared) {
    const double share = plate.thickness * plate.thickness / 12;
    plate.laminate.coupling.setZero();
    plate.laminate.bending = plate.laminate.membrane * share;
    plate.expansion.forces[1].setZero();
    plate.expansion.forces[2] = share * plate.expansion.forces[0];
    plate.expansion.energies.tail<2>() << 0, share * plate.expansion.energies[0];
  }
  // A number is the place of the lower surface.
  if (card.has(1))
    plate.offset = nastran_plate_offset(model, card, 1, plate.thickness) +
                   (to_real(card.text(1)) ? plate.thickness / 2 : 0);
  plate.mass_per_area = card.real(2, "mass beyond the plate's", 0.0) * model.units.mass() /
                        (length * length) * model.mass_factor;
  const bool one_material = std::all_of(numbers.begin(), numbers.end(),
                                        [&](long number) { return number == numbers.front(); });
  if (one_material && nastran_plate_material(model, numbers.front()).is_isotropic) {
    plate.material = nastran_material_place(model, numbers.front());
    refer_to(plate.expansion.reference, model.deck, plate.material);
  }
  return plate;
}

/// Where the laminate is rigid across, the plate is taken as its own material would be.
void bound_shear(NastranModel& model, const CardView& card, Plate& plate) {
  if (plate.laminate.shear.allFinite()) return;
  const double shear = 5.0 / 6 * plate.laminate.membrane(2, 2);
  plate.laminate.shear = Eigen::Vector2d(shear, shear).asDiagonal();
  model.rigid_plates.add(card.line(), plate.name);
}

NastranMaterial read_material(NastranModel& model, const CardView& card, long number) {
  if (card.name() == "MAT1") return read_isotropic(model, card);
  if (card.name() == "MAT8") return read_orthotropic(model, card);
  if (card.name() == "MAT2") return read_anisotropic(model, card);
  if (card.name() == "MAT9") return read_solid_matrix(model, card);
  if (card.name() == "MAT11") return read_solid_constants(model, card);
  throw CardError{
      fmt::format("material {} is a {}, which nothing here can be of", number, card.name())};
}

int add_section(NastranModel& model, const CardView& card, Plate plate, double offset) {
  Mesh& mesh = model.deck.mesh;
  ShellSection section;
  section.thickness = plate.thickness;
  // What an element says goes before its PSHELL's, and is added to that of layers.
  const bool is_own = offset != 0 && card.name() == "PSHELL";
  section.offset = is_own ? offset : plate.offset + offset;
  section.mass_per_area = plate.mass_per_area;
  section.label = card.label(0, "property");
  section.material = plate.material;
  if (plate.material < 0) {
    bound_shear(model, card, plate);
    const NearestPlate nearest = nearest_plate(plate.laminate, plate.thickness);
    Material material{.name = plate.name,
                      .youngs_modulus = nearest.youngs_modulus,
                      .poisson_ratio = nearest.poisson_ratio,
                      .density = plate.mass_of_layers / plate.thickness};
    check_plausible(material, plate.name, model.units, model.log, card.line());
    check_poisson_ratio(material, plate.name);
    section.material = static_cast<int>(mesh.materials.size());
    mesh.materials.push_back(material);
    const std::optional<double> coefficient =
        even_coefficient(plate.expansion, nearest, plate.thickness);
    model.deck.expansions.set(section.material, {coefficient.value_or(0), plate.expansion.reference,
                                                 plate.expansion.obstacle});
    if (!nearest.is_exact() || !coefficient) {
      section.laminate = static_cast<int>(mesh.laminates.size());
      mesh.laminates.push_back(plate.laminate);
      model.deck.expansions.of_laminates.push_back(plate.expansion);
      NastranPlates& layered = model.layered;
      layered.add(card.line(), plate.name);
      layered.membrane_error = std::max(layered.membrane_error, nearest.membrane_error);
      layered.bending_error = std::max(layered.bending_error, nearest.bending_error);
      layered.shear_error = std::max(layered.shear_error, nearest.shear_error);
    }
  }
  mesh.shell_sections.push_back(section);
  return static_cast<int>(mesh.shell_sections.size()) - 1;
}

bool is_of_plates(const CardView& property) {
  return property.name() == "PSHELL" || property.name() == "PCOMP" || property.name() == "PCOMPG";
}

const CardView* shell_property(NastranModel& model, long property) {
  const auto found = model.properties.find(property);
  if (found != model.properties.end()) {
    const CardView& card = found->second;
    if (!is_of_plates(card))
      throw CardError{fmt::format("a shell has property {}, which is a {}", property, card.name())};
    return &card;
  }
  const bool has_any = std::any_of(model.properties.begin(), model.properties.end(),
                                   [](const auto& entry) { return is_of_plates(entry.second); });
  if (has_any) throw CardError{fmt::format("property {} does not exist", property)};
  return nullptr;
}

/// What is wrong with a property is said at its own line, once.
template <typename Read>
auto at_its_line(NastranModel& model, const CardView& card, const Read& read) {
  try {
    return read();
  } catch (const AlreadySaid&) {
    throw;
  } catch (const CardError& error) {
    model.log.complain(card.line(), card.name() + ": " + error.text);
    throw AlreadySaid{{fmt::format("{} {} cannot be used", card.name(), card.text(0))}};
  }
}

}  // namespace

const NastranMaterial& nastran_material(NastranModel& model, long number) {
  if (const auto known = model.material_read.find(number); known != model.material_read.end())
    return known->second;
  const auto found = model.materials.find(number);
  if (found == model.materials.end())
    throw CardError{fmt::format("material {} does not exist", number)};
  const CardView& card = found->second;
  const NastranMaterial material = at_its_line(model, card, [&] {
    NastranMaterial read = read_material(model, card, number);
    read_nastran_expansion(model, card, read);
    return read;
  });
  model.log.use(card.name());
  return model.material_read[number] = material;
}

const NastranMaterial& nastran_plate_material(NastranModel& model, long number) {
  const NastranMaterial& material = nastran_material(model, number);
  if (material.is_for_bars_alone) check_poisson_ratio(material.isotropic, material.isotropic.name);
  if (material.of_solids)
    throw CardError{fmt::format("{} is a material of solids; a plate takes MAT1, MAT2 or MAT8",
                                material.isotropic.name)};
  return material;
}

int nastran_material_place(NastranModel& model, long number) {
  if (const auto known = model.material_place.find(number); known != model.material_place.end())
    return known->second;
  const NastranMaterial& material = nastran_material(model, number);
  if (!material.is_isotropic)
    throw CardError{
        fmt::format("material {} depends on the direction; an isotropic one is due", number)};
  const auto place = static_cast<int>(model.deck.mesh.materials.size());
  model.deck.mesh.materials.push_back(material.isotropic);
  model.deck.expansions.set(place, even_expansion(material.expansion, material.reference,
                                                  material.obstacle, material.isotropic.name));
  return model.material_place[number] = place;
}

double nastran_plate_offset(const NastranModel& model, const CardView& card, std::size_t field,
                            double thickness) {
  const bool is_top = card.is(field, "TOP"), is_bottom = card.is(field, "BOTTOM");
  if (!is_top && !is_bottom) return card.real(field, "offset", 0.0) * model.units.length;
  if (!(thickness > 0))
    throw CardError{
        fmt::format("{} as offset of a plate whose thickness is not known here", card.text(field))};
  return (is_top ? -0.5 : 0.5) * thickness;
}

double nastran_shell_thickness(NastranModel& model, long property) {
  const CardView* card = shell_property(model, property);
  return card != nullptr && card->name() == "PSHELL"
             ? card->real(2, "thickness", 0.0) * model.units.length
             : 0.0;
}

int nastran_shell_section(NastranModel& model, long property, double thickness, double offset) {
  const auto key = std::tuple(property, thickness, offset);
  if (const auto known = model.shell_section_of.find(key); known != model.shell_section_of.end())
    return known->second;
  const CardView* card = shell_property(model, property);
  if (card == nullptr) return -1;
  const auto first = model.shell_section_of.lower_bound({property, -infinity, -infinity});
  const bool is_new =
      first == model.shell_section_of.end() || std::get<0>(first->first) != property;
  const int section = at_its_line(model, *card, [&] {
    const Plate plate =
        card->name() == "PSHELL" ? read_shell(model, *card, thickness) : read_layers(model, *card);
    return add_section(model, *card, plate, offset);
  });
  if (is_new) model.log.use(card->name());
  return model.shell_section_of[key] = section;
}

void NastranPlates::add(SourceLine at, const std::string& property) {
  if (count == 0) {
    line = at;
    name = property;
  }
  ++count;
}

void remark_on_nastran_plates(NastranModel& model) {
  const auto named = [](const NastranPlates& plates) {
    return plates.count == 1 ? fmt::format("{} is", plates.name)
                             : fmt::format("{} properties of plates, {} the first, are",
                                           plates.count, plates.name);
  };
  if (const NastranPlates& rigid = model.rigid_plates; rigid.count > 0)
    model.log.remark(rigid.line, named(rigid) +
                                     " rigid in shear across the plate; 5/6 of the membrane "
                                     "stiffness in shear is used");
  if (const NastranPlates& layered = model.layered; layered.count > 0)
    model.log.remark(
        layered.line,
        fmt::format(
            "{} layered, or of several stiffnesses, which are kept as they are; the plates "
            "of one material nearest to them would be off by up to {:.1f} % in membrane, {:.1f} "
            "% in bending, {:.1f} % in shear",
            named(layered), 100 * layered.membrane_error, 100 * layered.bending_error,
            100 * layered.shear_error));
}

int nastran_region(NastranModel& model, long property, int material) {
  if (const auto known = model.region_of.find(property); known != model.region_of.end())
    return known->second;
  Mesh& mesh = model.deck.mesh;
  const auto named = model.bulk.names.find({"PROP", property});
  const std::string name = property == 0                     ? "rods without property"
                           : named != model.bulk.names.end() ? named->second
                                                             : fmt::format("property {}", property);
  const auto group = static_cast<int>(mesh.groups.size());
  mesh.groups.push_back({name, material});
  mesh.regions.push_back({.name = name, .group = group});
  return model.region_of[property] = static_cast<int>(mesh.regions.size()) - 1;
}

}  // namespace blocklift::structure

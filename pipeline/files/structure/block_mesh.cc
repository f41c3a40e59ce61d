#include "pipeline/files/structure/block_mesh.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "pipeline/declaration/document.h"
#include "pipeline/declaration/table.h"
#include "pipeline/files/named_file.h"
#include "pipeline/files/structure/block_model.h"
#include "pipeline/files/structure/deck_supports.h"
#include "pipeline/files/structure/lugs_on_mesh.h"
#include "pipeline/formats/content_hash.h"
#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/mesh/files/abaqus/reader.h"
#include "structure/mesh/files/nastran/reader.h"
#include "structure/mesh/files/surfaces/cad_file.h"
#include "structure/mesh/files/surfaces/surface_reader.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using structure::Deck;
using structure::Mesh;

// The heaviest lifts are of some 50,000 t, the longest structures that are lifted of some 500 m.
constexpr double heaviest = 1e8;                   // kg
constexpr double longest = 1000, shortest = 0.05;  // m

/// Is a card or keyword one of loads or supports? A lift has its own.
bool is_of_loads(const std::string& name) {
  static const std::vector<std::string> beginnings{"FORCE",
                                                   "MOMENT",
                                                   "PLOAD",
                                                   "GRAV",
                                                   "RFORCE",
                                                   "LOAD",
                                                   "GRID (PS)",
                                                   "SPC",
                                                   "*CLOAD",
                                                   "*DLOAD",
                                                   "*DSLOAD",
                                                   "*BOUNDARY",
                                                   "TEMP",
                                                   "*TEMPERATURE",
                                                   "*INITIAL CONDITIONS",
                                                   "case control TEMP",
                                                   "case control LOAD",
                                                   "case control SPC"};
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& beginning) { return name.starts_with(beginning); });
}

/// A reader's complaint "file:line: error: text" by its parts.
void pass_on(const std::string& complaint, const Mark& otherwise, Diagnostics& diagnostics) {
  const std::string separator = ": error: ";
  const auto end = complaint.find(separator);
  if (end == std::string::npos) {
    diagnostics.error(otherwise, complaint);
    return;
  }
  Mark mark;
  std::string place = complaint.substr(0, end);
  const auto colon = place.rfind(':');
  if (colon != std::string::npos) {
    const char *first = place.data() + colon + 1, *last = place.data() + place.size();
    if (std::from_chars(first, last, mark.line).ptr == last)
      place.resize(colon);
    else
      mark.line = 0;
  }
  mark.file = std::make_shared<const std::string>(std::move(place));
  diagnostics.error(mark, complaint.substr(end + separator.size()));
}

/// What was found with the numbers of the first cells or nodes, where it is more than a note.
std::string described(const structure::Finding& finding) {
  constexpr std::size_t most = 5;
  if (finding.severity == structure::Severity::note || finding.labels.empty()) return finding.text;
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < std::min(most, finding.labels.size()); ++i)
    numbers.push_back(std::to_string(finding.labels[i]));
  return fmt::format("{}: {}{}", finding.text, fmt::join(numbers, ", "),
                     static_cast<std::size_t>(finding.count) > numbers.size() ? ", ..." : "");
}

class MeshReader {
 public:
  MeshReader(BlockModel& block, const fs::path& folder, std::vector<fs::path> homes, MeshUse use,
             Diagnostics& diagnostics)
      : block_(block),
        mesh_model_(*block.mesh),
        folder_(folder),
        homes_(std::move(homes)),
        use_(use),
        diagnostics_(diagnostics) {}

  void read() {
    const std::size_t before = diagnostics_.error_count();
    const auto deck = std::make_shared<Deck>();
    if (!read_deck(*deck)) return;
    if (deck->mesh.shells.empty() && deck->mesh.beams.empty() && deck->mesh.solids.empty()) {
      complain(mesh_model_.file.value + " has no plates, bars or solids", {"is it all there?"});
      return;
    }
    mesh_model_.content = hash_of_files(deck->files);
    give_properties(block_, *deck, diagnostics_);
    give_yield_stress(deck->mesh);
    give_tripping_brackets(deck->mesh);
    if (use_ == MeshUse::lift) {
      refuse_holding_equations(*deck);
      let_go(*deck);
    }
    remark_on_solids(*deck);
    if (diagnostics_.error_count() > before) return;
    mesh_model_.diagnosis =
        std::make_shared<const structure::Diagnosis>(structure::diagnose(deck->mesh));
    check_diagnosis(*deck);
    put_lugs(block_, *deck, diagnostics_);
    mesh_model_.deck = deck;
  }

 private:
  void complain(std::string message, std::vector<std::string> hints = {}) {
    diagnostics_.error(mesh_model_.file.mark, std::move(message), std::move(hints));
  }

  bool read_deck(Deck& deck) {
    const fs::path named = mesh_model_.file.value;
    const std::optional<fs::path> found =
        path_of_named_file(mesh_model_.file, folder_, diagnostics_, homes_);
    if (!found) return false;
    const fs::path& path = *found;
    const std::string ending = structure::ending_of(named);
    if (is_bare(mesh_model_) && !mesh_model_.leave_out.empty())
      diagnostics_.error(mesh_model_.leave_out.front().mark,
                         mesh_model_.file.value + " has neither cards nor keywords",
                         {"leave_out is for decks of Nastran and Abaqus"});
    const bool is_nastran = ending == ".bdf" || ending == ".nas" || ending == ".dat";
    const bool is_bare_file = is_bare(mesh_model_);
    if (!is_nastran && !is_bare_file && ending != ".inp") {
      complain(
          fmt::format("\"{}\" is no file that is known by its ending", named.string()),
          {"Nastran decks end in .bdf, .nas or .dat, Abaqus decks in .inp, meshes of Gmsh in "
           ".msh, universal files in .unv, CAD surfaces in .step, .stp, .iges, .igs or .brep"});
      return false;
    }
    if (!check_sizes(structure::is_cad_file(named.string()))) return false;
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
      complain(fmt::format("there is no file \"{}\"", shown_path(path)),
               {"its name counts from the folder of the block's file"});
      return false;
    }
    try {
      if (is_bare_file) {
        deck = structure::read_surfaces(shown_path(path), surface_reading());
        return true;
      }
      const structure::UnitSystem units = structure::unit_system(mesh_model_.units.value);
      structure::DeckOptions options{.leave_solids_out = mesh_model_.leave_solids_out,
                                     .leave_out = cards_left_out()};
      for (const auto& group : mesh_model_.groups)
        (group.is_of_bars() ? options.groups_of_bars : options.groups_of_plates)
            .push_back(group.name.value);
      deck = is_nastran ? structure::read_nastran(shown_path(path), units, options)
                        : structure::read_abaqus(shown_path(path), units, options);
      return true;
    } catch (const structure::DeckError& complaints) {
      for (const std::string& complaint : complaints.complaints())
        pass_on(complaint, mesh_model_.file.mark, diagnostics_);
    } catch (const structure::ModelError& wrong) {
      complain(wrong.what());
    }
    return false;
  }

  std::vector<std::string> cards_left_out() const {
    std::vector<std::string> cards;
    for (const Located<std::string>& card : mesh_model_.leave_out)
      cards.push_back(structure::upper(card.value));
    return cards;
  }

  /// Sizes are those of elements that are made here.
  bool check_sizes(bool is_geometry) {
    const auto& size = mesh_model_.element_size;
    const auto& at_lugs = mesh_model_.element_size_at_lugs;
    if (is_geometry && !size) {
      complain("surfaces are meshed here, and no element_size is given",
               {"such as element_size: 250 mm; smaller ones follow at openings and lugs"});
      return false;
    }
    for (const auto& given : {size, at_lugs})
      if (given && !is_geometry)
        diagnostics_.error(given->mark,
                           mesh_model_.file.value + " is a mesh and keeps its elements",
                           {"element sizes are those of CAD surfaces"});
    if (size && at_lugs && at_lugs->value > size->value)
      diagnostics_.error(at_lugs->mark,
                         fmt::format("elements are {:.4g} m at lugs and {:.4g} m elsewhere",
                                     at_lugs->value, size->value),
                         {"those at lugs are the smaller ones"});
    return is_geometry || (!size && !at_lugs);
  }

  structure::SurfaceReading surface_reading() const {
    structure::SurfaceReading reading;
    reading.units = units_of_length();
    reading.leave_solids_out = mesh_model_.leave_solids_out;
    for (const auto& group : mesh_model_.groups)
      (group.is_of_bars() ? reading.given.bars : reading.given.plates).push_back(group.name.value);
    if (!mesh_model_.element_size) return reading;
    constexpr double share_at_lugs = 1.0 / 3;
    reading.sizes.largest = mesh_model_.element_size->value;
    reading.sizes.at_places = mesh_model_.element_size_at_lugs
                                  ? mesh_model_.element_size_at_lugs->value
                                  : share_at_lugs * reading.sizes.largest;
    for (const LugModel& lug : block_.lugs)
      if (lug.pin.value.allFinite()) reading.sizes.places.push_back(lug.pin.value);
    return reading;
  }

  /// The units, of which a bare file's may be a length alone.
  structure::UnitSystem units_of_length() const {
    const std::string& name = mesh_model_.units.value;
    for (const char* system : {"m-kg-N", "mm-t-N", "in-lbf", "ft-slug-lbf"})
      if (std::string(system).starts_with(name + "-")) return structure::unit_system(system);
    return structure::unit_system(name);
  }

  /// Vertices whose displacement something holds in all directions.
  static std::vector<char> vertices_that_carry(const Mesh& mesh) {
    std::vector<std::array<bool, 3>> held(mesh.vertices.size());
    const auto hold = [&](int vertex, const bool* bound) {
      for (std::size_t c = 0; c < 3; ++c) held[vertex][c] |= bound[c];
    };
    constexpr std::array<bool, 3> all{true, true, true};
    for (const structure::Shell& shell : mesh.shells)
      for (const int vertex : shell.vertices) hold(vertex, all.data());
    for (const structure::Beam& beam : mesh.beams)
      for (const int vertex : beam.vertices) hold(vertex, all.data());
    for (const structure::Solid& solid : mesh.solids)
      for (const int vertex : solid.vertices) hold(vertex, all.data());
    for (const structure::SurfacePoint& point : mesh.surface_points) hold(point.vertex, all.data());
    for (const structure::Spring& spring : mesh.springs)
      for (const int vertex : spring.vertices) hold(vertex, all.data());
    for (const structure::DistributingLink& link : mesh.distributing_links)
      hold(link.reference, link.bound.data());
    for (const structure::RigidLink& link : mesh.rigid_links) {
      hold(link.master, link.bound.data());
      for (const int slave : link.slaves) hold(slave, link.bound.data());
    }
    for (const structure::MotionEquation& equation : mesh.equations)
      for (const structure::MotionEquation::Term& term : equation.terms) {
        const Eigen::Array<bool, 3, 1> bound = term.of_displacement.array() != 0;
        hold(term.vertex, bound.data());
      }
    std::vector<char> carries;
    for (const auto& of_vertex : held) carries.push_back(of_vertex == all ? 1 : 0);
    return carries;
  }

  /// What refinement does to plates it does not do to solids.
  static void remark_on_solids(Deck& deck) {
    if (deck.mesh.solids.empty()) return;
    deck.remarks.push_back(
        {deck.path.string(),
         fmt::format("{} solids are computed as quadratic elements of the deck's own division, "
                     "which is not refined",
                     deck.mesh.solids.size()),
         1});
  }

  void refuse_holding_equations(const Deck& deck) {
    for (const structure::HoldingEquation& held : deck.holding_equations)
      pass_on(held.place +
                  ": error: an equation resists motions of the block as a whole: it would hold it, "
                  "where a lifted block hangs on its ropes alone",
              mesh_model_.file.mark, diagnostics_);
  }

  /// A lifted block hangs on its ropes alone, and masses on it alone: solvers hold what hangs on
  /// nothing, a lift does not.
  static void let_go(Deck& deck) {
    auto& springs = deck.mesh.springs;
    const auto first =
        std::stable_partition(springs.begin(), springs.end(), [](const structure::Spring& spring) {
          return spring.vertices[0] >= 0 && spring.vertices[1] >= 0;
        });
    const auto count = static_cast<int>(springs.end() - first);
    springs.erase(first, springs.end());
    if (count > 0)
      deck.remarks.push_back(
          {deck.path.string(), "springs to the ground are left out: the block is lifted", count});
    const std::vector<char> carries = vertices_that_carry(deck.mesh);
    double loose = 0;
    auto& masses = deck.mesh.masses;
    const auto kept = masses.size();
    std::erase_if(masses, [&](const structure::PointMass& mass) {
      const bool is_loose = carries[mass.vertex] == 0;
      if (is_loose) loose += mass.mass;
      return is_loose;
    });
    if (masses.size() < kept)
      deck.remarks.push_back(
          {deck.path.string(), fmt::format("{} masses, {:.4g} t, are at nodes that nothing carries "
                                           "in every direction, and are left out",
                                           kept - masses.size(), loose / 1000)});
  }

  void give_yield_stress(Mesh& mesh) {
    std::vector<std::string> without;
    for (structure::Material& material : mesh.materials) {
      if (material.yield_stress > 0) continue;
      if (mesh_model_.yield_stress)
        material.yield_stress = *mesh_model_.yield_stress;
      else if (use_ == MeshUse::own_cases)
        material.yield_stress = std::numeric_limits<double>::infinity();  // nothing is checked
      else
        without.push_back(material.name);
    }
    if (without.empty()) return;
    complain(fmt::format("the deck gives no yield stress of {}", list_of_names(without)),
             {"give the smallest one under mesh: yield_stress: 235 MPa"});
  }

  void give_tripping_brackets(Mesh& mesh) {
    for (const auto& [name, spacing] : mesh_model_.tripping_brackets) {
      std::vector<std::string> groups_of_bars;
      bool is_known = false;
      for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        structure::Group& group = mesh.groups[g];
        if (std::ranges::none_of(mesh.beams, [&](const structure::Beam& beam) {
              return &mesh.group_of_region(beam.region) == &group;
            }))
          continue;
        groups_of_bars.push_back(group.name);
        if (structure::lower(group.name) != structure::lower(name.value)) continue;
        is_known = true;
        group.tripping_brackets = spacing.value;
      }
      if (!is_known)
        diagnostics_.error(name.mark,
                           fmt::format("tripping brackets are of group \"{}\", of which {} has no "
                                       "bars",
                                       name.value, mesh_model_.file.value),
                           {names_hint("its groups of bars are", groups_of_bars, name.value)});
    }
  }

  void check_diagnosis(const Deck& deck) {
    const structure::Diagnosis& diagnosis = *mesh_model_.diagnosis;
    for (const structure::Finding& finding : diagnosis.findings)
      if (finding.severity == structure::Severity::error && concerns_use(finding))
        complain(fmt::format("{}: {}", mesh_model_.file.value, described(finding)),
                 supports_of_what_is_loose(deck, finding));
    Vector3 low = deck.mesh.vertices.front(), high = low;
    for (const Vector3& vertex : deck.mesh.vertices) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
    const double size = (high - low).maxCoeff();
    if (size > longest || size < shortest)
      complain(
          fmt::format("the block is {:.4g} m long if units are {}", size, mesh_model_.units.value),
          {"is the deck in other units?"});
    if (diagnosis.mass.mass > heaviest)
      complain(fmt::format("the block weighs {:.4g} t if units are {}", diagnosis.mass.mass / 1000,
                           mesh_model_.units.value),
               {"the heaviest lifts are of some 50,000 t: is the deck in other units?"});
  }

  /// What hangs on nothing in a lift may be held by the deck's own supports; whether it is shows
  /// when its cases are solved.
  bool concerns_use(const structure::Finding& finding) const {
    // Gmsh's own, of a geometry, are told and no more: nobody could mend them.
    if (finding.kind == "folded shells" && structure::is_cad_file(mesh_model_.file.value))
      return false;
    return use_ == MeshUse::lift || finding.kind.starts_with("shells without") ||
           finding.kind.starts_with("folded");
  }

  BlockModel& block_;
  MeshModel& mesh_model_;
  const fs::path& folder_;
  std::vector<fs::path> homes_;
  MeshUse use_;
  Diagnostics& diagnostics_;
};

}  // namespace

Format<MeshModel> mesh_model_format() {
  Table<MeshModel> table(
      "mesh",
      "A deck of Nastran or Abaqus: shells, beams, masses, links, springs with their properties. "
      "Its loads and supports are not those of a lift, and are left out; cards that are not used "
      "are listed, and what cannot be honoured is an error with its line. Or a mesh of Gmsh or "
      "Salome, whose "
      "groups are plates and bars, or surfaces and free curves of CAD, which are cut at "
      "their joints and meshed here; their properties are given by groups.");
  table
      .required("file", &MeshModel::file, text(),
                "from the folder of this file on: Nastran (.bdf, .nas, .dat), Abaqus (.inp), Gmsh "
                "(.msh), universal files of Salome or I-DEAS (.unv), CAD surfaces (.step, .stp, "
                ".iges, .igs, .brep)")
      .required("units", &MeshModel::units,
                choice<std::string>({{"m-kg-N", "m-kg-N"},
                                     {"mm-t-N", "mm-t-N"},
                                     {"m-t-kN", "m-t-kN"},
                                     {"m-kt-MN", "m-kt-MN"},
                                     {"in-lbf", "in-lbf"},
                                     {"in-slinch-lbf", "in-slinch-lbf"},
                                     {"ft-slug-lbf", "ft-slug-lbf"},
                                     {"m", "m"},
                                     {"mm", "mm"},
                                     {"in", "in"},
                                     {"ft", "ft"}}),
                "of the deck: length, mass, force; seconds are those of time; of a mesh of Gmsh or "
                "CAD surfaces the length alone")
      .optional("yield_stress", &MeshModel::yield_stress,
                quantity(Dimension::stress, Range::positive()),
                "smallest yield stress of materials that the deck gives none")
      .optional("groups", &MeshModel::groups, mesh_groups_format(),
                "whose plates or bars have no property in the file: name: 12 mm, or a table")
      .optional("thicknesses", &MeshModel::thicknesses,
                names_to(located(quantity(Dimension::length, Range::positive()))),
                "the same for plates of the block's only material")
      .optional("tripping_brackets", &MeshModel::tripping_brackets,
                names_to(located(quantity(Dimension::length, Range::positive()))),
                "of the stiffeners of a group, by its name, from one bracket to the next: they "
                "keep the stiffeners from turning about their toes")
      .by_default("leave_solids_out", &MeshModel::leave_solids_out, boolean(), "false",
                  "lift without the file's solids; those of CAD files and of Gmsh's meshes are "
                  "refused otherwise, those of decks computed")
      .optional(
          "leave_out", &MeshModel::leave_out, list_of(located(text()), 1),
          "cards of a Nastran deck, or keywords and types of elements of an Abaqus deck, that "
          "are not known here and that the lift may do without, such as [BCTABLE, CGAP]; they "
          "are refused otherwise")
      .optional("element_size", &MeshModel::element_size,
                located(quantity(Dimension::length, Range::positive())),
                "longest edge of the elements that CAD surfaces are meshed with; circles have 24 "
                "elements and more")
      .optional("element_size_at_lugs", &MeshModel::element_size_at_lugs,
                located(quantity(Dimension::length, Range::positive())),
                "about the pins of lugs; a third of element_size if left out")
      .place(&MeshModel::place);
  return table.format();
}

bool is_bare(const MeshModel& mesh) {
  const std::string& file = mesh.file.value;
  return structure::is_cad_file(file) || structure::ending_of(file) == ".msh" ||
         structure::ending_of(file) == ".unv";
}

void read_block_mesh(BlockModel& block, const fs::path& folder, Diagnostics& diagnostics,
                     const std::optional<fs::path>& of_case, MeshUse use) {
  if (!block.mesh || block.mesh->file.value.empty() || block.mesh->units.value.empty()) return;
  for (const auto& given : block.mesh->thicknesses) {
    MeshGroupModel group;
    group.name = given.name;
    group.thickness = given.value.value;
    block.mesh->groups.push_back(std::move(group));
  }
  std::vector<fs::path> homes;
  if (of_case) homes.push_back(*of_case);
  MeshReader(block, folder, std::move(homes), use, diagnostics).read();
}

std::vector<structure::LedgerEntry> unused_cards(const MeshModel& mesh) {
  std::vector<structure::LedgerEntry> cards;
  if (!mesh.deck) return cards;
  for (structure::LedgerEntry entry : mesh.deck->ledger) {
    if (is_of_loads(entry.name)) {
      entry.used = 0;
      entry.left_out = "loads and supports are those of the lift";
    }
    if (entry.used != entry.read || !entry.left_out.empty()) cards.push_back(std::move(entry));
  }
  return cards;
}

std::vector<std::string> warnings_of_own_cases(const MeshModel& mesh) {
  std::vector<std::string> sentences;
  if (!mesh.deck || !mesh.diagnosis) return sentences;
  const bool has_mass_loads =
      std::ranges::any_of(mesh.deck->load_sets, &structure::LoadSet::is_on_masses);
  for (const structure::Finding& finding : mesh.diagnosis->findings) {
    const bool is_of_others = finding.kind == "springs to the ground" ||
                              (finding.kind == "materials without density" && !has_mass_loads);
    if (finding.severity == structure::Severity::warning && !is_of_others)
      sentences.push_back(described(finding));
  }
  return sentences;
}

std::string describe_block_mesh(const MeshModel& mesh) {
  if (!mesh.deck || !mesh.diagnosis) return {};
  const Deck& deck = *mesh.deck;
  std::string text = fmt::format(
      "{} {}: {} nodes, {} shells, {} beams, {}{} masses, {} links, {} springs; {:.6g} t at "
      "({:.4g}, {:.4g}, {:.4g}) m\n",
      is_bare(mesh) ? "mesh of" : "deck", mesh.file.value, deck.mesh.vertices.size(),
      deck.mesh.shells.size(), deck.mesh.beams.size(),
      deck.mesh.solids.empty() ? "" : fmt::format("{} solids, ", deck.mesh.solids.size()),
      deck.mesh.masses.size(),
      deck.mesh.rigid_links.size() + deck.mesh.distributing_links.size() +
          deck.mesh.equations.size(),
      deck.mesh.springs.size(), mesh.diagnosis->mass.mass / 1000, mesh.diagnosis->mass.centre.x(),
      mesh.diagnosis->mass.centre.y(), mesh.diagnosis->mass.centre.z());
  for (const structure::LedgerEntry& entry : unused_cards(mesh))
    text += fmt::format("  {}: {} of {} used{}{}\n", entry.name, entry.used, entry.read,
                        entry.left_out.empty() ? "" : "; left out: ", entry.left_out);
  for (const structure::DeckRemark& remark : deck.remarks)
    text += fmt::format("  {}: {}{}\n", remark.place, remark.text,
                        remark.count > 1 ? fmt::format(" ({} times)", remark.count) : "");
  for (const structure::Finding& finding : mesh.diagnosis->findings)
    text += fmt::format("  {}: {}\n",
                        finding.severity == structure::Severity::note ? "note" : "warning",
                        described(finding));
  return text;
}

}  // namespace blocklift::pipeline

// Sections of shells, beams, trusses and solids, and the cells that have them.

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/abaqus/bare_groups.h"
#include "structure/mesh/files/abaqus/beam_shapes.h"
#include "structure/mesh/files/abaqus/layers.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/abaqus/orientation.h"
#include "structure/mesh/files/deck/parted_edges.h"
#include "structure/mesh/files/deck/plausibility.h"
#include "structure/mesh/files/deck/shell_geometry.h"
#include "structure/mesh/shell_shape.h"

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

bool is_detail(const std::string& name) {
  return name == "CENTROID" || name == "SHEAR CENTER" || name == "SECTION POINTS" ||
         name == "TRANSVERSE SHEAR STIFFNESS" || name == "BEAM SECTION OFFSET";
}

bool may_precede_detail(const std::string& name) {
  return is_detail(name) || name == "SHELL SECTION" || name == "SHELL GENERAL SECTION" ||
         name == "BEAM SECTION" || name == "BEAM GENERAL SECTION";
}

class Sections {
 public:
  explicit Sections(AbaqusModel& model)
      : model_(model), mesh_(model.deck.mesh), edges_(mesh_, model.log, apart_of_shells) {}

  void read() {
    for (const AbaqusScope& scope : model_.scopes)
      for (const AbaqusBlock* block : scope.blocks)
        if (block->name == "NODAL THICKNESS")
          model_.guarded(*block, [&] { read_nodal_thickness(scope, *block); });
        else if (block->name == "SHELL SECTION" && block->has("NODAL THICKNESS"))
          is_nodal_by_section_ = true;
    for (const AbaqusScope& scope : model_.scopes) {
      for (std::size_t i = 0; i < scope.blocks.size(); ++i) {
        SectionBlocks blocks{&scope, scope.blocks[i], {}};
        for (std::size_t j = i + 1; j < scope.blocks.size() && is_detail(scope.blocks[j]->name);
             ++j)
          blocks.details.push_back(scope.blocks[j]);
        const std::string& name = scope.blocks[i]->name;
        const AbaqusBlock& block = *scope.blocks[i];
        if (is_detail(name) && (i == 0 || !may_precede_detail(scope.blocks[i - 1]->name)))
          model_.log.complain(block.line, fmt::format("*{}: it is to follow a section of shells or "
                                                      "beams, and follows none",
                                                      name));
        if (name == "SHELL SECTION" || name == "SHELL GENERAL SECTION")
          section(blocks, [&] { add_shells(blocks); });
        if (name == "BEAM SECTION")
          section(blocks, [&] { add_beams(blocks, read_beam_section(model_, blocks)); });
        if (name == "BEAM GENERAL SECTION")
          section(blocks, [&] { add_beams(blocks, read_general_beam_section(model_, blocks)); });
        if (name == "SOLID SECTION") section(blocks, [&] { add_solid_section(blocks); });
        if (name == "ORIENTATION") model_.guarded(block, [] {});
      }
    }
    for (const AbaqusScope& scope : model_.scopes)
      for (const AbaqusBlock* block : scope.blocks)
        if (block->name == "RELEASE") model_.guarded(*block, [&] { release(scope, *block); });
    check_all_have_sections();
    complete_abaqus_solids(model_);
  }

 private:
  /// Of elements whose section is wrong that is said, and not that they have none.
  template <typename Step>
  void section(const SectionBlocks& blocks, const Step& step) {
    model_.guarded(*blocks.block, [&] {
      try {
        step();
      } catch (const CardError&) {
        const auto found = blocks.scope->element_sets.find(blocks.block->value("ELSET"));
        if (found != blocks.scope->element_sets.end())
          of_wrong_sections_.insert(found->second.begin(), found->second.end());
        throw;
      }
    });
  }

  std::vector<int> elements(const SectionBlocks& blocks) const {
    return model_.elements_of(*blocks.scope, blocks.block->required("ELSET"));
  }

  /// One region and group for each section.
  int region(const SectionBlocks& blocks, int material) {
    const std::string name = (blocks.scope->name.empty() ? "" : blocks.scope->name + ".") +
                             blocks.block->required_as_given("ELSET");
    mesh_.groups.push_back({name, material});
    mesh_.regions.push_back({.name = name, .group = static_cast<int>(mesh_.groups.size()) - 1});
    return static_cast<int>(mesh_.regions.size()) - 1;
  }

  // *SHELL SECTION, ELSET = , MATERIAL = , OFFSET = / thickness
  // *SHELL SECTION, ELSET = , COMPOSITE / thickness, points, material, angle ...
  void add_shells(const SectionBlocks& blocks) {
    const AbaqusBlock& block = *blocks.block;
    if (block.name == "SHELL GENERAL SECTION" && !block.has("MATERIAL") && !block.has("COMPOSITE"))
      throw CardError{"a section by its stiffness is not known; MATERIAL or COMPOSITE is due"};
    for (const char* unknown :
         {"SHELL THICKNESS", "DENSITY", "SYMMETRIC", "BENDING ONLY", "MEMBRANE ONLY"})
      if (block.has(unknown)) throw CardError{fmt::format("{} is not known", unknown)};
    if (block.data.empty() && !block.has("NODAL THICKNESS"))
      throw CardError{"the thickness is missing"};
    ShellSection section;
    std::optional<AbaqusLayers> layers;
    if (block.has("COMPOSITE")) {
      layers.emplace(model_, *blocks.scope, block);
      section.thickness = layers->thickness();
      const std::optional<std::string> one = layers->only_material();
      if (one && model_.materials.at(*one).is_isotropic)
        section.material = abaqus_material(model_, *one);
      else if (layers->have_axes())
        return add_turned_layers(blocks, *layers);
      else
        laminate(layers->plies(), layers->obstacle(), block, section);
    } else {
      // Where each node has a thickness of its own, that of the section stands for none.
      section.thickness =
          block.data.empty()
              ? model_.units.length
              : abaqus_real(block.data.front().fields(), 0, "thickness") * model_.units.length;
      if (!(section.thickness > 0)) throw CardError{"the thickness must be positive"};
      const std::string name = block.required("MATERIAL");
      const auto found = model_.materials.find(name);
      if (found != model_.materials.end()) refuse_solids_alone(found->second);
      if (found != model_.materials.end() && !found->second.is_isotropic)
        laminate({{found->second.ply, section.thickness, 0}}, found->second.obstacle, block,
                 section);
      else
        section.material = abaqus_material(model_, name);
    }
    if (!(section.thickness > 0)) throw CardError{"the thickness must be positive"};
    const int place = add_section(blocks, section);
    const int of_region = region(blocks, section.material);
    std::optional<AbaqusAxes> axes;
    if (mesh_.shell_sections[place].laminate >= 0)
      axes.emplace(*blocks.scope, block.value("ORIENTATION"));
    for (const int e : elements(blocks)) {
      AbaqusDeckElement& element = model_.elements[e];
      if (!is_due(element)) continue;
      const std::vector<double> thicknesses =
          thicknesses_at_nodes(element, block, section.thickness);
      add_shell(element, section_by_nodes(thicknesses, place), of_region,
                axes ? axes->along_plate(centre_of(element)) : Vector3::Zero());
      taper(mesh_.shells[element.shell], thicknesses);
    }
  }

  /// Shells of layers that have orientations of their own: a section for all that have the same
  /// angles between these, which is the same for all where the orientations are straight.
  void add_turned_layers(const SectionBlocks& blocks, const AbaqusLayers& layers) {
    const AbaqusBlock& block = *blocks.block;
    if (block.has("NODAL THICKNESS"))
      throw CardError{"layers cannot have the thickness of their nodes"};
    const AbaqusAxes axes(*blocks.scope, block.value("ORIENTATION"));
    std::map<std::vector<double>, int> places;  // by the layers' angles
    int of_region = -1;
    for (const int e : elements(blocks)) {
      AbaqusDeckElement& element = model_.elements[e];
      if (!is_due(element)) continue;
      const Vector3 axis_1 = axes.along_plate(centre_of(element));
      const std::vector<Ply> plies = layers.at(centre_of(element), normal_of(element), axis_1);
      std::vector<double> angles;
      for (const Ply& ply : plies) angles.push_back(ply.angle);
      const auto [found, is_new] = places.try_emplace(angles, -1);
      if (is_new) {
        ShellSection section;
        section.thickness = layers.thickness();
        laminate(plies, layers.obstacle(), block, section);
        found->second = add_section(blocks, section);
        if (of_region < 0) of_region = region(blocks, section.material);
      }
      const bool is_directional = mesh_.shell_sections[found->second].laminate >= 0;
      add_shell(element, found->second, of_region, is_directional ? axis_1 : Vector3::Zero());
    }
  }

  /// Place of a section with what follows it in the deck.
  int add_section(const SectionBlocks& blocks, ShellSection section) {
    for (const AbaqusBlock* detail : blocks.details)
      if (detail->name == "TRANSVERSE SHEAR STIFFNESS")
        model_.guarded(*detail, [&] { read_shear_stiffness(*detail, section); });
    section.offset = -offset_share(*blocks.block) * section.thickness;
    section.label = static_cast<long>(mesh_.shell_sections.size()) + 1;
    mesh_.shell_sections.push_back(section);
    return static_cast<int>(mesh_.shell_sections.size()) - 1;
  }

  /// Is an element of a section of shells one? Not if it is nothing here.
  /// @throws CardError if it is another thing or has a section.
  static bool is_due(const AbaqusDeckElement& element) {
    if (element.kind == AbaqusKind::nothing) return false;
    if (element.kind != AbaqusKind::shell)
      throw CardError{fmt::format("element {} is a {}, no shell", element.label, element.type)};
    if (element.shell >= 0)
      throw CardError{fmt::format("element {} has two sections", element.label)};
    return true;
  }

  // *NODAL THICKNESS / node or set, thickness
  void read_nodal_thickness(const AbaqusScope& scope, const AbaqusBlock& block) {
    model_.for_lines(block, [&](const Fields& fields) {
      const double thickness = abaqus_real(fields, 1, "thickness") * model_.units.length;
      if (!(thickness > 0)) throw CardError{"the thickness must be positive"};
      for (const int node : model_.nodes_of(scope, fields[0])) thickness_of_[node] = thickness;
    });
  }

  /// Thickness at the corners of a shell whose nodes have one of their own; else none. Abaqus gives
  /// it to the sections that ask for it, CalculiX, which needs no parameter, to all shells at these
  /// nodes, the others having their section's.
  std::vector<double> thicknesses_at_nodes(const AbaqusDeckElement& element,
                                           const AbaqusBlock& block, double of_section) {
    const bool is_asked_for = block.has("NODAL THICKNESS");
    const bool is_of_others = is_nodal_by_section_ || block.has("COMPOSITE");
    if (!is_asked_for && (thickness_of_.empty() || is_of_others)) return {};
    std::vector<double> around;
    bool is_any = false;
    const std::size_t corners = corners_of(element);
    for (std::size_t i = 0; i < corners; ++i) {
      const auto found = thickness_of_.find(element.nodes[i]);
      if (is_asked_for && found == thickness_of_.end())
        throw CardError{fmt::format("nodes of element {} have no *NODAL THICKNESS", element.label)};
      is_any = is_any || found != thickness_of_.end();
      around.push_back(found == thickness_of_.end() ? of_section : found->second);
    }
    if (!is_any) around.clear();
    return around;
  }

  /// The section of a shell with thicknesses of its own: as the one that it is of, with their mean.
  int section_by_nodes(const std::vector<double>& thicknesses, int place) {
    if (thicknesses.empty()) return place;
    const double thickness = std::accumulate(thicknesses.begin(), thicknesses.end(), 0.0) /
                             static_cast<double>(thicknesses.size());
    const auto [found, is_new] = section_of_thickness_.try_emplace(
        {place, thickness}, static_cast<int>(mesh_.shell_sections.size()));
    if (!is_new) return found->second;
    ShellSection own = mesh_.shell_sections[place];
    if (own.laminate >= 0)
      throw CardError{
          "layers, and plates with a *TRANSVERSE SHEAR STIFFNESS, cannot have the "
          "thickness of their nodes"};
    own.offset *= thickness / own.thickness;
    own.thickness = thickness;
    own.label = static_cast<long>(mesh_.shell_sections.size()) + 1;
    mesh_.shell_sections.push_back(own);
    return found->second;
  }

  void taper(Shell& shell, std::vector<double> thicknesses) {
    if (thicknesses.empty()) return;
    if (shell.is_triangle()) thicknesses.resize(3);
    const auto [least, most] = std::minmax_element(thicknesses.begin(), thicknesses.end());
    if (*most <= (1 + 1e-9) * *least) return;
    shell.taper = static_cast<int>(mesh_.shell_tapers.size());
    mesh_.shell_tapers.push_back(lexicographic(thicknesses));
    if (mesh_.section_of(shell).offset != 0)
      model_.log.leave_out("*NODAL THICKNESS",
                           "the slope of a mid-surface that lies off the nodes by a share of it");
  }

  /// Of the mid-surface to the surface of the nodes, in thicknesses, along the normal.
  static double offset_share(const AbaqusBlock& block) {
    const std::string offset = block.value("OFFSET");
    if (offset.empty()) return 0;
    if (offset == "SPOS") return 0.5;
    if (offset == "SNEG") return -0.5;
    const auto share = to_real(offset);
    if (!share) throw CardError{fmt::format("OFFSET = {} is no number, SPOS or SNEG", offset)};
    return *share;
  }

  /// Gives a section the stiffness and expansion of layers, unless a plate of one material has just
  /// these.
  void laminate(const std::vector<Ply>& plies, const std::string& obstacle,
                const AbaqusBlock& block, ShellSection& section) {
    const Laminate laminate = stack(plies);
    double mass = 0;
    for (const Ply& ply : plies) mass += ply.material.density * ply.thickness;
    const NearestPlate nearest = nearest_plate(laminate, section.thickness);
    const std::string name = "layers of " + block.required("ELSET");
    section.material = static_cast<int>(mesh_.materials.size());
    mesh_.materials.push_back({.name = name,
                               .youngs_modulus = nearest.youngs_modulus,
                               .poisson_ratio = nearest.poisson_ratio,
                               .density = mass / section.thickness});
    check_plausible(mesh_.materials.back(), name, model_.units, model_.log, block.line);
    check_poisson_ratio(mesh_.materials.back(), name);
    Expansions& expansions = model_.deck.expansions;
    LaminateExpansion expansion = expansion_of(plies);
    expansion.obstacle = obstacle;
    const std::optional<double> coefficient =
        even_coefficient(expansion, nearest, section.thickness);
    expansions.set(section.material, {coefficient.value_or(0), 0, obstacle});
    if (nearest.is_exact() && coefficient) return;
    section.laminate = static_cast<int>(mesh_.laminates.size());
    mesh_.laminates.push_back(laminate);
    expansions.of_laminates.push_back(std::move(expansion));
  }

  // *TRANSVERSE SHEAR STIFFNESS / K11, K22, K12, force by length; of K11 and K22 one that is not
  // given, or zero, is as the other.
  void read_shear_stiffness(const AbaqusBlock& block, ShellSection& section) {
    if (block.data.empty()) throw CardError{"a line of data is missing"};
    const Fields fields = block.data.front().fields();
    double k_11 = abaqus_real(fields, 0, "stiffness K11", 0.0);
    double k_22 = abaqus_real(fields, 1, "stiffness K22", 0.0);
    const double k_12 = abaqus_real(fields, 2, "stiffness K12", 0.0);
    if (k_11 == 0) k_11 = k_22;
    if (k_22 == 0) k_22 = k_11;
    if (!(k_11 > 0 && k_22 > 0 && k_11 * k_22 > k_12 * k_12))
      throw CardError{fmt::format(
          "K11 = {}, K22 = {}, K12 = {}: K11 and K22 must be positive, and K12^2 less than K11 K22",
          k_11, k_22, k_12)};
    Laminate own = section.laminate >= 0
                       ? mesh_.laminates[section.laminate]
                       : homogeneous(mesh_.materials[section.material], section.thickness);
    own.shear << k_11, k_12, k_12, k_22;
    own.shear *= model_.units.force / model_.units.length;
    if (section.laminate >= 0) {
      mesh_.laminates[section.laminate] = own;
    } else if (!nearest_plate(own, section.thickness).is_exact()) {
      section.laminate = static_cast<int>(mesh_.laminates.size());
      mesh_.laminates.push_back(own);
      const auto place = static_cast<std::size_t>(section.material);
      Expansions& expansions = model_.deck.expansions;
      expansions.of_laminates.push_back(
          expansion_of(mesh_.materials[place], expansions.of_materials[place], section.thickness));
    }
  }

  static std::size_t corners_of(const AbaqusDeckElement& element) {
    return element.nodes.size() == 3 || element.nodes.size() == 6 ? 3 : 4;
  }

  /// Middle of a plate's corners, in the deck's units.
  Vector3 centre_of(const AbaqusDeckElement& element) const {
    const std::size_t count = corners_of(element);
    Vector3 centre = Vector3::Zero();
    for (std::size_t i = 0; i < count; ++i)
      centre += model_.place(element.nodes[i]) / (static_cast<double>(count) * model_.units.length);
    return centre;
  }

  Vector3 normal_of(const AbaqusDeckElement& element) const {
    const auto place = [&](std::size_t i) { return model_.place(element.nodes[i]); };
    const std::size_t last = corners_of(element) - 1;
    return (place(2) - place(0)).cross(place(last) - place(1)).normalized();
  }

  void add_shell(AbaqusDeckElement& element, int section, int of_region, const Vector3& axis_1) {
    Shell shell;
    shell.section = section;
    shell.region = of_region;
    shell.label = element.label;
    shell.laminate_axis = axis_1;
    const std::size_t count = corners_of(element);
    std::vector<int> corners(element.nodes.begin(),
                             element.nodes.begin() + static_cast<long>(count));
    element.shell = static_cast<int>(mesh_.shells.size());
    if (element.nodes.size() > count) {
      std::vector<Vector3> at_corners, at_middles;
      for (const int corner : corners) at_corners.push_back(model_.place(corner));
      for (std::size_t i = 0; i < count; ++i) {
        const int middle = element.nodes[count + i];
        at_middles.push_back(model_.place(middle));
        model_.middles.push_back({middle, element.shell, place_of_middle(count, i)});
        edges_.take({corners[i], corners[(i + 1) % count], middle, element.label,
                     "*ELEMENT, TYPE=" + element.type, element.line});
      }
      shell.curvature = static_cast<int>(mesh_.curved_shells.size());
      mesh_.curved_shells.push_back(quadratic_points(at_corners, at_middles));
    } else if (count == 4) {
      drop_repeated(element, corners);
    }
    shell.vertices = lexicographic(corners);
    if (is_folded(mesh_, shell))
      model_.log.complain(
          element.line,
          fmt::format("*ELEMENT: element {} is folded: its corners are not in turn about it, one "
                      "turns inwards{}",
                      shell.label,
                      shell.curvature < 0 ? "" : ", or middles of its edges lie far off"));
    mesh_.shells.push_back(shell);
  }

  /// A quadrangle with neighbouring corners in one node is a triangle.
  void drop_repeated(const AbaqusDeckElement& element, std::vector<int>& corners) const {
    std::vector<int> left = corners;
    left.erase(std::unique(left.begin(), left.end()), left.end());
    if (left.size() > 1 && left.front() == left.back()) left.pop_back();
    if (left.size() == 4) return;
    if (left.size() < 3) {
      model_.log.complain(
          element.line,
          fmt::format("*ELEMENT: element {} has corners in one node and no area", element.label));
      return;
    }
    model_.log.remark(element.line,
                      "*ELEMENT: a quadrangle with one node twice is read as a triangle");
    corners = left;
  }

  void add_beams(const SectionBlocks& blocks, const BeamShape& shape) {
    BeamSection section = shape.profile.section;
    section.material = shape.material;
    section.name = blocks.block->required_as_given("ELSET");
    section.label = static_cast<long>(mesh_.beam_sections.size()) + 1;
    mesh_.beam_sections.push_back(section);
    const int of_region = region(blocks, shape.material);
    for (const int e : elements(blocks)) {
      AbaqusDeckElement& element = model_.elements[e];
      if (element.kind == AbaqusKind::nothing) continue;
      if (element.kind != AbaqusKind::beam)
        throw CardError{fmt::format("element {} is a {}, no beam", element.label, element.type)};
      if (!element.beams.empty())
        throw CardError{fmt::format("element {} has two sections", element.label)};
      const bool is_quadratic = element.type.substr(0, 3) == "B32" || element.type == "PIPE32";
      const std::size_t count = is_quadratic ? 3 : 2;
      Vector3 axis_2 = shape.axis_2;
      if (element.nodes.size() > count)
        axis_2 = model_.place(element.nodes[count]) - model_.place(element.nodes[0]);
      const auto place = [&](std::size_t i) { return model_.place(element.nodes[i]); };
      if (is_quadratic) refuse_folded_beam(element.label, place(0), place(1), place(2));
      for (std::size_t i = 0; i + 1 < count; ++i)
        add_beam(element, element.nodes[i], element.nodes[i + 1], axis_2, of_region,
                 shape.profile.centroid);
    }
  }

  void add_beam(AbaqusDeckElement& element, int from, int to, const Vector3& axis_2, int of_region,
                const Eigen::Vector2d& centroid) {
    Beam beam;
    beam.vertices = {from, to};
    beam.section = static_cast<int>(mesh_.beam_sections.size()) - 1;
    beam.region = of_region;
    beam.label = element.label;
    beam.axis_2 = axis_2;
    const Vector3 line = model_.place(to) - model_.place(from);
    const Vector3 axis_3 = line.cross(axis_2);
    if (!(line.norm() > 1e-9))
      throw CardError{fmt::format("element {} has no length", element.label)};
    if (!(axis_3.norm() > 1e-6 * line.norm() * axis_2.norm()))
      throw CardError{
          fmt::format("element {} runs along n1, which is to orient it", element.label)};
    const Vector3 own_2 = axis_3.cross(line).normalized();
    beam.offset[0] = beam.offset[1] = centroid[0] * own_2 + centroid[1] * axis_3.normalized();
    element.beams.push_back(static_cast<int>(mesh_.beams.size()));
    mesh_.beams.push_back(beam);
  }

  // *RELEASE / element or set, S1 | S2, M1 | M2 | T | M1-M2 | M1-T | M2-T | ALLM
  void release(const AbaqusScope& scope, const AbaqusBlock& block) {
    static const std::map<std::string, std::vector<std::size_t>> codes{
        {"M1", {4}},      {"M2", {5}},      {"T", {3}},         {"M1-M2", {4, 5}},
        {"M1-T", {4, 3}}, {"M2-T", {5, 3}}, {"ALLM", {3, 4, 5}}};
    model_.for_lines(block, [&](const Fields& fields) {
      const auto code = codes.find(fields.size() > 2 ? upper(fields[2]) : "");
      const bool at_start = fields.size() > 1 && is_same(fields[1], "S1");
      if (code == codes.end() || (!at_start && !is_same(fields[1], "S2")))
        throw CardError{"elements, S1 or S2, and M1, M2, T, M1-M2, M1-T, M2-T or ALLM are due"};
      for (const int e : model_.elements_of(scope, fields[0])) {
        const AbaqusDeckElement& element = model_.elements[e];
        if (element.beams.empty())
          throw CardError{fmt::format("element {} is no beam", element.label)};
        Beam& beam = mesh_.beams[at_start ? element.beams.front() : element.beams.back()];
        for (const std::size_t i : code->second) beam.release[at_start ? 0 : 1][i] = true;
      }
    });
  }

  // *SOLID SECTION, ELSET = , MATERIAL = / area: of solids, or of trusses, which have an area
  void add_solid_section(const SectionBlocks& blocks) {
    std::vector<int> trusses, solids;
    for (const int e : elements(blocks)) {
      const AbaqusDeckElement& element = model_.elements[e];
      if (element.kind == AbaqusKind::shell && element.type.starts_with("CPS"))
        throw CardError{fmt::format("element {} is a {} of a plane body, which cannot be lifted",
                                    element.label, element.type)};
      if (element.kind == AbaqusKind::truss) trusses.push_back(e);
      if (element.kind == AbaqusKind::solid) solids.push_back(e);
    }
    if (solids.empty() && trusses.empty())
      model_.log.leave_out("*SOLID SECTION", "of nothing here");
    if (!solids.empty()) add_solids(blocks, solids);
    if (!trusses.empty()) add_trusses(blocks, trusses);
  }

  void add_solids(const SectionBlocks& blocks, const std::vector<int>& solids) {
    const AbaqusBlock& block = *blocks.block;
    if (block.has("COMPOSITE")) throw CardError{"solids of layers are not known"};
    const int material = abaqus_solid_material(model_, block.required("MATERIAL"));
    add_abaqus_solids(model_, *blocks.scope, block, solids, material, region(blocks, material));
  }

  void add_trusses(const SectionBlocks& blocks, const std::vector<int>& trusses) {
    const AbaqusBlock& block = *blocks.block;
    BeamSection section;
    section.area = 1;
    if (!block.data.empty())
      section.area = abaqus_real(block.data.front().fields(), 0, "area", 1.0);
    section.area *= model_.units.length * model_.units.length;
    if (!(section.area > 0)) throw CardError{"the area must be positive"};
    section.material = abaqus_material(model_, block.required("MATERIAL"));
    section.name = block.required_as_given("ELSET");
    section.label = static_cast<long>(mesh_.beam_sections.size()) + 1;
    mesh_.beam_sections.push_back(section);
    const int of_region = region(blocks, section.material);
    for (const int e : trusses) {
      AbaqusDeckElement& element = model_.elements[e];
      // A third node between the ends bends nothing.
      Beam rod;
      rod.vertices = {element.nodes.front(), element.nodes.back()};
      rod.section = static_cast<int>(mesh_.beam_sections.size()) - 1;
      rod.region = of_region;
      rod.label = element.label;
      rod.is_rod = true;
      const Vector3 line = model_.place(rod.vertices[1]) - model_.place(rod.vertices[0]);
      if (!(line.norm() > 1e-9))
        throw CardError{fmt::format("element {} has no length", element.label)};
      rod.axis_2 = line.unitOrthogonal();
      element.beams.push_back(static_cast<int>(mesh_.beams.size()));
      mesh_.beams.push_back(rod);
    }
  }

  /// Where the deck has no sections at all, BareGroups says what its cells are.
  void check_all_have_sections() {
    const bool has_shells = !mesh_.shell_sections.empty();
    const bool is_bare = !has_shells && mesh_.beam_sections.empty() && mesh_.solids.empty() &&
                         of_wrong_sections_.empty();
    BareGroups groups(model_);
    std::vector<int> bars;
    for (int e = 0; e < static_cast<int>(model_.elements.size()); ++e) {
      AbaqusDeckElement& element = model_.elements[e];
      if (of_wrong_sections_.count(e) > 0) continue;
      if (element.kind == AbaqusKind::shell && element.shell < 0) {
        if (has_shells)
          model_.log.complain(element.line, "*ELEMENT: shells have no *SHELL SECTION");
        else
          add_shell(element, -1, groups.region_of_plate(e), Vector3::Zero());
      }
      if ((element.kind == AbaqusKind::beam || element.kind == AbaqusKind::truss) &&
          element.beams.empty())
        bars.push_back(e);
      if (element.kind == AbaqusKind::solid && element.solid < 0)
        model_.log.complain(element.line, "*ELEMENT: solids have no *SOLID SECTION");
    }
    for (const int e : bars)
      if (!is_bare || !groups.take_bar(e)) groups.miss_section_of_bar(e);
  }

  AbaqusModel& model_;
  Mesh& mesh_;
  PartedEdges edges_;
  std::map<int, double> thickness_of_;  ///< of nodes, m
  bool is_nodal_by_section_ = false;    ///< does any section ask for it?
  std::map<std::pair<int, double>, int> section_of_thickness_;
  std::set<int> of_wrong_sections_;  ///< elements
};

}  // namespace

void read_abaqus_sections(AbaqusModel& model) {
  read_abaqus_materials(model);
  Sections(model).read();
  for (const AbaqusScope& scope : model.scopes)
    for (const auto& [name, elements] : scope.element_sets) {
      NamedSet set;
      set.name = scope.name.empty() ? name : scope.name + "." + name;
      for (const int e : elements) {
        const AbaqusDeckElement& element = model.elements[e];
        if (element.shell >= 0) set.shells.push_back(element.shell);
        set.beams.insert(set.beams.end(), element.beams.begin(), element.beams.end());
      }
      if (!set.shells.empty() || !set.beams.empty()) model.deck.sets.push_back(std::move(set));
    }
}

}  // namespace blocklift::structure

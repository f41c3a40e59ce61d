#include "structure/mesh/files/abaqus/writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/files/abaqus/temperature_text.h"
#include "structure/mesh/files/deck/edge_middles.h"
#include "structure/mesh/files/deck/equations.h"
#include "structure/mesh/files/deck/line_loads.h"
#include "structure/mesh/files/deck/link_frames.h"
#include "structure/mesh/files/deck/numbering.h"
#include "structure/mesh/files/deck/shell_geometry.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

/// The fewest digits that say a number exactly, or as many as fit in a field's twenty characters;
/// never an integer, which some fields would be read as.
std::string exact(double value) {
  constexpr std::size_t widest = 20;
  std::array<char, 40> buffer{};
  char* const end = buffer.data() + buffer.size();
  std::string text(buffer.data(), std::to_chars(buffer.data(), end, value).ptr);
  for (int digits = 16; text.size() > widest; --digits)
    text.assign(buffer.data(),
                std::to_chars(buffer.data(), end, value, std::chars_format::general, digits).ptr);
  if (text.find_first_of(".e") == std::string::npos) text += '.';
  return text;
}

std::string exact(const Vector3& vector) {
  return exact(vector[0]) + ", " + exact(vector[1]) + ", " + exact(vector[2]);
}

/// Beams that share a section, an orientation and an offset.
struct BeamKind {
  int section = 0;
  bool is_rod = false;
  Vector3 axis_2 = Vector3::Zero();
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  std::vector<int> beams;
};

class AbaqusText {
 public:
  explicit AbaqusText(const Deck& deck)
      : deck_(deck),
        mesh_(deck_.mesh),
        units_(deck.units),
        temperatures_(deck_),
        axes_(vertex_axes(deck)),
        elements_(element_labels(deck.mesh)),
        nodes_(mesh_.vertex_labels) {}

  std::string write() {
    for (const HoldingEquation& held : deck_.holding_equations)
      mesh_.equations.push_back(held.equation);
    MiddleVertices middles(mesh_);
    for (const Shell& shell : mesh_.shells)
      middles_.push_back(shell.curvature >= 0 ? middles.of(shell) : std::vector<int>{});
    axes_.resize(mesh_.vertices.size(), Eigen::Matrix3d::Identity());
    line("*HEADING");
    line(deck_.title.empty() ? "block" : deck_.title);
    line("** lengths, forces and masses in " + units_.name);
    write_nodes();
    write_materials();
    write_shells();
    write_nodal_thickness();
    write_beams();
    write_solids();
    write_masses();
    write_springs();
    write_links();
    write_transforms();
    line("*ELSET, ELSET=EVERYTHING");
    for (const std::string& set : element_sets_) line(set);
    text_ += temperatures_.initial("NODES");
    for (std::size_t i = 0; i < deck_.load_cases.size(); ++i) write_step(deck_.load_cases[i]);
    return std::move(text_);
  }

 private:
  void line(const std::string& text) { text_ += text + '\n'; }

  long label(int vertex) const { return node_number_[vertex]; }

  void write_nodes() {
    line("*NODE, NSET=NODES");
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      node_number_.push_back(nodes_.take(mesh_.vertex_labels.empty() ? static_cast<long>(v) + 1
                                                                     : mesh_.vertex_labels[v]));
      line(fmt::format("{}, {}", node_number_.back(), exact(mesh_.vertices[v] / units_.length)));
    }
  }

  void write_materials() {
    for (std::size_t m = 0; m < mesh_.materials.size(); ++m) {
      const Material& material = mesh_.materials[m];
      line(fmt::format("*MATERIAL, NAME=M{}", m + 1));
      line("*ELASTIC");
      line(exact(material.youngs_modulus / units_.stress()) + ", " + exact(material.poisson_ratio));
      write_density_and_yield(material);
      text_ += temperatures_.of_material(static_cast<int>(m));
    }
  }

  void write_density_and_yield(const Material& material) {
    if (material.density > 0) {
      line("*DENSITY");
      line(exact(material.density / units_.density()) + ",");
    }
    if (material.yield_stress > 0) {
      line("*PLASTIC");
      line(exact(material.yield_stress / units_.stress()) + ", 0.");
    }
  }

  void write_shells() {
    // In the order in which each first appears, so that what is read comes back in its order.
    struct Kind {
      int section;
      std::string type;
      std::vector<int> shells;
    };
    std::vector<Kind> kinds;
    std::map<std::tuple<int, std::string, bool>, std::size_t> known;
    for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
      const Shell& shell = mesh_.shells[s];
      if (shell.section < 0)
        throw ModelError(fmt::format("shell {} has no thickness; a deck needs one", shell.label));
      if (mesh_.section_of(shell).laminate >= 0)
        throw ModelError(
            fmt::format("shell {} is layered, which is not written here", shell.label));
      const bool is_quadratic = !middles_[s].empty();
      const char* type =
          shell.is_triangle() ? (is_quadratic ? "STRI65" : "S3") : (is_quadratic ? "S8R" : "S4");
      const auto [found, is_new] =
          known.try_emplace({shell.section, type, shell.taper >= 0}, kinds.size());
      if (is_new) kinds.push_back({shell.section, type, {}});
      kinds[found->second].shells.push_back(static_cast<int>(s));
    }
    shell_number_.resize(mesh_.shells.size());
    for (const auto& [place, type, shells] : kinds) {
      const std::string set = new_set();
      line(fmt::format("*ELEMENT, TYPE={}, ELSET={}", type, set));
      for (const int s : shells) write_shell(s);
      const ShellSection& section = mesh_.shell_sections[place];
      line(fmt::format("*SHELL SECTION, ELSET={}, MATERIAL=M{}, OFFSET={}{}", set,
                       section.material + 1, exact(-section.offset / section.thickness),
                       mesh_.shells[shells.front()].taper >= 0 ? ", NODAL THICKNESS" : ""));
      line(exact(section.thickness / units_.length));
      if (section.mass_per_area > 0) {
        line(fmt::format("*NONSTRUCTURAL MASS, ELSET={}, UNITS=MASS PER AREA", set));
        line(exact(section.mass_per_area / units_.mass() * units_.length * units_.length));
      }
    }
  }

  /// A node has one thickness, whatever meets there.
  void write_nodal_thickness() {
    std::map<int, double> of_node;
    const auto note = [&](int vertex, const Shell& shell, const Eigen::Vector2d& xi) {
      const double thickness = thickness_at(mesh_, shell, xi);
      const auto [found, is_new] = of_node.try_emplace(vertex, thickness);
      if (std::abs(found->second - thickness) > 1e-6 * thickness)
        throw ModelError(fmt::format(
            "shells {:.6g} and {:.6g} mm thick meet at node {}, of which one has a thickness that "
            "varies; *NODAL THICKNESS has one for each node",
            1000 * found->second, 1000 * thickness, label(vertex)));
    };
    for (const bool is_tapered : {true, false})
      for (std::size_t s = 0; s < mesh_.shells.size(); ++s) {
        const Shell& shell = mesh_.shells[s];
        if ((shell.taper >= 0) != is_tapered) continue;
        const auto is_known = [&](int vertex) { return of_node.count(vertex) > 0; };
        for (int corner = 0; corner < 4; ++corner)
          if (is_tapered || is_known(shell.vertices[corner]))
            note(shell.vertices[corner], shell, {corner & 1, corner >> 1});
        const std::size_t corners = shell.is_triangle() ? 3 : 4;
        for (std::size_t i = 0; i < middles_[s].size(); ++i)
          if (is_tapered || is_known(middles_[s][i]))
            note(middles_[s][i], shell, place_of_middle(corners, i));
      }
    if (of_node.empty()) return;
    line("*NODAL THICKNESS");
    for (const auto& [vertex, thickness] : of_node)
      line(fmt::format("{}, {}", label(vertex), exact(thickness / units_.length)));
  }

  void write_shell(int s) {
    const Shell& shell = mesh_.shells[s];
    shell_number_[s] = elements_.take(shell.label);
    std::vector<int> around{shell.vertices[0], shell.vertices[1], shell.vertices[3]};
    if (!shell.is_triangle()) around.push_back(shell.vertices[2]);
    around.insert(around.end(), middles_[s].begin(), middles_[s].end());
    std::string text = std::to_string(shell_number_[s]);
    for (const int vertex : around) text += fmt::format(", {}", label(vertex));
    line(text);
  }

  std::string new_set() {
    element_sets_.push_back(fmt::format("E{}", element_sets_.size() + 1));
    return element_sets_.back();
  }

  BeamKind kind_of(const Beam& beam) const {
    BeamKind kind;
    kind.section = beam.section;
    kind.is_rod = beam.is_rod;
    if (beam.end_section >= 0)
      throw ModelError(
          fmt::format("beam {} is tapered; Abaqus' general sections are of one size", beam.label));
    if (beam.is_rod) return kind;
    const Vector3 line = mesh_.vertices[beam.vertices[1]] - mesh_.vertices[beam.vertices[0]];
    const Eigen::Matrix<double, 2, 3> axes = axes_along(line, beam.axis_2).bottomRows<2>();
    kind.axis_2 = axes.row(0);
    kind.centroid = axes * beam.offset[0];
    const Vector3 across = axes.transpose() * kind.centroid;
    if ((beam.offset[0] - across).norm() + (beam.offset[1] - across).norm() > 1e-9 * line.norm())
      throw ModelError(
          fmt::format("beam {} has offsets that differ between its ends or go along it; "
                      "Abaqus' sections have one offset across",
                      beam.label));
    return kind;
  }

  void write_beams() {
    std::vector<BeamKind> kinds;
    std::map<std::tuple<int, bool, long, long, long, long, long>, std::size_t> known;
    const auto rounded = [](double value) { return std::lround(value * 1e9); };
    for (std::size_t b = 0; b < mesh_.beams.size(); ++b) {
      const BeamKind kind = kind_of(mesh_.beams[b]);
      const auto key =
          std::tuple(kind.section, kind.is_rod, rounded(kind.axis_2[0]), rounded(kind.axis_2[1]),
                     rounded(kind.axis_2[2]), rounded(kind.centroid[0]), rounded(kind.centroid[1]));
      const auto [found, is_new] = known.try_emplace(key, kinds.size());
      if (is_new) kinds.push_back(kind);
      kinds[found->second].beams.push_back(static_cast<int>(b));
    }
    beam_number_.resize(mesh_.beams.size());
    for (const BeamKind& kind : kinds) write_beams_of(kind);
    write_releases();
  }

  void write_beams_of(const BeamKind& kind) {
    const std::string set = new_set();
    line(fmt::format("*ELEMENT, TYPE={}, ELSET={}", kind.is_rod ? "T3D2" : "B31", set));
    for (const int b : kind.beams) {
      const Beam& beam = mesh_.beams[b];
      beam_number_[b] = elements_.take(beam.label);
      line(fmt::format("{}, {}, {}", beam_number_[b], label(beam.vertices[0]),
                       label(beam.vertices[1])));
    }
    const BeamSection& section = mesh_.beam_sections[kind.section];
    const Material& material = mesh_.materials[section.material];
    const double square = units_.length * units_.length, fourth = square * square;
    if (kind.is_rod) {
      line(fmt::format("*SOLID SECTION, ELSET={}, MATERIAL=M{}", set, section.material + 1));
      line(exact(section.area / square));
    } else {
      line(fmt::format("*BEAM GENERAL SECTION, ELSET={}, SECTION=GENERAL, DENSITY={}", set,
                       exact(material.density / units_.density())));
      line(fmt::format("{}, {}, {}, {}, {}", exact(section.area / square),
                       exact(section.second_moment_2 / fourth), exact(section.product_23 / fourth),
                       exact(section.second_moment_3 / fourth), exact(section.torsion / fourth)));
      line(exact(kind.axis_2));
      line(exact(material.youngs_modulus / units_.stress()) + ", " +
           exact(material.shear_modulus() / units_.stress()) +
           temperatures_.of_general_section(section.material));
      write_details(kind, section, material.shear_modulus());
    }
    if (section.mass_per_length > 0) {
      line(fmt::format("*NONSTRUCTURAL MASS, ELSET={}, UNITS=MASS PER LENGTH", set));
      line(exact(section.mass_per_length / units_.mass() * units_.length));
    }
  }

  void write_details(const BeamKind& kind, const BeamSection& section, double shear) {
    const auto pair = [&](const Eigen::Vector2d& value) {
      return exact(value[0] / units_.length) + ", " + exact(value[1] / units_.length);
    };
    line("*CENTROID");
    line(pair(kind.centroid));
    line("*SHEAR CENTER");
    line(pair(kind.centroid + section.twist_centre()));
    if (std::isfinite(section.shear_area_2) && std::isfinite(section.shear_area_3)) {
      line("*TRANSVERSE SHEAR STIFFNESS");
      line(exact(section.shear_area_3 * shear / units_.force) + ", " +
           exact(section.shear_area_2 * shear / units_.force));
    }
    if (section.stress_points.empty()) return;
    line("*SECTION POINTS");
    for (const Eigen::Vector2d& point : section.stress_points) line(pair(kind.centroid + point));
  }

  void write_releases() {
    bool is_first = true;
    for (std::size_t b = 0; b < mesh_.beams.size(); ++b)
      for (std::size_t end = 0; end < 2; ++end) {
        const BeamRelease& release = mesh_.beams[b].release[end];
        if (std::find(release.begin(), release.end(), true) == release.end()) continue;
        if (release[0] || release[1] || release[2])
          throw ModelError(
              fmt::format("beam {} is released against a displacement; Abaqus releases "
                          "rotations alone",
                          mesh_.beams[b].label));
        if (is_first) line("*RELEASE");
        is_first = false;
        const bool m1 = release[4], m2 = release[5], t = release[3];
        const std::string code = m1 && m2 && t ? "ALLM"
                                 : m1 && m2    ? "M1-M2"
                                 : m1 && t     ? "M1-T"
                                 : m2 && t     ? "M2-T"
                                 : m1          ? "M1"
                                 : m2          ? "M2"
                                               : "T";
        line(fmt::format("{}, S{}, {}", beam_number_[b], end + 1, code));
      }
  }

  /// One set and section for each region's solids of one shape and material.
  void write_solids() {
    solid_number_.resize(mesh_.solids.size());
    std::map<std::tuple<int, int, int, SolidShape>, std::vector<const Solid*>> kinds;
    for (const Solid& solid : mesh_.solids) {
      if (solid.shape == SolidShape::pyramid)
        throw ModelError(fmt::format(
            "solid {} is a pyramid with middles of its edges, which is not written here",
            solid.label));
      kinds[{solid.region, solid.material, solid.elasticity, solid.shape}].push_back(&solid);
    }
    for (const auto& [kind, solids] : kinds) {
      const auto& [region, material, elasticity, shape] = kind;
      const std::string set = new_set();
      line(fmt::format("*ELEMENT, TYPE=C3D{}, ELSET={}", topology_of(shape).nodes(), set));
      for (const Solid* solid : solids) {
        long& number = solid_number_[solid - mesh_.solids.data()];
        std::string text = std::to_string(number = elements_.take(solid->label));
        for (std::size_t i = 0; i < solid->vertices.size(); ++i)
          text += fmt::format("{}{}", i == 10 ? ",\n" : ", ", label(solid->vertices[i]));
        line(text);
      }
      if (elasticity < 0) {
        line(fmt::format("*SOLID SECTION, ELSET={}, MATERIAL=M{}", set, material + 1));
        continue;
      }
      write_directional(material, elasticity);
      line(fmt::format("*SOLID SECTION, ELSET={}, MATERIAL=M{}D{}, ORIENTATION=BASIC", set,
                       material + 1, elasticity + 1));
    }
  }

  /// A material by its stiffness along the basic axes, once for each section that has it.
  void write_directional(int material, int elasticity) {
    if (written_.empty()) {
      line("*ORIENTATION, NAME=BASIC");
      line("1., 0., 0., 0., 1., 0.");
    }
    if (!written_.insert({material, elasticity}).second) return;
    line(fmt::format("*MATERIAL, NAME=M{}D{}", material + 1, elasticity + 1));
    line("*ELASTIC, TYPE=ANISOTROPIC");
    // Of 11, 22, 33, 12, 13, 23 the upper half, column by column, eight on a line.
    static constexpr std::array<Eigen::Index, 6> order{0, 1, 2, 3, 5, 4};
    const Elasticity d = mesh_.elasticities[elasticity] / units_.stress();
    std::string text;
    int count = 0;
    for (std::size_t j = 0; j < order.size(); ++j)
      for (std::size_t i = 0; i <= j; ++i) {
        text += exact(d(order[i], order[j]));
        text += ++count % 8 == 0 ? ",\n" : count < 21 ? ", " : "";
      }
    line(text);
    write_density_and_yield(mesh_.materials[material]);
  }

  /// A node of its own, rigidly held by a vertex.
  long held_node(int vertex, const Vector3& offset) {
    const long node = nodes_.take(0);
    line("*NODE");
    line(fmt::format("{}, {}", node, exact((mesh_.vertices[vertex] + offset) / units_.length)));
    line("*MPC");
    line(fmt::format("BEAM, {}, {}", node, label(vertex)));
    return node;
  }

  void write_masses() {
    for (const PointMass& mass : mesh_.masses) {
      const long node =
          mass.offset.isZero() ? label(mass.vertex) : held_node(mass.vertex, mass.offset);
      if (mass.mass > 0) {
        const std::string set = new_set();
        line(fmt::format("*ELEMENT, TYPE=MASS, ELSET={}", set));
        line(fmt::format("{}, {}", elements_.take(mass.label), node));
        line("*MASS, ELSET=" + set);
        line(exact(mass.mass / units_.mass()));
      }
      if (mass.inertia.isZero()) continue;
      const std::string set = new_set();
      line(fmt::format("*ELEMENT, TYPE=ROTARYI, ELSET={}", set));
      line(fmt::format("{}, {}", elements_.take(mass.mass > 0 ? 0 : mass.label), node));
      const Eigen::Matrix3d i = mass.inertia / (units_.mass() * units_.length * units_.length);
      line("*ROTARY INERTIA, ELSET=" + set);
      line(fmt::format("{}, {}, {}, {}, {}, {}", exact(i(0, 0)), exact(i(1, 1)), exact(i(2, 2)),
                       exact(i(0, 1)), exact(i(0, 2)), exact(i(1, 2))));
    }
  }

  void write_springs() {
    for (const Spring& spring : mesh_.springs) {
      if (!spring.arms[0].isZero() || !spring.arms[1].isZero())
        throw ModelError(fmt::format("spring {} acts away from its vertices, which Abaqus' do not",
                                     spring.label));
      const bool has_end = spring.vertices[1] >= 0;
      const std::string set = new_set();
      line(fmt::format("*ELEMENT, TYPE=SPRING{}, ELSET={}", has_end ? 2 : 1, set));
      std::string text =
          fmt::format("{}, {}", elements_.take(spring.label), label(spring.vertices[0]));
      if (has_end) text += fmt::format(", {}", label(spring.vertices[1]));
      line(text);
      line("*SPRING, ELSET=" + set);
      line(has_end ? fmt::format("{}, {}", spring.components[0] + 1, spring.components[1] + 1)
                   : fmt::format("{},", spring.components[0] + 1));
      const double unit = spring.components[0] < 3 ? units_.force / units_.length : units_.moment();
      line(exact(spring.stiffness / unit));
    }
  }

  void write_freedoms(const std::array<bool, 6>& bound) {
    if (std::all_of(bound.begin(), bound.end(), [](bool b) { return b; })) return;
    for (std::size_t i = 0; i < 6; ++i)
      if (bound[i]) line(fmt::format("{}, {}", i + 1, i + 1));
  }

  void write_links() {
    int number = 0;
    const auto couple = [&](int reference, const std::vector<int>& vertices,
                            const std::vector<double>& weights) {
      line(fmt::format("*SURFACE, NAME=C{}, TYPE=NODE", ++number));
      for (std::size_t i = 0; i < vertices.size(); ++i)
        line(fmt::format("{}, {}", label(vertices[i]), exact(weights.empty() ? 1.0 : weights[i])));
      line(fmt::format("*COUPLING, CONSTRAINT NAME=C{}, REF NODE={}, SURFACE=C{}", number,
                       label(reference), number));
    };
    for (const RigidLink& link : mesh_.rigid_links) {
      if (!is_free_of_axes(link.bound) && !is_identity(link.axes))
        throw ModelError(
            "a link binds a part of the freedoms along axes of its own, which is not "
            "written here");
      couple(link.master, link.slaves, {});
      line("*KINEMATIC");
      write_freedoms(link.bound);
    }
    for (const DistributingLink& link : mesh_.distributing_links) {
      if (!link.bound[0] || !link.bound[1] || !link.bound[2] ||
          (!is_free_of_axes(link.bound) && !is_identity(link.axes)))
        throw ModelError("a link distributes a part of the displacements, which Abaqus' do not");
      couple(link.reference, link.vertices, link.weights);
      line("*DISTRIBUTING");
      write_freedoms(link.bound);
    }
    write_equations();
  }

  void write_equations() {
    std::set<int> taken;
    for (const MotionEquation& equation : mesh_.equations) {
      const std::vector<ScalarTerm> terms = scalar_terms(equation, units_, axes_, taken);
      line("*EQUATION");
      line(std::to_string(terms.size()));
      for (const ScalarTerm& term : terms)
        line(fmt::format("{}, {}, {}", label(term.vertex), term.component + 1, exact(term.factor)));
    }
  }

  void write_transforms() {
    for (std::size_t v = 0; v < axes_.size(); ++v) {
      if (is_identity(axes_[v])) continue;
      line(fmt::format("*NSET, NSET=T{}", v + 1));
      line(std::to_string(label(static_cast<int>(v))));
      line(fmt::format("*TRANSFORM, NSET=T{}, TYPE=R", v + 1));
      line(exact(Vector3(axes_[v].col(0))) + ", " + exact(Vector3(axes_[v].col(1))));
    }
  }

  void write_step(const DeckLoadCase& one) {
    line(one.title.empty() ? "*STEP" : fmt::format("*STEP, NAME=\"{}\"", one.title));
    line("*STATIC");
    line("*BOUNDARY, OP=NEW");
    for (const int set : one.supports)
      for (const Support& support : deck_.support_sets[set].supports)
        for (std::size_t i = 0; i < 6; ++i)
          if (support.held[i])
            line(fmt::format("{}, {}, {}, {}", label(support.vertex), i + 1, i + 1,
                             exact(i < 3 ? support.value[i] / units_.length : support.value[i])));
    line("*CLOAD, OP=NEW");
    for (const PointLoad& load : loads_at_vertices(deck_, one))
      write_point_load(load.vertex, load.force, load.moment);
    line("*DLOAD, OP=NEW");
    for (const auto& [set, factor] : one.loads) write_spread_loads(deck_.load_sets[set], factor);
    text_ += temperatures_.of_step(one, node_number_, middles_);
    line("*NODE FILE");
    line("U, RF");
    line("*EL FILE");
    line("S");
    line("*END STEP");
  }

  void write_point_load(int vertex, const Vector3& force, const Vector3& moment) {
    const Vector3 along = axes_[vertex].transpose() * force / units_.force;
    const Vector3 about = axes_[vertex].transpose() * moment / units_.moment();
    for (int i = 0; i < 3; ++i)
      if (along[i] != 0) line(fmt::format("{}, {}, {}", label(vertex), i + 1, exact(along[i])));
    for (int i = 0; i < 3; ++i)
      if (about[i] != 0) line(fmt::format("{}, {}, {}", label(vertex), i + 4, exact(about[i])));
  }

  static void check_even(const std::array<double, 4>& pressure, std::size_t corners,
                         const Vector3& direction) {
    const auto [least, most] =
        std::minmax_element(pressure.begin(), pressure.begin() + static_cast<long>(corners));
    if (!direction.isZero() || *most - *least > 1e-9 * std::abs(*most))
      throw ModelError("a pressure is not even and normal to its face, which is not written here");
  }

  void write_spread_loads(const LoadSet& set, double factor) {
    for (const PlateLoad& load : set.plate_loads) {
      check_even(load.pressure, 4, load.direction);
      line(fmt::format("{}, P, {}", shell_number_[load.shell],
                       exact(factor * load.pressure[0] / units_.stress())));
    }
    for (const SolidLoad& load : set.solid_loads) {
      const Solid& solid = mesh_.solids[load.solid];
      check_even(load.pressure, topology_of(solid.shape).faces[load.face].size(), load.direction);
      line(fmt::format("{}, P{}, {}", solid_number_[load.solid], load.face + 1,
                       exact(factor * load.pressure[0] / units_.stress())));
    }
    for (const BeamLoad& load : set.beam_loads)
      for (int i = 0; i < 3 && is_even_between_vertices(load); ++i)
        if (load.force[0][i] != 0)
          line(fmt::format("{}, P{}, {}", beam_number_[load.beam], static_cast<char>('X' + i),
                           exact(factor * load.force[0][i] * units_.length / units_.force)));
    for (const Spin& spin : set.spins) {
      if (!spin.acceleration.isZero(0) || factor < 0 || spin.part)
        throw ModelError("a rotation that grows, pulls inwards or is a part's is not written here");
      line(fmt::format(
          "EVERYTHING, CENTRIF, {}, {}, {}", exact(factor * spin.velocity.squaredNorm()),
          exact(Vector3(spin.place / units_.length)), exact(Vector3(spin.velocity.normalized()))));
    }
    if (!set.edge_loads.empty() || !set.volume_loads.empty())
      throw ModelError("loads of edges and per volume are not written here");
    if (!set.pulls.empty()) throw ModelError("gravity on a part of the masses is not written here");
    const double gravity = factor * set.gravity.norm() / units_.length;
    if (gravity != 0)
      line(fmt::format("EVERYTHING, GRAV, {}, {}", exact(gravity),
                       exact(Vector3(set.gravity.normalized()))));
  }

  Deck deck_;  // middles of curved shells may be added
  Mesh& mesh_;
  const UnitSystem units_;
  AbaqusTemperatureText temperatures_;
  std::vector<Eigen::Matrix3d> axes_;
  Numbering elements_, nodes_;
  std::vector<long> node_number_, shell_number_, solid_number_, beam_number_;
  std::vector<std::vector<int>> middles_;
  std::vector<std::string> element_sets_;
  std::set<std::pair<int, int>> written_;  ///< materials with elasticities
  std::string text_;
};

}  // namespace

std::string to_abaqus(const Deck& deck) { return AbaqusText(with_held_middles(deck)).write(); }

void write_abaqus(const Deck& deck, const std::filesystem::path& path) {
  const std::string text = to_abaqus(deck);
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw ModelError("cannot write \"" + path.string() + "\"");
}

}  // namespace blocklift::structure

// Masses, springs, couplings, rigid bodies, equations.

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "algebra/decompositions.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/deck/equations.h"
#include "structure/mesh/files/deck/spread_mass.h"
#include "structure/mesh/mass_properties.h"

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;
using Components = std::array<bool, 6>;

constexpr Components all_six{true, true, true, true, true, true};
constexpr Components displacements{true, true, true, false, false, false};

class LinkBlocks {
 public:
  explicit LinkBlocks(AbaqusModel& model) : model_(model), mesh_(model.deck.mesh) {}

  void read() {
    find_rotation_nodes();
    for (const AbaqusScope& scope : model_.scopes) {
      scope_ = &scope;
      for (std::size_t i = 0; i < scope.blocks.size(); ++i) {
        const AbaqusBlock& block = *scope.blocks[i];
        const AbaqusBlock* next = i + 1 < scope.blocks.size() ? scope.blocks[i + 1] : nullptr;
        const auto on = [&](const char* name, auto step) {
          if (block.name == name) model_.guarded(block, step);
        };
        on("MASS", [&] { add_masses(block); });
        on("ROTARY INERTIA", [&] { add_inertias(block); });
        on("NONSTRUCTURAL MASS", [&] { add_spread_mass(block); });
        on("SPRING", [&] { add_springs(block); });
        on("COUPLING", [&] { add_coupling(block, next); });
        on("KINEMATIC COUPLING", [&] { add_kinematic_coupling(block); });
        on("DISTRIBUTING COUPLING", [&] { add_distributing_coupling(block); });
        on("RIGID BODY", [&] { add_rigid_body(block); });
        on("MPC", [&] { add_mpc(block); });
        on("EQUATION", [&] { add_equations(block); });
      }
    }
  }

 private:
  /// Those of all rigid bodies, which equations before them may name. What is wrong with a body is
  /// said where it is read.
  void find_rotation_nodes() {
    for (const AbaqusScope& scope : model_.scopes)
      for (const AbaqusBlock* block : scope.blocks) {
        if (block->name != "RIGID BODY" || !block->has("ROT NODE")) continue;
        try {
          const int turning = model_.node_of(scope, block->required("ROT NODE"));
          model_.turns_of[turning] = model_.node_of(scope, block->required("REF NODE"));
        } catch (const CardError&) {
          continue;
        }
      }
  }

  std::vector<int> elements(const AbaqusBlock& block, AbaqusKind kind) const {
    std::vector<int> all = model_.elements_of(*scope_, block.required("ELSET"));
    for (const int e : all)
      if (model_.elements[e].kind != kind)
        throw CardError{
            fmt::format("element {} is a {}", model_.elements[e].label, model_.elements[e].type)};
    return all;
  }

  Fields first_line(const AbaqusBlock& block) const {
    if (block.data.empty()) throw CardError{"a line of data is missing"};
    return block.data.front().fields();
  }

  void add_masses(const AbaqusBlock& block) {
    const double value = abaqus_real(first_line(block), 0, "mass") * model_.units.mass();
    if (value < 0) throw CardError{"the mass is negative"};
    for (const int e : elements(block, AbaqusKind::mass)) {
      PointMass mass;
      mass.vertex = model_.elements[e].nodes.front();
      mass.label = model_.elements[e].label;
      mass.mass = value;
      model_.elements[e].masses.push_back(static_cast<int>(mesh_.masses.size()));
      mesh_.masses.push_back(mass);
    }
  }

  // I11, I22, I33, I12, I13, I23: entries of the tensor, products with their sign
  void add_inertias(const AbaqusBlock& block) {
    const Fields fields = first_line(block);
    std::array<double, 6> i{};
    for (std::size_t k = 0; k < 6; ++k) i[k] = abaqus_real(fields, k, "moment of inertia", 0.0);
    if (block.has("ORIENTATION")) throw CardError{"ORIENTATION is not known"};
    Eigen::Matrix3d inertia;
    inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
    if (algebra::symmetric_eigenvalues(inertia)[0] < -1e-6 * inertia.norm())
      throw CardError{"a moment of inertia is negative"};
    const double length = model_.units.length;
    for (const int e : elements(block, AbaqusKind::inertia)) {
      PointMass mass;
      mass.vertex = model_.elements[e].nodes.front();
      mass.label = model_.elements[e].label;
      mass.inertia = scope_->turn * (inertia * model_.units.mass() * length * length) *
                     scope_->turn.transpose();
      mesh_.masses.push_back(mass);
    }
  }

  /// What has a mass that can be spread, by its places in the mesh.
  struct Cells {
    std::vector<int> shells, beams, solids;
  };

  Cells cells_of(const AbaqusBlock& block) const {
    Cells cells;
    for (const int e : model_.elements_of(*scope_, block.required("ELSET"))) {
      const AbaqusDeckElement& element = model_.elements[e];
      if (element.shell >= 0 && mesh_.shells[element.shell].section < 0)
        throw CardError{fmt::format("element {} has no section yet", element.label)};
      if (element.shell >= 0)
        cells.shells.push_back(element.shell);
      else if (element.solid >= 0)
        cells.solids.push_back(element.solid);
      else if (!element.beams.empty())
        cells.beams.insert(cells.beams.end(), element.beams.begin(), element.beams.end());
      else if (element.kind == AbaqusKind::solid || element.kind == AbaqusKind::nothing)
        model_.log.leave_out("*NONSTRUCTURAL MASS", "the part of elements that are left out");
      else
        model_.log.remark(block.line,
                          "*NONSTRUCTURAL MASS: elements that are no shells, beams, trusses or "
                          "solids get none of it");
    }
    return cells;
  }

  // *NONSTRUCTURAL MASS, ELSET = , UNITS = MASS PER VOLUME | AREA | LENGTH, TOTAL MASS,
  // DISTRIBUTION = MASS PROPORTIONAL | VOLUME PROPORTIONAL (of a total)
  void add_spread_mass(const AbaqusBlock& block) {
    const std::string units = block.required("UNITS");
    const double value = abaqus_real(first_line(block), 0, "mass") * model_.units.mass();
    const double length = model_.units.length;
    const Cells cells = cells_of(block);
    if (units == "MASS PER VOLUME") {
      add_in_proportion(cells, value / (length * length * length), false);
    } else if (units == "TOTAL MASS") {
      const bool is_by_mass = without_blanks(block.value("DISTRIBUTION")) != "VOLUMEPROPORTIONAL";
      const double size = size_of(cells, is_by_mass);
      if (!(size > 0))
        throw CardError{fmt::format("there is no {} that the total could be spread by",
                                    is_by_mass ? "mass" : "volume")};
      add_in_proportion(cells, value / size, is_by_mass);
    } else if (units == "MASS PER AREA" && cells.beams.empty() && cells.solids.empty()) {
      add_mass_per_area(mesh_, cells.shells, value / (length * length));
    } else if (units == "MASS PER LENGTH" && cells.shells.empty() && cells.solids.empty()) {
      add_mass_per_length(mesh_, cells.beams, value / length);
    } else {
      throw CardError{
          fmt::format("UNITS = {} of these elements ({} shells, {} beams, {} solids) is not known; "
                      "MASS PER VOLUME, TOTAL MASS, MASS PER AREA of shells alone, MASS PER LENGTH "
                      "of beams alone are",
                      units, cells.shells.size(), cells.beams.size(), cells.solids.size())};
    }
  }

  /// Density by which masses count, or 1 where volumes do.
  double density(int material, bool is_by_mass) const {
    return is_by_mass ? mesh_.materials[material].density : 1.0;
  }

  /// Mass per area, or the thickness.
  double of_shell(int shell, bool is_by_mass) const {
    const ShellSection& section = mesh_.section_of(mesh_.shells[shell]);
    return section.thickness * density(section.material, is_by_mass);
  }

  /// Mass per length, or the area.
  double of_beam(int beam, bool is_by_mass) const {
    const BeamSection& section = mesh_.section_of(mesh_.beams[beam]);
    return section.area * density(section.material, is_by_mass);
  }

  /// Mass of all, or their volume, by the figures that mass is added by.
  double size_of(const Cells& cells, bool is_by_mass) const {
    double sum = 0;
    for (const int s : cells.shells) sum += total_area(mesh_, {s}) * of_shell(s, is_by_mass);
    for (const int b : cells.beams) sum += total_length(mesh_, {b}) * of_beam(b, is_by_mass);
    for (const int s : cells.solids)
      sum += total_volume(mesh_, {s}) * density(mesh_.solids[s].material, is_by_mass);
    return sum;
  }

  /// Adds mass by the cells' volumes, kg/m^3, or in a share of their own mass.
  void add_in_proportion(const Cells& cells, double value, bool is_by_mass) {
    std::map<double, std::vector<int>> shells, beams, solids;
    for (const int s : cells.shells) shells[of_shell(s, is_by_mass)].push_back(s);
    for (const int b : cells.beams) beams[of_beam(b, is_by_mass)].push_back(b);
    for (const int s : cells.solids)
      solids[density(mesh_.solids[s].material, is_by_mass)].push_back(s);
    for (const auto& [figure, some] : shells) add_mass_per_area(mesh_, some, value * figure);
    for (const auto& [figure, some] : beams) add_mass_per_length(mesh_, some, value * figure);
    for (const auto& [figure, some] : solids) add_mass_to_solids(mesh_, some, value * figure);
  }

  // *SPRING, ELSET = / freedoms (none for SPRINGA) / stiffness
  void add_springs(const AbaqusBlock& block) {
    if (block.has("NONLINEAR") || block.has("ORIENTATION"))
      throw CardError{"NONLINEAR and ORIENTATION are not known"};
    // The first line may be blank, in which case it is not among the lines of data.
    const bool has_freedoms = block.data.size() > 1;
    const Fields freedoms = has_freedoms ? block.data[0].fields() : Fields{};
    if (block.data.empty()) throw CardError{"the stiffness is missing"};
    const double stiffness = abaqus_real(block.data[has_freedoms ? 1 : 0].fields(), 0, "stiffness");
    if (stiffness < 0) throw CardError{"the stiffness is negative"};
    for (const int e : elements(block, AbaqusKind::spring)) {
      const AbaqusDeckElement& element = model_.elements[e];
      Spring spring;
      spring.label = element.label;
      spring.vertices[0] = element.nodes[0];
      if (element.nodes.size() > 1) spring.vertices[1] = element.nodes[1];
      double unit = model_.units.force / model_.units.length;
      if (element.type == "SPRINGA") {
        const Vector3 line = model_.place(element.nodes[1]) - model_.place(element.nodes[0]);
        if (!(line.norm() > 1e-9))
          throw CardError{fmt::format("element {} has no length", element.label)};
        Eigen::Matrix3d axes;
        axes.col(0) = line.normalized();
        axes.col(1) = line.unitOrthogonal();
        axes.col(2) = axes.col(0).cross(axes.col(1));
        spring.axes = {axes, axes};
      } else {
        for (std::size_t end = 0; end < element.nodes.size(); ++end) {
          const long freedom = end < freedoms.size() ? abaqus_label(freedoms[end], "freedom") : 0;
          if (freedom < 1 || freedom > 6) throw CardError{"a freedom of 1 to 6 is missing"};
          spring.components[end] = static_cast<int>(freedom) - 1;
          spring.axes[end] = model_.axes(element.nodes[end]);
        }
        if (element.nodes.size() < 2) {
          spring.components[1] = spring.components[0];
          spring.axes[1] = spring.axes[0];
        }
        if ((spring.components[0] < 3) != (spring.components[1] < 3))
          throw CardError{"a displacement is joined with a rotation"};
        if (spring.components[0] >= 3) unit = model_.units.moment();
      }
      spring.stiffness = stiffness * unit;
      if (stiffness > 0) mesh_.springs.push_back(spring);
    }
  }

  /// Vertices of a surface with the area, or the length of edges, that each stands for.
  std::map<int, double> vertices_of(const AbaqusSurface& surface) const {
    std::map<int, double> weights = surface.nodes;
    for (const auto& [e, face] : surface.faces) {
      const AbaqusDeckElement& element = model_.elements[e];
      if (element.solid >= 0) {
        add_face(corners_of_face(element, face), weights);
        continue;
      }
      if (element.shell < 0)
        throw CardError{
            fmt::format("element {} of the surface is no shell and no solid", element.label)};
      const Shell& shell = mesh_.shells[element.shell];
      const std::size_t corners = shell.is_triangle() ? 3 : 4;
      if (face == "SPOS" || face == "SNEG" || face == "SPOS,SNEG") {
        const double share = area(mesh_, shell) / static_cast<double>(corners);
        for (std::size_t i = 0; i < corners; ++i) weights[element.nodes[i]] += share;
      } else if (face.size() == 2 && face[0] == 'E' && face[1] >= '1' &&
                 face[1] < static_cast<char>('1' + corners)) {
        const auto side = static_cast<std::size_t>(face[1] - '1');
        const int a = element.nodes[side], b = element.nodes[(side + 1) % corners];
        const double share = (model_.place(a) - model_.place(b)).norm() / 2;
        weights[a] += share;
        weights[b] += share;
      } else {
        throw CardError{
            fmt::format("the face {} of a shell is not known; SPOS, SNEG, E1 to E4 are", face)};
      }
    }
    return weights;
  }

  void add_face(const std::vector<int>& corners, std::map<int, double>& weights) const {
    Vector3 twice = Vector3::Zero();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      twice += (model_.place(corners[i]) - model_.place(corners[0]))
                   .cross(model_.place(corners[i + 1]) - model_.place(corners[0]));
    for (const int corner : corners)
      weights[corner] += 0.5 * twice.norm() / static_cast<double>(corners.size());
  }

  /// Components that lines of "first, last" name; all if there are none.
  static Components components_of(const AbaqusBlock& block) {
    if (block.data.empty()) return all_six;
    Components bound{};
    for (const AbaqusLine& line : block.data) {
      const Fields fields = line.fields();
      if (fields.empty() || fields[0].empty()) return all_six;
      const long first = abaqus_label(fields[0], "freedom");
      const long last =
          fields.size() > 1 && !fields[1].empty() ? abaqus_label(fields[1], "freedom") : first;
      if (last > 6 || first > last) throw CardError{"freedoms go from 1 to 6"};
      for (long i = first; i <= last; ++i) bound[i - 1] = true;
    }
    return bound;
  }

  // *COUPLING, REF NODE = , SURFACE = / *KINEMATIC or *DISTRIBUTING / first, last
  void add_coupling(const AbaqusBlock& block, const AbaqusBlock* next) {
    if (block.has("ORIENTATION") || block.has("INFLUENCE RADIUS"))
      throw CardError{"ORIENTATION and INFLUENCE RADIUS are not known"};
    const int reference = model_.node_of(*scope_, block.required("REF NODE"));
    const AbaqusSurface& surface = model_.surface(*scope_, block.required("SURFACE")).second;
    std::map<int, double> weights = vertices_of(surface);
    weights.erase(reference);
    if (weights.empty()) throw CardError{"the surface has no nodes"};
    if (next != nullptr && next->name == "KINEMATIC") {
      model_.guarded(*next, [&] {
        RigidLink link;
        link.master = reference;
        link.bound = components_of(*next);
        for (const auto& [vertex, weight] : weights) link.slaves.push_back(vertex);
        mesh_.rigid_links.push_back(link);
      });
    } else if (next != nullptr && next->name == "DISTRIBUTING") {
      model_.guarded(*next, [&] {
        if (next->value("COUPLING") == "STRUCTURAL" ||
            (next->has("WEIGHTING METHOD") && next->value("WEIGHTING METHOD") != "UNIFORM"))
          throw CardError{"COUPLING = CONTINUUM and WEIGHTING METHOD = UNIFORM alone are known"};
        DistributingLink link;
        link.reference = reference;
        link.bound = components_of(*next);
        for (const auto& [vertex, weight] : weights) {
          link.vertices.push_back(vertex);
          link.weights.push_back(weight);
        }
        mesh_.distributing_links.push_back(link);
      });
    } else {
      throw CardError{"*KINEMATIC or *DISTRIBUTING is to follow"};
    }
  }

  // *KINEMATIC COUPLING, REF NODE = / node or set, first, last
  void add_kinematic_coupling(const AbaqusBlock& block) {
    if (block.has("ORIENTATION")) throw CardError{"ORIENTATION is not known"};
    const int reference = model_.node_of(*scope_, block.required("REF NODE"));
    model_.for_lines(block, [&](const Fields& fields) {
      RigidLink link;
      link.master = reference;
      const auto given = [&](std::size_t i) { return i < fields.size() && !fields[i].empty(); };
      if (given(1)) {
        const long first = abaqus_label(fields[1], "freedom");
        const long last = given(2) ? abaqus_label(fields[2], "freedom") : first;
        if (last > 6 || first > last) throw CardError{"freedoms go from 1 to 6"};
        link.bound.fill(false);
        for (long i = first; i <= last; ++i) link.bound[i - 1] = true;
      }
      for (const int node : model_.nodes_of(*scope_, fields[0]))
        if (node != reference) link.slaves.push_back(node);
      if (!link.slaves.empty()) mesh_.rigid_links.push_back(link);
    });
  }

  // *DISTRIBUTING COUPLING, ELSET = (of one DCOUP3D) / node or set, weight
  void add_distributing_coupling(const AbaqusBlock& block) {
    for (const int e : elements(block, AbaqusKind::coupling)) {
      DistributingLink link;
      link.reference = model_.elements[e].nodes.front();
      link.label = model_.elements[e].label;
      model_.for_lines(block, [&](const Fields& fields) {
        const double weight = abaqus_real(fields, 1, "weight", 1.0);
        if (!(weight > 0)) throw CardError{"a weight must be positive"};
        for (const int node : model_.nodes_of(*scope_, fields[0])) {
          if (node == link.reference) continue;
          link.vertices.push_back(node);
          link.weights.push_back(weight);
        }
      });
      if (block.data.empty()) throw CardError{"the coupling has no nodes"};
      if (!link.vertices.empty()) mesh_.distributing_links.push_back(link);
    }
  }

  // *RIGID BODY, REF NODE = , ROT NODE = , ELSET = , NSET = , PIN NSET = , TIE NSET =
  void add_rigid_body(const AbaqusBlock& block) {
    const int reference = model_.node_of(*scope_, block.required("REF NODE"));
    const int turning =
        block.has("ROT NODE") ? model_.node_of(*scope_, block.required("ROT NODE")) : -1;
    if (turning == reference) throw CardError{"ROT NODE and REF NODE are one"};
    std::set<int> tied, pinned;
    if (block.has("ELSET"))
      for (const int e : model_.elements_of(*scope_, block.value("ELSET")))
        tied.insert(model_.elements[e].nodes.begin(), model_.elements[e].nodes.end());
    for (const char* kind : {"TIE NSET", "NSET"})
      if (block.has(kind))
        for (const int node : model_.nodes_of(*scope_, block.value(kind))) tied.insert(node);
    if (block.has("PIN NSET"))
      for (const int node : model_.nodes_of(*scope_, block.value("PIN NSET"))) pinned.insert(node);
    if (block.has("ANALYTICAL SURFACE")) throw CardError{"analytical surfaces are not known"};
    for (const auto& [nodes, bound] :
         {std::pair(tied, all_six), std::pair(pinned, displacements)}) {
      RigidLink link;
      link.master = reference;
      link.bound = bound;
      for (const int node : nodes)
        if (node != reference && node != turning) link.slaves.push_back(node);
      if (!link.slaves.empty()) mesh_.rigid_links.push_back(link);
    }
  }

  // *MPC / BEAM | LINK | TIE | PIN, node or set, node
  void add_mpc(const AbaqusBlock& block) {
    model_.for_lines(block, [&](const Fields& fields) {
      if (fields.size() < 3) throw CardError{"type, node and node are due"};
      const std::string type = upper(fields[0]);
      const int master = model_.node_of(*scope_, fields[2]);
      if (type == "LINK") {
        for (const int slave : model_.nodes_of(*scope_, fields[1]))
          add_rigid_rod(model_.deck, slave, master);
        return;
      }
      RigidLink link;
      link.master = master;
      link.slaves = model_.nodes_of(*scope_, fields[1]);
      if (type == "PIN") link.bound = displacements;
      const bool is_at_place = std::all_of(link.slaves.begin(), link.slaves.end(), [&](int slave) {
        return (model_.place(slave) - model_.place(master)).norm() < 1e-6;
      });
      if (type != "BEAM" && !((type == "TIE" || type == "PIN") && is_at_place))
        throw CardError{
            fmt::format("{} is not known of nodes {}; BEAM, LINK, and TIE and PIN of nodes at "
                        "one place are",
                        type, is_at_place ? "at one place" : "apart")};
      mesh_.rigid_links.push_back(link);
    });
  }

  // *EQUATION / number of terms / node, freedom, factor, ...
  void add_equations(const AbaqusBlock& block) {
    for (std::size_t i = 0; i < block.data.size();) {
      const std::string place = model_.log.place(block.data[i].line);
      const long count = abaqus_label(block.data[i].fields().front(), "number of terms");
      Fields terms;
      for (++i; i < block.data.size() && static_cast<long>(terms.size()) < 3 * count; ++i) {
        const Fields more = block.data[i].fields();
        terms.insert(terms.end(), more.begin(), more.end());
      }
      if (static_cast<long>(terms.size()) < 3 * count) throw CardError{"terms are missing"};
      add_equation_of_sets(terms, static_cast<std::size_t>(count), place);
    }
  }

  /// One equation for each node of the first term's set; a set of one node serves all.
  void add_equation_of_sets(const Fields& fields, std::size_t count, const std::string& place) {
    std::vector<std::vector<int>> nodes;
    for (std::size_t t = 0; t < count; ++t)
      nodes.push_back(model_.nodes_of(*scope_, fields[3 * t]));
    for (std::size_t s = 0; s < nodes.front().size(); ++s) {
      std::vector<EquationTerm> terms;
      for (std::size_t t = 0; t < count; ++t) {
        if (nodes[t].size() != 1 && nodes[t].size() != nodes.front().size())
          throw CardError{fmt::format("the sets {} and {} have {} and {} nodes", fields[0],
                                      fields[3 * t], nodes.front().size(), nodes[t].size())};
        const long freedom = abaqus_label(fields[3 * t + 1], "freedom");
        if (freedom > 6) throw CardError{"freedoms go from 1 to 6"};
        const int node = nodes[t].size() == 1 ? nodes[t].front() : nodes[t][s];
        const double factor = abaqus_real(fields, 3 * t + 2, "factor");
        const auto [vertex, component] = model_.freedom_of(node, static_cast<int>(freedom) - 1);
        // What a ROT NODE's displacement is, in the deck's numbers, is an angle in radians.
        terms.push_back({{vertex, component, model_.axes(vertex)}, factor});
      }
      add_equation(model_.deck, terms, place);
    }
  }

  AbaqusModel& model_;
  Mesh& mesh_;
  const AbaqusScope* scope_ = nullptr;
};

}  // namespace

void read_abaqus_links(AbaqusModel& model) { LinkBlocks(model).read(); }

}  // namespace blocklift::structure

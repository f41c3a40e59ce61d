// Supports, loads and steps.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/abaqus/amplitudes.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/abaqus/spread_loads.h"
#include "structure/mesh/files/abaqus/temperatures.h"

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

/// What acts as far as the steps go, by what it is and where: what is given again in a later step
/// takes the place of the one before (OP = MOD); within a step all of it counts.
template <typename Key, typename Load>
class GivenBySteps {
 public:
  void begin_step() { ++step_; }
  /// OP = NEW.
  void drop_earlier() {
    std::erase_if(all_, [&](const auto& one) { return one.second.step != step_; });
  }
  void add(const Key& key, const Load& load) {
    Given& given = all_[key];
    if (given.step != step_) given = {step_, {}};
    given.loads.push_back(load);
  }
  /// Calls visit(key, load), in the order of the keys.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [key, given] : all_)
      for (const Load& load : given.loads) visit(key, load);
  }

 private:
  struct Given {
    int step = 0;
    std::vector<Load> loads;
  };

  int step_ = 0;
  std::map<Key, Given> all_;
};

/// Loads of one kind of keyword (*DLOAD, *DSLOAD).
struct SpreadLoads {
  /// What a load is and the element that it is on.
  using Key = std::pair<std::string, int>;

  void begin_step() {
    for_each_kind([](auto& loads) { loads.begin_step(); });
  }
  void drop_earlier() {
    for_each_kind([](auto& loads) { loads.drop_earlier(); });
  }
  void add_to(LoadSet& set) const {
    plates.for_each([&](const Key&, const PlateLoad& load) { set.plate_loads.push_back(load); });
    solids.for_each([&](const Key&, const SolidLoad& load) { set.solid_loads.push_back(load); });
    beams.for_each([&](const Key&, const BeamLoad& load) { set.beam_loads.push_back(load); });
    edges.for_each([&](const Key&, const EdgeLoad& load) { set.edge_loads.push_back(load); });
    volumes.for_each([&](const Key&, const VolumeLoad& load) { set.volume_loads.push_back(load); });
    gravity.for_each([&](const Key&, const PartPull& pull) {
      if (pull.part)
        set.pulls.push_back(pull);
      else
        set.gravity += pull.acceleration;
    });
    spins.for_each([&](const Key&, const Spin& spin) { set.spins.push_back(spin); });
  }
  /// Adds loads on elements. @param kind what they are, and on which face of which surface.
  void add(const std::string& kind, const LoadSet& set) {
    for (const PlateLoad& load : set.plate_loads) plates.add({kind, load.shell}, load);
    for (const SolidLoad& load : set.solid_loads) solids.add({kind, load.solid}, load);
    for (const BeamLoad& load : set.beam_loads) beams.add({kind, load.beam}, load);
    for (const EdgeLoad& load : set.edge_loads) edges.add({kind, load.shell}, load);
    for (const VolumeLoad& load : set.volume_loads) volumes.add({kind, load.solid}, load);
  }
  template <typename Visit>
  void for_each_kind(const Visit& visit) {
    visit(plates);
    visit(solids);
    visit(beams);
    visit(edges);
    visit(volumes);
    visit(gravity);
    visit(spins);
  }

  GivenBySteps<Key, PlateLoad> plates;
  GivenBySteps<Key, SolidLoad> solids;
  GivenBySteps<Key, BeamLoad> beams;
  GivenBySteps<Key, EdgeLoad> edges;
  GivenBySteps<Key, VolumeLoad> volumes;
  GivenBySteps<Key, PartPull> gravity;
  GivenBySteps<Key, Spin> spins;
};

/// Forces and moments, by node and freedom from 0 on.
using NodeLoads = GivenBySteps<std::pair<int, long>, Vector3>;

/// One load a node.
void add_to(LoadSet& set, const NodeLoads& loads) {
  loads.for_each([&](const std::pair<int, long>& key, const Vector3& vector) {
    const auto& [node, freedom] = key;
    if (set.point_loads.empty() || set.point_loads.back().vertex != node)
      set.point_loads.push_back({node, Vector3::Zero(), Vector3::Zero()});
    PointLoad& load = set.point_loads.back();
    (freedom < 3 ? load.force : load.moment) += vector;
  });
}

class StepBlocks {
 public:
  explicit StepBlocks(AbaqusModel& model) : model_(model), amplitudes_(model) {}

  void read() {
    for (const AbaqusScope& scope : model_.scopes) {
      scope_ = &scope;
      for (const AbaqusBlock* block : scope.blocks)
        if (block->name == "BOUNDARY") model_.guarded(*block, [&] { add_supports(*block); });
    }
    initial_ = read_initial_temperatures(model_);
    scope_ = &model_.scopes.front();
    for (const auto& blocks : model_.steps) read_step(blocks);
    if (model_.steps.empty() && !now_.supports.empty())
      model_.deck.support_sets.push_back({1, "supports of the model", now_.supports});
  }

 private:
  static bool named_condition(const std::string& name, std::array<bool, 6>& held) {
    static const std::map<std::string, std::array<bool, 6>> conditions{
        {"ENCASTRE", {true, true, true, true, true, true}},
        {"PINNED", {true, true, true, false, false, false}},
        {"XSYMM", {true, false, false, false, true, true}},
        {"YSYMM", {false, true, false, true, false, true}},
        {"ZSYMM", {false, false, true, true, true, false}},
        {"XASYMM", {false, true, true, true, false, false}},
        {"YASYMM", {true, false, true, false, true, false}},
        {"ZASYMM", {true, true, false, false, false, true}}};
    const auto found = conditions.find(name);
    if (found == conditions.end()) return false;
    held = found->second;
    return true;
  }

  // *BOUNDARY / node or set, first, last, value | node or set, ENCASTRE
  void add_supports(const AbaqusBlock& block) {
    if (block.has("TYPE") && block.value("TYPE") != "DISPLACEMENT")
      throw CardError{fmt::format("TYPE = {} is not known", block.value("TYPE"))};
    model_.for_lines(block, [&](const Fields& fields) {
      if (fields.size() < 2) throw CardError{"node and freedom are due"};
      Support support;
      if (!named_condition(upper(fields[1]), support.held)) {
        const long first = abaqus_label(fields[1], "freedom");
        const long last =
            fields.size() > 2 && !fields[2].empty() ? abaqus_label(fields[2], "freedom") : first;
        if (first > last) throw CardError{"freedoms go from 1 to 6"};
        if (first > 6) {  // warping, pressure, temperature, potential
          model_.log.leave_out("*BOUNDARY", "freedoms beyond displacements and rotations");
          return;
        }
        const double value = factor_ * abaqus_real(fields, 3, "displacement", 0.0);
        for (long i = first; i <= std::min(last, 6L); ++i) {
          support.held[i - 1] = true;
          support.value[i - 1] = i <= 3 ? value * model_.units.length : value;
        }
      }
      for (const int node : model_.nodes_of(*scope_, fields[0]))
        now_.supports.push_back(support_at(node, support));
    });
  }

  /// A support of a node; that of a ROT NODE holds the rotations of its rigid body.
  Support support_at(int node, const Support& given) const {
    Support support = given;
    support.vertex = node;
    if (model_.turns_of.contains(node)) {
      support.held = {};
      support.value = {};
      for (int i = 0; i < 6; ++i) {
        // Of all six that a range or name may hold, a node has its own three.
        if (!given.held[i] || (i >= 3 && given.held[0])) continue;
        const auto [vertex, freedom] = model_.freedom_of(node, i);
        support.vertex = vertex;
        support.held[freedom] = true;
        support.value[freedom] = given.value[i] / model_.units.length;
      }
    }
    support.axes = model_.axes(support.vertex);
    return support;
  }

  void read_step(const std::vector<const AbaqusBlock*>& blocks) {
    const AbaqusBlock& step = *blocks.front();
    model_.log.use("*STEP");
    // A perturbation begins without the loads of the steps before, and what these have moved stays
    // where it is: Abaqus Analysis User's Guide, general and perturbation procedures.
    const State kept = now_;
    const bool is_perturbation = step.has("PERTURBATION");
    if (is_perturbation) {
      now_.points = {};
      now_.on_elements = now_.on_surfaces = {};
      for (Support& support : now_.supports) support.value = {};
      now_.temperatures = {};
    } else if (step.has("NLGEOM") && step.value("NLGEOM") != "NO") {
      is_strained_ = true;
    }
    now_.points.begin_step();
    now_.on_elements.begin_step();
    now_.on_surfaces.begin_step();
    // OP = NEW stands at each block of a step, and drops what the steps before have left.
    std::set<std::string> renewed;
    const auto renews = [&](const AbaqusBlock& block) {
      return block.value("OP") == "NEW" && renewed.insert(block.name).second;
    };
    amplitudes_.begin_step(blocks);
    for (const AbaqusBlock* block : blocks) {
      factor_ = 1;
      if (block->has("AMPLITUDE") && !take_amplitude(*block, is_perturbation)) continue;
      if (block->name == "BOUNDARY")
        model_.guarded(*block, [&] {
          if (renews(*block)) {
            now_.supports.clear();
            now_.is_held_as_moved = false;
          }
          now_.is_held_as_moved |= block->has("FIXED");
          add_supports(*block);
        });
      if (block->name == "CLOAD")
        model_.guarded(*block, [&] {
          if (renews(*block)) now_.points.drop_earlier();
          add_point_loads(*block);
        });
      if (block->name == "DLOAD" || block->name == "DSLOAD")
        model_.guarded(*block, [&] {
          if (renews(*block)) spread_of(*block).drop_earlier();
          add_spread_loads(*block);
        });
      if (block->name == "TEMPERATURE")
        model_.guarded(*block, [&] {
          if (renews(*block)) now_.temperatures = {};
          add_temperatures(model_, *scope_, *block, now_.temperatures);
          if (is_perturbation && !(kept.temperatures.at_nodes.empty() && starts_at_zero()))
            now_.temperatures.obstacle =
                "whether those of a perturbation count from the ones before it is not known";
        });
    }
    ++step_;
    const std::string why_not = why_no_load_case(blocks, is_perturbation);
    if (!why_not.empty())
      model_.log.remark(step.line, fmt::format("step {} is no load case: {}", step_, why_not));
    keep(step, step_, why_not.empty());
    if (is_perturbation) now_ = kept;
  }

  /// Finds the factor that a keyword's values have at the end of the step.
  /// @return false if that has been complained of.
  bool take_amplitude(const AbaqusBlock& block, bool is_perturbation) {
    static const std::set<std::string> scaled{"CLOAD", "DLOAD", "DSLOAD", "BOUNDARY"};
    if (!scaled.contains(block.name) || is_perturbation) {
      model_.log.remark(
          block.line, "*" + block.name + ": AMPLITUDE is left out; what it gives is taken in full");
      return true;
    }
    try {
      factor_ = amplitudes_.factor_of(block);
    } catch (const CardError& error) {
      model_.log.complain(block.line, fmt::format("*{}: {}", block.name, error.text));
      return false;
    }
    if (factor_ != 1)
      model_.log.remark(block.line,
                        fmt::format("*{}: by its AMPLITUDE {:.4g} of it is there at the end of the "
                                    "step",
                                    block.name, factor_));
    return true;
  }

  bool starts_at_zero() const {
    return std::all_of(initial_.at_nodes.begin(), initial_.at_nodes.end(),
                       [](const auto& of_node) { return of_node.second.isZero(0); });
  }

  SpreadLoads& spread_of(const AbaqusBlock& block) {
    return block.name == "DLOAD" ? now_.on_elements : now_.on_surfaces;
  }

  /// Steps that are solved in time, or for modes or heat; those of buckling have static loads.
  /// Empty for a load case.
  std::string why_no_load_case(const std::vector<const AbaqusBlock*>& blocks,
                               bool is_perturbation) const {
    static const std::set<std::string, std::less<>> others{"FREQUENCY",
                                                           "COMPLEX FREQUENCY",
                                                           "DYNAMIC",
                                                           "MODAL DYNAMIC",
                                                           "STEADY STATE DYNAMICS",
                                                           "RANDOM RESPONSE",
                                                           "RESPONSE SPECTRUM",
                                                           "HEAT TRANSFER",
                                                           "COUPLED TEMPERATURE-DISPLACEMENT",
                                                           "UNCOUPLED TEMPERATURE-DISPLACEMENT",
                                                           "DYNAMIC TEMPERATURE-DISPLACEMENT",
                                                           "COUPLED THERMAL-ELECTRICAL",
                                                           "ELECTROMAGNETIC",
                                                           "MASS DIFFUSION",
                                                           "ANNEAL",
                                                           "DIRECT CYCLIC",
                                                           "GEOSTATIC",
                                                           "SOILS",
                                                           "STEADY STATE TRANSPORT",
                                                           "SUBSTRUCTURE GENERATE",
                                                           "MATRIX GENERATE"};
    for (const AbaqusBlock* block : blocks)
      if (others.contains(block->name)) return fmt::format("*{} is not static", block->name);
    if (is_perturbation && is_strained_)
      return "a perturbation begins from the stress and shape that steps with NLGEOM have found";
    if (const std::string name = amplitudes_.moved_on(); !name.empty())
      return fmt::format("what steps before gave with AMPLITUDE {} goes on with the time", name);
    if (now_.is_held_as_moved) return "*BOUNDARY, FIXED holds what the steps before have moved";
    return {};
  }

  void keep(const AbaqusBlock& step, long label, bool is_load_case) {
    Deck& deck = model_.deck;
    const AbaqusBlock::Parameter* named = step.find("NAME");
    DeckLoadCase load_case;
    load_case.label = label;
    load_case.title = named != nullptr ? named->as_given : fmt::format("step {}", label);
    if (!now_.supports.empty()) {
      load_case.supports = {static_cast<int>(deck.support_sets.size())};
      deck.support_sets.push_back({label, "supports of " + load_case.title, now_.supports});
    }
    if (!is_load_case) return;
    LoadSet loads;
    loads.label = label;
    loads.name = load_case.title;
    add_to(loads, now_.points);
    now_.on_elements.add_to(loads);
    now_.on_surfaces.add_to(loads);
    if (acts(loads)) {
      load_case.loads = {{static_cast<int>(deck.load_sets.size()), 1.0}};
      deck.load_sets.push_back(std::move(loads));
    }
    TemperatureField field =
        rise_of(model_, now_.temperatures, initial_, "the temperatures of " + load_case.title);
    if (structure::acts(field)) {
      load_case.temperatures = static_cast<int>(deck.temperatures.size());
      deck.temperatures.push_back(std::move(field));
    }
    deck.load_cases.push_back(load_case);
  }

  /// Is there a load in a set at all? Those that are not known here have been left out.
  static bool acts(const LoadSet& loads) {
    return !loads.point_loads.empty() || !loads.plate_loads.empty() || !loads.solid_loads.empty() ||
           !loads.beam_loads.empty() || !loads.edge_loads.empty() || !loads.volume_loads.empty() ||
           loads.is_on_masses();
  }

  // *CLOAD / node or set, freedom, value
  void add_point_loads(const AbaqusBlock& block) {
    if (block.has("FOLLOWER")) throw CardError{"FOLLOWER is not known"};
    model_.for_lines(block, [&](const Fields& fields) {
      if (fields.size() < 3) throw CardError{"node, freedom and value are due"};
      const long freedom = abaqus_label(fields[1], "freedom");
      if (freedom < 1) throw CardError{"freedoms go from 1 to 6"};
      if (freedom > 6) {
        model_.log.leave_out("*CLOAD", "freedoms beyond displacements and rotations");
        return;
      }
      const double value = factor_ * abaqus_real(fields, 2, "value");
      for (const int node : model_.nodes_of(*scope_, fields[0])) {
        const auto [vertex, component] = model_.freedom_of(node, static_cast<int>(freedom) - 1);
        const double unit = component < 3 ? model_.units.force : model_.units.moment();
        now_.points.add({vertex, component}, value * unit * model_.axes(vertex).col(component % 3));
      }
    });
  }

  // *DLOAD / element or set, kind, magnitude, and what the kind needs: directions, levels, or of
  // CENTRIF, whose magnitude is the square of the angular velocity, place on the axis and its
  // direction; *DSLOAD / surface, kind, magnitude ...
  void add_spread_loads(const AbaqusBlock& block) {
    model_.for_lines(block, [&](const Fields& given) {
      if (given.size() < 3) throw CardError{"elements, kind and magnitude are due"};
      const ScaledFields scaled(given, 2, factor_, "magnitude");
      const Fields& fields = scaled.all();
      const std::string kind = upper(fields[1]);
      const double value = abaqus_real(fields, 2, "magnitude");
      if (kind == "GRAV") {
        add_gravity(fields, value);
        return;
      }
      if (kind == "CENTRIF") {
        add_spin(fields, value);
        return;
      }
      if (block.name == "DSLOAD") {
        add_surface_loads(block, fields, kind);
        return;
      }
      for (const int e : model_.elements_of(*scope_, fields[0])) {
        const auto load = abaqus_element_load(model_, model_.elements[e], kind, fields);
        if (load)
          now_.on_elements.add(kind, *load);
        else
          leave_out(block, kind, fmt::format("loads other than {}", known_element_loads));
      }
    });
  }

  void add_gravity(const Fields& fields, double value) {
    const Vector3 direction(abaqus_real(fields, 3, "direction", 0.0),
                            abaqus_real(fields, 4, "direction", 0.0),
                            abaqus_real(fields, 5, "direction", 0.0));
    if (!(direction.norm() > 0)) throw CardError{"GRAV has no direction"};
    const std::shared_ptr<const MeshPart> part = part_of(fields[0]);
    now_.on_elements.gravity.add({part ? "GRAV " + upper(fields[0]) : "GRAV", -1},
                                 {part, value * model_.units.length * direction.normalized()});
  }

  void add_spin(const Fields& fields, double square) {
    const auto vector = [&](std::size_t first, const char* what) {
      return Vector3(abaqus_real(fields, first, what, 0.0),
                     abaqus_real(fields, first + 1, what, 0.0),
                     abaqus_real(fields, first + 2, what, 0.0));
    };
    const Vector3 axis = vector(6, "direction of the axis");
    if (!(axis.norm() > 0)) throw CardError{"CENTRIF has no direction of its axis"};
    if (square < 0)
      throw CardError{"CENTRIF has the square of an angular velocity, which is not negative"};
    Spin spin;
    spin.part = part_of(fields[0]);
    spin.place = model_.units.length * vector(3, "place on the axis");
    spin.velocity = std::sqrt(square) * axis.normalized();
    now_.on_elements.spins.add({spin.part ? "CENTRIF " + upper(fields[0]) : "CENTRIF", -1}, spin);
  }

  /// The part of the mesh that a set of elements is, for what acts on masses; none where the set is
  /// not named, or has all that has mass. Masses at nodes that are not in the set are not in it
  /// either, which is what CalculiX does, too.
  std::shared_ptr<const MeshPart> part_of(std::string_view set) const {
    if (set.empty()) return nullptr;
    const std::vector<int> named = model_.elements_of(*scope_, set);
    const std::set<int> members(named.begin(), named.end());
    const Mesh& mesh = model_.deck.mesh;
    MeshPart part;
    part.shells.assign(mesh.shells.size(), 0);
    part.beams.assign(mesh.beams.size(), 0);
    part.solids.assign(mesh.solids.size(), 0);
    part.masses.assign(mesh.masses.size(), 0);
    bool is_all = true;
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      const AbaqusDeckElement& element = model_.elements[e];
      if (members.count(static_cast<int>(e)) == 0) {
        const bool has_mass = element.shell >= 0 || element.solid >= 0 || !element.beams.empty() ||
                              !element.masses.empty();
        is_all = is_all && !has_mass;
        continue;
      }
      if (element.shell >= 0) part.shells[element.shell] = 1;
      if (element.solid >= 0) part.solids[element.solid] = 1;
      for (const int beam : element.beams) part.beams[beam] = 1;
      for (const int mass : element.masses) part.masses[mass] = 1;
    }
    return is_all ? nullptr : std::make_shared<const MeshPart>(std::move(part));
  }

  /// Notes that a load is left out, and says so at its keyword, for its step lacks it.
  void leave_out(const AbaqusBlock& block, const std::string& kind, const std::string& what) const {
    model_.log.leave_out("*" + block.name, what);
    model_.log.remark(block.line,
                      fmt::format("*{}: a load {} is left out: {}", block.name, kind, what));
  }

  void add_surface_loads(const AbaqusBlock& block, const Fields& fields, const std::string& kind) {
    const auto& [name, surface] = model_.surface(*scope_, fields[0]);
    for (const auto& [e, face] : surface.faces) {
      const AbaqusDeckElement& element = model_.elements[e];
      if (element.kind == AbaqusKind::solid && (element.solid < 0 || face == "SPOS"))
        leave_out(block, kind, "pressure on solids whose faces are not named (S1 ...)");
      else
        now_.on_surfaces.add(fmt::format("{} {} {}", name, face, kind),
                             abaqus_surface_load(model_, element, face, kind, fields));
    }
  }

  AbaqusModel& model_;
  const AbaqusScope* scope_ = nullptr;
  long step_ = 0;  ///< number of the last that was read
  /// What holds and acts as far as the steps go.
  struct State {
    std::vector<Support> supports;
    NodeLoads points;
    SpreadLoads on_elements, on_surfaces;
    AbaqusTemperatures temperatures;
    bool is_held_as_moved = false;  ///< at displacements that the steps before have found
  };
  State now_;
  AbaqusTemperatures initial_;
  AbaqusAmplitudes amplitudes_;
  double factor_ = 1;         ///< of the keyword that is being read
  bool is_strained_ = false;  ///< by a step before, with NLGEOM
};

}  // namespace

void read_abaqus_steps(AbaqusModel& model) { StepBlocks(model).read(); }

}  // namespace blocklift::structure

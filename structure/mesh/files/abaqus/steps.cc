// Supports, loads and steps.

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/solid_shape.h"

namespace blocklift::structure {

namespace {

using Fields = std::vector<std::string_view>;

class StepBlocks {
 public:
  explicit StepBlocks(AbaqusModel& model) : model_(model) {}

  void read() {
    for (const AbaqusScope& scope : model_.scopes) {
      scope_ = &scope;
      for (const AbaqusBlock* block : scope.blocks)
        if (block->name == "BOUNDARY") model_.guarded(*block, [&] { add_supports(*block); });
    }
    scope_ = &model_.scopes.front();
    for (const auto& blocks : model_.steps) read_step(blocks);
    if (model_.steps.empty() && !supports_.empty())
      model_.deck.support_sets.push_back({1, "supports of the model", supports_});
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
    if (block.value("OP") == "NEW") supports_.clear();
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
        const double value = abaqus_real(fields, 3, "displacement", 0.0);
        for (long i = first; i <= std::min(last, 6L); ++i) {
          support.held[i - 1] = true;
          support.value[i - 1] = i <= 3 ? value * model_.units.length : value;
        }
      }
      for (const int node : model_.nodes_of(*scope_, fields[0])) {
        support.vertex = node;
        support.axes = model_.axes(node);
        supports_.push_back(support);
      }
    });
  }

  void read_step(const std::vector<const AbaqusBlock*>& blocks) {
    const AbaqusBlock& step = *blocks.front();
    model_.log.use("*STEP");
    // A perturbation begins without the loads of the steps before.
    const LoadSet kept = loads_;
    const std::vector<Support> supports_kept = supports_;
    if (step.has("PERTURBATION")) loads_ = LoadSet();
    const auto reset = [&](const AbaqusBlock& block) { return block.value("OP") == "NEW"; };
    for (const AbaqusBlock* block : blocks) {
      if (block->has("AMPLITUDE"))
        model_.log.remark(block->line, "*" + block->name +
                                           ": AMPLITUDE is left out; the load is "
                                           "taken in full");
      if (block->name == "BOUNDARY") model_.guarded(*block, [&] { add_supports(*block); });
      if (block->name == "CLOAD")
        model_.guarded(*block, [&] {
          if (reset(*block)) loads_.point_loads.clear();
          add_point_loads(*block);
        });
      if (block->name == "DLOAD" || block->name == "DSLOAD")
        model_.guarded(*block, [&] {
          if (reset(*block)) {
            loads_.plate_loads.clear();
            loads_.solid_loads.clear();
            loads_.beam_loads.clear();
            loads_.gravity.setZero();
          }
          add_spread_loads(*block);
        });
    }
    keep(step);
    if (step.has("PERTURBATION")) {
      loads_ = kept;
      supports_ = supports_kept;
    }
  }

  void keep(const AbaqusBlock& step) {
    Deck& deck = model_.deck;
    const auto label = static_cast<long>(deck.load_cases.size()) + 1;
    const AbaqusBlock::Parameter* named = step.find("NAME");
    DeckLoadCase load_case;
    load_case.label = label;
    load_case.title = named != nullptr ? named->as_given : fmt::format("step {}", label);
    loads_.label = label;
    loads_.name = load_case.title;
    load_case.loads = {{static_cast<int>(deck.load_sets.size()), 1.0}};
    deck.load_sets.push_back(loads_);
    if (!supports_.empty()) {
      load_case.supports = {static_cast<int>(deck.support_sets.size())};
      deck.support_sets.push_back({label, "supports of " + load_case.title, supports_});
    }
    deck.load_cases.push_back(load_case);
  }

  // *CLOAD / node or set, freedom, value
  void add_point_loads(const AbaqusBlock& block) {
    if (block.has("FOLLOWER")) throw CardError{"FOLLOWER is not known"};
    model_.for_lines(block, [&](const Fields& fields) {
      if (fields.size() < 3) throw CardError{"node, freedom and value are due"};
      const long freedom = abaqus_label(fields[1], "freedom");
      if (freedom > 6) {
        model_.log.leave_out("*CLOAD", "freedoms beyond displacements and rotations");
        return;
      }
      const double value = abaqus_real(fields, 2, "value");
      for (const int node : model_.nodes_of(*scope_, fields[0])) {
        const Vector3 direction = model_.axes(node).col((freedom - 1) % 3);
        PointLoad& load = load_of(node);
        // A load on the same freedom again replaces the one before.
        Vector3& vector = freedom <= 3 ? load.force : load.moment;
        const double unit = freedom <= 3 ? model_.units.force : model_.units.moment();
        vector += (value * unit - vector.dot(direction)) * direction;
      }
    });
  }

  PointLoad& load_of(int node) {
    for (PointLoad& load : loads_.point_loads)
      if (load.vertex == node) return load;
    loads_.point_loads.push_back({node, Vector3::Zero(), Vector3::Zero()});
    return loads_.point_loads.back();
  }

  // *DLOAD / element or set, P | P1 ... | GRAV | PX ..., magnitude, direction; *DSLOAD / surface,
  // P, magnitude
  void add_spread_loads(const AbaqusBlock& block) {
    model_.for_lines(block, [&](const Fields& fields) {
      if (fields.size() < 3) throw CardError{"elements, kind and magnitude are due"};
      const std::string kind = upper(fields[1]);
      const double value = abaqus_real(fields, 2, "magnitude");
      if (kind == "GRAV") {
        add_gravity(fields, value);
        return;
      }
      if (block.name == "DSLOAD") {
        add_surface_pressure(fields, kind, value);
        return;
      }
      for (const int e : model_.elements_of(*scope_, fields[0]))
        add_load(model_.elements[e], kind, value);
    });
  }

  void add_gravity(const Fields& fields, double value) {
    const Vector3 direction(abaqus_real(fields, 3, "direction", 0.0),
                            abaqus_real(fields, 4, "direction", 0.0),
                            abaqus_real(fields, 5, "direction", 0.0));
    if (!(direction.norm() > 0)) throw CardError{"GRAV has no direction"};
    if (!fields[0].empty()) {
      const std::vector<int> pulled = model_.elements_of(*scope_, fields[0]);
      const std::set<int> set(pulled.begin(), pulled.end());
      for (std::size_t e = 0; e < model_.elements.size(); ++e) {
        const AbaqusKind kind = model_.elements[e].kind;
        const bool has_mass = kind == AbaqusKind::shell || kind == AbaqusKind::beam ||
                              kind == AbaqusKind::truss || kind == AbaqusKind::mass ||
                              kind == AbaqusKind::solid;
        if (has_mass && set.count(static_cast<int>(e)) == 0)
          throw CardError{
              fmt::format("GRAV pulls \"{}\" alone, not element {}; gravity of all is due",
                          fields[0], model_.elements[e].label)};
      }
    }
    loads_.gravity += value * model_.units.length * direction.normalized();
  }

  void add_load(const AbaqusDeckElement& element, const std::string& kind, double value) {
    if (element.kind == AbaqusKind::solid) {
      if (element.solid < 0 || kind.size() != 2 || kind[0] != 'P' || kind[1] < '1' || kind[1] > '9')
        model_.log.leave_out("*DLOAD", "loads other than P1 to P6 and GRAV of solids");
      else
        add_face_pressure(element, std::string{'S', kind[1]}, value);
      return;
    }
    if (kind == "P" && element.shell >= 0) {
      add_pressure(element.shell, value);
      return;
    }
    static const std::map<std::string, Vector3> directions{
        {"PX", Vector3::UnitX()}, {"PY", Vector3::UnitY()}, {"PZ", Vector3::UnitZ()}};
    const auto direction = directions.find(kind);
    if (direction == directions.end() || element.beams.empty()) {
      model_.log.leave_out("*DLOAD", "loads other than P of shells, PX, PY, PZ of beams and GRAV");
      return;
    }
    for (const int beam : element.beams)
      loads_.beam_loads.push_back(
          {beam, value * model_.units.force / model_.units.length * direction->second});
  }

  void add_pressure(int shell, double value) {
    PlateLoad load;
    load.shell = shell;
    load.pressure.fill(value * model_.units.stress());
    loads_.plate_loads.push_back(load);
  }

  void add_face_pressure(const AbaqusDeckElement& element, const std::string& face, double value) {
    SolidLoad load;
    load.solid = element.solid;
    load.face = face_of(model_.deck.mesh.solids[element.solid], corners_of_face(element, face));
    load.pressure.fill(value * model_.units.stress());
    loads_.solid_loads.push_back(load);
  }

  void add_surface_pressure(const Fields& fields, const std::string& kind, double value) {
    const auto surface = model_.surfaces.find(upper(fields[0]));
    if (surface == model_.surfaces.end())
      throw CardError{fmt::format("surface {} does not exist", fields[0])};
    if (kind != "P") throw CardError{fmt::format("a load {} is not known; P is", kind)};
    for (const auto& [e, face] : surface->second.faces) {
      const AbaqusDeckElement& element = model_.elements[e];
      if (element.kind == AbaqusKind::solid) {
        if (element.solid < 0 || face == "SPOS")
          model_.log.leave_out("*DSLOAD", "pressure on solids whose faces are not named (S1 ...)");
        else
          add_face_pressure(element, face, value);
        continue;
      }
      if (element.shell < 0 || (face != "SPOS" && face != "SNEG"))
        throw CardError{
            fmt::format("pressure on face {} of element {}; SPOS and SNEG of shells are "
                        "known",
                        face, element.label)};
      // Pressure pushes against its surface: on the upper side, against the normal.
      add_pressure(element.shell, face == "SPOS" ? -value : value);
    }
  }

  AbaqusModel& model_;
  const AbaqusScope* scope_ = nullptr;
  std::vector<Support> supports_;
  LoadSet loads_;
};

}  // namespace

void read_abaqus_steps(AbaqusModel& model) { StepBlocks(model).read(); }

}  // namespace blocklift::structure

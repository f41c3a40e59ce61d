// Parts, instances and assembly; nodes, elements, sets and surfaces.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "structure/mesh/files/abaqus/element_types.h"
#include "structure/mesh/files/abaqus/generation.h"
#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/deck/label_range.h"

namespace blocklift::structure {

namespace {

class Cells {
 public:
  explicit Cells(AbaqusModel& model) : model_(model) {}

  void read(const std::vector<AbaqusBlock>& blocks) {
    divide(blocks);
    for (std::size_t s = 0; s < model_.scopes.size(); ++s) {
      scope_ = static_cast<int>(s);
      for (const AbaqusBlock* block : model_.scopes[s].blocks) {
        if (block->name == "NODE") model_.guarded(*block, [&] { add_nodes(*block); });
        if (block->name == "NGEN" || block->name == "NFILL" || block->name == "NCOPY")
          model_.guarded(*block, [&] { add_made_nodes(*block); });
        if (block->name == "NSET") foresee(*block, "NSET", scope().nodes, scope().node_sets);
      }
    }
    for (std::size_t s = 0; s < model_.scopes.size(); ++s) {
      scope_ = static_cast<int>(s);
      for (const AbaqusBlock* block : model_.scopes[s].blocks) {
        if (block->name == "ELEMENT") model_.guarded(*block, [&] { add_elements(*block); });
        if (block->name == "ELGEN" || block->name == "ELCOPY")
          model_.guarded(*block, [&] { add_made_elements(*block); });
        if (block->name == "ELSET")
          foresee(*block, "ELSET", scope().elements, scope().element_sets);
      }
    }
    number_vertices();
    for (std::size_t s = 0; s < model_.scopes.size(); ++s) {
      scope_ = static_cast<int>(s);
      read_sets();
    }
  }

 private:
  AbaqusScope& scope() { return model_.scopes[scope_]; }

  void divide(const std::vector<AbaqusBlock>& blocks) {
    std::map<std::string, std::vector<const AbaqusBlock*>> parts;
    std::map<std::string, SourceLine> line_of_part;
    std::set<std::string> parts_used;
    std::vector<AbaqusScope> instances;
    AbaqusScope whole, assembly;
    std::vector<const AbaqusBlock*>* into = &whole.blocks;
    bool in_step = false, in_assembly = false;
    for (const AbaqusBlock& block : blocks) {
      model_.log.read("*" + block.name, block.line);
      const auto go_on = [&] { into = in_assembly ? &assembly.blocks : &whole.blocks; };
      if (block.name == "STEP") {
        model_.steps.emplace_back();
        in_step = true;
      } else if (block.name == "END STEP") {
        in_step = false;
      }
      if (in_step) {
        model_.steps.back().push_back(&block);
      } else if (block.name == "PART") {
        model_.guarded(block, [&] {
          into = &parts[block.required("NAME")];
          line_of_part.try_emplace(block.required("NAME"), block.line);
        });
      } else if (block.name == "ASSEMBLY") {
        model_.log.use("*ASSEMBLY");
        in_assembly = true;
        go_on();
      } else if (block.name == "INSTANCE") {
        parts_used.insert(block.value("PART"));
        model_.guarded(block, [&] { instances.push_back(instance(block, parts)); });
        if (!instances.empty()) into = &instances.back().blocks;
      } else if (block.name == "END PART" || block.name == "END INSTANCE" ||
                 block.name == "END ASSEMBLY" || block.name == "END STEP") {
        model_.log.use("*" + block.name);
        if (block.name == "END ASSEMBLY") in_assembly = false;
        go_on();
      } else {
        into->push_back(&block);
      }
    }
    note_unused_parts(line_of_part, parts_used);
    model_.scopes.push_back(std::move(whole));
    for (AbaqusScope& one : instances) model_.scopes.push_back(std::move(one));
    model_.scopes.push_back(std::move(assembly));
  }

  /// Parts that no instance takes are not in the model; of a deck of such alone nothing would be.
  void note_unused_parts(const std::map<std::string, SourceLine>& line_of_part,
                         const std::set<std::string>& used) {
    for (const auto& [name, line] : line_of_part) {
      if (used.contains(name)) continue;
      const std::string text = fmt::format("*PART: no *INSTANCE takes part \"{}\"", name);
      if (used.empty())
        model_.log.complain(line, text + ": what it has is not in the model");
      else
        model_.log.remark(line, text + ", which is not in the model");
    }
  }

  // *INSTANCE, NAME = , PART = / shift / two points of the axis, angle in degrees
  AbaqusScope instance(const AbaqusBlock& block,
                       const std::map<std::string, std::vector<const AbaqusBlock*>>& parts) {
    AbaqusScope scope;
    scope.name = block.required("NAME");
    if (block.has("PART")) {
      const auto part = parts.find(block.value("PART"));
      if (part == parts.end())
        throw CardError{fmt::format("part \"{}\" does not exist", block.value("PART"))};
      scope.blocks = part->second;
    }
    const auto vector = [](const AbaqusLine& line, std::size_t first) {
      const auto fields = line.fields();
      return Vector3(abaqus_real(fields, first, "coordinate", 0.0),
                     abaqus_real(fields, first + 1, "coordinate", 0.0),
                     abaqus_real(fields, first + 2, "coordinate", 0.0));
    };
    if (!block.data.empty()) scope.shift = vector(block.data[0], 0);
    if (block.data.size() > 1) {
      const Vector3 from = vector(block.data[1], 0), to = vector(block.data[1], 3);
      const double angle = abaqus_real(block.data[1].fields(), 6, "angle") * std::numbers::pi / 180;
      if (!((to - from).norm() > 0)) throw CardError{"the axis of rotation has no length"};
      scope.turn = Eigen::AngleAxisd(angle, (to - from).normalized()).toRotationMatrix();
      // First shifted, then turned about the axis.
      scope.shift = from + scope.turn * (scope.shift - from);
    }
    return scope;
  }

  void add_nodes(const AbaqusBlock& block) {
    const std::string set = block.value("NSET"), system = block.value("SYSTEM");
    LocalSystem local;
    if (system == "C") local.kind = SystemKind::cylindrical;
    if (system == "S") local.kind = SystemKind::spherical;
    model_.for_lines(block, [&](const std::vector<std::string_view>& fields) {
      const long label = abaqus_label(fields.front(), "node");
      Vector3 given(abaqus_real(fields, 1, "coordinate", 0.0),
                    abaqus_real(fields, 2, "coordinate", 0.0),
                    abaqus_real(fields, 3, "coordinate", 0.0));
      // Abaqus' spherical system counts its last angle from the plane of axes 1 and 2.
      if (local.kind == SystemKind::spherical) given = Vector3(given[0], 90 - given[2], given[1]);
      add_node(label, model_.units.length * (scope().turn * local.place(given) + scope().shift),
               set);
    });
  }

  void add_node(long label, const Vector3& place, const std::string& set) {
    if (!(place.cwiseAbs().maxCoeff() < 1e7))
      throw CardError{fmt::format("node {} lies farther than 10,000 km away", label)};
    const auto vertex = static_cast<int>(model_.deck.mesh.vertices.size());
    const auto [first, is_new] = scope().nodes.try_emplace(label, vertex);
    if (!is_new)
      throw CardError{fmt::format("node {} is there twice, first at {}", label,
                                  model_.log.place(lines_[first->second]))};
    model_.deck.mesh.vertices.push_back(place);
    lines_.push_back(model_.line_read);
    labels_.push_back(label);
    scope_of_.push_back(scope_);
    if (!set.empty()) scope().node_sets[set].push_back(vertex);
  }

  // A node that is there already stays where it is: lines and fields meet.
  void add_made_nodes(const AbaqusBlock& block) {
    model_.line_read = block.line;
    const MadeNodes made = make_nodes(model_, scope(), block, labels_);
    if (!made.set.empty()) keep(scope().node_sets[made.set], made.others);
    for (const auto& [label, place] : made.places) {
      const auto known = scope().nodes.find(label);
      if (known == scope().nodes.end())
        add_node(label, place, made.set);
      else if (!made.set.empty())
        scope().node_sets[made.set].push_back(known->second);
    }
  }

  void add_made_elements(const AbaqusBlock& block) {
    const MadeElements made = make_elements(model_, scope(), block);
    if (!made.set.empty()) keep(scope().element_sets[made.set], made.others);
    for (const MadeElement& one : made.elements) {
      AbaqusDeckElement element = model_.elements[one.like];
      element.label = one.label;
      for (int& node : element.nodes) {
        const long label = labels_[node] + one.shift_of_nodes;
        const auto found = scope().nodes.find(label);
        if (found == scope().nodes.end())
          throw CardError{
              fmt::format("element {} names node {}, which does not exist", element.label, label)};
        node = found->second;
      }
      add_element(std::move(element), made.set);
    }
  }

  /// Members of a set that what makes nodes or elements may need before all of these are known;
  /// what is wrong with it is said when it is read.
  static void foresee(const AbaqusBlock& block, const char* name,
                      const std::unordered_map<long, int>& known,
                      std::map<std::string, std::vector<int>>& sets) {
    const std::string set = block.value(name);
    if (set.empty() || block.has("INSTANCE") || (block.name == "NSET" && block.has("ELSET")))
      return;
    std::vector<int> members;
    for (const AbaqusLine& line : block.data) {
      const auto fields = line.fields();
      const auto first = to_integer(fields.front());
      if (block.has("GENERATE") && first && fields.size() > 1) {
        const auto last = to_integer(fields[1]);
        const auto step = fields.size() > 2 ? to_integer(fields[2]) : 1;
        if (!last || !step || *step < 1) continue;
        for (const long label : known_labels(known, *first, *last, *step))
          members.push_back(known.at(label));
        continue;
      }
      for (const std::string_view field : fields) {
        if (const auto label = to_integer(field)) {
          if (const auto found = known.find(*label); found != known.end())
            members.push_back(found->second);
        } else if (const auto other = sets.find(upper(field)); other != sets.end()) {
          members.insert(members.end(), other->second.begin(), other->second.end());
        }
      }
    }
    if (!members.empty()) keep(sets[set], members);
  }

  /// Numbers are the user's own where one scope has nodes; else each instance's are raised.
  void number_vertices() {
    auto& labels = model_.deck.mesh.vertex_labels;
    labels = labels_;
    const bool is_one = std::all_of(scope_of_.begin(), scope_of_.end(),
                                    [&](int s) { return s == scope_of_.front(); });
    if (is_one) return;
    long greatest = 1;
    for (const long label : labels_) greatest = std::max(greatest, label);
    for (const AbaqusDeckElement& element : model_.elements)
      greatest = std::max(greatest, element.label);
    long step = 10;
    while (step <= greatest) step *= 10;
    for (std::size_t v = 0; v < labels.size(); ++v) labels[v] += step * scope_of_[v];
    for (AbaqusDeckElement& element : model_.elements) element.label += step * element.scope;
    for (std::size_t s = 0; s < model_.scopes.size(); ++s)
      if (!model_.scopes[s].nodes.empty() && s > 0)
        model_.log.remark(
            model_.scopes[s].blocks.front()->line,
            fmt::format("numbers of {} are raised by {}, so that each is one",
                        model_.scopes[s].name.empty() ? "the assembly"
                                                      : "instance " + model_.scopes[s].name,
                        step * static_cast<long>(s)));
  }

  void add_elements(const AbaqusBlock& block) {
    const std::string type = block.required("TYPE"), set = block.value("ELSET");
    AbaqusElementType known{AbaqusKind::nothing, 0, 0};
    const bool is_solid =
        type.starts_with("C3D") || type.starts_with("SC6") || type.starts_with("SC8");
    if (is_solid && model_.options.leave_solids_out) {
      model_.log.leave_out("*ELEMENT", "solids, which were to be left out");
      known = {AbaqusKind::nothing, 1, 99};
    } else if (model_.log.leaves_out(type, model_.options)) {
      model_.log.leave_out("*ELEMENT", fmt::format("elements of type {}, as was asked for", type));
      known = {AbaqusKind::nothing, 1, 99};
    } else if (const auto found = abaqus_element_types().find(type);
               found != abaqus_element_types().end()) {
      known = found->second;
      if (known.kind == AbaqusKind::nothing) model_.log.leave_out("*ELEMENT", "dampers");
      if (type.starts_with("CPS"))
        model_.log.remark(block.line,
                          "*ELEMENT: faces of type CPS, which Gmsh writes for any surface, are "
                          "read as the shells S3, S4, S6 and S8");
    } else {
      throw CardError{
          fmt::format("elements of type {} are not known here{}; leave_out names what may "
                      "be missing",
                      type, instead_of_abaqus_type(type))};
    }
    // A line that ends in a comma goes on in the next.
    std::vector<std::string_view> all;
    for (const AbaqusLine& line : block.data) {
      const auto fields = line.fields();
      all.insert(all.end(), fields.begin(), fields.end());
      if (line.text.back() == ',' && all.size() < 1 + known.nodes) continue;
      try {
        add_element(all, known, type, set, line.line);
      } catch (const CardError& error) {
        model_.log.complain(line.line, "*ELEMENT: " + error.text);
      }
      all.clear();
    }
    if (!all.empty())
      model_.log.complain(block.data.back().line,
                          fmt::format("*ELEMENT: element {} ends after {} of {} nodes", all.front(),
                                      all.size() - 1, known.nodes));
  }

  void add_element(const std::vector<std::string_view>& fields, const AbaqusElementType& known,
                   const std::string& type, const std::string& set, SourceLine line) {
    AbaqusDeckElement element;
    element.label = abaqus_label(fields.front(), "element");
    element.kind = known.kind;
    element.type = type;
    element.scope = scope_;
    element.line = line;
    if (fields.size() < 1 + known.nodes || fields.size() > 1 + known.most_nodes)
      throw CardError{fmt::format("element {} of type {} has {} nodes; {} are due", element.label,
                                  type, fields.size() - 1, known.nodes)};
    for (std::size_t i = 1; known.most_nodes < 99 && i < fields.size(); ++i) {
      const long label = scope_ + 1 == static_cast<int>(model_.scopes.size())
                             ? 0
                             : abaqus_label(fields[i], "node");
      if (label == 0) {  // the assembly's elements may join nodes of instances
        element.nodes.push_back(model_.node_of(scope(), fields[i]));
        continue;
      }
      const auto found = scope().nodes.find(label);
      if (found == scope().nodes.end())
        throw CardError{
            fmt::format("element {} names node {}, which does not exist", element.label, label)};
      element.nodes.push_back(found->second);
    }
    add_element(std::move(element), set);
  }

  void add_element(AbaqusDeckElement element, const std::string& set) {
    const auto place = static_cast<int>(model_.elements.size());
    const auto [first, is_new] = scope().elements.try_emplace(element.label, place);
    if (!is_new)
      throw CardError{fmt::format("element {} is there twice, first at {}", element.label,
                                  model_.log.place(model_.elements[first->second].line))};
    model_.elements.push_back(std::move(element));
    if (!set.empty()) scope().element_sets[set].push_back(place);
  }

  void read_sets() {
    for (const AbaqusBlock* block : scope().blocks) {
      if (block->name == "NSET") model_.guarded(*block, [&] { add_node_set(*block); });
      if (block->name == "ELSET") model_.guarded(*block, [&] { add_element_set(*block); });
      if (block->name == "SURFACE") model_.guarded(*block, [&] { add_surface(*block); });
    }
  }

  /// The scope that INSTANCE = names, or this one.
  const AbaqusScope& meant(const AbaqusBlock& block) {
    const std::string name = block.value("INSTANCE");
    if (name.empty()) return scope();
    for (const AbaqusScope& other : model_.scopes)
      if (other.name == name) return other;
    throw CardError{fmt::format("instance \"{}\" does not exist", name)};
  }

  template <typename Lookup>
  void fill(const AbaqusBlock& block, std::vector<int>& into,
            const std::unordered_map<long, int>& known, const Lookup& lookup) {
    const bool generate = block.has("GENERATE");
    model_.for_lines(block, [&](const std::vector<std::string_view>& fields) {
      if (generate) {
        const long from = abaqus_label(fields.front(), "first"),
                   to = fields.size() > 1 ? abaqus_label(fields[1], "last") : from,
                   step = fields.size() > 2 ? abaqus_label(fields[2], "step") : 1;
        for (const long label : known_labels(known, from, to, step))
          into.push_back(known.at(label));
        return;
      }
      for (const std::string_view field : fields) {
        if (field.empty()) continue;
        const std::vector<int> found = lookup(field);
        into.insert(into.end(), found.begin(), found.end());
      }
    });
  }

  void add_node_set(const AbaqusBlock& block) {
    const AbaqusScope& from = meant(block);
    std::vector<int> set;
    if (block.has("ELSET"))
      for (const int element : model_.elements_of(from, block.value("ELSET")))
        for (const int node : model_.elements[element].nodes) set.push_back(node);
    fill(block, set, from.nodes,
         [&](std::string_view text) { return model_.nodes_of(from, text); });
    keep(scope().node_sets[block.required("NSET")], set);
    note_set(block.required("NSET"), set);
  }

  void add_element_set(const AbaqusBlock& block) {
    const AbaqusScope& from = meant(block);
    std::vector<int> set;
    fill(block, set, from.elements,
         [&](std::string_view text) { return model_.elements_of(from, text); });
    keep(scope().element_sets[block.required("ELSET")], set);
  }

  static void keep(std::vector<int>& into, const std::vector<int>& more) {
    into.insert(into.end(), more.begin(), more.end());
    std::sort(into.begin(), into.end());
    into.erase(std::unique(into.begin(), into.end()), into.end());
  }

  void note_set(const std::string& name, const std::vector<int>& nodes) {
    NamedSet set;
    set.name = scope().name.empty() ? name : scope().name + "." + name;
    keep(set.vertices, nodes);
    model_.deck.sets.push_back(std::move(set));
  }

  void add_surface(const AbaqusBlock& block) {
    AbaqusSurface& surface = model_.surface_of(scope(), block.required("NAME"));
    surface.is_of_nodes = block.value("TYPE") == "NODE";
    model_.for_lines(block, [&](const std::vector<std::string_view>& fields) {
      if (surface.is_of_nodes) {
        for (const int node : model_.nodes_of(scope(), fields.front()))
          surface.nodes[node] = abaqus_real(fields, 1, "area", 1.0);
        return;
      }
      const std::string face = fields.size() > 1 ? upper(fields[1]) : "SPOS";
      for (const int element : model_.elements_of(scope(), fields.front()))
        surface.faces.emplace_back(element, face);
    });
  }

  AbaqusModel& model_;
  int scope_ = 0;
  std::vector<long> labels_;
  std::vector<int> scope_of_;
  std::vector<SourceLine> lines_;  ///< of nodes
};

/// "instance.rest" and the scope of that instance; else the text itself in the scope given.
std::pair<const AbaqusScope*, std::string> divided(const AbaqusModel& model,
                                                   const AbaqusScope& scope,
                                                   std::string_view text) {
  const std::string name = upper(text);
  const auto dot = name.find('.');
  if (dot != std::string::npos)
    for (const AbaqusScope& other : model.scopes)
      if (other.name == name.substr(0, dot)) return {&other, name.substr(dot + 1)};
  return {&scope, name};
}

std::vector<int> look_up(const AbaqusModel& model, const AbaqusScope& scope, std::string_view text,
                         std::unordered_map<long, int> AbaqusScope::*numbers,
                         std::map<std::string, std::vector<int>> AbaqusScope::*sets,
                         const char* what) {
  const auto [from, name] = divided(model, scope, text);
  // What the assembly or the model does not have by this name, one instance may.
  std::vector<const AbaqusScope*> places{from};
  if (from->name.empty()) {
    places.push_back(&model.scopes.back());
    places.push_back(&model.scopes.front());
    if (model.scopes.size() == 3) places.push_back(&model.scopes[1]);
  }
  if (const auto label = to_integer(name)) {
    for (const AbaqusScope* place : places)
      if (const auto found = (place->*numbers).find(*label); found != (place->*numbers).end())
        return {found->second};
    throw CardError{fmt::format("{} {} does not exist", what, text)};
  }
  for (const AbaqusScope* place : places)
    if (const auto found = (place->*sets).find(name); found != (place->*sets).end())
      return found->second;
  throw CardError{fmt::format("the set \"{}\" of {}s does not exist", text, what)};
}

}  // namespace

void AbaqusModel::guarded(const AbaqusBlock& block, const std::function<void()>& step) {
  try {
    step();
    log.use("*" + block.name);
  } catch (const CardError& error) {
    log.complain(block.line, fmt::format("*{}: {}", block.name, error.text));
  }
}

void AbaqusModel::for_lines(const AbaqusBlock& block,
                            const std::function<void(const std::vector<std::string_view>&)>& step) {
  for (const AbaqusLine& line : block.data) {
    try {
      line_read = line.line;
      step(line.fields());
    } catch (const CardError& error) {
      log.complain(line.line, fmt::format("*{}: {}", block.name, error.text));
    }
  }
}

std::vector<int> AbaqusModel::nodes_of(const AbaqusScope& scope, std::string_view text) const {
  return look_up(*this, scope, text, &AbaqusScope::nodes, &AbaqusScope::node_sets, "node");
}

int AbaqusModel::node_of(const AbaqusScope& scope, std::string_view text) const {
  const std::vector<int> nodes = nodes_of(scope, text);
  if (nodes.size() != 1)
    throw CardError{fmt::format("\"{}\" stands for {} nodes; one is due", text, nodes.size())};
  return nodes.front();
}

std::vector<int> AbaqusModel::elements_of(const AbaqusScope& scope, std::string_view text) const {
  return look_up(*this, scope, text, &AbaqusScope::elements, &AbaqusScope::element_sets, "element");
}

std::pair<int, int> AbaqusModel::freedom_of(int vertex, int freedom) const {
  const auto found = turns_of.find(vertex);
  if (found == turns_of.end()) return {vertex, freedom};
  if (freedom >= 3)
    throw CardError{fmt::format(
        "freedom {} of node {}, the ROT NODE of a rigid body: its freedoms are 1 to 3, which are "
        "the body's rotations",
        freedom + 1, deck.mesh.vertex_labels[vertex])};
  return {found->second, freedom + 3};
}

Eigen::Matrix3d AbaqusModel::axes(int vertex) const {
  const auto found = axes_of.find(vertex);
  return found == axes_of.end() ? Eigen::Matrix3d::Identity() : found->second;
}

void read_abaqus_cells(AbaqusModel& model, const std::vector<AbaqusBlock>& blocks) {
  Cells(model).read(blocks);
}

}  // namespace blocklift::structure

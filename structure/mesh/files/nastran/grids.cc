#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "structure/index.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

constexpr const char* permanent_constraints = "GRID (PS)";

struct Grid {
  long label = 0, input = 0;
  Vector3 given = Vector3::Zero();
  SourceLine line;
};

SystemKind kind_of(char letter) {
  if (letter == 'R') return SystemKind::rectangular;
  return letter == 'C' ? SystemKind::cylindrical : SystemKind::spherical;
}

Vector3 point(const CardView& card, std::size_t first) {
  return {card.real(first, "coordinate", 0.0), card.real(first + 1, "coordinate", 0.0),
          card.real(first + 2, "coordinate", 0.0)};
}

/// CORD2R CID RID A1 A2 A3 B1 B2 B3 / C1 C2 C3
void add_system_of_points(NastranModel& model, const CardView& card) {
  CoordinateSystems::Definition definition;
  definition.kind = kind_of(card.name()[5]);
  definition.reference = card.integer(1, "reference system", 0);
  definition.points = {point(card, 2), point(card, 5), point(card, 8)};
  definition.line = card.line();
  model.systems.add(card.label(0, "coordinate system"), definition);
}

/// CORD1R CIDA G1A G2A G3A CIDB G1B G2B G3B
void add_systems_of_grids(NastranModel& model, const CardView& card) {
  for (const std::size_t first : {0U, 4U}) {
    if (first == 4 && !card.has(4)) break;
    CoordinateSystems::Definition definition;
    definition.kind = kind_of(card.name()[5]);
    definition.line = card.line();
    for (std::size_t i = 0; i < 3; ++i) definition.nodes[i] = card.label(first + 1 + i, "grid");
    model.systems.add(card.label(first, "coordinate system"), definition);
  }
}

class Grids {
 public:
  explicit Grids(NastranModel& model) : model_(model) {}

  void read() {
    model_.for_each({{"GRDSET", [&](const CardView& card) { read_defaults(card); }}});
    model_.for_each({{"GRID", [&](const CardView& card) { add_or_note(card); }}});
    model_.systems.set_nodes([&](long label) {
      const auto found = model_.vertex_of.find(label);
      if (found == model_.vertex_of.end() && model_.unusable_grids.contains(label))
        throw AlreadySaid{};
      if (found == model_.vertex_of.end())
        throw CardError{fmt::format("grid {} does not exist", label)};
      const Grid& grid = grids_[found->second];
      return model_.systems.get(grid.input).place(grid.given);
    });
    for (const auto& entry : model_.systems.definitions())
      guarded(entry.second.line, [&] { model_.systems.get(entry.first); });
    place_all();
  }

 private:
  template <typename Step>
  void guarded(SourceLine line, const Step& step) {
    try {
      step();
    } catch (const AlreadySaid&) {
      return;
    } catch (const CardError& error) {
      model_.log.complain(line, error.text);
    }
  }

  // GRDSET blank CP blank blank blank CD PS
  void read_defaults(const CardView& card) {
    input_ = card.integer(1, "input system", 0);
    output_ = card.integer(5, "output system", 0);
    held_ = std::string(card.text(6));
    if (!held_.empty() && held_ != "0")
      held_by_default_ = card.components(6, "permanent constraint");
  }

  void add_or_note(const CardView& card) {
    try {
      add(card);
    } catch (const CardError&) {
      const auto label = to_integer(card.text(0));
      if (label && !model_.vertex_of.contains(*label)) model_.unusable_grids.insert(*label);
      throw;
    }
  }

  // GRID ID CP X1 X2 X3 CD PS SEID
  void add(const CardView& card) {
    Grid grid;
    grid.label = card.label(0, "grid");
    grid.input = card.integer(1, "input system", input_);
    grid.given = point(card, 2);
    grid.line = card.line();
    const long output = card.integer(5, "output system", output_);
    if (grid.input < 0 || output < 0)
      throw CardError{"a grid in a negative system is one of a fluid; it cannot be lifted"};
    if (card.integer(7, "superelement", 0) != 0)
      throw CardError{"a grid belongs to a superelement; only whole models are read"};
    if (!(grid.given.cwiseAbs().maxCoeff() * model_.units.length < 1e7))
      throw CardError{fmt::format("grid {} lies farther than 10,000 km away", grid.label)};
    const auto vertex = static_cast<int>(grids_.size());
    const auto [first, is_new] = model_.vertex_of.try_emplace(grid.label, vertex);
    if (!is_new)
      throw CardError{fmt::format("grid {} is there twice, first at {}", grid.label,
                                  model_.log.place(grids_[first->second].line))};
    grids_.push_back(grid);
    model_.output_system.push_back(output);
    const std::string held = card.has(6) ? std::string(card.text(6)) : held_;
    if (!held.empty() && held != "0") {
      // Beside GRID in the ledger: a deck's own cases have these supports, a lift has not.
      model_.log.read(permanent_constraints, card.line());
      model_.log.use(permanent_constraints);
      Support support;
      support.vertex = vertex;
      support.held = card.has(6) ? card.components(6, "permanent constraint") : held_by_default_;
      permanent_.push_back(support);
    }
  }

  void place_all() {
    Mesh& mesh = model_.deck.mesh;
    mesh.vertices.assign(grids_.size(), Vector3::Zero());
    for (std::size_t i = 0; i < grids_.size(); ++i) {
      mesh.vertex_labels.push_back(grids_[i].label);
      guarded(grids_[i].line, [&] {
        mesh.vertices[i] =
            model_.units.length * model_.systems.get(grids_[i].input).place(grids_[i].given);
        model_.systems.get(model_.output_system[i]);
      });
    }
    if (permanent_.empty() || model_.log.has_complaints()) return;
    for (Support& support : permanent_) support.axes = model_.output_axes(support.vertex);
    model_.deck.support_sets.push_back({0, "constraints of the grids themselves", permanent_});
  }

  NastranModel& model_;
  std::vector<Grid> grids_;
  std::vector<Support> permanent_;
  long input_ = 0, output_ = 0;
  std::string held_;  ///< PS of GRDSET
  std::array<bool, 6> held_by_default_{};
};

/// Case control may have parameters, too: PARAM,WTMASS,0.00259.
void read_parameters_of_case_control(NastranModel& model) {
  for (const CaseControlLine& line : model.bulk.case_control) {
    if (!is_nastran_mass_factor(line.text)) continue;
    const auto value = to_real(trimmed(line.text.substr(line.text.find_last_of(", \t=") + 1)));
    if (value && *value > 0)
      model.mass_factor = *value;
    else
      model.log.complain(line.line, "case control PARAM: the value of WTMASS must be positive");
  }
}

/// PARAM NAME VALUE: one of them changes the model.
void read_parameter(NastranModel& model, const CardView& card) {
  if (!card.is(0, "WTMASS")) {
    model.log.leave_out_wish("PARAM", "what the solver is to do; WTMASS alone is used");
    return;
  }
  model.mass_factor = card.real(1, "value of WTMASS");
  if (!(model.mass_factor > 0)) throw CardError{"WTMASS must be positive"};
}

}  // namespace

bool is_nastran_mass_factor(std::string_view case_control) {
  const std::string text = upper(case_control);
  if (!text.starts_with("PARAM")) return false;
  const auto name = text.find_first_not_of(", \t", 5);
  return name != std::string::npos && name > 5 && text.compare(name, 6, "WTMASS") == 0;
}

void read_nastran_grids(NastranModel& model) {
  NastranModel::Handlers systems;
  for (const char* letter : {"R", "C", "S"}) {
    systems[std::string("CORD2") + letter] = [&](const CardView& card) {
      add_system_of_points(model, card);
    };
    systems[std::string("CORD1") + letter] = [&](const CardView& card) {
      add_systems_of_grids(model, card);
    };
  }
  systems["PARAM"] = [&](const CardView& card) { read_parameter(model, card); };
  read_parameters_of_case_control(model);
  model.for_each(systems);
  Grids(model).read();
}

void NastranModel::for_each(const Handlers& handlers) {
  for (const NastranCard& card : bulk.cards) {
    const auto handler = handlers.find(card.name);
    if (handler == handlers.end()) continue;
    try {
      handler->second(CardView(bulk, card));
      log.use(card.name);
    } catch (const AlreadySaid&) {
      continue;  // every element of it would say the same
    } catch (const CardError& error) {
      log.complain(card.line, card.name + ": " + error.text);
    }
  }
}

int NastranModel::vertex(const CardView& card, std::size_t i, const char* what) const {
  const long label = card.label(i, what);
  const auto found = vertex_of.find(label);
  if (found == vertex_of.end() && unusable_grids.contains(label)) throw AlreadySaid{};
  if (found == vertex_of.end())
    throw CardError{
        fmt::format("{} {} names grid {}, which does not exist", card.name(), card.text(0), label)};
  return found->second;
}

bool NastranModel::is_scalar_point(long label) const {
  return std::any_of(scalar_points.begin(), scalar_points.end(), [&](const auto& range) {
    return range.first <= label && label <= range.second;
  });
}

std::vector<int> NastranModel::pieces_of_beam(int first) const {
  const std::vector<Beam>& beams = deck.mesh.beams;
  std::vector<int> pieces;
  for (std::size_t b = at(first); b < beams.size() && beams[b].label == beams[first].label; ++b)
    pieces.push_back(static_cast<int>(b));
  return pieces;
}

Eigen::Matrix3d NastranModel::output_axes(int vertex) {
  return axes_at(output_system[vertex], vertex);
}

Eigen::Matrix3d NastranModel::axes_at(long system, int vertex) {
  if (system == 0) return Eigen::Matrix3d::Identity();
  return systems.get(system).axes_at(place(vertex) / units.length);
}

long NastranModel::new_element(const CardView& card) {
  const long label = card.label(0, "element number");
  // Rigid elements and masses have often numbers that plates have, too; solvers let them.
  const std::size_t kind = card.name().front() == 'R' ? 1
                           : card.name().starts_with("CONM") || card.name().starts_with("CMASS")
                               ? 2
                               : 0;
  const auto [first, is_new] = elements[kind].try_emplace(label, card.line());
  if (!is_new)
    throw CardError{
        fmt::format("element {} is there twice, first at {}", label, log.place(first->second))};
  for (std::size_t other = 0; other < elements.size(); ++other)
    if (other != kind && elements[other].count(label) > 0) {
      log.remark(card.line(), card.name() + " has the number of an element of another kind");
      break;
    }
  return label;
}

}  // namespace blocklift::structure

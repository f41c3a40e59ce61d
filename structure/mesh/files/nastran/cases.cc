// Supports, equations, combinations of loads, and the subcases that name them.

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "structure/mesh/files/deck/equations.h"
#include "structure/mesh/files/deck/label_range.h"
#include "structure/mesh/files/nastran/case_commands.h"
#include "structure/mesh/files/nastran/model.h"
#include "structure/mesh/files/nastran/temperatures.h"

namespace blocklift::structure {

namespace {

/// Sets that are sums of others: SPCADD, MPCADD.
using Sums = std::map<long, std::vector<long>>;

void read_sum(const CardView& card, Sums& sums) {
  std::vector<long>& parts = sums[card.label(0, "set")];
  for (std::size_t i = 1; i < card.size(); ++i)
    if (card.has(i)) parts.push_back(card.label(i, "set"));
}

std::vector<long> parts_of(const Sums& sums, long set) {
  const auto found = sums.find(set);
  return found == sums.end() ? std::vector<long>{set} : found->second;
}

class Supports {
 public:
  explicit Supports(NastranModel& model) : model_(model) {}

  void read() {
    model_.for_each({{"SPC1", [&](const CardView& card) { add_list(card); }},
                     {"SPC", [&](const CardView& card) { add_pairs(card); }},
                     {"SPCADD", [&](const CardView& card) { read_sum(card, sums_); }}});
  }

  /// Places of the support sets that a number of case control stands for.
  std::vector<int> sets_of(long number) const {
    std::vector<int> places;
    for (const long part : parts_of(sums_, number)) {
      const auto found = set_of_.find(part);
      if (found == set_of_.end())
        throw CardError{fmt::format("constraint set {} does not exist", part)};
      places.push_back(found->second);
    }
    return places;
  }

 private:
  SupportSet& set(const CardView& card) {
    const long label = card.label(0, "constraint set");
    auto& sets = model_.deck.support_sets;
    const auto [found, is_new] = set_of_.try_emplace(label, static_cast<int>(sets.size()));
    if (is_new) sets.push_back({label, fmt::format("constraint set {}", label), {}});
    return sets[found->second];
  }

  Support support(int vertex, const std::array<bool, 6>& held) {
    Support support;
    support.vertex = vertex;
    support.held = held;
    support.axes = model_.output_axes(vertex);
    return support;
  }

  // SPC1 SID C G1 G2 ... or G1 THRU G2; points without a place have components of their own
  void add_list(const CardView& card) {
    SupportSet& list = set(card);
    const auto hold = [&](int vertex) {
      list.supports.push_back(support(vertex, card.components(1, "components")));
    };
    for (std::size_t i = 2; i < card.size(); ++i) {
      if (!card.has(i)) continue;
      if (card.is(i, "THRU")) {
        const long from = card.label(i - 1, "grid"), to = card.label(++i, "last grid");
        for (const long label : known_labels(model_.vertex_of, from + 1, to))
          hold(model_.vertex_of.at(label));
      } else if (!model_.is_scalar_point(card.label(i, "grid"))) {
        hold(model_.vertex(card, i, "grid"));
      }
    }
  }

  // SPC SID G1 C1 D1 G2 C2 D2
  void add_pairs(const CardView& card) {
    SupportSet& list = set(card);
    for (const std::size_t first : {1U, 4U}) {
      if (!card.has(first) || model_.is_scalar_point(card.label(first, "grid"))) continue;
      Support one =
          support(model_.vertex(card, first, "grid"), card.components(first + 1, "components"));
      const double value = card.real(first + 2, "displacement", 0.0);
      for (std::size_t i = 0; i < 6; ++i)
        if (one.held[i]) one.value[i] = i < 3 ? value * model_.units.length : value;
      list.supports.push_back(one);
    }
  }

  NastranModel& model_;
  Sums sums_;
  std::map<long, int> set_of_;
};

/// SPCD: motions that loads enforce on freedoms that constraints hold.
class EnforcedMotions {
 public:
  explicit EnforcedMotions(NastranModel& model) : model_(model) {
    model.for_each({{"SPCD", [&](const CardView& card) { add_pairs(card); }}});
  }

  bool has(long set) const { return motions_.contains(set); }

  /// Adds to a case the motions of its sets of loads with their factors, as supports that come
  /// after its constraints and so take their place. Those of several sets add up.
  void add(const std::vector<std::pair<long, double>>& loads, DeckLoadCase& load_case) {
    std::map<int, Support> enforced;
    for (const auto& [set, factor] : loads) {
      const auto found = motions_.find(set);
      if (found == motions_.end()) continue;
      for (const Motion& motion : found->second) add(motion, factor, load_case, enforced);
    }
    if (enforced.empty()) return;
    auto& sets = model_.deck.support_sets;
    SupportSet all{1, fmt::format("enforced motions of case {}", load_case.label), {}};
    for (const SupportSet& set : sets) all.label = std::max(all.label, set.label + 1);
    for (const auto& [vertex, support] : enforced) all.supports.push_back(support);
    load_case.supports.push_back(static_cast<int>(sets.size()));
    sets.push_back(std::move(all));
  }

 private:
  struct Motion {
    int vertex = 0;
    std::size_t component = 0;
    double value = 0;  ///< m or rad
    SourceLine line;
  };

  // SPCD SID G1 C1 D1 G2 C2 D2
  void add_pairs(const CardView& card) {
    std::vector<Motion>& motions = motions_[card.label(0, "load set")];
    for (const std::size_t first : {1U, 4U}) {
      if (!card.has(first) || model_.is_scalar_point(card.label(first, "grid"))) continue;
      const int vertex = model_.vertex(card, first, "grid");
      const std::array<bool, 6> held = card.components(first + 1, "components");
      const double value = card.real(first + 2, "displacement", 0.0);
      for (std::size_t i = 0; i < 6; ++i)
        if (held[i])
          motions.push_back({vertex, i, i < 3 ? value * model_.units.length : value, card.line()});
    }
  }

  void add(const Motion& motion, double factor, const DeckLoadCase& load_case,
           std::map<int, Support>& enforced) {
    if (!is_held(motion, load_case)) {
      model_.log.complain(
          motion.line,
          fmt::format("SPCD: the constraints (SPC) of subcase {} do not hold component {} of grid "
                      "{}; a motion is enforced on a freedom that is held",
                      load_case.label, motion.component + 1,
                      model_.deck.mesh.vertex_labels[motion.vertex]));
      return;
    }
    Support& support = enforced[motion.vertex];
    support.vertex = motion.vertex;
    support.axes = model_.output_axes(motion.vertex);
    support.held[motion.component] = true;
    support.value[motion.component] += factor * motion.value;
  }

  bool is_held(const Motion& motion, const DeckLoadCase& load_case) const {
    const auto& sets = model_.deck.support_sets;
    return std::any_of(load_case.supports.begin(), load_case.supports.end(), [&](int set) {
      return std::any_of(sets[set].supports.begin(), sets[set].supports.end(),
                         [&](const Support& one) {
                           return one.vertex == motion.vertex && one.held[motion.component];
                         });
    });
  }

  NastranModel& model_;
  std::map<long, std::vector<Motion>> motions_;
};

/// Equations between freedoms; one that has a single term holds it.
class Equations {
 public:
  explicit Equations(NastranModel& model) : model_(model) {
    for (const NastranCard& card : model.bulk.cards) {
      if (card.name != "MPC" && card.name != "MPCADD") continue;
      const CardView view(model.bulk, card);
      try {
        if (card.name == "MPC")
          cards_[view.label(0, "set")].push_back(view);
        else
          read_sum(view, sums_);
      } catch (const CardError& error) {
        model.log.complain(card.line, card.name + ": " + error.text);
      }
    }
  }

  bool empty() const { return cards_.empty(); }
  long only_set() const { return cards_.size() == 1 ? cards_.begin()->first : 0; }
  SourceLine line() const { return cards_.begin()->second.front().line(); }

  void use(long number) {
    for (const long part : parts_of(sums_, number)) {
      const auto found = cards_.find(part);
      if (found == cards_.end())
        throw CardError{fmt::format("set {} of equations (MPC) does not exist", part)};
      used_ = true;
      for (const CardView& card : found->second) {
        try {
          add(card);
          model_.log.use("MPC");
        } catch (const AlreadySaid&) {
          continue;
        } catch (const CardError& error) {
          model_.log.complain(card.line(), "MPC: " + error.text);
        }
      }
    }
  }

  void finish() {
    if (!used_ && !cards_.empty()) model_.log.leave_out("MPC", "sets that no subcase asks for");
    if (!held_.supports.empty()) model_.deck.support_sets.push_back(held_);
  }

 private:
  // MPC SID G1 C1 A1 G2 C2 A2 blank / blank G3 C3 A3 ...
  void add(const CardView& card) {
    std::vector<EquationTerm> terms;
    for (std::size_t line = 0; line < card.size(); line += 8) {
      for (const std::size_t first : {line + 1, line + 4}) {
        if (!card.has(first)) continue;
        EquationTerm term;
        DeckFreedom& freedom = term.freedom;
        freedom.vertex = model_.vertex(card, first, "grid");
        freedom.axes = model_.output_axes(freedom.vertex);
        freedom.component = static_cast<int>(card.integer(first + 1, "component")) - 1;
        term.factor = card.real(first + 2, "factor");
        if (freedom.component < 0 || freedom.component > 5)
          throw CardError{fmt::format("component {} is none of 1 to 6", card.text(first + 1))};
        if (term.factor != 0) terms.push_back(term);
      }
    }
    if (terms.size() == 1) {
      Support support;
      support.vertex = terms[0].freedom.vertex;
      support.held[terms[0].freedom.component] = true;
      support.axes = terms[0].freedom.axes;
      held_.supports.push_back(support);
      return;
    }
    if (terms.empty()) throw CardError{"an equation has no factors"};
    add_equation(model_.deck, terms, model_.log.place(card.line()));
  }

  NastranModel& model_;
  std::map<long, std::vector<CardView>> cards_;
  Sums sums_;
  bool used_ = false;
  SupportSet held_{0, "equations that hold a freedom", {}};
};

/// A subcase's choice of sets; 0: none.
struct Choice {
  long label = 1, load = 0, constraints = 0, equations = 0, spread_mass = 0;
  long temperatures = 0, initial_temperatures = 0;
  std::string title;
  SourceLine line;
};

class CaseControl {
 public:
  CaseControl(NastranModel& model, std::map<long, int> load_sets, Supports& supports)
      : model_(model),
        load_sets_(std::move(load_sets)),
        supports_(supports),
        motions_(model),
        equations_(model),
        temperatures_(model) {
    model_.for_each({{"LOAD", [&](const CardView& card) { read_combination(card); }}});
  }

  void read() {
    for (const CaseControlLine& line : model_.bulk.case_control) {
      try {
        read_line(line);
      } catch (const CardError& error) {
        model_.log.complain(line.line, "case control: " + error.text);
      }
    }
    if (!has_subcases_ && model_.bulk.has_case_control &&
        (common_.load != 0 || common_.constraints != 0 || common_.temperatures != 0))
      choices_.push_back(common_);
    use_equations();
    equations_.finish();
    use_spread_mass();
    for (const Choice& choice : choices_) {
      try {
        add(choice);
      } catch (const CardError& error) {
        model_.log.complain(choice.line, fmt::format("subcase {}: {}", choice.label, error.text));
      }
    }
  }

 private:
  // LOAD SID S S1 L1 S2 L2 ...
  void read_combination(const CardView& card) {
    // Of a card that is refused nothing is left but its set, which is not said to be missing.
    auto& parts = combinations_[card.label(0, "load set")];
    const double factor = card.real(1, "factor");
    for (std::size_t i = 2; i + 1 < card.size(); i += 2)
      if (card.has(i) || card.has(i + 1))
        parts.emplace_back(card.label(i + 1, "load set"), factor * card.real(i, "factor"));
  }

  static bool starts_combination(std::string_view key) {
    return is_same(key, "SUBCOM") || is_same(key, "SUBSEQ") || is_same(key, "REPCASE");
  }

  /// Loads of case control that no card read here says: enforced lengths, loads of before, matrices
  /// and loads in time.
  static bool asks_for_a_load(std::string_view key) {
    static constexpr std::array<std::string_view, 8> beginnings{"DEFO", "STATS", "K2GG", "M2GG",
                                                                "K2PP", "P2G",   "DLOA", "LOADS"};
    const std::string name = upper(key);
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](std::string_view beginning) { return name.starts_with(beginning); });
  }

  void read_line(const CaseControlLine& line) {
    const auto equals = line.text.find('=');
    std::string_view key = trimmed(line.text.substr(0, equals));
    std::string_view value;
    if (equals != std::string_view::npos) {
      value = trimmed(line.text.substr(equals + 1));
    } else if (const auto space = key.find_first_of(" \t"); space != std::string_view::npos) {
      value = trimmed(key.substr(space));
      key = key.substr(0, space);
    }
    const auto bracket = key.find('(');
    const std::string_view within =
        bracket == std::string_view::npos
            ? std::string_view()
            : trimmed(key.substr(bracket + 1, key.find_first_of("),", bracket) - bracket - 1));
    key = trimmed(key.substr(0, bracket));
    Choice& choice = has_subcases_ ? choices_.back() : common_;
    const auto number = [&] {
      const auto found = to_integer(value);
      if (!found) throw CardError{fmt::format("{} = \"{}\" is no number", key, value)};
      return *found;
    };
    const bool is_start = is_same(key, "SUBCASE");
    if (in_combination_ && !is_start && !starts_combination(key)) return;
    if (is_start) {
      Choice next = common_;
      next.label = number();
      next.line = line.line;
      choices_.push_back(next);
      has_subcases_ = true;
      in_combination_ = in_plots_ = false;
    } else if (is_same(key, "LOAD")) {
      choice.load = number();
      choice.line = line.line;
    } else if (is_same(key, "SPC")) {
      choice.constraints = number();
    } else if (is_same(key, "MPC")) {
      choice.equations = number();
    } else if (is_same(key, "NSM")) {
      choice.spread_mass = number();
      choice.line = line.line;
    } else if (upper(key).starts_with("TEMP")) {
      read_temperatures(line, upper(within), is_same(value, "NONE") ? 0 : number(), choice);
    } else if (is_command(key, "TITLE")) {
      model_.deck.title = std::string(value);
    } else if (is_command(key, "SUBTITLE") || is_command(key, "LABEL")) {
      choice.title = std::string(value);
    } else if (is_nastran_mass_factor(line.text)) {
      model_.log.read("case control PARAM WTMASS", line.line);
      model_.log.use("case control PARAM WTMASS");
    } else if (starts_combination(key)) {
      const std::string name = "case control " + upper(key);
      model_.log.read(name, line.line);
      model_.log.leave_out(name, "combinations of subcases: each is a load case alone");
      in_combination_ = true;
    } else {
      leave_out(line, key, !within.empty());
    }
  }

  /// A command by its first four letters or more.
  static bool is_command(std::string_view key, std::string_view command) {
    return key.size() >= 4 && command.starts_with(upper(key));
  }

  void leave_out(const CaseControlLine& line, std::string_view key, bool has_options) {
    const std::string command = upper(key.substr(0, key.find_first_of(" \t,(")));
    // What follows OUTPUT(XYPLOT) and the like are words of their own.
    if (command == "OUTPUT" && has_options) in_plots_ = true;
    const bool is_known = in_plots_ || is_case_command(command);
    if (const std::string meant = is_known ? "" : meant_case_command(command); !meant.empty())
      throw CardError{fmt::format("{} is not known here (did you mean {}?)", command, meant)};
    const std::string name = "case control " + command;
    model_.log.read(name, line.line);
    if (asks_for_a_load(command)) {
      model_.log.leave_out(name,
                           "loads other than forces, moments, pressures, gravity and rotation");
    } else {
      model_.log.leave_out_wish(name, "what the solver is to do or print");
      if (!is_known)
        model_.log.remark(line.line, name + " is not known here; it is taken for a wish of output");
    }
  }

  // TEMPERATURE = set, TEMPERATURE(LOAD | BOTH | INITIAL | MATERIAL) = set
  void read_temperatures(const CaseControlLine& line, const std::string& kind, long set,
                         Choice& choice) {
    static const std::string name = "case control TEMPERATURE";
    model_.log.read(name, line.line);
    if (kind.starts_with("MATE")) {
      model_.log.leave_out(name, "what materials are at other temperatures");
      return;
    }
    model_.log.use(name);
    if (kind.starts_with("INIT")) {
      choice.initial_temperatures = set;
    } else if (kind.empty() || kind == "LOAD" || kind == "BOTH") {
      choice.temperatures = set;
      choice.line = line.line;
    } else {
      throw CardError{
          fmt::format("TEMPERATURE({}) is not known; LOAD, BOTH, INITIAL and MATERIAL are", kind)};
    }
  }

  void use_equations() {
    if (equations_.empty()) return;
    std::vector<long> asked;
    for (const Choice& choice : choices_.empty() ? std::vector<Choice>{common_} : choices_)
      if (std::find(asked.begin(), asked.end(), choice.equations) == asked.end())
        asked.push_back(choice.equations);
    if (asked.size() > 1) {
      model_.log.complain(equations_.line(),
                          "MPC: subcases ask for different sets of equations; a block has one");
      return;
    }
    long wanted = asked.front();
    if (wanted == 0 && !model_.bulk.has_case_control) {
      wanted = equations_.only_set();
      if (wanted != 0)
        model_.log.remark(equations_.line(),
                          "without case control, the deck's one set of equations (MPC) is used");
    }
    if (wanted == 0) return;
    try {
      equations_.use(wanted);
    } catch (const CardError& error) {
      model_.log.complain(equations_.line(), error.text);
    }
  }

  /// A block weighs the same in all subcases.
  void use_spread_mass() {
    std::set<long> asked;
    SourceLine line;
    for (const Choice& choice : choices_.empty() ? std::vector<Choice>{common_} : choices_) {
      asked.insert(choice.spread_mass);
      line = choice.line;
    }
    const auto& cards = model_.bulk.cards;
    const bool has_any = std::any_of(cards.begin(), cards.end(), [](const NastranCard& card) {
      return card.name.starts_with("NSM");
    });
    if (asked.size() > 1)
      model_.log.complain(line, "NSM: subcases ask for different spread masses; a block has one");
    if (asked.size() > 1 || (*asked.begin() == 0 && !has_any)) return;
    if (*asked.begin() == 0) {
      model_.log.leave_out("NSM", "sets that case control does not ask for");
      return;
    }
    try {
      use_nonstructural_mass(model_, *asked.begin());
    } catch (const CardError& error) {
      model_.log.complain(line, "case control: " + error.text);
    }
  }

  void add(const Choice& choice) {
    DeckLoadCase load_case;
    load_case.label = choice.label;
    load_case.title = choice.title;
    const auto& sets = model_.deck.support_sets;
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (sets[i].label == 0) load_case.supports.push_back(static_cast<int>(i));
    if (choice.constraints != 0)
      for (const int set : supports_.sets_of(choice.constraints)) load_case.supports.push_back(set);
    if (choice.load != 0) {
      const auto combined = combinations_.find(choice.load);
      std::vector<std::pair<long, double>> loads{{choice.load, 1.0}};
      if (combined != combinations_.end()) loads = combined->second;
      for (const auto& [set, factor] : loads) add_load(load_case, set, factor);
      motions_.add(loads, load_case);
    }
    if (choice.temperatures != 0)
      load_case.temperatures =
          temperatures_.field(choice.temperatures, choice.initial_temperatures);
    model_.deck.load_cases.push_back(load_case);
  }

  void add_load(DeckLoadCase& load_case, long set, double factor) const {
    const auto found = load_sets_.find(set);
    if (found == load_sets_.end()) {
      if (motions_.has(set) || may_have_loads(set)) return;
      throw CardError{fmt::format("load set {} does not exist", set)};
    }
    load_case.loads.emplace_back(found->second, factor);
  }

  /// Whether cards name a set of loads that holds none: that they are left out or wrong has been
  /// said at their lines.
  bool may_have_loads(long set) const {
    const auto& cards = model_.bulk.cards;
    return std::any_of(cards.begin(), cards.end(), [&](const NastranCard& card) {
      return may_be_nastran_load(card.name) &&
             to_integer(CardView(model_.bulk, card).text(0)) == set;
    });
  }

  NastranModel& model_;
  std::map<long, int> load_sets_;
  Supports& supports_;
  EnforcedMotions motions_;
  Equations equations_;
  NastranTemperatures temperatures_;
  std::map<long, std::vector<std::pair<long, double>>> combinations_;
  Choice common_;
  std::vector<Choice> choices_;
  bool has_subcases_ = false, in_combination_ = false, in_plots_ = false;
};

}  // namespace

void read_nastran_cases(NastranModel& model) {
  Supports supports(model);
  supports.read();
  CaseControl(model, read_nastran_loads(model), supports).read();
}

}  // namespace blocklift::structure

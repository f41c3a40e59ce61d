#include "pipeline/files/standard/standard_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {
namespace {

const auto clause_meaning = "where the standard says so";

template <class T>
Table<T>& add_factor(Table<T>& table) {
  return table
      .required("factor", &T::value, number(Range::positive()), "the figure, without a unit")
      .required("clause", &T::clause, text(), clause_meaning);
}

Format<ClauseFactor> factor_format(const char* description) {
  Table<ClauseFactor> table("factor", description);
  return add_factor(table).format();
}

Format<std::vector<NamedFactor>> named_factors_format(const char* description) {
  Table<NamedFactor> table("factor", description);
  return named_tables(add_factor(table).format());
}

Format<AmplificationTable> amplification_format() {
  Table<AmplificationRow> row("row of amplification",
                              "factor + root sqrt(100 t / static hook load).");
  row.optional("up_to", &AmplificationRow::up_to, quantity(Dimension::load, Range::positive()),
               "weight with contingency, without rigging; all that is heavier if left out")
      .required("factor", &AmplificationRow::factor, number(Range::positive()),
                "dynamic over static hook load")
      .by_default("root", &AmplificationRow::root, number(Range::not_negative()), "0",
                  "times sqrt(100 t / static hook load), added")
      .required("clause", &AmplificationRow::clause, text(), clause_meaning);
  return converted<std::vector<AmplificationRow>, AmplificationTable>(
      list_of(row.format(), 1), [](std::vector<AmplificationRow> rows) {
        return AmplificationTable{{}, std::move(rows)};
      });
}

Format<HoistingClass> hoisting_class_format() {
  Table<HoistingClass> table("hoisting class", "phi_2 = least + per_speed x hoisting speed.");
  table.required("least", &HoistingClass::least, number(Range::at_least(1)), "at no speed")
      .required("per_speed", &HoistingClass::per_speed, number(Range::not_negative()),
                "in s/m, times the steady hoisting speed")
      .required("clause", &HoistingClass::clause, text(), clause_meaning);
  return table.format();
}

Format<TiltRule> tilt_rule_format() {
  Table<TiltRule> table("tilt", "By how much two hooks may differ in height.");
  table
      .required("angle", &TiltRule::angle, quantity(Dimension::angle, Range::inside(0, 1)),
                "of the line between the lift points of the two hooks")
      .optional("height", &TiltRule::height, quantity(Dimension::length, Range::positive()),
                "between the hooks; the more onerous of the two holds")
      .required("clause", &TiltRule::clause, text(), clause_meaning);
  return table.format();
}

Format<SlingRules> sling_rules_format() {
  Table<SlingRules> table("sling rules",
                          "Partial factors of slings: breaking load over the largest load is at "
                          "least load x consequence x reduction x wear x material, and floor x "
                          "reduction x wear.");
  table.required("load", &SlingRules::load, factor_format("Load factor."), "on the load")
      .required("consequence", &SlingRules::consequence, factor_format("Consequence factor."),
                "of a sling's failure")
      .required("floor", &SlingRules::floor, factor_format("Least of the other factors."),
                "that stands for load, consequence and material together at least")
      .required("bending", &SlingRules::bending, factor_format("Of the formula of bending."),
                "in 1 / (1 - bending / sqrt(D/d))")
      .optional("environment", &SlingRules::environment,
                factor_format("Reduction by a detailed analysis."),
                "times the environment's share E/T of the load, off the load factor; it stays at "
                "1 + (load - 1) E/T at least")
      .required("material", &SlingRules::material, named_factors_format("Material factor."),
                "by the material that a rope's model names")
      .required("wear", &SlingRules::wear, named_factors_format("Wear factor."),
                "by the wear that a case names")
      .required("termination", &SlingRules::termination,
                named_factors_format("Termination factor."),
                "by the termination that a rope's model names");
  return table.format();
}

Format<ShackleRules> shackle_rules_format() {
  Table<ShackleRules> table("shackle rules", "What shackles and other accessories may carry.");
  table
      .required("working", &ShackleRules::working, factor_format("On the static load."),
                "working load over the static load, and over the dynamic load / DAF")
      .required("breaking", &ShackleRules::breaking, factor_format("On the dynamic load."),
                "breaking load over the dynamic load");
  return table.format();
}

Format<SideLoadRow> side_load_format() {
  Table<SideLoadRow> table("row of side loads",
                           "What a shackle bears when it is pulled out of the plane of its bow.");
  table
      .required("up_to", &SideLoadRow::up_to,
                quantity(Dimension::angle, Range::between(0, std::numbers::pi / 2)),
                "angle between the pull and that plane; beyond the last row it bears nothing")
      .required("factor", &SideLoadRow::factor, number(Range::between(0.01, 1)),
                "of its working load and breaking load")
      .required("clause", &SideLoadRow::clause, text(), clause_meaning);
  return table.format();
}

Format<ConsequenceRules> consequence_format() {
  Table<ConsequenceRules> table("consequence rules", "Factors on the loads of the structure.");
  const auto factor = factor_format("Consequence factor.");
  table
      .required("lift_point", &ConsequenceRules::lift_point, factor,
                "lugs and their attachment to the structure")
      .optional("members", &ConsequenceRules::members, factor, "that frame into lift points")
      .optional("others", &ConsequenceRules::others, factor, "all other members");
  return table.format();
}

Format<FineMeshRules> fine_mesh_format() {
  Table<FineMeshRules> table("fine mesh",
                             "What is allowed in a small square near a corner of the structure, "
                             "where the stress has no limit, over what is allowed in a plate's "
                             "field.");
  table
      .required("square", &FineMeshRules::square,
                quantity(Dimension::length, Range::at_least(0.05)),
                "side of the squares that the factors are for: 50 mm, of which the checked stress "
                "is the mean, or more")
      .required("plate", &FineMeshRules::plate, factor_format("In the plate's own material."),
                "at corners of openings and free edges")
      .required("beside_weld", &FineMeshRules::beside_weld, factor_format("Beside a weld."),
                "at roots of lugs and toes: squares with a side on a joint or a stiffener");
  return table.format();
}

Format<TandemRow> tandem_format() {
  Table<TandemRow> table("row of cranes", "What a crane may carry where several lift together.");
  table.required("cranes", &TandemRow::cranes, integer(Range::at_least(2)), "so many or more")
      .required("factor", &TandemRow::factor, number(Range::between(0.01, 1)),
                "of the capacity of each")
      .required("clause", &TandemRow::clause, text(), clause_meaning);
  return table.format();
}

/// Clauses as they are quoted outside the file.
class Quoting {
 public:
  explicit Quoting(std::string name) : name_(std::move(name)) {}
  template <class T>
  void one(T& item) const {
    item.clause = name_ + " " + item.clause;
  }
  template <class T>
  void one(std::optional<T>& item) const {
    if (item) one(*item);
  }
  template <class T>
  void one(std::vector<T>& items) const {
    for (T& item : items) one(item);
  }
  void one(AmplificationTable& table) const { one(table.rows); }
  void one(SlingRules& sling) const {
    one(sling.load);
    one(sling.consequence);
    one(sling.floor);
    one(sling.bending);
    one(sling.environment);
    one(sling.material);
    one(sling.wear);
    one(sling.termination);
  }
  void one(ShackleRules& shackle) const {
    one(shackle.working);
    one(shackle.breaking);
  }
  void one(FineMeshRules& rules) const {
    one(rules.plate);
    one(rules.beside_weld);
  }
  void one(ConsequenceRules& rules) const {
    one(rules.lift_point);
    one(rules.members);
    one(rules.others);
  }

 private:
  std::string name_;
};

/// Calls `visit` with every section of rules, and with the same section of others.
template <class Visit>
void for_each_section(StandardRules& rules, const StandardRules& others, const Visit& visit) {
  visit(rules.weight_classes, others.weight_classes);
  visit(rules.centre_of_mass, others.centre_of_mass);
  visit(rules.dynamic_amplification, others.dynamic_amplification);
  visit(rules.hoisting_classes, others.hoisting_classes);
  visit(rules.tilt, others.tilt);
  visit(rules.yaw, others.yaw);
  visit(rules.skew, others.skew);
  visit(rules.length_tolerance, others.length_tolerance);
  visit(rules.sling, others.sling);
  visit(rules.shackle, others.shackle);
  visit(rules.accessory, others.accessory);
  visit(rules.shackle_side_load, others.shackle_side_load);
  visit(rules.consequence, others.consequence);
  visit(rules.fine_mesh, others.fine_mesh);
  visit(rules.lateral, others.lateral);
  visit(rules.tandem, others.tandem);
}

template <class T>
bool is_absent(const std::optional<T>& section) {
  return !section;
}
template <class T>
bool is_absent(const std::vector<T>& section) {
  return section.empty();
}

Format<std::vector<NamedFactor>> lug_factors_format() {
  return named_factors_format("What stands before the load in formulae of lugs.");
}

void check_rows(const StandardRules& rules, Reading& reading, const Mark&) {
  for (const AmplificationTable& table : rules.dynamic_amplification) {
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const bool is_last = i + 1 == table.rows.size();
      if (is_last == !table.rows[i].up_to) continue;
      reading.error(table.name.mark,
                    fmt::format("the last row of {}, and it alone, has no up_to: it holds for "
                                "whatever is heavier",
                                table.name.value));
      break;
    }
    for (std::size_t i = 1; i + 1 < table.rows.size(); ++i)
      if (table.rows[i].up_to && table.rows[i - 1].up_to &&
          *table.rows[i].up_to <= *table.rows[i - 1].up_to)
        reading.error(table.name.mark,
                      fmt::format("the rows of {} do not ascend", table.name.value));
  }
  const auto& side_loads = rules.shackle_side_load;
  for (std::size_t i = 1; i < side_loads.size(); ++i)
    if (side_loads[i].up_to <= side_loads[i - 1].up_to ||
        side_loads[i].factor > side_loads[i - 1].factor) {
      reading.error(rules.place,
                    "shackle_side_load: angles must ascend from row to row, and factors may not");
      break;
    }
  const std::vector<std::string>& families = lug_formula_families();
  for (const NamedFactor& family : rules.lug) {
    if (std::find(families.begin(), families.end(), family.name.value) != families.end()) continue;
    reading.error(family.name.mark,
                  fmt::format("there are no formulae of lugs \"{}\"", family.name.value),
                  {names_hint("there are", families, family.name.value)});
  }
}

}  // namespace

double AmplificationRow::at(double static_hook_load) const {
  if (root == 0) return factor;
  return factor + root * std::sqrt(100 * newton_per_tonne / static_hook_load);
}

const AmplificationRow& AmplificationTable::row_of(double static_hook_load) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const AmplificationRow& row) {
    return !row.up_to || static_hook_load <= *row.up_to;
  });
  return found == rows.end() ? rows.back() : *found;
}

const ClauseFactor* FineMeshRules::of(structure::SquareSite site) const {
  switch (site) {
    case structure::SquareSite::field:
      return nullptr;
    case structure::SquareSite::corner:
      return &plate;
    case structure::SquareSite::welded_corner:
      return &beside_weld;
  }
  return nullptr;
}

const std::vector<std::string>& lug_formula_families() {
  static const std::vector<std::string> families{"working_stress", "dnv_2_7_3", "asme_bth_1",
                                                 "en_1993_1_8"};
  return families;
}

void StandardRules::add(const StandardRules& others) {
  name += " + " + others.name;
  edition += "; " + others.name + " " + others.edition;
  title += "; " + others.title;
  source += "; " + others.name + ": " + others.source;
  for_each_section(*this, others, [](auto& mine, const auto& theirs) {
    if (is_absent(mine)) mine = theirs;
  });
  for (const NamedFactor& family : others.lug) lug.push_back(family);
}

Format<StandardRules> standard_rules_format() {
  Table<StandardRules> table("standard",
                             "Rules for lifts as data: each figure with the clause that gives it. "
                             "Sections may be left out.");
  table
      .required("kind", &StandardRules::kind, choice<std::string>({{"standard", "standard"}}),
                "what this file describes")
      .required("title", &StandardRules::title, text(), "of the standard")
      .required("name", &StandardRules::name, text(), "as its clauses are quoted: \"0027/ND\"")
      .required("edition", &StandardRules::edition, text(), "revision and year")
      .required("source", &StandardRules::source, text(),
                "where the figures were read, and how far they can be trusted")
      .optional("weight_classes", &StandardRules::weight_classes,
                named_factors_format("Contingency on the net weight."),
                "contingency factor by weight class")
      .optional("centre_of_mass", &StandardRules::centre_of_mass,
                factor_format("Centre-of-mass factor."), "where a case gives no box of the centre")
      .optional("dynamic_amplification", &StandardRules::dynamic_amplification,
                named_tables(amplification_format()),
                "by setting (onshore, inshore, offshore): rows by static hook load")
      .optional("hoisting_classes", &StandardRules::hoisting_classes,
                named_tables(hoisting_class_format()), "dynamic factor by class and hoisting speed")
      .optional("tilt", &StandardRules::tilt, named_tables(tilt_rule_format()),
                "of lifts by two hooks or cranes, by their arrangement")
      .optional("yaw", &StandardRules::yaw, factor_format("Yaw factor."),
                "of lifts by two hooks, where a hook carries several slings")
      .optional("skew", &StandardRules::skew, named_factors_format("Skew load factor."),
                "by rigging arrangement")
      .optional("length_tolerance", &StandardRules::length_tolerance,
                factor_format("Tolerance of sling lengths."),
                "of a sling over its length, either way, for the computed skew")
      .optional("sling", &StandardRules::sling, sling_rules_format(), "safety factor of slings")
      .optional("shackle", &StandardRules::shackle, shackle_rules_format(),
                "what shackles may carry")
      .optional("accessory", &StandardRules::accessory, shackle_rules_format(),
                "what master links and sheaves may carry; without it the static load is held "
                "against their working load, the dynamic load against that times the dynamic "
                "amplification")
      .optional("shackle_side_load", &StandardRules::shackle_side_load, list_of(side_load_format()),
                "what shackles at padeyes bear of their loads, by the angle of the pull out of the "
                "plane across their pin")
      .optional("consequence", &StandardRules::consequence, consequence_format(),
                "factors on the structure's loads")
      .optional("fine_mesh", &StandardRules::fine_mesh, fine_mesh_format(),
                "what is allowed near corners of the structure, over what is allowed in fields")
      .optional("lateral", &StandardRules::lateral, factor_format("Lateral load."),
                "force along a lug's pin at least, share of the rope's force")
      .optional("lug", &StandardRules::lug, lug_factors_format(),
                "formulae of lugs (working_stress, dnv_2_7_3, asme_bth_1, en_1993_1_8); the "
                "factor is the design factor of ASME BTH-1 and before the load in the others")
      .optional("tandem", &StandardRules::tandem, list_of(tandem_format()),
                "share of its capacity that each of several cranes may use")
      .place(&StandardRules::place)
      .rule(check_rows);
  const Format<StandardRules> as_written = table.format();
  return {as_written.description,
          [as_written](const YAML::Node& node, Reading& reading, StandardRules& rules) {
            const bool done = as_written.read(node, reading, rules);
            const Quoting quoting(rules.name);
            for_each_section(rules, rules,
                             [&](auto& section, const auto&) { quoting.one(section); });
            quoting.one(rules.lug);
            return done;
          }};
}

}  // namespace blocklift::pipeline

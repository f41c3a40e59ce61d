#include "pipeline/files/lift_case/standard_in_case.h"

#include <algorithm>

#include "pipeline/declaration/table.h"
#include "pipeline/files/library/model_library.h"

namespace blocklift::pipeline {
namespace {

Format<std::vector<Located<std::string>>> rule_names_format() {
  const auto one = converted<Located<std::string>, std::vector<Located<std::string>>>(
      located(reference()),
      [](Located<std::string> name) { return std::vector<Located<std::string>>{std::move(name)}; });
  return by_shape<std::vector<Located<std::string>>>(one, list_of(located(reference()), 1),
                                                     std::nullopt);
}

Format<given::Shackle> shackle_in_case_format() {
  Table<given::Shackle> table("shackle", "Shackle at a lug.");
  table
      .required("working_load", &given::Shackle::working_load,
                quantity(Dimension::load, Range::positive()), "WLL")
      .required("breaking_load", &given::Shackle::breaking_load,
                quantity(Dimension::load, Range::positive()), "MBL");
  return table.format();
}

/// Hooks, "C1.main", each with a table: names of other things have no dot.
template <class T>
Format<std::vector<T>> tables_by_hook(Format<T> table) {
  return converted<std::vector<Named<T>>, std::vector<T>>(
      names_to(table), [](std::vector<Named<T>> items) {
        std::vector<T> values;
        for (Named<T>& item : items) {
          item.value.name = item.name;
          values.push_back(std::move(item.value));
        }
        return values;
      });
}

Format<given::MasterLink> master_link_in_case_format() {
  const auto load = quantity(Dimension::load, Range::positive());
  Table<given::MasterLink> table("master link", "Master link between a hook and its slings.");
  table
      .required("working_load", &given::MasterLink::working_load, load, "WLL, of all legs together")
      .required("breaking_load", &given::MasterLink::breaking_load, load, "MBL")
      .by_default("mass", &given::MasterLink::mass,
                  quantity(Dimension::mass, Range::not_negative()), "0 kg",
                  "counted to the weight of the rigging");
  return table.format();
}

Format<given::Sheave> sheave_in_case_format() {
  const auto load = quantity(Dimension::load, Range::positive());
  Table<given::Sheave> table("sheave", "Sheave over which a sling is led.");
  table
      .required("working_load", &given::Sheave::working_load, load,
                "WLL, on its pin, for both parts of the rope")
      .required("breaking_load", &given::Sheave::breaking_load, load,
                "MBL, on its pin, for both parts of the rope")
      .required("tread", &given::Sheave::tread, quantity(Dimension::length, Range::positive()),
                "diameter at the bottom of the groove, round which the rope is bent");
  return table.format();
}

}  // namespace

std::optional<double> given::Standard::bend_of(const std::string& rope) const {
  const given::Sheave* sheave = find_by_name(sheaves, rope);
  if (!sheave) return bend_diameter;
  return std::min(sheave->tread, bend_diameter.value_or(sheave->tread));
}

Format<given::Standard> standard_in_case_format() {
  Table<given::Standard> table(
      "standard",
      "Rules of a standard: their chain of factors is worked step by step for hooks, slings, lugs, "
      "shackles and cranes, beside what the simulation gives, and checked.");
  table
      .required("rules", &given::Standard::rule_names, rule_names_format(),
                "name of a standard's file, or a list: a section that the first lacks is taken "
                "from the next")
      .optional("weight_class", &given::Standard::weight_class, reference(),
                "of the net weight, as the rules name it")
      .optional("setting", &given::Standard::setting, reference(),
                "whose dynamic amplification holds, as the rules name it: onshore")
      .optional("hoisting_class", &given::Standard::hoisting_class, reference(),
                "of the cranes, as the rules name it: HC2")
      .optional("tilt", &given::Standard::tilt, reference(),
                "arrangement of two hooks or cranes, as the rules name it")
      .optional("skew", &given::Standard::skew, reference(),
                "rigging arrangement, as the rules name it: matched")
      .optional("wear", &given::Standard::wear, reference(), "of the slings, as the rules name it")
      .optional("centre_box", &given::Standard::centre_box, position_format(),
                "how far the centre of mass may lie from where the block has it, either way along "
                "each axis; in place of the rules' factor")
      .optional("length_tolerance", &given::Standard::length_tolerance,
                quantity(Dimension::ratio, Range::between(0, 0.1)),
                "of slings over their length, either way, for the computed skew; in place of the "
                "rules' own")
      .optional("bend_diameter", &given::Standard::bend_diameter,
                quantity(Dimension::length, Range::positive()),
                "of the least pin, hook or trunnion that slings without a bend_diameter of their "
                "own are bent round; they are not bent if left out")
      .optional("shackles", &given::Standard::shackles, named_tables(shackle_in_case_format()),
                "by lug")
      .optional("master_links", &given::Standard::master_links,
                tables_by_hook(master_link_in_case_format()), "by hook: C1.main")
      .optional("sheaves", &given::Standard::sheaves, named_tables(sheave_in_case_format()),
                "by sling that is led over one")
      .place(&given::Standard::place);
  return table.format();
}

void load_rules(given::Standard& standard, const std::filesystem::path& beside,
                ModelLibrary& library, Diagnostics& diagnostics) {
  bool first = true;
  for (const Located<std::string>& name : standard.rule_names) {
    if (name.value.empty()) continue;
    const auto rules = library.load_standard(name, beside, diagnostics);
    if (!rules) continue;
    if (first)
      standard.rules = *rules;
    else
      standard.rules.add(*rules);
    first = false;
  }
}

}  // namespace blocklift::pipeline

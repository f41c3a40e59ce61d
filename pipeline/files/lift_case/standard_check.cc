#include "pipeline/files/lift_case/standard_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

/// Looks at the choices of one case.
class StandardCheck {
 public:
  StandardCheck(const LiftCase& lift_case, Diagnostics& diagnostics)
      : case_(lift_case),
        standard_(*lift_case.standard),
        rules_(lift_case.standard->rules),
        diagnostics_(diagnostics) {}

  /// @param needed where the rules have that section, the case must choose.
  template <class T>
  void choice(const char* key, const char* noun, const std::optional<Located<std::string>>& chosen,
              const std::vector<T>& section, bool needed) {
    if (!chosen) {
      if (!needed || section.empty()) return;
      diagnostics_.error(
          standard_.place,
          fmt::format("the rules {} need a {}, and the case gives none", rules_.name, noun),
          {fmt::format("add {}: one of {}", key, list_of_names(names_of(section)))});
      return;
    }
    if (section.empty()) {
      diagnostics_.error(chosen->mark, fmt::format("the rules {} know no {}", rules_.name, noun),
                         {fmt::format("leave {} out", key)});
      return;
    }
    exists(*chosen, section, fmt::format("the rules {} have no {}", rules_.name, noun));
  }

  template <class T>
  void exists(const Located<std::string>& chosen, const std::vector<T>& section,
              const std::string& complaint) {
    if (chosen.value.empty() || find_by_name(section, chosen.value)) return;
    diagnostics_.error(chosen.mark, fmt::format("{} \"{}\"", complaint, chosen.value),
                       {names_hint("they have", names_of(section), chosen.value)});
  }

  void sling(const given::Rope& rope) {
    // A model that could not be read has been complained of.
    if (!rope.rope.stretches()) return;
    const auto lacks = [&](const char* key, const char* why) {
      diagnostics_.error(
          rope.name.mark,
          fmt::format("the model of rope {} has no {}, which {}", rope.name.value, key, why),
          {fmt::format("add {} to the rope's model", key)});
    };
    if (rules_.sling) {
      const std::string why = fmt::format("the rules {} need for slings", rules_.name);
      if (!rope.rope.material)
        lacks("material", why.c_str());
      else
        exists(*rope.rope.material, rules_.sling->material,
               fmt::format("the rules {} have no material", rules_.name));
      if (!rope.rope.termination)
        lacks("termination", why.c_str());
      else
        exists(*rope.rope.termination, rules_.sling->termination,
               fmt::format("the rules {} have no termination", rules_.name));
    }
    // A rope with a bend of its own has been held against it, and not against the standard's.
    const std::optional<double> bend =
        rope.bend_diameter ? std::nullopt : standard_.bend_of(rope.name.value);
    if (!bend) return;
    if (!rope.rope.diameter) {
      lacks("diameter", "the bend diameter is held against");
    } else if (*bend < *rope.rope.diameter) {
      diagnostics_.error(standard_.place,
                         fmt::format("rope {} of {} is bent round {}", rope.name.value,
                                     format_quantity(*rope.rope.diameter, Dimension::length),
                                     format_quantity(*bend, Dimension::length)),
                         {"a sling is not bent round less than its own diameter"});
    }
  }

  void shackles() {
    std::vector<std::string> lugs = names_of(case_.load.lugs);
    if (case_.load.model) lugs = case_.load.model->lug_names();
    for (const given::Shackle& shackle : standard_.shackles) {
      if (!rules_.shackle) {
        diagnostics_.error(shackle.name.mark,
                           fmt::format("the rules {} say nothing of shackles", rules_.name),
                           {"leave shackles out, or add a standard that has them to rules"});
        return;
      }
      if (std::find(lugs.begin(), lugs.end(), shackle.name.value) == lugs.end())
        diagnostics_.error(shackle.name.mark,
                           fmt::format("a shackle is at lug \"{}\", which the load does not have",
                                       shackle.name.value),
                           {names_hint("its lugs are", lugs, shackle.name.value)});
      else if (!is_pulled_at(shackle.name.value))
        diagnostics_.error(
            shackle.name.mark,
            fmt::format("a shackle is at lug {}, at which {}", shackle.name.value,
                        case_.load_table ? "the load table has no load" : "no rope ends"),
            {"nothing would be held against it: leave it out"});
      breaks_above_working_load(shackle, "the shackle at lug");
    }
  }

  void master_links() {
    std::vector<std::string> hooks;
    for (const given::Rope& rope : case_.ropes)
      if (rope.is_sling() && rope.path.front().kind == ResolvedPoint::Kind::hook)
        hooks.push_back(rope.path.front().body_name(case_.cranes));
    std::sort(hooks.begin(), hooks.end());
    hooks.erase(std::unique(hooks.begin(), hooks.end()), hooks.end());
    for (const given::MasterLink& link : standard_.master_links) {
      if (std::find(hooks.begin(), hooks.end(), link.name.value) == hooks.end())
        diagnostics_.error(link.name.mark,
                           fmt::format("a master link is at hook \"{}\", from which no sling hangs",
                                       link.name.value),
                           {names_hint("slings hang from", hooks, link.name.value)});
      breaks_above_working_load(link, "the master link at hook");
    }
  }

  void sheaves() {
    std::vector<std::string> slings;
    for (const given::Rope& rope : case_.ropes)
      if (rope.is_sling()) slings.push_back(rope.name.value);
    for (const given::Sheave& sheave : standard_.sheaves) {
      if (std::find(slings.begin(), slings.end(), sheave.name.value) == slings.end())
        diagnostics_.error(
            sheave.name.mark,
            fmt::format("a sheave is at \"{}\", which is no sling of the case", sheave.name.value),
            {names_hint("its slings are", slings, sheave.name.value)});
      breaks_above_working_load(sheave, "the sheave of rope");
    }
  }

  bool is_pulled_at(const std::string& lug) const {
    if (case_.load_table) return find_by_name(case_.load_table->static_loads, lug) != nullptr;
    // Ropes whose points could not be found have been complained of.
    return std::any_of(case_.ropes.begin(), case_.ropes.end(), [&](const given::Rope& rope) {
      return rope.path.empty() || rope.path.front().lug == lug || rope.path.back().lug == lug;
    });
  }

  template <class Item>
  void breaks_above_working_load(const Item& one, const char* what) {
    if (!(one.breaking_load < one.working_load)) return;
    diagnostics_.error(one.name.mark,
                       fmt::format("{} {} breaks below its working load", what, one.name.value));
  }

 private:
  const LiftCase& case_;
  const given::Standard& standard_;
  const StandardRules& rules_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_standard(const LiftCase& lift_case, Diagnostics& diagnostics) {
  // Rules that could not be read have been complained about.
  if (!lift_case.standard || lift_case.standard->rules.name.empty()) return;
  const given::Standard& standard = *lift_case.standard;
  const StandardRules& rules = standard.rules;
  StandardCheck check(lift_case, diagnostics);
  const bool moves = !lift_case.load_table;
  check.choice("weight_class", "weight class", standard.weight_class, rules.weight_classes, true);
  check.choice("setting", "setting", standard.setting, rules.dynamic_amplification, true);
  check.choice("hoisting_class", "hoisting class", standard.hoisting_class, rules.hoisting_classes,
               moves);
  check.choice("skew", "skew", standard.skew, rules.skew, true);
  check.choice("tilt", "tilt", standard.tilt, rules.tilt, lift_case.cranes.size() > 1);
  std::vector<NamedFactor> wear;
  if (rules.sling) wear = rules.sling->wear;
  check.choice("wear", "wear", standard.wear, wear, moves);
  for (const given::Rope& rope : lift_case.ropes)
    if (rope.is_sling()) check.sling(rope);
  check.shackles();
  check.master_links();
  check.sheaves();
}

}  // namespace blocklift::pipeline

#include "pipeline/formats/results/summary_check.h"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_complaints_about_summary = 20;

/// What a value must be.
struct Rule {
  enum class Kind { text, number, flag, scalar, list, table, rows };
  struct Key;
  Kind kind = Kind::text;
  std::vector<Key> keys;           ///< of a table: those that are known
  std::vector<Rule> entry;         ///< of a list or of rows by name: the rule of each, one
  std::size_t length = 0;          ///< of a list; 0: any
  std::vector<std::string> words;  ///< of a text; empty: any
};

struct Rule::Key {
  const char* name;
  Rule rule;
  bool required = false;
};

using Keys = std::vector<Rule::Key>;

Rule of_kind(Rule::Kind kind) {
  Rule rule;
  rule.kind = kind;
  return rule;
}
Rule of_entries(Rule::Kind kind, Rule entry) {
  Rule rule = of_kind(kind);
  rule.entry.push_back(std::move(entry));
  return rule;
}

Rule text() { return of_kind(Rule::Kind::text); }
Rule one_of(std::vector<std::string> words) {
  Rule rule = text();
  rule.words = std::move(words);
  return rule;
}
/// Null stands for a number that is not known.
Rule number() { return of_kind(Rule::Kind::number); }
Rule flag() { return of_kind(Rule::Kind::flag); }
Rule scalar() { return of_kind(Rule::Kind::scalar); }
Rule list(Rule entry, std::size_t length = 0) {
  Rule rule = of_entries(Rule::Kind::list, std::move(entry));
  rule.length = length;
  return rule;
}
Rule table(Keys keys) {
  Rule rule = of_kind(Rule::Kind::table);
  rule.keys = std::move(keys);
  return rule;
}
/// A table whose keys are names.
Rule by_name(Rule entry) { return of_entries(Rule::Kind::rows, std::move(entry)); }
Rule point() { return list(number(), 3); }

/// A table with further keys.
Rule with(Rule rule, Keys keys) {
  for (Rule::Key& key : keys) rule.keys.push_back(std::move(key));
  return rule;
}

Keys numbers(std::initializer_list<const char*> names) {
  Keys keys;
  for (const char* name : names) keys.push_back({name, number()});
  return keys;
}

Rule loads() {
  return with(table({{"name", text(), true},
                     {"lug", text()},
                     {"hoist", text()},
                     {"crane", text()},
                     {"kind", text()},
                     {"linked_static_N", by_name(number())},
                     {"linked_dynamic_N", by_name(number())},
                     {"after_blow", with(table({{"slack_rope", text()}}),
                                         numbers({"slack_from_s", "taut_again_s", "within_s"}))}}),
              numbers({"max_static_tension_N", "time_of_max_static_s", "max_dynamic_tension_N",
                       "time_of_max_dynamic_s", "dynamic_over_static", "breaking_load_N",
                       "bend_efficiency", "largest_strain", "capacity_N", "max_swing_rad",
                       "max_static_load_N", "max_dynamic_load_N", "max_static_load_Nm",
                       "max_dynamic_load_Nm", "max_static_moment_Nm", "max_dynamic_moment_Nm",
                       "min_static_tension_N", "min_dynamic_tension_N", "largest_residual"}));
}

Rule stages() {
  Rule load = loads();
  load.keys.front().required = false;
  return list(table({{"name", text(), true},
                     {"start_s", number()},
                     {"end_s", number()},
                     {"condition_met_s", number()},
                     {"ropes", list(loads())},
                     {"hoists", list(loads())},
                     {"load", std::move(load)}}));
}

Rule checks() {
  return list(table({{"name", text(), true},
                     {"demand", number()},
                     {"limit", number()},
                     {"unit", text()},
                     {"utilisation", number()},
                     {"utilisation_band", list(number(), 2)},
                     {"pass", flag(), true},
                     {"time_s", number()},
                     {"note", text()}}));
}

Rule measures() {
  return list(with(table({{"name", text(), true},
                          {"subject", text()},
                          {"kind", text()},
                          {"unit", text()},
                          {"extreme", text()},
                          {"meaning", text()}}),
                   numbers({"static", "time_of_static_s", "dynamic", "time_of_dynamic_s"})));
}

Rule worst_instant() {
  const Rule trial =
      with(table({{"rope", text(), true}}), numbers({"time_s", "share", "peak_time_s"}));
  return with(trial, {{"undisturbed", trial}, {"tried", list(trial)}});
}

Rule sling_lengths() {
  const Rule state =
      with(table({{"tensions_N", by_name(number())}, {"lengths_m", by_name(number())}}),
           numbers({"tilt_rad", "trim_rad", "list_rad"}));
  return table(
      {{"tolerance", number()},
       {"time_s", number()},
       {"trouble", text()},
       {"lengths_m", by_name(number())},
       {"meant", state},
       {"errors",
        list(table({{"sling", text(), true}, {"longer", state, true}, {"shorter", state, true}}))},
       {"worst", state},
       {"level", state}});
}

Rule comparison() {
  return table(
      {{"source", text()},
       {"stress_increase_percent", number()},
       {"deformation_increase_percent", number()},
       {"ropes", list(with(table({{"name", text(), true}}),
                           numbers({"published_static_N", "published_dynamic_N",
                                    "static_difference_percent", "dynamic_difference_percent"})))},
       {"series", list(with(table({{"name", text(), true}}),
                            numbers({"points", "mean_difference_percent",
                                     "largest_difference_percent", "time_of_largest_s"})))}});
}

Rule standard() {
  const Rule step = table({{"name", text(), true},
                           {"kind", text(), true},
                           {"unit", text(), true},
                           {"standard", number()},
                           {"simulated", number()},
                           {"clause", text()},
                           {"formula", text()}});
  const Rule chain = with(table({{"name", text(), true},
                                 {"kind", text(), true},
                                 {"unit", text(), true},
                                 {"limit_text", text()},
                                 {"limit_clause", text()},
                                 {"pass", flag()},
                                 {"steps", list(step), true}}),
                          numbers({"standard", "simulated", "limit", "simulated_limit",
                                   "standard_utilisation", "simulated_utilisation"}));
  return table({{"name", text(), true},
                {"title", text()},
                {"edition", text()},
                {"source", text()},
                {"notes", list(text())},
                {"governing", text()},
                {"chains", list(chain), true}});
}

Rule structure_way() {
  const Rule state =
      with(table({{"rope", text()},
                  {"checked_group", text()},
                  {"peak_group", text()},
                  {"checked_point_m", point()},
                  {"peak_point_m", point()},
                  {"max_displacement_point_m", point()}}),
           numbers({"checked_von_mises_Pa", "peak_von_mises_Pa", "max_displacement_m",
                    "force_residual", "moment_residual", "reaction_over_weight", "time_s",
                    "rope_share", "field_von_mises_Pa", "instants", "largest_principal_Pa",
                    "smallest_principal_Pa", "max_displacement_time_s"}));
  return table({{"rope", text()},
                {"static", state},
                {"dynamic", state},
                {"stress_increase_percent", number()},
                {"deformation_increase_percent", number()}});
}

Rule structure_history() {
  const Rule practice =
      with(table({{"safe", flag()}, {"worst_part", text()}, {"worst_point_m", point()}}),
           numbers({"largest_difference_percent", "worst_difference_percent", "worst_envelope_Pa",
                    "share_of_patches_short"}));
  const Rule points =
      list(with(table({{"name", text(), true}, {"part", text()}, {"point_m", point()}}),
                numbers({"max_static_von_mises_Pa", "max_dynamic_von_mises_Pa", "cycles_per_lift",
                         "largest_range_Pa", "damage_per_lift", "damage", "largest_normal_Pa",
                         "smallest_normal_Pa"})));
  return with(structure_way(),
              {{"places", number()},
               {"practice", table({{"per_rope_maxima", practice}, {"rope_instants", practice}})},
               {"fatigue", with(table({{"curve", text()}, {"source", text()}}),
                                numbers({"stress_concentration", "lifts"}))},
               {"points", points},
               {"hot_spot_curve", text()},
               {"hot_spots", points}});
}

Rule buckling() {
  const Rule panel =
      with(table({{"plate", text(), true},
                  {"centre_m", point()},
                  {"sides_m", list(number(), 2)},
                  {"field_m", list(number(), 2)},
                  {"free_edges_along_sides", list(number(), 2)},
                  {"state", text()}}),
           numbers({"thickness_m", "free_edges", "s11_Pa", "s22_Pa", "s12_Pa", "s11_gradient_Pa",
                    "s22_gradient_Pa", "utilisation", "elastic_utilisation", "time_s"}));
  const Rule bar =
      with(table({{"bar", text(), true},
                  {"from_m", point()},
                  {"to_m", point()},
                  {"moments_Nm", list(number())},
                  {"state", text()}}),
           numbers({"plate_width_m", "buckling_length_m", "compression_N", "buckling_resistance_N",
                    "utilisation", "time_s", "tripping_length_m", "tripping_stress_Pa",
                    "tripping_strength_Pa", "tripping_compression_Pa", "tripping_utilisation"}));
  return with(table({{"panels", list(panel)}, {"bars", list(bar)}}),
              numbers({"panels_looked_at", "bars_looked_at", "bar_factor"}));
}

Rule padeyes() {
  const Rule state =
      with(table({{"name", text(), true}, {"force_N", point()}, {"peak_point_m", point()}}),
           numbers({"time_s", "main_plate_checked_von_mises_Pa", "cheeks_checked_von_mises_Pa",
                    "peak_von_mises_Pa", "force_residual", "moment_residual"}));
  return list(table(
      {{"lug", text(), true},
       {"rope", text()},
       {"padeye", text()},
       {"consequence_factor", number()},
       {"unknowns", number()},
       {"governing_state", number()},
       {"file", text()},
       {"formulas",
        list(with(
            table({{"name", text(), true}, {"unit", text()}, {"pass", flag()}, {"source", text()}}),
            numbers({"demand", "limit", "utilisation", "time_s"})))},
       {"states", list(state)}}));
}

Rule load_table() {
  const Rule set = with(table({{"sum_N", point()},
                               {"moment_about_centre_of_mass_Nm", point()},
                               {"angular_acceleration_rad_s2", point()}}),
                        numbers({"over_weight", "acceleration_g", "lever_m"}));
  return table({{"weight_N", number()}, {"static", set}, {"dynamic", set}});
}

Rule structure() {
  const Rule lug_stress = table(numbers(
      {"static_checked_von_mises_Pa", "dynamic_checked_von_mises_Pa", "stress_increase_percent"}));
  const Rule step =
      table(numbers({"unknowns", "elements", "smallest_edge_m", "static_checked_von_mises_Pa",
                     "dynamic_checked_von_mises_Pa", "stress_increase_percent"}));
  const Rule stress =
      with(table({{"point_m", point()}, {"part", text()}}), numbers({"value", "time_s"}));
  const Rule stage = with(table({{"name", text(), true},
                                 {"static_checked_von_mises", stress},
                                 {"dynamic_checked_von_mises", stress}}),
                          numbers({"start_s", "end_s", "stress_increase_percent"}));
  return with(
      table({{"material", text()},
             {"stages", list(stage)},
             {"per_rope_maxima", structure_way()},
             {"simultaneous", structure_way()},
             {"history", structure_history()},
             {"simultaneous_by_rope", list(structure_way())},
             {"lugs", list(table({{"name", text(), true},
                                  {"rope", text()},
                                  {"simultaneous", lug_stress},
                                  {"per_rope_maxima", lug_stress}}))},
             {"mass",
              with(table({{"centre_of_mass_m", point()}, {"steel_centre_of_mass_m", point()}}),
                   numbers({"total_kg", "steel_kg", "outfitting_kg"}))},
             {"estimated_error", table({{"relative", number()},
                                        {"worst_part", text()},
                                        {"worst_point_m", point()},
                                        {"groups", by_name(number())}})},
             {"accuracy",
              with(table({{"is_reached", flag()}, {"steps", list(step)}}),
                   numbers({"asked", "stress_change", "stress_band", "increase_change_percent"}))},
             {"load_table", load_table()},
             {"buckling", buckling()},
             {"padeyes", padeyes()}}),
      numbers({"unknowns", "elements", "element_degree", "mesh_size_m", "yield_Pa",
               "first_elastic_period_s"}));
}

Rule natural_periods() {
  const Rule mode = with(table({{"name", text(), true},
                                {"kind", text()},
                                {"turned_by_wind", flag()},
                                {"energy_share_by_body", by_name(number())},
                                {"energy_share_by_elastic_mode", by_name(number())}}),
                         numbers({"period_s", "frequency_Hz", "damping_ratio", "elastic_share"}));
  return list(
      table({{"instant", text(), true}, {"time_s", number()}, {"modes", list(mode), true}}));
}

Rule document() {
  Keys keys;
  for (const char* name : {"project", "client", "revision", "prepared", "checked", "approved"})
    keys.push_back({name, text()});
  return table(std::move(keys));
}

Rule summary_rule() {
  return table({{"case", text()},
                {"part", text()},
                {"title", text()},
                {"program_version", text()},
                {"created", text()},
                {"run", text()},
                {"input_hash", text()},
                {"mesh_page", text()},
                {"verdict", one_of({"pass", "fail"})},
                {"verdict_reasons", list(text())},
                {"indicative", text()},
                {"document", document()},
                {"checks", checks()},
                {"ropes", list(loads())},
                {"hoists", list(loads())},
                {"cranes", list(loads())},
                {"loops", list(loads())},
                {"stages", stages()},
                {"parted", list(with(table({{"name", text(), true}}),
                                     numbers({"time_s", "tension_N", "energy_J"})))},
                {"worst_instant", worst_instant()},
                {"measures", measures()},
                {"sling_lengths", sling_lengths()},
                {"comparison", comparison()},
                {"standard", standard()},
                {"structure", structure()},
                {"natural_periods", natural_periods()},
                {"energy",
                 table(numbers({"largest_energy_J", "largest_imbalance_J", "relative_imbalance"}))},
                {"solver", by_name(scalar())},
                {"timing", by_name(scalar())},
                {"assumptions", list(text())},
                {"warnings", list(text())},
                {"files", list(table({{"name", text(), true}, {"content", text(), true}}))}});
}

std::string shown_value_of(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "a table";
    case Json::value_t::array:
      return fmt::format("a list of {}", value.size());
    case Json::value_t::string:
      return fmt::format("the text \"{}\"", value.get<std::string>());
    default:
      return value.dump();
  }
}

std::string wanted(const Rule& rule) {
  switch (rule.kind) {
    case Rule::Kind::text: {
      if (rule.words.empty()) return "a text";
      std::string words;
      for (const std::string& word : rule.words)
        words += fmt::format("{}\"{}\"", words.empty() ? "" : " or ", word);
      return words;
    }
    case Rule::Kind::number:
      return "a number or null";
    case Rule::Kind::flag:
      return "true or false";
    case Rule::Kind::scalar:
      return "a number, a text or null";
    case Rule::Kind::list:
      return rule.length > 0 ? fmt::format("a list of {}", rule.length) : "a list";
    case Rule::Kind::table:
    case Rule::Kind::rows:
      return "a table";
  }
  return "";
}

bool fits(const Rule& rule, const Json& value) {
  switch (rule.kind) {
    case Rule::Kind::text:
      if (!value.is_string()) return false;
      if (rule.words.empty()) return true;
      for (const std::string& word : rule.words)
        if (value.get<std::string>() == word) return true;
      return false;
    case Rule::Kind::number:
      return value.is_number() || value.is_null();
    case Rule::Kind::flag:
      return value.is_boolean();
    case Rule::Kind::scalar:
      return value.is_primitive();
    case Rule::Kind::list:
      return value.is_array() && (rule.length == 0 || value.size() == rule.length);
    case Rule::Kind::table:
    case Rule::Kind::rows:
      return value.is_object() || value.is_null();
  }
  return false;
}

/// Walks through a summary along the rules.
class SummaryCheck {
 public:
  std::vector<std::string> take() { return std::move(complaints_); }

  void look(const Rule& rule, const Json& value, const std::string& path) {
    if (complaints_.size() >= most_complaints_about_summary) return;
    if (!fits(rule, value))
      return complain(path, fmt::format("is {}; {} is due", shown_value_of(value), wanted(rule)));
    if (value.is_null()) return;
    if (rule.kind == Rule::Kind::table) look_at_keys(rule, value, path);
    if (rule.kind == Rule::Kind::rows)
      for (const auto& [name, entry] : value.items()) look(rule.entry[0], entry, below(path, name));
    if (rule.kind == Rule::Kind::list) look_at_entries(rule.entry[0], value, path);
  }

 private:
  static std::string below(const std::string& path, const std::string& name) {
    return path.empty() ? name : path + "." + name;
  }

  void complain(const std::string& path, const std::string& what) {
    complaints_.push_back(fmt::format("\"{}\" {}", path, what));
  }

  void look_at_keys(const Rule& rule, const Json& value, const std::string& path) {
    for (const Rule::Key& key : rule.keys) {
      const auto found = value.find(key.name);
      if (found != value.end())
        look(key.rule, *found, below(path, key.name));
      else if (key.required)
        complain(below(path, key.name), fmt::format("is missing; {} is due", wanted(key.rule)));
    }
  }

  /// Entries are called by their names, as figures are, and by their number if they have none.
  void look_at_entries(const Rule& rule, const Json& value, const std::string& path) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      const Json& entry = value[i];
      std::string place = fmt::format("{}[{}]", path, i + 1);
      if (entry.is_object())
        if (const auto name = entry.find("name"); name != entry.end() && name->is_string())
          place = below(path, name->get<std::string>());
      look_at_row(rule, entry, place);
    }
  }

  /// Only a number of a list may be unknown, not a row.
  void look_at_row(const Rule& rule, const Json& entry, const std::string& place) {
    if (rule.kind == Rule::Kind::table && entry.is_null())
      return complain(place, "is null; a table is due");
    look(rule, entry, place);
  }

  std::vector<std::string> complaints_;
};

}  // namespace

std::vector<std::string> complaints_about_summary(const Json& summary) {
  static const Rule rule = summary_rule();
  if (!summary.contains("case") && !summary.contains("part"))
    return {"\"case\" is missing; the name of the case is due"};
  SummaryCheck check;
  check.look(rule, summary, "");
  return check.take();
}

}  // namespace blocklift::pipeline

#include "pipeline/declaration/key_change.h"

#include <charconv>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace blocklift::pipeline {
namespace {

/// A step of a key's path: a name, or a place in a list from 1 on.
struct KeyStep {
  std::string name;
  std::size_t place = 0;
};

/// "moves[2].by" in steps; none if the brackets are wrong.
std::optional<std::vector<KeyStep>> steps_of(std::string_view key) {
  std::vector<KeyStep> steps;
  while (!key.empty()) {
    if (key.front() == '[') {
      const std::size_t end = key.find(']');
      KeyStep step;
      const char* last = key.data() + std::min(end, key.size());
      const auto [stop, error] = std::from_chars(key.data() + 1, last, step.place);
      if (end == std::string_view::npos || error != std::errc() || stop != last || step.place == 0)
        return std::nullopt;
      steps.push_back(step);
      key.remove_prefix(end + 1);
      if (!key.empty() && key.front() == '.') key.remove_prefix(1);
      continue;
    }
    const std::string_view name = key.substr(0, key.find_first_of(".["));
    if (name.empty()) return std::nullopt;
    steps.push_back({std::string(name), 0});
    key.remove_prefix(name.size());
    if (!key.empty() && key.front() == '.') key.remove_prefix(1);
  }
  return steps;
}

std::vector<std::string> keys_of(const YAML::Node& table) {
  std::vector<std::string> keys;
  for (const auto& entry : table)
    if (entry.first.IsScalar()) keys.push_back(entry.first.Scalar());
  return keys;
}

/// Goes one step down; false after a complaint.
bool descend(const KeyStep& step, const std::string& way, const KeyChange& change,
             const Document& document, YAML::Node& node, Diagnostics& diagnostics) {
  const std::string place = way.empty() ? *document.file : *document.file + ": " + way;
  if (step.place > 0) {
    if (node.IsSequence() && step.place <= node.size()) {
      node.reset(node[step.place - 1]);
      return true;
    }
    diagnostics.error(change.mark, fmt::format("there is no {} to change", change.key),
                      {node.IsSequence() ? fmt::format("{} has {} items", place, node.size())
                                         : fmt::format("{} is no list", place)});
    return false;
  }
  if (node.IsMap()) {
    for (auto entry : node) {
      if (!entry.first.IsScalar() || entry.first.Scalar() != step.name) continue;
      node.reset(entry.second);
      return true;
    }
  }
  diagnostics.error(
      change.mark, fmt::format("there is no {} to change", change.key),
      {node.IsMap() ? names_hint(fmt::format("{} has the keys", place), keys_of(node), step.name)
                    : fmt::format("{} is no table", place)});
  return false;
}

/// @returns false after a complaint.
bool give_new_value(const KeyChange& change, Document& document, Diagnostics& diagnostics) {
  YAML::Node node = document.root;
  std::string way;
  for (const KeyStep& step : steps_of(change.key).value_or(std::vector<KeyStep>{})) {
    if (!descend(step, way, change, document, node, diagnostics)) return false;
    way += step.place > 0 ? fmt::format("[{}]", step.place) : (way.empty() ? "" : ".") + step.name;
  }
  if (!node.IsScalar() && !node.IsNull()) {
    diagnostics.error(change.mark, fmt::format("{} is a {}; a key with one value can be changed",
                                               change.key, node.IsMap() ? "table" : "list"));
    return false;
  }
  node = change.value;
  return true;
}

}  // namespace

std::optional<KeyChange> parse_key_change(std::string_view text, const Mark& mark,
                                          Diagnostics& diagnostics) {
  const std::size_t sign = text.find('=');
  const std::string_view place = text.substr(0, sign);
  const std::size_t colon = place.find(':');
  KeyChange change{"", std::string(place), "", mark};
  if (colon != std::string_view::npos) {
    change.file = place.substr(0, colon);
    change.key = place.substr(colon + 1);
  }
  if (sign != std::string_view::npos) change.value = text.substr(sign + 1);
  const auto steps = steps_of(change.key);
  if (steps && !steps->empty() && !change.value.empty()) return change;
  diagnostics.error(
      mark, fmt::format("\"{}\" changes nothing", text),
      {"key=value is due, for example \"ropes.R1.length=10 m\", with the model before "
       "a colon if it is a model's: \"blocks/hull-860t:mass=870 t\""});
  return std::nullopt;
}

void apply_key_changes(const std::vector<KeyChange>& changes, std::string_view file,
                       Document& document, Diagnostics& diagnostics) {
  bool changed = false;
  for (const KeyChange& change : changes)
    if (change.file == file) changed |= give_new_value(change, document, diagnostics);
  // Writing costs as much as reading: once, for all changes.
  if (changed) document.text = YAML::Dump(document.root) + '\n';
}

}  // namespace blocklift::pipeline

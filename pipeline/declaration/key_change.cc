#include "pipeline/declaration/key_change.h"

#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace blocklift::pipeline {
namespace {

/// A step of a key's path: a name, or a place in a list from 1 on.
struct KeyStep {
  std::string name;
  std::optional<std::size_t> place;
};

/// "moves[2].by" in steps; none if the brackets are wrong. A place may be 0, which no list has.
std::optional<std::vector<KeyStep>> steps_of(std::string_view key) {
  std::vector<KeyStep> steps;
  while (!key.empty()) {
    if (key.front() == '[') {
      const std::size_t end = key.find(']');
      std::size_t number = 0;
      const char* last = key.data() + std::min(end, key.size());
      const auto [stop, error] = std::from_chars(key.data() + 1, last, number);
      if (end == std::string_view::npos || error != std::errc() || stop != last)
        return std::nullopt;
      steps.push_back({"", number});
      key.remove_prefix(end + 1);
      if (!key.empty() && key.front() == '.') key.remove_prefix(1);
      continue;
    }
    const std::string_view name = key.substr(0, key.find_first_of(".["));
    if (name.empty()) return std::nullopt;
    steps.push_back({std::string(name), std::nullopt});
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
  if (step.place) {
    if (node.IsSequence() && *step.place >= 1 && *step.place <= node.size()) {
      node.reset(node[*step.place - 1]);
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
       : node.IsSequence() && node.size() > 0
           ? fmt::format("{} is a list: its items are {}[1] to [{}]", place, way, node.size())
           : fmt::format("{} is no table", place)});
  return false;
}

/// The node that a change is to give another value; none after a complaint.
std::optional<YAML::Node> node_to_change(const KeyChange& change, const Document& document,
                                         Diagnostics& diagnostics) {
  YAML::Node node = document.root;
  std::string way;
  for (const KeyStep& step : steps_of(change.key).value_or(std::vector<KeyStep>{})) {
    if (!descend(step, way, change, document, node, diagnostics)) return std::nullopt;
    way += step.place ? fmt::format("[{}]", *step.place) : (way.empty() ? "" : ".") + step.name;
  }
  if (node.IsScalar() || node.IsNull()) return node;
  diagnostics.error(change.mark, fmt::format("{} is a {}; a key with one value can be changed",
                                             change.key, node.IsMap() ? "table" : "list"));
  return std::nullopt;
}

/// May the value stand in a document without quotes? True of what surely may: words and numbers.
bool is_plain(std::string_view value) {
  const auto is_alphanumeric = [](unsigned char letter) {
    return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
           (letter >= 'A' && letter <= 'Z');
  };
  const std::string_view begin = value.substr(value.starts_with('-') ? 1 : 0);
  return !begin.empty() && is_alphanumeric(begin.front()) && value.back() != ' ' &&
         std::all_of(value.begin(), value.end(), [&](char letter) {
           return is_alphanumeric(static_cast<unsigned char>(letter)) ||
                  std::string_view(" ._/+-").find(letter) != std::string_view::npos;
         });
}

/// The text of a document with other values at some places: comments and all else stay.
class EditedText {
 public:
  explicit EditedText(const std::string& text) : text_(text) {}

  /// Puts another value in the place of a node's; called before the node changes.
  void replace(const YAML::Node& node, const std::string& value) {
    const YAML::Mark mark = node.Mark();
    const auto place = static_cast<std::size_t>(mark.is_null() ? 0 : mark.pos);
    const auto known = edits_.find(place);
    if (known == edits_.end() && stands_at(place, node)) {
      edits_[place] = {node.Scalar().size(), value};
    } else if (known != edits_.end()) {
      known->second.value = value;
    } else {
      is_known_ = false;
    }
    is_known_ = is_known_ && is_plain(value);
  }

  /// None where a value does not stand in the text as it is read, or needs quotes.
  std::optional<std::string> text() const {
    if (!is_known_) return std::nullopt;
    std::string edited;
    std::size_t end = 0;
    for (const auto& [place, edit] : edits_) {
      edited.append(text_, end, place - end).append(edit.value);
      end = place + edit.length;
    }
    return edited.append(text_, end);
  }

 private:
  struct Edit {
    std::size_t length = 0;  ///< of what is replaced
    std::string value;
  };

  /// Is the node's value, a plain one, what stands in the text at a place? One in quotes, over
  /// several lines or behind an anchor is not.
  bool stands_at(std::size_t place, const YAML::Node& node) const {
    constexpr const char* plain_tag = "?";
    const auto column = static_cast<std::size_t>(node.Mark().column);
    if (node.Tag() != plain_tag || node.Scalar().empty() || place > text_.size() || column > place)
      return false;
    // A byte-order mark would shift all places.
    const bool is_at_column = column == place || text_[place - column - 1] == '\n';
    return is_at_column && text_.compare(place, node.Scalar().size(), node.Scalar()) == 0;
  }

  const std::string& text_;
  std::map<std::size_t, Edit> edits_;
  bool is_known_ = true;
};

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
  if (steps && std::ranges::any_of(*steps, [](const KeyStep& step) { return step.place == 0U; })) {
    diagnostics.error(mark, fmt::format("\"{}\" has no place 0", change.key),
                      {"places of a list are counted from 1: centre_of_mass[1] is the first"});
    return std::nullopt;
  }
  if (steps && !steps->empty() && !change.value.empty()) return change;
  diagnostics.error(
      mark, fmt::format("\"{}\" changes nothing", text),
      {"key=value is due, for example \"ropes.R1.length=10 m\", with the model before "
       "a colon if it is a model's: \"blocks/hull-860t:mass=870 t\""});
  return std::nullopt;
}

Document ChangingDocument::with(const std::vector<KeyChange>& changes, std::string_view file,
                                Diagnostics& diagnostics) {
  take_back();
  EditedText edited(document_.text);
  for (const KeyChange& change : changes) {
    if (change.file != file) continue;
    std::optional<YAML::Node> node = node_to_change(change, document_, diagnostics);
    if (!node) continue;
    edited.replace(*node, change.value);
    before_.push_back({*node, node->IsNull() ? std::nullopt : std::optional(node->Scalar())});
    *node = change.value;
  }
  Document changed = document_;
  if (before_.empty()) return changed;
  std::optional<std::string> text = edited.text();
  changed.text = text ? std::move(*text) : YAML::Dump(changed.root) + '\n';
  return changed;
}

void ChangingDocument::take_back() {
  bool had_no_value = false;
  for (auto one = before_.rbegin(); one != before_.rend(); ++one) {
    if (one->value) one->node = *one->value;
    had_no_value = had_no_value || !one->value;
  }
  before_.clear();
  // A node that has a value cannot be made one without.
  if (had_no_value) document_.root.reset(YAML::Load(document_.text));
}

}  // namespace blocklift::pipeline

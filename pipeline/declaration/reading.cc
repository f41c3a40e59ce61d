#include "pipeline/declaration/reading.h"

#include <algorithm>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/due_text.h"

namespace blocklift::pipeline {
namespace {

constexpr int deepest_merge = 16;

std::string found_text(const YAML::Node& node) {
  if (node.IsSequence()) return "a list";
  if (node.IsMap()) return "a table of keys";
  return "nothing";
}

}  // namespace

void Reading::error(const YAML::Node& node, std::string message, std::vector<std::string> hints) {
  error(mark_of(node), std::move(message), std::move(hints));
}

void Reading::error(Mark mark, std::string message, std::vector<std::string> hints) {
  diagnostics_.error(std::move(mark), std::move(message), std::move(hints));
}

bool Reading::count_value(const YAML::Node& node) {
  ++value_count_;
  if (value_count_ == most_values + 1) {
    error(node,
          fmt::format("the file has more than {} values, aliases counted each time", most_values));
  }
  return value_count_ <= most_values;
}

std::vector<Entry> Reading::entries_of(const YAML::Node& mapping) {
  EntryList list;
  add_entries(mapping, 0, list);
  return std::move(list.entries);
}

void Reading::add_entries(const YAML::Node& mapping, int merge_depth, EntryList& list) {
  const std::size_t inherited =
      list.entries.size();  // keys that merging mappings have already given
  std::vector<YAML::Node> merged;
  for (const auto& pair : mapping) {
    if (!count_value(pair.second)) return;
    if (!pair.first.IsScalar()) {
      error(pair.first, "a key must be a plain name");
      continue;
    }
    const std::string key = pair.first.Scalar();
    if (key.empty()) {
      error(pair.first, "a key is empty; a name is due");
      continue;
    }
    if (key == "<<") {
      merged.push_back(pair.second);
      continue;
    }
    const auto [same, is_new] = list.place_of_key.try_emplace(key, list.entries.size());
    if (is_new) {
      list.entries.push_back({key, mark_of(pair.first), pair.second});
    } else if (same->second >= inherited) {
      error(pair.first, fmt::format("key \"{}\" is given twice", key),
            {fmt::format("it stands first in line {}", list.entries[same->second].mark.line)});
    }
  }
  for (const YAML::Node& node : merged) merge_entries(node, merge_depth + 1, list);
}

void Reading::merge_entries(const YAML::Node& merged, int merge_depth, EntryList& list) {
  if (merge_depth > deepest_merge) {
    error(merged, "merge keys \"<<\" are nested too deeply");
  } else if (merged.IsMap()) {
    add_entries(merged, merge_depth, list);
  } else if (merged.IsSequence()) {
    for (const YAML::Node& node : merged) {
      if (!count_value(node)) return;
      merge_entries(node, merge_depth, list);
    }
  } else {
    error(merged, "the merge key \"<<\" takes a table of keys or a list of them");
  }
}

bool Reading::has_value(const Entry& entry, const ValueDescription& due) {
  if (!entry.value.IsNull()) return true;
  error(entry.mark, fmt::format("{} has no value; {}", entry.key, due_text(due)));
  return false;
}

bool Reading::scalar_text(const YAML::Node& node, const ValueDescription& due, std::string& text) {
  if (node.IsScalar() && !node.Scalar().empty()) {
    text = node.Scalar();
    return true;
  }
  if (node.IsNull() || node.IsScalar()) {
    error(node, fmt::format("{} has no value; {} is due", key_, due.phrase()));
  } else {
    error(node, fmt::format("{} is {}; {} is due", key_, found_text(node), due.phrase()));
  }
  return false;
}

bool Reading::with_key(const std::string& key, const std::function<bool()>& read) {
  const std::string outer = std::exchange(key_, key);
  const bool done = read();
  key_ = outer;
  return done;
}

bool Reading::with_owner(const std::string& owner, const std::function<bool()>& read) {
  const std::string outer = std::exchange(owner_, owner);
  const std::size_t unsound_before =
      std::exchange(unsound_before_owner_, unread_count_ + diagnostics_.error_count());
  const bool done = read();
  owner_ = outer;
  unsound_before_owner_ = unsound_before;
  return done;
}

}  // namespace blocklift::pipeline

#include "pipeline/declaration/table.h"

#include <algorithm>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/due_text.h"

namespace blocklift::pipeline::table_detail {

namespace {

/// Parses a default as if it stood in the file. @throws std::logic_error if the declaration is
/// wrong.
YAML::Node parse_default(const std::string& text) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& exception) {
    throw std::logic_error("the declared default \"" + text + "\" is not YAML: " + exception.msg);
  }
}

/// Values whose members rules know to be unread: numbers, which are NaN or zero then, and choices.
/// An empty text would be looked for as a name.
bool may_be_unread(const ValueDescription& value) {
  using Kind = ValueDescription::Kind;
  return value.kind == Kind::quantity || value.kind == Kind::measure ||
         value.kind == Kind::number || value.kind == Kind::integer || value.kind == Kind::choice;
}

/// What stands behind a comma of "length: 3,5 m" within braces is read as a key without a value.
bool is_part_of_number(const Entry& entry) {
  return !entry.key.empty() && entry.key.front() >= '0' && entry.key.front() <= '9' &&
         entry.value.IsNull();
}

bool has_key(const std::vector<Entry>& entries, const std::string& key) {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Entry& entry) { return entry.key == key; });
}

/// The entries of known keys. There are complaints about the others. One that is mistyped goes on
/// under the name that was meant, if the file does not have that, too: so one mistake is one
/// complaint, for neither is the right key missed nor what it says.
std::vector<Entry> settle_unknown_keys(const std::vector<Entry>& entries,
                                       const std::vector<std::string>& known, Reading& reading) {
  constexpr std::size_t shortest = 3;  // any letter is near to any other
  std::vector<Entry> settled;          // anew: to assign a YAML::Node changes the document
  for (const Entry& entry : entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) {
      settled.push_back(entry);
      continue;
    }
    reading.error(
        entry.mark, reading.owner() + " has no key \"" + entry.key + "\"",
        {is_part_of_number(entry)
             ? "decimals take a point (1.5): what stands behind a comma is a key of its own"
             : names_hint("its keys are", known, entry.key)});
    if (entry.key.size() < shortest) continue;
    const std::string meant = nearest_name(entry.key, known);
    if (meant.empty() || has_key(entries, meant) || has_key(settled, meant)) continue;
    settled.push_back({meant, entry.mark, entry.value});
  }
  return settled;
}

}  // namespace

Keys::Keys(std::string noun, std::string description)
    : description_(std::make_shared<TableDescription>()) {
  description_->noun = std::move(noun);
  description_->description = std::move(description);
}

void Keys::add(std::string_view name, std::shared_ptr<const ValueDescription> value, Need need,
               std::string_view default_text, std::string_view meaning, SharedReader reader,
               ReadKey read, const MemberBytes& member) {
  KeyDescription description{std::string(name), std::move(value), need == Need::required,
                             std::string(default_text), std::string(meaning)};
  description_->keys.push_back(description);
  keys_.push_back({std::move(description), std::move(reader), read, member, false});
}

std::shared_ptr<const ValueDescription> Keys::description() const {
  auto description = std::make_shared<ValueDescription>();
  description->kind = ValueDescription::Kind::table;
  description->table = description_;
  return description;
}

bool Keys::read_as_owner(const YAML::Node& node, const ValueDescription& due, Reading& reading,
                         const std::function<void()>& read) const {
  const std::string name = reading.take_name();
  if (!check_table(node, due, reading)) return false;
  const std::string owner = name.empty() ? description_->noun : description_->noun + " " + name;
  return reading.with_owner(owner, [&] {
    const std::size_t errors_before = reading.diagnostics().error_count();
    read();
    return reading.diagnostics().error_count() == errors_before;
  });
}

void Keys::read(const YAML::Node& node, Reading& reading, void* value) const {
  const Mark mark = reading.mark_of(node);
  const std::vector<Entry> entries =
      settle_unknown_keys(reading.entries_of(node), description_->key_names(), reading);
  for (const bool early : {true, false}) {
    for (const Entry& entry : entries) {
      if (is_early(entry.key) == early) read_entry(entry, reading, value);
    }
  }
  for (const Key& key : keys_) {
    if (!has_key(entries, key.description.name)) leave_out(key, mark, reading, value);
  }
}

bool Keys::is_early(const std::string& name) const {
  for (const Key& key : keys_) {
    if (key.description.name == name) return key.early;
  }
  return false;
}

void Keys::read_entry(const Entry& entry, Reading& reading, void* value) const {
  for (const Key& key : keys_) {
    if (key.description.name != entry.key) continue;
    const auto read = [&] {
      return key.read(*key.reader, key.member, entry.value, reading.mark_of(entry.value), reading,
                      value);
    };
    if (reading.has_value(entry, *key.description.value)) {
      reading.with_key(entry.key, read);
    } else if (may_be_unread(*key.description.value)) {
      // The member becomes that of a value which cannot be read, so that no rule misses the key as
      // well. What the reader says of it has been said.
      const Diagnostics told = reading.diagnostics();
      reading.with_key(entry.key, read);
      reading.diagnostics() = told;
    }
    return;
  }
}

void Keys::leave_out(const Key& key, const Mark& mark, Reading& reading, void* value) const {
  const KeyDescription& description = key.description;
  if (description.required) {
    reading.error(mark, reading.owner() + " lacks the key \"" + description.name + "\"",
                  {due_text(*description.value) + ": " + description.description});
  } else if (!description.default_text.empty()) {
    reading.with_key(description.name, [&] {
      return key.read(*key.reader, key.member, parse_default(description.default_text), mark,
                      reading, value);
    });
  }
}

}  // namespace blocklift::pipeline::table_detail

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/declaration/format.h"

namespace blocklift::pipeline {

namespace table_detail {

template <class M, class T>
void store(M& member, T value, const Mark& /*mark*/) {
  member = std::move(value);
}
template <class T>
void store(Located<T>& member, T value, const Mark& mark) {
  member = {std::move(value), mark};
}
template <class T>
void store(std::optional<Located<T>>& member, T value, const Mark& mark) {
  member = Located<T>{std::move(value), mark};
}

/// Parses a default as if it stood in the file. @throws std::logic_error if the declaration is wrong.
YAML::Node parse_default(const std::string& text);

}  // namespace table_detail

/// Declares the keys of a table, each once: name, format, whether required or its default, meaning.
///
/// The reader reads every key it knows into its member of T, complains about unknown, doubled and
/// missing keys, and then runs the rules that concern several keys. A member may be the value
/// itself, std::optional of it, Located, or both.
template <class T>
class Table {
 public:
  Table(std::string noun, std::string description) {
    description_->noun = std::move(noun);
    description_->description = std::move(description);
  }

  template <class U, class M, class C>
  Table& required(std::string name, M C::*member, Format<U> format, std::string meaning) {
    return add({std::move(name), format.description, true, {}, std::move(meaning)}, member, format);
  }

  /// A key that may be left out: the member keeps what T's own constructor gives it (std::nullopt).
  template <class U, class M, class C>
  Table& optional(std::string name, M C::*member, Format<U> format, std::string meaning) {
    return add({std::move(name), format.description, false, {}, std::move(meaning)}, member,
               format);
  }

  /// A key that may be left out and then has the value of `default_text`, written as in a file.
  template <class U, class M, class C>
  Table& by_default(std::string name, M C::*member, Format<U> format, std::string default_text,
                    std::string meaning) {
    return add(
        {std::move(name), format.description, false, std::move(default_text), std::move(meaning)},
        member, format);
  }

  /// The key declared last is read before all that are not early, wherever it stands in the file.
  Table& early() {
    keys_.back().early = true;
    return *this;
  }

  /// The member that takes the place of the table itself.
  Table& place(Mark T::*member) {
    place_ = member;
    return *this;
  }

  /// A rule over several keys; runs after all keys are read, even if some failed.
  Table& rule(std::function<void(const T&, Reading&, const Mark&)> check) {
    rules_.push_back(std::move(check));
    return *this;
  }

  Format<T> format() const {
    auto description = std::make_shared<ValueDescription>();
    description->kind = ValueDescription::Kind::table;
    description->table = description_;
    return {description, [*this, description](const YAML::Node& node, Reading& reading, T& value) {
              const std::string name = reading.take_name();
              if (!check_table(node, *description, reading)) return false;
              const std::string owner =
                  name.empty() ? description_->noun : description_->noun + " " + name;
              return reading.with_owner(owner, [&] { return read(node, reading, value); });
            }};
  }

 private:
  struct Key {
    KeyDescription description;
    std::function<bool(const YAML::Node&, const Mark&, Reading&, T&)> read;
    bool early = false;
  };

  template <class U, class M, class C>
  Table& add(KeyDescription description, M C::*member, Format<U> format) {
    description_->keys.push_back(description);
    keys_.push_back(
        {std::move(description),
         [member, format](const YAML::Node& node, const Mark& mark, Reading& reading, T& value) {
           U read{};
           const bool done = format.read(node, reading, read);
           table_detail::store(value.*member, std::move(read), mark);
           return done;
         },
         false});
    return *this;
  }

  bool read(const YAML::Node& node, Reading& reading, T& value) const {
    const Mark mark = reading.mark_of(node);
    const std::size_t errors_before = reading.diagnostics().error_count();
    if (place_) value.*place_ = mark;
    const std::vector<Entry> entries = reading.entries_of(node);
    for (const bool early : {true, false}) {
      for (const Entry& entry : entries) {
        if (is_early(entry.key) == early) read_entry(entry, reading, value);
      }
    }
    for (const Key& key : keys_) {
      bool given = false;
      for (const Entry& entry : entries) given |= entry.key == key.description.name;
      if (!given) leave_out(key, mark, reading, value);
    }
    for (const auto& rule : rules_) rule(value, reading, mark);
    return reading.diagnostics().error_count() == errors_before;
  }

  bool is_early(const std::string& name) const {
    for (const Key& key : keys_) {
      if (key.description.name == name) return key.early;
    }
    return false;
  }

  void read_entry(const Entry& entry, Reading& reading, T& value) const {
    for (const Key& key : keys_) {
      if (key.description.name != entry.key) continue;
      if (!reading.has_value(entry, *key.description.value)) return;
      reading.with_key(entry.key, [&] {
        return key.read(entry.value, reading.mark_of(entry.value), reading, value);
      });
      return;
    }
    reading.error(entry.mark, reading.owner() + " has no key \"" + entry.key + "\"",
                  {names_hint("its keys are", description_->key_names(), entry.key)});
  }

  void leave_out(const Key& key, const Mark& mark, Reading& reading, T& value) const {
    const KeyDescription& description = key.description;
    if (description.required) {
      reading.error(mark, reading.owner() + " lacks the key \"" + description.name + "\"",
                    {"it is " + description.value->phrase() + ": " + description.description});
    } else if (!description.default_text.empty()) {
      reading.with_key(description.name, [&] {
        return key.read(table_detail::parse_default(description.default_text), mark, reading,
                        value);
      });
    }
  }

  std::shared_ptr<TableDescription> description_ = std::make_shared<TableDescription>();
  std::vector<Key> keys_;
  std::vector<std::function<void(const T&, Reading&, const Mark&)>> rules_;
  Mark T::*place_ = nullptr;
};

}  // namespace blocklift::pipeline

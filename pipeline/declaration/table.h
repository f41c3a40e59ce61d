#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
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

/// A pointer to a member of any type, as bytes.
struct MemberBytes {
  std::array<std::byte, sizeof(std::ptrdiff_t)> bytes{};
};

/// Reads a value and stores it in a member of a table's type.
using ReadKey = bool (*)(const ErasedReader& reader, const MemberBytes& member,
                         const YAML::Node& node, const Mark& mark, Reading& reading, void* value);

template <class T, class U, class M, class C>
bool read_key(const ErasedReader& reader, const MemberBytes& member, const YAML::Node& node,
              const Mark& mark, Reading& reading, void* value) {
  M C::*place = nullptr;
  static_assert(sizeof place == sizeof member.bytes);
  std::memcpy(&place, member.bytes.data(), sizeof place);
  U read{};
  const bool done = reader.read(node, reading, &read);
  store(static_cast<T*>(value)->*place, std::move(read), mark);
  return done;
}

/// How a key is declared.
enum class Need { required, optional };

/// What a table knows without knowing the type that it reads.
class Keys {
 public:
  Keys(std::string noun, std::string description);

  struct Key {
    KeyDescription description;
    SharedReader reader;
    ReadKey read = nullptr;
    MemberBytes member;
    bool early = false;
  };
  void add(std::string_view name, std::shared_ptr<const ValueDescription> value, Need need,
           std::string_view default_text, std::string_view meaning, SharedReader reader,
           ReadKey read, const MemberBytes& member);
  void make_last_early() { keys_.back().early = true; }

  /// A table's description as a value.
  std::shared_ptr<const ValueDescription> description() const;
  /// Reads all keys into `value`, which is of the type that the keys' members belong to.
  void read(const YAML::Node& node, Reading& reading, void* value) const;
  /// Calls `read` with complaints in the name of this table; false after a complaint.
  bool read_as_owner(const YAML::Node& node, const ValueDescription& due, Reading& reading,
                     const std::function<void()>& read) const;

 private:
  bool is_early(const std::string& name) const;
  void read_entry(const Entry& entry, Reading& reading, void* value) const;
  void leave_out(const Key& key, const Mark& mark, Reading& reading, void* value) const;

  std::shared_ptr<TableDescription> description_;
  std::vector<Key> keys_;
};

}  // namespace table_detail

/// Declares the keys of a table, each once: name, format, whether required or its default, meaning.
///
/// The reader reads every key it knows into its member of T, complains about unknown, doubled and
/// missing keys, and then runs the rules that concern several keys. A member may be the value
/// itself, std::optional of it, Located, or both.
template <class T>
class Table {
 public:
  Table(std::string noun, std::string description)
      : keys_(std::move(noun), std::move(description)) {}

  template <class U, class M, class C>
  Table& required(std::string_view name, M C::*member, const Format<U>& format,
                  std::string_view meaning) {
    return add(name, member, format, table_detail::Need::required, {}, meaning);
  }

  /// A key that may be left out: the member keeps what T's own constructor gives it (std::nullopt).
  template <class U, class M, class C>
  Table& optional(std::string_view name, M C::*member, const Format<U>& format,
                  std::string_view meaning) {
    return add(name, member, format, table_detail::Need::optional, {}, meaning);
  }

  /// A key that may be left out and then has the value of `default_text`, written as in a file.
  template <class U, class M, class C>
  Table& by_default(std::string_view name, M C::*member, const Format<U>& format,
                    std::string_view default_text, std::string_view meaning) {
    return add(name, member, format, table_detail::Need::optional, default_text, meaning);
  }

  /// The key declared last is read before all that are not early, wherever it stands in the file.
  Table& early() {
    keys_.make_last_early();
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
    auto description = keys_.description();
    return {description, [*this, description](const YAML::Node& node, Reading& reading, T& value) {
              return keys_.read_as_owner(node, *description, reading, [&] {
                const Mark mark = reading.mark_of(node);
                if (place_) value.*place_ = mark;
                keys_.read(node, reading, &value);
                for (const auto& rule : rules_) rule(value, reading, mark);
              });
            }};
  }

 private:
  template <class U, class M, class C>
  Table& add(std::string_view name, M C::*member, const Format<U>& format, table_detail::Need need,
             std::string_view default_text, std::string_view meaning) {
    table_detail::MemberBytes bytes;
    std::memcpy(bytes.bytes.data(), &member, sizeof member);
    keys_.add(name, format.description, need, default_text, meaning, format.read.erased(),
              &table_detail::read_key<T, U, M, C>, bytes);
    return *this;
  }

  table_detail::Keys keys_;
  std::vector<std::function<void(const T&, Reading&, const Mark&)>> rules_;
  Mark T::*place_ = nullptr;
};

}  // namespace blocklift::pipeline

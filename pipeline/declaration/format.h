#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/description.h"
#include "pipeline/declaration/reading.h"

namespace blocklift::pipeline {

/// Reads a value of a type that only its maker knows. Formats are many and their types too: all
/// that tables do with readers stands once, in sources, for readers without types.
class ErasedReader {
 public:
  ErasedReader() = default;
  ErasedReader(const ErasedReader&) = delete;
  ErasedReader& operator=(const ErasedReader&) = delete;
  virtual ~ErasedReader();
  /// @param value the T that the reader was made for.
  virtual bool read(const YAML::Node& node, Reading& reading, void* value) const = 0;
};
using SharedReader = std::shared_ptr<const ErasedReader>;
SharedReader share(std::unique_ptr<const ErasedReader> reader);

/// Reads a value of type T from a node; false after a complaint. Copies share one reader.
template <class T>
class ValueReader {
 public:
  /// @param read callable with (const YAML::Node&, Reading&, T&), returns false after a complaint.
  template <class Read>
  ValueReader(Read read) : reader_(share(Owned(new Of<Read>(std::move(read))))) {}

  bool operator()(const YAML::Node& node, Reading& reading, T& value) const {
    return reader_->read(node, reading, &value);
  }
  const SharedReader& erased() const { return reader_; }

 private:
  // One type of pointer for all readers, which else is compiled for each of them.
  using Owned = std::unique_ptr<const ErasedReader>;

  template <class Read>
  class Of : public ErasedReader {
   public:
    explicit Of(Read read) : read_(std::move(read)) {}
    bool read(const YAML::Node& node, Reading& reading, void* value) const override {
      return read_(node, reading, *static_cast<T*>(value));
    }

   private:
    Read read_;
  };

  SharedReader reader_;
};

/// How a value of type T is written in a file: its description for people and its reader.
///
/// The reader returns false after a complaint; what could be read is then still in the value, so
/// that later checks find as much as possible. Formats are put together by the functions below, and
/// tables of keys by `Table`.
template <class T>
struct Format {
  std::shared_ptr<const ValueDescription> description;
  ValueReader<T> read;
};

/// A name with the value that the file gives to it.
template <class T>
struct Named {
  Located<std::string> name;
  T value{};
};

// Scalars.

Format<double> quantity(Dimension dimension, Range range = {});
/// A quantity of one of several dimensions, for what depends on a joint's kind.
Format<Quantity> quantity_of(std::vector<Dimension> dimensions, Range range = {});
Format<double> number(Range range = {});
Format<int> integer(Range range = {});
Format<bool> boolean();
Format<std::string> text();
/// A name that others refer to.
Format<std::string> name();
/// The name of something that is declared elsewhere.
Format<std::string> reference();
/// One of fixed words, as the index of the word.
Format<std::size_t> choice_index(std::vector<std::string> words);

/// Complains unless the text may be a name.
bool check_name(const Mark& mark, const std::string& text, Reading& reading);
/// Complains unless the node is a list of fewest to most items; `due` describes the whole list.
bool check_list(const YAML::Node& node, const ValueDescription& due, Reading& reading);
/// Complains unless the node is a mapping.
bool check_table(const YAML::Node& node, const ValueDescription& due, Reading& reading);

template <class E>
Format<E> choice(std::vector<std::pair<std::string, E>> words) {
  std::vector<std::string> texts;
  std::vector<E> values;
  for (auto& [word, value] : words) {
    texts.push_back(word);
    values.push_back(value);
  }
  Format<std::size_t> index = choice_index(texts);
  return {index.description, [index, values](const YAML::Node& node, Reading& reading, E& value) {
            std::size_t chosen = 0;
            if (!index.read(node, reading, chosen)) return false;
            value = values[chosen];
            return true;
          }};
}

// Values made of others.

/// The value together with its place.
template <class T>
Format<Located<T>> located(Format<T> format) {
  return {format.description,
          [format](const YAML::Node& node, Reading& reading, Located<T>& located_value) {
            located_value.mark = reading.mark_of(node);
            return format.read(node, reading, located_value.value);
          }};
}

/// The same text in the file, another type in the program.
template <class T, class U>
Format<U> converted(Format<T> format, std::function<U(T)> convert) {
  return {format.description,
          [format, convert](const YAML::Node& node, Reading& reading, U& value) {
            T raw{};
            const bool done = format.read(node, reading, raw);
            value = convert(std::move(raw));
            return done;
          }};
}

template <class T>
Format<std::vector<T>> list_of(Format<T> element, std::size_t fewest = 0,
                               std::size_t most = ValueDescription::unlimited) {
  auto description = std::make_shared<ValueDescription>();
  description->kind = ValueDescription::Kind::list;
  description->element = element.description;
  description->fewest = fewest;
  description->most = most;
  return {description,
          [element, description](const YAML::Node& node, Reading& reading, std::vector<T>& values) {
            if (!check_list(node, *description, reading)) return false;
            bool done = true;
            for (const YAML::Node& item : node) {
              if (!reading.count_value(item)) return false;
              T value{};
              done &= element.read(item, reading, value);
              values.push_back(std::move(value));
            }
            return done;
          }};
}

template <class T, std::size_t N>
Format<std::array<T, N>> array_of(Format<T> element) {
  Format<std::vector<T>> list = list_of(element, N, N);
  return {list.description,
          [list](const YAML::Node& node, Reading& reading, std::array<T, N>& values) {
            std::vector<T> items;
            const bool done = list.read(node, reading, items);
            for (std::size_t i = 0; i < std::min(N, items.size()); ++i) {
              values[i] = std::move(items[i]);
            }
            return done && items.size() == N;
          }};
}

/// Names, each with a value: `{name: value, ...}`, in the order of the file.
template <class T>
Format<std::vector<Named<T>>> names_to(Format<T> element) {
  auto description = std::make_shared<ValueDescription>();
  description->kind = ValueDescription::Kind::names_to;
  description->element = element.description;
  return {description, [element, description](const YAML::Node& node, Reading& reading,
                                              std::vector<Named<T>>& values) {
            if (!check_table(node, *description, reading)) return false;
            bool done = true;
            for (const Entry& entry : reading.entries_of(node)) {
              Named<T> named{{entry.key, entry.mark}, {}};
              reading.set_name(entry.key);
              done &= reading.has_value(entry, *element.description) &&
                      reading.with_key(entry.key, [&] {
                        return element.read(entry.value, reading, named.value);
                      });
              reading.take_name();
              values.push_back(std::move(named));
            }
            return done;
          }};
}

/// Names, each with a table; the name goes into the table's own member `name`.
template <class T>
Format<std::vector<T>> named_tables(Format<T> table) {
  Format<std::vector<Named<T>>> names = names_to(table);
  return {names.description,
          [names](const YAML::Node& node, Reading& reading, std::vector<T>& values) {
            std::vector<Named<T>> items;
            bool done = names.read(node, reading, items);
            for (Named<T>& item : items) {
              done &= check_name(item.name.mark, item.name.value, reading);
              item.value.name = item.name;
              values.push_back(std::move(item.value));
            }
            return done;
          }};
}

/// Up to three ways to write a value, told apart by the kind of YAML node. An absent way is
/// refused.
template <class T>
Format<T> by_shape(std::optional<Format<T>> scalar, std::optional<Format<T>> list,
                   std::optional<Format<T>> table) {
  auto description = std::make_shared<ValueDescription>();
  description->kind = ValueDescription::Kind::any_of;
  for (const auto* way : {&scalar, &list, &table}) {
    if (*way) description->alternatives.push_back((*way)->description);
  }
  return {description, [=](const YAML::Node& node, Reading& reading, T& value) {
            const std::optional<Format<T>>& way =
                node.IsMap() ? table : (node.IsSequence() ? list : scalar);
            if (way && !node.IsNull()) return way->read(node, reading, value);
            std::string ignored;
            return reading.scalar_text(node.IsScalar() ? YAML::Node() : node, *description,
                                       ignored);
          }};
}

}  // namespace blocklift::pipeline

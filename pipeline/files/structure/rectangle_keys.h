#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {

/// Lower and upper end along an axis, m.
using Extent = std::optional<Located<std::array<double, 2>>>;

/// Names of axes with their numbers, as a file writes them.
using Axes = std::vector<std::pair<std::string, std::size_t>>;
inline const Axes block_axes = {{"x", 0}, {"y", 1}, {"z", 2}};
inline const Axes plate_axes = {{"u", 0}, {"v", 1}, {"n", 2}};  ///< of a plate by its corners

/// An extent: [lower end, upper end].
Format<std::array<double, 2>> extent_format();

/// What keys of extents mean.
inline constexpr const char* extent_meaning = "lower and upper end; left out along the normal";

/// A rectangle as the file writes it, its extents under three keys of their own.
template <class T>
struct Written : T {
  Extent x, y, z;
  T taken() const {
    T value = *this;
    value.extent = {x, y, z};
    return value;
  }
};

template <class T>
Table<Written<T>>& extent_keys(Table<Written<T>>& table) {
  const std::string meaning = extent_meaning;
  return table.optional("x", &Written<T>::x, extent_format(), meaning)
      .optional("y", &Written<T>::y, extent_format(), meaning)
      .optional("z", &Written<T>::z, extent_format(), meaning);
}

template <class T>
Format<T> taken(const Table<Written<T>>& table) {
  return converted<Written<T>, T>(table.format(), [](const Written<T>& w) { return w.taken(); });
}

/// Complains unless the extents across the normal are given, and the one along it is not.
void check_extents(const std::array<Extent, 3>& extent, std::size_t normal, const Axes& names,
                   Reading& reading, const Mark& mark);

template <class T>
void check_rectangle(const Written<T>& written, const Axes& names, Reading& reading,
                     const Mark& mark) {
  check_extents({written.x, written.y, written.z}, written.normal, names, reading, mark);
}

/// Does a table give extents in the frame of a plate by its corners?
bool has_plate_axes(const YAML::Node& node);

/// One of several tables, told apart by their keys.
template <class T>
Format<T> one_of_tables(const std::vector<Format<T>>& formats,
                        const std::function<std::size_t(const YAML::Node&)>& which) {
  auto description = std::make_shared<ValueDescription>();
  description->kind = ValueDescription::Kind::any_of;
  for (const Format<T>& format : formats) description->alternatives.push_back(format.description);
  return {description, [formats, which](const YAML::Node& node, Reading& reading, T& value) {
            return formats[node.IsMap() ? which(node) : 0].read(node, reading, value);
          }};
}

}  // namespace blocklift::pipeline

#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/quantity.h"

namespace blocklift::pipeline {

/// The values that a number may take, in SI units.
struct Range {
  std::optional<double> lower;
  bool lower_allowed = true;
  std::optional<double> upper;
  bool upper_allowed = true;

  static Range any() { return {}; }
  static Range positive() { return {0.0, false, std::nullopt, true}; }
  static Range not_negative() { return {0.0, true, std::nullopt, true}; }
  static Range at_least(double lower) { return {lower, true, std::nullopt, true}; }
  static Range between(double lower, double upper) { return {lower, true, upper, true}; }
  static Range inside(double lower, double upper) { return {lower, false, upper, false}; }

  bool is_unlimited() const { return !lower && !upper; }
  bool contains(double value) const;
  /// "greater than 0", "from 0 to 0.5"; empty for any value.
  std::string text(Dimension dimension) const;
};

struct TableDescription;

/// What may stand at one place of an input file: the one source of reader, schema and manual.
struct ValueDescription {
  enum class Kind {
    quantity,  ///< a number with a unit of one of `dimensions`
    measure,   ///< a number with any unit, or none
    number,    ///< a plain number
    integer,
    boolean,
    text,
    name,       ///< a name that others refer to: letters, digits, _ and -
    reference,  ///< the name of something else, parts joined by points: "C1.upper_1"
    choice,     ///< one of `choices`
    list,       ///< `fewest` to `most` of `element`
    names_to,   ///< names, each with one `element`
    table,      ///< the keys of `table`
    any_of,     ///< one of `alternatives`, told apart by being a scalar, a list or a table
  };
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  Kind kind = Kind::text;
  std::vector<Dimension> dimensions;
  Range range;
  std::vector<std::string> choices;
  std::size_t fewest = 0;
  std::size_t most = unlimited;
  std::shared_ptr<const ValueDescription> element;
  std::shared_ptr<const TableDescription> table;
  std::vector<std::shared_ptr<const ValueDescription>> alternatives;

  /// "a length", "a list of 3 lengths", "a table with the keys of a body".
  std::string phrase() const;
};

/// One key of a table, as declared.
struct KeyDescription {
  std::string name;
  std::shared_ptr<const ValueDescription> value;
  bool required = false;
  std::string default_text;  ///< as one would write it in the file; empty if there is none
  std::string description;
};

/// A table (a YAML mapping with fixed keys), as declared.
struct TableDescription {
  std::string noun;         ///< "body": what one such table describes
  std::string description;  ///< a sentence or two for the manual
  std::vector<KeyDescription> keys;

  std::vector<std::string> key_names() const;
};

}  // namespace blocklift::pipeline

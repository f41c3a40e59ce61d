#include "pipeline/declaration/format.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace blocklift::pipeline {
namespace {

using Kind = ValueDescription::Kind;

std::shared_ptr<ValueDescription> describe(Kind kind, Range range = {}) {
  auto description = std::make_shared<ValueDescription>();
  description->kind = kind;
  description->range = range;
  return description;
}

/// Complains about a number outside its range: `mass "-3 t" must be greater than 0`.
bool check_range(const YAML::Node& node, const Range& range, const Quantity& found,
                 Reading& reading) {
  if (range.contains(found.value)) return true;
  reading.error(node, fmt::format("{} \"{}\" must be {}", reading.key(), node.Scalar(),
                                  range.text(found.dimension)));
  return false;
}

/// A number with its unit, or the result of an expression.
/// @returns nothing after a complaint.
std::optional<Quantity> read_quantity(const YAML::Node& node, const std::string& written,
                                      const std::vector<Dimension>& dimensions, Reading& reading) {
  try {
    if (is_expression(written)) {
      return evaluate_expression(written, reading.parameters(), dimensions);
    }
    return parse_quantity(written, dimensions);
  } catch (const UnreadParameter&) {
    reading.pass_over_value();
    return std::nullopt;
  } catch (const ExpressionError& error) {
    reading.error(node, fmt::format("{} {}", reading.key(), error.what()), error.hints());
  } catch (const QuantityError& error) {
    reading.error(node, fmt::format("{} {}", reading.key(), error.what()));
  }
  return std::nullopt;
}

Format<std::string> word_format(Kind kind) {
  auto description = describe(kind);
  return {description, [description](const YAML::Node& node, Reading& reading, std::string& value) {
            return reading.scalar_text(node, *description, value);
          }};
}

}  // namespace

ErasedReader::~ErasedReader() = default;

SharedReader share(std::unique_ptr<const ErasedReader> reader) { return reader; }

Format<Quantity> quantity_of(std::vector<Dimension> dimensions, Range range) {
  auto description = describe(Kind::quantity, range);
  description->dimensions = std::move(dimensions);
  return {description, [description](const YAML::Node& node, Reading& reading, Quantity& value) {
            std::string written;
            if (!reading.scalar_text(node, *description, written)) return false;
            const auto found = read_quantity(node, written, description->dimensions, reading);
            if (!found) return false;
            value = *found;
            return check_range(node, description->range, value, reading);
          }};
}

Format<double> quantity(Dimension dimension, Range range) {
  Format<Quantity> general = quantity_of({dimension}, range);
  return {general.description, [general](const YAML::Node& node, Reading& reading, double& value) {
            Quantity found{std::nan(""), Dimension::ratio};
            const bool done = general.read(node, reading, found);
            value = done ? found.value : std::nan("");
            return done;
          }};
}

Format<double> number(Range range) {
  auto description = describe(Kind::number, range);
  return {description, [description](const YAML::Node& node, Reading& reading, double& value) {
            std::string written;
            value = std::nan("");
            if (!reading.scalar_text(node, *description, written)) return false;
            if (is_expression(written)) {
              const auto found = read_quantity(node, written, {Dimension::ratio}, reading);
              if (!found || !check_range(node, description->range, *found, reading)) return false;
              value = found->value;
              return true;
            }
            try {
              const double found = parse_number(written);
              if (!check_range(node, description->range, {found, Dimension::ratio}, reading)) {
                return false;
              }
              value = found;
            } catch (const QuantityError& error) {
              reading.error(node, fmt::format("{} {}", reading.key(), error.what()));
              return false;
            }
            return true;
          }};
}

Format<int> integer(Range range) {
  auto description = describe(Kind::integer, range);
  return {description, [description](const YAML::Node& node, Reading& reading, int& value) {
            std::string written;
            if (!reading.scalar_text(node, *description, written)) return false;
            int found = 0;
            if (!YAML::convert<int>::decode(node, found)) {
              reading.error(node,
                            fmt::format("{} \"{}\" is no whole number", reading.key(), written));
              return false;
            }
            if (!check_range(node, description->range,
                             {static_cast<double>(found), Dimension::ratio}, reading)) {
              return false;
            }
            value = found;
            return true;
          }};
}

Format<bool> boolean() {
  auto description = describe(Kind::boolean);
  return {description, [description](const YAML::Node& node, Reading& reading, bool& value) {
            std::string written;
            if (!reading.scalar_text(node, *description, written)) return false;
            if (written != "true" && written != "false") {
              reading.error(node,
                            fmt::format("{} \"{}\" must be true or false", reading.key(), written));
              return false;
            }
            value = written == "true";
            return true;
          }};
}

Format<std::string> text() { return word_format(Kind::text); }

Format<std::string> reference() { return word_format(Kind::reference); }

Format<std::string> name() {
  Format<std::string> word = word_format(Kind::name);
  return {word.description, [word](const YAML::Node& node, Reading& reading, std::string& value) {
            return word.read(node, reading, value) &&
                   check_name(reading.mark_of(node), value, reading);
          }};
}

Format<std::size_t> choice_index(std::vector<std::string> words) {
  auto description = describe(Kind::choice);
  description->choices = std::move(words);
  return {description, [description](const YAML::Node& node, Reading& reading, std::size_t& value) {
            std::string written;
            if (!reading.scalar_text(node, *description, written)) return false;
            const auto& choices = description->choices;
            const auto found = std::find(choices.begin(), choices.end(), written);
            if (found == choices.end()) {
              reading.error(node, fmt::format("{} \"{}\" does not exist", reading.key(), written),
                            {names_hint("it must be one of", choices, written)});
              return false;
            }
            value = static_cast<std::size_t>(found - choices.begin());
            return true;
          }};
}

bool check_name(const Mark& mark, const std::string& text, Reading& reading) {
  const bool allowed = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
  if (allowed) return true;
  reading.error(mark, fmt::format("\"{}\" cannot be a name", text),
                {"names have letters (a to z, A to Z), digits, _ and - only"});
  return false;
}

namespace {

/// Of too many items [-4,5 m, 3 m]: what stands before a comma is a number without its unit, unless
/// the comma was meant for decimals.
std::vector<std::string> decimal_comma_hints(const YAML::Node& node, const ValueDescription& due) {
  if (node.size() <= due.most || due.element->kind != ValueDescription::Kind::quantity) return {};
  for (const YAML::Node& item : node) {
    if (!item.IsScalar() || item.Scalar().empty()) continue;
    if (item.Scalar().find_first_not_of("+-0123456789") == std::string::npos)
      return {"decimals take a point (1.5): a comma begins the next item"};
  }
  return {};
}

}  // namespace

bool check_list(const YAML::Node& node, const ValueDescription& due, Reading& reading) {
  if (!node.IsSequence()) {
    const std::string found = node.IsNull()     ? "has no value"
                              : node.IsScalar() ? fmt::format("\"{}\" is no list", node.Scalar())
                                                : "is a table of keys";
    reading.error(node, fmt::format("{} {}; {} is due", reading.key(), found, due.phrase()));
    return false;
  }
  if (node.size() >= due.fewest && node.size() <= due.most) return true;
  const std::string number = due.fewest == due.most     ? fmt::format("{}", due.most)
                             : node.size() < due.fewest ? fmt::format("at least {}", due.fewest)
                                                        : fmt::format("at most {}", due.most);
  reading.error(node,
                fmt::format("{} has {} item{}; {} are due, each {}", reading.key(), node.size(),
                            node.size() == 1 ? "" : "s", number, due.element->phrase()),
                decimal_comma_hints(node, due));
  return false;
}

bool check_table(const YAML::Node& node, const ValueDescription& due, Reading& reading) {
  if (node.IsMap()) return true;
  const std::string found = node.IsNull()     ? "has no value"
                            : node.IsScalar() ? fmt::format("is \"{}\"", node.Scalar())
                                              : "is a list";
  const std::string subject = reading.key().empty() ? reading.owner() : reading.key();
  reading.error(node, fmt::format("{} {}; {} are due", subject, found, due.phrase()));
  return false;
}

}  // namespace blocklift::pipeline

#include "pipeline/declaration/parameters_format.h"

#include <optional>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

std::optional<Measure> read_measure(const YAML::Node& node, const std::string& written,
                                    Reading& reading) {
  try {
    return is_expression(written) ? evaluate_expression(written, reading.parameters())
                                  : parse_measure(written);
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

/// The value that counts: that of the file, or one from outside, which must be of the same
/// dimension.
Measure chosen_value(const std::string& name, const Measure& own, Reading& reading) {
  for (const OutsideParameter& outside : reading.outside_parameters()) {
    if (outside.name != name) continue;
    if (outside.value.exponents == own.exponents) return outside.value;
    reading.error(outside.mark,
                  fmt::format("the parameter {} is given as {}, where the model has {}", name,
                              text_of(outside.value.exponents), text_of(own.exponents)));
  }
  return own;
}

}  // namespace

Format<Measure> measure() {
  auto description = std::make_shared<ValueDescription>();
  description->kind = ValueDescription::Kind::measure;
  return {description, [description](const YAML::Node& node, Reading& reading, Measure& value) {
            std::string written;
            if (!reading.scalar_text(node, *description, written)) return false;
            const auto found = read_measure(node, written, reading);
            if (found) value = *found;
            return found.has_value();
          }};
}

Format<ParameterValues> parameters_format() {
  const auto values = names_to(located(measure()));
  return {values.description,
          [values](const YAML::Node& node, Reading& reading, ParameterValues& parameters) {
            if (!check_table(node, *values.description, reading)) return false;
            const auto value_format = located(measure());
            bool done = true;
            for (const Entry& entry : reading.entries_of(node)) {
              Named<Located<Measure>> parameter{{entry.key, entry.mark}, {}};
              if (!is_parameter_name(entry.key)) {
                reading.error(entry.mark, fmt::format("\"{}\" cannot be a parameter", entry.key),
                              {"a parameter's name begins with a letter, has letters, digits and _ "
                               "only, and is no function, unit or constant"});
                done = false;
                continue;
              }
              const bool read = reading.has_value(entry, *value_format.description) &&
                                reading.with_key(entry.key, [&] {
                                  return value_format.read(entry.value, reading, parameter.value);
                                });
              done &= read;
              // One that could not be read is known all the same: it has been complained about.
              parameter.value.value = chosen_value(entry.key, parameter.value.value, reading);
              reading.parameters().set(entry.key, parameter.value.value);
              parameters.push_back(std::move(parameter));
            }
            return done;
          }};
}

Format<ParameterValues> parameter_overrides_format() { return names_to(located(measure())); }

}  // namespace blocklift::pipeline

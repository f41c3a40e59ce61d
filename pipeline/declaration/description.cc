#include "pipeline/declaration/description.h"

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

std::string with_article(const std::string& noun) {
  if (noun.ends_with('s')) return noun;  // settings, loads
  const bool vowel = std::string("aeiou").find(noun.empty() ? 'x' : noun[0]) != std::string::npos;
  return (vowel ? "an " : "a ") + noun;
}

std::string limit_text(double value, Dimension dimension) {
  return value == 0 ? "0" : format_quantity(value, dimension);
}

}  // namespace

bool Range::contains(double value) const {
  if (lower && (lower_allowed ? value < *lower : value <= *lower)) return false;
  if (upper && (upper_allowed ? value > *upper : value >= *upper)) return false;
  return true;
}

std::string Range::text(Dimension dimension) const {
  if (lower && upper) {
    return fmt::format("{} {} {} {}", lower_allowed && upper_allowed ? "from" : "between",
                       limit_text(*lower, dimension), lower_allowed && upper_allowed ? "to" : "and",
                       limit_text(*upper, dimension));
  }
  if (lower) {
    return fmt::format("{} {}", lower_allowed ? "at least" : "greater than",
                       limit_text(*lower, dimension));
  }
  if (upper) {
    return fmt::format("{} {}", upper_allowed ? "at most" : "less than",
                       limit_text(*upper, dimension));
  }
  return {};
}

std::string ValueDescription::phrase() const {
  switch (kind) {
    case Kind::quantity:
      return nouns_of(dimensions);
    case Kind::measure:
      return "a number with its unit";
    case Kind::number:
      return "a plain number";
    case Kind::integer:
      return "a whole number";
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "a text";
    case Kind::name:
    case Kind::reference:
      return "a name";
    case Kind::choice: {
      std::string all;
      for (std::size_t i = 0; i < choices.size(); ++i) {
        if (i > 0) all += i + 1 == choices.size() ? " or " : ", ";
        all += choices[i];
      }
      return all;
    }
    case Kind::list:
      if (fewest == most)
        return fmt::format("a list of {} items, each {}", most, element->phrase());
      return fmt::format("a list, each item {}", element->phrase());
    case Kind::names_to:
      return fmt::format("names, each with {}", element->phrase());
    case Kind::table:
      return fmt::format("the keys of {}", with_article(table->noun));
    case Kind::any_of: {
      std::string all;
      for (std::size_t i = 0; i < alternatives.size(); ++i) {
        if (i > 0) all += ", or ";
        all += alternatives[i]->phrase();
      }
      return all;
    }
  }
  return {};
}

std::vector<std::string> TableDescription::key_names() const {
  std::vector<std::string> names;
  for (const KeyDescription& key : keys) names.push_back(key.name);
  return names;
}

}  // namespace blocklift::pipeline

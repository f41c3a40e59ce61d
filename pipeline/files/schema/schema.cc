#include "pipeline/files/schema/schema.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/files/crane/crane_model.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/mechanism/mechanism_file.h"
#include "pipeline/files/rigging/rigging_stock.h"
#include "pipeline/files/rigging/rope_model.h"
#include "pipeline/files/standard/standard_rules.h"
#include "pipeline/files/structure/block_model.h"
#include "pipeline/files/structure/part_file.h"
#include "pipeline/files/study/study_file.h"
#include "pipeline/files/vessel/vessel_group.h"
#include "pipeline/files/vessel/vessel_model.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ValueDescription::Kind;
using TablePointer = std::shared_ptr<const TableDescription>;

/// One kind of file with the declaration of its keys.
struct DeclaredKind {
  std::string name;
  TablePointer table;
};

std::vector<DeclaredKind> file_kinds() {
  return {{"lift case", lift_case_format().description->table},
          {"mechanism", mechanism_file_format().description->table},
          {"crane", crane_model_format().description->table},
          {"block", block_model_format().description->table},
          {"rope", rope_model_format().description->table},
          {"part", part_file_format().description->table},
          {"vessel", vessel_model_format().description->table},
          {"vessels", vessel_group_format().description->table},
          {"standard", standard_rules_format().description->table},
          {"rigging", rigging_stock_format().description->table},
          {"study", study_file_format().description->table}};
}

std::vector<DeclaredKind> chosen_kinds(const std::string& kind) {
  std::vector<DeclaredKind> kinds = file_kinds();
  if (kind.empty()) return kinds;
  std::erase_if(kinds, [&](const DeclaredKind& candidate) { return candidate.name != kind; });
  if (kinds.empty()) {
    throw std::invalid_argument(fmt::format("there is no kind of input file \"{}\"; {}", kind,
                                            names_hint("the kinds are", input_file_kinds(), kind)));
  }
  return kinds;
}

Json schema_of(const ValueDescription& value);

Json schema_of(const TableDescription& table) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const KeyDescription& key : table.keys) {
    Json property = schema_of(*key.value);
    property["description"] = key.description;
    if (!key.default_text.empty()) property["$comment"] = "default: " + key.default_text;
    properties[key.name] = std::move(property);
    if (key.required) required.push_back(key.name);
  }
  // YAML's merge key takes keys from an anchor; the schema sees it as one more key.
  Json schema = {{"type", "object"}, {"description", table.description}};
  schema["properties"] = std::move(properties);
  if (!required.empty()) schema["required"] = std::move(required);
  schema["additionalProperties"] = false;
  return schema;
}

Json schema_of_number(const ValueDescription& value, const char* type) {
  Json schema = {{"type", type}};
  const Range& range = value.range;
  if (range.lower) schema[range.lower_allowed ? "minimum" : "exclusiveMinimum"] = *range.lower;
  if (range.upper) schema[range.upper_allowed ? "maximum" : "exclusiveMaximum"] = *range.upper;
  return schema;
}

Json schema_of_quantity(const ValueDescription& value) {
  Json examples = Json::array();
  bool plain = false;
  for (const Dimension dimension : value.dimensions) {
    examples.push_back(text_of(dimension).example);
    plain |= dimension == Dimension::ratio;
  }
  Json schema;
  if (plain) {
    schema["type"] = {"number", "string"};
  } else {
    schema["type"] = "string";
    schema["pattern"] = "^ *=|^ *[-+]?[0-9]*\\.?[0-9]+([eE][-+]?[0-9]+)? *[^-+.,0-9 ]";
  }
  schema["examples"] = std::move(examples);
  return schema;
}

Json schema_of(const ValueDescription& value) {
  switch (value.kind) {
    case Kind::quantity:
      return schema_of_quantity(value);
    case Kind::measure:
      return {{"type", {"number", "string"}}};
    case Kind::number: {
      Json schema = schema_of_number(value, "number");
      schema["type"] = {"number", "string"};
      schema["pattern"] = "^ *=";  // an expression, or the number in quotes
      return schema;
    }
    case Kind::integer:
      return schema_of_number(value, "integer");
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::text:
    case Kind::reference:
      return {{"type", "string"}};
    case Kind::name:
      return {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]+$"}};
    case Kind::choice:
      return {{"enum", value.choices}};
    case Kind::list: {
      Json schema = {{"type", "array"}, {"items", schema_of(*value.element)}};
      if (value.fewest > 0) schema["minItems"] = value.fewest;
      if (value.most != ValueDescription::unlimited) schema["maxItems"] = value.most;
      return schema;
    }
    case Kind::names_to:
      return {{"type", "object"}, {"additionalProperties", schema_of(*value.element)}};
    case Kind::table:
      return schema_of(*value.table);
    case Kind::any_of: {
      Json alternatives = Json::array();
      for (const auto& alternative : value.alternatives) {
        alternatives.push_back(schema_of(*alternative));
      }
      return {{"anyOf", std::move(alternatives)}};
    }
  }
  return {};
}

/// Tables within a value, in the order in which one meets them.
void collect_tables(const ValueDescription& value, std::vector<TablePointer>& tables) {
  if (value.element) collect_tables(*value.element, tables);
  for (const auto& alternative : value.alternatives) collect_tables(*alternative, tables);
  if (value.table) tables.push_back(value.table);
}

/// A table cell must not hold the column separator.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

std::string examples_of(const ValueDescription& value) {
  if (value.kind != Kind::quantity) return {};
  std::string examples;
  for (const Dimension dimension : value.dimensions) {
    examples += fmt::format("{}`{}`", examples.empty() ? "" : " or ", text_of(dimension).example);
  }
  return ", as " + examples;
}

std::string range_of(const ValueDescription& value) {
  const Dimension dimension =
      value.dimensions.empty() ? Dimension::ratio : value.dimensions.front();
  const std::string range = value.range.text(dimension);
  return range.empty() ? std::string() : ", " + range;
}

void describe_table(const TableDescription& table, int level, std::string& manual) {
  manual += fmt::format("{} {}\n\n{}\n\n", std::string(static_cast<std::size_t>(level), '#'),
                        table.noun, table.description);
  manual += "| key | value | default | meaning |\n|---|---|---|---|\n";
  std::vector<TablePointer> inner;
  for (const KeyDescription& key : table.keys) {
    const ValueDescription& value = *key.value;
    const std::string default_text = key.required               ? "required"
                                     : key.default_text.empty() ? ""
                                                                : "`" + key.default_text + "`";
    manual += fmt::format("| `{}` | {} | {} | {} |\n", key.name,
                          cell(value.phrase() + examples_of(value) + range_of(value)),
                          cell(default_text), cell(key.description));
    collect_tables(value, inner);
  }
  manual += "\n";
  for (const TablePointer& table_inside : inner)
    describe_table(*table_inside, std::min(level + 1, 6), manual);
}

}  // namespace

std::vector<std::string> input_file_kinds() {
  std::vector<std::string> names;
  for (const DeclaredKind& kind : file_kinds()) names.push_back(kind.name);
  return names;
}

std::string json_schema(const std::string& kind) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Blocklift input files"}};
  const std::vector<DeclaredKind> kinds = chosen_kinds(kind);
  if (kinds.size() == 1) {
    schema["title"] = "Blocklift " + kinds.front().name;
    schema.update(schema_of(*kinds.front().table));
  } else {
    Json alternatives = Json::array();
    for (const DeclaredKind& file_kind : kinds) {
      Json alternative = schema_of(*file_kind.table);
      alternative["title"] = file_kind.name;
      alternatives.push_back(std::move(alternative));
    }
    schema["anyOf"] = std::move(alternatives);
  }
  return schema.dump(2) + "\n";
}

std::string markdown_manual(const std::string& kind) {
  std::string manual =
      "# Input files\n\n"
      "All input files are YAML. A number that measures something is written with its unit "
      "(`860 t`, `12 m`, `3 m/min`, `45 deg`); units are those of UDUNITS-2, and `t` is the tonne "
      "of 1000 kg. Names have letters, digits, `_` and `-`. Unknown keys are errors. "
      "In place of a quantity or number an expression may stand behind an equals sign, of "
      "parameters "
      "where the file has them: `= 2 * arm + 30 cm`.\n\n";
  for (const DeclaredKind& file_kind : chosen_kinds(kind))
    describe_table(*file_kind.table, 2, manual);
  return manual;
}

}  // namespace blocklift::pipeline

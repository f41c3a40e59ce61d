#include "pipeline/report/input_values.h"

#include <algorithm>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace blocklift::pipeline {
namespace {

bool is_plain_list(const YAML::Node& node) {
  return node.IsSequence() && std::all_of(node.begin(), node.end(), [](const YAML::Node& entry) {
           return entry.IsScalar() || entry.IsNull() || is_plain_list(entry);
         });
}

std::string plain_text(const YAML::Node& node) {
  if (node.IsNull()) return "";
  if (node.IsScalar()) return node.Scalar();
  std::string text;
  for (const YAML::Node& entry : node) text += (text.empty() ? "" : ", ") + plain_text(entry);
  return "[" + text + "]";
}

void collect(const YAML::Node& node, const std::string& key, std::vector<InputValue>& values) {
  if (node.IsMap() && node.size() > 0) {
    for (const auto& entry : node)
      collect(entry.second, key.empty() ? entry.first.Scalar() : key + "." + entry.first.Scalar(),
              values);
  } else if (node.IsSequence() && !is_plain_list(node)) {
    std::size_t place = 0;
    for (const YAML::Node& entry : node)
      collect(entry, fmt::format("{}[{}]", key, ++place), values);
  } else {
    values.push_back({key, node.IsMap() ? "{}" : plain_text(node)});
  }
}

}  // namespace

std::vector<InputValue> list_input_values(const std::string& yaml) {
  std::vector<InputValue> values;
  try {
    const YAML::Node node = YAML::Load(yaml);
    if (node.IsMap()) collect(node, "", values);
  } catch (const YAML::Exception&) {
    values.clear();
  }
  return values;
}

}  // namespace blocklift::pipeline

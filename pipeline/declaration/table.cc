#include "pipeline/declaration/table.h"

#include <stdexcept>

#include <yaml-cpp/yaml.h>

namespace blocklift::pipeline::table_detail {

YAML::Node parse_default(const std::string& text) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& exception) {
    throw std::logic_error("the declared default \"" + text + "\" is not YAML: " + exception.msg);
  }
}

}  // namespace blocklift::pipeline::table_detail

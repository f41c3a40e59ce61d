#include "pipeline/study/design/block_variables.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "pipeline/study/design/study_design.h"

namespace blocklift::pipeline {
namespace {

/// Does a key of a study change a block's stiffness, or only its mass or nothing of it?
bool changes_block(const std::string& key, const std::string& block) {
  const std::size_t colon = key.find(':');
  const std::string_view inside =
      colon == std::string::npos ? std::string_view(key) : std::string_view(key).substr(colon + 1);
  if (colon == std::string::npos)
    return inside.starts_with("structure") || inside.starts_with("load.model");
  if (std::string_view(key).substr(0, colon) != block) return false;
  return inside != "mass" && !inside.starts_with("centre_of_mass");
}

}  // namespace

std::vector<int> find_block_variables(const StudyFile& study, const std::string& block) {
  std::vector<int> changing;
  for (std::size_t v = 0; v < study.variables.size(); ++v)
    if (std::ranges::any_of(study.variables[v].keys, [&](const Located<std::string>& key) {
          return changes_block(key.value, block);
        }))
      changing.push_back(static_cast<int>(v));
  return changing;
}

std::string block_key(const StudyFile& study, const std::vector<int>& block_variables,
                      const Eigen::VectorXd& values, const std::vector<int>* only) {
  std::string key;
  for (const int v : block_variables) {
    if (!only || std::ranges::find(*only, v) != only->end())
      key += value_text(study.variables[v], values[v]);
    key += "\n";
  }
  return key;
}

}  // namespace blocklift::pipeline

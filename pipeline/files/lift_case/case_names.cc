#include "pipeline/files/lift_case/case_names.h"

#include <filesystem>

namespace blocklift::pipeline {

std::string short_name(const std::string& model_name) {
  return std::filesystem::path(model_name).stem().string();
}

std::vector<std::string> parts_of(const given::Crane& crane, bool with_bodies) {
  std::vector<std::string> parts;
  for (const HoistModel& hoist : crane.model->hoists) {
    parts.push_back(crane.name.value + "." + hoist.name.value);
  }
  if (with_bodies) {
    for (const BodyModel& body : crane.model->bodies) {
      parts.push_back(crane.name.value + "." + body.name.value);
    }
  }
  return parts;
}

std::string before_dot(const std::string& name) { return name.substr(0, name.find('.')); }

std::vector<std::string> names_of_ropes(const LiftCase& lift_case) {
  std::vector<std::string> ropes;
  for (const given::Rope& rope : lift_case.ropes) ropes.push_back(rope.name.value);
  for (const given::Crane& crane : lift_case.cranes) {
    if (!crane.model) return {};
    for (const HoistModel& hoist : crane.model->hoists)
      ropes.push_back(crane.name.value + "." + hoist.name.value);
  }
  return ropes;
}

}  // namespace blocklift::pipeline

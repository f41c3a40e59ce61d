#include "structure/mesh/files/abaqus/temperatures.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace blocklift::structure {

namespace {

/// Whether sections give their temperatures by values at points of them, in place of slopes.
bool has_values_at_points(const AbaqusModel& model) {
  for (const AbaqusScope& scope : model.scopes)
    for (const AbaqusBlock* block : scope.blocks) {
      const std::string by = block->value("TEMPERATURE");
      const bool is_of_shells =
          block->name == "SHELL SECTION" || block->name == "SHELL GENERAL SECTION";
      const bool is_of_beams =
          block->name == "BEAM SECTION" || block->name == "BEAM GENERAL SECTION";
      if ((is_of_shells && !by.empty()) || (is_of_beams && by == "VALUES")) return true;
    }
  return false;
}

}  // namespace

AbaqusTemperatures read_initial_temperatures(AbaqusModel& model) {
  AbaqusTemperatures initial;
  for (const AbaqusScope& scope : model.scopes)
    for (const AbaqusBlock* block : scope.blocks) {
      if (block->name != "INITIAL CONDITIONS") continue;
      if (block->value("TYPE") == "TEMPERATURE")
        model.guarded(*block, [&] { add_temperatures(model, scope, *block, initial); });
      else
        model.log.leave_out("*INITIAL CONDITIONS", "conditions other than temperatures");
    }
  return initial;
}

// *TEMPERATURE / node or set, temperature, slope along a shell's normal or n2, slope along n1
void add_temperatures(AbaqusModel& model, const AbaqusScope& scope, const AbaqusBlock& block,
                      AbaqusTemperatures& temperatures) {
  const auto hinder = [&](const std::string& why) {
    if (temperatures.obstacle.empty())
      temperatures.obstacle =
          fmt::format("*{} at {} {}", block.name, model.log.place(block.line), why);
  };
  if (block.has("USER") || block.has("FILE"))
    hinder("has its values elsewhere (USER, FILE); values at nodes are read");
  const bool is_by_points = has_values_at_points(model);
  model.for_lines(block, [&](const std::vector<std::string_view>& fields) {
    if (fields.size() < 2) throw CardError{"node and temperature are due"};
    Vector3 value(abaqus_real(fields, 1, "temperature"), abaqus_real(fields, 2, "slope", 0.0),
                  abaqus_real(fields, 3, "slope", 0.0));
    if (fields.size() > 4 || (is_by_points && fields.size() > 2))
      hinder(
          "has values at points of the section (TEMPERATURE of its section); a value and its "
          "slopes are known");
    value.tail<2>() /= model.units.length;
    for (const int node : model.nodes_of(scope, fields[0])) temperatures.at_nodes[node] = value;
  });
}

TemperatureField rise_of(const AbaqusModel& model, const AbaqusTemperatures& now,
                         const AbaqusTemperatures& initial, const std::string& name) {
  TemperatureField field;
  field.name = name;
  field.obstacle = now.obstacle.empty() ? initial.obstacle : now.obstacle;
  const std::size_t count = model.deck.mesh.vertices.size();
  field.at_vertices.assign(count, 0);
  field.slopes.assign(count, Eigen::Vector2d::Zero());
  bool has_slopes = false;
  for (const auto& [node, value] : now.at_nodes) {
    const auto before = initial.at_nodes.find(node);
    const Vector3 rise = before == initial.at_nodes.end() ? value : Vector3(value - before->second);
    field.at_vertices[node] = rise[0];
    field.slopes[node] = rise.tail<2>();
    has_slopes = has_slopes || !rise.tail<2>().isZero(0);
  }
  if (!has_slopes) field.slopes.clear();
  return field;
}

bool acts(const TemperatureField& field) {
  return !field.obstacle.empty() || !field.slopes.empty() ||
         std::any_of(field.at_vertices.begin(), field.at_vertices.end(),
                     [](double rise) { return rise != 0; });
}

}  // namespace blocklift::structure

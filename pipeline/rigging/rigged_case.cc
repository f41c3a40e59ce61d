#include "pipeline/rigging/rigged_case.h"

#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/formats/atomic_file.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_found_from(const fs::path& folder, const RopeChoice& choice, const RopeModel& rope) {
  if (!choice.model_name) return false;
  Diagnostics ignored;
  const RopeModel found = ModelLibrary::of_installation().resolve(choice, folder, ignored);
  return !ignored.has_errors() && found.breaking_load == rope.breaking_load &&
         found.stretches_like(rope);
}

YAML::Node model_node(const fs::path& folder, const StockSling& sling) {
  YAML::Node node;
  const RopeModel& rope = sling.rope;
  if (is_found_from(folder, sling.rope_choice, rope)) {
    node = sling.rope_choice.model_name->value;
    return node;
  }
  if (!rope.tension_curve)
    node["axial_stiffness"] = fmt::format("{:.10g} MN", rope.axial_stiffness / 1e6);
  for (const auto& [strain, tension] : rope.curve()) {
    YAML::Node point;
    point.push_back(fmt::format("{:.10g} %", strain * 100));
    point.push_back(fmt::format("{:.10g} kN", tension / 1e3));
    node["tension_curve"].push_back(point);
  }
  node["damping_time"] = fmt::format("{:.10g} ms", rope.damping_time * 1e3);
  node["breaking_load"] = fmt::format("{:.10g} kN", rope.breaking_load / 1e3);
  if (rope.diameter) node["diameter"] = fmt::format("{:.10g} mm", *rope.diameter * 1e3);
  if (rope.mass_per_length) node["mass"] = fmt::format("{:.10g} kg/m", *rope.mass_per_length);
  if (rope.material) node["material"] = rope.material->value;
  if (rope.termination) node["termination"] = rope.termination->value;
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

/// A table with some of its entries changed. Entries that are one node by an anchor become nodes of
/// their own: a change of one must not reach the others.
YAML::Node with_entries(const YAML::Node& table,
                        const std::vector<std::pair<std::string, YAML::Node>>& changes) {
  YAML::Node changed(YAML::NodeType::Map);
  for (const auto& entry : table) changed[entry.first.Scalar()] = YAML::Clone(entry.second);
  for (const auto& [name, value] : changes) changed.remove(name);
  for (const auto& [name, value] : changes) changed[name] = value;
  return changed;
}

/// The ropes with the chosen models. Keys that come by a merge key from elsewhere stay there.
YAML::Node rigged_ropes(const RiggedLift& rigged, const YAML::Node& ropes) {
  const fs::path folder = rigged.lift_case.file.parent_path();
  YAML::Node changed(YAML::NodeType::Map);
  for (const auto& entry : ropes) {
    const std::string name = entry.first.Scalar();
    YAML::Node rope = YAML::Clone(entry.second);
    for (const RiggedSling& sling : rigged.slings)
      if (sling.demand.rope == name)
        rope = with_entries(
            rope, {{"model", model_node(folder, rigged.stock.slings[sling.chosen.index].sling)}});
    rope.SetStyle(entry.second.Style());
    changed[name] = rope;
  }
  return changed;
}

YAML::Node rigged_shackles(const RiggedLift& rigged, const YAML::Node& shackles) {
  std::vector<std::pair<std::string, YAML::Node>> chosen;
  for (const ChosenShackle& one : rigged.shackles) {
    if (!one.index) continue;
    const StockShackle& shackle = rigged.stock.shackles[*one.index].shackle;
    YAML::Node node;
    node["working_load"] = fmt::format("{:.10g} kN", shackle.working_load / 1e3);
    node["breaking_load"] = fmt::format("{:.10g} kN", shackle.breaking_load / 1e3);
    node.SetStyle(YAML::EmitterStyle::Flow);
    chosen.emplace_back(one.lug, node);
  }
  return with_entries(shackles, chosen);
}

YAML::Node load_node(double newtons) {
  return YAML::Node(fmt::format("{:.10g} kN", newtons / 1e3));
}

YAML::Node rigged_master_links(const RiggedLift& rigged, const YAML::Node& links) {
  std::vector<std::pair<std::string, YAML::Node>> chosen;
  for (const ChosenMasterLink& one : rigged.master_links) {
    const StockMasterLink& link = rigged.stock.master_links[one.index].link;
    YAML::Node node;
    node["working_load"] = load_node(link.working_load);
    node["breaking_load"] = load_node(link.breaking_load);
    node["mass"] = fmt::format("{:.10g} kg", link.mass);
    node.SetStyle(YAML::EmitterStyle::Flow);
    chosen.emplace_back(one.demand.hook, node);
  }
  return with_entries(links, chosen);
}

YAML::Node rigged_sheaves(const RiggedLift& rigged, const YAML::Node& sheaves) {
  std::vector<std::pair<std::string, YAML::Node>> chosen;
  for (const ChosenSheave& one : rigged.sheaves) {
    if (!one.index) continue;
    const StockSheave& sheave = rigged.stock.sheaves[*one.index].sheave;
    YAML::Node node;
    node["working_load"] = load_node(sheave.working_load);
    node["breaking_load"] = load_node(sheave.breaking_load);
    node["tread"] = fmt::format("{:.10g} mm", 1e3 * sheave.tread);
    node.SetStyle(YAML::EmitterStyle::Flow);
    chosen.emplace_back(one.rope, node);
  }
  return with_entries(sheaves, chosen);
}

std::string millimetres(double length) { return fmt::format("{:.10g} mm", 1e3 * length); }

YAML::Node section_node(const BarSection& section) {
  YAML::Node node, measures;
  if (section.pipe)
    for (const double length : *section.pipe) measures.push_back(millimetres(length));
  else
    for (const double length : *section.box) measures.push_back(millimetres(length));
  node[section.pipe ? "pipe" : "box"] = measures;
  node.SetStyle(YAML::EmitterStyle::Flow);
  return node;
}

/// The bars with the keys of the stock's; where a bar starts is the case's own.
YAML::Node rigged_spreaders(const RiggedLift& rigged, const YAML::Node& spreaders) {
  std::vector<std::pair<std::string, YAML::Node>> changed;
  for (const ChosenSpreader& one : rigged.spreaders) {
    const given::Spreader& bar = rigged.stock.spreaders[one.index].spreader.bar;
    YAML::Node node = YAML::Clone(spreaders[one.name]);
    node.remove("mass");
    if (bar.given_mass) node["mass"] = fmt::format("{:.10g} kg", *bar.given_mass);
    node.remove("centre_of_mass");
    if (bar.centre_of_mass)
      for (const double along : bar.centre()) node["centre_of_mass"].push_back(millimetres(along));
    node["length"] = millimetres(bar.length.value);
    if (bar.is_frame()) node["width"] = millimetres(*bar.width);
    node["section"] = section_node(bar.section.value);
    node.remove("cross_section");
    if (bar.cross_section) node["cross_section"] = section_node(bar.cross_section->value);
    node["yield_stress"] = fmt::format("{:.10g} MPa", bar.yield_stress / 1e6);
    node["buckling_curve"] = buckling_curve_name(bar.curve);
    node["upper_eye"] = millimetres(bar.upper_eye);
    node["lower_eye"] = millimetres(bar.lower_eye);
    changed.emplace_back(one.name, node);
  }
  return with_entries(spreaders, changed);
}

}  // namespace

std::string rigged_case_text(const RiggedLift& rigged) {
  YAML::Node root = YAML::Load(rigged.lift_case.yaml);
  root["ropes"] = rigged_ropes(rigged, root["ropes"]);
  const auto& standard = rigged.lift_case.standard;
  if (standard && standard->rules.shackle && !rigged.stock.shackles.empty())
    root["standard"]["shackles"] = rigged_shackles(rigged, root["standard"]["shackles"]);
  if (standard && !rigged.master_links.empty())
    root["standard"]["master_links"] =
        rigged_master_links(rigged, root["standard"]["master_links"]);
  if (standard && !rigged.sheaves.empty())
    root["standard"]["sheaves"] = rigged_sheaves(rigged, root["standard"]["sheaves"]);
  if (!rigged.spreaders.empty()) root["spreaders"] = rigged_spreaders(rigged, root["spreaders"]);
  return fmt::format("# Rigging chosen from stock by blocklift rig, for the case {}.\n",
                     rigged.lift_case.file.filename().string()) +
         YAML::Dump(root) + '\n';
}

void write_rigged_case(const RiggedLift& rigged, const fs::path& file) {
  AtomicFile aside(file);
  {
    std::ofstream stream(aside.temporary_path());
    stream << rigged_case_text(rigged);
  }
  ModelLibrary library = ModelLibrary::of_installation();
  Diagnostics diagnostics;
  if (!read_lift_case(aside.temporary_path(), library, diagnostics)) {
    diagnostics.error({std::make_shared<const std::string>(shown_path(file)), 0, 0},
                      "the case with its slings from stock could not be read from here",
                      {"write it into the folder of the case, beside which its models are found"});
    throw InputError(diagnostics);
  }
  aside.commit();
}

}  // namespace blocklift::pipeline

#include "pipeline/files/structure/mesh_groups.h"

#include <algorithm>

#include <fmt/format.h>

#include "pipeline/declaration/geometry_format.h"
#include "pipeline/declaration/table.h"
#include "pipeline/files/structure/block_model.h"
#include "pipeline/files/structure/profile_format.h"
#include "structure/error.h"
#include "structure/letter_case.h"
#include "structure/mesh/files/surfaces/given_properties.h"

namespace blocklift::pipeline {
namespace {

constexpr double thickest = 1;  // m, beyond any plate

void check_group(const MeshGroupModel& group, Reading& reading, const Mark& mark) {
  if (group.thickness.has_value() == group.is_of_bars())
    reading.error(mark,
                  reading.owner() + (group.thickness ? " has a thickness and also a section"
                                                     : " has neither a thickness nor a section"),
                  {"plates have a thickness, bars a section"});
  if (group.towards && group.around)
    reading.error(mark,
                  reading.owner() + " stands \"towards\" a direction and also \"around\" an axis",
                  {"straight bars stand towards a direction, frames of a tank or pipe around its "
                   "axis"});
  if (group.is_of_bars() && !group.around)
    check_direction(group.section.value, group.towards, reading, mark);
  else if (!group.is_of_bars() && (group.towards || group.around))
    reading.error(mark,
                  fmt::format("{} has \"{}\", but no section", reading.owner(),
                              group.towards ? "towards" : "around"),
                  {"such as section: {flat_bar: [150 mm, 12 mm]}, towards: [0, 0, -1]"});
}

Format<FrameAxisModel> frame_axis_format() {
  Table<FrameAxisModel> table("axis of frames",
                              "The axis of a tank or pipe: each piece of a frame stands straight "
                              "towards it.");
  table.required("point", &FrameAxisModel::point, position_format(), "on the axis")
      .required("along", &FrameAxisModel::along, direction_format(), "direction of the axis")
      .optional("outside", &FrameAxisModel::outside, boolean(),
                "the frames lie outside the shell and stand away from the axis");
  return table.format();
}

class PropertyGiver {
 public:
  PropertyGiver(const BlockModel& block, structure::Deck& deck, Diagnostics& diagnostics)
      : block_(block), mesh_model_(*block.mesh), deck_(deck), diagnostics_(diagnostics) {}

  void give() {
    const std::size_t before = diagnostics_.error_count();
    require_groups(deck_.groups_without_thickness, "thickness", "{}: 12 mm");
    require_groups(deck_.groups_without_section, "section",
                   "{}: {{section: {{flat_bar: [150 mm, 12 mm]}}, towards: [0, 0, -1]}}");
    for (const auto& group : mesh_model_.groups) check(group);
    if (diagnostics_.error_count() > before) return;
    // Bars stand on plates: these come first.
    for (const auto& group : mesh_model_.groups)
      if (group.thickness)
        structure::give_thickness(deck_.mesh, group.name.value, *group.thickness,
                                  material_of(group));
    for (const auto& group : mesh_model_.groups) give_section(group);
  }

 private:
  void require_groups(const std::vector<std::string>& groups, const char* what,
                      const char* example) {
    std::vector<std::string> missing;
    for (const std::string& name : groups)
      if (!find_by_name(mesh_model_.groups, name)) missing.push_back(name);
    if (missing.empty()) return;
    std::vector<std::string> hints{
        fmt::format("give each one under mesh: groups: {{{}}}",
                    fmt::format(fmt::runtime(example), missing.front()))};
    if (const std::vector<std::string> sets = sets_of_elements(); !sets.empty())
      hints.push_back("or to sets of elements that the file has: " + list_of_names(sets));
    diagnostics_.error(mesh_model_.file.mark,
                       fmt::format("{} gives no {} to its group{} {}", mesh_model_.file.value, what,
                                   missing.size() == 1 ? "" : "s", list_of_names(missing)),
                       std::move(hints));
  }

  /// Those of an Abaqus deck, in which elements without a section have no groups of their own.
  std::vector<std::string> sets_of_elements() const {
    std::vector<std::string> names;
    if (structure::ending_of(mesh_model_.file.value) != ".inp") return names;
    for (const structure::NamedSet& set : deck_.sets)
      if (!set.shells.empty() || !set.beams.empty()) names.push_back(set.name);
    return names;
  }

  void check(const MeshGroupModel& group) {
    const auto& groups =
        group.is_of_bars() ? deck_.groups_without_section : deck_.groups_without_thickness;
    const char* what = group.is_of_bars() ? "section" : "thickness";
    if (std::find(groups.begin(), groups.end(), group.name.value) == groups.end())
      diagnostics_.error(
          group.name.mark,
          fmt::format("{} has no group \"{}\" without a {}", mesh_model_.file.value,
                      group.name.value, what),
          {groups.empty() ? fmt::format("all that may have a {} have one", what)
                          : names_hint("groups without are", groups, group.name.value)});
    if (group.thickness.value_or(0) > thickest)
      diagnostics_.error(group.name.mark,
                         fmt::format("plates of group {} are {:.4g} m thick: is the unit mistaken?",
                                     group.name.value, *group.thickness),
                         {"plates are up to 1 m thick; millimetres are written as 20 mm"});
    check_material(group);
  }

  void check_material(const MeshGroupModel& group) {
    const std::string& material = group.material.value;
    if (material.empty() && block_.materials.size() != 1)
      diagnostics_.error(
          group.name.mark,
          fmt::format("group {} names no material, and the block has {}", group.name.value,
                      block_.materials.empty() ? "none" : "several"),
          {block_.materials.empty()
               ? "give one under materials"
               : "its materials are " + list_of_names(names_of(block_.materials))});
    else if (!material.empty() && !find_by_name(block_.materials, material))
      diagnostics_.error(
          group.material.mark,
          fmt::format("group {} names material \"{}\", which the block does not have",
                      group.name.value, material),
          {names_hint("its materials are", names_of(block_.materials), material)});
  }

  int material_of(const MeshGroupModel& group) {
    const MaterialModel& model = group.material.value.empty()
                                     ? block_.materials.front()
                                     : *find_by_name(block_.materials, group.material.value);
    auto& materials = deck_.mesh.materials;
    const auto known = std::find_if(
        materials.begin(), materials.end(),
        [&](const structure::Material& other) { return other.name == model.name.value; });
    const auto place = static_cast<int>(known - materials.begin());
    if (known == materials.end())
      materials.push_back({model.name.value, model.youngs_modulus, model.poisson_ratio,
                           model.density, model.yield_stress});
    return place;
  }

  void give_section(const MeshGroupModel& group) {
    if (!group.section.value) return;
    try {
      const structure::Profile& profile = *group.section.value;
      if (group.around)
        structure::give_profile(
            deck_.mesh, group.name.value, profile,
            structure::FrameAxis{group.around->point, group.around->along, group.around->outside},
            material_of(group));
      else
        structure::give_profile(deck_.mesh, group.name.value, profile, group.towards,
                                material_of(group));
    } catch (const structure::ModelError& wrong) {
      diagnostics_.error(group.name.mark, wrong.what());
    }
  }

  const BlockModel& block_;
  const MeshModel& mesh_model_;
  structure::Deck& deck_;
  Diagnostics& diagnostics_;
};

}  // namespace

Format<std::vector<MeshGroupModel>> mesh_groups_format() {
  Table<MeshGroupModel> table("group of a mesh",
                              "What the plates or bars of a group are; in place of the table a "
                              "thickness alone.");
  const auto thickness = quantity(Dimension::length, Range::positive());
  table.optional("thickness", &MeshGroupModel::thickness, thickness, "of plates")
      .optional(
          "section", &MeshGroupModel::section, profile_format(),
          "of bars; it stands on the plate along which they run, elsewhere on their nodes: flat "
          "bars, bulb flats, angles and tees with their foot, other profiles with their middle")
      .optional("towards", &MeshGroupModel::towards, direction_format(),
                "direction in which the section stands, away from its plate; pipes and round bars "
                "need none")
      .optional("around", &MeshGroupModel::around, frame_axis_format(),
                "in place of a direction, of ring frames and other bars that run round: the axis "
                "towards which the section stands, or away from it")
      .optional("material", &MeshGroupModel::material, reference(),
                "one of the block's materials; may be left out if there is one only")
      .rule(check_group);
  const auto alone = converted<double, MeshGroupModel>(thickness, [](double value) {
    MeshGroupModel group;
    group.thickness = value;
    return group;
  });
  // Names are those of the file, whatever characters they have.
  return converted<std::vector<Named<MeshGroupModel>>, std::vector<MeshGroupModel>>(
      names_to(by_shape<MeshGroupModel>(alone, std::nullopt, table.format())),
      [](const std::vector<Named<MeshGroupModel>>& named) {
        std::vector<MeshGroupModel> groups;
        for (const auto& [name, group] : named) {
          groups.push_back(group);
          groups.back().name = name;
        }
        return groups;
      });
}

void give_properties(const BlockModel& block, structure::Deck& deck, Diagnostics& diagnostics) {
  PropertyGiver(block, deck, diagnostics).give();
}

}  // namespace blocklift::pipeline

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "pipeline/comparison/compared_blocks.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/report/packed_array.h"

namespace blocklift::pipeline {
namespace {

using Json = nlohmann::ordered_json;
using Stresses = std::map<std::string, double>;  // by part, Pa

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Figures of the summary that stand beside a drawing.
Json figures_of(const ComparedResult& result, const std::string& way, const std::string& state) {
  const Json::json_pointer path("/structure/" + way + "/" + state);
  Json figures = Json::object();
  if (!result.summary.contains(path)) return figures;
  const Json& all = result.summary[path];
  for (const char* name : {"checked_von_mises_Pa", "max_displacement_m", "checked_point_m",
                           "max_displacement_point_m"})
    if (all.contains(name)) figures[name] = all[name];
  return figures;
}

/// Results whose blocks have a mesh other than the reference's.
bool has_own_mesh(const ComparedBlock& block) {
  return block.surface_of != std::optional<std::size_t>{0};
}

void raise(Stresses& stresses, const std::string& part, double stress) {
  const auto [entry, is_new] = stresses.try_emplace(part, stress);
  if (!is_new) entry->second = std::max(entry->second, stress);
}

std::string patches_of(std::string_view name) {
  return layout::join(layout::structure_group, layout::history, "patches", name);
}

/// The largest checked stress of each plate in one state; none if the result does not hold it.
std::optional<Stresses> checked_stresses(const ResultsReader& file, std::string_view state) {
  const std::string values =
      layout::join(layout::structure_group, layout::history, state, "patches", "von_mises");
  if (!file.has(patches_of("plates")) || !file.has(patches_of("plate")) || !file.has(values))
    return std::nullopt;
  const std::vector<std::string> names = file.read_texts(patches_of("plates"));
  const std::vector<std::int32_t> plates = file.read_indices(patches_of("plate")).values;
  const std::vector<double> stresses = file.read(values).values;
  Stresses largest;
  for (std::size_t i = 0; i < std::min(plates.size(), stresses.size()); ++i)
    raise(largest, names.at(plates[i]), stresses[i]);
  return largest;
}

/// The largest stress of each group in one drawn field.
Stresses drawn_stresses(const BlockSurface& surface, const BlockField& field) {
  Stresses largest;
  for (std::size_t quad = 0; quad < surface.quad_count(); ++quad)
    for (std::size_t i = 0; i < 4; ++i)
      raise(largest,
            surface.quad_groups.empty() ? "block" : surface.groups[surface.quad_groups[quad]],
            field.von_mises[surface.quads[4 * quad + i]]);
  return largest;
}

/// Stresses of each block in one state.
using StressesOfBlocks = std::vector<Stresses>;

std::optional<StressesOfBlocks> all_checked(const std::vector<ComparedResult>& results,
                                            const ComparedBlocks& compared,
                                            std::string_view state) {
  if (compared.way != layout::history) return std::nullopt;
  StressesOfBlocks all;
  for (const ComparedBlock& block : compared.blocks) {
    auto one =
        checked_stresses(ResultsReader(results[block.result].folder / layout::results_file), state);
    if (!one) return std::nullopt;
    all.push_back(*std::move(one));
  }
  return all;
}

StressesOfBlocks all_drawn(const ComparedBlocks& compared, std::string_view state) {
  StressesOfBlocks all;
  for (const ComparedBlock& block : compared.blocks) {
    const auto field = block.fields.find(std::string(state));
    const BlockSurface& surface =
        block.surface_of ? compared.blocks[*block.surface_of].surface : block.surface;
    all.push_back(field == block.fields.end() ? Stresses{}
                                              : drawn_stresses(surface, field->second));
  }
  return all;
}

double largest_of(const PartStress& part) {
  double largest = 0;
  for (const std::vector<double>* list : {&part.at_rest, &part.in_motion})
    for (const double stress : *list)
      if (std::isfinite(stress)) largest = std::max(largest, stress);
  return largest;
}

}  // namespace

Json blocks_json(const std::vector<ComparedResult>& results, const ComparedBlocks& compared) {
  if (compared.blocks.empty()) return nullptr;
  Json blocks = Json::array();
  for (const ComparedBlock& block : compared.blocks) {
    const ComparedResult& result = results[block.result];
    Json entry{{"name", result.name}};
    if (block.surface_of)
      entry["surface_of"] = *block.surface_of;
    else
      entry["surface"] = surface_shape_json(block.surface);
    entry["fields"] = Json::object();
    for (const auto& [state, field] : block.fields)
      entry["fields"][state] = {{"field", surface_field_json(field)},
                                {"figures", figures_of(result, compared.way, state)}};
    entry["differences"] = Json::object();
    for (const auto& [state, difference] : block.differences)
      entry["differences"][state] = {{"von_mises", packed_where_known(difference.von_mises)},
                                     {"displacement", packed_where_known(difference.displacement)}};
    blocks.push_back(std::move(entry));
  }
  return {{"way", compared.way}, {"blocks", std::move(blocks)}};
}

std::vector<std::string> remarks_on_blocks(const std::vector<ComparedResult>& results,
                                           const ComparedBlocks& compared) {
  std::vector<std::string> remarks = compared.remarks;
  const std::string& reference = results.front().name;
  for (std::size_t i = 1; i < compared.blocks.size(); ++i) {
    const ComparedBlock& block = compared.blocks[i];
    const std::string& name = results[block.result].name;
    if (has_own_mesh(block))
      remarks.push_back(
          fmt::format("The mesh of {} is not that of {}: for the differences each of its points "
                      "takes the value at the nearest place of the same part of {}.",
                      name, reference, reference));
    if (!block.parts_without.empty())
      remarks.push_back(
          fmt::format("Parts of {} without a counterpart in {}, grey where the "
                      "difference is drawn: {}.",
                      name, reference, fmt::join(block.parts_without, ", ")));
    if (!block.parts_partly_without.empty())
      remarks.push_back(fmt::format("Parts of {} that reach beyond those of {}, grey there: {}.",
                                    name, reference, fmt::join(block.parts_partly_without, ", ")));
    if (!block.parts_lost.empty())
      remarks.push_back(fmt::format("Parts of {} that {} lacks: {}.", reference, name,
                                    fmt::join(block.parts_lost, ", ")));
  }
  return remarks;
}

StressByPart stress_by_part(const std::vector<ComparedResult>& results,
                            const ComparedBlocks& compared) {
  StressByPart table;
  auto at_rest = all_checked(results, compared, layout::static_state);
  auto in_motion = all_checked(results, compared, layout::dynamic_state);
  table.is_checked = at_rest && in_motion;
  if (!table.is_checked) {
    at_rest = all_drawn(compared, layout::static_state);
    in_motion = all_drawn(compared, layout::dynamic_state);
  }
  std::map<std::string, PartStress> parts;
  const auto take = [&](const StressesOfBlocks& all, std::vector<double> PartStress::*list) {
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const auto& [name, stress] : all[i]) {
        PartStress& part = parts[name];
        part.part = name;
        part.at_rest.resize(all.size(), none);
        part.in_motion.resize(all.size(), none);
        (part.*list)[i] = stress;
      }
  };
  take(*at_rest, &PartStress::at_rest);
  take(*in_motion, &PartStress::in_motion);
  for (auto& [name, part] : parts) table.parts.push_back(std::move(part));
  std::stable_sort(
      table.parts.begin(), table.parts.end(),
      [](const PartStress& a, const PartStress& b) { return largest_of(a) > largest_of(b); });
  return table;
}

}  // namespace blocklift::pipeline

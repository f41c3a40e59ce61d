#include "pipeline/comparison/compared_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "pipeline/comparison/surface_mapping.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {
namespace {

constexpr std::array states{layout::static_state, layout::dynamic_state};
/// Bytes that the blocks may take of a page.
constexpr std::size_t block_picture_budget = 20'000'000;

bool has_field(const ResultsReader& results, std::string_view way) {
  return std::any_of(states.begin(), states.end(), [&](std::string_view state) {
    return results.has(layout::join(layout::structure_group, way, state, "von_mises"));
  });
}

/// The ways whose fields a result holds on its surface; none without a surface.
std::set<std::string_view> ways_of(const ComparedResult& result) {
  const ResultsReader file(result.folder / layout::results_file);
  std::set<std::string_view> ways;
  if (!file.has(layout::surface_points) || file.read(layout::surface_points).values.empty())
    return ways;
  for (const std::string_view way : surface_ways)
    if (has_field(file, way)) ways.insert(way);
  return ways;
}

/// Of the ways that the reference has the one that most results have.
std::string_view common_way(const std::vector<std::set<std::string_view>>& ways) {
  std::string_view best;
  std::ptrdiff_t most = 0;
  for (const std::string_view way : surface_ways) {
    if (!ways.front().contains(way)) continue;
    const auto count =
        std::count_if(ways.begin(), ways.end(), [&](const auto& one) { return one.contains(way); });
    if (count > most) {
      best = way;
      most = count;
    }
  }
  return best;
}

ComparedBlock read_block(const ComparedResult& result, std::size_t number, std::string_view way) {
  const ResultsReader file(result.folder / layout::results_file);
  ComparedBlock block;
  block.result = number;
  block.surface = read_block_surface(file).value_or(BlockSurface{});
  for (const std::string_view state : states)
    if (auto field = read_surface_field(file, way, state, block.surface.point_count()))
      block.fields.emplace(state, *std::move(field));
  return block;
}

double magnitude(const MappedPoint& place, const std::vector<double>& vectors) {
  return std::hypot(mapped_value(place, vectors, 3, 0), mapped_value(place, vectors, 3, 1),
                    mapped_value(place, vectors, 3, 2));
}

BlockDifference difference(const BlockField& field, const BlockField& reference,
                           const std::vector<MappedPoint>& mapped) {
  BlockDifference result;
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    const double* moved = &field.displacement[3 * i];
    result.von_mises.push_back(field.von_mises[i] - mapped_value(mapped[i], reference.von_mises));
    result.displacement.push_back(std::hypot(moved[0], moved[1], moved[2]) -
                                  magnitude(mapped[i], reference.displacement));
  }
  return result;
}

std::set<std::string> used_groups(const BlockSurface& surface) {
  std::set<std::string> names;
  for (const std::int32_t group : surface.quad_groups) names.insert(surface.groups[group]);
  return names;
}

/// Names the groups that have no counterpart, wholly or in part.
void name_parts_without(const std::vector<MappedPoint>& mapped, const BlockSurface& reference,
                        ComparedBlock& block) {
  const BlockSurface& surface = block.surface;
  std::set<std::string> found, missed;
  for (std::size_t quad = 0; quad < surface.quad_groups.size(); ++quad) {
    const std::string& group = surface.groups[surface.quad_groups[quad]];
    for (std::size_t i = 0; i < 4; ++i) {
      const MappedPoint& place = mapped[surface.quads[4 * quad + i]];
      (place.has_counterpart() ? found : missed).insert(group);
    }
  }
  for (const std::string& group : missed)
    (found.contains(group) ? block.parts_partly_without : block.parts_without).push_back(group);
  const std::set<std::string> mine = used_groups(surface);
  for (const std::string& group : used_groups(reference))
    if (!mine.contains(group)) block.parts_lost.push_back(group);
}

void take_differences(const ComparedBlock& reference, ComparedBlock& block) {
  const std::vector<MappedPoint> mapped = map_surface(block.surface, reference.surface);
  for (const auto& [state, field] : block.fields)
    if (const auto theirs = reference.fields.find(state); theirs != reference.fields.end())
      block.differences.emplace(state, difference(field, theirs->second, mapped));
  name_parts_without(mapped, reference.surface, block);
}

/// Leaves a block the fields alone if an earlier one has its mesh.
void share_surface(const std::vector<ComparedBlock>& earlier, ComparedBlock& block) {
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    if (earlier[i].surface_of || !have_same_mesh(block.surface, earlier[i].surface)) continue;
    block.surface_of = i;
    block.surface = {};
    return;
  }
}

std::size_t bytes_of(const ComparedBlock& block) {
  std::size_t bytes = block.surface_of ? 0 : bytes_of_shape(block.surface);
  for (const auto& [state, field] : block.fields) bytes += bytes_of_field(field.von_mises.size());
  for (const auto& [state, one] : block.differences) bytes += 4 * one.von_mises.size() * 4 / 3;
  return bytes;
}

}  // namespace

ComparedBlocks compare_blocks(const std::vector<ComparedResult>& results) {
  ComparedBlocks compared;
  std::vector<std::set<std::string_view>> ways;
  for (const ComparedResult& result : results) ways.push_back(ways_of(result));
  if (std::all_of(ways.begin(), ways.end(), [](const auto& one) { return one.empty(); })) {
    compared.remarks = {"There are no pictures: none of the results holds a block's stresses."};
    return compared;
  }
  if (ways.front().empty()) {
    compared.remarks = {fmt::format(
        "There are no pictures: {}, from which changes count, holds no stresses of a block.",
        results.front().name)};
    return compared;
  }
  const std::string_view way = common_way(ways);
  compared.way = way;
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!ways[i].contains(way)) {
      compared.remarks.push_back(
          ways[i].empty()
              ? fmt::format("There are no pictures of {}: it holds no stresses of a block.",
                            results[i].name)
              : fmt::format("There are no pictures of {}: its stresses are not of the same kind as "
                            "those of {}.",
                            results[i].name, results.front().name));
      continue;
    }
    ComparedBlock block = read_block(results[i], i, way);
    if (!compared.blocks.empty()) take_differences(compared.blocks.front(), block);
    share_surface(compared.blocks, block);
    if (bytes + bytes_of(block) > block_picture_budget) {
      compared.remarks.push_back(fmt::format(
          "There are no pictures of {}: the page would be too large.", results[i].name));
      if (compared.blocks.empty()) break;
      continue;
    }
    bytes += bytes_of(block);
    compared.blocks.push_back(std::move(block));
  }
  if (compared.blocks.size() < 2) compared.blocks.clear();
  return compared;
}

}  // namespace blocklift::pipeline

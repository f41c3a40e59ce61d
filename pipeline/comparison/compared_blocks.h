#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/comparison/compared_result.h"
#include "pipeline/report/block_surface.h"

namespace blocklift::pipeline {

/// A result's field less that of the reference, on the points of the result's own surface; NaN
/// where the reference has no counterpart (surface_mapping.h).
struct BlockDifference {
  std::vector<double> von_mises;     ///< Pa
  std::vector<double> displacement;  ///< of the displacements' magnitudes, m
};

/// The block of one result. Fields are named by their state, "static" and "dynamic".
struct ComparedBlock {
  std::size_t result = 0;                 ///< among those compared
  BlockSurface surface;                   ///< empty if it is that of `surface_of`
  std::optional<std::size_t> surface_of;  ///< the earlier block that has the same mesh
  std::map<std::string, BlockField> fields;
  std::map<std::string, BlockDifference> differences;  ///< none of the reference
  /// Groups without a counterpart in the reference at any point, and those in which some have none.
  std::vector<std::string> parts_without, parts_partly_without;
  /// Groups of the reference that this block lacks.
  std::vector<std::string> parts_lost;
};

/// The blocks of several results, the reference first.
struct ComparedBlocks {
  std::string way;  ///< to take the loads, that all of them have: layout::history, ...
  std::vector<ComparedBlock> blocks;  ///< two at least, or none
  std::vector<std::string> remarks;   ///< why blocks are not among them: whole sentences
};

/// Reads the blocks of results and takes differences from the first.
/// @throws ResultsError if a file cannot be read.
ComparedBlocks compare_blocks(const std::vector<ComparedResult>& results);

/// What a page draws them from: {way, blocks: [{name, surface or surface_of, fields: {state:
/// {field, figures}}, differences: {state: {von_mises, displacement}}}]}; its twin is
/// pipeline/report/web/src/block_comparison.ts. Null if there are none.
nlohmann::ordered_json blocks_json(const std::vector<ComparedResult>& results,
                                   const ComparedBlocks& compared);

/// What is said of them without drawings: what has no counterpart, what is not drawn and why.
std::vector<std::string> remarks_on_blocks(const std::vector<ComparedResult>& results,
                                           const ComparedBlocks& compared);

/// The largest stress of a part in each compared block; NaN: the block lacks it.
struct PartStress {
  std::string part;
  std::vector<double> at_rest, in_motion;  ///< one a block, Pa
};

/// The largest stress of each part, the most stressed first.
struct StressByPart {
  bool is_checked =
      false;  ///< checked stress of single plates; else that of the drawings by groups
  std::vector<PartStress> parts;
};

/// Takes the checked stress of the whole lift, plate by plate, where all the results hold it; else
/// the largest of the drawn fields, group by group.
StressByPart stress_by_part(const std::vector<ComparedResult>& results,
                            const ComparedBlocks& compared);

}  // namespace blocklift::pipeline

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/report/block_surface.h"

namespace blocklift::pipeline::test {

/// The summary of a lift by two ropes of 100 and 200 kN at rest.
nlohmann::ordered_json sample_summary();

/// A rectangular deck of 8 m by 4 m and a bulkhead of 8 m by 2 m above its middle line, divided
/// into squares; the two share places and no points. A sample's block.
/// @param squares along 4 m
/// @param bulkhead the name of that group
BlockSurface sample_surface(int squares, const std::string& bulkhead = "bulkhead");

/// Its stress: linear in place, other on the bulkhead than on the deck.
std::vector<double> sample_stress(const BlockSurface& surface, double factor);

/// A block's stresses in a folder of results.
struct SampleBlock {
  BlockSurface surface;
  double factor = 1;          ///< of the stresses
  bool is_whole_lift = true;  ///< of the whole lift, with the checked stress of its plates
};

/// Writes a folder of results: a summary, and results.h5 with the input and tensions of two ropes.
/// @param block the text of the case's one model; empty: results of a version that kept none.
void write_sample_folder(const std::filesystem::path& folder, const nlohmann::ordered_json& summary,
                         const std::string& yaml, const std::string& block,
                         const std::optional<SampleBlock>& stresses = std::nullopt);

}  // namespace blocklift::pipeline::test

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

/// A block's surface for pictures, as results hold it (structure/output/surface.h): quadrangles on
/// the mid-surfaces of its plates. Plates share no points, though their places coincide at joints.
struct BlockSurface {
  std::vector<double> points;       ///< x y z of each point, block frame, m
  std::vector<std::int32_t> quads;  ///< four corners of each quadrangle; of a triangle two are one
  std::vector<std::int32_t> quad_groups;  ///< place in `groups` of each; empty: not known
  std::vector<std::string> groups;        ///< names of the plates, pads and lugs

  std::size_t point_count() const { return points.size() / 3; }
  std::size_t quad_count() const { return quads.size() / 4; }
  bool operator==(const BlockSurface&) const = default;
};

/// Stress and displacement on the points of a surface.
struct BlockField {
  std::vector<double> von_mises;     ///< Pa
  std::vector<double> displacement;  ///< x y z of each point, relative to the rigid motion, m
  std::string rope;                  ///< the governing one; empty: not known
  std::optional<double> time;        ///< of the instant, s
  /// Where it is largest: (name as in results_layout.h, place in the block frame, m).
  std::vector<std::pair<std::string, std::vector<double>>> places;
};

/// The ways to take the loads, the one that leads pages first.
inline constexpr std::array surface_ways{layout::history, layout::simultaneous,
                                         layout::per_rope_maxima};

/// The surface, none if the results have none.
/// @throws ResultsError if a quadrangle names a point that is not there.
std::optional<BlockSurface> read_block_surface(const ResultsReader& results);

/// The field of a way and a state (layout::static_state or dynamic_state), none if it is not there.
/// @throws ResultsError if it does not fit the surface.
std::optional<BlockField> read_surface_field(const ResultsReader& results, std::string_view way,
                                             std::string_view state, std::size_t point_count);

/// What a page draws them from, {points, quads, quad_group, groups} and {von_mises, displacement,
/// rope, time, places by their names}; twins of Surface and Field in
/// pipeline/report/web/src/data.ts.
nlohmann::ordered_json surface_shape_json(const BlockSurface& surface);
nlohmann::ordered_json surface_field_json(const BlockField& field);

/// Bytes that they take in a page, base64 taking 4 for 3.
std::size_t bytes_of_shape(const BlockSurface& surface);
std::size_t bytes_of_field(std::size_t point_count);

}  // namespace blocklift::pipeline

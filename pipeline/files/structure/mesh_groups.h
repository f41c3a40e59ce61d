#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/geometry_format.h"
#include "structure/mesh/beams/sections.h"
#include "structure/mesh/files/deck/deck.h"

namespace blocklift::pipeline {

struct BlockModel;

/// The axis of a tank or pipe about which frames run.
struct FrameAxisModel {
  Vector3 point = Vector3::Zero();   ///< m
  Vector3 along = Vector3::UnitZ();  ///< a unit vector
  bool outside = false;              ///< the section stands away from the axis
};

/// What the plates or bars of one group of a mesh are, where its file does not say it.
struct MeshGroupModel {
  Located<std::string> name;
  std::optional<double> thickness;                     ///< of plates, m
  Located<std::optional<structure::Profile>> section;  ///< of bars
  std::optional<Vector3> towards;                      ///< the section stands, a unit vector
  std::optional<FrameAxisModel> around;                ///< in place of a direction
  Located<std::string> material;                       ///< empty: the block's only one

  bool is_of_bars() const { return section.mark.line > 0; }
};

/// Groups by their names, each a table, or a thickness alone.
Format<std::vector<MeshGroupModel>> mesh_groups_format();

/// Gives plates and bars without properties those of the block's file. Complains of groups that
/// lack them, that are given and not there, and of materials that the block does not have.
void give_properties(const BlockModel& block, structure::Deck& deck, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/mesh/plates/block_description.h"
#include "structure/mesh/plates/hole_outline.h"

namespace blocklift::structure {

/// What a sheet is; the higher rank owns the cells that several sheets share.
enum class SheetRank { stiffener = -1, plate = 0, pad = 1, lug = 2 };

/// One stiffener of a row on a sheet.
struct StiffenerLine {
  int row = 0;  ///< place in BlockDescription::stiffeners
  int along = 0;
  double position = 0;  ///< across it on the sheet, m
  int side = 1;         ///< of the sheet, along its normal
};

/// Opening that is no rectangle, drawn in the two axes that follow a sheet's normal.
struct Cutout {
  std::string name;  ///< for messages: opening "manhole"
  HoleOutline outline;
};

/// One rectangle of plate, of a stiffener's web or flange, pad or lug at one position: the
/// generator's unit of work.
struct Sheet {
  std::string name;  ///< for messages: "web_frames at x = 4 m"
  int group = 0;     ///< plates in order, then pads, then lugs, then rows of stiffeners
  SheetRank rank = SheetRank::plate;
  int normal = 0;
  double position = 0;
  std::array<Interval, 3> extent;
  double thickness = 0;
  int material = 0;                            ///< place in BlockDescription::materials
  std::vector<std::array<Interval, 3>> holes;  ///< rectangular openings cut into it
  std::vector<Cutout> cutouts;
  std::vector<StiffenerLine> stiffeners;
};

/// Place of a material among a block's.
/// @param what is made of it, for the message.
/// @throws ModelError naming the materials that there are.
int place_of_material(const BlockDescription& block, const std::string& what,
                      const std::string& material);

/// @throws ModelError unless a row of stiffeners has spacing, section and side, and room for its
///   flanges if it is of plates.
void check_stiffeners(const Stiffeners& row);

/// Spreads a description into sheets, in the order plates, webs and flanges of stiffeners that are
/// plates, pads, lugs.
/// @throws ModelError naming what is wrong: names used twice, unknown materials, plates or pads,
///   empty extents, thickness not positive, overlapping plates of different thickness in one plane,
///   openings or stiffeners of a plate that does not exist, stiffeners without spacing or section
///   or along their plate's normal, a pad that lies on no plate or is thinner than it.
std::vector<Sheet> spread_into_sheets(const BlockDescription& description);

/// The sheet that a place belongs to of those that lie there: the highest rank, then the thickest,
/// then the first.
int owner(const std::vector<Sheet>& sheets, const std::vector<int>& candidates);

/// True if two intervals have more than `tolerance` in common.
bool overlap(const Interval& a, const Interval& b, double tolerance = 1e-6);

/// True if two coplanar sheets overlap in their plane.
bool overlap_in_plane(const Sheet& a, const Sheet& b);

}  // namespace blocklift::structure

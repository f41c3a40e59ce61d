#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/declaration/format.h"
#include "pipeline/declaration/geometry_format.h"
#include "structure/mesh/padeye/padeye_geometry.h"
#include "structure/practice/padeye_formulas.h"

namespace blocklift::pipeline {

struct BlockModel;
struct LugModel;

/// Padeye that lugs are made as. SI units.
struct PadeyeDesign {
  Located<std::string> name;
  double radius = std::numeric_limits<double>::quiet_NaN();  ///< of the main plate about the hole
  double thickness = std::numeric_limits<double>::quiet_NaN();  ///< of the main plate
  double hole = std::numeric_limits<double>::quiet_NaN();       ///< diameter
  double pin = std::numeric_limits<double>::quiet_NaN();        ///< diameter
  double cheek_radius = 0;
  double cheek_thickness = 0;  ///< of each of two
  double cheek_weld = 0;       ///< leg of the fillet around a cheek plate
  double base_weld = 0;        ///< leg of the fillets on both sides of the base; 0: welded through
  std::optional<structure::PadeyeDoubler> doubler;  ///< between base and plating
  std::optional<double> jaw;                        ///< inside width of the shackle
  std::optional<double> tensile_strength;           ///< of the plates, Pa
  double design_factor = 2;                         ///< N_d of ASME BTH-1
  int divisions = 32;                               ///< elements around the hole
};

/// Padeye by itself, for a part: with its base, and without a lug.
struct PadeyePart : PadeyeDesign {
  double height =
      std::numeric_limits<double>::quiet_NaN();  ///< of the hole's middle above the base
  std::array<double, 2> base = {};               ///< to -x and +x from below the hole
  double side_load = 0.05;  ///< least force along the pin in the hand formulae, share of the whole

  structure::PadeyeGeometry geometry() const;
};

/// A lug's padeye in the block: its measures and its frame P (see structure::PadeyeGeometry).
struct PlacedPadeye {
  structure::PadeyeGeometry geometry;
  Eigen::Matrix3d R_BP = Eigen::Matrix3d::Identity();
  Vector3 p_BP = Vector3::Zero();  ///< the middle of the hole, m
};

/// What does not fit of a doubler below a base of that length, a sentence each; empty: nothing.
std::vector<std::string> doubler_faults(const PadeyeDesign& design, double base);

Format<PadeyeDesign> padeye_format();
Format<PadeyePart> padeye_part_format();

/// Places a padeye where its lug is: the base is the edge of the pad that the lug juts out from, as
/// wide as the lug; the hole is about the pin. On a mesh the lug says how it stands
/// (PadeyeOnMesh).
/// @param faults what does not fit, a sentence each; empty: nothing.
/// @returns none where even the base is unknown: the lug lies within its pad, or juts out on two
/// sides.
std::optional<PlacedPadeye> place_padeye(const PadeyeDesign& design, const BlockModel& block,
                                         const LugModel& lug, std::vector<std::string>& faults);

}  // namespace blocklift::pipeline

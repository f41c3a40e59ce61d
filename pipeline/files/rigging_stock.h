#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/declaration/format.h"
#include "pipeline/files/rope_model.h"

namespace blocklift::pipeline {

/// The rule that a stock's working loads follow:
///   efficiency x breaking load = safety factor x working load.
struct WorkingLoadRule {
  std::string name;          ///< "EN 13414-1"
  double safety_factor = 1;  ///< where an item does not have its own
  double efficiency = 1;     ///< share of the breaking load that the ends leave
  std::string formula;       ///< by which the figures were worked, in words for people
};

/// How slings of a stock are made.
enum class SlingConstruction {
  wire_rope,        ///< single rope of strands with a steel core
  cable_laid,       ///< six ropes laid about a seventh
  grommet,          ///< endless cable, both parts together
  hmpe_round,       ///< endless core of high-modulus polyethylene in a cover
  polyester_round,  ///< endless core of polyester in a cover
  short_link_chain  ///< round steel
};

/// All constructions with their names in files.
const std::vector<std::pair<std::string, SlingConstruction>>& sling_constructions();

/// What a sling of a construction may bear over its mass per length, N m/kg.
struct StrengthRange {
  double least = 0;
  double most = 0;
};

/// Wide enough for every grade that is made, narrow enough to catch a wrong unit or another rope's
/// mass. Drawn wire of 1570 to 2160 MPa bears 200 to 275 kN m/kg of itself; stranding, steel core
/// and lubricant cost a quarter to two fifths of it, laying into a cable about a seventh more, a
/// grommet's core does not count; fibres of polyethylene bear 3.2 to 3.9 MN m/kg and of polyester
/// 0.7 to 0.9, of which half stays in a sling with its cover and less in small ones; chain of grade
/// 8 to 12 has 800 to 1200 MPa in both sides of links that weigh 2.8 times one side.
StrengthRange strength_range(SlingConstruction construction);

/// A sling in stock, of whatever length. SI units.
struct StockSling {
  Located<std::string> name;
  RopeChoice rope_choice;
  RopeModel rope;                                                  ///< after the look-up
  double working_load = std::numeric_limits<double>::quiet_NaN();  ///< N, one part, straight
  std::optional<double> safety_factor;                             ///< in place of the rule's
};

/// A bow shackle in stock. SI units.
struct StockShackle {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  Located<std::string> name;
  double working_load = nan;   ///< N
  double breaking_load = nan;  ///< N
  double body = nan;           ///< diameter of the bow, m
  double pin = nan;            ///< diameter, m
  double inside_width = nan;   ///< at the pin, m
  double mass = nan;           ///< kg
};

/// Rigging of one kind as it is in stock, with the source of its figures.
struct RiggingStock {
  std::string kind;
  std::string title;
  std::string source;
  WorkingLoadRule rule;
  std::optional<SlingConstruction> construction;  ///< of all slings of the file
  std::vector<StockSling> slings;
  std::vector<StockShackle> shackles;
  Mark place;

  double safety_factor_of(const StockSling& sling) const {
    return sling.safety_factor.value_or(rule.safety_factor);
  }
};

/// The format of a stock's file. One without a source is refused.
Format<RiggingStock> rigging_stock_format();

/// Whether the figures of a stock hold together, after its ropes were looked up: working loads by
/// the rule, strength over mass by the construction, pins by the shear that they may bear. Figures
/// that could not be read are passed over.
void check_rigging_stock(const RiggingStock& stock, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

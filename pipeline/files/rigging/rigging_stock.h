#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/declaration/format.h"
#include "pipeline/files/rigging/rope_model.h"
#include "pipeline/files/rigging/spreader_strength.h"

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

/// An oblong master link in stock, of round bar: two straight sides and two half rings. SI units.
struct StockMasterLink {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  Located<std::string> name;
  double working_load = nan;   ///< N, of all legs together
  double breaking_load = nan;  ///< N
  double bar = nan;            ///< diameter, m
  double inside_length = nan;  ///< m
  double inside_width = nan;   ///< m
  double mass = nan;           ///< kg

  /// Of its bar, as long as the line through the middle of it, of steel, kg.
  double mass_of_bar() const;
};

/// A sheave in stock over which slings are led. SI units.
struct StockSheave {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  Located<std::string> name;
  double working_load = nan;   ///< N, on its pin
  double breaking_load = nan;  ///< N
  double rope = nan;           ///< largest diameter that its groove takes, m
  double tread = nan;          ///< diameter at the bottom of the groove, m
  double mass = nan;           ///< kg
};

/// A spreader bar or frame in stock. SI units.
struct StockSpreader {
  Located<std::string> name;
  given::Spreader bar;
  double working_load = std::numeric_limits<double>::quiet_NaN();  ///< N, hung below it
  /// Of the slings above to the level, the least that the working load holds for, rad.
  double sling_angle = std::numeric_limits<double>::quiet_NaN();

  /// What it bears of its resistance under the working load, which hangs on its lower eyes alike,
  /// all forces times a factor, with slings above at sling_angle that meet over its middle and its
  /// own weight (SpreaderStrength).
  double utilisation(double factor) const;
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
  std::vector<StockMasterLink> master_links;
  std::vector<StockSheave> sheaves;
  std::vector<StockSpreader> spreaders;
  Mark place;

  double safety_factor_of(const StockSling& sling) const {
    return sling.safety_factor.value_or(rule.safety_factor);
  }
};

/// The format of a stock's file. One without a source is refused.
Format<RiggingStock> rigging_stock_format();

/// Whether the figures of a stock hold together, after its ropes were looked up: working loads by
/// the rule, strength over mass by the construction, pins by the shear that they may bear, master
/// links by their mass and the mean stress of their sides, sheaves by the bend of their largest
/// rope, spreaders by their strength. Figures that could not be read are passed over.
void check_rigging_stock(const RiggingStock& stock, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/standards/two_hooks.h"
#include "structure/practice/padeye_formulas.h"
#include "structure/square_site.h"

namespace blocklift::pipeline {

struct TolerancedRigging;

/// The largest load of one thing of the lift, at rest and in motion, N, and how the one became the
/// other: in_motion = at_rest x amplification x resharing.
struct LoadFacts {
  double at_rest = 0, in_motion = 0;
  std::optional<double> time_at_rest = {}, time_in_motion = {};  ///< s; none of a load table
  /// The whole load on the hooks at the instant of in_motion over that at the instant of at_rest.
  double amplification = 1;
  double resharing = 1;  ///< the same of this thing's share of the load

  /// Share of the increase that is re-sharing: ln(resharing) / ln(in_motion / at_rest); none where
  /// there is no increase.
  std::optional<double> share_of_resharing() const;
};

/// What may only be computed where the rigging is known.
struct ComputedFactors {
  std::optional<double> skew;        ///< by all sets of the slings' length tolerances
  std::optional<double> centre_box;  ///< by the centre of mass at the worst corner of its box
  std::optional<TwoHooks>
      two_hooks;           ///< where the lift hangs from two, at the largest load at rest
  bool bears_all = false;  ///< the load has no other way up, wherever its centre of mass lies
};

/// Sling, or another rope that ends at a lug.
struct SlingFacts {
  std::string name, lug, hook;
  LoadFacts load;
  ComputedFactors computed;
  double breaking_load = 0;  ///< N
  std::optional<std::string> material, termination;
  std::optional<double> diameter;       ///< m
  std::optional<double> bend_diameter;  ///< of what it is bent round, m; none: the standard's
  int slings_on_hook = 1;
  bool is_at_hook = false;       ///< it begins at the hook, not below a spreader
  bool is_at_load = true;        ///< it pulls at the load, not at a spreader
  bool runs_over_edges = false;  ///< of the load, so that it does not pull at its lug alone
  double angle = 0;  ///< at its upper end to the plumb, at the largest load at rest, rad
};

/// One end of a sling at a lug.
struct SlingPull {
  std::string sling;
  ComputedFactors computed;
  int slings_on_hook = 1;
  structure::Vector3 force = structure::Vector3::Zero();  ///< at rest, when LugPull::load is, N
};

/// What all slings that end at one lug do to it, and to the shackle in its hole.
struct LugPull {
  std::string lug;
  LoadFacts load;                 ///< of one sling, or of the sum of the forces of several
  std::vector<SlingPull> slings;  ///< none: the loads are those of a load table
};

/// Spreader bar or frame.
struct SpreaderFacts {
  std::string name;
  LoadFacts load;            ///< of all that hangs below it
  ComputedFactors computed;  ///< the worst of the slings that carry it
  int slings_on_hook = 1;
  bool is_frame = false;
  /// The load below it that it bears, as a column or by the sides of its frame, by the ropes'
  /// directions where they ask most, N.
  double borne_at_rest = 0, borne_in_motion = 0;
  /// By how much less a frame bears with its slings shared unevenly on either diagonal, by the
  /// rules' skew factor; none of bars and where four slings do not meet over it.
  std::optional<double> skew_by_rules = {};
  /// The same with the worst set of length tolerances, the frame giving way; none of bars and where
  /// no tolerance is known.
  std::optional<double> skew_computed = {};
  /// Of a frame, where it asks most at rest; none where no tolerance is known.
  std::shared_ptr<const TolerancedRigging> rigging = {};
};

/// Load of a hook over what its load chart allows, derating included, where it is largest.
struct ChartFacts {
  double at_rest = 0, in_motion = 0;  ///< the largest shares
  double radius = 0;                  ///< where that of rest is, m
  std::string derating;               ///< "x 0.8 for wind of 12 m/s (source)"; empty: none

  /// What the chart makes of a capacity for the largest load, where the load is another than at the
  /// instant of the largest share: that load over that share, N.
  static double capacity(double load, double share) { return load / share; }
};

/// Hoist with its hook block.
struct HookFacts {
  std::string name, crane;
  LoadFacts load;  ///< of the tackle: hook block and what hangs on it
  ComputedFactors computed;
  double hook_block = 0;  ///< weight, N
  double rigging = 0;  ///< weight of its slings and its master link, which the motion leaves out, N
  double hoisting_speed = 0;  ///< that the winch may have, m/s
  double capacity = 0;        ///< N
  std::optional<ChartFacts> chart;
};

/// Crane: all its hoists together.
struct CraneFacts {
  std::string name;
  LoadFacts load;
  ComputedFactors computed;
  double hook_blocks = 0, rigging = 0;  ///< weights, N
  double hoisting_speed = 0;            ///< of its fastest hoist, m/s
  std::optional<double> capacity;       ///< N
  std::optional<ChartFacts> chart;      ///< of a crane with one hoist
};

/// Lug that is made as a padeye.
struct LugFacts {
  std::string name;
  LugPull pull;
  structure::PadeyeFormulaInput input;
  structure::Vector3 at_rest = structure::Vector3::Zero();    ///< largest force in P, N
  structure::Vector3 in_motion = structure::Vector3::Zero();  ///< in motion, in P, N
  double lateral = 0;  ///< largest force along the pin over the force, of all instants
  std::optional<double> lateral_time;  ///< s
};

/// Checked stress of the structure.
struct StressFacts {
  std::string name;        ///< material, or lug; with the site where the rules tell sites apart
  std::string material;    ///< empty about a lug
  bool is_at_lug = false;  ///< of members that frame into a lift point
  std::string lug = {};    ///< that lift point
  double at_rest = 0, in_motion = 0;               ///< Pa
  double yield = 0;                                ///< Pa
  std::optional<structure::SquareSite> site = {};  ///< none: all places together
  /// Growth when the slings of a hook with four share unevenly on either diagonal, by the rules'
  /// skew factor and by the slings' tolerances of length; none where no hook has four slings that
  /// meet.
  std::optional<double> skew_by_rules = {}, skew_computed = {};
};

/// What a run knows that standards ask for. SI units.
struct LiftFacts {
  std::string rest_is_from = "equilibria of the operation";  ///< where loads at rest come from
  double net_weight = 0;                                     ///< N
  double rigging = 0;              ///< of all slings, spreaders and master links, N
  bool has_rigging_weight = true;  ///< every sling's model gives its mass
  double at_rest = 0;              ///< largest load on all hooks together, hook blocks apart, N
  double in_motion = 0;            ///< the same load in motion, N
  bool has_environment = false;    ///< waves or gusts, whose share of loads may reduce factors
  double yield_factor = 1;
  double spreader_factor = 1;  ///< on the forces in spreader bars
  double lateral = 0;          ///< that the case takes along a lug's pin, share of the force
  std::vector<SlingFacts> slings;
  std::vector<LugPull> pulls;  ///< of each lug at which slings end
  std::vector<SpreaderFacts> spreaders;
  std::vector<HookFacts> hooks;
  std::vector<CraneFacts> cranes;
  std::vector<LugFacts> lugs;
  std::vector<StressFacts> stresses;
};

}  // namespace blocklift::pipeline

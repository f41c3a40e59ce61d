#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/rope/tackle.h"
#include "pipeline/files/rigging/rope_model.h"
#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::pipeline {

/// A hook that turns on its block.
struct HookBearingModel {
  double hook_mass = std::numeric_limits<double>::quiet_NaN();           ///< of the block's, kg
  double radius_of_gyration = std::numeric_limits<double>::quiet_NaN();  ///< of the hook, m
  double friction_moment = 0;                                            ///< N m
};

/// How a hook block turns about the vertical: against its falls, and with a bearing its hook on it.
struct TurningBlockModel {
  /// Between the two falls that stand for all of the tackle, m.
  double falls_apart = std::numeric_limits<double>::quiet_NaN();
  double radius_of_gyration = std::numeric_limits<double>::quiet_NaN();  ///< about the vertical, m
  double horns = 0;    ///< from one horn of the hook to the other, m; zero: it has none
  double towards = 0;  ///< from the x axis of the body with the upper sheaves to horn a, rad
  std::optional<HookBearingModel> bearing;  ///< none: the hook is locked to the block
  Mark place;

  /// Place of a horn, `a` or `b`, in the hook's frame, m; none of another name.
  std::optional<Vector3> horn(const std::string& name) const;
};

/// Body of small size in which a tackle ends.
struct HookBlockModel {
  double mass = std::numeric_limits<double>::quiet_NaN();  ///< kg
  double wind_area = 0;                                    ///< m^2, from any side
  double wind_coefficient = 0;
  std::optional<Vector3> size;               ///< of its box, m
  std::optional<TurningBlockModel> turning;  ///< none: it keeps its direction

  /// Size of its box along x, y and z in the drawing and for clearances, m: as given, or else by
  /// its mass, twice as high as wide and of 3.5 t/m^3. That is an assumption, not quite half of it
  /// steel: 1 m x 1 m x 2 m of 7 t.
  Vector3 box_size() const;
};

/// A line of a load chart: what a hook may carry up to a radius.
struct ChartLine {
  double radius = std::numeric_limits<double>::quiet_NaN();    ///< m
  double capacity = std::numeric_limits<double>::quiet_NaN();  ///< N
};

/// Capacity over radius. Between two radii that of the larger one holds, beyond the last there is
/// none; below the first its own holds.
struct LoadChart {
  std::vector<ChartLine> lines;  ///< radii ascend

  /// Largest load at a radius (m), N; zero beyond the chart.
  double capacity(double radius) const;
};

/// A line of a table by which charts are derated.
struct DeratingLine {
  double up_to = std::numeric_limits<double>::quiet_NaN();   ///< m/s of wind, or m of waves
  double factor = std::numeric_limits<double>::quiet_NaN();  ///< of the chart's capacity
};

/// The factor of the first line that reaches a value: zero beyond the last. Lines ascend.
double factor_in(const std::vector<DeratingLine>& lines, double value);

/// By what the load charts of all hooks are multiplied in wind and in a seaway.
struct ChartDerating {
  std::string source;                                      ///< the maker's table
  std::optional<Located<std::vector<DeratingLine>>> wind;  ///< over its mean speed
  std::optional<Located<std::vector<DeratingLine>>> sea;   ///< over the significant height
  Mark place;
};

/// How the falls of a tackle are one rope on sheaves.
struct ReevingModel {
  int falls = 0;       ///< of all its ropes together
  int lead_lines = 1;  ///< ends of rope that run to a drum, each with its even share of the falls
  int lead_sheaves = 1;
  double sheave_efficiency = 1;
  std::optional<double> breaking_load;  ///< of the single rope, N; none: of all falls over them
  std::optional<double> line_pull;      ///< of the winch on each lead line, N
  Mark place;

  /// Falls of one lead line.
  dynamics::Tackle tackle() const { return {falls / lead_lines, lead_sheaves, sheave_efficiency}; }
};

/// Hoist: a winch on a body lets out a tackle whose hook block hangs free.
struct HoistModel {
  Located<std::string> name;
  Located<std::string> body;
  Vector3 sheave = Vector3::Zero();  ///< where the tackle leaves the body, in its frame, m
  HookBlockModel hook_block;
  RopeChoice rope_choice;
  RopeModel rope;                       ///< after the look-up
  std::optional<ReevingModel> reeving;  ///< none: nothing is known of the single rope
  double crane_stiffness = std::numeric_limits<double>::infinity();  ///< in series, N/m
  double capacity = std::numeric_limits<double>::quiet_NaN();        ///< load at the hook, N
  std::optional<Located<std::vector<ChartLine>>> load_chart;         ///< of that load over radius
  DriveLimits winch;  ///< of the rope length between sheave and hook block

  /// Smallest breaking load of the tackle's single rope, N. It has a reeving.
  double line_breaking_load() const {
    return reeving->breaking_load.value_or(rope.breaking_load / reeving->falls);
  }
};

/// A wheel, bogie, outrigger or leg on which a crane stands.
struct CraneSupport {
  Located<std::string> name;
  Vector3 position = Vector3::Zero();  ///< in the frame of the body that stands, m
  std::optional<double> capacity;      ///< largest load, N
};

/// What a crane stands on: its one body that a joint ties to the base, and where that is borne.
struct CraneStand {
  Located<std::string> body;
  std::vector<CraneSupport> supports;
  Mark place;
};

/// Crane as a mechanism of bodies, joints, loops, springs, drives and hoists. SI units.
struct CraneModel : MechanismParts {
  std::string kind;
  std::string title;
  ParameterValues parameters;
  JointValues pose;  ///< where joints stand when the crane is put together; zero if left out
  std::vector<HoistModel> hoists;
  std::optional<double> capacity;         ///< of the whole crane, N
  std::optional<PointModel> radius_from;  ///< from which level the radius of hooks counts
  std::optional<ChartDerating> derating;  ///< of the load charts
  std::optional<CraneStand> stands_on;
  Mark place;

  const HoistModel* find_hoist(const std::string& name) const;
};

/// The format of a crane's model file, with the rules that concern its own keys.
Format<CraneModel> crane_model_format();

/// The keys of a winch; shared with ropes that have one of their own.
Format<DriveLimits> winch_format();

}  // namespace blocklift::pipeline

#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/simulation/steering.h"
#include "pipeline/files/crane/crane_model.h"
#include "pipeline/files/environment/marine_parts.h"
#include "pipeline/files/environment/wind_in_case.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/files/lift_case/standard_in_case.h"
#include "pipeline/files/rigging/spreader.h"
#include "pipeline/files/structure/block_model.h"
#include "pipeline/files/structure/hot_spot_format.h"
#include "pipeline/files/structure/load_edge.h"

namespace blocklift::pipeline {

namespace given {

/// A crane of the lift: where it stands and where its drives and winches are at the start.
struct Crane {
  Located<std::string> name;
  Located<std::string> model_name;
  std::shared_ptr<const CraneModel> model;   ///< after the look-up; null if it failed
  ParameterValues parameters;                ///< in place of the model's own
  std::optional<Located<std::string>> base;  ///< vessel that it stands on; none: the world
  Vector3 position = Vector3::Zero();        ///< of the crane's base in the world or vessel, m
  Vector3 attitude = Vector3::Zero();        ///< roll, pitch, yaw of the base, rad
  /// Drives: coordinate. Hoists: unstretched rope length. Ordered as in the file.
  std::vector<Named<Located<Quantity>>> start;
  /// Two hoists whose tackles are reeved with one rope, so that they carry alike.
  std::optional<Located<std::array<Located<std::string>, 2>>> equalised;

  const Located<Quantity>* find_start(const std::string& drive_or_hoist) const;
};

}  // namespace given

/// Where a load is while it is in the water.
struct PlaceAfloat {
  std::array<double, 2> position{};  ///< of its frame's origin in the world, m
  double heading = 0.0;              ///< of its x axis, rad
};

namespace given {

/// What is lifted: a block, whose stress is asked; a vessel, which may float; or both, one ship.
struct Load {
  Located<std::string> model_name;          ///< of the block; empty for a vessel
  std::shared_ptr<const BlockModel> model;  ///< after the look-up; null if it failed
  std::optional<Located<std::string>> vessel_name;
  std::shared_ptr<const pipeline::Vessel>
      vessel;  ///< after the look-up; null if it failed; beside a block its hull
  std::vector<Named<Vector3>> lugs;    ///< of a vessel, in its frame, m
  std::vector<LoadEdge> edges;         ///< of a vessel without a block, in its frame
  Damping damping, quadratic_damping;  ///< of a vessel in the water
  /// Of a vessel for which the water that it sets in motion is computed, from its lowest point, m.
  std::optional<Located<std::vector<double>>> draughts;
  std::optional<PlaceAfloat> afloat;   ///< where it is meanwhile; none: as at the start
  Vector3 position = Vector3::Zero();  ///< of the block's frame at the start, a first guess, m
  Vector3 attitude = Vector3::Zero();  ///< roll, pitch, yaw, rad; a first guess

  /// Upright in the water at the deepest of its draughts. It has a vessel and draughts.
  dynamics::Pose pose_afloat() const;
  /// The block's edges, or those of a vessel without one.
  const std::vector<LoadEdge>& all_edges() const { return model ? model->edges : edges; }
};

}  // namespace given

/// An edge of the load that a rope may touch.
struct EdgeOnTheWay {
  Located<std::string> edge;
  Located<int> span{1, {}};  ///< of the rope, from 1: between `from` and the first of `through`
};

/// Where a rope begins, turns or ends: a hook (`C1.upper_1`), a lug (`L1`), an eye of a spreader
/// (`B1.upper_a`), or any point of a body.
struct RopePoint {
  Located<std::string> name;  ///< of the hook, lug or eye; empty where `body` is given
  std::optional<Located<std::string>> body;  ///< "world", "load", "C1.gantry", "C1.upper_1"
  Vector3 point = Vector3::Zero();           ///< in the body's frame, m
};

/// What a rope point is after its names have been looked up.
struct ResolvedPoint {
  enum class Kind { world, load, crane_body, hook, vessel, spreader } kind = Kind::world;
  std::size_t crane = 0;  ///< index of the crane, for crane_body and hook
  std::string part;       ///< name of the body or hoist within the crane, of the vessel or spreader
  std::string lug;        ///< name of the lug, if the point is one
  Vector3 point = Vector3::Zero();  ///< in the body's frame, m

  /// Name of the body in the lift: "world", "load", "C1.gantry", "C1.upper_1".
  std::string body_name(const std::vector<given::Crane>& cranes) const;
};

namespace given {

/// A rope, sling or line of the lift.
struct Rope {
  Located<std::string> name;
  Located<RopePoint> from;
  std::vector<Located<RopePoint>> through;
  Located<RopePoint> to;
  std::vector<ResolvedPoint> path;  ///< from, through, to; empty if a name could not be found
  RopeChoice rope_choice;
  RopeModel rope;                                                  ///< after the look-up
  Located<double> length;                                          ///< unstretched, at the start, m
  double end_stiffness = std::numeric_limits<double>::infinity();  ///< in series, N/m
  std::optional<DriveLimits> winch;  ///< of its own, at the `from` end
  /// At each of the sheaves between its ends: mu, or what the tension keeps over half a turn.
  /// Neither: they have no friction.
  std::optional<Located<double>> sheave_friction, sheave_efficiency;
  /// Of the least hook, pin, trunnion or sheave that it is bent round, m; none: it is not bent.
  std::optional<Located<double>> bend_diameter;
  std::vector<EdgeOnTheWay> over;  ///< edges of the load, in the order of its path
  std::vector<LoadEdge> edges;     ///< the same after the look-up; empty if a name was not found

  /// The lug at its end, empty if it ends elsewhere.
  std::string lug() const { return path.empty() ? std::string() : path.back().lug; }
  /// The least of its bend_diameter and the rounds of edges that it may touch, m.
  std::optional<double> least_bend() const;
  /// mu at its sheaves, whichever way it was given; zero: none.
  double friction() const;
  /// Does it go round edges of the load from above and back, without a lug?
  bool is_basket() const {
    return !edges.empty() && !path.empty() && path.front().lug.empty() && path.back().lug.empty();
  }
  /// Does it end at a lug or at a spreader, or hold the load as a basket?
  bool is_sling() const {
    return !path.empty() && (!path.back().lug.empty() ||
                             path.back().kind == ResolvedPoint::Kind::spreader || is_basket());
  }
  /// Is it a sling from above to that spreader?
  bool ends_at_spreader(const std::string& spreader) const {
    return !path.empty() && path.back().kind == ResolvedPoint::Kind::spreader &&
           path.back().part == spreader && !is_basket();
  }
};

/// A figure that a law from outside sees: one of height, plumb, tension and share.
struct Sight {
  Located<std::string> name;
  std::optional<Located<RopePoint>> level;    ///< whose height it is
  std::optional<Located<RopePoint>> with;     ///< over this point's; none: in the world
  std::optional<Located<std::string>> head;   ///< hoist whose upper sheave is plumb or not
  std::optional<Located<RopePoint>> over;     ///< over this point
  std::optional<Located<std::string>> pull;   ///< rope, or hoist whose tackle it is
  std::optional<Located<std::string>> share;  ///< rope or hoist, of what it and `of` pull
  std::vector<Located<std::string>> of;       ///< the other ropes
  Mark place;
  // After the look-up; none if it failed.
  std::optional<ResolvedPoint> level_at, with_at, head_at, over_at;
};

/// What an operator who steers a drive keeps, after what he sees: one wish, or a law from outside.
struct Keep {
  std::optional<Located<RopePoint>> level;  ///< whose height a winch keeps
  std::optional<Located<RopePoint>> with;   ///< against this point's; none: in the world
  /// Of `level` over `with`, m. None: 0 with `with`, else as it is when the keeping begins.
  std::optional<Located<double>> above;
  std::optional<Located<std::string>> head;  ///< hoist whose upper sheave a joint's drive keeps
  std::optional<Located<RopePoint>> over;    ///< plumb over this point
  std::optional<Located<double>> tension;    ///< of the winch's own rope, N
  std::optional<Located<double>> share;      ///< of what it and the ropes `of` pull together
  std::vector<Located<std::string>> of;      ///< ropes, or hoists whose tackle it is
  std::optional<Located<double>> stiffness;  ///< of a pull against letting out, N/m
  double reaction = 0;                       ///< s
  /// Time in which he would take away what he sees, s; none: the usual one.
  std::optional<Located<double>> correction;
  std::optional<Located<Quantity>> tolerance;
  std::optional<Located<std::string>> law;  ///< name of a law from outside (LiftCase::laws)
  std::vector<Sight> sees;                  ///< what it is given
  std::optional<double> every;              ///< time between two of its looks, s; none: the usual
  Mark place;
  // After the look-up; none if it failed.
  std::optional<ResolvedPoint> level_at, with_at, head_at, over_at;

  static constexpr double usual_correction = 5.0;  ///< s
  double correction_time() const { return correction ? correction->value : usual_correction; }
};

/// Moves of one or several drives or winches, alike.
struct Move {
  std::vector<Located<std::string>> drives;
  std::optional<Located<Quantity>> by;
  std::optional<Located<Quantity>> to;
  std::optional<Located<Quantity>> speed;
  std::optional<Located<Quantity>> acceleration;
  std::optional<Located<Quantity>> jerk;
  std::optional<Located<double>> duration;  ///< s
  double delay = 0;                         ///< after the stage's start, s
  std::optional<Located<std::string>> follows;
  /// Own travel over the leader's travel, both since the start of the leader's move.
  std::optional<Located<std::vector<std::array<Quantity, 2>>>> table;
  std::optional<Keep> keeps = {};  ///< in place of a motion that is known
  Mark place;
};

}  // namespace given

/// What ends a stage: one of the conditions, and how long it may take.
struct StageUntil {
  std::optional<Located<std::string>> slack;       ///< rope, or hoist whose tackle it is
  std::optional<Located<std::string>> taut;        ///< rope, or hoist whose tackle it is
  std::optional<Located<double>> ropes_at_least;   ///< share of the load's weight that they bear
  std::optional<Located<double>> ropes_at_most;    ///< share that they bear no more
  std::optional<Located<double>> ground_at_least;  ///< share that pads and ground bear
  double reaction = 0;           ///< from the instant to that at which drives begin to stop, s
  std::optional<double> within;  ///< from the stage's start, s; none: until its moves end
  Mark place;
};

namespace given {

/// A stage of the operation: its moves begin together, each after its own delay.
struct Stage {
  Located<std::string> name;
  double pause = 0;  ///< before the stage, s
  std::vector<Move> moves;
  std::optional<StageUntil> until = {};  ///< none: it ends with the last of its moves
};

/// What goes wrong at an instant: ropes part, drives come to a stand, winches run away.
struct Fault {
  std::optional<Located<double>> at;  ///< of the operation, s; none: at the worst instant
  /// Ropes and hoists of which one then carries the most of its breaking load, or "all".
  std::vector<Located<std::string>> worst_for;
  std::optional<Located<double>> from, to;      ///< between which the worst instant is sought, s
  double watched = 0;                           ///< behind a tried instant, s
  std::vector<Located<std::string>> parts;      ///< ropes, or hoists whose tackle it is
  std::vector<Located<std::string>> stops;      ///< drives and winches, or "all"
  std::vector<Located<std::string>> runs_away;  ///< winches
  std::optional<double> speed;                  ///< at which they pay out, m/s
  std::optional<double> caught_after;           ///< s
  double within = 0;  ///< in which drives come to a stand and winches to their speed, s
  Mark place;
};

/// A pad on which the load stands at the start, and from which it lifts off.
struct Support {
  Located<std::string> name;
  Vector3 point = Vector3::Zero();  ///< of the load, in the block's frame, m
  double ground = 0;                ///< height of the ground, m
  double stiffness = std::numeric_limits<double>::quiet_NaN();  ///< N/m
  double damping = 0;                                           ///< N s/m
  double friction_coefficient = 0;
  double tangential_stiffness = 0;  ///< N/m
  std::optional<double> reach;      ///< level, beyond which there is no pad, m
};

/// Ground that bears the load wherever it is set down.
struct Ground {
  double stiffness = std::numeric_limits<double>::quiet_NaN();  ///< at each corner, N/m
  double damping = 0;                                           ///< N s/m
  double friction_coefficient = 0;
  double tangential_stiffness = 0;  ///< N/m
  Mark place;
};

}  // namespace given

/// How the block gives way where the ropes pull at it.
enum class Flexibility {
  rigid,    ///< not at all
  static_,  ///< at once, by the compliance of its lugs
  modal     ///< by natural modes that vibrate, the rest at once
};

struct DynamicsSettings {
  double relative_tolerance = 0;
  double sample_interval = 0;  ///< s
  double static_interval = 0;  ///< s
  Flexibility flexibility = Flexibility::rigid;
  std::optional<Located<int>> elastic_modes = {};     ///< where the flexibility is modal
  std::optional<Located<double>> modal_damping = {};  ///< of each, over the critical one

  int mode_count() const { return elastic_modes ? elastic_modes->value : 10; }
  double mode_damping() const { return modal_damping ? modal_damping->value : 0.01; }
};

/// How the wear by repeated lifts is judged.
struct FatigueSettings {
  std::string curve = "F";  ///< detail category of DNV-RP-C203, in air
  double stress_concentration = 1;
  std::string hot_spot_curve = "D";  ///< for structural stress at weld toes
  double lifts = 1;
};

struct StructureSettings {
  int element_degree = 0;
  double largest_element = 0;   ///< m
  double accuracy = 0.03;       ///< of the checked stress and of its increase, share
  int most_unknowns = 1000000;  ///< that are spent on it
  std::vector<Named<Vector3>> stress_points{};  ///< whose stress is followed in time, in B, m
  FatigueSettings fatigue{};
  std::vector<given::HotSpot> hot_spots{};  ///< weld toes of the block, in B
};

struct CheckSettings {
  double rope_safety_factor = 0;
  bool crane_capacity = false;
  double yield_factor = 0;
  double lug_consequence_factor = 0;      ///< on forces and stresses of padeyes
  double lug_side_load = 0;               ///< least force along a padeye's pin, share of the rope's
  std::optional<double> buckling_factor;  ///< absent: yield_factor
  std::optional<Located<double>> spreader_factor;  ///< absent: yield_factor
  double smallest_tension = 0;                     ///< N
  std::optional<double> largest_swing;             ///< rad
  /// Of hook blocks that turn, rad; absent: a quarter of a turn.
  std::optional<Located<double>> largest_falls_twist;
  // Of the lift's measures; absent: not checked.
  std::optional<double> largest_tilt;                 ///< of the load, rad
  std::optional<double> largest_turn;                 ///< of the load about the plumb, rad
  std::optional<double> smallest_sling_angle;         ///< against the level, rad
  std::optional<Located<double>> largest_offlead;     ///< rad
  std::optional<Located<double>> largest_sidelead;    ///< rad
  std::optional<double> smallest_clearance;           ///< m
  std::optional<double> smallest_righting_height;     ///< m
  std::optional<Located<double>> largest_heel;        ///< of vessels, rad
  std::optional<Located<double>> smallest_freeboard;  ///< of vessels, m
};

/// A published or measured pair of largest loads, N.
struct PublishedLoads {
  std::optional<double> static_load;
  std::optional<double> dynamic_load;
};

/// A measured tension over time.
struct MeasuredSeries {
  Located<std::string> file;         ///< CSV: time in s, tension
  double unit = 0;                   ///< of the tension in the file, N
  double offset = 0;                 ///< of the measurement's clock behind the operation's, s
  std::vector<double> time = {};     ///< after the file has been read, s of the operation
  std::vector<double> tension = {};  ///< N
};

/// Published or measured figures that are shown beside the computed ones.
struct Comparison {
  std::string source;
  std::vector<Named<PublishedLoads>> ropes;
  std::vector<Named<MeasuredSeries>> series;   ///< by rope
  std::optional<double> stress_increase;       ///< as a ratio
  std::optional<double> deformation_increase;  ///< as a ratio
};

/// Lug forces given outright in place of a simulated lift.
struct LoadTable {
  /// Direction of the pull in the block's frame, unit: one for all lugs, or one for each.
  std::variant<Vector3, std::vector<Named<Vector3>>> direction;
  std::vector<Named<double>> static_loads;   ///< by lug, N
  std::vector<Named<double>> dynamic_loads;  ///< by lug, N
  Mark place;

  /// The unit direction of the pull at a lug.
  Vector3 direction_at(const std::string& lug) const;
};

namespace given {

/// What the report says of itself as a document: text as it is given, empty where it is not.
struct Document {
  std::string project;
  std::string client;
  std::string revision;
  std::string prepared;  ///< by whom, as are the next two
  std::string checked;
  std::string approved;
};

}  // namespace given

/// A model file as it stands, with the name that a case, or a model of it, calls it by.
struct ModelText {
  std::string name;
  std::string text;
};

/// Makes a law from outside anew, which is given figures of these names in their order: its drive's
/// `position` and `speed`, then what it `sees`.
using LawMaker = std::function<dynamics::SpeedLaw(const std::vector<std::string>& figures)>;

/// A lift case: what is lifted, by what, how, and what is asked. SI units.
struct LiftCase : MarineParts {
  std::string name;
  std::string title;
  given::Document document;
  double gravity = std::numeric_limits<double>::quiet_NaN();  ///< m/s^2
  given::Load load;
  std::vector<given::Crane> cranes;
  std::vector<given::Spreader> spreaders;
  std::vector<given::Rope> ropes;
  std::optional<Located<bool>> rope_weight;  ///< do ropes hang by their weight?
  double sling_tolerance = 0;                ///< share of a sling's length by which it may be off
  std::vector<given::Support> supports;
  std::optional<double> ground;  ///< height of the ground or a dock's floor under the load, m
  std::optional<given::Ground> ground_contact;
  std::optional<given::Wind> wind;
  std::vector<given::Stage> operation;
  double settle = 0;  ///< after the last move, s
  std::vector<given::Fault> faults;
  DynamicsSettings dynamics;
  StructureSettings structure;
  CheckSettings checks;
  std::optional<given::Standard> standard;
  std::optional<Comparison> compare;
  std::optional<LoadTable> load_table;
  Mark place;
  std::string yaml;                    ///< the case file as it stands, or as it was changed
  std::filesystem::path file;          ///< where it is
  std::vector<ModelText> model_texts;  ///< of the models that it is made of
  /// Laws by which drives are steered, by the names of `keeps: law`: not from the file, but given
  /// by the program that this one is part of.
  std::map<std::string, LawMaker> laws = {};

  /// Does a rope hang as a catenary by the mass of its model? Ropes over sheaves run straight.
  bool hangs(const given::Rope& rope) const;
  /// Does the tackle of a crane's hoist? One that is equalised runs straight.
  bool hangs(const given::Crane& crane, const HoistModel& hoist) const;
  /// Is the load a block whose stress is asked?
  bool has_structure() const { return load.model != nullptr; }
  /// Height of the ground ashore, m: as given, else that of the lowest pad or zero; none at sea.
  std::optional<double> ground_height() const;
  const given::Crane* find_crane(const std::string& name) const;
  const given::Rope* find_rope(const std::string& name) const;
  const given::Spreader* find_spreader(const std::string& name) const;
  /// The hook that a rope hangs on by its first point, "C1.main": at once, or by way of spreaders
  /// whose slings from above all hang on the same. Empty if it hangs on none, or on several.
  std::string hook_above(const given::Rope& rope) const;
};

/// The keys of a rope; its points are given as the file at hand gives them.
Format<given::Rope> rope_in_case_format(const Format<Located<RopePoint>>& point,
                                        bool breaking_load_required);
/// A stage of an operation; shared with mechanism files.
/// @param may_wait may it end by a condition? Of a lift case it may.
Format<given::Stage> stage_format(bool may_wait);

/// The format of a case file, without the look-up of models.
Format<LiftCase> lift_case_format();

/// Reads a case file, the models that it names, and checks all of it together.
///
/// @param path the file, or a folder with a `case.yaml` in it.
/// @returns the case only if nothing is wrong with it; else the complaints are in `diagnostics`.
std::optional<LiftCase> read_lift_case(const std::filesystem::path& path, ModelLibrary& library,
                                       Diagnostics& diagnostics);

/// The same, with the models of the installation.
/// @param changes keys of its files that are to have other values.
/// @throws InputError with all complaints.
LiftCase read_lift_case(const std::filesystem::path& path, std::vector<KeyChange> changes = {});

}  // namespace blocklift::pipeline

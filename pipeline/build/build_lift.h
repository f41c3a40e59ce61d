#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "dynamics/simulation/held_heading.h"
#include "dynamics/simulation/lift_system.h"
#include "pipeline/build/build_marine.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/lift_case/operation_schedule.h"

namespace blocklift::pipeline {

/// Mass, centre of mass and inertia of the load in its own frame B. They come from the block's
/// mesh, so that dynamics and structure have one source.
struct LoadMass {
  double mass = dynamics::not_a_number;                ///< kg
  Vector3 p_BoBcm_B = Vector3::Zero();                 ///< centre of mass, m
  Eigen::Matrix3d I_BBcm_B = Eigen::Matrix3d::Zero();  ///< about the centre of mass, kg m^2
};

/// How the load gives way at its lugs (structure::LugFlexibility): 3 rows a lug, in the order of
/// `lugs`.
struct LoadFlexibility {
  std::vector<std::string> lugs;
  Eigen::MatrixXd compliance;           ///< that follows at once, m/N
  Eigen::MatrixXd shapes;               ///< a column a mode, normalised to the load's mass
  Eigen::VectorXd angular_frequencies;  ///< of the modes, rad/s
  double damping_ratio = 0;             ///< of each, over the critical one
};

/// A hoist of the lift within the dynamics.
struct LiftHoist {
  std::string name;               ///< "C1.upper_1": of the hoist, its tackle, and its hook block
  std::size_t crane = 0;          ///< index in the case
  int rope = -1;                  ///< its tackle's index in the system; equalised hoists share it
  dynamics::BodyIndex hook = -1;  ///< its hook block; of one with a bearing the hook below that
  /// Does the tackle's rope begin, not end, at the hook block? One rope over two hooks does.
  bool hook_is_first = false;
  double capacity = dynamics::not_a_number;       ///< largest load at the hook, N
  double breaking_load = dynamics::not_a_number;  ///< of the tackle, all falls, N
};

/// An edge of the load that a rope of the case may touch, in the order of the rope's definition.
struct LiftEdge {
  std::string name;
  double length = dynamics::not_a_number;          ///< m
  double radius = 0;                               ///< m
  double contact_length = dynamics::not_a_number;  ///< m, see LoadEdge
  double friction = 0;                             ///< mu; 0: smooth
};

/// A rope of the case within the dynamics.
struct LiftRope {
  std::string name;
  int rope = -1;          ///< index in the system
  std::string lug;        ///< that it ends at; empty if none
  std::string first_lug;  ///< that it begins at; empty if none
  /// On whose hook it hangs, at once or by way of spreaders; empty if on none, or on several.
  std::string hoist;
  double breaking_load = dynamics::not_a_number;  ///< N
  std::vector<LiftEdge> edges = {};               ///< that it may touch

  /// Does it hold the load, at a lug or by its edges?
  bool holds_load() const { return !lug.empty() || !edges.empty(); }
};

/// A spreader of the case within the dynamics.
struct LiftSpreader {
  /// An end of a rope at the bar.
  struct End {
    int rope = -1;                      ///< index in the system
    bool last = false;                  ///< the rope ends here, else it begins here
    bool from_above = false;            ///< the bar hangs on the rope, else what is below does
    Vector3 p_BoQ_B = Vector3::Zero();  ///< from the bar's middle, in its frame, m
  };
  std::string name;
  dynamics::BodyIndex body = -1;
  std::vector<End> ends;
};

/// Where a hoist's tackle leaves its upper sheaves; of twin falls the middle between them.
dynamics::BodyPoint upper_sheave(const dynamics::Rope& tackle, const LiftHoist& hoist);

/// Index in the system of the rope of that name, or of the hoist's tackle.
/// @throws dynamics::ModelError if there is none.
int find_rope(const std::vector<LiftRope>& ropes, const std::vector<LiftHoist>& hoists,
              const std::string& name);

/// A drive of the lift that keeps something, and what.
struct LiftSteering {
  std::string drive;  ///< "C2.traverse", "R7"
  dynamics::Wish wish;
  double start = 0;  ///< s
  double end = 0;    ///< s
};

/// A body of the lift for the drawing: which boxes stand for it.
struct LiftBody {
  std::string name;  ///< "C1.gantry", "C1.upper_1", "load"
  std::string kind;  ///< "crane", "vessel", "hook block", "spreader", "load"
  dynamics::BodyIndex body = -1;
  std::vector<BoxShape> boxes;
};

/// The instant at which a fault is worst, among those that were tried.
struct WorstInstant {
  /// A tried instant, and the rope or hoist that carries the most of its breaking load then.
  struct Trial {
    double time = 0;   ///< s
    double share = 0;  ///< largest tension behind it over the breaking load
    std::string rope;
    double peak_time = 0;  ///< s, of that tension
  };
  Trial worst;
  Trial undisturbed;          ///< the same without the fault, over the whole operation; time is 0
  std::vector<Trial> trials;  ///< in order of time
};

/// The dynamics of a lift case and where its parts are in it.
struct BuiltLift {
  dynamics::LiftSystem system;
  dynamics::BodyIndex load = -1;
  std::vector<LiftBody> bodies;
  std::vector<LiftHoist> hoists;        ///< in the order of cranes and their hoists
  std::vector<LiftRope> ropes;          ///< in the order of the case
  std::vector<LiftSpreader> spreaders;  ///< in the order of the case
  Schedule schedule;
  std::vector<LiftSteering> steerings;  ///< in the order of the operation
  /// The same lift without waves and in mean wind, where there are waves or gusts.
  std::optional<dynamics::LiftSystem> calm = {};
  /// The water's surface that is marched beside `system`; none: its water has a memory of its own,
  /// or there is none.
  MarchedWater marched = {};
  /// What the water of `system` was computed for; empty where vessels make no waves.
  dynamics::Arrangement arrangement = {};
  /// Sentences about how far the radiation of its vessels is to be trusted.
  std::vector<std::string> doubts_of_water = {};
  /// Of the fault that comes at its worst instant, if there is one.
  std::optional<WorstInstant> worst = {};

  /// Of a load that turns on one hook, which nothing but wind does: at rest it is held as the case
  /// has it.
  std::optional<dynamics::HeldHeading> held_heading = {};

  /// The lift whose static equilibria are asked.
  const dynamics::LiftSystem& at_rest() const { return calm ? *calm : system; }
};

/// What is to be computed for the case's vessels before it is built; no bodies: nothing.
RadiationProblem radiation_problem(const LiftCase& lift_case);

/// Builds the dynamics of a sound lift case.
///
/// Bodies are named "C1.gantry", hook blocks as their hoists ("C1.upper_1"), the block "load". A
/// hook block is a body on a translational joint to the world, its tackle a rope from the sheave to
/// its centre; of those that turn hook_bodies and hang_twin_falls tell. Tackles of equalised hoists
/// are one rope, from hook block to hook block, which leaves out what lies between the sheaves. The
/// load and spreaders are free; its start and that of the hook blocks (plumb below their sheaves,
/// by the unstretched length) are guesses from which the equilibrium is found.
///
/// A load with a vessel floats by the vessel's hull where it reaches the water: buoyancy, wave
/// pressure and damping, and with draughts the water that it sets in motion.
///
/// @param radiation of radiation_problem(), or `marched` made of it; neither: vessels make no
/// waves.
/// @param flexibility of the load; null: it is rigid. Its modes are the mechanism's elastic modes
///   "load.mode_1", ..., see dynamics::ElasticBody.
/// @param found of the operation by running it; see schedule_operation.
/// @throws InputError if moves do not fit behind those instants.
/// @throws std::invalid_argument if the case is a load table, which has no dynamics.
/// @throws dynamics::ModelError if the parts do not make a lift; a case that was read without
///   complaints does.
BuiltLift build_lift(const LiftCase& lift_case, const LoadMass& load,
                     const dynamics::HydrodynamicSeries* radiation = nullptr,
                     const LoadFlexibility* flexibility = nullptr, MarchedWater marched = {},
                     const FoundMotion& found = {});

/// Mass, centre of mass and inertia of a load that is a vessel.
LoadMass load_mass(const VesselModel& vessel);

}  // namespace blocklift::pipeline

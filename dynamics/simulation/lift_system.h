#pragma once

#include <optional>
#include <tuple>
#include <type_traits>

#include "dynamics/force/applied_load.h"
#include "dynamics/force/joint_friction.h"
#include "dynamics/force/linear_restraint.h"
#include "dynamics/force/spring.h"
#include "dynamics/force/support.h"
#include "dynamics/force/torsional_spring.h"
#include "dynamics/force/wind.h"
#include "dynamics/force/wind_load.h"
#include "dynamics/marine/loads/current_load.h"
#include "dynamics/marine/loads/diffraction_force.h"
#include "dynamics/marine/loads/hull_force.h"
#include "dynamics/marine/loads/linear_buoyancy.h"
#include "dynamics/marine/loads/radiated_water.h"
#include "dynamics/marine/loads/slow_drift.h"
#include "dynamics/marine/loads/viscous.h"
#include "dynamics/multibody/constrained_dynamics.h"
#include "dynamics/multibody/forward_dynamics.h"
#include "dynamics/rope/elastic_body.h"
#include "dynamics/rope/mooring_line.h"
#include "dynamics/rope/rope_split.h"
#include "dynamics/simulation/forecast_forces.h"
#include "dynamics/simulation/operation.h"

namespace blocklift::dynamics {

/// The kinds of force elements; a new kind is entered here and nowhere else.
using ForceElements =
    std::tuple<std::vector<PointSpring>, std::vector<JointSpring>, std::vector<TorsionalSpring>,
               std::vector<WindArea>, std::vector<WindLoad>, std::vector<HullForce>,
               std::vector<DiffractionForce>, std::vector<SlowDrift>, std::vector<CurrentLoad>,
               std::vector<MorisonMember>, std::vector<QuadraticDamping>, std::vector<MooringLine>,
               std::vector<TuggerLine>, std::vector<AppliedLoad>, std::vector<JointLoad>,
               std::vector<LinearRestraint>, std::vector<LinearBuoyancy>,
               std::vector<JointFriction>>;

/// What water and waves do to hulls is evaluated apart from the other elements: these forces cost
/// the most, and serve the works too.
template <class Element>
inline constexpr bool is_hull_force = std::is_same_v<std::remove_cvref_t<Element>, HullForce>;
template <class Element>
inline constexpr bool is_scattering =
    std::is_same_v<std::remove_cvref_t<Element>, DiffractionForce>;

/// Tugger lines are evaluated apart, too: they are contacts.
template <class Element>
inline constexpr bool is_tugger_line = std::is_same_v<std::remove_cvref_t<Element>, TuggerLine>;

/// Kinds whose forces the workspace holds.
template <class Element>
inline constexpr bool is_evaluated_apart =
    is_hull_force<Element> || is_scattering<Element> || is_tugger_line<Element>;

/// Calls `function` with each element of every kind.
template <class Function>
void for_each_element(const ForceElements& elements, Function&& function) {
  std::apply(
      [&](const auto&... kinds) {
        const auto each = [&](const auto& kind) {
          for (const auto& element : kind) function(element);
        };
        (each(kinds), ...);
      },
      elements);
}

/// All that a lift consists of, before it is checked.
struct LiftDefinition {
  Mechanism mechanism;
  std::vector<Rope> ropes = {};
  std::vector<SupportPad> supports = {};
  ForceElements elements = {};
  Operation operation;
  Eigen::VectorXd q_start;       ///< nq; driven coordinates are exact, the others may be a guess
  Eigen::VectorXd v_start = {};  ///< nv; empty: at rest
  /// What floating bodies radiate; null: nothing.
  std::shared_ptr<const RadiatedWater> water = {};
  /// Bodies that give way where ropes pull at them; a rope ends at one of them at most.
  std::vector<ElasticBody> elastic_bodies = {};
};

/// Mechanism, force elements, ropes and operation: an immutable model of a lift, and the layout of
/// its state.
///
/// State y = (q_free, v_free, x): the coordinates and velocities that no drive prescribes, in the
/// order of the mechanism, and the memory of the water that floating bodies radiate; y has nq_free
/// + nv_free + memory_count entries. The driven ones follow from the time. Ropes, support pads and
/// tugger lines are one-sided: each acts or does not act, and changes at an instant. `Contacts`
/// says which act, ropes first, then pads, then tugger lines. Loops of the mechanism tie the free
/// coordinates together; the state keeps all of them, and whoever moves it brings it back onto the
/// loops (LoopProjector). Lengths and offsets of loops that are left open are taken from q_start.
class LiftSystem {
 public:
  /// A driven joint without a drive in the operation stands still where q_start has it.
  /// @throws ModelError if sizes do not fit, two ropes share a name, a winch has no rope, or an
  ///   elastic mode of the mechanism is not one of exactly one elastic body.
  explicit LiftSystem(LiftDefinition definition);

  const Mechanism& mechanism() const { return d_.mechanism; }
  const std::vector<Rope>& ropes() const { return d_.ropes; }
  const std::vector<SupportPad>& supports() const { return d_.supports; }
  const ForceElements& elements() const { return d_.elements; }
  const std::vector<TuggerLine>& tugger_lines() const {
    return std::get<std::vector<TuggerLine>>(d_.elements);
  }
  const std::vector<ElasticBody>& elastic_bodies() const { return d_.elastic_bodies; }
  /// Does an end of the rope lie at an elastic body?
  bool ends_elastically(int rope) const { return ends_elastically_[rope] != 0; }
  const Operation& operation() const { return d_.operation; }
  const Eigen::VectorXd& q_start() const { return d_.q_start; }
  const Eigen::VectorXd& v_start() const { return d_.v_start; }

  int nq_free() const { return nq_free_; }
  int nv_free() const { return nv_free_; }
  /// What floating bodies radiate; null: nothing.
  const RadiatedWater* water() const { return d_.water.get(); }
  int memory_count() const { return d_.water ? static_cast<int>(d_.water->state_count()) : 0; }
  int state_size() const { return nq_free_ + nv_free_ + memory_count(); }
  /// Number of one-sided elements: ropes, then support pads, then tugger lines.
  int contact_count() const {
    return static_cast<int>(d_.ropes.size() + d_.supports.size() + tugger_lines().size());
  }
  /// Index of a rope by its name, for set-up.
  /// @throws ModelError if there is none; the message lists those that exist.
  int rope_index(std::string_view name) const;

 private:
  LiftDefinition d_;
  int nq_free_ = 0;
  int nv_free_ = 0;
  std::vector<char> ends_elastically_;
};

/// Which one-sided elements act: an entry for each rope (taut?), then for each pad (loaded?), then
/// for each tugger line (taut?).
using Contacts = std::vector<char>;

/// Force of a water surface that is marched in steps, between two of them: a cubic in time.
struct MarchedForce {
  /// Of the powers 0 to 3 of (t - from) / step, 6N x 4; of no rows: there is no such surface.
  Eigen::Matrix<double, Eigen::Dynamic, 4> coefficients;
  double from = 0.0, step = 1.0;  ///< s

  /// force += that at a time (s). Does not allocate.
  void add_to(double time, VectorRef force) const {
    if (coefficients.rows() == 0) return;
    const double s = (time - from) / step;
    force.noalias() += coefficients * Vector4(1.0, s, s * s, s * s * s);
  }
};

/// Everything that one evaluation of a lift system writes; made once, used again without
/// allocation. One thread each.
struct LiftWorkspace {
  explicit LiftWorkspace(const LiftSystem& system);

  Eigen::VectorXd q, v, vdot, rates;  ///< whole vectors: free and driven, nq, nv, nv, nq
  Eigen::VectorXd joint_force;        ///< nv; driven entries: what the drive must give, N or N m
  Kinematics kinematics;
  Loads loads;
  ForwardDynamicsWorkspace dynamics;
  std::optional<ConstrainedDynamicsWorkspace> loops;  ///< where the mechanism has loops
  /// Where water ties floating bodies together and there are no loops.
  std::optional<ConstrainedDynamicsWorkspace> tied;
  Eigen::VectorXd memory;                       ///< x: states of the radiated water
  Eigen::VectorXd memory_rate;                  ///< dx/dt
  Eigen::VectorXd water_velocity;               ///< of RadiatedWater's frames in their own axes, 6N
  Eigen::VectorXd level_velocity, water_force;  ///< in their level axes, of the memory, 6N each
  DraughtShares water_shares;                   ///< of the draughts of a body that is lowered
  Eigen::VectorXd entry_force;                  ///< on the frames, of water that it takes up, 6N
  MarchedForce marched;                         ///< of a surface that is marched beside
  std::vector<ForceVector> F_Bo_W_of_hulls;     ///< of each HullForce, by the last calc_hull_forces
  /// Rows of the loops to be enforced off the constraint; none: all, judged at each state anew.
  std::optional<LoopRows> loop_rows;
  std::vector<RopeFeed> feeds;  ///< for each rope; which have parted the integration says
  /// For each steered drive, what it goes besides its own motion; a Steersman sets them.
  std::vector<MotionProfile> steered;
  std::vector<RopeLoad> rope_loads;
  std::vector<SupportLoad> support_loads;
  std::vector<TuggerLoad> tugger_loads;
  std::vector<Vector3> standing_places;  ///< of each pad, m: p_WG, or where ground was touched
  /// For each rope; those of ropes without friction do nothing. They act where the integration has
  /// begun them: equilibria and natural modes are those without friction.
  std::vector<RopeSplit> splits;
  RopePath path;                                 ///< of the rope evaluated last
  std::vector<RopeEndShifts> end_shifts;         ///< for each rope; zero at rigid bodies
  std::vector<ElasticBody::Workspace> elastic;   ///< for each elastic body
  std::vector<ForceVector> F_R_W_of_scattering;  ///< of each DiffractionForce, as of the hulls
  /// What waves do to the hulls and DiffractionForces, in this order; a WaveForecast carries it on.
  ForecastForces forecast;

  /// Inertia of the water; null: there is none.
  const AddedInertiaWorkspace* added() const {
    if (loops && loops->added) return &*loops->added;
    return tied ? &*tied->added : nullptr;
  }
  /// The parts of it that elastic bodies read and write.
  ElasticBody::Ropes ropes(const LiftSystem& system, const Contacts* contacts);
};

/// q, v of the driven joints, their vdot, and the ropes' feeds at a time into the workspace.
/// @param moving false: positions only, all rates zero (static equilibrium).
void set_drives(const LiftSystem& system, double t, bool moving, LiftWorkspace& w);

/// Free coordinates and velocities and the water's memory of a state into the workspace.
void set_state(const LiftSystem& system, ConstVectorRef y, LiftWorkspace& w);
/// Free coordinates and velocities of whole vectors q and v into a state; its memory stays as it
/// is.
void get_state(const LiftSystem& system, ConstVectorRef q, ConstVectorRef v, VectorRef y);

/// Pads that are ground go along, at the workspace's kinematics and loads: those that carry nothing
/// will stand where they are now, and those that have slid are held from as far behind as the
/// friction's stiffness takes to its limit. Forces stay as they are.
void carry_pads_along(const LiftSystem& system, LiftWorkspace& w);
/// The pad stands where its point is now, at the workspace's kinematics, if it is ground.
void set_down_pad(const LiftSystem& system, std::size_t pad, LiftWorkspace& w);

/// Kinematics of the workspace's q, v and feeds, and the loads of ropes, elastic bodies, pads and
/// tugger lines alone: all that calc_contact_indicators asks for. `contacts` as below.
void calc_contact_loads(const LiftSystem& system, const Contacts* contacts, LiftWorkspace& w);

/// Are hulls' forces, which cost the most, to be found anew, or are those of the workspace good
/// enough?
enum class HullForces { evaluated, kept };

/// Forces on the hulls, w.F_Bo_W_of_hulls and w.F_R_W_of_scattering, at the workspace's kinematics;
/// what waves do is taken from w.forecast where that covers the time (WaveForecast).
void calc_hull_forces(const LiftSystem& system, double t, LiftWorkspace& w);
/// What the memory of the radiated water does, w.water_force, at the workspace's kinematics, with
/// its velocities and shares.
void calc_water_forces(const RadiatedWater& water, double t, LiftWorkspace& w);

/// Kinematics and loads of the workspace's q, v and feeds. `contacts`: which one-sided elements
/// act; null: each as its own law says.
void calc_loads(const LiftSystem& system, double t, const Contacts* contacts, LiftWorkspace& w,
                HullForces hulls = HullForces::evaluated);
/// Accelerations (w.vdot), drive forces (driven entries of w.joint_force) and multipliers of loops
/// of what calc_loads has left. Drive forces that are unwanted may be left out.
void calc_accelerations(const LiftSystem& system, LiftWorkspace& w,
                        DriveForces drives = DriveForces::wanted);

/// dy/dt at (t, y): the right-hand side. Leaves accelerations (w.vdot), drive forces
/// (driven entries of w.joint_force; if unwanted they may be left out), rope loads and multipliers
/// of loops in the workspace. Does not allocate.
/// @throws ModelError or SimulationError where the geometry is degenerate or the pose singular.
void calc_right_hand_side(const LiftSystem& system, double t, ConstVectorRef y,
                          const Contacts* contacts, LiftWorkspace& w, VectorRef ydot,
                          DriveForces drives = DriveForces::wanted);

/// For each one-sided element a value (kN) that is positive where it acts and negative where it
/// does not, continuous between, of the instant that calc_loads or calc_contact_loads has just
/// evaluated. Size contact_count.
void calc_contact_indicators(const LiftWorkspace& w, VectorRef indicators);

/// Which one-sided elements act at a state. One that is just at the change is judged by where it
/// is going: by its rate, then by its acceleration without it.
Contacts find_contacts(const LiftSystem& system, double t, ConstVectorRef y, LiftWorkspace& w);

/// Which ropes are slack and which carry the most, at the workspace's instant, for error messages.
std::string describe_ropes(const LiftSystem& system, const LiftWorkspace& w);

}  // namespace blocklift::dynamics

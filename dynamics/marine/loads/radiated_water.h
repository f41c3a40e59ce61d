#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "dynamics/marine/loads/draught_shares.h"
#include "dynamics/marine/radiation/hydrodynamic_series.h"
#include "dynamics/marine/radiation/memory_state_space.h"
#include "dynamics/multibody/added_inertia.h"

namespace blocklift::dynamics {

/// The water that the motion of floating bodies radiates, as part of a mechanism: Cummins' equation
///
///   F = -A_inf du/dt - int K(tau) u(t - tau) d tau,
///
/// u being the spatial velocities of frames H. H coincides, when its body lies as the database has
/// it, with the reference point and the axes of the database's world, and moves with the body: what
/// the database holds for small motions about a rest is so carried along by a vessel that is towed
/// or turned. Bodies of one database influence each other as if their distance had not changed.
///
/// A_inf acts implicitly, on the left-hand side, in H's own axes (AddedInertia): the force is the
/// rate of a momentum, in the world R_WH l, and has no mean in any motion that repeats itself. The
/// memory knows velocities and forces in the level axes of H (level_axes.h), which do not roll and
/// pitch: turned with the body its force of heave would have a mean along the water. Both being in
/// the same axes, it is as passive as K is; its force along the water has no mean where the heading
/// is kept and motion repeats itself, for no vessel is braked in steady motion (int K d tau = 0).
///
/// The memory is a linear system of states x with F = -C x and x' = A x + B u (MemoryStateSpace),
/// its states scaled so that each is of the order of the velocity that drives it. It needs no
/// history and takes any step.
///
/// **A body that is lowered** has a database for each of several draughts, the first dry; at its
/// draught d the weights w_k(d) of DraughtInterpolation hold. Added mass is A(d) = sum w_k A_k, and
/// the water's momentum A(d) u: to what is gained in entering it has to be given, F = -d(A u)/dt
/// (von Karman 1929, the impact force V^2 dA/dd), while water that is left behind keeps its
/// velocity and gives no force, F = -A du/dt (Kaplan 1992: no impact on leaving). Half of the work
/// of the former goes into spray, and the latter's energy stays in the water (Molin, Cointe and
/// Fontaine 2004): with dA/dd = S+ - S-, both positive semidefinite, and whatever the sign of
/// dd/dt,
///
///   F = -A du/dt - |dd/dt| S u,    S = S+ in sinking, S- in rising,
///   energy lost: |dd/dt| u (S+ + S-) u / 2  >= 0.
///
/// The memory is one system for each draught beside the others, driven by sqrt(w_k) u and felt by
/// sqrt(w_k) F_k:  K(t, tau) = sum sqrt(w_k(t)) K_k(t - tau) sqrt(w_k(tau)). It is sum w_k K_k at
/// any draught that stays, and gives back no more than each of its parts was given, however the
/// draught changes: as passive as they are. Immutable.
class RadiatedWater {
 public:
  struct Definition {
    /// One for each body of the database, in its order.
    std::vector<BodyFrame> frames;
    std::shared_ptr<const HydrodynamicDatabase> database;
    MemoryFit fit = {};  ///< of memories that the series does not bring
    /// In place of a single database: several, the first of a dry body (draught 0).
    std::shared_ptr<const HydrodynamicSeries> series = {};
    /// Where the draught of the series' lowered body is read.
    DraughtMark mark = {};
  };

  /// @throws ModelError if the bodies are not as many as the database's, or as AddedInertia,
  ///   DraughtInterpolation and MemoryStateSpace.
  explicit RadiatedWater(const Definition& definition);

  /// Water whose memory is marched beside the integration (IntegrationSettings::surface): no
  /// states. `infinite_added_mass` is 6N x 6N in the order of the modes (DegreeOfFreedom).
  /// @throws ModelError as AddedInertia.
  RadiatedWater(std::vector<BodyFrame> frames, const Eigen::MatrixXd& infinite_added_mass);

  /// That of the deepest draught; calc_added_mass says what it is at another.
  const AddedInertia& inertia() const { return inertia_; }
  const std::vector<BodyFrame>& frames() const { return inertia_.frames(); }
  /// Number of states x.
  Eigen::Index state_count() const { return decay_.size(); }
  /// Error of the fitted memory, in the measure of MemoryStateSpace; the largest of all draughts.
  double memory_error() const { return memory_error_; }

  /// Is a body lowered, so that added mass and memory change with its draught?
  bool varies() const { return !steps_.empty(); }
  /// Shares at the bodies' places, with the rate of the draught. Does not allocate.
  DraughtShares find_shares(const Kinematics& kinematics) const;
  /// A(d), 6N x 6N in the order (angular; linear); the frame's own matrix where nothing varies.
  /// Does not allocate.
  void calc_added_mass(const DraughtShares& shares, Eigen::MatrixXd& matrix) const;
  /// Adds the force of the water that is taken up at velocities u. Does not allocate.
  void add_entry_force(const DraughtShares& shares, ConstVectorRef u, VectorRef force) const;
  /// Energy that goes into spray and water left behind, W. Does not allocate.
  double calc_entry_loss(const DraughtShares& shares, ConstVectorRef u) const;

  /// x' from x and u, in level axes. Does not allocate.
  void calc_rate(const DraughtShares& shares, ConstVectorRef x, ConstVectorRef u,
                 VectorRef rate) const;
  /// Memory force on the frames in their level axes (moment; force; 6N) from x. Does not allocate.
  void calc_force(const DraughtShares& shares, ConstVectorRef x, VectorRef force) const;
  /// States of one draught's memory; one section, whatever the draught, where nothing varies.
  struct Section {
    Eigen::Index draught = 0;  ///< which of the shares is its own
    Eigen::Index first = 0, count = 0;
  };
  const std::vector<Section>& sections() const { return sections_; }
  /// (1 - gamma A)^-1 as it stands: on each state its own, and of a pair what the one adds to the
  /// other.
  struct Resolvent {
    Eigen::VectorXd straight, across;
  };
  /// For a gamma (s). Allocates the first time only.
  void calc_resolvent(double gamma, Resolvent& resolvent) const;
  /// x <- (1 - gamma A)^-1 x for the rows of one section, column by column. Does not allocate.
  void apply(const Resolvent& resolvent, const Section& section,
             Eigen::Ref<Eigen::MatrixXd> x) const;
  /// B and C at the shares: x' = A x + B u, F = -C x.
  void calc_input(const DraughtShares& shares, Eigen::MatrixXd& input) const;
  void calc_output(const DraughtShares& shares, Eigen::MatrixXd& output) const;

 private:
  /// From one draught to the next deeper one: all of the change of A, and its parts.
  struct Step {
    Eigen::MatrixXd change, gained, lost;  ///< gained - lost = change
  };
  RadiatedWater(const Definition& definition, const HydrodynamicSeries& series);
  void append(const MemoryStateSpace& memory);
  void scale_states(const Section& section);

  AddedInertia inertia_;
  double memory_error_ = 0.0;
  DraughtMark mark_;
  DraughtInterpolation interpolation_;
  Eigen::MatrixXd dry_;  ///< A of the first state
  std::vector<Step> steps_;
  std::vector<Section> sections_;
  // A is block-diagonal: [decay], or [decay, turn; -turn, decay] where turn is not zero.
  Eigen::VectorXd decay_, turn_;
  Eigen::MatrixXd input_, output_;  ///< B, C of all sections, without their gains
};

/// Index within (angular; linear), body after body, of a mode of the database (DegreeOfFreedom).
inline Eigen::Index place_of_mode(Eigen::Index mode) {
  return modes_per_body * (mode / modes_per_body) + (mode % modes_per_body + 3) % modes_per_body;
}

}  // namespace blocklift::dynamics

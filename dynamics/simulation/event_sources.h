#pragma once

#include <functional>
#include <vector>

#include "dynamics/simulation/time_integration.h"

namespace blocklift::dynamics {

/// How far beside a breakpoint its two sides are looked at (s): further than breakpoints that count
/// as one.
inline constexpr double beside = 2e-6;

/// What changes at instants that the motion brings about: ropes and tugger lines that go slack or
/// taut, pads that are loaded or lift off, bends at which a rope with friction begins to slip or to
/// stick, and the condition that a run waits for.
///
/// Each is a source of events with a value, continuous in time, whose sign says how it stands. It
/// is held to that during a step; where the sign contradicts it, it is switched over, and the
/// integration starts anew behind that instant. In kN, of a bend that slips kN/s:
///
/// | source | value | positive while |
/// |---|---|---|
/// | rope, pad, tugger line | calc_contact_indicators | it acts, as Contacts says |
/// | bend | RopeSplit::indicator | always: behind a change the value is another one |
/// | condition | AwaitedCondition::indicator | it has been met; the integration goes on |
///
/// A change that begins at the very start of a step has no root within it: it is seen by the values
/// at the step's end.
class EventSources {
 public:
  /// Where changes are entered.
  struct Ledger {
    IntegrationResult& result;
    double& dissipated;  ///< work, J
  };
  /// Brings q, v and feeds of the workspace to the integration's state at a time (s).
  using MoveTo = std::function<void(double)>;

  /// @param w of the integration; outlives this, as the others do.
  /// @param awaited null: nothing is.
  EventSources(const LiftSystem& system, const AwaitedCondition* awaited, LiftWorkspace& w,
               MoveTo move_to);

  int count() const { return static_cast<int>(sources_.size()); }
  /// Which ropes, pads and tugger lines act now.
  const Contacts& contacts() const { return contacts_; }
  void set_contacts(Contacts contacts) { contacts_ = std::move(contacts); }
  /// The rope pulls no more. @return Did it?
  bool release(int rope);
  /// Does friction divide a rope anywhere?
  bool has_bends() const { return bends_end_ > contacts_end_; }
  /// From now on friction divides the ropes that have any, from one tension.
  void begin_splits(double t);
  /// At the end of a step (s): counts how ropes with friction have rolled over their edges.
  void carry_splits(double t);

  /// Kinematics and loads of ropes, pads and tugger lines at a time, s.
  void load(double t);
  /// The value of each source, of the instant that calc_contact_loads has just evaluated.
  /// @param may_be_met: is it the condition's time? Before, it counts as not met.
  /// @param values count() of them. Does not allocate.
  void find_values(bool may_be_met, double* values);
  /// Notes the values by the loads that the workspace holds, which are those of a state near to
  /// that of the step's end. Not where sheaves rub, ropes hang by their weight or a condition is
  /// awaited.
  /// @param nearness by how much positions (m) and velocities (m/s) of points may differ from it.
  void foresee(double nearness);
  /// The values that were foreseen, as find_values has them, where they serve as well as those of
  /// the step's end: none can have the other sign there, and none is on its way to zero, whose
  /// instant would be sought from here.
  /// @returns false if they do not serve; nothing is done then.
  bool take_foreseen(double* values);
  /// Switches over what is due at t (s), the end of a step.
  /// @param found for each source whether its value rises (1), falls (-1) or does not pass zero
  /// there; null: the step did not end at a root.
  /// @return Must the integration start anew?
  bool change(double t, const std::vector<int>* found, Ledger ledger);

 private:
  struct Source {
    enum class Kind { rope, pad, tugger_line, bend, condition };
    Kind kind;
    std::size_t index = 0;  // among Contacts; of the bend's rope
    std::size_t bend = 0;   // which of the rope's
  };

  double bend_value(const Source& source) const;
  bool stands(const Source& source) const;
  bool may_change(const Source& source, double t, const IntegrationResult& result) const;
  bool is_due(std::size_t k, const std::vector<int>* found) const;
  bool switch_over(const Source& source, double t, Ledger ledger);
  void switch_contact(const Source& source, double t, Ledger ledger);
  double stored_energy(const Source& source, double t);
  void set_down(std::size_t pad, double t);
  void begin_split(std::size_t rope);

  const LiftSystem& system_;
  const AwaitedCondition* awaited_;
  LiftWorkspace& w_;
  MoveTo move_to_;
  Contacts contacts_;
  std::vector<Source> sources_;  // contacts, bends, the condition
  std::size_t contacts_end_ = 0, bends_end_ = 0;
  Eigen::VectorXd values_;  // at the end of the last step, where no root was found
  Eigen::VectorXd foreseen_;
  bool may_foresee_ = false, is_foreseen_ = false;
};

}  // namespace blocklift::dynamics

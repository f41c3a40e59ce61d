#include "dynamics/simulation/event_sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/simulation/energy_ledger.h"

namespace blocklift::dynamics {

EventSources::EventSources(const LiftSystem& system, const AwaitedCondition* awaited,
                           LiftWorkspace& w, MoveTo move_to)
    : system_(system), awaited_(awaited), w_(w), move_to_(std::move(move_to)) {
  using Kind = Source::Kind;
  const std::size_t ropes = system.ropes().size();
  for (std::size_t i = 0; i < ropes; ++i) sources_.push_back({Kind::rope, i});
  for (std::size_t i = 0; i < system.supports().size(); ++i)
    sources_.push_back({Kind::pad, ropes + i});
  for (std::size_t i = 0; i < system.tugger_lines().size(); ++i)
    sources_.push_back({Kind::tugger_line, sources_.size()});
  contacts_end_ = sources_.size();
  for (std::size_t i = 0; i < w.splits.size(); ++i) {
    for (std::size_t j = 0; j < w.splits[i].bend_count(); ++j)
      sources_.push_back({Kind::bend, i, j});
  }
  bends_end_ = sources_.size();
  if (awaited) sources_.push_back({Kind::condition});
  values_.setZero(count());
  if (awaited) values_[count() - 1] = -1.0;
  foreseen_ = values_;
  const bool hangs =
      std::ranges::any_of(system.ropes(), [](const Rope& rope) { return rope.hangs(); });
  may_foresee_ = contacts_end_ == sources_.size() && !hangs;
}

bool EventSources::release(int rope) { return std::exchange(contacts_[rope], 0) != 0; }

void EventSources::begin_splits(double t) {
  if (!has_bends()) return;
  load(t);
  for (std::size_t i = 0; i < w_.splits.size(); ++i) {
    if (w_.splits[i].rubs()) begin_split(i);
  }
}

void EventSources::carry_splits(double t) {
  bool is_loaded = false;
  for (std::size_t i = 0; i < w_.splits.size(); ++i) {
    RopeSplit& split = w_.splits[i];
    if (!split.rubs_at_edges() || !split.acts() || contacts_[i] == 0) continue;
    if (!is_loaded) load(t);
    is_loaded = true;
    system_.ropes()[i].calc_path(w_.kinematics, w_.path);
    split.carry(system_.ropes()[i], w_.kinematics, w_.path);
  }
}

// At the workspace's kinematics.
void EventSources::begin_split(std::size_t rope) {
  const Rope& one = system_.ropes()[rope];
  one.calc_path(w_.kinematics, w_.path);
  w_.splits[rope].begin(one, w_.kinematics, w_.path,
                        one.calc_load(w_.path, w_.feeds[rope], contacts_[rope] != 0));
}

void EventSources::load(double t) {
  move_to_(t);
  calc_contact_loads(system_, &contacts_, w_);
}

double EventSources::bend_value(const Source& source) const {
  // Where nothing is taut nothing slips.
  return w_.rope_loads[source.index].split.acts ? w_.splits[source.index].indicator(source.bend)
                                                : 1.0;
}

void EventSources::find_values(bool may_be_met, double* values) {
  calc_contact_indicators(w_, values_.head(system_.contact_count()));
  for (std::size_t k = contacts_end_; k < bends_end_; ++k) values_[k] = bend_value(sources_[k]);
  if (awaited_) values_[count() - 1] = may_be_met ? awaited_->indicator(system_, w_) : -1.0;
  Eigen::Map<Eigen::VectorXd>(values, count()) = values_;
}

void EventSources::foresee(double nearness) {
  is_foreseen_ = may_foresee_;
  if (!may_foresee_) return;
  calc_contact_indicators(w_, foreseen_);
  // By a millimetre here and there a load changes by its stiffness, by a millimetre a second by its
  // damping, at each point of its path.
  const auto is_clear = [&](std::size_t k, double stiffness, double damping, double points) {
    return std::abs(foreseen_[k]) > 1e-3 * nearness * points * (stiffness + damping);
  };
  const std::vector<Rope>& ropes = system_.ropes();
  for (std::size_t i = 0; i < ropes.size() && is_foreseen_; ++i) {
    const double stiffness = w_.rope_loads[i].stiffness;
    is_foreseen_ = is_clear(i, stiffness, ropes[i].damping(stiffness),
                            static_cast<double>(ropes[i].points().size()));
  }
  for (std::size_t i = 0; i < system_.supports().size() && is_foreseen_; ++i) {
    const SupportPad::Definition& pad = system_.supports()[i].definition();
    is_foreseen_ = is_clear(ropes.size() + i, pad.stiffness, pad.damping, 1);
  }
  const std::size_t first_line = ropes.size() + system_.supports().size();
  for (std::size_t i = 0; i < system_.tugger_lines().size() && is_foreseen_; ++i) {
    const TuggerLine::Definition& line = system_.tugger_lines()[i].definition();
    is_foreseen_ = is_clear(first_line + i, line.stiffness, line.damping, 2);
  }
}

bool EventSources::take_foreseen(double* values) {
  // A step may be several times as long as the one before.
  constexpr double most_steps_ahead = 5;
  const auto change = (foreseen_ - values_).array().abs();
  if (!is_foreseen_ || !(foreseen_.array().abs() > most_steps_ahead * change).all()) return false;
  values_ = foreseen_;
  Eigen::Map<Eigen::VectorXd>(values, count()) = values_;
  return true;
}

// Is the value positive as long as nothing changes?
bool EventSources::stands(const Source& source) const {
  switch (source.kind) {
    case Source::Kind::rope:
    case Source::Kind::pad:
    case Source::Kind::tugger_line:
      return contacts_[source.index] != 0;
    case Source::Kind::bend:
      return true;
    case Source::Kind::condition:
      break;
  }
  return false;  // what has been met may not change any more
}

bool EventSources::may_change(const Source& source, double t,
                              const IntegrationResult& result) const {
  if (source.kind == Source::Kind::bend) return w_.rope_loads[source.index].split.acts;
  if (source.kind != Source::Kind::condition) return true;
  return !result.met && t >= awaited_->from - beside && t <= awaited_->until + beside;
}

// By a root, or by a value at the step's end.
bool EventSources::is_due(std::size_t k, const std::vector<int>* found) const {
  constexpr double beyond = 1e-4;  // kN, kN/s
  const Source& source = sources_[k];
  const int root = found ? (*found)[k] : 0;
  if (root != 0 && (root > 0) != stands(source)) return true;
  // Behind a root the values of the others are not those of that instant.
  const bool is_bend = source.kind == Source::Kind::bend;
  if (found && !is_bend) return false;
  const double value = is_bend ? bend_value(source) : values_[k];
  const double least = source.kind == Source::Kind::condition ? 0.0 : beyond;
  return !(std::abs(value) < least) && (value > 0.0) != stands(source);
}

bool EventSources::change(double t, const std::vector<int>* found, Ledger ledger) {
  bool anew = false;
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    // What bends do depends on which ropes are taut from now on.
    if (k == contacts_end_ && has_bends()) load(t);
    const Source& source = sources_[k];
    if (is_due(k, found) && may_change(source, t, ledger.result))
      anew |= switch_over(source, t, ledger);
  }
  return anew;
}

// Must the integration start anew?
bool EventSources::switch_over(const Source& source, double t, Ledger ledger) {
  if (source.kind == Source::Kind::condition) {
    ledger.result.met = t;
    return false;
  }
  if (source.kind == Source::Kind::bend) {
    RopeSplit& split = w_.splits[source.index];
    split.set_motion(source.bend, split.motion(source.bend) == BendMotion::sticks
                                      ? split.tendency(source.bend)
                                      : BendMotion::sticks);
    ++ledger.result.statistics.bend_changes;
  } else {
    switch_contact(source, t, ledger);
  }
  return true;
}

// In the rope or tugger line of a contact, J.
double EventSources::stored_energy(const Source& source, double t) {
  if (source.kind == Source::Kind::pad) return 0.0;
  load(t);
  if (source.kind == Source::Kind::rope)
    return calc_rope_energy(system_, source.index, w_).stored_energy;
  const std::size_t first_line = system_.ropes().size() + system_.supports().size();
  return calc_tugger_energy(system_, source.index - first_line, w_).stored_energy;
}

void EventSources::switch_contact(const Source& source, double t, Ledger ledger) {
  using Kind = Source::Kind;
  const std::size_t contact = source.index;
  const bool acts = contacts_[contact] == 0;
  const double before = stored_energy(source, t);
  contacts_[contact] = acts ? 1 : 0;
  ledger.result.events.push_back({t, static_cast<int>(contact), acts});
  ++ledger.result.statistics.contact_changes;
  if (acts && source.kind == Kind::pad) set_down(contact - system_.ropes().size(), t);
  if (acts && source.kind == Kind::rope && w_.splits[contact].acts()) begin_split(contact);
  // What a rope or line that becomes slack while it is still stretched had stored is lost.
  ledger.dissipated += before - stored_energy(source, t);
}

// Friction holds a point of the load where it touches the ground.
void EventSources::set_down(std::size_t pad, double t) {
  move_to_(t);
  compute_kinematics(system_.mechanism(), w_.q, w_.v, w_.kinematics);
  set_down_pad(system_, pad, w_);
}

}  // namespace blocklift::dynamics

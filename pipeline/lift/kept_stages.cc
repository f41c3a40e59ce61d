#include "pipeline/lift/kept_stages.h"

#include <cstdint>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "pipeline/formats/kept_values.h"

namespace blocklift::pipeline {

// Parts of a history.

template <class Values, class Body>
requires std::is_same_v<std::remove_const_t<Body>, dynamics::BodyHistory>
void pass(Values& values, Body& body) {
  values(body.name, body.pose, body.velocity, body.acceleration, body.load);
}

template <class Values, class Mode>
requires std::is_same_v<std::remove_const_t<Mode>, dynamics::ElasticModeHistory>
void pass(Values& values, Mode& mode) {
  values(mode.name, mode.coordinate, mode.rate, mode.acceleration);
}

template <class Values, class Edge>
requires std::is_same_v<std::remove_const_t<Edge>, dynamics::EdgeHistory>
void pass(Values& values, Edge& edge) {
  values(edge.name, edge.force, edge.wrap, edge.first_angle, edge.last_angle, edge.first_place,
         edge.last_place, edge.first_tension, edge.last_tension);
}

template <class Values, class Rope>
requires std::is_same_v<std::remove_const_t<Rope>, dynamics::RopeHistory>
void pass(Values& values, Rope& rope) {
  values(rope.name, rope.tension, rope.elongation, rope.unstretched_length, rope.unstretched_rate,
         rope.first_force, rope.last_force, rope.edges);
}

template <class Values, class Drive>
requires std::is_same_v<std::remove_const_t<Drive>, dynamics::DriveHistory>
void pass(Values& values, Drive& drive) {
  values(drive.name, drive.position, drive.velocity, drive.force);
}

template <class Values, class Support>
requires std::is_same_v<std::remove_const_t<Support>, dynamics::SupportHistory>
void pass(Values& values, Support& support) { values(support.name, support.normal_force); }

template <class Values, class Loop>
requires std::is_same_v<std::remove_const_t<Loop>, dynamics::LoopHistory>
void pass(Values& values, Loop& loop) {
  values(loop.name, loop.force, loop.multipliers, loop.residual);
}

template <class Values, class Energy>
requires std::is_same_v<std::remove_const_t<Energy>, dynamics::EnergyHistory>
void pass(Values& values, Energy& energy) {
  values(energy.kinetic, energy.gravity, energy.elastic, energy.drive_work, energy.winch_work,
         energy.outside_work, energy.dissipated);
}

template <class Values, class History>
requires std::is_same_v<std::remove_const_t<History>, dynamics::History>
void pass(Values& values, History& history) {
  values(history.time, history.bodies, history.elastic_modes, history.ropes, history.drives,
         history.supports, history.loops, history.energy);
}

// What else a time integration found.

template <class Values, class Statistics>
requires std::is_same_v<std::remove_const_t<Statistics>, dynamics::IntegrationStatistics>
void pass(Values& values, Statistics& cost) {
  values(cost.steps, cost.right_hand_sides, cost.difference_right_hand_sides, cost.jacobians,
         cost.factorisations, cost.newton_iterations, cost.error_test_failures,
         cost.nonlinear_failures, cost.restarts, cost.contact_changes);
}

template <class Values, class Event>
requires std::is_same_v<std::remove_const_t<Event>, dynamics::ContactEvent>
void pass(Values& values, Event& event) { values(event.time, event.contact, event.acts); }

template <class Values, class Parted>
requires std::is_same_v<std::remove_const_t<Parted>, dynamics::PartedRope>
void pass(Values& values, Parted& parted) {
  values(parted.rope, parted.time, parted.tension, parted.energy);
}

template <class Values, class Displacement>
requires std::is_same_v<std::remove_const_t<Displacement>, LugDisplacement>
void pass(Values& values, Displacement& displacement) {
  values(displacement.lug, displacement.size, displacement.time);
}

// Natural modes.

template <class Values, class Motion>
requires std::is_same_v<std::remove_const_t<Motion>, dynamics::BodyModeMotion>
void pass(Values& values, Motion& motion) {
  values(motion.body, motion.rotation, motion.displacement, motion.displacement_centre,
         motion.energy_share);
}

template <class Values, class Motion>
requires std::is_same_v<std::remove_const_t<Motion>, dynamics::ElasticModeMotion>
void pass(Values& values, Motion& motion) {
  values(motion.mode, motion.amplitude, motion.energy_share);
}

template <class Values, class Mode>
requires std::is_same_v<std::remove_const_t<Mode>, dynamics::Mode>
void pass(Values& values, Mode& mode) {
  values(mode.kind, mode.eigenvalue, mode.shape, mode.bodies, mode.elastic_modes,
         mode.elastic_share, mode.name);
}

template <class Values, class Modes>
requires std::is_same_v<std::remove_const_t<Modes>, NaturalModes>
void pass(Values& values, Modes& modes) {
  auto& linear = modes.linearisation;
  values(modes.instant, linear.time, linear.mass, linear.damping, linear.stiffness, linear.basis,
         linear.modes);
}

// Refinement.

template <class Values, class Step>
requires std::is_same_v<std::remove_const_t<Step>, structure::AccuracyStep>
void pass(Values& values, Step& step) {
  values(step.unknowns, step.shells, step.smallest_edge, step.at_rest, step.in_motion);
}

template <class Values, class Square>
requires std::is_same_v<std::remove_const_t<Square>, structure::Square>
void pass(Values& values, Square& square) {
  values(square.centre_B, square.e_1, square.e_2, square.size, square.region, square.shell,
         square.site, square.is_near_singularity);
}

template <class Values, class Refinement>
requires std::is_same_v<std::remove_const_t<Refinement>, KeptRefinement>
void pass(Values& values, Refinement& refinement) {
  auto& state = refinement.state;
  values(refinement.first_elastic_period, state.steps, state.centres, state.squares, state.at_rest,
         state.in_motion);
}

template <class Values, class Flexibility>
requires std::is_same_v<std::remove_const_t<Flexibility>, LoadFlexibility>
void pass(Values& values, Flexibility& flexibility) {
  values(flexibility.lugs, flexibility.compliance, flexibility.shapes,
         flexibility.angular_frequencies, flexibility.damping_ratio);
}

namespace {

template <class Value>
std::string bytes_of(const Value& value) {
  KeptValuesWriter values;
  values(value);
  return values.take();
}

template <class Value>
Value value_of(const std::string& bytes) {
  KeptValuesReader values(bytes);
  Value value;
  values(value);
  return value;
}

}  // namespace

std::string bytes_of_flexibility(const LoadFlexibility& flexibility) {
  return bytes_of(flexibility);
}

LoadFlexibility flexibility_of(const std::string& bytes) {
  return value_of<LoadFlexibility>(bytes);
}

std::string bytes_of_motion(const LiftRun& run) {
  const dynamics::IntegrationResult& result = run.dynamic_result;
  KeptValuesWriter values;
  values(run.static_history, run.static_s, run.dynamic_s, run.natural_modes,
         run.elastic_displacement, run.righting_height, result.history, result.statistics,
         result.events, result.q_end, result.v_end, result.parted);
  return values.take();
}

LiftRun motion_of(const std::string& bytes, BuiltLift model) {
  // Their sizes are those of the bytes.
  dynamics::History at_rest(model.at_rest(), 0, false), in_motion(model.system, 0, true);
  const auto parts = [](const dynamics::History& history) {
    return std::tuple(history.bodies.size(), history.elastic_modes.size(), history.ropes.size());
  };
  const auto due = parts(in_motion);
  LiftRun run{std::move(model),
              std::move(at_rest),
              {std::move(in_motion), {}, {}, {}, {}, {}},
              0,
              0,
              {},
              {}};
  dynamics::IntegrationResult& result = run.dynamic_result;
  KeptValuesReader values(bytes);
  values(run.static_history, run.static_s, run.dynamic_s, run.natural_modes,
         run.elastic_displacement, run.righting_height, result.history, result.statistics,
         result.events, result.q_end, result.v_end, result.parted);
  if (parts(run.dynamic_history()) != due)
    throw std::runtime_error("the motion that was kept is another lift's");
  return run;
}

// The components first, so that they are aligned in the file's memory.
std::string bytes_of_stress_basis(const structure::StressBasis& basis) {
  const auto components = basis.components();
  const std::int64_t rows = components.rows(), columns = components.cols();
  KeptValuesWriter values;
  values(rows, columns);
  values.bytes(components.data(), sizeof(double) * static_cast<std::size_t>(components.size()));
  values(basis.squares());
  return values.take();
}

structure::StressBasis stress_basis_in(std::shared_ptr<const MappedFile> file) {
  KeptValuesReader values(file->bytes());
  std::int64_t rows = 0, columns = 0;
  values(rows, columns);
  const auto most = static_cast<std::int64_t>(file->bytes().size() / sizeof(double));
  if (rows < 0 || columns < 0 || (columns > 0 && rows > most / columns))
    throw std::runtime_error("the stress that was kept is larger than its file");
  const auto* first = static_cast<const double*>(
      values.in_place(sizeof(double) * static_cast<std::size_t>(rows * columns)));
  std::vector<structure::Square> squares;
  values(squares);
  return {std::move(squares), {first, rows, columns}, std::move(file)};
}

std::string bytes_of_refinement(const KeptRefinement& refinement) { return bytes_of(refinement); }

KeptRefinement refinement_of(const std::string& bytes) { return value_of<KeptRefinement>(bytes); }

}  // namespace blocklift::pipeline

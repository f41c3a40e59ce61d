#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "pipeline/verification/structure/structure_cases.h"
#include "structure/envelope/block_envelope.h"
#include "structure/mesh/plates/shell_generator.h"
#include "structure/system/matter.h"

namespace blocklift::pipeline {
namespace {

using namespace structure;

// A stiffened tray, 5 x 3 x 1.5 m, 6 t, with four lugs on its sides.
BlockDescription tray() {
  BlockDescription block;
  block.name = "tray";
  block.materials = {{"steel", 206e9, 0.3, 7850, 355e6}};
  block.plates = {
      {"bottom", Axis::z, {0}, {{{0, 5}, {0, 3}, {}}}, 0.018, "steel"},
      {"sides", Axis::y, {0, 3}, {{{0, 5}, {}, {0, 1.5}}}, 0.014, "steel"},
      {"frames", Axis::x, {0, 2.5, 5}, {{{}, {0, 3}, {0, 1.5}}}, 0.012, "steel"},
  };
  for (int i = 0; i < 4; ++i) {
    const std::string name = "L" + std::to_string(i + 1), pad = "pad_" + name;
    const Interval along = i % 2 == 0 ? Interval{0, 0.8} : Interval{4.2, 5};
    const double y = i < 2 ? 0 : 3;
    block.pads.push_back({pad, "sides", Axis::y, y, {{along, {}, {0.9, 1.5}}}, 0.035, ""});
    block.lugs.push_back({name,
                          pad,
                          Axis::y,
                          y,
                          {{along, {}, {1.5, 1.9}}},
                          0.035,
                          "",
                          {(along.lower + along.upper) / 2, y, 1.75}});
  }
  block.total_mass = 6e3;
  block.centre_of_mass_B = Vector3(2.55, 1.45, 0.5);
  block.largest_element = 1;
  return block;
}

// An instant of a lift: pulls that sway and bounce, balanced by the motion that they cause.
LoadCase instant(const ElasticModel& model, int t) {
  LoadCase load_case{"instant " + std::to_string(t), {}, {}};
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(model.freedoms());
  for (int lug = 0; lug < 4; ++lug) {
    const Vector3 force(900 * std::sin(0.5 * t + lug), 700 * std::cos(0.7 * t),
                        15000 + 3000 * std::sin(0.9 * t + 2 * lug));
    load_case.lug_forces_B.push_back(force);
    pull += model.lug_loads().middleCols<3>(static_cast<Eigen::Index>(3) * lug) * force;
  }
  const Vector3 w(0.1 * std::sin(0.3 * t), 0.05, 0.2 * std::cos(0.4 * t));
  const InertiaField spin =
      InertiaField::moving(Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), w);
  pull += model.inertia_loads() * spin.coefficients();
  load_case.field = balancing_field(model.mass_properties(), resultant(model.space(), pull));
  load_case.field.angular_velocity_products = spin.angular_velocity_products;
  return load_case;
}

std::vector<VerificationRow> compute() {
  constexpr int instants = 60;
  const BlockDescription block = tray();
  const ElasticModel model(generate_shell_mesh(block), {3, {}}, block.total_mass,
                           block.centre_of_mass_B);
  const UnitResponses responses(model);
  const StressRecovery recovery(responses);
  Eigen::MatrixXd factors(responses.count(), instants);
  double superposition = 0, reaction = 0, force = 0, moment = 0;
  std::array<double, 3> brute{};  // checked stress, peak stress, displacement
  for (int t = 0; t < instants; ++t) {
    const LoadCase load_case = instant(model, t);
    factors.col(t) = responses.coefficients(load_case);
    const LoadCaseResult result = recovery.evaluate(load_case);
    brute[0] = std::max(brute[0], result.checked_von_mises.value);
    brute[1] = std::max(brute[1], result.peak_von_mises.value);
    brute[2] = std::max(brute[2], result.displacement.value);
    reaction = std::max(reaction, result.balance.reaction_over_weight);
    force = std::max(force, result.balance.force_residual);
    moment = std::max(moment, result.balance.moment_residual);
    if (t % 10 != 0) continue;
    const Eigen::VectorXd direct =
        responses.without_rigid_motion(responses.solve_directly(load_case));
    const Eigen::VectorXd sum = responses.without_rigid_motion(responses.displacement(load_case));
    superposition = std::max(superposition, (sum - direct).norm() / direct.norm());
  }
  const BlockEnvelope envelope = find_block_envelope(responses, recovery, factors);
  // Two ways of summing some 30 products of like size differ by roundings of the largest of them;
  // the peak of one instant comes from its displacement's gradients, which lose the digits by which
  // an element is smaller than the displaced block.
  constexpr double sums = 1e-12, gradients = 1e-9;
  const auto envelope_row = [&](const char* of, const char* unit, double one, double all,
                                double rounding) {
    return compare(std::string("envelope of ") + of + " over 60 instants", unit, one, all,
                   rounding * one, "every instant evaluated by itself");
  };
  // The support takes what the solution of thin plates leaves over: a rounding times an element's
  // stiffness, up to 1e12 N/m, times the displacement, some 1e-2 N here. A bar's is 1e-15
  // (accelerated-bar).
  return {
      bound("superposed displacement off that of a direct solve", "1", superposition, 1e-10,
            "linearity: a direct solve"),
      bound("largest reaction of the 3-2-1 support over the weight, balanced loads", "1", reaction,
            1e-6, "equilibrium of a free body"),
      bound("resultant of the balanced loads over the pulls", "1", force, 1e-12,
            "equilibrium of a free body"),
      bound("moment of the balanced loads over the pulls' and the radius of gyration", "1", moment,
            1e-12, "equilibrium of a free body"),
      envelope_row("the checked stress", "Pa", brute[0], envelope.checked_von_mises.value, sums),
      envelope_row("the peak stress", "Pa", brute[1], envelope.peak_von_mises.value, gradients),
      envelope_row("the displacement", "m", brute[2], envelope.displacement.value, sums)};
}

}  // namespace

VerificationCase lifted_block() {
  return {.name = "lifted-block",
          .stage = "structure",
          .source = "superposition of unit responses",
          .compute = compute};
}

}  // namespace blocklift::pipeline

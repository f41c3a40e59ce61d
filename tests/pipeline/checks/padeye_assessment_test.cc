// Padeyes of a lift: hand formulae and the sub-model.
#include "pipeline/checks/padeye_assessment.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/checks/buckling_assessment.h"
#include "tests/pipeline/small_lift.h"

namespace blocklift::pipeline {
namespace {

using structure::Vector3;
using test::small_lift;

const structure::PadeyeFormula& formula(const std::vector<structure::PadeyeFormula>& formulas,
                                        const std::string& name) {
  return *std::find_if(formulas.begin(), formulas.end(),
                       [&](const structure::PadeyeFormula& one) { return name == one.name; });
}

structure::PadeyeFormulaInput input_of(const structure::PadeyeGeometry& geometry,
                                       double youngs_modulus) {
  structure::PadeyeFormulaInput input;
  input.geometry = geometry;
  input.material = {"steel", youngs_modulus, 0.3, 7850, 355e6};
  return input;
}

// DNV 2.7-3 (2011), section 3.4: F 163138 N, D_H 30, t 42, R 45 mm, E 210 GPa give 234.65 and
// 129.47 MPa.
TEST(PadeyeFormulas, HaveTheExampleOfDnv) {
  structure::PadeyeFormulaInput input =
      input_of({0.045, 0.042, 0.030, 0.029, 0, 0, 0.06, 0.06, 0.06}, 210e9);
  const auto formulas = structure::padeye_strength(input, {0, 163138, 0});
  EXPECT_NEAR(formula(formulas, "bearing (Hertz)").demand / 1e6, 234.65, 0.005);
  EXPECT_NEAR(formula(formulas, "tear-out").demand / 1e6, 129.47, 0.005);
  // A loose pin: 0.18 sqrt(F (1/D_p - 1/D_H) E / t).
  input.geometry.pin_diameter = 0.027;
  EXPECT_NEAR(
      formula(structure::padeye_strength(input, {0, 163138, 0}), "bearing (Hertz)").demand / 1e6,
      0.18 * std::sqrt(163138 * (1 / 27.0 - 1 / 30.0) * 210e3 / 42), 0.01);
}

// ASME BTH-1, section 3-3.3, an example in inch and kip: N_d 2, t 1.25, a = b_e = 3, D_p 2.75, D_h
// 3, R 4.5, F_y 36, F_u 58 ksi: P_t 175.2, P_b 144.1 (C_r taken as 1), P_v 148.0 kip. Units cancel:
// ksi for Pa.
TEST(PadeyeFormulas, HaveTheExampleOfAsme) {
  structure::PadeyeFormulaInput input = input_of({4.5, 1.25, 3, 2.75, 0, 0, 6, 6, 6}, 29e3);
  input.material.yield_stress = 36;
  input.tensile_strength = 58;
  const structure::AsmePinPlate allowed = structure::asme_pin_plate(input);
  EXPECT_NEAR(allowed.clearance_factor, 1 - 0.275 * std::sqrt(1 - 2.75 * 2.75 / 9), 1e-12);
  EXPECT_NEAR(allowed.tension / allowed.clearance_factor, 175.2, 0.05);
  EXPECT_NEAR(allowed.splitting / allowed.clearance_factor, 144.1, 0.05);
  EXPECT_NEAR(allowed.shear, 148.0, 0.05);
  EXPECT_NEAR(allowed.bearing, 1.25 * 36 / 2 * 2.75 * 1.25, 1e-9);
}

// By hand, 1 MN at 30 degrees from the padeye's middle line, in millimetres and newtons.
TEST(PadeyeFormulas, WorkingStressByHand) {
  structure::PadeyeFormulaInput input =
      input_of({0.3, 0.08, 0.145, 0.140, 0.22, 0.035, 0.55, 0.6, 0.6}, 206e9);
  input.cheek_weld = 0.025;
  const auto formulas = structure::padeye_strength(input, {0.5e6, std::sqrt(0.75) * 1e6, 0});
  EXPECT_NEAR(formula(formulas, "bearing of the pin").demand / 1e6, 1e6 / (140 * 150), 1e-9);
  const double net = 80 * (600 - 145) + 70 * (440 - 145);
  EXPECT_NEAR(formula(formulas, "net section: tension").demand / 1e6, 1e6 / net, 1e-9);
  EXPECT_NEAR(formula(formulas, "tear-out: shear in two planes").limit / 1e6, 0.4 * 355, 1e-9);
  const double area = 80 * 1200;
  const double sum = std::sqrt(0.75) * 1e6 / area / (0.6 * 355) +
                     0.5e6 * 550 / (80 * 1200 * 1200 / 6.0) / (0.66 * 355) +
                     0.05e6 * 550 / (1200 * 80 * 80 / 6.0) / (0.75 * 355);
  EXPECT_NEAR(formula(formulas, "base: tension and bending both ways").demand, sum, 1e-9);
  EXPECT_NEAR(formula(formulas, "cheek welds: shear on half a circle").demand / 1e6,
              1e6 * 35 / 150 / (25 / std::sqrt(2.0) * M_PI * 220), 1e-9);
}

// The same force on fillets of 20 mm (throat 14.142 mm) along both sides of the base, and on a
// doubler of 1400 x 300 x 30 mm with a fillet of 12 mm (8.485 mm) around it, 550 and 580 mm below
// the pin; 5 % of the force along the pin.
TEST(PadeyeFormulas, WeldsOfTheBaseAndOfADoublerByHand) {
  structure::PadeyeFormulaInput input =
      input_of({0.3, 0.08, 0.145, 0.140, 0.22, 0.035, 0.55, 0.6, 0.6}, 206e9);
  input.base_weld = 0.020;
  input.doubler = structure::PadeyeDoubler{1.4, 0.3, 0.030, 0.012};
  const double along = 0.5e6, up = std::sqrt(0.75) * 1e6, pin = 0.05e6;
  const auto formulas = structure::padeye_working_stress(input, {along, up, 0});

  double a = 20 / std::sqrt(2.0), area = 2 * a * 1200;
  double across = up / area + along * 550 / (2 * a * 1200 * 1200 / 6) + pin * 550 / (a * 1200 * 80);
  EXPECT_NEAR(formula(formulas, "base welds: fillets on both sides").demand / 1e6,
              std::hypot(across, std::hypot(along, pin) / area), 1e-9);

  a = 12 / std::sqrt(2.0);
  area = 2 * a * (1400 + 300);
  // Second moments of the four lines over the distance of the outermost.
  const double in = (2 * a * std::pow(1400, 3) / 12 + 2 * a * 300 * 700.0 * 700) / 700;
  const double out = (2 * a * std::pow(300, 3) / 12 + 2 * a * 1400 * 150.0 * 150) / 150;
  across = up / area + along * 580 / in + pin * 580 / out;
  EXPECT_NEAR(formula(formulas, "doubler: fillet all around").demand / 1e6,
              std::hypot(across, std::hypot(along, pin) / area), 1e-9);
  EXPECT_NEAR(formula(formulas, "doubler: fillet all around").limit / 1e6, 0.4 * 355, 1e-9);

  const double moment = along * 550 / (1200 * 1200 / 6.0);  // N/mm at the ends of the base
  const double bent = (up / 1200 + moment) * 300 / 4 + pin * 550 / (2 * 1200.0);
  EXPECT_NEAR(formula(formulas, "doubler: bending between its welds").demand / 1e6,
              6 * bent / (30 * 30), 1e-9);
  EXPECT_NEAR(formula(formulas, "doubler: bearing of the base").demand / 1e6, moment / 80, 1e-9);
  // Pressed down, it bears on the plating instead of bending.
  const auto pressed = structure::padeye_working_stress(input, {0, -up, 0});
  EXPECT_NEAR(formula(pressed, "doubler: bearing of the base").demand / 1e6, up / 1200 / 80, 1e-9);
  EXPECT_NEAR(formula(pressed, "doubler: bending between its welds").demand / 1e6,
              6 * pin * std::sqrt(0.75) * 550 / (2 * 1200.0) / (30 * 30), 1e-9);
}

TEST(PadeyeFormulas, RulesOfPracticeFailWhatBreaksThem) {
  structure::PadeyeFormulaInput input =
      input_of({0.3, 0.08, 0.145, 0.140, 0.22, 0.035, 0.55, 0.6, 0.6}, 206e9);
  input.jaw = 0.2;
  for (const structure::PadeyeFormula& rule : structure::padeye_rules(input))
    EXPECT_LE(rule.utilisation, 1) << rule.name;
  input.geometry.pin_diameter = 0.130;  // 15 mm of play
  input.geometry.cheek_thickness = 0.09;
  input.jaw = 0.4;
  int failed = 0;
  for (const structure::PadeyeFormula& rule : structure::padeye_rules(input))
    failed += rule.utilisation > 1;
  EXPECT_EQ(failed, 3);  // play, cheek plate, jaw not filled
}

class SmallLiftPadeyes : public ::testing::Test {
 protected:
  static const structure::UnitResponses& responses() {
    static const structure::UnitResponses one(*small_lift().model);
    return one;
  }
  static PadeyesAssessment assess() {
    const auto& lift = small_lift();
    const BlockAttachment attachment = attach_block(lift.run.model, lift.lugs());
    return assess_padeyes(lift.lift_case, responses(), attachment, lift.run.static_history,
                          lift.run.dynamic_history());
  }
};

TEST_F(SmallLiftPadeyes, TakeTheRopesForceAtItsLargest) {
  const PadeyesAssessment found = assess();
  ASSERT_EQ(found.padeyes.size(), 1u);
  const PadeyeAssessment& padeye = found.padeyes[0];
  EXPECT_EQ(padeye.lug, "L1");
  EXPECT_EQ(padeye.rope, "R1");
  ASSERT_EQ(padeye.states.size(), 4u);
  const auto& rope = small_lift().run.dynamic_history().rope("R1");
  EXPECT_EQ(padeye.states[1].name, "largest dynamic load");
  EXPECT_NEAR(padeye.states[1].force_P.norm(), rope.tension.maxCoeff(), 1e-6);
  EXPECT_NEAR(padeye.states[0].force_P.norm(),
              small_lift().run.static_history.rope("R1").tension.maxCoeff(), 1e-6);
  for (const PadeyeState& state : padeye.states) {
    EXPECT_GT(state.force_P.y(), 0);  // away from the block
    EXPECT_LT(state.result.force_residual, 1e-8);
    EXPECT_LT(state.result.moment_residual, 1e-8);
    EXPECT_LT((state.result.reaction.force + state.force_P).norm(), 0.02 * state.force_P.norm());
    EXPECT_GT(state.result.main_plate.checked_von_mises.value, 0);
  }
  // The hand formula has its worst instant where the load is largest.
  const double bearing =
      padeye.consequence_factor * padeye.states[1].force_P.norm() / (0.057 * 0.05);
  EXPECT_NEAR(padeye.formulas[0].formula.demand, bearing, 1e-6 * bearing);
}

TEST_F(SmallLiftPadeyes, FailTheLiftWhereTheyAreTooWeak) {
  const PadeyesAssessment found = assess();
  LiftCase lift_case = test::read_small_lift();
  EXPECT_EQ(check_padeyes(lift_case, found).size(), 2u);
  EXPECT_TRUE(all_pass(check_padeyes(lift_case, found)));
  // Hand formulae know no mesh.
  EXPECT_FALSE(check_padeyes(lift_case, found)[0].is_by_mesh);
  EXPECT_TRUE(check_padeyes(lift_case, found)[1].is_by_mesh);
  lift_case.checks.yield_factor = 1e3;
  const auto checks = check_padeyes(lift_case, found);
  EXPECT_TRUE(checks[0].pass);
  EXPECT_FALSE(checks[1].pass);
  PadeyesAssessment weak = found;
  weak.padeyes[0].formulas[0].formula.utilisation = 1.01;
  EXPECT_FALSE(check_padeyes(test::read_small_lift(), weak)[0].pass);
}

// The sling of 3 m leans to a hook half of the box's 3 m off, across the padeye: by 30 degrees.
TEST_F(SmallLiftPadeyes, SayWhereTheyArePulledOutOfTheirPlane) {
  PadeyesAssessment found = assess();
  const LiftCase lift_case = test::read_small_lift();
  EXPECT_THAT(check_padeyes(lift_case, found)[0].note,
              ::testing::HasSubstr("degrees out of its plane"));
  // 3 of 5 along the pin: 36.9 degrees; tan 4.9 degrees: nothing is said.
  for (PadeyeState& state : found.padeyes[0].states)
    state.force_P = structure::Vector3(0.0, 4e3, -3e3);
  EXPECT_THAT(check_padeyes(lift_case, found)[0].note,
              ::testing::HasSubstr("pulled up to 37 degrees out of its plane, 60 % of the force"));
  for (PadeyeState& state : found.padeyes[0].states)
    state.force_P = structure::Vector3(0.0, 1e3, 85.7);
  EXPECT_THAT(check_padeyes(lift_case, found)[0].note,
              ::testing::Not(::testing::HasSubstr("out of its plane")));
}

TEST_F(SmallLiftPadeyes, PanelsAreTheWorstOfEverySample) {
  const auto& lift = small_lift();
  const structure::BlockPanels panels(*lift.model, responses().displacements(), {});
  const BlockAttachment attachment = attach_block(lift.run.model, lift.lugs());
  const dynamics::History& history = lift.run.static_history;
  Eigen::MatrixXd factors(responses().count(), history.sample_count());
  std::vector<double> largest(panels.panels().size(), 0);
  for (Eigen::Index t = 0; t < history.sample_count(); ++t) {
    factors.col(t) = responses().coefficients(map_instant(history, t, attachment, lift.mass()));
    const auto stresses = panels.stresses(factors.col(t));
    for (std::size_t p = 0; p < largest.size(); ++p)
      largest[p] =
          std::max(largest[p], panels.utilisation(static_cast<int>(p), stresses[p]).critical);
  }
  const auto worst = panels.find_worst(factors);
  for (std::size_t p = 0; p < largest.size(); ++p)
    EXPECT_NEAR(worst[p].utilisation.critical, largest[p], 1e-9 * largest[p]);
}

}  // namespace
}  // namespace blocklift::pipeline

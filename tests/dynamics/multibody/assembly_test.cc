// Assembly from rough starts, loops that cannot close, and what the diagnosis says.
#include "dynamics/multibody/assembly.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/multibody/loop_diagnosis.h"
#include "dynamics/multibody/loop_projection.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/multibody/sample_loops.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;

double largest_residual(const Mechanism& m, const Eigen::VectorXd& q) {
  LoopProjector projector(m);
  projector.look(q);
  return projector.state().residual.lpNorm<Eigen::Infinity>();
}

TEST(Assembly, ClosesFromRoughStarts) {
  examples::Random random(17);
  const Mechanism four_bar = test::four_bar(1, 3, 2, 2.5);
  const Mechanism andrews = test::AndrewsSqueezer{}.build();
  const Mechanism bricard = test::bricard_linkage();
  for (int i = 0; i < 20; ++i) {
    for (const Mechanism* m : {&four_bar, &andrews, &bricard}) {
      Eigen::VectorXd q = random.values(m->nq(), 2);
      if (m == &andrews) q = test::AndrewsSqueezer::q_start() + random.values(7, 0.3);
      ASSERT_NO_THROW(assemble(*m, q)) << i;
      EXPECT_LT(largest_residual(*m, q), 1e-12);
    }
  }
}

// From a turn of 3 rad about the hinge's own cross axis: the sine alone would close it upside down.
TEST(Assembly, TurnsAxesTheRightWayRound) {
  MechanismBuilder builder;
  BodyDefinition body;
  body.name = "door";
  body.joint.kind = JointKind::free;
  body.mass = 1;
  body.I_BBcm_B = Matrix3::Identity();
  builder.add_body(body);
  LoopDefinition hinge;
  hinge.name = "hinge";
  hinge.second = "door";
  builder.add_loop(hinge);
  const Mechanism m = builder.build();
  Eigen::VectorXd q(7);
  q << 1, 2, 3, quaternion_exponential(3.0 * Vector3(1, 1, 0).normalized());
  assemble(m, q);
  EXPECT_LT(q.head<3>().norm(), 1e-12);
  const Matrix3 R = rotation_from_quaternion(q.tail<4>());
  EXPECT_NEAR(R(2, 2), 1.0, 1e-12);
}

// The closest point of a circle of 2 m about the origin to (3, 4) lies on the line to it; with a
// coordinate that costs more to move, where the gradient of the weighted distance is along the
// radius.
TEST(Assembly, FindsTheClosestConfiguration) {
  MechanismBuilder builder;
  BodyDefinition body;
  body.name = "particle";
  body.joint.kind = JointKind::translational;
  body.mass = 1;
  builder.add_body(body);
  LoopDefinition rod;
  rod.name = "rod";
  rod.kind = LoopKind::distance;
  rod.second = "particle";
  rod.length = 2;
  builder.add_loop(rod);
  const Mechanism m = builder.build();
  Eigen::VectorXd q = Vector3(3, 4, 0);
  assemble(m, q);
  EXPECT_LT((q - Vector3(1.2, 1.6, 0)).norm(), 1e-7);
  q = Vector3(1, 4, 0);
  AssemblySettings settings;
  settings.weights = Vector3(100, 1, 1);
  assemble(m, q, settings);
  EXPECT_NEAR(q.norm(), 2, 1e-13);
  EXPECT_NEAR(100 * (q[0] - 1) * q[1] - (q[1] - 4) * q[0], 0, 1e-5);
  EXPECT_NEAR(q[0], 1, 0.02);
}

std::string assembly_error(const Mechanism& m, Eigen::VectorXd q) {
  try {
    assemble(m, q);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

// Bars of 1, 1 and 1 m do not reach over 3.5 m: half a metre is missing.
TEST(Assembly, TellsWhatCannotClose) {
  const std::string message =
      assembly_error(test::four_bar(1, 1, 1, 3.5), Eigen::Vector3d(0.1, -0.3, 0.2));
  EXPECT_THAT(message, HasSubstr("the loops cannot be closed from this start"));
  EXPECT_THAT(message, HasSubstr("loop \"D\" by 0.5 m"));
}

TEST(Assembly, NamesTheLoopWithoutWhichTheOthersClose) {
  MechanismBuilder builder;
  examples::Random random(2);
  for (const char* name : {"a", "b"}) {
    BodyDefinition body;
    body.name = name;
    body.joint.kind = JointKind::translational;
    body.mass = 1;
    builder.add_body(body);
  }
  const auto rod = [&](const char* name, const char* first, const char* second, double length) {
    LoopDefinition loop;
    loop.name = name;
    loop.kind = LoopKind::distance;
    loop.first = first;
    loop.second = second;
    loop.length = length;
    builder.add_loop(loop);
  };
  rod("short", "world", "a", 1);
  rod("middle", "a", "b", 1);
  rod("long", "world", "b", 5);
  const std::string message = assembly_error(builder.build(), random.values(6, 1));
  EXPECT_THAT(message,
              HasSubstr("without loop \"long\" the others close, and it misses: loop \"long\" by"));
}

TEST(Assembly, DriveThatTheLoopsForbidIsNamed) {
  // A triangle of bars is rigid: its driven corner cannot turn.
  MechanismBuilder builder;
  BodyDefinition crank;
  crank.name = "crank";
  crank.joint = {JointKind::revolute, Vector3::UnitZ()};
  crank.mass = 1;
  crank.p_BoBcm_B = Vector3(0.5, 0, 0);
  crank.I_BBcm_B = Matrix3::Identity();
  crank.driven = {true};
  builder.add_body(crank);
  BodyDefinition bar = crank;
  bar.name = "bar";
  bar.parent = "crank";
  bar.driven = {};
  bar.X_PJ.p = Vector3(1, 0, 0);
  builder.add_body(bar);
  LoopDefinition corner;
  corner.name = "corner";
  corner.kind = LoopKind::point_on_line;
  corner.first = "bar";
  corner.X_FirstK.p = Vector3(1, 0, 0);
  corner.X_SecondK.p = Vector3(1, 0, 0);
  builder.add_loop(corner);
  const Mechanism m = builder.build();
  Eigen::VectorXd q = Eigen::Vector2d(M_PI / 3, -2 * M_PI / 3);
  Eigen::VectorXd v = Eigen::Vector2d(1, 0);
  try {
    assemble(m, q, v);
    FAIL();
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the driven joint \"crank\" (revolute) cannot move"));
    EXPECT_THAT(error.what(), HasSubstr("loop \"corner\""));
  }
  const LoopDiagnosis diagnosis = diagnose_loops(m, q);
  EXPECT_EQ(diagnosis.conflicts.size(), 1U);
}

// ---- diagnosis ---------------------------------------------------------------------------------

TEST(LoopDiagnosis, NamesBricardsRedundantEquation) {
  const Mechanism m = test::bricard_linkage();
  Eigen::VectorXd q = m.zero_configuration();
  assemble(m, q);
  const LoopDiagnosis diagnosis = diagnose_loops(m, q);
  EXPECT_EQ(diagnosis.row_count, 5);
  EXPECT_EQ(diagnosis.rank, 4);
  EXPECT_EQ(diagnosis.degrees_of_freedom, 1);
  ASSERT_EQ(diagnosis.redundant.size(), 1U);
  const std::vector<std::string> sentences = diagnosis.sentences(m);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_THAT(sentences[0], HasSubstr("loop \"hinge_6\", rotation about "));
  EXPECT_THAT(sentences[0], HasSubstr(", repeats loop \"hinge_6\", displacement along "));
}

TEST(LoopDiagnosis, PlaneMechanismRepeatsItsTree) {
  const Mechanism m = test::AndrewsSqueezer{}.build();
  const LoopDiagnosis diagnosis = diagnose_loops(m, test::AndrewsSqueezer::q_start());
  EXPECT_EQ(diagnosis.rank, 6);
  EXPECT_EQ(diagnosis.degrees_of_freedom, 1);
  EXPECT_EQ(diagnosis.redundant.size(), 9U);
  EXPECT_THAT(
      diagnosis.sentences(m)[0],
      HasSubstr("loop \"B\", displacement along z, repeats what the joints of the tree hold"));
}

// Two loops that say the same: the second is named, and it repeats the first, line by line.
TEST(LoopDiagnosis, SecondOfTwoEqualLoopsIsNamed) {
  MechanismBuilder builder;
  examples::Random random(4);
  BodyDefinition body = examples::random_body(random, JointKind::free, "body", "world");
  builder.add_body(body);
  LoopDefinition loop;
  loop.name = "one";
  loop.kind = LoopKind::spherical;
  loop.second = "body";
  builder.add_loop(loop);
  loop.name = "two";
  builder.add_loop(loop);
  const Mechanism m = builder.build();
  Eigen::VectorXd q = m.zero_configuration();
  assemble(m, q);
  const std::vector<std::string> sentences = diagnose_loops(m, q).sentences(m);
  ASSERT_EQ(sentences.size(), 3U);
  EXPECT_EQ(sentences[0],
            "loop \"two\", displacement along x, repeats loop \"one\", displacement along x");
}

TEST(LoopDiagnosis, TogglePositionIsNamed) {
  const Mechanism m = test::four_bar(1, 1, 1, 1);
  const LoopDiagnosis diagnosis = diagnose_loops(m, Eigen::Vector3d(0, M_PI, -M_PI));
  EXPECT_EQ(diagnosis.rank, 2);
  ASSERT_EQ(diagnosis.toggled.size(), 1U);
  EXPECT_THAT(diagnosis.sentences(m).back(),
              HasSubstr("this is a toggle position: loop \"D\", displacement along x"));
  const LoopDiagnosis elsewhere =
      diagnose_loops(m, Eigen::Vector3d(M_PI / 2, -M_PI / 2, -M_PI / 2));
  EXPECT_TRUE(elsewhere.toggled.empty());
}

// ---- projection --------------------------------------------------------------------------------

TEST(LoopProjector, IsQuadraticAndKeepsVelocitiesAlongTheLoops) {
  const Mechanism m = test::bricard_linkage();
  examples::Random random(8);
  Eigen::VectorXd q = m.zero_configuration();
  Eigen::VectorXd v = random.values(5, 1);
  assemble(m, q, v);
  LoopProjector projector(m);
  projector.look(q);
  EXPECT_EQ(projector.independent_rows().count(), 4);
  EXPECT_LT((projector.jacobian() * v).norm(), 1e-13);
  const Eigen::VectorXd kept = v;
  ASSERT_TRUE(projector.project_velocities(v));
  EXPECT_LT((v - kept).norm(), 1e-14);
  // Displaced by 1e-3 it comes back, to within the square of the displacement of the nearest point.
  const Eigen::VectorXd shift = 1e-3 * random.values(5, 1);
  Eigen::VectorXd tangent = shift;
  projector.remove_normal_part(tangent);
  Eigen::VectorXd displaced = q + shift;
  ASSERT_TRUE(projector.project_positions(displaced));
  EXPECT_LT(projector.state().residual.lpNorm<Eigen::Infinity>(), 1e-14);
  EXPECT_LT((displaced - (q + tangent)).norm(), 1e-5);
}

}  // namespace
}  // namespace blocklift::dynamics

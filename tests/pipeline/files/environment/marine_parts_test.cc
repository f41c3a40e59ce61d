// The sea, vessels and lines in mechanism files and lift cases.
#include "pipeline/files/environment/marine_parts.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/simulation/equilibrium.h"
#include "dynamics/simulation/time_integration.h"
#include "pipeline/build/build_mechanism.h"
#include "pipeline/files/environment/vessel_database.h"
#include "pipeline/files/environment/wave_headings.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using test::TemporaryFolder;
using test::with;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

const std::string floating = R"(mechanism: floating
sea:
  waves: {regular: {amplitude: 0.3 m, period: 8 s, heading: 30 deg}, ramp: 10 s}
  current: {speed: 0.5 m/s, towards: 90 deg}
vessels:
  B1: {model: vessels/barge, position: [3 m, 4 m], heading: 90 deg, damping: {surge: 20 kN s/m}}
bodies:
  mast: {mass: 82 t, centre_of_mass: [0 m, 0 m, 5 m], radii_of_gyration: [1 m, 1 m, 1 m]}
joints:
  step: {kind: fixed, parent: B1, child: mast, position: [0 m, 0 m, 6 m]}
moorings:
  M1: {anchor: {body: world, position: [-80 m, 4 m, -30 m]}, fairlead: {body: B1, position: [0 m, 10 m, 5 m]}, length: 95 m, submerged_mass: 40 kg/m, axial_stiffness: 200 MN}
tuggers:
  T1: {from: {body: B1, position: [20 m, 0 m, 6 m]}, to: {body: world, position: [3 m, 60 m, 5 m]}, length: 35 m, stiffness: 100 kN/m}
simulate: {duration: 2 s, relative_tolerance: 1e-6}
)";

std::optional<MechanismFile> read_floating(const std::string& text, std::string& complaints) {
  const TemporaryFolder folder;
  folder.write("vessels/barge.yaml", test::sample_barge);
  folder.write("mechanism.yaml", text);
  Diagnostics diagnostics;
  ModelLibrary library({});
  auto file = read_mechanism("mechanism.yaml", library, diagnostics);
  complaints = diagnostics.to_text();
  return file;
}

MechanismFile sound(const std::string& text) {
  std::string complaints;
  auto file = read_floating(text, complaints);
  EXPECT_TRUE(file) << complaints;
  return file.value_or(MechanismFile());
}

std::string complaints_of_change(const std::string& old_passage, const std::string& new_passage) {
  std::string complaints;
  read_floating(with(floating, old_passage, new_passage), complaints);
  return complaints;
}

TEST(MarineParts, VesselIsABodyThatFloatsByItsWeight) {
  const MechanismFile file = sound(floating);
  ASSERT_EQ(file.vessels.size(), 1U);
  const BuiltMechanism built = build_mechanism(file);
  const dynamics::Mechanism& mechanism = built.system.mechanism();
  const dynamics::Body& body = mechanism.body(mechanism.body_index("B1"));
  EXPECT_EQ(body.joint.kind, dynamics::JointKind::free);
  EXPECT_DOUBLE_EQ(body.inertia.mass, 1640e3);
  // With the mast on it 2.1 m.
  const Eigen::VectorXd& q = built.system.q_start();
  EXPECT_LT((q.segment<3>(body.q_offset) - Vector3(3, 4, -2.1)).norm(), 1e-6);
  const double half = std::numbers::pi / 4;
  EXPECT_NEAR(q[body.q_offset + 3], std::cos(half), 1e-12);
  EXPECT_NEAR(q[body.q_offset + 6], std::sin(half), 1e-12);
  const auto& elements = built.system.elements();
  EXPECT_EQ(std::get<std::vector<dynamics::HullForce>>(elements).size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::QuadraticDamping>>(elements).size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::MooringLine>>(elements).size(), 1U);
  EXPECT_EQ(std::get<std::vector<dynamics::TuggerLine>>(elements).size(), 1U);
}

TEST(MarineParts, StaticEquilibriumIsWithoutWaves) {
  const MechanismFile file = sound(floating);
  const BuiltMechanism built = build_mechanism(file);
  ASSERT_TRUE(built.calm);
  const auto& hull = [](const dynamics::LiftSystem& system) -> const dynamics::HullForce& {
    return std::get<std::vector<dynamics::HullForce>>(system.elements()).front();
  };
  EXPECT_FALSE(hull(built.system).definition().sea->waves.is_still());
  EXPECT_TRUE(hull(built.at_rest()).definition().sea->waves.is_still());
  Eigen::VectorXd q = built.system.q_start();
  dynamics::EquilibriumSolver(built.at_rest()).solve(0, q);
  EXPECT_NEAR(q[2], -2.1, 0.02);  // the lines pull a little
  const dynamics::IntegrationResult result =
      dynamics::integrate(built.system, q, built.system.v_start(),
                          {.relative_tolerance = 1e-6, .sample_interval = 0.5});
  EXPECT_TRUE(result.q_end.allFinite());
}

TEST(MarineParts, RadiationProblemIsThatOfTheVesselsAtRest) {
  const MechanismFile file = sound(floating);
  const RadiationProblem problem = radiation_problem(file);
  ASSERT_EQ(problem.bodies.size(), 1U);
  EXPECT_LT((problem.bodies[0].X_DB.p - Vector3(0, 0, -2.1)).norm(), 1e-6);
  EXPECT_LT((problem.bodies[0].p_BoR_B - Vector3(0, 0, 2.1)).norm(), 1e-6);
  EXPECT_EQ(problem.headings.size(), 72U);
  const double omega = 2 * std::numbers::pi / 8;
  EXPECT_TRUE(std::find(problem.frequencies.begin(), problem.frequencies.end(), omega) !=
              problem.frequencies.end());
  EXPECT_TRUE(std::is_sorted(problem.frequencies.begin(), problem.frequencies.end()));
  EXPECT_TRUE(radiation_problem(sound(with(floating, "damping:", "radiation: none, damping:")))
                  .bodies.empty());
}

// A made-up database: the vessel gets its added mass, memory and diffraction.
TEST(MarineParts, DatabaseMakesWaterAndDiffraction) {
  const MechanismFile file = sound(floating);
  const RadiationProblem problem = radiation_problem(file);
  dynamics::HydrodynamicDatabase database;
  database.water = problem.water;
  database.body_names = {"B1"};
  database.reference_points = {Vector3::Zero()};
  database.infinite_added_mass = 5e6 * Eigen::MatrixXd::Identity(6, 6);
  database.time_step = 0.2;
  for (int n = 0; n < 100; ++n) {
    database.retardation.push_back(1e5 * std::exp(-0.2 * n) * Eigen::MatrixXd::Identity(6, 6));
  }
  database.frequencies = problem.frequencies;
  database.headings = problem.headings;
  for (std::size_t f = 0; f < problem.frequencies.size(); ++f) {
    database.diffraction.push_back(Eigen::MatrixXcd::Constant(6, 72, 1e4));
    database.froude_krylov.push_back(Eigen::MatrixXcd::Zero(6, 72));
  }
  const dynamics::HydrodynamicSeries series{0, {0.0}, {database}};
  const BuiltMechanism built = build_mechanism(file, &series);
  ASSERT_TRUE(built.system.water());
  EXPECT_EQ(built.system.memory_count(), 1 * 6);
  const auto diffraction = [](const dynamics::LiftSystem& system) {
    return std::get<std::vector<dynamics::DiffractionForce>>(system.elements()).size();
  };
  EXPECT_EQ(diffraction(built.system), 1U);
  EXPECT_EQ(diffraction(built.at_rest()), 0U);
  const dynamics::IntegrationResult result =
      dynamics::integrate(built.system, built.system.q_start(), built.system.v_start(),
                          {.relative_tolerance = 1e-6, .sample_interval = 0.5});
  EXPECT_TRUE(result.q_end.allFinite());
}

/// A database of bodies afloat in the water of `floating`, written into the current folder.
void write_database(const std::string& file, const std::vector<std::string>& bodies,
                    double density = 1025, int headings = 8) {
  const auto modes = static_cast<Eigen::Index>(6 * bodies.size());
  dynamics::HydrodynamicDatabase database;
  database.water = {density, 9.81};
  database.body_names = bodies;
  database.reference_points.assign(bodies.size(), Vector3(0.5, 0, 0.9));
  database.displaced_volumes.assign(bodies.size(), 1680);
  database.infinite_added_mass = 5e6 * Eigen::MatrixXd::Identity(modes, modes);
  database.time_step = 0.2;
  for (int n = 0; n < 100; ++n) {
    database.retardation.push_back(1e5 * std::exp(-0.2 * n) *
                                   Eigen::MatrixXd::Identity(modes, modes));
  }
  database.frequencies = {0.5, 1.5};
  for (int h = 0; h < headings; ++h) database.headings.push_back(h * std::numbers::pi / 4);
  database.added_mass.assign(2, database.infinite_added_mass);
  database.damping.assign(2, 1e5 * Eigen::MatrixXd::Identity(modes, modes));
  database.froude_krylov.assign(2, Eigen::MatrixXcd::Zero(modes, headings));
  database.diffraction.assign(2, Eigen::MatrixXcd::Constant(modes, headings, 1e4));
  write_hydrodynamic_database(file, database);
}

MarineParts parts_with_headings(int count, double vessel_heading) {
  MarineParts parts;
  auto database = std::make_shared<dynamics::HydrodynamicDatabase>();
  for (int h = 0; h < count; ++h) {
    database->headings.push_back(h * 2 * std::numbers::pi / count);
  }
  parts.sea = given::Sea{};
  parts.sea->waves = given::Waves{};
  parts.vessels.resize(1);
  parts.vessels[0].hydrodynamics = database;
  parts.vessels[0].database = Located<std::string>{"pontoon.h5", {}};
  parts.vessels[0].heading = vessel_heading;
  return parts;
}

// Between headings far apart forces are interpolated over an eighth of a turn.
TEST(MarineParts, WavesBetweenHeadingsFarApartAreDoubted) {
  const double degree = std::numbers::pi / 180;
  const auto doubt = [&](int count, double heading, double vessel_heading = 0) {
    MarineParts parts = parts_with_headings(count, vessel_heading * degree);
    given::RegularWave wave;
    wave.heading = heading * degree;
    parts.sea->waves->regular = std::vector{wave};
    return doubt_about_headings(parts);
  };
  EXPECT_THAT(doubt(8, 30),
              AllOf(HasSubstr("pontoon.h5"), HasSubstr("of 0 and 45 degrees, 45 degrees apart")));
  EXPECT_THAT(doubt(8, -10), HasSubstr("of 315 and 360 degrees"));
  EXPECT_EQ(doubt(8, 90), "");
  EXPECT_EQ(doubt(24, 37), "");
  EXPECT_EQ(doubt(72, 37), "");
  // A single vessel's database turns with it.
  EXPECT_EQ(doubt(8, 30, 30), "");
  EXPECT_THAT(doubt(8, 45, 30), HasSubstr("of 0 and 45 degrees"));
  MarineParts spread = parts_with_headings(8, 0);
  spread.sea->waves->spectrum = given::Spectrum{};
  EXPECT_EQ(doubt_about_headings(spread), "");
  spread.sea->waves->spectrum->spreading = 4;
  EXPECT_THAT(doubt_about_headings(spread), HasSubstr("degrees apart"));
}

// The barge of `floating` lies at (3, 4), turned by a quarter, 2.1 m deep: the database's world is
// the barge's own, level in the water.
TEST(MarineParts, AVesselMayNameADatabase) {
  const TemporaryFolder folder;
  folder.write("vessels/barge.yaml", test::sample_barge);
  folder.write("mechanism.yaml", with(floating, "damping:", "database: pontoon.h5, damping:"));
  write_database("pontoon.h5", {"pontoon"});
  Diagnostics diagnostics;
  ModelLibrary library({});
  const auto file = read_mechanism("mechanism.yaml", library, diagnostics);
  ASSERT_TRUE(file) << diagnostics.to_text();
  // Its damping is the same at both frequencies: its memory fades. It has diagonals alone.
  EXPECT_THAT(file->doubts, ::testing::UnorderedElementsAre(
                                HasSubstr("pontoon.h5: the retardation functions miss added mass"),
                                HasSubstr("as if the diagonal alone had been written")));
  const RadiationProblem problem = radiation_problem(*file);
  ASSERT_TRUE(problem.given);
  EXPECT_LT((problem.bodies[0].X_DB.p - Vector3(0, 0, -2.1)).norm(), 1e-6);
  EXPECT_LT((problem.bodies[0].X_DB.R - dynamics::Matrix3::Identity()).norm(), 1e-12);
  EXPECT_LT((problem.bodies[0].p_BoR_B - Vector3(0.5, 0, 3.0)).norm(), 1e-6);
  const dynamics::HydrodynamicSeries series{0, {0.0}, {*problem.given}};
  const BuiltMechanism built = build_mechanism(*file, &series);
  const auto& force =
      std::get<std::vector<dynamics::DiffractionForce>>(built.system.elements()).at(0);
  EXPECT_LT((force.definition().frame.X_BH.R - dynamics::Matrix3::Identity()).norm(), 1e-12);
  EXPECT_LT((force.definition().frame.X_BH.p - Vector3(0.5, 0, 3.0)).norm(), 1e-6);
}

TEST(MarineParts, ComplainsAboutDatabases) {
  const auto complaint = [](const std::string& keys, const char* from = "period: 8 s",
                            const char* to = "period: 8 s") {
    const TemporaryFolder folder;
    folder.write("vessels/barge.yaml", test::sample_barge);
    folder.write("mechanism.yaml", with(with(floating, "damping:", keys + ", damping:"), from, to));
    write_database("one.h5", {"pontoon"});
    write_database("fresh.h5", {"pontoon"}, 1000);
    write_database("two.h5", {"B1", "B2"});
    write_database("ahead.h5", {"pontoon"}, 1025, 3);
    Diagnostics diagnostics;
    ModelLibrary library({});
    EXPECT_FALSE(read_mechanism("mechanism.yaml", library, diagnostics));
    return diagnostics.to_text();
  };
  EXPECT_THAT(complaint("database: none.h5"), HasSubstr("there is no database none.h5"));
  EXPECT_THAT(complaint("database: one.h5, database_body: ponton"),
              AllOf(HasSubstr("holds no body \"ponton\""), HasSubstr("pontoon")));
  EXPECT_THAT(complaint("database: fresh.h5"), HasSubstr("for water of 1000 kg/m3"));
  EXPECT_THAT(
      complaint("database: ahead.h5"),
      AllOf(HasSubstr("mechanism.yaml:"), HasSubstr("90 and 360 degrees follow each other")));
  EXPECT_THAT(complaint("database: two.h5"), HasSubstr("holds body B2, which no vessel is"));
  EXPECT_THAT(complaint("radiation: none, database: one.h5"), HasSubstr("its radiation is none"));
  EXPECT_THAT(complaint("draughts: [1 m, 2 m], database: one.h5"),
              HasSubstr("a database of one draught"));
  EXPECT_THAT(complaint("database: one.h5", "period: 8 s", "period: 3 s"),
              AllOf(HasSubstr("mechanism.yaml:3:"),
                    HasSubstr("error: the wave has 2.094 rad/s, and the database "
                              "one.h5 has 0.5 to 1.5 rad/s")));
  EXPECT_THAT(complaint("database_body: pontoon"), HasSubstr("is a body of no database"));
}

// A lid lies in the world; the problem's own begins at the middle of the barge, (3, 4).
TEST(MarineParts, LidsAreThoseOfTheProblem) {
  const std::string lid = "lids: [{from: [5 m, 9 m], to: [4 m, 6 m], rate: 0.1 rad/s}]";
  const auto changed = [&](const std::string& vessel) {
    return with(with(floating, "sea:", "sea:\n  radiation: {" + lid + "}"),
                "damping:", vessel + "damping:");
  };
  const RadiationProblem problem = radiation_problem(sound(changed("")));
  ASSERT_EQ(problem.lids.size(), 1U);
  EXPECT_LT((problem.lids[0].low - Eigen::Vector2d(1, 2)).norm(), 1e-12);
  EXPECT_LT((problem.lids[0].high - Eigen::Vector2d(2, 5)).norm(), 1e-12);
  EXPECT_EQ(problem.lids[0].rate, 0.1);
  EXPECT_EQ(make_panel_model(problem).symmetry(), dynamics::Symmetry{});
  std::string complaints;
  EXPECT_FALSE(read_floating(changed("radiation: none, "), complaints));
  EXPECT_THAT(complaints, HasSubstr("no vessel makes waves"));
  EXPECT_FALSE(read_floating(changed("database: none.h5, "), complaints));
  EXPECT_THAT(complaints, HasSubstr("lids are given beside a database"));
}

// The Green function needs no panels on the surface; where the surface is marched, or nothing is
// computed, it would do nothing.
TEST(MarineParts, MethodIsThatOfTheProblem) {
  const auto changed = [&](const std::string& method, const std::string& vessel) {
    return with(with(floating, "sea:", "sea:\n  radiation: {method: " + method + "}"),
                "damping:", vessel + "damping:");
  };
  const RadiationProblem marched = radiation_problem(sound(changed("marched surface", "")));
  EXPECT_EQ(marched.method, dynamics::PanelMethod::marched_surface);
  const RadiationProblem problem = radiation_problem(sound(changed("green function", "")));
  EXPECT_EQ(problem.method, dynamics::PanelMethod::green_function);
  EXPECT_EQ(make_panel_model(problem).surface_mesh().size(), 0);
  std::string complaints;
  EXPECT_FALSE(read_floating(changed("green function", "radiation: direct, "), complaints));
  EXPECT_THAT(complaints, HasSubstr("for which the surface is marched"));
  EXPECT_FALSE(read_floating(changed("green function", "radiation: none, "), complaints));
  EXPECT_THAT(complaints, HasSubstr("no vessel makes waves"));
  EXPECT_FALSE(read_floating(changed("green function", "database: none.h5, "), complaints));
  EXPECT_THAT(complaints, HasSubstr("nothing is computed"));
  EXPECT_FALSE(read_floating(changed("green functions", ""), complaints));
  EXPECT_THAT(complaints, HasSubstr("did you mean"));
}

// The free vessel whose mean drift is asked for: mass with what stands on it, about the point in
// the water line above the origin, in the world's axes (the barge heads along y).
TEST(MarineParts, DriftAsksForTheFarField) {
  EXPECT_FALSE(radiation_problem(sound(floating)).drifting);
  const MechanismFile file = sound(with(floating, "damping:", "drift: newman, damping:"));
  const RadiationProblem problem = radiation_problem(file);
  ASSERT_TRUE(problem.drifting);
  EXPECT_TRUE(problem.far_field);
  const Eigen::MatrixXd& mass = problem.drifting->mass;
  EXPECT_NEAR(mass(0, 0), 1722e3, 1.0);
  // The centre of mass lies 0.9 m above the reference point: surge there with a turn about y.
  EXPECT_NEAR(mass(0, 4), 1722e3 * 0.9, 1.0);
  EXPECT_NEAR(mass(1, 3), -1722e3 * 0.9, 1.0);
  EXPECT_NEAR(mass(4, 4), 1722e3 * (36.0 + 0.81), 1e2);
  EXPECT_NEAR(problem.drifting->stiffness(2, 2), 1025 * 9.80665 * 800, 1.0);
  EXPECT_NEAR(problem.drifting->damping(1, 1), 20e3, 1e-6);
  EXPECT_NEAR(problem.drifting->damping(0, 0), 0.0, 1e-6);
}

TEST(MarineParts, DriftComesFromADatabase) {
  const TemporaryFolder folder;
  folder.write("vessels/barge.yaml", test::sample_barge);
  folder.write("mechanism.yaml",
               with(floating, "damping:", "database: pontoon.h5, drift: newman, damping:"));
  write_database("pontoon.h5", {"pontoon"});
  ModelLibrary library({});
  Diagnostics without;
  EXPECT_FALSE(read_mechanism("mechanism.yaml", library, without));
  EXPECT_THAT(without.to_text(), HasSubstr("holds no mean drift forces"));
  dynamics::HydrodynamicDatabase database = read_hydrodynamic_database("pontoon.h5");
  database.mean_drift.assign(2, Eigen::MatrixXd::Constant(6, 8, 1e3));
  write_hydrodynamic_database("pontoon.h5", database);
  Diagnostics diagnostics;
  const auto file = read_mechanism("mechanism.yaml", library, diagnostics);
  ASSERT_TRUE(file) << diagnostics.to_text();
  // What its excitation has in the mean is taken off with the free vessel's motions, along the
  // database's axes, which are the vessel's own, about its reference point 0.5 m before the origin.
  const RadiationProblem problem = radiation_problem(*file);
  ASSERT_TRUE(problem.drifting);
  const Eigen::MatrixXd& mass = problem.drifting->mass;
  EXPECT_NEAR(mass(1, 5), -1722e3 * 0.5, 1.0);
  EXPECT_NEAR(problem.drifting->damping(0, 0), 20e3, 1e-6);
  const dynamics::HydrodynamicSeries series{0, {0.0}, {database}};
  const BuiltMechanism built = build_mechanism(*file, &series);
  const auto drifts = [](const dynamics::LiftSystem& system) {
    return std::get<std::vector<dynamics::SlowDrift>>(system.elements()).size();
  };
  EXPECT_EQ(drifts(built.system), 1U);
  EXPECT_EQ(drifts(built.at_rest()), 0U);
  // What the drift holds is not in the hull's own pressure besides.
  const auto& elements = built.system.elements();
  const auto& hull = std::get<std::vector<dynamics::HullForce>>(elements).at(0).definition();
  const auto& waves = std::get<std::vector<dynamics::DiffractionForce>>(elements).at(0);
  ASSERT_TRUE(hull.p_BoR_B);
  EXPECT_LT((*hull.p_BoR_B - waves.definition().frame.X_BH.p).norm(), 1e-12);
  EXPECT_EQ(waves.definition().froude_krylov, dynamics::FroudeKrylovPart::along_water);
}

TEST(MarineParts, ComplainsAboutDriftAndCurrentLoads) {
  const auto complaint = [](const std::string& keys) {
    return complaints_of_change("damping:", keys + ", damping:");
  };
  EXPECT_THAT(complaint("drift: newmann"), HasSubstr("newman"));
  EXPECT_THAT(complaint("radiation: none, drift: newman"), HasSubstr("its radiation is none"));
  EXPECT_THAT(complaint("radiation: direct, drift: newman"), HasSubstr("its radiation is direct"));
  EXPECT_THAT(complaint("draughts: [1 m, 2 m], drift: newman"), HasSubstr("is lowered"));
  EXPECT_THAT(complaint("drift: newman}\n  B2: {model: vessels/barge, position: [90 m, 0 m]"),
              HasSubstr("of all vessels together only"));
  const auto current = [&](const std::string& rows, const std::string& more = "") {
    return complaint("current_load: {area: 80 m^2, length: 40 m, coefficients: " + rows + "}" +
                     more);
  };
  EXPECT_EQ(current("[[0 deg, 0.1, 0, 0], [180 deg, -0.1, 0, 0]]"), "");
  EXPECT_THAT(current("[[0 deg, 0.1, 0, 0], [90 deg, 0, 1, 0]]"), HasSubstr("from 0 to 90 deg"));
  EXPECT_THAT(current("[[0 deg, 0.1, 0, 0], [0 deg, 0, 1, 0]]"), HasSubstr("must ascend"));
  EXPECT_THAT(current("[[0, 0.1, 0, 0], [180 deg, 0, 1, 0]]"), HasSubstr("row 1 of the"));
  EXPECT_THAT(
      current("[[0 deg, 0.1, 0, 0], [180 deg, -0.1, 0, 0]]", ", quadratic_damping: {sway: 5 t/m}"),
      HasSubstr("given twice"));
}

TEST(MarineParts, CurrentLoadActsHalfWayDownTheDraught) {
  const MechanismFile file = sound(with(
      floating, "damping:",
      "current_load: {area: 84 m^2, length: 40 m, coefficients: [[0 deg, 0.1, 0, 0], [90 deg, 0, "
      "0.8, 0.02], [180 deg, -0.1, 0, 0]]}, damping:"));
  const BuiltMechanism built = build_mechanism(file);
  const auto& loads = std::get<std::vector<dynamics::CurrentLoad>>(built.system.elements());
  ASSERT_EQ(loads.size(), 1U);
  EXPECT_LT((loads[0].definition().reference.p_BoQ_B - Vector3(0, 0, 1.05)).norm(), 1e-6);
  EXPECT_NEAR(loads[0].definition().reference_volume, 1680.0, 1e-6);
  EXPECT_DOUBLE_EQ(loads[0].definition().coefficients.table[1].n, 0.02);
}

// In still water without other forces: a barge held by matrices.
const std::string restrained = R"(mechanism: restrained
sea: {}
vessels:
  B1:
    model: vessels/barge
    position: [3 m, 4 m]
    heading: 90 deg
    radiation: none
    restraint:
      stiffness:
        - [400 kN/m, 0, 0, 0, -3 MN, 0]
        - [0, 300 kN/m, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [-3 MN, 0, 0, 0, 60 MN m/rad, 0]
        - [0, 0, 0, 0, 0, 500 MN m/rad]
      damping:
        - [0, 0, 0, 0, 0, 0]
        - [0, 20 kN s/m, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
initial: {positions: {B1: [3 m, 4.5 m, -2 m, 0 deg, 0 deg, 90 deg]}}
simulate: {duration: 2 s, relative_tolerance: 1e-8}
)";

// Along its own x the barge moves with the mass of 1,640 t alone; it heads along the world's y.
TEST(MarineParts, RestraintHoldsAVesselByMatrices) {
  const MechanismFile file = sound(restrained);
  const BuiltMechanism built = build_mechanism(file);
  const auto& elements = built.system.elements();
  const auto& restraints = std::get<std::vector<dynamics::LinearRestraint>>(elements);
  ASSERT_EQ(restraints.size(), 1U);
  const dynamics::LinearRestraint::Definition& d = restraints.front().definition();
  EXPECT_LT((d.point.p_BoQ_B - Vector3(0, 0, 3)).norm(), 1e-12);
  EXPECT_LT((d.X_WR.p - Vector3(3, 4, 1)).norm(), 1e-6);
  EXPECT_EQ(d.stiffness(3, 3), 400e3);
  EXPECT_EQ(d.stiffness(3, 1), -3e6);
  EXPECT_EQ(d.stiffness(1, 3), -3e6);
  EXPECT_EQ(d.stiffness(1, 1), 60e6);
  EXPECT_EQ(d.stiffness(2, 2), 500e6);
  EXPECT_EQ(d.damping(4, 4), 20e3);
  dynamics::LiftWorkspace w(built.system);
  Eigen::VectorXd y(built.system.state_size()), rate(built.system.state_size());
  get_state(built.system, built.system.q_start(), built.system.v_start(), y);
  const dynamics::Contacts contacts;
  calc_right_hand_side(built.system, 0, y, &contacts, w, rate);
  // Half a metre ahead: back by surge, and bow up or down by the mixed term.
  const dynamics::ForceVector& F = w.loads.F_Bo_W[built.system.mechanism().body_index("B1")];
  EXPECT_NEAR(F.force.y(), -0.5 * 400e3, 1.0);
  EXPECT_NEAR(F.moment.x(), 0.5 * -3e6 - 3.0 * -0.5 * 400e3, 1e3);
  const std::string about =
      with(restrained, "      damping:", "      about: [0 m, 0 m, 0 m]\n      damping:");
  const BuiltMechanism elsewhere = build_mechanism(sound(about));
  const auto& second =
      std::get<std::vector<dynamics::LinearRestraint>>(elsewhere.system.elements()).front();
  EXPECT_EQ(second.definition().point.p_BoQ_B, Vector3::Zero());
}

TEST(MarineParts, ComplainsAboutRestraints) {
  const auto complaints = [](const char* old_passage, const char* new_passage) {
    std::string text;
    read_floating(with(restrained, old_passage, new_passage), text);
    return text;
  };
  EXPECT_THAT(complaints("[400 kN/m, 0,", "[400 kN, 0,"),
              HasSubstr("row 1, column 1 of stiffness is a force; a stiffness such as"));
  EXPECT_THAT(complaints("[400 kN/m, 0,", "[400, 0,"),
              HasSubstr("row 1, column 1 of stiffness is a plain number"));
  EXPECT_THAT(complaints("- [-3 MN, 0", "- [-2 MN, 0"),
              HasSubstr("the stiffness is not symmetric: -2e+06 in row 5, column 1, and -3e+06 in "
                        "row 1, column 5 (SI)"));
  EXPECT_EQ(complaints("- [-3 MN, 0", "- [-2 MN, 0").find("20 kN s/m"), std::string::npos);
  EXPECT_THAT(complaints("20 kN s/m", "-20 kN s/m"), HasSubstr("the damping adds energy"));
  EXPECT_THAT(complaints("0, 500 MN m/rad]", "500 MN m/rad]"), HasSubstr("stiffness"));
  std::string text = with(restrained, "- [-3 MN, 0", "- [-2 MN, 0");
  text = with(text, "      damping:", "      symmetric: false\n      damping:");
  sound(text);
}

TEST(MarineParts, IrregularSeas) {
  const auto waves = [](const std::string& text) {
    const MechanismFile file =
        sound(with(floating, "regular: {amplitude: 0.3 m, period: 8 s, heading: 30 deg}", text));
    return make_sea(file, 9.80665).waves;
  };
  // The radiation goes up to what the panels carry: the height is a little less.
  const auto jonswap = waves("spectrum: {significant_height: 1 m, peak_period: 9 s, seed: 4}");
  EXPECT_EQ(jonswap.component_count(), 100U);
  EXPECT_NEAR(jonswap.significant_height(), 1, 0.02);
  const auto table = waves(
      "spectrum: {shape: table, table: [[0.5 rad/s, 0 m^2 s/rad], [0.7 rad/s, 0.1 m^2 s/rad], [0.9 "
      "rad/s, 0 m^2 s/rad]], components: 40, spreading: 4}");
  EXPECT_NEAR(table.significant_height(), 4 * std::sqrt(0.02), 0.01);
}

TEST(MarineParts, ReadsAMeasuredRecord) {
  std::string csv = "time,elevation\n";
  for (int i = 0; i < 200; ++i) {
    csv += std::to_string(0.5 * i) + "," + std::to_string(0.4 * std::cos(0.6 * 0.5 * i)) + "\n";
  }
  const std::string text =
      with(floating, "regular: {amplitude: 0.3 m, period: 8 s, heading: 30 deg}",
           "record: {file: waves.csv}");
  const auto complaints_with = [&](const std::string& content) {
    const TemporaryFolder folder;
    folder.write("vessels/barge.yaml", test::sample_barge);
    folder.write("mechanism.yaml", text);
    folder.write("waves.csv", content);
    Diagnostics diagnostics;
    ModelLibrary library({});
    read_mechanism("mechanism.yaml", library, diagnostics);
    return diagnostics.to_text();
  };
  EXPECT_EQ(complaints_with(csv), "");
  EXPECT_THAT(complaints_with(csv + "100.2,0\n"), HasSubstr("are not one step of"));
  EXPECT_THAT(complaints_with(csv + "100.0,nan\n"), HasSubstr("\"nan\" is not a finite number"));
  EXPECT_THAT(complaints_with("1\n2\n"), HasSubstr("a record has two columns"));
}

TEST(MarineParts, ComplainsAboutWhatCannotFloat) {
  EXPECT_THAT(
      complaints_of_change("sea:\n  waves: {regular: {amplitude: 0.3 m, period: 8 s, heading: "
                           "30 deg}, ramp: 10 s}\n  current: {speed: 0.5 m/s, towards: 90 deg}\n",
                           ""),
      HasSubstr("mechanism.yaml:3:3: error: vessel B1 floats in no sea"));
  EXPECT_THAT(complaints_of_change("amplitude: 0.3 m, period: 8 s", "amplitude: 3 m, period: 5 s"),
              HasSubstr("mechanism.yaml:3:10: error:"));
  EXPECT_THAT(
      complaints_of_change("amplitude: 0.3 m, period: 8 s", "amplitude: 0.1 m, period: 3 s"),
      HasSubstr("vessel B1: "));
  EXPECT_THAT(complaints_of_change("period: 8 s, ", ""),
              HasSubstr("needs either its frequency or its period"));
  EXPECT_THAT(complaints_of_change("towards: 90 deg", "towards: 90 deg, profile: tidal"),
              HasSubstr("a tidal current needs the depth of the sea"));
  EXPECT_THAT(complaints_of_change("heading: 90 deg", "draught: 7 m"),
              AllOf(HasSubstr("would float at a draught of 7 m"), EndsWith("\n1 error\n")));
  EXPECT_THAT(complaints_of_change("from: {body: B1", "from: {body: B2"),
              HasSubstr("tugger line T1 ends at body \"B2\", which does not exist"));
  EXPECT_THAT(complaints_of_change("from: {body: B1", "from: {body: wold"),
              HasSubstr("did you mean \"world\"?"));
  EXPECT_THAT(complaints_of_change("length: 35 m, stiffness: 100 kN/m", "stiffness: 100 kN/m"),
              HasSubstr("neither what tension it holds nor how it stretches"));
  EXPECT_THAT(complaints_of_change("stiffness: 100 kN/m", "stifness: 100 kN/m"),
              AllOf(HasSubstr("did you mean \"stiffness\"?"), EndsWith("\n1 error\n")));
  EXPECT_THAT(
      complaints_of_change("length: 35 m, stiffness: 100 kN/m", "length: 35 m, tension: 100 kN"),
      HasSubstr("a line that holds a tension has a length or stiffness"));
  EXPECT_EQ(complaints_of_change("length: 35 m, stiffness: 100 kN/m", "tension: 100 kN"), "");
  EXPECT_THAT(complaints_of_change("stiffness: 100 kN/m",
                                   "stiffness: 100 kN/m, breaking_load: 1 "
                                   "MN"),
              HasSubstr("lift cases alone hold its tension against"));
  EXPECT_THAT(complaints_of_change("model: vessels/barge", "model: vessels/bargo"),
              HasSubstr("did you mean \"vessels/barge\"?"));
  EXPECT_THAT(complaints_of_change("regular: {amplitude: 0.3 m, period: 8 s, heading: 30 deg}",
                                   "spectrum: {significant_height: 1 m}"),
              HasSubstr("lacks the key \"peak_period\""));
  EXPECT_THAT(complaints_of_change("mast: {", "B1: {"),
              HasSubstr("has the name of a body or joint"));
}

}  // namespace
}  // namespace blocklift::pipeline

// Vessels whose buoyancy is linear: what is built of the keys, of a database and of the hull, and
// what is refused.
#include "pipeline/files/environment/linear_buoyancy.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/simulation/equilibrium.h"
#include "pipeline/build/build_mechanism.h"
#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"
#include "tests/pipeline/sample_lift.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HullForce;
using dynamics::LinearBuoyancy;
using test::TemporaryFolder;
using test::with;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double rho_g = 1025 * 9.80665;

// 40 x 20 m, 2 m deep at 1,640 t.
constexpr auto pontoon = R"(kind: vessel
hull: {barge: {length: 40 m, breadth: 20 m, depth: 6 m}}
panel_size: 4 m
mass: 1640 t
centre_of_mass: [0 m, 0 m, 3 m]
radii_of_gyration: [6 m, 11 m, 11 m]
)";

const std::string afloat = R"(mechanism: afloat
sea: {}
vessels:
  B1:
    {model: vessels/pontoon, position: [3 m, 4 m], heading: 90 deg, radiation: none,
     linear_buoyancy: {}}
simulate: {duration: 2 s}
)";

/// The pontoon's database about (0, 0, 0.5) above the water line, its mass 4 m above the keel.
void write_pontoon(const std::string& file, const std::function<void(Eigen::MatrixXd&)>& change) {
  dynamics::HydrodynamicDatabase database;
  database.water = {1025, 9.80665};
  database.body_names = {"pontoon"};
  database.reference_points = {Vector3(0, 0, 0.5)};
  database.displaced_volumes = {1600};
  database.centres_of_buoyancy = {Vector3(0.1, 0, -1)};
  database.centres_of_mass = {Vector3(0.1, 0, 2)};
  database.infinite_added_mass = 5e6 * Eigen::MatrixXd::Identity(6, 6);
  database.time_step = 0.2;
  database.retardation.assign(20, Eigen::MatrixXd::Zero(6, 6));
  database.frequencies = {0.5, 1.5};
  for (int h = 0; h < 8; ++h) database.headings.push_back(h * std::numbers::pi / 4);
  database.added_mass.assign(2, database.infinite_added_mass);
  database.damping.assign(2, Eigen::MatrixXd::Zero(6, 6));
  database.froude_krylov.assign(2, Eigen::MatrixXcd::Constant(6, 8, 2e4));
  database.diffraction.assign(2, Eigen::MatrixXcd::Constant(6, 8, 1e4));
  database.hydrostatic_stiffness = Eigen::MatrixXd::Zero(6, 6);
  database.hydrostatic_stiffness.diagonal() << 0, 0, 8e6, 2e8, 1e9, 0;
  database.hydrostatic_stiffness(2, 4) = database.hydrostatic_stiffness(4, 2) = 1e6;
  change(database.hydrostatic_stiffness);
  write_hydrodynamic_database(file, database);
}

struct ReadMechanism {
  std::optional<MechanismFile> file;
  std::string complaints;
};

ReadMechanism read(
    const std::string& text,
    const std::function<void(Eigen::MatrixXd&)>& change = [](Eigen::MatrixXd&) {}) {
  const TemporaryFolder folder;
  folder.write("vessels/pontoon.yaml", pontoon);
  folder.write("mechanism.yaml", text);
  write_pontoon("pontoon.h5", change);
  Diagnostics diagnostics;
  ModelLibrary library({});
  ReadMechanism result;
  result.file = read_mechanism("mechanism.yaml", library, diagnostics);
  result.complaints = diagnostics.to_text();
  return result;
}

LinearBuoyancy::Definition definition_in(const BuiltMechanism& built) {
  const auto& elements = built.system.elements();
  EXPECT_TRUE(std::get<std::vector<HullForce>>(elements).empty());
  const auto& found = std::get<std::vector<LinearBuoyancy>>(elements);
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? LinearBuoyancy::Definition() : found.front().definition();
}

// Of the hull at rest, about the origin on the base line, along the world's axes: she heads along
// y.
TEST(LinearBuoyancy, IsTheHullsAtRestWithoutADatabase) {
  const ReadMechanism given = read(afloat);
  ASSERT_TRUE(given.file) << given.complaints;
  const BuiltMechanism built = build_mechanism(*given.file);
  const LinearBuoyancy::Definition d = definition_in(built);
  EXPECT_NEAR(d.buoyancy, 1640e3 * 9.80665, 1.0);
  EXPECT_NEAR(d.rest_height, -2.0, 1e-6);
  EXPECT_LT(d.centre.norm(), 1e-9);
  EXPECT_NEAR(d.stiffness(0, 0), rho_g * 800, 1.0);
  // rho g (I + V KB); a turn about the world's x is the pontoon's pitch.
  EXPECT_NEAR(d.stiffness(1, 1), rho_g * (20 * 64000.0 / 12 + 1600), 1e3);
  EXPECT_NEAR(d.stiffness(2, 2), rho_g * (40 * 8000.0 / 12 + 1600), 1e3);
  Eigen::VectorXd q = built.system.q_start();
  dynamics::EquilibriumSolver(built.at_rest()).solve(0, q);
  EXPECT_LT((q - built.system.q_start()).norm(), 1e-6);
}

TEST(LinearBuoyancy, IsThatOfAPublication) {
  const std::string given = R"(
    linear_buoyancy:
      about: [0 m, 0 m, 1 m]
      stiffness:
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 0, 0, 0, 0]
        - [0, 0, 7 MN/m, 0, 2 MN, 0]
        - [0, 0, 0, 200 MN m/rad, 0, 0]
        - [0, 0, 2 MN, 0, 900 MN m/rad, 0]
        - [0, 0, 0, 0, 0, 0])";
  const std::string text =
      "mechanism: afloat\nsea: {}\nvessels:\n  B1:\n    model: "
      "vessels/pontoon\n    radiation: none" +
      given + "\nsimulate: {duration: 2 s}\n";
  const ReadMechanism published = read(text);
  ASSERT_TRUE(published.file) << published.complaints;
  const LinearBuoyancy::Definition d = definition_in(build_mechanism(*published.file));
  EXPECT_LT((d.frame.X_BH.p - Vector3(0, 0, 1)).norm(), 1e-12);
  // The weight's centre lies 2 m above the point.
  const double of_weight = 2.0 * 1640e3 * 9.80665;
  EXPECT_NEAR(d.stiffness(1, 1), 200e6 + of_weight, 1.0);
  EXPECT_NEAR(d.stiffness(2, 2), 900e6 + of_weight, 1.0);
  EXPECT_EQ(d.stiffness(0, 2), 2e6);
  const auto complaint = [&](const char* old_passage, const char* new_passage) {
    return read(with(text, old_passage, new_passage)).complaints;
  };
  EXPECT_THAT(
      complaint("[0, 0, 0, 0, 0, 0]\n        - [0, 0, 7",
                "[0, 3 kN/m, 0, 0, 0, 0]\n        - [0, 0, 7"),
      AllOf(HasSubstr("has 3000 in row 2, column 2 (SI), sway by sway"), HasSubstr("restraint")));
  EXPECT_THAT(complaint("0, 2 MN, 0]", "0, 1 MN, 0]"), HasSubstr("the stiffness is not symmetric"));
  EXPECT_THAT(complaint("7 MN/m", "7 MN"), HasSubstr("row 3, column 3 of stiffness is a force"));
}

// The database's body displaces less than the hull's mass; its frame is the vessel's, level.
TEST(LinearBuoyancy, IsThatOfADatabase) {
  const std::string text = with(with(afloat, "radiation: none", "database: pontoon.h5"), "sea: {}",
                                "sea: {waves: {regular: {amplitude: 0.3 m, period: 8 s}}}");
  const ReadMechanism named = read(text);
  ASSERT_TRUE(named.file) << named.complaints;
  const RadiationProblem problem = radiation_problem(*named.file);
  const dynamics::HydrodynamicSeries series{0, {0.0}, {*problem.given}};
  const BuiltMechanism built = build_mechanism(*named.file, &series);
  const LinearBuoyancy::Definition d = definition_in(built);
  EXPECT_NEAR(d.buoyancy, rho_g * 1600, 1e-3);
  EXPECT_LT((d.frame.X_BH.p - Vector3(0, 0, 2.5)).norm(), 1e-6);
  EXPECT_NEAR(d.rest_height, 0.5, 1e-6);
  EXPECT_LT((d.centre - Eigen::Vector2d(0.1, 0)).norm(), 1e-9);
  const double of_weight = 1.5 * rho_g * 1600;
  EXPECT_EQ(d.stiffness(0, 0), 8e6);
  EXPECT_NEAR(d.stiffness(1, 1), 2e8 + of_weight, 1.0);
  EXPECT_NEAR(d.stiffness(2, 2), 1e9 + of_weight, 1.0);
  EXPECT_EQ(d.stiffness(0, 2), 1e6);
  const auto& force =
      std::get<std::vector<dynamics::DiffractionForce>>(built.system.elements()).at(0);
  EXPECT_EQ(force.definition().froude_krylov, dynamics::FroudeKrylovPart::whole);

  const auto complaint = [&](const std::function<void(Eigen::MatrixXd&)>& change) {
    return read(text, change).complaints;
  };
  EXPECT_THAT(complaint([](Eigen::MatrixXd& C) { C.resize(0, 0); }),
              HasSubstr("its database pontoon.h5 has no hydrostatic stiffness"));
  EXPECT_THAT(complaint([](Eigen::MatrixXd& C) { C(0, 0) = 1e5; }),
              HasSubstr("has 1e+05 (SI) in surge by surge, where buoyancy has none"));
  EXPECT_THAT(complaint([](Eigen::MatrixXd& C) { C(3, 4) = 1e7; }),
              HasSubstr("is not symmetric in roll and pitch"));
  // Rounding of another program's file, and moments that turn with the yaw.
  EXPECT_EQ(complaint([](Eigen::MatrixXd& C) {
              C(0, 0) = 1.0;
              C(3, 4) = 1e3;
              C(3, 5) = 5e6;
            }),
            "");
}

TEST(LinearBuoyancy, RefusesWhatCannotBeLinear) {
  const auto complaint = [](const std::string& old_passage, const std::string& new_passage) {
    return read(with(afloat, old_passage, new_passage)).complaints;
  };
  EXPECT_THAT(complaint("sea: {}", "sea: {waves: {regular: {amplitude: 0.3 m, period: 8 s}}}"),
              AllOf(HasSubstr("its radiation is none"), HasSubstr("radiation: database")));
  EXPECT_THAT(complaint("radiation: none", "draughts: [1 m, 2 m]"),
              HasSubstr("it has draughts, between which it is not linear"));
  EXPECT_THAT(complaint("linear_buoyancy: {}", "linear_buoyancy: {about: [0 m, 0 m, 1 m]}"),
              HasSubstr("about is given without the stiffness"));
  EXPECT_THAT(complaint("linear_buoyancy: {}", "linear_buoyancy: {stifness: []}"),
              HasSubstr("did you mean \"stiffness\""));
}

}  // namespace
}  // namespace blocklift::pipeline

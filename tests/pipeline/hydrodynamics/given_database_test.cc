// Databases that a case names in place of computed ones.
#include "pipeline/hydrodynamics/given_database.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/loads/excitation_drift.h"
#include "pipeline/hydrodynamics/radiation_cache.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::Pose;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double low_frequency = 0.05;

/// Two barges of 40 x 20 m, 2 m deep in the water; the database has them the other way round.
HydrodynamicDatabase two_barges() {
  HydrodynamicDatabase database;
  database.water = {1025.0, 9.81};
  database.body_names = {"right", "left"};
  database.reference_points = {{0, -30, 1}, {0, 30, 1}};
  database.displaced_volumes = {1600, 1600};
  database.centres_of_buoyancy = {{0, -30, -1}, {0, 30, -1}};
  Eigen::VectorXd number(12);
  for (Eigen::Index k = 0; k < 12; ++k) number[k] = static_cast<double>(k);
  database.infinite_added_mass = number.asDiagonal();
  database.time_step = 0.2;
  database.retardation.assign(10, Eigen::MatrixXd::Identity(12, 12));
  database.frequencies = {low_frequency};
  database.headings = {0.0};
  database.added_mass = {database.infinite_added_mass};
  database.damping = {Eigen::MatrixXd::Zero(12, 12)};
  database.froude_krylov = {Eigen::MatrixXcd::Zero(12, 1)};
  database.diffraction = {Eigen::MatrixXcd::Zero(12, 1)};
  return database;
}

RadiationProblem problem_with(const HydrodynamicDatabase& database) {
  const auto hull = std::make_shared<const dynamics::Hull>(
      dynamics::make_barge({.length = 40, .breadth = 20, .depth = 6}, {16, 8, 6, 2}, "barge"));
  RadiationProblem problem;
  problem.given = std::make_shared<const HydrodynamicDatabase>(database);
  problem.water = database.water;
  problem.bodies = {{"left", hull, Pose::translation({0, 30, -2}), {0, 0, 3}},
                    {"right", hull, Pose::translation({0, -30, -2}), {0, 0, 3}}};
  problem.given_bodies = {1, 0};
  return problem;
}

std::string complaint(const HydrodynamicDatabase& database) {
  try {
    take_given_database(problem_with(database));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(GivenDatabase, HasTheBodiesInTheOrderOfTheCase) {
  const HydrodynamicDatabase taken = take_given_database(problem_with(two_barges()));
  EXPECT_EQ(taken.body_names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(taken.reference_points[0], Vector3(0, 30, 1));
  for (Eigen::Index k = 0; k < 12; ++k) {
    EXPECT_EQ(taken.infinite_added_mass(k, k), static_cast<double>((k + 6) % 12));
  }
}

// What hydro found out about its panels is said where a case names the file.
TEST(GivenDatabase, ItsPanelsAreDoubted) {
  HydrodynamicDatabase database = two_barges();
  database.retardation.clear();
  for (int n = 0; n < 100; ++n)
    database.retardation.push_back(1e5 * std::exp(-0.2 * n) * Eigen::MatrixXd::Identity(12, 12));
  database.change_from_coarser = Eigen::VectorXd::Constant(12, 0.01);
  database.excitation_change_from_coarser = database.change_from_coarser;
  database.excitation_change_from_coarser[9] = 0.43;
  std::vector<std::string> said;
  const FoundRadiation found = find_radiation(
      problem_with(database), [&](const std::string& what) { said.push_back(what); });
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("warning: the panels are coarse"),
                                   HasSubstr("waves on left in roll changes by 43 %"))));
  // As a sentence for the list of doubts of a lift or mechanism.
  EXPECT_THAT(found.doubts, ElementsAre(AllOf(StartsWith("The panels are coarse"),
                                              HasSubstr("waves on left in roll changes by 43 %"),
                                              EndsWith("%."))));
}

// The excitation of a simulation has a mean by itself on a body that moves with the waves: of the
// drift that a named database holds it is taken off, as of one that is computed. Motions are those
// of the case's free vessels, and the database's own stiffness stays.
TEST(GivenDatabase, DriftLosesWhatTheExcitationHasInTheMean) {
  HydrodynamicDatabase database = two_barges();
  database.retardation.clear();
  for (int n = 0; n < 100; ++n)
    database.retardation.push_back(1e5 * std::exp(-0.2 * n) * Eigen::MatrixXd::Identity(12, 12));
  database.frequencies = {0.8};
  database.added_mass = {1e6 * Eigen::MatrixXd::Identity(12, 12)};
  database.damping = {2e5 * Eigen::MatrixXd::Identity(12, 12)};
  database.headings.clear();
  for (int h = 0; h < 8; ++h) database.headings.push_back(h * std::numbers::pi / 4);
  Eigen::MatrixXcd X(12, 8);
  for (Eigen::Index m = 0; m < 12; ++m) {
    for (Eigen::Index h = 0; h < 8; ++h) {
      X(m, h) = 1e5 * std::polar(1.0, 0.4 * static_cast<double>(m * h));
    }
  }
  database.froude_krylov = {0.5 * X};
  database.diffraction = {0.5 * X};
  database.mean_drift = {Eigen::MatrixXd::Constant(12, 8, 7e3)};
  RadiationProblem problem = problem_with(database);
  const Eigen::MatrixXd mass = 1.6e6 * Eigen::MatrixXd::Identity(12, 12);
  problem.drifting = {mass, 8e6 * Eigen::MatrixXd::Identity(12, 12), 0.1 * mass};
  const FoundRadiation found = find_radiation(problem, {});
  const HydrodynamicDatabase& taken = found.series->databases.front();
  EXPECT_EQ(taken.hydrostatic_stiffness.size(), 0);
  // Of the equation of motion: its matrix is the same number for all modes here.
  const std::complex<double> stiffness(8e6 - 0.8 * 0.8 * 2.6e6, 0.8 * (2e5 + 1.6e5));
  const Eigen::MatrixXd besides =
      calc_excitation_drift(taken, {taken.excitation(0) / stiffness}).at(0);
  EXPECT_GT(besides.row(dynamics::surge).norm(), 100.0);
  EXPECT_GT(besides.row(6 + dynamics::sway).norm(), 100.0);
  EXPECT_LT((taken.mean_drift[0].array() - 7e3 + besides.array()).matrix().norm(),
            1e-9 * besides.norm());
}

// In waves of 25 km the pressure of the incident wave is that of still water one metre higher:
// rho g times the water plane in heave. What the database has besides is diffraction.
TEST(GivenDatabase, WholeExcitationLosesTheForceOfTheIncidentWave) {
  HydrodynamicDatabase database = two_barges();
  const double still = 1025.0 * 9.81 * 40.0 * 20.0;
  database.diffraction[0](dynamics::heave, 0) = 1.25 * still;  // of the right barge
  const HydrodynamicDatabase taken = take_given_database(problem_with(database));
  EXPECT_NEAR(taken.froude_krylov[0](dynamics::heave, 0).real(), still, 2e-3 * still);
  EXPECT_NEAR(taken.froude_krylov[0](6 + dynamics::heave, 0).real(), still, 2e-3 * still);
  EXPECT_NEAR(taken.diffraction[0](6 + dynamics::heave, 0).real(), 0.25 * still, 2e-3 * still);
  EXPECT_EQ(taken.excitation(0)(6 + dynamics::heave, 0).real(), 1.25 * still);
  // A database with both is left as it is.
  database.froude_krylov[0].setConstant(7.0);
  EXPECT_EQ(take_given_database(problem_with(database)).diffraction[0](6 + dynamics::heave, 0),
            database.diffraction[0](dynamics::heave, 0));
}

TEST(GivenDatabase, RefusesThatOfAnotherVessel) {
  HydrodynamicDatabase larger = two_barges();
  larger.displaced_volumes[1] = 1800;
  EXPECT_THAT(complaint(larger),
              AllOf(HasSubstr("body left displaces 1800 m3"), HasSubstr("vessel left 1600 m3"),
                    HasSubstr("of another vessel")));
  HydrodynamicDatabase elsewhere = two_barges();
  elsewhere.centres_of_buoyancy[0].y() = -40;
  EXPECT_THAT(complaint(elsewhere), HasSubstr("centre of buoyancy of vessel right lies (0, 10, "));
  RadiationProblem lowered = problem_with(two_barges());
  lowered.lowered = {0, {1.0, 2.0}};
  EXPECT_THROW(take_given_database(lowered), InputError);
}

// A database without centres of buoyancy, as WAMIT's: its stiffness tells where the water planes
// are, or its reference points roughly where the bodies are.
TEST(GivenDatabase, RefusesBodiesElsewhereByTheirWaterPlanes) {
  HydrodynamicDatabase imported = two_barges();
  imported.centres_of_buoyancy.clear();
  imported.displaced_volumes = {0, 0};
  const auto with_stiffness = [&](double x, double y) {
    HydrodynamicDatabase database = imported;
    const double heave = 1025.0 * 9.81 * 800.0;
    Eigen::MatrixXd& C = database.hydrostatic_stiffness;
    C = Eigen::MatrixXd::Zero(12, 12);
    for (const Eigen::Index body : {0, 6}) {
      C(body + 2, body + 2) = heave;
      C(body + 2, body + 3) = C(body + 3, body + 2) = heave * y;
      C(body + 2, body + 4) = C(body + 4, body + 2) = -heave * x;
    }
    return database;
  };
  EXPECT_THAT(complaint(with_stiffness(0, 0)), ::testing::IsEmpty());
  // About points beside the bodies: what counts is the middle of the water plane.
  HydrodynamicDatabase beside = with_stiffness(5, -7);
  for (Vector3& point : beside.reference_points) point += Vector3(-5, 7, 0);
  EXPECT_THAT(complaint(beside), ::testing::IsEmpty());
  EXPECT_THAT(complaint(with_stiffness(5, -7)),
              AllOf(HasSubstr("the water plane of vessel left lies (-5, 7) m from"),
                    HasSubstr("--body-at")));
  // Without stiffness.
  EXPECT_THAT(complaint(imported), ::testing::IsEmpty());
  imported.reference_points[0] = {500, 300, 0};
  EXPECT_THAT(complaint(imported), HasSubstr("the origin of vessel right lies (-500, -330) m"));
}

}  // namespace
}  // namespace blocklift::pipeline

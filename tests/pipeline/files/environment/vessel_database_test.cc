#include "pipeline/files/environment/vessel_database.h"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

// What the figures of a database tell of its conventions (doubts_about_conventions) is said by the
// name of the file.
TEST(VesselDatabase, IsDoubtedByName) {
  dynamics::HydrodynamicDatabase database;
  database.body_names = {"float"};
  database.frequencies = {0.5};
  Eigen::MatrixXd added_mass = Eigen::MatrixXd::Identity(6, 6);
  added_mass(0, 4) = added_mass(4, 0) = added_mass(1, 3) = added_mass(3, 1) = 0.1;
  database.added_mass = {added_mass};
  database.damping = {Eigen::MatrixXd::Zero(6, 6)};
  database.headings = {0, 45, 90};  // degrees
  given::Vessel vessel;
  vessel.database = Located<std::string>{"rm3.h5", {}};
  vessel.hydrodynamics = std::make_shared<const dynamics::HydrodynamicDatabase>(database);
  EXPECT_THAT(
      doubts_about_database({vessel}),
      ::testing::ElementsAre("Database rm3.h5: its 3 headings lie between 0 and 5157 degrees, "
                             "as if the headings were in degrees, and were read as radians."));
  vessel.radiation.value = RadiationMethod::none;
  EXPECT_THAT(doubts_about_database({vessel}), ::testing::IsEmpty());
}

}  // namespace
}  // namespace blocklift::pipeline

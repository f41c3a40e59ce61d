// Points and axes that the files of other programs are about.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/radiation/reference_points.h"
#include "pipeline/formats/hdf5_handle.h"
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"
#include "tests/pipeline/formats/hydrodynamics/sample_database.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::Vector3;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// To a share of the largest number.
template <class Matrix>
void expect_nine_digits(const Matrix& a, const Matrix& b) {
  constexpr double digits = 1e-9;
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), digits * a.cwiseAbs().maxCoeff());
}

/// All that WAMIT's files hold.
void expect_coefficients(const HydrodynamicDatabase& a, const HydrodynamicDatabase& b) {
  ASSERT_EQ(a.frequencies.size(), b.frequencies.size());
  for (std::size_t k = 0; k < a.frequencies.size(); ++k) {
    expect_nine_digits(a.added_mass[k], b.added_mass[k]);
    expect_nine_digits(a.damping[k], b.damping[k]);
    expect_nine_digits(a.excitation(k), b.excitation(k));
  }
  expect_nine_digits(a.infinite_added_mass, b.infinite_added_mass);
  expect_nine_digits(a.hydrostatic_stiffness, b.hydrostatic_stiffness);
}

/// The sample's first body alone.
HydrodynamicDatabase single_body() {
  HydrodynamicDatabase database = make_sample_database();
  for (auto* matrices : {&database.added_mass, &database.damping, &database.retardation}) {
    for (Eigen::MatrixXd& matrix : *matrices) matrix = matrix.topLeftCorner(6, 6).eval();
  }
  for (auto* forces : {&database.froude_krylov, &database.diffraction}) {
    for (Eigen::MatrixXcd& matrix : *forces) matrix = matrix.topRows(6).eval();
  }
  for (Eigen::MatrixXd* matrix : {&database.infinite_added_mass, &database.hydrostatic_stiffness}) {
    *matrix = matrix->topLeftCorner(6, 6).eval();
  }
  database.body_names.resize(1);
  database.displaced_volumes.resize(1);
  for (auto* points :
       {&database.reference_points, &database.centres_of_buoyancy, &database.centres_of_mass}) {
    points->resize(1);
  }
  return database;
}

// A database about a centre of mass off the axes is written about the point that is read.
TEST(Wamit, IsWrittenAboutThePointThatItIsReadAbout) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = single_body();
  database.reference_points = {{-1.45, 0.4, 1.1}};
  write_wamit("single", database);
  const HydrodynamicDatabase found = read_wamit("single", {1.0, database.water});
  EXPECT_EQ(found.reference_points[0], Vector3(0, 0, 0));
  // Of a force F on the body the moments about the origin have r x F more.
  const Eigen::MatrixXcd X = database.excitation(1), Y = found.excitation(1);
  for (Eigen::Index h = 0; h < X.cols(); ++h) {
    const Eigen::Vector3cd F = X.col(h).head<3>(), M = X.col(h).tail<3>();
    EXPECT_NEAR(std::abs(Y(3, h) - (M[0] + 0.4 * F[2] - 1.1 * F[1])), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(Y(4, h) - (M[1] + 1.1 * F[0] + 1.45 * F[2])), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(Y(5, h) - (M[2] - 1.45 * F[1] - 0.4 * F[0])), 0.0, 1e-6);
  }
  EXPECT_NEAR(found.added_mass[0](4, 4),
              database.added_mass[0](4, 4) + 2 * 1.1 * database.added_mass[0](0, 4) +
                  2 * 1.45 * database.added_mass[0](2, 4) +
                  1.1 * 1.1 * database.added_mass[0](0, 0) +
                  1.45 * 1.45 * database.added_mass[0](2, 2) +
                  2 * 1.1 * 1.45 * database.added_mass[0](0, 2),
              1e-3);
  // And back: the same to nine digits.
  expect_coefficients(database, about_points(found, database.reference_points));
}

// ULEN scales each kind of number by its own power, and the import takes it off again.
TEST(Wamit, LengthScalesWhatIsWritten) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = single_body();
  database.reference_points = {Vector3::Zero()};
  database.mean_drift.assign(database.frequencies.size(),
                             Eigen::MatrixXd::Constant(6, database.headings.size(), -700.0));
  constexpr double length = 12.5;
  write_wamit("single", database, length);
  const HydrodynamicDatabase found = read_wamit("single", {length, database.water});
  expect_coefficients(database, found);
  ASSERT_EQ(found.mean_drift.size(), database.mean_drift.size());
  expect_nine_digits(database.mean_drift[0], found.mean_drift[0]);
  // Read as if it were of 1 m: A over L^3 and L^5, X over L^2 and L^3, C over L^2 and L^4, drift
  // over L and L^2.
  const HydrodynamicDatabase bare = read_wamit("single", {1.0, database.water});
  const auto expect_share = [](double whole, double part, double power) {
    EXPECT_NEAR(part * std::pow(length, power), whole, 1e-12 * std::abs(whole)) << power;
  };
  expect_share(database.infinite_added_mass(2, 2), bare.infinite_added_mass(2, 2), 3);
  expect_share(database.added_mass[0](4, 4), bare.added_mass[0](4, 4), 5);
  expect_share(database.damping[1](0, 4), bare.damping[1](0, 4), 4);
  expect_share(std::abs(database.excitation(1)(2, 0)), std::abs(bare.excitation(1)(2, 0)), 2);
  expect_share(std::abs(database.excitation(1)(4, 0)), std::abs(bare.excitation(1)(4, 0)), 3);
  expect_share(database.hydrostatic_stiffness(2, 2), bare.hydrostatic_stiffness(2, 2), 2);
  expect_share(database.hydrostatic_stiffness(4, 4), bare.hydrostatic_stiffness(4, 4), 4);
  expect_share(database.mean_drift[0](0, 0), bare.mean_drift[0](0, 0), 1);
  expect_share(database.mean_drift[0](5, 0), bare.mean_drift[0](5, 0), 2);
}

std::string message_of(const WamitScales& scales) {
  try {
    read_wamit("pair", scales);
  } catch (const HydrodynamicFileError& error) {
    return error.what();
  }
  return {};
}

// Files of several bodies are of no use without the places of their axes.
TEST(Wamit, SeveralBodiesNeedTheirAxes) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase database = make_sample_database();
  write_wamit("pair", database);
  WamitScales scales{1.0, database.water, {}};
  EXPECT_THAT(message_of(scales),
              AllOf(HasSubstr("pair.1: holds 2 bodies"), HasSubstr("--body-at x,y[,z[,heading]]")));
  scales.bodies = {{{1, 2, 0}}};
  EXPECT_THAT(message_of(scales), HasSubstr("2 bodies, and 1 are placed"));
  scales.bodies.clear();
  for (const Vector3& point : wamit_points(database)) scales.bodies.push_back({point});
  const HydrodynamicDatabase found = read_wamit("pair", scales);
  EXPECT_EQ(found.reference_points[1], Vector3(12.5, 0, 0));
  expect_coefficients(database, about_points(found, database.reference_points));
  folder.write("pair.9", "1 0 0 1 1 0 1 0\n");
  scales.bodies[1].heading = 1.0;
  EXPECT_THAT(message_of(scales), HasSubstr("mean drift of turned bodies"));
}

// A body whose own x axis is the world's y: its surge is the world's sway, its sway backward surge.
TEST(Wamit, TurnsBodiesToTheWorldsAxes) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = single_body();
  database.reference_points = {{0, 0, 0}};
  write_wamit("single", database);
  const WamitScales scales{1.0, database.water, {{{3, 4, 1}, std::numbers::pi / 2}}};
  const HydrodynamicDatabase found = read_wamit("single", scales);
  EXPECT_EQ(found.reference_points[0], Vector3(3, 4, 1));
  const Eigen::MatrixXd &own = database.added_mass[1], &turned = found.added_mass[1];
  constexpr double rounding = 1e-6;
  EXPECT_NEAR(turned(1, 1), own(0, 0), rounding);
  EXPECT_NEAR(turned(0, 0), own(1, 1), rounding);
  EXPECT_NEAR(turned(0, 3), own(1, 4), rounding);
  EXPECT_NEAR(turned(0, 4), -own(1, 3), rounding);
  EXPECT_NEAR(turned(2, 4), own(2, 3), rounding);
  const Eigen::MatrixXcd X = database.excitation(1), Y = found.excitation(1);
  EXPECT_NEAR(std::abs(Y(0, 1) + X(1, 1)), 0.0, rounding);
  EXPECT_NEAR(std::abs(Y(4, 1) - X(3, 1)), 0.0, rounding);
}

TEST(Import, ToldPlacesAreForFilesThatDoNotTellThem) {
  const test::TemporaryFolder folder;
  folder.write("body.nc", "");
  EXPECT_THROW(import_hydrodynamics("body.nc", {1.0, {}, {{{1, 2, 0}}}}), HydrodynamicFileError);
}

std::string refusal_of_writing(const std::string& file, const HydrodynamicDatabase& database) {
  try {
    write_bemio(file, database);
  } catch (const HydrodynamicFileError& error) {
    return error.what();
  }
  return {};
}

TEST(Bemio, IsAboutTheCentresOfMassAndNeedsThem) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase database = make_sample_database();
  write_bemio("wec.h5", database);
  const HydrodynamicDatabase found = read_bemio("wec.h5");
  EXPECT_EQ(found.centres_of_mass, database.centres_of_mass);
  EXPECT_EQ(found.reference_points, database.centres_of_mass);
  const HydrodynamicDatabase back = about_points(found, database.reference_points);
  expect_nine_digits(database.added_mass[1], back.added_mass[1]);
  expect_nine_digits(database.diffraction[1], back.diffraction[1]);
  HydrodynamicDatabase unknown = database;
  unknown.displaced_volumes[1] = 0.0;
  unknown.centres_of_mass.clear();
  EXPECT_THAT(refusal_of_writing("no.h5", unknown),
              AllOf(HasSubstr("displaced volumes (disp_vol), centres of mass (cg)"),
                    Not(HasSubstr("buoyancy"))));
  EXPECT_FALSE(std::filesystem::exists("no.h5"));
}

// Zeros of programs that know no volumes are no centres.
TEST(Bemio, TakesNoCentresOfBodiesThatDisplaceNothing) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  database.reference_points = database.centres_of_mass;
  write_bemio("wec.h5", database);
  {
    const hdf5::Handle file(H5Fopen("wec.h5", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const hdf5::Handle volume(H5Dopen2(file.get(), "/body1/properties/disp_vol", H5P_DEFAULT),
                              H5Dclose);
    const double none = 0.0;
    H5Dwrite(volume.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &none);
  }
  const HydrodynamicDatabase found = read_bemio("wec.h5");
  EXPECT_EQ(found.reference_points, database.reference_points);
  EXPECT_TRUE(found.centres_of_mass.empty());
  EXPECT_TRUE(found.centres_of_buoyancy.empty());
}

// Surge and sway off the new point turn; no heel is made up where none is known.
TEST(ReferencePoints, LevelDriftStaysLevel) {
  HydrodynamicDatabase database = single_body();
  database.reference_points = {{2, 0, 3}};
  Eigen::MatrixXd drift = Eigen::MatrixXd::Zero(6, 2);
  drift.row(1).setConstant(5.0);
  database.mean_drift.assign(3, drift);
  const Eigen::MatrixXd level = about_points(database, {{0, 0, 0}}).mean_drift[0];
  EXPECT_EQ(level(5, 0), 10.0);
  EXPECT_EQ(level(3, 0), 0.0);
  for (Eigen::MatrixXd& D : database.mean_drift) D.row(2).setConstant(1.0);
  EXPECT_EQ(about_points(database, {{0, 0, 0}}).mean_drift[0](3, 0), -15.0);
}

}  // namespace
}  // namespace blocklift::pipeline

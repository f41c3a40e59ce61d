// Databases of other programs: their conventions by files made by hand, and round trips.
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/radiation/reference_points.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"
#include "pipeline/formats/hdf5_handle.h"
#include "pipeline/formats/results_store.h"
#include "tests/pipeline/formats/hydrodynamics/sample_database.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using ::testing::HasSubstr;
using Complex = std::complex<double>;

using std::numbers::pi;

template <class Action>
std::string message_of_import(const Action& action) {
  try {
    action();
  } catch (const HydrodynamicFileError& error) {
    return error.what();
  }
  return {};
}

template <class Matrix>
void expect_near(const std::vector<Matrix>& a, const std::vector<Matrix>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].rows(), b[k].rows());
    ASSERT_EQ(a[k].cols(), b[k].cols());
    if (a[k].size() == 0) continue;
    // Number by number: each is divided once and multiplied once.
    EXPECT_LT(((a[k] - b[k]).array() / a[k].array().abs()).abs().maxCoeff(), tolerance);
  }
}

constexpr double two_roundings = 1e-15;

TEST(Bemio, RoundTripIsExactButForTheScaling) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  database.reference_points = database.centres_of_mass;
  // BEMIO holds each body's own stiffness alone.
  database.hydrostatic_stiffness.topRightCorner(6, 6).setZero();
  database.hydrostatic_stiffness.bottomLeftCorner(6, 6).setZero();
  write_bemio("wec.h5", database);
  const HydrodynamicDatabase found = read_bemio("wec.h5");
  EXPECT_EQ(found.body_names, database.body_names);
  EXPECT_EQ(found.water.depth, database.water.depth);
  EXPECT_EQ(found.water.density, database.water.density);
  EXPECT_EQ(found.centres_of_buoyancy, database.centres_of_buoyancy);
  EXPECT_EQ(found.reference_points, database.reference_points);
  EXPECT_EQ(found.displaced_volumes, database.displaced_volumes);
  EXPECT_EQ(found.frequencies, database.frequencies);
  EXPECT_EQ(found.time_step, database.time_step);
  EXPECT_NEAR(found.headings[1], database.headings[1], 1e-15);
  expect_near(
      {database.hydrostatic_stiffness + Eigen::MatrixXd::Ones(12, 12)},
      std::vector<Eigen::MatrixXd>{found.hydrostatic_stiffness + Eigen::MatrixXd::Ones(12, 12)},
      two_roundings);
  expect_near({database.infinite_added_mass},
              std::vector<Eigen::MatrixXd>{found.infinite_added_mass}, two_roundings);
  expect_near(database.added_mass, found.added_mass, two_roundings);
  expect_near(database.damping, found.damping, two_roundings);
  expect_near(database.retardation, found.retardation, two_roundings);
  expect_near(database.froude_krylov, found.froude_krylov, two_roundings);
  expect_near(database.diffraction, found.diffraction, two_roundings);
}

/// About the centres of mass, as BEMIO's files are.
HydrodynamicDatabase about_mass(HydrodynamicDatabase database) {
  database.reference_points = database.centres_of_mass;
  return database;
}

/// The database with mean drift forces.
HydrodynamicDatabase with_drift(HydrodynamicDatabase database) {
  const auto headings = static_cast<Eigen::Index>(database.headings.size());
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    database.mean_drift.emplace_back(Eigen::MatrixXd::Constant(12, headings, 3.0) +
                                     Eigen::MatrixXd::Random(12, headings));
  }
  return database;
}

TEST(Bemio, BringsMeanDriftOfTheMethodThatTellsBodiesApart) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase database = about_mass(with_drift(make_sample_database()));
  write_bemio("wec.h5", database);
  expect_near(database.mean_drift, read_bemio("wec.h5").mean_drift, two_roundings);
  // Momentum far away belongs to both bodies together.
  {
    const hdf5::Handle file(H5Fopen("wec.h5", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    for (const std::string body : {"/body1", "/body2"}) {
      const std::string group = body + "/hydro_coeffs/mean_drift/";
      H5Lmove(file.get(), (group + "control_surface").c_str(), file.get(),
              (group + "momentum_conservation").c_str(), H5P_DEFAULT, H5P_DEFAULT);
    }
  }
  EXPECT_TRUE(read_bemio("wec.h5").mean_drift.empty());
}

TEST(Bemio, DeepWaterAndDefects) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = about_mass(make_sample_database());
  database.water.depth = std::numeric_limits<double>::infinity();
  write_bemio("deep.h5", database);
  EXPECT_TRUE(std::isinf(read_bemio("deep.h5").water.depth));
  database.damping[2](3, 4) = std::nan("");
  write_bemio("nan.h5", database);
  EXPECT_THAT(message_of_import([] { read_bemio("nan.h5"); }),
              HasSubstr("the damping at 1.1 rad/s is not a number for left roll by left pitch"));
  EXPECT_THAT(message_of_import([] { read_bemio("none.h5"); }), HasSubstr("there is no such file"));
}

// WAMIT's own scaling: with L = 2 m, rho = 1000 and g = 10, A33 = rho L^3 a, A34 = rho L^4 a,
// A44 = rho L^5 a, B = the same times w; X3 = rho g L^2 x, X4 = rho g L^3 x; C33 = rho g L^2 c,
// C44 = rho g L^4 c. Periods in whatever order, zero and infinite frequency among them. Below the
// diagonal there is nothing, which makes it symmetric.
TEST(Wamit, ScalesAsItsManualSays) {
  const test::TemporaryFolder folder;
  std::string radiation = " -1.0 3 3 0.9\n 0.0 3 3 0.5\n 0.0 3 4 0.2\n 0.0 4 4 0.1\n";
  for (const char* const period : {"4.0", "8.0", "2.0"}) {
    radiation += std::string(period) + " 3 3 0.7 0.2\n" + period + " 3 4 0.1 0.05\n" + period +
                 " 4 4 0.3 0.1\n";
  }
  folder.write("barge.1", radiation);
  std::string excitation;
  for (const char* const period : {"8.0", "4.0", "2.0"}) {
    excitation +=
        std::string(period) + " 90.0 3 5.0 53.13 3.0 4.0\n" + period + " 90.0 4 2.0 90.0 0.0 2.0\n";
  }
  folder.write("barge.3", excitation);
  std::string stiffness;
  for (int i = 1; i <= 6; ++i) {
    for (int j = 1; j <= 6; ++j) {
      const char* const value = i != j ? " 0.0\n" : i == 3 ? " 1.5\n" : i == 4 ? " 0.25\n" : " 0\n";
      stiffness += std::to_string(i) + " " + std::to_string(j) + value;
    }
  }
  folder.write("barge.hst", stiffness);
  const HydrodynamicDatabase database = read_wamit("barge", {2.0, {1000.0, 10.0}});
  ASSERT_EQ(database.frequencies.size(), 3U);
  EXPECT_DOUBLE_EQ(database.frequencies[0], 2 * pi / 8.0);
  const double w = database.frequencies[1];
  EXPECT_DOUBLE_EQ(database.added_mass[1](2, 2), 1000 * 8 * 0.7);
  EXPECT_DOUBLE_EQ(database.added_mass[1](2, 3), 1000 * 16 * 0.1);
  EXPECT_DOUBLE_EQ(database.added_mass[1](3, 2), 1000 * 16 * 0.1);
  EXPECT_DOUBLE_EQ(database.damping[1](3, 2), 1000 * 16 * w * 0.05);
  EXPECT_DOUBLE_EQ(database.infinite_added_mass(3, 2), 1000 * 16 * 0.2);
  EXPECT_DOUBLE_EQ(database.added_mass[1](3, 3), 1000 * 32 * 0.3);
  EXPECT_DOUBLE_EQ(database.damping[1](3, 3), 1000 * 32 * w * 0.1);
  EXPECT_DOUBLE_EQ(database.infinite_added_mass(2, 2), 1000 * 8 * 0.5);
  EXPECT_DOUBLE_EQ(database.headings.at(0), pi / 2);
  EXPECT_EQ(database.excitation(1)(2, 0), Complex(10000 * 4 * 3.0, 10000 * 4 * 4.0));
  EXPECT_EQ(database.excitation(1)(3, 0), Complex(0.0, 10000 * 8 * 2.0));
  EXPECT_DOUBLE_EQ(database.hydrostatic_stiffness(2, 2), 10000 * 4 * 1.5);
  EXPECT_DOUBLE_EQ(database.hydrostatic_stiffness(3, 3), 10000 * 16 * 0.25);
  EXPECT_GT(database.retardation.size(), 2U);
}

// F1 = rho g L f, F6 = rho g L^2 f; of crossing waves nothing is taken; .9 goes before .8.
TEST(Wamit, TakesMeanDriftOver) {
  const test::TemporaryFolder folder;
  std::string radiation, excitation, drift, momentum;
  for (const std::string period : {"4.0", "8.0", "16.0"}) {
    radiation += period + " 3 3 0.7 0.2\n";
    for (const std::string heading : {"0.0", "90.0"}) {
      excitation += period + " " + heading + " 3 5.0 53.13 3.0 4.0\n";
      drift += period + " " + heading + " " + heading + " 1 0.5 180.0 -0.5 0.0\n";
      drift += period + " " + heading + " " + heading + " 6 0.25 0.0 0.25 0.0\n";
      momentum += period + " " + heading + " " + heading + " 1 9.0 0.0 9.0 0.0\n";
    }
    drift += period + " 0.0 90.0 1 7.0 0.0 7.0 0.0\n";
  }
  folder.write("barge.1", radiation);
  folder.write("barge.3", excitation);
  folder.write("barge.8", momentum);
  const WamitScales scales{2.0, {1000.0, 10.0}};
  EXPECT_DOUBLE_EQ(read_wamit("barge", scales).mean_drift.at(2)(0, 1), 10000 * 2 * 9.0);
  folder.write("barge.9", drift);
  const HydrodynamicDatabase database = read_wamit("barge", scales);
  ASSERT_EQ(database.mean_drift.size(), 3U);
  EXPECT_DOUBLE_EQ(database.mean_drift[0](0, 1), -10000 * 2 * 0.5);
  EXPECT_DOUBLE_EQ(database.mean_drift[1](5, 0), 10000 * 4 * 0.25);
  EXPECT_EQ(database.mean_drift[0](1, 0), 0.0);
  folder.write("barge.9", "4.0 45.0 45.0 1 9.0 0.0 9.0 0.0\n");
  EXPECT_THAT(message_of_import([&] { read_wamit("barge", scales); }),
              HasSubstr("heading 45 degrees are not among those"));
  folder.write("barge.9", "4.0 0.0 0.0 1 9.0 0.0 9.0 0.0\n");
  EXPECT_THAT(message_of_import([&] { read_wamit("barge", scales); }),
              HasSubstr("mean drift for 1 of 6 periods and headings"));
}

/// What the files of a database written by write_wamit do not tell.
WamitScales scales_of(const HydrodynamicDatabase& database) {
  WamitScales scales{1.0, database.water, {}};
  for (const dynamics::Vector3& point : wamit_points(database)) scales.bodies.push_back({point});
  return scales;
}

TEST(Wamit, MeanDriftComesBack) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase sample = with_drift(make_sample_database());
  const HydrodynamicDatabase database = about_points(sample, wamit_points(sample));
  write_wamit("pair", sample);
  expect_near(database.mean_drift, read_wamit("pair", scales_of(sample)).mean_drift, 2e-15);
}

TEST(Wamit, RoundTripKeepsTheDigits) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase sample = make_sample_database();
  write_wamit("pair", sample);
  const HydrodynamicDatabase database = about_points(sample, wamit_points(sample));
  const HydrodynamicDatabase found = read_wamit("pair", scales_of(sample));
  // 17 digits are exact; the frequency goes by way of the period, twice.
  constexpr double few_roundings = 2e-15;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.frequencies[k], database.frequencies[k], few_roundings);
  }
  expect_near({database.infinite_added_mass},
              std::vector<Eigen::MatrixXd>{found.infinite_added_mass}, few_roundings);
  expect_near({database.hydrostatic_stiffness},
              std::vector<Eigen::MatrixXd>{found.hydrostatic_stiffness}, few_roundings);
  expect_near(database.added_mass, found.added_mass, few_roundings);
  expect_near(database.damping, found.damping, few_roundings);
  std::vector<Eigen::MatrixXcd> sum;
  for (std::size_t k = 0; k < 3; ++k) sum.push_back(database.excitation(k));
  expect_near(sum, found.diffraction, few_roundings);
}

TEST(Wamit, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& radiation, const std::string& excitation = {}) {
    folder.write("x.1", radiation);
    std::filesystem::remove("x.3");
    if (!excitation.empty()) folder.write("x.3", excitation);
    return message_of_import([] { read_wamit("x", {}); });
  };
  EXPECT_THAT(message("8 3 3 1 1\n4 3 6000 1 1\n2 3 3 1 1\n"),
              HasSubstr("x.1: 3 lines are too few for the 3 periods and 1000 bodies"));
  const std::string sound = "8 3 3 1 1\n4 3 3 1 1\n2 3 3 1 1\n";
  EXPECT_THAT(message("8 3 3 1 1\n4 3 3 NaN 1\n"), HasSubstr("x.1:2: \"NaN\" is not finite"));
  EXPECT_THAT(message("8 3 3 1 1\n4 3 3 1\n"), HasSubstr("x.1:2: 4 numbers where"));
  EXPECT_THAT(message("8 3 3 1 1\n4 3 3 1 1 1\n"), HasSubstr("x.1:2: 6 numbers where"));
  EXPECT_THAT(message(sound, "8 0 3 1 0 1 0 2\n"), HasSubstr("x.3:1: 8 numbers where"));
  EXPECT_THAT(message("8 3 3 1 1\n8 1 1 1 1\n4 3 3 1 1\n2 3 3 1 1\n2 1 1 1 1\n"),
              HasSubstr("1 coefficients at the period 4 s, more at others: lines are missing"));
  EXPECT_THAT(message("8 3 3 1 1\n4 3 3 1 1\n"), HasSubstr("at least three are needed"));
  EXPECT_THAT(
      message(sound, "8 0 3 1 0 1 0\n4 0 3 1 0 1 0\n"),
      HasSubstr("x.3: excitation for 2 of 3 periods and headings: frequencies are missing, such "
                "as the period 2 s and the heading 0 degrees"));
  const std::string two_modes =
      "8 3 3 1 1\n8 5 5 1 1\n4 3 3 1 1\n4 5 5 1 1\n2 3 3 1 1\n2 5 5 1 1\n";
  EXPECT_THAT(
      message(two_modes, "8 0 3 1 0 1 0\n4 0 3 1 0 1 0\n2 0 3 1 0 1 0\n"),
      HasSubstr("x.3: no excitation of mode 5 at the period 8 s and the heading 0 degrees"));
  EXPECT_THAT(
      message(two_modes,
              "8 0 3 1 0 1 0\n8 0 5 1 0 1 0\n4 0 3 1 0 1 0\n2 0 3 1 0 1 0\n2 0 5 1 0 1 0\n"),
      HasSubstr("x.3: no excitation of mode 5 at the period 4 s and the heading 0 degrees"));
  EXPECT_THAT(message(sound, "8 0 3 1 0 1 0\n8 0 1 1 0 1 0\n"),
              HasSubstr("x.3:2: a mode that the .1 file does not have"));
  EXPECT_THAT(message("8 3 3 1 1\n8 3 5 1 1\n8 5 1 1 1\n4 3 3 1 1\n4 3 5 1 1\n4 5 1 1 1\n2 3 3 1 "
                      "1\n2 3 5 1 1\n2 5 1 1 1\n"),
              HasSubstr("x.1: lines for the modes 3 and 5, and none for 5 and 3: lines are"));
  EXPECT_THAT(message(two_modes + "0 3 3 1\n"),
              HasSubstr("x.1: 1 coefficients at the period 0 (infinite frequency), more at others: "
                        "lines are missing, such as that of the modes 5 and 5"));
  EXPECT_THAT(message(sound, "5 0 3 1 0 1 0\n"),
              HasSubstr("the period 5 s is not among those of the .1 file"));
  EXPECT_THAT(message_of_import([] { import_hydrodynamics("x.txt", {}); }),
              HasSubstr("is none of .h5 (BEMIO), .1, .2, .3, .hst (WAMIT), .nc (Capytaine)"));
}

// K(t) = (1 - a t) exp(-a t): B(w) = 2 a w^2/(a^2 + w^2)^2, which vanishes at the frequency 0 as
// that of a floating body does, and A(w) = A_inf - (w^2 - a^2)/(a^2 + w^2)^2. What lies beyond the
// highest frequency W is lost: 2/pi int 2 a/w^2 dw = 4 a/(pi W) = 0.064 of K(0), and less behind,
// where it is an oscillation that dies like 1/t; of A_inf no more than 4 a/(3 pi W^3) = 5e-5. Of
// the step w of the frequencies the rule's error is of the order w^2 = 0.0025.
TEST(Retardation, FollowsFromTheDamping) {
  HydrodynamicDatabase database;
  database.body_names = {"body"};
  const double a = 1.0, infinite = 5.0;
  for (int k = 1; k <= 400; ++k) {
    const double w = 0.05 * k, square = std::pow(a * a + w * w, 2);
    database.frequencies.push_back(w);
    database.damping.emplace_back(Eigen::MatrixXd::Constant(6, 6, 2 * a * w * w / square));
    database.added_mass.emplace_back(
        Eigen::MatrixXd::Constant(6, 6, infinite - (w * w - a * a) / square));
  }
  add_retardation(database);
  for (std::size_t n = 0; n < database.retardation.size(); n += 50) {
    const double t = database.time_step * static_cast<double>(n);
    EXPECT_NEAR(database.retardation[n](0, 0), (1 - a * t) * std::exp(-a * t), 0.0665) << t;
  }
  add_infinite_added_mass(database);
  EXPECT_NEAR(database.infinite_added_mass(3, 4), infinite, 0.0025);
}

}  // namespace
}  // namespace blocklift::pipeline

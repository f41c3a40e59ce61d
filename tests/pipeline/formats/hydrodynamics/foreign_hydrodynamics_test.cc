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
  // Momentum far away is that of both bodies together.
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
  EXPECT_THAT(message("8 3 3 1 1\n8 1 1 1 1\n4 3 3 1 1\n2 3 3 1 1\n2 1 1 1 1\n"),
              HasSubstr("1 coefficients at the period 4 s, more at others: lines are missing"));
  EXPECT_THAT(message("8 3 3 1 1\n4 3 3 1 1\n"), HasSubstr("at least three are needed"));
  EXPECT_THAT(
      message(sound, "8 0 3 1 0 1 0\n4 0 3 1 0 1 0\n"),
      HasSubstr("x.3: excitation for 2 of 3 periods and headings: frequencies are missing"));
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

/// Names the dimensions of a variable as NetCDF-4 does: references to the coordinates' variables.
void name_dimensions(const std::string& file, const std::string& variable,
                     const std::vector<std::string>& dimensions) {
  using hdf5::Handle;
  const Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const Handle set(H5Dopen2(handle.get(), variable.c_str(), H5P_DEFAULT), H5Dclose);
  std::vector<hobj_ref_t> references(dimensions.size());
  std::vector<hvl_t> lists;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    H5Rcreate(&references[d], handle.get(), dimensions[d].c_str(), H5R_OBJECT, -1);
    lists.push_back({1, &references[d]});
  }
  if (H5Aexists(set.get(), "DIMENSION_LIST") > 0) H5Adelete(set.get(), "DIMENSION_LIST");
  const Handle type(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose);
  const hsize_t count = dimensions.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute(
      H5Acreate2(set.get(), "DIMENSION_LIST", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  H5Awrite(attribute.get(), type.get(), lists.data());
}

/// A file of NetCDF's first classic format, put together byte by byte.
class ClassicWriter {
 public:
  std::size_t dimension(const std::string& name, std::size_t length) {
    dimensions_ += text(name) + word(length);
    return dimension_count_++;
  }
  void numbers(const std::string& name, const std::vector<std::size_t>& dimensions,
               const std::vector<double>& values) {
    std::string data;
    for (const double value : values) data += word(bits(value) >> 32) + word(bits(value));
    variables_.push_back({name, dimensions, 6, data});
  }
  void floats(const std::string& name, const std::vector<std::size_t>& dimensions,
              const std::vector<float>& values) {
    std::string data;
    for (const float value : values) data += word(std::bit_cast<std::uint32_t>(value));
    variables_.push_back({name, dimensions, 5, data});
  }
  void characters(const std::string& name, const std::vector<std::size_t>& dimensions,
                  const std::string& data) {
    variables_.push_back({name, dimensions, 2, data});
  }
  std::string bytes() const {
    const std::size_t length = layout(0).size();
    std::string file = layout(length);
    for (const Entry& entry : variables_) file += padded(entry.data);
    return file;
  }

 private:
  struct Entry {
    std::string name;
    std::vector<std::size_t> dimensions;
    std::size_t type;
    std::string data;
  };
  static std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
  static std::string word(std::uint64_t value) {
    std::string result;
    for (int shift = 24; shift >= 0; shift -= 8) {
      result += static_cast<char>(static_cast<unsigned char>(value >> shift & 255U));
    }
    return result;
  }
  static std::string padded(std::string data) {
    data.resize((data.size() + 3) / 4 * 4, '\0');
    return data;
  }
  static std::string text(const std::string& name) { return word(name.size()) + padded(name); }
  std::string layout(std::size_t begin) const {
    std::string file = "CDF\x01" + word(0);
    file += word(10) + word(dimension_count_) + dimensions_;
    file += word(12) + word(1) + text("made") + word(2) + text("by hand");
    file += word(11) + word(variables_.size());
    for (const Entry& entry : variables_) {
      file += text(entry.name) + word(entry.dimensions.size());
      for (const std::size_t dimension : entry.dimensions) file += word(dimension);
      file += word(0) + word(0) + word(entry.type) + word(padded(entry.data).size()) + word(begin);
      begin += padded(entry.data).size();
    }
    return file;
  }

  std::string dimensions_;
  std::size_t dimension_count_ = 0;
  std::vector<Entry> variables_;
};

/// A body that heaves alone at 3, 2 and 1 rad/s, without what is optional: added mass 10 + w,
/// damping w, excitation (2 + 1i) w with its imaginary part first; frequencies as floats.
std::string classic_sample() {
  ClassicWriter file;
  const std::size_t omega = file.dimension("omega", 3),
                    radiating = file.dimension("radiating_dof", 1),
                    influenced = file.dimension("influenced_dof", 2),
                    direction = file.dimension("wave_direction", 2),
                    parts = file.dimension("reim", 2), five = file.dimension("string5", 5),
                    two = file.dimension("string2", 2);
  file.numbers("rho", {}, {1000.0});
  file.numbers("g", {}, {9.81});
  file.numbers("water_depth", {}, {std::numeric_limits<double>::infinity()});
  file.floats("omega", {omega}, {3.0F, 2.0F, 1.0F});
  file.characters("radiating_dof", {radiating, five}, "Heave");
  file.characters("influenced_dof", {influenced, five}, std::string("HeaveSway\0", 10));
  file.characters("reim", {parts, two}, "imre");
  file.numbers("wave_direction", {direction}, {0.25, 0.5});
  file.numbers("added_mass", {radiating, omega, influenced}, {13, 1, 12, 1, 11, 1});
  file.numbers("radiation_damping", {radiating, omega, influenced}, {3, 0, 2, 0, 1, 0});
  std::vector<double> force;
  for (const double part : {1.0, 2.0}) {
    for (const double heading : {1.0, 10.0}) {
      for (const double w : {3.0, 2.0, 1.0}) {
        force.push_back(part * heading * w);
        force.push_back(0.0);
      }
    }
  }
  file.numbers("excitation_force", {parts, direction, omega, influenced}, force);
  return file.bytes();
}

/// A body that heaves and surges at the frequencies infinity, 3, 2 and 1 rad/s: added mass of heave
/// 10 + w, of surge by heave 1, damping of heave w, forces (1 + 2i) w in heave and 5 in surge.
void write_sample_of_capytaine(const std::string& path) {
  const std::vector<double> omega = {std::numeric_limits<double>::infinity(), 3.0, 2.0, 1.0};
  const std::vector<std::string> motions = {"Heave", "Surge"};
  std::vector<double> mass, damping, diffraction;
  for (const double w : omega) {
    const bool infinite = std::isinf(w);
    for (const double value : {infinite ? 9.0 : 10.0 + w, 1.0, 0.0, 4.0}) mass.push_back(value);
    for (const double value : {infinite ? 0.0 : w, 0.0, 0.0, 0.5}) damping.push_back(value);
  }
  for (const double factor : {1.0, 2.0}) {
    for (const double w : omega) {
      diffraction.push_back(factor * (std::isinf(w) ? 0.0 : w));
      diffraction.push_back(factor == 1.0 ? 5.0 : 0.0);
    }
  }
  {
    ResultsWriter file(path);
    const Meaning none{"1", "made by hand"};
    file.write_number("rho", 1000.0, none);
    file.write_number("g", 9.81, none);
    file.write_number("water_depth", std::numeric_limits<double>::infinity(), none);
    file.write("omega", std::span<const double>(omega), none);
    const std::vector<double> heading = {0.5}, parts = {0.0, 1.0};
    file.write("wave_direction", std::span<const double>(heading), none);
    file.write("complex", std::span<const double>(parts), none);
    file.write_texts("radiating_dof", motions, "");
    file.write_texts("influenced_dof", motions, "");
    const std::size_t square[] = {4, 2, 2}, force[] = {2, 4, 1, 2};
    file.write_array("added_mass", mass, square, none);
    file.write_array("radiation_damping", damping, square, none);
    file.write_array("diffraction_force", diffraction, force, none);
    file.write_array("Froude_Krylov_force", diffraction, force, none);
    file.finish();
  }
  for (const char* const name : {"added_mass", "radiation_damping"}) {
    name_dimensions(path, name, {"omega", "radiating_dof", "influenced_dof"});
  }
  for (const char* const name : {"diffraction_force", "Froude_Krylov_force"}) {
    name_dimensions(path, name, {"complex", "omega", "wave_direction", "influenced_dof"});
  }
}

// Conventions by hand: degrees of freedom by name, frequencies brought into order, the force
// conjugated from e^{-i w t} to e^{+i w t}, row: what is influenced, column: what moves.
TEST(Capytaine, IsReadByTheNamesOfItsDimensions) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  const HydrodynamicDatabase database =
      import_hydrodynamics("body.nc", {}).series.databases.front();
  EXPECT_EQ(database.frequencies, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(database.added_mass[1](2, 2), 12.0);
  EXPECT_EQ(database.added_mass[1](0, 2), 1.0);
  EXPECT_EQ(database.added_mass[1](2, 0), 0.0);
  EXPECT_EQ(database.added_mass[1](0, 0), 4.0);
  EXPECT_EQ(database.infinite_added_mass(2, 2), 9.0);
  EXPECT_EQ(database.damping[2](2, 2), 3.0);
  EXPECT_EQ(database.diffraction[2](2, 0), Complex(3.0, -6.0));
  EXPECT_EQ(database.excitation(0)(0, 0), Complex(10.0, 0.0));
  EXPECT_EQ(database.headings, std::vector<double>{0.5});
}

TEST(Capytaine, IsReadInTheClassicFormat) {
  const test::TemporaryFolder folder;
  folder.write("classic.nc", classic_sample());
  const HydrodynamicDatabase database =
      import_hydrodynamics("classic.nc", {}).series.databases.front();
  EXPECT_EQ(database.water.density, 1000.0);
  EXPECT_EQ(database.frequencies, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(database.headings, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(database.added_mass[1](2, 2), 12.0);
  EXPECT_EQ(database.added_mass[1](1, 2), 1.0);
  EXPECT_EQ(database.damping[2](2, 2), 3.0);
  EXPECT_EQ(database.excitation(0)(2, 0), Complex(2.0, -1.0));
  EXPECT_EQ(database.excitation(2)(2, 1), Complex(60.0, -30.0));
}

// Every cut of the file, and counts and places that it cannot have, are refused or read.
TEST(Capytaine, RefusesDamagedClassicFiles) {
  const test::TemporaryFolder folder;
  const std::string sound = classic_sample();
  for (std::size_t length = 3; length < sound.size(); length += 5) {
    folder.write("cut.nc", sound.substr(0, length));
    EXPECT_THAT(message_of_import([] { read_capytaine("cut.nc"); }), HasSubstr("cut.nc: "));
  }
  for (std::size_t place = 3; place < 700; ++place) {
    std::string damaged = sound;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x5A);
    folder.write("damaged.nc", damaged);
    message_of_import([] { read_capytaine("damaged.nc"); });
  }
}

// As another NetCDF library writes names into HDF5: one character a place.
TEST(Capytaine, ReadsNamesOfCharacters) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  {
    using hdf5::Handle;
    const Handle file(H5Fopen("body.nc", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    const hsize_t extents[] = {2, 6};
    const Handle space(H5Screate_simple(2, extents, nullptr), H5Sclose);
    for (const char* const name : {"radiating_dof", "influenced_dof"}) {
      H5Ldelete(file.get(), name, H5P_DEFAULT);
      const Handle set(H5Dcreate2(file.get(), name, type.get(), space.get(), H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose);
      H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, "Heave\0Surge ");
    }
  }
  for (const char* const name : {"added_mass", "radiation_damping"}) {
    name_dimensions("body.nc", name, {"omega", "radiating_dof", "influenced_dof"});
  }
  for (const char* const name : {"diffraction_force", "Froude_Krylov_force"}) {
    name_dimensions("body.nc", name, {"complex", "omega", "wave_direction", "influenced_dof"});
  }
  const HydrodynamicDatabase database = read_capytaine("body.nc");
  EXPECT_EQ(database.added_mass[1](2, 2), 12.0);
  EXPECT_EQ(database.added_mass[1](0, 2), 1.0);
}

TEST(Capytaine, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  write_sample_of_capytaine("body.nc");
  hdf5::Handle file(H5Fopen("body.nc", H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  H5Ldelete(file.get(), "radiation_damping", H5P_DEFAULT);
  file.reset();
  EXPECT_THAT(message_of_import([] { read_capytaine("body.nc"); }),
              HasSubstr("\"/radiation_damping\": is not in the file"));
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

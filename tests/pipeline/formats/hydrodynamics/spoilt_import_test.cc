// Databases of other programs that are incomplete, or of no body.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/marine/radiation/retardation_from_damping.h"
#include "pipeline/formats/hdf5_handle.h"
#include "pipeline/formats/hydrodynamics/foreign_hydrodynamics.h"
#include "pipeline/formats/hydrodynamics/radiation_check.h"
#include "tests/pipeline/formats/hydrodynamics/sample_database.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using ::testing::AllOf;
using ::testing::HasSubstr;

template <class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const HydrodynamicFileError& error) {
    return error.what();
  }
  return {};
}

/// About points in the water line, so that WAMIT's files hold its very numbers.
HydrodynamicDatabase pair_in_water_line() {
  HydrodynamicDatabase database = make_sample_database();
  for (dynamics::Vector3& point : database.reference_points) point.z() = 0.0;
  return database;
}

WamitScales scales_of_pair(const HydrodynamicDatabase& database) {
  WamitScales scales{1.0, database.water};
  for (const dynamics::Vector3& point : wamit_points(database)) scales.bodies.push_back({point});
  return scales;
}

// Between bodies a file may leave out the stiffness, of a body on itself not.
TEST(Wamit, RefusesCutStiffness) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase database = pair_in_water_line();
  write_wamit("pair", database);
  const auto message_with = [&](const std::string& text) {
    folder.write("pair.hst", text);
    return refusal_of([&] { read_wamit("pair", scales_of_pair(database)); });
  };
  std::string own;  // that of each body on itself
  std::ifstream lines("pair.hst");
  for (std::string line; std::getline(lines, line);) {
    int i = 0, j = 0;
    std::istringstream(line) >> i >> j;
    if ((i <= 6) == (j <= 6)) own += line + "\n";
  }
  EXPECT_EQ(message_with(own), "");
  EXPECT_THAT(message_with(own.substr(0, own.find('\n') + 1)),
              HasSubstr("pair.hst: no stiffness of the modes 1 and 2: all 36 of a body are due"));
  own.erase(own.rfind('\n', own.size() - 2) + 1);
  EXPECT_THAT(message_with(own), HasSubstr("pair.hst: no stiffness of the modes 12 and 12"));
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Two runs in one file: the second one's figures would stand in place of the first one's.
TEST(Wamit, RefusesLinesThatContradictOthers) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase database = pair_in_water_line();
  const auto message_with = [&](const std::string& file, const std::string& line) {
    write_wamit("pair", database);
    folder.write(file, text_of(file) + line + "\n");
    return refusal_of([&] { read_wamit("pair", scales_of_pair(database)); });
  };
  write_wamit("pair", database);
  const std::string lines = text_of("pair.1");
  const std::string last = lines.substr(lines.rfind('\n', lines.size() - 2) + 1);
  const std::string again = "comes a second time, with other figures";
  EXPECT_EQ(message_with("pair.1", last), "");
  EXPECT_THAT(message_with("pair.1", "0 1 1 7e9"), AllOf(HasSubstr("pair.1:"), HasSubstr(again)));
  EXPECT_THAT(message_with("pair.1", last.substr(0, 36) + " 7e9 7e9"), HasSubstr(again));
  EXPECT_THAT(message_with("pair.hst", "3 3 7e9"), HasSubstr(again));
}

// What should be nothing is the rounding of what is not, another one in each run.
TEST(Wamit, TakesTheRoundingOfASecondRun) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = pair_in_water_line();
  database.damping[1](0, 1) = database.damping[1](1, 0) = 1e-9 * database.damping[1](0, 0);
  write_wamit("pair", database);
  const std::string masses = text_of("pair.1");
  const std::string period =
      fmt::format("{:.17g} ", 2 * std::numbers::pi / database.frequencies[1]);
  const auto message_with = [&](double damping) {
    folder.write("pair.1", masses + period +
                               fmt::format("1 2 {:.17g} {:.17g}\n",
                                           database.added_mass[1](0, 1) / database.water.density,
                                           damping / database.water.density));
    return refusal_of([&] { read_wamit("pair", scales_of_pair(database)); });
  };
  const double rate = database.damping[1](0, 0) / database.frequencies[1];
  EXPECT_EQ(message_with(-2e-9 * rate), "");
  EXPECT_THAT(message_with(1e-3 * rate), HasSubstr("comes a second time, with other figures"));
}

// By Haskind's relation, where there is none of the diffraction potential; without either there are
// no waves.
TEST(Wamit, TakesExcitationFromEitherFile) {
  const test::TemporaryFolder folder;
  const HydrodynamicDatabase database = pair_in_water_line();
  write_wamit("pair", database);
  const HydrodynamicDatabase found = read_wamit("pair", scales_of_pair(database));
  std::filesystem::rename("pair.3", "pair.2");
  const HydrodynamicDatabase same = read_wamit("pair", scales_of_pair(database));
  EXPECT_EQ(same.headings, found.headings);
  EXPECT_EQ(same.diffraction[1], found.diffraction[1]);
  std::filesystem::remove("pair.2");
  EXPECT_TRUE(read_wamit("pair", scales_of_pair(database)).headings.empty());
}

TEST(Wamit, TakesFortransNumbers) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = pair_in_water_line();
  database.damping[1](0, 1) = database.damping[1](1, 0) = 0.0;
  write_wamit("pair", database);
  const auto read = [&] { return read_wamit("pair", scales_of_pair(database)); };
  const HydrodynamicDatabase found = read();
  std::string text = text_of("pair.1");
  std::replace(text.begin(), text.end(), 'E', 'D');
  // As 1.0E-120 is written where the exponent has two places. The period of a line stays.
  const std::string none = " 0.0000000000000000D+00";
  int replaced = 0;
  for (std::size_t at = text.find(none, 1); at != std::string::npos; at = text.find(none, at + 1)) {
    if (text[at - 1] == '\n') continue;
    text.replace(at, none.size(), " 1.0000000000000000-120");
    ++replaced;
  }
  ASSERT_GT(replaced, 0);
  folder.write("pair.1", text);
  const HydrodynamicDatabase again = read();
  EXPECT_EQ(again.added_mass, found.added_mass);
  EXPECT_NEAR(again.damping[1](0, 1), 0.0, 1e-100);
  EXPECT_EQ(again.damping[1](2, 2), found.damping[1](2, 2));
}

/// Copies the whole excitation of a file's bodies to another's.
void copy_whole_excitation(const char* from, const char* to) {
  const hdf5::Handle source(H5Fopen(from, H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const hdf5::Handle target(H5Fopen(to, H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  for (const std::string body : {"/body1", "/body2"}) {
    for (const std::string part : {"re", "im"}) {
      const std::string name = body + "/hydro_coeffs/excitation/" + part;
      H5Ldelete(target.get(), name.c_str(), H5P_DEFAULT);
      H5Ocopy(source.get(), name.c_str(), target.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    }
  }
}

// Programs that do not divide the excitation leave its parts zero: no waves would act on the body.
TEST(Bemio, HoldsPartsOfTheExcitationAgainstTheWhole) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  write_bemio("whole.h5", database);
  const Eigen::MatrixXcd whole = read_bemio("whole.h5").excitation(1);
  for (Eigen::MatrixXcd& force : database.froude_krylov) force *= 1.1;
  write_bemio("other.h5", database);
  copy_whole_excitation("whole.h5", "other.h5");
  EXPECT_THAT(refusal_of([] { read_bemio("other.h5"); }),
              AllOf(HasSubstr("the parts of \"/body1/hydro_coeffs/excitation/\""),
                    HasSubstr("% of the largest off the whole, re and im")));
  for (auto* parts : {&database.froude_krylov, &database.diffraction})
    for (Eigen::MatrixXcd& force : *parts) force.setZero();
  write_bemio("zero.h5", database);
  copy_whole_excitation("whole.h5", "zero.h5");
  const HydrodynamicDatabase found = read_bemio("zero.h5");
  EXPECT_LT((found.diffraction[1] - whole).norm(), 1e-12 * whole.norm());
  EXPECT_TRUE(found.froude_krylov[1].isZero(0.0));
}

// Gaps make added mass negative at some frequencies, waves damping nowhere.
TEST(Import, RefusesWhatNoBodyHas) {
  const test::TemporaryFolder folder;
  const auto message_of = [](const HydrodynamicDatabase& database) {
    write_wamit("pair", database);
    return refusal_of([&] { import_hydrodynamics("pair.1", scales_of_pair(database)); });
  };
  HydrodynamicDatabase database = pair_in_water_line();
  database.added_mass[1](2, 2) = -1e6;
  database.damping[0](8, 8) = -1e-6 * database.damping[1](8, 8);
  EXPECT_EQ(message_of(database), "");
  database.damping[1](8, 8) = -0.1 * std::max(database.damping[0](8, 8), database.damping[2](8, 8));
  EXPECT_THAT(message_of(database),
              AllOf(HasSubstr("pair.1: the damping of body2 heave on itself is -"),
                    HasSubstr(" at 0.7 rad/s")));
  database = pair_in_water_line();
  database.infinite_added_mass(1, 1) = -1e6;
  EXPECT_THAT(message_of(database),
              HasSubstr("the added mass of body1 sway at infinite frequency is -1e+06 kg"));
  database = pair_in_water_line();
  database.infinite_added_mass(3, 3) = -1e6;
  EXPECT_EQ(message_of(database), "");
}

// B = 2 w^2/(w^2 + 1)^2 fades; cut at its peak it has not (Retardation.FollowsFromTheDamping).
TEST(Import, DoubtsDampingThatHasNotFaded) {
  const auto up_to = [](int count) {
    HydrodynamicDatabase database;
    database.body_names = {"body"};
    for (int k = 1; k <= count; ++k) {
      const double w = 0.05 * k, square = std::pow(1 + w * w, 2);
      database.frequencies.push_back(w);
      database.damping.emplace_back(Eigen::MatrixXd::Constant(6, 6, 2 * w * w / square));
      database.added_mass.emplace_back(Eigen::MatrixXd::Constant(6, 6, 5 - (w * w - 1) / square));
    }
    add_retardation(database);
    add_infinite_added_mass(database);
    return doubt_about_memory(database);
  };
  EXPECT_EQ(up_to(400), "");
  EXPECT_THAT(up_to(20), AllOf(HasSubstr("the retardation functions miss added mass and damping"),
                               HasSubstr("at the last frequency, 1 rad/s")));
}

}  // namespace
}  // namespace blocklift::pipeline

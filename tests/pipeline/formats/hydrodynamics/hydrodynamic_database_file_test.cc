#include "pipeline/formats/hydrodynamics/hydrodynamic_database_file.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/formats/hdf5_handle.h"
#include "tests/pipeline/formats/hydrodynamics/same_database.h"
#include "tests/pipeline/formats/hydrodynamics/sample_database.h"
#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

/// Replaces one number of a dataset in a file.
void spoil(const std::string& file, const std::string& dataset, std::size_t index, double value) {
  const hdf5::Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const hdf5::Handle set(H5Dopen2(handle.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const hdf5::Handle space(H5Dget_space(set.get()), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values.at(index) = value;
  H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

/// Removes a dataset or group.
void remove(const std::string& file, const std::string& object) {
  const hdf5::Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  H5Ldelete(handle.get(), object.c_str(), H5P_DEFAULT);
}

// An older program imported it; what is computed here is not refused for it.
TEST(HydrodynamicDatabaseFile, RefusesImportsThatWavesBringEnergy) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  write_hydrodynamic_database("db.h5", database, "", "imported from pair.1 (WAMIT)");
  EXPECT_NO_THROW(read_hydrodynamic_database("db.h5"));
  database.damping[1](8, 8) = -std::abs(database.damping[0](8, 8));
  write_hydrodynamic_database("db.h5", database, "", "imported from pair.1 (WAMIT)");
  EXPECT_THAT(message_of([] { read_hydrodynamic_database("db.h5"); }),
              AllOf(HasSubstr("db.h5: the damping of"), HasSubstr("heave on itself is -"),
                    HasSubstr("below zero")));
  write_hydrodynamic_database("db.h5", database, "0123", "computed by blocklift");
  EXPECT_NO_THROW(read_hydrodynamic_database("db.h5"));
}

TEST(HydrodynamicDatabaseFile, ReadsExactlyWhatWasWritten) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  database.change_from_coarser = Eigen::VectorXd::LinSpaced(database.mode_count(), 0.01, 0.3);
  database.excitation_change_from_coarser = 2.0 * database.change_from_coarser;
  database.cut_off_by_end = 0.1 * database.change_from_coarser;
  write_hydrodynamic_database("db.h5", database, "0123", "made up");
  test::expect_same(read_hydrodynamic_database("db.h5"), database);
  EXPECT_EQ(read_identity("db.h5"), "0123");
  EXPECT_EQ(read_hydrodynamic_file("db.h5").origin, "made up");
}

// Not told, none lost and lost ones are three answers; one that names a body which is not there is
// none.
TEST(HydrodynamicDatabaseFile, TellsWhichWavesAreLost) {
  const test::TemporaryFolder folder;
  HydrodynamicFile file{"0123", "made up", {0, {0.0}, {make_sample_database()}}};
  const auto kept = [&] {
    write_hydrodynamic_file("db.h5", file);
    return read_hydrodynamic_file("db.h5").waves_lost;
  };
  EXPECT_FALSE(kept());
  file.waves_lost.emplace();
  ASSERT_TRUE(kept());
  EXPECT_FALSE(*kept());
  file.waves_lost.emplace(dynamics::CouplingReach{0, 1, 4.25, 77.5});
  const std::optional<WavesLost> lost = kept();
  ASSERT_TRUE(lost && *lost);
  EXPECT_EQ((*lost)->second, 1);
  EXPECT_EQ((*lost)->gap, 4.25);
  EXPECT_EQ((*lost)->shortest, 77.5);
  file.waves_lost.emplace(dynamics::CouplingReach{0, 2, 4.25, 77.5});
  EXPECT_FALSE(kept());
}

TEST(HydrodynamicDatabaseFile, KeepsDriftAndFarField) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  const std::size_t frequencies = database.frequencies.size();
  const auto headings = static_cast<Eigen::Index>(database.headings.size());
  for (std::size_t k = 0; k < frequencies; ++k) {
    database.mean_drift.emplace_back(Eigen::MatrixXd::Random(12, headings));
    database.far_field.radiated.emplace_back(Eigen::MatrixXcd::Random(5, 12));
    database.far_field.scattered.emplace_back(Eigen::MatrixXcd::Random(5, headings));
  }
  database.far_field.directions = {0.0, 1.2, 2.4, 3.6, 4.8};
  write_hydrodynamic_database("db.h5", database);
  const HydrodynamicDatabase found = read_hydrodynamic_database("db.h5");
  EXPECT_EQ(found.mean_drift, database.mean_drift);
  EXPECT_EQ(found.far_field.directions, database.far_field.directions);
  EXPECT_EQ(found.far_field.radiated, database.far_field.radiated);
  EXPECT_EQ(found.far_field.scattered, database.far_field.scattered);
  database.far_field.directions.pop_back();
  EXPECT_THAT(message_of([&] { write_hydrodynamic_database("db.h5", database); }),
              HasSubstr("the far field does not fit"));
  remove("db.h5", "/states/0/far_field/radiated");
  EXPECT_THAT(message_of([] { read_hydrodynamic_database("db.h5"); }), HasSubstr("radiated"));
}

TEST(HydrodynamicDatabaseFile, KeepsWhatIsUnknownUnknown) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  database.water.depth = std::numeric_limits<double>::infinity();
  database.centres_of_buoyancy.clear();
  database.centres_of_mass.clear();
  database.hydrostatic_stiffness.resize(0, 0);
  database.headings.clear();
  for (auto* force : {&database.froude_krylov, &database.diffraction}) {
    for (Eigen::MatrixXcd& matrix : *force) matrix.resize(12, 0);
  }
  write_hydrodynamic_database("db.h5", database);
  test::expect_same(read_hydrodynamic_database("db.h5"), database);
}

TEST(HydrodynamicDatabaseFile, HoldsSeveralDraughts) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase deep = make_sample_database();
  deep.infinite_added_mass *= 2.0;
  HydrodynamicFile file{"abc", "made up",
                        dynamics::make_series(1, {2.0, 3.0}, {make_sample_database(), deep})};
  write_hydrodynamic_file("db.h5", file);
  const HydrodynamicFile found = read_hydrodynamic_file("db.h5");
  EXPECT_EQ(found.series.draughts, file.series.draughts);
  EXPECT_EQ(found.series.lowered_body, 1);
  test::expect_same(found.series.databases[1], deep);
  EXPECT_THAT(message_of([] { read_hydrodynamic_database("db.h5"); }),
              HasSubstr("holds 2 draughts where a single database is due"));
}

TEST(HydrodynamicDatabaseFile, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto message_after = [](const auto& change) {
    write_hydrodynamic_database("db.h5", make_sample_database());
    change();
    return message_of([] { read_hydrodynamic_database("db.h5"); });
  };
  EXPECT_THAT(message_after([] { spoil("db.h5", "/states/0/added_mass", 144 + 12 * 2 + 8, nan); }),
              AllOf(HasSubstr("db.h5"), HasSubstr("the added mass at 0.7 rad/s is not a number for "
                                                  "left heave by right heave")));
  EXPECT_THAT(message_after([] { spoil("db.h5", "/frequencies", 1, 0.2); }),
              HasSubstr("frequency 2 is 0.2 rad/s: frequencies must be positive and ascend"));
  EXPECT_THAT(message_after([] { remove("db.h5", "/frequencies"); }),
              HasSubstr("\"/frequencies\": is not in the file"));
  EXPECT_THAT(message_after([] { remove("db.h5", "/states/0"); }),
              HasSubstr("a series of databases needs at least one"));
  EXPECT_THAT(message_of([] { read_hydrodynamic_database("none.h5"); }),
              HasSubstr("there is no such file"));
  EXPECT_FALSE(read_identity("none.h5"));
}

// HDF5 runs in circles where an object of a heap is longer than the heap.
TEST(HydrodynamicDatabaseFile, RefusesDamageThatHdf5FindsNoEndOf) {
  const test::TemporaryFolder folder;
  write_hydrodynamic_database("db.h5", make_sample_database(), "identity", "sample");
  const std::string sound = test::text_of_file("db.h5");
  const std::size_t heap = sound.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  // Objects of the heap: a head of 16 bytes, the last eight of which are the size, and the content,
  // which ends at a multiple of eight.
  std::size_t object = heap + 16;
  for (int i = 1; i < 17; ++i) {
    const auto size = static_cast<std::size_t>(static_cast<unsigned char>(sound[object + 8]));
    object += 16 + (size + 7) / 8 * 8;
  }
  std::string damaged = sound;
  damaged[object + 9] = 10;  // 2560 more than it is
  folder.write("db.h5", damaged);
  EXPECT_EQ(read_identity("db.h5"), std::nullopt);
  EXPECT_THROW(read_hydrodynamic_file("db.h5"), HydrodynamicFileError);
}

TEST(HydrodynamicDatabaseFile, WritesNoUnsoundDatabase) {
  const test::TemporaryFolder folder;
  HydrodynamicDatabase database = make_sample_database();
  database.damping.pop_back();
  database.diffraction[1](7, 1) = nan;
  EXPECT_THAT(message_of([&] { write_hydrodynamic_database("db.h5", database); }),
              AllOf(HasSubstr("the damping is given for 2 of 3 frequencies"),
                    HasSubstr("the diffraction force at 0.7 rad/s is not a number for right sway "
                              "at heading 2")));
  EXPECT_FALSE(std::filesystem::exists("db.h5"));
}

TEST(HydrodynamicSeries, IsLinearBetweenItsDraughts) {
  HydrodynamicDatabase deep = make_sample_database(), shallow = deep;
  deep.infinite_added_mass *= 2.0;
  deep.damping[1] *= 3.0;
  const auto series = dynamics::make_series(1, {2.0, 3.0}, {shallow, deep});
  const HydrodynamicDatabase between = series.at(2.25), dry = series.at(-1.0), half = series.at(1);
  EXPECT_TRUE(between.infinite_added_mass.isApprox(1.25 * shallow.infinite_added_mass, 1e-14));
  EXPECT_TRUE(between.damping[1].isApprox(1.5 * shallow.damping[1], 1e-14));
  test::expect_same(series.at(2.0 + 1e-300), shallow);
  test::expect_same(series.at(7.0), deep);
  EXPECT_EQ(dry.infinite_added_mass.bottomRows(6).norm(), 0.0);
  EXPECT_EQ(dry.infinite_added_mass.rightCols(6).norm(), 0.0);
  EXPECT_EQ(dry.infinite_added_mass.topLeftCorner(6, 6),
            shallow.infinite_added_mass.topLeftCorner(6, 6));
  EXPECT_EQ(half.infinite_added_mass(3, 9), 0.5 * shallow.infinite_added_mass(3, 9));
  EXPECT_EQ(half.infinite_added_mass(9, 9), 0.5 * shallow.infinite_added_mass(9, 9));
}

// Samples of exp(-t) cos(3 t), whose fourth derivative is at most 10^2, at steps of h = 0.2: a
// cubic polynomial is off by no more than h^4/24 times that, in the first and last cells.
TEST(HydrodynamicSeries, BringsRetardationFunctionsToOneStep) {
  HydrodynamicDatabase fine = make_sample_database(), coarse = fine;
  coarse.time_step = 0.2;
  coarse.retardation.resize(20);
  for (int n = 0; n < 20; ++n) {
    coarse.retardation[n] = fine.retardation[2 * n];
  }
  const auto series = dynamics::make_series(0, {1.0, 2.0}, {fine, coarse});
  ASSERT_EQ(series.databases[1].retardation.size(), 40U);
  const double peak = fine.retardation[0].maxCoeff();
  const double bound = 100.0 * std::pow(0.2, 4) / 24.0 * peak;
  for (std::size_t n = 0; n < 39; ++n) {
    EXPECT_LT((series.databases[1].retardation[n] - fine.retardation[n]).cwiseAbs().maxCoeff(),
              bound)
        << n;
  }
}

TEST(HydrodynamicSeries, RefusesWhatDoesNotBelongTogether) {
  HydrodynamicDatabase other = make_sample_database();
  other.headings[1] = 1.0;
  EXPECT_THAT(message_of([&] {
                dynamics::make_series(0, {1.0, 2.0}, {make_sample_database(), other});
              }),
              HasSubstr("database 2 of the series differs in its headings from the first"));
  EXPECT_THAT(
      message_of([&] {
        dynamics::make_series(0, {2.0, 2.0}, {make_sample_database(), make_sample_database()});
      }),
      HasSubstr("draught 2 of the series is 2.000000 m"));
}

TEST(ContentHash, TellsContentsApart) {
  const auto digits = [](const auto&... parts) {
    ContentHash hash;
    (hash.add(parts), ...);
    return hash.digits();
  };
  EXPECT_EQ(digits(1.5, std::string_view("ab")), digits(1.5, std::string_view("ab")));
  EXPECT_NE(digits(1.5), digits(std::nextafter(1.5, 2.0)));
  EXPECT_NE(digits(std::string_view("ab"), std::string_view("c")),
            digits(std::string_view("a"), std::string_view("bc")));
  EXPECT_EQ(digits(0.0), digits(-0.0));
  // Databases on disk are known by it.
  EXPECT_EQ(digits(1.5, std::string_view("ab")), "e79904cf8ddf099bb926d80d5eccccb9");
}

}  // namespace
}  // namespace blocklift::pipeline

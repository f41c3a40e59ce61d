#include "pipeline/formats/results_store.h"

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/formats/hdf5_exit.h"

namespace blocklift::pipeline {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// As the program does at its beginning: HDF5 would fall over a file that it could not close.
[[maybe_unused]] const bool is_hdf5_told = [] {
  leave_no_files_to_hdf5();
  return true;
}();

/// A folder that vanishes with the test.
class ResultsStore : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("blocklift-" + std::string(test->name()) + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.push_back(entry.path().filename().string());
    return names;
  }

  std::filesystem::path folder_;
};

/// The text of the exception that `action` throws; empty if it throws none.
template <typename Action>
std::string results_error_of(const Action& action) {
  try {
    action();
  } catch (const ResultsError& error) {
    return error.what();
  }
  return "";
}

TEST_F(ResultsStore, ReadsWhatWasWritten) {
  const auto path = folder_ / "results.h5";
  std::vector<double> series(5000);
  for (std::size_t i = 0; i < series.size(); ++i) series[i] = 1e6 / static_cast<double>(i + 1);
  Eigen::MatrixXd column_major(2, 3);
  column_major << 1, 2, 3, 4, 5, 6;
  const std::vector<Eigen::Vector3d> points{{0.1, 0.2, 0.3}, {-1, -2, -3}};
  const std::vector<std::int32_t> quads{0, 1, 2, 3, 4, 5, 6, 7};
  const std::vector<std::string> stages{"hoist up", "turn over, 60°", ""};
  {
    ResultsWriter writer(path);
    writer.write("/dynamic/ropes/R1/tension", series, {"N", "tension of rope R1"});
    writer.write_matrix("/pose", column_major, {"m", "poses"});
    writer.write_matrix("/part", column_major.block(0, 1, 2, 2), {"m", "a part"});
    writer.write_points("/points", points, {"m", "points"});
    writer.write_indices("/quads", quads, 4, {"1", "corners"});
    writer.write("/group", std::vector<std::int32_t>{7, 8}, {"1", "group"});
    writer.write_number("/unknowns", 212345, {"1", "unknowns"});
    writer.write_texts("/operation/stage_names", stages, "names of the stages");
    writer.write_text("/case/yaml", "case: x\nropes: {}\n", "the case file");
    writer.write_attribute("/case", "name", "goliath-turnover");
    writer.write_attribute("/case", "name", "paper-loads");
    writer.write_attribute("/dynamic/ropes/R1/tension", "breaking_load", 9e6);
    writer.write("/nothing", std::vector<double>{}, {"s", "an empty series"});
    writer.make_group("/empty/group");
    writer.finish();
  }
  EXPECT_THAT(files(), ElementsAre("results.h5"));
  // 40 kB of smooth numbers: chunked and deflated.
  EXPECT_LT(std::filesystem::file_size(path), 60000U);

  const ResultsReader reader(path);
  EXPECT_EQ(reader.read("/dynamic/ropes/R1/tension").values, series);
  EXPECT_EQ(reader.read_meaning("/dynamic/ropes/R1/tension").units, "N");
  EXPECT_EQ(reader.read_meaning("/dynamic/ropes/R1/tension").description, "tension of rope R1");
  EXPECT_EQ(reader.read_number_attribute("/dynamic/ropes/R1/tension", "breaking_load"), 9e6);
  EXPECT_THAT(reader.read("/pose").shape, ElementsAre(2, 3));
  EXPECT_THAT(reader.read("/pose").values, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(reader.read("/pose")(1, 0), 4);
  EXPECT_THAT(reader.read("/part").values, ElementsAre(2, 3, 5, 6));
  EXPECT_THAT(reader.read("/points").values, ElementsAre(0.1, 0.2, 0.3, -1, -2, -3));
  EXPECT_THAT(reader.read_indices("/quads").shape, ElementsAre(2, 4));
  EXPECT_EQ(reader.read_indices("/quads").values, quads);
  EXPECT_THAT(reader.read("/group").values, ElementsAre(7, 8));
  EXPECT_THAT(reader.read("/unknowns").values, ElementsAre(212345));
  EXPECT_THAT(reader.read("/unknowns").shape, IsEmpty());
  EXPECT_EQ(reader.read_texts("/operation/stage_names"), stages);
  EXPECT_EQ(reader.read_text("/case/yaml"), "case: x\nropes: {}\n");
  EXPECT_EQ(reader.read_text_attribute("/case", "name"), "paper-loads");
  EXPECT_THAT(reader.read("/nothing").values, IsEmpty());
  EXPECT_TRUE(reader.has("/empty/group"));
  EXPECT_FALSE(reader.has("/empty/group/not/there"));
  EXPECT_FALSE(reader.has_attribute("/case", "title"));
}

TEST_F(ResultsStore, ListsChildrenInTheOrderOfWriting) {
  const auto path = folder_ / "results.h5";
  ResultsWriter writer(path);
  for (const char* rope : {"R3", "R1", "R2"})
    writer.write(std::string("/ropes/") + rope, std::vector<double>{1}, {"N", "tension"});
  writer.make_group("/cases");
  writer.finish();
  const ResultsReader reader(path);
  EXPECT_THAT(reader.children("/ropes"), ElementsAre("R3", "R1", "R2"));
  EXPECT_THAT(reader.children("/"), ElementsAre("ropes", "cases"));
}

TEST_F(ResultsStore, AppearsWholeOrNotAtAll) {
  const auto path = folder_ / "results.h5";
  write_file(path, "the old one");
  {
    ResultsWriter writer(path);
    writer.write("/time", std::vector<double>(100000, 0.5), {"s", "time"});
    EXPECT_EQ(read_file(path), "the old one");
  }
  EXPECT_THAT(files(), ElementsAre("results.h5"));
  EXPECT_EQ(read_file(path), "the old one");
}

TEST_F(ResultsStore, ErrorsNameFileAndDatasetAndSayWhatIsThere) {
  const auto path = folder_ / "results.h5";
  ResultsWriter writer(path);
  writer.write("/static/time", std::vector<double>{0, 1}, {"s", "time"});
  writer.write_text("/case/yaml", "x", "case file");
  EXPECT_THAT(
      results_error_of([&] {
        writer.write("/static/time", std::vector<double>{0}, {"s", "again"});
      }),
      AllOf(HasSubstr("results.h5"), HasSubstr("/static/time"), HasSubstr("written already")));
  EXPECT_THAT(results_error_of([&] {
                writer.write_indices("/quads", std::vector<std::int32_t>(7), 4, {"1", "quads"});
              }),
              HasSubstr("7 numbers do not fill rows of 4"));
  EXPECT_THAT(results_error_of([&] {
                writer.write_number("/static/time/x", 1, {"1", "x"});
              }),
              HasSubstr("/static/time"));
  writer.finish();

  ::testing::internal::CaptureStderr();
  const ResultsReader reader(path);
  EXPECT_THAT(
      results_error_of([&] { reader.read("/static/ropes/R1"); }),
      AllOf(HasSubstr("results.h5"), HasSubstr("/static/ropes/R1"), HasSubstr("holds time")));
  EXPECT_THAT(results_error_of([&] { reader.read("/static"); }), HasSubstr("is not a dataset"));
  EXPECT_THAT(results_error_of([&] { reader.read("/case/yaml"); }),
              HasSubstr("holds texts; numbers are due"));
  EXPECT_THAT(results_error_of([&] { reader.read_indices("/static/time"); }),
              HasSubstr("integers are due"));
  EXPECT_THAT(results_error_of([&] { reader.read_text("/static/time"); }),
              HasSubstr("texts are due"));
  EXPECT_THAT(results_error_of([&] { reader.read_text_attribute("/case", "title"); }),
              HasSubstr("no attribute \"title\""));
  EXPECT_THAT(results_error_of([&] { ResultsReader(folder_ / "none.h5"); }),
              HasSubstr("no such file"));
  write_file(folder_ / "broken.h5", "this is not HDF5");
  EXPECT_THAT(results_error_of([&] { ResultsReader(folder_ / "broken.h5"); }),
              HasSubstr("not a readable HDF5 file"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// As on a full disk, but for the system's words. HDF5 adds time, buffer and offsets.
TEST_F(ResultsStore, WhatCannotBeWrittenIsSaidInTheSystemsWords) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4096, before.rlim_max};
  const auto signal_before = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = results_error_of([&] {
    ResultsWriter writer(folder_ / "results.h5");
    writer.write_text("/long", std::string(100000, 'x'), "more than fits");
    writer.finish();
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, signal_before);
  EXPECT_THAT(error, ::testing::EndsWith("(HDF5: File too large)"));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(ResultsStore, FilesAreReplacedWholeAndFoldersMade) {
  const auto path = folder_ / "a" / "b" / "summary.json";
  write_file(path, "{}");
  write_file(path, std::string("with \0 inside", 13));
  EXPECT_EQ(read_file(path), std::string("with \0 inside", 13));
  EXPECT_THROW(write_file(folder_ / "a", "x"), std::runtime_error);
  EXPECT_THROW(write_file(path / "under-a-file", "x"), std::runtime_error);
  EXPECT_THROW(read_file(folder_ / "none"), std::runtime_error);
  EXPECT_THROW(read_file(folder_), std::runtime_error);
}

}  // namespace
}  // namespace blocklift::pipeline

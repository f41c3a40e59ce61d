#include "pipeline/report/report.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/report/decimation.h"
#include "pipeline/report/lift_frames.h"
#include "pipeline/report/page_data.h"
#include "tests/pipeline/report/sample_result.h"

namespace blocklift::pipeline {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Decimation, KeepsEveryPeakInOrderOfTime) {
  std::vector<double> values(100000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::sin(0.01 * static_cast<double>(i));
  values[31234] = 7.0;
  values[31236] = -7.0;
  values[99999] = 0.25;
  const auto kept = indices_to_draw(values, 500);
  EXPECT_LE(kept.size(), 1002U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), 99999U);
  EXPECT_THAT(kept, ::testing::IsSupersetOf({31234U, 31236U}));
}

TEST(Decimation, LeavesShortSeriesAloneAndSurvivesNan) {
  EXPECT_THAT(indices_to_draw(std::vector<double>{3, 1, 2}, 2), ElementsAre(0, 1, 2));
  EXPECT_THAT(indices_to_draw({}, 10), ElementsAre());
  std::vector<double> values(100, std::numeric_limits<double>::quiet_NaN());
  values[55] = 1.0;
  EXPECT_THAT(indices_to_draw(values, 10), ::testing::Contains(55U));
}

TEST(Decimation, SpreadsIndicesEvenlyWithBothEnds) {
  EXPECT_THAT(evenly_spread_indices(11, 3), ElementsAre(0, 5, 10));
  EXPECT_THAT(evenly_spread_indices(3, 5), ElementsAre(0, 1, 2));
}

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("blocklift-report-" + std::string(test->name()) + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The data that the page holds.
  json page_data() const {
    const std::string page = read_file(folder_ / "report.html");
    const std::string mark = "id=\"data\">";
    const std::size_t begin = page.find(mark) + mark.size();
    return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }

  std::string error_of_report() const {
    try {
      write_report(folder_);
    } catch (const ResultsError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

/// Bytes of a text in base64.
std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  unsigned group = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    group = group << 6U | static_cast<unsigned>(digits.find(letter));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255U);
  }
  return bytes;
}

std::vector<float> floats_in(const std::string& bytes) {
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(float));
  return numbers;
}

/// Numbers of a packed array of 32-bit floats.
std::vector<float> floats_of(const json& packed) {
  return floats_in(decoded(packed["data"].get<std::string>()));
}

/// The numbers of an array of a file of VTK, behind the count of their bytes.
std::vector<float> vtk_floats(const std::filesystem::path& file, const std::string& name) {
  const std::string text = read_file(file);
  const std::size_t array = text.find("Name=\"" + name + "\"");
  const std::size_t begin = text.find('>', array) + 1;
  return floats_in(decoded(text.substr(begin, text.find('<', begin) - begin)).substr(8));
}

TEST_F(Report, HoldsTheWholeResultInOneFile) {
  write_sample_result(folder_);
  EXPECT_EQ(write_report(folder_), folder_ / "report.html");
  const std::string page = read_file(folder_ / "report.html");
  EXPECT_THAT(page, HasSubstr("<title>sample &lt;lift&gt;"));
  // Nothing is fetched: no address stands where a browser would load from it.
  for (const char* load : {"src=\"", "href=\"http", "@import", "url(http"})
    EXPECT_THAT(page.substr(0, page.find("<script")), Not(HasSubstr(load)));
  EXPECT_LT(page.size(), 10'000'000U);

  const json data = page_data();
  EXPECT_EQ(data["summary"]["verdict"], "fail");
  EXPECT_EQ(data["stages"][0]["name"], "hoist </script>");
  EXPECT_EQ(data["scene"]["load"], "block");
  EXPECT_EQ(data["surface"]["groups"], json({"decks", "sides"}));
  EXPECT_EQ(data["surface"]["fields"]["simultaneous"]["dynamic"]["rope"], "R1");
}

TEST_F(Report, ThinsHistoriesButKeepsTheLargestValueAndItsTime) {
  write_sample_result(folder_);
  write_report(folder_);
  const json rope = page_data()["histories"]["dynamic"]["ropes"][0];
  const auto values = floats_of(rope["values"]);
  const auto time = floats_of(rope["time"]);
  ASSERT_EQ(values.size(), time.size());
  EXPECT_LT(values.size(), 8003U);
  const auto top =
      static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  EXPECT_FLOAT_EQ(values[top], 987654.0F);
  EXPECT_NEAR(time[top], 43.21, 1e-4);
}

TEST_F(Report, WritesTheLiftInTimeForParaView) {
  write_sample_result(folder_);
  EXPECT_EQ(write_lift_frames(folder_, 3), folder_ / "lift.pvd");
  const std::string collection = read_file(folder_ / "lift.pvd");
  EXPECT_THAT(collection, AllOf(HasSubstr("timestep=\"50\""), HasSubstr("block-0002.vtu")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "lift-frames"), {}), 6);
  // The sample's block rises by 0.05 m/s from 3 m; its rope R1 ends at (0, 2, 2) in it.
  const auto cranes = vtk_floats(folder_ / "lift-frames/cranes-0001.vtu", "points");
  ASSERT_EQ(cranes.size(), 3U * (8 + 2 + 2));
  EXPECT_THAT(std::vector(cranes.begin(), cranes.begin() + 3), ElementsAre(-5.0F, 1.0F, 29.0F));
  EXPECT_THAT(std::vector(cranes.begin() + 27, cranes.begin() + 30), ElementsAre(0.0F, 2.0F, 7.5F));
  const auto tension = vtk_floats(folder_ / "lift-frames/cranes-0000.vtu", "tension");
  EXPECT_THAT(tension, ElementsAre(0.0F, 5e5F, 5e5F));
  const auto block = vtk_floats(folder_ / "lift-frames/block-0002.vtu", "points");
  const ResultsReader results(folder_ / layout::results_file);
  const Array<double> points = results.read(layout::surface_points);
  ASSERT_EQ(block.size(), points.values.size());
  EXPECT_FLOAT_EQ(block[2], static_cast<float>(points(0, 2) + 8.0));

  write_lift_frames(folder_, 2);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "lift-frames"), {}), 4);
}

TEST_F(Report, HasNoFramesOfWhatDoesNotMove) {
  write_sample_result(folder_, {.motion = false});
  EXPECT_THROW(write_lift_frames(folder_, 3), ResultsError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "lift.pvd"));
}

TEST_F(Report, TakesTheOutputsOfAMechanismByColumns) {
  {
    ResultsWriter writer(folder_ / layout::results_file);
    writer.write(layout::outputs_time, std::vector<double>{0, 1, 2}, {"s", "time"});
    RowMajorMatrix values(3, 2);
    values << 1, 10, 2, 20, 3, 30;
    const std::string path = layout::join(layout::outputs_group, "tip");
    writer.write_matrix(path, values, {"m, rad", "where it is"});
    writer.write_attribute(path, "columns", "x, angle");
    writer.finish();
  }
  write_file(folder_ / layout::summary_file, R"({"case": "arm", "title": "An arm"})");
  write_report(folder_);
  const json data = page_data();
  ASSERT_EQ(data["outputs"].size(), 2U);
  EXPECT_EQ(data["outputs"][1]["name"], "tip");
  EXPECT_EQ(data["outputs"][1]["quantity"], "angle");
  EXPECT_EQ(data["outputs"][1]["units"], "rad");
  EXPECT_THAT(floats_of(data["outputs"][1]["values"]), ElementsAre(10.0F, 20.0F, 30.0F));
}

TEST_F(Report, LeavesOutWhatTheResultsDoNotHave) {
  write_sample_result(folder_, {.motion = false, .structure = false});
  write_report(folder_);
  const json data = page_data();
  EXPECT_TRUE(data["scene"].is_null());
  EXPECT_TRUE(data["surface"].is_null());
  EXPECT_TRUE(data["histories"]["dynamic"].is_null());
}

TEST_F(Report, SaysWhichFileIsMissingOrBroken) {
  EXPECT_THAT(error_of_report(), AllOf(HasSubstr("summary.json"), HasSubstr("no such file")));
  write_sample_result(folder_);
  write_file(folder_ / "summary.json", "{ \"case\": ");
  EXPECT_THAT(error_of_report(), AllOf(HasSubstr("summary.json"), HasSubstr("not readable JSON")));
  write_file(folder_ / "summary.json", "[]");
  EXPECT_THAT(error_of_report(), HasSubstr("not a JSON object"));
  write_file(folder_ / "summary.json", "{}");
  write_file(folder_ / "results.h5", "no");
  EXPECT_THAT(error_of_report(), AllOf(HasSubstr("results.h5"), HasSubstr("not a readable HDF5")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "report.html"));
}

TEST_F(Report, RefusesHistoriesThatDoNotFitTheirTime) {
  ResultsWriter writer(folder_ / "results.h5");
  writer.write("/static/time", std::vector<double>{0, 1, 2}, {"s", "time"});
  writer.write("/static/ropes/R1/tension", std::vector<double>{1, 2}, {"N", "tension"});
  writer.finish();
  write_file(folder_ / "summary.json", "{}");
  EXPECT_THAT(error_of_report(),
              AllOf(HasSubstr("/static/ropes/R1/tension"), HasSubstr("2 samples")));
}

}  // namespace
}  // namespace blocklift::pipeline

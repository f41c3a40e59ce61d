#include "pipeline/measurement/record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "tests/pipeline/measurement/sample_record.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MeasuredRecords : public ::testing::Test {
 protected:
  MeasuredRecords() { test::write_sample_lift("lift"); }

  std::vector<MeasuredRecord> read(const std::string& text) const {
    folder_.write("record.csv", text);
    const ResultsReader results("lift/results.h5");
    return read_records({"record.csv"}, results);
  }
  std::string refusal_of(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was refused";
  }
  static std::string rows(int count, const std::string& values) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(i) + values + '\n';
    return text;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(MeasuredRecords, AreReadInTheUnitsOfTheResults) {
  const auto records = read(
      "# load cells of 4 May\n\"time [min]\";\"ropes.R1 [t]\";ropes.R2 [kN];bodies.block.roll "
      "[deg];"
      "wind.speed [km/h]\n" +
      rows(9, ";2;30;180;36"));
  ASSERT_EQ(records.size(), 1u);
  ASSERT_EQ(records[0].channels.size(), 4u);
  EXPECT_DOUBLE_EQ(records[0].channels[0].series.time[2], 120);
  EXPECT_DOUBLE_EQ(records[0].channels[0].series.values[2], 2 * 9806.65);
  EXPECT_DOUBLE_EQ(records[0].channels[1].series.values[2], 30e3);
  EXPECT_NEAR(records[0].channels[2].series.values[2], 3.14159265359, 1e-9);
  EXPECT_NEAR(records[0].channels[3].series.values[2], 10, 1e-12);
}

TEST_F(MeasuredRecords, TakeTheNamesOfOurOwnTables) {
  const auto records =
      read("time [s],R1.tension [N],R2 [N],block.roll [rad]\n" + rows(9, ",1,2,3"));
  ASSERT_EQ(records[0].channels.size(), 3u);
  EXPECT_EQ(records[0].channels[0].name, "ropes.R1");
  EXPECT_EQ(records[0].channels[1].name, "ropes.R2");
  EXPECT_EQ(records[0].channels[2].name, "bodies.block.roll");
}

TEST_F(MeasuredRecords, SayAllThatIsWrongWithTheirPlaces) {
  EXPECT_THAT(refusal_of("time [s],ropes.R9 [kN],ropes.R2 [m],ropes.R1\n" + rows(9, ",1,2,3")),
              AllOf(HasSubstr("record.csv:1:1: error: the results hold no \"ropes.R9\" (column 2)"),
                    HasSubstr("ropes.R2\" is in m, which is no unit"),
                    HasSubstr("\"ropes.R1\" has no unit"), HasSubstr("3 errors")));
  EXPECT_THAT(refusal_of(rows(9, ",1")),
              HasSubstr("record.csv:1:1: error: the record has no header"));
  EXPECT_THAT(refusal_of("ropes.R1 [N],x\n" + rows(9, ",1")), HasSubstr("no column \"time\""));
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N],ropes.R1 [N]\n" + rows(9, ",1,1")),
              HasSubstr("is there twice"));
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n" + rows(9, ",1") + "3,1\n"),
              HasSubstr("record.csv:11:1: error: the time 3 s does not follow 8 s"));
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n" + rows(9, ",1") + "8,1\n"),
              HasSubstr("record.csv:11:1: error: the time 8 s is that of an earlier row"));
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n" + rows(3, ",1") + "3,x\n"),
              HasSubstr("record.csv:5:1: error: \"x\" is neither a finite number nor an instant"));
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n" + rows(3, ",1")), HasSubstr("3 rows"));
  const ResultsReader results("lift/results.h5");
  EXPECT_THROW(read_records({"missing.csv"}, results), InputError);
}

// Each channel has the instants at which it said something.
TEST_F(MeasuredRecords, MayHaveGaps) {
  const auto records =
      read("time [s],ropes.R1 [N],ropes.R2 [N]\n" + rows(9, ",1,2") + "9,,2\n10,NaN,3\n11,4,3\n");
  ASSERT_EQ(records[0].channels.size(), 2u);
  EXPECT_EQ(records[0].channels[0].series.size(), 10u);
  EXPECT_EQ(records[0].channels[0].series.time.back(), 11);
  EXPECT_EQ(records[0].channels[0].series.values.back(), 4);
  EXPECT_EQ(records[0].channels[1].series.size(), 12u);
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N],ropes.R2 [N]\n" + rows(7, ",1,2") + "8,,2\n"),
              HasSubstr("the column \"ropes.R1\" has 7 values; at least 8 are needed"));
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n" + rows(9, ",1") + ",1\n"),
              HasSubstr("record.csv:11:1: error: the row has no time"));
}

// Loggers send rows twice, late, or without a time: a few of them are no reason to refuse all.
TEST_F(MeasuredRecords, MayHaveAFewRowsOutOfOrder) {
  std::string text = "time [s],ropes.R1 [N]\n";
  for (int i = 0; i < 100; ++i) {
    const int k = i == 40 ? 41 : i == 41 ? 40 : i;
    text += std::to_string(k) + ',' + std::to_string(10 * k) + '\n';
    if (i == 70) text += "70,-5\n,7\n";
  }
  const auto records = read(text);
  const TimeSeries& series = records.at(0).channels.at(0).series;
  ASSERT_EQ(series.size(), 100u);
  for (std::size_t i = 0; i < series.size(); ++i) EXPECT_EQ(series.values[i], 10 * series.time[i]);
  EXPECT_THAT(records[0].remarks,
              ElementsAre(HasSubstr("1 of the 102 rows of record.csv had no time"),
                          HasSubstr("1 of the 102 rows of record.csv came later"),
                          HasSubstr("1 of the 102 rows of record.csv had the time of an earlier")));
  // A clock that was set back is another matter.
  text = "time [s],ropes.R1 [N]\n";
  for (int i = 0; i < 300; ++i) text += std::to_string(i < 200 ? i : i - 7) + ",1\n";
  EXPECT_THAT(refusal_of(text), HasSubstr("time has to rise"));
}

TEST_F(MeasuredRecords, MayHaveTheTimeOfAClock) {
  std::string cells = "time;ropes.R1 [kN]\n";
  for (int i = 0; i < 9; ++i)
    cells += (i < 5 ? "23:59:5" + std::to_string(i + 5) : "00:00:0" + std::to_string(i - 5)) +
             ",5;2,5\n";
  const auto over_midnight = read(cells);
  EXPECT_EQ(over_midnight[0].channels[0].series.time.front(), 0);
  EXPECT_EQ(over_midnight[0].channels[0].series.time.back(), 8);
  EXPECT_EQ(over_midnight[0].channels[0].series.values.back(), 2500);

  // One row has no time, and one of before midnight comes after it.
  cells = "time,ropes.R1 [N]\n";
  for (int i = 0; i < 60; ++i) {
    const int k = i == 30 ? 29 : i == 29 ? 30 : i;
    cells += (k < 30 ? "23:59:" + std::to_string(k + 30) : "00:00:" + std::to_string(k - 20)) +
             ',' + std::to_string(k) + '\n';
    if (i == 0) cells += ",5\n";
  }
  const auto late = read(cells);
  const TimeSeries& sorted = late[0].channels[0].series;
  ASSERT_EQ(sorted.size(), 60u);
  EXPECT_EQ(sorted.time[29], 29);
  EXPECT_EQ(sorted.values[29], 29);
  EXPECT_EQ(sorted.time.back(), 69);

  // The hour when summer time ends comes twice, and its zone tells which it is.
  cells = "time,ropes.R1 [kN]\n";
  for (const char* zone : {"+02:00", "+01:00"})
    for (int i = 0; i < 5; ++i)
      cells += "2026-10-25 02:" + std::to_string(10 + 10 * i) + ":00" + zone + ",1\n";
  const auto over_summer = read(cells);
  EXPECT_EQ(over_summer[0].channels[0].series.time[5], 3600);

  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n10:00:00,1\n10:00:01,1\n10:00:02,1\n10:00:03,1\n"
                         "10:00:04,1\n10:00:05,1\n10:00:06,1\n10:00:07,1\n"),
              HasSubstr("leave the unit out"));
}

TEST_F(MeasuredRecords, FindTensionsAndAttitudesInTheResults) {
  const ResultsReader results("lift/results.h5");
  EXPECT_THAT(names_of_channels(results),
              ElementsAre("ropes.R1", "ropes.R2", "bodies.block.x", "bodies.block.y",
                          "bodies.block.z", "bodies.block.roll", "bodies.block.pitch",
                          "bodies.block.yaw", "bodies.hook.x", "bodies.hook.y", "bodies.hook.z",
                          "bodies.hook.roll", "bodies.hook.pitch", "bodies.hook.yaw"));
  const ComputedChannel rope = read_computed_channel(results, "ropes.R1");
  EXPECT_EQ(rope.unit, "N");
  EXPECT_NEAR(rope.in_motion.at(23), test::sample_tension(23), 1e-6);
  EXPECT_NEAR(rope.at_rest.at(23), test::sample_tension(0), 1e-6);
  EXPECT_DOUBLE_EQ(read_computed_channel(results, "bodies.block.z").in_motion.at(7), 3);
}

}  // namespace
}  // namespace blocklift::pipeline

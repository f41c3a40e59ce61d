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
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n" + rows(3, ",1") + "3,x\n"),
              HasSubstr("record.csv:5:1: error: \"x\" is not a finite number"));
  EXPECT_THAT(refusal_of("time [s],ropes.R1 [N]\n" + rows(3, ",1")), HasSubstr("3 rows"));
  const ResultsReader results("lift/results.h5");
  EXPECT_THROW(read_records({"missing.csv"}, results), InputError);
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

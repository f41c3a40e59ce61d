#include "pipeline/study/limits/alpha_factor.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::HasSubstr;

constexpr double an_hour = 3600;
const char* const table_head = "operation_period_h,significant_height_m,alpha\n";

/// A study whose table has the rows given, of an operation that is planned for so long.
class AlphaTable : public ::testing::Test {
 protected:
  void write(const std::string& text) { folder_.write("alpha.csv", text); }
  static AlphaFactor read(double planned_hours, double contingency_hours = 0) {
    StudyFile study;
    study.file = "study.yaml";
    study.limits.emplace();
    study.limits->alpha_table = Located<std::string>{"alpha.csv", {}};
    study.limits->planned_period = Located<double>{planned_hours * an_hour, {}};
    if (contingency_hours > 0)
      study.limits->contingency = Located<double>{contingency_hours * an_hour, {}};
    return read_alpha_factor(study);
  }
  std::string refusal(const std::string& rows, double planned_hours = 20) {
    write(table_head + rows);
    try {
      read(planned_hours);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(AlphaTable, IsEnteredByPeriodAndHeight) {
  // In any order.
  write(std::string(table_head) + "24,2,0.7\n24,1,0.6\n12,1,0.7\n12,3,0.9\n12,2,0.8\n24,3,0.8\n");
  const AlphaFactor long_one = read(20);
  EXPECT_TRUE(long_one.is_of_table());
  EXPECT_EQ(long_one.row_period(), 24);
  EXPECT_NEAR(long_one.at(1.5), 0.65, 1e-12);
  EXPECT_NEAR(long_one.at(2), 0.7, 1e-12);
  EXPECT_NEAR(long_one.at(2.25), 0.725, 1e-12);
  EXPECT_EQ(long_one.at(0.3), 0.6);
  EXPECT_EQ(long_one.at(3), 0.8);
  EXPECT_EQ(long_one.at(7), 0.8);
  EXPECT_EQ(long_one.text(), "alpha from 0.6 to 0.8, by the height, of operations up to 24 h");
  EXPECT_EQ(read(12).row_period(), 12);
  EXPECT_EQ(read(12.1).row_period(), 24);
  EXPECT_EQ(read(3).at(1), 0.7);
}

// 10 h and 6 h of contingency are a reference period of 16 h; the row is that of 10 h.
TEST_F(AlphaTable, IsEnteredWithoutTheContingency) {
  write(std::string(table_head) + "12,1,0.7\n24,1,0.6\n");
  const AlphaFactor alpha = read(10, 6);
  EXPECT_EQ(alpha.row_period(), 12);
  EXPECT_EQ(alpha.at(1), 0.7);
  EXPECT_NEAR(alpha.reference_period(), 16, 1e-12);
  EXPECT_NEAR(read(10).reference_period(), 10, 1e-12);
}

TEST_F(AlphaTable, IsRefusedWithItsLine) {
  const std::string whole = "12,1,0.7\n12,2,0.8\n24,1,0.6\n24,2,0.7\n";
  EXPECT_EQ(refusal(whole), "");
  EXPECT_THAT(refusal(whole, 30), HasSubstr("planned for 30 h, and alpha.csv ends at 24 h"));
  EXPECT_THAT(refusal(whole + "24,2,0.8\n"), HasSubstr("alpha.csv:6:1"));
  EXPECT_THAT(refusal(whole + "36,1,0.6\n"), HasSubstr("36 h have no alpha for 2 m"));
  EXPECT_THAT(refusal(whole + "36,1,1.2\n"), HasSubstr("alpha is 1.2; from 0.01 to 1 is allowed"));
  EXPECT_THAT(refusal(whole + "0,1,0.7\n"), HasSubstr("a period of 0 h is not above zero"));
  EXPECT_THAT(refusal(whole + "36,-1,0.7\n"), HasSubstr("a height of -1 m is negative"));
  write("operation_period_h,height,alpha\n12,1,0.7\n");
  EXPECT_THROW(read(12), InputError);
}

TEST(AlphaFactor, IsOneNumberWithoutATable) {
  StudyFile study;
  study.limits.emplace();
  EXPECT_EQ(read_alpha_factor(study).at(3), 1);
  study.limits->alpha = Located<double>{0.71, {}};
  const AlphaFactor alpha = read_alpha_factor(study);
  EXPECT_FALSE(alpha.is_of_table());
  EXPECT_EQ(alpha.at(0.1), 0.71);
  EXPECT_EQ(alpha.at(30), 0.71);
  EXPECT_EQ(alpha.text(), "alpha 0.71");
}

}  // namespace
}  // namespace blocklift::pipeline

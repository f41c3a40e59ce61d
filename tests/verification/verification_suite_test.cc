// The verification suite of the product, `blocklift verify`, case by case.
#include <algorithm>
#include <ostream>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/verification/suite/suite.h"

namespace blocklift::pipeline {

/// How a failing test names its case.
void PrintTo(const VerificationCase& entry, std::ostream* stream) {
  *stream << entry.stage << '/' << entry.name;
}

namespace {

const std::vector<VerificationCase>& suite() {
  static const std::vector<VerificationCase> cases =
      verification_suite(ModelLibrary::of_installation());
  return cases;
}

class VerificationSuite : public ::testing::TestWithParam<VerificationCase> {};

TEST_P(VerificationSuite, AgreesWithItsReferences) {
  for (const VerificationRow& row : run(GetParam())) {
    EXPECT_TRUE(row.pass()) << row.quantity << ": computed " << row.computed << " " << row.unit
                            << ", reference " << row.reference << ", error " << row.error
                            << ", tolerance " << row.tolerance << ' ' << row.note;
    EXPECT_NE(row.source, "") << row.quantity;
    EXPECT_NE(row.unit, "") << row.quantity;
  }
}

std::string test_name(const ::testing::TestParamInfo<VerificationCase>& info) {
  std::string name = info.param.stage + "_" + info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, VerificationSuite, ::testing::ValuesIn(suite()), test_name);

TEST(VerificationSuiteList, NamesAreUnique) {
  std::set<std::string> names;
  for (const VerificationCase& entry : suite()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_EQ(entry.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
              std::string::npos)
        << entry.name;
  }
}

}  // namespace
}  // namespace blocklift::pipeline

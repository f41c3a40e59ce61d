#include "pipeline/terminal/text_table.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace blocklift::pipeline {
namespace {

std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

TEST(FormatFigure, KeepsDigitsBeforeThePointAndAvoidsPowersOfTen) {
  EXPECT_EQ(format_figure(139.284), "139.3");
  EXPECT_EQ(format_figure(0.0012345), "0.001234");
  EXPECT_EQ(format_figure(123456.7), "123457");
  EXPECT_EQ(format_figure(0), "0");
  EXPECT_EQ(format_figure(2.5e-6, 3), "2.50e-06");
  EXPECT_EQ(format_figure(3.1e9, 3), "3.10e+09");
  EXPECT_EQ(format_figure(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(TextTable, GivesAColumnTheDecimalsOfItsLargest) {
  TextTable table({{"rope"}, {"t", 4}});
  table.add_row({"R1", 140.237});
  table.add_row({"R2", 0.04});
  table.add_row({"R3", std::numeric_limits<double>::quiet_NaN()});
  table.add_row({"R4", -0.01});
  table.add_row({"R5", "slack"});
  EXPECT_EQ(table.text(),
            "rope      t\n"
            "R1    140.2\n"
            "R2      0.0\n"
            "R3        -\n"
            "R4      0.0\n"
            "R5    slack\n");
}

TEST(TextTable, WritesPowersOfTenWhereAColumnHasNothingElse) {
  TextTable table({{"row"}, {"N", 3}});
  table.add_row({"a", 0.0});
  table.add_row({"b", -2.5e-9});
  EXPECT_EQ(table.text(),
            "row          N\n"
            "a            0\n"
            "b    -2.50e-09\n");
}

TEST(TextTable, ContinuesBelowWhatIsTooWide) {
  std::vector<TableColumn> columns = {{"name"}};
  for (int c = 0; c < 12; ++c) columns.push_back({"column " + std::to_string(c), 5});
  TextTable table(columns);
  std::vector<TextTable::Cell> row = {"of all"};
  for (int c = 0; c < 12; ++c) row.emplace_back(1000.0 + c);
  table.add_row(row);
  const std::string text = table.text();
  EXPECT_LE(longest_line(text), terminal_width);
  for (int c = 0; c < 12; ++c)
    EXPECT_NE(text.find(std::to_string(1000 + c)), std::string::npos) << c;
  // Each part begins with the name.
  EXPECT_EQ(std::count(text.begin(), text.end(), 'l') > 0, true);
  EXPECT_NE(text.find("of all"), text.rfind("of all"));
}

TEST(TextTable, BreaksLongTextsAtBlanks) {
  TextTable table({{"check"}, {"use", 3}});
  table.add_row(
      {"a name of many words that nobody would want to read in one line of a table", 0.5});
  const std::string text = table.text();
  EXPECT_LE(longest_line(text), 46U);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST(TextTable, BreaksHeadingsBeforeItGoesOnBelow) {
  std::vector<TableColumn> columns = {{"name"}};
  for (int c = 0; c < 8; ++c) columns.push_back({"a long heading", 3});
  TextTable table(columns);
  table.add_row({"row", 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0});
  const std::string text = table.text();
  EXPECT_LE(longest_line(text), terminal_width);
  EXPECT_TRUE(text.starts_with("name   a long   a long"));
  EXPECT_EQ(text.find("row"), text.rfind("row"));
}

TEST(TextTable, CountsCharactersAndNotBytes) {
  TextTable table({{"name"}, {"m", 2}});
  table.add_row({"\u00d8\u00d8\u00d8\u00d8", 1.0});
  table.add_row({"abcd", 2.0});
  EXPECT_EQ(table.text(), "name    m\n\u00d8\u00d8\u00d8\u00d8  1.0\nabcd  2.0\n");
}

TEST(WrapText, LeavesAWordThatIsTooLongWhole) {
  EXPECT_EQ(wrap_text("a incomprehensibilities b", 5),
            (std::vector<std::string>{"a", "incomprehensibilities", "b"}));
}

}  // namespace
}  // namespace blocklift::pipeline

#include "pipeline/formats/series_file.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/formats/clock_time.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsNan;

class SeriesFiles : public ::testing::Test {
 protected:
  SeriesFile read(const std::string& text, SeriesCells allowed = SeriesCells::numbers) const {
    folder_.write("series.csv", text);
    return read_series_file("series.csv", allowed);
  }
  std::string refusal_of(const std::string& text,
                         SeriesCells allowed = SeriesCells::numbers) const {
    try {
      read(text, allowed);
    } catch (const SeriesFileError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  const test::TemporaryFolder folder_;
};

TEST_F(SeriesFiles, AreReadWhateverSetsTheirNumbersApart) {
  for (const char* text : {"a,b\n0,1.5\n1,-2e3\n", "a;b\n0;1.5\n1;-2e3\n", "a;b\n0;1,5\n1;-2e3\n",
                           "a\tb\n0\t1,5\n1\t-2e3\n", "a,\tb\n0,\t1.5\n1,\t-2e3\n",
                           "\xEF\xBB\xBF\"a\";\"b\"\r\n0;+1,5\r\n+1;-2e+3\r\n"}) {
    const SeriesFile series = read(text);
    EXPECT_THAT(series.names, ElementsAre("a", "b")) << text;
    ASSERT_EQ(series.columns.size(), 2u) << text;
    EXPECT_THAT(series.columns[0], ElementsAre(0, 1)) << text;
    EXPECT_THAT(series.columns[1], ElementsAre(1.5, -2000)) << text;
  }
}

/// Latin text as UTF-16.
std::string utf16_of(const std::string& text, bool is_little_endian) {
  std::string bytes;
  for (const char one : text) {
    if (!is_little_endian) bytes += '\0';
    bytes += one;
    if (is_little_endian) bytes += '\0';
  }
  return bytes;
}

// As spreadsheets and loggers of Windows save them, and those of a machine of old.
TEST_F(SeriesFiles, AreReadAsUtf16AndByAnyEndOfLine) {
  const std::string text = "a,b\r\n0,1.5\r\n# pause\r\n1,-2e3\r\n";
  for (const std::string& bytes :
       {"\xFF\xFE" + utf16_of(text, true), "\xFE\xFF" + utf16_of(text, false), utf16_of(text, true),
        utf16_of(text, false), std::string("a,b\r0,1.5\r# pause\r1,-2e3")}) {
    const SeriesFile series = read(bytes);
    EXPECT_THAT(series.names, ElementsAre("a", "b"));
    ASSERT_EQ(series.columns.size(), 2u);
    EXPECT_THAT(series.columns[1], ElementsAre(1.5, -2000));
    EXPECT_THAT(series.lines, ElementsAre(2, 4));
  }
  // "ä€" and a character beyond the first plane, in the bytes of UTF-16.
  const std::string name("\xE4\0\xAC\x20\x3D\xD8\x00\xDE", 8);
  EXPECT_THAT(read("\xFF\xFE" + name + utf16_of("\n1\n", true)).names,
              ElementsAre("\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80"));
}

TEST_F(SeriesFiles, SayWhatStandsBeforeTheFirstRow) {
  EXPECT_THAT(refusal_of("time,R1\ns,kN\n0,1\n", SeriesCells::of_loggers),
              HasSubstr("series.csv:2: \"s\" is neither a finite number nor an instant such as "
                        "2026-05-04T10:00:00.5Z or 10:00:00.5; one line is the header, and others "
                        "before the first row have to begin with #"));
  EXPECT_THAT(refusal_of(std::string("a,b\n0,1\n0\0,2\n", 14)),
              HasSubstr("series.csv:3: a zero byte"));
}

TEST_F(SeriesFiles, RefuseFolders) {
  folder_.write("records/series.csv", "a,b\n0,1\n");
  EXPECT_THAT([] { read_series_file("records"); },
              ::testing::ThrowsMessage<SeriesFileError>(HasSubstr("records: this is a folder")));
}

// A comma that sets numbers apart is none in a number.
TEST_F(SeriesFiles, TellTheLineOfWhatTheyCannotHold) {
  EXPECT_THAT(refusal_of("a,b\n0,1\n\n# pause\n1,2,5\n"),
              HasSubstr("series.csv:5: 3 values; 2 are"));
  EXPECT_THAT(refusal_of("a,b\n0,\n"), HasSubstr("series.csv:2: \"\" is not a finite number"));
  EXPECT_THAT(refusal_of("a,b\n0,inf\n", SeriesCells::of_loggers), HasSubstr("\"inf\" is neither"));
  EXPECT_THAT(refusal_of("a;b\n0;1.234,5\n"), HasSubstr("\"1.234,5\" is not a finite number"));
  EXPECT_THAT(refusal_of("a,b\n10:00:00,1\n"), HasSubstr("\"10:00:00\" is not a finite number"));
  EXPECT_THAT(refusal_of("a,b\n"), HasSubstr("the file has no rows"));
  EXPECT_THAT(refusal_of("time,b\n10:00:00,1\n11,2\n", SeriesCells::of_loggers),
              HasSubstr("series.csv:3: \"11\" is a number where lines before have instants"));
  EXPECT_THAT(
      refusal_of("time,b\n11,2\n12:00:00,1\n", SeriesCells::of_loggers),
      HasSubstr("series.csv:3: \"12:00:00\" is an instant where lines before have numbers"));
}

TEST_F(SeriesFiles, OfLoggersHaveGapsAndClocks) {
  const SeriesFile series =
      read("time;a;b;\n10:00:00,5;1,5;NaN;\n10:00:01;;2;\n\n10:00:01,25;-;3;\n",
           SeriesCells::of_loggers);
  EXPECT_THAT(series.names, ElementsAre("time", "a", "b"));
  EXPECT_THAT(series.is_clock, ElementsAre(true, false, false));
  EXPECT_FALSE(series.has_dates);
  EXPECT_THAT(series.columns[0], ElementsAre(36000.5, 36001, 36001.25));
  EXPECT_THAT(series.columns[1], ElementsAre(1.5, IsNan(), IsNan()));
  EXPECT_THAT(series.columns[2], ElementsAre(IsNan(), 2, 3));
  EXPECT_THAT(series.lines, ElementsAre(2, 3, 5));
  const SeriesFile without_time = read("time,a\n0,1\n#N/A,2\n2,#N/A\n", SeriesCells::of_loggers);
  EXPECT_THAT(without_time.columns[0], ElementsAre(0, IsNan(), 2));
  EXPECT_THAT(without_time.columns[1], ElementsAre(1, 2, IsNan()));
}

// 2026-05-04T10:00:00Z is 1777888800 s after 1970 began (date -d).
TEST(ClockTimes, AreReadAsLoggersWriteThem) {
  for (const char* text :
       {"2026-05-04T10:00:00Z", "2026-05-04 12:00:00+02:00", "2026-05-04 04:30:00.000-0530",
        "04.05.2026 10:00:00", "2026-05-04 10:00"}) {
    const auto instant = read_clock_time(text);
    ASSERT_TRUE(instant) << text;
    EXPECT_EQ(instant->seconds, 1777888800.0) << text;
    EXPECT_TRUE(instant->has_date);
  }
  EXPECT_DOUBLE_EQ(read_clock_time("23:59:59.75")->seconds, 86399.75);
  EXPECT_EQ(read_clock_time("2024-02-29T00:00Z")->seconds + 86400,
            read_clock_time("2024-03-01T00:00Z")->seconds);
  for (const char* text : {"", "10", "24:00:00", "10:60", "10:00:60", "2026-02-30 10:00:00",
                           "2026-05-04", "05/04/2026 10:00:00", "10:00:00 x", "10:00:00+2"})
    EXPECT_FALSE(read_clock_time(text)) << text;
}

}  // namespace
}  // namespace blocklift::pipeline

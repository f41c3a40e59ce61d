#include "pipeline/declaration/document.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <yaml-cpp/yaml.h>

#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// What is said about a file `case.yaml` of that text.
std::string complaints_about(std::string_view text) {
  const test::TemporaryFolder folder;
  folder.write("case.yaml", text);
  Diagnostics diagnostics;
  const auto document = load_document("case.yaml", diagnostics);
  EXPECT_EQ(document.has_value(), !diagnostics.has_errors());
  return diagnostics.to_text();
}

TEST(DocumentTest, KnowsWhereItsNodesStand) {
  const test::TemporaryFolder folder;
  folder.write("case.yaml", "a: 1\nb:\n  - x\n  - y\n");
  Diagnostics diagnostics;
  const auto document = load_document("case.yaml", diagnostics);
  ASSERT_TRUE(document);
  const Mark mark = document->mark_of(document->root["b"][1]);
  EXPECT_EQ(*mark.file, "case.yaml");
  EXPECT_EQ(mark.line, 4);
  EXPECT_EQ(mark.column, 5);
}

TEST(DocumentTest, RefusesAnEmptyFile) {
  const std::string message =
      "case.yaml: error: the file is empty; keys and values are due\n1 error\n";
  EXPECT_EQ(complaints_about(""), message);
  EXPECT_EQ(complaints_about("# nothing but a comment\n\n"), message);
}

TEST(DocumentTest, TellsHowADeckIsNamed) {
  const test::TemporaryFolder folder;
  folder.write("Hull.BDF", "SOL 101\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(load_document("Hull.BDF", diagnostics));
  EXPECT_NE(diagnostics.to_text().find("mesh: {file: Hull.BDF, units: mm-t-N}"), std::string::npos)
      << diagnostics.to_text();
}

TEST(DocumentTest, RefusesWhatIsNoText) {
  EXPECT_EQ(complaints_about(std::string_view("\x7f"
                                              "ELF\0\1",
                                              6)),
            "case.yaml: error: the file is binary, not text; a YAML file is due\n1 error\n");
  EXPECT_EQ(complaints_about("a: 1\nb: Gr\xfc\xdf"
                             "e\n"),
            "case.yaml:2:6: error: the byte 0xFC is not UTF-8; save the file as UTF-8\n1 error\n");
  EXPECT_EQ(complaints_about(std::string_view("\xff\xfe"
                                              "a\0",
                                              4)),
            "case.yaml: error: the file is UTF-16 text; save it as UTF-8\n1 error\n");
}

TEST(DocumentTest, TakesUtf8WithAndWithoutByteOrderMark) {
  EXPECT_EQ(complaints_about("title: Grüße, 吊り上げ\n"), "");
  EXPECT_EQ(complaints_about("\xef\xbb\xbftitle: x\n"), "");
}

TEST(DocumentTest, RefusesALargeFileWithoutReadingIt) {
  const test::TemporaryFolder folder;
  folder.write("case.yaml", "a: 1\n");
  fs::resize_file("case.yaml", 50'000'000);
  Diagnostics diagnostics;
  EXPECT_FALSE(load_document("case.yaml", diagnostics));
  EXPECT_EQ(diagnostics.to_text(),
            "case.yaml: error: the file has 50.0 MB; an input file has at most 10 MB\n1 error\n");
}

TEST(DocumentTest, RefusesWhatCannotBeRead) {
  const test::TemporaryFolder folder;
  fs::create_directory("folder");
  Diagnostics diagnostics;
  EXPECT_FALSE(load_document("missing.yaml", diagnostics));
  EXPECT_FALSE(load_document("folder", diagnostics));
  EXPECT_FALSE(load_document("/dev/zero", diagnostics));
  EXPECT_EQ(diagnostics.to_text(),
            "missing.yaml: error: there is no such file\n"
            "folder: error: this is a folder; a YAML file is due\n"
            "/dev/zero: error: this is no ordinary file; a YAML file is due\n"
            "3 errors\n");
}

TEST(DocumentTest, SaysWhereYamlIsBroken) {
  EXPECT_EQ(complaints_about("a: [1, 2\n"),
            "case.yaml:2:1: error: this is not YAML: end of sequence flow not found\n"
            "    a bracket in this line or above it is opened and not closed\n1 error\n");
  EXPECT_EQ(complaints_about("a:\n\tb: 1\n"),
            "case.yaml:2:3: error: this is not YAML: illegal map value\n"
            "    YAML indents with blanks, never with tabs\n1 error\n");
  EXPECT_EQ(
      complaints_about("title: lift: turn\n"),
      "case.yaml:1:12: error: this is not YAML: illegal map value\n"
      "    a key is followed by one value, or by nothing and its own keys on deeper lines; text "
      "that holds \": \" needs quotes\n1 error\n");
  EXPECT_EQ(
      complaints_about("a: 1\n---\nb: 2\n"),
      "case.yaml:3:1: error: a second YAML document begins here; one file holds one\n"
      "    is the line before indented like its neighbours, or a \"---\" too many?\n1 error\n");
}

TEST(DocumentTest, NamesAnAnchorThatIsMissing) {
  EXPECT_EQ(complaints_about("a: *missing\n"),
            "case.yaml:1:4: error: no anchor \"&missing\" comes before \"*missing\"\n"
            "    \"&missing\" before a value names it\n1 error\n");
  EXPECT_EQ(complaints_about("rope: &sling {length: 4 m}\nother: &chain 1\n"
                             "list: [{model: *slings, length: 4 m}]\nlate: &slings 2\n"),
            "case.yaml:3:16: error: no anchor \"&slings\" comes before \"*slings\"\n"
            "    the anchors before it are sling, chain; did you mean \"sling\"?\n1 error\n");
  EXPECT_NE(complaints_about("Größe: [*größe]\r\n").find("no anchor \"&größe\""),
            std::string::npos);
}

TEST(DocumentTest, SaysThatABracketIsOpen) {
  for (const char* text : {"a: 1\nb: {c: 1, d: 2\ne: 3\n", "a: 1\nb: [1, 2\ne: 3\n"}) {
    EXPECT_NE(complaints_about(text).find("is opened and not closed"), std::string::npos) << text;
  }
}

TEST(DocumentTest, SurvivesDeepNesting) {
  const std::string message = "lists and keys are nested too deeply";
  EXPECT_NE(complaints_about(std::string(200000, '[')).find(message), std::string::npos);
  std::string maps;
  for (int i = 0; i < 100000; ++i) maps += "{a: ";
  EXPECT_NE(complaints_about(maps).find(message), std::string::npos);
  std::string items;
  for (int i = 0; i < 100000; ++i) items += "- ";
  EXPECT_NE(complaints_about(items).find(message), std::string::npos);
}

// The parser does not pass these between documents and would find empty ones without end.
TEST(DocumentTest, LoneCommasAndBracketsEnd) {
  for (const char* text : {",", "]", "}", "a: 1\n--- ,", ", a: 1"}) {
    EXPECT_NE(complaints_about(text).find("error"), std::string::npos) << text;
  }
}

RC_GTEST_PROP(DocumentProperty, NeverBreaksOnAnyBytes, (const std::string& bytes)) {
  complaints_about(bytes);
}

}  // namespace
}  // namespace blocklift::pipeline

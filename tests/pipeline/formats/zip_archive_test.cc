#include "pipeline/formats/zip_archive.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/pipeline/run_program.h"
#include "tests/pipeline/temporary_folder.h"

namespace blocklift::pipeline {
namespace {

// The check value of CRC-32 by its definition, and that of nothing.
TEST(ZipArchiveTest, SumsAsItsDefinitionSays) {
  EXPECT_EQ(crc_32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc_32(""), 0U);
}

// Another program finds the files, their sums right and their contents whole.
TEST(ZipArchiveTest, IsReadByAnotherProgram) {
  const test::TemporaryFolder folder;
  ZipArchive archive;
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i % 256);
  archive.add("a.txt", "first");
  archive.add("folder/\xc3\xa9.bin", bytes);
  archive.add("empty", "");
  folder.write("x.zip", archive.finish());
  folder.write("read.py", R"(import zipfile
with zipfile.ZipFile("x.zip") as x:
    assert x.testzip() is None
    assert x.namelist() == ["a.txt", "folder/\u00e9.bin", "empty"], x.namelist()
    assert x.read("a.txt") == b"first"
    assert x.read("folder/\u00e9.bin") == bytes(i % 256 for i in range(1000))
    assert x.read("empty") == b""
    assert x.infolist()[0].date_time[:3] == (1980, 1, 1)
)");
  const test::Outcome outcome = test::run_command("/usr/bin/python3 read.py");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace blocklift::pipeline

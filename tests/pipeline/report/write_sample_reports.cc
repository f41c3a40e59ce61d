#include <exception>
#include <filesystem>
#include <iostream>

#include "pipeline/report/report.h"
#include "tests/pipeline/report/sample_result.h"

/// Writes the sample reports that page_test.mjs opens in a browser: whole, loads and motion below a
/// folder.
int main(int argument_count, char** arguments) {
  using namespace blocklift::pipeline;
  try {
    if (argument_count != 2) throw std::runtime_error("usage: write_sample_reports FOLDER");
    const std::filesystem::path folder(arguments[1]);
    write_sample_result(folder / "whole");
    write_sample_result(folder / "loads", {.motion = false, .structure = true});
    write_sample_result(folder / "motion", {.motion = true, .structure = false});
    for (const char* name : {"whole", "loads", "motion"}) write_report(folder / name);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

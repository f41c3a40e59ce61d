#include <exception>
#include <filesystem>
#include <iostream>

#include "pipeline/comparison/comparison.h"
#include "pipeline/formats/atomic_file.h"
#include "tests/pipeline/comparison/sample_folder.h"

/// Writes the page of a sample comparison, which comparison_page_test.mjs opens in a browser.
int main(int argument_count, char** arguments) {
  using namespace blocklift::pipeline;
  try {
    if (argument_count != 2) throw std::runtime_error("usage: write_sample_comparison FOLDER");
    const std::filesystem::path folder(arguments[1]);
    test::write_sample_folder(folder / "before", test::sample_summary(), "settle: 3 s\n", "a: 1\n");
    test::write_sample_folder(folder / "after", test::sample_summary(), "settle: 4 s\n", "a: 1\n");
    const ResultComparison comparison =
        compare_results(read_compared_results({folder / "before", folder / "after"}), {});
    write_file(folder / "comparison.html", comparison_page(comparison));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

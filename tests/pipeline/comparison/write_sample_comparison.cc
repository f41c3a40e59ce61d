#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include "pipeline/comparison/comparison.h"
#include "pipeline/formats/atomic_file.h"
#include "tests/pipeline/comparison/sample_folder.h"

/// Writes the pages of sample comparisons, without and with blocks, which comparison_page_test.mjs
/// opens in a browser.
int main(int argument_count, char** arguments) {
  using namespace blocklift::pipeline;
  try {
    if (argument_count != 2) throw std::runtime_error("usage: write_sample_comparison FOLDER");
    const std::filesystem::path folder(arguments[1]);
    const auto write_result = [&](const char* name, const char* yaml,
                                  const std::optional<test::SampleBlock>& block) {
      test::write_sample_folder(folder / name, test::sample_summary(), yaml, "a: 1\n", block);
    };
    write_result("before", "settle: 3 s\n", std::nullopt);
    write_result("after", "settle: 4 s\n", std::nullopt);
    write_result("coarse", "settle: 3 s\n", test::SampleBlock{test::sample_surface(3), 1});
    write_result("fine", "settle: 4 s\n", test::SampleBlock{test::sample_surface(8), 1.1});
    write_result("other", "settle: 4 s\n", test::SampleBlock{test::sample_surface(8, "wall"), 1});
    const auto write_page = [&](const char* page, const std::vector<std::filesystem::path>& names) {
      std::vector<std::filesystem::path> folders;
      for (const std::filesystem::path& name : names) folders.push_back(folder / name);
      write_file(folder / page,
                 comparison_page(compare_results(read_compared_results(folders), {})));
    };
    write_page("comparison.html", {"before", "after"});
    write_page("blocks.html", {"coarse", "fine", "other"});
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace blocklift::pipeline {

/// An input file of a run as it stood, with the name that the case calls it by.
struct InputText {
  std::string name;  ///< empty for the case file itself
  std::string yaml;
};

/// The results of one run, as comparisons take them.
struct ComparedResult {
  std::string name;              ///< as the user called it, short enough for a table's head
  std::filesystem::path folder;  ///< with summary.json and results.h5
  nlohmann::ordered_json summary;
  std::vector<InputText> input;  ///< the case file first, then its models
  bool has_models = false;       ///< false for results of versions that kept the case file alone
};

/// Do two values of an input file say the same, as "400 cm" and "4 m", "[1 m, x]" and
/// "[100 cm, x]" do?
bool is_same_value(const std::string& value, const std::string& other);

/// Reads the results in a folder, or those of a case: a case file, or a folder with a case.yaml,
/// that was assessed into results/<name of the case> of the working folder.
/// @throws InputError if there are no results, if they cannot be read, or if the case says other
///   than what its results were computed from.
ComparedResult read_compared_result(const std::filesystem::path& path);

/// The same for several, each with a name of its own; all that is wrong is said at once.
std::vector<ComparedResult> read_compared_results(const std::vector<std::filesystem::path>& paths);

}  // namespace blocklift::pipeline

#include "pipeline/comparison/compared_result.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/document.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/files/named_file.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results/results_folder.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/formats/results/run_identity.h"
#include "pipeline/formats/results/summary_file.h"
#include "pipeline/formats/results_store.h"
#include "pipeline/report/input_values.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

void complain(Diagnostics& diagnostics, const fs::path& path, std::string message,
              std::vector<std::string> hints = {}) {
  diagnostics.error({std::make_shared<const std::string>(shown_path(path)), 0, 0},
                    std::move(message), std::move(hints));
}

std::vector<InputText> read_input(const ResultsReader& results) {
  std::vector<InputText> input;
  if (results.has(layout::case_yaml)) input.push_back({"", results.read_text(layout::case_yaml)});
  if (!results.has(layout::model_names)) return input;
  const std::vector<std::string> names = results.read_texts(layout::model_names);
  const std::vector<std::string> contents = results.read_texts(layout::model_contents);
  for (std::size_t i = 0; i < std::min(names.size(), contents.size()); ++i)
    input.push_back({names[i], contents[i]});
  return input;
}

std::optional<ComparedResult> read_folder(const fs::path& folder, Diagnostics& diagnostics) {
  const std::vector<FileComplaint> complaints = complaints_about_folder(folder);
  for (const FileComplaint& complaint : complaints)
    complain(diagnostics, complaint.file, complaint.message);
  if (!complaints.empty()) return std::nullopt;
  try {
    ComparedResult result;
    result.folder = folder;
    result.summary = read_summary(folder / layout::summary_file);
    const ResultsReader results(folder / layout::results_file);
    if (const std::string mixed = mixed_runs(results, result.summary); !mixed.empty()) {
      complain(diagnostics, folder, mixed);
      return std::nullopt;
    }
    result.input = read_input(results);
    result.has_models = results.has(layout::model_names);
    return result;
  } catch (const ResultsError& error) {
    complain(diagnostics, folder, error.what());
    return std::nullopt;
  }
}

std::string name_of_case(const Document& document) {
  const YAML::Node name = document.root.IsMap() ? document.root["case"] : YAML::Node();
  return name && name.IsScalar() ? name.Scalar() : std::string();
}

bool say_the_same(const std::string& yaml, const std::string& other) {
  const auto values = list_input_values(yaml);
  const auto others = list_input_values(other);
  return std::equal(values.begin(), values.end(), others.begin(), others.end(),
                    [](const InputValue& a, const InputValue& b) {
                      return a.key == b.key && is_same_value(a.value, b.value);
                    });
}

/// A plain value, or a list of such, in parts: brackets, and what stands between them and commas.
std::vector<std::string> parts_of(const std::string& value) {
  std::vector<std::string> parts(1);
  for (const char letter : value) {
    if (letter == '[' || letter == ']' || letter == ',') {
      parts.emplace_back(1, letter);
      parts.emplace_back();
    } else if (letter != ' ' || !parts.back().empty()) {
      parts.back() += letter;
    }
  }
  return parts;
}

std::optional<Measure> measure_of(const std::string& text) {
  try {
    return parse_measure(text);
  } catch (const QuantityError&) {
    return std::nullopt;
  }
}

bool is_same_part(const std::string& a, const std::string& b) {
  constexpr double rounding = 1e-12;
  if (a == b) return true;
  const std::optional<Measure> one = measure_of(a), other = measure_of(b);
  return one && other && one->exponents == other->exponents &&
         std::abs(one->value - other->value) <=
             rounding * std::max(std::abs(one->value), std::abs(other->value));
}

/// What a model says that it is; empty if it does not.
std::string kind_of_model(const std::string& yaml) {
  for (const InputValue& value : list_input_values(yaml))
    if (value.key == "kind") return value.value;
  return {};
}

/// What files in a folder say that may be a model of one of these kinds.
std::vector<std::string> texts_in(const fs::path& folder, const std::string& model,
                                  const std::vector<std::string>& kinds) {
  std::vector<std::string> endings = {"", ".yaml"};
  for (const std::string& kind : kinds) endings.push_back(fmt::format("/{}.yaml", kind));
  std::vector<std::string> texts;
  for (const std::string& ending : endings) {
    const fs::path file = folder / (model + ending);
    std::error_code error;
    if (fs::is_regular_file(file, error)) texts.push_back(read_file(file));
  }
  return texts;
}

/// What files say that a case may mean by a model's name: beside it, or else in the first folder of
/// models that has any, of its kind before all others; standards go by short names, too. None of a
/// model that is gone, and of one that another model names and that stands beside that.
std::vector<std::string> texts_of_model(const fs::path& beside, const std::string& model,
                                        const std::string& kind) {
  std::vector<fs::path> folders = {beside};
  for (const fs::path& folder : model_path()) {
    folders.push_back(folder);
    folders.push_back(folder / "standards");
  }
  const std::vector<std::string> all = {"block", "crane", "rope", "standard", "vessel"};
  for (const std::vector<std::string>& kinds : {std::vector<std::string>{kind}, all}) {
    for (const fs::path& folder : folders) {
      std::vector<std::string> texts = texts_in(folder, model, kinds);
      if (!texts.empty()) return texts;
    }
  }
  return {};
}

/// The first file of a case, itself or a model that it names, that says other than its result was
/// computed from; empty if there is none.
std::string find_changed_file(const ComparedResult& result, const Document& document,
                              const fs::path& folder) {
  if (result.input.empty() || !say_the_same(result.input[0].yaml, document.text)) return "the case";
  for (const InputText& input : result.input) {
    if (input.name.empty()) continue;
    const std::vector<std::string> texts =
        texts_of_model(folder, input.name, kind_of_model(input.yaml));
    const auto is_it = [&](const std::string& text) { return say_the_same(input.yaml, text); };
    if (!texts.empty() && std::ranges::none_of(texts, is_it))
      return "the case's model " + input.name;
  }
  return "";
}

/// The results that a case was assessed into.
std::optional<ComparedResult> read_case(const fs::path& file, Diagnostics& diagnostics) {
  const std::optional<Document> document = load_document(file, diagnostics);
  if (!document) return std::nullopt;
  const std::string name = name_of_case(*document);
  if (name.empty()) {
    complain(diagnostics, file, "is neither a folder of results nor a lift case");
    return std::nullopt;
  }
  const fs::path folder = fs::path("results") / name;
  const std::string how = fmt::format("run \"blocklift assess {}\" first", shown_path(file));
  if (!is_there(folder / layout::summary_file)) {
    complain(diagnostics, file,
             fmt::format("the case has no results: {} holds none", folder.string()),
             {how + ", or name the folder of its results"});
    return std::nullopt;
  }
  std::optional<ComparedResult> result = read_folder(folder, diagnostics);
  if (!result) return std::nullopt;
  const std::string changed = find_changed_file(*result, *document, file.parent_path());
  if (!changed.empty()) {
    complain(diagnostics, file,
             fmt::format("{} was changed after its results in {} were computed", changed,
                         folder.string()),
             {how + ", or name the folder to take the results as they are"});
    return std::nullopt;
  }
  return result;
}

std::optional<ComparedResult> read_result(const fs::path& path, Diagnostics& diagnostics) {
  std::optional<ComparedResult> result;
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    result = read_case(path, diagnostics);
  } else if (is_there(path / layout::summary_file)) {
    result = read_folder(path, diagnostics);
  } else if (is_there(path / "case.yaml")) {
    result = read_case(path / "case.yaml", diagnostics);
  } else {
    complain(diagnostics, path, "this folder has neither results nor a case",
             {"results are a folder with summary.json and results.h5, a case one with case.yaml"});
  }
  if (result) {
    fs::path name = path.lexically_normal();
    if (!name.has_filename()) name = name.parent_path();
    result->name = name.filename() == "case.yaml" ? name.parent_path().filename().string()
                                                  : name.filename().string();
    if (result->name.empty() || result->name == ".")
      result->name = result->summary.value("case", path.string());
  }
  return result;
}

/// Results of one name are told apart by their whole paths.
void tell_apart(const std::vector<fs::path>& paths, std::vector<ComparedResult>& results) {
  std::vector<std::string> names;
  for (const ComparedResult& result : results) names.push_back(result.name);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (std::count(names.begin(), names.end(), names[i]) > 1)
      results[i].name = paths[i].lexically_normal().string();
}

bool are_one_place(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error);
}

/// Two cases of one name have one folder of results: the lift of one would stand for both. A case
/// beside its own folder is no mistake.
void refuse_shared_results(const std::vector<fs::path>& paths,
                           const std::vector<ComparedResult>& results, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < results.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const fs::path& folder = results[i].folder;
      if (folder != results[k].folder || are_one_place(paths[i], paths[k]) ||
          are_one_place(paths[i], folder) || are_one_place(paths[k], folder))
        continue;
      complain(diagnostics, paths[i],
               fmt::format("{} stands for this and for {}", folder.string(), shown_path(paths[k])),
               {"give the cases names of their own, or assess them into folders of their own with "
                "--output and name these"});
      break;
    }
}

}  // namespace

bool is_same_value(const std::string& value, const std::string& other) {
  if (value == other) return true;
  const std::vector<std::string> parts = parts_of(value), others = parts_of(other);
  return std::ranges::equal(parts, others, is_same_part);
}

ComparedResult read_compared_result(const fs::path& path) {
  return read_compared_results({path}).front();
}

std::vector<ComparedResult> read_compared_results(const std::vector<fs::path>& paths) {
  Diagnostics diagnostics;
  std::vector<ComparedResult> results;
  for (const fs::path& path : paths)
    if (auto result = read_result(path, diagnostics)) results.push_back(std::move(*result));
  if (!diagnostics.has_errors()) refuse_shared_results(paths, results, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  tell_apart(paths, results);
  return results;
}

}  // namespace blocklift::pipeline

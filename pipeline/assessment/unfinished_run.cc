#include "pipeline/assessment/unfinished_run.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/terminal/run_log.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr const char* hidden_folder = ".unfinished";
constexpr const char* traits_file = "run.txt";
constexpr const char* part_ending = ".part";
constexpr std::size_t digits = 32;  // of a fingerprint

std::string text_of_traits(const std::vector<RunTrait>& traits) {
  std::string text;
  for (const RunTrait& trait : traits) text += trait.what + ": " + trait.is + "\n";
  return text;
}

std::map<std::string, std::string> traits_of_text(const std::string& text) {
  std::map<std::string, std::string> traits;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(": ");
    if (end != std::string::npos) traits[line.substr(0, end)] = line.substr(end + 2);
  }
  return traits;
}

std::string hash_of_text(std::string_view text) {
  ContentHash hash;
  hash.add(text);
  return hash.digits();
}

}  // namespace

UnfinishedRun::UnfinishedRun(const fs::path& results, std::vector<RunTrait> traits)
    : folder_(results / hidden_folder), traits_(std::move(traits)) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder_ / traits_file, ignored)) return;
  try {
    const auto earlier = traits_of_text(read_file(folder_ / traits_file));
    for (const RunTrait& trait : traits_) {
      const auto found = earlier.find(trait.what);
      if (found == earlier.end() || found->second != trait.is) differences_.push_back(trait.what);
    }
    is_of_this_run_ = differences_.empty();
  } catch (const std::runtime_error&) {
    // What cannot be read is done again.
  }
}

std::string UnfinishedRun::identity() const { return hash_of_text(text_of_traits(traits_)); }

std::vector<std::string> UnfinishedRun::parts() const {
  std::vector<std::string> names;
  if (!is_of_this_run_) return names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error))
    if (entry.path().extension() == part_ending) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::string> UnfinishedRun::find(const std::string& part) const {
  const fs::path file = folder_ / (part + part_ending);
  std::error_code ignored;
  if (!is_of_this_run_ || !fs::is_regular_file(file, ignored)) return std::nullopt;
  try {
    const std::string text = read_file(file);
    const std::string_view all = text;
    if (all.size() < 2 * digits || all.substr(0, digits) != identity() ||
        all.substr(digits, digits) != hash_of_text(all.substr(2 * digits)))
      return std::nullopt;
    log_entry("of the run that was stopped: " + part);
    return text.substr(2 * digits);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

double UnfinishedRun::keep_after() {
  constexpr double usual = 10;  // s
  const char* given = std::getenv("BLOCKLIFT_KEEP_AFTER");
  if (given == nullptr) return usual;
  char* end = nullptr;
  const double seconds = std::strtod(given, &end);
  return end == given || *end != '\0' || !(seconds >= 0) ? usual : seconds;
}

bool UnfinishedRun::is_due() const { return since_kept_.elapsed() >= keep_after(); }

void UnfinishedRun::keep(const std::string& part, const std::string& bytes) {
  try {
    if (!is_of_this_run_) {
      fs::remove_all(folder_);
      write_file(folder_ / traits_file, text_of_traits(traits_));
      is_of_this_run_ = true;
    }
    write_file(folder_ / (part + part_ending), identity() + hash_of_text(bytes) + bytes);
    log_entry("kept, in case this run is stopped: " + part);
  } catch (const std::runtime_error& error) {
    log_entry(std::string("not kept: ") + error.what());
  }
  since_kept_.lap();
}

void UnfinishedRun::forget() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  is_of_this_run_ = false;
}

}  // namespace blocklift::pipeline

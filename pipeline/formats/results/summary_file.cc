#include "pipeline/formats/results/summary_file.h"

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

namespace {

/// Far more than a summary has; what goes on inward without end would end this program's stack.
constexpr int deepest = 64;

/// The words of a parser's message without its number in brackets.
std::string plain(const std::string& message) {
  const std::size_t end = message.find("] ");
  return message.starts_with('[') && end != std::string::npos ? message.substr(end + 2) : message;
}

}  // namespace

nlohmann::ordered_json read_summary(const std::filesystem::path& path) {
  using Json = nlohmann::ordered_json;
  if (!std::filesystem::exists(path)) throw ResultsError(path.string() + ": there is no such file");
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest)
      throw ResultsError(path.string() + ": its tables and lists lie more than " +
                         std::to_string(deepest) + " deep in each other");
    return true;
  };
  try {
    Json summary = Json::parse(read_file(path), watch);
    if (!summary.is_object()) throw ResultsError(path.string() + ": is not a JSON object");
    return summary;
  } catch (const Json::exception& error) {
    throw ResultsError(path.string() + ": is not readable JSON: " + plain(error.what()));
  }
}

}  // namespace blocklift::pipeline

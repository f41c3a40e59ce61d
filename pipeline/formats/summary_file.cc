#include "pipeline/formats/summary_file.h"

#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/results_store.h"

namespace blocklift::pipeline {

nlohmann::ordered_json read_summary(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw ResultsError(path.string() + ": there is no such file");
  try {
    nlohmann::ordered_json summary = nlohmann::ordered_json::parse(read_file(path));
    if (!summary.is_object()) throw ResultsError(path.string() + ": is not a JSON object");
    return summary;
  } catch (const nlohmann::json::exception& error) {
    throw ResultsError(path.string() + ": is not readable JSON: " + error.what());
  }
}

}  // namespace blocklift::pipeline

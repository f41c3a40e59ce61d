#include "tests/benchmarks/peers/ratio_report.h"

#include <algorithm>
#include <iomanip>
#include <limits>

namespace blocklift::peers {

bool RatioReport::ReportContext(const Context& context) {
  PrintBasicContext(&GetErrorStream(), context);
  return true;
}

void RatioReport::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const std::string name = run.run_name.function_name;
    if (run.error_occurred) {
      GetErrorStream() << name << ": " << run.error_message << "\n";
      continue;
    }
    if (run.run_type != Run::RT_Iteration) continue;
    const std::string model = name.substr(0, name.find('/'));
    if (std::find(models_.begin(), models_.end(), model) == models_.end()) models_.push_back(model);
    const auto [entry, is_new] = fastest_.try_emplace(name, run.GetAdjustedCPUTime());
    if (!is_new) entry->second = std::min(entry->second, run.GetAdjustedCPUTime());
  }
}

void RatioReport::Finalize() {
  std::ostream& out = GetOutputStream();
  out << std::left << std::setw(24) << unit_ << std::right;
  for (const std::string& library : libraries_) out << std::setw(13) << library;
  out << std::setw(20) << "ours / best other"
      << "\n"
      << std::fixed;
  std::sort(models_.begin(), models_.end());
  for (const std::string& model : models_) {
    out << std::left << std::setw(24) << model << std::right;
    double ours = std::numeric_limits<double>::quiet_NaN();
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < libraries_.size(); ++i) {
      const auto found = fastest_.find(model + "/" + libraries_[i]);
      if (found == fastest_.end()) {
        out << std::setw(13) << "-";
        continue;
      }
      out << std::setw(13) << std::setprecision(2) << found->second;
      (i == 0 ? ours : best) = i == 0 ? found->second : std::min(best, found->second);
    }
    out << std::setw(20) << std::setprecision(3) << ours / best << "\n";
  }
}

int run_side_by_side(int argc, char** argv, RatioReport& report) {
  std::vector<char*> arguments(argv, argv + argc);
  // What the user gives comes later and so takes precedence.
  std::string shuffle = "--benchmark_enable_random_interleaving=true";
  std::string repetitions = "--benchmark_repetitions=15";
  std::string duration = "--benchmark_min_time=0.02";
  arguments.insert(arguments.begin() + 1, {shuffle.data(), repetitions.data(), duration.data()});
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  benchmark::RunSpecifiedBenchmarks(&report);
  benchmark::Shutdown();
  return 0;
}

}  // namespace blocklift::peers

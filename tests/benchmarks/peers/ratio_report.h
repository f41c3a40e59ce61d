#pragma once

#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace blocklift::peers {

/// Collects benchmarks named "model/library" and prints, at the end, a table of the times and of
/// the first library's over the best of the others: per model the fastest repetition counts, which
/// other work on the machine disturbs least.
class RatioReport : public benchmark::BenchmarkReporter {
 public:
  /// @param libraries columns of the table, ours first.
  /// @param unit what the numbers are, "one evaluation, us".
  RatioReport(std::vector<std::string> libraries, std::string unit)
      : libraries_(std::move(libraries)), unit_(std::move(unit)) {}

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  std::vector<std::string> libraries_;
  std::string unit_;
  std::vector<std::string> models_;  ///< in the order of their appearance
  std::map<std::string, double> fastest_;
};

/// Runs what is registered, one thread, repetitions of all benchmarks shuffled so that changes of
/// the machine's speed hit all alike. @returns the program's exit code.
int run_side_by_side(int argc, char** argv, RatioReport& report);

}  // namespace blocklift::peers

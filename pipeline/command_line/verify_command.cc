#include "pipeline/command_line/verify_command.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/declaration/diagnostics.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/terminal/progress_bar.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"
#include "pipeline/verification/suite/suite.h"

namespace blocklift::pipeline {
namespace {

/// A pattern that no case matches.
struct NothingMatched {
  std::string pattern;
};

std::vector<VerificationCase> select(std::vector<VerificationCase> suite,
                                     const std::vector<std::string>& patterns) {
  if (patterns.empty()) return suite;
  for (const std::string& pattern : patterns) {
    if (std::none_of(suite.begin(), suite.end(),
                     [&](const VerificationCase& entry) { return matches(entry, pattern); })) {
      throw NothingMatched{pattern};
    }
  }
  std::erase_if(suite, [&](const VerificationCase& entry) {
    return std::none_of(patterns.begin(), patterns.end(),
                        [&](const std::string& pattern) { return matches(entry, pattern); });
  });
  return suite;
}

void complain(const std::string& pattern, const std::vector<VerificationCase>& suite) {
  std::vector<std::string> names;
  for (const VerificationCase& entry : suite) names.push_back(entry.name);
  fmt::print(stderr, "blocklift: error: no verification case matches \"{}\"\n", pattern);
  const std::string meant = nearest_name(pattern, names);
  fmt::print(stderr, "    a part of stage/name or a glob is due; the cases are{}\n",
             meant.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", meant));
  for (const VerificationCase& entry : suite) {
    fmt::print(stderr, "        {}/{}\n", entry.stage, entry.name);
  }
}

/// A figure with what it is held against: three lines, for the texts are long.
void print_row(const std::string& name, const VerificationRow& row) {
  if (is_quiet() && row.pass()) return;
  print_wrapped(fmt::format("{}  {}: {}{}", row.pass() ? "pass" : "FAIL", name, row.quantity,
                            row.unit.empty() ? "" : ", " + row.unit));
  fmt::print("      {:.10g}, reference {:.10g}; error {:.1e} of {:.1e} allowed\n", row.computed,
             row.reference, row.error, row.tolerance);
  for (const std::string& line : wrap_text(row.source, terminal_width - 6))
    fmt::print("      {}\n", line);
  for (const std::string& line : wrap_text(row.note, terminal_width - 6))
    if (!line.empty()) fmt::print("      {}\n", line);
  std::fflush(stdout);
}

nlohmann::ordered_json as_json(const VerificationCase& entry, const VerificationRow& row) {
  nlohmann::ordered_json json = {{"name", entry.name},         {"stage", entry.stage},
                                 {"quantity", row.quantity},   {"unit", row.unit},
                                 {"reference", row.reference}, {"computed", row.computed},
                                 {"error", row.error},         {"tolerance", row.tolerance},
                                 {"source", row.source},       {"pass", row.pass()}};
  if (!row.note.empty()) json["note"] = row.note;
  return json;
}

int run_cases(const std::vector<VerificationCase>& cases, bool json) {
  const auto start = std::chrono::steady_clock::now();
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  std::size_t rows = 0, failed = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const VerificationCase& entry = cases[i];
    const std::vector<VerificationRow> found = [&] {
      ProgressBar bar("verifying");
      bar.show(static_cast<double>(i) / static_cast<double>(cases.size()),
               entry.stage + "/" + entry.name);
      return run(entry);
    }();
    for (const VerificationRow& row : found) {
      ++rows;
      failed += row.pass() ? 0 : 1;
      if (json) {
        results.push_back(as_json(entry, row));
      } else {
        print_row(entry.name, row);
      }
    }
  }
  if (json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"results", results}}.dump(2));
  } else {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    fmt::print("{} of {} figures agree with their references ({:.0f} s)\n", rows - failed, rows,
               seconds.count());
  }
  return failed == 0 ? exit_code::done : exit_code::run_failed;
}

}  // namespace

int verify(const VerifyOptions& options) {
  const std::vector<VerificationCase> suite = verification_suite(ModelLibrary::of_installation());
  std::vector<VerificationCase> cases;
  try {
    cases = select(suite, options.only);
  } catch (const NothingMatched& nothing) {
    complain(nothing.pattern, suite);
    return exit_code::wrong_input;
  }
  if (!options.list) return run_cases(cases, options.json);
  for (const VerificationCase& entry : cases) {
    fmt::print("{:<36} {}\n", entry.stage + "/" + entry.name, entry.source);
  }
  return exit_code::done;
}

}  // namespace blocklift::pipeline

#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace blocklift::pipeline {

/// How much a command says.
struct LogChoice {
  bool quiet = false;               ///< nothing but warnings, errors and verdicts; no progress
  bool verbose = false;             ///< the entries of the log on standard error as well
  std::optional<std::string> file;  ///< where the entries are appended
};

/// The file of the log cannot be written.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Opens the log of a run, in place of an earlier one, and enters the program, its arguments and
/// its folder. Before, entries are dropped and nothing is quiet.
/// @throws LogError if the file cannot be written.
void begin_log(const LogChoice& choice, const std::vector<std::string>& arguments);

/// Enters the exit code, the time since begin_log and the most memory that the process held.
void end_log(int exit_code);

/// True if only warnings, errors and verdicts are to be printed.
bool is_quiet();

/// Enters what the run does; from any thread.
void log_entry(const std::string& text);
/// Enters an error that is printed elsewhere.
void log_error(const std::string& text);
/// Enters a warning, and prints it on standard output in quiet runs, too.
void say_warning(const std::string& text);

}  // namespace blocklift::pipeline

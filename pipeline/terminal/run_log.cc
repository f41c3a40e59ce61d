#include "pipeline/terminal/run_log.h"

#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "pipeline/terminal/text_table.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

/// The one log of the process: progress and messages belong to no run's model.
struct Log {
  std::unique_ptr<spdlog::logger> entries;
  bool quiet = false;
  Clock::time_point begun = Clock::now();
};

Log& the_log() {
  static Log log;
  return log;
}

spdlog::sink_ptr file_sink(const std::string& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file);
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
    return sink;
  } catch (const spdlog::spdlog_ex& error) {
    throw LogError(fmt::format("the log \"{}\" cannot be written: {}", file, error.what()));
  }
}

spdlog::sink_ptr error_sink() {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_pattern("%H:%M:%S.%e %v");
  // Warnings and errors are printed where they arise.
  return sink;
}

/// GB.
double largest_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e6;
}

}  // namespace

void begin_log(const LogChoice& choice, const std::vector<std::string>& arguments) {
  Log& log = the_log();
  log.quiet = choice.quiet;
  log.begun = Clock::now();
  std::vector<spdlog::sink_ptr> sinks;
  if (choice.file) sinks.push_back(file_sink(*choice.file));
  if (choice.verbose) sinks.push_back(error_sink());
  log.entries.reset();
  if (sinks.empty()) return;
  log.entries = std::make_unique<spdlog::logger>("blocklift", sinks.begin(), sinks.end());
  log.entries->flush_on(spdlog::level::info);
  std::error_code unknown;
  log_entry(fmt::format("blocklift {}, in {}: blocklift {}", program_version,
                        std::filesystem::current_path(unknown).string(),
                        fmt::join(arguments, " ")));
}

void end_log(int exit_code) {
  const std::chrono::duration<double> elapsed = Clock::now() - the_log().begun;
  log_entry(fmt::format("exit code {} after {:.1f} s, at most {:.2f} GB of memory", exit_code,
                        elapsed.count(), largest_memory()));
}

bool is_quiet() { return the_log().quiet; }

void log_entry(const std::string& text) {
  if (the_log().entries) the_log().entries->info(text);
}

void log_error(const std::string& text) {
  if (the_log().entries) the_log().entries->error(text);
}

void say_warning(const std::string& text) {
  print_wrapped("warning: " + text);
  if (the_log().entries) the_log().entries->warn(text);
}

}  // namespace blocklift::pipeline

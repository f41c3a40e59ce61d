#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace blocklift::pipeline::test {

/// What came of running a program.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

inline std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Runs a command line of the shell in the working directory.
inline Outcome run_command(const std::string& command_line) {
  const std::filesystem::path error_file =
      std::filesystem::temp_directory_path() /
      (std::filesystem::current_path().filename().string() + ".err");
  FILE* pipe = popen((command_line + " 2>'" + error_file.string() + "'").c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run: " + command_line);
  Outcome outcome;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    outcome.out.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.err = text_of_file(error_file);
  std::filesystem::remove(error_file);
  return outcome;
}

/// Pattern of what a program may write to its standard error where nobody watches: lines of
/// progress, half a minute apart, and nothing else.
inline constexpr const char* only_progress = "([^\n\r]+ [0-9]+ %, [^\n\r]+\n)*";

/// Runs a program with arguments as the shell reads them.
inline Outcome run_program(const std::string& program, const std::string& arguments) {
  return run_command("'" + program + "' " + arguments);
}

}  // namespace blocklift::pipeline::test

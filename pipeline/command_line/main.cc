#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "pipeline/command_line/validate_command.h"
#include "pipeline/input/schema.h"
#include "pipeline/version.h"

namespace {

using namespace blocklift::pipeline;

// Exit codes: 0 done and sound, 1 the run failed or the lift does not pass, 2 the input is wrong.
constexpr int run_failed = 1;
constexpr int wrong_input = 2;

void add_validate(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "validate", "Read a lift case or model file with all that it names, and say what is wrong");
  auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("CASE", *files, "case file, folder with a case.yaml, or model file")
      ->required();
  command->callback([files, &exit_code] { exit_code = validate_files(*files); });
}

void add_schema(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("schema", "Print the JSON schema of the input files, for editors");
  auto manual = std::make_shared<bool>(false);
  auto kind = std::make_shared<std::string>();
  command->add_flag("--manual", *manual, "print a manual in Markdown instead, key by key");
  command->add_option("--kind", *kind, "only this kind of file")
      ->check(CLI::IsMember(input_file_kinds()));
  command->callback(
      [manual, kind] { std::cout << (*manual ? markdown_manual(*kind) : json_schema(*kind)); });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"From a lift case to the stress report of a heavy lift"};
  app.name("blocklift");
  app.set_version_flag("--version", std::string("blocklift ") + std::string(program_version));
  app.require_subcommand(1);
  int exit_code = EXIT_SUCCESS;
  add_validate(app, exit_code);
  add_schema(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? EXIT_SUCCESS : wrong_input;
  } catch (const std::exception& error) {
    std::cerr << "blocklift: error: " << error.what() << '\n';
    return run_failed;
  }
  return exit_code;
}

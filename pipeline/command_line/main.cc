#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "pipeline/command_line/assess_command.h"
#include "pipeline/command_line/command_pages.h"
#include "pipeline/command_line/compare_command.h"
#include "pipeline/command_line/expect_command.h"
#include "pipeline/command_line/freed_memory.h"
#include "pipeline/command_line/hydro_command.h"
#include "pipeline/command_line/limits.h"
#include "pipeline/command_line/measured_command.h"
#include "pipeline/command_line/new_command.h"
#include "pipeline/command_line/rig_command.h"
#include "pipeline/command_line/simulate_command.h"
#include "pipeline/command_line/stress_command.h"
#include "pipeline/command_line/sweep_command.h"
#include "pipeline/command_line/validate_command.h"
#include "pipeline/command_line/verify_command.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/files/schema/schema.h"
#include "pipeline/formats/hdf5_exit.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/processes/processor.h"
#include "pipeline/templates/new_case.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/version.h"
#include "structure/outside_files.h"
#include "structure/process_group.h"

namespace {

using namespace blocklift::pipeline;
using blocklift::structure::ProcessGroup;

/// Of each command that reads input which may come from others.
void add_allow_outside(CLI::App& command) {
  command.add_flag_callback("--allow-outside", blocklift::structure::allow_files_outside,
                            "let the input name files outside its folder and the models; scripts "
                            "of Gmsh may do anything");
}

/// Of each command that may compute the radiation of vessels.
void add_no_cache(CLI::App& command, bool& anew) {
  command.add_flag("--no-cache", anew,
                   "compute the water about vessels anew: take nothing from the cache, and put "
                   "nothing there");
}

void add_set(CLI::App& command, std::vector<std::string>& changes) {
  command
      .add_option("--set", changes,
                  "give a key of the case or of its models another value, key=value or "
                  "model:key=value; may be repeated")
      ->allow_extra_args(false);
}

void add_assess(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "assess", "Run a lift case: dynamics, loads on the block, stress, checks, report");
  auto options = std::make_shared<AssessOptions>();
  command->add_option("CASE", options->path, "case file, or folder with a case.yaml")->required();
  command->add_option("-o,--output", options->output,
                      "folder of the results (results/<name of the case> if not given)");
  command->add_flag("--decks", options->decks,
                    "write the governing load cases for other solvers as well: load-cases.inp "
                    "(Abaqus, CalculiX) and load-cases.bdf (Nastran)");
  command->add_option("--expect", options->expect,
                      "file of figures that the lift is held to (\"expect\" writes one); exit code "
                      "3 if one is off");
  add_set(*command, options->set);
  add_limits(*command);
  add_no_cache(*command, options->anew);
  add_allow_outside(*command);
  command->callback([options, &code] { code = assess_case(*options); });
}

void add_compare(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "compare", "Lay results beside each other: input that differs, loads, stress, checks");
  auto options = std::make_shared<CompareOptions>();
  command
      ->add_option("RESULTS", options->results,
                   "folders of results, or cases that were assessed into results/; changes count "
                   "from the first")
      ->required()
      ->expected(2, CLI::detail::expected_max_vector_size);
  command->add_option(
      "--tolerance", options->tolerance,
      "how far figures may move, figure=tolerance,... or a YAML file of such lines; "
      "exit code 3 if one moves further");
  command->add_flag("--json", options->json, "print JSON");
  command->add_option(
      "-o,--output", options->page,
      "write a page as well: tables, blocks beside each other, tensions over each other");
  command->callback([options, &code] { code = compare(*options); });
}

void add_expect(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "expect", "Write the figures of a lift with tolerances, for \"assess --expect\"");
  auto options = std::make_shared<ExpectOptions>();
  command
      ->add_option("RESULT", options->result,
                   "folder of results, or a case that was assessed into results/")
      ->required();
  command->add_option("-o,--output", options->file,
                      "the file of figures (standard output if not given)");
  command->add_flag("--renew", options->renew,
                    "keep the file's figures, tolerances and reasons; take new values where they "
                    "are off");
  command->callback([options, &code] { code = expect(*options); });
}

void add_stress(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "stress",
      "Solve a part on any mesh that Gmsh reads, or the load cases that a block's deck has");
  auto options = std::make_shared<StressOptions>();
  command->add_option("PART", options->part, "file of the part, or of a block with a deck")
      ->required();
  command->add_option("-o,--output", options->output,
                      "folder of the results (results/<name of the part> if not given)");
  command->add_flag("--calculix", options->calculix,
                    "write part.inp as well: the same model for CalculiX");
  command->add_option("--degree", options->degree, "degree of a deck's elements (that of its own)")
      ->check(CLI::Range(1, 4));
  add_limits(*command);
  add_allow_outside(*command);
  command->callback([options, &code] { code = stress(*options); });
}

void add_hydro(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "hydro", "Compute the hydrodynamics of floating hulls once, into a database");
  auto options = std::make_shared<HydroOptions>();
  command->add_option("VESSEL", options->vessel,
                      "file of a vessel, or of several with their places");
  command->add_option(
      "-o,--output", options->output,
      "the database (results/<name of the vessel>.h5 if not given); its report lies "
      "beside it");
  command
      ->add_option("--memory,--memory-limit", options->memory_limit,
                   "memory that may be used, GB (four fifths of the machine's if not given)")
      ->check(CLI::PositiveNumber);
  command->add_option(
      "--import", options->import,
      "take over a database: BEMIO .h5, WAMIT .1 (with .3 or .2, and .hst), Capytaine .nc, "
      "or one of blocklift's own for --export");
  command
      ->add_option("--export", options->export_format, "write what is imported as bemio or wamit")
      ->check(CLI::IsMember({"bemio", "wamit"}));
  command
      ->add_option("--wamit-length", options->wamit_length,
                   "WAMIT's ULEN, of the files that are read and of those that are written, m")
      ->check(CLI::PositiveNumber);
  command
      ->add_option(
          "--body-at", options->bodies_at,
          "where the axes of a body of WAMIT's files lie (XBODY), or what the rotations of a body "
          "of Capytaine's are about: x,y[,z[,heading]], m and degrees; of each body in their "
          "order, if there are several")
      ->allow_extra_args(false);
  command->add_option("--water-density", options->water_density, "for WAMIT's files, kg/m3")
      ->check(CLI::PositiveNumber);
  command->add_option("--gravity", options->gravity, "for WAMIT's files, m/s2")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--water-depth", options->water_depth,
                   "for WAMIT's files, m (deep if not given)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--no-cache", options->anew,
                    "compute anew: take nothing from the cache or the output's file, and put "
                    "nothing into the cache");
  add_limits(*command, false);
  add_allow_outside(*command);
  command->callback([options, &code] { code = hydro(*options); });
}

void add_sweep(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "sweep", "Run many lifts of one case, whose keys vary, and say what their figures spread to");
  auto options = std::make_shared<SweepOptions>();
  command->add_option("STUDY", options->study, "study file, or folder with a study.yaml")
      ->required();
  command->add_option("-o,--output", options->output,
                      "folder of the results (results/<name of the study> if not given); a study "
                      "that was stopped goes on there");
  command
      ->add_option("--workers", options->workers,
                   "lifts side by side (as many as the machine has processors if not given; on "
                   "several processes, of each of them: one)")
      ->check(CLI::Range(1, 4096));
  CLI::Option* part = command->add_option(
      "--part", options->part,
      "compute one part of the members alone, 3/10 say, on each of ten machines");
  CLI::Option* join =
      command
          ->add_option("--join", options->join,
                       "folder of a part that another machine computed; may be repeated")
          ->allow_extra_args(false);
  CLI::Option* slurm =
      command
          ->add_flag("--slurm{submit}", options->slurm,
                     "run the study as jobs of Slurm: write an array of parts and a job that joins "
                     "them, and submit both; --slurm=write only writes")
          ->check(CLI::IsMember({"submit", "write"}))
          ->excludes(part)
          ->excludes(join);
  command->add_option("--parts", options->parts, "tasks of Slurm's array (10 if not given)")
      ->needs(slurm)
      ->check(CLI::Range(1, 100'000));
  command
      ->add_option("--sbatch", options->sbatch,
                   "an option of both jobs, --sbatch=--partition=long say; may be repeated")
      ->needs(slurm)
      ->allow_extra_args(false);
  command->add_option("--worker", options->worker_of)->group("");
  command->add_option("--whole", options->whole)->group("");
  add_limits(*command);
  add_allow_outside(*command);
  command->callback([options, &code] { code = sweep(*options); });
}

void add_rig(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "rig",
      "Choose slings, shackles, master links, sheaves and spreaders from stock for a case, by its "
      "checks and its own loads");
  auto options = std::make_shared<RigOptions>();
  command->add_option("CASE", options->path, "case file, or folder with a case.yaml")->required();
  command->add_option("--stock", options->stock,
                      "folder with files of kind rigging (the shipped stock if not given)");
  command
      ->add_option("--construction", options->constructions,
                   "of the slings; may be repeated (of the shipped stock wire_rope and cable_laid, "
                   "of another all, if not given)")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(construction_names()));
  command->add_option("--write", options->output, "file for the case with the chosen rigging");
  add_limits(*command);
  command->callback([options, &code] { code = rig(*options); });
}

void add_report(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("report", "Make report.html again from the results in a folder");
  auto folder = std::make_shared<std::string>();
  command->add_option("RESULT", *folder, "folder with results.h5 and summary.json")->required();
  auto paraview = std::make_shared<bool>(false);
  auto frames = std::make_shared<int>(60);
  CLI::Option* with_frames =
      command->add_flag("--paraview", *paraview,
                        "write lift.pvd as well: cranes, ropes and block in time, for ParaView");
  command->add_option("--frames", *frames, "how many instants, evenly spread")
      ->needs(with_frames)
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  command->callback([=, &code] {
    code = report_results(*folder, *paraview ? std::optional<int>(*frames) : std::nullopt);
  });
}

void add_new(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "new", "Write a commented case that runs, to begin with, into a new folder");
  auto kind = std::make_shared<std::string>();
  auto folder = std::make_shared<std::string>();
  command->add_option("KIND", *kind, "what is begun")
      ->required()
      ->check(CLI::IsMember(template_kinds()));
  command->add_option("FOLDER", *folder, "the new folder; its name becomes the case's")->required();
  command->callback([kind, folder, &code] { code = write_new(*kind, *folder); });
}

void add_simulate(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "simulate", "Run the motion alone, of a mechanism file, a robot description or a lift case");
  auto options = std::make_shared<SimulateOptions>();
  command
      ->add_option("FILE", options->path,
                   "mechanism file, URDF file, case file, or a folder of one")
      ->required();
  command->add_option("-o,--output", options->output,
                      "folder of the results (results/<name> if not given)");
  command->add_flag("--csv", options->csv, "write a CSV file beside the HDF5 one");
  add_set(*command, options->set);
  add_limits(*command);
  add_no_cache(*command, options->anew);
  add_allow_outside(*command);
  command->callback([options, &code] { code = simulate_file(*options); });
}

void add_validate(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "validate", "Read a lift case or model file with all that it names, and say what is wrong");
  auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("CASE", *files, "case file, folder with a case.yaml, or model file")
      ->required();
  auto pictures = std::make_shared<std::optional<std::string>>();
  command->add_option("--pictures", *pictures,
                      "folder for a page of each block's mesh, with pictures of what was found in "
                      "it");
  auto set = std::make_shared<std::vector<std::string>>();
  add_set(*command, *set);
  add_allow_outside(*command);
  command->callback(
      [files, pictures, set, &code] { code = validate_files(*files, *pictures, *set); });
}

void add_schema(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("schema", "Print the JSON schema of the input files, for editors");
  auto manual = std::make_shared<bool>(false);
  auto kind = std::make_shared<std::string>();
  command->add_flag("--manual", *manual, "print a manual in Markdown instead, key by key");
  command->add_option("--kind", *kind, "only this kind of file; case is short for lift case")
      ->transform([](const std::string& given) { return given == "case" ? "lift case" : given; })
      ->check(CLI::IsMember(input_file_kinds()));
  command->callback(
      [manual, kind] { std::cout << (*manual ? markdown_manual(*kind) : json_schema(*kind)); });
}

void add_verify(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "verify", "Run the verification suite: each figure beside its reference, error and source");
  auto options = std::make_shared<VerifyOptions>();
  command->add_option("--only", options->only,
                      "run the cases that match: a part of stage/name, or a glob; may be repeated");
  command->add_flag("--json", options->json, "print JSON: {\"results\": [...]}");
  command->add_flag("--list", options->list, "print the cases and their sources, run none");
  command->callback([options, &code] { code = verify(*options); });
}

/// How much is said, of each command that runs or reads something; the log begins before the
/// command does.
/// @param is_silent another process has the log.
void add_log_options(CLI::App& app, LogChoice& choice, const std::vector<std::string>& arguments,
                     bool is_silent) {
  for (CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == "schema") continue;
    CLI::Option* quiet = command->add_flag(
        "-q,--quiet", choice.quiet, "print nothing but warnings, errors and verdicts; no progress");
    command
        ->add_flag("-v,--verbose", choice.verbose,
                   "say on standard error what is found, begun and done")
        ->excludes(quiet);
    command->add_option("--log", choice.file,
                        "file to which the run's steps, times, warnings and errors are appended");
    if (!is_silent) command->parse_complete_callback([&] { begin_log(choice, arguments); });
  }
}

/// Pages about the command line itself, which the installation asks for; not in the help.
void add_pages(CLI::App& app) {
  CLI::App* command = app.add_subcommand("pages", "Print the completion for bash or the man page");
  command->group("");
  auto page = std::make_shared<std::string>();
  command->add_option("PAGE", *page, "completion or man")
      ->required()
      ->check(CLI::IsMember({"completion", "man"}));
  command->callback([page, &app] {
    std::cout << (*page == "man" ? manual_page(app, std::string("blocklift ") + program_version)
                                 : bash_completion(app));
  });
}

/// Says so if the first word is meant as a command and is none.
bool is_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return false;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return false;
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  std::cerr << "blocklift: error: there is no command \"" << argv[1] << "\"\n    "
            << names_hint("the commands are", names, argv[1]) << '\n';
  return true;
}

void add_measured(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "measured", "Hold what was measured of a lift against what was computed of it");
  auto options = std::make_shared<MeasuredOptions>();
  command
      ->add_option("RESULT", options->result,
                   "folder of results, or a case that was assessed into results/")
      ->required();
  command
      ->add_option("RECORDS", options->records,
                   "CSV files, \"time [s], ropes.R1 [kN], bodies.block.roll [deg], ...\"")
      ->required()
      ->expected(1, CLI::detail::expected_max_vector_size);
  command
      ->add_option("--shift", options->shifts,
                   "seconds to add to a record's clock, one for all or one for each record; found "
                   "by correlation if not given")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--window", options->window,
                      "what is compared, FROM:TO in seconds of the lift (all if not given)");
  command->add_option("--decay", options->decay,
                      "when the load swings freely, FROM:TO: periods and damping are identified");
  command->add_option(
      "--rest", options->rest,
      "when the load hangs still, FROM:TO: weight and centre of mass are estimated");
  command
      ->add_option("--cell-accuracy", options->accuracy,
                   "standard deviation of a load cell's scale")
      ->capture_default_str();
  command->add_flag("--json", options->json, "print JSON");
  command->add_option("-o,--output", options->page,
                      "write a page as well: tables, and curves over each other");
  command->callback([options, &code] { code = show_measured(*options); });
}

/// Says so if several processes were started for a command that runs in one.
bool is_launched_in_vain(int argc, char** argv) {
  if (ProcessGroup::launched() == 1) return false;
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "stress" || command == "sweep") return false;
  if (ProcessGroup::place_among_launched() == 0)
    std::cerr << "blocklift: error: only \"blocklift stress\" and \"blocklift sweep\" run on "
                 "several processes; "
              << ProcessGroup::launched() << " were started\n";
  return true;
}

/// Of several processes with a study the first alone says something; what others meet they tell it.
bool is_silent_follower(int argc, char** argv) {
  return argc > 1 && argv[1] == std::string("sweep") && ProcessGroup::launched() > 1 &&
         ProcessGroup::place_among_launched() > 0;
}

void fall_silent() {
  for (FILE* stream : {stdout, stderr})
    if (!std::freopen("/dev/null", "w", stream)) std::fclose(stream);
}

int run(int argc, char** argv) {
  if (is_launched_in_vain(argc, argv)) return exit_code::wrong_input;
  CLI::App app{"From a lift case to the stress report of a heavy lift"};
  app.name("blocklift");
  app.set_version_flag("--version", std::string("blocklift ") + std::string(program_version));
  app.require_subcommand(1);
  int code = exit_code::done;
  add_assess(app, code);
  add_compare(app, code);
  add_expect(app, code);
  add_new(app, code);
  add_simulate(app, code);
  add_validate(app, code);
  add_stress(app, code);
  add_hydro(app, code);
  add_report(app, code);
  add_rig(app, code);
  add_sweep(app, code);
  add_measured(app, code);
  add_schema(app);
  add_verify(app, code);
  LogChoice log;
  const bool is_silent = is_silent_follower(argc, argv);
  if (is_silent) fall_silent();
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  add_log_options(app, log, arguments, is_silent);
  add_pages(app);
  if (is_unknown_command(app, argc, argv)) return exit_code::wrong_input;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_code::done : exit_code::wrong_input;
  }
  return code;
}

/// Writes out what is still held of standard output; false, and a word, if it does not arrive.
bool all_is_printed() {
  std::cout.flush();
  if (std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  std::fputs("blocklift: error: standard output cannot be written\n", stderr);
  return false;
}

/// Runs a command; what it throws is printed, entered in the log and made an exit code.
int run_and_report(int argc, char** argv) {
  try {
    const int code = run(argc, argv);
    if (!all_is_printed() && code == exit_code::done) return exit_code::run_failed;
    return code;
  } catch (const InputError& error) {
    std::fputs(error.what(), stderr);
    log_error(error.what());
    return exit_code::wrong_input;
  } catch (const LogError& error) {
    std::fprintf(stderr, "blocklift: error: %s\n", error.what());
    return exit_code::wrong_input;
  } catch (const std::bad_alloc&) {
    constexpr const char* what =
        "the memory of the machine does not suffice, or the limit that it was given; what was done "
        "so far is lost unless a message says otherwise";
    std::fprintf(stderr, "blocklift: error: %s\n", what);
    log_error(what);
    return exit_code::run_failed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "blocklift: error: %s\n", error.what());
    log_error(error.what());
    return exit_code::run_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // A file that grows beyond `ulimit -f` is an error of writing, as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  return_freed_memory();
  leave_no_files_to_hdf5();
  use_all_of_the_processor(argc, argv);
  const int code = run_and_report(argc, argv);
  end_log(code);
  return code;
}

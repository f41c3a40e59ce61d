#include "pipeline/command_line/sweep_command.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/command_line/exit_code.h"
#include "pipeline/command_line/held_signals.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/study/figure_limit.h"
#include "pipeline/study/members.h"
#include "pipeline/study/search.h"
#include "pipeline/study/study_design.h"
#include "pipeline/study/study_results.h"
#include "pipeline/terminal/progress_bar.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

StudyFile read_study(const std::string& path) {
  Diagnostics diagnostics;
  std::optional<StudyFile> study = read_study_file(path, diagnostics);
  if (!study) throw InputError(diagnostics);
  return std::move(*study);
}

fs::path folder_of(const SweepOptions& options, const StudyFile& study) {
  return options.output ? fs::path(*options.output) : fs::path("results") / study.name;
}

/// The part of the members that is computed: all of them where none is named.
StudyPart part_of(const SweepOptions& options) {
  if (!options.part) return {};
  const std::string& text = *options.part;
  const std::size_t slash = text.find('/');
  constexpr int most_parts = 100'000;
  try {
    if (slash == std::string::npos) throw QuantityError("there is no \"/\"");
    const double index = parse_number(text.substr(0, slash));
    const double of = parse_number(text.substr(slash + 1));
    if (of >= 1 && of <= most_parts && index >= 1 && index <= of && index == std::floor(index) &&
        of == std::floor(of))
      return {static_cast<int>(index) - 1, static_cast<int>(of)};
  } catch (const QuantityError&) {
    // What is due is said below, whatever the text is.
  }
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>("--part " + text), 0, 0},
                    "a part and the number of parts are due, for example 3/10");
  throw InputError(diagnostics);
}

/// The members of a part, as rows.
Eigen::MatrixXd rows_of_part(const Eigen::MatrixXd& design, const StudyPart& part) {
  const auto count = static_cast<int>(design.rows());
  Eigen::MatrixXd rows(part.size(count), design.cols());
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    rows.row(row) = design.row(part.index + row * part.of);
  return rows;
}

/// Computes members until none is left.
void work(const StudyFile& study, const fs::path& folder, const StudyPart& part) {
  const MemberStore store(folder, identity_of_study(study), part);
  StudyBlocks blocks(study, folder / "members");
  const Eigen::MatrixXd design = make_design(study);
  const auto count = static_cast<int>(design.rows());
  for (int number = store.take_next(count); number >= 0; number = store.take_next(count)) {
    const Member member = run_member(study, design.row(number), number, blocks);
    const HeldSignals until_it_is_written;
    store.write(member);
  }
}

/// Starts this program again, with one thread of its own: members run side by side.
pid_t start(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_t process = 0;
  const int error =
      ::posix_spawn(&process, "/proc/self/exe", nullptr, nullptr, pointers.data(), environ);
  if (error != 0)
    throw std::runtime_error("a worker cannot be started: " +
                             std::generic_category().message(error));
  return process;
}

/// Waits for workers; true if each ended as it should.
bool wait_for(std::vector<pid_t> processes, const std::function<void()>& meanwhile) {
  bool well = true;
  while (!processes.empty()) {
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, WNOHANG);
    if (ended > 0) {
      std::erase(processes, ended);
      well = well && WIFEXITED(status) && WEXITSTATUS(status) == exit_code::done;
      continue;
    }
    if (ended < 0 && errno != EINTR) return false;
    meanwhile();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return well;
}

std::vector<std::string> worker_arguments(const SweepOptions& options, const fs::path& folder) {
  std::vector<std::string> arguments{"blocklift",     "sweep",    options.study, "--output",
                                     folder.string(), "--worker", "--threads",   "1",
                                     "--quiet"};
  if (options.part) arguments.insert(arguments.end(), {"--part", *options.part});
  return arguments;
}

int workers_of(const SweepOptions& options) {
  return options.workers > 0 ? options.workers
                             : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Finds the unit stresses of the members' blocks, which take much memory: processes of their own
/// give it back.
void prepare_blocks(const SweepOptions& options, const fs::path& folder) {
  ProgressBar bar("unit stresses of the block");
  std::vector<pid_t> processes;
  for (int process = 0; process < workers_of(options); ++process) {
    std::vector<std::string> arguments = worker_arguments(options, folder);
    for (std::string argument : {std::string("--workers"), std::to_string(workers_of(options)),
                                 std::string("--blocks"), std::to_string(process)})
      arguments.push_back(std::move(argument));
    processes.push_back(start(std::move(arguments)));
  }
  if (!wait_for(std::move(processes), [&] { bar.show(0); }))
    throw std::runtime_error("the stress of the case as it is written could not be found");
}

/// Runs what is missing. A worker that is lost leaves its member to the next round.
void run_members(const SweepOptions& options, const fs::path& folder, const MemberStore& store,
                 int count) {
  constexpr int most_rounds = 3;
  const int asked = workers_of(options);
  ProgressBar bar("members");
  for (int round = 0; round < most_rounds; ++round) {
    const int missing = store.count_all(count) - store.count_done(count);
    if (missing == 0) return;
    store.begin();
    std::vector<pid_t> workers;
    for (int w = 0; w < std::min(asked, missing); ++w)
      workers.push_back(start(worker_arguments(options, folder)));
    wait_for(std::move(workers), [&] {
      const int done = store.count_done(count);
      const int all = store.count_all(count);
      bar.show(static_cast<double>(done) / all, fmt::format("{} of {}", done, all));
    });
  }
  if (store.count_done(count) < store.count_all(count))
    throw std::runtime_error("workers of the study ended before their members were done");
}

std::vector<Member> read_members(const MemberStore& store, int count) {
  std::vector<Member> members;
  for (int number = 0; number < count; ++number)
    members.push_back(store.read(number).value_or(Member{number, "is missing", {}, {}}));
  return members;
}

/// The member with the worst of the first leading figure, with a report of its own.
std::optional<int> write_worst(const SweepOptions& options, const fs::path& folder,
                               const StudyResults& results) {
  if (results.leading.empty()) return std::nullopt;
  const int worst = results.spreads[results.leading.front()].member_of_worst();
  std::vector<std::string> arguments = worker_arguments(options, folder);
  arguments.push_back("--whole");
  arguments.push_back(std::to_string(worst));
  ProgressBar bar("the worst member's report");
  const bool well = wait_for({start(std::move(arguments))}, [&] { bar.show(0); });
  return well ? std::optional<int>(worst) : std::nullopt;
}

void warn_of_failures(const StudyResults& results) {
  for (const Member& member : results.members)
    if (!member.failure.empty())
      say_warning(fmt::format("member {} failed: {}", member.number, member.failure));
}

void print_study(const StudyResults& results, const fs::path& folder, std::optional<int> worst) {
  warn_of_failures(results);
  if (is_quiet()) return;
  const StudyFile& study = results.study;
  fmt::print("{}\n\n{}", study.title.empty() ? study.name : study.title, study_text(results));
  fmt::print("\n{} members, {} failed\n", results.members.size(), results.failed());
  if (worst)
    print_wrapped(fmt::format("member {} has the worst {}: {}", *worst,
                              results.spreads[results.leading.front()].path,
                              (folder / "worst" / "report.html").string()));
  fmt::print("page: {}\n", (folder / "study.html").string());
}

/// Members of a search follow from those before them.
[[noreturn]] void refuse_parts_of_search(const StudyFile& study) {
  Diagnostics diagnostics;
  diagnostics.error(study.place,
                    "a search has no parts: each of its members follows from those before");
  throw InputError(diagnostics);
}

void take_over_parts(const SweepOptions& options, const MemberStore& store) {
  for (const std::string& folder : options.join) {
    const int taken = store.take_over(folder);
    if (!is_quiet()) fmt::print("{}: {} members taken over\n", folder, taken);
  }
}

void print_part(const SweepOptions& options, const fs::path& folder, const MemberStore& store,
                int count) {
  if (is_quiet()) return;
  print_wrapped(fmt::format(
      "part {}: its {} of {} members are in {}; \"blocklift sweep {} --join "
      "FOLDER ...\" makes the study of all parts",
      *options.part, store.count_all(count), count, (folder / "members").string(), options.study));
}

/// A member of a search: what a run before it computed is taken.
Member member_of_search(const StudyFile& study, const MemberStore& store, StudyBlocks& blocks,
                        const Eigen::VectorXd& values, int number) {
  if (std::optional<Member> known = store.read(number)) return std::move(*known);
  Member member = number == 0 ? run_first_member(study, values, blocks)
                              : run_member(study, values, number, blocks);
  const HeldSignals until_it_is_written;
  store.write(member);
  return member;
}

/// Removes what a study has put into a folder so far, and the folder if there is nothing else.
void remove_new_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder / "members", ignored);
  if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

/// Runs the sample side by side, then the search, a member after another.
SearchResults run_search(const SweepOptions& options, const fs::path& folder,
                         const StudyFile& study, const Eigen::MatrixXd& sample,
                         const MemberStore& store) {
  StudyBlocks blocks(study, folder / "members");
  // Before all others: it tells whether the lift has the figures. Where it has not, nothing is left.
  const bool is_new = store.count_done(static_cast<int>(sample.rows())) == 0;
  try {
    check_figure_limits(study, {member_of_search(study, store, blocks, sample.row(0), 0)});
  } catch (const InputError&) {
    if (is_new) remove_new_folder(folder);
    throw;
  }
  const auto count = static_cast<int>(sample.rows());
  run_members(options, folder, store, count);
  ProgressBar bar("search");
  return search_members(study, sample, read_members(store, count),
                        [&](const Eigen::VectorXd& values, int number) {
                          bar.show(static_cast<double>(number) / study.members,
                                   fmt::format("member {} of {} at most", number, study.members));
                          return member_of_search(study, store, blocks, values, number);
                        });
}

/// All results of a search, its page and the report of its best member.
int search(const SweepOptions& options, const fs::path& folder, StudyFile study,
           const Eigen::MatrixXd& sample) {
  const MemberStore store(folder, identity_of_study(study));
  SearchResults found = run_search(options, folder, study, sample, store);
  const StudyResults results = evaluate_search(std::move(study), std::move(found));
  {
    const HeldSignals until_all_is_in_place;
    write_study(results, folder);
  }
  const int best = results.search->best;
  StudyBlocks blocks(results.study, folder / "members");
  const Member whole =
      run_member(results.study, results.design.row(best), best, blocks, folder / "best");
  warn_of_failures(results);
  if (!is_quiet()) {
    fmt::print("{}\n\n{}", results.study.title.empty() ? results.study.name : results.study.title,
               search_text(results));
    fmt::print("\n{} members, {} failed\n", results.members.size(), results.failed());
    fmt::print("page: {}\n", (folder / "study.html").string());
  }
  if (!whole.failure.empty())
    throw std::runtime_error(fmt::format(
        "the report of member {}, the best, could not be written: {}", best, whole.failure));
  return results.search->is_feasible ? exit_code::done : exit_code::lift_fails;
}

}  // namespace

int sweep(const SweepOptions& options) {
  StudyFile study = read_study(options.study);
  const fs::path folder = folder_of(options, study);
  if (options.whole) {
    const Eigen::MatrixXd design = make_design(study);
    StudyBlocks blocks(study, folder / "members");
    const Member member =
        run_member(study, design.row(*options.whole), *options.whole, blocks, folder / "worst");
    return member.failure.empty() ? exit_code::done : exit_code::run_failed;
  }
  if (options.blocks) {
    StudyBlocks(study, folder / "members")
        .prepare(rows_of_part(make_design(study), part_of(options)), *options.blocks,
                 std::max(1, options.workers));
    return exit_code::done;
  }
  if (options.is_worker) {
    work(study, folder, part_of(options));
    return exit_code::done;
  }
  const StudyPart part = part_of(options);
  if (study.design == StudyDesign::search && (options.part || !options.join.empty()))
    refuse_parts_of_search(study);
  check_figure_limits(study);
  require_writable(folder);
  if (study.limits && study.limits->scatter)
    read_sea_states(study.beside(study.limits->scatter->value), false);
  if (study.limits && study.limits->forecast)
    read_sea_states(study.beside(study.limits->forecast->value), true);
  Eigen::MatrixXd design = make_design(study);
  {
    ProgressBar bar("reading members");
    check_members(study, design, [&](double fraction) { bar.show(fraction); });
  }
  if (study.design == StudyDesign::search) return search(options, folder, std::move(study), design);
  const MemberStore store(folder, identity_of_study(study), part);
  const auto count = static_cast<int>(design.rows());
  take_over_parts(options, store);
  if (study.run == StudyRun::stress && store.count_done(count) < store.count_all(count))
    prepare_blocks(options, folder);
  run_members(options, folder, store, count);
  if (options.part) {
    print_part(options, folder, store, count);
    return exit_code::done;
  }
  const StudyResults results =
      evaluate_study(std::move(study), std::move(design), read_members(store, count));
  {
    const HeldSignals until_all_is_in_place;
    write_study(results, folder);
  }
  const std::optional<int> worst = write_worst(options, folder, results);
  print_study(results, folder, worst);
  if (worst || results.leading.empty()) return exit_code::done;
  throw std::runtime_error(fmt::format(
      "the report of member {}, the worst, could not be written; all else of the study is",
      results.spreads[results.leading.front()].member_of_worst()));
}

}  // namespace blocklift::pipeline

#include "pipeline/command_line/sweep_command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/command_line/freed_memory.h"
#include "pipeline/command_line/held_signals.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/processes/lost_processes.h"
#include "pipeline/processes/slurm_jobs.h"
#include "pipeline/processes/sweep_team.h"
#include "pipeline/processes/worker_process.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/members/members.h"
#include "pipeline/study/pages/search_page.h"
#include "pipeline/study/pages/study_files.h"
#include "pipeline/study/pages/study_text.h"
#include "pipeline/study/results/study_results.h"
#include "pipeline/study/run/study_lock.h"
#include "pipeline/study/run/study_run.h"
#include "pipeline/terminal/progress_bar.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"
#include "structure/process_group.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

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

/// Answers orders until there are no more. Where study, case or program are not those of the
/// process that gives them, every order is refused.
void work(const SweepOptions& options, const StudyFile& study, const fs::path& folder) {
  const bool is_the_study = identity_of_study(study) == *options.worker_of;
  const Eigen::MatrixXd design = make_design(study);
  fs::create_directories(folder / "members");
  StudyBlocks blocks(study, folder / "members");
  bool is_first = true;
  answer_orders([&](const WorkOrder& order) -> std::string {
    if (!is_the_study)
      throw std::invalid_argument(
          "its study, case or version of the program is another than that of the first process");
    if (order.kind == WorkOrder::Kind::member) {
      std::string text =
          text_of_member(run_member(study, design.row(order.number), order.number, blocks));
      // Of making the block more was needed than is kept of it.
      if (std::exchange(is_first, false)) return_what_is_free();
      return text;
    }
    blocks.prepare(rows_of_part(design, part_of(options)), order.number, order.of);
    return {};
  });
}

std::vector<std::string> arguments_of_process(const SweepOptions& options, const fs::path& folder) {
  std::vector<std::string> arguments{"blocklift",     "sweep",     options.study, "--output",
                                     folder.string(), "--threads", "1",           "--quiet"};
  if (options.part) arguments.insert(arguments.end(), {"--part", *options.part});
  return arguments;
}

/// The other processes that a launcher has started with this one; null: there are none.
const structure::ProcessGroup* launched_group() {
  return structure::ProcessGroup::launched() > 1 ? &join_launched_processes() : nullptr;
}

/// Workers of this process: one on each processor, or one of each process of several.
int workers_of(const SweepOptions& options) {
  if (options.workers > 0) return options.workers;
  if (structure::ProcessGroup::launched() > 1) return 1;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Finds the unit stresses of the members' blocks.
void prepare_blocks(SweepTeam& team) {
  ProgressBar bar("unit stresses of the block");
  std::vector<WorkOrder> orders;
  for (int first = 0; first < team.size(); ++first)
    orders.push_back({WorkOrder::Kind::blocks, first, team.size()});
  const auto nothing_to_take = [](int, const std::string&) {};
  if (!team.run(orders, nothing_to_take, [&] { bar.show(0); }))
    throw std::runtime_error("the stress of the case as it is written could not be found");
}

/// Runs what is missing.
void run_members(const SweepOptions& options, const StudyFile& study, const fs::path& folder,
                 const MemberStore& store, int count) {
  const std::vector<int> missing = store.find_missing(count);
  if (missing.empty()) return;
  std::vector<std::string> arguments = arguments_of_process(options, folder);
  arguments.insert(arguments.end(), {"--worker", identity_of_study(study)});
  const structure::ProcessGroup* group = launched_group();
  const int workers = workers_of(options);
  SweepTeam team(group, std::move(arguments),
                 group ? workers : std::min(workers, static_cast<int>(missing.size())));
  if (study.run == StudyRun::stress) prepare_blocks(team);
  ProgressBar bar("members");
  std::vector<WorkOrder> orders;
  for (const int number : missing) orders.push_back({WorkOrder::Kind::member, number, 1});
  const int all = store.count_all(count);
  int done = all - static_cast<int>(missing.size());
  bool are_figures_known = done > 0;
  const auto take = [&](int order, const std::string& text) {
    const Member member = member_of_text(missing[order], text);
    if (!are_figures_known && member.failure.empty()) {
      require_figures(study, member);
      are_figures_known = true;
    }
    const HeldSignals until_it_is_written;
    store.write(member);
    ++done;
  };
  if (!team.run(orders, take, [&] {
        bar.show(static_cast<double>(done) / all, fmt::format("{} of {}", done, all));
      }))
    throw std::runtime_error("workers of the study ended before their members were done");
}

/// The whole results of a member, in a process of its own: this one holds much by now.
bool write_whole(const SweepOptions& options, const fs::path& folder, int member) {
  std::vector<std::string> arguments = arguments_of_process(options, folder);
  arguments.insert(arguments.end(), {"--whole", std::to_string(member)});
  ProgressBar bar("the worst member's report");
  return run_this_program(std::move(arguments), [&] { bar.show(0); });
}

void print_count(const StudyResults& results) {
  fmt::print("\n{} member{}, {} failed\n", results.members.size(),
             results.members.size() == 1 ? "" : "s", results.failed());
}

void print_study(const StudyResults& results, const fs::path& folder, std::optional<int> worst) {
  for (const std::string& warning : study_warnings(results)) say_warning(warning);
  if (is_quiet()) return;
  const StudyFile& study = results.study;
  fmt::print("{}\n\n{}", study.title.empty() ? study.name : study.title, study_text(results));
  print_count(results);
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

/// Workers of this program side by side, and a search in this process.
/// @param most members of a search.
StudyCrew crew_of(const SweepOptions& options, const fs::path& folder, int most) {
  // It appears with the first member of the search: the workers have one of their own.
  const auto bar = std::make_shared<std::unique_ptr<ProgressBar>>();
  return {.compute_missing =
              [&options, folder](const StudyFile& study, const Eigen::MatrixXd& design,
                                 const MemberStore& store) {
                run_members(options, study, folder, store, static_cast<int>(design.rows()));
              },
          .write =
              [](const MemberStore& store, const Member& member) {
                const HeldSignals until_it_is_written;
                store.write(member);
              },
          .begin_of_search_member =
              [bar, most](int number) {
                if (!*bar) *bar = std::make_unique<ProgressBar>("search");
                (*bar)->show(static_cast<double>(number) / most,
                             fmt::format("member {} of {} at most", number, most));
              }};
}

/// A search, its page and the report of its best member.
int search(const SweepOptions& options, const fs::path& folder, StudyFile study,
           Eigen::MatrixXd sample) {
  const StudyLock until_it_ends(folder, StudyLock::Use::whole);
  const MemberStore store(folder, identity_of_study(study));
  const int most = study.members.value();
  const StudyResults results =
      run_study(std::move(study), std::move(sample), folder, store, crew_of(options, folder, most));
  {
    const HeldSignals until_all_is_in_place;
    write_study(results, folder);
  }
  const ShownMember best = *shown_member(results, folder);
  StudyBlocks blocks(results.study, folder / "members");
  const Member whole =
      run_member(results.study, results.design.row(best.number), best.number, blocks, best.folder);
  for (const std::string& warning : study_warnings(results)) say_warning(warning);
  if (!is_quiet()) {
    fmt::print("{}\n\n{}", results.study.title.empty() ? results.study.name : results.study.title,
               search_text(results));
    print_count(results);
    fmt::print("page: {}\n", (folder / "study.html").string());
  }
  if (!whole.failure.empty())
    throw std::runtime_error(fmt::format(
        "the report of member {}, the best, could not be written: {}", best.number, whole.failure));
  return results.search->is_feasible ? exit_code::done : exit_code::lift_fails;
}

void check_slurm_options(const SweepOptions& options) {
  const auto refuse = [](const std::string& what, std::string message) {
    Diagnostics diagnostics;
    diagnostics.error({std::make_shared<const std::string>(what), 0, 0}, std::move(message));
    throw InputError(diagnostics);
  };
  if (launched_group())
    refuse("--slurm", "jobs are submitted by one process, and several were started");
  for (const std::string& option : options.sbatch)
    if (!option.starts_with('-') || option.find('\n') != std::string::npos)
      refuse("--sbatch " + option, "an option of sbatch is due, for example --partition=long");
}

/// Hands the study to Slurm, once all its members are found possible.
int run_as_jobs(const SweepOptions& options, const fs::path& folder, const StudyFile& study,
                int count) {
  constexpr int usual_parts = 10;
  const int parts = std::min(count, options.parts > 0 ? options.parts : usual_parts);
  const fs::path script = write_slurm_jobs(
      {options.study, study.name, folder, parts, std::max(1, options.workers), options.sbatch});
  const bool is_to_submit = *options.slurm == "submit";
  if (is_to_submit && is_slurm_here()) {
    submit_slurm_jobs(script);
    return exit_code::done;
  }
  if (!is_quiet())
    print_wrapped(fmt::format("{}\"sh {}\" submits {} parts and a job that joins them",
                              is_to_submit ? "there is no sbatch here; " : "", script.string(),
                              parts));
  return exit_code::done;
}

int sweep_alone_or_first(const SweepOptions& options) {
  StudyFile study = read_study(options.study);
  const fs::path folder = folder_of(options, study);
  if (options.whole) {
    const Eigen::MatrixXd design = make_design(study);
    StudyBlocks blocks(study, folder / "members");
    const Member member =
        run_member(study, design.row(*options.whole), *options.whole, blocks, folder / "worst");
    if (!member.failure.empty()) throw std::runtime_error(member.failure);
    return exit_code::done;
  }
  if (options.worker_of) {
    work(options, study, folder);
    return exit_code::done;
  }
  const StudyPart part = part_of(options);
  if (options.slurm) check_slurm_options(options);
  if (study.design == StudyDesign::search &&
      (options.part || !options.join.empty() || options.slurm))
    refuse_parts_of_search(study);
  require_writable(folder);
  Eigen::MatrixXd design = [&] {
    ProgressBar bar("reading members");
    return plan_members(study, [&](double fraction) { bar.show(fraction); });
  }();
  if (study.design == StudyDesign::search)
    return search(options, folder, std::move(study), std::move(design));
  const auto count = static_cast<int>(design.rows());
  if (options.slurm) return run_as_jobs(options, folder, study, count);
  const StudyLock until_it_ends(folder,
                                options.part ? StudyLock::Use::part : StudyLock::Use::whole);
  const MemberStore store(folder, identity_of_study(study), part);
  take_over_parts(options, store);
  if (options.part) {
    run_members(options, study, folder, store, count);
    print_part(options, folder, store, count);
    return exit_code::done;
  }
  const StudyResults results = run_study(std::move(study), std::move(design), folder, store,
                                         crew_of(options, folder, count));
  {
    const HeldSignals until_all_is_in_place;
    write_study(results, folder);
  }
  const std::optional<ShownMember> worst = shown_member(results, folder);
  const bool is_written = worst && write_whole(options, folder, worst->number);
  print_study(results, folder, is_written ? std::optional<int>(worst->number) : std::nullopt);
  if (is_written || !worst)
    return failure_of_run(results).empty() ? exit_code::done : exit_code::run_failed;
  throw std::runtime_error(fmt::format(
      "the report of member {}, the worst, could not be written; all else of the study is",
      worst->number));
}

}  // namespace

int sweep(const SweepOptions& options) {
  const structure::ProcessGroup* group = launched_group();
  if (!group) return sweep_alone_or_first(options);
  if (!group->leads()) {
    if (follow_sweep_teams(*group)) return exit_code::done;
    structure::ProcessGroup::abort();
  }
  struct OthersLeave {
    const structure::ProcessGroup& group;
    ~OthersLeave() { let_followers_leave(group); }
  };
  const OthersLeave whatever_happens{*group};
  return sweep_alone_or_first(options);
}

}  // namespace blocklift::pipeline

#include "pipeline/study/run/study_run.h"

#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/files/lift_case/own_laws.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/limits/figure_limit.h"
#include "pipeline/study/limits/limiting_sea.h"
#include "pipeline/study/members/member_cases.h"
#include "pipeline/study/members/study_blocks.h"
#include "pipeline/study/search/search.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

std::vector<Member> read_members(const MemberStore& store, int count) {
  std::vector<Member> members;
  for (int number = 0; number < count; ++number)
    members.push_back(store.read(number).value_or(Member{number, "is missing", {}, {}}));
  return members;
}

/// Removes what a study has put into a folder so far, and the folder if there is nothing else.
void remove_new_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder / "members", ignored);
  if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

/// What the first member tells to be wrong with the study leaves no folder behind.
void compute_or_leave_nothing(const StudyFile& study, const Eigen::MatrixXd& design,
                              const fs::path& folder, const MemberStore& store,
                              const StudyCrew& crew) {
  const bool is_new = store.count_done(static_cast<int>(design.rows())) == 0;
  try {
    crew.compute_missing(study, design, store);
  } catch (const InputError&) {
    if (is_new) remove_new_folder(folder);
    throw;
  }
}

/// Runs the sample as the crew does, then the search, a member after another.
SearchResults run_search(const StudyFile& study, const Eigen::MatrixXd& sample,
                         const fs::path& folder, const MemberStore& store, const StudyCrew& crew) {
  StudyBlocks blocks(study, folder / "members", crew.progress);
  // What a run before this one computed is taken.
  const auto evaluate = [&](const Eigen::VectorXd& values, int number) {
    if (std::optional<Member> known = store.read(number)) return std::move(*known);
    Member member = number == 0 ? run_first_member(study, values, blocks)
                                : run_member(study, values, number, blocks);
    crew.write(store, member);
    return member;
  };
  // Before all others: it tells whether the lift has the figures. Where it has not, nothing is
  // left.
  const auto count = static_cast<int>(sample.rows());
  const bool is_new = store.count_done(count) == 0;
  try {
    check_figure_limits(study, {evaluate(sample.row(0), 0)});
  } catch (const InputError&) {
    if (is_new) remove_new_folder(folder);
    throw;
  }
  crew.compute_missing(study, sample, store);
  return search_members(study, sample, read_members(store, count),
                        [&](const Eigen::VectorXd& values, int number) {
                          crew.begin_of_search_member(number);
                          return evaluate(values, number);
                        });
}

}  // namespace

StudyFile read_study(const fs::path& path) {
  Diagnostics diagnostics;
  std::optional<StudyFile> study = read_study_file(path, diagnostics);
  if (!study) throw InputError(diagnostics);
  return std::move(*study);
}

Eigen::MatrixXd plan_members(const StudyFile& study,
                             const std::function<void(double fraction)>& progress) {
  check_figure_limits(study);
  if (study.limits) read_alpha_factor(study);
  if (study.limits && study.limits->scatter)
    read_sea_states(study.beside(study.limits->scatter->value), false, varies_heading(study));
  if (study.limits && study.limits->forecast)
    read_sea_states(study.beside(study.limits->forecast->value), true, varies_heading(study));
  Eigen::MatrixXd design = make_design(study);
  check_members(study, design, progress);
  const LiftCase first = MemberCases(study).of(design.row(0));
  Diagnostics diagnostics;
  check_laws(study.laws, first.operation, first.file, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return design;
}

StudyResults run_study(StudyFile study, Eigen::MatrixXd design, const fs::path& folder,
                       const MemberStore& store, const StudyCrew& crew) {
  if (study.design == StudyDesign::search) {
    SearchResults found = run_search(study, design, folder, store, crew);
    return evaluate_search(std::move(study), std::move(found));
  }
  compute_or_leave_nothing(study, design, folder, store, crew);
  std::vector<Member> members = read_members(store, static_cast<int>(design.rows()));
  return evaluate_study(std::move(study), std::move(design), std::move(members));
}

void compute_one_by_one(const StudyFile& study, const Eigen::MatrixXd& design,
                        const fs::path& folder, const MemberStore& store,
                        const Progress& progress) {
  StudyBlocks blocks(study, folder / "members", progress);
  const auto count = static_cast<int>(design.rows());
  const std::vector<int> missing = store.find_missing(count);
  int done = count - static_cast<int>(missing.size());
  bool are_figures_known = done > 0;
  for (const int number : missing) {
    progress("members", static_cast<double>(done) / count, fmt::format("{} of {}", done, count));
    const Member member = run_member(study, design.row(number), number, blocks);
    if (!are_figures_known && member.failure.empty()) {
      require_figures(study, member);
      are_figures_known = true;
    }
    store.write(member);
    ++done;
  }
}

std::optional<ShownMember> shown_member(const StudyResults& results, const fs::path& folder) {
  if (results.search) return ShownMember{results.search->best, folder / "best"};
  if (results.leading.empty()) return std::nullopt;
  return ShownMember{results.spreads[results.leading.front()].member_of_worst(), folder / "worst"};
}

}  // namespace blocklift::pipeline

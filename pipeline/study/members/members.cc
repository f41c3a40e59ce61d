#include "pipeline/study/members/members.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pipeline/assessment/assess.h"
#include "pipeline/comparison/summary_figures.h"
#include "pipeline/files/lift_case/input_hash.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/formats/content_hash.h"
#include "pipeline/formats/results/run_identity.h"
#include "pipeline/measures/measure.h"
#include "pipeline/report/input_values.h"
#include "pipeline/results/summaries/summary.h"
#include "pipeline/simulation/lift_simulation.h"
#include "pipeline/study/design/block_variables.h"
#include "pipeline/study/members/asked_figures.h"
#include "pipeline/study/members/member_cases.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* identity_file = "identity";

/// The figures that are looked at, of a summary.
std::vector<std::pair<std::string, double>> figures_of(const StudyFile& study,
                                                       const Json& summary) {
  std::vector<std::pair<std::string, double>> figures;
  const auto take = [&](const std::string& path) {
    const Json* value = find_figure(summary, path);
    const bool is_known = std::any_of(figures.begin(), figures.end(),
                                      [&](const auto& figure) { return figure.first == path; });
    if (!value || !value->is_number() || is_known) return;
    // What is not a number its file does not have either.
    const double figure = value->get<double>();
    if (std::isfinite(figure)) figures.emplace_back(path, figure);
  };
  for (const Located<std::string>* path : figures_of_search(study)) take(path->value);
  for (const Located<std::string>& path : study.figures) take(path.value);
  if (study.figures.empty())
    for (const SummaryFigure& figure : list_figures(summary)) take(figure.path);
  return figures;
}

std::vector<std::string> names_of_figures(const Json& summary) {
  std::vector<std::string> names;
  for (const SummaryFigure& figure : list_figures(summary)) names.push_back(figure.path);
  return names;
}

bool has_figure(const Json& summary, const std::string& path) {
  const Json* value = find_figure(summary, path);
  return value && value->is_number();
}

/// Takes the figures of a summary that are looked at into a member.
void take_figures(const StudyFile& study, const Json& summary, Member& member) {
  member.figures = figures_of(study, summary);
  for (const Located<std::string>& path : study.figures)
    if (!has_figure(summary, path.value))
      member.unknown.emplace_back(path.value, nearest_name(path.value, names_of_figures(summary)));
  for (const auto& [path, value] : member.figures)
    if (is_worse_when_smaller(summary, path)) member.worse_when_smaller.push_back(path);
  for (const auto& [path, value] : member.figures)
    if (unit_of_path(path).empty())
      if (std::string unit = unit_of_figure(summary, path); !unit.empty())
        member.units.emplace_back(path, std::move(unit));
}

/// The part of a summary's structure that a study of stress has, at an assessment's places.
Json stress_json(const LargestChecked& largest) {
  const auto state = [](double stress, double time, const structure::Vector3& place) {
    return Json{{"checked_von_mises_Pa", stress},
                {"time_s", time},
                {"checked_point_m", {place.x(), place.y(), place.z()}}};
  };
  return {{"history",
           {{"static", state(largest.at_rest, largest.time_at_rest, largest.place_at_rest)},
            {"dynamic", state(largest.in_motion, largest.time_in_motion, largest.place_in_motion)},
            {"stress_increase_percent", largest.increase_percent()}}}};
}

/// What a member that ran has of what is asked.
Json figures_of_run(const StudyFile& study, const AskedFigures& asked,
                    const LiftSimulation& simulation, const Eigen::VectorXd& values,
                    StudyBlocks& blocks) {
  // Measures cost as much as a third of a motion.
  const std::vector<LiftMeasure> measures =
      asked.is_in("measures") ? find_measures(simulation.lift_case, simulation.run)
                              : std::vector<LiftMeasure>{};
  Json figures = make_simulation_figures(
      simulation.lift_case, simulation.run, measures,
      [&](std::string_view part) { return asked.is_among_all() || asked.is_in(part); });
  if (study.run == StudyRun::stress && asked.is_in("structure"))
    figures["structure"] =
        stress_json(blocks.find_stress(simulation.lift_case, simulation.run, values));
  return figures;
}

/// Runs a member as far as figures are asked for.
/// @param full where its whole results go, if all is asked for; null: nowhere.
Json run_as_far(const StudyFile& study, const AskedFigures& asked, const Eigen::VectorXd& values,
                StudyBlocks& blocks, const std::optional<fs::path>& full) {
  LiftCase lift_case = blocks.cases().of(values);
  const Progress& progress = blocks.progress();
  std::optional<KnownBlock> block;
  if (lift_case.has_structure()) block = blocks.of(lift_case, values);
  const LiftSimulation simulation =
      block ? simulate_lift(std::move(lift_case), std::move(*block), progress, asked.extent())
            : simulate_lift(std::move(lift_case), progress, asked.extent());
  if (full) write_lift_simulation(simulation, *full, false);
  return figures_of_run(study, asked, simulation, values, blocks);
}

Json summary_of(const StudyFile& study, const Eigen::VectorXd& values, StudyBlocks& blocks,
                const std::optional<fs::path>& full) {
  if (study.run == StudyRun::assess || (full && study.run == StudyRun::stress)) {
    const Assessment assessment = assess(blocks.cases().of(values), blocks.progress());
    if (full) write_results(assessment, *full);
    return make_summary(assessment);
  }
  const AskedFigures asked(study);
  if (full) return run_as_far(study, asked.among_all(), values, blocks, full);
  Json figures = run_as_far(study, asked, values, blocks, full);
  const bool has_all = std::ranges::all_of(
      asked.paths(), [&](const std::string& path) { return has_figure(figures, path); });
  if (has_all || asked.is_among_all()) return figures;
  // A figure that is missing is looked for, and its nearest name, among all that there are.
  return run_as_far(study, asked.among_all(), values, blocks, full);
}

}  // namespace

double Member::figure(const std::string& path) const {
  for (const auto& [name, value] : figures)
    if (name == path) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string Member::unit(const std::string& path) const {
  for (const auto& [name, unit] : units)
    if (name == path) return unit;
  return std::string(unit_of_path(path));
}

std::string text_of_member(const Member& member) {
  Json figures = Json::object();
  for (const auto& [path, value] : member.figures) figures[path] = value;
  Json json{{"member", member.number}, {"figures", std::move(figures)}};
  if (!member.worse_when_smaller.empty()) json["worse_when_smaller"] = member.worse_when_smaller;
  if (!member.failure.empty()) json["failure"] = member.failure;
  for (const auto& [path, unit] : member.units) json["units"][path] = unit;
  for (const auto& [path, nearest] : member.unknown) json["unknown"][path] = nearest;
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

Member member_of_text(int number, const std::string& text) {
  const Json json = Json::parse(text);
  Member member{number, json.value("failure", std::string()), {}, {}};
  member.worse_when_smaller = json.value("worse_when_smaller", std::vector<std::string>());
  for (const auto& [path, value] : json.at("figures").items())
    if (value.is_number()) member.figures.emplace_back(path, value.get<double>());
  const Json units = json.value("units", Json::object());
  for (const auto& [path, unit] : units.items())
    member.units.emplace_back(path, unit.get<std::string>());
  const Json unknown = json.value("unknown", Json::object());
  for (const auto& [path, nearest] : unknown.items())
    member.unknown.emplace_back(path, nearest.get<std::string>());
  return member;
}

namespace {

/// The members of a study, those that have the same block one after another.
std::vector<Eigen::Index> in_order_of_blocks(const StudyFile& study, const Eigen::MatrixXd& design,
                                             const std::string& block) {
  const std::vector<int> changing = find_block_variables(study, block);
  std::vector<std::string> keys;
  std::vector<Eigen::Index> order;
  for (Eigen::Index member = 0; member < design.rows(); ++member) {
    keys.push_back(block_key(study, changing, design.row(member)));
    order.push_back(member);
  }
  std::ranges::stable_sort(order, {},
                           [&](Eigen::Index member) -> const std::string& { return keys[member]; });
  return order;
}

}  // namespace

void check_members(const StudyFile& study, const Eigen::MatrixXd& design,
                   const std::function<void(double fraction)>& progress) {
  MemberCases cases(study);
  cases.hold_block_masses();
  const std::string block = cases.of(design.row(0)).load.model_name.value;
  double read = 0;
  for (const Eigen::Index member : in_order_of_blocks(study, design, block)) {
    progress(read++ / static_cast<double>(design.rows()));
    const LiftCase lift_case = cases.of(design.row(member));
    Diagnostics diagnostics;
    if (lift_case.load_table)
      diagnostics.error(study.case_name.mark,
                        "the case is a load table: it has nothing that moves");
    else if (study.run == StudyRun::stress && !lift_case.has_structure())
      diagnostics.error(study.case_name.mark, "the case lifts a vessel: its stress is not known");
    else if (study.run == StudyRun::stress && lift_case.load.vessel)
      diagnostics.error(study.case_name.mark,
                        "water presses on the case's block: its stress needs run: assess");
    if (diagnostics.has_errors()) throw InputError(diagnostics);
  }
}

Member run_member(const StudyFile& study, const Eigen::VectorXd& values, int number,
                  StudyBlocks& blocks, const std::optional<fs::path>& full) {
  Member member{number, {}, {}, {}};
  try {
    take_figures(study, summary_of(study, values, blocks, full), member);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    member.failure = error.what();
  }
  return member;
}

namespace {

void miss_figure(const Mark& mark, const std::string& path, const std::string& nearest,
                 Diagnostics& diagnostics) {
  std::vector<std::string> hints;
  if (!nearest.empty()) hints.push_back(fmt::format("did you mean \"{}\"?", nearest));
  diagnostics.error(mark, fmt::format("the lift's summary has no figure \"{}\"", path),
                    std::move(hints));
}

}  // namespace

void require_figures(const StudyFile& study, const Member& member) {
  Diagnostics diagnostics;
  for (const auto& [path, nearest] : member.unknown)
    for (const Located<std::string>& asked : study.figures)
      if (asked.value == path) miss_figure(asked.mark, path, nearest, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
}

Member run_first_member(const StudyFile& study, const Eigen::VectorXd& values,
                        StudyBlocks& blocks) {
  Json summary;
  try {
    summary = summary_of(study, values, blocks, std::nullopt);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return {0, error.what(), {}, {}};
  }
  Diagnostics diagnostics;
  for (const Located<std::string>* path : figures_of_search(study))
    if (!has_figure(summary, path->value))
      miss_figure(path->mark, path->value, nearest_name(path->value, names_of_figures(summary)),
                  diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  Member member{0, {}, {}, {}};
  take_figures(study, summary, member);
  require_figures(study, member);
  return member;
}

namespace {

[[noreturn]] void refuse_folder(const fs::path& folder, std::string message,
                                std::vector<std::string> hints) {
  Diagnostics diagnostics;
  diagnostics.error({std::make_shared<const std::string>(folder.string()), 0, 0},
                    std::move(message), std::move(hints));
  throw InputError(diagnostics);
}

constexpr const char* other_study =
    "the folder holds members of another study, or of this one as it was before";

}  // namespace

MemberStore::MemberStore(const fs::path& folder, const std::string& identity, StudyPart part)
    : folder_(folder / "members"), identity_(identity), part_(part) {
  fs::create_directories(folder_);
  const fs::path known = folder_ / identity_file;
  std::error_code ignored;
  if (!fs::exists(known, ignored)) {
    write_file(known, identity);
    return;
  }
  if (read_file(known) == identity) return;
  refuse_folder(folder, other_study, {"name another folder with --output, or remove this one"});
}

int MemberStore::take_over(const fs::path& folder) const {
  const fs::path theirs = folder / "members";
  std::error_code ignored;
  if (!fs::exists(theirs / identity_file, ignored))
    refuse_folder(folder, "the folder holds no members of a study",
                  {"\"blocklift sweep STUDY --part 1/2 --output FOLDER\" computes some"});
  if (read_file(theirs / identity_file) != identity_)
    refuse_folder(folder, other_study,
                  {"all parts need the same study, case and version of the program"});
  int taken = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(theirs)) {
    const fs::path name = entry.path().filename();
    if (name.extension() != ".json" || fs::exists(folder_ / name, ignored)) continue;
    write_file(folder_ / name, read_file(entry.path()));
    ++taken;
  }
  return taken;
}

fs::path MemberStore::file_of(int number) const {
  return folder_ / fmt::format("{:06}.json", number);
}

void MemberStore::write(const Member& member) const {
  write_file(file_of(member.number), text_of_member(member));
}

std::optional<Member> MemberStore::read(int number) const {
  std::error_code ignored;
  if (!fs::exists(file_of(number), ignored)) return std::nullopt;
  try {
    return member_of_text(number, read_file(file_of(number)));
  } catch (const Json::exception&) {
    throw std::runtime_error(fmt::format(
        "{} is damaged: remove it, and its member is computed again", file_of(number).string()));
  }
}

std::vector<int> MemberStore::find_missing(int members) const {
  std::vector<int> missing;
  std::error_code ignored;
  for (int number = part_.index; number < members; number += part_.of)
    if (!fs::exists(file_of(number), ignored)) missing.push_back(number);
  return missing;
}

namespace {

/// The values of a study that its members follow from. Limits are held against figures that all
/// members have: another table of seas, or another alpha factor, computes none of them again.
std::string values_for_members(const StudyFile& study) {
  std::string text;
  for (const InputValue& value : list_input_values(study.yaml))
    if (value.key != "title" && !value.key.starts_with("limits."))
      text += fmt::format("{}\n{}\n", value.key, value.value);
  return text;
}

}  // namespace

std::string identity_of_study(const StudyFile& study) {
  // What laws from outside do is not known: members that they steered are those of one run.
  if (!study.laws.empty()) return new_run_identity();
  ContentHash hash;
  hash.add(std::string_view(values_for_members(study)));
  hash.add(std::string_view(hash_of_input(read_lift_case(study.case_path()))));
  hash.add(std::string_view(program_version));
  return hash.digits();
}

}  // namespace blocklift::pipeline

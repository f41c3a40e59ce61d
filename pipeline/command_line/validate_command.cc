#include "pipeline/command_line/validate_command.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "pipeline/build/build_mechanism.h"
#include "pipeline/build/stiffener_plates.h"
#include "pipeline/declaration/asked_changes.h"
#include "pipeline/declaration/document.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/lift_case/operation_schedule.h"
#include "pipeline/files/structure/block_model.h"
#include "pipeline/files/structure/part_file.h"
#include "pipeline/formats/atomic_file.h"
#include "pipeline/hydrodynamics/hydrodynamic_problem.h"
#include "pipeline/lift/block_preparation.h"
#include "pipeline/lift/table_balance.h"
#include "pipeline/part/part_assessment.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/results/documents/mesh_page.h"
#include "pipeline/results/doubts/doubts.h"
#include "pipeline/results/summaries/table_summary.h"
#include "pipeline/study/design/study_design.h"
#include "pipeline/study/members/members.h"
#include "pipeline/terminal/run_log.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

std::string count(std::size_t number, const std::string& noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

std::string summary_of(const LiftCase& lift_case) {
  if (lift_case.load_table) {
    return fmt::format("load table with {}",
                       count(lift_case.load_table->static_loads.size(), "lug"));
  }
  Diagnostics none;
  const Schedule schedule = schedule_operation(lift_case, none);
  return fmt::format("{}, {}, {}, {:.0f} s", count(lift_case.cranes.size(), "crane"),
                     count(lift_case.ropes.size(), "rope"), count(schedule.stages.size(), "stage"),
                     schedule.duration);
}

/// A line for each row of stiffeners that are plates.
std::string lines_on_stiffener_plates(const BlockModel& block) {
  std::string lines;
  for (const std::string& line : describe_stiffener_plates(block)) lines += "\n" + line;
  return lines;
}

/// Complains about a load table that cannot hold up the block of a case.
/// @returns why the loads are to be doubted that can: a line each.
std::string look_at_load_table(const LiftCase& lift_case, const structure::ElasticModel& block,
                               Diagnostics& diagnostics) {
  const LoadTable& table = *lift_case.load_table;
  const auto balance = [&](const std::vector<Named<double>>& loads) {
    return find_table_balance(table, loads, block, lift_case.gravity);
  };
  const TableBalances balances{balance(table.static_loads), balance(table.dynamic_loads)};
  check_that_table_lifts(table, balances.at_rest, diagnostics);
  std::string lines;
  for (const std::string& doubt : list_doubts(balances)) lines += "\nwarning: " + doubt;
  return lines;
}

/// Reads one file of whatever kind; what it is, if it is sound.
std::optional<std::string> validate(const fs::path& named, ModelLibrary& library,
                                    Diagnostics& diagnostics,
                                    std::shared_ptr<const BlockModel>& block) {
  const fs::path path = input_file(named);
  const std::size_t errors_before = diagnostics.error_count();
  const auto if_sound = [&](std::string summary) -> std::optional<std::string> {
    if (diagnostics.error_count() > errors_before) return std::nullopt;
    return summary;
  };
  const FileKind kind = kind_of_file(path);
  if (kind == FileKind::mechanism || kind == FileKind::robot) {
    const auto mechanism = read_mechanism(path, library, diagnostics);
    if (!mechanism) return std::nullopt;
    std::string summary = fmt::format(
        "mechanism {} with {}, {} and {}", mechanism->name,
        mechanism->bodies.size() == 1 ? "1 body"
                                      : fmt::format("{} bodies", mechanism->bodies.size()),
        count(mechanism->joints.size(), "joint"), count(mechanism->loops.size(), "loop"));
    for (const std::string& doubt : mechanism->doubts) summary += "\nwarning: " + doubt;
    return if_sound(std::move(summary));
  }
  if (kind == FileKind::crane) {
    const auto crane = library.read_crane(path, diagnostics);
    if (!crane) return std::nullopt;
    return if_sound(fmt::format(
        "crane with {}, {} and {}",
        crane->bodies.size() == 1 ? "1 body" : fmt::format("{} bodies", crane->bodies.size()),
        count(crane->drives.size(), "drive"), count(crane->hoists.size(), "hoist")));
  }
  if (kind == FileKind::block) {
    block = library.read_block(path, diagnostics);
    if (!block || diagnostics.error_count() > errors_before) return std::nullopt;
    check_block_model(*block, path.string(), diagnostics);
    return if_sound(
        block->mesh
            ? fmt::format("block of a mesh with {}\n{}", count(block->lugs.size(), "lug"),
                          describe_block_mesh(*block->mesh))
            : fmt::format("block with {} and {}{}",
                          count(block->plates.size(), "kind") + " of plates",
                          count(block->lugs.size(), "lug"), lines_on_stiffener_plates(*block)));
  }
  if (kind == FileKind::rope) {
    library.read_rope(path, diagnostics);
    return if_sound("rope");
  }
  if (kind == FileKind::standard) {
    const auto rules = library.read_standard(path, diagnostics);
    if (!rules) return std::nullopt;
    return if_sound(fmt::format("standard {}, {}", rules->name, rules->edition));
  }
  if (kind == FileKind::rigging) {
    const auto stock = library.read_rigging(path, diagnostics);
    if (!stock) return std::nullopt;
    std::string items;
    const auto add = [&](std::size_t size, const char* noun) {
      if (size > 0) items += (items.empty() ? "" : ", ") + count(size, noun);
    };
    add(stock->slings.size(), "sling");
    add(stock->shackles.size(), "shackle");
    add(stock->master_links.size(), "master link");
    add(stock->sheaves.size(), "sheave");
    add(stock->spreaders.size(), "spreader");
    return if_sound(fmt::format("rigging with {}, by {}", items, stock->rule.name));
  }
  if (kind == FileKind::study) {
    const std::optional<StudyFile> study = read_study_file(path, diagnostics);
    if (!study) return std::nullopt;
    const Eigen::MatrixXd design = make_design(*study);
    check_members(*study, design, [](double) {});
    return fmt::format("study {} of {} with {} and {}", study->name, study->case_name.value,
                       count(study->variables.size(), "variable"),
                       count(static_cast<std::size_t>(design.rows()), "member"));
  }
  if (kind == FileKind::part) {
    const std::optional<PartFile> part = read_part_file(path, diagnostics);
    if (!part) return std::nullopt;
    const structure::PartModel model = make_part_model(*part, diagnostics);
    std::string summary = fmt::format("part {} with {}", part->name,
                                      count(model.mesh.solids.size(), "solid element"));
    for (const std::string& doubt : list_doubts(model)) summary += "\nwarning: " + doubt;
    return if_sound(std::move(summary));
  }
  if (kind == FileKind::vessel || kind == FileKind::vessels) {
    const auto problem = read_hydrodynamic_problem(path, library, diagnostics);
    if (!problem) return std::nullopt;
    std::size_t panels = 0;
    for (const HydrodynamicBody& body : problem->bodies) {
      panels += static_cast<std::size_t>(body.hull->panel_count());
    }
    return if_sound(
        fmt::format("{} with {}", count(problem->bodies.size(), "vessel"), count(panels, "panel")));
  }
  const std::optional<LiftCase> lift_case = read_lift_case(path, library, diagnostics);
  if (!lift_case) return std::nullopt;
  block = lift_case->load.model;
  std::string table_doubts;
  if (lift_case->has_structure()) {
    check_element_degree(*lift_case->load.model, lift_case->structure, diagnostics);
    const auto coarse =
        check_block_model(*lift_case->load.model, lift_case->load.model_name.value, diagnostics);
    if (coarse && lift_case->load_table)
      table_doubts = look_at_load_table(*lift_case, *coarse, diagnostics);
  }
  std::string summary = fmt::format("lift case {}: {}", lift_case->name, summary_of(*lift_case));
  if (lift_case->load.model && lift_case->load.model->mesh)
    summary += "\n" + describe_block_mesh(*lift_case->load.model->mesh);
  if (lift_case->load.model) summary += lines_on_stiffener_plates(*lift_case->load.model);
  for (const std::string& doubt : list_doubts(*lift_case)) summary += "\nwarning: " + doubt;
  summary += table_doubts;
  return if_sound(std::move(summary));
}

/// Writes what was found in a block's mesh into a folder.
void draw(const BlockModel& block, const fs::path& file, const fs::path& folder) {
  const std::string page =
      block.mesh ? mesh_page(*block.mesh, block.title.empty() ? file.string() : block.title) : "";
  if (page.empty()) return;
  fs::create_directories(folder);
  const fs::path path = folder / (name_of_input(file) + ".html");
  write_file(path, page);
  std::cout << fmt::format("pictures: {}\n", path.string());
}

/// A folder of a case may hold a study of it as well. Keys that are set are the case's alone.
std::vector<std::string> with_studies(const std::vector<std::string>& files, bool has_changes) {
  constexpr const char* study = "study.yaml";
  std::vector<std::string> all;
  for (const std::string& file : files) {
    all.push_back(file);
    std::error_code error;
    if (!has_changes && fs::is_directory(file, error) &&
        fs::exists(fs::path(file) / study, error) && input_file(file).filename() != study)
      all.push_back((fs::path(file) / study).string());
  }
  return all;
}

/// Before anything is read: what is found in other files must not be lost by it.
void refuse_files_without_keys(const std::vector<std::string>& files,
                               const std::vector<std::string>& set) {
  for (const std::string& file : files) {
    const FileKind kind = kind_of_file(input_file(file));
    if (kind != FileKind::lift_case && kind != FileKind::mechanism) refuse_asked_changes(file, set);
  }
}

}  // namespace

int validate_files(const std::vector<std::string>& files,
                   const std::optional<std::string>& pictures,
                   const std::vector<std::string>& set) {
  const std::vector<KeyChange> changes = read_asked_changes(set);
  if (!set.empty()) refuse_files_without_keys(files, set);
  Diagnostics all;
  std::set<std::string> said;
  for (const std::string& file : with_studies(files, !set.empty())) {
    // Each by itself: what is wrong with one, or with a model of it, must not hush up another.
    Diagnostics own;
    ModelLibrary library = ModelLibrary::of_installation();
    library.set_changes(changes);
    std::shared_ptr<const BlockModel> block;
    const auto summary = validate(file, library, own, block);
    if (summary && !is_quiet())
      std::cout << fmt::format("{}: valid, {}\n", shown_path(file), *summary);
    if (pictures && block) draw(*block, file, *pictures);
    for (const Diagnostic& error : own.errors()) {
      const std::string place = fmt::format("{}:{}:{}", error.mark.file ? *error.mark.file : "",
                                            error.mark.line, error.mark.column);
      if (said.insert(place + error.message).second)
        all.error(error.mark, error.message, error.hints);
    }
  }
  std::cerr << all.to_text();
  if (all.has_errors()) log_error(all.to_text());
  return all.has_errors() ? exit_code::wrong_input : exit_code::done;
}

}  // namespace blocklift::pipeline

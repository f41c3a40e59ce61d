#include "pipeline/command_line/rig_command.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "pipeline/command_line/progress_line.h"
#include "pipeline/declaration/quantity.h"
#include "pipeline/processes/exit_code.h"
#include "pipeline/rigging/rig_lift.h"
#include "pipeline/rigging/rigged_case.h"
#include "pipeline/terminal/run_log.h"
#include "pipeline/terminal/text_table.h"

namespace blocklift::pipeline {
namespace {

/// Steel ropes are what a lift is rigged with unless somebody says otherwise.
const std::vector<SlingConstruction> usual_constructions = {SlingConstruction::wire_rope,
                                                            SlingConstruction::cable_laid};

Stock read_asked_stock(const RigOptions& options, ModelLibrary& library) {
  std::vector<SlingConstruction> constructions;
  for (const auto& [name, construction] : sling_constructions())
    if (std::find(options.constructions.begin(), options.constructions.end(), name) !=
        options.constructions.end())
      constructions.push_back(construction);
  if (!options.stock && constructions.empty()) constructions = usual_constructions;
  Diagnostics diagnostics;
  Stock stock = read_stock(
      options.stock ? std::vector<std::filesystem::path>{*options.stock} : shipped_stock(library),
      constructions, library, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return stock;
}

std::string use_text(const Check& check) { return fmt::format("{:.3f}", check.utilisation); }

void print_slings(const RiggedLift& rigged) {
  TextTable table(
      {{"sling"}, {"rest t", 4}, {"motion t", 4}, {"chosen"}, {"use", 3}, {"governing check"}});
  for (const RiggedSling& sling : rigged.slings) {
    const Check& governing = *governing_check(sling.chosen.checks);
    table.add_row({sling.demand.rope, sling.demand.at_rest / newton_per_tonne,
                   sling.demand.in_motion / newton_per_tonne,
                   rigged.stock.slings[sling.chosen.index].name(), use_text(governing),
                   governing.name});
  }
  fmt::print("{}", table.text());
}

void print_shackles(const RiggedLift& rigged) {
  TextTable table(
      {{"lug"}, {"shackle"}, {"WLL t", 4}, {"pin mm", 4}, {"use", 3}, {"governing check"}});
  for (const ChosenShackle& chosen : rigged.shackles) {
    if (!chosen.index) continue;
    const ShackleInStock& shackle = rigged.stock.shackles[*chosen.index];
    const Check& governing = *governing_check(chosen.checks);
    table.add_row({chosen.lug, shackle.name(), shackle.shackle.working_load / newton_per_tonne,
                   shackle.shackle.pin * 1e3, use_text(governing), governing.name});
  }
  if (table.empty())
    print_wrapped("the stock has no shackles: none were chosen");
  else
    fmt::print("\n{}", table.text());
}

void print_master_links(const RiggedLift& rigged) {
  if (rigged.master_links.empty()) return;
  TextTable table({{"hook"},
                   {"legs", 4},
                   {"rest t", 4},
                   {"master link"},
                   {"WLL t", 4},
                   {"use", 3},
                   {"governing check"}});
  for (const ChosenMasterLink& chosen : rigged.master_links) {
    const MasterLinkInStock& link = rigged.stock.master_links[chosen.index];
    const Check& governing = *governing_check(chosen.checks);
    table.add_row({chosen.demand.hook, std::to_string(chosen.demand.legs),
                   chosen.demand.at_rest / newton_per_tonne, link.name(),
                   link.link.working_load / newton_per_tonne, use_text(governing), governing.name});
  }
  fmt::print("\n{}", table.text());
}

void print_sheaves(const RiggedLift& rigged) {
  if (rigged.sheaves.empty()) return;
  TextTable table(
      {{"sling"}, {"sheave"}, {"WLL t", 4}, {"tread mm", 4}, {"use", 3}, {"governing check"}});
  for (const ChosenSheave& chosen : rigged.sheaves) {
    if (!chosen.index) continue;
    const SheaveInStock& sheave = rigged.stock.sheaves[*chosen.index];
    const Check& governing = *governing_check(chosen.checks);
    table.add_row({chosen.rope, sheave.name(), sheave.sheave.working_load / newton_per_tonne,
                   sheave.sheave.tread * 1e3, use_text(governing), governing.name});
  }
  if (!table.empty()) fmt::print("\n{}", table.text());
}

void print_spreaders(const RiggedLift& rigged) {
  if (!rigged.spreaders.empty()) {
    TextTable table({{"spreader"},
                     {"of stock"},
                     {"WLL t", 4},
                     {"mass kg", 4},
                     {"use", 3},
                     {"governing check"}});
    for (const ChosenSpreader& chosen : rigged.spreaders) {
      const SpreaderInStock& bar = rigged.stock.spreaders[chosen.index];
      const Check& governing = *governing_check(chosen.checks);
      table.add_row({chosen.name, bar.name(), bar.spreader.working_load / newton_per_tonne,
                     bar.spreader.bar.mass(), use_text(governing), governing.name});
    }
    fmt::print("\n{}", table.text());
  }
  for (const given::Spreader& bar : rigged.lift_case.spreaders)
    if (!has_spreaders_of_size(rigged.stock, bar))
      print_wrapped(fmt::format("the stock has no {} of {}: {} stays as it is",
                                bar.is_frame() ? "frame" : "bar", bar.size_text(), bar.name.value));
}

/// What was used most of all that was chosen.
void print_governing(const RiggedLift& rigged) {
  const Check* worst = nullptr;
  std::string what;
  const auto consider = [&](const std::vector<Check>& checks, const std::string& name) {
    const Check* governing = governing_check(checks);
    if (!governing || (worst && !(governing->utilisation > worst->utilisation))) return;
    worst = governing;
    what = name;
  };
  for (const RiggedSling& sling : rigged.slings)
    consider(sling.chosen.checks, "sling " + sling.demand.rope);
  for (const ChosenShackle& shackle : rigged.shackles)
    consider(shackle.checks, "shackle at " + shackle.lug);
  for (const ChosenMasterLink& link : rigged.master_links)
    consider(link.checks, "master link at " + link.demand.hook);
  for (const ChosenSheave& sheave : rigged.sheaves)
    consider(sheave.checks, "sheave of " + sheave.rope);
  for (const ChosenSpreader& spreader : rigged.spreaders)
    consider(spreader.checks, "spreader " + spreader.name);
  fmt::print("\n");
  print_wrapped(fmt::format("{} governs: {:.3f} by {}", what, worst->utilisation, worst->name));
}

void print_settling(const Settled& settled) {
  if (settled.went_round)
    print_wrapped(
        "choices asked for each other by turns, as stiffer slings draw load from others; each "
        "sling kept the strongest of its choices from there on");
  if (settled.stands)
    print_wrapped(fmt::format("the choice stands after {} runs of the lift", settled.runs));
  else
    print_wrapped(
        fmt::format("the choice does not stand after {} runs of the lift: the loads above "
                    "are of the last run, and another would ask for other slings",
                    settled.runs));
}

/// What no stock is strong enough for.
void print_failures(const RiggedLift& rigged) {
  for (const RiggedSling& sling : rigged.slings) {
    if (sling.chosen.pass()) continue;
    const Check& check = *governing_check(sling.chosen.checks);
    say_warning(
        fmt::format("no sling of the stock passes for {}: {} comes nearest, with {:.3f} by {}",
                    sling.demand.rope, rigged.stock.slings[sling.chosen.index].name(),
                    check.utilisation, check.name));
  }
  for (const ChosenShackle& shackle : rigged.shackles) {
    if (!shackle.index || shackle.pass()) continue;
    const Check& check = *governing_check(shackle.checks);
    say_warning(fmt::format("no shackle of the stock passes at {}: {} has {:.3f} by {}",
                            shackle.lug, rigged.stock.shackles[*shackle.index].name(),
                            check.utilisation, check.name));
  }
  const auto say = [](const std::string& what, const std::string& name,
                      const std::vector<Check>& checks) {
    const Check& check = *governing_check(checks);
    say_warning(
        fmt::format("no {}: {} has {:.3f} by {}", what, name, check.utilisation, check.name));
  };
  for (const ChosenMasterLink& link : rigged.master_links)
    if (!link.pass())
      say("master link of the stock passes at " + link.demand.hook,
          rigged.stock.master_links[link.index].name(), link.checks);
  for (const ChosenSheave& sheave : rigged.sheaves) {
    if (!sheave.index)
      say_warning("no sheave of the stock takes the sling " + sheave.rope);
    else if (!sheave.pass())
      say("sheave of the stock passes for " + sheave.rope,
          rigged.stock.sheaves[*sheave.index].name(), sheave.checks);
  }
  for (const ChosenSpreader& spreader : rigged.spreaders)
    if (!spreader.pass())
      say("spreader of the stock passes for " + spreader.name,
          rigged.stock.spreaders[spreader.index].name(), spreader.checks);
}

}  // namespace

std::vector<std::string> construction_names() {
  std::vector<std::string> names;
  for (const auto& [name, construction] : sling_constructions()) names.push_back(name);
  return names;
}

int rig(const RigOptions& options) {
  ModelLibrary library = ModelLibrary::of_installation();
  LiftCase lift_case = read_lift_case(options.path);
  Stock stock = read_asked_stock(options, library);
  ProgressLine line;
  const RiggedLift rigged =
      rig_lift(std::move(lift_case), std::move(stock),
               [&](const std::string& stage, double fraction, const std::string& detail) {
                 line.show(stage, fraction, detail);
               });
  line.finish();
  if (!is_quiet()) {
    fmt::print("{}\n\n", rigged.lift_case.title);
    print_slings(rigged);
    print_shackles(rigged);
    print_master_links(rigged);
    print_sheaves(rigged);
    print_spreaders(rigged);
    print_governing(rigged);
    print_settling(rigged.settled);
  }
  print_failures(rigged);
  if (options.output) {
    if (rigged.pass()) {
      write_rigged_case(rigged, *options.output);
      if (!is_quiet()) fmt::print("case: {}\n", *options.output);
    } else {
      say_warning(fmt::format("{} is not written", *options.output));
    }
  }
  if (!rigged.settled.stands) return exit_code::run_failed;
  return rigged.pass() ? exit_code::done : exit_code::lift_fails;
}

}  // namespace blocklift::pipeline

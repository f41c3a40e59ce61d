#include "pipeline/rigging/rig_lift.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "parallel/blas_threads.h"
#include "pipeline/checks/gather_facts.h"
#include "pipeline/coupling/block_flexibility.h"
#include "pipeline/lift/block_preparation.h"
#include "pipeline/results/files/lift_scene.h"

namespace blocklift::pipeline {
namespace {

/// What a run says of the slings.
struct Loads {
  std::vector<SlingDemand> demands;
  std::optional<LiftFacts> facts;  ///< where the case has a standard
};

/// Runs one lift again and again with other slings; the block is made once.
class LiftRunner {
 public:
  LiftRunner(LiftCase lift_case, const Progress& progress)
      : assessment_{std::move(lift_case), {}, {}, {}, {}, {}, 0}, progress_(progress) {
    if (the_case().has_structure()) make_block();
  }

  const LiftCase& the_case() const { return assessment_.lift_case; }
  LiftCase take_case() { return std::move(assessment_.lift_case); }

  void set_rope(const std::string& name, const StockSling& sling) {
    const auto rope =
        std::find_if(assessment_.lift_case.ropes.begin(), assessment_.lift_case.ropes.end(),
                     [&](const given::Rope& one) { return one.name.value == name; });
    rope->rope = sling.rope;
    rope->rope_choice = sling.rope_choice;
  }

  /// The bar in the place of the case's, which keeps its name and where it starts.
  void set_spreader(const std::string& name, const given::Spreader& chosen) {
    for (given::Spreader& bar : assessment_.lift_case.spreaders) {
      if (bar.name.value != name) continue;
      given::Spreader changed = chosen;
      changed.name = bar.name;
      changed.position = bar.position;
      changed.attitude = bar.attitude;
      bar = std::move(changed);
    }
  }

  const LiftRun& lift() const { return *assessment_.lift; }

  Loads run() {
    assessment_.lift.reset();
    const LoadMass mass = assessment_.block.model
                              ? load_mass(assessment_.block.model->mass_properties())
                              : load_mass(the_case().load.vessel->model);
    BuiltLift model =
        prepare_lift(the_case(), mass, progress_, flexibility_ ? &*flexibility_ : nullptr);
    assessment_.lift = run_lift(the_case(), std::move(model), progress_);
    Loads loads{sling_demands(the_case(), *assessment_.lift), {}};
    if (the_case().standard) loads.facts = gather_facts(assessment_);
    return loads;
  }

 private:
  void make_block() {
    Diagnostics diagnostics;
    BlockRun& block = assessment_.block;
    block.model = make_block_model(*the_case().load.model, the_case().load.model_name.value,
                                   the_case().structure, diagnostics);
    if (!block.model) throw InputError(diagnostics);
    const bool gives_way = the_case().dynamics.flexibility != Flexibility::rigid;
    // A standard's computed skew asks for the block's compliance at its lugs.
    if (!gives_way && !the_case().standard) return;
    progress_("block: stiffness, factorisation, unit responses", 0, "");
    const parallel::OneBlasThread whatever_the_threads;
    block.responses = make_unit_responses(*block.model, *the_case().load.model);
    if (gives_way) flexibility_ = make_flexibility(*block.responses, the_case().dynamics);
  }

  Assessment assessment_;
  const Progress& progress_;
  std::optional<LoadFlexibility> flexibility_;
};

bool has_slings(const LiftCase& lift_case) {
  return std::any_of(lift_case.ropes.begin(), lift_case.ropes.end(),
                     [](const given::Rope& rope) { return rope.is_sling() && !rope.winch; });
}

Diagnostics complain_of_no_slings(const LiftCase& lift_case) {
  Diagnostics diagnostics;
  diagnostics.error(
      {std::make_shared<const std::string>(shown_path(lift_case.file)), 0, 0},
      "the case has no slings to choose",
      {"a sling is a rope that ends at a lug or a spreader and has no winch of its own"});
  return diagnostics;
}

}  // namespace

bool RiggedLift::pass() const {
  return settled.stands &&
         std::all_of(slings.begin(), slings.end(),
                     [](const RiggedSling& sling) { return sling.chosen.pass(); }) &&
         std::all_of(
             shackles.begin(), shackles.end(),
             [](const ChosenShackle& shackle) { return !shackle.index || shackle.pass(); }) &&
         std::all_of(master_links.begin(), master_links.end(),
                     [](const ChosenMasterLink& link) { return link.pass(); }) &&
         std::all_of(sheaves.begin(), sheaves.end(),
                     [](const ChosenSheave& sheave) { return sheave.pass(); }) &&
         std::all_of(spreaders.begin(), spreaders.end(),
                     [](const ChosenSpreader& spreader) { return spreader.pass(); });
}

RiggedLift rig_lift(LiftCase lift_case, Stock stock, const Progress& progress) {
  if (!has_slings(lift_case)) throw InputError(complain_of_no_slings(lift_case));
  RiggedLift rigged;
  rigged.stock = std::move(stock);
  LiftRunner runner(std::move(lift_case), progress);
  std::vector<std::string> bars;
  for (const given::Spreader& bar : runner.the_case().spreaders)
    if (has_spreaders_of_size(rigged.stock, bar)) bars.push_back(bar.name.value);
  Loads loads;
  // Slings first, then bars.
  const auto choose = [&] {
    loads = runner.run();
    const SlingChecks checks(runner.the_case(), loads.facts);
    Choice choice;
    for (const SlingDemand& demand : loads.demands)
      choice.push_back(choose_sling(rigged.stock, checks, demand).index);
    for (const std::string& bar : bars)
      choice.push_back(
          choose_spreader(rigged.stock, runner.the_case(), runner.lift(), loads.facts, bar).index);
    return choice;
  };
  const auto choose_again = [&](const Choice& choice) {
    for (std::size_t i = 0; i < choice.size(); ++i) {
      if (i < loads.demands.size())
        runner.set_rope(loads.demands[i].rope, rigged.stock.slings[choice[i]].sling);
      else
        runner.set_spreader(bars[i - loads.demands.size()],
                            rigged.stock.spreaders[choice[i]].spreader.bar);
    }
    return choose();
  };
  rigged.settled = settle(choose, choose_again, most_rigging_runs);

  // Where the choice stands, these are the loads of the run with it.
  const SlingChecks checks(runner.the_case(), loads.facts);
  for (std::size_t i = 0; i < loads.demands.size(); ++i) {
    const std::size_t index = rigged.settled.choice[i];
    rigged.slings.push_back(
        {loads.demands[i], {index, checks.of(rigged.stock.slings[index], loads.demands[i])}});
    const given::Rope& rope = *runner.the_case().find_rope(loads.demands[i].rope);
    if (is_led_over_sheaves(rope) && !rigged.stock.sheaves.empty())
      rigged.sheaves.push_back(choose_sheave(rigged.stock, runner.the_case(), loads.facts,
                                             loads.demands[i],
                                             rigged.stock.slings[index].sling.rope));
  }
  for (const ShackleDemand& demand : shackle_demands(runner.the_case(), runner.lift()))
    rigged.shackles.push_back(choose_shackle(rigged.stock, runner.the_case(), loads.facts, demand));
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const std::size_t index = rigged.settled.choice[loads.demands.size() + i];
    rigged.spreaders.push_back({bars[i], index,
                                check_spreader(rigged.stock.spreaders[index], runner.the_case(),
                                               runner.lift(), loads.facts, bars[i])});
  }
  for (const MasterLinkDemand& demand : master_link_demands(runner.the_case(), runner.lift()))
    if (auto link = choose_master_link(rigged.stock, runner.the_case(), loads.facts, demand))
      rigged.master_links.push_back(std::move(*link));
  rigged.lift_case = runner.take_case();
  return rigged;
}

}  // namespace blocklift::pipeline

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "pipeline/lift/block_preparation.h"
#include "pipeline/lift/lift_run.h"
#include "tests/pipeline/sling_over_edge_lift.h"

namespace blocklift::pipeline::test {

/// The lift of the files with its block in elements of degree 1.
struct OverEdges {
  explicit OverEdges(const SampleLift& files = sling_over_edge_lift()) {
    files.write(folder);
    lift_case = read_lift_case(".");
    lift_case.structure.element_degree = 1;
    Diagnostics diagnostics;
    model = make_block_model(*lift_case.load.model, "plate", lift_case.structure, diagnostics);
    const structure::MassProperties& mass = model->mass_properties();
    run.emplace(run_lift(
        lift_case, build_lift(lift_case, {mass.mass, mass.centre_of_mass_B, mass.inertia_BBcm_B}),
        nothing));
  }
  const dynamics::RopeHistory& rope(const dynamics::History& history, std::size_t place) const {
    return history.ropes[run->model.ropes[place].rope];
  }

  static void nothing(const std::string&, double, const std::string&) {}
  TemporaryFolder folder;
  LiftCase lift_case;
  std::unique_ptr<structure::ElasticModel> model;
  std::optional<LiftRun> run;
};

}  // namespace blocklift::pipeline::test

#pragma once

#include <memory>

#include "pipeline/lift/lift_run.h"
#include "structure/response/elastic_model.h"

namespace blocklift::pipeline::test {

/// The lift in tests/pipeline/cases/small-lift: a gantry crane with two hooks takes up an open box
/// of 8 t by four slings, tilts it, and carries it, in the wind. With linear elements, for speed.
struct SmallLift {
  LiftCase lift_case;
  std::unique_ptr<structure::ElasticModel> model;
  LiftRun run;

  const dynamics::LiftSystem& system() const { return run.model.system; }
  const std::vector<structure::LiftingPoint>& lugs() const { return model->mesh().lifting_points; }
  const structure::MassProperties& mass() const { return model->mass_properties(); }
};

/// The case as it is in its file.
LiftCase read_small_lift();

/// Dynamics and block of the small lift, run once in a process.
const SmallLift& small_lift();

}  // namespace blocklift::pipeline::test

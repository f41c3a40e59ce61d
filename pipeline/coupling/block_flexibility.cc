#include "pipeline/coupling/block_flexibility.h"

#include <utility>

#include "structure/response/flexibility.h"

namespace blocklift::pipeline {

std::optional<LoadFlexibility> make_flexibility(const structure::UnitResponses& responses,
                                                const DynamicsSettings& settings) {
  if (settings.flexibility == Flexibility::rigid) return {};
  const int modes = settings.flexibility == Flexibility::modal ? settings.mode_count() : 0;
  structure::LugFlexibility at_lugs = structure::find_lug_flexibility(responses, modes);
  LoadFlexibility flexibility;
  for (const structure::LiftingPoint& lug : responses.model().mesh().lifting_points)
    flexibility.lugs.push_back(lug.name);
  flexibility.compliance = std::move(at_lugs.residual_compliance);
  flexibility.shapes = std::move(at_lugs.shapes);
  flexibility.angular_frequencies = std::move(at_lugs.angular_frequencies);
  flexibility.damping_ratio = settings.mode_damping();
  return flexibility;
}

}  // namespace blocklift::pipeline

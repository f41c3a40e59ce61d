#include "pipeline/files/lift_case/input_hash.h"

#include "pipeline/formats/content_hash.h"
#include "pipeline/formats/hydrodynamics/hull_hash.h"

namespace blocklift::pipeline {
namespace {

void add(ContentHash& hash, const given::Vessel& vessel) {
  if (vessel.model) add(hash, vessel.model->hull);
  hash.add(std::string_view(vessel.database_content));
}

}  // namespace

std::string hash_of_input(const LiftCase& lift_case) {
  ContentHash hash;
  hash.add(std::string_view(lift_case.yaml));
  for (const ModelText& model : lift_case.model_texts) hash.add(std::string_view(model.text));
  if (const auto& block = lift_case.load.model; block && block->mesh)
    hash.add(std::string_view(block->mesh->content));
  if (const auto& vessel = lift_case.load.vessel) add(hash, vessel->hull);
  for (const given::Vessel& vessel : lift_case.vessels) add(hash, vessel);
  if (lift_case.sea && lift_case.sea->waves && lift_case.sea->waves->record) {
    const given::WaveRecord& record = *lift_case.sea->waves->record;
    hash.add(record.elevation);
    hash.add(record.time_step);
    hash.add(record.start_time);
  }
  if (lift_case.compare) {
    for (const Named<MeasuredSeries>& series : lift_case.compare->series) {
      hash.add(series.value.time);
      hash.add(series.value.tension);
    }
  }
  return hash.digits();
}

}  // namespace blocklift::pipeline

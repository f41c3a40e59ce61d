#include "pipeline/assessment/block_preparation.h"

#include "pipeline/input/build_lift.h"
#include "structure/error.h"
#include "structure/mesh/block_generator.h"

namespace blocklift::pipeline {

std::unique_ptr<structure::ElasticModel> make_block_model(const BlockModel& block,
                                                          const std::string& name,
                                                          const StructureSettings& settings,
                                                          Diagnostics& diagnostics) {
  try {
    const structure::BlockDescription description =
        describe_block(block, name, settings.largest_element);
    return std::make_unique<structure::ElasticModel>(
        structure::generate_block_mesh(description), settings.element_degree,
        description.total_mass, description.centre_of_mass_B);
  } catch (const structure::ModelError& error) {
    diagnostics.error(block.place, error.what());
    return nullptr;
  }
}

void check_block_model(const BlockModel& block, const std::string& name, Diagnostics& diagnostics) {
  constexpr int coarse_degree = 1;
  constexpr double coarse_element = 100;  // m: cuts where plates meet, and no others
  make_block_model(block, name, {coarse_degree, coarse_element}, diagnostics);
}

}  // namespace blocklift::pipeline

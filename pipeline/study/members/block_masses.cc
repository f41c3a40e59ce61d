#include "pipeline/study/members/block_masses.h"

#include "pipeline/lift/block_preparation.h"
#include "structure/error.h"
#include "structure/system/matter.h"

namespace blocklift::pipeline {

void BlockMasses::check(const LiftCase& lift_case, const std::string& block_key,
                        Diagnostics& diagnostics) {
  if (!lift_case.has_structure()) return;
  const BlockModel& block = *lift_case.load.model;
  if (!matter_ || block_key != key_) {
    matter_.reset();
    if (!check_element_degree(block, lift_case.structure, diagnostics)) return;
    const auto coarse = check_block_model(block, lift_case.load.model_name.value, diagnostics);
    if (!coarse) return;
    // What this block states was looked at with it.
    matter_.emplace(structure::Matter(coarse->space()));
    key_ = block_key;
    return;
  }
  try {
    const structure::MassProperties mass =
        matter_->with(block.mass ? &block.mass->value : nullptr,
                      block.centre_of_mass ? &block.centre_of_mass->value : nullptr);
    check_stated_mass(block, mass, diagnostics);
  } catch (const structure::ModelError& error) {
    diagnostics.error(block.place, error.what());
  }
}

}  // namespace blocklift::pipeline

#include "tests/pipeline/small_lift.h"

#include <utility>

#include "pipeline/build/describe_block.h"
#include "structure/mesh/plates/shell_generator.h"

namespace blocklift::pipeline::test {

LiftCase read_small_lift() {
  LiftCase lift_case = read_lift_case(BLOCKLIFT_SMALL_LIFT);
  lift_case.structure.element_degree = 1;
  return lift_case;
}

const SmallLift& small_lift() {
  static const SmallLift lift = [] {
    LiftCase lift_case = read_small_lift();
    const structure::BlockDescription description =
        describe_block(*lift_case.load.model, lift_case.load.model_name.value,
                       lift_case.structure.largest_element);
    auto model = std::make_unique<structure::ElasticModel>(
        structure::generate_shell_mesh(description),
        structure::Resolution{lift_case.structure.element_degree, {}}, description.total_mass,
        description.centre_of_mass_B);
    const structure::MassProperties& mass = model->mass_properties();
    BuiltLift built =
        build_lift(lift_case, {mass.mass, mass.centre_of_mass_B, mass.inertia_BBcm_B});
    LiftRun run = run_lift(lift_case, std::move(built),
                           [](const std::string&, double, const std::string&) {});
    return SmallLift{std::move(lift_case), std::move(model), std::move(run)};
  }();
  return lift;
}

}  // namespace blocklift::pipeline::test

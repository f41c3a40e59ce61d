// Nothing is allocated when forces of the sea are evaluated.
#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/loads/hull_force.h"
#include "dynamics/marine/loads/viscous.h"
#include "dynamics/marine/waves/wave_spectrum.h"
#include "tests/dynamics/allocation_counter.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using blocklift::test::allocations;
using blocklift::test::counts_allocations;

TEST(MarineAllocation, NoneInTheForces) {
  if (!counts_allocations()) GTEST_SKIP() << "allocations cannot be counted in this build";
  test::OneBody body;
  const auto hull = std::make_shared<const HullClusters>(make_box({12, 6, 3}, {12, 6, 3, 1}));
  const auto sea = std::make_shared<const Sea>(
      Sea{realise(WaveSpectrum::jonswap(2, 8), {}, {.spreading_exponent = 2.0}),
          Current::tidal(1, 0, 30)});
  const auto still = std::make_shared<const Sea>();
  const HullForce in_waves({"a", 1, hull, sea}), in_calm({"b", 1, hull, still});
  const MorisonMember member({"m", 1, {0, 0, -1}, {5, 0, 0}, 0.5, 1, 4, sea});
  QuadraticDamping::Definition d;
  d.name = "d";
  d.point = {1, Vector3::Zero()};
  d.linear.setOnes();
  d.sea = sea;
  d.hull = hull;
  d.reference_volume = 100;
  const QuadraticDamping damping(d);
  body.update();
  const MotionState state = body.state();
  EnergyAccount sum;
  const long before = allocations();
  const auto evaluate = [&](const auto& element) {
    element.add_forces(state, body.loads);
    sum += element.calc_energy(state);
  };
  evaluate(in_waves);
  evaluate(in_calm);
  evaluate(member);
  evaluate(damping);
  EXPECT_EQ(allocations(), before);
  EXPECT_TRUE(std::isfinite(sum.stored_energy + body.loads.F_Bo_W[1].force.z()));
}

}  // namespace
}  // namespace blocklift::dynamics

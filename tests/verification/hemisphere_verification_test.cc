// A floating hemisphere beyond what `blocklift verify` computes: finite depth against WAMIT's
// figures in 50 m, the state space, the direct march and the database in a regular wave.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/radiation/floating_motion.h"
#include "pipeline/verification/models/hemisphere.h"

namespace blocklift::dynamics {
namespace {

using examples::Hemisphere;
using examples::make_hemisphere;
using examples::task_10;
using Division = examples::HemisphereDivision;

constexpr double pi = std::numbers::pi;

// WAMIT, hemisphere of 5 m radius in 50 m of water; coefficients over the displaced mass.
TEST(Hemisphere, FiniteDepthAgainstWamit) {
  struct Wamit {
    double period, A33, B33, A11, B11;
  };
  constexpr std::array<Wamit, 3> table = {{{6.0, .5574, .3329, .6546, .1289},
                                           {5.0, .4690, .2892, .6412, .2677},
                                           {4.0, .4006, .1997, .4614, .4027}}};
  const Water water{1000.0, 9.80665, 50.0};
  const Hemisphere sphere = make_hemisphere(5.0, {48, 18, 0.04}, water);
  DatabaseSettings settings;
  for (const Wamit& row : table) settings.frequencies.push_back(2.0 * pi / row.period);
  settings.duration = 30.0;
  settings.damping_strength = 0.5 * std::sqrt(9.80665 / 5.0);
  const HydrodynamicDatabase database = compute_database(sphere.model, settings);
  const double mass = 1000.0 * 2.0 / 3.0 * pi * 125.0;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const Wamit& row = table[k];
    const Eigen::MatrixXd A = database.added_mass[k] / mass;
    const Eigen::MatrixXd B = database.damping[k] / (mass * database.frequencies[k]);
    std::printf("T %.0f s: A33 %.4f (%.4f) B33 %.4f (%.4f) A11 %.4f (%.4f) B11 %.4f (%.4f)\n",
                row.period, A(heave, heave), row.A33, B(heave, heave), row.B33, A(surge, surge),
                row.A11, B(surge, surge), row.B11);
    EXPECT_NEAR(A(heave, heave), row.A33, 0.02 * row.A33);
    EXPECT_NEAR(B(heave, heave), row.B33, 0.02 * row.B33);
    EXPECT_NEAR(A(surge, surge), row.A11, 0.02 * row.A11);
    EXPECT_NEAR(B(surge, surge), row.B11, 0.02 * row.B11);
  }
  EXPECT_NEAR(database.infinite_added_mass(heave, heave) / mass, .5006, 0.02 * .5006);
  EXPECT_NEAR(database.infinite_added_mass(surge, surge) / mass, .2742, 0.02 * .2742);
}

// A state space in place of the convolution: the same decay to the tolerance of the fit.
TEST(FreeDecay, StateSpaceAgreesWithTheConvolution) {
  const Hemisphere sphere = make_hemisphere(5.0, {32, 12, 0.06}, {1000.0, 9.81}, -2.0);
  DatabaseSettings settings;
  settings.frequencies = {0.5, 2.5};
  settings.damping_strength = 0.35;
  settings.duration = 30.0;
  const HydrodynamicDatabase database = compute_database(sphere.model, settings);
  const MemoryStateSpace memory(database, 0.01);
  std::printf("%d states for 6 modes, error %.2e\n", memory.state_count(), memory.error());
  const LinearFloatation bodies = task_10();
  const FloatingMotion convolved = march_with_database(bodies, database, 0.05, 10.0);
  const FloatingMotion fitted =
      march_with_state_space(bodies, database.infinite_added_mass, memory, 0.05, 10.0);
  for (std::size_t k = 0; k < fitted.position.size(); ++k) {
    EXPECT_NEAR(fitted.position[k][heave], convolved.position[k][heave], 0.01);
  }
  // 24 a mode, where the convolution keeps some hundred samples of each: what makes it worth while.
  EXPECT_LT(memory.state_count(), 200);
}

// A regular wave on the moored sphere: direct march and database, after the start has died out.
TEST(RegularWave, DirectMarchAndDatabaseAgree) {
  LinearFloatation bodies = task_10();
  bodies.start.setZero();
  bodies.stiffness(surge, surge) = 4e5;
  bodies.stiffness(pitch, pitch) = 8e6;
  const RegularWave wave{1.2, 0.0, 1.0};
  std::vector<double> difference;
  for (const Division& division : {Division{16, 6, 0.15}, Division{32, 12, 0.06}}) {
    const Hemisphere sphere = make_hemisphere(5.0, division, {1000.0, 9.81}, -2.0);
    DirectRadiation::Settings direct;
    direct.damping_strength = 0.5;
    direct.waves = {wave};
    DirectRadiation radiation(sphere.model, direct);
    const FloatingMotion marched = march_directly(bodies, radiation, 0.05, 60.0);
    DatabaseSettings settings;
    settings.frequencies = {0.8, 1.2, 2.5};
    settings.headings = {0.0};
    settings.damping_strength = 0.5;
    settings.duration = 40.0;
    const HydrodynamicDatabase database = compute_database(sphere.model, settings);
    const FloatingMotion convolved = march_with_database(bodies, database, 0.05, 60.0, wave);
    double amplitude = 0.0, worst = 0.0;
    for (std::size_t k = 900; k < marched.position.size(); ++k) {
      amplitude = std::max(amplitude, std::abs(marched.position[k][heave]));
      worst = std::max(worst, std::abs(marched.position[k][heave] - convolved.position[k][heave]));
    }
    std::printf("%d unknowns: heave %.4f m, difference %.4f m\n", sphere.unknowns, amplitude,
                worst);
    difference.push_back(worst / amplitude);
  }
  EXPECT_LT(difference[1], 0.01);
  EXPECT_LT(difference[1], difference[0]);
}

}  // namespace
}  // namespace blocklift::dynamics

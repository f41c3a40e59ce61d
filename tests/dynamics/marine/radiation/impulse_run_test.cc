#include "dynamics/marine/radiation/impulse_run.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;

const Water open_water{1.0, 9.80665};
const std::vector<double> band = {1.0, 1.4, 1.6, 1.7, 1.8, 1.9, 2.0, 2.1, 2.2, 2.4};
constexpr double three_periods = 3.0 * 2.0 * std::numbers::pi / 1.0;

/// Boxes of 20 x 8 x 1 m, side by side with 3 m between them, or one alone.
PanelModel make_boxes(bool two) {
  const PanelMesh box = make_box_hull(20, 8, 1, {.length = 20, .breadth = 8, .draught = 2});
  const double y = two ? 5.5 : 0.0;
  std::vector<WettedBody> bodies{{"left", translate(box, {0, y, 0}), {0, y, 0}}};
  if (two) bodies.push_back({"right", translate(box, {0, -y, 0}), {0, -y, 0}});
  const auto lines = find_water_lines(bodies);
  const auto length = [](double w) {
    return 2.0 * std::numbers::pi / calc_wave_number(w, open_water);
  };
  const SurfaceMesh surface =
      make_surface_mesh(lines, surface_settings(lines, length(band.back()), length(band.front())));
  return {bodies, surface, open_water, {true, true}};
}

DatabaseSettings settings_for(double duration) {
  DatabaseSettings settings;
  settings.frequencies = band;
  settings.duration = duration;
  return settings;
}

/// Largest relative difference of a mode's force on itself.
double difference(const HydrodynamicDatabase& a, const HydrodynamicDatabase& b, int mode) {
  double largest = 0.0;
  for (std::size_t k = 0; k < band.size(); ++k) {
    const auto force = [&](const HydrodynamicDatabase& of) {
      return Complex(of.damping[k](mode, mode), band[k] * of.added_mass[k](mode, mode));
    };
    largest = std::max(largest, std::abs(force(a) - force(b)) / std::abs(force(b)));
  }
  return largest;
}

double duration_of(const HydrodynamicDatabase& database) {
  return database.time_step * static_cast<double>(database.retardation.size() - 1);
}

// Water that swings between two hulls outlasts three periods of the lowest frequency. A run that
// ends there says by how much it is off, and one that is free to go on does.
TEST(ImpulseRun, LastsAsLongAsWaterSwingsBetweenHulls) {
  const PanelModel model = make_boxes(true);
  const HydrodynamicDatabase endless = compute_database(model, settings_for(10.0 * three_periods));
  const HydrodynamicDatabase ended = compute_database(model, settings_for(three_periods));
  const HydrodynamicDatabase free = compute_database(model, settings_for(0.0));
  for (const int mode : {+sway, +heave}) {
    const double error = difference(ended, endless, mode);
    EXPECT_GT(error, 0.3) << mode;
    // An estimate: what it is compared with has an end of its own.
    EXPECT_GT(ended.cut_off_by_end[mode], 0.3 * error) << mode;
    EXPECT_LT(ended.cut_off_by_end[mode], 3.0 * error) << mode;
    EXPECT_LT(difference(free, endless, mode), 0.04) << mode;
    EXPECT_LT(free.cut_off_by_end[mode], 0.05) << mode;
    EXPECT_GT(free.cut_off_by_end[mode], 0.5 * difference(free, endless, mode)) << mode;
  }
  EXPECT_GT(duration_of(free), 1.9 * three_periods);
}

// Damping and added mass are the integrals of the force, excitation and far field follow from those
// of the elevation. Force is what the elevation presses with: the two are one, however often the
// run went on. With a taper that began before the run last went on they differed, by up to a third
// of what the water did late.
TEST(ImpulseRun, ForceIsThatOfTheElevationHoweverLongItLasts) {
  const PanelModel model = make_boxes(false);
  const RankinePart part(model, {1, 1});
  const double gravity = open_water.gravity;
  const SurfaceDamping damping = DampingZone{0.5}.damping(model.surface(), gravity);
  for (const int most : {1, 2, 3, 4}) {
    ImpulseRun run(part, damping, open_water, band, true);
    constexpr long steps = 40;
    const RunLength as_long_as_may_be{.steps = steps, .most = most, .share = 0.0};
    ASSERT_EQ(run.run(0.8 * run.step_limit(), as_long_as_may_be, nullptr), most * steps);
    const Eigen::MatrixXd& q = part.surface_columns();
    for (std::size_t k = 0; k < band.size(); ++k) {
      const Eigen::MatrixXcd pressed = q.transpose() * run.elevation(k);
      const Eigen::MatrixXcd force =
          part.image_count() * gravity * 0.5 * (pressed + pressed.transpose());
      const Eigen::MatrixXcd found =
          run.damping(k) + Complex(0.0, band[k]) * run.added_mass(k).cast<Complex>();
      EXPECT_LT((found - force).norm(), 1e-9 * force.norm()) << most << " times, " << band[k];
    }
  }
}

// A run beside another one takes longer steps where the other's are short. As the integrals know
// the march's dispersion, the forces stay the same but for what the damping zone makes of the step
// and for an end that lies up to a step earlier. With steps that are as long as they may be both
// take the same, and agree to the last bit.
TEST(ImpulseRun, BesideAnotherByLongerStepsTheForcesAreTheSame) {
  const PanelModel model = make_boxes(false);
  const RankinePart part(model, {1, 1});
  const SurfaceDamping damping = DampingZone{1.1}.damping(model.surface(), open_water.gravity);
  for (const bool longer : {true, false}) {
    ImpulseRun run(part, damping, open_water, band, true);
    ImpulseRun beside(part, damping, open_water, band, true);
    const double step = (longer ? 0.47 : 0.81) * run.step_limit();
    const auto steps = static_cast<long>(three_periods / step);
    ASSERT_EQ(run.run(step, {.steps = steps, .most = 2, .share = 0.0}, &beside), 2 * steps);
    const double allowed = longer ? 2e-3 : 0.0;
    for (std::size_t k = 0; k < band.size(); ++k) {
      const Eigen::MatrixXd changes[] = {run.damping(k) - beside.damping(k),
                                         band[k] * (run.added_mass(k) - beside.added_mass(k))};
      const double force = std::hypot(run.damping(k).norm(), band[k] * run.added_mass(k).norm());
      EXPECT_LE(std::hypot(changes[0].norm(), changes[1].norm()), allowed * force) << band[k];
      const Eigen::MatrixXcd elevation = run.elevation(k);
      EXPECT_LE((elevation - beside.elevation(k)).norm(), 10.0 * allowed * elevation.norm())
          << band[k];
    }
  }
}

TEST(ImpulseRun, EndsSoonWhereNothingSwings) {
  const HydrodynamicDatabase alone = compute_database(make_boxes(false), settings_for(0.0));
  EXPECT_NEAR(duration_of(alone), three_periods, alone.time_step);
  EXPECT_LT(alone.cut_off_by_end.maxCoeff(), 0.03);
}

}  // namespace
}  // namespace blocklift::dynamics

// Froude-Krylov forces on panels as large as hulls are meshed with.
#include "dynamics/marine/radiation/wave_on_hulls.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/marine/panels/panel_shapes.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;

/// A box that turns about its middle in the water line, in waves from abeam.
struct BoxAbeam {
  double length = 20.0, breadth = 10.0, draught = 3.0;

  /// int (n_y, n_z, (p x n)_x) exp(k z - i k y) dS, n into the water.
  std::array<Complex, 3> exact(double k) const {
    const double b = 0.5 * breadth, decay = std::exp(-k * draught);
    const double sway = 2.0 * std::sin(k * b) * (1.0 - decay) / k;
    const double heave = 2.0 * std::sin(k * b) * decay / k;
    const double bottom = 2.0 * decay * (std::sin(k * b) / (k * k) - b * std::cos(k * b) / k);
    const double sides =
        2.0 * std::sin(k * b) * (decay * (draught / k + 1.0 / (k * k)) - 1.0 / (k * k));
    return {Complex(0.0, -length * sway), -length * heave, Complex(0.0, length * (bottom + sides))};
  }
};

PanelModel make_box_model(const BoxAbeam& box, const BoxDivision& division,
                          const Symmetry& planes) {
  SurfaceMesh none;
  none.mesh.symmetry = planes;
  PanelMesh hull = make_box_hull(box.length, box.breadth, box.draught, division);
  return {{{"box", std::move(hull), Vector3::Zero()}}, none, {1000.0, 9.80665}, planes};
}

// By the panels' middles alone roll would be off by 14 to 17 %: it is the rest of bottom and sides.
TEST(WaveOnHulls, RollOfABoxOfFewPanels) {
  const BoxAbeam box;
  const BoxDivision coarse{.length = 6, .breadth = 4, .draught = 2, .grading = 1.0};
  for (const bool halved : {false, true}) {
    const WaveOnHulls waves(make_box_model(box, coarse, {halved, halved}));
    for (const double w : {0.1, 0.6, 1.4}) {
      const double k = w * w / 9.80665;
      const Eigen::MatrixXcd found =
          waves.integrate_potential(w, {0.5 * std::numbers::pi}) / Complex(0.0, 9.80665 / w);
      const auto [sway_force, heave_force, roll_moment] = box.exact(k);
      EXPECT_LT(std::abs(found(sway, 0) - sway_force), 1e-4 * std::abs(sway_force)) << w;
      EXPECT_LT(std::abs(found(heave, 0) - heave_force), 1e-4 * std::abs(heave_force)) << w;
      EXPECT_LT(std::abs(found(roll, 0) - roll_moment), 1e-3 * std::abs(roll_moment)) << w;
      EXPECT_LT(std::abs(found(surge, 0)), 1e-9 * std::abs(heave_force));
    }
  }
}

// What turns nothing feels nothing, though flat panels have arms about a round body's axis.
TEST(WaveOnHulls, RoundBodiesDoNotTurnAboutTheirAxis) {
  SurfaceMesh none;
  const PanelModel model(
      {{"round", make_half_ellipsoid({1, 1, 1}, {.meridians = 8, .parallels = 2}),
        Vector3::Zero()}},
      none, {1000.0, 9.80665});
  const Eigen::MatrixXcd found = WaveOnHulls(model).integrate_potential(3.0, {0.3});
  EXPECT_EQ(found(yaw, 0), Complex(0.0));
  EXPECT_GT(std::abs(found(heave, 0)), 0.1);
}

}  // namespace
}  // namespace blocklift::dynamics

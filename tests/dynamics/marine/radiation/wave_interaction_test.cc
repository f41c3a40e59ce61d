#include "dynamics/marine/radiation/wave_interaction.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/panels/panel_shapes.h"
#include "dynamics/marine/radiation/cylindrical_waves.h"
#include "dynamics/marine/radiation/distant_groups.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const Water deep{1.0, 1.0};

PanelModel make_spheres(double distance, double shortest, double longest) {
  const PanelMesh sphere = make_half_ellipsoid({1, 1, 1}, {.meridians = 16, .parallels = 4});
  const Vector3 right(0.5 * distance, 0, 0);
  const std::vector<WettedBody> bodies{{"left", translate(sphere, -right), -right},
                                       {"right", translate(sphere, right), right}};
  const auto lines = find_water_lines(bodies);
  return {bodies,
          make_surface_mesh(lines, surface_settings(lines, shortest, longest)),
          deep,
          {true, true}};
}

// Graf's addition theorem against the waves themselves, at a point near the receiver.
TEST(CylindricalWaves, AreStandingOnesElsewhere) {
  const Eigen::Vector2d offset(3.0, -4.0), point(0.5, 0.3);
  const double k = 0.7;
  const auto wave = [&](int m, const Eigen::Vector2d& p, bool outgoing) {
    const double order = std::abs(m), x = k * p.norm();
    Complex value(std::cyl_bessel_j(order, x), outgoing ? -std::cyl_neumann(order, x) : 0.0);
    if (m < 0 && m % 2 != 0) value = -value;
    return value * std::polar(1.0, m * std::atan2(p.y(), p.x()));
  };
  const int terms = 12;
  const Eigen::MatrixXcd T = carry_waves(offset, k, terms, 2);
  for (int m = -2; m <= 2; ++m) {
    Complex sum = 0.0;
    for (int n = -terms; n <= terms; ++n) sum += T(n + terms, m + 2) * wave(n, point, false);
    EXPECT_LT(std::abs(sum - wave(m, offset + point, true)), 1e-6) << m;
  }
}

TEST(CylindricalWaves, MakeUpAPlaneWave) {
  const Eigen::Vector2d point(0.8, -0.5);
  const Eigen::VectorXcd d = plane_wave(10, 0.6);
  Complex sum = 0.0;
  for (int n = -10; n <= 10; ++n) {
    double J = std::cyl_bessel_j(std::abs(n), point.norm());
    if (n < 0 && n % 2 != 0) J = -J;
    sum += d[n + 10] * J * std::polar(1.0, n * std::atan2(point.y(), point.x()));
  }
  const Complex wave = std::polar(1.0, -(point.x() * std::cos(0.6) + point.y() * std::sin(0.6)));
  EXPECT_LT(std::abs(sum - wave), 1e-9);
}

TEST(DistantGroups, AreThoseWhoseWavesTheSurfaceLoses) {
  const PanelModel near = make_spheres(4.0, 3.0, 10.0), far = make_spheres(20.0, 3.0, 10.0);
  EXPECT_EQ(find_distant_groups(near, 1.0).size(), 1U);
  const std::vector<BodyGroup> groups = find_distant_groups(far, 1.0);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[1].bodies, std::vector<int>{1});
  EXPECT_NEAR(groups[1].centre.x(), 10.0, 1e-9);
  EXPECT_NEAR(groups[1].radius, 1.0, 0.05);
  EXPECT_EQ(find_distant_groups(far, 0.2).size(), 1U);  // 157 m long
}

/// Two hemispheres 8 radii apart: one surface, and a surface for each.
class DistantSpheres : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const PanelModel model = make_spheres(8.0, 9.0, 70.0);
    DatabaseSettings settings;
    settings.frequencies = {0.3, 0.4, 0.5, 0.6, 0.7};
    settings.headings = {0.0, 0.5};
    settings.duration = 60.0;
    whole = new HydrodynamicDatabase(compute_database(model, settings));
    const std::vector<BodyGroup> groups{{{0}, {-4, 0}, 1.0}, {{1}, {4, 0}, 1.0}};
    apart = new HydrodynamicDatabase(compute_distant_groups(model, groups, settings));
  }
  static void TearDownTestSuite() {
    delete whole;
    delete apart;
  }
  static HydrodynamicDatabase *whole, *apart;
};
HydrodynamicDatabase* DistantSpheres::whole = nullptr;
HydrodynamicDatabase* DistantSpheres::apart = nullptr;

// The surface carries waves of 13 m and more over 8 m. Heave's local flow, which does not travel,
// is left out: 2/R - pi K (H_0 - Y_0)(K R) of a source, in the added mass of the longest waves.
TEST_F(DistantSpheres, AreCoupledAsOnOneSurface) {
  for (std::size_t k = 0; k < whole->frequencies.size(); ++k) {
    const double w = whole->frequencies[k];
    const Eigen::MatrixXd A = whole->added_mass[k] - apart->added_mass[k];
    const Eigen::MatrixXd B = whole->damping[k] - apart->damping[k];
    for (const int i : {int{surge}, int{heave}}) {
      for (const int j : {int{surge}, int{heave}}) {
        const auto size = [&](int mode) {
          return std::hypot(w * whole->added_mass[k](mode, mode), whole->damping[k](mode, mode));
        };
        EXPECT_LT(std::hypot(w * A(i, modes_per_body + j), B(i, modes_per_body + j)),
                  0.05 * std::sqrt(size(i) * size(j)))
            << w << " " << i << " " << j;
      }
    }
    const Eigen::MatrixXcd X = whole->excitation(k) - apart->excitation(k);
    for (const int i : {int{surge}, int{heave}}) {
      for (Eigen::Index h = 0; h < 2; ++h) {
        EXPECT_LT(std::abs(X(modes_per_body + i, h)),
                  0.05 * std::abs(whole->excitation(k)(modes_per_body + i, h)) + 0.02)
            << w << " " << i << " " << h;
      }
    }
    EXPECT_LT((whole->froude_krylov[k] - apart->froude_krylov[k]).norm(),
              1e-3 * whole->froude_krylov[k].norm());
  }
}

// Retardation functions tell the same damping as the figures at the frequencies.
TEST_F(DistantSpheres, AnswerInTimeAsInFrequency) {
  Eigen::MatrixXd A, B;
  for (const std::size_t k : {1U, 2U, 3U}) {
    calc_added_mass_and_damping(*apart, apart->frequencies[k], A, B);
    for (const int i : {int{surge}, int{heave}}) {
      EXPECT_NEAR(B(i, modes_per_body + i), apart->damping[k](i, modes_per_body + i),
                  0.05 * apart->damping[k](i, i) + 0.002)
          << apart->frequencies[k];
    }
  }
}

TEST(WaveInteraction, RefusesDatabasesWithoutTheirWaves) {
  EXPECT_THAT(
      [] {
        couple_by_waves({{{0}, {0, 0}, 1.0}}, {HydrodynamicDatabase{}}, {});
      },
      ThrowsMessage<ModelError>(HasSubstr("coupled by their far field")));
}

}  // namespace
}  // namespace blocklift::dynamics

#include "dynamics/marine/loads/hull_force.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/loads/resting_wave_force.h"
#include "dynamics/marine/loads/viscous.h"
#include "dynamics/marine/waves/wave_spectrum.h"
#include "pipeline/verification/models/random_mechanism.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using test::expect_balanced;
using test::OneBody;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double rho_g = 1025 * 9.81;
const Water deep = {.density = 1025, .gravity = 9.81};

std::shared_ptr<const HullClusters> box_of(const Vector3& size, int n) {
  return std::make_shared<const HullClusters>(make_box(size, {4 * n, 2 * n, 2 * n, 1}));
}
std::shared_ptr<const Sea> sea_of(WaveField waves, Current current = {}) {
  return std::make_shared<const Sea>(Sea{std::move(waves), std::move(current)});
}

TEST(HullForce, InStillWaterIsHydrostatics) {
  OneBody body;
  const HullForce hull({"barge", 1, box_of({12, 6, 3}, 2), sea_of(WaveField(deep))});
  body.q.head<3>() << 5, -3, 0.5;
  body.update();
  const ForceVector F = hull.calc_force(body.state());
  EXPECT_NEAR(F.force.z(), rho_g * 12 * 6 * 1.0, 1e-6);
  EXPECT_NEAR(F.moment.norm(), 0, 1e-6);
  examples::Random random(3);
  for (int i = 0; i < 20; ++i) {
    body.q = examples::random_configuration(random, body.mechanism);
    body.v = random.values(6, 1);
    body.update();
    expect_balanced(body, hull);
  }
}

// Waves without height: the linear interpolation over panels gives back the exact hydrostatics.
TEST(HullForce, VanishingWavesAreStillWater) {
  OneBody body;
  const auto clusters = box_of({12, 6, 3}, 3);
  const HullForce calm({"calm", 1, clusters, sea_of(WaveField(deep))});
  const HullForce wavy({"wavy", 1, clusters, sea_of(WaveField(deep, {{0, 1, 0, 0}}))});
  examples::Random random(4);
  for (int i = 0; i < 20; ++i) {
    body.q = examples::random_configuration(random, body.mechanism);
    body.q.head<3>() *= 0.7;
    body.update();
    const ForceVector a = calm.calc_force(body.state());
    const ForceVector b = wavy.calc_force(body.state());
    EXPECT_LT((a.force - b.force).norm(), 1e-9 * rho_g * 216);
    EXPECT_LT((a.moment - b.moment).norm(), 1e-9 * rho_g * 216 * 6);
  }
}

// A wave far longer than the box lifts the water bodily: the box feels the elevation as a change of
// draught, and the slope of the surface as a force along the wave (its weight on an incline).
TEST(HullForce, LongWavesAreAChangeOfDraught) {
  OneBody body;
  const double a = 0.4, omega = 0.05, k = omega * omega / 9.81;
  const HullForce hull(
      {"box", 1, box_of({12, 6, 3}, 3), sea_of(WaveField(deep, {{a, omega, 0, 0}}))});
  body.update();
  const double draught = 1.5;
  EXPECT_NEAR(hull.calc_force(body.state()).force.z(), rho_g * 72 * (draught + a),
              3 * k * draught * rho_g * 72 * a);
  body.time = 0.5 * std::numbers::pi / omega;  // eta = 0 at the middle, deta/dx = a k
  const ForceVector F = hull.calc_force(body.state());
  EXPECT_NEAR(F.force.x(), -rho_g * 72 * draught * a * k, 0.02 * rho_g * 72 * draught * a * k);
}

// Gauss' theorem: where the whole body is wet, its volume times the pressure's gradient.
TEST(HullForce, UnderAPlaneIsThatOfThePressuresGradient) {
  OneBody body;
  const HullForce hull({"box", 1, box_of({12, 6, 3}, 2), sea_of(WaveField(deep))});
  examples::Random random(7);
  for (int i = 0; i < 20; ++i) {
    body.q = examples::random_configuration(random, body.mechanism);
    body.q.head<3>() << 4, -7, -20;
    body.update();
    const WaterPlane plane{{3, -5}, 1.5, {0.1, -0.2}};
    const ForceVector F = hull.calc_force(body.state(), plane);
    const Vector3 expected = rho_g * 12 * 6 * 3 * Vector3(-0.1, 0.2, 1.0);
    EXPECT_LT((F.force - expected).norm(), 1e-9 * expected.norm());
    EXPECT_LT(F.moment.norm(), 1e-8 * expected.norm());
  }
}

// A level plane is a change of draught, wherever its place is; waves that are 628 times as long as
// the hull differ from their plane by their curvature and by how they decay with depth alone.
TEST(HullForce, UnderThePlaneOfLongWavesIsTheirs) {
  OneBody body;
  const auto clusters = box_of({4, 2, 1}, 8);
  const double k = 0.0025;
  const WaveField waves(deep, {{2.0, std::sqrt(9.81 * k), 0.7, 0.4}});
  const HullForce hull({"boat", 1, clusters, sea_of(waves)});
  const WaterPlaneOfWaves planes(clusters->hull(), waves);
  const double t = 13.0;  // the waves are at their steepest
  body.q.head<3>() << 50, -30, 0.1 + waves.calc_elevation(t, 50, -30);
  body.update();
  const MotionState state{t, body.q, body.v, body.state().kinematics};
  const WaterPlane plane = planes.calc(t, state.kinematics.X_WB[1]);
  EXPECT_NEAR(plane.height, waves.calc_elevation(t, plane.place.x(), plane.place.y()), 2e-5);
  const auto elevation = [&](double dx, double dy) {
    return waves.calc_elevation(t, plane.place.x() + dx, plane.place.y() + dy);
  };
  EXPECT_NEAR(plane.slope.x(), 0.5 * (elevation(1, 0) - elevation(-1, 0)), 1e-7);
  EXPECT_NEAR(plane.slope.y(), 0.5 * (elevation(0, 1) - elevation(0, -1)), 1e-7);
  const ForceVector F = hull.calc_force(state);
  EXPECT_LT((hull.calc_force(state, plane) - F).force.norm(), 0.01 * F.force.norm());
  const WaterPlane level{{9, 9}, 0.3, {0, 0}};
  const ForceVector raised = hull.calc_force(state, level);
  body.q[2] -= 0.3;
  body.update();
  const ForceVector lowered = hull.calc_force(body.state(), WaterPlane{});
  EXPECT_LT((raised - lowered).force.norm(), 1e-12 * rho_g * 8);
  EXPECT_LT((raised - lowered).moment.norm(), 1e-12 * rho_g * 8);
}

TEST(HullForce, OfAHullThatDriftsHasNoPartAlongTheWater) {
  OneBody body;
  HullForce::Definition d{"box", 1, box_of({12, 6, 3}, 2),
                          sea_of(WaveField(deep, {{0.4, 0.9, 0.5, 0.2}}))};
  const HullForce whole(d);
  d.p_BoR_B = Vector3(1, -0.5, 1.2);
  const HullForce drifting(d);
  examples::Random random(8);
  for (int i = 0; i < 20; ++i) {
    body.q = examples::random_configuration(random, body.mechanism);
    body.q.head<3>() *= 0.7;
    body.v = random.values(6, 1);
    body.time = 0.7 * i;
    body.update();
    const Vector3 r = body.kinematics.X_WB[1].R * *d.p_BoR_B;
    const ForceVector all = shift_to(whole.calc_force(body.state()), -r);
    const ForceVector left = shift_to(drifting.calc_force(body.state()), -r);
    const double size = 1e-9 * rho_g * 216;
    EXPECT_LT((left.force - Vector3(0, 0, all.force.z())).norm(), size);
    EXPECT_LT((left.moment - Vector3(all.moment.x(), all.moment.y(), 0)).norm(), 10 * size);
    expect_balanced(body, drifting);
  }
}

// A box that heaves by h sin(w t) in the wave a cos(k x - w t): its bottom, of breadth B along the
// wave, leaves out water whose acceleration is in time with it, so that the whole pressure has the
// mean rho g a h L exp(-k T) sin(k B/2) along the wave, from rho int a dV. It is a part of the mean
// drift, which a hull that drifts must not add to it. Over faces in the error of their integrals,
// far below 2 %.
TEST(HullForce, OfAHullThatDriftsHasNoMeanAlongTheWater) {
  OneBody body;
  const double a = 0.02, h = 0.05, k = 2 * std::numbers::pi / 24, w = std::sqrt(9.81 * k);
  HullForce::Definition d{"box", 1, box_of({12, 6, 3}, 3), sea_of(WaveField(deep, {{a, w, 0, 0}}))};
  const HullForce whole(d);
  d.p_BoR_B = Vector3::Zero();
  const HullForce drifting(d);
  constexpr int instants = 16;
  double mean = 0, mean_of_drifting = 0;
  for (int i = 0; i < instants; ++i) {
    const double phase = 2 * std::numbers::pi * i / instants;
    body.time = phase / w;
    body.q[2] = h * std::sin(phase);
    body.update();
    mean += whole.calc_force(body.state()).force.x() / instants;
    mean_of_drifting += drifting.calc_force(body.state()).force.x() / instants;
  }
  const double exact = rho_g * a * h * 6 * std::exp(-1.5 * k) * std::sin(6 * k);
  EXPECT_NEAR(mean, exact, 0.02 * exact);
  EXPECT_NEAR(mean_of_drifting, 0.0, 1e-9 * exact);
}

// Vertices moved by so little that nothing is felt, but no panels lie in one plane any more.
Hull unevened(const Hull& hull) {
  Hull result;
  double i = 0;
  for (const Vector3& vertex : hull.vertices()) {
    i += 1;
    result.add_vertex(vertex + 1e-6 * Vector3(std::sin(i), std::sin(2 * i), std::sin(3.7 * i)));
  }
  for (int panel = 0; panel < hull.panel_count(); ++panel) result.add_panel(hull.panel(panel));
  return result;
}

// Froude-Krylov force on a small box by its closed form: p_d integrated over a flat bottom,
// sin(kL/2)/(kL/2) along the wave; the sides add nothing upright.
class SmallBox : public ::testing::Test {
 protected:
  double error_of(const Hull& hull) {
    const double a = 1e-4, k = 2 * std::numbers::pi / 24, omega = std::sqrt(9.81 * k);
    const double draught = 1.5;
    const double exact = rho_g * a * std::exp(-k * draught) * 72 * std::sin(6 * k) / (6 * k);
    const HullForce force({"box", 1, std::make_shared<const HullClusters>(hull),
                           sea_of(WaveField(deep, {{a, omega, 0, 0}}))});
    body_.update();
    const double from_waves = force.calc_force(body_.state()).force.z() - rho_g * 72 * draught;
    return std::abs(from_waves - exact) / exact;
  }
  static Hull box(int n) { return make_box({12, 6, 3}, {4 * n, 2 * n, 2 * n, 1}); }

 private:
  OneBody body_;
};

// Few panels converge with order 2; of many the bottom becomes a box that is taken whole, to its
// tolerance, as it is of faces whatever the panels that they were joined of.
TEST_F(SmallBox, MeetsTheClosedForm) {
  EXPECT_NEAR(std::log2(error_of(unevened(box(1))) / error_of(unevened(box(2)))), 2.0, 0.1);
  EXPECT_LT(error_of(unevened(box(4))), WaveSurface::box_tolerance);
  for (const int n : {2, 4}) EXPECT_LT(error_of(box(n)), WaveSurface::box_tolerance);
}

// A barge in waves: faces against ever finer panels, whose distance falls with the square of their
// size until the faces' own error shows, below 1e-4 of the buoyancy.
TEST(HullForce, FacesAreWherePanelsConvergeTo) {
  OneBody body;
  const auto sea = sea_of(WaveField(deep, {{0.8, 0.628, 0.785, 0}}));
  body.q.head<3>() << 0, 0, -1;
  body.q.tail<4>() << 1, 0.02, 0.03, 0.1;
  body.q.tail<4>().normalize();
  const auto force_of = [&](const Hull& hull) {
    const HullForce force({"barge", 1, std::make_shared<const HullClusters>(hull), sea});
    Eigen::Matrix<double, 6, 4> forces;
    for (int i = 0; i < 4; ++i) {
      body.time = 2.6 * i;
      body.update();
      const ForceVector F = force.calc_force(body.state());
      forces.col(i) << F.moment / 20, F.force;
    }
    return forces;
  };
  const auto barge_of = [](double size) {
    return make_barge(
        {.length = 40, .breadth = 20, .depth = 5, .bow_rake_length = 4, .bow_rake_height = 2},
        PanelDivision::of_size(size, 40, 20, 5));
  };
  const auto faces = force_of(barge_of(1));
  const double buoyancy = faces.row(5).maxCoeff();
  std::vector<double> distances;
  for (const double size : {4.0, 2.0, 1.0}) {
    const auto panels = force_of(unevened(barge_of(size)));
    distances.push_back((panels - faces).cwiseAbs().maxCoeff() / buoyancy);
  }
  EXPECT_GT(std::log2(distances[0] / distances[2]) / 2, 1.8);  // more where boxes take over
  EXPECT_LT(distances[2], 1e-4);
}

// What is taken off a whole excitation is what low waves put back, panels of any size: cut by the
// water, heeled, as panels and as faces. Waves of opposite height leave the first order alone.
TEST(RestingWaveForce, IsWhatTheHullForceHasInLowWaves) {
  OneBody body;
  body.q.head<3>() << 3, -2, -0.3;
  body.q.tail<4>() << 1, 0.02, 0.03, 0.1;
  body.q.tail<4>().normalize();
  body.update();
  const Pose X_WB = body.state().kinematics.X_WB[1];
  const Water shallow = {.density = 1025, .gravity = 9.81, .depth = 12};
  const double a = 1e-4, heading = 1.1;
  const Hull barge = make_barge({.length = 40, .breadth = 24, .depth = 8}, {5, 3, 2, 1});
  for (const double omega : {0.15, 1.4}) {  // faces, and panels longer than a wave's quarter
    for (const Hull& hull : {barge, unevened(barge)}) {
      const WaveField waves(shallow, {{a, omega, heading, 0}});
      const HullForce force(
          {"barge", 1, std::make_shared<const HullClusters>(hull), sea_of(waves)});
      const auto force_at = [&](double phase) {
        body.time = phase / omega;
        body.update();
        const ForceVector F = force.calc_force(body.state());
        Eigen::Matrix<double, 6, 1> both;
        both << F.force, F.moment;
        return both;
      };
      const double half = std::numbers::pi, quarter = 0.5 * half;
      Eigen::Matrix<std::complex<double>, 6, 1> expected;
      expected.real() = (force_at(0.0) - force_at(half)) / (2.0 * a);
      expected.imag() = (force_at(half + quarter) - force_at(quarter)) / (2.0 * a);
      const Eigen::Matrix<std::complex<double>, 6, 1> found =
          RestingWaveForce(WaveSurface(hull, waves), X_WB, X_WB.p)
              .calc_force(shallow, omega, heading);
      const double heave = rho_g * 40 * 24;
      EXPECT_LT((found - expected).head<3>().norm(), 2 * WaveSurface::box_tolerance * heave);
      EXPECT_LT((found - expected).tail<3>().norm(), 2 * WaveSurface::box_tolerance * heave * 20);
      EXPECT_GT(found.head<3>().norm(), 0.01 * heave);
    }
  }
}

class IrregularSea : public ::testing::Test {
 protected:
  static std::shared_ptr<const Sea> sea(double spreading, double depth) {
    const Water water = {.density = 1025, .gravity = 9.81, .depth = depth};
    SeaRealisation how = {.heading = 0.6, .components = 60, .seed = 4};
    if (spreading > 0) how.spreading_exponent = spreading;
    return sea_of(realise(WaveSpectrum::jonswap(2, 8), water, how));
  }
  static Hull barge(double size) {
    return make_barge(
        {.length = 40, .breadth = 20, .depth = 5, .bow_rake_length = 4, .bow_rake_height = 2},
        PanelDivision::of_size(size, 40, 20, 5));
  }
  Pose place(double time) {
    body_.q.head<3>() << 0.3 * time, 0, -1 + 0.3 * std::sin(0.7 * time);
    body_.q.tail<4>() << 1, 0.02 * std::cos(0.6 * time), 0.03, 0.1;
    body_.q.tail<4>().normalize();
    body_.time = time;
    body_.update();
    return body_.kinematics.X_WB[1];
  }
  HullForce force(const Hull& hull, const std::shared_ptr<const Sea>& sea) const {
    return HullForce({"barge", 1, std::make_shared<const HullClusters>(hull), sea});
  }
  Eigen::Matrix<double, 6, 1> at(const HullForce& force, double time) {
    place(time);
    const ForceVector F = force.calc_force(body_.state());
    Eigen::Matrix<double, 6, 1> values;
    values << F.moment / 20, F.force;
    return values;
  }
  static constexpr double weight = rho_g * 40 * 20 * 2.3;

 private:
  OneBody body_;
};

// Against the same sum with every panel taken for itself at its vertices by the exact functions:
// what the boxes of deep panels and the carriers leave, far below what panels themselves leave.
TEST_F(IrregularSea, BoxesAndPanelsConvergeTogether) {
  for (const double spreading : {0.0, 2.0}) {
    const auto water = sea(spreading, spreading > 0 ? 12 : 1e3);
    std::vector<double> errors;
    const HullForce finest = force(unevened(barge(1)), water);
    for (const double size : {4.0, 2.0}) {
      const HullForce coarse = force(unevened(barge(size)), water);
      double square = 0;
      for (int i = 0; i < 6; ++i) {
        square += (at(coarse, 5.3 * i) - at(finest, 5.3 * i)).squaredNorm() / 6;
      }
      errors.push_back(std::sqrt(square) / weight);
    }
    EXPECT_LT(errors[0], 1e-2);
    EXPECT_GT(errors[0] / errors[1], 2.5);
  }
}

// Boxes open and close as waves pass. What an integrator sees of it is a kink or step in second
// differences.
TEST_F(IrregularSea, ForceIsSmooth) {
  const auto water = sea(2.0, 1e3);
  const HullForce hull = force(unevened(barge(2)), water);
  constexpr double step = 1e-3;
  double worst = 0;
  for (double t = 3; t < 5; t += 2 * step) {
    worst = std::max(worst, (at(hull, t + step) - 2 * at(hull, t) + at(hull, t - step)).norm());
  }
  EXPECT_LT(worst / weight, 5e-6);
}

TEST_F(IrregularSea, SurfaceStaysInItsRange) {
  for (const double spreading : {0.0, 2.0}) {
    const auto water = sea(spreading, 1e3);
    const Vector3 half(20, 10, 2.5);
    const SurfaceRange range(Vector3(0, 0, 0), half, water->waves);
    int beyond = 0, count = 0;
    double width = 0;
    for (int i = 0; i < 200; ++i) {
      const Pose X_WB = place(11.0 * i);
      const auto [low, high] = range.calc_range(11.0 * i, X_WB, water->waves);
      width += (high - low) / 200;
      for (double x = -20; x <= 20; x += 2.3) {
        for (double y = -10; y <= 10; y += 2.9) {
          const Vector3 p = X_WB.apply({x, y, 0});
          const double elevation = water->waves.calc_elevation(11.0 * i, p.x(), p.y());
          beyond += elevation < low || elevation > high ? 1 : 0;
          ++count;
        }
      }
    }
    EXPECT_LT(beyond, 1e-3 * count);
    EXPECT_LT(width, 0.5 * 2 * water->waves.highest_elevation());
  }
}

TEST(HullForce, BalancesInWavesAndCanLeaveThemToOthers) {
  OneBody body;
  const auto sea = sea_of(realise(WaveSpectrum::jonswap(2, 8), deep, {.components = 20}));
  const auto clusters = box_of({12, 6, 3}, 2);
  const HullForce hull({"barge", 1, clusters, sea});
  const HullForce without({"barge", 1, clusters, sea, WaveLoading::none});
  const HullForce calm({"barge", 1, clusters, sea_of(WaveField(deep))});
  examples::Random random(5);
  for (int i = 0; i < 10; ++i) {
    body.q = examples::random_configuration(random, body.mechanism);
    body.v = random.values(6, 1);
    body.time = 3.0 * i;
    body.update();
    expect_balanced(body, hull);
    EXPECT_EQ(without.calc_force(body.state()).force, calm.calc_force(body.state()).force);
  }
}

TEST(HullForce, IsZeroAboveTheCrests) {
  OneBody body;
  const HullForce hull(
      {"barge", 1, box_of({12, 6, 3}, 2), sea_of(WaveField(deep, {{1, 0.7, 0, 0}}))});
  body.q.head<3>() << 0, 0, 2.6;
  body.update();
  EXPECT_EQ(hull.calc_force(body.state()).force.norm(), 0);
}

TEST(HullForce, RefusesTheWorld) {
  EXPECT_THAT(
      [] {
        HullForce({"h", 0, box_of({1, 1, 1}, 1), sea_of(WaveField(deep))});
      },
      ThrowsMessage<ModelError>(HasSubstr("acts on the world")));
}

// 1/2 rho C D u^2 over the 6 m of a 10 m pile that stand in a current of 2 m/s; the part along the
// axis of a slanted one is left out.
TEST(MorisonMember, DragOfACurrentOnAPile) {
  OneBody body;
  const auto sea = sea_of(WaveField(deep), Current::uniform(2, 0));
  MorisonMember::Definition d = {"pile", 1, {0, 0, -6}, {0, 0, 4}, 0.5, 1.0, 7, sea};
  body.update();
  const MorisonMember pile(d);
  const ForceVector F = pile.calc_force(body.state());
  const double line_load = 0.5 * 1025 * 0.5 * 4;
  EXPECT_LT((F.force - Vector3(line_load * 6, 0, 0)).norm(), 1e-8);
  EXPECT_NEAR(F.moment.y(), -line_load * 6 * 3, 1e-8);
  d.p_BoP_B = {-4, 0, -7};
  d.p_BoQ_B = {0, 0, -3};
  const ForceVector slanted = MorisonMember(d).calc_force(body.state());
  const double normal = 0.5 * 1025 * 0.5 * 2 * std::sqrt(32);  // u_n^2 = 2
  EXPECT_LT((slanted.force - normal * Vector3(1, 0, -1) / std::sqrt(2)).norm(), 1e-8);
  body.v.setRandom();
  body.update();
  expect_balanced(body, pile);
  EXPECT_THAT(
      [&] {
        d.p_BoQ_B = d.p_BoP_B;
        MorisonMember m(d);
      },
      ThrowsMessage<ModelError>(HasSubstr("two ends coincide")));
}

TEST(QuadraticDamping, BrakesInTheAxesOfTheBodyWhileItIsWet) {
  OneBody body;
  QuadraticDamping::Definition d;
  d.name = "roll";
  d.point = {1, Vector3::Zero()};
  d.linear << 10, 0, 0, 0, 0, 0;
  d.quadratic << 1000, 0, 0, 0, 50, 0;
  d.sea = sea_of(WaveField(deep), Current::uniform(1, 0));
  d.hull = box_of({12, 6, 3}, 1);
  d.reference_volume = 12 * 6 * 1.5;
  const QuadraticDamping damping(d);
  // Turned by 90 degrees about z: the body's x is the world's y.
  body.q.tail<4>() << std::sqrt(0.5), 0, 0, std::sqrt(0.5);
  body.v << 0.2, 0, 0, 0, 0, 0;  // rolls
  body.update();
  damping.add_forces(body.state(), body.loads);
  const ForceVector& F = body.loads.F_Bo_W[1];
  const Vector3 roll_axis = body.kinematics.X_WB[1].R.col(0);
  const double rate = body.kinematics.V_WB[1].angular.dot(roll_axis);
  EXPECT_NEAR(F.moment.dot(roll_axis), -(10 * rate + 1000 * std::abs(rate) * rate), 1e-9);
  // The current of 1 m/s along W's x pushes against the body's y axis.
  EXPECT_LT((F.force - Vector3(50, 0, 0)).norm(), 1e-9);
  body.v.setRandom();
  body.update();
  expect_balanced(body, damping);
  EXPECT_GT(damping.calc_energy(body.state()).dissipated_power, 0);
  body.q.head<3>() << 0, 0, 5;  // dry
  body.update();
  body.loads.set_zero();
  damping.add_forces(body.state(), body.loads);
  EXPECT_EQ(body.loads.F_Bo_W[1].force.norm(), 0);
}

}  // namespace
}  // namespace blocklift::dynamics

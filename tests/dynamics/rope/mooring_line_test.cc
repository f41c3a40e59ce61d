#include "dynamics/rope/mooring_line.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/rope/rope.h"
#include "tests/dynamics/force/one_body.h"

namespace blocklift::dynamics {
namespace {

using test::expect_balanced;
using test::OneBody;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Irvine (1981), sec. 2.3: an elastic catenary between level supports under its own weight. With
// the level force H given, the span is  H L0/EA + 2 H/w asinh(w L0/(2H)),  each end carries half
// the weight, the sag at the middle is  w L0^2/(8 EA) + H/w (sqrt(1 + (w L0/2H)^2) - 1).
TEST(Catenary, LevelSupports) {
  const double L0 = 200, w = 800, EA = 4e7;
  for (const double H : {2e3, 2e4, 2e5, 4e6}) {
    const double span = H * L0 / EA + 2 * H / w * std::asinh(w * L0 / (2 * H));
    const Catenary c = calc_catenary({L0, w, EA}, span, 0);
    EXPECT_NEAR(c.horizontal, H, 1e-8 * H);
    EXPECT_NEAR(c.vertical, w * L0 / 2, 1e-8 * (w * L0 + H));
    EXPECT_NEAR(c.lower_vertical, -w * L0 / 2, 1e-8 * (w * L0 + H));
    // Half the line is a line from the lowest point: its rise is the sag.
    const double sag =
        w * L0 * L0 / (8 * EA) + H / w * (std::sqrt(1 + std::pow(w * L0 / (2 * H), 2)) - 1);
    const Catenary half = calc_catenary({L0 / 2, w, EA}, span / 2, sag);
    EXPECT_NEAR(half.horizontal, H, 1e-7 * H);
    EXPECT_NEAR(half.lower_vertical, 0, 1e-7 * (w * L0 + H));
  }
}

// Irvine's profile for any end forces (eq. 2.23, 2.24), evaluated forwards; the solver goes back.
TEST(Catenary, FindsForcesOfTheProfile) {
  const double L0 = 300, w = 500, EA = 5e7, W = w * L0;
  for (const double H : {1e3, 3e4, 1e6}) {
    for (const double V : {-0.5 * W, 0.3 * W, 1.0 * W, 3.0 * W}) {
      const double span = H * L0 / EA + H / w * (std::asinh(V / H) - std::asinh((V - W) / H));
      const double rise =
          W * L0 / EA * (V / W - 0.5) + H / w * (std::hypot(1, V / H) - std::hypot(1, (V - W) / H));
      const Catenary c = calc_catenary({L0, w, EA}, span, rise);
      EXPECT_NEAR(c.horizontal, H, 1e-7 * (H + W)) << H << ' ' << V / W;
      EXPECT_NEAR(c.vertical, V, 1e-7 * (H + W)) << H << ' ' << V / W;
    }
  }
}

// On the bottom: with the length S hanging, V = w S, and span and rise follow (Jonkman 2007, B-3).
TEST(Catenary, LiesOnTheBottom) {
  const double L0 = 600, w = 1000, EA = 3e8;
  for (const double H : {500.0, 5e4, 8e5}) {
    for (const double S : {80.0, 300.0, 590.0}) {
      const double V = w * S;
      const double span = L0 - S + H / w * std::asinh(V / H) + H * L0 / EA;
      const double rise = H / w * (std::hypot(1, V / H) - 1) + V * V / (2 * EA * w);
      const Catenary c = calc_catenary({L0, w, EA, true}, span, rise);
      EXPECT_NEAR(c.horizontal, H, 1e-7 * (H + V));
      EXPECT_NEAR(c.lying_length, L0 - S, 1e-6 * L0);
      EXPECT_EQ(c.lower_vertical, 0);
    }
  }
  // Lifted off: the anchor is pulled up.
  EXPECT_GT(calc_catenary({100, w, EA, true}, 60, 85).lower_vertical, 0);
  EXPECT_EQ(calc_catenary({100, w, EA, true}, 60, 85).lying_length, 0);
  // A heap below the upper end: only what hangs pulls.
  const Catenary heap = calc_catenary({100, w, EA, true}, 20, 50);
  EXPECT_EQ(heap.horizontal, 0);
  EXPECT_NEAR(heap.vertical, w * 50, 0.01 * w * 50);
}

// Over all regimes and their boundaries: no jumps, the forces are the slope of the energy, the
// stiffness that of the forces.
TEST(Catenary, ForcesAreTheSlopeOfTheEnergy) {
  const double step = 1e-3;
  for (const bool on_seabed : {true, false}) {
    const CatenaryLine line = {100, 1000, 1e7, on_seabed};
    Catenary last = calc_catenary(line, 1, 40);
    for (double span = 1.05; span < 96; span += 0.37) {
      const Catenary c = calc_catenary(line, span, 40);
      EXPECT_LT(std::abs(c.vertical - last.vertical), 0.5e5);
      last = c;
      const auto at = [&](double x, double z) { return calc_catenary(line, span + x, 40 + z); };
      EXPECT_NEAR(c.horizontal, (at(step, 0).energy - at(-step, 0).energy) / (2 * step),
                  1e-4 * (1e4 + c.tension));
      EXPECT_NEAR(c.vertical, (at(0, step).energy - at(0, -step).energy) / (2 * step),
                  1e-4 * (1e4 + c.tension));
      const double near_corner = std::abs(100 - 39.2 - span);  // the heap begins: a kink
      if (on_seabed && near_corner < 2) continue;
      EXPECT_NEAR(c.stiffness(0, 0),
                  (at(step, 0).horizontal - at(-step, 0).horizontal) / (2 * step),
                  1e-3 * (1e3 + c.stiffness(0, 0)));
      EXPECT_NEAR(c.stiffness(0, 1),
                  (at(0, step).horizontal - at(0, -step).horizontal) / (2 * step),
                  1e-3 * (1e3 + c.stiffness(0, 0)));
    }
  }
}

// Plumb, taut, from either end: each piece bears what is below it. From above it is the line turned
// about, with the energy counted from the other end.
TEST(Catenary, HangsPlumbFromEitherEnd) {
  const CatenaryLine line = {60, 900, 5e8};
  const double W = line.weight_per_length * line.unstretched_length;
  for (const double lower : {1e3, 2e5, 3e6}) {
    const double stretched = 60 * (1 + (lower + W / 2) / line.axial_stiffness);
    const Catenary up = calc_catenary(line, 0, stretched);
    EXPECT_NEAR(up.lower_vertical, lower, 1e-3);
    EXPECT_NEAR(up.vertical, lower + W, 1e-3);
    EXPECT_NEAR(up.stiffness(1, 1), line.axial_stiffness / 60, 1e-3 * line.axial_stiffness / 60);
    const Catenary down = calc_catenary(line, 0, -stretched);
    EXPECT_NEAR(down.vertical, -lower, 1e-3);
    EXPECT_NEAR(down.lower_vertical, -lower - W, 1e-3);
    EXPECT_NEAR(down.tension, lower, 1e-3);
    EXPECT_NEAR(down.energy, up.energy - W * stretched, 1e-6 * W * stretched);
  }
  const double step = 1e-4;
  for (const double rise : {-30.0, -59.9, -60.02}) {
    const Catenary c = calc_catenary(line, 3, rise);
    const auto at = [&](double x, double z) { return calc_catenary(line, 3 + x, rise + z); };
    EXPECT_NEAR(c.vertical, (at(0, step).energy - at(0, -step).energy) / (2 * step),
                1e-4 * (1e4 + c.lower_tension));
    EXPECT_NEAR(c.stiffness(0, 1), (at(0, step).horizontal - at(0, -step).horizontal) / (2 * step),
                1e-3 * (1e3 + c.stiffness(1, 1)));
    EXPECT_NEAR(c.stiffness(0, 1), (at(step, 0).vertical - at(-step, 0).vertical) / (2 * step),
                1e-3 * (1e3 + c.stiffness(1, 1)));
  }
}

// Nearly weightless: a spring of stiffness EA/L0.
TEST(Catenary, BecomesASpringWhenTaut) {
  const Catenary c = calc_catenary({100, 1e-3, 1e6}, 61.2, 81.6);  // 102 m, 2 % long
  // The line weighs 0.1 N.
  EXPECT_NEAR(c.tension, 0.02 * 1e6, 0.1);
  EXPECT_NEAR(c.horizontal, 0.6 * c.tension, 0.1);
}

TEST(MooringLine, BalancesOnABody) {
  OneBody body;
  const MooringLine anchored(
      {"m1", {world_index, {-300, 40, -50}}, {1, {1, 2, -0.5}}, {330, 1200, 4e8, true}});
  const MooringLine hanging(
      {"m2", {world_index, {-60, 10, -5}}, {1, {1, 2, -0.5}}, {70, 1200, 4e8}});
  const TuggerLine tugger({"t", {world_index, {-5, 0, 3}}, {1, {0.5, 0, 0}}, 1e4, 300, 5.0});
  const TuggerLine holding({"h", {world_index, {-5, 0, 3}}, {1, {0.5, 0, 0}}, 0, 300, 0, 2e4});
  body.q.tail<4>() << 0.9, 0.1, -0.3, 0.2;
  body.v.setRandom();
  for (const double x : {-30.0, 0.0, 20.0}) {
    body.q[0] = x;
    body.update();
    expect_balanced(body, anchored, 1e-5);
    expect_balanced(body, hanging, 1e-5);
    expect_balanced(body, tugger);
    expect_balanced(body, holding);
  }
}

TEST(MooringLine, RefusesWhatCannotBe) {
  EXPECT_THAT(
      [] {
        MooringLine({"m7", {world_index, {0, 0, 0}}, {1, {0, 0, 0}}, {-5, 1, 1}});
      },
      ThrowsMessage<ModelError>(HasSubstr("line \"m7\" has the unstretched length -5")));
  EXPECT_THAT(
      [] {
        MooringLine({"m7", {1, {0, 0, 0}}, {2, {0, 0, 0}}, {5, 1, 1, true}});
      },
      ThrowsMessage<ModelError>(HasSubstr("lies on the bottom")));
}

TEST(TuggerLine, PullsAndNeverPushes) {
  OneBody body;
  const TuggerLine tugger({"t", {world_index, Vector3::Zero()}, {1, Vector3::Zero()}, 100, 3, 2});
  body.q.head<3>() << 0, 0, 4;
  body.update();
  EXPECT_NEAR(tugger.calc_tension(body.state()), 200, 1e-12);
  body.q.head<3>() << 0, 0, 1.5;
  body.update();
  EXPECT_EQ(tugger.calc_tension(body.state()), 0);
}

// Its law is the one of ropes: at any state it pulls as a rope of the same stiffness and damping.
TEST(TuggerLine, PullsAsARope) {
  OneBody body;
  const BodyPoint from{world_index, {-5, 0, 3}}, to{1, {0.5, 0, 0}};
  const TuggerLine tugger({"t", from, to, 1e4, 300, 5.0});
  const Rope rope(body.mechanism, {.name = "r",
                                   .points = {from, to},
                                   .axial_stiffness = 5e4,
                                   .damping = 300,
                                   .unstretched_length = 5.0});
  RopePath path = make_rope_path({rope});
  int pulling = 0, held_by_damping = 0;
  for (const double x : {-4.0, -1.4, -1.0, 0.0, 2.0}) {
    for (const double speed : {-40.0, -3.0, 0.0, 3.0, 40.0}) {
      body.q[0] = x;
      body.v.setZero();
      body.v[3] = speed;
      body.update();
      rope.calc_path(body.kinematics, path);
      const RopeLoad load = rope.calc_load(path, {.unstretched_length = 5.0});
      EXPECT_NEAR(tugger.calc_tension(body.state()), load.tension, 1e-9 * (1.0 + load.tension));
      pulling += load.tension > 0.0 ? 1 : 0;
      held_by_damping += load.elastic_force > 0.0 && load.tension == 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(pulling, 5);
  EXPECT_GT(held_by_damping, 0);
}

// A winch that holds a tension: the same at any length, more while it pays out, never a push.
TEST(TuggerLine, HoldsATension) {
  OneBody body;
  const TuggerLine tugger({"t", {world_index, Vector3::Zero()}, {1, Vector3::Zero()}, 0, 3, 0, 50});
  for (const double height : {4.0, 40.0}) {
    body.q.head<3>() << 0, 0, height;
    body.v.setZero();
    body.update();
    EXPECT_NEAR(tugger.calc_tension(body.state()), 50, 1e-12);
    body.v[5] = 2;
    body.update();
    EXPECT_NEAR(tugger.calc_tension(body.state()), 56, 1e-12);
    EXPECT_NEAR(tugger.calc_energy(body.state()).supplied_power, -100, 1e-12);
    EXPECT_NEAR(tugger.calc_energy(body.state()).dissipated_power, 12, 1e-12);
    body.v[5] = -20;
    body.update();
    EXPECT_EQ(tugger.calc_tension(body.state()), 0);
  }
  EXPECT_THAT(
      [] {
        TuggerLine({"t", {world_index, Vector3::Zero()}, {1, Vector3::Zero()}, 10, 3, 0, 50});
      },
      ThrowsMessage<ModelError>(HasSubstr("holds a tension and has a stiffness")));
}

}  // namespace
}  // namespace blocklift::dynamics

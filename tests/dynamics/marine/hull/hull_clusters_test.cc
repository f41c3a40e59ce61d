// Panels of one plane joined, and boxes of panels that stand for what they hold.
#include "dynamics/marine/hull/hull_clusters.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/marine/hull/hull_faces.h"
#include "dynamics/marine/hull/hull_shapes.h"
#include "dynamics/marine/loads/pressure_boxes.h"
#include "dynamics/marine/loads/wave_surface.h"

namespace blocklift::dynamics {
namespace {

Hull sample_barge() {
  return make_barge({.length = 110, .breadth = 46, .depth = 7.5, .bilge_radius = 0.8},
                    PanelDivision::of_size(3, 110, 46, 7.5));
}

SurfaceMoments moments_of(const Hull& hull) {
  return TriangleTree(hull).moments(TriangleTree::root);
}

TEST(HullFaces, ABoxHasFew) {
  const Hull box = make_box({12, 6, 3}, {12, 6, 3, 1});
  const Hull joined = join_flat_panels(box);
  EXPECT_LE(joined.panel_count(), 24);  // of 252
  EXPECT_NEAR(calc_enclosed_volume(joined).volume, 216.0, 1e-10);
}

// All integrals up to the second order stay, on fewer triangles by far.
TEST(HullFaces, SurfaceIntegralsStayTheSame) {
  const Hull barge = sample_barge();
  const Hull joined = join_flat_panels(barge);
  EXPECT_LT(10 * joined.panel_count(), barge.panel_count());
  const SurfaceMoments a = moments_of(barge), b = moments_of(joined);
  const double area = 110 * 46;
  EXPECT_LT((a.N - b.N).norm(), 1e-9 * area);
  EXPECT_LT((a.Q - b.Q).norm(), 1e-9 * area * 50);
  EXPECT_LT((a.T - b.T).norm(), 1e-9 * area * 50 * 50);
}

// A panel that is bent stays as it is.
TEST(HullFaces, CurvedPanelsStayApart) {
  const Hull ship = make_ship({.length = 20,
                               .breadth = 6,
                               .depth = 4,
                               .draught = 2.5,
                               .bow_length = 6,
                               .stern_length = 5,
                               .transom_breadth = 4},
                              {12, 4, 4, 2});
  const SurfaceMoments a = moments_of(ship), b = moments_of(join_flat_panels(ship));
  EXPECT_LT((a.T - b.T).norm(), 1e-8 * 20 * 6 * 100);
}

// Divided to a size, a surface is as it was.
TEST(HullFaces, DivideToASizeAndStayTheSame) {
  const Hull joined = join_flat_panels(sample_barge());
  const Hull divided = divide_flat_panels(joined, 15);
  const SurfaceMoments a = moments_of(joined), b = moments_of(divided);
  EXPECT_LT((a.T - b.T).norm(), 1e-9 * 110 * 46 * 50 * 50);
  double longest = 0;
  for (int panel = 0; panel < divided.panel_count(); ++panel) {
    longest = std::max(longest, divided.panel_diameter(panel));
  }
  EXPECT_LT(longest, 15 * (1 + 1e-9));
  EXPECT_GT(longest, 12);
}

TEST(WaveSurface, SagsBetweenCorners) {
  const WaveField regular(Water{}, {{0.5, 0.628, 0.785, 0}});
  const double d = calc_sagging_length(regular, 0.08);
  EXPECT_NEAR(regular.wave_number(0) * d, 0.8, 1e-9);  // (k d)^2 / 8 = 0.08
  // Half the energy in ripples: sqrt(1/2) of the amplitude is past recall whatever the length.
  const WaveField ripples(Water{}, {{0.5, 0.628, 0, 0}, {0.5, 30, 0, 0}});
  EXPECT_LT(calc_sagging_length(ripples, 0.08), 0.1);
  EXPECT_TRUE(std::isinf(calc_sagging_length(WaveField(Water{}, {{0, 1, 0, 0}}), 0.08)));
}

TEST(WaveSurface, JoinsWhatIsFlatInLongWavesAlone) {
  const Hull barge = sample_barge();
  const WaveSurface swell(barge, WaveField(Water{}, {{0.5, 0.628, 0.785, 0}}));
  ASSERT_TRUE(swell.faces());
  EXPECT_LT(4 * swell.faces()->tree.triangle_count(), 2 * barge.panel_count());
  const WaveSurface chop(barge, WaveField(Water{}, {{0.1, 3, 0.785, 0}}));
  EXPECT_FALSE(chop.faces());
  ASSERT_TRUE(chop.panels());
}

ForceVector force_of(const PressureBoxes::Box& box, const auto& pressure) {
  ForceVector F = ForceVector::zero();
  for (std::size_t i = 0; i < box.points.size(); ++i) {
    const PressureBoxes::Weight w = box.weights[i] * pressure(box.points[i]);
    F += ForceVector{w.head<3>(), w.tail<3>()};
  }
  return F;
}

class Boxes : public ::testing::Test {
 protected:
  const WaveField waves_{Water{}, {{0.5, 0.9, 0.6, 0}}};
  const TriangleTree tree_{sample_barge()};
  const double tolerance_ = 1e-3;
  const PressureBoxes boxes_{tree_, waves_, tolerance_};
};

TEST_F(Boxes, MeetLinearPressureExactly) {
  const Vector3 slope(0.3, -0.7, 1.1);
  int held = 0;
  for (int node = 0; node < tree_.node_count(); ++node) {
    if (boxes_.find(node, 0.0).points.empty()) continue;
    ++held;
    const SurfaceMoments& m = tree_.moments(node);
    const Matrix3 nqp = 2.0 * m.Q + m.apply(slope);  // int n_k p_j q dA
    const Vector3 moment(nqp(2, 1) - nqp(1, 2), nqp(0, 2) - nqp(2, 0), nqp(1, 0) - nqp(0, 1));
    const ForceVector F =
        force_of(boxes_.find(node, 0.0), [&](const Vector3& p) { return 2.0 + slope.dot(p); });
    EXPECT_LT((F.force + 2.0 * m.N + m.Q * slope).norm(), 1e-9 * 110 * 46 * 50);
    EXPECT_LT((F.moment + moment).norm(), 1e-9 * 110 * 46 * 50 * 50);
  }
  EXPECT_GT(held, 10);
}

// The pressure of the wave itself, against panels divided into 256 triangles each.
TEST_F(Boxes, MeetAWaveToTheTolerance) {
  const double k = waves_.wave_number(0);
  const auto wave = [&](const Vector3& p) {
    return std::exp(k * (p.z() - 5.0)) *
           std::cos(k * (p.x() * std::cos(0.6) + p.y() * std::sin(0.6)));
  };
  int largest = -1;
  for (int node = tree_.node_count() - 1; node >= 0; --node) {
    if (!boxes_.find(node, 0.0).points.empty())
      largest = node;  // children stand behind their parents
  }
  ASSERT_GE(largest, 0);
  Vector3 exact = Vector3::Zero();
  double area = 0;
  constexpr int n = 16;
  tree_.visit([](const TriangleTree::Node&, int) { return true; },
              [&](const TriangleTree::Node& leaf) {
                const auto points = tree_.points(leaf);
                for (const TriangleTree::Triangle& t : tree_.triangles(leaf)) {
                  const Vector3 &a = points[t.corners[0]], &b = points[t.corners[1]],
                                &c = points[t.corners[2]];
                  double mean = 0;
                  for (int i = 0; i < n; ++i) {
                    for (int j = 0; j < 2 * (n - i) - 1; ++j) {
                      // Centres of the triangles of row i, those that stand and those that hang.
                      const double u = (i + (j % 2 == 0 ? 1.0 : 2.0) / 3) / n;
                      const double v = (j / 2 + (j % 2 == 0 ? 1.0 : 2.0) / 3) / n;
                      mean += wave(a + u * (b - a) + v * (c - a)) / (n * n);
                    }
                  }
                  exact -= mean * t.area;
                  area += t.area.norm();
                }
              },
              largest);
  const Vector3 error = force_of(boxes_.find(largest, 0.0), wave).force - exact;
  EXPECT_LT(error.norm(), 3 * tolerance_ * area);  // three sides
  EXPECT_LT(boxes_.find(largest, 0.0).points.size(),
            static_cast<std::size_t>(tree_.triangle_count()) / 4);
}

// Of waves as short as the panels boxes would take more points than panels: there are none.
TEST(PressureBoxes, AreNotHeldForShortWaves) {
  const WaveField ripples(Water{}, {{0.01, 6.0, 0, 0}});
  const TriangleTree tree(sample_barge());
  const PressureBoxes boxes(tree, ripples, 1e-3);
  EXPECT_TRUE(boxes.find(TriangleTree::root, 0.0).points.empty());
}

// Short waves do not reach down: more boxes are held in the deep, and those held at both take no
// more points.
TEST(PressureBoxes, TakeFewerPointsInTheDeep) {
  const WaveField sea(Water{}, {{0.5, 0.7, 0.3, 0}, {0.1, 2.5, 0.8, 1}});
  const TriangleTree tree(sample_barge());
  const PressureBoxes boxes(tree, sea, 1e-3);
  int high_count = 0, deep_count = 0;
  for (int node = 0; node < tree.node_count(); ++node) {
    const PressureBoxes::Box high = boxes.find(node, 0.0), deep = boxes.find(node, 7.0);
    if (!high.points.empty()) ++high_count;
    if (!deep.points.empty()) ++deep_count;
    if (!high.points.empty() && !deep.points.empty()) {
      EXPECT_LE(deep.points.size(), high.points.size());
    }
  }
  EXPECT_GT(deep_count, high_count);
}

}  // namespace
}  // namespace blocklift::dynamics

// Envelopes over a history against evaluating every instant.
#include "structure/envelope/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "structure/envelope/block_envelope.h"
#include "structure/envelope/leading_stress.h"
#include "structure/error.h"
#include "structure/stress_tensor.h"
#include "tests/structure/block_models.h"
#include "tests/structure/hull_block.h"
#include "tests/structure/sample_history.h"

namespace blocklift::structure {
namespace {

double principal(const Stress& s, int which) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly)
      .eigenvalues()[which];
}

// Sums of 30 products in two orders differ by some 30 roundings of their largest terms.
constexpr double rounding = 1e-13;

void expect_brute_force(const Eigen::MatrixXd& units, const Eigen::MatrixXd& factors) {
  const int points = static_cast<int>(units.rows()) / 6;
  const LoadHistory history(factors, Eigen::VectorXd::Ones(factors.rows()));
  const StressEnvelope envelope = find_stress_envelope(
      history, points, [&](int first, int count) { return units.middleRows(6 * first, 6 * count); },
      2);
  for (int p = 0; p < points; ++p) {
    const Eigen::MatrixXd stress = units.middleRows<6>(6 * p) * factors;
    double largest = 0, top = -1e300, bottom = 1e300;
    for (Eigen::Index t = 0; t < stress.cols(); ++t) {
      largest = std::max(largest, von_mises(stress.col(t)));
      top = std::max(top, principal(stress.col(t), 2));
      bottom = std::min(bottom, principal(stress.col(t), 0));
    }
    const double tolerance = rounding * stress.cwiseAbs().maxCoeff();
    ASSERT_NEAR(envelope.von_mises.value[p], largest, tolerance);
    ASSERT_NEAR(envelope.largest_principal.value[p], top, tolerance);
    ASSERT_NEAR(envelope.smallest_principal.value[p], bottom, tolerance);
    // The instants named have these values.
    ASSERT_NEAR(von_mises(stress.col(envelope.von_mises.instant[p])), largest, tolerance);
    ASSERT_NEAR(principal(stress.col(envelope.largest_principal.instant[p]), 2), top, tolerance);
    ASSERT_NEAR(principal(stress.col(envelope.smallest_principal.instant[p]), 0), bottom,
                tolerance);
  }
}

TEST(Envelope, EqualsBruteForceForALiftAndForNoise) {
  const Eigen::MatrixXd units = test::random_responses(6 * 150, 30, 1);
  expect_brute_force(units, test::lift_like_history(30, 700, 2));
  expect_brute_force(units, test::noise_history(30, 333, 3));
  expect_brute_force(units.leftCols(3), test::noise_history(3, 100, 4));
}

// Equal principal stresses are where closed forms lose digits: uniaxial, equibiaxial, hydrostatic
// and plane states, of both signs.
TEST(Envelope, HoldsWherePrincipalStressesCoincide) {
  Eigen::MatrixXd units(6 * 5, 2);
  units.setZero();
  units(0, 0) = 1;                                 // uniaxial
  units(6, 0) = units(7, 0) = 1;                   // equibiaxial
  units(12, 0) = units(13, 0) = units(14, 0) = 1;  // hydrostatic
  units(18, 0) = 1, units(19, 0) = -1;             // pure shear
  units(24, 0) = 1, units(24, 1) = 0.5, units(27, 1) = 1;
  Eigen::MatrixXd factors(2, 40);
  for (int t = 0; t < 40; ++t) factors.col(t) << std::sin(0.3 * t), std::cos(0.3 * t);
  expect_brute_force(units, factors);
}

TEST(Envelope, ShortAndConstantHistoriesAreOnes) {
  const Eigen::MatrixXd units = test::random_responses(6 * 20, 4, 5);
  expect_brute_force(units, test::noise_history(4, 1, 6));
  expect_brute_force(units, Eigen::MatrixXd::Ones(4, 70));
  expect_brute_force(units, Eigen::MatrixXd::Zero(4, 3));
  // Of equal values the earliest instant is named.
  const LoadHistory history(Eigen::MatrixXd::Ones(4, 70), Eigen::VectorXd::Ones(4));
  const auto responses = [&](int first, int count) {
    return units.middleRows(6 * first, 6 * count);
  };
  EXPECT_EQ(find_stress_envelope(history, 20, responses, 1).von_mises.instant.maxCoeff(), 0);
}

// Every instant lies in the box of its cluster and in that of its pack, and in one cluster alone.
TEST(LoadHistory, BoxesHoldTheirInstants) {
  for (const int instants : {1, 33, 512, 513, 1100, 9000}) {
    const Eigen::MatrixXd factors = test::lift_like_history(7, instants, 21);
    const LoadHistory history(factors, Eigen::VectorXd::Ones(7));
    std::vector<int> found(static_cast<std::size_t>(instants), 0);
    const auto holds = [&](const LoadBoxes& boxes, int box, int k, double y) {
      const int entry = (box / LoadHistory::pack * history.rank() + k) * LoadHistory::pack +
                        box % LoadHistory::pack;
      return std::abs(y - static_cast<double>(boxes.centres[entry])) <= boxes.half_widths[entry];
    };
    for (int cluster = 0; cluster < history.clusters(); ++cluster)
      for (int i = 0; i < LoadHistory::cluster_size; ++i) {
        found[history.member_instants(cluster)[i]] = cluster + 1;
        for (int k = 0; k < history.rank(); ++k) {
          const double y = history.members(cluster)[k * LoadHistory::cluster_size + i];
          ASSERT_TRUE(holds(history.boxes_of_clusters(), cluster, k, y));
          ASSERT_TRUE(holds(history.boxes_of_packs(), cluster / LoadHistory::pack, k, y));
        }
      }
    EXPECT_EQ(std::count(found.begin(), found.end(), 0), 0);
  }
}

// Stress of all kinds over more instants than a pack of clusters holds: in space, in a plane, along
// a bar, none at all, and a shear beside a pressure that is far larger.
TEST(Envelope, PacksOfClustersLeaveNothingOut) {
  Eigen::MatrixXd units = test::random_responses(6 * 60, 8, 22);
  for (int p = 10; p < 40; ++p) units.middleRows<2>(6 * p + 4).setZero();
  for (int p = 20; p < 40; ++p) units.row(6 * p + 2).setZero();
  for (int p = 30; p < 40; ++p) units.middleRows<5>(6 * p + 1).setZero();
  for (int p = 40; p < 50; ++p) units.middleRows<6>(6 * p).setZero();
  for (int p = 50; p < 60; ++p)
    units.middleRows<3>(6 * p) = Eigen::Vector3d::Constant(1e9) * units.row(6 * p);
  expect_brute_force(units, test::lift_like_history(8, 9000, 23));
  expect_brute_force(units, test::noise_history(8, 1300, 24));
  expect_brute_force(units, Eigen::MatrixXd::Zero(8, 1300));
  expect_brute_force(units, Eigen::MatrixXd::Ones(8, 1300));
}

// More coordinates than those that most clusters are passed over by, of which the others matter
// little, a little, and as much as these.
TEST(Envelope, LaterCoordinatesAreNotForgotten) {
  Eigen::MatrixXd units = test::random_responses(6 * 40, 29, 41);
  for (int p = 20; p < 40; ++p) units.middleRows<2>(6 * p + 4).setZero();
  for (const double last : {1e-4, 0.1, 1.0}) {
    const Eigen::VectorXd sizes =
        Eigen::VectorXd::LinSpaced(29, 0, 1).unaryExpr([&](double x) { return std::pow(last, x); });
    expect_brute_force(units, sizes.asDiagonal() * test::lift_like_history(29, 9000, 42));
    expect_brute_force(units, sizes.asDiagonal() * test::noise_history(29, 1300, 43));
  }
}

// What points before have found is where a point is looked at first, and changes nothing.
TEST(Envelope, PointsAloneHaveTheSameExtremesAsTogether) {
  const Eigen::MatrixXd units = test::random_responses(6 * 60, 8, 25);
  const LoadHistory history(test::lift_like_history(8, 2500, 26), Eigen::VectorXd::Ones(8));
  const PointExtremes together = find_von_mises_envelope(
      history, 60, [&](int first, int count) { return units.middleRows(6 * first, 6 * count); }, 1);
  for (int p = 0; p < 60; ++p) {
    const PointExtremes alone = find_von_mises_envelope(
        history, 1, [&](int, int) { return units.middleRows(6 * p, 6); }, 1);
    EXPECT_EQ(alone.value[0], together.value[p]);
    EXPECT_EQ(alone.instant[0], together.instant[p]);
  }
}

// One load in whole numbers comes back to exactly the same values, with both signs: of all instants
// with the largest stress the earliest is named, wherever its cluster lies; without stress the
// first.
TEST(Envelope, OfEqualsTheEarliestIsNamed) {
  Eigen::MatrixXd factors(1, 3000);
  for (int t = 0; t < 3000; ++t) factors(0, t) = (t * 37 + 5) % 41 - 20;
  Eigen::Index earliest = 0;
  factors.cwiseAbs().row(0).maxCoeff(&earliest);
  Eigen::MatrixXd units = test::random_responses(6 * 40, 1, 27);
  units.bottomRows(6).setZero();
  const LoadHistory history(factors, Eigen::VectorXd::Ones(1));
  const PointExtremes each = find_von_mises_envelope(
      history, 40, [&](int first, int count) { return units.middleRows(6 * first, 6 * count); }, 2);
  for (int p = 0; p < 39; ++p) EXPECT_EQ(each.instant[p], earliest);
  EXPECT_EQ(each.value[39], 0);
  EXPECT_EQ(each.instant[39], 0);
}

// Extremes over sets of points equal the extremes of the points' own envelopes.
TEST(Envelope, LargestOfSetsAreThoseOfTheirPoints) {
  const Eigen::MatrixXd units = test::random_responses(6 * 400, 12, 13);
  const Eigen::MatrixXd factors = test::lift_like_history(12, 1400, 14);
  const LoadHistory history(factors, Eigen::VectorXd::Ones(12));
  const auto responses = [&](int first, int count) {
    return units.middleRows(6 * first, 6 * count);
  };
  const StressEnvelope each = find_stress_envelope(history, 400, responses, 2);
  const LargestStresses sets = find_largest_stresses(
      history, 400, responses, 4, [](int point) { return point % 3; }, 2);
  for (int set = 0; set < 3; ++set) {
    int best = set;
    for (int point = set; point < 400; point += 3)
      if (each.von_mises.value[point] > each.von_mises.value[best]) best = point;
    const LargestValue& found = sets.von_mises[set];
    EXPECT_EQ(found.point, best);
    EXPECT_EQ(found.value, each.von_mises.value[best]);
    EXPECT_EQ(found.instant, each.von_mises.instant[best]);
  }
  EXPECT_EQ(sets.von_mises[3].point, -1);
  EXPECT_EQ(sets.largest_principal.value, each.largest_principal.value.maxCoeff());
  EXPECT_EQ(sets.smallest_principal.value, each.smallest_principal.value.minCoeff());
  EXPECT_EQ(each.smallest_principal.value[sets.smallest_principal.point],
            sets.smallest_principal.value);
}

// Stress in a plane has three components: the others are nil.
TEST(Envelope, LargestInPlaneIsThatOfAllComponents) {
  const Eigen::MatrixXd in_plane = test::random_responses(3 * 300, 12, 15);
  Eigen::MatrixXd units = Eigen::MatrixXd::Zero(6 * 300, 12);
  for (int p = 0; p < 300; ++p) {
    units.middleRows<2>(6 * p) = in_plane.middleRows<2>(3 * p);
    units.row(6 * p + 3) = in_plane.row(3 * p + 2);
  }
  const Eigen::MatrixXd factors = test::lift_like_history(12, 400, 16);
  const LoadHistory history(factors, Eigen::VectorXd::Ones(12));
  const PointExtremes each = find_von_mises_envelope(
      history, 300, [&](int first, int count) { return units.middleRows(6 * first, 6 * count); },
      1);
  const LargestValue largest = find_largest_in_plane(
      history, 300, [&](int first, int count) { return in_plane.middleRows(3 * first, 3 * count); },
      2);
  Eigen::Index point = 0;
  EXPECT_NEAR(largest.value, each.value.maxCoeff(&point), 1e-14 * largest.value);
  EXPECT_EQ(largest.point, point);
  EXPECT_EQ(largest.instant, each.instant[point]);
}

TEST(Envelope, LargestDisplacementEqualsBruteForce) {
  const Eigen::MatrixXd units = test::random_responses(3 * 400, 30, 7);
  for (const bool comes_back : {true, false}) {
    const Eigen::MatrixXd factors =
        comes_back ? test::lift_like_history(30, 500, 8) : test::noise_history(30, 333, 8);
    const LoadHistory history(factors, Eigen::VectorXd::Ones(30));
    const LargestValue moved = find_largest_displacement(
        history, 400, [&](int first, int count) { return units.middleRows(3 * first, 3 * count); },
        2);
    Eigen::MatrixXd sizes(400, factors.cols());
    for (int p = 0; p < 400; ++p)
      sizes.row(p) = (units.middleRows<3>(3 * p) * factors).colwise().norm();
    Eigen::Index point = 0, instant = 0;
    const double largest = sizes.maxCoeff(&point, &instant);
    EXPECT_NEAR(moved.value, largest, rounding * largest);
    EXPECT_EQ(moved.point, point);
    EXPECT_NEAR(sizes(moved.point, moved.instant), largest, rounding * largest);
  }
}

// Of runs of points, each with what is known of it: that of its points, or what is known.
TEST(Envelope, LargestOfRunsAreThoseOfTheirPoints) {
  const Eigen::MatrixXd units = test::random_responses(6 * 90, 12, 15);
  const Eigen::MatrixXd factors = test::lift_like_history(12, 2500, 16);
  const LoadHistory history(factors, Eigen::VectorXd::Ones(12));
  const auto responses = [&](int first, int count) {
    return units.middleRows(6 * first, 6 * count);
  };
  const PointExtremes each = find_von_mises_envelope(history, 90, responses, 2);
  std::vector<int> begin{0};
  while (begin.back() < 90) begin.push_back(begin.back() + static_cast<int>(begin.size()) % 4);
  begin.back() = 90;
  const auto runs = static_cast<Eigen::Index>(begin.size()) - 1;
  Eigen::VectorXd largest = Eigen::VectorXd::Constant(runs, each.value.mean());
  largest[3] = 2 * each.value.maxCoeff();
  Eigen::VectorXd expected = largest;
  for (Eigen::Index run = 0; run < runs; ++run)
    for (int point = begin[run]; point < begin[static_cast<std::size_t>(run) + 1]; ++point)
      expected[run] = std::max(expected[run], each.value[point]);
  raise_von_mises(history, begin, responses, largest, 2);
  EXPECT_EQ(largest, expected);
}

// What is known changes what is searched, and nothing of what is found.
TEST(Envelope, LeadingPointsAreThoseThatComeToAShareOfTheLargest) {
  const Eigen::MatrixXd units = test::random_responses(6 * 300, 12, 31) *
                                Eigen::VectorXd::LinSpaced(12, 2, 0.01).asDiagonal();
  const LoadHistory history(test::lift_like_history(12, 2500, 32), Eigen::VectorXd::Ones(12));
  const auto responses = [&](int first, int count) {
    return units.middleRows(6 * first, 6 * count);
  };
  const PointExtremes each = find_von_mises_envelope(history, 300, responses, 2);
  const double largest = each.value.maxCoeff();
  const Eigen::VectorXd expected =
      each.value.unaryExpr([&](double value) { return value < 0.6 * largest ? 0.0 : value; });
  ASSERT_EQ(expected.maxCoeff(), largest);
  ASSERT_EQ(expected.minCoeff(), 0);
  for (const double known : {0.0, 0.7 * largest, largest})
    EXPECT_EQ(find_leading_von_mises(history, 300, responses, 0.6, known, 2), expected) << known;
  EXPECT_EQ(find_leading_von_mises(history, 0, responses, 0.6, 0, 1).size(), 0);
}

TEST(Envelope, WhatIsNotANumberIsRefused) {
  Eigen::MatrixXd factors = test::noise_history(3, 5, 9);
  const LoadHistory history(factors, Eigen::VectorXd::Ones(3));
  Eigen::MatrixXd units = test::random_responses(6, 3, 10);
  units(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(find_stress_envelope(history, 1, [&](int, int) { return units; }), ModelError);
  EXPECT_THROW(find_stress_envelope(history, 2, [&](int, int) { return units; }), ModelError);
  factors(1, 4) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(LoadHistory(factors, Eigen::VectorXd::Ones(3)), ModelError);
  EXPECT_THROW(LoadHistory(Eigen::MatrixXd(3, 0), Eigen::VectorXd::Ones(3)), ModelError);
}

TEST(StressShares, SumToOneAndLeaveOutPressure) {
  const Eigen::MatrixXd unit = test::random_responses(6, 5, 11);
  const Eigen::VectorXd whole = test::noise_history(5, 1, 12);
  Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(5, 2);
  parts.col(0).head<2>() = whole.head<2>();
  parts.col(1).tail<3>() = whole.tail<3>();
  EXPECT_NEAR(stress_shares(unit, parts, whole).sum(), 1, 1e-12);
  // A part that brings pressure alone has no share in von Mises stress.
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, 2);
  stress.col(0).head<3>().setOnes();
  stress(3, 1) = 1;
  const Eigen::VectorXd shares =
      stress_shares(stress, Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, 1));
  EXPECT_NEAR(shares[0], 0, 1e-15);
  EXPECT_NEAR(shares[1], 1, 1e-15);
}

// The small block: the envelope over a short history is the largest of its instants, evaluated one
// by one by the stress recovery, everywhere that both report.
TEST(BlockEnvelope, IsTheLargestOfAllInstants) {
  const ElasticModel model(test::make_elastic_model(test::small_block(), 2));
  const UnitResponses responses(model);
  const StressRecovery recovery(responses);
  std::vector<LoadCase> instants;
  for (int t = 0; t < 40; ++t) {
    LoadCase load_case{"", {}, {}};
    Wrench pull;
    for (int lug = 0; lug < 4; ++lug) {
      const Vector3 force(3000 * std::sin(0.5 * t + lug), 2000 * std::cos(0.7 * t),
                          19000 + 4000 * std::sin(0.9 * t + 2 * lug));
      load_case.lug_forces_B.push_back(force);
      pull.force += force;
      pull.moment += model.mesh().lifting_points[lug].p_BPin.cross(force);
    }
    load_case.field = balancing_field(model.mass_properties(), pull);
    instants.push_back(load_case);
  }
  Eigen::MatrixXd factors(responses.count(), 40);
  for (int t = 0; t < 40; ++t) factors.col(t) = responses.coefficients(instants[t]);
  const BlockEnvelope envelope = find_block_envelope(responses, recovery, factors);

  LoadCaseResult largest = recovery.evaluate(instants[0]);
  const auto raise = [](Extreme& to, const Extreme& from) {
    if (from.value > to.value) to = from;
  };
  for (const LoadCase& load_case : instants) {
    const LoadCaseResult result = recovery.evaluate(load_case);
    raise(largest.checked_von_mises, result.checked_von_mises);
    raise(largest.peak_von_mises, result.peak_von_mises);
    raise(largest.displacement, result.displacement);
    for (std::size_t g = 0; g < result.groups.size(); ++g) {
      raise(largest.groups[g].checked_von_mises, result.groups[g].checked_von_mises);
      raise(largest.groups[g].peak_von_mises, result.groups[g].peak_von_mises);
    }
    for (std::size_t l = 0; l < result.lugs.size(); ++l)
      raise(largest.lugs[l].checked_von_mises, result.lugs[l].checked_von_mises);
  }
  // The recovery superposes displacements first and the envelope stresses: rounding of the
  // displacements (rigid part included) is magnified by one over the size of an element.
  const auto expect_equal = [](const TimedExtreme& found, const Extreme& expected) {
    EXPECT_NEAR(found.value, expected.value, 1e-9 * expected.value);
    EXPECT_LT((found.point_B - expected.point_B).norm(), 1e-9);
    EXPECT_EQ(found.part, expected.part);
  };
  expect_equal(envelope.checked_von_mises, largest.checked_von_mises);
  EXPECT_NEAR(envelope.peak_von_mises.value, largest.peak_von_mises.value,
              1e-9 * largest.peak_von_mises.value);
  EXPECT_NEAR(envelope.displacement.value, largest.displacement.value,
              1e-9 * largest.displacement.value);
  for (std::size_t g = 0; g < largest.groups.size(); ++g) {
    EXPECT_NEAR(envelope.groups[g].checked_von_mises.value,
                largest.groups[g].checked_von_mises.value, 1e-9 * largest.checked_von_mises.value);
    EXPECT_NEAR(envelope.groups[g].peak_von_mises.value, largest.groups[g].peak_von_mises.value,
                1e-9 * largest.peak_von_mises.value);
  }
  for (std::size_t l = 0; l < largest.lugs.size(); ++l)
    expect_equal(envelope.lugs[l].checked_von_mises, largest.lugs[l].checked_von_mises);
  const TimedExtreme& checked = envelope.checked_von_mises;
  EXPECT_NEAR(von_mises(checked.unit_stress * factors.col(checked.instant)), checked.value,
              1e-12 * checked.value);
  EXPECT_GE(envelope.largest_principal.value, -envelope.peak_von_mises.value);
  EXPECT_LT(envelope.smallest_principal.value, 0);
}

}  // namespace
}  // namespace blocklift::structure

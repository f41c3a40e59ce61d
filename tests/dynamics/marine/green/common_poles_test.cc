#include "dynamics/marine/green/common_poles.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Three pairs and a real pole, one pair close to the axis, for four values.
CommonPoles make_function() {
  CommonPoles function;
  function.poles.resize(4);
  function.poles << Complex(-0.8, 0.0), Complex(-0.5, 0.6), Complex(-0.02, 0.9), Complex(-0.7, 1.6);
  function.residues.resize(4, 4);
  for (Eigen::Index value = 0; value < 4; ++value) {
    const auto v = static_cast<double>(value);
    function.residues.row(value) << 0.0, Complex(1.0 + v, 0.0), Complex(0.05 * v, -0.03),
        Complex(-0.4, 2.0 - v);
    // The sum of all residues, with those of the pairs' other poles, is nothing.
    function.residues(value, 0) = -2.0 * function.residues.row(value).tail(3).real().sum();
  }
  return function;
}

Eigen::MatrixXcd sample(const CommonPoles& function, const std::vector<double>& frequencies) {
  Eigen::MatrixXcd values(function.residues.rows(), frequencies.size());
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    values.col(static_cast<Eigen::Index>(i)) = function.at(frequencies[i]);
  }
  return values;
}

TEST(CommonPoles, ARationalFunctionIsFoundItself) {
  const CommonPoles exact = make_function();
  std::vector<double> frequencies;
  for (int i = 1; i <= 20; ++i) frequencies.push_back(0.13 * i);
  double error = 1.0;
  const CommonPoles found =
      fit_common_poles(frequencies, sample(exact, frequencies), VectorXd::Ones(4), 1e-9, &error);
  EXPECT_LT(error, 1e-9);
  ASSERT_EQ(found.poles.size(), 4);
  for (const Complex& pole : exact.poles) {
    EXPECT_LT((found.poles.array() - pole).abs().minCoeff(), 1e-6) << pole;
  }
  for (const double w : {0.01, 0.9, 1.7, 5.0, 50.0}) {
    EXPECT_LT((found.at(w) - exact.at(w)).norm(), 1e-6 * exact.at(0.9).norm()) << w;
  }
  EXPECT_LT((found.at(-0.8) - found.at(0.8).conjugate()).norm(), 1e-14);
}

// Gauss's functions have no poles, and noise makes pairs of a pole and a zero anywhere: those that
// are made up must decay all the same.
TEST(CommonPoles, PolesDecayWhateverIsFitted) {
  const auto gauss = [](double w) {
    VectorXcd value(2);
    value << std::exp(-w * w), Complex(0.0, w) * std::exp(-0.5 * w * w);
    return value;
  };
  for (const int count : {8, 14, 25}) {
    std::vector<double> frequencies;
    Eigen::MatrixXcd values(2, count);
    for (int i = 0; i < count; ++i) {
      frequencies.push_back(0.1 + 3.0 * i / count);
      values.col(i) = gauss(frequencies.back()).array() + 1e-4 * std::sin(1e3 * i);
    }
    const CommonPoles found = fit_common_poles(frequencies, values, VectorXd::Ones(2), 1e-6);
    EXPECT_LT(found.poles.real().maxCoeff(), 0.0);
    for (const Complex& pole : found.poles) EXPECT_GE(pole.imag(), 0.0);
    const double size = found.residues.cwiseAbs().maxCoeff();
    EXPECT_LT(found.at(1e4).norm(), 1e-6 * (1.0 + size));
  }
}

// A peak of the width 0.02 among what is broad, found from frequencies that are 0.6 apart at first.
TEST(CommonPoles, FrequenciesGoWhereTheyAreNeeded) {
  const CommonPoles exact = make_function();
  int calls = 0;
  const auto compute = [&](double w) {
    ++calls;
    return exact.at(w);
  };
  const FoundPoles found = search_common_poles(
      compute, {.lowest = 0.05, .highest = 3.0, .tolerance = 1e-3, .first = {0.3, 0.6}});
  EXPECT_EQ(static_cast<std::size_t>(calls), found.frequencies.size());
  EXPECT_LE(calls, 30);
  EXPECT_LE(found.miss, 1e-3);
  const VectorXd scales = found.values.cwiseAbs().rowwise().maxCoeff();
  for (int i = 0; i <= 1000; ++i) {
    const double w = 0.05 + 2.95 * i / 1000;
    const VectorXd error = (found.function.at(w) - exact.at(w)).cwiseAbs().cwiseQuotient(scales);
    EXPECT_LT(error.maxCoeff(), 2e-3) << w;
  }
}

// Waves of low frequency give the forces a branch cut. That of the transform of g = t/(1 + t^2)^2
// is met by poles along it. The transform by Simpson's rule.
TEST(CommonPoles, ABranchCutIsMetByPolesAlongIt) {
  const auto compute = [](double w) {
    constexpr int steps = 10000;
    constexpr double step = 0.02;
    Complex sum = 0.0;
    for (int n = 1; n < steps; ++n) {
      const double t = step * n, squares = 1.0 + t * t;
      sum += (n % 2 == 1 ? 4.0 : 2.0) * t / (squares * squares) * std::polar(1.0, -w * t);
    }
    return VectorXcd(VectorXcd::Constant(1, step / 3.0 * sum));
  };
  const FoundPoles found =
      search_common_poles(compute, {.lowest = 0.05, .highest = 6.0, .tolerance = 1e-4});
  EXPECT_LT(found.frequencies.size(), 35U);
  for (const double w : {0.07, 0.4, 1.3, 3.3, 5.9}) {
    EXPECT_LT(std::abs(found.function.at(w)[0] - compute(w)[0]), 2e-4) << w;
  }
}

TEST(CommonPoles, WhatCannotBeFittedIsRefused) {
  EXPECT_THROW(fit_common_poles({1, 2, 3}, Eigen::MatrixXcd::Ones(1, 3), VectorXd::Ones(1), 1e-3),
               ModelError);
  EXPECT_THROW(
      fit_common_poles({1, 2, 3, 4}, Eigen::MatrixXcd::Ones(2, 4), VectorXd::Ones(1), 1e-3),
      ModelError);
  const auto none = [](double) { return VectorXcd(1); };
  EXPECT_THROW(search_common_poles(none, {.lowest = 0.0, .highest = 1.0}), ModelError);
  EXPECT_THROW(search_common_poles(none, {.lowest = 0.5, .highest = 1.0, .first = {2.0}}),
               ModelError);
}

}  // namespace
}  // namespace blocklift::dynamics

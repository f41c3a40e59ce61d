#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/memory_state_space.h"
#include "dynamics/marine/radiation/radiation.h"

namespace blocklift::dynamics {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// K(t) = exp(-t^2/4) cos 2t for one degree of freedom, finely sampled.
HydrodynamicDatabase analytic_memory(double step, double duration = 40.0) {
  HydrodynamicDatabase database;
  database.time_step = step;
  for (int n = 0; n * step < duration; ++n) {
    const double t = n * step;
    database.retardation.push_back(
        Eigen::MatrixXd::Constant(1, 1, std::exp(-t * t / 4) * std::cos(2 * t)));
  }
  return database;
}

// Motion v = sin t from rest: recorded at even and uneven instants, the force is the same to the
// fourth order of the instants' distance.
TEST(MemoryConvolution, DoesNotDependOnTheStep) {
  const HydrodynamicDatabase database = analytic_memory(0.02);
  const auto force_with = [&](double step, double unevenness) {
    MemoryConvolution memory(database);
    const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value).eval(); };
    memory.start(0.0, one(0.0), one(1.0));
    double t = 0.0;
    for (int k = 0; t + 2.0 * step < 9.5; ++k) {
      t += step * (1.0 + unevenness * std::sin(3.0 * k));
      memory.record(t, one(std::sin(t)), one(std::cos(t)));
    }
    Eigen::VectorXd force(1);
    memory.calc_force(9.5, one(std::sin(9.5)), force);
    return force[0];
  };
  // Reference: Simpson's rule on the product.
  double exact = 0.0;
  constexpr int n = 20000;
  for (int k = 0; k <= n; ++k) {
    const double tau = 9.5 * k / n;
    const double weight = k == 0 || k == n ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    exact -= weight * 9.5 / (3.0 * n) * std::exp(-tau * tau / 4) * std::cos(2 * tau) *
             std::sin(9.5 - tau);
  }
  const double coarse = std::abs(force_with(0.4, 0.0) - exact),
               fine = std::abs(force_with(0.1, 0.0) - exact);
  EXPECT_LT(coarse, 5e-3);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(force_with(0.1, 0.5), force_with(0.05, 0.0), 1e-4);
}

TEST(MemoryConvolution, RefusesToGoBack) {
  MemoryConvolution memory(analytic_memory(0.05));
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  memory.start(1.0, zero, zero);
  EXPECT_THAT([&] { memory.record(0.5, zero, zero); },
              ThrowsMessage<ModelError>(HasSubstr("does not follow")));
}

/// Two coupled modes with three poles: exp(-t) and exp(-t/2) (cos 2t, sin 2t).
HydrodynamicDatabase three_poles() {
  HydrodynamicDatabase database;
  database.time_step = 0.25;
  for (int n = 0; n < 80; ++n) {
    const double t = 0.25 * n;
    const double a = 3.0 * std::exp(-t), b = std::exp(-t / 2) * std::cos(2 * t);
    database.retardation.emplace_back(
        (Eigen::MatrixXd(2, 2) << 100 * (a + b), 10 * (a - b), 10 * (a - b), a + b).finished());
  }
  return database;
}

// A sum of exponentials is found again: three poles, each with a residue of rank one.
TEST(MemoryStateSpace, FindsASumOfExponentials) {
  const HydrodynamicDatabase database = three_poles();
  const MemoryStateSpace memory(database, 1e-3);  // cut off at exp(-10) = 5e-5
  EXPECT_EQ(memory.state_count(), 3);
  EXPECT_LT(memory.error(), 1e-3);
  for (const std::size_t n : {0U, 7U, 55U, 79U}) {
    const Eigen::MatrixXd difference =
        memory.calc_retardation(0.25 * static_cast<double>(n)) - database.retardation[n];
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 0.4);  // of a peak of 400
  }
  EXPECT_LT(memory.A().eigenvalues().real().maxCoeff(), 0.0);
}

/// Twelve modes that couple, with eight pairs of poles, the fastest of which has faded within a
/// hundredth of the time.
HydrodynamicDatabase eight_pairs_of_poles() {
  HydrodynamicDatabase database;
  database.time_step = 0.05;
  constexpr Eigen::Index modes = 12;
  for (int n = 0; n < 400; ++n) {
    const double t = database.time_step * n;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(modes, modes);
    for (int pole = 0; pole < 8; ++pole) {
      Eigen::VectorXd shape(modes);
      for (Eigen::Index i = 0; i < modes; ++i) {
        shape[i] = 1.0 + std::cos(1.7 * (pole + 1) * static_cast<double>(i + 1));
      }
      const double decay = pole == 0 ? 16.0 : 0.8 + 0.05 * pole;
      K += std::exp(-decay * t) * std::cos((1.0 + 0.8 * pole) * t) * shape * shape.transpose();
    }
    database.retardation.push_back(K);
  }
  return database;
}

// The whole matrix has 4,800 rows. What is left at the end, exp(-0.85 * 20), is all that a finite
// response differs from its poles by; numbers of states are tried in steps of an eighth.
TEST(MemoryStateSpace, UsesEverySampleOfManyModes) {
  const MemoryStateSpace fit(eight_pairs_of_poles(), 2e-3, 60);
  EXPECT_LE(fit.state_count(), 24);
  EXPECT_LT(fit.error(), 2e-3);
}

// A steady velocity meets the damping of the samples, however loosely K is fitted: here that of two
// modes with hardly a sum, as those of bodies in open water have none.
TEST(MemoryStateSpace, KeepsTheDampingOfASteadyVelocity) {
  HydrodynamicDatabase database;
  database.time_step = 0.1;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(2, 2);
  for (int n = 0; n < 250; ++n) {
    const double t = 0.1 * n, decay = std::exp(-t * t / 30);
    const double a = decay * std::cos(0.9 * t), b = decay * std::cos(1.4 * t + 0.1);
    database.retardation.emplace_back(
        (Eigen::MatrixXd(2, 2) << 5 * a, a - b, a - b, 2 * b).finished());
    sum += (n == 0 ? 0.05 : 0.1) * database.retardation.back();
  }
  for (const double tolerance : {0.05, 0.01, 0.002}) {
    const MemoryStateSpace memory(database, tolerance);
    EXPECT_LE(memory.error(), tolerance);
    const Eigen::MatrixXd steady = memory.C() * (-memory.A()).partialPivLu().solve(memory.B());
    EXPECT_LT((steady - sum).cwiseAbs().maxCoeff(), 1e-6) << tolerance;
  }
}

// The force of a velocity that is switched on: - int_0^t K, in a state space stepped finely, and by
// convolution.
TEST(MemoryStateSpace, ForceAgreesWithTheConvolution) {
  const HydrodynamicDatabase database = analytic_memory(0.1, 10.0);
  const MemoryStateSpace memory(database, 1e-3);
  MemoryConvolution convolution(database);
  const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value).eval(); };
  convolution.start(0.0, one(0.0), one(1.0));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(memory.state_count()), rate = x, middle = x, force(1);
  const double h = 0.005;
  for (int k = 0; k < 1200; ++k) {  // midpoint rule, v = sin t
    memory.calc_rate(x, one(std::sin(k * h)), rate);
    middle = x + 0.5 * h * rate;
    memory.calc_rate(middle, one(std::sin((k + 0.5) * h)), rate);
    x += h * rate;
    if (k % 10 == 9)
      convolution.record((k + 1) * h, one(std::sin((k + 1) * h)), one(std::cos((k + 1) * h)));
  }
  memory.calc_force(x, force);
  Eigen::VectorXd reference(1);
  convolution.calc_force(6.0, one(std::sin(6.0)), reference);
  EXPECT_NEAR(force[0], reference[0], 5e-3);
}

/// Two bodies that mirror each other in x = 0: surge couples with pitch, heave stands alone, and
/// each body feels what the other does a while ago.
HydrodynamicDatabase mirrored_pair() {
  Eigen::Matrix<double, 6, 1> signs;
  signs << -1, 1, 1, 1, -1, -1;
  const auto S = signs.asDiagonal();
  HydrodynamicDatabase database;
  database.time_step = 0.25;
  for (int n = 0; n < 160; ++n) {
    const double t = 0.25 * n;
    const double a = std::exp(-0.5 * t) * std::cos(t), b = std::exp(-0.3 * t) * std::cos(0.7 * t);
    Eigen::Matrix<double, 6, 6> own = Eigen::Matrix<double, 6, 6>::Zero();
    own(0, 0) = 10 * a;
    own(0, 4) = own(4, 0) = 20 * a;
    own(4, 4) = 60 * a + 30 * b;
    own(2, 2) = 5 * b;
    const Eigen::Matrix<double, 6, 6> other =
        0.4 * std::exp(-0.2 * t) * std::sin(1.3 * t) / (1.0 + own.norm()) * own;
    Eigen::MatrixXd K(12, 12);
    K << own, other * S, S * other, S * own * S;
    database.retardation.push_back(K);
  }
  return database;
}

// What does not couple is fitted apart, so that it stays apart; and the pair keeps its mirror
// image.
TEST(MemoryStateSpace, FitsMirroredBodiesByWhatTheyDoAlike) {
  const HydrodynamicDatabase database = mirrored_pair();
  const MemoryStateSpace memory(database, 0.005);
  EXPECT_LE(memory.error(), 0.005);
  for (const std::size_t n : {0U, 9U, 40U}) {
    const Eigen::MatrixXd K = memory.calc_retardation(0.25 * static_cast<double>(n));
    EXPECT_NEAR(K(0, 0), database.retardation[n](0, 0), 0.005 * 10);
    EXPECT_NEAR(K(0, 0), K(6, 6), 1e-9);
    EXPECT_NEAR(K(0, 4), K(6, 10), 1e-9);
    EXPECT_EQ(K(0, 2), 0);
    EXPECT_EQ(K(2, 10), 0);
  }
  // No damping is left at rest that the retardation functions do not have: int K dt.
  Eigen::MatrixXd integral = 0.5 * database.retardation[0];
  for (std::size_t n = 1; n < database.retardation.size(); ++n) integral += database.retardation[n];
  const Eigen::MatrixXd fitted = -memory.C() * memory.A().partialPivLu().solve(memory.B());
  EXPECT_NEAR(fitted(0, 0), 0.25 * integral(0, 0), 0.01 * 10);
}

TEST(MemoryStateSpace, SaysWhatItCannotReach) {
  EXPECT_THAT([] { MemoryStateSpace(analytic_memory(0.1, 10.0), 1e-9, 4); },
              ThrowsMessage<ModelError>(HasSubstr("no state space of up to 4 states")));
}

TEST(MemoryStateSpace, IsTheSameFromWhatItIsKeptAs) {
  const std::vector<HydrodynamicDatabase> databases = {three_poles(), analytic_memory(0.1, 10.0)};
  const std::vector<MemoryStateSpace> fitted = fit_memories(databases, {.tolerance = 1e-3});
  ASSERT_EQ(fitted.size(), 2U);
  for (const MemoryStateSpace& memory : fitted) {
    const MemoryStateSpace kept(memory.decay(), memory.turn(), memory.B(), memory.C(),
                                memory.error());
    EXPECT_EQ(kept.A(), memory.A());
    EXPECT_EQ(kept.calc_retardation(1.5), memory.calc_retardation(1.5));
    EXPECT_EQ(kept.error(), memory.error());
  }
}

TEST(MemoryStateSpace, RefusesWhatWasNotKeptWhole) {
  const Eigen::Vector2d decay(-1.0, -1.0), turn(2.0, 0.0);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Ones(2, 6), C = Eigen::MatrixXd::Ones(6, 2);
  EXPECT_NO_THROW(MemoryStateSpace(decay, turn, B, C, 0.01));
  EXPECT_THROW(MemoryStateSpace(-decay, turn, B, C, 0.01), ModelError);
  EXPECT_THROW(MemoryStateSpace(decay, Eigen::Vector2d(2.0, 2.0), B, C, 0.01), ModelError);
  EXPECT_THROW(MemoryStateSpace(decay, turn, B, C.leftCols(1), 0.01), ModelError);
  EXPECT_THROW(MemoryStateSpace(decay, turn, B, C, not_a_number), ModelError);
}

// The looser fit is taken where the close one has too few states.
TEST(MemoryStateSpace, FitsMoreLooselyWhereItMay) {
  const std::vector<HydrodynamicDatabase> databases = {analytic_memory(0.1, 10.0)};
  EXPECT_THROW(fit_memories(databases, {.tolerance = 1e-9, .most_states = 4}), ModelError);
  const auto loose = fit_memories(
      databases,
      {.tolerance = 1e-9, .most_states = 4, .loose_tolerance = 0.05, .most_loose_states = 50});
  EXPECT_LT(loose.at(0).error(), 0.05);
}

}  // namespace
}  // namespace blocklift::dynamics

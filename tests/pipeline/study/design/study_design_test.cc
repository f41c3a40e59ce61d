#include "pipeline/study/design/study_design.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/declaration/diagnostics.h"
#include "tests/pipeline/study/varied_lengths.h"

namespace blocklift::pipeline {
namespace {

TEST(StudyDesign, LatinHypercubeHasOneMemberInEachStratum) {
  const StudyFile study =
      test::study_of(StudyDesign::latin_hypercube, 50,
                     {test::uniform_length(0, 50), test::uniform_length(100, 150)});
  const Eigen::MatrixXd design = make_design(study);
  ASSERT_EQ(design.rows(), 50);
  for (Eigen::Index v = 0; v < 2; ++v) {
    std::vector<double> values(design.col(v).begin(), design.col(v).end());
    std::sort(values.begin(), values.end());
    for (int stratum = 0; stratum < 50; ++stratum)
      EXPECT_EQ(static_cast<int>(std::floor(values[stratum])), stratum + (v == 0 ? 0 : 100));
  }
}

TEST(StudyDesign, SamplesHaveTheMomentsOfTheirLaws) {
  using Kind = SpreadLaw::Kind;
  for (const Kind kind : {Kind::normal, Kind::lognormal, Kind::gumbel, Kind::weibull}) {
    StudyVariable variable = test::normal_length(10, 2);
    variable.law->kind = kind;
    const Eigen::VectorXd values =
        make_design(test::study_of(StudyDesign::latin_hypercube, 4000, {variable})).col(0);
    const double mean = values.mean();
    const double deviation = std::sqrt((values.array() - mean).square().mean());
    EXPECT_NEAR(mean, 10, 0.01) << static_cast<int>(kind);
    EXPECT_NEAR(deviation, 2, 0.02) << static_cast<int>(kind);
  }
  SpreadLaw triangle;
  triangle.kind = Kind::triangular;
  triangle.lowest = test::length_of(0);
  triangle.mode = test::length_of(3);
  triangle.highest = test::length_of(9);
  const Eigen::VectorXd values = make_design(test::study_of(StudyDesign::latin_hypercube, 4000,
                                                            {test::spread_variable(triangle)}))
                                     .col(0);
  EXPECT_NEAR(values.mean(), 4, 0.01);  // (lowest + mode + highest) / 3
}

TEST(StudyDesign, ALawIsCutOffAtItsBounds) {
  StudyVariable variable = test::normal_length(0, 1);
  variable.law->lowest = test::length_of(-0.5);
  const Eigen::VectorXd values =
      make_design(test::study_of(StudyDesign::random, 2000, {variable})).col(0);
  EXPECT_GE(values.minCoeff(), -0.5);
  // Mean of a normal value above a: phi(a) / (1 - Phi(a)); the sample's own error is 0.014.
  const double density = std::exp(-0.125) / std::sqrt(2 * std::numbers::pi);
  const double above = 0.5 * std::erfc(-0.5 / std::numbers::sqrt2);
  EXPECT_NEAR(values.mean(), density / above, 4 * 0.014);
  variable.law->lowest = test::length_of(60);
  EXPECT_THROW(make_design(test::study_of(StudyDesign::random, 10, {variable})), InputError);
}

TEST(StudyDesign, RepeatsWithItsSeed) {
  StudyFile study = test::study_of(StudyDesign::random, 20,
                                   {test::normal_length(0, 1), test::normal_length(1, 3)});
  const Eigen::MatrixXd first = make_design(study);
  EXPECT_EQ(first, make_design(study));
  study.seed = Located<int>{2, {}};
  EXPECT_NE(first, make_design(study));
}

TEST(StudyDesign, AGridHasEveryValueWithEveryOther) {
  StudyVariable a, b;
  a.values = {test::length_of(1), test::length_of(2)};
  b.values = {test::length_of(10), test::length_of(20), test::length_of(30)};
  const Eigen::MatrixXd design = make_design(test::study_of(StudyDesign::grid, 0, {a, b}));
  Eigen::MatrixXd expected(6, 2);
  expected << 1, 10, 1, 20, 1, 30, 2, 10, 2, 20, 2, 30;
  EXPECT_EQ(design, expected);
}

TEST(StudyDesign, ValuesInTurnAreTakenEquallyOften) {
  StudyVariable variable;
  variable.values = {test::length_of(1), test::length_of(2), test::length_of(4)};
  const Eigen::VectorXd values =
      make_design(test::study_of(StudyDesign::latin_hypercube, 30, {variable})).col(0);
  EXPECT_EQ((values.array() == 1).count(), 10);
  EXPECT_EQ((values.array() == 4).count(), 10);
}

TEST(StudyDesign, ValuesAreWrittenWithTheirUnit) {
  EXPECT_EQ(value_text(test::normal_length(1, 1), 9.98), "9.98 m");
  StudyVariable plain;
  plain.values = {{{2, {}}, {}}};
  EXPECT_EQ(value_text(plain, 0.1), "0.1");
  StudyVariable stiffness;
  stiffness.values = {{{2, {0, 1, -2, 0}}, {}}};
  EXPECT_EQ(value_text(stiffness, 5e6), "5000000 N/m");
}

TEST(StudyDesign, ValuesAreShownInTheUnitsOfEngineers) {
  constexpr double degree = std::numbers::pi / 180;
  const auto shown = [](const Exponents& exponents, double value) {
    StudyVariable variable;
    variable.values = {{{2, exponents}, {}}};
    return shown_value(variable, value, 4);
  };
  EXPECT_EQ(shown({0, 0, 0, 1}, 18 * degree), "18 deg");
  EXPECT_EQ(shown({0, 0, -1, 1}, -0.5 * degree), "-0.5 deg/s");
  const Exponents force{1, 1, -2, 0};
  EXPECT_EQ(shown(force, 2.735e8), "273.5 MN");
  EXPECT_EQ(shown(force, -4e4), "-40 kN");
  EXPECT_EQ(shown(force, 12), "12 N");
  EXPECT_EQ(shown({0, 1, -2, 0}, 5e6), "5 MN/m");
  EXPECT_EQ(shown({-1, 1, -2, 0}, 2.06e11), "206 GPa");
  EXPECT_EQ(shown({-1, 1, -2, 0}, 355e6), "355 MPa");
  EXPECT_EQ(shown({0, 1, 0, 0}, 8.6e5), "860 t");
  EXPECT_EQ(shown({0, 1, 0, 0}, 7640), "7640 kg");
  EXPECT_EQ(shown({0, 1, 0, 0}, 2.04e7), "20400 t");
  EXPECT_EQ(shown({1, 0, 0, 0}, 9.98), "9.98 m");
  EXPECT_EQ(shown({}, 0.1), "0.1");
}

// Five standard deviations off there is a law; nine off nothing of it is left that a computer
// knows.
TEST(StudyDesign, SaysWhereNothingOfALawIsLeft) {
  const auto place = std::make_shared<const std::string>("study.yaml");
  const auto refusal = [&](std::optional<double> lowest, std::optional<double> highest) {
    StudyVariable variable = test::normal_length(10, 2);
    variable.law->place = {place, 6, 20};
    if (lowest) variable.law->lowest = test::length_of(*lowest);
    if (highest) variable.law->highest = test::length_of(*highest);
    try {
      const Eigen::MatrixXd values =
          make_design(test::study_of(StudyDesign::random, 50, {variable}));
      EXPECT_GE(values.minCoeff(), lowest.value_or(-1e9));
      EXPECT_LE(values.maxCoeff(), highest.value_or(1e9));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(20, std::nullopt), "");
  EXPECT_EQ(refusal(std::nullopt, 0), "");
  for (const std::string& text :
       {refusal(28, std::nullopt), refusal(std::nullopt, -8), refusal(28, 30)})
    EXPECT_EQ(text,
              "study.yaml:6:20: error: the spread of \"x\" is impossible: the law has no such "
              "moments, or nothing of it lies between its bounds\n1 error\n");
}

StudyCorrelation correlation_of(const char* a, const char* b, CopulaKind copula) {
  StudyCorrelation correlation;
  correlation.of = {{a, {}}, {b, {}}};
  correlation.copula = copula;
  return correlation;
}

StudyFile correlated_study(StudyDesign design, int members) {
  StudyFile study =
      test::study_of(design, members, {test::normal_length(10, 2), test::uniform_length(0, 1)});
  study.variables.push_back(test::normal_length(-5, 0.5));
  study.variables[1].name = {"y", {}};
  study.variables[2].name = {"z", {}};
  study.correlations.push_back(correlation_of("x", "y", CopulaKind::normal));
  study.correlations.back().is = 0.8;
  study.correlations.push_back(correlation_of("z", "x", CopulaKind::normal));
  study.correlations.back().is = -0.5;
  return study;
}

double correlation_of_columns(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.dot(y) / (x.norm() * y.norm());
}

TEST(StudyDesign, JoinsCorrelatedValuesByANormalCopula) {
  for (const StudyDesign design :
       {StudyDesign::random, StudyDesign::low_discrepancy, StudyDesign::latin_hypercube}) {
    const Eigen::MatrixXd values = make_design(correlated_study(design, 8000));
    // Normal values have the correlation itself; with a uniform one it is rho sqrt(3 / pi), by
    // Stein's lemma: E[X Phi(Y)] = rho E[phi(Y)] = rho / (2 sqrt(pi)).
    EXPECT_NEAR(correlation_of_columns(values.col(0), values.col(2)), -0.5, 0.02);
    EXPECT_NEAR(correlation_of_columns(values.col(0), values.col(1)),
                0.8 * std::sqrt(3 / std::numbers::pi), 0.02);
    // y and z have nothing to do with each other of themselves.
    EXPECT_NEAR(correlation_of_columns(values.col(1), values.col(2)), 0, 0.03);
    EXPECT_NEAR(values.col(1).mean(), 0.5, 0.01);
    EXPECT_NEAR(values.col(2).mean(), -5, 0.02);
    EXPECT_GE(values.col(1).minCoeff(), 0);
    EXPECT_LE(values.col(1).maxCoeff(), 1);
  }
}

TEST(StudyDesign, KeepsTheStrataOfACorrelatedLatinHypercube) {
  const Eigen::MatrixXd design = make_design(correlated_study(StudyDesign::latin_hypercube, 50));
  std::vector<double> values(design.col(1).begin(), design.col(1).end());
  std::sort(values.begin(), values.end());
  for (int stratum = 0; stratum < 50; ++stratum)
    EXPECT_EQ(static_cast<int>(std::floor(50 * values[stratum])), stratum);
}

constexpr StudyDesign joined_designs[] = {StudyDesign::random, StudyDesign::low_discrepancy,
                                          StudyDesign::latin_hypercube};

/// x, normal, and y, uniform, joined by a copula.
Eigen::MatrixXd joined_pair(StudyDesign design, int members, const StudyCorrelation& correlation) {
  StudyFile study =
      test::study_of(design, members, {test::normal_length(10, 2), test::uniform_length(0, 1)});
  study.variables[1].name = {"y", {}};
  study.correlations.push_back(correlation);
  return make_design(study);
}

StudyCorrelation joined_by(CopulaKind copula, double kendall) {
  StudyCorrelation correlation = correlation_of("x", "y", copula);
  correlation.kendall = kendall;
  if (copula == CopulaKind::student) correlation.degrees = 3;
  return correlation;
}

/// Kendall's tau of a sample, from all pairs.
double kendall_of(const Eigen::MatrixXd& design) {
  double more = 0;
  const Eigen::Index count = design.rows();
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < i; ++k)
      more += (design(i, 0) - design(k, 0)) * (design(i, 1) - design(k, 1)) > 0 ? 1 : -1;
  return 2 * more / (static_cast<double>(count) * static_cast<double>(count - 1));
}

/// Share of the members whose values are both below the share q of their laws: the copula's value
/// at (q, q). Above 1 - q for q below zero.
double share_of_corner(const Eigen::MatrixXd& design, double q) {
  int inside = 0;
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    const double x = 0.5 * std::erfc(-(design(i, 0) - 10) / 2 / std::numbers::sqrt2);
    const double y = design(i, 1);
    inside += q > 0 ? x < q && y < q : x > 1 + q && y > 1 + q;
  }
  return inside / static_cast<double>(design.rows());
}

// A sample of n members has a tau with a deviation of 2 / 3 / sqrt(n) at most where it is random.
TEST(StudyDesign, CopulasHaveTheirKendallsTau) {
  for (const StudyDesign design : joined_designs)
    for (const auto& [copula, kendall] :
         {std::pair{CopulaKind::clayton, 0.6}, std::pair{CopulaKind::gumbel, 0.4},
          std::pair{CopulaKind::frank, 0.5}, std::pair{CopulaKind::frank, -0.7},
          std::pair{CopulaKind::student, 0.5}, std::pair{CopulaKind::student, -0.3},
          std::pair{CopulaKind::normal, 0.5}}) {
      const Eigen::MatrixXd values = joined_pair(design, 3000, joined_by(copula, kendall));
      EXPECT_NEAR(kendall_of(values), kendall,
                  design == StudyDesign::low_discrepancy ? 0.004 : 0.03)
          << static_cast<int>(copula);
      EXPECT_NEAR(values.col(1).mean(), 0.5, 0.02);
    }
}

// The copulas' own closed forms (Nelsen 2006, table 4.1), their parameters being 2, 2 and 5.7363 at
// a tau of one half.
TEST(StudyDesign, CopulasHaveTheirCorners) {
  constexpr double q = 0.1;
  constexpr int members = 1 << 14;
  const auto joined = [](CopulaKind copula) {
    return joined_pair(StudyDesign::low_discrepancy, members, joined_by(copula, 0.5));
  };
  const auto clayton = [](double u) { return 1 / std::sqrt(2 / (u * u) - 1); };
  const auto gumbel = [](double u) { return std::pow(u, std::numbers::sqrt2); };
  const auto frank = [](double u) {
    constexpr double t = 5.7363;
    return -std::log1p(std::pow(std::expm1(-t * u), 2) / std::expm1(-t)) / t;
  };
  const auto upper = [](const auto& copula) { return 2 * q - 1 + copula(1 - q); };
  const Eigen::MatrixXd of_clayton = joined(CopulaKind::clayton);
  const Eigen::MatrixXd of_gumbel = joined(CopulaKind::gumbel);
  const Eigen::MatrixXd of_frank = joined(CopulaKind::frank);
  EXPECT_NEAR(share_of_corner(of_clayton, q), clayton(q), 0.002);
  EXPECT_NEAR(share_of_corner(of_clayton, -q), upper(clayton), 0.002);
  EXPECT_NEAR(share_of_corner(of_gumbel, q), gumbel(q), 0.002);
  EXPECT_NEAR(share_of_corner(of_gumbel, -q), upper(gumbel), 0.002);
  EXPECT_NEAR(share_of_corner(of_frank, q), frank(q), 0.002);
  EXPECT_NEAR(share_of_corner(of_frank, -q), frank(q), 0.002);  // it has both ends alike
}

// Of Student's copula extremes come together with a probability that does not vanish (Embrechts,
// McNeil and Straumann 2002, equation 16): 2 t_4(-sqrt(4 (1 - r) / (1 + r))) with three degrees and
// r = sin(pi / 4) is 0.4540. Of a normal one it does.
TEST(StudyDesign, ExtremesOfStudentsCopulaComeTogether) {
  constexpr double q = 0.005;
  const auto share = [](CopulaKind copula, double corner) {
    return share_of_corner(
               joined_pair(StudyDesign::low_discrepancy, 1 << 15, joined_by(copula, 0.5)), corner) /
           q;
  };
  EXPECT_NEAR(share(CopulaKind::student, q), 0.4540, 0.05);
  EXPECT_NEAR(share(CopulaKind::student, -q), 0.4540, 0.05);
  EXPECT_LT(share(CopulaKind::normal, q), 0.35);
}

TEST(StudyDesign, JoinsPairsBesideValuesThatNormalCopulasJoin) {
  StudyFile study = correlated_study(StudyDesign::latin_hypercube, 2000);
  for (const char* name : {"p", "q"}) {
    study.variables.push_back(test::uniform_length(0, 1));
    study.variables.back().name = {name, {}};
  }
  study.correlations.push_back(correlation_of("q", "p", CopulaKind::clayton));
  study.correlations.back().kendall = 0.5;
  const Eigen::MatrixXd design = make_design(study);
  EXPECT_NEAR(correlation_of_columns(design.col(0), design.col(2)), -0.5, 0.02);
  EXPECT_NEAR(kendall_of(design.rightCols(2)), 0.5, 0.03);
  EXPECT_NEAR(correlation_of_columns(design.col(0), design.col(3)), 0, 0.05);
  std::vector<double> values(design.col(3).begin(), design.col(3).end());
  std::sort(values.begin(), values.end());
  for (int stratum = 0; stratum < 2000; ++stratum)
    EXPECT_EQ(static_cast<int>(std::floor(2000 * values[stratum])), stratum);
}

}  // namespace
}  // namespace blocklift::pipeline

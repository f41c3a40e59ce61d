#include "pipeline/study/design/copulas.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "algebra/factors.h"

namespace blocklift::pipeline {
namespace {

using Laws = OT::ComposedDistribution::DistributionCollection;

// Shares of a law are kept off both ends, where quantiles are not finite.
constexpr double least_share = 1e-15;

double share_inside(double share) { return std::clamp(share, least_share, 1 - least_share); }

OT::UnsignedInteger as_index(Eigen::Index index) { return static_cast<OT::UnsignedInteger>(index); }

/// What each value's law makes of it: its share of the members below.
Eigen::MatrixXd shares_of(const Laws& laws, const OT::Sample& sample) {
  Eigen::MatrixXd shares(static_cast<Eigen::Index>(sample.getSize()),
                         static_cast<Eigen::Index>(sample.getDimension()));
  for (Eigen::Index i = 0; i < shares.rows(); ++i)
    for (Eigen::Index v = 0; v < shares.cols(); ++v)
      shares(i, v) = share_inside(laws[as_index(v)].computeCDF(sample(as_index(i), as_index(v))));
  return shares;
}

/// Normal scores of independent shares that are mixed by the root of the correlations (Nataf's
/// transformation). @param without_chance the correlation that the sample has by chance is taken
/// out before (Iman and Conover 1982).
Eigen::MatrixXd joined_scores(const Eigen::MatrixXd& shares, const Eigen::MatrixXd& root,
                              bool without_chance) {
  Eigen::MatrixXd scores =
      shares.unaryExpr([](double share) { return OT::DistFunc::qNormal(share); });
  if (!without_chance) return scores * root.transpose();
  scores.rowwise() -= scores.colwise().mean().eval();
  for (Eigen::Index v = 0; v < scores.cols(); ++v) scores.col(v).normalize();
  const Eigen::MatrixXd chance = algebra::CholeskyFactors(scores.transpose() * scores).lower();
  return chance.triangularView<Eigen::Lower>().solve(scores.transpose()).transpose() *
         root.transpose();
}

/// Parameter of Frank's copula: tau = 1 - 4 (1 - D1(t)) / t, D1 being Debye's function (Nelsen
/// 2006, section 5.1). It is odd in t, and rises.
double frank_parameter(double kendall) {
  const auto kendall_of = [](double t) {
    return t < 1e-6 ? t / 9 : 1 - 4 * (1 - OT::SpecFunc::Debye(t, 1)) / t;
  };
  double low = 0, high = 1;
  while (kendall_of(high) < std::abs(kendall)) high *= 2;
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = (low + high) / 2;
    (kendall_of(middle) < std::abs(kendall) ? low : high) = middle;
  }
  return std::copysign((low + high) / 2, kendall);
}

/// The second share of a pair, of the first and of an independent one: the quantile of its law once
/// the first is known (Rosenblatt's transformation).
class SecondShare {
 public:
  explicit SecondShare(const StudyCorrelation& correlation)
      : kind_(correlation.copula), degrees_(correlation.degrees.value_or(0)) {
    const double kendall = correlation.kendall.value_or(0);
    // Nelsen (2006), examples 5.4 and 5.5.
    if (kind_ == CopulaKind::clayton) copula_ = OT::ClaytonCopula(2 * kendall / (1 - kendall));
    if (kind_ == CopulaKind::gumbel) copula_ = OT::GumbelCopula(1 / (1 - kendall));
    if (kind_ == CopulaKind::frank) copula_ = OT::FrankCopula(frank_parameter(kendall));
    if (kind_ == CopulaKind::student) coefficient_ = correlation.coefficient();
  }

  double operator()(double first, double independent) const {
    if (kind_ == CopulaKind::student) return student(first, independent);
    // The first value is at hand, and the copula is symmetric.
    return share_inside(copula_.computeConditionalQuantile(independent, OT::Point{first}));
  }

 private:
  /// Of Student's law in two dimensions the second value, once the first is known, is Student's
  /// again, with a degree of freedom more (Ding 2016).
  double student(double first, double independent) const {
    const double x = OT::DistFunc::qStudent(degrees_, first);
    const double spread =
        std::sqrt((degrees_ + x * x) / (degrees_ + 1) * (1 - coefficient_ * coefficient_));
    const double y = coefficient_ * x + spread * OT::DistFunc::qStudent(degrees_ + 1, independent);
    return share_inside(OT::DistFunc::pStudent(degrees_, y));
  }

  CopulaKind kind_;
  double degrees_ = 0, coefficient_ = 0;
  OT::Distribution copula_;
};

/// Puts a column's values into the order of others.
void order_as(const Eigen::VectorXd& wanted, OT::UnsignedInteger column, OT::Sample& sample) {
  std::vector<double> values;
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    values.push_back(sample(as_index(i), column));
    order.push_back(i);
  }
  std::sort(values.begin(), values.end());
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return wanted[a] < wanted[b]; });
  for (std::size_t rank = 0; rank < values.size(); ++rank)
    sample(as_index(order[rank]), column) = values[rank];
}

/// Gives a column the values of shares.
void take_shares(const Eigen::VectorXd& shares, const OT::Distribution& law,
                 OT::UnsignedInteger column, OT::Sample& sample) {
  for (Eigen::Index i = 0; i < shares.size(); ++i)
    sample(as_index(i), column) = law.computeQuantile(share_inside(shares[i]))[0];
}

Eigen::Index column_of(const StudyFile& study, const std::string& name) {
  for (std::size_t v = 0; v < study.variables.size(); ++v)
    if (study.variables[v].name.value == name) return static_cast<Eigen::Index>(v);
  throw std::logic_error("a correlation of a variable that is none");
}

/// All values that normal copulas join.
void join_normal(const StudyFile& study, const Laws& laws, bool keeps_strata,
                 const Eigen::MatrixXd& shares, OT::Sample& sample) {
  const Eigen::MatrixXd correlations = study.correlation_matrix();
  const Eigen::MatrixXd root = algebra::CholeskyFactors(correlations).lower();
  const Eigen::MatrixXd joined = joined_scores(shares, root, keeps_strata);
  for (Eigen::Index v = 1; v < joined.cols(); ++v) {
    if (keeps_strata)
      order_as(joined.col(v), as_index(v), sample);
    else if (root.row(v).head(v).any())
      take_shares(
          joined.col(v).unaryExpr([](double score) { return OT::DistFunc::pNormal(score); }),
          laws[as_index(v)], as_index(v), sample);
  }
  if (keeps_strata) order_as(joined.col(0), 0, sample);
}

}  // namespace

void join_values(const StudyFile& study, const Laws& laws, OT::Sample& sample) {
  if (study.correlations.empty()) return;
  Eigen::MatrixXd shares = shares_of(laws, sample);
  // So few members have no order of their own.
  const bool keeps_strata =
      study.design == StudyDesign::latin_hypercube && shares.rows() > shares.cols();
  const auto is_normal = [](const StudyCorrelation& one) {
    return one.copula == CopulaKind::normal;
  };
  if (std::any_of(study.correlations.begin(), study.correlations.end(), is_normal)) {
    join_normal(study, laws, keeps_strata, shares, sample);
    shares = shares_of(laws, sample);  // strata have another order now
  }
  for (const StudyCorrelation& correlation : study.correlations) {
    if (is_normal(correlation)) continue;
    const Eigen::Index first = column_of(study, correlation.of[0].value);
    const Eigen::Index second = column_of(study, correlation.of[1].value);
    const SecondShare second_share(correlation);
    Eigen::VectorXd joined(shares.rows());
    for (Eigen::Index i = 0; i < joined.size(); ++i)
      joined[i] = second_share(shares(i, first), shares(i, second));
    if (keeps_strata)
      order_as(joined, as_index(second), sample);
    else
      take_shares(joined, laws[as_index(second)], as_index(second), sample);
  }
}

}  // namespace blocklift::pipeline

#include "pipeline/study/design/study_design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <openturns/OT.hxx>

#include "pipeline/declaration/reading.h"
#include "pipeline/study/design/copulas.h"

namespace blocklift::pipeline {
namespace {

using Kind = SpreadLaw::Kind;

double value_or(const std::optional<Located<Measure>>& key, double otherwise) {
  return key ? key->value.value : otherwise;
}

OT::Distribution law_of(const SpreadLaw& law) {
  const double mean = value_or(law.mean, 0), deviation = value_or(law.deviation, 1);
  switch (law.kind) {
    case Kind::normal:
      return OT::Normal(mean, deviation);
    case Kind::lognormal:
      return OT::ParametrizedDistribution(OT::LogNormalMuSigma(mean, deviation, 0));
    case Kind::uniform:
      return OT::Uniform(law.lowest->value.value, law.highest->value.value);
    case Kind::triangular:
      return OT::Triangular(law.lowest->value.value, law.mode->value.value,
                            law.highest->value.value);
    case Kind::gumbel:
      return OT::ParametrizedDistribution(OT::GumbelMuSigma(mean, deviation));
    case Kind::weibull:
      return OT::ParametrizedDistribution(OT::WeibullMinMuSigma(mean, deviation, 0));
    case Kind::unknown:
      break;
  }
  throw std::logic_error("a law that nobody knows");
}

bool may_be_cut(Kind kind) { return kind != Kind::uniform && kind != Kind::triangular; }

OT::Distribution cut_law_of(const SpreadLaw& law) {
  OT::Distribution whole = law_of(law);
  if (!may_be_cut(law.kind) || (!law.lowest && !law.highest)) return whole;
  const OT::Interval range = whole.getRange();
  const OT::Interval kept(OT::Point{value_or(law.lowest, range.getLowerBound()[0])},
                          OT::Point{value_or(law.highest, range.getUpperBound()[0])},
                          OT::Interval::BoolCollection{law.lowest ? 1U : 0U},
                          OT::Interval::BoolCollection{law.highest ? 1U : 0U});
  return OT::TruncatedDistribution(whole, kept);
}

/// A variable of values has a share of the unit interval for each.
OT::Distribution distribution_of(const StudyVariable& variable) {
  if (!variable.between.empty())
    return OT::Uniform(variable.between[0].value.value, variable.between[1].value.value);
  if (!variable.law) return OT::Uniform(0, static_cast<double>(variable.values.size()));
  try {
    return cut_law_of(*variable.law);
  } catch (const OT::Exception&) {
    Diagnostics diagnostics;
    diagnostics.error(variable.law->place,
                      fmt::format("the spread of \"{}\" is impossible: the law has no such "
                                  "moments, or nothing of it lies between its bounds",
                                  variable.name.value));
    throw InputError(diagnostics);
  }
}

Eigen::MatrixXd grid_of(const StudyFile& study) {
  Eigen::Index size = 1;
  for (const StudyVariable& variable : study.variables)
    size *= static_cast<Eigen::Index>(variable.values.size());
  Eigen::MatrixXd design(size, static_cast<Eigen::Index>(study.variables.size()));
  // The last variable runs fastest.
  Eigen::Index repeat = 1;
  for (Eigen::Index v = design.cols() - 1; v >= 0; --v) {
    const auto& values = study.variables[v].values;
    const auto count = static_cast<Eigen::Index>(values.size());
    for (Eigen::Index member = 0; member < size; ++member)
      design(member, v) = values[member / repeat % count].value.value;
    repeat *= count;
  }
  return design;
}

/// A search begins with a sample over the whole range, of half its members at most.
int sample_of_search(const StudyFile& study) {
  return std::min(study.members.value() / 2, 4 * (static_cast<int>(study.variables.size()) + 1));
}

OT::Sample sample_of(const StudyFile& study, const OT::Distribution& joint) {
  const auto size = static_cast<OT::UnsignedInteger>(
      study.design == StudyDesign::search ? sample_of_search(study) : study.members.value());
  switch (study.design) {
    case StudyDesign::latin_hypercube:
      return OT::LHSExperiment(joint, size).generate();
    case StudyDesign::low_discrepancy:
    case StudyDesign::search:
      return OT::LowDiscrepancyExperiment(OT::SobolSequence(), joint, size).generate();
    case StudyDesign::sensitivity:
      return OT::SobolIndicesExperiment(joint, size).generate();
    default:
      return joint.getSample(size);
  }
}

std::string unit_of(const Exponents& exponents) {
  using Named = std::pair<Exponents, const char*>;
  static const std::array<Named, 8> named{
      Named{{1, 1, -2, 0}, "N"},     Named{{2, 1, -2, 0}, "N m"},   Named{{0, 1, -2, 0}, "N/m"},
      Named{{-1, 1, -2, 0}, "Pa"},   Named{{1, 0, -1, 0}, "m/s"},   Named{{1, 0, -2, 0}, "m/s^2"},
      Named{{0, 1, -1, 0}, "N s/m"}, Named{{-3, 1, 0, 0}, "kg/m^3"}};
  for (const auto& [known, name] : named)
    if (known == exponents) return name;
  const std::array<std::pair<const char*, int>, 4> bases = {
      std::pair{"m", exponents.metre}, std::pair{"kg", exponents.kilogram},
      std::pair{"s", exponents.second}, std::pair{"rad", exponents.radian}};
  std::string text;
  for (const auto& [base, exponent] : bases) {
    if (exponent == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(base);
    if (exponent != 1) text += fmt::format("^{}", exponent);
  }
  return text;
}

Exponents exponents_of(const StudyVariable& variable) {
  if (!variable.between.empty()) return variable.between.front().value.exponents;
  if (!variable.law) return variable.values.front().value.exponents;
  for (const auto* key : {&variable.law->mean, &variable.law->lowest})
    if (*key) return (*key)->value.exponents;
  return {};
}

}  // namespace

Eigen::MatrixXd make_design(const StudyFile& study) {
  if (study.design == StudyDesign::grid) return grid_of(study);
  OT::ComposedDistribution::DistributionCollection laws;
  for (const StudyVariable& variable : study.variables) laws.add(distribution_of(variable));
  OT::RandomGenerator::SetSeed(
      static_cast<OT::UnsignedInteger>(study.seed ? study.seed->value : 1));
  OT::Sample sample = sample_of(study, OT::ComposedDistribution(laws));
  join_values(study, laws, sample);
  Eigen::MatrixXd design(static_cast<Eigen::Index>(sample.getSize()),
                         static_cast<Eigen::Index>(sample.getDimension()));
  for (Eigen::Index member = 0; member < design.rows(); ++member) {
    for (Eigen::Index v = 0; v < design.cols(); ++v) {
      const double drawn =
          sample(static_cast<OT::UnsignedInteger>(member), static_cast<OT::UnsignedInteger>(v));
      const StudyVariable& variable = study.variables[v];
      design(member, v) =
          variable.law || !variable.between.empty()
              ? drawn
              : variable
                    .values[std::min(variable.values.size() - 1, static_cast<std::size_t>(drawn))]
                    .value.value;
    }
  }
  return design;
}

std::pair<double, double> middle_range(const StudyVariable& variable) {
  constexpr double outside = 0.05;
  if (variable.law || !variable.between.empty()) {
    const OT::Distribution law = distribution_of(variable);
    return {law.computeQuantile(outside)[0], law.computeQuantile(1 - outside)[0]};
  }
  std::vector<double> values;
  for (const Located<Measure>& value : variable.values) values.push_back(value.value.value);
  std::ranges::sort(values);
  // The first that at least a twentieth of the values do not pass, and its like from above.
  const auto count = static_cast<double>(values.size());
  const auto below = static_cast<std::size_t>(std::ceil(outside * count - 1e-9)) - 1;
  return {values[below], values[values.size() - 1 - below]};
}

std::string unit_text(const StudyVariable& variable) { return unit_of(exponents_of(variable)); }

std::string value_text(const StudyVariable& variable, double value, int digits) {
  const std::string unit = unit_text(variable);
  return fmt::format("{:.{}g}{}{}", value, digits, unit.empty() ? "" : " ", unit);
}

std::string shown_value(const StudyVariable& variable, double value, int digits) {
  struct Multiple {
    const char* unit;
    double least;  ///< sizes from which it is used, SI
  };
  // Larger ones first; of one kind they share their exponents.
  static constexpr std::array<Multiple, 15> multiples = {{{"deg", 0},
                                                          {"deg/s", 0},
                                                          {"deg/s^2", 0},
                                                          {"MN", 1e6},
                                                          {"kN", 1e3},
                                                          {"MN m", 1e6},
                                                          {"kN m", 1e3},
                                                          {"MN m/rad", 1e6},
                                                          {"kN m/rad", 1e3},
                                                          {"MN/m", 1e6},
                                                          {"kN/m", 1e3},
                                                          {"GPa", 1e10},
                                                          {"MPa", 1e5},
                                                          {"kPa", 1e3},
                                                          {"t", 1e4}}};
  const Exponents exponents = exponents_of(variable);
  for (const Multiple& multiple : multiples) {
    const std::optional<Measure> one = find_unit(multiple.unit);
    if (!one || one->exponents != exponents || std::abs(value) < multiple.least) continue;
    const double number = value / one->value;
    // No powers of ten: all digits before the point are shown.
    if (std::abs(number) >= std::pow(10.0, digits) - 0.5)
      return fmt::format("{:.0f} {}", number, multiple.unit);
    return fmt::format("{:.{}g} {}", number, digits, multiple.unit);
  }
  return value_text(variable, value, digits);
}

}  // namespace blocklift::pipeline

#include "pipeline/standards/load_factors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "pipeline/standards/rigging_balance.h"

namespace blocklift::pipeline {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A sling that bears less than this share of the most loaded one's load hardly stresses the
/// structure, while its own load may grow by a large factor.
constexpr double least_share_of_structure = 0.25;

/// Factors of the slings at one lug in one column, and what they make of the sum of their forces.
class FactorsAtLug {
 public:
  explicit FactorsAtLug(const std::vector<SlingPull>& slings)
      : slings_(slings), factors_(slings.size(), 1) {}

  /// Multiplies each sling's factor. @returns by how much that lets the sum grow.
  double grow(const std::vector<double>& by) {
    for (std::size_t i = 0; i < by.size(); ++i) factors_[i] *= by[i];
    const double before = growth_;
    growth_ = largest_growth();
    return growth_ / before;
  }

 private:
  // The size of a sum is convex in each factor: it is largest where each is at an end of its range.
  double largest_growth() const {
    structure::Vector3 at_rest = structure::Vector3::Zero();
    for (const SlingPull& sling : slings_) at_rest += sling.force;
    if (!(at_rest.norm() > 0)) return *std::max_element(factors_.begin(), factors_.end());
    double most = 0;
    for (std::size_t set = 0; set < std::size_t{1} << slings_.size(); ++set) {
      structure::Vector3 sum = at_rest;
      for (std::size_t i = 0; i < slings_.size(); ++i)
        if ((set >> i & 1U) != 0) sum += (factors_[i] - 1) * slings_[i].force;
      most = std::max(most, sum.norm());
    }
    return most / at_rest.norm();
  }

  const std::vector<SlingPull>& slings_;
  std::vector<double> factors_;
  double growth_ = 1;
};

bool has_length_tolerance(const given::Standard& standard) {
  return standard.length_tolerance || standard.rules.length_tolerance;
}

/// Why nothing was computed from tolerances of length of the slings about a frame.
std::string why_no_tolerances(const given::Standard& standard) {
  if (!has_length_tolerance(standard)) return "no tolerance of lengths is given";
  return fmt::format(
      "the tolerance of lengths is not worked (more than {} slings have it, or baskets or a rope "
      "over two hooks bear the load)",
      RiggingBalance::most_toleranced);
}

/// What the standard takes for the skew of a frame: that of the rigid frame, or what its lengths'
/// tolerances make of it, if that is less. It is never less than the slings' own factor by them.
/// @param of_slings the rules' factor on slings; none or 1: no skew.
std::optional<double> skew_by_standard(const SpreaderFacts& frame,
                                       const std::optional<double>& of_slings) {
  if (!frame.skew_by_rules) return of_slings;
  if (!frame.skew_computed) return frame.skew_by_rules;
  return std::min(*frame.skew_by_rules, std::max(*frame.skew_computed, of_slings.value_or(1)));
}

/// The two figures in words, and which of them the standard's column has.
std::string frame_skew_in_words(const given::Standard& standard, const SpreaderFacts& frame,
                                const std::optional<double>& of_slings) {
  const std::optional<double>&by_rules = frame.skew_by_rules, &computed = frame.skew_computed;
  std::string text = "what its sides bear and its corners bend, over that without: ";
  if (by_rules)
    text += fmt::format(
        "{:.3g} with the slings of a diagonal at {:g} times their load on a rigid frame; ",
        *by_rules, of_slings.value_or(1));
  else if (of_slings)
    text += "by the slings' own factor, for no four of them meet over the frame; ";
  if (!computed) return text + why_no_tolerances(standard) + ", to which it would give way";
  text += fmt::format("{:.3g} with the worst set of length tolerances, to which it gives way",
                      *computed);
  if (by_rules && *computed < *by_rules)
    text +=
        "; the standard's column has the less of both, not below the slings' own factor, which is "
        "this program's reading: to the letter the clause asks for the first figure";
  return text;
}

}  // namespace

std::string load_text(double newtons) {
  return fmt::format("{:.1f} kN, {:.2f} t", newtons / 1e3, newtons / newton_per_tonne);
}

std::optional<double> LoadFacts::share_of_resharing() const {
  if (!(at_rest > 0) || !(in_motion > at_rest) || !(resharing > 0)) return {};
  return std::log(resharing) / std::log(in_motion / at_rest);
}

LoadFactors::LoadFactors(const given::Standard& standard, const LiftFacts& facts)
    : standard_(standard), facts_(facts) {}

const NamedFactor* LoadFactors::contingency() const {
  if (!standard_.weight_class) return nullptr;
  return find_by_name(rules().weight_classes, standard_.weight_class->value);
}

const HoistingClass* LoadFactors::hoisting_class() const {
  if (!standard_.hoisting_class) return nullptr;
  return find_by_name(rules().hoisting_classes, standard_.hoisting_class->value);
}

const AmplificationRow* LoadFactors::amplification_row() const {
  if (!standard_.setting) return nullptr;
  const auto* table = find_by_name(rules().dynamic_amplification, standard_.setting->value);
  return table ? &table->row_of(design_weight()) : nullptr;
}

double LoadFactors::design_weight() const {
  const NamedFactor* factor = contingency();
  return facts_.net_weight * (factor ? factor->value : 1);
}

double LoadFactors::static_hook_load() const { return design_weight() + facts_.rigging; }

double LoadFactors::hoisting_speed() const {
  double speed = 0;
  for (const HookFacts& hook : facts_.hooks) speed = std::max(speed, hook.hoisting_speed);
  return speed;
}

double LoadFactors::amplification(double hoisting_speed) const {
  if (const AmplificationRow* row = amplification_row()) return row->at(static_hook_load());
  const HoistingClass* hoisting = hoisting_class();
  return hoisting ? hoisting->at(hoisting_speed) : 1;
}

void LoadFactors::add_contingency(ChainBuilder& chain) const {
  const NamedFactor* factor = contingency();
  if (!factor) return;
  chain.times("weight contingency", factor->value, factor->value, factor->clause,
              "weight class " + standard_.weight_class->value);
}

std::optional<LoadFactors::Factor> LoadFactors::centre(const ComputedFactors& computed) const {
  // It is a factor on shares of the weight. What bears all of it has no share that the centre could
  // move, and 0027/ND makes its static hook load of design weight and rigging without it.
  if (computed.bears_all && (standard_.centre_box || rules().centre_of_mass))
    return Factor{"centre of mass",
                  {},
                  {},
                  standard_.centre_box ? "standard.centre_box" : rules().centre_of_mass->clause,
                  "it bears all of the load, wherever the centre lies: it does not apply"};
  if (standard_.centre_box && computed.centre_box) {
    const Vector3& box = *standard_.centre_box;
    return Factor{
        "centre of mass", computed.centre_box, computed.centre_box, "standard.centre_box",
        fmt::format("at the worst corner of +-({:g}, {:g}, {:g}) m", box.x(), box.y(), box.z())};
  }
  if (const auto& factor = rules().centre_of_mass)
    return Factor{"centre of mass", factor->value, factor->value, factor->clause,
                  standard_.centre_box
                      ? "the box of the centre is not worked here: the rules' factor"
                      : "no box of the centre is given"};
  if (standard_.centre_box)
    return Factor{"centre of mass",
                  {},
                  {},
                  "standard.centre_box",
                  "not worked here, and the rules have no factor"};
  return {};
}

void LoadFactors::add_amplification(ChainBuilder& chain, std::optional<double> simulated,
                                    double hoisting_speed) const {
  const char* name = "dynamic amplification";
  if (const AmplificationRow* row = amplification_row()) {
    const double load = static_hook_load();
    chain.times(
        name, row->at(load), simulated, row->clause,
        fmt::format("{}, weight {:.1f} t, static hook load {:.1f} t", standard_.setting->value,
                    design_weight() / newton_per_tonne, load / newton_per_tonne));
  } else if (const HoistingClass* hoisting = hoisting_class()) {
    chain.times(name, hoisting->at(hoisting_speed), simulated, hoisting->clause,
                fmt::format("{}: {:g} + {:g} x {:.3f} m/s", hoisting->name.value, hoisting->least,
                            hoisting->per_speed, hoisting_speed));
  } else {
    chain.times(name, {}, simulated, "", "the rules have none");
  }
}

void LoadFactors::add_resharing(ChainBuilder& chain, const LoadFacts& load) {
  const auto share = load.share_of_resharing();
  std::string text = "no increase by motion";
  if (share && *share < 0)
    text = "its share of the whole load is smaller in motion";
  else if (share && *share > 1)
    text = "all of the increase by motion: the whole load is smaller at that instant";
  else if (share)
    text = fmt::format("{:.0f} % of the increase by motion", 100 * *share);
  chain.times("re-sharing in motion", {}, load.resharing, "simulation", std::move(text));
}

std::optional<LoadFactors::Factor> LoadFactors::tilt(const ComputedFactors& computed) const {
  if (!standard_.tilt) return {};
  const TiltRule& rule = *find_by_name(rules().tilt, standard_.tilt->value);
  if (!computed.two_hooks)
    return Factor{"tilt",
                  {},
                  {},
                  rule.clause,
                  "not worked: the formula is for the share of one of two hooks or two cranes"};
  const TwoHooks& hooks = *computed.two_hooks;
  const std::optional<double> angle = tilt_angle(hooks, rule.angle, rule.height);
  std::string formula =
      angle ? fmt::format("{:.2f} degrees", *angle / degree)
            : fmt::format("hooks {:.2f} m apart that may differ by {:g} m in height: all of it",
                          hooks.span(), *rule.height);
  formula +=
      fmt::format("; lift points {:.2f} and {:.2f} m from the centre, {:.2f} and {:.2f} m above it",
                  hooks.along, hooks.other_along, hooks.height, hooks.other_height);
  if (std::max(hooks.spread.towards, hooks.spread.away) > 0.005)
    formula += fmt::format(", spread by {:.2f} m below the hook {:.2f} m above them",
                           hooks.spread.towards + hooks.spread.away, hooks.spread.height);
  return Factor{"tilt", tilt_factor(hooks, angle), {}, rule.clause, std::move(formula)};
}

std::optional<LoadFactors::Factor> LoadFactors::yaw(int slings_on_hook) const {
  if (!rules().yaw || !standard_.tilt) return {};
  const bool several = slings_on_hook > 1;
  return Factor{"yaw",
                several ? std::optional(rules().yaw->value) : std::nullopt,
                {},
                rules().yaw->clause,
                several ? fmt::format("{} slings on the hook", slings_on_hook)
                        : "one sling on the hook: it does not apply"};
}

void LoadFactors::add(ChainBuilder& chain, std::optional<Factor> factor) {
  if (factor)
    chain.times(factor->name, factor->standard, factor->simulated, factor->clause,
                std::move(factor->formula));
}

void LoadFactors::add_centre(ChainBuilder& chain, const ComputedFactors& computed) const {
  add(chain, centre(computed));
}

void LoadFactors::add_tilt(ChainBuilder& chain, const ComputedFactors& computed) const {
  add(chain, tilt(computed));
}

void LoadFactors::add_yaw(ChainBuilder& chain, int slings_on_hook) const {
  add(chain, yaw(slings_on_hook));
}

std::vector<const SlingFacts*> LoadFactors::slings_that_load(const StressFacts& stress) const {
  std::vector<const SlingFacts*> all, own;
  double most = 0;
  for (const SlingFacts& sling : facts_.slings)
    if (sling.is_at_load) most = std::max(most, sling.load.at_rest);
  for (const SlingFacts& sling : facts_.slings) {
    if (!sling.is_at_load || sling.load.at_rest < least_share_of_structure * most) continue;
    all.push_back(&sling);
    if (stress.is_at_lug && sling.lug == stress.lug) own.push_back(&sling);
  }
  return own.empty() ? all : own;
}

void LoadFactors::add_largest(
    ChainBuilder& chain, const StressFacts& stress,
    const std::function<std::optional<Factor>(const SlingFacts&)>& factor_of) const {
  std::optional<Factor> largest;
  const auto size = [](const Factor& factor) { return factor.standard.value_or(0); };
  for (const SlingFacts* sling : slings_that_load(stress)) {
    std::optional<Factor> factor = factor_of(*sling);
    if (!factor || (largest && size(*factor) <= size(*largest))) continue;
    if (factor->standard) factor->formula = fmt::format("as {}: {}", sling->name, factor->formula);
    largest = std::move(factor);
  }
  // A load table has no slings.
  add(chain, largest ? std::move(largest) : factor_of(SlingFacts()));
}

void LoadFactors::add_structure_centre(ChainBuilder& chain, const StressFacts& stress) const {
  add_largest(chain, stress, [&](const SlingFacts& sling) { return centre(sling.computed); });
}

void LoadFactors::add_structure_tilt(ChainBuilder& chain, const StressFacts& stress) const {
  add_largest(chain, stress, [&](const SlingFacts& sling) { return tilt(sling.computed); });
  add_largest(chain, stress, [&](const SlingFacts& sling) { return yaw(sling.slings_on_hook); });
}

std::optional<LoadFactors::Factor> LoadFactors::skew(const ComputedFactors& computed) const {
  const NamedFactor* factor =
      standard_.skew ? find_by_name(rules().skew, standard_.skew->value) : nullptr;
  const std::optional<double> by_rules = factor ? std::optional(factor->value) : std::nullopt;
  if (!factor && !computed.skew) return {};
  return Factor{"skew of sling lengths", by_rules, computed.skew ? computed.skew : by_rules,
                factor ? factor->clause : "",
                computed.skew
                    ? "computed by re-sharing for all sets of length tolerances"
                    : standard_.skew->value + (has_length_tolerance(standard_)
                                                   ? "; not computed from the tolerance of lengths"
                                                   : "; no tolerance of lengths is given")};
}

void LoadFactors::add_skew(ChainBuilder& chain, const ComputedFactors& computed) const {
  add(chain, skew(computed));
}

void LoadFactors::add_diagonal_skew(ChainBuilder& chain, std::optional<double> by_rules,
                                    std::optional<double> computed, const char* what) const {
  if (!by_rules && !computed) return;
  const NamedFactor* factor =
      standard_.skew ? find_by_name(rules().skew, standard_.skew->value) : nullptr;
  chain.times("skew on either diagonal", by_rules, computed ? computed : by_rules,
              factor ? factor->clause : "",
              fmt::format("{} with the slings of a diagonal at {} of their load, over that "
                          "without",
                          what, factor ? fmt::format("{:g} times", factor->value) : "the largest"));
}

void LoadFactors::add_structure_skew(ChainBuilder& chain, const StressFacts& stress) const {
  add_diagonal_skew(chain, stress.skew_by_rules, stress.skew_computed, "stress");
}

void LoadFactors::add_frame_skew(ChainBuilder& chain, const SpreaderFacts& frame) const {
  const NamedFactor* factor =
      standard_.skew ? find_by_name(rules().skew, standard_.skew->value) : nullptr;
  if (!frame.is_frame || (!frame.skew_by_rules && !frame.skew_computed)) {
    std::optional<Factor> slings = skew(frame.computed);
    if (!slings) return;
    if (frame.is_frame && slings->standard.value_or(1) > 1)
      slings->formula +=
          "; of the slings: no four of them meet over the frame, so that no "
          "diagonal of it is skewed by itself";
    add(chain, slings);
    return;
  }
  const std::optional<double> of_slings =
      factor && factor->value > 1 ? std::optional(factor->value) : std::nullopt;
  chain.times(frame.skew_by_rules ? "skew on either diagonal" : "skew of sling lengths",
              skew_by_standard(frame, of_slings),
              frame.skew_computed ? frame.skew_computed : frame.skew_by_rules,
              factor ? factor->clause : "", frame_skew_in_words(standard_, frame, of_slings));
}

void LoadFactors::add_lift_point_consequence(ChainBuilder& chain) const {
  if (const auto& consequence = rules().consequence)
    chain.times("consequence", consequence->lift_point.value, consequence->lift_point.value,
                consequence->lift_point.clause);
}

void LoadFactors::add_load(ChainBuilder& chain, const LoadFacts& load) const {
  const auto when = [](const std::optional<double>& time) {
    return time ? fmt::format(" at {:.1f} s", *time) : std::string();
  };
  chain.add("largest load at rest", load.at_rest, facts_.rest_is_from,
            fmt::format("{}{}; in motion {}{}", load_text(load.at_rest), when(load.time_at_rest),
                        load_text(load.in_motion), when(load.time_in_motion)));
}

void LoadFactors::add_all_but_skew(ChainBuilder& chain, const LoadFacts& load,
                                   const ComputedFactors& computed, int slings_on_hook,
                                   bool in_motion) const {
  add_load(chain, load);
  add_contingency(chain);
  add_centre(chain, computed);
  if (in_motion) {
    add_amplification(chain, load.amplification, hoisting_speed());
    add_resharing(chain, load);
  }
  add_tilt(chain, computed);
  add_yaw(chain, slings_on_hook);
}

void LoadFactors::add_all(ChainBuilder& chain, const LoadFacts& load,
                          const ComputedFactors& computed, int slings_on_hook,
                          bool in_motion) const {
  add_all_but_skew(chain, load, computed, slings_on_hook, in_motion);
  add_skew(chain, computed);
}

void LoadFactors::add_all_at_lug(ChainBuilder& chain, const LugPull& pull, bool in_motion) const {
  if (pull.slings.size() < 2) {
    const SlingPull alone = pull.slings.empty() ? SlingPull() : pull.slings.front();
    add_all(chain, pull.load, alone.computed, alone.slings_on_hook, in_motion);
    return;
  }
  FactorsAtLug by_standard(pull.slings), simulated(pull.slings);
  const auto add_of_each = [&](const auto& factor_of) {
    std::vector<double> standards, simulations;
    std::optional<Factor> shown;
    std::string each;
    double most = 0;
    for (const SlingPull& sling : pull.slings) {
      const std::optional<Factor> factor = factor_of(sling);
      standards.push_back(factor ? factor->standard.value_or(1) : 1);
      simulations.push_back(factor ? factor->simulated.value_or(1) : 1);
      if (!factor) continue;
      const double larger = std::max(standards.back(), simulations.back());
      each += fmt::format("{}{} {:.3f}", each.empty() ? "" : ", ", sling.sling, larger);
      if (larger <= most) continue;
      most = larger;
      Factor worst = *factor;
      worst.formula = fmt::format("{}: {}", sling.sling, factor->formula);
      if (shown && !worst.standard) worst.standard = shown->standard;
      if (shown && !worst.simulated) worst.simulated = shown->simulated;
      shown = std::move(worst);
    }
    if (!shown) return;
    const double standard = by_standard.grow(standards), computed = simulated.grow(simulations);
    if (shown->standard) shown->standard = standard;
    if (shown->simulated) shown->simulated = computed;
    shown->formula = fmt::format("of the sum of {}; {}", each, shown->formula);
    add(chain, std::move(shown));
  };
  add_load(chain, pull.load);
  add_contingency(chain);
  add_of_each([&](const SlingPull& sling) { return centre(sling.computed); });
  if (in_motion) {
    add_amplification(chain, pull.load.amplification, hoisting_speed());
    add_resharing(chain, pull.load);
  }
  add_of_each([&](const SlingPull& sling) { return tilt(sling.computed); });
  add_of_each([&](const SlingPull& sling) { return yaw(sling.slings_on_hook); });
  add_of_each([&](const SlingPull& sling) { return skew(sling.computed); });
}

}  // namespace blocklift::pipeline

#include "pipeline/files/rigging/rigging_stock.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pipeline/declaration/quantity.h"
#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {
namespace {

/// Standards round working loads to a series of numbers, up by a few per cent at most.
constexpr double least_of_rule = 0.97;
/// A breaking load that was tested may lie above the one that the rule asks for.
constexpr double most_of_rule = 1.25;

/// Mean shear of a pin in both planes when its shackle breaks, Pa: forged steels of 400 to 1200
/// MPa.
constexpr StrengthRange pin_shear{200e6, 750e6};
/// Mean tension of both sides of a master link when it breaks, Pa. Its ends are bent and break
/// first, so that this is half or less of what alloy steel of 700 to 1200 MPa bears.
constexpr StrengthRange link_tension{150e6, 600e6};
/// Forged links are fuller than round bar at their ends, or flattened at their sides.
constexpr double mass_tolerance = 0.15;
/// Tread over rope. Below 8 a rope loses a sixth of its strength; ropes that run have up to 40.
constexpr StrengthRange tread_ratio{8, 60};

Format<WorkingLoadRule> rule_format() {
  Table<WorkingLoadRule> table("rule of working loads",
                               "efficiency x breaking load = safety_factor x working load.");
  table.required("name", &WorkingLoadRule::name, text(), "of the standard or rule, with its clause")
      .required("safety_factor", &WorkingLoadRule::safety_factor, number(Range::at_least(1)),
                "of all items that do not have their own")
      .by_default("efficiency", &WorkingLoadRule::efficiency, number(Range::between(0.1, 1)), "1",
                  "share of the breaking load that terminations leave")
      .required("formula", &WorkingLoadRule::formula, text(),
                "by which breaking load, mass and stiffness were worked");
  return table.format();
}

Format<StockSling> sling_format() {
  Table<StockSling> table("sling", "A sling in stock, of whatever length.");
  table
      .required("rope", &StockSling::rope_choice, rope_choice_format(true),
                "name of the rope's model file, or the rope's keys; its mass tells whether it can "
                "be as strong")
      .required("working_load", &StockSling::working_load,
                quantity(Dimension::load, Range::positive()), "of one part, straight")
      .optional("safety_factor", &StockSling::safety_factor, number(Range::at_least(1)),
                "in place of the rule's");
  return table.format();
}

Format<StockShackle> shackle_format() {
  const Format<double> load = quantity(Dimension::load, Range::positive());
  const Format<double> length = quantity(Dimension::length, Range::positive());
  Table<StockShackle> table("shackle", "A bow shackle in stock.");
  table.required("working_load", &StockShackle::working_load, load, "WLL, in line")
      .required("breaking_load", &StockShackle::breaking_load, load, "smallest breaking load")
      .required("body", &StockShackle::body, length, "diameter of the bow")
      .required("pin", &StockShackle::pin, length, "diameter of the pin")
      .required("inside_width", &StockShackle::inside_width, length, "between the eyes, at the pin")
      .required("mass", &StockShackle::mass, quantity(Dimension::mass, Range::positive()),
                "of shackle and pin");
  return table.format();
}

Format<StockMasterLink> master_link_format() {
  const Format<double> load = quantity(Dimension::load, Range::positive());
  const Format<double> length = quantity(Dimension::length, Range::positive());
  Table<StockMasterLink> table("master link", "An oblong master link of round bar in stock.");
  table.required("working_load", &StockMasterLink::working_load, load, "WLL, of all legs together")
      .required("breaking_load", &StockMasterLink::breaking_load, load, "smallest breaking load")
      .required("bar", &StockMasterLink::bar, length, "diameter of the bar")
      .required("inside_length", &StockMasterLink::inside_length, length, "along the pull")
      .required("inside_width", &StockMasterLink::inside_width, length, "across it")
      .required("mass", &StockMasterLink::mass, quantity(Dimension::mass, Range::positive()),
                "as its bar would weigh within 15 %");
  return table.format();
}

Format<StockSheave> sheave_format() {
  const Format<double> load = quantity(Dimension::load, Range::positive());
  const Format<double> length = quantity(Dimension::length, Range::positive());
  Table<StockSheave> table("sheave", "A sheave in stock over which slings are led.");
  table.required("working_load", &StockSheave::working_load, load, "on its pin")
      .required("breaking_load", &StockSheave::breaking_load, load,
                "smallest breaking load, on its pin")
      .required("rope", &StockSheave::rope, length, "largest diameter that the groove takes")
      .required("tread", &StockSheave::tread, length, "diameter at the bottom of the groove")
      .required("mass", &StockSheave::mass, quantity(Dimension::mass, Range::positive()),
                "of the sheave without its block");
  return table.format();
}

Format<StockSpreader> stock_spreader_format() {
  Table<StockSpreader> table("spreader in stock", "A spreader bar or frame in stock.");
  table
      .required("bar", &StockSpreader::bar, spreader_format(),
                "its keys, as a case has them under spreaders")
      .required("working_load", &StockSpreader::working_load,
                quantity(Dimension::load, Range::positive()),
                "that hangs below it, on all its ends or corners alike, without skew by wrong "
                "lengths of slings")
      .required(
          "sling_angle", &StockSpreader::sling_angle,
          quantity(Dimension::angle, Range::inside(0, std::numbers::pi / 2)),
          "of the slings above it, which meet over its middle, to the level; the least for this "
          "load");
  return table.format();
}

void require_contents(const RiggingStock& stock, Reading& reading, const Mark& mark) {
  if (stock.source.find_first_not_of(' ') == std::string::npos)
    reading.error(mark,
                  "the stock has no source: say from which standard or certificate its "
                  "figures are");
  if (stock.slings.empty() && stock.shackles.empty() && stock.master_links.empty() &&
      stock.sheaves.empty() && stock.spreaders.empty())
    reading.error(mark,
                  "the stock has neither slings nor shackles, nor master links, sheaves or "
                  "spreaders");
  if (!stock.slings.empty() && !stock.construction)
    reading.error(mark, "the stock has slings and no construction",
                  {"add construction: wire_rope, cable_laid, grommet, hmpe_round, polyester_round "
                   "or short_link_chain"});
}

void check_by_rule(const Located<std::string>& item, double breaking, double working, double factor,
                   const WorkingLoadRule& rule, Diagnostics& diagnostics) {
  const double ratio = rule.efficiency * breaking / (factor * working);
  if (!std::isfinite(ratio) || (ratio >= least_of_rule && ratio <= most_of_rule)) return;
  diagnostics.error(
      item.mark,
      fmt::format("{}: breaking load {} over working load {} is {:.3g}; {} asks for {:.3g}{}",
                  item.value, format_quantity(breaking, Dimension::force),
                  format_quantity(working, Dimension::force), breaking / working, rule.name,
                  factor / rule.efficiency,
                  rule.efficiency < 1
                      ? fmt::format(" ({:g} over the efficiency {:g})", factor, rule.efficiency)
                      : ""));
}

void check_sling_mass(const StockSling& sling, SlingConstruction construction,
                      Diagnostics& diagnostics) {
  if (!std::isfinite(sling.rope.breaking_load)) return;
  if (!sling.rope.mass_per_length) {
    diagnostics.error(sling.name.mark,
                      fmt::format("the rope of sling {} has no mass", sling.name.value));
    return;
  }
  const StrengthRange range = strength_range(construction);
  const double strength = sling.rope.breaking_load / *sling.rope.mass_per_length;
  if (!std::isfinite(strength) || (strength >= range.least && strength <= range.most)) return;
  diagnostics.error(
      sling.name.mark,
      fmt::format("{}: breaking load over mass is {:.3g} kN m/kg; {:.3g} to {:.3g} "
                  "are made of this construction",
                  sling.name.value, strength / 1e3, range.least / 1e3, range.most / 1e3));
}

void check_shackle(const StockShackle& shackle, Diagnostics& diagnostics) {
  const double area = 2 * std::numbers::pi / 4 * shackle.pin * shackle.pin;
  const double shear = shackle.breaking_load / area;
  if (!std::isfinite(shear) || (shear >= pin_shear.least && shear <= pin_shear.most)) return;
  diagnostics.error(
      shackle.name.mark,
      fmt::format("{}: at the breaking load the pin of {:.4g} mm has a shear of {:.3g} MPa; {:.3g} "
                  "to {:.3g} are what forged pins bear",
                  shackle.name.value, shackle.pin * 1e3, shear / 1e6, pin_shear.least / 1e6,
                  pin_shear.most / 1e6));
}

void check_master_link(const StockMasterLink& link, Diagnostics& diagnostics) {
  const double mass = link.mass_of_bar();
  if (std::isfinite(mass) && std::abs(link.mass / mass - 1) > mass_tolerance)
    diagnostics.error(link.name.mark,
                      fmt::format("{}: its mass is {:.3g} kg; that of its bar by the measures is "
                                  "{:.3g} kg",
                                  link.name.value, link.mass, mass));
  const double tension = link.breaking_load / (2 * std::numbers::pi / 4 * link.bar * link.bar);
  if (!std::isfinite(tension) || (tension >= link_tension.least && tension <= link_tension.most))
    return;
  diagnostics.error(
      link.name.mark,
      fmt::format("{}: at the breaking load the sides of {:.4g} mm bear {:.3g} MPa on the mean; "
                  "{:.3g} to {:.3g} are what forged links bear",
                  link.name.value, link.bar * 1e3, tension / 1e6, link_tension.least / 1e6,
                  link_tension.most / 1e6));
}

void check_sheave(const StockSheave& sheave, Diagnostics& diagnostics) {
  const double ratio = sheave.tread / sheave.rope;
  if (std::isfinite(ratio) && (ratio < tread_ratio.least || ratio > tread_ratio.most))
    diagnostics.error(sheave.name.mark,
                      fmt::format("{}: tread over rope is {:.3g}; sheaves have {:g} to {:g}",
                                  sheave.name.value, ratio, tread_ratio.least, tread_ratio.most));
  // A disc of steel of the tread's diameter, as thick as its rim, is heavier by far; a rim alone,
  // of the rope's own section, lighter.
  const double round = std::numbers::pi / 4 * bar_density;
  const double disc = round * std::pow(sheave.tread + 3 * sheave.rope, 2) * 2.5 * sheave.rope;
  const double rim = round * std::numbers::pi * sheave.tread * sheave.rope * sheave.rope;
  if (!std::isfinite(disc) || (sheave.mass >= rim && sheave.mass <= disc)) return;
  diagnostics.error(sheave.name.mark,
                    fmt::format("{}: its mass is {:.3g} kg; steel of its measures weighs between "
                                "{:.3g} kg, a rim alone, and {:.3g} kg, a full disc",
                                sheave.name.value, sheave.mass, rim, disc));
}

void check_spreader(const StockSpreader& spreader, double factor, Diagnostics& diagnostics) {
  const given::Spreader& bar = spreader.bar;
  const BarSection& section = bar.section.value;
  if (!section.is_whole() || !(bar.yield_stress > 0) || !(bar.length.value > 0)) return;
  if (bar.is_frame() && !(*bar.width > 0)) return;
  if (bar.cross_section && !bar.cross_section->value.is_whole()) return;
  const double use = spreader.utilisation(factor);
  if (!(use > 1 / least_of_rule)) return;
  diagnostics.error(
      spreader.name.mark,
      fmt::format("{}: under its working load, times {:g}, it bears {:.3f} of its resistance "
                  "(EN 1993-1-1)",
                  spreader.name.value, factor, use));
}

}  // namespace

double StockMasterLink::mass_of_bar() const {
  const double line = std::numbers::pi * (inside_width + bar) + 2 * (inside_length - inside_width);
  return bar_density * std::numbers::pi / 4 * bar * bar * line;
}

double StockSpreader::utilisation(double factor) const {
  constexpr double gravity = 9.80665;
  std::vector<structure::PointForce> forces;
  std::vector<Vector3> points;
  const std::vector<std::string> eyes = bar.eye_names();
  const double share = 2.0 / static_cast<double>(eyes.size());
  for (const std::string& name : eyes) {
    const bool is_upper = name.starts_with("upper");
    // Its own weight hangs on the slings above, too.
    const double upright = share * (working_load + (is_upper ? bar.mass() * gravity : 0));
    points.push_back(*bar.eye(name));
    Vector3 force(0, 0, -upright);
    if (is_upper) {
      const Vector3 level(points.back().x(), points.back().y(), 0);
      force = -level.normalized() * upright / std::tan(sling_angle) + Vector3(0, 0, upright);
    }
    forces.push_back({points.back(), force});
  }
  const SpreaderStrength strength(bar, points);
  return strength.utilisation(strength.find_forces(forces), factor);
}

const std::vector<std::pair<std::string, SlingConstruction>>& sling_constructions() {
  using enum SlingConstruction;
  static const std::vector<std::pair<std::string, SlingConstruction>> all{
      {"wire_rope", wire_rope},
      {"cable_laid", cable_laid},
      {"grommet", grommet},
      {"hmpe_round", hmpe_round},
      {"polyester_round", polyester_round},
      {"short_link_chain", short_link_chain}};
  return all;
}

StrengthRange strength_range(SlingConstruction construction) {
  switch (construction) {
    case SlingConstruction::wire_rope:
      return {110e3, 200e3};
    case SlingConstruction::cable_laid:
      return {90e3, 170e3};
    case SlingConstruction::grommet:
      return {70e3, 150e3};
    case SlingConstruction::hmpe_round:
      return {500e3, 1900e3};
    case SlingConstruction::polyester_round:
      return {120e3, 450e3};
    case SlingConstruction::short_link_chain:
      return {40e3, 95e3};
  }
  return {};
}

Format<RiggingStock> rigging_stock_format() {
  Table<RiggingStock> table(
      "rigging",
      "Rigging in stock (slings, shackles, master links, sheaves, spreader bars), from which a "
      "lift is rigged: each file of one kind, with the source of its figures.");
  table
      .required("kind", &RiggingStock::kind, choice<std::string>({{"rigging", "rigging"}}),
                "what this file describes")
      .required("title", &RiggingStock::title, text(), "for people")
      .required("source", &RiggingStock::source, text(),
                "standard, rule or certificates, and how far the figures can be trusted")
      .required("rule", &RiggingStock::rule, rule_format(), "that working loads follow")
      .optional("construction", &RiggingStock::construction,
                choice<SlingConstruction>(sling_constructions()),
                "of all slings of the file; of a grommet both parts are meant, of a round sling "
                "too")
      .optional("slings", &RiggingStock::slings, named_tables(sling_format()), "by name")
      .optional("shackles", &RiggingStock::shackles, named_tables(shackle_format()), "by name")
      .optional("master_links", &RiggingStock::master_links, named_tables(master_link_format()),
                "by name")
      .optional("sheaves", &RiggingStock::sheaves, named_tables(sheave_format()), "by name")
      .optional("spreaders", &RiggingStock::spreaders, named_tables(stock_spreader_format()),
                "by name; the rule's safety factor is that of the bar against buckling and yield")
      .place(&RiggingStock::place)
      .rule(require_contents);
  return table.format();
}

void check_rigging_stock(const RiggingStock& stock, Diagnostics& diagnostics) {
  for (const StockSling& sling : stock.slings) {
    check_by_rule(sling.name, sling.rope.breaking_load, sling.working_load,
                  stock.safety_factor_of(sling), stock.rule, diagnostics);
    if (stock.construction) check_sling_mass(sling, *stock.construction, diagnostics);
  }
  for (const StockShackle& shackle : stock.shackles) {
    check_by_rule(shackle.name, shackle.breaking_load, shackle.working_load,
                  stock.rule.safety_factor, stock.rule, diagnostics);
    check_shackle(shackle, diagnostics);
  }
  for (const StockMasterLink& link : stock.master_links) {
    check_by_rule(link.name, link.breaking_load, link.working_load, stock.rule.safety_factor,
                  stock.rule, diagnostics);
    check_master_link(link, diagnostics);
  }
  for (const StockSheave& sheave : stock.sheaves) {
    check_by_rule(sheave.name, sheave.breaking_load, sheave.working_load, stock.rule.safety_factor,
                  stock.rule, diagnostics);
    check_sheave(sheave, diagnostics);
  }
  for (const StockSpreader& spreader : stock.spreaders)
    check_spreader(spreader, stock.rule.safety_factor, diagnostics);
}

}  // namespace blocklift::pipeline

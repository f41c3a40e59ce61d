#include "structure/practice/padeye_formulas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace blocklift::structure {

namespace {

const char* const working_stress = "working-stress design: 0.9, 0.4, 0.6, 0.66, 0.75 of yield";
const char* const dnv = "DNV 2.7-3 (2011), section 3.4";
const char* const asme = "ASME BTH-1 (2014), section 3-3.3";
const char* const eurocode = "EN 1993-1-8 (2005), 3.13";
const char* const practice = "GL Noble Denton 0027/ND rev. 11.2 (2016)";

PadeyeFormula at_most(const char* name, double demand, double limit, const char* unit,
                      const char* source) {
  return {name, demand, limit, unit, demand / limit, source};
}

PadeyeFormula at_least(const char* name, double demand, double limit, const char* source) {
  return {name,
          demand,
          limit,
          "m",
          demand > 0 ? limit / demand : std::numeric_limits<double>::infinity(),
          source};
}

/// Plates of one radius: how thick they are together, and how thick one is.
struct Plates {
  double radius = 0, thickness = 0, single = 0;
};

std::vector<Plates> plates_of(const PadeyeGeometry& g) {
  std::vector<Plates> plates{{g.radius, g.thickness, g.thickness}};
  if (g.has_cheeks()) plates.push_back({g.cheek_radius, 2 * g.cheek_thickness, g.cheek_thickness});
  return plates;
}

/// sum t (2 R - D_H) over the plates: the section across the hole, m^2.
double net_section(const PadeyeGeometry& g) {
  double area = 0;
  for (const Plates& plates : plates_of(g))
    area += plates.thickness * (2 * plates.radius - g.hole_diameter);
  return area;
}

double hertz_stress(const PadeyeFormulaInput& input, double force) {
  const PadeyeGeometry& g = input.geometry;
  const double e = input.material.youngs_modulus, t = g.bearing_thickness();
  if (g.pin_diameter >= 0.94 * g.hole_diameter)
    return 0.045 * std::sqrt(force * e / (g.hole_diameter * t));
  return 0.18 * std::sqrt(force * (1 / g.pin_diameter - 1 / g.hole_diameter) * e / t);
}

/// What comes down to a plane parallel to the base, at a depth below it.
struct BaseLoad {
  double pull = 0;      ///< across the plane, N; negative where the padeye is pressed down
  double shear = 0;     ///< in it, N
  double in_plane = 0;  ///< moments about the middle of the base, N m
  double out_of_plane = 0;
};

BaseLoad base_load(const PadeyeGeometry& g, const Vector3& force, double depth) {
  const double aside = (g.base_right - g.base_left) / 2;  // of the base's middle from the hole's
  const double arm = g.height + depth;
  return {force.y(), std::hypot(force.x(), force.z()),
          std::abs(force.x() * arm + force.y() * aside), std::abs(force.z()) * arm};
}

/// Lines of weld: throat area and section moduli.
struct WeldGroup {
  double area = 0, in_plane = 0, out_of_plane = 0;

  double resultant(const BaseLoad& load) const {
    const double across =
        std::abs(load.pull) / area + load.in_plane / in_plane + load.out_of_plane / out_of_plane;
    return std::hypot(across, load.shear / area);
  }
};

void add_base_weld(const PadeyeFormulaInput& input, const Vector3& force,
                   std::vector<PadeyeFormula>& formulas) {
  if (!(input.base_weld > 0)) return;
  const PadeyeGeometry& g = input.geometry;
  const double length = g.base_left + g.base_right;
  const double throat = input.base_weld / std::numbers::sqrt2;
  const WeldGroup weld{2 * throat * length, throat * length * length / 3,
                       throat * length * g.thickness};
  formulas.push_back(at_most("base welds: fillets on both sides",
                             weld.resultant(base_load(g, force, 0)),
                             0.4 * input.material.yield_stress, "Pa", working_stress));
}

void add_doubler(const PadeyeFormulaInput& input, const Vector3& force,
                 std::vector<PadeyeFormula>& formulas) {
  if (!input.doubler) return;
  const PadeyeGeometry& g = input.geometry;
  const PadeyeDoubler& d = *input.doubler;
  const double yield = input.material.yield_stress;
  const double throat = d.weld / std::numbers::sqrt2, both = d.length * d.width;
  const WeldGroup around{2 * throat * (d.length + d.width),
                         throat * (d.length * d.length / 3 + both),
                         throat * (d.width * d.width / 3 + both)};
  formulas.push_back(at_most("doubler: fillet all around",
                             around.resultant(base_load(g, force, d.thickness)), 0.4 * yield, "Pa",
                             working_stress));
  const BaseLoad load = base_load(g, force, 0);
  const double base = g.base_left + g.base_right;
  const double line = std::max(0.0, load.pull) / base + 6 * load.in_plane / (base * base);  // N/m
  const double bending = line * d.width / 4 + load.out_of_plane / (2 * base);
  formulas.push_back(at_most("doubler: bending between its welds",
                             6 * bending / (d.thickness * d.thickness), 0.75 * yield, "Pa",
                             working_stress));
  const double pressed = std::max(0.0, -load.pull) / base + 6 * load.in_plane / (base * base);
  formulas.push_back(at_most("doubler: bearing of the base", pressed / g.thickness, 0.9 * yield,
                             "Pa", working_stress));
}

void add_base(const PadeyeFormulaInput& input, const Vector3& force,
              std::vector<PadeyeFormula>& formulas) {
  const PadeyeGeometry& g = input.geometry;
  const double yield = input.material.yield_stress;
  const double width = g.base_left + g.base_right, area = width * g.thickness;
  const BaseLoad load = base_load(g, force, 0);
  const double sum = std::abs(load.pull) / area / (0.6 * yield) +
                     6 * load.in_plane / (area * width) / (0.66 * yield) +
                     6 * load.out_of_plane / (area * g.thickness) / (0.75 * yield);
  formulas.push_back(at_most("base: tension and bending both ways", sum, 1, "1", working_stress));
  formulas.push_back(at_most("base: shear", load.shear / area, 0.4 * yield, "Pa", working_stress));
}

void add_asme(const PadeyeFormulaInput& input, double force, std::vector<PadeyeFormula>& formulas) {
  const AsmePinPlate allowed = asme_pin_plate(input);
  formulas.push_back(at_most("pin plate: tension", force, allowed.tension, "N", asme));
  formulas.push_back(at_most("pin plate: splitting", force, allowed.splitting, "N", asme));
  formulas.push_back(at_most("pin plate: double plane shear", force, allowed.shear, "N", asme));
  formulas.push_back(at_most("pin plate: bearing", force, allowed.bearing, "N", asme));
}

}  // namespace

std::vector<PadeyeFormula> padeye_strength(const PadeyeFormulaInput& input,
                                           const Vector3& force_P) {
  std::vector<PadeyeFormula> formulas;
  for (const auto& family : {padeye_working_stress(input, force_P),
                             padeye_dnv_2_7_3(input, force_P), padeye_asme_bth_1(input, force_P)})
    formulas.insert(formulas.end(), family.begin(), family.end());
  return formulas;
}

std::vector<PadeyeFormula> padeye_working_stress(const PadeyeFormulaInput& input,
                                                 const Vector3& force_P) {
  const PadeyeGeometry& g = input.geometry;
  const double yield = input.material.yield_stress, force = force_P.norm();
  const double net = net_section(g);
  std::vector<PadeyeFormula> formulas{
      at_most("bearing of the pin", force / (g.pin_diameter * g.bearing_thickness()), 0.9 * yield,
              "Pa", working_stress),
      at_most("tear-out: shear in two planes", force / net, 0.4 * yield, "Pa", working_stress),
      at_most("net section: tension", force / net, 0.6 * yield, "Pa", working_stress)};
  Vector3 at_base = force_P;
  at_base.z() = std::max(std::abs(force_P.z()), input.side_load * force);
  add_base(input, at_base, formulas);
  add_base_weld(input, at_base, formulas);
  add_doubler(input, at_base, formulas);
  if (g.has_cheeks()) {
    const double throat = input.cheek_weld / std::numbers::sqrt2;
    const double share = g.cheek_thickness / g.bearing_thickness();
    formulas.push_back(at_most("cheek welds: shear on half a circle",
                               force * share / (throat * std::numbers::pi * g.cheek_radius),
                               0.4 * yield, "Pa", working_stress));
  }
  return formulas;
}

std::vector<PadeyeFormula> padeye_dnv_2_7_3(const PadeyeFormulaInput& input,
                                            const Vector3& force_P) {
  const double yield = input.material.yield_stress, force = force_P.norm();
  return {at_most("bearing (Hertz)", hertz_stress(input, force), yield, "Pa", dnv),
          at_most("tear-out", 2 * force / net_section(input.geometry), yield, "Pa", dnv)};
}

std::vector<PadeyeFormula> padeye_asme_bth_1(const PadeyeFormulaInput& input,
                                             const Vector3& force_P) {
  std::vector<PadeyeFormula> formulas;
  if (input.tensile_strength) add_asme(input, force_P.norm(), formulas);
  return formulas;
}

std::vector<PadeyeFormula> padeye_en_1993_1_8(const PadeyeFormulaInput& input,
                                              const Vector3& force_P) {
  const PadeyeGeometry& g = input.geometry;
  const double force = force_P.norm(), yield = input.material.yield_stress;
  const double net = force / (2 * g.bearing_thickness() * yield);
  double edge = std::numeric_limits<double>::infinity();
  for (const Plates& plates : plates_of(g))
    edge = std::min(edge, plates.radius - g.hole_diameter / 2);
  const double bearing = 1.5 * g.bearing_thickness() * g.pin_diameter * yield;
  return {at_least("pin plate: end distance", edge, net + 2 * g.hole_diameter / 3, eurocode),
          at_least("pin plate: side distance", edge, net + g.hole_diameter / 3, eurocode),
          at_most("pin plate: bearing", force, bearing, "N", eurocode)};
}

std::vector<PadeyeFormula> padeye_en_1993_1_8_replaceable(const PadeyeFormulaInput& input,
                                                          const Vector3& force_P) {
  const PadeyeGeometry& g = input.geometry;
  const double force = force_P.norm(), yield = input.material.yield_stress;
  const double pin = g.pin_diameter, t = g.bearing_thickness();
  const double play = g.hole_diameter - pin;
  const double contact =
      0.591 * std::sqrt(input.material.youngs_modulus * force * play / (pin * pin * t));
  return {
      at_most("replaceable pin: bearing in service", force, 0.6 * t * pin * yield, "N", eurocode),
      at_most("replaceable pin: contact in service", contact, 2.5 * yield, "Pa", eurocode)};
}

std::vector<PadeyeFormula> padeye_rules(const PadeyeFormulaInput& input) {
  const PadeyeGeometry& g = input.geometry;
  const double clearance = g.hole_diameter - g.pin_diameter;
  constexpr double most = 0.006, least = 0.002;  // m
  std::vector<PadeyeFormula> rules{
      at_least("main plate's radius against the hole's diameter", g.radius, g.hole_diameter,
               practice),
      at_most("hole larger than the pin, at most 6 mm", clearance, most, "m", practice),
      at_least("hole larger than the pin, 2 mm or 3 % at least", clearance,
               std::min(most, std::max(least, 0.03 * g.pin_diameter)), practice)};
  if (g.has_cheeks())
    rules.push_back(at_most("cheek plate against the main plate's thickness", g.cheek_thickness,
                            g.thickness, "m", practice));
  if (input.jaw) {
    rules.push_back(at_least("thickness at the pin against 75 % of the jaw", g.bearing_thickness(),
                             0.75 * *input.jaw, practice));
    rules.push_back(at_most("thickness at the pin against the jaw", g.bearing_thickness(),
                            *input.jaw, "m", practice));
  }
  return rules;
}

AsmePinPlate asme_pin_plate(const PadeyeFormulaInput& input) {
  const PadeyeGeometry& g = input.geometry;
  const double hole = g.hole_diameter, pin = g.pin_diameter;
  const double yield = input.material.yield_stress, tensile = *input.tensile_strength;
  const double by_tensile = tensile / (1.2 * input.design_factor);
  AsmePinPlate allowed;
  allowed.clearance_factor = 1 - 0.275 * std::sqrt(1 - pin * pin / (hole * hole));
  const double phi = 55 * pin / hole * std::numbers::pi / 180;
  for (const Plates& plates : plates_of(g)) {
    const double edge = plates.radius - hole / 2;  // a and b_e
    const double effective =
        std::min({edge, 4 * plates.single, 0.6 * edge * tensile / yield * std::sqrt(hole / edge)});
    const double t = plates.thickness;
    allowed.tension += allowed.clearance_factor * by_tensile * 2 * t * effective;
    allowed.splitting +=
        allowed.clearance_factor * by_tensile * (1.13 * edge + 0.92 * edge / (1 + edge / hole)) * t;
    allowed.shear += 0.7 * by_tensile * 2 * (edge + pin / 2 * (1 - std::cos(phi))) * t;
    allowed.bearing += 1.25 * yield / input.design_factor * pin * t;
  }
  return allowed;
}

}  // namespace blocklift::structure

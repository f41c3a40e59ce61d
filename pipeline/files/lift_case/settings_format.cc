#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "pipeline/files/lift_case/case_formats.h"
#include "structure/practice/fatigue.h"

namespace blocklift::pipeline {
namespace {

Format<std::string> fatigue_curve_format() {
  std::vector<std::pair<std::string, std::string>> words;
  for (const std::string& curve : structure::fatigue_curve_names())
    words.emplace_back(curve, curve);
  return choice(words);
}

Format<FatigueSettings> fatigue_format() {
  Table<FatigueSettings> table("fatigue settings",
                               "Wear by repeated lifts: rainflow counts of the stress at each "
                               "followed point, which begins and ends a lift without any, against "
                               "an S-N curve.");
  table
      .by_default("curve", &FatigueSettings::curve, fatigue_curve_format(), "F",
                  "detail category of DNV-RP-C203, in air; F is class 71 MPa, for plates with "
                  "attachments")
      .by_default("stress_concentration", &FatigueSettings::stress_concentration,
                  number(Range::at_least(1)), "1",
                  "by which stress ranges are multiplied before the curve is read")
      .by_default("hot_spot_curve", &FatigueSettings::hot_spot_curve, fatigue_curve_format(), "D",
                  "for the structural stress at named weld toes, without stress_concentration; D "
                  "is class 90 MPa, as DNV-RP-C203 has it for that stress")
      .by_default("lifts", &FatigueSettings::lifts, number(Range::at_least(1)), "1",
                  "lifts of this kind that the block sees");
  return table.format();
}

/// The keys of the natural modes, which one kind of flexibility alone reads.
void check_flexibility(const DynamicsSettings& dynamics, Reading& reading, const Mark&) {
  if (dynamics.flexibility == Flexibility::modal) return;
  if (reading.is_owner_unsound()) return;  // the kind may be what could not be read
  const auto refuse = [&](const auto& key, const char* name) {
    if (!key) return;
    reading.error(key->mark, fmt::format("{} is given, and the block has no natural modes", name),
                  {"they are those of flexibility: modal"});
  };
  refuse(dynamics.elastic_modes, "elastic_modes");
  refuse(dynamics.modal_damping, "modal_damping");
}

}  // namespace

Format<DynamicsSettings> dynamics_format() {
  Table<DynamicsSettings> table("dynamics settings", "How the motion is computed.");
  table
      .by_default("relative_tolerance", &DynamicsSettings::relative_tolerance,
                  number(Range::between(1e-12, 1e-3)), "1e-6", "of the time integration")
      .by_default(
          "sample_interval", &DynamicsSettings::sample_interval,
          quantity(Dimension::time, Range::between(1e-4, 0.2)), "0.05 s",
          "between two recorded samples of the motion. Largest loads of ropes and hoists are "
          "found between them, too, and are samples besides; other figures are sought among them")
      .by_default("static_interval", &DynamicsSettings::static_interval,
                  quantity(Dimension::time, Range::between(1e-3, 30)), "1 s",
                  "between two static equilibria")
      .by_default("flexibility", &DynamicsSettings::flexibility,
                  choice<Flexibility>({{"rigid", Flexibility::rigid},
                                       {"static", Flexibility::static_},
                                       {"modal", Flexibility::modal}}),
                  "rigid",
                  "how the block gives way where ropes pull at its lugs: not at all; at once, by "
                  "the compliance of its structure; or by its lowest natural modes, which vibrate, "
                  "and at once by what they leave of the compliance")
      .optional("elastic_modes", &DynamicsSettings::elastic_modes,
                located(integer(Range::between(1, 60))),
                "number of natural modes of the free block where the flexibility is modal; 10 if "
                "left out")
      .optional("modal_damping", &DynamicsSettings::modal_damping,
                located(number(Range::between(0, 0.5))),
                "damping of each of these modes over the critical one; 0.01 if left out")
      .rule(check_flexibility);
  return table.format();
}

Format<StructureSettings> structure_format() {
  Table<StructureSettings> table("structure settings", "How the stress is computed.");
  table
      .by_default("element_degree", &StructureSettings::element_degree,
                  integer(Range::between(1, 4)), "3", "polynomial degree of shells and beams")
      .by_default("largest_element", &StructureSettings::largest_element,
                  quantity(Dimension::length, Range::between(0.01, 100)), "2 m",
                  "longest edge of an element, before any are divided for accuracy")
      .by_default(
          "accuracy", &StructureSettings::accuracy,
          quantity(Dimension::ratio, Range::between(0.001, 1)), "3 %",
          "elements about the largest checked stresses are divided until these, at rest and "
          "in motion, and the increase between them change by less; the report says by how "
          "much they still moved")
      .by_default("most_unknowns", &StructureSettings::most_unknowns,
                  integer(Range::between(1000, 100000000)), "1000000",
                  "no finer elements are tried than make so many unknowns")
      .optional(
          "stress_points", &StructureSettings::stress_points, names_to(position_format()),
          "places in the block's frame whose stress is followed in time, each as the mean over "
          "a square about it, or beside it where plating ends or meets other plating; if left "
          "out, the hot spot of the lift and that of each lug")
      .optional("hot_spots", &StructureSettings::hot_spots, hot_spots_format(),
                "weld toes of the block, by name, in its frame: structural stress in time, cycles "
                "and damage")
      .by_default("fatigue", &StructureSettings::fatigue, fatigue_format(), "{}",
                  "wear by repeated lifts")
      .rule([](const StructureSettings& settings, Reading& reading, const Mark&) {
        for (const Named<Vector3>& point : settings.stress_points)
          check_name(point.name.mark, point.name.value, reading);
      });
  return table.format();
}

Format<CheckSettings> checks_format() {
  Table<CheckSettings> table("check settings", "What the lift must meet.");
  table
      .by_default("rope_safety_factor", &CheckSettings::rope_safety_factor,
                  number(Range::at_least(1)), "5", "breaking load over the largest rope load")
      .by_default("crane_capacity", &CheckSettings::crane_capacity, boolean(), "true",
                  "hook and crane loads against the cranes' capacities")
      .by_default("yield_factor", &CheckSettings::yield_factor, number(Range::at_least(1)), "1.5",
                  "yield stress over the largest checked stress")
      .by_default("lug_consequence_factor", &CheckSettings::lug_consequence_factor,
                  number(Range::at_least(1)), "1.3",
                  "on the forces at padeyes (GL Noble Denton 0027/ND, lift points)")
      .by_default("lug_side_load", &CheckSettings::lug_side_load,
                  quantity(Dimension::ratio, Range::between(0, 1)), "5 %",
                  "of the rope's force, along the pin, that hand formulae of padeyes take at least "
                  "(API RP 2A)")
      .optional("buckling_factor", &CheckSettings::buckling_factor, number(Range::at_least(1)),
                "critical stress of a plate panel over the stress in it, and on the forces in bars "
                "as columns; the yield factor if left out")
      .optional("spreader_factor", &CheckSettings::spreader_factor,
                located(number(Range::at_least(1))),
                "on the forces in spreaders, against yield and buckling; the yield factor if left "
                "out")
      .by_default(
          "smallest_tension", &CheckSettings::smallest_tension,
          quantity(Dimension::load, Range::not_negative()), "0 kN",
          "below which a rope counts as slack; slings and tackles while the load hangs, idle "
          "hooks not at all")
      .optional("swing", &CheckSettings::largest_swing,
                quantity(Dimension::angle, Range::positive()),
                "largest angle of a hoist's tackle against the vertical; not checked if left out")
      .optional("falls_twist", &CheckSettings::largest_falls_twist,
                located(quantity(Dimension::angle, Range::positive())),
                "largest twist of the falls of a hook block that turns; at 90 deg they turn it "
                "back most, at 180 deg they cross; 90 deg if left out")
      .optional("tilt", &CheckSettings::largest_tilt, quantity(Dimension::angle, Range::positive()),
                "largest angle of the load's z axis against the plumb; not checked if left out")
      .optional("turn", &CheckSettings::largest_turn, quantity(Dimension::angle, Range::positive()),
                "largest turn of the load about the plumb, away from where it hangs at the start; "
                "not checked if left out")
      .optional("sling_angle", &CheckSettings::smallest_sling_angle,
                quantity(Dimension::angle, Range::not_negative()),
                "smallest angle of a sling against the level; not checked if left out")
      .optional("offlead", &CheckSettings::largest_offlead,
                located(quantity(Dimension::angle, Range::positive())),
                "largest angle of a tackle out of the plumb in the plane of the crane's radius, of "
                "cranes that have a radius_from; not checked if left out")
      .optional("sidelead", &CheckSettings::largest_sidelead,
                located(quantity(Dimension::angle, Range::positive())),
                "the same across that plane")
      .optional("clearance", &CheckSettings::smallest_clearance,
                quantity(Dimension::length, Range::not_negative()),
                "smallest distance of load, hooks, spreaders, tackles and cranes from one another, "
                "of hanging "
                "loads from the ground; usual are 0.5 m ashore and 3 m afloat; not checked if left "
                "out")
      .optional("righting_height", &CheckSettings::smallest_righting_height,
                quantity(Dimension::length),
                "least moment against a tilt of the hanging load over its weight and the tilt, "
                "0 m or more; not checked if left out")
      .optional(
          "heel", &CheckSettings::largest_heel,
          located(quantity(Dimension::angle, Range::positive())),
          "largest heel of a vessel, also behind a load that is lost (faults); not checked if "
          "left out")
      .optional("freeboard", &CheckSettings::smallest_freeboard,
                located(quantity(Dimension::length)),
                "smallest height of a vessel's deck over calm water; not checked if left out");
  return table.format();
}

}  // namespace blocklift::pipeline

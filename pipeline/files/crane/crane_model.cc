#include "pipeline/files/crane/crane_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "pipeline/files/crane/crane_check.h"

namespace blocklift::pipeline {
namespace {

Format<HookBearingModel> hook_bearing_format() {
  Table<HookBearingModel> table("hook bearing", "The hook turns on its block about the vertical.");
  table
      .required("hook_mass", &HookBearingModel::hook_mass,
                quantity(Dimension::mass, Range::positive()),
                "of what turns below the bearing; part of the block's mass")
      .required("radius_of_gyration", &HookBearingModel::radius_of_gyration,
                quantity(Dimension::length, Range::positive()), "of it about the vertical")
      .by_default(
          "friction_moment", &HookBearingModel::friction_moment,
          quantity(Dimension::moment, Range::not_negative()), "0 N m",
          "against the hook's turning on the block; up to it the block turns with the hook");
  return table.format();
}

Format<TurningBlockModel> turning_block_format() {
  Table<TurningBlockModel> table(
      "turning block",
      "The hook block turns about the vertical against its falls, which turn it back. Two falls, "
      "each with half of the tension, stand for all.");
  table
      .required("falls_apart", &TurningBlockModel::falls_apart,
                quantity(Dimension::length, Range::positive()),
                "from one of the two falls to the other, above and below: twice the root of the "
                "mean square of all falls' distances from the block's axis")
      .required("radius_of_gyration", &TurningBlockModel::radius_of_gyration,
                quantity(Dimension::length, Range::positive()),
                "of the block about the vertical; with a bearing without the hook")
      .by_default("horns", &TurningBlockModel::horns,
                  quantity(Dimension::length, Range::not_negative()), "0 m",
                  "from horn a to horn b of the hook, where slings begin: C1.main.a, C1.main.b. "
                  "Slings that begin at its centre do not turn it")
      .by_default("towards", &TurningBlockModel::towards, quantity(Dimension::angle), "0 deg",
                  "from the x axis of the body with the upper sheaves, seen from above, to horn a "
                  "at the start")
      .optional("bearing", &TurningBlockModel::bearing, hook_bearing_format(),
                "on which the hook turns; locked to the block if left out")
      .place(&TurningBlockModel::place);
  return table.format();
}

Format<HookBlockModel> hook_block_format() {
  Table<HookBlockModel> table("hook block",
                              "Hangs free from the tackle; slings start at its centre, or at the "
                              "horns of one that turns.");
  table
      .required("mass", &HookBlockModel::mass, quantity(Dimension::mass, Range::positive()),
                "with hook and lower sheaves")
      .by_default("wind_area", &HookBlockModel::wind_area,
                  quantity(Dimension::area, Range::not_negative()), "0 m^2",
                  "the same from any side")
      .by_default("wind_coefficient", &HookBlockModel::wind_coefficient,
                  number(Range::not_negative()), "1.2", "of wind pressure")
      .optional("size", &HookBlockModel::size, size_format(),
                "of its box, in the drawing and for clearances. Left out it follows from the mass, "
                "twice as high as wide and of 3.5 t/m^3: [1 m, 1 m, 2 m] of 7 t")
      .optional("turning", &HookBlockModel::turning, turning_block_format(),
                "that it turns about the vertical; it keeps its direction if left out")
      .rule([](const HookBlockModel& block, Reading& reading, const Mark&) {
        if (!block.turning || !block.turning->bearing) return;
        if (block.turning->bearing->hook_mass < block.mass) return;
        reading.error(block.turning->place,
                      fmt::format("the hook weighs {:g} kg, and its block with it {:g} kg",
                                  block.turning->bearing->hook_mass, block.mass),
                      {"hook_mass is a part of the block's mass"});
      });
  return table.format();
}

Format<ChartLine> chart_line_format() {
  Table<ChartLine> table("line of a load chart", "What a hook may carry up to a radius.");
  table
      .required("radius", &ChartLine::radius, quantity(Dimension::length, Range::positive()),
                "level, from the point that radius_from names to the hook block")
      .required("capacity", &ChartLine::capacity, quantity(Dimension::load, Range::positive()),
                "largest load at the hook, hook block included");
  return table.format();
}

Format<DeratingLine> derating_line_format(const char* name, Dimension dimension, const char* what) {
  Table<DeratingLine> table(name, "What is left of the load charts.");
  table.required("up_to", &DeratingLine::up_to, quantity(dimension, Range::positive()), what)
      .required("factor", &DeratingLine::factor, number(Range::between(0, 1)),
                "of the chart's capacity, zero where no load may be lifted");
  return table.format();
}

Format<ChartDerating> derating_format() {
  Table<ChartDerating> table("derating",
                             "By what load charts are multiplied in wind and in a seaway. The "
                             "line with the next larger value holds; beyond the last nothing may "
                             "be lifted. Where both tables count, their factors are multiplied.");
  table
      .required("source", &ChartDerating::source, text(),
                "where the factors come from; shown beside the check")
      .optional("wind", &ChartDerating::wind,
                located(list_of(derating_line_format("line of a derating by wind", Dimension::speed,
                                                     "mean speed at a height of 10 m, as a case "
                                                     "gives it"),
                                1)),
                "by the speed of the wind, without gusts")
      .optional("sea", &ChartDerating::sea,
                located(list_of(derating_line_format("line of a derating by sea", Dimension::length,
                                                     "significant height of the waves, 2.83 times "
                                                     "the amplitude of a regular one"),
                                1)),
                "by the height of the waves; does not count in a case without a sea")
      .place(&ChartDerating::place);
  return table.format();
}

Format<CraneSupport> crane_support_format() {
  Table<CraneSupport> table("crane support", "A wheel, bogie, outrigger or leg.");
  table
      .required("position", &CraneSupport::position, position_format(),
                "in the frame of the body that stands")
      .optional("capacity", &CraneSupport::capacity, quantity(Dimension::load, Range::positive()),
                "largest load; not checked if left out");
  return table.format();
}

Format<CraneStand> crane_stand_format() {
  Table<CraneStand> table("stand",
                          "What the crane stands on. Loads are shared as by a rigid body on equal "
                          "springs: they vary linearly over the supports.");
  table
      .required("body", &CraneStand::body, located(reference()),
                "that stands: the one body whose joint has the world for its parent")
      .required("supports", &CraneStand::supports, named_tables(crane_support_format()),
                "three or more that are not in line")
      .place(&CraneStand::place);
  return table.format();
}

Format<ReevingModel> reeving_format() {
  Table<ReevingModel> table("reeving",
                            "How the falls of a tackle are one rope on sheaves. Friction of the "
                            "sheaves makes the falls, and the pull at the drum, unequal: larger "
                            "while the load is hoisted, smaller while it is lowered. The motion "
                            "does not feel it.");
  table
      .required("falls", &ReevingModel::falls, integer(Range::between(1, 200)),
                "parts of rope between the upper and the lower block")
      .by_default("lead_lines", &ReevingModel::lead_lines, integer(Range::between(1, 8)), "1",
                  "ends of rope that run to a drum; 2 where the rope has no dead end but an "
                  "equalising sheave in its middle. The falls are divided among them")
      .by_default("lead_sheaves", &ReevingModel::lead_sheaves, integer(Range::between(0, 20)), "1",
                  "on which the rope turns from its first fall to the drum, that by which it "
                  "leaves the tackle included")
      .by_default("sheave_efficiency", &ReevingModel::sheave_efficiency,
                  quantity(Dimension::ratio, Range::between(0.5, 1)), "98 %",
                  "tension that leaves a sheave over that which enters it while it turns: 96 to "
                  "98 % on rolling bearings, 92 to 96 % on plain ones")
      .optional("breaking_load", &ReevingModel::breaking_load,
                quantity(Dimension::load, Range::positive()),
                "smallest breaking load of the single rope; that of all falls over their number "
                "if left out")
      .optional("line_pull", &ReevingModel::line_pull, quantity(Dimension::load, Range::positive()),
                "largest pull of the winch on each lead line; not checked if left out")
      .place(&ReevingModel::place)
      .rule([](const ReevingModel& reeving, Reading& reading, const Mark& mark) {
        if (reeving.falls < 1 || reeving.lead_lines < 1) return;
        if (reeving.falls % reeving.lead_lines == 0) return;
        reading.error(mark,
                      fmt::format("{} falls cannot be shared evenly by {} lead lines",
                                  reeving.falls, reeving.lead_lines),
                      {"the falls are a multiple of the lead lines"});
      });
  return table.format();
}

Format<HoistModel> hoist_format() {
  Table<HoistModel> table("hoist",
                          "A winch with its tackle and hook block. The tackle's falls are "
                          "taken together as one rope.");
  table.required("body", &HoistModel::body, located(reference()), "that carries the upper sheaves")
      .required("sheave", &HoistModel::sheave, position_format(),
                "where the tackle leaves the body, in its frame")
      .required("hook_block", &HoistModel::hook_block, hook_block_format(), "at its lower end")
      .required("rope", &HoistModel::rope_choice, rope_choice_format(), "all falls together")
      .optional("reeving", &HoistModel::reeving, reeving_format(),
                "of the tackle: pull at the drum and load of the single rope follow from it and "
                "are checked")
      .optional("crane_stiffness", &HoistModel::crane_stiffness,
                quantity(Dimension::stiffness, Range::positive()),
                "of what the tackle hangs from, in series with it; rigid if left out")
      .required("capacity", &HoistModel::capacity, quantity(Dimension::load, Range::positive()),
                "largest load at the hook")
      .optional("load_chart", &HoistModel::load_chart, located(list_of(chart_line_format(), 1)),
                "what the hook may carry over its radius, beside the capacity: between two radii "
                "that of the larger one holds, beyond the last none; asks for radius_from")
      .required("winch", &HoistModel::winch, winch_format(),
                "lets out and takes in the tackle: rope length between sheave and hook block");
  return table.format();
}

}  // namespace

Vector3 HookBlockModel::box_size() const {
  constexpr double density = 3500;  // kg/m^3
  return size ? *size : Vector3(std::cbrt(mass / (2 * density)) * Vector3(1, 1, 2));
}

std::optional<Vector3> TurningBlockModel::horn(const std::string& name) const {
  if (horns > 0 && name == "a") return Vector3(horns / 2, 0, 0);
  if (horns > 0 && name == "b") return Vector3(-horns / 2, 0, 0);
  return std::nullopt;
}

double LoadChart::capacity(double radius) const {
  for (const ChartLine& line : lines)
    if (radius <= line.radius) return line.capacity;
  return 0;
}

double factor_in(const std::vector<DeratingLine>& lines, double value) {
  for (const DeratingLine& line : lines)
    if (value <= line.up_to) return line.factor;
  return 0;
}

const HoistModel* CraneModel::find_hoist(const std::string& name) const {
  const auto found = std::find_if(hoists.begin(), hoists.end(), [&](const HoistModel& hoist) {
    return hoist.name.value == name;
  });
  return found == hoists.end() ? nullptr : &*found;
}

Format<DriveLimits> winch_format() {
  Table<DriveLimits> table("winch",
                           "Lets out and takes in rope along a motion profile with limited "
                           "speed, acceleration and jerk.");
  const Range positive = Range::positive();
  table
      .required("speed", &DriveLimits::speed, quantity_of({Dimension::speed}, positive),
                "largest speed, of the hook")
      .required("acceleration", &DriveLimits::acceleration,
                quantity_of({Dimension::acceleration}, positive), "largest acceleration")
      .required("jerk", &DriveLimits::jerk, quantity_of({Dimension::jerk}, positive),
                "largest rate of change of the acceleration")
      .required("range", &DriveLimits::range,
                array_of<Quantity, 2>(quantity_of({Dimension::length}, positive)),
                "shortest and longest rope");
  return table.format();
}

Format<CraneModel> crane_model_format() {
  Table<CraneModel> table("crane",
                          "A crane: bodies joined by joints, drives that move joints, and "
                          "hoists with their tackle. Its base (\"world\" to the crane) "
                          "stands where the lift case puts it.");
  table
      .required("kind", &CraneModel::kind, choice<std::string>({{"crane", "crane"}}),
                "what this file describes")
      .optional("title", &CraneModel::title, text(), "for people")
      .optional("parameters", &CraneModel::parameters, parameters_format(),
                "values that expressions in this file may use; the lift case may give others")
      .early()
      .required("bodies", &CraneModel::bodies, named_tables(body_format()), "its rigid bodies")
      .required("joints", &CraneModel::joints, named_tables(joint_format()),
                "one for each body, which it carries")
      .optional("loops", &CraneModel::loops, named_tables(loop_format()),
                "what must hold besides the joints")
      .optional("springs", &CraneModel::springs, named_tables(spring_format()),
                "between points or at joints")
      .optional("drives", &CraneModel::drives, named_tables(drive_table(true).format()),
                "of joints; a joint without a drive moves freely")
      .optional("pose", &CraneModel::pose, joint_values_format(joint_positions),
                "where joints stand when the crane is put together, by name (zero where left out): "
                "loops close nearest to this pose, lengths that they leave open are taken from it, "
                "and drives go from it to where a case starts them")
      .optional("hoists", &CraneModel::hoists, named_tables(hoist_format()),
                "winches with tackle and hook block")
      .optional("capacity", &CraneModel::capacity, quantity(Dimension::load, Range::positive()),
                "largest load of all hooks together")
      .optional("radius_from", &CraneModel::radius_from, point_format(),
                "point of a body, or of the base (\"world\"), from which the level radius of the "
                "hooks counts: the slewing axis, or the boom's foot; hooks' radius, offlead and "
                "sidelead follow")
      .optional("derating", &CraneModel::derating, derating_format(),
                "of the load charts of all hooks, in wind and in a seaway; asks for a load_chart")
      .optional("stands_on", &CraneModel::stands_on, crane_stand_format(),
                "wheels, bogies, outriggers or legs, whose loads follow from the crane's motion")
      .place(&CraneModel::place)
      .rule(check_crane);
  return table.format();
}

}  // namespace blocklift::pipeline

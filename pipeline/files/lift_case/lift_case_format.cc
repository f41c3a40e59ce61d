#include "pipeline/declaration/table.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "structure/practice/fatigue.h"

namespace blocklift::pipeline {
namespace {

const auto zero_position = "[0 m, 0 m, 0 m]";
const auto zero_attitude = "[0 deg, 0 deg, 0 deg]";

Format<CraneInCase> crane_format() {
  Table<CraneInCase> table("crane", "A crane of the lift.");
  table
      .required("model", &CraneInCase::model_name, located(reference()),
                "name of the crane's model file")
      .optional("parameters", &CraneInCase::parameters, parameter_overrides_format(),
                "values for parameters of the model, in place of its own")
      .optional("base", &CraneInCase::base, located(reference()),
                "vessel of the case that the crane stands on; the world if left out")
      .by_default("position", &CraneInCase::position, position_format(), zero_position,
                  "of the crane's base in the world, or in the frame of the vessel")
      .by_default("orientation", &CraneInCase::attitude, attitude_format(), zero_attitude,
                  "of the crane's base: roll, pitch, yaw")
      .required("start", &CraneInCase::start, names_to(located(quantity_of(travels))),
                "where each drive stands, and how much rope (unstretched) each hoist has out, "
                "when the operation begins")
      .optional("equalised", &CraneInCase::equalised,
                located(array_of<Located<std::string>, 2>(located(reference()))),
                "two hoists whose tackles are reeved with one rope: both hooks carry alike, and "
                "what one winch lets out lowers both; each hoist by itself if left out");
  return table.format();
}

Format<PlaceAfloat> place_afloat_format() {
  Table<PlaceAfloat> table("place afloat", "Where a load is lowered into the water.");
  table
      .required("position", &PlaceAfloat::position,
                array_of<double, 2>(quantity(Dimension::length)),
                "of its frame's origin in the world, [x, y]")
      .by_default("heading", &PlaceAfloat::heading, quantity(Dimension::angle), "0 deg",
                  "of its x axis, from the world's +x towards +y");
  return table.format();
}

void check_load(const LoadInCase& load, Reading& reading, const Mark& mark) {
  const bool block = !load.model_name.value.empty();
  if (!block && !load.vessel_name) {
    reading.error(mark, "the load is not described",
                  {"give model, a block; or vessel with its lugs; or both, a block that floats by "
                   "the hull of the vessel"});
  }
  for (const Named<Vector3>& lug : load.lugs) check_name(lug.name.mark, lug.name.value, reading);
  if (block && !load.lugs.empty()) {
    reading.error(load.lugs.front().name.mark, "a block's lugs stand in its model file");
  }
  if (load.draughts && !load.vessel_name) {
    reading.error(load.draughts->mark, "draughts of a load that has no hull",
                  {"give its vessel, whose hull enters the water"});
  }
  if (load.afloat && !load.draughts) {
    reading.error(mark, "afloat is the place for which draughts are computed, and there are none",
                  {"add draughts, or leave afloat out"});
  }
}

Format<LoadInCase> load_format() {
  Table<LoadInCase> table("load",
                          "What is lifted: a block, one model for its motion and its stress; a "
                          "vessel, which floats where it reaches the water and whose stress is not "
                          "asked; or both, one ship: the block that she is built as, afloat by "
                          "the hull of the vessel.");
  table
      .optional("model", &LoadInCase::model_name, located(reference()),
                "name of the block's model file")
      .optional(
          "vessel", &LoadInCase::vessel_name, located(reference()),
          "name of a vessel's model file: in place of model, or beside it for its hull, in the "
          "frame of the block; the two weigh the same")
      .optional("lugs", &LoadInCase::lugs, names_to(position_format()),
                "of a vessel without a block: places of its lugs in its frame")
      .by_default("damping", &LoadInCase::damping, vessel_damping_format(), "{}",
                  "of a vessel in the water: linear, in proportion to the wet volume")
      .by_default("quadratic_damping", &LoadInCase::quadratic_damping,
                  vessel_quadratic_damping_format(), "{}",
                  "of a vessel in the water: with the square of the velocity, in proportion to the "
                  "wet volume")
      .optional(
          "draughts", &LoadInCase::draughts, located(draughts_format()),
          "of a vessel, upright, from the lowest point of its hull: for them added mass, memory "
          "and diffraction are computed together with those vessels whose radiation is, and "
          "interpolated while it is lowered or lifted; it makes no waves if left out")
      .optional(
          "afloat", &LoadInCase::afloat, place_afloat_format(),
          "where it lies against the vessels at those draughts, these being where they start; "
          "as its position and orientation say if left out")
      .by_default("position", &LoadInCase::position, position_format(), zero_position,
                  "of the load's frame in the world at the start; a first guess, the run begins "
                  "from equilibrium")
      .by_default("orientation", &LoadInCase::attitude, attitude_format(), zero_attitude,
                  "of the load at the start: roll, pitch, yaw; a first guess")
      .rule(check_load);
  return table.format();
}

Format<Located<RopePoint>> rope_point_format() {
  Table<RopePoint> table("point", "A point of a body of the lift.");
  table
      .required("body", &RopePoint::body, reference(),
                "\"world\", \"load\", a vessel, a spreader, or crane and body (C1.gantry)")
      .by_default("point", &RopePoint::point, position_format(), zero_position,
                  "in the body's frame");
  const auto by_name = converted<Located<std::string>, RopePoint>(located(reference()),
                                                                  [](Located<std::string> name) {
                                                                    RopePoint point;
                                                                    point.name = std::move(name);
                                                                    return point;
                                                                  });
  return located(by_shape<RopePoint>(by_name, std::nullopt, table.format()));
}

Format<SupportInCase> support_format() {
  Table<SupportInCase> table("support", "A pad under the load, from which it lifts off.");
  table
      .required("point", &SupportInCase::point, position_format(),
                "of the load that stands on the pad, in the block's frame")
      .by_default("ground", &SupportInCase::ground, quantity(Dimension::length), "0 m",
                  "height of the pad's upper face")
      .required("stiffness", &SupportInCase::stiffness,
                quantity(Dimension::stiffness, Range::positive()), "against sinking in")
      .by_default("damping", &SupportInCase::damping,
                  quantity(Dimension::damping, Range::not_negative()), "0 kN s/m",
                  "against sinking in")
      .by_default("friction_coefficient", &SupportInCase::friction_coefficient,
                  number(Range::between(0, 2)), "0.3", "level force over the load on the pad")
      .by_default("tangential_stiffness", &SupportInCase::tangential_stiffness,
                  quantity(Dimension::stiffness, Range::not_negative()), "1 MN/m",
                  "against sliding, up to the friction")
      .optional(
          "reach", &SupportInCase::reach, quantity(Dimension::length, Range::positive()),
          "level distance within which there is ground; everywhere if left out. A load that is "
          "set down elsewhere, lower, needs it");
  return table.format();
}

Format<GroundInCase> ground_format() {
  Table<GroundInCase> table("ground contact",
                            "The ground bears the load at the eight corners of the box around it, "
                            "wherever and however it comes down.");
  table
      .required("stiffness", &GroundInCase::stiffness,
                quantity(Dimension::stiffness, Range::positive()), "of each corner")
      .by_default("damping", &GroundInCase::damping,
                  quantity(Dimension::damping, Range::not_negative()), "0 kN s/m", "of each corner")
      .by_default("friction_coefficient", &GroundInCase::friction_coefficient,
                  number(Range::between(0, 2)), "0.3", "level force over the load on the corner")
      .by_default("tangential_stiffness", &GroundInCase::tangential_stiffness,
                  quantity(Dimension::stiffness, Range::positive()), "1 MN/m",
                  "against sliding from where the corner touched down, up to the friction")
      .place(&GroundInCase::place);
  return table.format();
}

void check_keep(const KeepInCase& keep, Reading& reading, const Mark& mark) {
  const int wishes = keep.level.has_value() + keep.over.has_value() + keep.tension.has_value() +
                     keep.share.has_value() + keep.law.has_value();
  if (wishes != 1)
    reading.error(mark,
                  wishes == 0 ? "the move does not say what is kept" : "the move keeps two things",
                  {"give one of level, over, tension, share and law"});
  const auto only_with = [&](bool given, const char* key, bool other, const char* other_key) {
    if (given && !other)
      reading.error(mark, std::string(key) + " goes with " + other_key + ", which is not there");
  };
  only_with(keep.with.has_value(), "with", keep.level.has_value(), "level");
  only_with(keep.above.has_value(), "above", keep.level.has_value(), "level");
  only_with(keep.head.has_value(), "head", keep.over.has_value(), "over");
  only_with(keep.over.has_value(), "over", keep.head.has_value(), "head");
  only_with(!keep.of.empty(), "of", keep.share.has_value(), "share");
  only_with(keep.share.has_value(), "share", !keep.of.empty(), "of");
  only_with(keep.stiffness.has_value(), "stiffness", keep.tension || keep.share,
            "tension or share");
  only_with(!keep.sees.empty(), "sees", keep.law.has_value(), "law");
  only_with(keep.every.has_value(), "every", keep.law.has_value(), "law");
  if (keep.law && (keep.correction || keep.tolerance))
    reading.error(mark, "a law gives the speed itself and takes no correction or tolerance");
  // What is seen decays as e' = -e(t - reaction) / correction, which grows instead where the
  // correction is shorter than 2 / pi of the reaction; the drive's own lag comes on top.
  if (!keep.law && keep.correction_time() < 2 * keep.reaction)
    reading.error(keep.correction ? keep.correction->mark : mark,
                  "the correction is shorter than twice the reaction: the operator would steer "
                  "further and further to and fro",
                  {"three times the reaction and more come to rest without overshooting"});
  if (!keep.tolerance) return;
  const Dimension due = keep.tension ? Dimension::force
                        : keep.share ? Dimension::ratio
                                     : Dimension::length;
  if (wishes == 1 && keep.tolerance->value.dimension != due)
    reading.error(keep.tolerance->mark,
                  std::string("the tolerance is ") +
                      std::string(text_of(keep.tolerance->value.dimension).noun) + "; " +
                      std::string(text_of(due).noun) + " is due");
}

void check_sight(const SightInCase& sight, Reading& reading, const Mark& mark) {
  const int figures = sight.level.has_value() + sight.over.has_value() + sight.pull.has_value() +
                      sight.share.has_value();
  if (figures != 1)
    reading.error(mark, figures == 0 ? "nothing is seen" : "two things are seen under one name",
                  {"give one of level, over, tension and share"});
  const auto only_with = [&](bool given, const char* key, bool other, const char* other_key) {
    if (given && !other)
      reading.error(mark, std::string(key) + " goes with " + other_key + ", which is not there");
  };
  only_with(sight.with.has_value(), "with", sight.level.has_value(), "level");
  only_with(sight.head.has_value(), "head", sight.over.has_value(), "over");
  only_with(sight.over.has_value(), "over", sight.head.has_value(), "head");
  only_with(!sight.of.empty(), "of", sight.share.has_value(), "share");
  only_with(sight.share.has_value(), "share", !sight.of.empty(), "of");
}

void check_names_of_sights(const KeepInCase& keep, Reading& reading, const Mark&) {
  for (const SightInCase& sight : keep.sees) {
    if (sight.name.value == "position" || sight.name.value == "speed")
      reading.error(sight.name.mark,
                    "\"" + sight.name.value + "\" is what a law sees of its own drive anyway",
                    {"give the figure another name"});
  }
}

Format<SightInCase> sight_format(const Format<Located<RopePoint>>& point) {
  Table<SightInCase> table("sight",
                           "A figure that a law sees: a height (`level`), how far its drive would "
                           "have to go to bring a head plumb over a point (`head`, `over`), a "
                           "`tension`, or a `share` of the load.");
  table
      .optional("level", &SightInCase::level, point,
                "the height of a hook (C1.main), lug, eye or point of a body, m")
      .optional("with", &SightInCase::with, point,
                "over that of this point; a height in the world if left out")
      .optional("head", &SightInCase::head, located(reference()),
                "hoist (C1.main) whose upper sheave a drive of a joint moves")
      .optional("over", &SightInCase::over, point,
                "from plumb over this hook, lug, eye or point of a body: travel of the drive, m or "
                "rad")
      .optional("tension", &SightInCase::pull, located(reference()),
                "of this rope, or of this hoist's (C1.main) tackle, N")
      .optional("share", &SightInCase::share, located(reference()),
                "that this rope or hoist pulls of what it and those of `of` pull together, 0 to 1")
      .optional("of", &SightInCase::of, list_of(located(reference()), 1),
                "ropes, or hoists (C1.main) whose tackle it is")
      .rule(check_sight)
      .place(&SightInCase::place);
  return table.format();
}

Format<KeepInCase> keep_format(const Format<Located<RopePoint>>& point) {
  Table<KeepInCase> table("keeping",
                          "What the operator of a drive keeps while he steers it after what he "
                          "sees: a height (`level`), a head plumb over a point (`head`, `over`), a "
                          "`tension`, or a `share` of the load. He asks for the speed that "
                          "would take away in the time `correction` what he saw a `reaction` ago, "
                          "and the drive follows within its limits. Or a `law`, a function of "
                          "Python, gives the speed.");
  table
      .optional("level", &KeepInCase::level, point,
                "a hook (C1.main), lug, eye or point of a body, whose height a winch keeps")
      .optional("with", &KeepInCase::with, point,
                "as high as this point; a height in the world if left out")
      .optional("above", &KeepInCase::above, located(quantity(Dimension::length)),
                "of level over with; if left out 0 m, or without `with` the height at which the "
                "keeping begins")
      .optional("head", &KeepInCase::head, located(reference()),
                "hoist (C1.main) whose upper sheave the drive of a joint keeps plumb")
      .optional("over", &KeepInCase::over, point,
                "over this hook, lug, eye or point of a body, as near as the drive alone can")
      .optional("tension", &KeepInCase::tension,
                located(quantity(Dimension::force, Range::positive())),
                "of the winch's own rope, or of the hoist's tackle")
      .optional("share", &KeepInCase::share,
                located(quantity(Dimension::ratio, Range::between(0, 1))),
                "that it pulls of what it and the ropes of `of` pull together")
      .optional("of", &KeepInCase::of, list_of(located(reference()), 1),
                "ropes, or hoists (C1.main) whose tackle it is")
      .optional("stiffness", &KeepInCase::stiffness,
                located(quantity(Dimension::stiffness, Range::positive())),
                "by how much the tension, or what is pulled above the share, falls for each metre "
                "that is let out. That of the rope alone if left out, which is never too little to "
                "come to rest; a load that follows its hook changes its share far less, and is "
                "brought to it sooner with its own figure")
      .by_default("reaction", &KeepInCase::reaction,
                  quantity(Dimension::time, Range::not_negative()), "1 s",
                  "from what the operator sees to what he does")
      .optional("correction", &KeepInCase::correction,
                located(quantity(Dimension::time, Range::positive())),
                fmt::format("in which he would take away what he sees, {} s if left out; behind a "
                            "wish that moves on evenly he lags by its speed times this",
                            KeepInCase::usual_correction))
      .optional("tolerance", &KeepInCase::tolerance,
                quantity_of({Dimension::length, Dimension::force, Dimension::ratio},
                            Range::not_negative()),
                "what he lets be: length, force or share, as the wish is; nothing if left out")
      .optional("law", &KeepInCase::law, located(reference()),
                "name of the function of Python that gives the drive's speed in place of a wish: "
                "such a case is run from Python, by the argument `laws` of Case.simulate")
      .optional("sees", &KeepInCase::sees, named_tables(sight_format(point)),
                "what the law is given, by name, beside the `position` and `speed` of its drive")
      .optional("every", &KeepInCase::every, quantity(Dimension::time, Range::between(0.01, 1)),
                "time between two looks of the law, shortened so that the reaction is a number of "
                "them; 0.2 s if left out")
      .rule(check_keep)
      .rule(check_names_of_sights)
      .place(&KeepInCase::place);
  return table.format();
}

/// @param may_keep whether drives may be steered after a wish.
Format<MoveInCase> move_format(bool may_keep) {
  const auto limit = [](Dimension linear, Dimension angular) {
    return quantity_of({linear, angular}, Range::positive());
  };
  Table<MoveInCase> table(
      "move", may_keep ? "What one or several drives or winches do, alike. It goes `by` a "
                         "distance or `to` a place, from rest to rest, `follows` another "
                         "one, or `keeps` something."
                       : "What one or several drives or winches do, alike. It goes `by` a "
                         "distance or `to` a place, from rest to rest, or `follows` "
                         "another one.");
  table
      .required("drives", &MoveInCase::drives, list_of(located(reference()), 1),
                "crane and drive or hoist (C1.travel, C1.upper_1), or a rope with its own winch")
      .optional("by", &MoveInCase::by, quantity_of(travels),
                "distance or angle; of a winch the change of rope length, negative to hoist")
      .optional("to", &MoveInCase::to, quantity_of(travels),
                "in place of by: the coordinate or rope length at the end")
      .optional("speed", &MoveInCase::speed, limit(Dimension::speed, Dimension::angular_speed),
                "below the drive's own limit, which holds if left out")
      .optional("acceleration", &MoveInCase::acceleration,
                limit(Dimension::acceleration, Dimension::angular_acceleration),
                "below the drive's own limit, which holds if left out")
      .optional("jerk", &MoveInCase::jerk, limit(Dimension::jerk, Dimension::angular_jerk),
                "below the drive's own limit, which holds if left out")
      .optional("duration", &MoveInCase::duration, quantity(Dimension::time, Range::positive()),
                "stretches the move to last that long; as short as the limits allow if left out")
      .by_default("delay", &MoveInCase::delay, quantity(Dimension::time, Range::not_negative()),
                  "0 s", "after the start of the stage")
      .optional("follows", &MoveInCase::follows, reference(),
                "the drive or winch whose travel in this stage leads this one")
      .optional("table", &MoveInCase::table,
                list_of(array_of<Quantity, 2>(quantity_of(travels)), 2),
                "own travel over the leader's travel, a smooth curve through these points: "
                "[[leader, own], ...]")
      .place(&MoveInCase::place);
  if (may_keep)
    table.optional("keeps", &MoveInCase::keeps, keep_format(rope_point_format()),
                   "the drive is steered after what its operator sees, until the other moves of "
                   "the stage have ended, or for the duration");
  return table.format();
}

Format<DynamicsSettings> dynamics_format() {
  Table<DynamicsSettings> table("dynamics settings", "How the motion is computed.");
  table
      .by_default("relative_tolerance", &DynamicsSettings::relative_tolerance,
                  number(Range::between(1e-12, 1e-3)), "1e-6", "of the time integration")
      .by_default("sample_interval", &DynamicsSettings::sample_interval,
                  quantity(Dimension::time, Range::between(1e-4, 0.2)), "0.05 s",
                  "between two recorded samples of the motion, among which the largest loads are "
                  "sought: a small part of the load's bounce on its ropes")
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
                "damping of each of these modes over the critical one; 0.01 if left out");
  return table.format();
}

Format<std::string> fatigue_curve_format() {
  std::vector<std::pair<std::string, std::string>> words;
  for (const std::string& curve : structure::fatigue_curve_names())
    words.emplace_back(curve, curve);
  return choice(words);
}

Format<FatigueSettings> fatigue_format() {
  Table<FatigueSettings> table("fatigue settings",
                               "Wear by repeated lifts: rainflow counts of the stress at each "
                               "followed point against an S-N curve.");
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
      .optional("stress_points", &StructureSettings::stress_points, names_to(position_format()),
                "places in the block's frame whose stress is followed in time, each at the nearest "
                "square of the checked stress; if left out, the hot spot of the lift and that of "
                "each lug")
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
      .optional("spreader_factor", &CheckSettings::spreader_factor, number(Range::at_least(1)),
                "on the forces in spreaders, against yield and buckling; the yield factor if left "
                "out")
      .by_default("smallest_tension", &CheckSettings::smallest_tension,
                  quantity(Dimension::load, Range::not_negative()), "0 kN",
                  "below which a rope counts as slack")
      .optional("swing", &CheckSettings::largest_swing,
                quantity(Dimension::angle, Range::positive()),
                "largest angle of a hoist's tackle against the vertical; not checked if left out")
      .optional("tilt", &CheckSettings::largest_tilt, quantity(Dimension::angle, Range::positive()),
                "largest angle of the load's z axis against the plumb; not checked if left out")
      .optional("sling_angle", &CheckSettings::smallest_sling_angle,
                quantity(Dimension::angle, Range::not_negative()),
                "smallest angle of a sling against the level; not checked if left out")
      .optional(
          "offlead", &CheckSettings::largest_offlead, quantity(Dimension::angle, Range::positive()),
          "largest angle of a tackle out of the plumb in the plane of the crane's radius; not "
          "checked if left out")
      .optional("sidelead", &CheckSettings::largest_sidelead,
                quantity(Dimension::angle, Range::positive()), "the same across that plane")
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
          "heel", &CheckSettings::largest_heel, quantity(Dimension::angle, Range::positive()),
          "largest heel of a vessel, also behind a load that is lost (faults); not checked if "
          "left out")
      .optional("freeboard", &CheckSettings::smallest_freeboard, quantity(Dimension::length),
                "smallest height of a vessel's deck over calm water; not checked if left out");
  return table.format();
}

Format<Comparison> comparison_format() {
  Table<PublishedLoads> loads("loads", "Largest loads of a rope as published or measured.");
  loads
      .optional("static", &PublishedLoads::static_load,
                quantity(Dimension::load, Range::positive()), "at rest")
      .optional("dynamic", &PublishedLoads::dynamic_load,
                quantity(Dimension::load, Range::positive()), "in motion");
  Table<MeasuredSeries> series("measured series", "A tension measured over time.");
  series
      .required("file", &MeasuredSeries::file, located(text()),
                "beside this file: CSV of time in s and tension")
      .by_default("unit", &MeasuredSeries::unit,
                  choice<double>({{"N", 1.0}, {"kN", 1e3}, {"MN", 1e6}, {"t", newton_per_tonne}}),
                  "kN", "of the tension in the file; t is the weight of a tonne")
      .by_default("offset", &MeasuredSeries::offset, quantity(Dimension::time), "0 s",
                  "time of the operation at which the file's time is zero");
  Table<Comparison> table("comparison", "Published or measured figures, shown beside ours.");
  table.required("source", &Comparison::source, text(), "where they come from")
      .optional("ropes", &Comparison::ropes, names_to(loads.format()), "largest loads by rope")
      .optional("series", &Comparison::series, names_to(series.format()),
                "measured tensions by rope, drawn over the computed ones")
      .optional("stress_increase", &Comparison::stress_increase, quantity(Dimension::ratio),
                "of the largest stress by the motion, as \"22.75 %\"")
      .optional("deformation_increase", &Comparison::deformation_increase,
                quantity(Dimension::ratio), "of the largest deformation by the motion");
  return table.format();
}

Format<LoadTable> load_table_format() {
  using Direction = std::variant<Vector3, std::vector<Named<Vector3>>>;
  const auto load = quantity(Dimension::load, Range::positive());
  const auto one =
      converted<Vector3, Direction>(direction_format(), [](Vector3 v) { return Direction(v); });
  const auto each = converted<std::vector<Named<Vector3>>, Direction>(
      names_to(direction_format()),
      [](std::vector<Named<Vector3>> v) { return Direction(std::move(v)); });
  Table<LoadTable> table("load table",
                         "Forces at the lugs, in place of cranes, ropes and operation.");
  table
      .required("direction", &LoadTable::direction, by_shape<Direction>(std::nullopt, one, each),
                "of the pull, in the block's frame: one for all lugs, or a table with one for each")
      .required("static", &LoadTable::static_loads, names_to(load), "largest load at rest, by lug")
      .required("dynamic", &LoadTable::dynamic_loads, names_to(load),
                "largest load in motion, by lug")
      .place(&LoadTable::place);
  return table.format();
}

Format<StageUntil> stage_until_format() {
  const auto share = located(quantity(Dimension::ratio, Range::between(0, 1.5)));
  Table<StageUntil> table(
      "condition",
      "One condition that ends the stage. At its instant all moves of the stage "
      "begin to stop together, as fast as their drives may brake, and the next "
      "stage follows.");
  table
      .optional("slack", &StageUntil::slack, located(reference()),
                "the rope, or the tackle of the hoist (C1.main), pulls no more")
      .optional("taut", &StageUntil::taut, located(reference()), "it pulls")
      .optional("ropes_bear_at_least", &StageUntil::ropes_at_least, share,
                "share of the load's weight by which ropes pull it up, all together")
      .optional("ropes_bear_at_most", &StageUntil::ropes_at_most, share,
                "likewise: 20 % when 80 % of the weight is off")
      .optional("ground_bears_at_least", &StageUntil::ground_at_least, share,
                "share of the load's weight that pads and ground bear")
      .by_default("reaction", &StageUntil::reaction,
                  quantity(Dimension::time, Range::not_negative()), "0 s",
                  "of the operator, before the drives begin to stop")
      .optional("within", &StageUntil::within, quantity(Dimension::time, Range::positive()),
                "time from the stage's start in which the condition comes about, or the run fails; "
                "until the stage's moves end if left out")
      .rule([](const StageUntil& until, Reading& reading, const Mark& mark) {
        const int given = until.slack.has_value() + until.taut.has_value() +
                          until.ropes_at_least.has_value() + until.ropes_at_most.has_value() +
                          until.ground_at_least.has_value();
        if (given == 1) return;
        reading.diagnostics().error(
            mark,
            given == 0 ? "the stage does not say what ends it" : "the stage has several conditions",
            {"give one of slack, taut, ropes_bear_at_least, ropes_bear_at_most and "
             "ground_bears_at_least"});
      })
      .place(&StageUntil::place);
  return table.format();
}

void check_sheave_friction(const RopeInCase& rope, Reading& reading, const Mark&) {
  if (rope.sheave_friction && rope.sheave_efficiency)
    reading.error(rope.sheave_efficiency->mark,
                  "the rope has both a friction and an efficiency of its sheaves",
                  {"the one says what the other says: leave one out"});
  if (!rope.through.empty()) return;
  const auto& given = rope.sheave_friction ? rope.sheave_friction : rope.sheave_efficiency;
  if (given)
    reading.error(given->mark, "the rope has friction at its sheaves, and none of them",
                  {"name the hooks, pins or sheaves that it runs over: through: [...]"});
}

}  // namespace

Format<RopeInCase> rope_in_case_format(const Format<Located<RopePoint>>& point,
                                       bool breaking_load_required) {
  Table<RopeInCase> table("rope",
                          "A rope, sling or line of the lift. Its ends and the sheaves "
                          "between them are hooks (crane and hoist: C1.upper_1), lugs of "
                          "the load (L1), eyes of spreaders (B1.lower_a), or points of bodies.");
  table.required("from", &RopeInCase::from, point, "upper end")
      .optional("through", &RopeInCase::through, list_of(point),
                "sheaves on its way, without friction unless it is given")
      .optional("sheave_friction", &RopeInCase::sheave_friction,
                located(number(Range::between(0, 1))),
                "coefficient of friction mu at each of the sheaves, which do not turn: a pin, a "
                "hook, a trunnion. Tensions on the two sides differ by exp(mu x angle of wrap) "
                "before the rope slips; 0 if left out")
      .optional("sheave_efficiency", &RopeInCase::sheave_efficiency,
                located(quantity(Dimension::ratio, Range::between(0.2, 1))),
                "likewise, in place of the coefficient: the lesser tension over the greater while "
                "the rope runs over the sheave by 180 degrees, 96 to 98 % for sheaves on rolling "
                "bearings. A sheave turned by less loses less")
      .required("to", &RopeInCase::to, point, "lower end")
      .required("model", &RopeInCase::rope_choice, rope_choice_format(breaking_load_required),
                "name of the rope's model file, or the rope's keys")
      .required("length", &RopeInCase::length, quantity(Dimension::length, Range::positive()),
                "unstretched, at the start")
      .optional("end_stiffness", &RopeInCase::end_stiffness,
                quantity(Dimension::stiffness, Range::positive()),
                "of what the rope is fastened to, in series with it; rigid if left out")
      .optional("winch", &RopeInCase::winch, winch_format(),
                "of its own: then the rope is moved by its name, like a hoist");
  // Of a mechanism nothing is held against the breaking load.
  if (breaking_load_required)
    table.optional("bend_diameter", &RopeInCase::bend_diameter,
                   located(quantity(Dimension::length, Range::positive())),
                   "of the least hook, pin, trunnion or sheave that the wire rope is bent round: "
                   "of its breaking load 1 - 0.5 / sqrt(D/d) is left, d being the diameter of its "
                   "model; nothing is lost if left out, as by fibre slings");
  table.rule(check_sheave_friction);
  return table.format();
}

Format<WindInCase> wind_format() {
  using dynamics::GustSpectrum;
  using dynamics::WindProfile;
  Table<WindInCase> table("wind", "Wind on the wind areas of bodies: steady, or with gusts.");
  table
      .required("speed", &WindInCase::speed, quantity(Dimension::speed, Range::not_negative()),
                "mean of the air, 10 m above z = 0 where it grows with the height")
      .required("towards", &WindInCase::towards, quantity(Dimension::angle),
                "where it blows to, from +x towards +y")
      .by_default("air_density", &WindInCase::air_density,
                  quantity(Dimension::density, Range::positive()), "1.25 kg/m^3", "of the air")
      .by_default("profile", &WindInCase::profile,
                  choice<WindProfile>({{"uniform", WindProfile::uniform},
                                       {"power", WindProfile::power},
                                       {"npd", WindProfile::npd}}),
                  "uniform",
                  "over the height: the same, to the power of 0.12, or by the NPD (ISO 19901-1)")
      .by_default("gusts", &WindInCase::gusts,
                  choice<GustSpectrum>({{"none", GustSpectrum::none},
                                        {"npd", GustSpectrum::npd},
                                        {"api", GustSpectrum::api},
                                        {"davenport", GustSpectrum::davenport}}),
                  "none", "spectrum of the gusts; static equilibrium is that of the mean wind")
      .by_default("gust_height", &WindInCase::gust_height,
                  quantity(Dimension::length, Range::positive()), "10 m",
                  "at which the spectrum is taken")
      .by_default("seed", &WindInCase::seed, integer(Range::not_negative()), "1",
                  "of the gusts' random phases");
  return table.format();
}

Format<StageInCase> stage_format(bool may_wait) {
  Table<StageInCase> table("stage", may_wait ? "A part of the operation; it ends with the last of "
                                               "its moves, or by a condition."
                                             : "A part of the operation; it ends with the last of "
                                               "its moves.");
  table.required("stage", &StageInCase::name, text(), "its name, for people")
      .by_default("pause", &StageInCase::pause, quantity(Dimension::time, Range::not_negative()),
                  "0 s", "before the stage begins")
      .optional("moves", &StageInCase::moves, list_of(move_format(may_wait)), "what moves");
  if (may_wait)
    table.optional("until", &StageInCase::until, stage_until_format(),
                   "what ends the stage, before its moves have ended; they go as far as it takes");
  return table.format();
}

Format<FaultInCase> fault_format() {
  Table<FaultInCase> table("fault",
                           "What goes wrong in motion; the equilibria at rest are those of the "
                           "whole rigging.");
  table
      .optional("at", &FaultInCase::at, located(quantity(Dimension::time, Range::not_negative())),
                "time of the operation at which it happens; or give worst_for")
      .optional(
          "worst_for", &FaultInCase::worst_for, list_of(located(reference()), 1),
          "it happens at the worst instant for these ropes and hoists (C1.main), or for [all]: "
          "the one after which one of them carries the most of its breaking load. Instants at "
          "which drives move are tried, closer and closer around the worst ones")
      .optional("from", &FaultInCase::from,
                located(quantity(Dimension::time, Range::not_negative())),
                "the worst instant is sought from then on; from the first move on if left out")
      .optional("to", &FaultInCase::to, located(quantity(Dimension::time, Range::not_negative())),
                "until then; until the last move ends if left out")
      .by_default("watched", &FaultInCase::watched, quantity(Dimension::time, Range::positive()),
                  "20 s", "how long the ropes are watched behind a tried instant")
      .optional("parts", &FaultInCase::parts, list_of(located(reference()), 1),
                "ropes that break, or hoists (C1.main) whose tackle does")
      .optional("stops", &FaultInCase::stops, list_of(located(reference()), 1),
                "drives and winches that come to a stand and stay there; [all] for an emergency "
                "stop")
      .optional("runs_away", &FaultInCase::runs_away, list_of(located(reference()), 1),
                "winches (hoists, or ropes with one) that leave their motion and pay out")
      .optional("speed", &FaultInCase::speed, quantity(Dimension::speed, Range::positive()),
                "at which they pay out; also beyond what the winch drives")
      .optional("caught_after", &FaultInCase::caught_after,
                quantity(Dimension::time, Range::positive()),
                "from the instant until they are braked; then they stand")
      .by_default("within", &FaultInCase::within, quantity(Dimension::time, Range::positive()),
                  "0.5 s",
                  "in which drives come to a stand, evenly, and winches that run away to their "
                  "speed, and to a stand when they are caught")
      .place(&FaultInCase::place);
  return table.format();
}

Format<DocumentInCase> document_format() {
  Table<DocumentInCase> table("document", "What the report says of itself as a document.");
  table.optional("project", &DocumentInCase::project, text(), "for which the lift is assessed")
      .optional("client", &DocumentInCase::client, text(), "for whom")
      .optional("revision", &DocumentInCase::revision, text(), "of the document")
      .optional("prepared", &DocumentInCase::prepared, text(), "who made it")
      .optional("checked", &DocumentInCase::checked, text(), "who checked it")
      .optional("approved", &DocumentInCase::approved, text(), "who approved it");
  return table.format();
}

Format<LiftCase> lift_case_format() {
  Table<LiftCase> table("lift case",
                        "What is lifted, by what, how, and what is asked. A case has "
                        "either cranes, ropes and an operation, or a load table.");
  table.required("case", &LiftCase::name, name(), "its name")
      .optional("title", &LiftCase::title, text(), "for people")
      .by_default("document", &LiftCase::document, document_format(), "{}",
                  "project, revision and names, in the head of the report's pages")
      .by_default("gravity", &LiftCase::gravity,
                  quantity(Dimension::acceleration, Range::between(1, 100)), "9.80665 m/s^2",
                  "acceleration of gravity; nothing hangs without")
      .required("load", &LiftCase::load, load_format(), "the block or vessel that is lifted")
      .optional("cranes", &LiftCase::cranes, named_tables(crane_format()), "by name")
      .optional("spreaders", &LiftCase::spreaders, named_tables(spreader_format()),
                "bars between slings from above and slings to the load, by name")
      .optional("ropes", &LiftCase::ropes,
                named_tables(rope_in_case_format(rope_point_format(), true)), "by name")
      .optional("rope_weight", &LiftCase::rope_weight, located(boolean()),
                "do slings and tackles from point to point whose model has a mass hang as elastic "
                "catenaries, whose weight hooks and cranes bear? Straight and weightless if left "
                "out")
      .by_default("sling_tolerance", &LiftCase::sling_tolerance,
                  quantity(Dimension::ratio, Range::between(0, 0.1)), "0.25 %",
                  "of its length by which a sling may be longer or shorter than meant: what that "
                  "does is shown, sling by sling; 0 % to leave it out")
      .optional(
          "ground", &LiftCase::ground, quantity(Dimension::length),
          "height of the ground, or of a dock's floor, under the load: what the clearance from "
          "the ground counts from; without it the lowest pad's or zero ashore, none at sea")
      .optional("ground_contact", &LiftCase::ground_contact, ground_format(),
                "the ground bears the load; without it pads alone do")
      .optional("supports", &LiftCase::supports, named_tables(support_format()),
                "pads on which the load stands at the start")
      .optional("wind", &LiftCase::wind, wind_format(), "none if left out");
  add_marine_keys(table);
  table
      .optional("operation", &LiftCase::operation, list_of(stage_format(true)),
                "stages, one after another")
      .by_default("settle", &LiftCase::settle, quantity(Dimension::time, Range::not_negative()),
                  "10 s", "time that is still simulated after the last move")
      .optional("faults", &LiftCase::faults, list_of(fault_format()),
                "what goes wrong meanwhile: ropes that part, drives that stop")
      .by_default("dynamics", &LiftCase::dynamics, dynamics_format(), "{}",
                  "how the motion is computed")
      .by_default("structure", &LiftCase::structure, structure_format(), "{}",
                  "how the stress is computed")
      .by_default("checks", &LiftCase::checks, checks_format(), "{}", "what the lift must meet")
      .optional("standard", &LiftCase::standard, standard_in_case_format(),
                "rules of standards by which the lift is checked, too")
      .optional("compare", &LiftCase::compare, comparison_format(),
                "published or measured figures, shown beside ours")
      .optional("load_table", &LiftCase::load_table, load_table_format(),
                "in place of cranes, ropes and operation")
      .place(&LiftCase::place);
  return table.format();
}

}  // namespace blocklift::pipeline

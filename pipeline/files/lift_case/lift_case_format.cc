#include "pipeline/declaration/table.h"
#include "pipeline/files/lift_case/case_formats.h"
#include "pipeline/files/structure/load_edge.h"

namespace blocklift::pipeline {
namespace {

const auto zero_position = "[0 m, 0 m, 0 m]";
const auto zero_attitude = "[0 deg, 0 deg, 0 deg]";

Format<given::Crane> crane_format() {
  Table<given::Crane> table("crane", "A crane of the lift.");
  table
      .required("model", &given::Crane::model_name, located(reference()),
                "name of the crane's model file")
      .optional("parameters", &given::Crane::parameters, parameter_overrides_format(),
                "values for parameters of the model, in place of its own")
      .optional("base", &given::Crane::base, located(reference()),
                "vessel of the case that the crane stands on; the world if left out")
      .by_default("position", &given::Crane::position, position_format(), zero_position,
                  "of the crane's base in the world, or in the frame of the vessel")
      .by_default("orientation", &given::Crane::attitude, attitude_format(), zero_attitude,
                  "of the crane's base: roll, pitch, yaw")
      .required("start", &given::Crane::start, names_to(located(quantity_of(travels))),
                "where each drive stands, and how much rope (unstretched) each hoist has out, "
                "when the operation begins")
      .optional("equalised", &given::Crane::equalised,
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

void check_load(const given::Load& load, Reading& reading, const Mark& mark) {
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
  if (block && !load.edges.empty()) {
    reading.error(load.edges.front().name.mark, "a block's edges stand in its model file");
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

Format<given::Load> load_format() {
  Table<given::Load> table(
      "load",
      "What is lifted: a block, one model for its motion and its stress; a "
      "vessel, which floats where it reaches the water and whose stress is not "
      "asked; or both, one ship: the block that she is built as, afloat by "
      "the hull of the vessel.");
  table
      .optional("model", &given::Load::model_name, located(reference()),
                "name of the block's model file")
      .optional(
          "vessel", &given::Load::vessel_name, located(reference()),
          "name of a vessel's model file: in place of model, or beside it for its hull, in the "
          "frame of the block; the two weigh the same")
      .optional("lugs", &given::Load::lugs, names_to(position_format()),
                "of a vessel without a block: places of its lugs in its frame")
      .optional("edges", &given::Load::edges, named_tables(load_edge_format()),
                "of a vessel without a block: edges in its frame that ropes may touch; those of a "
                "block stand in its model file")
      .by_default("damping", &given::Load::damping, vessel_damping_format(), "{}",
                  "of a vessel in the water: linear, in proportion to the wet volume")
      .by_default("quadratic_damping", &given::Load::quadratic_damping,
                  vessel_quadratic_damping_format(), "{}",
                  "of a vessel in the water: with the square of the velocity, in proportion to the "
                  "wet volume")
      .optional(
          "draughts", &given::Load::draughts, located(draughts_format()),
          "of a vessel, upright, from the lowest point of its hull: for them added mass, memory "
          "and diffraction are computed together with those vessels whose radiation is, and "
          "interpolated while it is lowered or lifted; it makes no waves if left out")
      .optional(
          "afloat", &given::Load::afloat, place_afloat_format(),
          "where it lies against the vessels at those draughts, these being where they start; "
          "as its position and orientation say if left out")
      .by_default("position", &given::Load::position, position_format(), zero_position,
                  "of the load's frame in the world at the start; a first guess, the run begins "
                  "from equilibrium")
      .by_default("orientation", &given::Load::attitude, attitude_format(), zero_attitude,
                  "of the load at the start: roll, pitch, yaw; a first guess")
      .rule(check_load);
  return table.format();
}

Format<given::Support> support_format() {
  Table<given::Support> table("support", "A pad under the load, from which it lifts off.");
  table
      .required("point", &given::Support::point, position_format(),
                "of the load that stands on the pad, in the block's frame")
      .by_default("ground", &given::Support::ground, quantity(Dimension::length), "0 m",
                  "height of the pad's upper face")
      .required("stiffness", &given::Support::stiffness,
                quantity(Dimension::stiffness, Range::positive()), "against sinking in")
      .by_default("damping", &given::Support::damping,
                  quantity(Dimension::damping, Range::not_negative()), "0 kN s/m",
                  "against sinking in")
      .by_default("friction_coefficient", &given::Support::friction_coefficient,
                  number(Range::between(0, 2)), "0.3", "level force over the load on the pad")
      .by_default("tangential_stiffness", &given::Support::tangential_stiffness,
                  quantity(Dimension::stiffness, Range::not_negative()), "1 MN/m",
                  "against sliding, up to the friction")
      .optional(
          "reach", &given::Support::reach, quantity(Dimension::length, Range::positive()),
          "level distance within which there is ground; everywhere if left out. A load that is "
          "set down elsewhere, lower, needs it");
  return table.format();
}

Format<given::Ground> ground_format() {
  Table<given::Ground> table("ground contact",
                             "The ground bears the load at the eight corners of the box around it, "
                             "wherever and however it comes down.");
  table
      .required("stiffness", &given::Ground::stiffness,
                quantity(Dimension::stiffness, Range::positive()), "of each corner")
      .by_default("damping", &given::Ground::damping,
                  quantity(Dimension::damping, Range::not_negative()), "0 kN s/m", "of each corner")
      .by_default("friction_coefficient", &given::Ground::friction_coefficient,
                  number(Range::between(0, 2)), "0.3", "level force over the load on the corner")
      .by_default("tangential_stiffness", &given::Ground::tangential_stiffness,
                  quantity(Dimension::stiffness, Range::positive()), "1 MN/m",
                  "against sliding from where the corner touched down, up to the friction")
      .place(&given::Ground::place);
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

Format<EdgeOnTheWay> edge_on_the_way_format() {
  Table<EdgeOnTheWay> table("edge on the way", "An edge of the load that the rope may touch.");
  table.required("edge", &EdgeOnTheWay::edge, located(reference()), "its name")
      .by_default("span", &EdgeOnTheWay::span, located(integer(Range::positive())), "1",
                  "in which span of the rope, from 1: before the first of through, behind it, ...");
  const auto by_name = converted<Located<std::string>, EdgeOnTheWay>(
      located(reference()), [](Located<std::string> name) {
        EdgeOnTheWay on_the_way;
        on_the_way.span.mark = name.mark;
        on_the_way.edge = std::move(name);
        return on_the_way;
      });
  return by_shape<EdgeOnTheWay>(by_name, std::nullopt, table.format());
}

void check_sheave_friction(const given::Rope& rope, Reading& reading, const Mark&) {
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

Format<given::Rope> rope_in_case_format(const Format<Located<RopePoint>>& point,
                                        bool breaking_load_required) {
  Table<given::Rope> table("rope",
                           "A rope, sling or line of the lift. Its ends and the sheaves "
                           "between them are hooks (crane and hoist: C1.upper_1), lugs of "
                           "the load (L1), eyes of spreaders (B1.lower_a), or points of bodies.");
  table.required("from", &given::Rope::from, point, "upper end")
      .optional("through", &given::Rope::through, list_of(point),
                "sheaves on its way, without friction unless it is given")
      .optional("sheave_friction", &given::Rope::sheave_friction,
                located(number(Range::between(0, 1))),
                "coefficient of friction mu at each of the sheaves, which do not turn: a pin, a "
                "hook, a trunnion. Tensions on the two sides differ by exp(mu x angle of wrap) "
                "before the rope slips; 0 if left out")
      .optional(
          "sheave_efficiency", &given::Rope::sheave_efficiency,
          located(quantity(Dimension::ratio, Range::between(0.2, 1))),
          "of each of the sheaves, in place of the coefficient: the lesser tension over the "
          "greater while the rope runs over the sheave by 180 degrees, 96 to 98 % for sheaves "
          "on rolling bearings. A sheave turned by less loses less")
      .required("to", &given::Rope::to, point, "lower end")
      .required("model", &given::Rope::rope_choice, rope_choice_format(breaking_load_required),
                "name of the rope's model file, or the rope's keys")
      .required("length", &given::Rope::length, quantity(Dimension::length, Range::positive()),
                "unstretched, at the start")
      .optional("end_stiffness", &given::Rope::end_stiffness,
                quantity(Dimension::stiffness, Range::positive()),
                "of what the rope is fastened to, in series with it; rigid if left out")
      .optional("winch", &given::Rope::winch, winch_format(),
                "of its own: then the rope is moved by its name, like a hoist");
  // Of a mechanism nothing is held against the breaking load.
  if (breaking_load_required)
    table
        .optional("bend_diameter", &given::Rope::bend_diameter,
                  located(quantity(Dimension::length, Range::positive())),
                  "of the least hook, pin, trunnion or sheave that the wire rope is bent round: "
                  "of its breaking load 1 - 0.5 / sqrt(D/d) is left, d being the diameter of its "
                  "model; nothing is lost if left out, as by fibre slings")
        .optional("over", &given::Rope::over, list_of(edge_on_the_way_format()),
                  "edges of the load that it may touch, in the order of its path from its upper "
                  "end, up to 6 between two of its points; names, or {edge: name, span: 2} for one "
                  "behind the first of through. It ends at a lug of the load or, as a basket, goes "
                  "back to a hook, the same or another");
  table.rule(check_sheave_friction);
  return table.format();
}

Format<given::Document> document_format() {
  Table<given::Document> table("document", "What the report says of itself as a document.");
  table.optional("project", &given::Document::project, text(), "for which the lift is assessed")
      .optional("client", &given::Document::client, text(), "for whom")
      .optional("revision", &given::Document::revision, text(), "of the document")
      .optional("prepared", &given::Document::prepared, text(), "who made it")
      .optional("checked", &given::Document::checked, text(), "who checked it")
      .optional("approved", &given::Document::approved, text(), "who approved it");
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

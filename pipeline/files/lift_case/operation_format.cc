#include "pipeline/declaration/table.h"
#include "pipeline/files/lift_case/case_formats.h"

namespace blocklift::pipeline {
namespace {

/// @param keeps after what drives may be steered.
/// @param what that is, for the manual.
Format<given::Move> move_format(const Format<given::Keep>& keeps, const std::string& what) {
  const auto limit = [](Dimension linear, Dimension angular) {
    return quantity_of({linear, angular}, Range::positive());
  };
  Table<given::Move> table(
      "move",
      "What one or several drives or winches do, alike. It goes `by` a distance or `to` a place, "
      "from rest to rest, `follows` another one, or `keeps` something.");
  table
      .required("drives", &given::Move::drives, list_of(located(reference()), 1),
                "crane and drive or hoist (C1.travel, C1.upper_1), or a rope with its own winch")
      .optional("by", &given::Move::by, quantity_of(travels),
                "distance or angle; of a winch the change of rope length, negative to hoist")
      .optional("to", &given::Move::to, quantity_of(travels),
                "in place of by: the coordinate or rope length at the end")
      .optional("speed", &given::Move::speed, limit(Dimension::speed, Dimension::angular_speed),
                "below the drive's own limit, which holds if left out")
      .optional("acceleration", &given::Move::acceleration,
                limit(Dimension::acceleration, Dimension::angular_acceleration),
                "below the drive's own limit, which holds if left out")
      .optional("jerk", &given::Move::jerk, limit(Dimension::jerk, Dimension::angular_jerk),
                "below the drive's own limit, which holds if left out")
      .optional("duration", &given::Move::duration, quantity(Dimension::time, Range::positive()),
                "stretches the move to last that long; as short as the limits allow if left out")
      .by_default("delay", &given::Move::delay, quantity(Dimension::time, Range::not_negative()),
                  "0 s", "after the start of the stage")
      .optional("follows", &given::Move::follows, reference(),
                "the drive or winch whose travel in this stage leads this one")
      .optional("table", &given::Move::table,
                list_of(array_of<Quantity, 2>(quantity_of(travels)), 2),
                "own travel over the leader's travel, a smooth curve through these points: "
                "[[leader, own], ...]")
      .place(&given::Move::place);
  table.optional("keeps", &given::Move::keeps, keeps,
                 what + ", until the other moves of the stage have ended, or for the duration");
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
      .optional(
          "ropes_bear_at_most", &StageUntil::ropes_at_most, share,
          "ropes pull up this share of the load's weight or less, all together: 20 % when 80 % of "
          "the weight is off")
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

}  // namespace

namespace {

Format<given::Stage> stage_format_with(const Format<given::Move>& move, bool may_wait) {
  Table<given::Stage> table("stage", may_wait ? "A part of the operation; it ends with the last of "
                                                "its moves, or by a condition."
                                              : "A part of the operation; it ends with the last of "
                                                "its moves.");
  table.required("stage", &given::Stage::name, text(), "its name, for people")
      .by_default("pause", &given::Stage::pause, quantity(Dimension::time, Range::not_negative()),
                  "0 s", "before the stage begins")
      .optional("moves", &given::Stage::moves, list_of(move), "what moves");
  if (may_wait)
    table.optional("until", &given::Stage::until, stage_until_format(),
                   "what ends the stage, before its moves have ended; they go as far as it takes");
  return table.format();
}

}  // namespace

Format<given::Stage> stage_format(bool may_wait) {
  return stage_format_with(move_format(keep_format(rope_point_format()),
                                       "the drive is steered after what its operator sees"),
                           may_wait);
}

Format<given::Stage> steered_stage_format(const Format<given::Keep>& keeps) {
  return stage_format_with(move_format(keeps, "the drive is steered by a law of your own"), false);
}

namespace {

/// A list that could not be read has been complained of.
void check_what_goes_wrong(const given::Fault& fault, Reading& reading, const Mark& mark) {
  if (!fault.parts.empty() || !fault.stops.empty() || !fault.runs_away.empty()) return;
  if (reading.is_owner_unsound()) return;
  reading.error(mark, "the fault says not what goes wrong",
                {"give parts, ropes that break, stops, drives that come to a stand, or "
                 "runs_away, winches that pay out"});
}

}  // namespace

Format<given::Fault> fault_format() {
  Table<given::Fault> table("fault",
                            "What goes wrong in motion; the equilibria at rest are those of the "
                            "whole rigging.");
  table
      .optional("at", &given::Fault::at, located(quantity(Dimension::time, Range::not_negative())),
                "time of the operation at which it happens; or give worst_for")
      .optional(
          "worst_for", &given::Fault::worst_for, list_of(located(reference()), 1),
          "it happens at the worst instant for these ropes and hoists (C1.main), or for [all]: "
          "the one after which one of them carries the most of its breaking load. Instants at "
          "which drives move are tried, closer and closer around the worst ones")
      .optional("from", &given::Fault::from,
                located(quantity(Dimension::time, Range::not_negative())),
                "the worst instant is sought from then on; from the first move on if left out")
      .optional("to", &given::Fault::to, located(quantity(Dimension::time, Range::not_negative())),
                "until then; until the last move ends if left out")
      .by_default("watched", &given::Fault::watched, quantity(Dimension::time, Range::positive()),
                  "20 s", "how long the ropes are watched behind a tried instant")
      .optional("parts", &given::Fault::parts, list_of(located(reference()), 1),
                "ropes that break, or hoists (C1.main) whose tackle does")
      .optional("stops", &given::Fault::stops, list_of(located(reference()), 1),
                "drives and winches that come to a stand and stay there; [all] for an emergency "
                "stop")
      .optional("runs_away", &given::Fault::runs_away, list_of(located(reference()), 1),
                "winches (hoists, or ropes with one) that leave their motion and pay out")
      .optional("speed", &given::Fault::speed, quantity(Dimension::speed, Range::positive()),
                "at which they pay out; also beyond what the winch drives")
      .optional("caught_after", &given::Fault::caught_after,
                quantity(Dimension::time, Range::positive()),
                "from the instant until they are braked; then they stand")
      .by_default("within", &given::Fault::within, quantity(Dimension::time, Range::positive()),
                  "0.5 s",
                  "in which drives come to a stand, evenly, and winches that run away to their "
                  "speed, and to a stand when they are caught")
      .place(&given::Fault::place)
      .rule(check_what_goes_wrong);
  return table.format();
}

}  // namespace blocklift::pipeline

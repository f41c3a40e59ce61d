#include <fmt/format.h>

#include "pipeline/declaration/table.h"
#include "pipeline/files/lift_case/case_formats.h"

namespace blocklift::pipeline {
namespace {

void check_keep(const given::Keep& keep, Reading& reading, const Mark& mark) {
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

void check_sight(const given::Sight& sight, Reading& reading, const Mark& mark) {
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

void check_sight_of_mechanism(const given::Sight& sight, Reading& reading, const Mark& mark) {
  const int figures = sight.level.has_value() + sight.over.has_value() + sight.pull.has_value() +
                      sight.share.has_value();
  if (figures != 1)
    reading.error(mark, figures == 0 ? "nothing is seen" : "two things are seen under one name",
                  {"give one of level, over, tension and share"});
  if (sight.over.has_value() != (sight.with.has_value() && !sight.level))
    reading.error(mark, "what is plumb or not is told by two points, over and from");
  if (sight.share.has_value() == sight.of.empty())
    reading.error(mark, "a share takes share and of, both");
}

void check_names_of_sights(const given::Keep& keep, Reading& reading, const Mark&) {
  for (const given::Sight& sight : keep.sees) {
    if (sight.name.value == "position" || sight.name.value == "speed")
      reading.error(sight.name.mark,
                    "\"" + sight.name.value + "\" is what a law sees of its own drive anyway",
                    {"give the figure another name"});
  }
}

Format<given::Sight> sight_format(const Format<Located<RopePoint>>& point) {
  Table<given::Sight> table("sight",
                            "A figure that a law sees: a height (`level`), how far its drive would "
                            "have to go to bring a head plumb over a point (`head`, `over`), a "
                            "`tension`, or a `share` of the load.");
  table
      .optional("level", &given::Sight::level, point,
                "the height of a hook (C1.main), lug, eye or point of a body, m")
      .optional("with", &given::Sight::with, point,
                "over that of this point; a height in the world if left out")
      .optional("head", &given::Sight::head, located(reference()),
                "hoist (C1.main) whose upper sheave a drive of a joint moves")
      .optional("over", &given::Sight::over, point,
                "from plumb over this hook, lug, eye or point of a body: travel of the drive, m or "
                "rad")
      .optional("tension", &given::Sight::pull, located(reference()),
                "of this rope, or of this hoist's (C1.main) tackle, N")
      .optional("share", &given::Sight::share, located(reference()),
                "that this rope or hoist pulls of what it and those of `of` pull together, 0 to 1")
      .optional("of", &given::Sight::of, list_of(located(reference()), 1),
                "ropes, or hoists (C1.main) whose tackle it is")
      .rule(check_sight)
      .place(&given::Sight::place);
  return table.format();
}

// What the head of a case is here a point of a body, which stands in `with`.
Format<given::Sight> mechanism_sight_format(const Format<Located<RopePoint>>& point) {
  Table<given::Sight> table(
      "seen figure",
      "A figure that a law of a mechanism sees: a height (`level`), how far "
      "its drive would have to go to bring a point plumb over another (`from`, "
      "`over`), a `tension`, or a `share` of what ropes pull.");
  table.optional("level", &given::Sight::level, point, "the height of this point, m")
      .optional(
          "from", &given::Sight::with, point,
          "over that of this point; a height in the world if left out. With `over`: the point "
          "that the drive moves")
      .optional("over", &given::Sight::over, point,
                "from plumb over this point: travel of the drive of a joint, m or rad")
      .optional("tension", &given::Sight::pull, located(reference()), "of this rope, N")
      .optional("share", &given::Sight::share, located(reference()),
                "that this rope pulls of what it and those of `of` pull together, 0 to 1")
      .optional("of", &given::Sight::of, list_of(located(reference()), 1), "ropes")
      .rule(check_sight_of_mechanism)
      .place(&given::Sight::place);
  return table.format();
}

}  // namespace

Format<given::Keep> keep_format(const Format<Located<RopePoint>>& point) {
  Table<given::Keep> table(
      "keeping",
      "What the operator of a drive keeps while he steers it after what he "
      "sees: a height (`level`), a head plumb over a point (`head`, `over`), a "
      "`tension`, or a `share` of the load. He asks for the speed that "
      "would take away in the time `correction` what he saw a `reaction` ago, "
      "and the drive follows within its limits. Or a `law`, a function of "
      "Python, gives the speed.");
  table
      .optional("level", &given::Keep::level, point,
                "a hook (C1.main), lug, eye or point of a body, whose height a winch keeps")
      .optional("with", &given::Keep::with, point,
                "as high as this point; a height in the world if left out")
      .optional("above", &given::Keep::above, located(quantity(Dimension::length)),
                "of level over with; if left out 0 m, or without `with` the height at which the "
                "keeping begins")
      .optional("head", &given::Keep::head, located(reference()),
                "hoist (C1.main) whose upper sheave the drive of a joint keeps plumb")
      .optional("over", &given::Keep::over, point,
                "over this hook, lug, eye or point of a body, as near as the drive alone can")
      .optional("tension", &given::Keep::tension,
                located(quantity(Dimension::force, Range::positive())),
                "of the winch's own rope, or of the hoist's tackle")
      .optional("share", &given::Keep::share,
                located(quantity(Dimension::ratio, Range::between(0, 1))),
                "that it pulls of what it and the ropes of `of` pull together")
      .optional("of", &given::Keep::of, list_of(located(reference()), 1),
                "ropes, or hoists (C1.main) whose tackle it is")
      .optional("stiffness", &given::Keep::stiffness,
                located(quantity(Dimension::stiffness, Range::positive())),
                "by how much the tension, or what is pulled above the share, falls for each metre "
                "that is let out. That of the rope alone if left out, which is never too little to "
                "come to rest; a load that follows its hook changes its share far less, and is "
                "brought to it sooner with its own figure")
      .by_default("reaction", &given::Keep::reaction,
                  quantity(Dimension::time, Range::not_negative()), "1 s",
                  "from what the operator sees to what he does")
      .optional("correction", &given::Keep::correction,
                located(quantity(Dimension::time, Range::positive())),
                fmt::format("in which he would take away what he sees, {} s if left out; behind a "
                            "wish that moves on evenly he lags by its speed times this",
                            given::Keep::usual_correction))
      .optional("tolerance", &given::Keep::tolerance,
                quantity_of({Dimension::length, Dimension::force, Dimension::ratio},
                            Range::not_negative()),
                "what he lets be: length, force or share, as the wish is; nothing if left out")
      .optional("law", &given::Keep::law, located(reference()),
                "name of the function of Python that gives the drive's speed in place of a wish: "
                "such a case is run from Python, by the argument `laws` of Case.simulate")
      .optional("sees", &given::Keep::sees, named_tables(sight_format(point)),
                "what the law is given, by name, beside the `position` and `speed` of its drive")
      .optional("every", &given::Keep::every, quantity(Dimension::time, Range::between(0.01, 1)),
                "time between two looks of the law, shortened so that the reaction is a number of "
                "them; 0.2 s if left out")
      .rule(check_keep)
      .rule(check_names_of_sights)
      .place(&given::Keep::place);
  return table.format();
}

Format<given::Keep> mechanism_law_format(const Format<Located<RopePoint>>& point) {
  Table<given::Keep> table("law",
                           "A law of your own, a function of Python, that gives the speed of a "
                           "mechanism's drive after what it sees.");
  table
      .optional("law", &given::Keep::law, located(reference()),
                "name of the function: such a mechanism is run from Python, by the argument `laws` "
                "of Case.simulate")
      .optional("sees", &given::Keep::sees, named_tables(mechanism_sight_format(point)),
                "what the law is given, by name, beside the `position` and `speed` of its drive")
      .optional("every", &given::Keep::every, quantity(Dimension::time, Range::between(0.01, 1)),
                "time between two looks of the law, shortened so that the reaction is a number of "
                "them; 0.2 s if left out")
      .by_default("reaction", &given::Keep::reaction,
                  quantity(Dimension::time, Range::not_negative()), "1 s",
                  "from what the law sees to what is done")
      .rule([](const given::Keep& keep, Reading& reading, const Mark& mark) {
        if (!keep.law)
          reading.error(mark, "the move does not name its law", {"for example {law: go}"});
      })
      .rule(check_names_of_sights)
      .place(&given::Keep::place);
  return table.format();
}

}  // namespace blocklift::pipeline

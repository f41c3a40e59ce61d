#include "pipeline/files/rigging/rope_model.h"

#include <algorithm>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

/// The points of a curve, if they are strains and tensions.
bool check_points(const RopeModel& rope, Reading& reading) {
  const auto& [points, mark] = *rope.tension_curve;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [strain, tension] = points[i];
    const bool is_share = tension.dimension == Dimension::ratio;
    std::string complaint;
    if (strain.dimension != Dimension::ratio || !(strain.value >= 0 && strain.value <= 1))
      complaint = "begins with a strain from 0 to 100 %";
    else if (is_share && tension.value != 0 && !(rope.breaking_load > 0))
      complaint = "has a share of the breaking load, which the rope does not have";
    else if (is_share && !(tension.value >= 0 && tension.value <= 1))
      complaint = "ends with a tension, or a share of the breaking load from 0 to 100 %";
    if (complaint.empty()) continue;
    reading.error(
        mark,
        is_share && tension.value != 0 && !(rope.breaking_load > 0)
            ? fmt::format("point {} of tension_curve {}", i + 1, complaint)
            : fmt::format("point {} of tension_curve is none: a point {}", i + 1, complaint),
        {"for example tension_curve: [[0 %, 0 t], [1 %, 20 t], [2 %, 60 t]]"});
    return false;
  }
  return true;
}

void check_curve(const RopeModel& rope, Reading& reading) {
  if (!check_points(rope, reading)) return;
  const Mark& mark = rope.tension_curve->mark;
  const std::vector<RopeModel::CurvePoint> points = rope.curve();
  if (points.front().strain != 0 || points.front().tension != 0) {
    reading.error(mark, "tension_curve does not begin at no strain and no tension",
                  {"its first point is [0 %, 0 t]"});
    return;
  }
  constexpr double rounding = 1e-9;
  double before = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double along = points[i].strain - points[i - 1].strain;
    const double rise = points[i].tension - points[i - 1].tension;
    if (!(along > 0) || !(rise > 0)) {
      reading.error(mark, fmt::format("tension_curve does not rise from point {} to the next", i),
                    {"strain and tension grow from one point to the next"});
      return;
    }
    if (rise / along < (1 - rounding) * before) {
      reading.error(mark,
                    fmt::format("tension_curve is less steep from point {} on than before: {:.4g} "
                                "after {:.4g} MN",
                                i, rise / along / 1e6, before / 1e6),
                    {"ropes grow stiffer with their load, or stay as stiff"});
      return;
    }
    before = rise / along;
  }
}

void check_stretching(const RopeModel& rope, Reading& reading, const Mark& mark) {
  if (rope.tension_curve && std::isfinite(rope.axial_stiffness)) {
    reading.error(rope.tension_curve->mark, "the rope has both axial_stiffness and tension_curve",
                  {"leave one of the two out"});
  } else if (rope.tension_curve) {
    check_curve(rope, reading);
  } else if (!std::isfinite(rope.axial_stiffness) && !reading.is_owner_unsound()) {
    reading.error(mark, "the rope has neither axial_stiffness nor tension_curve",
                  {"give its stiffness, axial_stiffness: 100 MN, or its tension over the strain"});
  }
}

Table<RopeModel>& add_rope_keys(Table<RopeModel>& table, bool breaking_load_required) {
  table
      .optional("axial_stiffness", &RopeModel::axial_stiffness,
                quantity(Dimension::force, Range::positive()),
                "EA, the tension at which the rope would be twice as long; of all falls together. "
                "This or tension_curve")
      .optional(
          "tension_curve", &RopeModel::tension_curve,
          located(
              list_of(array_of<Quantity, 2>(quantity_of({Dimension::load, Dimension::ratio})), 2)),
          "in place of axial_stiffness, of ropes that grow stiffer with their load: [[strain, "
          "tension], ...] from [0 %, 0 t] on, tensions of all falls together or as shares of "
          "the breaking load, ever steeper; a smooth curve through these points, straight on "
          "beyond the last, the same way back")
      .by_default("damping_time", &RopeModel::damping_time,
                  quantity(Dimension::time, Range::between(0, 1)), "5 ms",
                  "damping over stiffness (Kelvin-Voigt): the tension gains stiffness times this "
                  "time times the rate of stretching")
      .optional("diameter", &RopeModel::diameter, quantity(Dimension::length, Range::positive()),
                "of the rope, for bending and tolerances by a standard")
      .optional(
          "mass", &RopeModel::mass_per_length,
          quantity(Dimension::mass_per_length, Range::positive()),
          "per length, of all falls together; rigging weight where a case has a standard, and "
          "in the motion where it asks for rope_weight")
      .optional("material", &RopeModel::material, located(reference()),
                "by which a standard has its material factor")
      .optional("termination", &RopeModel::termination, located(reference()),
                "of the ends, by which a standard has its termination factor")
      .place(&RopeModel::place)
      .rule(check_stretching);
  const Format<double> load = quantity(Dimension::load, Range::positive());
  if (breaking_load_required) {
    return table.required("breaking_load", &RopeModel::breaking_load, load,
                          "smallest breaking load, of all falls together");
  }
  return table.optional("breaking_load", &RopeModel::breaking_load, load,
                        "smallest breaking load, of all falls together; shown beside the tension");
}

}  // namespace

std::vector<RopeModel::CurvePoint> RopeModel::curve() const {
  std::vector<CurvePoint> points;
  if (!tension_curve) return points;
  for (const auto& [strain, tension] : tension_curve->value) {
    // Nothing is no share of anything, whether the breaking load is known or not.
    const bool is_share = tension.dimension == Dimension::ratio && tension.value != 0;
    points.push_back({strain.value, is_share ? tension.value * breaking_load : tension.value});
  }
  return points;
}

bool RopeModel::stretches_like(const RopeModel& other) const {
  const bool same_curve = std::ranges::equal(curve(), other.curve());
  const bool same_stiffness = tension_curve || axial_stiffness == other.axial_stiffness;
  return same_curve && same_stiffness && damping_time == other.damping_time;
}

Format<RopeModel> rope_model_format() {
  Table<RopeModel> table("rope", "A wire rope, a sling, or all falls of a tackle taken together.");
  table
      .required("kind", &RopeModel::kind, choice<std::string>({{"rope", "rope"}}),
                "what this file describes")
      .optional("title", &RopeModel::title, text(), "for people");
  return add_rope_keys(table, true).format();
}

Format<RopeChoice> rope_choice_format(bool breaking_load_required) {
  Table<RopeModel> table("rope",
                         "A rope described where it is used; a model file has the same keys.");
  const auto by_name = converted<Located<std::string>, RopeChoice>(
      located(reference()), [](Located<std::string> name) {
        return RopeChoice{std::move(name), std::nullopt};
      });
  const auto by_keys = converted<RopeModel, RopeChoice>(
      add_rope_keys(table, breaking_load_required).format(), [](RopeModel rope) {
        return RopeChoice{std::nullopt, std::move(rope)};
      });
  return by_shape<RopeChoice>(by_name, std::nullopt, by_keys);
}

}  // namespace blocklift::pipeline

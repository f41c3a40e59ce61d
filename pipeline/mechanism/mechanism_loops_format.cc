#include "pipeline/mechanism/mechanism_parts.h"
#include "pipeline/mechanism/mechanism_parts_check.h"

/// Formats of what closes and pulls together a mechanism: points, loops, springs.
namespace blocklift::pipeline {
namespace {

constexpr auto zero_position = "[0 m, 0 m, 0 m]";

Format<LoopSide> loop_side_format() {
  Table<LoopSide> table("side of a loop",
                        "A frame in a body or, of a gear, a degree of freedom of a joint.");
  table.optional("body", &LoopSide::body, reference(), "\"world\" or one of the bodies")
      .optional("position", &LoopSide::position, position_format(),
                "of the loop's frame in the body's frame; its origin if left out")
      .optional("orientation", &LoopSide::attitude, attitude_format(),
                "of the loop's frame in the body's frame: roll, pitch, yaw")
      .optional("joint", &LoopSide::joint, reference(), "of a gear: the joint that is geared")
      .optional("degree_of_freedom", &LoopSide::degree_of_freedom, integer(Range::between(1, 6)),
                "of a gear: which of the joint's degrees of freedom, counted from 1")
      .place(&LoopSide::place)
      .rule(check_loop_side);
  const auto joint_alone = converted<Located<std::string>, LoopSide>(located(reference()),
                                                                     [](Located<std::string> name) {
                                                                       LoopSide side;
                                                                       side.place = name.mark;
                                                                       side.joint = std::move(name);
                                                                       return side;
                                                                     });
  return by_shape<LoopSide>(joint_alone, std::nullopt, table.format());
}

}  // namespace

Format<PointModel> point_format() {
  Table<PointModel> table("point", "A point of a body.");
  table.required("body", &PointModel::body, located(reference()), "\"world\" or one of the bodies")
      .by_default("position", &PointModel::position, position_format(), zero_position,
                  "in the body's frame")
      .place(&PointModel::place);
  return table.format();
}

Format<LoopModel> loop_format() {
  std::vector<std::pair<std::string, dynamics::LoopKind>> kinds;
  for (const std::string_view name : dynamics::loop_kind_names()) {
    kinds.emplace_back(name, *dynamics::loop_kind(name));
  }
  Table<LoopModel> table("loop",
                         "What must hold between two bodies besides the joints of the tree: a "
                         "joint of any kind, a rod "
                         "between two points (distance), a point on a line, a gear, or a rope of "
                         "given length led over "
                         "several points (rope_length).");
  table.required("kind", &LoopModel::kind, choice<dynamics::LoopKind>(kinds), "what it holds")
      .optional("first", &LoopModel::first, loop_side_format(), "of all kinds but rope_length")
      .optional("second", &LoopModel::second, loop_side_format(),
                "of all kinds but rope_length; of point_on_line the body that carries the line")
      .optional("axis", &LoopModel::axis, direction_format(),
                "of joints as in the tree, in the first's frame; of point_on_line the line's "
                "direction, in the second's frame; z if left out")
      .optional("second_axis", &LoopModel::second_axis, direction_format(),
                "of a universal joint, in the second's frame")
      .optional("length", &LoopModel::length, quantity(Dimension::length, Range::positive()),
                "of a distance or rope_length; as it is at the start if left out")
      .optional(
          "ratio", &LoopModel::ratio,
          quantity_of({Dimension::ratio, Dimension::length_per_angle, Dimension::angle_per_length}),
          "of a gear: velocity of the first over that of the second")
      .optional(
          "offset", &LoopModel::offset, quantity_of(travels),
          "of a gear: coordinate of the first less ratio times that of the second; as it is at "
          "the start if left out")
      .optional("paths", &LoopModel::paths, list_of(list_of(point_format(), 2), 1),
                "of rope_length: lists of points that the rope connects one after another; the "
                "lengths of all paths make one sum")
      .rule(check_loop);
  return table.format();
}

Format<SpringModel> spring_format() {
  Table<SpringModel> table("spring",
                           "Spring with a damper, between two points, at a joint, or against the "
                           "turning of two bodies. It pulls and pushes.");
  table
      .required("kind", &SpringModel::kind,
                choice<SpringKind>({{"point", SpringKind::point},
                                    {"joint", SpringKind::joint},
                                    {"torsional", SpringKind::torsional}}),
                "where it acts: between two points, at a degree of freedom of a joint, or against "
                "any turn of one body as seen from another (torsional)")
      .optional("from", &SpringModel::from, point_format(),
                "of a point spring: one end; of a torsional one the body alone")
      .optional("to", &SpringModel::to, point_format(),
                "of a point spring: the other end; of a torsional one the body alone")
      .optional("joint", &SpringModel::joint, reference(), "of a joint spring")
      .optional("degree_of_freedom", &SpringModel::degree_of_freedom, integer(Range::between(1, 6)),
                "of a joint spring: which of the joint's degrees of freedom, counted from 1; the "
                "first if left out")
      .required("stiffness", &SpringModel::stiffness,
                quantity_of({Dimension::stiffness, Dimension::rotational_stiffness},
                            Range::not_negative()),
                "force over elongation, or moment over turn; zero for a damper alone")
      .optional(
          "damping", &SpringModel::damping,
          quantity_of({Dimension::damping, Dimension::rotational_damping}, Range::not_negative()),
          "viscous, in parallel with the spring; none if left out")
      .optional("free_length", &SpringModel::free_length,
                quantity(Dimension::length, Range::not_negative()),
                "of a point spring: its length without force")
      .optional("free_coordinate", &SpringModel::free_coordinate, quantity_of(travels),
                "of a joint spring: coordinate without force; zero if left out")
      .optional("free_orientation", &SpringModel::free_orientation, attitude_format(),
                "of a torsional spring: orientation of `to` in the axes of `from` without moment; "
                "the axes parallel if left out")
      .rule(check_spring);
  return table.format();
}

}  // namespace blocklift::pipeline

#include <algorithm>

#include "pipeline/files/lift_case/case_formats.h"
#include "pipeline/files/mechanism/mechanism_file.h"

namespace blocklift::pipeline {
namespace {

/// One number for a joint, three for a body.
Format<Components> components(Dimension dimension) {
  const auto element = quantity(dimension);
  const auto one =
      converted<double, Components>(element, [](double value) { return Components{value}; });
  return by_shape<Components>(one, list_of(element, 3, 3), std::nullopt);
}

/// `[[0 s, 0 N m], [1 s, 5 N m]]`: rows of a time and a value.
Format<LoadOverTime> load_over_time(Dimension dimension) {
  const auto time = quantity(Dimension::time);
  const auto value = components(dimension);
  auto row = std::make_shared<ValueDescription>();
  row->kind = ValueDescription::Kind::list;
  auto either = std::make_shared<ValueDescription>();
  either->kind = ValueDescription::Kind::any_of;
  either->alternatives = {time.description, value.description};
  row->element = either;
  row->fewest = row->most = 2;
  const Format<TimedComponents> row_format{
      row, [row, time, value](const YAML::Node& node, Reading& reading, TimedComponents& result) {
        if (!check_list(node, *row, reading)) return false;
        const bool time_read = time.read(node[0], reading, result.time);
        return value.read(node[1], reading, result.components) && time_read;
      }};
  return list_of(row_format, 2);
}

Format<Vector3> gravity_format() {
  const auto downwards =
      converted<double, Vector3>(quantity(Dimension::acceleration, Range::between(0, 1000)),
                                 [](double g) { return Vector3(0, 0, -g); });
  const auto vector = converted<std::array<double, 3>, Vector3>(
      array_of<double, 3>(quantity(Dimension::acceleration)),
      [](std::array<double, 3> g) { return Vector3(g[0], g[1], g[2]); });
  return by_shape<Vector3>(downwards, vector, std::nullopt);
}

Format<Located<RopePoint>> body_rope_point_format() {
  return located(converted<PointModel, RopePoint>(point_format(), [](PointModel model) {
    RopePoint point;
    point.body = std::move(model.body);
    point.point = model.position;
    return point;
  }));
}

Format<ForceModel> force_format() {
  Table<ForceModel> table(
      "force",
      "Force and moment on a body, or at a joint; constant, or from a table over "
      "time: straight between its points, constant before and behind them.");
  table.optional("body", &ForceModel::body, reference(), "on which it acts")
      .optional("position", &ForceModel::position, position_format(),
                "where the force acts, in the body's frame; its origin if left out")
      .optional("frame", &ForceModel::frame,
                choice<LoadFrame>({{"world", LoadFrame::world}, {"body", LoadFrame::body}}),
                "along whose axes the components are counted; the world's if left out")
      .optional("joint", &ForceModel::joint, reference(), "at which it acts, in place of a body")
      .optional("degree_of_freedom", &ForceModel::degree_of_freedom, integer(Range::between(1, 6)),
                "which of the joint's degrees of freedom, counted from 1; the first if left out")
      .optional("force", &ForceModel::force, components(Dimension::force),
                "three components on a body, one value where a joint slides")
      .optional("moment", &ForceModel::moment, components(Dimension::moment),
                "three components on a body, one value where a joint turns")
      .optional("force_table", &ForceModel::force_table, load_over_time(Dimension::force),
                "in place of force: [[0 s, 0 N], [1 s, 5 N]]")
      .optional("moment_table", &ForceModel::moment_table, load_over_time(Dimension::moment),
                "in place of moment: [[0 s, 0 N m], [1 s, 5 N m]]");
  return table.format();
}

Format<DriveModel> drive_format() {
  Table<DriveModel> table = drive_table(false);
  table
      .optional(
          "constant_speed", &DriveModel::constant_speed, quantity_of(speeds),
          "in place of speed, acceleration, jerk and range: the joint moves so from its initial "
          "position on")
      .optional(
          "table", &DriveModel::table,
          list_of(array_of<Quantity, 2>(
                      quantity_of({Dimension::time, Dimension::length, Dimension::angle})),
                  2),
          "in place of speed, acceleration, jerk and range: the coordinate over time, [[0 s, 0 "
          "deg], [1 s, 5 deg]], as a natural cubic spline");
  return table.format();
}

Format<InitialState> initial_format() {
  Table<InitialState> table("initial state", "Where the motion begins.");
  table
      .optional(
          "positions", &InitialState::positions, joint_values_format(joint_positions),
          "of joints, by name, one value for each degree of freedom (a spherical joint: roll, "
          "pitch, yaw or a quaternion w, x, y, z; a free one: a position, then the same); zero "
          "where left out")
      .optional(
          "velocities", &InitialState::velocities, joint_values_format(speeds),
          "of joints, by name (a spherical joint: angular speeds about the body's axes; a free "
          "one: speeds and angular speeds along them); zero where left out")
      .by_default(
          "assembly", &InitialState::assembly,
          choice<Assembly>({{"nearest", Assembly::nearest}, {"as_given", Assembly::as_given}}),
          "nearest",
          "how loops are closed: by the nearest positions and velocities, or not at all, so "
          "that open ones are an error")
      .optional("held", &InitialState::held, list_of(located(reference())),
                "joints that stay as given while the loops are closed");
  return table.format();
}

Format<SimulationSettings> simulation_format() {
  Table<SimulationSettings> table("simulation settings", "How the motion is computed.");
  table
      .required("duration", &SimulationSettings::duration,
                quantity(Dimension::time, Range::positive()), "simulated time")
      .by_default("relative_tolerance", &SimulationSettings::relative_tolerance,
                  number(Range::between(1e-14, 1e-2)), "1e-8", "of the time integration")
      .optional("sample_interval", &SimulationSettings::sample_interval,
                quantity(Dimension::time, Range::positive()),
                "between two recorded samples; a five hundredth of the duration if left out")
      .by_default(
          "start", &SimulationSettings::start,
          choice<Start>({{"as_given", Start::as_given}, {"equilibrium", Start::equilibrium}}),
          "as_given", "from the initial state, or at rest from the equilibrium near to it");
  return table.format();
}

Format<OutputModel> output_format() {
  std::vector<std::pair<std::string, std::string>> quantities;
  for (const char* subject : {"joint", "point", "spring", "rope", "loop"}) {
    for (const std::string& quantity : output_quantities(subject)) {
      const std::pair<std::string, std::string> word{quantity, quantity};
      if (std::find(quantities.begin(), quantities.end(), word) == quantities.end()) {
        quantities.push_back(word);
      }
    }
  }
  std::vector<std::pair<std::string, std::string>> energies;
  for (const std::string& energy : output_quantities("energy"))
    energies.emplace_back(energy, energy);
  Table<OutputModel> table("output",
                           "Something of the motion that is wanted as a result: of one of "
                           "joint, point, spring, rope, loop and energy.");
  table
      .optional("joint", &OutputModel::joint, reference(),
                "its position, velocity, acceleration, or the force of its drive")
      .optional("point", &OutputModel::point, point_format(),
                "its position, velocity, acceleration in the world, or of its body the orientation "
                "(quaternion w, x, y, z), angular_velocity, angular_acceleration")
      .optional("spring", &OutputModel::spring, reference(), "its force or elongation")
      .optional("rope", &OutputModel::rope, reference(),
                "its tension, elongation or length; first_tension and last_tension are those "
                "of its two ends, which friction at sheaves makes unequal; of a mooring or a "
                "tugger, by name, the tension")
      .optional(
          "loop", &OutputModel::loop, reference(),
          "its force on the second body in the world (moment, then force, at the loop's frame), "
          "its multipliers, or its residual")
      .optional("energy", &OutputModel::energy, choice<std::string>(energies),
                "kind of energy, or work since the start")
      .optional("quantity", &OutputModel::quantity, choice<std::string>(quantities),
                "what of it; the first of those named at its kind if left out");
  return table.format();
}

}  // namespace

Format<MechanismFile> mechanism_file_format() {
  Table<MechanismFile> table(
      "mechanism",
      "Bodies, what joins them, what acts on them, how they start, and what is "
      "asked; for `blocklift simulate`.");
  table.required("mechanism", &MechanismFile::name, name(), "its name")
      .optional("title", &MechanismFile::title, text(), "for people")
      .by_default("gravity", &MechanismFile::gravity, gravity_format(), "9.80665 m/s^2",
                  "acceleration of gravity: downwards (along -z), or a vector")
      .optional("parameters", &MechanismFile::parameters, parameters_format(),
                "values that expressions in this file may use")
      .early()
      .optional("urdf", &MechanismFile::urdf, located(reference()),
                "file with a robot description whose bodies and joints come first")
      .optional("bodies", &MechanismFile::bodies, named_tables(body_format()), "rigid bodies")
      .optional("joints", &MechanismFile::joints, named_tables(joint_format()),
                "one for each body, which it carries")
      .optional("loops", &MechanismFile::loops, named_tables(loop_format()),
                "what must hold besides the joints")
      .optional("springs", &MechanismFile::springs, named_tables(spring_format()),
                "between points or at joints")
      .optional("ropes", &MechanismFile::ropes,
                named_tables(rope_in_case_format(body_rope_point_format(), false)),
                "which pull and never push")
      .optional("forces", &MechanismFile::forces, named_tables(force_format()),
                "on bodies and at joints")
      .optional("wind", &MechanismFile::wind, wind_format(),
                "on wind areas of bodies; none if left out");
  add_marine_keys(table);
  table
      .optional("drives", &MechanismFile::drives, named_tables(drive_format()),
                "that prescribe coordinates of joints")
      .optional("operation", &MechanismFile::operation,
                list_of(steered_stage_format(mechanism_law_format(body_rope_point_format()))),
                "stages of moves, one after another")
      .by_default("initial", &MechanismFile::initial, initial_format(), "{}",
                  "where the motion begins")
      .required("simulate", &MechanismFile::simulate, simulation_format(),
                "how the motion is computed")
      .optional("outputs", &MechanismFile::outputs, named_tables(output_format()),
                "by name; joints, springs, ropes, loops and energies if left out")
      .place(&MechanismFile::place);
  return table.format();
}

}  // namespace blocklift::pipeline

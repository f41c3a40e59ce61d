#include "pipeline/results/files/result_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "pipeline/checks/loop_loads.h"
#include "pipeline/formats/results/results_layout.h"
#include "pipeline/lift/history_figures.h"
#include "pipeline/results/files/drawn_path.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {

namespace {

using dynamics::History;
using dynamics::LiftSystem;

bool is_hoist(const Scene& scene, std::size_t rope) {
  return std::any_of(scene.hoists.begin(), scene.hoists.end(),
                     [&](const DrawnTackle& tackle) { return tackle.rope == rope; });
}

void write_tension(ResultsWriter& file, const std::string& path,
                   const dynamics::RopeHistory& rope) {
  file.write(layout::join(path, "tension"), span_of(rope.tension),
             {"N", "tension of the rope, all falls together"});
  file.write(layout::join(path, "elongation"), span_of(rope.elongation),
             {"m", "stretched less unstretched length; negative when slack"});
}

void write_hoist(ResultsWriter& file, std::string_view group, const History& history,
                 const DrawnTackle& tackle) {
  const dynamics::RopeHistory& rope = history.ropes[tackle.rope];
  const std::string path = layout::join(group, "hoists", tackle.name);
  write_tension(file, path, rope);
  file.write(layout::join(path, "length"), span_of(rope.unstretched_length),
             {"m", "unstretched length that the winches of its rope have paid out"});
  file.write(layout::join(path, "swing"),
             span_of(swing_angles(hook_pull(rope, tackle.hook_is_first))),
             {"rad", "angle of the rope at the crane against the vertical"});
}

void write_body(ResultsWriter& file, std::string_view group, const dynamics::BodyHistory& body) {
  const std::string path = layout::join(group, "bodies", body.name);
  file.write_matrix(layout::join(path, "pose"), body.pose,
                    {"m, 1",
                     "origin of the body in the world (x y z), then the unit quaternion "
                     "(w x y z) that turns body into world"});
  file.write_matrix(layout::join(path, "velocity"), body.velocity,
                    {"rad/s, m/s", "angular velocity, then velocity of the origin, in the world"});
  file.write_matrix(
      layout::join(path, "acceleration"), body.acceleration,
      {"rad/s2, m/s2", "angular acceleration, then acceleration of the origin, in the world"});
}

void write_elastic_mode(ResultsWriter& file, std::string_view group,
                        const dynamics::ElasticMode& mode, const std::string& body,
                        const dynamics::ElasticModeHistory& history) {
  const std::string path = layout::join(group, "elastic_modes", mode.name);
  file.write(layout::join(path, "coordinate"), span_of(history.coordinate),
             {"m", "root of the mean square displacement in the mode, over the body's mass"});
  file.write(layout::join(path, "rate"), span_of(history.rate), {"m/s", "rate of the coordinate"});
  file.write(layout::join(path, "acceleration"), span_of(history.acceleration),
             {"m/s2", "second rate of the coordinate"});
  file.write_attribute(path, "body", body);
  file.write_attribute(path, "frequency_Hz", mode.angular_frequency / (2 * std::numbers::pi));
  file.write_attribute(path, "damping_ratio", mode.damping_ratio);
  file.write_attribute(path, "modal_mass_kg", mode.modal_mass);
}

void write_drive(ResultsWriter& file, std::string_view group, const dynamics::DriveHistory& drive) {
  const std::string path = layout::join(group, "drives", drive.name);
  file.write(layout::join(path, "position"), span_of(drive.position),
             {"m or rad", "coordinate of the driven joint"});
  file.write(layout::join(path, "force"), span_of(drive.force),
             {"N or N m", "force or torque that the drive gives"});
}

/// The path along which a rope is drawn.
void write_path(ResultsWriter& file, const LiftSystem& system, const std::string& name,
                const char* kind, const std::vector<dynamics::BodyPoint>& path) {
  std::vector<std::string> bodies;
  std::vector<dynamics::Vector3> points;
  for (const dynamics::BodyPoint& point : path) {
    bodies.push_back(system.mechanism().body(point.body).name);
    points.push_back(point.p_BoQ_B);
  }
  const std::string group = layout::join(layout::scene_ropes, name);
  file.write_texts(layout::join(group, "bodies"), bodies, "body of each point of the path");
  file.write_points(layout::join(group, "points"), points,
                    {"m", "points of the path, each in its body's frame"});
  file.write_attribute(group, "kind", kind);
}

void write_energy(ResultsWriter& file, std::string_view group,
                  const dynamics::EnergyHistory& energy) {
  const auto write = [&](const char* name, const Eigen::VectorXd& values, const char* text) {
    if (values.size() > 0)
      file.write(layout::join(group, "energy", name), span_of(values), {"J", text});
  };
  write("kinetic", energy.kinetic, "kinetic energy");
  write("gravity", energy.gravity, "potential energy of gravity, zero at z = 0");
  write("elastic", energy.elastic, "energy stored in ropes, springs and supports");
  write("drive_work", energy.drive_work, "work of the drives since the start");
  write("winch_work", energy.winch_work, "work of the winches since the start");
  write("outside_work", energy.outside_work,
        "work of wind, waves and radiated waves since the start");
  write("dissipated", energy.dissipated, "energy lost to damping since the start");
  write("balance", energy_imbalance(energy), "what the other terms leave unexplained");
}

void write_state(ResultsWriter& file, std::string_view way, std::string_view name,
                 const BlockState& state, const structure::SurfaceField& field) {
  const std::string path = layout::join(layout::structure_group, way, name);
  file.write_points(layout::join(path, "displacement"), field.displacement,
                    {"m", "displacement relative to the block's mean rigid motion, block frame"});
  file.write(layout::join(path, "von_mises"), field.von_mises,
             {"Pa", "von Mises stress, the larger of a plate's two surfaces"});
  const auto write_point = [&](const char* point, const structure::Extreme& extreme) {
    file.write(layout::join(path, point), std::span<const double>(extreme.point_B.data(), 3),
               {"m", "place in the block frame: " + extreme.part});
  };
  write_point("peak_stress_point", state.result.peak_von_mises);
  write_point("checked_stress_point", state.result.checked_von_mises);
  write_point("max_displacement_point", state.result.displacement);
  if (!state.rope.empty()) file.write_attribute(path, "rope", state.rope);
  if (state.time) file.write_attribute(path, "time", *state.time);
}

}  // namespace

std::string creation_time() {
  const auto now =
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%FT%TZ}", fmt::gmtime(now));
}

void write_case(ResultsWriter& file, const std::string& name, const std::string& title,
                const std::string& yaml, const std::string& run) {
  file.write_attribute("/", "format", layout::format_name);
  file.write_attribute("/", "format_version", layout::format_version);
  file.make_group(layout::case_group);
  file.write_attribute(layout::case_group, "name", name);
  file.write_attribute(layout::case_group, "title", title);
  file.write_attribute(layout::case_group, "created", creation_time());
  file.write_attribute(layout::case_group, "program_version", program_version);
  file.write_attribute(layout::case_group, layout::run, run);
  file.write_text(layout::case_yaml, yaml, "the case file");
}

void write_models(ResultsWriter& file, const std::vector<ModelText>& models) {
  std::vector<std::string> names, contents;
  for (const ModelText& model : models) {
    names.push_back(model.name);
    contents.push_back(model.text);
  }
  file.write_texts(layout::model_names, names, "names of the models that the case is made of");
  file.write_texts(layout::model_contents, contents, "the model files as they stood");
}

void write_operation(ResultsWriter& file, const dynamics::Operation& operation) {
  std::vector<std::string> names;
  std::vector<double> start, end;
  for (const dynamics::Stage& stage : operation.stages()) {
    names.push_back(stage.name);
    start.push_back(stage.start);
    end.push_back(stage.end);
  }
  file.write_texts(layout::stage_names, names, "names of the operation's stages");
  file.write(layout::stage_start, start, {"s", "start of each stage"});
  file.write(layout::stage_end, end, {"s", "end of each stage"});
}

void write_history(ResultsWriter& file, std::string_view group, const LiftSystem& system,
                   const History& history, const Scene& scene) {
  file.write(layout::join(group, "time"), span_of(history.time), {"s", "time of each sample"});
  for (std::size_t i = 0; i < history.ropes.size(); ++i) {
    if (is_hoist(scene, i)) continue;
    const dynamics::RopeHistory& rope = history.ropes[i];
    write_tension(file, layout::join(group, "ropes", rope.name), rope);
  }
  for (const DrawnTackle& tackle : scene.hoists) write_hoist(file, group, history, tackle);
  for (const auto& body : history.bodies) write_body(file, group, body);
  const dynamics::Mechanism& mechanism = system.mechanism();
  for (std::size_t i = 0; i < history.elastic_modes.size(); ++i) {
    const dynamics::ElasticMode& mode = mechanism.elastic_modes()[i];
    write_elastic_mode(file, group, mode, mechanism.body(mode.body).name, history.elastic_modes[i]);
  }
  for (const auto& drive : history.drives) write_drive(file, group, drive);
  for (std::size_t i = 0; i < system.supports().size(); ++i) {
    file.write(layout::join(group, "supports", history.supports[i].name, "normal_force"),
               span_of(history.supports[i].normal_force), {"N", "upwards on the body"});
  }
  write_loops(file, group, system, history);
  write_energy(file, group, history.energy);
}

void write_measures(ResultsWriter& file, const std::vector<LiftMeasure>& measures) {
  for (const LiftMeasure& measure : measures) {
    const auto write = [&](std::string_view history, const Eigen::VectorXd& values) {
      file.write(layout::join(history, "measures", measure.name()), span_of(values),
                 {measure.unit, measure.meaning});
    };
    write(layout::static_history, measure.at_rest);
    write(layout::dynamic_history, measure.in_motion);
  }
}

void write_scene(ResultsWriter& file, const LiftSystem& system, const dynamics::History& history,
                 const Scene& scene) {
  for (const DrawnBody& body : scene.bodies) {
    RowMajorMatrix boxes(static_cast<Eigen::Index>(body.boxes.size()), 10);
    for (std::size_t i = 0; i < body.boxes.size(); ++i) {
      boxes.row(i) << body.boxes[i].size.transpose(), body.boxes[i].centre.transpose(),
          body.boxes[i].orientation.transpose();
    }
    const std::string path = layout::join(layout::scene_bodies, body.name);
    file.write_matrix(
        layout::join(path, "boxes"), boxes,
        {"m, m, 1",
         "size x y z, centre x y z and orientation w x y z of each box, in the body's frame"});
    file.write_attribute(path, "kind", body.kind);
  }
  for (std::size_t i = 0; i < system.ropes().size(); ++i) {
    if (is_hoist(scene, i)) continue;
    write_path(file, system, system.ropes()[i].name(), "sling", drawn_path(system, i, history));
  }
  for (const DrawnTackle& tackle : scene.hoists) {
    // From sheave to hook; of one rope over two hooks its own part, of twin falls down and up.
    const dynamics::Rope& rope = system.ropes()[tackle.rope];
    const auto& points = rope.points();
    std::vector<dynamics::BodyPoint> path = {*(points.end() - 2), points.back()};
    if (rope.definition().twin_falls)
      path = {points[0], points[1], points[3], points[2]};
    else if (tackle.hook_is_first)
      path = {points[1], points[0]};
    write_path(file, system, tackle.name, "hoist", path);
  }
  std::vector<std::string> names;
  std::vector<structure::Vector3> pins;
  for (const structure::LiftingPoint& lug : scene.lugs) {
    names.push_back(lug.name);
    pins.push_back(lug.p_BPin);
  }
  file.write_texts(layout::scene_lug_names, names, "lugs of the load");
  file.write_points(layout::scene_lug_points, pins, {"m", "pins of the lugs, in the load's frame"});
  file.write_attribute(layout::scene_lugs, "body", scene.load_body);
}

void write_measured(ResultsWriter& file, const Comparison& compare) {
  for (const Named<MeasuredSeries>& series : compare.series) {
    const std::string group = layout::join(layout::measured_group, series.name.value);
    file.write(layout::join(group, "time"), std::span<const double>(series.value.time),
               {"s", "of the operation"});
    file.write(layout::join(group, "tension"), std::span<const double>(series.value.tension),
               {"N", "measured: " + compare.source});
  }
}

void write_block(ResultsWriter& file, const structure::Surface& surface,
                 const structure::UnitResponses& responses, const BlockAssessment& assessment) {
  std::vector<std::int32_t> corners;
  for (const auto& quad : surface.quads()) corners.insert(corners.end(), quad.begin(), quad.end());
  const std::vector<std::int32_t> groups(surface.quad_groups().begin(),
                                         surface.quad_groups().end());
  file.write_points(layout::surface_points, surface.points(),
                    {"m", "points of the block's plates on their mid-surfaces, block frame"});
  file.write_indices(layout::surface_quads, corners, 4,
                     {"1", "corners of each quadrangle; of a triangle two are one"});
  file.write(layout::surface_quad_group, groups, {"1", "index into group_names"});
  file.write_texts(layout::surface_group_names, surface.group_names(), "plates, pads and lugs");
  const LoadComparison& together = assessment.simultaneous;
  const LoadComparison& apart = assessment.per_rope_maxima;
  const std::vector<structure::SurfaceField> fields =
      surface.evaluate(responses, {together.static_state.load, together.dynamic_state.load,
                                   apart.static_state.load, apart.dynamic_state.load});
  write_state(file, layout::simultaneous, layout::static_state, together.static_state, fields[0]);
  write_state(file, layout::simultaneous, layout::dynamic_state, together.dynamic_state, fields[1]);
  write_state(file, layout::per_rope_maxima, layout::static_state, apart.static_state, fields[2]);
  write_state(file, layout::per_rope_maxima, layout::dynamic_state, apart.dynamic_state, fields[3]);
}

}  // namespace blocklift::pipeline

#include "pipeline/files/mechanism/mechanism_file.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "pipeline/declaration/document.h"
#include "pipeline/declaration/format_once.h"
#include "pipeline/files/environment/sea_band.h"
#include "pipeline/files/environment/vessel_database.h"
#include "pipeline/files/environment/vessel_doubts.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/files/lift_case/rigging_check.h"
#include "pipeline/files/mechanism/urdf_import.h"
#include "pipeline/files/named_file.h"
#include "pipeline/files/vessel/wetted_mesh.h"

namespace blocklift::pipeline {
namespace {

namespace fs = std::filesystem;

/// Puts what comes from a robot description before the file's own parts; complains about names that
/// both have.
template <class T>
void put_before(std::vector<T> imported, std::vector<T>& own, const char* noun,
                Diagnostics& diagnostics) {
  for (const T& item : own) {
    if (find_by_name(imported, item.name.value)) {
      diagnostics.error(item.name.mark, fmt::format("the robot description has a {} \"{}\", too",
                                                    noun, item.name.value));
    }
  }
  own.insert(own.begin(), std::make_move_iterator(imported.begin()),
             std::make_move_iterator(imported.end()));
}

/// Adds the parts of a robot; its root stands fixed in the world unless a joint of the file carries
/// it.
void add_robot(RobotImport robot, const Mark& mark, MechanismFile& mechanism,
               Diagnostics& diagnostics) {
  for (std::string& note : robot.notes) mechanism.notes.push_back(std::move(note));
  const auto is_carried = [&](const JointModel& joint) { return joint.child.value == robot.root; };
  if (!robot.root.empty() &&
      std::none_of(mechanism.joints.begin(), mechanism.joints.end(), is_carried)) {
    JointModel base;
    base.name = {robot.root + "_to_world", mark};
    base.parent = {"world", mark};
    base.child = {robot.root, mark};
    robot.parts.joints.insert(robot.parts.joints.begin(), std::move(base));
    mechanism.notes.push_back(fmt::format("link {} stands fixed in the world", robot.root));
  }
  put_before(std::move(robot.parts.bodies), mechanism.bodies, "link", diagnostics);
  put_before(std::move(robot.parts.joints), mechanism.joints, "joint", diagnostics);
  put_before(std::move(robot.parts.loops), mechanism.loops, "loop", diagnostics);
  for (BodyModel& body : mechanism.bodies) {
    if (!body.name.mark.file) body.name.mark = mark;
  }
  for (JointModel& joint : mechanism.joints) {
    for (Located<std::string>* name : {&joint.name, &joint.parent, &joint.child}) {
      if (!name->mark.file) name->mark = mark;
    }
  }
}

/// Each vessel is a body that moves freely, on a joint of its own name; its initial position may be
/// given like that of any joint.
void add_vessels(MechanismFile& mechanism, Diagnostics& diagnostics) {
  std::vector<BodyModel> bodies;
  std::vector<JointModel> joints;
  for (const given::Vessel& vessel : mechanism.vessels) {
    if (mechanism.find_body(vessel.name.value) || mechanism.find_joint(vessel.name.value)) {
      diagnostics.error(vessel.name.mark, fmt::format("vessel {} has the name of a body or joint",
                                                      vessel.name.value));
      continue;
    }
    BodyModel& body = bodies.emplace_back();
    body.name = vessel.name;
    if (vessel.model) {
      body.mass = vessel.model->model.mass;
      body.centre_of_mass = vessel.model->model.centre_of_mass;
      body.radii_of_gyration = {vessel.model->model.radii_of_gyration, vessel.name.mark};
    }
    JointModel& joint = joints.emplace_back();
    joint.name = vessel.name;
    joint.kind = dynamics::JointKind::free;
    joint.parent = {"world", vessel.name.mark};
    joint.child = vessel.name;
  }
  mechanism.bodies.insert(mechanism.bodies.begin(), bodies.begin(), bodies.end());
  mechanism.joints.insert(mechanism.joints.begin(), joints.begin(), joints.end());
}

/// The sea wants gravity downwards.
void check_afloat(MechanismFile& mechanism, Diagnostics& diagnostics) {
  if (!mechanism.sea && mechanism.vessels.empty() && mechanism.moorings.empty() &&
      mechanism.tuggers.empty()) {
    return;
  }
  const auto refuse_breaking_load = [&](const auto& line) {
    if (line.breaking_load)
      diagnostics.error(line.name.mark,
                        "line " + line.name.value +
                            " has a breaking_load, which lift cases alone "
                            "hold its tension against",
                        {"leave it out"});
  };
  for (const given::Mooring& line : mechanism.moorings) refuse_breaking_load(line);
  for (const given::Tugger& line : mechanism.tuggers) refuse_breaking_load(line);
  const Vector3& g = mechanism.gravity;
  if (mechanism.sea && !(g.z() < 0 && g.head<2>().isZero())) {
    diagnostics.error(mechanism.sea->place, "a sea needs gravity that acts downwards, along -z");
    return;
  }
  check_marine_parts(mechanism, -g.z(), names_of(mechanism.bodies), diagnostics);
  if (!diagnostics.has_errors()) check_hulls_apart(place_hulls(mechanism), diagnostics);
  if (diagnostics.has_errors()) return;
  if (std::string doubt = doubt_about_sea(mechanism, -g.z()); !doubt.empty())
    mechanism.doubts.push_back(std::move(doubt));
  for (std::string& doubt : doubts_about_vessels(mechanism))
    mechanism.doubts.push_back(std::move(doubt));
  for (const given::Vessel& vessel : mechanism.vessels) {
    if (!vessel.model) continue;
    const std::string who = "vessel " + vessel.name.value;
    const VesselModel& model = vessel.model->model;
    for (std::string doubt :
         {doubt_about_size(who, vessel.model->hull),
          doubt_about_lightness(who, vessel.model->hull, model.mass, mechanism.sea->density)})
      if (!doubt.empty()) mechanism.doubts.push_back(std::move(doubt));
  }
  for (std::string& doubt : doubts_about_database(mechanism.vessels))
    mechanism.doubts.push_back(std::move(doubt));
}

/// A robot description alone, as a mechanism: at rest, with all joints at zero, for ten seconds.
std::optional<MechanismFile> read_robot(const fs::path& path, Diagnostics& diagnostics) {
  constexpr double duration = 10;  // s
  const std::size_t errors_before = diagnostics.error_count();
  const Document document{std::make_shared<const std::string>(shown_path(path)), {}, {}};
  const Mark mark{document.file, 0, 0};
  std::optional<RobotImport> robot = import_urdf(path, mark, diagnostics);
  if (!robot) return std::nullopt;
  MechanismFile mechanism;
  mechanism.file = path;
  mechanism.yaml = fmt::format("urdf: {}\n", path.string());
  mechanism.place = mark;
  mechanism.name = robot->name;
  mechanism.title = "Robot description " + robot->name;
  mechanism.gravity = Vector3(0, 0, -9.80665);
  mechanism.simulate.duration = {duration, mark};
  mechanism.simulate.relative_tolerance = 1e-8;
  mechanism.notes.push_back(fmt::format(
      "simulated for {:g} s from rest with all joints at zero, under standard gravity; a "
      "mechanism file with \"urdf: {}\" says otherwise",
      duration, path.filename().string()));
  add_robot(std::move(*robot), mark, mechanism, diagnostics);
  Reading reading(document, diagnostics);
  check_mechanism_file(mechanism, reading);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return mechanism;
}

}  // namespace

const given::Rope* MechanismFile::find_rope(const std::string& rope) const {
  return find_by_name(ropes, rope);
}
const SpringModel* MechanismFile::find_spring(const std::string& spring) const {
  return find_by_name(springs, spring);
}
const LoopModel* MechanismFile::find_loop(const std::string& loop) const {
  return find_by_name(loops, loop);
}

Quantity MechanismFile::start_of(const DriveModel& drive) const {
  const auto degree = static_cast<std::size_t>(std::max(0, drive.degree_of_freedom.value - 1));
  for (const auto& position : initial.positions) {
    if (position.name.value == drive.joint.value && degree < position.value.value.size()) {
      return position.value.value[degree];
    }
  }
  return {0, drive.range[0].dimension};
}

const std::vector<std::string>& output_quantities(const std::string& subject) {
  static const std::map<std::string, std::vector<std::string>> quantities = {
      {"joint", {"position", "velocity", "acceleration", "force"}},
      {"point",
       {"position", "velocity", "acceleration", "orientation", "angular_velocity",
        "angular_acceleration"}},
      {"spring", {"force", "elongation"}},
      {"rope", {"tension", "first_tension", "last_tension", "elongation", "length"}},
      {"loop", {"force", "multipliers", "residual"}},
      {"energy",
       {"total", "kinetic", "gravity", "elastic", "drive_work", "winch_work", "outside_work",
        "dissipated", "imbalance"}},
  };
  return quantities.at(subject);
}

std::string output_subject(const OutputModel& output) {
  if (output.joint) return "joint";
  if (output.point) return "point";
  if (output.spring) return "spring";
  if (output.rope) return "rope";
  if (output.loop) return "loop";
  return output.energy ? "energy" : "";
}

std::optional<MechanismFile> read_mechanism_file(const fs::path& path, ModelLibrary& library,
                                                 Diagnostics& diagnostics) {
  if (kind_of_file(path) == FileKind::robot) {
    return read_robot(path, diagnostics);
  }
  const std::size_t errors_before = diagnostics.error_count();
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? path / "mechanism.yaml" : path;
  library.begin_case();
  const std::optional<Document> document = library.read_case(file, diagnostics);
  if (!document) return std::nullopt;
  MechanismFile mechanism;
  mechanism.file = file;
  mechanism.yaml = document->text;
  Reading reading(*document, diagnostics);
  format_once<mechanism_file_format>().read(document->root, reading, mechanism);
  if (!document->root.IsMap()) return std::nullopt;
  if (mechanism.urdf && !mechanism.urdf->value.empty()) {
    const Mark& mark = mechanism.urdf->mark;
    const auto description = path_of_named_file(*mechanism.urdf, file.parent_path(), diagnostics);
    if (!description) return std::nullopt;
    auto robot = import_urdf(*description, mark, diagnostics);
    if (!robot) return std::nullopt;
    add_robot(std::move(*robot), mark, mechanism, diagnostics);
  }
  for (given::Rope& rope : mechanism.ropes) {
    rope.rope = library.resolve(rope.rope_choice, file.parent_path(), diagnostics);
    check_curve_without_friction(rope, diagnostics);
  }
  load_marine_models(mechanism, file.parent_path(), library, diagnostics);
  library.complain_about_unused_changes(diagnostics);
  add_vessels(mechanism, diagnostics);
  check_mechanism_file(mechanism, reading);
  check_afloat(mechanism, diagnostics);
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  return mechanism;
}

}  // namespace blocklift::pipeline

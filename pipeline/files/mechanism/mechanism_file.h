#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/files/library/model_library.h"
#include "pipeline/files/lift_case/lift_case.h"
#include "pipeline/files/lift_case/own_laws.h"
#include "pipeline/mechanism/mechanism_parts.h"

namespace blocklift::pipeline {

/// A force's or moment's value: one number at a joint, three components on a body; SI.
using Components = std::vector<double>;

/// Row of a table over time.
struct TimedComponents {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< s
  Components components;
};
using LoadOverTime = std::vector<TimedComponents>;

enum class LoadFrame { world, body };

/// Force and moment on a body, or at a degree of freedom of a joint.
struct ForceModel {
  Located<std::string> name;
  std::optional<Located<std::string>> body;
  std::optional<Located<Vector3>> position;  ///< where the force acts, in the body's frame, m
  std::optional<Located<LoadFrame>> frame;   ///< of the components; the world if left out
  std::optional<Located<std::string>> joint;
  std::optional<Located<int>> degree_of_freedom;  ///< from 1
  std::optional<Located<Components>> force;       ///< N
  std::optional<Located<Components>> moment;      ///< N m
  std::optional<Located<LoadOverTime>> force_table;
  std::optional<Located<LoadOverTime>> moment_table;
};

enum class Assembly { nearest, as_given };

/// Where the motion begins.
struct InitialState {
  JointValues positions;
  JointValues velocities;
  Assembly assembly = Assembly::nearest;
  std::vector<Located<std::string>> held;  ///< joints that stay as given while loops are closed
};

enum class Start { as_given, equilibrium };

struct SimulationSettings {
  Located<double> duration{std::numeric_limits<double>::quiet_NaN(), {}};  ///< s
  double relative_tolerance = 0;
  std::optional<double> sample_interval;  ///< s
  Start start = Start::as_given;
};

/// Something of the motion that is wanted as a result.
struct OutputModel {
  Located<std::string> name;
  std::optional<Located<std::string>> joint;
  std::optional<PointModel> point;
  std::optional<Located<std::string>> spring;
  std::optional<Located<std::string>> rope;
  std::optional<Located<std::string>> loop;
  std::optional<Located<std::string>> energy;
  std::optional<Located<std::string>> quantity;
};

/// A mechanism with what acts on it, how it starts, and what is asked. SI units.
struct MechanismFile : MechanismParts, MarineParts {
  std::string name;
  std::string title;
  Vector3 gravity = Vector3::Zero();  ///< acceleration of gravity in the world, m/s^2
  ParameterValues parameters;
  std::optional<Located<std::string>> urdf;
  std::vector<given::Rope> ropes;
  std::vector<ForceModel> forces;
  std::optional<given::Wind> wind;
  std::vector<given::Stage> operation;
  InitialState initial;
  SimulationSettings simulate;
  std::vector<OutputModel> outputs;
  std::vector<std::string> notes;   ///< what was taken otherwise than it was written, for the user
  std::vector<std::string> doubts;  ///< what to ask about before believing the figures
  std::string yaml;                 ///< the file as it stands
  std::filesystem::path file;       ///< where it is
  Mark place;
  OwnLaws laws = {};  ///< that its operation names; not from the file

  const given::Rope* find_rope(const std::string& rope) const;
  const SpringModel* find_spring(const std::string& spring) const;
  const LoopModel* find_loop(const std::string& loop) const;
  /// Where a drive that an operation moves stands at the start.
  Quantity start_of(const DriveModel& drive) const;
  /// Between two recorded samples, s: a five hundredth of the duration unless given.
  double sample_interval() const {
    return simulate.sample_interval.value_or(simulate.duration.value / 500);
  }
};

/// The format of a mechanism file, without the look-up of ropes and robot descriptions.
Format<MechanismFile> mechanism_file_format();

/// Complains about names that do not exist, values that do not fit what they are given to, drives
/// that cannot move as they should, and outputs that there are none of.
void check_mechanism_file(const MechanismFile& file, Reading& reading);

/// Quantities that may be asked of an output's subject ("joint"), the first being the one that is
/// meant if none is given.
const std::vector<std::string>& output_quantities(const std::string& subject);
/// The subject of an output: "joint", "point", "spring", "rope", "loop", "energy"; empty if it has
/// none.
std::string output_subject(const OutputModel& output);

/// Reads a mechanism file with all that it names, and checks it as far as that goes without
/// building its dynamics; read_mechanism() (pipeline/build/build_mechanism.h) does that, too.
/// @returns the mechanism only if nothing is wrong with it; else the complaints are in
/// `diagnostics`.
std::optional<MechanismFile> read_mechanism_file(const std::filesystem::path& path,
                                                 ModelLibrary& library, Diagnostics& diagnostics);

}  // namespace blocklift::pipeline

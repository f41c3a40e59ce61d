#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "pipeline/files/mechanism/mechanism_file.h"
#include "pipeline/files/mechanism/mechanism_schedule.h"
#include "pipeline/mechanism/mechanism_parts_check.h"

namespace blocklift::pipeline {
namespace {

class MechanismCheck {
 public:
  MechanismCheck(const MechanismFile& file, Reading& reading) : file_(file), reading_(reading) {}

  void run() {
    check_parts(file_, reading_);
    // The file was read before this: its complaints are none of this owner's.
    if (file_.bodies.empty() && !reading_.diagnostics().has_errors()) {
      reading_.error(file_.place, "the mechanism has no bodies");
    }
    for (const given::Rope& rope : file_.ropes) check_rope(rope);
    for (const ForceModel& force : file_.forces) check_force(force);
    for (const DriveModel& drive : file_.drives) check_drive(drive);
    check_operation();
    check_initial();
    check_sampling();
    for (const OutputModel& output : file_.outputs) check_output(output);
  }

 private:
  template <class T>
  void find(const std::vector<T>& items, const Located<std::string>& name, const std::string& user,
            const char* noun) {
    const std::vector<std::string> known = names_of(items);
    if (name.value.empty() || std::find(known.begin(), known.end(), name.value) != known.end()) {
      return;
    }
    reading_.error(
        name.mark,
        fmt::format("{} names {} \"{}\", which the mechanism does not have", user, noun,
                    name.value),
        {known.empty() ? fmt::format("it has no {}s", noun)
                       : names_hint(fmt::format("its {}s are", noun), known, name.value)});
  }

  void check_rope(const given::Rope& rope) {
    const auto check = [&](const Located<RopePoint>& point) {
      if (!point.value.body) return;
      check_point(file_, {*point.value.body, Vector3::Zero(), point.mark},
                  "rope " + rope.name.value, reading_);
    };
    check(rope.from);
    for (const Located<RopePoint>& sheave : rope.through) check(sheave);
    check(rope.to);
    if (!rope.winch) return;
    check_range_ascends(*rope.winch, "the winch of rope " + rope.name.value, rope.name.mark,
                        reading_);
    check_in_range("rope " + rope.name.value, {rope.length.value, Dimension::length}, *rope.winch,
                   rope.length.mark);
    if (file_.find_drive(rope.name.value)) {
      reading_.error(rope.name.mark,
                     fmt::format("rope {} with its winch has the name of a drive; give "
                                 "it another",
                                 rope.name.value));
    }
  }

  void check_force(const ForceModel& force) {
    const std::string user = "force " + force.name.value;
    if (force.body.has_value() == force.joint.has_value()) {
      reading_.error(force.name.mark, force.body
                                          ? user + " acts on a body and at a joint; give one"
                                          : user + " acts on nothing; give a body or a joint");
      return;
    }
    const bool has_force = force.force || force.force_table;
    const bool has_moment = force.moment || force.moment_table;
    if (!has_force && !has_moment) {
      reading_.error(force.name.mark, user + " has no value",
                     {"give force, moment, force_table or moment_table"});
    }
    if ((force.force && force.force_table) || (force.moment && force.moment_table)) {
      reading_.error(force.name.mark, user + " is given both as a constant and as a table");
    }
    if (force.body) {
      check_body_force(force, user);
    } else {
      check_joint_force(force, user, has_force, has_moment);
    }
  }

  void check_components(const ForceModel& force, const std::string& user, std::size_t due) {
    const auto check = [&](const char* key, std::size_t found, const Mark& mark) {
      if (found == due || found == 0) return;
      reading_.error(mark, fmt::format("{} of {} has {} component{}; {} due", key, user, found,
                                       found == 1 ? "" : "s",
                                       due == 3 ? "three, along x, y and z, are" : "one is"));
    };
    if (force.force) check("force", force.force->value.size(), force.force->mark);
    if (force.moment) check("moment", force.moment->value.size(), force.moment->mark);
    const auto check_table = [&](const char* key, const Located<LoadOverTime>& table) {
      for (std::size_t i = 0; i < table.value.size(); ++i) {
        check(key, table.value[i].components.size(), table.mark);
        if (i > 0 && table.value[i].time <= table.value[i - 1].time) {
          reading_.error(table.mark,
                         fmt::format("the times of {} of {} must ascend, but {:g} s follows {:g} s",
                                     key, user, table.value[i].time, table.value[i - 1].time));
          return;
        }
      }
    };
    if (force.force_table) check_table("force_table", *force.force_table);
    if (force.moment_table) check_table("moment_table", *force.moment_table);
  }

  void check_body_force(const ForceModel& force, const std::string& user) {
    if (force.degree_of_freedom) {
      reading_.error(force.degree_of_freedom->mark, "degree_of_freedom goes with a joint");
    }
    if (force.body->value == "world") {
      reading_.error(force.body->mark, user + " acts on the world, which nothing moves");
    } else {
      check_point(file_, {*force.body, Vector3::Zero(), force.name.mark}, user, reading_);
    }
    check_components(force, user, 3);
  }

  void check_joint_force(const ForceModel& force, const std::string& user, bool has_force,
                         bool has_moment) {
    if (force.position || force.frame) {
      reading_.error(force.name.mark,
                     user + " acts at a joint, so it has no position and no frame");
    }
    check_components(force, user, 1);
    const auto turns = check_freedom(
        file_, {*force.joint, force.degree_of_freedom.value_or(Located<int>{1, force.name.mark})},
        user, reading_);
    if (turns && (*turns ? has_force : has_moment)) {
      reading_.error(force.name.mark, fmt::format("{} gives a {}, but joint {} {} there", user,
                                                  *turns ? "force" : "moment", force.joint->value,
                                                  *turns ? "turns" : "slides"));
    }
  }

  /// A drive has limits to be moved within, a constant speed, or a table.
  void check_drive(const DriveModel& drive) {
    const std::string user = "drive " + drive.name.value;
    const bool speed = std::isfinite(drive.speed.value.value);
    const bool any = speed || drive.speed.mark.file || drive.acceleration.mark.file ||
                     drive.jerk.mark.file || std::isfinite(drive.range[0].value);
    const int ways = (any ? 1 : 0) + (drive.constant_speed ? 1 : 0) + (drive.table ? 1 : 0);
    if (ways != 1) {
      reading_.error(
          drive.name.mark,
          fmt::format("{} says {} how it moves", user, ways == 0 ? "not" : "twice"),
          {"give speed, acceleration, jerk and range for an operation to move it within, or "
           "constant_speed, or a table"});
      return;
    }
    if (any) {
      const auto demand = [&](bool given, const char* key) {
        if (!given) {
          reading_.error(drive.name.mark, fmt::format("{} lacks the key \"{}\"", user, key),
                         {"an operation moves it within speed, acceleration, jerk and range"});
        }
      };
      demand(drive.speed.mark.file != nullptr, "speed");
      demand(drive.acceleration.mark.file != nullptr, "acceleration");
      demand(drive.jerk.mark.file != nullptr, "jerk");
      demand(std::isfinite(drive.range[0].value), "range");
      check_in_range("drive " + drive.name.value, file_.start_of(drive), drive, drive.name.mark);
    }
    if (drive.table) check_drive_table(drive, user);
    check_drive_start(drive, user);
  }

  /// Complains if a coordinate is outside its drive's range at the start.
  void check_in_range(const std::string& user, const Quantity& start, const DriveLimits& limits,
                      const Mark& mark) {
    const Quantity& low = limits.range[0];
    const Quantity& high = limits.range[1];
    if (start.dimension != low.dimension ||
        !(start.value < low.value || start.value > high.value)) {
      return;
    }
    reading_.error(mark,
                   fmt::format("{} starts at {}, outside its range", user,
                               format_quantity(start.value, low.dimension)),
                   {fmt::format("its range is {} to {}", format_quantity(low.value, low.dimension),
                                format_quantity(high.value, high.dimension))});
  }

  void check_drive_table(const DriveModel& drive, const std::string& user) {
    const TimeTable& table = drive.table->value;
    for (std::size_t i = 0; i < table.size(); ++i) {
      if (!std::isfinite(table[i][0].value) || !std::isfinite(table[i][1].value)) return;
      if (table[i][0].dimension != Dimension::time || table[i][1].dimension == Dimension::time) {
        reading_.error(
            drive.table->mark,
            fmt::format("the table of {} has a point of {} and {}", user,
                        text_of(table[i][0].dimension).noun, text_of(table[i][1].dimension).noun),
            {"a time and then the coordinate are due: [1 s, 5 deg]"});
        return;
      }
      if (i > 0 && table[i][0].value <= table[i - 1][0].value) {
        reading_.error(drive.table->mark,
                       fmt::format("the times of {} must ascend, but {:g} s follows {:g} s", user,
                                   table[i][0].value, table[i - 1][0].value));
        return;
      }
    }
    const double duration = file_.simulate.duration.value;
    if (table.empty() || !std::isfinite(duration)) return;
    if (table.front()[0].value > 0 || table.back()[0].value < duration) {
      reading_.error(
          drive.table->mark,
          fmt::format("the table of {} goes from {:g} s to {:g} s, the simulation from 0 s "
                      "to {:g} s",
                      user, table.front()[0].value, table.back()[0].value, duration),
          {"give points over the whole time"});
    }
  }

  /// What the initial state says of a driven coordinate agrees with its drive.
  void check_drive_start(const DriveModel& drive, const std::string& user) {
    const auto degree = static_cast<std::size_t>(std::max(0, drive.degree_of_freedom.value - 1));
    for (const auto& velocity : file_.initial.velocities) {
      if (velocity.name.value != drive.joint.value || degree >= velocity.value.value.size())
        continue;
      if (velocity.value.value[degree].value == 0) continue;
      reading_.error(
          velocity.value.mark,
          fmt::format("the initial velocity of joint {} is that of {}; give zero or leave "
                      "it out",
                      drive.joint.value, user));
    }
    if (!drive.table || drive.table->value.empty()) return;
    for (const auto& position : file_.initial.positions) {
      if (position.name.value != drive.joint.value || degree >= position.value.value.size())
        continue;
      reading_.error(
          position.value.mark,
          fmt::format("the initial position of joint {} is that of the table of {}; leave it "
                      "out",
                      drive.joint.value, user));
    }
  }

  /// What a law sees is there, and can be seen from its drive.
  void check_sights(const ScheduledSteering& steering, const Mover& mover) {
    const std::string user = "the law of " + mover.name;
    for (const given::Sight& sight : steering.keep.sees) {
      for (const auto& point : {sight.level, sight.with, sight.over})
        if (point && point->value.body)
          check_point(file_, {*point->value.body, Vector3::Zero(), point->mark}, user, reading_);
      for (const auto& rope : {sight.pull, sight.share})
        if (rope) find(file_.ropes, *rope, user, "rope");
      for (const Located<std::string>& rope : sight.of) find(file_.ropes, rope, user, "rope");
      if (sight.over && mover.is_winch)
        reading_.error(sight.over->mark,
                       fmt::format("{} is a winch and brings nothing over a point", mover.name),
                       {"drives of joints do"});
    }
  }

  void check_operation() {
    const Schedule schedule = schedule_operation(file_, reading_.diagnostics());
    for (const ScheduledSteering& steering : schedule.steerings)
      check_sights(steering, schedule.movers[steering.mover]);
    const Located<double>& duration = file_.simulate.duration;
    if (!std::isfinite(duration.value) || schedule.duration <= duration.value) return;
    reading_.error(duration.mark,
                   fmt::format("the simulation lasts {:g} s, but the operation ends at {:.6g} s",
                               duration.value, schedule.duration),
                   {"lengthen the duration or shorten the operation"});
  }

  void check_initial() {
    check_joint_positions(file_, file_.initial.positions, "the initial state", reading_);
    check_joint_velocities(file_, file_.initial.velocities, "the initial state", reading_);
    for (const Located<std::string>& held : file_.initial.held) {
      find(file_.joints, held, "the initial state", "joint");
    }
    if (file_.simulate.start == Start::equilibrium && !file_.initial.velocities.empty()) {
      reading_.error(file_.initial.velocities.front().name.mark,
                     "a simulation that starts from equilibrium begins at rest, without initial "
                     "velocities");
    }
  }

  /// No more samples are asked for than a machine holds.
  void check_sampling() {
    constexpr double most_samples = 2e6;
    const double duration = file_.simulate.duration.value;
    const double interval = file_.sample_interval();
    if (!std::isfinite(duration) || !std::isfinite(interval)) return;
    if (duration > most_samples * interval) {
      reading_.error(file_.simulate.duration.mark,
                     fmt::format("{:g} s with a sample every {:g} s are more than {:.0f} samples",
                                 duration, interval, most_samples),
                     {"lengthen sample_interval"});
    }
  }

  void check_output(const OutputModel& output) {
    const std::string user = "output " + output.name.value;
    const int subjects = (output.joint ? 1 : 0) + (output.point ? 1 : 0) + (output.spring ? 1 : 0) +
                         (output.rope ? 1 : 0) + (output.loop ? 1 : 0) + (output.energy ? 1 : 0);
    if (subjects != 1) {
      reading_.error(output.name.mark,
                     fmt::format("{} has {} subject", user, subjects == 0 ? "no" : "more than one"),
                     {"give one of joint, point, spring, rope, loop and energy"});
      return;
    }
    if (output.joint) find(file_.joints, *output.joint, user, "joint");
    if (output.point) check_point(file_, *output.point, user, reading_);
    if (output.spring) find(file_.springs, *output.spring, user, "spring");
    if (output.rope) check_output_of_rope(output, user);
    if (output.loop) find(file_.loops, *output.loop, user, "loop");
    if (!output.quantity) return;
    const std::string subject = output_subject(output);
    const std::vector<std::string>& known = output_quantities(subject);
    if (subject == "energy") {
      reading_.error(output.quantity->mark, user + " is an energy and has no further quantity");
    } else if (!output.quantity->value.empty() &&
               std::find(known.begin(), known.end(), output.quantity->value) == known.end()) {
      reading_.error(
          output.quantity->mark,
          fmt::format("{} asks for the {} of a {}", user, output.quantity->value, subject),
          {names_hint(fmt::format("quantities of a {} are", subject), known,
                      output.quantity->value)});
    }
    const JointModel* joint = output.joint ? file_.find_joint(output.joint->value) : nullptr;
    if (joint && output.quantity->value == "force" && !is_driven(joint->name.value)) {
      reading_.error(output.quantity->mark,
                     fmt::format("{} asks for the force of joint {}, which no drive moves", user,
                                 joint->name.value));
    }
  }

  /// Of a rope, a mooring or a tugger; of the latter two the tension is known alone.
  void check_output_of_rope(const OutputModel& output, const std::string& user) {
    const Located<std::string>& name = *output.rope;
    const bool is_rope = file_.find_rope(name.value) != nullptr;
    const auto has_name = [&](const auto& line) { return line.name.value == name.value; };
    const bool is_line = std::any_of(file_.moorings.begin(), file_.moorings.end(), has_name) ||
                         std::any_of(file_.tuggers.begin(), file_.tuggers.end(), has_name);
    if (!is_line) return find(file_.ropes, name, user, "rope");
    if (is_rope) {
      reading_.error(name.mark,
                     fmt::format("{} names {}, which is a rope and a mooring or tugger, too", user,
                                 name.value),
                     {"give one of them another name"});
    } else if (output.quantity && output.quantity->value != "tension") {
      reading_.error(output.quantity->mark,
                     fmt::format("{} asks for the {} of {}, a mooring or tugger", user,
                                 output.quantity->value, name.value),
                     {"ask for its tension, or leave quantity out"});
    }
  }

  bool is_driven(const std::string& joint) const {
    return std::any_of(file_.drives.begin(), file_.drives.end(),
                       [&](const DriveModel& drive) { return drive.joint.value == joint; });
  }

  const MechanismFile& file_;
  Reading& reading_;
};

}  // namespace

void check_mechanism_file(const MechanismFile& file, Reading& reading) {
  reading.with_owner("mechanism", [&] {
    MechanismCheck(file, reading).run();
    return true;
  });
}

}  // namespace blocklift::pipeline

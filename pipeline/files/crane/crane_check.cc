#include "pipeline/files/crane/crane_check.h"

#include <algorithm>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/files/crane/crane_pose.h"
#include "pipeline/mechanism/mechanism_parts_check.h"

namespace blocklift::pipeline {
namespace {

void check_hoists(const CraneModel& crane, Reading& reading) {
  for (const HoistModel& hoist : crane.hoists) {
    check_range_ascends(hoist.winch, "the winch of hoist " + hoist.name.value, hoist.name.mark,
                        reading);
    if (!hoist.body.value.empty() && !crane.find_body(hoist.body.value)) {
      reading.error(hoist.body.mark,
                    fmt::format("hoist {} stands on body \"{}\", which the crane does not have",
                                hoist.name.value, hoist.body.value),
                    {names_hint("its bodies are", names_of(crane.bodies), hoist.body.value)});
    }
    if (crane.find_drive(hoist.name.value) || crane.find_body(hoist.name.value)) {
      reading.error(
          hoist.name.mark,
          fmt::format("hoist {} has the name of a {} of this crane; give it another",
                      hoist.name.value, crane.find_drive(hoist.name.value) ? "drive" : "body"));
    }
  }
}

void check_chart(const CraneModel& crane, const HoistModel& hoist, Reading& reading) {
  if (!hoist.load_chart) return;
  const auto& [lines, mark] = *hoist.load_chart;
  if (!crane.radius_from)
    reading.error(mark,
                  fmt::format("hoist {} has a load chart, but the crane says not from where "
                              "its radius counts",
                              hoist.name.value),
                  {"for example radius_from: {body: world, position: [0 m, 0 m, 0 m]}"});
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!(lines[i].radius <= lines[i - 1].radius)) continue;
    reading.error(mark, fmt::format("the radii of hoist {}'s load chart do not ascend: {:g} m "
                                    "comes after {:g} m",
                                    hoist.name.value, lines[i].radius, lines[i - 1].radius));
  }
}

void check_derating_table(const std::optional<Located<std::vector<DeratingLine>>>& table,
                          const char* name, Reading& reading) {
  if (!table) return;
  const std::vector<DeratingLine>& lines = table->value;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!(lines[i].up_to > lines[i - 1].up_to))
      reading.error(table->mark, fmt::format("the {} table of the derating does not ascend: {:g} "
                                             "comes after {:g}",
                                             name, lines[i].up_to, lines[i - 1].up_to));
    if (lines[i].factor > lines[i - 1].factor)
      reading.error(table->mark,
                    fmt::format("the {} table of the derating leaves more, {:g}, at "
                                "{:g} than before, {:g}",
                                name, lines[i].factor, lines[i].up_to, lines[i - 1].factor));
  }
}

void check_derating(const CraneModel& crane, Reading& reading) {
  if (!crane.derating) return;
  const ChartDerating& derating = *crane.derating;
  if (std::none_of(crane.hoists.begin(), crane.hoists.end(),
                   [](const HoistModel& hoist) { return hoist.load_chart.has_value(); }))
    reading.error(derating.place, "derating multiplies load charts, but no hoist has one",
                  {"for example load_chart: [{radius: 20 m, capacity: 60 t}]"});
  if (!derating.wind && !derating.sea)
    reading.error(derating.place, "derating says by nothing: give wind, sea, or both");
  check_derating_table(derating.wind, "wind", reading);
  check_derating_table(derating.sea, "sea", reading);
}

/// Do they span an area, seen from above?
bool are_in_line(const std::vector<CraneSupport>& supports) {
  const Vector3& origin = supports.front().position;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const CraneSupport& support : supports) {
    const Eigen::Vector2d arm = (support.position - origin).head<2>();
    spread += arm * arm.transpose();
  }
  return spread.determinant() <= 1e-12 * spread.trace() * spread.trace();
}

/// What ties the crane to its base beside the body that stands; empty: nothing.
std::string other_tie(const CraneModel& crane, const std::string& body) {
  for (const JointModel& joint : crane.joints)
    if (joint.parent.value == "world" && joint.child.value != body)
      return "joint " + joint.name.value;
  for (const LoopModel& loop : crane.loops) {
    const auto is_base = [](const std::optional<LoopSide>& side) {
      return side && side->body && side->body->value == "world";
    };
    bool tied = is_base(loop.first) || is_base(loop.second);
    if (loop.paths)
      for (const auto& path : loop.paths->value)
        for (const PointModel& point : path) tied = tied || point.body.value == "world";
    if (tied) return "loop " + loop.name.value;
  }
  for (const SpringModel& spring : crane.springs)
    if ((spring.from && spring.from->body.value == "world") ||
        (spring.to && spring.to->body.value == "world"))
      return "spring " + spring.name.value;
  return {};
}

void check_stand(const CraneModel& crane, Reading& reading) {
  if (!crane.stands_on) return;
  const CraneStand& stand = *crane.stands_on;
  const auto joint =
      std::find_if(crane.joints.begin(), crane.joints.end(),
                   [&](const JointModel& one) { return one.child.value == stand.body.value; });
  if (stand.body.value.empty()) {
    // It lacks, or stands_on is no table: the reader has said so.
  } else if (!crane.find_body(stand.body.value)) {
    reading.error(stand.body.mark,
                  fmt::format("the crane has no body \"{}\" to stand on", stand.body.value),
                  {names_hint("its bodies are", names_of(crane.bodies), stand.body.value)});
  } else if (joint == crane.joints.end() || joint->parent.value != "world") {
    reading.error(stand.body.mark, fmt::format("body {} does not stand on the base: its joint has "
                                               "another parent than the world",
                                               stand.body.value));
  } else if (const std::string tie = other_tie(crane, stand.body.value); !tie.empty()) {
    reading.error(stand.body.mark,
                  fmt::format("what body {} presses on cannot be told: {} ties the crane to its "
                              "base, too",
                              stand.body.value, tie),
                  {"leave stands_on out"});
  }
  if (stand.supports.empty() && reading.is_owner_unsound()) return;  // may be unread
  if (stand.supports.size() < 3 || are_in_line(stand.supports))
    reading.error(stand.place, "a crane stands on three supports or more that are not in line",
                  {fmt::format("{} {} given", stand.supports.size(),
                               stand.supports.size() == 1 ? "is" : "are")});
}

void check_radius(const CraneModel& crane, Reading& reading) {
  if (!crane.radius_from) return;
  const Located<std::string>& body = crane.radius_from->body;
  if (body.value == "world" || crane.find_body(body.value)) return;
  reading.error(
      body.mark,
      fmt::format("radius_from names body \"{}\", which the crane does not have", body.value),
      {names_hint("its bodies are", names_of(crane.bodies), body.value)});
}

}  // namespace

void check_crane(const CraneModel& crane, Reading& reading, const Mark& mark) {
  check_parts(crane, reading);
  check_hoists(crane, reading);
  for (const HoistModel& hoist : crane.hoists) check_chart(crane, hoist, reading);
  check_derating(crane, reading);
  check_radius(crane, reading);
  check_stand(crane, reading);
  check_joint_positions(crane, crane.pose, "the pose", reading);
  if (reading.diagnostics().has_errors()) return;
  try {
    put_together(crane);
  } catch (const dynamics::ModelError& error) {
    reading.error(mark, error.what());
  } catch (const dynamics::SimulationError& error) {
    reading.error(crane.loops.front().name.mark, error.what(),
                  {"the key \"pose\" says where joints stand when the crane is put together"});
  }
}

}  // namespace blocklift::pipeline

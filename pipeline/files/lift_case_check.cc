#include "pipeline/files/lift_case_check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "pipeline/files/crane_pose.h"
#include "pipeline/files/operation_schedule.h"
#include "pipeline/files/standard_check.h"

namespace blocklift::pipeline {
namespace {

/// "hull-860t" of "blocks/hull-860t".
std::string short_name(const std::string& model_name) {
  return std::filesystem::path(model_name).stem().string();
}

/// The names that a crane part may have, for a hint.
std::vector<std::string> parts_of(const CraneInCase& crane, bool with_bodies) {
  std::vector<std::string> parts;
  for (const HoistModel& hoist : crane.model->hoists) {
    parts.push_back(crane.name.value + "." + hoist.name.value);
  }
  if (with_bodies) {
    for (const BodyModel& body : crane.model->bodies) {
      parts.push_back(crane.name.value + "." + body.name.value);
    }
  }
  return parts;
}

std::string before_dot(const std::string& name) { return name.substr(0, name.find('.')); }

/// Looks up points: of ropes, and of what operators keep.
class PointResolver {
 public:
  PointResolver(const LiftCase& lift_case, Diagnostics& diagnostics)
      : case_(lift_case), diagnostics_(diagnostics) {}

  /// @param subject what is at that point, for messages: "rope R1 ends at".
  std::optional<ResolvedPoint> resolve(const Located<RopePoint>& point, std::string subject) {
    const RopePoint& p = point.value;
    subject_ = std::move(subject);
    if (p.body) return resolve_body(*p.body, p.point);
    if (p.name.value.empty()) return std::nullopt;
    if (const SpreaderInCase* bar = case_.find_spreader(before_dot(p.name.value)))
      return resolve_eye(p.name, *bar);
    if (p.name.value.find('.') != std::string::npos && !is_lug(p.name.value)) {
      return resolve_part(p.name, false, Vector3::Zero());
    }
    return resolve_lug(p.name);
  }

  /// The upper sheave of a hoist.
  std::optional<ResolvedPoint> resolve_head(const Located<std::string>& hoist,
                                            std::string subject) {
    subject_ = std::move(subject);
    std::optional<ResolvedPoint> head = resolve_part(hoist, false, Vector3::Zero());
    if (!head) return head;
    const HoistModel& model = *case_.cranes[head->crane].model->find_hoist(head->part);
    head->kind = ResolvedPoint::Kind::crane_body;
    head->part = model.body.value;
    head->point = model.sheave;
    return head;
  }

 private:
  std::optional<ResolvedPoint> resolve_body(const Located<std::string>& body,
                                            const Vector3& point) {
    if (body.value.empty()) return std::nullopt;
    ResolvedPoint resolved;
    resolved.point = point;
    if (body.value == "world") return resolved;
    if (body.value == "load") {
      resolved.kind = ResolvedPoint::Kind::load;
      return resolved;
    }
    if (case_.find_vessel(body.value)) {
      resolved.kind = ResolvedPoint::Kind::vessel;
      resolved.part = body.value;
      return resolved;
    }
    if (case_.find_spreader(body.value)) {
      resolved.kind = ResolvedPoint::Kind::spreader;
      resolved.part = body.value;
      return resolved;
    }
    if (body.value.find('.') == std::string::npos) {
      fail_body(body);
      return std::nullopt;
    }
    return resolve_part(body, true, point);
  }

  void fail_body(const Located<std::string>& body) {
    const std::string kinds =
        "a body is \"world\", \"load\", a vessel, a spreader, or crane and body, for example "
        "C1.gantry";
    std::vector<std::string> known = names_of(case_.vessels);
    for (const SpreaderInCase& bar : case_.spreaders) known.push_back(bar.name.value);
    fail(body, fmt::format("{} body \"{}\", which does not exist", subject_, body.value),
         known.empty() ? kinds
                       : names_hint(kinds + "; the vessels and spreaders are", known, body.value));
  }

  std::optional<ResolvedPoint> resolve_eye(const Located<std::string>& name,
                                           const SpreaderInCase& bar) {
    ResolvedPoint resolved;
    resolved.kind = ResolvedPoint::Kind::spreader;
    resolved.part = bar.name.value;
    const std::size_t dot = name.value.find('.');
    const std::optional<Vector3> eye =
        bar.eye(dot == std::string::npos ? std::string() : name.value.substr(dot + 1));
    if (eye) {
      resolved.point = *eye;
      return resolved;
    }
    std::vector<std::string> known;
    for (const std::string& one : spreader_eyes) known.push_back(bar.name.value + "." + one);
    fail(name,
         fmt::format("{} \"{}\", which is no eye of spreader {}", subject_, name.value,
                     bar.name.value),
         names_hint("its eyes are", known, name.value));
    return std::nullopt;
  }

  std::optional<ResolvedPoint> resolve_part(const Located<std::string>& name, bool bodies_too,
                                            const Vector3& point) {
    const std::size_t dot = name.value.find('.');
    const std::string crane_name = name.value.substr(0, dot);
    const std::string part = name.value.substr(dot + 1);
    const CraneInCase* crane = case_.find_crane(crane_name);
    if (!crane) {
      fail(name,
           fmt::format("{} \"{}\", but the case has no crane \"{}\"", subject_, name.value,
                       crane_name),
           names_hint("its cranes are", names_of(case_.cranes), crane_name));
      return std::nullopt;
    }
    if (!crane->model) return std::nullopt;
    ResolvedPoint resolved;
    resolved.crane = static_cast<std::size_t>(crane - case_.cranes.data());
    resolved.part = part;
    resolved.point = point;
    if (crane->model->find_hoist(part)) {
      resolved.kind = ResolvedPoint::Kind::hook;
      return resolved;
    }
    if (bodies_too && crane->model->find_body(part)) {
      resolved.kind = ResolvedPoint::Kind::crane_body;
      return resolved;
    }
    if (crane->model->find_body(part)) {
      fail(name, fmt::format("{} body \"{}\" without saying where", subject_, name.value),
           fmt::format("give the point: {{body: {}, point: [0 m, 0 m, 0 m]}}", name.value));
      return std::nullopt;
    }
    fail(name,
         fmt::format("{} \"{}\", but crane {} has no {} \"{}\"", subject_, name.value, crane_name,
                     bodies_too ? "body or hoist" : "hoist", part),
         names_hint(bodies_too ? "its bodies and hoists are" : "its hoists are",
                    parts_of(*crane, bodies_too), name.value));
    return std::nullopt;
  }

  /// Lugs that are copies have a point in their names, too: L1.mirrored.
  bool is_lug(const std::string& name) const {
    return case_.load.model && case_.load.model->find_lug(name);
  }

  std::optional<ResolvedPoint> resolve_lug(const Located<std::string>& name) {
    if (case_.load.model_name.value.empty()) return resolve_vessel_lug(name);
    if (!case_.load.model) return std::nullopt;
    const LugModel* lug = case_.load.model->find_lug(name.value);
    if (!lug) {
      fail(name,
           fmt::format("{} lug \"{}\", which block {} does not have", subject_, name.value,
                       short_name(case_.load.model_name.value)),
           names_hint("its lugs are", case_.load.model->lug_names(), name.value));
      return std::nullopt;
    }
    ResolvedPoint resolved;
    resolved.kind = ResolvedPoint::Kind::load;
    resolved.lug = name.value;
    resolved.point = lug->pin.value;
    return resolved;
  }

  std::optional<ResolvedPoint> resolve_vessel_lug(const Located<std::string>& name) {
    for (const Named<Vector3>& lug : case_.load.lugs) {
      if (lug.name.value != name.value) continue;
      ResolvedPoint resolved;
      resolved.kind = ResolvedPoint::Kind::load;
      resolved.lug = name.value;
      resolved.point = lug.value;
      return resolved;
    }
    fail(name, fmt::format("{} lug \"{}\", which the load does not have", subject_, name.value),
         names_hint("its lugs are", names_of(case_.load.lugs), name.value));
    return std::nullopt;
  }

  void fail(const Located<std::string>& name, std::string message, std::string hint) {
    diagnostics_.error(name.mark, std::move(message), {std::move(hint)});
  }

  const LiftCase& case_;
  Diagnostics& diagnostics_;
  std::string subject_;
};

bool same_point(const ResolvedPoint& a, const ResolvedPoint& b) {
  return a.kind == b.kind && a.crane == b.crane && a.part == b.part && a.point == b.point;
}

/// Complains about sheaves on the load or a spreader: only the forces of rope ends reach its stress.
void check_sheaves(const RopeInCase& rope, Diagnostics& diagnostics) {
  for (std::size_t i = 1; i + 1 < rope.path.size(); ++i) {
    const bool on_load = rope.path[i].kind == ResolvedPoint::Kind::load;
    if (!on_load && rope.path[i].kind != ResolvedPoint::Kind::spreader) continue;
    diagnostics.error(
        rope.through[i - 1].mark,
        fmt::format("rope {} runs over a sheave on {}, whose force on the {} would be "
                    "missing from its stress",
                    rope.name.value, on_load ? "the load" : "spreader " + rope.path[i].part,
                    on_load ? "block" : "bar"),
        {on_load ? "ropes begin or end at lugs; sheaves stand on cranes, hooks or the world"
                 : "ropes begin or end at the eyes of a spreader"});
  }
}

/// Slings from one hook to both ends of a bar must reach around it.
void check_reach(const LiftCase& lift_case, const SpreaderInCase& bar, Diagnostics& diagnostics) {
  for (const RopeInCase& one : lift_case.ropes) {
    if (!one.ends_at_spreader(bar.name.value)) continue;
    for (const RopeInCase& other : lift_case.ropes) {
      if (&other <= &one || !other.ends_at_spreader(bar.name.value)) continue;
      const double apart = (one.path.back().point - other.path.back().point).norm();
      if (!same_point(one.path.front(), other.path.front()) ||
          one.length.value + other.length.value > apart)
        continue;
      diagnostics.error(
          one.length.mark,
          fmt::format("slings {} and {} are too short: {:g} m and {:g} m from one point do not "
                      "reach the eyes of spreader {}, which are {:g} m apart",
                      one.name.value, other.name.value, one.length.value, other.length.value,
                      bar.name.value, apart));
    }
  }
}

void check_spreaders(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const SpreaderInCase& bar : lift_case.spreaders) {
    int above = 0, below = 0;
    bool all_known = true;
    for (const RopeInCase& rope : lift_case.ropes) {
      all_known &= !rope.path.empty();
      if (rope.path.empty()) continue;
      above += int{rope.ends_at_spreader(bar.name.value)};
      const ResolvedPoint& first = rope.path.front();
      below += int{first.kind == ResolvedPoint::Kind::spreader && first.part == bar.name.value};
    }
    if (all_known && (above == 0 || below == 0))
      diagnostics.error(bar.name.mark,
                        fmt::format("no sling {} spreader {}", above == 0 ? "ends at" : "begins at",
                                    bar.name.value),
                        {fmt::format("slings from above end at {0}.upper_a and {0}.upper_b, those "
                                     "to the load begin at {0}.lower_a and {0}.lower_b",
                                     bar.name.value)});
    check_reach(lift_case, bar, diagnostics);
  }
}

void check_bend(const RopeInCase& rope, Diagnostics& diagnostics) {
  if (!rope.bend_diameter) return;
  const auto& [bend, mark] = *rope.bend_diameter;
  if (!rope.rope.diameter) {
    // A model that could not be read has been complained of.
    if (std::isfinite(rope.rope.axial_stiffness))
      diagnostics.error(mark,
                        fmt::format("the model of rope {} has no diameter, which its bend diameter "
                                    "is held against",
                                    rope.name.value),
                        {"add diameter to the rope's model"});
  } else if (bend < *rope.rope.diameter) {
    diagnostics.error(mark,
                      fmt::format("rope {} of {} is bent round {}", rope.name.value,
                                  format_quantity(*rope.rope.diameter, Dimension::length),
                                  format_quantity(bend, Dimension::length)),
                      {"a rope is not bent round less than its own diameter"});
  }
}

void check_ropes(const LiftCase& lift_case, Diagnostics& diagnostics) {
  bool all_known = true;
  bool load_hangs = false;
  for (const RopeInCase& rope : lift_case.ropes) {
    all_known &= !rope.path.empty();
    check_sheaves(rope, diagnostics);
    check_bend(rope, diagnostics);
    for (std::size_t i = 0; i < rope.path.size(); ++i) {
      load_hangs |= rope.path[i].kind == ResolvedPoint::Kind::load;
      if (i > 0 && same_point(rope.path[i - 1], rope.path[i])) {
        diagnostics.error(rope.name.mark,
                          fmt::format("rope {} runs from a point to itself", rope.name.value));
      }
    }
    if (rope.winch && rope.winch->range[0].value >= rope.winch->range[1].value) {
      diagnostics.error(
          rope.name.mark,
          fmt::format("the range of the winch of rope {} does not ascend", rope.name.value));
    }
  }
  if (all_known && !lift_case.ropes.empty() && !load_hangs) {
    diagnostics.error(lift_case.load.vessel_name ? lift_case.load.vessel_name->mark
                                                 : lift_case.load.model_name.mark,
                      "no rope holds the load", {"a rope that ends at one of its lugs does"});
  }
}

/// Start values of one crane: each drive and hoist has one, of its kind and within its range.
void check_start(const CraneInCase& crane, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  const auto check_one = [&](const std::string& part, const char* noun, const char* example,
                             const DriveLimits& limits) {
    known.push_back(part);
    const Located<Quantity>* start = crane.find_start(part);
    if (!start) {
      diagnostics.error(
          crane.name.mark,
          fmt::format("crane {} gives no start for its {} {}", crane.name.value, noun, part),
          {fmt::format("add {}: {} to its start", part, example)});
      return;
    }
    const Quantity& low = limits.range[0];
    const Quantity& high = limits.range[1];
    if (!std::isfinite(start->value.value) || !std::isfinite(low.value) ||
        !std::isfinite(high.value)) {
      return;
    }
    if (start->value.dimension != low.dimension) {
      diagnostics.error(
          start->mark,
          fmt::format("the start of {} {}.{} is {}; {} is due", noun, crane.name.value, part,
                      text_of(start->value.dimension).noun, text_of(low.dimension).noun));
    } else if (start->value.value < low.value || start->value.value > high.value) {
      diagnostics.error(
          start->mark,
          fmt::format("{} {}.{} starts at {}, outside its range", noun, crane.name.value, part,
                      format_quantity(start->value.value, low.dimension)),
          {fmt::format("its range is {} to {}", format_quantity(low.value, low.dimension),
                       format_quantity(high.value, high.dimension))});
    }
  };
  for (const DriveModel& drive : crane.model->drives) {
    check_one(drive.name.value, "drive", "0 m", drive);
  }
  for (const HoistModel& hoist : crane.model->hoists) {
    check_one(hoist.name.value, "hoist", "30 m", hoist.winch);
  }
  for (const auto& start : crane.start) {
    if (std::find(known.begin(), known.end(), start.name.value) != known.end()) continue;
    diagnostics.error(
        start.name.mark,
        fmt::format("crane {} has no drive or hoist \"{}\"", crane.name.value, start.name.value),
        {names_hint("its drives and hoists are", known, start.name.value)});
  }
}

/// Two hoists of one kind of rope can be reeved with one.
void check_equalised(const CraneInCase& crane, Diagnostics& diagnostics) {
  if (!crane.equalised) return;
  std::array<const HoistModel*, 2> hoists{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Located<std::string>& name = crane.equalised->value[i];
    hoists[i] = crane.model->find_hoist(name.value);
    if (hoists[i]) continue;
    diagnostics.error(name.mark,
                      fmt::format("crane {} has no hoist \"{}\"", crane.name.value, name.value),
                      {names_hint("its hoists are", names_of(crane.model->hoists), name.value)});
  }
  if (!hoists[0] || !hoists[1]) return;
  if (hoists[0] == hoists[1]) {
    diagnostics.error(crane.equalised->mark,
                      fmt::format("hoist {}.{} cannot be equalised with itself", crane.name.value,
                                  hoists[0]->name.value),
                      {"two hoists are due: equalised: [left, right]"});
    return;
  }
  const RopeModel &a = hoists[0]->rope, &b = hoists[1]->rope;
  if (a.axial_stiffness != b.axial_stiffness || a.breaking_load != b.breaking_load ||
      a.damping_time != b.damping_time) {
    diagnostics.error(
        crane.equalised->mark,
        fmt::format("hoists {} and {} of crane {} have different tackles", hoists[0]->name.value,
                    hoists[1]->name.value, crane.name.value),
        {"one rope runs through both where they are equalised, so both name the same rope"});
  }
}

void check_names(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const CraneInCase& crane : lift_case.cranes) {
    if (crane.name.value == "world" || crane.name.value == "load") {
      diagnostics.error(crane.name.mark,
                        fmt::format("a crane cannot be named \"{}\"", crane.name.value));
    }
    if (lift_case.find_vessel(crane.name.value)) {
      diagnostics.error(crane.name.mark, fmt::format("a crane and a vessel are both named \"{}\"",
                                                     crane.name.value));
    }
    if (crane.base && !crane.base->value.empty() && !lift_case.find_vessel(crane.base->value)) {
      diagnostics.error(
          crane.base->mark,
          fmt::format("crane {} stands on vessel \"{}\", which the case does not have",
                      crane.name.value, crane.base->value),
          {names_hint("its vessels are", names_of(lift_case.vessels), crane.base->value)});
    }
  }
}

void check_spreader_names(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const SpreaderInCase& bar : lift_case.spreaders) {
    const std::string& name = bar.name.value;
    if (name == "world" || name == "load")
      diagnostics.error(bar.name.mark, fmt::format("a spreader cannot be named \"{}\"", name));
    const char* other = lift_case.find_crane(name)    ? "crane"
                        : lift_case.find_vessel(name) ? "vessel"
                                                      : nullptr;
    if (other)
      diagnostics.error(bar.name.mark,
                        fmt::format("a spreader and a {} are both named \"{}\"", other, name));
  }
}

void check_comparison(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (!lift_case.compare) return;
  std::vector<std::string> known = names_of(lift_case.ropes);
  const bool by_lug = lift_case.load_table.has_value();
  if (by_lug) known = names_of(lift_case.load_table->static_loads);
  const auto check = [&](const Located<std::string>& name) {
    if (std::find(known.begin(), known.end(), name.value) != known.end()) return;
    diagnostics.error(name.mark,
                      fmt::format("compare names {} \"{}\", which the case does not have",
                                  by_lug ? "lug" : "rope", name.value),
                      {names_hint(by_lug ? "the lugs of its load table are" : "its ropes are",
                                  known, name.value)});
  };
  for (const auto& loads : lift_case.compare->ropes) check(loads.name);
  for (const auto& series : lift_case.compare->series) check(series.name);
  if (by_lug && !lift_case.compare->series.empty()) {
    diagnostics.error(lift_case.compare->series.front().name.mark,
                      "a load table has no history that a measured series could be drawn over");
  }
}

/// Every lug that the table names exists; static, dynamic and direction name the same ones.
void check_load_table(const LiftCase& lift_case, const LoadTable& table, Diagnostics& diagnostics) {
  const auto check_exists = [&](const Located<std::string>& lug) {
    if (!lift_case.load.model || lift_case.load.model->find_lug(lug.value)) return true;
    diagnostics.error(lug.mark,
                      fmt::format("the load table names lug \"{}\", which block {} does not have",
                                  lug.value, short_name(lift_case.load.model_name.value)),
                      {names_hint("its lugs are", lift_case.load.model->lug_names(), lug.value)});
    return false;
  };
  const auto check_listed = [&](const Located<std::string>& lug, const auto& list,
                                const char* list_name) {
    for (const auto& entry : list) {
      if (entry.name.value == lug.value) return;
    }
    diagnostics.error(lug.mark, fmt::format("lug {} is missing under {} of the load table",
                                            lug.value, list_name));
  };
  if (table.static_loads.empty()) diagnostics.error(table.place, "the load table names no lug");
  for (const auto& load : table.static_loads) {
    if (!check_exists(load.name)) continue;
    check_listed(load.name, table.dynamic_loads, "dynamic");
    if (const auto* each = std::get_if<std::vector<Named<Vector3>>>(&table.direction)) {
      check_listed(load.name, *each, "direction");
    }
  }
  for (const auto& load : table.dynamic_loads) {
    if (check_exists(load.name)) check_listed(load.name, table.static_loads, "static");
  }
}

/// A case has cranes, ropes and an operation, or a load table; complains about what is missing or
/// too much.
void check_kind_of_case(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (lift_case.load_table) {
    const auto refuse = [&](bool given, const char* key) {
      if (!given) return;
      diagnostics.error(lift_case.load_table->place,
                        fmt::format("the case has a load table and {}", key),
                        {"a load table stands in place of cranes, ropes, supports, wind and "
                         "operation"});
    };
    refuse(!lift_case.cranes.empty(), "cranes");
    refuse(!lift_case.ropes.empty(), "ropes");
    refuse(!lift_case.spreaders.empty(), "spreaders");
    refuse(!lift_case.supports.empty(), "supports");
    refuse(lift_case.ground_contact.has_value(), "ground_contact");
    refuse(lift_case.wind.has_value(), "wind");
    refuse(lift_case.sea.has_value(), "a sea");
    refuse(lift_case.load.vessel_name.has_value(), "a vessel as the load");
    refuse(!lift_case.operation.empty(), "an operation");
    refuse(lift_case.dynamics.flexibility != Flexibility::rigid, "a flexible block");
    return;
  }
  const auto require = [&](bool missing, const char* key) {
    if (!missing) return;
    diagnostics.error(lift_case.place, fmt::format("the lift case lacks the key \"{}\"", key),
                      {"a case has cranes, ropes and operation, or a load_table"});
  };
  require(lift_case.cranes.empty() && lift_case.ropes.empty(), "cranes");
  require(lift_case.ropes.empty(), "ropes");
  require(lift_case.operation.empty(), "operation");
}

/// The operation takes time, and no more samples of it are asked for than a machine holds.
void check_duration(const LiftCase& lift_case, const Schedule& schedule, Diagnostics& diagnostics) {
  constexpr double most_samples = 5e5;  // some 10 kB each
  if (lift_case.operation.empty() || diagnostics.has_errors()) return;
  if (!(schedule.duration > 0)) {
    diagnostics.error(lift_case.operation.front().name.mark, "the operation takes no time",
                      {"give it a move, a pause or a settle time"});
    return;
  }
  const auto check = [&](const char* key, double interval) {
    if (schedule.duration <= most_samples * interval) return;
    diagnostics.error(
        lift_case.operation.front().name.mark,
        fmt::format("the operation lasts {:.6g} s, with a sample every {:g} s ({})",
                    schedule.duration, interval, key),
        {fmt::format("at most {:.0f} samples are recorded; shorten the pauses or lengthen the "
                     "interval",
                     most_samples)});
  };
  check("sample_interval", lift_case.dynamics.sample_interval);
  check("static_interval", lift_case.dynamics.static_interval);
}

/// Faults name what is there, once, while the operation lasts.
class FaultCheck {
 public:
  FaultCheck(const LiftCase& lift_case, const Schedule& schedule, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), duration_(schedule.duration) {
    for (const RopeInCase& rope : lift_case.ropes) ropes_.push_back(rope.name.value);
    for (const CraneInCase& crane : lift_case.cranes) {
      if (!crane.model) continue;
      for (const HoistModel& hoist : crane.model->hoists)
        ropes_.push_back(crane.name.value + "." + hoist.name.value);
    }
    for (const Mover& mover : schedule.movers) {
      drives_.push_back(mover.name);
      if (mover.is_winch) winches_.push_back(mover.name);
    }
    drives_.emplace_back("all");
  }

  void check(const FaultInCase& fault) {
    if (fault.parts.empty() && fault.stops.empty() && fault.runs_away.empty())
      diagnostics_.error(fault.place, "the fault says not what goes wrong",
                         {"give parts, ropes that break, stops, drives that come to a stand, or "
                          "runs_away, winches that pay out"});
    check_instant(fault);
    for (const Located<std::string>& rope : fault.parts)
      check_name(rope, ropes_, "parts", "its ropes and hoists are", parted_);
    for (const Located<std::string>& drive : fault.stops)
      check_name(drive, drives_, "stops", "its drives and winches are", stopped_);
    for (const Located<std::string>& winch : fault.runs_away)
      check_name(winch, winches_, "runs away with", "its winches are", stopped_);
    const bool told = fault.speed && fault.caught_after;
    const bool nothing_told = !fault.speed && !fault.caught_after;
    if (fault.runs_away.empty() ? !nothing_told : !told)
      diagnostics_.error(fault.place,
                         fault.runs_away.empty()
                             ? "the fault has a speed or caught_after, and no winch that runs away"
                             : "a winch runs away, and the fault lacks its speed or caught_after",
                         {"for example: {at: 60 s, runs_away: [C1.main], speed: 20 m/min, "
                          "caught_after: 2 s}"});
  }

 private:
  void check_instant(const FaultInCase& fault) {
    const bool sought = !fault.worst_for.empty();
    if (fault.at.has_value() == sought)
      diagnostics_.error(fault.place,
                         sought ? "the fault has both an instant and worst_for"
                                : "the fault does not say when it comes",
                         {"give at, an instant, or worst_for: [all], the worst one"});
    if (!sought && (fault.from || fault.to))
      diagnostics_.error(fault.place, "from and to go with worst_for, which is not there");
    if (fault.from && fault.to && !(fault.from->value < fault.to->value))
      diagnostics_.error(fault.to->mark, "the worst instant is sought until before it is sought");
    for (const auto& at : {fault.at, fault.from}) {
      if (duration_ > 0 && at && at->value > duration_)
        diagnostics_.error(
            at->mark,
            fmt::format("the fault comes at {:g} s, after the end of the operation", at->value),
            {fmt::format("the operation lasts {:g} s", duration_)});
    }
    if (!sought) return;
    if (any_sought_)
      diagnostics_.error(fault.worst_for.front().mark,
                         "the worst instant is sought for one fault at a time",
                         {"give the other its instant (at), or a case of its own"});
    any_sought_ = true;
    std::vector<std::string> known = ropes_;
    known.emplace_back("all");
    std::set<std::string> before;
    for (const Located<std::string>& rope : fault.worst_for)
      check_name(rope, known, "is worst for", "its ropes and hoists are", before);
  }

  void check_name(const Located<std::string>& name, const std::vector<std::string>& known,
                  const char* verb, const char* hint, std::set<std::string>& before) {
    if (std::find(known.begin(), known.end(), name.value) == known.end()) {
      diagnostics_.error(
          name.mark,
          fmt::format("the fault {} \"{}\", which the case does not have", verb, name.value),
          {names_hint(hint, known, name.value)});
    } else if (!before.insert(name.value).second || (before.contains("all") && before.size() > 1)) {
      diagnostics_.error(name.mark, fmt::format("\"{}\" {} twice", name.value, verb));
    }
  }

  Diagnostics& diagnostics_;
  double duration_;
  std::vector<std::string> ropes_, drives_, winches_;
  std::set<std::string> parted_, stopped_;
  bool any_sought_ = false;
};

/// Ropes, and hoists whose tackles count as ropes; nothing if a crane could not be read.
std::vector<std::string> names_of_ropes(const LiftCase& lift_case) {
  std::vector<std::string> ropes;
  for (const RopeInCase& rope : lift_case.ropes) ropes.push_back(rope.name.value);
  for (const CraneInCase& crane : lift_case.cranes) {
    if (!crane.model) return {};
    for (const HoistModel& hoist : crane.model->hoists)
      ropes.push_back(crane.name.value + "." + hoist.name.value);
  }
  return ropes;
}

/// What operators keep is kept by drives that can: winches heights and pulls, joints a plumb.
void check_keeping(const LiftCase& lift_case, const Schedule& schedule, Diagnostics& diagnostics) {
  const std::vector<std::string> ropes = names_of_ropes(lift_case);
  if (ropes.empty()) return;
  for (const ScheduledSteering& steering : schedule.steerings) {
    const KeepInCase& keep = steering.keep;
    const Mover& mover = schedule.movers[steering.mover];
    if (mover.is_winch == keep.over.has_value())
      diagnostics.error(
          steering.mark,
          mover.is_winch ? fmt::format("{} is a winch and keeps no head over a point", mover.name)
                         : fmt::format("{} is no winch and keeps no height or pull", mover.name),
          {"winches keep level, tension or share; drives of joints keep a head over "
           "a point"});
    if (!mover.is_winch && keep.head && before_dot(keep.head->value) != before_dot(mover.name))
      diagnostics.error(keep.head->mark,
                        fmt::format("{} is on crane {}, and {} does not move it", keep.head->value,
                                    before_dot(keep.head->value), mover.name));
    for (const Located<std::string>& rope : keep.of) {
      if (std::find(ropes.begin(), ropes.end(), rope.value) == ropes.end())
        diagnostics.error(
            rope.mark,
            fmt::format("a share is kept of \"{}\", which is no rope or hoist of the case",
                        rope.value),
            {names_hint("its ropes and hoists are", ropes, rope.value)});
      if (rope.value == mover.name)
        diagnostics.error(rope.mark, fmt::format("{} shares with itself", rope.value),
                          {"of: names the others"});
    }
  }
}

/// Conditions that end stages name ropes that are there, and ground that bears.
void check_conditions(const LiftCase& lift_case, Diagnostics& diagnostics) {
  const std::vector<std::string> ropes = names_of_ropes(lift_case);
  if (ropes.empty()) return;
  for (const StageInCase& stage : lift_case.operation) {
    if (!stage.until) continue;
    for (const auto& rope : {stage.until->slack, stage.until->taut}) {
      if (!rope || std::find(ropes.begin(), ropes.end(), rope->value) != ropes.end()) continue;
      diagnostics.error(rope->mark,
                        fmt::format("stage \"{}\" waits for \"{}\", which is no rope or hoist of "
                                    "the case",
                                    stage.name.value, rope->value),
                        {names_hint("its ropes and hoists are", ropes, rope->value)});
    }
    if (stage.until->ground_at_least && lift_case.supports.empty() && !lift_case.ground_contact)
      diagnostics.error(stage.until->ground_at_least->mark,
                        fmt::format("stage \"{}\" waits for the ground to bear, and nothing is "
                                    "there that would",
                                    stage.name.value),
                        {"give supports, or ground_contact"});
  }
}

/// Ground that bears has a height, and names of its corners are its own.
void check_ground(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (!lift_case.ground_contact) return;
  if (!lift_case.ground_height())
    diagnostics.error(lift_case.ground_contact->place,
                      "the ground bears the load, and its height is not known",
                      {"give ground: the height of a quay or of a dock's floor"});
  for (const SupportInCase& support : lift_case.supports)
    if (support.name.value.starts_with("ground_"))
      diagnostics.error(support.name.mark,
                        fmt::format("\"{}\" is the name of a corner of the load on the ground",
                                    support.name.value),
                        {"names that begin with ground_ are those of ground_contact"});
}

/// Ropes that hang by their weight have some, and end at bodies that do not give way.
void check_rope_weight(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (!lift_case.rope_weight || !lift_case.rope_weight->value) return;
  const Mark& mark = lift_case.rope_weight->mark;
  if (lift_case.dynamics.flexibility != Flexibility::rigid)
    diagnostics.error(mark, "ropes hang by their weight, and the block is flexible",
                      {"ropes to a block that gives way run straight: leave one of the two out"});
  bool any = false;
  for (const RopeInCase& rope : lift_case.ropes) any = any || lift_case.hangs(rope);
  for (const CraneInCase& crane : lift_case.cranes) {
    if (!crane.model) return;
    for (const HoistModel& hoist : crane.model->hoists) any = any || lift_case.hangs(crane, hoist);
  }
  if (!any)
    diagnostics.error(mark, "no rope has a mass by which it would hang",
                      {"add mass to the models of slings and tackles that run from point to "
                       "point"});
}

/// The keys of the natural modes, which one kind of flexibility alone reads.
void check_flexibility(const DynamicsSettings& dynamics, Diagnostics& diagnostics) {
  if (dynamics.flexibility == Flexibility::modal) return;
  const auto refuse = [&](const auto& key, const char* name) {
    if (!key) return;
    diagnostics.error(key->mark,
                      fmt::format("{} is given, and the block has no natural modes", name),
                      {"they are those of flexibility: modal"});
  };
  refuse(dynamics.elastic_modes, "elastic_modes");
  refuse(dynamics.modal_damping, "modal_damping");
}

/// A ship that is given as a block and as a vessel is one.
void check_weights(const LoadInCase& load, Diagnostics& diagnostics) {
  if (!load.model || !load.vessel || !load.model->mass) return;
  constexpr double allowed = 0.01;
  const double of_block = load.model->mass->value, of_vessel = load.vessel->model.mass;
  if (std::abs(of_block - of_vessel) <= allowed * of_vessel) return;
  diagnostics.error(
      load.vessel_name->mark,
      fmt::format("block {} weighs {}, and vessel {}, whose hull bears it, {}",
                  short_name(load.model_name.value), format_quantity(of_block, Dimension::mass),
                  short_name(load.vessel_name->value), format_quantity(of_vessel, Dimension::mass)),
      {"they are one ship: the block's mass moves, the vessel's must agree with it to 1 %"});
}

/// The draughts of a load that makes waves.
void check_draughts(const LiftCase& lift_case, Diagnostics& diagnostics) {
  const LoadInCase& load = lift_case.load;
  if (!load.draughts || !load.vessel) return;
  check_draughts("the load", *load.draughts, *load.vessel, diagnostics);
  for (const VesselInCase& vessel : lift_case.vessels) {
    if (vessel.draughts) {
      diagnostics.error(load.draughts->mark,
                        fmt::format("the load has draughts, as vessel {} has", vessel.name.value),
                        {"one body may be lowered into the water that they share"});
    }
    if (vessel.drift.value != DriftMethod::none && !vessel.database) {
      diagnostics.error(
          vessel.drift.mark,
          fmt::format("vessel {} drifts, and shares its water with the load, which has draughts",
                      vessel.name.value),
          {"the waves far away tell the drift of both together only: leave out one of the two"});
    }
    if (vessel.radiation.value == RadiationMethod::direct) {
      diagnostics.error(
          load.draughts->mark,
          fmt::format("the load has draughts, and the radiation of vessel {} is direct",
                      vessel.name.value),
          {"a surface that is marched has hulls of one draught: give the vessels "
           "radiation: database, or leave the load's draughts out"});
    }
  }
}

/// Vessels, sea and lines, and the lugs and the water of a load that is a vessel.
void check_afloat(const LiftCase& lift_case, Diagnostics& diagnostics) {
  std::vector<std::string> bodies = {"load"};
  for (const CraneInCase& crane : lift_case.cranes) {
    if (!crane.model) continue;
    for (const std::string& part : parts_of(crane, true)) bodies.push_back(part);
  }
  check_marine_parts(lift_case, lift_case.gravity, bodies, diagnostics);
  if (lift_case.load.vessel_name && lift_case.load.model_name.value.empty() &&
      lift_case.dynamics.flexibility != Flexibility::rigid) {
    diagnostics.error(lift_case.load.vessel_name->mark,
                      "the load is a vessel, whose structure is not known; it cannot be flexible",
                      {"leave flexibility out, or give a block as the load"});
  }
  if (lift_case.load.vessel_name && !lift_case.sea) {
    diagnostics.error(lift_case.load.vessel_name->mark, "the load is a vessel, and there is no sea",
                      {"add sea: {} for calm deep sea water"});
  }
  check_weights(lift_case.load, diagnostics);
  check_draughts(lift_case, diagnostics);
  if (diagnostics.has_errors()) return;
  std::vector<PlacedHull> hulls = place_hulls(lift_case);
  if (lift_case.load.draughts) {
    std::vector<PlacedHull> afloat = hulls;
    afloat.push_back({"the load in the water", lift_case.load.draughts->mark,
                      &lift_case.load.vessel->hull, lift_case.load.pose_afloat()});
    check_hulls_apart(afloat, diagnostics);
    if (diagnostics.has_errors()) return;
  }
  if (lift_case.load.vessel) {
    hulls.push_back({"the load",
                     lift_case.load.vessel_name->mark,
                     &lift_case.load.vessel->hull,
                     {rotation_of(lift_case.load.attitude), lift_case.load.position}});
  }
  check_hulls_apart(hulls, diagnostics);
}

}  // namespace

void resolve_points(LiftCase& lift_case, Diagnostics& diagnostics) {
  PointResolver resolver(lift_case, diagnostics);
  for (RopeInCase& rope : lift_case.ropes) {
    std::vector<std::optional<ResolvedPoint>> points;
    const std::string name = "rope " + rope.name.value;
    points.push_back(resolver.resolve(rope.from, name + " begins at"));
    for (const auto& sheave : rope.through) {
      points.push_back(resolver.resolve(sheave, name + " runs over"));
    }
    points.push_back(resolver.resolve(rope.to, name + " ends at"));
    if (!std::all_of(points.begin(), points.end(), [](const auto& p) { return p.has_value(); })) {
      continue;
    }
    for (auto& point : points) rope.path.push_back(std::move(*point));
  }
  for (StageInCase& stage : lift_case.operation) {
    for (MoveInCase& move : stage.moves) {
      if (!move.keeps) continue;
      KeepInCase& keep = *move.keeps;
      const std::string subject = fmt::format("stage \"{}\" keeps", stage.name.value);
      if (keep.level) keep.level_at = resolver.resolve(*keep.level, subject + " the height of");
      if (keep.with) keep.with_at = resolver.resolve(*keep.with, subject + " level with");
      if (keep.over) keep.over_at = resolver.resolve(*keep.over, subject + " a head over");
      if (keep.head) keep.head_at = resolver.resolve_head(*keep.head, subject + " the head of");
    }
  }
}

void check_lift_case(const LiftCase& lift_case, Diagnostics& diagnostics) {
  check_kind_of_case(lift_case, diagnostics);
  check_names(lift_case, diagnostics);
  check_spreader_names(lift_case, diagnostics);
  for (const CraneInCase& crane : lift_case.cranes) {
    if (!crane.model || lift_case.load_table) continue;
    check_start(crane, diagnostics);
    check_equalised(crane, diagnostics);
  }
  check_ropes(lift_case, diagnostics);
  check_spreaders(lift_case, diagnostics);
  check_afloat(lift_case, diagnostics);
  check_ground(lift_case, diagnostics);
  check_conditions(lift_case, diagnostics);
  check_flexibility(lift_case.dynamics, diagnostics);
  check_rope_weight(lift_case, diagnostics);
  check_comparison(lift_case, diagnostics);
  if (lift_case.load_table) check_load_table(lift_case, *lift_case.load_table, diagnostics);
  check_standard(lift_case, diagnostics);
  const Schedule schedule = schedule_operation(lift_case, diagnostics);
  check_duration(lift_case, schedule, diagnostics);
  check_keeping(lift_case, schedule, diagnostics);
  FaultCheck faults(lift_case, schedule, diagnostics);
  for (const FaultInCase& fault : lift_case.faults) faults.check(fault);
}

void check_loops_at_start(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const CraneInCase& crane : lift_case.cranes) {
    if (crane.model->loops.empty()) continue;
    try {
      pose_at_start(crane);
    } catch (const dynamics::SimulationError& error) {
      const Mark mark = crane.start.empty() ? crane.name.mark : crane.start.front().name.mark;
      diagnostics.error(mark, error.what());
    }
  }
}

}  // namespace blocklift::pipeline

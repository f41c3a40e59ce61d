#include "pipeline/files/lift_case/rope_points.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipeline/files/lift_case/case_names.h"

namespace blocklift::pipeline {
namespace {

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
    if (const given::Spreader* bar = case_.find_spreader(before_dot(p.name.value)))
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
    std::vector<std::string> known = {"world", "load"};
    for (const std::string& vessel : names_of(case_.vessels)) known.push_back(vessel);
    for (const given::Spreader& bar : case_.spreaders) known.push_back(bar.name.value);
    fail(body, fmt::format("{} body \"{}\", which does not exist", subject_, body.value),
         names_hint("a body is crane and body, for example C1.gantry, or one of", known,
                    body.value));
  }

  std::optional<ResolvedPoint> resolve_eye(const Located<std::string>& name,
                                           const given::Spreader& bar) {
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
    for (const std::string& one : bar.eye_names()) known.push_back(bar.name.value + "." + one);
    const bool is_of_a_frame =
        !bar.is_frame() && std::string_view("1234").find(name.value.back()) != std::string::npos;
    fail(name,
         fmt::format("{} \"{}\", which is no eye of spreader {}", subject_, name.value,
                     bar.name.value),
         is_of_a_frame ? fmt::format("numbered eyes are those of a frame, which has a width; the "
                                     "eyes of a bar are {}",
                                     fmt::join(known, ", "))
                       : names_hint("its eyes are", known, name.value));
    return std::nullopt;
  }

  std::optional<ResolvedPoint> resolve_part(const Located<std::string>& name, bool bodies_too,
                                            const Vector3& point) {
    const std::size_t dot = name.value.find('.');
    const std::string crane_name = name.value.substr(0, dot);
    const std::string part = name.value.substr(dot + 1);
    const given::Crane* crane = case_.find_crane(crane_name);
    if (!crane) {
      if (case_.cranes.empty() && diagnostics_.has_errors()) return std::nullopt;  // told
      std::vector<std::string> known = names_of(case_.cranes);
      for (const given::Spreader& bar : case_.spreaders) known.push_back(bar.name.value);
      const bool has_bars = !case_.spreaders.empty();
      fail(name,
           fmt::format("{} \"{}\", but the case has no crane {}\"{}\"", subject_, name.value,
                       has_bars ? "or spreader " : "", crane_name),
           names_hint(has_bars ? "its cranes and spreaders are" : "its cranes are", known,
                      crane_name));
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
    const HoistModel* hoist = crane->model->find_hoist(before_dot(part));
    if (hoist && !bodies_too) return resolve_horn(name, *hoist, std::move(resolved));
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

  /// @param resolved with its crane.
  std::optional<ResolvedPoint> resolve_horn(const Located<std::string>& name,
                                            const HoistModel& hoist, ResolvedPoint resolved) {
    const std::size_t dot = name.value.rfind('.');
    const std::string hook = name.value.substr(0, dot);
    const auto& turning = hoist.hook_block.turning;
    if (!turning || turning->horns == 0) {
      fail(name, fmt::format("{} \"{}\", but hook {} has no horns", subject_, name.value, hook),
           fmt::format("it has some with turning: {{horns: 0.4 m, ...}} in the hook_block of the "
                       "crane's model; without them slings begin at {}",
                       hook));
      return std::nullopt;
    }
    const std::optional<Vector3> place = turning->horn(name.value.substr(dot + 1));
    if (!place) {
      fail(name, fmt::format("{} \"{}\", which is no horn of hook {}", subject_, name.value, hook),
           names_hint("its horns are", {hook + ".a", hook + ".b"}, name.value));
      return std::nullopt;
    }
    resolved.kind = ResolvedPoint::Kind::hook;
    resolved.part = hoist.name.value;
    resolved.point = *place;
    return resolved;
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
    // A load that could not be read, or is missing, was complained of.
    if (!case_.load.vessel_name && diagnostics_.has_errors()) return std::nullopt;
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

/// Looks up the edges that a rope may touch.
void resolve_edges(const LiftCase& lift_case, given::Rope& rope, Diagnostics& diagnostics) {
  const given::Load& load = lift_case.load;
  if (!load.model && !load.model_name.value.empty()) return;  // it could not be read
  const std::vector<LoadEdge>& known = load.all_edges();
  bool all_found = true;
  for (const EdgeOnTheWay& passage : rope.over) {
    if (passage.edge.value.empty()) {
      all_found = false;
      continue;
    }
    if (const LoadEdge* edge = find_by_name(known, passage.edge.value)) {
      rope.edges.push_back(*edge);
      continue;
    }
    all_found = false;
    const std::string owner =
        load.model ? "block " + short_name(load.model_name.value) : std::string("the load");
    diagnostics.error(
        passage.edge.mark,
        fmt::format("rope {} runs over edge \"{}\", which {} does not have", rope.name.value,
                    passage.edge.value, owner),
        {known.empty()
             ? load.model
                   ? "it has no edges: declare them in its model file, edges: {coaming: {from: "
                     "[...], to: [...], outside: [...]}}"
                   : "it has no edges: declare them in the case, load: {edges: {...}}"
             : names_hint("its edges are", names_of(known), passage.edge.value)});
  }
  if (!all_found) rope.edges.clear();
}

/// Points of what an operator keeps, or of what a law sees.
template <class Keeping>
void resolve_seen(PointResolver& resolver, const std::string& subject, Keeping& keep) {
  if (keep.level) keep.level_at = resolver.resolve(*keep.level, subject + " the height of");
  if (keep.with) keep.with_at = resolver.resolve(*keep.with, subject + " level with");
  if (keep.over) keep.over_at = resolver.resolve(*keep.over, subject + " a head over");
  if (keep.head) keep.head_at = resolver.resolve_head(*keep.head, subject + " the head of");
}

}  // namespace

void resolve_points(LiftCase& lift_case, Diagnostics& diagnostics) {
  PointResolver resolver(lift_case, diagnostics);
  for (given::Rope& rope : lift_case.ropes) {
    std::vector<std::optional<ResolvedPoint>> points;
    const std::string name = "rope " + rope.name.value;
    points.push_back(resolver.resolve(rope.from, name + " begins at"));
    for (const auto& sheave : rope.through) {
      points.push_back(resolver.resolve(sheave, name + " runs over"));
    }
    points.push_back(resolver.resolve(rope.to, name + " ends at"));
    resolve_edges(lift_case, rope, diagnostics);
    if (!std::all_of(points.begin(), points.end(), [](const auto& p) { return p.has_value(); })) {
      continue;
    }
    for (auto& point : points) rope.path.push_back(std::move(*point));
  }
  for (given::Stage& stage : lift_case.operation) {
    for (given::Move& move : stage.moves) {
      if (!move.keeps) continue;
      given::Keep& keep = *move.keeps;
      const std::string subject = fmt::format("stage \"{}\" keeps", stage.name.value);
      resolve_seen(resolver, subject, keep);
      for (given::Sight& sight : keep.sees)
        resolve_seen(resolver, fmt::format("stage \"{}\" has a law that sees", stage.name.value),
                     sight);
    }
  }
}

}  // namespace blocklift::pipeline

#include "pipeline/files/lift_case/rigging_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace blocklift::pipeline {
namespace {

bool same_point(const ResolvedPoint& a, const ResolvedPoint& b) {
  return a.kind == b.kind && a.crane == b.crane && a.part == b.part && a.point == b.point;
}

/// Complains about sheaves on the load or a spreader: only the forces of rope ends reach its
/// stress.
void check_sheaves(const given::Rope& rope, Diagnostics& diagnostics) {
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

/// A rope between two eyes of one spreader pulls at nothing else, as an eye of the wrong name makes
/// it: what it was to hold hangs without it. One that goes round edges of the load holds that.
void check_bodies_of(const LiftCase& lift_case, const given::Rope& rope, Diagnostics& diagnostics) {
  if (rope.path.empty() || !rope.over.empty()) return;
  if (rope.path.front().kind != ResolvedPoint::Kind::spreader) return;
  const std::string first = rope.path.front().body_name(lift_case.cranes);
  for (const ResolvedPoint& point : rope.path)
    if (point.body_name(lift_case.cranes) != first) return;
  diagnostics.error(rope.to.mark,
                    fmt::format("rope {} begins and ends at {}", rope.name.value, first),
                    {"a rope leads from one body to another"});
}

/// Slings from one hook to both ends of a bar must reach around it.
void check_reach(const LiftCase& lift_case, const given::Spreader& bar, Diagnostics& diagnostics) {
  for (const given::Rope& one : lift_case.ropes) {
    if (!one.ends_at_spreader(bar.name.value)) continue;
    for (const given::Rope& other : lift_case.ropes) {
      if (&other <= &one || !other.ends_at_spreader(bar.name.value)) continue;
      const double apart = (one.path.back().point - other.path.back().point).norm();
      if (!same_point(one.path.front(), other.path.front()) ||
          !(one.length.value + other.length.value <= apart))
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

/// Does a chain of slings lead from a spreader upwards to what is no spreader?
bool hangs_on_something(const LiftCase& lift_case, const given::Spreader& bar) {
  std::vector<std::string> reached = {bar.name.value};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const std::string name = reached[i];
    for (const given::Rope& rope : lift_case.ropes) {
      if (rope.path.empty() || !rope.ends_at_spreader(name)) continue;
      const ResolvedPoint& first = rope.path.front();
      if (first.kind != ResolvedPoint::Kind::spreader) return true;
      if (std::ranges::find(reached, first.part) == reached.end()) reached.push_back(first.part);
    }
  }
  return false;
}

void check_spreaders(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const given::Spreader& bar : lift_case.spreaders) {
    int above = 0, below = 0;
    bool all_known = true;
    for (const given::Rope& rope : lift_case.ropes) {
      all_known &= !rope.path.empty();
      if (rope.path.empty()) continue;
      above += int{rope.ends_at_spreader(bar.name.value)};
      const ResolvedPoint& first = rope.path.front();
      const ResolvedPoint& last = rope.path.back();
      const auto is_at_bar = [&](const ResolvedPoint& point) {
        return point.kind == ResolvedPoint::Kind::spreader && point.part == bar.name.value;
      };
      below += int{is_at_bar(first) || (rope.is_basket() && is_at_bar(last))};
    }
    const std::string& name = bar.name.value;
    if (all_known && (above == 0 || below == 0))
      diagnostics.error(
          bar.name.mark,
          fmt::format("no sling {} spreader {}", above == 0 ? "ends at" : "begins at", name),
          {bar.is_frame()
               ? fmt::format("slings from above end at {0}.upper_1 to {0}.upper_4, those to the "
                             "load begin at {0}.lower_1 to {0}.lower_4",
                             name)
               : fmt::format("slings from above end at {0}.upper_a and {0}.upper_b, those to the "
                             "load begin at {0}.lower_a and {0}.lower_b",
                             name)});
    if (all_known && above > 0 && !hangs_on_something(lift_case, bar))
      diagnostics.error(bar.name.mark,
                        fmt::format("the slings above spreader {} begin at spreaders that hang on "
                                    "nothing else",
                                    name),
                        {"slings from above begin at a hook, or at a spreader that hangs on one"});
    check_reach(lift_case, bar, diagnostics);
  }
}

void check_bend(const given::Rope& rope, Diagnostics& diagnostics) {
  if (!rope.bend_diameter) return;
  const auto& [bend, mark] = *rope.bend_diameter;
  if (!rope.rope.diameter) {
    // A model that could not be read has been complained of.
    if (rope.rope.stretches())
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
  for (const given::Rope& rope : lift_case.ropes) {
    all_known &= !rope.path.empty() && rope.edges.size() == rope.over.size();
    load_hangs |= rope.is_basket();
    check_sheaves(rope, diagnostics);
    check_bend(rope, diagnostics);
    for (std::size_t i = 0; i < rope.path.size(); ++i) {
      load_hangs |= rope.path[i].kind == ResolvedPoint::Kind::load;
      const bool is_bent = std::ranges::any_of(rope.over, [i](const EdgeOnTheWay& passage) {
        return passage.span.value == static_cast<int>(i);
      });
      if (i > 0 && !is_bent && same_point(rope.path[i - 1], rope.path[i])) {
        diagnostics.error(rope.name.mark,
                          fmt::format("rope {} runs from a point to itself", rope.name.value));
      }
    }
    if (rope.winch && rope.winch->range[0].value >= rope.winch->range[1].value) {
      diagnostics.error(
          rope.name.mark,
          fmt::format(
              "the range of the winch of rope {} does not ascend: {:g} m comes before {:g} m",
              rope.name.value, rope.winch->range[0].value, rope.winch->range[1].value));
    }
  }
  if (all_known && !lift_case.ropes.empty() && !load_hangs) {
    diagnostics.error(lift_case.load.vessel_name ? lift_case.load.vessel_name->mark
                                                 : lift_case.load.model_name.mark,
                      "no rope holds the load",
                      {"a rope that ends at one of its lugs does, or goes round its edges"});
  }
}

/// Two hoists of one kind of rope can be reeved with one.
void check_equalised(const given::Crane& crane, Diagnostics& diagnostics) {
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
  for (const HoistModel* hoist : hoists) {
    if (!hoist->hook_block.turning) continue;
    diagnostics.error(crane.equalised->mark,
                      fmt::format("the hook block of hoist {}.{} turns, and is equalised",
                                  crane.name.value, hoist->name.value),
                      {"the falls of one rope over two hooks are taken as a line at each, which "
                       "does not twist: leave turning out of the crane's model, or equalised"});
    return;
  }
  const RopeModel &a = hoists[0]->rope, &b = hoists[1]->rope;
  if (!a.stretches_like(b) || a.breaking_load != b.breaking_load) {
    diagnostics.error(
        crane.equalised->mark,
        fmt::format("hoists {} and {} of crane {} have different tackles", hoists[0]->name.value,
                    hoists[1]->name.value, crane.name.value),
        {"one rope runs through both where they are equalised, so both name the same rope"});
  }
}

/// Ropes that hang by their weight have some, and end at bodies that do not give way.
void check_rope_weight(const LiftCase& lift_case, Diagnostics& diagnostics) {
  if (!lift_case.rope_weight || !lift_case.rope_weight->value) return;
  const Mark& mark = lift_case.rope_weight->mark;
  if (lift_case.dynamics.flexibility != Flexibility::rigid)
    diagnostics.error(mark, "ropes hang by their weight, and the block is flexible",
                      {"ropes to a block that gives way run straight: leave one of the two out"});
  bool any = false;
  const auto look_at = [&](const std::string& name, const RopeModel& rope, bool hangs) {
    any = any || hangs;
    if (hangs && rope.tension_curve)
      diagnostics.error(
          mark, fmt::format("{} hangs by its weight, and has a tension_curve", name),
          {"a catenary has one stiffness: give axial_stiffness, leave the mass of its "
           "model out, or rope_weight"});
  };
  for (const given::Rope& rope : lift_case.ropes)
    look_at("rope " + rope.name.value, rope.rope, lift_case.hangs(rope));
  for (const given::Crane& crane : lift_case.cranes) {
    if (!crane.model) return;
    for (const HoistModel& hoist : crane.model->hoists)
      look_at("tackle " + crane.name.value + "." + hoist.name.value, hoist.rope,
              lift_case.hangs(crane, hoist));
  }
  if (!any)
    diagnostics.error(mark, "no rope has a mass by which it would hang",
                      {"add mass to the models of slings and tackles that run from point to "
                       "point"});
}

/// Ropes with friction have one stiffness, and end at bodies that do not give way.
void check_friction(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const given::Rope& rope : lift_case.ropes) check_curve_without_friction(rope, diagnostics);
  if (lift_case.dynamics.flexibility == Flexibility::rigid) return;
  for (const given::Rope& rope : lift_case.ropes) {
    const auto& given = rope.sheave_friction ? rope.sheave_friction : rope.sheave_efficiency;
    if (!given || rope.friction() == 0) continue;
    diagnostics.error(
        given->mark,
        fmt::format("rope {} has friction at its sheaves, and the block is flexible",
                    rope.name.value),
        {"ropes to a block that gives way have one tension all along: leave one of the two out"});
  }
}

/// A lug at which a span begins or ends, within the round of an edge of that span.
void check_lug_and_edge(const given::Rope& rope, std::size_t i, Diagnostics& diagnostics) {
  const auto span = static_cast<std::size_t>(rope.over[i].span.value);
  const LoadEdge& edge = rope.edges[i];
  for (const ResolvedPoint* point : {&rope.path[span - 1], &rope.path[span]}) {
    if (point->kind != ResolvedPoint::Kind::load) continue;
    const double distance = edge.distance_from_axis(point->point);
    constexpr double on_the_edge = 1e-6;  // m
    if (distance > std::max(edge.radius, on_the_edge)) continue;
    diagnostics.error(rope.over[i].edge.mark,
                      fmt::format("{} of rope {} lies {} edge {}, {} from its axis",
                                  point->lug.empty() ? "a point" : "lug " + point->lug,
                                  rope.name.value, edge.radius > 0 ? "within the round of" : "on",
                                  edge.name.value, format_quantity(distance, Dimension::length)),
                      {"a rope bends round edges that lie beside its ends"});
  }
}

void check_spans(const given::Rope& rope, Diagnostics& diagnostics) {
  // As the rope's path takes.
  constexpr int most_in_span = 6;
  constexpr std::size_t most_places = 32;
  const int spans = static_cast<int>(rope.path.size()) - 1;
  int previous = 0, in_span = 0;
  for (std::size_t i = 0; i < rope.over.size(); ++i) {
    const auto& [edge, span] = rope.over[i];
    if (span.value > spans) {
      diagnostics.error(span.mark,
                        fmt::format("rope {} runs over edge {} in span {}, and has {}",
                                    rope.name.value, edge.value, span.value,
                                    spans == 1 ? "one span" : fmt::format("{} spans", spans)),
                        {"spans lie between its points: from, those of through, to"});
      return;
    }
    if (span.value < previous) {
      diagnostics.error(span.mark,
                        fmt::format("rope {} runs over edge {} in span {} behind one in span {}",
                                    rope.name.value, edge.value, span.value, previous),
                        {"edges stand in the order of the rope's path, from its upper end"});
      return;
    }
    if (span.value == previous && rope.over[i - 1].edge.value == edge.value) {
      diagnostics.error(edge.mark, fmt::format("rope {} runs over edge {} twice in succession",
                                               rope.name.value, edge.value));
      return;
    }
    in_span = span.value == previous ? in_span + 1 : 1;
    previous = span.value;
    if (in_span > most_in_span) {
      diagnostics.error(
          edge.mark,
          fmt::format("rope {} runs over more than {} edges between two of its points",
                      rope.name.value, most_in_span),
          {"several that lie close to one another are one round edge"});
      return;
    }
    check_lug_and_edge(rope, i, diagnostics);
  }
  if (rope.path.size() + 2 * rope.over.size() > most_places)
    diagnostics.error(
        rope.name.mark,
        fmt::format("rope {} has too many points and edges: each point counts as one, "
                    "each edge as two, and {} are allowed",
                    rope.name.value, most_places));
}

/// Both ways round a bar from one point are alike: which of them is meant, two edges say.
void check_way_round(const given::Rope& rope, Diagnostics& diagnostics) {
  for (std::size_t i = 1; i < rope.path.size(); ++i) {
    if (!same_point(rope.path[i - 1], rope.path[i])) continue;
    const auto is_here = [i](const EdgeOnTheWay& passage) {
      return passage.span.value == static_cast<int>(i);
    };
    if (std::ranges::count_if(rope.over, is_here) != 1) continue;
    const EdgeOnTheWay& passage = *std::ranges::find_if(rope.over, is_here);
    diagnostics.error(passage.edge.mark,
                      fmt::format("rope {} goes round edge {} alone, from a point and back to it",
                                  rope.name.value, passage.edge.value),
                      {"a rope that goes round a bar meets two edges, one at either side of it"});
  }
}

/// What a rope over edges may not have besides.
void check_edges(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const given::Rope& rope : lift_case.ropes) {
    if (rope.edges.empty() || rope.path.empty()) continue;
    const Mark& mark = rope.over.front().edge.mark;
    if (lift_case.dynamics.flexibility != Flexibility::rigid)
      diagnostics.error(
          mark,
          fmt::format("rope {} runs over edges of the load, and the block is flexible",
                      rope.name.value),
          {"ropes to a block that gives way touch no edges: leave over or dynamics.flexibility "
           "out"});
    check_spans(rope, diagnostics);
    check_way_round(rope, diagnostics);
    for (std::size_t i = 0; i < rope.edges.size(); ++i) {
      const LoadEdge& edge = rope.edges[i];
      if (!rope.rope.diameter || !(2 * edge.radius < *rope.rope.diameter)) continue;
      diagnostics.error(
          rope.over[i].edge.mark,
          fmt::format("rope {} of {} runs over edge {}, whose round is {} across", rope.name.value,
                      format_quantity(*rope.rope.diameter, Dimension::length), edge.name.value,
                      format_quantity(2 * edge.radius, Dimension::length)),
          {"a rope is not bent round less than its own diameter: give the edge the radius of the "
           "protector that lies on it, or leave the diameter out where the sling is not of wire "
           "rope"});
    }
  }
}

}  // namespace

void check_curve_without_friction(const given::Rope& rope, Diagnostics& diagnostics) {
  const std::string hint =
      "ropes with friction have one stiffness: leave the friction out, or give axial_stiffness";
  for (std::size_t i = 0; i < rope.edges.size(); ++i) {
    if (rope.edges[i].friction == 0 || !rope.rope.tension_curve) continue;
    diagnostics.error(rope.over[i].edge.mark,
                      fmt::format("rope {} rubs on edge {}, and has a tension_curve",
                                  rope.name.value, rope.edges[i].name.value),
                      {hint});
  }
  const auto& given = rope.sheave_friction ? rope.sheave_friction : rope.sheave_efficiency;
  if (!given || rope.friction() == 0 || !rope.rope.tension_curve) return;
  diagnostics.error(
      given->mark,
      fmt::format("rope {} has friction at its sheaves, and a tension_curve", rope.name.value),
      {hint});
}

void check_rigging(const LiftCase& lift_case, Diagnostics& diagnostics) {
  for (const given::Crane& crane : lift_case.cranes)
    if (crane.model && !lift_case.load_table) check_equalised(crane, diagnostics);
  check_ropes(lift_case, diagnostics);
  for (const given::Rope& rope : lift_case.ropes) check_bodies_of(lift_case, rope, diagnostics);
  check_spreaders(lift_case, diagnostics);
  check_rope_weight(lift_case, diagnostics);
  check_friction(lift_case, diagnostics);
  check_edges(lift_case, diagnostics);
}

}  // namespace blocklift::pipeline

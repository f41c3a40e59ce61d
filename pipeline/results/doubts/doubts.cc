#include "pipeline/results/doubts/doubts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "pipeline/build/body_box.h"
#include "pipeline/build/build_lift.h"
#include "pipeline/build/keel_clearance.h"
#include "pipeline/files/environment/sea_band.h"
#include "pipeline/files/environment/vessel_database.h"
#include "pipeline/files/environment/vessel_doubts.h"
#include "pipeline/files/environment/wave_headings.h"
#include "pipeline/files/vessel/wetted_mesh.h"
#include "pipeline/lift/parallel_baskets.h"
#include "pipeline/measures/edge_measures.h"
#include "pipeline/measures/edge_sliding.h"
#include "pipeline/measures/hook_block_measures.h"
#include "pipeline/measures/load_measures.h"
#include "pipeline/results/doubts/lug_doubts.h"

namespace blocklift::pipeline {

namespace {

using dynamics::Pose;

/// What stands for the load in drawings: its bounding box in its own frame.
struct Box {
  Vector3 centre, half;
};

Box box_of(const BoxShape& shape) { return {shape.centre, 0.5 * shape.size}; }

/// Height of the lowest corner, m.
double lowest_point(const Box& box, const Pose& X_WB) {
  return X_WB.apply(box.centre).z() - X_WB.R.row(2).cwiseAbs().dot(box.half);
}

class Doubts {
 public:
  explicit Doubts(const LiftCase& lift_case) : case_(lift_case) {
    if (lift_case.load.vessel || lift_case.load.model)
      load_box_ = box_of(box_around(lift_case.load));
    if (lift_case.load.model && lift_case.load.model->mass)
      mass_ = lift_case.load.model->mass->value;
  }

  void doubt_run(const LiftRun& lift) {
    mass_ = lift.model.system.mechanism().body(lift.model.load).inertia.mass;
    doubt_gust(lift);
    doubt_place(lift);
    doubt_ground(lift);
    doubt_ropes(lift);
    doubt_edges(lift);
    doubt_sliding(lift);
    doubt_falls(lift);
    doubt_suspension(lift);
    doubt_turn(lift);
    say_faults(lift);
    list_.insert(list_.end(), lift.model.doubts_of_water.begin(), lift.model.doubts_of_water.end());
  }

  std::vector<std::string> list() {
    doubt_cranes();
    if (const std::string baskets = doubt_about_baskets(case_); !baskets.empty())
      list_.push_back(baskets + ".");
    if (std::string lugs = doubt_about_lugs(case_); !lugs.empty()) list_.push_back(std::move(lugs));
    doubt_sea();
    doubt_water();
    doubt_wind();
    doubt_bearing();
    doubt_materials();
    doubt_masses();
    doubt_frames();
    doubt_gravity();
    for (const given::Rope& rope : case_.ropes) doubt_strength(rope);
    return std::move(list_);
  }

 private:
  template <typename... Values>
  void doubt(fmt::format_string<Values...> text, Values&&... values) {
    list_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  static const dynamics::BodyHistory& load_of(const LiftRun& lift,
                                              const dynamics::History& history) {
    return history.bodies[lift.model.load - 1];
  }

  /// Of a load on one hook: nothing holds its heading in the motion, as is taken at rest.
  void doubt_turn(const LiftRun& lift) {
    constexpr double degree = std::numbers::pi / 180;
    constexpr double usual = 15 * degree;
    if (!lift.model.held_heading) return;
    const LiftMeasure turn = turn_of_load(lift);
    const MeasurePeak peak =
        find_peak(lift.dynamic_history().time, turn.in_motion, Extreme::largest_magnitude);
    if (!(std::abs(peak.value) > usual)) return;
    doubt(
        "The load turns by {:.0f} deg about the plumb, at {:.0f} s: it hangs on one hook, and "
        "nothing "
        "holds its heading in the motion or damps that turn, which a swing to two sides drives, as "
        "gusts do. Tag lines that hold it are tuggers of the case; checks.turn bounds it.",
        std::abs(peak.value) / degree, peak.time);
  }

  /// The place that the case gives is a first guess, but not of another yard.
  void doubt_place(const LiftRun& lift) {
    constexpr double usual = 10;  // m
    const double size = load_box_ ? 2 * load_box_->half.norm() : 0;
    const Vector3 found = load_of(lift, lift.static_history).X_WB(0).p;
    const double distance = (found - case_.load.position).norm();
    if (distance <= std::max(usual, size)) return;
    doubt(
        "The load hangs at rest {:.0f} m from where the case puts it, at ({:.1f}, {:.1f}, {:.1f}) "
        "m; usually it is found within {:.0f} m. Are cranes, ropes and load in their places?",
        distance, found.x(), found.y(), found.z(), std::max(usual, size));
  }

  /// Nothing but pads keeps the load out of the ground.
  void doubt_ground(const LiftRun& lift) {
    const std::optional<double> ground = case_.ground_height();
    if (!ground || !load_box_) return;
    constexpr double sunk = 0.1;  // m
    const dynamics::BodyHistory& body = load_of(lift, lift.dynamic_history());
    double lowest = std::numeric_limits<double>::infinity(), when = 0;
    for (Eigen::Index i = 0; i < lift.dynamic_history().sample_count(); ++i) {
      const double height = lowest_point(*load_box_, body.X_WB(i));
      if (height >= lowest) continue;
      lowest = height;
      when = lift.dynamic_history().time[i];
    }
    if (lowest < *ground - sunk)
      doubt("The load reaches {:.2f} m below the ground (z = {:g} m) at {:.1f} s; {}.",
            *ground - lowest, *ground, when,
            case_.ground_contact ? "the ground of the case is as soft as that"
                                 : "nothing is there that would bear it");
  }

  /// An equilibrium that tips over is one, yet no load stays there.
  void doubt_suspension(const LiftRun& lift) {
    constexpr double neutral = 1e-3;  // m
    const LiftMeasure measure = righting_height(case_, lift);
    const MeasurePeak peak = find_peak(lift.static_history.time, measure.at_rest, measure.extreme);
    if (!(peak.value < -neutral)) return;
    const std::string slack = slack_ropes(lift, peak.time);
    const std::string which = slack.empty() ? slack : " Slack there: " + slack + ".";
    if (peak.value <= least_righting_height)
      doubt(
          "Nothing holds the load in the equilibrium of {:g} s: a small push would slide it along "
          "its slings or edges, and it would tilt and go on.{} Histories at rest are not those of "
          "a lift there.",
          peak.time, which);
    else
      doubt(
          "The equilibrium of {:g} s tips over: the load hangs as if its pin were {:.3g} m below "
          "its centre of mass.{} Histories at rest are not those of a lift there.",
          peak.time, -peak.value, which);
  }

  /// Names of ropes without tension at rest at a time (s).
  static std::string slack_ropes(const LiftRun& lift, double time) {
    const auto& times = lift.static_history.time;
    const Eigen::Index at = std::lower_bound(times.begin(), times.end(), time) - times.begin();
    std::string names;
    for (const LiftRope& rope : lift.model.ropes)
      if (at < times.size() && !(lift.static_history.ropes[rope.rope].tension[at] > 0))
        names += (names.empty() ? "" : ", ") + rope.name;
    return names;
  }

  /// What goes wrong on purpose stands beside what may be wrong.
  void say_faults(const LiftRun& lift) {
    for (const dynamics::PartedRope& parted : lift.dynamic_result.parted)
      doubt(
          "Rope {} parts at {:g} s under {:.0f} kN and sets {:.3g} kJ free, as the case says; at "
          "rest it holds.",
          lift.model.system.ropes()[parted.rope].name(), parted.time, parted.tension / 1e3,
          parted.energy / 1e3);
    for (const given::Fault& fault : case_.faults) {
      if (!fault.at && !lift.model.worst) continue;  // it does not come
      const double at = fault.at ? fault.at->value : lift.model.worst->worst.time;
      if (!fault.at) say_worst(*lift.model.worst);
      for (const Located<std::string>& winch : fault.runs_away)
        doubt("Winch {} runs away at {:g} s, {:.3g} m in {:g} s, as the case says.", winch.value,
              at, *fault.speed * *fault.caught_after, *fault.caught_after);
      if (fault.stops.empty()) continue;
      std::string names;
      for (const Located<std::string>& name : fault.stops)
        names += (names.empty() ? "" : ", ") + (name.value == "all" ? "All drives" : name.value);
      doubt("{} come to a stand from {:g} s on within {:g} s, as the case says.", names, at,
            fault.within);
    }
  }

  void say_worst(const WorstInstant& instant) {
    const auto& [worst, undisturbed, trials] = instant;
    doubt(
        "The fault comes at {:g} s, the worst of {} instants that were tried: {} carries {:.1f} % "
        "of "
        "its breaking load then, at {:.2f} s. Without the fault the most is {:.1f} %, of {}.",
        worst.time, trials.size(), worst.rope, 100 * worst.share, worst.peak_time,
        100 * undisturbed.share, undisturbed.rope);
  }

  void doubt_ropes(const LiftRun& lift) {
    for (const dynamics::LinkedMaximum& most :
         dynamics::find_largest_tensions(lift.dynamic_history())) {
      const auto check = [&](const auto& rope) {
        if (rope.rope != most.rope || !(most.tension > rope.breaking_load)) return;
        doubt(
            "Rope {} carries {:.0f} kN at {:.1f} s, more than its breaking load of {:.0f} kN: what "
            "follows would not happen so.",
            rope.name, most.tension / 1e3, most.time, rope.breaking_load / 1e3);
      };
      for (const LiftRope& rope : lift.model.ropes) check(rope);
      for (const LiftHoist& hoist : lift.model.hoists) check(hoist);
    }
  }

  /// An edge has no ends where the rope's path is computed.
  void doubt_edges(const LiftRun& lift) {
    for (const LiftRope& rope : lift.model.ropes)
      for (std::size_t edge = 0; edge < rope.edges.size(); ++edge) {
        const LiftEdge& of = rope.edges[edge];
        double least = 0, when = 0;
        for (const dynamics::History* history : {&lift.static_history, &lift.dynamic_history()}) {
          const dynamics::RopeHistory& path = history->ropes[rope.rope];
          for (Eigen::Index i = 0; i < history->sample_count(); ++i) {
            const double distance = distance_from_end(path, edge, of.length, i);
            if (!(distance < least)) continue;
            least = distance;
            when = history->time[i];
          }
        }
        if (least < 0)
          doubt(
              "Rope {} touches edge {} up to {:.2f} m beyond its end, at {:.1f} s: it has run off "
              "the edge, which is computed as if it went on.",
              rope.name, of.name, -least, when);
      }
  }

  /// Friction of edges acts along ropes alone where the motion is computed.
  void doubt_sliding(const LiftRun& lift) {
    for (const LiftRope& rope : lift.model.ropes)
      for (std::size_t edge = 0; edge < rope.edges.size(); ++edge) {
        if (rope.edges[edge].friction == 0) continue;
        for (const dynamics::History* history : {&lift.dynamic_history(), &lift.static_history})
          if (doubt_sliding(lift, *history, rope, edge)) break;
      }
  }

  /// @return Was there a doubt?
  bool doubt_sliding(const LiftRun& lift, const dynamics::History& history, const LiftRope& rope,
                     std::size_t edge) {
    constexpr double round_off = 1e-6, some_way = 0.05;  // of the friction; m
    const LiftEdge& of = rope.edges[edge];
    const auto index = static_cast<std::size_t>(rope.rope);
    const SidewaysHold hold = hold_sideways(lift.model.system.ropes()[index], history, index, edge);
    const char* const at_rest = &history == &lift.static_history ? " at rest" : "";
    for (Eigen::Index i = 0; i < history.sample_count(); ++i) {
      if (!(std::abs(hold.pull[i]) > (1 + round_off) * of.friction)) continue;
      doubt(
          "Rope {} slides sideways along edge {} from {:.1f} s on{}, {:.2f} m from where the edge "
          "begins: it pulls {:.3g} times as much along the edge as against it, and friction holds "
          "{:g}. The computation lets it slide without any.",
          rope.name, of.name, history.time[i], at_rest, hold.place[i], std::abs(hold.pull[i]),
          of.friction);
      return true;
    }
    const MeasurePeak most = find_peak(history.time, hold.slid, Extreme::largest_magnitude);
    if (!(std::abs(most.value) > some_way)) return false;
    doubt(
        "Rope {} is {:.2f} m further along edge {} at {:.1f} s{} than friction would let it slide: "
        "the computation has none sideways.",
        rope.name, std::abs(most.value), of.name, most.time, at_rest);
    return true;
  }

  /// Falls turn a hook block back ever less beyond a quarter of a turn, and wind up beyond half.
  void doubt_falls(const LiftRun& lift) {
    constexpr double degree = std::numbers::pi / 180;
    for (const LiftHoist& hoist : lift.model.hoists) {
      if (!block_turns(lift, hoist)) continue;
      const auto peak_of = [&](const dynamics::History& history) {
        return find_peak(history.time, falls_twist(lift, hoist, history),
                         Extreme::largest_magnitude);
      };
      const MeasurePeak still = peak_of(lift.static_history);
      const MeasurePeak moving = peak_of(lift.dynamic_history());
      const MeasurePeak most = std::abs(still.value) > std::abs(moving.value) ? still : moving;
      const double twist = std::abs(most.value);
      if (twist >= 180 * degree)
        doubt(
            "The falls of {} are twisted by {:.0f} deg at {:.1f} s: beyond 180 deg they would wind "
            "round one another, and in the computation they go through one another.",
            hoist.name, twist / degree, most.time);
      else if (twist > 90 * degree)
        doubt(
            "The falls of {} are twisted by {:.0f} deg at {:.1f} s, beyond the 90 deg at which "
            "they turn the hook block back most.",
            hoist.name, twist / degree, most.time);
    }
  }

  void doubt_cranes() {
    constexpr double apart = 0.1;  // m
    for (std::size_t i = 0; i < case_.cranes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const given::Crane &one = case_.cranes[j], &other = case_.cranes[i];
        const bool same_ground = one.base.has_value() == other.base.has_value() &&
                                 (!one.base || one.base->value == other.base->value);
        if (!same_ground || (one.position - other.position).norm() > apart ||
            (one.attitude - other.attitude).norm() > apart || starts_differ(one, other)) {
          continue;
        }
        doubt("Cranes {} and {} stand in one place.", one.name.value, other.name.value);
      }
    }
  }

  /// Cranes on one rail have one position and start apart.
  static bool starts_differ(const given::Crane& one, const given::Crane& other) {
    if (!one.model || !other.model) return true;
    for (const DriveModel& drive : one.model->drives) {
      const auto *a = one.find_start(drive.name.value), *b = other.find_start(drive.name.value);
      if (!a || !b || std::abs(a->value.value - b->value.value) > 0.1) return true;
    }
    return false;
  }

  void doubt_sea() {
    std::string of_sea = doubt_about_sea(case_, case_.gravity);
    if (!of_sea.empty()) list_.push_back(std::move(of_sea));
    for (std::string& of_vessel : doubts_about_vessels(case_))
      list_.push_back(std::move(of_vessel));
    for (std::string& of_database : doubts_about_database(case_.vessels))
      list_.push_back(std::move(of_database));
  }

  void doubt_water() {
    if (std::string headings = doubt_about_headings(case_); !headings.empty())
      list_.push_back(std::move(headings));
    if (!case_.sea || !case_.sea->depth) return;
    if (std::string keels = doubt_about_keels(radiation_problem(case_)); !keels.empty())
      list_.push_back(std::move(keels));
  }

  /// A gust that comes after the lift is not felt.
  void doubt_gust(const LiftRun& lift) {
    if (!case_.wind || !case_.wind->gust) return;
    const dynamics::WindGust gust = case_.wind->gust->make_gust();
    const dynamics::History& history = lift.dynamic_history();
    const double end = history.time[history.sample_count() - 1];
    // Before its first point a table may add something as well.
    if (gust.start() >= end && gust.evaluate(end) == 0)
      doubt("The gust begins at {:g} s, and the lift ends at {:g} s: it feels none of it.",
            gust.start(), end);
  }

  void doubt_wind() {
    constexpr double most = 28.5;  // m/s: ISO 4302, cranes that work on in high winds
    const BlockModel* block = case_.load.model.get();
    if (case_.wind && case_.wind->speed > most)
      doubt(
          "The wind blows with {:.4g} m/s; cranes work in up to 14 to 28.5 m/s (ISO 4302), and a "
          "hurricane begins at 33 m/s.",
          case_.wind->speed);
    if (case_.wind && case_.wind->speed > 0 && (!block || block->wind_areas.empty()))
      doubt("Wind blows, and the load has no wind_areas: it feels none of it.");
    if (!block || !load_box_) return;
    // A body shows the wind at most the sum of its box's faces, times what lattices and edges add.
    constexpr double usual = 3;
    const Vector3 size = 2 * load_box_->half;
    const double faces = size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
    for (const WindAreaModel& area : block->wind_areas) {
      if (area.area > usual * faces)
        doubt(
            "The load has a wind area of {:.4g} m2; its box has faces of {:.4g} m2 in all three "
            "directions together.",
            area.area, faces);
    }
  }

  /// Of a load that stands, floats or hangs on a fixed point as well, slings and hooks may bear a
  /// part.
  bool hangs_on_hooks_alone() const {
    using Kind = ResolvedPoint::Kind;
    if (!case_.supports.empty() || case_.ground_contact || case_.load.vessel) return false;
    const auto hangs = [](const ResolvedPoint& point) {
      return point.kind == Kind::load || point.kind == Kind::spreader;
    };
    for (const given::Rope& rope : case_.ropes) {
      if (rope.edges.empty() && std::none_of(rope.path.begin(), rope.path.end(), hangs)) continue;
      for (const ResolvedPoint& point : rope.path)
        if (!hangs(point) && point.kind != Kind::hook) return false;
    }
    return true;
  }

  /// Breaking loads of all ropes that end at the load, or at hooks, together, N: that of a rope
  /// counts for each of its parts there.
  double strength_at(ResolvedPoint::Kind kind) const {
    double together = 0;
    for (const given::Rope& rope : case_.ropes) {
      double parts = 0;
      for (std::size_t i = 0; i < rope.path.size(); ++i)
        if (rope.path[i].kind == kind) parts += i == 0 || i + 1 == rope.path.size() ? 1 : 2;
      if (kind == ResolvedPoint::Kind::load && rope.is_basket()) parts = 2;
      together += parts * rope.rope.breaking_load;
    }
    return together;
  }

  /// What hooks that hold something may carry together, by hoists and cranes, N.
  double capacity_of_hooks() const {
    std::vector<std::map<std::string, double>> hooks(case_.cranes.size());
    for (const given::Rope& rope : case_.ropes)
      for (const ResolvedPoint& point : rope.path)
        if (point.kind == ResolvedPoint::Kind::hook)
          if (const auto* hoist = case_.cranes[point.crane].model->find_hoist(point.part))
            hooks[point.crane][point.part] = hoist->capacity;
    double all = 0;
    for (std::size_t i = 0; i < hooks.size(); ++i) {
      double of_crane = 0;
      for (const auto& [name, capacity] : hooks[i]) of_crane += capacity;
      all += std::min(of_crane, case_.cranes[i].model->capacity.value_or(of_crane));
    }
    return all;
  }

  /// Slings and hooks of another lift than this one.
  void doubt_bearing() {
    using Kind = ResolvedPoint::Kind;
    constexpr double least = 2, usual = 5;  // times the weight: no rule of slings is below 2.28
    if (!mass_ || case_.ropes.empty() || !hangs_on_hooks_alone()) return;
    const double weight = *mass_ * case_.gravity;
    const auto kilonewtons = [](double force) {
      return force < 1e6 ? fmt::format("{:.4g}", force / 1e3) : fmt::format("{:.0f}", force / 1e3);
    };
    const double slings = std::min(strength_at(Kind::load), strength_at(Kind::hook));
    if (slings < least * weight)
      doubt(
          "The load weighs {:.0f} kN, and its slings break under {} kN together; usually they "
          "do under {:g} times its weight.",
          weight / 1e3, kilonewtons(slings), usual);
    const double hooks = capacity_of_hooks();
    constexpr double rounding = 1.01;  // gravity of the case, and that of a tonne as a force
    if (rounding * hooks < weight)
      doubt("The load weighs {:.0f} kN, and the hooks that hold it may carry {} kN together.",
            weight / 1e3, kilonewtons(hooks));
  }

  void doubt_materials() {
    if (!case_.load.model) return;
    constexpr double lowest = 40e9, highest = 450e9;  // Pa: magnesium, tungsten
    for (const MaterialModel& material : case_.load.model->materials) {
      const double modulus = material.youngs_modulus;
      if (modulus < lowest || modulus > highest)
        doubt(
            "Material {} has a Young's modulus of {:.4g} GPa; metals have {:.0f} to {:.0f} GPa "
            "(steel 206).",
            material.name.value, modulus / 1e9, lowest / 1e9, highest / 1e9);
    }
  }

  /// A sling that was forgotten leaves a frame hanging aslant on the others.
  void doubt_frames() {
    for (const given::Spreader& bar : case_.spreaders) {
      if (!bar.is_frame()) continue;
      const auto is_at = [&](const ResolvedPoint& point, const std::string& eye) {
        return point.kind == ResolvedPoint::Kind::spreader && point.part == bar.name.value &&
               point.point == *bar.eye(eye);
      };
      bool hangs = false;
      std::string bare;
      for (const char* const corner : {"1", "2", "3", "4"}) {
        bool above = false, below = false;
        for (const given::Rope& rope : case_.ropes) {
          if (rope.path.empty()) continue;
          above = above || is_at(rope.path.back(), std::string("upper_") + corner);
          below = below || is_at(rope.path.front(), std::string("lower_") + corner);
        }
        hangs = hangs || above;
        if (below && !above) bare += (bare.empty() ? "" : ", ") + std::string(corner);
      }
      if (hangs && !bare.empty())
        doubt("Slings to the load begin at corner {} of frame {}, where none comes from above.",
              bare, bar.name.value);
    }
  }

  /// Of another unit all loads would be too small, or too large, by its factor.
  void doubt_gravity() {
    constexpr double least = 9.75, most = 9.85;  // m/s^2: of the Earth, with room for rounding
    if (case_.gravity < least || case_.gravity > most)
      doubt(
          "Gravity is {:.4g} m/s2; on the Earth it is 9.76 to 9.84 m/s2, and all weights follow "
          "it.",
          case_.gravity);
  }

  /// A breaking load in the wrong unit passes every check.
  void doubt_strength(const given::Rope& rope) {
    constexpr double most_stress = 4e9;   // Pa over the circle: four parts of the strongest wire
    constexpr double most_stretch = 0.5;  // nylon, the softest of ropes, breaks before
    const RopeModel& model = rope.rope;
    const double diameter = model.diameter.value_or(0);
    const double stress = model.breaking_load / (std::numbers::pi / 4 * diameter * diameter);
    if (diameter > 0 && stress > most_stress)
      doubt(
          "Rope {} of {:.3g} mm has a breaking load of {:.4g} kN, {:.0f} MPa over its circle; wire "
          "ropes of the models have 800 to 900 MPa.",
          rope.name.value, 1e3 * diameter, model.breaking_load / 1e3, stress / 1e6);
    const double stretch = model.breaking_load / model.axial_stiffness;
    if (stretch > most_stretch)
      doubt(
          "Rope {} would be {:.0f} % longer before it breaks, by its axial stiffness of {:.4g} kN "
          "and its breaking load of {:.4g} kN; no rope stretches so far.",
          rope.name.value, 100 * stretch, model.axial_stiffness / 1e3, model.breaking_load / 1e3);
  }

  void doubt_masses() {
    const auto& centre = case_.load.model ? case_.load.model->centre_of_mass : std::nullopt;
    if (centre && load_box_ && is_outside(centre->value, *load_box_))
      doubt_centre("the load", centre->value);
    if (case_.load.vessel) doubt_vessel("the load", *case_.load.vessel);
    for (const given::Vessel& vessel : case_.vessels) {
      if (vessel.model) doubt_vessel("vessel " + vessel.name.value, *vessel.model);
    }
  }

  static bool is_outside(const Vector3& point, const Box& box) {
    return ((point - box.centre).cwiseAbs() - box.half).maxCoeff() > 1e-6;
  }

  void doubt_centre(const std::string& who, const Vector3& point) {
    doubt("The centre of mass of {}, ({:.3g}, {:.3g}, {:.3g}) m, lies outside its body.", who,
          point.x(), point.y(), point.z());
  }

  void doubt_vessel(const std::string& who, const Vessel& vessel) {
    const VesselModel& model = vessel.model;
    for (std::string doubt :
         {doubt_about_size(who, vessel.hull),
          doubt_about_lightness(who, vessel.hull, model.mass, model.hydrodynamics.water_density)})
      if (!doubt.empty()) list_.push_back(std::move(doubt));
    const auto [low, high] = vessel.hull.bounds();
    // Masts and cranes that a vessel's mass includes may stand above its deck.
    Box box{0.5 * (low + high), 0.5 * (high - low)};
    box.half.z() *= 3;
    if (is_outside(vessel.model.centre_of_mass, box))
      doubt_centre(who, vessel.model.centre_of_mass);
    const Vector3 size = high - low;
    const Vector3 widths(size.y(), size.x(), size.x());
    const char* const names[] = {"x", "y", "z"};
    constexpr double least = 0.1, most = 0.8;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double share = vessel.model.radii_of_gyration[axis] / widths[axis];
      if (share >= least && share <= most) continue;
      doubt(
          "The radius of gyration of {} about {} is {:.3g} m, {:.2g} of its {}; ships have 0.2 to "
          "0.45 of it.",
          who, names[axis], vessel.model.radii_of_gyration[axis], share,
          axis == 0 ? "breadth" : "length");
    }
  }

  const LiftCase& case_;
  std::optional<Box> load_box_;
  std::optional<double> mass_;  ///< of the load, kg; none: it takes a mesh to know
  std::vector<std::string> list_;
};

}  // namespace

std::vector<std::string> list_doubts(const LiftCase& lift_case, const LiftRun& lift) {
  Doubts doubts(lift_case);
  doubts.doubt_run(lift);
  return doubts.list();
}

std::vector<std::string> list_doubts(const LiftCase& lift_case) { return Doubts(lift_case).list(); }

}  // namespace blocklift::pipeline

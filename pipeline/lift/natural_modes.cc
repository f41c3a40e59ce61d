#include "pipeline/lift/natural_modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "dynamics/simulation/history.h"
#include "pipeline/build/held_heading.h"
#include "pipeline/formats/json_values.h"
#include "pipeline/formats/results/results_layout.h"

namespace blocklift::pipeline {

namespace {

using dynamics::BodyModeMotion;
using dynamics::ElasticModeMotion;
using dynamics::Mode;
using Json = nlohmann::ordered_json;

struct Instant {
  double time;
  std::string name;
};

// Instants nearer to one another than this are one, s.
constexpr double same_instant = 0.5;

// When at rest a rope or tackle is nearest to breaking.
Instant largest_static_load(const BuiltLift& model, const dynamics::History& history) {
  const std::vector<dynamics::LinkedMaximum> maxima = dynamics::find_largest_tensions(history);
  Instant largest{0, ""};
  double share = 0;
  const auto consider = [&](int rope, double breaking_load, const std::string& what) {
    const dynamics::LinkedMaximum& maximum = maxima[rope];
    if (!(maximum.tension / breaking_load > share)) return;
    share = maximum.tension / breaking_load;
    largest = {maximum.time, "largest load of " + what};
  };
  for (const LiftRope& rope : model.ropes)
    consider(rope.rope, rope.breaking_load, "rope " + rope.name);
  for (const LiftHoist& hoist : model.hoists)
    consider(hoist.rope, hoist.breaking_load, "hoist " + hoist.name);
  return largest;
}

std::vector<Instant> instants_of(const BuiltLift& model, const dynamics::History& history) {
  std::vector<Instant> instants{{0, "start"}};
  const auto add = [&](const Instant& instant) {
    for (Instant& other : instants) {
      if (std::abs(other.time - instant.time) > same_instant) continue;
      other.name += ", " + instant.name;
      return;
    }
    instants.push_back(instant);
  };
  for (const dynamics::Stage& stage : model.system.operation().stages())
    add({stage.end, "after " + stage.name});
  const Instant largest = largest_static_load(model, history);
  if (!largest.name.empty()) add(largest);
  std::stable_sort(instants.begin(), instants.end(),
                   [](const Instant& a, const Instant& b) { return a.time < b.time; });
  return instants;
}

Json mode_json(const dynamics::Mechanism& mechanism, const Mode& mode) {
  Json shares = Json::object();
  for (const BodyModeMotion& body : mode.bodies) {
    // What has no part in the mode is left out.
    if (body.energy_share >= 5e-4)
      shares[mechanism.body(body.body).name] = std::round(1e3 * body.energy_share) / 1e3;
  }
  Json json{{"name", mode.name},
            {"kind", dynamics::mode_kind_name(mode.kind)},
            {"period_s", json_number(mode.period())},
            {"frequency_Hz", mode.natural_frequency() / (2 * std::numbers::pi)},
            {"damping_ratio", mode.damping_ratio()},
            {"elastic_share", mode.elastic_share},
            {"energy_share_by_body", shares}};
  Json vibration = Json::object();
  for (const ElasticModeMotion& motion : mode.elastic_modes) {
    if (motion.energy_share >= 5e-4)
      vibration[mechanism.elastic_modes()[motion.mode].name] =
          std::round(1e3 * motion.energy_share) / 1e3;
  }
  if (!vibration.empty()) json["energy_share_by_elastic_mode"] = vibration;
  return json;
}

void write_shapes(ResultsWriter& file, const dynamics::Mechanism& mechanism,
                  const std::string& group, const std::vector<Mode>& modes) {
  if (modes.empty()) return;
  for (std::size_t b = 0; b < modes.front().bodies.size(); ++b) {
    RowMajorMatrix motion(static_cast<Eigen::Index>(modes.size()), 12);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const BodyModeMotion& body = modes[i].bodies[b];
      motion.row(i) << body.rotation.real().transpose(), body.displacement.real().transpose(),
          body.rotation.imag().transpose(), body.displacement.imag().transpose();
    }
    const std::string& name = mechanism.body(modes.front().bodies[b].body).name;
    file.write_matrix(
        layout::join(group, "bodies", name, "motion"), motion,
        {"rad, m",
         "complex amplitudes in the world, a row a mode: real parts of the rotation "
         "vector and of the displacement of the body's origin, then imaginary parts"});
  }
  for (std::size_t k = 0; k < modes.front().elastic_modes.size(); ++k) {
    RowMajorMatrix amplitude(static_cast<Eigen::Index>(modes.size()), 2);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const std::complex<double>& eta = modes[i].elastic_modes[k].amplitude;
      amplitude.row(i) << eta.real(), eta.imag();
    }
    const std::string& name = mechanism.elastic_modes()[modes.front().elastic_modes[k].mode].name;
    file.write_matrix(layout::join(group, "elastic_modes", name, "amplitude"), amplitude,
                      {"m",
                       "complex amplitude of the elastic mode's coordinate, a row a mode: real "
                       "part, imaginary part"});
  }
}

void write_instant(ResultsWriter& file, const dynamics::Mechanism& mechanism,
                   const std::string& group, const NaturalModes& modes) {
  const std::vector<Mode>& list = modes.linearisation.modes;
  std::vector<std::string> names, kinds;
  std::vector<double> periods, damping, elastic;
  RowMajorMatrix eigenvalues(static_cast<Eigen::Index>(list.size()), 2);
  for (std::size_t i = 0; i < list.size(); ++i) {
    names.push_back(list[i].name);
    kinds.emplace_back(dynamics::mode_kind_name(list[i].kind));
    periods.push_back(list[i].period());
    damping.push_back(list[i].damping_ratio());
    elastic.push_back(list[i].elastic_share);
    eigenvalues.row(i) << list[i].eigenvalue.real(), list[i].eigenvalue.imag();
  }
  file.make_group(group);
  file.write_attribute(group, "instant", modes.instant);
  file.write_attribute(group, "time", modes.linearisation.time);
  file.write_texts(layout::join(group, "names"), names, "the modes in words, slowest first");
  file.write_texts(layout::join(group, "kinds"), kinds,
                   "oscillating, overdamped, neutral (nothing brings it back) or unstable");
  file.write(layout::join(group, "period"), periods, {"s", "2 pi / |lambda|; infinite if neutral"});
  file.write(layout::join(group, "damping_ratio"), damping, {"1", "-Re(lambda) / |lambda|"});
  file.write(layout::join(group, "elastic_share"), elastic,
             {"1",
              "part of the restoring energy that is stored in ropes, springs, pads and bodies that "
              "give way"});
  file.write_matrix(layout::join(group, "eigenvalue"), eigenvalues,
                    {"s-1", "lambda, real and imaginary part"});
  write_shapes(file, mechanism, group, list);
}

}  // namespace

std::vector<NaturalModes> find_natural_modes(const BuiltLift& model,
                                             const dynamics::History& static_history,
                                             const Eigen::VectorXd& q_start, double interval) {
  const std::vector<Instant> instants = instants_of(model, static_history);
  std::vector<double> times;
  for (const Instant& instant : instants) times.push_back(instant.time);
  std::vector<dynamics::Linearisation> results =
      dynamics::linearise_sweep(model.at_rest(), times, q_start, interval, settings_at_rest(model));
  std::vector<NaturalModes> all;
  for (std::size_t i = 0; i < instants.size(); ++i)
    all.push_back({instants[i].name, std::move(results[i]), model.held_heading.has_value()});
  return all;
}

bool NaturalModes::is_turned_by_wind(const Mode& mode) const {
  return heading_is_held && mode.kind == dynamics::ModeKind::unstable &&
         mode.name.find("yaw") != std::string::npos;
}

namespace {

/// Its period, or how it goes on.
std::string words_for(const NaturalModes& modes, const Mode& mode) {
  if (mode.kind == dynamics::ModeKind::oscillating) return fmt::format("{:.3g} s", mode.period());
  if (modes.is_turned_by_wind(mode)) return "(turned by the wind, nothing holds it)";
  return fmt::format("({})", dynamics::mode_kind_name(mode.kind));
}

}  // namespace

std::string describe_natural_periods(const NaturalModes& modes) {
  constexpr std::size_t listed = 3;
  std::string text = "natural periods at the " + modes.instant + ":";
  const std::vector<Mode>& list = modes.linearisation.modes;
  if (list.empty()) text += " none, nothing is free to move";
  for (std::size_t i = 0; i < std::min(listed, list.size()); ++i) {
    const Mode& mode = list[i];
    text += fmt::format("{} {} {}", i > 0 ? "," : "", mode.name, words_for(modes, mode));
  }
  return text;
}

Json natural_periods_json(const dynamics::Mechanism& mechanism,
                          const std::vector<NaturalModes>& all) {
  Json list = Json::array();
  for (const NaturalModes& modes : all) {
    Json rows = Json::array();
    for (const Mode& mode : modes.linearisation.modes) {
      rows.push_back(mode_json(mechanism, mode));
      if (modes.is_turned_by_wind(mode)) rows.back()["turned_by_wind"] = true;
    }
    list.push_back(
        {{"instant", modes.instant}, {"time_s", modes.linearisation.time}, {"modes", rows}});
  }
  return list;
}

void write_natural_modes(ResultsWriter& file, const dynamics::Mechanism& mechanism,
                         const std::vector<NaturalModes>& all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    write_instant(file, mechanism, layout::join(layout::modes_group, std::to_string(i + 1)),
                  all[i]);
}

}  // namespace blocklift::pipeline

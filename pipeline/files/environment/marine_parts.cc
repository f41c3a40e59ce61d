#include "pipeline/files/environment/marine_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dynamics/errors.h"
#include "dynamics/marine/hull/hull_diagnosis.h"
#include "dynamics/marine/loads/draught_shares.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"
#include "pipeline/files/environment/sea_band.h"
#include "pipeline/files/environment/vessel_database.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/files/named_file.h"
#include "pipeline/formats/series_file.h"

namespace blocklift::pipeline {
namespace {

using dynamics::Sea;
using dynamics::WaveField;

WaveField make_waves(const MarineParts& parts, double gravity, const SeaBand& band) {
  const dynamics::Water water = water_of(*parts.sea, gravity);
  const given::Waves& waves = *parts.sea->waves;
  const dynamics::WaveRamp ramp{0.0, waves.ramp};
  if (waves.regular) {
    std::vector<dynamics::WaveComponent> components;
    for (const given::RegularWave& wave : *waves.regular) {
      components.push_back({wave.amplitude, wave.omega(), wave.heading, wave.phase});
    }
    return WaveField(water, components, ramp);
  }
  if (waves.spectrum) {
    const given::Spectrum& s = *waves.spectrum;
    dynamics::SeaRealisation how;
    how.heading = s.heading;
    how.spreading_exponent = s.spreading;
    how.components = s.components;
    how.seed = static_cast<std::uint64_t>(s.seed);
    how.frequencies = band.sea;
    how.ramp = ramp;
    return realise(make_spectrum(s), water, how);
  }
  dynamics::WaveRecord record = make_record(*waves.record);
  record.frequencies = band.sea;
  record.ramp = ramp;
  return realise(record, water);
}

dynamics::Current make_current(const given::Sea& sea, const dynamics::Water& water) {
  if (!sea.current) return {};
  const given::Current& current = *sea.current;
  switch (current.profile) {
    case CurrentProfile::tidal:
      return dynamics::Current::tidal(current.speed, current.towards, water.depth);
    case CurrentProfile::wind_driven:
      return dynamics::Current::wind_driven(current.speed, current.towards);
    case CurrentProfile::uniform:
      break;
  }
  return dynamics::Current::uniform(current.speed, current.towards);
}

void read_record(given::WaveRecord& record, const std::filesystem::path& folder,
                 Diagnostics& diagnostics) {
  const auto path = path_of_named_file(record.file, folder, diagnostics);
  if (!path) return;
  try {
    const SeriesFile series = read_series_file(*path);
    if (series.columns.size() != 2 || series.row_count() < 4) {
      throw SeriesFileError(fmt::format(
          "{} has {} columns and {} rows; a record has two columns, time in s and elevation in m, "
          "and at least four rows",
          record.file.value, series.columns.size(), series.row_count()));
    }
    const std::vector<double>& time = series.columns[0];
    const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
    for (std::size_t i = 1; i < time.size(); ++i) {
      if (step > 0 && std::abs(time[i] - time[i - 1] - step) < 1e-3 * step) continue;
      throw SeriesFileError(
          fmt::format("{}: the times {} s and {} s are not one step of {:.6g} s apart",
                      record.file.value, time[i - 1], time[i], step));
    }
    record.elevation = series.columns[1];
    record.time_step = step;
    record.start_time = time.front();
  } catch (const SeriesFileError& error) {
    diagnostics.error(record.file.mark, error.what(),
                      {"resample the record at even steps of time"});
  }
}

/// Complains if a hull's panels are too large for waves.
/// @param length of the waves, m. @param panels that must go into one of them.
void check_panels(const given::Vessel& vessel, const dynamics::Water& water, double length,
                  double panels, const Mark& mark, Diagnostics& diagnostics) {
  dynamics::HullDemands demands;
  demands.largest_warp = 0.5;
  demands.water_level = water_level_of(vessel, water);
  demands.shortest_wave_length = length;
  demands.panels_per_wave_length = panels;
  demands.most_of_a_kind = 1;
  using Kind = dynamics::HullDefectKind;
  for (const dynamics::HullDefect& defect : diagnose(vessel.model->hull, demands)) {
    const bool is_off_the_water =
        defect.kind == Kind::above_water || defect.kind == Kind::below_water;
    if (is_off_the_water && vessel.draught) continue;  // check_vessel says so of its draught
    std::vector<std::string> hints;
    if (defect.kind == Kind::large_panel)
      hints.emplace_back(
          "smaller panels (panel_size of the model), a longer wave, or a lower "
          "highest_frequency under radiation");
    diagnostics.error(mark, fmt::format("vessel {}: {}", vessel.name.value, defect.message),
                      std::move(hints));
  }
}

/// An irregular sea's shortest waves have little of its energy.
void check_panels(const given::Vessel& vessel, const WaveField& waves, const SeaBand& band,
                  const Mark& mark, Diagnostics& diagnostics) {
  const dynamics::Water& water = waves.water();
  const double shortest = waves.shortest_wave_length();
  if (!band.irregular) {
    check_panels(vessel, water, shortest, panels_in_middle_wave, mark, diagnostics);
    return;
  }
  const std::size_t errors_before = diagnostics.error_count();
  check_panels(vessel, water, shortest, panels_in_shortest_wave, mark, diagnostics);
  if (diagnostics.error_count() > errors_before) return;
  const double middle = std::clamp(band.middle, band.sea[0], band.sea[1]);
  check_panels(vessel, water, 2.0 * std::numbers::pi / dynamics::calc_wave_number(middle, water),
               panels_in_middle_wave, mark, diagnostics);
}

/// A database tells nothing of waves beyond its frequencies. Only regular ones may be there.
void check_frequencies(const MarineParts& parts, Diagnostics& diagnostics) {
  if (!parts.sea->waves->regular) return;
  for (const given::Vessel& vessel : parts.vessels) {
    if (vessel.radiation.value == RadiationMethod::none || !vessel.hydrodynamics) continue;
    const std::vector<double>& known = vessel.hydrodynamics->frequencies;
    for (const given::RegularWave& wave : *parts.sea->waves->regular) {
      const double omega = wave.omega();
      if (omega >= (1 - 1e-9) * known.front() && omega <= (1 + 1e-9) * known.back()) continue;
      const Mark& mark = wave.frequency ? wave.frequency->mark : wave.period->mark;
      diagnostics.error(mark,
                        fmt::format("the wave has {:.4g} rad/s, and the database {} has {:.4g} to "
                                    "{:.4g} rad/s",
                                    omega, vessel.database->value, known.front(), known.back()),
                        {"a wave within them, or a database that has its frequency"});
    }
    return;
  }
}

void check_sea(const MarineParts& parts, double gravity, Diagnostics& diagnostics) {
  const given::Sea& sea = *parts.sea;
  if (sea.current && sea.current->profile == CurrentProfile::tidal && !sea.depth) {
    diagnostics.error(sea.current->place, "a tidal current needs the depth of the sea");
    return;
  }
  const Mark& mark = sea.waves ? sea.waves->place : sea.place;
  try {
    if (!sea.waves) {
      make_sea(parts, gravity);
      return;
    }
    check_frequencies(parts, diagnostics);
    const SeaBand band = find_sea_band(parts, gravity);
    if (!check_sea_band(band, mark, diagnostics)) return;
    const Sea made = make_sea(parts, gravity, band);
    require_not_breaking(made.waves);
    for (const given::Vessel& vessel : parts.vessels) {
      if (vessel.model) check_panels(vessel, made.waves, band, mark, diagnostics);
    }
  } catch (const dynamics::ModelError& error) {
    diagnostics.error(mark, error.what());
  }
}

/// Of the vessel's frame, upright, by its own weight, m.
double floating_height(const given::Vessel& vessel, const given::Sea& sea) {
  return dynamics::find_floating_height(dynamics::HullClusters(vessel.model->hull),
                                        dynamics::Matrix3::Identity(),
                                        vessel.model->model.mass / sea.density);
}

void check_floating(const given::Vessel& vessel, const given::Sea& sea, Diagnostics& diagnostics) {
  if (!vessel.model) return;
  try {
    const double height = vessel.draught ? -vessel.draught->value : floating_height(vessel, sea);
    if (!sea.depth) return;
    const double keel = height + vessel.model->hull.bounds()[0].z();
    if (keel > -*sea.depth) return;
    diagnostics.error(
        vessel.draught ? vessel.draught->mark : vessel.name.mark,
        fmt::format("vessel {} reaches {:.4g} m below the water, which is {:.4g} m deep",
                    vessel.name.value, -keel, *sea.depth),
        {"a deeper sea, or a smaller draught"});
  } catch (const dynamics::ModelError& error) {
    diagnostics.error(vessel.name.mark, error.what());
  }
}

void check_vessel(const given::Vessel& vessel, Diagnostics& diagnostics) {
  if (vessel.name.value == "world" || vessel.name.value == "load") {
    diagnostics.error(vessel.name.mark,
                      fmt::format("a vessel cannot be named \"{}\"", vessel.name.value));
  }
  if (vessel.model && vessel.draughts) {
    check_draughts("vessel " + vessel.name.value, *vessel.draughts, *vessel.model, diagnostics);
  }
  if (!vessel.model || !vessel.draught) return;
  const auto [low, high] = vessel.model->hull.bounds();
  if (std::isnan(vessel.draught->value)) return;  // the reader has complained
  if (vessel.draught->value > low.z() && vessel.draught->value < high.z()) return;
  diagnostics.error(
      vessel.draught->mark,
      fmt::format("vessel {} would float at a draught of {:.4g} m, and its hull reaches "
                  "from {:.4g} m to {:.4g} m above its base",
                  vessel.name.value, vessel.draught->value, low.z(), high.z()),
      {"a draught between the two: hulls wholly above or under the water are not computed"});
}

/// Draughts belong to databases, and to one vessel.
void check_lowered(const std::vector<given::Vessel>& vessels, Diagnostics& diagnostics) {
  const given::Vessel* lowered = nullptr;
  for (const given::Vessel& vessel : vessels) {
    if (!vessel.draughts) continue;
    const std::string& name = vessel.name.value;
    if (vessel.radiation.value != RadiationMethod::database) {
      diagnostics.error(
          vessel.draughts->mark,
          fmt::format("vessel {} has draughts, and its radiation is {}", name,
                      vessel.radiation.value == RadiationMethod::direct ? "direct" : "none"),
          {"draughts are interpolated between databases: radiation: database"});
    }
    if (lowered) {
      diagnostics.error(vessel.draughts->mark,
                        fmt::format("vessel {} has draughts, as {} has", name, lowered->name.value),
                        {"one body may be lowered into the water that they share"});
    }
    lowered = &vessel;
  }
}

/// There is one surface of the water.
void check_radiation(const std::vector<given::Vessel>& vessels, Diagnostics& diagnostics) {
  check_lowered(vessels, diagnostics);
  const given::Vessel* first = nullptr;
  for (const given::Vessel& vessel : vessels) {
    if (vessel.radiation.value == RadiationMethod::none) continue;
    if (!first) first = &vessel;
    if (vessel.radiation.value == first->radiation.value) continue;
    diagnostics.error(
        vessel.radiation.mark,
        fmt::format("vessels {} and {} radiate in different ways", first->name.value,
                    vessel.name.value),
        {"they share one water: give all that make waves radiation: database, or all direct"});
    return;
  }
}

/// A surface that is marched beside the vessels, and a database that is given, are of one method.
void check_method(const MarineParts& parts, Diagnostics& diagnostics) {
  if (!parts.sea) return;
  const Located<dynamics::PanelMethod>& method = parts.sea->radiation.method;
  if (method.value == dynamics::PanelMethod::marched_surface) return;
  bool computed = false;
  for (const given::Vessel& vessel : parts.vessels) {
    if (vessel.radiation.value == RadiationMethod::none) continue;
    computed = true;
    const std::string& name = vessel.name.value;
    if (vessel.radiation.value == RadiationMethod::direct) {
      diagnostics.error(method.mark,
                        fmt::format("the method is green function, and vessel {} has radiation: "
                                    "direct, for which the surface is marched",
                                    name),
                        {"radiation: database, or method: marched surface"});
      return;
    }
    if (vessel.database) {
      diagnostics.error(
          method.mark,
          fmt::format("the method is given, and the database of vessel {} too: nothing is computed",
                      name),
          {"leave out one of them"});
      return;
    }
  }
  if (computed) return;
  diagnostics.error(method.mark, "the method is given, and no vessel makes waves",
                    {"radiation: database, or leave it out"});
}

/// Drift needs mean forces: of one vessel alone from its far field, or of its database.
void check_drift(const std::vector<given::Vessel>& vessels, Diagnostics& diagnostics) {
  const auto radiating = std::count_if(vessels.begin(), vessels.end(), [](const auto& vessel) {
    return vessel.radiation.value != RadiationMethod::none;
  });
  for (const given::Vessel& vessel : vessels) {
    if (vessel.drift.value == DriftMethod::none) continue;
    const std::string& name = vessel.name.value;
    const auto refuse = [&](const std::string& why, const std::string& hint) {
      diagnostics.error(vessel.drift.mark, fmt::format("vessel {} drifts, {}", name, why), {hint});
    };
    if (vessel.radiation.value != RadiationMethod::database) {
      refuse("and its radiation is " +
                 std::string(vessel.radiation.value == RadiationMethod::none ? "none" : "direct"),
             "mean drift forces come with a database: radiation: database");
    } else if (vessel.draughts) {
      refuse("and is lowered: its draughts have no mean drift forces",
             "leave out one of drift and draughts");
    } else if (vessel.database) {
      if (vessel.hydrodynamics && vessel.hydrodynamics->mean_drift.empty()) {
        refuse(
            fmt::format("and the database {} holds no mean drift forces", vessel.database->value),
            "blocklift hydro computes them where the vessel's hydrodynamics say mean_drift: "
            "true; other programs' files have them in .7, .8, .9 or mean_drift");
      }
    } else if (radiating > 1) {
      refuse("and shares its water: the waves far away tell the drift of all vessels together only",
             "name a database that holds mean drift forces of each, or leave out drift");
    }
  }
}

class LineChecker {
 public:
  LineChecker(const MarineParts& parts, const std::vector<std::string>& bodies,
              Diagnostics& diagnostics)
      : known_(bodies), diagnostics_(diagnostics) {
    for (const given::Vessel& vessel : parts.vessels) known_.push_back(vessel.name.value);
  }

  void check(const std::string& line, const PointModel& from, const PointModel& to) {
    for (const PointModel* point : {&from, &to}) {
      const std::string& body = point->body.value;
      if (body.empty() || body == "world" ||
          std::find(known_.begin(), known_.end(), body) != known_.end()) {
        continue;
      }
      std::vector<std::string> known = {"world"};
      known.insert(known.end(), known_.begin(), known_.end());
      diagnostics_.error(point->body.mark,
                         fmt::format("{} ends at body \"{}\", which does not exist", line, body),
                         {names_hint("the bodies are", known, body)});
    }
    if (!from.body.value.empty() && from.body.value == to.body.value) {
      diagnostics_.error(from.body.mark, fmt::format("{} has both ends on one body", line));
    }
  }

 private:
  std::vector<std::string> known_;
  Diagnostics& diagnostics_;
};

}  // namespace

double given::RegularWave::omega() const {
  if (frequency) return frequency->value;
  return period ? 2.0 * std::numbers::pi / period->value : std::numeric_limits<double>::quiet_NaN();
}

Eigen::Matrix<double, 6, 1> given::Damping::vector() const {
  Eigen::Matrix<double, 6, 1> values;
  values << roll, pitch, yaw, surge, sway, heave;
  return values;
}

void check_draughts(const std::string& who, const Located<std::vector<double>>& draughts,
                    const Vessel& vessel, Diagnostics& diagnostics) {
  if (draughts.value.empty()) return;  // the reader has complained
  const auto [low, high] = vessel.hull.bounds();
  const double depth = high.z() - low.z(), deepest = draughts.value.back();
  if (deepest >= depth) {
    diagnostics.error(
        draughts.mark,
        fmt::format("the deepest draught of {} is {:.4g} m, and its hull is {:.4g} m deep", who,
                    deepest, depth),
        {"draughts count from the lowest point of the hull, and end below its deck"});
  }
  constexpr std::size_t most = dynamics::most_draughts - 1;
  if (draughts.value.size() > most) {
    diagnostics.error(draughts.mark, fmt::format("{} has {} draughts; at most {} are interpolated",
                                                 who, draughts.value.size(), most));
  }
}

const given::Vessel* MarineParts::find_vessel(const std::string& name) const {
  const auto found = std::find_if(vessels.begin(), vessels.end(), [&](const given::Vessel& vessel) {
    return vessel.name.value == name;
  });
  return found == vessels.end() ? nullptr : &*found;
}

void load_marine_models(MarineParts& parts, const std::filesystem::path& beside,
                        ModelLibrary& library, Diagnostics& diagnostics) {
  for (given::Vessel& vessel : parts.vessels) {
    if (vessel.model_name.value.empty()) continue;
    vessel.model = library.load_vessel(vessel.model_name, beside, diagnostics);
  }
  load_vessel_databases(parts.vessels, beside, diagnostics);
  if (parts.sea && parts.sea->waves && parts.sea->waves->record) {
    read_record(*parts.sea->waves->record, beside, diagnostics);
  }
}

void check_marine_parts(const MarineParts& parts, double gravity,
                        const std::vector<std::string>& bodies, Diagnostics& diagnostics) {
  const bool sound_so_far = !diagnostics.has_errors();
  if (!parts.vessels.empty() && !parts.sea) {
    diagnostics.error(parts.vessels.front().name.mark,
                      fmt::format("vessel {} floats in no sea", parts.vessels.front().name.value),
                      {"add sea: {} for calm deep sea water"});
  }
  for (const given::Vessel& vessel : parts.vessels) check_vessel(vessel, diagnostics);
  check_radiation(parts.vessels, diagnostics);
  check_method(parts, diagnostics);
  check_vessel_databases(parts, gravity, diagnostics);
  check_drift(parts.vessels, diagnostics);
  check_linear_buoyancy(parts.vessels, parts.sea && parts.sea->waves, diagnostics);
  if (parts.sea && sound_so_far) {
    check_sea(parts, gravity, diagnostics);
    for (const given::Vessel& vessel : parts.vessels) {
      check_floating(vessel, *parts.sea, diagnostics);
    }
  }
  LineChecker lines(parts, bodies, diagnostics);
  for (const given::Mooring& mooring : parts.moorings) {
    lines.check("mooring " + mooring.name.value, mooring.anchor, mooring.fairlead);
  }
  for (const given::Tugger& tugger : parts.tuggers) {
    lines.check("tugger line " + tugger.name.value, tugger.from, tugger.to);
  }
}

std::vector<PlacedHull> place_hulls(const MarineParts& parts) {
  std::vector<PlacedHull> hulls;
  for (const given::Vessel& vessel : parts.vessels) {
    const dynamics::Hull& hull = vessel.model->hull;
    const double height =
        vessel.draught ? -vessel.draught->value : floating_height(vessel, *parts.sea);
    hulls.push_back({"vessel " + vessel.name.value,
                     vessel.name.mark,
                     &hull,
                     {dynamics::rotation_about(Vector3::UnitZ(), vessel.heading),
                      {vessel.position[0], vessel.position[1], height}}});
  }
  return hulls;
}

Sea make_sea(const MarineParts& parts, double gravity, bool at_rest) {
  if (parts.sea->waves && !at_rest) return make_sea(parts, gravity, find_sea_band(parts, gravity));
  const dynamics::Water water = water_of(*parts.sea, gravity);
  return {WaveField(water), make_current(*parts.sea, water)};
}

Sea make_sea(const MarineParts& parts, double gravity, const SeaBand& band) {
  const dynamics::Water water = water_of(*parts.sea, gravity);
  return {parts.sea->waves ? make_waves(parts, gravity, band) : WaveField(water),
          make_current(*parts.sea, water)};
}

}  // namespace blocklift::pipeline

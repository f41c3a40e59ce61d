#include "pipeline/files/environment/sea_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "dynamics/marine/hull/floating_position.h"
#include "dynamics/marine/hull/hull.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::pipeline {
namespace {

using dynamics::WaveSpectrum;
using Ends = std::array<double, 2>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double lowest_radiation_by_itself = 0.1;  // rad/s
// Of the energy, at the low and the high end; at an end that the file gives, of the spectrum.
constexpr double left_out_below = 1e-3, left_out_above = 4e-3;

/// How the energy of a sea lies over the frequencies, m2.
class SeaEnergy {
 public:
  SeaEnergy(const given::Waves& waves, const dynamics::Water& water) {
    if (waves.spectrum) {
      spectrum_ = make_spectrum(*waves.spectrum);
      all_ = spectrum_->moment(0);
      return;
    }
    dynamics::WaveRecord whole = make_record(*waves.record);
    whole.frequencies.reset();
    const dynamics::WaveField field = realise(whole, water);
    for (std::size_t k = 0; k < field.component_count(); ++k) {
      const dynamics::WaveComponent wave = field.component(k);
      all_ += 0.5 * wave.amplitude * wave.amplitude;
      waves_.push_back({wave.omega, all_});
    }
  }

  double all() const { return all_; }

  double between(double low, double high) const {
    if (!(high > low)) return 0;
    if (spectrum_) return spectrum_->energy_between(low, high);
    double sum = 0, before = 0;
    for (const auto& [omega, up_to] : waves_) {
      if (omega >= low && omega <= high) sum += up_to - before;
      before = up_to;
    }
    return sum;
  }

  /// The frequency below which this share of the energy lies, rad/s.
  double below(double share) const {
    if (spectrum_) return spectrum_->range(share)[0];
    const auto found = std::find_if(waves_.begin(), waves_.end(), [&](const Wave& wave) {
      return wave.energy_up_to > share * all_;
    });
    return found == waves_.end() ? waves_.back().omega : found->omega;
  }

 private:
  struct Wave {
    double omega, energy_up_to;  ///< rad/s; with its own, m2
  };
  std::optional<WaveSpectrum> spectrum_;
  std::vector<Wave> waves_;
  double all_ = 0;
};

/// The longest distance of two corners of a panel that lies in the water, at least in part, m.
double widest_wet_panel(const dynamics::Hull& hull, double water_level) {
  double widest = 0;
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const std::span<const int> corners = hull.panel(panel);
    const bool wet = std::ranges::any_of(
        corners, [&](int corner) { return hull.vertex(corner).z() < water_level; });
    if (!wet) continue;
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        widest = std::max(widest, (hull.vertex(corners[i]) - hull.vertex(corners[j])).norm());
  }
  return widest;
}

double frequency_of_length(double length, const dynamics::Water& water) {
  const double k = 2.0 * std::numbers::pi / length;
  return std::sqrt(water.gravity * k * std::tanh(k * water.depth));
}

/// The highest frequency that the panels of all hulls carry.
struct Carried {
  double highest = infinity;  ///< rad/s
  std::string hull;           ///< whose panels end it
  double widest = 0;          ///< of its panels, m
};

Carried find_carried(const MarineParts& parts, const dynamics::Water& water) {
  Carried carried;
  const auto take = [&](const std::string& hull, const Vessel& vessel, double level) {
    const double widest = widest_wet_panel(vessel.hull, level);
    if (widest <= carried.widest) return;
    // What is cut at the water line may be wider by round-off.
    constexpr double margin = 1.001;
    carried = {frequency_of_length(margin * panels_in_shortest_wave * widest, water), hull, widest};
  };
  for (const given::Vessel& vessel : parts.vessels)
    if (vessel.model)
      take("vessel " + vessel.name.value, *vessel.model, water_level_of(vessel, water));
  if (const Vessel* load = parts.lowered_load.get())
    take("the load", *load, load->hull.bounds()[0].z() + parts.deepest_draught_of_load);
  return carried;
}

const dynamics::HydrodynamicDatabase* find_given(const MarineParts& parts) {
  for (const given::Vessel& vessel : parts.vessels)
    if (vessel.radiation.value != RadiationMethod::none && vessel.hydrodynamics)
      return vessel.hydrodynamics.get();
  return nullptr;
}

bool computes_radiation(const MarineParts& parts) {
  return parts.lowered_load ||
         std::any_of(parts.vessels.begin(), parts.vessels.end(), [](const given::Vessel& vessel) {
           return vessel.radiation.value != RadiationMethod::none;
         });
}

class BandFinder {
 public:
  BandFinder(const MarineParts& parts, double gravity)
      : parts_(parts),
        settings_(parts.sea->radiation),
        water_(water_of(*parts.sea, gravity)),
        energy_(*parts.sea->waves, water_) {
    if (const auto& record = parts.sea->waves->record) {
      lowest_ = record->lowest;
      highest_ = record->highest;
    }
    if (!lowest_) lowest_ = settings_.lowest;
    if (!highest_) highest_ = settings_.highest;
  }

  SeaBand find() {
    SeaBand band;
    band.irregular = true;
    band.height = 4.0 * std::sqrt(energy_.all());
    band.radiation = {settings_.lowest.value_or(usual_radiation[0]),
                      settings_.highest.value_or(usual_radiation[1])};
    if (!(energy_.all() > 0)) {
      band.sea = band.radiation;
      return band;
    }
    asked_ = {std::max(energy_.below(left_out_below), lowest_.value_or(0)),
              std::min(energy_.below(1 - (highest_ ? left_out_below : left_out_above)),
                       highest_.value_or(infinity))};
    band.sea = asked_;
    if (!highest_) carried_ = find_carried(parts_, water_);
    if (const dynamics::HydrodynamicDatabase* given = find_given(parts_)) {
      cut(band.sea, {given->frequencies.front(), given->frequencies.back()});
    } else if (computes_radiation(parts_)) {
      widen(band.radiation);
      cut(band.sea, band.radiation);
    }
    cut(band.sea, {0, carried_.highest});
    band.middle = energy_.below(0.5);
    band.kept = std::sqrt(energy_.between(band.sea[0], band.sea[1]) / energy_.all());
    const double given = energy_.between(lowest_.value_or(0), highest_.value_or(infinity));
    band.kept_of_given =
        given > 0 ? std::sqrt(energy_.between(band.sea[0], band.sea[1]) / given) : 0;
    say_cut(band);
    return band;
  }

 private:
  static void cut(Ends& ends, const Ends& within) {
    ends = {std::max(ends[0], within[0]), std::min(ends[1], within[1])};
  }

  /// Widens the ends of the radiation that the file does not give, if the sea loses by them.
  void widen(Ends& ends) const {
    Ends usual = asked_;
    cut(usual, ends);
    const double least = kept_without_doubt * kept_without_doubt;
    if (energy_.between(usual[0], usual[1]) >= least * energy_.all()) return;
    // Steps, so that seas that differ little have one database.
    if (!settings_.lowest && asked_[0] < ends[0])
      ends[0] = std::max(lowest_radiation_by_itself, 0.05 * std::floor(asked_[0] / 0.05));
    if (!settings_.highest && asked_[1] > ends[1]) {
      const double carried = highest_ ? infinity : 0.05 * std::floor(carried_.highest / 0.05);
      ends[1] = std::max(ends[1], std::min(0.1 * std::ceil(asked_[1] / 0.1), carried));
    }
  }

  void say_cut(SeaBand& band) const {
    const bool at_low_end =
        energy_.between(0, band.sea[0]) > energy_.between(band.sea[1], infinity);
    const dynamics::HydrodynamicDatabase* given = find_given(parts_);
    const char* const key = at_low_end ? "lowest_frequency" : "highest_frequency";
    const auto& said = at_low_end ? lowest_ : highest_;
    const double end = band.sea[at_low_end ? 0 : 1];
    if (said && std::abs(*said - end) <= 1e-9 * end) {
      band.cut_by = fmt::format("{} is {:.4g} rad/s", key, *said);
      band.hint = fmt::format("{} {} under radiation (or of the record)",
                              at_low_end ? "a lower" : "a higher", key);
    } else if (given && (at_low_end ? end <= given->frequencies.front()
                                    : end >= given->frequencies.back())) {
      band.cut_by =
          fmt::format("the database {} at {:.4g} rad/s", at_low_end ? "begins" : "ends", end);
      band.hint = fmt::format(
          "a database of all frequencies that the sea has, from {:.3g} to {:.3g} rad/s, or {} "
          "under radiation, which says that the others may be left out",
          asked_[0], asked_[1], key);
    } else if (!at_low_end && carried_.widest > 0) {
      band.cut_by =
          fmt::format("panels of {} are up to {:.3g} m wide, and three must go into a wave",
                      carried_.hull, carried_.widest);
      band.hint =
          "smaller panels (panel_size of the model), or highest_frequency under radiation, which "
          "says that shorter waves may be left out";
    } else {
      band.cut_by =
          fmt::format("radiation {} at {:.4g} rad/s", at_low_end ? "begins" : "ends", end);
      band.hint = fmt::format("{} under radiation", key);
    }
  }

  const MarineParts& parts_;
  const RadiationSettings& settings_;
  dynamics::Water water_;
  SeaEnergy energy_;
  std::optional<double> lowest_, highest_;  ///< that the file gives
  Ends asked_{};
  Carried carried_;
};

std::string band_text(const SeaBand& band) {
  return fmt::format("{:.3g} to {:.3g} rad/s", band.sea[0], band.sea[1]);
}

}  // namespace

WaveSpectrum make_spectrum(const given::Spectrum& s) {
  switch (s.shape) {
    case SpectrumShape::jonswap:
      return WaveSpectrum::jonswap(s.significant_height->value, s.peak_period->value,
                                   s.peakedness ? s.peakedness->value : 3.3);
    case SpectrumShape::pierson_moskowitz:
      return WaveSpectrum::pierson_moskowitz(s.significant_height->value, s.peak_period->value);
    case SpectrumShape::issc:
      return WaveSpectrum::issc(s.significant_height->value, s.mean_period->value);
    case SpectrumShape::table:
      break;
  }
  std::vector<double> omega, density;
  for (const auto& point : s.table->value) {
    omega.push_back(point[0].value);
    density.push_back(point[1].value);
  }
  return WaveSpectrum::table(std::move(omega), std::move(density));
}

dynamics::WaveRecord make_record(const given::WaveRecord& r) {
  dynamics::WaveRecord record;
  record.elevation = r.elevation;
  record.time_step = r.time_step;
  record.start_time = r.start_time;
  record.heading = r.heading;
  return record;
}

dynamics::Water water_of(const given::Sea& sea, double gravity) {
  dynamics::Water water;
  water.density = sea.density;
  water.gravity = gravity;
  if (sea.depth) water.depth = *sea.depth;
  return water;
}

double water_level_of(const given::Vessel& vessel, const dynamics::Water& water) {
  const dynamics::Hull& hull = vessel.model->hull;
  if (vessel.draughts && !vessel.draughts->value.empty())
    return hull.bounds()[0].z() + vessel.draughts->value.back();
  if (vessel.draught) return vessel.draught->value;
  const VesselModel& model = vessel.model->model;
  return -dynamics::find_floating_position(dynamics::HullClusters(hull),
                                           {model.mass, model.centre_of_mass, water.density})
              .X_WB.p.z();
}

SeaBand find_sea_band(const MarineParts& parts, double gravity) {
  const given::Sea& sea = *parts.sea;
  const RadiationSettings& settings = sea.radiation;
  SeaBand band;
  band.radiation = {settings.lowest.value_or(usual_radiation[0]),
                    settings.highest.value_or(usual_radiation[1])};
  const Ends as_given = band.radiation;
  if (sea.waves && !sea.waves->regular) band = BandFinder(parts, gravity).find();
  band.frequencies = settings.frequencies;
  if (band.radiation != as_given) {
    const double times = (band.radiation[1] - band.radiation[0]) / (as_given[1] - as_given[0]);
    band.frequencies = 1 + static_cast<int>(std::ceil((settings.frequencies - 1) * times - 1e-9));
  }
  return band;
}

std::string describe_sea(const MarineParts& parts, double gravity) {
  if (!parts.sea || !parts.sea->waves || parts.sea->waves->regular) return {};
  const SeaBand band = find_sea_band(parts, gravity);
  return fmt::format(
      "The irregular sea has waves of {}. Their significant height is {:.4g} m, {:.1f} % of the "
      "{:.4g} m {}.",
      band_text(band), band.kept * band.height, 100 * band.kept, band.height,
      parts.sea->waves->record ? "of the record" : "of the spectrum");
}

std::string doubt_about_sea(const MarineParts& parts, double gravity) {
  if (!parts.sea || !parts.sea->waves || parts.sea->waves->regular) return {};
  const SeaBand band = find_sea_band(parts, gravity);
  if (band.kept >= kept_without_doubt) return {};
  return fmt::format(
      "The sea has {:.1f} % of its significant height, {:.3g} m of {:.3g} m, for its waves are "
      "those of {} alone: {}.",
      100 * band.kept, band.kept * band.height, band.height, band_text(band), band.cut_by);
}

bool check_sea_band(const SeaBand& band, const Mark& mark, Diagnostics& diagnostics) {
  if (!band.irregular) return true;
  if (band.sea[0] < band.sea[1] && band.kept_of_given >= kept_at_least) return true;
  const std::string what =
      band.sea[0] < band.sea[1] ? fmt::format("those of {}", band_text(band)) : std::string("none");
  diagnostics.error(mark,
                    fmt::format("of the sea's waves {} are left, with {:.0f} % of its significant "
                                "height: {}",
                                what, 100 * band.kept, band.cut_by),
                    {band.hint});
  return false;
}

}  // namespace blocklift::pipeline

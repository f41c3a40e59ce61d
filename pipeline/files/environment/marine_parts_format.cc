#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "dynamics/force/linear_restraint.h"
#include "pipeline/files/environment/marine_parts.h"
#include "pipeline/files/environment/sea_band.h"

namespace blocklift::pipeline {
namespace {

Format<given::RegularWave> regular_wave_format() {
  Table<given::RegularWave> table("regular wave", "An Airy wave.");
  table
      .required("amplitude", &given::RegularWave::amplitude,
                quantity(Dimension::length, Range::positive()), "half its height")
      .optional("frequency", &given::RegularWave::frequency,
                quantity(Dimension::angular_speed, Range::positive()), "angular frequency")
      .optional("period", &given::RegularWave::period, quantity(Dimension::time, Range::positive()),
                "in place of the frequency")
      .by_default("heading", &given::RegularWave::heading, quantity(Dimension::angle), "0 deg",
                  "where it travels to, from +x towards +y")
      .by_default("phase", &given::RegularWave::phase, quantity(Dimension::angle), "0 deg",
                  "at the origin when the operation begins")
      .rule([](const given::RegularWave& wave, Reading& reading, const Mark& mark) {
        if (wave.frequency.has_value() != wave.period.has_value()) return;
        reading.error(mark, "a regular wave needs either its frequency or its period");
      });
  return table.format();
}

void check_spectrum(const given::Spectrum& spectrum, Reading& reading, const Mark& mark) {
  const auto require = [&](bool given, const char* key) {
    if (!given) {
      reading.error(mark, std::string("a spectrum of this shape lacks the key \"") + key + "\"");
    }
  };
  const auto refuse = [&](bool given, const char* key) {
    if (given) {
      reading.error(mark, std::string("a spectrum of this shape has no key \"") + key + "\"",
                    {"jonswap and pierson_moskowitz take significant_height and peak_period, issc "
                     "significant_height and mean_period, table its table"});
    }
  };
  const bool tabulated = spectrum.shape == SpectrumShape::table;
  const bool by_mean = spectrum.shape == SpectrumShape::issc;
  if (tabulated) {
    require(spectrum.table.has_value(), "table");
    refuse(spectrum.significant_height.has_value(), "significant_height");
  } else {
    require(spectrum.significant_height.has_value(), "significant_height");
    refuse(spectrum.table.has_value(), "table");
  }
  if (by_mean) require(spectrum.mean_period.has_value(), "mean_period");
  if (!by_mean) refuse(spectrum.mean_period.has_value(), "mean_period");
  if (!by_mean && !tabulated) require(spectrum.peak_period.has_value(), "peak_period");
  if (by_mean || tabulated) refuse(spectrum.peak_period.has_value(), "peak_period");
  if (spectrum.shape != SpectrumShape::jonswap && spectrum.peakedness) {
    reading.error(spectrum.peakedness->mark, "a spectrum of this shape has no key \"peakedness\"",
                  {"it is that of jonswap; 1 makes it pierson_moskowitz"});
  }
}

Format<given::Spectrum> spectrum_format() {
  Table<given::Spectrum> table("wave spectrum", "An irregular sea of many Airy waves.");
  const auto pair =
      array_of<Quantity, 2>(quantity_of({Dimension::angular_speed, Dimension::wave_spectrum}));
  table
      .by_default("shape", &given::Spectrum::shape,
                  choice<SpectrumShape>({{"jonswap", SpectrumShape::jonswap},
                                         {"pierson_moskowitz", SpectrumShape::pierson_moskowitz},
                                         {"issc", SpectrumShape::issc},
                                         {"table", SpectrumShape::table}}),
                  "jonswap", "of the spectrum")
      .optional("significant_height", &given::Spectrum::significant_height,
                quantity(Dimension::length, Range::positive()), "four times the deviation")
      .optional("peak_period", &given::Spectrum::peak_period,
                quantity(Dimension::time, Range::positive()), "of jonswap and pierson_moskowitz")
      .optional("mean_period", &given::Spectrum::mean_period,
                quantity(Dimension::time, Range::positive()), "T1 of issc")
      .optional("peakedness", &given::Spectrum::peakedness, located(number(Range::between(1, 10))),
                "gamma of jonswap; 3.3 if left out")
      .optional("table", &given::Spectrum::table, list_of(pair, 2),
                "points [[0.5 rad/s, 0.8 m^2 s/rad], ...], linear between")
      .by_default("heading", &given::Spectrum::heading, quantity(Dimension::angle), "0 deg",
                  "where the waves travel to, from +x towards +y")
      .optional("spreading", &given::Spectrum::spreading, number(Range::positive()),
                "exponent n of the spreading cos^n about the heading; long-crested if left out")
      .by_default("components", &given::Spectrum::components, integer(Range::between(1, 2000)),
                  "100", "regular waves that the sea is made of")
      .by_default("seed", &given::Spectrum::seed, integer(Range::not_negative()), "1",
                  "of the random phases: the same seed makes the same sea")
      .place(&given::Spectrum::place)
      .rule(check_spectrum);
  return table.format();
}

Format<given::WaveRecord> wave_record_format() {
  Table<given::WaveRecord> table("wave record", "A measured elevation of the surface.");
  table
      .required("file", &given::WaveRecord::file, located(text()),
                "beside this file: CSV of time in s, at even steps, and elevation in m")
      .by_default("heading", &given::WaveRecord::heading, quantity(Dimension::angle), "0 deg",
                  "where the waves travel to, from +x towards +y")
      .optional("lowest_frequency", &given::WaveRecord::lowest,
                quantity(Dimension::angular_speed, Range::positive()), "that is kept")
      .optional("highest_frequency", &given::WaveRecord::highest,
                quantity(Dimension::angular_speed, Range::positive()), "that is kept");
  return table.format();
}

Format<given::Waves> waves_format() {
  using Waves = std::vector<given::RegularWave>;
  const auto one = converted<given::RegularWave, Waves>(
      regular_wave_format(), [](given::RegularWave wave) { return Waves{std::move(wave)}; });
  Table<given::Waves> table("waves", "Linear waves: regular ones, a spectrum, or a record.");
  table
      .optional("regular", &given::Waves::regular,
                by_shape<Waves>(std::nullopt, list_of(regular_wave_format(), 1), one),
                "one wave, or a list of them")
      .optional("spectrum", &given::Waves::spectrum, spectrum_format(), "an irregular sea")
      .optional("record", &given::Waves::record, wave_record_format(), "a measured sea")
      .by_default("ramp", &given::Waves::ramp, quantity(Dimension::time, Range::not_negative()),
                  "0 s", "time over which the waves grow at the start")
      .place(&given::Waves::place)
      .rule([](const given::Waves& waves, Reading& reading, const Mark& mark) {
        const int given =
            (waves.regular ? 1 : 0) + (waves.spectrum ? 1 : 0) + (waves.record ? 1 : 0);
        if (given == 1) return;
        reading.error(mark,
                      given == 0 ? "the waves are not described" : "the waves are described twice",
                      {"give one of regular, spectrum and record"});
      });
  return table.format();
}

Format<given::Current> current_format() {
  Table<given::Current> table("current", "Steady level flow of the water.");
  table
      .required("speed", &given::Current::speed, quantity(Dimension::speed, Range::not_negative()),
                "at the surface")
      .required("towards", &given::Current::towards, quantity(Dimension::angle),
                "where it flows to, from +x towards +y")
      .by_default(
          "profile", &given::Current::profile,
          choice<CurrentProfile>({{"uniform", CurrentProfile::uniform},
                                  {"tidal", CurrentProfile::tidal},
                                  {"wind_driven", CurrentProfile::wind_driven}}),
          "uniform",
          "over the depth: the same, to the power of 1/7 down to the bottom, or linear down "
          "to 50 m")
      .place(&given::Current::place);
  return table.format();
}

Format<RadiationSettings> radiation_settings_format() {
  Table<RadiationSettings> table("radiation settings",
                                 "For what the waves that vessels make are computed.");
  const auto frequency = quantity(Dimension::angular_speed, Range::positive());
  table
      .optional("lowest_frequency", &RadiationSettings::lowest, frequency,
                "that the waves and motions have; 0.3 rad/s if left out, less where an irregular "
                "sea asks for it")
      .optional("highest_frequency", &RadiationSettings::highest, frequency,
                "that the waves and motions have; its waves must be longer than three panels. 1.2 "
                "rad/s if left out, more where an irregular sea asks for it")
      .by_default("frequencies", &RadiationSettings::frequencies, integer(Range::between(2, 200)),
                  "19",
                  "at which diffraction is computed, evenly between; those of regular waves "
                  "are added, and where a sea widens the range they keep their distance")
      .by_default("method", &RadiationSettings::method, located(panel_method_format()),
                  "marched surface", panel_method_purpose)
      .optional("lids", &RadiationSettings::lids, located(list_of(lid_format())),
                "rectangles on which waves fade, for water in gaps and moonpools that would swing "
                "on, where the vessels are at the start; a database has its own")
      .place(&RadiationSettings::place)
      .rule([](const RadiationSettings& settings, Reading& reading, const Mark& mark) {
        if (settings.lowest.value_or(usual_radiation[0]) <
            settings.highest.value_or(usual_radiation[1]))
          return;
        reading.error(mark, "the lowest frequency is not below the highest");
      });
  return table.format();
}

Format<given::Damping> damping_format(const char* noun, Dimension linear, Dimension angular) {
  Table<given::Damping> table(noun, "For each motion of the vessel, along and about its axes.");
  const auto along = quantity(linear, Range::not_negative());
  const auto about = quantity(angular, Range::not_negative());
  const std::string zero = linear == Dimension::damping ? "0 kN s/m" : "0 kg/m";
  const std::string zero_turn =
      angular == Dimension::rotational_damping ? "0 kN m s/rad" : "0 kN m s^2/rad^2";
  table.by_default("surge", &given::Damping::surge, along, zero, "along x")
      .by_default("sway", &given::Damping::sway, along, zero, "along y")
      .by_default("heave", &given::Damping::heave, along, zero, "along z")
      .by_default("roll", &given::Damping::roll, about, zero_turn, "about x")
      .by_default("pitch", &given::Damping::pitch, about, zero_turn, "about y")
      .by_default("yaw", &given::Damping::yaw, about, zero_turn, "about z");
  return table.format();
}

void check_restraint(const given::Restraint& restraint, Reading& reading, const Mark& mark) {
  if (!restraint.stiffness && !restraint.damping) {
    reading.error(mark, "a restraint needs its stiffness or its damping");
  }
  check_matrix("stiffness", restraint.stiffness, stiffness_dimensions, reading);
  check_matrix("damping", restraint.damping, damping_dimensions, reading);
  const auto damping = given::Restraint::matrix(restraint.damping);
  if (restraint.damping && dynamics::LinearRestraint::adds_energy(damping)) {
    reading.error(restraint.damping->mark,
                  "the damping adds energy to some motions: its symmetric part has a negative "
                  "eigenvalue");
  }
  if (!restraint.stiffness || !restraint.symmetric) return;
  check_symmetric(*restraint.stiffness,
                  "such a spring gives or takes energy on closed paths; \"symmetric: false\" "
                  "allows it",
                  reading);
}

Format<given::Restraint> restraint_format() {
  Table<given::Restraint> table(
      "restraint",
      "Spring and damper of all six freedoms between a vessel and its place at the start by "
      "position, heading and draught, where the spring is free of force. Rows and columns: surge, "
      "sway, heave, roll, pitch, yaw, along the vessel's axes at that place.");
  table
      .optional("stiffness", &given::Restraint::stiffness,
                located(matrix_format(stiffness_dimensions)),
                "6 rows of 6: N/m where a displacement makes a force, N m/rad where a turn makes a "
                "moment, N elsewhere, or 0 without a unit")
      .optional(
          "damping", &given::Restraint::damping, located(matrix_format(damping_dimensions)),
          "6 rows of 6: N s/m where a velocity makes a force, N m s/rad where a rate of turn makes "
          "a moment, N s elsewhere, or 0 without a unit; of the motion through the world, not "
          "through the water")
      .optional("about", &given::Restraint::about, position_format(),
                "point of the vessel's frame for which displacements, forces and moments are "
                "meant; its centre of mass if left out")
      .by_default("symmetric", &given::Restraint::symmetric, boolean(), "true",
                  "whether a stiffness that is not symmetric is refused")
      .rule(check_restraint);
  return table.format();
}

void check_current_load(const given::CurrentLoad& load, Reading& reading, const Mark&) {
  const auto& rows = load.coefficients.value;
  constexpr double half_turn = std::numbers::pi;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto ratio = [](const Quantity& entry) { return entry.dimension == Dimension::ratio; };
    const bool angle = rows[k][0].dimension == Dimension::angle;
    if (!angle || !ratio(rows[k][1]) || !ratio(rows[k][2]) || !ratio(rows[k][3])) {
      reading.error(load.coefficients.mark,
                    fmt::format("row {} of the coefficients is no angle with three numbers", k + 1),
                    {"such as [90 deg, 0, 0.8, 0.02]: heading of the flow, C_X, C_Y, C_N"});
      return;
    }
    if (k > 0 && rows[k][0].value <= rows[k - 1][0].value) {
      reading.error(load.coefficients.mark,
                    fmt::format("row {} of the coefficients is for {:.4g} deg, after {:.4g} deg: "
                                "angles must ascend",
                                k + 1, rows[k][0].value * 180.0 / half_turn,
                                rows[k - 1][0].value * 180.0 / half_turn));
      return;
    }
  }
  if (rows.size() < 2) return;  // the reader has complained
  const double end = rows.back()[0].value;
  const bool whole = std::abs(end - half_turn) < 1e-6 || std::abs(end - 2.0 * half_turn) < 1e-6;
  if (std::abs(rows.front()[0].value) < 1e-6 && whole) return;
  reading.error(load.coefficients.mark,
                fmt::format("the coefficients run from {:.4g} to {:.4g} deg",
                            rows.front()[0].value * 180.0 / half_turn, end * 180.0 / half_turn),
                {"from 0 to 180 deg for a vessel that is alike on both sides, else to 360 deg"});
}

Format<given::CurrentLoad> current_load_format() {
  Table<given::CurrentLoad> table(
      "current load",
      "Drag of the current by coefficients: with V the speed of the water relative to the vessel, "
      "forces rho/2 V^2 area C_X along x and C_Y along y, and the moment rho/2 V^2 area length C_N "
      "about z, in proportion to the wet volume.");
  const auto row = array_of<Quantity, 4>(quantity_of({Dimension::angle, Dimension::ratio}));
  table
      .required("area", &given::CurrentLoad::area, quantity(Dimension::area, Range::positive()),
                "that the coefficients are meant for; OCIMF: length times draught")
      .required("length", &given::CurrentLoad::length,
                quantity(Dimension::length, Range::positive()), "of the moment; OCIMF: of the ship")
      .required("coefficients", &given::CurrentLoad::coefficients, located(list_of(row, 2)),
                "[[0 deg, C_X, C_Y, C_N], ...] by where the water flows to, from the vessel's +x "
                "(from astern) towards +y, linear between: from 0 to 180 deg, the other side "
                "mirrored, or to 360 deg")
      .optional("about", &given::CurrentLoad::about, position_format(),
                "point of the vessel's frame where the forces act and the current is taken; half "
                "way down the draught above its origin if left out")
      .place(&given::CurrentLoad::place)
      .rule(check_current_load);
  return table.format();
}

Format<given::Member> member_format() {
  Table<given::Member> table("member",
                             "A slender member with Morison's drag where it is in the water.");
  table.required("from", &given::Member::from, position_format(), "one end, in the vessel's frame")
      .required("to", &given::Member::to, position_format(), "the other end")
      .required("diameter", &given::Member::diameter,
                quantity(Dimension::length, Range::positive()), "across the flow")
      .by_default("drag_coefficient", &given::Member::drag_coefficient,
                  number(Range::not_negative()), "1.0", "0.7 to 1.2 for a tube");
  return table.format();
}

}  // namespace

given::Restraint::Matrix6 given::Restraint::matrix(
    const std::optional<Located<given::FreedomMatrix>>& given) {
  if (!given) return Matrix6::Zero();
  // The file begins with what is straight, spatial vectors with what turns.
  const std::array<int, 6> order = {3, 4, 5, 0, 1, 2};
  return values_of(given->value)(order, order);
}

Format<given::Damping> vessel_damping_format() {
  return damping_format("damping", Dimension::damping, Dimension::rotational_damping);
}

Format<given::Damping> vessel_quadratic_damping_format() {
  return damping_format("quadratic damping", Dimension::mass_per_length,
                        Dimension::quadratic_rotational_damping);
}

Format<given::Sea> sea_format() {
  Table<given::Sea> table("sea", "The water: calm surface at z = 0 of the world, waves, current.");
  table
      .by_default("density", &given::Sea::density, quantity(Dimension::density, Range::positive()),
                  "1025 kg/m^3", "of the water")
      .optional("depth", &given::Sea::depth, quantity(Dimension::length, Range::positive()),
                "of the even bottom; deep if left out")
      .optional("waves", &given::Sea::waves, waves_format(), "calm if left out")
      .optional("current", &given::Sea::current, current_format(), "none if left out")
      .by_default("radiation", &given::Sea::radiation, radiation_settings_format(), "{}",
                  "settings for vessels whose radiation is asked for")
      .place(&given::Sea::place);
  return table.format();
}

Format<given::Vessel> vessel_in_case_format() {
  Table<given::Vessel> table(
      "vessel",
      "A floating body: a body of this name that moves freely. Buoyancy and the "
      "pressure of the undisturbed waves act on its hull as it lies at each "
      "instant, unless its buoyancy is linear.");
  table
      .required("model", &given::Vessel::model_name, located(reference()),
                "name of the vessel's model file")
      .by_default("position", &given::Vessel::position,
                  array_of<double, 2>(quantity(Dimension::length)), "[0 m, 0 m]",
                  "level, of the vessel's frame at the start")
      .by_default("heading", &given::Vessel::heading, quantity(Dimension::angle), "0 deg",
                  "of its x axis, from the world's +x towards +y")
      .optional("draught", &given::Vessel::draught,
                quantity(Dimension::length, Range::not_negative()),
                "depth of its frame's origin at the start and for its radiation; by its weight and "
                "that of what stands on it if left out")
      .by_default("radiation", &given::Vessel::radiation,
                  located(choice<RadiationMethod>({{"none", RadiationMethod::none},
                                                   {"database", RadiationMethod::database},
                                                   {"direct", RadiationMethod::direct}})),
                  "database",
                  "waves that it makes and scatters: added mass, memory and diffraction from the "
                  "panel method, with all such vessels together, from a database or with the "
                  "water's surface marched directly beside; or none")
      .optional(
          "draughts", &given::Vessel::draughts, located(draughts_format()),
          "of the one vessel that is lowered or lifted: upright, from the lowest point of its "
          "hull; its radiation is interpolated between them, and to none where it is dry; that "
          "of its draught alone if left out")
      .optional("database", &given::Vessel::database, located(text()),
                "file beside this one, made by blocklift hydro, with --import of another program's "
                "figures: radiation and diffraction from there in place of the panel method; all "
                "vessels that make waves name the same file")
      .optional("database_body", &given::Vessel::database_body, located(text()),
                "which body of that file it is; that of the vessel's name, or the only one, if "
                "left out")
      .by_default("damping", &given::Vessel::damping, vessel_damping_format(), "{}",
                  "linear, relative to the current; in proportion to the wet volume")
      .by_default("quadratic_damping", &given::Vessel::quadratic_damping,
                  vessel_quadratic_damping_format(), "{}",
                  "with the square of the velocity relative to the current; in proportion to the "
                  "wet volume")
      .by_default("drift", &given::Vessel::drift,
                  located(choice<DriftMethod>(
                      {{"none", DriftMethod::none}, {"newman", DriftMethod::newman}})),
                  "none",
                  "newman: slow drift by Newman's approximation from the mean drift forces of the "
                  "vessel afloat by itself, or of its database; of a vessel that shares its water "
                  "from a database only")
      .optional("current_load", &given::Vessel::current_load, current_load_format(),
                "drag of the current by coefficients over its heading, in place of quadratic "
                "damping of surge and sway")
      .optional("restraint", &given::Vessel::restraint, restraint_format(),
                "linear spring and damper by matrices, such as a published mooring")
      .optional("linear_buoyancy", &given::Vessel::linear_buoyancy, linear_buoyancy_format(),
                "buoyancy by its stiffness at rest, of a database or a publication, in place of "
                "the hull's; {} takes that of the database")
      .optional("members", &given::Vessel::members, list_of(member_format()),
                "slender members with drag")
      .rule([](const given::Vessel& vessel, Reading& reading, const Mark&) {
        const given::Damping& damping = vessel.quadratic_damping;
        if (!vessel.current_load || (damping.surge == 0.0 && damping.sway == 0.0)) return;
        reading.error(vessel.current_load->place,
                      "the drag of surge and sway is given twice, as current_load and as "
                      "quadratic_damping",
                      {"leave surge and sway out of quadratic_damping; yaw stays there"});
      });
  return table.format();
}

Format<given::Mooring> mooring_format() {
  Table<given::Mooring> table("mooring", "A chain or heavy rope, in equilibrium at each instant.");
  table
      .required("anchor", &given::Mooring::anchor, point_format(),
                "lower end, mostly of the body world")
      .required("fairlead", &given::Mooring::fairlead, point_format(), "upper end, on a vessel")
      .required("length", &given::Mooring::length, quantity(Dimension::length, Range::positive()),
                "unstretched")
      .required("submerged_mass", &given::Mooring::submerged_mass,
                quantity(Dimension::mass_per_length, Range::positive()),
                "mass per length less that of the water displaced")
      .required("axial_stiffness", &given::Mooring::axial_stiffness,
                quantity(Dimension::force, Range::positive()), "EA")
      .by_default("on_seabed", &given::Mooring::on_seabed, boolean(), "true",
                  "lies on a level bottom at the anchor's height where it is slack enough")
      .optional("breaking_load", &given::Mooring::breaking_load,
                quantity(Dimension::load, Range::positive()),
                "smallest; its tension is checked against it where it is given");
  return table.format();
}

Format<given::Tugger> tugger_format() {
  Table<given::Tugger> table("tugger line",
                             "A light line that pulls and never pushes. Its winch stands, and the "
                             "line stretches from its length by its stiffness; or it holds a "
                             "tension, and pays out and takes in as the ends move.");
  table.required("from", &given::Tugger::from, point_format(), "one end")
      .required("to", &given::Tugger::to, point_format(), "the other end")
      .optional("length", &given::Tugger::length,
                located(quantity(Dimension::length, Range::positive())),
                "unstretched, of a winch that stands")
      .optional("stiffness", &given::Tugger::stiffness,
                quantity(Dimension::stiffness, Range::positive()),
                "of the whole line of a winch that stands")
      .optional("tension", &given::Tugger::tension,
                located(quantity(Dimension::load, Range::positive())),
                "that the winch holds, in place of length and stiffness")
      .by_default("damping", &given::Tugger::damping,
                  quantity(Dimension::damping, Range::not_negative()), "0 kN s/m",
                  "of the whole line, or of the winch that holds a tension: what a rate of the "
                  "length adds to it")
      .optional("breaking_load", &given::Tugger::breaking_load,
                quantity(Dimension::load, Range::positive()),
                "smallest; its tension is checked against it where it is given")
      .rule([](const given::Tugger& line, Reading& reading, const Mark& mark) {
        if (line.tension && (line.length || line.stiffness)) {
          reading.error(line.tension->mark, "a line that holds a tension has a length or stiffness",
                        {"give either tension, or length and stiffness"});
        } else if (!line.tension && (!line.length || !line.stiffness)) {
          reading.error(mark, "the line says neither what tension it holds nor how it stretches",
                        {"give either tension, or length and stiffness"});
        }
      });
  return table.format();
}

}  // namespace blocklift::pipeline

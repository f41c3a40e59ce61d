#include "pipeline/formats/hydrodynamics/convention_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra/quantile.h"

namespace blocklift::pipeline {
namespace {

using dynamics::HydrodynamicDatabase;
using dynamics::modes_per_body;
using dynamics::Water;
using WaveForce = std::complex<double>;

constexpr double pi = std::numbers::pi, whole_circle = 2 * pi, of_degree = pi / 180;
constexpr std::array<const char*, 3> displacement_names = {"surge", "sway", "heave"};

std::string mode_of_body(const HydrodynamicDatabase& database, Eigen::Index mode) {
  return fmt::format("{} {}", database.body_names[mode / modes_per_body],
                     displacement_names[mode % modes_per_body]);
}

bool is_displacement(Eigen::Index mode) { return mode % modes_per_body < 3; }

// ------------------------------------------------------------------------------ damping and waves

/// A heading of the whole circle, and the column whose forces on displacements are as large.
struct HeadingOfCircle {
  double angle;  ///< rad, from 0 on
  Eigen::Index column;
};

void add_heading(double angle, Eigen::Index column, std::vector<HeadingOfCircle>& circle) {
  constexpr double same = 1e-6;
  angle -= whole_circle * std::floor(angle / whole_circle);
  if (angle > whole_circle - same) angle = 0;
  const bool known = std::any_of(circle.begin(), circle.end(), [&](const HeadingOfCircle& other) {
    return std::abs(other.angle - angle) < same;
  });
  if (!known) circle.push_back({angle, column});
}

/// Coarser ones do not tell the integral.
bool goes_round(std::vector<HeadingOfCircle>& circle) {
  constexpr double widest = pi / 3 + 1e-6;
  std::sort(circle.begin(), circle.end(),
            [](const HeadingOfCircle& a, const HeadingOfCircle& b) { return a.angle < b.angle; });
  for (std::size_t h = 0; h < circle.size(); ++h) {
    const bool last = h + 1 == circle.size();
    const double next = last ? circle.front().angle + whole_circle : circle[h + 1].angle;
    if (next - circle[h].angle > widest) return false;
  }
  return !circle.empty();
}

/// Do waves along the plane of symmetry push no body across it? So it is of bodies that each have
/// that plane.
/// @param across 0: surge, and waves along y; 1: sway, and waves along x.
bool has_plane(const HydrodynamicDatabase& database, Eigen::Index across) {
  constexpr double nothing = 0.01;
  double largest = 0, along = 0;
  int found = 0;
  for (std::size_t h = 0; h < database.headings.size(); ++h) {
    const double theta = database.headings[h];
    const bool in_plane = std::abs(across == 1 ? std::sin(theta) : std::cos(theta)) < 1e-6;
    if (in_plane) ++found;
    for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
      for (Eigen::Index m = across; m < database.mode_count(); m += modes_per_body) {
        const auto column = static_cast<Eigen::Index>(h);
        const double force =
            std::abs(database.froude_krylov[k](m, column) + database.diffraction[k](m, column));
        largest = std::max(largest, force);
        if (in_plane) along = std::max(along, force);
      }
    }
  }
  return found > 0 && along <= nothing * largest;
}

/// The headings of the whole circle; empty if these and planes of symmetry do not give them.
std::vector<HeadingOfCircle> headings_of_circle(const HydrodynamicDatabase& database) {
  std::vector<HeadingOfCircle> circle;
  for (std::size_t h = 0; h < database.headings.size(); ++h)
    add_heading(database.headings[h], static_cast<Eigen::Index>(h), circle);
  if (goes_round(circle)) return circle;
  const auto mirror = [&](double from) {
    for (const HeadingOfCircle& heading : std::vector<HeadingOfCircle>(circle))
      add_heading(from - heading.angle, heading.column, circle);
  };
  if (has_plane(database, 1)) mirror(0);
  if (goes_round(circle)) return circle;
  if (has_plane(database, 0)) mirror(pi);
  if (goes_round(circle)) return circle;
  return {};
}

/// The trapezoidal rule round the circle, which is exact for what the headings resolve.
/// @param step 2: of every second heading.
double integrate_square(const std::vector<HeadingOfCircle>& circle,
                        const std::vector<double>& squares, std::size_t step) {
  double sum = 0;
  for (std::size_t h = 0; h < circle.size(); h += step) {
    const std::size_t next = h + step < circle.size() ? h + step : 0;
    const double gap = circle[next].angle - circle[h].angle + (next == 0 ? whole_circle : 0);
    sum += 0.5 * gap * (squares[h] + squares[next]);
  }
  return sum;
}

/// What a frequency tells of a mode.
struct RadiatedPower {
  double frequency;  ///< rad/s
  double damping;    ///< B_ii
  double square;     ///< int |X_i|^2 dtheta
};

std::vector<RadiatedPower> powers_of_mode(const HydrodynamicDatabase& database,
                                          const std::vector<HeadingOfCircle>& circle,
                                          Eigen::Index mode) {
  // Less damping is the panels' error, and headings that half as many contradict are too few.
  constexpr double least_share = 0.05, resolved = 0.1;
  double largest = 0;
  for (const Eigen::MatrixXd& B : database.damping) largest = std::max(largest, B(mode, mode));
  std::vector<RadiatedPower> powers;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double damping = database.damping[k](mode, mode);
    if (!(damping > least_share * largest)) continue;
    std::vector<double> squares;
    for (const HeadingOfCircle& heading : circle)
      squares.push_back(std::norm(database.froude_krylov[k](mode, heading.column) +
                                  database.diffraction[k](mode, heading.column)));
    const double square = integrate_square(circle, squares, 1);
    if (!(square > 0)) continue;
    if (std::abs(integrate_square(circle, squares, 2) / square - 1) > resolved) continue;
    powers.push_back({database.frequencies[k], damping, square});
  }
  return powers;
}

/// Damping over what Haskind's relation makes of the excitation.
double haskind_ratio(const RadiatedPower& power, const Water& water) {
  const double carried = dynamics::calc_wave_number(power.frequency, water) * power.square /
                         (8 * pi * water.density * water.gravity *
                          dynamics::calc_group_velocity(power.frequency, water));
  return power.damping / carried;
}

/// Ratios of a mode over the frequencies.
struct RatioSpread {
  double median, low, high;  ///< the middle half
  double spread() const { return high / low; }
};

template <class Ratio>
RatioSpread spread_of(const std::vector<RadiatedPower>& powers, const Ratio& ratio) {
  std::vector<double> ratios;
  for (const RadiatedPower& power : powers) ratios.push_back(ratio(power));
  return {algebra::quantile_of(ratios, 0.5), algebra::quantile_of(ratios, 0.25),
          algebra::quantile_of(ratios, 0.75)};
}

/// Of this program's own databases (seven hulls, deep and shallow water, both methods) the mode
/// that most frequencies tell of has medians within 3 % of one and, without lids, spreads below
/// 1.17. An error in the frequencies that is taken for another has spreads of 1.5 and more.
constexpr double acceptable_ratio = 1.25, spread_of_one_factor = 1.2, fitting_median = 1.15;

/// What else the file's frequencies or damping may be.
/// @param largest_spread of ratios that such an error explains.
std::vector<std::string> errors_of_frequency(const std::vector<RadiatedPower>& powers,
                                             const Water& water, double largest_spread) {
  std::vector<std::string> found;
  const auto fits_one = [&](const RatioSpread& ratios) {
    return std::abs(std::log(ratios.median)) < std::log(fitting_median) &&
           ratios.spread() < largest_spread;
  };
  const auto say = [&](const char* what) {
    if (std::find(found.begin(), found.end(), what) == found.end()) found.emplace_back(what);
  };
  const auto times = [&](double exponent) {
    return spread_of(powers, [&](const RadiatedPower& power) {
      return haskind_ratio(power, water) * std::pow(power.frequency, exponent);
    });
  };
  if (fits_one(times(1))) say("the damping were not multiplied by the frequency");
  if (fits_one(times(-1))) say("the damping were multiplied by the frequency twice");
  // Importers multiply the damping by the frequency where the format divides by it.
  const auto with = [&](const auto& frequency, int multiplied) {
    return spread_of(powers, [&](const RadiatedPower& power) {
      const double right = frequency(power.frequency);
      return haskind_ratio(
          {right, power.damping * std::pow(right / power.frequency, multiplied), power.square},
          water);
    });
  };
  for (const int multiplied : {0, 1}) {
    if (fits_one(with([](double w) { return whole_circle / w; }, multiplied)))
      say("periods were taken for frequencies in rad/s, or these for periods");
    if (fits_one(with([](double w) { return whole_circle * w; }, multiplied)))
      say("the frequencies were in Hz, and not in rad/s");
    if (fits_one(with([](double w) { return w / whole_circle; }, multiplied)))
      say("the frequencies were 2 pi times those in rad/s");
  }
  return found;
}

/// What one factor at all frequencies may be.
std::string error_of_scale(double ratio, const Water& water) {
  const auto is = [&](double factor) { return std::abs(ratio / factor - 1) < 0.05; };
  std::string text =
      fmt::format("the excitation were {:.3g} times the right one", 1 / std::sqrt(ratio));
  if (is(4)) text += " (for the wave's height in place of its amplitude)";
  if (is(0.25)) text += " (for twice the wave's amplitude)";
  if (is(1e6)) text += " (in kN)";
  if (is(std::pow(water.density * water.gravity, 2))) text += " (still over rho g)";
  constexpr double most_lengths = 2000;  // mm and feet are within
  if (std::abs(std::log(ratio)) < std::log(most_lengths)) {
    text += fmt::format(", or the lengths by which the file is scaled {:.3g} times the right ones",
                        1 / ratio);
  }
  if (is(water.density) || is(1 / water.density)) {
    text += ", or the two were scaled by different densities";
  }
  return text;
}

/// Half a sentence; empty: nothing to say.
std::string doubt_about_haskind(const HydrodynamicDatabase& database) {
  constexpr std::size_t fewest = 3;
  const std::vector<HeadingOfCircle> circle = headings_of_circle(database);
  if (circle.empty()) return {};
  const Water& water = database.water;
  std::vector<RadiatedPower> most;
  Eigen::Index mode = -1;
  bool some_mode_right = false;
  for (Eigen::Index m = 0; m < database.mode_count(); ++m) {
    if (!is_displacement(m)) continue;
    std::vector<RadiatedPower> powers = powers_of_mode(database, circle, m);
    if (powers.size() < fewest) continue;
    const double median =
        spread_of(powers, [&](const RadiatedPower& p) { return haskind_ratio(p, water); }).median;
    if (std::abs(std::log(median)) < std::log(acceptable_ratio)) some_mode_right = true;
    if (powers.size() <= most.size()) continue;
    most = std::move(powers);
    mode = m;
  }
  if (mode < 0) return {};
  const RatioSpread ratios =
      spread_of(most, [&](const RadiatedPower& p) { return haskind_ratio(p, water); });
  const bool one_factor = ratios.spread() < spread_of_one_factor;
  const bool is_off = std::abs(std::log(ratios.median)) > std::log(acceptable_ratio);
  if (!is_off && one_factor) return {};
  // A median of one that coarse panels spread is no error of the frequencies unless that leaves
  // less than half of the spread, in logarithms.
  const double explained =
      is_off ? spread_of_one_factor : std::min(spread_of_one_factor, std::sqrt(ratios.spread()));
  std::vector<std::string> reasons = errors_of_frequency(most, water, explained);
  if (reasons.empty() && (!is_off || some_mode_right)) return {};
  if (one_factor) reasons.insert(reasons.begin(), error_of_scale(ratios.median, water));
  std::string text = fmt::format(
      "damping and excitation contradict each other: the damping of {} is {:.3g} times what its "
      "excitation by waves from all around says (Haskind's relation; the median of {} "
      "frequencies)",
      mode_of_body(database, mode), ratios.median, most.size());
  if (!reasons.empty()) {
    return text + fmt::format("; it would be so if {}", fmt::join(reasons, ", or if "));
  }
  return text + fmt::format(
                    ", from {:.3g} to {:.3g} in the middle half of them: the two are scaled "
                    "differently, or damping is in it that no wave carries off, as a lid's",
                    ratios.low, ratios.high);
}

/// Long waves lift a body as its stiffness says, short ones hardly. Half a sentence; empty: it is
/// so, or the frequencies are too near to each other to tell.
std::string doubt_about_periods(const HydrodynamicDatabase& database) {
  constexpr double little = 0.3, whole = 0.8, more_than_whole = 1.25;
  if (database.hydrostatic_stiffness.size() == 0) return {};
  for (Eigen::Index mode = 2; mode < database.mode_count(); mode += modes_per_body) {
    const double stiffness = database.hydrostatic_stiffness(mode, mode);
    if (!(stiffness > 0)) continue;
    const auto share = [&](std::size_t k) {
      return (database.froude_krylov[k].row(mode) + database.diffraction[k].row(mode))
                 .cwiseAbs()
                 .maxCoeff() /
             stiffness;
    };
    const double first = share(0), last = share(database.frequencies.size() - 1);
    if (!(first < little && last > whole && last < more_than_whole)) continue;
    return fmt::format(
        "the excitation of {} is {:.2f} of its stiffness at the lowest frequency and {:.2f} at the "
        "highest, where long waves have all of it; it would be so if periods were taken for "
        "frequencies, or these for periods",
        mode_of_body(database, mode), first, last);
  }
  return {};
}

// ---------------------------------------------------------------------------------------- phases

/// How wide a body is, by its added mass: of a long ship that of pitch is that of heave times
/// L^2/12. An upper bound for long waves is all that is due.
double size_of_body(const HydrodynamicDatabase& database, Eigen::Index first) {
  const Eigen::MatrixXd& A = database.infinite_added_mass;
  const auto mass = [&](Eigen::Index m) { return std::max(A(first + m, first + m), 0.0); };
  const auto arm = [](double turned, double moved) {
    return moved > 0 ? std::sqrt(12 * turned / moved) : 0.0;
  };
  const double largest = std::max({mass(0), mass(1), mass(2)});
  return std::max({arm(std::max(mass(3), mass(4)), mass(2)),
                   arm(mass(5), std::max(mass(0), mass(1))),
                   std::cbrt(largest / database.water.density)});
}

/// One way in which the file's forces and headings may be meant.
struct PhaseReading {
  bool conjugated = false;
  double sign = 1, angle_factor = 1, turned_by = 0;
  std::string words = {};
};

/// The force on a mode of displacement in a long wave of unit amplitude.
WaveForce force_in_long_wave(const HydrodynamicDatabase& database, std::size_t k, Eigen::Index mode,
                             double heading) {
  const auto body = static_cast<std::size_t>(mode / modes_per_body);
  const double w = database.frequencies[k], g = database.water.gravity;
  const double wave_number = dynamics::calc_wave_number(w, database.water);
  const double mass = database.water.density * std::max(database.displaced_volumes[body], 0.0) +
                      database.added_mass[k](mode, mode);
  const double damping = database.damping[k](mode, mode);
  const dynamics::Vector3& p = database.reference_points[body];
  const double along = p.x() * std::cos(heading) + p.y() * std::sin(heading);
  const WaveForce elevation = std::polar(1.0, -wave_number * along);
  if (mode % modes_per_body == 2) {
    return WaveForce(database.hydrostatic_stiffness(mode, mode) - w * w * mass, w * damping) *
           elevation;
  }
  const double share = mode % modes_per_body == 0 ? std::cos(heading) : std::sin(heading);
  return share * g * wave_number * WaveForce(damping / w, mass) * elevation;
}

/// The modes and frequencies whose phases long waves tell.
struct LongWaves {
  Eigen::Index first = 0;                ///< mode of the body
  std::vector<std::size_t> frequencies;  ///< indices
  std::vector<Eigen::Index> modes;
};

/// How well forces agree with those of long waves, -1 to 1: the mean over the modes.
double agreement_of(const HydrodynamicDatabase& database, const LongWaves& waves,
                    const PhaseReading& reading) {
  double sum = 0;
  for (const Eigen::Index mode : waves.modes) {
    double product = 0, given = 0, due = 0;
    for (const std::size_t k : waves.frequencies) {
      for (std::size_t h = 0; h < database.headings.size(); ++h) {
        const auto column = static_cast<Eigen::Index>(h);
        WaveForce X = reading.sign * (database.froude_krylov[k](mode, column) +
                                      database.diffraction[k](mode, column));
        if (reading.conjugated) X = std::conj(X);
        const WaveForce long_wave = force_in_long_wave(
            database, k, mode, reading.angle_factor * database.headings[h] + reading.turned_by);
        product += (X * std::conj(long_wave)).real();
        given += std::norm(X);
        due += std::norm(long_wave);
      }
    }
    if (given > 0 && due > 0) sum += product / std::sqrt(given * due);
  }
  return sum / static_cast<double>(waves.modes.size());
}

/// Modes that waves push, and three frequencies at least of waves that are long beside the body;
/// else without modes.
LongWaves long_waves_of_body(const HydrodynamicDatabase& database, Eigen::Index first) {
  constexpr double long_enough = 1.5, noise = 0.05;  // k times size; of the largest
  constexpr std::size_t fewest = 3;
  LongWaves waves{first, {}, {}};
  const double size = size_of_body(database, first);
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    if (dynamics::calc_wave_number(database.frequencies[k], database.water) * size < long_enough)
      waves.frequencies.push_back(k);
  }
  if (waves.frequencies.size() < fewest || !(size > 0)) return waves;
  std::array<double, 3> shares{};
  for (Eigen::Index m = 0; m < 3; ++m) {
    const Eigen::Index mode = first + m;
    const bool stiff =
        database.hydrostatic_stiffness.size() > 0 && database.hydrostatic_stiffness(mode, mode) > 0;
    if (m == 2 && !stiff) continue;
    double given = 0, scale = 0;
    for (const std::size_t k : waves.frequencies) {
      given +=
          (database.froude_krylov[k].row(mode) + database.diffraction[k].row(mode)).squaredNorm();
      const double heading = m == 1 ? 0.5 * pi : 0;
      scale += std::norm(force_in_long_wave(database, k, mode, heading));
    }
    if (scale > 0) shares[m] = std::sqrt(given / scale);
  }
  const double largest = *std::max_element(shares.begin(), shares.end());
  for (Eigen::Index m = 0; m < 3; ++m) {
    const double share = shares[m];
    if (share > 0 && share >= noise * largest) waves.modes.push_back(first + m);
  }
  return waves;
}

/// Largest heading, rad, by magnitude.
double largest_heading(const HydrodynamicDatabase& database) {
  double largest = 0;
  for (const double heading : database.headings) largest = std::max(largest, std::abs(heading));
  return largest;
}

/// Three headings and more, none beyond 2 pi degrees, of which a right angle in radians would be
/// one of the smaller ones, and not of quarters of a degree.
bool look_like_radians(const HydrodynamicDatabase& database) {
  const double largest = largest_heading(database) / of_degree;
  if (database.headings.size() < 3 || largest > 1.001 * whole_circle || largest < 1.5) return false;
  return std::any_of(database.headings.begin(), database.headings.end(), [](double heading) {
    const double quarters = 4 * heading / of_degree;
    return std::abs(quarters - std::round(quarters)) > 1e-3;
  });
}

bool look_like_degrees(const HydrodynamicDatabase& database) {
  return largest_heading(database) > whole_circle + 0.01;
}

const char* words_about_headings(const HydrodynamicDatabase& database) {
  if (look_like_radians(database)) return "the headings were in radians, and were read as degrees";
  if (look_like_degrees(database)) return "the headings were in degrees, and were read as radians";
  return nullptr;
}

std::vector<PhaseReading> other_readings(const HydrodynamicDatabase& database) {
  std::vector<PhaseReading> readings;
  readings.push_back({.conjugated = true,
                      .words = "the phases were conjugated (time as exp(-i w t), where the format "
                               "has exp(i w t))"});
  readings.push_back(
      {.turned_by = pi, .words = "the headings were those from which the waves come"});
  readings.push_back({.sign = -1, .words = "the forces had the opposite sign"});
  if (const char* words = words_about_headings(database))
    readings.push_back(
        {.angle_factor = look_like_degrees(database) ? of_degree : 1 / of_degree, .words = words});
  return readings;
}

/// Half a sentence; empty: nothing to say.
std::string doubt_about_phases(const HydrodynamicDatabase& database) {
  constexpr double poor = 0.4, good = 0.8, as_good = 0.05;
  if (database.headings.empty() || database.infinite_added_mass.size() == 0) return {};
  const std::vector<PhaseReading> others = other_readings(database);
  for (Eigen::Index first = 0; first < database.mode_count(); first += modes_per_body) {
    const LongWaves waves = long_waves_of_body(database, first);
    if (waves.modes.empty()) continue;
    const double as_is = agreement_of(database, waves, {});
    std::vector<double> found;
    for (const PhaseReading& other : others) found.push_back(agreement_of(database, waves, other));
    const double best = *std::max_element(found.begin(), found.end());
    if (as_is > poor || best < good) continue;
    std::vector<std::string> reasons;
    for (std::size_t r = 0; r < others.size(); ++r)
      if (found[r] > best - as_good)
        reasons.push_back(fmt::format("{} (then {:.2f})", others[r].words, found[r]));
    return fmt::format(
        "in long waves the excitation of {} does not go with the water that moves there (agreement "
        "{:.2f}, where 1 is due); it would if {}",
        database.body_names[first / modes_per_body], as_is, fmt::join(reasons, ", or if "));
  }
  return {};
}

/// Of headings by their figures alone, where long waves tell nothing of them.
std::string doubt_about_heading_units(const HydrodynamicDatabase& database) {
  const char* const words = words_about_headings(database);
  if (words == nullptr) return {};
  const auto [low, high] = std::minmax_element(database.headings.begin(), database.headings.end());
  return fmt::format("its {} headings lie between {:.4g} and {:.4g} degrees, as if {}",
                     database.headings.size(), *low / of_degree, *high / of_degree, words);
}

// -------------------------------------------------------------------------------------- couplings

/// Do both modes move water by themselves, and neither the other's, at any frequency?
bool lacks_coupling(const HydrodynamicDatabase& database, Eigen::Index i, Eigen::Index j) {
  constexpr double nothing = 1e-9;
  double alone_i = 0, alone_j = 0, both = 0;
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double w = database.frequencies[k];
    const auto force = [&](Eigen::Index m, Eigen::Index n) {
      return std::abs(WaveForce(database.damping[k](m, n), w * database.added_mass[k](m, n)));
    };
    alone_i = std::max(alone_i, force(i, i));
    alone_j = std::max(alone_j, force(j, j));
    both = std::max({both, force(i, j), force(j, i)});
  }
  return alone_i > 0 && alone_j > 0 && both <= nothing * std::sqrt(alone_i * alone_j);
}

/// Half a sentence; empty: nothing to say.
std::string doubt_about_couplings(const HydrodynamicDatabase& database) {
  for (Eigen::Index first = 0; first < database.mode_count(); first += modes_per_body) {
    std::vector<const char*> pairs;
    if (lacks_coupling(database, first, first + 4)) pairs.push_back("surge and pitch");
    if (lacks_coupling(database, first + 1, first + 3)) pairs.push_back("sway and roll");
    if (pairs.empty()) continue;
    return fmt::format(
        "{} has added mass in {}, and at no frequency anything that couples them, as if the "
        "diagonal alone had been written: a hull in the water's surface that goes sideways is "
        "pressed round, too",
        database.body_names[first / modes_per_body], fmt::join(pairs, ", and in "));
  }
  return {};
}

}  // namespace

std::vector<std::string> doubts_about_conventions(const HydrodynamicDatabase& database) {
  std::vector<std::string> doubts;
  const auto add = [&](std::string doubt) {
    if (!doubt.empty()) doubts.push_back(std::move(doubt));
  };
  if (database.added_mass.empty()) return doubts;
  if (!database.headings.empty()) {
    // Headings of another unit go round by chance.
    if (words_about_headings(database) == nullptr) add(doubt_about_haskind(database));
    if (doubts.empty()) add(doubt_about_periods(database));
    add(doubt_about_phases(database));
    if (doubts.empty()) add(doubt_about_heading_units(database));
  }
  add(doubt_about_couplings(database));
  return doubts;
}

}  // namespace blocklift::pipeline

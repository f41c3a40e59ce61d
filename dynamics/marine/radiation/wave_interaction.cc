#include "dynamics/marine/radiation/wave_interaction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algebra/factors.h"
#include "dynamics/errors.h"
#include "dynamics/marine/radiation/cylindrical_waves.h"
#include "dynamics/marine/radiation/retardation_samples.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

// What is radiated above the highest frequency is not known; without a gentle end the retardation
// functions would ring at it.
constexpr double beyond_highest = 1.25;

/// The modes of a group among those of all bodies.
std::vector<Index> modes_of(const BodyGroup& group) {
  std::vector<Index> modes;
  for (const int body : group.bodies) {
    for (int m = 0; m < modes_per_body; ++m) modes.push_back(Index{modes_per_body} * body + m);
  }
  return modes;
}

/// A group's answer to cylindrical waves at any frequency.
class GroupWaves {
 public:
  GroupWaves(const BodyGroup& group, const HydrodynamicDatabase& database)
      : radius_(group.radius), water_(database.water), frequencies_(database.frequencies) {
    const int order = order_at(beyond_highest * frequencies_.back());
    for (std::size_t k = 0; k < frequencies_.size(); ++k)
      waves_.push_back(find_cylindrical_waves(database, k, order));
  }

  int order_at(double frequency) const {
    return harmonic_order(radius_, calc_wave_number(frequency, water_));
  }

  /// Cubic polynomials between the frequencies, beyond the highest what is there.
  CylindricalWaves at(double frequency) const {
    if (frequency < frequencies_.front()) return below(frequency);
    const double w = std::min(frequency, frequencies_.back());
    const auto count = static_cast<std::ptrdiff_t>(frequencies_.size());
    const auto place = std::lower_bound(frequencies_.begin(), frequencies_.end(), w);
    const std::ptrdiff_t width = std::min<std::ptrdiff_t>(4, count);
    const auto first = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(place - frequencies_.begin() - 2, 0, count - width));
    const int order = order_at(frequency), beyond = waves_.front().order - order;
    const Index kept = 2 * order + 1;
    CylindricalWaves sum{order, MatrixXcd::Zero(kept, waves_[0].radiated.cols()),
                         MatrixXcd::Zero(kept, kept), MatrixXcd::Zero(waves_[0].force.rows(), kept),
                         MatrixXcd::Zero(waves_[0].force.rows(), kept)};
    for (std::size_t i = first; i < first + static_cast<std::size_t>(width); ++i) {
      double weight = 1.0;
      for (std::size_t j = first; j < first + static_cast<std::size_t>(width); ++j) {
        if (j != i) weight *= (w - frequencies_[j]) / (frequencies_[i] - frequencies_[j]);
      }
      if (weight == 0.0) continue;
      sum.radiated += weight * waves_[i].radiated.middleRows(beyond, kept);
      sum.scattered += weight * waves_[i].scattered.block(beyond, beyond, kept, kept);
      sum.force += weight * waves_[i].force.middleCols(beyond, kept);
      sum.undisturbed += weight * waves_[i].undisturbed.middleCols(beyond, kept);
    }
    return sum;
  }

 private:
  /// Each harmonic dies away with the power of the wave number that a small body's has.
  CylindricalWaves below(double frequency) const {
    CylindricalWaves waves = at(frequencies_.front());
    const double share = frequency / frequencies_.front();
    const double longer =
        calc_wave_number(frequency, water_) / calc_wave_number(frequencies_.front(), water_);
    Eigen::VectorXd powers(2 * waves.order + 1);
    for (int m = -waves.order; m <= waves.order; ++m)
      powers[m + waves.order] = std::pow(longer, std::abs(m));
    waves.radiated = share * (powers.asDiagonal() * waves.radiated);
    waves.scattered = share * (powers.asDiagonal() * waves.scattered * powers.asDiagonal()).eval();
    waves.force *= powers.asDiagonal();
    waves.undisturbed *= powers.asDiagonal();
    return waves;
  }

  double radius_;
  Water water_;
  std::vector<double> frequencies_;
  std::vector<CylindricalWaves> waves_;
};

/// All groups at one frequency.
class Interaction {
 public:
  Interaction(const std::vector<BodyGroup>& groups, const std::vector<GroupWaves>& waves,
              const Water& water, Index modes, double frequency)
      : groups_(groups), number_(calc_wave_number(frequency, water)) {
    for (const GroupWaves& group : waves) {
      waves_.push_back(group.at(frequency));
      first_.push_back(size_);
      size_ += harmonics(waves_.size() - 1);
    }
    carried_ = MatrixXcd::Zero(size_, size_);
    scattered_ = carried_;
    force_ = MatrixXcd::Zero(modes, size_);
    undisturbed_ = force_;
    radiated_ = MatrixXcd::Zero(size_, modes);
    for (std::size_t a = 0; a < groups.size(); ++a) {
      const Index na = harmonics(a);
      scattered_.block(first_[a], first_[a], na, na) = waves_[a].scattered;
      force_(modes_of(groups[a]), Eigen::seqN(first_[a], na)) = waves_[a].force;
      undisturbed_(modes_of(groups[a]), Eigen::seqN(first_[a], na)) = waves_[a].undisturbed;
      radiated_(Eigen::seqN(first_[a], na), modes_of(groups[a])) = waves_[a].radiated;
      for (std::size_t b = 0; b < groups.size(); ++b) {
        if (b == a) continue;
        carried_.block(first_[a], first_[b], na, harmonics(b)) = carry_waves(
            groups[a].centre - groups[b].centre, number_, waves_[a].order, waves_[b].order);
      }
    }
    factors_.factorise(MatrixXcd::Identity(size_, size_) - scattered_ * carried_);
  }

  /// Force on all modes by the others' waves, of unit motion of each mode: 6N x 6N.
  MatrixXcd forces_of_motion() const {
    return force_ * (carried_ * factors_.solve_columns(radiated_));
  }
  /// Of a wave of unit amplitude, the phase being that at the origin: its own pressure, and the
  /// rest.
  Eigen::VectorXcd undisturbed_forces(double heading) const {
    return undisturbed_ * incident(heading);
  }
  Eigen::VectorXcd disturbed_forces(double heading) const {
    const Eigen::VectorXcd wave = incident(heading);
    return (force_ - undisturbed_) * wave + force_ * (carried_ * factors_.solve(scattered_ * wave));
  }

 private:
  Index harmonics(std::size_t group) const { return 2 * Index{waves_[group].order} + 1; }
  Eigen::VectorXcd incident(double heading) const {
    Eigen::VectorXcd all(size_);
    const Eigen::Vector2d direction(std::cos(heading), std::sin(heading));
    for (std::size_t a = 0; a < groups_.size(); ++a) {
      all.segment(first_[a], harmonics(a)) =
          std::polar(1.0, -number_ * direction.dot(groups_[a].centre)) *
          plane_wave(waves_[a].order, heading);
    }
    return all;
  }

  const std::vector<BodyGroup>& groups_;
  double number_;
  Index size_ = 0;
  std::vector<CylindricalWaves> waves_;
  std::vector<Index> first_;
  MatrixXcd carried_, scattered_, force_, undisturbed_, radiated_;
  algebra::LuFactors<std::complex<double>> factors_;
};

void require_waves(const HydrodynamicDatabase& database) {
  if (database.far_field.empty() || database.headings != database.far_field.directions) {
    throw ModelError(
        "bodies far apart are coupled by their far field and the forces of waves from its "
        "directions, which a database lacks");
  }
}

/// Into the errors of all modes; these are unknown if any group's are.
void join_errors(const std::vector<Index>& rows, const Eigen::VectorXd& one, Eigen::VectorXd& all) {
  if (one.size() == 0) all.resize(0);
  if (all.size() > 0) all(rows) = one;
}

/// The groups side by side, none feeling the others.
HydrodynamicDatabase join(const std::vector<BodyGroup>& groups,
                          const std::vector<HydrodynamicDatabase>& databases) {
  std::size_t count = 0;
  for (const BodyGroup& group : groups) count += group.bodies.size();
  HydrodynamicDatabase all;
  all.water = databases[0].water;
  all.frequencies = databases[0].frequencies;
  all.time_step = databases[0].time_step;
  all.body_names.resize(count);
  all.reference_points.resize(count);
  all.displaced_volumes.resize(count);
  const auto modes = static_cast<Index>(modes_per_body * count);
  all.infinite_added_mass = MatrixXd::Zero(modes, modes);
  all.retardation.assign(databases[0].retardation.size(), all.infinite_added_mass);
  all.added_mass.assign(all.frequencies.size(), all.infinite_added_mass);
  all.damping = all.added_mass;
  all.change_from_coarser = all.cut_off_by_end = Eigen::VectorXd::Zero(modes);
  all.excitation_change_from_coarser = all.change_from_coarser;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const HydrodynamicDatabase& one = databases[g];
    const Vector3 centre(groups[g].centre.x(), groups[g].centre.y(), 0.0);
    for (std::size_t b = 0; b < groups[g].bodies.size(); ++b) {
      const auto body = static_cast<std::size_t>(groups[g].bodies[b]);
      all.body_names[body] = one.body_names[b];
      all.reference_points[body] = one.reference_points[b] + centre;
      all.displaced_volumes[body] = one.displaced_volumes[b];
    }
    const std::vector<Index> rows = modes_of(groups[g]);
    all.infinite_added_mass(rows, rows) = one.infinite_added_mass;
    for (std::size_t n = 0; n < all.retardation.size(); ++n)
      all.retardation[n](rows, rows) = one.retardation[n];
    for (std::size_t k = 0; k < all.frequencies.size(); ++k) {
      all.added_mass[k](rows, rows) = one.added_mass[k];
      all.damping[k](rows, rows) = one.damping[k];
    }
    join_errors(rows, one.change_from_coarser, all.change_from_coarser);
    join_errors(rows, one.excitation_change_from_coarser, all.excitation_change_from_coarser);
    join_errors(rows, one.cut_off_by_end, all.cut_off_by_end);
  }
  return all;
}

/// Share of the coupling in the damping, of F = -(i w B - w^2 A) xi.
MatrixXd damping_of(const MatrixXcd& forces, double frequency) {
  const MatrixXd damping = -forces.imag() / frequency;
  return 0.5 * (damping + damping.transpose());
}

double longest_way(const std::vector<BodyGroup>& groups) {
  double longest = 0.0;
  for (const BodyGroup& a : groups) {
    for (const BodyGroup& b : groups) longest = std::max(longest, (a.centre - b.centre).norm());
  }
  return longest;
}

/// The coupling's share of the retardation functions.
/// @param at the Interaction of a frequency, rad/s.
template <class At>
void add_coupled_retardation(HydrodynamicDatabase& all, double top, const At& at) {
  // K = (2/pi) int B cos(w t) dw, by the trapezoidal rule: its integrand ends smoothly on both
  // sides.
  const double run = all.time_step * static_cast<double>(all.retardation.size() - 1);
  const auto count = static_cast<int>(std::ceil(top * run * 4.0 / std::numbers::pi));
  const double spacing = top / count;
  for (int j = 1; j < count; ++j) {
    const double w = spacing * j;
    const double fade =
        std::max(0.0, (w - all.frequencies.back()) / (top - all.frequencies.back()));
    const double weight =
        2.0 / std::numbers::pi * spacing * 0.5 * (1.0 + std::cos(std::numbers::pi * fade));
    const MatrixXd damping = weight * damping_of(at(w).forces_of_motion(), w);
    for (std::size_t n = 0; n < all.retardation.size(); ++n)
      all.retardation[n] += std::cos(w * all.time_step * static_cast<double>(n)) * damping;
  }
}

}  // namespace

HydrodynamicDatabase couple_by_waves(const std::vector<BodyGroup>& groups,
                                     std::vector<HydrodynamicDatabase> databases,
                                     const std::vector<double>& headings) {
  for (const HydrodynamicDatabase& database : databases) require_waves(database);
  const Water water = databases[0].water;
  const double lowest = databases[0].frequencies.front();
  const double top = beyond_highest * databases[0].frequencies.back();
  // The slowest waves arrive last; what they set going dies away in two of the longest periods.
  const double arrival = longest_way(groups) / calc_group_velocity(top, water);
  const double duration = arrival + 4.0 * std::numbers::pi / lowest;
  bring_to_one_step(databases, duration);
  std::vector<GroupWaves> waves;
  for (std::size_t g = 0; g < groups.size(); ++g) waves.emplace_back(groups[g], databases[g]);
  HydrodynamicDatabase all = join(groups, databases);
  all.headings = headings;
  const Index modes = all.mode_count();
  const auto at = [&](double w) { return Interaction(groups, waves, water, modes, w); };
  for (std::size_t k = 0; k < all.frequencies.size(); ++k) {
    const double w = all.frequencies[k];
    const Interaction interaction = at(w);
    const MatrixXcd forces = interaction.forces_of_motion();
    all.damping[k] += damping_of(forces, w);
    const MatrixXd mass = forces.real() / (w * w);
    all.added_mass[k] += 0.5 * (mass + mass.transpose());
    MatrixXcd& incident = all.froude_krylov.emplace_back(modes, headings.size());
    MatrixXcd& diffracted = all.diffraction.emplace_back(modes, headings.size());
    for (std::size_t h = 0; h < headings.size(); ++h) {
      const auto column = static_cast<Index>(h);
      incident.col(column) = interaction.undisturbed_forces(headings[h]);
      diffracted.col(column) = interaction.disturbed_forces(headings[h]);
    }
  }
  add_coupled_retardation(all, top, at);
  return all;
}

}  // namespace blocklift::dynamics

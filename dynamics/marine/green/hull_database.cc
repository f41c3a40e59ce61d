#include "dynamics/marine/green/hull_database.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <numbers>

#include "dynamics/errors.h"
#include "dynamics/marine/green/common_poles.h"
#include "dynamics/marine/green/damping_beyond.h"
#include "dynamics/marine/green/hull_equations.h"
#include "dynamics/marine/panels/lone_rows.h"
#include "dynamics/marine/radiation/database_parts.h"
#include "dynamics/marine/radiation/retardation_from_damping.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Of the waves' part of the forces: between the frequencies, and what the memory may miss in all.
constexpr double sought_error = 2e-3, allowed_error = 0.1;
/// More frequencies than asked for, at most.
constexpr int most_more = 60;
/// Of the lowest frequency, that the memory may last.
constexpr double most_periods = 10.0;

bool panels_suffice(const PanelModel& model, double frequency) {
  try {
    require_panels_for_waves(model, frequency);
  } catch (const ModelError&) {
    return false;
  }
  return true;
}

/// The frequency up to which is solved (rad/s): twice the highest that is asked for, or less where
/// panels do not suffice for that. How far it lies off tells how well the highest is known.
double highest_solved(const PanelModel& model, double asked) {
  for (const double factor : {2.0, 1.75, 1.5, 1.25}) {
    if (panels_suffice(model, factor * asked)) return factor * asked;
  }
  return asked;
}

/// Of cells within the hulls (m): eight in the shortest wave, no smaller than the panels nor larger
/// than two of them.
double cover_size(const PanelModel& model, double highest) {
  const double panels = std::sqrt(model.body_areas().mean());
  const double wave = 2.0 * std::numbers::pi / calc_wave_number(highest, model.water());
  return std::clamp(wave / 8.0, panels, 2.0 * panels);
}

/// The entries of a symmetric matrix on its diagonal and above, one behind the other.
template <class Matrix>
auto upper_of(const Matrix& matrix) {
  Eigen::Matrix<typename Matrix::Scalar, Eigen::Dynamic, 1> entries(matrix.rows() *
                                                                    (matrix.rows() + 1) / 2);
  Eigen::Index next = 0;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = 0; i <= j; ++i) entries[next++] = matrix(i, j);
  }
  return entries;
}

MatrixXcd symmetric_of(const VectorXcd& entries, Eigen::Index size) {
  MatrixXcd matrix(size, size);
  Eigen::Index next = 0;
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::Index i = 0; i <= j; ++i) matrix(i, j) = matrix(j, i) = entries[next++];
  }
  return matrix;
}

/// Largest difference of the two halves over the root of the diagonal's product.
double asymmetry_of(const MatrixXcd& matrix) {
  double asymmetry = 0.0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double size = std::sqrt(std::abs(matrix(i, i) * matrix(j, j)));
      if (size > 0.0) {
        asymmetry = std::max(asymmetry, std::abs(matrix(i, j) - matrix(j, i)) / size);
      }
    }
  }
  return asymmetry;
}

/// One computation of a database.
class HullComputation {
 public:
  HullComputation(const PanelModel& model, const DatabaseSettings& settings,
                  HullDatabaseReport& account)
      : model_(model),
        settings_(settings),
        account_(account),
        highest_(highest_solved(model, settings.frequencies.back())),
        equations_(model, {.lids = settings.lids,
                           .cover_size = cover_size(model, highest_),
                           .threads = settings.rankine.threads,
                           .memory_limit = settings.rankine.memory_limit}),
        database_(begin_database(model, settings)),
        coarser_(model.mode_count(), settings.with_coarser ? settings.frequencies.size() : 0,
                 settings.headings.size()) {
    account_.panels = model.body_mesh().size();
    account_.cells = equations_.cell_count();
    account_.peak_bytes =
        hull_equations_bytes(equations_.size(), static_cast<int>(model.parities().size()));
  }

  HydrodynamicDatabase run();

 private:
  void add_infinite_frequency();
  /// A + B/(i w) - A_inf; what else the database has of the frequency is taken along.
  VectorXcd solve(double frequency);
  void add_asked(std::size_t k, const std::vector<HullEquations::Part>& parts,
                 const MatrixXcd& force);
  MatrixXd find_scales(const MatrixXcd& values) const;
  DampingBeyond find_damping(const FoundPoles& found) const;
  void add_retardation_of(const FoundPoles& found);
  void end_retardation(const MatrixXd& scales);
  void check_memory(const FoundPoles& found);
  void tell() const;

  const PanelModel& model_;
  const DatabaseSettings& settings_;
  HullDatabaseReport& account_;
  double highest_;  ///< solved, rad/s
  HullEquations equations_;
  HydrodynamicDatabase database_;
  CoarserForces coarser_;
};

void HullComputation::add_infinite_frequency() {
  const std::vector<HullEquations::Part> parts =
      equations_.solve(infinite, {.coarser = coarser_.sought()});
  const MatrixXcd mass = equations_.calc_radiation(parts, infinite);
  account_.reciprocity_error = asymmetry_of(mass);
  database_.infinite_added_mass = 0.5 * (mass.real() + mass.real().transpose());
  if (!coarser_.sought()) return;
  coarser_.infinite_mass = equations_.calc_coarser_radiation(parts, infinite).diagonal().real();
  for (const HullEquations::Part& part : parts) {
    coarser_.infinite_arms(part.modes) +=
        calc_coarser_arms(model_, part, equations_.coarser_panels()).real();
  }
  const double density = model_.water().density;
  const VectorXd volumes = database_.infinite_added_mass.diagonal() / density;
  coarser_.infinite_error = density * calc_error_of_lone_rows(model_, volumes, settings_.rankine);
}

VectorXcd HullComputation::solve(double frequency) {
  tell();
  const auto place =
      std::find(settings_.frequencies.begin(), settings_.frequencies.end(), frequency);
  const bool asked = place != settings_.frequencies.end();
  HullEquations::Extent extent;
  if (asked) extent.coarser = settings_.with_coarser;
  if (asked && settings_.with_far_field) extent.headings = settings_.headings;
  const std::vector<HullEquations::Part> parts = equations_.solve(frequency, extent);
  MatrixXcd force = equations_.calc_radiation(parts, frequency);
  account_.reciprocity_error = std::max(account_.reciprocity_error, asymmetry_of(force));
  account_.frequencies.push_back(frequency);
  force = (0.5 * (force + force.transpose())).eval();
  if (asked) {
    add_asked(static_cast<std::size_t>(place - settings_.frequencies.begin()), parts, force);
  }
  return upper_of(
      MatrixXcd(force / Complex(0.0, frequency) - database_.infinite_added_mass.cast<Complex>()));
}

void HullComputation::add_asked(std::size_t k, const std::vector<HullEquations::Part>& parts,
                                const MatrixXcd& force) {
  const double w = settings_.frequencies[k];
  database_.damping[k] = force.real();
  database_.added_mass[k] = force.imag() / w;
  if (coarser_.sought()) coarser_.radiation[k] = equations_.calc_coarser_radiation(parts, w);
  for (const HullEquations::Part& part : parts) {
    if (coarser_.sought())
      add_coarser_arms(model_, part, equations_.coarser_panels(), database_, k, coarser_);
    add_diffraction(model_, part, k, database_,
                    coarser_.diffraction.empty() ? nullptr : &coarser_.diffraction[k]);
    if (settings_.with_far_field) add_far_field(model_, part, k, database_);
  }
}

MatrixXd HullComputation::find_scales(const MatrixXcd& values) const {
  std::vector<MatrixXcd> shares;
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    shares.push_back(symmetric_of(values.col(k), model_.mode_count()));
  }
  return calc_wave_scales(shares, database_.infinite_added_mass);
}

// Close enough for the poles nearest to the axis, which make the narrowest peaks.
DampingBeyond HullComputation::find_damping(const FoundPoles& found) const {
  constexpr double fewest = 1500.0, most = 6000.0, in_a_peak = 8.0;
  const auto [low, high] = std::minmax_element(found.frequencies.begin(), found.frequencies.end());
  const double span = *high - *low;
  double narrowest = span;
  for (const Complex& pole : found.function.poles) {
    if (pole.imag() < *low || pole.imag() > *high) continue;
    narrowest = std::min(narrowest, -pole.real());
  }
  const auto count = static_cast<int>(std::clamp(in_a_peak * span / narrowest, fewest, most));
  std::vector<double> frequencies;
  std::vector<MatrixXd> damping;
  for (int i = 0; i <= count; ++i) {
    const double w = *low + span * i / count;
    frequencies.push_back(w);
    damping.emplace_back(
        symmetric_of(Complex(0.0, w) * found.function.at(w), model_.mode_count()).real());
  }
  MatrixXd added_mass(model_.mode_count(), found.values.cols());
  for (Eigen::Index k = 0; k < added_mass.cols(); ++k) {
    added_mass.col(k) = symmetric_of(found.values.col(k), model_.mode_count()).diagonal().real();
  }
  return {std::move(frequencies), std::move(damping), found.frequencies, added_mass};
}

void HullComputation::add_retardation_of(const FoundPoles& found) {
  const DampingBeyond beyond = find_damping(found);
  database_.time_step =
      settings_.time_step > 0.0 ? settings_.time_step : 0.25 / settings_.frequencies.back();
  const double longest = settings_.duration > 0.0 ? settings_.duration
                                                  : most_periods * 2.0 * std::numbers::pi /
                                                        settings_.frequencies.front();
  constexpr double fewest = 16.0;  // what a fit of the memory needs
  const double steps = std::max(std::ceil(longest / database_.time_step), fewest);
  database_.retardation =
      integrate_damping(beyond.frequencies(), beyond.damping(), database_.time_step,
                        static_cast<std::size_t>(steps) + 1);
  if (!(settings_.duration > 0.0)) end_retardation(find_scales(found.values));
}

// Sums from the end on at each frequency, until one of them is felt. What swings on is faded over
// the last two fifths, as the march fades it.
void HullComputation::end_retardation(const MatrixXd& scales) {
  constexpr std::size_t fewest = 17;
  std::vector<MatrixXd>& K = database_.retardation;
  std::vector<MatrixXcd> left(settings_.frequencies.size(),
                              MatrixXcd::Zero(model_.mode_count(), model_.mode_count()));
  std::size_t last = K.size();
  double felt = 0.0;
  while (last > fewest && felt <= sought_error) {
    --last;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const double w = settings_.frequencies[k];
      const double angle = -w * database_.time_step * static_cast<double>(last);
      left[k] += database_.time_step * std::polar(1.0, angle) * K[last];
      felt = std::max(felt, (left[k].cwiseAbs().array() / scales.array()).maxCoeff() / w);
    }
  }
  if (last + 1 < K.size()) {
    K.resize(last + 1);
    return;
  }
  const double end = static_cast<double>(K.size());
  for (std::size_t n = 0; n < K.size(); ++n) {
    const double late = (static_cast<double>(n) / end - 0.6) / 0.4;
    if (late > 0.0) K[n] *= 0.5 * (1.0 + std::cos(std::numbers::pi * late));
  }
}

void HullComputation::check_memory(const FoundPoles& found) {
  std::vector<double> frequencies;
  std::vector<MatrixXcd> forces;
  for (std::size_t k = 0; k < found.frequencies.size(); ++k) {
    const double w = found.frequencies[k];
    if (w < settings_.frequencies.front() || w > settings_.frequencies.back()) continue;
    frequencies.push_back(w);
    forces.emplace_back(
        Complex(0.0, w) *
        (symmetric_of(found.values.col(static_cast<Eigen::Index>(k)), model_.mode_count()) +
         database_.infinite_added_mass));
  }
  account_.memory_error = calc_memory_error(database_, frequencies, forces);
  if (account_.memory_error <= allowed_error) return;
  std::array<char, 640> text{};
  std::snprintf(
      text.data(), text.size(),
      "%zu frequencies up to %.3g rad/s do not tell the memory of the water: its "
      "retardation functions miss the waves' forces by %.1f %% of the largest, and %.0f "
      "%% is allowed. Usually the damping has not faded yet at the highest frequency: take "
      "a higher highest_frequency, with panels that are small beside its waves, which are "
      "%.1f m long at %.3g rad/s. Where water swings between hulls or in a moonpool, a "
      "lid damps it. Or, if a hull reaches the water's surface, leave out method: green "
      "function: the marched surface finds the memory from impulses",
      found.frequencies.size(), highest_, 100.0 * account_.memory_error, 100.0 * allowed_error,
      2.0 * std::numbers::pi / calc_wave_number(highest_, database_.water), highest_);
  throw ModelError(text.data());
}

void HullComputation::tell() const {
  if (!settings_.progress) return;
  const double expected = static_cast<double>(settings_.frequencies.size()) + 0.3 * most_more;
  settings_.progress(std::min(0.95, static_cast<double>(account_.frequencies.size()) / expected),
                     "flow at each frequency");
}

HydrodynamicDatabase HullComputation::run() {
  add_infinite_frequency();
  PoleSearch search{.lowest = 0.5 * settings_.frequencies.front(), .highest = highest_};
  search.tolerance = sought_error;
  search.first = settings_.frequencies;
  search.most = static_cast<int>(settings_.frequencies.size()) + most_more;
  search.scales = [this](const MatrixXcd& values) { return upper_of(find_scales(values)); };
  const FoundPoles found = search_common_poles([this](double w) { return solve(w); }, search);
  account_.miss = found.miss;
  add_retardation_of(found);
  check_memory(found);
  if (settings_.with_coarser) {
    const PanelClusters& clusters = equations_.coarser_panels().bodies;
    database_.change_from_coarser = calc_radiation_error(database_, coarser_, clusters);
    database_.excitation_change_from_coarser =
        error_of_panels(largest_excitation_change(database_, coarser_), clusters);
  }
  return std::move(database_);
}

}  // namespace

double hull_database_bytes(const PanelModel& model, const DatabaseSettings& settings) {
  std::vector<WaterPlaneRegion> regions;
  for (const DampingLid& lid : settings.lids) regions.push_back({lid.low, lid.high});
  const WaterPlaneCells cells =
      make_water_plane_cells(find_water_lines(model.bodies()), regions, model.symmetry(),
                             std::sqrt(model.body_areas().mean()));
  const int unknowns = model.body_mesh().size() + cells.size();
  const int parts = static_cast<int>(model.parities().size());
  const double equations = hull_equations_bytes(unknowns, parts);
  if (!settings.with_coarser) return equations;
  // What lone rows miss is found beside the matrices.
  return std::max(equations, hull_matrices_bytes(unknowns, parts) + lone_rows_bytes(model));
}

HydrodynamicDatabase compute_hull_database(const PanelModel& model,
                                           const DatabaseSettings& settings,
                                           HullDatabaseReport* report) {
  check_frequencies(settings);
  require_panels_for_waves(model, settings.frequencies.back());
  HullDatabaseReport unused;
  HullDatabaseReport& account = report != nullptr ? *report : unused;
  account = {};
  return HullComputation(model, settings, account).run();
}

}  // namespace blocklift::dynamics

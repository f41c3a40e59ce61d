#include "dynamics/marine/radiation/hydrodynamic_database.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>

#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/errors.h"
#include "dynamics/marine/panels/lone_rows.h"
#include "dynamics/marine/radiation/database_parts.h"
#include "dynamics/marine/radiation/frequency_domain.h"
#include "dynamics/marine/radiation/impulse_run.h"
#include "parallel/threads.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Tells the progress of the parts: a third of each for its solution, the rest for its march. The
/// far field of a frequency takes about a sixth of both: with 940 panels and 29 frequencies four
/// fifths of all.
class Progress {
 public:
  Progress(const DatabaseSettings& settings, std::size_t parts)
      : tell_(settings.progress),
        parts_(static_cast<double>(parts)),
        frequencies_(static_cast<double>(settings.frequencies.size())),
        before_far_field_(settings.with_far_field ? 1.0 / (1.0 + frequencies_ / 6.0) : 1.0) {}
  void part(std::size_t index) {
    done_ = static_cast<double>(index);
    marched_ = 0.0;
  }
  void solve() const { show(0.0, "influence of the panels"); }
  /// A run that becomes longer stands still here, and does not go back.
  void march(long step, long steps) {
    marched_ = std::max(marched_, static_cast<double>(step) / static_cast<double>(steps));
    show((0.35 + 0.6 * marched_) * before_far_field_, "impulse responses");
  }
  void excite() const { show(0.95 * before_far_field_, "waves of all headings"); }
  void send(std::size_t frequency) const {
    const double sent = static_cast<double>(frequency) / frequencies_;
    show(before_far_field_ + (1.0 - before_far_field_) * sent, "waves far away");
  }

 private:
  void show(double fraction, const char* what) const {
    if (tell_) tell_((done_ + fraction) / parts_, what);
  }
  const std::function<void(double, const char*)>& tell_;
  double parts_, frequencies_;
  double before_far_field_;  ///< share of a part
  double done_ = 0.0, marched_ = 0.0;
};

/// On the surface only what is small beside the shortest wave is taken together: near the hulls.
/// Waves that leave them must not be lost on coarse rings, which would tell nothing of the hulls.
RankineSettings rankine_settings(const PanelModel& model, const DatabaseSettings& settings) {
  RankineSettings rankine = settings.rankine;
  rankine.keep_factors = rankine.keep_factors || settings.with_far_field;
  if (!settings.with_coarser) return rankine;
  double diameters = 0.0;
  for (const Panel& panel : model.body_mesh().panels) diameters += panel.diameter();
  const double wave =
      2.0 * std::numbers::pi / calc_wave_number(settings.frequencies.back(), model.water());
  const double largest = std::max(wave / 8.0, 2.0 * diameters / model.body_mesh().size());
  rankine.coarser = std::make_shared<const CoarserPanels>(
      make_coarser_panels(model.body_mesh(), model.surface_mesh(), largest));
  return rankine;
}

/// The share of one part in the database: its impulse run and what follows from it.
class PartComputation {
 public:
  PartComputation(const PanelModel& model, const Parity& parity, const DatabaseSettings& settings,
                  const RankineSettings& rankine, double damping_strength);

  const RankinePart& part() const { return part_; }
  double step_limit() const { return run_.step_limit(); }
  double added_mass_asymmetry(MatrixXd& infinite_added_mass) const;
  /// @returns the steps.
  long run(double step, const RunLength& length, std::vector<MatrixXd>& retardation,
           Progress& progress);
  void add_frequencies(HydrodynamicDatabase& database) const;
  /// To excitation, and to the far field, made for all parts together; and to what the coarser
  /// solution makes of the former.
  void add_waves(HydrodynamicDatabase& database, CoarserForces& coarser) const;
  void add_distant_waves(HydrodynamicDatabase& database, const Progress& progress) const;
  /// To the radiation forces of the coarser solution.
  void add_coarser(CoarserForces& coarser) const;
  /// To what the ends of the runs cut off, modes x frequencies.
  void add_cut(MatrixXd& cut) const;

 private:
  MatrixXcd mode_potentials(const RankinePart& part, const ImpulseRun& run,
                            std::size_t frequency) const;
  FlowOfPart flow(std::size_t frequency) const;

  const PanelModel& model_;
  const DatabaseSettings& settings_;
  SurfaceDamping damping_;
  RankinePart part_;
  ImpulseRun run_;
  std::shared_ptr<const CoarserPanels> coarser_panels_;
  std::optional<ImpulseRun> coarser_run_;
};

PartComputation::PartComputation(const PanelModel& model, const Parity& parity,
                                 const DatabaseSettings& settings, const RankineSettings& rankine,
                                 double damping_strength)
    : model_(model),
      settings_(settings),
      damping_(DampingZone{damping_strength, settings.lids}.damping(model.surface(),
                                                                    model.water().gravity)),
      part_(model, parity, rankine),
      run_(part_, damping_, model.water(), settings.frequencies, true),
      coarser_panels_(rankine.coarser) {
  if (part_.coarser() == nullptr) return;
  const PanelClusters& clusters = rankine.coarser->surface;
  const SurfaceDamping coarser{
      clusters.average(model.surface_areas(), damping_.rates),
      make_ring_differences(model.surface(), model.water().gravity, &clusters)};
  coarser_run_.emplace(*part_.coarser(), coarser, model.water(), settings.frequencies,
                       !settings.headings.empty());
}

double PartComputation::added_mass_asymmetry(MatrixXd& infinite_added_mass) const {
  const MatrixXd share = model_.water().density * part_.infinite_frequency_volume();
  const auto& modes = part_.modes();
  infinite_added_mass(modes, modes) += 0.5 * (share + share.transpose());
  if (share.size() == 0) return 0.0;
  double asymmetry = 0.0;
  for (Eigen::Index i = 0; i < share.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      asymmetry = std::max(asymmetry, std::abs(share(i, j) - share(j, i)) /
                                          std::sqrt(std::abs(share(i, i) * share(j, j))));
    }
  }
  return asymmetry;
}

long PartComputation::run(double step, const RunLength& length, std::vector<MatrixXd>& retardation,
                          Progress& progress) {
  const auto& modes = part_.modes();
  // The coarser surface's waves are longer: what the finer one's step suits suits it too. Where
  // not, the coarser panels have no solution that means anything.
  if (coarser_run_ && step > coarser_run_->step_limit()) coarser_run_.reset();
  ImpulseRun* const beside = coarser_run_ ? &*coarser_run_ : nullptr;
  const long steps = run_.run(step, length, beside, [&](long k, long planned) {
    if (k % 16 == 0) progress.march(k, planned);
  });
  for (long k = 0; k <= steps; ++k) {
    if (static_cast<std::size_t>(k) == retardation.size())
      retardation.emplace_back(MatrixXd::Zero(model_.mode_count(), model_.mode_count()));
    retardation[k](modes, modes) += run_.retardation(k);
  }
  return steps;
}

void PartComputation::add_frequencies(HydrodynamicDatabase& database) const {
  const auto& modes = part_.modes();
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    database.damping[k](modes, modes) += run_.damping(k);
    database.added_mass[k](modes, modes) += run_.added_mass(k);
  }
}

void PartComputation::add_coarser(CoarserForces& coarser) const {
  const auto& modes = part_.modes();
  const MatrixXd& volume = part_.coarser()->infinite_frequency_volume();
  const FlowOfPart at_infinity{part_.parity(), modes, part_.normal_velocities(),
                               part_.body_columns()};
  coarser.infinite_mass(modes) += model_.water().density * volume.diagonal();
  coarser.infinite_arms(modes) += calc_coarser_arms(model_, at_infinity, *coarser_panels_).real();
  if (!coarser_run_) {
    coarser.miss(modes);
    return;
  }
  for (std::size_t k = 0; k < settings_.frequencies.size(); ++k) {
    const MatrixXd mass = model_.water().density * volume + coarser_run_->added_mass(k);
    coarser.radiation[k](modes, modes) +=
        coarser_run_->damping(k) + Complex(0, settings_.frequencies[k]) * mass;
  }
}

void PartComputation::add_cut(MatrixXd& cut) const {
  cut(part_.modes(), Eigen::all) += run_.cut_off();
}

/// Potentials on the bodies per unit velocity of the modes.
MatrixXcd PartComputation::mode_potentials(const RankinePart& part, const ImpulseRun& run,
                                           std::size_t frequency) const {
  // phi on the surface per unit velocity is -g eta/(i w); then on the bodies.
  const MatrixXcd surface = -model_.water().gravity /
                            Complex(0.0, settings_.frequencies[frequency]) *
                            run.elevation(frequency);
  const Eigen::Index modes = surface.cols();
  MatrixXd parts(surface.rows(), 2 * modes);
  parts << surface.real(), surface.imag();
  MatrixXd bodies = MatrixXd::Zero(part.body_columns().rows(), 2 * modes);
  bodies.leftCols(modes) = part.body_columns();
  multiply(1.0, part.body_from_surface(), parts, 1.0, bodies);
  MatrixXcd potentials(bodies.rows(), modes);
  potentials.real() = bodies.leftCols(modes);
  potentials.imag() = bodies.rightCols(modes);
  return potentials;
}

FlowOfPart PartComputation::flow(std::size_t frequency) const {
  return {part_.parity(), part_.modes(), part_.normal_velocities(),
          mode_potentials(part_, run_, frequency)};
}

void PartComputation::add_waves(HydrodynamicDatabase& database, CoarserForces& coarser) const {
  parallel::for_each(
      static_cast<int>(database.frequencies.size()), settings_.rankine.threads, [&](int index) {
        const auto k = static_cast<std::size_t>(index);
        FlowOfPart found = flow(k);
        if (coarser.sought()) {
          add_coarser_arms(model_, found, *coarser_panels_, database, k, coarser);
        }
        if (coarser.diffraction.empty() || !coarser_run_) {
          add_diffraction(model_, found, k, database);
          return;
        }
        found.coarser_potentials =
            coarser_panels_->bodies.spread(mode_potentials(*part_.coarser(), *coarser_run_, k));
        add_diffraction(model_, found, k, database, &coarser.diffraction[k]);
      });
}

void PartComputation::add_distant_waves(HydrodynamicDatabase& database,
                                        const Progress& progress) const {
  const FrequencyDomain scattering(model_, part_, damping_);
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    progress.send(k);
    const double w = database.frequencies[k];
    FlowOfPart sent = flow(k);
    if (!database.headings.empty()) {
      sent.scattered = scattering.calc_body_potentials(
          w, calc_opposed_velocities(model_, part_.parity(), w, database.headings));
    }
    add_far_field(model_, sent, k, database);
  }
}

/// Of each mode's added mass on itself at infinite frequency, 6N; kg, kg m2.
Eigen::VectorXd find_error_of_lone_rows(const PanelModel& model, const DatabaseSettings& settings,
                                        const HydrodynamicDatabase& database) {
  const double density = database.water.density;
  const Eigen::VectorXd volumes = database.infinite_added_mass.diagonal() / density;
  return density * calc_error_of_lone_rows(model, volumes, settings.rankine);
}

}  // namespace

void require_panels_for_waves(const PanelModel& model, double frequency) {
  const double length = 2.0 * std::numbers::pi / calc_wave_number(frequency, model.water());
  const Panel* widest = nullptr;
  for (const Panel& panel : model.body_mesh().panels) {
    double top = panel.vertices[0].z();
    for (const Vector3& vertex : panel.vertices) top = std::max(top, vertex.z());
    if (top < -0.25 * length) continue;
    if (widest == nullptr || panel.diameter() > widest->diameter()) widest = &panel;
  }
  if (widest == nullptr || widest->diameter() <= length / 3.0) return;
  std::ostringstream message;
  message << "at " << frequency << " rad/s waves are " << length
          << " m long, but a panel near the surface, at (" << widest->centroid.transpose()
          << ") m, is " << widest->diameter()
          << " m across: at least three must go into a wave; leave out the highest frequencies, or "
             "take more panels";
  throw ModelError(message.str());
}

double database_bytes(const PanelModel& model, const DatabaseSettings& settings) {
  const bool finite_depth = !is_deep(model.water());
  // A solution, and the march's operator.
  const auto bytes_of = [&](int body_panels, int surface_panels) {
    return rankine_part_bytes(body_panels, surface_panels, finite_depth) +
           FreeSurfaceMarch::operator_bytes(surface_panels);
  };
  const int bodies = model.body_mesh().size(), surface = model.surface_mesh().size();
  double bytes =
      bytes_of(bodies, surface) + elevation_bytes(static_cast<double>(surface) * model.mode_count(),
                                                  settings.frequencies.size());
  // The coarser solution is made beside the finer one's matrices, and stays to the end.
  const RankineSettings rankine = rankine_settings(model, settings);
  if (rankine.coarser) {
    const int coarser = rankine.coarser->surface.count;
    bytes += bytes_of(rankine.coarser->bodies.count, coarser);
    // Its equations at the middles of flat clusters are made with the finer panels.
    const auto middles = static_cast<double>(rankine.coarser->flat.clusters.size());
    bytes += 8.0 * middles * (2.0 * bodies + (finite_depth ? 2.0 : 1.0) * surface);
    if (!settings.headings.empty())
      bytes += elevation_bytes(static_cast<double>(coarser) * model.mode_count(),
                               settings.frequencies.size());
  }
  // The factors that are kept, and a complex system with its factors.
  const double n = surface, all = bodies + n;
  if (settings.with_far_field) bytes += 8.0 * all * all + 32.0 * n * n;
  // When all else is done.
  if (settings.with_coarser) bytes = std::max(bytes, lone_rows_bytes(model));
  return bytes;
}

HydrodynamicDatabase compute_database(const PanelModel& model, const DatabaseSettings& settings,
                                      DatabaseReport* report) {
  check_frequencies(settings);
  require_panels_for_waves(model, settings.frequencies.back());
  if (model.surface_mesh().size() == 0) {
    throw ModelError("no body reaches the surface: without a surface mesh there are no waves");
  }
  HydrodynamicDatabase database = begin_database(model, settings);
  const double lowest = settings.frequencies.front(), highest = settings.frequencies.back();
  const double duration =
      settings.duration > 0.0 ? settings.duration : 3.0 * 2.0 * std::numbers::pi / lowest;
  const int most_lengths = settings.duration > 0.0 ? 1 : 4;
  const double strength =
      settings.damping_strength > 0.0 ? settings.damping_strength : damping_zone(lowest).strength;
  DatabaseReport unused;
  DatabaseReport& account = report != nullptr ? *report : unused;
  account = {};
  account.body_panels = model.body_mesh().size();
  account.surface_panels = model.surface_mesh().size();
  account.peak_bytes = database_bytes(model, settings);
  const RankineSettings rankine = rankine_settings(model, settings);
  CoarserForces coarser(model.mode_count(), settings.with_coarser ? settings.frequencies.size() : 0,
                        settings.headings.size());
  MatrixXd cut =
      MatrixXd::Zero(model.mode_count(), static_cast<Eigen::Index>(settings.frequencies.size()));
  double step = settings.time_step;
  const std::vector<Parity> parities = model.parities();
  Progress progress(settings, parities.size());
  for (std::size_t p = 0; p < parities.size(); ++p) {
    const Parity& parity = parities[p];
    // What no mode moves may scatter waves all the same.
    if (!settings.with_far_field && model.normal_velocities(parity).isZero(0.0)) continue;
    progress.part(p);
    progress.solve();
    PartComputation computation(model, parity, settings, rankine, strength);
    if (!(step > 0.0)) step = std::min(0.8 * computation.step_limit(), 0.25 / highest);
    if (!(0.5 * highest * step < 1.0)) {
      throw ModelError("the highest frequency, " + std::to_string(highest) +
                       " rad/s, is too high for a step of " + std::to_string(step) + " s");
    }
    ++account.parts;
    auto start = std::chrono::steady_clock::now();
    account.asymmetry =
        std::max(account.asymmetry, computation.added_mass_asymmetry(database.infinite_added_mass));
    const auto steps = static_cast<long>(std::ceil(duration / step));
    account.steps += computation.run(step, {steps, most_lengths}, database.retardation, progress);
    computation.add_frequencies(database);
    if (coarser.sought()) computation.add_coarser(coarser);
    computation.add_cut(cut);
    account.march_s += seconds_since(start);
    start = std::chrono::steady_clock::now();
    progress.excite();
    computation.add_waves(database, coarser);
    if (settings.with_far_field) computation.add_distant_waves(database, progress);
    account.excitation_s += seconds_since(start);
    const RankineTiming& timing = computation.part().timing();
    account.solution.influence_s += timing.influence_s;
    account.solution.factorisation_s += timing.factorisation_s;
    account.solution.reduction_s += timing.reduction_s;
    account.reciprocity_error =
        std::max(account.reciprocity_error, computation.part().reciprocity_error());
    account.step_limit = std::isnan(account.step_limit)
                             ? computation.step_limit()
                             : std::min(account.step_limit, computation.step_limit());
  }
  database.time_step = step;
  for (MatrixXd& mass : database.added_mass) mass += database.infinite_added_mass;
  if (settings.with_coarser) {
    const PanelClusters& clusters = rankine.coarser->bodies;
    coarser.infinite_error = find_error_of_lone_rows(model, settings, database);
    database.change_from_coarser = calc_radiation_error(database, coarser, clusters);
    database.excitation_change_from_coarser =
        error_of_panels(largest_excitation_change(database, coarser), clusters);
  }
  database.cut_off_by_end = largest_share(database, cut);
  return database;
}

void calc_added_mass_and_damping(const HydrodynamicDatabase& database, double frequency,
                                 Eigen::MatrixXd& added_mass, Eigen::MatrixXd& damping) {
  const double dt = database.time_step;
  damping = 0.5 * dt * database.retardation[0];
  MatrixXd sine = frequency * dt * dt / 12.0 * database.retardation[0];
  for (std::size_t n = 1; n < database.retardation.size(); ++n) {
    const double angle = frequency * dt * static_cast<double>(n);
    damping += dt * std::cos(angle) * database.retardation[n];
    sine += dt * std::sin(angle) * database.retardation[n];
  }
  added_mass = database.infinite_added_mass - sine / frequency;
}

}  // namespace blocklift::dynamics

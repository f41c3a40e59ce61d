#include "dynamics/marine/radiation/hydrodynamic_database.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/incident_wave.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double tapered_fraction = 0.4;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// 1 over the first part of the run, then half a cosine down to 0 at its end.
double taper(long step, long steps) {
  const double begin = (1.0 - tapered_fraction) * static_cast<double>(steps);
  const double fraction =
      (static_cast<double>(step) - begin) / (static_cast<double>(steps) - begin);
  return fraction <= 0.0 ? 1.0 : 0.5 * (1.0 + std::cos(std::numbers::pi * std::min(1.0, fraction)));
}

void check(const DatabaseSettings& settings) {
  if (settings.frequencies.empty()) throw ModelError("no frequency is given for the database");
  for (std::size_t k = 0; k < settings.frequencies.size(); ++k) {
    const double w = settings.frequencies[k];
    if (!(w > 0.0) || !std::isfinite(w) || (k > 0 && w <= settings.frequencies[k - 1])) {
      throw ModelError("frequency " + std::to_string(k + 1) + " of the database is " +
                       std::to_string(w) + " rad/s: frequencies must be positive and ascend");
    }
  }
}

/// Tells the progress of the parts: a third of each for its solution, the rest for its march.
class Progress {
 public:
  Progress(const DatabaseSettings& settings, std::size_t parts)
      : tell_(settings.progress), parts_(static_cast<double>(parts)) {}
  void part(std::size_t index) { done_ = static_cast<double>(index); }
  void solve() const { show(0.0, "influence of the panels"); }
  void march(double fraction) const { show(0.35 + 0.6 * fraction, "impulse responses"); }
  void excite() const { show(0.95, "waves of all headings"); }

 private:
  void show(double fraction, const char* what) const {
    if (tell_) tell_((done_ + fraction) / parts_, what);
  }
  const std::function<void(double, const char*)>& tell_;
  double parts_, done_ = 0.0;
};

/// The share of one part in the database: its impulse run and what follows from it.
class PartComputation {
 public:
  PartComputation(const PanelModel& model, const Parity& parity, const DatabaseSettings& settings,
                  double duration, double damping_strength)
      : model_(model),
        settings_(settings),
        part_(model, parity, settings.rankine),
        duration_(duration),
        march_(part_, DampingZone{damping_strength}.rates(model.surface()), model.water().gravity,
               part_.surface_columns().cols()) {}

  const RankinePart& part() const { return part_; }
  double step_limit() const { return march_.step_limit(); }
  double added_mass_asymmetry(MatrixXd& infinite_added_mass) const;
  long run(double step, std::vector<MatrixXd>& retardation, const Progress& progress);
  void add_frequencies(HydrodynamicDatabase& database) const;
  void add_excitation(HydrodynamicDatabase& database) const;

 private:
  void accumulate(long step, double taper);
  double discrete_frequency(double w) const { return 2.0 / step_ * std::asin(0.5 * w * step_); }

  const PanelModel& model_;
  const DatabaseSettings& settings_;
  RankinePart part_;
  double duration_;
  FreeSurfaceMarch march_;
  double step_ = not_a_number;
  /// Integral of W^1/2 eta e^{-iwt} over the run, for each frequency: panels x modes.
  std::vector<MatrixXd> cosine_, sine_;
};

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

void PartComputation::accumulate(long step, double weight) {
  for (std::size_t k = 0; k < settings_.frequencies.size(); ++k) {
    const double angle =
        discrete_frequency(settings_.frequencies[k]) * static_cast<double>(step) * step_;
    cosine_[k] += weight * std::cos(angle) * march_.elevation();
    sine_[k] -= weight * std::sin(angle) * march_.elevation();
  }
}

long PartComputation::run(double step, std::vector<MatrixXd>& retardation,
                          const Progress& progress) {
  step_ = step;
  const auto steps = static_cast<long>(std::ceil(duration_ / step));
  const MatrixXd& q = part_.surface_columns();
  const auto& modes = part_.modes();
  cosine_.assign(settings_.frequencies.size(), MatrixXd::Zero(q.rows(), q.cols()));
  sine_ = cosine_;
  retardation.resize(static_cast<std::size_t>(steps) + 1,
                     MatrixXd::Zero(model_.mode_count(), model_.mode_count()));
  const double factor = model_.water().density * model_.water().gravity * part_.image_count();
  march_.start(q, step);
  for (long k = 0;; ++k) {
    const double reduction = taper(k, steps);
    MatrixXd share = factor * reduction * (q.transpose() * march_.elevation());
    retardation[static_cast<std::size_t>(k)](modes, modes) += 0.5 * (share + share.transpose());
    accumulate(k, (k == 0 ? 0.5 : 1.0) * step * reduction);
    if (k == steps) break;
    if (k % 16 == 0) progress.march(static_cast<double>(k) / static_cast<double>(steps));
    march_.advance();
  }
  return steps;
}

void PartComputation::add_frequencies(HydrodynamicDatabase& database) const {
  const MatrixXd& q = part_.surface_columns();
  const auto& modes = part_.modes();
  const double factor = model_.water().density * model_.water().gravity * part_.image_count();
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    const double w = database.frequencies[k];
    const double half_angle = 0.5 * w * step_;
    const double scale = factor / std::sqrt(1.0 - half_angle * half_angle);
    const MatrixXd damping = scale * (q.transpose() * cosine_[k]);
    const MatrixXd mass = scale / w * (q.transpose() * sine_[k]);
    database.damping[k](modes, modes) += 0.5 * (damping + damping.transpose());
    database.added_mass[k](modes, modes) += 0.5 * (mass + mass.transpose());
  }
}

void PartComputation::add_excitation(HydrodynamicDatabase& database) const {
  const Water& water = model_.water();
  const MatrixXd weighted_normals = model_.body_areas().asDiagonal() * part_.normal_velocities();
  const auto headings = static_cast<Eigen::Index>(database.headings.size());
  parallel_for(
      static_cast<int>(database.frequencies.size()), settings_.rankine.threads, [&](int index) {
        const auto k = static_cast<std::size_t>(index);
        const double w = database.frequencies[k];
        const double half_angle = 0.5 * w * step_;
        const double scale = 1.0 / std::sqrt(1.0 - half_angle * half_angle);
        // phi on the surface per unit velocity is -g eta/(i w); then on the bodies.
        MatrixXcd surface(cosine_[k].rows(), cosine_[k].cols());
        surface.real() = scale * cosine_[k];
        surface.imag() = scale * sine_[k];
        surface *= -water.gravity / Complex(0.0, w);
        MatrixXcd bodies(part_.body_columns().rows(), part_.body_columns().cols());
        bodies.real() = part_.body_columns() + part_.body_from_surface() * surface.real();
        bodies.imag() = part_.body_from_surface() * surface.imag();
        const MatrixXcd weighted_potentials = model_.body_areas().asDiagonal() * bodies;
        for (Eigen::Index h = 0; h < headings; ++h) {
          const IncidentWave wave(water, w, database.headings[static_cast<std::size_t>(h)]);
          const Eigen::VectorXcd potential = model_.part_of(
              part_.parity(), [&](const Vector3& p, const Vector3&) { return wave.potential(p); });
          const Eigen::VectorXcd opposed =
              model_.part_of(part_.parity(), [&](const Vector3& p, const Vector3& n) -> Complex {
                return -(wave.velocity(p).transpose() * n)(0);
              });
          const Complex factor = Complex(0.0, w * water.density * part_.image_count());
          const Eigen::VectorXcd incident = factor * (weighted_normals.transpose() * potential);
          const Eigen::VectorXcd diffracted = factor * (weighted_potentials.transpose() * opposed);
          for (std::size_t m = 0; m < part_.modes().size(); ++m) {
            database.froude_krylov[k](part_.modes()[m], h) +=
                incident[static_cast<Eigen::Index>(m)];
            database.diffraction[k](part_.modes()[m], h) +=
                diffracted[static_cast<Eigen::Index>(m)];
          }
        }
      });
}

HydrodynamicDatabase make_empty(const PanelModel& model, const DatabaseSettings& settings) {
  HydrodynamicDatabase database;
  database.water = model.water();
  for (const WettedBody& body : model.bodies()) {
    database.body_names.push_back(body.name);
    database.reference_points.push_back(body.reference_point);
    database.displaced_volumes.push_back(body.hull.displaced_volume());
  }
  const int modes = model.mode_count();
  const std::size_t count = settings.frequencies.size();
  const auto headings = static_cast<Eigen::Index>(settings.headings.size());
  database.infinite_added_mass = MatrixXd::Zero(modes, modes);
  database.frequencies = settings.frequencies;
  database.headings = settings.headings;
  database.added_mass.assign(count, MatrixXd::Zero(modes, modes));
  database.damping = database.added_mass;
  database.froude_krylov.assign(count, MatrixXcd::Zero(modes, headings));
  database.diffraction = database.froude_krylov;
  return database;
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
  const int surface = model.surface_mesh().size();
  const auto n = static_cast<double>(surface);
  // The march's operator in single precision, and two Fourier integrals for each frequency.
  const double integrals = 16.0 * static_cast<double>(settings.frequencies.size()) *
                           static_cast<double>(model.mode_count());
  return rankine_part_bytes(model.body_mesh().size(), surface, !is_deep(model.water())) +
         n * (4.0 * n + integrals);
}

HydrodynamicDatabase compute_database(const PanelModel& model, const DatabaseSettings& settings,
                                      DatabaseReport* report) {
  check(settings);
  require_panels_for_waves(model, settings.frequencies.back());
  if (model.surface_mesh().size() == 0) {
    throw ModelError("no body reaches the surface: without a surface mesh there are no waves");
  }
  HydrodynamicDatabase database = make_empty(model, settings);
  const double lowest = settings.frequencies.front(), highest = settings.frequencies.back();
  const double duration =
      settings.duration > 0.0 ? settings.duration : 3.0 * 2.0 * std::numbers::pi / lowest;
  const double strength =
      settings.damping_strength > 0.0 ? settings.damping_strength : damping_zone(lowest).strength;
  DatabaseReport unused;
  DatabaseReport& account = report != nullptr ? *report : unused;
  account = {};
  account.body_panels = model.body_mesh().size();
  account.surface_panels = model.surface_mesh().size();
  account.peak_bytes = database_bytes(model, settings);
  double step = settings.time_step;
  const std::vector<Parity> parities = model.parities();
  Progress progress(settings, parities.size());
  for (std::size_t p = 0; p < parities.size(); ++p) {
    const Parity& parity = parities[p];
    if (model.normal_velocities(parity).isZero(0.0)) continue;
    progress.part(p);
    progress.solve();
    PartComputation computation(model, parity, settings, duration, strength);
    if (!(step > 0.0)) step = std::min(0.8 * computation.step_limit(), 0.25 / highest);
    if (!(0.5 * highest * step < 1.0)) {
      throw ModelError("the highest frequency, " + std::to_string(highest) +
                       " rad/s, is too high for a step of " + std::to_string(step) + " s");
    }
    ++account.parts;
    auto start = std::chrono::steady_clock::now();
    account.asymmetry =
        std::max(account.asymmetry, computation.added_mass_asymmetry(database.infinite_added_mass));
    account.steps += computation.run(step, database.retardation, progress);
    computation.add_frequencies(database);
    account.march_s += seconds_since(start);
    start = std::chrono::steady_clock::now();
    progress.excite();
    computation.add_excitation(database);
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

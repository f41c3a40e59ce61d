#include "dynamics/marine/radiation/database_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/incident_wave.h"
#include "dynamics/marine/radiation/wave_on_hulls.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// What waves far away are of the integral over the bodies (add_far_field).
Complex far_field_scale(const Water& water, double w) {
  // psi is w/(i g) times the potential of an incident wave of unit amplitude.
  return w / Complex(0.0, water.gravity) / (2.0 * calc_group_velocity(w, water)) *
         std::sqrt(calc_wave_number(w, water) / (2.0 * std::numbers::pi)) *
         std::polar(1.0, 0.25 * std::numbers::pi);
}

/// The wave that meets the sought one comes from where that goes.
std::vector<double> met_waves(const FarField& far) {
  std::vector<double> headings;
  for (const double direction : far.directions) headings.push_back(direction + std::numbers::pi);
  return headings;
}

/// With what is known of radiated waves without the flow: int dphi/dn psi dS over the bodies.
FarField begin_far_field(const PanelModel& model, const DatabaseSettings& settings,
                         const WaveOnHulls& waves) {
  double reach = 0.0;
  for (const WettedBody& body : model.bodies()) {
    for (const Panel& panel : body.hull.panels) {
      reach = std::max(reach, panel.centroid.head<2>().norm());
    }
  }
  const int count =
      direction_count(reach, calc_wave_number(settings.frequencies.back(), model.water()));
  FarField far;
  for (int j = 0; j < count; ++j) far.directions.push_back(2.0 * std::numbers::pi * j / count);
  for (const double w : settings.frequencies) {
    const Complex scale = Complex(0.0, w) * far_field_scale(model.water(), w);
    far.radiated.push_back(scale * waves.integrate_potential(w, met_waves(far)).transpose());
  }
  far.scattered.assign(settings.frequencies.size(),
                       MatrixXcd::Zero(count, settings.headings.size()));
  return far;
}

}  // namespace

void check_frequencies(const DatabaseSettings& settings) {
  if (settings.frequencies.empty()) throw ModelError("no frequency is given for the database");
  for (std::size_t k = 0; k < settings.frequencies.size(); ++k) {
    const double w = settings.frequencies[k];
    if (!(w > 0.0) || !std::isfinite(w) || (k > 0 && w <= settings.frequencies[k - 1])) {
      throw ModelError("frequency " + std::to_string(k + 1) + " of the database is " +
                       std::to_string(w) + " rad/s: frequencies must be positive and ascend");
    }
  }
}

HydrodynamicDatabase begin_database(const PanelModel& model, const DatabaseSettings& settings) {
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
  const WaveOnHulls waves(model);
  for (const double w : settings.frequencies) {
    database.froude_krylov.push_back(Complex(0.0, w * model.water().density) *
                                     waves.integrate_potential(w, settings.headings));
  }
  database.diffraction.assign(count, MatrixXcd::Zero(modes, headings));
  if (settings.with_far_field) database.far_field = begin_far_field(model, settings, waves);
  return database;
}

Eigen::VectorXd largest_share(const std::vector<int>& modes, const MatrixXcd& forces,
                              const MatrixXd& amounts) {
  constexpr double negligible = 1e-3;
  const auto way_of = [&](Eigen::Index m) { return modes[m] / 3; };
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(forces.rows());
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    for (Eigen::Index m = 0; m < shares.size(); ++m) {
      double largest = 0.0;
      for (Eigen::Index n = 0; n < shares.size(); ++n) {
        if (way_of(n) == way_of(m)) largest = std::max(largest, forces(n, k).imag());
      }
      const double force = std::abs(forces(m, k));
      if (force < negligible * largest) continue;
      shares[m] = std::max(shares[m], amounts(m, k) / force);
    }
  }
  return shares;
}

namespace {

/// B + i w A of each mode on itself, modes x frequencies.
MatrixXcd forces_on_themselves(const HydrodynamicDatabase& database) {
  MatrixXcd forces(database.mode_count(), static_cast<Eigen::Index>(database.frequencies.size()));
  for (std::size_t k = 0; k < database.frequencies.size(); ++k) {
    auto column = forces.col(static_cast<Eigen::Index>(k));
    column.real() = database.damping[k].diagonal();
    column.imag() = database.frequencies[k] * database.added_mass[k].diagonal();
  }
  return forces;
}

}  // namespace

Eigen::VectorXd largest_share(const HydrodynamicDatabase& database, const MatrixXd& amounts) {
  std::vector<int> modes(static_cast<std::size_t>(database.mode_count()));
  std::iota(modes.begin(), modes.end(), 0);
  return largest_share(modes, forces_on_themselves(database), amounts);
}

CoarserForces::CoarserForces(Eigen::Index modes, std::size_t count, std::size_t headings)
    : radiation(count, MatrixXcd::Zero(modes, modes)),
      diffraction(headings == 0 ? 0 : count,
                  MatrixXcd::Zero(modes, static_cast<Eigen::Index>(headings))),
      arms(MatrixXcd::Zero(modes, static_cast<Eigen::Index>(count))),
      infinite_mass(Eigen::VectorXd::Zero(modes)),
      infinite_arms(Eigen::VectorXd::Zero(modes)),
      infinite_error(Eigen::VectorXd::Zero(modes)) {}

void CoarserForces::miss(const std::vector<int>& modes) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  for (MatrixXcd& force : radiation) force(modes, modes).setConstant(unknown);
  for (MatrixXcd& force : diffraction) force(modes, Eigen::all).setConstant(unknown);
}

namespace {

/// What a change is, with the arms filled in or without.
MatrixXd larger_with_or_without(const MatrixXcd& changes, const MatrixXcd& arms) {
  return changes.cwiseAbs().cwiseMax((changes - arms).cwiseAbs());
}

}  // namespace

Eigen::VectorXd calc_radiation_error(const HydrodynamicDatabase& database,
                                     const CoarserForces& coarser, const PanelClusters& clusters) {
  std::vector<int> modes(static_cast<std::size_t>(database.mode_count()));
  std::iota(modes.begin(), modes.end(), 0);
  MatrixXcd changes = forces_on_themselves(database);
  for (std::size_t k = 0; k < coarser.radiation.size(); ++k) {
    changes.col(static_cast<Eigen::Index>(k)) -= coarser.radiation[k].diagonal();
  }
  const Eigen::VectorXd in_waves =
      largest_share(database, larger_with_or_without(changes, coarser.arms));
  const MatrixXd mass = database.infinite_added_mass.diagonal();
  const MatrixXcd as_force = Complex(0.0, 1.0) * mass;
  const MatrixXcd change = mass - coarser.infinite_mass, arms = coarser.infinite_arms;
  const Eigen::VectorXd at_infinity =
      largest_share(modes, as_force, larger_with_or_without(change, arms));
  return error_of_panels(in_waves, clusters)
      .cwiseMax(error_of_panels(at_infinity, clusters) +
                caution_with_panels * largest_share(modes, as_force, coarser.infinite_error));
}

Eigen::VectorXd calc_mean_excitation(const HydrodynamicDatabase& database) {
  constexpr double lost = 1e-2;
  const MatrixXcd forces = forces_on_themselves(database);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(forces.rows());
  const Water& water = database.water;
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    const double w = database.frequencies[k];
    const double per_damping = 4.0 * water.density * water.gravity * calc_group_velocity(w, water) /
                               calc_wave_number(w, water);
    for (Eigen::Index m = 0; m < squares.size(); ++m) {
      const double damping = forces(m, k).real();
      if (damping > lost * std::abs(forces(m, k)))
        squares[m] = std::max(squares[m], per_damping * damping);
    }
  }
  return squares.cwiseSqrt();
}

Eigen::VectorXd largest_excitation_change(const HydrodynamicDatabase& database,
                                          const CoarserForces& coarser) {
  constexpr double negligible = 1e-3;
  if (database.headings.empty()) return {};
  Eigen::VectorXd changes = Eigen::VectorXd::Zero(database.mode_count());
  Eigen::VectorXd forces = changes;
  for (std::size_t k = 0; k < coarser.diffraction.size(); ++k) {
    const MatrixXcd difference = database.diffraction[k] - coarser.diffraction[k];
    changes = changes.cwiseMax(difference.cwiseAbs().rowwise().maxCoeff());
    forces = forces.cwiseMax(database.excitation(k).cwiseAbs().rowwise().maxCoeff());
  }
  constexpr Eigen::Index along_axes = 3;
  const Eigen::VectorXd means = calc_mean_excitation(database);
  for (Eigen::Index m = 0; m < changes.size(); ++m) {
    const double largest = forces.segment<along_axes>(m - m % along_axes).maxCoeff();
    if (forces[m] <= negligible * largest)
      changes[m] = 0.0;
    else
      changes[m] /= std::max(forces[m], means[m]);
  }
  return changes;
}

MatrixXcd calc_opposed_velocities(const PanelModel& model, const Parity& parity, double frequency,
                                  const std::vector<double>& headings) {
  MatrixXcd velocities(model.body_areas().size(), static_cast<Eigen::Index>(headings.size()));
  for (std::size_t h = 0; h < headings.size(); ++h) {
    const IncidentWave wave(model.water(), frequency, headings[h]);
    velocities.col(static_cast<Eigen::Index>(h)) =
        model.part_of(parity, [&](const Vector3& p, const Vector3& n) -> Complex {
          return -(wave.velocity(p).transpose() * n)(0);
        });
  }
  return velocities;
}

void add_diffraction(const PanelModel& model, const FlowOfPart& flow, std::size_t frequency,
                     HydrodynamicDatabase& database, MatrixXcd* coarser) {
  const double w = database.frequencies[frequency];
  const MatrixXcd weighted_potentials = model.body_areas().asDiagonal() * flow.potentials;
  const MatrixXcd opposed = calc_opposed_velocities(model, flow.parity, w, database.headings);
  const Complex factor(0.0, w * model.water().density * model.symmetry().image_count());
  database.diffraction[frequency](flow.modes, Eigen::all) +=
      factor * (weighted_potentials.transpose() * opposed);
  if (coarser == nullptr) return;
  const MatrixXcd weighted = model.body_areas().asDiagonal() * flow.coarser_potentials;
  (*coarser)(flow.modes, Eigen::all) += factor * (weighted.transpose() * opposed);
}

Eigen::VectorXcd calc_coarser_arms(const PanelModel& model, const FlowOfPart& flow,
                                   const CoarserPanels& panels) {
  const Eigen::VectorXd& areas = model.body_areas();
  const auto within = [&](const MatrixXd& values) {
    const MatrixXd means = panels.bodies.average(areas, values);
    MatrixXd result = values - means(panels.bodies.of_panel, Eigen::all);
    for (Eigen::Index k = 0; k < result.rows(); ++k) {
      if (panels.flat.of_panel[k] < 0) result.row(k).setZero();
    }
    return result;
  };
  const MatrixXd weighted = areas.asDiagonal() * within(flow.normal_velocities);
  MatrixXcd potentials(flow.potentials.rows(), flow.potentials.cols());
  potentials.real() = within(flow.potentials.real());
  potentials.imag() = within(flow.potentials.imag());
  const double factor = -2.0 * model.water().density * model.symmetry().image_count();
  return factor * weighted.cast<Complex>().cwiseProduct(potentials).colwise().sum().transpose();
}

void add_coarser_arms(const PanelModel& model, const FlowOfPart& flow, const CoarserPanels& panels,
                      const HydrodynamicDatabase& database, std::size_t frequency,
                      CoarserForces& coarser) {
  coarser.arms(flow.modes, static_cast<Eigen::Index>(frequency)) +=
      Complex(0.0, database.frequencies[frequency]) * calc_coarser_arms(model, flow, panels);
}

void add_far_field(const PanelModel& model, const FlowOfPart& flow, std::size_t frequency,
                   HydrodynamicDatabase& database) {
  const Water& water = model.water();
  const double w = database.frequencies[frequency];
  FarField& far = database.far_field;
  const std::vector<double> met = met_waves(far);
  MatrixXcd psi(model.body_areas().size(), static_cast<Eigen::Index>(met.size()));
  for (std::size_t j = 0; j < met.size(); ++j) {
    const IncidentWave wave(water, w, met[j]);
    psi.col(static_cast<Eigen::Index>(j)) = model.part_of(
        flow.parity, [&](const Vector3& p, const Vector3&) { return wave.potential(p); });
  }
  const MatrixXcd psi_n = -calc_opposed_velocities(model, flow.parity, w, met);
  const Complex scale = far_field_scale(water, w) * (1.0 * model.symmetry().image_count());
  const auto weighted = [&](const MatrixXcd& values) {
    return MatrixXcd(model.body_areas().asDiagonal() * values);
  };
  far.radiated[frequency](Eigen::all, flow.modes) -=
      Complex(0.0, w) * scale * (psi_n.transpose() * weighted(flow.potentials));
  if (database.headings.empty()) return;
  const MatrixXcd opposed = calc_opposed_velocities(model, flow.parity, w, database.headings);
  far.scattered[frequency] +=
      scale * (psi.transpose() * weighted(opposed) - psi_n.transpose() * weighted(flow.scattered));
}

}  // namespace blocklift::dynamics

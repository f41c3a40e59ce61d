#include "dynamics/marine/loads/diffraction_force.h"

#include <cmath>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/level_axes.h"
#include "dynamics/marine/loads/radiated_water.h"
#include "dynamics/marine/loads/whole_turn.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;

void check(const DiffractionForce::Definition& d) {
  const std::string start = "the diffraction force " + d.name;
  if (!d.series || d.series->databases.empty() || !d.sea) {
    throw ModelError(start + " lacks its database or its sea");
  }
  if (d.frame.body <= world_index) throw ModelError(start + " acts on no body");
  const HydrodynamicDatabase& first = d.series->databases.front();
  if (d.database_body < 0 || d.database_body >= first.body_count()) {
    throw ModelError(start + " asks for a body that the database does not hold");
  }
  if (d.series->databases.size() > 1 && d.mark.body <= world_index) {
    throw ModelError(start + " has databases of several draughts, and no body whose draught it is");
  }
  if (d.sea->waves.is_still()) return;
  if (first.headings.empty() || first.frequencies.empty()) {
    throw ModelError(start + ": the database holds no diffraction");
  }
}

bool takes(FroudeKrylovPart part, Eigen::Index mode) {
  const bool along_water = mode == surge || mode == sway || mode == yaw;
  return part == FroudeKrylovPart::whole || (part == FroudeKrylovPart::along_water && along_water);
}

}  // namespace

DiffractionForce::DiffractionForce(Definition definition) : definition_(std::move(definition)) {
  if (!definition_.series && definition_.database) {
    definition_.series = std::make_shared<const HydrodynamicSeries>(
        HydrodynamicSeries{0, {0.0}, {*definition_.database}});
  }
  definition_.database.reset();
  check(definition_);
  const WaveField& field = definition_.sea->waves;
  if (field.is_still()) return;
  if (state_count() > 1) interpolation_ = DraughtInterpolation(definition_.series->draughts);
  headings_ = headings_of_whole_turn("the diffraction force " + definition_.name,
                                     definition_.series->databases.front().headings);
  for (std::size_t c = 0; c < field.component_count(); ++c) {
    add_component(field.component(c), field.wave_number(c));
  }
}

void DiffractionForce::add_component(const WaveComponent& wave, double wave_number) {
  require_frequency(definition_.series->databases.front().frequencies, wave.omega);
  waves_.push_back(wave);
  ways_.push_back({wave_number, std::cos(wave.heading), std::sin(wave.heading)});
  const std::size_t count = headings_.size() - 1;
  for (const HydrodynamicDatabase& database : definition_.series->databases) {
    const std::size_t first = amplitudes_.size();
    for (std::size_t j = 0; j < count; ++j) {
      amplitudes_.push_back(wave.amplitude * amplitude_at(database, wave.omega, j));
    }
    amplitudes_.push_back(Amplitude(amplitudes_[first]));
  }
}

// X at one of the database's headings, its phase taken at the reference point.
DiffractionForce::Amplitude DiffractionForce::amplitude_at(const HydrodynamicDatabase& database,
                                                           double frequency,
                                                           std::size_t heading) const {
  const std::vector<double>& known = database.frequencies;
  const auto body = static_cast<std::size_t>(definition_.database_body);
  const Vector3& p_0 = database.reference_points[body];
  const double theta = database.headings[heading];
  const double place = std::cos(theta) * p_0.x() + std::sin(theta) * p_0.y();
  const auto at = [&](std::size_t f) {
    const auto column = static_cast<Eigen::Index>(heading);
    const auto row = modes_per_body * static_cast<Eigen::Index>(body);
    Amplitude value = database.diffraction[f].col(column).segment<6>(row);
    for (Eigen::Index m = 0; m < modes_per_body; ++m) {
      if (takes(definition_.froude_krylov, m))
        value[m] += database.froude_krylov[f](row + m, column);
    }
    const double phase = calc_wave_number(known[f], database.water) * place;
    Amplitude ordered;
    for (Eigen::Index m = 0; m < modes_per_body; ++m) {
      ordered[place_of_mode(m)] = value[m] * std::polar(1.0, phase);
    }
    return ordered;
  };
  const PlaceInRange place_of = find_frequency(known, frequency);
  if (place_of.share == 1.0) return at(place_of.upper);
  return (1.0 - place_of.share) * at(place_of.upper - 1) + place_of.share * at(place_of.upper);
}

ForceVector DiffractionForce::calc_force(const MotionState& state) const {
  if (waves_.empty()) return ForceVector::zero();
  const BodyFrame& frame = definition_.frame;
  const Pose X_WH = state.kinematics.X_WB[frame.body] * frame.X_BH;
  const double yaw = find_heading(X_WH.R);
  const std::size_t count = headings_.size(), states = state_count();
  DraughtShares shares;
  if (states > 1) {
    shares = interpolation_.calc_shares(definition_.mark.calc_draught(state.kinematics));
  }
  Eigen::Matrix<double, 6, 1> force = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t c = 0; c < waves_.size(); ++c) {
    const WaveComponent& wave = waves_[c];
    const auto [j, s] = find_place(headings_, wave.heading - yaw);
    const double phase = wave.omega * state.time - wave.phase -
                         ways_[c].wave_number * (ways_[c].x * X_WH.p.x() + ways_[c].y * X_WH.p.y());
    const Complex at_now = std::polar(1.0, phase);
    for (std::size_t k = 0; k < states; ++k) {
      const double weight = shares.weight[k];
      if (weight == 0.0) continue;
      const Amplitude& before = amplitudes_[(c * states + k) * count + j - 1];
      const Amplitude& after = amplitudes_[(c * states + k) * count + j];
      for (Eigen::Index m = 0; m < 6; ++m) {
        const Complex X = (1.0 - s) * before[m] + s * after[m];
        force[m] += weight * (X.real() * at_now.real() - X.imag() * at_now.imag());
      }
    }
  }
  force *= definition_.sea->waves.ramp().factor(state.time);
  const Matrix3 R_WL = level_axes(X_WH.R);
  return {R_WL * force.head<3>(), R_WL * force.tail<3>()};
}

void DiffractionForce::add_force(const MotionState& state, const ForceVector& F_R_W,
                                 Loads& loads) const {
  if (waves_.empty()) return;
  const auto body = static_cast<std::size_t>(definition_.frame.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.frame.X_BH.p;
  loads.F_Bo_W[body] += shift_to(F_R_W, r_W);
}

void DiffractionForce::add_derivatives(const MotionState& state,
                                       ForceDerivatives& derivatives) const {
  if (waves_.empty()) return;
  const auto body = static_cast<std::size_t>(definition_.frame.body);
  derivatives.locate(0, definition_.frame.body,
                     state.kinematics.X_WB[body].R * definition_.frame.X_BH.p);
  const ForceVector F = calc_force(state);
  derivatives.add_held_force(0, F.force);
  // The axes stay level: they turn with the yaw alone.
  const Vector3 up = Vector3::UnitZ();
  Eigen::Matrix<double, 6, 6> by_turn = Eigen::Matrix<double, 6, 6>::Zero();
  by_turn.col(2) << up.cross(F.moment), up.cross(F.force);
  derivatives.add_wrench_block(0, 0, by_turn, Eigen::Matrix<double, 6, 6>::Zero());
}

EnergyAccount DiffractionForce::calc_energy(const MotionState& state,
                                            const ForceVector& F_R_W) const {
  if (waves_.empty()) return {};
  const auto body = static_cast<std::size_t>(definition_.frame.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.frame.X_BH.p;
  return {.supplied_power = dot(F_R_W, shift(state.kinematics.V_WB[body], r_W))};
}

}  // namespace blocklift::dynamics

#include "dynamics/marine/loads/slow_drift.h"

#include <array>
#include <cmath>
#include <complex>

#include "dynamics/errors.h"
#include "dynamics/marine/loads/level_axes.h"
#include "dynamics/marine/loads/whole_turn.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;

constexpr std::array<int, 3> drifting = {surge, sway, yaw};

void require_drift(const SlowDrift::Definition& d) {
  const std::string start = "the slow drift " + d.name;
  if (!d.database || !d.sea) throw ModelError(start + " lacks its database or its sea");
  if (d.frame.body <= world_index) throw ModelError(start + " acts on no body");
  if (d.database_body < 0 || d.database_body >= d.database->body_count()) {
    throw ModelError(start + " asks for a body that the database does not hold");
  }
  if (d.database->mean_drift.empty() || d.database->headings.empty()) {
    throw ModelError(start + ": the database holds no mean drift");
  }
}

}  // namespace

SlowDrift::SlowDrift(Definition definition) : definition_(std::move(definition)) {
  require_drift(definition_);
  const WaveField& field = definition_.sea->waves;
  if (field.is_still()) return;
  const HydrodynamicDatabase& database = *definition_.database;
  headings_ = headings_of_whole_turn("the slow drift " + definition_.name, database.headings);
  const auto columns = static_cast<Eigen::Index>(headings_.size());
  for (std::size_t c = 0; c < field.component_count(); ++c) {
    const WaveComponent& component = field.component(c);
    require_frequency(database.frequencies, component.omega);
    const PlaceInRange place = find_frequency(database.frequencies, component.omega);
    Wave wave{component.omega, component.phase, component.heading,
              field.wave_number(c) *
                  Eigen::Vector2d(std::cos(component.heading), std::sin(component.heading)),
              Eigen::Matrix3Xd(3, columns)};
    for (std::size_t i = 0; i < drifting.size(); ++i) {
      const Eigen::Index row = modes_per_body * Eigen::Index{definition_.database_body} +
                               static_cast<Eigen::Index>(drifting[i]);
      Eigen::RowVectorXd values = place.share * database.mean_drift[place.upper].row(row);
      if (place.share < 1.0) {
        values += (1.0 - place.share) * database.mean_drift[place.upper - 1].row(row);
      }
      wave.drift.row(i).head(columns - 1) =
          component.amplitude * component.amplitude * values.head(columns - 1);
    }
    wave.drift.col(columns - 1) = wave.drift.col(0);
    waves_.push_back(std::move(wave));
  }
}

ForceVector SlowDrift::calc_force(const MotionState& state) const {
  if (waves_.empty()) return ForceVector::zero();
  const BodyFrame& frame = definition_.frame;
  const Pose X_WH = state.kinematics.X_WB[frame.body] * frame.X_BH;
  const double yaw_angle = find_heading(X_WH.R);
  std::array<Complex, 3> pushing{}, pulling{};
  for (const Wave& wave : waves_) {
    const PlaceInTurn place = find_place(headings_, wave.heading - yaw_angle);
    const auto after = static_cast<Eigen::Index>(place.after);
    const Vector3 drift =
        (1.0 - place.share) * wave.drift.col(after - 1) + place.share * wave.drift.col(after);
    const Complex signal = std::polar(
        1.0, wave.frequency * state.time - wave.phase - wave.wave_vector.dot(X_WH.p.head<2>()));
    for (std::size_t i = 0; i < drifting.size(); ++i) {
      const double size = drift[i];
      (size > 0.0 ? pushing : pulling)[i] += std::sqrt(std::abs(size)) * signal;
    }
  }
  Vector3 force;
  for (std::size_t i = 0; i < drifting.size(); ++i) {
    force[i] = std::norm(pushing[i]) - std::norm(pulling[i]);
  }
  const double factor = definition_.sea->waves.ramp().factor(state.time);
  force *= factor * factor;
  return {Vector3(0.0, 0.0, force.z()), level_axes(X_WH.R) * Vector3(force.x(), force.y(), 0.0)};
}

void SlowDrift::add_forces(const MotionState& state, Loads& loads) const {
  if (waves_.empty()) return;
  const auto body = static_cast<std::size_t>(definition_.frame.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.frame.X_BH.p;
  loads.F_Bo_W[body] += shift_to(calc_force(state), r_W);
}

void SlowDrift::add_derivatives(const MotionState& state, ForceDerivatives& derivatives) const {
  if (waves_.empty()) return;
  const auto body = static_cast<std::size_t>(definition_.frame.body);
  derivatives.locate(0, definition_.frame.body,
                     state.kinematics.X_WB[body].R * definition_.frame.X_BH.p);
  const ForceVector F = calc_force(state);
  derivatives.add_held_force(0, F.force);
  // The axes stay level: they turn with the yaw alone.
  Eigen::Matrix<double, 6, 6> by_turn = Eigen::Matrix<double, 6, 6>::Zero();
  by_turn.block<3, 1>(3, 2) = Vector3(-F.force.y(), F.force.x(), 0.0);
  derivatives.add_wrench_block(0, 0, by_turn, Eigen::Matrix<double, 6, 6>::Zero());
}

EnergyAccount SlowDrift::calc_energy(const MotionState& state) const {
  if (waves_.empty()) return {};
  const auto body = static_cast<std::size_t>(definition_.frame.body);
  const Vector3 r_W = state.kinematics.X_WB[body].R * definition_.frame.X_BH.p;
  return {.supplied_power = dot(calc_force(state), shift(state.kinematics.V_WB[body], r_W))};
}

}  // namespace blocklift::dynamics

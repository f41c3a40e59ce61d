#include "dynamics/simulation/energy_ledger.h"

#include <algorithm>

#include "dynamics/multibody/energy.h"

namespace blocklift::dynamics {

namespace {

// Of all force elements but those of hulls.
EnergyAccount calc_element_energy(const LiftSystem& system, double t, const LiftWorkspace& w) {
  const MotionState state{t, w.q, w.v, w.kinematics};
  EnergyAccount sum;
  for_each_element(system.elements(), [&](const auto& element) {
    if constexpr (!is_evaluated_apart<decltype(element)>) sum += element.calc_energy(state);
  });
  for (std::size_t i = 0; i < w.tugger_loads.size(); ++i) sum += calc_tugger_energy(system, i, w);
  return sum;
}

double calc_hull_power(const LiftSystem& system, double t, const LiftWorkspace& w) {
  const auto& hulls = std::get<std::vector<HullForce>>(system.elements());
  double power = 0.0;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    if (!hulls[i].in_waves()) continue;
    const auto body = static_cast<std::size_t>(hulls[i].definition().body);
    power += dot(w.F_Bo_W_of_hulls[i], w.kinematics.V_WB[body]);
  }
  const auto& scattering = std::get<std::vector<DiffractionForce>>(system.elements());
  const MotionState state{t, w.q, w.v, w.kinematics};
  for (std::size_t i = 0; i < scattering.size(); ++i) {
    power += scattering[i].calc_energy(state, w.F_R_W_of_scattering[i]).supplied_power;
  }
  return power;
}

bool drives_move(const LiftSystem& system, const LiftWorkspace& w) {
  const std::vector<int>& driven = system.mechanism().driven_velocities();
  return std::any_of(driven.begin(), driven.end(), [&](int k) { return w.v[k] != 0.0; });
}

}  // namespace

EnergyAccount calc_rope_energy(const LiftSystem& system, std::size_t rope, const LiftWorkspace& w) {
  return system.ropes()[rope].calc_energy(w.rope_loads[rope]);
}

EnergyAccount calc_tugger_energy(const LiftSystem& system, std::size_t line,
                                 const LiftWorkspace& w) {
  return system.tugger_lines()[line].calc_energy(w.tugger_loads[line]);
}

EnergyRates calc_energy_rates(const LiftSystem& system, double t, const LiftWorkspace& w) {
  EnergyRates rates;
  for (const int k : system.mechanism().driven_velocities()) {
    if (w.v[k] != 0.0) rates.drive_power += w.joint_force[k] * w.v[k];
  }
  rates.dissipated_power = calc_damping_power(system.mechanism(), w.v);
  for (std::size_t i = 0; i < w.rope_loads.size(); ++i) {
    const EnergyAccount account = calc_rope_energy(system, i, w);
    rates.winch_power += account.supplied_power;
    rates.dissipated_power += account.dissipated_power;
  }
  for (std::size_t i = 0; i < w.support_loads.size(); ++i) {
    rates.dissipated_power +=
        system.supports()[i].calc_energy(w.kinematics, w.support_loads[i]).dissipated_power;
  }
  const EnergyAccount elements = calc_element_energy(system, t, w);
  rates.outside_power = elements.supplied_power + calc_hull_power(system, t, w);
  rates.dissipated_power += elements.dissipated_power;
  // The memory gives and takes: what the bodies lose to it is in the waves, or comes back.
  if (system.water()) {
    rates.outside_power += w.water_force.dot(w.level_velocity);
    if (system.water()->varies())
      rates.dissipated_power += system.water()->calc_entry_loss(w.water_shares, w.water_velocity);
  }
  return rates;
}

StoredEnergy calc_stored_energy(const LiftSystem& system, double t, const LiftWorkspace& w) {
  StoredEnergy energy;
  energy.kinetic = calc_kinetic_energy(system.mechanism(), w.kinematics) +
                   calc_vibration_energy(system.mechanism(), w.v);
  if (const AddedInertiaWorkspace* water = w.added()) {
    energy.kinetic += 0.5 * w.water_velocity.dot(water->matrix * w.water_velocity);
  }
  energy.gravity = calc_gravity_potential(system.mechanism(), w.kinematics);
  for (std::size_t i = 0; i < w.rope_loads.size(); ++i) {
    energy.elastic += calc_rope_energy(system, i, w).stored_energy;
  }
  for (const ElasticBody::Workspace& body : w.elastic) energy.elastic += body.energy;
  for (std::size_t i = 0; i < w.support_loads.size(); ++i) {
    energy.elastic +=
        system.supports()[i].calc_energy(w.kinematics, w.support_loads[i]).stored_energy;
  }
  energy.elastic += calc_element_energy(system, t, w).stored_energy;
  const MotionState state{t, w.q, w.v, w.kinematics};
  for (const HullForce& hull : std::get<std::vector<HullForce>>(system.elements())) {
    const double stored = hull.calc_stored_energy(state);
    energy.elastic += stored;
    if (hull.in_waves()) energy.buoyancy_in_waves += stored;
  }
  return energy;
}

EnergyRates calc_energy_rates(const LiftSystem& system, double t, ConstVectorRef y,
                              const Contacts* contacts, HullForces hulls, LiftWorkspace& w) {
  set_state(system, y, w);
  set_drives(system, t, true, w);
  if (drives_move(system, w)) {
    calc_loads(system, t, contacts, w, hulls);
    calc_accelerations(system, w);
  } else {
    calc_contact_loads(system, contacts, w);
    if (hulls == HullForces::evaluated) calc_hull_forces(system, t, w);
    if (system.water()) calc_water_forces(*system.water(), t, w);
  }
  return calc_energy_rates(system, t, w);
}

}  // namespace blocklift::dynamics

#include "dynamics/simulation/time_integration.h"

#include "dynamics/simulation/integrator.h"

namespace blocklift::dynamics {

double AwaitedCondition::indicator(const LiftSystem& system, const LiftWorkspace& w) const {
  if (kind == Kind::slack || kind == Kind::taut) {
    const double pull = 1e-3 * w.rope_loads[rope].slack_indicator();
    return kind == Kind::taut ? pull : -pull;
  }
  double by_pads = 0.0;
  for (std::size_t i = 0; i < w.support_loads.size(); ++i) {
    if (system.supports()[i].definition().point.body == body)
      by_pads += w.support_loads[i].force_W.z();
  }
  if (kind == Kind::pads_at_least) return 1e-3 * (by_pads - force);
  double by_lines = 0.0;
  for (std::size_t i = 0; i < w.tugger_loads.size(); ++i) {
    const TuggerLine::Definition& line = system.tugger_lines()[i].definition();
    const double upwards = w.tugger_loads[i].tension * w.tugger_loads[i].direction_W.z();
    if (line.from.body == body) by_lines += upwards;
    if (line.to.body == body) by_lines -= upwards;
  }
  // calc_contact_loads has the loads of ropes, pads and tugger lines alone.
  const double by_ropes = w.loads.F_Bo_W[body].force.z() - by_pads - by_lines;
  return 1e-3 * (kind == Kind::ropes_at_least ? by_ropes - force : force - by_ropes);
}

IntegrationResult integrate(const LiftSystem& system, const Eigen::VectorXd& q,
                            const Eigen::VectorXd& v, const IntegrationSettings& settings) {
  return Integrator(system, q, v, settings).run();
}

}  // namespace blocklift::dynamics

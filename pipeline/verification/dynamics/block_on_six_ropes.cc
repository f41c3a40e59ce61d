#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/dynamics/dynamics_cases.h"
#include "pipeline/verification/models/rope_lifts.h"

namespace blocklift::pipeline {

VerificationCase block_on_six_ropes() {
  return {
      .name = "block-on-six-ropes",
      .stage = "dynamics",
      .source = "Simbody at the accuracy 1e-12",
      .compute = [] {
        const dynamics::LiftSystem lift = dynamics::examples::block_on_six_ropes();
        const auto end_at = [&](double tolerance) {
          return dynamics::integrate(lift, lift.q_start(), lift.v_start(),
                                     {.relative_tolerance = tolerance, .sample_interval = 1.0});
        };
        const dynamics::IntegrationResult fine = end_at(1e-9);
        const dynamics::Vector3 reference(-0.000643, -0.001888, 5.913927);
        std::vector<VerificationRow> rows;
        for (int axis = 0; axis < 3; ++axis) {
          // Half a unit of the reference's last digit.
          rows.push_back(compare(std::string("centre of mass at 120 s, ") + "xyz"[axis], "m",
                                 reference[axis], fine.q_end[axis], 0.5e-6));
        }
        const dynamics::EnergyHistory& e = fine.history.energy;
        const Eigen::ArrayXd energy = e.kinetic + e.gravity + e.elastic;
        const Eigen::ArrayXd work = e.winch_work - e.dissipated;
        rows.push_back(bound("energy less work, over the winches' work", "1",
                             (energy - energy[0] - work).abs().maxCoeff() / e.winch_work.maxCoeff(),
                             1e-9, "conservation of energy"));
        rows.push_back(bound("error of the centre of mass at the everyday tolerance, 1e-6", "m",
                             (end_at(1e-6).q_end.head<3>() - reference).norm(), 1e-5));
        return rows;
      }};
}

}  // namespace blocklift::pipeline

#include <cmath>

#include "dynamics/simulation/time_integration.h"
#include "pipeline/verification/dynamics/dynamics_cases.h"
#include "pipeline/verification/models/rope_lifts.h"

namespace blocklift::pipeline {

// 10 t on 20 m of rope (EA 40 MN, damping time 5 ms) swing from 0.3 rad while 8 m are wound up
// within limits of 1 m/s, 1 m/s2 and 1 m/s3, which takes 10 s. The reference solves
//   r'' = r theta'^2 + g cos theta - T/m,   theta'' = -(2 r' theta' + g sin theta) / r
// with T of the rope's law by an eighth-order Runge-Kutta method at 1e-13 (SciPy's DOP853);
// tests/verification/references/hoisted_pendulum.py computes it anew at order 16.
VerificationCase hoisted_pendulum() {
  return {.name = "hoisted-pendulum",
          .stage = "dynamics",
          .source = "polar equations, integrated independently at 1e-13",
          .compute = [] {
            dynamics::examples::SingleRopeLift model;
            model.damping_time = 5e-3;
            model.payout = -8.0;
            model.duration = 10.0;
            const dynamics::LiftSystem lift = model.build();
            const double r = model.length + model.mass * dynamics::examples::g / model.stiffness();
            const dynamics::Vector3 start(r * std::sin(0.3), 0, -r * std::cos(0.3));
            const dynamics::IntegrationResult run = dynamics::integrate(
                lift, start, lift.v_start(), {.relative_tolerance = 1e-11, .sample_interval = 1.0});
            // Over 10 s the error of one step grows by three orders, as the tests of the
            // integration measure.
            return std::vector<VerificationRow>{
                compare("load at 10 s, x", "m", 0.175122981025, run.q_end[0], 1e-8),
                compare("load at 10 s, z", "m", -12.033820596071, run.q_end[2], 1e-8)};
          }};
}

}  // namespace blocklift::pipeline

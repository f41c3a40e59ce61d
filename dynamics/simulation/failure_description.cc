#include "dynamics/simulation/failure_description.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "dynamics/multibody/loop_diagnosis.h"

namespace blocklift::dynamics {

void describe_motion(std::ostream& text, const LiftSystem& system, const LiftWorkspace& w) {
  const Mechanism& mechanism = system.mechanism();
  const auto speed = [&](std::size_t body) { return w.kinematics.V_WB[body].linear.norm(); };
  text << describe_ropes(system, w) << "; fastest bodies: ";
  std::vector<std::size_t> order(w.kinematics.V_WB.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return speed(a) > speed(b); });
  for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i) {
    text << (i > 0 ? ", " : "") << mechanism.body(static_cast<int>(order[i])).name << " ("
         << speed(order[i]) << " m/s)";
  }
  if (mechanism.loops().empty()) return;
  for (const std::string& sentence : diagnose_loops(mechanism, w.q).toggle_sentences(mechanism)) {
    text << "; " << sentence;
  }
}

}  // namespace blocklift::dynamics

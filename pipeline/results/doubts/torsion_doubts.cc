#include "pipeline/results/doubts/torsion_doubts.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "structure/stress/open_sections.h"

namespace blocklift::pipeline {

namespace {

double yield_of(const structure::LoadCaseResult& result, const std::string& name) {
  const auto group =
      std::find_if(result.groups.begin(), result.groups.end(),
                   [&](const structure::GroupStress& one) { return one.group == name; });
  return group == result.groups.end() ? 0 : group->yield_stress;
}

struct TwistedAtInstant {
  structure::TwistedBars bars;
  const BlockState* state = nullptr;
};

}  // namespace

std::vector<std::string> list_torsion_doubts(const BlockRun& block) {
  constexpr double least_of_yield = 0.1;
  if (!block.model || !block.responses || block.model->space().beams().empty()) return {};
  std::vector<const BlockState*> states;
  for (const LoadComparison& comparison : block.assessment.simultaneous_by_rope)
    states.push_back(&comparison.dynamic_state);
  if (states.empty()) states.push_back(&block.assessment.simultaneous.dynamic_state);
  std::map<std::string, TwistedAtInstant> largest;  // by group
  for (const BlockState* state : states) {
    const Eigen::VectorXd motion = block.responses->displacement(state->load);
    for (const structure::TwistedBars& bars :
         structure::find_twisted_open_bars(block.model->space(), motion)) {
      if (bars.von_mises < least_of_yield * yield_of(state->result, bars.group)) continue;
      TwistedAtInstant& known = largest[bars.group];
      if (!known.state || bars.von_mises > known.bars.von_mises) known = {bars, state};
    }
  }
  std::vector<std::string> doubts;
  for (const auto& [group, twisted] : largest) {
    const structure::TwistedBars& bars = twisted.bars;
    doubts.push_back(fmt::format(
        "Torsion makes {:.0f} of {:.0f} MPa in the open section of {} at ({:.4g}, {:.4g}, {:.4g}) "
        "m of the block ({}); that such a section resists warping is not computed.",
        bars.torsion / 1e6, bars.von_mises / 1e6, group, bars.place.x(), bars.place.y(),
        bars.place.z(), twisted.state->load.name));
  }
  return doubts;
}

}  // namespace blocklift::pipeline

#include "pipeline/results/doubts/lug_doubts.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace blocklift::pipeline {

std::string doubt_about_lugs(const LiftCase& lift_case) {
  std::map<std::string, std::vector<std::string>> ropes_by_lug;
  for (const given::Rope& rope : lift_case.ropes) {
    for (const ResolvedPoint& point : rope.path) {
      if (point.lug.empty()) continue;
      std::vector<std::string>& ropes = ropes_by_lug[point.lug];
      if (ropes.empty() || ropes.back() != rope.name.value) ropes.push_back(rope.name.value);
    }
  }
  std::vector<std::string> bare =
      lift_case.load.model ? lift_case.load.model->lug_names() : names_of(lift_case.load.lugs);
  std::erase_if(bare, [&](const std::string& lug) { return ropes_by_lug.contains(lug); });
  const auto crowded = std::find_if(ropes_by_lug.begin(), ropes_by_lug.end(),
                                    [](const auto& entry) { return entry.second.size() > 1; });
  if (bare.empty() || crowded == ropes_by_lug.end()) return {};
  return fmt::format(
      "Ropes {} all hold lug {}, and none holds {}. Is that meant? A doubled sling or a grommet is "
      "one rope, with the stiffness and strength of all its parts.",
      list_of_names(crowded->second), crowded->first, list_of_names(bare));
}

}  // namespace blocklift::pipeline

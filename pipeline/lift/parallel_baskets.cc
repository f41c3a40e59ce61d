#include "pipeline/lift/parallel_baskets.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace blocklift::pipeline {

std::string doubt_about_baskets(const LiftCase& lift_case) {
  constexpr double parallel = 0.996;  // cosine of 5 degrees
  if (!lift_case.supports.empty() || lift_case.ground_contact || lift_case.load.vessel) return {};
  const auto is_at_load = [](const auto& line) {
    return line.from.body.value == "load" || line.to.body.value == "load";
  };
  if (std::any_of(lift_case.tuggers.begin(), lift_case.tuggers.end(), is_at_load)) return {};
  std::vector<std::string> baskets, edges;
  std::vector<Vector3> ways;
  for (const given::Rope& rope : lift_case.ropes) {
    const bool holds = !rope.edges.empty() ||
                       std::any_of(rope.path.begin(), rope.path.end(), [](const auto& point) {
                         return point.kind == ResolvedPoint::Kind::load;
                       });
    if (!holds) continue;
    if (!rope.is_basket()) return {};
    baskets.push_back(rope.name.value);
    for (const LoadEdge& edge : rope.edges) {
      ways.push_back((edge.to - edge.from).normalized());
      if (std::abs(ways.back().dot(ways.front())) < parallel) return {};
      if (std::find(edges.begin(), edges.end(), edge.name.value) == edges.end())
        edges.push_back(edge.name.value);
    }
  }
  if (baskets.empty()) return {};
  return fmt::format(
      "Nothing holds the load along its edges {}: they run the same way, and {} over them {} all "
      "that carries it. Edges are smooth along themselves: each basket slides to where its path is "
      "shortest, and the load through its baskets, so that it rests at best as on a point. Give a "
      "basket across, round other edges, or slings to lugs where protectors or lashings hold the "
      "baskets in the yard",
      list_of_names(edges), (baskets.size() == 1 ? "basket " : "baskets ") + list_of_names(baskets),
      baskets.size() == 1 ? "is" : "are");
}

}  // namespace blocklift::pipeline

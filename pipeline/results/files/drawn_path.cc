#include "pipeline/results/files/drawn_path.h"

namespace blocklift::pipeline {

namespace {

/// Adds where a rope comes to an edge and leaves it.
void add_touch(const dynamics::RopeEdge& edge, const dynamics::EdgeHistory& touch,
               std::vector<dynamics::BodyPoint>& path) {
  struct End {
    double angle = 0, place = 0;
  } first, last;
  Eigen::Index touches = 0;
  for (Eigen::Index i = 0; i < touch.wrap.size(); ++i) {
    if (!touch.touches(i)) continue;
    ++touches;
    first.angle += touch.first_angle[i];
    first.place += touch.first_place[i];
    last.angle += touch.last_angle[i];
    last.place += touch.last_place[i];
  }
  if (touches == 0 || 2 * touches < touch.wrap.size()) return;
  const auto count = static_cast<double>(touches);
  const dynamics::PlacedEdge placed = edge.in_body();
  const auto add = [&](const End& end) {
    path.push_back({edge.body, placed.point_W(end.angle / count, end.place / count)});
  };
  add(first);
  if (edge.radius > 0) add(last);
}

}  // namespace

std::vector<dynamics::BodyPoint> drawn_path(const dynamics::LiftSystem& system, std::size_t rope,
                                            const dynamics::History& history) {
  const dynamics::Rope& one = system.ropes()[rope];
  std::vector<dynamics::BodyPoint> path;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < one.points().size(); ++i) {
    path.push_back(one.points()[i]);
    for (; edge < one.edges().size() && one.edges()[edge].after == i; ++edge)
      add_touch(one.edges()[edge], history.ropes[rope].edges[edge], path);
  }
  return path;
}

}  // namespace blocklift::pipeline

#include "pipeline/files/structure/load_edge.h"

#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "pipeline/declaration/table.h"

namespace blocklift::pipeline {

namespace {

void check_edge(const LoadEdge& edge, Reading& reading, const Mark& mark) {
  constexpr double shortest = 1e-3;      // m
  constexpr double least_sine = 0.0175;  // of one degree
  const double length = edge.length();
  if (length < shortest) {
    reading.error(
        mark, fmt::format("{} has no length: from and to lie in one place", reading.owner()),
        {"give its two ends; a corner that a rope turns about is an edge across the rope"});
    return;
  }
  if (length >= shortest && edge.outside.cross(edge.to - edge.from).norm() < least_sine * length)
    reading.error(mark, fmt::format("the side outside of {} lies along the edge", reading.owner()),
                  {"outside points away from the material, across the edge: between the two faces "
                   "that meet there"});
}

}  // namespace

double LoadEdge::distance_from_axis(const Vector3& point) const {
  return (point - from).cross(to - from).norm() / length();
}

Format<LoadEdge> load_edge_format() {
  Table<LoadEdge> table("edge",
                        "A straight edge of the load, sharp or round, that ropes may touch: a "
                        "coaming, a bilge, the edge of a deck. A rope that names it stays on its "
                        "side outside and takes the shortest way round it; whether it touches "
                        "follows from the motion.");
  table
      .required("from", &LoadEdge::from, position_format(),
                "one end of the edge; of a round one, of its axis")
      .required("to", &LoadEdge::to, position_format(), "the other end")
      .required("outside", &LoadEdge::outside, direction_format(),
                "direction away from the material, across the edge; of two faces that meet, "
                "between their normals")
      .by_default("radius", &LoadEdge::radius, quantity(Dimension::length, Range::not_negative()),
                  "0 m", "of the round that the rope lies on, about the axis; 0 m: sharp")
      .by_default("friction", &LoadEdge::friction, number(Range::between(0, 1)), "0",
                  "coefficient of friction mu between the edge and a rope that slips over it "
                  "lengthwise. Tensions on the two sides differ by exp(mu x angle of wrap) before "
                  "the rope slips; 0: smooth")
      .by_default("contact_length", &LoadEdge::contact_length,
                  quantity(Dimension::length, Range::positive()), "0.3 m",
                  "of the edge over which the force of a touching rope is spread where the block's "
                  "stress is computed: by a hat, twice as high in its middle as on average")
      .rule(check_edge);
  return table.format();
}

}  // namespace blocklift::pipeline

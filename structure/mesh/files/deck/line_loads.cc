#include "structure/mesh/files/deck/line_loads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Geometry>

#include "structure/mesh/beams/beam_axes.h"

namespace blocklift::structure {

namespace {

Vector3 at_share(const std::array<Vector3, 2>& ends, double share) {
  return (1 - share) * ends[0] + share * ends[1];
}

}  // namespace

LoadAtPlace load_at(const BeamLoad& load, const std::array<Vector3, 2>& arm, double share_of_span) {
  const double share = load.span[0] + share_of_span * (load.span[1] - load.span[0]);
  LoadAtPlace at_place;
  at_place.force = at_share(load.force, share_of_span);
  at_place.moment =
      at_share(load.moment, share_of_span) + at_share(arm, share).cross(at_place.force);
  return at_place;
}

std::array<PointLoad, 2> loads_at_ends(const Mesh& mesh, const BeamLoad& load) {
  const Beam& beam = mesh.beams[load.beam];
  std::array<PointLoad, 2> at_ends;
  for (std::size_t end = 0; end < 2; ++end) at_ends[end].vertex = beam.vertices[end];
  const auto add = [&](double t, double weight) {
    const double share = load.span[0] + t * (load.span[1] - load.span[0]);
    const LoadAtPlace here = load_at(load, load.arm, t);
    for (std::size_t end = 0; end < 2; ++end) {
      const double value = weight * (end == 0 ? 1 - share : share);
      at_ends[end].force += value * here.force;
      at_ends[end].moment += value * here.moment;
    }
  };
  if (load.is_at_a_place()) {
    add(0, 1);
    return at_ends;
  }
  // Two points of Gauss: exact for what is linear in place thrice over.
  const double length = (load.span[1] - load.span[0]) * line_beside(mesh, beam, load.arm).norm();
  for (const double side : {-1, 1}) add((1 + side / std::sqrt(3.0)) / 2, length / 2);
  return at_ends;
}

bool is_even_between_vertices(const BeamLoad& load) {
  return load.span == std::array<double, 2>{0, 1} && load.force[0] == load.force[1] &&
         load.moment[0].isZero(0) && load.moment[1].isZero(0) && load.arm[0].isZero(0) &&
         load.arm[1].isZero(0);
}

std::vector<PointLoad> loads_at_vertices(const Deck& deck, const DeckLoadCase& load_case) {
  std::map<int, PointLoad> of_vertex;
  const auto add = [&](const PointLoad& load, double factor) {
    PointLoad& sum = of_vertex[load.vertex];
    sum.vertex = load.vertex;
    sum.force += factor * load.force;
    sum.moment += factor * load.moment;
  };
  for (const auto& [set, factor] : load_case.loads) {
    for (const PointLoad& load : deck.load_sets[set].point_loads) add(load, factor);
    for (const BeamLoad& load : deck.load_sets[set].beam_loads)
      if (!is_even_between_vertices(load))
        for (const PointLoad& at_end : loads_at_ends(deck.mesh, load)) add(at_end, factor);
  }
  std::vector<PointLoad> loads;
  for (const auto& [vertex, load] : of_vertex) loads.push_back(load);
  return loads;
}

bool acts_on_released_ends(const Mesh& mesh, const BeamLoad& load) {
  constexpr double rounding = 1e-9;
  const Beam& beam = mesh.beams[load.beam];
  if (beam.release == std::array<BeamRelease, 2>{}) return false;
  const Eigen::Matrix3d axes = beam_axes(mesh, beam);
  const double size = line_beside(mesh, beam, beam.offset).norm();
  const auto centre_at = [&](std::size_t end) -> Vector3 {
    return axes.bottomRows<2>().transpose() *
           section_at(mesh, beam, static_cast<double>(end)).twist_centre();
  };
  const std::size_t values = load.is_at_a_place() ? 1 : 2;
  for (std::size_t end = 0; end < 2; ++end) {
    // What acts at the other end does not reach this one.
    if (load.is_at_a_place() && load.span[0] == (end == 0 ? 1 : 0)) continue;
    for (std::size_t v = 0; v < values; ++v) {
      const Vector3& force = load.force[v];
      // A released bending turns the end about its centroid, a released twist about the shear
      // centre.
      const auto about = [&](const Vector3& place) -> Vector3 {
        return load.moment[v] + (load.arm[end] - beam.offset[end] - place).cross(force);
      };
      const Vector3 bending = about(Vector3::Zero()), twist = about(centre_at(end));
      const double least = rounding * std::max(size * force.norm(), load.moment[v].norm());
      for (int c = 0; c < 6; ++c) {
        if (!beam.release[end][c]) continue;
        const double along = c < 3    ? size * axes.row(c).dot(force)
                             : c == 3 ? axes.row(0).dot(twist)
                                      : axes.row(c - 3).dot(bending);
        if (std::abs(along) > least) return true;
      }
    }
  }
  return false;
}

}  // namespace blocklift::structure

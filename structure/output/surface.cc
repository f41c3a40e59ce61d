#include "structure/output/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "parallel/threads.h"
#include "structure/envelope/coordinate_motions.h"
#include "structure/envelope/envelope.h"
#include "structure/formulation/beam.h"
#include "structure/formulation/solid.h"
#include "structure/index.h"
#include "structure/mesh/beams/beam_axes.h"
#include "structure/mesh/solid_shape.h"
#include "structure/output/divided_cell.h"
#include "structure/stress/beam_stress.h"
#include "structure/stress/shell_stress.h"
#include "structure/stress_tensor.h"

namespace blocklift::structure {

namespace {

/// The edges of a beam's strip from its centroid: along the section axis in which it reaches
/// farthest.
std::array<Vector3, 2> strip_of(const Mesh& mesh, const Beam& beam) {
  Eigen::Vector2d lower = Eigen::Vector2d::Zero(), upper = lower;
  for (const Eigen::Vector2d& point : stress_points(section_at(mesh, beam, 0.5))) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const Vector3 along = beam_axes(mesh, beam).row(1 + axis).transpose();
  return {lower[axis] * along, upper[axis] * along};
}

/// Stresses for unit coordinates of a history, six rows a point. They must outlive the result.
PointResponses rows_of_points(const Eigen::MatrixXd& stress) {
  return PointResponses::of_coordinates([&stress](int first, int count) -> Eigen::MatrixXd {
    return stress.middleRows(6L * first, 6L * count);
  });
}

/// Samples of cells by the surface's points on which they lie: those of one point stand together,
/// so that most are passed over once one of them is known.
struct SharedPoints {
  SharedPoints(const std::vector<int>& point_of, int first, int count) : place_of(at(count)) {
    std::vector<int> order(at(count));
    std::iota(order.begin(), order.end(), 0);
    const auto point = [&](int sample) { return point_of[first + sample]; };
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::pair(point(a), a) < std::pair(point(b), b); });
    for (int place = 0; place < count; ++place) {
      const int sample = order[place];
      place_of[sample] = place;
      if (points.empty() || points.back() != point(sample)) {
        points.push_back(point(sample));
        begin.push_back(2 * place);
      }
    }
    begin.push_back(2 * count);
  }

  std::vector<int> place_of;  ///< of each sample
  std::vector<int> points;    ///< of the surface
  std::vector<int> begin;     ///< of each point its first side of a sample, and the end
};

}  // namespace

/// Makes the points and quadrangles of a division.
class Surface::Builder {
 public:
  Builder(Surface& surface, const Space& space) : surface_(surface), space_(space) {}

  void build(int division) {
    surface_.division_ = division;
    surface_.points_.clear();
    surface_.quads_.clear();
    surface_.quad_groups_.clear();
    surface_.cell_points_.clear();
    surface_.stations_.clear();
    surface_.solid_stations_.clear();
    known_.clear();
    for (int cell = 0; cell < static_cast<int>(space_.shells().size()); ++cell)
      add_shell(cell, division);
    for (int cell = 0; cell < static_cast<int>(space_.beams().size()); ++cell)
      add_beam(cell, std::min(division, space_.beams()[cell].degree));
    add_solids();
  }

 private:
  int point_at(int owner, const Vector3& place) {
    const auto rounded = [&](int axis) -> std::int64_t { return std::llround(place[axis] * 1e6); };
    const auto [entry, is_new] = known_.try_emplace({owner, rounded(0), rounded(1), rounded(2)},
                                                    static_cast<int>(surface_.points_.size()));
    if (is_new) surface_.points_.push_back(place);
    return entry->second;
  }

  void add_shell(int cell, int division) {
    const Shell& shell = space_.mesh().shells[space_.shells()[cell].shell];
    const std::size_t first = surface_.cell_points_.size();
    const Eigen::Matrix2Xd unit = divided_square(division);
    for (Eigen::Index q = 0; q < unit.cols(); ++q)
      surface_.cell_points_.push_back(point_at(shell.region, space_.place(cell, unit.col(q))));
    for (const std::array<int, 4>& corners : squares_of_division(division)) {
      std::array<int, 4>& quad = surface_.quads_.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) quad[i] = surface_.cell_points_[first + at(corners[i])];
      surface_.quad_groups_.push_back(space_.mesh().regions[shell.region].group);
    }
  }

  void add_beam(int cell, int division) {
    const int number = space_.beams()[cell].beam;
    const Beam& beam = space_.mesh().beams[number];
    const std::array<Vector3, 2> edges = strip_of(space_.mesh(), beam);
    for (int i = 0; i <= division; ++i) {
      const double xi = static_cast<double>(i) / division;
      const Vector3 centroid = beam_point(space_, cell, xi).place;
      // Each beam for itself: the stresses of those that meet at an end are not mixed.
      const std::array<int, 2> points{point_at(-1 - number, centroid + edges[0]),
                                      point_at(-1 - number, centroid + edges[1])};
      if (i > 0) {
        const std::array<int, 2>& before = surface_.stations_.back().points;
        surface_.quads_.push_back({before[0], points[0], points[1], before[1]});
        surface_.quad_groups_.push_back(space_.mesh().regions[beam.region].group);
      }
      surface_.stations_.push_back({cell, xi, points});
    }
  }

  // The faces that no other solid shares, by their corners.
  void add_solids() {
    const int first = static_cast<int>(space_.mesh().shells.size());  // no plate has such a number
    std::map<std::pair<int, int>, int> known;
    for (const SolidFace& face : outer_faces(space_.mesh())) {
      const Solid& solid = space_.mesh().solids[face.solid];
      std::array<int, 4> quad{};
      for (std::size_t i = 0; i < 4; ++i) {
        // Against the outward normal, as quadrangles of plates run round theirs.
        const int corner = face.corners[std::min(i, face.corners.size() - 1)];
        const auto [entry, is_new] = known.try_emplace({face.solid, corner}, 0);
        if (is_new) {
          entry->second =
              point_at(first + solid.region, space_.mesh().vertices[solid.vertices[corner]]);
          surface_.solid_stations_.push_back({face.solid, corner, entry->second});
        }
        quad[i] = entry->second;
      }
      surface_.quads_.push_back(quad);
      surface_.quad_groups_.push_back(space_.mesh().regions[solid.region].group);
    }
  }

  Surface& surface_;
  const Space& space_;
  std::map<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>, int>
      known_;  // by plate, place
};

Surface::Surface(const ElasticModel& model, int largest_point_count) {
  for (const Group& group : model.mesh().groups) group_names_.push_back(group.name);
  Builder builder(*this, model.space());
  for (int division = model.space().degree(); division >= 1; --division) {
    builder.build(division);
    if (static_cast<int>(points_.size()) <= largest_point_count) break;
  }
}

std::vector<std::vector<double>> Surface::envelopes(
    const UnitResponses& responses, const std::vector<LoadHistory>& histories) const {
  const Space& space = responses.model().space();
  std::vector<std::vector<double>> largest;
  for (const LoadHistory& history : histories) {
    const Eigen::MatrixXd motions = motions_in_coordinates(responses, history);
    std::vector<double>& of_points = largest.emplace_back(points_.size(), 0);
    take_envelope_of_shells(space, motions, history, of_points);
    take_envelope_of_beams(space, motions, history, of_points);
    take_envelope_of_solids(space, motions, history, of_points);
  }
  return largest;
}

void Surface::take_envelope_of_shells(const Space& space, const Eigen::MatrixXd& motions,
                                      const LoadHistory& history,
                                      std::vector<double>& largest) const {
  constexpr int chunk = 256;  // cells whose stresses are held at a time
  const Eigen::Matrix2Xd unit = divided_square(division_);
  const int per_cell = static_cast<int>(unit.cols());
  const int cells = static_cast<int>(space.shells().size());
  for (int begin = 0; begin < cells; begin += chunk) {
    const int count = std::min(chunk, cells - begin);
    const SharedPoints shared(cell_points_, begin * per_cell, count * per_cell);
    // Both surfaces of each sample.
    Eigen::MatrixXd stress(12L * per_cell * count, motions.cols());
    parallel::in_batches(count, 16, 0, [&](int first, int taken) {
      ShellStress recovery(space, unit);
      for (int i = first; i < first + taken; ++i) {
        const Eigen::MatrixXd rows = recovery.of_all(begin + i, motions);
        const Eigen::MatrixXd upper = stresses_at_side(rows, 1), lower = stresses_at_side(rows, -1);
        for (int q = 0; q < per_cell; ++q) {
          const int place = shared.place_of[i * per_cell + q];
          stress.middleRows<6>(12L * place) = upper.middleRows<6>(6L * q);
          stress.middleRows<6>(12L * place + 6) = lower.middleRows<6>(6L * q);
        }
      }
    });
    Eigen::VectorXd of_points(static_cast<Eigen::Index>(shared.points.size()));
    for (std::size_t p = 0; p < shared.points.size(); ++p) of_points[p] = largest[shared.points[p]];
    raise_von_mises(history, shared.begin, rows_of_points(stress), of_points);
    for (std::size_t p = 0; p < shared.points.size(); ++p) largest[shared.points[p]] = of_points[p];
  }
}

void Surface::take_envelope_of_beams(const Space& space, const Eigen::MatrixXd& motions,
                                     const LoadHistory& history,
                                     std::vector<double>& largest) const {
  const auto stations = static_cast<int>(stations_.size());
  Eigen::VectorXd of_stations = Eigen::VectorXd::Zero(stations);
  parallel::in_batches(stations, 64, 0, [&](int first, int count) {
    // The points of these sections, one below the other, and where those of each begin.
    Eigen::MatrixXd stress(0, motions.cols());
    std::vector<int> begin{0};
    for (int s = first; s < first + count; ++s) {
      const BeamStation& station = stations_[s];
      const Eigen::MatrixXd here = beam_stresses(space, station.cell, station.xi, motions);
      stress.conservativeResize(stress.rows() + here.rows(), Eigen::NoChange);
      stress.bottomRows(here.rows()) = here;
      begin.push_back(static_cast<int>(stress.rows() / 6));
    }
    Eigen::VectorXd of_sections = Eigen::VectorXd::Zero(count);
    raise_von_mises(history, begin, rows_of_points(stress), of_sections, 1);
    of_stations.segment(first, count) = of_sections;
  });
  for (int s = 0; s < stations; ++s)
    for (const int point : stations_[s].points)
      largest[point] = std::max(largest[point], of_stations[s]);
}

void Surface::take_envelope_of_solids(const Space& space, const Eigen::MatrixXd& motions,
                                      const LoadHistory& history,
                                      std::vector<double>& largest) const {
  const int count = static_cast<int>(solid_stations_.size());
  const auto stress_of = [&](int first, int taken) {
    Eigen::MatrixXd stress(6L * taken, motions.cols()), of_solid;
    for (int i = 0; i < taken; ++i) {
      const SolidStation& station = solid_stations_[first + i];
      if (i == 0 || station.solid != solid_stations_[first + i - 1].solid)
        of_solid = solid_corner_stresses(space, station.solid, motions);
      stress.middleRows<6>(6L * i) = of_solid.middleRows<6>(6L * station.corner);
    }
    return stress;
  };
  const PointExtremes extremes =
      find_von_mises_envelope(history, count, PointResponses::of_coordinates(stress_of));
  for (int i = 0; i < count; ++i) {
    double& of_point = largest[solid_stations_[i].point];
    of_point = std::max(of_point, extremes.value[i]);
  }
}

std::vector<SurfaceField> Surface::evaluate(const UnitResponses& responses,
                                            const std::vector<LoadCase>& load_cases) const {
  const Space& space = responses.model().space();
  Eigen::MatrixXd motions = responses.displacements_of(load_cases);
  std::vector<SurfaceField> fields(load_cases.size());
  for (std::size_t k = 0; k < load_cases.size(); ++k) {
    const auto motion = motions.col(static_cast<Eigen::Index>(k));
    motions.col(static_cast<Eigen::Index>(k)) = responses.without_rigid_motion(motion);
    fields[k].displacement.assign(points_.size(), Vector3::Zero());
    fields[k].von_mises.assign(points_.size(), 0);
  }
  std::vector<int> shares(points_.size(), 0);
  add_shells(space, motions, fields, shares);
  add_beams(space, motions, fields, shares);
  add_solids(space, motions, fields, shares);
  for (SurfaceField& field : fields)
    for (std::size_t p = 0; p < points_.size(); ++p) field.von_mises[p] /= shares[p];
  return fields;
}

void Surface::add_shells(const Space& space, const Eigen::MatrixXd& motions,
                         std::vector<SurfaceField>& fields, std::vector<int>& shares) const {
  constexpr int chunk = 2048;  // cells whose stresses are held at a time
  const Eigen::Matrix2Xd unit = divided_square(division_);
  Eigen::MatrixXd shapes(unit.cols(), space.nodes_per_shell());
  for (Eigen::Index q = 0; q < unit.cols(); ++q)
    shapes.row(q) = space.shell_values(unit.col(q)).transpose();
  const int cells = static_cast<int>(space.shells().size());
  for (int begin = 0; begin < cells; begin += chunk) {
    const int count = std::min(chunk, cells - begin);
    const Eigen::MatrixXd stress = stresses_of_cells(space, unit, begin, count, motions);
    for (int i = 0; i < count; ++i) {
      const Eigen::MatrixXd local = motions_of_cell(space, begin + i, motions);
      const int first_point = static_cast<int>(unit.cols()) * (begin + i);
      for (Eigen::Index q = 0; q < unit.cols(); ++q) ++shares[cell_points_[first_point + q]];
      for (std::size_t k = 0; k < fields.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        const Eigen::MatrixXd moved =
            shapes * local.col(column).reshaped(6, local.rows() / 6).topRows<3>().transpose();
        for (Eigen::Index q = 0; q < unit.cols(); ++q) {
          const std::size_t point = at(cell_points_[first_point + q]);
          fields[k].displacement[point] = moved.row(q).transpose();
          fields[k].von_mises[point] +=
              plate_von_mises(stress.col(column).segment<shell_stress_rows>(shell_stress_rows *
                                                                            (unit.cols() * i + q)))
                  .largest();
        }
      }
    }
  }
}

void Surface::add_solids(const Space& space, const Eigen::MatrixXd& motions,
                         std::vector<SurfaceField>& fields, std::vector<int>& shares) const {
  Eigen::MatrixXd stress;
  int known = -1;
  for (const SolidStation& station : solid_stations_) {
    if (station.solid != known) stress = solid_corner_stresses(space, station.solid, motions);
    known = station.solid;
    const std::size_t point = at(station.point);
    const Eigen::Index node = space.solid_nodes(station.solid)[station.corner];
    ++shares[point];
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      fields[k].displacement[point] = motions.col(column).segment<3>(6 * node);
      fields[k].von_mises[point] +=
          von_mises(Stress(stress.col(column).segment<6>(6L * station.corner)));
    }
  }
}

void Surface::add_beams(const Space& space, const Eigen::MatrixXd& motions,
                        std::vector<SurfaceField>& fields, std::vector<int>& shares) const {
  for (const BeamStation& station : stations_) {
    const Vector3 centroid = beam_point(space, station.cell, station.xi).place;
    for (const int point : station.points) ++shares[point];
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const auto motion = motions.col(k);
      const BeamMotion moved = beam_motion_at(space, station.cell, station.xi, motion);
      const double stress =
          largest_von_mises(beam_stresses(space, station.cell, station.xi, motion));
      for (const int point : station.points) {
        fields[k].displacement[point] =
            moved.displacement + moved.rotation.cross(points_[point] - centroid);
        fields[k].von_mises[point] += stress;
      }
    }
  }
}

}  // namespace blocklift::structure

#include "structure/envelope/block_envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "algebra/products.h"
#include "parallel/threads.h"
#include "structure/envelope/coordinate_motions.h"
#include "structure/mesh/lugs/solid_lugs.h"

namespace blocklift::structure {

namespace {

// The place and instant of an extreme; everything else about it is looked up once it is known.
struct Running {
  double value = -std::numeric_limits<double>::infinity();
  int point = -1;

  void take(double candidate, int of_point) {
    if (candidate > value) *this = {candidate, of_point};
  }
};

// Largest membrane stresses of some squares: of all, and of each site's.
struct MaximaBySite {
  Running all;
  BySite<Running> at_site;

  void take(double value, int square, SquareSite site) {
    all.take(value, square);
    at_site[site].take(value, square);
  }
};

// The same of the whole block, of each group and of each lug's neighbourhood.
struct SquareMaxima {
  MaximaBySite block;
  std::vector<MaximaBySite> groups, lugs;
};

SquareMaxima square_maxima(const Mesh& mesh, const StressRecovery& recovery,
                           const PointExtremes& von_mises) {
  SquareMaxima maxima{{},
                      std::vector<MaximaBySite>(mesh.groups.size()),
                      std::vector<MaximaBySite>(mesh.lifting_points.size())};
  const std::vector<Square>& squares = recovery.checked().squares();
  for (std::size_t s = 0; s < squares.size(); ++s) {
    const double value = von_mises.value[s];
    const int point = static_cast<int>(s);
    const SquareSite site = squares[s].site;
    maxima.block.take(value, point, site);
    maxima.groups[mesh.regions[squares[s].region].group].take(value, point, site);
    for (std::size_t lug = 0; lug < mesh.lifting_points.size(); ++lug)
      if (value > maxima.lugs[lug].at_site[site].value &&
          (squares[s].centre_B - mesh.lifting_points[lug].p_BPin).norm() <=
              recovery.lug_radius(mesh.lifting_points[lug]))
        maxima.lugs[lug].take(value, point, site);
  }
  return maxima;
}

TimedExtreme of_square(const Mesh& mesh, const CheckedStress& checked,
                       const PointExtremes& von_mises, const Running& found) {
  TimedExtreme extreme;
  if (found.point < 0) return extreme;  // no square lies in it
  const Square& square = checked.squares()[found.point];
  extreme.value = found.value;
  extreme.point_B = square.centre_B;
  extreme.part = mesh.regions[square.region].name;
  extreme.instant = von_mises.instant[found.point];
  extreme.unit_stress = unit_stress_of_square(checked, found.point);
  return extreme;
}

// Extreme of the nodal stress at one of the stress points.
TimedExtreme of_point(const UnitResponses& responses, const StressPoints& points,
                      const LargestValue& largest) {
  TimedExtreme result;
  if (largest.point < 0) return result;
  const Mesh& mesh = responses.model().mesh();
  result.value = largest.value;
  result.instant = largest.instant;
  result.point_B = points.place(largest.point);
  result.part = mesh.regions[points.region(largest.point)].name;
  result.unit_stress = points.stresses(largest.point, 1, responses.displacements());
  return result;
}

/// @param motions of the history's coordinates; they lose their rigid motion.
TimedExtreme largest_displacement(const UnitResponses& responses, const LoadHistory& history,
                                  Eigen::MatrixXd& motions, int threads) {
  const ElasticModel& model = responses.model();
  parallel::in_batches(static_cast<int>(motions.cols()), 1, threads, [&](int k, int) {
    motions.col(k) = responses.without_rigid_motion(motions.col(k));
  });
  const LargestValue moved = find_largest_displacement(
      history, model.space().node_count(),
      PointResponses::of_coordinates([&](int first, int count) {
        Eigen::MatrixXd displacements(3L * count, motions.cols());
        for (int i = 0; i < count; ++i)
          displacements.middleRows<3>(3L * i) = motions.middleRows<3>(6L * (first + i));
        return displacements;
      }),
      threads);
  TimedExtreme extreme;
  extreme.value = moved.value;
  extreme.point_B = model.space().nodes().col(moved.point);
  extreme.instant = moved.instant;
  return extreme;
}

}  // namespace

Eigen::VectorXd response_weights(const CheckedStress& checked) {
  const double rows = std::max<double>(1, static_cast<double>(checked.components().rows()));
  return checked.components().colwise().norm().transpose() / std::sqrt(rows);
}

Eigen::VectorXd response_weights(const UnitResponses& responses, const StressRecovery& recovery) {
  if (!recovery.checked().squares().empty()) return response_weights(recovery.checked());
  const StressPoints& points = recovery.points();
  constexpr int batch = 2048;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(responses.count());
  for (int first = 0; first < points.count(); first += batch)
    squares +=
        points.stresses(first, std::min(batch, points.count() - first), responses.displacements())
            .colwise()
            .squaredNorm()
            .transpose();
  return (squares / std::max(1, points.count())).cwiseSqrt();
}

Eigen::MatrixXd unit_stress_of_square(const CheckedStress& checked, int square) {
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6, checked.components().cols());
  stress.topRows<2>() = checked.components().middleRows<2>(3 * square);
  stress.row(3) = checked.components().row(3 * square + 2);
  return stress;
}

PointResponses stress_of_squares(const CheckedStress& checked, const LoadHistory& history) {
  const auto of_coordinates =
      std::make_shared<Eigen::MatrixXd>(checked.components().rows(), history.rank());
  algebra::multiply(checked.components(), history.modes(), *of_coordinates);
  return PointResponses::of_coordinates([of_coordinates](int first, int count) {
    Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(6L * count, of_coordinates->cols());
    for (int i = 0; i < count; ++i) {
      const auto components = of_coordinates->middleRows<3>(3L * (first + i));
      stress.middleRows<2>(6L * i) = components.topRows<2>();
      stress.row(6L * i + 3) = components.row(2);
    }
    return stress;
  });
}

Eigen::VectorXd stress_shares(const Eigen::MatrixXd& unit_stress, const Eigen::MatrixXd& parts,
                              const Eigen::VectorXd& whole) {
  // Shear stands twice in a product of tensors.
  const auto deviator = [](Eigen::MatrixXd stress) {
    stress.topRows<3>().rowwise() -= stress.topRows<3>().colwise().mean().eval();
    stress.bottomRows<3>() *= std::sqrt(2.0);
    return stress;
  };
  const Eigen::VectorXd s = deviator(unit_stress * whole);
  const double square = s.squaredNorm();
  if (!(square > 0)) return Eigen::VectorXd::Zero(parts.cols());
  return deviator(unit_stress * parts).transpose() * s / square;
}

BlockEnvelope find_block_envelope(const UnitResponses& responses, const StressRecovery& recovery,
                                  const Eigen::MatrixXd& factors, int threads) {
  const Mesh& mesh = responses.model().mesh();
  const CheckedStress& checked = recovery.checked();
  const StressPoints& points = recovery.points();
  const LoadHistory history(factors, response_weights(responses, recovery));
  const int squares = static_cast<int>(checked.squares().size());

  BlockEnvelope envelope;
  envelope.instants = history.instants();
  envelope.squares =
      find_von_mises_envelope(history, squares, stress_of_squares(checked, history), threads);
  const SquareMaxima maxima = square_maxima(mesh, recovery, envelope.squares);
  const auto named = [&](const Running& found) {
    return of_square(mesh, checked, envelope.squares, found);
  };
  const auto named_by_site = [&](const MaximaBySite& found) {
    BySite<TimedExtreme> result;
    for (const SquareSite site : square_sites) result[site] = named(found.at_site[site]);
    return result;
  };
  envelope.checked_von_mises = named(maxima.block.all);
  envelope.field_von_mises = named(maxima.block.at_site[SquareSite::field]);
  for (std::size_t lug = 0; lug < mesh.lifting_points.size(); ++lug)
    envelope.lugs.push_back({mesh.lifting_points[lug].name, named(maxima.lugs[lug].all),
                             named_by_site(maxima.lugs[lug])});

  const int groups = static_cast<int>(mesh.groups.size());
  Eigen::MatrixXd motions = motions_in_coordinates(responses, history);
  const LargestStresses peaks = find_largest_stresses(
      history, points.count(), PointResponses::of_coordinates([&](int first, int count) {
        return points.stresses(first, count, motions);
      }),
      groups, [&](int point) { return mesh.regions[points.region(point)].group; }, threads);
  envelope.places = squares + points.count();
  LargestValue peak;
  for (const LargestValue& of_group : peaks.von_mises)
    if (of_group.point >= 0 && (peak.point < 0 || of_group.value > peak.value)) peak = of_group;
  const auto at_point = [&](const LargestValue& largest) {
    return of_point(responses, points, largest);
  };
  envelope.peak_von_mises = at_point(peak);
  if (squares == 0) envelope.checked_von_mises = envelope.field_von_mises = envelope.peak_von_mises;
  envelope.largest_principal = at_point(peaks.largest_principal);
  envelope.smallest_principal = at_point(peaks.smallest_principal);
  const std::vector<char> is_solid_lug = groups_of_solid_lugs(mesh);
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    const Material& material = mesh.materials[mesh.groups[g].material];
    const TimedExtreme peak_of_group = at_point(peaks.von_mises[g]);
    GroupEnvelope group;
    group.group = mesh.groups[g].name;
    group.material = material.name;
    group.yield_stress = material.yield_stress;
    group.peak_von_mises = peak_of_group;
    if (maxima.groups[g].all.point >= 0) {
      group.checked_von_mises = named(maxima.groups[g].all);
      group.at_site = named_by_site(maxima.groups[g]);
    } else if (is_solid_lug[g] == 0) {
      group.checked_von_mises = group.at_site[SquareSite::field] = peak_of_group;
    }
    envelope.groups.push_back(std::move(group));
  }
  envelope.displacement = largest_displacement(responses, history, motions, threads);
  return envelope;
}

}  // namespace blocklift::structure

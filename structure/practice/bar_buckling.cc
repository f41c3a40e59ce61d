#include "structure/practice/bar_buckling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Dense>

#include "algebra/decompositions.h"
#include "parallel/threads.h"
#include "structure/index.h"
#include "structure/practice/bar_chains.h"
#include "structure/practice/stiffener_chains.h"
#include "structure/practice/tripping.h"
#include "structure/stress/beam_stress.h"

namespace blocklift::structure {

namespace {

const double parallel_cosine = std::cos(5 * std::numbers::pi / 180);
constexpr double straight = 5 * std::numbers::pi / 180;
constexpr std::array<double, 3> places_in_cell{0, 0.5, 1};
/// Of a station: N, M_y, M_z, stresses of a stiffener's centroid and of its farthest fibre.
constexpr Eigen::Index rows_of_station = 5;

/// Axis 2 of a bar: its vector may lean along the bar and be of any length.
Vector3 across(const Mesh& mesh, const Beam& beam) {
  const Vector3 e_1 = reach_of(mesh, beam).normalized();
  return (beam.axis_2 - e_1 * e_1.dot(beam.axis_2)).normalized();
}

/// What tapers is one column with what goes on from it, of the weakest section along it.
bool are_one_bar(const Mesh& mesh, const Beam& a, const Beam& b) {
  const bool tapers = a.end_section >= 0 || b.end_section >= 0;
  return (a.section == b.section || tapers) &&
         std::abs(across(mesh, a).dot(across(mesh, b))) > parallel_cosine;
}

bool is_held(const MeetingPoints& points, int vertex) {
  return !points.cells(vertex).empty() || points.is_fastened(vertex);
}

bool is_free(const MeetingPoints& points, int vertex) {
  return points.beams(vertex).size() == 1 && !is_held(points, vertex);
}

/// The straight pieces of bars that run along no plate and no solid, between what holds them.
std::vector<BarChain> find_free_chains(const Mesh& mesh, const MeetingPoints& points) {
  std::vector<int> beams;
  for (std::size_t b = 0; b < mesh.beams.size(); ++b) {
    const auto& [from, to] = mesh.beams[b].vertices;
    if (points.common_cells(from, to).empty()) beams.push_back(static_cast<int>(b));
  }
  return find_bar_chains(mesh, points, beams, straight, [&](int beam, int next, int vertex) {
    return points.beams(vertex).size() == 2 && !is_held(points, vertex) &&
           are_one_bar(mesh, mesh.beams[beam], mesh.beams[next]);
  });
}

/// (M_2, M_3) = E law (k_2, k_3), m^4.
Eigen::Matrix2d bending_law(const BeamSection& section) {
  Eigen::Matrix2d law;
  law << section.second_moment_2, -section.product_23, -section.product_23, section.second_moment_3;
  return law;
}

/// Axes of bending of a section: columns (e_2, e_3) along which a curvature is about a principal
/// axis.
Eigen::Matrix2d principal_axes(const BeamSection& section) {
  return algebra::symmetric_eigensystem<2>(bending_law(section)).vectors;
}

/// Takes what is smaller of a section into a column's figures.
void weaken(const BeamSection& section, const Eigen::Matrix2d& axes, Column& column) {
  const Eigen::Matrix2d law = bending_law(section);
  const auto smaller = [](double& value, double other) { value = std::min(value, other); };
  smaller(column.area, section.area);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d axis = axes.col(i);
    const double moment = axis.dot(law * axis);
    double outermost = 0;
    for (const Eigen::Vector2d& point : stress_points(section))
      outermost = std::max(outermost, std::abs(point.y() * axis.x() - point.x() * axis.y()));
    smaller(column.second_moments[i], moment);
    smaller(column.section_moduli[i], moment / outermost);
  }
}

/// The weakest section along a chain.
Column column_of(const Mesh& mesh, const BarChain& chain, const Eigen::Matrix2d& axes) {
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  Column column;
  column.elastic_modulus = column.yield_stress = column.area = no_limit;
  column.second_moments = column.section_moduli = {no_limit, no_limit};
  for (const auto& [number, reversed] : chain.beams) {
    const Beam& beam = mesh.beams[number];
    const Material& material = mesh.materials[mesh.section_of(beam).material];
    column.elastic_modulus = std::min(column.elastic_modulus, material.youngs_modulus);
    column.yield_stress = std::min(column.yield_stress, material.yield_stress);
    weaken(mesh.section_of(beam), axes, column);
    if (beam.end_section >= 0) weaken(mesh.beam_sections[beam.end_section], axes, column);
  }
  return column;
}

/// The smaller figures of two columns.
Column weaker_of(const Column& a, const Column& b) {
  Column weaker = a;
  weaker.area = std::min(a.area, b.area);
  weaker.effective_area = std::min(a.effective_area, b.effective_area);
  weaker.yield_stress = std::min(a.yield_stress, b.yield_stress);
  weaker.imperfection = std::max(a.imperfection, b.imperfection);
  for (std::size_t i = 0; i < 2; ++i) {
    weaker.second_moments[i] = std::min(a.second_moments[i], b.second_moments[i]);
    weaker.section_moduli[i] = std::min(a.section_moduli[i], b.section_moduli[i]);
  }
  return weaker;
}

/// A place on a bar, and its rows for each motion.
struct BarStation {
  double share = 0;
  Eigen::MatrixXd rows;
};

/// What happens in the bars of a block under its motions.
class BarForces {
 public:
  BarForces(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions,
            const BlockPanels& panels)
      : mesh_(model.mesh()),
        space_(model.space()),
        motions_(motions),
        panels_(panels),
        cells_of_beam_(mesh_.beams.size()) {
    for (std::size_t c = 0; c < space_.beams().size(); ++c)
      cells_of_beam_[space_.beams()[c].beam].push_back(static_cast<int>(c));
  }

  /// Stations along a chain; `forces_at` gives the rows of a beam's cell at its place xi.
  template <class ForcesAt>
  std::vector<BarStation> along(const BarChain& chain, const ForcesAt& forces_at) const {
    std::vector<BarStation> stations;
    double passed = 0;
    for (const auto& [beam, reversed] : chain.beams) {
      const double length = reach_of(mesh_, mesh_.beams[beam]).norm();
      for (const int cell : cells_of_beam_[beam])
        for (const double xi : places_in_cell) {
          const double share = share_at(cell, xi);
          stations.push_back({(passed + (reversed ? 1 - share : share) * length) / chain.length,
                              forces_at(cell, xi)});
        }
      passed += length;
    }
    return stations;
  }

  /// Of a bar alone, moments about the given axes of its section.
  Eigen::MatrixXd of_bar(int cell, double xi, const Eigen::Matrix2d& axes) const {
    const Eigen::MatrixXd forces = beam_forces(space_, cell, xi, motions_);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(rows_of_station, motions_.cols());
    rows.topRows<3>() << forces.row(0), axes.transpose() * forces.bottomRows<2>();
    return rows;
  }

  /// Of a bar with its plates: their force with the bar's own, the moment of the curvature along
  /// the plate's normal in the section of both, and the bar's stresses.
  Eigen::MatrixXd of_stiffener(int cell, double xi, const PlateAlong& plate) const {
    const Beam& beam = mesh_.beams[space_.beams()[cell].beam];
    const double share = share_at(cell, xi);
    const Vector3 e_1 = reach_of(mesh_, beam).normalized();
    const Vector3 e_2 = across(mesh_, beam);
    const BeamSection section = section_at(mesh_, beam, share);
    const Eigen::MatrixXd forces = beam_forces(space_, cell, xi, motions_);
    const Eigen::MatrixXd scaled_curvatures =  // times the modulus of elasticity
        bending_law(section).inverse() * forces.bottomRows<2>();
    const std::array<PlateStrip, 2> strips = strips_beside(beam, plate);
    const StiffenerSection alone = stiffener_section(mesh_, beam, plate.normal, share);
    const StiffenedSection both = join_sections(alone, strips);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(rows_of_station, motions_.cols());
    rows.row(0) = forces.row(0);
    for (std::size_t side = 0; side < 2; ++side)
      rows.row(0) +=
          strips[side].width * strips[side].thickness *
          panels_.stress_beside(panel_of(plate, side), e_1, mesh_.vertices[beam.vertices[0]]);
    // By which the stress grows along the normal.
    const Eigen::RowVectorXd growth = plate.normal.dot(e_1.cross(e_2)) * scaled_curvatures.row(0) -
                                      plate.normal.dot(e_2) * scaled_curvatures.row(1);
    rows.row(1) = both.second_moment * growth;
    const double farthest = alone.height >= height_of(strips) ? alone.highest : alone.lowest;
    rows.row(3) = forces.row(0) / section.area;
    rows.row(4) = rows.row(3) + (farthest - alone.height) * growth;
    return rows;
  }

  /// Of the plate on both sides of a stiffener, from the line of the vertices, m.
  static double height_of(const std::array<PlateStrip, 2>& strips) {
    return (strips[0].height + strips[1].height) / 2;
  }

  std::array<PlateStrip, 2> strips_beside(const Beam& beam, const PlateAlong& plate) const {
    const Vector3 e_1 = reach_of(mesh_, beam).normalized();
    std::array<PlateStrip, 2> strips;
    for (std::size_t side = 0; side < 2; ++side) {
      const Shell& shell = mesh_.shells[plate.shells[side]];
      strips[side] = {panels_.field_width(panel_of(plate, side), e_1) / 2,
                      mesh_.section_of(shell).thickness, plate_height(mesh_, shell, plate.normal)};
    }
    return strips;
  }

  bool has_panels(const PlateAlong& plate) const {
    return panel_of(plate, 0) >= 0 && panel_of(plate, 1) >= 0;
  }

 private:
  int panel_of(const PlateAlong& plate, std::size_t side) const {
    return panels_.panel_of(plate.shells[side]);
  }
  /// Place of a point of a cell on its beam.
  double share_at(int cell, double xi) const {
    const BeamCell& located = space_.beams()[cell];
    return located.origin + located.size * xi;
  }

  const Mesh& mesh_;
  const Space& space_;
  Eigen::Ref<const Eigen::MatrixXd> motions_;
  const BlockPanels& panels_;
  std::vector<std::vector<int>> cells_of_beam_;
};

/// A span without its column.
BarSpan span_of(const Mesh& mesh, const BarChain& chain) {
  const Region& region = mesh.regions[mesh.beams[chain.beams.front().first].region];
  BarSpan span;
  span.bar = region.name;
  span.group = mesh.groups[region.group].name;
  span.p_BFrom = mesh.vertices[chain.from];
  span.p_BTo = mesh.vertices[chain.to];
  return span;
}

/// The weakest section of a stiffener along a chain, as the columns of its beams' ends.
Column stiffener_column_of(const Mesh& mesh, const BarChain& chain,
                           const StiffenerChains& stiffeners, const BarForces& bars) {
  std::optional<Column> weakest;
  for (const auto& [number, reversed] : chain.beams) {
    const Beam& beam = mesh.beams[number];
    const PlateAlong& plate = stiffeners.plates[number];
    Material material = mesh.materials[mesh.section_of(beam).material];
    for (const int shell : plate.shells)
      material.yield_stress =
          std::min(material.yield_stress,
                   mesh.materials[mesh.section_of(mesh.shells[shell]).material].yield_stress);
    for (const double share : {0.0, 1.0}) {
      const Column column =
          stiffener_column(material, stiffener_section(mesh, beam, plate.normal, share),
                           bars.strips_beside(beam, plate), chain.length);
      weakest = weakest ? weaker_of(*weakest, column) : column;
    }
  }
  return *weakest;
}

/// Sets the stress at which a stiffener trips: of the weakest section along its chain.
void set_tripping(const Mesh& mesh, const BarChain& chain, const StiffenerChains& stiffeners,
                  const BarForces& bars, BarSpan& span) {
  const double brackets =
      mesh.group_of_region(mesh.beams[chain.beams.front().first].region).tripping_brackets;
  const double length = brackets > 0 ? std::min(brackets, chain.length) : chain.length;
  double elastic = std::numeric_limits<double>::infinity(), strength = elastic;
  for (const auto& [number, reversed] : chain.beams) {
    const Beam& beam = mesh.beams[number];
    const PlateAlong& plate = stiffeners.plates[number];
    const Material& material = mesh.materials[mesh.section_of(beam).material];
    const double plate_at = BarForces::height_of(bars.strips_beside(beam, plate));
    for (const double share : {0.0, 1.0}) {
      const TrippingSection section = tripping_section(mesh, beam, plate.normal, plate_at, share);
      if (!(section.torsion > 0)) return;
      const double here = tripping_stress(material, section, length);
      elastic = std::min(elastic, here);
      strength = std::min(strength, tripping_strength(here, material.yield_stress));
    }
  }
  span.tripping_length = length;
  span.tripping_stress = elastic;
  span.tripping_strength = strength;
}

bool resists_bending(const Mesh& mesh, const BarChain& chain) {
  return std::all_of(chain.beams.begin(), chain.beams.end(), [&](const auto& beam) {
    return bending_law(mesh.section_of(mesh.beams[beam.first])).determinant() > 0;
  });
}

}  // namespace

BlockBars::BlockBars(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions,
                     const BlockPanels& panels) {
  const Mesh& mesh = model.mesh();
  const MeetingPoints points(mesh);
  const BarForces bars(model, motions, panels);
  std::vector<std::vector<BarStation>> found;
  for (const BarChain& chain : find_free_chains(mesh, points)) {
    if (!resists_bending(mesh, chain)) {
      ++unknown_rods_;
      continue;
    }
    const Beam& first = mesh.beams[chain.beams.front().first];
    const Eigen::Matrix2d axes = principal_axes(mesh.section_of(first));
    BarSpan& span = spans_.emplace_back(span_of(mesh, chain));
    span.column = column_of(mesh, chain, axes);
    const bool has_free_end = is_free(points, chain.from) || is_free(points, chain.to);
    span.column.length = (has_free_end ? 2 : 1) * chain.length;
    found.push_back(
        bars.along(chain, [&](int cell, double xi) { return bars.of_bar(cell, xi, axes); }));
  }
  const StiffenerChains stiffeners = find_stiffeners(mesh, points);
  for (const BarChain& chain : stiffeners.chains) {
    const auto plate_of = [&](int beam) -> const PlateAlong& { return stiffeners.plates[beam]; };
    if (!resists_bending(mesh, chain) ||
        !std::all_of(chain.beams.begin(), chain.beams.end(),
                     [&](const auto& beam) { return bars.has_panels(plate_of(beam.first)); }))
      continue;
    BarSpan& span = spans_.emplace_back(span_of(mesh, chain));
    span.column = stiffener_column_of(mesh, chain, stiffeners, bars);
    set_tripping(mesh, chain, stiffeners, bars, span);
    const int first = chain.beams.front().first;
    for (const PlateStrip& strip : bars.strips_beside(mesh.beams[first], plate_of(first)))
      span.plate_width += strip.width;
    found.push_back(bars.along(chain, [&](int cell, double xi) {
      return bars.of_stiffener(cell, xi, plate_of(model.space().beams()[cell].beam));
    }));
  }
  Eigen::Index rows = 0;
  for (const std::vector<BarStation>& stations : found)
    rows += rows_of_station * static_cast<Eigen::Index>(stations.size());
  forces_.resize(rows, motions.cols());
  for (const std::vector<BarStation>& stations : found) {
    Stations& kept = stations_.emplace_back();
    kept.first_row = forces_.rows() - rows;
    for (const BarStation& station : stations) {
      kept.shares.push_back(station.share);
      forces_.middleRows<rows_of_station>(forces_.rows() - rows) = station.rows;
      rows -= rows_of_station;
    }
  }
}

template <class See>
void BlockBars::look_at(std::size_t span, const Eigen::MatrixXd& factors, const See& see) const {
  constexpr Eigen::Index instants_at_once = 512;
  const Stations& of = stations_[span];
  const Eigen::MatrixXd rows = forces_.middleRows(
      of.first_row, rows_of_station * static_cast<Eigen::Index>(of.shares.size()));
  for (Eigen::Index start = 0; start < factors.cols(); start += instants_at_once) {
    const Eigen::Index instants = std::min(instants_at_once, factors.cols() - start);
    const Eigen::MatrixXd all = rows * factors.middleCols(start, instants);
    for (Eigen::Index t = 0; t < instants; ++t)
      for (std::size_t place = 0; place < of.shares.size(); ++place) {
        const Eigen::Index first = rows_of_station * static_cast<Eigen::Index>(place);
        see(place, static_cast<int>(start + t), all.block<rows_of_station, 1>(first, t));
      }
  }
}

std::vector<BlockBars::WorstOfSpan> BlockBars::find_worst(const Eigen::MatrixXd& factors,
                                                          double factor, int threads) const {
  std::vector<WorstOfSpan> result(spans_.size());
  parallel::in_batches(static_cast<int>(spans_.size()), 1, threads, [&](int first, int count) {
    for (std::size_t s = at(first); s < at(first + count); ++s) {
      const BarSpan& span = spans_[s];
      const bool trips = span.tripping_strength > 0;
      const double critical = trips ? euler_load(span.column, 0) : 0;
      Worst& column = result[s].column;
      WorstTripping& tripping = result[s].tripping;
      look_at(s, factors, [&](std::size_t place, int instant, const auto& here) {
        const ColumnForces bears{-here[0], {here[1], here[2]}};
        const double utilisation = column_utilisation(span.column, bears, factor);
        if (utilisation > column.utilisation)
          column = {utilisation, bears, stations_[s].shares[place], instant};
        if (!trips) return;
        const double left = 1 - std::max(0.0, -factor * here[0]) / critical;
        const double grown =
            left > 0 ? -here[3] + (here[3] - here[4]) / left
                     : std::numeric_limits<double>::infinity();  // it has buckled as a column
        const double compression = factor * std::max(-here[3], grown);
        if (compression / span.tripping_strength > tripping.utilisation)
          tripping = {compression / span.tripping_strength, compression, stations_[s].shares[place],
                      instant};
      });
    }
  });
  return result;
}

}  // namespace blocklift::structure

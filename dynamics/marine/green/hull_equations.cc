#include "dynamics/marine/green/hull_equations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <utility>

#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/algebra/gauss_legendre.h"
#include "dynamics/errors.h"
#include "dynamics/marine/panels/rankine_problem.h"
#include "parallel/threads.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double pi = std::numbers::pi;
constexpr int block_size = 64;  ///< of what a processor's cache holds of both halves at once

/// A point of a panel with its share of the area, m2.
struct PanelPoint {
  Vector3 position;
  double area;
};

/// A rule's points on a panel as the bilinear image of a square.
void divide(const Panel& panel, const QuadratureRule& rule, std::vector<PanelPoint>& points) {
  const std::size_t order = rule.points.size();
  const auto& v = panel.vertices;
  points.clear();
  for (std::size_t i = 0; i < order; ++i) {
    for (std::size_t j = 0; j < order; ++j) {
      const double a = rule.points[i], b = rule.points[j];
      const double weight = rule.weights[i] * rule.weights[j];
      const Vector3 along = 0.25 * ((1.0 - b) * (v[1] - v[0]) + (1.0 + b) * (v[2] - v[3]));
      const Vector3 across = 0.25 * ((1.0 - a) * (v[3] - v[0]) + (1.0 + a) * (v[2] - v[1]));
      points.push_back({0.25 * ((1.0 - a) * (1.0 - b) * v[0] + (1.0 + a) * (1.0 - b) * v[1] +
                                (1.0 + a) * (1.0 + b) * v[2] + (1.0 - a) * (1.0 + b) * v[3]),
                        weight * along.cross(across).norm()});
    }
  }
}

/// dR/dn at the source, from field point to source.
double level_share(const Vector3& field, const Vector3& source, const Vector3& normal, double R) {
  if (R < 1e-12) return 0.0;
  return ((source.x() - field.x()) * normal.x() + (source.y() - field.y()) * normal.y()) / R;
}

}  // namespace

double hull_matrices_bytes(int unknowns, int parts) {
  const double n = unknowns;
  // Four of each part, and a quarter of four more at the middles of clusters.
  return n * n * parts * 5.0 * sizeof(double);
}

double hull_equations_bytes(int unknowns, int parts) {
  const double n = unknowns;
  // Beside the real matrices two complex ones of each part, one more, and its factors in single
  // precision.
  constexpr double complex = sizeof(Complex);
  return hull_matrices_bytes(unknowns, parts) + n * n * (parts * 2.0 + 1.5) * complex;
}

HullEquations::HullEquations(const PanelModel& model, const Settings& settings)
    : model_(model),
      settings_(settings),
      hull_count_(model.body_mesh().size()),
      parities_(model.parities()),
      coarser_(make_coarser_panels(model.body_mesh())) {
  make_cells();
  const int count = hull_count_ + cells_.size();
  const double limit = settings.memory_limit > 0.0 ? settings.memory_limit : usable_memory();
  const double needed = hull_equations_bytes(count, static_cast<int>(parities_.size()));
  if (needed > limit) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  "%d panels on the bodies and %d cells of their water planes need %.2f GB of "
                  "memory, but %.2f GB may be used: take fewer panels",
                  hull_count_, cells_.size(), needed / 1e9, limit / 1e9);
    throw SimulationError(text.data());
  }
  Eigen::Vector2d low = panel(0).centroid.head<2>(), high = low;
  for (int j = 0; j < count; ++j) {
    points_.push_back(panel(j).centroid);
    diameters_.push_back(panel(j).diameter());
    for (const Vector3& vertex : panel(j).vertices) {
      deepest_ = std::max(deepest_, -vertex.z());
      for (int image = 0; image < model.symmetry().image_count(); ++image) {
        const Eigen::Vector2d p = model.symmetry().reflect(image, vertex).head<2>();
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
  }
  reach_ = (high - low).norm();
  deepest_ = std::min(deepest_, model.water().depth);
  integrate_images();
  integrate_at_middles();
}

void HullEquations::make_cells() {
  const std::vector<WaterLine> lines = find_water_lines(model_.bodies());
  const double mean = std::sqrt(model_.body_areas().mean());
  const double open = settings_.cell_size > 0.0 ? settings_.cell_size : mean;
  const double cover = settings_.cover_size > 0.0 ? settings_.cover_size : 2.0 * open;
  if (settings_.cover_water_planes) {
    cells_ = make_water_plane_cells(lines, {}, model_.symmetry(), cover);
  }
  if (settings_.lids.empty()) return;
  std::vector<WaterPlaneRegion> regions;
  for (const DampingLid& lid : settings_.lids) regions.push_back({lid.low, lid.high});
  const WaterPlaneCells all = make_water_plane_cells(lines, regions, model_.symmetry(), open);
  for (int k = 0; k < all.size(); ++k) {
    if (all.region[k] < 0) continue;
    cells_.panels.push_back(all.panels[k]);
    cells_.region.push_back(all.region[k]);
  }
}

// The points reflected in planes of symmetry, and then in nothing, surface and bottom.
std::vector<std::array<PointColumns, 3>> HullEquations::reflect(
    const std::vector<Vector3>& points) const {
  std::vector<std::array<PointColumns, 3>> places;
  for (int g = 0; g < model_.symmetry().image_count(); ++g) {
    std::array<PointColumns, 3> place;
    for (std::size_t k = 0; k < mirror_count(); ++k) {
      place[k] = PointColumns(points.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3 p = model_.symmetry().reflect(g, points[i]);
        place[k].x[i] = p.x();
        place[k].y[i] = p.y();
        place[k].z[i] = k == 0 ? p.z() : (k == 1 ? 0.0 : -2.0 * model_.water().depth) - p.z();
      }
    }
    places.push_back(std::move(place));
  }
  return places;
}

void HullEquations::integrate_images() {
  const int images = model_.symmetry().image_count(), count = size();
  const std::vector<std::array<PointColumns, 3>> places = reflect(points_);
  for (std::size_t p = 0; p < parities_.size(); ++p) {
    images_.push_back({MatrixXd::Zero(count, count), MatrixXd::Zero(count, hull_count_)});
    surface_images_.push_back(images_.back());
  }
  parallel::for_each(count, settings_.threads, [&](int j) {
    Eigen::VectorXd source(count), dipole(count);
    for (int g = 0; g < images; ++g) {
      for (std::size_t k = 0; k < mirror_count(); ++k) {
        source.setZero();
        dipole.setZero();
        const bool on_hull = j < hull_count_;
        add_panel_potentials(panel(j), places[g][k],
                             on_hull ? PanelIntegral::both : PanelIntegral::source, 1.0,
                             source.data(), on_hull ? dipole.data() : nullptr);
        // A panel's own dipole has the mean value zero.
        if (g == 0 && k == 0) dipole[j] = 0.0;
        for (std::size_t p = 0; p < parities_.size(); ++p) {
          const double sign = model_.sign(parities_[p], g);
          images_[p].source.col(j) += sign * source;
          if (k == 1) surface_images_[p].source.col(j) += sign * source;
          if (!on_hull) continue;
          images_[p].dipole.col(j) += sign * dipole;
          if (k == 1) surface_images_[p].dipole.col(j) += sign * dipole;
        }
      }
    }
  });
}

void HullEquations::integrate_at_middles() {
  const auto rows = static_cast<Eigen::Index>(coarser_.flat.middles.size());
  const std::vector<std::array<PointColumns, 3>> places = reflect(coarser_.flat.middles);
  const Eigen::VectorXd areas = model_.body_areas();
  for (const Influence<double>& images : images_) {
    const auto mean = [&](const MatrixXd& matrix) {
      const MatrixXd of_hull = matrix.topLeftCorner(hull_count_, hull_count_);
      return MatrixXd(-coarser_.bodies.average(areas, of_hull)(coarser_.flat.clusters, Eigen::all));
    };
    at_middles_.push_back({mean(images.source), mean(images.dipole)});
    const Influence<double>& mirrored = surface_images_[at_middles_.size() - 1];
    at_middles_without_waves_.push_back(
        {mean(images.source - 2.0 * mirrored.source), mean(images.dipole - 2.0 * mirrored.dipole)});
  }
  if (rows == 0) return;
  parallel::for_each(hull_count_, settings_.threads, [&](int j) {
    Eigen::VectorXd source(rows), dipole(rows);
    for (int g = 0; g < model_.symmetry().image_count(); ++g) {
      for (std::size_t k = 0; k < mirror_count(); ++k) {
        source.setZero();
        dipole.setZero();
        add_panel_potentials(panel(j), places[g][k], PanelIntegral::both, 1.0, source.data(),
                             dipole.data());
        if (g == 0 && k == 0 && coarser_.flat.of_panel[j] >= 0)
          dipole[coarser_.flat.of_panel[j]] = 0.0;
        for (std::size_t p = 0; p < parities_.size(); ++p) {
          const double sign = model_.sign(parities_[p], g);
          at_middles_[p].source.col(j) += sign * source;
          at_middles_[p].dipole.col(j) += sign * dipole;
          // The image in the surface has the other sign there.
          const double without_waves = k == 1 ? -sign : sign;
          at_middles_without_waves_[p].source.col(j) += without_waves * source;
          at_middles_without_waves_[p].dipole.col(j) += without_waves * dipole;
        }
      }
    }
  });
}

/// What a block of panels' waves at a block of centroids are computed with.
struct HullEquations::WaveBlock {
  const WaveGreenFunction& green;
  const std::vector<WaveGreenFunction::Level>& levels;  ///< of the centroids
  std::vector<Influence<Complex>>& waves;
  int image = 0;
  std::vector<double> signs = {};  ///< of the parts in this image
  std::vector<double> distances = std::vector<double>(block_size);
  std::vector<WaveGreenFunction::Value> values = std::vector<WaveGreenFunction::Value>(block_size);
  std::vector<PanelPoint> points = {};
};

// At near places from the image in z = 0 the panel is divided.
void HullEquations::add_wave(int i, int j, const Vector3& field, double R,
                             const WaveGreenFunction::Value& value, WaveBlock& block) const {
  constexpr double near = 4.0, very_near = 1.5;  // diameters
  static const QuadratureRule two = make_gauss_legendre(2), four = make_gauss_legendre(4);
  const Panel& source = panel(j);
  const Vector3& n = source.normal;
  const double s = field.z() + source.centroid.z();
  const double apart = std::sqrt(R * R + s * s) / diameters_[j];
  Complex potential, dipole;
  if (apart > near) {
    potential = source.area * value.g;
    dipole = source.area *
             (value.along_R * level_share(field, source.centroid, n, R) + value.along_zeta * n.z());
  } else {
    divide(source, apart > very_near ? two : four, block.points);
    for (const PanelPoint& point : block.points) {
      const double distance = (field - point.position).head<2>().norm();
      const WaveGreenFunction::Value of_point =
          block.green.at(distance, block.levels[i], block.green.level(point.position.z()));
      potential += point.area * of_point.g;
      dipole += point.area * (of_point.along_R * level_share(field, point.position, n, distance) +
                              of_point.along_zeta * n.z());
    }
  }
  for (std::size_t p = 0; p < block.signs.size(); ++p) {
    block.waves[p].source(i, j) += block.signs[p] * potential;
    if (j < hull_count_) block.waves[p].dipole(i, j) += block.signs[p] * dipole;
  }
}

// Field and source may change places: g is found once for both.
void HullEquations::add_wave_block(int row, int column, WaveBlock& block) const {
  const int rows_end = std::min(row + block_size, size());
  const int columns_end = std::min(column + block_size, size());
  for (block.image = 0; block.image < model_.symmetry().image_count(); ++block.image) {
    block.signs.clear();
    for (const Parity& parity : parities_) {
      block.signs.push_back(model_.sign(parity, block.image));
    }
    std::vector<Vector3> fields;
    for (int i = row; i < rows_end; ++i) {
      fields.push_back(model_.symmetry().reflect(block.image, points_[i]));
    }
    for (int j = column; j < columns_end; ++j) {
      const int count = std::min(rows_end, j + 1) - row;
      const Vector3 other = model_.symmetry().reflect(block.image, points_[j]);
      const std::span distances(block.distances.data(), static_cast<std::size_t>(count));
      const std::span values(block.values.data(), static_cast<std::size_t>(count));
      for (int k = 0; k < count; ++k) {
        distances[k] = (fields[k] - points_[j]).head<2>().norm();
      }
      block.green.at(distances, std::span(block.levels).subspan(row, count), block.levels[j],
                     values);
      for (int k = 0; k < count; ++k) {
        WaveGreenFunction::Value value = values[k];
        add_wave(row + k, j, fields[k], distances[k], value, block);
        if (row + k == j) continue;
        std::swap(value.along_z, value.along_zeta);
        add_wave(j, row + k, other, distances[k], value, block);
      }
    }
  }
}

std::vector<HullEquations::Influence<Complex>> HullEquations::integrate_waves(
    double frequency) const {
  const WaveGreenFunction green(model_.water(), frequency, reach_, deepest_);
  std::vector<WaveGreenFunction::Level> levels;
  for (const Vector3& point : points_) levels.push_back(green.level(point.z()));
  std::vector<Influence<Complex>> waves;
  for (std::size_t p = 0; p < parities_.size(); ++p) {
    waves.push_back({images_[p].source.cast<Complex>(), images_[p].dipole.cast<Complex>()});
    if (std::isinf(frequency)) {
      waves[p].source.real() -= 2.0 * surface_images_[p].source;
      waves[p].dipole.real() -= 2.0 * surface_images_[p].dipole;
      continue;
    }
    for (int j = 0; j < hull_count_; ++j) {
      waves[p].dipole.col(j).real() +=
          2.0 * green.deep_wave_number() * panel(j).normal.z() * surface_images_[p].source.col(j);
    }
  }
  if (std::isinf(frequency) && is_deep(model_.water())) return waves;
  std::vector<std::array<int, 2>> blocks;
  for (int column = 0; column < size(); column += block_size) {
    for (int row = 0; row <= column; row += block_size) blocks.push_back({row, column});
  }
  parallel::for_each(static_cast<int>(blocks.size()), settings_.threads, [&](int k) {
    WaveBlock block{green, levels, waves};
    add_wave_block(blocks[k][0], blocks[k][1], block);
  });
  return waves;
}

MatrixXcd HullEquations::make_matrix(const Influence<Complex>& waves, double frequency,
                                     int count) const {
  const double w = frequency, g = model_.water().gravity;
  MatrixXcd matrix(count, count);
  matrix.leftCols(hull_count_) = -waves.dipole.topRows(count);
  for (int j = hull_count_; j < count; ++j) {
    const int region = cells_.region[j - hull_count_];
    const Complex faded(w, region < 0 ? 0.0 : -settings_.lids[region].rate);
    const Complex b = region < 0 ? Complex(-w * w / g) : (faded * faded - w * w) / g;
    matrix.col(j) = -b * waves.source.col(j);
  }
  matrix.diagonal().head(hull_count_).array() += 2.0 * pi;
  matrix.diagonal().tail(count - hull_count_).array() += 4.0 * pi;
  return matrix;
}

std::vector<HullEquations::Part> HullEquations::solve(double frequency,
                                                      const Extent& extent) const {
  if (!(frequency > 0.0)) throw ModelError("the frequency of waves must be positive");
  std::vector<Influence<Complex>> waves = integrate_waves(frequency);
  // Without waves the potential is nothing on the surface, and needs no cells.
  const int count = std::isinf(frequency) ? hull_count_ : size();
  std::vector<Part> parts;
  for (std::size_t p = 0; p < parities_.size(); ++p) {
    Part& part = parts.emplace_back();
    part.parity = parities_[p];
    const MatrixXd velocities = model_.normal_velocities(part.parity);
    for (int mode = 0; mode < model_.mode_count(); ++mode) {
      if (!velocities.col(mode).isZero(0.0)) part.modes.push_back(mode);
    }
    part.normal_velocities = velocities(Eigen::all, part.modes);
    const MatrixXcd scattered =
        calc_opposed_velocities(model_, part.parity, frequency, extent.headings);
    const Eigen::Index modes = part.normal_velocities.cols();
    MatrixXcd all(hull_count_, modes + scattered.cols());
    all << part.normal_velocities.cast<Complex>(), scattered;
    MatrixXcd matrix = make_matrix(waves[p], frequency, count);
    const auto of_source = waves[p].source.topLeftCorner(count, hull_count_);
    MatrixXcd right = -(of_source * all);
    MatrixXd means;
    MatrixXcd of_means;
    if (extent.coarser) {
      means = coarser_.bodies.average(model_.body_areas(), part.normal_velocities)(
          coarser_.bodies.of_panel, Eigen::all);
      of_means = -(of_source * means.cast<Complex>());
    }
    waves[p] = {};
    if (extent.coarser) {
      const Influence<double>& at_middles =
          std::isinf(frequency) ? at_middles_without_waves_[p] : at_middles_[p];
      part.coarser_potentials = solve_coarser(at_middles, matrix, of_means, means);
    }
    solve_in_place(matrix, right, "the matrix of the hulls' panels");
    part.potentials = right.topLeftCorner(hull_count_, modes);
    part.scattered = right.topRows(hull_count_).rightCols(scattered.cols());
  }
  return parts;
}

// Potentials and velocities are constant on the clusters. Equations hold at the middles of those
// that are flat, but for the waves' smooth share, and in the mean over others. Cells stay.
MatrixXcd HullEquations::solve_coarser(const Influence<double>& at_middles, const MatrixXcd& matrix,
                                       const MatrixXcd& right, const MatrixXd& velocities) const {
  const Eigen::VectorXd areas = model_.body_areas();
  const Eigen::VectorXd whole = coarser_.bodies.sum(areas);
  const int cells = static_cast<int>(matrix.rows()) - hull_count_;
  const auto place = [&](int j) {
    return j < hull_count_ ? coarser_.bodies.of_panel[j] : coarser_.bodies.count + j - hull_count_;
  };
  const auto share = [&](int i) { return i < hull_count_ ? areas[i] / whole[place(i)] : 1.0; };
  const int count = coarser_.bodies.count + cells;
  MatrixXcd coarser = MatrixXcd::Zero(count, count);
  MatrixXcd coarser_right = MatrixXcd::Zero(count, right.cols());
  for (int i = 0; i < matrix.rows(); ++i) coarser_right.row(place(i)) += share(i) * right.row(i);
  for (int j = 0; j < matrix.cols(); ++j) {
    for (int i = 0; i < matrix.rows(); ++i) coarser(place(i), place(j)) += share(i) * matrix(i, j);
  }
  const auto& [source, dipole] = at_middles;
  const MatrixXcd of_hull = coarser_.bodies.sum_columns(dipole).cast<Complex>();
  const MatrixXcd of_modes = (source * velocities).cast<Complex>();
  for (std::size_t k = 0; k < coarser_.flat.clusters.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    coarser.row(coarser_.flat.clusters[k]).head(coarser_.bodies.count) -= of_hull.row(row);
    coarser_right.row(coarser_.flat.clusters[k]) -= of_modes.row(row);
  }
  solve_in_place(coarser, coarser_right, "the matrix of coarser panels of the hulls");
  return coarser_.bodies.spread(coarser_right.topRows(coarser_.bodies.count));
}

MatrixXcd HullEquations::calc_radiation(const std::vector<Part>& parts, double frequency) const {
  MatrixXcd result = MatrixXcd::Zero(model_.mode_count(), model_.mode_count());
  const Complex rate = std::isinf(frequency) ? Complex(1.0) : Complex(0.0, frequency);
  for (const Part& part : parts) {
    const MatrixXd weighted = model_.body_areas().asDiagonal() * part.normal_velocities;
    const double factor = -model_.water().density * model_.symmetry().image_count();
    result(part.modes, part.modes) += rate * factor * (weighted.transpose() * part.potentials);
  }
  return result;
}

MatrixXcd HullEquations::calc_coarser_radiation(const std::vector<Part>& parts,
                                                double frequency) const {
  std::vector<Part> coarser = parts;
  for (Part& part : coarser) part.potentials = part.coarser_potentials;
  return calc_radiation(coarser, frequency);
}

MatrixXcd HullEquations::calc_diffraction(const std::vector<Part>& parts, double frequency,
                                          const std::vector<double>& headings) const {
  MatrixXcd result = MatrixXcd::Zero(model_.mode_count(), headings.size());
  const Complex factor(0.0, frequency * model_.water().density * model_.symmetry().image_count());
  for (const Part& part : parts) {
    const MatrixXcd weighted = model_.body_areas().asDiagonal() *
                               calc_opposed_velocities(model_, part.parity, frequency, headings);
    result(part.modes, Eigen::all) += factor * (part.potentials.transpose() * weighted);
  }
  return result;
}

}  // namespace blocklift::dynamics

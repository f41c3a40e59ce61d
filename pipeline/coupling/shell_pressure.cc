#include "pipeline/coupling/shell_pressure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "algebra/products.h"
#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/marine/hull/wet_triangle.h"
#include "parallel/threads.h"

namespace blocklift::pipeline {

namespace {

using dynamics::HullForce;
using dynamics::Pose;
using dynamics::Vector3;
using dynamics::WaveField;

// Height of each point above the surface (m), and pressure over rho g there.
void find_water(const WaveField& waves, bool in_waves, double time, const Pose& X_WB,
                const std::vector<Vector3>& points_B, Eigen::VectorXd& height,
                Eigen::VectorXd& head) {
  std::array<Vector3, WaveField::most_points> place;
  std::array<double, WaveField::most_points> elevation{}, dynamic_head{};
  for (std::size_t first = 0; first < points_B.size(); first += WaveField::most_points) {
    const std::size_t count = std::min(points_B.size() - first, WaveField::most_points);
    for (std::size_t i = 0; i < count; ++i) place[i] = X_WB.apply(points_B[first + i]);
    if (in_waves)
      waves.calc_surface(time, {place.data(), count}, {elevation.data(), count},
                         {dynamic_head.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<Eigen::Index>(first + i);
      height[at] = place[i].z() - elevation[i];
      head[at] = dynamic_head[i] - place[i].z();
    }
  }
}

/// Wrenches of a history at those samples at which water presses on the hull.
struct WetSamples {
  std::vector<Eigen::Index> samples;  ///< ascending
  Eigen::MatrixXd wrenches;           ///< a column each
};

WetSamples wet_samples_of(const ShellPressure& pressure, Eigen::Index rows, const HullForce& hull,
                          const dynamics::History& history) {
  constexpr int batch = 64;
  const HullForce::Definition& definition = hull.definition();
  const dynamics::BodyHistory& body = history.bodies[definition.body - 1];
  const bool in_waves = definition.wave_loading == dynamics::WaveLoading::froude_krylov &&
                        !definition.sea->waves.is_still();
  const int count = static_cast<int>(history.sample_count());
  std::vector<WetSamples> parts(static_cast<std::size_t>((count + batch - 1) / batch));
  parallel::in_batches(count, batch, 0, [&](int first, int some) {
    WetSamples& part = parts[first / batch];
    Eigen::MatrixXd wrenches(rows, some);
    Eigen::Index wet = 0;
    for (int sample = first; sample < first + some; ++sample) {
      pressure.calc_wrenches(*definition.sea, in_waves, history.time(sample), body.X_WB(sample),
                             wrenches.col(wet));
      if (wrenches.col(wet).isZero(0)) continue;
      part.samples.push_back(sample);
      ++wet;
    }
    part.wrenches = wrenches.leftCols(wet);
  });
  WetSamples all;
  for (const WetSamples& part : parts)
    all.samples.insert(all.samples.end(), part.samples.begin(), part.samples.end());
  all.wrenches.resize(rows, static_cast<Eigen::Index>(all.samples.size()));
  Eigen::Index next = 0;
  for (WetSamples& part : parts) {
    all.wrenches.middleCols(next, part.wrenches.cols()) = part.wrenches;
    next += part.wrenches.cols();
    part.wrenches.resize(0, 0);
  }
  return all;
}

// Force and moment about Bo of regions' wrenches, a column each.
Eigen::MatrixXd resultants_of(const structure::ShellRegions& shell,
                              const Eigen::MatrixXd& wrenches) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(6, wrenches.cols());
  for (std::size_t r = 0; r < shell.regions().size(); ++r) {
    const auto of_region = wrenches.middleRows<6>(6 * r);
    sum += of_region;
    for (Eigen::Index k = 0; k < wrenches.cols(); ++k)
      sum.col(k).tail<3>() +=
          shell.regions()[r].centre_B.cross(Vector3(of_region.col(k).head<3>()));
  }
  return sum;
}

/// Modes of columns, most important first, as many as leave no more than the tolerance.
struct ColumnModes {
  Eigen::MatrixXd modes;    ///< orthonormal columns
  Eigen::MatrixXd factors;  ///< of the columns, a row a mode
  double error = 0;         ///< largest of what is left of a column, over the largest column
};

ColumnModes find_modes(const Eigen::MatrixXd& columns, double tolerance) {
  constexpr Eigen::Index together = 16;
  Eigen::MatrixXd ascending = algebra::row_products(columns);
  dynamics::decompose_symmetric(ascending);
  Eigen::VectorXd left = columns.colwise().squaredNorm();
  const double largest = left.maxCoeff();
  ColumnModes found;
  found.modes = ascending.rowwise().reverse();
  Eigen::Index count = 0;
  while (count < found.modes.cols() && left.maxCoeff() > tolerance * tolerance * largest) {
    if (count == found.factors.rows()) {
      const Eigen::Index more = std::min(together, found.modes.cols() - count);
      found.factors.conservativeResize(count + more, columns.cols());
      found.factors.bottomRows(more) = found.modes.middleCols(count, more).transpose() * columns;
    }
    left -= found.factors.row(count).cwiseAbs2().transpose();
    ++count;
  }
  found.modes.conservativeResize(Eigen::NoChange, count);
  found.factors.conservativeResize(count, columns.cols());
  found.error = std::sqrt(std::max(0.0, left.maxCoeff()) / largest);
  return found;
}

/// The rows that are not zero throughout.
std::vector<Eigen::Index> rows_in_use(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd largest = matrix.cwiseAbs().rowwise().maxCoeff();
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < largest.size(); ++row)
    if (largest[row] > 0) rows.push_back(row);
  return rows;
}

/// Factors at all samples of a history from those of some, a column each; elsewhere they are zero.
Eigen::MatrixXd at_all_samples(const Eigen::MatrixXd& factors,
                               const std::vector<Eigen::Index>& samples, Eigen::Index count) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(factors.rows(), count);
  for (std::size_t i = 0; i < samples.size(); ++i)
    all.col(samples[i]) = factors.col(static_cast<Eigen::Index>(i));
  return all;
}

}  // namespace

ShellPressure::ShellPressure(const dynamics::Hull& hull, const structure::ShellRegions& shell)
    : points_B_(hull.vertices()) {
  std::vector<int> region_of(static_cast<std::size_t>(hull.panel_count()));
  parallel::in_batches(hull.panel_count(), 64, 0, [&](int first, int count) {
    for (int panel = first; panel < first + count; ++panel)
      region_of[panel] =
          shell.nearest(hull.panel_midpoint(panel), hull.panel_area_vector(panel).normalized());
  });
  for (int panel = 0; panel < hull.panel_count(); ++panel) {
    const auto corners = hull.panel(panel);
    const int region = region_of[panel];
    for (std::size_t i = 2; i < corners.size(); ++i)
      panels_.push_back({{corners[0], corners[i - 1], corners[i]}, region});
  }
  for (const structure::ShellRegion& region : shell.regions())
    centres_B_.push_back(region.centre_B);
}

void ShellPressure::calc_wrenches(const dynamics::Sea& sea, bool in_waves, double time,
                                  const Pose& X_WB, Eigen::Ref<Eigen::VectorXd> wrenches) const {
  wrenches.setZero();
  const auto count = static_cast<Eigen::Index>(points_B_.size());
  Eigen::VectorXd height(count), head(count);
  find_water(sea.waves, in_waves, time, X_WB, points_B_, height, head);
  if (height.minCoeff() >= 0) return;
  const double rho_g = sea.water().density * sea.water().gravity;
  for (const Panel& panel : panels_) {
    std::array<Vector3, 3> p;
    std::array<double, 3> heights{}, heads{};
    for (std::size_t i = 0; i < 3; ++i) {
      const int point = panel.points[i];
      p[i] = points_B_[point] - centres_B_[panel.region];
      heights[i] = height[point];
      heads[i] = head[point];
    }
    const Vector3 area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
    dynamics::ForceVector F = dynamics::ForceVector::zero();
    dynamics::add_wet_part({&p[0], &p[1], &p[2]}, heights, heads, area, F);
    wrenches.segment<3>(6 * panel.region) += rho_g * F.force;
    wrenches.segment<3>(6 * panel.region + 3) += rho_g * F.moment;
  }
}

const HullForce* find_hull(const dynamics::LiftSystem& system, dynamics::BodyIndex body) {
  for (const HullForce& hull : std::get<std::vector<HullForce>>(system.elements()))
    if (hull.definition().body == body) return &hull;
  return nullptr;
}

std::optional<PressureBasis> find_pressure_basis(const structure::ElasticModel& model,
                                                 const HullForce& at_rest,
                                                 const dynamics::History& static_history,
                                                 const HullForce& in_motion,
                                                 const dynamics::History& dynamic_history,
                                                 const PressureSettings& settings) {
  const structure::ShellRegions shell(model, settings.region_size);
  const ShellPressure pressure(in_motion.definition().hull->hull(), shell);
  const auto regions = static_cast<Eigen::Index>(shell.regions().size());
  const WetSamples still = wet_samples_of(pressure, 6 * regions, at_rest, static_history),
                   moving = wet_samples_of(pressure, 6 * regions, in_motion, dynamic_history);
  const Eigen::Index still_count = still.wrenches.cols(), moving_count = moving.wrenches.cols();
  if (still_count + moving_count == 0) return {};
  Eigen::MatrixXd scaled(6 * regions, still_count + moving_count);
  scaled.leftCols(still_count) = still.wrenches;
  scaled.rightCols(moving_count) = moving.wrenches;
  // Most of the shell stays dry, and nothing of a mode is there.
  const std::vector<Eigen::Index> wet = rows_in_use(scaled);
  if (wet.empty()) return {};
  scaled = scaled(wet, Eigen::all).eval();
  Eigen::VectorXd scale(6 * regions);
  scale.reshaped(6, regions).topRows<3>().setOnes();
  scale.reshaped(6, regions).bottomRows<3>().setConstant(2 / settings.region_size);
  scaled.array().colwise() *= scale(wet).array();
  const ColumnModes found = find_modes(scaled, settings.tolerance);

  PressureBasis basis;
  basis.regions = static_cast<int>(regions);
  basis.error = found.error;
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(6 * regions, found.modes.cols());
  fields(wet, Eigen::all) = scale(wet).cwiseInverse().asDiagonal() * found.modes;
  basis.loads = shell.loads(fields);
  basis.resultants = resultants_of(shell, fields);
  basis.static_factors = at_all_samples(found.factors.leftCols(still_count), still.samples,
                                        static_history.sample_count());
  basis.dynamic_factors = at_all_samples(found.factors.rightCols(moving_count), moving.samples,
                                         dynamic_history.sample_count());
  basis.largest_force = (basis.resultants.topRows<3>() * found.factors).colwise().norm().maxCoeff();
  return basis;
}

}  // namespace blocklift::pipeline

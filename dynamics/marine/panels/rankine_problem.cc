#include "dynamics/marine/panels/rankine_problem.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "dynamics/algebra/single_precision.h"
#include "dynamics/errors.h"
#include "parallel/threads.h"

namespace blocklift::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

constexpr const char* bad_panels =
    "two panels lie on each other, or a panel lies in the free surface";

std::atomic<double> memory_limit{std::numeric_limits<double>::infinity()};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// One evaluation of a panel's potentials at images of the collocation points.
struct ImagePoints {
  PointColumns points;
  double source_sign;  ///< 0: not due
  double dipole_sign;
  /// Of the points themselves, for each panel: that which lies on it, where its own dipole has the
  /// mean value zero; -1: none.
  const std::vector<int>* own = nullptr;
  bool coplanar = false;
};

/// Collocation points reflected in the planes of symmetry, and then by z -> offset + factor z.
PointColumns image_of(PointColumns points, const Symmetry& symmetry, int image, double offset,
                      double factor) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 p = symmetry.reflect(image, {points.x[i], points.y[i], points.z[i]});
    points.x[i] = p.x();
    points.y[i] = p.y();
    points.z[i] = offset + factor * p.z();
  }
  return points;
}

/// Adds a panel's potentials at all image points. What is null is not due.
void add_column(const PanelMesh& panels, int j, const std::vector<ImagePoints>& images,
                double* source, double* dipole) {
  const Panel& panel = panels.panels[j];
  for (const ImagePoints& image : images) {
    const bool with_source = source != nullptr && image.source_sign != 0.0;
    const bool with_dipole = dipole != nullptr && image.dipole_sign != 0.0 && !image.coplanar;
    if (with_source && with_dipole) {
      add_panel_potentials(panel, image.points, PanelIntegral::both, image.source_sign, source,
                           dipole);
    } else if (with_source) {
      add_panel_potentials(panel, image.points,
                           image.coplanar ? PanelIntegral::coplanar_source : PanelIntegral::source,
                           image.source_sign, source, nullptr);
    } else if (with_dipole) {
      add_panel_potentials(panel, image.points, PanelIntegral::dipole, image.dipole_sign, nullptr,
                           dipole);
    }
    if (image.own != nullptr && with_dipole && (*image.own)[j] >= 0) dipole[(*image.own)[j]] = 0.0;
  }
}

/// Adds the panels' potentials at all image points: a column of the matrices for each panel. An
/// empty matrix is not due.
void add_influence(const PanelMesh& panels, const std::vector<ImagePoints>& images, int threads,
                   MatrixXd& source, MatrixXd& dipole) {
  parallel::for_each(panels.size(), threads, [&](int j) {
    add_column(panels, j, images, source.size() > 0 ? source.col(j).data() : nullptr,
               dipole.size() > 0 ? dipole.col(j).data() : nullptr);
  });
}

/// The same with the sources' columns in single precision, which they are taken in afterwards: in
/// double precision the matrix of a surface would be the largest of all.
void find_influence(const PanelMesh& panels, const std::vector<ImagePoints>& images, int threads,
                    MatrixXf& source, MatrixXd& dipole) {
  parallel::for_each(panels.size(), threads, [&](int j) {
    VectorXd column = VectorXd::Zero(source.rows());
    add_column(panels, j, images, column.data(),
               dipole.size() > 0 ? dipole.col(j).data() : nullptr);
    source.col(j) = column.cast<float>();
  });
}

/// The matrix in single precision; nothing is left of it.
MatrixXf take_single(MatrixXd& matrix) {
  MatrixXf single = matrix.cast<float>();
  matrix.resize(0, 0);
  return single;
}

/// Replaces A by the symmetric part of W^1/2 A W^-1/2, in place.
void make_symmetric(const VectorXd& root_weights, MatrixXf& A) {
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      const auto ratio = static_cast<float>(root_weights[i] / root_weights[j]);
      A(i, j) = A(j, i) = 0.5F * (A(i, j) * ratio + A(j, i) / ratio);
    }
  }
}

void refuse_if_too_large(const PanelModel& model, const RankineSettings& settings) {
  const double limit = settings.memory_limit > 0.0 ? settings.memory_limit : usable_memory();
  const int bodies = model.body_mesh().size(), surface = model.surface_mesh().size();
  const double needed = rankine_part_bytes(bodies, surface, !is_deep(model.water()));
  if (needed <= limit) return;
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(),
                "%d panels on the bodies and %d on the surface need %.2f GB of memory, but %.2f GB "
                "may be used: take fewer panels, or the planes of symmetry",
                bodies, surface, needed / 1e9, limit / 1e9);
  throw SimulationError(text.data());
}

}  // namespace

double usable_memory() {
  return std::min(memory_limit.load(), 0.8 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                                           static_cast<double>(sysconf(_SC_PAGE_SIZE)));
}

void limit_usable_memory(double bytes) { memory_limit = bytes; }

struct RankinePart::Influence {
  MatrixXd S_BB, D_BB;  ///< bodies on bodies, with the images in z = 0
  MatrixXd S_BF, D_BF;  ///< of the surface on bodies; S_BF is empty in deep water
  MatrixXd S_FB, D_FB;  ///< bodies on surface
  MatrixXf S_FF;        ///< surface on surface
  MatrixXd D_FF;        ///< empty in deep water
};

struct RankinePart::Factors {
  LuFactorisation body;
  SingleLuFactorisation surface;
  MatrixXd S_BB, S_FB, D_FB;
  MatrixXd body_from_velocity;  ///< U: body potential of w, empty in deep water
  VectorXd root_area;
};

namespace {

std::vector<int> count_up(int size) {
  std::vector<int> numbers(static_cast<std::size_t>(size));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

void RankinePart::add_at_bodies(const PanelModel& model, const PointColumns& points,
                                const std::vector<int>& own, int threads,
                                Influence& influence) const {
  const PanelMesh &bodies = model.body_mesh(), &surface = model.surface_mesh();
  const bool deep = is_deep(model.water());
  const double h = model.water().depth;
  std::vector<ImagePoints> of_bodies, of_surface;
  for (int g = 0; g < image_count_; ++g) {
    const double s = model.sign(parity_, g);
    const auto image = [&](double offset, double factor) {
      return image_of(points, model.symmetry(), g, offset, factor);
    };
    of_bodies.push_back({image(0, 1), s, s, g == 0 ? &own : nullptr});
    of_bodies.push_back({image(0, -1), -s, -s});
    // The dipoles of the surface are odd in z, its sources even: 1/r - 1/r' doubles or cancels
    // them.
    of_surface.push_back({image(0, 1), 0.0, 2.0 * s});
    if (deep) continue;
    of_bodies.push_back({image(-2 * h, -1), s, s});
    of_bodies.push_back({image(-2 * h, 1), -s, -s});
    of_surface.push_back({image(-2 * h, -1), s, s});
    of_surface.push_back({image(-2 * h, 1), -s, -s});
  }
  const auto rows = static_cast<Eigen::Index>(points.size());
  influence.S_BB = influence.D_BB = MatrixXd::Zero(rows, bodies.size());
  influence.D_BF = MatrixXd::Zero(rows, surface.size());
  if (!deep) influence.S_BF = MatrixXd::Zero(rows, surface.size());
  add_influence(bodies, of_bodies, threads, influence.S_BB, influence.D_BB);
  add_influence(surface, of_surface, threads, influence.S_BF, influence.D_BF);
}

RankinePart::Influence RankinePart::compute_influence(const PanelModel& model, int threads) const {
  const PanelMesh &bodies = model.body_mesh(), &surface = model.surface_mesh();
  const bool deep = is_deep(model.water());
  const double h = model.water().depth;
  const PointColumns points(surface);
  const std::vector<int> own = count_up(surface.size());
  std::vector<ImagePoints> of_bodies, of_surface;
  for (int g = 0; g < image_count_; ++g) {
    const double s = model.sign(parity_, g);
    const auto image = [&](double offset, double factor) {
      return image_of(points, model.symmetry(), g, offset, factor);
    };
    of_bodies.push_back({image(0, 1), s, s});
    of_surface.push_back({image(0, 1), s, 0.0, g == 0 ? &own : nullptr, true});
    if (deep) continue;
    of_bodies.push_back({image(-2 * h, -1), s, s});
    of_surface.push_back({image(-2 * h, -1), s, s});
  }
  const Eigen::Index nb = bodies.size(), nf = surface.size();
  Influence influence;
  add_at_bodies(model, PointColumns(bodies), count_up(bodies.size()), threads, influence);
  influence.S_FB = influence.D_FB = MatrixXd::Zero(nf, nb);
  influence.S_FF.resize(nf, nf);
  if (!deep) influence.D_FF = MatrixXd::Zero(nf, nf);
  add_influence(bodies, of_bodies, threads, influence.S_FB, influence.D_FB);
  find_influence(surface, of_surface, threads, influence.S_FF, influence.D_FF);
  return influence;
}

RankinePart::RankinePart(const PanelModel& model, const Parity& parity,
                         const RankineSettings& settings)
    : parity_(parity), image_count_(model.symmetry().image_count()) {
  refuse_if_too_large(model, settings);
  const MatrixXd all_velocities = model.normal_velocities(parity);
  for (int mode = 0; mode < model.mode_count(); ++mode) {
    if (!all_velocities.col(mode).isZero(0.0)) modes_.push_back(mode);
  }
  normal_velocities_ = all_velocities(Eigen::all, modes_);
  const auto start = std::chrono::steady_clock::now();
  Influence influence = compute_influence(model, settings.threads);
  timing_.influence_s = seconds_since(start);
  const Areas areas{model.body_areas(), model.surface_areas(), is_deep(model.water())};
  const std::vector<Panel>& panels = model.surface_mesh().panels;
  surface_points_.resize(2, static_cast<Eigen::Index>(panels.size()));
  for (std::size_t k = 0; k < panels.size(); ++k)
    surface_points_.col(static_cast<Eigen::Index>(k)) = panels[k].centroid.head<2>();
  if (settings.coarser) solve_coarser(model, influence, areas, settings);
  reduce(std::move(influence), areas, settings.keep_factors);
}

void RankinePart::solve_coarser(const PanelModel& model, const Influence& influence,
                                const Areas& areas, const RankineSettings& settings) {
  const PanelClusters &b = settings.coarser->bodies, &f = settings.coarser->surface;
  const auto coarsen = [](const auto& matrix, const PanelClusters& rows, const VectorXd& row_areas,
                          const PanelClusters& columns) {
    return PanelClusters::coarsen(matrix, rows, row_areas, columns);
  };
  Influence coarse{
      coarsen(influence.S_BB, b, areas.bodies, b),  coarsen(influence.D_BB, b, areas.bodies, b),
      coarsen(influence.S_BF, b, areas.bodies, f),  coarsen(influence.D_BF, b, areas.bodies, f),
      coarsen(influence.S_FB, f, areas.surface, b), coarsen(influence.D_FB, f, areas.surface, b),
      coarsen(influence.S_FF, f, areas.surface, f), coarsen(influence.D_FF, f, areas.surface, f)};
  take_rows_at_middles(model, *settings.coarser, settings.threads, coarse);
  const std::shared_ptr<RankinePart> part(new RankinePart);
  part->parity_ = parity_;
  part->image_count_ = image_count_;
  part->modes_ = modes_;
  part->normal_velocities_ = b.average(areas.bodies, normal_velocities_);
  part->surface_points_ = f.average(areas.surface, surface_points_.transpose()).transpose();
  part->reduce(std::move(coarse), {b.sum(areas.bodies), f.sum(areas.surface), areas.deep}, false);
  coarser_ = part;
}

void RankinePart::take_rows_at_middles(const PanelModel& model, const CoarserPanels& panels,
                                       int threads, Influence& coarse) const {
  const FlatClusters& flat = panels.flat;
  if (flat.clusters.empty()) return;
  PointColumns points(flat.middles.size());
  for (std::size_t k = 0; k < flat.middles.size(); ++k) {
    points.x[k] = flat.middles[k].x();
    points.y[k] = flat.middles[k].y();
    points.z[k] = flat.middles[k].z();
  }
  Influence here;
  add_at_bodies(model, points, flat.of_panel, threads, here);
  const auto take = [&](const MatrixXd& rows, const PanelClusters& columns, MatrixXd& matrix) {
    if (rows.size() > 0) matrix(flat.clusters, Eigen::all) = columns.sum_columns(rows);
  };
  take(here.S_BB, panels.bodies, coarse.S_BB);
  take(here.D_BB, panels.bodies, coarse.D_BB);
  take(here.S_BF, panels.surface, coarse.S_BF);
  take(here.D_BF, panels.surface, coarse.D_BF);
}

void RankinePart::reduce(Influence influence, const Areas& areas, bool keep_factors) {
  const MatrixXd& n = normal_velocities_;
  const bool deep = areas.deep;
  const VectorXd root_area = areas.surface.cwiseSqrt();

  // The bodies: (2 pi - D_BB) phi_B = D_BF phi_F - S_BB v + S_BF w.
  auto start = std::chrono::steady_clock::now();
  auto factors = std::make_shared<Factors>();
  MatrixXd body_matrix = std::move(influence.D_BB);
  body_matrix *= -1.0;
  body_matrix.diagonal().array() += 2.0 * std::numbers::pi;
  factors->body =
      LuFactorisation(std::move(body_matrix), "the matrix of the bodies' panels", bad_panels);
  MatrixXd& P = influence.D_BF;
  factors->body.solve_in_place(P);
  body_columns_ = -(influence.S_BB * n);
  factors->body.solve_in_place(body_columns_);
  MatrixXd& U = influence.S_BF;
  if (!deep) {
    factors->body.solve_in_place(U);
    multiply(1.0F, influence.D_FB.cast<float>(), U.cast<float>(), 1.0F, influence.S_FF);
  }

  // The surface: (S_FF + D_FB U) w = (2 pi - D_FF - D_FB P) phi_F + (S_FB n - D_FB Phi) v. In
  // single precision, which the march takes the operator in: it costs most of all, and added mass,
  // damping and excitation change by a few millionths.
  factors->surface = SingleLuFactorisation(std::move(influence.S_FF),
                                           "the matrix of the free surface's panels", bad_panels);
  timing_.factorisation_s = seconds_since(start);
  start = std::chrono::steady_clock::now();
  MatrixXf& reduced = surface_operator_;
  reduced.setZero(root_area.size(), root_area.size());
  if (!deep) reduced = -take_single(influence.D_FF);
  reduced.diagonal().array() += static_cast<float>(2.0 * std::numbers::pi);
  multiply(-1.0F, influence.D_FB.cast<float>(), P.cast<float>(), 1.0F, reduced);
  factors->surface.solve_in_place(reduced);
  MatrixXd driven = MatrixXd::Zero(root_area.size(), n.cols());
  multiply(1.0, influence.S_FB, n, 0.0, driven);
  multiply(-1.0, influence.D_FB, body_columns_, 1.0, driven);
  MatrixXf single_q = driven.cast<float>();
  factors->surface.solve_in_place(single_q);
  const MatrixXd q = single_q.cast<double>();
  if (!keep_factors) factors.reset();
  if (!deep) {
    MatrixXf of_surface_velocity = MatrixXf::Zero(P.rows(), P.cols());
    multiply(1.0F, U.cast<float>(), reduced, 0.0F, of_surface_velocity);
    P += of_surface_velocity.cast<double>();
    body_columns_ += U * q;
  }

  make_symmetric(root_area, surface_operator_);
  body_from_surface_ = P * root_area.cwiseInverse().asDiagonal();
  const MatrixXd weighted = areas.bodies.asDiagonal() * n;
  const MatrixXd by_velocity = root_area.asDiagonal() * q;
  const MatrixXd by_force = body_from_surface_.transpose() * weighted;
  surface_columns_ = 0.5 * (by_velocity + by_force);
  for (Eigen::Index m = 0; m < q.cols(); ++m) {
    const double difference = (by_velocity.col(m) - by_force.col(m)).norm();
    reciprocity_error_ = std::max(reciprocity_error_, difference / surface_columns_.col(m).norm());
  }
  infinite_frequency_volume_ = -image_count_ * weighted.transpose() * body_columns_;
  timing_.reduction_s = seconds_since(start);
  if (!keep_factors) return;
  factors->S_BB = std::move(influence.S_BB);
  factors->S_FB = std::move(influence.S_FB);
  factors->D_FB = std::move(influence.D_FB);
  factors->body_from_velocity = std::move(U);
  factors->root_area = root_area;
  factors_ = factors;
}

void RankinePart::solve(const MatrixXd& normal_velocities, MatrixXd& body_potentials,
                        MatrixXd& surface_velocities) const {
  if (!factors_) {
    throw ModelError("the factors for other normal velocities were not kept: set keep_factors");
  }
  body_potentials = -(factors_->S_BB * normal_velocities);
  factors_->body.solve_in_place(body_potentials);
  MatrixXf velocities =
      (factors_->S_FB * normal_velocities - factors_->D_FB * body_potentials).cast<float>();
  factors_->surface.solve_in_place(velocities);
  surface_velocities = velocities.cast<double>();
  if (factors_->body_from_velocity.size() > 0) {
    body_potentials += factors_->body_from_velocity * surface_velocities;
  }
  surface_velocities = factors_->root_area.asDiagonal() * surface_velocities;
}

double rankine_part_bytes(int body_panels, int surface_panels, bool finite_depth) {
  const double nb = body_panels, nf = surface_panels;
  // On the surface, in single precision, the sources' influence, in whose place its factors come,
  // and the reduced operator; D_FB, S_FB, P and its scaled copy; two matrices of the bodies. In
  // finite depth S_BF and the dipoles' influence besides.
  const double numbers = (finite_depth ? 2.5 : 1.0) * nf * nf + 4.0 * nb * nf + 2.0 * nb * nb +
                         (finite_depth ? nb * nf : 0.0);
  return numbers * sizeof(double);
}

}  // namespace blocklift::dynamics

#include "dynamics/marine/radiation/free_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "algebra/decompositions.h"
#include "dynamics/algebra/single_precision.h"
#include "dynamics/errors.h"

namespace blocklift::dynamics {
namespace {

// Of 1,712 panels and 6 columns a dense product takes 0.5 ms and a hierarchical one 0.6 ms on two
// threads; of 8,616 panels and 18 columns 21.6 and 7.0 ms.
constexpr Eigen::Index most_panels_of_dense_operator = 2500;
// Leaves a millionth of a product: blocks of panels that lie apart are small beside the others. A
// ship and two pontoons: added mass, damping and diffraction change by 0.05 % of the largest.
constexpr double accuracy_of_blocks = 1e-3;

}  // namespace

Symmetry keep_symmetry(const Symmetry& symmetry, const std::vector<DampingLid>& lids) {
  Symmetry kept = symmetry;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const auto is_image = [axis](const DampingLid& lid, const DampingLid& other) {
      DampingLid image = lid;
      image.low[axis] = -lid.high[axis];
      image.high[axis] = -lid.low[axis];
      const double tolerance = 1e-6 * (lid.high - lid.low).norm();
      return (image.low - other.low).norm() < tolerance &&
             (image.high - other.high).norm() < tolerance && lid.rate == other.rate;
    };
    const bool symmetric = std::all_of(lids.begin(), lids.end(), [&](const DampingLid& lid) {
      return std::any_of(lids.begin(), lids.end(),
                         [&](const DampingLid& other) { return is_image(lid, other); });
    });
    if (!symmetric) (axis == 0 ? kept.x : kept.y) = false;
  }
  return kept;
}

Eigen::VectorXd DampingZone::rates(const SurfaceMesh& surface) const {
  Eigen::VectorXd rates(surface.mesh.size());
  for (int k = 0; k < surface.mesh.size(); ++k) {
    const Vector3& p = surface.mesh.panels[k].centroid;
    const double distance = (p - surface.centre).norm() - surface.inner_radius;
    const double fraction =
        std::clamp(distance / (surface.outer_radius - surface.inner_radius), 0.0, 1.0);
    rates[k] = strength * fraction * fraction;
    for (const DampingLid& lid : lids) {
      if (lid.contains(p)) rates[k] = std::max(rates[k], lid.rate);
    }
  }
  return rates;
}

DampingZone damping_zone(double lowest_frequency) { return {1.1 * lowest_frequency}; }

FreeSurfaceMarch::FreeSurfaceMarch(const RankinePart& part, const SurfaceDamping& damping,
                                   double gravity, Eigen::Index columns)
    : gravity_(gravity),
      damping_(damping),
      restoring_((damping.rates.array().square() / gravity).matrix().cast<float>()) {
  const Eigen::Index n = part.surface_operator().rows();
  if (n <= most_panels_of_dense_operator) {
    operator_ = part.surface_operator();
  } else {
    hierarchical_operator_ =
        HierarchicalMatrix(part.surface_operator(), part.surface_points(), accuracy_of_blocks);
  }
  elevation_ = potential_ = Eigen::MatrixXd::Zero(n, columns);
  single_potential_ = single_velocity_ = Eigen::MatrixXf::Zero(n, columns);
  differences_ = Eigen::MatrixXd::Zero(damping.rings.rows(), columns);
  step_limit_ = find_step_limit();
}

// A hierarchical operator takes 31 MB of 8,616 panels, and little more than in proportion.
double FreeSurfaceMarch::operator_bytes(double panels) {
  return sizeof(float) * panels * std::min<double>(panels, most_panels_of_dense_operator);
}

void FreeSurfaceMarch::apply(const Eigen::MatrixXf& X, Eigen::MatrixXf& Y,
                             HierarchicalMatrix::Workspace& workspace) const {
  if (operator_.size() > 0) {
    multiply_symmetric(operator_, X, Y);
  } else {
    hierarchical_operator_.multiply(X, Y, workspace);
  }
  Y += restoring_.asDiagonal() * X;
}

// What is between the first and the second power of the step has no eigenvalue above one once a
// step that makes it lambda is lambda times shorter.
double FreeSurfaceMarch::find_step_limit() const {
  const double without_loss = 2.0 / std::sqrt(gravity_ * find_largest_eigenvalue(1.0, 0.0));
  if (damping_.rings.rows() == 0) return without_loss;
  const double with_loss =
      find_largest_eigenvalue(0.25 * gravity_ * without_loss * without_loss, 0.5 * without_loss);
  return without_loss / std::max(1.0, with_loss);
}

/// Lanczos' iteration: the largest eigenvalue of its small tridiagonal matrix.
double FreeSurfaceMarch::find_largest_eigenvalue(double potential, double loss) const {
  const Eigen::Index n = restoring_.size(), steps = std::min<Eigen::Index>(n, 50);
  if (n == 0) return 1.0;
  // Rough fields hold the largest eigenvalue: start from one that changes sign at random.
  Eigen::MatrixXf x(n, 1), y(n, 1), last = Eigen::MatrixXf::Zero(n, 1);
  unsigned state = 1;
  for (Eigen::Index i = 0; i < n; ++i) {
    state = state * 1664525U + 1013904223U;
    x(i, 0) = static_cast<float>(state >> 8U) / 8388608.0F - 1.0F;
  }
  x /= x.norm();
  Eigen::VectorXd diagonal(steps), off_diagonal = Eigen::VectorXd::Zero(steps);
  Eigen::Index k = 0;
  HierarchicalMatrix::Workspace workspace;
  for (float beta = 0.0F; k < steps; ++k) {
    apply(x, y, workspace);
    y *= static_cast<float>(potential);
    if (loss > 0.0) {
      const Eigen::VectorXd lost =
          damping_.rings.transpose() * (damping_.rings * x.col(0).cast<double>());
      y += (loss * lost).cast<float>();
    }
    const float alpha = x.col(0).dot(y.col(0));
    diagonal[k] = static_cast<double>(alpha);
    y -= alpha * x + beta * last;
    beta = y.norm();
    if (!(beta > 1e-6F * std::abs(alpha))) {
      ++k;
      break;
    }
    off_diagonal[k] = static_cast<double>(beta);
    last = x;
    x = y / beta;
  }
  return 1.01 * algebra::tridiagonal_eigenvalues(diagonal.head(k), off_diagonal.head(k - 1))[k - 1];
}

void FreeSurfaceMarch::start(const Eigen::MatrixXd& elevation, double step) {
  if (!(step > 0.0) || step > step_limit_) {
    throw ModelError("the free surface is to be marched by " + std::to_string(step) +
                     " s, but its step must be positive and at most " +
                     std::to_string(step_limit_) + " s: take a shorter step or wider panels");
  }
  step_ = step;
  before_ = 1.0 - step * damping_.rates.array();
  after_ = (1.0 + step * damping_.rates.array()).inverse();
  weighted_rings_ = damping_.rings * (step * after_).asDiagonal();
  elevation_ = elevation;
  // Half a step back, so that the potential is zero now to the second order.
  potential_ = 0.5 * step * gravity_ * elevation;
}

void FreeSurfaceMarch::advance(const Eigen::MatrixXd& supply) {
  potential_.noalias() -= (step_ * gravity_) * elevation_;
  single_potential_ = potential_.cast<float>();
  apply(single_potential_, single_velocity_, workspace_);
  if (damping_.rings.rows() > 0) differences_.noalias() = damping_.rings * elevation_;
  for (Eigen::Index j = 0; j < elevation_.cols(); ++j) {
    auto elevation = elevation_.col(j).array();
    const auto velocity = single_velocity_.col(j).cast<double>().array();
    if (supply.size() > 0) {
      elevation = after_.array() *
                  (before_.array() * elevation + step_ * (velocity + supply.col(j).array()));
    } else {
      elevation = after_.array() * (before_.array() * elevation + step_ * velocity);
    }
  }
  if (damping_.rings.rows() == 0) return;
  elevation_.noalias() -= weighted_rings_.transpose() * differences_;
}

}  // namespace blocklift::dynamics

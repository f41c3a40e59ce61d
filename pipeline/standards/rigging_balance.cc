#include "pipeline/standards/rigging_balance.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "algebra/decompositions.h"

namespace blocklift::pipeline {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// What a pull T along u at an arm r turns with: the second order of -u . (turn x (turn x r)) / 2.
void add_arm(const RiggingEnd& end, Eigen::Index first, const Vector3d& u, double tension,
             MatrixXd& stiffness) {
  if (end.kind != RiggingEnd::Kind::load && end.kind != RiggingEnd::Kind::bar) return;
  const Matrix3d ur = u * end.r_W.transpose();
  stiffness.block<3, 3>(first, first) +=
      tension * (u.dot(end.r_W) * Matrix3d::Identity() - (ur + ur.transpose()) / 2);
}

/// Does it end at a fixed place and hold more than its own hook? An idle tackle beside the one that
/// bears keeps the load from no turn.
bool holds_rigging(const RiggingRope& tackle, const std::vector<RiggingRope>& ropes) {
  if (tackle.upper.kind != RiggingEnd::Kind::fixed || !(tackle.tension > 0)) return false;
  if (tackle.lower.kind != RiggingEnd::Kind::hook) return true;
  return std::ranges::any_of(ropes, [&](const RiggingRope& sling) {
    return sling.upper.kind == RiggingEnd::Kind::hook && sling.upper.index == tackle.lower.index &&
           sling.tension > 0;
  });
}

}  // namespace

RiggingBalance::RiggingBalance(std::vector<RiggingRope> ropes, int hooks,
                               Eigen::MatrixXd compliance, int bars)
    : ropes_(std::move(ropes)), bars_(bars), compliance_(std::move(compliance)) {
  const auto count = static_cast<Eigen::Index>(ropes_.size());
  elongation_ = MatrixXd::Zero(count, 6 + 6 * bars + 3 * hooks);
  if (compliance_.size() == 0) compliance_ = MatrixXd::Zero(count, count);
  tension_.resize(count);
  for (std::size_t i = 0; i < ropes_.size(); ++i) add_rope(i);
  turns_freely_ = std::ranges::count_if(ropes_, [&](const RiggingRope& rope) {
                    return holds_rigging(rope, ropes_);
                  }) == 1;
}

/// Where the displacements of what a rope ends at begin in x: turn and shift of the load, those of
/// each bar, shifts of the hooks.
Eigen::Index RiggingBalance::first_of(const RiggingEnd& end) const {
  switch (end.kind) {
    case RiggingEnd::Kind::hook:
      return 6 + 6 * bars_ + 3 * end.index;
    case RiggingEnd::Kind::bar:
      return 6 + 6 * end.index;
    case RiggingEnd::Kind::fixed:
    case RiggingEnd::Kind::load:
      break;
  }
  return 0;
}

/// Displacement of a rope's end by x, 3 x size.
MatrixXd RiggingBalance::displacement_of(const RiggingEnd& end) const {
  MatrixXd d = MatrixXd::Zero(3, elongation_.cols());
  const Eigen::Index first = first_of(end);
  switch (end.kind) {
    case RiggingEnd::Kind::fixed:
      break;
    case RiggingEnd::Kind::hook:
      d.middleCols<3>(first).setIdentity();
      break;
    case RiggingEnd::Kind::load:
    case RiggingEnd::Kind::bar:
      d.middleCols<3>(first) = -cross_matrix(end.r_W);
      d.middleCols<3>(first + 3).setIdentity();
      break;
  }
  return d;
}

void RiggingBalance::add_rope(std::size_t rope) {
  const RiggingRope& r = ropes_[rope];
  const auto row = static_cast<Eigen::Index>(rope);
  const MatrixXd apart = displacement_of(r.upper) - displacement_of(r.lower);
  const Vector3d& u = r.direction_W;
  elongation_.row(row) = u.transpose() * apart;
  compliance_(row, row) += r.compliance;
  tension_[row] = r.tension;
  MatrixXd turning =
      r.tension / r.length * apart.transpose() * (Matrix3d::Identity() - u * u.transpose()) * apart;
  add_arm(r.lower, first_of(r.lower), u, r.tension, turning);
  add_arm(r.upper, first_of(r.upper), -u, r.tension, turning);
  turning_.push_back(std::move(turning));
}

Eigen::VectorXd RiggingBalance::solve(const VectorXd& errors, const VectorXd& force) const {
  MatrixXd turning = MatrixXd::Zero(elongation_.cols(), elongation_.cols());
  for (const MatrixXd& one : turning_) turning += one;
  std::vector<Eigen::Index> taut;
  VectorXd slackened = force;  // what ropes that are taken off no longer hold
  VectorXd apart = errors;     // with what load and frames spring back by where they held
  for (Eigen::Index i = 0; i < tension_.size(); ++i)
    if (tension_[i] > 0) taut.push_back(i);
  VectorXd result = VectorXd::Zero(tension_.size());
  while (!taut.empty()) {
    const MatrixXd B = elongation_(taut, Eigen::all);
    const MatrixXd stiffness_of_ropes =
        algebra::inverse_of<Eigen::Dynamic>(compliance_(taut, taut));
    const VectorXd e = apart(taut);
    MatrixXd K = B.transpose() * stiffness_of_ropes * B + turning;
    // A load on one rope turns freely about it and stays where it is. Where the rope leans in wind,
    // what holds that turn is so little, and may push it on, that a moment of no matter would turn
    // the load far.
    constexpr Eigen::Index about_the_plumb = 2;
    if (turns_freely_) K(about_the_plumb, about_the_plumb) += K.diagonal().maxCoeff();
    // What else is free has a stiffness of nil but for rounding, some 1e-13 of the ropes'; that of
    // a pendulum is 1e-5 of it.
    constexpr double nil = 1e-10;
    const VectorXd x = algebra::least_squares_by_pivots(
        K, slackened + B.transpose() * stiffness_of_ropes * e, nil);
    const VectorXd tension = tension_(taut) + stiffness_of_ropes * (B * x - e);
    Eigen::Index lowest = 0;
    if (tension.minCoeff(&lowest) >= 0) {
      for (std::size_t i = 0; i < taut.size(); ++i) result[taut[i]] = tension[i];
      return result;
    }
    const Eigen::Index off = taut[lowest];
    slackened += elongation_.row(off).transpose() * tension_[off];
    apart -= compliance_.col(off) * tension_[off];
    turning -= turning_[off];
    taut.erase(taut.begin() + lowest);
  }
  return result;
}

Eigen::VectorXd RiggingBalance::with_length_errors(const VectorXd& errors) const {
  return solve(errors, VectorXd::Zero(elongation_.cols()));
}

Eigen::VectorXd RiggingBalance::with_moment(const Vector3d& moment_W) const {
  VectorXd force = VectorXd::Zero(elongation_.cols());
  force.head<3>() = moment_W;
  return solve(VectorXd::Zero(tension_.size()), force);
}

void RiggingBalance::visit_sets(const VectorXd& tolerance,
                                const std::function<void(const VectorXd&)>& visit) const {
  std::vector<Eigen::Index> inexact;
  for (Eigen::Index i = 0; i < tolerance.size(); ++i)
    if (tolerance[i] > 0) inexact.push_back(i);
  if (inexact.size() > most_toleranced)
    throw std::invalid_argument("too many ropes for every set of their tolerances");
  for (unsigned set = 0; set < 1U << inexact.size(); ++set) {
    VectorXd errors = VectorXd::Zero(tolerance.size());
    for (std::size_t i = 0; i < inexact.size(); ++i)
      errors[inexact[i]] = (set >> i & 1U) != 0 ? tolerance[inexact[i]] : -tolerance[inexact[i]];
    visit(with_length_errors(errors));
  }
}

Eigen::VectorXd RiggingBalance::largest_by_tolerance(const VectorXd& tolerance) const {
  VectorXd largest = tension_;
  visit_sets(tolerance, [&](const VectorXd& tension) { largest = largest.cwiseMax(tension); });
  return largest;
}

}  // namespace blocklift::pipeline

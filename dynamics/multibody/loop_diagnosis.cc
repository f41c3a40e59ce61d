#include "dynamics/multibody/loop_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "algebra/decompositions.h"
#include "dynamics/multibody/loop_projection.h"

namespace blocklift::dynamics {
namespace {

using Redundancy = LoopDiagnosis::Redundancy;

// How far beside a position its neighbourhood is looked at: m, rad. What a toggle position lacks is
// of this order there.
constexpr double beside = 1e-3;

/// Independent rows found one after another.
class RowSieve {
 public:
  RowSieve(const Mechanism& mechanism, const Eigen::MatrixXd& jacobian) {
    const std::vector<int>& free = mechanism.free_velocities();
    rows_.resize(free.size(), jacobian.rows());
    Eigen::Index i = 0;
    for (const int k : free) rows_.row(i++) = jacobian.col(k).transpose();
    lengths_ = rows_.colwise().norm().transpose();
    double longest[2] = {0.0, 0.0};
    for (int row = 0; row < rows_.cols(); ++row) {
      double& most = longest[mechanism.loop_row_is_angle(row) ? 1 : 0];
      most = std::max(most, lengths_[row]);
    }
    for (int row = 0; row < rows_.cols(); ++row) {
      if (!(lengths_[row] > 1e-11 * longest[mechanism.loop_row_is_angle(row) ? 1 : 0])) {
        lengths_[row] = 0.0;
      }
    }
    for (int row = 0; row < rows_.cols(); ++row) sieve(row);
  }

  const std::vector<int>& independent() const { return independent_; }
  const std::vector<Redundancy>& redundant() const { return redundant_; }

 private:
  void sieve(int row) {
    if (lengths_[row] == 0.0) {
      redundant_.push_back({row, {}});
      return;
    }
    Eigen::MatrixXd before(rows_.rows(), static_cast<Eigen::Index>(independent_.size()));
    Eigen::Index i = 0;
    for (const int k : independent_) before.col(i++) = rows_.col(k) / lengths_[k];
    const Eigen::VectorXd now = rows_.col(row) / lengths_[row];
    Eigen::VectorXd factors(before.cols());
    Eigen::VectorXd rest = now;
    if (before.cols() > 0) {
      factors = algebra::least_squares(before, now);
      rest -= before * factors;
    }
    if (rest.norm() > redundancy_threshold) {
      independent_.push_back(row);
      return;
    }
    Redundancy found{row, {}};
    for (std::size_t k = 0; k < independent_.size(); ++k) {
      const double factor = factors[k];
      if (std::abs(factor) < 1e-6) continue;
      const int other = independent_[k];
      found.repeats.push_back({other, factor * lengths_[row] / lengths_[other]});
    }
    redundant_.push_back(found);
  }

  Eigen::MatrixXd rows_;  ///< transposed, free velocities only
  Eigen::VectorXd lengths_;
  std::vector<int> independent_;
  std::vector<Redundancy> redundant_;
};

// A configuration on the constraint beside q; q itself where nothing can move.
Eigen::VectorXd neighbour(const Mechanism& mechanism, ConstVectorRef q, LoopProjector& projector) {
  std::mt19937 engine(7);
  Eigen::VectorXd move(mechanism.nv());
  for (Eigen::Index k = 0; k < move.size(); ++k) {
    move[k] = static_cast<double>(engine()) / static_cast<double>(std::mt19937::max()) - 0.5;
  }
  projector.look(q);
  projector.remove_normal_part(move);
  if (!(move.norm() > 1e-6)) return q;
  Eigen::VectorXd result(q.size());
  mechanism.integrate(q, move / move.norm(), beside, result);
  if (!projector.project_positions(result)) return q;
  return result;
}

// Rows that no free velocity can satisfy, times the driven velocities' columns.
std::vector<LoopDiagnosis::Conflict> find_conflicts(const Mechanism& mechanism,
                                                    const Eigen::MatrixXd& jacobian) {
  const std::vector<int>& free = mechanism.free_velocities();
  const std::vector<int>& driven = mechanism.driven_velocities();
  if (driven.empty() || jacobian.rows() == 0) return {};
  Eigen::MatrixXd G_free(jacobian.rows(), static_cast<Eigen::Index>(free.size()));
  Eigen::MatrixXd G_driven(jacobian.rows(), static_cast<Eigen::Index>(driven.size()));
  Eigen::Index i = 0;
  for (const int k : free) G_free.col(i++) = jacobian.col(k);
  i = 0;
  for (const int k : driven) G_driven.col(i++) = jacobian.col(k);
  Eigen::MatrixXd left_null = Eigen::MatrixXd::Identity(jacobian.rows(), jacobian.rows());
  if (!free.empty()) {
    left_null = algebra::left_null_space(G_free, redundancy_threshold);
  }
  const Eigen::MatrixXd demand = left_null.transpose() * G_driven;
  if (demand.rows() == 0) return {};
  const double tolerance = 1e-7 * std::max(1e-300, G_driven.lpNorm<Eigen::Infinity>());
  LoopDiagnosis::Conflict conflict;
  std::vector<Eigen::Index> columns;
  for (Eigen::Index k = 0; k < demand.cols(); ++k) {
    if (demand.col(k).norm() <= tolerance) continue;
    columns.push_back(k);
    conflict.velocities.push_back(driven[k]);
  }
  if (columns.empty()) return {};
  const Eigen::MatrixXd demanded = demand(Eigen::all, columns);
  conflict.none_can_move = algebra::numerical_rank(demanded, 1e-7) == demanded.cols();
  const Eigen::MatrixXd unsatisfied = left_null * demanded;
  for (int row = 0; row < unsatisfied.rows(); ++row) {
    if (unsatisfied.row(row).norm() > tolerance) conflict.rows.push_back(row);
  }
  return {conflict};
}

std::string list(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
  }
  return text;
}

std::string row_list(const Mechanism& mechanism, const std::vector<int>& rows) {
  std::vector<std::string> names;
  for (const int row : rows) names.push_back(mechanism.loop_row_name(row));
  return list(names);
}

}  // namespace

LoopDiagnosis diagnose_loops(const Mechanism& mechanism, ConstVectorRef q) {
  LoopDiagnosis result;
  result.row_count = mechanism.loop_row_count();
  LoopProjector projector(mechanism);
  projector.look(q);
  const RowSieve here(mechanism, projector.jacobian());
  result.conflicts = find_conflicts(mechanism, projector.jacobian());
  projector.look(neighbour(mechanism, q, projector));
  const RowSieve general(mechanism, projector.jacobian());
  result.rank = static_cast<int>(general.independent().size());
  result.degrees_of_freedom = static_cast<int>(mechanism.free_velocities().size()) - result.rank;
  result.redundant = general.redundant();
  for (const int row : general.independent()) {
    const auto& kept = here.independent();
    if (std::find(kept.begin(), kept.end(), row) == kept.end()) result.toggled.push_back(row);
  }
  // Beside the position another row of the same dependence may be the one that is kept.
  const auto lost =
      static_cast<std::size_t>(std::max<long>(0, static_cast<long>(general.independent().size()) -
                                                     static_cast<long>(here.independent().size())));
  if (lost == 0) result.toggled.clear();
  return result;
}

std::vector<std::string> LoopDiagnosis::sentences(const Mechanism& mechanism) const {
  std::vector<std::string> result;
  for (const Redundancy& found : redundant) {
    std::string text = mechanism.loop_row_name(found.row);
    if (found.repeats.empty()) {
      text += ", repeats what the joints of the tree hold already";
    } else {
      std::vector<int> others;
      for (const Redundancy::Part& part : found.repeats) others.push_back(part.row);
      text += ", repeats " + row_list(mechanism, others);
    }
    result.push_back(text);
  }
  for (const std::string& sentence : toggle_sentences(mechanism)) result.push_back(sentence);
  for (const std::string& sentence : conflict_sentences(mechanism)) result.push_back(sentence);
  return result;
}

std::vector<std::string> LoopDiagnosis::toggle_sentences(const Mechanism& mechanism) const {
  if (toggled.empty()) return {};
  return {"this is a toggle position: " + row_list(mechanism, toggled) +
          " holds nothing here that other equations do not, and the mechanism may leave it in more "
          "than one way"};
}

std::vector<std::string> LoopDiagnosis::conflict_sentences(const Mechanism& mechanism) const {
  std::vector<std::string> result;
  for (const Conflict& conflict : conflicts) {
    std::vector<std::string> names;
    for (const int k : conflict.velocities) names.push_back(mechanism.velocity_name(k));
    const bool one = names.size() == 1;
    result.push_back(std::string(one ? "the driven joint " : "the driven joints ") + list(names) +
                     (conflict.none_can_move ? " cannot move: "
                                             : " can move only together, in one proportion: ") +
                     row_list(mechanism, conflict.rows) +
                     (conflict.rows.size() == 1 ? " forbids it" : " forbid it") +
                     "; free a joint, or drive one that the loops leave free");
  }
  return result;
}

}  // namespace blocklift::dynamics

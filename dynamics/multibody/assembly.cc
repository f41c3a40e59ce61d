#include "dynamics/multibody/assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <sstream>

#include "algebra/decompositions.h"
#include "dynamics/errors.h"
#include "dynamics/multibody/loop_diagnosis.h"
#include "dynamics/multibody/loop_projection.h"

namespace blocklift::dynamics {
namespace {

// Residual (m, rad) from which Newton's method finishes.
constexpr double nearly_closed = 1e-9;

/// One assembly from a start.
class Assembler {
 public:
  Assembler(const Mechanism& mechanism, ConstVectorRef q_start, const AssemblySettings& settings)
      : mechanism_(mechanism),
        settings_(settings),
        start_(q_start),
        projector_(mechanism, settings.weights),
        weights_(settings.weights.size() > 0 ? settings.weights
                                             : Eigen::VectorXd::Ones(mechanism.nv())),
        wanted_(Eigen::VectorXd::Ones(mechanism.loop_row_count())) {}

  Eigen::VectorXd run() {
    std::optional<Eigen::VectorXd> best = attempt(start_);
    if (best) return *best;
    const Eigen::VectorXd nearest = last_;
    std::mt19937 engine(1);
    const double size = extent();
    for (int i = 0; i < settings_.attempts; ++i) {
      // Four starts at each distance, then twice as far; the first distance that succeeds counts.
      const double reach = 0.2 * std::pow(2.0, i / 4);
      if (best && i % 4 == 0) return *best;
      const std::optional<Eigen::VectorXd> found = attempt(shaken(engine, reach, size));
      if (found && (!best || distance(*found) < distance(*best))) best = found;
    }
    if (best) return *best;
    fail(nearest);
  }

 private:
  static double uniform(std::mt19937& engine) {
    return 2.0 * static_cast<double>(engine()) / static_cast<double>(std::mt19937::max()) - 1.0;
  }

  Eigen::VectorXd shaken(std::mt19937& engine, double reach, double size) const {
    Eigen::VectorXd move = Eigen::VectorXd::Zero(mechanism_.nv());
    for (const int k : mechanism_.free_velocities()) {
      const bool turns = mechanism_.angular()[k] != 0;
      move[k] = reach * (turns ? 1.0 : size) * uniform(engine);
    }
    Eigen::VectorXd q(mechanism_.nq());
    mechanism_.integrate(start_, move, 1.0, q);
    return q;
  }

  // How far bodies lie apart, m.
  double extent() {
    projector_.look(start_);
    double result = 0.0;
    for (const Pose& X : projector_.kinematics().X_WB) result = std::max(result, X.p.norm());
    return result > 0.0 ? result : 1.0;
  }

  // Weighted length of the way from the start.
  double distance(ConstVectorRef q) const { return norm(way(q, start_)); }
  double norm(const Eigen::VectorXd& move) const {
    return std::sqrt(move.cwiseAbs2().dot(weights_));
  }

  Eigen::VectorXd way(ConstVectorRef from, ConstVectorRef to) const {
    Eigen::VectorXd result(mechanism_.nv());
    mechanism_.difference(from, to, result);
    for (const int k : mechanism_.driven_velocities()) result[k] = 0.0;
    return result;
  }

  std::optional<Eigen::VectorXd> attempt(const Eigen::VectorXd& q_first) {
    Eigen::VectorXd q = q_first;
    if (!descend(q)) return std::nullopt;
    if (!projector_.project_positions(q)) return std::nullopt;
    approach_start(q);
    return q;
  }

  // Residual of the rows that are wanted, all else left in the projector.
  Eigen::VectorXd residual(const Eigen::VectorXd& q) {
    projector_.look(q);
    return projector_.state().residual.cwiseProduct(wanted_);
  }

  // delta = -W^-1 G^T (G W^-1 G^T + mu)^-1 g.
  Eigen::VectorXd step(const Eigen::VectorXd& g, double mu) {
    Eigen::MatrixXd G = wanted_.asDiagonal() * projector_.jacobian();
    for (const int k : mechanism_.driven_velocities()) G.col(k).setZero();
    const Eigen::MatrixXd GW = G * weights_.cwiseInverse().asDiagonal();
    Eigen::MatrixXd A = GW * G.transpose();
    const double scale = std::max(A.diagonal().maxCoeff(), 1e-300);
    A.diagonal().array() += mu * scale;
    return -GW.transpose() * algebra::solve_symmetric(A, g);
  }

  // Levenberg and Marquardt; true when nearly closed. Leaves q in last_.
  bool descend(Eigen::VectorXd& q) {
    double mu = 1e-3;
    Eigen::VectorXd g = residual(q);
    Eigen::VectorXd moved(q.size());
    for (int i = 0; i < settings_.largest_iterations && g.lpNorm<Eigen::Infinity>() > nearly_closed;
         ++i) {
      const Eigen::VectorXd delta = step(g, mu);
      // No coordinate moves by more than half a radian (metre, for mechanisms of that size) at
      // once.
      const double most = delta.lpNorm<Eigen::Infinity>();
      mechanism_.integrate(q, delta, most > 0.5 ? 0.5 / most : 1.0, moved);
      const Eigen::VectorXd g_moved = residual(moved);
      const bool better = g_moved.norm() < g.norm();
      if (better) {
        q = moved;
        g = g_moved;
        mu = std::max(0.2 * mu, 1e-15);
      } else {
        residual(q);
        mu *= 5.0;
      }
      if (mu > 1e8 || most < 1e-14) break;
    }
    last_ = q;
    return g.lpNorm<Eigen::Infinity>() <= nearly_closed;
  }

  // Along the constraint towards the start as long as that brings it nearer.
  void approach_start(Eigen::VectorXd& q) {
    double length = 1.0;
    for (int i = 0; i < settings_.largest_iterations && length > 1e-3; ++i) {
      Eigen::VectorXd tangent = way(q, start_);
      projector_.remove_normal_part(tangent);
      if (norm(tangent) < 1e-9) return;
      Eigen::VectorXd moved(q.size());
      mechanism_.integrate(q, tangent, length, moved);
      if (projector_.project_positions(moved) && distance(moved) < distance(q)) {
        q = moved;
        length = std::min(1.0, 1.5 * length);
        continue;
      }
      length *= 0.5;
      projector_.look(q);
    }
  }

  // Loops without which the others close, with what they miss by then.
  std::string without_each() {
    std::string result;
    if (mechanism_.loops().size() < 2) return result;
    for (const Loop& loop : mechanism_.loops()) {
      wanted_.setOnes();
      wanted_.segment(loop.row_offset, loop.row_count).setZero();
      Eigen::VectorXd q = start_;
      if (!descend(q)) continue;
      projector_.look(q);
      result += "; without loop \"" + loop.name + "\" the others close, and it misses: " +
                describe_residual(mechanism_, projector_.state().residual, 1e-6);
    }
    return result;
  }

  [[noreturn]] void fail(const Eigen::VectorXd& nearest) {
    projector_.look(nearest);
    const Eigen::VectorXd missing = projector_.state().residual;
    std::string text = "the loops cannot be closed from this start; at the nearest they miss: " +
                       describe_residual(mechanism_, missing, 1e-6) + without_each() +
                       "; check lengths and places of the loops' frames, or start nearer to a "
                       "configuration that closes them";
    if (!mechanism_.driven_velocities().empty()) text += " (driven joints are held where they are)";
    throw SimulationError(text);
  }

  const Mechanism& mechanism_;
  const AssemblySettings& settings_;
  const Eigen::VectorXd start_;
  LoopProjector projector_;
  Eigen::VectorXd weights_;
  Eigen::VectorXd wanted_;  ///< 1 for each row that is to be closed, 0 for others
  Eigen::VectorXd last_;
};

}  // namespace

std::string describe_residual(const Mechanism& mechanism, ConstVectorRef residual,
                              double tolerance) {
  std::ostringstream text;
  for (const Loop& loop : mechanism.loops()) {
    double lengths = 0.0, angles = 0.0;
    for (int i = 0; i < loop.row_count; ++i) {
      const double value = residual[loop.row_offset + i];
      (loop.row_is_angle(i) ? angles : lengths) += value * value;
    }
    lengths = std::sqrt(lengths);
    angles = std::sqrt(angles);
    if (!(lengths > tolerance || angles > tolerance)) continue;
    text << (text.tellp() > 0 ? ", " : "") << "loop \"" << loop.name << "\" by ";
    if (lengths > tolerance) text << lengths << " m";
    if (lengths > tolerance && angles > tolerance) text << " and ";
    if (angles > tolerance) text << angles << " rad";
  }
  return text.tellp() > 0 ? text.str() : "none";
}

void assemble(const Mechanism& mechanism, VectorRef q, const AssemblySettings& settings) {
  mechanism.normalise(q);
  if (mechanism.loops().empty()) return;
  q = Assembler(mechanism, q, settings).run();
}

void assemble(const Mechanism& mechanism, VectorRef q, VectorRef v,
              const AssemblySettings& settings) {
  assemble(mechanism, q, settings);
  if (mechanism.loops().empty()) return;
  LoopProjector projector(mechanism, settings.weights);
  projector.look(q);
  if (projector.project_velocities(v)) return;
  std::string text = "the loops forbid the driven joints' motion";
  for (const std::string& sentence : diagnose_loops(mechanism, q).conflict_sentences(mechanism)) {
    text += "; " + sentence;
  }
  throw SimulationError(text);
}

}  // namespace blocklift::dynamics

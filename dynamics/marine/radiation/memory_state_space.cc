#include "dynamics/marine/radiation/memory_state_space.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <utility>

#include "dynamics/algebra/dense_algebra.h"
#include "dynamics/errors.h"
#include "dynamics/marine/radiation/block_hankel.h"
#include "parallel/blas_threads.h"
#include "parallel/threads.h"

namespace blocklift::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Modes weaker than this share of the strongest of their kind are not measured by their own peak.
constexpr double least_share = 1e-3;

/// Retardation functions with each mode divided by the root of its peak.
struct ScaledSamples {
  std::vector<MatrixXd> K;
  VectorXd scale;  ///< root of the peak of K_ii, or of the least share of the strongest
  double step;     ///< s
};

ScaledSamples scale_samples(const HydrodynamicDatabase& database) {
  ScaledSamples samples;
  samples.step = database.time_step;
  const Eigen::Index modes = database.retardation[0].rows();
  VectorXd peak = VectorXd::Zero(modes);
  for (const MatrixXd& K : database.retardation) peak = peak.cwiseMax(K.diagonal().cwiseAbs());
  // A mode that makes next to no waves (the yaw of a round body) is measured by the strongest mode
  // of its kind: its memory is felt by nobody, and may be mere noise of the panels.
  samples.scale.resize(modes);
  for (Eigen::Index i = 0; i < modes; ++i) {
    double strongest = 0.0;
    for (Eigen::Index j = 0; j < modes; ++j) {
      const bool same_kind = (i % modes_per_body < 3) == (j % modes_per_body < 3);
      if (same_kind) strongest = std::max(strongest, peak[j]);
    }
    samples.scale[i] = std::sqrt(std::max(peak[i], least_share * strongest));
  }
  const VectorXd inverse = (samples.scale.array() > 0.0).select(samples.scale.cwiseInverse(), 0.0);
  for (const MatrixXd& K : database.retardation) {
    samples.K.push_back(inverse.asDiagonal() * K * inverse.asDiagonal());
  }
  return samples;
}

/// Takes exp(A t) B from sample to sample. A is block-diagonal: its exponential over a step goes by
/// blocks of one or two rows, [c, s; -s, c].
class Stepping {
 public:
  Stepping(const MatrixXd& A, double step) : c_(A.rows()), s_(VectorXd::Zero(A.rows())) {
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const double decay = std::exp(A(i, i) * step);
      const bool pair = i + 1 < A.rows() && A(i, i + 1) != 0.0;
      const double angle = pair ? A(i, i + 1) * step : 0.0;
      c_[i] = decay * std::cos(angle);
      if (!pair) continue;
      s_[i] = decay * std::sin(angle);
      c_[i + 1] = c_[i];
      ++i;
    }
  }

  void advance(MatrixXd& state) {
    before_ = state;
    state.noalias() = c_.asDiagonal() * before_;
    for (Eigen::Index i = 0; i < s_.size(); ++i) {
      if (s_[i] == 0.0) continue;
      state.row(i) += s_[i] * before_.row(i + 1);
      state.row(i + 1) -= s_[i] * before_.row(i);
      ++i;
    }
  }

 private:
  VectorXd c_, s_;
  MatrixXd before_;
};

/// Largest difference between the samples and C exp(A t) B, stepping through the samples.
double largest_error(const ScaledSamples& samples, const MatrixXd& A, const MatrixXd& B,
                     const MatrixXd& C) {
  const parallel::OneBlasThread for_many_small_products;
  Stepping stepping(A, samples.step);
  double error = 0.0;
  MatrixXd state = B, difference;
  for (const MatrixXd& K : samples.K) {
    difference = K;
    if (state.rows() > 0) multiply(-1.0, C, state, 1.0, difference);
    error = std::max(error, difference.cwiseAbs().maxCoeff());
    stepping.advance(state);
  }
  return error;
}

}  // namespace

namespace {

/// Coupling of two modes, over their peaks, that counts as none.
constexpr double no_coupling = 1e-3;

/// Bodies that feel or make anything.
std::vector<Eigen::Index> moving_bodies(const std::vector<MatrixXd>& K) {
  std::vector<Eigen::Index> bodies;
  for (Eigen::Index first = 0; first < K[0].rows(); first += modes_per_body) {
    const Eigen::Index count = std::min<Eigen::Index>(modes_per_body, K[0].rows() - first);
    const bool moves = std::any_of(K.begin(), K.end(), [&](const MatrixXd& k) {
      return !k.middleRows(first, count).isZero(0.0);
    });
    if (moves) bodies.push_back(first / modes_per_body);
  }
  return bodies;
}

/// Columns (u_1 + S u_2)/sqrt 2 and (u_1 - S u_2)/sqrt 2 of two bodies, the only ones that move,
/// that are each other's mirror image in a plane x or y = constant, or turned by half a turn, S
/// being the signs that their modes take by it: what both do alike does not couple with what they
/// do against each other. Else the identity.
MatrixXd pair_mirrored_bodies(const std::vector<MatrixXd>& K) {
  const Eigen::Index n = modes_per_body;
  MatrixXd pairs = MatrixXd::Identity(K[0].rows(), K[0].rows());
  const std::vector<Eigen::Index> bodies = moving_bodies(K);
  if (bodies.size() != 2) return pairs;
  const Eigen::Index a = n * bodies[0], b = n * bodies[1];
  using Signs = Eigen::Matrix<double, modes_per_body, 1>;
  const Signs in_x{-1, 1, 1, 1, -1, -1}, in_y{1, -1, 1, -1, 1, -1};
  for (const Signs& signs : {in_x, in_y, Signs(in_x.cwiseProduct(in_y))}) {
    const auto S = signs.asDiagonal();
    const bool mirrored = std::all_of(K.begin(), K.end(), [&](const MatrixXd& k) {
      const MatrixXd own = k.block(a, a, n, n) - S * k.block(b, b, n, n) * S;
      const MatrixXd other = k.block(a, b, n, n) - S * k.block(b, a, n, n) * S;
      return own.cwiseAbs().maxCoeff() < no_coupling && other.cwiseAbs().maxCoeff() < no_coupling;
    });
    if (!mirrored) continue;
    const MatrixXd one = MatrixXd::Identity(n, n) / std::sqrt(2.0), image = S * one;
    pairs.block(a, a, n, n) = pairs.block(a, b, n, n) = one;
    pairs.block(b, a, n, n) = image;
    pairs.block(b, b, n, n) = -image;
    break;
  }
  return pairs;
}

/// Orthonormal combinations of modes in groups that do not couple: a matrix (modes x members) for
/// each.
std::vector<MatrixXd> find_groups(const std::vector<MatrixXd>& K) {
  const MatrixXd pairs = pair_mirrored_bodies(K);
  const Eigen::Index modes = pairs.rows();
  MatrixXd coupling = MatrixXd::Zero(modes, modes);
  for (const MatrixXd& k : K) {
    coupling = coupling.cwiseMax((pairs.transpose() * k * pairs).cwiseAbs());
  }
  std::vector<Eigen::Index> group(static_cast<std::size_t>(modes), -1);
  std::vector<MatrixXd> groups;
  for (Eigen::Index first = 0; first < modes; ++first) {
    if (group[first] >= 0) continue;
    std::vector<Eigen::Index> members = {first};
    group[first] = first;
    for (std::size_t next = 0; next < members.size(); ++next) {
      for (Eigen::Index other = 0; other < modes; ++other) {
        Eigen::Index& of_other = group[other];
        if (of_other >= 0 || coupling(members[next], other) < no_coupling) continue;
        of_other = first;
        members.push_back(other);
      }
    }
    groups.emplace_back(pairs(Eigen::all, members));
  }
  return groups;
}

/// x' = A x + B v, F = C x; A block-diagonal.
struct System {
  MatrixXd A, B, C;
};

/// Balanced discrete-time system of the leading states, all that the Hankel matrix gives.
struct Realisation {
  MatrixXd advance;  ///< V^T H1 V, before scaling
  MatrixXd vectors;  ///< leading eigenvectors, columns by falling size of their eigenvalues
  VectorXd values;   ///< eigenvalues
  Eigen::Index modes = 0;
  double step = 0.0;  ///< s
};

Realisation realise(const std::vector<MatrixXd>& K, double time_step, int most_states) {
  // K is taken as zero behind its end: with all of it in the matrix the leading states of a finite
  // response form a stable system, however few are taken (Kung 1978).
  const BlockHankel hankel(K);
  LeadingEigenpairs leading = find_leading_eigenpairs(hankel, most_states);
  // States that rounding alone makes are none.
  Eigen::Index states = leading.values.size();
  while (!(std::abs(leading.values[states - 1]) > 1e-13 * std::abs(leading.values[0]))) --states;
  Realisation realisation;
  realisation.modes = K[0].rows();
  realisation.step = time_step;
  realisation.vectors = leading.vectors.leftCols(states);
  realisation.values = leading.values.head(states);
  const MatrixXd shifted = hankel.multiply(realisation.vectors, 1);
  realisation.advance = MatrixXd(states, states);
  multiply(1.0, realisation.vectors.transpose(), shifted, 0.0, realisation.advance);
  return realisation;
}

/// Continuous-time system of the leading states in real modal form.
System take_modal_form(const Realisation& realisation, Eigen::Index states) {
  const Eigen::Index modes = realisation.modes;
  // H0 = V D V^T = (V |D|^1/2) (sign |D|^1/2 V^T): observability times controllability.
  const VectorXd root = realisation.values.head(states).cwiseAbs().cwiseSqrt();
  const VectorXd sign = realisation.values.head(states).array().sign();
  const VectorXd inverse = root.cwiseInverse();
  const MatrixXd discrete = inverse.asDiagonal() *
                            realisation.advance.topLeftCorner(states, states) *
                            (inverse.array() * sign.array()).matrix().asDiagonal();
  const MatrixXd first = realisation.vectors.topLeftCorner(modes, states);
  const MatrixXd output = first * root.asDiagonal();
  const MatrixXd input = (sign.array() * root.array()).matrix().asDiagonal() * first.transpose();

  Eigensystem eigen = decompose_general(discrete);
  const MatrixXcd modal_output = output.cast<Complex>() * eigen.vectors;
  MatrixXcd modal_input = input.cast<Complex>();
  try {
    solve_in_place(eigen.vectors, modal_input, "the matrix of the modes");
  } catch (const SimulationError&) {
    // Modes that coincide: another number of states has modes of its own.
    return {{}, MatrixXd::Zero(0, modes), MatrixXd::Zero(modes, 0)};
  }
  std::vector<Eigen::Index> kept;
  Eigen::Index size = 0;
  for (Eigen::Index k = 0; k < states; ++k) {
    const Complex pole = eigen.values[k];
    // One of each pair; poles that grow, or on the negative axis, belong to noise.
    if (pole.imag() < 0.0 || std::abs(pole) >= 1.0 || std::abs(pole) < 1e-8) continue;
    if (pole.imag() == 0.0 && pole.real() <= 0.0) continue;
    kept.push_back(k);
    size += pole.imag() > 0.0 ? 2 : 1;
  }
  System system{MatrixXd::Zero(size, size), MatrixXd::Zero(size, modes),
                MatrixXd::Zero(modes, size)};
  Eigen::Index row = 0;
  for (const Eigen::Index k : kept) {
    const Complex rate = std::log(eigen.values[k]) / realisation.step;
    if (rate.imag() == 0.0) {
      system.A(row, row) = rate.real();
      system.B.row(row) = modal_input.row(k).real();
      system.C.col(row) = modal_output.col(k).real();
      ++row;
      continue;
    }
    // c z + conj(c z) with z' = rate z + b v, z = x1 - i x2... in real numbers: x = (Re z, -Im z).
    system.A.block<2, 2>(row, row) << rate.real(), rate.imag(), -rate.imag(), rate.real();
    system.B.row(row) = modal_input.row(k).real();
    system.B.row(row + 1) = -modal_input.row(k).imag();
    system.C.col(row) = 2.0 * modal_output.col(k).real();
    system.C.col(row + 1) = 2.0 * modal_output.col(k).imag();
    row += 2;
  }
  return system;
}

/// Moore and Penrose's inverse of a symmetric matrix without negative eigenvalues.
MatrixXd symmetric_pseudo_inverse(MatrixXd matrix) {
  matrix = 0.5 * (matrix + matrix.transpose()).eval();
  VectorXd values = decompose_symmetric(matrix);
  const double limit = std::numeric_limits<double>::epsilon() * static_cast<double>(values.size()) *
                       values.cwiseAbs().maxCoeff();
  for (double& value : values) value = value > limit ? 1.0 / value : 0.0;
  return matrix * values.asDiagonal() * matrix.transpose();
}

/// The system with its output changed as little as can be, by the square of what K changes over the
/// samples, so that the integral of K is that of the samples: the damping of a steady velocity,
/// which drifts rest on, and which is nothing for bodies in open water. With G = (-A)^-1 B and P
/// the sum of exp(A t) B B^T exp(A^T t),
///   C + D,   D = (int K - C G) (G^T P^-1 G)^+ G^T P^-1.
System with_steady_state(const ScaledSamples& samples, System system) {
  const Eigen::Index states = system.A.rows();
  if (states == 0) return system;
  MatrixXd integral = -0.5 * (samples.K.front() + samples.K.back());
  for (const MatrixXd& K : samples.K) integral += K;
  integral *= samples.step;
  MatrixXd steady = system.B;
  LuFactorisation(-system.A, "the matrix of the states", "one of them neither grows nor decays")
      .solve_in_place(steady);
  Stepping stepping(system.A, samples.step);
  MatrixXd response = system.B, gramian = MatrixXd::Zero(states, states);
  for (std::size_t n = 0; n < samples.K.size(); ++n) {
    multiply(1.0, response, response.transpose(), 1.0, gramian);
    stepping.advance(response);
  }
  gramian.diagonal().array() += 1e-12 * gramian.trace() / static_cast<double>(states);
  MatrixXd weighted = steady;
  LuFactorisation(std::move(gramian), "the sum of the responses", "its diagonal is positive")
      .solve_in_place(weighted);
  system.C += (integral - system.C * steady) *
              symmetric_pseudo_inverse(steady.transpose() * weighted) * weighted.transpose();
  return system;
}

/// The least system that meets the tolerance; where none does, the best with its error.
System fit(const ScaledSamples& samples, double tolerance, int most_states) {
  const Eigen::Index modes = samples.K[0].rows();
  System best{{}, MatrixXd::Zero(0, modes), MatrixXd::Zero(modes, 0)};
  // What is hardly there needs no state.
  if (largest_error(samples, best.A, best.B, best.C) <= tolerance) return best;
  const Realisation realisation = realise(samples.K, samples.step, most_states);
  const Eigen::Index most = realisation.values.size();
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index states = 1; states <= most; states += std::max<Eigen::Index>(1, states / 8)) {
    System system = take_modal_form(realisation, states);
    const double error = largest_error(samples, system.A, system.B, system.C);
    if (error < least) {
      least = error;
      best = std::move(system);
    }
    if (least > tolerance) continue;
    System steady = with_steady_state(samples, best);
    if (largest_error(samples, steady.A, steady.B, steady.C) <= tolerance) return steady;
  }
  // A tenth more of an error that is beyond the tolerance already is the lesser evil.
  System steady = with_steady_state(samples, best);
  const bool near = largest_error(samples, steady.A, steady.B, steady.C) <= 1.1 * least;
  return near ? steady : best;
}

/// One more of the groups joins those before it, its modes given by `group`.
void append(System& all, const System& part, const MatrixXd& group) {
  const Eigen::Index before = all.A.rows(), size = part.A.rows();
  all.A.conservativeResizeLike(MatrixXd::Zero(before + size, before + size));
  all.A.bottomRightCorner(size, size) = part.A;
  all.B.conservativeResize(before + size, group.rows());
  all.B.bottomRows(size) = part.B * group.transpose();
  all.C.conservativeResize(group.rows(), before + size);
  all.C.rightCols(size) = group * part.C;
}

}  // namespace

MemoryStateSpace::MemoryStateSpace(const HydrodynamicDatabase& database, double tolerance,
                                   int most_states, double acceptable) {
  if (database.retardation.size() < 16) {
    throw ModelError(
        "a state space needs retardation functions at 16 instants at least; the "
        "database holds " +
        std::to_string(database.retardation.size()));
  }
  const ScaledSamples samples = scale_samples(database);
  System all;
  // Beside the small couplings between groups, which are left out.
  const double within = std::max(0.5 * tolerance, tolerance - no_coupling);
  for (const MatrixXd& group : find_groups(samples.K)) {
    ScaledSamples own{{}, {}, samples.step};
    for (const MatrixXd& K : samples.K) own.K.emplace_back(group.transpose() * K * group);
    append(all, fit(own, within, most_states), group);
  }
  error_ = largest_error(samples, all.A, all.B, all.C);
  if (!(error_ <= std::max(tolerance, acceptable)) || all.A.rows() > most_states) {
    throw ModelError(
        "no state space of up to " + std::to_string(most_states) + " states meets the tolerance " +
        std::to_string(std::max(tolerance, acceptable)) + " of the retardation functions; " +
        std::to_string(all.A.rows()) + " came to " + std::to_string(error_));
  }
  A_ = std::move(all.A);
  C_ = samples.scale.asDiagonal() * all.C;
  B_ = all.B * samples.scale.asDiagonal();
}

MemoryStateSpace::MemoryStateSpace(const VectorXd& decay, const VectorXd& turn, MatrixXd B,
                                   MatrixXd C, double error)
    : A_(decay.asDiagonal()), B_(std::move(B)), C_(std::move(C)), error_(error) {
  const Eigen::Index states = decay.size();
  const bool fits =
      turn.size() == states && B_.rows() == states && C_.cols() == states && B_.cols() == C_.rows();
  if (!fits) throw ModelError("a memory of the water whose matrices do not fit each other");
  const bool decays = (decay.array() < 0.0).all() && decay.allFinite() && turn.allFinite() &&
                      B_.allFinite() && C_.allFinite() && std::isfinite(error);
  if (!decays) throw ModelError("a memory of the water that does not decay, or is not finite");
  for (Eigen::Index i = 0; i < states; ++i) {
    if (turn[i] == 0.0) continue;
    if (i + 1 == states || turn[i + 1] != 0.0) {
      throw ModelError("a memory of the water whose pairs of states overlap");
    }
    A_(i, i + 1) = turn[i];
    A_(i + 1, i) = -turn[i];
    ++i;
  }
}

VectorXd MemoryStateSpace::turn() const {
  VectorXd turn = VectorXd::Zero(A_.rows());
  for (Eigen::Index i = 0; i + 1 < A_.rows(); ++i) {
    turn[i] = A_(i, i + 1);
    if (turn[i] != 0.0) ++i;
  }
  return turn;
}

MatrixXd MemoryStateSpace::calc_retardation(double time) const {
  MatrixXd state = B_;
  for (Eigen::Index i = 0; i < A_.rows(); ++i) {
    const double decay = std::exp(A_(i, i) * time);
    const bool pair = i + 1 < A_.rows() && A_(i, i + 1) != 0.0;
    if (!pair) {
      state.row(i) *= decay;
      continue;
    }
    const double c = decay * std::cos(A_(i, i + 1) * time);
    const double s = decay * std::sin(A_(i, i + 1) * time);
    const Eigen::RowVectorXd upper = c * state.row(i) + s * state.row(i + 1);
    state.row(i + 1) = (-s * state.row(i) + c * state.row(i + 1)).eval();
    state.row(i) = upper;
    ++i;
  }
  return C_ * state;
}

void MemoryStateSpace::calc_rate(const VectorXd& x, const VectorXd& v, VectorXd& rate) const {
  rate.noalias() = B_ * v;
  for (Eigen::Index i = 0; i < A_.rows(); ++i) {
    rate[i] += A_(i, i) * x[i];
    const bool pair = i + 1 < A_.rows() && A_(i, i + 1) != 0.0;
    if (!pair) continue;
    rate[i] += A_(i, i + 1) * x[i + 1];
    rate[i + 1] += A_(i + 1, i) * x[i] + A_(i + 1, i + 1) * x[i + 1];
    ++i;
  }
}

void MemoryStateSpace::calc_force(const VectorXd& x, VectorXd& force) const {
  force.noalias() = -(C_ * x);
}

namespace {

MemoryStateSpace fit_memory(const HydrodynamicDatabase& database, const MemoryFit& fit) {
  try {
    return MemoryStateSpace(database, fit.tolerance, fit.most_states, fit.acceptable_error);
  } catch (const ModelError&) {
    if (fit.most_loose_states == 0) throw;
    return MemoryStateSpace(database, fit.loose_tolerance, fit.most_loose_states);
  }
}

}  // namespace

std::vector<MemoryStateSpace> fit_memories(const std::vector<HydrodynamicDatabase>& databases,
                                           const MemoryFit& fit) {
  std::vector<std::optional<MemoryStateSpace>> fitted(databases.size());
  parallel::for_each(static_cast<int>(fitted.size()), 0, [&](int k) {
    const auto index = static_cast<std::size_t>(k);
    fitted[index].emplace(fit_memory(databases[index], fit));
  });
  std::vector<MemoryStateSpace> memories;
  for (auto& memory : fitted) memories.push_back(std::move(*memory));
  return memories;
}

}  // namespace blocklift::dynamics

#include "tests/verification/free_body_integration.h"

#include <ida/ida.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace blocklift::free_bodies {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using VectorMap = Eigen::Map<VectorXd>;
using ConstVectorMap = Eigen::Map<const VectorXd>;

Eigen::Quaterniond quaternion(const Vector4& Q) { return {Q[0], Q[1], Q[2], Q[3]}; }

/// Q (0, w).
Vector4 times_vector(const Vector4& Q, const Vector3& w) {
  const Eigen::Quaterniond product = quaternion(Q) * Eigen::Quaterniond(0, w.x(), w.y(), w.z());
  return {product.w(), product.x(), product.y(), product.z()};
}

/// The differential-algebraic system and the layout of its unknowns:
/// p (3n), Q (4n), v (3n), w (3n), lambda (m), mu (m), sigma (n).
class System {
 public:
  System(const dynamics::Mechanism& mechanism, std::vector<Row> rows)
      : gravity_(mechanism.gravity()), rows_(std::move(rows)) {
    for (int i = 1; i < mechanism.body_count(); ++i) {
      const auto& inertia = mechanism.body(i).inertia;
      masses_.push_back(inertia.mass);
      inertias_.push_back(inertia.I_BBcm.matrix());
    }
    n_ = static_cast<Index>(masses_.size());
    m_ = static_cast<Index>(rows_.size());
  }

  Index size() const { return 14 * n_ + 2 * m_; }
  Index differential_size() const { return 13 * n_; }

  State state(const ConstVectorMap& y) const {
    State state;
    for (Index i = 0; i < n_; ++i) {
      state.p_WBcm.emplace_back(y.segment<3>(3 * i));
      state.Q_WB.emplace_back(y.segment<4>(3 * n_ + 4 * i));
      state.v_WBcm.emplace_back(y.segment<3>(7 * n_ + 3 * i));
      state.w_WB_B.emplace_back(y.segment<3>(10 * n_ + 3 * i));
    }
    return state;
  }

  /// Unknowns at the start and their rates, the multipliers lambda from the accelerations.
  void set_start(const State& start, VectorMap y, VectorMap rates) const;
  void calc_residual(const ConstVectorMap& y, const ConstVectorMap& rates, VectorMap r) const;
  /// dF/dy + c dF/d(dy/dt), by central differences of increments that suit the unknowns' size of
  /// one.
  void calc_newton_matrix(const VectorXd& y, const VectorXd& rates, double c,
                          Eigen::Ref<Eigen::MatrixXd> jacobian) const;
  /// Absolute tolerances: those of the motion as given. Multipliers follow from the motion, one or
  /// two orders less accurate the smaller the step, and would stop Newton's method if they were
  /// held to it.
  void set_tolerances(double tolerance, VectorMap tolerances) const {
    tolerances.setConstant(tolerance);
    tolerances.segment(13 * n_, m_).setConstant(1e-2);
    tolerances.segment(13 * n_ + m_, m_ + n_).setConstant(1e-7);
  }

 private:
  /// G (v; w) as it will be a time s after `state`, positions moving on at their present rates.
  VectorXd velocity_residual_after(const State& state, double s) const;
  VectorXd velocities(const State& state) const {
    VectorXd u(6 * n_);
    for (Index i = 0; i < n_; ++i) {
      u.segment<3>(3 * i) = state.v_WBcm[i];
      u.segment<3>(3 * (n_ + i)) = state.w_WB_B[i];
    }
    return u;
  }

  Vector3 gravity_;
  std::vector<Row> rows_;
  std::vector<double> masses_;
  std::vector<Matrix3> inertias_;
  Index n_ = 0;
  Index m_ = 0;
};

VectorXd System::velocity_residual_after(const State& state, double s) const {
  State moved = state;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    moved.p_WBcm[i] += s * state.v_WBcm[i];
    moved.Q_WB[i] += 0.5 * s * times_vector(state.Q_WB[i], state.w_WB_B[i]);
  }
  return calc_jacobian(rows_, moved) * velocities(state);
}

void System::set_start(const State& start, VectorMap y, VectorMap rates) const {
  y.setZero();
  rates.setZero();
  Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(6 * n_ + m_, 6 * n_ + m_);
  VectorXd right(6 * n_ + m_);
  for (Index i = 0; i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector3& w = start.w_WB_B[k];
    y.segment<3>(3 * i) = start.p_WBcm[k];
    y.segment<4>(3 * n_ + 4 * i) = start.Q_WB[k];
    y.segment<3>(7 * n_ + 3 * i) = start.v_WBcm[k];
    y.segment<3>(10 * n_ + 3 * i) = w;
    rates.segment<3>(3 * i) = start.v_WBcm[k];
    rates.segment<4>(3 * n_ + 4 * i) = 0.5 * times_vector(start.Q_WB[k], w);
    kkt.block<3, 3>(3 * i, 3 * i) = masses_[k] * Matrix3::Identity();
    kkt.block<3, 3>(3 * (n_ + i), 3 * (n_ + i)) = inertias_[k];
    right.segment<3>(3 * i) = masses_[k] * gravity_;
    right.segment<3>(3 * (n_ + i)) = -w.cross(inertias_[k] * w);
  }
  const Eigen::MatrixXd jacobian = calc_jacobian(rows_, start);
  kkt.bottomLeftCorner(m_, 6 * n_) = jacobian;
  kkt.topRightCorner(6 * n_, m_) = -jacobian.transpose();
  constexpr double step = 1e-5;  // central difference: error of its square
  right.tail(m_) =
      -(velocity_residual_after(start, step) - velocity_residual_after(start, -step)) / (2 * step);
  const VectorXd solution = kkt.partialPivLu().solve(right);
  rates.segment(7 * n_, 6 * n_) = solution.head(6 * n_);
  y.segment(13 * n_, m_) = solution.tail(m_);
}

void System::calc_residual(const ConstVectorMap& y, const ConstVectorMap& rates,
                           VectorMap r) const {
  const State now = state(y);
  const Eigen::MatrixXd jacobian = calc_jacobian(rows_, now);
  const VectorXd force = jacobian.transpose() * y.segment(13 * n_, m_);
  const VectorXd correction = jacobian.transpose() * y.segment(13 * n_ + m_, m_);
  for (Index i = 0; i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector4& Q = now.Q_WB[k];
    const Vector3& w = now.w_WB_B[k];
    const Vector3 w_corrected = w + correction.segment<3>(3 * (n_ + i));
    r.segment<3>(3 * i) = rates.segment<3>(3 * i) - now.v_WBcm[k] - correction.segment<3>(3 * i);
    r.segment<4>(3 * n_ + 4 * i) = rates.segment<4>(3 * n_ + 4 * i) -
                                   0.5 * times_vector(Q, w_corrected) - y[13 * n_ + 2 * m_ + i] * Q;
    r.segment<3>(7 * n_ + 3 * i) =
        masses_[k] * (rates.segment<3>(7 * n_ + 3 * i) - gravity_) - force.segment<3>(3 * i);
    r.segment<3>(10 * n_ + 3 * i) = inertias_[k] * rates.segment<3>(10 * n_ + 3 * i) +
                                    w.cross(inertias_[k] * w) - force.segment<3>(3 * (n_ + i));
    r[13 * n_ + 2 * m_ + i] = Q.squaredNorm() - 1;
  }
  r.segment(13 * n_, m_) = jacobian * velocities(now);
  r.segment(13 * n_ + m_, m_) = free_bodies::calc_residual(rows_, now);
}

void System::calc_newton_matrix(const VectorXd& y, const VectorXd& rates, double c,
                                Eigen::Ref<Eigen::MatrixXd> jacobian) const {
  constexpr double increment = 1e-5;  // error of its square, and rounding of 1e-11
  VectorXd moved = y;
  VectorXd moved_rates = rates;
  VectorXd forward(size());
  VectorXd backward(size());
  const auto residual = [&](VectorXd& r) {
    calc_residual({moved.data(), size()}, {moved_rates.data(), size()}, {r.data(), size()});
  };
  for (Index j = 0; j < size(); ++j) {
    for (const double sign : {1.0, -1.0}) {
      moved[j] = y[j] + sign * increment;
      // The residual is linear in the rates: their part comes out exactly.
      moved_rates[j] = rates[j] + sign * increment * c;
      residual(sign > 0 ? forward : backward);
    }
    moved[j] = y[j];
    moved_rates[j] = rates[j];
    jacobian.col(j) = (forward - backward) / (2 * increment);
  }
}

void check(int flag, const char* call) {
  if (flag < 0) throw std::runtime_error(std::string(call) + " failed: " + std::to_string(flag));
}

template <class T, class Delete>
std::unique_ptr<T, Delete> own(T* pointer, Delete remove) {
  return {pointer, remove};
}

int residual_callback(double, N_Vector y, N_Vector rates, N_Vector r, void* user) {
  const auto& system = *static_cast<const System*>(user);
  system.calc_residual({N_VGetArrayPointer(y), system.size()},
                       {N_VGetArrayPointer(rates), system.size()},
                       {N_VGetArrayPointer(r), system.size()});
  return 0;
}

int jacobian_callback(double, double c, N_Vector y, N_Vector rates, N_Vector, SUNMatrix jacobian,
                      void* user, N_Vector, N_Vector, N_Vector) {
  const auto& system = *static_cast<const System*>(user);
  const auto n = system.size();
  system.calc_newton_matrix(ConstVectorMap(N_VGetArrayPointer(y), n),
                            ConstVectorMap(N_VGetArrayPointer(rates), n), c,
                            Eigen::Map<Eigen::MatrixXd>(SUNDenseMatrix_Data(jacobian), n, n));
  return 0;
}

}  // namespace

std::vector<State> integrate(const dynamics::Mechanism& mechanism,
                             const std::vector<dynamics::LoopDefinition>& loops, const State& start,
                             const std::vector<double>& times, double tolerance) {
  System system(mechanism, independent_rows(make_rows(mechanism, loops), start));
  SUNContext bare = nullptr;
  check(SUNContext_Create(nullptr, &bare), "SUNContext_Create");
  const auto context = own(bare, [](_SUNContext* c) { SUNContext_Free(&c); });
  const auto make_vector = [&] { return own(N_VNew_Serial(system.size(), bare), N_VDestroy); };
  const auto y = make_vector();
  const auto rates = make_vector();
  const auto id = make_vector();
  const auto view = [&](const auto& vector) {
    return VectorMap(N_VGetArrayPointer(vector.get()), system.size());
  };
  system.set_start(start, view(y), view(rates));
  view(id).setZero();
  view(id).head(system.differential_size()).setOnes();

  const auto matrix = own(SUNDenseMatrix(system.size(), system.size(), bare), SUNMatDestroy);
  const auto solver = own(SUNLinSol_Dense(y.get(), matrix.get(), bare), SUNLinSolFree);
  const auto ida = own(IDACreate(bare), [](void* memory) { IDAFree(&memory); });
  check(IDAInit(ida.get(), residual_callback, times.front(), y.get(), rates.get()), "IDAInit");
  const auto tolerances = make_vector();
  system.set_tolerances(tolerance, view(tolerances));
  check(IDASVtolerances(ida.get(), tolerance, tolerances.get()), "IDASVtolerances");
  check(IDASetUserData(ida.get(), &system), "IDASetUserData");
  check(IDASetId(ida.get(), id.get()), "IDASetId");
  // Multipliers are one order less accurate and would only shorten the steps (Hairer and Wanner
  // 1996, section VII.2).
  check(IDASetSuppressAlg(ida.get(), true), "IDASetSuppressAlg");
  // First-order steps of the accuracy asked; IDA's own guess, made for stiff transients, is so
  // short that rounding of the constraints, divided by its square, is all that is left of the
  // multipliers.
  check(IDASetInitStep(ida.get(), 0.3 * std::sqrt(tolerance)), "IDASetInitStep");
  check(IDASetMaxNumSteps(ida.get(), -1), "IDASetMaxNumSteps");
  check(IDASetLinearSolver(ida.get(), solver.get(), matrix.get()), "IDASetLinearSolver");
  check(IDASetJacFn(ida.get(), jacobian_callback), "IDASetJacFn");

  std::vector<State> states;
  for (const double time : times) {
    double reached = time;
    if (time > times.front()) {
      check(IDASolve(ida.get(), time, &reached, y.get(), rates.get(), IDA_NORMAL), "IDASolve");
    }
    states.push_back(system.state({N_VGetArrayPointer(y.get()), system.size()}));
  }
  return states;
}

}  // namespace blocklift::free_bodies

#pragma once

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/simulation/event_sources.h"
#include "dynamics/simulation/marched_surface.h"
#include "dynamics/simulation/newton_matrix.h"
#include "dynamics/simulation/state_projection.h"
#include "dynamics/simulation/steersman.h"
#include "dynamics/simulation/sundials.h"
#include "dynamics/simulation/tension_peaks.h"
#include "dynamics/simulation/wave_forecast.h"

namespace blocklift::dynamics {

/// One run of CVODES over an operation (integrate): the method's callbacks are in
/// integrator_callbacks.cc, the way through stages, samples and events in integrator.cc.
class Integrator {
 public:
  /// @param with_peaks Are largest loads sought between the samples (integrate_with_peaks)?
  Integrator(const LiftSystem& system, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
             const IntegrationSettings& settings, bool with_peaks = false);
  ~Integrator();
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  IntegrationResult run();

 private:
  void depart(const Departure& departure);
  void set_up_cvode();
  void find_relative_unknowns();
  void project_state(double t, VectorRef y);
  void integrate_interval(double start, double end);
  void march_surface();
  void step(double end);
  void forecast_waves(double end);
  void restart(double t);
  void count_before_restart();
  void record_samples(double up_to);
  void interpolate(double t);
  void record_sample(Eigen::Index sample, double t);
  void seek_peaks(double begin, bool ends_at_corner);
  void evaluate_sample(double t, ConstVectorRef y);
  void move_to(double t);
  void change_events(bool at_root);
  void slide_pads(double t);
  bool is_over() const;
  void steer(double t);
  bool motion_jumps(double t) const;
  bool part_ropes(double t);
  double& dissipated_work() { return sundials::view(work_.get())[3]; }
  double within_interval(double t) const { return std::clamp(t, from_, to_); }
  void check_pace();
  void report_progress(double t);
  [[noreturn]] void fail(const char* what);

  static int right_hand_side(double t, N_Vector y, N_Vector ydot, void* data);
  static int newton_matrix(double t, N_Vector y, N_Vector ydot, SUNMatrix A, int keep_point,
                           int* point_set, double gamma, void* data, N_Vector, N_Vector, N_Vector);
  static int solve_newton(SUNLinearSolver solver, SUNMatrix A, N_Vector x, N_Vector b, double);
  static int event_values(double t, N_Vector y, double* g, void* data);
  static int works(double t, N_Vector y, N_Vector rates, void* data);
  static int project(double t, N_Vector y, N_Vector correction, double tolerance, N_Vector error,
                     void* data);
  static int error_weights(N_Vector y, N_Vector weights, void* data);
  static void keep_message(int code, const char* module, const char* function, char* message,
                           void* data);
  template <class Function>
  int guarded(Function&& function);

  const LiftSystem& system_;
  const IntegrationSettings& settings_;
  LiftWorkspace w_;
  NewtonMatrix newton_;
  std::optional<StateProjection> projection_;
  std::optional<MarchedSurface> surface_;
  std::optional<Steersman> steersman_;
  WaveForecast forecast_;
  EventSources events_;
  std::vector<int> roots_;
  bool on_ground_ = false;  ///< are there pads that are ground?
  Eigen::VectorXd sample_times_;
  Eigen::Index next_sample_ = 0;
  std::vector<Eigen::Index> relative_unknowns_;  ///< velocities and quaternions: within y
  double begin_ = 0.0;                           ///< of the run, s
  double from_ = 0.0, to_ = 0.0;                 ///< times between which motions are evaluated now
  double time_ = 0.0;
  // Where the workspace holds the loads of an instant that may be asked for again: time and state.
  double loaded_time_ = not_a_number;
  Eigen::VectorXd loaded_state_;
  double evaluated_time_ =
      not_a_number;  ///< of the right-hand side's last evaluation by the method, s

  /// Time of the state whose events' values are foreseen; a root is sought behind it by states of
  /// other times.
  double foreseen_time_ = not_a_number;

  sundials::Context context_;
  sundials::Vector y_, rates_, sample_, work_, sampled_work_;
  sundials::Matrix matrix_;
  sundials::LinearSolver linear_solver_;
  void* cvode_ = nullptr;
  std::exception_ptr exception_;
  std::string message_;
  IntegrationResult result_;
  std::optional<TensionPeaks> peaks_;
  double reported_ = -1.0;  ///< fraction of the operation
  long steps_taken_ = 0;
  double time_of_portion_ = 0.0;  // when the last hundredth of the allowed steps was taken
};

}  // namespace blocklift::dynamics

#pragma once

#include "dynamics/marine/radiation/memory_state_space.h"
#include "dynamics/marine/radiation/radiation.h"

namespace blocklift::dynamics {

/// Small motions of freely floating bodies about rest:
///   (m + A_inf) xi'' + C xi = F,    F the memory of the water (and the wave's force).
struct LinearFloatation {
  Eigen::MatrixXd mass;       ///< m, 6N x 6N about the reference points; kg, kg m, kg m2
  Eigen::MatrixXd stiffness;  ///< C: hydrostatics and moorings; N/m, N, N m
  Eigen::VectorXd start;      ///< xi at the time 0, at rest; m, rad
};

/// Motion at equal steps.
struct FloatingMotion {
  double step = not_a_number;             ///< s
  std::vector<Eigen::VectorXd> position;  ///< xi, 6N, at 0, step, 2 step ...
};

/// Marches bodies and surface together; leapfrog, second order in the step.
FloatingMotion march_directly(const LinearFloatation& bodies, DirectRadiation& water, double step,
                              double duration);

/// Marches Cummins' equation with the database; Runge-Kutta of order 4, any step. With a wave its
/// excitation is taken from the database's nearest frequency and heading, ramped as in
/// DirectRadiation.
/// @throws ModelError if the wave is not among the database's frequencies and headings.
FloatingMotion march_with_database(const LinearFloatation& bodies,
                                   const HydrodynamicDatabase& database, double step,
                                   double duration, const std::optional<RegularWave>& wave = {});

/// Marches Cummins' equation with its memory as a state space; Runge-Kutta of order 4, any step.
/// `infinite_added_mass` is the database's A_inf.
FloatingMotion march_with_state_space(const LinearFloatation& bodies,
                                      const Eigen::MatrixXd& infinite_added_mass,
                                      const MemoryStateSpace& memory, double step, double duration);

/// A maximum or minimum of one coordinate of a motion.
struct Extremum {
  double time = not_a_number;   ///< s
  double value = not_a_number;  ///< m or rad
};

/// Extrema after the start, each by the parabola through three samples.
std::vector<Extremum> find_extrema(const FloatingMotion& motion, int mode);

}  // namespace blocklift::dynamics

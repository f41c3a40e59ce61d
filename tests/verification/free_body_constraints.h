#pragma once

#include <vector>

#include <Eigen/Dense>

#include "dynamics/multibody/mechanism.h"

/// Second formulation of multibody dynamics, for verification: every body is free, every joint and
/// loop is a set of algebraic equations. It takes a mechanism's data (bodies, joints, loops) and
/// none of the kernel's algorithms.
namespace blocklift::free_bodies {

using dynamics::Matrix3;
using dynamics::Vector3;
using dynamics::Vector4;

/// Where the bodies are and how they move; entry i is body i + 1 of the mechanism.
struct State {
  std::vector<Vector3> p_WBcm;  ///< centres of mass, m
  std::vector<Vector4> Q_WB;    ///< quaternions (w, x, y, z)
  std::vector<Vector3> v_WBcm;  ///< in W, m/s
  std::vector<Vector3> w_WB_B;  ///< angular velocities, in B, rad/s
};

/// Point of a body, given from its centre of mass along its axes; body -1 is the world.
struct Point {
  int body = -1;
  Vector3 p_BcmQ_B = Vector3::Zero();
};

/// One scalar equation g = 0 between bodies.
struct Row {
  enum class Kind {
    perpendicular,  ///< a . b, directions of the two bodies
    in_plane,  ///< a . d, d from the first point to the second: it stays in the plane normal to a
    length     ///< sum of the distances of successive points less the length
  };
  Kind kind;
  std::vector<Point> points;           ///< two; as many as the path has for `length`
  Vector3 a_First = Vector3::Zero();   ///< direction in the first point's body
  Vector3 b_Second = Vector3::Zero();  ///< direction in the second point's body
  double length = 0.0;                 ///< m
};

/// All equations of a mechanism's joints and of its loops.
/// @param loops as they were given to the mechanism's builder; lengths must be given.
/// @throws std::invalid_argument for gears, drives and damping: this formulation has none.
std::vector<Row> make_rows(const dynamics::Mechanism& mechanism,
                           const std::vector<dynamics::LoopDefinition>& loops);

/// Residual g of the rows at the positions of a state, m or plain numbers.
Eigen::VectorXd calc_residual(const std::vector<Row>& rows, const State& state);

/// Jacobian G (rows x 6 n): dg/dt = G (v_1, ..., v_n, w_1, ..., w_n), v in W, w in B.
Eigen::MatrixXd calc_jacobian(const std::vector<Row>& rows, const State& state);

/// Those rows that are independent at a state, by a rank-revealing QR decomposition.
std::vector<Row> independent_rows(const std::vector<Row>& rows, const State& state);

}  // namespace blocklift::free_bodies

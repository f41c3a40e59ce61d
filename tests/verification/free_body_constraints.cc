#include "tests/verification/free_body_constraints.h"

#include <algorithm>
#include <stdexcept>

namespace blocklift::free_bodies {
namespace {

using dynamics::JointKind;
using dynamics::LoopDefinition;
using dynamics::LoopKind;
using dynamics::Mechanism;
using dynamics::Pose;

/// A frame fixed in a body, by the body's centre of mass and axes.
struct Frame {
  int body;
  Vector3 p_BcmF_B;
  Matrix3 R_BF;
};

std::size_t index(int i) { return static_cast<std::size_t>(i); }

Frame make_frame(const Mechanism& mechanism, int body, const Pose& X_BF) {
  const Vector3 p_BoBcm = body == 0 ? Vector3::Zero() : mechanism.body(body).inertia.p_BoBcm;
  return {body - 1, X_BF.p - p_BoBcm, X_BF.R};
}

class RowMaker {
 public:
  RowMaker(const Frame& first, const Frame& second, std::vector<Row>& rows)
      : first_(first), second_(second), rows_(rows) {}

  void points_together() {
    for (int i = 0; i < 3; ++i) in_plane(Vector3::Unit(i));
  }
  void orientations_equal() {
    for (int i = 0; i < 3; ++i) perpendicular(Vector3::Unit(i), Vector3::Unit((i + 1) % 3));
  }
  void on_axis(const Vector3& axis) {
    const Vector3 across = axis.unitOrthogonal();
    in_plane(across);
    in_plane(axis.normalized().cross(across));
  }
  void axes_parallel(const Vector3& axis) {
    const Vector3 across = axis.unitOrthogonal();
    perpendicular(across, axis);
    perpendicular(axis.normalized().cross(across), axis);
  }
  void in_plane(const Vector3& normal_F) {
    rows_.push_back(
        {Row::Kind::in_plane, points(), first_.R_BF * normal_F.normalized(), Vector3::Zero(), 0});
  }
  void perpendicular(const Vector3& a_F, const Vector3& b_F) {
    rows_.push_back({Row::Kind::perpendicular, points(), first_.R_BF * a_F.normalized(),
                     second_.R_BF * b_F.normalized(), 0});
  }
  void distance(double length) {
    rows_.push_back({Row::Kind::length, points(), Vector3::Zero(), Vector3::Zero(), length});
  }

 private:
  std::vector<Point> points() const {
    return {{first_.body, first_.p_BcmF_B}, {second_.body, second_.p_BcmF_B}};
  }
  const Frame& first_;
  const Frame& second_;
  std::vector<Row>& rows_;
};

/// What a joint of this kind holds; false for a free one, which holds nothing.
void add_joint(LoopKind kind, const Vector3& axis, const Vector3& second_axis, RowMaker make) {
  switch (kind) {
    case LoopKind::fixed:
      make.points_together();
      return make.orientations_equal();
    case LoopKind::revolute:
      make.points_together();
      return make.axes_parallel(axis);
    case LoopKind::prismatic:
      make.on_axis(axis);
      return make.orientations_equal();
    case LoopKind::cylindrical:
      make.on_axis(axis);
      return make.axes_parallel(axis);
    case LoopKind::universal:
      make.points_together();
      return make.perpendicular(axis, second_axis);
    case LoopKind::spherical:
      return make.points_together();
    case LoopKind::planar:
      make.in_plane(axis);
      return make.axes_parallel(axis);
    case LoopKind::translational:
      return make.orientations_equal();
    default:
      throw std::invalid_argument("no joint");
  }
}

LoopKind loop_kind_of(JointKind kind) {
  return dynamics::loop_kind(dynamics::joint_kind_name(kind)).value();
}

void add_tree_joint(const Mechanism& mechanism, int i, std::vector<Row>& rows) {
  const dynamics::Body& body = mechanism.body(i);
  const auto is_set = [](bool driven) { return driven; };
  if (std::any_of(body.driven.begin(), body.driven.end(), is_set))
    throw std::invalid_argument("joint of " + body.name + " is driven");
  for (const double d : body.damping) {
    if (d != 0.0) throw std::invalid_argument("joint of " + body.name + " is damped");
  }
  if (body.joint.kind == JointKind::free) return;
  const Frame parent = make_frame(mechanism, body.parent, body.X_PJ);
  const Frame child = make_frame(mechanism, i, Pose::identity());
  add_joint(loop_kind_of(body.joint.kind), body.joint.axis, body.joint.second_axis,
            {parent, child, rows});
}

void add_loop(const Mechanism& mechanism, const LoopDefinition& loop, std::vector<Row>& rows) {
  if (loop.kind == LoopKind::gear) throw std::invalid_argument("a gear is no equation of points");
  if (loop.kind == LoopKind::rope_length) {
    if (loop.paths.size() != 1) throw std::invalid_argument("one path a rope");
    Row row{Row::Kind::length, {}, Vector3::Zero(), Vector3::Zero(), loop.length};
    for (const dynamics::LoopPoint& point : loop.paths.front()) {
      const Frame frame =
          make_frame(mechanism, mechanism.body_index(point.body), Pose::translation(point.p_BoQ_B));
      row.points.push_back({frame.body, frame.p_BcmF_B});
    }
    return rows.push_back(row);
  }
  const Frame first = make_frame(mechanism, mechanism.body_index(loop.first), loop.X_FirstK);
  const Frame second = make_frame(mechanism, mechanism.body_index(loop.second), loop.X_SecondK);
  if (loop.kind == LoopKind::distance) return RowMaker(first, second, rows).distance(loop.length);
  if (loop.kind == LoopKind::point_on_line) return RowMaker(second, first, rows).on_axis(loop.axis);
  add_joint(loop.kind, loop.axis, loop.second_axis, {first, second, rows});
}

Matrix3 rotation(const Vector4& Q) {
  return Eigen::Quaterniond(Q[0], Q[1], Q[2], Q[3]).normalized().toRotationMatrix();
}

Matrix3 rotation(const State& state, int body) {
  return body < 0 ? Matrix3::Identity() : rotation(state.Q_WB[index(body)]);
}

Vector3 arm(const State& state, const Point& point) {
  return rotation(state, point.body) * point.p_BcmQ_B;
}

Vector3 position(const State& state, const Point& point) {
  return (point.body < 0 ? Vector3::Zero() : state.p_WBcm[index(point.body)]) + arm(state, point);
}

double calc_residual(const Row& row, const State& state) {
  const Point& first = row.points.front();
  const Point& second = row.points.back();
  const Vector3 a = rotation(state, first.body) * row.a_First;
  switch (row.kind) {
    case Row::Kind::perpendicular:
      return a.dot(rotation(state, second.body) * row.b_Second);
    case Row::Kind::in_plane:
      return a.dot(position(state, second) - position(state, first));
    case Row::Kind::length:
      break;
  }
  double length = 0;
  for (std::size_t i = 1; i < row.points.size(); ++i)
    length += (position(state, row.points[i]) - position(state, row.points[i - 1])).norm();
  return length - row.length;
}

/// One row of the Jacobian, filled by what each body's motion contributes to dg/dt.
class JacobianRow {
 public:
  JacobianRow(const State& state, Eigen::Ref<Eigen::RowVectorXd> row) : state_(state), row_(row) {}

  /// dg/dt += c . w_WB, both in W.
  void add_turn(int body, const Vector3& c_W) {
    if (body < 0) return;
    const auto n = static_cast<Eigen::Index>(state_.p_WBcm.size());
    row_.segment<3>(3 * (n + body)) += rotation(state_, body).transpose() * c_W;
  }
  /// dg/dt += f . v_WQ.
  void add_point(const Point& point, const Vector3& f_W) {
    if (point.body < 0) return;
    row_.segment<3>(3 * point.body) += f_W;
    add_turn(point.body, arm(state_, point).cross(f_W));
  }

 private:
  const State& state_;
  Eigen::Ref<Eigen::RowVectorXd> row_;
};

void calc_jacobian(const Row& row, const State& state, JacobianRow jacobian) {
  const Point& first = row.points.front();
  const Point& second = row.points.back();
  const Vector3 a = rotation(state, first.body) * row.a_First;
  if (row.kind == Row::Kind::perpendicular) {
    const Vector3 b = rotation(state, second.body) * row.b_Second;
    jacobian.add_turn(first.body, a.cross(b));
    jacobian.add_turn(second.body, b.cross(a));
  } else if (row.kind == Row::Kind::in_plane) {
    jacobian.add_turn(first.body, a.cross(position(state, second) - position(state, first)));
    jacobian.add_point(second, a);
    jacobian.add_point(first, -a);
  } else {
    for (std::size_t i = 1; i < row.points.size(); ++i) {
      const Vector3 direction =
          (position(state, row.points[i]) - position(state, row.points[i - 1])).normalized();
      jacobian.add_point(row.points[i], direction);
      jacobian.add_point(row.points[i - 1], -direction);
    }
  }
}

}  // namespace

std::vector<Row> make_rows(const Mechanism& mechanism, const std::vector<LoopDefinition>& loops) {
  std::vector<Row> rows;
  for (int i = 1; i < mechanism.body_count(); ++i) add_tree_joint(mechanism, i, rows);
  for (const LoopDefinition& loop : loops) add_loop(mechanism, loop, rows);
  return rows;
}

Eigen::VectorXd calc_residual(const std::vector<Row>& rows, const State& state) {
  Eigen::VectorXd residual(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) residual[i] = calc_residual(rows[i], state);
  return residual;
}

Eigen::MatrixXd calc_jacobian(const std::vector<Row>& rows, const State& state) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows.size(), 6 * state.p_WBcm.size());
  Eigen::RowVectorXd row(jacobian.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    row.setZero();
    calc_jacobian(rows[i], state, JacobianRow(state, row));
    jacobian.row(i) = row;
  }
  return jacobian;
}

std::vector<Row> independent_rows(const std::vector<Row>& rows, const State& state) {
  if (rows.empty()) return rows;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(calc_jacobian(rows, state).transpose());
  qr.setThreshold(1e-9);
  std::vector<Row> chosen;
  for (Eigen::Index i = 0; i < qr.rank(); ++i)
    chosen.push_back(rows[qr.colsPermutation().indices()[i]]);
  return chosen;
}

}  // namespace blocklift::free_bodies
